/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Durations in words; shared with recipe/. */
#ifndef FW_SCHEDULE_SCHEDULE_WORDS_H
#define FW_SCHEDULE_SCHEDULE_WORDS_H
#include "base/text.h"

/* "45 s", "16 min 40 s", "1 h 30 min" */
void fw_schedule_put_duration(fw_text *out, double seconds);

#endif
