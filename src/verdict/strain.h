/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Peak strain of a flexure under rotation and joint force, followed along a motion, and the fatigue of one that is repeated.
   Private to the room, its tests and study/. */
#ifndef FW_VERDICT_STRAIN_H
#define FW_VERDICT_STRAIN_H
#include "dynamics/dynamics.h"
#include "flexure/beam.h"
#include "flexure/flexure.h"
#include "layout/layout.h"
#include "maths/functions.h"
#include "mechanism/mechanism.h"
#include "probe/probe.h"
#include "statics/statics.h"

/* ---- how bodies give between their hinges: an upper bound from their outlines, as beams ----
   Theory: docs/theory/verdict.md. */

typedef struct fw_verdict_strip { /* a piece of a way, as fw_verdict_arm_add has it */
    fw_geometry_vec2 at, from, until;
    double w;
} fw_verdict_strip;
/* From where a flexure begins in a body to its middle, the centroid or what is nearest to it. Energy of a wrench
   w = (M, Fx, Fy) about the pin, world axes of the drawn pose: w.give.w/(2 E h). */
typedef struct fw_verdict_arm {
    const struct fw_verdict_shared *shared; /* NULL: no ways go together by what counts */
    bool known;                             /* drawn, and its material hangs together */
    bool lost;      /* of a load: it is not, and its body is drawn: too narrow for any grid */
    double give[6]; /* MM, Mx, My, xx, xy, yy: m^-2, m^-1, m^-1, 1, 1, 1 */
    /* of the way, out of the plane, of (Fz, Mx, My) about the pin: zz, zx, zy, xx, xy, yy. By bending over width,
       by torsion over width and over its cube, and shear (zz alone): what to multiply with goes by the thickness */
    double bend[6], twist[6], twist3[6], slide;
    double length_m, narrow_m; /* of the way; where it is narrowest, */
    fw_geometry_vec2 narrow;   /* and the place, world */
    /* of the way, as if it bore everything alone: the largest 6/w^2, and 6 r/w^2 + 1/w with r from the pin, by
       which a moment and a force are multiplied to be stress times thickness; where the latter is, and how the way
       runs there */
    double edge_m2, edge_m;
    double edge_wide_m; /* how wide it is there */
    fw_geometry_vec2 edge, along;
    /* 6 |y|/w^2 + 1/w and 6 |x|/w^2 + 1/w at most, with (x, y) from the pin as drawn, of a force along x and one along y */
    double edge_x_m, edge_y_m;
    /* a straight cut there that parts this hinge from the body's others: a point of it, what it leaves of the body (0: there is
       none), and the integral over that of the distance from the point */
    fw_geometry_vec2 cut;
    double cut_m, cut_m2;
    /* of a body with release holes, at most, over straight cuts along the way (fw_verdict_arm_rims): by which a moment, a
       force along x, along y, a force along any direction, and what else acts on the body, a force and a moment, are
       multiplied to be stress times thickness of what the cut leaves; and where they are largest */
    double rim_m2, rim_x_m, rim_y_m, rim_m, rim_rest_m, rim_rest_m2;
    fw_geometry_vec2 rim;
    fw_geometry_vec2 *way;   /* (nway) of a hinge: cells from its root to the middle */
    fw_verdict_strip *strip; /* (nstrip) as drawn; none of a straight way */
    int nway, nstrip;
    fw_geometry_vec2 pin; /* about which `give` is, world */
    double
        softer; /* as made: its body gives as many times as drawn (fw_verdict_softer); 0: drawn */
    const struct fw_verdict_arm *
        base; /* of an end on the ground, which has none of all that: up to the frame (body_drawn.c) */
} fw_verdict_arm;

/* body_loads.c: how large load `at` of those (n) becomes: of one that follows from the motion what hinges put on the body
   (rest_N), and what its other loads may balance */
double fw_verdict_load_N(const fw_mechanism_load_end *end, int n, int at, const double *rest_N);
/* stress at most over what is allowed of a hinge's material, of the strip along a way that bears a moment and a force
   at its end alone. along_N: the largest of the force along x and along y as the body is drawn, NULL where that is not
   known. Three times (Kirsch) that of a beam, for what holes and corners do to it; walls that the flow puts
   farther in leave less, and of the narrowest place most */
double fw_verdict_arm_bears(const fw_mechanism *mechanism, int hinge, const fw_verdict_arm *arm,
                            double moment_Nm, double force_N, const double *along_N);

/* What a strip between two edges, or a hole's rim, is allowed, over its stress times thickness: walls that the flow puts
   farther in leave less of it, and of the narrowest place most. Infinite where nothing is known of it. */
double fw_verdict_arm_allowed_N_per_m(const fw_mechanism *mechanism, int hinge,
                                      const fw_verdict_arm *arm);
/* the same at the rims of release holes, of what straight cuts leave of the body; rest: what else acts on the body at
   most, N and N m about its mass centre, wherever it does; NULL: nothing */
double fw_verdict_arm_rims_bear(const fw_mechanism *mechanism, int hinge, const fw_verdict_arm *arm,
                                double moment_Nm, double force_N, const double *along_N,
                                const double rest[2]);

/* arm: (2 nhinge) of hinge k in body a, in body b, then of each load end. In: outlines of the layout in the drawn pose. Range:
   any outline; unknown where nothing is drawn or the way is narrower than a cell of the grid, a 400th of the body.
   Error: an upper bound as far as a strip of inscribed circles is a beam. Cost: some 1e6 operations for a body.
   Test: test_body_arms.c */
fw_status fw_verdict_body_arms(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_layout *layout, fw_verdict_arm **arm);
/* a piece of the way around `at`, `from` to `until`, as a strip of width w: added to the arm of a pin (world, m) */
void fw_verdict_arm_add(fw_verdict_arm *arm, fw_geometry_vec2 pin, fw_geometry_vec2 at,
                        fw_geometry_vec2 from, fw_geometry_vec2 until, double w);
typedef struct fw_verdict_turn { /* of a body since it was drawn */
    double rad, cosine, sine;
} fw_verdict_turn;
/* a body with holes, cut straight across: its lines (n), where its hinges are (nhinge), and the end that is asked */
enum { FW_VERDICT_RUN = 16, FW_VERDICT_WIDE = 256 };
typedef struct fw_verdict_pierced {
    const fw_mechanism_line *line;
    /* around every FW_VERDICT_RUN and every FW_VERDICT_WIDE of them, which lie beside each other; NULL: all are looked at */
    const fw_geometry_box *run, *wide;
    int n, nhinge,
        own; /* own: number of the end among the hinges; nhinge and above: none of them */
    fw_geometry_vec2 root, *hinge;
    double hole_m; /* diameter; 0: there are none */
    double *room;  /* (n + 1) */
} fw_verdict_pierced;
/* run and wide of its lines */
fw_status fw_verdict_pierced_boxes(fw_arena *arena, fw_verdict_pierced *body);
/* rim_... of a piece of the way, where there are holes, `from` to `until`, as a strip of width w between holes and as what straight cuts leave */
void fw_verdict_arm_rims(const fw_verdict_pierced *body, fw_geometry_vec2 pin,
                         fw_geometry_vec2 from, fw_geometry_vec2 until, double w,
                         fw_verdict_arm *arm);
/* The straight cut at arm->edge, square to the way, where it parts this end from all hinges of the body: cut, cut_m, cut_m2 */
void fw_verdict_arm_cut_at_edge(const fw_verdict_pierced *body, fw_verdict_arm *arm);
/* c (9) += what it gives out of the plane, of (z, turns about x, y) by (Fz, Mx, My) about the pin, SI. An upper bound as
   above: of torsion 1/J <= 3/0.42 (1/(w h^3) + 1/(h w^3)) */
void fw_verdict_arm_out_of_plane(const fw_verdict_arm *arm, double youngs_Pa, double poisson,
                                 double thickness_m, double *c);
/* body_tree.c: a body beyond the ways between its hinges and its middle, as a tree of beams: a part hangs on the one before */
typedef struct fw_verdict_tree_part {
    fw_geometry_vec2 at, along; /* its middle; {0, 0}: it has no direction */
    double area_m2, mass_m2;    /* mass_m2: with what is too thin to bear anything, as made */
    double keeps, far_m;        /* of its width as made; what of it is farthest from its middle */
    double long_m, wide_m, root_m[2]; /* root_m: longer by that across the plane and in it */
    int level, before, bears;         /* before: FW_NONE is held; bears: how many hang on it */
    bool spreads;                     /* around what holds it: in what a flexure's root gives */
} fw_verdict_tree_part;
typedef struct fw_verdict_tree {
    fw_arena *arena;
    const fw_mechanism_line *line;
    bool *hole;  /* (nline) lines of release holes */
    bool thrown; /* a scene shakes it across the plane */
    struct fw_verdict_held *held;
    fw_geometry_box box;                         /* of its lines; once cells are laid, of these */
    int nline, nx, ny, nlist, n, nhinge, near;   /* near: steps to what is held, level_of */
    double cell, left;                           /* left: what release holes leave of a width */
    double whole_m2, reached_m2, made_m2;        /* made_m2: of what is reached, as made */
    double edge_m, depth_m, youngs_Pa, shear_Pa; /* edge_m: edges stand out by that, not above 0 */
    float *full;
    unsigned char *kind;
    int *step, *came, *part, *list;
    fw_verdict_tree_part *at;         /* (n) those after it hang on it */
    double (*f)[3], (*u)[3], (*v)[3]; /* (n) */
    int farthest;                     /* the part that goes farthest in the plane */
} fw_verdict_tree;
/* of a body; where nothing of it is drawn nline is 0 */
fw_status fw_verdict_tree_new(fw_arena *arena, const fw_mechanism *mechanism,
                              const fw_layout *layout, int body, const fw_verdict_arm *arm,
                              fw_verdict_tree *tree);
fw_status fw_verdict_tree_lay(fw_verdict_tree *tree, fw_geometry_box box, double cell_m);
/* its parts. whole_ways: ways of hinges hold it up to the middle, where they are one way, too */
fw_status fw_verdict_tree_grow(fw_verdict_tree *tree, bool whole_ways);
/* body_swing.c: bodies as trees of beams from their middles on, with their masses where they are. A beam bears what hangs on it,
   about its middle, and gives by that; what it is a part of stands before it. A body that is not drawn is one mass. */
typedef struct fw_verdict_beam {
    int body, before;           /* before: FW_NONE, the body's middle */
    fw_geometry_vec2 at, along; /* world, as drawn */
    double turns, goes, pulls;  /* rad/(N m); m/N across it and along it */
    double mass_kg, inertia_kg_m2;
} fw_verdict_beam;
typedef struct fw_verdict_loop { /* where material closes a ring of beams: between two of them */
    int beam[2];
    fw_geometry_vec2 at;
    double turns, goes;
} fw_verdict_loop;
typedef struct fw_verdict_beams {
    fw_verdict_beam *at;     /* (n) those of a body stand together */
    double (*f)[3], (*u)[3]; /* (n) N, N, N m; m, m, rad against the body's middle */
    fw_verdict_loop *loop;   /* (nloop) */
    int n, nloop;
    int *on,
        *first; /* on: (2 nhinge) where hinge i/2 ends in the body on its side i % 2; FW_NONE. first: (nbody + 1) */
    int lost; /* a body that no grid resolves; FW_NONE */
} fw_verdict_beams;
/* body_tree.c: those of one body, behind those that are there; *holds: they are all of it */
fw_status fw_verdict_tree_beams(fw_arena *arena, const fw_mechanism *mechanism,
                                const fw_verdict_arm *arm, fw_verdict_tree *tree, int body,
                                fw_verdict_beams *beams, bool *holds);
/* Of the first `count` modes in the plane at rest, with bodies as such beams, 1/omega^2 at most, the largest first; a clause: why
   that is not known, or NULL */
fw_status fw_verdict_slowest_swings(fw_arena *arena, const fw_mechanism *mechanism,
                                    const fw_verdict_arm *arm, int count, double *s2,
                                    const char **why);
/* body_hung.c: what a body does beyond the ways between its hinges and its middle under its own weight, per acceleration: how
   far it goes across the plane and in it, m per m/s2; its slowest modes there, 1/omega^2; what it is strained by in the plane,
   as a bar without corners; the s = 2 gamma cos(theta) of a liquid below that it bears, over the gap there; and what its softest
   end, or corner, gives across the plane */
typedef struct fw_verdict_hung {
    double across_s2, in_plane_s2, across_mode_s2, in_plane_mode_s2, Pa_per_m_s2, bears_N_per_m,
        tip_m_per_N, corner_m_per_N;
} fw_verdict_hung;
/* arena: holds its cells, too */
fw_status fw_verdict_overhang(fw_arena *arena, const fw_mechanism *mechanism,
                              const fw_layout *layout, int body, const fw_verdict_arm *arm,
                              fw_verdict_hung *hung);
/* across: what they do across the plane, too */
fw_status fw_verdict_overhangs(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_verdict_arm *arm, bool across,
                               fw_verdict_hung **hung); /* (nbody) */
fw_status fw_verdict_hung_says(fw_arena *arena, const fw_mechanism *mechanism, bool *says);
/* how far a shock across the plane, once over, throws anything of it at most; infinite: that bounds nothing */
struct fw_mechanism_plates;
fw_status fw_verdict_thrown_across(fw_arena *arena, const struct fw_mechanism_plates *plates,
                                   const fw_verdict_hung *hung, const fw_device_scene *scene,
                                   double *far_m);
/* arms of bodies on several hinges: all of a body on one hinge hangs over */
fw_status fw_verdict_shared_arms(fw_arena *arena, const fw_mechanism *mechanism,
                                 const fw_verdict_arm *arm, fw_verdict_arm **shared);
/* those of v, or computed; and the tension that a liquid below may have, N/m, of what hangs over with the body that it hangs
   on, which bears bodies_N_per_m; infinite: it bears far more */
struct fw_verdict_variant_verdict;
fw_status fw_verdict_hung_of(fw_arena *arena, const struct fw_verdict_variant_verdict *verdict,
                             const fw_verdict_hung **hung);
double fw_verdict_hung_pulled(const fw_verdict_hung *hung, double gap_m, double down_m,
                              double error, double bodies_N_per_m);
/* body_loads.c: is what hangs over all that speaks against a frequency in the plane? */
struct fw_verdict_requirement;
bool fw_verdict_hangs_alone(const struct fw_verdict_variant_verdict *verdict,
                            const struct fw_verdict_requirement *requirement);
fw_status fw_verdict_hangs_say(fw_arena *arena, struct fw_verdict_variant_verdict *verdict,
                               const struct fw_verdict_requirement *requirement, const char *text);
fw_status fw_verdict_hangs_open(struct fw_verdict_variant_verdict *verdict, const char *scene,
                                int number, const char *what);
/* "0.3 to 0.5", "0.3 at least" */
const char *fw_verdict_range_words(fw_arena *arena, const double number[2]);
/* plates on flexures with what bodies may give at most (verdict_out_of_plane.c) */
fw_status fw_verdict_soft_plates(fw_arena *arena, const fw_mechanism *mechanism,
                                 const fw_verdict_arm *arm, struct fw_mechanism_plates *soft);
/* J of a wrench that a hinge puts on the body, turned back to the drawn pose */
double fw_verdict_arm_energy_J(const fw_verdict_arm *arm, double stiff_N, double moment_Nm,
                               double fx_N, double fy_N, const fw_verdict_turn *turn);

/* ---- strains of a hinge ---- */

typedef struct fw_verdict_hinge_load {
    double angle_rad;  /* of the pin: phi_b - phi_a - free angle */
    double fx_N, fy_N; /* of the pin on body b, world axes */
    double frame_rad;  /* half the sum of both bodies' rotations since the drawn pose */
    bool pinned;       /* the force is that of an ideal pin in place of the flexure */
    /* pin on b from pin on a, world axes; NaN: not known. Of use where a strip is pressed beyond what
       it bears alone and other flexures hold it */
    double apart_m[2];
    double least_known; /* as in fw_flexure_strip_load */
} fw_verdict_hinge_load;
/* of hinge k; without loads nothing has become longer */
fw_verdict_hinge_load fw_verdict_hinge_load_at(const fw_mechanism *mechanism, int k,
                                               const fw_dynamics_instant *now);

enum { FW_FACES = 4 }; /* two of either root */

typedef struct fw_verdict_hinge_strains {
    double peak; /* largest |strain|, fillets included */
    /* what the peak is at least (fw_flexure_strip_strains); where the axis is not known the least that
       any direction of it has */
    double least;
    double most;       /* and at most, beyond what it may be off by at the roots */
    double root[2][2]; /* at both faces of both roots, signed: their sign is what makes cycles */
    /* false: this is not the strain. An exact beam was asked for and none found with that place and force,
       or the closed form was, and the strip is beyond its buckling load, of which that knows nothing */
    bool known;
} fw_verdict_hinge_strains;
/* beam: of fw_verdict_hinge_beam; NULL, or where no such equilibrium is found: closed form */
void fw_verdict_hinge_strain(const fw_mechanism_hinge *hinge, fw_flexure_elastica *beam,
                             const fw_verdict_hinge_load *load, fw_verdict_hinge_strains *out);
/* *beam NULL: the strip's axis is not known */
fw_status fw_verdict_hinge_beam(fw_arena *arena, const fw_mechanism_hinge *hinge,
                                fw_flexure_elastica **beam);

/* error of a model, relative, where nothing bounds it (fw_verdict_motion_model_error) */
extern const double fw_verdict_model_not_known;
double fw_verdict_motion_beside(const fw_dynamics_motion *motion);
double fw_verdict_motion_beside_rad(const fw_dynamics_motion *motion);

/* ---- verdict_strain.c: the largest value of what is followed along a motion: a strain, a force ---- */

typedef struct fw_verdict_largest {
    double value, t_s; /* so far, and when; 0: of nothing below that */
    double between;    /* what the parabola added to the largest sample: the error of the search */
    double t[2], last[2]; /* the last two instants */
    int samples;
} fw_verdict_largest;
/* one more instant */
void fw_verdict_largest_add(fw_verdict_largest *largest, double t_s, double value);

/* ---- verdict_bending.c: what bodies that are taken as rigid would store ---- */

enum { FW_TIPPING_HINGES = 24 }; /* of more hinges only the hardest instant is looked at */
/* where one component of one hinge's force is largest one way */
typedef struct fw_verdict_extreme {
    double value_N, at_s;
    double beside; /* by how much it is larger between the instants */
} fw_verdict_extreme;

/* largest so far of what a place may hit by (body_loads.c); late: in the last tenth of the scene */
typedef struct fw_verdict_blow {
    bool touched;
    double touched_s;
    double swung, shaken;   /* before it is touched: (a.M a)^(1/2), and how fast its speed grows */
    double goes, late_goes; /* speed of all places of what acts there together */
} fw_verdict_blow;

/* Where what presses or pulls a body beside its hinges follows from how that place goes: a contact, a cable that is drawn.
   What the body gives there is in series with it (arm_rims.c) */
typedef struct fw_verdict_place {
    int body;
    double x_m, y_m; /* local to it */
    const char *id;  /* of what acts there */
    const fw_verdict_arm *arm;
    int end;                        /* of the arms: the first of all that acts at this place */
    const fw_mechanism_give *given; /* what of that the motion has; NULL: nothing */
    double m_per_N, whole_m_per_N;  /* what the body gives there at most, beside that and with it */
    double
        stiff_N_per_m; /* of what acts there; 0: it is not known yet, or acts whatever the place does */
    double force_N;                          /* largest so far; infinite: not known */
    const fw_effects_force_element *element; /* of this run; NULL: none goes by the place */
    int port;
    const fw_device_spring
        *spring; /* or a spring, which acts on its second body there (second) or its first */
    bool second;
    const fw_device_force *force; /* or what is stated */
    double known_N;               /* as in fw_mechanism_load_end */
    fw_verdict_blow blow;
} fw_verdict_place;

typedef struct fw_verdict_bending {
    const fw_verdict_arm *arm; /* (2 nhinge); NULL: nothing is drawn, forces alone are seen */
    double stiff_N;            /* Young's modulus times thickness */
    double hinges_J, bodies_J; /* largest so far of all hinges, of all bodies, */
    double moving_J; /* and of the hinges' rotations and the bending of their strips alone */
    double gone;     /* largest way of an end over its flexure's width, or turn over the limit */
    double *body_J;  /* (2 nbody) the largest of each, then those of the instant */
    double bases_J, bases_gone, *base; /* the same of bases; base: (9 nhinge) room, NULL: none */
    fw_verdict_turn *turn;             /* (nbody) of the instant */
    double *end; /* (6 nhinge) what hinges put on their ends at the instant (fw_verdict_shared_J) */
    double
        *worst; /* (3 nhinge) straight ways: only whether bodies are counted is found; NULL: all */
    double hardest_N2; /* of hardest_N, the sum of all squared */
    double beside;     /* by how much they are larger where that sum was the largest so far */
    /* the last two instants, their forces (2 x 2 nhinge); what came at once: sum of squares, forces (1 + 2 nhinge) */
    double before_s[2], *before_N, *jumped_N;
    /* (4 nhinge) of each component the largest and the least; NULL: too many hinges */
    fw_verdict_extreme *extreme;
    double *extreme_N; /* (4 nhinge x 2 nhinge) all forces there */
    fw_verdict_largest *
        peak; /* (1 + 8 nhinge) of that sum, of each force squared and moment, as `along_N`, and what presses it */
    double *
        hardest_N; /* NULL: nobody asks. (2 nhinge) the forces on body b, world, then (2 nhinge) of each flexure its largest
                                  force squared, and moment, then (3 nhinge) what tips it, as fw_mechanism_plates_pressed */
    double *
        along_N; /* (4 nhinge) the largest force of each flexure on body a, on body b, along x and y as that is drawn */
    double *
        cut_N_per_m; /* (2 nhinge) the most that stress is at least across the cut of an arm, times thickness;
                            NULL: no holes */
    double
        *rest_N; /* (nbody) largest so far of the force that all hinges together put on a body, */
    double *rest_Nm; /* and of the moment about its mass centre; NULL: no holes */
    double *rest;    /* (2 nbody) of the instant, N, world */
    double *
        put; /* (3 nbody) of the instant: what hinges put on a body: N, N, N m about its mass centre */
    struct fw_verdict_solid_kept *kept; /* body_solid.c; NULL: of straight ways, and without arms */
    fw_verdict_place *place;            /* (nplace) */
    int nplace;
    double places_J;  /* what bodies store there, as far as the motion goes by it */
    double springs_J; /* largest so far of what acts there stores itself */
    double
        acted_J; /* of all bodies as solids with all that acts where it does; infinite: not known */
    double stated_J; /* under loads of which the scene says how large they become, at most */
    double *
        last; /* (12 nbody) of the last instant poses, and speeds up to it; speeds at anchor_s, and by what they grow since */
    double last_s, anchor_s;            /* NaN: none yet */
    double swings_s;                    /* between two anchors */
    double late_s;                      /* where the last tenth of the scene begins */
    double carried_m_per_s2;            /* what the scene shakes the device by in the plane */
    double moves_J, late_J;             /* largest so far of twice the kinetic energy */
    const fw_effects_loads *loads;      /* whose elements act there; NULL: the run starts */
    struct fw_verdict_courses *courses; /* body.h; NULL: nothing is repeated, or no life is known */
} fw_verdict_bending;

/* by how much the end of a hinge goes over the hinge's width, or turns over its limit, as the strip of its body gives:
   the derivatives of fw_verdict_arm_energy_J by what the hinge puts on it */
double fw_verdict_arm_gone(const fw_verdict_bending *bending, const fw_mechanism_hinge *hinge,
                           const fw_verdict_arm *arm, double moment_Nm, const double force[2],
                           const fw_verdict_turn *turn);
extern const double fw_verdict_bending_told; /* share above which what bodies give counts */
extern const double fw_verdict_straight_share;
typedef struct fw_verdict_solid_kept {
    double *instant;
    int n, seen, every, nplace;
} fw_verdict_solid_kept;
/* doubles of one instant: (3 nhinge) moment of the flexure and force on body b, world, (nbody) turns, (3 nplace) what acts */
size_t fw_verdict_instant_size(const fw_mechanism *mechanism, int nplace);
fw_status fw_verdict_solid_keep_new(fw_arena *arena, const fw_mechanism *mechanism, int nplace,
                                    fw_verdict_solid_kept **kept);
void fw_verdict_solid_keep_none(fw_verdict_solid_kept *kept);
void fw_verdict_solid_keep(const fw_verdict_bending *bending, const fw_mechanism *mechanism,
                           const fw_dynamics_instant *now);
/* arm NULL: forces of hinges alone; straight: of straight ways, and only whether bodies are to be counted */
fw_status fw_verdict_bending_watch(fw_arena *arena, const fw_mechanism *mechanism,
                                   const fw_verdict_arm *arm, bool straight, int scene,
                                   fw_verdict_bending *bending);
/* body_loads.c: the places of a scene; at every instant, NULL where the run starts; and when it has ended */
fw_status fw_verdict_places_new(fw_arena *arena, const fw_mechanism *mechanism, int scene,
                                fw_verdict_bending *bending);
void fw_verdict_places_record(fw_verdict_bending *bending, const fw_mechanism *mechanism,
                              const fw_dynamics_instant *now);
void fw_verdict_places_end(fw_verdict_bending *bending);
/* force and couple that act on a place now, N, N, N m, world; stored_J NULL, or += what is stored there */
void fw_verdict_place_acts(const fw_verdict_place *place, const fw_dynamics_instant *now,
                           double acts[3], double *stored_J);
/* what of all that bodies store counts for the bands of a motion: places and solids as soon as it has ended */
double fw_verdict_bending_all_J(const fw_verdict_bending *bending);
/* Relative error of a probe beside fw_verdict_bending_share: of a speed what bodies give under the loads that the scene states; of
   the force of what acts on a place the part of that share that goes with it alone, which is none of its errors, less.
   *low_N and *high_N with what such a force loses at most; false: nothing changes */
double fw_verdict_places_error(const fw_dynamics_motion *motion, const fw_device_probe *probe);
bool fw_verdict_places_lower(const fw_dynamics_motion *motion, const fw_device_probe *probe,
                             fw_device_measure measure, double *low_N, double *high_N);
/* body_loads.c: how far the end of a way goes at most, for a force of E h, whichever way that acts */
double fw_verdict_arm_goes(const fw_verdict_arm *arm);
/* what the body of a probed stiffness or compliance gives at its place along its direction at most, m/N; 0: not known */
fw_status fw_verdict_place_gives(fw_arena *arena, const fw_mechanism *mechanism,
                                 const fw_verdict_arm *arm, const fw_device_probe *probe,
                                 double *m_per_N);
void fw_verdict_bending_record(fw_verdict_bending *bending, const fw_mechanism *mechanism,
                               const fw_dynamics_instant *now);

/* body_solids.c: what bodies leave at least of a stiffness, of the inverse of a compliance, or of a frequency that is asked for.
   closely: as solids, which stay in v; mode: its number in the plane */
typedef struct fw_verdict_soft {
    bool looked;
    double of_scenes;              /* share that bodies give there, where no forces are known */
    const fw_statics_modes *modes; /* at rest, flexures give; NULL: they are not all known */
    const char *why;               /* a clause: what was asked for last has no lower end; NULL */
} fw_verdict_soft;
fw_status fw_verdict_soft_new(fw_arena *arena, const fw_effect_choice *with, double of_scenes,
                              const struct fw_verdict_variant_verdict *v, fw_verdict_soft *soft);
fw_status fw_verdict_soft_leaves(fw_arena *arena, fw_verdict_soft *soft, const fw_probe *probe,
                                 int mode, double value, bool closely,
                                 struct fw_verdict_variant_verdict *v, double *left);
/* what bodies add at most to 1/omega^2 of the first modes in the plane, to (count); a clause: why that is not known, or NULL */
fw_status fw_verdict_soft_swings(fw_arena *arena, const fw_verdict_soft *soft,
                                 const struct fw_verdict_variant_verdict *v, int count, double *to,
                                 const char **why);
struct fw_verdict_requirement;
fw_status fw_verdict_soft_overtakes(fw_arena *arena, const fw_effect_choice *with,
                                    const fw_statics_modes *modes,
                                    const struct fw_verdict_variant_verdict *v,
                                    const struct fw_verdict_requirement *requirement,
                                    double *less_Hz);

/* ---- strain_monitor.c: the peak strain of every hinge, followed along the motion ---- */

typedef struct fw_verdict_hinge_peak {
    fw_verdict_largest strain;
    double least, most; /* of what it is at least and at most, of the instants alone */
    double forced;      /* largest |strain less that of the rotation alone| at an instant */
    bool lost;          /* at an instant it was not known, first at lost_s; such are left out */
    double lost_s;
} fw_verdict_hinge_peak;

/* ringing.c: what a hinge does where a scene has ended, over the most that it was bent by in it */
typedef struct fw_verdict_ring {
    double share, decrement; /* logarithmic, a swing; 0: nothing is known to damp it */
    double omega_per_s;
} fw_verdict_ring;
typedef struct fw_verdict_after {
    double rest, more;       /* more: by which shares may be more, since the motion is not small */
    fw_verdict_ring ring[8]; /* (n) the largest first */
    int n;
} fw_verdict_after;
/* (nhinge); NULL: nothing rings, or no life is known */
fw_status fw_verdict_rings_on(fw_arena *arena, const fw_mechanism *m, const fw_device_scene *scene,
                              const fw_dynamics_motion *motion, fw_verdict_after **after);

typedef struct fw_verdict_strain_monitor { /* of one run */
    const fw_mechanism *mechanism;
    fw_arena *arena;
    fw_flexure_elastica **beam; /* (nhinge) made when first needed; NULL: not yet */
    bool no_memory; /* for them: strains are those of the closed form, and the run has failed */
    long glances;   /* steps of this run that were offered as thirds */
    fw_verdict_hinge_peak *hinge;                 /* (nhinge) */
    struct fw_verdict_clearance_watch *clearance; /* verdict_parts.h */
    fw_maths_turning (*root)[FW_FACES]; /* (nhinge) of the strain at both faces of both roots;
                                           NULL: nobody counts cycles */
    fw_verdict_after *after;            /* (nhinge) NULL: nothing rings on, or nobody counts */
    fw_verdict_bending bending;
    struct fw_verdict_touch
        *touch; /* of the scene's contacts (verdict_stiction.c); NULL: nobody looks */
    int ntouch;
    bool trial;              /* only whether it is accepted is of account */
    fw_probe_monitor *probe; /* looks at the same instants; NULL: nothing is probed */
} fw_verdict_strain_monitor;

/* cycles: also keep the turning points that fatigue needs */
fw_status fw_verdict_strain_monitor_new(fw_arena *arena, const fw_mechanism *mechanism, bool cycles,
                                        fw_verdict_strain_monitor *monitor);
/* verdict_strain.c: how near the two of every contact of a scene come, over the whole run and at its end */
typedef struct fw_verdict_touch {
    double least_m, last_m;
    const fw_device_contact_use *use;
} fw_verdict_touch;
fw_status fw_verdict_touch_watch(fw_arena *arena, const fw_device_scene *scene,
                                 fw_verdict_strain_monitor *monitor);
void fw_verdict_touch_record(fw_verdict_strain_monitor *monitor,
                             const fw_dynamics_instant *instant);
/* an fw_dynamics_observer; context is the monitor */
void fw_verdict_strain_monitor_record(void *context, const fw_dynamics_instant *instant);
/* An fw_dynamics_glance: the thirds of a step are enough where strains are small in it (below 0.6 of the peaks so far: within a
   third of the loosest step, a fifth of an oscillation, none grows by more), or the parabola through them is right to 0.3 % of the
   peak (third difference below 5 %, of which a cubic leaves 6 %); where cycles are counted, only where the strain of every face
   goes on ten times more smoothly. Where probes look, too, steps are looked at closely to begin with. `watch`: of these options */
bool fw_verdict_strain_monitor_glance(void *context, const fw_dynamics_instant *third);
void fw_verdict_strain_monitor_watch(fw_verdict_strain_monitor *w, fw_dynamics_motion_options *o);
/* Strains of which the numerical error is known from two runs. What stiff axes carry is known less
   well than the rotation: peaks of forces that ride on them come nearer with a tighter tolerance,
   but not at the order of the method. Error: twice what any hinge's largest strain differs by (1.1
   times was seen, test_hard_verdict.c), times the margin of the two runs; the largest difference
   of all hinges counts for each, since one alone may agree by chance. */
double fw_verdict_strain_monitor_error(const fw_verdict_strain_monitor *tighter,
                                       const fw_verdict_strain_monitor *looser, double margin);
/* that over thirty times the accuracy wanted (at most 3 %) of the lowest limit: fw_dynamics_motion_options.unsettled */
double fw_verdict_strain_monitor_unsettled(const void *tighter, const void *looser, double margin,
                                           double accuracy);

/* ---- strain_monitor.c: fatigue of a motion that is repeated ---- */

typedef struct fw_verdict_fatigue {
    double utilisation; /* factor on all stresses at which the repetitions would just be lasted, to
                           the power -1; no safety factor */
    double damage;      /* Miner's sum at the stresses as they are */
    double cycles;      /* counted in one repetition, to the scene's end */
    double at_least;    /* utilisation with what rings on as small as it may be */
    double damped;      /* and as large; */
    double at_most;     /* and where what nothing is known to damp rings on for so long, too */
} fw_verdict_fatigue;

/* Miner's sum of n cycles of stress (Pa), `times` over, all stresses times `factor` */
double fw_verdict_miner(const fw_flexure_strain_life *law, const fw_maths_cycle *cycle, size_t n,
                        double times, double factor);
/* x with fw_verdict_miner(..., 1/x) = 1; 0: nothing is stressed */
double fw_verdict_fatigue_utilisation(const fw_flexure_strain_life *law,
                                      const fw_maths_cycle *cycle, size_t n, double times);
/* Cycles that are left to come of ring k, as blocks: amplitudes share exp(-j decrement) about `rest`, times peak_Pa, down to a
   twentieth; the first ring carries the others. to: at most FW_RING_BLOCKS. Of what nothing is known to damp a hundred million
   radians */
enum { FW_RING_BLOCKS = 151 };
size_t fw_verdict_rung_out(const fw_verdict_after *after, int k, double peak_Pa,
                           fw_maths_cycle *to);

/* The worst face of both roots. root: turning points of their strain, ended here; where the peak strain is more than theirs
   all of the history is taken to be so much more. after: what rings on; NULL: nothing */
fw_status fw_verdict_fatigue_of(fw_arena *arena, const fw_flexure_strain_life *law,
                                fw_maths_turning root[FW_FACES], double peak_strain,
                                double youngs_Pa, double times, const fw_verdict_after *after,
                                fw_verdict_fatigue *out);

/* hinge k, by all scenes in turn; monitor: (nscene) of those whose motion has none of its own */
struct fw_verdict_variant_verdict;
fw_status fw_verdict_in_turn(fw_arena *arena, const struct fw_verdict_variant_verdict *v, int k,
                             const fw_verdict_strain_monitor *monitor, double *used);
/* moved_again.c: reasons where that, or what rings on, leaves a hinge open */
fw_status fw_verdict_tell_in_turn(fw_arena *arena, const fw_verdict_strain_monitor *monitor,
                                  struct fw_verdict_variant_verdict *v);
fw_status fw_verdict_tell_repeated(fw_arena *arena, const fw_verdict_strain_monitor *monitor,
                                   struct fw_verdict_variant_verdict *v);
/* arm_rims.c: what bends towards a wall beside it, and where in the drawing; NULL: FW_NOMEM */
struct fw_mechanism_limb;
const char *fw_verdict_limb_text(fw_arena *arena, const fw_layout *layout,
                                 const struct fw_mechanism_limb *limb);

/* ---- arm_rims.c: what takes hold where it is met: a contact, a stop of a joint, a cable that becomes taut ---- */

typedef struct fw_verdict_reach {
    const char *id;
    int pin; /* of a stop: the joint that it is of; else FW_NONE */
    /* m; of a stop times the length of modes: what it leaves at the start, how much of that the motion takes at most, and how far
       it goes either way */
    double gap_m, closes_m, goes_m;
    bool rests; /* it is met where the scene's modes are asked for, and stiffens them */
    double stiff_N_per_m,
        gives_m_per_N; /* where it is met; what the device gives there before that, by modes */
    const fw_effects_force_element *element; /* of the motion; NULL where kept */
    const fw_effects_stop *stop;
    double per_m; /* of what the element says of itself */
} fw_verdict_reach;
struct fw_verdict_shaken;
/* shaken->reach, from the samples of the motion and the cubic through them and their rates; q: the pose of modes */
fw_status fw_verdict_reach_find(fw_arena *arena, const fw_dynamics_motion *motion, double unit_m,
                                const double *q, struct fw_verdict_shaken *shaken);
/* strain_monitor.c: gives_m_per_N, of all, or of what rests alone: by modes, of which at most `most` are taken */
void fw_verdict_reach_gives(const fw_statics_modes *modes, int most, bool rests,
                            struct fw_verdict_shaken *shaken);
/* by how much of its gap a small displacement u (3 nbody) about q takes, m */
double fw_verdict_reach_by(const fw_verdict_reach *reach, const double *q, const double *u);
/* body_farther.c: what it may take of its gap at most where everything it does goes `up` times as far; its words */
double fw_verdict_reach_takes(const fw_verdict_reach *reach, double up);
const char *fw_verdict_reach_name(fw_arena *arena, const fw_mechanism *mechanism,
                                  const fw_verdict_reach *reach);
/* a reason (FW-D731) where what is not met as computed may be, with a mode within its error */
fw_status fw_verdict_may_touch(fw_arena *arena, int scene, struct fw_verdict_variant_verdict *v);
#endif
