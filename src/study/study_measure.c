/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Instructions by callgrind, and CPU time: medians with intervals.

   For the count this program is started again under callgrind, runs a list of settings, and one
   dump is written behind each. Exactly repeatable, and the same whatever else the machine does. */
#include "base/sort.h"
#include "continuum/continuum.h"
#include "continuum/solver.h"
#include "study/tradeoff.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* ---- medians ---- */

/* rank k of that interval, from 1; 0: n is too small */
static int interval_rank(int n) {
    double term = pow(0.5, n), below = 0; /* P(fewer than k of n samples lie below the median) */
    int k = 0;
    while (k < n / 2 && below + term <= 0.025) {
        below += term;
        term *= (double)(n - k) / (double)(k + 1);
        k++;
    }
    return k;
}

fw_study_median fw_study_median_of(double *sample, int n) {
    fw_study_median m = {(double)NAN, (double)NAN, (double)NAN};
    if (n < 1) return m;
    fw_sort_doubles(sample, (size_t)n);
    m.value = 0.5 * (sample[(n - 1) / 2] + sample[n / 2]);
    int k = interval_rank(n);
    if (k < 1) return m;
    m.low = sample[k - 1];
    m.high = sample[n - k];
    return m;
}

bool fw_study_median_told(const fw_study_median *m) {
    return isfinite(m->low) && isfinite(m->high) && m->value > 0 &&
           m->high - m->low <= fw_interval_most * m->value;
}

/* ---- which settings ---- */

/* of the budget; and a program under callgrind does so many times fewer instructions a second */
static const double count_share = 0.4, slower = 6, one = 0.12;
enum { MOST_WORDS = 300 };

typedef struct wishes {
    int *point; /* (n) indices */
    int n;
    double left, most; /* instructions: of all, of one */
    bool *listed;      /* (npoint) */
} wishes;

static void want(const fw_study_tradeoff *t, int i, wishes *l) {
    const fw_study_tradeoff_point *p = &t->point[i];
    if (l->listed[i] || p->state != FW_TRADEOFF_DONE) return;
    if (p->instructions > fmin(l->left, i == 0 ? l->left : l->most)) return;
    l->listed[i] = true;
    l->left -= p->instructions;
    l->point[l->n++] = i;
}

/* the loosest tolerance of every pair that is drawn, the tightest of every integrator, their
   others, the other pairs, each cheapest first: as far as the share reaches */
typedef struct order {
    double instructions;
    int at;
    int rank;
} order;

static int before(const void *a, const void *b) {
    const order *x = a, *y = b;
    int first = fw_order_wholes(x->rank, y->rank);
    if (!first) first = fw_order_doubles(x->instructions, y->instructions);
    return first ? first : fw_order_wholes(x->at, y->at);
}

static int tightest(const fw_study_tradeoff *t, const fw_study_tradeoff_curve *c) {
    int at = c->first + c->count - 1;
    while (at > c->first && t->point[at].state != FW_TRADEOFF_DONE)
        at--;
    return at;
}

bool fw_study_tradeoff_good(const fw_study_tradeoff *t, const fw_study_tradeoff_point *p) {
    const fw_study_tradeoff_point *ref = t->reference.run[0];
    if (p->state != FW_TRADEOFF_DONE || !ref || !(p->error <= t->accuracy)) return false;
    double used = fabs(p->utilisation - ref->utilisation);
    return !(used > 10 * t->accuracy); /* NaN: no hinge has a limit */
}

static fw_status choose(fw_arena *arena, const fw_study_tradeoff *t, wishes *l) {
    order *all;
    int n = 0;
    FW_NEED(all = fw_arena_array(arena, order, (size_t)t->npoint));
    for (int i = 0; i < t->ncurve; i++) {
        const fw_study_tradeoff_curve *c = &t->curve[i];
        for (int at = c->first; at < c->first + c->count; at++)
            if (t->point[at].state == FW_TRADEOFF_DONE) {
                bool drawn = c->as_integrator || c->as_method, last = at == tightest(t, c);
                int rank = !drawn ? 3 : at == c->first ? 0 : c->as_integrator && last ? 1 : 2;
                all[n++] = (order){t->point[at].instructions, at, rank};
            }
    }
    qsort(all, (size_t)n, sizeof *all, before);
    want(t, 0, l);
    for (int i = 0; i < n; i++)
        want(t, all[i].at, l);
    return FW_OK;
}

static fw_status written(fw_arena *arena, const fw_study_problem *p, const fw_study_tradeoff *t,
                         const wishes *l, const char **out) {
    fw_text text = fw_text_new(arena);
    fw_text_printf(&text, "%s;", fw_effects_hinge_model_text(p->effects.hinge));
    for (int i = 0; i < l->n; i++) {
        const fw_study_tradeoff_point *point = &t->point[l->point[i]];
        fw_text_add(&text, i ? "," : "");
        if (l->point[i] == 0 && t->quasi_static)
            fw_text_add(&text, "row/row/0");
        else if (l->point[i] == 0)
            fw_text_add(&text, "auto/auto/0");
        else {
            fw_text_printf(&text, "%s/%s/", point->method, point->integrator);
            fw_text_number(&text, point->rtol, 17);
        }
    }
    *out = text.data;
    return fw_text_end(&text);
}

/* ---- the program under callgrind ---- */

/* the number behind "summary:" or "totals:" of dump i; NaN: there is none */
static double dump(const fw_continuum_external_room *room, int i) {
    char name[700], line[4096];
    double count = (double)NAN;
    snprintf(name, sizeof name, "%s/cg.%d", room->path, i);
    FILE *file = fopen(name, "r");
    if (!file) return count;
    while (fgets(line, sizeof line, file))
        if (strncmp(line, "summary: ", 9) == 0) count = strtod(line + 9, NULL);
    fclose(file);
    return count > 0 ? count : (double)NAN;
}

/* --settings stands right behind the command: behind a "--" of the user's it would be a file */
static fw_status start(const fw_continuum_external_room *room, const char *valgrind,
                       const char *const *program, const char *settings, double seconds,
                       fw_continuum_external_run *run) {
    enum { PROGRAM_AND_COMMAND = 2 };
    char file[700];
    const char *argv[MOST_WORDS + 16];
    int n = 0;
    snprintf(file, sizeof file, "--callgrind-out-file=%s/cg", room->path);
    argv[n++] = valgrind;
    argv[n++] = "--tool=callgrind";
    argv[n++] = "--collect-atstart=no";
    argv[n++] = "--toggle-collect=fw_study_tradeoff_answer";
    argv[n++] = "--dump-after=fw_study_tradeoff_answer";
    argv[n++] = file;
    int word = 0;
    while (word < PROGRAM_AND_COMMAND && program[word])
        argv[n++] = program[word++];
    argv[n++] = "--settings";
    argv[n++] = settings;
    for (; program[word] && word < MOST_WORDS; word++)
        argv[n++] = program[word];
    argv[n] = NULL;
    return fw_continuum_external_call_here(room, argv, "log", seconds, run);
}

/* the next counted point of the curve from k on, in steps of `side`; FW_NONE */
static int next_counted(const fw_study_tradeoff *t, const fw_study_tradeoff_curve *c, int k,
                        int side) {
    for (int at = k + side; at >= 0 && at < c->count; at += side)
        if (t->point[c->first + at].by == FW_COUNT_CALLGRIND) return at;
    return FW_NONE;
}

/* those on either side of k, or the nearest two on one; b FW_NONE: there is only one */
static void nearest(const fw_study_tradeoff *t, const fw_study_tradeoff_curve *c, int k, int *a,
                    int *b) {
    *a = next_counted(t, c, k, -1), *b = next_counted(t, c, k, 1);
    if (*a == FW_NONE && *b != FW_NONE)
        *a = *b, *b = next_counted(t, c, *a, 1);
    else if (*b == FW_NONE && *a != FW_NONE)
        *b = next_counted(t, c, *a, -1);
}

/* Instructions at a number of right-hand sides from two counts: the larger of a line, which is
   right where there is an overhead, and a power law, which is nearer where each costs more at
   tighter tolerances (implicit ones factor more often). b NULL: in proportion. */
static double between(double rhs, const fw_study_tradeoff_point *a,
                      const fw_study_tradeoff_point *b) {
    double each = a->instructions / (double)a->rhs, plain = each * rhs;
    if (!b || a->rhs == b->rhs) return plain;
    double slope = (a->instructions - b->instructions) / (double)(a->rhs - b->rhs);
    double power = log(a->instructions / b->instructions) / log((double)a->rhs / (double)b->rhs);
    if (!(slope > 0.2 * each && slope < 5 * each)) return plain;
    return fmax(a->instructions + slope * (rhs - (double)a->rhs),
                a->instructions * pow(rhs / (double)a->rhs, fmin(power, 2)));
}

/* the tolerances that were not counted, of pairs of which some were, from the nearest two */
static void scale(fw_study_tradeoff *t) {
    for (int i = 0; i < t->ncurve; i++) {
        const fw_study_tradeoff_curve *c = &t->curve[i];
        for (int k = 0; k < c->count; k++) {
            fw_study_tradeoff_point *p = &t->point[c->first + k];
            if (p->state != FW_TRADEOFF_DONE || p->by == FW_COUNT_CALLGRIND) continue;
            int a, b;
            nearest(t, c, k, &a, &b);
            if (a == FW_NONE) continue;
            p->instructions = between((double)p->rhs, &t->point[c->first + a],
                                      b == FW_NONE ? NULL : &t->point[c->first + b]);
            p->by = FW_COUNT_SCALED;
        }
    }
}

/* Pairs of which nothing was counted: the model, as far off as it is for the chosen setting. They
   are shown and not compared. */
static void adjust(fw_study_tradeoff *t, double modelled) {
    double by = t->point[0].instructions / modelled;
    for (int i = 1; i < t->npoint; i++)
        if (t->point[i].state == FW_TRADEOFF_DONE && t->point[i].by == FW_COUNT_MODEL)
            t->point[i].instructions *= by;
}

static fw_status counted(fw_study_problem *p, const char *valgrind,
                         const fw_study_tradeoff_options *o, wishes *l, fw_study_tradeoff *t) {
    fw_continuum_external_room room;
    fw_continuum_external_run run;
    const char *settings;
    FW_TRY(written(p->arena, p, t, l, &settings));
    double seconds = 60 + 4 * p->budget / 2.5e9;
    if (fw_continuum_external_room_open(p->arena, &room) != FW_OK) {
        t->instructions_why = "no temporary directory for callgrind";
        return FW_OK;
    }
    fw_status status = start(&room, valgrind, o->argv, settings, seconds, &run);
    for (int i = 0; status == FW_OK && i < l->n; i++) {
        double count = dump(&room, i + 1);
        if (!isfinite(count)) continue;
        t->point[l->point[i]].instructions = count;
        t->point[l->point[i]].by = FW_COUNT_CALLGRIND;
    }
    fw_continuum_external_room_close(&room);
    if (status == FW_OK && run.end == FW_EXTERNAL_CANCELLED) return FW_CANCELLED;
    if (status == FW_NOMEM) return status;
    if (t->point[0].by != FW_COUNT_CALLGRIND)
        t->instructions_why = "callgrind was started and counted nothing";
    return FW_OK;
}

fw_status fw_study_tradeoff_count(fw_study_problem *p, const fw_study_tradeoff_options *o,
                                  fw_study_tradeoff *t) {
    const char *valgrind;
    FW_TRY(fw_continuum_program(p->arena, "valgrind", &valgrind));
    if (!o->count)
        t->instructions_why = "not asked for";
    else if (!o->argv)
        t->instructions_why = "the program cannot be started again with this input";
    else if (!valgrind)
        t->instructions_why = "valgrind is not installed";
    if (t->instructions_why) return FW_OK;
    size_t n = (size_t)t->npoint;
    wishes l = {.left = count_share * p->budget / slower};
    l.most = one * l.left;
    FW_NEED(l.point = fw_arena_array(p->arena, int, n));
    FW_NEED(l.listed = fw_arena_array(p->arena, bool, n));
    FW_TRY(choose(p->arena, t, &l));
    double modelled = t->point[0].instructions;
    FW_TRY(counted(p, valgrind, o, &l, t));
    scale(t);
    adjust(t, modelled);
    return FW_OK;
}

/* ---- the other end ---- */

static const char *known(const char *word, fw_multibody_method_row (*at)(size_t)) {
    for (size_t i = 0; at(i).name; i++)
        if (strcmp(at(i).name, word) == 0) return at(i).name;
    return NULL;
}

/* "METHOD/INTEGRATOR/RTOL"; false: it is not one */
static bool parse(char *word, fw_study_tradeoff_setting *s) {
    char *integrator = strchr(word, '/'), *rtol = integrator ? strchr(integrator + 1, '/') : NULL;
    if (!rtol) return false;
    *integrator++ = '\0', *rtol++ = '\0';
    *s = (fw_study_tradeoff_setting){.quasi_static = strcmp(word, "row") == 0};
    if (s->quasi_static) return true;
    if (strcmp(word, "auto") != 0 && !(s->method = known(word, fw_multibody_method_at)))
        return false;
    if (strcmp(integrator, "auto") != 0 &&
        !(s->integrator = known(integrator, fw_dynamics_integrator_at)))
        return false;
    return fw_number_parse(rtol, strlen(rtol), &s->rtol) && s->rtol >= 0;
}

static fw_status wrong(fw_plan *plan, const char *list) {
    fw_diag_error(&plan->diags, 103, (fw_place){0},
                  "--settings needs LEVEL;METHOD/INTEGRATOR/RTOL,..., not '%s'", list);
    return FW_USAGE;
}

fw_status fw_study_tradeoff_settings(fw_plan *plan, const char *list) {
    fw_study_problem p;
    int level = FW_HINGE_AUTO;
    char *copy = fw_arena_strdup(plan->arena, list), *at, *word;
    FW_NEED(copy);
    char *settings = strchr(copy, ';');
    if (!settings) return wrong(plan, list);
    *settings++ = '\0';
    while (level <= FW_HINGE_ELASTICA &&
           strcmp(fw_effects_hinge_model_text((fw_effects_hinge_model)level), copy))
        level++;
    if (level > FW_HINGE_ELASTICA) return wrong(plan, list);
    FW_TRY(fw_study_problem_at_level(plan, (fw_effects_hinge_model)level, &p));
    for (word = strtok_r(settings, ",", &at); word; word = strtok_r(NULL, ",", &at)) {
        fw_study_tradeoff_setting s;
        const fw_dynamics_motion *motion;
        if (!parse(word, &s)) return wrong(plan, list);
        fw_mark mark = fw_arena_mark(p.arena);
        fw_diags own = fw_diags_new(p.arena);
        fw_status status = fw_study_tradeoff_answer(&p, &s, &own, &motion);
        if (status == FW_NOMEM || status == FW_CANCELLED) return status;
        fw_arena_rewind(p.arena, mark);
    }
    return FW_OK;
}

/* ---- CPU time as medians of ratios ----
   The setting and the chosen one take turns, so that both meet the same noise. What has an interval
   wider than a tenth is not told. */

enum { PAIRS = 25, WORTH = 11, OWN = 400 }; /* 25 pairs: ranks 8 and 18 */
static const double time_share = 0.15;      /* of the budget, in seconds of this machine */

static double cpu_s(void) {
    struct timespec now;
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) != 0) return (double)NAN;
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

typedef struct clockwork {
    fw_study_problem *p;
    fw_study_tradeoff_setting own;
    double left_s;
    double sample[OWN]; /* (n) times of the chosen one */
    int n;
} clockwork;

static fw_status measured(const clockwork *c, const fw_study_tradeoff_setting *s, double *seconds) {
    fw_arena *arena = c->p->arena;
    fw_mark mark = fw_arena_mark(arena);
    fw_diags own = fw_diags_new(arena);
    const fw_dynamics_motion *motion;
    double began = cpu_s();
    fw_status status = fw_study_tradeoff_answer(c->p, s, &own, &motion);
    *seconds = cpu_s() - began;
    fw_arena_rewind(arena, mark);
    return status == FW_NOMEM || status == FW_CANCELLED ? status : FW_OK;
}

static fw_study_tradeoff_setting setting_of(const fw_study_tradeoff_point *p) {
    return (fw_study_tradeoff_setting){
        .method = p->method, .integrator = p->integrator, .rtol = p->rtol};
}

static fw_status pairs(clockwork *c, fw_study_tradeoff_point *point) {
    const fw_study_tradeoff_setting s = setting_of(point);
    double ratio[PAIRS], a, b;
    FW_TRY(measured(c, &c->own, &a)); /* warm, and how long it will take */
    FW_TRY(measured(c, &s, &b));
    c->left_s -= a + b;
    int n = (int)fmin(PAIRS, c->left_s / fmax(a + b, 1e-9));
    if (n < WORTH) return FW_OK;
    for (int i = 0; i < n; i++) {
        FW_TRY(measured(c, i % 2 ? &c->own : &s, i % 2 ? &a : &b));
        FW_TRY(measured(c, i % 2 ? &s : &c->own, i % 2 ? &b : &a));
        c->left_s -= a + b;
        ratio[i] = b / a;
        if (c->n < OWN) c->sample[c->n++] = a;
    }
    const fw_study_median m = fw_study_median_of(ratio, n);
    point->time = (fw_study_tradeoff_time){m.value, m.low, m.high, n, fw_study_median_told(&m)};
    return FW_OK;
}

/* the cheapest of a curve that is within the accuracy; FW_NONE */
static int reaches(const fw_study_tradeoff *t, const fw_study_tradeoff_curve *c) {
    int best = FW_NONE;
    for (int i = c->first; i < c->first + c->count; i++)
        if (fw_study_tradeoff_good(t, &t->point[i]) &&
            (best < 0 || t->point[i].instructions < t->point[best].instructions))
            best = i;
    return best;
}

static fw_status of_front(clockwork *c, fw_study_tradeoff *t) {
    for (int i = 1; i < t->npoint; i++)
        if (t->point[i].front && t->point[i].time.pairs == 0) FW_TRY(pairs(c, &t->point[i]));
    return FW_OK;
}

static fw_status of_curves(clockwork *c, fw_study_tradeoff *t) {
    for (int i = 0; i < t->ncurve; i++) {
        const fw_study_tradeoff_curve *curve = &t->curve[i];
        int best = curve->as_method || curve->as_integrator ? reaches(t, curve) : FW_NONE;
        if (best >= 0 && t->point[best].time.pairs == 0) FW_TRY(pairs(c, &t->point[best]));
    }
    return FW_OK;
}

fw_status fw_study_tradeoff_times(fw_study_problem *p, const fw_study_tradeoff_options *o,
                                  fw_study_tradeoff *t) {
    clockwork c = {
        .p = p, .own = {.quasi_static = p->quasi_static}, .left_s = time_share * t->budget_s};
    t->chosen_cpu_s = t->chosen_cpu_low_s = t->chosen_cpu_high_s = (double)NAN;
    if (!o->times) {
        t->times_why = "not asked for";
        return FW_OK;
    }
    FW_TRY(of_front(&c, t));
    FW_TRY(of_curves(&c, t));
    const fw_study_median m = fw_study_median_of(c.sample, c.n);
    if (c.n == 0) t->times_why = "a pair of runs takes more than its share of the budget";
    if (!fw_study_median_told(&m)) return FW_OK;
    t->chosen_cpu_s = m.value, t->chosen_cpu_low_s = m.low, t->chosen_cpu_high_s = m.high;
    t->point[0].time = (fw_study_tradeoff_time){1, 1, 1, c.n, true};
    return FW_OK;
}
