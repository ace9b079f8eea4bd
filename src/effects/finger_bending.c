/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Fingers of combs bend towards each other where the rotor stands aside, and pull it aside the more. No motion has that:
   what it may come to is in every band. Theory: docs/theory/effects/finger-bending.md.
   Test: test_pull_in.c, tests/cli/test_effects.py, tests/docs/theory_effects.py */
#include "base/constants.h"
#include "effects/effect.h"
#include "effects/envelope.h"

/* the softest modulus of any direction in the wafer: of a cubic crystal that along [100] */
static double softest_Pa(const fw_device_material *of) {
    const double e = of->youngs.value, a = of->c11.value, b = of->c12.value;
    return fw_device_material_is_crystal(of) ? fmin(e, (a - b) * (a + 2 * b) / (a + b)) : e;
}

/* mean of 1/gap^3 over the depth, in walls that lean: g/(g^2 - l^2)^2 */
static double cube(const fw_effects_comb_element *c, double gap_m) {
    const double g = gap_m, l = fabs(c->lean_m);
    return g > l ? g / ((g * g - l * l) * (g * g - l * l)) : HUGE_VAL;
}

/* Fingers are cantilevers of length L in a field that pulls them to either side: per gap and length the energy is
   -kappa V^2 D^2/2 of what the gap changes by, kappa = eps0 (h/g^3 + F''/2). Where D is the sum of what two fingers bend,
   D^2 <= 2 (y_a^2 + y_b^2), and each has two gaps: 4 kappa V^2 < mu keeps all stable, mu the least eigenvalue of EI d4/ds4.
   1/mu is at most the trace of the cantilever's answers, int s^3/(3 EI) ds = L^4/(12 EI). Ends act as if the overlap were longer by
   b g there (element.c): at the finger's own tip, and D from its root, where the tip of the other one is

     V^2 = 12 EI/(4 kappa (L^4 + 4 b g (L^3 + D^3))),   12.36 in place of 12 where mu is exact

   and beside a rotor that gives, 1/V^2 adds up at most (Dunkerley). In: SI, from the element, so as made in a verdict;
   out: V, a lower bound. Source: S. Dunkerley, Phil. Trans. A 185 (1894) 279. Theory: docs/theory/effects/comb-drive.md.
   Test: test_pull_in.c */
double fw_effects_comb_fingers_V(const fw_effects_comb_element *c, const fw_mechanism_variant *made,
                                 bool edges) {
    double by[2];
    if (c->kind != FW_ELECTRODES_COMB || !made || !(softest_Pa(&made->material) > 0))
        return (double)INFINITY;
    fw_effects_comb_edge(c->gap_m, c->width_m, by);
    const double l2 = c->length_m * c->length_m, g = c->gap_m, w = c->width_m,
                 bending = softest_Pa(&made->material) * c->depth_m * w * w * w / 12,
                 kappa = FW_VACUUM_PERMITTIVITY_F_PER_m *
                         (c->depth_m * cube(c, g) + (edges ? 0.5 * by[1] : 0));
    const double away = fmax(c->length_m - c->overlap_m, 0), ends = 4 * fmax(c->tip.aside, 0) * g;
    return sqrt(3 * bending / (kappa * (l2 * l2 + ends * (l2 * c->length_m + away * away * away))));
}

static double share_of(const fw_effect_case *c, const fw_effects_comb_element *d,
                       double square_V2) {
    const double volt = fw_effects_comb_fingers_V(d, c->mechanism->variant, true);
    return square_V2 / (volt * volt);
}

static int count(const fw_effect_case *c) {
    int combs = 0;
    for (int i = 0; i < c->scene->ncomb; i++)
        combs += fw_effects_comb_drives(&c->scene->comb[i]) &&
                 c->scene->comb[i].kind == FW_ELECTRODES_COMB;
    return combs;
}

static bool called_for(const fw_effect_case *c) {
    const fw_mechanism_variant *made = c->mechanism->variant;
    return count(c) > 0 && made && softest_Pa(&made->material) > 0;
}

/* Where the gap changes by D at most the field pulls a finger with at most 2 kappa V^2 D per length, kappa that of the
   least gap; a cantilever answers an even load p with p L^4/(8 EI) at its tip and less elsewhere. So with y of the rotor,
   U of either finger and r = V^2/V_f^2 = kappa V^2 L^4/(3 EI)

     D = y + 2 U,   U <= 3/4 r D   =>   2 U <= y 3/2 r/(1 - 3/2 r)

   with r at the gap g - D, found from below. false: nothing is left of it for sure */
static bool bends(const fw_effects_comb_element *d, double share, double y, double *kappa_F_per_m3,
                  double *more) {
    const double g = d->gap_m;
    double by[2], left = g - y;
    *more = 0;
    for (int i = 0; i < 200; i++) {
        if (!(left > 0.5 * g)) return false;
        const double r = 1.5 * share * cube(d, left) / cube(d, g);
        if (!(r < 0.9)) return false;
        const double next = y * r / (1 - r);
        if (next <= *more * (1 + 1e-9)) break;
        *more = next, left = g - y - next;
    }
    fw_effects_comb_edge(left, d->width_m, by);
    *kappa_F_per_m3 = d->face_Fm * cube(d, left) + 0.5 * d->edge_F_per_m * by[1];
    return true;
}

static bool lacks(const fw_effect_case *c, const fw_device_comb *from, fw_effects_comb_reach at,
                  double *force) {
    const fw_effects_comb_element d = fw_effects_comb_as_drawn(c, from);
    const double y = at.aside_m + at.tilt_rad * at.half_m,
                 g = d.gap_m - fabs(d.lean_m); /* at the narrowest face, which pulls most */
    double kappa, more;
    if (!bends(&d, share_of(c, &d, at.square_V2), y, &kappa, &more)) return false;
    const double across = 2 * kappa * at.square_V2 * 2 * at.half_m * more, far = y + more;
    const double along =
        d.face_Fm * at.square_V2 * g * (1 / ((g - far) * (g + far)) - 1 / ((g - y) * (g + y)));
    fw_effects_comb_push(c, from, along, across + along * fmin(1, at.tilt_rad), at.half_m * across,
                         force);
    return true;
}

static double largest_share(const fw_effect_case *c) {
    double most = 0;
    for (int i = 0; i < c->scene->ncomb; i++) {
        const fw_device_comb *from = &c->scene->comb[i];
        if (!fw_effects_comb_drives(from)) continue;
        const fw_effects_comb_element d = fw_effects_comb_as_drawn(c, from);
        const double volt =
            from->voltage_V * fw_quantity_law_measure(from->law, c->scene->duration_s).most;
        most = fmax(most, share_of(c, &d, volt * volt));
    }
    return most;
}

static fw_status words(fw_arena *arena, double share, const char *more, const char **out) {
    char part[32];
    FW_NEED(*out = fw_arena_printf(
                arena,
                "fingers bend by up to %s %% of what would snap them, and pull the rotor aside the "
                "more%s",
                fw_number_text(part, sizeof part, 100 * share, 2), more));
    return FW_OK;
}

static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    const fw_effects_envelope *e = c->envelope;
    const bool valid = e && e->valid;
    double *force, sum = 0;
    fw_mark mark = fw_arena_mark(c->arena);
    for (int i = 0; i < c->scene->ncomb && valid; i++) {
        const fw_device_comb *from = &c->scene->comb[i];
        if (!fw_effects_comb_drives(from) || from->kind != FW_ELECTRODES_COMB) continue;
        FW_NEED(force = fw_arena_array(c->arena, double, (size_t)e->n));
        const fw_effects_comb_element d = fw_effects_comb_as_drawn(c, from);
        const fw_effects_comb_reach at = fw_effects_comb_reaches(c, from, &d);
        if (!lacks(c, from, at, force)) sum = (double)INFINITY;
        sum += fw_effects_envelope_answer(c, force, at.turns) +
               fw_effects_envelope_displaced(c, force, at.turns);
    }
    fw_arena_rewind(c->arena, mark);
    *value = valid && sum < (double)INFINITY ? sum : (double)INFINITY;
    const double share = largest_share(c);
    if (isfinite(share))
        return words(c->arena, share,
                     isfinite(*value) ? "" : "; nothing bounds what that does to the motion",
                     reason);
    else
        *reason =
            "the law of a voltage has no proved bounds, nor has how far fingers bend; nothing "
            "bounds what that does to the motion: give the law as a table, or as one without "
            "poles and atan2";
    return FW_OK;
}

/* by what share a finger's pull may change, where r of V_f is the largest */
static const double fw_force_share = 1.5;

static fw_status beside(const fw_effect_case *c, double *share) {
    *share = fw_force_share * largest_share(c);
    return FW_OK;
}

const fw_effect_row fw_effect_finger_bending = {
    .id = "finger-bending",
    .summary = "fingers of combs that bend towards each other; in every band, in no motion",
    .called_for = called_for,
    .bound = bound,
    .add = fw_effects_add_nothing,
    .count = count,
    .beside = beside};

/* ---- of a motion that is known ---- */

const fw_effect_entry *fw_effects_fingers_open(const fw_effect_ledger *ledger) {
    for (int i = 0; i < ledger->count; i++) {
        const fw_effect_entry *e = &ledger->item[i];
        if (strcmp(e->id, fw_effect_finger_bending.id) == 0 && e->open > 0 && isfinite(e->open))
            return e;
    }
    return NULL;
}

bool fw_effects_fingers_lack(fw_arena *arena, const fw_mechanism *mechanism,
                             const fw_device_scene *scene, const fw_device_comb *drive,
                             const fw_effects_comb_stood *stood, double *force, double *turns) {
    const fw_effect_case c = {arena, mechanism, scene, NULL, NULL, NULL};
    if (!fw_effects_comb_drives(drive) || drive->kind != FW_ELECTRODES_COMB) return true;
    const fw_quantity_law_size law = fw_quantity_law_measure(drive->law, scene->duration_s);
    const fw_effects_comb_element d = fw_effects_comb_as_drawn(&c, drive);
    const double volt = drive->voltage_V * law.most;
    const fw_effects_comb_reach at = {.aside_m = stood->aside_m,
                                      .along_m = stood->along_m,
                                      .tilt_rad = stood->tilt_rad,
                                      .half_m =
                                          0.5 * fmin(d.length_m, d.overlap_m + stood->along_m),
                                      .square_V2 = volt * volt,
                                      .turns = law.most > 0 ? 2 * law.variation / law.most : 0};
    *turns = fmax(*turns, at.turns);
    return lacks(&c, drive, at, force);
}

fw_status fw_effects_fingers_words(fw_arena *arena, const fw_effect_entry *open, const char **how) {
    return words(arena, open->open / fw_force_share, ", in the motion as it was found", how);
}
