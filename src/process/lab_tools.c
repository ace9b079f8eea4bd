/* SPDX-License-Identifier: GPL-3.0-or-later */
/* When a laboratory's machines may be used; what the words mean is looked at by schedule/. */
#include "base/text.h"
#include "process/pack.h"
#include <string.h>

static fw_status known(fw_arena *arena, const fw_process_flow *flow, const fw_xml_attribute *a,
                       fw_diags *diags) {
    const char **id = fw_arena_array(arena, const char *, (size_t)flow->nequipment);
    FW_NEED(id);
    for (int i = 0; i < flow->nequipment; i++) {
        id[i] = flow->equipment[i].id;
        if (strcmp(id[i], a->value) == 0) return FW_OK;
    }
    const char *best = fw_did_you_mean(a->value, id, (size_t)flow->nequipment);
    return fw_diag_error(diags, 376, a->place, "flow '%s' has no equipment '%s'%s%s%s", flow->id,
                         a->value, best ? "; did you mean '" : "", best ? best : "",
                         best ? "'?" : "");
}

fw_status fw_process_lab_tools(fw_arena *arena, const fw_xml_record *root, fw_process_flow *flow,
                               fw_diags *diags) {
    for (const fw_xml_record *e = root->first_child; e; e = e->next) {
        if (!fw_xml_is(e, "tool")) continue;
        const fw_xml_attribute *equipment = fw_process_pack_get(e, "equipment"),
                               *open = fw_process_pack_get(e, "open"),
                               *days = fw_process_pack_get(e, "days"),
                               *closed = fw_process_pack_get(e, "closed"),
                               *to = fw_process_pack_get(e, "to");
        if (!equipment) continue; /* said by the table */
        fw_status status = known(arena, flow, equipment, diags);
        if (status == FW_NOMEM) return status;
        if ((open != NULL) == (closed != NULL) || (days && !open) || (to && !closed)) {
            fw_diag_error(diags, 376, e->element->place,
                          "<tool> says either when it is open, with days, or from when it is "
                          "closed, with to");
            continue;
        }
        fw_process_tool_time *grown =
            fw_arena_grow(arena, flow->tool_time, (size_t)flow->ntool_time,
                          (size_t)flow->ntool_time + 1, sizeof *grown);
        FW_NEED(grown);
        flow->tool_time = grown;
        grown[flow->ntool_time++] = (fw_process_tool_time){.equipment = equipment->value,
                                                           .open = open ? open->value : NULL,
                                                           .days = days ? days->value : "",
                                                           .from = closed ? closed->value : NULL,
                                                           .to = to       ? to->value
                                                                 : closed ? closed->value
                                                                          : NULL,
                                                           .place = e->element->place};
    }
    return FW_OK;
}
