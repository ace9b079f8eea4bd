/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laws that are one sine: the sine itself, and its half, a shock. Their largest values are exact.
   Between two extremes a sine goes 2, and in n half periods there are at most n + 1 of them. Test:
   test_time_law.c, test_base_motion.c */
#include "quantity/law_kind.h"
#include "base/constants.h"
#include <math.h>

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
    .largest = half_largest,
    .size = half_size,
    .slope_variation = half_slope_variation,
    .wave = half_wave,
    .never_negative = fw_quantity_law_always};
