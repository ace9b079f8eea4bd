/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What all kinds of studies ask of their samples: are they due, kept, within their limits. */
#include "base/sort.h"
#include "study/study_parts.h"
#include <math.h>

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
