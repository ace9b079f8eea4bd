/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What occupies a machine or the operators. Private to schedule/. */
#ifndef FW_SCHEDULE_LINE_H
#define FW_SCHEDULE_LINE_H
#include "schedule/place.h"

double fw_schedule_line_fit(const fw_schedule_line *line, double t, double length);
void fw_schedule_line_add(fw_schedule_line *line, double start,
                          double end); /* nothing for an empty span */
void fw_schedule_line_remove(fw_schedule_line *line, double start, double end); /* what was added */

#endif
