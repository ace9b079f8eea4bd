/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Bodies under all that acts on them at once: ways that go together, as beams and as solids, and how much farther a place goes;
   and what rings on. Private to the room. */
#ifndef FW_VERDICT_BODY_H
#define FW_VERDICT_BODY_H
#include "statics/statics.h"
#include "verdict/strain.h"

/* Where ways of one body go together they bear together what comes by each of them: body_together.c */
typedef struct fw_verdict_strip { /* a piece of a way, as fw_verdict_arm_add has it */
    fw_geometry_vec2 at, from, until;
    double w;
} fw_verdict_strip;
typedef struct
    fw_verdict_arm_end { /* of a hinge, or where a load acts: pin and root are that place */
    fw_verdict_arm *to;
    int index; /* of the arm */
    fw_geometry_vec2 pin, root;
    fw_verdict_strip *strip; /* (nstrip) */
    int nstrip;
} fw_verdict_arm_end;
typedef struct fw_verdict_shared {
    fw_geometry_vec2 about; /* world, as drawn */
    int first;              /* the first of its ends */
    struct fw_verdict_trunk {
        double give[6]; /* as an arm's, about `about` */
        int n, *end;    /* indices of arms */
        bool counts;    /* several, and it is more than a 200th of a way */
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
fw_status fw_verdict_say_bent(fw_arena *arena, struct fw_verdict_variant_verdict *verdict,
                              const char *scene, int number, const char *what, int body,
                              double by_m);

/* a.M b of motions (3 nbody) of the bodies' centres */
static inline double fw_verdict_mass_form(const fw_mechanism *m, const double *a, const double *b) {
    double sum = 0;
    for (int i = 0; i < 3 * m->nbody; i += 3)
        sum += m->body[i / 3].mass_kg * (a[i] * b[i] + a[i + 1] * b[i + 1]) +
               m->body[i / 3].inertia_kg_m2 * a[i + 2] * b[i + 2];
    return sum;
}

/* ---- ringing.c, resonance.c ---- */

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

#endif
