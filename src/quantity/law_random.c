/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The random law: n lines of equal size at frequencies spread evenly from f_0 to f_most, with
   random phases,

     factor(t) = sqrt(2/n) sum_k cos(2 pi (f_k t + u_k)),   f_k = f_0 + (f_most - f_0) k/(n - 1),

   t in s, f in Hz, factor pure; one line stands at f_0. u_k in [0, 1) comes from the seed by
   SplitMix64, in whole numbers only, so that the phases are the same on every machine.
   Its mean square over a long time is 1. It repeats its envelope after 1/(f_1 - f_0): a scene that
   lasts longer than that needs more lines, or it hears the same noise again.
   For n of some ten and more its values are distributed nearly as Gauss's; none exceeds sqrt(2 n).
   Cost n cosines and sines.
   Source: Shinozuka and Deodatis, Simulation of stochastic processes by spectral representation,
   Appl. Mech. Rev. 44 (1991) 191; Steele, Lea, Flood, Fast splittable pseudorandom number
   generators, OOPSLA 2014 (SplitMix64). Test: test_law_lines.c */
#include "quantity/law_kind.h"
#include "base/constants.h"
#include <math.h>

static uint64_t mixed(uint64_t z) {
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* in turns, 0 <= u < 1, exactly representable. The seed is mixed first: SplitMix64 counts on from
   it, and neighbouring seeds would share all but one of their phases. */
static double phase_turns(double seed, int k) {
    uint64_t state =
        mixed((unsigned)seed + 0x9e3779b97f4a7c15u) + (uint64_t)(k + 1) * 0x9e3779b97f4a7c15u;
    return (double)(mixed(state) >> 11) * 0x1p-53;
}

static double frequency_Hz(const fw_quantity_law *law, int k) {
    if (law->lines < 2) return law->frequency_Hz;
    return law->frequency_Hz + (law->frequency_most_Hz - law->frequency_Hz) * k / (law->lines - 1);
}

static double line_size(const fw_quantity_law *law) {
    return sqrt(2.0 / law->lines);
}

/* whole turns are taken off before pi comes in, so that late times lose nothing more than f t does
 */
static double turned(double frequency, double t_s, double turns) {
    double all = frequency * t_s + turns;
    return 2 * FW_PI * (all - floor(all));
}

static void value_of(const fw_quantity_law *law, double t_s, double piece_s, double value[3]) {
    (void)piece_s;
    value[0] = value[1] = value[2] = 0;
    for (int k = 0; k < law->lines; k++) {
        double f = frequency_Hz(law, k), w = 2 * FW_PI * f;
        double angle = turned(f, t_s, phase_turns(law->seed, k)), c = cos(angle), s = sin(angle);
        value[0] += c;
        value[1] -= w * s;
        value[2] -= w * w * c;
    }
    double size = line_size(law);
    for (int i = 0; i < 3; i++)
        value[i] *= size;
}

/* ---- upper bounds on |factor| ----

   Between samples h apart a function with |f''| <= M strays from the chord by at most M h^2/8, in
   the plane of complex numbers too. */

enum { LOOKS_MOST = 400000 }; /* lines times samples: some milliseconds */

/* in the plane of complex numbers: |sum of lines at f_k - centre| (the envelope), or its real part
   with centre 0 (the law itself) */
static double sampled(const fw_quantity_law *law, double centre_Hz, bool envelope, double end_s,
                      int samples) {
    double most = 0, bend = 0, h_s = end_s / samples;
    for (int k = 0; k < law->lines; k++) {
        double w = 2 * FW_PI * (frequency_Hz(law, k) - centre_Hz);
        bend += w * w;
    }
    for (int i = 0; i <= samples; i++) {
        double re = 0, im = 0;
        for (int k = 0; k < law->lines; k++) {
            double angle = turned(frequency_Hz(law, k) - centre_Hz, end_s * i / samples,
                                  phase_turns(law->seed, k));
            re += cos(angle);
            if (envelope) im += sin(angle);
        }
        most = fmax(most, hypot(re, im));
    }
    return line_size(law) * (most + bend * h_s * h_s / 8);
}

/* Upper bound on |factor| in [0, end_s]: of the law itself where the scene is short enough to look
   at it 63 times per period of the highest line (0.13 % of sqrt(2 n) added), else of its envelope,
   which repeats itself (16 samples per line, 0.16 % added), else what all lines together can be. */
static double largest_of(const fw_quantity_law *law, double end_s) {
    double all = line_size(law) * law->lines, top = frequency_Hz(law, (int)law->lines - 1);
    double looks = ceil(63 * top * end_s) + 8, within = LOOKS_MOST / law->lines;
    if (!(end_s > 0)) end_s = 0;
    if (looks <= within) return fmin(all, sampled(law, 0, false, end_s, (int)looks));
    double repeats_s = (law->lines - 1) / (top - law->frequency_Hz);
    int samples = 16 * (int)law->lines;
    if (law->lines < 2 || samples > within) return all;
    double centre = law->frequency_Hz + (top - law->frequency_Hz) / 2;
    return fmin(all, sampled(law, centre, true, fmin(end_s, repeats_s), samples));
}

static double fastest_Hz(const fw_quantity_law *law) {
    return fmax(law->frequency_Hz, law->frequency_most_Hz);
}

/* sqrt(2/n) times the sum of n cosines; how far it goes to and fro has no bound */
static void size_of(const fw_quantity_law *law, double end_s, fw_quantity_law_size *size) {
    (void)end_s;
    size->slope = sqrt(2.0 * law->lines) * 2 * FW_PI * fastest_Hz(law);
    size->variation = (double)INFINITY;
}

static fw_quantity_law_wave wave_of(const fw_quantity_law *law) {
    return (fw_quantity_law_wave){.fastest_Hz = fastest_Hz(law),
                                  .repeats = true,
                                  .to_s = (double)INFINITY,
                                  .shortest_s = 1 / fastest_Hz(law),
                                  .attribute = "frequency-most"};
}

static bool is_wrong(const fw_quantity_law *law, fw_quantity_law_mistake *mistake) {
    *mistake =
        (fw_quantity_law_mistake){95, "frequency-most", "is not above", "frequency",
                                  "exchange them, or make them differ: the lines lie between"};
    return law->lines > 1 && !(law->frequency_Hz < law->frequency_most_Hz);
}

static const fw_quantity_law_attribute attributes[] = {
    {"frequency", FW_LAW_MEMBER(frequency_Hz), .needed = true, FW_LAW_FREQUENCY,
     .sentence = "the lowest of its lines"},
    {"frequency-most", FW_LAW_MEMBER(frequency_most_Hz), .needed = true, FW_LAW_FREQUENCY,
     .sentence = "the highest of its lines"},
    {"lines", FW_LAW_MEMBER(lines), FW_LAW_PURE, .whole = true,
     FW_LAW_RANGE(1, 128, "there is at least one; more cost time and sound no different"),
     .absent = 32, .absent_text = "32",
     .sentence = "how many frequencies, evenly spread. The noise begins to repeat itself after "
                 "(lines - 1)/(frequency-most - frequency)"},
    {"seed", FW_LAW_MEMBER(seed), FW_LAW_PURE, .whole = true,
     FW_LAW_RANGE(0, 4294967295.0, "it has 32 bits"), .absent = 1, .absent_text = "1",
     .sentence = "another number is other noise"}};
const fw_quantity_law_kind fw_quantity_law_random = {
    .name = "random",
    .factor = "noise from the start on, of root mean square 1: the sum of `lines` cosines of equal "
              "size at "
              "frequencies from `frequency` to `frequency-most`, with phases from `seed`; its "
              "peaks are some 3 to 4 "
              "times as high",
    .words = " of {lines} lines from {frequency} to {frequency-most} (seed {seed})",
    FW_LAW_ROWS(attributes),
    .value = value_of,
    .largest = largest_of,
    .size = size_of,
    .wave = wave_of,
    .is_wrong = is_wrong};
