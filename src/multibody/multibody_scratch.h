/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a system needs for its evaluations, and the parts of fw_multibody_model_new and
   fw_multibody_system_new. Private to multibody/. */
#ifndef FW_MULTIBODY_MULTIBODY_SCRATCH_H
#define FW_MULTIBODY_MULTIBODY_SCRATCH_H
#include "multibody/method.h"

typedef struct fw_multibody_ports { /* for one element at a time, sizes of the largest one */
    double *p, *w;                  /* (3 ports) SI: what it sees */
    double *arm;                    /* (2 ports) scaled, world axes */
    double *f;                      /* (3 ports) */
    double *stiffness, *damping;    /* (3 ports x 3 ports) */
    double *pose;                   /* (3 nbody) */
} fw_multibody_ports;

typedef struct fw_multibody_scratch {
    /* the pose made last, and where its numbers stand */
    fw_multibody_pose pose;
    double *cosine, *sine;       /* (nbody + 1) */
    double *arm, *jac;           /* (4 nblock), (12 nblock) */
    double *offset, *spring_end; /* where the ground moves: (2 nblock), (4 nspring) */
    double ground[3];            /* its law and derivatives, for this time and piece: */
    double ground_t, ground_piece_s;
    /* the factor made last */
    fw_multibody_factor factor;
    fw_multibody_chain_numbers chain;
    double epsilon; /* its proximal term: fw_epsilon, less inside a projection */
    void *method;   /* the method's own */
    /* evaluation */
    fw_multibody_solution solution;
    fw_multibody_ports port;
    double *right, *more, *drift; /* (2 nblock) right-hand sides, residuals, Psi_t */
    double *correction;           /* (3 (nbody + 1)) */
    double *stage;                /* (ny) a closed state, for methods that want one */
} fw_multibody_scratch;

/* ---- parts of a new model ---- */

/* elements.c: centre: origin of the scaled coordinates, m */
fw_status fw_multibody_elements_new(fw_arena *arena, fw_multibody_model *m,
                                    const fw_effects_loads *loads, fw_geometry_vec2 centre);
/* stretch.c: centre: m, origin of the scaled coordinates. After blocks and springs. */
fw_status fw_multibody_stretch_new(fw_arena *arena, const fw_mechanism *mechanism,
                                   const fw_effects_stretch *from, fw_geometry_vec2 centre,
                                   fw_multibody_model *m);
/* multibody_friction.c: joints with friction; after blocks */
fw_status fw_multibody_friction_joints(fw_arena *arena, const fw_mechanism *mechanism,
                                       const fw_effects_loads *loads, fw_multibody_model *m);
/* block_chain.c: the schedule of the elimination */
fw_status fw_multibody_chain_compile(fw_arena *arena, fw_multibody_model *model);

/* ---- parts of a new system ---- */

fw_status fw_multibody_friction_new(fw_arena *arena, fw_multibody_system *sys);

/* ---- parts of an evaluation ---- */

/* stretch.c: the ground as it stands at t, for the pose that is being made */
void fw_multibody_stretch_pose(const fw_multibody_system *sys, double t);
/* what a point of the ground gains per unit of the law */
void fw_multibody_stretch_gain(const fw_multibody_model *m, const double local[2], double gain[2]);
/* elements.c: accel += M^-1 Q */
void fw_multibody_element_forces(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                 const double *v);
void fw_multibody_element_power(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                const double *v, double power[2]); /* += */
/* scaled force with which the surfaces of element i, a contact, press on each other */
double fw_multibody_element_pressing(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                     int i, const double *v);
double fw_multibody_element_switch_value(const fw_multibody_system *sys,
                                         const fw_multibody_pose *pose,
                                         const fw_multibody_element *e, int i, const double *v);
/* project.c: the state onto Psi = 0 and G v = -Psi_t with the factor at hand, and the factor there;
   NULL: it does not get there */
const fw_multibody_factor *fw_multibody_project_state(fw_multibody_system *sys, double t,
                                                      double *y);
/* right = G v + Psi_t, by how much velocities miss the constraints */
void fw_multibody_velocity_residual(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                    const double *v, double *right);
/* rhs.c: fw_multibody_rhs; false: there are no accelerations. energies: their rates are wanted */
bool fw_multibody_evaluate(fw_multibody_system *sys, double t, const double *y, bool energies,
                           double *f);

#endif
