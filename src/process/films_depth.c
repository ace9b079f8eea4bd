/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is asked of films besides where they are: depths of openings, what is new. */
#include "process/films.h"
#include <math.h>
#include <string.h>

/* z + lag(w, z) = E by bisection: the left side rises with z. In: the cut with its E, the opening w
   m. Out: m, error 1e-15 of the depth. Test: test_films.c, depth: z = D and E where they should. */
double fw_process_cut_depth(const fw_process_cut *cut, double w_m) {
    double E = cut->etched_m;
    if (isnan(E)) return cut->depth_m;
    double lag = fw_process_cut_lag(cut, w_m, cut->depth_m);
    if (isnan(lag)) return fmin(E, cut->depth_m);
    if (cut->depth_m + lag <= E) return cut->depth_m;
    double low = 0.0, high = cut->depth_m;
    for (int i = 0; i < 50; i++) {
        double z = 0.5 * (low + high);
        if (z + fw_process_cut_lag(cut, w_m, z) <= E)
            low = z;
        else
            high = z;
    }
    return low;
}

bool fw_process_films_is_new(const fw_process_films *now, const fw_process_films *before, int i) {
    for (int k = 0; k < before->nnote; k++)
        if (strcmp(before->note[k], now->note[i]) == 0) return false;
    return true;
}

bool fw_process_step_changes(const fw_process_step *step) {
    return step->nchange > 0 || step->nexposed > 0;
}
