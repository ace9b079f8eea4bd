/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Cubic crystal in a (100) wafer: Young's modulus by direction. Theory:
   docs/theory/flexure-silicon.md. */
#ifndef FW_FLEXURE_FLEXURE_H
#define FW_FLEXURE_FLEXURE_H
#include "device/device.h"
#include <stdbool.h>

/* with psi the direction from [100] in the wafer plane:
     1/E(psi) = a0 + a1 cos 4 psi,  1/G(psi) = g0 + g1 cos 4 psi,  nu to [001] = -s12 E(psi)
     nu' = -s12/s11 from [001],  G of psi and [001] = 1/s44 whatever psi */
typedef struct fw_flexure_crystal {
    bool known;   /* false: isotropic */
    bool aligned; /* false: the hinge's axis is not known; modulus and stress are then means and
                     worst cases over all directions */
    double a0_per_Pa, a1_per_Pa, g0_per_Pa, g1_per_Pa, s12_per_Pa;
    double bow_per_Pa; /* nu nu'/E: what bowing across adds to 1/E, the same for all psi */
    double reach;      /* of what keeps the strip from bowing, over its depth */
    double share;      /* a1/a0 over silicon's: for what was found with silicon */
    double cos4, sin4; /* of four times the angle of the hinge's symmetry axis from [100] */
} fw_flexure_crystal;

/* axis_rad: the hinge's symmetry axis from [100]; NaN: not known */
fw_flexure_crystal fw_flexure_crystal_cubic(double c11_Pa, double c12_Pa, double c44_Pa,
                                            double axis_rad);

/* Hinge mechanics in closed form. Theory: docs/theory/flexure.md; reference: shared hinge tables.

   Frame of a flexure: arc centre O at the origin, symmetry axis +x, root of the first body at polar
   angle -a, of the second at +a. A leaf lies along y, its middle at the origin. A path (path.h) has
   its two ends on the y axis, the first one below, and W on the x axis, at x >= 0. */

typedef struct fw_flexure_input {
    fw_device_flexure_kind kind;
    double length_m, angle_rad, radius_m, width_m, fillet_m, depth_m; /* fillet below 0: ideal ends,
                                             rigid, without roots and without concentration */
    double youngs_Pa, poisson;
    double strength_Pa, safety_factor;
    double width_middle_m;                /* csfh, leaf: 0 uniform, as in fw_device_flexure */
    const fw_geometry_strip_piece *piece; /* (npiece) of a path; must live as long */
    int npiece;
    /* {.known = false}: isotropic, youngs_Pa and poisson hold; else they are only what strains are
       counted in: strain = stress/youngs_Pa */
    fw_flexure_crystal crystal;
    bool ends; /* isotropic: with what the ends lose (13a), as a crystal always has it; else the
                  printed formula, whose stiffness keeps its digits and has (13a) in its error */
} fw_flexure_input;

/* What the closed form may be off by, against 3-D finite elements with real roots: a bound of what
   was found on 23 shapes, of this shape; wider outside of what was compared (flexure.c) */
typedef struct fw_flexure_error {
    double stiffness, kx, ky; /* relative */
    /* relative, by which K may be below: no more than stiffness, which the ends have */
    double softer;
    /* relative, by which the strain at a root may be less or more for it: under a given moment it goes with
       1/K, of what is held in place with the moment, whose translation feels the ends more than the
       rotation does (a leaf three times) */
    double root_less, root_more;
    /* relative, what it adds under a given load to what the strain may be off by: strain and stiffness are of the
       same solids, whose strain per moment is off by less than both together */
    double load_less, load_more;
    /* relative, by which a solid's peak may be below strain_per_rad, which bounds it */
    double strain;
    double above; /* by which it may be above: the solids' own error, and shapes not compared */
    /* what of these two is the same wherever on the strip the peak is; of a path the rest is at the first root, the
       second and between the roots, and above between them */
    double strain_anywhere, above_anywhere, place_less[3], between_more;
    double centre_m; /* of W, on and across the axis */
    bool outside;    /* of the range that was compared */
} fw_flexure_error;

typedef struct fw_flexure_result {
    double centre_m;    /* W on the symmetry axis, from O (leaf: from the middle: 0), of a uniform
                           modulus: where hinge and conjugate surfaces are drawn */
    double offset_m[2]; /* true centre of compliance less that, along and across the axis: of a
                           crystal, or of a path whose bends the depth stiffens unlike; else 0 */
    double stiffness_Nm_per_rad;   /* with depth and root corrections */
    double stiffness_thin;         /* E I / L, without them, for the record */
    double kx_N_per_m, ky_N_per_m; /* 1/compliance[1][1], 1/compliance[2][2] */
    double compliance[3][3];       /* of the second body at the true centre, SI: twist (theta, x, y)
                                      of wrench (M, Fx, Fy); theta has no coupling there */
    double strain_per_rad;         /* peak, at the fillet, on the safe side of solids; crystal: peak
                                      stress over youngs_Pa. What limits go by */
    double strain_fit_per_rad; /* eq. 5, a fit through the middle of plane-stress solids; crystal:
                                  of its mean modulus */
    double stress_per_rad_Pa;  /* youngs_Pa * strain_per_rad */
    double limit_angle_rad;    /* strength / safety factor / stress_per_rad */
    double limit_uncertainty;  /* relative standard uncertainty of limit_angle from the model */
    double depth_factor, root_length_m; /* EI_eff/EI, dL */
    /* K of what the peak strain per radian was found with over K: of an isotropic strip with what the ends lose
       (13a), of a crystal's path without what straight roots give more; else 1 */
    double ends_stiffer;
    double ends_lost; /* share by which what the ends lose makes an isotropic strip stiffer, be it in K or not; of a
                         crystal 0 */
    double concentration;      /* strain_per_rad over that of the beam, t/2 over length and roots */
    double fibre;              /* the same between the roots: of curvature and depth, no fillet */
    double youngs_Pa, poisson; /* effective: of this arc; nu out of the plane */
    double uneven_x, uneven_y; /* crystal: share that C_xx, C_yy have over those of a uniform
                                  modulus of the same rotational stiffness; else 0 */
    fw_flexure_error error;
} fw_flexure_result;

/* relative standard uncertainty of the peak strain inside the fitted range: half of the 2.9 % by
   which held-out finite elements were off. The verdict's model error holds it already. */
#define FW_FLEXURE_STRAIN_UNCERTAINTY 0.015
/* What follows from the outline alone */
typedef struct fw_flexure_shape {
    fw_device_flexure_kind kind;
    double length_m, radius_m, width_m, fillet_m, half_angle_rad;
    double sine, cosine;           /* of the half-angle */
    double neutral_m, eccentric_m; /* rn, e = r - rn */
    double golovin;                /* exact over thin bending stiffness */
    double root_length_m, whole_m; /* dL, L + 2 dL */
    double root_block_m;           /* of dL what the block adds; the rest, below 0, is the fillet */
    double fillet_concentration;   /* Kt */
    double centre_m;               /* W of a uniform modulus */
    double curved;                 /* t/3r */
    double widening;               /* of the errors: 1 inside of what was compared */
    bool sharp;                    /* fillet below t/10 */
    bool beyond_fit;               /* of the root's concentration */
    fw_flexure_error error;        /* of a path, isotropic and not too deep */
    fw_geometry_pose start;        /* of a path: first end and its tangent */
} fw_flexure_shape;

void fw_flexure_closed_form(const fw_flexure_input *in, fw_flexure_result *out);
/* the first half of it, the outline alone */
void fw_flexure_shape_of(const fw_flexure_input *in, fw_flexure_shape *shape);
/* what is to be asked of a flexure as described; material, depth and limits are left 0 */
fw_flexure_input fw_flexure_input_of(const fw_device_flexure *flexure, double fillet_m);
/* not one arc or line of one width: the rows of `path` serve it, whatever its kind */
bool fw_flexure_input_varies(const fw_flexure_input *in);
/* the fillet used where the file gives none: as wide as the flexure, where the arc leaves room */
double fw_flexure_default_fillet(const fw_device_flexure *flexure);

/* A flexure whose two faces are not equally wide: walls that etching left at a slope. */

/* corrects what was computed for a rectangle of the mean width: flare_m is half of what one face is
   wider than the other, of either sign; 0 changes nothing */
void fw_flexure_flare(const fw_flexure_input *in, double flare_m, fw_flexure_result *out);

/* ---- limit.c ---- */

/* What a flexure bears: one row per criterion, each from the material's own data, the lowest
   allowable stress governs. All are peak stresses at the root's fillet, before the safety factor.
   Theory, definitions and sources: docs/theory/limits-of-materials.md; which rules by default:
   docs/decisions/0014-which-limit-rules.md. */

/* How many cycles of an amplitude a material lasts. */

typedef struct fw_flexure_strain_life {
    bool known;
    double amplitude_Pa, cycles; /* fully reversed; lasts so many */
    double exponent;             /* b < 0 of the elastic part (Basquin) */
    double youngs_Pa;
    double ductility, ductility_exponent; /* eps_f', c < 0 (Manson, Coffin); 0, 0: elastic only */
} fw_flexure_strain_life;

/* E times the strain amplitude that lasts `cycles` */
double fw_flexure_strain_life_amplitude_Pa(const fw_flexure_strain_life *law, double cycles);
double fw_flexure_strain_life_cycles(const fw_flexure_strain_life *law,
                                     double amplitude_Pa); /* its inverse */
/* fully reversed amplitude that damages as much as this cycle (Smith, Watson, Topper) */
double fw_flexure_equivalent_amplitude_Pa(double amplitude_Pa, double mean_Pa);

/* Fracture as the weakest link of a stressed surface (two-parameter Weibull). */

typedef struct fw_flexure_weibull {
    bool known;
    double strength_Pa, modulus, area_m2; /* sigma0, m, A0 */
    double effective_m2; /* surface that breaks as often, were all of it at the peak stress */
} fw_flexure_weibull;

double fw_flexure_weibull_area_m2(const fw_flexure_input *flexure, double modulus);
double fw_flexure_weibull_probability(const fw_flexure_weibull *weibull, double peak_Pa);
double fw_flexure_weibull_stress_Pa(const fw_flexure_weibull *weibull,
                                    double probability); /* its inverse */
/* failure probability of each of n equal links of a chain that fails with `probability` */
double fw_flexure_series_share(double probability, int n);
/* of a chain of n links: 1 - product of their survivals */
double fw_flexure_series_probability(const double *probability, int n);

typedef struct fw_flexure_limit {
    const char *criterion;  /* the row's name: "strength", "fracture", "yield", "fatigue" */
    const char *definition; /* what kind of number it is */
    double allowable_Pa;    /* fatigue: amplitude, fully reversed, of `cycles` equal cycles */
    fw_quantity_value_status status; /* the weakest of what went into it */
    const char *source;              /* of the number that it rests on most */
} fw_flexure_limit;

enum { FW_LIMITS = 4 };

typedef struct fw_flexure_limits {
    fw_flexure_limit item[FW_LIMITS]; /* (count) those that apply, in the order of the table */
    int count;
    int governing;               /* index of the lowest, fatigue left out; FW_NONE: nothing known */
    int fatigue;                 /* index of it, or FW_NONE */
    fw_flexure_weibull weibull;  /* of this flexure; .known: its data hold */
    fw_flexure_strain_life life; /* .known where fatigue >= 0 */
    const char *missing;         /* what was asked for and has no data; NULL: nothing */
    fw_place missing_place;      /* of what asked */
} fw_flexure_limits;

typedef struct fw_flexure_limit_input {
    const fw_device_material *material;
    const fw_flexure_input *flexure; /* shape, with its fillet; youngs_Pa of strain and stress */
    const fw_device_limits_asked *asked;
    int nhinge; /* of the whole device: in series, each may break it */
} fw_flexure_limit_input;

typedef struct fw_flexure_limit_row { /* adding a criterion is one function and one row */
    const char *name, *summary;
    /* true: *limit is what it allows. May say in `all` what it found beside, or missed */
    bool (*of)(const fw_flexure_limit_input *in, fw_flexure_limits *all, fw_flexure_limit *limit);
} fw_flexure_limit_row;
void fw_flexure_limits_of(const fw_flexure_limit_input *in, fw_flexure_limits *limits);

/* NULL where nothing is known */
const fw_flexure_limit *fw_flexure_limits_governing(const fw_flexure_limits *limits);

#endif
