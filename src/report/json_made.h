/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the flows make of the device. */
#ifndef FW_REPORT_JSON_MADE_H
#define FW_REPORT_JSON_MADE_H
#include "report/json_common.h"
#include "verdict/verdict.h"

/* of one flow; null where nothing was judged but the drawing */
json_t *fw_json_made(const fw_variant_verdict *variant, bool *failed);
/* of one hinge, the tightest of these flows */
json_t *fw_json_made_hinge(const fw_variant_verdict *variant, int nvariant, int joint,
                           bool *failed);
#endif
