/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What occupies a machine or the operators. Private to schedule/. */
#ifndef FW_SCHEDULE_LINE_H
#define FW_SCHEDULE_LINE_H
#include "schedule/place.h"

double fw_line_fit(const fw_line *line, double t, double length);
void fw_line_add(fw_line *line, double start, double end);    /* nothing for an empty span */
void fw_line_remove(fw_line *line, double start, double end); /* what was added */

#endif
