/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "recipe/words.h"
#include <math.h>

void fw_put_moment(fw_text *out, double seconds) {
    long minutes = lround(seconds / 60.0);
    fw_text_printf(out, "day %ld, %02ld:%02ld", minutes / 1440 + 1, minutes / 60 % 24,
                   minutes % 60);
}

void fw_put_wafers(fw_text *out, const fw_run *run) {
    fw_text_printf(out, "%d", run->first + 1);
    if (run->count > 1) fw_text_printf(out, "-%d", run->first + run->count);
}

static void put_day(fw_text *out, const fw_calendar *c) {
    if (fw_calendar_round(c)) {
        fw_text_add(out, "round the clock");
        return;
    }
    long open = lround(c->open_s / 60.0), close = lround(c->close_s / 60.0);
    fw_text_printf(out, "%02ld:%02ld to %02ld:%02ld, Monday to Friday", open / 60, open % 60,
                   close / 60, close % 60);
}

static void put_percent(fw_text *out, double part) {
    char text[32];
    fw_text_printf(out, "%s %%", fw_percent_text(text, sizeof text, part));
}

/* the steps whose time is not known, or is the user's own */
static void put_steps(fw_text *out, const fw_shop *shop, bool stated) {
    int n = 0;
    for (int i = 0; i < shop->ntask; i++)
        if (stated ? shop->task[i].stated : shop->task[i].unknown) {
            fw_text_add(out, n++ ? ", " : "");
            fw_text_escaped(out, shop->task[i].id);
        }
}

static const char *bound_words(const fw_schedule *s) {
    const fw_schedule_bound *b = &s->bound;
    if (b->best_s <= b->path_s) return "one wafer alone, with its holds and the working day";
    return b->best_s <= b->machine_s ? s->shop->machine[b->machine].title
                                     : "everything that somebody must stand by";
}

void fw_put_schedule_summary(fw_text *out, const fw_schedule *s) {
    const fw_shop *shop = s->shop;
    int stated = 0;
    for (int i = 0; i < shop->ntask; i++)
        stated += shop->task[i].stated;
    fw_text_printf(out, "%d wafer%s, %d operator%s, ", shop->wafers, shop->wafers > 1 ? "s" : "",
                   shop->operators, shop->operators > 1 ? "s" : "");
    put_day(out, &shop->calendar);
    if (!s->feasible) {
        fw_text_add(out, ": there is no schedule. ");
        fw_text_escaped(out, s->why ? s->why : "");
        fw_text_add(out, ".");
        return;
    }
    fw_text_printf(out, ": %s", s->unknown ? "at least " : "");
    fw_put_duration(out, s->makespan_s);
    fw_text_add(out, ", until ");
    fw_put_moment(out, s->start_s + s->makespan_s);
    fw_text_add(out, ". No schedule is shorter than ");
    fw_put_duration(out, s->bound.best_s);
    fw_text_add(out, " (");
    fw_text_escaped(out, bound_words(s));
    if (s->optimal)
        fw_text_add(out, "): this one is shortest.");
    else {
        fw_text_add(out, "); this one is ");
        put_percent(out, s->gap);
        fw_text_add(out, " above that.");
    }
    if (s->unknown) {
        fw_text_add(out, " The times of ");
        put_steps(out, shop, false);
        fw_text_add(out, " are not known: they are counted with the time that somebody must stand "
                         "by, and nothing more.");
    }
    if (stated) {
        fw_text_add(out, " The times of ");
        put_steps(out, shop, true);
        fw_text_add(out, " are planning times of the user.");
    }
    if (s->late) {
        fw_text_add(out, " When every step runs to its stop time: ");
        fw_text_escaped(out, s->late);
        fw_text_add(out, ".");
    }
}

void fw_put_stops(fw_text *out, const fw_schedule *s) {
    const fw_shop *shop = s->shop;
    const double night_s = 86400.0 - (shop->calendar.close_s - shop->calendar.open_s);
    int started = 0;
    if (!s->pause_s) return;
    for (int kind = 0; kind < 3; kind++) {
        static const char *const head[] = {"for any time after ",
                                           "over night, for so long at most: ", "never between "};
        int n = 0;
        for (int i = 0; i + 1 < shop->ntask; i++) {
            double pause = s->pause_s[i];
            bool company = shop->task[i].by_day && shop->task[i + 1].by_day;
            int is = company ? 2 : pause >= 1e15 ? 0 : pause >= fmax(night_s, 8.0 * 3600.0) ? 1 : 2;
            if (is != kind) continue;
            fw_text_add(out, n++ ? ", " : started++ ? "; " : "");
            fw_text_add(out, n > 1 ? "" : head[kind]);
            fw_text_escaped(out, shop->task[i].id);
            if (kind == 2) {
                fw_text_add(out, " and ");
                fw_text_escaped(out, shop->task[i + 1].id);
            }
            if (kind == 0) continue;
            if (company) {
                fw_text_add(out, " (not alone, the same day)");
                continue;
            }
            fw_text_add(out, " (");
            fw_put_duration(out, fmax(0.0, pause));
            fw_text_add(out, ")");
        }
    }
}

void fw_html_schedule(const fw_recipe_header *header, fw_text *out) {
    const fw_schedule *s = header->schedule;
    if (!s) return;
    fw_text_add(out, "<h3>Schedule</h3>\n<p class=\"small\">");
    fw_put_schedule_summary(out, s);
    fw_text_add(out, "</p>\n");
    if (!s->pause_s) return;
    fw_text_add(out, "<p class=\"small\"><b>Safe stopping points</b>, where no hold window of the "
                     "process file is running: ");
    fw_put_stops(out, s);
    fw_text_add(out, " (longest pause that the windows allow).</p>\n");
    if (!s->feasible) return;
    fw_text_add(out, "<table class=\"small\"><thead><tr><th>Step</th><th>Wafers: start to end "
                     "(operator)</th></tr></thead><tbody>\n");
    for (int i = 0; i < s->shop->ntask; i++) {
        int n = 0;
        fw_text_add(out, "<tr><td class=\"id\">");
        fw_text_escaped(out, s->shop->task[i].id);
        fw_text_add(out, s->shop->task[i].unknown ? " (time unknown)</td><td>" : "</td><td>");
        for (int k = 0; k < s->nrun; k++) {
            const fw_run *r = &s->run[k];
            if (r->task != i) continue;
            fw_text_add(out, n++ ? "; " : "");
            fw_put_wafers(out, r);
            fw_text_add(out, ": ");
            fw_put_moment(out, r->start_s);
            fw_text_add(out, " to ");
            fw_put_moment(out, r->end_s);
            if (r->operator_ >= 0) fw_text_printf(out, " (%d)", r->operator_ + 1);
        }
        fw_text_add(out, "</td></tr>\n");
    }
    fw_text_add(out, "</tbody></table>\n");
}
