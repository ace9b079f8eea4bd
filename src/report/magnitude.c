/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/magnitude.h"
#include <math.h>

fw_magnitude fw_magnitude_of(fw_measure measure, double largest_si) {
    enum { MOST = 5 };
    static const fw_magnitude table[3][MOST + 1] = {
        {{"nm", 1e9}, {"um", 1e6}, {"mm", 1e3}, {"m", 1}, {"km", 1e-3}},
        {{"nN", 1e9}, {"uN", 1e6}, {"mN", 1e3}, {"N", 1}, {"kN", 1e-3}, {"MN", 1e-6}},
        {{"ns", 1e9}, {"us", 1e6}, {"ms", 1e3}, {"s", 1}},
    };
    const fw_magnitude *row = table[measure];
    int i = 0;
    while (i < MOST && row[i + 1].unit && fabs(largest_si) * row[i + 1].per_si >= 1)
        i++;
    return largest_si == 0 ? row[2] : row[i]; /* mm, mN, ms */
}
