/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The joint forces that hold a pose of the six-bar, and the strain that they and the rotations make
   in every hinge, over boxes of poses. Private to the room, its tests and the certificate.

   Jets: what is computed of a box. Sections: what a hinge is to the strain. Actuators: what may hold the pose; a grip
   is three of them. Statics: from the pose to the joint forces. */
#ifndef FW_WORKSPACE_POSE_LOAD_H
#define FW_WORKSPACE_POSE_LOAD_H
#include "maths/maths_interval.h"
#include "workspace/loop.h"

/* ---- jets: a quantity over a box of poses with its slopes ---- */

/* A quantity over a box of poses with its derivatives by x, y and phi, all four in centred form, so
   that what is made of many operations is still bounded to second order in the size of the box.
   Private to the room and its tests. */

typedef struct fw_workspace_jet {
    fw_maths_centred v, d[3];
} fw_workspace_jet;

typedef struct fw_workspace_jet2 {
    fw_workspace_jet x, y;
} fw_workspace_jet2;

static inline fw_workspace_jet fw_jet_exact(double x) {
    return (fw_workspace_jet){.v = {x, 0.0, 0.0}};
}

static inline fw_workspace_jet fw_jet_add(fw_workspace_jet a, fw_workspace_jet b) {
    a.v = fw_centred_add(a.v, b.v);
    for (int i = 0; i < 3; i++)
        a.d[i] = fw_centred_add(a.d[i], b.d[i]);
    return a;
}

static inline fw_workspace_jet fw_jet_sub(fw_workspace_jet a, fw_workspace_jet b) {
    a.v = fw_centred_sub(a.v, b.v);
    for (int i = 0; i < 3; i++)
        a.d[i] = fw_centred_sub(a.d[i], b.d[i]);
    return a;
}

static inline fw_workspace_jet fw_jet_scaled(fw_workspace_jet a, double k) {
    a.v = fw_centred_scaled(a.v, k);
    for (int i = 0; i < 3; i++)
        a.d[i] = fw_centred_scaled(a.d[i], k);
    return a;
}

static inline fw_workspace_jet fw_jet_negated(fw_workspace_jet a) {
    a.v = fw_centred_negated(a.v);
    for (int i = 0; i < 3; i++)
        a.d[i] = fw_centred_negated(a.d[i]);
    return a;
}

static inline fw_workspace_jet fw_jet_mul(fw_workspace_jet a, fw_workspace_jet b) {
    fw_workspace_jet c = {.v = fw_centred_mul(a.v, b.v)};
    for (int i = 0; i < 3; i++)
        c.d[i] = fw_centred_add(fw_centred_mul(a.d[i], b.v), fw_centred_mul(a.v, b.d[i]));
    return c;
}

static inline fw_workspace_jet fw_jet_inverse(fw_workspace_jet a) {
    fw_workspace_jet c = {.v = fw_centred_inverse(a.v)};
    fw_maths_centred slope = fw_centred_negated(fw_centred_mul(c.v, c.v));
    for (int i = 0; i < 3; i++)
        c.d[i] = fw_centred_mul(slope, a.d[i]);
    return c;
}

static inline fw_workspace_jet fw_jet_sqrt(fw_workspace_jet a) {
    fw_workspace_jet c = {.v = fw_centred_sqrt(a.v)};
    fw_maths_centred slope = fw_centred_scaled(fw_centred_inverse(c.v), 0.5);
    for (int i = 0; i < 3; i++)
        c.d[i] = fw_centred_mul(slope, a.d[i]);
    return c;
}

/* |f(c + s d) - f(c)| <= s sum |d_i| max |f_i'|: linear in s, as centred forms ask */
static inline double fw_jet_reach(const fw_workspace_jet *a, const double half[3]) {
    double reach = 0.0;
    for (int i = 0; i < 3; i++)
        reach += half[i] * (fabs(a->d[i].m) + a->d[i].r);
    return fw_grown(fw_grown(reach) + a->v.e);
}

/* the smaller of both radii: that of the operations, and that of the derivatives */
static inline fw_workspace_jet fw_jet_tight(fw_workspace_jet a, const double half[3]) {
    double reach = fw_jet_reach(&a, half);
    if (reach < a.v.r) a.v.r = reach;
    return a;
}

/* f(c + d) = f(c) + g(c).d within sum |d_i| (g_i.e + g_i.r)/2 (maths_interval.h) */
static inline fw_maths_interval fw_jet_range(const fw_workspace_jet *a, const double half[3]) {
    double reach = a->v.e;
    for (int i = 0; i < 3; i++)
        reach += half[i] * (fabs(a->d[i].m) + 0.5 * (a->d[i].e + a->d[i].r));
    reach = fw_grown(fw_grown(reach));
    if (!(reach < a->v.r)) reach = a->v.r;
    return (fw_maths_interval){fw_down(a->v.m - reach), fw_up(a->v.m + reach)};
}

/* ---- of the plane ---- */

static inline fw_workspace_jet2 fw_jet2_exact(double x, double y) {
    return (fw_workspace_jet2){fw_jet_exact(x), fw_jet_exact(y)};
}

static inline fw_workspace_jet2 fw_jet2_add(fw_workspace_jet2 a, fw_workspace_jet2 b) {
    return (fw_workspace_jet2){fw_jet_add(a.x, b.x), fw_jet_add(a.y, b.y)};
}

static inline fw_workspace_jet2 fw_jet2_sub(fw_workspace_jet2 a, fw_workspace_jet2 b) {
    return (fw_workspace_jet2){fw_jet_sub(a.x, b.x), fw_jet_sub(a.y, b.y)};
}

static inline fw_workspace_jet2 fw_jet2_times(fw_workspace_jet2 a, fw_workspace_jet k) {
    return (fw_workspace_jet2){fw_jet_mul(a.x, k), fw_jet_mul(a.y, k)};
}

static inline fw_workspace_jet fw_jet2_dot(fw_workspace_jet2 a, fw_workspace_jet2 b) {
    return fw_jet_add(fw_jet_mul(a.x, b.x), fw_jet_mul(a.y, b.y));
}

static inline fw_workspace_jet fw_jet2_cross(fw_workspace_jet2 a, fw_workspace_jet2 b) {
    return fw_jet_sub(fw_jet_mul(a.x, b.y), fw_jet_mul(a.y, b.x));
}

static inline fw_workspace_jet2 fw_jet2_quarter(fw_workspace_jet2 a) { /* J a */
    return (fw_workspace_jet2){fw_jet_negated(a.y), a.x};
}

/* a fixed vector turned by the rotation of which `turn` is (cos, sin) */
static inline fw_workspace_jet2 fw_jet2_turned(fw_workspace_jet2 turn, double x, double y) {
    return (fw_workspace_jet2){fw_jet_sub(fw_jet_scaled(turn.x, x), fw_jet_scaled(turn.y, y)),
                               fw_jet_add(fw_jet_scaled(turn.x, y), fw_jet_scaled(turn.y, x))};
}

/* one rotation after another */
static inline fw_workspace_jet2 fw_jet2_both(fw_workspace_jet2 a, fw_workspace_jet2 b) {
    return (fw_workspace_jet2){fw_jet2_dot((fw_workspace_jet2){a.x, fw_jet_negated(a.y)}, b),
                               fw_jet_add(fw_jet_mul(a.x, b.y), fw_jet_mul(a.y, b.x))};
}

/* ---- pose_view.c: places along a flexure at which its strain is looked at ---- */

/* strain = bending |K theta - lever.F| + axial |F|, F the joint's force on its second body in the
   frame half turned; N m, N */
typedef struct fw_workspace_station {
    double lever_m[2], bending_per_Nm, axial_per_N;
} fw_workspace_station;

typedef struct fw_workspace_section {    /* of one of the six hinges */
    double spring_Nm_per_rad;            /* what the joint does to its bodies */
    double moment_Nm_per_rad;            /* what bends the flexure: its own stiffness */
    double axis[2];                      /* direction of its axis, as drawn */
    const fw_workspace_station *station; /* (n) */
    int n;                               /* 0: no flexure, no strain */
    int roots;                           /* the first ones; all others are below `inside` */
    fw_workspace_station inside;         /* not looked at where all stations are roots */
} fw_workspace_section;

fw_status fw_workspace_sections(fw_arena *arena, const fw_mechanism *mechanism,
                                fw_workspace_section section[FW_SIX]);

/* ---- actuation.c: what holds a pose ---- */

typedef enum fw_workspace_actuator_kind {
    FW_ACTUATOR_TORQUE,    /* on a body */
    FW_ACTUATOR_FORCE,     /* at a point of a body, in a fixed direction */
    FW_ACTUATOR_TENDON,    /* along a cable through points of bodies */
    FW_ACTUATOR_ELECTRODES /* at a point of a body, in a direction that turns with another */
} fw_workspace_actuator_kind;

typedef struct fw_workspace_body_point {
    int body;        /* 0..4 or FW_GROUND */
    double x_m, y_m; /* world, as drawn */
} fw_workspace_body_point;

/* of size 1 N, or 1 N times the length of the platform */
typedef struct fw_workspace_actuator {
    fw_workspace_actuator_kind kind;
    int body;            /* torque */
    int against;         /* electrodes: the body that the direction turns with */
    double direction[2]; /* unit vector, as drawn */
    const fw_workspace_body_point *point;
    int npoint;
    bool pulls;     /* not the other way round */
    bool platform;  /* a component of the wrench on the platform about its centre of mass */
    const char *id; /* "torque on AB" */
} fw_workspace_actuator;

typedef struct fw_workspace_grip { /* three actuators that hold the pose */
    int actuator[3];
    bool wrench;      /* all three are the platform's wrench */
    const char *name; /* "torque on AB, force on CD" */
} fw_workspace_grip;

/* What acts at a pose whatever holds it, a spring, a weight, what is touched: k (l - length), of the kind of an
   actuator. l is the distance of a tendon's two points; of electrodes the way from `from` to their point along their
   direction; a force has a size of its own. */
typedef enum fw_workspace_sense {
    FW_BOTH_WAYS,
    FW_WHERE_LONGER,
    FW_WHERE_SHORTER
} fw_workspace_sense;
typedef struct fw_workspace_given {
    fw_workspace_actuator by;
    fw_workspace_body_point from;
    double size_N, stiffness_N_per_m, length_m;
    fw_workspace_sense sense; /* 0 where it is not so */
} fw_workspace_given;

static inline double fw_workspace_given_size(const fw_workspace_given *g, double l) {
    double size = g->stiffness_N_per_m * (l - g->length_m);
    if (g->by.kind == FW_ACTUATOR_FORCE) return g->size_N;
    return g->sense == FW_BOTH_WAYS      ? size
           : g->sense == FW_WHERE_LONGER ? fmax(size, 0)
                                         : fmin(size, 0);
}

/* poses that were looked at before: pose_view.c */
typedef struct fw_workspace_poses fw_workspace_poses;

/* what is held by what: of one flow */
struct fw_workspace_hold {
    const fw_workspace_loop *loop;
    fw_workspace_poses *poses; /* where poses are looked up and kept; NULL: nowhere */
    fw_workspace_section section[FW_SIX];
    fw_geometry_vec2 at[5]; /* point of every body that moments are about, as drawn */
    double length_m;        /* of the platform, C to D: scale of torques */
    const fw_workspace_actuator *actuator;
    int nactuator;
    const fw_workspace_grip *grip;
    int ngrip;
    /* the three of the scenes' actuators that hold the box best where none does well, and their least volume; NULL */
    const char *badly_by;
    double badly;
    const fw_workspace_given *given; /* (ngiven) */
    int ngiven;
    const char *given_by; /* all of it, to be read; NULL: nothing is given */
    const char *unknown;  /* acts, too, with a force that the pose does not tell; NULL: nothing */
    /* points of the ground stand at p + strain (p - middle): the loop has its own there already */
    double strain;
    fw_geometry_vec2 middle;
    /* Dry friction of the hinges takes a torque of either sign up to rub_arm_m (rub_preload_N + joint force): largest
       coefficient times radius */
    bool rubs;
    double rub_arm_m[FW_SIX], rub_preload_N[FW_SIX]; /* 0: has none */
};

/* which grips there are over a box: triples that hold all of it */
fw_status fw_workspace_hold_of(fw_arena *arena, const fw_mechanism *mechanism,
                               const fw_workspace_loop *loop, const fw_workspace_box3 *box,
                               fw_workspace_poses *poses, fw_workspace_hold *hold);

/* of the ground's points, m, where a layer that grows or shrinks has them */
static inline fw_geometry_vec2 fw_workspace_on_ground(const fw_workspace_hold *h, double x,
                                                      double y) {
    if (h->strain == 0) return (fw_geometry_vec2){x, y};
    return (fw_geometry_vec2){x + h->strain * (x - h->middle.x), y + h->strain * (y - h->middle.y)};
}

/* Poses are those beside the substrate, which stays as it is drawn: from there to the layer's own lengths, and back. of: a
   displacement of the platform's centre of mass */
static inline fw_geometry_vec2 fw_workspace_in_layer(const fw_workspace_hold *h, double x,
                                                     double y) {
    const fw_geometry_vec2 c = h->loop->centre, at = fw_workspace_on_ground(h, c.x + x, c.y + y);
    return h->strain == 0 ? (fw_geometry_vec2){x, y} : (fw_geometry_vec2){at.x - c.x, at.y - c.y};
}
static inline fw_geometry_vec2 fw_workspace_on_substrate(const fw_workspace_hold *h, double x,
                                                         double y) {
    const fw_geometry_vec2 shift = fw_workspace_in_layer(h, 0, 0);
    return h->strain == 0 ? (fw_geometry_vec2){x, y}
                          : (fw_geometry_vec2){(x - shift.x) / (1 + h->strain),
                                               (y - shift.y) / (1 + h->strain)};
}

/* adds what is given: springs, and weight, contacts and friction of that scene, or of none (NULL) */
fw_status fw_workspace_hold_given(fw_arena *arena, const fw_mechanism *mechanism,
                                  const fw_device_scene *scene, fw_workspace_hold *hold);
/* a scene of the mechanism that has something to give */
bool fw_workspace_scene_gives(const fw_mechanism *mechanism, const fw_device_scene *scene);
struct fw_workspace_result;
/* what a scene states and required poses neither count nor leave without force there: result->left_out */
fw_status fw_workspace_left_out(fw_arena *arena, const fw_mechanism *mechanism,
                                const fw_device_scene *scene, struct fw_workspace_result *result);

/* ---- pose_load.c: statics over a box ---- */

/* to one actuator, or to the hinges' own moments and what is given */
typedef struct fw_workspace_response {
    fw_workspace_jet2 force[FW_SIX]; /* of hinge i on its second body, N */
    fw_workspace_jet wrench[3];      /* that the platform lacks: N, N, N (times length_m) */
    bool on_leg[2];                  /* left, right: force is not 0 there */
} fw_workspace_response;

typedef struct fw_workspace_pose_load {
    double half[3];
    fw_workspace_jet2 turn[5];       /* (cos, sin) of every body's rotation */
    fw_workspace_jet2 a[2], b[2];    /* links of both legs, from the ground up */
    fw_workspace_jet2 to[2];         /* platform's centre of mass to C and D */
    fw_workspace_jet gain[2];        /* 1/(a x b) */
    fw_workspace_jet theta[FW_SIX];  /* joint angles */
    fw_workspace_jet2 frame[FW_SIX]; /* (cos, sin) of every hinge's axis, half turned */
    /* to the hinges' moments and what is given; last: the rest is of the pose alone */
    fw_workspace_response own;
} fw_workspace_pose_load;

/* where everything is: all of it but the forces. false: not every pose of the box is known to be reached. shift: what C
   and D are displaced by against the rest of the platform (m, four numbers), or NULL */
bool fw_workspace_pose_places(const fw_workspace_hold *hold, const fw_workspace_box3 *box,
                              const double *shift, fw_workspace_pose_load *out);
/* the response to the hinges' moments and what is given there */
void fw_workspace_pose_own(const fw_workspace_hold *hold, fw_workspace_pose_load *at);
/* both */
bool fw_workspace_pose_load_over(const fw_workspace_hold *hold, const fw_workspace_box3 *box,
                                 const double *shift, fw_workspace_pose_load *out);
void fw_workspace_pose_response(const fw_workspace_hold *hold, const fw_workspace_pose_load *at,
                                const fw_workspace_actuator *by, fw_workspace_response *out);
/* What friction may add under one grip, of either sign: to joint forces and sizes per unit of each torque, and bounds
   of these torques over the box (at a pose the two ends are the same): no choice of signs has more. HUGE_VAL: they
   press themselves without end. */
typedef struct fw_workspace_rub {
    bool rubs[FW_SIX];
    fw_workspace_jet2 force[FW_SIX][FW_SIX]; /* [of the torque][of the joint], N/(N m) */
    fw_workspace_jet size[FW_SIX][3];        /* of the grip's actuators */
    double least_Nm[FW_SIX], most_Nm[FW_SIX];
    double wider[3];       /* by which sizes may be larger or smaller */
    double more_N[FW_SIX]; /* by which joint forces may be larger */
} fw_workspace_rub;
/* Joint forces under one grip. response: (nactuator). false: this grip would have to push where it
   only pulls, all over the box; `certain`: at no pose of it, where friction is as it should be. own: of which legs the
   forces are what they are under a wrench on the platform. rub: set where the hold has friction. */
bool fw_workspace_pose_forces(const fw_workspace_hold *hold, const fw_workspace_pose_load *at,
                              const fw_workspace_response *response, const fw_workspace_grip *grip,
                              bool *certain, bool own[2], fw_workspace_jet2 force[FW_SIX],
                              fw_workspace_rub *rub);
/* at a pose: how strong its actuators are without friction; 0 of the wrench, and of one that reaches no joint */
void fw_workspace_grip_sizes(const fw_workspace_hold *hold, const fw_workspace_pose_load *at,
                             const fw_workspace_response *response, const fw_workspace_grip *grip,
                             double size[3]);
/* ---- pose_view.c: what that strains ---- */

/* range that holds the largest strain of a hinge at every pose of the box, and where in the box it
   grows to (signs of its slope; may be NULL). rub: no signs of friction make it larger; NULL: there is none */
fw_maths_interval fw_workspace_pose_strain(const fw_workspace_hold *hold,
                                           const fw_workspace_pose_load *at, int hinge,
                                           const fw_workspace_jet2 *force,
                                           const fw_workspace_rub *rub, double slope[3]);
/* of a pose: with which signs of friction (-1, 0, 1) the hinge is strained most */
void fw_workspace_rub_signs(const fw_workspace_hold *hold, const fw_workspace_pose_load *at,
                            int hinge, const fw_workspace_jet2 *force, const fw_workspace_rub *rub,
                            int sign[FW_SIX]);

/* ---- pose_view.c: boxes that are looked at ---- */

fw_status fw_workspace_poses_new(fw_arena *arena, fw_workspace_poses **poses);
/* What was kept of another mechanism than this hold is not found again; its sections are set, and with `whole` its
   actuators and grips, too, without which no forces are kept. */
void fw_workspace_poses_are_of(fw_workspace_poses *poses, const fw_workspace_hold *hold,
                               bool whole);
/* fw_workspace_pose_places without a shift, from what is kept where it is known there */
bool fw_workspace_poses_find(const fw_workspace_hold *hold, const fw_workspace_box3 *box,
                             fw_workspace_pose_load *out);

typedef struct fw_workspace_gripped {   /* a box that is held by one grip */
    bool known, holds, certain, own[2]; /* of fw_workspace_pose_forces */
    fw_workspace_jet2 force[FW_SIX];
    long section[FW_SIX]; /* with which `strain` was found; 0: with none */
    fw_maths_interval strain[FW_SIX];
    double slope[FW_SIX][3];
} fw_workspace_gripped;

typedef struct fw_workspace_view { /* a box of poses, of which is found what somebody asks for */
    const fw_workspace_hold *hold;
    fw_workspace_pose_load load;     /* its `own` only where `owned` */
    fw_workspace_response *response; /* (nactuator) */
    bool owned, *responded;          /* (nactuator) */
    struct placed *kept;             /* NULL: nowhere */
    long filled;                     /* of `kept`, as long as that is of this box */
    fw_workspace_gripped here;       /* what cannot be kept, of this grip */
    int here_of;
    fw_workspace_rub rub; /* of `here`, where the hold has friction */
} fw_workspace_view;
fw_status fw_workspace_view_new(fw_arena *arena, const fw_workspace_hold *hold,
                                fw_workspace_view *view);
/* false: not every pose of the box is known to be reached */
bool fw_workspace_view_at(fw_workspace_view *view, const fw_workspace_box3 *box);
/* fw_workspace_pose_forces and fw_workspace_pose_strain; valid until the next grip or box is asked for */
fw_workspace_gripped *fw_workspace_view_grip(fw_workspace_view *view, int grip);
fw_maths_interval fw_workspace_view_strain(const fw_workspace_view *view, fw_workspace_gripped *by,
                                           int hinge, double slope[3]);

/* ---- pose_strain.c: over a whole required box ---- */

/* Bounds of all strains by branch and bound, within `relative` of the truth; FW_UNDECIDED: more
   than `most` boxes. */
fw_status fw_workspace_certify_strain(fw_arena *arena, const fw_workspace_hold *hold,
                                      const fw_workspace_box3 *box, double relative, long most,
                                      fw_workspace_strain_proof *proof,
                                      fw_workspace_proof_end *end);
/* the same from samples; nothing is proved */
fw_status fw_workspace_sample_strain(fw_arena *arena, const fw_workspace_hold *hold,
                                     const fw_workspace_box3 *box,
                                     fw_workspace_strain_proof *proof);

/* does friction press itself without end in a corner or in the middle of the box? */
fw_status fw_workspace_presses_itself(fw_arena *arena, const fw_workspace_hold *hold,
                                      const fw_workspace_box3 *box, bool *itself);

/* ---- pose_give.c: what drift and give of the hinges change ---- */

typedef struct fw_workspace_give {
    bool first_order;           /* not known yet: by first order at the hinge's own worst pose */
    double added, give, relief; /* of fw_workspace_load */
} fw_workspace_give;
static const fw_workspace_give fw_workspace_nothing_known = {.give = HUGE_VAL, .relief = 1.0};
fw_status fw_workspace_gives(fw_arena *arena, const fw_workspace_hold *hold,
                             const fw_mechanism *mechanism, const fw_workspace_box3 *box,
                             const fw_workspace_strain_proof *proof,
                             fw_workspace_give give[FW_SIX]);
/* at: a pose that pins do not reach; NULL: they reach all of the box, and only turns are looked at. false: nothing is beyond */
bool fw_workspace_beyond_of(const fw_mechanism *mechanism, const fw_workspace_loop *loop,
                            const fw_workspace_box3 *box, const double *at,
                            fw_workspace_beyond *beyond);
/* What is known of a hinge at its worst pose beside the strain: see fw_workspace_load. */
fw_status fw_workspace_load_of(fw_arena *arena, const fw_workspace_hold *hold,
                               const fw_mechanism *mechanism,
                               const fw_workspace_strain_proof *proof, int hinge,
                               const fw_workspace_give *give, fw_workspace_load *load);
/* of two boxes: the one with the larger strain stays, with what the other one has when hinges give */
void fw_workspace_load_both(const fw_workspace_load *a, const fw_workspace_load *b,
                            fw_workspace_load *out);

#endif
