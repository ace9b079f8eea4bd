/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Questions about a law, put to its row, and what holds where the row does not say. */
#include "quantity/law_kind.h"
#include <math.h>
#include <string.h>

#define FW_LAW(name) &fw_quantity_law_##name,
const fw_quantity_law_kind *const fw_quantity_law_kinds[] = {
#include "quantity/laws.def"
    NULL};
#undef FW_LAW

const fw_quantity_law_kind *fw_quantity_law_find(const char *name) {
    const fw_quantity_law_kind *const *kind = fw_quantity_law_kinds;
    while (*kind && strcmp((*kind)->name, name) != 0)
        kind++;
    return *kind;
}

double fw_quantity_law_number(const fw_quantity_law *law,
                              const fw_quantity_law_attribute *attribute) {
    double value;
    memcpy(&value, (const char *)law + attribute->offset, sizeof value);
    return value;
}

const char *fw_quantity_law_name(const fw_quantity_law *law) {
    return law->kind->name;
}

void fw_quantity_law_value(const fw_quantity_law *law, double t_s, double piece_s,
                           double value[3]) {
    law->kind->value(law, t_s, piece_s, value);
}

int fw_quantity_law_breaks_of(const fw_quantity_law *law, double end_s, double *t_s, int most) {
    fw_quantity_law_breaks b = {end_s, t_s, most, 0};
    if (law && law->kind->breaks) law->kind->breaks(law, &b);
    return b.count;
}

/* ---- size ---- */

enum { SAMPLES = 2000 };

static double largest_sampled(const fw_quantity_law *law, double end_s) {
    double most = 0, value[3];
    for (int i = 0; i <= SAMPLES; i++) {
        double t_s = end_s * i / SAMPLES;
        fw_quantity_law_value(law, t_s, t_s, value);
        if (!isfinite(value[0])) return (double)INFINITY;
        most = fmax(most, fabs(value[0]));
    }
    return most;
}

double fw_quantity_law_largest(const fw_quantity_law *law, double end_s) {
    if (!law) return 1;
    return law->kind->largest ? law->kind->largest(law, end_s) : largest_sampled(law, end_s);
}

/* without a row's own bounds: none, since samples would have to stand for a proof */
fw_quantity_law_size fw_quantity_law_measure(const fw_quantity_law *law, double end_s) {
    fw_quantity_law_size size = {.most = 1, .variation = 1};
    if (fw_quantity_law_is_constant(law)) return size;
    size.most = size.slope = size.variation = (double)INFINITY;
    if (!law->kind->size) return size;
    size = (fw_quantity_law_size){.most = fw_quantity_law_largest(law, end_s)};
    law->kind->size(law, end_s, &size);
    return size;
}

/* ---- what it is like ---- */

bool fw_quantity_law_is_constant(const fw_quantity_law *law) {
    return !law || (law->kind->is_constant && law->kind->is_constant(law));
}

bool fw_quantity_law_is_straight(const fw_quantity_law *law) {
    return !law || (law->kind->straight && law->kind->straight(law));
}

bool fw_quantity_law_never_negative(const fw_quantity_law *law) {
    return !law || (law->kind->never_negative && law->kind->never_negative(law));
}

bool fw_quantity_law_is_ready(const fw_quantity_law *law) {
    return !law->kind->is_ready || law->kind->is_ready(law);
}

fw_quantity_law_wave fw_quantity_law_wave_of(const fw_quantity_law *law) {
    return law && law->kind->wave ? law->kind->wave(law) : (fw_quantity_law_wave){0};
}
