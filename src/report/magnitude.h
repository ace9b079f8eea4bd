/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The unit in which a column of numbers reads best. */
#ifndef FW_REPORT_MAGNITUDE_H
#define FW_REPORT_MAGNITUDE_H

typedef enum fw_measure { FW_MEASURE_LENGTH, FW_MEASURE_FORCE, FW_MEASURE_TIME } fw_measure;

typedef struct fw_magnitude {
    const char *unit;
    double per_si; /* times the SI value */
} fw_magnitude;

/* the largest of um, mm, m, km (uN, mN, N, kN, MN; us, ms, s) in which `largest_si` is at least 1
 */
fw_magnitude fw_magnitude_of(fw_measure measure, double largest_si);

#endif
