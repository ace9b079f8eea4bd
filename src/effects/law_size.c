/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How large a law becomes, how steep, and how far it goes to and fro.

   Exact for steps, ramps and tables. Between two extremes a sine goes 2, and in n half periods
   there are at most n + 1 of them. Random: an upper bound of its size, the sum of all lines'
   slopes, and no bound on the variation. Expressions: no bounds, since samples would have to stand
   for a proof. Inputs s; outputs dimensionless, 1/s. Test: test_base_motion.c, test_bounds.c. */
#include "effects/effect.h"
#include <math.h>

#define PI 3.14159265358979323846

static fw_law_size of_table(const fw_law *law, double end_s) {
    fw_law_size size = {.most = fw_law_largest(law, end_s)};
    double last = 0;
    for (int i = 0; i < law->ntable; i++) {
        double step = fabs(law->table_value[i] - last);
        size.variation += step;
        if (i > 0)
            size.slope = fmax(size.slope, step / (law->table_t_s[i] - law->table_t_s[i - 1]));
        last = law->table_value[i];
    }
    return size;
}

fw_law_size fw_law_measure(const fw_law *law, double end_s) {
    fw_law_size size = {.most = 1, .variation = 1};
    if (fw_law_is_constant(law)) return size;
    size.most = fw_law_largest(law, end_s);
    double w = 2 * PI * law->frequency_Hz, time;
    switch (law->kind) {
    case FW_LAW_STEP:
        size.variation = 2;
        return size;
    case FW_LAW_RAMP:
        size.slope = 1 / law->rise_s;
        size.variation = size.most;
        return size;
    case FW_LAW_SINE:
        time = fmax(0, fmin(end_s, law->end_s) - law->start_s);
        size.slope = w;
        size.variation = 2 * ceil(w * time / PI) + 2;
        return size;
    case FW_LAW_HALF_SINE:
        size.slope = PI / law->rise_s;
        size.variation = 2;
        return size;
    case FW_LAW_TABLE:
        return of_table(law, end_s);
    case FW_LAW_RANDOM: /* sqrt(2/n) sum of n cosines */
        size.slope =
            sqrt(2.0 * law->lines) * 2 * PI * fmax(law->frequency_Hz, law->frequency_most_Hz);
        size.variation = (double)INFINITY;
        return size;
    case FW_LAW_EXPRESSION:
    default:
        size.most = size.slope = size.variation = (double)INFINITY;
        return size;
    }
}
