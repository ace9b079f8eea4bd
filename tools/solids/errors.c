/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The rows of the table in docs/theory/flexure-errors.md: solid over closed form less 1 in per
   cent, in brackets what the closed form says of its own error; W in um. Last columns: the bound,
   and (5). */
#include "../../tests/unit/flexure/error_solids.h"
#include <math.h>
#include <stdio.h>

static void cell(double solid, double form, double error, int digits) {
    printf(" %+.2f (%.*f) |", 100 * (solid / form - 1), digits, 100 * error);
}

int main(void) {
    for (int i = 0; i < SOLIDS; i++) {
        const error_solid *s = &SOLID[i];
        const fw_flexure_result o = error_solid_form(s);
        if (s->angle > 0)
            printf("| %g, %g |", s->radius, s->angle);
        else
            printf("| leaf, L %g |", s->radius);
        printf(" %g | %g | %.2g | %g |", s->width, s->fillet / s->width, s->depth / s->width,
               s->poisson);
        cell(s->K, o.stiffness_Nm_per_rad * 1e12, o.error.stiffness, 2);
        cell(s->kx, o.kx_N_per_m, o.error.kx, 2);
        cell(s->ky, o.ky_N_per_m, o.error.ky, 2);
        if (s->angle > 0)
            printf(" %+.3f", fabs(s->W - 1e6 * o.centre_m) < 5e-4 ? 0 : s->W - 1e6 * o.centre_m);
        else
            printf(" 0");
        printf(" (%.2f) |", 1e6 * o.error.centre_m);
        cell(s->strain, o.strain_per_rad, o.error.strain, 1);
        printf(" %+.2f |\n", 100 * (s->strain / o.strain_fit_per_rad - 1));
    }
    return 0;
}
