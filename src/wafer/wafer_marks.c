/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What lies on the plate besides dies: title and identification beside the wafer, a fiducial in
   each corner of the plate, and the cell of an alignment site. All are pieces like those of a die,
   so that bias, rules and flattening are those of the flow.

   Beside the wafer nothing carries lettering, so its strokes are drawn on the layer of the frame, and
   those of plates that do not draw it on the first layer of theirs: the plate's tone then makes them
   readable. Within a place the cross is cut out of a block of that
   layer, as the crosses of a die are cut out of its frame. */
#include "layout/layout.h"
#include "geometry/segment.h"
#include "wafer/wafer.h"
#include <math.h>
#include <string.h>

/* ---- a text as bars and gaps ----
   Code 39, two widths of them. A sign is five bars with four gaps between
   them. Which of the five bars are wide is one of ten patterns; which gap is wide tells four groups of
   ten signs apart; four signs more have narrow bars and three wide gaps. A narrow gap stands between
   signs, and the sign * before and behind the text. A reader takes it in either direction, so a mirror
   image, too.
   In: a text of A to Z, 0 to 9, space and - . $ / + %. Out: elements from the first bar on, bar and gap
   in turn. Source: ISO/IEC 16388 (Code 39). Test: test_wafer_build.c, by a table of all signs. */

enum { BARS = 5, PATTERNS = 10 };
static const char bars[PATTERNS][BARS + 1] = {"10001", "01001", "11000", "00101", "10100",
                                              "01100", "00011", "10010", "01010", "00110"};
static const struct {
    const char *signs; /* in the order of the patterns of bars */
    const char *gaps;
} group[] = {
    {"1234567890", "0100"}, {"ABCDEFGHIJ", "0010"}, {"KLMNOPQRST", "0001"}, {"UVWXYZ-. *", "1000"}};
static const char odd[] = "$/+%"; /* which gap of theirs is narrow: the last one first */

static bool wide(char sign, int element) {
    const char *at = strchr(odd, sign);
    if (at) return element % 2 && element / 2 != 3 - (int)(at - odd);
    for (size_t k = 0; k < sizeof group / sizeof group[0]; k++) {
        const char *found = strchr(group[k].signs, sign);
        if (!found) continue;
        return (element % 2 ? group[k].gaps[element / 2]
                            : bars[found - group[k].signs][element / 2]) == '1';
    }
    return false; /* the reader of files lets no other sign pass */
}

static fw_status barcode(fw_arena *arena, const char *text, bool **element, int *n) {
    int length = (int)strlen(text) + 2;
    *n = 0;
    FW_NEED(*element = fw_arena_array(arena, bool, (size_t)length * 10));
    for (int i = 0; i < length; i++) {
        char sign = '*';
        if (i > 0 && i < length - 1) sign = text[i - 1];
        for (int k = 0; k < 9; k++)
            (*element)[(*n)++] = wide(sign, k);
        if (i + 1 < length) (*element)[(*n)++] = false;
    }
    return FW_OK;
}

/* ---- marks and lettering ---- */

static const double RIM_M = 5e-3;                    /* of the plate, kept free: it is held there */
static const double BESIDE_M = 1e-3;                 /* from the wafer's edge to lettering */
static const double ARM_M = 1.5e-3, HALF_M = 0.1e-3; /* of a fiducial */
static const double LARGEST_STROKE_M = 300e-6, LEAST_STROKE_M = 50e-6;
enum { HIGH = 9 };
/* of a Code 39: bars that hand readers take; a line that is seen without a microscope */
static const double LARGEST_BAR_M = 250e-6, LEAST_BAR_M = 100e-6, LEAST_BARS_M = 2e-3,
                    MOST_BARS_M = 8e-3, FLAT_LINE_M = 200e-6;
enum { WIDE_BAR = 3 };

bool fw_wafer_draws(const fw_mask_table *table, fw_layout_role role) {
    for (int k = 0; k < table->nlayer; k++)
        if (table->layer[k].roles & 1u << role) return true;
    return false;
}

static fw_status sheet_add(fw_wafer_sheet *sheet, fw_layout_role role, const char *label,
                           const fw_geometry_vec2 *point, int n) {
    fw_arena *arena = sheet->maker->arena;
    fw_geometry_outline outline = {0};
    for (int i = 0; i < n; i++) {
        fw_geometry_vec2 at = {fw_layout_to_grid(point[i].x), fw_layout_to_grid(point[i].y)};
        if (i == 0)
            outline = fw_geometry_outline_start(arena, at);
        else
            fw_geometry_outline_line(&outline, at, 0);
    }
    fw_layout_piece item = {.role = role, .body = FW_NONE - 1, .joint = FW_NONE, .label = label};
    FW_TRY(fw_geometry_outline_close(&outline, &item.contour));
    return fw_layout_add(arena, item, &sheet->piece, &sheet->npiece, &sheet->capacity);
}

fw_status fw_wafer_sheet_mask(fw_wafer_sheet *sheet, const char *name, bool as_read,
                              const fw_mask **mask) {
    fw_wafer_maker *m = sheet->maker;
    fw_mask_options options = m->input->mask;
    options.rejected = false; /* the device's own cells and the library say it */
    options.note = NULL;
    options.nnote = 0;
    options.no_islands = false;
    if (as_read) options.layer_bias_m = NULL;
    fw_layout layout = {.drawn = true,
                        .piece = sheet->piece,
                        .npiece = sheet->npiece,
                        .cell = sheet->cell,
                        .ncell = sheet->ncell};
    /* such a cell is a part of a picture: what relates layers to each other holds where it lies */
    fw_mask_table *alone = fw_arena_one(m->arena, fw_mask_table);
    FW_NEED(alone);
    *alone = *m->input->table;
    alone->rule = NULL;
    alone->nrule = 0;
    return fw_mask_build(m->arena, &layout, alone, name, &options, m->diags, mask);
}

static fw_status add_cross(fw_wafer_sheet *s, fw_layout_role role, fw_geometry_vec2 o, double a,
                           double w) {
    const fw_geometry_vec2 p[] = {{o.x + w, o.y - w}, {o.x + a, o.y - w}, {o.x + a, o.y + w},
                                  {o.x + w, o.y + w}, {o.x + w, o.y + a}, {o.x - w, o.y + a},
                                  {o.x - w, o.y + w}, {o.x - a, o.y + w}, {o.x - a, o.y - w},
                                  {o.x - w, o.y - w}, {o.x - w, o.y - a}, {o.x + w, o.y - a}};
    return sheet_add(s, role, "cross", p, sizeof p / sizeof p[0]);
}

/* one line in the middle of a strip, in strokes that let it fit; false in *fits: even the least do
   not, and then it ends in '+'. *shown: what is drawn; NULL: nothing */
static fw_status add_line(fw_wafer_sheet *s, const char *text, double middle, double band,
                          double length, bool *fits, const char **shown) {
    fw_arena *arena = s->maker->arena;
    double stroke = fmin(LARGEST_STROKE_M, floor(band / HIGH * 1e6) * 1e-6);
    *fits = stroke >= LEAST_STROKE_M, *shown = NULL;
    if (!*fits) return FW_OK;
    while (stroke > LEAST_STROKE_M && fw_layout_text_width(text, HIGH * stroke, stroke) > length)
        stroke -= 10e-6;
    stroke = fw_layout_to_grid(stroke);
    FW_TRY(fw_layout_text_fit(arena, text, HIGH * stroke, stroke, length, shown));
    *fits = strcmp(*shown, text) == 0;
    double width = fw_layout_text_width(*shown, HIGH * stroke, stroke);
    return fw_layout_text(
        arena, *shown, (fw_geometry_vec2){-0.5 * width, middle - 0.5 * HIGH * stroke},
        HIGH * stroke, stroke, s->role, "plate text", &s->piece, &s->npiece, &s->capacity);
}

/* a bar along x, from (x0, y0) to (x1, y1) */
static fw_status add_bar(fw_wafer_sheet *s, const char *label, double x0, double y0, double x1,
                         double y1) {
    const fw_geometry_vec2 p[] = {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
    return sheet_add(s, s->role, label, p, 4);
}

/* Code 39 in the strip left of the wafer, read upwards: bars lie along x. A wide bar or gap is three
   narrow ones, as readers take it best; narrow is what lets it fit, 0.25 mm at most. */
static fw_status add_barcode(fw_wafer_sheet *s, const char *text, double inner, double outer,
                             double length, bool *fits) {
    bool *wide;
    int n, units = 0;
    FW_TRY(barcode(s->maker->arena, text, &wide, &n));
    for (int i = 0; i < n; i++)
        units += wide[i] ? WIDE_BAR : 1;
    double narrow = fmin(LARGEST_BAR_M, floor(length / units * 1e6) * 1e-6);
    *fits = narrow >= LEAST_BAR_M && outer - inner >= LEAST_BARS_M;
    if (!*fits) return FW_OK;
    double y = -0.5 * units * narrow, far = fmin(outer, inner + MOST_BARS_M);
    for (int i = 0; i < n; i++) {
        double next = y + (wide[i] ? WIDE_BAR : 1) * narrow;
        if (i % 2 == 0) FW_TRY(add_bar(s, "barcode", -far, y, -inner, next));
        y = next;
    }
    return FW_OK;
}

/* its inner edge is the flat of the wafer as the plate has it, scaled as the dies are: as long as that, behind it. *fits: it ends
   before the lettering begins */
static fw_status add_flat_line(fw_wafer_sheet *s, const fw_wafer_form *form, double scale,
                               bool *fits) {
    double half = 0.5 * scale * form->flat_m, r = 0.5 * scale * form->diameter_m;
    double away = sqrt(r * r - half * half), beyond = away + FLAT_LINE_M;
    *fits =
        beyond < 0.5 * form->diameter_m + BESIDE_M; /* title and barcode stand beyond that square */
    if (!*fits) return FW_OK;
    switch (form->side) {
    case FW_SIDE_BOTTOM:
        return add_bar(s, "flat line", -half, -beyond, half, -away);
    case FW_SIDE_TOP:
        return add_bar(s, "flat line", -half, away, half, beyond);
    case FW_SIDE_LEFT:
        return add_bar(s, "flat line", -beyond, -half, -away, half);
    case FW_SIDE_RIGHT:
        return add_bar(s, "flat line", away, -half, beyond, half);
    }
    return FW_OK;
}

/* of lettering on a plate: the frame's, or that of its first layer; false: it draws nothing */
static bool role_on(const fw_mask_table *table, int plate, fw_layout_role *role) {
    int first = -1;
    const char *wrong, *layers = fw_mask_plate_at(table, plate).layers;
    if (layers && !fw_mask_plate_layers(table, layers, NULL, &first, &wrong)) return false;
    for (int k = 0; k < table->nlayer; k++)
        if (table->layer[k].roles & 1u << FW_ROLE_FRAME &&
            (!layers || fw_mask_plate_draws(table, plate, k))) {
            *role = FW_ROLE_FRAME;
            return true;
        }
    for (int r = 0; first >= 0 && r < FW_ROLE_COUNT; r++)
        if (table->layer[first].roles & 1u << r) {
            *role = (fw_layout_role)r;
            return true;
        }
    return false;
}

static const char *identification(fw_wafer_maker *m, int plate, fw_layout_role role) {
    const fw_mask_table *t = m->input->table;
    bool several = fw_mask_plates(t) > 1;
    const char *tone = "";
    for (int k = 0; k < t->nlayer; k++)
        if (t->layer[k].roles & 1u << role) tone = t->layer[k].tone ? t->layer[k].tone : "";
    if (fw_device_order_of(&m->wafer->device->wafer, fw_mask_plate_at(t, plate).id)->inverted)
        tone = strcmp(tone, "data dark") == 0 ? "data clear" : "data dark";
    return fw_arena_printf(m->arena, "%s%s%s  %s  %s  FLEXWRIGHT " FW_VERSION, t->flow,
                           several ? "  " : "", several ? fw_mask_plate_at(t, plate).id : "", tone,
                           fw_mask_plate_at(t, plate).reading);
}

/* "COMB STAGE  2/3 PADS" */
static const char *title_on(fw_wafer_maker *m, int plate) {
    const fw_wafer *w = m->wafer;
    const char *id = fw_mask_plate_at(w->table, plate).id, *dead = w->rejected ? "REJECTED  " : "";
    /* of the die, which is checked, or the name, of which the die's drawing says that it cannot be */
    const char *own = fw_layout_text_lacks(w->title) ? "" : w->title;
    if (fw_mask_plates(w->table) < 2) return fw_arena_printf(m->arena, "%s%s", dead, own);
    return fw_arena_printf(m->arena, "%s%s  %d/%d %s", dead, own, plate + 1,
                           fw_mask_plates(w->table), fw_layout_text_lacks(id) ? "" : id);
}

/* crosses, title, identification and what is ordered, on one plate of the flow */
static fw_status draw_plate(fw_wafer_maker *m, fw_wafer_sheet *s, int plate, bool *whole,
                            fw_wafer_beside *drawn) {
    fw_wafer *w = m->wafer;
    if (!role_on(m->input->table, plate, &s->role)) return FW_OK;
    double half = 0.5 * w->form.plate_m, corner = half - RIM_M - ARM_M;
    w->fiducial_m = corner;
    for (int k = 0; k < 4; k++)
        FW_TRY(add_cross(s, s->role,
                         (fw_geometry_vec2){k % 2 ? corner : -corner, k / 2 ? corner : -corner},
                         ARM_M, HALF_M));
    double inner = 0.5 * w->form.diameter_m + BESIDE_M, outer = half - RIM_M;
    double length = 2 * (corner - ARM_M - BESIDE_M);
    const char *title = title_on(m, plate), *line = identification(m, plate, s->role);
    FW_NEED(title && line ? title : NULL);
    bool above, below, beside = true;
    FW_TRY(add_line(s, title, 0.5 * (inner + outer), outer - inner, length, &above, &drawn->title));
    FW_TRY(add_line(s, line, -0.5 * (inner + outer), outer - inner, length, &below, &drawn->line));
    const fw_device_order_asked *order =
        fw_device_order_of(&w->device->wafer, fw_mask_plate_at(w->table, plate).id);
    if (order->barcode) /* title and identification stand beyond it */
        FW_TRY(add_barcode(s, order->barcode, inner, outer, 2 * inner, &beside));
    drawn->barcode = beside ? order->barcode : NULL;
    if (order->flat_line && w->form.flat_m > 0)
        FW_TRY(add_flat_line(s, &w->form, order->scale, &drawn->flat_line));
    if (order->flat_line && w->form.flat_m > 0 && !drawn->flat_line)
        fw_diag_warning(
            m->diags, 195, order->place,
            "<order>: the flat line is where the flat of the scaled wafer lies, in the "
            "ring of title and barcode, and is left out; a smaller scale leaves it room");
    if (!beside)
        fw_diag_warning(
            m->diags, 195, order->place,
            "<order>: the barcode does not fit beside the wafer with bars of 0.1 mm, and "
            "is left out; shorten it, or state a larger plate");
    *whole = *whole && above && below;
    return FW_OK;
}

/* does a box lie on the plate, and beside every place of a die? */
static bool is_beside(const fw_wafer *w, fw_geometry_box b) {
    const double half = 0.5 * w->form.plate_m;
    bool beside = b.x0 >= -half && b.y0 >= -half && b.x1 <= half && b.y1 <= half;
    for (int i = 0; i < w->grid.nsite && beside; i++) {
        const fw_wafer_site *s = &w->grid.site[i];
        fw_geometry_box place = {s->x * 1e-9, s->y * 1e-9, (s->x + (double)w->grid.width) * 1e-9,
                                 (s->y + (double)w->grid.height) * 1e-9};
        beside = fw_box_gap(b, place) > 0;
    }
    return beside;
}

/* drawings of the description that stand beside the dies */
static fw_status add_cells(fw_wafer_sheet *s) {
    fw_wafer_maker *m = s->maker;
    const fw_device_wafer_asked *asked = &m->wafer->device->wafer;
    fw_layout sheet = {.piece = s->piece, .npiece = s->npiece};
    fw_status status = FW_OK;
    FW_TRY(fw_layout_cells_add(m->arena, asked->cell, asked->ncell, &sheet, &s->capacity));
    s->piece = sheet.piece, s->npiece = sheet.npiece;
    s->cell = sheet.cell, s->ncell = sheet.ncell;
    for (int i = 0; i < sheet.ncell; i++)
        for (int k = 0; k < sheet.npiece; k++) {
            if (sheet.piece[k].label != sheet.cell[i].label) continue;
            fw_geometry_box b = fw_geometry_contour_box(&sheet.piece[k].contour);
            char x[32], y[32];
            if (is_beside(m->wafer, b)) continue;
            status = fw_diag_error(
                m->diags, 571, sheet.cell[i].of->place,
                "<wafer>: %s lies on the place of a die or leaves the plate near (%s, %s) mm from "
                "its middle; move it to where the wafer map has nothing, or put it on the die",
                sheet.cell[i].label, fw_number_text(x, sizeof x, b.x0 * 1e3, 6),
                fw_number_text(y, sizeof y, b.y0 * 1e3, 6));
            break;
        }
    return status;
}

static const double LEAST_M2 = 1e-15; /* rounding of areas over a wafer is less by far */

static const fw_layout_cell *cell_of(const fw_wafer *w, const fw_mask_shape *shape) {
    for (int i = 0; i < w->plate->nplaced; i++)
        if (w->plate->placed[i].label == shape->piece->label) return &w->plate->placed[i];
    return NULL;
}

fw_status fw_wafer_cells_on(fw_arena *arena, const fw_wafer *w, const bool **on) {
    const fw_mask *plate = w->plate;
    bool *list = fw_arena_array(arena, bool, (size_t)plate->nshape + 1);
    const fw_device_cell **cell =
        fw_arena_array(arena, const fw_device_cell *, (size_t)plate->nplaced + 1);
    int n = 0;
    FW_NEED(list && cell ? list : NULL);
    *on = list;
    for (int pass = 0; pass < 2 && plate->nplaced > 0; pass++)
        for (int i = 0; i < plate->nshape; i++) {
            const fw_layout_cell *own = cell_of(w, &plate->shape[i]);
            bool known = false;
            for (int k = 0; k < n && own; k++)
                known = known || cell[k] == own->of;
            list[i] = known;
            if (own && !known && n < plate->nplaced &&
                fw_wafer_area_over(&w->form, &plate->shape[i].polygon) > LEAST_M2)
                cell[n++] = own->of;
        }
    return FW_OK;
}

static double reach_of(fw_geometry_box b) {
    return hypot(fmax(fabs(b.x0), fabs(b.x1)), fmax(fabs(b.y0), fabs(b.y1)));
}

/* Cells on the wafer are scaled with it, and then stay clear of the title, as dies do; those beyond it belong to the plate. */
static fw_status check_cells_scaled(fw_wafer_maker *m, const fw_device_order_asked *order) {
    const fw_wafer *w = m->wafer;
    const double free_m = 0.5 * w->form.diameter_m + BESIDE_M;
    const bool *on;
    char times[32], to[32], from[32];
    fw_number_text(times, sizeof times, order->scale, 6);
    FW_TRY(fw_wafer_cells_on(m->arena, w, &on));
    for (int i = 0; i < w->plate->nshape && order->scale != 1; i++) {
        const fw_mask_shape *s = &w->plate->shape[i];
        const fw_layout_cell *cell = cell_of(w, s);
        if (!cell) continue;
        const double reach_m = order->scale * reach_of(s->box);
        if (!on[i]) {
            if (!fw_diag_said(m->diags, 704, cell->of->place))
                fw_diag_warning(m->diags, 704, cell->of->place,
                                "<wafer>: %s lies beyond the wafer, as title and crosses do: where "
                                "<order> scales by %s what lies on the wafer, it stays as it is",
                                cell->label, times);
        } else if (order->scale > 1 && reach_m > free_m)
            return fw_diag_error(
                m->diags, 551, order->place,
                "<order>: scaled by %s, %s of <wafer> reaches %s mm from the plate's middle, and "
                "its title begins at %s mm; a smaller scale, or the cell nearer to the middle",
                times, cell->label, fw_number_text(to, sizeof to, reach_m * 1e3, 4),
                fw_number_text(from, sizeof from, free_m * 1e3, 4));
    }
    return FW_OK;
}

fw_status fw_wafer_plate(fw_wafer_maker *m) {
    fw_wafer *w = m->wafer;
    if (!fw_wafer_draws(m->input->table, FW_ROLE_FRAME)) return FW_OK;
    fw_wafer_sheet s = {.maker = m};
    bool whole = true;
    const fw_device_wafer_asked *stated = &w->device->wafer;
    if (stated->title)
        FW_TRY(fw_layout_text_check(stated->title, "<wafer>: the title", stated->place, m->diags));
    fw_wafer_beside *drawn =
        fw_arena_array(m->arena, fw_wafer_beside, (size_t)fw_mask_plates(w->table));
    FW_NEED(w->beside = drawn);
    for (int p = 0; p < fw_mask_plates(w->table); p++)
        FW_TRY(draw_plate(m, &s, p, &whole, &drawn[p]));
    FW_TRY(add_cells(&s));
    if (!whole)
        fw_diag_warning(
            m->diags, 195, w->device->wafer.place,
            "<wafer>: the title of the plate does not fit whole beside the wafer, where "
            "it is cut or left out; shorten it");
    FW_TRY(fw_wafer_sheet_mask(&s, "PLATE", true, &w->plate));
    for (int p = 0; p < fw_mask_plates(w->table); p++)
        FW_TRY(check_cells_scaled(
            m, fw_device_order_of(&w->device->wafer, fw_mask_plate_at(w->table, p).id)));
    return FW_OK;
}

/* a block of 0.6 of the die, 2 mm at most, with a cross of five fine arms' lengths: coarse near the
   middle to be found, fine at the tips to be lined up */
static fw_status add_target(fw_wafer_sheet *s, fw_layout_role role, fw_geometry_vec2 o, double q) {
    fw_geometry_vec2 p[FW_LAYOUT_CROSS];
    fw_layout_cross(o, q, 3 * q, 0.3 * q, 5 * q, p);
    return sheet_add(s, role, "alignment site", p, FW_LAYOUT_CROSS);
}

/* sides of a site: 14 q, that is 0.6 of the die (fw_wafer_alignment_mask) */
static void say_no_room(const fw_wafer_sheet *s, const fw_layout_pattern *p, double mark_m,
                        double q) {
    char mark[32], room[32], die[32];
    if (fw_mask_plates(s->maker->input->table) < 2) return;
    fw_diag_warning(s->maker->diags, 620, s->maker->input->device->wafer.place,
                    "flow %s: marks %s, %s um wide, find no room on the alignment sites, %s um "
                    "between the arms of their "
                    "crosses: plates are put on each other by the marks on the frames alone; a die "
                    "of %s um by %s um has room",
                    s->maker->wafer->flow, p->id ? p->id : "",
                    fw_number_text(mark, sizeof mark, 1e6 * mark_m, 6),
                    fw_number_text(room, sizeof room, 5e6 * q, 6),
                    fw_number_text(die, sizeof die, ceil(1e6 * 14.0 * mark_m / (5.0 * 0.6)), 6),
                    die);
}

/* Where a flow aligns plates to each other: the window that its table has for the frame of a die, with
   the cross of the other side and bars of metal, in each quarter of the block where it has room. So two
   sites have of every pair of plates what a die has, at the wafer's rim. */
static fw_status add_pair_marks(fw_wafer_sheet *s, fw_geometry_vec2 o, double q) {
    const fw_mask_table *table = s->maker->input->table;
    const fw_mask_layer *frame = NULL;
    for (int k = 0; k < table->nlayer; k++)
        if (table->layer[k].roles & 1u << FW_ROLE_FRAME) frame = &table->layer[k];
    for (int i = 0; frame && i < table->npattern; i++) {
        fw_layout_coupon c;
        if (strcmp(table->pattern[i].kind->name, "frame-mark") != 0) continue;
        if (fw_mask_plate_of_role(table, FW_ROLE_BACK) < 0) continue;
        FW_TRY(fw_layout_pattern_draw(s->maker->arena, &table->pattern[i], frame->min_width_m,
                                      frame->min_space_m, 0, &c));
        /* between the arms, q wide, and the edge of the block */
        if (fmax(c.width_m, c.height_m) > 5 * q) {
            say_no_room(s, &table->pattern[i], fmax(c.width_m, c.height_m), q);
            continue;
        }
        for (int k = 0; k < 4; k++) {
            fw_geometry_vec2 at = {o.x + (k % 2 ? 4 * q : -4 * q) - 0.5 * c.width_m,
                                   o.y + (k / 2 ? 4 * q : -4 * q) - 0.5 * c.height_m};
            FW_TRY(
                fw_layout_coupon_put(s->maker->arena, &c, at, &s->piece, &s->npiece, &s->capacity));
        }
    }
    return FW_OK;
}

fw_status fw_wafer_alignment_mask(fw_wafer_maker *m, const fw_mask **mask) {
    const fw_wafer_grid *g = &m->wafer->grid;
    fw_wafer_sheet s = {.maker = m};
    bool cut = fw_wafer_draws(m->input->table, FW_ROLE_MARK);
    *mask = NULL;
    if (!fw_wafer_draws(m->input->table, FW_ROLE_FRAME)) return FW_OK;
    double width = g->width * 1e-9, height = g->height * 1e-9;
    double half = 0.5 * fmin(0.6 * fmin(width, height), 2e-3), q = half / 7;
    if (0.6 * q < 5e-6) return FW_OK; /* finer than is printed */
    fw_geometry_vec2 o = {0.5 * width, 0.5 * height};
    const fw_geometry_vec2 block[] = {{o.x - half, o.y - half},
                                      {o.x + half, o.y - half},
                                      {o.x + half, o.y + half},
                                      {o.x - half, o.y + half}};
    if (cut) FW_TRY(sheet_add(&s, FW_ROLE_FRAME, "alignment site", block, 4));
    FW_TRY(add_target(&s, cut ? FW_ROLE_MARK : FW_ROLE_FRAME, o, q));
    if (cut) FW_TRY(add_pair_marks(&s, o, q));
    return fw_wafer_sheet_mask(&s, "ALIGNMENT_SITE", false, mask);
}
