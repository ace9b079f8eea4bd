/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is listed of a recipe: for other programs tables of the flow and of the schedule, and the schedule as a calendar;
   what the lot uses up, as a page of the run sheet and as JSON: baths and how they are mixed, consumables, costs. */
#include "base/json.h"
#include "recipe/recipe.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- tables (CSV, RFC 4180) ---- */

static void head(fw_text *out, const fw_process_step *s, const char *name) {
    fw_text_csv(out, s->id);
    fw_text_add(out, ",");
    fw_text_csv(out, s->title);
    fw_text_add(out, ",");
    fw_text_csv(out, name);
    fw_text_add(out, ",");
}

static void quantity_row(fw_text *out, const fw_process_step *s, const fw_recipe_row *row) {
    const fw_quantity *q = row->q;
    head(out, s, row->name);
    fw_recipe_put_known(out, q);
    fw_text_add(out, ",");
    fw_text_csv(out, q->unit);
    fw_text_add(out, ",");
    if (!q->unknown && !q->word) fw_recipe_put_uncertainty(out, fw_recipe_row_uncertainty(q));
    fw_text_add(out, ",");
    fw_text_csv(out, q->unknown ? "unknown" : fw_quantity_value_status_text(q->status));
    fw_text_add(out, ",");
    fw_text_csv(out, q->unknown && q->note ? q->note : q->source ? q->source : "");
    fw_text_add(out, "\n");
}

static fw_status time_rows(fw_text *out, const fw_process_step *s) {
    const fw_process_time *t = &s->time;
    const struct {
        const char *name;
        double value_s, u_s;
    } rows[] = {{"time, nominal", t->nominal_s, t->nominal_s * t->relative_uncertainty},
                {"time, first look", t->first_look_s, 0.0},
                {"time, clear by", t->clear_by_s, 0.0},
                {"time, stop", t->stop_s, 0.0}};
    if (!t->computable) {
        const char *missing = fw_recipe_missing_list(out->arena, t);
        FW_NEED(missing);
        const char *text = fw_arena_printf(out->arena, "missing: %s", missing);
        FW_NEED(text);
        head(out, s, "time, nominal");
        fw_text_add(out, ",s,,NOT COMPUTABLE,");
        fw_text_csv(out, text);
        fw_text_add(out, "\n");
        return FW_OK;
    }
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        head(out, s, rows[i].name);
        fw_recipe_put_plain(out, rows[i].value_s);
        fw_text_add(out, ",s,");
        if (i == 0) fw_recipe_put_uncertainty(out, rows[i].u_s);
        fw_text_printf(out, ",%s,computed: law %s\n", fw_quantity_value_status_text(t->status),
                       s->law);
    }
    return FW_OK;
}

static fw_status finish_rows(fw_text *out, const fw_process_step *s) {
    for (int i = 0; i < s->nfinish; i++) {
        const fw_process_finish *f = &s->finish[i];
        const char *words = fw_recipe_finish_words(out->arena, f);
        FW_NEED(words);
        const char *name = fw_arena_printf(out->arena, "before it leaves the bench: %s", words);
        FW_NEED(name);
        head(out, s, name);
        bool known = f->time && !f->time->unknown;
        if (known) fw_recipe_put_plain(out, f->time->value);
        fw_text_add(out, ",s,");
        if (known) fw_recipe_put_uncertainty(out, f->time->uncertainty);
        fw_text_printf(out, ",%s,", known ? fw_quantity_value_status_text(f->time->status) : "");
        fw_text_csv(out, f->time && f->time->source ? f->time->source
                         : f->time                  ? ""
                                                    : "within the time of the step");
        fw_text_add(out, "\n");
    }
    return FW_OK;
}

fw_status fw_recipe_write_csv(const fw_process_flow *flow, const fw_recipe_header *header,
                              fw_text *out) {
    fw_text_add(out, "step,title,name,value,unit,uncertainty,status,source\n");
    if (header->rejected)
        fw_text_add(out, ",REJECTED,the verdict rejects this design: do not fabricate,,,,,\n");
    for (int i = 0; header->rejected && i < header->nbecause; i++) {
        fw_text_add(out, ",REJECTED,");
        fw_text_csv(out, header->because[i]);
        fw_text_add(out, ",,,,,\n");
    }
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        fw_recipe_row *row = NULL;
        int n = 0;
        FW_TRY(fw_recipe_step_rows(out->arena, s, &row, &n));
        for (int j = 0; j < n; j++)
            quantity_row(out, s, &row[j]);
        FW_TRY(time_rows(out, s));
        FW_TRY(finish_rows(out, s));
    }
    return fw_text_end(out);
}

static void moment(fw_text *out, const fw_schedule *s, double seconds) {
    fw_recipe_put_moment(out, &s->shop->calendar, seconds);
    fw_text_add(out, "\",");
}

fw_status fw_recipe_write_schedule_csv(const fw_process_flow *flow, const fw_recipe_header *header,
                                       fw_text *out) {
    const fw_schedule *s = header->schedule;
    (void)flow;
    fw_text_add(out, "step,title,wafers,equipment,operator,start,end,attended_from,attended_until,"
                     "start_s,end_s,attended_s,waits_for,time\n");
    if (header->rejected)
        fw_text_add(out,
                    ",REJECTED: the verdict rejects this design: do not fabricate,,,,,,,,,,,,\n");
    for (int i = 0; s && i < s->nrun; i++) {
        const fw_schedule_run *r = &s->run[i];
        const fw_schedule_task *t = &s->shop->task[r->task];
        fw_text_csv(out, t->id);
        fw_text_add(out, ",");
        fw_text_csv(out, t->title);
        fw_text_add(out, ",");
        fw_recipe_put_wafers(out, r);
        fw_text_add(out, ",");
        fw_text_csv(out, s->shop->machine[t->machine].title);
        fw_text_add(out, ",");
        if (r->operator_ >= 0) fw_text_printf(out, "%d", r->operator_ + 1);
        fw_text_add(out, ",\"");
        moment(out, s, r->start_s);
        fw_text_add(out, "\"");
        moment(out, s, r->end_s);
        const double from = r->start_s + fw_schedule_task_attended_from_s(t);
        if (r->operator_ >= 0) {
            fw_text_add(out, "\"");
            moment(out, s, from);
            fw_text_add(out, "\"");
            moment(out, s, from + t->attended_s);
        } else
            fw_text_add(out, ",,");
        fw_recipe_put_plain(out, r->start_s);
        fw_text_add(out, ",");
        fw_recipe_put_plain(out, r->end_s);
        fw_text_add(out, ",");
        fw_recipe_put_plain(out, t->attended_s);
        fw_text_printf(out, ",%s,%s\n", fw_schedule_wait_text(r->waits_for),
                       t->unknown  ? "unknown"
                       : t->stated ? "planned by the user"
                                   : "computed");
    }
    return fw_text_end(out);
}

/* ---- the calendar (iCalendar, RFC 5545) ----
   Without a first day (--day "... from DATE") times start at a fixed Monday, so that the same plan gives the same bytes:
   the calendar program moves it to the real day. */

static const char stamp[] = "20250101T000000Z";

static long midnight(const fw_schedule *plan) {
    const long monday = 20094L; /* 2025-01-06 */
    return 86400L * (plan && plan->shop->calendar.dated ? plan->shop->calendar.first_day : monday);
}

/* CRLF, and a break with one space before the 75th byte; never inside a UTF-8 character */
static void put_line(fw_text *out, const char *text) {
    size_t n = strlen(text), at = 0, most = 74;
    while (n - at > most) {
        size_t cut = at + most;
        while (cut > at && ((unsigned char)text[cut] & 0xC0) == 0x80)
            cut--;
        fw_text_bytes(out, text + at, cut - at);
        fw_text_add(out, "\r\n ");
        at = cut;
        most = 73;
    }
    fw_text_bytes(out, text + at, n - at);
    fw_text_add(out, "\r\n");
}

/* 3.3.11: backslash, semicolon and comma are escaped; control characters become spaces */
static void escaped(fw_text *out, const char *text) {
    for (const char *c = text; *c; c++) {
        if (strchr("\\;,", *c))
            fw_text_printf(out, "\\%c", *c);
        else
            fw_text_bytes(out, (unsigned char)*c < 0x20 ? " " : c, 1);
    }
}

/* a time of the laboratory's own clock, of no zone (RFC 5545, 3.3.5, form 1); of a stated zone its callers add (forms 2
   and 3) */
static void put_date(fw_text *out, long seconds) {
    long day = seconds / 86400, rest = seconds % 86400, civil[3];
    if (rest < 0) rest += 86400, day--; /* before 1970 */
    fw_quantity_civil(day, civil);
    fw_text_printf(out, "%04ld%02ld%02ldT%02ld%02ld%02ld", civil[0], civil[1], civil[2],
                   rest / 3600, rest / 60 % 60, rest % 60);
}

static fw_status property(fw_text *out, const char *name, const char *value, bool escape) {
    fw_text text = fw_text_new(out->arena);
    fw_text_printf(&text, "%s:", name);
    if (escape)
        escaped(&text, value);
    else
        fw_text_add(&text, value);
    FW_TRY(fw_text_end(&text));
    put_line(out, text.data);
    return FW_OK;
}

/* "UTC+0100", as a zone of the calendar is called; NULL: the plan states none, it is UTC itself, or its clocks are changed,
   so that times are written as those of UTC */
static const char *zone_name(fw_arena *arena, const fw_schedule_calendar *c) {
    int ahead = c && c->zoned && !c->changes ? c->zone_min : 0, size = abs(ahead);
    return ahead ? fw_arena_printf(arena, "UTC%c%02d%02d", ahead < 0 ? '-' : '+', size / 60,
                                   size % 60)
                 : NULL;
}

/* a zone that keeps its distance from UTC: whoever states one, states that of the days of the lot */
static fw_status zone(fw_text *out, const char *name) {
    const char *ahead = name + 3;
    FW_TRY(property(out, "BEGIN", "VTIMEZONE", false));
    FW_TRY(property(out, "TZID", name, false));
    FW_TRY(property(out, "BEGIN", "STANDARD", false));
    FW_TRY(property(out, "DTSTART", "19700101T000000", false));
    FW_TRY(property(out, "TZOFFSETFROM", ahead, false));
    FW_TRY(property(out, "TZOFFSETTO", ahead, false));
    FW_TRY(property(out, "END", "STANDARD", false));
    return property(out, "END", "VTIMEZONE", false);
}

static fw_status date_property(fw_text *out, const fw_schedule *plan, const char *name,
                               long seconds) {
    const fw_schedule_calendar *c = plan ? &plan->shop->calendar : NULL;
    const char *of = zone_name(out->arena, c);
    fw_text text = fw_text_new(out->arena);
    put_date(&text, c && c->changes ? seconds - 60L * c->zone_min : seconds);
    if (c && c->zoned && !of) fw_text_add(&text, "Z");
    FW_TRY(fw_text_end(&text));
    if (of) FW_NEED(name = fw_arena_printf(out->arena, "%s;TZID=%s", name, of));
    return property(out, name, text.data, false);
}

static fw_status description(fw_text *out, const fw_process_step *s) {
    fw_text text = fw_text_new(out->arena);
    fw_text_printf(&text, "%s Equipment: %s. ", s->purpose,
                   s->equipment ? s->equipment->class_ : "");
    if (s->time.computable) {
        fw_text_add(&text, "First look ");
        fw_schedule_put_duration(&text, s->time.first_look_s);
        fw_text_add(&text, ", clear by ");
        fw_schedule_put_duration(&text, s->time.clear_by_s);
        fw_text_add(&text, ", stop ");
        fw_schedule_put_duration(&text, s->time.stop_s);
        fw_text_add(&text, ".");
    } else {
        const char *missing = fw_recipe_missing_list(out->arena, &s->time);
        FW_NEED(missing);
        fw_text_printf(&text, "Time NOT COMPUTABLE, missing: %s.", missing);
    }
    FW_TRY(fw_text_end(&text));
    return property(out, "DESCRIPTION", text.data, true);
}

typedef struct load { /* which wafers, and who: where there are several */
    const fw_schedule_run *run;
    bool wafers, people;
} load;

/* ", wafers 1-6, operator 2" */
static const char *of_load(fw_arena *arena, const load *l, bool event) {
    fw_text text = fw_text_new(arena);
    fw_text_add(&text, "");
    if (l && l->wafers) {
        fw_text_add(&text, l->run->count > 1 ? ", wafers " : ", wafer ");
        fw_recipe_put_wafers(&text, l->run);
    }
    if (l && l->people && event) fw_text_printf(&text, ", operator %d", l->run->operator_ + 1);
    return fw_text_end(&text) == FW_OK ? text.data : NULL;
}

static fw_status entry(fw_text *out, const fw_process_flow *flow, const fw_recipe_header *header,
                       const fw_process_step *s, const load *l, bool event, long start, long end) {
    fw_arena *arena = out->arena;
    const char *which = of_load(arena, l, event);
    const char *wafer = l && l->wafers ? fw_arena_printf(arena, "-%d", l->run->first + 1) : "";
    FW_NEED(which ? wafer : NULL);
    const char *kind = event ? "VEVENT" : "VTODO";
    const char *uid = fw_arena_printf(arena, "%s%s-%s-%.16s-%.16s@flexwright.invalid", s->id, wafer,
                                      event ? "attended" : "step", flow->sha256,
                                      header->mask_sha256 ? header->mask_sha256 : "");
    const char *summary =
        fw_arena_printf(arena, "%s%s %s%s%s", header->rejected ? "REJECTED: " : "", s->id, s->title,
                        which, event ? " (attended)" : "");
    FW_NEED(uid && summary);
    FW_TRY(property(out, "BEGIN", kind, false));
    FW_TRY(property(out, "UID", uid, false));
    FW_TRY(property(out, "DTSTAMP", stamp, false));
    FW_TRY(date_property(out, header->schedule, "DTSTART", start));
    if (end > start) FW_TRY(date_property(out, header->schedule, event ? "DTEND" : "DUE", end));
    FW_TRY(property(out, "SUMMARY", summary, true));
    FW_TRY(description(out, s));
    if (s->equipment) FW_TRY(property(out, "LOCATION", s->equipment->class_, true));
    return property(out, "END", kind, false);
}

/* every load of the schedule, and somebody's time for it */
static fw_status scheduled(fw_text *out, const fw_process_flow *flow,
                           const fw_recipe_header *header) {
    const fw_schedule *plan = header->schedule;
    for (int i = 0; i < plan->nrun; i++) {
        const fw_schedule_run *r = &plan->run[i];
        const fw_process_step *s = &flow->step[r->task];
        long start = midnight(plan) + lround(r->start_s),
             end = midnight(plan) + lround(ceil(r->end_s));
        load l = {r, plan->shop->wafers > 1, plan->shop->operators > 1};
        FW_TRY(entry(out, flow, header, s, &l, false, start, end));
        if (r->operator_ < 0) continue;
        const fw_schedule_task *t = &plan->shop->task[r->task];
        const double from = r->start_s + fw_schedule_task_attended_from_s(t);
        const long begin = t->at_end ? midnight(plan) + lround(from) : start;
        FW_TRY(entry(out, flow, header, s, &l, true, begin, begin + lround(ceil(t->attended_s))));
    }
    return FW_OK;
}

/* one wafer, one step after the other */
static fw_status in_a_row(fw_text *out, const fw_process_flow *flow,
                          const fw_recipe_header *header) {
    const fw_schedule *plan = header->schedule;
    const fw_schedule_calendar *c = plan ? &plan->shop->calendar : &fw_schedule_round_the_clock;
    long at = midnight(plan) +
              lround(fw_schedule_calendar_elapsed(c, c->first_s > 0.0 ? c->first_s : 8.0 * 3600.0));
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        double run = fmin(s->booked_s, 1e8);
        long lasts = lround(ceil(run)), attended = lround(fmin(s->attended_s, 1e8));
        long end = at + (lasts > attended ? lasts : attended);
        FW_TRY(entry(out, flow, header, s, NULL, false, at, end));
        const long from = fw_process_step_is_ended(s) ? end - attended : at;
        if (attended > 0) FW_TRY(entry(out, flow, header, s, NULL, true, from, from + attended));
        at = end;
    }
    return FW_OK;
}

fw_status fw_recipe_write_ics(const fw_process_flow *flow, const fw_recipe_header *header,
                              fw_text *out) {
    const char *name = fw_arena_printf(out->arena, "%s%s: %s", header->rejected ? "REJECTED " : "",
                                       flow->title, header->device ? header->device : "");
    FW_NEED(name);
    FW_TRY(property(out, "BEGIN", "VCALENDAR", false));
    FW_TRY(property(out, "VERSION", "2.0", false));
    FW_TRY(property(out, "PRODID", "-//Flexwright//Run sheet//EN", false));
    FW_TRY(property(out, "X-WR-CALNAME", name, true));
    const char *of =
        zone_name(out->arena, header->schedule ? &header->schedule->shop->calendar : NULL);
    if (of) FW_TRY(zone(out, of));
    bool planned = header->schedule && header->schedule->feasible;
    FW_TRY(planned ? scheduled(out, flow, header) : in_a_row(out, flow, header));
    FW_TRY(property(out, "END", "VCALENDAR", false));
    return fw_text_end(out);
}

/* ---- what the lot uses up, as a page ---- */

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

/* of this lot, in the loads of its schedule where it has one */
static fw_status bill_of(fw_arena *arena, const fw_process_flow *flow,
                         const fw_recipe_header *header, fw_process_bill *b) {
    const int *loads;
    FW_TRY(fw_schedule_loads(arena, header->schedule, flow, &loads));
    return fw_process_flow_bill(arena, flow, fw_recipe_wafers(header), loads, b);
}

fw_status fw_recipe_html_bill(const fw_process_flow *flow, const fw_recipe_header *header,
                              fw_text *out) {
    fw_process_bill b;
    FW_TRY(bill_of(out->arena, flow, header, &b));
    if (b.nrow == 0) return FW_OK;
    const bool planned = header->schedule && header->schedule->feasible;
    fw_text_printf(out, "<h3>Baths and consumables of this lot, %d wafer%s</h3>\n", b.wafers,
                   b.wafers == 1 ? ""
                   : planned     ? "s, in the loads of the schedule"
                                 : "s, in full loads");
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
    FW_TRY(bill_of(out->out->arena, flow, header, &b));
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
