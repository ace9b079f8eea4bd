/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mechanism without time: loads and drivers at a load factor, equilibrium and tangent; and a sequence
   of its equilibria while it is followed. Scaled units. Private to statics/. */
#ifndef FW_STATICS_STATICS_EQUILIBRIUM_H
#define FW_STATICS_STATICS_EQUILIBRIUM_H
#include "dynamics/dynamics.h"
#include "maths/matrix.h"
#include "multibody/system.h"
#include "statics/statics.h"

/* ---- reduced.c ---- */

/* Motions that the joints allow, and the stiffness against them: the null space of G and the
   symmetric pencil (K, M) in it. Scaled units. Private to statics/. */

/* unknowns up to which a step to the next level is computed: more would take longer than the motion itself */
enum { FW_LEVEL_MOST = 300 };

/* entries of a matrix one by one: those of the same place add up */
typedef struct fw_statics_entries {
    fw_arena *arena;
    int *row, *column;
    double *value;
    int count, room;
    bool failed; /* no memory */
} fw_statics_entries;

/* The same of large mechanisms without a dense matrix. With z = M^1/2 u, A = B G M^-1/2 as below and
   unit = the largest entry of M^-1/2 K M^-1/2, all is solved by one kind of system,

     [ M^-1/2 K M^-1/2/unit + shift, A^T; A, -give ]    or   1 in the place of K,

   give: 0, and 1e-8 where joints repeat each other, iterated away, so that their forces are those of least norm. */
typedef struct fw_statics_sparse {
    fw_maths_sparse *system;
    fw_statics_entries stiffness, damping, joints; /* K, C in u; A */
    double unit, give, shift;
    int zero; /* of the system factored last: motions within round-off of no stiffness */
    double *x, *y, *work;   /* (n + rows), twice as many */
    int repeats, repeat[8]; /* rows of A that others say, the first of them */
    double *unbalanced;     /* (n) M^-1/2 (Q - G^T lambda) */
    double *round_off;      /* (n) of that */
} fw_statics_sparse;

typedef struct fw_statics_reduced {
    int n, rows, rank, dof;        /* n = 3 nbody; dof = n - rank */
    int modes;                     /* that `shape` and `value` have: dof, or the lowest */
    fw_statics_sparse *sparse;     /* NULL: dense */
    double largest, kept, dropped; /* singular values of balanced G M^-1/2: the largest, the
                                      smallest that counts, the largest that does not (0: none) */
    double *shape; /* (dof x n) modes: shape M shape^T = 1, shape K shape^T = value */
    double *value; /* (dof) ascending, 1/time^2 */
    double *zero;  /* (dof) |value| up to this is no more than round-off */
    double *root;  /* (n) M^-1/2 */
    double *left;  /* (rows x min(rows, n)) column-major, singular vectors */
    double *right; /* (n x n) row-major: right singular vectors, those of the null space last */
    double *balance, *g, *a, *sigma, *small, *work;
    fw_maths_lapack_space svd, eigen;
    const fw_cancel *cancel; /* a spectrum of a thousand unknowns takes half a minute */
} fw_statics_reduced;

/* sparse: modes are found by fw_statics_sparse_lowest alone, and there is no spectrum */
fw_status fw_statics_reduced_new(fw_arena *arena, const fw_multibody_model *m, bool sparse,
                                 fw_statics_reduced *r);
/* null space of G; FW_SOLVER: not finite */
fw_status fw_statics_reduced_null(const fw_multibody_model *m, const fw_multibody_pose *pose,
                                  fw_statics_reduced *r);
/* modes of K (n x n) in it, after fw_statics_reduced_null; FW_CANCELLED between two of its rows */
fw_status fw_statics_reduced_spectrum(fw_statics_reduced *r, const double *stiffness);
/* lambda (2 nblock) with G^T lambda as close to the force (n) as it gets in the mass metric; of all
   such, the one of least norm */
void fw_statics_reduced_multipliers(const fw_multibody_model *m, const fw_statics_reduced *r,
                                    const double *force, double *lambda);
/* sparse: what the forces (n) leave along the motions, once lambda is known; K is in `stiffness` */
void fw_statics_sparse_balance(fw_statics_reduced *r, const double *force);
/* factors with the given shift; *negative: how many stiffnesses over mass and unit lie below -shift */
fw_status fw_statics_sparse_factor(fw_statics_reduced *r, double shift, int *negative);
/* x (n) = what the system factored last makes of x, both in z, on the motions that G allows */
void fw_statics_sparse_solve(const fw_statics_reduced *r, double *x);
/* the step (n, in u) that was solved for last takes off what is not balanced: no force pushes where there is no stiffness */
bool fw_statics_sparse_answers(const fw_statics_reduced *r, const double *step);
/* the `count` lowest modes (fewer where there are not so many) to shape and value, with zero */
fw_status fw_statics_sparse_lowest(fw_arena *arena, fw_statics_reduced *r, int count);
void fw_statics_entries_clear(fw_statics_entries *e);
void fw_statics_entries_add(void *entries, int row, int column, double value);
/* d (n) of least mass norm with G d = -psi (2 nblock) */
void fw_statics_reduced_correct(const fw_multibody_model *m, const fw_statics_reduced *r,
                                const double *psi, double *d);

/* ---- statics_equilibrium.c ---- */

/* Dense matrices of 3 nbody unknowns: more would take minutes, and are sparse. Those give the lowest modes alone:
   so many of an equilibrium, and of small motions. An equilibrium that no path leads to is sparse beyond QUICK: the same in
   a hundredth of the time. */
enum {
    FW_STATICS_DENSE = 1200,
    FW_STATICS_QUICK = 300,
    FW_STATICS_LOWEST = 6,
    FW_STATICS_LOWEST_MODES = 24
};

/* what goes with the load factor: everything that a scene puts on; that without the voltages of
   comb drives, which are 0; these voltages squared alone, with all the rest in full */
typedef enum fw_statics_lead { FW_LEAD_ALL, FW_LEAD_LOADS, FW_LEAD_DRIVES } fw_statics_lead;

typedef struct fw_statics_equilibrium {
    fw_arena *arena;
    const fw_mechanism *mechanism;
    const fw_device_scene *scene;
    fw_diags *diags;
    fw_effect_ledger ledger;
    /* what was compiled, for the mechanism `plain`, before anything was done to it; NULL: not by
       fw_statics_equilibrium_new */
    const fw_effects_loads *loads;
    const fw_mechanism *plain;
    /* of a scene without time: the loads at its end, strains not yet applied, and the mechanism without them */
    const fw_effects_loads *frozen;
    const fw_mechanism *drawn;
    bool
        beams_next; /* where a closed form does not hold at first, exact beams are tried before its strains grow */
    const fw_multibody_model *model;
    fw_multibody_system *system;
    fw_statics_reduced reduced;
    bool sparse;   /* no dense matrices: `stiffness` is NULL, and modes are the lowest */
    double *q0;    /* (3 nbody) assembled, SI */
    double *y;     /* (ny) state; u first, all else 0 */
    double factor; /* s */
    fw_statics_lead lead;
    double drive_unit; /* squared voltages of comb drives per s */
    double reach;      /* of paths: the displacement, scaled, that counts like s = 1 */
    const struct fw_statics_pull_in *pull_in; /* NULL: none, or not looked for */
    bool other_side;     /* unstable equilibria are left to the side that is not taken otherwise */
    int sides;           /* unstable equilibria that the way here left to one of their sides */
    bool until_unstable; /* paths end where the first eigenvalue passes zero */
    double hardly_stiff; /* of paths: below this an eigenvalue is near zero, scaled */
    double *force;       /* (n) Q */
    double *slope;       /* (n) dQ/ds */
    double *follow;      /* (n) du/ds of least mass norm that the drivers force; 0 without them */
    double *stiffness;   /* (n x n) */
    double *lambda;      /* (2 nblock) */
    double *gradient;    /* (dof) force along each mode */
    double *push;        /* (dof) along each mode: its derivative by s, drivers included */
    double *noise;       /* (dof) round-off of the gradient */
    /* what goes with s */
    double *gravity, *load_acceleration; /* (n + 3) accelerations */
    fw_multibody_load *load;             /* (nload) as at s = 1 */
    double *start, *way; /* (nblock) driver values at s = 0 and from there to s = 1 */
    double *psi, *trial, *step;
    bool moving; /* some driver moves */
    int iterations;
    const fw_effects_force_element *invalid; /* its formula does not hold at the pose closed last */
    const char *why;
    double *away, *pull; /* (ny) (n) work of the potential of driven elements */
    /* in time: laws are taken at t, scaled; `slope`, `follow` and `push` are then
       derivatives by it */
    double t;
    const fw_effects_timed_load *timed; /* (ntimed) load[first_timed + i] is what i pushes with */
    int ntimed, first_timed;
    const fw_quantity_law **law; /* (nblock) of drivers */
} fw_statics_equilibrium;

/* model of the scene's end at the assembled pose, s = 0, not evaluated; most_dense: more unknowns are sparse */
fw_status fw_statics_equilibrium_new(fw_arena *arena, const fw_mechanism *mechanism,
                                     const fw_device_scene *scene, const fw_effect_choice *effects,
                                     int most_dense, fw_diags *diags, fw_statics_equilibrium *w);
/* the same with effects that are compiled already; the ledger is then empty, and weight counts as a
   load that goes with s */
fw_status fw_statics_equilibrium_new_loads(fw_arena *arena, const fw_mechanism *mechanism,
                                           const fw_device_scene *scene,
                                           const fw_effects_loads *loads, fw_diags *diags,
                                           fw_statics_equilibrium *w);
/* statics.c, statics_modes.c: what their entries do with a new fw_statics_equilibrium */
fw_status fw_statics_equilibrium_statics(fw_statics_equilibrium *w,
                                         const fw_statics_static_options *options,
                                         const fw_statics **statics);
fw_status fw_statics_equilibrium_modes(fw_statics_equilibrium *w,
                                       const fw_statics_mode_options *options,
                                       const fw_statics_modes **modes);
/* the same scene, effects and factor with other loads (a level of hinges) */
fw_status fw_statics_equilibrium_again(const fw_statics_equilibrium *w,
                                       const fw_effects_loads *loads,
                                       fw_statics_equilibrium *other);
/* the same at the same factor, with a share of the free strains; what its model says goes to `silent` */
fw_status fw_statics_equilibrium_strained(const fw_statics_equilibrium *w, double share,
                                          fw_diags *silent, fw_statics_equilibrium *other);
void fw_statics_equilibrium_factor(fw_statics_equilibrium *w, double s);

/* Velocities (nq), SI, that all bodies take at w->y, from rest, where one driver alone begins with 1 m/s or rad/s: an impact
   by the joints of w (tangent.c). found: false where they have none */
fw_status fw_statics_taken_along(fw_statics_equilibrium *w, int driver, double *v, bool *found);
/* gravity, as w has it, by the dead forces of the acceleration a along a field (nq), SI */
void fw_statics_push(const fw_statics_equilibrium *w, double a, const double *field,
                     double *gravity);
/* of two evaluated levels at one pose (tangent.c): out->apart and out->softer */
fw_status fw_statics_tangents_apart(const fw_statics_equilibrium *low,
                                    const fw_statics_equilibrium *high,
                                    fw_statics_level_small *out);
/* rad/s: nothing rings along flexures below it */
double fw_statics_slowest_along(const fw_mechanism *m);
/* kg or kg m^2 of a coordinate */
double fw_statics_mass_of(const fw_mechanism *m, int coordinate);
/* a model of the scene whose loads and drivers follow their laws, and these at one time;
   piece_s: a time in the smooth piece that is meant. arena, mechanism, scene and diags are set */
fw_status fw_statics_equilibrium_in_time(fw_statics_equilibrium *w, const fw_effects_loads *loads);
void fw_statics_equilibrium_at(fw_statics_equilibrium *w, double t_s, double piece_s);
/* du/dt (n) along the equilibria, at an evaluated one, per scaled time */
void fw_statics_equilibrium_rate(const fw_statics_equilibrium *w, double *rate);
/* u onto the constraints at the present s, the switches set; the pose there. NULL: it does not
   close, or an element does not hold */
const fw_multibody_pose *fw_statics_equilibrium_close(fw_statics_equilibrium *w, double *u);
/* potential energy at a closed u, that of driven elements counted from w->y; *size: sum of its
   terms' sizes */
double fw_statics_equilibrium_energy(fw_statics_equilibrium *w, const double *u, double *size);
/* tangent.c: the part of driven elements; leaves the switches of u */
double fw_statics_equilibrium_driven(fw_statics_equilibrium *w, const double *u, double *size);
/* everything at w->y, closed first: force, lambda, stiffness, modes, gradient, push. FW_SOLVER: the
   joints cannot close, or something is not finite */
fw_status fw_statics_equilibrium_evaluate(fw_statics_equilibrium *w);
/* sparse: the `count` lowest modes of an evaluated state, with gradient and noise. Dense: all are there */
fw_status fw_statics_equilibrium_lowest(fw_statics_equilibrium *w, int count);
/* reduced.c: u onto the joints of a large mechanism, likewise */
bool fw_statics_sparse_close(fw_statics_equilibrium *w, double *u);
/* settle.c: Newton step along the modes at an evaluated state: step (n), largest component
   returned */
double fw_statics_equilibrium_newton(fw_statics_equilibrium *w, double *step);
/* the forces along all modes are round-off: what a soft mode does then means nothing */
bool fw_statics_equilibrium_quiet(const fw_statics_equilibrium *w);
/* from w->y to a stable equilibrium at the present s. FW_SOLVER without a message: there is none */
fw_status fw_statics_equilibrium_descend(fw_statics_equilibrium *w, bool *left_unstable);
/* from the assembled pose, likewise, at s; along the free strains where flexures could not bear them before anything moves */
fw_status fw_statics_equilibrium_begin(fw_statics_equilibrium *w, double s, bool *left_unstable);
/* the message that there is none, from where the descent ended */
fw_status fw_statics_equilibrium_nowhere(const fw_statics_equilibrium *w);
/* settle.c: from the assembled pose to the stable equilibrium at s = 1; says when there is none, or
   that the drivers cannot be followed */
fw_status fw_statics_equilibrium_settle(fw_statics_equilibrium *w, bool *left_unstable);
/* statics.c: the same along the load path where it is asked for (path is not NULL) or surfaces may meet; straight down where
   the path ends before s = 1, with FW-D112 */
fw_status fw_statics_equilibrium_reach(fw_statics_equilibrium *w, int most_points,
                                       bool *left_unstable, fw_statics_path **path);
/* statics_path.c: from the equilibrium at s = 0; ends there where the path ends */
fw_status fw_statics_equilibrium_follow(fw_statics_equilibrium *w, int most_points,
                                        fw_statics_path **path);

/* SI: pose and joint angles; forces of pins (2 npin), joints (3 njoint) and drivers of an evaluated
   state, as in fw_dynamics_motion */
void fw_statics_equilibrium_pose(const fw_statics_equilibrium *w, const double *u, double *q,
                                 double *angle);
void fw_statics_equilibrium_reactions(const fw_statics_equilibrium *w, double *reaction,
                                      double *joint, double *driver);
fw_status fw_statics_equilibrium_rank(const fw_statics_equilibrium *w, fw_statics_row_rank *rank);
/* names of the bodies that take part in a motion (n), the one that moves most first */
fw_status fw_statics_equilibrium_bodies(const fw_statics_equilibrium *w, const double *shape,
                                        const char **names);
double fw_statics_equilibrium_part(const double *shape,
                                   int body); /* how far it moves, scaled, or turns */
int fw_statics_equilibrium_mover(const fw_statics_equilibrium *w, const double *shape);
/* 1/s^2 per scaled eigenvalue */
double fw_statics_equilibrium_per_s2(const fw_statics_equilibrium *w);
const char *fw_statics_equilibrium_scene_name(const fw_statics_equilibrium *w);

/* stability.c: (nhinge) of a small motion (SI) about the pose q */
fw_status fw_statics_hinge_energies(const fw_statics_equilibrium *w, const double *q,
                                    const double *shape, double **energy);

/* ---- statics_friction.c ---- */

/* of an evaluated equilibrium, which it is again afterwards; NULL: nothing rubs */
fw_status fw_statics_equilibrium_friction(fw_statics_equilibrium *w,
                                          const fw_statics_friction_range **range);

/* gradients (count x n) of the angles and travels that rub, at w->y */
fw_status fw_statics_equilibrium_rubbing(const fw_statics_equilibrium *w, int *count, double **row);
/* statics.c: stuck_Hz of all modes of an evaluated state */
fw_status fw_statics_equilibrium_stick(fw_statics_equilibrium *w, fw_statics_modes *out);

/* ---- tangent.c ---- */

/* Exact derivatives of the equations of motion, dense, in scaled units. Private to statics/. */

/* the same, to wherever entries go; damping may be NULL */
void fw_statics_tangent_to(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                           const double *v, const double *lambda,
                           const fw_effects_matrix *stiffness, const fw_effects_matrix *damping);
/* pairs of bodies that something acts between (2 of each; NULL: not asked for); how many */
int fw_statics_tangent_pairs(const fw_multibody_model *m, int *pair);
/* At a pose, with velocities v and multipliers lambda (2 nblock, the model's order):
     stiffness (nq x nq) = d(G^T lambda)/du - dQ/du,   damping (nq x nq, may be NULL) = -dQ/dv. */
void fw_statics_tangent(const fw_multibody_system *sys, const fw_multibody_pose *pose,
                        const double *v, const double *lambda, double *stiffness, double *damping);

/* ---- quasi_static_step.c: a sequence of equilibria while it is followed ---- */

typedef struct fw_statics_node { /* an equilibrium: pose and du/dt, scaled */
    double t, *u, *v;            /* (n) */
} fw_statics_node;

/* largest size of something seen at instants, peaks between them by parabolas */
typedef struct fw_statics_track {
    double t[2], s[2]; /* the last two */
    int samples;
    double most, value, at, between; /* size, with its sign, time, what the parabola adds */
} fw_statics_track;

typedef struct fw_statics_quasi_static {
    fw_statics_equilibrium w;
    const fw_dynamics_motion_options *options;
    fw_dynamics_motion *motion;
    double duration, piece_s; /* scaled; s */
    double *end;              /* (npiece) scaled */
    int npiece;
    fw_statics_node from, middle, to; /* the step */
    double *rate, *guess, *accel;     /* (n) work */
    double *angle0;                   /* (npin) at the assembled pose */
    double tolerance;        /* of the cubic through the step's ends, relative to the size */
    double size, worst;      /* largest |u| so far; largest miss of a cubic */
    double kinetic, elastic; /* largest, scaled */
    long solved, evaluated, rejected;
    int row;                       /* next sample */
    bool first;                    /* no step of this smooth piece yet */
    fw_quantity_law_strides *look; /* (nlook) of expressions */
    int *look_row, nlook;
    double law_step_s;                                     /* the laws' own longest step */
    double *q, *angle, *reaction, *joint, *driver, *speed; /* SI, of one instant */
    double *piece_q;         /* (FW_PIECE_NODES x 3 nbody) of one step */
    fw_statics_track *track; /* (channels) or NULL */
    const char *why;         /* it cannot go on */
} fw_statics_quasi_static;

/* by how much the cubic through the step's ends misses its middle */
double fw_statics_quasi_static_miss(const fw_statics_quasi_static *r);
/* where a piece begins: loads may have jumped, so that the nearest minimum is looked for. It goes
   to `from` */
fw_status fw_statics_quasi_static_land(fw_statics_quasi_static *r, double t);
/* from `from` to t; middle and end go to `middle` and `to` */
fw_status fw_statics_quasi_static_step(fw_statics_quasi_static *r, double t);

/* results */
fw_status fw_statics_quasi_static_arrays(fw_statics_quasi_static *r);
/* at the start of a smooth piece and after every step: peaks, samples, instants */
fw_status fw_statics_quasi_static_begin(fw_statics_quasi_static *r);
fw_status fw_statics_quasi_static_record(fw_statics_quasi_static *r);
void fw_statics_quasi_static_finish(fw_statics_quasi_static *r);

/* statics_equilibrium.c: of a frequency, by the error of its stiffness */
double fw_statics_root_error(double error);
/* statics.c: mode->raised of each, and a warning (FW-D754) where that is more than a frequency is off by; diags NULL: none */
fw_status fw_statics_films_raise(fw_arena *arena, const fw_mechanism *mechanism,
                                 const fw_device_scene *scene, fw_diags *diags,
                                 fw_statics_modes *modes);

#endif
