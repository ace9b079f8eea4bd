/* SPDX-License-Identifier: GPL-3.0-or-later */
/* How large the motion of a scene can become, and what a further force of known size can change in
   it: what the bounds of the effects are made of. Linear theory about the initial pose with the
   effects that the scene calls for, in modes; where that theory has nothing to say (free motions,
   drivers, stops, cables, large angles, redundant joints), `valid` is false and every effect stays.
   Theory: docs/theory/effects/envelope.md. */
#ifndef FW_EFFECTS_ENVELOPE_H
#define FW_EFFECTS_ENVELOPE_H
#include "effects/effect.h"
#include "effects/effects.h"

typedef struct fw_effects_envelope {
    bool valid;
    const char *why_not; /* where it is not */
    int n, modes;        /* 3 nbody; degrees of freedom */
    double *omega;       /* (modes) rad/s, ascending */
    double *shape;       /* (modes x n) mass-normalised: shape^T M shape = 1 */
    double *turn;        /* (modes x npin) rotation of every pin in the mode */
    /* upper bounds over the scene, SI */
    double *reach;  /* (n) |displacement| of every coordinate */
    double *speed;  /* (n) |velocity| */
    double *angle;  /* (npin) |rotation| */
    double *rate;   /* (npin) |angular velocity| */
    double *force;  /* (npin) N: on the joint's force */
    double *across; /* (njoint) N: of a slide on its guide, across */
    double *give;   /* (npin) m: W of b from W of a where a hinge stands for the pin, its drift not
                       counted */
    double floor;   /* rad: the largest hinge deflection of the scene is at least this */
    double most;    /* rad: and at most this */
    /* for the answers */
    int npin;
    double duration_s;
    double margin;                   /* that the bounds are widened by, for what is not linear */
    double *amplitude, *modal_speed; /* (modes) |q| and |q'| of each, without the margin */
    double *response_bound;          /* (modes) s^2: |q| under a force of size 1 of any course */
    const struct fw_effects_modal *modal;
    /* the same scene with every hinge a pin: what nonlinear-hinge is measured against. NULL: this
       is it */
    const struct fw_effects_envelope *pinned;
    bool *taken; /* (rows of the table) it is in this envelope; what is not must not change much */
    double loose_pull; /* bound of the tendons that may go slack: they are not in it, and `taken`
                          says so */
} fw_effects_envelope;

/* m or m/s: how far or fast a point of a body can get, arm in m; way: reach or speed */
static inline double fw_effects_envelope_point(const double *way, int body, double arm_m) {
    if (body == FW_GROUND) return 0;
    return hypot(way[3 * body], way[3 * body + 1]) + arm_m * way[3 * body + 2];
}

/* of the scene with everything that it calls for and that linear theory can take in; what is
   `kept` first, so that an effect's `add` sees at least that envelope */
fw_status fw_effects_envelope_find(fw_arena *arena, const fw_mechanism *mechanism,
                                   const fw_device_scene *scene, fw_effects_envelope *envelope);
/* the same for the rows (count) of the table that are handed in: envelope_find.c */
fw_status fw_effects_envelope_of_rows(fw_arena *arena, const fw_mechanism *mechanism,
                                      const fw_device_scene *scene, const fw_effect_row *const *row,
                                      size_t count, fw_effects_envelope *envelope);
/* of given loads */
fw_status fw_effects_envelope_of(fw_arena *arena, const fw_mechanism *mechanism,
                                 const fw_device_scene *scene, const fw_effects_loads *loads,
                                 fw_effects_envelope *envelope);

/* A further force on the mechanism whose every component stays below `force` (n) in size for the
   whole scene: how much any hinge can turn further, relative to `floor`. `variation`: total
   variation over time in units of that size; a constant put on at once has 1, one that changes sign
   with the motion INFINITY (resonance: it is then bounded by the scene's duration). Infinite where
   the envelope is not valid. Cost modes x n. */
double fw_effects_envelope_answer(const fw_effect_case *c, const double *force, double variation);
/* the same for modal forces (modes) that are known: shape . force of what is added */
double fw_effects_envelope_mode_answer(const fw_effect_case *c, const double *mode,
                                       double variation);
/* The same in displacement, where flexures give: hinges that stand side by side move without a turn,
   and what is deflected there is not in the angles. All of the force (n, N) through the softest
   flexure, as the angle that strains it as much, (1 + variation) 6 F/(k L) with k the least
   translational stiffness and L the length, relative to `floor`; 0 without flexures. Cost n +
   hinges. Test: test_displaced.c; tests/judge/examples (a stage between two leaves) */
double fw_effects_envelope_displaced(const fw_effect_case *c, const double *force,
                                     double variation);
/* modal forces (modes) += of the dampers in `loads` at the largest rates: where the motion is
   linear as they act between the modes, where it is not those of the pins by the fastest */
fw_status fw_effects_envelope_dampers(const fw_effect_case *c, const fw_effects_loads *loads,
                                      double *mode);
/* A relative change of the generalised stiffness, |dK| <= part K in the sense of quadratic forms:
   how much any hinge can turn further, relative to `floor`: frequencies shift and phases run apart
   over the scene. */
double fw_effects_envelope_stiffness(const fw_effect_case *c, double part);
/* that part for constant forces `force` (n) at centres of mass: what the joint forces which hold
   them take from the stiffness or add to it. A weight along a mast moves nothing and softens it */
fw_status fw_effects_envelope_softening(const fw_effect_case *c, const double *force, double *part);

/* A change of the stiffness by `part` that comes and goes with time, in whatever step with the
   motion: as fw_effects_envelope_stiffness, and resonance counts */
double fw_effects_envelope_varying(const fw_effect_case *c, double part);
/* Free strains of bodies and ground (nbody + 1), times a law (NULL: from the start on), which are
   among those of the envelope: what the motion is without them. envelope_strain.c */
fw_status fw_effects_envelope_strain(const fw_effect_case *c, const double *strain,
                                     const fw_quantity_law *law, double *bound);

/* squeeze_film.c, rad/s: where a mode of this shape (3 nbody) and modal mass is at most with the springs of the squeezed films
   of a scene */
fw_status fw_effects_squeeze_raised(fw_arena *arena, const fw_mechanism *mechanism,
                                    const fw_device_scene *scene, const double *shape, double mass,
                                    double omega_per_s, double *raised_per_s);

/* N: a tendon's tension within the envelope at most; infinite: it is not in it, or may go slack */
double fw_effects_envelope_tension(const fw_effect_case *c, const fw_device_tendon *tendon);
/* the eyelet's way in mode l, world */
fw_geometry_vec2 fw_effects_envelope_moves(const fw_effect_case *c, const fw_device_eyelet *eyelet,
                                           int mode);
/* eyelet_friction.c: a cable over eyelets that it sticks on or slips over, at a pose */
typedef struct fw_effects_segments {
    int n;       /* that stretch by themselves where it sticks; 0: it does not rub */
    double *row; /* (n x 3 nbody) d length/d pose of each: m per m and per rad */
    double *
        alone_N_per_m; /* (n) of each; infinite: of a pulled cable, which states none; 0: the actuator gives */
    double whole_N_per_m; /* of the cable that slides, along the sum of rows; 0: it is pulled */
    double less;          /* of that slipping takes at most, relative */
} fw_effects_segments;
fw_status fw_effects_eyelet_friction_segments(fw_arena *arena, const fw_device_scene *scene,
                                              int tendon, const fw_effects_force_element *cable,
                                              const double *q, int nbody, fw_effects_segments *to);
/* ---- of a motion that is known, where the envelope is not valid ---- */

/* how far the rotor of a drive came from its stator, by sizes: finger_bending.c */
typedef struct fw_effects_comb_stood {
    double aside_m, along_m, tilt_rad;
} fw_effects_comb_stood;
/* what that motion lacks, since fingers bend: force (3 nbody) += in sizes, turns as the variation of an answer. false: nothing
   bounds it. Nothing of plates, and of what has no voltage */
bool fw_effects_fingers_lack(fw_arena *arena, const fw_mechanism *mechanism,
                             const fw_device_scene *scene, const fw_device_comb *drive,
                             const fw_effects_comb_stood *stood, double *force, double *turns);
/* the ledger's entry of fingers that bend where nothing bounds what they do, or NULL; and what it is called where that is known */
const fw_effect_entry *fw_effects_fingers_open(const fw_effect_ledger *ledger);
fw_status fw_effects_fingers_words(fw_arena *arena, const fw_effect_entry *open, const char **how);
/* What such an effect changes is known now, as the share `bound` of the motion, and in the ledger; *found false: it is too much to
   be small. Where nothing else is open the ledger is not undecided any more: table.c */
fw_status fw_effects_found_bound(fw_arena *arena, const char *id, const char *how, double bound,
                                 fw_effect_ledger *ledger, bool *found);

/* how far an eyelet goes at most */
double fw_effects_envelope_goes(const fw_effect_case *c, const fw_device_eyelet *eyelet);

#endif
