/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws that are straight between their breaks: step, ramp and table. Their bounds are exact. Test:
 * test_time_law.c */
#include "quantity/law_kind.h"
#include <math.h>

static void constant(double value[3], double factor) {
    value[0] = factor;
    value[1] = value[2] = 0;
}

/* ---- step: 0 before start, 1 from start on, 0 again from end on (end: may be infinite) ---- */

static void step_value(const fw_quantity_law *law, double t_s, double piece_s, double value[3]) {
    (void)t_s;
    constant(value, piece_s >= law->start_s && piece_s < law->end_s ? 1 : 0);
}

static void step_breaks(const fw_quantity_law *law, fw_quantity_law_breaks *b) {
    fw_quantity_law_break(b, law->start_s);
    fw_quantity_law_break(b, law->end_s);
}

static double step_largest(const fw_quantity_law *law, double end_s) {
    return law->start_s <= end_s && law->end_s > 0 && law->start_s < law->end_s ? 1 : 0;
}

static void step_size(const fw_quantity_law *law, double end_s, fw_quantity_law_size *size) {
    (void)law, (void)end_s;
    size->variation = 2;
}

static bool step_is_constant(const fw_quantity_law *law) {
    return law->start_s <= 0 && isinf(law->end_s);
}

static const fw_quantity_law_attribute step_attributes[] = {FW_LAW_START, FW_LAW_END};
const fw_quantity_law_kind fw_quantity_law_step = {.name = "step",
                                                   .factor =
                                                       "0, from `start` on 1, from `end` on 0",
                                                   .words = "[ from {start} on][ until {end}]",
                                                   FW_LAW_ROWS(step_attributes),
                                                   .value = step_value,
                                                   .breaks = step_breaks,
                                                   .largest = step_largest,
                                                   .size = step_size,
                                                   .stepwise = true,
                                                   .straight = fw_quantity_law_always,
                                                   .never_negative = fw_quantity_law_always,
                                                   .is_constant = step_is_constant,
                                                   .is_wrong = fw_quantity_law_ends_early};

/* ---- ramp: 0 before start, rises linearly over `rise`, then 1 ---- */

static void ramp_value(const fw_quantity_law *law, double t_s, double piece_s, double value[3]) {
    constant(value, piece_s < law->start_s ? 0 : 1);
    if (piece_s < law->start_s || piece_s >= law->start_s + law->rise_s) return;
    value[0] = (t_s - law->start_s) / law->rise_s;
    value[1] = 1 / law->rise_s;
}

static void ramp_breaks(const fw_quantity_law *law, fw_quantity_law_breaks *b) {
    fw_quantity_law_break(b, law->start_s);
    fw_quantity_law_break(b, law->start_s + law->rise_s);
}

static double ramp_largest(const fw_quantity_law *law, double end_s) {
    double value[3];
    ramp_value(law, end_s, end_s, value);
    return fabs(value[0]);
}

static void ramp_size(const fw_quantity_law *law, double end_s, fw_quantity_law_size *size) {
    (void)end_s;
    size->slope = 1 / law->rise_s;
    size->variation = size->most;
}

static const fw_quantity_law_attribute ramp_attributes[] = {
    FW_LAW_START, FW_LAW_RISE("time that it takes from nothing to the full size")};
const fw_quantity_law_kind fw_quantity_law_ramp = {
    .name = "ramp",
    .factor = "0, rising from `start` on in the time `rise` to 1",
    .words = " over {rise}[ from {start} on]",
    FW_LAW_ROWS(ramp_attributes),
    .value = ramp_value,
    .breaks = ramp_breaks,
    .largest = ramp_largest,
    .size = ramp_size,
    .straight = fw_quantity_law_always,
    .never_negative = fw_quantity_law_always};

/* ---- table: linear between points, constant outside ---- */

/* the piece of the table that holds `piece_s`: index of its right end, 0 in front of the first
   point, ntable behind the last */
static int table_piece(const fw_quantity_law *law, double piece_s) {
    int low = 0, high = law->ntable;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (law->table_t_s[middle] <= piece_s)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void table_value(const fw_quantity_law *law, double t_s, double piece_s, double value[3]) {
    int right = table_piece(law, piece_s);
    if (right == 0 || right == law->ntable) {
        constant(value, law->ntable > 0 ? law->table_value[right ? right - 1 : 0] : 0);
        return;
    }
    double t0 = law->table_t_s[right - 1], t1 = law->table_t_s[right];
    double v0 = law->table_value[right - 1], v1 = law->table_value[right];
    double slope = (v1 - v0) / (t1 - t0);
    /* from the nearer end, so that both ends are met exactly */
    value[0] = t_s - t0 <= t1 - t_s ? v0 + slope * (t_s - t0) : v1 - slope * (t1 - t_s);
    value[1] = slope;
    value[2] = 0;
}

static void table_breaks(const fw_quantity_law *law, fw_quantity_law_breaks *b) {
    for (int i = 0; i < law->ntable; i++)
        fw_quantity_law_break(b, law->table_t_s[i]);
}

static double table_largest(const fw_quantity_law *law, double end_s) {
    double value[3], most;
    table_value(law, 0, 0, value);
    most = fabs(value[0]);
    table_value(law, end_s, end_s, value);
    most = fmax(most, fabs(value[0]));
    for (int i = 0; i < law->ntable; i++)
        if (law->table_t_s[i] >= 0 && law->table_t_s[i] <= end_s)
            most = fmax(most, fabs(law->table_value[i]));
    return most;
}

static void table_size(const fw_quantity_law *law, double end_s, fw_quantity_law_size *size) {
    (void)end_s;
    double last = 0;
    for (int i = 0; i < law->ntable; i++) {
        double step = fabs(law->table_value[i] - last);
        size->variation += step;
        if (i > 0)
            size->slope = fmax(size->slope, step / (law->table_t_s[i] - law->table_t_s[i - 1]));
        last = law->table_value[i];
    }
}

static bool table_never_negative(const fw_quantity_law *law) {
    for (int i = 0; i < law->ntable; i++)
        if (!(law->table_value[i] >= 0)) return false;
    return true;
}

static const fw_quantity_law_attribute table_attributes[] = {
    {"table", FW_QUANTITY_LAW_POINTS, .needed = true, .unit = "ms",
     .sentence = "the factor at rising times; linear between them, constant before and behind"}};
const fw_quantity_law_kind fw_quantity_law_table = {
    .name = "table",
    .factor = "`0 ms: 0; 1 ms: 0.5; 2 ms: 1`, linear between the points, constant outside",
    .words = " in time",
    FW_LAW_ROWS(table_attributes),
    .value = table_value,
    .breaks = table_breaks,
    .largest = table_largest,
    .size = table_size,
    .straight = fw_quantity_law_always,
    .never_negative = table_never_negative,
    .may_be_nothing = "table"};
