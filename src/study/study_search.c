/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What sizes need beside their searches: fronts of two goals, combinations of listed values, what may be judged; and

   sizes at a wanted yield. A device has to hold every limit also as the dies that lie a distance beta from what is intended in the
   direction that is worst for it (sequential optimisation and reliability assessment: X. Du, W. Chen, J. Mech. Des. 126
   (2004) 225). Dies are found for the best device, searches follow with these, until none is worse; then its yield is
   estimated, and beta follows what that says, since a limit that bends, or several of them, have another yield than a plane
   at that distance. Every device that was judged stays a candidate: the next one is the best of them all that holds these
   dies, and one that was estimated and is short of the yield is none any more. What is returned is a device whose yield was
   estimated so. Test: tests/cli/test_study.py, tests/cli/test_sizing.py */
#include "base/sort.h"
#include "maths/functions.h"
#include "study/study_parts.h"
#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum {
    ROUNDS = 12,     /* searches, in one go */
    ESTIMATED = 5,   /* devices whose yield is estimated by few dies, in one go */
    CONFIRMED = 3,   /* devices whose yield is estimated in full, until one is enough */
    ROBUST = 3,      /* and then of those that are farthest from their limits */
    DIES = 4,        /* of a flow that searches look at; the last ones found */
    LOOKS = 16,      /* candidates that are looked at with the dies, to choose one */
    FRONT_MOST = 100 /* devices of a front that are listed */
};
static const double still = 2e-3;        /* ln by which a die may be worse than those looked at */
static const double interval_adds = 1.1; /* to a share, of 3000 dies of which a hundredth fails */
static const double few_leave = 0.75;    /* of what may fail, so that few dies are enough */
static const double near_enough = 0.03;  /* standard deviations: what estimates differ by */

typedef struct candidate { /* a device that was accepted */
    const fw_study_sample *sample;
    double f;    /* its objective */
    double ln;   /* of what it uses as the dies up to number `seen`, at a distance `beta` */
    double beta; /* 0: as it is intended */
    int seen;    /* dies */
    double fail; /* the share that fails by a first estimate; NaN: there is none */
    double low;  /* lower end of its yield by a whole one; NaN: there is none */
} candidate;

typedef struct robust {
    fw_study *study;
    fw_study_result *result;
    fw_study_search like;
    candidate *candidate;
    int n;
    fw_study_die *die; /* (ndie) that a device has to hold as well */
    int ndie, found;   /* found: so far, also those that were dropped */
    double beta;       /* how far they lie */
    double slope;      /* by which ln rises with the distance */
    double wanted;
    double
        allowed; /* the share that may fail by a first estimate; less after a whole one was not enough */
    long left; /* devices that searches may still judge */
    int shown; /* the candidate whose yield stands in the result; FW_NONE */
} robust;

/* what the dies use counts as what the device uses */
static fw_status besides(const void *beside, fw_study_sample *sample) {
    const robust *s = beside;
    double most = log(sample->used);
    for (int k = 0; k < s->ndie && !isnan(most); k++) {
        double ln;
        FW_TRY(fw_study_dies_at(s->study->dies, s->study, sample, &s->die[k], &ln));
        most = isnan(ln) ? (double)NAN : fmax(most, ln);
    }
    sample->used = exp(most);
    return FW_OK;
}

static bool same_device(const fw_study *study, const fw_study_sample *a, const fw_study_sample *b) {
    for (int k = 0; k < study->nvary; k++)
        if (strcmp(a->text[k], b->text[k]) != 0) return false;
    return true;
}

/* once each; as_dies: what it uses is that of the dies as well */
static void add(robust *s, const fw_study_sample *sample, bool as_dies) {
    if (!sample->run || sample->decision != 0 || !(fw_study_excess(s->study, sample) <= 0)) return;
    int at = 0;
    while (at < s->n && !same_device(s->study, s->candidate[at].sample, sample))
        at++;
    candidate *c = &s->candidate[at];
    if (at == s->n) {
        *c = (candidate){.sample = sample, .fail = (double)NAN, .low = (double)NAN};
        c->ln = log(sample->used), c->f = s->like.objective(s->like.context, sample);
        if (isnan(c->f)) return;
        s->n++;
    }
    if (as_dies)
        c->ln = isnan(sample->used) ? HUGE_VAL : log(sample->used), c->beta = s->beta,
        c->seen = s->found;
}

static bool is_known(const robust *s, const candidate *c) {
    return s->found == 0 || (c->beta == s->beta && c->seen == s->found);
}

/* what it will use as the dies, by what it uses at another distance */
static double expected(const robust *s, const candidate *c) {
    return c->ln + s->slope * (s->beta - c->beta);
}

static fw_status look_at(robust *s, candidate *c) {
    if (c->beta != s->beta) c->seen = 0, c->ln = -HUGE_VAL;
    for (int k = 0; k < s->ndie; k++) {
        double ln;
        if (s->die[k].number < c->seen) continue;
        FW_TRY(fw_study_dies_at(s->study->dies, s->study, c->sample, &s->die[k], &ln));
        c->ln = isnan(ln) ? HUGE_VAL : fmax(c->ln, ln);
    }
    c->beta = s->beta, c->seen = s->found;
    return FW_OK;
}

/* its yield was estimated, and is short of what is wanted */
static bool is_short(const robust *s, const candidate *c) {
    return c->low < s->wanted || c->fail > s->allowed;
}

/* the best candidate that holds as all dies; FW_NONE: none does, of those that were looked at */
static fw_status best_that_holds(robust *s, int *best) {
    for (int looks = 0; looks <= LOOKS; looks++) {
        *best = FW_NONE;
        for (int i = 0; i < s->n; i++) {
            const candidate *c = &s->candidate[i];
            if (is_short(s, c) || !(expected(s, c) <= still)) continue;
            if (looks == LOOKS && !is_known(s, c)) continue;
            if (*best == FW_NONE || c->f < s->candidate[*best].f) *best = i;
        }
        if (*best == FW_NONE || is_known(s, &s->candidate[*best])) return FW_OK;
        FW_TRY(look_at(s, &s->candidate[*best]));
    }
    return FW_OK;
}

/* the candidate that uses least as the dies, of those without a whole estimate; FW_NONE: all have one */
static fw_status most_robust(robust *s, int *best) {
    for (int looks = 0; looks <= LOOKS; looks++) {
        *best = FW_NONE;
        for (int i = 0; i < s->n; i++) {
            const candidate *c = &s->candidate[i];
            if (isnan(c->low) &&
                (*best == FW_NONE || expected(s, c) < expected(s, &s->candidate[*best])))
                *best = i;
        }
        if (*best == FW_NONE || is_known(s, &s->candidate[*best])) return FW_OK;
        FW_TRY(look_at(s, &s->candidate[*best]));
    }
    return FW_OK;
}

/* the best of those that are enough by a first estimate; FW_NONE */
static int best_enough(const robust *s) {
    int best = FW_NONE;
    for (int i = 0; i < s->n; i++) {
        const candidate *c = &s->candidate[i];
        if (c->fail <= s->allowed && !is_short(s, c) &&
            (best == FW_NONE || c->f < s->candidate[best].f))
            best = i;
    }
    return best;
}

/* the oldest die of its flow makes room for it */
static void take_die(robust *s, const fw_study_die *die) {
    int of = 0, oldest = FW_NONE;
    for (int k = 0; k < s->ndie; k++)
        if (s->die[k].flow == die->flow && of++ == 0) oldest = k;
    if (of == DIES) { /* the order stays: those behind move up */
        memmove(&s->die[oldest], &s->die[oldest + 1],
                (size_t)(s->ndie - oldest - 1) * sizeof *s->die);
        s->ndie--;
    }
    s->die[s->ndie] = *die;
    s->die[s->ndie++].number = s->found++;
}

/* the worst die of each flow at this distance; *worse: some are worse than the search has seen */
static fw_status look_for_dies(robust *s, fw_study *dies, candidate *c, bool *worse) {
    double most = -HUGE_VAL;
    *worse = false;
    for (int flow = 0; flow < dies->plan->nflow; flow++) {
        fw_study_die die;
        FW_TRY(fw_study_dies_worst(dies, flow, s->beta, s->study->arena, &die));
        const double slope = (die.ln - die.intended) / s->beta;
        if (isfinite(slope)) s->slope = fmax(s->slope, slope);
        most = fmax(most, die.ln);
        if (die.ln > still) *worse = true, take_die(s, &die);
    }
    c->ln = most, c->beta = s->beta, c->seen = s->found;
    return FW_OK;
}

/* farther out, or nearer, the same way */
static void move_dies(robust *s, double beta) {
    for (int k = 0; k < s->ndie; k++)
        for (size_t d = 0; d < s->die[k].dimensions; d++)
            s->die[k].u[d] *= beta / s->beta;
    s->beta = beta;
}

/* what an interval of a whole estimate will add to a share that fails: of few dies they are merely counted, in sixteen
   scramblings of as many points as the next power of two below has */
static double with_interval(double share, double dies) {
    double n = 16;
    if (dies >= FW_STUDY_DIES_RARE) return interval_adds * share;
    while (2 * n <= dies)
        n *= 2;
    return share + fw_maths_normal_quantile(0.975) * sqrt(share * (1 - share) / n);
}

/* the most over the flows of the shares that fail */
static fw_status failing(fw_study *dies, double *most) {
    *most = 0;
    for (int flow = 0; flow < dies->plan->nflow; flow++) {
        double of;
        FW_TRY(fw_study_dies_failing(dies, flow, &of));
        *most = fmax(*most, with_interval(of, (double)dies->asked->samples));
    }
    return FW_OK;
}

/* how much farther out dies have to lie that so many less fail */
static double farther(double fail, double allowed) {
    return fw_maths_normal_quantile(fmin(fmax(fail, 1e-7), 1 - 1e-7)) -
           fw_maths_normal_quantile(allowed);
}

/* A search with the dies that are there. All that it judges are candidates. */
static fw_status search_with_dies(robust *s, const fw_study_sample *from) {
    fw_study_search next = s->like;
    if (next.most > s->left) next.most = (int)s->left;
    next.besides = besides, next.beside = s;
    FW_TRY(fw_study_search_from(s->study, from, &next));
    FW_TRY(fw_study_search_run(s->study, &next, 1));
    s->like.first += FW_STUDY_SEARCH_PART;
    s->left -= next.used;
    for (int k = 0; k < next.used; k++)
        add(s, &next.all[k], true);
    return FW_OK;
}

/* A candidate whose dies hold: by how many fail the next ones are looked for farther out or nearer. One that is not at its
   limit at this distance is at it farther out, and what its estimate says is of there. */
static fw_status estimate_of(robust *s, fw_study *dies, candidate *c, bool *near) {
    const double at = s->slope > 0 ? s->beta + fmin(fmax(-c->ln, 0) / s->slope, 3) : s->beta;
    FW_TRY(failing(dies, &c->fail));
    const double more = farther(c->fail, s->allowed);
    *near = c->fail <= s->allowed && more > -near_enough;
    /* halfway into what is near enough, so that the next one is not short of it by a hair */
    if (!*near) move_dies(s, fmax(at + more + 0.5 * near_enough, 0.1));
    return FW_OK;
}

static fw_status round_at_yield(robust *s, int *estimated, bool *over) {
    int b, from;
    FW_TRY(best_that_holds(s, &b));
    if (s->ndie > 0 && s->like.most > 0 && s->left > 0) {
        from = b;
        if (b == FW_NONE) FW_TRY(most_robust(s, &from));
        if (from != FW_NONE) FW_TRY(search_with_dies(s, s->candidate[from].sample));
        FW_TRY(best_that_holds(s, &b));
    }
    const int enough = best_enough(s);
    if (b == FW_NONE) *over = enough != FW_NONE || s->like.most <= 0 || s->left <= 0;
    if (b != FW_NONE && enough != FW_NONE && !(s->candidate[b].f < s->candidate[enough].f))
        *over = true;
    if (b == FW_NONE || *over) return FW_OK;
    fw_study *dies;
    bool worse = false, near = false;
    fw_status status = s->study->open_dies(s->study, s->candidate[b].sample, &dies);
    if (status == FW_OK) status = look_for_dies(s, dies, &s->candidate[b], &worse);
    if (status == FW_OK && !worse) {
        status = estimate_of(s, dies, &s->candidate[b], &near);
        *over = ++*estimated == ESTIMATED || near || s->ndie == 0;
    }
    s->study->close_dies(s->study, dies, status);
    return status;
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

/* the best so far stays as long as the study, with its intervals; *high: its upper end */
static fw_status confirm_by(robust *s, int at, int most, double *high) {
    fw_study *study = s->study, *dies;
    candidate *c = &s->candidate[at];
    fw_status status = study->open_dies(study, c->sample, &dies);
    if (status == FW_OK) status = estimate_by(dies, most);
    if (status != FW_OK) {
        study->close_dies(study, dies, status);
        return status;
    }
    c->low = *high = 1;
    for (int i = 0; i < dies->result->nyield; i++) {
        c->low = fmin(c->low, dies->result->yield[i].low);
        *high = fmin(*high, dies->result->yield[i].high);
    }
    if (s->shown != FW_NONE && s->shown != at && !(c->low > s->candidate[s->shown].low)) {
        study->close_dies(study, dies, FW_OK);
        return FW_OK;
    }
    study->close_dies(study, study->dies, FW_OK);
    study->dies = dies;
    s->shown = at;
    s->result->yield = dies->result->yield;
    s->result->nyield = dies->result->nyield;
    return FW_OK;
}

/* A device of which hardly a die fails shows that by few of them. These are enough only where they leave a quarter of what
   may fail: of a device that has just the wanted yield none of 600 fails in one case of 400, so that a second look leaves
   the level of the interval nearly what it is. Few are enough, too, where even the upper end is short of what is wanted.
   Test: test_sizing.py, test_few_dies_are_enough_where_hardly_one_fails */
static fw_status confirm(robust *s, int at) {
    const double fails = 1 - s->wanted;
    double high;
    s->result->estimated++;
    FW_TRY(confirm_by(s, at, (int)fmax(ceil(6 / fails), FW_CHANCE_BUDGET_LEAST), &high));
    if (1 - s->candidate[at].low <= few_leave * fails || high < s->wanted) return FW_OK;
    return confirm_by(s, at, INT_MAX, &high);
}

/* the best by first estimates, or what is farthest from its limits; FW_NONE: all were estimated */
static fw_status rounds(robust *s, int *at) {
    int estimated = 0;
    bool over = false;
    for (int k = 0; k < ROUNDS && !over; k++)
        FW_TRY(round_at_yield(s, &estimated, &over));
    *at = best_enough(s);
    return *at != FW_NONE ? FW_OK : most_robust(s, at);
}

static fw_status confirm_some(robust *s) {
    for (int k = 0; k < CONFIRMED + ROBUST; k++) {
        int at;
        if (k < CONFIRMED)
            FW_TRY(rounds(s, &at));
        else
            FW_TRY(most_robust(s, &at));
        if (at == FW_NONE) return FW_OK;
        candidate *c = &s->candidate[at];
        FW_TRY(confirm(s, at));
        if (c->low >= s->wanted) return FW_OK;
        if (!(c->fail <= s->allowed)) continue;
        /* the first estimate was off by so much */
        const double more = fmax(farther(1 - c->low, 1 - s->wanted), 0) + near_enough;
        move_dies(s, s->beta + more);
        s->allowed = fw_maths_normal_cdf(fw_maths_normal_quantile(s->allowed) - more);
    }
    return FW_OK;
}

fw_status fw_study_at_yield(fw_study *study, const fw_study_search *like,
                            const fw_study_sample *judged, int n, fw_study_result *result) {
    const double wanted = study->asked->yield;
    robust s = {.study = study,
                .result = result,
                .like = *like,
                .wanted = wanted,
                .beta = fw_maths_normal_quantile(wanted),
                .allowed = 1 - wanted,
                .left = (long)FW_STUDY_ROUNDS_USUAL * like->most,
                .shown = FW_NONE};
    FW_NEED(s.candidate = fw_arena_array(study->arena, candidate, (size_t)n + (size_t)s.left + 1));
    FW_NEED(s.die = fw_arena_array(study->arena, fw_study_die,
                                   (size_t)(DIES * (study->plan->nflow + 1))));
    for (int i = 0; i < n; i++)
        add(&s, &judged[i], false);
    FW_TRY(confirm_some(&s));
    result->may_be = s.n;
    if (s.shown == FW_NONE) return FW_OK;
    const candidate *c = &s.candidate[s.shown];
    if (!(c->low >= wanted)) return fw_study_keep_found(study, c->sample, still, &result->nearest);
    FW_NEED(result->found = fw_arena_one(study->arena, fw_study_found));
    result->nfound = 1;
    return fw_study_keep_found(study, c->sample, fmin(log(c->sample->used), 0), result->found);
}

/* ---- two goals ---- */

static int by_goals(const void *a, const void *b) {
    const fw_study_on_front *p = a, *q = b;
    int order = fw_order_doubles(p->f[0], q->f[0]);
    if (!order) order = fw_order_doubles(p->f[1], q->f[1]);
    return order ? order : fw_order_wholes(p->at, q->at);
}

int fw_study_front(fw_study_on_front *p, int n) {
    int all = 0, on = 0;
    for (int i = 0; i < n; i++)
        if (isfinite(p[i].f[0]) && isfinite(p[i].f[1])) p[all++] = p[i];
    qsort(p, (size_t)all, sizeof *p, by_goals);
    for (int i = 0; i < all; i++)
        if (on == 0 || p[i].f[1] < p[on - 1].f[1]) p[on++] = p[i];
    return on;
}

/* Again and again the one goes whose neighbours are nearest to each other, by the sum of both goals in shares of what the
   front covers of them: so they stay where they are sparse, and both ends do. */
int fw_study_front_thinned(fw_study_on_front *p, int n, int most) {
    if (n <= most) return n;
    const double wide = p[n - 1].f[0] - p[0].f[0], high = p[0].f[1] - p[n - 1].f[1];
    for (; n > most; n--) {
        double least = HUGE_VAL;
        int at = 1;
        for (int i = 1; i < n - 1; i++) {
            const double gap =
                (p[i + 1].f[0] - p[i - 1].f[0]) / wide + (p[i - 1].f[1] - p[i + 1].f[1]) / high;
            if (gap < least) least = gap, at = i;
        }
        memmove(&p[at], &p[at + 1], (size_t)(n - at - 1) * sizeof *p);
    }
    return n;
}

/* The front is n devices, `had` levels were tried. A gap counts by the sum of both goals in shares of what the front covers of them,
   and its parts between levels that were tried by their share of it, so that nothing is looked for twice where nothing is. */
int fw_study_front_levels(const fw_study_on_front *p, int n, double *level, int had, int most) {
    const double least = 0.01;
    int all = had;
    for (double widest = HUGE_VAL; n > 1 && widest > 0 && all < had + most;) {
        const double wide = p[n - 1].f[0] - p[0].f[0], high = p[0].f[1] - p[n - 1].f[1];
        widest = 0;
        for (int i = 0; i < n - 1; i++) {
            const double low = p[i + 1].f[1], up = p[i].f[1],
                         gap = (p[i + 1].f[0] - p[i].f[0]) / wide + (up - low) / high;
            for (int from = -1; from < all;
                 from++) { /* parts begin at its end, or at levels in it */
                const double a = from < 0 ? low : level[from];
                double b = up;
                for (int k = 0; k < all; k++)
                    if (level[k] > a) b = fmin(b, level[k]);
                const double part = gap * (b - a) / (up - low);
                if (a < low || a >= up || part <= fmax(widest, least)) continue;
                widest = part, level[all] = 0.5 * (a + b);
            }
        }
        all += widest > 0;
    }
    return all - had;
}

/* of several with the same goals the first one */
fw_status fw_study_front_keep(fw_study *study, const fw_study_sample *sample, fw_study_on_front *p,
                              int n, fw_study_result *result) {
    result->unbeaten = n = fw_study_front(p, n);
    n = fw_study_front_thinned(p, n, FRONT_MOST);
    FW_NEED(result->found = fw_arena_array(study->arena, fw_study_found, (size_t)n + 1));
    for (; result->nfound < n; result->nfound++) {
        const fw_study_on_front *on = &p[result->nfound];
        FW_TRY(fw_study_keep_found(study, &sample[on->at], on->excess,
                                   &result->found[result->nfound]));
    }
    return FW_OK;
}

/* ---- listed values ---- */

long fw_study_lists_count(const fw_study *study, long most, int *at) {
    long lists = 1;
    *at = FW_NONE;
    for (int k = 0; k < study->nvary && *at == FW_NONE; k++) {
        if (study->input[k].ntext > 0) lists *= study->input[k].ntext;
        if (lists > most) *at = k;
    }
    return lists;
}

fw_status fw_study_lists_write(const fw_study *study, long combination, fw_study_sample *sample) {
    for (int k = study->nvary; k-- > 0;) {
        const fw_study_input *in = &study->input[k];
        if (in->ntext == 0) continue;
        FW_TRY(fw_study_input_step(in, (int)(combination % in->ntext), sample->text[k],
                                   &sample->value[k]));
        combination /= in->ntext;
    }
    return FW_OK;
}

fw_status fw_study_check_apart(fw_study *study) {
    if (study->asked->kind != FW_STUDY_IS_size) return FW_OK;
    return fw_diag_error(
        &study->diags, 490, study->asked->place,
        "shards: a study of kind %s chooses each of its samples by the ones before; "
        "run it in one piece, in as many threads as there are (--jobs); or, for several machines, "
        "a study on each "
        "with a part of the ranges, of which the best is the answer",
        fw_device_study_kind_text(study->asked->kind));
}

/* ---- what a size may judge ---- */

fw_status fw_study_check_size(fw_study *study) {
    int at;
    fw_study_lists_count(study, FW_SIZE_LISTS_MOST, &at);
    if (at == FW_NONE) return FW_OK;
    return fw_diag_error(&study->diags, 490, study->input[at].place,
                         "more than %d combinations of listed values; each is tried, so "
                         "list fewer, or give ranges",
                         (int)FW_SIZE_LISTS_MOST);
}

int fw_study_size_searches(const fw_study *study, int goals) {
    return goals == 2                ? (2 + FW_SIZE_LEVELS) * FW_SIZE_SEARCHES
           : study->asked->yield > 0 ? FW_SIZE_SEARCHES + FW_STUDY_ROUNDS_USUAL
                                     : FW_SIZE_SEARCHES;
}

long fw_study_count_size(const fw_study *study) {
    long n = 0, lists = 1;
    int goals = 0;
    if (study->asked->samples > 0) return study->asked->samples;
    for (int k = 0; k < study->nvary; k++) {
        const fw_study_input *in = &study->input[k];
        n += in->ntext == 0;
        if (in->ntext > 0 && lists <= FW_SIZE_LISTS_MOST) lists *= in->ntext;
    }
    for (int k = 0; k < study->nresponse; k++)
        goals += study->response[k].asked->goal != FW_GOAL_NONE;
    return (n == 0 ? 1 : 1 + 4 * n) * lists +
           FW_SIZE_EACH * (n + 1) * fw_study_size_searches(study, goals);
}
