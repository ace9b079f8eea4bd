/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What masks cost: exact bias, flattening, the integer certificate, rules and the writers, on
   hinges (two concentric arcs of 120 to 300 degrees about 80 um with round ends) that all differ.
   Thread CPU time, median and least of rounds. Flattening and writing: until there are as many
   vertices as asked for (default 1e6; `bench_outlines 1e7`).

   cmake --build DIR --target bench_outlines && DIR/tests/bench/bench_outlines [vertices [FILE]] */
#include "geometry/segment.h"
#include "mask/rule.h"
#include "mask/mask_parts.h"
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

enum { ROUNDS = 7, HINGES = 1000, MOST = 100000 };
static const double tolerance_m = 5e-9, bias_m = 1.5e-6;

static double now_ms(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static double uniform(uint64_t *seed) {
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

static void must(bool fine, const char *what) {
    if (fine) return;
    fprintf(stderr, "%s failed\n", what);
    exit(1);
}

/* the k-th of a square field, 300 um apart */
static void hinge(fw_arena *arena, int k, uint64_t *seed, fw_geometry_contour *out) {
    double r = 1e-6 * (70 + 20 * uniform(seed)), w = 1e-6 * (6 + 4 * uniform(seed));
    double from = 6 * uniform(seed), sweep = 2.1 + 3.1 * uniform(seed);
    fw_geometry_vec2 c = {3e-4 * (k % 316), 3e-4 * (k / 316)}; /* whole rows */
    fw_geometry_vec2 at = {c.x + (r + w / 2) * cos(from), c.y + (r + w / 2) * sin(from)};
    fw_geometry_vec2 a = {c.x + r * cos(from), c.y + r * sin(from)};
    fw_geometry_vec2 b = {c.x + r * cos(from + sweep), c.y + r * sin(from + sweep)};
    fw_geometry_outline o = fw_geometry_outline_start(arena, at);
    fw_geometry_outline_arc(&o, c, sweep, 0);
    fw_geometry_outline_arc(&o, b, FW_PI, 0);
    fw_geometry_outline_arc(&o, c, -sweep, 0);
    fw_geometry_outline_arc_to(&o, a, FW_PI, at, 0);
    must(fw_geometry_outline_close(&o, out) == FW_OK, "a hinge");
}

typedef struct times {
    double ms[ROUNDS];
    int n;
} times;

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void print(const char *what, times *t, const char *of) {
    qsort(t->ms, (size_t)t->n, sizeof *t->ms, by_size);
    printf("%-34s %10.3f ms, least %10.3f   %s\n", what, t->ms[t->n / 2], t->ms[0], of);
}

typedef struct field {
    fw_arena *arena;
    fw_geometry_contour *drawn;
    fw_mask_shape *shape;
    fw_layout_piece *piece;
    int n;
} field;

static field new_field(int n) {
    field f = {.arena = fw_arena_new(0), .n = n};
    uint64_t seed = 1;
    must(f.arena, "memory");
    f.drawn = fw_arena_array(f.arena, fw_geometry_contour, (size_t)n);
    f.shape = fw_arena_array(f.arena, fw_mask_shape, (size_t)n);
    f.piece = fw_arena_array(f.arena, fw_layout_piece, (size_t)n);
    must(f.drawn && f.shape && f.piece, "memory");
    for (int k = 0; k < n; k++) {
        hinge(f.arena, k, &seed, &f.drawn[k]);
        f.piece[k] = (fw_layout_piece){.contour = f.drawn[k], .label = "hinge"};
        f.shape[k] = (fw_mask_shape){.piece = &f.piece[k], .contour = f.drawn[k]};
    }
    return f;
}

static void bias(field *f) {
    int i, j;
    for (int k = 0; k < f->n; k++)
        must(fw_geometry_contour_offset(f->arena, &f->drawn[k], bias_m, &f->shape[k].contour, &i,
                                        &j) == FW_OK,
             "bias");
}

static void bench_bias(field *f) {
    times t = {0};
    for (int r = 0; r < ROUNDS; r++) {
        fw_mark mark = fw_arena_mark(f->arena);
        double from = now_ms();
        bias(f);
        t.ms[t.n++] = now_ms() - from;
        if (r + 1 < ROUNDS) fw_arena_rewind(f->arena, mark);
    }
    print("bias of 1000 hinges", &t, "");
}

static void bench_rules(field *f, const fw_mask_table *table) {
    times t = {0};
    char found[80];
    fw_mask_measure measure;
    for (int r = 0; r < ROUNDS; r++) {
        fw_diags diags = fw_diags_new(f->arena);
        fw_mark mark = fw_arena_mark(f->arena);
        double from = now_ms();
        must(fw_mask_join(f->arena, f->shape, f->n, &diags) == FW_OK, "joints");
        fw_mask_rules rules = {.arena = f->arena,
                               .table = table,
                               .shape = f->shape,
                               .nshape = f->n,
                               .tolerance_m = tolerance_m};
        must(fw_mask_rules_start(&rules, &measure) == FW_OK &&
                 fw_mask_rules_check(&rules, false) == FW_OK && rules.nfinding == 0,
             "rules");
        t.ms[t.n++] = now_ms() - from;
        snprintf(found, sizeof found, "least width %.4f um", 1e6 * measure.width_m);
        fw_arena_rewind(f->arena, mark);
    }
    print("rules of 1000 hinges", &t, found);
}

static void flatten(field *f, int n) {
    for (int k = 0; k < n; k++) {
        fw_mask_shape *s = &f->shape[k];
        must(fw_geometry_tessellate(f->arena, &s->contour, tolerance_m, &s->polygon) == FW_OK,
             "flattening");
        s->part = &s->polygon;
        s->npart = 1;
    }
}

static void bench_certificate(field *f) {
    times t = {0};
    flatten(f, f->n);
    for (int r = 0; r < ROUNDS; r++) {
        fw_mark mark = fw_arena_mark(f->arena);
        double from = now_ms();
        for (int k = 0; k < f->n; k++) {
            fw_mask_shape *s = &f->shape[k];
            must(fw_geometry_polygon_check(f->arena, &s->polygon, &s->report) == FW_OK &&
                     s->report.simple,
                 "certificate");
        }
        t.ms[t.n++] = now_ms() - from;
        fw_arena_rewind(f->arena, mark);
    }
    print("certificate of 1000 polygons", &t, "");
}

/* biased, flattened and written, all in one */
static void bench_whole(double vertices, const fw_mask_table *table) {
    times all = {0}, gds = {0}, svg = {0};
    char size[80];
    int n = (int)fmin(fmax(vertices / 390, 1), MOST);
    for (int r = 0; r < (vertices > 3e6 ? 3 : ROUNDS); r++) {
        field f = new_field(n);
        fw_text out = fw_text_new(f.arena), picture = fw_text_new(f.arena);
        double from = now_ms();
        bias(&f);
        flatten(&f, n);
        double between = now_ms();
        const fw_mask mask = {.table = table,
                              .cell = "FIELD",
                              .box = {0, 0, 95e-3, 95e-3},
                              .flow = "bench",
                              .device = "field",
                              .title = "field",
                              .shape = f.shape,
                              .nshape = n};
        must(fw_mask_write_gds(&mask, &out) == FW_OK, "GDSII");
        double end = now_ms();
        must(fw_mask_write_svg(&mask, &picture) == FW_OK, "SVG");
        svg.ms[svg.n++] = now_ms() - end;
        all.ms[all.n++] = end - from;
        gds.ms[gds.n++] = end - between;
        long count = 0;
        for (int k = 0; k < n; k++)
            count += f.shape[k].polygon.count;
        snprintf(size, sizeof size, "%ld vertices, %.1f MB, SVG %.1f MB", count,
                 1e-6 * (double)out.length, 1e-6 * (double)picture.length);
        fw_arena_free(f.arena);
    }
    print("bias, flattening and GDSII", &all, size);
    print("  of which GDSII", &gds, "");
    print("SVG of the same, true arcs", &svg, "");
}

static void flush(fw_text *out, int file) {
    for (size_t done = 0; done < out->length;) {
        ssize_t n = write(file, out->data + done, out->length - done);
        must(n > 0, "writing");
        done += (size_t)n;
    }
    out->length = 0;
}

/* the same, hinge by hinge through a buffer of 256 KiB, from drawn outlines that are held */
static void bench_stream(double vertices, const fw_mask_table *table, const char *path) {
    enum { BUFFER = 1 << 18 };
    times all = {0};
    char size[120];
    int n = (int)fmin(fmax(vertices / 390, 1), MOST);
    field f = new_field(n);
    for (int r = 0; r < ROUNDS; r++) {
        int file = open(path, O_WRONLY | O_CREAT | O_TRUNC, 0644), i, j;
        must(file >= 0, path);
        fw_mark mark = fw_arena_mark(f.arena);
        fw_text out = fw_text_new(f.arena);
        fw_text_reserve(&out, BUFFER);
        long count = 0, bytes = 0;
        double from = now_ms();
        fw_mask_gds_begin(&out, "FLEXWRIGHT");
        fw_mask_gds_cell_begin(&out, "FIELD");
        for (int k = 0; k < n; k++) {
            fw_mark before = fw_arena_mark(f.arena);
            fw_geometry_contour biased;
            fw_geometry_polygon flat;
            must(fw_geometry_contour_offset(f.arena, &f.drawn[k], bias_m, &biased, &i, &j) == FW_OK,
                 "bias");
            must(fw_geometry_tessellate(f.arena, &biased, tolerance_m, &flat) == FW_OK,
                 "flattening");
            if (out.length + 64 + 8 * (size_t)flat.count > BUFFER) {
                bytes += (long)out.length;
                flush(&out, file);
            }
            fw_mask_gds_boundary(&out, &table->layer[0], &flat);
            count += flat.count;
            fw_arena_rewind(f.arena, before);
        }
        fw_mask_gds_cell_end(&out);
        fw_mask_gds_end(&out);
        bytes += (long)out.length;
        flush(&out, file);
        all.ms[all.n++] = now_ms() - from;
        must(fw_text_end(&out) == FW_OK && close(file) == 0, "the file");
        struct rusage use;
        getrusage(RUSAGE_SELF, &use);
        snprintf(size, sizeof size, "%ld vertices, %.1f MB to %s, largest resident %.0f MB", count,
                 1e-6 * (double)bytes, path, 1e-3 * (double)use.ru_maxrss);
        fw_arena_rewind(f.arena, mark);
    }
    fw_arena_free(f.arena);
    print("the same, streamed", &all, size);
}

int main(int argc, char **argv) {
    fw_mask_layer layer = {.layer = 1,
                           .id = "device",
                           .name = "device",
                           .purpose = "",
                           .tone = "data dark",
                           .colour = "#000000",
                           .biased = true,
                           .roles = 1,
                           .min_width_m = 4e-6,
                           .min_space_m = 4e-6,
                           .rule_source = ""};
    const fw_mask_table table = {.flow = "bench", .reading = "", .layer = &layer, .nlayer = 1};
    field f = new_field(HINGES);
    bench_bias(&f);
    bench_rules(&f, &table);
    bench_certificate(&f);
    fw_arena_free(f.arena);
    double vertices = argc > 1 ? strtod(argv[1], NULL) : 1e6;
    bench_stream(vertices, &table, argc > 2 ? argv[2] : "/dev/null");
    bench_whole(vertices, &table);
    return 0;
}
