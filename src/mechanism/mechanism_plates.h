/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The device out of the plane that it moves in: bodies as rigid plates, flexures as what
   flexure_out_of_plane.c makes of them, small motions about the drawn pose. Three coordinates a body: z of its
   centre of mass, up from the carrier, and its turns about x and y, axes of the world.
   Theory: docs/theory/effects/out-of-plane.md. */
#ifndef FW_MECHANISM_MECHANISM_PLATES_H
#define FW_MECHANISM_MECHANISM_PLATES_H
#include "mechanism/mechanism.h"

enum { FW_MECHANISM_PLATES_MOST = 100 }; /* bodies: dense matrices */

typedef struct fw_mechanism_plate_hinge {
    fw_geometry_vec2 pin;    /* world */
    double c[3][3], k[3][3]; /* about it, axes of the world: m/N .. rad/(N m), and its inverse */
    double length_m, bend_Nm2,
        twist_Nm2; /* fw_flexure_out_of_plane, scale of a stated stiffness included */
    double error;  /* relative */
} fw_mechanism_plate_hinge;

typedef struct fw_mechanism_plates {
    const fw_mechanism *mechanism;
    const char
        *why; /* a clause: what is missing so that modes and answers are not known. NULL: known */
    int n; /* 3 nbody; 0: nothing is known. With a `why` it is only what tips the device, which needs no masses */
    double *mass;                    /* (9 nbody) of each body, row-major: kg, kg m, kg m2 */
    double *stiffness;               /* (n x n) */
    fw_mechanism_plate_hinge *hinge; /* (nhinge) */
    double *per_s2, *f_Hz;           /* (n) omega^2, ascending; frequencies */
    double *shape;                   /* (n x n) row k: of mode k, M-orthonormal */
    double error;                    /* relative, of stiffnesses: the largest of any flexure */
} fw_mechanism_plates;

/* give (9 nhinge) or NULL: compliance that is added to that of each flexure, about its pin */
fw_status fw_mechanism_plates_new(fw_arena *arena, const fw_mechanism *mechanism,
                                  const double *give, fw_mechanism_plates *plates);

/* The n-th (from 1) of two lists of frequencies, in the plane and across it, each ascending and `step` bytes apart,
   counted as `plane` says: its number in its own list from 0, or -1, there is none; *across: which list */
typedef struct fw_mechanism_frequencies {
    const double *f_Hz;
    int count;
    size_t step;
} fw_mechanism_frequencies;
int fw_mechanism_plates_nth(int n, fw_device_plane plane, fw_mechanism_frequencies in,
                            fw_mechanism_frequencies out, bool *across);
/* body that has most of a mode's energy; *tilts: more of it in its turns */
int fw_mechanism_plates_mover(const fw_mechanism_plates *plates, int mode, bool *tilts);

/* compliance (n x n) of all coordinates: across the plane, of (z, turns about x, y) a body; and in it, of (x, y, turn),
   without drivers, stops and what is no flexure, give (9 nhinge) or NULL added about each pin, of (turn, x, y). false in
   *known: the device is not held in the plane */
fw_status fw_mechanism_plates_across(fw_arena *arena, const fw_mechanism_plates *plates,
                                     double **compliance);
fw_status fw_mechanism_plates_beside(fw_arena *arena, const fw_mechanism_plates *plates,
                                     const double *give, double **compliance, bool *known);

/* adds the stiffness (n x n) in the plane, of x, y and unit_m times the turn */
fw_status fw_mechanism_plates_in_plane(const fw_mechanism_plates *plates, const double *give,
                                       double unit_m, double *stiffness);

/* x (n) of generalised forces f (n): N, N m about the centres of mass */
void fw_mechanism_plates_answer(const fw_mechanism_plates *plates, const double *f, double *x);
/* (Fz, Mx, My) that a flexure bears about its pin when the bodies are at x (n), counted from a sphere of that curvature
   (fw_mechanism_plates_curl; 0: from the plane), in its own frame and of its own stiffness */
void fw_mechanism_plates_wrench(const fw_mechanism_plates *plates, int hinge, const double *x,
                                double curvature_per_m, double wrench[3]);
/* z of a point of a body, drawn place in the world */
double fw_mechanism_plates_z(const fw_mechanism_plates *plates, const double *x, int body,
                             fw_geometry_vec2 at);
/* f (n) of an acceleration of all masses along z */
void fw_mechanism_plates_weight(const fw_mechanism_plates *plates, double m_per_s2, double *f);
/* f (n) of a layer that is free to curl to a sphere of this curvature, > 0 with its edges up, and is held flat by
   the ground. x of it is counted from the sphere about *middle */
void fw_mechanism_plates_curl(const fw_mechanism_plates *plates, double curvature_per_m,
                              fw_geometry_vec2 *middle, double *f);

typedef struct fw_mechanism_plates_reach { /* of all that is drawn of the bodies */
    double lowest_m, highest_m, tilt_rad;
    int low, high, tilted; /* the bodies; FW_NONE: nothing is drawn */
} fw_mechanism_plates_reach;
/* mechanism_faces.c: of x (n), on a sphere of that curvature about `middle` (0: none), and either way of what rings:
   amplitude (n) of the modes, or NULL. Exact over what is drawn where nothing rings, else bounds */
fw_mechanism_plates_reach fw_mechanism_plates_reached(const fw_mechanism_plates *plates,
                                                      const double *x, const double *ring,
                                                      double curvature_per_m,
                                                      fw_geometry_vec2 middle);
/* amplitude (n) of every mode under an acceleration along z, at rest: phi_k . f/omega_k^2 */
void fw_mechanism_plates_modal(const fw_mechanism_plates *plates, const double *f,
                               double *amplitude);

typedef struct
    fw_mechanism_plates_stiff { /* at the centre of mass of the body that gives most across the plane */
    int body;
    double across_N_per_m,
        in_N_per_m; /* in: the least of all directions, drivers and stops left aside */
} fw_mechanism_plates_stiff;
fw_status fw_mechanism_plates_stiffness(fw_arena *arena, const fw_mechanism_plates *plates,
                                        fw_mechanism_plates_stiff *out);

/* Factor on forces in the plane at which the device tips out of it, a lower bound. HUGE_VAL: none does. *hinge: the
   flexure that tips most easily by itself, or FW_NONE */
typedef struct fw_mechanism_plates_pressed {
    const double *force_N; /* (2 nhinge) of each flexure on body b, world axes */
    /* (3 nhinge) of each flexure the largest force that presses it, squared, moment, and force across it, squared; of
       one that is not straight both forces are the whole one */
    const double *most;
    /* (nbody) sum of |F| times the distance from the centre of mass of all else that acts on a body but its inertia;
       NaN: not known, and what the joints leave over is taken to act at its farthest corner */
    const double *else_Nm;
    double enough; /* from this factor on a lesser one that is no less than it will do; 0: never */
} fw_mechanism_plates_pressed;
fw_status fw_mechanism_plates_buckling(fw_arena *arena, const fw_mechanism_plates *plates,
                                       const fw_mechanism_plates_pressed *by, double *factor,
                                       int *hinge);

/* ---- mechanism_pull.c: what pulls faces together that stand opposite each other across a gap ---- */

typedef struct fw_mechanism_face {
    int body[2];     /* FW_GROUND: what stands */
    double by[2][3]; /* by how much the gap closes by their three coordinates */
    double area_m2, gap_m;
    bool strip;  /* a flexure's own, where the gap differs along it */
    double more; /* share by which lines of liquid along its edges may pull beyond the pressure */
    fw_geometry_vec2 at, normal; /* world; normal 0: it faces the carrier */
    int piece[2];                /* of the layout; FW_NONE: not drawn, or the carrier */
} fw_mechanism_face;

typedef enum fw_mechanism_pull {
    FW_PULL_EACH, /* each face is pulled by s (1 + more)/its own gap: at least as much as a liquid does */
    FW_PULL_WIDEST /* plates alone, by s/the widest gap of each: what is left when the meniscus has come to its edge */
} fw_mechanism_pull;

/* N/m: the largest s that leaves an equilibrium that is stable and where nothing touches, to 0.5 %, below it for EACH and
   above it for WIDEST; compliance (n x n) of the bodies' coordinates. HUGE_VAL: no gap closes. Where a bound shows that
   it is above enough_N_per_m the bound is the answer. *first: the face that is nearest to its touch, or FW_NONE */
fw_status fw_mechanism_pull_in(fw_arena *arena, const double *compliance, int n,
                               const fw_mechanism_face *face, int nface, fw_mechanism_pull law,
                               double enough_N_per_m, double *tension, int *first);

typedef struct fw_mechanism_faces { /* a list that grows */
    fw_arena *arena;
    fw_mechanism_face *face;
    size_t count, room;
} fw_mechanism_faces;
fw_status fw_mechanism_faces_add(fw_mechanism_faces *to, const fw_mechanism_face *face);

/* undersides of all that moves over the carrier, cells of what is drawn; bodies in one row each where nothing is */
fw_status fw_mechanism_faces_below(fw_arena *arena, const fw_mechanism_plates *plates, double gap_m,
                                   fw_mechanism_face **face, int *nface);
/* Gaps (n) to a carrier that is gap_m away from the plane: as they are at rest, where weight and a curvature that a gradient of
   stress gives have lowered or lifted bodies, `more` times as far as computed. *down, *up: by how much at most */
fw_status fw_mechanism_faces_rest(fw_arena *arena, const fw_mechanism_plates *plates,
                                  double curvature_per_m, double gap_m, double more,
                                  fw_mechanism_face *face, int n, double *down, double *up);
/* ---- mechanism_walls.c: all that stands on the carrier, edge by edge, and rays from one to another ---- */

typedef struct fw_mechanism_wall {
    fw_geometry_vec2 a, b; /* the material to the left */
    int solid, piece;      /* solid: a body, FW_GROUND, or FW_MECHANISM_FLEXED - joint of a strip */
} fw_mechanism_wall;
enum { FW_MECHANISM_FLEXED = -1000 };
/* rays along an edge; - cos of the angle between the normals of two walls that face each other */
#define FW_MECHANISM_RAYS_m 15e-6
#define FW_MECHANISM_FACING 0.7
typedef struct fw_mechanism_walls {
    fw_arena *arena;
    fw_mechanism_wall *wall;
    int nwall, nx, ny;
    fw_geometry_box box;
    double side_m;   /* of a bin */
    int *begin, *in; /* (nx ny + 1) of each bin, into its walls */
} fw_mechanism_walls;
fw_status fw_mechanism_walls_take(fw_arena *arena, const fw_mechanism *mechanism,
                                  fw_mechanism_walls *walls);
/* the nearest wall but `own` that the ray from p along the unit vector n meets within 200 um, and how far away; -1: none */
int fw_mechanism_walls_look(const fw_mechanism_walls *walls, int own, fw_geometry_vec2 p,
                            fw_geometry_vec2 n, double *gap);

/* Walls that stand opposite each other, seen along the normals of what moves: bodies (one face for each two walls), and
   strips of flexures. As fabricated where the layout says so. */
typedef struct fw_mechanism_strip_beside { /* of hinge k */
    double gap_m; /* the least of the middle half of its strip; HUGE_VAL: nothing is beside it */
    fw_geometry_vec2 at;
    int piece;
} fw_mechanism_strip_beside;
fw_status fw_mechanism_faces_beside(fw_arena *arena, const fw_mechanism *mechanism,
                                    const fw_mechanism_walls *walls, fw_mechanism_face **face,
                                    int *nface, fw_mechanism_strip_beside *strip);
/* Sections of the material along its outlines (mechanism_walls.c), for what is slender between two of its walls (mechanism_limbs.c) */

typedef struct fw_mechanism_station { /* of a wall */
    int wall, chain;
    fw_geometry_vec2 at, normal;
    double length_m, thick_m, gap_m;
    int back, opposite; /* station at its back; wall across its gap. FW_NONE: nothing is there */
    int limb, node;     /* innermost that bends with it; FW_NONE: it is stiff */
} fw_mechanism_station;

typedef struct fw_mechanism_chain { /* of walls, from where the outline is held, or once round */
    int first, count, begin; /* stations; the one where it begins: nothing that hangs lies across */
    bool closed;
} fw_mechanism_chain;

typedef struct fw_mechanism_section {
    int chain, lo,
        hi; /* what is from the one to the other along the chain, from its begin on, hangs on it */
    int at, parent, heir, branches; /* at: its station */
    double thick_m, long_m;         /* long: to its farthest tip */
    bool slender, stands;           /* stands: it hangs on nothing */
    int limb, node;
    fw_geometry_vec2 middle;
} fw_mechanism_section;

typedef struct fw_mechanism_sections {
    const fw_mechanism_walls *w;
    const fw_mechanism *m;
    int *next, *before; /* (nwall) FW_NONE */
    bool *hole;         /* (nwall) of a release hole */
    int *first;         /* (nwall) station; FW_NONE: it has none */
    fw_mechanism_station *station;
    fw_mechanism_chain *chain;
    fw_mechanism_section *section; /* as they lie in one another, from the outermost on */
    int nstation, nchain, nsection;
} fw_mechanism_sections;
fw_status fw_mechanism_sections_take(const fw_mechanism *mechanism, const fw_mechanism_walls *walls,
                                     fw_mechanism_sections *sections);
/* place of a station along its chain, and back; where a point of a wall belongs to; middle of what lies behind a station */
int fw_mechanism_sections_place(const fw_mechanism_sections *sections, int station);
int fw_mechanism_sections_station(const fw_mechanism_sections *sections, int chain, int place);
int fw_mechanism_sections_nearest(const fw_mechanism_sections *sections, int wall,
                                  fw_geometry_vec2 at);
fw_geometry_vec2 fw_mechanism_sections_middle(const fw_mechanism_sections *sections,
                                              const fw_mechanism_station *station);
void fw_mechanism_sections_across(const fw_mechanism_sections *sections,
                                  fw_mechanism_station *station);

/* What of a body is slender, and bends towards what stands beside it: of every such wall whose liquid pulls it there at less
   than enough_N_per_m, s that it bears, to 1 % below it */
typedef struct fw_mechanism_limb {
    double tension_N_per_m, gap_m;
    int piece[2],
        body[2]; /* of the layout: its own, and what faces it; FW_GROUND: what stands, or a flexure */
    bool limbs;          /* what faces it bends as well */
    fw_geometry_vec2 at; /* where it meets first */
    int limb[2], order;  /* limb: numbers, FW_NONE: what faces it is stiff */
} fw_mechanism_limb;
fw_status fw_mechanism_limbs_beside(const fw_mechanism *mechanism, const fw_mechanism_walls *walls,
                                    double enough_N_per_m, fw_mechanism_limb **limb, int *nlimb);
/* A strip clamped at both ends, s (1 + more)/(gap that is left) over its width: the largest s */
double fw_mechanism_strip_pull_in(double bend_Nm2, double length_m, double width_m, double gap_m,
                                  double more);

/* what a scene asks of the plates: an acceleration across the plane that changes in time (az), that or weight (gz) or a
   stress gradient, and the curvature such a gradient g gives a free plate, g/M of the biaxial modulus M; 0 where E is not known */
bool fw_mechanism_plates_shaken(const fw_device_scene *scene);
bool fw_mechanism_plates_asked(const fw_device_scene *scene);
double fw_mechanism_plates_curvature(const fw_mechanism *mechanism, const fw_device_scene *scene);
#endif
