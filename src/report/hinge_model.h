/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How hinges were taken, and what the next level changes: text, a table of the page. */
#ifndef FW_REPORT_HINGE_MODEL_H
#define FW_REPORT_HINGE_MODEL_H
#include "report/report_page.h"
#include "statics/level.h"

/* lines for a terminal; none without hinges */
void fw_report_hinge_model(const fw_mechanism *mechanism, const fw_effects_hinge_use *use,
                           const fw_statics_level_step *level, fw_text *out);
/* table of all scenes and flows; none without hinges */
void fw_report_section_levels(fw_report_page *page);
#endif
