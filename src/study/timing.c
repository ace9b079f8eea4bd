/* SPDX-License-Identifier: GPL-3.0-or-later */
/* CPU time as medians of ratios: the setting and the chosen one take turns, so that both meet the
   same noise. What has an interval wider than a tenth is not told. */
#include "study/study_interval.h"
#include "study/problem.h"
#include <math.h>
#include <string.h>
#include <time.h>

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
    clockwork c = {.p = p, .own = {.row = p->row}, .left_s = time_share * t->budget_s};
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
