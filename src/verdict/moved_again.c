/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scenes that are moved again, since one motion does not give the band: with other stiffnesses, where contacts throw the
   device; with bending and stiffness along flexures apart, where the layer presses them. Near a fold, and where a scene ends on
   the way: near_a_fold.c. */
#include "base/constants.h"
#include "effects/effects.h"
#include "quantity/law_kind.h"
#include "statics/statics.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

bool fw_verdict_has_said(const fw_verdict_variant_verdict *v, const fw_device_scene *s,
                         int number) {
    for (int i = 0; i < v->nreason; i++)
        if (v->reason[i].number == number && v->reason[i].scene == s->name) return true;
    return false;
}

/* ---- how far it goes ---- */

/* how far a coordinate of a body is from where it began; the ground stays */
static double moved(const fw_dynamics_motion *x, int n, int row, int body, int axis) {
    return body == FW_GROUND ? 0 : x->q[row * n + 3 * body + axis] - x->q[3 * body + axis];
}

/* 0 for what moves less than a thousandth of the farthest, or of what flexures are stretched by (most, in m): what a symmetric
   device has of turns, or of ways where heat only presses it, is rounding. Rotations count by the longest arm of a pin */
static void drop_rounding(const fw_mechanism *m, double most, double *far) {
    const int nb = m->nbody, n = 2 * nb + m->nhinge;
    double arm = 0, hardly = 1e-3;
    for (int k = 0; k < m->npin; k++) {
        const fw_mechanism_pin *pin = &m->pin[k];
        if (pin->body_a != FW_GROUND) arm = fmax(arm, hypot(pin->ax_m, pin->ay_m));
        if (pin->body_b != FW_GROUND) arm = fmax(arm, hypot(pin->bx_m, pin->by_m));
    }
    for (int i = 0; i < n; i++)
        most = fmax(most, (i < nb ? 1 : arm) * far[i]);
    for (int i = 0; i < n; i++)
        if (!((i < nb ? 1 : arm) * far[i] > hardly * most)) far[i] = 0;
}

void fw_verdict_farthest(const fw_mechanism *m, const fw_dynamics_motion *x, double *far) {
    const int nb = m->nbody, n = 3 * nb;
    const fw_verdict_strain_monitor *saw = x->observed;
    double most_m = 0; /* that strain all along a strip */
    fw_dynamics_motion_rows(x, 0, x->nsample);
    for (int row = 0; row < x->nsample; row++) {
        for (int b = 0; b < nb; b++) {
            far[b] = fmax(far[b], hypot(moved(x, n, row, b, 0), moved(x, n, row, b, 1)));
            far[nb + b] = fmax(far[nb + b], fabs(moved(x, n, row, b, 2)));
        }
        for (int h = 0; h < m->nhinge; h++) {
            const fw_mechanism_pin *pin = &m->pin[m->hinge[h].pin];
            const double angle =
                moved(x, n, row, pin->body_b, 2) - moved(x, n, row, pin->body_a, 2);
            far[2 * nb + h] = fmax(far[2 * nb + h], fabs(angle));
        }
    }
    for (int h = 0; h < m->nhinge && saw; h++)
        most_m = fmax(most_m, saw->hinge[h].strain.value * m->hinge[h].law.length_m);
    drop_rounding(m, most_m, far);
}

/* ---- what takes hold again and again ----
   What throws back meets what the last blow left by its phase, and behind some blows peaks turn on a per mille of a stiffness. So
   where something takes hold a second time the scene is moved again with flexures stiffer and softer by thirds of what they are
   off by; what it comes to, and a quarter more since the largest may lie between, is a factor on bands. A run that does not get
   to its end tells nothing: half. In: v->motion. Error: an estimate. Cost: six motions, two where these change nothing; of
   corners none. Source: docs/theory/verdict.md. Test: test_hinge.py blows_that_come_again */

static void hold_factor(double more, double now, double was, double *f) {
    const double part = was > 0 ? now / was - 1 : 0;
    f[0] = fmax(f[0], 1 + more * part);
    f[1] = fmin(f[1], fmax(0, 1 + more * part));
}

void fw_verdict_hold_run(const fw_mechanism *m, const fw_dynamics_motion *x,
                         const fw_verdict_strain_monitor *saw, const fw_verdict_hold *h) {
    const int nb = m->nbody, nh = m->nhinge;
    const double hardly_strained = 1e-3;
    double most[2] = {0}, strained = 0;
    memset(h->now, 0, (size_t)(2 * nb + nh) * sizeof *h->now);
    fw_verdict_farthest(m, x, h->now);
    for (int k = 0; k < nh; k++)
        strained = fmax(strained, h->saw->hinge[k].strain.value);
    for (int k = 0; k < nh; k++)
        if (h->saw->hinge[k].strain.value > hardly_strained * strained)
            hold_factor(h->more, saw->hinge[k].strain.value, h->saw->hinge[k].strain.value,
                        h->f + 2 * k);
    for (int i = 0; i < 2 * nb; i++)
        most[i >= nb] = fmax(most[i >= nb], h->far[i]);
    for (int i = 0; i < 2 * nb; i++)
        if (h->far[i] > FW_VERDICT_HARDLY_MOVES * most[i >= nb])
            hold_factor(h->more, h->now[i], h->far[i], h->f + 2 * nh);
}

static fw_status hold_stiffer(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                              double by, const fw_dynamics_motion *like,
                              const fw_dynamics_motion_options *given, const fw_verdict_hold *h,
                              bool *whole) {
    fw_dynamics_motion_options o = *given;
    const fw_dynamics_motion *x;
    fw_verdict_strain_monitor monitor;
    FW_TRY(fw_verdict_strain_monitor_new(arena, m, false, &monitor));
    fw_verdict_strain_monitor_watch(&monitor, &o), o.most_angle_rad = FW_TURN;
    o.trace = NULL, o.whole = false;
    FW_TRY(fw_statics_move_stiffer(arena, m, scene, by, like, &o, &x));
    *whole = x && !x->ended && !monitor.no_memory;
    if (*whole) fw_verdict_hold_run(m, x, &monitor, h);
    return FW_OK;
}

/* more than a stiffness changes where nothing is thrown */
static bool hold_changes(const fw_verdict_hold *h, size_t nhinge, double stiffer) {
    const double in_proportion = 1.5;
    for (size_t k = 0; k < 2 * nhinge + 2; k++)
        if (fabs(h->f[k] - 1) > in_proportion * stiffer) return true;
    return false;
}

fw_status fw_verdict_hold_new(fw_arena *arena, const fw_mechanism *m, const fw_dynamics_motion *x,
                              double more, fw_verdict_hold *to) {
    const size_t nh = (size_t)m->nhinge, n = 2 * (size_t)m->nbody + nh;
    *to = (fw_verdict_hold){.saw = x->observed, .more = more};
    FW_NEED(to->far = fw_arena_array(arena, double, 2 * n + 2 * nh + 2));
    to->now = to->far + n, to->f = to->now + n;
    for (size_t k = 0; k < 2 * nh + 2; k++)
        to->f[k] = 1;
    fw_verdict_farthest(m, x, to->far);
    return FW_OK;
}

fw_status fw_verdict_thrown_again(fw_arena *arena, const fw_mechanism *m, int i,
                                  const fw_dynamics_motion_options *options, bool brief,
                                  fw_diags *diags, fw_verdict_variant_verdict *v) {
    const long again = 3; /* it takes hold, lets go, and takes hold */
    const double least = 5e-3, largest = 5e-2, told = 0.03, half = 0.5;
    const fw_device_scene *s = &m->device->scene[i];
    const fw_dynamics_motion *x = v->motion[i];
    const size_t nh = (size_t)m->nhinge;
    const double e = fmin(fmax(fw_verdict_motion_lasting_error(m), least), largest);
    if (!x || v->corner || nh == 0 || x->ended || !fw_statics_takes_hold(m, s, x, again))
        return FW_OK;
    fw_verdict_hold h;
    FW_TRY(fw_verdict_hold_new(arena, m, x, 1.25, &h));
    bool whole = h.saw != NULL;
    static const int thirds[] = {
        -3, 2, -2, -1, 1, 3}; /* where the first two change nothing phases do not matter */
    for (int k = 0; k < 6 && whole && (k != 2 || hold_changes(&h, nh, e)); k++)
        FW_TRY(hold_stiffer(arena, m, s, e * thirds[k] / 3, x, options, &h, &whole));
    double up = 1, down = 1, *to = v->shaken[i].factor;
    for (size_t k = 0; k < 2 * nh + 2; k += 2) {
        if (!whole) h.f[k] = fmax(h.f[k], 1 + half), h.f[k + 1] = fmin(h.f[k + 1], half);
        to[k] *= h.f[k], to[k + 1] *= h.f[k + 1];
        up = fmax(up, h.f[k]), down = fmin(down, h.f[k + 1]);
    }
    v->shaken[i].late = fmax(v->shaken[i].late, fmax(up - 1, 1 - down));
    if (brief || !(fmax(up - 1, 1 - down) > told)) return FW_OK;
    char most[32], fewest[32], off[32];
    fw_diag_warning(
        diags, 685, s->place,
        "%s%s: what takes hold %ld times or so throws back by the phase that it meets: "
        "with flexures stiffer or softer by up to %s %% its peaks are %s to %s times as "
        "large, which the bands hold; damping, or fewer blows, make them surer",
        FW_NAMED("scene", s->name), (x->stats.events + 1) / 2,
        fw_number_text(off, sizeof off, 100 * e, 2), fw_number_text(fewest, sizeof fewest, down, 3),
        fw_number_text(most, sizeof most, up, 3));
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* ---- what the layer's own strain presses ----
   A force that heat or a stress of the layer makes goes with what flexures are stiff along themselves, which is known to some per
   cent, and what it leaves of their bending goes with K less that force: what decides is how far both are off against each
   other, which no common factor has. So a scene whose layer grows is moved again, with bending softer and stiffer by what it is off
   by, and the stiffness along strips the other way and the same way; bodies, which are in series with that, give where it is
   softer. Bands take in all four; where one of them does not stand the device may have buckled: undecided.
   Exact beams have the roots of the closed form and so its errors; where a flexure is no straight strip they have nothing to turn
   that is stiff against forces alone, and all is compared with closed forms.
   In: v->motion, v->probed. Error: all flexures are off the same way. Cost: four motions, of such scenes alone; of exact beams that
   are curved five. Source: docs/theory/probes.md. Test: test_heated.py, Ratio */

/* what was accepted there is open */
static fw_status tell_lost(fw_arena *arena, const fw_device_scene *s, int scene, double bending,
                           double along, const fw_verdict_way *way, bool found,
                           fw_verdict_variant_verdict *v) {
    char bent[32], strip[32];
    const char *text = fw_arena_printf(
        arena,
        "%s%s: heat or stress makes the layer grow or shrink, and with flexures that bend %s by "
        "the %s %%, and are %s along themselves by the %s %%, that they may be off by, %s: it may "
        "buckle; keep away from there",
        FW_NAMED("scene", s->name), way->stiffer < 0 ? "more easily" : "less easily",
        fw_number_text(bent, sizeof bent, 100 * bending, 2), way->gives ? "softer" : "stiffer",
        fw_number_text(strip, sizeof strip, 100 * along, 2),
        found ? "it rests on an unstable equilibrium" : "no motion to its end was found");
    FW_NEED(text);
    for (int k = 0; k < v->nrequirement; k++) {
        fw_verdict_requirement *r = &v->requirement[k];
        if (r->scene_index != scene || !r->measure || r->why || r->decision == FW_REJECT) continue;
        r->open = "it may buckle (FW-D699)", r->decision = FW_INCONCLUSIVE;
        r->low = r->size || isnan(r->origin) ? 0 : -HUGE_VAL, r->high = HUGE_VAL;
    }
    return fw_verdict_scene_reason(v, s, 699, FW_INCONCLUSIVE, FW_VERDICT_KEEP_HALF, text);
}

/* *told: a reason is given where it does not stand then, or has no such motion */
static fw_status grown_way(fw_arena *arena, const fw_mechanism *m, int i, int k,
                           const fw_dynamics_motion *like, const fw_dynamics_motion_options *given,
                           const fw_verdict_hold *h, const fw_verdict_required *required,
                           fw_verdict_variant_verdict *v, bool *told) {
    const long hopeless = 300000;
    const fw_device_scene *s = &m->device->scene[i];
    double bending, along;
    fw_verdict_off_by_itself(m, &bending, &along);
    const fw_verdict_way way =
        fw_verdict_way_of(k, bending, along, fw_verdict_bending_share(v->motion[i]));
    fw_dynamics_motion_options o = *given;
    fw_verdict_strain_monitor monitor;
    fw_probe_monitor *probe[2];
    const fw_dynamics_motion *x;
    const fw_statics_stability *falls = NULL;
    fw_diags own = fw_diags_new(arena);
    FW_TRY(fw_verdict_strain_monitor_new(arena, m, false, &monitor));
    FW_TRY(required->watch(arena, m, i, v, true, probe));
    monitor.probe = probe[0];
    fw_verdict_strain_monitor_watch(&monitor, &o), o.most_angle_rad = FW_TURN;
    o.within_limits = true, o.hopeless_rhs = hopeless, o.effects.along = way.along;
    o.whole = probe[0] != NULL, o.trace = probe[0] ? fw_verdict_clearance_trace : NULL;
    FW_TRY(fw_statics_move_stiffer(arena, m, s, way.stiffer, like, &o, &x));
    if (monitor.no_memory || (probe[0] && probe[0]->no_memory)) return FW_NOMEM;
    const bool found = x && !x->ended;
    if (found) FW_TRY(fw_statics_stability_find(arena, m, s, x, &own, &falls, NULL, NULL));
    if (!found || falls) {
        if (!*told) FW_TRY(tell_lost(arena, s, i, bending, along, &way, found, v));
        *told = true;
        return FW_OK;
    }
    const double has = fw_verdict_motion_lasting_error(m) +
                       (way.gives ? fw_verdict_bending_share(v->motion[i]) : 0);
    fw_verdict_hold_run(m, x, &monitor, h);
    if (probe[0]) FW_TRY(required->take_in(m, i, x, probe[0], has, v));
    return FW_OK;
}

static bool all_straight(const fw_mechanism *m) {
    for (int k = 0; k < m->nhinge; k++)
        if (!fw_flexure_hinge_law_straight(&m->hinge[k].law)) return false;
    return true;
}

/* *like: what ways are compared with, where not with the motion itself; *saw is then of it; unchanged where it has none */
static fw_status by_closed_forms(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                                 const fw_dynamics_motion_options *given,
                                 fw_verdict_strain_monitor *saw, fw_dynamics_motion *closed,
                                 const fw_dynamics_motion **like) {
    fw_dynamics_motion_options o = *given;
    const fw_dynamics_motion *x;
    if ((*like)->ledger.hinge.used != FW_HINGE_ELASTICA || all_straight(m)) return FW_OK;
    *closed = **like, closed->ledger.hinge.used = FW_HINGE_COMPLIANCE;
    FW_TRY(fw_verdict_strain_monitor_new(arena, m, false, saw));
    fw_verdict_strain_monitor_watch(saw, &o), o.most_angle_rad = FW_TURN;
    o.within_limits = true, o.whole = false, o.trace = NULL;
    FW_TRY(fw_statics_move_stiffer(arena, m, s, 0, closed, &o, &x));
    if (saw->no_memory) return FW_NOMEM;
    if (!x || x->ended) return FW_OK;
    *closed = *x;
    *like = closed;
    return FW_OK;
}

fw_status fw_verdict_grown_again(fw_arena *arena, const fw_mechanism *m, int i,
                                 const fw_dynamics_motion_options *options,
                                 const fw_verdict_required *required,
                                 fw_verdict_variant_verdict *v) {
    const fw_dynamics_motion *x = v->motion[i];
    const size_t nh = (size_t)m->nhinge, n = 2 * (size_t)m->nbody + nh;
    if (!fw_verdict_grows(v, i) || nh == 0 || x->ended || !x->observed) return FW_OK;
    if (fw_verdict_has_said(v, &m->device->scene[i], 259)) return FW_OK; /* as it is */
    fw_verdict_strain_monitor saw;
    fw_dynamics_motion closed;
    const fw_dynamics_motion *like = x;
    FW_TRY(by_closed_forms(arena, m, &m->device->scene[i], options, &saw, &closed, &like));
    fw_verdict_hold h = {.saw = like == x ? x->observed : &saw, .more = 1};
    bool told = false;
    FW_NEED(h.far = fw_arena_array(arena, double, 2 * n + 2 * nh + 2));
    h.now = h.far + n, h.f = v->shaken[i].grown = h.now + n;
    for (size_t k = 0; k < 2 * nh + 2; k++)
        h.f[k] = 1;
    fw_verdict_farthest(m, like, h.far);
    const bool pins = x->ledger.hinge.used == FW_HINGE_REVOLUTE; /* which have nothing along */
    for (int k = 0; k < (pins ? 2 : FW_VERDICT_WAYS); k++)
        FW_TRY(grown_way(arena, m, i, k, like, options, &h, required, v, &told));
    return FW_OK;
}

/* ---- scenes that are repeated in turn ---- */

fw_status fw_verdict_tell_in_turn(fw_arena *arena, const fw_verdict_strain_monitor *monitor,
                                  fw_verdict_variant_verdict *v) {
    const fw_device *d = v->mechanism->device;
    double most = 1, used;
    int worst = FW_NONE;
    char alone[32], all[32];
    for (int k = 0; d->limits.cycles > 0 && k < v->nhinge; k++) {
        const fw_verdict_hinge_verdict *h = &v->hinge[k];
        if (!v->mechanism->hinge[k].limits.life.known || !(h->utilisation_high < 1)) continue;
        FW_TRY(fw_verdict_in_turn(arena, v, k, monitor, &used));
        used *= d->safety_factor * h->utilisation_high / h->utilisation;
        if (used > most) most = used, worst = k;
    }
    for (int i = 0; worst != FW_NONE && i < d->nscene; i++)
        if (strcmp(d->scene[i].name, v->hinge[worst].scene) == 0)
            return fw_verdict_scene_reason(
                v, &d->scene[i], 700, FW_INCONCLUSIVE, 0.95 / most,
                fw_arena_printf(
                    arena,
                    "hinge %s is bent by several scenes, each as often as cycles says: by the "
                    "worst of them alone it uses up to %s %% of its fatigue limit, and up to %s "
                    "%% where they take turns, since from the farthest of one to that of another "
                    "is a cycle; describe what no one device does in turn in files of its own",
                    fw_text_name(v->hinge[worst].id),
                    (fw_percent_text(alone, sizeof alone, v->hinge[worst].utilisation_high), alone),
                    (fw_percent_text(all, sizeof all, most), all)));
    return FW_OK;
}

/* ---- what rings on where scenes are repeated ---- */

/* FW-D698: of the hinge that may use the most; FW-D700 */
fw_status fw_verdict_tell_repeated(fw_arena *arena, const fw_verdict_strain_monitor *monitor,
                                   fw_verdict_variant_verdict *v) {
    const fw_device *d = v->mechanism->device;
    const fw_verdict_hinge_verdict *worst = NULL;
    char to_end[32], behind[32], times[32];
    for (int k = 0; k < v->nhinge; k++) {
        const fw_verdict_hinge_verdict *h = &v->hinge[k];
        if (h->rung > 1 && h->utilisation < 1 && (!worst || h->rung > worst->rung)) worst = h;
    }
    FW_TRY(fw_verdict_tell_in_turn(arena, monitor, v));
    for (int i = 0; worst && i < d->nscene; i++) {
        if (strcmp(d->scene[i].name, worst->scene) != 0) continue;
        fw_percent_text(to_end, sizeof to_end, worst->fatigue_utilisation);
        fw_percent_text(behind, sizeof behind, worst->rung);
        return fw_verdict_scene_reason(
            v, &d->scene[i], 698, FW_INCONCLUSIVE, 0.95 / worst->rung,
            fw_arena_printf(
                arena,
                "hinge %s rings on where %s%s ends, and nothing is known to damp it: %s "
                "repetitions use %s %% of its fatigue limit by what is counted, and up "
                "to %s %% if it rings for a hundred million radians more; give its "
                "material a loss-factor, or the scene what damps it",
                fw_text_name(worst->id), FW_NAMED("scene", worst->scene),
                fw_number_text(times, sizeof times, d->limits.cycles, 3), to_end, behind));
    }
    return FW_OK;
}

/* ---- what no closer look makes better ---- */

bool fw_verdict_in_vain(const fw_verdict_variant_verdict *v, double times) {
    bool any = false;
    for (int i = 0; v->motion && v->mechanism && i < v->mechanism->device->nscene; i++) {
        if (!v->motion[i]) continue;
        any = true;
        if (!(v->motion[i]->stats.beyond > times)) return false;
    }
    return any;
}

/* ---- what the formula of an effect lacks (fw_effect_row.lacking) ----
   A share of what is seen, and of what a mode that lies elsewhere makes of it, so that it comes last. A size is between that share more and as
   much less, 1/(1 + share) of it; of other values it is what they are from where they began. What rings decays otherwise with a
   spring beside the damper: where that is more than a little, a settling time has no bound. */
static const double hardly_lacks = 0.1, lacks_enough = 0.02;

fw_status fw_verdict_requirement_lacking(const fw_verdict_variant_verdict *v,
                                         fw_verdict_requirement *r) {
    const fw_dynamics_motion *x = r->scene_index == FW_NONE ? NULL : v->motion[r->scene_index];
    const fw_device_measure measure = v->mechanism->device->requirement[r->asked].measure;
    const double share = x ? x->ledger.lacking_share : 0;
    if (!(share > 0)) return FW_OK;
    if (measure == FW_MEASURE_SETTLING && share > hardly_lacks) {
        r->low = 0, r->high = HUGE_VAL;
        FW_NEED(r->open = x->ledger.lacking);
    }
    const bool size = measure == FW_MEASURE_PEAK || measure == FW_MEASURE_PEAK_TO_PEAK ||
                      measure == FW_MEASURE_PARASITIC || measure == FW_MEASURE_SETTLING;
    const double from = isfinite(r->origin) ? r->origin : 0,
                 far = fmax(r->swing, fmax(fabs(r->high - from), fabs(r->low - from)));
    r->low -= size ? r->low * share / (1 + share) : share * far;
    r->high += size ? r->high * share : share * far;
    if (r->size) r->low = fmax(0, r->low);
    if (r->value != 0 && isfinite(share)) r->lasting += share;
    return FW_OK;
}

/* what is undecided in a scene whose bands have such a share, and may be for that */
static bool undecided_in(const fw_verdict_variant_verdict *v, int scene) {
    const char *name = v->mechanism->device->scene[scene].name;
    for (int k = 0; k < v->nrequirement; k++)
        if (v->requirement[k].scene_index == scene && v->requirement[k].measure &&
            v->requirement[k].decision == FW_INCONCLUSIVE)
            return true;
    for (int k = 0; k < v->nhinge; k++)
        if (v->hinge[k].decision == FW_INCONCLUSIVE && v->hinge[k].scene &&
            strcmp(v->hinge[k].scene, name) == 0)
            return true;
    return false;
}

fw_status fw_verdict_tell_lacking(fw_arena *arena, fw_verdict_variant_verdict *v) {
    const fw_device *d = v->mechanism->device;
    char by[32];
    for (int i = 0; i < d->nscene; i++) {
        const fw_effect_ledger *l = v->motion[i] ? &v->motion[i]->ledger : NULL;
        if (!l || !l->lacking || !(l->lacking_share > lacks_enough) || !undecided_in(v, i))
            continue;
        const char *text = fw_arena_printf(arena,
                                           "in %s%s %s; bands reach to %s times what the motion "
                                           "has: widen the gap, make the wall smaller, drive "
                                           "it more slowly, or ask for less",
                                           FW_NAMED("scene", d->scene[i].name), l->lacking,
                                           fw_number_text(by, sizeof by, 1 + l->lacking_share, 3));
        FW_NEED(text);
        v->reason[v->nreason++] = (fw_verdict_reason){.scene = d->scene[i].name,
                                                      .flow = v->mechanism->variant->flow,
                                                      .number = 753,
                                                      .decision = FW_INCONCLUSIVE,
                                                      .keep = FW_VERDICT_KEEP_MOST,
                                                      .text = text};
    }
    return FW_OK;
}

/* ---- a loss factor that is known within limits ----
   What rings on, how high a resonance gets and when something has settled goes by what damps, which is known the least of all. A
   factor of the material is anywhere in its interval, or between 1/(1 + 2u) and 1 + 2u times its value, u its relative standard
   uncertainty: two of these either way where it is small, and above 0 always. Where a scene damps by it, be it by its
   <material-damping> or by the estimate for hinges that state no damping, modes that ring under laws are damped by either end
   (resonance.c, ringing.c), and what is asked for behind its first swing is moved again with either end. In: v->motion,
   v->probed. Out: factors of hinges and of what goes farthest, bands of requirements. Range: a factor that the scene does not
   state. Error: between both ends all of that goes one way. Cost: one search for modes; two motions. Test: test_effects.py
   Resonance, what_damps */

bool fw_verdict_loss_ends(const fw_mechanism *m, const fw_device_scene *s, double ends[2]) {
    const fw_quantity *q = &m->variant->material.loss;
    const double known = 1e-3;
    bool estimated = false;
    for (int k = 0; k < m->nhinge; k++)
        estimated = estimated || !m->hinge[k].damping_stated;
    if (!estimated || (s->ndamping > 0 && !isnan(s->damping[s->ndamping - 1].loss_factor)))
        return false;
    if (q->unknown || !(q->value > 0)) return false;
    const double by = 1 + 2 * q->uncertainty / q->value;
    ends[0] = q->interval ? fmax(q->low, 0) : q->value / by;
    ends[1] = q->interval ? q->high : q->value * by;
    return ends[1] > (1 + known) * ends[0];
}

fw_status fw_verdict_with_loss(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                               double loss, fw_mechanism *to, fw_device_scene *scene) {
    const double by = loss / m->variant->material.loss.value;
    fw_mechanism_variant *variant;
    fw_device_material_damping *damping;
    *to = *m, *scene = *s;
    if (s->ndamping > 0) {
        FW_NEED(damping = fw_arena_one(arena, fw_device_material_damping));
        *damping = s->damping[s->ndamping - 1], damping->loss_factor = loss;
        scene->damping = damping, scene->ndamping = 1;
        return FW_OK;
    }
    FW_NEED(variant = fw_arena_one(arena, fw_mechanism_variant));
    *variant = *m->variant, variant->material.loss.value = loss;
    to->variant = variant;
    FW_NEED(to->pin =
                fw_arena_grow(arena, m->pin, (size_t)m->npin, (size_t)m->npin, sizeof *m->pin));
    for (int k = 0; k < m->nhinge; k++)
        if (!m->hinge[k].damping_stated) to->pin[m->hinge[k].pin].damping_Nms_per_rad *= by;
    return FW_OK;
}

/* what is asked for behind the first swing; shaken: beside what bands have by modes (resonance.c) */
static bool asks_later(const fw_verdict_variant_verdict *v, int scene, bool shaken) {
    const fw_device *d = v->mechanism->device;
    for (int k = 0; k < v->nrequirement; k++) {
        const fw_verdict_requirement *r = &v->requirement[k];
        const fw_device_measure measure = d->requirement[r->asked].measure;
        const bool settles = measure == FW_MEASURE_SETTLING;
        if (r->scene_index == scene && r->measure &&
            (settles ||
             (!shaken && (measure == FW_MEASURE_FINAL || measure == FW_MEASURE_PEAK_TO_PEAK ||
                          measure == FW_MEASURE_MINIMUM))))
            return true;
    }
    return false;
}

static fw_status damped_in(fw_arena *arena, int i, double loss,
                           const fw_dynamics_motion_options *given,
                           const fw_verdict_required *required, const fw_verdict_hold *h,
                           fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    fw_mechanism lossy;
    fw_device_scene scene;
    fw_dynamics_motion_options o = *given;
    fw_verdict_strain_monitor monitor;
    fw_probe_monitor *probe[2];
    const fw_dynamics_motion *x;
    FW_TRY(fw_verdict_with_loss(arena, m, &m->device->scene[i], loss, &lossy, &scene));
    FW_TRY(fw_verdict_strain_monitor_new(arena, m, false, &monitor));
    FW_TRY(required->watch(arena, m, i, v, true, probe));
    monitor.probe = probe[0];
    fw_verdict_strain_monitor_watch(&monitor, &o), o.most_angle_rad = FW_TURN;
    o.whole = probe[0] != NULL, o.trace = probe[0] ? fw_verdict_clearance_trace : NULL;
    FW_TRY(fw_statics_move_stiffer(arena, &lossy, &scene, 0, v->motion[i], &o, &x));
    if (monitor.no_memory || (probe[0] && probe[0]->no_memory)) return FW_NOMEM;
    if (!x || x->ended) return FW_OK;
    fw_verdict_hold_run(m, x, &monitor, h);
    return probe[0] ? required->take_in(m, i, x, probe[0], 0, v) : FW_OK;
}

/* its motion is seen and not kept */
static fw_status damped_with(fw_arena *arena, int i, double loss,
                             const fw_dynamics_motion_options *given,
                             const fw_verdict_required *required, const fw_verdict_hold *h,
                             fw_verdict_variant_verdict *v) {
    fw_arena *own = fw_arena_part(arena, 0);
    FW_NEED(own);
    const fw_status status = damped_in(own, i, loss, given, required, h, v);
    fw_arena_free(own);
    return status;
}

fw_status fw_verdict_damped_again(fw_arena *arena, int i, bool shaken,
                                  const fw_dynamics_motion_options *options,
                                  const fw_verdict_required *required,
                                  fw_verdict_variant_verdict *v) {
    const fw_mechanism *m = v->mechanism;
    const fw_dynamics_motion *x = v->motion[i];
    const size_t nh = (size_t)m->nhinge;
    double ends[2], *to = v->shaken[i].factor;
    if (!x || x->ended || !x->observed || nh == 0 || (x->loads && x->loads->quasi_static) ||
        !fw_verdict_loss_ends(m, &m->device->scene[i], ends) || !asks_later(v, i, shaken))
        return FW_OK;
    fw_verdict_hold h;
    FW_TRY(fw_verdict_hold_new(arena, m, x, 1, &h));
    for (int k = 0; k < 2; k++)
        FW_TRY(damped_with(arena, i, ends[k], options, required, &h, v));
    for (size_t k = 0; !shaken && k < 2 * nh + 2; k++)
        to[k] *= h.f[k];
    return FW_OK;
}

/* ---- scenes in which nothing moves ---- */

/* "stroke (final), stroke (parasitic)": what is accepted of a scene; "" */
static fw_status met_there(const fw_verdict_variant_verdict *v, int scene, fw_text *list) {
    for (int k = 0; k < v->nrequirement; k++) {
        const fw_verdict_requirement *r = &v->requirement[k];
        if (!r->measure || r->scene_index != scene || r->decision != FW_ACCEPT) continue;
        fw_text_printf(list, "%s%s (%s)", list->length ? ", " : "", r->probe, r->measure);
    }
    return fw_text_end(list);
}

fw_status fw_verdict_tell_still(fw_arena *arena, fw_diags *diags,
                                const fw_verdict_variant_verdict *v) {
    const fw_device *d = v->mechanism->device;
    int ran = 0, still = 0, first = FW_NONE;
    bool told = false;
    for (int i = 0; i < d->nscene; i++) {
        fw_text met = fw_text_new(arena);
        ran += v->motion[i] != NULL;
        if (!fw_verdict_stands_still(v, i)) continue;
        if (still++ == 0) first = i;
        FW_TRY(met_there(v, i, &met));
        if (met.length == 0) continue;
        const char *few = fw_text_few(arena, met.data);
        FW_NEED(few);
        told = true;
        fw_diag_warning(
            diags, 655, d->scene[i].place,
            "nothing moves in %s%s: what is required there of %s is met by a device that "
            "does nothing; give the scene what drives the device",
            FW_NAMED("scene", d->scene[i].name), few);
    }
    if (ran > 0 && still == ran && !told && !v->workspace.required)
        fw_diag_warning(
            diags, 655, d->scene[first].place,
            "nothing moves in %s: that no hinge is strained says nothing of what the device "
            "bears (a study's governing.utilisation likewise); give a scene what drives it",
            ran > 1 ? "any scene"
                    : fw_arena_printf(arena, "%s%s", FW_NAMED("scene", d->scene[first].name)));
    return diags->failed ? FW_NOMEM : FW_OK;
}
