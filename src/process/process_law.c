/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/films.h"
#include "process/pack.h"
#include "process/process_law.h"
#include "base/text.h"
#include "base/sort.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define FW_PROCESS_LAW(name) &fw_process_law_##name,
static const fw_process_law *const table[] = {
#include "process/time_laws.def"
};
#undef FW_PROCESS_LAW
enum { LAW_COUNT = sizeof table / sizeof table[0] };

const fw_process_law *fw_process_law_find(const char *name) {
    for (int i = 0; name && i < LAW_COUNT; i++)
        if (strcmp(table[i]->name, name) == 0) return table[i];
    return NULL;
}

fw_process_law_use fw_process_law_of_step(const fw_process_step *s,
                                          const fw_process_argument *argument) {
    return (fw_process_law_use){.law = fw_process_law_find(s->law),
                                .shape = s->shape,
                                .expression = s->expression,
                                .wanted = FW_DIM_TIME,
                                .argument = argument,
                                .nargument = s->nargument};
}

const fw_process_law *fw_process_law_row(int i) {
    return i >= 0 && i < LAW_COUNT ? table[i] : NULL;
}

int fw_process_law_argument_index(const fw_process_law *law, const char *name) {
    for (int i = 0; i < law->nargument; i++)
        if (strcmp(law->argument[i].name, name) == 0) return i;
    return -1;
}

/* the inputs of one evaluation, in the order of the law's arguments */
typedef struct input {
    double x[FW_LAW_ARGUMENTS];
    const fw_quantity *q[FW_LAW_ARGUMENTS]; /* NULL where not given */
    const char *name[FW_LAW_ARGUMENTS];
    fw_quantity_dimension dimension[FW_LAW_ARGUMENTS];
    int n;
} input;

static const fw_quantity *given(const fw_process_law_use *use, const char *name) {
    for (int j = 0; j < use->nargument; j++)
        if (strcmp(use->argument[j].name, name) == 0) return use->argument[j].q;
    return NULL;
}

/* is the law's correction made: are all its FW_LAW_WHEN_KNOWN arguments there and known? */
static bool corrected(const fw_process_law_use *use) {
    for (int i = 0; i < use->law->nargument; i++) {
        const fw_process_law_argument *a = &use->law->argument[i];
        const fw_quantity *q = given(use, a->name);
        if (a->need == FW_LAW_WHEN_KNOWN && (!q || q->unknown)) return false;
    }
    return true;
}

/* an argument of a correction that is not made */
static bool left_out(const fw_process_law_use *use, const char *name) {
    int at = use->law->argument ? fw_process_law_argument_index(use->law, name) : -1;
    return at >= 0 && use->law->argument[at].need == FW_LAW_WHEN_KNOWN && !corrected(use);
}

static void collect(const fw_process_law_use *use, input *in) {
    const fw_process_law *law = use->law;
    *in = (input){.n = law->argument ? law->nargument : use->nargument};
    if (in->n > FW_LAW_ARGUMENTS) in->n = FW_LAW_ARGUMENTS;
    for (int i = 0; i < in->n; i++) {
        in->x[i] = (double)NAN;
        if (!law->argument) {
            in->name[i] = use->argument[i].name;
            in->q[i] = use->argument[i].q;
        } else {
            in->name[i] = law->argument[i].name;
            in->q[i] = left_out(use, in->name[i]) ? NULL : given(use, in->name[i]);
        }
        if (in->q[i]) {
            in->x[i] = in->q[i]->unknown ? (double)NAN : in->q[i]->value;
            in->dimension[i] = in->q[i]->dimension;
        }
    }
}

static fw_status add_text(fw_arena *arena, const char ***list, int *n, const char *text) {
    FW_NEED(text);
    for (int i = 0; i < *n; i++)
        if (strcmp((*list)[i], text) == 0) return FW_OK;
    const char **grown = fw_arena_grow(arena, *list, (size_t)*n, (size_t)*n + 1, sizeof **list);
    FW_NEED(grown);
    grown[(*n)++] = text;
    *list = grown;
    return FW_OK;
}

static const char *in_words(fw_arena *arena, const char *name) {
    char *words = fw_arena_strdup(arena, name);
    for (char *c = words; c && *c; c++)
        if (*c == '_') *c = ' ';
    return words;
}

/* "porosity (ps.P)": the name on the run sheet, else the argument's, and where to enter it */
static const char *missing_name(fw_arena *arena, const fw_process_law_use *use,
                                const fw_process_argument *a) {
    const char *words = in_words(arena, a->name);
    const char *of = strpbrk(a->name, "0123456789") ? use->law->pairs_of : NULL;
    for (int i = 0; i < use->nsetting; i++)
        if (use->setting[i].q == a->q) words = use->setting[i].name;
    if (!words) return NULL;
    return fw_arena_printf(arena, "%s%s%s (%s)", words, of ? " of " : "", of ? of : "",
                           a->q->id ? a->q->id : "no id");
}

static fw_status missing(fw_arena *arena, const fw_process_law_use *use,
                         fw_process_law_answer *answer) {
    for (int i = 0; i < use->nargument + use->nneed; i++) {
        const fw_process_argument *a =
            i < use->nargument ? &use->argument[i] : &use->need[i - use->nargument];
        if (i < use->nargument && left_out(use, a->name)) continue;
        if (a->q->unknown)
            FW_TRY(
                add_text(arena, &answer->missing, &answer->nmissing, missing_name(arena, use, a)));
        else
            answer->status = fw_process_status_worse(answer->status, a->q->status);
    }
    /* what is computed is derived at best; a stated time is handed on as it is */
    if (!use->law->stated) answer->status = fw_process_status_worse(answer->status, FW_DERIVED);
    for (int i = 0; i < use->law->nargument; i++) {
        const fw_process_law_argument *a = &use->law->argument[i];
        if (!given(use, a->name) && a->need == FW_LAW_REQUIRED)
            FW_TRY(add_text(arena, &answer->missing, &answer->nmissing, in_words(arena, a->name)));
    }
    return FW_OK;
}

/* central difference; one-sided where the other side is outside the law's range */
static fw_status difference(const fw_process_law *law, fw_process_law_call *call, const input *in,
                            int i, double result, double *slope) {
    double x[FW_LAW_ARGUMENTS], at[2] = {0.0, 0.0}, f[2] = {result, result};
    memcpy(x, in->x, sizeof x);
    double h = in->x[i] != 0.0 ? 6e-6 * fabs(in->x[i]) : in->q[i]->uncertainty;
    for (int side = 0; side < 2; side++) {
        double value = 0.0;
        x[i] = in->x[i] + (side ? h : -h);
        fw_status status = law->evaluate(call, x, &value);
        if (status == FW_NOMEM) return status;
        if (status == FW_OK && isfinite(value)) {
            f[side] = value;
            at[side] = x[i] - in->x[i];
        }
    }
    *slope = at[1] > at[0] ? (f[1] - f[0]) / (at[1] - at[0]) : 0.0;
    return FW_OK;
}

typedef struct share {
    const fw_quantity *q;
    const char *group; /* NULL: q alone */
    const char *name;
    double part; /* (dt/dx) u, signed: the same quantity in two places adds up before squaring */
} share;

static int by_size(const void *a, const void *b) {
    const share *s = a, *t = b;
    double ds = fabs(s->part), dt = fabs(t->part);
    int order = fw_order_doubles(dt, ds);
    return order ? order : strcmp(s->name, t->name);
}

/* of quantities that a laboratory found together: 2 sum_i<j r_ij part_i part_j; 0 where nothing is correlated */
static double crossed(const share *part, int n) {
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++)
            if (!part[i].group && !part[j].group)
                sum += 2.0 * fw_quantity_correlation(part[i].q, part[j].q) * part[i].part *
                       part[j].part;
    return sum;
}

/* u_t = sqrt(sum_ij r_ij (dt/dx_i) u_i (dt/dx_j) u_j), first order; r_ij are the correlations that a laboratory pack
   gives, else inputs are independent, but for one quantity in two places and for the entries of one table (group), which
   are fully correlated. Steps of a law add what they can make of the inputs' uncertainties.
   x_i, u_i SI; result in SI. Exact for laws that are linear in the logarithm up to O(u^2): 5.52 %
   against 5.53 % by Monte Carlo for plating. Cost: two evaluations per input without a slope.
   Source: JCGM 100:2008, 5.1 and 5.2. Tests: test_law.c, uncertainty; test_law_monte_carlo.c;
   test_correlation.c, windows. */
static fw_status uncertainty(fw_arena *arena, const fw_process_law *law, fw_process_law_call *call,
                             const input *in, fw_process_law_answer *answer) {
    double dx[FW_LAW_ARGUMENTS];
    share part[FW_LAW_ARGUMENTS];
    int n = 0;
    for (int i = 0; i < FW_LAW_ARGUMENTS; i++)
        dx[i] = (double)NAN;
    if (law->slope) law->slope(in->x, answer->value, dx);
    for (int i = 0; i < in->n; i++) {
        if (!in->q[i] || !(in->q[i]->uncertainty > 0.0)) continue;
        if (isnan(dx[i])) FW_TRY(difference(law, call, in, i, answer->value, &dx[i]));
        int at = 0;
        const char *group = law->argument ? law->argument[i].group : NULL;
        while (at < n && part[at].q != in->q[i] && !(group && part[at].group == group))
            at++;
        if (at == n) part[n++] = (share){in->q[i], group, group ? group : in->name[i], 0.0};
        part[at].part += dx[i] * in->q[i]->uncertainty;
    }
    double sum = 0.0;
    for (int i = 0; i < n; i++)
        sum = hypot(sum, part[i].part);
    double more = crossed(part, n);
    if (more != 0.0) sum = sqrt(fmax(sum * sum + more, 0.0));
    if (law->steps) {
        double u[FW_LAW_ARGUMENTS];
        for (int i = 0; i < in->n; i++)
            u[i] = in->q[i] ? in->q[i]->uncertainty : 0.0;
        sum += law->steps(in->x, u);
    }
    answer->uncertainty = sum;
    qsort(part, (size_t)n, sizeof part[0], by_size);
    for (int i = 0; i < n; i++) {
        char text[32];
        if (!(fabs(part[i].part) > 0.0) || answer->value == 0.0) continue;
        answer->u_status = fw_process_status_worse(answer->u_status, part[i].q->u_status);
        fw_number_text(text, sizeof text, fabs(100.0 * part[i].part / answer->value), 3);
        const char *name = in_words(arena, part[i].name);
        FW_NEED(name);
        FW_TRY(add_text(arena, &answer->contribution, &answer->ncontribution,
                        fw_arena_printf(arena, "%s %s %%", name, text)));
    }
    return FW_OK;
}

/* "a usable value among si.d, rie.R: width, rate and probability must be above zero" */
static fw_status unusable(fw_arena *arena, const fw_process_law_use *use, const char *why,
                          fw_process_law_answer *answer) {
    fw_text list = fw_text_new(arena);
    fw_text_add(&list, use->nargument > 1 ? "a usable value among " : "a usable value of ");
    for (int i = 0; i < use->nargument; i++)
        fw_text_printf(&list, "%s%s", i ? ", " : "",
                       use->argument[i].q->id ? use->argument[i].q->id : use->argument[i].name);
    fw_text_printf(&list, ": %s", why);
    FW_TRY(fw_text_end(&list));
    return add_text(arena, &answer->missing, &answer->nmissing, list.data);
}

static double told(const fw_process_law_use *use, const char *name) {
    for (int i = 0; i < use->nargument; i++)
        if (strcmp(use->argument[i].name, name) == 0 && !use->argument[i].q->unknown)
            return use->argument[i].q->value;
    return (double)NAN;
}

fw_status fw_process_law_evaluate(fw_arena *arena, const fw_process_law_use *use,
                                  fw_process_law_answer *answer) {
    input in;
    *answer = (fw_process_law_answer){.status = FW_MEASURED,
                                      .u_status = FW_MEASURED,
                                      .shortest = told(use, "shortest"),
                                      .longest = told(use, "longest")};
    FW_TRY(missing(arena, use, answer));
    if (answer->nmissing > 0) return FW_OK;
    collect(use, &in);
    fw_process_law_call call = {.arena = arena,
                                .shape = use->shape ? use->shape : "",
                                .expression = use->expression ? use->expression : "",
                                .name = in.name,
                                .dimension = in.dimension,
                                .n = in.n,
                                .wanted = use->wanted};
    fw_status status = use->law->evaluate(&call, in.x, &answer->value);
    if (status != FW_OK && status != FW_INPUT) return status;
    bool time = fw_quantity_dimension_equal(use->wanted, (fw_quantity_dimension)FW_DIM_TIME);
    if (status == FW_OK && !isfinite(answer->value))
        call.why = "the law gives no finite value";
    else if (status == FW_OK && time && answer->value < 0.0)
        call.why = "the law gives a negative time";
    else if (status == FW_OK)
        answer->computable = true;
    if (!answer->computable)
        return unusable(arena, use, call.why ? call.why : "outside the law's range", answer);
    FW_TRY(uncertainty(arena, use->law, &call, &in, answer));
    if (!isfinite(answer->uncertainty)) {
        answer->computable = false;
        return unusable(arena, use, "the uncertainty is not finite", answer);
    }
    return FW_OK;
}

/* first look t (1 - k u), clear by t (1 + k u), stop = clear by (1 + overrun); u relative. None is outside of the shortest and
   longest time that the step is allowed. k 2 (about 95 %). Source: docs/theory/process.md. Test: test_law.c, window. */
void fw_process_law_window(const fw_process_law_answer *answer, double k, double overrun,
                           fw_process_time *time) {
    *time = (fw_process_time){.computable = answer->computable,
                              .status = answer->status,
                              .u_status = answer->u_status,
                              .slowed = 1.0,
                              .missing = answer->missing,
                              .nmissing = answer->nmissing,
                              .contribution = answer->contribution,
                              .ncontribution = answer->ncontribution};
    if (!answer->computable) return;
    time->nominal_s = answer->value;
    time->relative_uncertainty = answer->value > 0.0 ? answer->uncertainty / answer->value : 0.0;
    /* fmax and fmin take the number where the other is none */
    time->first_look_s = fmax(fmax(0.0, answer->value - k * answer->uncertainty), answer->shortest);
    time->clear_by_s = fmin(answer->value + k * answer->uncertainty, answer->longest);
    time->stop_s = fmin(time->clear_by_s * (1.0 + overrun), answer->longest);
}

const fw_process_argument *fw_process_law_wide(const fw_process_law_use *use,
                                               fw_process_argument *list, fw_quantity *none,
                                               bool guess) {
    bool out = false;
    if (!use->law || !use->law->lags || use->nargument > FW_LAW_ARGUMENTS) return use->argument;
    for (int i = 0; i < use->nargument; i++) {
        const fw_process_argument a = use->argument[i];
        bool lag = strcmp(a.name, "probability") == 0 || strcmp(a.name, "lag") == 0;
        list[i] = a;
        if (!lag || (guess && !fw_process_lag_is_guess(a.q))) continue;
        *none = *a.q;
        none->value = none->uncertainty = 0.0;
        none->unknown = false;
        none->status = FW_MEASURED; /* no part of the answer */
        list[i].q = none;
        out = true;
    }
    return out ? list : use->argument;
}

/* A time that rests on a guess is nobody's plan: such a lag is shown, and judged, beside the time
   of wide openings, until it is measured. */
bool fw_process_lag_is_guess(const fw_quantity *lag) {
    return lag && !lag->unknown && lag->status == FW_ASSUMED;
}

bool fw_process_release_solves(const fw_process_flow *flow, const fw_quantity *q) {
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nchange; k++)
            if (q && flow->step[i].change[k].reach == q && q->status == FW_DERIVED) return true;
    return false;
}

/* ---- what the device itself loses ---- */

typedef struct lost { /* in one step */
    double loss_m, u_m;
    double most_m; /* where it runs to its stop time */
    const char *missing;
    bool never;
} lost;

/* does the mask give it, or a step on the way? Whether or not that was done by now */
static bool comes_later(const fw_process_flow *flow, const fw_quantity *q) {
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        if (s->planned == q) return true;
        for (int k = 0; k < s->nderive; k++)
            if (s->derive[k].q == q) return true;
    }
    return q->id && fw_process_quantity_computed(q);
}

/* the step's arguments with the reach of a release in the place of what the pack leaves to the mask; *l says what is not
   known of them */
static void arguments_with(const fw_process_flow *flow, const fw_process_step *s,
                           const fw_quantity *reach, fw_process_argument *list, lost *l) {
    for (int i = 0; i < s->nargument; i++) {
        const fw_quantity *q = s->argument[i].q;
        const bool solved = fw_process_release_solves(flow, q),
                   later = !solved && comes_later(flow, q);
        list[i] = s->argument[i];
        if (solved) list[i].q = reach;
        if (!later && !(solved && reach->unknown)) continue;
        l->missing = q->id;
        l->never = l->never || later;
    }
}

static const fw_quantity *of_name(const fw_process_step *s, const fw_process_argument *list,
                                  const char *name) {
    for (int i = 0; i < s->nargument; i++)
        if (strcmp(list[i].name, name) == 0) return list[i].q;
    return NULL;
}

static const char *first_unknown(const fw_process_step *s, const fw_process_argument *list) {
    for (int i = 0; i < s->nargument; i++)
        if (list[i].q->unknown && list[i].q->id) return list[i].q->id;
    return "an input of its time";
}

/* l = r T (1 + overrun), T by the step's own law; where r is the R of the law `rate` it cancels in l, and need not be known.
   u of fw_process_lost_uncertainty. */
static fw_status by_rate(fw_arena *arena, const fw_process_step *s, const fw_quantity *r,
                         const fw_process_argument *list, lost *l) {
    const fw_process_law *law = fw_process_law_find(s->law);
    const fw_quantity *d = of_name(s, list, "thickness"), *R = of_name(s, list, "rate");
    fw_process_argument wide[FW_LAW_ARGUMENTS];
    fw_quantity none;
    fw_process_law_answer T;
    const double u_rate = r->unknown || r->value == 0.0 ? 0.0 : r->uncertainty / fabs(r->value);
    if (law->by_rate && R == r && !d->unknown) {
        const double of_d = d->value != 0.0 ? d->uncertainty / fabs(d->value) : 0.0;
        l->loss_m = d->value * (1.0 + s->overrun);
        l->u_m = fw_process_lost_uncertainty(true, u_rate, hypot(of_d, u_rate)) * l->loss_m;
        l->most_m = l->loss_m * (1.0 + s->k * hypot(of_d, u_rate));
        return FW_OK;
    }
    fw_process_law_use use = fw_process_law_of_step(s, list);
    use.argument = fw_process_law_wide(&use, wide, &none, true);
    FW_TRY(fw_process_law_evaluate(arena, &use, &T));
    if (!T.computable)
        l->missing = first_unknown(s, list);
    else if (r->unknown)
        l->missing = r->id;
    if (l->missing) return FW_OK;
    l->loss_m = r->value * T.value * (1.0 + s->overrun);
    l->u_m =
        fw_process_lost_uncertainty(R == r, u_rate, T.value > 0.0 ? T.uncertainty / T.value : 0.0) *
        l->loss_m;
    l->most_m = r->value * (T.value + s->k * T.uncertainty) * (1.0 + s->overrun);
    return FW_OK;
}

/* l = d (T/T_wide) (1 + overrun)/S: fw_process_exposed_loss */
static fw_status by_selectivity(fw_arena *arena, const fw_process_step *s, const fw_quantity *S,
                                const fw_quantity *reach, const fw_process_argument *list,
                                lost *l) {
    fw_process_argument wide[FW_LAW_ARGUMENTS];
    fw_quantity none;
    fw_process_law_answer own, open;
    fw_process_law_use use = fw_process_law_of_step(s, list);
    const double deep = fw_process_step_depth(s, reach->unknown ? (double)NAN : reach->value);
    use.argument = fw_process_law_wide(&use, wide, &none, true);
    FW_TRY(fw_process_law_evaluate(arena, &use, &own));
    use.argument = list;
    use.argument = fw_process_law_wide(&use, wide, &none, false);
    FW_TRY(fw_process_law_evaluate(arena, &use, &open));
    if (S->unknown)
        l->missing = S->id;
    else if (isnan(deep))
        l->missing = "how much the step takes off";
    else if (use.law->lags && !(own.computable && open.computable && open.value > 0.0))
        l->missing = first_unknown(s, list);
    if (l->missing) return FW_OK;
    const double slowed = use.law->lags ? own.value / open.value : 1.0;
    l->loss_m = deep * slowed * (1.0 + s->overrun) / S->value;
    l->u_m = l->loss_m * S->uncertainty / S->value;
    l->most_m = l->loss_m;
    if (own.computable && own.value > 0.0) l->most_m *= 1.0 + s->k * own.uncertainty / own.value;
    return FW_OK;
}

static fw_status lost_in(fw_arena *arena, const fw_process_flow *flow, const fw_process_step *s,
                         const fw_process_exposed *x, const fw_quantity *reach, lost *l) {
    fw_process_argument list[FW_LAW_ARGUMENTS];
    *l = (lost){0};
    if (!fw_process_law_find(s->law) || s->nargument > FW_LAW_ARGUMENTS) {
        l->missing = "the time of its law";
        return FW_OK;
    }
    arguments_with(flow, s, reach, list, l);
    if (l->missing) return FW_OK;
    return x->rate ? by_rate(arena, s, x->rate, list, l)
                   : by_selectivity(arena, s, x->selectivity, reach, list, l);
}

/* losses of all steps, a release of which runs so far */
static fw_status wear_with(fw_arena *arena, const fw_process_flow *flow, const fw_quantity *reach,
                           fw_process_wear *w) {
    bool released = false;
    *w = (fw_process_wear){0};
    for (int i = 0; flow->material && i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        for (int k = 0; k < s->nchange; k++)
            released = released || s->change[k].reach;
        for (int k = 0; k < s->nexposed && fw_process_step_is_wet(s); k++) {
            const fw_process_exposed *x = &s->exposed[k];
            lost l;
            if (strcmp(x->material, flow->material) != 0) continue;
            if (!w->step) w->step = s, w->exposed = x;
            FW_TRY(lost_in(arena, flow, s, x, reach, &l));
            if (l.missing && !w->missing) w->missing = l.missing, w->never = l.never;
            w->loss_m += l.loss_m;
            w->after_m += released ? l.loss_m : 0.0;
            w->uncertainty_m = hypot(w->uncertainty_m, l.u_m);
            w->most_m += l.most_m;
        }
    }
    return FW_OK;
}

/* Sum over the steps that say <exposed> of the device's own material, losses added, uncertainties in quadrature. Walls stand
   by what they lose from the release on further out when it begins, a, so that its reach is way + a, and a grows with it:
     a = f(way + a),   by Aitken's extrapolation, exact at once where f is linear, as for the law `rate`;
   f' >= 1: the bath takes the device as fast as it frees it, and no reach is enough. Error: 1e-12 relative. Cost: some three
   evaluations of each law. Source: docs/theory/process.md, "What a step takes along". Test: test_wear.c. */
fw_status fw_process_flow_wear(fw_arena *arena, const fw_process_flow *flow, double way_m,
                               fw_process_wear *wear) {
    enum { MOST = 30 };
    const fw_quantity *edge = fw_process_flow_own_quantity(flow, FW_PROCESS_PRINTED_EDGE);
    fw_quantity reach = {.unknown = isnan(way_m),
                         .value = way_m,
                         .uncertainty = edge && !edge->unknown ? edge->uncertainty : 0.0,
                         .dimension = FW_DIM_LENGTH,
                         .unit = "um",
                         .status = FW_DERIVED};
    double a = 0.0;
    for (int i = 0; i < MOST; i++) {
        reach.value = fmax(way_m + a, 0.0);
        FW_TRY(wear_with(arena, flow, &reach, wear));
        const double once = wear->after_m;
        if (reach.unknown || fabs(once - a) <= 1e-12 * fabs(way_m)) return FW_OK;
        reach.value = fmax(way_m + once, 0.0);
        FW_TRY(wear_with(arena, flow, &reach, wear));
        const double first = once - a, second = wear->after_m - once;
        if (fabs(second) >= fabs(first)) break;
        a += first * first / (first - second);
    }
    wear->loss_m = wear->after_m = wear->uncertainty_m = wear->most_m = 0.0;
    wear->missing = "a reach that is enough: the device is taken as fast as it is freed";
    wear->never = true;
    return FW_OK;
}

bool fw_process_flow_wears_by_reach(const fw_process_flow *flow) {
    for (int i = 0; flow->material && i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        bool takes = false, reaches = false;
        for (int k = 0; k < s->nexposed; k++)
            takes = takes || strcmp(s->exposed[k].material, flow->material) == 0;
        for (int k = 0; k < s->nargument; k++)
            reaches = reaches || fw_process_release_solves(flow, s->argument[k].q);
        for (int k = 0; k < s->nchange; k++)
            reaches = reaches || fw_process_release_solves(flow, s->change[k].reach);
        if (takes && reaches && fw_process_step_is_wet(s)) return true;
    }
    return false;
}
