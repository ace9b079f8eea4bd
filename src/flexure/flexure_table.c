/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/flexure.h"
#include "flexure/section.h"
#include <math.h>

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
