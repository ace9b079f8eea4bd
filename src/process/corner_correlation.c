/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Corners of quantities that a laboratory found together. */
#include "process/pack.h"
#include <math.h>
#include <string.h>

/* one effect of all inputs, per unit and at their centres */
typedef struct effect {
    double *each, *at;
    double centre;
} effect;

static void effects_of(fw_verdict_fabrication_input *in, effect e[4]) {
    e[0] = (effect){&in->edge_m, &in->edge_at_m, in->even};
    e[1] = (effect){&in->flare_m, &in->flare_at_m, in->drawn};
    e[2] = (effect){&in->thickness, &in->thickness_at, in->drawn};
    e[3] = (effect){&in->youngs, &in->youngs_at, in->drawn};
}

/* Cholesky's factor of the correlations; a pivot is held above 1e-6, so that inputs that are fully correlated keep a range
   of a thousandth of their own. false: all are independent */
static bool factor(const fw_verdict_fabrication_input *in, int n,
                   double L[FW_FABRICATION_INPUTS][FW_FABRICATION_INPUTS]) {
    bool any = false;
    for (int i = 0; i < n; i++)
        for (int k = 0; k <= i; k++) {
            double sum = i == k ? 1.0 : fw_quantity_correlation(&in[i].q, &in[k].q);
            any = any || (i != k && sum != 0.0);
            for (int j = 0; j < k; j++)
                sum -= L[i][j] * L[k][j];
            L[i][k] = i == k ? sqrt(fmax(sum, 1e-6)) : sum / L[k][k];
        }
    return any;
}

/* what goes with input i: of input k > i the part s_k L_ki/(s_i L_ii) for every unit of it */
static void take_along(fw_verdict_fabrication_input *in, int n, int i,
                       double L[FW_FABRICATION_INPUTS][FW_FABRICATION_INPUTS]) {
    effect own[4], other[4];
    effects_of(&in[i], own);
    for (int k = i + 1; k < n; k++) {
        if (L[k][i] == 0.0) continue;
        double part = in[k].sigma * L[k][i] / (in[i].sigma * L[i][i]);
        effects_of(&in[k], other);
        for (int e = 0; e < 4; e++) {
            double more = *other[e].each * part;
            *own[e].each += more;
            *own[e].at -= more * (in[i].nominal - own[e].centre);
        }
    }
}

static fw_status name_parts(fw_arena *arena, fw_verdict_fabrication_input *in, int n, int i,
                            double L[FW_FABRICATION_INPUTS][FW_FABRICATION_INPUTS]) {
    static const double named = 0.05; /* less decides nothing that a person reads */
    for (int k = i + 1; k < n; k++)
        if (fabs(L[k][i]) > named)
            FW_NEED(in[i].name =
                        fw_arena_printf(arena, "%s (taking %s along)", in[i].name, in[k].q.id));
    for (int k = 0; k < i; k++)
        if (fabs(L[i][k]) > named)
            FW_NEED(in[i].name =
                        fw_arena_printf(arena, "%s (apart from %s)", in[i].name, in[k].q.id));
    return FW_OK;
}

/* x_k = n_k + s_k sum_i<=k L_ki z_i, z independent, R = L L': the state sum_k e_k (x_k - c_k) is written in
   y_i = n_i + s_i L_ii z_i, whose effect is e_i + sum_k>i e_k s_k L_ki/(s_i L_ii). y has the range of x about n, times
   L_ii; the first of two correlated inputs keeps its own, and the other what the first one does not say. The nominal
   device is the same. Without correlations nothing changes.
   Source: Golub and Van Loan, 4.2. Test: test_correlation.c, corners (against draws of the correlated inputs). */
fw_status fw_process_corners_independent(fw_arena *arena, fw_verdict_fabrication_input *in, int n) {
    double L[FW_FABRICATION_INPUTS][FW_FABRICATION_INPUTS] = {{0}};
    for (int i = 0; i < n; i++)
        if (!(in[i].sigma > 0.0)) return FW_OK;
    if (!factor(in, n, L)) return FW_OK;
    for (int i = 0; i < n; i++) {
        FW_TRY(name_parts(arena, in, n, i, L));
        take_along(in, n, i, L); /* of later inputs as they are: their own turn comes */
    }
    for (int i = 0; i < n; i++) {
        in[i].low = in[i].nominal - (in[i].nominal - in[i].low) * L[i][i];
        in[i].high = in[i].nominal + (in[i].high - in[i].nominal) * L[i][i];
        in[i].sigma *= L[i][i];
    }
    return FW_OK;
}
