/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Devices that are told and not judged (fitted="0.01" of a sweep).

   With fitted="0.01" most devices are told and not judged. Of those that are judged first, response surfaces
   (chance/joint.h) are made: of the responses, and of what decisions follow from, the ends of the band of every hinge and
   requirement, for each look at them (verdict.h), since a closer look moves all of them at once. A surface is taken to be off
   by at most `margin` times the worst that it misses one of its own devices by with that left out. A look accepts where all upper
   ends, and what they may be off by, are below 1, and rejects where a lower end less that is above 1; between, both may be, and the device
   may go where judged ones that were undecided there went: on to a closer look, or to its end. It is told where all ways that it may go
   end in one decision, and no response is off by more than was asked for,

   and anything else is judged. Devices are judged in rounds, half as many again each, which are told first and then judged:
   only surfaces that told no decision otherwise and no response worse than they said are used (so n devices of the last round
   say, at 95 %, that fewer than 3 / n of those that are told are told wrongly). A device that was decided by something else
   than hinges and requirements, or was not run, ends the study: surfaces know nothing of it (FW-D660). */
#include "chance/random.h"
#include "chance/joint.h"
#include "study/study_parts.h"
#include <math.h>
#include <string.h>

/* ---- devices that are judged, of which surfaces are made ---- */

enum {
    FIRST_LEAST = 96,
    FIRST_EACH = 5, /* devices of the first round, at all and of each term of a plane */
    JUDGED_MOST = 10000,
    JUDGED_NUMBERS = 3000000,     /* of which surfaces are made; of theirs that are kept */
    CHECKED_EACH = 1000,          /* one of so many, */
    CHECKED_MOST = 1000,          /* and no more */
    LOOKED_AT = 2000,             /* points of which it is found how many stay open */
    ENDS = 1 << FW_VERDICT_LOOKS, /* devices that are undecided at a look were looked at no more */
};
static const double margin = 3;

typedef struct judged {   /* (n) in the order in which they were chosen */
    long n, before, most; /* before this round; room */
    long *number;
    double *z, *response, *part;   /* (x d), (x responses), (x LOOKS x ends) */
    int *decision, *nlook, *looks; /* looks (x LOOKS) */
} judged;

typedef struct
    group { /* the largest of a number (FW_PART_...) of parts from..to; number -1: of none */
    int number, from, to;
} group;

typedef struct fitted {
    const fw_study_points *points;
    fw_study *study;
    int d, responses, ends; /* of a point; of a device; of a look */
    judged at;
    fw_study_axes axes;   /* of what is left to chance */
    unsigned char *taken; /* (points->n bits) chosen to be judged */
    fw_study_sample sample;
    fw_arena *fits;                                                       /* of the surfaces */
    fw_chance_surface part[FW_VERDICT_LOOKS], response[FW_VERDICT_LOOKS]; /* of what ended there */
    /* where devices that were undecided at a look went: 1 << of the next one, and ENDS */
    int next[FW_VERDICT_LOOKS];
    group *largest_of; /* (responses) that it is, in every device that was judged */
    double *limit;     /* (responses) of what is told, how far off it may be */
    double *far;       /* (responses) and is */
    double used_far;
    /* room for one point: (terms), (d), (looks x ends), (ends) twice, and (responses) each */
    double *work, *z, *end, *lower, *upper, *value, *least, *most;
    long refused_at; /* a device that surfaces know nothing of, and why; "" : none */
    char refused[FW_STUDY_WHY];
    bool made, held; /* there are surfaces; the former ones told this round as it came */
    double open;     /* share of the others that stays open */
    long open_judged, told, checked; /* of the last round those that had been told */
} fitted;

/* ---- those of which surfaces are made ---- */

static bool is_taken(const fitted *f, long k) {
    return f->taken[k / 8] >> (k % 8) & 1;
}

static fw_status fitted_new(fitted *f, fw_study *study, const fw_study_points *points) {
    fw_arena *arena = study->arena;
    *f = (fitted){.points = points, .study = study, .responses = study->nresponse};
    f->ends = FW_PART_NUMBERS * study->npart;
    FW_TRY(fw_study_sample_new(arena, study, &f->sample));
    FW_TRY(fw_study_axes_find(study, points, &f->sample, &f->axes));
    f->d = study->nvary + f->axes.n;
    const size_t d = (size_t)f->d, r = (size_t)f->responses, e = (size_t)f->ends,
                 each = d + r + FW_VERDICT_LOOKS * e + 8;
    size_t most = JUDGED_NUMBERS / each;
    if (most > JUDGED_MOST) most = JUDGED_MOST;
    if (most > (size_t)points->n) most = (size_t)points->n;
    judged *j = &f->at;
    j->most = (long)most;
    FW_NEED(f->taken = fw_arena_array(arena, unsigned char, (size_t)points->n / 8 + 1));
    FW_NEED(j->number = fw_arena_array(arena, long, most));
    FW_NEED(j->z = fw_arena_array(arena, double, most *d));
    FW_NEED(j->response = fw_arena_array(arena, double, most *r));
    FW_NEED(j->part = fw_arena_array(arena, double, most *FW_VERDICT_LOOKS *e));
    FW_NEED(j->decision = fw_arena_array(arena, int, 2 * most));
    FW_NEED(j->looks = fw_arena_array(arena, int, most *FW_VERDICT_LOOKS));
    j->nlook = j->decision + most;
    FW_NEED(f->work = fw_arena_array(arena, double, FW_CHANCE_SURFACE_TERMS));
    FW_NEED(f->z = fw_arena_array(arena, double, d));
    FW_NEED(f->end = fw_arena_array(arena, double, (FW_VERDICT_LOOKS + 2) * e + 1));
    f->lower = f->end + FW_VERDICT_LOOKS * e, f->upper = f->lower + e;
    FW_NEED(f->largest_of = fw_arena_array(arena, group, r));
    FW_NEED(f->limit = fw_arena_array(arena, double, 5 * r));
    f->far = f->limit + r, f->value = f->far + r, f->least = f->value + r, f->most = f->least + r;
    return FW_OK;
}

/* the first points of a Sobol' sequence fill the ranges evenly; those of a grid are drawn */
static long choose(const fitted *f, uint64_t draw) {
    const fw_device_study *asked = f->study->asked;
    if (asked->points == FW_POINTS_SOBOL) return (long)draw;
    const double share = fw_chance_uniform(fw_chance_seed((uint64_t)asked->seed, 1), draw, 0);
    const long k = (long)(share * (double)f->points->n);
    return k < f->points->n ? k : f->points->n - 1;
}

static void take(fitted *f, long k) {
    judged *j = &f->at;
    if (k < 0 || is_taken(f, k) || j->n == j->most) return;
    f->taken[k / 8] |= (unsigned char)(1 << k % 8);
    j->number[j->n++] = k;
}

static void choose_more(fitted *f, long wanted, uint64_t *draw) {
    judged *j = &f->at;
    j->before = j->n;
    for (int i = 0; j->before == 0 && i < f->axes.n; i++)
        for (int k = 0; k < FW_STUDY_FARTHEST; k++)
            take(f, f->axes.axis[i].low.at[k]), take(f, f->axes.axis[i].high.at[k]);
    wanted += j->n - j->before;
    while (j->n < j->before + wanted && j->n < j->most)
        take(f, choose(f, (*draw)++));
}

static fw_status fill_judged(void *context, long k, fw_study_sample *sample, bool *wanted) {
    fitted *f = context;
    *wanted = true;
    return f->points->at(f->points->context, f->at.number[f->at.before + k], sample);
}

/* the first by number, whichever thread comes first */
static bool refuse(fitted *f, const fw_study_sample *sample, const char *why, const char *what) {
    if (f->refused[0] && f->refused_at < sample->i) return false;
    f->refused_at = sample->i;
    snprintf(f->refused, sizeof f->refused, "%s%.200s", why, what);
    return false;
}

static int decided_by(const fitted *f, const double *end) {
    int decision = 0;
    for (int e = 0; e < f->ends; e += FW_PART_NUMBERS) {
        if (end[e + FW_PART_LOW] > 1) return 1;
        if (end[e + FW_PART_HIGH] > 1) decision = 4;
    }
    return decision;
}

/* 0 where there is none */
static double most_of(const double *end, group m) {
    double largest = 0;
    for (int p = m.from; p < m.to; p++)
        largest = fmax(largest, end[FW_PART_NUMBERS * p + m.number]);
    return largest;
}

static group of_all(const fitted *f) {
    return (group){FW_PART_HIGH, 0, f->study->npart};
}

/* can surfaces know of it? */
static bool check_judged(fitted *f, const fw_study_sample *sample) {
    if (!sample->run) return refuse(f, sample, "could not be judged, ", sample->why);
    for (int r = 0; r < f->responses; r++)
        if (!isfinite(sample->response[r]))
            return refuse(f, sample, "has no value of ", f->study->response[r].asked->name);
    if (sample->decision < 0) return true; /* nothing is decided of any */
    if (sample->nlook == 0)
        return refuse(f, sample,
                      "has other hinges or requirements than the description as it stands", "");
    const double *end = sample->part + f->ends * sample->looks[sample->nlook - 1];
    for (int e = 0; e < f->ends; e++)
        if (!isfinite(end[e])) return refuse(f, sample, "has a band without ends", "");
    const double used = fw_study_used(most_of(end, of_all(f)), sample->decision);
    if (decided_by(f, end) != sample->decision)
        return refuse(f, sample, "is decided by something else than its hinges and requirements",
                      "");
    return fabs(used - sample->used) < 1e-9 * sample->used ||
           refuse(f, sample,
                  "uses most of a limit of something else than its hinges and requirements", "");
}

static fw_status take_judged(void *context, const fw_study_sample *sample) {
    fitted *f = context;
    judged *j = &f->at;
    long k = j->before;
    while (j->number[k] != sample->i)
        k++;
    if (!check_judged(f, sample)) return FW_OK;
    fw_study_axes_place(&f->axes, f->study, sample, j->z + k * f->d);
    memcpy(j->response + k * f->responses, sample->response, (size_t)f->responses * sizeof(double));
    for (int e = 0; e < FW_VERDICT_LOOKS * f->ends; e++)
        j->part[k * FW_VERDICT_LOOKS * f->ends + e] = sample->part[e];
    j->decision[k] = sample->decision, j->nlook[k] = sample->nlook;
    memcpy(j->looks + k * FW_VERDICT_LOOKS, sample->looks, sizeof sample->looks);
    return FW_OK;
}

/* ---- surfaces ---- */

static int last_look(const judged *j, long k) {
    return j->nlook[k] > 0 ? j->looks[k * FW_VERDICT_LOOKS + j->nlook[k] - 1] : 0;
}

static bool looked(const judged *j, long k, int look) {
    for (int l = 0; l < j->nlook[k]; l++)
        if (j->looks[k * FW_VERDICT_LOOKS + l] == look) return true;
    return false;
}

/* of devices that were looked at like this, or whose last look it was */
static fw_status fit_look(fitted *f, int look, bool last, fw_chance_surface *out) {
    const judged *j = &f->at;
    const size_t d = (size_t)f->d, columns = (size_t)(last ? f->responses : f->ends);
    double *z = fw_arena_array(f->fits, double, (size_t)j->n *d);
    double *y = fw_arena_array(f->fits, double, (size_t)j->n *columns);
    double *missed = fw_arena_array(f->fits, double, columns);
    size_t n = 0;
    FW_NEED(z && y && missed ? z : NULL);
    for (long k = 0; k < j->n; k++) {
        if (last ? last_look(j, k) != look : !looked(j, k, look)) continue;
        memcpy(z + n * d, j->z + k * f->d, d * sizeof *z);
        const double *from = last ? j->response + k * f->responses
                                  : j->part + (k * FW_VERDICT_LOOKS + look) * f->ends;
        memcpy(y + n++ * columns, from, columns * sizeof *y);
    }
    if (columns == 0) n = 0;
    /* A check of a die has no number where it is far from its limit, a clearance of which little is lost: 0 */
    for (size_t c = 0; !last && f->study->neach > 0 && c < columns; c++)
        FW_TRY(fw_chance_surface_fill(f->fits, n, d, z, columns, c, y, &missed[c]));
    FW_TRY(fw_chance_surface_fit(f->fits, n, d, z, columns, y, out));
    for (size_t c = 0; out->terms > 0 && c < columns; c++)
        out->missed[c] = fmax(out->missed[c], missed[c]);
    return FW_OK;
}

/* where devices that are undecided at a look went */
static void learn_next(fitted *f) {
    const judged *j = &f->at;
    memset(f->next, 0, sizeof f->next);
    for (long k = 0; k < j->n; k++)
        for (int l = 0; l < j->nlook[k]; l++) {
            const int *looks = j->looks + k * FW_VERDICT_LOOKS;
            const double *end = j->part + (k * FW_VERDICT_LOOKS + looks[l]) * f->ends;
            if (decided_by(f, end) != 4) continue;
            f->next[looks[l]] |= l + 1 < j->nlook[k] ? 1 << looks[l + 1] : ENDS;
        }
}

static bool is_largest(const fitted *f, int r, group m) {
    const judged *j = &f->at;
    for (long k = 0; k < j->n; k++) {
        const double *end = j->part + (k * FW_VERDICT_LOOKS + last_look(j, k)) * f->ends;
        const double largest = most_of(end, m);
        if (!(fabs(j->response[k * f->responses + r] - largest) <= 1e-12 * fabs(largest)))
            return false;
    }
    return f->ends > 0;
}

/* of all hinges, or of all that one hinge of a die is used for */
static void find_largest(fitted *f) {
    const int hinges = f->study->nhinge, each = f->study->neach;
    for (int r = 0; r < f->responses; r++) {
        group *m = &f->largest_of[r];
        bool found = false;
        for (int number = 0; number < FW_PART_NUMBERS && !found; number++)
            found = is_largest(f, r, *m = (group){number, 0, hinges});
        for (int from = 0; each > 0 && from < hinges && !found; from += each)
            found = is_largest(f, r, *m = (group){FW_PART_VALUE, from, from + each});
        if (!found) m->number = -1;
    }
}

static fw_status fit_all(fitted *f) {
    fw_arena_free(f->fits);
    FW_NEED(f->fits = fw_arena_part(f->study->arena, 0));
    for (int look = 0; look < FW_VERDICT_LOOKS; look++) {
        FW_TRY(fit_look(f, look, false, &f->part[look]));
        FW_TRY(fit_look(f, look, true, &f->response[look]));
    }
    learn_next(f);
    find_largest(f);
    f->made = true;
    return FW_OK;
}

static double off(const fw_chance_surface *s, int column) {
    return margin * s->missed[column];
}

/* ---- what they tell of a point ---- */

typedef struct told {
    int decision;         /* -1: none yet */
    bool open;            /* it is to be judged */
    double used[2];       /* least and most */
    double *least, *most; /* (responses) */
} told;

static void told_new(const fitted *f, told *t) {
    *t = (told){.decision = -1, .used = {HUGE_VAL, -HUGE_VAL}, .least = f->least, .most = f->most};
    for (int r = 0; r < f->responses; r++)
        t->least[r] = HUGE_VAL, t->most[r] = -HUGE_VAL;
}

/* The largest of many has an edge wherever another comes to be it; each by itself has none. */
static void largest_of(const fitted *f, int look, group m, double *least, double *largest) {
    const double *end = f->end + look * f->ends;
    for (int e = 0; e < f->ends; e++) {
        f->lower[e] = end[e] - off(&f->part[look], e);
        f->upper[e] = end[e] + off(&f->part[look], e);
    }
    *least = most_of(f->lower, m), *largest = most_of(f->upper, m);
}

/* it may end at this look */
static void ends_at(const fitted *f, int look, int decision, const double *z, told *t) {
    const fw_chance_surface *s = &f->response[look];
    t->open = t->open || s->terms == 0 || (t->decision >= 0 && t->decision != decision);
    if (t->open) return;
    t->decision = decision;
    fw_chance_surface_at(s, z, f->work, f->value);
    for (int r = 0; r < f->responses; r++) {
        double at_least = f->value[r] - off(s, r), at_most = f->value[r] + off(s, r);
        if (f->largest_of[r].number >= 0)
            largest_of(f, look, f->largest_of[r], &at_least, &at_most);
        t->least[r] = fmin(t->least[r], at_least);
        t->most[r] = fmax(t->most[r], at_most);
    }
    double least, largest;
    largest_of(f, look, of_all(f), &least, &largest);
    t->used[0] = fmin(t->used[0], fw_study_used(least, decision));
    t->used[1] = fmax(t->used[1], fw_study_used(largest, decision));
}

typedef struct ways { /* how a look may come out */
    bool accept, reject, undecided;
} ways;

static ways ways_of(const fitted *f, int look, const double *end) {
    const fw_chance_surface *s = &f->part[look];
    ways w = {.accept = true};
    bool surely_accepted = true, surely_rejected = false;
    for (int e = 0; e < f->ends; e += FW_PART_NUMBERS) {
        const int l = e + FW_PART_LOW, h = e + FW_PART_HIGH;
        w.reject = w.reject || end[l] + off(s, l) > 1;
        surely_rejected = surely_rejected || end[l] - off(s, l) > 1;
        w.accept = w.accept && end[h] - off(s, h) <= 1;
        surely_accepted = surely_accepted && end[h] + off(s, h) <= 1;
    }
    w.undecided = !surely_accepted && !surely_rejected;
    w.accept = w.accept && !surely_rejected;
    return w;
}

/* all ways that it may go from this look on */
static void follow(const fitted *f, int look, const double *z, told *t) {
    double *end = f->end + look * f->ends;
    t->open = t->open || f->part[look].terms == 0;
    if (t->open) return;
    fw_chance_surface_at(&f->part[look], z, f->work, end);
    const ways w = ways_of(f, look, end);
    if (w.accept) ends_at(f, look, 0, z, t);
    if (w.reject) ends_at(f, look, 1, z, t);
    if (!w.undecided) return;
    t->open = t->open || f->next[look] == 0;
    if (f->next[look] & ENDS) ends_at(f, look, 4, z, t);
    for (int next = look + 1; next < FW_VERDICT_LOOKS; next++)
        if (f->next[look] & 1 << next) follow(f, next, z, t);
}

/* open: it is to be judged, as when it may go ways that are further apart than what was asked for */
static void tell(const fitted *f, const double *z, told *t) {
    told_new(f, t);
    if (f->ends > 0)
        follow(f, 0, z, t);
    else
        ends_at(f, 0, -1, z, t);
    for (int r = 0; r < f->responses && !t->open; r++)
        t->open = t->most[r] - t->least[r] > 2 * f->limit[r] * (1 + 1e-9);
}

/* are the devices of this round what the former surfaces tell of them? */
static bool holds(fitted *f) {
    const judged *j = &f->at;
    f->checked = 0;
    for (long k = j->before; f->made && k < j->n; k++) {
        told t;
        tell(f, j->z + k * f->d, &t);
        if (t.open) continue;
        f->checked++;
        if (f->ends > 0 && t.decision != j->decision[k]) return false;
        for (int r = 0; r < f->responses; r++) {
            const double is = j->response[k * f->responses + r];
            if (is < t.least[r] || is > t.most[r]) return false;
        }
    }
    return f->made;
}

static double largest(const fitted *f, int r) {
    double size = 0;
    for (long k = 0; k < f->at.n; k++)
        size = fmax(size, fabs(f->at.response[k * f->responses + r]));
    return size;
}

/* share of all points that surfaces do not tell, from points that are spread over them */
static fw_status count_open(fitted *f) {
    const long n = f->points->n, step = n / LOOKED_AT + 1;
    long all = 0, open = 0;
    for (long k = step / 2; k < n; k += step) {
        told t;
        if (is_taken(f, k)) continue;
        FW_TRY(f->points->at(f->points->context, k, &f->sample));
        fw_study_axes_place(&f->axes, f->study, &f->sample, f->z);
        tell(f, f->z, &t);
        all++, open += t.open;
    }
    f->open = all > 0 ? (double)open / (double)all : 0;
    return FW_OK;
}

/* devices of the last round that were told before they were judged, at least */
static long checks_wanted(long n) {
    return n < CHECKED_EACH * CHECKED_MOST ? n / CHECKED_EACH : CHECKED_MOST;
}

/* Rounds go on while what stays open costs more than the next one, whose devices are of the study as well: only those cost
   anything that would have been told. */
static bool enough(const fitted *f) {
    const double rest = (double)(f->points->n - f->at.n) * f->open;
    return f->at.n >= f->at.most ||
           (f->held && f->checked >= checks_wanted(f->points->n) && rest <= 0.5 * (double)f->at.n);
}

static fw_status make_surfaces(fitted *f) {
    long wanted = FIRST_EACH * (f->d + 1);
    uint64_t draw = 0;
    if (wanted < FIRST_LEAST) wanted = FIRST_LEAST;
    do {
        choose_more(f, wanted, &draw);
        const fw_study_work work = {.n = f->at.n - f->at.before,
                                    .fill = fill_judged,
                                    .take = take_judged,
                                    .anew = true,
                                    .context = f};
        FW_TRY(fw_study_pool_run(f->study, &work));
        if (f->refused[0])
            return fw_diag_error(
                &f->study->diags, 660, f->study->asked->place,
                "fitted: of the devices that were judged, number %ld %s: response surfaces know "
                "nothing of it; make the ranges narrower, or remove fitted, so that all are judged",
                f->refused_at, f->refused);
        f->held = holds(f);
        FW_TRY(fit_all(f));
        for (int r = 0; r < f->responses; r++)
            f->limit[r] = f->study->asked->fitted * largest(f, r);
        FW_TRY(count_open(f));
        wanted = f->at.n / 2;
        if (wanted < checks_wanted(f->points->n) && f->open < 0.1)
            wanted = checks_wanted(f->points->n) * 10 / 9 + 1;
    } while (!enough(f));
    return FW_OK;
}

/* ---- the others ---- */

/* the middle, rounded; *far: the most that the truth may be away */
static double told_as(double least, double most, double *far) {
    const double value = fw_study_rounded(0.5 * (least + most));
    *far = fmax(*far, fmax(most - value, value - least));
    return value;
}

static fw_status fill_told(void *context, long k, fw_study_sample *sample, bool *wanted) {
    fitted *f = context;
    told t;
    sample->i = k;
    *wanted = !is_taken(f, k) && fw_study_is_due(f->study, k);
    if (!*wanted) return FW_OK;
    FW_TRY(f->points->at(f->points->context, k, sample));
    fw_study_axes_place(&f->axes, f->study, sample, f->z);
    tell(f, f->z, &t);
    f->open_judged += t.open, f->told += !t.open;
    *wanted = t.open;
    if (*wanted) return FW_OK;
    sample->run = true, sample->decision = t.decision;
    sample->used = f->ends > 0 ? told_as(t.used[0], t.used[1], &f->used_far) : (double)NAN;
    for (int r = 0; r < f->responses; r++)
        sample->response[r] = told_as(t.least[r], t.most[r], &f->far[r]);
    snprintf(sample->why, FW_STUDY_WHY, "%s", fw_study_told_by_surface);
    return fw_study_keep(f->study, sample);
}

static fw_status say_fitted(const fitted *f, fw_study_result *result) {
    fw_study_fitted *out = fw_arena_one(f->study->arena, fw_study_fitted);
    FW_NEED(out);
    *out = (fw_study_fitted){.judged = f->at.n,
                             .open = f->open_judged,
                             .told = f->told,
                             .checked = f->checked,
                             .off = f->far,
                             .used_off = f->used_far};
    result->fitted = out;
    return FW_OK;
}

static fw_status tell_others(fitted *f, fw_study_result *result) {
    FW_TRY(make_surfaces(f));
    if (!f->held && f->at.n < f->points->n)
        return fw_diag_error(
            &f->study->diags, 661, f->study->asked->place,
            "fitted: response surfaces of %ld devices told %ld others worse than they should; what "
            "is asked for goes in steps or kinks within the ranges; make the ranges narrower, or "
            "remove fitted, so that all are judged",
            f->at.before, f->at.n - f->at.before);
    const fw_study_work work = {.n = f->points->n, .fill = fill_told, .context = f};
    FW_TRY(fw_study_pool_run(f->study, &work));
    return say_fitted(f, result);
}

fw_status fw_study_fitted_run(fw_study *study, const fw_study_points *points,
                              fw_study_result *result) {
    fitted f;
    FW_TRY(fitted_new(&f, study, points));
    const fw_status status = tell_others(&f, result);
    fw_arena_free(f.fits);
    return status;
}
