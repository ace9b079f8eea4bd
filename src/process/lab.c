/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Laboratory packs: values that replace those of a flow by id. */
#include "process/calibrate.h"
#include "process/pack.h"
#include <string.h>

static bool computed_id(const fw_quantity *q) {
    return strncmp(q->id, "mask.", 5) == 0 || (q->status == FW_DERIVED && q->unknown);
}

static fw_status amount(fw_arena *arena, const fw_quantity *q, const char **text) {
    fw_text out = fw_text_new(arena);
    if (q->unknown)
        fw_text_add(&out, "unknown");
    else {
        fw_unit unit;
        double u = q->uncertainty;
        if (fw_unit_parse(q->unit, strlen(q->unit), &unit, NULL, NULL)) {
            unit.offset = 0.0;
            u = fw_unit_from_si(&unit, u);
        }
        fw_text_number(&out, fw_quantity_in_unit(q), 6);
        fw_text_add(&out, " +- ");
        fw_text_number(&out, u, 2);
        if (strcmp(q->unit, "1") != 0) fw_text_printf(&out, " %s", q->unit);
    }
    if (!q->unknown) fw_text_printf(&out, " (%s)", fw_value_status_text(q->status));
    FW_TRY(fw_text_end(&out));
    *text = out.data;
    return FW_OK;
}

static fw_status no_such(fw_flow *flow, fw_diags *diags, const fw_attribute *id) {
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

static fw_status replace(fw_arena *arena, fw_flow *flow, fw_diags *diags, const fw_attribute *id,
                         const fw_quantity *new) {
    fw_quantity *old = (fw_quantity *)fw_flow_quantity(flow, id->value);
    if (!old) return no_such(flow, diags, id);
    if (computed_id(old))
        return fw_diag_error(diags, 211, id->place,
                             "'%s' is computed from this device's mask or by a step, so that a "
                             "laboratory pack cannot replace it; state the quantities that it "
                             "is computed from",
                             id->value);
    if (!fw_dimension_equal(old->dimension, new->dimension)) {
        const char *is = fw_dimension_text(arena, new->dimension),
                   *want = fw_dimension_text(arena, old->dimension);
        FW_NEED(is ? want : NULL);
        return fw_diag_error(diags, 211, id->place, "'%s' is %s in the process pack, not %s",
                             id->value, want, is);
    }
    fw_override o = {.id = old->id, .source = new->source};
    FW_TRY(amount(arena, old, &o.was));
    const char *name = old->id;
    fw_place place = old->place;
    *old = *new;
    old->id = name;
    old->place = place;
    FW_TRY(amount(arena, old, &o.is));
    fw_diag_note(diags, 198, id->place, "%s: %s = %s replaces %s; %s", flow->id, o.id, o.is, o.was,
                 o.source);
    fw_override *grown = fw_arena_grow(arena, flow->override, (size_t)flow->noverride,
                                       (size_t)flow->noverride + 1, sizeof *grown);
    FW_NEED(grown);
    flow->override = grown;
    flow->override[flow->noverride++] = o;
    return FW_OK;
}

static fw_status replace_all(fw_arena *arena, const fw_element *root, fw_flow *flow,
                             fw_diags *diags) {
    size_t before = diags->errors;
    fw_source_text *source;
    int nsource;
    fw_status status = fw_sources_read(arena, root, diags, &source, &nsource);
    if (status != FW_OK && status != FW_INPUT) return status;
    for (const fw_element *e = root->first_child; e; e = e->next) {
        const fw_attribute *id = fw_xml_attribute(e, "id");
        if (strcmp(e->name, "q") != 0) {
            if (strcmp(e->name, "source") != 0)
                fw_diag_error(diags, 211, e->place,
                              "a laboratory pack holds <source> and <q> only, not <%s>", e->name);
            continue;
        }
        fw_quantity q;
        status = fw_quantity_read(arena, e, source, nsource, diags, &q);
        if (status == FW_INPUT) continue;
        FW_TRY(status);
        if (!id)
            fw_diag_error(diags, 211, e->place, "<q> needs the attribute 'id'");
        else if ((status = replace(arena, flow, diags, id, &q)) != FW_OK && status != FW_INPUT)
            return status;
    }
    return diags->failed ? FW_NOMEM : diags->errors > before ? FW_INPUT : FW_OK;
}

fw_status fw_lab_apply(fw_arena *arena, const char *file, const char *xml, size_t n, fw_flow *flow,
                       fw_diags *diags) {
    fw_element *root;
    FW_TRY(fw_xml_read(arena, file, xml, n, diags, &root));
    if (!root) return FW_INPUT;
    if (strcmp(root->name, "process") != 0 || !root->space ||
        strcmp(root->space, "urn:flexwright:process:1") != 0)
        return fw_diag_error(diags, 178, root->place,
                             "a laboratory pack starts with <process "
                             "xmlns=\"urn:flexwright:process:1\">, not with <%s>",
                             root->name);
    const fw_attribute *of = fw_xml_attribute(root, "flow");
    if (!of)
        return fw_diag_error(diags, 211, root->place,
                             "a laboratory pack must state the flow to which its values apply: "
                             "add flow=\"%s\" to <process>",
                             flow->id);
    if (strcmp(of->value, flow->id) != 0) return FW_OK; /* of another flow of the device */
    FW_TRY(replace_all(arena, root, flow, diags));
    for (int i = 0; i < flow->ncorner && !flow->thickness->unknown; i++)
        if (flow->corner[i].aim_m > 0.0) flow->corner[i].aim_m = flow->thickness->value;
    return FW_OK;
}
