/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "recipe/recipe_words.h"
#include <string.h>

/* RFC 4180: quoted where needed; what a spreadsheet would take for a formula gets a quote in front
 */
static void put_csv(fw_text *out, const char *text) {
    bool formula = text[0] && strchr("=+-@\t", text[0]) != NULL;
    if (!formula && !strpbrk(text, ",\"\r\n")) {
        fw_text_add(out, text);
        return;
    }
    fw_text_add(out, formula ? "\"'" : "\"");
    for (const char *c = text; *c; c++)
        fw_text_bytes(out, *c == '"' ? "\"\"" : *c == '\n' ? " " : c, *c == '"' ? 2 : 1);
    fw_text_add(out, "\"");
}

static void head(fw_text *out, const fw_process_step *s, const char *name) {
    put_csv(out, s->id);
    fw_text_add(out, ",");
    put_csv(out, s->title);
    fw_text_add(out, ",");
    put_csv(out, name);
    fw_text_add(out, ",");
}

static void quantity_row(fw_text *out, const fw_process_step *s, const fw_recipe_row *row) {
    const fw_quantity *q = row->q;
    head(out, s, row->name);
    if (!q->unknown) fw_recipe_put_plain(out, fw_quantity_in_unit(q));
    fw_text_add(out, ",");
    put_csv(out, q->unit);
    fw_text_add(out, ",");
    if (!q->unknown) fw_recipe_put_uncertainty(out, fw_recipe_row_uncertainty(q));
    fw_text_add(out, ",");
    put_csv(out, q->unknown ? "unknown" : fw_quantity_value_status_text(q->status));
    fw_text_add(out, ",");
    put_csv(out, q->unknown && q->note ? q->note : q->source ? q->source : "");
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
        put_csv(out, text);
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
        put_csv(out, f->time && f->time->source ? f->time->source
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
        put_csv(out, header->because[i]);
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
    fw_text_add(out, "step,title,wafers,equipment,operator,start,end,attended_until,start_s,end_s,"
                     "attended_s,waits_for,time\n");
    if (header->rejected)
        fw_text_add(out,
                    ",REJECTED: the verdict rejects this design: do not fabricate,,,,,,,,,,,\n");
    for (int i = 0; s && i < s->nrun; i++) {
        const fw_schedule_run *r = &s->run[i];
        const fw_schedule_task *t = &s->shop->task[r->task];
        put_csv(out, t->id);
        fw_text_add(out, ",");
        put_csv(out, t->title);
        fw_text_add(out, ",");
        fw_recipe_put_wafers(out, r);
        fw_text_add(out, ",");
        put_csv(out, s->shop->machine[t->machine].title);
        fw_text_add(out, ",");
        if (r->operator_ >= 0) fw_text_printf(out, "%d", r->operator_ + 1);
        fw_text_add(out, ",\"");
        moment(out, s, r->start_s);
        fw_text_add(out, "\"");
        moment(out, s, r->end_s);
        if (r->operator_ >= 0) {
            fw_text_add(out, "\"");
            moment(out, s, r->start_s + t->attended_s);
        } else
            fw_text_add(out, ",");
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
