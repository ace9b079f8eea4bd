/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Okabe and Ito, Color Universal Design (2008). Colour never stands alone: every mark that uses it
   also carries a number or a word. */
#include "report/page.h"
#include <math.h>
#include <string.h>

const fw_report_class fw_report_classes[FW_REPORT_CLASSES] = {
    {0.5, "#0072B2", "below 50 %"},          {0.8, "#009E73", "50 to 80 %"},
    {1.0, "#E69F00", "80 to 100 %"},         {HUGE_VAL, "#D55E00", "above the limit"},
    {HUGE_VAL, "#767676", "no limit known"},
};

const char *fw_report_utilisation_colour(double utilisation) {
    if (isnan(utilisation)) return fw_report_classes[FW_REPORT_CLASSES - 1].colour;
    int i = 0;
    while (i < FW_REPORT_CLASSES - 2 && !(utilisation < fw_report_classes[i].below))
        i++;
    return fw_report_classes[i].colour;
}

static const struct {
    const char *word, *colour;
} decisions[] = {
    [FW_ACCEPT] = {"ACCEPT", "#00694D"},
    [FW_INCONCLUSIVE] = {"INCONCLUSIVE", "#8A5A00"},
    [FW_REJECT] = {"REJECT", "#B03A00"},
};

const char *fw_report_decision_colour(fw_decision decision) {
    return decisions[decision <= FW_REJECT ? decision : FW_INCONCLUSIVE].colour;
}

const char *fw_report_rejected(const fw_verdict *verdict) {
    return verdict && verdict->decision == FW_REJECT ? "REJECTED: " : "";
}

const char *fw_report_decision_word(fw_decision decision) {
    return decisions[decision <= FW_REJECT ? decision : FW_INCONCLUSIVE].word;
}

const char *fw_report_layer_colour(const char *colour, int index) {
    static const char *const palette[] = {"#0072B2", "#E69F00", "#009E73", "#CC79A7",
                                          "#56B4E9", "#D55E00", "#F0E442", "#767676"};
    size_t n = colour ? strlen(colour) : 0;
    if ((n == 4 || n == 7) && colour[0] == '#' &&
        strspn(colour + 1, "0123456789abcdefABCDEF") == n - 1)
        return colour;
    return palette[(unsigned)index % (sizeof palette / sizeof palette[0])];
}
