/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells of the description among the pieces of a drawing, and what they must keep clear of. */
#include "base/text.h"
#include "geometry/segment.h"
#include "layout/draw.h"
#include <math.h>

static const double TOUCH_M = 0.5e-9; /* half of the masks' grid */

const fw_layout_cell *fw_layout_cell_of(const fw_layout *layout, const fw_layout_piece *piece) {
    for (int i = 0; i < layout->ncell; i++)
        if (layout->cell[i].label == piece->label) return &layout->cell[i];
    return NULL;
}

/* What a layer draws of the device a cell draws there, too: its material stands by itself, all else is taken out of
   it or lies beside it. */
static fw_layout_piece piece_of(int role, const char *label) {
    bool material = role == FW_ROLE_STRUCTURE || role == FW_ROLE_FLEXURE || role == FW_ROLE_FRAME ||
                    role == FW_ROLE_TETHER;
    fw_layout_role own = role == FW_CELL_ROLE_NONE ? FW_ROLE_CELL
                         : material                ? FW_ROLE_STRUCTURE
                                                   : (fw_layout_role)role;
    return (fw_layout_piece){
        .role = own, .body = material ? FW_GROUND : FW_NONE - 1, .joint = FW_NONE, .label = label};
}

fw_status fw_layout_cells_add(fw_arena *arena, const fw_device_cell *cell, int ncell,
                              fw_layout *layout, int *capacity) {
    size_t most = 0;
    for (int i = 0; i < ncell; i++)
        most += (size_t)cell[i].nlayer;
    if (most == 0) return FW_OK;
    fw_layout_cell *list = fw_arena_array(arena, fw_layout_cell, most);
    FW_NEED(list);
    layout->cell = list;
    layout->ncell = 0;
    for (int i = 0; i < ncell; i++)
        for (int k = 0; k < cell[i].nlayer; k++) {
            const fw_device_cell_layer *from = &cell[i].layer[k];
            if (from->role == FW_CELL_ROLE_OPEN) continue; /* no flow, so no mask */
            const char *label = fw_arena_printf(arena, "%s%s", FW_NAMED("cell", cell[i].name));
            FW_NEED(label);
            list[layout->ncell++] = (fw_layout_cell){label, from->to, cell[i].biased, &cell[i]};
            for (int n = 0; n < from->drawn->n; n++) {
                fw_layout_piece piece = piece_of(from->role, label);
                piece.contour = from->drawn->outline[n];
                FW_TRY(fw_layout_add(arena, piece, &layout->piece, &layout->npiece, capacity));
            }
        }
    return FW_OK;
}

/* ---- what they keep clear of ---- */

static bool is_kept_clear(const fw_layout_piece *p) {
    return p->body >= 0 || p->body == FW_ISLAND || p->role == FW_ROLE_FLEXURE ||
           p->role == FW_ROLE_TETHER;
}

/* on the back and in the lane nothing of the device is met */
static bool may_meet(const fw_layout_piece *p) {
    return p->role != FW_ROLE_CELL && p->role != FW_ROLE_BACK && p->role != FW_ROLE_DICING;
}

static bool meet(const fw_layout_piece *p, const fw_layout_piece *q, fw_geometry_vec2 *at) {
    fw_geometry_box a = fw_geometry_contour_box(&p->contour),
                    b = fw_geometry_contour_box(&q->contour);
    fw_geometry_vec2 other;
    if (fw_box_gap(a, b) > TOUCH_M) return false;
    *at = p->contour.segment[0].a;
    if (fw_geometry_contour_contains(&q->contour, *at)) return true;
    if (fw_geometry_contour_contains(&p->contour, q->contour.segment[0].a)) {
        *at = q->contour.segment[0].a;
        return true;
    }
    return fw_geometry_contour_distance_below(&p->contour, &q->contour, 2 * TOUCH_M, at, &other) <
           TOUCH_M;
}

/* ---- what holds them ---- */

typedef struct held { /* pieces of cells on a layer of the device */
    const fw_layout *layout;
    const fw_layout_piece **piece; /* (n) */
    const fw_layout_cell **cell;
    fw_geometry_box *box;
    int *part;  /* of which each is: 0 hangs on frame or bases, -1: not known yet */
    int *queue; /* what was reached */
    int n;
} held;

/* all that hangs together with piece i is of this part */
static void spread(held *h, int i, int part) {
    int from = 0, to = 0;
    h->part[i] = part;
    for (h->queue[to++] = i; from < to; from++)
        for (int k = 0; k < h->n; k++) {
            const int q = h->queue[from];
            fw_geometry_vec2 at;
            if (h->part[k] >= 0 || fw_box_gap(h->box[q], h->box[k]) > TOUCH_M ||
                !meet(h->piece[q], h->piece[k], &at))
                continue;
            h->part[k] = part;
            h->queue[to++] = k;
        }
}

static void spread_from_fixed(held *h) {
    for (int k = 0; k < h->layout->npiece; k++) {
        const fw_layout_piece *q = &h->layout->piece[k];
        if (q->body != FW_GROUND || !fw_layout_is_wall(q) || fw_layout_cell_of(h->layout, q))
            continue;
        const fw_geometry_box box = fw_geometry_contour_box(&q->contour);
        fw_geometry_vec2 at;
        for (int i = 0; i < h->n; i++)
            if (h->part[i] < 0 && fw_box_gap(h->box[i], box) <= TOUCH_M &&
                meet(h->piece[i], q, &at))
                spread(h, i, 0);
    }
}

/* parts of a cell: one for all that hangs on what is fixed, and each that does not */
static void sum_up(const held *h, const fw_layout_cell **seen, const fw_layout_cell *cell,
                   fw_layout_hold *out) {
    int first = 0;
    for (int i = 0; i < h->n; i++) {
        const int p = h->part[i];
        if (h->cell[i] != cell) continue;
        if (p > 0 && first == 0) first = p, out->box = h->box[i];
        if (p > 0 && p == first) out->box = fw_box_join(out->box, h->box[i]);
        if (seen[p] == cell) continue;
        seen[p] = cell;
        out->parts++;
        out->loose += p > 0;
    }
}

static const char *which(fw_arena *arena, const fw_layout_hold *hold) {
    const fw_geometry_box b = hold->box;
    char t[4][32];
    if (hold->parts < 2 || hold->loose == 0) return "";
    return fw_arena_printf(arena, ": %d of its %d parts, %sfrom (%s, %s) to (%s, %s) um,",
                           hold->loose, hold->parts, hold->loose > 1 ? "the first " : "",
                           fw_number_text(t[0], sizeof t[0], b.x0 * 1e6, 6),
                           fw_number_text(t[1], sizeof t[1], b.y0 * 1e6, 6),
                           fw_number_text(t[2], sizeof t[2], b.x1 * 1e6, 6),
                           fw_number_text(t[3], sizeof t[3], b.y1 * 1e6, 6));
}

fw_status fw_layout_cells_hold(fw_arena *arena, const fw_layout *layout, fw_layout_hold **out) {
    const size_t most = (size_t)layout->npiece;
    held h = {.layout = layout,
              .piece = fw_arena_array(arena, const fw_layout_piece *, most),
              .cell = fw_arena_array(arena, const fw_layout_cell *, most),
              .box = fw_arena_array(arena, fw_geometry_box, most),
              .part = fw_arena_array(arena, int, most),
              .queue = fw_arena_array(arena, int, most)};
    const fw_layout_cell **seen = fw_arena_array(arena, const fw_layout_cell *, most + 1);
    int parts = 1;
    FW_NEED(seen);
    FW_NEED(*out = fw_arena_array(arena, fw_layout_hold, (size_t)layout->ncell + 1));
    FW_NEED(h.piece && h.cell && h.box && h.part && h.queue ? h.piece : NULL);
    for (int i = 0; i < layout->npiece && layout->ncell > 0; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        const fw_layout_cell *cell = fw_layout_cell_of(layout, p);
        if (!cell || !fw_layout_is_wall(p)) continue;
        h.piece[h.n] = p, h.cell[h.n] = cell, h.part[h.n] = -1;
        h.box[h.n++] = fw_geometry_contour_box(&p->contour);
    }
    spread_from_fixed(&h);
    for (int i = 0; i < h.n; i++)
        if (h.part[i] < 0) spread(&h, i, parts++);
    for (int i = 0; i < layout->ncell; i++) {
        sum_up(&h, seen, &layout->cell[i], &(*out)[i]);
        FW_NEED((*out)[i].of = which(arena, &(*out)[i]));
    }
    return FW_OK;
}

static fw_status check_touch(const fw_layout *l, const fw_layout_cell *c, const fw_layout_piece *p,
                             fw_diags *diags) {
    for (int i = 0; i < l->npiece; i++) {
        const fw_layout_piece *q = &l->piece[i];
        fw_geometry_vec2 at;
        char x[32], y[32];
        if (!is_kept_clear(q) || fw_layout_cell_of(l, q) || !meet(p, q, &at)) continue;
        const char *what = q->body == FW_ISLAND         ? "a net of its own"
                           : q->role == FW_ROLE_TETHER  ? "broken before use"
                           : q->role == FW_ROLE_FLEXURE ? "bends"
                                                        : "moves";
        return fw_diag_error(diags, 572, c->of->layers_place,
                             "%s touches %s, which %s%s, at (%s, %s) um; move the cell, or put it "
                             "on a layer of its own "
                             "(layers=\"...>101/0\")",
                             c->label, q->label,
                             q->body == FW_ISLAND || q->role == FW_ROLE_TETHER ? "is " : "", what,
                             fw_number_text(x, sizeof x, at.x * 1e6, 6),
                             fw_number_text(y, sizeof y, at.y * 1e6, 6));
    }
    return FW_OK;
}

static bool is_on_die(const fw_layout *l, const fw_geometry_contour *c) {
    fw_geometry_box b = fw_geometry_contour_box(c), d = l->die;
    return b.x0 >= d.x0 - TOUCH_M && b.y0 >= d.y0 - TOUCH_M && b.x1 <= d.x1 + TOUCH_M &&
           b.y1 <= d.y1 + TOUCH_M;
}

static fw_status leaves_die(const fw_layout *l, const fw_layout_cell *c,
                            const fw_geometry_contour *of, fw_diags *diags) {
    fw_geometry_box b = fw_geometry_contour_box(of), d = l->die;
    const double um[8] = {b.x0, b.y0, b.x1, b.y1, d.x0, d.y0, d.x1, d.y1};
    char t[8][32];
    for (int i = 0; i < 8; i++)
        fw_number_text(t[i], sizeof t[i], um[i] * 1e6, 6);
    return fw_diag_error(diags, 571, c->of->place,
                         "%s leaves the die: a part of it reaches from (%s, %s) to (%s, %s) um, "
                         "and the die with its "
                         "lane from (%s, %s) to (%s, %s) um; move it, or enlarge the die (<die>)",
                         c->label, t[0], t[1], t[2], t[3], t[4], t[5], t[6], t[7]);
}

fw_status fw_layout_cells_check(const fw_layout *layout, fw_diags *diags) {
    fw_status status = FW_OK;
    for (int i = 0; i < layout->ncell; i++) {
        const fw_layout_cell *c = &layout->cell[i];
        fw_status own = FW_OK; /* one message for each cell and layer */
        for (int k = 0; k < layout->npiece && own == FW_OK; k++) {
            const fw_layout_piece *p = &layout->piece[k];
            if (p->label != c->label) continue;
            if (!is_on_die(layout, &p->contour))
                own = leaves_die(layout, c, &p->contour, diags);
            else if (may_meet(p))
                own = check_touch(layout, c, p, diags);
        }
        if (own != FW_OK) status = own;
    }
    return status;
}
