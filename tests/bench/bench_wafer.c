/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The wafer that other tools were measured with: 517 dies of 3 mm on a pitch of 3.5 mm inside a
   circle of 94 mm, each of 60 arc hinges and a frame. Rows: CPU ms and bytes of laying it out
   (places, cells, ids, plate), of each file, and of all together; everything but making the one
   die's mask. */
#include "layout/layout.h"
#include "measure.h"
#include "wafer/wafer.h"

enum { HINGES = 60, ROW = 8 };
static const double UM_ = 1e-6;

typedef struct work {
    fw_arena *arena;
    fw_diags diags;
    fw_mask_layer layer[4];
    fw_mask_table table;
    fw_device device;
    fw_wafer_variant variant;
    fw_wafer_input input;
    const fw_wafer *wafer; /* of the last run */
    int what;
    size_t bytes;
} work;

static fw_mask_layer layer_of(int number, const char *id, unsigned roles) {
    return (fw_mask_layer){.layer = number,
                           .id = id,
                           .name = id,
                           .purpose = "bench",
                           .tone = "data dark",
                           .colour = "#3d6aa8",
                           .roles = roles,
                           .min_width_m = 4e-6,
                           .min_space_m = 4e-6};
}

typedef struct pieces {
    fw_layout_piece *piece;
    int count, capacity;
} pieces;

static int put(work *w, pieces *p, fw_layout_role role, fw_geometry_contour contour) {
    fw_layout_piece item = {role, FW_NONE - 1, FW_NONE, "piece", contour};
    return fw_layout_add(w->arena, item, &p->piece, &p->count, &p->capacity) == FW_OK;
}

static int bar(work *w, pieces *p, double x0, double y0, double x1, double y1) {
    fw_geometry_contour c;
    fw_geometry_box b = {x0 * UM_, y0 * UM_, x1 * UM_, y1 * UM_};
    return fw_geometry_contour_rectangle(w->arena, b, &c) == FW_OK && put(w, p, FW_ROLE_FRAME, c);
}

/* die of 3 mm: bars of a frame that stand apart, hinges in the window */
static int make_die(work *w) {
    pieces p = {0};
    if (!bar(w, &p, 50, 50, 2950, 400) || !bar(w, &p, 50, 2800, 2950, 2950)) return 0;
    for (int k = 0; k < HINGES; k++) {
        fw_geometry_contour c;
        fw_geometry_vec2 o = {(300 + 340 * (k % ROW)) * UM_, (580 + 290 * (k / ROW)) * UM_};
        double r = (50 + k) * UM_, t = 5 * UM_;
        if (fw_geometry_contour_ring_sector(w->arena, o, r - t, r + t, 0.3 * k, 3 + 0.02 * k, &c) !=
                FW_OK ||
            !put(w, &p, FW_ROLE_FLEXURE, c))
            return 0;
    }
    fw_layout layout = {.drawn = true, .piece = p.piece, .npiece = p.count};
    fw_mask_options options = {.tolerance_m = 3e-9};
    w->variant.die = (fw_geometry_box){0, 0, 3e-3, 3e-3};
    w->variant.window = (fw_geometry_box){400e-6, 400e-6, 2600e-6, 2800e-6};
    w->variant.decision = "accept";
    return fw_mask_build(w->arena, &layout, &w->table, "die", &options, &w->diags,
                         &w->variant.mask) == FW_OK;
}

static fw_status write(work *w, fw_status (*writer)(const fw_wafer *, fw_text *)) {
    fw_text out = fw_text_new(w->arena);
    FW_TRY(writer(w->wafer, &out));
    w->bytes += out.length;
    return FW_OK;
}

static fw_status json(const fw_wafer *wafer, fw_text *out) {
    return fw_wafer_write_json(wafer, "", out);
}

static fw_status svg(const fw_wafer *wafer, fw_text *out) {
    const fw_mask_format *format = fw_mask_format_at(0);
    for (size_t i = 0; format && format->plate != fw_mask_plate_svg; i++)
        format = fw_mask_format_at(i);
    return fw_wafer_write_format(wafer, format, out);
}

static fw_status (*const writer[])(const fw_wafer *, fw_text *) = {
    fw_wafer_write_gds, svg, fw_wafer_write_csv, fw_wafer_write_map, json};
enum { WRITERS = sizeof writer / sizeof writer[0], LAYOUT = WRITERS, ALL };

static fw_status run(work *w) {
    w->bytes = 0;
    if (w->what >= LAYOUT) FW_TRY(fw_wafer_build(w->arena, &w->input, &w->diags, &w->wafer));
    for (int i = 0; i < WRITERS; i++)
        if (w->what == i || w->what == ALL) FW_TRY(write(w, writer[i]));
    return FW_OK;
}

static outcome once(void *context) {
    work *w = context;
    const fw_wafer *keep = w->wafer;
    fw_mark before = fw_arena_mark(w->arena);
    double start = cpu_seconds();
    fw_status status = run(w);
    outcome o = {.error = 0, .cpu_s = cpu_seconds() - start};
    if (status != FW_OK) o.failed = fw_status_text(status);
    fw_arena_rewind(w->arena, before);
    w->wafer = keep;
    return o;
}

int main(void) {
    static const char *const name[] = {"gds", "svg", "csv", "map", "json", "layout", "all"};
    double none = (double)NAN;
    work w = {.arena = fw_arena_new(0)};
    if (!w.arena) return 1;
    w.diags = fw_diags_new(w.arena);
    w.layer[0] = layer_of(1, "device", 0xf);
    w.layer[1] = layer_of(2, "text", 1u << FW_ROLE_TEXT);
    w.layer[2] = layer_of(3, "marks", 1u << FW_ROLE_MARK);
    w.layer[3] = (fw_mask_layer){.layer = 63,
                                 .id = "notes",
                                 .name = "notes",
                                 .purpose = "notes",
                                 .tone = "data dark",
                                 .colour = "#000000",
                                 .documentation = true};
    w.table = (fw_mask_table){
        .flow = "bench", .reading = "right-reading chrome down", .layer = w.layer, .nlayer = 4};
    w.device = (fw_device){.name = "bench",
                           .wafer = {.asked = true,
                                     .diameter_m = 0.1,
                                     .edge_m = 3e-3,
                                     .pitch_x_m = 3.5e-3,
                                     .pitch_y_m = 3.5e-3,
                                     .centre = FW_CENTRE_DIE,
                                     .plate_m = none}};
    if (!make_die(&w)) return 1;
    w.input = (fw_wafer_input){.device = &w.device,
                               .table = &w.table,
                               .variant = &w.variant,
                               .nvariant = 1,
                               .stand_in = w.variant,
                               .mask = {.tolerance_m = 3e-9}};
    if (fw_wafer_build(w.arena, &w.input, &w.diags, &w.wafer) != FW_OK) return 1;
    int vertices = 0;
    for (int i = 0; i < w.variant.mask->nshape; i++)
        vertices += w.variant.mask->shape[i].polygon.count;
    printf("# %d dies, %d vertices each, %d cells, %d arrays, ids %s\nwhat,cpu_ms,bytes\n",
           w.wafer->dies, vertices, w.wafer->ncell, w.wafer->nrun, w.wafer->ids ? "yes" : "no");
    for (w.what = 0; w.what <= ALL; w.what++) {
        outcome o = measure(once, &w);
        printf("%s,%.4g,%zu%s%s\n", name[w.what], 1e3 * o.cpu_s, w.bytes, o.failed ? "," : "",
               o.failed ? o.failed : "");
    }
    fw_arena_free(w.arena);
    return 0;
}
