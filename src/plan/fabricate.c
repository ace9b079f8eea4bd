/* SPDX-License-Identifier: GPL-3.0-or-later */
/* From the judged design to masks, test die, sections of the wafer and schedule of every flow. */
#include "base/text.h"
#include "geometry/segment.h"
#include "plan/stages.h"
#include "quantity/quantity.h"
#include <math.h>
#include <string.h>

/* ---- where the wafer is cut open for the pictures of the run sheet ---- */

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
    FW_NEED(cut->name = fw_arena_printf(
                plan->arena, "%s%s, %s", FW_NAMED("hinge", plan->device->revolute[joint].id),
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

/* ---- as --cut asks for it ---- */

static fw_status refuse(fw_plan *plan, const char *why) {
    FW_NEED(why);
    fw_status status =
        fw_diag_error(&plan->diags, 277, (fw_place){0}, "--cut %s: %s", plan->options.cut, why);
    return status == FW_NOMEM ? FW_NOMEM : FW_USAGE;
}

/* a number alone is in um */
static fw_status parse_length(fw_plan *plan, const char *text, size_t n, double *m) {
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
        fw_status status = parse_length(plan, at, n, &value[i]);
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

static const char *unknown_joint(const fw_plan *plan, const char *id) {
    const fw_device *d = plan->device;
    const char **name = fw_arena_array(plan->arena, const char *, 2 * (size_t)d->nrevolute);
    size_t n = 0;
    for (int j = 0; name && j < d->nrevolute; j++) {
        if (!plan->layout->hinge[j].drawn) continue;
        if (d->revolute[j].id) name[n++] = d->revolute[j].id;
        if (d->revolute[j].flexure != FW_NONE) name[n++] = d->flexure[d->revolute[j].flexure].id;
    }
    const char *meant = name ? fw_text_meant(plan->arena, id, name, n) : NULL;
    return meant ? fw_arena_printf(plan->arena,
                                   "no drawn hinge or flexure of this device has that id%s", meant)
                 : NULL;
}

/* where the wafer of a flow whose mask is made is cut open: what the options ask for, else through
   the narrowest gap of a hinge; stays NULL where there is neither */
static fw_status cut_wafer(fw_plan *plan, fw_plan_flow *pf) {
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
            return refuse(plan, unknown_joint(plan, asked + strlen(flexure)));
        if (joint == FW_NONE) return FW_OK;
        FW_TRY(through_joint(plan, pf, joint, cut, &there));
    }
    if (there) pf->cut = cut;
    return FW_OK;
}

/* ---- the test die of a flow ----
   As large as the device's where it takes the place of one on a wafer; else as large as its patterns need.
   What keeps it from being drawn never keeps the device's own mask. */

static fw_status say_unread(fw_plan *plan, const fw_plan_flow *pf, const fw_geometry_box *room,
                            bool found) {
    char w[32], h[32];
    const char *mend = "no die that was tried has room";
    if (found)
        FW_NEED(mend = fw_arena_printf(
                    plan->arena,
                    "with <die width=\"%s um\" height=\"%s um\"> it has; or leave test-dies out, "
                    "and place masks/%s-coupons.gds, which is then as large as it needs",
                    fw_number_text(w, sizeof w, 1e6 * (room->x1 - room->x0), 7),
                    fw_number_text(h, sizeof h, 1e6 * (room->y1 - room->y0), 7), pf->use->ref));
    fw_diag_warning(&plan->diags, 621, plan->device->wafer.place,
                    "flow %s: the test die takes the place of a die, and has no room for what "
                    "steps read off it: %s; %s",
                    pf->use->ref, pf->coupons_lack, mend);
    return plan->diags.failed ? FW_NOMEM : FW_OK;
}

static fw_status lay_out_coupons(fw_plan *plan, fw_plan_flow *pf) {
    const fw_device *device = plan->device;
    fw_mask_coupon_options options = {.die = plan->layout->die,
                                      .frame_m = device->die.frame_m,
                                      .lane_m = device->die.lane_m,
                                      .mask = {.bias_m = pf->mask->bias_m,
                                               .tolerance_m = pf->mask->tolerance_m,
                                               .vertex_limit = pf->mask->vertex_limit,
                                               .flattening = pf->mask->flattening,
                                               .thickness_m = pf->mask->thickness_m,
                                               .rejected = pf->mask->rejected,
                                               .because = pf->mask->because,
                                               .nbecause = pf->mask->nbecause,
                                               .note = pf->mask->note,
                                               .nnote = pf->mask->nnote,
                                               .layer_bias_m = pf->mask->layer_bias_m}};
    fw_diags said = fw_diags_new(plan->arena);
    const bool on_wafer = device->wafer.asked && device->wafer.tests > 0;
    bool found = false;
    fw_status status = fw_mask_coupons_build(plan->arena, pf->table, &options, &said, &pf->coupons);
    if (status == FW_NOMEM || said.failed) return FW_NOMEM;
    if (said.count > 0) {
        fw_geometry_box room;
        FW_TRY(fw_mask_coupons_die(plan->arena, pf->table, &options, &room, &found));
        if (pf->coupons) FW_TRY(fw_plan_coupons_unread(plan, pf));
        if (on_wafer && pf->coupons_lack) FW_TRY(say_unread(plan, pf, &room, found));
        if (found && !on_wafer) {
            options.die = room;
            pf->coupons_lack = NULL;
            said = fw_diags_new(plan->arena);
            status = fw_mask_coupons_build(plan->arena, pf->table, &options, &said, &pf->coupons);
            if (status == FW_NOMEM || said.failed) return FW_NOMEM;
        }
    }
    size_t left_out = said.count;
    if (status != FW_OK) {
        fw_diag_note(&plan->diags, 188, (fw_place){.file = device->file},
                     "there is no test die for flow %s: %s", pf->use->ref,
                     said.count ? said.item[0].message : fw_status_text(status));
        pf->coupons = NULL;
        return FW_OK;
    }
    if (!pf->coupons) return FW_OK;
    if (left_out > 0)
        fw_diag_note(&plan->diags, 186, said.item[0].place,
                     "%zu of %d test patterns of flow %s find no room on a die of this size; "
                     "masks/%s-coupons.json says which",
                     left_out, pf->coupons->content->ncoupon, pf->use->ref, pf->use->ref);
    pf->coupons_gds = fw_text_new(plan->arena);
    FW_TRY(fw_mask_write_gds(pf->coupons->mask, &pf->coupons_gds));
    return fw_plan_hash(plan, &pf->coupons_gds, &pf->coupons_sha256);
}

/* ---- masks and recipes of the flows ---- */

fw_status fw_plan_hash(fw_plan *plan, const fw_text *text, const char **sha256) {
    char hash[65];
    fw_sha256(text->data, text->length, hash);
    FW_NEED(*sha256 = fw_arena_strdup(plan->arena, hash));
    return FW_OK;
}

/* what the mask room does not know itself */
static fw_status notes_of(fw_plan *plan, const fw_plan_flow *pf, fw_mask_options *options) {
    char thickness[32];
    fw_number_text(thickness, sizeof thickness, pf->variant.thickness_m * 1e6, 6);
    const char *line[] = {
        fw_arena_printf(plan->arena, "material=%s", pf->variant.material.id),
        fw_arena_printf(plan->arena, "thickness_um=%s", thickness),
    };
    const int own = sizeof line / sizeof line[0];
    options->nnote = own + plan->noutside;
    FW_NEED(options->note = fw_arena_alloc(plan->arena, (size_t)options->nnote, sizeof *line));
    for (int i = 0; i < own; i++)
        FW_NEED(options->note[i] = line[i]);
    for (int i = 0; i < plan->noutside; i++)
        FW_NEED(options->note[own + i] =
                    fw_arena_printf(plan->arena, "from_outside=%s", plan->outside[i].text));
    return FW_OK;
}

/* the pack's corners that move edges, in words */
static fw_status range_of(fw_plan *plan, const fw_process_flow *flow, const char **out) {
    fw_text range = fw_text_new(plan->arena);
    for (int i = 0; i < flow->ncorner; i++) {
        const fw_process_corner *c = &flow->corner[i];
        const fw_quantity *q = c->q && c->q->unknown ? c->assumed : c->q;
        if (c->of == FW_CORNER_THICKNESS || c->of == FW_CORNER_YOUNGS || c->of == FW_CORNER_LOCAL ||
            !q || q->unknown)
            continue;
        fw_quantity low = *q, high = *q;
        char a[32], b[32];
        fw_process_quantity_range(q, &low.value, &high.value);
        fw_text_printf(&range, "%s%s %s to %s%s%s%s", range.length ? "; " : "", c->name,
                       fw_number_text(a, sizeof a, fw_quantity_in_unit(&low), 4),
                       fw_number_text(b, sizeof b, fw_quantity_in_unit(&high), 4),
                       strcmp(q->unit, "1") == 0 ? "" : " ",
                       strcmp(q->unit, "1") == 0 ? "" : q->unit,
                       q != c->q                 ? " (assumed: it is not known)"
                       : q->status == FW_ASSUMED ? " (assumed)"
                                                 : "");
    }
    FW_TRY(fw_text_end(&range));
    *out = range.length ? range.data : "";
    return FW_OK;
}

/* what the flow leaves of the edges, for the picture of the outlines */
static fw_status edges_of(fw_plan *plan, const fw_process_flow *flow, const fw_mask_edges **out) {
    const fw_process_fixed_point *p = &flow->edges;
    fw_mask_edges *e = fw_arena_one(plan->arena, fw_mask_edges);
    FW_NEED(e);
    *out = e;
    *e = (fw_mask_edges){.least_m = (double)NAN, .most_m = (double)NAN, .range = ""};
    if (p->ncls == 0) return FW_OK;
    const fw_process_edge_class *field = &p->cls[p->field], *narrow = &p->cls[0];
    e->top_m = field->edge.top_m;
    e->bottom_m = field->edge.bottom_m;
    e->least_m = field->low.top_m;
    e->most_m = field->high.top_m;
    e->known_part = p->open || p->wet_open || p->wear.missing;
    FW_TRY(range_of(plan, flow, &e->range));
    double more = narrow->low.bottom_m - field->low.bottom_m;
    if (!(more > 1e-9)) return FW_OK;
    char um[32];
    FW_NEED(
        e->note = fw_arena_printf(
            plan->arena,
            "Edges beside wide openings. In the narrowest slot the bottom edge loses up to %s um "
            "less.",
            fw_number_text(um, sizeof um, more * 1e6, 3)));
    return FW_OK;
}

/* a quantity of the flow that is a known length, for a layer */
static fw_status known_length(fw_plan *plan, const fw_plan_flow *pf, const fw_mask_layer *layer,
                              const char *id, double *m) {
    const fw_quantity *q = fw_process_flow_quantity(pf->flow, id);
    if (q && !q->unknown &&
        fw_quantity_dimension_equal(q->dimension, (fw_quantity_dimension){.m = 1})) {
        *m = q->value;
        return FW_OK;
    }
    fw_diag_error(&plan->diags, 411, layer->place,
                  "layer \"%s\" is drawn by %s, which is not a known length of flow %s", layer->id,
                  id, pf->flow->id);
    return FW_INPUT;
}

/* what layers with shrink or grow get, from the flow's own quantities */
fw_status fw_plan_layer_bias(fw_plan *plan, const fw_plan_flow *pf, const double **bias_m) {
    double *own = fw_arena_array(plan->arena, double, (size_t)pf->table->nlayer);
    FW_NEED(own);
    *bias_m = own;
    for (int k = 0; k < pf->table->nlayer; k++) {
        const fw_mask_layer *l = &pf->table->layer[k];
        double m = 0.0;
        if (l->shrink || l->grow)
            FW_TRY(known_length(plan, pf, l, l->shrink ? l->shrink : l->grow, &m));
        own[k] = l->shrink ? -m : m;
    }
    return FW_OK;
}

/* what a cell draws of the device's layer, or parts of it, hangs together with nothing */
static fw_status warn_of_loose_cells(fw_plan *plan, const fw_plan_flow *pf) {
    const fw_layout *l = plan->layout;
    fw_layout_hold *hold;
    if (fw_plan_insulated(pf)) return FW_OK;
    FW_TRY(fw_layout_cells_hold(plan->arena, l, &hold));
    for (int i = 0; i < l->ncell; i++) {
        if (hold[i].loose == 0) continue;
        const bool one = hold[i].parts == 1 || hold[i].loose == 1;
        fw_diag_warning(
            &plan->diags, 574, l->cell[i].of->layers_place,
            "%s%s %s together with nothing in flow %s, which has no insulating carrier: %s "
            "out when the device is cut free; put %s on text, or plan for a flow that insulates",
            l->cell[i].label, hold[i].of, one ? "hangs" : "hang", pf->flow->id,
            one ? "it falls" : "they fall", one ? "it" : "them");
    }
    return FW_OK;
}

/* what the first of the errors says that came since there were so many diagnostics, and how many came */
static const char *refused(const fw_plan *plan, size_t before) {
    const fw_diag *first = NULL;
    size_t n = 0;
    for (size_t i = before; i < plan->diags.count; i++) {
        if (plan->diags.item[i].severity != FW_ERROR) continue;
        if (n++ == 0) first = &plan->diags.item[i];
    }
    if (!first) return "the mask breaks a design rule or cannot be biased";
    const char *more =
        n > 1 ? fw_arena_printf(plan->arena, "; and %zu more among the messages", n - 1) : "";
    return fw_arena_printf(plan->arena, "its mask: %s [FW-D%03d]%s", first->message, first->number,
                           more ? more : "");
}

/* the mask of one flow; when rules or offsets refuse, the reason is kept and the plan goes on */
fw_status fw_plan_mask_examine(fw_plan *plan, fw_plan_flow *pf, bool rejected) {
    pf->mask_examined = true;
    if (!plan->layout || plan->layout->nfault > 0) { /* dimensions that do not fit in any flow */
        pf->mask_error = "the device cannot be drawn with these dimensions; see the diagnostics";
        return fw_process_flow_add_reason(plan->arena, pf->flow, 0, pf->mask_error);
    }
    if (!plan->layout->drawn) {
        pf->mask_error = plan->layout->why_not ? plan->layout->why_not : "the device has no shapes";
        return FW_OK;
    }
    if (!pf->flow->edges.solved) {
        pf->mask_error = "no bias brings the edges to where they are drawn; see the flow's reasons";
        return FW_OK; /* which say so already */
    }
    fw_mask_options options = {.bias_m = pf->flow->bias_m,
                               .tolerance_m = plan->options.mask_tolerance_m,
                               .vertex_limit = plan->options.mask_vertices,
                               .thickness_m = pf->variant.thickness_m,
                               .rejected = rejected,
                               .because = plan->because,
                               .nbecause = plan->nbecause,
                               .no_islands = !fw_plan_insulated(pf),
                               .wiring = pf->wiring,
                               .title = plan->device->die.title};
    if (!fw_mask_flattening_named(plan->options.mask_flatten, &options.flattening)) return FW_USAGE;
    FW_TRY(notes_of(plan, pf, &options));
    FW_TRY(edges_of(plan, pf->flow, &options.edges));
    FW_TRY(fw_plan_layer_bias(plan, pf, &options.layer_bias_m));
    const fw_layout *layout;
    fw_layout_no_room no_room;
    FW_TRY(warn_of_loose_cells(plan, pf));
    FW_TRY(fw_plan_marked(plan, pf, &layout, &no_room));
    FW_TRY(fw_plan_say_no_room(plan, pf, &no_room));
    const fw_mask *mask = NULL;
    const size_t before = plan->diags.count;
    fw_status status = fw_mask_examine(plan->arena, layout, pf->table, plan->device->name, &options,
                                       &plan->diags, &mask);
    if (status != FW_OK && status != FW_GEOMETRY && status != FW_INPUT) return status;
    pf->violated = mask && mask->nfinding ? mask : NULL;
    pf->mask = status == FW_OK || (mask && mask->whole && plan->options.force) ? mask : NULL;
    if (status == FW_OK) return FW_OK;
    FW_NEED(pf->mask_error = refused(plan, before));
    return fw_process_flow_add_reason(plan->arena, pf->flow, 0, pf->mask_error);
}

fw_status fw_plan_masks_examine(fw_plan *plan) {
    for (int i = 0; i < plan->nflow && plan->verdict.decision != FW_REJECT; i++)
        if (plan->flow[i].flow) FW_TRY(fw_plan_mask_examine(plan, &plan->flow[i], false));
    return FW_OK;
}

fw_status fw_plan_masks(fw_plan *plan) {
    bool rejected = plan->verdict.decision == FW_REJECT;
    for (int i = 0; i < plan->nflow; i++) {
        fw_plan_flow *pf = &plan->flow[i];
        if (!pf->flow) continue;
        if (rejected && !plan->options.force) {
            pf->mask_error = "the design is rejected";
            continue;
        }
        fw_arena_tell(plan->arena, "drawing masks", i, plan->nflow, "flows");
        if (!pf->mask_examined) FW_TRY(fw_plan_mask_examine(plan, pf, rejected));
        if (!pf->mask) continue;
        pf->gds = fw_text_new(plan->arena);
        FW_TRY(fw_mask_write_gds(pf->mask, &pf->gds));
        FW_TRY(fw_plan_hash(plan, &pf->gds, &pf->mask_sha256));
        if (plan->options.drawn_alone) continue;
        FW_TRY(cut_wafer(plan, pf));
        if (plan->options.dies == 0) FW_TRY(lay_out_coupons(plan, pf)); /* one test die will do */
    }
    return FW_OK;
}

/* ---- the schedule of every flow that will be written ---- */

static bool is_step(const fw_plan *plan, const char *id, size_t n) {
    for (int i = 0; i < plan->nflow; i++)
        for (int k = 0; plan->flow[i].flow && k < plan->flow[i].flow->nstep; k++) {
            const char *step = plan->flow[i].flow->step[k].id;
            if (strlen(step) == n && strncmp(step, id, n) == 0) return true;
        }
    return false;
}

/* *near: the step that was probably meant, of all flows; NULL: none is near */
static fw_status step_meant(const fw_plan *plan, const char *id, const char **near) {
    size_t n = 0;
    for (int i = 0; i < plan->nflow; i++)
        n += plan->flow[i].flow ? (size_t)plan->flow[i].flow->nstep : 0;
    const char **name = fw_arena_array(plan->arena, const char *, n);
    FW_NEED(name);
    n = 0;
    for (int i = 0; i < plan->nflow; i++)
        for (int k = 0; plan->flow[i].flow && k < plan->flow[i].flow->nstep; k++)
            name[n++] = plan->flow[i].flow->step[k].id;
    *near = fw_did_you_mean(id, name, n);
    return FW_OK;
}

/* a planning time for a step that no flow of the device has is a slip of the pen */
static fw_status check_planned(fw_plan *plan) {
    for (const char *at = plan->options.schedule.planned; at && *at;) {
        size_t part = strcspn(at, ","), name = strcspn(at, "=,");
        if (name < part && !is_step(plan, at, name)) {
            const char *id = fw_arena_strndup(plan->arena, at, name), *near;
            FW_NEED(id);
            FW_TRY(step_meant(plan, id, &near));
            fw_diag_error(&plan->diags, 199, (fw_place){0},
                          "planning time for '%s': no flow of this device has such a step%s%s%s",
                          id, FW_DID_YOU_MEAN(near));
            return FW_USAGE;
        }
        at += part + (at[part] == ',');
    }
    return FW_OK;
}

fw_status fw_plan_schedules(fw_plan *plan) {
    bool given = plan->verdict.decision != FW_REJECT || plan->options.force;
    FW_TRY(check_planned(plan));
    for (int i = 0; given && i < plan->nflow; i++) {
        fw_plan_flow *pf = &plan->flow[i];
        if (!pf->flow) continue;
        FW_TRY(fw_schedule_make(plan->arena, pf->flow, &plan->options.schedule, &plan->diags,
                                &pf->schedule));
        if (pf->schedule->feasible || pf->schedule->pause_s) continue;
        const char *why = fw_arena_printf(
            plan->arena, "the hold windows of the steps cannot be kept: %s", pf->schedule->why);
        FW_TRY(fw_process_flow_add_reason(plan->arena, pf->flow, 0, why));
    }
    return FW_OK;
}

fw_recipe_header fw_plan_recipe_header(const fw_plan *plan, const fw_plan_flow *pf) {
    return (fw_recipe_header){
        .device = plan->device->name,
        .flow_sha256 = pf->flow_sha256,
        .mask_sha256 = pf->mask_sha256,
        .program_version = FW_VERSION,
        .rejected = plan->verdict.decision == FW_REJECT,
        .tethers = pf->tethers,
        .mechanism =
            plan->verdict.variant ? plan->verdict.variant[pf - plan->flow].mechanism : NULL,
        .verdict = plan->verdict.variant ? &plan->verdict.variant[pf - plan->flow] : NULL,
        .because = plan->because,
        .nbecause = plan->nbecause,
        .schedule = pf->schedule,
        .mask = pf->mask,
        .cut = pf->cut,
        .measuring = pf->measuring,
        .release = pf->release_svg.length ? &pf->release_svg : NULL,
        .wiring = pf->wiring,
        .outside = plan->outside,
        .noutside = plan->noutside,
        .plates_written = pf->wafer || pf->single,
        .test_die = pf->coupons != NULL,
        .test_die_lacks = pf->coupons_lack,
        .wafer = pf->wafer};
}
