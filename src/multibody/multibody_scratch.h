/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a system needs for its evaluations, and the parts of fw_multibody_model_new and
   fw_multibody_system_new. Private to multibody/. */
#ifndef FW_MULTIBODY_MULTIBODY_SCRATCH_H
#define FW_MULTIBODY_MULTIBODY_SCRATCH_H
#include "multibody/model.h"
#include "multibody/system.h"

typedef struct fw_multibody_ports {
    double *p, *w;               /* (3 nport) SI: what each element sees at its own */
    double *arm;                 /* (2 nport) scaled, world axes */
    fw_effects_port_state *seen; /* (nelement) */
    /* for one element at a time, sizes of the largest one */
    double *f;                   /* (3 ports) */
    double *stiffness, *damping; /* (3 ports x 3 ports) */
    double *pose;                /* (3 nbody) */
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

/* forces.c: centre: origin of the scaled coordinates, m */
fw_status fw_multibody_elements_new(fw_arena *arena, fw_multibody_model *m,
                                    const fw_effects_loads *loads, fw_geometry_vec2 centre);
/* constraints.c: centre: m, origin of the scaled coordinates. After blocks and springs. */
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

/* constraints.c: what a point of the ground gains per unit of the law */
void fw_multibody_stretch_gain(const fw_multibody_model *m, const double local[2], double gain[2]);
/* forces.c: scaled force with which the surfaces of element i, a contact, press on each other */
double fw_multibody_element_pressing(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                                     int i, const double *v);
double fw_multibody_element_switch_value(const fw_multibody_system *sys,
                                         const fw_multibody_pose *pose,
                                         const fw_multibody_element *e, int i, const double *v);
/* system.c: fw_multibody_rhs; false: there are no accelerations. energies: their rates are wanted */
bool fw_multibody_evaluate(fw_multibody_system *sys, double t, const double *y, bool energies,
                           double *f);

/* ---- friction of joints ---- */

/* Coulomb friction of joints: what multibody_friction.c (the equations), friction_solve.c (the
   small systems) and multibody_flags.c (who sticks) share. Scaled units. Theory:
   docs/theory/effects/friction.md. */

typedef struct fw_multibody_friction_state {
    /* held during a step, changed by events */
    int slip;    /* sign of the rate; 0: it sticks */
    bool yields; /* at rest because others hold it, with the largest static torque, against slip */
    double held; /* coordinate at which it came to rest */
    /* what fw_multibody_friction_solve found for these flags */
    double torque, press;
} fw_multibody_friction_state;

struct fw_multibody_frictions {
    int n;
    const fw_multibody_friction_joint *joint; /* (n) the model's */
    fw_multibody_friction_state *item;        /* (n) */
    double *row;              /* (6 n) h of bodies a, b: rate = h.v, generalised force = h T */
    double *bias, *rate;      /* (n) relative acceleration at a = 0; h.v */
    double *accel;            /* (n) relative acceleration without friction */
    double *size;             /* (n) of what that adds up from */
    double *response, *react; /* (n x 3 (nbody + 1)), (n x 2 nblock) a and lambda for unit T */
    double *nothing;          /* (2 nblock) zeros */
    double *gain;             /* (n x n) relative acceleration i for unit T_j */
    double *loose;            /* (n) the same of i for itself if no joint held its bodies */
    double *base, *turn;      /* (2 n), (2 n x n) force that presses at T = 0, for unit T_j */
    double *torque;           /* (n) T, the answer */
    double *left;             /* (n) gain of i for itself while all that stick hold */
    bool *rests, *held;       /* (n) its rate is 0: may stick; it was at rest before */
    /* work of the small system */
    double *factor, *hold, *jacobian, *reach;            /* (n x n); reach (2 n x n) */
    double *start, *right, *more, *step, *press, *value; /* (n), the last two (2 n) */
    double *push, *creep;        /* (n) N but for the joint's force; what pulls back to rest */
    int *stuck, *moving, *pivot; /* (n) */
    /* work of the sorting */
    double *shift, *most, *centre, *before; /* (n) */
    int *side, *free, *inside;              /* (n) */
    bool *slid;                             /* (n) cannot hold */
    double *state;                          /* (ny) a derivative nobody reads */
    double speed;                           /* largest velocity seen: what round-off of a rate is */
    int met, met_slip; /* entry whose flag no longer fitted, and that flag; -1: none */
    int jam;           /* entry without a (single) torque, or -1 */
    int tight;         /* entry next to a jam, or -1 */
    int jammed;        /* the last such entry, kept, and when */
    double jam_time;
};

/* rows, rates, responses and gains for velocities v */
void fw_multibody_friction_respond(fw_multibody_system *sys, const fw_multibody_factor *factor,
                                   const double *v);
/* with the accelerations and multipliers without friction: what presses, and c */
void fw_multibody_friction_evaluate(fw_multibody_system *sys, const fw_multibody_solution *found,
                                    const double *v);
/* both, then torques for the flags that are held, and the solution with them; *lost: the power that
   they take. false: there are none, or perhaps more than one */
bool fw_multibody_friction_apply(fw_multibody_system *sys, const fw_multibody_factor *factor,
                                 const double *v, double *lost);
/* what sticks to rate 0: v */
void fw_multibody_friction_settle(fw_multibody_system *sys, const fw_multibody_factor *factor,
                                  double *v);
/* torques for the present flags; false: there is none, or perhaps more than one */
bool fw_multibody_friction_solve(struct fw_multibody_frictions *s);
/* the joint's own force that presses entry i, and all that does, at the torques found */
void fw_multibody_friction_force(const struct fw_multibody_frictions *s, int i, double force[2]);
double fw_multibody_friction_press(const struct fw_multibody_frictions *s, int i);
/* x of least norm with gain x = right among the `count` entries of `which` (both in that order) */
bool fw_multibody_friction_hold(struct fw_multibody_frictions *s, int count, const int *which);
void fw_multibody_friction_holding(struct fw_multibody_frictions *s, int count, const int *which,
                                   const double *right, double *x);
/* flags and torques of the entries at rest for the limits of the `press` that they
   have; the others keep their torques */
bool fw_multibody_friction_box(struct fw_multibody_frictions *s);
double fw_multibody_friction_coordinate(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                        int i);
/* rows and, by them, rates of v */
void fw_multibody_friction_rows(fw_multibody_system *sys, const fw_multibody_pose *pose,
                                const double *v);

/* ---- the way of `minimal` ---- */

/* The order in which `minimal` places bodies one after another, from the ground. */

/* a body turned about a pin of placed bodies, a dyad of two, or a body that nothing holds */
typedef struct fw_multibody_placing {
    bool dyad;
    int body[2];  /* the bodies placed; one: body[0] */
    int block[3]; /* pins: placed - body[0], body[0] - body[1], body[1] - placed; one: block[0] */
    int turn;     /* one: block that keeps its angle, or FW_NONE */
    int rate;     /* one: index of its angle among the independent ones, or FW_NONE */
    bool loose;   /* x, y and angle are independent, from `rate` on; no block */
} fw_multibody_placing;

typedef struct fw_multibody_placing_plan {
    fw_multibody_placing *step; /* (count) */
    int count, rates;           /* independent coordinates */
    int *rate_body;             /* (rates) */
    int *rate_axis;             /* (rates) 0 x, 1 y, 2 angle */
} fw_multibody_placing_plan;

enum { FW_MOST_RATES = 200 }; /* N is dense */

/* FW_SOLVER with a diagnostic that names the body where it ends */
fw_status fw_multibody_placing_find(fw_arena *arena, const fw_multibody_model *m,
                                    const fw_mechanism *mechanism, fw_diags *diags,
                                    fw_multibody_placing_plan *plan);

/* which side of a block a body is on: 0 (a) or 1 (b) */
static inline int fw_multibody_side(const fw_multibody_model *m, int block, int body) {
    return m->body[2 * block] == body ? 0 : 1;
}
/* the body on the other side */
static inline int fw_multibody_across(const fw_multibody_model *m, int block, int body) {
    return m->body[2 * block + 1 - fw_multibody_side(m, block, body)];
}

#endif
