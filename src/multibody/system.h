/* SPDX-License-Identifier: GPL-3.0-or-later */
/* One compiled scene in motion: what may change about it, and the equations evaluated at its
   states. A system has one owner; two systems of one model know nothing of each other.

     model      what the scene is: const (model.h)
     system     what holds between evaluations: loads, flags, stabilisation, record. Its owner sets
                them, or functions that say so
     pose       sines, arms and Jacobians at (t, u): fw_multibody_pose_at
     factor     M and G eliminated at a pose: fw_multibody_factorise; NULL where that is impossible
     solution   accelerations and forces of an evaluation

   What needs a pose or a factor takes it. A system has memory for one of each: a pose is valid
   until the next fw_multibody_pose_at, a factor until the next fw_multibody_factorise, and
   functions that evaluate at a state of their own (t, y) make both anew. u is not copied: it stays
   as it is while its pose is used. Everything is in scaled units, t too. */
#ifndef FW_MULTIBODY_SYSTEM_H
#define FW_MULTIBODY_SYSTEM_H
#include "multibody/model.h"

/* ---- what may change ---- */

/* statics: laws of elements stand, and the ground has no speed */
typedef struct fw_multibody_hold {
    bool on;
    double t_s; /* at this time */
} fw_multibody_hold;

/* What acts, at first as the model says. Statics lets go of time and sets it by a load factor. */
typedef struct fw_multibody_loading {
    double *constant;                  /* (3 (nbody + 1)) accelerations by constant forces */
    double *force;                     /* (2 nload) fx, fy of loads at points */
    double *value;                     /* (nblock) f of a block without its law */
    bool driven;                       /* drivers follow their laws; false: only `value` counts */
    double actuation, drive;           /* what elements see as load, and comb drives: 1 */
    double actuation_rate, drive_rate; /* their derivatives by the load factor: 1 */
    fw_multibody_hold hold;
} fw_multibody_loading;

/* What holds on one side acts or not; held during a step, changed by events. */
typedef struct fw_multibody_flags {
    bool *stop;    /* (nstop) */
    bool *spring;  /* (nspring) always, but for slack cables */
    bool *element; /* (nswitch) */
} fw_multibody_flags;

typedef struct fw_multibody_record { /* kept over a run */
    long projections, events;
    double worst_position, worst_velocity; /* residuals of accepted states */
    int stuck; /* block that a projection could not close, and when; -1: none */
    double stuck_time;
} fw_multibody_record;

typedef struct fw_multibody_system {
    const fw_multibody_model *model;
    double piece_s; /* a time inside the smooth piece of the laws that is meant */
    fw_multibody_loading loading;
    fw_multibody_flags on;
    struct fw_multibody_frictions
        *friction;   /* who sticks (multibody_scratch.h); NULL: no friction */
    bool projecting; /* stabilise by projection */
    /* alpha = beta of G a = -gamma - 2 alpha (G v + Psi_t) - beta^2 Psi; 0: none */
    double baumgarte;
    fw_multibody_record record;
    struct fw_multibody_kernel *kernel; /* the fast path of `chain` for plain models, or NULL */
    struct fw_multibody_scratch *work;  /* multibody_scratch.h */
} fw_multibody_system;

/* FW_SOLVER with a diagnostic: the model's method cannot treat this mechanism */
fw_status fw_multibody_system_new(fw_arena *arena, const fw_multibody_model *model,
                                  const fw_mechanism *mechanism, fw_diags *diags,
                                  fw_multibody_system **system);

/* ---- at a pose: constraints.c ---- */

typedef struct fw_multibody_pose {
    double t;
    const double *u;             /* (3 nbody) the caller's */
    const double *cosine, *sine; /* (nbody + 1) */
    const double *arm;           /* (4 nblock) of a and b, world axes */
    const double *jac;           /* (12 nblock) 2 x 3 of body a, then of b; not where m->plain */
    /* as the ground stands at t: */
    const double *ground;     /* (3) its law and derivatives; 0 where it stands still */
    const double *offset;     /* (2 nblock) x_a - x_b of the origins */
    const double *spring_end; /* (4 nspring) local ends */
} fw_multibody_pose;

const fw_multibody_pose *fw_multibody_pose_at(fw_multibody_system *sys, double t, const double *u);
/* d from point a to point b of a block, axis and normal of a */
void fw_multibody_frame(const fw_multibody_model *m, const fw_multibody_pose *pose, int block,
                        double d[2], double e[2], double n[2]);
/* Psi (2 nblock), NULL: not asked for; the largest norm of a block is returned */
double fw_multibody_residual(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                             double *psi);
/* r = G v */
void fw_multibody_jacobian(const fw_multibody_model *m, const fw_multibody_pose *pose,
                           const double *v, double *r);
/* a -= M^-1 G^T lambda */
void fw_multibody_apply(const fw_multibody_model *m, const fw_multibody_pose *pose,
                        const double *lambda, double *a);
/* r = Psi_t; 0 where loads are not driven */
void fw_multibody_drift(const fw_multibody_system *sys, const fw_multibody_pose *pose, double *r);
/* r = G' v + Psi_tt, so that G a = -r; gamma of the text books is -r */
void fw_multibody_gamma(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                        const double *v, double *r);
/* rows of block i in G by the coordinates of its body a (side 0) or b (1): 2 x 3 */
void fw_multibody_side_jacobian(const fw_multibody_model *m, const fw_multibody_pose *pose, int i,
                                int side, double g[6]);
/* G without its empty rows, row-major (rows x nq), and vectors of its rows <-> of blocks */
void fw_multibody_dense_jacobian(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                 double *g);
void fw_multibody_pack(const fw_multibody_model *m, const double *block, double *rows);
void fw_multibody_unpack(const fw_multibody_model *m, const double *rows, double *block);

/* ---- forces at a pose, with velocities v (nq) ---- */

typedef struct fw_multibody_solution {
    const fw_multibody_pose *pose;
    double *accel;   /* (3 (nbody + 1)) */
    double *lambda;  /* (2 nblock) multipliers */
    double *element; /* (3 nport) forces of elements at their ports, N and N m */
} fw_multibody_solution;

/* forces.c: accel = M^-1 Q, and the elements' forces; lambda is as it was */
const fw_multibody_solution *fw_multibody_forces(fw_multibody_system *sys,
                                                 const fw_multibody_pose *pose, const double *v);
/* power that dampers take (0), that timed loads and the moving ground give (1); drivers' is
   lambda . Psi_t */
void fw_multibody_power(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                        const double *v, double power[2]);
typedef struct fw_multibody_pull { /* a spring between two points, as it is now */
    double ax, ay, bx, by;         /* arms in world axes */
    double ux, uy, length, rate;
} fw_multibody_pull;
fw_multibody_pull fw_multibody_pull_of(const fw_multibody_system *sys,
                                       const fw_multibody_pose *pose, int spring, const double *v);
/* points of a spring that are no farther apart than this coincide: their line means nothing */
double fw_multibody_spring_round_off(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                     int spring);
/* angle past a stop, positive beyond it, and its rate */
void fw_multibody_stop_travel(const fw_multibody_model *m, const fw_multibody_pose *pose,
                              const fw_multibody_stop *stop, const double *v, double *past,
                              double *rate);

/* forces.c */
/* generalised forces (nq) of those that are driven from outside (`works`), or of those that stand for pins: += */
void fw_multibody_element_driven(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                 const double *v, bool pins, double *force);
/* dQ/ds by the load factor s (nq): += */
void fw_multibody_element_slope(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                const double *v, double *force);
/* stored; `driven`: of those with `works` too */
double fw_multibody_element_energy(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                   const double *v, bool driven);
/* -dQ/du and -dQ/dv (nq x nq; the latter may be NULL): += */
void fw_multibody_element_tangent(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                  const double *v, const fw_effects_matrix *stiffness,
                                  const fw_effects_matrix *damping);
/* the first element whose formula does not hold, with what it says; NULL: all hold */
const fw_effects_force_element *fw_multibody_element_invalid(const fw_multibody_system *sys,
                                                             const fw_multibody_pose *pose,
                                                             const double *v, const char **why);

/* ---- with a factor: system.c ---- */

typedef struct fw_multibody_factor {
    const fw_multibody_pose *pose;
} fw_multibody_factor;

/* by the model's method; NULL: it is impossible there */
const fw_multibody_factor *fw_multibody_factorise(fw_multibody_system *sys,
                                                  const fw_multibody_pose *pose);
/* M a + G^T lambda = Q, G a = -gamma without friction */
const fw_multibody_solution *fw_multibody_accelerate(fw_multibody_system *sys,
                                                     const fw_multibody_factor *factor,
                                                     const double *v);
/* v += d, G d = -(G v + Psi_t) */
bool fw_multibody_project_velocity(fw_multibody_system *sys, const fw_multibody_factor *factor,
                                   double *v);
/* likewise by the least change in the mass metric: velocities behind a blow */
bool fw_multibody_impact(fw_multibody_system *sys, const fw_multibody_factor *factor, double *v);

/* ---- at a state: system.c, forces.c, multibody_flags.c ---- */

/* f = y' (ny) as fw_maths_ode wants it; accelerations are NaN where there are none */
void fw_multibody_rhs(void *system, double t, const double *y, double *f);
/* the same without the rates of energies, which stay as they are in f */
void fw_multibody_rhs_motion(void *system, double t, const double *y, double *f);
/* that, and what it found, forces of joints included */
const fw_multibody_solution *fw_multibody_react(fw_multibody_system *sys, double t, const double *y,
                                                double *f);

/* an accepted step: y onto Psi = 0 and G v = -Psi_t, and f there; false: y is not usable */
bool fw_multibody_project(void *system, double t, double *y, double *f);
/* u onto Psi(u, t) = 0 by a factor of its own; the pose of the result. NULL: not reached */
const fw_multibody_pose *fw_multibody_close_position(fw_multibody_system *sys, double t, double *u);
/* y likewise, u and v; false: it does not get there */
bool fw_multibody_close_state(fw_multibody_system *sys, double t, double *y);
/* v (nq) onto G v = -Psi_t at the pose; what is `stated` (nq) keeps its value of `given` as far as
   the joints allow it, and what is not follows. work: 2 (nbody + 1) */
bool fw_multibody_follow_stated(fw_multibody_system *sys, const fw_multibody_pose *pose,
                                const bool *stated, const double *given, double *v, double *work);

typedef struct fw_multibody_energy {
    double kinetic, elastic, work, dissipated;
} fw_multibody_energy;
double fw_multibody_kinetic_energy(const fw_multibody_model *m, const double *v); /* v^T M v / 2 */
fw_multibody_energy fw_multibody_energy_at(fw_multibody_system *sys, double t, const double *y);

/* what holds only on one side: stops, then cables, then switches of elements */
int fw_multibody_switch_count(const fw_multibody_model *m);
bool fw_multibody_switch_on(const fw_multibody_system *sys, int i);
/* > 0: should be on */
double fw_multibody_switch_value(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                 int i, const double *v);
void fw_multibody_switch_values(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                const double *v, double *value); /* all */
/* the element that switch i belongs to, of those behind stops and cables */
const fw_multibody_element *fw_multibody_element_of_switch(const fw_multibody_model *m, int i);
/* all flags from the state; its pose */
const fw_multibody_pose *fw_multibody_set_switches(fw_multibody_system *sys, double t,
                                                   const double *y);
/* one flag; energy that is let go counts as dissipated in y */
void fw_multibody_flip(fw_multibody_system *sys, double t, int i, double *y);

/* system.c: forces of a solution in SI. Pins (2 npin): on body b, world axes. Joints (3 njoint):
   force on body b, torque on it about its point b. Drivers (ndriver): N or N m along the driven
   coordinate */
void fw_multibody_pin_forces(const fw_multibody_model *m, const fw_multibody_solution *found,
                             double *out);
void fw_multibody_joint_forces(const fw_multibody_model *m, const fw_multibody_solution *found,
                               const fw_mechanism *mechanism, double *joint, double *driver);

/* ---- Coulomb friction of joints: multibody_flags.c; where there is none they do nothing ---- */

void fw_multibody_friction_begin(fw_multibody_system *sys); /* a run: forget flags */
void fw_multibody_friction_track(fw_multibody_system *sys,
                                 const double *y); /* velocities that occur */
/* all flags anew, and velocities of what came to rest to 0; false: none fit, see below */
bool fw_multibody_friction_decide(fw_multibody_system *sys, double t, double *y);
/* (nfriction) >= 0: the flag fits */
void fw_multibody_friction_fits(fw_multibody_system *sys, double t, const double *y, double *fit);
bool fw_multibody_friction_slips(const fw_multibody_system *sys); /* any of them, or yields */
/* force (2 nfriction): the joint's force that presses at (t, y); 0 where it sticks or nothing is
   known. drag (nfriction x nq), NULL: not asked for: accelerations per unit of that force */
void fw_multibody_friction_pressing(fw_multibody_system *sys, double t, const double *y,
                                    double *force, double *drag);
/* the flag of entry i fits no longer; decide follows */
void fw_multibody_friction_meet(fw_multibody_system *sys, int i);
/* the joint whose friction has no torque, or more than one, and when (scaled) */
bool fw_multibody_friction_jammed(const fw_multibody_system *sys, double *t, const char **id,
                                  fw_place *place);

/* ---- the chain for other rooms: block_chain.c ---- */

/* numbers of S and its factor along the model's schedule */
typedef struct fw_multibody_chain_numbers {
    double *diagonal;         /* (3 pins) xx, xy, yy of S */
    double *pivot;            /* (3 pins) of the pivot blocks: 1/d, l, 1/d, the larger row first */
    unsigned char *first_row; /* (pins) which row that is */
    double *block, *factor;   /* (4 blocks) S below the diagonal, then L */
    double *more, *left, *product; /* (2 pins), (2 pins), (3 bodies) work of the iteration */
} fw_multibody_chain_numbers;
fw_status fw_multibody_chain_numbers_new(fw_arena *arena, const fw_multibody_model *m,
                                         fw_multibody_chain_numbers *s);
/* S from the arms, or from the Jacobians */
void fw_multibody_chain_assemble(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                 fw_multibody_chain_numbers *s);
/* L D L^T of S + epsilon D; S is used up. false: not positive */
bool fw_multibody_chain_factor(const fw_multibody_chain *c, fw_multibody_chain_numbers *s,
                               double epsilon);
/* (S + eps D) x = x, in place */
void fw_multibody_chain_solve(const fw_multibody_chain *c, const fw_multibody_chain_numbers *s,
                              double *x);
/* S x = right at the pose whose S + eps D is factored; right is kept, x (2 nblock) */
void fw_multibody_chain_proximal(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                 fw_multibody_chain_numbers *s, const double *right, double *x);

/* ---- methods: method_*.c ---- */

/* What solves  M a + G^T lambda = Q,  G a = -gamma: one file and one line in methods.def each.
   Vectors are in the model's order: a, d (3 nbody), gamma, lambda, r (2 nblock; empty rows are 0
   and stay 0). */

/* Instructions of an answer for the reference six-bar (five bodies, n = 15, m = 12) by dop853 at a
   tolerance of 1e-7, over the right-hand sides of its finer run: projection, dense output, peaks
   and the run that errors are estimated from included; and how that grows with the bodies. Counted
   by `flexwright tradeoff`, gcc -O2 (docs/theory/tradeoff.md). Dense factorisations grow with the
   cube of the bodies, where small ones are mostly calls. */
typedef struct fw_multibody_method_cost {
    double six_bar, power;
} fw_multibody_method_cost;

typedef struct fw_multibody_method {
    const char *name, *summary, *source;
    fw_multibody_method_cost cost;
    bool independent; /* solves for independent coordinates, not for forces: very different masses
                         cost it no digits */
    const struct fw_multibody_dense_kernel *kernel; /* of a dense one (multibody_dense.h); NULL */
    /* memory, for sys->work->method; FW_SOLVER with a diagnostic when it cannot treat this
       mechanism. NULL: none */
    fw_status (*prepare)(fw_arena *arena, fw_multibody_system *sys, const fw_mechanism *mechanism,
                         fw_diags *diags);
    /* false: impossible there */
    bool (*factor)(fw_multibody_system *sys, const fw_multibody_pose *pose);
    /* a: in M^-1 Q, out the constrained acceleration; lambda: out */
    void (*accelerate)(fw_multibody_system *sys, const fw_multibody_factor *factor,
                       const double *gamma, double *a, double *lambda);
    /* d with G d = -r: of least mass norm, or the method's own choice. With G of the pose, but the
       numbers of the factor made last, which may be of a pose nearby */
    void (*correct)(fw_multibody_system *sys, const fw_multibody_pose *pose, const double *r,
                    double *d);
    /* its own way onto Psi(q, t) = 0 from u: the pose there, or NULL. The member NULL: Newton by
       `correct` */
    const fw_multibody_pose *(*close)(fw_multibody_system *sys, double t, double *u);
    /* with close: the right-hand side is evaluated at closed states, so that only the independent
       coordinates are integrated */
    bool closes_stages;
    /* what is worth knowing after a run, one sentence: which coordinates are independent, how often
       they changed, where the rank dropped. NULL: nothing */
    fw_status (*report)(const fw_multibody_system *sys, const fw_mechanism *mechanism,
                        fw_text *out);
} fw_multibody_method;

/* NULL: unknown; name NULL: the default */
const fw_multibody_method *fw_multibody_method_find(const char *name);

#endif
