/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The compiled scene: everything of one mechanism and its active effects in plain arrays, scaled by
   the scene's own length, mass and time, constraints in the order of elimination. Read by
   assembly/, dynamics/ and statics/, too.

   State y = (u, v, dissipated, worked): displacements u (3 nbody) from the assembled pose,
   velocities v (3 nbody), then, where something needs them, the dissipated energy and the work of
   drivers and of loads that go with time. The ground is body nbody: it has no state and no mass.

   Constraints come in blocks of two rows between two bodies (fw_multibody_block). What has one row
   leaves the
   second one empty (0 = 0); a weld is a pin and a turn. So S = G M^-1 G^T has 2 x 2 blocks whatever
   the joints are. */
#ifndef FW_MULTIBODY_MODEL_H
#define FW_MULTIBODY_MODEL_H
#include "multibody/multibody.h"

typedef struct fw_multibody_scale { /* one unit of the model in SI */
    double length_m, mass_kg, time_s;
} fw_multibody_scale;

/* ---- constraints ----
   d = x_b + r_b - x_a - r_a from point a to point b; e(phi_a), n(phi_a): axis and normal fixed in
   a. PIN     -d = 0                              (two rows: the force on b is +lambda) SLIDE phi_b
   - phi_a - value = 0, n.d = 0 ROD     |d| - value = 0 TURN    phi_b - phi_a - value = 0 TRAVEL e.d
   - value = 0 value is constant or, with a driver, a law in time. */
typedef enum fw_multibody_rows {
    FW_ROWS_PIN,
    FW_ROWS_SLIDE,
    FW_ROWS_ROD,
    FW_ROWS_TURN,
    FW_ROWS_TRAVEL
} fw_multibody_rows;

typedef struct fw_multibody_block {
    fw_multibody_rows rows;
    int a, b;                   /* bodies */
    double cos_axis, sin_axis;  /* in the frame of a */
    double value;               /* TURN, SLIDE: less the angle at the origin */
    double free;                /* of a driver: value = free + law */
    const fw_quantity_law *law; /* NULL: constant */
    double unit;                /* of the law: SI per scaled */
    int pin, joint, driver;     /* of the mechanism, or FW_NONE */
} fw_multibody_block;

/* ---- forces ---- */
typedef struct fw_multibody_model_torsion {
    int a, b;            /* bodies */
    double k, c, angle0; /* angle - free angle at the assembled pose */
} fw_multibody_model_torsion;

typedef struct fw_multibody_model_load {
    int body;
    double x, y, fx, fy; /* local arm, force in world axes */
} fw_multibody_model_load;

typedef struct fw_multibody_model_timed {
    int body;
    double x, y, fx, fy, torque;
    const fw_quantity_law *law;
} fw_multibody_model_timed;

typedef struct fw_multibody_model_spring {
    int a, b;
    double ax, ay, bx, by; /* local arms */
    double k, c, length;
    bool cable; /* only pulls */
    bool on;    /* a cable: is it taut? (held during a step, changed by events) */
} fw_multibody_model_spring;

typedef struct fw_multibody_model_stop {
    int a, b, pin;
    double side, at, k, c; /* at: angle from the assembled pose's */
    bool on;
} fw_multibody_model_stop;

typedef struct fw_multibody_model_slide { /* spring and damper along a prismatic joint */
    int a, b, block;                      /* the joint's SLIDE block has points and axis */
    double k, c, free;
} fw_multibody_model_slide;

typedef struct
    fw_multibody_model_element { /* a force element (effects/element.h) on the model's bodies */
    const fw_effects_force_element *own;
    bool electrodes; /* a comb drive: goes with `drive` below */
    fw_effects_force_element
        scaled; /* its ports in scaled units, those of the ground from the centre */
    int *body;  /* (ports) */
    bool *on;   /* (switches) held during a step, changed by events */
    double *f;  /* (3 ports) N, N m: at the last fw_multibody_model_forces */
} fw_multibody_model_element;

typedef struct fw_multibody_element_work { /* for one element at a time, sizes of the largest one */
    double *p, *w;                         /* (3 ports) SI: what it sees */
    double *arm;                           /* (2 ports) scaled, world axes */
    double *f;                             /* (3 ports) */
    double *stiffness, *damping;           /* (3 ports x 3 ports) */
    double *pose;                          /* (3 nbody) */
} fw_multibody_element_work;
/* Ground points that move with a law, stretch.c. The model stands at one time:
   fw_multibody_model_at. */
typedef struct fw_multibody_model_stretch {
    const fw_quantity_law *law; /* NULL: the ground stands still */
    double strain, centre[2];   /* a point of the ground gains strain (point - centre) law */
    double *block, *spring;     /* (2 nblock) of d, (4 nspring) of the ends: per unit of the law */
    double *offset, *end;       /* likewise, what they are where the law is 0 */
    double now[3], t, piece;    /* law and derivatives at scaled time t */
} fw_multibody_model_stretch;

/* ---- sparse block LDL^T of S = G M^-1 G^T, 2 x 2 blocks, one row of blocks per constraint block
 */
typedef struct
    fw_multibody_coupling { /* a body shared by two blocks: block += J_row M^-1 J_column^T */
    int block, row_arm, column_arm, body;
    double sign;
} fw_multibody_coupling;

typedef struct fw_multibody_update { /* block[to] -= factor[left] block[right]^T */
    int to, left, right;
} fw_multibody_update;

typedef struct fw_multibody_chain {
    int pins, blocks, ncoupling; /* pins: rows of blocks; blocks: below the diagonal */
    int *column;                 /* (pins + 1) first block below the diagonal of each column */
    int *row;                    /* (blocks) */
    int *first;                  /* (pins + 1) first update of each column */
    fw_multibody_update *update;
    fw_multibody_coupling *coupling; /* (ncoupling) */
    double *diagonal;                /* (3 pins) xx, xy, yy of S */
    double *isotropic;        /* (2 pins) D of the proximal term: 1/m_a + 1/m_b of a pin's rows */
    double shift;             /* eps of the last factorisation */
    double *pivot;            /* (3 pins) of the pivot blocks: 1/d, l, 1/d, the larger row first */
    unsigned char *first_row; /* (pins) which row that is */
    double *block, *factor;   /* (4 blocks) S below the diagonal, then L */
} fw_multibody_chain;

struct fw_multibody_frictions; /* friction.h */

typedef struct fw_multibody_model {
    fw_multibody_scale scale;
    int nbody, nblock, npin, njoint, ndriver;
    int nq, ny;                /* 3 nbody; length of the state */
    int rows;                  /* constraint rows that are not empty */
    bool plain;                /* every block is a pin: arms say everything, `jac` is not filled */
    bool driven;               /* some block has a law */
    int dissipated, worked;    /* index in the state, or -1 */
    double *origin;            /* (3 (nbody + 1)) assembled pose, unscaled angle, scaled x and y */
    double *mass, *inertia;    /* (nbody) */
    double *minv, *jinv;       /* (nbody + 1), 0 for the ground */
    fw_multibody_block *block; /* (nblock) in the order of elimination */
    int *pin_block;            /* (npin) block of a pin, FW_NONE: released */
    /* (njoint, ndriver) first block of those: */
    int *joint_block, *driver_block;
    int *body;        /* (2 nblock) bodies a and b */
    double *local;    /* (4 nblock) local arms of a and b */
    double *offset;   /* (2 nblock) x_a - x_b of the origins */
    double *constant; /* (3 (nbody + 1)) forces / masses: accelerations; 0 for ground */
    fw_multibody_model_torsion *torsion;
    fw_multibody_model_load *load;
    fw_multibody_model_timed *timed;
    fw_multibody_model_stop *stop;
    fw_multibody_model_slide *slide;
    fw_multibody_model_spring *spring;
    int ntorsion, nload, ntimed, nstop, nslide, nspring;
    fw_multibody_model_stretch stretch;
    int ncable; /* of the springs */
    fw_multibody_model_element *element;
    int nelement, nswitch; /* switches of all elements */
    int *pin_element;      /* (npin) element that stands for a pin, or FW_NONE */
    int nreleased;         /* pins that are not constraints */
    fw_multibody_element_work port;
    double actuation; /* what elements see as load: 1; in statics the load factor */
    double drive;     /* the same of comb drives: their voltages go alone towards pull-in */
    double actuation_rate, drive_rate; /* their derivatives by the load factor: 1 */
    double held_s; /* statics: elements see their laws at this time; below 0: as time goes */
    bool special;  /* elements, released pins, friction or a stretching ground: no fast path */
    struct fw_multibody_frictions *friction; /* NULL: none */
    double size; /* largest |offset| + arms: round-off of Psi is eps times this */
    fw_multibody_chain chain;
    const struct fw_multibody_method *method;
    void *work;                         /* the method's */
    struct fw_multibody_kernel *kernel; /* fast path of `chain` for plain models, or NULL */
    double
        baumgarte; /* alpha = beta of G a = -gamma - 2 alpha (G v + Psi_t) - beta^2 Psi; 0: none */
    bool projecting; /* stabilise by projection */
    double epsilon;  /* of the chain's factor: fw_epsilon, less inside a projection */
    /* work */
    double *cosine, *sine; /* (nbody + 1) */
    double *arm;           /* (4 nblock) arms in world axes */
    double *jac;           /* (12 nblock) 2 x 3 of body a, then of b; not plain */
    double *accel;         /* (3 (nbody + 1)) */
    double *lambda, *right, *more, *drift, *residual; /* (2 nblock) */
    double *correction, *product;                     /* (3 (nbody + 1)) */
    const double *posed; /* (3 nbody) the u of the last fw_multibody_model_pose */
    double *stage;       /* (ny) a closed state, for methods that want one */
    double piece;        /* s: a time inside the smooth piece of the laws */
    bool lean;           /* powers are not asked for */
    bool broken;         /* no factor: the state is not usable */
    /* kept over a run */
    long projections, events;
    double worst_position, worst_velocity;
    int stuck; /* block that a projection could not close, and when; -1: none */
    double stuck_time;
} fw_multibody_model;

/* ---- methods: one file each, method_*.c; rows in multibody_table.c ---- */

/* What solves  M a + G^T lambda = Q,  G a = -gamma.  Arrays are in the model's order: a (3 nbody),
   lambda, gamma, r (2 nblock, empty rows are 0 and stay 0). */
typedef struct fw_multibody_method {
    const char *name, *summary, *source;
    bool independent; /* solves for independent coordinates, not for forces: very different masses
                         cost it no digits */
    /* memory; FW_SOLVER with a diagnostic when it cannot treat this mechanism. NULL: none */
    fw_status (*prepare)(fw_arena *arena, fw_multibody_model *m, const fw_mechanism *mechanism,
                         fw_diags *diags, void **work);
    /* for the pose that the model holds (fw_multibody_model_pose); false: impossible there */
    bool (*factor)(fw_multibody_model *m);
    /* a: in M^-1 Q, out the constrained acceleration; lambda: out */
    void (*accelerate)(fw_multibody_model *m, const double *gamma, double *a, double *lambda);
    /* d with G d = -r: of least mass norm, or the method's own choice */
    void (*correct)(fw_multibody_model *m, const double *r, double *d);
    /* its own way onto Psi(q, t) = 0 from u; leaves the model posed there. NULL: Newton by correct
     */
    bool (*close)(fw_multibody_model *m, double t, double *u);
    /* with close: the right-hand side is evaluated at closed states, so that only the independent
       coordinates are integrated */
    bool closes_stages;
    /* what is worth knowing after a run, one sentence: which coordinates are independent, how often
       they changed, where the rank dropped. NULL: nothing */
    fw_status (*report)(const fw_multibody_model *m, const fw_mechanism *mechanism, fw_text *out);
} fw_multibody_method;
const fw_multibody_method *
fw_multibody_method_find(const char *name); /* NULL: unknown; name NULL: the default */

/* multibody_check.c: what comes in from mechanism and scene; errors are reported */
fw_status fw_multibody_check_motion(const fw_mechanism *mechanism, const fw_device_scene *scene,
                                    fw_diags *diags);
/* multibody_names.c: id of the joint or driver that a block belongs to */
const char *fw_multibody_block_name(const fw_mechanism *mechanism, const fw_multibody_block *block);
fw_place fw_multibody_block_place(const fw_mechanism *mechanism, const fw_multibody_block *block);

/* loads may be NULL (assembly: no forces); method NULL: chain */
fw_status fw_multibody_model_new(fw_arena *arena, const fw_mechanism *mechanism,
                                 const fw_effects_loads *loads, const double *q, double duration_s,
                                 const fw_multibody_method *method, fw_diags *diags,
                                 fw_multibody_model **model);

/* topology.c: elimination order of blocks between bodies (2 n; `ground` does not couple):
   order[k] = block, then the schedule */
fw_status fw_multibody_topology_order(fw_arena *arena, int n, const int *body, int ground,
                                      int *order);
fw_status fw_multibody_chain_compile(fw_arena *arena, fw_multibody_model *model);

/* block_chain.c */
void fw_multibody_chain_assemble(fw_multibody_model *m); /* S from the arms, or from jac */
bool fw_multibody_chain_factor(fw_multibody_chain *c, double epsilon); /* false: not positive */
void fw_multibody_chain_solve(const fw_multibody_chain *c,
                              double *x); /* (S + eps D) x = x, in place; D = isotropic */
/* S x = right at the pose whose S + eps D is factored; right is kept, x (2 nblock) */
void fw_multibody_chain_proximal(fw_multibody_model *m, const double *right, double *x);

/* stretch.c: the ground as it stands at scaled time t; nothing to do where it stands still. What
   takes a time (residual, drift, gamma, rhs) does it; before fw_multibody_model_pose it is the
   caller's. */
void fw_multibody_model_at(fw_multibody_model *m, double t);
/* what a point of the ground gains per unit of the law */
void fw_multibody_stretch_gain(const fw_multibody_model *m, const double local[2], double gain[2]);
void fw_multibody_stretch_drift(const fw_multibody_model *m,
                                double *r); /* r += Psi_t of the moving ground; posed */
double fw_multibody_stretch_power(const fw_multibody_model *m,
                                  const double *y); /* fed in by springs and slides; posed */

/* constraints.c */
void fw_multibody_model_pose(fw_multibody_model *m,
                             const double *u); /* sines, arms and, unless plain, jac */
/* d from point a to point b of a block, axis and normal of a, at the pose of u */
void fw_multibody_model_frame(const fw_multibody_model *m, int block, const double *u, double d[2],
                              double e[2], double n[2]);
/* Psi (2 nblock) at (u, t); largest norm of a block. Poses the model. */
double fw_multibody_model_residual(fw_multibody_model *m, double t, const double *u, double *psi);
void fw_multibody_model_jacobian(const fw_multibody_model *m, const double *v,
                                 double *r); /* r = G v */
void fw_multibody_model_apply(const fw_multibody_model *m, const double *lambda,
                              double *a); /* a -= M^-1 G^T lambda */
void fw_multibody_model_transpose(const fw_multibody_model *m, const double *lambda,
                                  double *force); /* += G^T lambda */
void fw_multibody_model_drift(const fw_multibody_model *m, double t,
                              double *r); /* r = Psi_t; posed */
/* r = G' v + Psi_tt, so that G a = -r; gamma of the text books is -r */
void fw_multibody_model_gamma(const fw_multibody_model *m, double t, const double *v, double *r);
/* G without its empty rows, row-major (rows x nq), and vectors of its rows <-> of blocks */
void fw_multibody_model_dense_jacobian(const fw_multibody_model *m, double *g);
void fw_multibody_model_pack(const fw_multibody_model *m, const double *block, double *rows);
void fw_multibody_model_unpack(const fw_multibody_model *m, const double *rows, double *block);

/* forces.c */
void fw_multibody_model_forces(fw_multibody_model *m, double t,
                               const double *y); /* accel = M^-1 Q; posed */
/* power that dampers take (0), that timed loads give (1); drivers' is lambda . Psi_t. Posed. */
void fw_multibody_model_power(const fw_multibody_model *m, double t, const double *y,
                              double power[2]);
typedef struct fw_multibody_pull { /* a spring between two points, as it is now */
    double ax, ay, bx, by;         /* arms in world axes */
    double ux, uy, length, rate;
} fw_multibody_pull;
fw_multibody_pull fw_multibody_model_pull(const fw_multibody_model *m,
                                          const fw_multibody_model_spring *s,
                                          const double *y); /* posed */
/* points of a spring that are no farther apart than this coincide: their line means nothing */
double fw_multibody_spring_round_off(const fw_multibody_model *m,
                                     const fw_multibody_model_spring *s);
/* e.d - free length of a prismatic joint, and its rate; posed */
void fw_multibody_model_travel(const fw_multibody_model *m, const fw_multibody_model_slide *s,
                               const double *y, double *travel, double *rate);
/* angle past a stop, positive beyond it, and its rate */
void fw_multibody_model_stopped(const fw_multibody_model *m, const fw_multibody_model_stop *s,
                                const double *y, double *past, double *rate);

/* elements.c: what force elements do, in scaled units. The model is posed at y. */
void fw_multibody_model_element_forces(fw_multibody_model *m, double t,
                                       const double *y); /* accel += M^-1 Q */
/* generalised forces (nq) of those that are driven from outside (`works`): += */
void fw_multibody_model_element_driven(fw_multibody_model *m, double t, const double *y,
                                       double *force);
/* dQ/ds by the load factor s (nq): += */
void fw_multibody_model_element_slope(fw_multibody_model *m, double t, const double *y,
                                      double *force);
void fw_multibody_model_element_power(const fw_multibody_model *m, double t, const double *y,
                                      double power[2]); /* += */
/* stored; `driven`: of those with `works` too */
double fw_multibody_model_element_energy(const fw_multibody_model *m, double t, const double *y,
                                         bool driven);
/* -dQ/du and -dQ/dv (nq x nq, may be NULL): += */
void fw_multibody_model_element_tangent(const fw_multibody_model *m, double t, const double *y,
                                        double *stiffness, double *damping);
/* scaled force with which the surfaces of element i, a contact, press on each other */
double fw_multibody_model_element_pressing(const fw_multibody_model *m, int i, double t,
                                           const double *y);
/* the i-th switch of all elements: its element, and which one there */
fw_multibody_model_element *fw_multibody_model_element_switch(const fw_multibody_model *m, int i,
                                                              int *which);
double fw_multibody_model_element_switch_value(const fw_multibody_model *m,
                                               const fw_multibody_model_element *e, double t, int i,
                                               const double *y);
/* the first element whose formula does not hold at y, with what it says; NULL: all hold */
const fw_effects_force_element *fw_multibody_model_element_invalid(const fw_multibody_model *m,
                                                                   double t, const double *y,
                                                                   const char **why);

/* rhs.c */
void fw_multibody_model_free(fw_multibody_model *m, double t,
                             const double *y); /* accel, lambda without friction */
void fw_multibody_model_accelerate(fw_multibody_model *m, double t, const double *y,
                                   double *f); /* posed, factored */
void fw_multibody_model_rhs(void *model, double t, const double *y, double *f);
/* the same without the rates of energies, which stay as they are in f */
void fw_multibody_model_lean_rhs(void *model, double t, const double *y, double *f);
/* that, and lambda is there afterwards */
void fw_multibody_model_react(fw_multibody_model *m, double t, const double *y, double *f);

/* project.c */
bool fw_multibody_model_project(void *model, double t, double *y, double *f);
bool fw_multibody_model_project_position(fw_multibody_model *m, double t, double *u);
bool fw_multibody_model_project_velocity(fw_multibody_model *m, double t,
                                         double *v); /* factor belongs to the pose */
bool fw_multibody_model_impact(fw_multibody_model *m, double t,
                               double *v); /* likewise: least change in the mass metric */

/* multibody_friction.c, stick.c: Coulomb friction of joints; where there is none they do nothing */
/* q (3 nbody): the pose of u = 0, SI */
fw_status fw_multibody_friction_new(fw_arena *arena, const fw_mechanism *mechanism,
                                    const fw_effects_loads *loads, fw_multibody_model *m);
int fw_multibody_friction_count(const fw_multibody_model *m);
void fw_multibody_friction_apply(fw_multibody_model *m, double t,
                                 const double *y); /* accel, lambda += what it does */
double
fw_multibody_friction_power(const fw_multibody_model *m); /* taken away at the last evaluation */
void fw_multibody_friction_settle(fw_multibody_model *m,
                                  double *y); /* what sticks to rate 0; posed, factored */
void fw_multibody_friction_begin(fw_multibody_model *m); /* a run: forget flags */
void fw_multibody_friction_track(fw_multibody_model *m,
                                 const double *y); /* velocities that occur */
/* all flags anew, and velocities of what came to rest to 0; false: none fit, see below */
bool fw_multibody_friction_decide(fw_multibody_model *m, double t, double *y);
void fw_multibody_friction_fits(fw_multibody_model *m, double t, const double *y,
                                double *fit);                  /* (count) >= 0: fits */
bool fw_multibody_friction_slips(const fw_multibody_model *m); /* any of them, or yields */
/* (2 count) the joint's force that presses, at (t, y); 0 where it sticks or nothing is known */
void fw_multibody_friction_pressing(fw_multibody_model *m, double t, const double *y,
                                    double *force);
/* (nq) accelerations of entry i per unit of that force, at the last evaluation */
void fw_multibody_friction_drags(const fw_multibody_model *m, int i, double *accel);
void fw_multibody_friction_meet(fw_multibody_model *m,
                                int i); /* its flag fits no longer; decide follows */
/* the joint whose friction has no torque, or more than one, and when (scaled) */
bool fw_multibody_friction_jammed(const fw_multibody_model *m, double *t, const char **id,
                                  fw_place *place);

/* energy.c */
typedef struct fw_multibody_energy {
    double kinetic, elastic, work, dissipated;
} fw_multibody_energy;
double fw_multibody_model_kinetic(const fw_multibody_model *m, const double *v); /* v^T M v / 2 */
fw_multibody_energy fw_multibody_model_energy(fw_multibody_model *m, double t, const double *y);

/* multibody_events.c: what holds only on one side: stops, then cables, then switches of elements */
int fw_multibody_model_switches(const fw_multibody_model *m);
/* all flags from the state; posed here */
void fw_multibody_model_set_switches(fw_multibody_model *m, double t, const double *y);
/* > 0: should be on. Posed at y. */
double fw_multibody_model_switch_value(const fw_multibody_model *m, double t, int i,
                                       const double *y);
void fw_multibody_model_switch_values(const fw_multibody_model *m, double t, const double *y,
                                      double *value); /* all */
bool fw_multibody_model_switch_on(const fw_multibody_model *m, int i);
/* energy that is let go counts as dissipated */
void fw_multibody_model_flip(fw_multibody_model *m, double t, int i, double *y);

static const double fw_epsilon = 1e-8; /* proximal term, relative to 1/m_a + 1/m_b of each pin */

#endif
