/* SPDX-License-Identifier: GPL-3.0-or-later */
/* judge modes MODEL           angular frequencies at rest, 1/s
 * judge at MODEL SHARE        stresses under so much of the loads
 * judge aim MODEL STRESS MOST the least share, up to MOST, under which the largest stress, MPa, is
 *                             reached, and the stresses there
 * A model with `motion` is integrated, any other follows its equilibria. Exit 1: not a model; 2:
 * nothing found. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "motion.h"

static void print(struct model *model, double share, const struct answer *answer,
                  const struct state *state) {
    double stiffness[9 * BODIES * BODIES], omega[3 * BODIES] = {0}, force[3 * (BODIES + 1)] = {0};
    printf("{\"share\": %.15g, \"most\": %.12g, ", share, answer->most);
    if (!(model->duration > 0) && !statics_stiffness_at(model, share, state, stiffness)) {
        motion_frequencies_of(model, stiffness, omega);
        printf("\"omega\": %.12g, ", omega[0]); /* the lowest there */
    }
    printf("\"flexures\": [");
    for (int i = 0; i < model->flexures; i++)
        printf("%s{\"stress\": %.12g, \"roots\": %.12g, \"at\": %d}", i ? ", " : "",
               answer->stress[i], answer->roots[i], answer->at[i]);
    printf("], \"bodies\": [");
    for (int k = 1; k <= model->bodies; k++)
        printf("%s[%.12g, %.12g, %.12g]", k > 1 ? ", " : "", state->q[3 * k], state->q[3 * k + 1],
               state->q[3 * k + 2]);
    printf("], \"wrenches\": [");
    for (int i = 0; i < model->flexures; i++)
        printf("%s[%.12g, %.12g, %.12g]", i ? ", " : "", state->p[3 * i], state->p[3 * i + 1],
               state->p[3 * i + 2]);
    printf("], \"loads\": ["); /* on the bodies, about their centres */
    model_loads(model, state->q, share, 0, force);
    for (int k = 1; k <= model->bodies; k++)
        printf("%s[%.12g, %.12g, %.12g]", k > 1 ? ", " : "", force[3 * k], force[3 * k + 1],
               force[3 * k + 2]);
    printf("]}\n");
}

/* A share at which a motion reaches the stress within 2 %: secants between what is below and above.
 * The answer is that of finer steps at that share. */
static int aim_motion(struct model *model, double stress, double *share, struct answer *out) {
    double low = 0, high = 0, f_low = -1, f_high = 0, at = 1e-4;
    for (int i = 0; i < 40; i++) {
        if (motion_follow(model, at, 12, stress, out)) {
            high = at;
            f_high = 1;
        } else {
            double f = out->most / stress - 1;
            if (fabs(f) < 0.02) {
                *share = at;
                return motion_follow(model, at, 24, 0, out);
            }
            if (f < 0)
                low = at, f_low = f;
            else
                high = at, f_high = fmin(f, 1);
        }
        if (high <= 0)
            at *= fmax(1.05, (f_low < -0.9 ? 0.9 : 1) / (1 + f_low));
        else
            at = low + (high - low) * fmin(0.9, fmax(0.1, -f_low / (f_high - f_low)));
        if (high > 0 && high - low < 1e-3 * high) return 1; /* it jumps there */
    }
    return 1;
}

int main(int argc, char **argv) {
    struct model *model = calloc(1, sizeof *model);
    struct state state = {0};
    struct answer answer = {0};
    double value = argc > 3 ? strtod(argv[3], NULL) : 0, share = value;
    int bad = 1;
    if (!model || argc < 3 || model_read(argv[2], model)) return 1;
    if (!strcmp(argv[1], "modes")) {
        double omega[3 * BODIES];
        motion_frequencies(model, omega);
        for (int i = 0; i < 3 * model->bodies; i++)
            printf("%.12g\n", omega[i]);
        return 0;
    }
    if (!strcmp(argv[1], "at")) {
        bad = model->duration > 0 ? motion_follow(model, value, 24, 0, &answer)
                                  : statics_follow(model, value, 0, &state, &share, &answer);
    } else if (!strcmp(argv[1], "aim")) {
        bad = model->duration > 0 ? aim_motion(model, value, &share, &answer)
                                  : statics_follow(model, argc > 4 ? strtod(argv[4], NULL) : 1,
                                                   value, &state, &share, &answer);
    }
    if (bad) return 2;
    print(model, share, &answer, &state);
    return 0;
}
