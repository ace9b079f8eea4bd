/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Does any hinge leave its elastic range? utilisation = the larger of peak angle / limit angle and
   peak strain (joint force included) / limit strain, with its error band; a band above 1 rejects,
   one that straddles 1 is inconclusive. */
#ifndef FW_VERDICT_VERDICT_H
#define FW_VERDICT_VERDICT_H
#include "clearance/clearance.h"
#include "wiring/wiring.h"
#include "dynamics/dynamics.h"
#include "probe/probe.h"
#include "statics/statics.h"
#include "verdict/verdict_fabrication.h"
#include "workspace/workspace.h"

typedef enum fw_verdict_decision { FW_ACCEPT, FW_INCONCLUSIVE, FW_REJECT } fw_verdict_decision;
const char *fw_verdict_decision_text(fw_verdict_decision decision);
/* is a worse than b? Accepted, then inconclusive, then rejected */
bool fw_verdict_is_worse(fw_verdict_decision a, fw_verdict_decision b);
fw_verdict_decision fw_verdict_worse(fw_verdict_decision a, fw_verdict_decision b);

/* what the band of a utilisation is made of, shares of it downwards and upwards */
typedef struct fw_verdict_band_parts {
    double root[2]; /* law of the peak strain; upwards with what it may be more by beside a root */
    double stiffness[2]; /* of the closed form, that is of solids */
    double model[2];     /* step to the next level of the hinges */
    double place[2];  /* where the moment stands at a root, and what blocks give along the strip */
    double bodies[2]; /* that bend */
    double numbers[2];
} fw_verdict_band_parts;

typedef struct fw_verdict_hinge_verdict {
    const char *id;    /* joint */
    const char *flow;  /* of the governing variant, may be NULL */
    const char *scene; /* that governs, or "workspace" */
    double peak_angle_rad, angle_error_rad, limit_angle_rad;
    double peak_strain, strain_limit;
    double utilisation, utilisation_low, utilisation_high;
    double numeric; /* part of the band on either side that a tighter run would take away */
    /* relative parts of it, upwards and downwards, that neither a tighter run nor a better model of
       the hinges would take away */
    double lasting, lasting_low;
    fw_verdict_band_parts parts;
    double t_s; /* NaN for the workspace */
    fw_verdict_decision decision;
    int joint;
    double force_share; /* part of the peak strain that the joint force adds to the rotation's */
    /* of the workspace, else NULL and NaN: what holds the worst pose, the joint force there, the
       strain over that of the rotation there alone */
    const char *actuation;
    double joint_force_N, over_rotation;
    bool touches, open; /* the drawn solids meet before the peak angle; no band of it is accepted */
    const fw_flexure_limit *limit; /* the criterion that governs; NULL: a number without a source */
    double limit_Pa; /* peak stress that it allows in this motion, before the safety factor */
    double failure_probability; /* at the peak, no safety factor; NaN: nothing known or asked */
    /* NaN: no cycles asked; damage: Miner's sum, no safety factor; cycles: of one repetition; rung: used if undamped, or 0 */
    double fatigue_utilisation, damage, cycles, rung;
} fw_verdict_hinge_verdict;

/* how near what moves comes to what it may meet, in one scene or required box */
typedef struct fw_verdict_clearance {
    const char *scene, *flow; /* scene: or "workspace" */
    int scene_index;          /* FW_NONE: a box */
    int box;                  /* of the device's required ones; FW_NONE: a scene */
    fw_clearance_least least; /* of the outlines as drawn */
    fw_clearance_way way;     /* what has used most of its way to what is asked for; not of a box */
    double wall_m;            /* that walls come nearer by, as made: 0 as drawn */
    double m, low_m, high_m, parts_m; /* as made, with its band; parts_m: of that, by parts */
    double required_m;                /* 0: they do not meet */
    double keep;                      /* share of the motion that leaves as much */
    fw_verdict_decision decision;
} fw_verdict_clearance;

/* how the device is out of the plane in one scene: sag, tilt, and what tips it (verdict_out_of_plane.c) */
typedef struct fw_verdict_across {
    const char *scene;
    int scene_index;
    bool
        asked; /* the scene has weight, a shock or a stress gradient across the plane: the next six */
    double lowest_m, highest_m; /* of all that is drawn, at most; <= 0, >= 0 */
    double sure_m;              /* lowest without what a shock sets ringing */
    double tilt_rad;            /* of a body */
    double dynamic;             /* by how much more than at rest a shock may do */
    const char *body;           /* that comes lowest; NULL: none is below where it was drawn */
    double
        tips; /* factor on the scene's forces below which nothing tips; HUGE_VAL: none does, NaN: not looked at */
    double
        tips_error; /* relative: what its forces may be off by, as two runs of the motion differ */
    const char *hinge; /* that tips most easily by itself; NULL */
    double
        stiffened; /* share by which its forces may make it stiffer at most; 0 where no frequency is asked for */
    double
        lift_m; /* what electrodes may lift at most (levitation); 0: there are none, or nothing that conducts is below them */
    /* share of its limit that the hinge which bears most may use in the plane and across it, by weight and shocks, at
       most and surely; NaN: not looked at */
    double strained, strained_sure;
    const char *strained_hinge;
    fw_verdict_decision decision;
} fw_verdict_across;
/* is `tips` a number to tell? Else nothing that tips it was found, or (NaN) looked for */
bool fw_verdict_across_tips(const fw_verdict_across *across);

typedef struct fw_verdict_plate_mode {
    double f_Hz, low_Hz,
        high_Hz;      /* of rigid bodies; with what they may give, and the flexures' errors */
    const char *body; /* moves most */
    bool tilts;       /* its edge goes further than its middle */
} fw_verdict_plate_mode;

typedef struct fw_verdict_out_of_plane {
    const char *why;             /* it is not known, and all else is 0; NULL */
    fw_verdict_plate_mode *mode; /* (nmode) all of them, by frequency */
    int nmode;
    double error;      /* relative, of the flexures' stiffness */
    double weight_m,   /* how far any part comes down lying on a table, g = 9.80665 m/s^2 */
        weight_most_m; /* with bodies and flexures as soft as they may be */
    const char *body;  /* the one that the next two are of: it gives most at its centre of mass */
    double across_N_per_m, ratio; /* across the plane; over the least in it, NaN: not known */
    const struct fw_verdict_hung
        *hung; /* (nbody) what hangs over beyond hinges and middle (strain.h) */
    struct fw_verdict_plates *plates; /* what it was computed with (verdict_out_of_plane.c) */
    fw_verdict_across *scene;         /* (nscene) of this flow, those that were run */
    int nscene;
} fw_verdict_out_of_plane;

/* Whether a liquid pulls it to its carrier, or one wall to another, as it dries, and whether it then lets go
   (verdict_stiction.c). Numbers are shares: 1 is the limit, above it nothing touches, or what touches comes free. */
typedef struct fw_verdict_pull {
    bool known;
    /* of a liquid that wets (angle 0): the least that may pull it in, and the least that surely does; HUGE_VAL: none does */
    double tension_N_per_m[2];
    /* elastocapillary, of the flow's own drying: low, high; HUGE_VAL: nothing pulls */
    double number[2];
    const char *a, *b; /* what meets; b NULL: the carrier */
    /* lowered: at rest, by weight and stress, at most; stiffness: of a across the plane, NaN: beside */
    double gap_m, lowered_m, stiffness_N_per_m;
} fw_verdict_pull;

typedef struct fw_verdict_stuck { /* surfaces that a scene closes: of a hinge or of a contact */
    const char *scene, *hinge, *contact, *why; /* why: one of the forces is not known; NULL */
    double holds_N[2], opens_N[2]; /* by adhesion; by flexures: least, most; NaN: not known */
    double
        radius_m; /* of two bodies, relative, at most (fw_effects_contact_radius); NaN or 0: not known */
    fw_verdict_decision decision;
} fw_verdict_stuck;

typedef struct fw_verdict_stiction {
    const char *why; /* it is not known; NULL */
    fw_verdict_pull below, beside;
    double peel[2],
        adhesion_J_per_m2; /* number: low, high; and the adhesion at which it is 1, NaN: not known */
    const char *peeled;    /* the body that holds worst against it */
    bool tethered;         /* tethers hold bodies while it dries: less may touch than is said */
    fw_verdict_stuck *stuck; /* (nstuck) */
    int nstuck;
    fw_verdict_decision decision;
} fw_verdict_stiction;

struct fw_verdict_variant_verdict;
/* what the drying step of a recipe is told of this device: which liquids it bears; NULL: nobody asked */
fw_status fw_verdict_drying_words(fw_arena *arena, const struct fw_verdict_variant_verdict *verdict,
                                  const char **words);
/* what the verdict would be for another way of drying, and the code of its reason; accept where nobody asked */
fw_verdict_decision fw_verdict_drying_bears(const struct fw_verdict_variant_verdict *verdict,
                                            const fw_mechanism_drying *drying, int *number);

/* What a reason keeps of the loads where nothing was measured: only where advice starts to look */
#define FW_VERDICT_KEEP_HALF 0.5
#define FW_VERDICT_KEEP_MOST 0.7

typedef struct fw_verdict_reason { /* why a scene is not accepted, beside the bands of its hinges */
    const char *scene, *flow;
    int number; /* FW-Dnnn */
    fw_verdict_decision decision;
    double keep; /* share of its loads that may be accepted: where advice starts to look */
    bool not_by_loads, not_by_width; /* less load, or wider flexures, are no help */
    bool met; /* what must not met: whatever the model may be off by, this device is beyond */
    bool either_way;  /* other flexures may help or harm: no change is for it, or kept back by it */
    const char *text; /* a sentence */
} fw_verdict_reason;

/* one requirement in one scene, or about one equilibrium: verdict_requirement.c. All in SI of the
   unit; of a measure that is a size, the size */
typedef struct fw_verdict_shaken fw_verdict_shaken;
typedef struct fw_verdict_requirement {
    int asked; /* index into device->requirement */
    const char *probe, *kind, *unit;
    const char *measure;     /* NULL: of an equilibrium */
    const char *scene;       /* NULL: at rest, without loads */
    const char *flow;        /* may be NULL */
    int scene_index;         /* FW_NONE: at rest */
    double min, max;         /* NaN: no bound on this side */
    double value, low, high; /* with its band; NaN: `why` */
    double margin;           /* from the value to the nearer bound, below 0 beyond it */
    double origin; /* the value as drawn, of a maximum, minimum or final value; NaN: a size */
    /* bound / value of a min, value / bound of a max; where a bound is not above 0 both from the value
       as drawn: 1 at the bound; NaN: nothing to measure by */
    double utilisation, utilisation_low, utilisation_high;
    bool by_max;  /* of its max; else of its min */
    double swing; /* how far it goes from where it was drawn; of a gap, how far outlines move */
    double swing_most; /* the same at the end of a band, with modes where they were computed */
    bool size, rubs, untouched; /* not below 0; has all sliding and stuck; may not touch at all */
    double numeric; /* part of the band on either side that a tighter run would take away */
    double lasting; /* relative part of it that no better model of the hinges would take away */
    double t_s;     /* when; NaN: no one time */
    double rings;   /* of a final value, by how much it still goes to and fro; else 0 */
    /* of what a flow makes, else NaN: the least of low and the most of high at any corner, run or not */
    double all_low, all_high;
    fw_verdict_decision decision;
    const char *why;   /* it has no value; NULL */
    const char *open;  /* why its band has no ends; NULL: it has, or there is no value */
    const char *rigid; /* bodies that are not drawn: what they give is not in its band; NULL */
} fw_verdict_requirement;

/* one device that the flow may make, judged like the drawn one */
typedef struct fw_verdict_fabricated_corner {
    const double *x;         /* (ninput) */
    const signed char *sign; /* how hinges differ (verdict_fabrication.h); NULL: not at all */
    const char *what;        /* "nominal", "printed edge -0.15 um, thickness 49 um" */
    fw_verdict_hinge_verdict *hinge; /* (nhinge) worst of all scenes; uses 0: nothing was run */
    const fw_verdict_clearance *clearance; /* the least; NULL: none was looked for */
    const char *why;                       /* what speaks against it beside its hinges, or NULL */
    int number;                            /* FW-Dnnn of `why`; 0: it has none */
    const char *scene;                     /* of `why`; NULL: of none (a flexure is gone) */
    double keep;                           /* share of its loads that it may bear */
    bool not_by_loads, not_by_width;       /* of `why`, as in fw_verdict_reason */
    fw_verdict_requirement *requirement; /* (nrequirement) of the variant; NULL: nothing was run */
    const fw_verdict_shaken *shaken;     /* (nscene) NULL: nothing was run */
    const fw_wiring_moved *stator;       /* (nstator) how near what moves comes to stators */
    int nstator;
    fw_verdict_decision decision;
    bool undecided;       /* it is not accepted, and closer numbers might decide that */
    double dries_N_per_m; /* of a liquid that it bears as it dries; NaN: not judged here */
} fw_verdict_fabricated_corner;

typedef struct fw_verdict_fabricated_verdict {
    fw_verdict_fabricated_corner *corner; /* (ncorner) the first is the nominal device */
    int ncorner;
    fw_verdict_fabricated_hinge *hinge; /* (nhinge) */
    /* (nrequirement) the worst of those that were run, and at which corner; NULL: a trial */
    fw_verdict_requirement *requirement;
    int *requirement_corner;
    fw_verdict_decision decision; /* accept: all of them; reject: the nominal one is rejected */
    int governing, at;            /* hinge and corner; FW_NONE: a corner without hinges to judge */
    double error; /* largest |ln U - ln of the first-order estimate| where both are known */
    bool all;     /* every corner was run */
    int held;     /* input that must be held closer so that it accepts, or FW_NONE */
    double held_low, held_high;
    double held_share;   /* share of every range about the nominal that would do; NaN: not asked */
    const char *control; /* a sentence: what must be known or held; NULL: it accepts */
    const char *reason;  /* a sentence: why it does not accept */
    const double *ln;    /* (ncorner x ncheck) of the search that found it, for one that follows */
    int ncheck;
    fw_verdict_edge_room room; /* where it is accepted */
    bool midway; /* contacts meet in the middle of the depth, not where walls stand out most */
    bool etched; /* what no mask draws of contacts, and nobody said more of, moves as edges do */
} fw_verdict_fabricated_verdict;

/* share of a limit that is used, the least and the most of the devices that were run. high
   INFINITY: one of them has a flexure that is cut through; both NaN: none has a value */
typedef struct fw_verdict_band {
    double low, high;
} fw_verdict_band;

/* what a flow makes of a device, with ranges that may be others than those it was judged with */
typedef struct fw_verdict_ranges {
    fw_verdict_decision decision; /* of the corners, as fw_verdict_fabricated_verdict has it */
    const fw_verdict_band *hinge; /* (nhinge) both ends are looked for of the hinge asked for */
    const fw_verdict_band *requirement; /* (nrequirement) of its utilisation, both ends */
    int judged;                         /* devices that were run for it and for nothing before */
} fw_verdict_ranges;

typedef struct fw_verdict_variant_verdict { /* one flow: a material and a thickness */
    const fw_mechanism_variant *variant;
    const fw_verdict_fabrication_input *input; /* (ninput) what the flow may make of it */
    int ninput;                                /* 0: as drawn only */
    const double *
        suspect; /* (nsuspect x ninput) corners to look at first, the likeliest before the others */
    int nsuspect;
    /* (nscene) of a device much like it, or NULL: what acts there by far acts here
       (fw_effect_choice.like) */
    const fw_dynamics_motion *const *like;
    /* of what the flow makes: bent strips were looked at as drawn, with an allowance */
    bool corner;
    bool tipping; /* of a corner: what tips it out of its plane is looked at */
    /* NULL: not asked for, or the drawn device is not accepted */
    fw_verdict_fabricated_verdict *fabricated;
    fw_verdict_decision drawn; /* decision of the drawn geometry alone */
    double *used; /* (nhinge x (nscene + 1)) utilisation of each hinge in each scene and,
                     last, in the workspace; NaN: none */
    const fw_mechanism *mechanism;
    /* (device->nscene) NULL where the scene is not for this flow, or has no motion: a reason says
       why */
    const fw_dynamics_motion **motion;
    const fw_statics_pull_in **pull_in; /* (device->nscene) NULL without comb drives */
    double *left;      /* (nscene) of the stiffness (fw_statics_stability_find); NaN: not known */
    double *slowest_s; /* (2 nscene) of the slowest mode, at rest, as loaded; 0: not asked yet */
    const char *ends_early; /* FW-D691, of the first scene that does; NULL */
    /* (device->nscene) where a mode lies within its error (verdict_parts.h, FW-D642) */
    fw_verdict_shaken *shaken;
    bool bent; /* its motion begins with flexures bent that are made at rest (FW-D622) */
    fw_verdict_reason *reason; /* (nreason) */
    int nreason;
    /* (2 nhinge) how bodies give (strain.h); NULL: nothing is drawn */
    const struct fw_verdict_arm *arm;
    const struct fw_mechanism_solid *solid; /* (nbody) those that were asked; NULL: none */
    bool straight;                          /* those of straight ways alone */
    fw_verdict_out_of_plane *out_of_plane;  /* NULL: nobody asked, as of a trial */
    const fw_verdict_stiction *stiction;    /* NULL: no flow dries it, or nobody asked */
    const fw_clearance_things *things;      /* NULL: nothing is drawn */
    fw_verdict_clearance *clearance;        /* (nclearance) none of what is not drawn */
    int nclearance;
    double bends_m;          /* what bodies bend beside hinges may take of distances at a corner */
    fw_wiring_moved *stator; /* (nstator) of every scene, as drawn; low_m: at all corners */
    int nstator;
    fw_probe_result *probed;             /* (nscene x nprobe); NULL: no probe has a course */
    fw_verdict_requirement *requirement; /* (nrequirement) the same at every corner */
    int nrequirement;
    fw_workspace_result workspace;
    fw_verdict_hinge_verdict *hinge; /* (mechanism->nhinge) */
    int nhinge;
    fw_verdict_decision decision;
    int governing;              /* index into hinge, or FW_NONE */
    double failure_probability; /* of all its hinges in series; NaN: not known */
} fw_verdict_variant_verdict;

/* One quantity held against what is allowed: of what governs, as drawn or as made. */
typedef struct fw_verdict_check {
    const char *what;         /* "hinge C", "requirement stroke (final)" */
    const char *of;           /* "its elastic limit"; of a requirement all that is to be said */
    double used, low, high;   /* share of that, with its band; above 1 is too much */
    const char *flow, *scene; /* flow may be NULL */
    const char *corner;       /* "thickness 49 um": of what the flow may make; NULL: as drawn */
    double t_s;               /* NaN: no one time */
    double most;              /* of all hinges at all corners, run or not; NaN: no corner was run */
    fw_verdict_decision decision;
    const fw_verdict_hinge_verdict *hinge;     /* NULL: it is no hinge */
    const fw_verdict_requirement *requirement; /* NULL: it is none; `used` may be NaN */
} fw_verdict_check;

enum { FW_CHECK_HINGES = 1, FW_CHECK_REQUIREMENTS = 2 };

typedef enum fw_verdict_proposal_kind {
    FW_PROPOSE_PARAMETER, /* one alone */
    FW_PROPOSE_FLEXURES,  /* lengths, or widths */
    FW_PROPOSE_HOLES,     /* fewer, or smaller ones */
    FW_PROPOSE_LOADS,     /* less of them, or smaller required poses */
    FW_PROPOSE_SEVERAL    /* parameters, or whatever the file states, together */
} fw_verdict_proposal_kind;

/* A change that accepts: these settings together were read, drawn, run and accepted. */
typedef struct fw_verdict_proposal {
    fw_verdict_proposal_kind kind;
    const fw_device_set *set; /* (nset) for --set */
    int nset;
    double change;    /* see fw_verdict_variable_size: summed over all that is changed by itself */
    const char *text; /* "width: 12.4 um is accepted; now 10 um (24 % more)" */
} fw_verdict_proposal;

typedef enum fw_verdict_parameter_found {
    FW_PARAMETER_ACCEPTS,
    FW_PARAMETER_NONE,      /* no value that was tried is accepted */
    FW_PARAMETER_NOT_LOOKED /* nothing says how far to look, there are too many of them, or it took
                               too long */
} fw_verdict_parameter_found;

/* the smallest change of one parameter alone that accepts */
typedef struct fw_verdict_parameter_advice {
    const char *name; /* what --set takes */
    fw_verdict_parameter_found found;
    double from, to;        /* SI; to: NaN where there is none */
    double low, high;       /* SI: where it was looked for; NaN: not looked */
    double change;          /* |to - from| / |from|, infinite from 0; NaN: none */
    const char *value_text; /* "12.4 um": the very text that was run and accepted; NULL: none */
    const char *text;       /* "width: 12.4 um is accepted; now 10 um (24 % more)" */
    int trials;
    bool ended; /* before the search was done */
} fw_verdict_parameter_advice;

/* what is computed once more of a device that is undecided, in this order */
typedef enum fw_verdict_refinement {
    FW_REFINE_NOTHING,
    FW_REFINE_BEAMS,   /* hinges as exact beams, of which it is not known what they change */
    FW_REFINE_NUMBERS, /* tighter numbers alone */
    FW_REFINE_HINGES   /* those, and a better model of the hinges */
} fw_verdict_refinement;
enum { FW_VERDICT_LOOKS = 4 };

/* the numbers of the drawn device, as they were first computed or more closely where that could decide it */
typedef struct fw_verdict_computed {
    fw_verdict_refinement refinement;           /* FW_REFINE_NOTHING: the first */
    const fw_verdict_hinge_verdict *hinge;      /* (nhinge) of the verdict */
    const fw_verdict_requirement **requirement; /* (nvariant) of each */
} fw_verdict_computed;

typedef struct fw_verdict {
    fw_verdict_decision decision;        /* as drawn and as made */
    fw_verdict_decision drawn;           /* of the drawn geometry alone */
    fw_verdict_variant_verdict *variant; /* (nvariant) */
    int nvariant;
    fw_verdict_hinge_verdict *hinge; /* (nhinge) worst over the variants, by joint */
    int nhinge;
    int governing;              /* index into hinge, or FW_NONE */
    double failure_probability; /* of the worst variant; NaN: not known */
    double accuracy_wanted, accuracy_estimated;
    /* largest sum of bounds that a scene leaves out by itself (auto); it is part of the estimate */
    bool soft_bodies; /* bounded: plain ways gave too much not to be counted; all was done again */
    double accuracy_left_out;
    fw_verdict_proposal *proposal; /* (nproposal) of what is not accepted, the least change first */
    int nproposal;
    const char *advice_note; /* why there is none, or why not all was tried; NULL */
    /* (nparameter) the smallest change first; none for an accepted design */
    fw_verdict_parameter_advice *parameter;
    int nparameter;
    const fw_layout *layout; /* what was judged; NULL: it cannot be drawn */
    fw_verdict_computed
        computed[FW_VERDICT_LOOKS]; /* (ncomputed) the last one is what the decision stands on */
    int ncomputed;
} fw_verdict;

typedef enum fw_verdict_corners {
    FW_CORNERS_AUTO,  /* as drawn, then as made */
    FW_CORNERS_NONE,  /* as drawn only */
    FW_CORNERS_FIRST, /* stop at the first corner that is not accepted: for trials */
    FW_CORNERS_SUSPECT /* only those of `suspect`; where there is none, as FIRST: for looking around */
} fw_verdict_corners;

/* The same description read again with nset more settings, for advice; this room does not read
   files. with: fills *device and the nvariant entries of `variant` (variant, input, ninput) in
   `arena`; anything but FW_OK, FW_NOMEM and FW_CANCELLED: it cannot be read with them. */
typedef struct fw_verdict_restated {
    fw_status (*with)(void *context, fw_arena *arena, const fw_device_set *set, int nset,
                      const fw_device **device, fw_verdict_variant_verdict *variant);
    void *context;
} fw_verdict_restated;

/* What flow i may make of a device that has been drawn (layout NULL: it cannot be): fills input and
   ninput of a variant, whose ranges it already has without the drawing. fill NULL: those stand. */
typedef struct fw_verdict_fabricated_of {
    fw_status (*fill)(void *context, fw_arena *arena, const fw_device *device,
                      const fw_layout *layout, int i, fw_verdict_variant_verdict *variant);
    void *context;
} fw_verdict_fabricated_of;

typedef struct fw_verdict_options {
    fw_dynamics_motion_options motion;
    bool with_advice; /* of what is not accepted: fw_verdict_advise */
    fw_verdict_corners corners;
    double *work;     /* evaluations of the forces of hinges are added to it; NULL: nobody counts */
    bool at_a_glance; /* no refinement of what is undecided: for trials and previews */
    bool decision_only; /* clearances are bounded until they decide, not found: for trials */
    bool values;        /* of the drawn device they are found all the same: for trials */
    bool ways;          /* of a corner: what would meet first if all went further is looked for */
    bool bounded; /* clearances are bounded where that accepts, tethers not watched: for studies */
    bool grid_ways;   /* bounded: bodies give too much for plain ways (fw_verdict.soft_bodies) */
    bool hinges_only; /* nothing is judged but hinges, requirements, and if motions hold */
    const char *only_scene; /* of a picture: what hinges use in it, nothing else; NULL: all */
    bool all_made;     /* at all corners, whatever is decided before: a response is one quantity */
    bool unheld;       /* what would have to be held is not looked for: nobody reads it */
    bool coarse_first; /* a first look, and what was asked for only where it decides: for trials */
    fw_workspace_kept *kept;      /* what devices of a study have in common; NULL: nothing */
    fw_verdict_restated restated; /* with NULL: no advice */
    fw_verdict_fabricated_of fabricated_of;
} fw_verdict_options;

/* what the model itself may be wrong by, relative, beside the numerical error
   (docs/theory/verdict.md) */
typedef struct fw_verdict_model_errors {
    double motion; /* revolute joints at the elastic centres against geometrically exact beams */
    double strain; /* closed-form peak strain against 3-D finite elements */
} fw_verdict_model_errors;
extern const fw_verdict_model_errors fw_verdict_model_error;
extern const double fw_verdict_first_accuracy; /* of a first look */

/* What bodies and bases, rigid in the motion, would give of the displacement where loads act, as a share, at most to first order
   (verdict_bending.c); bases of it; what hinges store at most, J. 0: nothing is drawn, or moves. motion: of a verdict, or NULL */
double fw_verdict_bending_share(const fw_dynamics_motion *motion);
double fw_verdict_bases_share(const fw_dynamics_motion *motion);
double fw_verdict_bending_stored_J(const fw_dynamics_motion *motion);
/* the same, but 0 where the device is pressed along its flexures and no end of one goes or turns by what matters */
double fw_verdict_bending_moving(const fw_dynamics_motion *motion);
/* FW-Dnnn: rims of release holes do not bear, or are not known to */
enum { FW_VERDICT_RIMS = 575 };
/* What the rims of release holes bear in a motion, over what the material is allowed. At most three times (Kirsch) the
   stress of a strip between holes that bears everything alone; at least what equilibrium asks of a cut through the whole
   body. NaN: there are no holes. at: for low and high 2 times the number of the hinge, and 1 for its second body */
fw_verdict_band fw_verdict_bending_rims(const fw_mechanism *mechanism,
                                        const fw_dynamics_motion *motion, int at[2]);
/* at most, over all required poses; NaN: there are none, or no holes. at: as above, of one end */
double fw_verdict_bending_rims_required(const fw_verdict_variant_verdict *v, int *at);
/* fw_verdict_bending_moving above 5 %, which is told (FW-D510), else 0: bands of utilisations have it */
double fw_verdict_bending_counted(const fw_dynamics_motion *motion);
/* what the hinges' level may be off by in a motion, relative to the largest strain: computed at its
   peak where that is known (verdict_strain.c), else fw_verdict_model_error.motion */
double fw_verdict_motion_model_error(const fw_mechanism *mechanism,
                                     const fw_dynamics_motion *motion);
/* the part of it that exact beams have too */
double fw_verdict_motion_lasting_error(const fw_mechanism *mechanism);
/* of it what may make a strain more, and what may make it less beside what the strain itself is off by */
double fw_verdict_motion_lasting_above(const fw_mechanism *mechanism);
double fw_verdict_motion_lasting_below(const fw_mechanism *mechanism);
/* Fills the strains of a step to the next level (may be NULL), on both levels; loads: what acted. share: of the largest what the
   step changes, 0 where that is not known; NULL: it is not asked for. It is `strains_apart` of a motion's options */
fw_status fw_verdict_level_strains(fw_arena *arena, const fw_mechanism *mechanism,
                                   const fw_effects_loads *loads, const fw_statics_level_step *step,
                                   double *share);
/* one variant: every scene's motion and the required workspace. layout may be NULL: joint forces
   are then bounded instead of resolved along the flexure. */
fw_status fw_verdict_variant(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_mechanism *mechanism, const fw_verdict_options *options,
                             fw_diags *diags, fw_verdict_variant_verdict *verdict);
/* after fw_verdict_variant, where that accepts: judges what the flow may make of the
   device; raises verdict->decision and adds a reason where it is not accepted */
fw_status fw_verdict_as_fabricated(fw_arena *arena, const fw_device *device,
                                   const fw_layout *layout, const fw_verdict_options *options,
                                   fw_verdict_variant_verdict *verdict);
/* the same; where contacts touch what no mask draws and nobody said whether that is placed or etched, once for either.
   What neither or both accept is the tighter one's; what one accepts is undecided (FW-D657) */
fw_status fw_verdict_as_made(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_verdict_options *options,
                             fw_verdict_variant_verdict *verdict);
/* of the hinges of a flow the one that its corners strain most; FW_NONE: none was run */
int fw_verdict_most_used(const fw_verdict_variant_verdict *verdict);
/* The same search with other ranges (input, ninput), after fw_verdict_as_fabricated with the same
   device, layout and options: its bands. Devices that were run for v->fabricated are not run again.
   hinge: of v, or FW_NONE. v is left alone. Test: tests/unit/verdict/test_ranges.c */
fw_status fw_verdict_ranges_judge(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                                  const fw_verdict_options *options,
                                  const fw_verdict_variant_verdict *v,
                                  const fw_verdict_fabrication_input *input, int ninput, int hinge,
                                  fw_verdict_ranges *out);
typedef struct fw_verdict_made { /* one device that a flow may make */
    /* logarithm of the largest share of a limit that any check uses, by value; above 0 is too much; NaN: not known */
    double ln;
    /* the same by the lower and the upper end of the band of every check: low <= ln <= high */
    double low, high;
    fw_verdict_decision decision;
    const char *why; /* what speaks against it beside its hinges, or NULL */
} fw_verdict_made;
/* The device at a point x (ninput, SI) of what the flow may make, after fw_verdict_variant with the same device, layout and
   options; v is left alone, so that several threads may ask at once, each with an arena of its own. Error: that of a first
   look (fw_verdict_first_accuracy) at least. Cost: that of a corner. Test: tests/unit/study/test_made_at.c */
fw_status fw_verdict_made_at(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_verdict_options *options, const fw_verdict_variant_verdict *v,
                             const double *x, fw_verdict_made *out);
/* the same with all that it was judged by, in the arena */
typedef struct fw_verdict_die {
    fw_verdict_made made;
    const fw_verdict_hinge_verdict *hinge;     /* (nhinge) no scene: nothing of it was run */
    const fw_verdict_requirement *requirement; /* (nrequirement) NULL: nothing was run */
    /* (fw_verdict_checks) logarithms of the shares of their limits, those of hinges in each scene and in the workspace
       first; NaN: there is no such check, or hardly anything is used */
    const double *ln;
} fw_verdict_die;
int fw_verdict_checks(const fw_device *device, const fw_verdict_variant_verdict *v);
fw_status fw_verdict_die_at(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                            const fw_verdict_options *options, const fw_verdict_variant_verdict *v,
                            const double *x, fw_verdict_die *die);
/* the worst of a requirement over the corners that were run, with its band over all; NULL: none was */
const fw_verdict_requirement *fw_verdict_requirement_made(const fw_verdict_variant_verdict *v,
                                                          int k, int *corner);
/* band[0], band[1]: over all corners where that is known of what is made, else its own */
void fw_verdict_requirement_band(const fw_verdict_requirement *r, double band[2]);
/* lays out, builds and judges the device in every variant; verdict->variant must be an array of
   nvariant with `variant` set. *layout: the drawing, or what can be shown of one that cannot be made
   (its faults), which is not judged; NULL where there is neither. */
fw_status fw_verdict_run(fw_arena *arena, const fw_device *device,
                         const fw_verdict_options *options, fw_diags *diags, fw_verdict *verdict,
                         const fw_layout **layout);
/* What governs. made: each flow as it makes the device, where that was judged, else as drawn; not made: as drawn. The worst
   decision goes first, then the largest share used. kinds: FW_CHECK_... of them that are looked at. *found is false where
   nothing of them was run. Test: tests/unit/verdict/test_governing.c */
fw_status fw_verdict_governing(fw_arena *arena, const fw_verdict *verdict, int kinds, bool made,
                               fw_verdict_check *check, bool *found);
extern const char fw_verdict_at_rest[]; /* the scene of a reason that is of none */
/* the reason with the scene and the flow that it is of, and its code; *words is NULL where the same
   reason was said before. Test: tests/unit/verdict/test_governing.c */
fw_status fw_verdict_reason_words(fw_arena *arena, const fw_verdict *verdict, int variant,
                                  int reason, const char **words);
/* why it is rejected, sentences, each once; none where it is not */
fw_status fw_verdict_rejections(fw_arena *arena, const fw_verdict *verdict, const char ***text,
                                int *n);
/* what a drawn device needs and its masks do not have: what moves it (FW-D598), a sentence for each driver, and what it
   touches (FW-D656), one for each contact and body, however many scenes have it */
typedef struct fw_verdict_from_outside {
    const char *text;
    int number; /* FW-Dnnn */
    fw_place place;
} fw_verdict_from_outside;
fw_status fw_verdict_outside(fw_arena *arena, const fw_device *device, const fw_verdict *verdict,
                             const fw_verdict_from_outside **outside, int *n);
/* no tolerance makes errors of its motions smaller, which are more than so many times what was wanted, each of them */
bool fw_verdict_in_vain(const fw_verdict_variant_verdict *v, double times);
/* advice_note where no advice was asked for */
extern const char fw_verdict_not_searched[];
/* of what is not accepted, where advice is asked for: proposals, each one run, the value of each
   parameter alone that accepts, and the note */
fw_status fw_verdict_advise(fw_arena *arena, const fw_device *device,
                            const fw_verdict_options *options, fw_verdict *verdict);

#endif
