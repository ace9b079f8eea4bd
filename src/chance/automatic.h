/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The methods that have several parts, and the choice among all. */
#ifndef FW_CHANCE_AUTOMATIC_H
#define FW_CHANCE_AUTOMATIC_H
#include "chance/evaluate.h"

fw_status fw_chance_in_subsets(fw_chance_run *run, fw_chance_estimate *out);
/* FW_SOLVER: no design point was found */
fw_status fw_chance_around_points(fw_chance_run *run, fw_chance_estimate *out);
fw_status fw_chance_automatic(fw_chance_run *run, fw_chance_estimate *out);

#endif
