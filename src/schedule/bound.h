/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lower bounds of the end of all schedules. Private to schedule/. */
#ifndef FW_SCHEDULE_BOUND_H
#define FW_SCHEDULE_BOUND_H
#include "schedule/schedule.h"

/* earliest_s (ntask) of a wafer alone, from fw_schedule_network_earliest with start_s */
void fw_schedule_bounds(const fw_schedule_shop *shop, const double *earliest_s, double start_s,
                        fw_schedule_bound *bound);

#endif
