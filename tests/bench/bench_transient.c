/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Flexwright's side of the comparison: error against CPU time of whole motions, through
   fw_dynamics_simulate as every user calls it.

   bench_transient sixbar    every method and every integrator, 10 ms
   bench_transient windows   N four-bar windows, 10 s: error of B0
   bench_transient scaling   N four-bar windows, 1 s, up to N = 10 000
   bench_transient long      10 s of the six-bar, damped and undamped
   bench_transient once      one 10 ms motion at 10^-E (--from E), for counting instructions
   Further arguments and output: measure.h. */
#include "dynamics/models.h"
#include "measure.h"

typedef struct job {
    fw_arena *arena;
    rig r;
    fw_dynamics_motion_options options;
    const six_reference *reference; /* six-bar: error against the table */
    int windows;                    /* windows: N */
    int whole; /* time of the whole call: checks, plan, assembly, second run for the error */
} job;

static double six_worst(const job *j, const fw_dynamics_motion *m) {
    double worst = 0;
    for (int k = 1; k <= 10; k++) {
        double q[15];
        for (int i = 0; i < 15; i++)
            q[i] = m->q[15 * k + i] * (i % 3 == 2 ? 1 : 1e3);
        double e = six_error(j->reference, k, q);
        if (!(e <= worst)) worst = e;
    }
    return worst;
}

static double b0_error(const job *j, const fw_dynamics_motion *m) {
    const double *q = m->q + (size_t)(m->nsample - 1) * 3 * (size_t)m->nbody;
    const double *v = m->v + (size_t)(m->nsample - 1) * 3 * (size_t)m->nbody;
    double x = -.5 * sin(q[2]), y = .5 * cos(q[2]);
    const double b0[4] = {q[0] + x, q[1] + y, v[0] - v[2] * y, v[1] + v[2] * x};
    return windows_error(j->windows, b0);
}

static outcome simulate(void *context) {
    job *j = context;
    outcome o = {.error = 0};
    fw_mark mark = fw_arena_mark(j->arena);
    fw_diags diags = fw_diags_new(j->arena);
    const fw_dynamics_motion *m = NULL;
    double began = cpu_seconds();
    fw_status status =
        fw_dynamics_simulate(j->arena, &j->r.m, &j->r.scene, &j->options, &diags, &m);
    if (status != FW_OK || !m) {
        static char text[256];
        snprintf(text, sizeof text, "%s", diags.count ? diags.item[0].message : "no motion");
        o.failed = text;
        o.cpu_s = cpu_seconds() - began;
    } else {
        o.cpu_s = j->whole ? cpu_seconds() - began : m->stats.cpu_s;
        o.rhs = m->stats.rhs;
        if (j->reference) o.error = six_worst(j, m);
        if (j->windows) o.error = b0_error(j, m);
    }
    fw_arena_rewind(j->arena, mark);
    return o;
}

/* one curve, from the loosest tolerance on, until a run takes longer than `most_s` or fails
   twice */
static void curve(const request *wish, job *j, const char *setting, int first, int last,
                  double most_s) {
    int step = wish->quick ? 2 : 1;
    if (wish->quick) first += first % 2;
    for (int e = first, failures = 0; e <= last && failures < 2; e += step) {
        if (!wanted(wish, setting, e)) continue;
        j->options.rtol = pow(10, -e);
        outcome o = measure(simulate, j);
        print_row("flexwright", setting, j->options.rtol, o);
        failures += o.failed != NULL;
        if (o.cpu_s > most_s) break;
    }
}

static fw_arena *new_arena(void) {
    fw_arena *arena = fw_arena_new((size_t)6 << 30);
    if (arena) return arena;
    fprintf(stderr, "out of memory\n");
    exit(6);
}

/* every method with dop853, every integrator with chain, and the whole call */
static void six_bar(const request *wish) {
    six_reference reference;
    six_read(wish->reference, &reference);
    job j = {.arena = new_arena(), .reference = &reference};
    j.r = rig_six_bar(j.arena, false);
    j.options.samples = 11;
    char setting[128];
    size_t methods = 0;
    while (fw_multibody_method_at(methods).name)
        methods++;
    for (size_t i = 0; i < methods || fw_dynamics_integrator_at(i - methods).name; i++) {
        bool by_method = i < methods;
        j.options.method = by_method ? fw_multibody_method_at(i).name : "chain";
        j.options.integrator = by_method ? "dop853" : fw_dynamics_integrator_at(i - methods).name;
        if (!by_method && strcmp(j.options.integrator, "dop853") == 0) continue;
        if (!by_method && strcmp(j.options.integrator, "auto") == 0) continue;
        snprintf(setting, sizeof setting, "%s + %s", j.options.method, j.options.integrator);
        curve(wish, &j, setting, 5, 13, wish->quick ? .1 : .5);
    }
    j.options.method = j.options.integrator = NULL;
    j.whole = 1;
    curve(wish, &j, "whole call with error estimate", 5, 13, .5);
    fw_arena_free(j.arena);
}

static void windows(const request *wish) {
    static const int sizes[] = {1, 2, 10, 40, 100, 1000};
    for (int i = 0; i < (wish->quick ? 4 : 6); i++) {
        job j = {.arena = new_arena(), .windows = sizes[i]};
        j.r = rig_windows(j.arena, sizes[i]);
        j.options.samples = 2;
        char setting[64];
        snprintf(setting, sizeof setting, "N=%d", sizes[i]);
        curve(wish, &j, setting, 5, sizes[i] < 1000 ? 12 : 10, 60);
        fw_arena_free(j.arena);
    }
}

/* no error: there is no exact value at 1 s */
static void scaling(const request *wish) {
    static const int sizes[] = {1, 2, 5, 10, 20, 40, 100, 200, 400, 1000, 2000, 4000, 10000};
    for (int i = 0; i < (wish->quick ? 8 : 13); i++) {
        job j = {.arena = new_arena(), .windows = sizes[i]};
        j.r = rig_windows(j.arena, sizes[i]);
        j.r.scene.duration_s = 1;
        j.options.samples = 2;
        char setting[64];
        snprintf(setting, sizeof setting, "N=%d", sizes[i]);
        for (int e = 6; e <= 10; e += 2) {
            if (!wanted(wish, setting, e)) continue;
            j.options.rtol = pow(10, -e);
            outcome o = measure(simulate, &j);
            o.error = (double)NAN;
            print_row("flexwright", setting, j.options.rtol, o);
        }
        fw_arena_free(j.arena);
    }
}

enum { LONG_ROWS = 2001 };

/* largest deviation over 2000 times, mm and rad, from a run at the tightest tolerance */
static outcome long_once(job *j, const fw_dynamics_motion *fine) {
    fw_diags diags = fw_diags_new(j->arena);
    const fw_dynamics_motion *m = NULL;
    fw_status status =
        fw_dynamics_simulate(j->arena, &j->r.m, &j->r.scene, &j->options, &diags, &m);
    if (status != FW_OK) return (outcome){.failed = "failed"};
    outcome o = {.cpu_s = m->stats.cpu_s, .rhs = m->stats.rhs};
    for (int i = 0; i < LONG_ROWS * 15; i++)
        o.error = fmax(o.error, fabs(m->q[i] - fine->q[i]) * (i % 15 % 3 == 2 ? 1 : 1e3));
    return o;
}

/* 10 s of the six-bar, damped as it is, and without its dampers */
static void long_run(const request *wish) {
    for (int damped = 1; damped >= 0; damped--) {
        job j = {.arena = new_arena()};
        const char *setting = damped ? "10 s" : "10 s undamped";
        j.r = rig_six_bar(j.arena, false);
        j.r.scene.duration_s = 10;
        j.options.samples = LONG_ROWS;
        for (int i = 0; !damped && i < j.r.m.npin; i++)
            j.r.m.pin[i].damping_Nms_per_rad = 0;
        fw_diags diags = fw_diags_new(j.arena);
        const fw_dynamics_motion *fine = NULL;
        j.options.rtol = 1e-13;
        if (fw_dynamics_simulate(j.arena, &j.r.m, &j.r.scene, &j.options, &diags, &fine) == FW_OK)
            for (int e = 7; e <= 12; e++) {
                j.options.rtol = pow(10, -e);
                if (wanted(wish, setting, e))
                    print_row("flexwright", setting, j.options.rtol, long_once(&j, fine));
            }
        fw_arena_free(j.arena);
    }
}

static void once(const request *wish) {
    job j = {.arena = new_arena()};
    j.r = rig_six_bar(j.arena, false);
    j.options.samples = 11;
    j.options.rtol = pow(10, -wish->from);
    print_row("flexwright", "once", j.options.rtol, simulate(&j));
    fw_arena_free(j.arena);
}

int main(int argc, char **argv) {
    const request wish = read_request(argc, argv);
    if (strcmp(wish.problem, "sixbar") == 0)
        six_bar(&wish);
    else if (strcmp(wish.problem, "windows") == 0)
        windows(&wish);
    else if (strcmp(wish.problem, "scaling") == 0)
        scaling(&wish);
    else if (strcmp(wish.problem, "long") == 0)
        long_run(&wish);
    else if (strcmp(wish.problem, "once") == 0)
        once(&wish);
    else
        return 2;
    return 0;
}
