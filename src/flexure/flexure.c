/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is asked of a flexure and what the answer may be off by: the kinds with a row each, what follows for all of
   them, and the errors of the closed form. */
#include "flexure/flexure.h"
#include "flexure/section.h"
#include <math.h>

/* ---- kinds ---- */

/* a row per model; kinds that are made of lines and arcs (device/flexures.def) have the path's */
typedef struct model {
    fw_device_flexure_kind kind;
    void (*shape)(const fw_flexure_input *in, fw_flexure_shape *shape);
    void (*closed_form)(const fw_flexure_shape *shape, const fw_flexure_input *in,
                        fw_flexure_result *out);
} model;
static const model table[] = {
    {FW_FLEXURE_CSFH, fw_flexure_csfh_shape, fw_flexure_csfh},
    {FW_FLEXURE_LEAF, fw_flexure_leaf_shape, fw_flexure_leaf},
    {FW_FLEXURE_PATH, fw_flexure_path_shape, fw_flexure_path},
};

static const model *model_of(fw_device_flexure_kind kind) {
    size_t i = 0;
    while (table[i].kind != kind && i + 1 < sizeof table / sizeof table[0])
        i++;
    return &table[i];
}

bool fw_flexure_input_varies(const fw_flexure_input *in) {
    return in->kind == FW_FLEXURE_PATH ||
           (in->width_middle_m > 0 && in->width_middle_m != in->width_m);
}

fw_flexure_input fw_flexure_input_of(const fw_device_flexure *f, double fillet_m) {
    return (fw_flexure_input){.kind = f->kind,
                              .length_m = f->length_m,
                              .angle_rad = f->angle_rad,
                              .radius_m = f->radius_m,
                              .width_m = f->width_m,
                              .fillet_m = fillet_m,
                              .width_middle_m = f->width_middle_m,
                              .piece = f->piece,
                              .npiece = f->npiece};
}

void fw_flexure_shape_of(const fw_flexure_input *in, fw_flexure_shape *f) {
    model_of(fw_flexure_input_varies(in) ? FW_FLEXURE_PATH : in->kind)->shape(in, f);
    /* before the marks: a path goes by the fillets of its ends, marks by its narrowest width */
    if (f->kind == FW_FLEXURE_PATH) f->error = fw_flexure_path_errors(f, in);
    fw_flexure_shape_marks(f);
}

/* limit angle = strength / safety factor / (E eps/rad); its relative standard uncertainty is that
   of the strain: 0 to 4 % above solids; twice as much for a crystal; 2 % more for fillets below
   t/10, 5 % more where the fillet lies outside the fitted range or the arc is thick (t/r > 0.3) */
static void stiffness_and_limit(const fw_flexure_shape *f, const fw_flexure_input *in,
                                fw_flexure_result *out) {
    out->kx_N_per_m = 1 / out->compliance[1][1], out->ky_N_per_m = 1 / out->compliance[2][2];
    out->stress_per_rad_Pa = in->youngs_Pa * out->strain_per_rad;
    out->limit_angle_rad = in->strength_Pa / (in->safety_factor * out->stress_per_rad_Pa);
    out->limit_uncertainty =
        FW_FLEXURE_STRAIN_UNCERTAINTY + (f->beyond_fit ? 0.065 - FW_FLEXURE_STRAIN_UNCERTAINTY
                                         : f->sharp    ? 0.02
                                                       : 0);
}

void fw_flexure_closed_form(const fw_flexure_input *in, fw_flexure_result *out) {
    fw_flexure_shape f;
    fw_flexure_shape_of(in, &f);
    *out = (fw_flexure_result){
        .centre_m = f.centre_m, .root_length_m = f.root_length_m, .ends_stiffer = 1};
    model_of(f.kind)->closed_form(&f, in, out);
    stiffness_and_limit(&f, in, out);
    out->error = fw_flexure_errors(&f, in, out);
}

double fw_flexure_default_fillet(const fw_device_flexure *flexure) {
    double t = flexure->width_m;
    if (flexure->kind == FW_FLEXURE_PATH) { /* of the two ends the one that leaves less */
        double least = HUGE_VAL;
        for (int end = 0; end < 2; end++) {
            const fw_geometry_strip_piece *p = &flexure->piece[end ? flexure->npiece - 1 : 0];
            double w = p->width_m[2 * end], k = fabs(p->curvature_per_m);
            least = fmin(least, k > 0 ? fmin(w, (1 / k - 0.5 * w) / 3.0) : w);
        }
        return least;
    }
    if (flexure->kind != FW_FLEXURE_CSFH) return t;
    return fmin(t, (flexure->radius_m - 0.5 * t) / 3.0);
}

/* width over the depth w(z) = t + 2 d z/h, -h/2 <= z <= h/2, both walls alike, so that the bending
   axis stays the line of symmetry:
     I/I_rectangle = (1/h) integral (w/t)^3 dz = 1 + p^2,   p = d/t          (t^3 + t d^2)
     widest fibre  = (t + |d|)/2,   Kt of the wider face: t (1 + |p|), rho
     K and what bends go with 1 + p^2; the area, and so ky of a leaf, with the mean width
   in: mean width t, flare d, fillet rho (m), |d| < t; out: stiffnesses, strain per radian, limit.
   The curved-beam and depth factors are those of the mean width: p^2 of their small departure from
   1 is left out (below 0.1 % for |p| < 0.1). Translation stiffnesses of an arc are taken to be
   bending alone (their shear part times p^2 is left out). Source: elementary integral, the same as
   k/k0 in docs/theory/etching.md; test_flare.c against quadrature. */
void fw_flexure_flare(const fw_flexure_input *in, double flare_m, fw_flexure_result *out) {
    if (flare_m == 0.0) return;
    double p = fabs(flare_m) / in->width_m, stiffer = 1.0 + p * p;
    out->stiffness_Nm_per_rad *= stiffer;
    out->stiffness_thin *= stiffer;
    out->kx_N_per_m *= stiffer;
    if (in->kind != FW_FLEXURE_LEAF) out->ky_N_per_m *= stiffer;
    double sharper = fw_flexure_fillet_concentration(in->width_m * (1.0 + p), in->fillet_m) /
                     fw_flexure_fillet_concentration(in->width_m, in->fillet_m);
    double strained = (1.0 + p) * sharper;
    out->concentration *= sharper;
    out->strain_per_rad *= strained;
    out->strain_fit_per_rad *= strained;
    out->stress_per_rad_Pa *= strained;
    out->limit_angle_rad /= strained;
}

/* ---- what the closed form does not know, as a figure of each shape ---- */

/* the factors by which a shape outside of those compared widens its errors: times 2 for each of
   fillet outside [0.05, 1.25] t, arc thicker than t/r = 0.15, strip shorter than 8 t (depth above
   20 t, and times 4 above the length: fw_flexure_errors); times 10 in all above t/r = 0.3. Of a path what its bends have is there
   before (fw_flexure_path_errors), and its ends are asked as even strips */
void fw_flexure_shape_marks(fw_flexure_shape *f) {
    const double above = 1.0 + 1e-9;
    double t = f->width_m, rho = f->fillet_m, wide = 1;
    double thick = f->kind == FW_FLEXURE_CSFH ? t / f->radius_m : 0;
    bool ideal = !(rho >= 0), unlike = !ideal && (rho < 0.05 * t || rho > 1.25 * above * t);
    f->sharp = !ideal && rho < 0.1 * t * (1.0 - 1e-9);
    f->beyond_fit = unlike || thick > 0.3;
    if (unlike) wide *= 2;
    if (thick > 0.15 * above) wide *= 2;
    if (f->length_m < 8 * t) wide *= 2;
    if (thick > 0.3) wide = fmax(wide, 10);
    if (f->kind != FW_FLEXURE_PATH) f->widening = wide;
}

/* Isotropic arcs of one width with t/r from 0.15 to 0.3: t/r; all else: 0. Their strain and stiffness were compared by
   themselves (root_strain_thick.csv, and root_strain_thick_after.csv, drawn when the figures were chosen); what forces do is
   a guess there */
static double thick_arc(const fw_flexure_shape *f, const fw_flexure_input *in) {
    const double above = 1.0 + 1e-9, part = f->width_m / f->radius_m;
    const bool arc = f->kind == FW_FLEXURE_CSFH && !in->crystal.known;
    return arc && part > 0.15 * above && part <= 0.3 * above ? part : 0;
}

/* How far a wide fillet takes a thick arc away, beyond from where that counts more than in proportion: (rho/r)^2 - from */
static double fillet_taken(const fw_flexure_shape *f, double from) {
    const double rho = fmax(fmin(f->fillet_m, 1.25 * f->width_m), 0);
    return f->kind == FW_FLEXURE_CSFH ? fmax(rho * rho / (f->radius_m * f->radius_m) - from, 0) : 0;
}

/* its stiffness has what its ends lose: always of a crystal, else where that is asked for */
static bool counts_ends(const fw_flexure_input *in) {
    return in->crystal.known || in->ends;
}

typedef struct root_lever { /* of a root, about W */
    double along, across, sine, cosine;
} root_lever;

static root_lever root_lever_of(const fw_flexure_shape *f) {
    if (f->kind == FW_FLEXURE_LEAF) return (root_lever){0, 0.5 * f->length_m, 0, 1};
    return (root_lever){f->radius_m * f->cosine - f->centre_m, f->radius_m * f->sine, f->sine,
                        f->cosine};
}

/* What is unknown of the peak strain inside of what was compared (fw_flexure_root_peak): it is 0.12
   to 1.08 % above solids that a fit has not seen, of arcs of silicon -0.17 to 1.43 %; the fit that is used has
   seen them, and what lies between is known within 0.35 % (kriging); a solid's own mesh is 0.3 % off. A crystal's
   strip shorter than 2.45 depths, whose ends reach each other, is strained up to 1.2 % less than that. Of whole mechanisms in
   CalculiX the peak is up to 1 % higher than what their own forces and moments make of it (README of
   tests/judge: meshes there, and a material that is softer where it is pressed). Fillets sharper
   than what was fitted (t/10, silicon 0.15 t) and those beyond the laws of the root: guesses.
   Strips deeper than 10 t, to 20 t, and shorter than 16 t, to 8 t, are strained less than the bound, which none of 137
   solids is above, by so much more as `beyond` says (root_strain_beyond.csv and root_strain_beyond_after.csv).
   Test: test_root_strain.c, test_error.c */
static double beyond(const fw_flexure_shape *f, const fw_flexure_input *in, double *far) {
    const double t = f->width_m, deep = fmax(in->depth_m / t - 10, 0),
                 missing = fmax(16 - f->length_m / t, 0), depths = in->depth_m / f->length_m;
    const bool crystal = in->crystal.known, arc = f->kind == FW_FLEXURE_CSFH;
    const double down = !crystal ? fmin(0.004 * deep, 0.04)
                        : arc    ? fmin(0.010 * deep, 0.06)
                                 : fmin(0.001 * deep, 0.01);
    const double reach = crystal ? 0.10 * fmax(depths - 0.5, 0) : 0.05 * fmax(depths - 0.4, 0);
    *far = fmin(fmax(deep, missing) / 2, 1);
    return down + fmin(missing, 1) * (crystal ? 0.006 : 0.004) + *far * reach;
}

static void strain_errors(const fw_flexure_shape *f, const fw_flexure_input *in, double wide,
                          double thick, fw_flexure_error *e) {
    const bool within = !(wide > 1); /* beyond, the former laws go on */
    const double solids = within ? 0.010 : 0.024, leaves = within ? 0.010 : 0.028;
    const double arcs = within ? 0.0135 : 0.0245, whole = 0.008, sharp = 0.04, guess = 0.10;
    const double short_strip = 0.012, depths = 2.45;
    double far; /* from 0 to 1 */
    const double less = beyond(f, in, &far);
    bool crystal = in->crystal.known, path = f->kind == FW_FLEXURE_PATH;
    bool unlike = f->sharp || (crystal && in->fillet_m >= 0 && in->fillet_m < 0.15 * f->width_m);
    double more = f->beyond_fit ? guess : unlike ? sharp : 0;
    double down = path ? e->strain : 0, up = path ? e->above : 0; /* fw_flexure_path_errors */
    const double close = crystal && f->length_m < depths * in->depth_m ? short_strip : 0;
    bool straight = f->kind == FW_FLEXURE_LEAF;
    e->strain_anywhere = wide * ((!crystal   ? solids
                                  : straight ? leaves
                                             : arcs) +
                                 0.001) +
                         more + close + less + 0.15 * fmax(thick - 0.15, 0);
    e->strain = e->strain_anywhere + down;
    /* deep or short strips that are thin in their middle: one of varying_after.csv has 0.5 % more than the others */
    e->above = fmax(wide, path ? 1 + far : 1) * whole + more + up;
    if (thick > 0) e->above += fillet_taken(f, 0.03);
    e->above_anywhere = e->above - e->between_more;
}

/* Of strain per moment, which is strain per radian over the stiffness: both are off together, since a solid is
   strained by what it is turned by. With S the strain per moment of the closed form, solids of strips of one width (417
   isotropic, 418 of silicon) and 95 isotropic ones of varying width and of several pieces have

     S (1 - e_strain - e_K + 0.006) < strain per moment < S (1 - 0.0015)

   and between these is what goes with any power of the stiffness from that of a given rotation to that of a given moment.
   Not beyond what was compared, and not of paths of silicon. Test: test_root_strain.c, test_varying.c, test_paths.c */
static void load_errors(const fw_flexure_shape *f, const fw_flexure_input *in, double wide,
                        double thick, fw_flexure_error *e) {
    const bool path = f->kind == FW_FLEXURE_PATH;
    const bool compared = !(wide > 1) && !(path && in->crystal.known) && !(thick > 0) &&
                          f->length_m >= 16 * f->width_m && in->depth_m <= 10 * f->width_m;
    const double together = 0.005;
    e->load_less = compared ? fmax(e->root_less - together, 0) : e->root_less;
    e->load_more = compared ? 0 : e->root_more;
}

/* Of an isotropic leaf that is guided and moved by a given way: its stiffness across feels what the ends lose, S - 1,
   2.3 to 2.7 times (solids of the table of docs/theory/flexure-errors.md), so that the moment is (2.5 - 1) (S - 1) more
   than strain per radian over K has it; no solid's strain per radian is less than 0.24 % below the bound. A crystal's
   K has what the ends lose, and what is left is in root_more. Test: test_root_strain.c held_in_place */
static double held_more(const fw_flexure_input *in, const fw_flexure_result *r) {
    if (in->kind != FW_FLEXURE_LEAF || counts_ends(in)) return 0;
    return 1.5 * (r->ends_stiffer - 1) - 0.002;
}

/* n^2 and l^2/(l + block) f of (13a), whose product is d of either end */
typedef struct end_taken {
    double squares, length_m;
} end_taken;

static end_taken taken_of(const fw_flexure_shape *f, const fw_flexure_input *in,
                          const fw_flexure_result *r) {
    fw_flexure_input own = *in;
    own.ends = true;
    const fw_flexure_crystal k = fw_flexure_elastic_of(&own);
    double squares = k.bow_per_Pa * r->youngs_Pa, bow = 1; /* of a leaf */
    if (f->kind == FW_FLEXURE_CSFH && squares > 0)
        bow = fmax(1 - (1 - squares) * r->depth_factor, 0) / squares;
    const fw_flexure_end_loss end =
        fw_flexure_end_loss_of(&k, in->depth_m, bow, f->length_m, f->root_block_m);
    return (end_taken){squares, end.length_m};
}

/* What the ends still take, or do not take, once (13a) has it: of a leaf 0.4 d, of an arc 0.5 d, d of either end, and the
   root law's part. In m; out m, both ends. 0.1 % (rms) in K of 417 isotropic solids: leaves are as strips that are
   shorter by -0.033 to 0.141 t (0.32 d at most), arcs by -0.11 to 0.19 t (where thick, with wide fillets). Test:
   test_root_strain.c stiffness_of_solids */
static double ends_left(const fw_flexure_shape *f, const end_taken *d) {
    bool arc = f->kind == FW_FLEXURE_CSFH;
    return (arc ? 0.5 : 0.4) * d->squares * d->length_m + (arc ? 0.025 : 0.04) * f->width_m;
}

typedef struct lengths { /* of strip that may be missing, or too much, m, both ends */
    double stiffer, softer;
} lengths;

/* Of a crystal once (13a) is counted: 335 leaves of silicon as solids are as strips that are longer by -0.053 to
   0.067 t, 622 halves of arcs by -0.28 to 0.146 t (0.15 t < rho < 1.25 t, h from t/2 to 10 t, R from 6.7 t, L from 17 t):
     softer    leaf 0.07 t, arc 0.05 t + 0.065 rho^2/t
     stiffer   leaf 0.06 t, arc 0.02 t + 0.25 d + 7.5 (t/R)^2 rho^2/t
   d of either end, which the block keeps straight; in m, out m. Source: tests/data/hinge/root_strain_more.csv,
   root_fillets.csv. Test: test_root_strain.c stiffness_of_solids */
static lengths crystal_lengths(const fw_flexure_shape *f, const fw_flexure_input *in,
                               const fw_flexure_result *r) {
    double t = f->width_m, rho = fmax(fmin(f->fillet_m, 1.25 * t), 0), square = rho * rho / t;
    if (f->kind != FW_FLEXURE_CSFH) return (lengths){0.06 * t, 0.07 * t};
    const end_taken d = taken_of(f, in, r);
    double thick = 67.5 * (f->curved * f->curved) * square; /* 7.5 (t/R)^2: 3 t/3R */
    return (lengths){0.02 * t + 0.25 * d.squares * d.length_m + thick, 0.05 * t + 0.065 * square};
}

/* of ends and root law, f of one width. Counted with what its ends lose, a leaf is as a strip that is longer by 0.033 t
   at most, an arc by 0.11 t where its fillets are wide. As printed it lacks all of that, which makes it stiffer; how
   much softer it may be is as it was compared */
static lengths lengths_of(const fw_flexure_shape *f, const fw_flexure_input *in,
                          const fw_flexure_result *r) {
    if (in->crystal.known) return crystal_lengths(f, in, r);
    bool arc = f->kind == FW_FLEXURE_CSFH;
    double t = f->width_m, rho = fmax(fmin(f->fillet_m, 1.25 * t), 0), square = rho * rho / t,
           nu2 = r->poisson * r->poisson;
    double bow = fmax(1 - (1 - nu2) * r->depth_factor, 0); /* twice what either end loses: */
    const end_taken d = taken_of(f, in, r);
    double taken = fillet_taken(f, 0.0225), left = ends_left(f, &d);
    double thick = arc ? 4.6 * 9 * (f->curved * f->curved) * square + 160 * (taken * taken) * t : 0;
    /* leaves whose fillets are wider than they are: of root_strain_more.csv and root_strain_after.csv two, shallow and
       with rho = 1.25 t, are as strips that are longer by 0.1 t */
    double soft = arc ? 0 : 0.4 * fmax(rho - t, 0);
    /* where nothing is lost the root law alone is off, by 0.006 t each */
    const double known = fmax((arc ? 0.013 : 0.028) * t - d.squares * d.length_m, 0);
    if (in->ends)
        return (lengths){left - known + thick + soft,
                         (arc ? left + 0.05 * square : 0.04 * t + soft) - known};
    double softer = left + (arc ? 0 : 0.7 * d.squares * d.length_m) + thick;
    double printed = (arc ? 0.7 : 0.8) * in->depth_m * bow + 0.012 * t + thick;
    return (lengths){printed + soft, fmin(softer, printed) + soft};
}

/* Five causes, each with the factor that bounds continuum figures of 23 shapes (theory, table):
     ends   the blocks keep the section from its anticlastic bow: shorter by up to
            0.35 h nu^2 f at either end, nu^2 f = 1 - (1 - nu^2) D of the depth factor (leaf 0.4 h)
     roots  the law of dL: 0.006 t, and in thick arcs with wide fillets 2.3 t (t/r)^2 (rho/t)^2
     place  the fillet takes strip away up to rho from the end, where the form has it at the end:
            first moment 0.15 rho^2 (the block's own flexibility beside it)
     rest   0.1 % of a long thin beam; 0.002 r or 0.01 t of W across
     axial  a block gives along the strip as up to 1.6 t of it would, which the form leaves out
   With e = 2 length/L of the first two: K e, kx e y^2 L/(EI C_xx), ky e x^2 L/(EI C_yy), W e |x|,
   (x, y) the root from W. Strain: it is 0 to 4 % above converged solids (fw_flexure_root_peak); of
   a solid whose strains are extrapolated to nodes they scatter by 1 to 2 % with its mesh.

   in: shape, result with D, C, Kt (SI); out: relative errors, of W in m.
   source: docs/theory/flexure-errors.md; test_error.c, test_ladder.c */
static fw_flexure_error isotropic_errors(const fw_flexure_shape *f, const fw_flexure_input *in,
                                         const fw_flexure_result *r, double wide, double thick) {
    bool arc = f->kind == FW_FLEXURE_CSFH;
    double t = f->width_m, L = f->length_m;
    double EI = r->youngs_Pa * in->depth_m * t * t * t / 12 * r->depth_factor;
    double rho = fmax(fmin(f->fillet_m, t), 0), place = 0.6 * rho * rho;
    const lengths ends = lengths_of(f, in, r);
    const bool counted = counts_ends(in);
    double lost = counted && !in->crystal.known ? fmax(ends.stiffer, ends.softer) : ends.stiffer;
    double give = f->fillet_m < 0 ? 0 : 3.2 * t * t * t / 12; /* 1/EA over 1/EI: t^2/12 */
    const double forces = thick > 0 ? 2 * wide : wide;        /* what they do was not compared */
    const root_lever at = root_lever_of(f);
    double x = fabs(at.along), y = fabs(at.across), c = at.cosine, n = at.sine;
    double along = y * (lost * y + place * fabs(c)) + give * (n * n);
    double across = x * (lost * x + place * fabs(n)) + give * (c * c);
    double centre = arc ? (lost * x + place) / L + 2e-4 * f->radius_m : 0.01 * t;
    double less = lost, more = ends.softer;
    if (counted) {
        /* how much more translation feels the ends than rotation; arcs turn, and at most half of their
           strain is the other's */
        double felt = fmax(fmax(y * y * r->kx_N_per_m, x * x * r->ky_N_per_m) * L / EI, 1) - 1;
        felt = arc ? fmin(felt, 1) : felt;
        less = fmax(lost, felt * ends.softer), more = fmax(ends.softer, felt * lost);
    }
    return (fw_flexure_error){
        .stiffness = wide * (0.001 + fmax(lost, counted ? ends.softer : 0) / L),
        .softer = wide * (0.001 + ends.softer / L),
        .root_less = wide * (0.001 + less / L),
        .root_more = wide * (0.001 + more / L),
        .kx = forces * (0.002 + r->kx_N_per_m * along / EI),
        .ky = forces * (0.002 + r->ky_N_per_m * across / EI),
        .centre_m = forces * centre,
    };
}

/* A crystal: K 0.1 %, kx 1 %, ky 1.6 % more (linear finite elements of two arcs, three directions
   each, ideal ends; K of 197 solids, root_strain_held_out.csv among them), W twice; where its
   direction is not known the spread over all of them.
   source: docs/theory/flexure-silicon.md; test_crystal.c, test_root_strain.c */
static void add_crystal_errors(const fw_flexure_shape *f, const fw_flexure_input *in, double wide,
                               fw_flexure_error *e) {
    const fw_flexure_crystal *k = &in->crystal;
    bool arc = f->kind == FW_FLEXURE_CSFH;
    double spread = k->aligned ? 0 : fabs(k->a1_per_Pa / k->a0_per_Pa);
    e->stiffness += wide * (0.001 + (arc ? 0 : spread));
    e->softer += wide * (0.001 + (arc ? 0 : spread));
    e->root_less += wide * (arc ? 0 : spread), e->root_more += wide * (arc ? 0 : spread);
    e->kx += wide * (0.010 + (arc ? 0.1 * spread : spread));
    e->ky += wide * (0.016 + spread);
    e->centre_m += e->centre_m;
    if (arc) e->centre_m += wide * ((0.001 + 0.2 * spread) * f->radius_m);
}

/* An even strip of the kind that a path has at an end, as long as the whole */
static double end_lengths(const fw_flexure_course *p, int end, double length_m,
                          const fw_flexure_input *in, const fw_flexure_result *r, lengths *out) {
    const fw_geometry_strip_piece *q = &p->shape[end ? p->n - 1 : 0].piece;
    const double curved = fabs(q->curvature_per_m);
    fw_flexure_input even = *in;
    fw_flexure_result own = *r;
    fw_flexure_shape one;
    even.kind = curved > 0 ? FW_FLEXURE_CSFH : FW_FLEXURE_LEAF;
    even.length_m = length_m, even.width_m = q->width_m[2 * end], even.width_middle_m = 0;
    if (p->n > 1) own.depth_factor = 1;
    if (curved > 0) {
        even.radius_m = 1 / curved, even.angle_rad = length_m * curved;
        fw_flexure_csfh_shape(&even, &one);
        if (p->n > 1)
            own.depth_factor =
                fw_flexure_depth_factors(1 / curved, even.width_m, in->depth_m, r->poisson)
                    .stiffness;
    } else
        fw_flexure_leaf_shape(&even, &one);
    fw_flexure_shape_marks(&one);
    *out = lengths_of(&one, in, &own);
    return one.widening;
}

/* of an end of a path: what it is off by, E I D, place from W and tangent */
typedef struct path_end {
    lengths off;
    double width_m, fillet_m, bend_Nm2, x_m, y_m, cosine, sine;
} path_end;

static double path_end_of(const fw_flexure_course *p, int end, double length_m,
                          const fw_flexure_input *in, const fw_flexure_result *r, path_end *o) {
    const fw_geometry_pose at = p->start[end ? p->n : 0];
    const double t = p->shape[end ? p->n - 1 : 0].piece.width_m[2 * end];
    double wide = end_lengths(p, end, length_m, in, r, &o->off);
    o->width_m = t, o->fillet_m = fmax(fmin(in->fillet_m, t), 0);
    o->bend_Nm2 = r->youngs_Pa * in->depth_m * t * t * t / 12 * r->depth_factor;
    o->x_m = fabs(at.x_m - r->centre_m - r->offset_m[0]);
    o->y_m = fabs(at.y_m - r->offset_m[1]);
    o->cosine = fabs(cos(at.angle_rad)), o->sine = fabs(sin(at.angle_rad));
    return wide;
}

/* What a straight end loses reaches as far as its bow, to where the strip is thinner and bends more, or is wider and bends
   less: shares of it, 3 ((w/w')^3 - 1) more and 2 (1 - (w/w')^3) less, w' the width there. Leaves of varying width as
   solids (varying.csv, varying_after.csv, forces.csv) have 0.1 to 2.8 times the former and 1.4 times the latter */
static void lost_elsewhere(const fw_geometry_strip_shape *shape, int end,
                           const fw_flexure_input *in, double share[2]) {
    const double L = shape->piece.length_m, far = in->depth_m * fw_flexure_elastic_of(in).reach,
                 s = fmin(far, 0.5 * L);
    if (shape->piece.curvature_per_m != 0) return;
    const double ratio = fw_geometry_strip_width(shape, end ? L : 0) /
                         fw_geometry_strip_width(shape, end ? L - s : s);
    share[0] = fmax(share[0], 3 * (ratio * (ratio * ratio) - 1));
    share[1] = fmax(share[1], fmin(2 * (1 - ratio * (ratio * ratio)), 1));
}

/* Strips of any pieces and widths. Stiffness: what ends and root law are off by counts at either end as much as
   that has part in the compliance, K/(E I of the root); besides the wedge, 0.2 % of where pieces
   meet, and of the root law 0.75 of what the width opens over the fillet. Forces and W: the sums of isotropic_errors
   with what either end has of them, its own place and tangent, and 0.2 % of where pieces meet. Of solids:
   tests/data/hinge/varying.csv, test_varying.c; paths.csv, test_paths.c; forces.csv, test_forces.c */
static void varying(const fw_flexure_shape *f, const fw_flexure_input *in,
                    const fw_flexure_result *r, double wide, fw_flexure_error *e) {
    fw_flexure_course p;
    fw_flexure_path_of(in, &p);
    const double meet = p.n > 1 ? 0.002 : 0, rest = 0.001 + f->error.softer + meet;
    const bool line =
        p.n == 1 && p.shape[0].piece.curvature_per_m == 0; /* its W is in its middle */
    double stiffer = 0, softer = 0, along = 0, across = 0, uneven[2] = {0};
    double centre = line ? 0.01 * f->width_m : 2e-4 * f->radius_m;
    for (int end = 0; end < 2; end++) {
        path_end o;
        wide = fmax(wide, path_end_of(&p, end, f->length_m, in, r, &o));
        double opens = 0.75 * o.fillet_m * f->error.strain;
        double part = 0.5 * r->stiffness_Nm_per_rad / o.bend_Nm2; /* of two ends */
        stiffer += (opens + o.off.stiffer) * part, softer += (opens + o.off.softer) * part;
        if (in->ends) lost_elsewhere(&p.shape[end ? p.n - 1 : 0], end, in, uneven);
        const double lost = 0.5 * (opens + o.off.stiffer), place = 0.3 * o.fillet_m * o.fillet_m,
                     give = in->fillet_m < 0 ? 0 : 1.6 / 12 * pow(o.width_m, 3);
        along +=
            (o.y_m * (lost * o.y_m + place * o.sine) + give * o.cosine * o.cosine) / o.bend_Nm2;
        across += (o.x_m * (lost * o.x_m + place * o.cosine) + give * o.sine * o.sine) / o.bend_Nm2;
        const double lever =
            p.n == 1 ? o.x_m : hypot(o.x_m, o.y_m); /* of one piece y adds up to nothing */
        if (!line) centre += 2 * part * (lost * lever + place);
    }
    stiffer += uneven[0] * r->ends_lost, softer += uneven[1] * r->ends_lost;
    e->stiffness = wide * (rest + stiffer);
    e->softer = wide * (rest + softer);
    e->root_less = e->stiffness, e->root_more = e->softer;
    e->kx = wide * (0.002 + meet + f->error.kx + r->kx_N_per_m * along);
    e->ky = wide * (0.002 + meet + f->error.ky + r->ky_N_per_m * across);
    e->centre_m = wide * (f->error.centre_m + centre);
    e->outside = wide > 1;
}

fw_flexure_error fw_flexure_errors(const fw_flexure_shape *f, const fw_flexure_input *in,
                                   const fw_flexure_result *r) {
    bool path = f->kind == FW_FLEXURE_PATH, deep = in->depth_m > 20 * f->width_m * (1.0 + 1e-9);
    /* of a path's thick bends the strain has its own (fw_flexure_path_errors) */
    double wide = (path ? 1 : f->widening) * (deep ? 2 : 1) * (in->depth_m > f->length_m ? 4 : 1);
    const double thick = thick_arc(f, in);
    if (thick > 0) wide /= 2; /* has figures of its own */
    fw_flexure_error e = path ? f->error : isotropic_errors(f, in, r, wide, thick);
    if (path) varying(f, in, r, wide * f->widening, &e);
    /* (13a) reaches into the strip, to where it is no longer as wide as at the face */
    if (path && !in->crystal.known) {
        const double ends = r->ends_lost;
        const bool one = in->kind != FW_FLEXURE_PATH || in->npiece == 1;
        e.strain += 0.5 * ends, e.above += 0.25 * ends, e.between_more += 0.25 * ends;
        for (int i = 0; i < 3; i++)
            e.place_less[i] += (one && i < 2 ? 0.9 : 0.5) * ends;
    }
    if (in->crystal.known) add_crystal_errors(f, in, wide, &e);
    /* both ends of a leaf reach each other: 5.6 % of a solid with h = 0.8 L, 4.1 % with 0.67 (forces.csv) */
    if (counts_ends(in) && in->kind == FW_FLEXURE_LEAF)
        e.kx += 0.08 * fmax(in->depth_m / f->length_m - 0.3, 0);
    strain_errors(f, in, wide, thick, &e);
    load_errors(f, in, wide, thick, &e);
    e.root_more = fmax(e.root_more, held_more(in, r));
    e.outside = e.outside || wide > 1 || thick > 0;
    return e;
}
