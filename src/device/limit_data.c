/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "device/limit_data.h"
#include <math.h>
#include <stddef.h>
#include <string.h>

#define PRESSURE .dimension = {-1, 1, -2, 0, 0, 0, 0}
#define AT(name) .offset = offsetof(fw_limit_data, name)

typedef struct limit_row {
    fw_dimension dimension;
    size_t offset;
    double low, high; /* open below, closed above */
    const char *range;
} limit_row;

static const char *const ids[FW_LIMIT_DATA] = {
    "weibull-strength",    "weibull-modulus",   "weibull-area",    "offset-yield",
    "proportional-factor", "film-yield",        "film-yield-rise", "film-exponent",
    "film-thickest",       "fatigue-strength",  "fatigue-cycles",  "fatigue-exponent",
    "ductility",           "ductility-exponent"};

static const limit_row rows[FW_LIMIT_DATA] = {
    {PRESSURE, AT(weibull_strength), 0, 2e11, "above 0 and at most 200 GPa"},
    {AT(weibull_modulus), .low = 0, .high = 200,
     .range = "above 0 and at most 200 (0 or below is no distribution; 3 to 30 are reported)"},
    {.dimension = {.m = 2}, AT(weibull_area), 0, 1, "above 0 and at most 1 m2"},
    {PRESSURE, AT(offset_yield), 0, 2e11, "above 0 and at most 200 GPa"},
    {AT(proportional_factor), .low = 0, .high = 1,
     .range = "above 0 and at most 1 (the proportional limit lies below the 0.2 % offset value)"},
    {PRESSURE, AT(film_yield), 0, 2e11, "above 0 and at most 200 GPa"},
    {PRESSURE, AT(film_yield_rise), 0, 2e11, "above 0 and at most 200 GPa"},
    {AT(film_exponent), .low = 0, .high = 2, .range = "above 0 and at most 2"},
    {.dimension = {.m = 1}, AT(film_thickest), 0, 1e-3, "above 0 and at most 1 mm"},
    {PRESSURE, AT(fatigue_strength), 0, 2e11, "above 0 and at most 200 GPa"},
    {AT(fatigue_cycles), .low = 0, .high = 1e15, .range = "above 0 and at most 1e15"},
    {AT(fatigue_exponent), .low = -1, .high = -1e-6,
     .range = "above -1 and below 0 (more cycles bear less)"},
    {AT(ductility), .low = 0, .high = 10, .range = "above 0 and at most 10"},
    {AT(ductility_exponent), .low = -1, .high = -1e-6,
     .range = "above -1 and below 0 (more cycles bear less)"},
};

fw_quantity *fw_limit_data_at(fw_limit_data *data, int k) {
    return (fw_quantity *)(void *)((char *)data + rows[k].offset);
}

static const fw_quantity *at(const fw_limit_data *data, int k) {
    return (const fw_quantity *)(const void *)((const char *)data + rows[k].offset);
}

const char *fw_limit_data_id(int k) {
    return ids[k];
}

const char *const *fw_limit_data_ids(void) {
    return ids;
}

fw_dimension fw_limit_data_dimension(int k) {
    return rows[k].dimension;
}

int fw_limit_data_index(const char *id) {
    for (int k = 0; k < FW_LIMIT_DATA; k++)
        if (strcmp(ids[k], id) == 0) return k;
    return -1;
}

void fw_limit_data_check(int k, const fw_quantity *q, fw_place place, fw_diags *diags) {
    if (q->unknown || (q->value > rows[k].low && q->value <= rows[k].high)) return;
    fw_diag_error(diags, 47, place, "%s must be %s", ids[k], rows[k].range);
}

/* how many of the quantities from..to-1 are known; *first: place of the first of them */
static int known(const fw_limit_data *data, int from, int to, fw_place *first) {
    int n = 0;
    for (int k = from; k < to; k++)
        if (!at(data, k)->unknown && n++ == 0) *first = at(data, k)->place;
    return n;
}

void fw_limit_data_complete(const fw_limit_data *data, const char *whose, fw_place place,
                            fw_diags *diags) {
    int n = known(data, 0, 3, &place);
    if (n == 1 || n == 2)
        fw_diag_error(diags, 233, place,
                      "%s has %d of weibull-strength, weibull-modulus and weibull-area: a strength "
                      "holds only for the area and the scatter that it was found with; give all "
                      "three or none",
                      whose, n);
    n = !data->fatigue_strength.unknown + !data->fatigue_cycles.unknown;
    if (n == 1)
        fw_diag_error(diags, 234,
                      data->fatigue_strength.unknown ? data->fatigue_cycles.place
                                                     : data->fatigue_strength.place,
                      "%s has one of fatigue-strength and fatigue-cycles: an amplitude holds only "
                      "for a number of cycles; give both or none",
                      whose);
}

fw_limit_data fw_limit_data_none(fw_place place) {
    fw_limit_data none;
    memset(&none, 0, sizeof none);
    for (int k = 0; k < FW_LIMIT_DATA; k++)
        *fw_limit_data_at(&none, k) = (fw_quantity){.id = ids[k],
                                                    .unknown = true,
                                                    .dimension = rows[k].dimension,
                                                    .unit = "",
                                                    .status = FW_ASSUMED,
                                                    .source = "",
                                                    .place = place};
    return none;
}
