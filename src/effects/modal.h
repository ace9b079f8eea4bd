/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Linear modes of the constrained mechanism about its initial pose, the linear system that they are found of, what loads
   them, and the peaks that follow. Private to the room; the steps of envelope.c. SI. */
#ifndef FW_EFFECTS_MODAL_H
#define FW_EFFECTS_MODAL_H
#include "effects/effect.h"
#include "maths/matrix.h"

/* ---- linear.c: the mechanism at its initial pose as a linear system ---- */

/* The mechanism at its initial pose as a linear system: stiffness of what is elastic, rows of what
   holds. Private to the room.

   Scaled so that rows balance: x of a displacement is metres over length_m, of a rotation rad; a
   stiffness is over stiffness_N_per_m (and length_m where it turns). */

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

/* ---- modes ---- */

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
    double *seen,
        *seen_mode; /* (3 laws), (modes) of an element: values of its laws, its modal force */
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

/* ---- peaks.c: peaks of the linear motion ---- */

/* How far every hinge is deflected at most in the linear motion of a scene, from below and from
   above. Private to the room: for comparing two linear mechanisms under the same loads. */

typedef struct fw_effects_peaks {
    double *low, *high; /* (npin) rad: the largest |deflection| lies between */
    double *still;      /* (npin) rad: the largest |deflection| along the equilibria of the loads */
    double *ring;       /* (modes) largest |q| about the equilibria */
    double *late;       /* (modes) what breaks and bends of the loads behind the start add to it */
    double *rapid_rad;  /* (npin) modes too fast for the grid: their rings, of sizes */
    const char *why_not;
} fw_effects_peaks;

/* modal forces that depend on the motion: force (modes) at modal coordinates q under loads `load`
   (modes); `there`: the motion passes there, and not only the first guess of a step. Straight in
   every cell, to second order in it */
typedef struct fw_effects_peaks_source {
    void (*at)(void *data, const double *q, const double *load, bool there, double *force);
    void *data;
    const double *late; /* (modes) of the motion without them */
} fw_effects_peaks_source;

/* `source`: NULL without. `fastest_rad_per_s`: modes up to there are followed, others enter with
   the size of their ring, at most `amplitude` (modes; NULL: not known) */
fw_status fw_effects_peaks_find(fw_arena *arena, const fw_effects_modal *modal,
                                const fw_effects_modal_loads *modal_loads, double fastest_rad_per_s,
                                const double *amplitude, const fw_effects_peaks_source *source,
                                fw_effects_peaks *peaks);

/* What of hinges is not linear, as forces on the modes of the linear motion: along a motion, and
   how much of it the rings of fast modes leave open. Private to the room. */

/* what a hinge does besides: its opening along e and n as drawn (m), a torque on its rotation, and
   one on the turn of both bodies (N m) */
enum { FW_HINGE_PARTS = 4 };

typedef struct fw_effects_hinge_source {
    const fw_mechanism_hinge *hinge;
    double sense;               /* 1 where body a has the root at -a, else -1 */
    double *pull_e, *pull_n;    /* (modes) N: force on b along e and n */
    double *turn, *both;        /* (modes) of the pin, of both bodies together */
    double ring_N[2];           /* what the fast modes may add to its force along e and n */
    double softness_m_per_N[2]; /* as drawn */
    fw_flexure_hinge_rest rest;
    /* largest over the motion so far of what those rings add: in step with them, and for good */
    double wave[FW_HINGE_PARTS], lasting[FW_HINGE_PARTS];
} fw_effects_hinge_source;

typedef struct fw_effects_hinge_sources {
    const fw_effects_modal *modal;
    fw_effects_hinge_source *item;
    int count, slow; /* modes below `slow` are the motion; the others follow the loads at rest */
    double *at;      /* (modes) where they are at an instant */
    /* largest over the motion so far: (modes) force; (npin) rad, answer at rest of the others */
    double *force, *rapid_rad;
} fw_effects_hinge_sources;

/* `ring` (modes): largest |q| of the rings */
fw_status fw_effects_hinge_sources_new(fw_arena *arena, const fw_effects_modal *modal, int slow,
                                       const double *ring, fw_effects_hinge_sources *sources);
/* force (modes) at modal coordinates q under modal loads `load`; an fw_effects_peaks_source */
void fw_effects_hinge_sources_at(void *sources, const double *q, const double *load, bool there,
                                 double *force);
/* softness as drawn, and what does not depend on the rotation */
void fw_effects_hinge_source_of(const fw_mechanism_hinge *hinge, fw_effects_hinge_source *source);
/* the parts at a rotation, with both bodies turned by `turned_rad` on average, under the force (fe,
   fn) that it carries, along e and n as drawn */
void fw_effects_hinge_source_parts(const fw_effects_hinge_source *source, double rotation_rad,
                                   double turned_rad, double fe_N, double fn_N, double *part);
/* force on a mode by one unit of a part */
double fw_effects_hinge_source_mode(const fw_effects_hinge_source *source, int part, int mode);

#endif
