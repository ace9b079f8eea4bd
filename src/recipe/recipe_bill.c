/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the lot uses up, as a page of the run sheet and as JSON: baths and how they are mixed, consumables, costs. */
#include "base/json.h"
#include "process/process.h"
#include "recipe/recipe_words.h"
#include <math.h>

/* ---- page ---- */

static void amount(const fw_process_consumable *c, double si, fw_text *out) {
    if (isnan(si)) {
        fw_text_add(out, "______");
        fw_text_add(out, c->amount == FW_AMOUNT_L ? " mL" : c->amount == FW_AMOUNT_kg ? " g" : "");
        return;
    }
    switch (c->amount) {
    case FW_AMOUNT_L:
        fw_text_number(out, si < 1e-3 ? si * 1e6 : si * 1e3, 3);
        fw_text_add(out, si < 1e-3 ? " mL" : " L");
        return;
    case FW_AMOUNT_kg:
        fw_text_number(out, si < 1.0 ? si * 1e3 : si, 3);
        fw_text_add(out, si < 1.0 ? " g" : " kg");
        return;
    case FW_AMOUNT_PIECE:
        fw_text_number(out, si, 6);
        return;
    }
}

static void missing(const char *what, fw_text *out) {
    if (!what[0]) return;
    fw_text_add(out, " <span class=\"muted\">needs ");
    fw_text_escaped(out, what);
    fw_text_add(out, "</span>");
}

/* an amount, or its parts where only the volume of the filling is not known */
static void part(const fw_process_part *p, bool alone, double si, fw_text *out) {
    if (isnan(si) && p->of->amount == FW_AMOUNT_L && !p->q->unknown && !alone) {
        fw_text_number(out, p->q->value, 4);
        fw_text_add(out, p->q->value == 1.0 ? " part" : " parts");
    } else
        amount(p->of, si, out);
    fw_text_add(out, " ");
    fw_text_escaped(out, p->of->name);
}

static void bath_row(const fw_process_bill_bath *b, fw_text *out) {
    fw_text_add(out, "<tr><td><b>");
    fw_text_escaped(out, b->bath->name);
    fw_text_add(out, "</b><br>");
    fw_text_escaped(out, b->steps);
    fw_text_add(out, "</td><td>");
    for (int i = 0; i < b->bath->npart; i++) {
        fw_text_add(out, i ? ", " : "");
        part(&b->bath->part[i], b->bath->npart == 1, b->part_amount[i], out);
    }
    fw_text_add(out, ". ");
    fw_text_escaped(out, b->bath->text);
    missing(b->missing, out);
    fw_text_add(out, "</td><td class=\"n\">");
    if (b->fillings > 0)
        fw_text_printf(out, "%d", b->fillings);
    else
        fw_text_add(out, "____");
    fw_text_add(out, "</td><td></td></tr>\n");
}

static void money(double value, fw_text *out) {
    if (isnan(value))
        fw_text_add(out, "not known");
    else
        fw_text_fixed(out, value, 2);
}

/* half a line: the table holds two beside each other */
static void consumable_cells(const fw_process_bill_row *r, bool priced, fw_text *out) {
    fw_text_add(out, "<td>");
    fw_text_escaped(out, r->consumable->name);
    fw_text_add(out, " <span class=\"muted\">");
    fw_text_escaped(out, r->steps);
    fw_text_add(out, "</span></td><td class=\"n\">");
    amount(r->consumable, r->amount, out);
    if (priced) {
        fw_text_add(out, "</td><td class=\"n\">");
        money(r->cost, out);
    }
    fw_text_add(out, "</td><td></td>");
}

static void consumables(const fw_process_bill *b, fw_text *out) {
    bool priced = b->currency != NULL;
    fw_text_add(out, "<table class=\"small\"><thead><tr>");
    for (int i = 0; i < 2; i++) {
        fw_text_add(out, "<th style=\"width:24%\">Consumable, steps</th><th class=\"n\">For the "
                         "lot</th>");
        if (priced) fw_text_printf(out, "<th class=\"n\">%s</th>", b->currency);
        fw_text_add(out, "<th>Bottle or lot no., opened</th>");
    }
    fw_text_add(out, "</tr></thead><tbody>\n");
    int half = (b->nrow + 1) / 2;
    for (int i = 0; i < half; i++) {
        fw_text_add(out, "<tr>");
        consumable_cells(&b->row[i], priced, out);
        if (half + i < b->nrow)
            consumable_cells(&b->row[half + i], priced, out);
        else
            fw_text_add(out, priced ? "<td></td><td></td><td></td><td></td>"
                                    : "<td></td><td></td><td></td>");
        fw_text_add(out, "</tr>\n");
    }
    fw_text_add(out, "</tbody></table>\n");
}

static void costs(const fw_process_bill *b, fw_text *out) {
    if (!b->currency) return;
    fw_text_add(out, "<p><b>Cost of the lot, as far as it is known: ");
    fw_text_fixed(out, b->consumables_cost + b->machines_cost, 2);
    fw_text_printf(out, " %s</b>, of it consumables ", b->currency);
    fw_text_fixed(out, b->consumables_cost, 2);
    fw_text_add(out, " and machine time ");
    fw_text_fixed(out, b->machines_cost, 2);
    fw_text_printf(out,
                   ". Without an amount or a price: %d of %d consumables; without a time or a "
                   "price: %d of %d machines. Not in it: wafers, masks and people.</p>\n",
                   b->rows_without, b->nrow, b->machines_without, b->nmachine);
}

fw_status fw_recipe_html_bill(const fw_process_flow *flow, const fw_recipe_header *header,
                              fw_text *out) {
    fw_process_bill b;
    FW_TRY(fw_process_flow_bill(out->arena, flow, fw_recipe_wafers(header), &b));
    if (b.nrow == 0) return FW_OK;
    fw_text_printf(out, "<h3>Baths and consumables of this lot, %d wafer%s</h3>\n", b.wafers,
                   b.wafers == 1 ? "" : "s");
    if (b.nbath > 0)
        fw_text_add(out, "<table class=\"small\"><thead><tr><th style=\"width:20%\">Bath, steps"
                         "</th><th>One filling</th><th class=\"n\">Fillings</th><th "
                         "style=\"width:24%\">Mixed by, date, time</th></tr></thead><tbody>\n");
    for (int i = 0; i < b.nbath; i++)
        bath_row(&b.bath[i], out);
    fw_text_add(out, b.nbath > 0 ? "</tbody></table>\n" : "");
    consumables(&b, out);
    costs(&b, out);
    return FW_OK;
}

/* ---- JSON ---- */

static void number(fw_json *out, const char *key, double value) { /* NaN: null */
    fw_json_number(out, key, value, FW_PLAIN_DIGITS);
}

/* "amount_m3", "amount_kg" or "amount": by what the consumable is counted in */
static void si_amount(fw_json *out, const fw_process_consumable *c, double value) {
    static const char *const key[] = {
        [FW_AMOUNT_L] = "amount_m3", [FW_AMOUNT_kg] = "amount_kg", [FW_AMOUNT_PIECE] = "amount"};
    number(out, key[c->amount], value);
}

static void json_bath(fw_json *out, const fw_process_bill_bath *b) {
    fw_json_object(out, NULL);
    fw_json_text(out, "id", b->bath->id);
    fw_json_text(out, "name", b->bath->name);
    fw_json_text(out, "steps", b->steps);
    number(out, "fillings", b->fillings > 0 ? b->fillings : (double)NAN);
    fw_json_list(out, "filling");
    for (int i = 0; i < b->bath->npart; i++) {
        fw_json_object(out, NULL);
        fw_json_text(out, "id", b->bath->part[i].of->id);
        si_amount(out, b->bath->part[i].of, b->part_amount[i]);
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_text(out, "missing", b->missing);
    fw_json_end(out);
}

fw_status fw_recipe_json_bill(const fw_process_flow *flow, const fw_recipe_header *header,
                              fw_json *out) {
    fw_process_bill b;
    FW_TRY(fw_process_flow_bill(out->out->arena, flow, fw_recipe_wafers(header), &b));
    fw_json_object(out, "bill");
    fw_json_number(out, "wafers", b.wafers, FW_PLAIN_DIGITS);
    fw_json_list(out, "baths");
    for (int i = 0; i < b.nbath; i++)
        json_bath(out, &b.bath[i]);
    fw_json_end(out);
    fw_json_list(out, "consumables");
    for (int i = 0; i < b.nrow; i++) {
        const fw_process_bill_row *r = &b.row[i];
        fw_json_object(out, NULL);
        fw_json_text(out, "id", r->consumable->id);
        fw_json_text(out, "name", r->consumable->name);
        fw_json_text(out, "steps", r->steps);
        si_amount(out, r->consumable, r->amount);
        number(out, "cost", r->cost);
        fw_json_text(out, "missing", r->missing);
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_list(out, "machines");
    for (int i = 0; i < b.nmachine; i++) {
        fw_json_object(out, NULL);
        fw_json_text(out, "id", b.machine[i].equipment->id);
        fw_json_text(out, "steps", b.machine[i].steps);
        number(out, "booked_s", b.machine[i].booked_s);
        number(out, "cost", b.machine[i].cost);
        fw_json_end(out);
    }
    fw_json_end(out);
    if (b.currency)
        fw_json_text(out, "currency", b.currency);
    else
        fw_json_null(out, "currency");
    number(out, "consumables_cost", b.currency ? b.consumables_cost : (double)NAN);
    number(out, "machines_cost", b.currency ? b.machines_cost : (double)NAN);
    fw_json_end(out);
    return FW_OK;
}
