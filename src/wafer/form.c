/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The usable area of a wafer.

   Circle of radius R - e about the centre, cut by the primary flat moved inward by e, that is at
   sqrt(R^2 - (L/2)^2) - e from the centre; with a notch instead, without a disc of radius e + 1.25
   mm about the rim at the notch, which holds the notch (depth 1.00 to 1.25 mm, 90 deg) and all that
   is nearer to it than e. In: diameter, chord L, exclusion e, m, on the 1 nm grid. Out: a decision
   per rectangle, exact in 64 bit integers (coordinates below 2^30, squares below 2^61). Secondary
   flats are not looked at: they cut less than 1 mm off the rim, which an exclusion of 3 mm covers.
   Source of sizes: SEMI M1, specifications for polished single crystal silicon wafers (flat 15.88,
   22.22, 32.5, 42.5, 57.5 mm at 50.8, 76.2, 100, 125, 150 mm; notch at 200 and 300 mm).
   Cost: constant. Test: test_wafer_grid.c. */
#include "wafer/wafer.h"
#include <math.h>

static const struct {
    double diameter_m, flat_m;
} semi[] = {{50.8e-3, 15.88e-3}, {76.2e-3, 22.22e-3}, {100e-3, 32.5e-3}, {125e-3, 42.5e-3},
            {150e-3, 57.5e-3},   {200e-3, 0},         {300e-3, 0}};
/* 4 in for a wafer of 100 mm is 1.6 % off */
static const double NEAR = 0.02, NOTCH_M = 1.25e-3;
static const double plate_in[] = {3, 4, 5, 6, 7, 9, 14};
static const double INCH_M = 25.4e-3, PLATE_RIM_M = 10e-3;

static int64_t dbu(double m) {
    return (int64_t)floor(m * 1e9 + 0.5);
}

static fw_status refuse(const fw_device_wafer_asked *asked, fw_diags *diags, const char *what,
                        double m, const char *advice) {
    char number[32];
    return fw_diag_error(diags, 190, asked->place, "<wafer>: %s is %s mm; %s", what,
                         fw_number_text(number, sizeof number, m * 1e3, 6), advice);
}

/* smallest usual plate that leaves room for title and fiducials */
static double plate_for(double diameter_m) {
    for (size_t i = 0; i < sizeof plate_in / sizeof plate_in[0]; i++)
        if (plate_in[i] * INCH_M >= diameter_m + 2 * PLATE_RIM_M) return plate_in[i] * INCH_M;
    return diameter_m + 2 * PLATE_RIM_M;
}

fw_status fw_wafer_form_of(const fw_device_wafer_asked *asked, fw_diags *diags,
                           fw_wafer_form *form) {
    int known = -1;
    for (size_t i = 0; i < sizeof semi / sizeof semi[0]; i++)
        if (fabs(asked->diameter_m - semi[i].diameter_m) <= NEAR * semi[i].diameter_m)
            known = (int)i;
    double d = known >= 0 ? semi[known].diameter_m : asked->diameter_m;
    double flat = !isnan(asked->flat_m) ? asked->flat_m
                  : known >= 0          ? semi[known].flat_m
                                        : (double)NAN;
    if (isnan(flat))
        return refuse(asked, diags, "diameter", d,
                      "SEMI M1 has no such wafer, so state flat (0: none) as well");
    bool notched = isnan(asked->flat_m) && semi[known].flat_m == 0;
    double plate = isnan(asked->plate_m) ? plate_for(d) : asked->plate_m;
    if (!(flat < d))
        return refuse(asked, diags, "flat", flat, "no chord is as long as the diameter");
    if (!(plate >= d + PLATE_RIM_M))
        return refuse(asked, diags, "plate", plate,
                      "it must be 10 mm larger than the wafer, which lies in its middle");
    double chord = sqrt(0.25 * d * d - 0.25 * flat * flat), usable = 0.5 * d - asked->edge_m;
    if (!(usable > 0) || !(chord - asked->edge_m > 0))
        return refuse(asked, diags, "edge-exclusion", asked->edge_m,
                      "nothing is left of the wafer");
    *form = (fw_wafer_form){.diameter_m = d,
                            .flat_m = flat,
                            .notch_m = notched ? NOTCH_M : 0,
                            .edge_m = asked->edge_m,
                            .side = asked->side,
                            .usable_dbu = dbu(usable),
                            .flat_dbu = dbu(flat > 0 ? chord - asked->edge_m : usable),
                            .notch_dbu = notched ? dbu(0.5 * d) : 0,
                            .avoid_dbu = notched ? dbu(NOTCH_M + asked->edge_m) : 0,
                            .plate_m = plate};
    return FW_OK;
}

static int64_t larger(int64_t a, int64_t b) {
    return a > b ? a : b;
}

static int64_t distance(int64_t from, int64_t low, int64_t high) {
    return from < low ? low - from : from > high ? from - high : 0;
}

bool fw_wafer_holds(const fw_wafer_form *f, int64_t x0, int64_t y0, int64_t x1, int64_t y1) {
    int64_t far_x = larger(-x0, x1), far_y = larger(-y0, y1);
    if (far_x < 0 || far_y < 0 || far_x > f->usable_dbu || far_y > f->usable_dbu) return false;
    if (far_x * far_x + far_y * far_y > f->usable_dbu * f->usable_dbu) return false;
    int64_t toward = f->side == FW_SIDE_BOTTOM ? -y0
                     : f->side == FW_SIDE_TOP  ? y1
                     : f->side == FW_SIDE_LEFT ? -x0
                                               : x1;
    if (toward > f->flat_dbu) return false;
    if (f->notch_dbu == 0) return true;
    int64_t sign = f->side == FW_SIDE_BOTTOM || f->side == FW_SIDE_LEFT ? -1 : 1;
    bool upright = f->side == FW_SIDE_BOTTOM || f->side == FW_SIDE_TOP;
    int64_t dx = distance(upright ? 0 : sign * f->notch_dbu, x0, x1);
    int64_t dy = distance(upright ? sign * f->notch_dbu : 0, y0, y1);
    return dx * dx + dy * dy >= f->avoid_dbu * f->avoid_dbu;
}
