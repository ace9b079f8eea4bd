/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What stands in packs, flows and steps, by its name. */
#include "process/pack.h"
#include "base/text.h"
#include <math.h>
#include <string.h>

fw_quantity *fw_process_flow_own_quantity(const fw_process_flow *flow, const char *id) {
    for (int i = flow->nquantity - 1; i >= 0; i--) /* the flow's own come after the shared ones */
        if (flow->quantity[i]->id && strcmp(flow->quantity[i]->id, id) == 0)
            return flow->quantity[i];
    return NULL;
}

const fw_quantity *fw_process_flow_quantity(const fw_process_flow *flow, const char *id) {
    return fw_process_flow_own_quantity(flow, id);
}

const fw_process_material *fw_process_flow_material(const fw_process_flow *flow, const char *id) {
    for (int i = flow->nprocess_material - 1; i >= 0; i--)
        if (strcmp(flow->process_material[i].id, id) == 0) return &flow->process_material[i];
    return NULL;
}

const char *fw_process_flow_material_name(const fw_process_flow *flow, const char *id) {
    const fw_process_material *m = fw_process_flow_material(flow, id);
    return m ? m->name : id;
}

void fw_process_quantity_range(const fw_quantity *q, double *low, double *high) {
    *low = q->interval ? q->low : q->value - 2.0 * q->uncertainty;
    *high = q->interval ? q->high : q->value + 2.0 * q->uncertainty;
}

bool fw_process_quantity_computed(const fw_quantity *q) {
    return strncmp(q->id, "mask.", 5) == 0 || (q->status == FW_DERIVED && q->unknown);
}

const fw_quantity *fw_process_step_argument(const fw_process_step *s, const char *name) {
    for (int i = 0; i < s->nargument; i++)
        if (strcmp(s->argument[i].name, name) == 0) return s->argument[i].q;
    return NULL;
}

bool fw_process_corner_counts(const fw_process_corner *c) {
    return !c->within || c->within->unknown || c->within->status != FW_MEASURED;
}

bool fw_process_accept_is_due(const fw_process_accept *a, int wafer) {
    return wafer == 0 || (a->every < 99 && wafer % a->every == 0);
}

bool fw_process_step_is_of_lot(const fw_process_step *s) {
    enum { ONCE_PER_LOT = 99 }; /* batch of a pack */
    return s->batch >= ONCE_PER_LOT;
}

int fw_process_step_load(const fw_process_step *s) {
    int capacity = s->equipment && s->equipment->capacity > 0 ? s->equipment->capacity : 1;
    int load = s->batch < capacity ? s->batch : capacity;
    return load < 1 ? 1 : load;
}

const fw_quantity *fw_process_law_input(const fw_process_law_use *use, const char *name) {
    for (int i = 0; i < use->nargument; i++)
        if (strcmp(use->argument[i].name, name) == 0)
            return use->argument[i].q->unknown ? NULL : use->argument[i].q;
    return NULL;
}

fw_status fw_process_step_derive(fw_arena *arena, fw_process_step *step, const char *name,
                                 double value, double uncertainty_si,
                                 fw_quantity_dimension dimension, const char *unit,
                                 fw_quantity_value_status status, const char *source) {
    fw_quantity *q = fw_arena_one(arena, fw_quantity);
    const fw_quantity **grown = fw_arena_grow(arena, step->derived, (size_t)step->nderived,
                                              (size_t)step->nderived + 1, sizeof *step->derived);
    FW_NEED(q && grown);
    /* what is computed is at best derived */
    status = fw_process_status_worse(status, FW_DERIVED);
    bool known = isfinite(value) && isfinite(uncertainty_si);
    *q = (fw_quantity){.id = name,
                       .unknown = !known,
                       .value = known ? value : 0.0,
                       .uncertainty = known ? fabs(uncertainty_si) : 0.0,
                       .dimension = dimension,
                       .unit = unit,
                       .status = status,
                       .u_status = status,
                       .source = source,
                       .place = step->place};
    grown[step->nderived++] = q;
    step->derived = grown;
    return FW_OK;
}

void fw_process_step_overrun(fw_process_step *s) {
    const fw_quantity *q = s->overrun_from;
    if (q) s->overrun = q->unknown ? 0.0 : q->value;
}

const fw_xml_attribute *fw_process_pack_get(const fw_xml_record *e, const char *name) {
    return fw_xml_cell_of(e, name)->given;
}

const char *fw_process_pack_text(const fw_xml_record *e, const char *name) {
    const fw_xml_attribute *a = fw_process_pack_get(e, name);
    return a ? a->value : "";
}

const char *fw_process_pack_where(const fw_xml_record *e) {
    const fw_xml_attribute *a = fw_process_pack_get(e, "where");
    return a ? a->value : "all";
}

const fw_quantity *fw_process_pack_quantity(fw_process_pack *pack, const fw_xml_record *e,
                                            const char *name) {
    const fw_xml_attribute *a = fw_process_pack_get(e, name);
    return a ? fw_process_pack_find(pack, a, FW_ID_QUANTITY) : NULL;
}

double fw_process_pack_number(const fw_xml_record *e, const char *name, double absent) {
    const fw_xml_cell *cell = fw_xml_cell_of(e, name);
    return cell->ok ? cell->number : absent;
}

/* the flow's own one wins over the shared one */
static const fw_process_id *find(const fw_process_pack *pack, const char *id) {
    int low = 0, high = pack->nid;
    while (low < high) {
        int middle = low + (high - low) / 2;
        if (strcmp(pack->id[middle].id, id) < 0)
            low = middle + 1;
        else
            high = middle;
    }
    return low < pack->nid && strcmp(pack->id[low].id, id) == 0 ? &pack->id[low] : NULL;
}

static const char *nearest(const fw_process_pack *pack, const char *wrong,
                           fw_process_id_kind kind) {
    const char *best = NULL;
    int least = 3;
    for (int i = 0; i < pack->nid; i++) {
        int d = pack->id[i].kind == kind ? fw_edit_distance(wrong, pack->id[i].id, 2) : 3;
        if (d < least) {
            least = d;
            best = pack->id[i].id;
        }
    }
    return best;
}

void *fw_process_pack_find(fw_process_pack *pack, const fw_xml_attribute *attribute,
                           fw_process_id_kind kind) {
    static const char *const word[] = {"source",   "material", "equipment",  "hazard",
                                       "quantity", "step",     "consumable", "bath"};
    const fw_process_id *found = find(pack, attribute->value);
    if (found && found->kind == kind) return found->item;
    const char *best = nearest(pack, attribute->value, kind);
    fw_diag_error(pack->diags, 165, attribute->place, "%s='%s': there is no %s with this id%s%s%s",
                  attribute->name, attribute->value, word[kind], best ? "; did you mean '" : "",
                  best ? best : "", best ? "'?" : "");
    return NULL;
}
