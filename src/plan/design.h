/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Behind the public header: for commands that show more than the library does. */
#ifndef FW_PLAN_DESIGN_H
#define FW_PLAN_DESIGN_H
#include "plan/plan.h"
#include <flexwright.h>

/* what options may be, for those who ask for them in a form */
#define FW_ACCURACY_LEAST 1e-12
#define FW_ACCURACY_MOST  0.1
#define FW_RTOL_LEAST     1e-14
#define FW_RTOL_MOST      1e-2

fw_plan *fw_plan_design_plan(fw_design *design); /* NULL for NULL */
/* a request to stop the whole program stops this design too; before any work */
void fw_plan_design_cancel_with(fw_design *design, const fw_cancel *above);
/* flexwright.table/1 */
fw_status fw_plan_table_json(fw_text *out);
/* flexwright.preview/1 of what has been done with the design so far; *provisional as there */
fw_status fw_plan_design_preview_json(fw_design *design, fw_text *out);

#endif
