/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Planned against actual as a page (deviations in plain words, control charts of what was measured, every entry), and as
   JSON. */
#include "base/json.h"
#include "base/text.h"
#include "recipe/asrun_parts.h"
#include "recipe/recipe.h"
#include <math.h>
#include <string.h>

static const char style[] =
    "body{font:14px/1.4 sans-serif;max-width:60em;margin:1.5em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;width:100%;margin:.5em 0 1.5em}"
    "td,th{border:1px solid #bbb;padding:.25em .5em;text-align:left;vertical-align:top}"
    "th{background:#f0f0f0}td.n{text-align:right;white-space:nowrap}.bad{color:#b00;font-weight:"
    "bold}"
    "figure{margin:1em 0;break-inside:avoid}figcaption{font-size:13px}svg{width:100%;height:auto}"
    "@media print{body{margin:0;max-width:none;font-size:11px}figure{margin:0 0 2mm}svg{width:82%}}"
    "@page{margin:14mm}"; /* three charts to a page */

static void heading(const fw_process_flow *flow, const fw_recipe_asrun *run, fw_text *out) {
    fw_text_add(out, "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
                     "<title>As run");
    if (run->lot) {
        fw_text_add(out, ", lot ");
        fw_text_escaped(out, run->lot);
    }
    fw_text_printf(
        out, "</title><style>%s</style></head><body>\n<h1>Planned against actual</h1>\n<p>", style);
    fw_text_escaped(out, flow->title);
    if (run->lot) {
        fw_text_add(out, ", lot <b>");
        fw_text_escaped(out, run->lot);
        fw_text_add(out, "</b>");
    }
    for (int i = 0; i < run->nwafer; i++) {
        fw_text_add(out, i ? ", " : ", wafers ");
        fw_text_escaped(out, run->wafer[i]);
    }
    fw_text_printf(out, ". Plan %.12s, log up to %.12s, %d entries.<br>", run->plan, run->chain,
                   run->nentry);
    fw_recipe_asrun_put_clock(run, out);
    fw_text_add(out, "</p>\n");
}

/* ---- deviations ---- */

static void cell(fw_text *out, const char *text) {
    fw_text_add(out, "<td>");
    fw_text_escaped(out, text ? text : "");
    fw_text_add(out, "</td>");
}

static fw_status deviations(const fw_process_flow *flow, const fw_recipe_asrun *run, fw_text *out) {
    fw_recipe_deviation *list;
    int n;
    FW_TRY(fw_recipe_asrun_deviations(out->arena, flow, run, &list, &n));
    fw_text_add(out, "<h2>Deviations</h2>\n");
    for (const fw_process_step *s = flow->step; s < flow->step + flow->nstep; s++)
        for (int i = 0; i < run->nwafer; i++)
            if (fw_recipe_asrun_left_out(run, s, run->wafer[i]))
                fw_text_printf(out, "<p class=\"bad\">%s of wafer %s: left out</p>\n", s->id,
                               run->wafer[i]);
    if (n == 0) {
        fw_text_add(out, "<p>Everything that was logged is inside of its limits.</p>\n");
        return FW_OK;
    }
    fw_text_add(
        out, "<table><thead><tr><th>Step</th><th>Wafer</th><th>What</th><th>Planned; allowed</th>"
             "<th>Actual</th><th>Who; note</th></tr></thead><tbody>\n");
    for (int i = 0; i < n; i++) {
        const fw_recipe_asrun_entry *e = list[i].entry;
        fw_text_printf(out, "<tr><td>%s ", e->step->id);
        fw_text_escaped(out, e->step->title);
        fw_text_add(out, "</td>");
        cell(out, e->wafer ? e->wafer : "lot");
        cell(out, list[i].what);
        cell(out, list[i].planned);
        fw_text_add(out, "<td class=\"bad\">");
        fw_text_escaped(out, list[i].actual);
        const char *later =
            fw_recipe_asrun_taken_back(run, e) ? " (replaced)" : " (repeated later)";
        if (list[i].repeated) fw_text_add(out, later);
        fw_text_add(out, "</td><td>");
        fw_text_escaped(out, e->by);
        if (e->note) {
            fw_text_add(out, "; ");
            fw_text_escaped(out, e->note);
        }
        fw_text_add(out, "</td></tr>\n");
    }
    fw_text_add(out, "</tbody></table>\n");
    return FW_OK;
}

/* ---- charts ---- */

static double range_of(const fw_recipe_measured *m) {
    double low = (double)INFINITY, high = -(double)INFINITY;
    for (int i = 0; i < FW_RECIPE_SITES; i++)
        if (!isnan(m->site[i])) low = fmin(low, m->site[i]), high = fmax(high, m->site[i]);
    return high - low;
}

static fw_status collect(fw_arena *arena, const fw_recipe_asrun *run, const fw_process_step *s,
                         const fw_process_accept *a, fw_recipe_chart *c) {
    *c = (fw_recipe_chart){.unit = strcmp(a->unit, "1") == 0 ? "" : a->unit,
                           .low = fw_recipe_asrun_limit(a->low, (double)NAN),
                           .high = fw_recipe_asrun_limit(a->high, (double)NAN)};
    FW_NEED(c->title = fw_arena_printf(arena, "%s: %s", s->id, a->measure));
    FW_NEED(c->point = fw_arena_array(arena, fw_recipe_chart_point, (size_t)run->nentry + 1));
    for (int i = 0; i < run->nentry; i++) {
        const fw_recipe_asrun_entry *e = &run->entry[i];
        if (e->step != s || !fw_recipe_asrun_is_last(run, e)) continue;
        for (int k = 0; k < e->nmeasured; k++) {
            const fw_recipe_measured *m = &e->measured[k];
            if (strcmp(m->measure, a->measure) != 0 || isnan(m->number)) continue;
            c->point[c->npoint++] =
                (fw_recipe_chart_point){.label = e->wafer ? e->wafer : "lot",
                                        .mean = m->number,
                                        .range = range_of(m),
                                        .n = m->nsite,
                                        .outside = !fw_recipe_asrun_accepted(m)};
        }
    }
    return FW_OK;
}

static void broken(const fw_recipe_chart *c, fw_text *out) {
    for (int i = 0; i < c->npoint; i++) {
        const fw_recipe_chart_point *p = &c->point[i];
        const char *what[] = {p->outside ? "a value is not accepted" : NULL,
                              p->beyond ? "the mean is beyond its control limits" : NULL,
                              p->run ? "a run of eight or more on one side of the centre" : NULL,
                              p->range_beyond ? "the range is beyond its control limits" : NULL};
        int n = 0;
        for (size_t k = 0; k < sizeof what / sizeof what[0]; k++) {
            if (!what[k]) continue;
            fw_text_add(out, n++ ? ", " : " <span class=\"bad\">Wafer ");
            if (n == 1) {
                fw_text_escaped(out, p->label);
                fw_text_add(out, ": ");
            }
            fw_text_add(out, what[k]);
        }
        if (n) fw_text_add(out, ".</span>");
    }
}

static void caption(const fw_recipe_chart *c, fw_text *out) {
    bool sites = c->size > 1;
    fw_text_add(out, "<figcaption>");
    if (!c->limits)
        fw_text_printf(out,
                       "%d %s: too few for control limits, which need %d. Only what is accepted is "
                       "shown.",
                       c->counted, c->counted == 1 ? "wafer" : "wafers", FW_CHART_LEAST);
    else
        fw_text_printf(out, "%simits %s of %d %s%s.", c->counted < FW_CHART_FIRM ? "Trial l" : "L",
                       sites ? "by mean range (A2, D3, D4)" : "by mean moving range (2.66; 3.267)",
                       c->counted, sites ? "subgroups" : "individual values",
                       c->counted < FW_CHART_FIRM ? "; firm from 20 on" : "");
    if (c->counted < c->npoint)
        fw_text_printf(out, " Hollow points have another number of sites and are not judged by "
                            "them.");
    broken(c, out);
    fw_text_add(out, "</figcaption>");
}

/* particles, cracks, bubbles that nobody found: the table of entries has them */
static bool all_zero(const fw_recipe_chart *c) {
    for (int i = 0; i < c->npoint; i++)
        if (c->point[i].mean != 0.0 || c->point[i].range != 0.0) return false;
    return true;
}

static fw_status charts(const fw_process_flow *flow, const fw_recipe_asrun *run, fw_text *out) {
    int n = 0;
    fw_text_add(out, "<h2>Control charts</h2>\n");
    for (int i = 0; i < flow->nstep; i++)
        for (int k = 0; k < flow->step[i].naccept; k++) {
            fw_recipe_chart c;
            FW_TRY(collect(out->arena, run, &flow->step[i], &flow->step[i].accept[k], &c));
            if (c.npoint == 0 || all_zero(&c)) continue;
            fw_recipe_chart_judge(&c);
            fw_text_add(out, "<figure>\n");
            fw_recipe_chart_svg(&c, out);
            caption(&c, out);
            fw_text_add(out, "</figure>\n");
            n++;
        }
    if (n == 0) fw_text_add(out, "<p>No number other than 0 was measured yet.</p>\n");
    return FW_OK;
}

/* ---- every entry ---- */

static void duration(fw_text *out, double seconds, bool known) {
    fw_text_add(out, "<td class=\"n\">");
    if (known) fw_schedule_put_duration(out, seconds);
    fw_text_add(out, "</td>");
}

static void put_values(const fw_recipe_asrun_entry *e, fw_text *out) {
    const char *between = "";
    for (int i = 0; i < e->nmeasured; i++) {
        const fw_recipe_measured *m = &e->measured[i];
        bool fine = fw_recipe_asrun_accepted(m);
        fw_text_printf(out, "%s%s", between, fine ? "" : "<span class=\"bad\">");
        fw_text_escaped(out, m->measure);
        fw_text_add(out, " = ");
        fw_text_escaped(out, m->value);
        fw_text_add(out, fine ? "" : "</span>");
        between = "<br>";
    }
    for (int i = 0; i < e->nset; i++) {
        const fw_recipe_set *s = &e->set[i];
        bool fine = fw_recipe_asrun_allowed(s);
        fw_text_printf(out, "%s%sset ", between, fine ? "" : "<span class=\"bad\">");
        fw_text_escaped(out, s->name);
        fw_text_add(out, " = ");
        fw_text set = fw_text_new(out->arena);
        fw_recipe_asrun_put_set_beside_planned(s, &set);
        out->failed = out->failed || fw_text_end(&set) != FW_OK;
        fw_text_escaped(out, set.data ? set.data : "");
        fw_text_add(out, fine ? "" : "</span>");
        between = "<br>";
    }
    for (int i = 0; i < e->ncoupon; i++) {
        fw_text_printf(out, "%scoupon ", between);
        fw_text_escaped(out, e->coupon[i].text);
        between = "<br>";
    }
}

static void entries(const fw_process_flow *flow, const fw_recipe_asrun *run, fw_text *out) {
    fw_text_add(out,
                "<h2>Entries</h2>\n<table><thead><tr><th>Step</th><th>Wafer</th><th>Start</th>"
                "<th>At the machine, planned for what was set</th><th>Actual</th><th>By; tool; "
                "instrument</th><th>Values and settings</th></tr></thead><tbody>\n");
    for (int s = 0; s < flow->nstep; s++)
        for (int i = 0; i < run->nentry; i++) {
            const fw_recipe_asrun_entry *e = &run->entry[i];
            if (e->step != &flow->step[s]) continue;
            const bool last = fw_recipe_asrun_is_last(run, e);
            fw_text_printf(out, "<tr><td>%s%s</td>", e->step->id,
                           last && fw_recipe_asrun_overtaken(run, e, e->wafer)
                               ? " (overtaken, to be run again)"
                           : last                               ? ""
                           : fw_recipe_asrun_taken_back(run, e) ? " (replaced by a later line)"
                           : fw_recipe_asrun_is_gone_on(run, e) ? " (gone on with later)"
                                                                : " (repeated later)");
            cell(out, e->wafer ? e->wafer : "lot");
            cell(out, e->start);
            duration(out, e->as_set->booked_s, e->as_set->time.computable);
            duration(out, e->end_s - e->start_s, true);
            fw_text_add(out, "<td>");
            fw_text_escaped(out, e->by);
            const char *more[] = {e->second, e->tool, e->instrument, e->bath};
            for (size_t k = 0; k < sizeof more / sizeof more[0]; k++) {
                if (!more[k]) continue;
                fw_text_add(out, "; ");
                fw_text_escaped(out, more[k]);
            }
            fw_text_add(out, "</td><td>");
            put_values(e, out);
            fw_text_add(out, "</td></tr>\n");
        }
    fw_text_add(out, "</tbody></table>\n");
}

fw_status fw_recipe_asrun_write_html(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                     fw_text *out) {
    heading(flow, run, out);
    fw_recipe_asrun_fates_html(flow, run, out);
    FW_TRY(deviations(flow, run, out));
    fw_recipe_asrun_declared_html(run, out);
    FW_TRY(charts(flow, run, out));
    entries(flow, run, out);
    fw_text_add(out,
                "<p>Control charts after Montgomery, Introduction to Statistical Quality Control, "
                "chapter 6, and the NIST/SEMATECH e-Handbook, 6.3.2. Out of control: beyond a "
                "limit, or the eighth and every further point on one side of the centre. Red: such "
                "a point, or one with a value that is not accepted.</p>\n</body></html>\n");
    return fw_text_end(out);
}

/* ---- planned against actual, as JSON ---- */
static void put_number(fw_json *out, const char *key, double value) {
    fw_json_number(out, key, value, FW_PLAIN_DIGITS);
}

/* what nobody wrote down is left out */
static void put_text(fw_json *out, const char *key, const char *value) {
    if (value) fw_json_text(out, key, value);
}

static void sites_json(const fw_recipe_measured *m, fw_json *out) {
    if (m->nsite < 2) return;
    fw_json_object(out, "sites");
    for (int i = 0; i < FW_RECIPE_SITES; i++)
        if (!isnan(m->site[i])) put_number(out, fw_recipe_site_name[i], m->site[i]);
    fw_json_end(out);
}

/* what an inspection found that was overtaken is accepted no more, and not refused */
static void measured_json(const fw_recipe_asrun_entry *e, bool overtaken, fw_json *out) {
    fw_json_list(out, "measured");
    for (int i = 0; i < e->nmeasured; i++) {
        const fw_recipe_measured *m = &e->measured[i];
        fw_json_object(out, NULL);
        fw_json_text(out, "measure", m->measure);
        if (isnan(m->number))
            put_text(out, "value", m->value);
        else
            put_number(out, "value", m->number);
        const fw_process_accept *a = fw_recipe_asrun_accept(e->step, m->measure);
        put_text(out, "unit", a->unit);
        if (overtaken)
            fw_json_null(out, "accepted");
        else
            fw_json_truth(out, "accepted", fw_recipe_asrun_accepted(m));
        sites_json(m, out);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void settings_json(const fw_recipe_asrun_entry *e, fw_json *out) {
    fw_json_list(out, "settings");
    for (int i = 0; i < e->nset; i++) {
        const fw_recipe_set *s = &e->set[i];
        fw_json_object(out, NULL);
        fw_json_text(out, "name", s->name);
        if (isnan(s->value))
            put_text(out, "value", s->text);
        else
            put_number(out, "value", s->value);
        /* a log that was read without its plan may set what no step has */
        fw_recipe_asrun_planned(s->q, s->planned, out);
        put_text(out, "unit", s->q ? s->q->unit : NULL);
        fw_json_truth(out, "accepted", fw_recipe_asrun_allowed(s));
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_list(out, "coupons");
    for (int i = 0; i < e->ncoupon; i++)
        fw_json_text(out, NULL, e->coupon[i].text);
    fw_json_end(out);
}

static void wait_json(const fw_recipe_wait *wait, fw_json *out) {
    fw_json_object(out, NULL);
    fw_json_text(out, "from", wait->since);
    put_text(out, "is", wait->is);
    put_number(out, "waited_s", wait->waited_s);
    put_number(out, "min_s", wait->min_s);
    put_number(out, "max_s", wait->max_s);
    if (isnan(wait->waited_s))
        fw_json_null(out, "accepted");
    else
        fw_json_truth(out, "accepted", wait->fine);
    fw_json_end(out);
}

static void waited_json(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, fw_json *out) {
    fw_json_list(out, "waited");
    for (const fw_recipe_asrun_entry *o = e; o; o = fw_recipe_asrun_run_before(run, o)) {
        int i = 0;
        for (fw_recipe_wait wait; fw_recipe_asrun_wait(run, o, &i, &wait);)
            if (o == e || fw_recipe_asrun_wait_stands(run, o, &wait)) wait_json(&wait, out);
    }
    fw_json_end(out);
}

static void entry_json(const fw_recipe_asrun *run, const fw_recipe_asrun_entry *e, fw_json *out) {
    put_text(out, "wafer", e->wafer);
    put_text(out, "start", e->start);
    put_text(out, "end", e->end);
    put_number(out, "actual_s", e->end_s - e->start_s);
    const fw_recipe_runs runs = fw_recipe_asrun_runs(run, e);
    if (runs.n > 1) fw_json_whole(out, "runs", runs.n);
    if (runs.n > 1) put_number(out, "runs_s", runs.took_s);
    put_text(out, "judged", fw_recipe_asrun_in_time(run, e));
    fw_recipe_asrun_as_set_json(run, e, out);
    put_text(out, "by", e->by);
    put_text(out, "second", e->second);
    put_text(out, "tool", e->tool);
    put_text(out, "instrument", e->instrument);
    put_text(out, "bath", e->bath);
    put_text(out, "note", e->note);
    put_text(out, "deviation", e->deviation);
    measured_json(e, fw_recipe_asrun_overtaken(run, e, e->wafer), out);
    settings_json(e, out);
    waited_json(run, e, out);
}

/* the last entry of a step itself, and the last ones of its other wafers in a list */
static void runs_json(const fw_recipe_asrun *run, const fw_process_step *s, fw_json *out) {
    const fw_recipe_asrun_entry *last = NULL;
    int times = 0, wafers = 0;
    for (int k = 0; k < run->nentry; k++) {
        if (run->entry[k].step != s) continue;
        last = &run->entry[k];
        times++;
        wafers += fw_recipe_asrun_is_last(run, last);
    }
    fw_json_whole(out, "times", times);
    if (last) entry_json(run, last, out);
    if (wafers < 2) return;
    fw_json_list(out, "others");
    for (int k = 0; k < run->nentry; k++) {
        const fw_recipe_asrun_entry *e = &run->entry[k];
        if (e->step != s || e == last || !fw_recipe_asrun_is_last(run, e)) continue;
        fw_json_object(out, NULL);
        entry_json(run, e, out);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static fw_status deviations_json(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                 fw_json *out, fw_arena *arena) {
    fw_recipe_deviation *list;
    int n;
    FW_TRY(fw_recipe_asrun_deviations(arena, flow, run, &list, &n));
    fw_json_list(out, "deviations");
    for (int i = 0; i < n; i++) {
        fw_json_object(out, NULL);
        fw_json_text(out, "step", list[i].entry->step->id);
        put_text(out, "wafer", list[i].entry->wafer);
        fw_json_text(out, "what", list[i].what);
        fw_json_text(out, "planned", list[i].planned);
        fw_json_text(out, "actual", list[i].actual);
        fw_json_truth(out, "repeated", list[i].repeated);
        fw_json_end(out);
    }
    fw_json_end(out);
    return FW_OK;
}

static void read_again_json(const fw_recipe_asrun *run, fw_json *out) {
    int i = 0, k = 0;
    fw_json_list(out, "read_again");
    for (fw_recipe_read_again a; fw_recipe_asrun_read_again(run, &i, &k, &a);) {
        fw_json_object(out, NULL);
        fw_json_text(out, "step", a.entry->step->id);
        put_text(out, "wafer", a.entry->wafer);
        fw_json_whole(out, "line", a.entry->line);
        fw_json_text(out, "coupon", a.coupon->text);
        fw_json_whole(out, "by_line", a.by->line);
        fw_json_text(out, "by_coupon", a.by_coupon->text);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void declared_json(const fw_recipe_asrun *run, fw_json *out) {
    fw_json_list(out, "written_down");
    for (int i = 0; i < run->nentry; i++) {
        const fw_recipe_asrun_entry *e = &run->entry[i];
        if (!e->deviation) continue;
        fw_json_object(out, NULL);
        fw_json_text(out, "step", e->at->id);
        if (e->wafer) fw_json_text(out, "wafer", e->wafer);
        fw_json_text(out, "at", e->start);
        fw_json_text(out, "by", e->by);
        fw_json_text(out, "deviation", e->deviation);
        fw_json_whole(out, "line", e->line);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void fates_json(const fw_recipe_asrun *run, fw_json *out) {
    fw_json_list(out, "fates");
    for (int i = 0; i < run->nentry; i++) {
        const fw_recipe_asrun_entry *e = &run->entry[i];
        if (e->fate == FW_FATE_RUN) continue;
        fw_json_object(out, NULL);
        fw_json_text(out, "wafer", e->wafer);
        fw_json_text(out, "fate", fw_recipe_fate_word(e->fate));
        fw_json_text(out, "step", e->at->id);
        fw_json_text(out, "at", e->start);
        fw_json_text(out, "by", e->by);
        fw_json_text(out, "why", e->why);
        put_text(out, "note", e->note);
        fw_json_whole(out, "line", e->line);
        fw_json_end(out);
    }
    fw_json_end(out);
}

/* how many wafers come to the step and go on from it, and of which it is not in the log yet */
static void wafers_json(const fw_process_flow *flow, const fw_recipe_asrun *run, int step,
                        fw_json *out) {
    if (run->nwafer == 0) return;
    fw_json_whole(out, "wafers_in", fw_recipe_asrun_count(flow, run, step, FW_FATE_RUN));
    fw_json_whole(out, "wafers_out", fw_recipe_asrun_count(flow, run, step + 1, FW_FATE_RUN));
    fw_json_list(out, "expected");
    for (int i = 0; i < run->nwafer; i++)
        if (fw_recipe_asrun_expects(run, &flow->step[step], run->wafer[i]))
            fw_json_text(out, NULL, run->wafer[i]);
    fw_json_end(out);
    fw_json_list(out, "left_out");
    for (int i = 0; i < run->nwafer; i++)
        if (fw_recipe_asrun_left_out(run, &flow->step[step], run->wafer[i]))
            fw_json_text(out, NULL, run->wafer[i]);
    fw_json_end(out);
}

static void set_json(const char *name, const fw_quantity *q, fw_json *out) {
    fw_json_object(out, NULL);
    fw_json_text(out, "name", name);
    fw_recipe_asrun_planned(q, q && !q->unknown ? fw_quantity_in_unit(q) : (double)NAN, out);
    fw_json_text(out, "unit", q->unit);
    fw_json_end(out);
}

/* what an entry of the step may say: what is measured and within which limits, and what is set */
static void asked_json(const fw_process_step *s, fw_json *out) {
    fw_json_list(out, "measures");
    for (int i = 0; i < s->naccept; i++) {
        const fw_process_accept *a = &s->accept[i];
        fw_json_object(out, NULL);
        fw_json_text(out, "measure", a->measure);
        fw_json_text(out, "low", a->low);
        fw_json_text(out, "high", a->high);
        fw_json_text(out, "unit", a->unit);
        fw_json_whole(out, "sites", a->sites);
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_list(out, "sets");
    for (int i = 0; i < s->nsetting; i++)
        set_json(s->setting[i].name, s->setting[i].q, out);
    for (int i = 0; i < s->nderived; i++)
        if (s->derived[i]->id) set_json(s->derived[i]->id, s->derived[i], out);
    fw_json_end(out);
}

fw_status fw_recipe_asrun_write_json(const fw_process_flow *flow, const fw_recipe_asrun *run,
                                     fw_text *text) {
    fw_json json = fw_json_new(text, FW_JSON_COMPACT), *out = &json;
    fw_json_object(out, NULL);
    put_text(out, "schema", "flexwright.as-run/1");
    put_text(out, "flow", flow->id);
    put_text(out, "lot", run->lot);
    put_text(out, "zone", run->zone);
    if (run->nwafer > 0) {
        fw_json_list(out, "wafers");
        for (int i = 0; i < run->nwafer; i++)
            fw_json_text(out, NULL, run->wafer[i]);
        fw_json_end(out);
    }
    put_text(out, "plan_sha256", run->plan);
    put_text(out, "chain", run->chain[0] ? run->chain : NULL);
    fw_json_whole(out, "entries", run->nentry);
    fw_json_list(out, "steps");
    for (int i = 0; i < flow->nstep; i++) {
        const fw_process_step *s = &flow->step[i];
        const fw_process_time *p = &s->time;
        fw_json_line(out, 0);
        fw_json_object(out, NULL);
        fw_json_text(out, "id", s->id);
        fw_json_text(out, "title", s->title);
        put_number(out, "planned_s", p->computable ? p->nominal_s : (double)NAN);
        put_number(out, "first_look_s", p->computable ? p->first_look_s : (double)NAN);
        put_number(out, "stop_s", p->computable ? p->stop_s : (double)NAN);
        put_number(out, "at_machine_s", p->computable ? s->booked_s : (double)NAN);
        put_number(out, "at_machine_most_s", p->computable ? s->booked_stop_s : (double)NAN);
        wafers_json(flow, run, i, out);
        runs_json(run, s, out);
        asked_json(s, out);
        fw_json_end(out);
    }
    fw_recipe_asrun_total t;
    FW_TRY(fw_recipe_asrun_sum_up(flow, run, text->arena, &t));
    fw_json_end(out);
    fw_json_whole(out, "logged", t.logged);
    fw_json_whole(out, "repeated", t.repeated);
    fw_json_whole(out, "outside", t.out);
    fw_json_whole(out, "left_out", t.left_out);
    put_number(out, "at_machine_s", t.planned_s);
    put_number(out, "actual_s", t.actual_s);
    put_number(out, "earlier_runs_s", t.earlier_s);
    fw_json_whole(out, "unplanned", t.unplanned);
    put_number(out, "unplanned_s", t.unplanned_s);
    FW_TRY(deviations_json(flow, run, out, text->arena));
    read_again_json(run, out);
    declared_json(run, out);
    fates_json(run, out);
    fw_json_end(out);
    return fw_json_finish(out, "\n");
}
