/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a comb drive's element holds, for those who look for pull-in. Physics: comb_drive.c. */
#ifndef FW_EFFECTS_COMB_H
#define FW_EFFECTS_COMB_H
#include "effects/effects.h"

typedef struct fw_effects_comb_element {
    fw_device_electrodes kind;
    double gap_m, overlap_m, length_m, depth_m; /* overlap of combs; length of fingers or plate */
    double face_Fm;                             /* eps0 depth fingers: C is this times an integral
                                                   of ds over the gap */
    double direction_rad, turn_rad;             /* in the stator's frame; phi_b - phi_a as drawn */
    double voltage_V;
} fw_effects_comb_element;

/* NULL: some other class */
const fw_effects_comb_element *fw_effects_comb_of(const fw_effects_force_element *e);
/* x along the direction, y across it (m), tilt (rad) of the rotor against the stator; p as in
   fw_effects_port_state */
void fw_effects_comb_place(const fw_effects_force_element *e, const double *p, double place[3]);
/* place' for port velocities w (or the place's change under a small motion) */
void fw_effects_comb_rate(const fw_effects_force_element *e, const double *p, const double *w,
                          double rate[3]);
/* C in F at a place; slope (3) and bend (3 x 3) are its first and second derivatives, may be NULL.
   NaN where the electrodes touch. */
double fw_effects_comb_capacitance(const fw_effects_comb_element *c, const double place[3],
                                   double *slope, double *bend);
/* how much of C the fringe fields would add at most, relative (Palmer's edge formula) */
double fw_effects_comb_fringe(const fw_effects_comb_element *c);

#endif
