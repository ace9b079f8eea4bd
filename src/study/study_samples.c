/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of inputs, and what all kinds of studies ask of their samples. */
#include "base/sort.h"
#include "base/text.h"
#include "study/study_parts.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- values of inputs ----
   Numbers in SI inside, texts as --set takes them outside. What counts is the text: the value of a sample is the
   one that its text has. Test: tests/unit/study/test_response.c */

enum { SWEPT = 12 }; /* digits of a step, as those of a wafer's sweep */

fw_status fw_study_input_write(const fw_study_input *input, double value, int digits,
                               char text[FW_STUDY_TEXT], double *shown) {
    char number[40];
    double read;
    fw_number_text(number, sizeof number, fw_quantity_unit_from_si(&input->unit, value), digits);
    if (!fw_number_parse(number, strlen(number), &read)) return FW_INTERNAL;
    *shown = fw_quantity_unit_to_si(&input->unit, read);
    int n = snprintf(text, FW_STUDY_TEXT, "%s%s%s", number, *input->unit_text ? " " : "",
                     input->unit_text);
    return n < FW_STUDY_TEXT ? FW_OK : FW_LIMIT;
}

int fw_study_input_steps(const fw_study_input *input) {
    return input->ntext > 0 ? input->ntext : input->steps;
}

static fw_status listed(const fw_study_input *input, int k, char text[FW_STUDY_TEXT],
                        double *value) {
    const char *given = input->text[k];
    size_t n = strcspn(given, " \t");
    double number;
    fw_quantity_unit unit = {.factor = 1};
    snprintf(text, FW_STUDY_TEXT, "%s", given);
    *value = (double)NAN;
    if (!fw_number_parse(given, n, &number)) return FW_OK;
    const char *rest = given + n + strspn(given + n, " \t");
    if (*rest && !fw_quantity_unit_parse(rest, strlen(rest), &unit, NULL, NULL)) return FW_OK;
    *value = fw_quantity_unit_to_si(&unit, number);
    return FW_OK;
}

static double between(const fw_study_input *input, double share) {
    if (share <= 0) return input->from;
    if (share >= 1) return input->to;
    return input->logarithmic ? input->from * pow(input->to / input->from, share)
                              : input->from + (input->to - input->from) * share;
}

fw_status fw_study_input_step(const fw_study_input *input, int k, char text[FW_STUDY_TEXT],
                              double *value) {
    if (input->ntext > 0) return listed(input, k, text, value);
    return fw_study_input_write(input, between(input, k / (input->steps - 1.0)), SWEPT, text,
                                value);
}

fw_status fw_study_input_at(const fw_study_input *input, double share, int digits,
                            char text[FW_STUDY_TEXT], double *value) {
    if (input->ntext > 0) {
        int k = (int)(share * input->ntext);
        return listed(input, k < 0 ? 0 : k >= input->ntext ? input->ntext - 1 : k, text, value);
    }
    return fw_study_input_write(input, between(input, share), digits, text, value);
}

double fw_study_input_share(const fw_study_input *input, double value) {
    double share = input->logarithmic ? log(value / input->from) / log(input->to / input->from)
                                      : (value - input->from) / (input->to - input->from);
    return fmin(fmax(share, 0), 1);
}

/* ---- samples: are they due, kept, within their limits ---- */

fw_status fw_study_keep(fw_study *study, const fw_study_sample *sample) {
    return study->store ? fw_study_store_add(study->store, sample) : FW_OK;
}

bool fw_study_is_due(const fw_study *study, long i) {
    return study->options.shards == 0 || i % study->options.shards == study->options.shard - 1;
}

static int by_number(const void *a, const void *b) {
    return fw_order_wholes(((const fw_study_sample *)a)->i, ((const fw_study_sample *)b)->i);
}

void fw_study_sort_samples(fw_study_sample *sample, int n) {
    if (n > 1) qsort(sample, (size_t)n, sizeof *sample, by_number);
}

/* relative to the limit where that is not 0 */
static double missed(double by, double limit) {
    return by / (limit != 0 ? fabs(limit) : 1);
}

double fw_study_excess(const fw_study *study, const fw_study_sample *sample) {
    double most = -HUGE_VAL;
    if (!sample->run) return (double)NAN;
    for (int k = 0; k < study->nresponse; k++) {
        const fw_device_respond *q = study->response[k].asked;
        double value = sample->response[k];
        if (isnan(q->min) && isnan(q->max)) continue;
        if (isnan(value)) return (double)NAN;
        if (!isnan(q->min)) most = fmax(most, missed(q->min - value, q->min));
        if (!isnan(q->max)) most = fmax(most, missed(value - q->max, q->max));
    }
    return most;
}
