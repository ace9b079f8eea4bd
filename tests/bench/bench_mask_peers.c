/* SPDX-License-Identifier: GPL-3.0-or-later */
/* bench_mask_peers RADII DIR: our side of tests/bench/mask_peers.py. RADII: those of the hinges
   in um, one to a line; the 1000 hinges themselves, 1000 vertices each, in DIR/input.bin, int32
   pairs in nm. Rows: what, CPU ms, bytes. Files for the comparison: DIR/flexwright-TOLERANCE.gds
   (biased, flattened), DIR/flexwright-input.gds and .oas (the outlines as they came in). */
#include "mask/mask.h"
#include "measure.h"

enum { HINGES = 1000, VERTICES = 1000, ROW = 100 };
static const double PITCH_M = 300e-6, BIAS_M = 1.5e-6;

/* two half circles of radius r on either side of a neck of 8 um, in a block; y0 upwards */
static fw_status hinge(fw_arena *arena, int k, double r_m, fw_geometry_contour *out) {
    double h = r_m + 4e-6, w = r_m + 20e-6;
    fw_geometry_vec2 o = {k % ROW * PITCH_M, k / ROW * PITCH_M};
    fw_geometry_outline c = fw_geometry_outline_start(arena, (fw_geometry_vec2){o.x - w, o.y - h});
    fw_geometry_outline_line(&c, (fw_geometry_vec2){o.x - r_m, o.y - h}, 0);
    fw_geometry_outline_arc_to(&c, (fw_geometry_vec2){o.x, o.y - h}, -acos(-1.0),
                               (fw_geometry_vec2){o.x + r_m, o.y - h}, 0);
    fw_geometry_outline_line(&c, (fw_geometry_vec2){o.x + w, o.y - h}, 0);
    fw_geometry_outline_line(&c, (fw_geometry_vec2){o.x + w, o.y + h}, 0);
    fw_geometry_outline_line(&c, (fw_geometry_vec2){o.x + r_m, o.y + h}, 0);
    fw_geometry_outline_arc_to(&c, (fw_geometry_vec2){o.x, o.y + h}, -acos(-1.0),
                               (fw_geometry_vec2){o.x - r_m, o.y + h}, 0);
    fw_geometry_outline_line(&c, (fw_geometry_vec2){o.x - w, o.y + h}, 0);
    return fw_geometry_outline_close(&c, out);
}

typedef struct job {
    fw_arena *arena;
    const fw_geometry_contour *contour; /* (HINGES) exact, as drawn */
    double tolerance_m;
    fw_mask mask;
    const fw_mask_format *format;
    const char *path; /* where the last run is written; NULL: nowhere */
    size_t bytes;
} job;

/* biased, flattened and rounded to the grid */
static fw_status bias_all(job *j, fw_mask_shape *shape) {
    for (int k = 0; k < HINGES; k++) {
        fw_geometry_contour moved;
        int a, b;
        FW_TRY(fw_geometry_contour_offset(j->arena, &j->contour[k], BIAS_M, &moved, &a, &b));
        FW_TRY(fw_geometry_tessellate(j->arena, &moved, j->tolerance_m, &shape[k].polygon));
    }
    return FW_OK;
}

static outcome bias_once(void *context) {
    job *j = context;
    fw_mark before = fw_arena_mark(j->arena);
    fw_mask_shape *shape = fw_arena_array(j->arena, fw_mask_shape, HINGES);
    double start = cpu_seconds();
    fw_status status = shape ? bias_all(j, shape) : FW_NOMEM;
    outcome o = {.cpu_s = cpu_seconds() - start};
    if (status != FW_OK) o.failed = fw_status_text(status);
    fw_arena_rewind(j->arena, before);
    return o;
}

static bool keep(const fw_text *out, const char *path) {
    FILE *file = fopen(path, "wb");
    bool good = file && fwrite(out->data, 1, out->length, file) == out->length;
    return file && fclose(file) == 0 && good;
}

static outcome write_once(void *context) {
    job *j = context;
    fw_mark before = fw_arena_mark(j->arena);
    double start = cpu_seconds();
    fw_text out = fw_text_new(j->arena);
    fw_status status = j->format->write(&j->mask, &out);
    if (status == FW_OK && !keep(&out, j->path)) status = FW_IO;
    outcome o = {.cpu_s = cpu_seconds() - start};
    if (status != FW_OK) o.failed = fw_status_text(status);
    j->bytes = out.length;
    fw_arena_rewind(j->arena, before);
    return o;
}

static int row(const char *name, outcome o, size_t bytes) {
    printf("%s,%.6g,%zu\n", name, 1e3 * o.cpu_s, bytes);
    if (o.failed) fprintf(stderr, "%s: %s\n", name, o.failed);
    return o.failed ? 1 : 0;
}

static const fw_mask_format *format_of(const char *name) {
    const fw_mask_format *f = NULL;
    for (size_t i = 0; (f = fw_mask_format_at(i)) && strcmp(f->name, name) != 0; i++) {
    }
    return f;
}

/* DIR/NAME with the format's ending */
static int write_row(job *j, const char *directory, const char *name, const char *format) {
    char path[4096], what[64];
    j->format = format_of(format);
    snprintf(path, sizeof path, "%s/%s%s", directory, name, j->format->ending);
    snprintf(what, sizeof what, "write %s %s", name, format);
    j->path = path;
    outcome o = measure(write_once, j);
    return row(what, o, j->bytes);
}

static int biased(job *j, const char *directory, double tolerance_m) {
    char what[64], name[48];
    j->tolerance_m = tolerance_m;
    snprintf(name, sizeof name, "flexwright-%g", tolerance_m * 1e9);
    snprintf(what, sizeof what, "bias %s", name);
    if (row(what, measure(bias_once, j), 0) || bias_all(j, j->mask.shape)) return 1;
    return write_row(j, directory, name, "gds");
}

static bool read_input(job *j, const char *path) {
    FILE *file = fopen(path, "rb");
    bool good = file != NULL;
    for (int k = 0; good && k < HINGES; k++) {
        fw_geometry_polygon *p = &j->mask.shape[k].polygon;
        *p = (fw_geometry_polygon){fw_arena_array(j->arena, fw_geometry_point, VERTICES), VERTICES};
        good = p->vertex && fread(p->vertex, sizeof(fw_geometry_point), VERTICES, file) == VERTICES;
    }
    if (file) fclose(file);
    return good;
}

/* radii, one to a line */
static bool read_radii(job *j, fw_geometry_contour *contour, const char *path) {
    FILE *file = fopen(path, "r");
    char line[64];
    int k = 0;
    while (file && k < HINGES && fgets(line, sizeof line, file)) {
        if (hinge(j->arena, k, strtod(line, NULL) * 1e-6, &contour[k]) != FW_OK) break;
        k++;
    }
    if (file) fclose(file);
    j->contour = contour;
    return k == HINGES;
}

int main(int argc, char **argv) {
    static fw_mask_layer layer = {.layer = 1,
                                  .id = "device",
                                  .name = "DEVICE",
                                  .purpose = "hinges",
                                  .tone = "data dark",
                                  .colour = "#3d6aa8",
                                  .roles = 1};
    static const fw_mask_table table = {
        .flow = "bench", .reading = "chrome down", .layer = &layer, .nlayer = 1};
    static const fw_layout_piece piece = {.label = "hinge"};
    if (argc != 3) return 2;
    fw_arena *arena = fw_arena_new((size_t)2 << 30);
    fw_mask_shape *shape = arena ? fw_arena_array(arena, fw_mask_shape, HINGES) : NULL;
    fw_geometry_contour *contour =
        arena ? fw_arena_array(arena, fw_geometry_contour, HINGES) : NULL;
    if (!shape || !contour) return 1;
    for (int k = 0; k < HINGES; k++)
        shape[k].piece = &piece;
    job j = {.arena = arena,
             .mask = {.table = &table,
                      .cell = "bench",
                      .flow = "bench",
                      .device = "bench",
                      .title = "bench",
                      .shape = shape,
                      .nshape = HINGES}};
    char path[4096];
    snprintf(path, sizeof path, "%s/input.bin", argv[2]);
    if (!read_radii(&j, contour, argv[1]) || !read_input(&j, path)) return 1;
    int failed = write_row(&j, argv[2], "flexwright-input", "gds") ||
                 write_row(&j, argv[2], "flexwright-input", "oasis") ||
                 biased(&j, argv[2], 1.42e-9) || biased(&j, argv[2], 5e-9);
    fw_arena_free(arena);
    return failed;
}
