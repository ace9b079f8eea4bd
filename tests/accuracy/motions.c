/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Error of whole motions, for their work-precision curves. Every motion is one call of `measured`,
   so that callgrind can count the instructions of each; a row per motion, in order:

   PROBLEM,SETTING,TOLERANCE,STATE_ERROR,PEAK_ERROR,ESTIMATE,RHS,STEPS,CPU_MS

   PROBLEM: six-bar (10 ms), squeezer (30 ms), windows-N (N four-bars, 2 s), scale-N (N four-bars, 1
   s, no error). PEAK_ERROR: of the peak hinge angles, the largest over the largest peak; ESTIMATE:
   what the program itself says of it, likewise. STATE_ERROR: largest deviation of a coordinate,
   six-bar: mm and rad at 1, 2 .. 10 ms from the table in quad precision; squeezer: m and rad at the
   end; windows: m and rad of the first crank's end. References: reference.c. The time is CPU time
   of one call, unsettled: for choosing what to count, not for showing.

   accuracy_motions PROBLEM by-integrator|by-method|by-accuracy REFERENCE TABLE [SETTING FROM TO
   STEP] accuracy_motions list by-integrator|by-method    names of settings Tolerances 10^-E, E =
   FROM, FROM + STEP .. TO. by-accuracy: what --accuracy 10^-E chooses by itself. */
#include "dynamics/models.h"
#include "measure.h"

enum { PINS = 10, COORDINATES = 21 };

typedef struct truth {
    int npin, nq;
    double peak[PINS], end[COORDINATES];
    double angle; /* windows */
} truth;

typedef struct job {
    fw_arena *arena;
    rig r;
    fw_dynamics_motion_options options;
    const char *problem;
    int windows; /* 0: another problem */
    bool error;  /* there is a reference */
    truth truth;
    const six_reference *table;
} job;

typedef struct row {
    double state, peak, estimate, cpu_ms;
    long rhs, steps;
    int runs;
    const char *failed;
} row;

/* ---- references ---- */

static void read_truth(const char *path, const char *problem, truth *t) {
    char line[256], what[32], name[64];
    FILE *file = fopen(path, "r");
    *t = (truth){.npin = 0};
    while (file && fgets(line, sizeof line, file)) {
        int index;
        double value;
        if (sscanf(line, "%63[^,],%31[^,],%d,%lf", name, what, &index, &value) != 4 ||
            strcmp(name, problem) != 0)
            continue;
        if (strcmp(what, "peak") == 0 && index < PINS) t->peak[index] = value, t->npin = index + 1;
        if (strcmp(what, "end") == 0 && index < COORDINATES)
            t->end[index] = value, t->nq = index + 1;
        if (strcmp(what, "angle") == 0) t->angle = value, t->nq = 3;
    }
    if (file) fclose(file);
    if (t->nq) return;
    fprintf(stderr, "%s: no reference of %s\n", path, problem);
    exit(2);
}

/* ---- errors ---- */

static double larger(double worst, double value) {
    return !(value <= worst) ? value : worst; /* not a number stays */
}

static void windows_errors(const job *j, const fw_dynamics_motion *m, row *out) {
    const double *q = m->q + (size_t)(m->nsample - 1) * 3 * (size_t)m->nbody;
    double a = j->truth.angle, x = q[0] - .5 * sin(q[2]), y = q[1] + .5 * cos(q[2]);
    out->state = larger(fabs(x + sin(a)), fabs(y - cos(a)));
    double most = 0; /* pins of the base turn as far as the cranks: the largest peak */
    for (int p = 0; p < m->npin; p++)
        most = larger(most, fabs(m->peak[p].angle_rad));
    out->peak = fabs(most / fabs(a) - 1);
}

static void other_errors(const job *j, const fw_dynamics_motion *m, row *out) {
    double most = 0;
    for (int p = 0; p < j->truth.npin; p++)
        most = larger(most, fabs(j->truth.peak[p]));
    out->peak = 0;
    for (int p = 0; p < j->truth.npin; p++)
        out->peak = larger(out->peak, fabs(m->peak[p].angle_rad - j->truth.peak[p]) / most);
    out->state = 0;
    const double *q = m->q + (size_t)(m->nsample - 1) * 3 * (size_t)m->nbody;
    if (!j->table)
        for (int i = 0; i < j->truth.nq; i++)
            out->state = larger(out->state, fabs(q[i] - j->truth.end[i]));
    for (int k = 1; j->table && k <= 10; k++) {
        double at[15];
        for (int i = 0; i < 15; i++)
            at[i] = m->q[15 * k + i] * (i % 3 == 2 ? 1 : 1e3);
        out->state = larger(out->state, six_error(j->table, k, at));
    }
}

static void errors(const job *j, const fw_dynamics_motion *m, row *out) {
    double most = 0, said = 0;
    for (int p = 0; p < m->npin; p++) {
        most = larger(most, fabs(m->peak[p].angle_rad));
        said = larger(said, m->peak[p].error_rad);
    }
    out->estimate = said / most;
    if (!j->error)
        out->state = out->peak = (double)NAN;
    else if (j->windows)
        windows_errors(j, m, out);
    else
        other_errors(j, m, out);
}

/* ---- one motion ---- */

fw_status measured(job *j, fw_diags *diags, const fw_dynamics_motion **m);
__attribute__((noinline)) fw_status measured(job *j, fw_diags *diags,
                                             const fw_dynamics_motion **m) {
    return fw_dynamics_simulate(j->arena, &j->r.m, &j->r.scene, &j->options, diags, m);
}

static row move(job *j) {
    row out = {.state = (double)NAN, .peak = (double)NAN, .estimate = (double)NAN};
    fw_mark mark = fw_arena_mark(j->arena);
    fw_diags diags = fw_diags_new(j->arena);
    const fw_dynamics_motion *m = NULL;
    double began = cpu_seconds();
    if (measured(j, &diags, &m) != FW_OK || !m) {
        static char text[256];
        snprintf(text, sizeof text, "%s", diags.count ? diags.item[0].message : "no motion");
        out.failed = text;
    }
    out.cpu_ms = 1e3 * (cpu_seconds() - began);
    if (!out.failed) {
        out.rhs = m->stats.rhs, out.steps = m->stats.steps, out.runs = m->stats.runs;
        errors(j, m, &out);
    }
    fw_arena_rewind(j->arena, mark);
    return out;
}

/* ---- curves ---- */

/* A curve ends where a run took more evaluations than this: what lies beyond is dear everywhere. A
   number, not a time, so that every machine counts the same runs. */
static long most_rhs(const job *j) {
    const fw_dynamics_motion_options *o = &j->options;
    bool dense = o->method && strcmp(o->method, "chain") != 0;
    bool dearest = o->integrator && strcmp(o->integrator, "gsl-bsimp") == 0;
    return dense || dearest ? 12000 : 60000;
}

typedef struct wish {
    const char *kind, *setting; /* setting NULL: all */
    int from, to, step;
} wish;

static bool is(const char *a, const char *b) {
    return strcmp(a, b) == 0;
}

static void curve(job *j, const wish *w, const char *setting) {
    if (w->setting && !is(w->setting, setting)) return;
    for (int e = w->from, failures = 0; e <= w->to && failures < 2; e += w->step) {
        double tolerance = pow(10, -e);
        if (is(w->kind, "by-accuracy"))
            j->options.accuracy = tolerance;
        else
            j->options.rtol = tolerance, j->options.accuracy = fmax(tolerance, 1e-12);
        row r = move(j);
        if (r.failed) fprintf(stderr, "%s %s %g: %s\n", j->problem, setting, tolerance, r.failed);
        printf("%s,%s,%.0e,%.4e,%.4e,%.4e,%ld,%ld,%d,%.4g\n", j->problem, setting, tolerance,
               r.state, r.peak, r.estimate, r.rhs, r.steps, r.runs, r.cpu_ms);
        fflush(stdout);
        failures += r.failed != NULL;
        if (r.rhs > most_rhs(j)) break;
    }
}

/* NULL behind the last; the first integrator of the table is `auto` */
static const char *setting_at(const char *kind, size_t i) {
    return is(kind, "by-method") ? fw_multibody_method_at(i).name
                                 : fw_dynamics_integrator_at(i + 1).name;
}

static void curves(job *j, const wish *w) {
    if (is(w->kind, "by-accuracy")) {
        curve(j, w, "--accuracy");
        return;
    }
    bool by_method = is(w->kind, "by-method");
    const char *name;
    for (size_t i = 0; (name = setting_at(w->kind, i)); i++) {
        j->options.method = by_method ? name : "chain";
        j->options.integrator = by_method ? "dop853" : name;
        curve(j, w, name);
    }
}

static bool set_up(job *j, const char *problem) {
    int n = 0;
    j->problem = problem;
    j->error = true;
    j->options = (fw_dynamics_motion_options){.samples = 2, .effects = {.mode = FW_EFFECTS_ALL}};
    if (is(problem, "six-bar")) {
        j->r = rig_six_bar(j->arena, false);
        j->options.samples = 11;
    } else if (is(problem, "squeezer")) {
        j->r = rig_squeezer(j->arena);
    } else if (sscanf(problem, "windows-%d", &n) == 1 || sscanf(problem, "scale-%d", &n) == 1) {
        j->windows = n;
        j->r = rig_windows(j->arena, n);
        j->error = *problem == 'w';
        j->r.scene.duration_s = j->error ? 2 : 1;
    } else {
        return false;
    }
    return true;
}

static void list(const char *kind) {
    const char *name;
    for (size_t i = 0; (name = setting_at(kind, i)); i++)
        printf("%s\n", name);
}

int main(int argc, char **argv) {
    if (argc == 3 && is(argv[1], "list")) {
        list(argv[2]);
        return 0;
    }
    job j = {.arena = fw_arena_new((size_t)4 << 30)};
    if (argc < 5 || !j.arena || !set_up(&j, argv[1])) return 2;
    wish w = {argv[2], NULL, is(argv[2], "by-accuracy") ? 1 : 5, 13, 1};
    if (argc == 9) w = (wish){argv[2], argv[5], atoi(argv[6]), atoi(argv[7]), atoi(argv[8])};
    if (j.error) read_truth(argv[3], j.problem, &j.truth);
    six_reference table;
    if (is(j.problem, "six-bar")) {
        six_read(argv[4], &table);
        j.table = &table;
    }
    curves(&j, &w);
    fw_arena_free(j.arena);
    return 0;
}
