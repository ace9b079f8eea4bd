/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "dynamics/run.h"
#include <string.h>

fw_status fw_integrator_choose(fw_run *r, const char *name) {
    bool automatic = !name || strcmp(name, "auto") == 0;
    r->integrator = fw_stepper_find(automatic ? "dop853" : name);
    r->motion->integrator = r->integrator->name;
    r->motion->reason = automatic ? "auto: explicit order 8 with projection" : "asked for";
    return FW_OK;
}
