/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What --accuracy promises, on random devices: is the true error below it, is what it chose cheap,
   is the estimate honest? README.md says what is written.

   The truth: dop853 (or what auto takes) at 1e-13, all effects; its own uncertainty is its distance
   from gsl-rk8pd at 1e-12 (radau5 at 1e-11 where that fails), another method of another order.
   Devices whose truth is not known to a tenth of the accuracy are not judged by it.
   The grid of what would have done: dop853, dopri5 and radau5 at whole decades, one run each, and
   for a whole call the one at a hundred times the tolerance, as --rtol makes it.
   The cost of a run, in instructions: survey_cost below. */
#include "devices.h"
#include "survey_cost.h"
#include "survey_table.h"
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

static const double survey_accuracy[SURVEY_ACCURACIES] = {1e-2, 1e-3, 1e-4, 1e-6, 1e-8};
static const char *const survey_integrators[] = {"dop853", "dopri5", "radau5"};
enum { INTEGRATORS = 3, MOST_STEPS = 100000 };

typedef struct device {
    fw_arena *arena;
    bounds_device *d;
    const fw_dynamics_motion *truth;
    double size, unknown; /* largest deflection rad; what the truth may be off by, relative */
} device;

static const fw_dynamics_motion *move(const device *d, const fw_dynamics_motion_options *options) {
    fw_diags diags = fw_diags_new(d->arena);
    fw_dynamics_motion_options o = *options;
    const fw_dynamics_motion *motion = NULL;
    if (o.most_steps == 0) o.most_steps = MOST_STEPS;
    fw_status status =
        fw_statics_move_scene(d->arena, &d->d->r.m, &d->d->r.scene, &o, &diags, &motion);
    return status == FW_OK ? motion : NULL;
}

/* one run alone, with all effects */
static const fw_dynamics_motion *alone(const device *d, const char *integrator, double rtol,
                                       long most) {
    return move(d, &(fw_dynamics_motion_options){.integrator = integrator,
                                                 .rtol = rtol,
                                                 .looser = 1,
                                                 .most_steps = most,
                                                 .effects = {.mode = FW_EFFECTS_ALL}});
}

static double apart(const fw_dynamics_motion *a, const fw_dynamics_motion *b) {
    double most = 0;
    for (int i = 0; i < a->npin; i++)
        most = fmax(most, fabs(fabs(a->peak[i].angle_rad) - fabs(b->peak[i].angle_rad)));
    return most;
}

static bool find_truth(device *d) {
    d->truth = alone(d, NULL, 1e-13, 0);
    if (!d->truth) return false;
    const fw_dynamics_motion *other = alone(d, "gsl-rk8pd", 1e-12, 0);
    if (!other) other = alone(d, "radau5", 1e-11, 0);
    d->size = 0;
    for (int i = 0; i < d->truth->npin; i++)
        d->size = fmax(d->size, fabs(d->truth->peak[i].angle_rad));
    if (!other || !(d->size > 0)) return false;
    d->unknown = apart(d->truth, other) / d->size;
    return true;
}

/* runs of the grid that take more steps than this are not among the cheapest */
static long most_steps(const survey_row row[SURVEY_ACCURACIES]) {
    long most = 0;
    for (int i = 0; i < SURVEY_ACCURACIES; i++)
        most = row[i].steps > most ? row[i].steps : most;
    return 2000 + 10 * most;
}

/* the same by what a step costs at least, once there is a cheapest one for every accuracy: a run
   that takes more cannot be cheaper than any */
static long steps_worth_it(const device *d, const survey_row row[SURVEY_ACCURACIES], int stages,
                           long most) {
    double dearest = 0;
    for (int i = 0; i < SURVEY_ACCURACIES; i++)
        if (row[i].moved) dearest = fmax(dearest, row[i].cost_cheapest);
    double steps = dearest / (stages * survey_cost_rhs(d->truth, d->d->r.m.nbody));
    return steps < (double)most ? (long)steps + 1 : most;
}

/* the cheapest of the grid for every accuracy */
static void search_grid(const device *d, survey_row row[SURVEY_ACCURACIES]) {
    static const int stages[INTEGRATORS] = {11, 6, 3}; /* evaluations of a step, at least */
    const long far = most_steps(row);
    const int bodies = d->d->r.m.nbody;
    for (int g = 0; g < INTEGRATORS; g++) {
        double paid[13] = {0}; /* by decade */
        for (int e = 1; e <= 12; e++) {
            fw_mark mark = fw_arena_mark(d->arena);
            const long most = steps_worth_it(d, row, stages[g], far);
            const fw_dynamics_motion *m = alone(d, survey_integrators[g], pow(10, -e), most);
            double error = m ? apart(m, d->truth) / d->size : HUGE_VAL;
            double cost = m ? survey_cost(m, bodies) : HUGE_VAL;
            bool needed = false;
            paid[e] = cost;
            for (int i = 0; i < SURVEY_ACCURACIES; i++) {
                if (!row[i].moved) continue; /* says nothing */
                if (error < survey_accuracy[i] && cost < row[i].cost_cheapest) {
                    row[i].cost_cheapest = cost;
                    row[i].cost_call = cost + paid[e > 3 ? e - 2 : 1];
                    row[i].cheapest_rtol = pow(10, -e);
                    row[i].cheapest_integrator = survey_integrators[g];
                }
                /* tighter ones cost no less */
                needed = needed || (cost < row[i].cost_cheapest && !(error < survey_accuracy[i]));
            }
            fw_arena_rewind(d->arena, mark);
            if (!m || !needed) break; /* tighter ones take no fewer steps */
        }
    }
}

static void judge(const device *d, double accuracy, survey_row *row) {
    fw_mark mark = fw_arena_mark(d->arena);
    const fw_dynamics_motion *m = move(d, &(fw_dynamics_motion_options){.accuracy = accuracy});
    row->moved = m != NULL;
    if (m) {
        row->true_error = apart(m, d->truth) / d->size;
        for (int i = 0; i < m->npin; i++) {
            double own = fabs(fabs(m->peak[i].angle_rad) - fabs(d->truth->peak[i].angle_rad));
            row->estimate = fmax(row->estimate, m->peak[i].error_rad / d->size);
            row->pins++;
            row->pins_dishonest +=
                own > m->peak[i].error_rad + d->unknown * d->size + 1e-13 * d->size;
        }
        snprintf(row->integrator, sizeof row->integrator, "%s", m->integrator);
        row->rtol = m->stats.rtol;
        row->runs = m->stats.runs;
        row->steps = m->stats.steps;
        row->rows_of_equilibria = strcmp(m->integrator, "quasi-static") == 0;
        row->cost = survey_cost(m, d->d->r.m.nbody);
        row->cost_total = row->cost * (double)m->stats.all_rhs / (double)m->stats.rhs;
        row->warned = row->estimate > accuracy;
    }
    fw_arena_rewind(d->arena, mark);
}

/* rows of one device, of which those with moved = false say nothing */
static void survey(uint64_t seed, survey_row row[SURVEY_ACCURACIES]) {
    static bounds_device made;
    device d = {.arena = fw_arena_new(0), .d = &made};
    int group = 0;
    memset(row, 0, SURVEY_ACCURACIES * sizeof *row);
    for (int i = 0; i < SURVEY_ACCURACIES; i++)
        row[i] =
            (survey_row){.seed = seed, .accuracy = survey_accuracy[i], .cost_cheapest = HUGE_VAL};
    bool made_one = survey_device(d.arena, seed, &made, &group);
    for (int i = 0; i < SURVEY_ACCURACIES; i++)
        row[i].group = group, row[i].bodies = made.r.m.nbody;
    if (made_one && find_truth(&d)) {
        for (int i = 0; i < SURVEY_ACCURACIES; i++) {
            row[i].reference_error = d.unknown;
            if (d.unknown < 0.1 * survey_accuracy[i]) judge(&d, survey_accuracy[i], &row[i]);
        }
        search_grid(&d, row);
    }
    fw_arena_free(d.arena);
}

/* ---- work on some processors: process j takes every jobs-th device ---- */

/* table (count x SURVEY_ACCURACIES), in memory that all of them share */
static bool survey_all(survey_row *table, uint64_t seed, int count, int jobs) {
    bool good = true;
    for (int j = 0; j < jobs; j++) {
        pid_t child = fork();
        if (child < 0) return false;
        if (child > 0) continue;
        for (int i = j; i < count; i += jobs)
            survey(seed + (uint64_t)i, table + (size_t)i * SURVEY_ACCURACIES);
        _exit(0);
    }
    for (int status; wait(&status) > 0;)
        good = good && status == 0;
    return good;
}

/* ---- one run, for callgrind ---- */

static int one(const char *seed, const char *integrator, const char *rtol) {
    static bounds_device made;
    device d = {.arena = fw_arena_new(0), .d = &made};
    int group;
    const fw_dynamics_motion *m = NULL;
    if (survey_device(d.arena, strtoull(seed, NULL, 10), &made, &group))
        m = alone(&d, strcmp(integrator, "auto") == 0 ? NULL : integrator, strtod(rtol, NULL), 0);
    if (m)
        printf("%s %s %s %d %ld %ld %.0f\n", seed, m->integrator, rtol, made.r.m.nbody,
               m->stats.rhs, m->stats.steps, survey_cost(m, made.r.m.nbody));
    fw_arena_free(d.arena);
    return m ? 0 : 1;
}

typedef struct request {
    int count, jobs;
    uint64_t seed;
    const char *csv, *honesty, *raw;
} request;

static bool take(request *r, const char *name, const char *value) {
    if (strcmp(name, "--count") == 0)
        r->count = atoi(value);
    else if (strcmp(name, "--seed") == 0)
        r->seed = strtoull(value, NULL, 10);
    else if (strcmp(name, "--jobs") == 0)
        r->jobs = atoi(value);
    else if (strcmp(name, "--csv") == 0)
        r->csv = value;
    else if (strcmp(name, "--honesty") == 0)
        r->honesty = value;
    else if (strcmp(name, "--raw") == 0)
        r->raw = value;
    else
        return false;
    return true;
}

int main(int argc, char **argv) {
    request r = {.count = 1000, .jobs = 2, .seed = 1};
    if (argc == 5 && strcmp(argv[1], "--one") == 0) return one(argv[2], argv[3], argv[4]);
    bool good = argc % 2 == 1;
    for (int i = 1; good && i + 1 < argc; i += 2)
        good = take(&r, argv[i], argv[i + 1]);
    if (!good || r.count < 1 || r.jobs < 1 || r.jobs > 16) {
        fprintf(stderr, "accuracy_survey [--count N] [--seed S] [--jobs J] [--csv FILE] "
                        "[--honesty FILE] [--raw FILE], or --one SEED INTEGRATOR RTOL\n");
        return 2;
    }
    size_t size = (size_t)r.count * SURVEY_ACCURACIES * sizeof(survey_row);
    survey_row *table = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (table == MAP_FAILED || !survey_all(table, r.seed, r.count, r.jobs)) {
        fprintf(stderr, "accuracy_survey: a part of the survey failed\n");
        return 1;
    }
    const survey_result result = {.row = table, .rows = r.count * SURVEY_ACCURACIES};
    good = survey_write(&result, survey_accuracy, r.csv, r.honesty, r.raw);
    good = survey_print(&result, survey_accuracy) && good;
    munmap(table, size);
    return good ? 0 : 1;
}
