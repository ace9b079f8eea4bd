/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Why a mechanism does not close, in words. */
#include "assembly/closure.h"
#include "base/constants.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

void fw_assembly_block_gap(const fw_multibody_model *m, int i, const double *psi, double *gap_m,
                           double *gap_rad) {
    double x = fabs(psi[2 * i]), y = fabs(psi[2 * i + 1]), length = m->scale.length_m;
    *gap_m = *gap_rad = 0;
    switch (m->block[i].rows) {
    case FW_ROWS_PIN:
        *gap_m = hypot(x, y) * length;
        break;
    case FW_ROWS_SLIDE:
        *gap_rad = x, *gap_m = y * length;
        break;
    case FW_ROWS_TURN:
        *gap_rad = x;
        break;
    case FW_ROWS_ROD:
    case FW_ROWS_TRAVEL:
        *gap_m = x * length;
        break;
    }
}

fw_assembly_length_unit fw_assembly_length_unit_for(double longest, double shortest) {
    double suits = fmax(fabs(longest), 0), least = fabs(shortest);
    if (least > 0 && least < 1e-3 * suits) suits = 1e3 * least;
    if (suits < 0.01) return (fw_assembly_length_unit){"um", 1e6};
    return suits < 10 ? (fw_assembly_length_unit){"mm", 1e3} : (fw_assembly_length_unit){"m", 1};
}

char *fw_assembly_length_text(char *to, size_t n, double metres, fw_assembly_length_unit unit) {
    char number[32];
    snprintf(to, n, "%s %s", fw_number_text(number, sizeof number, metres * unit.per_m, 4),
             unit.name);
    return to;
}

static char *angle_text(char *to, size_t n, double radian) {
    char number[32];
    snprintf(to, n, "%s deg", fw_number_text(number, sizeof number, radian * 180 / FW_PI, 4));
    return to;
}

/* ---- loops ---- */

typedef struct side { /* of the polygon of a loop */
    double length;
    int body;     /* -1: a rod */
    int from, to; /* blocks at its ends */
} side;

typedef struct ring {
    side *item; /* (count) */
    int count;
    double missing; /* longest side less all others; > 0: the loop cannot close */
    int longest;
} ring;

/* the block that a loop runs through from a body to its parent: a pin before a rod */
static int link_of(const fw_assembly_tree *t, const fw_multibody_model *m, int body) {
    int found = -1;
    for (int e = t->first[body]; e < t->first[body + 1]; e++) {
        const fw_multibody_block *k = &m->block[t->item[e]];
        if (k->a != t->parent[body] && k->b != t->parent[body]) continue;
        if (k->rows == FW_ROWS_PIN) return t->item[e];
        if (k->rows == FW_ROWS_ROD) found = t->item[e];
    }
    return found;
}

static const double *local_at(const fw_multibody_model *m, int block, int body) {
    return m->local + 4 * block + (m->block[block].b == body ? 2 : 0);
}

static void add_side(ring *r, double length, int body, int from, int to) {
    r->item[r->count++] = (side){length, body, from, to};
}

/* blocks and bodies around the loop that `block` closes; false: it runs through a slide, or it is
   no loop. Both ends climb to their common root; the side of the body where they meet comes
   last. */
static bool walk(const fw_assembly_tree *t, const fw_multibody_model *m, int block, int *depth,
                 ring *r) {
    int end[2] = {m->block[block].a, m->block[block].b}, last[2] = {block, block};
    fw_multibody_rows rows = m->block[block].rows;
    r->count = 0;
    if (rows != FW_ROWS_PIN && rows != FW_ROWS_ROD) return false;
    if (rows == FW_ROWS_ROD) add_side(r, -1, -1, block, block); /* its length comes later */
    while (end[0] != end[1]) {
        int s = depth[end[0]] >= depth[end[1]] ? 0 : 1, body = end[s];
        int link = body == m->nbody || t->parent[body] < 0 ? -1 : link_of(t, m, body);
        if (link < 0 || r->count + 3 > 2 * m->nbody + 4) return false;
        const double *p = local_at(m, last[s], body), *q = local_at(m, link, body);
        add_side(r, hypot(p[0] - q[0], p[1] - q[1]), body, last[s], link);
        if (m->block[link].rows == FW_ROWS_ROD) add_side(r, -1, -1, link, link);
        last[s] = link;
        end[s] = t->parent[body];
    }
    if (last[0] == last[1]) return false;
    const double *p = local_at(m, last[0], end[0]), *q = local_at(m, last[1], end[0]);
    add_side(r, hypot(p[0] - q[0], p[1] - q[1]), end[0], last[0], last[1]);
    return true;
}

static void measure(const fw_assembly_closure *c, ring *r) {
    double sum = 0;
    r->longest = 0;
    for (int i = 0; i < r->count; i++) {
        if (r->item[i].body < 0 && r->item[i].length < 0)
            r->item[i].length = fabs(c->kept[r->item[i].from]);
        sum += r->item[i].length;
        if (r->item[i].length > r->item[r->longest].length) r->longest = i;
    }
    r->missing = 2 * r->item[r->longest].length - sum;
}

/* the block that holds a body on its parent; a second one between them closes a loop */
static bool is_branch(const fw_assembly_tree *t, const fw_multibody_model *m, int block) {
    const fw_multibody_block *k = &m->block[block];
    int child = t->parent[k->b] == k->a ? k->b : k->a;
    return t->link[block] && link_of(t, m, child) == block;
}

/* the loop that misses most by the polygon inequality; count 0: none */
static fw_status worst_ring(fw_arena *arena, const fw_assembly_closure *c,
                            const fw_assembly_tree *t, ring *worst) {
    const fw_multibody_model *m = c->model;
    size_t most = 2 * (size_t)m->nbody + 6;
    int *depth;
    ring r = {0};
    *worst = (ring){0};
    FW_NEED(depth = fw_arena_array(arena, int, (size_t)m->nbody + 1));
    FW_NEED(r.item = fw_arena_array(arena, side, most));
    FW_NEED(worst->item = fw_arena_array(arena, side, most));
    depth[m->nbody] = 0;
    for (int i = 0; i < m->nbody; i++) {
        int b = t->order[i];
        depth[b] = t->parent[b] < 0 ? 0 : depth[t->parent[b]] + 1;
    }
    for (int i = 0; i < m->nblock; i++) {
        if (is_branch(t, m, i) || !walk(t, m, i, depth, &r)) continue;
        measure(c, &r);
        if (r.missing <= 1e-12 * m->size || r.missing <= worst->missing) continue;
        memcpy(worst->item, r.item, (size_t)r.count * sizeof *r.item);
        worst->count = r.count, worst->missing = r.missing, worst->longest = r.longest;
    }
    return FW_OK;
}

static const char *body_name(const fw_mechanism *m, int body) {
    return body == m->nbody ? "ground" : fw_text_name(m->body[body].id);
}

static fw_status hint(fw_arena *arena, const fw_mechanism *mechanism, const fw_assembly_closure *c,
                      const fw_assembly_tree *t, double gap_m, fw_assembly_length_unit *unit,
                      const char **text) {
    const fw_multibody_model *m = c->model;
    ring r;
    *text = "check the joint points and the lengths around this loop";
    *unit = fw_assembly_length_unit_for(gap_m, gap_m);
    FW_TRY(worst_ring(arena, c, t, &r));
    if (r.count == 0) return FW_OK;
    double size = m->scale.length_m;
    *unit =
        fw_assembly_length_unit_for(r.item[r.longest].length * size, fmin(r.missing * size, gap_m));
    const side *s = &r.item[r.longest];
    char longest[48], others[48], missing[48];
    fw_assembly_length_text(longest, sizeof longest, s->length * size, *unit);
    fw_assembly_length_text(others, sizeof others, (s->length - r.missing) * size, *unit);
    fw_assembly_length_text(missing, sizeof missing, r.missing * size, *unit);
    const fw_multibody_block *first = &m->block[s->from], *second = &m->block[s->to];
    if (second->pin != FW_NONE && first->pin > second->pin) { /* in the order of the file */
        const fw_multibody_block *other = first;
        first = second, second = other;
    }
    const char *from = fw_multibody_block_name(mechanism, first);
    if (s->body < 0)
        *text = fw_arena_printf(arena,
                                "around its loop, %s is %s long and the other sides reach %s "
                                "together: %s are missing",
                                from, longest, others, missing);
    else
        *text = fw_arena_printf(arena,
                                "around its loop, %s to %s on %s measures %s and the other sides "
                                "reach %s together: %s are missing",
                                from, fw_multibody_block_name(mechanism, second),
                                body_name(mechanism, s->body), longest, others, missing);
    FW_NEED(*text);
    return FW_OK;
}

/* ---- drivers ---- */

static bool has_driver(const fw_multibody_model *m) {
    for (int i = 0; i < m->nblock; i++)
        if (m->block[i].driver != FW_NONE) return true;
    return false;
}

/* closes all joints and leaves the drivers as near to what they ask as the joints allow: their
   mismatch counts a million times less; false: the joints do not close on their own either */
static bool close_without_drivers(fw_assembly_closure *c, fw_assembly_restart *r) {
    const fw_multibody_model *m = c->model;
    for (int i = 0; i < m->nblock; i++)
        c->active[i] = m->block[i].driver == FW_NONE;
    r->value = (double)INFINITY;
    c->left = 4000;
    memset(c->u, 0, (size_t)m->nq * sizeof(double));
    bool good = fw_assembly_closure_descend(c, 200) || fw_assembly_restart_close(r, c);
    for (int i = 0; i < m->nblock; i++) {
        c->active[i] = true;
        c->soft[2 * i] = c->soft[2 * i + 1] = m->block[i].driver == FW_NONE ? 1 : 1e3;
    }
    if (good) {
        c->left = 2000;
        fw_assembly_closure_descend(c, 500);
        fw_assembly_closure_mismatch(c, c->u, NULL);
    }
    for (int i = 0; i < 2 * m->nblock; i++)
        c->soft[i] = 1;
    return good;
}

static fw_status blame_driver(const fw_mechanism *mechanism, const fw_assembly_closure *c,
                              fw_diags *diags) {
    const fw_multibody_model *m = c->model;
    int worst = -1;
    for (int i = 0; i < m->nblock; i++)
        if (m->block[i].driver != FW_NONE &&
            (worst < 0 || fabs(c->psi[2 * i]) > fabs(c->psi[2 * worst])))
            worst = i;
    const fw_multibody_block *b = &m->block[worst];
    const fw_device_driver *d = &mechanism->driver[b->driver];
    double law[3], off = c->psi[2 * worst];
    char asked[48], best[48], less[48];
    fw_quantity_law_value(&d->law, 0, c->system->piece_s, law);
    bool angle = b->rows == FW_ROWS_TURN;
    off *= angle ? 1 : m->scale.length_m;
    double longest = fmax(fabs(law[0]), fabs(law[0] + off));
    const fw_assembly_length_unit unit = fw_assembly_length_unit_for(longest, off);
    const double shown[3] = {law[0], law[0] + off, fabs(off)};
    char *const text[3] = {asked, best, less};
    for (int i = 0; i < 3; i++)
        if (angle)
            angle_text(text[i], sizeof asked, shown[i]);
        else
            fw_assembly_length_text(text[i], sizeof asked, shown[i], unit);
    return fw_diag_error(
        diags, 116, d->place,
        "%s%s cannot have its prescribed value at the start: it prescribes %s, and the "
        "nearest value that the joints allow from this initial guess is %s (%s off); correct "
        "its value or the positions of the bodies",
        FW_NAMED("driver", fw_text_name(d->id)), asked, best, less);
}

/* ---- joints ---- */

static bool turns(const fw_multibody_block *b) {
    return b->rows == FW_ROWS_TURN || b->rows == FW_ROWS_SLIDE;
}

/* row of the angle or of the length; -1: none */
static int row_of(const fw_multibody_block *b, bool angle) {
    if (angle) return turns(b) ? 0 : -1;
    return b->rows == FW_ROWS_TURN ? -1 : b->rows == FW_ROWS_SLIDE ? 1 : 0;
}

/* block with the largest gap, of the angles or of the lengths; -1: none */
static int worst_block(const fw_assembly_closure *c, bool angle) {
    const fw_multibody_model *m = c->model;
    int worst = -1;
    double most = 0;
    for (int i = 0; i < m->nblock; i++) {
        const fw_multibody_block *b = &m->block[i];
        int row = row_of(b, angle);
        if (row < 0) continue;
        double gap = b->rows == FW_ROWS_PIN ? hypot(c->psi[2 * i], c->psi[2 * i + 1])
                                            : fabs(c->psi[2 * i + row]);
        if (gap > most * (1 + 1e-6)) most = gap, worst = i;
    }
    return worst;
}

/* that block's length, or angle, counts a million times less, and the pose follows */
static void concentrate(fw_assembly_closure *c, int block, bool angle) {
    const fw_multibody_block *b = &c->model->block[block];
    for (int k = 0; k < 2; k++)
        if (b->rows == FW_ROWS_PIN || k == row_of(b, angle)) c->soft[2 * block + k] = 1e3;
    c->left = 4000;
    fw_assembly_closure_descend(c, 1000);
    fw_assembly_closure_mismatch(c, c->u, NULL);
}

/* Where angles are held a sum of squares of lengths and angles has no meaning for people. There the
   gap is put into one joint: first a length, with all angles and all other joints kept; what angle
   stays open then, into one joint too. Returns the block that stays open. */
static int gather(fw_assembly_closure *c) {
    const fw_multibody_model *m = c->model;
    const double open = 1e-5; /* scaled: what a weight of a millionth leaves elsewhere */
    bool any = false;
    int worst = 0, angle;
    for (int i = 0; i < m->nblock; i++) {
        const double *psi = c->psi + 2 * i, *most = c->psi + 2 * worst;
        any = any || turns(&m->block[i]);
        if (hypot(psi[0], psi[1]) > hypot(most[0], most[1]) * (1 + 1e-6)) worst = i;
    }
    if (!any) return worst;
    int length = row_of(&m->block[worst], false) >= 0 ? worst : worst_block(c, false);
    if (length >= 0) concentrate(c, length, false);
    angle = worst_block(c, true);
    if (angle >= 0 && fabs(c->psi[2 * angle]) > open)
        concentrate(c, angle, true);
    else
        angle = -1;
    for (int i = 0; i < 2 * m->nblock; i++)
        c->soft[i] = 1;
    length = worst_block(c, false);
    int row = length < 0 ? 0 : row_of(&m->block[length], false);
    if (angle >= 0 && (length < 0 || fabs(c->psi[2 * length + row]) < fabs(c->psi[2 * angle])))
        return angle;
    return length < 0 ? 0 : length;
}

static fw_status blame_joint(fw_arena *arena, const fw_mechanism *mechanism, fw_assembly_closure *c,
                             const fw_assembly_tree *t, bool cut, fw_diags *diags) {
    const fw_multibody_model *m = c->model;
    int worst = gather(c);
    const fw_multibody_block *b = &m->block[worst];
    const char *advice;
    double gap_m, gap_rad;
    char metres[48], radian[48];
    fw_assembly_length_unit unit;
    fw_assembly_block_gap(m, worst, c->psi, &gap_m, &gap_rad);
    FW_TRY(hint(arena, mechanism, c, t, gap_m, &unit, &advice));
    fw_assembly_length_text(metres, sizeof metres, gap_m, unit);
    angle_text(radian, sizeof radian, gap_rad);
    /* the other one is what the weights left */
    bool slide = b->rows == FW_ROWS_SLIDE;
    bool far = gap_m > 1e-4 * gap_rad * m->scale.length_m;
    bool askew = gap_rad * m->scale.length_m > 1e-4 * gap_m;
    bool both = slide && far && askew, angle = b->rows == FW_ROWS_TURN || (slide && !far);
    return fw_diag_error(diags, 100, fw_multibody_block_place(mechanism, b),
                         "%s: %s%s stays open by %s%s%s at best; %s",
                         cut ? "no assembly was found within the bound on the search, from this "
                               "guess"
                             : "the mechanism cannot be assembled",
                         FW_NAMED("joint", fw_multibody_block_name(mechanism, b)),
                         angle ? radian : metres, both ? " and " : "", both ? radian : "", advice);
}

fw_status fw_assembly_closure_explain(fw_arena *arena, const fw_mechanism *mechanism,
                                      fw_assembly_closure *c, fw_assembly_restart *r,
                                      fw_diags *diags) {
    fw_status status;
    size_t bytes = (size_t)c->model->nq * sizeof(double);
    bool cut = r->cut; /* of the whole mechanism, not of the search without drivers */
    memcpy(c->u, r->best, bytes);
    c->left = 2000; /* down to the very least mismatch */
    fw_assembly_closure_descend(c, 500);
    memcpy(r->saved, c->u, bytes);
    if (has_driver(c->model)) {
        double *least;
        FW_NEED(least = fw_arena_array(arena, double, (size_t)c->model->nq));
        memcpy(least, c->u, bytes);
        if (close_without_drivers(c, r)) {
            status = blame_driver(mechanism, c, diags);
            return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
        }
        memcpy(c->u, least, bytes);
    }
    fw_assembly_closure_mismatch(c, c->u, NULL);
    status = blame_joint(arena, mechanism, c, &r->tree, cut, diags);
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}
