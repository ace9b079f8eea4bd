/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the next level of hinges changes, computed at one instant: pins against closed forms that
   give, these against exact beams. Theory: docs/theory/hinge-models.md. */
#ifndef FW_STATICS_LEVEL_H
#define FW_STATICS_LEVEL_H
#include "dynamics/dynamics.h"
#include "statics/statics.h"

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
    const char *why_not; /* NULL: computed */
    bool unknown;        /* not computed, and nothing else bounds what the level used is off by */
} fw_statics_level_step;

/* of a motion at the row of `sample` nearest the largest peak of a hinge: both levels under the
   loads of that time and the same inertia forces */
fw_status fw_statics_level_of_motion(fw_arena *arena, const fw_mechanism *mechanism,
                                     const fw_device_scene *scene, const fw_dynamics_motion *motion,
                                     const fw_statics_level_step **step);

struct fw_statics_equilibrium;
/* of an equilibrium that was solved for at s = 1 with these effects */
fw_status fw_statics_level_of_equilibrium(struct fw_statics_equilibrium *w,
                                          const fw_statics_level_step **step);
/* the next level's tangent at the pose of modes: largest relative change of a frequency among those
   that both have; NaN: not computed. each: of every mode, NaN where the two do not compare; or NULL */
fw_status fw_statics_level_of_modes(struct fw_statics_equilibrium *w, double *relative,
                                    const double **each);

/* Where every flexure's stiffness is stated and its axis known, auto tries pins before anything
   else: the statement is of the rotation, the pin is its model, and it costs a tenth. They stay
   where the step to hinges that give changes less than `fw_statics_level_stated` times the accuracy
   (3 % at the default accuracy: what stiffnesses are known to). Not where something acts on
   hinges that give in another way, or draws them across their strip, and not where pins hold a body
   that flexures let move. */
fw_status fw_statics_level_pins_first(fw_arena *arena, const fw_mechanism *mechanism,
                                      const fw_device_scene *scene, const fw_effect_choice *asked,
                                      bool *first);
static const double fw_statics_level_stated = 30;
/* it was computed, and changes less; step may be NULL */
bool fw_statics_level_is_below(const fw_statics_level_step *step, double accuracy);

/* true: auto was asked for and this step is not below the accuracy; *choice then asks for the next
   level. step may be NULL */
bool fw_statics_level_climb(const fw_statics_level_step *step, double accuracy,
                            const fw_effect_choice *asked, fw_effect_choice *choice);
/* true: auto was asked for, and a flexure came to where its closed form does not hold (`said`), which an
   exact beam may know; *choice then asks for these. Test: tests/cli/test_hinge.py, judge.examples */
bool fw_statics_level_goes_on(const fw_effect_choice *asked, const fw_diags *said,
                              fw_effect_choice *choice);
/* its number as the error of the level used, where it was computed, and where auto chose what that
   means for the choice */
fw_status fw_statics_level_note(fw_arena *arena, const fw_statics_level_step *step, double accuracy,
                                const fw_effect_choice *asked, fw_effects_hinge_use *use);

/* the next level was wanted and not taken, `why_not`: what that means for the choice */
fw_status fw_statics_level_stays(fw_arena *arena, const fw_statics_level_step *step,
                                 const char *why_not, fw_effects_hinge_use *use);

#endif
