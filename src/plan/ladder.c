/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plan/ladder.h"
#include <math.h>
#include <time.h>

static const fw_plan_ladder_level level[FW_LADDER_LEVELS] = {
    {"closed-form", "linear, at rest", false, fw_plan_ladder_closed_form},
    {"compliance", "three degrees of freedom, at the limit angle", false,
     fw_plan_ladder_compliance},
    {"elastica", "geometrically exact beam", false, fw_plan_ladder_elastica},
    {"continuum", "solid with fillets and root blocks", true, fw_plan_ladder_continuum},
};

const fw_plan_ladder_level *fw_plan_ladder_levels(size_t *count) {
    *count = FW_LADDER_LEVELS;
    return level;
}

static double now_s(void) {
    struct timespec t;
    return clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t)
               ? 0
               : (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

fw_status fw_plan_ladder_climb(const fw_plan_ladder_case *c, const fw_plan_ladder_level *of,
                               bool measured, fw_report_level *row) {
    double spent = 0;
    int done = 0;
    *row = (fw_report_level){.name = of->name};
    for (int batch = 1; done == 0 || (measured && spent < 2e-3 && row->state == FW_LEVEL_SOLVED);
         batch *= 2) {
        fw_plan_ladder_case fresh = *c;
        fw_status status = FW_OK;
        FW_NEED(fresh.arena = fw_arena_part(c->arena, 0));
        double began = now_s();
        for (int i = 0; i < batch && status == FW_OK; i++, done++)
            status = of->work(&fresh, row);
        spent += now_s() - began;
        fw_arena_free(fresh.arena);
        FW_TRY(status);
        row->name = of->name;
        if (of->external) return FW_OK; /* has counted the other program's time itself */
    }
    row->cpu_s = spent / done;
    return FW_OK;
}

/* the hinge's own frame has its first root at polar angle -a whichever body that is */
void fw_plan_ladder_place(const fw_mechanism *mechanism, const fw_mechanism_hinge *hinge,
                          const double at_m[2], double world_m[2]) {
    fw_geometry_vec2 w = fw_mechanism_pin_place(mechanism, &mechanism->pin[hinge->pin], 0);
    double axis = hinge->axis_rad, cs = cos(axis), sn = sin(axis);
    bool known = isfinite(axis); /* else only W itself has a place */
    world_m[0] = w.x + (known ? cs * at_m[0] - sn * at_m[1] : 0);
    world_m[1] = w.y + (known ? sn * at_m[0] + cs * at_m[1] : 0);
}

/* to rounding, NaN is like NaN: what a level sees of a hinge is its input (closed form and law
   follow from it) and, of the material, the constants of the crystal */
static bool same(double a, double b) {
    return a == b || (isnan(a) && isnan(b)) || fabs(a - b) <= 1e-12 * fmax(fabs(a), fabs(b));
}

static bool same_crystal(const fw_flexure_crystal *a, const fw_flexure_crystal *b) {
    if (a->known != b->known) return false;
    return !a->known || (a->aligned == b->aligned && same(a->a0_per_Pa, b->a0_per_Pa) &&
                         same(a->a1_per_Pa, b->a1_per_Pa) && same(a->g0_per_Pa, b->g0_per_Pa) &&
                         same(a->g1_per_Pa, b->g1_per_Pa) && same(a->s12_per_Pa, b->s12_per_Pa) &&
                         hypot(a->cos4 - b->cos4, a->sin4 - b->sin4) <= 1e-12);
}

bool fw_plan_ladder_alike(const fw_plan_ladder_case *one, const fw_plan_ladder_case *other) {
    const fw_flexure_input *a = &one->hinge->input, *b = &other->hinge->input;
    return a->kind == b->kind && same(a->length_m, b->length_m) &&
           same(a->angle_rad, b->angle_rad) && same(a->radius_m, b->radius_m) &&
           same(a->width_m, b->width_m) && same(a->fillet_m, b->fillet_m) &&
           same(a->depth_m, b->depth_m) && same(a->youngs_Pa, b->youngs_Pa) &&
           same(a->poisson, b->poisson) && same(a->strength_Pa, b->strength_Pa) &&
           same(a->safety_factor, b->safety_factor) && same_crystal(&a->crystal, &b->crystal);
}

/* the levels are in the order of their cost */
void fw_plan_ladder_pick(fw_plan_ladder *l, double accuracy) {
    l->picked = -1, l->reached = false;
    for (int i = 0; i < l->rows; i++) {
        const fw_report_level *row = &l->row[i];
        if (row->state != FW_LEVEL_SOLVED || l->reached) continue;
        if (l->picked < 0 || row->error.stiffness < l->row[l->picked].error.stiffness)
            l->picked = i;
        l->reached = row->error.stiffness <= accuracy;
    }
    l->reaches = l->picked < 0 ? (double)NAN : l->row[l->picked].error.stiffness;
}
