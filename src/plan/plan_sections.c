/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the wafer is cut open for the pictures of the run sheet. */
#include "base/text.h"
#include "geometry/segment.h"
#include "plan/stages.h"
#include "quantity/quantity.h"
#include <math.h>
#include <string.h>

static const double LEFT_M = 30e-6, RIGHT_M = 75e-6; /* shown beyond the flexure; beyond the gap */
static const double DEPTH_PART = 0.6; /* of the window's length: what stands behind */
static const double LONGEST_M = 1.0;
enum { DIRECTIONS = 41 };

/* ---- through a hinge ---- */

/* the flexure of a joint along a line: what of it lies nearest to the line's own point */
static fw_status flexure_on(fw_plan *plan, const fw_plan_flow *pf, int joint,
                            fw_geometry_cut_line line, fw_geometry_slice *out, bool *there) {
    *there = false;
    for (int i = 0; i < pf->mask->nshape; i++) {
        const fw_layout_piece *p = pf->mask->shape[i].piece;
        fw_geometry_slices in;
        if (p->role != FW_ROLE_FLEXURE || p->joint != joint) continue;
        FW_TRY(fw_geometry_contour_slice(plan->arena, &p->contour, line, &in));
        for (int k = 0; k < in.n; k++) {
            double far = fmin(fabs(in.item[k].from_m), fabs(in.item[k].to_m));
            if (*there && far >= fmin(fabs(out->from_m), fabs(out->to_m))) continue;
            *out = in.item[k];
            *there = true;
        }
    }
    return FW_OK;
}

/* Radially from the hinge's centre through both conjugate surfaces; of the directions in which they
   face each other the one that crosses the flexure most squarely, so that the section shows its
   width. In: a hinge with a gap. Out: s = 0 at the centre. */
static fw_status radial(fw_plan *plan, const fw_plan_flow *pf, int joint,
                        fw_geometry_cut_line *line, double *from_m, double *to_m) {
    const fw_layout_hinge_layout *h = &plan->layout->hinge[joint];
    double best = HUGE_VAL, out = h->surface_radius_m + h->gap_m;
    *from_m = -LEFT_M;
    *to_m = out + RIGHT_M;
    for (int i = 0; i < DIRECTIONS; i++) {
        double part = 0.05 + 0.9 * i / (DIRECTIONS - 1);
        double angle = h->axis_rad + h->facing_from_rad + part * h->facing_rad;
        fw_geometry_cut_line trial = {h->centre, {cos(angle), sin(angle)}};
        fw_geometry_slice flexure;
        bool there;
        FW_TRY(flexure_on(plan, pf, joint, trial, &flexure, &there));
        double cost = (there ? flexure.to_m - flexure.from_m : 1.0) + 1e-9 * fabs(part - 0.5);
        if (cost >= best) continue;
        best = cost;
        *line = trial;
        *from_m = fmin(there ? flexure.from_m : 0.0, 0.0) - LEFT_M;
        *to_m = fmax(out, there ? flexure.to_m : 0.0) + RIGHT_M;
    }
    return FW_OK;
}

/* across the narrowest place of a flexure without surfaces */
static bool across(const fw_plan_flow *pf, int joint, fw_geometry_cut_line *line, double *from_m,
                   double *to_m) {
    for (int i = 0; i < pf->mask->nshape; i++) {
        const fw_mask_shape *s = &pf->mask->shape[i];
        if (s->piece->role != FW_ROLE_FLEXURE || s->piece->joint != joint || !s->neck.there)
            continue;
        fw_geometry_vec2 d = vec_sub(s->neck.at[1], s->neck.at[0]);
        double width = vec_length(d), half = fmax(60e-6, 10.0 * width);
        if (!(width > 0.0)) continue;
        *line = (fw_geometry_cut_line){vec_along(s->neck.at[0], 0.5, d), vec_unit(d)};
        *from_m = -half;
        *to_m = half;
        return true;
    }
    return false;
}

static fw_status through_joint(fw_plan *plan, fw_plan_flow *pf, int joint, fw_recipe_cut *cut,
                               bool *there) {
    fw_geometry_cut_line line = {0};
    double from = 0.0, to = 0.0;
    const fw_layout_hinge_layout *h = &plan->layout->hinge[joint];
    bool gap = h->drawn && h->gap_m > 0.0 && h->facing_rad > 0.0;
    *there = true;
    if (gap)
        FW_TRY(radial(plan, pf, joint, &line, &from, &to));
    else
        *there = across(pf, joint, &line, &from, &to);
    if (!*there) return FW_OK;
    cut->line = (fw_geometry_cut_line){vec_along(line.at, from, line.along), line.along};
    cut->length_m = to - from;
    cut->depth_m = DEPTH_PART * cut->length_m;
    FW_NEED(cut->name =
                fw_arena_printf(plan->arena, "hinge %s, %s", plan->device->revolute[joint].id,
                                gap ? "radially through its gap" : "across its narrowest place"));
    return FW_OK;
}

/* the joint with the narrowest gap; where none has surfaces, the first with a flexure */
static int narrowest(const fw_plan *plan) {
    int best = FW_NONE, any = FW_NONE;
    for (int j = 0; j < plan->device->nrevolute; j++) {
        const fw_layout_hinge_layout *h = &plan->layout->hinge[j];
        if (!h->drawn) continue;
        if (any == FW_NONE) any = j;
        if (h->gap_m > 0.0 && (best == FW_NONE || h->gap_m < plan->layout->hinge[best].gap_m))
            best = j;
    }
    return best == FW_NONE ? any : best;
}

/* ---- as asked for ---- */

static fw_status refuse(fw_plan *plan, const char *why) {
    FW_NEED(why);
    fw_status status =
        fw_diag_error(&plan->diags, 277, (fw_place){0}, "--cut %s: %s", plan->options.cut, why);
    return status == FW_NOMEM ? FW_NOMEM : FW_USAGE;
}

/* a number alone is in um */
static fw_status length_of(fw_plan *plan, const char *text, size_t n, double *m) {
    for (; n > 0 && *text == ' '; n--)
        text++;
    while (n > 0 && text[n - 1] == ' ')
        n--;
    if (fw_number_parse(text, n, m)) {
        *m *= 1e-6;
        return FW_OK;
    }
    fw_quantity_names none = {0};
    fw_quantity_expression_error error = {0};
    return fw_quantity_expression_evaluate(plan->arena, text, n, &none,
                                           (fw_quantity_dimension){.m = 1}, m, &error);
}

static fw_status by_points(fw_plan *plan, fw_recipe_cut *cut) {
    double value[4];
    const char *at = plan->options.cut;
    for (int i = 0; i < 4; i++) {
        size_t n = strcspn(at, ",");
        fw_status status = length_of(plan, at, n, &value[i]);
        if (status == FW_NOMEM) return status;
        bool last = at[n] == '\0';
        if (status != FW_OK || last != (i == 3))
            return refuse(plan, "needs four lengths with commas between, in um or with units, or "
                                "flexure:ID");
        at += n + !last;
    }
    fw_geometry_vec2 a = {value[0], value[1]}, b = {value[2], value[3]};
    double length = vec_distance(a, b);
    if (!(length >= 1e-6 && length <= LONGEST_M))
        return refuse(plan, "the two points must be at least 1 um and at most 1 m apart");
    *cut = (fw_recipe_cut){.line = {a, vec_unit(vec_sub(b, a))}, .length_m = length};
    cut->depth_m = DEPTH_PART * length;
    cut->name = "as asked for";
    return FW_OK;
}

/* a hinge by its joint's id, or the first that has the flexure of this id */
static int named_joint(const fw_plan *plan, const char *id) {
    const fw_device *d = plan->device;
    for (int j = 0; j < d->nrevolute; j++)
        if (d->revolute[j].id && strcmp(d->revolute[j].id, id) == 0 && plan->layout->hinge[j].drawn)
            return j;
    for (int j = 0; j < d->nrevolute; j++)
        if (d->revolute[j].flexure != FW_NONE && plan->layout->hinge[j].drawn &&
            strcmp(d->flexure[d->revolute[j].flexure].id, id) == 0)
            return j;
    return FW_NONE;
}

fw_status fw_plan_cut(fw_plan *plan, fw_plan_flow *pf) {
    static const char flexure[] = "flexure:";
    const char *asked = plan->options.cut;
    bool there = true;
    fw_recipe_cut *cut = fw_arena_one(plan->arena, fw_recipe_cut);
    FW_NEED(cut);
    if (asked && strncmp(asked, flexure, strlen(flexure)) != 0) {
        FW_TRY(by_points(plan, cut));
    } else {
        int joint = asked ? named_joint(plan, asked + strlen(flexure)) : narrowest(plan);
        if (joint == FW_NONE && asked)
            return refuse(plan, "no drawn hinge or flexure of this device has that id");
        if (joint == FW_NONE) return FW_OK;
        FW_TRY(through_joint(plan, pf, joint, cut, &there));
    }
    if (there) pf->cut = cut;
    return FW_OK;
}
