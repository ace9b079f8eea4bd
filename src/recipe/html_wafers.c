/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What people write on the run sheet: a column for every wafer and a cell for every site, what becomes of the lot, what
   deviated; and the hazards, each once, by the bench where they are met. */
#include "recipe/asrun_parts.h"
#include "recipe/recipe.h"
#include "base/constants.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

/* Wafers side by side that still hold five sites that one can write into; cells of a line for each wafer, wide ones and
   narrow ones, beside which start, tool and initials find room on A4, and so few that two wafers share a line */
enum { WAFERS_ABREAST = 3, WIDE_CELLS = 10, MOST_CELLS = 15, FEW_CELLS = 5 };

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

/* how many wafers stand side by side in a row: wafers of one load share what is written once for it, others have all of it
   twice in a row where their cells are few */
static int abreast(const fw_process_step *s, int wafers, int load) {
    const int cells = s->naccept > 2 ? MOST_CELLS : cells_of(s),
              most = load > 1 && load < wafers ? load : wafers;
    int n = cells <= FEW_CELLS ? 2 : 1;
    if (load > 1 && cells <= 2) n = 3;
    return n < most ? n : most;
}

static void common_heads(const fw_process_step *s, int among, fw_text *out) {
    fw_text_printf(out,
                   "<th style=\"width:%d%%\">Start; end</th><th style=\"width:%d%%\">Tool; bath "
                   "or bottle lot</th><th style=\"width:%d%%\">%s</th>",
                   among > 1 ? 10 : 15, among > 1 ? 12 : 14, among > 1 ? 6 : 9,
                   s->second_signature ? "Initials; second signature" : "Initials");
}

static void measure_head(const fw_process_accept *a, int columns, fw_text *out) {
    fw_text_printf(out, columns > 1 ? "<th colspan=\"%d\">" : "<th>", columns);
    measure(a, out);
    fw_text_add(out, columns > 1 ? " <span class=\"muted\">" : "<br><span class=\"muted\">");
    limits(a, out);
    fw_text_add(out, "</span></th>");
}

/* one thing that is measured stands once above all wafers of a row; several stand above each */
static void lines_head(const fw_process_step *s, int n, bool shared, bool of_dies, fw_text *out) {
    const int own = s->naccept + 1 + (shared ? 0 : 3);
    fw_text_add(out, "<thead>");
    if (n > 1 && s->naccept == 1) {
        fw_text_add(out, "<tr>");
        measure_head(&s->accept[0], own * n + (shared ? 3 : 0), out);
        fw_text_add(out, "</tr>");
    }
    fw_text_add(out, "<tr>");
    for (int k = 0; k < n; k++) {
        fw_text_printf(out, "<th style=\"width:%d%%\">%s</th>", of_dies ? 7 : 4,
                       of_dies ? "Dies of wafer" : "Wafer");
        for (int i = 0; i < s->naccept; i++)
            if (n > 1 && s->naccept == 1)
                fw_text_add(out, s->accept[i].sites > 1 ? "<th>Sites</th>" : "<th></th>");
            else
                measure_head(&s->accept[i], 1, out);
        if (!shared) common_heads(s, n, out);
    }
    if (shared) common_heads(s, 1, out);
    fw_text_add(out, "</tr></thead>");
}

static void common_cells(int rows, fw_text *out) {
    for (int k = 0; k < 3; k++)
        fw_text_printf(out, "<td class=\"w\" rowspan=\"%d\"></td>", rows);
}

/* a line for each wafer, or for so many; what a load has in common is written once for it */
static void wafer_lines(const fw_process_step *s, int wafers, bool of_dies, fw_text *out) {
    const int load = fw_process_step_load(s), n = abreast(s, wafers, load);
    const bool shared = load > 1;
    fw_text_printf(out, "<table class=\"small wafers%s\">",
                   n * cells_of(s) >= WIDE_CELLS ? " narrow" : "");
    lines_head(s, n, shared, of_dies, out);
    fw_text_add(out, "<tbody>\n");
    for (int first = 0; first < wafers; first += shared ? load : n) {
        const int rest = wafers - first, group = shared ? load : n,
                  count = group < rest ? group : rest;
        for (int at = 0; at < count; at += n) {
            fw_text_add(out, "<tr>");
            for (int w = first + at; w < first + at + n; w++) {
                const bool is = w < first + count;
                fw_text_printf(out, is ? "<td>%d</td>" : "<td class=\"off\"></td>", w + 1);
                for (int i = 0; i < s->naccept; i++)
                    if (is)
                        sites(&s->accept[i], w, out);
                    else
                        fw_text_add(out, "<td class=\"off\"></td>");
                if (!shared && is) common_cells(1, out);
                if (!shared && !is) fw_text_add(out, "<td class=\"off\" colspan=\"3\"></td>");
            }
            if (shared && at == 0) common_cells((count + n - 1) / n, out);
            fw_text_add(out, "</tr>\n");
        }
    }
    fw_text_add(out, "</tbody></table>\n");
}

/* all_wafers: how many the step is done for at once; 0: not said */
static void one_line(const fw_process_step *s, bool of_dies, int all_wafers, fw_text *out) {
    char of[24] = "";
    if (all_wafers > 1 && !of_dies) snprintf(of, sizeof of, " (of %d)", all_wafers);
    fw_text_printf(out,
                   "<table class=\"actual\"><tr><td>Start</td><td>End</td><td>Tool</td><td>Bath or "
                   "bottle lot</td><td>%s</td><td>%s in, out%s</td><td>Scrapped, on hold</td>"
                   "<td>Deviation no.</td></tr></table>\n",
                   s->second_signature ? "Initials; <b>second signature</b>" : "Initials",
                   of_dies ? "Dies" : "Wafers", of);
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
    if (wafers == 1) one_line(s, of_dies, fw_recipe_wafers(header), out);
}

/* " of 6": how many the plan begins with, so that whoever counts sees at once what is missing; dies of all its wafers, where not
   only some of them are tested or packaged */
static void planned_count(const fw_process_flow *flow, int index, int wafers, fw_text *out) {
    const fw_process_step *s = &flow->step[index];
    const fw_quantity *dies = fw_process_flow_quantity(flow, "mask.dies");
    const bool some = s->bears || strcmp(s->op, "package") == 0;
    if (!fw_process_step_is_of_dies(flow, index))
        fw_text_printf(out, " of %d", wafers);
    else if (!some && dies && !dies->unknown && dies->value >= 1.0)
        fw_text_printf(out, " of %.0f", dies->value * (double)wafers);
}

/* " Fillings: aluminium etch, 6 for the 6 wafers of this lot", behind what a step is done with */
void fw_recipe_html_fillings(const fw_process_flow *flow, const fw_process_step *s,
                             const fw_recipe_header *header, fw_text *out) {
    const fw_process_bath *mixed = fw_process_step_mixes(flow, s);
    const int wafers = fw_recipe_wafers(header), *loads = NULL;
    if (fw_schedule_loads(out->arena, header->schedule, flow, &loads) != FW_OK) out->failed = 1;
    for (int k = -1; k < s->nuse; k++) {
        const fw_process_bath *b = k < 0 ? mixed : s->use[k].bath;
        const int n = b ? fw_process_bath_fillings(flow, b, wafers, loads) : 0;
        if (n < 2 || !b->serves) continue;
        fw_text_add(out, " <b>Fillings:</b> ");
        fw_text_escaped(out, b->name);
        fw_text_printf(out, ", %d for the %d wafer%s of this lot", n, wafers,
                       wafers > 1 ? "s" : "");
        if (!b->serves->unknown) fw_text_add(out, ", each of which serves ");
        if (!b->serves->unknown) fw_text_number(out, b->serves->value, 4);
        fw_text_add(out, b == mixed ? "; amounts and times here are of one." : ".");
    }
}

/* what to do where it went wrong and, of several wafers, what became of them, in one line */
void fw_recipe_html_outcome(const fw_process_flow *flow, int index, const fw_recipe_header *header,
                            fw_text *out) {
    const fw_process_step *s = &flow->step[index];
    const bool of_dies = fw_process_step_is_of_dies(flow, index);
    const bool counted = fw_recipe_wafers(header) > 1 && !fw_process_step_is_of_lot(s);
    if (s->non_fail == 0 && !counted) return;
    fw_text_add(out, "<div class=\"small outcome\"><div>");
    for (int i = 0; i < s->non_fail; i++) {
        const fw_process_on_fail *f = &s->on_fail[i];
        fw_text_add(out, i ? ". <b>If</b> " : "<b>If</b> ");
        fw_text_escaped(out, f->condition);
        fw_text_add(out, ": <b>");
        fw_text_escaped(out, f->then);
        if (f->go_to[0]) {
            fw_text_add(out, strcmp(f->go_to, s->id) == 0 ? ", repeat " : ", back to ");
            fw_text_escaped(out, f->go_to);
        }
        fw_text_add(out, "</b>; ");
        fw_text_escaped(out, f->text);
    }
    fw_text_add(out, s->non_fail ? ".</div>" : "</div>");
    if (counted) {
        fw_text_printf(out, "<div class=\"counts\">%s in _____", of_dies ? "Dies" : "Wafers");
        planned_count(flow, index, fw_recipe_wafers(header), out);
        fw_text_add(out, " out _____ scrapped _____ on hold _____ Deviation no. _____</div>");
    }
    fw_text_add(out, "</div>\n");
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
                "<h3>Hazards: read before the lot begins</h3>\n"
                "<p style=\"break-after:avoid\">Emergency number ____________ "
                "&ensp; Nearest shower, eye wash, first aid ____________</p>\n"
                "<table class=\"small\"><thead><tr><th></th><th style=\"width:26%\">Hazard, bench: "
                "steps</th><th>Wear and keep ready</th><th>First aid</th><th style=\"width:16%\">"
                "Waste</th></tr></thead><tbody>\n");
    for (int i = 0; i < met.n; i++)
        hazard(flow, met.of[i], i + 1, out);
    fw_text_add(out, "</tbody></table>\n");
}

/* ---- the lot ---- */

/* who has the wafers at the end has dies, chips, or wafers that somebody must still part */
static void closed(const fw_process_flow *flow, const fw_recipe_header *header, fw_text *out) {
    const int wafers = fw_recipe_wafers(header);
    fw_text_printf(out,
                   "</tbody></table>\n<p>Lot closed: wafers finished ______ of %d, scrapped ______"
                   "&ensp; by ____________ date ____________</p>\n",
                   wafers);
    if (!fw_process_step_is_of_dies(flow, flow->nstep))
        fw_text_printf(out, "<p>The flow ends with %s: no step of it parts %s into dies.</p>\n",
                       wafers > 1 ? "whole wafers" : "a whole wafer", wafers > 1 ? "them" : "it");
}

/* a line of what goes into the log: of a step with its first measure, and of what else may become of a wafer */
static void log_lines(const fw_process_flow *flow, const fw_recipe_header *header, fw_text *out) {
    const fw_process_step *s = &flow->step[0];
    const fw_process_accept *a = s->naccept ? &s->accept[0] : NULL;
    const bool asked = a && strcmp(a->unit, "yes/no") == 0;
    fw_text_printf(out,
                   "<p class=\"small\">This sheet goes into the log of the lot line by line, "
                   "flexwright log DEVICE.xml --flow %s --run LOT.log --wafers %d --entries "
                   "FILE:<br>%s; wafer=1; start=2026-11-20T08:00; end=2026-11-20T08:20; by=AB",
                   flow->id, fw_recipe_wafers(header), s->id);
    if (a) {
        fw_text_add(out, "; ");
        fw_text_escaped(out, a->measure);
        fw_text_printf(out, "=%s", asked ? "yes" : "__");
    }
    fw_text_printf(
        out,
        "; set NAME=ACTUAL; deviation=1, what was done otherwise and why<br>%s; wafer=2; "
        "start=2026-11-20T08:20; by=AB; scrapped=WHY (or held=WHY, later resumed=WHY)"
        "<br>Names as they are printed here, times of the laboratory; wafer=1-4 is an "
        "entry of each of a load; second=CD where two sign. Nothing goes in where a line "
        "is wrong, and each mistake is named with its line.</p>\n",
        s->id);
}

void fw_recipe_html_deviations(const fw_process_flow *flow, const fw_recipe_header *header,
                               fw_text *out) {
    fw_text_add(out,
                "<h3>Deviations, and what became of the lot</h3>\n<table class=\"small blank\">"
                "<thead><tr><th style=\"width:6%\">No.</th><th style=\"width:10%\">Step</th>"
                "<th style=\"width:12%\">Wafers</th><th>What was done otherwise, and why</th>"
                "<th style=\"width:20%\">Decided by, date</th></tr></thead><tbody>\n");
    for (int i = 1; i <= 6; i++)
        fw_text_printf(out, "<tr><td>%d</td><td></td><td></td><td></td><td></td></tr>\n", i);
    closed(flow, header, out);
    log_lines(flow, header, out);
}

/* ---- of the first page: what is bought, and where on it things lie ---- */

/* "M01 at (-43.35, 0) mm, M26 at (43.35, 0) mm": middles of these places from the wafer's middle */
static void places(const fw_wafer *w, fw_wafer_kind kind, bool placed, fw_text *out) {
    enum { MOST = 8 };
    int said = 0, left = 0;
    for (int i = 0; i < w->grid.nsite; i++) {
        const fw_wafer_site *s = &w->grid.site[i];
        char name[2 * FW_WAFER_NAME];
        if (s->kind != kind) continue;
        if (said == MOST) {
            left++;
            continue;
        }
        fw_text_printf(out, "%s%s", said++ ? ", " : "", fw_wafer_site_name(w, s, name));
        if (!placed) continue;
        fw_text_add(out, " at (");
        fw_text_number(out, floor(1e-3 * (s->x + 0.5 * w->grid.width) + 0.5) * 1e-3, 6);
        fw_text_add(out, ", ");
        fw_text_number(out, floor(1e-3 * (s->y + 0.5 * w->grid.height) + 0.5) * 1e-3, 6);
        fw_text_add(out, ") mm");
    }
    if (left > 0) fw_text_printf(out, " and %d more", left);
}

/* "3.468 mm apart in x, the middle of a lane at x = 0" */
static void apart(fw_text *out, const char *axis, int32_t pitch, bool street) {
    fw_text_number(out, pitch * 1e-6, 9);
    fw_text_printf(out, " mm apart in %s, the middle of a lane at %s = ", axis, axis);
    fw_text_number(out, street ? 0 : 0.5e-6 * pitch, 9);
    fw_text_add(out, street ? "" : " mm");
}

/* What saw, aligner and inspection ask of the wafer: where places, lanes and alignment sites lie. */
static void wafer_rows(const fw_process_flow *flow, const fw_recipe_header *h, fw_text *out) {
    static const char *const side[] = {[FW_SIDE_BOTTOM] = "bottom",
                                       [FW_SIDE_LEFT] = "left",
                                       [FW_SIDE_RIGHT] = "right",
                                       [FW_SIDE_TOP] = "top"};
    const fw_wafer *w = h->wafer;
    if (!w) return;
    fw_text_add(out, "<tr><td class=\"k\">Wafer, seen from the front</td><td colspan=\"3\">");
    fw_text_number(out, w->form.diameter_m * 1e3, 6);
    fw_text_printf(out, " mm, %s at the %s; %d devices, ", w->form.flat_m > 0 ? "flat" : "notch",
                   side[w->form.side], w->dies);
    apart(out, "x", w->grid.pitch_x, w->grid.street_x);
    fw_text_add(out, " of the wafer's middle; ");
    apart(out, "y", w->grid.pitch_y, w->grid.street_y);
    fw_text_add(out, "; map: masks/");
    fw_text_escaped(out, flow->id);
    fw_text_add(out, "-wafer-map.svg, list: -wafer.csv beside it</td></tr>\n");
    if (w->alignments == 0) return;
    fw_text_add(out, "<tr><td class=\"k\">Alignment sites</td><td colspan=\"3\">");
    places(w, FW_WAFER_ALIGNMENT, true, out);
    fw_text_add(out, " from the wafer's middle</td></tr>\n");
}

/* which way the crystal has to lie on the wafer that is bought */
static void crystal_row(const fw_recipe_header *h, fw_text *out) {
    const fw_mechanism_variant *v = h->verdict ? h->verdict->variant : NULL;
    if (!v || !fw_device_material_is_crystal(&v->material)) return;
    fw_text_add(out,
                "<tr><td class=\"k\">Crystal of the device layer</td><td colspan=\"3\">[100] at ");
    fw_text_number(out, v->orientation_rad * 180 / FW_PI, 6);
    fw_text_add(out, "° from the drawing's x");
    if (h->wafer && fabs(remainder(v->orientation_rad - 0.25 * FW_PI, 0.5 * FW_PI)) < 1e-6)
        fw_text_add(out, ": a (100) wafer whose flat or notch is that of &lt;110&gt;");
    else if (h->wafer)
        fw_text_add(
            out, ": <b>not</b> that of a usual wafer, whose flat or notch is that of &lt;110&gt;");
    fw_text_add(out, "</td></tr>\n");
}

/* Where the coupons are that steps read. */
static void test_die(const fw_process_flow *flow, const fw_recipe_header *h, fw_text *out) {
    if (!h->test_die) return;
    fw_text_add(out, "<tr><td class=\"k\">Test die, with the coupons</td><td colspan=\"3\">");
    if (h->wafer && h->wafer->tests > 0) {
        fw_text_printf(out, "on these plates, %d %s: ", h->wafer->tests,
                       h->wafer->tests == 1 ? "place of the map" : "places of the map");
        places(h->wafer, FW_WAFER_TEST, false, out);
    } else {
        fw_text_add(out, "<b>not on these plates</b>: place masks/");
        fw_text_escaped(out, flow->id);
        fw_text_add(out, "-coupons.gds beside the device, or state test-dies of a &lt;wafer&gt;; "
                         "without it leave lines of coupons open");
    }
    fw_text_add(out, "; what each coupon is for: ");
    fw_text_escaped(out, flow->id);
    fw_text_add(out, "-coupons.json");
    if (h->test_die_lacks) {
        fw_text_add(out, "; <b>it has no room for</b> ");
        fw_text_escaped(out, h->test_die_lacks);
        fw_text_add(out, ": lines of these stay open, or a larger die is written");
    }
    fw_text_add(out, "</td></tr>\n");
}

void fw_recipe_wafer_rows(const fw_process_flow *flow, const fw_recipe_header *h, fw_text *out) {
    wafer_rows(flow, h, out);
    crystal_row(h, out);
    test_die(flow, h, out);
}

/* ---- what became of the wafers of a log, and what was written down ---- */

static void put_cell_text(fw_text *out, const char *text) {
    fw_text_add(out, "<td>");
    fw_text_escaped(out, text ? text : "");
    fw_text_add(out, "</td>");
}

/* what became of wafers, and how many there still are */
void fw_recipe_asrun_fates_html(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                fw_text *out) {
    int n = 0;
    for (int i = 0; i < run->nentry; i++) {
        const fw_recipe_asrun_entry *e = &run->entry[i];
        if (e->fate == FW_FATE_RUN) continue;
        if (n++ == 0)
            fw_text_printf(
                out,
                "<h2>Wafers</h2>\n<p>%d in, %d out, %d held, %d scrapped.</p>\n<table><thead>"
                "<tr><th>Wafer</th><th>What became of it</th><th>At</th><th>When</th><th>Why</th>"
                "<th>Who; note</th></tr></thead><tbody>\n",
                run->nwafer, fw_recipe_asrun_count(flow, run, flow->nstep, FW_FATE_RUN),
                fw_recipe_asrun_count(flow, run, flow->nstep, FW_FATE_HELD),
                fw_recipe_asrun_count(flow, run, flow->nstep, FW_FATE_SCRAPPED));
        fw_text_add(out, "<tr>");
        put_cell_text(out, e->wafer);
        put_cell_text(out, fw_recipe_fate_word(e->fate));
        fw_text_printf(out, "<td>%s ", e->at->id);
        fw_text_escaped(out, e->at->title);
        fw_text_add(out, "</td>");
        put_cell_text(out, e->start);
        put_cell_text(out, e->why);
        fw_text_add(out, "<td>");
        fw_text_escaped(out, e->by);
        if (e->note) fw_text_add(out, "; ");
        fw_text_escaped(out, e->note ? e->note : "");
        fw_text_add(out, "</td></tr>\n");
    }
    if (n) fw_text_add(out, "</tbody></table>\n");
}

void fw_recipe_asrun_declared_html(const fw_recipe_asrun *run, fw_text *out) {
    int n = 0;
    for (int i = 0; i < run->nentry; i++) {
        const fw_recipe_asrun_entry *e = &run->entry[i];
        if (!e->deviation) continue;
        if (n++ == 0)
            fw_text_add(out, "<h3>Written down</h3>\n<table><thead><tr><th>Step</th><th>Wafer</th>"
                             "<th>When</th><th>What was done otherwise, and why</th><th>Who</th>"
                             "</tr></thead><tbody>\n");
        const char *cell[] = {e->at->id, e->wafer ? e->wafer : "lot", e->start, e->deviation,
                              e->by};
        fw_text_add(out, "<tr>");
        for (size_t k = 0; k < sizeof cell / sizeof cell[0]; k++) {
            fw_text_add(out, "<td>");
            fw_text_escaped(out, cell[k]);
            fw_text_add(out, "</td>");
        }
        fw_text_add(out, "</tr>\n");
    }
    if (n) fw_text_add(out, "</tbody></table>\n");
}

/* ---- what somebody wrote down as a deviation, of every entry, in the order of the log ---- */

void fw_recipe_asrun_put_declared(const fw_recipe_asrun *run, fw_text *out) {
    int n = 0;
    for (int i = 0; i < run->nentry; i++) {
        const fw_recipe_asrun_entry *e = &run->entry[i];
        if (!e->deviation) continue;
        fw_text_printf(out, "%s%s, %s%s, by %s: %s\n", n++ ? "" : "\ndeviations written down:\n",
                       e->at->id, e->wafer ? "wafer " : "lot", e->wafer ? e->wafer : "", e->by,
                       e->deviation);
    }
}
