/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One function per hinge kind; table.c has their rows. Private to the room. */
#ifndef FW_FLEXURE_KINDS_H
#define FW_FLEXURE_KINDS_H
#include "flexure/flexure.h"

void fw_flexure_csfh(const fw_flexure_input *in, fw_flexure_result *out);
void fw_flexure_leaf(const fw_flexure_input *in, fw_flexure_result *out);

#endif
