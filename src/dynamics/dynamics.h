/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Motion of a planar mechanism in reference-point coordinates q = (x, y, phi) of every body's
   centre of mass: M q'' + G^T lambda = Q(q, q', t),   Psi(q) = 0,   G = dPsi/dq.

   Theory: docs/theory/dynamics.md. Internally everything is scaled by the scene's own length, mass
   and time. */
#ifndef FW_DYNAMICS_DYNAMICS_H
#define FW_DYNAMICS_DYNAMICS_H
#include "multibody/model.h"
#include <stdatomic.h>

struct fw_statics_level_step;

typedef struct fw_dynamics_instant { /* the mechanism at one time, on the dense output */
    double t_s;
    const double *q;          /* (3 nbody) m, rad */
    const double *angle_rad;  /* (npin) */
    const double *reaction_N; /* (2 npin) on body b, world axes */
    bool begins; /* a smooth piece begins here: forces may have jumped since the last instant, whose
                    time may be the same */
    fw_effects_hinge_model hinge;  /* how the hinges are taken in this run */
    double piece_s;                /* a time in the smooth piece of the laws that is meant */
    const fw_effects_loads *loads; /* what acts in this run */
    /* asked for by `whole`, else NULL: (3 nbody) m/s, rad/s; (3 njoint), (ndriver) as in
       fw_dynamics_motion */
    const double *v, *joint_N, *driver_N;
    const bool *on; /* (all switches of loads->element, in their order) as they are held; NULL: as
                       their own values say */
} fw_dynamics_instant;
/* called FW_INSTANTS times in every step, in order of time, whatever the number of samples; with
   NULL when the run starts (over, with a tighter tolerance) */
typedef void (*fw_dynamics_observer)(void *context, const fw_dynamics_instant *instant);
/* Offered first where a step goes on smoothly: its thirds. True: they were taken, and are enough;
   false: all instants of the step follow. */
typedef bool (*fw_dynamics_glance)(void *context, const fw_dynamics_instant *third);
enum { FW_INSTANTS = 12, FW_THIRDS = 3 };

enum { FW_PIECE_NODES = 8 };
/* A part of the motion between two instants in which every coordinate is one polynomial in time, of
   degree nodes - 1: that through its values at equally spaced instants, ends included. Pieces follow
   each other in time; each begins where the last one ended. */
typedef struct fw_dynamics_piece {
    double from_s, to_s;
    bool jump; /* not the motion: the straight way from one equilibrium to the next one where a
                        quasi-static motion jumps, from_s == to_s */
    int nodes; /* at most FW_PIECE_NODES */
    const double *q; /* (nodes x 3 nbody) m, rad */
    /* what acts, whose free strains say how far these places are from those on the substrate; NULL: none do */
    const fw_effects_loads *loads;
    const fw_mechanism *mechanism; /* of these loads; NULL without them */
} fw_dynamics_piece;
/* places of bodies (3 nbody) on the substrate at a node of the piece; by how much bodies are longer there, relative */
double fw_dynamics_piece_node(const fw_dynamics_piece *piece, int nbody, int node, double *q);
/* with NULL when the run starts (over); of the contexts of the observer */
typedef void (*fw_dynamics_tracer)(void *context, const fw_dynamics_piece *piece);

/* Passes over scenes that come again, for a study whose devices differ in what moves nothing (tape.c): a motion is to
   the last bit what it is without. Of one thread at a time. */
typedef struct fw_dynamics_tapes fw_dynamics_tapes;
fw_status fw_dynamics_tapes_new(fw_arena *arena, fw_dynamics_tapes **tapes);
void fw_dynamics_tapes_free(fw_dynamics_tapes *tapes); /* before its arena; NULL allowed */

/* evaluations: all, and those with exact beams. Of several threads at a time */
typedef struct fw_dynamics_spent {
    atomic_llong all, beams;
} fw_dynamics_spent;
struct fw_dynamics_motion;
/* those of this motion, and of the runs that it was found by, are counted elsewhere; NULL allowed, both */
void fw_dynamics_spent_less(fw_dynamics_spent *spent, const struct fw_dynamics_motion *motion);

typedef struct fw_dynamics_motion_options {
    const char *method;     /* a name of fw_multibody_method_at; NULL: chain */
    const char *integrator; /* a name of fw_dynamics_integrator_at; NULL: auto */
    const char *stabilise;  /* "projection" (NULL), "baumgarte", "none" */
    double rtol;            /* relative tolerance of the integrator; 0: from `accuracy` */
    double accuracy;        /* relative error wanted on the peak hinge deflection; default 1e-3 */
    int samples; /* rows of `sample`, evenly over the scene, first at 0, last at the end */
    fw_effect_choice effects;
    bool reactions;  /* peaks of the joint forces and of travels too */
    bool energies;   /* energy and constraint norm of every sample too */
    double moved_m;  /* how far assembly had moved bodies already; for the statistics */
    double looser;   /* tolerance of the second run, from which errors are estimated, over that of
                        the answer; 0: as the integrator bears; 1: there is no such run, and
                        errors are infinite */
    bool alone;      /* with a stated rtol: no second run, and errors are infinite. Everything else
                        is as with one */
    bool late_rows;  /* rows of `sample` wait for fw_dynamics_motion_rows where they may */
    long most_steps; /* over all tries; FW-D108 beyond; 0: 10 million */
    double most_angle_rad; /* ends the run when a joint has turned further: the verdict needs no
                              more; 0: never */
    /* a row of equilibria that ends, as at a fold, is FW_SOLVER: inertia does not carry it on */
    bool ends_with_row;
    /* a run of more evaluations ends, too, when a hinge has turned by half beyond its limit: a verdict needs no more;
       0: never. hopeless_rad: (npin) those angles, set by statics/ */
    long hopeless_rhs;
    const double *hopeless_rad;
    double hinge_accuracy; /* by which auto chooses the model of hinges; 0: accuracy */
    long most_beams; /* auto takes exact beams only where the motion with the model before asked for
                        the forces of hinges no more often than this; 0: however often */
    /* what the step to a better model of the hinges changes of the largest strain, over it; by that, too, auto climbs. NULL: by
       places and angles alone */
    fw_status (*strains_apart)(fw_arena *arena, const struct fw_mechanism *mechanism,
                               const struct fw_effects_loads *loads,
                               const struct fw_statics_level_step *step, double *share);
    bool within_limits; /* where hinges turn beyond their elastic limit auto takes no better model
                            of them: a verdict does not need it */
    bool beams_anyway;  /* auto takes exact beams also where it is not known what they change */
    fw_dynamics_observer observe; /* NULL: nobody looks */
    fw_dynamics_glance glance;    /* of the same context; NULL: all instants are wanted */
    fw_dynamics_tracer trace;     /* NULL: nobody wants the pieces */
    bool trace_both;              /* those of the looser run, too, where that is looked at */
    bool whole; /* instants have velocities and forces of joints and drivers, too */
    void *context;
    void *other; /* of the observer, too, for the looser run that errors are estimated from; NULL:
                    it is not looked at. The motion says which of the two saw what */
    /* margin (fw_dynamics_motion_stats.estimate_margin) times what observers of the two runs saw
       differently, over what would be near enough: above 1 the tolerance is tightened, by so much.
       NULL: 0 */
    double (*unsettled)(const void *observed, const void *compared, double margin, double accuracy);
    fw_dynamics_tapes *tapes; /* where passes are looked up and kept; NULL: nowhere */
    const struct fw_dynamics_motion
        *like;                /* of a device much like this one in the same scene, which
                                              says how tight a tolerance to begin with; or NULL */
    fw_dynamics_spent *spent; /* by all runs, of motions that failed, too; NULL: nobody counts */
    /* errors are to be small enough, and nobody sees how small: no tolerance is tighter than they seem to need */
    bool sparing;
} fw_dynamics_motion_options;

/* per pin: extreme of |phi_b - phi_a - free angle| over the scene */
typedef struct fw_dynamics_peak {
    double angle_rad; /* with its sign */
    double t_s;
    double error_rad; /* estimate, >= 0: of the numbers, and what auto left out */
} fw_dynamics_peak;

/* per joint or driver: largest force and torque that it exerts */
typedef struct fw_dynamics_force_peak {
    double force_N, t_s, error_N;
    /* of prismatic joints and welds, about their point b; of drivers that turn. Else 0 */
    double torque_Nm, torque_t_s, torque_error_Nm;
} fw_dynamics_force_peak;

/* per prismatic joint: extreme of |distance along the axis - free length| */
typedef struct fw_dynamics_travel_peak {
    double travel_m; /* with its sign */
    double t_s, error_m;
} fw_dynamics_travel_peak;

/* times what is wanted that errors are where it may be vain to go on (dynamics_simulate.c) */
enum { FW_DYNAMICS_VAIN = 10 };

typedef struct fw_dynamics_motion_stats {
    long steps, rejected, rhs, projections;
    long events; /* stops and cables that took hold or let go, blows of drivers */
    long jacobians, factorisations; /* of implicit integrators */
    double cpu_s;                   /* of the integration */
    double max_constraint_norm;     /* |Psi| over the scene's length, after projection, all steps */
    double max_velocity_norm;       /* |G q'| likewise, scaled */
    double energy_error;     /* |T + V + dissipated - work| / largest energy; dimensionless. Of a
                                row of equilibria: the largest T, which is left out, / largest V */
    double rtol;             /* used */
    double largest_energy_J; /* that energy */
    double assembly_moved_m; /* largest correction of the initial position */
    double velocity_moved;   /* largest change of an initial velocity, relative */
    double estimate_margin;  /* times what two runs differ by: their error. 0: there was one run */
    double estimate_cpu_s; /* of all other runs: for the estimate, and those that were not enough */
    double looser_rtol;    /* of the run that was compared with; 0: none */
    double needed_rtol;    /* of that run, at which errors would just have been small enough; 0: it
                              is not known */
    double
        beyond; /* errors over what was wanted, where no tolerance makes them smaller; 0: they are small enough */
    int runs;                /* that were made in all; 1 for a sequence of equilibria */
    long all_steps, all_rhs; /* of them */
} fw_dynamics_motion_stats;

typedef struct fw_dynamics_motion {
    int nbody, npin, njoint, ndriver, nsample;
    double *t_s;        /* (nsample) */
    double *q;          /* (nsample x 3 nbody) x, y, phi in m and rad */
    double *v;          /* (nsample x 3 nbody) */
    double *accel;      /* (nsample x 3 nbody) */
    double *angle_rad;  /* (nsample x npin) phi_b - phi_a - free angle */
    double *reaction_N; /* (nsample x 2 npin) force of the pin on body b (ground: on the ground),
                           world axes, without the springs' torque */
    /* (nsample x 3 njoint) force on body b, torque on it about its point b (N m) */
    double *joint_N;
    double *driver_N;       /* (nsample x ndriver) N or N m along the driven coordinate */
    fw_dynamics_peak *peak; /* (npin) */
    /* largest displacement of the ends of a flexure that gives over its length, beside the angles: both
       are what deflections are */
    double displaced;
    /* energies asked for, else NULL, as of a sequence of equilibria */
    double *energy_J;        /* (nsample x 4) kinetic, potential, dissipated, work: the first three
                                less the last one stay what they are */
    double *constraint_norm; /* (nsample) |Psi| over the scene's length */
    /* when asked for, else NULL */
    fw_dynamics_force_peak *force_peak, *joint_peak, *driver_peak; /* (npin) (njoint) (ndriver) */
    fw_dynamics_travel_peak *travel_peak; /* (njoint) 0 for what is not prismatic */
    double travelled_m,
        travel_off_m; /* of two runs, of those that no driver states: the largest, and its error; else 0 */
    fw_dynamics_motion_stats stats;
    fw_effect_ledger ledger;
    bool ended;                      /* by most_angle_rad, before the scene's end */
    double end_s;                    /* the scene's duration, or where it was ended */
    const char *integrator, *method; /* used, and why: `reason` */
    const char *reason;
    double accuracy;                       /* wanted: relative error of the largest deflection */
    const char *tolerance;                 /* how the tolerance was found: a sentence */
    const char *stabilise, *method_report; /* what the method has to say, or NULL */
    void *observed, *compared; /* contexts that saw this motion, and the looser run (NULL: none did;
                                  a sequence of equilibria has no such run) */
    struct fw_dynamics_late *late; /* rows that wait (fw_dynamics_motion_rows); NULL: none does */
    const fw_effects_loads *loads; /* what acted, for those who look at it again */
    fw_dynamics_tapes *tapes;      /* that it was shown from; NULL: it was computed */
    long again;                    /* which of them */
    /* statics/statics.h; NULL: not looked for, or no hinges */
    const struct fw_statics_level_step *level;
} fw_dynamics_motion;

/* Of a motion that was shown again: the share of the stiffness that its loads leave, where it is known that nothing it
   rests on is unstable, else 0; kept for others like it, whose loads and springs are the same to the last bit. NULL: it was
   computed, or is kept no longer */
double *fw_dynamics_motion_steady(const fw_dynamics_motion *motion);

/* one scene from the assembled position, with inertia. FW_SOLVER when the steps become too
   small. */
fw_status fw_dynamics_simulate(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_device_scene *scene,
                               const fw_dynamics_motion_options *options, fw_diags *diags,
                               const fw_dynamics_motion **motion);

/* the same with effects that were compiled before (statics/statics.h decides between the two kinds of
   motion by them) */
fw_status fw_dynamics_simulate_compiled(fw_arena *arena, const fw_mechanism *mechanism,
                                        const fw_device_scene *scene,
                                        const fw_dynamics_motion_options *options,
                                        const fw_effect_ledger *ledger,
                                        const fw_effects_loads *loads, fw_diags *diags,
                                        const fw_dynamics_motion **motion);
/* Asked for with late_rows: rows that lie within steps stay as the dense output has them, without
   accelerations and forces, until they are asked for here; then they are, to the last bit, what
   they would have been at once. Only where nothing that acts depends on time or on what happened
   before. Every other motion has all its rows, and nothing happens. */
void fw_dynamics_motion_rows(const fw_dynamics_motion *motion, int first, int count);
bool fw_dynamics_motion_waits(const fw_dynamics_motion *motion, int row); /* q is none yet */
/* the same of the rows next to a time */
void fw_dynamics_motion_rows_at(const fw_dynamics_motion *motion, double t_s);
/* q (3 nbody: m, rad) of a row; of one that waits as it was integrated, which is within the tolerance of
   what it will be */
void fw_dynamics_motion_pose(const fw_dynamics_motion *motion, int row, double *q);
/* rad: the part of each peak's error_rad that effects which auto left out account for */
double fw_dynamics_motion_left_out(const fw_dynamics_motion *motion);
/* estimated relative error of the largest deflection, what was left out included; where no hinge turns of the largest travel;
   0: nothing moves */
double fw_dynamics_motion_estimated(const fw_dynamics_motion *motion);
/* and of how far anything goes, with what no motion has (effects' `beside`); lacking: with what formulas lack, too */
double fw_dynamics_motion_ways_off(const fw_dynamics_motion *motion, bool lacking);
/* m: where no hinge turns, the error of any travel. All differ by the largest that any does, since one may agree by chance where
   friction holds and lets go at other times; 0: hinges turn, or nothing was compared. Test: tests/cli/test_friction_range.py */
double fw_dynamics_motion_travel_off(const fw_dynamics_motion *motion);
/* puts it there; ends either kind of motion, once */
void fw_dynamics_motion_widen(fw_dynamics_motion *motion);
/* what both check first: numbers, names of methods, mechanism and scene */
fw_status fw_dynamics_check_request(const fw_mechanism *mechanism, const fw_device_scene *scene,
                                    const fw_dynamics_motion_options *options, fw_diags *diags);

/* the i-th one; name NULL behind the last */
fw_multibody_method_row fw_dynamics_integrator_at(size_t i);
fw_multibody_method_row fw_dynamics_stabilisation_at(size_t i);

#endif
