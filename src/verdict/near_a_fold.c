/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes that are moved again, since one motion does not give the band: longer, where the device still goes up at their end;
   with larger and smaller loads, where these leave little of the stiffness; with flexures that are not made quite straight,
   where they pass an unstable equilibrium.

   Longer: a hinge whose peak is at the last instant and that still turns on, by more than a few per cent of it in the lowest mode:
   v/omega. The same scene then lasts a period of that mode longer, in which every single mode comes to its next peak. Where its
   loads stay what they are, or leave so little of the stiffness that it may run away from its equilibrium, they are held, and
   what it comes to is in the bands (held_on); else they go on as their laws say, and nobody asked for what comes. In: the motion
   with inertia; of a row of equilibria the bound of inertia says that little comes behind it. Test: test_program.py, EndsEarly */
#include "base/constants.h"
#include "base/sort.h"
#include "effects/effects.h"
#include "quantity/law_kind.h"
#include "statics/statics.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <float.h>
#include <math.h>
#include <string.h>

static const double fw_few_per_cent = 0.03, fw_hardly_turned = 1e-3; /* of what a hinge bears */

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

/* all loads and drivers stay from the scene's end on what they are there; the scene has arrays of its own */
static fw_status hold_loads(fw_arena *arena, fw_device_scene *s, const fw_mechanism **m) {
    const double at_s = s->duration_s;
    fw_mechanism *own = fw_arena_one(arena, fw_mechanism);
    FW_NEED(own);
    *own = **m;
#define HOLD(kind)                                                                                 \
    for (int i = 0; i < s->n##kind; i++)                                                           \
        if (s->kind[i].law)                                                                        \
    FW_NEED(s->kind[i].law = fw_quantity_law_hold(arena, s->kind[i].law, at_s))
    HOLD(force);
    HOLD(torque);
    HOLD(tendon);
    HOLD(comb);
    HOLD(part);
    HOLD(temperature);
    HOLD(base);
#undef HOLD
    const size_t n = (size_t)own->ndriver;
    FW_NEED(own->driver = fw_arena_grow(arena, own->driver, n, n, sizeof *own->driver));
    for (size_t i = 0; i < n; i++)
        own->driver[i].law.held_s = at_s;
    *m = own;
    return FW_OK;
}

static bool loads_rest(const fw_mechanism *m, const fw_device_scene *s) {
    bool rest = true;
#define RESTS(kind)                                                                                \
    for (int i = 0; i < s->n##kind; i++)                                                           \
    rest = rest && fw_quantity_law_rests(s->kind[i].law, s->duration_s)
    RESTS(force);
    RESTS(torque);
    RESTS(tendon);
    RESTS(comb);
    RESTS(part);
    RESTS(temperature);
    RESTS(base);
#undef RESTS
    for (int i = 0; i < m->ndriver; i++)
        rest = rest && fw_quantity_law_rests(&m->driver[i].law, s->duration_s);
    return rest;
}

/* What comes behind the end belongs to the scene: its loads have come to where they stay, so that who asks for a final value
   means what the device comes to; or they leave so little that what moves is no longer theirs but falls, whatever they do then */
static bool counts_behind(const fw_verdict_variant_verdict *v, int scene) {
    const double runs_away = 0.25; /* of the stiffness */
    const fw_mechanism *m = v->mechanism;
    return v->left[scene] < runs_away || loads_rest(m, &m->device->scene[scene]);
}

static fw_status last_longer(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                             const fw_dynamics_motion *x, double more_s, bool held,
                             const fw_dynamics_motion_options *options,
                             const fw_dynamics_motion **longer) {
    fw_device_scene changed = *scene;
    fw_dynamics_motion_options o = *options;
    fw_diags own = fw_diags_new(arena);
    FW_TRY(fw_device_own_scene(arena, &changed));
    if (held) FW_TRY(hold_loads(arena, &changed, &m));
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
                            double period_s, bool counts) {
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
        "period of the lowest mode it goes on to %s deg%s, %s%s, %s; let the scene last %s ms at "
        "least",
        FW_NAMED("scene", scene->name), fw_number_text(end, sizeof end, 1e3 * x->end_s, 4),
        fw_text_name(m->pin[pin].id), fw_number_text(at, sizeof at, peak * degree, 3),
        fw_number_text(to, sizeof to, far * degree, 3), longer ? "" : " by its speed alone",
        fw_number_text(by, sizeof by, times ? far / peak : 100 * (far / peak - 1), 2),
        times ? " times as far" : " % farther",
        counts ? "which the bands hold" : "and nothing of that is judged",
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
    FW_TRY(fw_verdict_longest_period(arena, v, (int)(scene - m->device->scene), false, &period_s));
    const int k = goes_on(m, x, period_s);
    if (k == FW_NONE) return FW_OK;
    const bool counts = counts_behind(v, (int)(scene - m->device->scene));
    FW_TRY(last_longer(arena, m, scene, x, period_s, counts, options, &longer));
    const char *text = would_go(arena, m, scene, x, longer, k, period_s, counts);
    if (!text) return FW_OK;
    fw_diag_warning(diags, 691, scene->place, "%s", text);
    if (!v->ends_early && !counts) v->ends_early = text;
    return FW_OK;
}

/* ---- what loads leave of the stiffness, and what may be missing of a pull ----
   Bands hold what a stiffness is off by in proportion, and a displacement goes by what loads leave of it: by the inverse of
   that share, and without end at a fold. So where a scene's loads leave less than `soft` of it, the scene is moved twice
   more, with its loads (1 + e) and 1/(1 + e) times as large. e is the relative error of the hinges' compliance, with that of
   bodies where that changes the motion: that is
   the device with all of its stiffness so much less, or more. Electrodes may pull more than computed by what is missing of
   their fringe (fw_effects_comb_fringe), and over a carrier that conducts as much less: the softer device has all of that pull
   wherever electrodes act, the stiffer one the least of it. What probes read in these motions is in their bands, forces over (1 + e); of
   hinges what strains go beyond proportion is a factor, as near a resonance, and of bodies the largest ratio of displacements
   of any body that moves by more than a twentieth of the farthest. Where there is no such motion the device may have snapped: undecided.
   Inputs: v->left, motions. Error: one e for all that gives; heat, stress and drivers stay as they are. Cost: two motions,
   of such scenes alone; where only electrodes may pull more one, or two over a carrier that conducts. Test: test_effects.py, NearAFold; test_near_pull_in.py, Motions */

static const double soft = 0.8;

/* largest (sign 1) or least (-1) of now over was, of those of n that move by more than FW_VERDICT_HARDLY_MOVES of the farthest; 1: none moves */
static double change(const double *was, const double *now, int n, int sign) {
    const double most = fw_verdict_most_of(was, n);
    double by = sign > 0 ? 0 : HUGE_VAL;
    for (int i = 0; i < n; i++)
        if (was[i] > FW_VERDICT_HARDLY_MOVES * most)
            by = sign > 0 ? fmax(by, now[i] / was[i]) : fmin(by, now[i] / was[i]);
    return most > 0 ? by : 1;
}

/* ---- to the other side ----
   Nothing is made quite straight, and where a scene passes an unstable equilibrium the least deviation decides the side. So what
   left such a place to one side is moved again with flexures that are made in the shape of the mode that became free (Koiter), the
   other way, the middle of one aside of the line between its ends by `aside`: a force that acts through it has that eccentricity.
   The flows that come with the program take printed edges to lie within 0.15 um of where they are drawn, and both edges of a
   strip together less; no centre of a body then lies farther aside, either. No mask has edges on less than its grid of 1 nm, no laser writer much below 50 nm. Bands hold what it
   does then, on whichever side. Out: factors, bands. Error: an imperfection of one shape and size. Cost: looks and one motion of
   scenes that pass such a place. Source: W. T. Koiter, Delft 1945. Test: test_effects.py, OneOfTwoSides */

static const double aside_um = 0.1;

/* the law by which the scene's loads come, which what they press does, too; NULL: they are there at once */
static const fw_quantity_law *law_of(const fw_device_scene *s) {
#define FIRST(kind)                                                                                \
    for (int i = 0; i < s->n##kind; i++)                                                           \
        if (s->kind[i].law && !fw_quantity_law_goes_to_and_fro(s->kind[i].law, s->duration_s))     \
    return s->kind[i].law
    FIRST(force);
    FIRST(torque);
    FIRST(temperature);
    FIRST(tendon);
    FIRST(comb);
    FIRST(base);
    FIRST(part);
#undef FIRST
    return NULL;
}

static fw_status put_aside(fw_arena *arena, const fw_mechanism *m, const fw_statics_passed *p,
                           fw_device_scene *s) {
    const fw_quantity_law *law = law_of(s);
    const double by = aside_um / fmax(fw_quantity_law_largest(law, s->duration_s), DBL_MIN);
    const size_t nf = (size_t)s->nforce, nt = (size_t)s->ntorque, n = 2 * (size_t)m->nhinge;
    FW_NEED(s->force = fw_arena_grow(arena, s->force, nf, nf + n, sizeof *s->force));
    FW_NEED(s->torque = fw_arena_grow(arena, s->torque, nt, nt + n, sizeof *s->torque));
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        const double *f = p->wrench + 3 * (i / 2), sign = i % 2 ? by : -by;
        const int body = i % 2 ? pin->body_b : pin->body_a;
        if (body == FW_GROUND) continue;
        s->torque[s->ntorque++] = (fw_device_torque){
            .body = body, .value_Nm = sign * f[0], .law = law, .place = s->place};
        if (f[1] == 0 && f[2] == 0) continue;
        s->force[s->nforce++] = (fw_device_force){.body = body,
                                                  .x_m = i % 2 ? pin->bx_m : pin->ax_m,
                                                  .y_m = i % 2 ? pin->by_m : pin->ay_m,
                                                  .fx_N = sign * f[1],
                                                  .fy_N = sign * f[2],
                                                  .law = law,
                                                  .place = s->place};
    }
    return FW_OK;
}

/* a scene once more: softer, with all of the pull; stiffer, with the least of it; held on; with flexures bent the other way */
typedef struct once_more {
    double by, pull; /* its loads, and what electrodes pull besides, times as large */
    double
        stiffer; /* or its flexures, by that share: where something may be met, which is as stiff as it is */
    double from_s;   /* it was held on from there; 0: it was not */
    double period_s; /* of the lowest mode, where what is behind the scene's end counts; else 0 */
    const fw_statics_passed *aside;
    double *far; /* of fw_verdict_farthest */
    bool asked, goes,
        falls; /* falls: what it rests on is unstable, so that the least motion counts */
    fw_verdict_strain_monitor saw;
    const fw_dynamics_motion *motion; /* where it goes */
} once_more;

/* to->goes false: there is no such motion, or it is not the whole of it */
static fw_status move_it(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                         const fw_dynamics_motion *like, const fw_dynamics_motion_options *given,
                         once_more *to) {
    fw_dynamics_motion_options o = *given;
    fw_diags own = fw_diags_new(arena);
    const fw_dynamics_motion *x;
    const bool probes = to->saw.probe != NULL;
    fw_statics_move_like(like, &o);
    fw_verdict_strain_monitor_watch(&to->saw, &o);
    if (like->loads->quasi_static) o.glance = NULL; /* thirds of its steps are far apart */
    o.trace = probes ? fw_verdict_clearance_trace : NULL, o.whole = probes;
    o.most_angle_rad = FW_TURN, o.effects.like = NULL, o.effects.stiffer = to->stiffer;
    const fw_status status = fw_statics_move_scene(arena, m, scene, &o, &own, &x);
    if (status == FW_NOMEM || status == FW_CANCELLED || to->saw.no_memory)
        return status == FW_CANCELLED ? status : FW_NOMEM;
    to->goes = status == FW_OK && !x->ended;
    if (to->goes) to->motion = x;
    return FW_OK;
}

/* it is still on its way, by more than what a hinge hardly turns */
static bool on_its_way(const fw_mechanism *m, const once_more *to, const fw_dynamics_motion *x) {
    if (!(to->period_s > 0) || x->loads->quasi_static || x->ended || x->nsample < 1) return false;
    fw_dynamics_motion_rows(x, x->nsample - 1, 1);
    const int k = goes_on(m, x, to->period_s);
    if (k == FW_NONE) return false;
    const double on = turns_on(m, x, k) * to->period_s / (2 * FW_PI),
                 far = fabs(x->peak[m->hinge[k].pin].angle_rad) + on;
    return to->falls || far > fw_hardly_turned * m->hinge[k].closed_form.limit_angle_rad;
}

/* Held on for 2, 8, 32, 128 periods, until it has come to a peak or to rest: what grows e-fold in a few of them has then. What has
   not is not known */
static fw_status move_with(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                           const fw_dynamics_motion *like, const fw_dynamics_motion_options *given,
                           once_more *to) {
    const double periods[] = {2, 8, 32, 128};
    fw_device_scene changed = *scene;
    FW_TRY(fw_device_own_scene(arena, &changed));
    fw_effects_scale(&changed, to->by);
    for (int i = 0; i < changed.ncomb; i++)
        changed.comb[i].voltage_V *= sqrt(to->pull);
    if (to->aside) FW_TRY(put_aside(arena, m, to->aside, &changed));
    const bool held = to->from_s > 0; /* it is on its way at the end */
    if (!held) FW_TRY(move_it(arena, m, &changed, like, given, to));
    if (held || (to->goes && on_its_way(m, to, to->motion))) {
        const fw_mechanism *own = m;
        to->from_s = scene->duration_s, to->goes = true;
        FW_TRY(hold_loads(arena, &changed, &own));
        for (int k = 0; k < 4; k++) {
            changed.duration_s = to->from_s + periods[k] * to->period_s;
            FW_TRY(move_it(arena, own, &changed, like, given, to));
            if (!to->goes || !on_its_way(m, to, to->motion)) break;
            if (k == 3) to->goes = false;
        }
    }
    if (to->goes) fw_verdict_farthest(m, to->motion, to->far);
    return FW_OK;
}

/* strains of a hinge, now over as computed; 1 of one that is hardly strained */
static double strained(const fw_mechanism *m, const fw_verdict_strain_monitor *was,
                       const fw_verdict_strain_monitor *now, int k) {
    const double hardly = 1e-3;
    double most = 0;
    for (int i = 0; i < m->nhinge; i++)
        most = fmax(most, was->hinge[i].strain.value);
    return was->hinge[k].strain.value > hardly * most
               ? now->hinge[k].strain.value / was->hinge[k].strain.value
               : 1;
}

/* what of all goes beyond what its loads change by, into the factors; the most of it */
static double beyond(const fw_mechanism *m, const fw_verdict_strain_monitor *was, const double *far,
                     const once_more *now, int way, fw_verdict_shaken *to) {
    const int nb = m->nbody, end = 2 * m->nhinge;
    double *f = to->factor;
    const double goes = now->by / (1 + now->stiffer), up = fmin(1, 1 / goes),
                 down = fmax(1, 1 / goes),
                 all = way * fmax(way * change(far, now->far, nb, way),
                                  way * change(far + nb, now->far + nb, nb, way));
    double most = up * all;
    for (int h = 0; was && h < m->nhinge; h++) {
        const double by = strained(m, was, &now->saw, h);
        f[2 * h] = fmax(f[2 * h], up * by), f[2 * h + 1] = fmin(f[2 * h + 1], down * by);
        most = fmax(most, up * by);
    }
    f[end] = fmax(f[end], up * all), f[end + 1] = fmin(f[end + 1], down * all);
    to->late = fmax(to->late, fmax(up * all - 1, 1 - down * all));
    return most;
}

enum { PULLED_IN = 248, UNSTABLE = 259 };

static fw_status tell_soft(fw_arena *arena, const fw_device_scene *s, double left, double e,
                           double missing, bool goes, double most, bool brief, fw_diags *diags,
                           fw_verdict_variant_verdict *v) {
    char part[32], off[32], pull[32], times[32];
    if (fw_verdict_has_said(v, s, PULLED_IN)) return FW_OK;
    const char *start = fw_arena_printf(
        arena,
        "%s%s: its loads leave %s %% of the stiffness of the device's softest motion, and with "
        "loads larger by the %s %% that hinges and bodies may give more than computed%s%s%s",
        FW_NAMED("scene", s->name), fw_number_text(part, sizeof part, 100 * left, 2),
        fw_number_text(off, sizeof off, 100 * e, 2),
        missing > 0 ? ", and electrodes that pull " : "",
        missing > 0 ? fw_number_text(pull, sizeof pull, 100 * missing, 2) : "",
        missing > 0 ? " % more," : "");
    FW_NEED(start);
    if (!goes)
        return fw_verdict_scene_reason(
            v, s, 672, FW_INCONCLUSIVE, 0.9 / (1 + e) / (1 + missing),
            fw_arena_printf(arena, "%s no motion to its end was found: it may snap", start));
    if (!brief && most > 1.1 * (1 + missing))
        fw_diag_warning(
            diags, 672, s->place,
            "%s it moves %s times as far, which the bands hold: keep away from where it "
            "snaps or buckles (flexwright statics --path says where that is)",
            start, fw_number_text(times, sizeof times, most * (1 + e), 3));
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* What loads take of a strip's stiffness they take by the S in which it bends beside its turn, and what they leave is off by what
   that is: of leaves across, where fillets and roots stiffen them otherwise than as they turn, and solids differ by more.
   (Crossed leaves of 1 mm that turn about their middles buckle at 99.8 % of the load computed in plane solids, whose stiffness
   is 99.95 % against turns, and 99.84 % across.) */
static double off_by(const fw_mechanism *m, double e) {
    double bending, along;
    fw_verdict_off_by_itself(m, &bending, &along);
    return e + fmax(0, bending - fw_verdict_motion_lasting_error(m));
}

/* ---- all of them ---- */

enum { SOFTER, STIFFER, HELD, ASIDE };

/* of a final value all that comes behind the end counts, and its whole course is kept */
static fw_status keep_courses(fw_arena *arena, const fw_mechanism *m, fw_probe_monitor *probe) {
    bool *all;
    if (!probe) return FW_OK;
    FW_NEED(all = fw_arena_array(arena, bool, (size_t)m->device->nprobe));
    for (int i = 0; i < m->device->nprobe; i++)
        all[i] = true;
    probe->history = all;
    return FW_OK;
}

static fw_status watch(fw_arena *arena, const fw_mechanism *m, int i, double *far,
                       const fw_verdict_required *required, const fw_verdict_variant_verdict *v,
                       once_more now[4]) {
    const size_t n = 2 * (size_t)m->nbody + (size_t)m->nhinge;
    fw_probe_monitor *probe[4];
    FW_TRY(required->watch(arena, m, i, v, true, probe));
    FW_TRY(required->watch(arena, m, i, v, true, probe + 2));
    for (int k = 0; k < 4; k++) {
        now[k].far = far + ((size_t)k + 1) * n;
        if (!now[k].asked) continue;
        FW_TRY(fw_verdict_strain_monitor_new(arena, m, false, &now[k].saw));
        FW_TRY(keep_courses(arena, m, probe[k]));
        now[k].saw.probe = probe[k];
    }
    return FW_OK;
}

/* which of them: loads leave little, electrodes may pull more, something may be met; it is on its way; it left what was unstable */
static fw_status ask(fw_arena *arena, const fw_mechanism *m, int i, double e, double missing,
                     bool met, const fw_verdict_variant_verdict *v, once_more now[4]) {
    const fw_device_scene *s = &m->device->scene[i];
    const fw_dynamics_motion *x = v->motion[i];
    const bool less = missing > 0 && fw_effects_levitation_may_be(m),
               softly = soft > v->left[i] && e > 0, falls = v->left[i] <= 0;
    fw_effects_load_scaling loads;
    fw_effects_find_loads(s, &loads);
    const bool may = loads.count > 0 && e >= 0 && !isinf(e);
    double period_s = 0;
    /* exact beams of stated stiffnesses are off by nothing, and electrodes pull more all the same */
    now[SOFTER] =
        (once_more){.by = 1 + e, .pull = 1 + missing, .asked = may && (softly || missing > 0)};
    now[STIFFER] = (once_more){
        .by = 1 / (1 + e), .pull = less ? 1 / (1 + missing) : 1, .asked = may && (softly || less)};
    if (met && e > 0 && !isinf(e)) {
        now[SOFTER].by = now[STIFFER].by = 1, now[SOFTER].asked = now[STIFFER].asked = true;
        now[SOFTER].stiffer = 1 / (1 + e) - 1, now[STIFFER].stiffer = e;
    }
    now[HELD] = now[ASIDE] = (once_more){.by = 1, .pull = 1};
    if (fw_verdict_has_said(v, s, UNSTABLE)) return FW_OK;
    if (counts_behind(v, i)) {
        bool on = falls || now[SOFTER].asked;
        if (!x->loads->quasi_static) {
            fw_dynamics_motion_rows(x, x->nsample - 1, 1);
            on = on || goes_on(m, x, (double)INFINITY) != FW_NONE;
        }
        if (on) FW_TRY(fw_verdict_longest_period(arena, v, i, false, &period_s));
    }
    for (int k = 0; k < 4; k++)
        now[k].period_s = period_s, now[k].falls = falls;
    now[HELD].asked = on_its_way(m, &now[HELD], x);
    for (int k = 0; k < 4 && now[HELD].asked;
         k++) /* so are the others, and one run of each will do */
        now[k].from_s = s->duration_s;
    if (!falls || missing > 0) return FW_OK; /* where electrodes pull the field decides (FW-D248) */
    fw_statics_passed *passed;
    const fw_statics_stability *stays;
    fw_diags own = fw_diags_new(arena);
    FW_NEED(passed = fw_arena_one(arena, fw_statics_passed));
    FW_TRY(fw_statics_stability_find(arena, m, s, x, &own, &stays, NULL, passed));
    now[ASIDE].aside = passed, now[ASIDE].asked = passed->any;
    return FW_OK;
}

/* where its bodies are at the end, along the mode that became free */
static double along(const fw_mechanism *m, const fw_dynamics_motion *x,
                    const fw_statics_passed *p) {
    const int n = 3 * m->nbody;
    double sum = 0;
    fw_dynamics_motion_rows(x, 0, 1);
    fw_dynamics_motion_rows(x, x->nsample - 1, 1);
    for (int i = 0; i < n; i++)
        sum += p->way[i] * (x->q[(x->nsample - 1) * n + i] - x->q[i]);
    return sum;
}

/* FW-D746, FW-D747: what has no motion leaves the scene open; to the other side it goes for a reason that nobody etches away */
static fw_status tell_behind(fw_arena *arena, const fw_device_scene *s, const once_more *now,
                             const fw_dynamics_motion *x, bool brief, fw_diags *diags,
                             fw_verdict_variant_verdict *v) {
    char at[32], by[32];
    const fw_statics_passed *p = now[ASIDE].aside;
    if (now[HELD].asked && !now[HELD].goes)
        FW_TRY(fw_verdict_scene_reason(
            v, s, 746, FW_INCONCLUSIVE, FW_VERDICT_KEEP_HALF,
            fw_arena_printf(arena,
                            "%s%s ends at %s ms on its way, and with its loads held from then on "
                            "no motion was found that comes to rest within what hinges bear: let "
                            "the scene last longer, or lower its loads",
                            FW_NAMED("scene", s->name),
                            fw_number_text(at, sizeof at, 1e3 * x->end_s, 4))));
    if (!now[ASIDE].asked) return FW_OK;
    const bool goes = now[ASIDE].goes;
    const char *text = fw_arena_printf(
        arena,
        "%s%s leaves an unstable equilibrium (at %s ms) to a side that little decides: with "
        "flexures made %s um aside of their lines %s%s %s; lower the load, stiffen the joints, or "
        "decide the side by a larger eccentricity or angle",
        FW_NAMED("scene", s->name), fw_number_text(at, sizeof at, 1e3 * p->t_s, 4),
        fw_number_text(by, sizeof by, aside_um, 2), FW_NAMED("body", p->body),
        goes ? "goes to the other side, which the bands hold"
             : "has no motion to the scene's end that was found");
    FW_NEED(text);
    if (!goes)
        return fw_verdict_scene_reason(v, s, 747, FW_INCONCLUSIVE, FW_VERDICT_KEEP_HALF, text);
    if (!brief) fw_diag_warning(diags, 747, s->place, "%s", text);
    return diags->failed ? FW_NOMEM : FW_OK;
}

static void take(const fw_mechanism *m, int i, double e, const double *far, const once_more now[4],
                 double *most, fw_verdict_variant_verdict *v) {
    const fw_verdict_strain_monitor *was = v->motion[i]->observed;
    fw_verdict_shaken *s = &v->shaken[i];
    for (int k = 0; k < 4; k++) {
        s->other[k] = (fw_verdict_other){.asked = now[k].asked,
                                         .lost = now[k].asked && !now[k].goes,
                                         .by = now[k].by,
                                         .off = k < HELD ? e : 0,
                                         .from_s = now[k].from_s,
                                         .motion = now[k].motion,
                                         .probe = now[k].saw.probe};
        if (!now[k].asked || !now[k].goes) continue;
        const double by = beyond(m, was, far, &now[k], k == STIFFER ? -1 : 1, s);
        if (k == SOFTER) *most = fmax(*most, by);
        if (k == ASIDE) beyond(m, was, far, &now[k], -1, s);
    }
}

fw_status fw_verdict_softened(fw_arena *arena, const fw_mechanism *m, int i, double e,
                              const fw_dynamics_motion_options *options,
                              const fw_verdict_required *required, bool brief, fw_diags *diags,
                              fw_verdict_variant_verdict *v) {
    const fw_device_scene *s = &m->device->scene[i];
    const fw_dynamics_motion *x = v->motion[i];
    const size_t n = 2 * (size_t)m->nbody + (size_t)m->nhinge, factors = 2 * (size_t)m->nhinge + 2;
    const double missing = fw_verdict_pull_missing(v, i);
    const bool softly = soft > v->left[i];
    bool met;
    if (softly && e > 0 && missing == 0) e = off_by(m, e);
    if (x->ended || x->nsample < 1) return FW_OK;
    FW_TRY(fw_verdict_may_be_met(arena, v, i, missing, &e, &met));
    fw_verdict_shaken *shaken = &v->shaken[i];
    double most = 1, *before = shaken->factor, *far;
    bool any = false;
    once_more *now = fw_arena_array(arena, once_more, 4);
    FW_NEED(now);
    FW_TRY(ask(arena, m, i, e, missing, met, v, now));
    for (int k = 0; k < 4; k++)
        any = any || now[k].asked;
    if (!any) return FW_OK;
    FW_NEED(far = fw_arena_array(arena, double, 5 * n));
    FW_TRY(watch(arena, m, i, far, required, v, now));
    fw_verdict_farthest(m, x, far);
    for (int k = 0; k < 4; k++)
        if (now[k].asked) FW_TRY(move_with(arena, m, s, x, options, &now[k]));
    if (now[ASIDE].goes) /* what goes the same way tells nothing of a side */
        now[ASIDE].asked =
            along(m, x, now[ASIDE].aside) * along(m, now[ASIDE].motion, now[ASIDE].aside) < 0;
    /* the most of them is a factor on what other causes make of it */
    FW_NEED(shaken->factor = fw_arena_array(arena, double, factors));
    for (size_t k = 0; k < factors; k++)
        shaken->factor[k] = 1;
    take(m, i, e, far, now, &most, v);
    for (size_t k = 0; k < factors; k++)
        before[k] *= shaken->factor[k];
    shaken->factor = before;
    if (now[SOFTER].goes && missing > 0)
        shaken->nearer_m = fw_verdict_electrodes_nearer(x, now[SOFTER].motion, &shaken->kept);
    FW_TRY(tell_behind(arena, s, now, x, brief, diags, v));
    return now[SOFTER].asked && (softly || missing > 0)
               ? tell_soft(arena, s, v->left[i], e, missing, now[SOFTER].goes, most, brief, diags,
                           v)
               : FW_OK;
}
