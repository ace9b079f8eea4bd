/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A flexure at finite rotation: how far its two ends' images of the elastic centre W drift apart,
   and how soft they are against each other, as functions of the rotation. Theory:
   docs/theory/effects/nonlinear-hinge.md. */
#ifndef FW_FLEXURE_FINITE_H
#define FW_FLEXURE_FINITE_H
#include "base/arena.h"
#include "flexure/flexure.h"

typedef struct fw_flexure_hinge_law {
    double stiffness_Nm_per_rad;
    double half_angle_rad; /* a of the free arc; 0: straight */
    double length_m;       /* L */
    double share; /* L/(L + 2 dL): of the rotation that the strip takes, the roots take the rest */
    double bend_m_per_N;                 /* L^3/(8 EI): of the strip */
    double root_m_per_N;                 /* dL L^2/(2 EI): of the two roots */
    double axial_m_per_N, shear_m_per_N; /* L/(2 EA), L/(2 kGA) */
    double uneven_x,
        uneven_y; /* of a crystal: share that bend_m_per_N is larger along and across */
    /* of a path (path.h): this instead of the above; else NULL */
    const struct fw_flexure_hinge_table *table;
} fw_flexure_hinge_law;

/* e of what a pull does to the chord (finite_force.c): a sixth of dL/L of one root; 0 where ends lose more than roots give, whose
   series holds no less */
static inline double fw_flexure_hinge_chord_roots(const fw_flexure_hinge_law *law) {
    const double half = law->bend_m_per_N > 0 ? 0.25 * law->root_m_per_N / law->bend_m_per_N : 0;
    return half > 0 ? law->share * half / 6 : 0;
}

/* numbers of a hinge for finite_lanes.c, over L, EI/L^2 and EI/L */
enum {
    FW_HINGE_STIFFNESS, /* K, N m */
    FW_HINGE_LENGTH,    /* L, m */
    FW_HINGE_PER_LENGTH,
    FW_HINGE_FORCE, /* EI/L^2, N */
    FW_HINGE_RANGE, /* |y| up to which its series hold; below 0: they do not */
    FW_HINGE_HALF_ANGLE,
    FW_HINGE_Q, /* share/2 */
    FW_HINGE_SINC,
    FW_HINGE_TURN,
    FW_HINGE_SINE,
    FW_HINGE_COSINE,
    FW_HINGE_ALONG, /* compliances of finite.c: of bending, */
    FW_HINGE_ACROSS,
    FW_HINGE_ROOT, /* of the roots, */
    FW_HINGE_ROOT_ACROSS,
    FW_HINGE_BOTH, /* axial and shear, their sum and shear less axial */
    FW_HINGE_APART,
    FW_HINGE_N,                            /* n(y) less 1: of y, y^2 .. y^6 */
    FW_HINGE_N_SLOPE = FW_HINGE_N + 6,     /* of its slope: of y, y^2 .. y^5 */
    FW_HINGE_N_CURVE = FW_HINGE_N + 6 + 5, /* of its second derivative: of y, y^2 .. y^4 */
    FW_HINGE_NUMBERS = FW_HINGE_N + 6 + 5 + 4
};

/* what the free arc gives at every rotation: sinc(a), share sinc'(a), sin(a), cos(a); of one law, to be
   asked for again when that is changed */
typedef struct fw_flexure_hinge_rest {
    double sinc, turn, sine, cosine;
    double number[FW_HINGE_NUMBERS];
} fw_flexure_hinge_rest;

/* value, first and second derivative by the rotation */
typedef struct fw_flexure_hinge_jet {
    double value, slope, curve;
} fw_flexure_hinge_jet;

typedef struct fw_flexure_hinge_at {
    fw_flexure_hinge_jet kx_N_per_m, ky_N_per_m; /* along and across the arc's axis, half turned */
    fw_flexure_hinge_jet drift_m; /* of W on the second body from W on the first, along y */
} fw_flexure_hinge_at;

/* The same as softness, in its parts, and what a pull along the chord does to them. Along (x) and
   across (y) the arc's axis, half turned. */
typedef struct fw_flexure_hinge_soft {
    fw_flexure_hinge_jet bend_x, bend_y; /* m/N of bending; across with the roots' part */
    fw_flexure_hinge_jet rest_x, rest_y; /* m/N of axial and shear force; along with the roots' */
    fw_flexure_hinge_jet drift_m;
} fw_flexure_hinge_soft;
void fw_flexure_hinge_law_soft(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                               double rotation_rad, bool second, fw_flexure_hinge_soft *at);

/* What a pull along the chord does to the arc as it is wound, and what is of fourth order: finite_force.c */
typedef struct fw_flexure_hinge_wound {
    fw_flexure_hinge_jet px, py, g4, h4, a4, n4;
    double per_N; /* L^2/EI; 0 of a table, which has neither a4 nor n4 */
} fw_flexure_hinge_wound;
void fw_flexure_hinge_law_wound(const fw_flexure_hinge_law *law, double rotation_rad, bool second,
                                fw_flexure_hinge_wound *at);

void fw_flexure_hinge_law_of(const fw_flexure_input *in, const fw_flexure_result *closed_form,
                             fw_flexure_hinge_law *law);
/* all of its stiffness times `by` (above 0); a table becomes the law's own */
fw_status fw_flexure_hinge_law_scale(fw_arena *arena, fw_flexure_hinge_law *law, double by);
/* a strip along one line, of any width */
bool fw_flexure_hinge_law_straight(const fw_flexure_hinge_law *law);
/* its stiffness against forces alone `by` times (above 0): of a straight strip along itself, of all else both ways */
fw_status fw_flexure_hinge_law_along(fw_arena *arena, fw_flexure_hinge_law *law, double by);
void fw_flexure_hinge_law_at(const fw_flexure_hinge_law *law, double rotation_rad,
                             fw_flexure_hinge_at *at);
/* values and first derivatives alone, for forces; the second ones are not */
fw_flexure_hinge_rest fw_flexure_hinge_rest_of(const fw_flexure_hinge_law *law);
/* for one rotation: without the numbers, which cost as much as the law; the law's forces are then always asked for in full */
fw_flexure_hinge_rest fw_flexure_hinge_rest_bare(const fw_flexure_hinge_law *law);
void fw_flexure_hinge_law_slopes(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                                 double rotation_rad, fw_flexure_hinge_at *at);
/* ---- finite_force.c: forces of any size ---- */

/* Energy of a flexure and its derivatives by (th, w, v): the rotation, and the displacement of the
   second body's W from the first one's along and across the axis, in the frame half turned */
typedef struct fw_flexure_hinge_bent {
    double energy_J, pull_N; /* pull_N: force across the axis, along the chord */
    double gradient[3];      /* N m, N, N */
    double hessian[3][3];    /* only where it was asked for */
    bool holds; /* within what the law was compared for (finite_force.c); else it goes on, smooth */
    /* without force at that rotation: stiffness along and across, slope of the drift */
    double kx_N_per_m, ky_N_per_m, drift_slope;
} fw_flexure_hinge_bent;
void fw_flexure_hinge_law_bend(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                               const double at[3], bool hessian, fw_flexure_hinge_bent *out);
/* ---- finite_lanes.c: many hinges side by side, without second derivatives ---- */

typedef struct fw_flexure_hinge_lanes {
    int count, widest; /* hinges; lanes at most, 1, 2, 4 or 8: the processor's */
    size_t stride;
    const double *number;        /* (FW_HINGE_NUMBERS x stride) */
    double *at;                  /* (3 x stride) th, w, v of all, written by the caller */
    fw_flexure_hinge_bent **out; /* (count) where answers go, likewise */
} fw_flexure_hinge_lanes;
fw_status fw_flexure_hinge_lanes_new(fw_arena *arena, int count,
                                     const fw_flexure_hinge_rest *const *rest,
                                     fw_flexure_hinge_lanes *lanes);
/* what fw_flexure_hinge_law_bend says, to the last bit, at lanes->at; known (count): false where that has to be
   asked itself, out is then as it was */
void fw_flexure_hinge_lanes_bend(const fw_flexure_hinge_lanes *lanes, bool *known);
/* FW_W hinges: bit i where out[i] is known; hinge: numbers, each `stride` from the one before */
#define FW_FLEXURE_LANES(width)                                                                    \
    unsigned fw_flexure_lanes_bend_##width(const double *hinge, size_t stride, const double *at,   \
                                           int count, fw_flexure_hinge_bent *const *out)
FW_FLEXURE_LANES(1);
FW_FLEXURE_LANES(2);
FW_FLEXURE_LANES(4);
FW_FLEXURE_LANES(8);
/* of t = x^2 <= 1: sinc; g; h/t. Taylor's series with Chebyshev's polynomials of the next degrees taken away: 1e-16, 6e-17
   and 2e-16 of the function */
static const double fw_flexure_sinc_of[8] = {1,
                                             -0.16666666666666666,
                                             0.008333333333333106,
                                             -0.00019841269841087476,
                                             2.7557319152309194e-06,
                                             -2.5052093083699724e-08,
                                             1.6057233337039862e-10,
                                             -7.535488064487613e-13};
static const double fw_flexure_g_of[8] = {
    0.6666666666666666,     -0.13333333333332525,   0.01269841269824269,    -0.0007054673707724874,
    2.5653353629569092e-05, -6.577669808238979e-07, 1.2515523883035058e-08, -1.758251005351794e-10};
static const double fw_flexure_h_of[8] = {
    0.044444444444444446,   -0.006349206349206286, 0.0004232804232790905, -1.710223931378956e-05,
    4.6984169770327625e-07, -9.39674506355024e-09, 1.43200461726794e-10,  -1.6581003589886058e-12};
/* What a pull does, by how far the arc is wound: polynomials in x^2 on [0, pi], alpha and beta (1e-5, 1e-8 off), g4 and h4
   (1e-4, 1e-3), a4 and n4 (6e-6, 1e-11) */
enum { FW_WINDING_TERMS = 8 };
static const double fw_flexure_winding[6][FW_WINDING_TERMS] = {
    {0.9999938136439734, 0.05718714905417563, -0.06245087333766429, 0.005008597271293301,
     -0.00016895481715463692, 7.60229742361299e-06, -2.536864532903121e-08, -1.552608349343485e-08},
    {1.0000000070450015, -0.15714291342653472, 0.006663676802324393, -0.00011906356215448638,
     1.8120859051710829e-06, -1.2352991964091367e-08, 7.027535079541526e-10,
     -4.2162562013330835e-11},
    {0.5140185347141033, 0.08498159192350846, 0.00626446380071406, -0.0011819546835394265,
     0.00027430919173046536, -6.40984446250425e-05, 4.0844215727947085e-06,
     -4.9551865098133094e-08},
    {0.30851019993467355, -0.01878233813269975, -0.01554799902810932, -0.005699514040496883,
     0.0017581665974348401, -0.0005461634586697807, 8.200778895512981e-05, -3.696275822588733e-06},
    {0, 0.00019303110553626129, -0.00010717859107173158, 5.5577391374892374e-05,
     -1.6687184101909937e-05, 2.4384508568566684e-06, -1.6653777306682087e-07,
     4.2763896609386958e-09},
    {0, -5.2566462489825575e-05, 7.0779069283274877e-06, -4.2782996206045487e-07,
     1.6089728585605016e-08, -4.0521036928134123e-10, 6.9245011467490211e-12,
     -8.2930693630117909e-14}};

/* (w, v), the moment about th and the pull px F under a force (along, across) that is given; false:
   no such equilibrium */
bool fw_flexure_hinge_law_under(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                                double rotation_rad, const double force_N[2], double displaced_m[2],
                                double *moment_Nm, double *pull);
/* the same of many forces at one rotation: what does not depend on them is worked out once; the law is
   to live as long */
typedef struct fw_flexure_hinge_rotated {
    const fw_flexure_hinge_law *law;
    fw_flexure_hinge_soft soft;
    fw_flexure_hinge_wound wound;
    double rotation_rad, roots; /* roots: dL/6L of one, times the share of the strip */
    double least_N, most_N;     /* forces across below and above which it buckles */
} fw_flexure_hinge_rotated;
void fw_flexure_hinge_law_rotated(const fw_flexure_hinge_law *law,
                                  const fw_flexure_hinge_rest *rest, double rotation_rad,
                                  fw_flexure_hinge_rotated *at);
bool fw_flexure_hinge_rotated_under(const fw_flexure_hinge_rotated *at, const double force_N[2],
                                    double displaced_m[2], double *moment_Nm, double *pull);
/* (w, v) and the rest where w is known and the force along is not needed; false: pressed beyond the
   buckling load of clamped ends */
bool fw_flexure_hinge_law_held(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                               double rotation_rad, double pull_N, double w_m,
                               double displaced_m[2], double *moment_Nm, double *pull);
/* What the hinge does to a twist (theta, ux, uy) of the second body's W against the first one's, u
   in the first body's frame with x along the free arc's axis: wrench (M, Fx, Fy) that it takes, the
   gradient of the energy by the twist, and its symmetric tangent (NULL: not asked for); SI */
void fw_flexure_hinge_law_wrench(const fw_flexure_hinge_law *law, const fw_flexure_hinge_rest *rest,
                                 const double twist[3], double wrench[3], double tangent[3][3]);
/* the same from what is bent at a state (th, w, v) of the frame half turned, and that of a twist */
typedef struct fw_flexure_half_turned {
    double at[3], cosine, sine; /* of th/2 */
} fw_flexure_half_turned;
fw_flexure_half_turned fw_flexure_hinge_half_turned(const double twist[3]);
void fw_flexure_hinge_wrench_of(const fw_flexure_hinge_bent *bent,
                                const fw_flexure_half_turned *half, double wrench[3],
                                double tangent[3][3]);
/* ---- beam_chart.c: the exact beam's own law, by a lattice of its solutions ---- */

typedef struct fw_flexure_chart fw_flexure_chart;
struct fw_flexure_elastica;
/* law: the same flexure's, where solutions begin. Both must live as long; some 300 kB */
fw_status fw_flexure_chart_new(fw_arena *arena, const fw_flexure_hinge_law *law,
                               struct fw_flexure_elastica *solver, fw_flexure_chart **out);
/* at (th, w, v), as fw_flexure_hinge_law_bend without the stiffnesses of no force; false: the lattice
   does not know, ask the beam */
bool fw_flexure_chart_bend(fw_flexure_chart *chart, const double at[3], bool hessian,
                           fw_flexure_hinge_bent *out);
/* does the law hold at this rotation? not where the flexure is wound up to a full circle */
bool fw_flexure_hinge_law_holds(const fw_flexure_hinge_law *law, double rotation_rad);
/* How a hinge's axis drifts, and where its conjugate surfaces meet: by a pure moment and under a
   given force. Theory: docs/theory/axis-drift.md. */

typedef struct fw_flexure_surfaces { /* conjugate surfaces, one on each body */
    double gap_m;
    double aside_rad;   /* zeta: least angle between the direction of the displacement and one in
                           which both surfaces are there; 0: they are there */
    double centre_m[2]; /* where both are drawn, from W along and across the axis: of a crystal */
    double offset_m;    /* of the first body's surface alone, from there along its +y */
} fw_flexure_surfaces;

typedef struct fw_flexure_drift_point {
    double rotation_rad;
    double drift_m; /* of W on the second body, along y of the frame half turned */
    double pole_m;  /* pole of the finite displacement less W, along x of that frame */
    double left_m;  /* of the gap: below 0 the surfaces would overlap */
} fw_flexure_drift_point;

/* pure moment */
fw_flexure_drift_point fw_flexure_drift_at(const fw_flexure_hinge_law *law,
                                           const fw_flexure_surfaces *surfaces,
                                           double rotation_rad);
/* n points, evenly from low to high */
void fw_flexure_drift_curve(const fw_flexure_hinge_law *law, const fw_flexure_surfaces *surfaces,
                            double low_rad, double high_rad, int n, fw_flexure_drift_point *point);
/* First rotation with the sign of `sense` (+1: winds the arc) at which the surfaces meet, the
   second body bearing a force (Fx, Fy) at W that keeps its direction in the first body's frame;
   NaN: at none below half a turn; 0: the force alone closes the gap. NULL: pure moment. */
double fw_flexure_drift_contact_rad(const fw_flexure_hinge_law *law,
                                    const fw_flexure_surfaces *surfaces, const double force_N[2],
                                    int sense);
/* displacement (ux, uy) of W in the first body's frame at a rotation under that force */
void fw_flexure_drift_displacement(const fw_flexure_hinge_law *law, double rotation_rad,
                                   const double force_N[2], double u_m[2]);

typedef struct fw_flexure_drift_advice {
    double offset_m;  /* of the first body's surface: fw_flexure_surfaces */
    double gap_m;     /* that is then needed for the whole range, by a pure moment */
    double centred_m; /* that is needed with both surfaces at W */
    double pivot_x_m; /* where, from W along the axis, a pin stands in for the hinge at the far end
                         of its range exactly, a quarter of the drift off between; 0 where the range
                         is as wide on either side: W is best */
} fw_flexure_drift_advice;
/* range of use, low <= 0 <= high */
fw_flexure_drift_advice fw_flexure_drift_advise(const fw_flexure_hinge_law *law, double low_rad,
                                                double high_rad);

#endif
