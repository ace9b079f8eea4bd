/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The union of pieces that share joints is bounded by their other segments, with the material on
   the left. So width and space of the union need no boolean: every two boundary edges that are near
   enough are looked at, and the side on which the chord leaves tells material from empty space.
   Edges: rules_edges.c; which pairs: rules_search.c; a pair: rules_pair.c. */
#include "mask/rules_search.h"

static const fw_place nowhere;

/* ---- pieces inside each other: no edges meet then ---- */
static bool box_inside(fw_box in, fw_box out) {
    return in.x0 >= out.x0 && in.x1 <= out.x1 && in.y0 >= out.y0 && in.y1 <= out.y1;
}

static void look_at_nested(fw_rule_search *in, const fw_rule_range *r, const fw_rule_range *out) {
    if (!box_inside(r->box, out->box)) return;
    const fw_rule_edge *e = &in->edge[r->first];
    fw_vec2 at = fw_segment_point(&e->s, 0.5);
    if (fw_contour_contains(&in->shape[out->shape].contour, at))
        fw_rule_report(
            in, (fw_finding){FW_RULE_OVERLAP, {r->shape, out->shape}, {e->segment, 0}, 0, 0, at});
}

static void look_at_nesting(fw_rule_search *in) {
    for (int i = 0; i < in->nrange; i++)
        for (int j = i + 1; j < in->nrange && in->range[j].box.x0 <= in->range[i].box.x1; j++) {
            look_at_nested(in, &in->range[i], &in->range[j]);
            look_at_nested(in, &in->range[j], &in->range[i]);
        }
}

/* ---- messages ---- */
static void tell(const fw_rule_search *in, const fw_finding *f, fw_diags *diags) {
    const fw_mask_shape *p = &in->shape[f->shape[0]], *q = &in->shape[f->shape[1]];
    const char *name_p = p->piece->label, *name_q = q->piece->label;
    char at[80], value[32], needed[32], rule[32];
    fw_mask_place_text(at, sizeof at, f->at);
    fw_number_text(value, sizeof value, f->value_m * 1e6, 6);
    fw_number_text(needed, sizeof needed, f->needed_m * 1e6, 6);
    double limit = f->kind == FW_RULE_WIDTH ? in->layer->min_width_m : in->layer->min_space_m;
    fw_number_text(rule, sizeof rule, limit * 1e6, 6);
    const char *source = in->layer->rule_source ? in->layer->rule_source : "layer table";
    if (f->kind == FW_RULE_OVERLAP)
        fw_diag_error(diags, 152, nowhere,
                      "%s (edge %d) and %s (edge %d) meet at %s on layer %s without a shared "
                      "joint; move them apart or join them",
                      name_p, f->segment[0], name_q, f->segment[1], at, in->layer->name);
    else
        fw_diag_error(diags, f->kind == FW_RULE_WIDTH ? 144 : 145, nowhere,
                      "%s (edge %d) and %s (edge %d): %s of %s um at %s; layer %s needs %s um "
                      "(rule %s um and what the 1 nm grid takes; %s); %s, or choose a smaller bias",
                      name_p, f->segment[0], name_q, f->segment[1],
                      f->kind == FW_RULE_WIDTH ? "width" : "space", value, at, in->layer->name,
                      needed, rule, source,
                      f->kind == FW_RULE_WIDTH ? "make the part wider there"
                                               : "move the edges apart there");
}

static double perimeter_of(const fw_rule_edge *e, int n) {
    double sum = 0;
    for (int i = 0; i < n; i++)
        sum += fw_segment_length(&e[i].s);
    return sum;
}

fw_status fw_mask_check_rules(fw_arena *arena, const fw_mask_table *table,
                              const fw_mask_shape *shape, int nshape, double tolerance_m,
                              fw_mask_measure *measure, fw_diags *diags) {
    size_t errors = diags->errors;
    for (int k = 0; k < table->nlayer; k++) {
        fw_mask_measure *m = &measure[k];
        fw_rule_search in = {
            .arena = arena, .layer = &table->layer[k], .index = k, .shape = shape, .measure = m};
        m->width_m = m->space_m = HUGE_VAL;
        FW_TRY(fw_rule_edges(&in, nshape, tolerance_m));
        m->perimeter_m = perimeter_of(in.edge, in.nedge);
        fw_rule_look(&in);
        look_at_nesting(&in);
        if (m->width_m > FW_MASK_LOOK_M) m->width_m = HUGE_VAL;
        if (m->space_m > FW_MASK_LOOK_M) m->space_m = HUGE_VAL;
        if (in.no_memory) return FW_NOMEM;
        fw_rule_tidy(&in);
        for (int i = 0; i < in.nfound; i++)
            tell(&in, &in.found[i], diags);
    }
    if (diags->failed) return FW_NOMEM;
    return diags->errors > errors ? FW_INPUT : FW_OK;
}
