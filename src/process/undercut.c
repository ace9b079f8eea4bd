/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "process/undercut.h"
#include <math.h>

/* u(z) = (1 - A)(E - z), E = R T the depth the floor would have reached in the whole time: the wall
   at depth z is exposed from z/R on. w m, A 1, depth and E m. w_top = w - 2u(0), w_bottom = w -
   2u(depth); negative where the beam is gone. Constant lateral rate (1 - A) R.
   Source: docs/theory/etching.md. Test: test_undercut.c, table. */
void fw_process_undercut_widths(double width_m, double anisotropy, double depth_m, double etched_m,
                                double *top_m, double *bottom_m) {
    double loss = 2.0 * (1.0 - anisotropy);
    *top_m = width_m - loss * etched_m;
    *bottom_m = width_m - loss * fmax(0.0, etched_m - depth_m);
}

/* k/k0 = (wb^4 - wt^4)/(4 (wb - wt) w0^3): I = h (wb^4 - wt^4)/(48 (wb - wt)) integrated over the
   depth; where the wall is gone (negative width) nothing is added, while the slope stays that of
   the whole wall. Equal widths: (w/w0)^3. Test: test_undercut.c, table. */
double fw_process_undercut_stiffness(double top_m, double bottom_m, double w0_m) {
    double t = fmax(top_m, 0.0) / w0_m, b = fmax(bottom_m, 0.0) / w0_m;
    double share = 1.0; /* of the depth that is left, where an edge is gone */
    if ((top_m < 0.0) != (bottom_m < 0.0)) share = fabs(b - t) * w0_m / fabs(bottom_m - top_m);
    return share * (b * b + t * t) * (b + t) / 4.0;
}

double fw_process_undercut_cut(double width_m, double etched_m) {
    return 1.0 - width_m / (2.0 * etched_m);
}

static double ratio(double A, double width_m, double depth_m, double etched_m, int straight) {
    double top, bottom;
    fw_process_undercut_widths(width_m, A, depth_m, etched_m, &top, &bottom);
    return fw_process_undercut_stiffness(top, straight ? top : bottom, width_m);
}

/* Bisection on k/k0(A) = 1 - tolerance; the ratio rises with A and is 1 at A = 1. Error 1e-15.
   Test: test_undercut.c, needed. */
double fw_process_undercut_needed(double width_m, double depth_m, double etched_m, double tolerance,
                                  int straight) {
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 60; i++) {
        double A = 0.5 * (low + high);
        if (ratio(A, width_m, depth_m, etched_m, straight) >= 1.0 - tolerance)
            high = A;
        else
            low = A;
    }
    return high;
}

/* b = 1.5 sqrt(lambda (g + h/2)). lambda, gap g, resist h m; b m. Fresnel shadow of a mask edge in
   the middle of the resist. Source: textbook, e.g. Madou, Fundamentals of Microfabrication.
   Test: test_undercut.c, print_limit. */
double fw_process_print_limit(double wavelength_m, double gap_m, double resist_m) {
    return 1.5 * sqrt(wavelength_m * (gap_m + resist_m / 2.0));
}
