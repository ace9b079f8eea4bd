/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Decisions, their order, and the errors of the model that they allow for. */
#include "verdict/verdict_parts.h"
#include <math.h>

/* motion: largest difference of any hinge's peak section moment, joint force included, between
   ideal pins and geometrically exact flexures over the four reference load cases of a whole
   six-bar, 2.9 % (0.7 % at the governing hinge); strain: more than the closed form's peak strain is
   off by within its range (fw_flexure_error), for what is bounded and not judged */
const fw_verdict_model_errors fw_verdict_model_error = {0.029, 0.029};
const double fw_verdict_first_accuracy = 3e-2;

const char *fw_verdict_decision_text(fw_verdict_decision decision) {
    switch (decision) {
    case FW_ACCEPT:
        return "accept";
    case FW_INCONCLUSIVE:
        return "inconclusive";
    case FW_REJECT:
        return "reject";
    }
    return "inconclusive";
}

/* the order of decisions: nothing else compares them */
static int badness(fw_verdict_decision decision) {
    switch (decision) {
    case FW_ACCEPT:
        return 0;
    case FW_INCONCLUSIVE:
        return 1;
    case FW_REJECT:
        break;
    }
    return 2;
}

bool fw_verdict_is_worse(fw_verdict_decision a, fw_verdict_decision b) {
    return badness(a) > badness(b);
}

fw_verdict_decision fw_verdict_worse(fw_verdict_decision a, fw_verdict_decision b) {
    return fw_verdict_is_worse(a, b) ? a : b;
}

/* the worse decision, then the higher utilisation; the band holds that of both */
void fw_verdict_keep_worst(fw_verdict_hinge_verdict *worst, const fw_verdict_hinge_verdict *other) {
    double low = fmax(worst->utilisation_low, other->utilisation_low);
    double high = fmax(worst->utilisation_high, other->utilisation_high);
    double breaks = worst->scene ? worst->failure_probability : (double)NAN;
    if (!worst->scene || fw_verdict_governs(other, worst)) *worst = *other;
    worst->failure_probability = fmax(breaks, other->failure_probability); /* passes by NaN */
    worst->utilisation_low = low;
    worst->utilisation_high = high;
}

bool fw_verdict_governs(const fw_verdict_hinge_verdict *h, const fw_verdict_hinge_verdict *other) {
    if (h->decision != other->decision) return fw_verdict_is_worse(h->decision, other->decision);
    return h->utilisation > other->utilisation;
}
