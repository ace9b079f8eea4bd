/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Guess and assembled position side by side: every body in its own colour in both, open joints in
   red with their size. Bodies are their outlines where they are drawn, else as in figure.h. */
#include "report/report.h"
#include "base/constants.h"
#include "report/figure.h"
#include <math.h>
#include <string.h>

enum { PANEL = 470, GUTTER = 20, HEAD = 44, FOOT = 64, MOST_LABELS = 40 };

static const char *const open_colour = "#C00000";

typedef struct label_list { /* centres of the labels so far: later ones keep clear of them */
    fw_geometry_vec2 at[MOST_LABELS];
    int count;
} label_list;

typedef struct panel {
    const fw_report_assembly *in;
    const fw_report_drawing_figure *figure;
    const double *q; /* (3 nbody) pose shown */
    fw_report_view view;
    bool guess;
    double mark; /* pixel: size of joints */
} panel;

static const char *name_of(const char *id) {
    return id ? id : "?";
}

static fw_geometry_vec2 place(const double *q, int body, double x, double y) {
    if (body == FW_GROUND) return (fw_geometry_vec2){x, y};
    double c = cos(q[3 * body + 2]), s = sin(q[3 * body + 2]);
    return (fw_geometry_vec2){q[3 * body] + c * x - s * y, q[3 * body + 1] + s * x + c * y};
}

/* ---- bodies and joints ---- */

/* the outlines are those of the guess; they move as rigid bodies, in picture coordinates */
static void outline(const panel *p, const double *q, int body, fw_text *out) {
    const double *drawn = p->in->assembly->before + 3 * body, *now = q + 3 * body;
    double turn = -(now[2] - drawn[2]) * 180.0 / FW_PI; /* y points down */
    fw_svg_open(out, "g transform='translate({c} {c}) rotate({6}) translate({c} {c})'",
                fw_report_x(&p->view, now[0]), fw_report_y(&p->view, now[1]), turn,
                -fw_report_x(&p->view, drawn[0]), -fw_report_y(&p->view, drawn[1]));
    fw_svg_path(out, "");
    fw_report_body_path(p->in->layout, body, &p->view, out);
    fw_svg_finish(out, "/>");
    fw_svg_close(out, "g\n");
}

/* where the bodies were, behind where they are */
static void draw_ghosts(const panel *p, const fw_report_figure_pen *pen, fw_text *out) {
    const fw_report_assembly *in = p->in;
    if (in->assembly->most_moved_m == 0.0 && in->assembly->most_turned_rad == 0.0) return;
    fw_svg_open(out, "g fill='none' stroke='#aab2ba' stroke-width='1' stroke-dasharray='4 3'\n");
    for (int b = 0; b < in->mechanism->nbody; b++)
        if (fw_report_outlined(in->layout, b)) outline(p, in->assembly->before, b, out);
    for (int i = 0; i < p->figure->count; i++)
        if (!fw_report_outlined(in->layout, p->figure->part[i].of))
            fw_report_figure_ghost(&p->figure->part[i], in->assembly->before, pen);
    fw_svg_close(out, "g\n");
}

static void draw_outlines(const panel *p, fw_text *out) {
    for (int b = 0; b < p->in->mechanism->nbody; b++) {
        if (!fw_report_outlined(p->in->layout, b)) continue;
        fw_svg_open(out, "g fill='{r}' fill-opacity='0.35' stroke='{r}' stroke-width='1'",
                    fw_report_figure_colour(b), fw_report_figure_colour(b));
        outline(p, p->q, b, out);
        fw_svg_close(out, "g\n");
    }
}

static void draw_figure(const panel *p, const fw_report_figure_pen *pen) {
    for (int i = 0; i < p->figure->count; i++) {
        const fw_report_figure_part *part = &p->figure->part[i];
        bool body = part->role == FW_FIGURE_BODY || part->role == FW_FIGURE_PLATE;
        if (part->role == FW_FIGURE_PIN) continue; /* open ones look different: draw_pins */
        if (!body || !fw_report_outlined(p->in->layout, part->of)) fw_report_figure_draw(part, pen);
    }
}

static void dot(const panel *p, double x, double y, bool open, fw_text *out) {
    fw_svg_put(out,
               "circle cx='{c}' cy='{c}' r='{c}' fill='#fff' stroke='{r}' stroke-width='1.6'\n", x,
               y, 0.75 * p->mark, open ? open_colour : "#1f2328");
}

static void draw_pins(const panel *p, fw_text *out) {
    const fw_mechanism *m = p->in->mechanism;
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *pin = &m->pin[i];
        fw_geometry_vec2 a = place(p->q, pin->body_a, pin->ax_m, pin->ay_m);
        fw_geometry_vec2 b = place(p->q, pin->body_b, pin->bx_m, pin->by_m);
        double ax = fw_report_x(&p->view, a.x), ay = fw_report_y(&p->view, a.y);
        double bx = fw_report_x(&p->view, b.x), by = fw_report_y(&p->view, b.y);
        bool open = hypot(ax - bx, ay - by) > 0.5;
        dot(p, ax, ay, open, out);
        if (open) dot(p, bx, by, true, out);
    }
}

static void halo_text(fw_text *out, double x, double y, double size, const char *colour,
                      const char *weight, const char *anchor) {
    fw_svg_open(out,
                "text x='{c}' y='{c}' font-size='{c}' font-weight='{r}' text-anchor='{r}' "
                "fill='{r}' stroke='#fff' stroke-width='3' paint-order='stroke'",
                x, y, size, weight, anchor, colour);
}

static fw_geometry_vec2 middle_of(const panel *p) {
    const fw_mechanism *m = p->in->mechanism;
    fw_geometry_vec2 sum = {0, 0};
    for (int b = 0; b < m->nbody; b++) {
        sum.x += fw_report_x(&p->view, p->q[3 * b]) / m->nbody;
        sum.y += fw_report_y(&p->view, p->q[3 * b + 1]) / m->nbody;
    }
    return sum;
}

/* moved away from the line until no other label is under it */
static fw_geometry_vec2 free_spot(label_list *taken, fw_geometry_vec2 at, double nx, double ny) {
    for (int tries = 0; tries < 6; tries++) {
        bool clear = true;
        for (int i = 0; i < taken->count && clear; i++)
            clear = fabs(taken->at[i].x - at.x) > 58 || fabs(taken->at[i].y - at.y) > 12;
        if (clear) break;
        at.x += 14 * nx, at.y += 14 * (fabs(ny) > 0.2 ? ny : 1);
    }
    if (taken->count < MOST_LABELS) taken->at[taken->count++] = at;
    return at;
}

static void gap_line(const panel *p, fw_geometry_vec2 from, fw_geometry_vec2 to, label_list *taken,
                     fw_text *out) {
    double ax = fw_report_x(&p->view, from.x), ay = fw_report_y(&p->view, from.y);
    double bx = fw_report_x(&p->view, to.x), by = fw_report_y(&p->view, to.y);
    if (!(hypot(ax - bx, ay - by) > 0.5)) return;
    fw_svg_put(out,
               "path d='M{c} {c}L{c} {c}' stroke='{r}' stroke-width='1.6' stroke-dasharray='2 2' "
               "fill='none'\n",
               ax, ay, bx, by, open_colour);
    double mx = 0.5 * (ax + bx), my = 0.5 * (ay + by);
    /* beside the line, towards the middle of the mechanism: names of joints stand outside */
    double d = hypot(bx - ax, by - ay), nx = (by - ay) / d, ny = -(bx - ax) / d;
    fw_geometry_vec2 c = middle_of(p);
    if (nx * (c.x - mx) + ny * (c.y - my) < 0) nx = -nx, ny = -ny;
    fw_geometry_vec2 at = {mx + (fabs(nx) > 0.3 ? (nx > 0 ? 36 : -36) : 0), my + 11 * ny};
    at = free_spot(taken, at, nx, ny);
    at.x = fmax(34, fmin(PANEL - 34, at.x));
    halo_text(out, at.x, at.y + 4, 11, open_colour, "600", "middle");
    fw_markup(out, "{u}", hypot(from.x - to.x, from.y - to.y), "m");
    fw_svg_close(out, "text\n");
}

/* pins and welds: point to point; sliding joints: point b to its line; rods: what is missing or too
   much at point b */
static void draw_gaps(const panel *p, fw_text *out) {
    const fw_mechanism *m = p->in->mechanism;
    label_list taken = {.count = 0};
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *k = &m->pin[i];
        gap_line(p, place(p->q, k->body_a, k->ax_m, k->ay_m),
                 place(p->q, k->body_b, k->bx_m, k->by_m), &taken, out);
    }
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        fw_geometry_vec2 a = place(p->q, t->body_a, t->ax_m, t->ay_m);
        fw_geometry_vec2 b = place(p->q, t->body_b, t->bx_m, t->by_m), to = a;
        double dx = b.x - a.x, dy = b.y - a.y, d = hypot(dx, dy);
        double axis = t->axis_rad + (t->body_a == FW_GROUND ? 0 : p->q[3 * t->body_a + 2]);
        double along = cos(axis) * dx + sin(axis) * dy;
        if (t->kind == FW_JOINT_PRISMATIC)
            to = (fw_geometry_vec2){a.x + along * cos(axis), a.y + along * sin(axis)};
        else if (t->kind == FW_JOINT_DISTANCE && d > 0)
            to = (fw_geometry_vec2){a.x + t->length_m / d * dx, a.y + t->length_m / d * dy};
        bool driven = false; /* a driven rod has the length that its driver asks for */
        for (int k = 0; k < m->ndriver; k++)
            driven = driven || (m->driver[k].joint == i && t->kind == FW_JOINT_DISTANCE);
        if (!driven) gap_line(p, to, b, &taken, out);
    }
}

/* ---- labels ---- */

/* where a name goes that stands for a joint: point b of a pin or joint, in the picture */
static fw_geometry_vec2 joint_at(const panel *p, int i, const char **id) {
    const fw_mechanism *m = p->in->mechanism;
    fw_geometry_vec2 w;
    if (i < m->npin) {
        w = place(p->q, m->pin[i].body_b, m->pin[i].bx_m, m->pin[i].by_m);
        *id = name_of(m->pin[i].id);
    } else {
        const fw_device_joint *t = &m->joint[i - m->npin];
        w = place(p->q, t->body_b, t->bx_m, t->by_m);
        *id = name_of(t->id);
    }
    return (fw_geometry_vec2){fw_report_x(&p->view, w.x), fw_report_y(&p->view, w.y)};
}

static bool near(fw_geometry_vec2 a, fw_geometry_vec2 b) {
    return hypot(a.x - b.x, a.y - b.y) < 4;
}

/* joints on one spot share one label */
static void joint_labels(const panel *p, fw_geometry_vec2 middle, fw_text *out) {
    const fw_mechanism *m = p->in->mechanism;
    int n = m->npin + m->njoint;
    const char *id;
    for (int i = 0; i < n; i++) {
        fw_geometry_vec2 at = joint_at(p, i, &id);
        bool told = false;
        for (int k = 0; k < i && !told; k++)
            told = near(at, joint_at(p, k, &id));
        if (told) continue;
        double dx = at.x - middle.x, dy = at.y - middle.y, d = hypot(dx, dy);
        dx = d > 1e-9 ? dx / d : 0, dy = d > 1e-9 ? dy / d : -1; /* outwards */
        double room = 0;                                         /* about what the names need */
        for (int k = i; k < n; k++)
            if (near(at, joint_at(p, k, &id))) room += 9.0 * (double)strlen(id) + (k > i ? 4 : 0);
        double side = dx > 0.5 ? 0.5 : dx < -0.5 ? -0.5 : 0;
        double x = at.x + 15 * dx + side * room, y = at.y + 17 * dy + 5;
        if (x < room / 2 + 4 || x > PANEL - room / 2 - 4) y = at.y - 14; /* no room beside it */
        x = fmax(room / 2 + 4, fmin(PANEL - room / 2 - 4, x));
        y = fmax(14, fmin(p->view.height - 6, y));
        halo_text(out, x, y, 13, "#1f2328", "700", "middle");
        for (int k = i; k < n; k++)
            if (near(at, joint_at(p, k, &id))) fw_markup(out, "{r}{s}", k > i ? " " : "", id);
        fw_svg_close(out, "text\n");
    }
}

/* on the line or outline rather than at the centre of mass */
static fw_geometry_vec2 label_place(const panel *p, int body) {
    fw_geometry_vec2 at = {p->q[3 * body], p->q[3 * body + 1]};
    for (int i = 0; i < p->figure->count; i++) {
        const fw_report_figure_part *f = &p->figure->part[i];
        if (f->role != FW_FIGURE_BODY || f->of != body || fw_report_outlined(p->in->layout, body))
            continue;
        at = (fw_geometry_vec2){0, 0};
        for (int k = 0; k < f->noutline; k++) {
            fw_geometry_vec2 w = place(p->q, body, f->outline[k].x, f->outline[k].y);
            double share = f->noutline > 2 ? 1.0 / f->noutline : k ? 0.35 : 0.65;
            at.x += share * w.x, at.y += share * w.y; /* the middle of a line may be a joint */
        }
    }
    return at;
}

static bool on_joint(const panel *p, fw_geometry_vec2 at) {
    const char *id;
    for (int i = 0; i < p->in->mechanism->npin + p->in->mechanism->njoint; i++) {
        fw_geometry_vec2 joint = joint_at(p, i, &id);
        if (hypot(joint.x - at.x, joint.y - at.y) < 2 * p->mark) return true;
    }
    return false;
}

static void draw_labels(const panel *p, fw_text *out) {
    const fw_mechanism *m = p->in->mechanism;
    if (m->nbody + m->npin > MOST_LABELS) return;
    for (int b = 0; b < m->nbody; b++) {
        fw_geometry_vec2 at = label_place(p, b);
        double x = fw_report_x(&p->view, at.x), y = fw_report_y(&p->view, at.y) + 4;
        if (on_joint(p, (fw_geometry_vec2){x, y - 4})) y += 4 * p->mark;
        halo_text(out, x, y, 11, "#424a53", "400", "middle");
        fw_markup(out, "{s}", name_of(m->body[b].id));
        fw_svg_close(out, "text\n");
    }
    joint_labels(p, middle_of(p), out);
}

/* ---- the picture ---- */

static fw_geometry_box reach(const panel *p) {
    const fw_mechanism *m = p->in->mechanism;
    fw_geometry_box box = fw_report_box_empty();
    for (int i = 0; i < p->figure->count; i++)
        fw_report_figure_reach(&box, &p->figure->part[i], p->q, 1, m->nbody);
    for (int i = 0; i < m->npin; i++) { /* both ends: they may be apart */
        fw_geometry_vec2 b = place(p->q, m->pin[i].body_b, m->pin[i].bx_m, m->pin[i].by_m);
        fw_report_box_add(&box, b.x, b.y);
    }
    double size = fmax(box.x1 - box.x0, box.y1 - box.y0), pad = 0.13 * size;
    return (fw_geometry_box){box.x0 - pad, box.y0 - pad, box.x1 + pad, box.y1 + pad};
}

static double wide(fw_geometry_box b) {
    return b.x1 - b.x0;
}

static double high(fw_geometry_box b) {
    return b.y1 - b.y0;
}

/* the same frame for both where they are of like size and near each other; a guess strewn far and
   wide, or collapsed, gets its own. Both panels are equally high. */
static void choose_views(panel *p) {
    fw_geometry_box box[2] = {reach(&p[0]), reach(&p[1])}, both = box[0];
    fw_report_box_add(&both, box[1].x0, box[1].y0);
    fw_report_box_add(&both, box[1].x1, box[1].y1);
    double size = fmax(wide(box[1]), high(box[1]));
    if (fmax(wide(both), high(both)) < 2.5 * size) box[0] = box[1] = both;
    double tall = 0.35 * PANEL;
    for (int i = 0; i < 2; i++) {
        p[i].view = fw_report_view_fit(box[i], PANEL, 0.0);
        tall = fmax(tall, p[i].view.height);
    }
    for (int i = 0; i < 2; i++) {
        p[i].view.y1_m += 0.5 * (tall - p[i].view.height) / p[i].view.scale;
        p[i].view.height = tall;
    }
}

static void draw_panel(const panel *p, const char *letter, const char *title, double x,
                       fw_text *out) {
    fw_svg_open(out, "text x='{c}' y='28' font-size='15' font-weight='700' fill='#1f2328'", x);
    fw_markup(out, "{r} ", letter);
    fw_svg_put(out, "tspan font-weight='400'>{r}", title);
    fw_svg_close(out, "text\n");
    fw_svg_inset(out, "x='{c}' y='{i}' width='{i}' height='{c}'", x, HEAD, PANEL, p->view.height);
    fw_svg_put(out, "rect width='100%' height='100%' fill='#fff' stroke='#d0d7de'\n");
    const fw_report_figure_pen pen = {.view = &p->view,
                                      .out = out,
                                      .still = p->q,
                                      .nbody = p->in->mechanism->nbody,
                                      .mark = p->mark};
    if (!p->guess) draw_ghosts(p, &pen, out);
    draw_outlines(p, out);
    draw_figure(p, &pen);
    draw_pins(p, out);
    draw_gaps(p, out);
    draw_labels(p, out);
    fw_report_scale_bar_svg(out, &p->view);
    fw_svg_end(out);
}

static void caption(const fw_report_assembly *in, double size_m, double y, fw_text *out) {
    const fw_assembly *a = in->assembly;
    bool tight = a->gap_after_m <= 1e-11 * (a->gap_before_m + size_m);
    fw_svg_open(out, "g font-size='12.5' fill='#424a53'");
    fw_svg_open(out, "text x='{i}' y='{c}'", GUTTER, y);
    if (in->closed && a->iterations == 0)
        fw_text_add(out, "the poses of the description close all joints to round-off; nothing was "
                         "moved");
    else {
        fw_markup(out, "largest open joint {u} before, ", a->gap_before_m, "m");
        if (tight)
            fw_text_add(out, "round-off after");
        else
            fw_markup(out, "{u} after", a->gap_after_m, "m");
        fw_markup(out, "; {i} iterations", a->iterations);
        if (a->restarts) fw_markup(out, ", {i} restarts", a->restarts);
        fw_markup(out, "; largest movement {u}", a->most_moved_m, "m");
        if (a->most_turned_rad > 1e-12) fw_markup(out, ", {d}", a->most_turned_rad);
    }
    fw_svg_close(out, "text\n");
    fw_svg_open(out, "text x='{i}' y='{c}'", GUTTER, y + 18);
    if (!in->closed)
        fw_svg_put(out,
                   "tspan fill='{r}' font-weight='700'>cannot be assembled: the right-hand picture "
                   "is the least mismatch that was found",
                   open_colour);
    else {
        fw_markup(out, "{i} degree{r} of freedom", a->rank.dof, a->rank.dof == 1 ? "" : "s");
        for (int i = 0; i < a->nelbow; i++)
            if (a->elbow[i].guess != a->elbow[i].found)
                fw_markup(out, "; elbow at {s} {r}", a->elbow[i].id,
                          a->elbow[i].found == 0   ? "stretched flat"
                          : a->elbow[i].guess == 0 ? "was flat"
                                                   : "on the other side than in the guess");
    }
    fw_svg_close(out, "text");
    fw_svg_close(out, "g\n");
}

fw_status fw_report_assemble_svg(fw_arena *arena, const fw_report_assembly *in, fw_text *out) {
    const fw_mechanism *m = in->mechanism;
    fw_report_drawing_figure figure[2];
    for (int i = 0; i < 2; i++)
        FW_TRY(fw_report_figure_make(arena, m, i ? in->assembly->after : in->assembly->before, 1,
                                     &figure[i]));
    panel p[2] = {{.in = in, .figure = &figure[0], .q = in->assembly->before, .guess = true},
                  {.in = in, .figure = &figure[1], .q = in->assembly->after}};
    choose_views(p);
    p[0].mark = p[1].mark = m->nbody > 30 ? 2.5 : m->nbody > 12 ? 4 : 5.5;
    double width = 2 * PANEL + 3 * GUTTER, height = HEAD + p[0].view.height + FOOT;
    fw_svg_begin_picture(out, width, height, true);
    fw_svg_title(out, "{s}: guess and assembled position", in->device->name);
    fw_svg_paper(out, "#f6f8fa");
    draw_panel(&p[0], "(a)", "guess: as the description states it", GUTTER, out);
    draw_panel(&p[1], "(b)", in->closed ? "assembled" : "least mismatch", 2 * GUTTER + PANEL, out);
    caption(in, figure[1].size_m, HEAD + p[0].view.height + 24, out);
    fw_svg_end(out);
    return fw_text_end(out);
}
