/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the envelope takes in: effects that act on the motion, drawn tendons among them. */
#include "effects/effect.h"
#include "effects/envelope.h"
#include "effects/modal.h"
#include "maths/matrix.h"
#include "quantity/law_kind.h"
#include <math.h>
#include <string.h>

/* ---- drawn tendons ---- */

/* Drawn tendons in the envelope: which stay taut for sure, and how much the others can pull.

   Stretch g = draw law - slack + dL,  |dL| <= sum_l |a_l| A_l (margin) + bend,  a_l = grad L . s_l,
   A_l: amplitude of mode l; bend: what turns and the breadth of moves add, of second order. A
   tendon whose k g - c |g'| stays above 0 so is taut as long as the linear motion with it holds,
   which is the whole scene: it is a spring on both sides.

   One that may go slack pulls between 0 and T, with all of them and y_l the mode's response bound

     T_i = k_i g_i+ + c_i g_i'+ + sum_j sum_l |a_il| (k_i + c_i w_l) y_l |a_jl| T_j

   where that system has T >= 0 (its matrix contracts), else there is no bound; without them, what
   they change is the answer to T of any course. Any other change of the motion comes back through
   them, by the largest row sum of the matrix at most; that is added. Inputs SI; output relative to
   the floor. Proved within linear theory, whose margin is tested. Cost: modes times eyelets.
   Source: docs/theory/effects/tendon.md. Test: test_tendon_slack.c, test_hard_bounds.c. */

typedef struct stretch { /* of one tendon, over the scene */
    double least_m, most_m, speed_m_per_s;
} stretch;

/* what its law is between, over (0, end) and in what it is before */
static void range_of(const fw_quantity_law *law, double end_s, double *least, double *most) {
    *least = *most = 1;
    if (fw_quantity_law_is_constant(law)) return;
    *most = fw_quantity_law_largest(law, end_s);
    *least = -*most;
    if (fw_quantity_law_never_negative(law)) *least = 0;
}

/* of the eyelet i in mode l, along the two directions */
static fw_geometry_vec2 moves(const fw_effect_case *c, const fw_effects_envelope *e,
                              const fw_device_eyelet *p, int l) {
    if (p->body == FW_GROUND) return (fw_geometry_vec2){0, 0};
    const fw_mechanism_mass *b = &c->mechanism->body[p->body];
    const double *s = e->shape + (size_t)l * (size_t)e->n + 3 * (size_t)p->body;
    fw_geometry_vec2 at = fw_mechanism_local_place(c->mechanism, p->body, p->x_m, p->y_m);
    return (fw_geometry_vec2){s[0] - s[2] * (at.y - b->y_m), s[1] + s[2] * (at.x - b->x_m)};
}

/* grad L . shape of mode l */
static double along(const fw_effect_case *c, const fw_effects_envelope *e,
                    const fw_device_tendon *t, int l) {
    double sum = 0;
    for (int i = 0; i + 1 < t->neyelet; i++) {
        const fw_device_eyelet *p = &t->eyelet[i];
        fw_geometry_vec2 a = fw_mechanism_local_place(c->mechanism, p->body, p->x_m, p->y_m);
        fw_geometry_vec2 b = fw_mechanism_local_place(c->mechanism, p[1].body, p[1].x_m, p[1].y_m);
        fw_geometry_vec2 u = moves(c, e, p, l), v = moves(c, e, p + 1, l);
        double length = hypot(b.x - a.x, b.y - a.y);
        sum += ((b.x - a.x) * (v.x - u.x) + (b.y - a.y) * (v.y - u.y)) / length;
    }
    return sum;
}

/* as far, or as fast, as an eyelet goes */
static double reach(const fw_device_eyelet *p, const double *of) {
    if (p->body == FW_GROUND) return 0;
    const double *r = of + 3 * p->body;
    return hypot(r[0], r[1]) + r[2] * hypot(p->x_m, p->y_m);
}

static stretch stretch_of(const fw_effect_case *c, const fw_effects_envelope *e,
                          const fw_device_tendon *t) {
    double least, most, way = 0, rate = 0, nonlinearity = 0.25 * (e->margin - 1);
    fw_quantity_law_size size = fw_quantity_law_measure(t->law, e->duration_s);
    range_of(t->law, e->duration_s, &least, &most);
    if (fw_quantity_law_is_constant(t->law)) size.slope = 0;
    for (int l = 0; l < e->modes; l++) {
        double a = fabs(along(c, e, t, l)) * e->margin;
        way += a * e->amplitude[l], rate += a * e->modal_speed[l];
    }
    for (int i = 0; i + 1 < t->neyelet; i++) {
        const fw_device_eyelet *p = &t->eyelet[i];
        fw_geometry_vec2 a = fw_mechanism_local_place(c->mechanism, p->body, p->x_m, p->y_m);
        fw_geometry_vec2 b = fw_mechanism_local_place(c->mechanism, p[1].body, p[1].x_m, p[1].y_m);
        double go = reach(p, e->reach) + reach(p + 1, e->reach);
        double fast = reach(p, e->speed) + reach(p + 1, e->speed);
        double turn = nonlinearity + go / hypot(b.x - a.x, b.y - a.y);
        way += turn * go, rate += turn * fast;
    }
    double one = t->draw_m * least, other = t->draw_m * most;
    return (stretch){.least_m = fmin(one, other) - t->slack_m - way,
                     .most_m = fmax(one, other) - t->slack_m + way,
                     .speed_m_per_s = fabs(t->draw_m) * size.slope + rate};
}

static bool taut(const fw_device_tendon *t, const stretch *s) {
    return t->stiffness_N_per_m * s->least_m > t->damping_Ns_per_m * s->speed_m_per_s;
}

/* marks in loose (ntendon) the drawn tendons that the envelope, which has all unmarked ones as
   springs, does not keep taut; of an envelope that is not valid all. False: there are no more */
static bool tendons_loosen(const fw_effect_case *c, const fw_effects_envelope *e, bool *loose) {
    bool more = false;
    for (int i = 0; i < c->scene->ntendon; i++) {
        const fw_device_tendon *t = &c->scene->tendon[i];
        if (loose[i] || !isnan(t->pull_N)) continue;
        stretch s = e->valid ? stretch_of(c, e, t) : (stretch){0};
        loose[i] = !(e->valid && taut(t, &s));
        more = more || loose[i];
    }
    return more;
}

double fw_effects_envelope_tension(const fw_effect_case *c, const fw_device_tendon *t) {
    const fw_effects_envelope *e = c->envelope;
    if (!e || !e->valid || e->loose_pull > 0) return (double)INFINITY;
    if (!isnan(t->pull_N))
        return fabs(t->pull_N) * fw_quantity_law_largest(t->law, c->scene->duration_s);
    const stretch s = stretch_of(c, e, t);
    return t->stiffness_N_per_m * fmax(0, s.most_m) + t->damping_Ns_per_m * s.speed_m_per_s;
}

fw_geometry_vec2 fw_effects_envelope_moves(const fw_effect_case *c, const fw_device_eyelet *eyelet,
                                           int mode) {
    return moves(c, c->envelope, eyelet, mode);
}

double fw_effects_envelope_goes(const fw_effect_case *c, const fw_device_eyelet *eyelet) {
    return reach(eyelet, c->envelope->reach);
}

/* row i of the system, and its right side */
static void pull_of(const fw_effect_case *c, const fw_effects_envelope *e, const bool *loose, int i,
                    const double *a, double *row, double *right) {
    const fw_device_tendon *t = &c->scene->tendon[i];
    stretch s = stretch_of(c, e, t);
    int count = c->scene->ntendon;
    *right = loose[i]
                 ? t->stiffness_N_per_m * fmax(0, s.most_m) + t->damping_Ns_per_m * s.speed_m_per_s
                 : 0;
    for (int j = 0; j < count; j++) {
        double gain = 0;
        for (int l = 0; l < e->modes; l++)
            gain += fabs(a[i * e->modes + l] * a[j * e->modes + l]) * e->response_bound[l] *
                    e->margin * (t->stiffness_N_per_m + t->damping_Ns_per_m * e->omega[l]);
        row[j] = (i == j) - (loose[i] && loose[j] ? gain : 0);
    }
}

/* what those of `loose` change at most, which the valid envelope does not have */
static fw_status tendons_pull(const fw_effect_case *c, const fw_effects_envelope *e,
                              const bool *loose, double *bound) {
    size_t count = (size_t)c->scene->ntendon, modes = (size_t)e->modes;
    double *a, *system, *pull, *mode;
    int *pivot;
    bool known = true;
    double back = 0;
    *bound = (double)INFINITY;
    fw_mark mark = fw_arena_mark(c->arena);
    FW_NEED(a = fw_arena_array(c->arena, double, count *modes));
    FW_NEED(system = fw_arena_array(c->arena, double, count *count));
    FW_NEED(pull = fw_arena_array(c->arena, double, count));
    FW_NEED(mode = fw_arena_array(c->arena, double, modes));
    FW_NEED(pivot = fw_arena_array(c->arena, int, count));
    for (size_t i = 0; i < count; i++)
        for (size_t l = 0; l < modes; l++)
            a[i * modes + l] = along(c, e, &c->scene->tendon[i], (int)l);
    for (size_t i = 0; i < count; i++) {
        pull_of(c, e, loose, (int)i, a, system + i * count, &pull[i]);
        known = known && isfinite(pull[i]) && isfinite(system[i * count + i]);
        double row = 0;
        for (size_t j = 0; j < count; j++)
            row += fabs((i == j) - system[i * count + j]);
        if (pull[i] > 0) back = fmax(back, row);
    }
    known = known && fw_maths_lu_factor((int)count, system, pivot);
    if (known) fw_maths_lu_solve((int)count, system, pivot, NULL, pull);
    for (size_t i = 0; i < count; i++) {
        known = known && pull[i] >= 0;
        for (size_t l = 0; l < modes && loose[i]; l++)
            mode[l] += fabs(a[i * modes + l]) * pull[i];
    }
    fw_effect_case of_envelope = *c;
    of_envelope.envelope = e;
    if (known)
        *bound = fw_effects_envelope_mode_answer(&of_envelope, mode, (double)INFINITY) + back;
    fw_arena_rewind(c->arena, mark);
    return FW_OK;
}

/* ---- effects that it takes in ---- */

/* Which effects the envelope takes in: those that add forces, springs, dampers, elements that
   act on both sides, and free strains. */

typedef struct search {
    const fw_effect_case *c;
    const fw_effect_row *const *row; /* (rows) */
    size_t rows;
    bool *taken; /* (rows) */
    bool *loose; /* (ntendon) drawn tendons that may go slack: not in the envelope */
} search;

static bool linear(const fw_effects_loads *t) {
    for (int i = 0; i < t->nelement; i++)
        if (t->element[i].switches > 0) return false;
    return t->nstop == 0 && t->nfriction == 0 && !t->quasi_static;
}

/* does its `add` stay within what linear theory takes in? */
static fw_status can_take(const fw_effect_case *c, const fw_effect_row *row, bool *taken) {
    fw_effects_loads scratch;
    fw_mark mark = fw_arena_mark(c->arena);
    FW_TRY(fw_effects_loads_new(c->arena, c->mechanism, c->scene, &scratch));
    fw_status status = row->add(c, &scratch); /* it says no when it is compiled */
    if (status == FW_NOMEM) return status;
    *taken = status == FW_OK && linear(&scratch);
    fw_arena_rewind(c->arena, mark);
    return FW_OK;
}

/* Tendons that stay taut, and those that are pulled, need no switch; loose ones go */
static void hold_tendons(const search *s, fw_effects_loads *loads) {
    int kept = 0, tendon = 0;
    for (int i = 0; i < loads->nelement; i++) {
        fw_effects_force_element *e = &loads->element[i];
        bool is = strcmp(e->class_->effect, "tendon") == 0;
        if (is) e->switches = 0;
        if (is && s->loose[tendon++]) continue;
        loads->element[kept++] = *e;
    }
    loads->nelement = kept;
}

static fw_status add_taken(const search *s, fw_effects_loads *loads) {
    const fw_effect_case *c = s->c;
    const bool *taken = s->taken;
    FW_TRY(fw_effects_loads_new(c->arena, c->mechanism, c->scene, loads));
    for (size_t i = 0; i < s->rows; i++)
        if (taken[i]) FW_TRY(s->row[i]->add(c, loads));
    hold_tendons(s, loads);
    return FW_OK;
}

/* Where flexures are to act as they are there are two of them: with the hinges as linear springs
   about the drawn pose, which all bounds go by, and with pins in their place, against which
   nonlinear-hinge is measured. */
static fw_status with_hinges(const search *s, int hinges, fw_effects_envelope *envelope) {
    const fw_effect_case *c = s->c;
    bool *taken = s->taken;
    fw_effects_loads *loads;
    fw_effects_envelope *pinned;
    FW_NEED(loads = fw_arena_one(c->arena, fw_effects_loads));
    FW_NEED(pinned = fw_arena_one(c->arena, fw_effects_envelope));
    *pinned = *envelope;
    taken[hinges] = true;
    FW_TRY(add_taken(s, loads));
    if (loads->strained || loads->stretch.law) { /* what strains do to hinges that give: unknown */
        taken[hinges] = false;
        return FW_OK;
    }
    FW_TRY(fw_effects_envelope_of(c->arena, c->mechanism, c->scene, loads, envelope));
    envelope->pinned = pinned;
    return FW_OK;
}

/* with everything that `taken` says, and the tendons that are not loose */
static fw_status find_all(const search *s, int hinges, fw_effects_envelope *envelope) {
    fw_effects_loads *loads;
    FW_NEED(loads = fw_arena_one(s->c->arena, fw_effects_loads));
    FW_TRY(add_taken(s, loads));
    FW_TRY(fw_effects_envelope_of(s->c->arena, s->c->mechanism, s->c->scene, loads, envelope));
    if (hinges != FW_NONE) FW_TRY(with_hinges(s, hinges, envelope));
    return FW_OK;
}

/* any tendon more, with hinges that give or with pins */
static bool slackens(const search *s, const fw_effects_envelope *e) {
    bool more = tendons_loosen(s->c, e, s->loose);
    if (e->pinned) more = tendons_loosen(s->c, e->pinned, s->loose) || more;
    return more;
}

/* Tendons are taut until the envelope does not say so, fewer every time; what it does not have
   besides could slacken any of them. */
static fw_status settle_tendons(const search *s, int hinges, bool alone,
                                fw_effects_envelope *envelope) {
    const fw_effect_case *c = s->c;
    bool any = false;
    for (int i = 0; i < c->scene->ntendon; i++)
        any = any || isnan(c->scene->tendon[i].pull_N);
    if (!any) return FW_OK;
    bool loose = false;
    while (alone && slackens(s, envelope)) {
        loose = true;
        if (hinges != FW_NONE) s->taken[hinges] = false;
        FW_TRY(find_all(s, hinges, envelope));
    }
    if (!alone) {
        envelope->valid = false;
        envelope->why_not = "cables may go slack by what the envelope does not have";
    }
    if (!loose) return FW_OK;
    for (size_t i = 0; i < s->rows; i++)
        if (strcmp(s->row[i]->id, "tendon") == 0) s->taken[i] = false;
    if (!envelope->valid) return FW_OK;
    const fw_effects_loads *t = envelope->modal->loads;
    if (t->strained || t->stretch.law) { /* what strains do to the cable is in no bound */
        envelope->valid = false;
        envelope->why_not = "strains move the ends of cables that may go slack";
        return FW_OK;
    }
    FW_TRY(tendons_pull(c, envelope, s->loose, &envelope->loose_pull));
    if (!envelope->pinned) return FW_OK;
    if (!envelope->pinned->valid) { /* pins hold all of it, or something else has no envelope */
        envelope->loose_pull = (double)INFINITY;
        return FW_OK;
    }
    double pinned;
    FW_TRY(tendons_pull(c, envelope->pinned, s->loose, &pinned));
    pinned *= envelope->pinned->floor / envelope->floor;
    envelope->loose_pull = fmax(envelope->loose_pull, pinned);
    return FW_OK;
}

/* an effect beside those that are kept looks at their envelope when it adds itself */
static bool looks_first(const search *s) {
    for (size_t i = 0; i < s->rows; i++)
        if (!s->row[i]->kept && !s->row[i]->adds_blindly && !s->row[i]->beside &&
            s->row[i]->called_for(s->c))
            return true;
    return false;
}

fw_status fw_effects_envelope_of_rows(fw_arena *arena, const fw_mechanism *mechanism,
                                      const fw_device_scene *scene, const fw_effect_row *const *row,
                                      size_t count, fw_effects_envelope *envelope) {
    fw_effects_envelope first = {.why_not = "not computed yet"};
    fw_diags quiet =
        fw_diags_new(arena); /* what an effect objects to is said when it is compiled */
    const fw_effect_case c = {arena, mechanism, scene, &first, &quiet, NULL};
    search s = {.c = &c, .row = row, .rows = count};
    fw_effects_loads all;
    bool more = false, alone = true;
    int hinges = FW_NONE;
    FW_NEED(s.taken = fw_arena_array(arena, bool, count));
    FW_NEED(s.loose = fw_arena_array(arena, bool, (size_t)scene->ntendon));
    for (size_t i = 0; i < count; i++)
        s.taken[i] = row[i]->kept && row[i]->called_for(&c);
    FW_TRY(add_taken(&s, &all));
    const bool looks = looks_first(&s);
    if (looks) FW_TRY(fw_effects_envelope_of(arena, mechanism, scene, &all, &first));
    for (size_t i = 0; i < count; i++)
        if (!row[i]->kept && !row[i]->beside && row[i]->called_for(&c)) {
            FW_TRY(can_take(&c, row[i], &s.taken[i]));
            alone = alone && s.taken[i];
            if (s.taken[i] && strcmp(row[i]->id, "nonlinear-hinge") == 0)
                hinges = (int)i, s.taken[i] = false;
            more = more || s.taken[i];
        }
    const bool others = more || hinges != FW_NONE;
    if (!looks && !others) FW_TRY(fw_effects_envelope_of(arena, mechanism, scene, &all, &first));
    *envelope = first;
    if (others) FW_TRY(find_all(&s, hinges, envelope));
    FW_TRY(settle_tendons(&s, hinges, alone, envelope));
    envelope->taken = s.taken;
    return FW_OK;
}
