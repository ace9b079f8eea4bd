/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws in time, with a row each: straight ones, those of one sine, and expressions. Noise has a file of its own
   (law_random.c). Test: test_time_law.c */
#include "base/constants.h"
#include "quantity/law_kind.h"
#include "quantity/program.h"
#include <math.h>
#include <string.h>

/* ---- laws that are straight between their breaks; their bounds are exact ---- */

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

static double step_done(const fw_quantity_law *law) {
    return isfinite(law->end_s) ? law->end_s : law->start_s;
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
                                                   .done = step_done,
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

static double rise_done(const fw_quantity_law *law) { /* of a half-sine, too */
    return law->start_s + law->rise_s;
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
    .done = rise_done,
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

static double table_done(const fw_quantity_law *law) {
    return law->ntable > 0 ? law->table_t_s[law->ntable - 1] : 0;
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
    .done = table_done,
    .largest = table_largest,
    .size = table_size,
    .straight = fw_quantity_law_always,
    .never_negative = table_never_negative,
    .may_be_nothing = "table"};

/* ---- laws that are one sine: the sine itself, and its half, a shock ----

   Their largest values are exact. Between two extremes a sine goes 2, and in n half periods there
   are at most n + 1 of them. Test: test_base_motion.c */

/* int |f''| of f = sin(a) over phases a of length `turned` from `from`, per angular frequency */
static double phase_variation(double from, double turned) {
    double whole = floor(turned / FW_PI), rest = turned - whole * FW_PI;
    double start = from - FW_PI * floor(from / FW_PI),
           end = start + rest; /* |sin| has the period pi */
    double part = end <= FW_PI ? cos(start) - cos(end) : cos(start) + 2 + cos(end);
    return 2 * whole + part;
}

/* ---- sine: 0 before start, then sin(2 pi frequency (t - start) + phase), 0 from end on ---- */

static void sine_value(const fw_quantity_law *law, double t_s, double piece_s, double value[3]) {
    value[0] = value[1] = value[2] = 0;
    if (piece_s < law->start_s || piece_s >= law->end_s) return;
    double w = 2 * FW_PI * law->frequency_Hz, angle = w * (t_s - law->start_s) + law->phase_rad;
    value[0] = sin(angle);
    value[1] = w * cos(angle);
    value[2] = -w * w * value[0];
}

static void sine_breaks(const fw_quantity_law *law, fw_quantity_law_breaks *b) {
    fw_quantity_law_break(b, law->start_s);
    fw_quantity_law_break(b, law->end_s);
}

static double sine_largest(const fw_quantity_law *law, double end_s) {
    if (law->start_s > end_s || law->end_s <= 0) return 0;
    double first = law->phase_rad + 2 * FW_PI * law->frequency_Hz * fmax(0, -law->start_s);
    double last =
        law->phase_rad + 2 * FW_PI * law->frequency_Hz * (fmin(end_s, law->end_s) - law->start_s);
    /* a crest lies between: some pi/2 + n pi */
    if (floor(last / FW_PI - 0.5) >= ceil(first / FW_PI - 0.5)) return 1;
    return fmax(fabs(sin(first)), fabs(sin(last)));
}

static void sine_size(const fw_quantity_law *law, double end_s, fw_quantity_law_size *size) {
    double time_s = fmax(0, fmin(end_s, law->end_s) - law->start_s);
    size->slope = 2 * FW_PI * law->frequency_Hz;
    size->variation = 2 * ceil(size->slope * time_s / FW_PI) + 2;
}

/* it varies by 2/pi per radian, over part of a period by up to 0.43 more, and jumps where it begins
   and ends */
static double sine_variation(const fw_quantity_law *law, double end_s) {
    double time_s = fmin(end_s, law->end_s) - fmax(0, law->start_s);
    double jumps = (law->start_s > 0) + (law->end_s < end_s);
    return time_s > 0 ? 4 * law->frequency_Hz * time_s + 0.43 + jumps : 0;
}

static double sine_slope_variation(const fw_quantity_law *law, double a_s, double b_s) {
    double w = 2 * FW_PI * law->frequency_Hz, piece_s = 0.5 * (a_s + b_s);
    if (piece_s < law->start_s || piece_s >= law->end_s) return 0;
    return w * phase_variation(w * (a_s - law->start_s) + law->phase_rad, w * (b_s - a_s));
}

static fw_quantity_law_wave sine_wave(const fw_quantity_law *law) {
    return (fw_quantity_law_wave){.fastest_Hz = law->frequency_Hz,
                                  .rad_per_s = 2 * FW_PI * law->frequency_Hz,
                                  .repeats = true,
                                  .from_s = law->start_s,
                                  .to_s = law->end_s,
                                  .shortest_s = 1 / law->frequency_Hz,
                                  .attribute = "frequency"};
}

static const fw_quantity_law_attribute sine_attributes[] = {
    FW_LAW_START,
    FW_LAW_END,
    {"frequency", FW_LAW_MEMBER(frequency_Hz), .needed = true, FW_LAW_FREQUENCY,
     .sentence = "periods per second"},
    {"phase", FW_LAW_MEMBER(phase_rad), .dimension = {.rad = 1}, .unit = "deg", .si_unit = "rad",
     FW_LAW_RANGE(-2e4 * FW_PI, 2e4 * FW_PI,
                  "10000 turns, behind which an angle loses four digits"),
     .absent_text = "0 deg",
     .sentence = "angle at the start; 0 deg begins with nothing, 90 deg with all of it"}};
const fw_quantity_law_kind fw_quantity_law_sine = {
    .name = "sine",
    .factor = "sin(2 pi `frequency` (t - `start`) + `phase`) between `start` and `end`, else 0",
    .words = " of {frequency}[ from {start} on][ until {end}]",
    FW_LAW_ROWS(sine_attributes),
    .value = sine_value,
    .breaks = sine_breaks,
    .largest = sine_largest,
    .size = sine_size,
    .variation = sine_variation,
    .slope_variation = sine_slope_variation,
    .wave = sine_wave,
    .is_wrong = fw_quantity_law_ends_early};

/* ---- half-sine: sin(pi (t - start) / rise) for start < t < start + rise, else 0 ---- */

/* at its end from there, so that it is 0 to the last bit */
static void half_value(const fw_quantity_law *law, double t_s, double piece_s, double value[3]) {
    double w = FW_PI / law->rise_s, end_s = law->start_s + law->rise_s;
    value[0] = value[1] = value[2] = 0;
    if (piece_s < law->start_s || piece_s >= end_s) return;
    bool late = t_s - law->start_s > end_s - t_s;
    double angle = w * (late ? end_s - t_s : t_s - law->start_s);
    value[0] = sin(angle);
    value[1] = (late ? -w : w) * cos(angle);
    value[2] = -w * w * value[0];
}

static void half_breaks(const fw_quantity_law *law, fw_quantity_law_breaks *b) {
    fw_quantity_law_break(b, law->start_s);
    fw_quantity_law_break(b, law->start_s + law->rise_s);
}

/* the pulse within [0, end_s]: its top, or the nearer end of what is seen of it */
static double half_largest(const fw_quantity_law *law, double end_s) {
    double first = fmax(0, -law->start_s), last = fmin(law->rise_s, end_s - law->start_s);
    if (!(first < last)) return 0;
    if (first <= law->rise_s / 2 && last >= law->rise_s / 2) return 1;
    return fmax(sin(FW_PI * first / law->rise_s), sin(FW_PI * last / law->rise_s));
}

static void half_size(const fw_quantity_law *law, double end_s, fw_quantity_law_size *size) {
    (void)end_s;
    size->slope = FW_PI / law->rise_s;
    size->variation = 2;
}

static double half_slope_variation(const fw_quantity_law *law, double a_s, double b_s) {
    double w = FW_PI / law->rise_s, piece_s = 0.5 * (a_s + b_s);
    if (piece_s < law->start_s || piece_s >= law->start_s + law->rise_s) return 0;
    return w * phase_variation(w * (a_s - law->start_s), w * (b_s - a_s));
}

static fw_quantity_law_wave half_wave(const fw_quantity_law *law) {
    return (fw_quantity_law_wave){.fastest_Hz = 0.5 / law->rise_s,
                                  .rad_per_s = FW_PI / law->rise_s,
                                  .from_s = law->start_s,
                                  .to_s = law->start_s + law->rise_s,
                                  .shortest_s = law->rise_s};
}

static const fw_quantity_law_attribute half_attributes[] = {
    FW_LAW_START, FW_LAW_RISE("how long the pulse lasts")};
const fw_quantity_law_kind fw_quantity_law_half_sine = {
    .name = "half-sine",
    .factor = "sin(pi (t - `start`) / `rise`) for the time `rise` from `start` on, else 0: a shock",
    .words = " over {rise}[ from {start} on]",
    FW_LAW_ROWS(half_attributes),
    .value = half_value,
    .breaks = half_breaks,
    .done = rise_done,
    .largest = half_largest,
    .size = half_size,
    .slope_variation = half_slope_variation,
    .wave = half_wave,
    .never_negative = fw_quantity_law_always};

/* ---- expression in time ----

   Its bounds are proved, by ranges over cells of the scene. Test: test_stride.c, test_time_law.c */

static void expression_value(const fw_quantity_law *law, double t_s, double piece_s,
                             double value[3]) {
    fw_quantity_program_value_in(law->program, t_s, piece_s, value);
}

enum { SAMPLES = 2000, SWITCHES_MOST = 1000 };

/* Switches of abs, min, max: the sides are compared at SAMPLES instants, and where two neighbours
   differ the switch is halved down to neighbouring numbers. Two switches between neighbours may
   hide each other; the integrator's own error control then meets the bend. */
static void expression_breaks(const fw_quantity_law *law, fw_quantity_law_breaks *b) {
    const fw_quantity_program *program = law->program;
    if (fw_quantity_program_smooth(program) || !isfinite(b->end_s)) return;
    double left = 0;
    uint64_t at_left = fw_quantity_program_branches(program, 0);
    for (int i = 1; i <= SAMPLES && b->count < SWITCHES_MOST; i++) {
        double right = b->end_s * i / SAMPLES;
        const uint64_t at_right = fw_quantity_program_branches(program, right);
        while (at_left != at_right && b->count < SWITCHES_MOST) {
            double low = left, high = right;
            for (double middle = low + (high - low) / 2; middle > low && middle < high;
                 middle = low + (high - low) / 2)
                if (fw_quantity_program_branches(program, middle) == at_left)
                    low = middle;
                else
                    high = middle;
            fw_quantity_law_break(b, high);
            left = high;
            at_left = fw_quantity_program_branches(program, high);
        }
        left = right;
        at_left = at_right;
    }
}

/* Over each of CELLS even cells value and slope by intervals, the value also from its middle by the slope:

     most = max |f|,  slope = max |f'|,  variation <= |f(0)| + sum of cells max |f'| dt

   Infinite where a cell has no bounds. Error: upwards, the variation's of first order in a cell's width. */
static void expression_size(const fw_quantity_law *law, double end_s, fw_quantity_law_size *size) {
    enum { CELLS = 128 };
    double at[3], most = 0;
    fw_quantity_program_value(law->program, 0, at);
    size->slope = 0, size->variation = fabs(at[0]);
    for (int i = 0; i < CELLS; i++) {
        const double low = end_s * i / CELLS, high = end_s * (i + 1) / CELLS;
        double f[2], d[2];
        fw_quantity_program_range(law->program, low, high, f, d);
        fw_quantity_program_value(law->program, 0.5 * (low + high), at);
        const double steep = fmax(fabs(d[0]), fabs(d[1])), half = 0.5 * (high - low) * steep;
        const double far = fmin(fmax(fabs(f[0]), fabs(f[1])), (1 + 1e-12) * (fabs(at[0]) + half));
        most = far <= most ? most : far; /* NaN too */
        size->slope = fmax(size->slope, steep);
        size->variation += 2 * half;
    }
    if (isfinite(most) && isfinite(size->variation)) {
        size->most = most;
        return;
    }
    size->most = size->slope = size->variation = (double)INFINITY;
}

static bool expression_is_ready(const fw_quantity_law *law) {
    return law->program != NULL;
}

/* time does not occur in it */
static bool expression_is_straight(const fw_quantity_law *law) {
    for (int i = 0; i < law->program->count; i++)
        if (law->program->step[i].op == FW_OP_TIME) return false;
    return true;
}

static const fw_quantity_law_attribute expression_attributes[] = {
    {"factor", FW_QUANTITY_LAW_EXPRESSION, .needed = true, .unit = "1",
     .sentence = "the factor at the time t"}};
const fw_quantity_law_kind fw_quantity_law_expression = {.name = "expression",
                                                         .factor =
                                                             "an expression in time, a pure number",
                                                         .words = " in time",
                                                         FW_LAW_ROWS(expression_attributes),
                                                         .value = expression_value,
                                                         .breaks = expression_breaks,
                                                         .size = expression_size,
                                                         .straight = expression_is_straight,
                                                         .is_ready = expression_is_ready};

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

double fw_quantity_law_number(const fw_quantity_law *law,
                              const fw_quantity_law_attribute *attribute) {
    double value;
    memcpy(&value, (const char *)law + attribute->offset, sizeof value);
    return value;
}

const char *fw_quantity_law_name(const fw_quantity_law *law) {
    return law->kind->name;
}
