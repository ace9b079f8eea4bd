/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "flexure/finish.h"
#include "flexure/kinds.h"
#include <math.h>

static const fw_flexure_model table[] = {
    {FW_FLEXURE_CSFH, "csfh", "circular arc with a pair of conjugate surfaces",
     fw_flexure_csfh_shape, fw_flexure_csfh, fw_flexure_csfh_at_once},
    {FW_FLEXURE_LEAF, "leaf", "straight leaf", fw_flexure_leaf_shape, fw_flexure_leaf,
     fw_flexure_leaf_at_once},
    {FW_FLEXURE_PATH, "path", "lines and arcs of any width, one after the other",
     fw_flexure_path_shape, fw_flexure_path, NULL},
};

const fw_flexure_model *fw_flexure_models(size_t *count) {
    *count = sizeof table / sizeof table[0];
    return table;
}

static const fw_flexure_model *model_of(fw_device_flexure_kind kind) {
    size_t i = 0;
    while (table[i].kind != kind && i + 1 < sizeof table / sizeof table[0])
        i++;
    return &table[i];
}

void fw_flexure_closed_form_at(const fw_flexure_shape *f, const fw_flexure_input *in,
                               fw_flexure_result *out) {
    /* every member is set here or by the kind: clearing them all first would cost a fifth */
    out->centre_m = f->centre_m;
    out->root_length_m = f->root_length_m;
    out->offset_m[0] = out->offset_m[1] = out->uneven_x = out->uneven_y = 0;
    model_of(f->kind)->closed_form(f, in, out);
    fw_stiffness_and_limit(f, in, out);
    fw_flexure_errors(f, in, out, &out->error);
}

static inline bool varying(const fw_flexure_input *in) {
    return in->kind == FW_FLEXURE_PATH ||
           (in->width_middle_m > 0 && in->width_middle_m != in->width_m);
}

bool fw_flexure_input_varies(const fw_flexure_input *in) {
    return varying(in);
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
    fw_shape_marks(f);
}

void fw_flexure_closed_form(const fw_flexure_input *in, fw_flexure_result *out) {
    bool varies = varying(in);
    const fw_flexure_model *model = model_of(varies ? FW_FLEXURE_PATH : in->kind);
    if (model->at_once) {
        model->at_once(in, out);
        return;
    }
    fw_flexure_shape f;
    fw_flexure_shape_of(in, &f);
    fw_flexure_closed_form_at(&f, in, out);
}

/* how many from the first on may go at once, at most four */
static size_t alike(const fw_flexure_input *const in[], size_t n) {
    size_t k = 0;
    while (k < n && k < 4 && in[k]->kind == FW_FLEXURE_CSFH && !varying(in[k]) &&
           in[k]->crystal.known == in[0]->crystal.known && fw_flexure_csfh_usual(in[k]))
        k++;
    return k;
}

/* four cost what three do alone, with AVX what one and a half do: fewer are made four with the last
   one */
static bool at_once(const fw_flexure_input *const in[], fw_flexure_result *const out[], size_t n) {
    bool avx = false;
#ifdef __x86_64__
    avx = __builtin_cpu_supports("avx") != 0;
#endif
    if (n < (avx ? 2 : 3)) return false;
    const fw_flexure_input *from[4];
    fw_flexure_result *to[4];
    for (size_t k = 0; k < 4; k++)
        from[k] = in[k < n ? k : n - 1], to[k] = out[k < n ? k : n - 1];
#ifdef __x86_64__
    if (avx) {
        fw_flexure_csfh_four_avx(from, to);
        return true;
    }
#endif
    fw_flexure_csfh_four(from, to);
    return true;
}

void fw_flexure_closed_forms(const fw_flexure_input *const in[], fw_flexure_result *const out[],
                             size_t n) {
    for (size_t i = 0, k; i < n; i += k) {
        k = alike(in + i, n - i);
        if (at_once(in + i, out + i, k)) continue;
        fw_flexure_closed_form(in[i], out[i]);
        k = 1;
    }
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
