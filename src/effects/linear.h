/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The mechanism at its initial pose as a linear system: stiffness of what is elastic, rows of what
   holds. Private to the room.

   Scaled so that rows balance: x of a displacement is metres over length_m, of a rotation rad; a
   stiffness is over stiffness_N_per_m (and length_m where it turns). */
#ifndef FW_EFFECTS_LINEAR_H
#define FW_EFFECTS_LINEAR_H
#include "effects/effect.h"

typedef struct fw_effects_linear {
    int n, rows;    /* 3 nbody; constraint rows: pins that are not released, joints, drivers */
    int total;      /* n + rows */
    double *a;      /* (total x total) [K G^T; G 0], scaled; symmetric unless elements are not */
    int *pin_row;   /* (npin) first of the two rows of a pin, counted from 0; FW_NONE: released */
    int *joint_row; /* (njoint) first row of a joint; of a slide the force across */
    double length_m, stiffness_N_per_m;
} fw_effects_linear;

/* unknowns of the whole; beyond FW_RESPONSE_MOST nobody should go on */
int fw_effects_linear_size(const fw_mechanism *mechanism, const fw_effects_loads *loads);
/* *elastic false: nothing has stiffness, and there is no system */
fw_status fw_effects_linear_new(fw_arena *arena, const fw_mechanism *mechanism,
                                const fw_effects_loads *loads, fw_effects_linear *system,
                                bool *elastic);
/* SI per scaled: of a coordinate, and of its force. Multipliers of rows that hold points have
   stiffness_N_per_m * length_m */
double fw_effects_linear_unit(const fw_effects_linear *system, int coordinate);
double fw_effects_linear_force_unit(const fw_effects_linear *system, int coordinate);
/* force (n, scaled) += G^T lambda (rows, scaled) at the pose of `mechanism`, which is the one that
   `system` was made for, moved */
void fw_effects_linear_hold(const fw_effects_linear *system, const fw_mechanism *mechanism,
                            const double *lambda, double *force);
/* gap (rows, scaled) of every joint at the pose of `mechanism`, as the rows count it; angles and
   rods only up to a constant */
void fw_effects_linear_gaps(const fw_effects_linear *system, const fw_mechanism *mechanism,
                            double *gap);
/* x (total) with scaled force (n) as the right-hand side; *valid false: singular */
fw_status fw_effects_linear_solve(fw_arena *arena, const fw_effects_linear *system,
                                  const double *force, double *x, bool *valid);

/* tangents of the elements at the pose of `mechanism`, at rest, at t = 0: whole_stiffness and
   whole_damping (n x n, SI; NULL: not wanted) += */
fw_status fw_effects_loads_element_tangent(fw_arena *arena, const fw_mechanism *mechanism,
                                           const fw_effects_loads *loads, double *whole_stiffness,
                                           double *whole_damping);
/* of one element at a time; *valid false: its formula does not hold there */
fw_status fw_effects_loads_element_tangent_at(fw_arena *arena, const fw_mechanism *mechanism,
                                              const fw_effects_force_element *element, double t_s,
                                              double piece_s, double *whole_stiffness,
                                              double *whole_damping, bool *valid);
/* generalised forces (n, SI) += of one element at rest at time t_s of the piece around piece_s */
void fw_effects_loads_element_force(const fw_mechanism *mechanism,
                                    const fw_effects_force_element *element, double t_s,
                                    double piece_s, double *force);

/* generalised forces (n, SI) += what dampers of one element do more when its points on the ground
   move at strain (p - centre) per second */
void fw_effects_loads_element_drag(const fw_mechanism *mechanism,
                                   const fw_effects_force_element *element, double strain,
                                   fw_geometry_vec2 centre, double *force);
/* when it pushes most: with its laws, in (0, end_s); 0 without */
double fw_effects_loads_element_busiest(const fw_mechanism *mechanism,
                                        const fw_effects_force_element *element, double end_s);
/* false: more ports or switches than these helpers take; they then leave it out */
bool fw_effects_loads_element_fits(const fw_effects_force_element *element);

#endif
