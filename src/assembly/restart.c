/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Other starts for a mechanism that the descent from its guess does not close. */
#include "assembly/closure.h"
#include "base/constants.h"
#include <math.h>
#include <string.h>

enum { LOOP_TRIES = 40, WHOLE_TRIES = 6, LOOP_STEPS = 80, WHOLE_STEPS = 200 };

/* splitmix64 of both arguments (Steele, Lea and Flood 2014): no state, so a start does not depend
   on which others were tried */
double fw_assembly_spread(unsigned stream, unsigned index) {
    uint64_t z = ((uint64_t)stream << 32 | index) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

fw_status fw_assembly_restart_new(fw_arena *arena, const fw_multibody_model *m,
                                  fw_assembly_restart *r) {
    *r = (fw_assembly_restart){.value = (double)INFINITY};
    FW_TRY(fw_assembly_tree_new(arena, m, &r->tree));
    FW_NEED(r->best = fw_arena_array(arena, double, (size_t)m->nq));
    FW_NEED(r->saved = fw_arena_array(arena, double, (size_t)m->nq));
    FW_NEED(r->wanted = fw_arena_array(arena, bool, (size_t)m->nblock));
    FW_NEED(r->loop = fw_arena_array(arena, bool, (size_t)m->nbody + 1));
    return FW_OK;
}

/* bodies from both ends of a block down to the root: the loop that it closes, and what leads to
   it */
static void mark_loop(fw_assembly_restart *r, const fw_multibody_model *m, int block) {
    for (int side = 0; side < 2; side++)
        for (int b = m->body[2 * block + side]; b >= 0 && b < m->nbody; b = r->tree.parent[b])
            r->loop[b] = true;
}

static void place_all(fw_assembly_restart *r, fw_assembly_closure *c, int count) {
    for (int i = 0; i < count; i++)
        fw_assembly_tree_place(&r->tree, c, r->tree.order[i]);
}

/* blocks between the first `count` bodies */
static void activate(fw_assembly_restart *r, fw_assembly_closure *c, int count) {
    for (int i = 0; i < c->model->nblock; i++)
        c->active[i] = r->wanted[i] && r->tree.stage[i] < count;
}

static bool closed(fw_assembly_closure *c) {
    fw_assembly_closure_mismatch(c, c->u, NULL);
    for (int i = 0; i < c->model->nblock; i++)
        if (!(hypot(c->psi[2 * i], c->psi[2 * i + 1]) <= c->goal)) return false;
    return true;
}

/* another pose of a body: turned by up to `radius`, and shifted by as many lengths of the scene,
   which counts where its joints leave a travel or a direction open */
static void disturb(fw_assembly_closure *c, int body, double radius, unsigned stream) {
    for (unsigned k = 0; k < 3; k++)
        c->u[3 * body + (int)k] +=
            radius * (2 * fw_assembly_spread(stream, 3 * (unsigned)body + k) - 1);
}

/* disturbs the bodies of the loop at hand, more with every try, and closes what is placed so far */
static bool close_loop(fw_assembly_restart *r, fw_assembly_closure *c, int count, unsigned stream) {
    const fw_multibody_model *m = c->model;
    memcpy(r->saved, c->u, (size_t)m->nq * sizeof(double));
    for (int i = 0; i < LOOP_TRIES && c->left > 0; i++) {
        if (i > 0) {
            bool all = i % 3 == 0; /* else only the bodies placed last */
            double radius = fmin(FW_PI, 0.4 * (1 + i / 4));
            memcpy(c->u, r->saved, (size_t)m->nq * sizeof(double));
            for (int k = all || count < 2 ? 0 : count - 2; k < count; k++)
                if (r->loop[r->tree.order[k]])
                    disturb(c, r->tree.order[k], radius, stream + (unsigned)i);
            place_all(r, c, count);
            r->restarts++;
        }
        if (fw_assembly_closure_descend(c, LOOP_STEPS)) return true;
    }
    return false;
}

/* one assembly from the poses in c->u: false leaves c->u where it came to */
static bool build_up(fw_assembly_restart *r, fw_assembly_closure *c, unsigned stream) {
    const fw_multibody_model *m = c->model;
    for (int count = 1; count <= m->nbody; count++) {
        fw_assembly_tree_place(&r->tree, c, r->tree.order[count - 1]);
        memset(r->loop, 0, (size_t)m->nbody + 1);
        for (int i = 0; i < m->nblock; i++)
            if (r->wanted[i] && r->tree.stage[i] == count - 1) mark_loop(r, m, i);
        activate(r, c, count);
        if (closed(c)) continue;
        if (!close_loop(r, c, count, stream + 64 * (unsigned)count)) {
            place_all(r, c, m->nbody);
            return false;
        }
    }
    return true;
}

static void keep_best(fw_assembly_restart *r, fw_assembly_closure *c) {
    double value = fw_assembly_closure_mismatch(c, c->u, NULL);
    if (!(value < r->value)) return;
    r->value = value;
    memcpy(r->best, c->u, (size_t)c->model->nq * sizeof(double));
}

/* the guess's orientations first, then orientations farther and farther from them; whatever does
   not close counts with its least mismatch */
bool fw_assembly_restart_close(fw_assembly_restart *r, fw_assembly_closure *c) {
    const fw_multibody_model *m = c->model;
    memcpy(r->wanted, c->active, (size_t)m->nblock * sizeof(bool));
    for (int i = 0; i < WHOLE_TRIES && c->left > 0; i++) {
        memset(c->u, 0, (size_t)m->nq * sizeof(double));
        unsigned stream = 100000u * (unsigned)i;
        for (int b = 0; b < m->nbody && i > 0; b++)
            disturb(c, b, FW_PI * i / (WHOLE_TRIES - 1), stream);
        r->restarts++;
        bool good = build_up(r, c, stream + 1);
        memcpy(c->active, r->wanted, (size_t)m->nblock * sizeof(bool));
        good = fw_assembly_closure_descend(c, WHOLE_STEPS);
        keep_best(r, c);
        if (good) return true;
    }
    r->cut = c->left <= 0;
    memcpy(c->u, r->best, (size_t)m->nq * sizeof(double));
    return false;
}
