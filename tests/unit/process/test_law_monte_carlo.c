/* SPDX-License-Identifier: GPL-3.0-or-later */
/* First-order uncertainties of every computed time and intermediate result of both flows, against
   Monte Carlo: all inputs of a law are drawn together, those of one table as one, and the law is
   evaluated anew. A tenth of the packs' uncertainties, where first order is the whole truth; at
   their full size it is within what the window allows for. */
#include "packs.h"
#include "process/process_law.h"

enum { SAMPLES = 3000, MOST = FW_LAW_ARGUMENTS };

static fw_arena *arena;

static int setup(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    return arena ? 0 : -1;
}
static int teardown(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

/* standard normal, Box and Muller on a linear congruence of 64 bits */
static uint64_t seed = 20250101;
static double uniform(void) {
    seed = seed * 6364136223846793005u + 1442695040888963407u;
    return ((double)(seed >> 11) + 0.5) / 9007199254740992.0;
}
static double normal(void) {
    return sqrt(-2.0 * log(uniform())) * cos(2.0 * acos(-1.0) * uniform());
}

static const char *group_of(const fw_process_law *law, const char *name) {
    int i = law->argument ? fw_process_law_argument_index(law, name) : -1;
    return i >= 0 ? law->argument[i].group : NULL;
}

/* one draw of the inputs: the same quantity, and all of one group, move together */
static void draw(const fw_process_law_use *use, double scale, fw_quantity *q,
                 fw_process_argument *a) {
    double z[MOST];
    for (int i = 0; i < use->nargument; i++) {
        const char *group = group_of(use->law, use->argument[i].name);
        int same = i;
        for (int k = i - 1; k >= 0; k--)
            if (use->argument[k].q == use->argument[i].q ||
                (group && group_of(use->law, use->argument[k].name) == group))
                same = k;
        z[i] = same < i ? z[same] : normal();
        q[i] = *use->argument[i].q;
        q[i].value += scale * z[i] * q[i].uncertainty;
        q[i].uncertainty = 0.0;
        a[i] = (fw_process_argument){use->argument[i].name, &q[i]};
    }
}

typedef struct spread {
    double mean, deviation;
    int n;
} spread;

static spread sample(const fw_process_law_use *use, double scale) {
    fw_quantity q[MOST];
    fw_process_argument a[MOST];
    fw_process_law_use one = *use;
    double sum = 0.0, squares = 0.0, first = (double)NAN;
    int n = 0;
    one.argument = a;
    for (int i = 0; i < SAMPLES; i++) {
        fw_arena *own = fw_arena_new(0);
        fw_process_law_answer answer;
        draw(use, scale, q, a);
        assert_int_equal(fw_process_law_evaluate(own, &one, &answer), FW_OK);
        /* the current is set for the nominal area: another one gets another density */
        for (int k = 0; use->law == &fw_process_law_faraday && k < use->nargument; k++)
            if (strcmp(a[k].name, "area") == 0)
                answer.value *= q[k].value / use->argument[k].q->value;
        if (answer.computable) {
            if (n++ == 0) first = answer.value; /* differences keep their digits */
            sum += answer.value - first;
            squares += (answer.value - first) * (answer.value - first);
        }
        fw_arena_free(own);
    }
    if (n < 2) return (spread){.n = n};
    double mean = sum / n;
    return (spread){first + mean, sqrt(fmax(squares - n * mean * mean, 0.0) / (n - 1)), n};
}

static int checked, curved;

/* pauses make steps, and there is no first order: the stated width must hold the drawn one, and not
   be useless */
static void check_steps(const fw_process_law_use *use, const fw_process_law_answer *answer,
                        const char *what) {
    spread s = sample(use, 1.0);
    if (s.n < SAMPLES || s.deviation > 1.05 * answer->uncertainty ||
        s.deviation < 0.5 * answer->uncertainty)
        fail_msg("%s: +- %.4g, drawn +- %.4g", what, answer->uncertainty, s.deviation);
    checked++;
}

/* the deviation of 3000 draws is itself off by 1.3 %; four of those */
static void check(const fw_process_law_use *use, const char *what) {
    fw_process_law_answer answer;
    assert_int_equal(fw_process_law_evaluate(arena, use, &answer), FW_OK);
    if (!answer.computable || !(answer.uncertainty > 0.0)) return;
    if (use->law == &fw_process_law_duty) {
        check_steps(use, &answer, what);
        return;
    }
    spread s = sample(use, 0.1);
    if (s.n < SAMPLES) { /* an input at the end of its table: half the draws are outside */
        curved++;
        return;
    }
    double u = 0.1 * answer.uncertainty;
    if (fabs(s.deviation - u) > 0.052 * u || fabs(s.mean - answer.value) > 0.12 * u)
        fail_msg("%s (%s): %.6g +- %.4g, drawn %.6g +- %.4g", what, use->law->name, answer.value, u,
                 s.mean, s.deviation);
    checked++;
}

static void every_law_of_both_flows(void **state) {
    (void)state;
    static const char *const flows[] = {COPPER, SILICON};
    for (int k = 0; k < 2; k++) {
        fw_diags diags = fw_diags_new(arena);
        fw_process_flow *f = read_pack(arena, flows[k], NULL, NULL, &diags);
        assert_int_equal(fw_process_flow_compute(arena, f, &plain_facts, &diags), FW_OK);
        for (int i = 0; i < f->nstep; i++) {
            const fw_process_step *s = &f->step[i];
            fw_process_law_use time = {.law = fw_process_law_find(s->law),
                                       .shape = s->shape,
                                       .expression = s->expression,
                                       .wanted = FW_DIM_TIME,
                                       .argument = s->argument,
                                       .nargument = s->nargument};
            check(&time, s->id);
            for (int j = 0; j < s->nderive; j++) {
                const fw_process_derive *d = &s->derive[j];
                fw_process_law_use use = {.law = fw_process_law_find(d->law),
                                          .shape = d->shape,
                                          .expression = d->expression,
                                          .wanted = d->dimension,
                                          .argument = d->argument,
                                          .nargument = d->nargument};
                check(&use, d->name);
            }
        }
    }
    assert_true(checked >= 60);
    assert_true(curved <= 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_law_of_both_flows, setup, teardown)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
