/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The schedule as a picture: a panel per working day, in it a row for every machine in use, for
   every operator and for every hold window. The night behind a day is a narrow strip of its panel,
   so that no run is outside the picture. Behind it what the run sheet says of the schedule. */
#include "base/svg.h"
#include "recipe/recipe.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { LABELS = 190, DAY = 900, NIGHT = 70, ROW = 20, LANE = 6, MOST_ROWS = 512 };
static const int width_px = LABELS + DAY + NIGHT + 20;

/* light enough for black lettering, different in lightness too */
static const char *const colour[] = {"#7fb8e6", "#f2b04c", "#8fcf9b", "#e79bc0",
                                     "#d9d35a", "#b9a3e3", "#f08a6c", "#6fd0cf",
                                     "#c9b18a", "#a8c94f", "#9aa7b8", "#ffc7c7"};
enum { COLOURS = sizeof colour / sizeof colour[0] };

typedef enum row_kind { MACHINE, PERSON, HOLD } row_kind;

typedef struct row {
    row_kind kind;
    int index;
    double y, height;
} row;

typedef struct picture {
    const fw_schedule *s;
    fw_text *out;
    double open_s, close_s, next_s; /* of the panel; the night lies between close and next */
    row row[MOST_ROWS];
    int nrow;
    double y; /* where the next panel begins */
} picture;

static double px(const picture *p, double t) {
    if (t <= p->open_s) return LABELS;
    if (t <= p->close_s) return LABELS + DAY * (t - p->open_s) / (p->close_s - p->open_s);
    if (t >= p->next_s || p->next_s <= p->close_s)
        return LABELS + DAY + (p->next_s > p->close_s ? NIGHT : 0);
    return LABELS + DAY + NIGHT * (t - p->close_s) / (p->next_s - p->close_s);
}

static bool meets(const picture *p, double start, double end) {
    return start < p->next_s - 1e-6 && end > p->open_s + 1e-6;
}

#define BOX "rect x='{2}' y='{2}' width='{2}' height='{2}'"
static const double LEAST = 0.6; /* px: narrower boxes could not be seen */

static void label(fw_text *out, double x, double y, const char *class_name, const char *text) {
    fw_svg_put(out, "text x='{2}' y='{2}' class='{r}'>{s}\n", x, y, class_name, text);
}

/* content of the box of a load, and its end */
static void hover(fw_text *out, const fw_schedule *s, const fw_schedule_run *r) {
    const fw_schedule_task *t = &s->shop->task[r->task];
    fw_svg_open(out, "title");
    fw_markup(out, "{s} {s}; wafer ", t->id, t->title);
    fw_recipe_put_wafers(out, r);
    fw_text_add(out, "; ");
    fw_recipe_put_moment(out, &s->shop->calendar, r->start_s);
    fw_text_add(out, " to ");
    fw_recipe_put_moment(out, &s->shop->calendar, r->end_s);
    if (t->unknown) fw_text_add(out, "; time unknown");
    fw_svg_close(out, "title");
    fw_svg_close(out, "rect\n");
}

/* one bar: a band of colour for every wafer of the load */
static void bar(const picture *p, const fw_schedule_run *r, double start, double end, double y,
                double height) {
    const fw_schedule_task *t = &p->s->shop->task[r->task];
    double x = px(p, start), w = px(p, end) - x, band = height / r->count;
    for (int i = 0; i < r->count; i++)
        fw_svg_put(p->out, BOX " fill='{r}'\n", x, y + band * i, fmax(w, LEAST), band,
                   colour[(r->first + i) % COLOURS]);
    fw_svg_open(p->out,
                t->unknown ? BOX " fill='none' stroke='#000' stroke-width='1' "
                                 "stroke-dasharray='3 2' pointer-events='all'"
                           : BOX " fill='none' stroke='#333' stroke-width='0.5' "
                                 "pointer-events='all'",
                x, y, fmax(w, LEAST), height);
    hover(p->out, p->s, r);
    if (height < 12.0 || w < 6.2 * (double)strlen(t->id) + 2.0) return;
    label(p->out, x + w / 2.0, y + height / 2.0 + 3.5, "b", t->id);
}

static int lanes_of(const picture *p, const row *r) {
    const fw_schedule_shop *shop = p->s->shop;
    if (r->kind == HOLD) return shop->wafers;
    return r->kind == MACHINE && shop->machine[r->index].places > 1 ? shop->wafers : 0;
}

/* when wafer w waited: from the end of one step to the start of the other */
static void waited(const picture *p, const fw_schedule_hold *h, int w, double *from, double *to) {
    for (int i = 0; i < p->s->nrun; i++) {
        const fw_schedule_run *run = &p->s->run[i];
        if (w < run->first || w >= run->first + run->count) continue;
        if (run->task == h->from) *from = run->end_s;
        if (run->task == h->to) *to = run->start_s;
    }
}

/* a moment is in the panel too */
static bool in_panel(const picture *p, double from, double to) {
    return from < p->next_s - 1e-6 && to >= p->open_s - 1e-6;
}

/* is anything of the row in the panel? */
static bool in_use(const picture *p, const row *r) {
    const fw_schedule_shop *shop = p->s->shop;
    if (r->kind == PERSON) return true;
    for (int w = 0; r->kind == HOLD && w < shop->wafers; w++) {
        double from = 0.0, to = 0.0;
        waited(p, &shop->hold[r->index], w, &from, &to);
        if (in_panel(p, from, to)) return true;
    }
    for (int i = 0; r->kind == MACHINE && i < p->s->nrun; i++) {
        const fw_schedule_run *run = &p->s->run[i];
        if (shop->task[run->task].machine == r->index && meets(p, run->start_s, run->end_s))
            return true;
    }
    return false;
}

static void add_row(picture *p, row_kind kind, int index) {
    row *r = &p->row[p->nrow];
    *r = (row){.kind = kind, .index = index};
    if (p->nrow == MOST_ROWS || !in_use(p, r)) return;
    int lanes = lanes_of(p, r);
    r->height = lanes * LANE + 4.0 > ROW ? lanes * LANE + 4.0 : ROW;
    r->y = p->nrow ? p->row[p->nrow - 1].y + p->row[p->nrow - 1].height : p->y + 34.0;
    if (p->nrow && p->row[p->nrow - 1].kind != kind) r->y += 5.0;
    p->nrow++;
}

static void rows_of(picture *p) {
    const fw_schedule_shop *shop = p->s->shop;
    p->nrow = 0;
    for (int i = 0; i < shop->nmachine; i++)
        add_row(p, MACHINE, i);
    for (int i = 0; i < shop->operators; i++)
        add_row(p, PERSON, i);
    for (int i = 0; i < shop->nhold; i++)
        if (isfinite(shop->hold[i].max_s) && !shop->hold[i].implied) add_row(p, HOLD, i);
}

static void row_label(const picture *p, const row *r) {
    const fw_schedule_shop *shop = p->s->shop;
    fw_text text = fw_text_new(p->out->arena);
    if (r->kind == MACHINE) {
        const char *title = shop->machine[r->index].title;
        size_t n = strcspn(title, ","); /* the whole of it is in the CSV */
        fw_text_bytes(&text, title, n < 32 ? n : 32);
    } else if (r->kind == PERSON)
        fw_text_printf(&text, "operator %d", r->index + 1);
    else {
        const fw_schedule_hold *h = &shop->hold[r->index];
        fw_text_printf(&text, "%s \xe2\x86\x92 %s within ", shop->task[h->from].id,
                       shop->task[h->to].id);
        fw_schedule_put_duration(&text, h->max_s);
    }
    if (fw_text_end(&text) != FW_OK) {
        p->out->failed = 1;
        return;
    }
    label(p->out, LABELS - 6, r->y + r->height / 2.0 + 3.5, "l", text.data);
}

/* what a wafer waited, in its colour, and what it might still have waited */
static void windows(const picture *p, const row *r) {
    const fw_schedule_shop *shop = p->s->shop;
    const fw_schedule_hold *h = &shop->hold[r->index];
    for (int w = 0; w < shop->wafers; w++) {
        double from = 0.0, to = 0.0, y = r->y + 2.0 + LANE * w;
        waited(p, h, w, &from, &to);
        if (!in_panel(p, from, to)) continue;
        double deadline = fmin(from + h->max_s, p->s->start_s + p->s->makespan_s);
        if (deadline > to && in_panel(p, to, to))
            fw_svg_put(p->out, BOX " fill='none' stroke='#999' stroke-width='0.5'\n", px(p, to),
                       y + 1.0, fmax(px(p, deadline) - px(p, to), LEAST), LANE - 3.0);
        if (meets(p, from, to) && to > from)
            fw_svg_put(p->out, BOX " fill='{r}'\n", px(p, from), y,
                       fmax(px(p, to) - px(p, from), LEAST), LANE - 1.0, colour[w % COLOURS]);
    }
}

static const char HATCH[] = "fill='url(#closed)'";

/* when the machine is closed in the panel */
static void closed(const picture *p, const row *r) {
    const fw_schedule_machine *m = &p->s->shop->machine[r->index];
    if (!m->nhours && !m->nclosed) return;
    for (double t = p->open_s; t < p->next_s - 1.0;) {
        double open = fw_schedule_machine_fit(m, t, 1.0), to = fmin(open, p->next_s);
        if (to > t)
            fw_svg_put(p->out, BOX " {r}\n", px(p, t), r->y, px(p, to) - px(p, t), r->height,
                       HATCH);
        t = isfinite(open) ? fw_schedule_machine_closes(m, open) : open;
    }
}

static void draw_row(const picture *p, const row *r) {
    row_label(p, r);
    if (r->kind == HOLD) {
        windows(p, r);
        return;
    }
    if (r->kind == MACHINE) closed(p, r);
    for (int i = 0; i < p->s->nrun; i++) {
        const fw_schedule_run *run = &p->s->run[i];
        const fw_schedule_task *t = &p->s->shop->task[run->task];
        const double lead = r->kind == PERSON ? fw_schedule_task_attended_from_s(t) : 0.0,
                     start = run->start_s + lead;
        double end = r->kind == PERSON ? start + t->attended_s : run->end_s;
        bool here = r->kind == PERSON ? run->operator_ == r->index : t->machine == r->index;
        if (!here || !meets(p, start, end)) continue;
        if (lanes_of(p, r))
            bar(p, run, start, end, r->y + 2.0 + LANE * run->first, (double)LANE * run->count);
        else
            bar(p, run, start, end, r->y + 2.0, r->height - 4.0);
    }
}

static void grid(const picture *p, double bottom, const char *title) {
    fw_text *out = p->out;
    double top = p->y + 30.0, hour = 3600.0 * ((p->close_s - p->open_s) > 16 * 3600.0 ? 2.0 : 1.0);
    label(out, 10, p->y + 24.0, "d", title);
    if (p->next_s > p->close_s) {
        fw_svg_put(out, BOX " fill='#e9ebef'\n", (double)(LABELS + DAY), top, (double)NIGHT,
                   bottom - top);
        label(out, LABELS + DAY + NIGHT / 2.0, p->y + 24.0, "t", "night");
    }
    for (double t = ceil(p->open_s / hour) * hour; t <= p->close_s + 1e-6; t += hour) {
        char text[16];
        const fw_schedule_calendar *c = &p->s->shop->calendar;
        long minutes = lround(fw_schedule_calendar_clock(c, t) / 60.0) % 1440;
        snprintf(text, sizeof text, "%02ld:%02ld", minutes / 60, minutes % 60);
        fw_svg_put(out, "path class='g' d='M{2} {2}V{2}'\n", px(p, t), top, bottom);
        label(out, px(p, t), p->y + 24.0, "t", text);
    }
    for (int i = 0; i < p->nrow; i++) {
        const row *r = &p->row[i];
        fw_svg_put(out, BOX " fill='none' stroke='#ddd' stroke-width='0.5'\n", (double)LABELS, r->y,
                   (double)(width_px - 20 - LABELS - (p->next_s > p->close_s ? 0 : NIGHT)),
                   r->height);
    }
}

static void panel(picture *p, const char *title) {
    rows_of(p);
    double bottom = p->nrow ? p->row[p->nrow - 1].y + p->row[p->nrow - 1].height : p->y + 40.0;
    grid(p, bottom, title);
    for (int i = 0; i < p->nrow; i++)
        draw_row(p, &p->row[i]);
    p->y = bottom + 16.0;
}

static bool anything(const picture *p) {
    for (int i = 0; i < p->s->nrun; i++)
        if (p->s->run[i].start_s < p->next_s - 1e-6 && p->s->run[i].end_s > p->open_s + 1e-6)
            return true;
    return false;
}

/* working days with their nights, or pieces of twelve hours round the clock */
static void panels(picture *p) {
    static const char *const name[] = {"Monday", "Tuesday",  "Wednesday", "Thursday",
                                       "Friday", "Saturday", "Sunday"};
    const fw_schedule_calendar *c = &p->s->shop->calendar;
    double end = p->s->start_s + p->s->makespan_s;
    if (fw_schedule_calendar_round(c)) {
        double piece = fmin(12.0, fmax(1.0, ceil(end / 3600.0))) * 3600.0;
        for (double t = 0.0; t < end - 1e-6; t += piece) {
            char title[40];
            p->open_s = t;
            p->close_s = p->next_s = t + piece;
            snprintf(title, sizeof title, "day %d",
                     (int)(fw_schedule_calendar_clock(c, t) / 86400.0) + 1);
            if (anything(p)) panel(p, title);
        }
        return;
    }
    for (double t = fw_schedule_calendar_fit(c, 0.0, 1.0); t < end - 1e-6; t = p->next_s) {
        char title[40];
        int day = (int)(fw_schedule_calendar_clock(c, t) / 86400.0);
        p->open_s = fw_schedule_calendar_elapsed(c, day * 86400.0 + c->open_s);
        p->close_s = fw_schedule_calendar_elapsed(c, day * 86400.0 + c->close_s);
        p->next_s = fw_schedule_calendar_fit(c, p->close_s, 1.0);
        snprintf(title, sizeof title, "day %d, %s", day + 1,
                 name[fw_schedule_calendar_weekday(c, day)]);
        if (anything(p)) panel(p, title);
    }
}

/* sentences broken to lines of the picture's width */
static double paragraph(fw_text *out, double y, const char *text) {
    const size_t most = 175;
    while (*text) {
        size_t n = strlen(text), cut = n;
        if (n > most)
            for (cut = most; cut > 0 && text[cut] != ' ';)
                cut--;
        if (cut == 0) cut = n;
        fw_svg_open(out, "text x='10' class='p' y='{2}'", y);
        fw_text_bytes(out, text, cut); /* escaped already */
        fw_svg_close(out, "text\n");
        text += cut + (text[cut] == ' ');
        y += 15.0;
    }
    return y;
}

static bool any_hours(const fw_schedule_shop *shop) {
    for (int i = 0; i < shop->nmachine; i++)
        if (shop->machine[i].nhours + shop->machine[i].nclosed > 0) return true;
    return false;
}

/* lines across what is closed: grey alone is the night's */
static void hatch(fw_text *out) {
    fw_svg_open(out, "pattern id='closed' width='6' height='6' patternUnits='userSpaceOnUse' "
                     "patternTransform='rotate(45)'");
    fw_svg_put(out, "path d='M0 0V6' stroke='#888' stroke-width='1.6'");
    fw_svg_close(out, "pattern\n");
}

static void legend(fw_text *out, const fw_schedule_shop *shop, double y) {
    int wafers = shop->wafers;
    label(out, 10, y + 10.0, "p", "wafer");
    for (int w = 0; w < wafers; w++) {
        char text[16];
        snprintf(text, sizeof text, "%d", w + 1);
        fw_svg_put(out, BOX " fill='{r}' stroke='#333' stroke-width='0.5'\n", 52.0 + 24.0 * w, y,
                   22.0, 14.0, colour[w % COLOURS]);
        label(out, 63.0 + 24.0 * w, y + 11.0, "b", text);
    }
    label(out, 66.0 + 24.0 * wafers, y + 10.0, "p",
          any_hours(shop)
              ? "a load has a band for every wafer; dashed: the time is not known; hatched: "
                "the machine is closed; below: windows, waited and allowed"
              : "a load has a band for every wafer; dashed: the time is not known; below: "
                "windows, waited and allowed");
}

fw_status fw_recipe_write_schedule_svg(const fw_process_flow *flow, const fw_recipe_header *header,
                                       fw_text *out) {
    const fw_schedule *s = header->schedule;
    fw_text body = fw_text_new(out->arena), words = fw_text_new(out->arena);
    picture *p = fw_arena_one(out->arena, picture);
    FW_NEED(p);
    *p = (picture){.s = s, .out = &body};
    fw_text_add(&words, "");
    fw_recipe_put_schedule_summary(&words, s);
    FW_TRY(fw_text_end(&words));
    const char *title = fw_arena_printf(
        out->arena, "%sSchedule: %s%s%s", header->rejected ? "REJECTED. " : "", flow->title,
        header->device ? ", " : "", header->device ? header->device : "");
    FW_NEED(title);
    label(&body, 10, 24, "h", title);
    p->y = paragraph(&body, 44, words.data);
    legend(&body, s->shop, p->y);
    p->y += 16.0;
    panels(p);
    FW_TRY(fw_text_end(&body));
    fw_svg_begin(
        out, &(fw_svg_frame){.width = width_px, .height = floor(p->y), .size = FW_SVG_SIZE_BEHIND});
    fw_svg_put(out,
               "style>text{font:11px Helvetica,Arial,sans-serif}.h{font-size:15px;"
               "font-weight:bold}.l{text-anchor:end}.t,.b{text-anchor:middle}.b{font-size:10px;"
               "pointer-events:none}.d{font-weight:bold}.t{fill:#555;font-size:10px}"
               ".g{stroke:#ddd;stroke-width:0.5;fill:none}\n");
    fw_svg_paper(out, "#fff");
    if (any_hours(s->shop)) hatch(out);
    fw_text_add(out, body.data);
    fw_svg_end(out);
    return fw_text_end(out);
}

/* ---- on the run sheet ---- */

/* what the wafer is like, where that is what limits the pause after a task */
static void put_why(fw_text *out, const fw_schedule_shop *shop, int task, double pause_s) {
    for (int k = 0; k < shop->nhold; k++) {
        const fw_schedule_hold *h = &shop->hold[k];
        if (!h->why || h->from > task || h->to <= task || h->max_s > pause_s * (1 + 1e-9) + 1.0)
            continue;
        fw_text_add(out, ", ");
        fw_text_escaped(out, h->why);
        return;
    }
}

/* "safe stopping points" of the flow, with the longest pause at each; escaped */
static void put_stops(fw_text *out, const fw_schedule *s) {
    const fw_schedule_shop *shop = s->shop;
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
            fw_schedule_put_duration(out, fmax(0.0, pause));
            put_why(out, shop, i, pause);
            fw_text_add(out, ")");
        }
    }
}

/* a line for the one wafer: every step and when it begins */
static void one_wafer(fw_text *out, const fw_schedule *s) {
    double day = -1.0;
    fw_text_add(out, "<p class=\"small\"><b>Begins:</b> ");
    for (int k = 0; k < s->nrun; k++) {
        const fw_schedule_run *r = &s->run[k];
        const double clock_s = fw_schedule_calendar_clock(&s->shop->calendar, r->start_s);
        long minutes = lround(clock_s / 60.0);
        fw_text_add(out, k ? ", " : "");
        fw_text_escaped(out, s->shop->task[r->task].id);
        fw_text_add(out, s->shop->task[r->task].unknown ? " (time unknown) " : " ");
        if (floor(clock_s / 86400.0) > day)
            fw_recipe_put_moment(out, &s->shop->calendar, r->start_s);
        else
            fw_text_printf(out, "%02ld:%02ld", minutes / 60 % 24, minutes % 60);
        day = floor(clock_s / 86400.0);
    }
    fw_text_add(out, ".</p>\n");
}

/* with its day where that is another one than that of the moment before; *day is kept */
static void put_after(fw_text *out, const fw_schedule_calendar *c, double seconds, long *day) {
    const long minutes = lround(fw_schedule_calendar_clock(c, seconds) / 60.0);
    if (minutes / 1440 != *day)
        fw_recipe_put_moment(out, c, seconds);
    else
        fw_text_printf(out, "%02ld:%02ld", minutes / 60 % 24, minutes % 60);
    *day = minutes / 1440;
}

static void all_wafers(fw_text *out, const fw_schedule *s) {
    const bool several = s->shop->operators > 1;
    fw_text_printf(out,
                   "<table class=\"small\"><thead><tr><th>Step</th><th>Wafers: start to end"
                   "%s</th></tr></thead><tbody>\n",
                   several ? " (operator)" : "");
    for (int i = 0; i < s->shop->ntask; i++) {
        int n = 0;
        long day = -1;
        fw_text_add(out, "<tr><td class=\"id\">");
        fw_text_escaped(out, s->shop->task[i].id);
        fw_text_add(out, s->shop->task[i].unknown ? " (time unknown)</td><td>" : "</td><td>");
        for (int k = 0; k < s->nrun; k++) {
            const fw_schedule_run *r = &s->run[k];
            if (r->task != i) continue;
            fw_text_add(out, n++ ? "; " : "");
            fw_recipe_put_wafers(out, r);
            fw_text_add(out, ": ");
            put_after(out, &s->shop->calendar, r->start_s, &day);
            fw_text_add(out, " to ");
            put_after(out, &s->shop->calendar, r->end_s, &day);
            if (several && r->operator_ >= 0) fw_text_printf(out, " (%d)", r->operator_ + 1);
        }
        fw_text_add(out, "</td></tr>\n");
    }
    fw_text_add(out, "</tbody></table>\n");
}

void fw_recipe_html_schedule(const fw_recipe_header *header, fw_text *out) {
    const fw_schedule *s = header->schedule;
    if (!s) return;
    fw_text_add(out, "<h3>Schedule</h3>\n<p class=\"small\">");
    fw_recipe_put_schedule_summary(out, s);
    fw_text_add(out, "</p>\n");
    if (!s->pause_s) return;
    fw_text_add(out, "<p class=\"small\"><b>Safe stopping points</b>, where every wafer is dry and "
                     "safe and no hold window of the process file is running: ");
    put_stops(out, s);
    fw_text_add(out, " (longest pause that the windows and the wafers allow).</p>\n");
    if (!s->feasible) return;
    if (s->shop->wafers == 1)
        one_wafer(out, s);
    else
        all_wafers(out, s);
}
