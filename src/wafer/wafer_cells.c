/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cells and arrays of the plate, and the cells by which every die gets its id. */
#include "layout/layout.h"
#include "wafer/wafer.h"
#include <math.h>
#include <string.h>

/* ---- cells and arrays ----
   Cells and arrays. Array steps are whole multiples of the pitch in dbu, so that columns and rows
   divide the corners of an AREF exactly. */

static bool taken(const fw_wafer *w, const char *name) {
    for (int i = 0; i < w->ncell; i++)
        if (strcmp(w->cell[i].name, name) == 0) return true;
    return w->top && strcmp(w->top, name) == 0;
}

/* a name that no other cell has: readers take the last of two cells of one name, or stop */
static const char *own_name(fw_wafer_maker *m, const char *name) {
    const char *own = name;
    for (int k = 2; own && taken(m->wafer, own); k++)
        own = fw_arena_printf(m->arena, "%.*s_%d", FW_WAFER_LONGEST_NAME - 6, name, k);
    return own;
}

fw_status fw_wafer_add_cell(fw_wafer_maker *m, const char *name, const fw_mask *mask, int32_t dx,
                            int32_t dy, int *cell) {
    fw_wafer *w = m->wafer;
    if (w->ncell == m->cells) {
        int more = m->cells ? 2 * m->cells : 64;
        FW_NEED(w->cell = fw_arena_grow(m->arena, w->cell, (size_t)w->ncell, (size_t)more,
                                        sizeof *w->cell));
        m->cells = more;
    }
    const char *own = own_name(m, name);
    FW_NEED(own);
    *cell = w->ncell;
    w->cell[w->ncell++] = (fw_wafer_cell){.name = own, .mask = mask, .dx = dx, .dy = dy};
    return FW_OK;
}

static fw_status add_run(fw_wafer_maker *m, fw_wafer_run run) {
    fw_wafer *w = m->wafer;
    if (w->nrun == m->runs) {
        int more = m->runs ? 2 * m->runs : 256;
        FW_NEED(w->run =
                    fw_arena_grow(m->arena, w->run, (size_t)w->nrun, (size_t)more, sizeof *w->run));
        m->runs = more;
    }
    w->cell[run.cell].placed += run.columns * run.rows;
    w->run[w->nrun++] = run;
    return FW_OK;
}

/* the longest evenly spaced run from site i on, in its row, of sites with its cell that are not
   done; marks them */
static fw_status add_run_from(fw_wafer_maker *m, const int *cell_of, bool *done, int i, int end) {
    const fw_wafer_grid *g = &m->wafer->grid;
    int n = 1, stride = 0, at = g->site[i].column;
    done[i] = true;
    for (int j = i + 1; j < end; j++) {
        if (done[j] || cell_of[j] != cell_of[i]) continue;
        int step = g->site[j].column - at;
        if (stride == 0) stride = step;
        if (step > stride) break; /* a gap: another run begins there */
        if (step < stride) continue;
        done[j] = true;
        at = g->site[j].column;
        n++;
    }
    const fw_wafer_cell *c = &m->wafer->cell[cell_of[i]];
    return add_run(m, (fw_wafer_run){.cell = cell_of[i],
                                     .x = g->site[i].x + c->dx,
                                     .y = g->site[i].y + c->dy,
                                     .columns = n,
                                     .rows = 1,
                                     .step_x = (stride ? stride : 1) * g->pitch_x,
                                     .step_y = g->pitch_y});
}

fw_status fw_wafer_add_rows(fw_wafer_maker *m, const int *cell_of) {
    const fw_wafer_grid *g = &m->wafer->grid;
    bool *done = fw_arena_array(m->arena, bool, (size_t)g->nsite);
    FW_NEED(done);
    for (int start = 0, end; start < g->nsite; start = end) {
        for (end = start; end < g->nsite && g->site[end].row == g->site[start].row;)
            end++;
        for (int i = start; i < end; i++)
            if (!done[i] && cell_of[i] >= 0) FW_TRY(add_run_from(m, cell_of, done, i, end));
    }
    return FW_OK;
}

/* ---- die ids ----
   Die ids: the row's letter and the column's number on the frame of every device, without making
   one die unlike another: a cell per row name and one per column name, placed in the top cell as
   arrays along rows and columns.

   Where: a rectangle that in every die of the wafer lies in the frame (its middle in a piece of the
   frame, no edge but joints within) and is MARGIN away from every edge, letter, mark and lane;
   looked for in the four bars of the frame, from their middles outwards, first with the largest
   strokes. Decided on boxes of segments, which only errs to the safe side. Cost: places x shapes.
   Test: test_wafer_build.c. */

static const double MARGIN_M = 10e-6, LARGEST_STROKE_M = 12e-6, LEAST_STROKE_M = 5e-6;
enum { HIGH = 9, LETTER = 7, APART = 2, ALONG = 21, ACROSS = 5 };

typedef struct die { /* one of the different dies, in coordinates of a place */
    const fw_mask *mask;
    fw_geometry_box *box; /* (mask->nshape) of its shapes, in coordinates of the cell */
    double dx, dy;
    fw_geometry_box bar[4]; /* of the frame, in coordinates of a place */
} die;

static bool meet(fw_geometry_box a, fw_geometry_box b) {
    return a.x0 < b.x1 && b.x0 < a.x1 && a.y0 < b.y1 && b.y0 < a.y1;
}

static fw_geometry_box around(const fw_geometry_segment *s) {
    if (s->kind == FW_ARC)
        return (fw_geometry_box){s->centre.x - s->radius, s->centre.y - s->radius,
                                 s->centre.x + s->radius, s->centre.y + s->radius};
    return (fw_geometry_box){fmin(s->a.x, s->b.x), fmin(s->a.y, s->b.y), fmax(s->a.x, s->b.x),
                             fmax(s->a.y, s->b.y)};
}

static bool edge_inside(const fw_geometry_contour *c, fw_geometry_box r) {
    for (int i = 0; i < c->count; i++) {
        fw_geometry_box b = around(&c->segment[i]);
        b = (fw_geometry_box){b.x0 - 1e-9, b.y0 - 1e-9, b.x1 + 1e-9,
                              b.y1 + 1e-9}; /* an edge has no area */
        if (!(c->segment[i].flags & FW_SEGMENT_JOINT) && meet(b, r)) return true;
    }
    return false;
}

/* r: with the margin, in coordinates of a place */
static bool is_free(const die *d, fw_geometry_box r) {
    fw_geometry_box own = {r.x0 - d->dx, r.y0 - d->dy, r.x1 - d->dx, r.y1 - d->dy};
    fw_geometry_vec2 middle = {0.5 * (own.x0 + own.x1), 0.5 * (own.y0 + own.y1)};
    bool framed = false;
    for (int i = 0; i < d->mask->nshape; i++) {
        if (!meet(d->box[i], own)) continue;
        const fw_mask_shape *s = &d->mask->shape[i];
        fw_layout_role role = s->piece->role;
        if (role == FW_ROLE_CAVITY || role == FW_ROLE_LAND) continue; /* below the device layer */
        if (role == FW_ROLE_TEXT || role == FW_ROLE_MARK || role == FW_ROLE_DICING) return false;
        if (edge_inside(&s->contour, own)) return false;
        framed =
            framed || (role == FW_ROLE_FRAME && fw_geometry_contour_contains(&s->contour, middle));
    }
    return framed;
}

static bool free_in_all(const die *d, int n, fw_geometry_box r) {
    for (int i = 0; i < n; i++)
        if (!is_free(&d[i], r)) return false;
    return true;
}

/* 0, 1, -1, 2, -2 ... over n */
static double swing(int k, int n) {
    return (k % 2 ? 1 : -1) * ((k + 1) / 2) / (double)(n / 2 > 0 ? n / 2 : 1);
}

/* lower left corner of a free rectangle of w x h; the bars are those of the first die */
static bool find_place(const die *d, int n, double w, double h, fw_geometry_vec2 *at) {
    for (int b = 0; b < 4; b++) {
        fw_geometry_box bar = d[0].bar[b];
        double room_x = bar.x1 - bar.x0 - w, room_y = bar.y1 - bar.y0 - h;
        if (room_x < 0 || room_y < 0) continue;
        bool upright = bar.y1 - bar.y0 > bar.x1 - bar.x0;
        int nx = upright ? ACROSS : ALONG, ny = upright ? ALONG : ACROSS;
        for (int k = 0; k < nx * ny; k++) {
            double x = 0.5 * room_x * (1 + swing(upright ? k % nx : k / ny, nx));
            double y = 0.5 * room_y * (1 + swing(upright ? k / nx : k % ny, ny));
            *at = (fw_geometry_vec2){fw_layout_to_grid(bar.x0 + x), fw_layout_to_grid(bar.y0 + y)};
            fw_geometry_box r = {at->x - MARGIN_M, at->y - MARGIN_M, at->x + w + MARGIN_M,
                                 at->y + h + MARGIN_M};
            if (free_in_all(d, n, r)) return true;
        }
    }
    return false;
}

static fw_status die_of(fw_wafer_maker *m, const fw_mask *mask, fw_geometry_box outline,
                        fw_geometry_box window, die *d) {
    int32_t dx, dy;
    fw_wafer_origin(&m->wafer->grid, outline, &dx, &dy);
    *d = (die){.mask = mask, .dx = dx * 1e-9, .dy = dy * 1e-9};
    FW_NEED(d->box = fw_arena_array(m->arena, fw_geometry_box, (size_t)mask->nshape));
    fw_geometry_box o = {HUGE_VAL, HUGE_VAL, -HUGE_VAL,
                         -HUGE_VAL}; /* of the frame: without its lane */
    for (int i = 0; i < mask->nshape; i++) {
        fw_geometry_box b = d->box[i] = fw_geometry_contour_box(&mask->shape[i].contour);
        if (mask->shape[i].piece->role == FW_ROLE_FRAME)
            o = (fw_geometry_box){fmin(o.x0, b.x0 + d->dx), fmin(o.y0, b.y0 + d->dy),
                                  fmax(o.x1, b.x1 + d->dx), fmax(o.y1, b.y1 + d->dy)};
    }
    fw_geometry_box i = {window.x0 + d->dx, window.y0 + d->dy, window.x1 + d->dx,
                         window.y1 + d->dy};
    d->bar[0] = (fw_geometry_box){o.x0, o.y0, i.x0, o.y1};
    d->bar[1] = (fw_geometry_box){i.x1, o.y0, o.x1, o.y1};
    d->bar[2] = (fw_geometry_box){o.x0, o.y0, o.x1, i.y0};
    d->bar[3] = (fw_geometry_box){o.x0, i.y1, o.x1, o.y1};
    return FW_OK;
}

static double rule(const fw_mask_table *table) {
    double least = LEAST_STROKE_M;
    for (int k = 0; k < table->nlayer; k++)
        if (table->layer[k].roles & 1u << FW_ROLE_TEXT)
            least = fmax(least, fmax(table->layer[k].min_width_m, table->layer[k].min_space_m));
    return least;
}

static double line_width(size_t letters, double stroke) {
    return ((LETTER + APART) * (double)letters - APART) * stroke;
}

static fw_status add_name(fw_wafer_maker *m, fw_wafer_cell_kind kind, const char *prefix,
                          const char *text, int *cell, double *width) {
    double stroke = m->wafer->stroke_m;
    fw_wafer_sheet s = {.maker = m};
    FW_TRY(fw_layout_text(m->arena, text, (fw_geometry_vec2){0, 0}, HIGH * stroke, stroke,
                          FW_ROLE_TEXT, "die id", &s.piece, &s.npiece, &s.capacity));
    *width = fw_layout_text_width(text, HIGH * stroke, stroke);
    const char *name = fw_arena_printf(m->arena, "%s_%s", prefix, text);
    FW_NEED(name);
    const fw_mask *mask;
    FW_TRY(fw_wafer_sheet_mask(&s, name, false, &mask));
    FW_TRY(fw_wafer_add_cell(m, name, mask, 0, 0, cell));
    m->wafer->cell[*cell].kind = kind;
    return FW_OK;
}

static int32_t dbu(double m) {
    return (int32_t)fw_wafer_dbu(m);
}

/* the letters of one row, in arrays over neighbouring dies */
static fw_status add_row(fw_wafer_maker *m, int start, int end, double field) {
    fw_wafer *w = m->wafer;
    const fw_wafer_grid *g = &w->grid;
    char text[FW_WAFER_NAME];
    int cell = -1;
    double width = 0;
    for (int i = start, n; i < end; i += n) {
        n = 1;
        if (g->site[i].kind != FW_WAFER_DIE) continue;
        while (i + n < end && g->site[i + n].kind == FW_WAFER_DIE)
            n++;
        if (cell < 0)
            FW_TRY(add_name(m, FW_WAFER_CELL_ROW, "ROW", fw_wafer_row_name(g->site[i].row, text),
                            &cell, &width));
        int32_t dx = dbu(w->id_at.x + field - width), dy = dbu(w->id_at.y);
        FW_TRY(add_run(m, (fw_wafer_run){cell, g->site[i].x + dx, g->site[i].y + dy, n, 1,
                                         g->pitch_x, g->pitch_y}));
        w->cell[cell].dx = dx, w->cell[cell].dy = dy;
    }
    return FW_OK;
}

/* the number of one column; at[r]: its site in row r or -1 */
static fw_status add_column(fw_wafer_maker *m, const int *at, int column, double from) {
    fw_wafer *w = m->wafer;
    const fw_wafer_grid *g = &w->grid;
    char text[FW_WAFER_NAME];
    int cell = -1;
    double width;
    for (int r = 0, n; r < g->rows; r += n) {
        n = 1;
        if (at[r] < 0) continue;
        while (r + n < g->rows && at[r + n] >= 0)
            n++;
        if (cell < 0)
            FW_TRY(add_name(m, FW_WAFER_CELL_COLUMN, "COLUMN",
                            fw_wafer_column_name(g, column, text), &cell, &width));
        const fw_wafer_site *lowest = &g->site[at[r + n - 1]];
        int32_t dx = dbu(w->id_at.x + from), dy = dbu(w->id_at.y);
        FW_TRY(add_run(
            m, (fw_wafer_run){cell, lowest->x + dx, lowest->y + dy, 1, n, g->pitch_x, g->pitch_y}));
        w->cell[cell].dx = dx, w->cell[cell].dy = dy;
    }
    return FW_OK;
}

/* what the letters of a die and half the margin around them take: the written plate draws it apart, so
   that dies stay alike. The place was found in a bar of the frame with the whole margin free. */
static void set_windows(fw_wafer *w, size_t letters, size_t all) {
    double stroke = w->stroke_m, m = 0.5 * MARGIN_M;
    int32_t y0 = dbu(w->id_at.y - m), y1 = dbu(w->id_at.y + HIGH * stroke + m);
    int32_t between = dbu(w->id_at.x + line_width(letters, stroke) + 0.5 * APART * stroke);
    w->id_window[0] = (fw_mask_window){dbu(w->id_at.x - m), y0, between, y1};
    w->id_window[1] =
        (fw_mask_window){between, y0, dbu(w->id_at.x + line_width(all, stroke) + m), y1};
}

static fw_status letter(fw_wafer_maker *m, size_t letters) {
    const fw_wafer_grid *g = &m->wafer->grid;
    double stroke = m->wafer->stroke_m, field = line_width(letters, stroke);
    for (int start = 0, end; start < g->nsite; start = end) {
        for (end = start; end < g->nsite && g->site[end].row == g->site[start].row;)
            end++;
        FW_TRY(add_row(m, start, end, field));
    }
    int *at = fw_arena_array(m->arena, int, (size_t)g->rows *(size_t)g->columns);
    FW_NEED(at);
    for (int i = 0; i < g->rows * g->columns; i++)
        at[i] = -1;
    for (int i = 0; i < g->nsite; i++)
        if (g->site[i].kind == FW_WAFER_DIE) at[g->site[i].column * g->rows + g->site[i].row] = i;
    for (int c = 0; c < g->columns; c++)
        FW_TRY(add_column(m, at + c * g->rows, c, field + APART * stroke));
    return FW_OK;
}

fw_status fw_wafer_ids(fw_wafer_maker *m) {
    fw_wafer *w = m->wafer;
    const fw_wafer_grid *g = &w->grid;
    if (!fw_wafer_draws(w->table, FW_ROLE_TEXT)) return FW_OK;
    die *d = fw_arena_array(m->arena, die, (size_t)w->nvariant + 1);
    FW_NEED(d);
    int n = 0;
    bool stand_in = false;
    for (int i = 0; i < w->nvariant; i++) {
        const fw_wafer_variant *v = &w->variant[i];
        stand_in = stand_in || (!v->mask && v->dies > 0);
        if (v->mask && v->dies > 0) FW_TRY(die_of(m, v->mask, v->die, v->window, &d[n++]));
    }
    const fw_wafer_variant *other = &m->input->stand_in;
    if (stand_in) FW_TRY(die_of(m, other->mask, other->die, other->window, &d[n++]));
    char text[FW_WAFER_NAME];
    size_t letters = strlen(fw_wafer_row_name(g->rows - 1, text));
    size_t all = letters + strlen(fw_wafer_column_name(g, g->columns - 1, text));
    double least = rule(w->table);
    for (double stroke = fmax(LARGEST_STROKE_M, least); n > 0 && stroke > least - 0.5e-6;
         stroke -= 1e-6) {
        w->stroke_m = fw_layout_to_grid(stroke);
        w->ids = find_place(d, n, line_width(all, w->stroke_m), HIGH * w->stroke_m, &w->id_at);
        if (w->ids) {
            set_windows(w, letters, all);
            return letter(m, letters);
        }
    }
    if (n > 0)
        fw_diag_warning(m->diags, 193, w->device->wafer.place,
                        "<wafer>: the frame has no free place for die ids that all dies share, "
                        "so that only the map shows them; a wider frame provides one");
    return FW_OK;
}
