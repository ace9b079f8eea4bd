/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What one evaluation of the method `chain` costs: ns of thread CPU time, median and least of
   interleaved rounds. Every evaluation waits for the one before it, as the stages of a step do. The
   least is what the processor can do, the median what it did beside its other work: where they are
   more than 5 % apart, measure again.

   bench_rhs            the table
   bench_rhs CASE COUNT only so many evaluations of one case, for instruction counts:
     valgrind --tool=callgrind --toggle-collect=measured ./bench_rhs loop 10000 */
#include "multibody/kernel.h"
#include "multibody/system.h"
#include "dynamics/models.h"
#include <stdlib.h>
#include <time.h>

enum { ROUNDS = 15, CASES = 32 };

typedef struct bench {
    const char *name, *label;
    const fw_multibody_model *model;
    fw_multibody_system *system; /* of the general code */
    fw_multibody_kernel *kernel; /* NULL: the general code, or lanes */
    bool project;
    fw_multibody_lanes *lanes;
    double *y, *f, *start;
    double each; /* divide by: bodies or designs */
    long repeat;
    double ns[ROUNDS];
} bench;

static double now_ns(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

static fw_multibody_system *system_of(fw_arena *arena, const rig *r, double *topology_ms) {
    fw_diags diags = fw_diags_new(arena);
    fw_effect_choice choice = {0};
    fw_effect_ledger ledger;
    fw_effects_loads *loads = fw_arena_one(arena, fw_effects_loads);
    const fw_multibody_model *m;
    fw_multibody_system *sys = NULL;
    double *q = fw_arena_array(arena, double, 3 * (size_t)r->m.nbody);
    for (int b = 0; b < r->m.nbody; b++) {
        q[3 * b] = r->m.body[b].x_m;
        q[3 * b + 1] = r->m.body[b].y_m;
        q[3 * b + 2] = r->m.body[b].phi_rad;
    }
    double began = now_ns();
    if (fw_effects_compile(arena, &r->m, &r->scene, &choice, 1e-3, &diags, &ledger, loads) ||
        fw_multibody_model_new(arena, &r->m, loads, q, r->scene.duration_s, NULL, &m) ||
        fw_multibody_system_new(arena, m, &r->m, &diags, &sys))
        exit(1);
    if (topology_ms) *topology_ms = 1e-6 * (now_ns() - began);
    return sys;
}

/* a state a little off the assembled pose, moving */
static void set_state(bench *b, const fw_multibody_model *m, uint64_t seed) {
    for (int i = 0; i < m->ny; i++)
        b->y[i] = 0.1 * (rig_random(&seed) - 0.5);
}

static void once(bench *b) {
    if (b->lanes) {
        fw_multibody_lanes_rhs(b->lanes, b->y, b->f);
        const int w = fw_multibody_lanes_width(b->lanes), from = (b->model->nq + 2) * w;
        for (int i = 0; i < w; i++) /* an angle of every design in the first group */
            b->y[2 * w + i] += 1e-30 * b->f[from + i];
    } else if (b->project) {
        memcpy(b->y, b->start, (size_t)b->model->ny * sizeof *b->y);
        if (!fw_multibody_kernel_project(b->kernel, b->y, b->f)) exit(1);
    } else if (b->kernel) {
        fw_multibody_kernel_rhs(b->kernel, b->y, b->f);
        b->y[2] += 1e-30 * b->f[b->model->nq + 2];
    } else {
        fw_multibody_rhs(b->system, 0, b->y, b->f);
        b->y[2] += 1e-30 * b->f[b->model->nq + 2];
    }
}

void measured(bench *b, long count);
__attribute__((noinline)) void measured(bench *b, long count) {
    for (long i = 0; i < count; i++)
        once(b);
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static bench make(fw_arena *arena, const char *name, const char *label, const fw_multibody_model *m,
                  fw_multibody_kernel *kernel) {
    bench b = {.name = name, .label = label, .model = m, .kernel = kernel};
    size_t n = (size_t)m->ny;
    b.y = fw_arena_array(arena, double, n);
    b.f = fw_arena_array(arena, double, n);
    b.start = fw_arena_array(arena, double, n);
    b.each = 1;
    b.repeat = 1 + 2000000 / (long)(m->nbody * 40);
    set_state(&b, m, 5);
    return b;
}

static fw_multibody_kernel *kernel_of(fw_arena *arena, const fw_multibody_model *m, bool loop) {
    fw_multibody_kernel *k = NULL;
    if (fw_multibody_kernel_new(arena, m, &k) || !k) exit(1);
    if (!loop) k->core.loop = NULL;
    return k;
}

static bench make_lanes(fw_arena *arena, const fw_multibody_model *m, const char *set) {
    static char label[3][48];
    static int at = 0;
    bench b = make(arena, set, label[at], m, NULL);
    const fw_multibody_model *eight[8] = {m, m, m, m, m, m, m, m};
    if (fw_multibody_lanes_new(arena, eight, 8, set, &b.lanes)) exit(1);
    b.y = fw_arena_array(arena, double, fw_multibody_lanes_size(b.lanes));
    b.f = fw_arena_array(arena, double, fw_multibody_lanes_size(b.lanes));
    double *y = fw_arena_array(arena, double, (size_t)m->ny);
    for (int d = 0; d < 8; d++) {
        uint64_t seed = (uint64_t)d;
        for (int i = 0; i < m->ny; i++)
            y[i] = 0.1 * (rig_random(&seed) - 0.5);
        fw_multibody_lanes_put(b.lanes, d, y, b.y);
    }
    b.each = 8;
    snprintf(label[at], sizeof label[at], "six-bar, 8 designs, %s, per design", set);
    at++;
    return b;
}

static int make_all(fw_arena *arena, bench *b) {
    int n = 0;
    static char label[8][64];
    rig *six = fw_arena_one(arena, rig), *twice = fw_arena_one(arena, rig);
    *six = rig_six_bar(arena, false), *twice = rig_six_bar(arena, true);
    fw_multibody_system *general = system_of(arena, six, NULL);
    const fw_multibody_model *m = general->model, *d = system_of(arena, twice, NULL)->model;
    general->kernel = NULL;
    b[n] = make(arena, "general", "six-bar, general code", m, NULL);
    b[n++].system = general;
    b[n++] = make(arena, "blocks", "six-bar, 2 x 2 blocks", m, kernel_of(arena, m, false));
    b[n++] = make(arena, "loop", "six-bar, closed loop", m, kernel_of(arena, m, true));
    b[n++] = make(arena, "redundant", "six-bar, hinge D twice", d, kernel_of(arena, d, true));
    b[n] = make(arena, "project", "six-bar, projection of q and v and f", m,
                kernel_of(arena, m, true));
    for (int i = 0; i < m->ny; i++) /* a step's error off the constraints */
        b[n].start[i] = i < 2 * m->nq ? 1e-8 * b[n].y[i] : 0;
    memcpy(b[n].y, b[n].start, (size_t)m->ny * sizeof(double));
    fw_multibody_kernel_rhs(b[n].kernel, b[n].y, b[n].f);
    b[n++].project = true;
    for (int i = 0; fw_multibody_lanes_set(i); i++)
        b[n++] = make_lanes(arena, m, fw_multibody_lanes_set(i));
    for (int i = 0, windows = 10; windows <= 10000; windows *= 10, i++) {
        rig *r = fw_arena_one(arena, rig);
        double ms;
        *r = rig_windows(arena, windows);
        const fw_multibody_model *big = system_of(arena, r, &ms)->model;
        snprintf(label[i], sizeof label[i], "%d four-bars, per body (model in %.1f ms)", windows,
                 ms);
        b[n] = make(arena, "windows", label[i], big, kernel_of(arena, big, true));
        b[n++].each = big->nbody;
    }
    return n;
}

int main(int argc, char **argv) {
    static bench b[CASES];
    fw_arena *arena = fw_arena_new((size_t)4 << 30);
    int n = make_all(arena, b);
    if (argc == 3) {
        for (int i = 0; i < n; i++)
            if (strcmp(b[i].name, argv[1]) == 0) {
                measured(&b[i], strtol(argv[2], NULL, 10));
                return 0;
            }
        return 1;
    }
    for (int i = 0; i < n; i++)
        measured(&b[i], 1 + b[i].repeat / 10);
    long allocations = fw_arena_count();
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < n; i++) {
            double began = now_ns();
            measured(&b[i], b[i].repeat);
            b[i].ns[round] = (now_ns() - began) / (double)b[i].repeat / b[i].each;
        }
    allocations = fw_arena_count() - allocations;
    printf("%s: %d rounds, ns of thread CPU time per right-hand side\n", argv[0], ROUNDS);
    printf("%-46s %10s %10s\n", "ns", "median", "least");
    for (int i = 0; i < n; i++) {
        qsort(b[i].ns, ROUNDS, sizeof(double), by_size);
        printf("%-46s %10.1f %10.1f\n", b[i].label, b[i].ns[ROUNDS / 2], b[i].ns[0]);
    }
    printf("allocations while measuring: %ld\n", allocations);
    fw_arena_free(arena);
    return 0;
}
