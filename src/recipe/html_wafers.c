/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What people write on the run sheet: a column for every wafer and a cell for every site, what becomes of the lot, what
   deviated; and the hazards, each once, by the bench where they are met. */
#include "recipe/recipe_words.h"
#include <string.h>

/* Wafers side by side that still hold five sites that one can write into; cells of a line for each wafer, wide ones and
   narrow ones, beside which start, tool and initials find room on A4 */
enum { WAFERS_ABREAST = 3, WIDE_CELLS = 10, MOST_CELLS = 15 };

/* ---- values of wafers ---- */

static void limits(const fw_process_accept *a, fw_text *out) {
    fw_recipe_put_limits(out, a->low, a->high);
    bool unit = strcmp(a->unit, "1") != 0;
    fw_text_add(out, unit && (a->low[0] || a->high[0]) ? " " : "");
    fw_recipe_put_unit(out, a->unit);
    if (a->sites > 1) fw_text_printf(out, ", %d sites", a->sites);
    if (a->every >= 99)
        fw_text_add(out, ", first wafer");
    else if (a->every > 1)
        fw_text_printf(out, ", first and every %dth", a->every);
}

static void sites(const fw_process_accept *a, int wafer, fw_text *out) {
    if (!fw_process_accept_is_due(a, wafer)) {
        fw_text_add(out, "<td class=\"off\"></td>");
        return;
    }
    fw_text_add(out, "<td class=\"w\">");
    bool ticked = strcmp(a->unit, "yes/no") == 0;
    for (int k = 0; k < a->sites && k < 9; k++)
        fw_text_add(out, ticked ? "<span class=\"box\"></span>" : "<span class=\"s\"></span>");
    fw_text_add(out, "</td>");
}

static void blank_row(const char *name, int n, fw_text *out) {
    fw_text_printf(out, "<tr><td colspan=\"2\">%s</td>", name);
    for (int w = 0; w < n; w++)
        fw_text_add(out, "<td class=\"w\"></td>");
    fw_text_add(out, "</tr>\n");
}

static void measure(const fw_process_accept *a, fw_text *out) {
    fw_text_escaped(out, a->measure);
    if (!a->coupon[0]) return;
    fw_text_add(out, " <span class=\"muted\">on coupon ");
    fw_text_escaped(out, a->coupon);
    fw_text_add(out, "</span>");
}

static void some_wafers(const fw_process_step *s, int first, int n, bool lot, bool one,
                        bool of_dies, fw_text *out) {
    fw_text_add(out, "<table class=\"small wafers\"><thead><tr><th style=\"width:30%\">Accept when"
                     "</th><th style=\"width:17%\">Limits</th>");
    for (int w = first; w < first + n; w++)
        if (lot)
            fw_text_add(out, "<th>Lot</th>");
        else
            fw_text_printf(out, of_dies ? "<th>Dies of wafer %d</th>" : "<th>Wafer %d</th>", w + 1);
    fw_text_add(out, "</tr></thead><tbody>\n");
    for (int i = 0; i < s->naccept; i++) {
        fw_text_add(out, "<tr><td>");
        measure(&s->accept[i], out);
        fw_text_add(out, "</td><td>");
        limits(&s->accept[i], out);
        fw_text_add(out, "</td>");
        for (int w = first; w < first + n; w++)
            sites(&s->accept[i], w, out);
        fw_text_add(out, "</tr>\n");
    }
    if (one) { /* what is written once goes into one line */
        fw_text_add(out, "</tbody></table>\n");
        return;
    }
    blank_row("Start; end", n, out);
    blank_row("Tool; bath or bottle lot", n, out);
    blank_row(s->second_signature ? "Initials; <b>second signature</b>" : "Initials", n, out);
    fw_text_add(out, "</tbody></table>\n");
}

static int cells_of(const fw_process_step *s) {
    int n = 0;
    for (int i = 0; i < s->naccept; i++)
        n += s->accept[i].sites < 9 ? s->accept[i].sites : 9;
    return n;
}

/* a line for each wafer; what a load has in common is written once for it */
static void wafer_lines(const fw_process_step *s, int wafers, bool of_dies, fw_text *out) {
    const int load = fw_process_step_load(s);
    fw_text_printf(out,
                   "<table class=\"small wafers%s\"><thead><tr><th style=\"width:%d%%\">%s</th>",
                   cells_of(s) > WIDE_CELLS ? " narrow" : "", of_dies ? 7 : 4,
                   of_dies ? "Dies of wafer" : "Wafer");
    for (int i = 0; i < s->naccept; i++) {
        fw_text_add(out, "<th>");
        measure(&s->accept[i], out);
        fw_text_add(out, "<br><span class=\"muted\">");
        limits(&s->accept[i], out);
        fw_text_add(out, "</span></th>");
    }
    fw_text_printf(out,
                   "<th style=\"width:15%%\">Start; end</th><th style=\"width:14%%\">Tool; bath or "
                   "bottle lot</th><th style=\"width:9%%\">%s</th></tr></thead><tbody>\n",
                   s->second_signature ? "Initials; second signature" : "Initials");
    for (int w = 0; w < wafers; w++) {
        fw_text_printf(out, "<tr><td>%d</td>", w + 1);
        for (int i = 0; i < s->naccept; i++)
            sites(&s->accept[i], w, out);
        const int rest = wafers - w, rows = load < rest ? load : rest;
        for (int k = 0; k < 3 && w % load == 0; k++)
            fw_text_printf(out, "<td class=\"w\" rowspan=\"%d\"></td>", rows);
        fw_text_add(out, "</tr>\n");
    }
    fw_text_add(out, "</tbody></table>\n");
}

static void one_line(const fw_process_step *s, bool of_dies, fw_text *out) {
    fw_text_printf(out,
                   "<table class=\"actual\"><tr><td>Start</td><td>End</td><td>Tool</td><td>Bath or "
                   "bottle lot</td><td>%s</td><td>%s in, out</td><td>Scrapped, on hold</td>"
                   "<td>Deviation no.</td></tr></table>\n",
                   s->second_signature ? "Initials; <b>second signature</b>" : "Initials",
                   of_dies ? "Dies" : "Wafers");
}

void fw_recipe_html_wafers(const fw_process_step *s, bool of_dies, const fw_recipe_header *header,
                           fw_text *out) {
    int wafers = fw_recipe_wafers(header);
    bool lot = fw_process_step_is_of_lot(s);
    if (lot) wafers = 1;
    const bool lines = wafers > 1 && cells_of(s) <= MOST_CELLS;
    if (lines) wafer_lines(s, wafers, of_dies, out);
    for (int first = 0; first < wafers && !lines; first += WAFERS_ABREAST)
        some_wafers(s, first, wafers - first < WAFERS_ABREAST ? wafers - first : WAFERS_ABREAST,
                    lot, wafers == 1, of_dies, out);
    if (wafers == 1) {
        one_line(s, of_dies, out);
        return;
    }
    fw_text_printf(out,
                   "<p class=\"small\">%s in ______ out ______ scrapped ______ on hold "
                   "______&ensp;Deviation no. ______</p>\n",
                   of_dies ? "Dies" : "Wafers");
}

/* ---- hazards ---- */

typedef struct hazards { /* those that steps have, in the order in which they meet them */
    const fw_process_hazard **of;
    int n;
} hazards;

/* index, or n */
static int place_of(const hazards *met, const fw_process_hazard *h) {
    int i = 0;
    while (i < met->n && met->of[i] != h)
        i++;
    return i;
}

static hazards met_by(const fw_process_flow *flow, fw_text *out) {
    hazards met = {
        .of = fw_arena_array(out->arena, const fw_process_hazard *, (size_t)flow->nhazard)};
    if (!met.of) out->failed = 1;
    for (int i = 0; met.of && i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].nhazard; k++)
            if (place_of(&met, flow->step[i].hazard[k]) == met.n)
                met.of[met.n++] = flow->step[i].hazard[k];
    return met;
}

void fw_recipe_html_hazard_line(const fw_process_flow *flow, const fw_process_step *s,
                                fw_text *out) {
    const hazards met = met_by(flow, out);
    bool alone = true;
    if (s->nhazard == 0) return;
    fw_text_add(out, "<p class=\"hazard\"><b>Hazard</b> ");
    for (int i = 0; i < s->nhazard; i++) {
        int n = place_of(&met, s->hazard[i]) + 1;
        fw_text_printf(out, "%s<a href=\"#hazard-%d\">%d</a> ", i ? "; " : "", n, n);
        fw_text_escaped(out, s->hazard[i]->name);
        alone = alone && !s->hazard[i]->buddy;
    }
    fw_text_add(out, alone ? "</p>\n" : ". <b>Never alone: buddy and second signature.</b></p>\n");
}

/* "acid wet bench: S14, S21" */
static void benches(const fw_process_flow *flow, const fw_process_hazard *h, fw_text *out) {
    int said = 0;
    for (int e = 0; e < flow->nequipment; e++) {
        const fw_process_equipment *q = &flow->equipment[e];
        int n = 0;
        for (int i = 0; i < flow->nstep; i++)
            for (int k = 0; k < flow->step[i].nhazard; k++) {
                if (flow->step[i].hazard[k] != h || flow->step[i].equipment != q) continue;
                if (n == 0) {
                    fw_text_add(out, said++ ? "; " : "");
                    fw_text_escaped(out, q->class_);
                }
                fw_text_add(out, n++ ? ", " : ": ");
                fw_text_escaped(out, flow->step[i].id);
            }
    }
}

static void hazard(const fw_process_flow *flow, const fw_process_hazard *h, int n, fw_text *out) {
    fw_text_printf(out, "<tr id=\"hazard-%d\"><td class=\"n\"><b>%d</b></td><td><b>", n, n);
    fw_text_escaped(out, h->name);
    fw_text_add(out, "</b>");
    if (strcmp(h->ghs, "none") != 0) {
        fw_text_add(out, "<br>");
        fw_text_escaped(out, h->ghs);
    }
    fw_text_add(out, h->buddy ? "<br><b>never alone</b>" : "");
    fw_text_add(out, "<br>");
    benches(flow, h, out);
    fw_text_add(out, "</td><td>");
    fw_text_escaped(out, h->ppe);
    fw_text_add(out, "</td><td>");
    fw_text_escaped(out, h->first_aid);
    fw_text_add(out, "</td><td>");
    if (strcmp(h->waste_stream, "none") != 0) {
        fw_text_add(out, "<b>");
        fw_text_escaped(out, h->waste_stream);
        fw_text_add(out, ":</b> ");
        fw_text_escaped(out, h->waste);
    }
    fw_text_add(out, "</td></tr>\n");
}

void fw_recipe_html_hazards(const fw_process_flow *flow, fw_text *out) {
    const hazards met = met_by(flow, out);
    if (met.n == 0) return;
    fw_text_add(out,
                "<h3>Hazards: read before the lot begins</h3>\n<p>Emergency number ____________ "
                "&ensp; Nearest shower, eye wash, first aid ____________</p>\n"
                "<table class=\"small\"><thead><tr><th></th><th style=\"width:29%\">Hazard, bench: "
                "steps</th><th>Wear and keep ready</th><th>First aid</th><th style=\"width:19%\">"
                "Waste</th></tr></thead><tbody>\n");
    for (int i = 0; i < met.n; i++)
        hazard(flow, met.of[i], i + 1, out);
    fw_text_add(out, "</tbody></table>\n");
}

/* ---- the lot ---- */

void fw_recipe_html_deviations(fw_text *out) {
    fw_text_add(out,
                "<h3>Deviations, and what became of the lot</h3>\n<table class=\"small blank\">"
                "<thead><tr><th style=\"width:6%\">No.</th><th style=\"width:10%\">Step</th>"
                "<th style=\"width:12%\">Wafers</th><th>What was done otherwise, and why</th>"
                "<th style=\"width:20%\">Decided by, date</th></tr></thead><tbody>\n");
    for (int i = 1; i <= 6; i++)
        fw_text_printf(out, "<tr><td>%d</td><td></td><td></td><td></td><td></td></tr>\n", i);
    fw_text_add(out, "</tbody></table>\n<p>Lot closed: wafers finished ______ scrapped ______"
                     "&ensp; by ____________ date ____________</p>\n");
}
