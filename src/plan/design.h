/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Behind the public header: for commands that show more than the library does. */
#ifndef FW_PLAN_DESIGN_H
#define FW_PLAN_DESIGN_H
#include "plan/plan.h"
#include <flexwright.h>

fw_plan *fw_design_plan(fw_design *design); /* NULL for NULL */

#endif
