/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The ladder of `flexwright hinge`: hinges climb the levels of ladder_levels.c, one is picked, and
   what the axis does as the hinge turns is followed. */
#include "plan/plan.h"
#include "base/constants.h"
#include "plan/stages.h"
#include <math.h>
#include <string.h>
#include <time.h>

static double now_s(void) {
    struct timespec t;
    return clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t)
               ? 0
               : (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

fw_status fw_plan_ladder_climb(const fw_plan_ladder_case *c, const fw_plan_ladder_level *of,
                               bool measured, fw_report_level *row) {
    double spent = 0;
    int done = 0;
    *row = (fw_report_level){.name = of->name};
    for (int batch = 1; done == 0 || (measured && spent < 2e-3 && row->state == FW_LEVEL_SOLVED);
         batch *= 2) {
        fw_plan_ladder_case fresh = *c;
        fw_status status = FW_OK;
        FW_NEED(fresh.arena = fw_arena_part(c->arena, 0));
        double began = now_s();
        for (int i = 0; i < batch && status == FW_OK; i++, done++)
            status = of->work(&fresh, row);
        spent += now_s() - began;
        fw_arena_free(fresh.arena);
        FW_TRY(status);
        row->name = of->name;
        if (of->external) return FW_OK; /* has counted the other program's time itself */
    }
    row->cpu_s = spent / done;
    return FW_OK;
}

/* hinge frame to world: where the pin + (along, across) is in the drawn pose; the pin is at W. The
   hinge's own frame has its first root at polar angle -a whichever body that is */
static void place_in_world(const fw_mechanism *mechanism, const fw_mechanism_hinge *hinge,
                           const double at_m[2], double world_m[2]) {
    fw_geometry_vec2 w = fw_mechanism_pin_place(mechanism, &mechanism->pin[hinge->pin], 0);
    double axis = hinge->axis_rad, cs = cos(axis), sn = sin(axis);
    bool known = isfinite(axis); /* else only W itself has a place */
    world_m[0] = w.x + (known ? cs * at_m[0] - sn * at_m[1] : 0);
    world_m[1] = w.y + (known ? sn * at_m[0] + cs * at_m[1] : 0);
}

/* to rounding, NaN is like NaN: what a level sees of a hinge is its input (closed form and law
   follow from it) and, of the material, the constants of the crystal */
static bool same(double a, double b) {
    return a == b || (isnan(a) && isnan(b)) || fabs(a - b) <= 1e-12 * fmax(fabs(a), fabs(b));
}

static bool same_crystal(const fw_flexure_crystal *a, const fw_flexure_crystal *b) {
    if (a->known != b->known) return false;
    return !a->known || (a->aligned == b->aligned && same(a->a0_per_Pa, b->a0_per_Pa) &&
                         same(a->a1_per_Pa, b->a1_per_Pa) && same(a->g0_per_Pa, b->g0_per_Pa) &&
                         same(a->g1_per_Pa, b->g1_per_Pa) && same(a->s12_per_Pa, b->s12_per_Pa) &&
                         hypot(a->cos4 - b->cos4, a->sin4 - b->sin4) <= 1e-12);
}

static bool same_piece(const fw_geometry_strip_piece *a, const fw_geometry_strip_piece *b) {
    bool width = true;
    for (int k = 0; k < 3; k++)
        width = width && same(a->width_m[k], b->width_m[k]);
    return width && same(a->length_m, b->length_m) && same(a->curvature_per_m, b->curvature_per_m);
}

static bool same_pieces(const fw_flexure_input *a, const fw_flexure_input *b) {
    if (a->npiece != b->npiece) return false;
    for (int i = 0; i < a->npiece; i++)
        if (!same_piece(&a->piece[i], &b->piece[i])) return false;
    return true;
}

static bool alike(const fw_plan_ladder_case *one, const fw_plan_ladder_case *other) {
    const fw_flexure_input *a = &one->hinge->input, *b = &other->hinge->input;
    return a->kind == b->kind && same(a->length_m, b->length_m) &&
           same(a->angle_rad, b->angle_rad) && same(a->radius_m, b->radius_m) &&
           same(a->width_m, b->width_m) && same(a->width_middle_m, b->width_middle_m) &&
           same_pieces(a, b) && same(a->fillet_m, b->fillet_m) && same(a->depth_m, b->depth_m) &&
           same(a->youngs_Pa, b->youngs_Pa) && same(a->poisson, b->poisson) &&
           same(a->strength_Pa, b->strength_Pa) && same(a->safety_factor, b->safety_factor) &&
           same_crystal(&a->crystal, &b->crystal);
}

/* the levels are in the order of their cost */
static void pick(fw_plan_ladder *l, double accuracy) {
    l->picked = -1, l->reached = false;
    for (int i = 0; i < l->rows; i++) {
        const fw_report_level *row = &l->row[i];
        if (row->state != FW_LEVEL_SOLVED || l->reached) continue;
        if (l->picked < 0 || row->error.stiffness < l->row[l->picked].error.stiffness)
            l->picked = i;
        l->reached = row->error.stiffness <= accuracy;
    }
    l->reaches = l->picked < 0 ? (double)NAN : l->row[l->picked].error.stiffness;
}

/* ---- what the axis does as the hinge turns ---- */

static double turned(double angle_rad) { /* into (-pi, pi] */
    return remainder(angle_rad, 2 * FW_PI);
}

/* Least angle between where the convex surface is pushed by the drift and the sector in which both
   surfaces are: W of body b drifts along +-y of the hinge's frame from W of body a; small
   rotations, the sector does not turn */
static double aside(const fw_mechanism *m, const fw_mechanism_hinge *h) {
    const fw_mechanism_pin *pin = &m->pin[h->pin];
    if (!isfinite(h->cover_from_rad) || !isfinite(h->axis_rad)) return 0;
    double drawn = pin->body_a == FW_GROUND ? 0 : m->body[pin->body_a].phi_rad;
    double push =
        h->axis_rad - drawn + (h->first_is_a ? 0.5 : -0.5) * FW_PI + (h->convex_is_a ? FW_PI : 0);
    double middle = 0.5 * (h->cover_from_rad + h->cover_to_rad);
    double half = 0.5 * (h->cover_to_rad - h->cover_from_rad);
    return fmax(0, fabs(turned(push - middle)) - half);
}

/* what the finite rotation does, on either side of rest */
static void drift_of(const fw_mechanism *m, const fw_mechanism_hinge *h,
                     fw_plan_ladder_drift *out) {
    const fw_flexure_hinge_law *law = &h->law;
    const fw_device_flexure *f = &m->device->flexure[h->flexure];
    double sense = h->first_is_a ? 1 : -1; /* of the pin's rotation against the law's */
    double most = 1.9 * (FW_PI - law->half_angle_rad) / law->share;
    *out = (fw_plan_ladder_drift){
        .surfaces = {.gap_m = f->gap_m,
                     .aside_rad = aside(m, h),
                     .centre_m = {-h->closed_form.offset_m[0], -h->closed_form.offset_m[1]}},
        .limit_rad = fmin(fmin(h->closed_form.limit_angle_rad, most), 3),
        .contact_rad = {(double)NAN, (double)NAN},
        .closing_N = {(double)NAN, (double)NAN}};
    out->advice = fw_flexure_drift_advise(law, -out->limit_rad, out->limit_rad);
    fw_flexure_drift_curve(law, &out->surfaces, -sense * out->limit_rad, sense * out->limit_rad,
                           FW_DRIFT_POINTS, out->point);
    for (int i = 0; i < FW_DRIFT_POINTS; i++)
        out->point[i].rotation_rad *= sense;
    if (!(f->gap_m > 0)) return;
    out->closing_N[0] = f->gap_m * h->closed_form.kx_N_per_m;
    out->closing_N[1] = f->gap_m * h->closed_form.ky_N_per_m;
    if (out->surfaces.aside_rad >= 0.5 * FW_PI) return; /* pushed away from each other */
    for (int side = 0; side < 2; side++)
        out->contact_rad[side] = sense * fw_flexure_drift_contact_rad(law, &out->surfaces, NULL,
                                                                      (side ? 1 : -1) * (int)sense);
}

/* ---- the ladders of a plan: every hinge in every flow ---- */

typedef struct climber {
    fw_plan *plan;
    fw_plan_ladders *all;
    int wanted;
} climber;

const char *fw_plan_ladder_id(const fw_plan_ladder *l) {
    return l->mechanism->pin[l->hinge->pin].id;
}

static fw_plan_ladder_case case_of(const climber *k, const fw_plan_ladder *l) {
    return (fw_plan_ladder_case){k->plan->arena, l->mechanism, l->hinge, &k->plan->diags};
}

/* the ladder that a hinge like this one has climbed already; -1: none */
static int before(const climber *k, const fw_plan_ladder *l) {
    const fw_plan_ladder_case mine = case_of(k, l);
    for (int i = 0; &k->all->item[i] != l; i++) {
        const fw_plan_ladder_case other = case_of(k, &k->all->item[i]);
        if (k->all->item[i].shared < 0 && alike(&mine, &other)) return i;
    }
    return -1;
}

static bool takes(const climber *k, const fw_plan_ladder *l, int i,
                  const fw_plan_ladder_level *level) {
    if (k->wanted >= 0) return i == k->wanted;
    if (!level->external || k->wanted == FW_LADDER_ALL) return true;
    return k->wanted == FW_LADDER_AUTO && !l->reached;
}

static fw_status climb(const climber *k, fw_plan_ladder *l) {
    size_t count;
    const fw_plan_ladder_level *level = fw_plan_ladder_levels(&count);
    const fw_plan_ladder_case c = case_of(k, l);
    l->shared = before(k, l);
    for (int i = 0; i < (int)count && l->shared < 0; i++) {
        if (!takes(k, l, i, &level[i])) continue;
        FW_TRY(fw_plan_ladder_climb(&c, &level[i], k->wanted != FW_LADDER_ONCE, &l->row[l->rows]));
        l->rows++;
        pick(l, k->all->accuracy);
    }
    if (l->shared >= 0) { /* the numbers are in the hinge's own frame: only its place is another */
        const fw_plan_ladder *from = &k->all->item[l->shared];
        for (l->rows = 0; l->rows < from->rows; l->rows++)
            l->row[l->rows] = from->row[l->rows];
        pick(l, k->all->accuracy);
    }
    for (int i = 0; i < l->rows; i++)
        place_in_world(l->mechanism, l->hinge, l->row[i].at_m, l->row[i].centre_m);
    drift_of(l->mechanism, l->hinge, &l->drift);
    return FW_OK;
}

static bool said(const fw_diags *diags, const fw_diag *d) {
    for (size_t i = 0; i < diags->count; i++)
        if (diags->item[i].number == d->number && strcmp(diags->item[i].message, d->message) == 0)
            return true;
    return false;
}

fw_status fw_plan_hinges_layout(fw_plan *plan, const fw_layout **layout) {
    fw_diags drawing = fw_diags_new(plan->arena);
    *layout = NULL;
    fw_status status = fw_layout_build(plan->arena, plan->device, &drawing, layout);
    if (status != FW_OK && status != FW_GEOMETRY && status != FW_INPUT) return status;
    for (size_t i = 0; status != FW_OK && i < drawing.count; i++)
        if (drawing.item[i].severity == FW_ERROR && !said(&plan->diags, &drawing.item[i]))
            fw_diags_add(&plan->diags, &drawing.item[i], FW_WARNING);
    return drawing.failed ? FW_NOMEM : FW_OK;
}

fw_status fw_plan_hinges_mechanism(fw_plan *plan, const fw_layout *layout,
                                   const fw_mechanism_variant *variant,
                                   const fw_mechanism **mechanism) {
    if (layout && layout->nfault > 0)
        return fw_mechanism_build_hinges(plan->arena, plan->device, layout, variant, &plan->diags,
                                         mechanism);
    return fw_mechanism_build(plan->arena, plan->device, layout, variant, &plan->diags, mechanism);
}

fw_status fw_plan_ladders_run(fw_plan *plan, int wanted, fw_plan_ladders *out) {
    const fw_layout *layout;
    *out = (fw_plan_ladders){.accuracy = plan->options.verdict.motion.accuracy};
    const climber k = {plan, out, wanted};
    FW_TRY(fw_plan_hinges_layout(plan, &layout));
    size_t most = (size_t)plan->nflow * (size_t)plan->device->nrevolute;
    FW_NEED(out->item = fw_arena_array(plan->arena, fw_plan_ladder, most));
    for (int i = 0; i < plan->nflow; i++) {
        const fw_mechanism *m;
        const fw_mechanism_variant *v = &plan->flow[i].variant;
        FW_TRY(fw_plan_hinges_mechanism(plan, layout, v, &m));
        for (int h = 0; h < m->nhinge; h++) {
            fw_plan_ladder *l = &out->item[out->count++];
            *l = (fw_plan_ladder){.flow = v->flow, .mechanism = m, .hinge = &m->hinge[h]};
            FW_TRY(climb(&k, l));
        }
    }
    return FW_OK;
}

fw_status fw_plan_report_hinges(fw_plan *plan, const fw_plan_ladders *all, fw_report_hinge **out) {
    fw_report_hinge *shown;
    FW_NEED(shown = fw_arena_array(plan->arena, fw_report_hinge, (size_t)all->count));
    for (int i = 0; i < all->count; i++) {
        const fw_plan_ladder *l = &all->item[i];
        const fw_mechanism_hinge *h = l->hinge;
        int body = l->mechanism->pin[h->pin].body_a;
        double phi = body == FW_GROUND ? 0 : l->mechanism->body[body].phi_rad;
        shown[i] =
            (fw_report_hinge){.id = fw_plan_ladder_id(l),
                              .flow = l->flow,
                              .hinge = h,
                              .cover_rad = {h->cover_from_rad + phi, h->cover_to_rad + phi},
                              .point = l->drift.point,
                              .npoint = FW_DRIFT_POINTS,
                              .gap_m = l->drift.surfaces.gap_m,
                              .contact_rad = {l->drift.contact_rad[0], l->drift.contact_rad[1]},
                              .level = l->row,
                              .nlevel = l->rows};
    }
    *out = shown;
    return FW_OK;
}
