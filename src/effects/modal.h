/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linear modes of the constrained mechanism about its initial pose, and what loads them. Private
   to the room; the steps of envelope.c. SI. */
#ifndef FW_EFFECTS_MODAL_H
#define FW_EFFECTS_MODAL_H
#include "effects/linear.h"
#include "maths/dense.h"

typedef struct fw_effects_modal {
    const fw_mechanism *mechanism;
    const fw_device_scene *scene;
    const fw_effects_loads *loads;
    fw_effects_linear linear;
    int n, modes;
    double *omega;       /* (modes) rad/s, ascending */
    double *shape;       /* (modes x n) shape^T M shape = 1 */
    double *turn;        /* (modes x npin) */
    double *damping;     /* (modes x modes) shape^T C shape, 1/s */
    double *open, *pull; /* (modes x npin x 2) of released pins: W of b from W of a, m, and the
                            force on b, N, per unit of the mode */
    double *velocity;    /* (modes) at the start */
    double *inertia;     /* (n) masses in the scaled coordinates of `linear` */
    fw_maths_singular holding; /* of G M^-1/2 */
    /* what free strains move the mechanism by, as it is assembled with them: constant, and where
       the law of loads->stretch is 1. NULL: there are none */
    double *shift[2];       /* (n) */
    double *shift_turn[2];  /* (npin) */
    double *shift_force[2]; /* (n) what springs answer, and loads do otherwise */
    double *shift_drag[2];  /* (modes) what dampers do against it, per rate of the law */
    const char *why_not;    /* NULL: all of this is there */
} fw_effects_modal;

fw_status fw_effects_modal_find(fw_arena *arena, const fw_mechanism *mechanism,
                                const fw_device_scene *scene, const fw_effects_loads *loads,
                                fw_effects_modal *modal);
/* shape^T C shape (modes x modes, 1/s) of the dampers in other loads */
fw_status fw_effects_modal_damping(fw_arena *arena, const fw_effects_modal *modal,
                                   const fw_effects_loads *loads, double *damping);
/* fills open and pull: linear.c */
fw_status fw_effects_modal_open(fw_arena *arena, fw_effects_modal *modal);
/* forces of released pins on body b (npin x 2, N) under forces `force` (n, SI), at rest; and what
   pins that carry `pull` add to shape^T K shape */
void fw_effects_modal_pulls(const fw_effects_modal *modal, const double *force, double *pull);
double fw_effects_modal_turning(const fw_effects_modal *modal, const double *pull, int row,
                                int column);
/* the same for strains of bodies and ground (nbody + 1): pose (n, SI), turns (npin), and the force
   that springs and loads answer it with (n) */
fw_status fw_effects_modal_shift(fw_arena *arena, const fw_effects_modal *modal,
                                 const double *strain, double *shift, double *turn, double *force);
/* both of `loads` */
fw_status fw_effects_modal_find_shifts(fw_arena *arena, fw_effects_modal *modal);
/* rad: what they turn besides, of second order in their turns, at most 4 turn^2 */
double fw_effects_modal_second(const fw_effects_modal *modal);
fw_status fw_effects_modal_drag(fw_arena *arena, const fw_effects_modal *modal, double *mode);
/* turn of a pin by them at a time */
double fw_effects_modal_shifted(const fw_effects_modal *modal, int pin, double t_s, double piece_s);
/* scaled multipliers (rows) that hold the mechanism where forces `force` (n, SI) act and inertia
   does not; work (2 n) */
void fw_effects_modal_multipliers(const fw_effects_modal *modal, const double *force, double *work,
                                  double *lambda);
/* Frobenius norm of shape^T dK shape / (omega omega): what the forces `force` (n, SI; as they are
   at the initial pose; none of `loads` when `dead`) and the multipliers that hold them take from
   or add to the stiffness, relative */
fw_status fw_effects_modal_softening(fw_arena *arena, const fw_effects_modal *modal,
                                     const double *force, bool dead, double *part);

/* how much the stiffness and damping of the elements change within the motion, relative: their laws
   go on, and their forces are not linear. amplitude (modes): largest |q|. Infinite where a formula
   does not hold all the way. modal_stiffness.c */
fw_status fw_effects_modal_bend(fw_arena *arena, const fw_effects_modal *modal,
                                const double *amplitude, double *part);

/* ---- modal loads: a constant part, loads with laws, elements with laws ---- */
/* angle of a pin as drawn less its free angle */
double fw_effects_pin_deflection(const fw_mechanism *mechanism, int pin);

typedef struct fw_effects_modal_load {
    const fw_quantity_law *law;              /* NULL: constant, or an element */
    const fw_effects_force_element *element; /* NULL: force times law */
    bool shift;                              /* the springs' answer to a free strain */
    double *force;                           /* (n) of one unit of the law */
    double *mode;                            /* (modes) shape . force */
    double *sup, *first, *sway, *full; /* (modes) of its modal force over the scene: largest size,
                                          size at 0+, total variation, integral of the size */
} fw_effects_modal_load;

typedef struct fw_effects_modal_loads {
    fw_effects_modal_load *item;
    int count;
    double *work;        /* (n) */
    const char *why_not; /* a law that cannot be followed; NULL: fine */
} fw_effects_modal_loads;
fw_status fw_effects_modal_loads_find(fw_arena *arena, const fw_effects_modal *modal,
                                      fw_effects_modal_loads *modal_loads);
/* modal force (modes) += of one modal load */
void fw_effects_modal_load_at(const fw_effects_modal *modal,
                              const fw_effects_modal_loads *modal_loads,
                              const fw_effects_modal_load *modal_load, double t_s, double piece_s,
                              double *force);
/* times in (0, duration) at which some law breaks, ascending, and the duration; *count < 0: too
   many */
fw_status fw_effects_modal_loads_breaks(fw_arena *arena, const fw_effects_modal *modal,
                                        const fw_effects_modal_loads *modal_loads, double **t_s,
                                        int *count);

/* lower bound of the largest hinge deflection. `nonlinearity`: the relative error of the
   frequencies that is to be expected, and of the geometry */
fw_status fw_effects_modal_floor(fw_arena *arena, const fw_effects_modal *modal,
                                 const fw_effects_modal_loads *modal_loads, double nonlinearity,
                                 double *floor_rad);

#endif
