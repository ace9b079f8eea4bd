/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What bodies bear: rims of release holes, ways of hinges and loads, once and over the cycles that are asked for; and what of them
   hangs over, of required frequencies, and which mode these count; and how near bodies that bend come to electrodes. Theory: docs/theory/verdict.md, docs/theory/release.md. */
#include "base/constants.h"
#include "base/text.h"
#include "geometry/segment.h"
#include "mechanism/mechanism_plates.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

/* ---- what bodies bear: rims of release holes ----
   The stress of the ways of body_arms.c under what hinges and loads bring, once, over what the static limit leaves; and where scenes
   are repeated and a life is known, what fatigue by its course comes to (body_together.c), over what the fatigue limit leaves. The larger rules.
   Theory: docs/theory/verdict.md, docs/theory/release.md. Test: test_body_arms.c, test_limits.py FatigueOfBodies */

/* what the hinge of an end brings: its largest moment and force, and what equilibrium asks of the cut, times thickness */
typedef struct brought {
    double moment_Nm, force_N, cut_N_per_m;
    const double *along_N; /* as fw_verdict_arm_rims_bear takes it */
    double rest[2];
} brought;

/* shares of what is allowed at the rims beside one end of a hinge. Walls that the flow puts farther in leave less of
   every strip, and of the narrowest one most; walls farther out leave more */
static fw_verdict_band rims_of(const fw_mechanism *m, const fw_verdict_arm *arm, int i,
                               const brought *by) {
    const fw_flexure_limit *limit = fw_flexure_limits_governing(&m->hinge[i / 2].limits);
    if (!arm->known || !limit) return (fw_verdict_band){0, 0};
    const double allowed_N_per_m =
        limit->allowable_Pa / m->device->safety_factor * m->variant->thickness_m;
    const double walls = m->layout ? 2 * m->layout->edge_m : 0;
    const double made = fmax(arm->narrow_m + walls, 1e-3 * arm->narrow_m) / arm->narrow_m;
    const double low = by->cut_N_per_m / (fmax(made, 1) * fmax(made, 1));
    return (fw_verdict_band){
        low / allowed_N_per_m,
        fw_verdict_arm_rims_bear(m, i / 2, arm, by->moment_Nm, by->force_N, by->along_N, by->rest)};
}

static brought in_motion(const fw_mechanism *m, const fw_verdict_bending *b, int i) {
    const double *most = b->hardest_N + 2 * m->nhinge + i / 2 * 2;
    const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
    const int body = i % 2 ? pin->body_b : pin->body_a;
    const bool moves = body != FW_GROUND;
    return (brought){most[1],
                     sqrt(most[0]),
                     b->cut_N_per_m[i],
                     b->along_N + 2 * i,
                     {moves ? b->rest_N[body] : 0, moves ? b->rest_Nm[body] : 0}};
}

/* and the steady load that fatigues as much as its course */
static brought in_course(const fw_mechanism *m, const fw_verdict_bending *b, int i) {
    const double *lasts = b->courses->lasts;
    const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
    const int body = i % 2 ? pin->body_b : pin->body_a;
    const bool moves = body != FW_GROUND;
    return (brought){.moment_Nm = b->arm[i].rim_m2 > 0 ? lasts[i] / b->arm[i].rim_m2 : 0,
                     .rest = {moves ? lasts[fw_verdict_course_of_force(m, body)] : 0,
                              moves ? lasts[fw_verdict_course_of_moment(m, body)] : 0}};
}

/* by_fatigue: is the high end that of the fatigue limit? */
static fw_verdict_band rims_in(const fw_mechanism *m, const fw_dynamics_motion *motion, int at[2],
                               bool *by_fatigue) {
    const fw_verdict_strain_monitor *saw = motion ? motion->observed : NULL;
    fw_verdict_band worst = {0, 0};
    *by_fatigue = false;
    if (!saw || !saw->bending.arm || !saw->bending.cut_N_per_m)
        return (fw_verdict_band){(double)NAN, (double)NAN};
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const brought by = in_motion(m, &saw->bending, i);
        const fw_verdict_band here = rims_of(m, &saw->bending.arm[i], i, &by);
        if (here.low > worst.low) worst.low = here.low, at[0] = i;
        if (here.high > worst.high) worst.high = here.high, at[1] = i, *by_fatigue = false;
        if (!saw->bending.courses) continue;
        const brought again = in_course(m, &saw->bending, i);
        const double lasts =
            fw_verdict_tires(m, i / 2) * rims_of(m, &saw->bending.arm[i], i, &again).high;
        if (lasts > worst.high) worst.high = lasts, at[1] = i, *by_fatigue = true;
    }
    const double off = fw_verdict_motion_model_error(m, motion);
    return (fw_verdict_band){worst.low * fmax(1 - off, 0), worst.high * (1 + off)};
}

fw_verdict_band fw_verdict_bending_rims(const fw_mechanism *m, const fw_dynamics_motion *motion,
                                        int at[2]) {
    bool by_fatigue;
    return rims_in(m, motion, at, &by_fatigue);
}

/* No required pose turns a hinge further, or has a larger joint force, than is proved of all of them; what drift and
   give of the hinges add to strains they are taken to add to forces. Where nothing bounds that (FW-D535) it is left
   out: the poses are undecided. What else holds a body is no more than all its hinges together. */
static brought in_poses(const fw_verdict_variant_verdict *v, int i) {
    const fw_mechanism *m = v->mechanism;
    const fw_workspace_result *w = &v->workspace;
    const int at = m->hinge[i / 2].pin;
    const fw_workspace_load *load = &w->load[at];
    const double more =
        (1 + fmax(load->added, 0)) * (1 + (isfinite(load->give) ? fmax(load->give, 0) : 0));
    return (brought){.moment_Nm = m->pin[at].stiffness_Nm_per_rad *
                                      (fabs(w->peak[at].angle_rad) + w->peak[at].error_rad) +
                                  (load->known ? more * load->rub_Nm : 0),
                     .force_N = load->known ? more * load->most_N : 0};
}

/* what the hinges of a body put on it together at most */
static void add_rest(const fw_verdict_variant_verdict *v, int body, double rest[2]) {
    const fw_mechanism *m = v->mechanism;
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        if (m->hinge[i / 2].pin >= FW_SIX || (i % 2 ? pin->body_b : pin->body_a) != body) continue;
        const brought by = in_poses(v, i);
        const fw_geometry_vec2 middle = {m->drawn[body].x_m, m->drawn[body].y_m};
        rest[0] += by.force_N;
        rest[1] +=
            by.moment_Nm + by.force_N * vec_distance(fw_mechanism_pin_place(m, pin, i % 2), middle);
    }
}

/* *by_fatigue: every repetition is taken to go to the worst pose and as far to the other side, and that uses more than it does once */
static double required_at_most(const fw_verdict_variant_verdict *v, int *at, bool *by_fatigue) {
    const fw_mechanism *m = v->mechanism;
    const fw_workspace_result *w = &v->workspace;
    double worst = 0;
    *by_fatigue = false;
    if (!v->arm || !w->required || !w->reachable) return (double)NAN;
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        const int body = i % 2 ? pin->body_b : pin->body_a;
        if (m->hinge[i / 2].pin >= FW_SIX || body == FW_GROUND) continue;
        brought by = in_poses(v, i);
        if (m->device->release_pitch_m > 0) add_rest(v, body, by.rest);
        const double high =
            m->device->release_pitch_m > 0
                ? rims_of(m, &v->arm[i], i, &by).high
                : fw_verdict_arm_bears(m, i / 2, &v->arm[i], by.moment_Nm, by.force_N, NULL);
        const double again = fw_verdict_tires(m, i / 2);
        if (high * fmax(again, 1) > worst)
            worst = high * fmax(again, 1), *at = i, *by_fatigue = again > 1;
    }
    return worst * (1 + fw_verdict_motion_lasting_error(m));
}

double fw_verdict_bending_rims_required(const fw_verdict_variant_verdict *v, int *at) {
    bool by_fatigue;
    return v->mechanism->device->release_pitch_m > 0 ? required_at_most(v, at, &by_fatigue)
                                                     : (double)NAN;
}

const char *fw_verdict_allowed_words(fw_arena *arena, const fw_mechanism *m, bool by_fatigue) {
    char times[32];
    return by_fatigue
               ? fw_arena_printf(arena, "what is allowed by the fatigue limit at %s repetitions",
                                 fw_number_text(times, sizeof times, m->device->limits.cycles, 3))
               : "what is allowed";
}

/* least, most: over what is allowed, of the rims beside end i; of required poses its low end is not known */
static fw_status give_rims(fw_arena *arena, const fw_verdict_arm *arm, int i, double least,
                           double most, bool by_fatigue, const char *scene,
                           fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
    const bool breaks = least > 1, posed = scene == NULL;
    char low[32], high[32], x[32], y[32];
    const char *use = posed ? "at most"
                            : fw_arena_printf(arena, "%s to",
                                              fw_number_text(low, sizeof low, 100 * least, 2)),
               *where = posed ? "required poses"
                              : fw_arena_printf(arena, "%s%s", FW_NAMED("scene", scene)),
               *allowed = fw_verdict_allowed_words(arena, m, by_fatigue);
    FW_NEED(use && where && allowed ? use : NULL);
    const char *text = fw_arena_printf(
        arena,
        "in %s the rims of release holes of %s%s %s what %s%s brings: they use %s "
        "%s %% of %s, near (%s, %s) um; a larger pitch (<die release-pitch>), "
        "smaller holes (release-hole), a wider body there or %s lowers it",
        where, FW_NAMED("body", m->device->body[i % 2 ? pin->body_b : pin->body_a].id),
        breaks ? "do not bear" : "are not known to bear", FW_NAMED("hinge", pin->id), use,
        fw_number_text(high, sizeof high, 100 * most, 4), allowed,
        fw_number_text(x, sizeof x, 1e6 * arm->rim.x, 4),
        fw_number_text(y, sizeof y, 1e6 * arm->rim.y, 4),
        posed ? "a smaller required box" : "less load");
    FW_NEED(text);
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = posed ? "workspace" : scene,
                                                  .flow = m->variant->flow,
                                                  .number = FW_VERDICT_RIMS,
                                                  .decision = breaks ? FW_REJECT : FW_INCONCLUSIVE,
                                                  .keep = fmin(fmax(0.98 / most, 1e-3), 0.99),
                                                  .not_by_loads = posed,
                                                  .not_by_width = true,
                                                  .text = text};
    return FW_OK;
}

/* ---- and of bodies, with holes and without ---- */

typedef struct weak { /* what a body is not known to bear */
    double share;     /* over what is allowed, at most */
    const fw_verdict_arm *arm;
    int body;
    const char *what, *id;
    bool by_fatigue; /* of its fatigue limit */
} weak;

static void take_weak(weak *worst, weak one) {
    if (one.share > worst->share) *worst = one;
}

/* as fw_verdict_load_N, of what lasts */
static double load_lasts(const fw_mechanism *m, const fw_mechanism_load_end *end, int at,
                         const fw_verdict_bending *b) {
    const double *lasts = b->courses->lasts,
                 hinges = lasts[fw_verdict_course_of_force(m, end[at].body)];
    const bool known = isfinite(end[at].known_N);
    double own = 0;
    for (int k = 0; k < b->nplace; k++) {
        const fw_verdict_place *of = &b->place[k];
        if (!isfinite(of->known_N) || of->body != end[at].body) continue;
        const double one = lasts[fw_verdict_course_of_place(m, k)];
        if (!known)
            own += one;
        else if (of->arm == &b->arm[2 * m->nhinge + at])
            own = one;
    }
    return known ? fmax(own, hinges) : own + hinges;
}

/* of load k beside hinge i: once, or as it lasts */
static double load_share(const fw_mechanism *m, int i, int k, const fw_mechanism_load_end *end,
                         const fw_verdict_bending *b, double load_N, bool lasts) {
    const fw_verdict_arm *arm = &b->arm[2 * m->nhinge + k];
    const int body = end[k].body;
    const double *of = lasts ? b->courses->lasts : NULL;
    const double rest[2] = {of ? of[fw_verdict_course_of_force(m, body)] : b->rest_N[body],
                            of ? of[fw_verdict_course_of_moment(m, body)]
                               : (b->rest_Nm ? b->rest_Nm[body] : 0)};
    return b->rest_Nm ? fw_verdict_arm_rims_bear(m, i / 2, arm, 0, load_N, NULL, rest)
                      : fw_verdict_arm_bears(m, i / 2, arm, 0, load_N, NULL);
}

static fw_status weakest_of(fw_arena *arena, const fw_mechanism *m, int scene,
                            const fw_verdict_bending *b, weak *worst) {
    fw_mechanism_load_end *end;
    int n;
    for (int i = 0; !b->cut_N_per_m && i < 2 * m->nhinge; i++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        const double *most = b->hardest_N + 2 * m->nhinge + i / 2 * 2;
        const fw_verdict_arm *arm = &b->arm[i];
        weak one = {
            .arm = arm, .body = i % 2 ? pin->body_b : pin->body_a, .what = "hinge", .id = pin->id};
        one.share = fw_verdict_arm_bears(m, i / 2, arm, most[1], sqrt(most[0]),
                                         b->along_N ? b->along_N + 2 * i : NULL);
        take_weak(worst, one);
        if (!b->courses || !(arm->edge_m2 > 0)) continue;
        one.by_fatigue = true;
        one.share =
            fw_verdict_tires(m, i / 2) *
            fw_verdict_arm_bears(m, i / 2, arm, b->courses->lasts[i] / arm->edge_m2, 0, NULL);
        take_weak(worst, one);
    }
    FW_TRY(fw_mechanism_load_ends(arena, m, &end, &n));
    for (int k = 0; k < n; k++)
        for (int i = 0; end[k].scene == scene && i < 2 * m->nhinge; i++) {
            const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
            const fw_verdict_arm *arm = &b->arm[2 * m->nhinge + k];
            weak one = {HUGE_VAL, arm, end[k].body, end[k].what, end[k].id, false};
            if ((i % 2 ? pin->body_b : pin->body_a) != end[k].body) continue;
            if (arm->lost) take_weak(worst, one);
            one.share = load_share(m, i, k, end, b, fw_verdict_load_N(end, n, k, b->rest_N), false);
            take_weak(worst, one);
            if (!b->courses) continue;
            one.by_fatigue = true;
            one.share = fw_verdict_tires(m, i / 2) *
                        load_share(m, i, k, end, b, load_lasts(m, end, k, b), true);
            take_weak(worst, one);
        }
    return FW_OK;
}

/* a body that is narrower than its hinges or loads ask for breaks before they do; scene NULL: in required poses */
static fw_status say_weak(fw_arena *arena, const char *scene, const weak *w,
                          fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    char high[32], wide[32], x[32], y[32];
    const char *allowed = fw_verdict_allowed_words(arena, m, w->by_fatigue);
    const char *wider = fw_layout_wider_there(arena, m->device, m->layout, w->body, w->arm->edge);
    FW_NEED(allowed && wider);
    const char *text =
        w->arm->lost
            ? fw_arena_printf(
                  arena,
                  "in %s%s %s%s is not known to bear what %s%s%s brings: where that acts it is "
                  "narrower "
                  "than an 800th of its size, or hangs by so little; make it wider there",
                  scene ? fw_text_kind("scene ", scene) : "required poses", scene ? scene : "",
                  FW_NAMED("body", m->device->body[w->body].id), w->what, w->id ? " " : "",
                  w->id ? w->id : "")
            : fw_arena_printf(
                  arena,
                  "in %s%s %s%s is not known to bear what %s%s%s brings: at most %s %% of %s, "
                  "where "
                  "it is %s um wide, near (%s, %s) um, corners counted three times; %s, or make %s",
                  scene ? fw_text_kind("scene ", scene) : "required poses", scene ? scene : "",
                  FW_NAMED("body", m->device->body[w->body].id), w->what, w->id ? " " : "",
                  w->id ? w->id : "", fw_number_text(high, sizeof high, 100 * w->share, 3), allowed,
                  fw_number_text(wide, sizeof wide, 1e6 * w->arm->edge_wide_m, 3),
                  fw_number_text(x, sizeof x, 1e6 * w->arm->edge.x, 4),
                  fw_number_text(y, sizeof y, 1e6 * w->arm->edge.y, 4), wider,
                  scene ? "the load smaller" : "the required box smaller");
    FW_NEED(text);
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = scene ? scene : "workspace",
                                                  .flow = m->variant->flow,
                                                  .number = FW_VERDICT_BODIES,
                                                  .decision = FW_INCONCLUSIVE,
                                                  .keep = fmin(fmax(0.98 / w->share, 1e-3), 0.99),
                                                  .not_by_loads = scene == NULL,
                                                  .not_by_width = true,
                                                  .text = text};
    return FW_OK;
}

static fw_status judge_bodies(fw_arena *arena, int scene, const fw_dynamics_motion *motion,
                              fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    const fw_verdict_strain_monitor *saw = motion ? motion->observed : NULL;
    weak worst = {.share = 0};
    if (!saw || !saw->bending.arm || !saw->bending.rest_N) return FW_OK;
    FW_TRY(weakest_of(arena, m, scene, &saw->bending, &worst));
    worst.share *= 1 + fw_verdict_motion_model_error(m, motion);
    return worst.share > 1 ? say_weak(arena, m->device->scene[scene].name, &worst, v) : FW_OK;
}

fw_status fw_verdict_bending_judge(fw_arena *arena, int scene, const fw_dynamics_motion *motion,
                                   fw_verdict_variant_verdict *v) {
    int at[2] = {0, 0};
    bool by_fatigue;
    const fw_verdict_band band = rims_in(v->mechanism, motion, at, &by_fatigue);
    FW_TRY(judge_bodies(arena, scene, motion, v));
    if (!(band.high > 1)) return FW_OK;
    const fw_verdict_strain_monitor *saw = motion->observed;
    const int i = at[band.low > 1 ? 0 : 1];
    return give_rims(arena, &saw->bending.arm[i], i, band.low, band.high, by_fatigue,
                     v->mechanism->device->scene[scene].name, v);
}

fw_status fw_verdict_bending_judge_required(fw_arena *arena, fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    int at = 0;
    bool by_fatigue;
    const double high = required_at_most(v, &at, &by_fatigue);
    if (!(high > 1)) return FW_OK;
    if (m->device->release_pitch_m > 0)
        return give_rims(arena, &v->arm[at], at, 0, high, by_fatigue, NULL, v);
    const fw_mechanism_pin *pin = &m->pin[m->hinge[at / 2].pin];
    const weak worst = {high,    &v->arm[at], at % 2 ? pin->body_b : pin->body_a,
                        "hinge", pin->id,     by_fatigue};
    return say_weak(arena, NULL, &worst, v);
}

/* ---- what hangs over swings slower (body_hung.c): 1/omega^2 of the rigid bodies and of what hangs over add up at most (Weyl) ---- */

static int slowest_hung(const fw_verdict_variant_verdict *v, double *s2) {
    const fw_verdict_hung *hung = v->out_of_plane ? v->out_of_plane->hung : NULL;
    int body = FW_NONE;
    *s2 = 0;
    for (int i = 0; hung && i < v->mechanism->nbody; i++)
        if (hung[i].in_plane_mode_s2 > *s2) *s2 = hung[i].in_plane_mode_s2, body = i;
    return body;
}

bool fw_verdict_hangs_alone(const fw_verdict_variant_verdict *v, const fw_verdict_requirement *r) {
    const fw_verdict_out_of_plane *o = v->out_of_plane;
    double s2;
    if (strcmp(r->kind, "frequency") != 0 || r->decision != FW_INCONCLUSIVE || r->why) return false;
    if (!(r->low < r->min) || r->high > r->max || slowest_hung(v, &s2) == FW_NONE) return false;
    for (int k = 0; k < o->nmode; k++)
        if (o->mode[k].f_Hz == r->value) return false; /* across the plane */
    const double left = 1 - s2 * pow(FW_TURN * r->low, 2);
    return !(left > 0) || r->low / sqrt(left) >= r->min;
}

fw_status fw_verdict_hangs_open(fw_verdict_variant_verdict *v, const char *scene, int number,
                                const char *what) {
    FW_NEED(what);
    v->reason[v->nreason++] = (fw_verdict_reason){.scene = scene,
                                                  .flow = v->mechanism->variant->flow,
                                                  .number = number,
                                                  .decision = FW_INCONCLUSIVE,
                                                  .keep = FW_VERDICT_KEEP_HALF,
                                                  .not_by_width = true,
                                                  .text = what};
    return FW_OK;
}

fw_status fw_verdict_hangs_say(fw_arena *arena, fw_verdict_variant_verdict *v,
                               const fw_verdict_requirement *r, const char *text) {
    double s2;
    const int body = slowest_hung(v, &s2);
    char own[32];
    FW_NEED(text = fw_arena_printf(
                arena,
                "%s: %s%s, which is rigid in the value, may swing in the plane from %s Hz on where "
                "it reaches beyond its hinges: make it wider or shorter",
                text, FW_NAMED("body", fw_text_name(v->mechanism->body[body].id)),
                fw_number_text(own, sizeof own, 1 / (FW_TURN * sqrt(s2)), 4)));
    return fw_verdict_hangs_open(v, r->scene ? r->scene : fw_verdict_at_rest, 640, text);
}

/* ---- how near electrodes come ----
   By the place of every rotor in each row: across the fingers and by its tilt, of a plate along; of fingers that are nearly
   at the roots of the others along, too. Error: between rows. Test: test_near_pull_in.py, Motions */

typedef struct near_to { /* m: least gap, and farthest along */
    double gap, along;
} near_to;

static near_to nearest(const fw_dynamics_motion *x, int element) {
    const fw_effects_force_element *e = &x->loads->element[element];
    const fw_effects_comb_element *c = fw_effects_comb_of(e);
    near_to n = {HUGE_VAL, -HUGE_VAL};
    fw_dynamics_motion_rows(x, 0, x->nsample);
    for (int row = 0; row < x->nsample; row++) {
        double p[6], w[6], at[3];
        fw_effects_element_place_ports(e, x->q + (size_t)row * 3 * (size_t)x->nbody, NULL, p, w);
        fw_effects_comb_place(e, p, at);
        const bool comb = c->kind == FW_ELECTRODES_COMB;
        const double half = 0.5 * (comb ? c->overlap_m + at[0] : c->length_m);
        n.gap = fmin(n.gap, c->gap_m - fabs(c->lean_m) - (comb ? fabs(at[1]) : at[0]) -
                                fabs(at[2]) * half);
        n.along = fmax(n.along, at[0]);
    }
    return n;
}

double fw_verdict_electrodes_nearer(const fw_dynamics_motion *was, const fw_dynamics_motion *now,
                                    double *kept) {
    double nearer = 0;
    *kept = 1;
    for (int i = 0; i < was->loads->nelement && i < now->loads->nelement; i++) {
        const fw_effects_comb_element *c = fw_effects_comb_of(&was->loads->element[i]);
        if (!c || !fw_effects_comb_of(&now->loads->element[i])) continue;
        const near_to a = nearest(was, i), b = nearest(now, i);
        const double length = isnan(c->length_m) ? 2 * c->overlap_m : c->length_m;
        *kept = fmin(*kept, a.gap / c->gap_m);
        nearer = fmax(nearer, a.gap - b.gap);
        if (c->kind == FW_ELECTRODES_COMB && length - c->overlap_m - b.along < 2 * b.gap)
            nearer = fmax(nearer, b.along - a.along);
    }
    return nearer;
}

double fw_verdict_pull_missing(const fw_verdict_variant_verdict *v, int scene) {
    const fw_dynamics_motion *x = v->motion ? v->motion[scene] : NULL;
    double most = 0;
    for (int i = 0; x && x->loads && i < x->loads->nelement; i++) {
        const fw_effects_comb_element *c = fw_effects_comb_of(&x->loads->element[i]);
        if (c) most = fmax(most, fw_effects_comb_fringe(c, NULL));
    }
    if (!x && v->pull_in && v->pull_in[scene]) most = v->pull_in[scene]->fringe;
    return most;
}

/* ---- and in series with electrodes ----
   Pull-in comes where the field takes the stiffness k that holds its rotor; where a place of the rotor's body gives c that is
   k/(1 + c k), and k is what the field takes there: the largest eigenvalue of -df/dp at the pull-in voltage and pose. Test:
   test_effects.py SlenderArms */

static double field_takes(const fw_effects_force_element *e, const fw_statics_pull_in *p,
                          double duration_s) {
    enum { TIMES = 64, ROTOR = 1 };
    double at[6], w[6], stiff[36], damp[36], most = 0;
    if (!e->class_->electrodes || e->ports != 2 || e->switches > 0) return 0;
    fw_effects_element_place_ports(e, p->q, NULL, at, w);
    for (int i = 0; i <= TIMES; i++) { /* wherever its law is largest */
        const double t_s = duration_s * i / TIMES;
        const fw_effects_port_state seen = {.t_s = t_s,
                                            .piece_s = t_s,
                                            .load = p->margin * p->margin,
                                            .p = at,
                                            .w = w,
                                            .still = true};
        e->class_->tangent(e, &seen, stiff, damp);
        const double *row = stiff + 3 * ROTOR * 6 + 3 * ROTOR;
        const double a = -row[0], b = -0.5 * (row[1] + row[6]), c = -row[7];
        most = fmax(most, 0.5 * (a + c) + hypot(0.5 * (a - c), b));
    }
    return most;
}

fw_status fw_verdict_places_pulled(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                                   const fw_statics_pull_in *p, double *gives) {
    const fw_mechanism *m = v->mechanism;
    const fw_dynamics_motion *motion = v->motion[scene];
    fw_mechanism_load_end *end;
    int n;
    *gives = 0;
    if (!v->arm || v->straight || !p->q || !motion || !motion->loads) return FW_OK;
    FW_TRY(fw_mechanism_load_ends(arena, m, &end, &n));
    for (int k = 0; k < n; k++) {
        const fw_verdict_arm *arm = &v->arm[2 * m->nhinge + k];
        if (end[k].scene != scene || !end[k].id || !arm->known) continue;
        const double goes = fw_verdict_arm_goes(arm);
        for (int i = 0; i < motion->loads->nelement; i++)
            if (motion->loads->element[i].id &&
                strcmp(motion->loads->element[i].id, end[k].id) == 0)
                *gives +=
                    goes / (m->variant->material.youngs.value * m->variant->thickness_m) *
                    field_takes(&motion->loads->element[i], p, m->device->scene[scene].duration_s);
    }
    return FW_OK;
}

/* ---- which mode a probe is of, in the plane and across it ---- */

const fw_verdict_plate_mode *fw_verdict_frequency(const fw_verdict_variant_verdict *v,
                                                  const fw_device_probe *probe,
                                                  const fw_statics_modes *modes, int *in_plane) {
    const fw_verdict_out_of_plane *o = v->out_of_plane;
    fw_mechanism_frequencies in = {NULL, 0, sizeof(fw_statics_mode)},
                             out = {NULL, 0, sizeof(fw_verdict_plate_mode)};
    bool across;
    if (modes && modes->count > 0) in.f_Hz = &modes->mode[0].f_Hz, in.count = modes->count;
    if (o && o->nmode > 0) out.f_Hz = &o->mode[0].f_Hz, out.count = o->nmode;
    int at = fw_mechanism_plates_nth(probe->mode, probe->plane, in, out, &across);
    *in_plane = at + 1;
    return at >= 0 && across ? &o->mode[at] : NULL;
}

/* ---- what flexures are off by of how far a motion goes ----
   By the energies that they have of it, e = sum of k d^2 e_k over sum of k d^2, of turns and of what goes across an axis: a leaf that
   goes aside is known less well than one that turns. What lies along a strip is as stiff as it is. In: samples of the
   motion, m and rad. Out: relative. Source: Rayleigh, as fw_statics_shape_error. Cost: two sines a hinge and sample. Test:
   test_effects.py, NearFirstTouch */
double fw_verdict_flexures_off(const fw_mechanism *m, const fw_dynamics_motion *x) {
    double all = 0, off = 0;
    fw_dynamics_motion_rows(x, 0, x->nsample);
    for (int i = 0; i < x->nsample * m->nhinge; i++) {
        const double *q = x->q + (size_t)(i / m->nhinge) * 3 * (size_t)x->nbody;
        const fw_mechanism_hinge *h = &m->hinge[i % m->nhinge];
        const fw_mechanism_pin *pin = &m->pin[h->pin];
        const fw_flexure_error *e = &h->closed_form.error;
        const double a = pin->body_a == FW_GROUND ? 0 : q[3 * pin->body_a + 2],
                     b = pin->body_b == FW_GROUND ? 0 : q[3 * pin->body_b + 2],
                     turn = b - a - pin->free_angle_rad,
                     axis = h->axis_rad + fw_mechanism_pin_half_turned(m, pin, q),
                     turns = pin->stiffness_Nm_per_rad * turn * turn;
        const fw_geometry_vec2 d = fw_mechanism_pin_opened(pin, q);
        fw_flexure_hinge_at at;
        fw_flexure_hinge_law_at(&h->law, 0, &at);
        const bool y = at.ky_N_per_m.value < at.kx_N_per_m.value;
        const double aside =
                         y ? cos(axis) * d.y - sin(axis) * d.x : cos(axis) * d.x + sin(axis) * d.y,
                     across = (y ? at.ky_N_per_m : at.kx_N_per_m).value * aside * aside,
                     goes = isfinite(across) ? across : 0; /* of a pin without an axis */
        all += turns + goes;
        off += (h->stated ? 0 : e->stiffness) * turns + (y ? e->ky : e->kx) * goes;
    }
    return off > 0 ? off / all : 0;
}

void fw_verdict_softer(const fw_mechanism *m, const fw_verdict_arm *arm,
                       const fw_verdict_bending *b, int body, double to[2]) {
    to[0] = 1;
    for (int i = 0; i < 2 * m->nhinge; i++) {
        const fw_mechanism_pin *pin = &m->pin[m->hinge[i / 2].pin];
        if ((i % 2 ? pin->body_b : pin->body_a) == body) to[0] = fmax(to[0], arm[i].softer);
    }
    to[1] = to[0];
    for (int i = 0; i < b->nplace; i++)
        if (b->place[i].body == body && b->place[i].arm)
            to[1] = fmax(to[1], b->place[i].arm->softer);
}
