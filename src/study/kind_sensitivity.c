/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sensitivity: derivatives of every response at the description as it stands (of an input that the description has outside
   of its range at the middle of that, which is said), and the shares of its variance over the ranges (Sobol' indices).

   A derivative is that of the polynomial through seven devices, evenly spaced over a tenth of the range
   either side (moved inside where the range ends), judged at an accuracy of 1e-9. A response that is finer than these are
   apart, as the largest of many peaks that ring, looks smooth to all polynomials through them; so four devices much nearer,
   at distances that are no share of the others', are compared with what it says of them. Its error is the largest of the
   difference to the polynomial through the inner five, of twice what these four are off by in slope beyond their own accuracy, and
   of the accuracy of the seven. Where the polynomial through the four nearer ones has the less error (the difference of the
   slopes of either two), it is taken; where neither is known to a tenth, none is. Equations: docs/theory/chance.md. Weights: Fornberg
   1988. Test: tests/unit/study/test_response.c (weights, what is finer), tests/cli/test_study.py against differences of
   tight runs. */
#include "chance/joint.h"
#include "maths/functions.h"
#include "study/study_parts.h"
#include <math.h>
#include <string.h>

enum { NODES = 7, INNER = 5, NEAR = 4, NEAREST = 2, ALL = NODES + NEAR };
enum { DIGITS = 13, SPREAD_DIGITS = 9, BASE_USUAL = 128 };
static const double reach = 0.1; /* of the range, either side */
/* of that, the nearer devices: a step is a third of it, and none of these is a share of a step */
static const double nearer = 0.0231, nearest = 0.01013;
/* An error above this share of a derivative, and worth more than `little` of the response over the range: not known */
static const double known = 0.1, little = 1e-4;
static const double finer = 0.01; /* what the far ones are off by, of the slope: it is told */

void fw_study_derivative_weights(const double *x, int n, double at, double *weight) {
    /* Fornberg (1988), Mathematics of Computation 51, 699: c[k][j] of the k-th derivative at node j */
    double c[2][NODES] = {{1}}, c1 = 1, c4 = x[0] - at;
    for (int i = 1; i < n; i++) {
        double c2 = 1, c5 = c4;
        c4 = x[i] - at;
        for (int j = 0; j < i; j++) {
            double c3 = x[i] - x[j];
            c2 *= c3;
            if (j == i - 1) {
                c[1][i] = c1 * (c[0][i - 1] - c5 * c[1][i - 1]) / c2;
                c[0][i] = -c1 * c5 * c[0][i - 1] / c2;
            }
            c[1][j] = (c4 * c[1][j] - c[0][j]) / c3;
            c[0][j] = c4 * c[0][j] / c3;
        }
        c1 = c2;
    }
    memcpy(weight, c[1], (size_t)n * sizeof *weight);
}

typedef struct sensing {
    fw_study *study;
    double *centre;   /* (ninput) SI */
    double *node;     /* (ninput x ALL) SI, as their texts say: seven, two nearer, two nearest */
    double *response; /* (ninput x ALL x nresponse) */
    double accuracy;  /* of them, relative */
    /* of the indices: points of one batch, and where their values go */
    long base;
    size_t first;
    const double *u;
    double *value;
    fw_arena *chance;
} sensing;

bool fw_study_input_is_inside(const fw_study_input *in) {
    return in->now >= in->from && in->now <= in->to;
}

double fw_study_input_centre(const fw_study_input *in) {
    if (fw_study_input_is_inside(in)) return in->now;
    return in->logarithmic ? sqrt(in->from * in->to) : 0.5 * (in->from + in->to);
}

/* node j of an input: seven evenly spaced over what is allowed about the centre, then two pairs that are nearer. At an end
   of the range the nearest pair stays off it by a quarter of its width, where a node of the other may be */
double fw_study_derivative_node(const fw_study_input *in, double centre, int j) {
    const double whole = reach * (in->to - in->from);
    const bool far = j < NODES, last = j >= NODES + NEAREST;
    const double half = far ? whole : whole * (last ? nearest : nearer),
                 off = last ? 0.5 * half : 0;
    double low = fmax(in->from + off, centre - half), high = low + 2 * half;
    if (high > in->to - off) high = in->to - off, low = high - 2 * half;
    return far ? low + (high - low) * j / (NODES - 1.0) : (j - NODES) % 2 ? high : low;
}

static fw_status fill_node(void *context, long k, fw_study_sample *sample, bool *wanted) {
    const sensing *s = context;
    const fw_study *study = s->study;
    int of = (int)(k / ALL), j = (int)(k % ALL);
    *wanted = fw_study_is_due(study, k);
    sample->i = k;
    for (int v = 0; v < study->ninput; v++) {
        const fw_study_input *in = &study->input[v];
        double x = v == of ? fw_study_derivative_node(in, s->centre[v], j) : s->centre[v];
        FW_TRY(fw_study_input_write(in, x, DIGITS, sample->text[v], &sample->value[v]));
    }
    return FW_OK;
}

static fw_status take_node(void *context, const fw_study_sample *sample) {
    sensing *s = context;
    size_t k = (size_t)sample->i, n = (size_t)s->study->nresponse;
    s->node[k] = sample->value[k / ALL];
    memcpy(s->response + k * n, sample->response, n * sizeof *sample->response);
    return FW_OK;
}

/* what the polynomial through n nodes says at x */
static double interpolated(const double *node, const double *value, int n, double x) {
    double sum = 0;
    for (int i = 0; i < n; i++) {
        double part = value[i];
        for (int j = 0; j < n; j++)
            if (j != i) part *= (x - node[j]) / (node[i] - node[j]);
        sum += part;
    }
    return sum;
}

/* of values at n nodes, and what it is off by where each of them is off by `each` */
static double slope_of(const double *node, const double *value, int n, double at, double each,
                       double *off) {
    double w[NODES], sum = 0;
    *off = 0;
    fw_study_derivative_weights(node, n, at, w);
    for (int j = 0; j < n; j++)
        sum += w[j] * value[j], *off += fabs(w[j]) * each;
    return sum;
}

/* Where two pairs lie on both sides of a device, a corner there is what differences of pairs see nothing of: half of what the
   slope jumps by. What bends falls with the distance, by 0.44 from one pair to the other, and a corner stays. 0: none */
static double corner_of(const double *x, const double *value, double at, double each) {
    double bend[2];
    for (int p = 0; p < 2; p++) {
        const double *pair = x + NODES + p * NEAREST, *of = value + NODES + p * NEAREST;
        const double half = 0.5 * fabs(pair[1] - pair[0]);
        if (fabs(x[NODES / 2] - at) > 0.01 * half ||
            fabs(0.5 * (pair[0] + pair[1]) - at) > 0.01 * half)
            return 0;
        bend[p] = fmax(fabs(0.5 * (of[0] + of[1]) - value[NODES / 2]) - 2 * each, 0) / half;
    }
    return bend[1] > 0.7 * bend[0] ? bend[1] : 0;
}

void fw_study_derive(const double *x, const double *value, double at, double accuracy, double range,
                     fw_study_derivative *d) {
    const double *near = x + NODES, *close = near + NEAREST, *beside = value + NODES;
    double least = HUGE_VAL, most = -HUGE_VAL, size = 0, off[4], left[NEAR];
    for (int j = 0; j < NODES; j++)
        least = fmin(least, x[j]), most = fmax(most, x[j]);
    for (int j = 0; j < ALL; j++)
        size = fmax(size, fabs(value[j]));
    const double each = accuracy * size;
    const double all = slope_of(x, value, NODES, at, each, &off[0]),
                 inner = slope_of(x + 1, value + 1, INNER, at, each, &off[1]);
    const double fine = slope_of(near, beside, NEAR, at, each, &off[2]),
                 finest = slope_of(close, beside + NEAREST, NEAREST, at, each, &off[3]);
    const double other = (beside[1] - beside[0]) / (near[1] - near[0]);
    for (int j = 0; j < NEAR; j++)
        left[j] = beside[j] - interpolated(x, value, NODES, near[j]);
    double unused;
    const double missed = fabs(slope_of(near, left, NEAR, at, 0, &unused)) - off[2],
                 missed_nearest =
                     fabs(slope_of(close, left + NEAREST, NEAREST, at, 0, &unused)) - off[3];
    /* twice: at an end of the range they are all on one side of it, and see the slope a little off */
    const double corner = corner_of(x, value, at, each);
    const double error = fmax(fmax(fmax(fabs(all - inner), off[0]), corner),
                              2 * fmax(missed, missed_nearest)),
                 fine_error = fmax(fmax(fabs(other - finest), off[2]), corner);
    const bool far = !isnan(all) && !(fine_error < error); /* an error of NaN is not less */
    const double value_is = far ? all : fine, error_is = far ? error : fine_error;
    const double reaches = 0.5 * (most - least);
    *d = (fw_study_derivative){.value = value_is,
                               .error = error_is,
                               .spread = 0.5 * value_is * range,
                               .wide = error > finer * fabs(value_is) && !far ? reaches : 0,
                               .over = far ? reaches : 0.5 * fabs(close[1] - close[0]),
                               .slope = {(double)NAN, (double)NAN}};
    if (error_is > known * fabs(value_is) && 0.5 * error_is * range > little * size)
        *d = (fw_study_derivative){.value = (double)NAN,
                                   .error = (double)NAN,
                                   .spread = (double)NAN,
                                   .wide = reaches,
                                   .over = 0.5 * fabs(close[1] - close[0]),
                                   .slope = {all, finest}};
}

static void derive(const sensing *s, int k, int r, fw_study_derivative *d) {
    const fw_study_input *in = &s->study->input[k];
    const size_t n = (size_t)s->study->nresponse, row = (size_t)k * ALL;
    double value[ALL];
    for (size_t j = 0; j < ALL; j++)
        value[j] = s->response[(row + j) * n + (size_t)r];
    fw_study_derive(s->node + row, value, s->centre[k], s->accuracy, in->to - in->from, d);
}

static fw_status derivatives(sensing *s, fw_study_result *result) {
    fw_study *study = s->study;
    size_t inputs = (size_t)study->ninput, n = (size_t)study->nresponse;
    FW_NEED(s->centre = fw_arena_array(study->arena, double, inputs));
    FW_NEED(s->node = fw_arena_array(study->arena, double, inputs *ALL));
    FW_NEED(s->response = fw_arena_array(study->arena, double, inputs *ALL *n));
    FW_NEED(result->derivative = fw_arena_array(study->arena, fw_study_derivative, inputs * n));
    for (size_t k = 0; k < inputs * ALL * n; k++)
        s->response[k] = (double)NAN;
    for (size_t k = 0; k < inputs; k++) {
        double shown;
        char text[FW_STUDY_TEXT];
        FW_TRY(fw_study_input_write(&study->input[k], fw_study_input_centre(&study->input[k]),
                                    DIGITS, text, &shown));
        s->centre[k] = shown;
    }
    const double asked = fw_study_tighten(study);
    s->accuracy = study->options.design.rtol > 0 ? study->options.design.rtol
                                                 : study->options.design.accuracy;
    const fw_study_work work = {
        .n = (long)inputs * ALL, .fill = fill_node, .take = take_node, .context = s};
    fw_status status = fw_study_pool_run(study, &work);
    study->options.design.accuracy = asked;
    FW_TRY(status);
    for (int r = 0; r < study->nresponse; r++)
        for (int k = 0; k < study->ninput; k++)
            derive(s, k, r, &result->derivative[(size_t)r * inputs + (size_t)k]);
    return FW_OK;
}

/* ---- shares of the variance ---- */

static fw_status fill_point(void *context, long k, fw_study_sample *sample, bool *wanted) {
    const sensing *s = context;
    const fw_study *study = s->study;
    const double *u = s->u + (size_t)k * (size_t)study->ninput;
    sample->i = s->base + (long)s->first + k;
    *wanted = fw_study_is_due(study, sample->i);
    for (int v = 0; v < study->ninput; v++)
        FW_TRY(fw_study_input_at(&study->input[v], fw_maths_normal_cdf(u[v]), SPREAD_DIGITS,
                                 sample->text[v], &sample->value[v]));
    return FW_OK;
}

static fw_status take_point(void *context, const fw_study_sample *sample) {
    sensing *s = context;
    size_t n = (size_t)s->study->nresponse, k = (size_t)(sample->i - s->base) - s->first;
    memcpy(s->value + k * n, sample->response, n * sizeof *sample->response);
    return FW_OK;
}

static fw_status model(void *context, size_t first, size_t count, const double *u, double *value) {
    sensing *s = context;
    size_t n = (size_t)s->study->nresponse;
    s->first = first, s->u = u, s->value = value;
    for (size_t k = 0; k < count * n; k++)
        value[k] = (double)NAN; /* of another shard */
    const fw_study_work work = {
        .n = (long)count, .fill = fill_point, .take = take_point, .context = s};
    return fw_study_pool_run(s->study, &work);
}

static long base_of(const fw_study *study) {
    return study->asked->samples > 0 ? study->asked->samples : BASE_USUAL;
}

long fw_study_count_tight(const fw_study *study) {
    return ALL * (long)study->ninput;
}

long fw_study_count_sensitivity(const fw_study *study) {
    return fw_study_count_tight(study) + base_of(study) * (study->ninput + 2L);
}

static fw_status take_indices(fw_study *study, fw_study_result *result,
                              const fw_chance_indices *out) {
    size_t inputs = (size_t)study->ninput, n = (size_t)study->nresponse;
    FW_NEED(result->index = fw_arena_array(study->arena, fw_study_index, inputs * n));
    for (size_t k = 0; k < inputs * n; k++)
        result->index[k] =
            (fw_study_index){out->first[k].value, out->first[k].low, out->first[k].high,
                             out->total[k].value, out->total[k].low, out->total[k].high};
    FW_NEED(result->index_rows = fw_arena_grow(study->arena, out->rows, n, n, sizeof *out->rows));
    result->index_rows_all = out->evaluations / (inputs + 2);
    return FW_OK;
}

static fw_chance_model model_of(const fw_study *study, sensing *s) {
    return (fw_chance_model){.dimensions = (size_t)study->ninput,
                             .responses = (size_t)study->nresponse,
                             .f = model,
                             .context = s};
}

static fw_chance_index_options options_of(const fw_study *study) {
    return (fw_chance_index_options){.seed = (uint64_t)study->asked->seed,
                                     .base = (size_t)base_of(study),
                                     .level = study->asked->confidence};
}

static fw_status not_begun(fw_study *study, const char *why) {
    return fw_diag_error(&study->diags, 490, study->asked->place, "study '%s': %s",
                         study->asked->name, why ? why : "its indices could not be begun");
}

/* a range says where the question is: there, and not where the description is */
static fw_status ask_inside(fw_study *study, const fw_study_input *in) {
    if (fw_study_input_is_inside(in) || isnan(in->now)) return FW_OK;
    fw_diag_warning(
        &study->diags, 649, in->place,
        "'%s': the description has another value than its range: derivatives are taken "
        "at the middle of the range, and not at the description; make the range hold it "
        "to have them there",
        in->what);
    return study->diags.failed ? FW_NOMEM : FW_OK;
}

fw_status fw_study_check_sensitivity(fw_study *study) {
    const fw_chance_model of = model_of(study, NULL);
    const fw_chance_index_options o = options_of(study);
    const char *why;
    for (int k = 0; k < study->ninput; k++)
        if (study->input[k].ntext > 0 || isnan(study->input[k].from))
            return fw_diag_error(&study->diags, 490, study->input[k].place,
                                 "'%s': a derivative is by a number; give from and to instead of "
                                 "listed values, and leave <uncertain> to kind=\"yield\"",
                                 study->input[k].what);
    for (int k = 0; k < study->ninput; k++)
        FW_TRY(ask_inside(study, &study->input[k]));
    return fw_chance_indices_check(&of, &o, &why) == FW_OK ? FW_OK : not_begun(study, why);
}

static fw_status indices(sensing *s, fw_study_result *result) {
    fw_study *study = s->study;
    fw_chance_indices out;
    const char *why = NULL;
    const fw_chance_model of = model_of(study, s);
    const fw_chance_index_options o = options_of(study);
    s->base = fw_study_count_tight(study);
    /* in an arena of their own: they give back what they took, and we keep things meanwhile */
    FW_NEED(s->chance = fw_arena_part(study->arena, 0));
    fw_status status = fw_chance_indices_run(s->chance, &of, &o, &out, &why);
    if (status == FW_INPUT) return not_begun(study, why);
    FW_TRY(status);
    return take_indices(study, result, &out);
}

fw_status fw_study_kind_sensitivity(fw_study *study, fw_study_result *result) {
    sensing s = {.study = study};
    FW_TRY(derivatives(&s, result));
    fw_status status = indices(&s, result);
    fw_arena_free(s.chance);
    return status;
}
