/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "recipe/words.h"

static void cell(fw_text *out, const char *text) {
    fw_text_add(out, "<td>");
    fw_text_escaped(out, text);
    fw_text_add(out, "</td>");
}

void fw_html_overrides(const fw_flow *flow, fw_text *out) {
    if (flow->noverride == 0) return;
    fw_text_printf(out,
                   "<h3>Values of the laboratory: %d</h3>\n<table class=\"small\"><thead><tr>"
                   "<th>Value</th><th>Laboratory</th><th>In the process file</th><th>Source</th>"
                   "</tr></thead><tbody>\n",
                   flow->noverride);
    for (int i = 0; i < flow->noverride; i++) {
        const fw_override *o = &flow->override[i];
        fw_text_add(out, "<tr>");
        cell(out, o->id);
        cell(out, o->is);
        cell(out, o->was);
        cell(out, o->source);
        fw_text_add(out, "</tr>\n");
    }
    fw_text_add(out, "</tbody></table>\n");
}
