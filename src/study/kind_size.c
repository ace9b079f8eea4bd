/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sizing: the values with which a response is least or largest while every limit holds and check accepts the device; of
   two responses the Pareto front.

   The description as it stands and a Sobol' sequence over the ranges are judged first; from the best of them, apart from
   each other, local searches (study_search.c); from the best of all these one more, by models of all that was judged, with
   what the searches left of their devices. What is returned is a device that was judged as its texts say. Of two goals each
   is sought alone, then the first with the second held at nine levels between (epsilon constraints; Haimes, Lasdon, Wismer
   1971), and the front is what nothing that was judged beats. Nothing is proved: a better one may be where nobody looked.

   At a wanted yield a device has to hold every limit also as the dies that lie a distance beta from what is intended in the
   direction that is worst for it (sequential optimisation and reliability assessment: X. Du, W. Chen, J. Mech. Des. 126
   (2004) 225). Dies are found for the best device, searches follow with these, until none is worse; then its yield is
   estimated, and beta follows what that says, since a limit that bends, or several of them, have another yield than a plane
   at that distance. What is returned is a device whose yield was estimated so. Test: tests/cli/test_study.py,
   tests/cli/test_sizing.py */
#include "chance/random.h"
#include "maths/functions.h"
#include "study/study_parts.h"
#include <limits.h>
#include <math.h>
#include <string.h>

enum {
    STARTS = 3,        /* of local searches, a goal each */
    SEARCHES = 4,      /* and one from all that was judged */
    EACH = 19,         /* devices of a search for each input, and so many more */
    LEVELS = 9,        /* of the second goal */
    DIGITS = 5,        /* of what is tried: more no mask resolves */
    FRONT_MOST = 200,  /* devices of a front */
    LISTS_MOST = 1000, /* combinations of listed values */
    ROUNDS = 12,       /* searches at a wanted yield, in one go */
    USUAL_ROUNDS = 4,  /* what a budget is shared out for */
    ESTIMATED = 5,     /* devices whose yield is estimated by few dies, in one go */
    CONFIRMED = 3,     /* devices whose yield is estimated in full, until one is enough */
    DIES = 4,          /* of a flow that searches look at; the last ones found */
    PART = 1000000     /* numbers of samples of one search begin at a multiple of it */
};

typedef struct goal {
    int response;
    double sign; /* 1: minimise, -1: maximise */
} goal;

typedef struct sizing {
    fw_study *study;
    fw_study_result *result;
    goal goal[2];
    int ngoal;
    fw_chance_sobol sobol;
    long first_n;          /* samples of the first look */
    long lists;            /* combinations of listed values */
    fw_study_sample *kept; /* (nkept) of the first look, the best first */
    double *f, *c;
    int nkept;
    /* at a wanted yield */
    fw_study_die *die; /* (ndie) that a device has to hold as well */
    int ndie;
    double beta; /* how far they lie */
    double
        allowed; /* the share that may fail by a first estimate; less after a whole one was not enough */
    long left; /* devices that searches may still judge */
} sizing;

/* ---- what is small, and what must not be above 0 ---- */

static double goal_of(const fw_study_sample *sample, const goal *g) {
    return g->sign * sample->response[g->response];
}

/* above 0: a limit of a response is missed, or check does not accept */
static double constraint_of(const fw_study *study, const fw_study_sample *sample) {
    double limits = fw_study_excess(study, sample);
    if (!sample->run || isnan(limits) || isnan(sample->used)) return (double)NAN;
    return fmax(limits, log(fmax(sample->used, 1e-6)));
}

typedef struct aim { /* of one search */
    const sizing *s;
    const goal *goal;
    const goal *held; /* NULL: none */
    double level;     /* of the one held */
    double scale;
} aim;

/* what the dies use counts as what the device uses */
static fw_status besides(const void *context, fw_study_sample *sample) {
    const sizing *s = ((const aim *)context)->s;
    double most = log(sample->used);
    for (int k = 0; k < s->ndie && !isnan(most); k++) {
        double ln;
        FW_TRY(fw_study_dies_at(s->study->dies, s->study, sample, &s->die[k], &ln));
        most = isnan(ln) ? (double)NAN : fmax(most, ln);
    }
    sample->used = exp(most);
    return FW_OK;
}

static double objective(const void *context, const fw_study_sample *sample) {
    const aim *a = context;
    return goal_of(sample, a->goal);
}

static double constraint(const aim *a, const fw_study_sample *sample) {
    const double c = constraint_of(a->s->study, sample);
    return !a->held || isnan(c) ? c : fmax(c, (goal_of(sample, a->held) - a->level) / a->scale);
}

/* the same, each for itself: limits of responses, what is used, what is held */
static void constraints(const void *context, const fw_study_sample *sample, double *c,
                        bool *untold) {
    const aim *a = context;
    const double used = isnan(sample->used) ? (double)NAN : log(fmax(sample->used, 1e-6));
    c += fw_study_limits(a->s->study, sample, c);
    *c++ = used;
    if (a->held) *c = (goal_of(sample, a->held) - a->level) / a->scale;
    *untold = isnan(used) || (sample->decision != 0 && sample->used <= fw_study_beyond);
}

static int constraints_of(const aim *a) {
    return fw_study_limits(a->s->study, NULL, NULL) + 1 + (a->held != NULL);
}

/* ---- the first look ---- */

static fw_status listed_texts(const fw_study *study, long combination, fw_study_sample *sample) {
    for (int k = study->nvary; k-- > 0;) {
        const fw_study_input *in = &study->input[k];
        if (in->ntext == 0) continue;
        FW_TRY(fw_study_input_step(in, (int)(combination % in->ntext), sample->text[k],
                                   &sample->value[k]));
        combination /= in->ntext;
    }
    return FW_OK;
}

/* sample 0: as it stands where that is within the ranges, else their middles */
static fw_status fill(void *context, long k, fw_study_sample *sample, bool *wanted) {
    sizing *s = context;
    const fw_study *study = s->study;
    long point = k / s->lists;
    *wanted = true;
    sample->i = k;
    FW_TRY(listed_texts(study, k % s->lists, sample));
    for (int v = 0; v < study->nvary; v++) {
        const fw_study_input *in = &study->input[v];
        if (in->ntext > 0) continue;
        bool now = point == 0 && in->now >= in->from && in->now <= in->to;
        if (now)
            FW_TRY(fw_study_input_write(in, in->now, 12, sample->text[v], &sample->value[v]));
        else
            FW_TRY(fw_study_input_at(
                in,
                point == 0 ? 0.5
                           : fw_chance_sobol_uniform(&s->sobol, (uint64_t)point - 1, (size_t)v),
                DIGITS, sample->text[v], &sample->value[v]));
    }
    return FW_OK;
}

static fw_status take(void *context, const fw_study_sample *sample) {
    sizing *s = context;
    /* rows of the store have no texts of ranged values: written again from their number */
    bool wanted;
    fw_study_sample *to = &s->kept[s->nkept++];
    fw_study_sample_copy(s->study, sample, to);
    return fill(s, sample->i, to, &wanted);
}

/* ---- what is found ---- */

/* the best for an aim; -1: nothing was run */
static int best_for(const sizing *s, const aim *a) {
    int best = FW_NONE;
    for (int i = 0; i < s->nkept; i++) {
        const fw_study_sample *k = &s->kept[i], *b = best == FW_NONE ? NULL : &s->kept[best];
        if (k->run && (!b || fw_study_search_better(objective(a, k), constraint(a, k),
                                                    objective(a, b), constraint(a, b))))
            best = i;
    }
    return best;
}

static int best_of(const sizing *s, const goal *g) {
    const aim a = {.s = s, .goal = g};
    return best_for(s, &a);
}

static fw_study_search search_of(const aim *a, int most, long *first) {
    *first += PART;
    return (fw_study_search){.objective = objective,
                             .nconstraint = constraints_of(a),
                             .constraint = constraints,
                             .context = a,
                             .most = most,
                             .digits = DIGITS,
                             .first = *first - PART};
}

/* starts of searches for an aim: the best of what was judged, each a tenth of a range from the others */
static fw_status starts(sizing *s, const aim *a, fw_study_search *search, int *n, int most,
                        long *first) {
    const fw_study_sample *chosen[STARTS];
    for (*n = 0; *n < STARTS;) {
        const fw_study_sample *best = NULL;
        double f = (double)NAN, c = (double)NAN;
        for (int i = 0; i < s->nkept; i++) {
            const fw_study_sample *k = &s->kept[i];
            bool apart = k->run;
            for (int j = 0; j < *n && apart; j++)
                apart = fw_study_search_apart(s->study, k, chosen[j]) > 0.1;
            if (!apart) continue;
            double fk = objective(a, k), ck = isnan(fk) ? (double)NAN : constraint(a, k);
            if (!best || fw_study_search_better(fk, ck, f, c)) best = k, f = fk, c = ck;
        }
        if (!best) break;
        chosen[*n] = best;
        fw_study_search *one = &search[(*n)++];
        *one = search_of(a, most, first);
        FW_TRY(fw_study_search_from(s->study, best, one));
    }
    return FW_OK;
}

/* one more search, from all that was judged: the first look (nfirst), and by these searches (n), which left it devices */
static fw_status go_on(sizing *s, const aim *a, const fw_study_search *search, int n, int nfirst,
                       int most, long *first) {
    int from = best_for(s, a), left = SEARCHES * most;
    for (int i = 0; i < n; i++)
        left -= search[i].used;
    if (from == FW_NONE || left <= 0) return FW_OK;
    fw_study_search one = search_of(a, left, first);
    FW_TRY(fw_study_search_from(s->study, &s->kept[from], &one));
    FW_TRY(fw_study_search_knows(s->study, &one, s->kept, nfirst, search, n));
    FW_TRY(fw_study_search_run(s->study, &one, 1));
    if (one.used > 0 && one.best.run) s->kept[s->nkept++] = one.best;
    return FW_OK;
}

/* devices that a local search begins with and its first step: with fewer one search from all that was judged has them */
static int simplex(const fw_study *study) {
    return study->nvary + 1;
}

/* searches for one aim; all that they found joins what was judged */
static fw_status seek(sizing *s, aim *a, int most, long *first) {
    fw_study_search *search = fw_arena_array(s->study->arena, fw_study_search, STARTS);
    int n;
    FW_NEED(search);
    FW_TRY(starts(s, a, search, &n, most, first));
    if (most < simplex(s->study)) n = 0;
    FW_TRY(fw_study_search_run(s->study, search, n));
    const int nfirst = s->nkept;
    for (int i = 0; i < n; i++)
        if (search[i].used > 0 && search[i].best.run) s->kept[s->nkept++] = search[i].best;
    return go_on(s, a, search, n, nfirst, most, first);
}

/* devices that hold every limit and that no other one beats in both goals, by the first */
static fw_status front(sizing *s) {
    const fw_study *study = s->study;
    fw_study_result *r = s->result;
    FW_NEED(r->found = fw_arena_array(study->arena, fw_study_found, FRONT_MOST));
    double after = -HUGE_VAL;
    while (r->nfound < FRONT_MOST) {
        int next = FW_NONE;
        for (int i = 0; i < s->nkept; i++) {
            const fw_study_sample *k = &s->kept[i];
            double c = constraint_of(study, k), f0 = goal_of(k, &s->goal[0]);
            bool beaten = !(c <= 0) || !(f0 > after);
            for (int j = 0; j < s->nkept && !beaten; j++) {
                const fw_study_sample *o = &s->kept[j];
                double d0 = goal_of(o, &s->goal[0]) - f0,
                       d1 = goal_of(o, &s->goal[1]) - goal_of(k, &s->goal[1]);
                beaten = constraint_of(study, o) <= 0 && d0 <= 0 && d1 <= 0 && (d0 < 0 || d1 < 0);
            }
            if (!beaten && (next == FW_NONE || f0 < goal_of(&s->kept[next], &s->goal[0]))) next = i;
        }
        if (next == FW_NONE) break;
        after = goal_of(&s->kept[next], &s->goal[0]);
        FW_TRY(fw_study_keep_found(s->study, &s->kept[next], constraint_of(study, &s->kept[next]),
                                   &r->found[r->nfound++]));
    }
    return FW_OK;
}

static fw_status finish(sizing *s) {
    fw_study_result *r = s->result;
    int best = best_of(s, &s->goal[0]);
    if (best == FW_NONE) return FW_OK;
    double c = constraint_of(s->study, &s->kept[best]);
    if (!(c <= 0)) return fw_study_keep_found(s->study, &s->kept[best], c, &r->nearest);
    if (s->ngoal == 2) return front(s);
    FW_NEED(r->found = fw_arena_one(s->study->arena, fw_study_found));
    r->nfound = 1;
    return fw_study_keep_found(s->study, &s->kept[best], c, r->found);
}

/* ---- at a wanted yield ---- */

static const double still =
    2e-3; /* ln by which a die may be worse than those that a search has looked at */
static const double interval_adds = 1.1; /* to a share, of 3000 dies of which a hundredth fails */
static const double few_leave = 0.75;    /* of what may fail, so that few dies are enough */
static const double near_enough = 0.03;  /* standard deviations: what estimates differ by */

/* the worst die of each flow at this distance from sample b; *worse: some are worse than the search has seen */
static fw_status look_for_dies(sizing *s, fw_study *dies, bool *worse) {
    *worse = false;
    for (int flow = 0; flow < dies->plan->nflow; flow++) {
        fw_study_die die;
        int of = 0, oldest = FW_NONE;
        FW_TRY(fw_study_dies_worst(dies, flow, s->beta, s->study->arena, &die));
        if (!(die.ln > still)) continue;
        *worse = true;
        for (int k = 0; k < s->ndie; k++)
            if (s->die[k].flow == flow) {
                if (of++ == 0) oldest = k;
            }
        if (of == DIES) { /* the order stays: those behind move up */
            memmove(&s->die[oldest], &s->die[oldest + 1],
                    (size_t)(s->ndie - oldest - 1) * sizeof *s->die);
            s->ndie--;
        }
        s->die[s->ndie++] = die;
    }
    return FW_OK;
}

/* farther out, or nearer, the same way */
static void move_dies(sizing *s, double beta) {
    for (int k = 0; k < s->ndie; k++)
        for (size_t d = 0; d < s->die[k].dimensions; d++)
            s->die[k].u[d] *= beta / s->beta;
    s->beta = beta;
}

/* the most over the flows of the shares that fail, with what an interval of a whole estimate will add */
static fw_status failing(fw_study *dies, double *most) {
    *most = 0;
    for (int flow = 0; flow < dies->plan->nflow; flow++) {
        double of;
        FW_TRY(fw_study_dies_failing(dies, flow, &of));
        *most = fmax(*most, interval_adds * of);
    }
    return FW_OK;
}

/* how much farther out dies have to lie that so many less fail */
static double farther(double fail, double allowed) {
    return fw_maths_normal_quantile(fmin(fmax(fail, 1e-7), 1 - 1e-7)) -
           fw_maths_normal_quantile(allowed);
}

/* a search with the dies that are there, from sample b, which becomes the best that it met */
static fw_status search_with_dies(sizing *s, const aim *a, int most, long *first, int *b) {
    fw_study_search one = search_of(a, s->left < most ? (int)s->left : most, first);
    one.besides = besides;
    if (one.most <= 0) return FW_OK;
    FW_TRY(fw_study_search_from(s->study, &s->kept[*b], &one));
    FW_TRY(fw_study_search_run(s->study, &one, 1));
    s->left -= one.used;
    if (one.used > 0 && one.best.run) {
        s->kept[s->nkept] = one.best;
        *b = s->nkept++;
    }
    return FW_OK;
}

typedef struct confirmed { /* the best device that is enough by a first estimate */
    int at;                /* of kept; FW_NONE: none */
    int estimated;         /* devices */
    bool over;
} confirmed;

/* sample b, whose dies at beta hold: by how many fail other dies are looked at, or it is the answer */
static fw_status estimate_of(sizing *s, fw_study *dies, const aim *a, int b, confirmed *c) {
    const double allowed = s->allowed;
    double fail;
    FW_TRY(failing(dies, &fail));
    c->estimated++;
    const double more = farther(fail, allowed);
    const bool enough = fail <= allowed;
    if (enough && (c->at == FW_NONE || objective(a, &s->kept[b]) < objective(a, &s->kept[c->at])))
        c->at = b;
    c->over = c->estimated == ESTIMATED || (enough && (s->ndie == 0 || more > -near_enough));
    /* halfway into what is near enough, so that the next one is not short of it by a hair */
    if (!c->over) move_dies(s, fmax(s->beta + more + 0.5 * near_enough, 0.1));
    return FW_OK;
}

static fw_status round_at_yield(sizing *s, const aim *a, int most, long *first, int *b,
                                confirmed *c) {
    fw_study *dies;
    bool worse = false;
    fw_status status = s->study->open_dies(s->study, &s->kept[*b], &dies);
    if (status == FW_OK) status = look_for_dies(s, dies, &worse);
    if (status == FW_OK && !worse) status = estimate_of(s, dies, a, *b, c);
    s->study->close_dies(s->study, dies, status);
    FW_TRY(status);
    return c->over || s->ndie == 0 ? FW_OK : search_with_dies(s, a, most, first, b);
}

/* the yield by at most so many dies for each end of what is only assumed */
static fw_status estimate_by(fw_study *dies, int most) {
    fw_study_result *result = fw_arena_one(dies->arena, fw_study_result);
    fw_device_study *asked = fw_arena_one(dies->arena, fw_device_study);
    FW_NEED(result && asked ? result : NULL);
    *asked = *dies->asked;
    if (asked->samples > most) asked->samples = most;
    dies->asked = asked;
    dies->result = result;
    return fw_study_kind_yield(dies, result);
}

/* the yield of what is returned, with its intervals, stays as long as the study; *low: its lower end */
static fw_status confirm_by(sizing *s, const fw_study_sample *sample, int most, double *low) {
    fw_study *study = s->study, *dies;
    fw_status status = study->open_dies(study, sample, &dies);
    if (status == FW_OK) status = estimate_by(dies, most);
    if (status != FW_OK) {
        study->close_dies(study, dies, status);
        return status;
    }
    study->close_dies(study, study->dies, FW_OK);
    study->dies = dies;
    s->result->yield = dies->result->yield;
    s->result->nyield = dies->result->nyield;
    *low = 1;
    for (int i = 0; i < s->result->nyield; i++)
        *low = fmin(*low, s->result->yield[i].low);
    return FW_OK;
}

/* A device of which hardly a die fails shows that by few of them. These are enough only where they leave a quarter of what
   may fail: of a device that has just the wanted yield none of 600 fails in one case of 400, so that a second look leaves
   the level of the interval nearly what it is. Test: test_sizing.py, test_few_dies_are_enough_where_hardly_one_fails */
static fw_status confirm(sizing *s, const fw_study_sample *sample, double *low) {
    const double fails = 1 - s->study->asked->yield;
    FW_TRY(confirm_by(s, sample, (int)fmax(ceil(6 / fails), FW_CHANCE_BUDGET_LEAST), low));
    if (1 - *low <= few_leave * fails) return FW_OK;
    return confirm_by(s, sample, INT_MAX, low);
}

/* the best by first estimates: *b */
static fw_status rounds(sizing *s, const aim *a, int most, long *first, int *b) {
    confirmed c = {.at = FW_NONE};
    for (int k = 0; k < ROUNDS && !c.over; k++)
        FW_TRY(round_at_yield(s, a, most, first, b, &c));
    if (c.at != FW_NONE) *b = c.at;
    return FW_OK;
}

static fw_status at_yield(sizing *s, int most, long *first) {
    fw_study_result *r = s->result;
    const aim a = {.s = s, .goal = &s->goal[0]};
    const double wanted = s->study->asked->yield;
    int b = best_of(s, &s->goal[0]);
    if (b == FW_NONE) return FW_OK;
    double missed = constraint_of(s->study, &s->kept[b]), low;
    if (!(missed <= 0)) return fw_study_keep_found(s->study, &s->kept[b], missed, &r->nearest);
    s->beta = fw_maths_normal_quantile(wanted);
    s->allowed = 1 - wanted;
    s->left = (long)USUAL_ROUNDS * most;
    FW_NEED(s->die = fw_arena_array(s->study->arena, fw_study_die,
                                    (size_t)(DIES * (s->study->plan->nflow + 1))));
    for (int k = 0; k < CONFIRMED; k++) {
        FW_TRY(rounds(s, &a, most, first, &b));
        FW_TRY(confirm(s, &s->kept[b], &low));
        missed = constraint_of(s->study, &s->kept[b]);
        if (low >= wanted && missed <= 0) {
            FW_NEED(r->found = fw_arena_one(s->study->arena, fw_study_found));
            r->nfound = 1;
            return fw_study_keep_found(s->study, &s->kept[b], missed, r->found);
        }
        const double more = fmax(farther(1 - low, 1 - wanted), 0) + near_enough;
        move_dies(s, s->beta + more);
        s->allowed = fw_maths_normal_cdf(fw_maths_normal_quantile(s->allowed) - more);
    }
    return fw_study_keep_found(s->study, &s->kept[b], fmax(missed, still), &r->nearest);
}

static fw_status two_goals(sizing *s, int most, long *first) {
    const goal *a = &s->goal[0], *b = &s->goal[1];
    int low = best_of(s, b), high = best_of(s, a);
    if (low == FW_NONE || high == FW_NONE) return FW_OK;
    double from = goal_of(&s->kept[low], b), to = goal_of(&s->kept[high], b);
    if (!(to > from)) return FW_OK; /* one device is best for both */
    for (int k = 1; k <= LEVELS; k++) {
        aim *held = fw_arena_one(s->study->arena, aim);
        FW_NEED(held);
        *held = (aim){.s = s, .goal = a, .held = b, .scale = to - from};
        held->level = from + (to - from) * k / (LEVELS + 1.0);
        FW_TRY(seek(s, held, most, first));
    }
    return FW_OK;
}

/* combinations of listed values; *at: the input by which they are too many, else FW_NONE */
static long count_lists(const fw_study *study, int *at) {
    long lists = 1;
    *at = FW_NONE;
    for (int k = 0; k < study->nvary && *at == FW_NONE; k++) {
        if (study->input[k].ntext > 0) lists *= study->input[k].ntext;
        if (lists > LISTS_MOST) *at = k;
    }
    return lists;
}

fw_status fw_study_check_size(fw_study *study) {
    int at;
    count_lists(study, &at);
    if (at == FW_NONE) return FW_OK;
    return fw_diag_error(&study->diags, 490, study->input[at].place,
                         "more than %d combinations of listed values; each is tried, so "
                         "list fewer, or give ranges",
                         (int)LISTS_MOST);
}

static int searches_of(const fw_study *study, int goals) {
    return goals == 2                ? (2 + LEVELS) * SEARCHES
           : study->asked->yield > 0 ? SEARCHES + USUAL_ROUNDS
                                     : SEARCHES;
}

long fw_study_count_size(const fw_study *study) {
    long n = 0, lists = 1;
    int goals = 0;
    if (study->asked->samples > 0) return study->asked->samples;
    for (int k = 0; k < study->nvary; k++) {
        const fw_study_input *in = &study->input[k];
        n += in->ntext == 0;
        if (in->ntext > 0 && lists <= LISTS_MOST) lists *= in->ntext;
    }
    for (int k = 0; k < study->nresponse; k++)
        goals += study->response[k].asked->goal != FW_GOAL_NONE;
    return (n == 0 ? 1 : 1 + 4 * n) * lists + EACH * (n + 1) * searches_of(study, goals);
}

static fw_status prepare(sizing *s, int *most) {
    fw_study *study = s->study;
    int n = 0, at;
    for (int k = 0; k < study->nresponse; k++) {
        fw_device_respond_goal g = study->response[k].asked->goal;
        if (g != FW_GOAL_NONE) s->goal[s->ngoal++] = (goal){k, g == FW_GOAL_MINIMISE ? 1 : -1};
    }
    for (int k = 0; k < study->nvary; k++)
        n += study->input[k].ntext == 0;
    s->lists = count_lists(study, &at);
    long budget = fw_study_count_size(study), searches = searches_of(study, s->ngoal);
    s->first_n = (n == 0 ? 1 : 1 + 4 * n) * s->lists;
    if (s->first_n > budget) s->first_n = budget;
    *most = n == 0 ? 0 : (int)((budget - s->first_n) / searches);
    size_t room = (size_t)s->first_n + 2 * (size_t)searches + CONFIRMED * ROUNDS;
    FW_NEED(s->kept = fw_arena_array(study->arena, fw_study_sample, room));
    for (long i = 0; i < s->first_n; i++)
        FW_TRY(fw_study_sample_new(study->arena, study, &s->kept[i]));
    return fw_chance_sobol_new(study->arena, (size_t)study->nvary, (uint64_t)study->asked->seed,
                               &s->sobol);
}

static fw_status size(fw_study *study, fw_study_result *result) {
    sizing s = {.study = study, .result = result};
    int most;
    long first = PART;
    FW_TRY(prepare(&s, &most));
    const fw_study_work work = {.n = s.first_n, .fill = fill, .take = take, .context = &s};
    FW_TRY(fw_study_pool_run(study, &work));
    fw_study_sort_samples(s.kept, s.nkept); /* they came in any order */
    for (int g = 0; g < s.ngoal && most > 0; g++) {
        aim *a = fw_arena_one(study->arena, aim);
        FW_NEED(a);
        *a = (aim){.s = &s, .goal = &s.goal[g]};
        FW_TRY(seek(&s, a, most, &first));
    }
    if (s.ngoal == 2 && most > 0) FW_TRY(two_goals(&s, most, &first));
    FW_NEED(
        result->how = fw_arena_printf(
            study->arena,
            "%ld devices over the ranges, then local searches (COBYLA) from the best of them, at "
            "most %d devices each%s, and one from all of them (quadratic models)%s; a better one "
            "may be where none was tried",
            s.first_n, most, most < simplex(study) ? " (too few: left out)" : "",
            study->asked->yield > 0
                ? ", the last ones with the dies that are worst for the best device"
                : ""));
    return study->asked->yield > 0 ? at_yield(&s, most, &first) : finish(&s);
}

/* At a wanted yield nobody knows how many dies will be asked for; else no more is judged than the budget */
fw_status fw_study_kind_size(fw_study *study, fw_study_result *result) {
    fw_study_told told = {.most = study->asked->yield > 0 ? 0 : fw_study_count_size(study),
                          .begun_s = fw_study_now_s(),
                          .thread = pthread_self()};
    study->told = &told;
    fw_status status = size(study, result);
    study->told = NULL;
    return status;
}
