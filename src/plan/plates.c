/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The plates of a flow: do its pack and its layer table speak of the same plates and patterns, and is what moves
   over its hollow wherever it goes? Page: docs/theory/plates.md; test: test_hollows.c. */
#include "geometry/segment.h"
#include "plan/stages.h"
#include "process/films.h"
#include "recipe/recipe.h"
#include <math.h>
#include <string.h>

/* ---- the pack and the layer table ----
   Plates are printed in one order, drawn smaller by the same length, aligned to the same one within the same
   budget. */

static const fw_layout_pattern *on_test_die(const fw_mask_table *table, const char *id, size_t n) {
    for (int i = 0; i < table->npattern; i++)
        if (strlen(table->pattern[i].id) == n && memcmp(table->pattern[i].id, id, n) == 0)
            return &table->pattern[i];
    return NULL;
}

/* what is not there, or is there for something else: does a step read what nothing is measured on, or align by what is no
   mark? */
static void check_pattern(fw_diags *diags, const fw_process_flow *flow, const fw_mask_table *table,
                          const char *step, fw_word id, bool mark, fw_place place) {
    const fw_layout_pattern *p = on_test_die(table, id.at, id.length);
    const char *does = mark ? "aligns by" : "reads coupon";
    if (!p)
        fw_diag_error(diags, 372, place, "step %s %s '%.*s', which masks/%s.xml does not have",
                      step, does, (int)id.length, id.at, flow->id);
    else if (mark ? !p->kind->aligns : !p->measure)
        fw_diag_error(diags, 372, place, "step %s %s '%s', which in masks/%s.xml is a %s: %s", step,
                      does, p->id, flow->id, p->kind->name,
                      mark ? "no plate is put on another by it"
                           : "it does not say what is measured on it (measure)");
}

/* what steps read off a pattern, and marks that they align by, are on the test die */
static void check_coupons(fw_diags *diags, const fw_process_flow *flow,
                          const fw_mask_table *table) {
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        for (int k = 0; k < s->naccept; k++) {
            const fw_process_accept *a = &s->accept[k];
            const fw_word id = {a->coupon, strlen(a->coupon)};
            if (a->coupon[0]) check_pattern(diags, flow, table, s->id, id, false, a->place);
        }
        const char *marks = s->align.to ? s->align.marks : "";
        for (fw_word word; fw_word_next(&marks, " ", &word);)
            check_pattern(diags, flow, table, s->id, word, true, s->align.place);
    }
}

fw_status fw_plan_coupons_unread(fw_plan *plan, fw_plan_flow *pf) {
    const fw_process_flow *flow = pf->flow;
    for (int i = 0; flow && i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].naccept; k++)
            for (int c = 0; c < pf->coupons->content->ncoupon; c++) {
                const fw_layout_coupon *of = &pf->coupons->content->coupon[c];
                if (of->placed || strcmp(of->pattern->id, flow->step[i].accept[k].coupon) != 0)
                    continue;
                const char *had = pf->coupons_lack;
                FW_NEED(pf->coupons_lack =
                            fw_arena_printf(plan->arena, "%s%s%s (%s)", had ? had : "",
                                            had ? ", " : "", of->pattern->id, flow->step[i].id));
            }
    return FW_OK;
}

/* steps print the plates of the table, each once and in its order */
static void check_order(fw_diags *diags, const fw_process_flow *flow, const fw_mask_table *table) {
    int printed = 0;
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        if (!s->mask[0]) continue;
        int plate = fw_mask_plate_named(table, s->mask);
        if (plate < 0 || plate != printed)
            fw_diag_error(
                diags, 412, s->place,
                "step %s prints mask=\"%s\"; next of the plates in masks/%s.xml is %s%s%s", s->id,
                s->mask, flow->id, printed < table->nplate ? "\"" : "none",
                printed < table->nplate ? table->plates[printed].id : "",
                printed < table->nplate ? "\"" : "");
        printed++;
    }
    if (printed < table->nplate)
        fw_diag_error(diags, 412, table->plates[printed].place,
                      "plate \"%s\" is printed by no step of flow %s", table->plates[printed].id,
                      flow->id);
}

/* a table of one plate needs no row for it, and packs call that one M1, or device */
static void check_only(fw_diags *diags, const fw_process_flow *flow, const fw_mask_table *table) {
    const char *only = table->nplate == 1 ? table->plates[0].id : "M1";
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        if (!s->mask[0] || strcmp(s->mask, only) == 0) continue;
        if (table->nplate == 0 && strcmp(s->mask, "device") == 0) continue;
        fw_diag_error(diags, 412, s->place,
                      "step %s prints mask=\"%s\", and the only plate in masks/%s.xml is \"%s\"",
                      s->id, s->mask, flow->id, only);
    }
}

static const fw_process_plate *plate_of(const fw_process_flow *flow, const char *id) {
    for (int p = 0; p < flow->nplate; p++)
        if (fw_text_same(flow->plate[p].id, id)) return &flow->plate[p];
    return NULL;
}

/* rows <plate> of the pack and of the table, but for the device's */
static void check_rows(fw_diags *diags, const fw_process_flow *flow, const fw_mask_table *table) {
    for (int p = 0; p < flow->nplate; p++) {
        int row = fw_mask_plate_named(table, flow->plate[p].id);
        if (row < 0 || row == table->device_plate)
            fw_diag_error(diags, 421, flow->plate[p].place,
                          "plate \"%s\" is %s in masks/%s.xml; <plate> of a pack names those "
                          "besides the device's",
                          flow->plate[p].id, row < 0 ? "no row" : "that of the device", flow->id);
    }
    for (int row = 0; row < table->nplate; row++)
        if (row != table->device_plate && !plate_of(flow, table->plates[row].id))
            fw_diag_error(diags, 421, table->plates[row].place,
                          "the pack says nothing of plate \"%s\"; add <plate id=\"%s\" "
                          "inside=\"...\" outside=\"...\"/> to processes/%s.xml",
                          table->plates[row].id, table->plates[row].id, flow->id);
}

/* every layer of a plate is drawn by the length that the pack names */
static void check_lengths(fw_diags *diags, const fw_process_flow *flow,
                          const fw_mask_table *table) {
    for (int p = 0; p < flow->nplate; p++) {
        const char *shrink = flow->plate[p].shrink ? flow->plate[p].shrink->id : NULL;
        int row = fw_mask_plate_named(table, flow->plate[p].id);
        for (int k = 0; row >= 0 && k < table->nlayer; k++) {
            const fw_mask_layer *l = &table->layer[k];
            const char *by = l->shrink ? l->shrink : l->grow;
            if (!fw_mask_plate_draws(table, row, k) || fw_text_same(by, shrink)) continue;
            fw_diag_error(diags, 421, l->place,
                          "layer \"%s\" of plate \"%s\" is drawn by %s, but the pack draws that "
                          "plate by %s (shrink); name the same quantity in both",
                          l->id, flow->plate[p].id, by ? by : "nothing",
                          shrink ? shrink : "nothing");
        }
    }
}

/* steps align to what the table says, within its budget */
static void check_alignment(fw_diags *diags, const fw_process_flow *flow,
                            const fw_mask_table *table) {
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        int row = s->mask[0] ? fw_mask_plate_named(table, s->mask) : -1;
        if (row < 0) continue;
        const fw_mask_plate_row *t = &table->plates[row];
        if (!fw_text_same(s->align.to, t->aligned_to)) {
            fw_diag_error(diags, 421, s->align.to ? s->align.place : s->place,
                          "step %s aligns plate \"%s\" to %s, and masks/%s.xml to %s", s->id,
                          s->mask, s->align.to ? s->align.to : "nothing", flow->id,
                          t->aligned_to ? t->aligned_to : "nothing");
            continue;
        }
        const fw_quantity *q = s->align.to ? s->align.overlay : NULL;
        char a[32], b[32];
        if (!q || q->unknown || q->value <= t->overlay_m * (1.0 + 1e-9)) continue;
        fw_diag_error(diags, 421, s->align.place,
                      "step %s lets plate \"%s\" lie %s um off, but masks/%s.xml reckons with "
                      "%s um: the hollows and pads of this device stand only that",
                      s->id, s->mask, fw_number_text(a, sizeof a, q->value * 1e6, 4), flow->id,
                      fw_number_text(b, sizeof b, t->overlay_m * 1e6, 4));
    }
}

/* does the step print a plate that is known? *plate: its row; -1: the only one, whatever the step calls it */
static bool prints(const fw_process_step *s, const fw_mask_table *table, int *plate) {
    *plate = s->mask[0] ? fw_mask_plate_named(table, s->mask) : -1;
    return s->mask[0] && (*plate >= 0 || table->nplate <= 1);
}

/* All plates are drawn as seen from the front: one that prints the back must read the other way round. */
static void check_faces(fw_diags *diags, const fw_process_flow *flow, const fw_mask_table *table) {
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        int named;
        if (!prints(s, table, &named)) continue;
        const char *reading = fw_mask_plate_at(table, named < 0 ? 0 : named).reading;
        const bool back = fw_process_step_on_back(s);
        const int mirror = fw_mask_reading_mirrors(reading);
        if (mirror < 0 || (mirror == 1) != back) continue;
        fw_diag_error(diags, 546, s->place,
                      "step %s prints plate \"%s\" on the %s of the wafer, but masks/%s.xml says "
                      "reading=\"%s\": the wafer would get its mirror image, since all plates are "
                      "drawn as seen from the front; write \"%s chrome down\" there, or the other "
                      "side in the step",
                      s->id, s->mask, back ? "back" : "front", flow->id, reading,
                      back ? "wrong-reading" : "right-reading");
    }
}

/* what a resist is exposed in is what the plate leaves clear: inside of its polygons, or outside */
static void check_exposed(fw_diags *diags, const fw_process_flow *flow,
                          const fw_mask_table *table) {
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        int named, first;
        const char *wrong;
        if (!prints(s, table, &named)) continue;
        const fw_mask_plate_row row =
            fw_mask_plate_at(table, named < 0 ? table->device_plate : named);
        if (!row.layers || !fw_mask_plate_layers(table, row.layers, NULL, &first, &wrong)) continue;
        const bool clear = strcmp(table->layer[first].tone, "data clear") == 0;
        for (int k = 0; k < s->nchange; k++) {
            const fw_process_change *c = &s->change[k];
            fw_process_side side;
            if (strcmp(c->kind, "pattern") != 0 || !fw_process_where_side(flow, c->where, &side))
                continue;
            const bool inside = side.plate ? side.set : !side.set;
            if (inside == clear) continue;
            fw_diag_error(diags, 546, c->place,
                          "step %s exposes '%s', which lies %s the polygons of plate \"%s\", but "
                          "masks/%s.xml has them \"%s\": light comes through %s; correct where, or "
                          "the tone of layer \"%s\"",
                          s->id, c->where, inside ? "inside" : "outside of", s->mask, flow->id,
                          table->layer[first].tone, clear ? "inside" : "outside of them",
                          table->layer[first].id);
        }
    }
}

void fw_plan_check_table(fw_diags *diags, const fw_process_flow *flow, const fw_mask_table *table) {
    check_coupons(diags, flow, table);
    if (table->nplate > 1)
        check_order(diags, flow, table);
    else
        check_only(diags, flow, table);
    check_faces(diags, flow, table);
    check_exposed(diags, flow, table);
    check_rows(diags, flow, table);
    check_lengths(diags, flow, table);
    if (table->nplate > 1) check_alignment(diags, flow, table);
}

/* ---- hollows ----
   Below what moves, against what moves: how far it goes, and how much air a scene reckons with.

   A hollow reaches a margin m beyond everything that moves, as it is drawn. A body that a scene carries by d stays over it
   wherever the plates lie when

       d + o <= m,   d = max over instants and corners p of its outline of |x(t) + R(t) p - x0 - R0 p|

   with the budget o between the two plates. An isotropic etch of u leaves the hollow's corners round by u: beside a corner
   of what moves, m and m from that of the hollow, the carrier begins

       sqrt(2) m - (sqrt(2) - 1) u

   away, which is less than m where m < u, and is then what d + o is held against. The displacement of a rigid body is
   affine in p, so that its largest length is at a corner of the box around it. In: poses of the centres of mass at the
   motion's samples, m and rad. Out: m. Error: between samples, and leaves that bend further than what they hold. Cost:
   samples times pieces.

   In a required workspace the platform takes C and D along, and A and F stand. Between two hinges of a body nothing
   goes farther than they; beside the line between them, at most r away, its rotation adds

       d <= max(d_1, d_2) + (d_1 + d_2)/l r,   d_B = 2 sin(A/2) |AB|, d_E likewise

   with the angles that are proved, or estimated, over all required boxes. Test: test_hollows.c */

typedef struct farthest {
    double m;
    int body, scene;
} farthest;

static double displacement(const fw_mechanism_mass *drawn, const double q[3],
                           fw_geometry_vec2 world) {
    fw_geometry_vec2 from = {world.x - drawn->x_m, world.y - drawn->y_m};
    double turn = q[2] - drawn->phi_rad, c = cos(turn), s = sin(turn);
    return hypot(q[0] + c * from.x - s * from.y - world.x,
                 q[1] + s * from.x + c * from.y - world.y);
}

static void of_body(const fw_mechanism *m, const fw_dynamics_motion *motion, fw_geometry_box box,
                    int body, int scene, farthest *far) {
    const fw_geometry_vec2 corner[] = {
        {box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}};
    fw_dynamics_motion_rows(motion, 0, motion->nsample);
    for (int i = 0; i < motion->nsample; i++)
        for (int k = 0; k < 4; k++) {
            const double *q = motion->q + 3 * ((size_t)i * (size_t)motion->nbody + (size_t)body);
            double d = displacement(&m->drawn[body], q, corner[k]);
            if (d > far->m) *far = (farthest){d, body, scene};
        }
}

/* the box around all pieces of a body; false: nothing of it is drawn */
static bool box_of(const fw_layout *layout, int body, fw_geometry_box *box) {
    bool any = false;
    for (int i = 0; i < layout->npiece; i++) {
        if (layout->piece[i].body != body) continue;
        fw_geometry_box own = fw_geometry_contour_box(&layout->piece[i].contour);
        *box = !any ? own
                    : (fw_geometry_box){fmin(box->x0, own.x0), fmin(box->y0, own.y0),
                                        fmax(box->x1, own.x1), fmax(box->y1, own.y1)};
        any = true;
    }
    return any;
}

typedef struct
    bar { /* of the six-bar: two of its points, how far each goes, and how far it turns, at most */
    fw_geometry_vec2 a, b;
    double a_m, b_m, turn_rad;
} bar;

/* No point goes farther than either of the two and the swing about it; between them it goes with the line, and
   swings about its foot there. */
static double point_goes(const bar *of, fw_geometry_vec2 p) {
    fw_geometry_vec2 along = vec_sub(of->b, of->a), from = vec_sub(p, of->a);
    double swing = 2.0 * sin(0.5 * fmin(of->turn_rad, FW_PI)), square = vec_dot(along, along);
    double most =
        fmin(of->a_m + swing * vec_length(from), of->b_m + swing * vec_distance(p, of->b));
    double t = vec_dot(from, along) / square;
    if (t < 0.0 || t > 1.0) return most;
    double off = fabs(vec_cross(along, from)) / sqrt(square);
    return fmin(most, (1.0 - t) * of->a_m + t * of->b_m + swing * off);
}

/* What a point of a rigid body goes is convex: of an arc the corners of its box say enough. */
static double body_goes(const fw_layout *layout, int body, const bar *of) {
    double most = 0.0;
    for (int i = 0; i < layout->npiece; i++) {
        const fw_geometry_contour *c = &layout->piece[i].contour;
        for (int k = 0; layout->piece[i].body == body && k < c->count; k++) {
            const fw_geometry_box box = fw_segment_box(&c->segment[k]);
            const fw_geometry_vec2 corner[4] = {
                {box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}};
            most = fmax(most, point_goes(of, c->segment[k].a));
            for (int n = 0; c->segment[k].kind == FW_ARC && n < 4; n++)
                most = fmax(most, point_goes(of, corner[n]));
        }
    }
    return most;
}

/* of the six-bar's bodies over all required poses, an upper bound; far->scene FW_NONE: of the workspace */
static void of_workspace(const fw_layout *layout, const fw_mechanism *m,
                         const fw_workspace_result *w, farthest *far) {
    const fw_device *device = m->device;
    double shift = 0.0, turn = 0.0, way[FW_SIX] = {0};
    fw_geometry_vec2 at[FW_SIX];
    if (!w->required || !w->reachable || !device->six_bar) return;
    for (int i = 0; i < device->nworkspace; i++) {
        const fw_device_workspace_box *box = &device->workspace[i];
        if (!w->asked[i]) continue;
        shift = fmax(shift, hypot(fmax(fabs(box->x_min_m), fabs(box->x_max_m)),
                                  fmax(fabs(box->y_min_m), fabs(box->y_max_m))));
        turn = fmax(turn, fmax(fabs(box->phi_min_rad), fabs(box->phi_max_rad)));
    }
    for (int j = 0; j < FW_SIX; j++)
        at[j] = layout->hinge[j].centre;
    const fw_device_body *platform = &device->body[2];
    double off = hypot(m->drawn[2].x_m - platform->x_m, m->drawn[2].y_m - platform->y_m);
    for (int j = 2; j < 4; j++) /* C and D go with the platform, about wherever it is stated */
        way[j] = shift + 2.0 * sin(0.5 * turn) *
                             (hypot(at[j].x - m->drawn[2].x_m, at[j].y - m->drawn[2].y_m) +
                              (isfinite(off) ? off : 0.0));
    way[1] =
        2.0 * sin(0.5 * fabs(w->peak[0].angle_rad)) * hypot(at[1].x - at[0].x, at[1].y - at[0].y);
    way[4] =
        2.0 * sin(0.5 * fabs(w->peak[5].angle_rad)) * hypot(at[4].x - at[5].x, at[4].y - at[5].y);
    double by[FW_SIX];
    for (int j = 0; j < FW_SIX; j++)
        by[j] = fabs(w->peak[j].angle_rad);
    /* links turn with their hinges, from the ground or from the platform on */
    const double turns[FW_SIX - 1] = {by[0], fmin(by[0] + by[1], turn + by[2]), turn,
                                      fmin(by[5] + by[4], turn + by[3]), by[5]};
    for (int b = 0; b < FW_SIX - 1; b++) {
        const double length = vec_distance(at[b], at[b + 1]),
                     chord = fmin(1.0, 0.5 * (way[b] + way[b + 1]) / length);
        const bar of = {at[b], at[b + 1], way[b], way[b + 1], fmin(turns[b], 2.0 * asin(chord))};
        double d = body_goes(layout, b, &of);
        if (d > far->m) *far = (farthest){d, b, FW_NONE};
    }
}

static void of_scenes(const fw_plan *plan, const fw_verdict_variant_verdict *v, farthest *far) {
    of_workspace(plan->layout, v->mechanism, &v->workspace, far);
    for (int b = 0; b < plan->device->nbody; b++) {
        fw_geometry_box box;
        if (!box_of(plan->layout, b, &box)) continue;
        for (int s = 0; s < plan->device->nscene; s++)
            if (v->motion[s] && v->motion[s]->q)
                of_body(v->mechanism, v->motion[s], box, b, s, far);
    }
}

/* what the etch of the hollow takes sideways, by which its corners are round; 0: not known */
static double rounding_m(const fw_plan_flow *pf) {
    double most = 0.0;
    for (int i = 0; i < pf->table->nlayer; i++) {
        const fw_mask_layer *l = &pf->table->layer[i];
        const fw_quantity *q = l->shrink && (l->roles & 1u << FW_ROLE_CAVITY)
                                   ? fw_process_flow_quantity(pf->flow, l->shrink)
                                   : NULL;
        if (q && !q->unknown) most = fmax(most, q->value);
    }
    return most;
}

/* v NULL: nothing is known to move; the plates lie aside all the same */
static fw_status travel(fw_plan *plan, const fw_plan_flow *pf, const fw_verdict_variant_verdict *v,
                        double margin_m) {
    farthest far = {.m = 0.0, .scene = FW_NONE};
    if (v) of_scenes(plan, v, &far);
    const double u = rounding_m(pf), corner = sqrt(2.0) * margin_m - (sqrt(2.0) - 1.0) * u,
                 reach = fmin(margin_m, corner);
    double overlay = fw_mask_overlay_m(pf->table, FW_ROLE_CAVITY);
    const int row = fw_mask_plate_of_role(pf->table, FW_ROLE_CAVITY);
    const bool bonded =
        row >= 0 && fw_process_flow_hollow(pf->flow, pf->table->plates[row].id, NULL);
    char goes[32], off[32], has[32], needs[32];
    const double need = far.m + overlay,
                 least = fmax(need, (need + (sqrt(2.0) - 1.0) * u) / sqrt(2.0));
    if (need <= reach) return FW_OK;
    const char *way =
        far.m > 0.0
            ? fw_arena_printf(plan->arena, "%s%s goes %s um in %s%s, and",
                              FW_NAMED("link", plan->device->body[far.body].id),
                              fw_number_text(goes, sizeof goes, far.m * 1e6, 4),
                              far.scene == FW_NONE
                                  ? "a required workspace, at most"
                                  : fw_text_kind("scene ", plan->device->scene[far.scene].name),
                              far.scene == FW_NONE ? "" : plan->device->scene[far.scene].name)
            : "what moves";
    FW_NEED(way);
    const char *why = fw_arena_printf(
        plan->arena,
        "%s may lie %s um aside of its hollow, which reaches only %s um beyond it%s: it would run "
        "over %s. Nearest change: margin=\"%s um\" of <content kind=\"cavity\"> in "
        "masks/%s.xml%s",
        way, fw_number_text(off, sizeof off, overlay * 1e6, 4),
        fw_number_text(has, sizeof has, fmax(reach, 0.0) * 1e6, 4),
        reach < margin_m ? " at its corners, which the etch leaves round" : "",
        bonded ? "bonded glass" : "the wafer below it",
        fw_number_text(needs, sizeof needs, ceil(least * 1e6), 4), pf->flow->id,
        far.m > 0.0 ? ", or less travel" : "");
    FW_NEED(why);
    return fw_process_flow_add_reason(plan->arena, pf->flow, 0, why);
}

/* films of air below a body, against the depth of its hollow */
static void air(const fw_plan *plan, const fw_plan_flow *pf, const char *plate, fw_diags *diags) {
    const fw_process_step *step = NULL;
    const fw_quantity *depth = fw_process_flow_hollow(pf->flow, plate, &step);
    if (!depth || depth->unknown) return;
    double low, high;
    fw_process_quantity_range(depth, &low, &high);
    for (int s = 0; s < plan->device->nscene; s++) {
        const fw_device_scene *scene = &plan->device->scene[s];
        if (!fw_device_in_flow(scene->flow, pf->use->ref)) continue;
        for (int k = 0; k < scene->nair; k++) {
            const fw_device_air *a = &scene->air[k];
            char is[32], has[32];
            if (a->kind != FW_AIR_SLIDE || isnan(a->gap_m) || (a->gap_m >= low && a->gap_m <= high))
                continue;
            fw_diag_warning(
                diags, 422, a->place,
                "scene '%s' reckons with %s um of air below what moves, but step %s of %s etches "
                "hollows of %s um: say gap=\"%s um\", or what the flow shall etch (%s)",
                scene->name, fw_number_text(is, sizeof is, a->gap_m * 1e6, 4), step->id,
                pf->flow->id, fw_number_text(has, sizeof has, depth->value * 1e6, 4), has,
                depth->id ? depth->id : "its depth");
        }
    }
}

fw_status fw_plan_check_hollows(fw_plan *plan, const fw_plan_flow *pf, fw_diags *diags) {
    double margin_m = fw_mask_content_m(pf->table, "cavity", "margin");
    int row = fw_mask_plate_of_role(pf->table, FW_ROLE_CAVITY);
    ptrdiff_t at = pf - plan->flow;
    if (isnan(margin_m)) return FW_OK;
    if (row >= 0) air(plan, pf, pf->table->plates[row].id, diags);
    if (!plan->layout || !plan->layout->drawn) return FW_OK;
    const fw_verdict_variant_verdict *v =
        at < plan->verdict.nvariant ? &plan->verdict.variant[at] : NULL;
    const bool moves = v && v->motion && v->mechanism && v->mechanism->drawn;
    return travel(plan, pf, moves ? v : NULL, margin_m);
}

/* ---- what the flow leaves below the device ---- */

/* the description says what the flow does not: that a device which is cut out of its wafer is put on glass */
static bool on_glass(const fw_plan_flow *pf) {
    return pf->use && pf->use->insulating_carrier && !(pf->flow && pf->flow->insulating);
}

/* What holds the anchors, and whether what lies below lets fields through: by the films of the flow, else silicon, or the
   glass that the description names. */
fw_status fw_plan_find_ground(fw_plan *plan, const fw_plan_flow *pf, fw_mechanism_variant *v) {
    const fw_process_material *carries = NULL, *faces = NULL;
    fw_plan_find_heated(plan->device, v->flow, v);
    if (pf->flow) FW_TRY(fw_process_flow_ground(plan->arena, pf->flow, &carries, &faces));
    if (carries && on_glass(pf))
        return fw_diag_error(&plan->diags, 666, pf->use->place,
                             "devices of flow '%s' stand on %s and are one conductor there: "
                             "carrier=\"insulating\" says otherwise; leave it out",
                             pf->flow->id, carries->name);
    const char *id = carries ? carries->id : on_glass(pf) ? "glass-carrier" : "silicon-substrate";
    const fw_device_material *of = fw_plan_material(plan, pf, id);
    v->substrate_insulates = faces ? faces->conducts == 0 : !carries && on_glass(pf);
    v->substrate = of ? of->name : carries ? carries->name : NULL;
    if (of) v->substrate_expansion = of->expansion, v->substrate_slope = of->expansion_slope;
    if (of) v->substrate_curvature = of->expansion_curvature;
    return FW_OK;
}

fw_status fw_plan_find_below(fw_plan *plan, const fw_plan_flow *pf, fw_mechanism_below *below) {
    bool hollow;
    const char *material;
    *below = (fw_mechanism_below){
        .m = (double)NAN, .low_m = (double)NAN, .high_m = (double)NAN, .words = "not known"};
    if (!pf->flow) return FW_OK;
    const fw_quantity *gap = fw_process_flow_gap(pf->flow, &below->open, &hollow, &material);
    below->known = below->open || (gap && !gap->unknown);
    if (below->open)
        below->words = on_glass(pf)
                           ? "nothing of the wafer, which is etched through; how far below it its "
                             "insulating carrier lies, nothing says"
                           : "nothing: the wafer is etched through";
    if (!below->known || below->open) return FW_OK;
    char um[32];
    fw_number_text(um, sizeof um, 1e6 * gap->value, 4);
    below->m = gap->value;
    fw_process_quantity_range(gap, &below->low_m, &below->high_m);
    FW_NEED(below->words =
                hollow ? fw_arena_printf(plan->arena, "a hollow of %s um in its carrier", um)
                       : fw_arena_printf(plan->arena, "%s um, where %s was", um,
                                         fw_process_flow_material_name(pf->flow, material)));
    return FW_OK;
}

/* ---- how it is dried, and what holds it where it has touched ---- */

static double known(const fw_process_flow *flow, const char *id) {
    const fw_quantity *q = fw_process_flow_quantity(flow, id);
    return q && !q->unknown ? q->value : (double)NAN;
}

/* a meniscus of which nothing is said: of any angle, and as strong as that of water */
static void put_meniscus(const fw_process_drying *of, fw_mechanism_drying *to) {
    const fw_quantity *t = of->tension, *a = of->angle;
    double low, high;
    to->tension_N_per_m = to->tension_high = to->water_N_per_m;
    to->cos_high = 1;
    if (t && !t->unknown) {
        to->tension_N_per_m = t->value;
        fw_process_quantity_range(t, &to->tension_low, &to->tension_high);
    }
    if (!a || a->unknown) return;
    fw_process_quantity_range(a, &low, &high);
    to->cos_low = cos(fmin(fmax(high, 0.0), FW_PI)), to->cos_high = cos(fmax(low, 0.0));
}

static fw_status put_adhesion(fw_arena *arena, const fw_process_flow *flow,
                              fw_mechanism_drying *to) {
    const fw_quantity *q = fw_process_flow_quantity(flow, "surface.adhesion");
    to->adhesion_J_per_m2 = to->adhesion_low = to->adhesion_high = (double)NAN;
    if (!q || q->unknown) return FW_OK;
    to->adhesion_J_per_m2 = q->value;
    fw_process_quantity_range(q, &to->adhesion_low, &to->adhesion_high);
    to->adhesion_low = fmax(to->adhesion_low, 0.0);
    FW_NEED(to->adhesion_words = fw_arena_printf(
                arena, "%s; %s", fw_quantity_value_status_text(q->status), q->source));
    return FW_OK;
}

fw_status fw_plan_drying_of(fw_plan *plan, const fw_plan_flow *pf, const fw_process_drying *of,
                            fw_mechanism_drying *drying) {
    *drying = (fw_mechanism_drying){.how = of->how};
    drying->water_N_per_m = known(pf->flow, "water.tension");
    drying->alcohol_N_per_m = known(pf->flow, "isopropanol.tension");
    FW_TRY(put_adhesion(plan->arena, pf->flow, drying));
    if (of->how == FW_DRIED_PULLED) put_meniscus(of, drying);
    if (of->how == FW_DRIED_NEVER) drying->words = "it never gets wet once it is free";
    if (!of->finish) return FW_OK;
    const char *how = fw_recipe_finish_words(plan->arena, of->finish);
    FW_NEED(how && (drying->words = fw_arena_printf(plan->arena, "step %s (%s)", of->step->id, how))
                ? how
                : NULL);
    return FW_OK;
}

fw_status fw_plan_find_drying(fw_plan *plan, const fw_plan_flow *pf, fw_mechanism_drying *drying) {
    *drying = (fw_mechanism_drying){.how = FW_DRIED_UNKNOWN};
    if (!pf->flow) return FW_OK;
    const fw_process_drying of = fw_process_flow_drying(pf->flow);
    return fw_plan_drying_of(plan, pf, &of, drying);
}
