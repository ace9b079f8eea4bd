/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "report/json_effects.h"

void fw_json_effects(json_t *list, const fw_effect_ledger *ledger, const char *scene,
                     const char *flow, bool *failed) {
    for (int i = 0; i < ledger->count; i++) {
        const fw_effect_entry *e = &ledger->item[i];
        json_t *o = json_object();
        fw_json_put(o, "id", fw_json_text(e->id), failed);
        fw_json_put(o, "active", json_boolean(e->active), failed);
        fw_json_put(o, "bound", fw_json_real(e->bound), failed); /* null: it is the motion */
        fw_json_put(o, "reason", fw_json_text(e->reason), failed);
        fw_json_put(o, "called_for", json_boolean(e->called_for), failed);
        fw_json_put(o, "cost", fw_json_real(e->cost), failed); /* instructions per evaluation */
        if (scene) fw_json_put(o, "scene", fw_json_text(scene), failed);
        if (flow) fw_json_put(o, "flow", fw_json_text(flow), failed);
        fw_json_push(list, o, failed);
    }
}
