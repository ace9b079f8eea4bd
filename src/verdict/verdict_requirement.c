/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is asked of the probes of a device. A value x has the band

     x -+ (n + (l + s) |x - o|), of gaps with M for |x - o|

   n: numbers (two runs, the search between instants, effects left out), l: what the next model of the hinges changes of this probe at
   the motion's largest hinge angle, s: stiffness of a flexure against solids, o: its value as drawn, M: how far the outlines of a gap
   have been moved against each other. Where l is not known, that of the largest strain, or what the reference cases give, stands for
   both. A band within the bounds accepts, one wholly beyond a bound rejects. A settling time has the ends that it has with a band b
   narrower and wider by n + (l + s) b. Theory: docs/theory/probes.md. Test: test_probe.py. */
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

static const double fw_beyond = 1e3; /* utilisation of what is not there at all */

/* ---- which there are ---- */

static const fw_device_probe_kind *kind_of(const fw_device *d, const fw_device_requirement *q) {
    return &fw_device_probe_kinds[d->probe[q->probe].row];
}

static bool asked_in(const fw_mechanism *m, const fw_device_requirement *q, int scene) {
    const fw_device_scene *s = &m->device->scene[scene];
    return fw_device_in_flow(s->flow, m->variant->flow) &&
           (q->scene == FW_NONE || q->scene == scene) &&
           fw_device_probe_in_scene(&m->device->probe[q->probe], s);
}

static fw_verdict_requirement blank(const fw_mechanism *m, int asked, int scene) {
    const fw_device *d = m->device;
    const fw_device_requirement *q = &d->requirement[asked];
    const fw_device_probe_kind *kind = kind_of(d, q);
    bool moves = fw_device_probe_moves(kind);
    return (fw_verdict_requirement){.asked = asked,
                                    .probe = d->probe[q->probe].id,
                                    .kind = kind->name,
                                    .unit = q->measure == FW_MEASURE_SETTLING ? "s" : kind->unit,
                                    .measure = moves ? fw_device_measure_text(q->measure) : NULL,
                                    .scene = scene == FW_NONE ? NULL : d->scene[scene].name,
                                    .scene_index = scene,
                                    .flow = m->variant->flow,
                                    .min = q->min,
                                    .max = q->max,
                                    .value = (double)NAN,
                                    .low = (double)NAN,
                                    .high = (double)NAN,
                                    .margin = (double)NAN,
                                    .origin = (double)NAN,
                                    .all_low = (double)NAN,
                                    .all_high = (double)NAN,
                                    .utilisation = (double)NAN,
                                    .t_s = (double)NAN,
                                    .decision = FW_INCONCLUSIVE,
                                    .why = "nothing was run"};
}

fw_status fw_verdict_requirements_list(fw_arena *arena, const fw_mechanism *m,
                                       fw_verdict_variant_verdict *v) {
    const fw_device *d = m->device;
    v->nrequirement = 0, v->requirement = NULL, v->probed = NULL;
    if (!d || d->nprobe == 0) return FW_OK;
    size_t scenes = (size_t)d->nscene, most = (size_t)d->nrequirement * (scenes + 1);
    FW_NEED(v->probed = fw_arena_array(arena, fw_probe_result, scenes * (size_t)d->nprobe));
    FW_NEED(v->requirement = fw_arena_array(arena, fw_verdict_requirement, most));
    for (int i = 0; i < d->nrequirement; i++) {
        const fw_device_requirement *q = &d->requirement[i];
        if (!fw_device_probe_moves(kind_of(d, q))) {
            bool here =
                q->scene == FW_NONE || fw_device_in_flow(d->scene[q->scene].flow, m->variant->flow);
            if (here) v->requirement[v->nrequirement++] = blank(m, i, q->scene);
            continue;
        }
        for (int s = 0; s < d->nscene; s++)
            if (asked_in(m, q, s)) v->requirement[v->nrequirement++] = blank(m, i, s);
    }
    return FW_OK;
}

/* ---- who looks at a scene ---- */

static bool moves_in(const fw_device *d, int scene) {
    for (int i = 0; i < d->nprobe; i++)
        if (fw_device_probe_moves(&fw_device_probe_kinds[d->probe[i].row]) &&
            fw_device_probe_in_scene(&d->probe[i], &d->scene[scene]))
            return true;
    return false;
}

fw_status fw_verdict_requirements_watch(fw_arena *arena, const fw_mechanism *m, int scene,
                                        const fw_verdict_variant_verdict *v, bool required,
                                        fw_probe_monitor *monitor[2]) {
    const fw_device *d = m->device;
    bool *history, *judged, *ends, any = !required;
    double *asked;
    monitor[0] = monitor[1] = NULL;
    if (!v->probed || !moves_in(d, scene)) return FW_OK;
    FW_NEED(history = fw_arena_array(arena, bool, 3 * (size_t)d->nprobe));
    judged = history + d->nprobe, ends = judged + d->nprobe;
    FW_NEED(asked = fw_arena_array(arena, double, (size_t)d->nprobe));
    for (int k = 0; k < v->nrequirement; k++) {
        const fw_device_requirement *q = &d->requirement[v->requirement[k].asked];
        if (v->requirement[k].scene_index != scene || !v->requirement[k].measure) continue;
        judged[q->probe] = any = true;
        const bool settles = q->measure == FW_MEASURE_SETTLING; /* its bounds are times */
        history[q->probe] = history[q->probe] || settles;
        ends[q->probe] = ends[q->probe] || q->measure == FW_MEASURE_FINAL;
        asked[q->probe] =
            fmax(asked[q->probe], settles ? q->band : fmax(fabs(q->min), fabs(q->max)));
    }
    for (int i = 0; any && i < 2; i++) {
        FW_NEED(monitor[i] = fw_arena_one(arena, fw_probe_monitor));
        FW_TRY(fw_probe_monitor_new(arena, m, &d->scene[scene], history, required ? judged : NULL,
                                    monitor[i]));
        monitor[i]->judged = judged, monitor[i]->asked = asked;
        monitor[i]->late = ends, monitor[i]->late_from = fw_verdict_rings_from, monitor[i]->of = v;
    }
    return FW_OK;
}

/* ---- from a value with its band to a decision ---- */

/* Share that is used of what a min allows, both counted from one reference: what is asked for over what there is, or what
   is lost over what may be lost; 1 at the bound. NaN: the bound is the reference, and there is nothing to measure by */
static double share_of(double bound, double value) {
    if (bound > 0) return fmin(value > 0 ? bound / value : fw_beyond, fw_beyond);
    if (bound < 0) return fmin(fmax(-value, 0) / -bound, fw_beyond);
    return (double)NAN;
}

/* The larger share of both bounds. Of a bound above 0 the reference is 0, else the value as drawn. A max is a min turned. */
static void use(fw_verdict_requirement *r) {
    double u[3];
    const double x[3] = {r->value, r->high, r->low}, y[3] = {r->value, r->low, r->high};
    const double least = r->min > 0 ? 0 : r->origin, most = r->max > 0 ? 0 : r->origin;
    for (int i = 0; i < 3; i++)
        u[i] = fmax(share_of(r->min - least, x[i] - least), share_of(most - r->max, most - y[i]));
    r->utilisation = u[0], r->utilisation_low = u[1], r->utilisation_high = u[2];
    r->by_max = !(share_of(r->min - least, r->value - least) >= u[0]);
}

static void decide(fw_verdict_requirement *r) {
    r->why = NULL;
    r->margin = fmin(r->value - r->min, r->max - r->value); /* passes by NaN */
    use(r);
    if (r->high < r->min || r->low > r->max)
        r->decision = FW_REJECT;
    else if (r->low < r->min || r->high > r->max || isnan(r->low) || isnan(r->high))
        r->decision = FW_INCONCLUSIVE;
    else
        r->decision = FW_ACCEPT;
}

void fw_verdict_requirement_widen(double down, double up, fw_verdict_requirement *r) {
    r->low -= down, r->high += up;
    if (r->size || (r->measure && isnan(r->origin))) r->low = fmax(0, r->low);
    if (!r->measure) r->lasting += down / fabs(r->value);
    decide(r);
}

/* a size is not below 0 */
static void put(fw_verdict_requirement *r, double value, double numeric, double model,
                double lasting, double departure, bool size) {
    /* where the model says nothing of itself, nothing is known, of a value of 0 either */
    double off = isinf(model) ? HUGE_VAL : numeric + model * fabs(departure);
    r->value = value;
    r->low = size ? fmax(0, value - off) : value - off;
    r->high = value + off;
    r->numeric = numeric;
    r->lasting = value != 0 ? fmin(lasting, model) * fabs(departure / value) : 0;
    decide(r);
}

/* ---- of motions ---- */

/* relative error of what was computed with this model of the hinges, and with rigid bodies */
static double model_of(const fw_mechanism *m, const fw_dynamics_motion *motion, double level) {
    const double bodies = fw_verdict_bending_share(motion);
    double whole = fw_verdict_motion_model_error(m, motion) + bodies;
    const bool exact = motion->ledger.hinge.used == FW_HINGE_ELASTICA;
    const bool apart = fw_statics_level_far_apart(motion->level);
    if (isnan(level) || exact || motion->ledger.undecided || apart) return whole;
    double computed = level + fw_verdict_motion_lasting_error(m) + bodies;
    bool swings = motion->loads && !motion->loads->quasi_static;
    return swings && motion->ledger.hinge.used == FW_HINGE_REVOLUTE ? fmax(computed, whole)
                                                                    : computed;
}

/* What the model is off by scales the departure from where it comes to rest, and where that is as large as the band it is off by that part
   of it. Frequencies, and so all times, go with the root of a stiffness. What was out within the last period of the slowest mode may be so again behind the end */
static fw_status put_settling(const fw_verdict_variant_verdict *v, const fw_dynamics_motion *motion,
                              const fw_probe_monitor *monitor, const fw_probe_result *p, bool still,
                              fw_verdict_requirement *r) {
    const fw_mechanism *m = v->mechanism;
    const fw_device_requirement *q = &m->device->requirement[r->asked];
    const fw_probe_course *course = &monitor->course[q->probe];
    const double band = q->band,
                 model = still ? 0
                               : model_of(m, motion, p->level) +
                                     fw_verdict_places_error(motion, &m->device->probe[q->probe]);
    fw_verdict_rest rest;
    FW_TRY(fw_verdict_rests_at(v, r->scene_index, motion, monitor, q, &rest));
    const double off = p->final_numeric + model * band + rest.off;
    const double exact = band > p->final_numeric
                             ? fw_probe_settling_s(course, rest.at, band - p->final_numeric)
                             : motion->end_s;
    double high = band > off ? fw_probe_settling_s(course, rest.at, band - off) : motion->end_s;
    r->value = fw_probe_settling_s(course, rest.at, band);
    r->low = fw_probe_settling_s(course, rest.at, band + off) * (1 - 0.5 * model);
    r->high = high * (1 + 0.5 * model);
    r->numeric = fmax(0, exact - r->value);
    r->lasting = fw_verdict_motion_lasting_error(m) + fw_verdict_bending_share(motion);
    r->open = rest.why;
    if (!r->open && high > motion->end_s - rest.period_s)
        r->open = "it has not settled where the scene ends: give the scene a longer duration";
    if (r->open) r->high = HUGE_VAL;
    if (rest.why) r->low = 0;
    return decide(r), FW_OK;
}

/* of what the errors of a model are shares: what the value is beyond the drawn one; of a gap, whose
   nearest places change, how far its outlines have been moved against each other */
static double departure(const fw_probe_result *p, double value) {
    return isnan(p->moved) ? value - p->origin : p->moved;
}

/* Where a motion still rings at its end, its phase there goes by frequencies that are known to some per cent alone: the final
   value may be anywhere within the ring, however little that is, and no tolerance changes it; of a fiftieth of the way on it is
   told. What laws still shake there is known by them, and by modes that lie elsewhere (resonance.c) */
static fw_status put_ring(const fw_verdict_variant_verdict *v, const fw_dynamics_motion *motion,
                          const fw_probe_monitor *monitor, const fw_probe_result *p,
                          fw_verdict_requirement *r) {
    const fw_mechanism *m = v->mechanism;
    const double off = 0.5 * (r->high - r->low);
    fw_probe_ring ring;
    double slowest_s;
    bool shaken;
    if (motion->loads && motion->loads->quasi_static) return FW_OK; /* equilibria do not ring */
    FW_TRY(fw_verdict_slowest_s(monitor->arena, v, r->scene_index, &slowest_s));
    fw_probe_rings(&monitor->course[m->device->requirement[r->asked].probe], slowest_s, &ring);
    FW_TRY(fw_verdict_is_shaken(monitor->arena, m, r->scene_index, &shaken));
    shaken = shaken && fw_verdict_laws_go_on_s(m, &m->device->scene[r->scene_index]) > 0;
    if (ring.amplitude > 0.02 * fabs(p->final - p->origin)) r->rings = ring.amplitude;
    if (shaken || !(ring.amplitude > 0)) return FW_OK;
    const double low = fmin(r->low, ring.low - off), high = fmax(r->high, ring.high + off);
    if (r->value != 0) r->lasting += fmax(r->low - low, high - r->high) / fabs(r->value);
    r->low = r->size ? fmax(0, low) : low, r->high = high;
    return decide(r), FW_OK;
}

/* still: nothing moves, and shares of that are round-off over round-off */
static void judge(const fw_mechanism *m, const fw_dynamics_motion *motion, const fw_probe_result *p,
                  bool still, fw_verdict_requirement *r) {
    const fw_device_requirement *q = &m->device->requirement[r->asked];
    const double model = still ? 0
                               : model_of(m, motion, p->level) +
                                     fw_verdict_places_error(motion, &m->device->probe[q->probe]),
                 lasting = fw_verdict_motion_lasting_error(m) + fw_verdict_bending_share(motion);
    const bool gap = !isnan(p->moved), /* neither is below 0 */
        size = r->size = gap || fw_probe_is_size(m->device, &m->device->probe[q->probe]);
    r->swing = gap ? p->moved : fmax(fabs(p->maximum - p->origin), fabs(p->minimum - p->origin));
    if (q->measure == FW_MEASURE_PARASITIC) r->swing = fabs(p->across);
    if (q->measure == FW_MEASURE_PEAK_TO_PEAK) r->swing *= 2; /* either end may */
    switch (q->measure) {
    case FW_MEASURE_PEAK:
        put(r, fabs(p->peak), p->numeric, model, lasting, departure(p, p->peak), true);
        r->t_s = p->peak_t_s;
        return;
    case FW_MEASURE_MAXIMUM:
        r->origin = p->origin;
        put(r, p->maximum, p->numeric, model, lasting, departure(p, p->maximum), size);
        r->t_s = p->maximum_t_s;
        return;
    case FW_MEASURE_MINIMUM:
        r->origin = p->origin, r->t_s = p->minimum_t_s;
        put(r, p->minimum, p->numeric, model, lasting, departure(p, p->minimum), size);
        if (p->met * (1 + model + p->numeric / p->moved) < 1) r->high = 0, decide(r);
        return;
    case FW_MEASURE_FINAL:
        r->origin = p->origin;
        put(r, p->final, p->final_numeric, model, lasting, departure(p, p->final), size);
        r->t_s = motion->end_s;
        return;
    case FW_MEASURE_PEAK_TO_PEAK:
        put(r, p->maximum - p->minimum, 2 * p->numeric, model, lasting,
            gap ? 2 * p->moved : p->maximum - p->minimum, true);
        return;
    case FW_MEASURE_SETTLING: /* put_settling */
        return;
    case FW_MEASURE_PARASITIC:
        break;
    }
    put(r, fabs(p->across), p->across_numeric, model_of(m, motion, p->across_level), lasting,
        p->across, true);
    r->t_s = p->across_t_s;
}

static const char scene_ended[] =
    "the scene was ended where its hinges were far beyond what they bear";

/* A scene that was ended has no end: only what is beyond its bound by then stays beyond it */
static void judge_ended(fw_device_measure measure, fw_verdict_requirement *r) {
    bool stays = false;
    switch (measure) {
    case FW_MEASURE_PEAK:
    case FW_MEASURE_MAXIMUM:
    case FW_MEASURE_PEAK_TO_PEAK:
    case FW_MEASURE_PARASITIC:
        stays = r->low > r->max;
        break;
    case FW_MEASURE_MINIMUM:
        stays = r->high < r->min;
        break;
    case FW_MEASURE_FINAL:
    case FW_MEASURE_SETTLING:
        break;
    }
    if (stays) return;
    r->value = r->low = r->high = r->margin = (double)NAN;
    r->utilisation = r->utilisation_low = r->utilisation_high = (double)NAN;
    r->decision = FW_INCONCLUSIVE, r->why = scene_ended;
}

/* Another motion of the scene, with what is left of the band without what the other one has of it */
static fw_status take_in(const fw_verdict_variant_verdict *v, const fw_dynamics_motion *motion,
                         const fw_dynamics_motion *other, const fw_probe_monitor *monitor,
                         const fw_probe_result *p, const fw_probe_result *now, double has,
                         fw_verdict_requirement *r) {
    const fw_mechanism *m = v->mechanism;
    const fw_device_measure measure = m->device->requirement[r->asked].measure;
    const bool across = measure == FW_MEASURE_PARASITIC, time = measure == FW_MEASURE_SETTLING;
    const int probe = m->device->requirement[r->asked].probe;
    const double left = model_of(m, motion, across ? p->across_level : p->level) +
                        fw_verdict_places_error(motion, &m->device->probe[probe]) - has;
    fw_verdict_requirement then = *r;
    if (time)
        FW_TRY(put_settling(v, other, monitor, now, false, &then));
    else
        judge(m, other, now, false, &then);
    const double off = r->numeric + (time ? 0 : fmax(0, left) * then.swing),
                 least = r->low >= 0 && r->value >= 0 && isnan(r->origin) ? 0 : -HUGE_VAL;
    const bool like = time && !(has > 0) && r->value > 0; /* but for what damps */
    const double less = like ? r->low / r->value : 1, more = like ? r->high / r->value : 1;
    then.low = less * then.value - off;
    then.high = then.open ? HUGE_VAL : then.size && !(then.high > 0) ? 0 : more * then.value + off;
    if (measure == FW_MEASURE_FINAL) FW_TRY(put_ring(v, other, monitor, now, &then));
    if (time && then.open) r->open = then.open;
    const double low = fmin(r->low, fmax(least, then.low)), high = fmax(r->high, then.high);
    if (r->value != 0) r->lasting += fmax(r->low - low, high - r->high) / fabs(r->value);
    r->low = low, r->high = high;
    decide(r);
    return FW_OK;
}

static fw_status take_in_motion(const fw_mechanism *m, int scene, const fw_dynamics_motion *other,
                                const fw_probe_monitor *monitor, double has,
                                fw_verdict_variant_verdict *v) {
    for (int k = 0; k < v->nrequirement; k++) {
        fw_verdict_requirement *r = &v->requirement[k];
        const int probe = m->device->requirement[r->asked].probe;
        const fw_probe_result *p = &v->probed[scene * m->device->nprobe + probe];
        fw_probe_result now;
        if (r->scene_index != scene || !r->measure || r->why) continue;
        fw_probe_result_of(monitor, NULL, other, probe, &now);
        now.numeric = p->numeric, now.final_numeric = p->final_numeric;
        if (now.known) FW_TRY(take_in(v, v->motion[scene], other, monitor, p, &now, has, r));
    }
    return FW_OK;
}

const fw_verdict_required fw_verdict_required_of_scenes = {fw_verdict_requirements_watch,
                                                           take_in_motion};

fw_status fw_verdict_requirements_of_scene(const fw_mechanism *m, int scene,
                                           const fw_probe_monitor *monitor,
                                           const fw_probe_monitor *looser,
                                           fw_verdict_variant_verdict *v) {
    const int n = m->device->nprobe;
    if (monitor->no_memory || (looser && looser->no_memory)) return FW_NOMEM;
    const bool still = fw_verdict_stands_still(v, scene);
    for (int i = 0; i < n; i++)
        fw_probe_result_of(monitor, looser, v->motion[scene], i, &v->probed[scene * n + i]);
    for (int k = 0; k < v->nrequirement; k++) {
        fw_verdict_requirement *r = &v->requirement[k];
        if (r->scene_index != scene || !r->measure) continue;
        const fw_device_requirement *q = &m->device->requirement[r->asked];
        const fw_probe_result *p = &v->probed[scene * n + q->probe];
        const fw_device_probe *of = &m->device->probe[q->probe];
        if (p->known) judge(m, v->motion[scene], p, still, r);
        if (fw_verdict_places_lower(v->motion[scene], of, q->measure, &r->low, &r->high)) decide(r);
        if (p->known && q->measure == FW_MEASURE_FINAL)
            FW_TRY(put_ring(v, v->motion[scene], monitor, p, r));
        if (p->known && q->measure == FW_MEASURE_SETTLING && !v->motion[scene]->ended)
            FW_TRY(put_settling(v, v->motion[scene], monitor, p, still, r));
        if (p->known && v->motion[scene]->ended) judge_ended(q->measure, r);
        if (!p->known && monitor->within)
            r->why =
                "nothing is drawn of its bodies, or all of it lies within a hinge between them";
    }
    return FW_OK;
}

/* ---- of equilibria ---- */

static const char *last_error(const fw_diags *diags) {
    for (size_t i = diags->count; i-- > 0;)
        if (diags->item[i].severity == FW_ERROR) return diags->item[i].message;
    return "there are no small motions";
}

/* of either kind: a mode across the plane that lies higher at rest may be the lower one under loads that press */
static void overtaken(const fw_verdict_variant_verdict *v, const fw_device_probe *probe,
                      fw_verdict_requirement *r) {
    const fw_verdict_out_of_plane *o = v->out_of_plane;
    double low, high;
    for (int k = 0; o && probe->plane != FW_PLANE_IN && r->scene_index != FW_NONE && k < o->nmode;
         k++) {
        if (o->mode[k].f_Hz < r->value) continue;
        fw_verdict_across_under_loads(v, r->scene_index, &o->mode[k], &low, &high);
        r->low = fmin(r->low, low);
    }
}

/* a mode across the plane, or what is asked of those and not known; else *mode: which of those in the plane */
static bool put_across(const fw_verdict_variant_verdict *v, const fw_device_probe *probe,
                       const fw_statics_modes *modes, int *mode, fw_verdict_requirement *r) {
    const fw_verdict_out_of_plane *o = v->out_of_plane;
    const fw_verdict_plate_mode *of = fw_verdict_frequency(v, probe, modes, mode);
    if (of) {
        r->value = of->f_Hz;
        fw_verdict_across_under_loads(v, r->scene_index, of, &r->low, &r->high);
        overtaken(v, probe, r);
        r->numeric = 0, r->lasting = 1 - r->low / of->f_Hz;
        decide(r);
        return true;
    }
    if (probe->plane != FW_PLANE_ACROSS) return false;
    r->why = !o ? "nothing is drawn" : o->why ? o->why : "there is no such mode";
    return true;
}

/* Bodies that give only soften, in series with flexures: at rest what flexures are off by is no share of what bodies give, and
   1/k = 1/k_low + (1/left - 1)/k_rigid, of frequencies in their squares; about an equilibrium both are factors. Solids of whole
   devices swing up to 0.3 % higher than computed: the other way what they leave counts up to 1 % */
static void put_soft(const fw_probe *p, double left, double value, fw_verdict_requirement *r) {
    const bool yields = p->asked->row == FW_PROBE_IS_compliance;
    const int power = p->kind->takes == FW_PROBE_TANGENT ? 1 : 2;
    const double low = yields ? 1 / r->high : r->low, rigid = yields ? 1 / value : value,
                 series = pow(pow(low, -power) + pow(rigid, -power) * (pow(left, -power) - 1),
                              -1.0 / power),
                 least = r->scene_index == FW_NONE ? series : left * low,
                 times = yields ? 1 / left : left, other = fmin(fabs(times - 1), 0.01);
    *(yields ? &r->high : &r->low) = yields ? 1 / least : least;
    r->lasting += 1 / left - 1; /* of what is used */
    *(yields ? &r->low : &r->high) += (yields ? -1 : 1) * other * value;
}

static const double hardly_soft = 0.98; /* what bodies leave, where no solid is worth its mesh */

static fw_status judge_small(fw_arena *arena, const fw_mechanism *m,
                             const fw_dynamics_motion_options *options, const fw_device_scene *s,
                             int scene, fw_verdict_variant_verdict *v) {
    double accuracy = options->accuracy > 0 ? options->accuracy : 1e-3;
    const fw_statics_mode_options o = {
        .effects = options->effects,
        .accuracy = options->hinge_accuracy > 0 ? options->hinge_accuracy : fmax(accuracy, 0.03),
        .at_equilibrium = scene != FW_NONE};
    fw_diags own = fw_diags_new(arena); /* what it warns of is in the value */
    const fw_statics_modes *modes = NULL;
    fw_probe *probe;
    fw_verdict_soft soft = {.looked = false};
    fw_status status = fw_statics_small_motions(arena, m, s, &o, &own, &modes);
    if (status == FW_NOMEM || status == FW_CANCELLED || own.failed)
        return status == FW_CANCELLED ? status : FW_NOMEM;
    FW_TRY(fw_probe_bind(arena, m, s, NULL, &probe));
    fw_verdict_small_others others;
    FW_TRY(fw_verdict_small_again(arena, m, s, scene, &o, modes, v, &others));
    for (int k = 0; k < v->nrequirement; k++) {
        fw_verdict_requirement *r = &v->requirement[k];
        int mode = 0;
        if (r->measure || r->scene_index != scene) continue;
        const fw_probe *p = &probe[m->device->requirement[r->asked].probe];
        double value = modes ? fw_probe_small(p, modes) : (double)NAN, less = 0;
        if (p->asked->row == FW_PROBE_IS_frequency) {
            const bool across = put_across(v, p->asked, modes, &mode, r);
            if (across) FW_TRY(fw_verdict_soft_overtakes(arena, &o.effects, modes, v, r, &less));
            if (less > 0) fw_verdict_requirement_widen(less, 0, r);
            if (across) continue;
            value = modes && mode >= 1 && mode <= modes->count ? modes->mode[mode - 1].f_Hz
                                                               : (double)NAN;
        }
        r->why = modes ? "there is no such mode, or nothing holds the point" : last_error(&own);
        if (!isfinite(value)) continue;
        double off;
        FW_TRY(fw_verdict_small_off(arena, m, modes, p, &off));
        const double model = fmax(fw_probe_small_error(p, modes), off);
        const bool yields = p->asked->row == FW_PROBE_IS_compliance;
        if (!soft.looked)
            FW_TRY(fw_verdict_soft_new(arena, &options->effects, fw_verdict_bending_of_any(v), v,
                                       &soft));
        for (int closely = 0; closely < 2; closely++) {
            double left;
            FW_TRY(fw_verdict_soft_leaves(arena, &soft, p, mode, value, closely, v, &left));
            put(r, value, 0, model, modes->stiffness_error, value, true);
            put_soft(p, left, value, r);
            fw_verdict_small_widen(&others, p, mode, yields ? 1 / left : left, r);
            if (p->asked->row == FW_PROBE_IS_frequency) overtaken(v, p->asked, r);
            decide(r);
            if (r->decision != FW_INCONCLUSIVE || left > hardly_soft || v->corner || !v->arm) break;
        }
        if (soft.why) fw_verdict_requirement_widen(r->low, 0, r), r->open = soft.why;
        if (isinf(model) || others.lost)
            FW_NEED(r->open = fw_verdict_small_open(arena, m, modes, &others));
    }
    return FW_OK;
}

/* ---- reasons ---- */

/* A min of a motion wants more of it: neither less load nor stiffer flexures help, unless its scene was ended. What is
   of an equilibrium does not go with loads; of a compliance a min wants thinner flexures. */
static fw_status add_reason(fw_arena *arena, const fw_mechanism *m, const fw_verdict_requirement *r,
                            fw_verdict_variant_verdict *v) {
    const fw_device_probe *p = &m->device->probe[m->device->requirement[r->asked].probe];
    bool min = fw_verdict_requirement_below(r);
    bool softer = r->measure ? min : (p->row == FW_PROBE_IS_compliance) == min;
    const bool ended = r->why == scene_ended;
    double used = r->utilisation_high > 0 ? r->utilisation_high : 2;
    const char *text = fw_verdict_requirement_text(arena, r);
    FW_NEED(text);
    if (fw_verdict_hangs_alone(v, r)) return fw_verdict_hangs_say(arena, v, r, text);
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = r->scene ? r->scene : fw_verdict_at_rest,
                                                  .flow = r->flow,
                                                  .number = r->why ? 331 : 330,
                                                  .decision = r->decision,
                                                  .keep = fmin(fmax(0.98 / used, 1e-3), 0.99),
                                                  .not_by_loads = !ended && (min || !r->measure),
                                                  .not_by_width = !ended && softer,
                                                  .text = text};
    return FW_OK;
}

/* a motion that ended where a formula does, or rests on what is unstable, has its own reason */
static bool has_reason(const fw_verdict_variant_verdict *v, const fw_verdict_requirement *r) {
    return r->measure && (!v->motion[r->scene_index] || r->why == fw_verdict_unstable_there);
}

/* Of a length that a contact holds only what is not the contact's goes with what the motion is off by: its own is as far off as the
   contact gives in the other motions */
static fw_status put_held(fw_arena *arena, const fw_verdict_variant_verdict *v,
                          fw_verdict_requirement *r) {
    const fw_dynamics_motion *x = v->motion[r->scene_index];
    const fw_device *d = v->mechanism->device;
    const int of = r->scene_index * d->nprobe + d->requirement[r->asked].probe;
    double held = 0;
    FW_TRY(fw_verdict_held_m(arena, v, r, &held));
    const double model = model_of(v->mechanism, x, v->probed[of].level),
                 whole = fw_dynamics_motion_ways_off(x, false), less = held * (model + whole);
    if (!(held > 0) || !isfinite(less)) return FW_OK;
    r->low += less, r->high -= less, r->numeric -= held * whole;
    r->swing = fmax(0, r->swing - held);
    return FW_OK;
}

static fw_status put_shaken(fw_arena *arena, const fw_mechanism *m,
                            const fw_verdict_variant_verdict *v, int k) {
    fw_verdict_requirement *r = &v->requirement[k];
    const fw_verdict_shaken *s = &v->shaken[r->scene_index];
    FW_TRY(put_held(arena, v, r));
    const double has = fmax(r->high - r->value, r->value - r->low);
    r->swing_most = r->swing + (isfinite(has) ? has : 0);
    FW_TRY(fw_verdict_requirement_others(v, s, r));
    const fw_device_measure measure = m->device->requirement[r->asked].measure;
    fw_verdict_requirement_shaken(s->required, s->required_late, measure, r);
    FW_TRY(fw_verdict_requirement_lacking(v, r));
    return decide(r), FW_OK;
}

fw_status fw_verdict_requirements_end(fw_arena *arena, const fw_mechanism *m,
                                      const fw_dynamics_motion_options *options,
                                      fw_verdict_variant_verdict *v) {
    for (int k = 0; k < v->nrequirement; k++) { /* once about every equilibrium */
        bool first = !v->requirement[k].measure;
        for (int i = 0; first && i < k; i++)
            first = v->requirement[i].measure ||
                    v->requirement[i].scene_index != v->requirement[k].scene_index;
        if (first)
            FW_TRY(fw_verdict_requirements_along(arena, m, options, v->requirement[k].scene_index,
                                                 judge_small, v));
    }
    for (int k = 0; k < v->nrequirement; k++)
        if (v->requirement[k].measure && !v->requirement[k].why) FW_TRY(put_shaken(arena, m, v, k));
    FW_TRY(fw_verdict_bending_name_rigid(arena, v));
    for (int k = 0; k < v->nrequirement; k++)
        if (v->requirement[k].decision != FW_ACCEPT && !has_reason(v, &v->requirement[k]))
            FW_TRY(add_reason(arena, m, &v->requirement[k], v));
    return FW_OK;
}
