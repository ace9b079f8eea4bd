/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is required of probes, as a table for a terminal. */
#include "report/report.h"
#include <math.h>
#include <stdio.h>

static void row(fw_text *out, const fw_verdict_requirement *r, const char *at) {
    char text[FW_PROBE_TEXT], low[FW_PROBE_TEXT], high[FW_PROBE_TEXT], band[2 * FW_PROBE_TEXT + 4];
    fw_text_printf(out, "  %-12s %-13s ", r->probe, r->measure ? r->measure : r->kind);
    if (r->why) {
        fw_text_printf(out, "%-12s  %-24s  ", "not known", "");
    } else {
        snprintf(band, sizeof band, "%s..%s", fw_probe_text(low, r->low, r->unit),
                 fw_probe_text(high, r->high, r->unit));
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
            if (worst && corner > 0) row(out, worst, v->fabricated->corner[corner].what);
        }
    }
}
