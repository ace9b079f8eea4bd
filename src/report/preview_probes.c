/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Probes of a motion for the page: a column each, in SI. */
#include "report/json_parts.h"

fw_status fw_report_preview_probes(fw_arena *arena, const fw_report_preview *in, fw_json *out) {
    const fw_dynamics_motion *x = in->motion;
    const int n = fw_probe_count(in->mechanism);
    fw_probe *probe;
    if (n == 0 || !in->scene) return FW_OK;
    FW_TRY(fw_probe_bind(arena, in->mechanism, in->scene, x->loads, &probe));
    fw_json_list(out, "probes");
    for (int i = 0; i < n; i++) {
        if (!fw_report_probe_moves(&probe[i])) continue;
        fw_json_line(out, 0);
        fw_json_object(out, NULL);
        fw_json_text(out, "id", probe[i].asked->id);
        fw_json_text(out, "kind", probe[i].kind->name);
        fw_json_text(out, "unit", probe[i].kind->unit);
        fw_json_list(out, "value");
        for (int k = 0; k < x->nsample; k++)
            fw_json_number(out, NULL, fw_probe_at_row(&probe[i], x, k), 7);
        fw_json_end(out);
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_line(out, 0);
    return FW_OK;
}
