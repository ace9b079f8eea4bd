/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "recipe/words.h"

static void moment(fw_text *out, double seconds) {
    fw_put_moment(out, seconds);
    fw_text_add(out, "\",");
}

fw_status fw_recipe_write_schedule_csv(const fw_flow *flow, const fw_recipe_header *header,
                                       fw_text *out) {
    const fw_schedule *s = header->schedule;
    (void)flow;
    fw_text_add(out, "step,title,wafers,equipment,operator,start,end,attended_until,start_s,end_s,"
                     "attended_s,waits_for,time\n");
    if (header->rejected)
        fw_text_add(out,
                    ",REJECTED: the verdict rejects this design: do not fabricate,,,,,,,,,,,\n");
    for (int i = 0; s && i < s->nrun; i++) {
        const fw_run *r = &s->run[i];
        const fw_task *t = &s->shop->task[r->task];
        fw_put_csv(out, t->id);
        fw_text_add(out, ",");
        fw_put_csv(out, t->title);
        fw_text_add(out, ",");
        fw_put_wafers(out, r);
        fw_text_add(out, ",");
        fw_put_csv(out, s->shop->machine[t->machine].title);
        fw_text_add(out, ",");
        if (r->operator_ >= 0) fw_text_printf(out, "%d", r->operator_ + 1);
        fw_text_add(out, ",\"");
        moment(out, r->start_s);
        fw_text_add(out, "\"");
        moment(out, r->end_s);
        if (r->operator_ >= 0) {
            fw_text_add(out, "\"");
            moment(out, r->start_s + t->attended_s);
        } else
            fw_text_add(out, ",");
        fw_put_plain(out, r->start_s);
        fw_text_add(out, ",");
        fw_put_plain(out, r->end_s);
        fw_text_add(out, ",");
        fw_put_plain(out, t->attended_s);
        fw_text_printf(out, ",%s,%s\n", fw_wait_text(r->waits_for),
                       t->unknown  ? "unknown"
                       : t->stated ? "planned by the user"
                                   : "computed");
    }
    return fw_text_end(out);
}
