/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "quantity/law.h"
#include "quantity/law_lines.h"
#include "quantity/program.h"
#include <math.h>

#define PI 3.14159265358979323846

const char *fw_law_kind_text(fw_law_kind kind) {
    static const char *const text[] = {[FW_LAW_STEP] = "step",
                                       [FW_LAW_RAMP] = "ramp",
                                       [FW_LAW_SINE] = "sine",
                                       [FW_LAW_TABLE] = "table",
                                       [FW_LAW_EXPRESSION] = "expression",
                                       [FW_LAW_HALF_SINE] = "half-sine",
                                       [FW_LAW_RANDOM] = "random"};
    return text[kind];
}

/* ---- value ---- */

static void constant(double value[3], double factor) {
    value[0] = factor;
    value[1] = value[2] = 0;
}

/* the piece of the table that holds `piece_s`: index of its right end, 0 in front of the first
   point, ntable behind the last */
static int table_piece(const fw_law *law, double piece_s) {
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

static void table_value(const fw_law *law, double t_s, double piece_s, double value[3]) {
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

/* sin(pi (t - start)/rise), at its end from there, so that it is 0 to the last bit */
static void half_sine_value(const fw_law *law, double t_s, double piece_s, double value[3]) {
    double w = PI / law->rise_s, end_s = law->start_s + law->rise_s;
    constant(value, 0);
    if (piece_s < law->start_s || piece_s >= end_s) return;
    bool late = t_s - law->start_s > end_s - t_s;
    double angle = w * (late ? end_s - t_s : t_s - law->start_s);
    value[0] = sin(angle);
    value[1] = (late ? -w : w) * cos(angle);
    value[2] = -w * w * value[0];
}

void fw_law_value(const fw_law *law, double t_s, double piece_s, double value[3]) {
    double w, angle;
    switch (law->kind) {
    case FW_LAW_STEP:
        constant(value, piece_s >= law->start_s && piece_s < law->end_s ? 1 : 0);
        return;
    case FW_LAW_RAMP:
        constant(value, piece_s < law->start_s ? 0 : 1);
        if (piece_s < law->start_s || piece_s >= law->start_s + law->rise_s) return;
        value[0] = (t_s - law->start_s) / law->rise_s;
        value[1] = 1 / law->rise_s;
        return;
    case FW_LAW_SINE:
        constant(value, 0);
        if (piece_s < law->start_s || piece_s >= law->end_s) return;
        w = 2 * PI * law->frequency_Hz;
        angle = w * (t_s - law->start_s) + law->phase_rad;
        value[0] = sin(angle);
        value[1] = w * cos(angle);
        value[2] = -w * w * value[0];
        return;
    case FW_LAW_TABLE:
        table_value(law, t_s, piece_s, value);
        return;
    case FW_LAW_HALF_SINE:
        half_sine_value(law, t_s, piece_s, value);
        return;
    case FW_LAW_RANDOM:
        fw_lines_value(law, t_s, value);
        return;
    case FW_LAW_EXPRESSION:
    default:
        fw_program_value_in(law->program, t_s, piece_s, value);
        return;
    }
}

/* ---- breaks ---- */

typedef struct breaks {
    double end_s, *t_s;
    int most, count;
} breaks;

static void add(breaks *b, double t_s) {
    if (!(t_s > 0 && t_s < b->end_s)) return;
    if (b->count < b->most) b->t_s[b->count] = t_s;
    b->count++;
}

enum { SAMPLES = 2000, SWITCHES_MOST = 1000 };

/* Switches of abs, min, max: the sides are compared at SAMPLES instants, and where two neighbours
   differ the switch is halved down to neighbouring numbers. Two switches between neighbours may
   hide each other; the integrator's own error control then meets the bend. */
static void find_switches(const fw_program *program, breaks *b) {
    double left = 0;
    uint64_t at_left = fw_program_branches(program, 0);
    for (int i = 1; i <= SAMPLES && b->count < SWITCHES_MOST; i++) {
        double right = b->end_s * i / SAMPLES;
        const uint64_t at_right = fw_program_branches(program, right);
        while (at_left != at_right && b->count < SWITCHES_MOST) {
            double low = left, high = right;
            for (double middle = low + (high - low) / 2; middle > low && middle < high;
                 middle = low + (high - low) / 2)
                if (fw_program_branches(program, middle) == at_left)
                    low = middle;
                else
                    high = middle;
            add(b, high);
            left = high;
            at_left = fw_program_branches(program, high);
        }
        left = right;
        at_left = at_right;
    }
}

int fw_law_breaks(const fw_law *law, double end_s, double *t_s, int most) {
    breaks b = {end_s, t_s, most, 0};
    if (!law) return 0;
    switch (law->kind) {
    case FW_LAW_STEP:
    case FW_LAW_SINE:
        add(&b, law->start_s);
        add(&b, law->end_s);
        break;
    case FW_LAW_RAMP:
    case FW_LAW_HALF_SINE:
        add(&b, law->start_s);
        add(&b, law->start_s + law->rise_s);
        break;
    case FW_LAW_TABLE:
        for (int i = 0; i < law->ntable; i++)
            add(&b, law->table_t_s[i]);
        break;
    case FW_LAW_RANDOM:
        break;
    case FW_LAW_EXPRESSION:
    default:
        if (!fw_program_smooth(law->program) && isfinite(end_s)) find_switches(law->program, &b);
        break;
    }
    return b.count;
}

/* ---- size ---- */

bool fw_law_is_constant(const fw_law *law) {
    return !law || (law->kind == FW_LAW_STEP && law->start_s <= 0 && isinf(law->end_s));
}

static double largest_sampled(const fw_law *law, double end_s) {
    double most = 0, value[3];
    for (int i = 0; i <= SAMPLES; i++) {
        double t_s = end_s * i / SAMPLES;
        fw_law_value(law, t_s, t_s, value);
        if (!isfinite(value[0])) return (double)INFINITY;
        most = fmax(most, fabs(value[0]));
    }
    return most;
}

/* the pulse within [0, end_s]: its top, or the nearer end of what is seen of it */
static double half_sine_largest(const fw_law *law, double end_s) {
    double first = fmax(0, -law->start_s), last = fmin(law->rise_s, end_s - law->start_s);
    if (!(first < last)) return 0;
    if (first <= law->rise_s / 2 && last >= law->rise_s / 2) return 1;
    return fmax(sin(PI * first / law->rise_s), sin(PI * last / law->rise_s));
}

/* exact for step, ramp, sine, half-sine and table */
double fw_law_largest(const fw_law *law, double end_s) {
    double value[3], most = 0, first, last;
    if (!law) return 1;
    switch (law->kind) {
    case FW_LAW_STEP:
        return law->start_s <= end_s && law->end_s > 0 && law->start_s < law->end_s ? 1 : 0;
    case FW_LAW_RAMP:
        fw_law_value(law, end_s, end_s, value);
        return fabs(value[0]);
    case FW_LAW_SINE:
        if (law->start_s > end_s || law->end_s <= 0) return 0;
        first = law->phase_rad + 2 * PI * law->frequency_Hz * fmax(0, -law->start_s);
        last =
            law->phase_rad + 2 * PI * law->frequency_Hz * (fmin(end_s, law->end_s) - law->start_s);
        /* a crest lies between: some pi/2 + n pi */
        if (floor(last / PI - 0.5) >= ceil(first / PI - 0.5)) return 1;
        return fmax(fabs(sin(first)), fabs(sin(last)));
    case FW_LAW_TABLE:
        fw_law_value(law, 0, 0, value);
        most = fabs(value[0]);
        fw_law_value(law, end_s, end_s, value);
        most = fmax(most, fabs(value[0]));
        for (int i = 0; i < law->ntable; i++)
            if (law->table_t_s[i] >= 0 && law->table_t_s[i] <= end_s)
                most = fmax(most, fabs(law->table_value[i]));
        return most;
    case FW_LAW_HALF_SINE:
        return half_sine_largest(law, end_s);
    case FW_LAW_RANDOM:
        return fw_lines_largest(law, end_s);
    case FW_LAW_EXPRESSION:
    default:
        return largest_sampled(law, end_s);
    }
}
