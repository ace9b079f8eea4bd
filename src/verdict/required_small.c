/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is required of equilibria: frequencies, stiffnesses and compliances, which have no measure of a motion; and what of
   motions is read once more, of a softer and a stiffer device. */
#include "base/constants.h"
#include "base/sort.h"
#include "effects/effects.h"
#include "geometry/segment.h"
#include "quantity/law_kind.h"
#include "statics/statics.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <float.h>
#include <math.h>
#include <string.h>

/* ---- what a probed stiffness may be off by for its flexures ----
   By the energies that they have of what its unit load displaces, u = sum over modes of phi (phi . f)/(M omega^2): along and
   across, a flexure is known less well than it turns, and a stiffness that goes by that is, too. In: small motions at rest; about an
   equilibrium a leaf that stands aside is stretched by what its law at rest does not know. Out: relative; 0 there, and of a
   mode, which has its own. Source: fw_statics_shape_error. Test: test_probe.py, test_a_stiffness_across_its_leaves */
fw_status fw_verdict_small_off(fw_arena *arena, const fw_mechanism *m,
                               const fw_statics_modes *modes, const fw_probe *p, double *off) {
    const size_t n = 3 * (size_t)m->nbody;
    const fw_effects_port *at = &p->point[0];
    *off = 0;
    if (p->kind->takes != FW_PROBE_TANGENT || at->body == FW_GROUND || modes->at_equilibrium)
        return FW_OK;
    for (int k = 0; k < modes->count; k++)
        if (!(modes->mode[k].stiffness_per_s2 > 0)) return FW_OK;
    double *u = fw_arena_array(arena, double, 2 * n), whole = 0;
    FW_NEED(u);
    double *f = u + n;
    const double c = cos(p->asked->direction_rad), s = sin(p->asked->direction_rad);
    const fw_geometry_vec2 r =
        fw_geometry_vec_rotate((fw_geometry_vec2){at->x_m, at->y_m}, modes->q[3 * at->body + 2]);
    f[3 * at->body] = c, f[3 * at->body + 1] = s, f[3 * at->body + 2] = r.x * s - r.y * c;
    fw_verdict_displaced(modes, f, u);
    for (size_t i = 0; i < n; i++)
        whole += f[i] * u[i];
    const bool pins = modes->ledger.hinge.used == FW_HINGE_REVOLUTE;
    if (whole > 0) *off = fw_statics_shape_error(m, modes->q, u, pins, whole, NULL);
    return FW_OK;
}

/* ---- equilibria of what is required without a measure ----
   A frequency or a stiffness about an equilibrium is off by what the flexures' errors take of it there, and by what they do to
   the equilibrium: a pull that softens closes its gap further, without end towards pull-in. So both are found again with all
   flexures 1/(1 + e) and 1 + e times as stiff, e: their own error, twice what the next level changes of a frequency, and what
   bodies give; and, where electrodes act, each of these with the pull as it is, with all that may be missing of it, and over a
   carrier that conducts with as much less. Bands hold all of these. Error: one e for all that gives. Cost: two small motions, four
   or six with electrodes. Test: test_near_pull_in.py */

/* a copy of a scene whose electrodes pull so many times as much */
static fw_status pull_times(fw_arena *arena, double times, fw_device_scene *scene) {
    const size_t n = (size_t)scene->ncomb;
    FW_NEED(scene->comb = fw_arena_grow(arena, scene->comb, n, n, sizeof *scene->comb));
    for (int i = 0; i < scene->ncomb; i++)
        scene->comb[i].voltage_V *= sqrt(times);
    return FW_OK;
}

/* of stiffnesses, by flexures alone */
static double gives_more(const fw_mechanism *m, const fw_statics_modes *modes) {
    double most = 0;
    for (int k = 0; k < m->nhinge; k++)
        if (!m->hinge[k].stated) most = fmax(most, m->hinge[k].closed_form.error.stiffness);
    return most + 2 * (m->nhinge > 0 ? modes->ledger.hinge.error : 0);
}

/* the ways in which flexures are looked at; ways.n of them */
typedef struct ways {
    fw_verdict_way of[FW_VERDICT_WAYS];
    int n;
    double off; /* by which they are */
} ways;

static ways ways_of(const fw_mechanism *m, int scene, const fw_statics_modes *modes,
                    const fw_verdict_variant_verdict *v) {
    const double flexures = gives_more(m, modes), gives = fw_verdict_bending_of_any(v),
                 e = flexures + gives;
    if (!fw_verdict_grows(v, scene))
        return (ways){.of = {{.stiffer = 1 / (1 + e) - 1}, {.stiffer = e}}, .n = 2, .off = e};
    ways w = {.n = FW_VERDICT_WAYS};
    double bending, along;
    fw_verdict_off_by_itself(m, &bending, &along);
    const double step = 2 * (m->nhinge > 0 ? modes->ledger.hinge.error : 0);
    for (int k = 0; k < w.n; k++)
        w.of[k] = fw_verdict_way_of(k, bending + step, along, gives);
    w.off = isfinite(e) ? fmax(e, fmax(bending + step, along)) : e;
    return w;
}

static const char *no_equilibrium(fw_arena *arena, const ways *w, double missing, int which) {
    char off[32], part[32];
    return fw_arena_printf(arena,
                           "with flexures and bodies %s%s by the %s %% that they may be off%s%s%s "
                           "no stable equilibrium "
                           "was found, so that the device may have snapped: keep away from there",
                           w->of[which % w->n].stiffer > 0 ? "stiffer" : "softer",
                           w->n > 2 ? " in bending, and along themselves another way," : "",
                           fw_number_text(off, sizeof off, 100 * w->off, 2),
                           which >= w->n ? ", and electrodes that pull by " : "",
                           which >= w->n ? fw_number_text(part, sizeof part, 100 * missing, 2) : "",
                           which >= 2 * w->n ? " % less,"
                           : which >= w->n   ? " % more,"
                                             : "");
}

static const char other_side[] =
    "the way to its equilibrium leaves an unstable one to a side that nothing in the description "
    "decides, and on the other side no stable one was found: decide the side, by a force that is "
    "there from the beginning or by an angle of the flexures";
static const char many_sides[] =
    "the way to its equilibrium leaves more than one unstable one, each to a side that nothing in "
    "the description decides: decide the sides, by forces that are there from the beginning or by "
    "angles of the flexures";

/* are two equilibria at places of their own? */
static bool apart(const fw_statics_modes *a, const fw_statics_modes *b) {
    const double hardly = 1e-7;
    for (int i = 0; i < 3 * a->nbody; i++)
        if (fabs(a->q[i] - b->q[i]) > hardly * (i % 3 == 2 ? 1 : a->unit_length_m)) return true;
    return false;
}

/* Between a way with equilibria on two sides and one (`is`) without there is one where these part, by a fork or at a fold, and nothing
   holds the lowest mode: its frequency, and the stiffness of what takes part in it, go to 0. Error: its shape is that of `is`, which
   a fork shares. Source: Thompson and Hunt, A General Theory of Elastic Stability 1973. Test: test_heated.py, Forks */
static fw_status at_the_fold(fw_arena *arena, const fw_statics_modes *is,
                             fw_verdict_small_others *to) {
    const size_t n = (size_t)is->count;
    fw_statics_modes *fold = fw_arena_grow(arena, is, 1, 1, sizeof *is);
    FW_NEED(fold);
    FW_NEED(fold->mode = fw_arena_grow(arena, is->mode, n, n, sizeof *fold->mode));
    fw_statics_mode *lowest = fold->mode;
    while (lowest->kind == FW_MODE_FREE && lowest + 1 < fold->mode + n)
        lowest++;
    lowest->kind = FW_MODE_FREE;
    lowest->omega_rad_per_s = lowest->f_Hz = lowest->stiffness_per_s2 = 0;
    to->modes[to->count++] = fold;
    return FW_OK;
}

fw_status fw_verdict_small_again(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *of,
                                 int scene, const fw_statics_mode_options *given,
                                 const fw_statics_modes *modes, const fw_verdict_variant_verdict *v,
                                 fw_verdict_small_others *to) {
    *to = (fw_verdict_small_others){0};
    if (scene == FW_NONE || !modes) return FW_OK;
    to->at = modes;
    const ways w = ways_of(m, scene, modes, v);
    const double missing = fw_verdict_pull_missing(v, scene);
    if (!isfinite(w.off)) return FW_OK; /* bands have no ends then */
    const int pulls = !(missing > 0) ? 1 : fw_effects_levitation_may_be(m) ? 3 : 2;
    fw_device_scene now[3] = {*of, *of, *of}; /* as it is, more, less */
    FW_TRY(pull_times(arena, 1 + missing, &now[1]));
    FW_TRY(pull_times(arena, 1 / (1 + missing), &now[2]));
    const fw_statics_modes *one = NULL, *two = NULL; /* a way with one side, with two */
    for (int k = 0; k < w.n * pulls; k++) {
        const int before = to->count;
        fw_statics_mode_options o = *given;
        o.effects.hinge = modes->ledger.hinge.used, o.effects.like = NULL, o.effects.untold = true;
        o.effects.stiffer = w.of[k % w.n].stiffer, o.effects.along = w.of[k % w.n].along;
        for (int sides = 1; sides > 0; o.other_side = true) {
            const fw_statics_modes *found = NULL;
            const bool other = o.other_side;
            fw_diags own = fw_diags_new(arena);
            const fw_status status =
                fw_statics_small_motions(arena, m, &now[k / w.n], &o, &own, &found);
            if (status == FW_NOMEM || status == FW_CANCELLED) return status;
            const bool stands = status == FW_OK && found &&
                                !(found->count > 0 && found->mode[0].kind == FW_MODE_UNSTABLE);
            sides = stands && !other ? found->sides : 0;
            if (stands)
                to->modes[to->count++] = found;
            else if (!to->lost)
                FW_NEED(to->lost = other ? other_side : no_equilibrium(arena, &w, missing, k));
            if (stands && found->sides > 1) to->lost = many_sides;
        }
        if (to->count == before) continue;
        const bool both = to->count > before + 1 && apart(to->modes[before], to->modes[before + 1]);
        *(both ? &two : &one) = to->modes[before];
    }
    return two && one && one->count > 0 ? at_the_fold(arena, one, to) : FW_OK;
}

void fw_verdict_small_widen(const fw_verdict_small_others *others, const fw_probe *probe, int mode,
                            double times, fw_verdict_requirement *r) {
    double by[2] = {1, 1};
    for (int i = 0; i < others->count; i++) {
        const fw_statics_modes *now = others->modes[i];
        const double x = mode == 0            ? fw_probe_small(probe, now)
                         : mode <= now->count ? now->mode[mode - 1].f_Hz
                                              : (double)NAN;
        if (isnan(x)) continue;
        if (x == 0 || isinf(x)) r->lasting = HUGE_VAL; /* at a fold, whatever model is taken */
        r->low = fmin(r->low, x * fmin(1, times)), r->high = fmax(r->high, x * fmax(1, times));
    }
    if (others->at && mode > 0) r->high *= others->at->mode[mode - 1].raised;
    if (others->at) fw_probe_small_rubs(probe, others->at, mode, by);
    r->low *= by[0], r->high *= by[1], r->rubs = by[0] < 1 || by[1] > 1;
    if (others->lost) r->low = 0, r->high = HUGE_VAL;
}

const char *fw_verdict_small_open(fw_arena *arena, const fw_mechanism *m,
                                  const fw_statics_modes *modes,
                                  const fw_verdict_small_others *others) {
    bool turned = false; /* which way is not known */
    if (others->lost) return others->lost;
    for (int k = 0; k < m->nhinge; k++)
        turned = turned || !isfinite(m->hinge[k].axis_rad);
    return fw_arena_printf(arena, "%s%s",
                           modes->ledger.hinge.why ? modes->ledger.hinge.why : "nothing bounds it",
                           turned ? ": state its `axis`, or draw the bodies that it joins" : "");
}

/* ---- instants that stand for all of a scene ----
   What is of an equilibrium goes with the values of the laws alone. Those are looked at where the scene ends and begins,
   where laws begin another piece, where each is least and largest, and between two such instants. In: laws; out: s. Error:
   extremes of a smooth piece by samples, 32 to a turn of the fastest sine, which misses 0.5 % of its height. Test:
   test_probe.py */

enum { LAWS = 64, KEPT = FW_VERDICT_INSTANTS, SAMPLES = 20000 };

typedef struct laws {
    const fw_quantity_law *of[LAWS];
    int n;
    bool more; /* than there is room for */
    double end_s;
} laws;

static void take_law(laws *to, const fw_quantity_law *law) {
    if (fw_quantity_law_is_constant(law)) return;
    for (int i = 0; i < to->n; i++)
        if (to->of[i] == law) return;
    if (to->n == LAWS)
        to->more = true;
    else
        to->of[to->n++] = law;
}

static void laws_of(const fw_mechanism *m, const fw_device_scene *s, laws *to) {
    *to = (laws){.end_s = s->duration_s};
#define TAKE(kind)                                                                                 \
    for (int i = 0; i < s->n##kind; i++)                                                           \
    take_law(to, s->kind[i].law)
    TAKE(force);
    TAKE(torque);
    TAKE(tendon);
    TAKE(comb);
    TAKE(part);
    TAKE(temperature);
    TAKE(base);
#undef TAKE
    for (int i = 0; i < m->ndriver; i++)
        take_law(to, &m->driver[i].law);
}

/* as a scene that ends then has it: the value before a jump */
static double value_at(const laws *l, int law, double t_s) {
    double value[3];
    fw_quantity_law_value(l->of[law], t_s, t_s * (1 - 1e-9), value);
    return value[0];
}

static bool are_alike(const laws *l, double a_s, double b_s) {
    for (int i = 0; i < l->n; i++) {
        const double a = value_at(l, i, a_s), b = value_at(l, i, b_s);
        if (!(fabs(a - b) <= 1e-6 * fmax(fmax(fabs(a), fabs(b)), 1e-3))) return false;
    }
    return true;
}

/* false: there is no room for it */
static bool add_instant(const laws *l, double t_s, double at[KEPT], int *n) {
    for (int i = 0; i < *n; i++)
        if (are_alike(l, at[i], t_s)) return true;
    if (*n == KEPT) return false;
    at[(*n)++] = t_s;
    return true;
}

static bool add_extremes(const laws *l, int law, double at[KEPT], int *n) {
    const double turns = l->end_s * fw_quantity_law_wave_of(l->of[law]).fastest_Hz;
    const int samples = (int)fmin(fmax(256, 32 * turns), SAMPLES);
    double least_s = l->end_s, most_s = l->end_s, low = value_at(l, law, l->end_s), high = low;
    for (int i = 1; i < samples; i++) {
        const double t = l->end_s * i / samples, value = value_at(l, law, t);
        if (value < low) low = value, least_s = t;
        if (value > high) high = value, most_s = t;
    }
    return add_instant(l, least_s, at, n) && add_instant(l, most_s, at, n);
}

static bool add_breaks(const laws *l, int law, double at[KEPT], int *n) {
    double break_s[4 * KEPT];
    const int count = fw_quantity_law_breaks_of(l->of[law], l->end_s, break_s, 4 * KEPT);
    for (int i = 0; i < count && i < 4 * KEPT; i++)
        if (!add_instant(l, break_s[i], at, n)) return false;
    return count <= 4 * KEPT;
}

int fw_verdict_instants(const fw_mechanism *m, const fw_device_scene *scene, bool between,
                        double at_s[FW_VERDICT_INSTANTS]) {
    laws l;
    int n = 1;
    laws_of(m, scene, &l);
    at_s[0] = l.end_s;
    if (l.n == 0) return 1;
    bool all = !l.more && add_instant(&l, 1e-6 * l.end_s, at_s, &n);
    for (int i = 0; i < l.n && all; i++)
        all = add_breaks(&l, i, at_s, &n) && add_extremes(&l, i, at_s, &n);
    if (!all) return 0;
    double sorted[FW_VERDICT_INSTANTS];
    const int ends = n;
    memcpy(sorted, at_s, (size_t)n * sizeof *sorted);
    fw_sort_doubles(sorted, (size_t)ends);
    for (int i = 1; i < ends && between && all; i++)
        all = add_instant(&l, 0.5 * (sorted[i - 1] + sorted[i]), at_s, &n);
    return n;
}

double fw_verdict_laws_go_on_s(const fw_mechanism *m, const fw_device_scene *scene) {
    laws l;
    double longest = 0;
    laws_of(m, scene, &l);
    for (int i = 0; i < l.n; i++) {
        const double f_Hz = fw_quantity_law_wave_of(l.of[i]).fastest_Hz;
        bool alike = true;
        for (int k = 1; k <= 8; k++) /* no period of a sine has all of these */
            alike = alike && are_alike(&(laws){.of = {l.of[i]}, .n = 1, .end_s = l.end_s}, l.end_s,
                                       l.end_s * (1 - 1e-3 * k * (1 + 0.07 * k)));
        if (!alike) longest = fmax(longest, fmax(0.25 * l.end_s, f_Hz > 0 ? 1 / f_Hz : 0));
    }
    return l.more ? l.end_s : fmin(longest, l.end_s);
}

/* by how much a bound is missed; however far it is, what is nearest to it is the worst. What is not known there is not known */
static double worst_miss(const fw_verdict_requirement *r) {
    if (r->why || isnan(r->value)) return HUGE_VAL;
    return fmax(isnan(r->min) ? -HUGE_VAL : r->min - r->low,
                isnan(r->max) ? -HUGE_VAL : r->high - r->max);
}

/* The worse of two instants stays; what is beyond a bound for certain at one of them is so, whatever is not known at others. A
   band of two bounds holds those of all instants. */
static void take_worse(const fw_verdict_requirement *best, fw_verdict_requirement *now) {
    const fw_verdict_requirement then = *now;
    const bool out = best->decision == FW_REJECT, then_out = then.decision == FW_REJECT;
    if (out != then_out ? out : worst_miss(best) >= worst_miss(&then)) *now = *best;
    if (out || then_out || isnan(now->min) || isnan(now->max) || now->why) return;
    now->low = fmin(best->low, then.low), now->high = fmax(best->high, then.high);
    if (now->low < now->min || now->high > now->max) now->decision = FW_INCONCLUSIVE;
    now->utilisation_high = fmax(best->utilisation_high, then.utilisation_high);
}

static const fw_device_scene without_loads = {.name = "(none)", .duration_s = 1};

fw_status fw_verdict_requirements_along(fw_arena *arena, const fw_mechanism *m,
                                        const fw_dynamics_motion_options *options, int scene,
                                        fw_verdict_judge_small *judge,
                                        fw_verdict_variant_verdict *v) {
    const size_t size = (size_t)v->nrequirement;
    fw_verdict_requirement *fresh = fw_arena_array(arena, fw_verdict_requirement, 2 * size);
    fw_device_scene s = scene == FW_NONE ? without_loads : m->device->scene[scene];
    double at_s[FW_VERDICT_INSTANTS];
    const int n = scene == FW_NONE ? 1 : fw_verdict_instants(m, &s, !v->corner, at_s);
    if (scene == FW_NONE) at_s[0] = s.duration_s;
    FW_NEED(fresh);
    fw_verdict_requirement *best = fresh + size;
    memcpy(fresh, v->requirement, size * sizeof *fresh);
    for (int i = 0; i < n; i++) {
        s.duration_s = at_s[i];
        memcpy(best, v->requirement, size * sizeof *best);
        for (int k = 0; k < v->nrequirement; k++)
            if (!fresh[k].measure && fresh[k].scene_index == scene) v->requirement[k] = fresh[k];
        FW_TRY(judge(arena, m, options, &s, scene, v));
        for (int k = 0; k < v->nrequirement; k++) {
            fw_verdict_requirement *r = &v->requirement[k];
            if (r->measure || r->scene_index != scene) continue;
            if (n > 1) r->t_s = at_s[i];
            if (i > 0) take_worse(&best[k], r);
        }
    }
    for (int k = 0; k < v->nrequirement && n == 0; k++)
        if (!v->requirement[k].measure && v->requirement[k].scene_index == scene)
            v->requirement[k].why = "loads are at an extreme at more instants of its scene than "
                                    "are looked at; put parts of it into scenes of their own";
    return FW_OK;
}

/* ---- the slowest mode ---- */

static fw_status longest_period(fw_arena *arena, const fw_mechanism *m,
                                const fw_device_scene *scene, bool at_equilibrium,
                                double *period_s) {
    const fw_statics_mode_options o = {.accuracy = 1e-3, .at_equilibrium = at_equilibrium};
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

/* They rest on the mechanism and the scene alone: found once, however many requirements and motions ask. Cost: all
   modes, of n unknowns some 30 n^3. Test: test_closer.c, a_slowest_period_is_kept */
fw_status fw_verdict_longest_period(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                                    bool at_equilibrium, double *period_s) {
    double *kept = &v->slowest_s[2 * scene + (at_equilibrium ? 1 : 0)];
    if (*kept == 0) {
        const fw_mechanism *m = v->mechanism;
        FW_TRY(longest_period(arena, m, &m->device->scene[scene], at_equilibrium, period_s));
        *kept = *period_s > 0 ? *period_s : -1; /* nothing swings */
    }
    *period_s = fmax(0, *kept);
    return FW_OK;
}

fw_status fw_verdict_slowest_s(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                               double *period_s) {
    double loaded_s;
    FW_TRY(fw_verdict_longest_period(arena, v, scene, false, period_s));
    FW_TRY(fw_verdict_longest_period(arena, v, scene, true, &loaded_s));
    *period_s = fmax(*period_s, loaded_s);
    return FW_OK;
}

/* ---- where a motion comes to rest ----
   In: the course of a probe that was kept, the loads as they are at the scene's end. Out: the equilibrium under these, where
   the course ends about it; where loads go on, friction holds it anywhere within a range, or none is found, the middle of what the
   course goes over in the last period of the slowest mode, off by half of that. The value at the last instant is neither:
   where a scene ends it may be anywhere in its ring. Cost: modes and an equilibrium. Test: test_probe.py,
   test_a_settling_time_does_not_go_with_the_length_of_a_scene */

/* NaN: none is found, or it is one of many */
static fw_status equilibrium_at(fw_arena *arena, const fw_mechanism *m, int scene,
                                const fw_dynamics_motion *motion, int probe, double *at) {
    const fw_device_scene *s = &m->device->scene[scene];
    const fw_statics_static_options o = {.effects.hinge = motion->ledger.hinge.used,
                                         .effects.untold = true};
    const fw_statics *found = NULL;
    fw_diags own = fw_diags_new(arena);
    fw_probe *bound;
    *at = (double)NAN;
    const fw_status status = fw_statics_solve(arena, m, s, &o, &own, &found);
    if (status == FW_CANCELLED || status == FW_NOMEM) return status;
    if (status != FW_OK || !found || found->negative > 0 || found->loose ||
        (found->friction && !found->friction->why))
        return FW_OK;
    FW_TRY(fw_probe_bind(arena, m, s, found->loads, &bound));
    *at = fw_probe_at_equilibrium(&bound[probe], s, found);
    return FW_OK;
}

fw_status fw_verdict_rests_at(const fw_verdict_variant_verdict *v, int scene,
                              const fw_dynamics_motion *motion, const fw_probe_monitor *monitor,
                              const fw_device_requirement *q, fw_verdict_rest *rest) {
    const fw_mechanism *m = v->mechanism;
    const fw_probe_course *c = &monitor->course[q->probe];
    double low, high, at;
    *rest = (fw_verdict_rest){.at = c->final};
    if (motion->loads && motion->loads->quasi_static) return FW_OK;
    FW_TRY(fw_verdict_slowest_s(monitor->arena, v, scene, &rest->period_s));
    if (!(rest->period_s > 0))
        rest->period_s = motion->end_s; /* nothing says how slowly it swings */
    const double goes_on_s = fw_verdict_laws_go_on_s(m, &m->device->scene[scene]);
    rest->period_s = fmax(rest->period_s, goes_on_s);
    fw_probe_range(c, motion->end_s - rest->period_s, &low, &high);
    if (goes_on_s > 0)
        at = (double)NAN; /* no one instant's equilibrium is where it comes to rest */
    else
        FW_TRY(equilibrium_at(monitor->arena, m, scene, motion, q->probe, &at));
    const double beyond = fmax(0, fmax(low - at, at - high));
    if (isnan(at)) {
        rest->at = 0.5 * (low + high), rest->off = 0.5 * (high - low);
    } else if (beyond <= fmax(high - low, 0.1 * q->band)) {
        rest->at = at, rest->off = beyond > high - low ? beyond : 0;
    } else {
        rest->why = "the scene ends away from the equilibrium under its last loads, and not about "
                    "another one that is known: give the scene a longer duration";
    }
    return FW_OK;
}

/* ---- what is required of motions that are found again (moved_again.c) ---- */

static double measured(const fw_probe_course *c, const fw_device_requirement *q) {
    const double most = c->maximum.value, least = c->minimum.value;
    switch (q->measure) {
    case FW_MEASURE_PEAK:
        return fmax(fabs(most), fabs(least));
    case FW_MEASURE_MAXIMUM:
        return most;
    case FW_MEASURE_MINIMUM:
        return least;
    case FW_MEASURE_FINAL:
        return c->final;
    case FW_MEASURE_PEAK_TO_PEAK:
        return most - least;
    case FW_MEASURE_SETTLING: /* settling */
        break;
    case FW_MEASURE_PARASITIC:
        return fabs(c->across.value);
    }
    return (double)NAN;
}

/* from the middle of what it goes over in the last period of the slowest mode */
static fw_status settling(const fw_verdict_variant_verdict *v, const fw_verdict_other *o,
                          const fw_device_requirement *q, int scene, double *s) {
    const fw_probe_course *c = &o->probe->course[q->probe];
    double slowest_s, low, high;
    FW_TRY(fw_verdict_slowest_s(o->probe->arena, v, scene, &slowest_s));
    fw_probe_range(c, o->motion->end_s - slowest_s, &low, &high);
    *s = fw_probe_settling_s(c, 0.5 * (low + high), q->band);
    return FW_OK;
}

static bool goes_with_loads(const fw_device_probe *p, fw_device_measure measure) {
    return measure != FW_MEASURE_SETTLING &&
           (p->row == FW_PROBE_IS_force || p->row == FW_PROBE_IS_torque ||
            p->row == FW_PROBE_IS_power);
}

/* what a band has beside what the other device has in its place */
static double beside(const fw_verdict_requirement *r, double off) {
    return fmax(r->numeric, fmin(r->high - r->value, r->value - r->low) - off * fabs(r->swing));
}

/* a final value is anywhere in the ring of that motion, too */
static fw_status take_in(const fw_verdict_variant_verdict *v, const fw_verdict_other *o,
                         const fw_device_requirement *q, double now, double rest,
                         fw_verdict_requirement *r) {
    double low = now - rest, high = now + rest, slowest_s;
    if (o->from_s > 0 && q->measure == FW_MEASURE_FINAL) { /* all that comes behind the end */
        fw_probe_range(&o->probe->course[q->probe], o->from_s, &low, &high);
        if (goes_with_loads(&v->mechanism->device->probe[q->probe], q->measure))
            low /= o->by, high /= o->by;
        rest *= fmax(1, fmax(fabs(low), fabs(high)) / fmax(fabs(r->value), DBL_MIN));
        low -= rest, high += rest;
    } else if (q->measure == FW_MEASURE_FINAL &&
               !(o->motion->loads && o->motion->loads->quasi_static)) {
        fw_probe_ring ring;
        FW_TRY(fw_verdict_slowest_s(o->probe->arena, v, r->scene_index, &slowest_s));
        fw_probe_rings(&o->probe->course[q->probe], slowest_s, &ring);
        if (ring.amplitude > 0)
            low = fmin(now, ring.low) - r->numeric, high = fmax(now, ring.high) + r->numeric;
    }
    r->low = fmin(r->low, low), r->high = fmax(r->high, high);
    return FW_OK;
}

fw_status fw_verdict_requirement_others(const fw_verdict_variant_verdict *v,
                                        const fw_verdict_shaken *s, fw_verdict_requirement *r) {
    const fw_mechanism *m = v->mechanism;
    const fw_device_requirement *q = &m->device->requirement[r->asked];
    const fw_device_probe *of = &m->device->probe[q->probe];
    const fw_verdict_requirement was = *r;
    const double value = r->value;
    const bool anywhere = q->measure == FW_MEASURE_FINAL || q->measure == FW_MEASURE_SETTLING;
    double now[4] = {(double)NAN, (double)NAN, (double)NAN, (double)NAN};
    for (int k = 0; k < 4; k++) {
        const fw_verdict_other *o = &s->other[k];
        if (q->measure == FW_MEASURE_SETTLING && o->from_s > 0)
            continue; /* it goes on behind the end: open */
        if (!o->asked || o->lost || !o->probe || o->probe->course[q->probe].count == 0) continue;
        now[k] = measured(&o->probe->course[q->probe], q);
        if (q->measure == FW_MEASURE_SETTLING) FW_TRY(settling(v, o, q, r->scene_index, &now[k]));
        if (goes_with_loads(of, q->measure)) now[k] /= o->by;
        r->untouched =
            r->untouched || (r->size && value > 0 && now[k] == 0 && of->row == FW_PROBE_IS_force);
        FW_TRY(take_in(v, o, q, now[k], beside(&was, o->off), r));
    }
    if (value != 0) r->lasting += fmax(was.low - r->low, r->high - was.high) / fabs(value);
    if (s->other[2].lost || s->other[3].lost) { /* what it went by then it went */
        const bool side = s->other[3].lost;
        if (side || anywhere || q->measure == FW_MEASURE_MINIMUM) r->low = -HUGE_VAL;
        if (side || q->measure != FW_MEASURE_MINIMUM) r->high = HUGE_VAL;
        r->open =
            side ? "it may go to another side (FW-D747)" : "its scene ends on its way (FW-D746)";
    }
    if (s->other[0].lost) { /* away from where the stiffer one is */
        if (anywhere || !(now[1] < value)) r->low = -HUGE_VAL;
        if (anywhere || !(now[1] > value)) r->high = HUGE_VAL;
        r->open = "with flexures as soft and a pull as strong as they may be no motion to its end "
                  "was found";
    }
    if (r->size || isnan(r->origin)) r->low = fmax(0, r->low);
    fw_verdict_swings_required(v, r);
    return FW_OK;
}
