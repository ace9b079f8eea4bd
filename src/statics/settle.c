/* SPDX-License-Identifier: GPL-3.0-or-later */
/* To the full load without a path: one descent, or, with drivers that move, along their way.

   Drivers take the mechanism along in steps of the load factor s. One step: u + ds du/ds with the
   motion du/ds that the drivers force (least mass norm), closed by Newton, then the descent to
   equilibrium. It counts when the closing corrects little of it and du/ds has turned little, so
   that the assembly stays on its branch, also across places where another branch crosses; else it
   is halved. Error of what is found: that of the descent. Cost: about 60 evaluations (30 n^3) per
   radian that a driver turns. Source: predictor-corrector continuation, Allgower and Georg 1990,
   ch. 2. Test: test_statics.c (turning mechanisms). */
#include "statics/statics_equilibrium.h"
#include <math.h>
#include <string.h>

static const double fw_first_share = 1.0 / 16, fw_least_share = 1e-9;
static const double fw_most_way = 0.3;   /* of any coordinate in one step: rad, scaled lengths */
static const double fw_correction = 0.1; /* of a step, at most, by closing the joints */
static const double fw_straight = 0.99;  /* cosine between du/ds before and after, at least */
static const double fw_contradiction = 1e-6; /* of dPsi/ds, when no motion follows it */

typedef struct walker {
    fw_statics_equilibrium *w;
    double *from, *tangent; /* (n) last equilibrium, du/ds there */
    int dof;
    bool *blamed; /* (nblock) drivers that no motion can follow */
} walker;

/* ---- why not ---- */

/* what of dPsi/ds lies outside of the range of G, at the evaluated state: with A = D G M^-1/2 = U S
   V^T, D dPsi/ds less its part in U_1. Blocks with a part of it contradict each other. */
static fw_status find_contradiction(walker *k) {
    const fw_statics_equilibrium *w = k->w;
    const fw_statics_reduced *r = &w->reduced;
    const fw_multibody_model *m = w->model;
    size_t rows = (size_t)r->rows;
    double *packed, *block, size = 0;
    FW_NEED(packed = fw_arena_array(w->arena, double, rows));
    FW_NEED(block = fw_arena_array(w->arena, double, 2 * (size_t)m->nblock));
    for (int i = 0; i < m->nblock; i++)
        block[2 * i] = w->way[i];
    fw_multibody_pack(m, block, packed);
    for (size_t i = 0; i < rows; i++) {
        packed[i] *= r->balance[i];
        size = fmax(size, fabs(packed[i]));
    }
    for (int l = 0; l < r->rank; l++) {
        const double *u = r->left + (size_t)l * rows;
        double share = 0;
        for (size_t i = 0; i < rows; i++)
            share += u[i] * packed[i];
        for (size_t i = 0; i < rows; i++)
            packed[i] -= share * u[i];
    }
    fw_multibody_unpack(m, packed, block);
    for (int i = 0; i < m->nblock; i++)
        k->blamed[i] =
            m->block[i].driver != FW_NONE && fabs(block[2 * i]) > fw_contradiction * size;
    return FW_OK;
}

static fw_status driver_names(const walker *k, fw_text *names, int *count) {
    const fw_multibody_model *m = k->w->model;
    *count = 0;
    for (int i = 0; i < m->ndriver; i++) { /* in the order of the file */
        if (!k->blamed[m->driver_block[i]]) continue;
        fw_text_printf(names, "%s%s", (*count)++ ? ", " : "",
                       fw_multibody_block_name(k->w->mechanism, &m->block[m->driver_block[i]]));
    }
    return fw_text_end(names);
}

static fw_status cannot_follow(walker *k, double s) {
    fw_statics_equilibrium *w = k->w;
    const fw_multibody_model *m = w->model;
    char at[32];
    int count;
    fw_text names = fw_text_new(w->arena);
    int stuck = w->system->record.stuck;
    fw_statics_equilibrium_factor(w, s);
    memcpy(w->y, k->from, (size_t)m->nq * sizeof(double));
    if (fw_statics_equilibrium_evaluate(w) == FW_OK) FW_TRY(find_contradiction(k));
    FW_TRY(driver_names(k, &names, &count));
    fw_number_text(at, sizeof at, s, 4);
    fw_status status;
    if (count > 0)
        status = fw_diag_error(w->diags, 118, w->scene->place,
                               "the drivers of scene %s contradict %s from load factor %s on: "
                               "%s prescribe%s values that the joints do not allow%s",
                               fw_statics_equilibrium_scene_name(w),
                               count > 1 ? "each other" : "the joints", at, names.data,
                               count > 1 ? "" : "s", count > 1 ? " together" : "");
    else
        status = fw_diag_error(
            w->diags, 118, w->scene->place,
            "the mechanism cannot follow its drivers in scene %s beyond load factor %s: joint "
            "%s cannot be kept closed, because the mechanism cannot reach any farther",
            fw_statics_equilibrium_scene_name(w), at,
            stuck >= 0 ? fw_multibody_block_name(w->mechanism, &m->block[stuck]) : "(unnamed)");
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}

/* ---- one step ---- */

static double product(const fw_multibody_model *m, const double *x, const double *y) {
    double sum = 0;
    for (int i = 0; i < m->nq; i++)
        sum += (i % 3 == 2 ? m->inertia[i / 3] : m->mass[i / 3]) * x[i] * y[i];
    return sum;
}

static void keep(walker *k) {
    size_t bytes = (size_t)k->w->model->nq * sizeof(double);
    memcpy(k->from, k->w->y, bytes);
    memcpy(k->tangent, k->w->follow, bytes);
    k->dof = k->w->reduced.dof;
}

/* from the kept equilibrium over ds to a closed pose at s, evaluated; *good: near enough */
static fw_status predict(walker *k, double s, double ds, bool *good) {
    fw_statics_equilibrium *w = k->w;
    const fw_multibody_model *m = w->model;
    double moved = 0, off = 0;
    *good = false;
    for (int i = 0; i < m->nq; i++) {
        w->y[i] = k->from[i] + ds * k->tangent[i];
        moved = fmax(moved, fabs(ds * k->tangent[i]));
    }
    if (!(moved <= fw_most_way)) return FW_OK;
    fw_statics_equilibrium_factor(w, s);
    fw_status status = fw_statics_equilibrium_evaluate(w);
    if (status != FW_OK) return status == FW_SOLVER ? FW_OK : status;
    for (int i = 0; i < m->nq; i++)
        off = fmax(off, fabs(w->y[i] - k->from[i] - ds * k->tangent[i]));
    double before = product(m, k->tangent, k->tangent), after = product(m, w->follow, w->follow);
    double both = product(m, k->tangent, w->follow);
    *good = off <= fw_correction * moved + 1e-9 && w->reduced.dof <= k->dof &&
            both >= fw_straight * sqrt(before * after);
    return FW_OK;
}

static fw_status walk(walker *k, bool *left_unstable) {
    fw_statics_equilibrium *w = k->w;
    double s = 0, ds = fw_first_share;
    while (s < 1) {
        if (fw_arena_cancelled(w->arena)) return FW_CANCELLED;
        double to = s + ds >= 1 ? 1 : s + ds;
        bool good;
        FW_TRY(predict(k, to, to - s, &good));
        if (!good) {
            ds /= 2;
            if (ds < fw_least_share) return cannot_follow(k, s);
            continue;
        }
        *left_unstable = false;
        if (w->reduced.dof > 0) {
            fw_status status = fw_statics_equilibrium_descend(w, left_unstable);
            if (status != FW_OK)
                return status == FW_SOLVER ? fw_statics_equilibrium_nowhere(w) : status;
        }
        keep(k);
        s = to;
        ds *= 2;
    }
    return FW_OK;
}

fw_status fw_statics_equilibrium_settle(fw_statics_equilibrium *w, bool *left_unstable) {
    size_t n = (size_t)w->model->nq;
    walker k = {.w = w};
    memset(w->y, 0, (size_t)w->model->ny * sizeof(double));
    fw_statics_equilibrium_factor(w, w->moving ? 0 : 1);
    *left_unstable = false;
    fw_status status = fw_statics_equilibrium_descend(w, left_unstable);
    if (status != FW_OK) return status == FW_SOLVER ? fw_statics_equilibrium_nowhere(w) : status;
    if (!w->moving) return FW_OK;
    FW_NEED(k.from = fw_arena_array(w->arena, double, n));
    FW_NEED(k.tangent = fw_arena_array(w->arena, double, n));
    FW_NEED(k.blamed = fw_arena_array(w->arena, bool, (size_t)w->model->nblock));
    keep(&k);
    return walk(&k, left_unstable);
}
