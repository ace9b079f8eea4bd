/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What to measure first: the short table of the run sheet. */
#include "recipe/recipe_profile.h"
#include "recipe/recipe_words.h"
#include <math.h>

enum { SHOWN = 5 }; /* all of them stand in the report */

static void cell(fw_text *out, const char *class, fw_text *text) {
    fw_text_printf(out, "<td%s>", class);
    fw_text_escaped(out, fw_text_end(text) == FW_OK && text->length ? text->data : "");
    fw_text_add(out, "</td>");
}

static void row(fw_text *out, const fw_measuring *m, int i) {
    const fw_measuring_item *x = &m->item[i];
    fw_text input = fw_text_new(out->arena), now = fw_text_new(out->arena),
            then = fw_text_new(out->arena), worth = fw_text_new(out->arena),
            windows = fw_text_new(out->arena);
    fw_text_printf(&input, "%s%s%s%s", x->name, x->id ? " (" : "", x->id ? x->id : "",
                   x->id ? ")" : "");
    fw_measuring_put_value(&now, x, false);
    if (x->unknown && !isnan(x->value)) fw_text_add(&now, " (assumed)");
    fw_text_add(&then, x->by ? x->by : "nothing in this flow");
    if (!isnan(x->value)) {
        fw_text_add(&then, x->by ? ": " : "; ");
        fw_measuring_put_value(&then, x, true);
    }
    fw_measuring_put_worth(&worth, m, x);
    fw_measuring_put_windows(&windows, x);
    fw_text_printf(out, "<tr><td class=\"n\">%d</td>", i + 1);
    cell(out, "", &input);
    cell(out, "", &now);
    cell(out, "", &then);
    cell(out, " class=\"n\"", &worth);
    cell(out, "", &windows);
    fw_text_add(out, "</tr>\n");
}

void fw_recipe_html_measurements(const fw_recipe_header *header, fw_text *out) {
    const fw_measuring *m = header->measuring;
    if (!m || m->nitem == 0) return;
    fw_text_add(out, "<h3>What to measure first</h3>\n");
    if (m->what) {
        fw_text_add(out, "<p class=\"small\">");
        fw_text_escaped(out, m->first ? m->first : "No single measurement narrows the verdict.");
        fw_text_add(out, "</p>\n");
    }
    fw_text_printf(
        out,
        "<table class=\"small\"><thead><tr><th class=\"n\"></th><th>Input</th><th>Now</th>"
        "<th>Read by</th><th class=\"n\">%s</th><th>Time window, first look to clear by"
        "</th></tr></thead><tbody>\n",
        m->banded ? "Band then" : "Uncertainty that it brings");
    for (int i = 0; i < m->nitem && i < SHOWN; i++)
        row(out, m, i);
    fw_text_add(out, "</tbody></table>\n");
    if (m->nitem > SHOWN)
        fw_text_printf(out,
                       "<p class=\"small\">%d more inputs, worth less, stand in the report.</p>\n",
                       m->nitem - SHOWN);
}
