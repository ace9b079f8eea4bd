/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Values of inputs: numbers in SI inside, texts as --set takes them outside. What counts is the text: the
   value of a sample is the one that its text has. Test: tests/unit/study/test_response.c */
#include "base/text.h"
#include "study/study_parts.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

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
