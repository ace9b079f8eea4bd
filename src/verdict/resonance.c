/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a law does near a resonance. Bands hold what a stiffness is off by in proportion. A law that goes to and fro near a mode does much more or less where
   the mode lies a little lower or higher than computed, which its own error allows. Of every mode k and each such law,
   whatever it acts by, A(w) is the largest answer of an oscillator (fw_quantity_law_swing), and

     r_k = max over laws and over w of A(w)/A(w_k),

   w within the mode's error and what bodies give, half a radian apart at the end of the scene. A(w_k) is damped as the motion
   is, whose whole scene says what is set off (set_off); A(w) by the least loss factor that the material may have, or by
   the largest where that is less (moved_again.c). What is softer goes farther besides, by w_k^2/w^2 less what bands hold
   of that. How far a mode swings is seen in the motion: a_k, the largest of its modal speed, shape . M v, over w_k, or over
   the law's frequency where that is lower, but no more than it is ever away from the start. Of a hinge that is bent in
   mode k by s_k, and by S at most in the motion,

     up = 1 + sum a_k s_k (r_k - 1)/S,

   down likewise with the least A; of what bodies move by the same with how far they go, the worst body counts.
   Inputs: the motion, and modes about the equilibrium of what does not go to and fro, voltages that do by their root mean
   square. Where that may be reached from rest within the scene frequencies in between belong to the range. Outputs: factors on what moves, up >= 1 >= down. Error: small motions, as modes are; a mode's shape stays.
   Cost: modes, 24 steps a period for each frequency. Test: test_effects.py Resonance. What comes again: ringing.c; hinges that this leaves open: beside_resonance.c. Loads that
   make a mode stiffer and softer pump it (FW-D650): modes about the equilibria of their largest values. */
#include "base/constants.h"
#include "geometry/segment.h"
#include "quantity/law_kind.h"
#include "statics/statics.h"
#include "verdict/body.h"
#include "verdict/strain.h"
#include "verdict/verdict_parts.h"
#include <math.h>
#include <string.h>

enum { MODES_SHAKEN = 24 };

typedef struct shaking {
    const fw_quantity_law *law;
    fw_quantity_law_acts as;
    bool stiffens; /* it makes stiffnesses come and go, and pulls by its square alone: a voltage */
} shaking;

typedef struct shakings { /* of one scene, those that go to and fro */
    shaking *item;
    int n;
    bool again; /* something comes while a mode may still ring by what came before */
    fw_quantity_law_pieces pieces; /* of all that acts, where it does */
    double end_s;
} shakings;

static void take_law(shakings *to, const fw_quantity_law *law, fw_quantity_law_acts as) {
    if (fw_quantity_law_goes_to_and_fro(law, to->end_s))
        to->item[to->n++] = (shaking){law, as, false};
}

static bool in_the_plane(const fw_device_base_motion *b) {
    return b->ax_m_per_s2 != 0 || b->ay_m_per_s2 != 0;
}

/* What prescribes a coordinate is followed, and heat strains what is held as a load does: it counts as both. Parts of a scene may
   act by the square of their law: likewise. A voltage also makes stiffnesses come and go with its law */
static fw_status find_laws(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                           shakings *to) {
    const int most = s->nforce + s->ntorque + s->ntendon + s->nbase +
                     2 * (s->ncomb + s->ntemperature + s->npart) + m->ndriver;
    *to = (shakings){.end_s = s->duration_s};
    FW_NEED(to->item = fw_arena_array(arena, shaking, (size_t)most));
    for (int i = 0; i < s->nforce; i++)
        take_law(to, s->force[i].law, FW_LAW_OF_LOAD);
    for (int i = 0; i < s->ntorque; i++)
        take_law(to, s->torque[i].law, FW_LAW_OF_LOAD);
    for (int i = 0; i < s->ntendon; i++)
        take_law(to, s->tendon[i].law, FW_LAW_OF_LOAD);
    for (int i = 0; i < s->nbase; i++)
        if (in_the_plane(&s->base[i])) take_law(to, s->base[i].law, FW_LAW_OF_LOAD);
    for (int i = 0; i < m->ndriver; i++)
        take_law(to, &m->driver[i].law, FW_LAW_OF_COORDINATE);
    for (int as = 0; as < 2; as++) {
        const int before = to->n;
        for (int i = 0; i < s->ncomb; i++)
            take_law(to, s->comb[i].law, as ? FW_LAW_OF_LOAD : FW_LAW_SQUARED);
        for (int i = before; i < to->n; i++)
            to->item[i].stiffens = as;
        for (int i = 0; i < s->npart; i++)
            take_law(to, s->part[i].law, as ? FW_LAW_OF_LOAD : FW_LAW_SQUARED);
        for (int i = 0; i < s->ntemperature; i++)
            take_law(to, s->temperature[i].law, as ? FW_LAW_OF_LOAD : FW_LAW_OF_COORDINATE);
    }
    return fw_verdict_comes_again(arena, m, s, &to->again, &to->pieces);
}

/* ---- about which pose: what of a scene does not go to and fro ---- */

/* *moves: it stands elsewhere than at rest, or as stiff; *slowly: it comes there in the scene */
static fw_status steady_part(fw_arena *arena, const fw_device_scene *s, fw_device_scene *to,
                             bool *moves, bool *slowly) {
    const double end = s->duration_s;
    *to = *s;
    to->set_off = s; /* it is damped as in the motion */
    FW_TRY(fw_device_own_scene(arena, to));
    to->nforce = to->ntorque = to->ntendon = to->nbase = to->ntemperature = to->npart = 0;
    *slowly = false;
#define STAYS(kind)                                                                                \
    for (int i = 0; i < s->n##kind; i++) {                                                         \
        if (fw_quantity_law_goes_to_and_fro(s->kind[i].law, end)) continue;                        \
        *slowly = *slowly || !fw_quantity_law_is_constant(s->kind[i].law);                         \
        to->kind[to->n##kind++] = s->kind[i];                                                      \
    }
    STAYS(force)
    STAYS(torque)
    STAYS(tendon)
    STAYS(base)
    STAYS(temperature)
    STAYS(part)
#undef STAYS
    for (int i = 0; i < s->ncomb; i++) {
        *slowly = *slowly || !fw_quantity_law_is_constant(s->comb[i].law);
        if (!fw_quantity_law_goes_to_and_fro(s->comb[i].law, end)) continue;
        to->comb[i].voltage_V *= fw_quantity_law_root_mean_square(s->comb[i].law, end);
        to->comb[i].law = NULL;
    }
    *moves = to->nforce + to->ntorque + to->ntendon + to->nbase + to->ntemperature + to->npart +
                 to->ncomb + to->nstress >
             0;
    *moves = *moves || to->gx_m_per_s2 != 0 || to->gy_m_per_s2 != 0 || to->gravity;
    return FW_OK;
}

/* ---- what a mode may do more or less ---- */

typedef fw_verdict_answer answer;

/* r of one law where a mode may lie, and what of it bends hinges */
static answer answers_to(const shaking *by, double end_s, const fw_verdict_shaken_mode *mode,
                         fw_verdict_softness softer) {
    const double most_steps = 3e6, low = mode->low, high = mode->high,
                 steps = 24 * high / (2 * FW_PI);
    const fw_quantity_law_wave wave = fw_quantity_law_wave_of(by->law);
    const double a_second = fmax(steps, 48 * wave.fastest_Hz),
                 end = fmin(end_s, most_steps / a_second); /* by then it swings evenly */
    const double as_computed = fw_quantity_law_swing(by->law, by->as, end, mode->omega,
                                                     mode->damping[FW_VERDICT_AS_DAMPED]);
    const double own = (by->as == FW_LAW_SQUARED ? 2 : 1) * wave.rad_per_s;
    const double n =
        fmin(2 + ceil((high - low) * end / 0.5), fmax(20, most_steps / (a_second * end)));
    answer r = {1, 1, 1};
    double least_at = mode->omega;
    if (!(as_computed > 0) ||
        (by->stiffens && !(mode->low < 1.5 * own && 1.5 * mode->high > own))) /* no tongue */
        return r;
    for (double k = 0; k < n + 4; k++) { /* the last two with what damps most */
        const double at = k < n        ? low + (high - low) * k / (n - 1)
                          : k == n     ? fmin(fmax(own, low), high)
                          : k == n + 2 ? least_at
                                       : mode->omega;
        const double now = fw_quantity_law_swing(
            by->law, by->as, end, at,
            mode->damping[k < n + 2 ? FW_VERDICT_LEAST_DAMPED : FW_VERDICT_MOST_DAMPED]);
        const double by_stiffness =
            by->as == FW_LAW_OF_COORDINATE ? 1 : fw_verdict_soft_within(softer, mode, at);
        if (!(now >= 0)) continue;
        r.strained = fmax(r.strained, now / as_computed * fmax(1, by_stiffness));
        r.up = fmax(r.up, now / as_computed * by_stiffness);
        if (now / as_computed * by_stiffness < r.down)
            r.down = now / as_computed * by_stiffness, least_at = at;
    }
    return r;
}

/* How far it goes by a law, over its largest speed over its own frequency: what a slower law moves is slower */
static double slower_by(const shaking *by, const fw_verdict_shaken_mode *mode) {
    const double law =
        (by->as == FW_LAW_SQUARED ? 2 : 1) * fw_quantity_law_wave_of(by->law).rad_per_s;
    if (by->as == FW_LAW_OF_COORDINATE) return 1;
    return law > 0 ? fmax(1, fmin(mode->omega / law, mode->goes)) : mode->goes;
}

/* of what comes again, and of each law that goes to and fro; to: rows, of every hinge and body */
static fw_status answers_of(fw_arena *arena, const shakings *by, const fw_verdict_shaken *shaken,
                            int k, const fw_verdict_shaken_mode *mode, fw_verdict_softness softer,
                            int rows, answer *to) {
    FW_TRY(fw_verdict_rings_again(arena, &by->pieces, by->end_s, shaken, k, rows, softer, to));
    for (int j = 0; j < by->n; j++) {
        const answer now = answers_to(&by->item[j], by->end_s, mode, softer);
        for (int i = 0; i < rows; i++) {
            const double share =
                slower_by(&by->item[j], mode) * fw_verdict_bends_most(mode->bends[i]);
            to[i].up = fmax(to[i].up, 1 + share * (now.up - 1));
            to[i].strained = fmax(to[i].strained, 1 + share * (now.strained - 1));
            to[i].down = fmin(to[i].down, fmax(0, 1 - share * (1 - now.down)));
        }
    }
    return FW_OK;
}

static double late_of(const fw_verdict_shaken_mode *mode, const answer *r, double end_s, int nhinge,
                      int bodies) {
    const double phase = fmax(mode->high - mode->omega, mode->omega - mode->low) * end_s;
    double most = 0;
    for (int i = nhinge; i < bodies; i++)
        most = fmax(most, fmin(r[i].up - 1 + 2 * fw_verdict_bends_most(mode->bends[i]),
                               r[i].up - 1 + phase * fw_verdict_bends_most(mode->bends[i])));
    return mode->late * most;
}

/* All modes that lie elsewhere one by one, and where one share moves them all; of what moves the worst body counts. under (n):
   where a mode may lie under laws that go to and fro, or NULL: there as well */
static fw_status add_answers(fw_arena *arena, const fw_mechanism *m, const shakings *by,
                             const fw_verdict_shaken *shaken, fw_verdict_softness softer,
                             const fw_verdict_shaken_mode *under, double *factor, double *each,
                             double *late) {
    const int nh = m->nhinge, bodies = nh + m->nbody, rows = bodies + shaken->nreach;
    answer *sum = fw_arena_array(arena, answer, 2 * (size_t)rows), *now = sum + rows;
    FW_NEED(sum);
    for (int i = 0; i < rows; i++)
        sum[i] = (answer){1, 1, 1};
    for (int k = 0; k < shaken->n; k++) {
        FW_TRY(answers_of(arena, by, shaken, k, under ? &under[k] : &shaken->mode[k], softer, rows,
                          now));
        for (int i = 0; i < rows; i++) {
            sum[i].up += now[i].up - 1, sum[i].strained += now[i].strained - 1;
            sum[i].down = fmax(0, sum[i].down - (1 - now[i].down));
        }
        *late += late_of(&shaken->mode[k], now, by->end_s, nh, bodies);
    }
    FW_TRY(
        fw_verdict_rings_again(arena, &by->pieces, by->end_s, shaken, FW_NONE, rows, softer, now));
    for (int i = 0; i < rows; i++)
        each[i] = i < nh ? fmax(sum[i].strained, now[i].strained) : fmax(sum[i].up, now[i].up);
    for (int i = 0; i < bodies; i++) {
        double *to = factor + 2 * (i < nh ? i : nh);
        to[0] = fmax(to[0], fmax(sum[i].up, now[i].up));
        to[1] = fmin(to[1], fmax(0, fmin(sum[i].down, now[i].down)));
    }
    return FW_OK;
}

/* where the modes of `other`, at rest, lie elsewhere: the scene passes there */
static void hold_both(const fw_statics_modes *other, double bodies, fw_verdict_shaken *s) {
    for (int k = 0; k < s->n; k++) {
        fw_verdict_shaken_mode *mode = &s->mode[k];
        if (mode->number >= other->count) continue;
        const fw_statics_mode *at = &other->mode[mode->number];
        if (!(at->stiffness_per_s2 > 0)) continue;
        const double off = fmin(fw_statics_mode_error(at), 0.5);
        mode->low = fmin(mode->low, at->omega_rad_per_s * fw_verdict_mode_lowest(off, bodies));
        mode->high = fmax(mode->high, at->omega_rad_per_s * (1 + off));
    }
}

/* with the least loss factor of flexures, where that is known within limits; *ends: both of them, or twice the same */
static fw_status least_lossy(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                             double ends[2], fw_mechanism *to, fw_device_scene *scene) {
    *to = *m, *scene = *s, ends[0] = ends[1] = m->variant->material.loss.value;
    if (!fw_verdict_loss_ends(m, s, ends)) return FW_OK;
    return fw_verdict_with_loss(arena, m, s, ends[0], to, scene);
}

/* what damps modes at least and at most: by their modes with the least loss, and in proportion beyond the factor as it is */
static fw_status damped_within(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                               bool at_equilibrium, fw_verdict_shaken *to) {
    const double loss = m->variant->material.loss.value;
    const fw_statics_modes *modes;
    fw_mechanism lossy;
    fw_device_scene scene;
    double ends[2];
    FW_TRY(least_lossy(arena, m, s, ends, &lossy, &scene));
    if (!(ends[1] > ends[0])) return FW_OK;
    FW_TRY(fw_verdict_modes_about(arena, &lossy, &scene, at_equilibrium, 0.03, &modes));
    for (int k = 0; k < to->n; k++) {
        const int number = to->mode[k].number;
        double *is = to->mode[k].damping, *least = &is[FW_VERDICT_LEAST_DAMPED];
        *least = modes && number < modes->count ? fw_verdict_damping_of(&modes->mode[number])
                                                : *is * ends[0] / loss;
        *least = fmin(*least, *is);
        is[FW_VERDICT_MOST_DAMPED] =
            fmin(0.99, loss > ends[0] ? *is + (*is - *least) * (ends[1] - loss) / (loss - ends[0])
                                      : *is * ends[1] / loss);
    }
    return FW_OK;
}

/* modes of the scene with how far they swing in it; none: nothing goes to and fro, or nothing swings */
static fw_status find_shaken(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                             const fw_dynamics_motion *motion, double bodies, bool own,
                             shakings *by, double *model, fw_verdict_shaken *to) {
    const fw_statics_modes *modes = NULL, *rest = NULL;
    fw_device_scene steady, still = {.name = "(none)",
                                     .duration_s = 1,
                                     .set_off = s,
                                     .damping = s->damping,
                                     .ndamping = s->ndamping};
    bool moves, slowly, held = false;
    FW_TRY(find_laws(arena, m, s, by));
    if (motion->loads && motion->loads->quasi_static)
        by->n = 0, by->again = own = false; /* equilibria neither swing nor are pumped */
    if ((by->n == 0 && !by->again && !own) || motion->nsample < 2) return FW_OK;
    FW_TRY(steady_part(arena, s, &steady, &moves, &slowly));
    FW_TRY(fw_verdict_modes_about(arena, m, &steady, moves, 0.03, &modes));
    const bool reached = modes != NULL;
    if (!modes) FW_TRY(fw_verdict_modes_about(arena, m, &still, false, 0.03, &modes));
    if (!modes) return FW_OK;
    FW_NEED(to->mode = fw_arena_array(arena, fw_verdict_shaken_mode, MODES_SHAKEN));
    FW_TRY(fw_verdict_swings(arena, m, s, by->again, modes, motion, MODES_SHAKEN, to));
    FW_TRY(damped_within(arena, m, reached ? &steady : &still, reached && moves, to));
    for (int k = 0; k < to->n; k++) {
        const fw_statics_mode *is = &modes->mode[to->mode[k].number];
        const double error = fw_statics_mode_error(is), off = fmin(error, 0.5);
        model[k] = isnan(error) ? error : is->model_error;
        to->mode[k].low = to->mode[k].soft =
            to->mode[k].omega * fw_verdict_mode_lowest(off, bodies);
        to->mode[k].high = to->mode[k].stiff = to->mode[k].omega * (1 + off);
        /* of pins on an axis that nobody knows no stiffness is known to be off by that much */
        to->mode[k].held = isnan(error) ? HUGE_VAL : 1 + fw_verdict_motion_lasting_error(m);
        to->mode[k].least = to->mode[k].omega * (1 - off);
    }
    for (int c = 0; c < to->nreach; c++)
        held = held || (to->reach[c].rests && to->reach[c].gap_m > 0);
    if (reached && (slowly || held))
        FW_TRY(fw_verdict_modes_about(arena, m, &steady, false, 0.03, &rest));
    if (rest) fw_verdict_reach_gives(rest, MODES_SHAKEN, true, to); /* before it is met */
    if (rest && slowly) hold_both(rest, bodies, to);
    return FW_OK;
}

/* ---- what pumps: loads that make a mode stiffer and softer as they go to and fro ---- */

/* the scene at rest with what goes to and fro at its largest, one way (1) or the other (-1) */
static fw_status held_at(fw_arena *arena, const fw_device_scene *s, double way,
                         fw_device_scene *to) {
    const double end = s->duration_s;
    *to = *s;
    FW_TRY(fw_device_own_scene(arena, to));
#define HOLD(kind, ...)                                                                            \
    for (int i = 0; i < s->n##kind; i++) {                                                         \
        if (!fw_quantity_law_goes_to_and_fro(s->kind[i].law, end)) continue;                       \
        const double by = way * fw_quantity_law_measure(s->kind[i].law, end).most;                 \
        to->kind[i].law = NULL;                                                                    \
        __VA_ARGS__                                                                                \
    }
    HOLD(force, to->force[i].fx_N *= by; to->force[i].fy_N *= by;)
    HOLD(torque, to->torque[i].value_Nm *= by;)
    HOLD(temperature, to->temperature[i].change_K *= by;)
    HOLD(tendon, to->tendon[i].pull_N *= fmax(by, 0); to->tendon[i].draw_m *= fmax(by, 0);)
    HOLD(comb, to->comb[i].voltage_V *= fmax(by, 0);)
    HOLD(base, to->gx_m_per_s2 -= by * s->base[i].ax_m_per_s2;
         to->gy_m_per_s2 -= by * s->base[i].ay_m_per_s2; to->gravity = true;
         to->base[i].ax_m_per_s2 = to->base[i].ay_m_per_s2 = 0;)
#undef HOLD
    return FW_OK;
}

/* Share by which the square of a mode's frequency comes and goes; where one way has no equilibrium, as much as the other */
static double comes_and_goes(const fw_statics_modes *rest, const fw_statics_modes *const at[2],
                             int k) {
    const double own = rest->mode[k].stiffness_per_s2;
    double change[2];
    for (int i = 0; i < 2; i++) {
        const fw_statics_modes *is = at[i] ? at[i] : at[1 - i];
        if (!is || k >= is->count) return 0;
        change[i] = (at[i] ? 1 : -1) * (is->mode[k].stiffness_per_s2 - own) / own;
    }
    return fmin(0.5 * fabs(change[0] - change[1]), 1);
}

/* the most over the loads and over frequencies from low to high, so close together that none is missed */
static double grows_most(const shakings *by, double low, double high, double omega, double damping,
                         double share) {
    const double most_steps = 1e6, end = by->end_s;
    double grown = 0;
    for (int i = 0; i < by->n; i++) {
        const fw_quantity_law *law = by->item[i].law;
        const double fastest = fw_quantity_law_wave_of(law).fastest_Hz,
                     a_second = 48 * fmax(high / (2 * FW_PI), fastest),
                     largest = fw_quantity_law_measure(law, end).most,
                     run = fmin(end, most_steps / (3 * a_second)),
                     wanted = 2 + ceil((high - low) * fmin(run, 8 / (share * omega)) / 0.25),
                     n = fmin(wanted, fmax(3, most_steps / (a_second * run)));
        for (double j = 0; j < n; j++) {
            const double now =
                fw_quantity_law_pumps(law, by->item[i].as == FW_LAW_SQUARED, run, largest,
                                      low + (high - low) * j / (n - 1), damping, share);
            /* what has doubled goes on like that */
            grown = fmax(grown, now > 2 ? pow(now, end / run) : now);
        }
    }
    return grown;
}

static fw_status tell_pumped(fw_arena *arena, const fw_device_scene *s, const fw_statics_mode *mode,
                             double share, double grown, fw_verdict_variant_verdict *v) {
    char f[32], goes[32], times[32];
    return fw_verdict_scene_reason(
        v, s, 650, FW_INCONCLUSIVE, FW_VERDICT_KEEP_HALF,
        fw_arena_printf(
            arena,
            "%s%s makes the mode at %s Hz stiffer and softer by %s %% as its loads go to and "
            "fro, and so may let what swings there grow %s times, whatever begins it "
            "(parametric resonance): keep the loads' frequency from twice the mode's and from "
            "the mode's, lower the loads along flexures, or say by <material-damping> what "
            "damps",
            FW_NAMED("scene", s->name), fw_number_text(f, sizeof f, mode->f_Hz, 4),
            fw_number_text(goes, sizeof goes, 100 * share, 2),
            grown < 1e3 ? fw_number_text(times, sizeof times, grown, 3) : "a thousand"));
}

/* What grows tenfold from nothing that anybody states may be of any size */
static fw_status may_pump(fw_arena *arena, const fw_mechanism *m, int scene, const shakings *by,
                          double bodies, fw_verdict_variant_verdict *v) {
    const double much = 10, fine = 1e-3; /* a share is a difference */
    const fw_device_scene *s = &m->device->scene[scene];
    const fw_statics_modes *at[2] = {NULL, NULL}, *rest = NULL;
    fw_device_scene held, steady;
    fw_mechanism lossy;
    double ends[2];
    bool moves, slowly;
    if (by->n == 0) return FW_OK;
    for (int i = 0; i < 2; i++) {
        FW_TRY(held_at(arena, s, i ? -1 : 1, &held));
        FW_TRY(fw_verdict_modes_about(arena, m, &held, true, fine, &at[i]));
    }
    FW_TRY(steady_part(arena, s, &steady, &moves, &slowly));
    FW_TRY(least_lossy(arena, m, &steady, ends, &lossy, &held));
    FW_TRY(fw_verdict_modes_about(arena, &lossy, &held, moves, fine, &rest));
    for (int k = 0; rest && (at[0] || at[1]) && k < rest->count && k < MODES_SHAKEN; k++) {
        const fw_statics_mode *mode = &rest->mode[k];
        if (!(mode->stiffness_per_s2 > 0)) continue;
        const double share = comes_and_goes(rest, at, k), omega = mode->omega_rad_per_s,
                     damping = fw_verdict_damping_of(mode),
                     off = fmin(fw_statics_mode_error(mode), 0.5);
        if (!(0.25 * share * omega * by->end_s > log(much))) continue;
        const double grown = grows_most(by, omega * fw_verdict_mode_lowest(off, bodies),
                                        omega * (1 + off), omega, damping, share);
        if (grown > much) return tell_pumped(arena, s, mode, share, grown, v);
    }
    return FW_OK;
}

/* less (2 nhinge): what factors of hinges are to be multiplied by */
static fw_status moved_again(fw_arena *arena, const fw_mechanism *m, int scene, double bodies,
                             const shakings *by, const double *model,
                             const fw_dynamics_motion_options *options, double *less,
                             const fw_verdict_variant_verdict *v) {
    const size_t nh = (size_t)m->nhinge, n = 2 * nh + 2;
    fw_verdict_shaken own = v->shaken[scene];
    fw_verdict_shaken_mode *under;
    const double *of = own.factor;
    double common, late = 0, *each, *factor = fw_arena_array(arena, double, 2 * n),
                   *now = factor + n;
    FW_NEED(factor);
    if (!fw_verdict_stiffness_decides(v, scene, of)) return FW_OK;
    FW_NEED(own.mode = fw_arena_array(arena, fw_verdict_shaken_mode, 2 * (size_t)own.n));
    under = own.mode + own.n;
    if (!fw_verdict_leave_modes(&v->shaken[scene], by->end_s, bodies, model, own.mode, under,
                                &common))
        return FW_OK;
    for (size_t i = 0; i < n; i++)
        factor[i] = 1, now[i] = of[i];
    FW_NEED(each = fw_arena_array(arena, double, nh + (size_t)m->nbody + (size_t)own.nreach));
    FW_TRY(add_answers(arena, m, by, &own, FW_VERDICT_AS_STIFF, under, factor, each, &late));
    FW_TRY(fw_verdict_stiffness_again(arena, m, scene, options, common, factor, v, now));
    for (size_t i = 0; i < 2 * nh; i++)
        less[i] = of[i] > 0 ? now[i] / of[i] : 1;
    return FW_OK;
}

static fw_status detuned(fw_arena *arena, const fw_mechanism *m, int scene, double bodies, bool may,
                         const fw_dynamics_motion_options *options, bool brief, double *less,
                         fw_verdict_variant_verdict *v) {
    const fw_device_scene *s = &m->device->scene[scene];
    fw_verdict_shaken *to = &v->shaken[scene];
    shakings by;
    double model[MODES_SHAKEN];
    FW_TRY(find_shaken(arena, m, s, v->motion[scene], bodies, may, &by, model, to));
    double hangs_s2 = 0; /* 1/omega^2 of rigid bodies and of what hangs over add up (Weyl) */
    for (int i = 0; v->out_of_plane && v->out_of_plane->hung && i < m->nbody; i++)
        hangs_s2 = fmax(hangs_s2, v->out_of_plane->hung[i].in_plane_mode_s2);
    for (int k = 0; k < to->n; k++) {
        const double lower = sqrt(1 + hangs_s2 * to->mode[k].omega * to->mode[k].omega);
        to->mode[k].low /= lower, to->mode[k].soft /= lower;
    }
    FW_NEED(to->each = fw_arena_array(arena, double,
                                      (size_t)m->nhinge + (size_t)m->nbody + (size_t)to->nreach));
    FW_TRY(
        add_answers(arena, m, &by, to, FW_VERDICT_AS_STIFF, NULL, to->factor, to->each, &to->late));
    if (to->n > 0 && !v->corner && !brief)
        FW_TRY(moved_again(arena, m, scene, bodies, &by, model, options, less, v));
    return v->corner ? FW_OK : may_pump(arena, m, scene, &by, bodies, v);
}

fw_status fw_verdict_shaken_within(fw_arena *arena, const fw_mechanism *m, int scene,
                                   const fw_verdict_shaken *shaken, fw_verdict_softness softer,
                                   double *factor, double *each, double *late) {
    shakings by;
    FW_TRY(find_laws(arena, m, &m->device->scene[scene], &by));
    for (int h = 0; h <= m->nhinge; h++)
        factor[2 * h] = factor[2 * h + 1] = 1;
    *late = 0;
    return add_answers(arena, m, &by, shaken, softer, NULL, factor, each, late);
}

fw_status fw_verdict_is_shaken(fw_arena *arena, const fw_mechanism *m, int scene, bool *shaken) {
    shakings by;
    FW_TRY(find_laws(arena, m, &m->device->scene[scene], &by));
    *shaken = by.n > 0;
    return FW_OK;
}

/* a hinge of whose flexure nobody says where it points; NULL: there is none */
static const char *without_axis(const fw_mechanism *m) {
    for (int k = 0; k < m->nhinge; k++)
        if (!isfinite(m->hinge[k].axis_rad)) return fw_text_name(m->pin[m->hinge[k].pin].id);
    return NULL;
}

/* v->shaken; warnings, and a reason where what does not meet may then meet */
fw_status fw_verdict_detune(fw_arena *arena, const fw_mechanism *m, const double *bodies,
                            const fw_dynamics_motion_options *options,
                            const fw_verdict_required *required, bool brief, fw_diags *diags,
                            fw_verdict_variant_verdict *v) {
    const double told = 1.1;
    const fw_device *d = m->device;
    const int nh = m->nhinge;
    fw_verdict_own own = {0};
    FW_NEED(v->shaken = fw_arena_array(arena, fw_verdict_shaken, (size_t)d->nscene));
    for (int i = 0; i < d->nscene; i++) {
        double *f, *less_open, most, least = 1;
        char up[32], down[32];
        bool may, shaken;
        FW_NEED(less_open = fw_arena_array(arena, double, 2 * (size_t)nh));
        FW_NEED(f = v->shaken[i].factor = fw_arena_array(arena, double, 2 * (size_t)nh + 2));
        for (int h = 0; h < 2 * nh + 2; h++)
            f[h] = 1;
        for (int h = 0; h < 2 * nh; h++)
            less_open[h] = 1;
        FW_TRY(fw_verdict_is_shaken(arena, m, i, &shaken));
        FW_TRY(fw_verdict_may_swing(arena, v, i, shaken, bodies[i], &own, &may));
        if (v->motion[i])
            FW_TRY(detuned(arena, m, i, bodies[i], may, options, brief, less_open, v));
        const double shakes = fw_verdict_most_of(f, 2 * nh + 2);
        FW_TRY(fw_verdict_thrown_again(arena, m, i, options, brief, diags, v));
        fw_verdict_requirement_factor(f, nh, v->shaken[i].required);
        v->shaken[i].required_late = v->shaken[i].late;
        for (int h = 0; h < 2 * nh; h++) /* of hinges alone, whose strains were looked at */
            f[h] *= less_open[h];
        if (may) FW_TRY(fw_verdict_bodies_swing(arena, i, shaken, &own, v));
        const double ways = f[2 * nh];
        if (v->motion[i] && !fw_verdict_stands_still(v, i)) { /* ways of round-off have no ratio */
            const double e = fw_verdict_bending_counted(v->motion[i]) +
                             fw_verdict_motion_model_error(m, v->motion[i]);
            FW_TRY(fw_verdict_softened(arena, m, i, e, options, required, brief, diags, v));
        }
        FW_TRY(fw_verdict_damped_again(arena, i, shaken, options, required, v));
        FW_TRY(fw_verdict_grown_again(arena, m, i, options, required, v));
        const double *g = v->shaken[i].grown, far = f[2 * nh] * (g ? g[2 * nh] : 1),
                     near = f[2 * nh + 1] * (g ? g[2 * nh + 1] : 1);
        FW_TRY(fw_verdict_modes_may_meet(arena, i, near, far, v));
        if (v->motion[i]) FW_TRY(fw_verdict_may_touch(arena, i, v));
        FW_TRY(fw_verdict_swings_tell(arena, i, brief, diags, v));
        FW_TRY(fw_verdict_modes_may_ring(arena, i, v));
        fw_verdict_modes_come_near(i, far, ways * (g ? g[2 * nh] : 1), v);
        most = fw_verdict_most_of(f, 2 * nh + 2);
        if (!(shakes > told) || brief) continue;
        for (int h = 0; h <= nh; h++)
            least = fmin(least, f[2 * h + 1]);
        const char *axis = without_axis(m);
        fw_diag_warning(
            diags, 642, d->scene[i].place,
            "%s%s %s a mode whose frequency is %s%s%s: within %s it moves %s to %s times as far, "
            "which the bands hold; %skeep the frequencies apart, or say by <material-damping> what "
            "damps",
            FW_NAMED("scene", d->scene[i].name),
            shaken ? "shakes near" : "comes again while it still rings by",
            axis ? "not known, since nothing says the axis of hinge " : "known to some per cent",
            axis ? axis : "", axis ? ", and may be half as large, or half larger" : "",
            axis ? "that" : "them", fw_number_text(down, sizeof down, least, 2),
            fw_number_text(up, sizeof up, most, 2), axis ? "state its axis, " : "");
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}
