/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes that end while the device goes up.

   A hinge whose peak is at the last instant and that still turns on, by more than a few per cent of it in the lowest mode:
   v/omega. The same scene then lasts a period of that mode longer, in which every single mode comes to its next peak, and
   its loads go on as their laws say. In: the motion with inertia; of a row of equilibria the bound of inertia says that little
   comes behind it. Test: test_program.py, EndsEarly */
#include "base/constants.h"
#include "statics/statics.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

static const double fw_few_per_cent = 0.03, fw_hardly_turned = 1e-3; /* of what a hinge bears */

/* s; 0: nothing swings */
static fw_status longest_period(fw_arena *arena, const fw_mechanism *m,
                                const fw_device_scene *scene, double *period_s) {
    const fw_statics_mode_options o = {.accuracy = 1e-3};
    const fw_statics_modes *modes = NULL;
    fw_diags own = fw_diags_new(arena);
    *period_s = 0;
    fw_status status = fw_statics_small_motions(arena, m, scene, &o, &own, &modes);
    if (status == FW_CANCELLED || status == FW_NOMEM) return status;
    for (int i = 0; status == FW_OK && modes && i < modes->count; i++)
        if (modes->mode[i].omega_rad_per_s > 0)
            *period_s = fmax(*period_s, 2 * FW_PI / modes->mode[i].omega_rad_per_s);
    return FW_OK;
}

/* rad/s by which a hinge that is at its peak there turns on at the end; 0: it does not */
static double turns_on(const fw_mechanism *m, const fw_dynamics_motion *x, int hinge) {
    const int pin = m->hinge[hinge].pin, a = m->pin[pin].body_a, b = m->pin[pin].body_b;
    const double *v = x->v + (size_t)(x->nsample - 1) * 3 * (size_t)x->nbody;
    const double rate = (b == FW_GROUND ? 0 : v[3 * b + 2]) - (a == FW_GROUND ? 0 : v[3 * a + 2]);
    if (x->peak[pin].t_s < x->end_s * (1 - 1e-9)) return 0;
    return fmax(0, x->peak[pin].angle_rad > 0 ? rate : -rate);
}

/* the hinge that turns on farthest beyond its peak, for its size, by its speed and a period */
static int goes_on(const fw_mechanism *m, const fw_dynamics_motion *x, double period_s) {
    double most = fw_few_per_cent;
    int which = FW_NONE;
    for (int k = 0; k < m->nhinge; k++) {
        const double peak = fabs(x->peak[m->hinge[k].pin].angle_rad);
        const double on = turns_on(m, x, k) * period_s / (2 * FW_PI);
        if (on > most * peak) most = on / peak, which = k;
    }
    return which;
}

static fw_status last_longer(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                             const fw_dynamics_motion *x, double more_s,
                             const fw_dynamics_motion_options *options,
                             const fw_dynamics_motion **longer) {
    fw_device_scene changed = *scene;
    fw_dynamics_motion_options o = *options;
    fw_diags own = fw_diags_new(arena);
    changed.duration_s += more_s;
    o.observe = NULL, o.glance = NULL, o.trace = NULL, o.other = NULL, o.unsettled = NULL;
    o.tapes = NULL, o.like = NULL, o.whole = o.trace_both = false;
    o.samples = 2, o.looser = 1, o.effects.hinge = x->ledger.hinge.used;
    *longer = NULL;
    fw_status status = fw_statics_move_scene(arena, m, &changed, &o, &own, longer);
    if (status != FW_OK) *longer = NULL;
    return status == FW_CANCELLED || status == FW_NOMEM ? status : FW_OK;
}

/* FW-D691: how far hinge k would have gone where the scene had lasted longer; NULL: no farther */
static const char *would_go(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                            const fw_dynamics_motion *x, const fw_dynamics_motion *longer, int k,
                            double period_s) {
    const int pin = m->hinge[k].pin;
    const double peak = fabs(x->peak[pin].angle_rad), degree = FW_DEG_PER_RAD;
    const double far = longer ? fabs(longer->peak[pin].angle_rad)
                              : peak + turns_on(m, x, k) * period_s / (2 * FW_PI);
    const bool times = far > 3 * peak;
    char end[32], at[32], to[32], by[32], least[32];
    const double least_rad = fw_hardly_turned * m->hinge[k].closed_form.limit_angle_rad;
    if (!(far > peak * (1 + fw_few_per_cent)) || far < least_rad) return NULL;
    return fw_arena_printf(
        arena,
        "%s%s ends at %s ms with hinge %s at its peak, %s deg, and still on its way: within a "
        "period of the lowest mode it goes on to %s deg%s, %s%s, and nothing of that is "
        "judged; let the scene last %s ms at least",
        FW_NAMED("scene", scene->name), fw_number_text(end, sizeof end, 1e3 * x->end_s, 4),
        fw_text_name(m->pin[pin].id), fw_number_text(at, sizeof at, peak * degree, 3),
        fw_number_text(to, sizeof to, far * degree, 3), longer ? "" : " by its speed alone",
        fw_number_text(by, sizeof by, times ? far / peak : 100 * (far / peak - 1), 2),
        times ? " times as far" : " % farther",
        fw_number_text(least, sizeof least, 1e3 * (x->end_s + period_s), 3));
}

fw_status fw_verdict_ends_early(fw_arena *arena, const fw_device_scene *scene,
                                const fw_dynamics_motion *x,
                                const fw_dynamics_motion_options *options, fw_diags *diags,
                                fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    const fw_dynamics_motion *longer;
    const fw_verdict_strain_monitor *saw = options->context;
    double period_s;
    if (v->corner || (saw && saw->trial)) return FW_OK; /* what is drawn says it for all */
    if (x->loads->quasi_static || x->ended || x->nsample < 1) return FW_OK;
    fw_dynamics_motion_rows(x, x->nsample - 1, 1);
    if (goes_on(m, x, (double)INFINITY) == FW_NONE) return FW_OK;
    FW_TRY(longest_period(arena, m, scene, &period_s));
    const int k = goes_on(m, x, period_s);
    if (k == FW_NONE) return FW_OK;
    FW_TRY(last_longer(arena, m, scene, x, period_s, options, &longer));
    const char *text = would_go(arena, m, scene, x, longer, k, period_s);
    if (!text) return FW_OK;
    fw_diag_warning(diags, 691, scene->place, "%s", text);
    if (!v->ends_early) v->ends_early = text;
    return FW_OK;
}
