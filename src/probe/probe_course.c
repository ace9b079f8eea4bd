/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Probes followed along a motion: extremes between the instants, and by how much they may be off. */
#include "probe/probe.h"
#include "base/text.h"
#include <float.h>
#include <math.h>
#include <string.h>

static bool looks_at(const fw_probe_monitor *w, int probe) {
    return !w->only || w->only[probe];
}

fw_status fw_probe_monitor_new(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                               const bool *history, const bool *only, fw_probe_monitor *monitor) {
    *monitor = (fw_probe_monitor){
        .arena = arena, .mechanism = m, .scene = scene, .history = history, .only = only};
    FW_NEED(monitor->course = fw_arena_array(arena, fw_probe_course, (size_t)fw_probe_count(m)));
    for (int i = 0; i < fw_probe_count(m); i++) {
        const fw_device_probe_kind *kind = &fw_device_probe_kinds[m->device->probe[i].row];
        monitor->within =
            monitor->within || (looks_at(monitor, i) && kind->takes == FW_PROBE_OUTLINES);
    }
    return monitor->within ? fw_clearance_path_of(arena, m->nbody, 1, &monitor->piece) : FW_OK;
}

/* ---- extremes ---- */

/* value and place of the extreme of the parabola through three instants, spacings a and b about the
   middle one; false: it has none between them.
     slope = ((s1-s0) b/a + (s2-s1) a/b)/(a+b), bend = 2 ((s2-s1)/b - (s1-s0)/a)/(a+b)
     at t1 - slope/bend, s1 - slope^2/(2 bend)
   in: times s, values in any unit; error O(spacing^3) of the extreme, bounded by what is added;
   source: Newton's divided differences; test_probe.c finds_extremes_between_instants */
static bool turns(const double t[3], const double s[3], double *at, double *value) {
    double a = t[1] - t[0], b = t[2] - t[1], up = s[1] - s[0], down = s[2] - s[1];
    if (!(a > 0 && b > 0) || !((up >= 0 && down <= 0) || (up <= 0 && down >= 0)) || up == down)
        return false;
    double slope = (up * b / a + down * a / b) / (a + b), bend = 2 * (down / b - up / a) / (a + b);
    *at = t[1] - slope / bend;
    *value = s[1] - slope * slope / (2 * bend);
    return true;
}

static void raise(fw_probe_extreme *e, double sign, double value, double t_s, double between,
                  bool first) {
    if (!first && !(sign * value > sign * e->value)) return;
    *e = (fw_probe_extreme){value, t_s, between};
}

/* Of every four neighbours the least and the most stay, in the order of time: all that a slow swing goes over, at places that are
   off by as much as these are apart, and how far a fast one goes, though not how often. The last ones stay as they are */
static void thin(fw_probe_course *c) {
    size_t n = 0, i = 0;
    for (; i + 4 < c->kept; i += 4) {
        size_t least = i, most = i;
        for (size_t k = i + 1; k < i + 4; k++) {
            if (c->value[k] < c->value[least]) least = k;
            if (c->value[k] > c->value[most]) most = k;
        }
        const size_t first = least < most ? least : most, last = least < most ? most : least;
        c->time[n] = c->time[first], c->value[n++] = c->value[first];
        if (last > first) c->time[n] = c->time[last], c->value[n++] = c->value[last];
    }
    for (; i < c->kept; i++, n++)
        c->time[n] = c->time[i], c->value[n] = c->value[i];
    c->kept = n;
}

/* late: the end of a course, of which as much is kept as three swings show in */
static fw_status keep(fw_arena *arena, fw_probe_course *c, bool late, double t_s, double value) {
    if (late && c->kept == FW_PROBE_KEPT_LATE) thin(c);
    if (c->kept == c->room) {
        size_t room = c->room ? 2 * c->room : 1024;
        FW_NEED(c->time = fw_arena_grow(arena, c->time, c->kept, room, sizeof *c->time));
        FW_NEED(c->value = fw_arena_grow(arena, c->value, c->kept, room, sizeof *c->value));
        c->room = room;
    }
    c->time[c->kept] = t_s;
    c->value[c->kept++] = value;
    return FW_OK;
}

/* sizes of the displacement across, as the values */
static void add_across(fw_probe_course *c, const double t[3], double across) {
    const double s[3] = {c->a[0], c->a[1], across};
    double at, top;
    if (c->samples >= 2 && turns(t, s, &at, &top))
        raise(&c->across, 1, fabs(top), at, fabs(top - s[1]), false);
    raise(&c->across, 1, fabs(across), t[2], 0, c->count == 0);
    c->a[0] = c->a[1], c->a[1] = across;
}

/* of a course at an instant: nothing is kept; all of it is; its end is */
typedef enum kept_part { KEPT_NOT, KEPT_WHOLE, KEPT_LATE } kept_part;

static kept_part part_kept(const fw_probe_monitor *w, int probe, double t_s) {
    if (w->history && w->history[probe]) return KEPT_WHOLE;
    return w->late && w->late[probe] && t_s >= w->late_s ? KEPT_LATE : KEPT_NOT;
}

/* smooth: a parabola finds its extremes */
static fw_status add(fw_arena *arena, fw_probe_course *c, bool smooth, kept_part part, double t_s,
                     double value, double across) {
    const double t[3] = {c->t[0], c->t[1], t_s}, s[3] = {c->s[0], c->s[1], value};
    const bool late = part == KEPT_LATE;
    double at, top;
    if (smooth && c->samples >= 2 && turns(t, s, &at, &top)) {
        raise(&c->maximum, 1, top, at, fabs(top - s[1]), false);
        raise(&c->minimum, -1, top, at, fabs(top - s[1]), false);
        if (part && c->kept > 0 && at < t[1]) { /* in the order of time */
            c->kept--;
            FW_TRY(keep(arena, c, late, at, top));
            FW_TRY(keep(arena, c, late, t[1], s[1]));
        } else if (part && at > t[1])
            FW_TRY(keep(arena, c, late, at, top));
    }
    raise(&c->maximum, 1, value, t_s, 0, c->count == 0);
    raise(&c->minimum, -1, value, t_s, 0, c->count == 0);
    if (!isnan(across)) add_across(c, t, across);
    if (part) FW_TRY(keep(arena, c, late, t_s, value));
    c->final = value;
    c->t[0] = c->t[1], c->t[1] = t_s;
    c->s[0] = c->s[1], c->s[1] = value;
    c->samples++, c->count++;
    return FW_OK;
}

static fw_status take(fw_probe_monitor *w, const fw_dynamics_instant *now) {
    const int n = fw_probe_count(w->mechanism);
    if (w->loads != now->loads) {
        FW_TRY(fw_probe_bind(w->arena, w->mechanism, w->scene, now->loads, &w->probe));
        w->loads = now->loads;
        if (w->late && w->late_from) FW_TRY(w->late_from(w->of, w, &w->late_s));
    }
    const fw_probe_state state = fw_probe_state_of(now);
    for (int i = 0; i < n; i++) {
        const fw_probe *p = &w->probe[i];
        fw_probe_course *c = &w->course[i];
        if (!looks_at(w, i)) continue;
        double value = fw_probe_value(p, &state);
        if (isnan(value)) continue;
        if (now->begins) c->samples = 0; /* no parabola across a jump */
        FW_TRY(add(w->arena, c, !p->row->within, part_kept(w, i, now->t_s), now->t_s, value,
                   fw_probe_across(p, &state)));
    }
    return FW_OK;
}

void fw_probe_monitor_record(void *context, const fw_dynamics_instant *now) {
    fw_probe_monitor *w = context;
    const size_t n = (size_t)fw_probe_count(w->mechanism);
    if (w->no_memory) return;
    if (now)
        w->no_memory = take(w, now) != FW_OK;
    else
        memset(w->course, 0, n * sizeof *w->course);
}

/* ---- the thirds of a step ---- */

/* Between places evenly apart a parabola leaves its values by an eighth of their second difference, and what is smooth leaves
   the parabola by less than the third one. Half of the second one and all of the third must stay short of the extremes so
   far: so no sine of up to 2.1 rad a third comes to them, whatever its phase (a search over both); more than 2 rad no
   explicit step has that is stable. Test: test_probe.c thirds_of_a_sine */
static bool stays_within(const double s[4], double low, double high) {
    const double bend = fmax(fabs(s[0] - 2 * s[1] + s[2]), fabs(s[1] - 2 * s[2] + s[3])),
                 beyond = bend / 2 + fabs(s[0] - 3 * s[1] + 3 * s[2] - s[3]);
    for (int i = 0; i < 4; i++)
        if (!(s[i] - beyond > low && s[i] + beyond < high)) return false;
    return true;
}

bool fw_probe_monitor_glance(const fw_probe_monitor *w, const fw_dynamics_instant *third) {
    if (w->loads != third[0].loads || !w->probe) return false;
    for (int i = 0; i < fw_probe_count(w->mechanism); i++) {
        const fw_probe_course *c = &w->course[i];
        if (!looks_at(w, i)) continue;
        double s[4] = {c->s[1]}, across[4] = {c->a[1]};
        for (int k = 0; k < FW_THIRDS; k++) {
            const fw_probe_state state = fw_probe_state_of(&third[k]);
            s[k + 1] = fw_probe_value(&w->probe[i], &state);
            across[k + 1] = fw_probe_across(&w->probe[i], &state);
        }
        if (isnan(s[1]) && c->count == 0) continue;
        if (c->samples < 2 || part_kept(w, i, third[FW_THIRDS - 1].t_s) ||
            !stays_within(s, c->minimum.value, c->maximum.value))
            return false;
        if (!isnan(across[1]) && !stays_within(across, -c->across.value, c->across.value))
            return false;
    }
    return true;
}

/* the straight ways of jumps are no part of the motion */
void fw_probe_monitor_trace(void *context, const fw_dynamics_piece *piece) {
    fw_probe_monitor *w = context;
    if (!w->within || !piece || piece->jump || !w->probe || w->no_memory) return;
    w->piece.npiece = 0;
    fw_clearance_path_add(&w->piece, piece);
    for (int i = 0; i < fw_probe_count(w->mechanism); i++)
        if (looks_at(w, i) && w->probe[i].in_scene && w->probe[i].row->within)
            w->probe[i].row->within(&w->probe[i], &w->piece, &w->course[i]);
}

/* ---- errors ---- */

/* what relative errors of the motion are of, at most */
static double farthest(const fw_probe_course *c, double origin) {
    if (c->searched) return c->moved;
    return fmax(fabs(c->maximum.value - origin), fabs(c->minimum.value - origin));
}

/* what the next model of the hinges changes, relative to the value there. A value that is small
   there counts with a tenth of the largest. Velocities and the forces of joints that are no pins are
   not known there */
static double level_of(const fw_probe *p, const fw_dynamics_motion *motion,
                       double (*of)(const fw_probe *, const fw_probe_state *), double largest,
                       double origin) {
    const fw_statics_level_step *step = motion->level;
    if (!step || step->why_not || step->used == step->next || !p->row->value) return (double)NAN;
    double value[2];
    for (int i = 0; i < 2; i++) {
        const fw_statics_level_state *at = i ? &step->up : &step->at;
        const fw_probe_state s = {.t_s = isnan(step->t_s) ? motion->end_s : step->t_s,
                                  .piece_s = isnan(step->t_s) ? motion->end_s : step->t_s,
                                  .q = at->q,
                                  .angle_rad = at->angle_rad,
                                  .reaction_N = at->reaction_N,
                                  .still = true};
        value[i] = of(p, &s);
    }
    const double at_s = isnan(step->t_s) ? motion->end_s : step->t_s;
    const fw_probe_state used = {.t_s = at_s, .piece_s = at_s, .q = step->at.q, .still = true};
    double away = p->row->moved ? p->row->moved(p, &used) : fabs(value[0] - origin);
    double size = fmax(away, 0.1 * largest), change = fabs(value[1] - value[0]);
    /* a contact that only the next model meets presses by no share of nothing, but by what is left of its way */
    if (size == 0 && p->element && p->element->class_->pressing) return (double)NAN;
    return change == 0 ? 0 : change / size;
}

/* Twice what two runs differ by, times the margin of the two, the error of the search, and the
   relative error of the motion as a whole (fw_dynamics_motion_ways_off: numbers, effects left
   out). A sequence of equilibria has one run, whose instants are solved for. */
static double numeric(double apart, double between, double value, double estimated, double margin) {
    return 2 * margin * apart + between + (estimated + 64 * DBL_EPSILON) * fabs(value);
}

bool fw_probe_is_size(const fw_device *device, const fw_device_probe *asked) {
    bool pulls = asked->carrier == FW_CARRIER_TENDON || asked->carrier == FW_CARRIER_CONTACT;
    for (int i = 0; asked->of && asked->carrier == FW_CARRIER_SPRING && i < device->nspring; i++)
        pulls = pulls || (device->spring[i].cable && fw_text_same(device->spring[i].id, asked->of));
    return asked->row == FW_PROBE_IS_distance || (asked->row == FW_PROBE_IS_force && pulls);
}

/* Friction of eyelets that bend a cable, which no motion has (effects/eyelet_friction.c), makes its tension another one before
   them, by the share that the ledger knows; that is the error of its tension. What moves by it changes nothing of a tension
   that is stated. Test: tests/cli/test_effects.py */
static void rub(const fw_probe_monitor *w, const fw_probe *p, const fw_dynamics_motion *motion,
                fw_probe_result *r) {
    const double rubs = motion->ledger.rubs;
    if (!(rubs > 0) || p->asked->row != FW_PROBE_IS_force || p->asked->carrier != FW_CARRIER_TENDON)
        return;
    for (int i = 0; i < w->scene->ntendon; i++) {
        const fw_device_tendon *t = &w->scene->tendon[i];
        if (!t->id || !p->asked->of || strcmp(t->id, p->asked->of) != 0) continue;
        const double far = fmax(fabs(r->maximum), fabs(r->minimum)),
                     more = t->neyelet > 2 ? rubs * far : 0;
        if (!isnan(t->pull_N)) r->numeric = r->final_numeric = 64 * DBL_EPSILON * far;
        r->numeric += more, r->final_numeric += more;
    }
}

/* lengths of which a probe is made, each of which may be off by what any travel is */
static double lengths_of(const fw_probe *p) {
    switch (p->asked->row) {
    case FW_PROBE_IS_displacement:
        return 1;
    case FW_PROBE_IS_distance:
    case FW_PROBE_IS_opening:
    case FW_PROBE_IS_gap:
        return 2;
    case FW_PROBE_IS_velocity:
    case FW_PROBE_IS_angle:
    case FW_PROBE_IS_force:
    case FW_PROBE_IS_torque:
    case FW_PROBE_IS_power:
    case FW_PROBE_IS_capacitance:
    case FW_PROBE_IS_stiffness:
    case FW_PROBE_IS_compliance:
    case FW_PROBE_IS_frequency:
    case FW_PROBE_KINDS:
        return 0;
    }
    return 0;
}

/* course c of the motion, o of the looser run or NULL */
static void errors(const fw_probe *p, const fw_probe_course *c, const fw_probe_course *o,
                   const fw_dynamics_motion *motion, fw_probe_result *r) {
    double estimated = fw_dynamics_motion_ways_off(motion, false),
           margin = motion->stats.estimate_margin;
    bool alone = motion->loads && motion->loads->quasi_static;
    if (!alone && !o) {
        r->numeric = r->final_numeric = r->across_numeric = (double)INFINITY;
        return;
    }
    double most = 0, last = 0, aside = 0;
    if (o && o->count > 0 && !alone) {
        most = fmax(fabs(c->maximum.value - o->maximum.value),
                    fabs(c->minimum.value - o->minimum.value));
        last = fabs(c->final - o->final), aside = fabs(c->across.value - o->across.value);
    }
    double between = fmax(c->maximum.between, c->minimum.between);
    if (c->searched) between = fmax(c->minimum.value - c->below, c->above - c->maximum.value);
    double far = farthest(c, r->origin);
    const double travel = alone ? 0 : lengths_of(p) * fw_dynamics_motion_travel_off(motion);
    r->numeric = numeric(most, between, far, estimated, margin) + travel;
    r->final_numeric = numeric(last, 0, far, estimated, margin) + travel;
    r->across_numeric = numeric(aside, c->across.between, r->across, estimated, margin) + travel;
}

void fw_probe_result_of(const fw_probe_monitor *monitor, const fw_probe_monitor *looser,
                        const fw_dynamics_motion *motion, int probe, fw_probe_result *r) {
    const fw_probe_course *c = &monitor->course[probe];
    *r = (fw_probe_result){.maximum = (double)NAN,
                           .minimum = (double)NAN,
                           .final = (double)NAN,
                           .peak = (double)NAN,
                           .across = (double)NAN,
                           .moved = (double)NAN,
                           .met = (double)NAN,
                           .level = (double)NAN,
                           .across_level = (double)NAN};
    if (c->count == 0) return;
    bool down = fabs(c->minimum.value) > fabs(c->maximum.value);
    r->known = true;
    r->maximum = c->maximum.value, r->maximum_t_s = c->maximum.t_s;
    r->minimum = c->minimum.value, r->minimum_t_s = c->minimum.t_s;
    r->peak = down ? r->minimum : r->maximum;
    r->peak_t_s = down ? r->minimum_t_s : r->maximum_t_s;
    r->final = c->final;
    r->across = c->across.value, r->across_t_s = c->across.t_s;
    const fw_probe *p = &monitor->probe[probe];
    r->origin = fw_probe_origin(p);
    errors(p, c, looser ? &looser->course[probe] : NULL, motion, r);
    rub(monitor, p, motion, r);
    if (p->row->moved) r->moved = c->moved;
    if (c->meets && fw_probe_gap_etched_m(p) == 0) r->met = c->moved > 0 ? c->met / c->moved : 0;
    if (p->row->moved && c->minimum.value == 0) { /* how deep they are in each other is not known */
        r->numeric += fw_probe_gap_etched_m(p);
        r->final_numeric += fw_probe_gap_etched_m(p);
    }
    r->level = level_of(p, motion, fw_probe_value, farthest(c, r->origin), r->origin);
    if (p->row->across) r->across_level = level_of(p, motion, fw_probe_across, r->across, 0);
}

double fw_probe_monitor_unsettled(const fw_probe_monitor *tighter, const fw_probe_monitor *looser,
                                  double margin, double accuracy) {
    const double nothing = 1e-6; /* of what is required */
    double worst = 0;
    for (int i = 0; tighter->judged && i < fw_probe_count(tighter->mechanism); i++) {
        const fw_probe_course *c = &tighter->course[i], *o = &looser->course[i];
        if (!tighter->judged[i] || c->count == 0 || o->count == 0) continue;
        double origin = fw_probe_origin(&tighter->probe[i]);
        double far = fmax(farthest(c, origin), nothing * tighter->asked[i]);
        double apart = fmax(fabs(c->maximum.value - o->maximum.value),
                            fabs(c->minimum.value - o->minimum.value));
        if (apart > 0) worst = fmax(worst, 2 * margin * apart / (fmin(30 * accuracy, 0.03) * far));
    }
    return worst;
}

/* ---- what rings where a motion ends ---- */

/* The last three turns of values, the last first, each of which is followed by one of the other kind more than h away; how
   many there are. The end is none. */
static int last_turns(const double *value, size_t n, double h, size_t turn[3]) {
    size_t low = n - 1, high = n - 1;
    int found = 0, seeks = 0; /* 1: a most, -1: a least, 0: either */
    for (size_t i = n - 1; i-- > 0 && found < 3;) {
        if (value[i] < value[low]) low = i;
        if (value[i] > value[high]) high = i;
        if (seeks >= 0 && value[i] < value[high] - h) {
            if (high < n - 1) turn[found++] = high;
            seeks = -1, low = i;
        } else if (seeks <= 0 && value[i] > value[low] + h) {
            if (low < n - 1) turn[found++] = low;
            seeks = 1, high = i;
        }
    }
    return found;
}

double fw_probe_rings_from(double end_s, double slowest_s) {
    return slowest_s > 0 ? end_s - 3 * slowest_s : end_s;
}

void fw_probe_rings(const fw_probe_course *c, double slowest_s, fw_probe_ring *ring) {
    *ring = (fw_probe_ring){0, c->final, c->final};
    if (c->kept < 2 || !(slowest_s > 0)) return;
    const double end_s = c->time[c->kept - 1], from_s = fw_probe_rings_from(end_s, slowest_s);
    size_t first = c->kept - 1, turn[3];
    while (first > 0 && c->time[first - 1] >= from_s)
        first--;
    const double *t_s = c->time + first, *value = c->value + first;
    const size_t count = c->kept - first;
    double low = c->final, high = c->final;
    for (size_t i = 0; i < count; i++)
        low = fmin(low, value[i]), high = fmax(high, value[i]);
    for (double h = 0; h<high - low; h = h> 0 ? 2 * h : 1e-4 * (high - low)) {
        if (last_turns(value, count, h, turn) < 3) break;
        const double half_s = t_s[turn[0]] - t_s[turn[1]];
        if (half_s > 0.75 * slowest_s || end_s - t_s[turn[0]] > 1.5 * half_s) continue;
        for (int i = 0; i < 3; i++)
            ring->low = fmin(ring->low, value[turn[i]]),
            ring->high = fmax(ring->high, value[turn[i]]);
        ring->amplitude = fmax(ring->amplitude, 0.5 * fmax(fabs(value[turn[0]] - value[turn[1]]),
                                                           fabs(value[turn[1]] - value[turn[2]])));
    }
}

/* ---- settling ---- */

void fw_probe_range(const fw_probe_course *c, double from_s, double *low, double *high) {
    *low = *high = c->final;
    for (size_t i = c->kept; i-- > 0 && (c->time[i] >= from_s || i + 2 >= c->kept);)
        *low = fmin(*low, c->value[i]), *high = fmax(*high, c->value[i]);
}

double fw_probe_settling_s(const fw_probe_course *c, double rest, double band) {
    for (size_t i = c->kept; i-- > 0;) {
        double off = fabs(c->value[i] - rest) - band;
        if (off <= 0) continue;
        if (i + 1 >= c->kept) return c->time[i];
        double next = fabs(c->value[i + 1] - rest) - band, span = c->time[i + 1] - c->time[i];
        return c->time[i] + (next < off ? span * off / (off - next) : span);
    }
    return 0;
}
