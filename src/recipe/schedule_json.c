/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/members.h"
#include "recipe/words.h"
#include <math.h>

static void tasks(fw_text *out, const fw_schedule *s) {
    const fw_shop *shop = s->shop;
    fw_put_open(out, "steps", '[');
    for (int i = 0; i < shop->ntask; i++) {
        const fw_task *t = &shop->task[i];
        fw_put_line(out);
        fw_put_open(out, NULL, '{');
        fw_put_words(out, "id", t->id);
        fw_put_words(out, "equipment", shop->machine[t->machine].id);
        fw_put_number(out, "duration_s", t->duration_s, FW_PLAIN_DIGITS);
        fw_put_number(out, "attended_s", t->attended_s, FW_PLAIN_DIGITS);
        fw_put_whole(out, "load", t->load);
        fw_put_words(out, "time", t->unknown ? "unknown" : t->stated ? "planned" : "computed");
        bool last = i + 1 == shop->ntask, known = s->pause_s && !last;
        fw_put_number(out, "longest_pause_s", known ? fmax(0.0, s->pause_s[i]) : (double)INFINITY,
                      FW_PLAIN_DIGITS);
        fw_put_truth(out, "safe_stop", s->pause_s && isinf(s->pause_s[i]));
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
}

static void holds(fw_text *out, const fw_shop *shop) {
    fw_put_open(out, "holds", '[');
    for (int i = 0; i < shop->nhold; i++) {
        const fw_hold *h = &shop->hold[i];
        fw_put_open(out, NULL, '{');
        fw_put_words(out, "from", shop->task[h->from].id);
        fw_put_words(out, "to", shop->task[h->to].id);
        fw_put_number(out, "min_s", h->min_s, FW_PLAIN_DIGITS);
        fw_put_number(out, "max_s", h->max_s, FW_PLAIN_DIGITS);
        fw_put_truth(out, "implied", h->implied);
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
}

static void runs(fw_text *out, const fw_schedule *s) {
    fw_put_open(out, "runs", '[');
    for (int i = 0; i < s->nrun; i++) {
        const fw_run *r = &s->run[i];
        fw_put_line(out);
        fw_put_open(out, NULL, '{');
        fw_put_words(out, "step", s->shop->task[r->task].id);
        fw_put_whole(out, "first_wafer", r->first + 1);
        fw_put_whole(out, "wafers", r->count);
        fw_put_number(out, "start_s", r->start_s, FW_PLAIN_DIGITS);
        fw_put_number(out, "end_s", r->end_s, FW_PLAIN_DIGITS);
        if (r->operator_ >= 0)
            fw_put_whole(out, "operator", r->operator_ + 1);
        else
            fw_put_null(out, "operator");
        fw_put_words(out, "waits_for", fw_wait_text(r->waits_for));
        fw_text_add(out, "}");
    }
    fw_text_add(out, "]");
}

fw_status fw_recipe_write_schedule_json(const fw_flow *flow, const fw_recipe_header *header,
                                        fw_text *out) {
    const fw_schedule *s = header->schedule;
    const fw_shop *shop = s->shop;
    fw_put_open(out, NULL, '{');
    fw_put_words(out, "schema", "flexwright.schedule/1");
    fw_put_words(out, "flow", flow->id);
    fw_put_words(out, "device", header->device);
    fw_put_truth(out, "rejected", header->rejected);
    fw_put_whole(out, "wafers", shop->wafers);
    fw_put_whole(out, "operators", shop->operators);
    fw_put_number(out, "day_open_s", shop->calendar.open_s, FW_PLAIN_DIGITS);
    fw_put_number(out, "day_close_s", shop->calendar.close_s, FW_PLAIN_DIGITS);
    fw_put_truth(out, "weekends", shop->calendar.weekends);
    fw_put_truth(out, "feasible", s->feasible);
    fw_put_words(out, "why", s->why);
    fw_put_words(out, "at_stop_times", s->late);
    fw_put_number(out, "makespan_s", s->feasible ? s->makespan_s : (double)INFINITY,
                  FW_PLAIN_DIGITS);
    fw_put_number(out, "lower_bound_s", s->feasible ? s->bound.best_s : (double)INFINITY,
                  FW_PLAIN_DIGITS);
    fw_put_open(out, "bounds", '{');
    fw_put_number(out, "one_wafer_s", s->bound.path_s, FW_PLAIN_DIGITS);
    fw_put_number(out, "machine_s", s->bound.machine_s, FW_PLAIN_DIGITS);
    fw_put_words(out, "machine", shop->nmachine ? shop->machine[s->bound.machine].id : "");
    fw_put_number(out, "operators_s", s->bound.operator_s, FW_PLAIN_DIGITS);
    fw_text_add(out, "}");
    fw_put_number(out, "gap", s->feasible ? s->gap : (double)INFINITY, FW_PLAIN_DIGITS);
    fw_put_truth(out, "optimal", s->optimal);
    fw_put_words(out, "found_by", s->rule);
    fw_put_whole(out, "unknown_steps", s->unknown);
    tasks(out, s);
    holds(out, shop);
    runs(out, s);
    fw_text_add(out, "}\n");
    return fw_text_end(out);
}
