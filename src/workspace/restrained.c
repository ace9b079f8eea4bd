/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "workspace/inverse.h"

enum { LINKS = 5 }; /* bodies 0..4 of the six-bar; they and the ground are its core */

typedef struct graph {
    const fw_mechanism *m;
    int *parent;   /* (nbody) trees of bodies that are joined to each other outside of the core */
    int *attached; /* (nbody) at a root: 2 + the body of the core that the tree hangs on, 0: none */
} graph;

static bool core(int body) {
    return body < LINKS;
}

static int root(const graph *g, int body) {
    while (g->parent[body] != body) /* halves the way each time */
        body = g->parent[body] = g->parent[g->parent[body]];
    return body;
}

static void join(const graph *g, int a, int b) {
    if (!core(a) && !core(b)) g->parent[root(g, a)] = root(g, b);
}

/* false: this joint holds two bodies of the core together */
static bool attach(const graph *g, int a, int b) {
    if (core(a) && core(b)) return false;
    if (core(a) == core(b)) return true;
    int inner = core(a) ? a : b, *hangs_on = &g->attached[root(g, core(a) ? b : a)];
    if (*hangs_on == 0) *hangs_on = 2 + inner; /* the ground is -1 */
    return *hangs_on == 2 + inner;
}

/* The joint that takes freedom from the six-bar's platform, so that its inverse kinematics does not
   hold: a driver of a hinge, or a joint that, alone or through further bodies, holds two of the
   six-bar's bodies (or the ground) together. What merely rides on one of them takes none.
   Output: its id, NULL when there is none. Cost linear in joints. Test: test_required.c riders. */
fw_status fw_workspace_six_bar_foreign_joint(fw_arena *arena, const fw_mechanism *m,
                                             const char **id) {
    fw_mark mark = fw_arena_mark(arena);
    graph g = {.m = m};
    FW_NEED(g.parent = fw_arena_array(arena, int, (size_t)m->nbody));
    FW_NEED(g.attached = fw_arena_array(arena, int, (size_t)m->nbody));
    *id = NULL;
    for (int i = 0; i < m->nbody; i++)
        g.parent[i] = i;
    for (int i = FW_SIX; i < m->npin; i++)
        join(&g, m->pin[i].body_a, m->pin[i].body_b);
    for (int i = 0; i < m->njoint; i++)
        join(&g, m->joint[i].body_a, m->joint[i].body_b);
    for (int i = FW_SIX; i < m->npin && !*id; i++)
        if (!attach(&g, m->pin[i].body_a, m->pin[i].body_b)) *id = m->pin[i].id;
    for (int i = 0; i < m->njoint && !*id; i++)
        if (!attach(&g, m->joint[i].body_a, m->joint[i].body_b)) *id = m->joint[i].id;
    for (int i = 0; i < m->ndriver && !*id; i++)
        if (m->driver[i].revolute != FW_NONE && m->driver[i].revolute < FW_SIX)
            *id = m->driver[i].id;
    fw_arena_rewind(arena, mark);
    return FW_OK;
}
