/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From devices and what <wafer> asks for to places, cells and arrays. */
#include "wafer/wafer.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* a device that is not placed counts too: it could be laid out, and the number of dies must not
   hang on what is found out about it later. Without any outline its size is 0. */
static void enlarge(const fw_wafer_variant *v, double *width, double *height) {
    *width = fmax(*width, v->die.x1 - v->die.x0);
    *height = fmax(*height, v->die.y1 - v->die.y0);
}

/* farthest scale of a plate */
static double largest_scale(const fw_wafer *w) {
    double most = 0;
    for (int p = 0; p < fw_mask_plates(w->table); p++)
        most = fmax(most,
                    fw_device_order_of(&w->device->wafer, fw_mask_plate_at(w->table, p).id)->scale);
    return most;
}

/* one die about the plate's middle */
static fw_status single_place(fw_wafer_maker *m, int32_t width, int32_t height) {
    fw_wafer *w = m->wafer;
    fw_wafer_site *site = fw_arena_one(m->arena, fw_wafer_site);
    FW_NEED(site);
    *site = (fw_wafer_site){.x = -(width / 2), .y = -(height / 2), .kind = FW_WAFER_DIE};
    w->grid = (fw_wafer_grid){.width = width,
                              .height = height,
                              .pitch_x = width,
                              .pitch_y = height,
                              .rows = 1,
                              .columns = 1,
                              .site = site,
                              .nsite = 1};
    double reach_m = 1e-9 * hypot(width, height) * largest_scale(w);
    return fw_wafer_form_single(&w->device->wafer, reach_m, m->diags, &w->form);
}

/* scaled, the dies stay clear of title and crosses */
static fw_status check_scale(fw_wafer_maker *m) {
    const fw_wafer *w = m->wafer;
    double reach_m = 0, free_m = 0.5 * w->form.diameter_m + 1e-3;
    for (int i = 0; i < w->grid.nsite && !w->single; i++) {
        const fw_wafer_site *s = &w->grid.site[i];
        double x = fmax(fabs((double)s->x), fabs((double)s->x + w->grid.width));
        double y = fmax(fabs((double)s->y), fabs((double)s->y + w->grid.height));
        reach_m = fmax(reach_m, 1e-9 * hypot(x, y));
    }
    for (int p = 0; p < fw_mask_plates(w->table); p++) {
        const char *id = fw_mask_plate_at(w->table, p).id;
        const fw_device_order_asked *o = fw_device_order_of(&w->device->wafer, id);
        char times[32], to[32], from[32], most[32];
        if (o->scale * reach_m <= free_m) continue;
        return fw_diag_error(
            m->diags, 551, o->place,
            "<order>: scaled by %s, dies of plate \"%s\" reach %s mm from its middle, and its "
            "title "
            "begins at %s mm; a scale of at most %s is left, or remove <wafer>: a plate of one die "
            "takes any",
            fw_number_text(times, sizeof times, o->scale, 6), id,
            fw_number_text(to, sizeof to, o->scale * reach_m * 1e3, 4),
            fw_number_text(from, sizeof from, free_m * 1e3, 4),
            fw_number_text(most, sizeof most, floor(1e4 * free_m / reach_m) * 1e-4, 6));
    }
    return FW_OK;
}

/* a place holds the largest of the dies */
static fw_status fill_grid(fw_wafer_maker *m) {
    const fw_wafer_input *in = m->input;
    fw_wafer *w = m->wafer;
    double width = 0, height = 0;
    for (int i = 0; i < in->nvariant; i++)
        enlarge(&in->variant[i], &width, &height);
    enlarge(&in->stand_in, &width, &height);
    enlarge(&in->test, &width, &height);
    const fw_device_wafer_asked *asked = &in->device->wafer;
    int32_t x = (int32_t)ceil(width * 1e9 - 1e-3), y = (int32_t)ceil(height * 1e9 - 1e-3);
    if (in->single) return single_place(m, x, y);
    FW_TRY(fw_wafer_form_of(asked, m->diags, &w->form));
    FW_TRY(fw_wafer_grid_fill(m->arena, &w->form, asked, x, y, m->diags, &w->grid));
    return fw_wafer_assign(&w->form, asked, m->diags, &w->grid);
}

static void count(fw_wafer_maker *m) {
    fw_wafer *w = m->wafer;
    for (int i = 0; i < w->grid.nsite; i++) {
        const fw_wafer_site *s = &w->grid.site[i];
        w->dies += s->kind == FW_WAFER_DIE;
        w->alignments += s->kind == FW_WAFER_ALIGNMENT;
        w->tests += s->kind == FW_WAFER_TEST;
        if (s->variant >= 0) w->variant[s->variant].dies++;
    }
    int without = 0;
    for (int v = 0; v < w->nvariant; v++) {
        const fw_mask *mask = w->variant[v].mask ? w->variant[v].mask : m->input->stand_in.mask;
        without += w->variant[v].dies == 0;
        if (w->variant[v].dies > 0 && mask->rejected && !w->rejecting) w->rejecting = mask;
    }
    w->rejected = w->rejecting != NULL;
    if (without > 0)
        fw_diag_warning(
            m->diags, 195, w->device->wafer.place,
            "<wafer>: %d of %d steps of the sweeps get no die, because the wafer has only %d "
            "columns and %d rows of dies; ask for fewer steps, or make the pitch smaller",
            without, w->nvariant, w->grid.columns, w->grid.rows);
}

/* ---- spaces between neighbours ---- */

/* what a layer takes of a place, over all dies */
static void extend(const fw_wafer_maker *m, const fw_wafer_variant *v, int layer,
                   fw_geometry_box *box) {
    if (!v->mask) return;
    int32_t dx, dy;
    fw_wafer_origin(&m->wafer->grid, v->die, &dx, &dy);
    for (int i = 0; i < v->mask->nshape; i++) {
        if (v->mask->shape[i].layer != layer) continue;
        fw_geometry_box b = fw_geometry_contour_box(&v->mask->shape[i].contour);
        *box = (fw_geometry_box){fmin(box->x0, b.x0 + dx * 1e-9), fmin(box->y0, b.y0 + dy * 1e-9),
                                 fmax(box->x1, b.x1 + dx * 1e-9), fmax(box->y1, b.y1 + dy * 1e-9)};
    }
}

/* neighbours of one layer touch exactly or keep its rule */
static fw_status check_space(fw_wafer_maker *m, int layer, double space, const char *along) {
    const fw_mask_layer *l = &m->wafer->table->layer[layer];
    if (fabs(space) < 1.5e-9 || space >= l->min_space_m - 1e-12) return FW_OK;
    char have[32], need[32];
    return fw_diag_error(
        m->diags, 191, m->wafer->device->wafer.place,
        "<wafer>: along %s, polygons of layer %d/%d of neighbouring dies are %s um "
        "apart; the layer's rule is %s um; enlarge pitch-%s or the lane",
        along, l->layer, l->datatype, fw_number_text(have, sizeof have, space * 1e6, 6),
        fw_number_text(need, sizeof need, l->min_space_m * 1e6, 6), along);
}

static fw_status check_spaces(fw_wafer_maker *m) {
    const fw_wafer_input *in = m->input;
    const fw_wafer_grid *g = &m->wafer->grid;
    for (int k = 0; k < in->table->nlayer; k++) {
        fw_geometry_box b = {HUGE_VAL, HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
        for (int i = 0; i < in->nvariant; i++)
            extend(m, &in->variant[i], k, &b);
        extend(m, &in->stand_in, k, &b);
        extend(m, &in->test, k, &b);
        if (b.x1 < b.x0) continue;
        FW_TRY(check_space(m, k, g->pitch_x * 1e-9 - (b.x1 - b.x0), "x"));
        FW_TRY(check_space(m, k, g->pitch_y * 1e-9 - (b.y1 - b.y0), "y"));
    }
    return FW_OK;
}

/* ---- cells ---- */

static fw_status add_die(fw_wafer_maker *m, fw_wafer_cell_kind kind, const fw_wafer_variant *v,
                         const char *suffix, int *cell) {
    const char *own = v->mask->cell, *name = own;
    int32_t dx, dy;
    if (*suffix)
        FW_NEED(name = fw_arena_printf(m->arena, "%.*s%s",
                                       FW_WAFER_LONGEST_NAME - (int)strlen(suffix), own, suffix));
    fw_wafer_origin(&m->wafer->grid, v->die, &dx, &dy);
    FW_TRY(fw_wafer_add_cell(m, name, v->mask, dx, dy, cell));
    m->wafer->cell[*cell].kind = kind;
    return FW_OK;
}

/* cell per variant that has dies; those without a mask share that of the stand-in */
static fw_status add_dies(fw_wafer_maker *m, int *of_variant) {
    fw_wafer *w = m->wafer;
    int stand_in = -1;
    for (int v = 0; v < w->nvariant; v++) {
        char suffix[16] = "";
        of_variant[v] = -1;
        if (w->variant[v].dies == 0) continue;
        if (w->nvariant > 1) snprintf(suffix, sizeof suffix, "_V%d", v + 1);
        if (w->variant[v].mask) {
            FW_TRY(add_die(m, FW_WAFER_CELL_DIE, &w->variant[v], suffix, &of_variant[v]));
            continue;
        }
        if (stand_in < 0)
            FW_TRY(add_die(m, FW_WAFER_CELL_DIE, &m->input->stand_in, "_NOMINAL", &stand_in));
        of_variant[v] = stand_in;
    }
    return FW_OK;
}

static fw_status place(fw_wafer_maker *m) {
    fw_wafer *w = m->wafer;
    int marks = -1, test = -1;
    int *of_variant = fw_arena_array(m->arena, int, (size_t)w->nvariant);
    int *of_site = fw_arena_array(m->arena, int, (size_t)w->grid.nsite);
    FW_NEED(of_variant && of_site ? of_site : NULL);
    FW_TRY(add_dies(m, of_variant));
    bool own_test = m->input->test.mask;
    if (w->alignments > 0 || (w->tests > 0 && !own_test)) {
        const fw_mask *mask;
        FW_TRY(fw_wafer_alignment_mask(m, &mask));
        if (mask) FW_TRY(fw_wafer_add_cell(m, "ALIGNMENT_SITE", mask, 0, 0, &marks));
    }
    if (w->tests > 0 && own_test)
        FW_TRY(add_die(m, FW_WAFER_CELL_OTHER, &m->input->test, "", &test));
    for (int i = 0; i < w->grid.nsite; i++) {
        const fw_wafer_site *s = &w->grid.site[i];
        of_site[i] = s->kind == FW_WAFER_DIE                ? of_variant[s->variant]
                     : s->kind == FW_WAFER_TEST && own_test ? test
                                                            : marks;
    }
    FW_TRY(fw_wafer_add_rows(m, of_site));
    return w->single ? FW_OK : fw_wafer_ids(m);
}

/* name of the top cell: that of the device and what it is */
static fw_status name_top(fw_wafer_maker *m) {
    fw_wafer *w = m->wafer;
    const char *tail = w->single     ? (w->rejected ? "_PLATE_REJECTED" : "_PLATE")
                       : w->rejected ? "_WAFER_REJECTED"
                                     : "_WAFER";
    char *top = fw_arena_printf(m->arena, "%.*s%s", FW_WAFER_LONGEST_NAME - (int)strlen(tail),
                                w->device->name, tail);
    FW_NEED(top);
    for (char *s = top; *s; s++) {
        bool letter = (*s >= 'A' && *s <= 'Z') || (*s >= 'a' && *s <= 'z');
        if (!letter && !(*s >= '0' && *s <= '9') && *s != '_') *s = '_';
    }
    w->top = top;
    return FW_OK;
}

fw_status fw_wafer_build(fw_arena *arena, const fw_wafer_input *input, fw_diags *diags,
                         const fw_wafer **wafer) {
    const fw_device *d = input->device;
    fw_wafer *w = fw_arena_one(arena, fw_wafer);
    FW_NEED(w);
    fw_wafer_maker m = {.arena = arena, .input = input, .diags = diags, .wafer = w};
    const char *title = d->wafer.title ? d->wafer.title : d->die.title ? d->die.title : d->name;
    *w = (fw_wafer){.device = d,
                    .table = input->table,
                    .nvariant = input->nvariant,
                    .stand_in = input->stand_in,
                    .effect = input->effect,
                    .overlay_m = input->overlay_m,
                    .single = input->single,
                    .title = title,
                    .flow = input->table->flow};
    FW_NEED(w->variant = fw_arena_array(arena, fw_wafer_variant, (size_t)input->nvariant));
    for (int i = 0; i < input->nvariant; i++)
        w->variant[i] = input->variant[i];
    FW_TRY(fill_grid(&m));
    count(&m);
    FW_TRY(check_scale(&m));
    if (!w->single) FW_TRY(check_spaces(&m));
    FW_TRY(name_top(&m));
    FW_TRY(place(&m));
    FW_TRY(fw_wafer_plate(&m));
    if (diags->failed) return FW_NOMEM;
    *wafer = w;
    return FW_OK;
}
