/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writing masks: 1000 arc hinges of 1000 vertices, all different (1e6 vertices on the 1 nm grid),
   in every format. Units of the rows: CPU ms, bytes. `hinges` are outlines of 2 arcs and 2 lines
   each, `chords` outlines of 1000 lines each: what a format makes of arcs, and its speed per
   vertex. */
#include "mask/mask.h"
#include "measure.h"

enum { HINGES = 1000, VERTICES = 1000, ROW = 40 };
static const double pitch_m = 400e-6, half_width_m = 5e-6;

static fw_geometry_vec2 place(int k) {
    return (fw_geometry_vec2){(k % ROW) * pitch_m, (k / ROW) * pitch_m};
}

static fw_geometry_point rounded(fw_geometry_vec2 p) {
    return (fw_geometry_point){(int32_t)floor(p.x * 1e9 + .5), (int32_t)floor(p.y * 1e9 + .5)};
}

/* radius, start and sweep of hinge k: none like another */
static void form(int k, double *radius_m, double *start_rad, double *sweep_rad) {
    *radius_m = 60e-6 + 40e-9 * k;
    *start_rad = .37 * k;
    *sweep_rad = 3 + .002 * k;
}

static fw_geometry_polygon flat(fw_arena *arena, int k) {
    fw_geometry_polygon p = {fw_arena_array(arena, fw_geometry_point, VERTICES), VERTICES};
    double radius, start, sweep;
    fw_geometry_vec2 o = place(k);
    form(k, &radius, &start, &sweep);
    for (int i = 0; p.vertex && i < VERTICES; i++) {
        int outer = i < VERTICES / 2, j = outer ? i : VERTICES - 1 - i;
        double r = radius + (outer ? half_width_m : -half_width_m);
        double angle = start + sweep * j / (VERTICES / 2 - 1);
        p.vertex[i] = rounded((fw_geometry_vec2){o.x + r * cos(angle), o.y + r * sin(angle)});
    }
    return p;
}

static fw_geometry_contour chords(fw_arena *arena, const fw_geometry_polygon *p) {
    fw_geometry_contour c = {fw_arena_array(arena, fw_geometry_segment, (size_t)p->count),
                             p->count};
    for (int i = 0; c.segment && i < p->count; i++) {
        fw_geometry_point a = p->vertex[i], b = p->vertex[(i + 1) % p->count];
        c.segment[i] = (fw_geometry_segment){.kind = FW_LINE,
                                             .a = {a.x_dbu * 1e-9, a.y_dbu * 1e-9},
                                             .b = {b.x_dbu * 1e-9, b.y_dbu * 1e-9}};
    }
    return c;
}

typedef struct job {
    fw_mask mask;
    fw_arena *arena;
    const fw_mask_format *format;
    size_t bytes;
} job;

static outcome write_once(void *context) {
    job *j = context;
    fw_mark before = fw_arena_mark(j->arena);
    double start = cpu_seconds();
    fw_text out = fw_text_new(j->arena);
    fw_status status = j->format->write(&j->mask, &out);
    outcome o = {.error = 0, .cpu_s = cpu_seconds() - start};
    if (status != FW_OK) o.failed = fw_status_text(status);
    j->bytes = out.length;
    fw_arena_rewind(j->arena, before);
    return o;
}

static int build(fw_arena *arena, fw_mask_shape *shape, bool arcs) {
    static const fw_layout_piece piece = {.label = "hinge"};
    for (int k = 0; k < HINGES; k++) {
        double radius, start, sweep;
        form(k, &radius, &start, &sweep);
        shape[k] = (fw_mask_shape){.piece = &piece, .polygon = flat(arena, k), .npart = 1};
        shape[k].part = &shape[k].polygon;
        if (!shape[k].polygon.vertex) return 0;
        if (!arcs)
            shape[k].contour = chords(arena, &shape[k].polygon);
        else if (fw_geometry_contour_ring_sector(arena, place(k), radius - half_width_m,
                                                 radius + half_width_m, start, sweep,
                                                 &shape[k].contour))
            return 0;
        if (!shape[k].contour.segment) return 0;
    }
    return 1;
}

static int run(bool arcs) {
    static fw_mask_layer layer = {.layer = 1,
                                  .id = "device",
                                  .name = "DEVICE",
                                  .purpose = "hinges",
                                  .tone = "data dark",
                                  .colour = "#3d6aa8",
                                  .roles = 1};
    static const fw_mask_table table = {
        .flow = "bench", .reading = "chrome down", .layer = &layer, .nlayer = 1};
    fw_arena *arena = fw_arena_new((size_t)2 << 30);
    fw_mask_shape *shape = arena ? fw_arena_array(arena, fw_mask_shape, HINGES) : NULL;
    if (!shape || !build(arena, shape, arcs)) return 1;
    job j = {.arena = arena,
             .mask = {.table = &table,
                      .cell = "bench",
                      .flow = "bench",
                      .device = "bench",
                      .title = "bench",
                      .shape = shape,
                      .nshape = HINGES,
                      .box = {-1e-4, -1e-4, ROW * pitch_m, ROW * pitch_m}}};
    for (size_t i = 0; (j.format = fw_mask_format_at(i)); i++) {
        outcome o = measure(write_once, &j);
        printf("%s,%s,%.4g,%zu%s%s\n", j.format->name, arcs ? "hinges" : "chords", 1e3 * o.cpu_s,
               j.bytes, o.failed ? "," : "", o.failed ? o.failed : "");
    }
    fw_arena_free(arena);
    return 0;
}

int main(void) {
    printf("format,outlines,cpu_ms,bytes\n");
    return run(true) || run(false);
}
