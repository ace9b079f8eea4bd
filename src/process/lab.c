/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laboratory packs: values that replace those of a flow by id. */
#include "process/calibrate.h"
#include "process/pack.h"
#include "process/wafer_state.h"
#include <string.h>

static fw_status amount(fw_arena *arena, const fw_quantity *q, const char **text) {
    fw_text out = fw_text_new(arena);
    if (q->unknown)
        fw_text_add(&out, "unknown");
    else {
        fw_quantity_unit unit;
        double u = q->uncertainty;
        if (fw_quantity_unit_parse(q->unit, strlen(q->unit), &unit, NULL, NULL)) {
            unit.offset = 0.0;
            u = fw_quantity_unit_from_si(&unit, u);
        }
        fw_text_number(&out, fw_quantity_in_unit(q), 6);
        fw_text_add(&out, " +- ");
        fw_text_number(&out, u, 2);
        if (strcmp(q->unit, "1") != 0) fw_text_printf(&out, " %s", q->unit);
    }
    if (!q->unknown) fw_text_printf(&out, " (%s)", fw_quantity_value_status_text(q->status));
    FW_TRY(fw_text_end(&out));
    *text = out.data;
    return FW_OK;
}

static fw_status no_such(fw_process_flow *flow, fw_diags *diags, const fw_xml_attribute *id) {
    const char *best = NULL;
    int least = 3;
    for (int i = 0; i < flow->nquantity; i++) {
        int d = fw_edit_distance(id->value, flow->quantity[i]->id, 2);
        if (d >= least) continue;
        least = d;
        best = flow->quantity[i]->id;
    }
    return fw_diag_error(diags, 211, id->place, "flow '%s' has no quantity '%s'%s%s%s", flow->id,
                         id->value, best ? "; did you mean '" : "", best ? best : "",
                         best ? "'?" : "");
}

static fw_status replace(fw_arena *arena, fw_process_flow *flow, fw_diags *diags,
                         const fw_xml_attribute *id, const fw_quantity *new) {
    fw_quantity *old = (fw_quantity *)fw_process_flow_quantity(flow, id->value);
    if (!old) return no_such(flow, diags, id);
    if (fw_process_quantity_computed(old))
        return fw_diag_error(diags, 211, id->place,
                             "'%s' is computed from this device's mask or by a step, so that a "
                             "laboratory pack cannot replace it; state the quantities that it "
                             "is computed from",
                             id->value);
    if (!fw_quantity_dimension_equal(old->dimension, new->dimension)) {
        const char *is = fw_quantity_dimension_text(arena, new->dimension),
                   *want = fw_quantity_dimension_text(arena, old->dimension);
        FW_NEED(is ? want : NULL);
        return fw_diag_error(
            diags, 211, id->place,
            "'%s' is %s in the process pack, and not %s; write it in a unit of that kind",
            id->value, want, is);
    }
    fw_process_override o = {.id = old->id, .source = new->source};
    FW_TRY(amount(arena, old, &o.was));
    const fw_quantity was = *old;
    FW_TRY(fw_process_correlation_forget(arena, flow, old->id));
    *old = *new;
    old->id = was.id;
    old->least = was.least; /* what makes sense is the pack's to say */
    old->most = was.most;
    old->range = was.range;
    old->replaced = true;
    FW_TRY(amount(arena, old, &o.is));
    /* what a step allows, and texts that name the value, are in the pack's unit; prices keep the
       laboratory's currency */
    if (!fw_quantity_unit_currency(old->unit)) old->unit = was.unit;
    fw_diag_note(diags, 198, id->place, "%s: %s = %s replaces %s; %s", flow->id, o.id, o.is, o.was,
                 o.source);
    fw_process_override *grown = fw_arena_grow(arena, flow->override, (size_t)flow->noverride,
                                               (size_t)flow->noverride + 1, sizeof *grown);
    FW_NEED(grown);
    flow->override = grown;
    flow->override[flow->noverride++] = o;
    return FW_OK;
}

static fw_status replace_all(fw_arena *arena, const fw_xml_record *root, fw_process_flow *flow,
                             fw_diags *diags) {
    size_t before = diags->errors;
    fw_xml_source_text *source;
    int nsource;
    fw_status status = fw_xml_sources_read(arena, root->element, diags, &source, &nsource);
    if (status != FW_OK && status != FW_INPUT) return status;
    for (const fw_xml_record *e = root->first_child; e; e = e->next) {
        const fw_xml_attribute *id = fw_process_pack_get(e, "id");
        fw_quantity q;
        if (!fw_xml_is(e, "q")) continue;
        status = fw_xml_quantity_read(arena, e->element, source, nsource, diags, &q);
        if (status == FW_INPUT) continue;
        FW_TRY(status);
        if (id && (status = replace(arena, flow, diags, id, &q)) != FW_OK && status != FW_INPUT)
            return status;
    }
    if (diags->errors == before)
        for (const fw_xml_record *e = root->first_child; e; e = e->next) {
            if (!fw_xml_is(e, "correlation")) continue;
            status = fw_process_correlation_read(arena, e, flow, diags);
            if (status != FW_OK && status != FW_INPUT) return status;
        }
    fw_status tools = fw_process_lab_tools(arena, root, flow, diags);
    if (tools != FW_OK && tools != FW_INPUT) return tools;
    return diags->failed ? FW_NOMEM : diags->errors > before ? FW_INPUT : FW_OK;
}

fw_status fw_process_lab_apply(fw_arena *arena, const char *file, const char *xml, size_t n,
                               fw_process_flow *flow, fw_diags *diags) {
    fw_xml_reader r = {.arena = arena, .diags = diags, .table = &fw_process_laboratory_table};
    size_t before = diags->errors;
    FW_TRY(fw_xml_read(arena, file, xml, n, diags, &r.root));
    const fw_xml_attribute *of = fw_xml_attribute_of(r.root, "flow");
    bool other = of && strcmp(of->value, flow->id) != 0; /* of another flow of the device */
    if (other && strcmp(r.root->name, r.table->root) == 0 &&
        strcmp(r.root->space, r.table->urn) == 0)
        return FW_OK;
    FW_TRY(fw_xml_records_read(&r));
    FW_TRY(fw_xml_words_read(&r));
    if (!of || other) return FW_INPUT;
    FW_TRY(replace_all(arena, r.record, flow, diags));
    for (int i = 0; i < flow->ncorner && !flow->thickness->unknown; i++)
        if (flow->corner[i].aim_m > 0.0) flow->corner[i].aim_m = flow->thickness->value;
    FW_TRY(fw_process_flow_lint_values(arena, flow, diags));
    FW_TRY(fw_process_flow_waits(arena, flow)); /* their longest times are values, too */
    return diags->errors > before ? FW_INPUT : FW_OK;
}
