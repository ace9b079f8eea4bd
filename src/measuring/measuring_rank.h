/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Private to measuring/. */
#ifndef FW_MEASURING_MEASURING_RANK_H
#define FW_MEASURING_MEASURING_RANK_H
#include "measuring/measuring.h"

/* narrowing and decides of the items (n, in any order); those that change something, ranked, into
   m->item; the others' names; the sentence */
fw_status fw_measuring_rank(fw_arena *arena, fw_measuring *m, fw_measuring_item *item, int n);

#endif
