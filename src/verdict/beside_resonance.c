/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What stiffnesses that are off do to a scene that shakes or rings: where bands by modes (resonance.c) leave a hinge open, and
   nothing else does, the scene is moved again.

   A mode that lies elsewhere does r times what it does as computed. Added up over modes, each at its worst, that bounds from
   far what a device does: loads hold most of it as they did, and phases of what swings farthest hardly change by the error
   of a frequency. So with U the largest strain of a hinge as computed, and U' in a motion with other stiffnesses,

     L = sum over ways i of |U'_i/U - 1|,   R = most of U'/U - 1, or of 1 - U'/U, of devices that are off at random,
     up = 1 + 5/4 max(L, R) - e_above,   down = (1 - 5/4 max(L, R))/(1 - e_below)

   stand for (7) of docs/theory/verdict.md: L has what goes in proportion, at its worst, R what does not, as the phases of what is
   fast and peaks that were not the largest; a quarter more since others may do more. e_above and e_below are what bands have of
   stiffnesses anyway. What bodies give and what damps stays as (7) has it, and so does a law that goes to and fro at modes
   whose phase the error of their frequency turns by more than 2 radians while they swing: no motion may be at that resonance.
   Ways: of flexures that are alike what they give as they turn, unless their stiffness is stated, and what they give against
   forces, by what the law of either is off; of all what the next model of hinges may change. At random: each of them by itself
   within its error, of every second device at an end of it.
   In: v->motion; errors of closed forms. Out: factors of hinges. Range: no fatigue, nothing that takes hold, exact beams where
   closed forms move the device as they do; where one of the motions does not get to its end nothing is said. Error: an
   estimate, to which devices at random within these errors keep (test_beside_resonance.c). Cost: a motion for each way, and
   for 24 devices at random, of which 8 are enough where R is below 4/5 of L; none where that decides nothing. Source:
   docs/decisions/0249-moved-with-other-stiffnesses.md */
#include "chance/random.h"
#include "statics/statics.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* ---- a device whose flexures are off ---- */

static fw_status off_law(fw_arena *arena, const double off[3], fw_flexure_hinge_law *law) {
    FW_TRY(fw_flexure_hinge_law_scale(arena, law, 1 + off[0]));
    if (law->table || !fw_flexure_hinge_law_straight(law)) {
        const double most = law->table ? fmax(off[1], off[2]) : off[1];
        FW_TRY(fw_flexure_hinge_law_along(arena, law, 1 + most));
        if (!law->table) law->uneven_y = (1 + law->uneven_y) * (1 + off[1]) / (1 + off[2]) - 1;
        return FW_OK;
    }
    law->uneven_x = (1 + law->uneven_x) / (1 + off[1]) - 1, law->root_m_per_N /= 1 + off[1];
    return fw_flexure_hinge_law_along(arena, law, 1 + off[2]); /* a strip, along itself */
}

fw_status fw_verdict_with_stiffness(fw_arena *arena, const fw_mechanism *m, double (*off)[3],
                                    fw_mechanism *to) {
    const size_t np = (size_t)m->npin, nh = (size_t)m->nhinge;
    *to = *m;
    FW_NEED(to->pin = fw_arena_grow(arena, m->pin, np, np, sizeof *m->pin));
    FW_NEED(to->hinge = fw_arena_grow(arena, m->hinge, nh, nh, sizeof *m->hinge));
    for (int k = 0; k < m->nhinge; k++) {
        fw_mechanism_hinge *h = &to->hinge[k];
        FW_TRY(off_law(arena, off[k], &h->law));
        to->pin[h->pin].stiffness_Nm_per_rad *= 1 + off[k][0];
        h->scale *= 1 + off[k][0];
    }
    return FW_OK;
}

/* ---- which way they may be off ---- */

typedef struct again { /* a scene that is moved again */
    fw_arena *arena;
    const fw_mechanism *m;
    const fw_dynamics_motion *shown, *like; /* of the verdict; what others are compared with */
    const fw_dynamics_motion_options *given;
    const fw_device_scene *scene;
    double (*way)[3]; /* (ways x nhinge) */
    double *more;     /* (ways x nhinge) what of a strain each way adds, relative */
    int ways;
    bool whole; /* all of them got to their end */
} again;

static bool same_law(const fw_mechanism_hinge *a, const fw_mechanism_hinge *b) {
    const fw_flexure_input *p = &a->input, *q = &b->input;
    return a->stated == b->stated && a->flexure == b->flexure && p->width_m == q->width_m &&
           p->length_m == q->length_m && p->depth_m == q->depth_m;
}

static double (*new_way(again *w))[3] {
    return w->way + (size_t)w->ways++ * (size_t)w->m->nhinge;
}

static fw_status find_ways(again *w, double common) {
    const double little = 1e-5;
    const fw_mechanism *m = w->m;
    const bool gives = w->like->ledger.hinge.used != FW_HINGE_REVOLUTE;
    const size_t nh = (size_t)m->nhinge, most = nh * (2 * nh + 1);
    FW_NEED(w->way = fw_arena_alloc(w->arena, most, sizeof *w->way));
    FW_NEED(w->more = fw_arena_array(w->arena, double, most));
    memset(w->way, 0, most * sizeof *w->way);
    for (int k = 0; k < m->nhinge; k++) {
        bool first = true;
        for (int i = 0; i < k; i++)
            first = first && !same_law(&m->hinge[i], &m->hinge[k]);
        for (int forces = 0; forces < 2 && first; forces++) {
            if (forces ? !gives : m->hinge[k].stated) continue;
            double(*way)[3] = new_way(w);
            for (int i = k; i < m->nhinge; i++) {
                const fw_flexure_error *e = &m->hinge[i].closed_form.error;
                if (!same_law(&m->hinge[i], &m->hinge[k])) continue;
                way[i][0] = forces ? 0 : e->stiffness;
                way[i][1] = forces ? e->kx : 0, way[i][2] = forces ? e->ky : 0;
            }
        }
    }
    double(*way)[3] = common > little ? new_way(w) : NULL;
    for (int k = 0; way && k < m->nhinge; k++)
        way[k][0] = common;
    return FW_OK;
}

/* ---- the same scene with other stiffnesses ---- */

/* the motion of m, of which peaks of strains are all that is asked; NULL: it does not get to its end */
static fw_status move_one(again *w, fw_arena *arena, const fw_mechanism *m,
                          fw_effects_hinge_model hinge, fw_verdict_strain_monitor *now,
                          const fw_dynamics_motion **x) {
    fw_dynamics_motion_options o = *w->given;
    fw_diags own = fw_diags_new(arena);
    FW_TRY(fw_verdict_strain_monitor_new(arena, w->m, false, now));
    fw_verdict_strain_monitor_watch(now, &o), o.most_angle_rad = FW_TURN;
    o.trace = NULL, o.whole = false, o.most_steps = 4 * w->like->stats.steps + 1000;
    fw_statics_move_like(w->like, &o);
    o.effects.hinge = hinge, o.glance = fw_verdict_strain_monitor_glance;
    const fw_status status = fw_statics_move_scene(arena, m, w->scene, &o, &own, x);
    if (status == FW_NOMEM || status == FW_CANCELLED) return status;
    if (now->no_memory) return FW_NOMEM;
    if (status != FW_OK || (*x)->ended) *x = NULL;
    return FW_OK;
}

/* Exact beams know one factor on all of a strip's forces, and closed forms one for each of them: where these move a device as
   beams do, what other stiffnesses change is told by closed forms */
static fw_status by_closed_forms(again *w) {
    const double near = 0.03, little = 0.1; /* of a peak; hinges below that share decide nothing */
    const fw_verdict_strain_monitor *beams = w->shown->observed;
    double most = 0;
    if (w->shown->ledger.hinge.used != FW_HINGE_ELASTICA) return FW_OK;
    fw_verdict_strain_monitor *now = fw_arena_one(w->arena, fw_verdict_strain_monitor);
    FW_NEED(now);
    FW_TRY(move_one(w, w->arena, w->m, FW_HINGE_COMPLIANCE, now, &w->like));
    w->whole = w->like && w->like->ledger.hinge.used == FW_HINGE_COMPLIANCE;
    for (int k = 0; k < w->m->nhinge; k++)
        most = fmax(most, beams->hinge[k].strain.value);
    for (int k = 0; k < w->m->nhinge && w->whole; k++) {
        const double is = beams->hinge[k].strain.value;
        w->whole = !now->hinge[k].lost &&
                   !(fabs(now->hinge[k].strain.value - is) > near * fmax(is, little * most));
    }
    return FW_OK;
}

static fw_status move_off(again *w, fw_arena *arena, double (*off)[3], double *more) {
    const fw_verdict_strain_monitor *was = w->like->observed;
    const double hardly = 1e-3;
    double most = 0;
    fw_mechanism other;
    fw_verdict_strain_monitor now;
    const fw_dynamics_motion *x;
    FW_TRY(fw_verdict_with_stiffness(arena, w->m, off, &other));
    FW_TRY(move_one(w, arena, &other, w->like->ledger.hinge.used, &now, &x));
    w->whole = w->whole && x;
    for (int k = 0; k < w->m->nhinge; k++)
        most = fmax(most, was->hinge[k].strain.value);
    for (int k = 0; k < w->m->nhinge && w->whole; k++) {
        const double of = was->hinge[k].strain.value;
        w->whole = !now.hinge[k].lost;
        more[k] = of > hardly * most ? now.hinge[k].strain.value / of - 1 : 0;
    }
    return FW_OK;
}

static fw_status move(again *w, double (*off)[3], double *more) {
    fw_arena *own = fw_arena_part(w->arena, 0); /* its motion is seen and not kept */
    FW_NEED(own);
    const fw_status status = move_off(w, own, off, more);
    fw_arena_free(own);
    return status;
}

/* L of a hinge */
static double all_ways(const again *w, int k) {
    double sum = 0;
    for (int i = 0; i < w->ways; i++)
        sum += fabs(w->more[i * w->m->nhinge + k]);
    return sum;
}

/* device n of those that are off at random; most (2 nhinge): what they come to of each hinge, more and less */
static fw_status move_at_random(again *w, int n, double *most) {
    const uint64_t seed = 249;
    const int nh = w->m->nhinge;
    double *more, (*off)[3] = fw_arena_alloc(w->arena, (size_t)nh, sizeof *off);
    FW_NEED(off);
    FW_NEED(more = fw_arena_array(w->arena, double, (size_t)nh));
    memset(off, 0, (size_t)nh * sizeof *off);
    for (int i = 0; i < w->ways * nh * 3; i++) {
        const int k = i / 3 % nh, axis = i % 3;
        const double is = w->way[i / 3][axis],
                     way = 2 * fw_chance_uniform(seed, (uint64_t)n, (uint64_t)i) - 1;
        off[k][axis] += is * (n % 2 ? way < 0 ? -1 : 1 : way);
    }
    FW_TRY(move(w, off, more));
    for (int k = 0; k < nh && w->whole; k++) {
        most[2 * k] = fmax(most[2 * k], more[k]);
        most[2 * k + 1] = fmax(most[2 * k + 1], -more[k]);
    }
    return FW_OK;
}

/* ---- where that may decide ---- */

/* of a band, without what modes do: the end that they may bring beyond the limit */
typedef struct end {
    double at;
    int way; /* 1: the upper one, which is below it; -1: the lower one, above it; 0: both are on either side */
} end;

/* what bands of hinges have of stiffnesses, up and down (verdict_strain.c) */
static void held_of(const fw_mechanism *m, double held[2]) {
    const double usual = fw_verdict_model_error.motion;
    held[0] = fmin(fw_verdict_motion_lasting_above(m), usual);
    held[1] = fmin(fw_verdict_motion_lasting_below(m), usual);
}

static end end_of(const fw_mechanism *m, const fw_verdict_strain_monitor *saw, int k) {
    const fw_flexure_result *c = &m->hinge[k].closed_form;
    const double limit = c->limit_angle_rad * c->strain_per_rad,
                 used = saw->hinge[k].strain.value / limit;
    double held[2];
    held_of(m, held);
    const double high = used * (1 + held[0] + c->error.above_anywhere),
                 low = used * (1 - held[1] - c->error.strain_anywhere);
    return high < 1 ? (end){high, 1} : low > 1 ? (end){low, -1} : (end){used, 0};
}

/* by factors of modes it is beyond the limit, or so near that what numbers are off by decides */
static bool is_open(end e, const double factor[2]) {
    const double numbers = 0.002;
    return e.way > 0 ? e.at * factor[0] >= 1 - numbers
                     : e.way < 0 && e.at * factor[1] <= 1 + numbers;
}

bool fw_verdict_stiffness_decides(const fw_verdict_variant_verdict *v, int scene,
                                  const double *factor) {
    const fw_mechanism *m = v->mechanism;
    const fw_dynamics_motion *x = v->motion[scene];
    const fw_verdict_strain_monitor *saw = x->observed;
    const double surely = 1.01; /* more than numbers are off by */
    bool any = false, beyond = false, both = false;
    for (int i = 0; i < v->nreason; i++)
        if (v->reason[i].decision != FW_ACCEPT) return false;
    if (!saw || x->ended || m->device->limits.cycles > 0 || (x->loads && x->loads->quasi_static))
        return false;
    for (int k = 0; k < m->nhinge; k++) {
        const end e = end_of(m, saw, k);
        if (e.way < 0 && e.at * factor[2 * k + 1] > surely) return false; /* beyond it anyhow */
        any = any || is_open(e, factor + 2 * k);
        beyond = beyond || e.way < 0, both = both || e.way == 0;
    }
    return any &&
           (beyond || !both); /* what has its limit within its band is open whatever modes do */
}

/* up and down of a hinge by L and R, over what bands have of stiffnesses, with what stays of (7) */
static void factors_of(double linear, const double random[2], const double held[2],
                       const double stays[2], double to[2]) {
    const double others = 1.25, more = others * fmax(linear, random[0]),
                 fewer = others * fmax(linear, random[1]);
    to[0] = stays[0] * (1 + fmax(more - held[0], 0));
    to[1] = stays[1] * fmin(fmax(1 - fewer, 0) / (1 - held[1]), 1);
}

/* what goes in proportion is what counts of each hinge that is open: devices at random come to less than all of it */
static bool in_proportion(const again *w, const double *most, const double *factor) {
    const double less = 0.8;
    for (int k = 0; k < w->m->nhinge; k++)
        if (is_open(end_of(w->m, w->shown->observed, k), factor + 2 * k) &&
            fmax(most[2 * k], most[2 * k + 1]) > less * all_ways(w, k))
            return false;
    return true;
}

/* ---- what stays of modes ---- */

double fw_verdict_mode_lowest(double off, double bodies) {
    return fmax(1 - off - 0.5 * bodies, (1 - off) / sqrt(1 + 2 * bodies));
}

bool fw_verdict_leave_modes(const fw_verdict_shaken *of, double end_s, double bodies,
                            const double *model, fw_verdict_shaken_mode *own,
                            fw_verdict_shaken_mode *under, double *common) {
    const double turned = 2, dies = 3, most = 0.03;
    *common = 0;
    for (int k = 0; k < of->n; k++) {
        const fw_verdict_shaken_mode *is = &of->mode[k];
        const double off = 1 - is->least / is->omega,
                     swings = fmin(is->omega * end_s, dies / fmax(is->damping[0], 1e-9)),
                     gives =
                         fw_verdict_mode_lowest(0, bodies) / fw_verdict_mode_lowest(off, bodies);
        own[k] = *is;
        own[k].low = own[k].soft = fmin(is->soft * gives, is->omega);
        own[k].high = own[k].stiff = own[k].least = is->omega;
        under[k] = off * swings < turned ? own[k] : *is;
        under[k].held = HUGE_VAL; /* how far loads hold what is softer is in these motions */
        if (!isfinite(model[k])) return false; /* nor is its frequency */
        *common = fmax(*common, 2 * model[k]);
    }
    return *common < most;
}

/* ---- is it open, and what is known after it was moved ---- */

/* Is the device still open by what was found so far? One hinge that is beyond its limit decides it, whatever others do */
static bool stays_open(const again *w, const double *most, const double *stays,
                       const double *factor) {
    double held[2], now[2];
    bool open = false;
    held_of(w->m, held);
    for (int k = 0; k < w->m->nhinge; k++) {
        const end e = end_of(w->m, w->shown->observed, k);
        factors_of(all_ways(w, k), most + 2 * k, held, stays + 2 * k, now);
        const bool one = is_open(e, factor + 2 * k) && is_open(e, now);
        if (e.way < 0 && !one) return false;
        open = open || one || e.way == 0;
    }
    return open;
}

fw_status fw_verdict_stiffness_again(fw_arena *arena, const fw_mechanism *m, int scene,
                                     const fw_dynamics_motion_options *options, double common,
                                     const double *stays, const fw_verdict_variant_verdict *v,
                                     double *factor) {
    enum { AT_RANDOM = 24, AT_LEAST = 8 };
    const double most_rhs = 6e6; /* some twenty seconds, with all of them at random */
    const fw_dynamics_motion *x = v->motion[scene];
    const size_t nh = (size_t)m->nhinge;
    again w = {.arena = arena,
               .m = m,
               .shown = x,
               .like = x,
               .given = options,
               .scene = &m->device->scene[scene],
               .whole = true};
    double *most, held[2];
    if (fw_statics_takes_hold(m, w.scene, x, 1)) return FW_OK;
    FW_TRY(by_closed_forms(&w));
    if (!w.whole) return FW_OK;
    FW_TRY(find_ways(&w, common));
    if ((double)w.like->stats.rhs * (w.ways + AT_LEAST) > most_rhs) return FW_OK;
    FW_NEED(most = fw_arena_array(arena, double, 2 * nh));
    for (int i = 0; i < w.ways && w.whole; i++)
        FW_TRY(move(&w, w.way + (size_t)i * nh, w.more + (size_t)i * nh));
    for (int n = 0; n < AT_RANDOM && w.whole; n++) {
        if (stays_open(&w, most, stays, factor)) return FW_OK; /* there is no use in it */
        if (n == AT_LEAST && in_proportion(&w, most, factor)) break;
        FW_TRY(move_at_random(&w, n, most));
    }
    if (!w.whole || stays_open(&w, most, stays, factor)) return FW_OK;
    held_of(m, held);
    for (int k = 0; k < m->nhinge; k++) {
        double now[2];
        if (!is_open(end_of(m, x->observed, k), factor + 2 * k)) continue;
        factors_of(all_ways(&w, k), most + 2 * k, held, stays + 2 * k, now);
        factor[2 * k] = fmin(factor[2 * k], now[0]);
        factor[2 * k + 1] = fmax(factor[2 * k + 1], now[1]);
    }
    return FW_OK;
}

/* ---- what swings too fast for the steps ---- */

/* Steps of explicit methods at the border of their stability, and implicit ones beyond it, damp what swings along a flexure
   faster than they follow, and both runs that are compared lose it alike. The balance of energy has what it was: with E off it,
   a strip of volume V that has all of it is strained by

     eps = c Kt (2 E/(Y V))^(1/2),   c = 1 pulled, 3^(1/2) bent as an arc is

   In: SI, of a run with steps. Out: strain, 0 where omega h < 1: h the mean step, omega = (k/m)^(1/2) of the flexure's stiffest
   way and of the lighter of its bodies. Range: leaves, arcs, paths by their mean width; no more than
   the strain that was seen, which had it before it was lost. Error: an upper bound where all that the
   balance is off by was lost so; a leaf under a torque and a force that begin at once lost 0.26 % of its peak strain, of
   which 0.28 % are said (test_hard_verdict.c, device 17). Source: docs/decisions/0250-what-steps-do-not-follow.md */
double fw_verdict_lost_swing(const fw_mechanism *m, const fw_mechanism_hinge *hinge,
                             const fw_dynamics_motion *x) {
    const fw_mechanism_pin *pin = &m->pin[hinge->pin];
    const fw_flexure_result *c = &hinge->closed_form;
    const fw_flexure_input *in = &hinge->input;
    const bool arc = in->kind != FW_FLEXURE_LEAF;
    const int body[2] = {pin->body_a, pin->body_b};
    double mass = HUGE_VAL, width = in->width_m;
    if (x->stats.steps < 1 || (x->loads && x->loads->quasi_static)) return 0;
    for (int i = 0; i < 2; i++)
        if (body[i] != FW_GROUND) mass = fmin(mass, m->body[body[i]].mass_kg);
    if (in->width_middle_m > 0) width = fmin(width, in->width_middle_m);
    const double stiffest = fmax(c->kx_N_per_m, c->ky_N_per_m),
                 h = x->end_s / (double)x->stats.steps;
    const double energy = x->stats.energy_error * x->stats.largest_energy_J,
                 volume = in->depth_m * width * in->length_m;
    if (!(stiffest * (h * h) > mass) || !(volume > 0)) return 0;
    return (arc ? sqrt(3) : 1) * c->concentration * sqrt(2 * energy / (in->youngs_Pa * volume));
}

/* ---- what follows where modes that lie elsewhere move more or less ---- */

/* what meets may not, where a mode that lies elsewhere moves less */
static void may_not_meet(fw_verdict_variant_verdict *v, int scene, double less) {
    for (int k = 0; k < v->nreason; k++) {
        fw_verdict_reason *r = &v->reason[k];
        if (r->number == 294 && r->decision == FW_REJECT && r->scene && r->keep > less &&
            strcmp(r->scene, v->mechanism->device->scene[scene].name) == 0)
            r->decision = FW_INCONCLUSIVE;
    }
    for (int k = 0; k < v->nclearance; k++) {
        fw_verdict_clearance *c = &v->clearance[k];
        if (c->scene_index == scene && c->decision == FW_REJECT && c->keep > less)
            c->decision = FW_INCONCLUSIVE;
    }
}

fw_status fw_verdict_modes_may_meet(fw_arena *arena, int scene, double less, double by,
                                    fw_verdict_variant_verdict *v) {
    char share[32], up[32];
    const fw_device_scene *s = &v->mechanism->device->scene[scene];
    if (less < 1) may_not_meet(v, scene, less);
    for (int k = 0; k < v->nclearance; k++) {
        const fw_verdict_clearance *c = &v->clearance[k];
        if (c->scene_index != scene || c->decision != FW_ACCEPT || !fw_verdict_may_come(c, by))
            continue;
        const char *text = fw_arena_printf(
            arena,
            "%s and %s may meet in %s%s: they come %s of the way as computed, and a mode that "
            "lies within its error may move %s times as far",
            c->way.a ? c->way.a : "parts", c->way.b ? c->way.b : "others",
            FW_NAMED("scene", s->name), fw_number_text(share, sizeof share, c->way.share, 2),
            fw_number_text(up, sizeof up, by, 2));
        return fw_verdict_scene_reason(v, s, 642, FW_INCONCLUSIVE, 0.95 / (c->way.share * by),
                                       text);
    }
    return FW_OK;
}

/* what rings besides is not known where nobody knows what of it is in which mode */
fw_status fw_verdict_modes_may_ring(fw_arena *arena, int scene, fw_verdict_variant_verdict *v) {
    const fw_device_scene *s = &v->mechanism->device->scene[scene];
    const char *what = v->shaken[scene].unknown;
    if (!what) return FW_OK;
    return fw_verdict_scene_reason(
        v, s, 642, FW_INCONCLUSIVE, FW_VERDICT_KEEP_HALF,
        fw_arena_printf(arena,
                        "in %s%s something comes while modes still ring by what came before, and "
                        "how they ring is not known, since no equilibrium was found at which %s "
                        "holds the device: let it go less far, or all come at once",
                        FW_NAMED("scene", s->name), what));
}

/* and electrodes come nearer to each other: by what moves them farther, but where their own gap is what is nearest by what it
   loses in the motion of the softer device; ways: without that motion */
void fw_verdict_modes_come_near(int scene, double by, double ways, fw_verdict_variant_verdict *v) {
    const double quarter = 1.25, gap = 0.9;
    const fw_verdict_shaken *s = &v->shaken[scene];
    for (int k = 0; k < v->nstator; k++) {
        fw_wiring_moved *to = &v->stator[k];
        const bool own = s->kept > 0 && to->m > gap * s->kept * to->start_m;
        if (to->index == scene)
            to->low_m -=
                own ? (ways - 1) * to->moved_m + quarter * s->nearer_m : (by - 1) * to->moved_m;
    }
}
