/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which of two verdicts matters more, what a refined computation may decide, one scene, and the search over what a flow may
   make. Private to the room and its tests. */
#ifndef FW_VERDICT_VERDICT_PARTS_H
#define FW_VERDICT_VERDICT_PARTS_H
#include "base/sort.h"
#include "verdict/verdict.h"

struct fw_mechanism_plates;

/* ---- decision.c: which of two hinges matters more, what may still decide ---- */

void fw_verdict_keep_worst(fw_verdict_hinge_verdict *worst, const fw_verdict_hinge_verdict *other);
bool fw_verdict_governs(const fw_verdict_hinge_verdict *h, const fw_verdict_hinge_verdict *other);
/* hinges of which some are inconclusive: what may decide them */
fw_verdict_refinement fw_verdict_refinement_of(const fw_verdict_hinge_verdict *hinge, int nhinge);
/* accuracy at which numbers decide all that are inconclusive now, were nothing else to change */
extern const double fw_verdict_tightest; /* accuracy of the closest look */
/* a clearance of which less is used does not come to its end at a corner (verdict_clearance.c) */
extern const double fw_verdict_clearance_counts;
double fw_verdict_enough(const fw_verdict_hinge_verdict *hinge, int nhinge, double accuracy);
/* the same request, as close as that */
fw_verdict_options fw_verdict_tighter(const fw_verdict_options *options,
                                      fw_verdict_refinement refinement);
/* verdict_run.c: every joint is where both its bodies put it, within 10 nm, in the drawn position (FW-D206) */
fw_status fw_verdict_check_closure(const fw_device *device, const fw_mechanism *mechanism,
                                   fw_diags *diags);

/* ---- verdict_scene.c: a scene is run, and what speaks against it beside its hinges ---- */

enum { FW_REASONS = 18 }; /* of one scene at most, contacts apart */
/* of one flow at most */
size_t fw_verdict_reasons_most(const fw_device *device, int nrequirement);

/* scene i of the device: motion[i] (NULL where electrodes touch, or a formula of another effect ends), pull_in[i], reasons of v */
fw_status fw_verdict_scene(fw_arena *arena, const fw_device_scene *scene, int i,
                           const fw_dynamics_motion_options *options, fw_diags *diags,
                           fw_verdict_variant_verdict *v);
/* Where a reason from `first` on says that the scene stays on an unstable equilibrium (FW-D259): what is required of its
   motion has no value, and why is fw_verdict_unstable_there; a clearance that it keeps is undecided, since what falls
   from there comes nearer */
extern const char fw_verdict_unstable_there[];
void fw_verdict_unstable_leaves_open(fw_verdict_variant_verdict *v, int scene, int first);
/* near_a_fold.c: a warning where a scene ends with a hinge still on the way up (FW-D691); v->ends_early: not judged */
fw_status fw_verdict_ends_early(fw_arena *arena, const fw_device_scene *scene,
                                const fw_dynamics_motion *motion,
                                const fw_dynamics_motion_options *options, fw_diags *diags,
                                fw_verdict_variant_verdict *v);
/* a warning where bodies give enough to count (FW-D510) */
void fw_verdict_bending_tell(const fw_mechanism *mechanism, const fw_device_scene *scene,
                             const fw_dynamics_motion *motion, fw_diags *diags);

/* ---- verdict_bending.c: bodies are rigid in the motion, and are none ---- */

/* v->arm, where it is not known of a device much like it. straight: of straight ways, where all stay in their
   bodies (v->straight), which decides no more than that bodies are not counted */
fw_status fw_verdict_bending_begin(fw_arena *arena, const fw_layout *layout,
                                   const fw_mechanism *mechanism, bool straight,
                                   fw_verdict_variant_verdict *v);
/* body_solid.c: where bodies as beams give enough to count in what the two runs of a scene saw, those that matter do as
   plane solids */
struct fw_verdict_strain_monitor;
fw_status fw_verdict_bending_end(fw_arena *arena, const fw_layout *layout,
                                 struct fw_verdict_strain_monitor *monitor,
                                 struct fw_verdict_strain_monitor *other,
                                 fw_verdict_variant_verdict *v);
/* false: they may have to be */
bool fw_verdict_bending_settled(const fw_verdict_variant_verdict *v);
enum { FW_VERDICT_BODIES = 538 }; /* FW-Dnnn: a body is not known to bear what is brought */
/* a reason of v where a body (FW-D538) or the rims of its release holes (FW-D575) may not bear the scene, or required
   poses */
fw_status fw_verdict_bending_judge(fw_arena *arena, int scene, const fw_dynamics_motion *motion,
                                   fw_verdict_variant_verdict *v);
fw_status fw_verdict_bending_judge_required(fw_arena *arena, fw_verdict_variant_verdict *v);

/* ---- verdict_out_of_plane.c: plates on flexures ---- */

/* decision.c: one more reason, of the required poses; text NULL: FW_NOMEM */
/* adds why required poses are out of reach or undecided: arm_rims.c */
fw_status fw_verdict_required_poses(fw_arena *arena, fw_verdict_variant_verdict *v);
fw_status fw_verdict_workspace_reason(fw_verdict_variant_verdict *v, int number,
                                      fw_verdict_decision decision, const char *text);

/* its decision by its band alone, where that its solids meet stands among the reasons */
fw_verdict_decision fw_verdict_by_band(const fw_verdict_hinge_verdict *h);
/* strain_monitor.c, of a hinge whose drawn solids meet before its peak angle (FW-D204): a warning, or with `diags` NULL a reason of v
   where that alone leaves it undecided */
fw_status fw_verdict_touching(fw_arena *arena, const fw_layout_hinge_layout *drawn,
                              const fw_verdict_hinge_verdict *h, fw_diags *diags,
                              fw_verdict_variant_verdict *v);

/* a scene acts across the plane, or a mode there is asked for */
bool fw_verdict_out_of_plane_asked(const fw_mechanism *mechanism);
/* v->out_of_plane, and reasons of v. brief: only where something asks. lean: nobody reads what hangs over (body_hung.c) */
fw_status fw_verdict_out_of_plane_judge(fw_arena *arena, const fw_mechanism *mechanism, bool brief,
                                        bool lean, fw_diags *diags, fw_verdict_variant_verdict *v);
/* once hinges were judged in the plane: what they bear across it by weight and shocks */
fw_status fw_verdict_out_of_plane_strain(fw_arena *arena, fw_verdict_variant_verdict *v);
/* flexure_swing.c: a reason where hinges use more than their limit there, `in` of it in the plane */
fw_status fw_verdict_across_strained(fw_arena *arena, const fw_device_scene *s, double in,
                                     fw_verdict_variant_verdict *v, fw_verdict_across *to);
/* Across the plane as checks of a search over what a flow makes: ln of what tips in each scene, and of what hinges bear
   there, which are 1 at their limits; NaN: none. ln (2 nscene) */
void fw_verdict_across_checks(const fw_verdict_variant_verdict *v, int nscene, double *ln);
/* is the drawn device so near to tipping that what a flow makes of it may tip? */
bool fw_verdict_across_counts(const fw_verdict_variant_verdict *v);
/* what tips is accepted but for what its forces may be off by, so that closer numbers may decide */
bool fw_verdict_across_open(const fw_verdict_variant_verdict *v);
/* sum of |F| times the distance from the centre of mass of all that a scene puts on each body (nbody); NaN: not known */
void fw_verdict_across_acting(const fw_mechanism *m, const fw_device_scene *s, double *else_Nm);
/* what tips the plates in a scene: tips, tips_error, hinge, and a reason where that may be; error: of the flexures */
fw_status fw_verdict_across_tipping(fw_arena *arena, const struct fw_mechanism_plates *p,
                                    const fw_device_scene *s, double error,
                                    fw_verdict_variant_verdict *v, fw_verdict_across *to);
/* share of its stiffness across the plane that the forces of a scene take at most; 1: all of it, 0: none, or not looked at */
double fw_verdict_across_softened(const fw_verdict_across *across);
/* the most that residual stress takes, of all scenes that have it */
double fw_verdict_across_stressed(const fw_verdict_variant_verdict *v);
/* a mode's band about the equilibrium of a scene; FW_NONE: at rest */
void fw_verdict_across_under_loads(const fw_verdict_variant_verdict *v, int scene,
                                   const fw_verdict_plate_mode *of, double *low_Hz,
                                   double *high_Hz);
/* the mode that a probe counts, if it is one across the plane; NULL: it is that of number *in_plane (from 1) in it, or
   there is none. modes NULL: those in the plane are not known */
const fw_verdict_plate_mode *fw_verdict_frequency(const fw_verdict_variant_verdict *v,
                                                  const fw_device_probe *probe,
                                                  const fw_statics_modes *modes, int *in_plane);

/* ---- body_loads.c: what bodies give beside their hinges, and what hangs over ---- */

/* after requirements and required boxes of a verdict whose values count: what may meet then, is displaced or swings
   otherwise is undecided, with a reason (FW-D638, FW-D639, FW-D640) */
fw_status fw_verdict_hangs_in_plane(fw_arena *arena, fw_verdict_variant_verdict *v);
/* body_loads.c: by how much what holds rotors is softer at pull-in for what bodies give there, relative, at most */
fw_status fw_verdict_places_pulled(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                                   const fw_statics_pull_in *pull_in, double *gives);
/* verdict_bending.c: by how much electrodes come nearer in another motion, m, and the share of a gap that this one keeps */
double fw_verdict_electrodes_nearer(const fw_dynamics_motion *was, const fw_dynamics_motion *now,
                                    double *kept);
/* to (nbody): how far what hangs over bends in a scene at most, m, without stated forces at a probe's place; apart: beyond the middle */
fw_status fw_verdict_bends_in_plane(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                                    const struct fw_verdict_hung *hung, const fw_device_probe *but,
                                    double *to, double *apart_m);

/* ---- verdict_stiction.c: what a liquid pulls, and what adhesion holds ---- */

/* arm_rims.c: why a contact or a hinge may stay closed; NULL: FW_NOMEM */
const char *fw_verdict_stuck_text(fw_arena *arena, const fw_verdict_stuck *stuck,
                                  double adhesion_J_per_m2);

/* after the scenes were run: v->stiction, and reasons of v. brief: only where a meniscus passes over it */
fw_status fw_verdict_stiction_judge(fw_arena *arena, const fw_mechanism *mechanism, bool brief,
                                    fw_verdict_variant_verdict *v);

/* ---- decision.c: what speaks against a scene; resonance.c: where a mode may lie elsewhere ---- */
/* required_small.c: where what a requirement's probe is of comes to rest under the loads that a scene ends with */
typedef struct fw_verdict_rest {
    double at, off;  /* SI of the probe; it may be off by that */
    double period_s; /* of the slowest mode; 0: a sequence of equilibria, which does not ring */
    const char *why; /* it is not known: why; NULL: it is */
} fw_verdict_rest;
/* required_small.c: s; 0: nothing swings. rings_from: an fw_probe_monitor's late_from */
fw_status fw_verdict_longest_period(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                                    bool at_equilibrium, double *period_s);
fw_status fw_verdict_slowest_s(fw_arena *arena, const fw_verdict_variant_verdict *v, int scene,
                               double *period_s); /* at rest or as loaded; 0: nothing swings */
fw_status fw_verdict_rings_from(const void *v, const fw_probe_monitor *monitor, double *late_s);
fw_status fw_verdict_rests_at(const fw_verdict_variant_verdict *v, int scene,
                              const fw_dynamics_motion *motion, const fw_probe_monitor *monitor,
                              const fw_device_requirement *requirement, fw_verdict_rest *rest);
/* moved_again.c: nothing moves in a scene; of v->used what is filled so far */
bool fw_verdict_stands_still(const fw_verdict_variant_verdict *v, int scene);
/* resonance.c: warning FW-D655 where nothing moves in a scene, and what is required there, or no hinge used, says nothing */
fw_status fw_verdict_tell_still(fw_arena *arena, fw_diags *diags,
                                const fw_verdict_variant_verdict *v);
/* text NULL: FW_NOMEM. keep: share of the scene's loads that would do, held between 0.001 and 0.99 */
fw_status fw_verdict_scene_reason(fw_verdict_variant_verdict *v, const fw_device_scene *scene,
                                  int number, fw_verdict_decision decision, double keep,
                                  const char *text);

/* what bends a hinge: its turn, and 3/2 of what its ends go over its length; or moves a body, its turn by a length */
typedef struct fw_verdict_bends {
    double turn, x, y;
} fw_verdict_bends;
fw_verdict_bends fw_verdict_bend_of(const fw_mechanism_hinge *hinge, double turn, double x_m,
                                    double y_m);
double fw_verdict_bends_most(fw_verdict_bends b);
/* a mode that swings in a scene whose law goes to and fro, or where something comes again */
typedef struct fw_verdict_shaken_mode {
    int number;                          /* from 0 */
    double omega, low, high, damping[3]; /* rad/s; where it may lie; critical shares (body.h) */
    double soft, stiff; /* likewise by stiffness, without what the scene passes on its way */
    /* (nhinge + nbody + nreach) what it does as computed of the most that each is bent, or goes; 0: that hardly is */
    fw_verdict_bends *bends;
    /* over how far it swings: how far it still does at the end, and goes from the start; its speed at the start, 1/s */
    double late, goes, start;
    double held, least; /* times as far as bands hold; rad/s by flexures' errors alone */
    double *size; /* (nload) modal forces/(mass omega^2) over its swing; NULL: none come again */
} fw_verdict_shaken_mode;
/* a scene that was moved again (near_a_fold.c) */
typedef struct fw_verdict_other {
    bool asked, lost;       /* it was, and there is no such motion to its end */
    double by, off, from_s; /* its loads; errors of all that gives; held on from there, or 0 */
    const fw_dynamics_motion *motion;
    const fw_probe_monitor *probe; /* what those of requirements read in it; NULL: none are */
} fw_verdict_other;
struct fw_verdict_shaken {
    fw_verdict_shaken_mode *mode;   /* (n) */
    struct fw_verdict_reach *reach; /* (nreach) strain.h */
    /* (nhinge + nbody + nreach) how far each goes at most; upwards factors on that, of hinges on strains */
    double *most, *each;
    int n, nreach;
    /* where something comes again: all that acts, of which the last `ways` have no force but hold hinges and bodies as
       `way` says, per unit of the law (ways x (nhinge + nbody + nreach)) */
    fw_quantity_law_load *load;
    fw_verdict_bends *way;
    int nload, ways;
    const char *unknown; /* what holds the device nowhere that was found; NULL: all is known */
    /* (2 x (nhinge + 1)) on what bends each hinge, last on what moves: upwards >= 1, downwards <= 1 */
    double *factor;
    double late; /* what of a largest way may be there at the end besides, for phases run apart */
    /* (2 x (nhinge + 1)) likewise where the layer's own strain presses or pulls flexures, last on what moves: requirements
       have their own there (fw_verdict_grown_again); NULL: it does not */
    double *grown;
    double *
        flexed; /* (2 nhinge) strain that flexures' own mass makes more, and less; NULL: nothing shakes it */
    /* the same on what is required, by the most of them, without what the motions of `other` have */
    double required[2], required_late;
    double nearer_m, kept; /* of electrodes, in these; share of a gap as computed, 0: not asked */
    const struct fw_verdict_swinging
        *own;                  /* what bodies do by modes of their own (body.h); NULL: nothing */
    fw_verdict_other other[4]; /* softer, most pull; stiffer, least pull; held on; the other side */
};
/* does a law go to and fro in the scene? */
fw_status fw_verdict_is_shaken(fw_arena *arena, const fw_mechanism *mechanism, int scene,
                               bool *shaken);
/* verdict_requirement.c: who moves a scene again looks at what is required of it, and bands take in what that motion
   has; has: share of the band that it has already */
typedef struct fw_verdict_required {
    fw_status (*watch)(fw_arena *arena, const fw_mechanism *mechanism, int scene,
                       const fw_verdict_variant_verdict *v, bool required,
                       fw_probe_monitor *monitor[2]);
    fw_status (*take_in)(const fw_mechanism *mechanism, int scene, const fw_dynamics_motion *other,
                         const fw_probe_monitor *monitor, double has,
                         fw_verdict_variant_verdict *v);
} fw_verdict_required;
extern const fw_verdict_required fw_verdict_required_of_scenes;
/* near_a_fold.c: what of v->shaken[scene] grows where loads leave little of the stiffness, of which `e` may be missing (FW-D672),
   electrodes may pull otherwise, it ends on its way (FW-D746), or left an unstable equilibrium (FW-D747) */
bool fw_verdict_has_said(const fw_verdict_variant_verdict *v, const fw_device_scene *s, int number);
fw_status fw_verdict_softened(fw_arena *arena, const fw_mechanism *mechanism, int scene, double e,
                              const fw_dynamics_motion_options *options,
                              const fw_verdict_required *required, bool brief, fw_diags *diags,
                              fw_verdict_variant_verdict *v);
/* verdict_strain.c: the layer of a scene grows or shrinks by itself, so that what flexures are off by in bending and along
   themselves counts each by itself. Of the four ways k to combine them: what all of a flexure's stiffness is more by, and
   what that along itself is more by besides; gives: share that bodies give */
bool fw_verdict_grows(const fw_verdict_variant_verdict *v, int scene);
enum { FW_VERDICT_WAYS = 4 };
typedef struct fw_verdict_way {
    double stiffer, along;
    bool gives; /* bodies do, in it */
} fw_verdict_way;
void fw_verdict_off_by_itself(const fw_mechanism *mechanism, double *bending, double *along);
fw_verdict_way fw_verdict_way_of(int k, double bending, double along, double gives);
/* moved_again.c: moves such a scene again in all four: hinges, ways (v->shaken[scene].grown) and requirements have it in their bands; what
   does not stand then is undecided (FW-D699) */
fw_status fw_verdict_grown_again(fw_arena *arena, const fw_mechanism *m, int scene,
                                 const fw_dynamics_motion_options *o,
                                 const fw_verdict_required *required, fw_verdict_variant_verdict *);
/* most of a pull that may be missing in a scene (fw_effects_comb_fringe), relative; 0: no electrodes act */
double fw_verdict_pull_missing(const fw_verdict_variant_verdict *v, int scene);
/* Small motions about the equilibria that a scene has with flexures softer and stiffer by their error, and with the pull as
   it may be, and on the other side of an unstable one that was left on the way there; without a scene there are none */
typedef struct fw_verdict_small_others {
    const fw_statics_modes *modes[2 * 3 * FW_VERDICT_WAYS + 1]; /* (count) */
    int count;
    const fw_statics_modes *at; /* as they are; NULL: without a scene */
    const char *lost;           /* a clause: one of them is not there; NULL: all are */
} fw_verdict_small_others;
fw_status fw_verdict_small_again(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *of,
                                 int scene, const fw_statics_mode_options *o,
                                 const fw_statics_modes *modes, const fw_verdict_variant_verdict *v,
                                 fw_verdict_small_others *others);
/* a band takes in what a probe (mode 0), or a mode's frequency (from 1 on), is in these. times: of the softer side, by its place */
void fw_verdict_small_widen(const fw_verdict_small_others *others, const fw_probe *probe, int mode,
                            double times, fw_verdict_requirement *r);
/* required_small.c: relative, by the energies that flexures have of what the probe's unit load displaces; why a band has no
   ends, and what would give it some */
fw_status fw_verdict_small_off(fw_arena *arena, const fw_mechanism *m,
                               const fw_statics_modes *modes, const fw_probe *p, double *off);
const char *fw_verdict_small_open(fw_arena *arena, const fw_mechanism *m,
                                  const fw_statics_modes *modes, const fw_verdict_small_others *);
/* the largest in the scene: (nbody) ways of centres, then turns, then (nhinge) angles */
void fw_verdict_farthest(const fw_mechanism *m, const fw_dynamics_motion *x, double *far);
/* moved_again.c: what of v->shaken[scene] grows where what takes hold again and again meets other phases (FW-D685) */
fw_status fw_verdict_thrown_again(fw_arena *arena, const fw_mechanism *m, int scene,
                                  const fw_dynamics_motion_options *o, bool brief, fw_diags *diags,
                                  fw_verdict_variant_verdict *v);
/* v->shaken, whose factors are 1 where no law goes to and fro and loads leave most of the stiffness; bodies (nscene): share
   that they give (fw_verdict_bending_share). Warnings (FW-D642, FW-D672), and what may meet then, or may not, is undecided */
fw_status fw_verdict_detune(fw_arena *arena, const fw_mechanism *m, const double *bodies,
                            const fw_dynamics_motion_options *o, const fw_verdict_required *of,
                            bool brief, fw_diags *diags, fw_verdict_variant_verdict *v);
/* may what the clearance is of meet where everything goes up to `by` times as far? */
bool fw_verdict_may_come(const fw_verdict_clearance *clearance, double by);
/* a copy that lives as long as the arena; NULL where nothing was run */
fw_status fw_verdict_shaken_keep(fw_arena *arena, const fw_verdict_variant_verdict *v,
                                 const fw_verdict_shaken **kept);

/* ---- verdict_scene.c: what the motion has and the masks lack ---- */

/* reasons of v */
fw_status fw_verdict_missing(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             fw_verdict_variant_verdict *v);
/* a reason of v where flexures are strained in the pose in which masks draw them (FW-D622) */
fw_status fw_verdict_bent(fw_arena *arena, const fw_device *device, fw_verdict_variant_verdict *v);
/* Such a motion is that of another device: reasons from `first` on, requirements and what meets in scenes are left open
   where they reject. What the drawing, required poses and the plane's other side say holds all the same. */
void fw_verdict_bent_leaves_open(fw_verdict_variant_verdict *v, int first);
/* verdict_run.c: the masks contradict the motion: no value of a number, of a load or of a flexure mends that. *why: what does */
bool fw_verdict_no_number_helps(const fw_verdict *verdict, const char **why);

/* required_small.c: instants whose equilibria stand for all along the laws of a scene, its end first; 1: nothing of it goes with
   time, 0: there are more than these. between: in the middle of any two neighbours, too */
enum { FW_VERDICT_INSTANTS = 24 };
int fw_verdict_instants(const fw_mechanism *mechanism, const fw_device_scene *scene, bool between,
                        double at_s[FW_VERDICT_INSTANTS]);
/* required_small.c: how long one must look to see what laws do that still change where the scene ends: a period, and no less
   than a quarter of the scene; 0: loads have stayed as they are. Test: test_probe.py */
double fw_verdict_laws_go_on_s(const fw_mechanism *mechanism, const fw_device_scene *scene);
/* judges what is required about one equilibrium, that of `s` where it ends */
typedef fw_status fw_verdict_judge_small(fw_arena *arena, const fw_mechanism *mechanism,
                                         const fw_dynamics_motion_options *options,
                                         const fw_device_scene *s, int scene,
                                         fw_verdict_variant_verdict *v);
/* what is required of equilibria of a scene (FW_NONE: of none, at rest), at the worst of these */
fw_status fw_verdict_requirements_along(fw_arena *arena, const fw_mechanism *mechanism,
                                        const fw_dynamics_motion_options *options, int scene,
                                        fw_verdict_judge_small *judge,
                                        fw_verdict_variant_verdict *v);

/* ---- verdict_requirement.c: what the device is for ---- */

/* which requirements there are in this flow, before anything is run: v->requirement */
fw_status fw_verdict_requirements_list(fw_arena *arena, const fw_mechanism *mechanism,
                                       fw_verdict_variant_verdict *v);
/* probe monitors of both runs of scene i; *monitor NULL where no probe has a course in it. required: those alone that a
   requirement reads there, since nobody sees the others */
fw_status fw_verdict_requirements_watch(fw_arena *arena, const fw_mechanism *mechanism, int scene,
                                        const fw_verdict_variant_verdict *v, bool required,
                                        fw_probe_monitor *monitor[2]);
/* decision.c: which bound is the trouble: the one that the band reaches over, of both the nearer one */
bool fw_verdict_requirement_below(const fw_verdict_requirement *r);
/* "stroke (final) is 47.9 um (46.7 um to 49 um), and at least 40 um is required" */
const char *fw_verdict_requirement_text(fw_arena *arena, const fw_verdict_requirement *r);
/* of a motion that was made and seen by these: v->probed and its requirements */
fw_status fw_verdict_requirements_of_scene(const fw_mechanism *mechanism, int scene,
                                           const fw_probe_monitor *monitor,
                                           const fw_probe_monitor *looser,
                                           fw_verdict_variant_verdict *v);
/* those of equilibria; reasons of all that are not met */
fw_status fw_verdict_requirements_end(fw_arena *arena, const fw_mechanism *m,
                                      const fw_dynamics_motion_options *o,
                                      fw_verdict_variant_verdict *v);
/* resonance.c: what a mode that lies elsewhere may do to one of a motion: the most of the factors, which widen it.
   required_small.c: its band takes in what it is in the motions of shaken->other */
void fw_verdict_requirement_factor(const double *factor, int nhinge, double most[2]);
fw_status fw_verdict_requirement_others(const fw_verdict_variant_verdict *v,
                                        const fw_verdict_shaken *shaken, fw_verdict_requirement *r);
/* moved_again.c: its band holds what formulas of effects lack in its scene; and why what is then undecided is (FW-D753) */
fw_status fw_verdict_requirement_lacking(const fw_verdict_variant_verdict *v,
                                         fw_verdict_requirement *r);
fw_status fw_verdict_tell_lacking(fw_arena *arena, fw_verdict_variant_verdict *v);
/* verdict_bending.c: what bands of a device that is not drawn are without, by name */
fw_status fw_verdict_bending_name_rigid(fw_arena *arena, fw_verdict_variant_verdict *v);
void fw_verdict_requirement_widen(double down, double up, fw_verdict_requirement *r);
void fw_verdict_pull_number(const fw_mechanism_drying *drying, fw_verdict_pull *to);
bool fw_verdict_requirement_shaken(const double factor[2], double late, fw_device_measure measure,
                                   fw_verdict_requirement *r);
/* what may still decide those that are inconclusive, and the accuracy that would */
fw_verdict_refinement fw_verdict_requirements_refinement(const fw_verdict_requirement *requirement,
                                                         int count);
double fw_verdict_requirements_enough(const fw_verdict_requirement *requirement, int count,
                                      double accuracy);

/* ---- verdict_corners.c, corner_search.c: devices at points of the ranges of a flow ---- */

/* a device that was run before: whatever the ranges, the same device comes of the same fabrication */
typedef struct fw_verdict_known {
    fw_verdict_fabrication made;
    const fw_verdict_fabricated_corner *corner;
    const double *ln; /* (ncheck) */
} fw_verdict_known;

/* One end of the band of a requirement, and how it goes with the inputs. z: the end itself, or where it
   has one sign everywhere sign ln(sign end), which grows with it and is nearer to a straight line. */
typedef struct fw_verdict_end {
    int sign;                            /* 0: z is the end */
    double slope[FW_FABRICATION_INPUTS]; /* dz/dx about the nominal */
    double error;                        /* largest difference from first order seen at a corner */
    double apart
        [2]; /* what hinges that differ may change of z, and of the end itself, all of them together */
} fw_verdict_end;

/* a point that was run before it is asked for: its own x (ninput) and sign, which outlive the search's next step */
typedef struct fw_verdict_ahead {
    const double *x;
    const signed char *sign;
    int most_looks;
    fw_verdict_fabricated_corner corner;
    double *ln; /* (ncheck) */
} fw_verdict_ahead;
typedef struct fw_verdict_search {
    fw_arena *arena;                      /* of the plan */
    struct fw_verdict_by_value *by_value; /* NULL: margins are with the bands that corners need */
    const fw_device *device;
    const fw_layout *layout;
    fw_verdict_options options;
    const fw_verdict_variant_verdict *v; /* as drawn */
    fw_verdict_fabricated_verdict *fabricated;
    int ncheck; /* hinge k in scene i: k (nscene + 1) + i; then pull-in of every scene, then
                   requirements, then clearance of every scene and every required box; from `nplane` on those across
                   the plane, which only count near their limits */
    int nplane;
    double across_error; /* as fabricated->error, of those across the plane */
    bool tipping;        /* fw_verdict_across_counts */
    bool clearances; /* some pair uses so much of its distance that corners are asked how much */
    bool nearest;    /* the nearest of a scene or box does: its distance is found at corners */
    double *ln; /* (points x ncheck) ln of the utilisation at each point that was run; NaN: none */
    unsigned *bits; /* (points) of a corner, bit i: input i is high; FW_NO_CORNER: no corner */
    const fw_verdict_known *known; /* (nknown) */
    int nknown;
    const signed char *sign; /* how hinges differ at what is run now; NULL: not at all */
    fw_verdict_ahead *ahead; /* (nahead) points that were run before they are asked for */
    size_t nahead;
    int most_looks; /* at a point, each closer than the one before; 0: as many as its decision needs */
    int judged;     /* points that were run, and not known */
    fw_progress_whole *told; /* how many points were run, of how many at most */
    int first;               /* how many points there were when the slopes were known */
    double *slope;           /* (ncheck x ninput) d ln U / dx about the nominal; NaN: none */
    /* of each input: that whose slopes were taken, scaled by the edges, and the point where it was off
       its nominal value; FW_NONE: no range */
    int slope_like[FW_FABRICATION_INPUTS], slope_point[FW_FABRICATION_INPUTS];
    fw_verdict_end *end; /* (2 nrequirement) low and high of each band */
} fw_verdict_search;

enum {
    FW_MOST_APART = 16, /* points where hinges differ */
    FW_MOST_POINTS = 2 + FW_RANGED_INPUTS + (1 << FW_RANGED_INPUTS) + FW_MOST_APART
};
#define FW_NO_CORNER (~0u)
/* checks below this share of their limits are of no account to estimates; so are those across the plane, of which nothing
   is told but whether they are beyond */
#define FW_FAR_BELOW    0.1
#define FW_FLAT_BELOW   0.5
#define FW_NEAR_TIPPING 0.97 /* both are bounds; what forces may be off by is little beside this */

/* for ranges of v; options are those of the drawn device's verdict */
/* what contacts of the flow's scenes touch and no mask draws (fabrication.c): the id of the first of which nobody said
   whether it is placed or etched, or NULL; a copy of the device in which it is said; the sentences of FW-D656, behind
   what list holds already. Test: test_not_drawn.c */
const char *fw_verdict_undrawn_not_said(const fw_device *device, const fw_layout *layout,
                                        const char *flow);
/* fabrication.c: does an outline of the body come as near as this? A body of which nothing is drawn is taken to be of the layer. */
bool fw_verdict_comes_near(const fw_layout *layout, int body, fw_geometry_vec2 at,
                           double distance_m);
/* are both sides of a contact part of the layer, as far as outlines say? */
bool fw_verdict_contact_drawn(const fw_device *device, const fw_layout *layout,
                              const fw_device_contact_use *contact);
fw_status fw_verdict_undrawn_as(fw_arena *arena, const fw_device *device, fw_device_undrawn undrawn,
                                const fw_device **as);
fw_status fw_verdict_undrawn(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             fw_verdict_from_outside *list, int *n);
fw_status fw_verdict_search_begin(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                                  const fw_verdict_options *options,
                                  const fw_verdict_variant_verdict *v, fw_verdict_search *s);
fw_status fw_verdict_search_most(fw_verdict_search *s); /* s->told */
/* the nominal device, its slopes, the corners that may govern; all corners where first order is not
   to be trusted */
fw_status fw_verdict_search_corners(fw_verdict_search *s);
/* after it: the corners where a check is highest and lowest to first order, where they were not run */
fw_status fw_verdict_search_ends(fw_verdict_search *s, int check);
/* ---- requirement_corners.c: the bands of requirements over all corners ---- */

void fw_verdict_ends_slopes(fw_verdict_search *s); /* of the points that were run for slopes */
/* after a corner was run: what its bands are off first order */
void fw_verdict_ends_compare(fw_verdict_search *s, int point);
bool fw_verdict_ends_unknown(const fw_verdict_search *s); /* a requirement without a slope */
/* one hinge alone is narrower than at a point that was run: what that changes adds up; and a point where all differ */
void fw_verdict_ends_apart(fw_verdict_search *s, int point,
                           const fw_verdict_fabricated_corner *narrower);
/* the corner to be run next so that the bands hold at all of them; FW_NO_CORNER: none */
unsigned fw_verdict_ends_next(const fw_verdict_search *s);
/* s->fabricated->requirement */
fw_status fw_verdict_ends_made(fw_verdict_search *s);
/* fabrication.c: what stays of the stators of one that was run; low_m of v->stator at all corners, run or not */
fw_status fw_verdict_stators_keep(fw_arena *arena, const fw_verdict_variant_verdict *now,
                                  fw_verdict_fabricated_corner *corner);
void fw_verdict_stators_made(const fw_verdict_search *s, fw_verdict_variant_verdict *v);
/* held_ranges.c: how far the band of a hinge reaches above its utilisation, as a factor, where it was run */
double fw_verdict_band_above(const fw_verdict_search *s, int hinge);
/* s->fabricated->room, after fw_verdict_ends_made and the bounds of hinges */
fw_status fw_verdict_edge_room_made(fw_verdict_search *s);
/* why a corner is not accepted; a requirement with its band over all corners, as tables have it. NULL: no memory */
const char *fw_verdict_ends_why(fw_verdict_search *s, int corner);
double fw_verdict_search_used_nearest(const fw_verdict_clearance *c);          /* body_farther.c */
double fw_verdict_search_used(const fw_verdict_clearance *c, bool by_nearest); /* its share */
/* fabrication.c, corner_search.c and requirement_corners.c, shared */
/* requirement_corners.c: shaken of a point with its modes anywhere */
fw_status fw_verdict_anywhere(const fw_verdict_search *s, int scene, int point,
                              fw_verdict_shaken *to);
/* body_shaken.c: may a point be the most that any device does? */
bool fw_verdict_leads(const fw_verdict_search *s, int scene, int point);
/* held_ranges.c: bands as made hold what a device between corners does that meets a resonance; where all corners are accepted
   s->fabricated and v may then be undecided, with a reason (FW-D636, FW-D731) */
fw_status fw_verdict_between_corners(fw_verdict_search *s, fw_verdict_variant_verdict *v);
bool fw_verdict_row_settle(
    fw_verdict_requirement *made); /* undecided where its band is beyond; true: it was accepted */
/* has any clearance (by_nearest: any by its nearest pair) used so much that a corner may take the rest? */
bool fw_verdict_search_clearances_count(const fw_verdict_variant_verdict *v, bool by_nearest);
bool fw_verdict_search_has_range(const fw_verdict_fabrication_input *in);
/* inputs that change nothing but edges have the same slopes, scaled */
bool fw_verdict_search_edges_only(const fw_verdict_fabrication_input *in);
void fw_verdict_search_corner_point(const fw_verdict_search *s, unsigned bits, double *x);
unsigned fw_verdict_search_without_range(const fw_verdict_variant_verdict *v);
int fw_verdict_search_find(const fw_verdict_search *s, unsigned bits); /* a point, or FW_NONE */

/* what the corners that were run say: decision, governing hinge and corner of s->fabricated */
void fw_verdict_search_govern(fw_verdict_search *s);
/* runs the device at x and keeps it as the next corner of s->fabricated */
fw_status fw_verdict_search_run(fw_verdict_search *s, const double *x, unsigned bits);
/* of a trial, the points that are suspected first; decided: nothing else is to be run */
fw_status fw_verdict_search_suspects(fw_verdict_search *s, bool *decided);
/* the same as fw_verdict_search_run into `corner` and ln (ncheck), without keeping it */
fw_status fw_verdict_search_point(const fw_verdict_search *s, const double *x,
                                  fw_verdict_fabricated_corner *corner, double *ln);
/* Points that are asked for next: where threads help they are run at once, and fw_verdict_search_run and _point find them
   done. At x (n x ninput); sign (n), or NULL: hinges differ as in s */
fw_status fw_verdict_search_ahead(fw_verdict_search *s, const double *x,
                                  const signed char *const *sign, size_t n);
/* "12.5 um": a value of an input in the unit of its process pack */
const char *fw_verdict_search_value_text(fw_arena *arena, const fw_verdict_fabrication_input *input,
                                         double x);
/* held_ranges.c: what would have to be held so that it accepts: fabricated->held and control; what nobody knows (FW-D694) */
fw_status fw_verdict_fabrication_control(fw_verdict_search *s);
fw_status fw_verdict_not_known(fw_arena *a, const fw_verdict_variant_verdict *v, const char **text);
/* ---- verdict_clearance.c: what clearance/ finds, judged: bands, what is asked for, and reasons ---- */

/* one stator alone against all that moves: what shorts the drive */
typedef struct fw_verdict_stator_watch {
    const char *label;
    fw_clearance_things things;
    fw_clearance_least least;
} fw_verdict_stator_watch;

typedef struct fw_verdict_clearance_watch { /* of one run of a scene */
    const fw_clearance_things *things;      /* NULL: nothing is drawn */
    fw_arena *arena;
    fw_clearance_path path;
    fw_clearance_wish wish;
    fw_clearance_least least;        /* of what has left the path */
    bool ways;                       /* is `way` asked for? */
    double within_m;                 /* what is asked for, with what walls take */
    fw_clearance_way way;            /* to that, of what has left the path */
    bool parts;                      /* something has, before the motion's end */
    fw_verdict_stator_watch *stator; /* (nstator) */
    int nstator;
    const bool *among; /* (nsolid x nsolid) all pairs but those with what stands */
    fw_status status;
} fw_verdict_clearance_watch;

/* room for all scenes of a variant; layout may be NULL. with_stators: each is looked at by itself, too */
fw_status fw_verdict_clearance_begin(fw_arena *arena, const fw_layout *layout,
                                     const fw_mechanism *mechanism, bool with_stators,
                                     fw_verdict_clearance_watch watch[2],
                                     fw_verdict_variant_verdict *v);
/* which pairs the scene lets meet */
fw_status fw_verdict_clearance_scene(const fw_mechanism *m, const fw_device_scene *scene,
                                     fw_verdict_clearance_watch watch[2]);
/* an fw_dynamics_tracer; context is the strain monitor */
void fw_verdict_clearance_trace(void *context, const fw_dynamics_piece *piece);
/* Scene i, whose motion is v->motion[i]: its clearance, and a reason where it is not accepted.
   brief: only whether it is, which is proved with a fraction of the distances. */
fw_status fw_verdict_clearance_judge(fw_arena *arena, const fw_device_scene *scene, int i,
                                     const fw_layout *layout, bool brief, fw_diags *diags,
                                     fw_verdict_variant_verdict *v);
/* every required box of the flow that can be reached as a whole; after fw_workspace_required */
fw_status fw_verdict_clearance_boxes(fw_arena *arena, const fw_device *device,
                                     const fw_layout *layout, bool brief,
                                     fw_verdict_variant_verdict *v);
/* every flexure against its own two bodies; after the hinges */
fw_status fw_verdict_clearance_strips(fw_arena *arena, const fw_layout *layout,
                                      fw_verdict_variant_verdict *v);

/* of any scene the most of fw_verdict_bending_share, for small motions of which no forces are known */
double fw_verdict_bending_of_any(const fw_verdict_variant_verdict *v);
/* body_solids.c: u (3 nbody) by which a load f (3 nbody) displaces, by modes that are all there and stable */
void fw_verdict_displaced(const fw_statics_modes *modes, const double *f, double *u);
#endif
