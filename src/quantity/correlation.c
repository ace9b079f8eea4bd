/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers that were fitted to the same measurements have errors that go together. */
#include "quantity/quantity.h"
#include <string.h>

double fw_quantity_correlation(const fw_quantity *a, const fw_quantity *b) {
    for (int i = 0; b->id && i < a->ncorrelated; i++)
        if (strcmp(a->correlated[i].id, b->id) == 0) return a->correlated[i].correlation;
    return 0.0;
}
