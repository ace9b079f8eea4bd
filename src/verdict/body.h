/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies under all that acts on them at once: ways that go together, as beams and as solids, and how much farther a place goes;
   and what rings on. Private to the room. */
#ifndef FW_VERDICT_BODY_H
#define FW_VERDICT_BODY_H
#include "geometry/segment.h"
#include "statics/statics.h"
#include "verdict/strain.h"
#include <math.h>

#define FW_VERDICT_HARDLY_MOVES                                                                    \
    0.05 /* of the farthest way: what goes less counts with no share of its own */

/* Where ways of one body go together they bear together what comes by each of them: body_together.c */
typedef struct
    fw_verdict_arm_end { /* of a hinge, or where a load acts: pin and root are that place */
    fw_verdict_arm *to;
    int index; /* of the arm */
    fw_geometry_vec2 pin, root;
} fw_verdict_arm_end;
/* outlines whose ways all lead to a middle: to the cell nearest to it, nearer by `deep` times its distance from the edge */
typedef struct fw_verdict_drawn {
    fw_mechanism_line *line;
    int nline;
    fw_geometry_vec2 middle;
    double deep;
    int finest; /* grids that are tried at most, each of cells half as wide */
    double
        foot_m; /* length of the straight cut whose middle that is, and beyond which the frame gives; 0: none */
    fw_geometry_vec2 along; /* of that cut, a unit vector */
} fw_verdict_drawn;
/* body_arms.c: arms of ends, of hinges (nhinge), then of loads, n in all; hole_m: of release holes */
fw_status fw_verdict_arms_of(fw_arena *scratch, fw_arena *kept, const fw_verdict_drawn *from,
                             fw_verdict_arm_end *ends, int nhinge, int n, double hole_m);

/* body_drawn.c: arm[].base of all ends on the ground (2 nhinge) */
fw_status fw_verdict_bases(fw_arena *arena, const fw_mechanism *mechanism, const fw_layout *layout,
                           fw_verdict_arm *arm);
bool fw_verdict_has_bases(const fw_mechanism *mechanism, const fw_verdict_arm *arm);
/* J that they store, on: (3 nhinge) moment of the flexure and force on body b of each; end: (6 nhinge) room */
double fw_verdict_bases_J(const fw_mechanism *mechanism, const fw_verdict_arm *arm, double stiff_N,
                          const double *on, double *end);
/* bending->bases_J */
void fw_verdict_bases_record(fw_verdict_bending *bending, const fw_mechanism *mechanism,
                             const fw_dynamics_instant *now);
/* what a flexure gives (3 x 3; x, y, turn, at its pin) with the bases that it stands on */
void fw_verdict_bases_add(const fw_mechanism *mechanism, const fw_verdict_arm *arm, int hinge,
                          double gives[9]);
/* FW-D510 where bases give most; share: two numbers with their units, of all that give, and of bases */
void fw_verdict_bases_tell(const fw_mechanism *mechanism, const fw_verdict_arm *arm,
                           const fw_device_scene *scene, const char *const share[4],
                           fw_diags *diags);

typedef struct fw_verdict_shared {
    fw_geometry_vec2 about; /* world, as drawn */
    int first;              /* the first of its ends */
    struct fw_verdict_trunk {
        double give[6];                /* as an arm's, about `about` */
        int n, *end;                   /* indices of arms */
        const fw_verdict_strip *strip; /* (nstrip) */
        int nstrip;
        bool counts; /* several, and it is more than a 200th of a way */
    } * trunk;
    int n;
    bool counts;
} fw_verdict_shared;
/* shared of a body's ends (n): of every one of them, or NULL; cell: of the grid of ways */
fw_status fw_verdict_ways_meet(fw_arena *arena, const fw_verdict_arm_end *end, int n, double cell,
                               fw_geometry_vec2 about);
/* By how much more trunks store by what all ends put on them than by each, J, where that is more. w (3 for each arm, nw of them;
   the rest bear nothing): (M, Fx, Fy) about `about`, axes as drawn */
double fw_verdict_shared_J(const fw_verdict_shared *shared, double stiff_N, const double *w,
                           int nw);
/* w.give.w/(2 E h) as it is, J */
double fw_verdict_arm_J(const fw_verdict_arm *arm, double stiff_N, const double w[3]);
/* what a hinge puts on its end 2 k + side about its pin, in the axes in which the body was drawn; on: the flexure's moment and
   the force on body b, world */
void fw_verdict_end_put(const double on[3], int side, const fw_verdict_turn *turn, double w[3]);
/* the same wrench about another place */
void fw_verdict_wrench_about(fw_geometry_vec2 pin, fw_geometry_vec2 about, const double w[3],
                             double to[3]);

/* what acts on a body beside its hinges: at (n), of which those on it count; end: (3 nend) for each arm, room */
typedef struct fw_verdict_places {
    int body, n, nend;
    const fw_verdict_place *at;
    double *end;
} fw_verdict_places;
/* body_together.c: J of a body as beams at an instant as fw_verdict_solid_kept has it, with what acts at its places; the least
   of what is in balance with all of that. *meet_J: what its hinges' ways store together beyond each by itself; *aside_J: the
   ways of its places alone */
double fw_verdict_beams_J(const fw_mechanism *mechanism, const fw_verdict_arm *arm, double stiff_N,
                          const double *instant, const fw_verdict_turn *turn,
                          const fw_verdict_places *places, double *meet_J, double *aside_J);

/* What a flow leaves of a width whose edges stand out by edge_m, of a body that bends; never more than is drawn, since bands
   hold what the drawn one gives, too. A quarter of it at least: what is cut through is told (corner_search.c) */
static inline double fw_verdict_made_m(double wide_m, double edge_m) {
    return fmax(wide_m + 2 * fmin(edge_m, 0), 0.25 * wide_m);
}
/* body_together.c: the same arms of the drawn device with all edges in by -edge_m; *made: those, or arm where edges stand out */
fw_status fw_verdict_arms_made(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_verdict_arm *arm, double edge_m,
                               const fw_verdict_arm **made);
/* how many times as much a body gives as its drawn solid, at most: by what hinges put on it, by all that acts on it */
void fw_verdict_softer(const fw_mechanism *mechanism, const fw_verdict_arm *arm,
                       const fw_verdict_bending *bending, int body, double to[2]);
/* why nothing, or one face of nothing, is left of a body's way at its narrowest; NULL: something is */
fw_status fw_verdict_body_cut(fw_arena *arena, const fw_mechanism *mechanism,
                              const fw_verdict_arm *arm, double edge_m, double flare_m,
                              const char **why);
/* body_loads.c: a stated force on the very place of a displacement that is asked for; by how much that may be less and more for
   what hangs over by such forces, m */
bool fw_verdict_bends_own(const fw_mechanism_load_end *end, int scene,
                          const fw_device_probe *probe);
fw_status fw_verdict_bends_asked(fw_arena *arena, const struct fw_verdict_variant_verdict *v,
                                 int scene, const fw_verdict_hung *hung,
                                 const fw_device_probe *probe, double *down, double *up,
                                 double *rings_m);

/* ---- body_solids.c: what bodies store by all that acts on them, as beams and as solids ---- */
typedef struct fw_verdict_solids {
    const fw_mechanism *m;
    const fw_layout *layout;
    const fw_verdict_arm *arm;
    const fw_mechanism_solid *solid; /* (nbody) */
    double stiff_N;
    double *w, *each; /* room for wrenches; (2 nbody) */
    double *end;      /* (3 nend) what acts on each end of an arm, about its own place */
    int nend;
} fw_verdict_solids;
fw_status fw_verdict_solids_new(fw_arena *arena, const struct fw_verdict_variant_verdict *verdict,
                                fw_verdict_solids *solids);
/* both: J at an instant as fw_verdict_solid_kept has it, with what acts at the places of b, as beams and as solids where these
   are known. *mixed: the second is no form in what acts, but at least what bodies store */
void fw_verdict_solids_J(const fw_verdict_solids *solids, const fw_verdict_bending *b,
                         const double *instant, double both[2], bool *mixed);
/* on (3 nhinge): moment of each flexure, and force on its body b, by a force of 1 N at a place of a body at rest */
fw_status fw_verdict_unit_load(fw_arena *arena, const fw_verdict_solids *solids,
                               const fw_statics_modes *modes, int body, fw_geometry_vec2 at,
                               double direction_rad, double *on);
/* body_farther.c: by how much a displacement may be less and more than of rigid bodies by all that bodies give in a scene, m,
   0 where that is not known. direction_rad: NaN, any. *soft is looked for where it is not known yet */
struct fw_verdict_soft;
fw_status fw_verdict_goes_farther(fw_arena *arena, const struct fw_verdict_variant_verdict *verdict,
                                  int scene, const fw_device_probe *probe, double direction_rad,
                                  struct fw_verdict_soft *soft, double *down, double *up,
                                  bool *known);
/* it goes by what bodies bend beside their hinges; and is what hangs over asked for in any scene? */
struct fw_verdict_requirement;
bool fw_verdict_moves(const struct fw_verdict_requirement *requirement);
bool fw_verdict_asks_hung(const struct fw_verdict_variant_verdict *verdict);
fw_status fw_verdict_say_bent(fw_arena *arena, struct fw_verdict_variant_verdict *verdict,
                              const char *scene, int number, const char *what, int body,
                              double by_m);

/* ---- body_together.c, strain_monitor.c (at the end): what bodies bear in the course of a scene that is repeated ---- */

/* Rows: of each end of a hinge its stress times thickness, N/m; of each body the force, then the moment, that its hinges put on
   it together; of each place what acts there, N. Four signed courses of each */
typedef struct fw_verdict_courses {
    fw_arena *arena;
    fw_maths_turning (*row)[FW_FACES]; /* (n) */
    double *gate;                      /* (n) turns below it are none */
    double *
        lasts; /* (n) in units of the row: the amplitude, fully reversed, which once a repetition fatigues as much; 0: nothing does */
    int n;
} fw_verdict_courses;
static inline int fw_verdict_course_of_force(const fw_mechanism *m, int body) {
    return 2 * m->nhinge + body;
}
static inline int fw_verdict_course_of_moment(const fw_mechanism *m, int body) {
    return 2 * m->nhinge + m->nbody + body;
}
static inline int fw_verdict_course_of_place(const fw_mechanism *m, int place) {
    return 2 * m->nhinge + 2 * m->nbody + place;
}
fw_status fw_verdict_courses_new(fw_arena *arena, const fw_mechanism *m, fw_verdict_bending *b);
/* at every instant, behind all else that is recorded of bodies; NULL where the run starts */
void fw_verdict_courses_record(fw_verdict_bending *b, const fw_mechanism *m,
                               const fw_dynamics_instant *now);
/* once the run has ended, and what rings on is known: lasts */
fw_status fw_verdict_courses_end(fw_arena *arena, fw_verdict_strain_monitor *monitor);
/* how many times as much of its fatigue limit one fully reversed stress a repetition uses as of its static one; 0: nothing is
   repeated, or one of both is not known */
double fw_verdict_tires(const fw_mechanism *m, int hinge);
/* body_bears.c: "what is allowed", by_fatigue: by the fatigue limit; NULL: FW_NOMEM */
const char *fw_verdict_allowed_words(fw_arena *arena, const fw_mechanism *m, bool by_fatigue);

/* the largest of n that are at least 0 */
static inline double fw_verdict_most_of(const double *x, int n) {
    double most = 0;
    for (int i = 0; i < n; i++)
        most = fmax(most, x[i]);
    return most;
}
/* a.M b of motions (3 nbody) of the bodies' centres */
static inline double fw_verdict_mass_form(const fw_mechanism *m, const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < 3 * m->nbody; i += 3)
        sum += m->body[i / 3].mass_kg * (a[i] * b[i] + a[i + 1] * b[i + 1]) +
               m->body[i / 3].inertia_kg_m2 * a[i + 2] * b[i + 2];
    return sum;
}

/* ---- ringing.c, resonance.c ---- */

/* of a mode: as the motion has it, and by the ends of a loss factor that is known within limits */
typedef enum fw_verdict_damped {
    FW_VERDICT_AS_DAMPED,
    FW_VERDICT_LEAST_DAMPED,
    FW_VERDICT_MOST_DAMPED
} fw_verdict_damped;
static inline double fw_verdict_damping_of(const fw_statics_mode *mode) { /* NaN: 0 */
    const double is = mode->damping_ratio > 0 ? mode->damping_ratio : 0;
    return is < 0.99 ? is : 0.99;
}

/* times as much as computed: up >= 1, down <= 1; up of what strains */
typedef struct fw_verdict_answer {
    double up, down, strained;
} fw_verdict_answer;
/* What another frequency says of how far loads move a device, by the square of w0/w. Of any stiffness: all of that, which the
   softest of a range may be. Among the softest, where it is known how far it goes: what is higher goes less far. What bends
   a hinge beyond its limit is a stress as often, which the modulus does not change: of hinges nothing is less */
typedef enum fw_verdict_softness {
    FW_VERDICT_AS_STIFF,
    FW_VERDICT_OF_ANY,
    FW_VERDICT_NO_SOFTER
} fw_verdict_softness;
static inline double fw_verdict_soft_by(fw_verdict_softness soft, double omega,
                                        double at) { /* of ways */
    const double by = omega * omega / (at * at), less = by < 1 ? by : 1;
    return soft == FW_VERDICT_OF_ANY ? by : soft == FW_VERDICT_NO_SOFTER ? less : 1;
}
/* ringing.c: by no more than stiffness allows of where the mode may lie */
struct fw_verdict_shaken_mode;
double fw_verdict_soft_within(fw_verdict_softness softer, const struct fw_verdict_shaken_mode *mode,
                              double at);
/* ringing.c: to->mode, of at most most_modes, without low and high, and what acts where something comes again */
fw_status fw_verdict_swings(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                            bool again, const fw_statics_modes *modes,
                            const fw_dynamics_motion *motion, int most_modes,
                            struct fw_verdict_shaken *to);
/* to (rows = nhinge + nbody + nreach): what comes again does to all while a mode, or all (FW_NONE) by one share, lie elsewhere */
fw_status fw_verdict_rings_again(fw_arena *arena, const fw_quantity_law_pieces *pieces,
                                 double end_s, const struct fw_verdict_shaken *shaken, int mode,
                                 int rows, fw_verdict_softness softer, fw_verdict_answer *to);
/* does something of it come while a mode may still ring by what came before? pieces: only where it does */
fw_status fw_verdict_comes_again(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *s,
                                 bool *again, fw_quantity_law_pieces *pieces);
/* body_solids.c: small motions; *modes NULL: there are none */
fw_status fw_verdict_modes_about(fw_arena *arena, const fw_mechanism *mechanism,
                                 const fw_device_scene *scene, bool at_equilibrium, double accuracy,
                                 const fw_statics_modes **modes);
/* factors (2 x (nhinge + 1)), each (as in shaken) and `late` for modes anywhere between their low and high */
fw_status fw_verdict_shaken_within(fw_arena *arena, const fw_mechanism *mechanism, int scene,
                                   const struct fw_verdict_shaken *shaken,
                                   fw_verdict_softness softer, double *factor, double *each,
                                   double *late);

/* body_swing.c: the first modes in the plane at rest with bodies as beams from their middles on, as they are computed (5e) */
typedef struct fw_verdict_swung {
    fw_verdict_beams beams;
    int n;
    double *s2;       /* (n) 1/omega^2, the largest first */
    double *flexures; /* (n) share of the strain energy that flexures store */
    double (*goes)
        [3]; /* (n x beams.n) of beams, by a mode of mass 1: (m, m, rad)/sqrt(kg), axes as drawn */
    double (*opens)[3]; /* (n x nhinge) of flexures at their pins */
} fw_verdict_swung;
/* swung (n = 0: *why, or no mode was found); why: as fw_verdict_slowest_swings has it */
fw_status fw_verdict_swung_modes(fw_arena *arena, const fw_mechanism *mechanism,
                                 const fw_verdict_arm *arm, int count, fw_verdict_swung *swung,
                                 const char **why);
/* body_together.c: how far one unit of each driver that moves, then of heats, then the stress of layers, hold every body from where it
   rests (n x 3 nbody), and their laws (n); unknown: what holds it nowhere that was found, or NULL */
typedef struct fw_verdict_held_ways {
    const double *way;
    fw_quantity_law_load *load;
    int n;
    const char *unknown;
} fw_verdict_held_ways;
int fw_verdict_laws_held(const fw_mechanism *mechanism, const fw_device_scene *scene,
                         fw_quantity_law_load *load);
fw_status fw_verdict_ways_held(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_device_scene *scene, fw_verdict_held_ways *held);

/* body_shaken.c: of a device, for all of its scenes */
typedef struct fw_verdict_own {
    bool looked[2]; /* for modes, and for w */
    fw_verdict_swung *w;
    const fw_statics_modes *modes; /* of rigid bodies, at rest */
} fw_verdict_own;
/* What bodies do by modes of their own in a scene, beside what the motion has */
typedef struct fw_verdict_swinging {
    const fw_verdict_swung *w;
    double *far,
        *fast; /* (w->n) amplitudes of modes, m sqrt(kg) and that over s; 0: rigid bodies have it */
    double *way_m;  /* (nbody) how far any place of a body goes */
    double share;   /* of what bends, or moves, most in the motion */
    double slow_Hz; /* from where on these modes lie */
    bool shaken;    /* a law goes to and fro */
} fw_verdict_swinging;
/* do the same contacts, stops and cables hold both where their modes are asked for? else these are not the same modes */
bool fw_verdict_held_alike(const struct fw_verdict_shaken *a, const struct fw_verdict_shaken *b);
/* Adds it to factors of hinges, to `each` of v->shaken[scene], whose ways are known, and puts it there (`own`) */
fw_status fw_verdict_bodies_swing(fw_arena *arena, int scene, bool shaken, fw_verdict_own *own,
                                  struct fw_verdict_variant_verdict *v);
/* *may: they may by more than a hundredth of what the motion has, of hinges alone by what plain ways may leave out; gives: share that
   bodies give in it */
fw_status fw_verdict_may_swing(fw_arena *arena, const struct fw_verdict_variant_verdict *v,
                               int scene, bool shaken, double gives, fw_verdict_own *own,
                               bool *may);
/* own->modes */
fw_status fw_verdict_own_modes(fw_arena *arena, const struct fw_verdict_variant_verdict *v,
                               fw_verdict_own *own);
/* mode k at a place of a body as drawn: (m, m, rad)/sqrt(kg) */
static inline void fw_verdict_swung_there(const fw_verdict_swung *swung, int k, int body,
                                          fw_geometry_vec2 at, double u[3]) {
    const fw_verdict_beams *b = &swung->beams;
    int best = b->first[body];
    for (int i = best + 1; i < b->first[body + 1]; i++)
        if (vec_distance(b->at[i].at, at) < vec_distance(b->at[best].at, at)) best = i;
    const fw_geometry_vec2 r = vec_sub(at, b->at[best].at);
    const double *of = swung->goes[(size_t)k * (size_t)b->n + (size_t)best];
    u[0] = of[0] - of[2] * r.y, u[1] = of[1] + of[2] * r.x, u[2] = of[2];
}
/* body_farther.c: ways to what may be met and electrodes have it; a warning (FW-D741) */
fw_status fw_verdict_swings_tell(fw_arena *arena, int scene, bool brief, fw_diags *diags,
                                 struct fw_verdict_variant_verdict *v);

/* moved_again.c: what a scene that is moved again changes: f (2 x (nhinge + 1)), more and less of every hinge, and of what goes
   farthest; far and now of fw_verdict_farthest */
typedef struct fw_verdict_hold {
    const fw_verdict_strain_monitor *saw;
    double *far, *now, *f;
    double more; /* times what is found */
} fw_verdict_hold;
/* nothing has changed yet from what x, as computed, does */
fw_status fw_verdict_hold_new(fw_arena *arena, const fw_mechanism *m, const fw_dynamics_motion *x,
                              double more, fw_verdict_hold *to);
void fw_verdict_hold_run(const fw_mechanism *m, const fw_dynamics_motion *x,
                         const fw_verdict_strain_monitor *saw, const fw_verdict_hold *hold);
/* moved_again.c: the loss factor of a scene's flexures at least and at most; false: it is as stated, or damps nothing */
bool fw_verdict_loss_ends(const fw_mechanism *mechanism, const fw_device_scene *scene,
                          double ends[2]);
/* the same device in the same scene with another loss factor of its material: what flexures without a stated damping lose */
fw_status fw_verdict_with_loss(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_device_scene *scene, double loss, fw_mechanism *to,
                               fw_device_scene *to_scene);
/* moved_again.c: bands of what is required, and factors of hinges, hold both; shaken: a law goes to and fro, and modes
   have that in these already */
struct fw_verdict_required;
fw_status fw_verdict_damped_again(fw_arena *arena, int scene, bool shaken,
                                  const fw_dynamics_motion_options *options,
                                  const struct fw_verdict_required *required,
                                  struct fw_verdict_variant_verdict *v);

/* ---- beside_resonance.c: stiffnesses that are off, where modes leave a hinge open ---- */

/* the same device with flexures' stiffnesses more by off (nhinge): of rotation, and against forces along the axis and across it */
fw_status fw_verdict_with_stiffness(fw_arena *arena, const fw_mechanism *mechanism,
                                    double (*off)[3], fw_mechanism *to);
/* may a scene that is moved with other stiffnesses decide what factors (2 x nhinge) of modes leave open? */
bool fw_verdict_stiffness_decides(const struct fw_verdict_variant_verdict *v, int scene,
                                  const double *factor);
/* Of a frequency what its own error and what bodies give leave of it. They add to compliances, 1/omega^2 goes by 1 + bodies:
   of what gives much no less than by twice that, where a share of the frequency would leave nothing */
double fw_verdict_mode_lowest(double off, double bodies);
/* What is left of modes where the scene is moved with other stiffnesses: of what rings what bodies give and what damps (own);
   of what laws that go to and fro do to modes (under) likewise where the error of a frequency hardly turns its phase while it
   swings, since of others no motion but that at resonance tells how high that is. common: what the next model of hinges
   may change of all stiffnesses; false: that is not known */
bool fw_verdict_leave_modes(const struct fw_verdict_shaken *of, double end_s, double bodies,
                            const double *model, struct fw_verdict_shaken_mode *own,
                            struct fw_verdict_shaken_mode *under, double *common);
/* It is moved, where it still may with what stays of these factors: factors of hinges that are then known better. common: what
   the next model of hinges may change of all stiffnesses */
fw_status fw_verdict_stiffness_again(fw_arena *arena, const fw_mechanism *mechanism, int scene,
                                     const fw_dynamics_motion_options *options, double common,
                                     const double *stays,
                                     const struct fw_verdict_variant_verdict *v, double *factor);
/* strain that a hinge may have had besides in swings which the steps of the motion were too long to follow */
double fw_verdict_lost_swing(const fw_mechanism *mechanism, const fw_mechanism_hinge *hinge,
                             const fw_dynamics_motion *motion);
/* where modes that lie elsewhere move everything between `less` and `by` times as far: what meets, or may; what rings and is not known;
   electrodes, ways: without the motion of a softer device (near_a_fold.c) */
fw_status fw_verdict_modes_may_meet(fw_arena *arena, int scene, double less, double by,
                                    struct fw_verdict_variant_verdict *v);
fw_status fw_verdict_modes_may_ring(fw_arena *arena, int scene,
                                    struct fw_verdict_variant_verdict *v);
void fw_verdict_modes_come_near(int scene, double by, double ways,
                                struct fw_verdict_variant_verdict *v);

/* ---- flexure_swing.c: what flexures weigh ---- */

/* 1/omega^2 (count) at most of the modes across the plane, or in it, with the mass of flexures, the slowest first; 0: it is not
   known */
struct fw_mechanism_plates;
fw_status fw_verdict_heavy(fw_arena *arena, const struct fw_mechanism_plates *plates, bool across,
                           int count, double *s2);
/* In the plane without that mass and with it; *both NULL: it is not known. By what shakes the base in a scene, how much more, and
   less, a hinge is strained, and a place goes along a direction */
typedef struct fw_verdict_flexed fw_verdict_flexed;
fw_status fw_verdict_flexed_new(fw_arena *arena, const fw_mechanism *mechanism,
                                fw_verdict_flexed **both);
fw_status fw_verdict_flexed_by(fw_arena *arena, const struct fw_verdict_variant_verdict *v,
                               int scene, fw_verdict_flexed *both);
void fw_verdict_flexed_strain(const fw_verdict_flexed *both, int hinge, double to[2]);
void fw_verdict_flexed_way(const fw_verdict_flexed *both, int body, fw_geometry_vec2 at,
                           double direction_rad, double to[2]);
/* body_hung.c: in scenes whose base moves in the plane v->shaken[].flexed, bands of what is required to move, and reasons
   (FW-D725) */
fw_status fw_verdict_flexures_shaken(fw_arena *arena, bool brief, fw_diags *diags,
                                     struct fw_verdict_variant_verdict *v);
/* across the plane: by how much a shock strains each hinge (nhinge) more, and throws bodies farther, at most */
fw_status fw_verdict_flexures_across(fw_arena *arena, const struct fw_verdict_variant_verdict *v,
                                     const struct fw_mechanism_plates *plates, int scene,
                                     double *strain, double *far_m);
/* body_farther.c: what bodies do by modes of their own in its scene, in low and high */
void fw_verdict_swings_required(const struct fw_verdict_variant_verdict *v,
                                struct fw_verdict_requirement *r);
/* of ways by laws that go once: how far beside what bodies give at rest, m; else 0 */
double fw_verdict_swings_once(const struct fw_verdict_variant_verdict *v,
                              const struct fw_verdict_requirement *r);
/* strain_monitor.c: what hangs over beyond hinges and middles, and may not bear what shakes it in a scene, is undecided (FW-D538) */
fw_status fw_verdict_shaken_bears(fw_arena *arena, struct fw_verdict_variant_verdict *v,
                                  const fw_verdict_hung *hung, int scene);
/* body_together.c: forces (3 ports) of an element at rest where its law is 1, and its ports p (3 ports) at poses q; false: it has too
   many, or none */
enum { FW_VERDICT_PORTS = 64 };
bool fw_verdict_element_forces(const fw_effects_force_element *from, const double *q, double *p,
                               double *f);
/* body_farther.c: the largest of to (n) and the next one together; *which: the largest */
double fw_verdict_two_farthest(const double *to, int n, int *which);
/* distances of a scene that are kept by less than `by`: undecided (FW-D638), since this body bends */
fw_status fw_verdict_distances_open(fw_arena *arena, struct fw_verdict_variant_verdict *v,
                                    int scene, double by, int body);

/* ---- what may be met, for what flexures are off by: body_bears.c, body_farther.c ---- */

double fw_verdict_flexures_off(const fw_mechanism *m, const fw_dynamics_motion *x);
/* May something take hold, or let go, in a scene of whose motion something is required? Then *e becomes what all that gives may be
   off by there, if that is more. missing: of what electrodes pull */
fw_status fw_verdict_may_be_met(fw_arena *arena, const struct fw_verdict_variant_verdict *v,
                                int scene, double missing, double *e, bool *met);
/* raises *held to how much of a final length, m, is that of a contact which holds as computed, and with flexures softer and stiffer */
fw_status fw_verdict_held_m(fw_arena *arena, const struct fw_verdict_variant_verdict *v,
                            const struct fw_verdict_requirement *r, double *held);

/* ---- beside_motion.c: what no motion has ---- */

/* Where nothing bounds what fingers that bend do, by the motion of the scene, which is then a copy with that in its ledger; and
   the reason of what is left undecided (FW-D607) */
fw_status fw_verdict_beside(fw_arena *arena, const fw_device_scene *scene, int index,
                            const fw_dynamics_motion_options *options,
                            struct fw_verdict_variant_verdict *v);

#endif
