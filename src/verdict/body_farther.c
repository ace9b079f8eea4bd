/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How much farther a place of a body goes in a scene than rigid bodies let it, by all that acts there at once; and, further down,
   what bodies bear.

   Loads f at places of flexible bodies displace them by D f more than of rigid ones, and by least complementary energy D lies
   between 0 and B, the form of 2 U_b of what hinges and loads put on the bodies (body_solids.c). So of a load f and a unit
   load n at the place and along the direction that are asked for

     (n.B f - r)/2 <= n.D f <= (n.B f + r)/2,   r^2 = (n.B n)(f.B f)

   What hinges put on bodies, and what acts beside them, are parts of one f: neither's share alone bounds what they do
   together, which is up to four times the half of each. f: what acts at an instant of the motion, hinges' forces as it has them;
   n: at rest (body_solids.c). A body that has turned by theta since it was drawn turns f against n: 2 theta r besides.
   2 U_b of any direction is that along x and that along y at most. Bodies as beams and as solids are two forms B, and D is below both.

   In: instants kept of a motion, SI. Range: flexures with an axis, no joints beside them. Of a place that is no end of a known
   way (a probe outside of the material) only what goes with the body's middle. Error: a bound, but for what lies between
   the instants. Cost: three energies an instant. Source: least complementary energy (S. Timoshenko, J. Goodier, Theory of
   Elasticity, 3rd ed., art. 86); Cauchy and Schwarz. Theory: docs/theory/verdict.md. Test: test_effects.py BodiesOfBars */
#include "base/constants.h"
#include "geometry/segment.h"
#include "verdict/body.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

typedef struct farther {
    fw_verdict_solids s;
    fw_verdict_bending
        at; /* the places of the scene, and the one that is asked for, if it has a way */
    int scene_places;
    double *load, *unit, *sum; /* instants */
    size_t size;
} farther;

/* what the scene's motion has, and room */
static fw_status farther_new(fw_arena *arena, const fw_verdict_variant_verdict *v,
                             const fw_verdict_bending *b, const fw_device_probe *p, farther *x) {
    const fw_mechanism *m = v->mechanism;
    const fw_geometry_vec2 own = fw_mechanism_local_place(m, p->body, p->x_m, p->y_m);
    const double same_m = 1e-9;
    fw_verdict_place *place;
    fw_mechanism_load_end *end;
    int n, k = 0;
    FW_TRY(fw_verdict_solids_new(arena, v, &x->s));
    FW_TRY(fw_mechanism_load_ends(arena, m, &end, &n));
    FW_NEED(place = fw_arena_array(arena, fw_verdict_place, (size_t)b->nplace + 1));
    if (b->nplace > 0) memcpy(place, b->place, (size_t)b->nplace * sizeof *place);
    x->at = *b;
    x->at.place = place, x->scene_places = b->nplace;
    while (k < n && (end[k].body != p->body || vec_distance(end[k].at, own) > same_m))
        k++;
    const int by = k < n ? 2 * m->nhinge + end[k].first : 0;
    if (k < n && x->s.arm[by].known)
        place[x->at.nplace++] = (fw_verdict_place){
            .body = p->body, .x_m = p->x_m, .y_m = p->y_m, .arm = &x->s.arm[by], .end = by};
    x->size = fw_verdict_instant_size(m, x->at.nplace);
    FW_NEED(x->load = fw_arena_array(arena, double, 3 * x->size));
    x->unit = x->load + x->size, x->sum = x->unit + x->size;
    return FW_OK;
}

/* gives += 2 U_b of a unit load at the place, n.B n */
static fw_status unit_gives(fw_arena *arena, farther *x, const fw_statics_modes *modes,
                            const fw_device_probe *p, double direction_rad, double gives[2]) {
    const fw_mechanism *m = x->s.m;
    double by[2];
    bool mixed = false;
    memset(x->unit, 0, x->size * sizeof *x->unit);
    FW_TRY(fw_verdict_unit_load(arena, &x->s, modes, p->body,
                                fw_mechanism_local_place(m, p->body, p->x_m, p->y_m), direction_rad,
                                x->unit));
    if (x->at.nplace > x->scene_places) {
        double *acts = x->unit + 3 * m->nhinge + m->nbody + 3 * x->scene_places;
        acts[0] = cos(direction_rad), acts[1] = sin(direction_rad);
    }
    fw_verdict_solids_J(&x->s, &x->at, x->unit, by, &mixed);
    gives[0] += 2 * by[0], gives[1] += 2 * by[1];
    return FW_OK;
}

/* n.B f by U_b of the load and so many times the unit load, and less so many; *mixed: it is not known */
static double works(farther *x, int form, double times, bool *mixed) {
    double sum[2][2];
    for (int k = 0; k < 2; k++) {
        for (size_t i = 0; i < x->size; i++)
            x->sum[i] = x->load[i] + (k ? -times : times) * x->unit[i];
        fw_verdict_solids_J(&x->s, &x->at, x->sum, sum[k], mixed);
    }
    return 0.5 * (sum[0][form] - sum[1][form]) / times;
}

/* of an instant; gives: n.B n. What both forms of B allow */
static void take_instant(farther *x, const double *instant, int body, const double gives[2],
                         bool directed, double *down, double *up) {
    const fw_mechanism *m = x->s.m;
    const size_t kept = fw_verdict_instant_size(m, x->scene_places);
    double by[2];
    bool mixed = false;
    memset(x->load, 0, x->size * sizeof *x->load);
    memcpy(x->load, instant, kept * sizeof *instant);
    fw_verdict_solids_J(&x->s, &x->at, x->load, by, &mixed);
    const double size = sqrt(2 * fmin(by[0], by[1]) * fmin(gives[0], gives[1]));
    double low = -size, high = size;
    for (int form = 0; directed && form < 2; form++) {
        const double r = sqrt(2 * by[form] * gives[form]);
        bool unknown = form == 1 && mixed;
        if (!(r > 0) || unknown) continue;
        const double along = works(x, form, sqrt(2 * by[form] / gives[form]), &unknown);
        if (form == 1 && unknown) continue;
        low = fmax(low, 0.5 * (along - r)), high = fmin(high, 0.5 * (along + r));
    }
    const double turned = 2 * fabs(instant[3 * m->nhinge + body]) * size;
    *up = fmax(*up, high + turned), *down = fmax(*down, turned - low);
}

fw_status fw_verdict_goes_farther(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                                  const fw_device_probe *p, double direction_rad,
                                  fw_verdict_soft *soft, double *down, double *up, bool *known) {
    const fw_dynamics_motion *motion = v->motion[scene];
    const fw_verdict_strain_monitor *saw = motion ? motion->observed : NULL;
    const fw_verdict_bending *b = saw ? &saw->bending : NULL;
    static const fw_effect_choice as_it_is = {.mode = FW_EFFECTS_AUTO};
    const bool directed = !isnan(direction_rad);
    double gives[2] = {0};
    farther x;
    *down = *up = 0, *known = false;
    if (!b || !b->arm || !b->kept || b->kept->n == 0 || p->body == FW_GROUND) return FW_OK;
    if (!soft->looked) FW_TRY(fw_verdict_soft_new(arena, &as_it_is, 0, v, soft));
    if (!soft->modes) return FW_OK;
    FW_TRY(farther_new(arena, v, b, p, &x));
    if (!directed) FW_TRY(unit_gives(arena, &x, soft->modes, p, 0.5 * FW_PI, gives));
    FW_TRY(unit_gives(arena, &x, soft->modes, p, directed ? direction_rad : 0, gives));
    *known = x.at.nplace > x.scene_places;
    const size_t kept = fw_verdict_instant_size(v->mechanism, x.scene_places);
    for (int k = 0; k < b->kept->n; k++)
        take_instant(&x, b->kept->instant + (size_t)k * kept, p->body, gives, directed, down, up);
    return FW_OK;
}

/* ---- what is said of it ---- */

fw_status fw_verdict_say_bent(fw_arena *arena, fw_verdict_variant_verdict *v, const char *scene,
                              int number, const char *what, int body, double by_m) {
    char text[32];
    FW_NEED(what);
    what = fw_arena_printf(
        arena,
        "%s, and %s%s, which is rigid there, may bend in the plane by up to %s um where it reaches "
        "beyond its hinges: make it wider or shorter",
        what, FW_NAMED("body", fw_text_name(v->mechanism->body[body].id)),
        fw_number_text(text, sizeof text, 1e6 * by_m, 3));
    return fw_verdict_hangs_open(v, scene, number, what);
}

double fw_verdict_two_farthest(const double *to, int n, int *which) {
    double far = 0, other = 0;
    *which = 0;
    for (int i = 0; i < n; i++)
        if (to[i] > far)
            other = far, far = to[i], *which = i;
        else
            other = fmax(other, to[i]);
    return far + other;
}

fw_status fw_verdict_distances_open(fw_arena *arena, fw_verdict_variant_verdict *v, int scene,
                                    double by, int body) {
    for (int k = 0; by > 0 && k < v->nclearance; k++) {
        fw_verdict_clearance *c = &v->clearance[k];
        if (c->scene_index != scene || c->decision != FW_ACCEPT || c->low_m - by > c->required_m)
            continue;
        c->decision = FW_INCONCLUSIVE;
        FW_TRY(fw_verdict_say_bent(arena, v, v->mechanism->device->scene[scene].name, 638,
                                   c->required_m > 0
                                       ? "what is asked for between parts is only just kept"
                                       : "parts only just do not meet",
                                   body, by));
    }
    return FW_OK;
}

/* ---- what may be met (arm_rims.c) ---- */

/* what it may take of its gap at most where everything it does goes `up` times as far */
double fw_verdict_reach_takes(const fw_verdict_reach *r, double up) {
    return r->closes_m + r->goes_m * (up - 1);
}

const char *fw_verdict_reach_name(fw_arena *arena, const fw_mechanism *m,
                                  const fw_verdict_reach *r) {
    if (r->pin != FW_NONE)
        return fw_arena_printf(arena, "a stop of joint %s", fw_text_name(m->pin[r->pin].id));
    return r->id ? fw_arena_printf(arena, "%s%s", FW_NAMED("contact", r->id)) : "what is touched";
}

fw_status fw_verdict_may_be_met(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                                double missing, double *e, bool *met) {
    const fw_mechanism *m = v->mechanism;
    const fw_dynamics_motion *x = v->motion[scene];
    fw_verdict_shaken own = {.n = 0};
    bool asked = *met = false;
    for (int k = 0; k < v->nrequirement; k++)
        asked = asked || (v->requirement[k].scene_index == scene && v->requirement[k].measure);
    if (!asked || m->nhinge == 0 || !x->loads) return FW_OK;
    const double all = fw_verdict_motion_model_error(m, x) + fw_verdict_bending_share(x) +
                       fw_dynamics_motion_ways_off(x, false) +
                       fmax(0, fw_verdict_flexures_off(m, x) - fw_verdict_motion_lasting_error(m)),
                 unit_m = 1e-3, up = 1 + 2 * (all + missing); /* near a fold it goes farther */
    FW_TRY(fw_verdict_reach_find(arena, x, unit_m, x->q, &own));
    for (int c = 0; c < own.nreach && !*met; c++)
        *met = fw_verdict_reach_takes(&own.reach[c], up) >= own.reach[c].gap_m;
    for (int i = 0; i < x->loads->nspring && !*met; i++)
        *met = x->loads->spring[i].cable;
    return *e = *met ? fmax(*e, all) : *e, FW_OK;
}

/* does it hold where the scene ends, as computed and with flexures softer and stiffer? */
static bool holds(const fw_effects_force_element *contact, const fw_dynamics_motion *x,
                  const fw_verdict_shaken *s) {
    for (int k = 0; k < 3; k++) {
        const fw_dynamics_motion *y = k > 0 ? s->other[k - 1].motion : x;
        fw_dynamics_motion_rows(y, y->nsample - 1, 1);
        const double *q = y->q + ((size_t)y->nsample - 1) * 3 * (size_t)y->nbody;
        if (!(fw_probe_contact_closes(contact, q) > 0)) return false;
    }
    return true;
}

fw_status fw_verdict_held_m(fw_arena *arena, const fw_verdict_variant_verdict *v,
                            const fw_verdict_requirement *r, double *held) {
    const fw_device_requirement *asked = &v->mechanism->device->requirement[r->asked];
    const fw_verdict_shaken *s = &v->shaken[r->scene_index];
    const fw_dynamics_motion *x = v->motion[r->scene_index];
    const size_t n = 3 * (size_t)v->mechanism->nbody;
    if (asked->measure != FW_MEASURE_FINAL || isnan(r->origin)) return FW_OK;
    for (int k = 0; k < 2; k++)
        if (!s->other[k].probe || s->other[k].lost || s->other[k].from_s > 0) return FW_OK;
    const fw_probe *p = &s->other[0].probe->probe[asked->probe];
    const fw_effects_force_element *contact[32]; /* what others hold is not counted */
    double *room = fw_arena_array(arena, double, 4 * n);
    int count = 0;
    FW_NEED(room);
    fw_dynamics_motion_rows(x, 0, x->nsample);
    const double *q = x->q + ((size_t)x->nsample - 1) * n;
    for (size_t i = 0; i < n; i++)
        room[i] = fabs(q[i] - x->q[i]);
    for (int i = 0; i < p->loads.nelement && count < 32; i++)
        if (p->loads.element[i].class_->pressing && holds(&p->loads.element[i], x, s))
            contact[count++] = &p->loads.element[i];
    *held = fmax(0, fabs(r->value - r->origin) -
                        fw_probe_beside(p, contact, count, x->end_s, q, room, room + n));
    return FW_OK;
}

fw_status fw_verdict_may_touch(fw_arena *arena, int scene, fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    const fw_verdict_shaken *s = &v->shaken[scene];
    const double *up = s->each + m->nhinge + m->nbody;
    char gap[32], comes[32], may[32];
    for (int c = 0; c < s->nreach; c++) {
        const fw_verdict_reach *r = &s->reach[c];
        if (r->closes_m >= r->gap_m || !(fw_verdict_reach_takes(r, up[c]) >= r->gap_m)) continue;
        const char *name = fw_verdict_reach_name(arena, m, r);
        FW_NEED(name);
        return fw_verdict_scene_reason(
            v, &m->device->scene[scene], 731, FW_INCONCLUSIVE,
            0.95 * r->gap_m / fw_verdict_reach_takes(r, up[c]),
            fw_arena_printf(
                arena,
                "%s may be met: %s um are left to it, the motion takes %s of them as "
                "computed, and up to %s where a mode lies within its error; what "
                "hinges and contacts bear then is not known",
                name, fw_number_text(gap, sizeof gap, 1e6 * r->gap_m, 3),
                fw_number_text(comes, sizeof comes, 1e6 * r->closes_m, 3),
                fw_number_text(may, sizeof may, 1e6 * fw_verdict_reach_takes(r, up[c]), 3)));
    }
    return FW_OK;
}

/* ---- what bodies do by modes of their own, in what is judged (body_shaken.c) ---- */

/* how far a place goes along (nx, ny), either way, of all modes; {0, 0}: wherever to. speed: m/s */
static double goes_by_own(const fw_verdict_variant_verdict *v, const fw_verdict_swinging *own,
                          int body, double x_m, double y_m, fw_geometry_vec2 n, bool speed) {
    double sum = 0, u[3];
    if (body == FW_GROUND) return 0;
    const fw_geometry_vec2 at = fw_mechanism_local_place(v->mechanism, body, x_m, y_m);
    for (int k = 0; k < own->w->n; k++) {
        fw_verdict_swung_there(own->w, k, body, at, u);
        sum += (speed ? own->fast[k] : own->far[k]) *
               (n.x == 0 && n.y == 0 ? hypot(u[0], u[1]) : fabs(u[0] * n.x + u[1] * n.y));
    }
    return sum;
}

static double turns_by_own(const fw_verdict_swinging *own, int body) {
    const fw_verdict_beams *b = &own->w->beams;
    double sum = 0;
    for (int k = 0; k < own->w->n && body != FW_GROUND; k++) {
        double most = 0;
        for (int i = b->first[body]; i < b->first[body + 1]; i++)
            most = fmax(most, fabs(own->w->goes[(size_t)k * (size_t)b->n + (size_t)i][2]));
        sum += own->far[k] * most;
    }
    return sum;
}

/* of a probe, in its unit; NaN: it has no such way, and goes with what moves most. aside: across its direction */
static double probed_by_own(const fw_verdict_variant_verdict *v, const fw_verdict_swinging *own,
                            const fw_device_probe *p, bool aside) {
    const fw_geometry_vec2 any = {0}, n = aside || isnan(p->direction_rad)
                                              ? any
                                              : (fw_geometry_vec2){cos(p->direction_rad),
                                                                   sin(p->direction_rad)};
    switch (p->row) {
    case FW_PROBE_IS_displacement:
        return goes_by_own(v, own, p->body, p->x_m, p->y_m, n, false);
    case FW_PROBE_IS_velocity:
        return goes_by_own(v, own, p->body, p->x_m, p->y_m, n, true);
    case FW_PROBE_IS_distance:
    case FW_PROBE_IS_opening:
        return goes_by_own(v, own, p->body, p->x_m, p->y_m, any, false) +
               goes_by_own(v, own, p->body_b, p->bx_m, p->by_m, any, false);
    case FW_PROBE_IS_gap:
        return (p->body == FW_GROUND ? 0 : own->way_m[p->body]) +
               (p->body_b == FW_GROUND ? 0 : own->way_m[p->body_b]);
    case FW_PROBE_IS_angle:
        return turns_by_own(own, p->body) + turns_by_own(own, p->body_b);
    case FW_PROBE_IS_force:
    case FW_PROBE_IS_torque:
    case FW_PROBE_IS_power:
    case FW_PROBE_IS_capacitance:
        return (double)NAN;
    case FW_PROBE_IS_stiffness:
    case FW_PROBE_IS_compliance:
    case FW_PROBE_IS_frequency:
    case FW_PROBE_KINDS:
        return 0;
    }
    return 0;
}

/* of what is required in its scene; NaN: it has no such way */
static double asked_by_own(const fw_verdict_variant_verdict *v, const fw_verdict_requirement *r) {
    const fw_device *d = v->mechanism->device;
    const fw_device_requirement *asked = &d->requirement[r->asked];
    const fw_verdict_swinging *own = v->shaken[r->scene_index].own;
    const double by =
        probed_by_own(v, own, &d->probe[asked->probe], asked->measure == FW_MEASURE_PARASITIC);
    return asked->measure == FW_MEASURE_PEAK_TO_PEAK ? 2 * by : by;
}

/* of ways by what goes once: fw_verdict_hangs_in_plane has it beside what bodies give at rest */
static bool goes_once(const fw_verdict_swinging *own, const fw_verdict_requirement *r) {
    return !own->shaken && fw_verdict_moves(r);
}

double fw_verdict_swings_once(const fw_verdict_variant_verdict *v,
                              const fw_verdict_requirement *r) {
    const fw_verdict_swinging *own = v->shaken ? v->shaken[r->scene_index].own : NULL;
    const fw_device *d = v->mechanism->device;
    if (!own || !goes_once(own, r) || d->requirement[r->asked].measure == FW_MEASURE_SETTLING)
        return 0;
    return asked_by_own(v, r);
}

void fw_verdict_swings_required(const fw_verdict_variant_verdict *v, fw_verdict_requirement *r) {
    const fw_device_requirement *asked = &v->mechanism->device->requirement[r->asked];
    const fw_verdict_swinging *own = v->shaken[r->scene_index].own;
    const double little = 0.25; /* of a band that it settles within */
    const bool settles = asked->measure == FW_MEASURE_SETTLING;
    if (!own) return;
    double more = asked_by_own(v, r);
    if (settles && (isnan(more) ? own->share > 0 : more > little * asked->band)) {
        r->open = "bodies swing by modes of their own, beside what rigid bodies do";
        r->low = 0, r->high = HUGE_VAL;
    }
    if (settles || goes_once(own, r)) return;
    if (isnan(more))
        more = own->share * r->swing * (asked->measure == FW_MEASURE_PEAK_TO_PEAK ? 2 : 1);
    r->low -= more, r->high += more;
    if (r->size || isnan(r->origin)) r->low = fmax(0, r->low);
}

/* By what modes that lie elsewhere may do more or less (resonance.c), of how far it goes to and fro. A final value may be where
   phases run apart. A settling time, which goes with the logarithm of what swings, has no bound */
bool fw_verdict_requirement_shaken(const double factor[2], double late, fw_device_measure measure,
                                   fw_verdict_requirement *r) {
    const bool end = measure == FW_MEASURE_FINAL;
    const double more = r->swing_most * (end ? late : factor[0] - 1),
                 less = end ? more : r->swing * (1 - factor[1]);
    if (!(fmax(more, less) > 0) || (measure == FW_MEASURE_SETTLING && factor[0] < 1.02))
        return false;
    if (measure == FW_MEASURE_SETTLING) {
        r->low = 0, r->high = HUGE_VAL;
        r->open = "it is shaken near a mode whose frequency is not known well enough";
    } else if (measure == FW_MEASURE_PEAK || measure == FW_MEASURE_PEAK_TO_PEAK ||
               measure == FW_MEASURE_PARASITIC)
        r->high += more, r->low = fmax(0, r->low - less);
    else
        r->high += fmax(more, less), r->low -= fmax(more, less);
    return r->low = r->size ? fmax(0, r->low) : r->low, true;
}

fw_status fw_verdict_swings_tell(fw_arena *arena, int scene, bool brief, fw_diags *diags,
                                 fw_verdict_variant_verdict *v) {
    const double told = 0.1;
    const fw_mechanism *m = v->mechanism;
    const fw_device_scene *s = &m->device->scene[scene];
    const fw_verdict_swinging *own = v->shaken[scene].own;
    char f[32], up[32];
    int body;
    if (!own) return FW_OK;
    const double by = fw_verdict_two_farthest(own->way_m, m->nbody, &body);
    FW_TRY(fw_verdict_distances_open(arena, v, scene, by, body));
    for (int k = 0; k < v->nstator; k++)
        if (v->stator[k].index == scene) v->stator[k].low_m -= own->way_m[body];
    if (brief || !(own->share > told)) return FW_OK;
    fw_diag_warning(diags, 741, s->place,
                    "in %s%s bodies swing by modes of their own, from %s Hz on, beside what "
                    "rigid bodies do: of what bends and moves most up to %s times as much, which "
                    "the bands hold; make bodies stiffer, or what drives them slower",
                    FW_NAMED("scene", s->name), fw_number_text(f, sizeof f, own->slow_Hz, 3),
                    fw_number_text(up, sizeof up, own->share, 2));
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- whom what hangs over concerns (body_hung.c) ---- */

bool fw_verdict_moves(const fw_verdict_requirement *r) {
    return r->scene_index != FW_NONE && !r->why &&
           fw_words_hold("displacement gap distance opening", " ", r->kind);
}

/* At a corner of a flow nobody has looked at what hangs over yet: it counts where a scene shakes the device in the plane, or weighs
   on it there, and where a stated force acts on the body that is asked, which rings */
bool fw_verdict_asks_hung(const fw_verdict_variant_verdict *v) {
    const fw_device *d = v->mechanism->device;
    bool any = false;
    for (int i = 0; i < d->nscene && !any; i++) {
        const fw_device_scene *s = &d->scene[i];
        any = v->motion[i] && (s->gx_m_per_s2 != 0 || s->gy_m_per_s2 != 0);
        for (int k = 0; k < s->nbase && v->motion[i]; k++)
            any = any || s->base[k].ax_m_per_s2 != 0 || s->base[k].ay_m_per_s2 != 0;
        for (int k = 0; k < s->nforce * v->nrequirement && !any; k++) {
            const fw_verdict_requirement *r = &v->requirement[k / s->nforce];
            const fw_device_probe *p = &d->probe[d->requirement[r->asked].probe];
            any = r->scene_index == i && fw_verdict_moves(r) &&
                  p->body == s->force[k % s->nforce].body;
        }
    }
    return any;
}

/* ---- what hinges bear across the plane ---- */

fw_status fw_verdict_across_strained(fw_arena *arena, const fw_device_scene *s, double in,
                                     fw_verdict_variant_verdict *v, fw_verdict_across *to) {
    char used[32], plane[32];
    const bool sure = to->strained_sure > 1;
    if (!(to->strained > 1)) return FW_OK;
    const fw_verdict_decision decision = sure ? FW_REJECT : FW_INCONCLUSIVE;
    to->decision = fw_verdict_worse(to->decision, decision);
    fw_percent_text(used, sizeof used, sure ? to->strained_sure : to->strained);
    fw_percent_text(plane, sizeof plane, in);
    if (!isfinite(to->strained) && !sure)
        return fw_verdict_scene_reason(
            v, s, 641, decision, FW_VERDICT_KEEP_HALF,
            fw_arena_printf(arena,
                            "what hinges bear across the plane in %s%s is not known: "
                            "nothing bounds the law of its shock; state it as a table, "
                            "or by a law that has a largest value",
                            FW_NAMED("scene", s->name)));
    return fw_verdict_scene_reason(
        v, s, 641, decision, 0.95 / (sure ? to->strained_sure : to->strained),
        fw_arena_printf(arena,
                        "%s%s bends across the plane in %s%s, and uses %s%s %% of its "
                        "limit there (in the plane at most %s %%); a thicker layer, "
                        "shorter or wider flexures, lighter bodies or a weaker shock "
                        "relieve it",
                        FW_NAMED("hinge", to->strained_hinge), FW_NAMED("scene", s->name),
                        sure ? "" : "up to ", used, plane));
}

/* ---- what hangs over bends in the plane ----
   Bodies are rigid in the motion, and what they give between their hinges is in every band. What a load beside these
   displaces, by the way from it to the middle (body_arms.c), is at most F (d + c r)/(E h), d and c what its place goes and
   turns by for F = E h, r how far the body reaches beyond; twice that, since a sudden load does twice what it does at rest.
   What shaking and weight do to what reaches farther: body_tree.c. Test: test_out_of_plane.py */

static fw_status reaches_beyond(fw_arena *arena, const fw_mechanism *m,
                                const fw_mechanism_load_end *end, double *beyond_m) {
    const fw_geometry_vec2 middle = {m->drawn[end->body].x_m, m->drawn[end->body].y_m},
                           off = vec_sub(end->at, middle);
    fw_mechanism_line *line;
    int n;
    *beyond_m = 0;
    if (!(vec_length(off) > 0)) return FW_OK;
    const fw_geometry_vec2 along = vec_unit(off);
    FW_TRY(fw_mechanism_body_lines(arena, m->layout, end->body, &line, &n));
    for (int i = 0; i < n; i++)
        *beyond_m = fmax(*beyond_m, vec_dot(vec_sub(line[i].a, end->at), along));
    return FW_OK;
}

/* on the same side of a body's middle */
static bool on_same_side(const fw_mechanism *m, const fw_mechanism_load_end *a,
                         const fw_mechanism_load_end *b) {
    const fw_geometry_vec2 middle = {m->drawn[a->body].x_m, m->drawn[a->body].y_m};
    return a->body == b->body && vec_dot(vec_sub(a->at, middle), vec_sub(b->at, middle)) >= 0;
}

/* what all loads bend that act on the same side as this one */
static double on_one_side(const fw_mechanism *m, const fw_mechanism_load_end *end, const double *by,
                          int n, int k) {
    double sum = 0;
    for (int i = 0; i < n; i++)
        if (on_same_side(m, &end[i], &end[k])) sum += by[i];
    return sum;
}

fw_status fw_verdict_bends_in_plane(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                                    const fw_verdict_hung *hung, const fw_device_probe *but,
                                    double *to, double *apart_m) {
    const fw_mechanism *m = v->mechanism;
    const fw_verdict_strain_monitor *saw = v->motion[scene] ? v->motion[scene]->observed : NULL;
    const fw_verdict_bending *b = saw ? &saw->bending : NULL;
    const fw_device_scene *s = &m->device->scene[scene];
    const double sudden = 2, hardly_m = 1e-9;
    double shaken = hypot(s->gx_m_per_s2, s->gy_m_per_s2), beyond_m, *by, *most;
    fw_mechanism_load_end *end;
    int n, own = FW_NONE;
    *apart_m = 0;
    for (int i = 0; i < m->nbody; i++)
        to[i] = 0;
    if (!b || !b->arm || !b->rest_N) return FW_OK;
    for (int i = 0; i < s->nbase; i++)
        shaken += sudden * hypot(s->base[i].ax_m_per_s2, s->base[i].ay_m_per_s2) *
                  fw_quantity_law_largest(s->base[i].law, s->duration_s);
    for (int i = 0; i < m->nbody; i++)
        to[i] = shaken > 0 && hung ? hung[i].in_plane_s2 * shaken : 0;
    FW_TRY(fw_mechanism_load_ends(arena, m, &end, &n));
    FW_NEED(by = fw_arena_array(arena, double, (size_t)n));
    FW_NEED(most = fw_arena_array(arena, double, (size_t)m->nbody));
    for (int k = 0; k < n; k++) {
        const fw_verdict_arm *arm = &b->arm[2 * m->nhinge + k];
        const double *g = arm->give;
        if (end[k].scene != scene || !arm->known) continue;
        if (but && fw_verdict_bends_own(&end[k], scene, but)) {
            own = k;
            continue;
        }
        const double load_N =
            isfinite(end[k].known_N) ? end[k].known_N : fw_verdict_load_N(end, n, k, b->rest_N);
        const double unit = sudden * load_N / b->stiff_N, goes = fw_verdict_arm_goes(arm);
        if (!(unit * goes > hardly_m)) continue;
        FW_TRY(reaches_beyond(arena, m, &end[k], &beyond_m));
        by[k] = unit * (goes + hypot(g[1], g[2]) * beyond_m);
    }
    for (int k = 0; k < n; k++) {
        const double side = on_one_side(m, end, by, n, k);
        if (own != FW_NONE && end[k].body == end[own].body && !on_same_side(m, &end[k], &end[own]))
            *apart_m = fmax(*apart_m, side);
        else
            most[end[k].body] = fmax(most[end[k].body], side);
    }
    if (but) *apart_m += to[but->body];
    for (int i = 0; i < m->nbody; i++)
        to[i] += most[i];
    return FW_OK;
}

/* ---- what of a clearance is used ---- */

static double between(double used) {
    const double least = 1e-3, most = 1e3; /* a thousandth is as good as nothing, and has slopes */
    return fmin(fmax(used, least), most);
}

/* Share of what there is to use up by the nearest pair: of a motion, the distance that it has lost over
   what it may lose; of a required box, what is asked for over what is left. At 1 there is just as
   much as is asked for. */
double fw_verdict_search_used_nearest(const fw_verdict_clearance *c) {
    const fw_clearance_least *l = &c->least;
    const double target = c->required_m + c->wall_m, most = HUGE_VAL;
    double used = target / l->m;
    if (c->box == FW_NONE) used = (l->start_m - l->m) / (l->start_m - target);
    if (c->box == FW_NONE && l->start_m <= target) used = most;
    if (l->m <= 0) used = 1 / l->share;
    return between(used);
}

/* By any pair of a motion: what is nearest may have lost nothing of its distance, as fingers of a comb that slide
   by each other, while others have lost nearly all. by_nearest: distances were found, not bounded */
double fw_verdict_search_used(const fw_verdict_clearance *c, bool by_nearest) {
    const bool meet = c->least.m <= 0 && c->least.share > 0;
    const double nearest = by_nearest || meet ? fw_verdict_search_used_nearest(c) : 0;
    return between(c->box == FW_NONE ? fmax(nearest, c->way.share) : nearest);
}
