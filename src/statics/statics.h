/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Equilibria of a mechanism under the loads of a scene, the path that leads there, and small motions
   about a pose.

   Loads and drivers are taken as they are at the scene's end. The load factor s multiplies forces
   and torques of the scene, the actuation of force elements and the way of the drivers; springs,
   stops, cables and gravity act fully at every s. At s = 0 the mechanism is at rest, at s = 1 it
   carries the scene. Theory: docs/theory/statics-and-modes.md. */
#ifndef FW_STATICS_STATICS_H
#define FW_STATICS_STATICS_H
#include "base/json.h"
#include "dynamics/dynamics.h"
#include "multibody/model.h"

typedef struct fw_statics_static_options {
    fw_effect_choice effects; /* "auto" is taken as "all": nothing is left out */
    bool path;                /* follow the load path from s = 0 */
    double accuracy;          /* of the hinges' level, where auto chooses it; 0: 1e-3 */
    int most_points;          /* of the path; 0: 2000 */
} fw_statics_static_options;

typedef struct fw_statics_row_rank { /* what was found out about the constraint rows */
    int rows, rank;
    double kept, dropped; /* smallest singular value that counts, largest that does not, relative to
                             the largest; dropped 0: none */
    const char *joints;   /* joints that repeat what others say, comma separated, or NULL */
} fw_statics_row_rank;

typedef struct fw_statics_active { /* a stop, a cable, or a switch of a force element */
    const char *id;                /* of the joint, the spring or the element */
    double side;        /* of a stop: +1 at its largest angle, -1 at its smallest; 0: others */
    bool on;            /* touches, is taut, acts */
    const char *effect; /* id of the effect of an element; NULL: a stop or a cable */
} fw_statics_active;

typedef enum fw_statics_path_mark {
    FW_PATH_POINT,
    FW_PATH_FOLD,        /* limit point: the load factor turns back */
    FW_PATH_BIFURCATION, /* another branch crosses */
    FW_PATH_SWITCH,      /* a stop or cable takes hold or lets go */
    FW_PATH_END          /* s = 1 */
} fw_statics_path_mark;

typedef struct fw_statics_path { /* equilibria one after the other */
    int count, nbody, npin, njoint, ndriver;
    double *factor;             /* (count) s */
    double *q;                  /* (count x 3 nbody) m, rad */
    double *angle_rad;          /* (count x npin) as in fw_dynamics_motion */
    double *reaction_N;         /* (count x 2 npin) */
    double *joint_N;            /* (count x 3 njoint) */
    double *driver_N;           /* (count x ndriver) */
    double *lowest_per_s2;      /* (count) smallest eigenvalue of the reduced tangent stiffness */
    int *negative;              /* (count) how many are below 0; 0: stable */
    fw_statics_path_mark *mark; /* (count) */
    int *which;                 /* (count) of FW_PATH_SWITCH: index into `active`; else FW_NONE */
    /* of FW_PATH_FOLD where the load was growing: how far the mechanism snaps under a load a little
       above, as the largest way of a centre of mass and the largest rotation; NaN: nowhere, or no
       fold of this kind */
    double *snap_m, *snap_rad; /* (count) */
    bool complete;             /* reached s = 1 */
} fw_statics_path;

/* Where dry friction may hold the mechanism at rest: the equilibrium without it, from one offset to another. Extreme
   equilibria with all of the friction; of large mechanisms to first order. Theory: docs/theory/effects/friction.md. */
typedef struct fw_statics_friction_range {
    const char *why;  /* there is none: why; NULL: there is */
    bool first_order; /* else with all of the friction */
    double *q; /* (3 nbody) of the poses of mass centres, m, rad: the larger size of the two */
    double *angle_rad;                                     /* (npin) likewise */
    double *from_q, *to_q, *from_angle_rad, *to_angle_rad; /* offsets, least and largest */
    int count;
    double
        *limit; /* (count) largest torque, N m, along a slide force, N, of every joint that rubs */
    const char **joint; /* (count) its name */
    bool *slides;       /* (count) */
} fw_statics_friction_range;

typedef struct fw_statics {
    int nbody, npin, njoint, ndriver, dof;
    double *rest_q;     /* (3 nbody) assembled pose */
    double *q;          /* (3 nbody) the equilibrium at s = 1 */
    double *angle_rad;  /* (npin) phi_b - phi_a - free angle */
    double *reaction_N; /* (2 npin) force on body b, world axes */
    double *joint_N;    /* (3 njoint) force on body b, torque on it about its point b (N m) */
    double *driver_N;   /* (ndriver) N or N m along the driven coordinate */
    /* (eigenvalues) of the reduced tangent stiffness, ascending: omega^2; all dof, or the lowest of a large mechanism */
    double *eigenvalue_per_s2;
    int eigenvalues;
    int negative, neutral;     /* how many are below 0, and 0 within round-off */
    const char *loose;         /* bodies that nothing holds, or NULL */
    bool left_unstable;        /* the way there led over an unstable equilibrium */
    double residual;           /* largest force along an allowed motion over the largest force */
    int iterations;            /* Newton steps */
    fw_statics_active *active; /* (nactive) */
    int nactive;
    fw_statics_row_rank rank;
    fw_statics_path *path;                    /* NULL: not asked for */
    const struct fw_statics_pull_in *pull_in; /* below; NULL: no comb drives */
    fw_effect_ledger ledger;
    const fw_statics_friction_range *friction; /* NULL: nothing rubs */
    const fw_effects_loads *loads; /* what acted, laws and free strains not yet applied */
    const struct fw_statics_level_step *level; /* below; NULL: no hinges */
} fw_statics;

/* the stable equilibrium that descent from the assembled pose reaches at s = 1; with a path, its
   end when it reaches s = 1. FW_SOLVER with FW-D111 when there is none. */
fw_status fw_statics_solve(fw_arena *arena, const fw_mechanism *mechanism,
                           const fw_device_scene *scene, const fw_statics_static_options *options,
                           fw_diags *diags, const fw_statics **statics);

/* How far one unit of a driver, a heat, or the stress of a scene, as if they were there from the start on, hold every body
   from where it rests, way (3 nbody), zeroed by the caller. Of a driver by the straight way to its farthest value, or to
   the nearest half, quarter, ... of it at which an equilibrium is found. *known false: there is none, and way is 0 */
fw_status fw_statics_driven_way(fw_arena *arena, const fw_mechanism *mechanism, int driver,
                                double end_s, double *way, bool *known);
fw_status fw_statics_heated_way(fw_arena *arena, const fw_mechanism *mechanism,
                                const fw_device_temperature *heat, double *way, bool *known);
fw_status fw_statics_stressed_way(fw_arena *arena, const fw_mechanism *mechanism,
                                  const fw_device_scene *scene, double *way, bool *known);

/* ---- pull_in.c ---- */

/* The voltage at which comb drives lose their equilibrium. Theory:
   docs/theory/effects/comb-drive.md. */

typedef enum fw_statics_pull_in_kind {
    FW_PULL_IN_NONE, /* stable as far as the voltage could be followed */
    FW_PULL_IN_FOLD, /* the rotor goes on along the drive */
    FW_PULL_IN_SIDE, /* across it, out of the middle */
    FW_PULL_IN_TILT  /* turns out of it */
} fw_statics_pull_in_kind;
const char *fw_statics_pull_in_kind_text(fw_statics_pull_in_kind kind); /* "fold" */

typedef struct fw_statics_pull_in {
    fw_statics_pull_in_kind kind;
    bool bifurcation; /* else the equilibrium turns back there */
    const char *comb; /* the drive whose field takes most of the stiffness that is lost */
    fw_place place;   /* of it in the file */
    double voltage_V; /* of it; NONE: stable at least up to here, infinite: always */
    double largest_V; /* of it in the scene */
    double margin;    /* voltage over largest; below 1 the scene's equilibrium does not exist */
    /* s: drives that do not act together, as they are then; NaN: all at their largest. And a clause of what grows */
    double at_s;
    const char *together;
    double where[3]; /* of its rotor: along, across (m), tilt (rad) */
    /* of its pull, relative, that is left out at most (fw_effects_comb_fringe): all of the fringe fields, or where these
       are counted what stands near or below may change of them */
    double fringe;
    bool fringe_counted;
    const char
        *beyond; /* why the formulas of one drive do not hold for what is drawn; NULL: they do */
    const char *beyond_id;
    /* of what the field takes in that motion, relative, by which flexures may be less stiff than computed, or more; in a
       verdict with what bodies that give may take; NONE: 0 */
    double stiffness_error;
    /* V of the comb whose own fingers bend most easily: below that they surely do not snap by themselves; infinite
       without combs. And (voltage of the scene over it)^2, the largest of any comb */
    double fingers_V, fingers;
    const char *body;  /* moves most in the motion that becomes free; NULL: NONE */
    double *q, *shape; /* (3 nbody) pose in SI; motion, its largest part 1; NULL: NONE */
    const char *why;   /* NONE: what ended it */
} fw_statics_pull_in;

/* margin below which it may not hold: fringe fields, which are left out, raise the force by up to `fringe`, and it goes
   with V^2; the stiffness may be less by its error, which V^2 is in proportion to; fingers that bend add to what gives,
   so that 1/V^2 adds up: sqrt((1 + fringe)/(1 - stiffness_error)/(1 - (1 + fringe) fingers)) */
double fw_statics_pull_in_margin(const fw_statics_pull_in *p);
/* the voltage up to which it surely holds, by the same; of NONE, too */
double fw_statics_pull_in_least_V(const fw_statics_pull_in *p);
/* what adds up to `fringe`, for a sentence: "fringe fields that the model leaves out", or what changes those in it */
const char *fw_statics_pull_in_fringe_text(const fw_statics_pull_in *p);
/* the fingers of a comb may snap by themselves */
bool fw_statics_pull_in_fingers_snap(const fw_statics_pull_in *p);
/* what electrodes that touched have to do with the static pull-in voltage, a sentence; NULL:
   memory */
const char *fw_statics_pull_in_explain(fw_arena *arena, const fw_statics_pull_in *p);

enum { FW_PULL_IN_MOST = 150 }; /* unknowns: some hundred dense evaluations of 30 n^3 */

/* All combs at their largest voltages of the scene times sqrt(s), other loads and drivers in full
   as they are at its end, from s = 0 to the first loss of stability. Where their laws do not keep one ratio, at every ratio that
   they come to, as all is then: that which leaves least. *found is NULL for a scene
   without comb drives. Warns with FW-D248 when the scene's voltage is beyond, or within what fringe
   fields and the flexures' errors may take from it, with FW-D249 when it could not be followed up
   to the scene's voltage. FW_OK then too; FW_NOMEM, FW_CANCELLED. */
fw_status fw_statics_pull_in_find(fw_arena *arena, const fw_mechanism *mechanism,
                                  const fw_device_scene *scene, const fw_effect_choice *effects,
                                  fw_diags *diags, const fw_statics_pull_in **found);

/* ---- small motions about a pose ---- */

/* Small motions about a pose: M u'' + C u' + K u = 0 on the motions that the joints allow, with the
   exact tangent K (geometric stiffness and joint forces included). Theory:
   docs/theory/statics-and-modes.md. */

typedef struct fw_statics_mode_options {
    fw_effect_choice effects; /* "auto" is taken as "all": nothing is left out */
    bool at_equilibrium;      /* about the equilibrium under the scene's loads; else about rest:
                                 the assembled pose, drivers at their start, without the loads */
    double accuracy;          /* of the hinges' level, where auto chooses it; 0: 1e-3 */
    int drawn;                /* for so many modes frames are made */
    bool other_side; /* unstable equilibria on the way are left to the other side than without */
} fw_statics_mode_options;

typedef enum fw_statics_mode_kind {
    FW_MODE_OSCILLATION,
    FW_MODE_OVERDAMPED, /* two real decaying eigenvalues */
    FW_MODE_FREE,       /* no stiffness: a rigid motion that nothing holds */
    FW_MODE_UNSTABLE    /* grows */
} fw_statics_mode_kind;
const char *fw_statics_mode_kind_text(fw_statics_mode_kind kind);

enum { FW_MODE_FRAMES = 25 }; /* one period, first and last the same */

typedef struct fw_statics_mode {
    fw_statics_mode_kind kind;
    double omega_rad_per_s, f_Hz; /* undamped; 0 where there is none */
    /* with all joints and cables that rub stuck, and with cables that slip, at least (of joints f_Hz): between the two for any
       that do. Infinite: nothing is left to move; NaN: nothing rubs, or only the lowest modes are known */
    double stuck_Hz, slid_Hz;
    double stiffness_per_s2;       /* omega^2, below 0 when unstable */
    double eigenvalue_per_s[2][2]; /* damped, re and im: a conjugate pair (im > 0 first), or two
                                      real ones, the larger first */
    double damping_ratio;          /* -re / |eigenvalue|; NaN for free and unstable motions */
    double modal_mass_kg_m2;       /* of the undamped shape as normalised below */
    /* relative: what flexures may be off, by their part of it; what the next model of the hinges
       changes of the frequency, NaN: not known */
    double stiffness_error, model_error;
    double
        raised; /* 1 or more: its frequency with the springs of squeezed films over that without, at most */
    double *shape;    /* (3 nbody) undamped, m and rad per unit; the largest of
                                      |rotation| and |displacement| / unit_length_m is 1 */
    double *damped;   /* (6 nbody) shape of eigenvalue_per_s[0]: real, then imaginary
                                      parts, normalised likewise and with the largest entry real */
    const char *body; /* moves most; `bodies`: all that take part */
    const char *bodies;
    double *frame; /* (FW_MODE_FRAMES x 3 nbody) m, rad: one period at a visible amplitude, joints
                      closed; NULL beyond `drawn` */
} fw_statics_mode;

typedef struct fw_statics_modes {
    int nbody, npin, count,
        dof; /* count: modes; of a large mechanism fewer than degrees of freedom */
    bool at_equilibrium;
    /* Unstable equilibria that the way there left to one of their sides. Nothing that is described decides to which a
       symmetric device goes: what stands on the other (options) may be as well */
    int sides;
    double *q;             /* (3 nbody) the pose */
    double unit_length_m;  /* of the shapes */
    fw_statics_mode *mode; /* (count) by stiffness: unstable, free, then slow to fast */
    double out_of_rest;    /* what a Newton step to equilibrium would move at most, rad or unit
                             lengths; 0 within round-off at an equilibrium, infinite: there is
                             none */
    /* Relative, of the lowest frequencies: what the next model of the hinges changes, and half of the
       error of a flexure's stiffness against solids, since a frequency goes with the root of it (all of
       the frequency where loads leave less of the stiffness than may be wrong of it): the larger of the first oscillation's and of any K that is not stated. Faster ones have their own.
       Masses are taken as exact. NaN: not known, infinite never; 0: no flexures */
    double frequency_error, stiffness_error;
    /* (count x count) what the next model of the hinges makes of compliances, as fw_statics_level_small has it; NULL: not known */
    const double *softer;
    /* (count x count) compliances, 1/s^-2 along shapes over the root of their modal mass, where all that rubs is stuck, and where
       it slips; NULL: nothing rubs, or nothing holds it */
    const double *held, *slides;
    fw_statics_row_rank rank;
    fw_effect_ledger ledger;
} fw_statics_modes;

/* of one frequency, as frequency_error */
double fw_statics_mode_error(const fw_statics_mode *mode);
/* what the flexures' errors against solids may take from the stiffness `whole` of a small motion (3 nbody) about the pose
   q, relative; pins: flexures neither give nor drift there; whole NaN: of what flexures alone have of it; energy (nhinge): of
   fw_statics_hinge_energies, or NULL */
double fw_statics_shape_error(const fw_mechanism *mechanism, const double *q, const double *shape,
                              bool pins, double whole, const double *energy);
/* FW_SOLVER: no equilibrium (FW-D111), or the eigenvalues were not found */
fw_status fw_statics_small_motions(fw_arena *arena, const fw_mechanism *mechanism,
                                   const fw_device_scene *scene,
                                   const fw_statics_mode_options *options, fw_diags *diags,
                                   const fw_statics_modes **modes);

/* ---- tethers.c ---- */

/* How a tether is broken: the probe's force and way, and what hinges bear meanwhile. Linear statics of
   rigid bodies on flexures, and beams of stepped width. Theory: docs/theory/release.md. */

typedef struct fw_statics_tether_break {
    double stress_per_N;           /* largest in the tether, Pa/N of the probe */
    bool at_neck;                  /* there; else elsewhere in the finger */
    double force_N, low_N, high_N; /* at the strength, and at either end of its band */
    double move_m;                 /* of the probe, at the strength */
    double hinge_share; /* largest stress of a hinge over the tether's: 1: they break together */
    double hinge_used,
        hinge_most; /* of that hinge's limit, safety factor included: at the strength and at
                                       the upper end of its band */
    int hinge;      /* of the mechanism */
} fw_statics_tether_break;

typedef struct fw_statics_tether {
    const fw_layout_tether *drawn;
    double probe_m; /* from the cut, along the finger: where the probe pushes */
    fw_statics_tether_break first, last; /* all others hold; it is the only one */
    /* how far the body goes towards the finger once it is broken, at most; 0: it does not */
    double toward_m;
    const char *scene; /* in this one */
} fw_statics_tether;

typedef struct fw_statics_tethers {
    const char *why; /* nothing is computed; NULL: it is */
    fw_statics_tether *item;
    int n;
    int keep; /* the one to break last: of all alone it asks least of the hinges */
    bool brittle;
    const char *criterion;
    double strength_Pa, low_Pa, high_Pa;
} fw_statics_tethers;

/* NULL: there are no tethers */
fw_status fw_statics_tethers_find(fw_arena *arena, const fw_mechanism *mechanism,
                                  const fw_statics_tethers **out);
/* poses of a motion of these bodies, (nrow x 3 nbody) of centres of mass */
void fw_statics_tethers_watch(const fw_statics_tethers *tethers, const fw_mechanism *mechanism,
                              const char *scene, const double *q, int nrow);
/* a member "tethers" of an open object; nothing where there are none */
void fw_statics_tethers_json(fw_json *json, const fw_mechanism *mechanism,
                             const fw_statics_tethers *tethers);
/* sentences for a run sheet: what to do and what it asks; NULL: there are none */
fw_status fw_statics_tethers_words(fw_arena *arena, const fw_mechanism *mechanism,
                                   const fw_statics_tethers *tethers, const char **out);

/* ---- the level of hinges: statics_level.c ---- */

/* What the next level of hinges changes, computed at one instant: pins against closed forms that
   give, these against exact beams. Theory: docs/theory/hinge-models.md. */

typedef struct fw_statics_level_state {
    double *q;          /* (3 nbody) m, rad */
    double *angle_rad;  /* (npin) */
    double *reaction_N; /* (2 npin) on body b, world axes */
    /* (nhinge) peak of each hinge; NaN until fw_verdict_level_strains (verdict.h) */
    double *strain;
} fw_statics_level_state;

typedef struct fw_statics_level_step {
    fw_effects_hinge_model used, next; /* the same: there is no next level */
    double t_s;                        /* of the instant; NaN: an equilibrium */
    int nbody, npin;
    fw_statics_level_state at,
        up;              /* at the level used and at the next; not filled where `why_not` */
    double angle_rad;    /* largest difference of a hinge's angle */
    double relative;     /* that over the largest hinge angle at the instant; NaN: not computed */
    double strains;      /* of the largest strain what the next level changes; 0: nobody asked */
    double blows;        /* share of the limit that contacts may have left ringing along flexures */
    const char *why_not; /* NULL: computed */
    bool unknown;        /* not computed, and nothing else bounds what the level used is off by */
} fw_statics_level_step;

/* Of a motion at the row of `sample` nearest the largest peak of a hinge: both levels under the
   loads of that time and the same inertia forces. `relative` is the largest of that and, where exact beams are next, of a
   quarter and half of the way, 1 where they have an equilibrium at neither. */
fw_status fw_statics_level_of_motion(fw_arena *arena, const fw_mechanism *mechanism,
                                     const fw_device_scene *scene, const fw_dynamics_motion *motion,
                                     const fw_statics_level_step **step);

/* of a motion of pins: strain that forces of joints which come at once set ringing along what flexures give, over the
   largest that their turns strain them by; 0 where there are no such forces */
fw_status fw_statics_level_rings(fw_arena *arena, const fw_mechanism *mechanism,
                                 const fw_device_scene *scene, const fw_dynamics_motion *motion,
                                 double *share);

struct fw_statics_equilibrium;
/* of an equilibrium that was solved for at s = 1 with these effects */
fw_status fw_statics_level_of_equilibrium(struct fw_statics_equilibrium *w,
                                          const fw_statics_level_step **step);
/* What the next level's tangent at the pose of modes changes. Where that is the beam itself, `apart` is of all that the
   tangent says, which closed forms leave something out of where a flexure is not its own mirror image */
typedef struct fw_statics_level_small {
    double relative;    /* largest change of a frequency among those of pins; NaN: not computed */
    const double *each; /* (dof) of every mode, NaN where the two do not compare; or NULL */
    double
        apart; /* of any squared frequency, and of the stiffness of any point in any direction, at most; 0: not known */
    double *
        softer; /* (dof x dof) d K'^-1 d is g . softer g with g_i = d . u_i / sqrt(u_i K u_i), u_i the modes; or NULL */
} fw_statics_level_small;
fw_status fw_statics_level_of_modes(struct fw_statics_equilibrium *w, fw_statics_level_small *out);

/* Where every flexure's stiffness is stated and its axis known, auto tries pins before anything
   else: the statement is of the rotation, the pin is its model, and it costs a tenth. They stay
   where the step to hinges that give changes less than `fw_statics_level_stated` times the accuracy
   (3 % at the default accuracy: what stiffnesses are known to), and where less than that of their strain rings along
   what they give. Not where something acts on
   hinges that give in another way, or draws them across their strip, and not where pins hold a body
   that flexures let move, or a flexure is far from its own mirror image. */
fw_status fw_statics_level_pins_first(fw_arena *arena, const fw_mechanism *mechanism,
                                      const fw_device_scene *scene, const fw_effect_choice *asked,
                                      bool *first);
static const double fw_statics_level_stated = 30;
/* c_xy/sqrt(c_xx c_yy) of a flexure from which on neither pins nor closed forms are taken to rest where the beam does */
static const double fw_statics_coupled = 0.05;
/* what rings may be: pins in a motion are taken to be off by 2.9 %, whatever the step says (verdict_strain.c) */
static const double fw_statics_level_rings_most = 0.029;
/* Exact beams change more than a first step bounds: what they do may be another motion, that has not snapped where this one
   did. step may be NULL. Test: judge.examples bistable-* */
static const double fw_statics_level_bounds = 0.25;
bool fw_statics_level_far_apart(const fw_statics_level_step *step);
/* exact beams may rest, or move, elsewhere than closed forms; true: *choice asks for them, from the start */
bool fw_statics_level_elsewhere(const fw_mechanism *m, const fw_statics_level_step *step,
                                const fw_effect_choice *asked, fw_effect_choice *choice);
/* of the largest strain what it changes, once strains are there: infinite where one is not known, NaN where one was not computed.
   largest: of the level used */
double fw_statics_level_strains(const fw_statics_level_step *step, int nhinge, double *largest);
/* what it changes of places and angles, or of the largest strain where that is more */
double fw_statics_level_changes(const fw_statics_level_step *step);
/* it was computed, and changes less; step may be NULL */
bool fw_statics_level_is_below(const fw_statics_level_step *step, double accuracy);

/* true: auto was asked for and this step is not below the accuracy; *choice then asks for the next
   level. step may be NULL */
bool fw_statics_level_climb(const fw_statics_level_step *step, double accuracy,
                            const fw_effect_choice *asked, fw_effect_choice *choice);
/* may_go_on: auto was asked for, and exact beams were not tried yet; true besides: a flexure came to where its closed form does not hold (`said`), which an
   exact beam may know; *choice then asks for these. Test: tests/cli/test_hinge.py, judge.examples */
bool fw_statics_level_may_go_on(const fw_effect_choice *asked, const fw_effect_choice *choice);
bool fw_statics_level_goes_on(const fw_effect_choice *asked, const fw_diags *said,
                              fw_effect_choice *choice);
/* its number as the error of the level used, where it was computed, and where auto chose what that
   means for the choice */
fw_status fw_statics_level_note(fw_arena *arena, const fw_statics_level_step *step, double accuracy,
                                const fw_effect_choice *asked, fw_effects_hinge_use *use);

/* the next level was wanted and not taken, `why_not`: what that means for the choice */
fw_status fw_statics_level_stays(fw_arena *arena, const fw_statics_level_step *step,
                                 const char *why_not, fw_effects_hinge_use *use);

/* ---- motions: quasi_static.c ---- */

/* The motion of a scene, with inertia or as a sequence of equilibria, whichever its effects ask
   for. Theory: docs/theory/effects/inertia.md. */

/* Compiles the effects. Where inertia is left out (loads->quasi_static) the motion is the sequence
   of stable equilibria under the loads and drivers of each time, in the form of
   fw_dynamics_simulate: v is du/dt of that row, accel its derivative; peaks lie on equilibria
   solved for at their times; stats.steps: equilibria, stats.rhs: evaluations of forces and tangent.
   Starting velocities and damping have no part in it. Where the row ends, as at a fold, and where
   inertia acts, it is fw_dynamics_simulate's; the ledger says so. A method, integrator or tolerance
   that was asked for by name needs inertia too, unless effects were chosen by hand. */
fw_status fw_statics_move_scene(fw_arena *arena, const fw_mechanism *mechanism,
                                const fw_device_scene *scene,
                                const fw_dynamics_motion_options *options, fw_diags *diags,
                                const fw_dynamics_motion **motion);
/* the options of a motion that is found once more, by the hinges and the tolerance of `like`, which is of the same scene; nobody
   glances at it. A row of equilibria that ends then, as at a fold, is none: FW_SOLVER */
void fw_statics_move_like(const fw_dynamics_motion *like, fw_dynamics_motion_options *options);
/* Likewise, with all flexures 1 + by times as stiff, and as the options' effects.along says; observe, trace and context of the
   options look on. *motion NULL: none was found */
fw_status fw_statics_move_stiffer(fw_arena *arena, const fw_mechanism *mechanism,
                                  const fw_device_scene *scene, double by,
                                  const fw_dynamics_motion *like,
                                  const fw_dynamics_motion_options *options,
                                  const fw_dynamics_motion **motion);
/* A contact, a stop or a cable took hold or let go so many times at least. What that leaves ringing along flexures is in no
   bound: pins do not stand for them there */
bool fw_statics_takes_hold(const fw_mechanism *mechanism, const fw_device_scene *scene,
                           const fw_dynamics_motion *motion, long events);

/* the row of equilibria alone. FW_SOLVER: it ends before the scene does, or there is none; *why
   says where and is good for the ledger. */
fw_status fw_statics_quasi_static_motion(fw_arena *arena, const fw_mechanism *mechanism,
                                         const fw_device_scene *scene,
                                         const fw_dynamics_motion_options *options,
                                         const fw_effect_ledger *ledger,
                                         const fw_effects_loads *loads, fw_diags *diags,
                                         const fw_dynamics_motion **motion, const char **why);

/* ---- stability.c ---- */

/* A motion that never leaves an unstable equilibrium: in exact symmetry, as of a load along an arm
   above the buckling load, nothing pushes it off, while the smallest disturbance of a real device
   does. Theory: docs/theory/statics-and-modes.md. */

typedef struct fw_statics_stability {
    double t_s;        /* where it is most unstable */
    double rate_per_s; /* sqrt(-lowest eigenvalue) there */
    double growth;     /* integral of it over the scene: a disturbance grows by e^growth */
    const char *body;  /* moves most in the motion that becomes free */
    double *angle_rad; /* (npin) of the stable equilibrium that it would fall to, under the loads of
                          t_s; NULL: none was found */
    int pin;           /* with the largest of them, or FW_NONE */
    double way_m;      /* of the centre of the body that goes furthest there, from where it stays */
    const char *goes;  /* that body, where that is more than what bodies turn; else NULL */
    double share;      /* of the loads that it would bear, by the eigenvalues with and without them;
                          0: it does not stand without them either */
    bool chance; /* it leaves, to one of two sides: which is decided by nothing that is described */
    const char *text; /* all that in a sentence */
} fw_statics_stability;

/* An unstable equilibrium that a motion left to one of its sides, decided by what is described. What would take it to the other
   one: flexures that are made bent in the shape of the mode that became free, so that the middle of one lies aside of the line
   between its ends by a micrometre, or one end of the other (Koiter) */
typedef struct fw_statics_passed {
    bool any;
    double t_s;       /* where it is most unstable */
    const char *body; /* moves most in that mode */
    double *
        way; /* (3 nbody) the mode, towards where the motion went: m, rad, the largest turn or way over length 1 */
    double *
        wrench; /* (3 nhinge) of that imperfection, against it: on body b at the pin, N m, N, N, world axes; on body a the other */
} fw_statics_passed;

enum { FW_STABILITY_MOST = 300 }; /* unknowns: two to twelve dense evaluations of 30 n^3 */

/* Looks along the motion of a scene. *stability is NULL where it is stable, where it has left, and
   where instability lasts too short to grow. Warns with FW-D259; a note says when the mechanism is
   too large to look. FW_OK then too; FW_NOMEM, FW_CANCELLED. *left: the least share of the stiffness that
   loads leave in the scene, of its softest motion, 0 where it is unstable; NaN: not known. passed->any: it left. NULL: nobody asks. */
fw_status fw_statics_stability_find(fw_arena *arena, const fw_mechanism *mechanism,
                                    const fw_device_scene *scene, const fw_dynamics_motion *motion,
                                    fw_diags *diags, const fw_statics_stability **stability,
                                    double *left, fw_statics_passed *passed);

#endif
