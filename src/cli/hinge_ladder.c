/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "cli/hinge_ladder.h"
#include <math.h>
#include <time.h>

static const fw_ladder_level level[] = {
    {"closed-form", "linear, at rest", fw_ladder_closed_form},
    {"compliance", "three degrees of freedom, at the limit angle", fw_ladder_compliance},
};

const fw_ladder_level *fw_ladder_levels(size_t *count) {
    *count = sizeof level / sizeof level[0];
    return level;
}

static double now_s(void) {
    struct timespec t;
    return clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t)
               ? 0
               : (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

fw_status fw_ladder_climb(const fw_ladder_case *c, const fw_ladder_level *of, fw_ladder_row *row,
                          bool *exists) {
    double spent = 0;
    int done = 0;
    for (int batch = 1; done == 0 || (spent < 2e-3 && *exists); batch *= 2) {
        fw_ladder_case fresh = *c;
        fw_status status = FW_OK;
        FW_NEED(fresh.arena = fw_arena_new(0));
        double began = now_s();
        for (int i = 0; i < batch && status == FW_OK; i++, done++)
            status = of->work(&fresh, row, exists);
        spent += now_s() - began;
        fw_arena_free(fresh.arena);
        FW_TRY(status);
    }
    row->cpu_s = spent / done;
    return FW_OK;
}

/* the hinge's own frame has its first root at polar angle -a whichever body that is */
void fw_ladder_place(const fw_ladder_case *c, double along_m, double across_m, double world_m[2]) {
    const fw_pin *pin = &c->mechanism->pin[c->hinge->pin];
    fw_vec2 w = fw_pin_place(c->mechanism, pin, 0);
    double axis = c->hinge->axis_rad, cs = cos(axis), sn = sin(axis);
    bool known = isfinite(axis); /* else only W itself has a place */
    world_m[0] = w.x + (known ? cs * along_m - sn * across_m : 0);
    world_m[1] = w.y + (known ? sn * along_m + cs * across_m : 0);
}
