/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is required of probes, as a table for a terminal. */
#include "report/report.h"
#include <math.h>
#include <stdio.h>

/* at: what is made, with its band over all corners; NULL: as drawn */
static void row(fw_text *out, const fw_verdict_requirement *r, const char *at) {
    double reach[2];
    fw_verdict_requirement_band(r, reach);
    char text[FW_PROBE_TEXT], low[FW_PROBE_TEXT], high[FW_PROBE_TEXT], band[2 * FW_PROBE_TEXT + 4];
    fw_text_printf(out, "  %-12s %-13s ", r->probe, r->measure ? r->measure : r->kind);
    if (r->why) {
        fw_text_printf(out, "%-12s  %-24s  ", "not known", "");
    } else {
        snprintf(band, sizeof band, "%s..%s", fw_probe_text(low, reach[0], r->unit),
                 fw_probe_text(high, reach[1], r->unit));
        fw_text_printf(out, "%-12s  %-24s  ", fw_probe_text(text, r->value, r->unit), band);
    }
    bool both = !isnan(r->min) && !isnan(r->max);
    snprintf(band, sizeof band, "%s%s%s%s",
             isnan(r->min) ? "<= "
             : both        ? ""
                           : ">= ",
             isnan(r->min) ? "" : fw_probe_text(low, r->min, r->unit), both ? ".." : "",
             isnan(r->max) ? "" : fw_probe_text(high, r->max, r->unit));
    fw_text_printf(out, "%-16s  ", band);
    fw_text_printf(out, "%-11s  ", r->why ? "" : fw_probe_text(text, r->margin, r->unit));
    fw_text_printf(out, "%-12s %s", fw_verdict_decision_text(r->decision),
                   r->scene ? r->scene : "at rest");
    if (at)
        fw_text_printf(out, ", %s", at);
    else if (r->flow)
        fw_text_printf(out, " (%s)", r->flow);
    fw_text_add(out, "\n");
}

void fw_report_requirements_text(fw_text *out, const fw_verdict *verdict) {
    bool any = false;
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        for (int k = 0; k < v->nrequirement; k++) {
            int corner = 0;
            const fw_verdict_requirement *worst = fw_verdict_requirement_made(v, k, &corner);
            if (!any)
                fw_text_add(out, "\n  required     of            value         band                "
                                 "      required          margin       verdict      in\n");
            any = true;
            row(out, &v->requirement[k], NULL);
            if (worst) row(out, worst, v->fabricated->corner[corner].what);
        }
    }
}

/* ---- probes of one scene ---- */

void fw_report_probes_text(const fw_mechanism *mechanism, const fw_dynamics_motion *motion,
                           fw_text *out) {
    const int n = fw_probe_count(mechanism);
    const fw_probe_monitor *saw = n > 0 ? motion->observed : NULL;
    bool any = false;
    for (int i = 0; saw && i < n; i++) {
        const fw_device_probe *p = &mechanism->device->probe[i];
        const char *unit = fw_device_probe_kinds[p->row].unit;
        char peak[FW_PROBE_TEXT], error[FW_PROBE_TEXT], at[FW_PROBE_TEXT], final[FW_PROBE_TEXT];
        fw_probe_result r;
        fw_probe_result_of(saw, motion->compared, motion, i, &r);
        if (!r.known) continue;
        if (!any)
            fw_text_add(out,
                        "\n  probe        of            peak          at            +-            "
                        "final\n");
        any = true;
        fw_text_printf(out, "  %-12s %-13s %-13s %-13s %-13s %s\n", p->id,
                       fw_device_probe_kinds[p->row].name, fw_probe_text(peak, r.peak, unit),
                       fw_probe_text(at, r.peak_t_s, "s"), fw_probe_text(error, r.numeric, unit),
                       fw_probe_text(final, r.final, unit));
    }
}

fw_status fw_report_rest_probes_text(const fw_mechanism *mechanism, const fw_device_scene *scene,
                                     const fw_statics *statics, fw_text *out) {
    fw_probe *probe;
    FW_TRY(fw_probe_bind(out->arena, mechanism, scene, statics->loads, &probe));
    for (int i = 0; i < fw_probe_count(mechanism); i++) {
        char text[FW_PROBE_TEXT];
        if (!fw_report_probe_moves(&probe[i])) continue;
        fw_text_printf(out, "probe %s (%s): %s\n", probe[i].asked->id, probe[i].kind->name,
                       fw_probe_text(text, fw_probe_at_equilibrium(&probe[i], scene, statics),
                                     probe[i].kind->unit));
    }
    return FW_OK;
}
