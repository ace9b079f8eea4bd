/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "recipe/words.h"
#include <math.h>

static void name(fw_text *out, const char *key, const char *value) {
    fw_put_json(out, key);
    fw_text_add(out, ":");
    fw_put_json(out, value);
    fw_text_add(out, ",");
}

/* null where it is infinite */
static void number(fw_text *out, const char *key, double value) {
    fw_put_json(out, key);
    fw_text_add(out, ":");
    fw_put_or_null(out, value);
    fw_text_add(out, ",");
}

static void tasks(fw_text *out, const fw_schedule *s) {
    const fw_shop *shop = s->shop;
    fw_text_add(out, "\"steps\":[");
    for (int i = 0; i < shop->ntask; i++) {
        const fw_task *t = &shop->task[i];
        fw_text_add(out, i ? ",\n{" : "\n{");
        name(out, "id", t->id);
        name(out, "equipment", shop->machine[t->machine].id);
        number(out, "duration_s", t->duration_s);
        number(out, "attended_s", t->attended_s);
        fw_text_printf(out, "\"load\":%d,", t->load);
        name(out, "time", t->unknown ? "unknown" : t->stated ? "planned" : "computed");
        bool last = i + 1 == shop->ntask, known = s->pause_s && !last;
        number(out, "longest_pause_s", known ? fmax(0.0, s->pause_s[i]) : (double)INFINITY);
        fw_text_printf(out, "\"safe_stop\":%s}",
                       s->pause_s && isinf(s->pause_s[i]) ? "true" : "false");
    }
    fw_text_add(out, "],");
}

static void holds(fw_text *out, const fw_shop *shop) {
    fw_text_add(out, "\"holds\":[");
    for (int i = 0; i < shop->nhold; i++) {
        const fw_hold *h = &shop->hold[i];
        fw_text_add(out, i ? ",{" : "{");
        name(out, "from", shop->task[h->from].id);
        name(out, "to", shop->task[h->to].id);
        number(out, "min_s", h->min_s);
        number(out, "max_s", h->max_s);
        fw_text_printf(out, "\"implied\":%s}", h->implied ? "true" : "false");
    }
    fw_text_add(out, "],");
}

static void runs(fw_text *out, const fw_schedule *s) {
    fw_text_add(out, "\"runs\":[");
    for (int i = 0; i < s->nrun; i++) {
        const fw_run *r = &s->run[i];
        fw_text_add(out, i ? ",\n{" : "\n{");
        name(out, "step", s->shop->task[r->task].id);
        fw_text_printf(out, "\"first_wafer\":%d,\"wafers\":%d,", r->first + 1, r->count);
        number(out, "start_s", r->start_s);
        number(out, "end_s", r->end_s);
        if (r->operator_ >= 0)
            fw_text_printf(out, "\"operator\":%d,", r->operator_ + 1);
        else
            fw_text_add(out, "\"operator\":null,");
        name(out, "waits_for", fw_wait_text(r->waits_for));
        out->length--;
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
}

fw_status fw_recipe_write_schedule_json(const fw_flow *flow, const fw_recipe_header *header,
                                        fw_text *out) {
    const fw_schedule *s = header->schedule;
    const fw_shop *shop = s->shop;
    fw_text_add(out, "{");
    name(out, "schema", "flexwright.schedule/1");
    name(out, "flow", flow->id);
    name(out, "device", header->device);
    fw_text_printf(out, "\"rejected\":%s,", header->rejected ? "true" : "false");
    fw_text_printf(out, "\"wafers\":%d,\"operators\":%d,", shop->wafers, shop->operators);
    number(out, "day_open_s", shop->calendar.open_s);
    number(out, "day_close_s", shop->calendar.close_s);
    fw_text_printf(out, "\"weekends\":%s,", shop->calendar.weekends ? "true" : "false");
    fw_text_printf(out, "\"feasible\":%s,", s->feasible ? "true" : "false");
    name(out, "why", s->why);
    name(out, "at_stop_times", s->late);
    number(out, "makespan_s", s->feasible ? s->makespan_s : (double)INFINITY);
    number(out, "lower_bound_s", s->feasible ? s->bound.best_s : (double)INFINITY);
    fw_text_add(out, "\"bounds\":{");
    number(out, "one_wafer_s", s->bound.path_s);
    number(out, "machine_s", s->bound.machine_s);
    name(out, "machine", shop->nmachine ? shop->machine[s->bound.machine].id : "");
    number(out, "operators_s", s->bound.operator_s);
    out->length--;
    fw_text_add(out, "},");
    number(out, "gap", s->feasible ? s->gap : (double)INFINITY);
    fw_text_printf(out, "\"optimal\":%s,", s->optimal ? "true" : "false");
    name(out, "found_by", s->rule);
    fw_text_printf(out, "\"unknown_steps\":%d,", s->unknown);
    tasks(out, s);
    holds(out, shop);
    runs(out, s);
    fw_text_add(out, "}\n");
    return fw_text_end(out);
}
