/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Sensitivity: derivatives of every response at the description as it stands (of an input that the description has outside
   of its range at the middle of that, which is said), and the shares of its variance over the ranges (Sobol' indices).

   A derivative is that of the polynomial through seven devices, evenly spaced over a tenth of the range
   either side (moved inside where the range ends), judged at an accuracy of 1e-9; its error is the
   difference to the polynomial through the inner five. Weights: Fornberg 1988. Test: tests/unit/study/
   test_response.c (weights), tests/cli/test_study.py against differences of tight runs. */
#include "chance/joint.h"
#include "maths/functions.h"
#include "study/study_parts.h"
#include <math.h>
#include <string.h>

enum { NODES = 7, INNER = 5, DIGITS = 13, SPREAD_DIGITS = 9, BASE_USUAL = 128 };
static const double reach = 0.1; /* of the range, either side */

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
    double *node;     /* (ninput x NODES) SI, as their texts say */
    double *response; /* (ninput x NODES x nresponse) */
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

/* node j of an input: seven evenly spaced over what is allowed about the centre */
static double node_of(const fw_study_input *in, double centre, int j) {
    double half = reach * (in->to - in->from);
    double low = fmax(in->from, centre - half), high = low + 2 * half;
    if (high > in->to) high = in->to, low = high - 2 * half;
    return low + (high - low) * j / (NODES - 1.0);
}

static fw_status fill_node(void *context, long k, fw_study_sample *sample, bool *wanted) {
    const sensing *s = context;
    const fw_study *study = s->study;
    int of = (int)(k / NODES), j = (int)(k % NODES);
    *wanted = fw_study_is_due(study, k);
    sample->i = k;
    for (int v = 0; v < study->ninput; v++) {
        const fw_study_input *in = &study->input[v];
        double x = v == of ? node_of(in, s->centre[v], j) : s->centre[v];
        FW_TRY(fw_study_input_write(in, x, DIGITS, sample->text[v], &sample->value[v]));
    }
    return FW_OK;
}

static fw_status take_node(void *context, const fw_study_sample *sample) {
    sensing *s = context;
    size_t k = (size_t)sample->i, n = (size_t)s->study->nresponse;
    s->node[k] = sample->value[k / NODES];
    memcpy(s->response + k * n, sample->response, n * sizeof *sample->response);
    return FW_OK;
}

static void derive(const sensing *s, int k, int r, fw_study_derivative *d) {
    const fw_study *study = s->study;
    const double *x = s->node + (size_t)k * NODES;
    double w[NODES], all = 0, inner = 0;
    size_t n = (size_t)study->nresponse, row = (size_t)k * NODES;
    fw_study_derivative_weights(x, NODES, s->centre[k], w);
    for (size_t j = 0; j < NODES; j++)
        all += w[j] * s->response[(row + j) * n + (size_t)r];
    fw_study_derivative_weights(x + 1, INNER, s->centre[k], w);
    for (size_t j = 0; j < INNER; j++)
        inner += w[j] * s->response[(row + j + 1) * n + (size_t)r];
    *d = (fw_study_derivative){.value = all,
                               .error = fabs(all - inner),
                               .spread = 0.5 * all * (study->input[k].to - study->input[k].from)};
}

static fw_status derivatives(sensing *s, fw_study_result *result) {
    fw_study *study = s->study;
    size_t inputs = (size_t)study->ninput, n = (size_t)study->nresponse;
    FW_NEED(s->centre = fw_arena_array(study->arena, double, inputs));
    FW_NEED(s->node = fw_arena_array(study->arena, double, inputs *NODES));
    FW_NEED(s->response = fw_arena_array(study->arena, double, inputs *NODES *n));
    FW_NEED(result->derivative = fw_arena_array(study->arena, fw_study_derivative, inputs * n));
    for (size_t k = 0; k < inputs * NODES * n; k++)
        s->response[k] = (double)NAN;
    for (size_t k = 0; k < inputs; k++) {
        double shown;
        char text[FW_STUDY_TEXT];
        FW_TRY(fw_study_input_write(&study->input[k], fw_study_input_centre(&study->input[k]),
                                    DIGITS, text, &shown));
        s->centre[k] = shown;
    }
    double asked = study->options.design.accuracy;
    if (study->options.design.rtol == 0)
        study->options.design.accuracy = asked > 0 ? fmin(asked, 1e-9) : 1e-9;
    const fw_study_work work = {
        .n = (long)inputs * NODES, .fill = fill_node, .take = take_node, .context = s};
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

long fw_study_count_sensitivity(const fw_study *study) {
    return NODES * (long)study->ninput + base_of(study) * (study->ninput + 2L);
}

static fw_status take_indices(fw_study *study, fw_study_result *result,
                              const fw_chance_indices *out) {
    size_t inputs = (size_t)study->ninput, n = (size_t)study->nresponse;
    FW_NEED(result->index = fw_arena_array(study->arena, fw_study_index, inputs * n));
    for (size_t k = 0; k < inputs * n; k++)
        result->index[k] =
            (fw_study_index){out->first[k].value, out->first[k].low, out->first[k].high,
                             out->total[k].value, out->total[k].low, out->total[k].high};
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
    s->base = (long)study->ninput * NODES;
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
