/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a picture of a device marks: the places at which its layout cannot be made, and what a
   rejection is about. */
#include "base/constants.h"
#include "report/report_page.h"
#include <math.h>
#include <string.h>

enum { MOST_ROWS = 12, ROW = 17, LETTERS = 104 };

const char fw_report_mark_colour[] = "#A50026";

static const fw_geometry_vec2 nowhere = {(double)NAN, (double)NAN};

/* ---- what is marked ---- */

typedef struct maker {
    fw_arena *arena;
    const fw_device *device;
    fw_report_marks *marks;
    int capacity;
} maker;

static fw_report_mark *add(maker *k) {
    fw_report_marks *m = k->marks;
    if (m->count == k->capacity) {
        int more = k->capacity ? 2 * k->capacity : 8;
        fw_report_mark *grown = fw_arena_array(k->arena, fw_report_mark, (size_t)more);
        if (!grown) return NULL;
        if (m->count > 0) memcpy(grown, m->item, (size_t)m->count * sizeof *grown);
        m->item = grown;
        k->capacity = more;
    }
    m->item[m->count] = (fw_report_mark){.at = nowhere};
    return &m->item[m->count++];
}

static const char *body_name(const fw_device *device, int body) {
    return body >= 0 ? device->body[body].id : body == FW_GROUND ? "ground" : "a stator";
}

/* "parts too close: BC, CD" */
static fw_status fault_label(const maker *k, const fw_layout_fault *f, const char **label) {
    const fw_diag_entry *entry = fw_diag_find(f->number);
    fw_text text = fw_text_new(k->arena);
    bool over = f->number == 120 && f->overlap.count > 0;
    fw_text_add(&text, over ? "parts that overlap" : entry ? entry->title : "");
    for (int i = 0; i < f->njoint; i++)
        fw_text_printf(&text, "%s%s",
                       i               ? ", "
                       : f->njoint > 1 ? ": hinges "
                                       : ": hinge ",
                       k->device->revolute[f->joint[i]].id);
    for (int i = 0; i < f->nbody; i++)
        fw_text_printf(&text, "%s%s", i || f->njoint ? ", " : ": ",
                       body_name(k->device, f->body[i]));
    FW_TRY(fw_text_end(&text));
    *label = text.data;
    return FW_OK;
}

static fw_status faults(maker *k, const fw_layout *layout) {
    for (int i = 0; layout && i < layout->nfault; i++) {
        const fw_layout_fault *f = &layout->fault[i];
        fw_report_mark *m = add(k);
        FW_NEED(m);
        m->number = f->number;
        m->text = f->message;
        m->at = f->at;
        m->overlap = &f->overlap;
        m->nbody = f->nbody, m->njoint = f->njoint;
        memcpy(m->body, f->body, sizeof m->body);
        memcpy(m->joint, f->joint, sizeof m->joint);
        FW_TRY(fault_label(k, f, &m->label));
    }
    return FW_OK;
}

static fw_status missing(maker *k, const fw_layout *layout) {
    for (int i = 0; layout && i < layout->nmissing; i++) {
        const fw_layout_missing *of = &layout->missing[i];
        fw_report_mark *m = add(k);
        FW_NEED(m);
        m->number = of->number;
        m->at = of->at;
        if (of->body >= 0) m->body[m->nbody++] = of->body;
        FW_NEED(m->label = fw_arena_printf(k->arena, "%s: not drawn", of->name));
        FW_NEED(m->text = fw_arena_printf(k->arena, "%s: %s%s%s", of->name, of->why,
                                          of->room ? fw_layout_missing_way(of) : "",
                                          of->room ? of->room : ""));
    }
    return FW_OK;
}

static bool marks_joint(const fw_report_marks *marks, int joint) {
    for (int i = 0; i < marks->count; i++)
        for (int n = 0; n < marks->item[i].njoint; n++)
            if (marks->item[i].joint[n] == joint) return true;
    return false;
}

static fw_status hinge(maker *k, const fw_verdict_hinge_verdict *h, int number, const char *made) {
    char used[32];
    fw_report_mark *m;
    bool over = h->decision == FW_REJECT || h->utilisation >= 1.0;
    if (!h->scene || !over || marks_joint(k->marks, h->joint)) return FW_OK;
    FW_NEED(m = add(k));
    m->number = number;
    m->joint[m->njoint++] = h->joint;
    fw_percent_text(used, sizeof used, h->utilisation);
    FW_NEED(m->label = fw_arena_printf(k->arena, "%s%s uses %s %% of its limit in %s%s%s",
                                       FW_NAMED("hinge", h->id), used, h->scene,
                                       made ? ", as made by " : "", made ? made : ""));
    m->text = m->label;
    return FW_OK;
}

/* as drawn, then the one that governs as made */
static fw_status hinges(maker *k, const fw_verdict *v) {
    for (int i = 0; i < v->nhinge; i++)
        FW_TRY(hinge(k, &v->hinge[i], 0, NULL));
    for (int i = 0; i < v->nvariant; i++) {
        const fw_verdict_fabricated_verdict *f = v->variant[i].fabricated;
        if (!f || f->governing == FW_NONE || !f->corner[f->at].hinge) continue;
        FW_TRY(hinge(k, &f->corner[f->at].hinge[f->governing], 237,
                     v->variant[i].variant->flow ? v->variant[i].variant->flow : "its material"));
    }
    return FW_OK;
}

static bool marks_pair(const fw_report_marks *marks, int a, int b) {
    for (int i = 0; i < marks->count; i++)
        if (marks->item[i].number == 294 && marks->item[i].body[0] == a &&
            marks->item[i].body[1] == b)
            return true;
    return false;
}

static const char *part_name(const char *label) {
    return label ? label : "a part";
}

/* what the verdict says of a pair in a scene */
static fw_status reason_of(const maker *k, const fw_verdict_variant_verdict *v,
                           const fw_verdict_clearance *c, const char **text) {
    const char *pair =
        fw_arena_printf(k->arena, "%s and %s ", part_name(c->least.at.a), part_name(c->least.at.b));
    FW_NEED(pair);
    for (int i = 0; i < v->nreason; i++)
        if (v->reason[i].scene == c->scene && strncmp(v->reason[i].text, pair, strlen(pair)) == 0)
            *text = v->reason[i].text;
    return FW_OK;
}

/* pairs that come too near each other: each once, at their place then */
static fw_status pairs(maker *k, const fw_verdict_variant_verdict *v) {
    for (int i = 0; i < v->nclearance; i++) {
        const fw_verdict_clearance *c = &v->clearance[i];
        const fw_clearance_least *l = &c->least;
        fw_report_mark *m;
        if (c->decision != FW_REJECT || marks_pair(k->marks, l->a, l->b)) continue;
        FW_NEED(m = add(k));
        m->number = 294;
        m->body[0] = l->a, m->body[1] = l->b, m->nbody = 2;
        m->at = l->at.at_a;
        FW_NEED(m->label = fw_arena_printf(
                    k->arena, "%s and %s %s in %s", part_name(l->at.a), part_name(l->at.b),
                    l->m <= 0 ? "meet" : "come too near each other", c->scene));
        m->text = m->label;
        FW_TRY(reason_of(k, v, c, &m->text));
    }
    return FW_OK;
}

static fw_status requirements(maker *k, const fw_verdict_variant_verdict *v) {
    for (int i = 0; i < v->nrequirement; i++) {
        const fw_verdict_requirement *r = &v->requirement[i];
        const fw_device *of = v->mechanism->device;
        const fw_device_probe *p = &of->probe[of->requirement[r->asked].probe];
        const fw_device_probe_takes takes = fw_device_probe_kinds[p->row].takes;
        bool said = false;
        fw_report_mark *m;
        for (int n = 0; n < k->marks->count; n++)
            said = said || k->marks->item[n].of == r->probe;
        if (r->decision != FW_REJECT || said) continue;
        FW_NEED(m = add(k));
        m->number = r->why ? 331 : 330;
        m->of = r->probe;
        if (takes == FW_PROBE_POINT || takes == FW_PROBE_PAIR || takes == FW_PROBE_TANGENT)
            m->at = fw_mechanism_local_place(v->mechanism, p->body, p->x_m, p->y_m);
        else if (takes == FW_PROBE_CARRIER && p->carrier == FW_CARRIER_REVOLUTE)
            m->joint[m->njoint++] = p->index;
        FW_NEED(m->label =
                    fw_arena_printf(k->arena, "what is required of %s is not met%s%s", r->probe,
                                    r->scene ? " in " : " at rest", r->scene ? r->scene : ""));
        m->text = m->label;
    }
    return FW_OK;
}

/* reasons without a place of their own */
static fw_status rest(maker *k, const fw_verdict_variant_verdict *v) {
    static const int placed[] = {237, 294, 295, 330, 331};
    for (int i = 0; i < v->nreason; i++) {
        const fw_verdict_reason *r = &v->reason[i];
        bool said = r->decision != FW_REJECT;
        for (size_t n = 0; n < sizeof placed / sizeof placed[0]; n++)
            said = said || placed[n] == r->number;
        for (int n = 0; n < k->marks->count; n++)
            said = said || k->marks->item[n].number == r->number;
        if (said) continue;
        fw_report_mark *m = add(k);
        FW_NEED(m);
        m->number = r->number;
        m->label = m->text = r->text;
    }
    return FW_OK;
}

fw_status fw_report_marks_of(fw_arena *arena, const fw_device *device, const fw_layout *layout,
                             const fw_verdict *verdict, fw_report_marks *marks) {
    *marks = (fw_report_marks){0};
    maker k = {arena, device, marks, 0};
    FW_TRY(faults(&k, layout));
    if (!verdict || verdict->decision != FW_REJECT) return FW_OK;
    FW_TRY(missing(&k, layout));
    FW_TRY(hinges(&k, verdict));
    for (int i = 0; i < verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &verdict->variant[i];
        if (!v->mechanism) continue;
        FW_TRY(pairs(&k, v));
        FW_TRY(requirements(&k, v));
        FW_TRY(rest(&k, v));
    }
    return FW_OK;
}

/* ---- how it looks ---- */

static int rows_of(const fw_report_marks *marks) {
    return marks->count > MOST_ROWS ? MOST_ROWS + 1 : marks->count;
}

double fw_report_marks_height(const fw_report_marks *marks) {
    return marks->count ? ROW * rows_of(marks) + 8.0 : 0.0;
}

/* the outlines of a body in the warning colour, over the drawing */
static void outline(const fw_layout *layout, int body, const fw_report_view *view, fw_text *out) {
    fw_svg_path(out, "class='faulty' fill='{r}' fill-opacity='0.12' stroke='{r}' stroke-width='2'",
                fw_report_mark_colour, fw_report_mark_colour);
    fw_report_body_path(layout, body, view, out);
    fw_svg_path_end(out);
}

static bool outlined_before(const fw_report_marks *marks, int upto, int body) {
    for (int i = 0; i < upto; i++)
        for (int n = 0; n < marks->item[i].nbody; n++)
            if (marks->item[i].body[n] == body) return true;
    return false;
}

static void bodies(const fw_layout *layout, const fw_report_marks *marks,
                   const fw_report_view *view, fw_text *out) {
    for (int i = 0; i < marks->count; i++)
        for (int n = 0; n < marks->item[i].nbody; n++) {
            int body = marks->item[i].body[n];
            if (body >= 0 && !outlined_before(marks, i, body)) outline(layout, body, view, out);
        }
}

static void overlaps(const fw_report_marks *marks, const fw_report_view *view, fw_text *out) {
    for (int i = 0; i < marks->count; i++) {
        const fw_geometry_region *r = marks->item[i].overlap;
        if (!r || r->count == 0) continue;
        fw_svg_path(out, "class='overlap' fill='{r}' fill-opacity='0.85'", fw_report_mark_colour);
        for (int n = 0; n < r->count; n++)
            fw_report_path(out, view, &r->contour[n]);
        fw_svg_path_end(out);
    }
}

/* a ring as large as what belongs to the hinge */
static void rings(const fw_device *device, const fw_layout *layout, const fw_report_marks *marks,
                  const fw_report_view *view, fw_text *out) {
    for (int i = 0; i < marks->count; i++)
        for (int n = 0; n < marks->item[i].njoint; n++) {
            int j = marks->item[i].joint[n];
            fw_geometry_vec2 p = fw_report_hinge_point(device, layout, j);
            bool drawn = fw_report_drawn(layout) && layout->hinge[j].drawn;
            double r = drawn ? layout->hinge[j].keep_out_m * view->scale : 0.0;
            fw_svg_put(out,
                       "circle class='faulty' cx='{c}' cy='{c}' r='{c}' fill='none' stroke='{r}' "
                       "stroke-width='2.5'\n",
                       fw_report_x(view, p.x), fw_report_y(view, p.y), fmax(r, 11.0),
                       fw_report_mark_colour);
        }
}

static fw_geometry_vec2 middle_of(const fw_layout *layout, int body) {
    fw_geometry_box box = fw_report_box_empty();
    for (int i = 0; i < layout->npiece; i++) {
        if (layout->piece[i].body != body || layout->piece[i].role != FW_ROLE_STRUCTURE) continue;
        fw_geometry_box b = fw_geometry_contour_box(&layout->piece[i].contour);
        fw_report_box_add(&box, b.x0, b.y0);
        fw_report_box_add(&box, b.x1, b.y1);
    }
    return (fw_geometry_vec2){0.5 * (box.x0 + box.x1), 0.5 * (box.y0 + box.y1)};
}

/* NaN: it has no place; one beyond the picture gives way to what it is of */
static fw_geometry_vec2 place_of(const fw_device *device, const fw_layout *layout,
                                 const fw_report_view *view, const fw_report_mark *m) {
    fw_geometry_vec2 p = m->at;
    double x = fw_report_x(view, p.x), y = fw_report_y(view, p.y);
    if (!(x >= 0.0 && x <= view->width && y >= 0.0 && y <= view->height)) p = nowhere;
    if (isnan(p.x) && m->njoint > 0) p = fw_report_hinge_point(device, layout, m->joint[0]);
    if (isnan(p.x) && m->nbody > 0 && m->body[0] >= 0 && fw_report_drawn(layout))
        p = middle_of(layout, m->body[0]);
    return p;
}

static void disc(fw_text *out, double x, double y, int number) {
    fw_svg_put(out, "circle cx='{c}' cy='{c}' r='8' fill='{r}' stroke='#fff' stroke-width='1.2'", x,
               y, fw_report_mark_colour);
    fw_svg_put(out,
               "text x='{c}' y='{c}' font-size='10.5' font-weight='700' text-anchor='middle' "
               "fill='#fff'>{i}",
               x, y + 3.7, number);
}

static void text_of(fw_text *out, const fw_report_mark *m) {
    if (m->number > 0)
        fw_svg_put(out, "title>{s} [FW-D{i}]", m->text, m->number);
    else
        fw_svg_put(out, "title>{s}", m->text);
}

/* numbers beside the places, the later ones of one place beside the earlier ones */
void fw_report_marks_tags(const fw_device *device, const fw_layout *layout,
                          const fw_report_marks *marks, const fw_report_view *view, fw_text *out) {
    enum { MOST = FW_DIAG_MOST + 20 };
    double x[MOST], y[MOST];
    if (marks->count == 0) return;
    fw_svg_open(out, "g class='marks'");
    for (int i = 0, n = 0; i < marks->count && n < MOST; i++) {
        fw_geometry_vec2 p = place_of(device, layout, view, &marks->item[i]);
        if (!isfinite(p.x) || !isfinite(p.y)) continue;
        x[n] = fmax(10.0, fmin(view->width - 10.0, fw_report_x(view, p.x) + 9.0));
        y[n] = fmax(10.0, fmin(view->height - 10.0, fw_report_y(view, p.y) - 9.0));
        for (int k = 0; k < n; k++)
            if (hypot(x[k] - x[n], y[k] - y[n]) < 16.0) x[n] = x[k] + 17.0, k = -1;
        fw_svg_open(out, "g class='mark'");
        text_of(out, &marks->item[i]);
        disc(out, x[n], y[n], i + 1);
        fw_svg_close(out, "g");
        n++;
    }
    fw_svg_close(out, "g\n");
}

/* as many letters as a row has room for, never half of one */
static fw_status shortened(fw_arena *arena, const char *text, int most, const char **out) {
    size_t n = strlen(text);
    *out = text;
    if (n <= (size_t)most) return FW_OK;
    n = (size_t)most;
    while (n > 0 && ((unsigned char)text[n] & 0xC0) == 0x80)
        n--;
    const char *cut = fw_arena_strndup(arena, text, n);
    FW_NEED(cut);
    FW_NEED(*out = fw_arena_printf(arena, "%s\xE2\x80\xA6", cut));
    return FW_OK;
}

fw_status fw_report_marks_legend(fw_arena *arena, const fw_report_marks *marks, double width,
                                 double top, fw_text *out) {
    int letters = (int)(LETTERS * width / 640.0);
    for (int i = 0; i < marks->count && i < MOST_ROWS; i++) {
        const fw_report_mark *m = &marks->item[i];
        const char *label;
        double y = top + ROW * i + 9.0;
        FW_TRY(shortened(arena, m->label, letters - (m->number > 0 ? 11 : 0), &label));
        fw_svg_open(out, "g class='mark-row'");
        text_of(out, m);
        disc(out, 18.0, y, i + 1);
        fw_svg_open(out, "text x='32' y='{c}' fill='{r}'", y + 4.0, fw_report_mark_colour);
        fw_markup(out, "{s}", label);
        if (m->number > 0) fw_text_printf(out, " [FW-D%03d]", m->number);
        fw_svg_close(out, "text");
        fw_svg_close(out, "g\n");
    }
    if (marks->count > MOST_ROWS)
        fw_svg_put(out, "text x='32' y='{c}' fill='{r}'>and {i} more, in the messages\n",
                   top + ROW * MOST_ROWS + 13.0, fw_report_mark_colour, marks->count - MOST_ROWS);
    return FW_OK;
}

void fw_report_marks_svg(const fw_device *device, const fw_layout *layout,
                         const fw_report_marks *marks, const fw_report_view *view, fw_text *out) {
    if (marks->count == 0) return;
    fw_svg_open(out, "g class='marks'");
    if (fw_report_drawn(layout)) {
        bodies(layout, marks, view, out);
        overlaps(marks, view, out);
    }
    rings(device, layout, marks, view, out);
    fw_svg_close(out, "g\n");
}
