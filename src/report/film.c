/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A mechanism that moves, as SVG elements that play by themselves: SMIL, which browsers run even
   inside <img>. Bodies by nested transforms, flexures by their outline, springs and rods by their
   end points, all linear between key frames. With 0 frames: a still picture. */
#include "report/page.h"
#include <math.h>

static const double DEGREES = 57.29577951308232;

enum { NUMBERS = 100000 };

typedef fw_report_film film;

static double instant(const film *f, int frame) {
    return f->motion->t_s[f->motion->nsample - 1] * frame / (f->frames - 1);
}

static void timing(const film *f) {
    fw_report_markup(f->out, "dur=\"{i}s\" repeatCount=\"indefinite\"", f->seconds);
}

static void rotation(fw_text *out, double rad) {
    double turn = -DEGREES * rad;
    fw_text_fixed(out, isfinite(turn) ? turn : 0.0, 3);
}

/* ---- bodies ---- */

/* opens three groups that put what is drawn at the body's drawn place to its pose at t */
static void body_at(const film *f, int body, double t_s) {
    const fw_mass *m = &f->mechanism->body[body];
    double pose[3];
    fw_report_pose_at(f->motion, body, t_s, pose);
    fw_report_markup(f->out, "<g transform=\"translate({c} {c})\"><g transform=\"rotate(",
                     fw_report_x(f->view, pose[0]), fw_report_y(f->view, pose[1]));
    rotation(f->out, pose[2] - m->phi_rad);
    fw_report_markup(f->out, ")\"><g transform=\"translate({c} {c})\">",
                     -fw_report_x(f->view, m->x_m), -fw_report_y(f->view, m->y_m));
}

/* the same, moving */
static void body_motion(const film *f, int body) {
    const fw_mass *m = &f->mechanism->body[body];
    double pose[3];
    if (f->frames == 0) {
        body_at(f, body, f->still_s);
        return;
    }
    fw_report_pose_at(f->motion, body, f->still_s, pose); /* for viewers that do not animate */
    double still = pose[2] - m->phi_rad;
    fw_report_markup(f->out,
                     "<g transform=\"translate({c} {c})\"><animateTransform "
                     "attributeName=\"transform\" type=\"translate\" ",
                     fw_report_x(f->view, pose[0]), fw_report_y(f->view, pose[1]));
    timing(f);
    fw_text_add(f->out, " values=\"");
    for (int i = 0; i < f->frames; i++) {
        fw_report_pose_at(f->motion, body, instant(f, i), pose);
        fw_report_markup(f->out, "{r}{c} {c}", i ? ";" : "", fw_report_x(f->view, pose[0]),
                         fw_report_y(f->view, pose[1]));
    }
    fw_text_add(f->out, "\"/><g transform=\"rotate(");
    rotation(f->out, still);
    fw_text_add(f->out, ")\"><animateTransform attributeName=\"transform\" type=\"rotate\" ");
    timing(f);
    fw_text_add(f->out, " values=\"");
    for (int i = 0; i < f->frames; i++) {
        fw_report_pose_at(f->motion, body, instant(f, i), pose);
        fw_text_add(f->out, i ? ";" : "");
        rotation(f->out, pose[2] - m->phi_rad);
    }
    fw_report_markup(f->out, "\"/><g transform=\"translate({c} {c})\">",
                     -fw_report_x(f->view, m->x_m), -fw_report_y(f->view, m->y_m));
}

static void body_shape(const film *f, int body) {
    if (fw_report_drawn(f->layout))
        fw_report_body_path(f->layout, body, f->view, f->out);
    else
        fw_report_body_sticks(f->device, body, f->view, f->out);
}

static void bodies(const film *f) {
    bool drawn = fw_report_drawn(f->layout);
    for (int b = 0; b < f->motion->nbody; b++) {
        bool platform = f->device->body[b].platform;
        body_motion(f, b);
        if (drawn)
            fw_report_markup(f->out,
                             "<path fill=\"{r}\" stroke=\"#57606a\" stroke-width=\"0.7\" d=\"",
                             platform ? "#bcd0e3" : "#d5dbe1");
        else
            fw_report_markup(f->out,
                             "<path fill=\"none\" stroke=\"{r}\" stroke-width=\"{i}\" "
                             "stroke-linecap=\"round\" d=\"",
                             platform ? "#7f9fbd" : "#9aa4ae", f->small ? 5 : 7);
        body_shape(f, b);
        fw_text_add(f->out, "\"/></g></g></g>\n");
    }
}

/* where the mechanism is at the first sample, dashed */
static void ghost(const film *f) {
    for (int b = 0; f->ghost && b < f->motion->nbody; b++) {
        body_at(f, b, 0.0);
        fw_text_add(f->out, "<path fill=\"none\" stroke=\"#8c959f\" stroke-width=\"1\" "
                            "stroke-dasharray=\"4 3\" d=\"");
        body_shape(f, b);
        fw_text_add(f->out, "\"/></g></g></g>\n");
    }
}

/* ---- flexures ---- */

static void outline(const film *f, const fw_report_bend *bend, double t_s) {
    for (int k = 0; k < bend->npoint; k++) {
        fw_vec2 p = fw_report_bent(f->mechanism, f->motion, bend, t_s, bend->point[k]);
        fw_report_markup(f->out, "{r}{c} {c}", k ? "L" : "M", fw_report_x(f->view, p.x),
                         fw_report_y(f->view, p.y));
    }
    fw_text_add(f->out, "Z");
}

static void flexures(const film *f, const fw_report_bends *bends) {
    int numbers = 0;
    for (int i = 0; i < bends->count; i++)
        numbers += 2 * bends->item[i].npoint;
    film coarse = *f; /* fewer key frames where outlines have many points */
    while (coarse.frames > 16 && (long)coarse.frames * numbers > NUMBERS)
        coarse.frames = coarse.frames * 3 / 4;
    for (int i = 0; i < bends->count; i++) {
        const fw_report_bend *bend = &bends->item[i];
        double u = fabs(f->motion->peak[bend->joint].angle_rad) /
                   fw_report_pin_limit(f->mechanism, bend->joint);
        const char *colour = fw_report_utilisation_colour(u);
        fw_report_markup(f->out, "<path fill=\"{r}\" stroke=\"{r}\" stroke-width=\"1.2\" d=\"",
                         colour, colour);
        outline(f, bend, f->still_s);
        if (f->frames == 0) {
            fw_text_add(f->out, "\"/>\n");
            continue;
        }
        fw_text_add(f->out, "\"><animate attributeName=\"d\" ");
        timing(f);
        fw_text_add(f->out, " values=\"");
        for (int k = 0; k < coarse.frames; k++) {
            fw_text_add(f->out, k ? ";" : "");
            outline(f, bend, instant(&coarse, k));
        }
        fw_text_add(f->out, "\"/></path>\n");
    }
}

/* ---- joints, springs, rods ---- */

/* where the local point (x, y) of a body is; points of the ground are in the world already */
static fw_vec2 place(const film *f, int body, double x, double y, double t_s) {
    double pose[3];
    fw_report_pose_at(f->motion, body, t_s, pose);
    double c = cos(pose[2]), s = sin(pose[2]);
    return (fw_vec2){pose[0] + c * x - s * y, pose[1] + s * x + c * y};
}

static void pins(const film *f) {
    for (int k = 0; k < f->motion->npin; k++) {
        if (fw_report_drawn(f->layout) && f->layout->hinge && f->layout->hinge[k].drawn) continue;
        const fw_pin *pin = &f->mechanism->pin[k];
        fw_vec2 p = place(f, pin->body_a, pin->ax_m, pin->ay_m, f->still_s);
        fw_report_markup(f->out,
                         "<circle r=\"{c}\" fill=\"#fff\" stroke=\"#1f2328\" stroke-width=\"1.5\" "
                         "transform=\"translate({c} {c})\"",
                         f->small ? 3.2 : 4.5, fw_report_x(f->view, p.x),
                         fw_report_y(f->view, p.y));
        if (f->frames == 0) {
            fw_text_add(f->out, "/>\n");
            continue;
        }
        fw_text_add(f->out, "><animateTransform attributeName=\"transform\" type=\"translate\" ");
        timing(f);
        fw_text_add(f->out, " values=\"");
        for (int i = 0; i < f->frames; i++) {
            p = place(f, pin->body_a, pin->ax_m, pin->ay_m, instant(f, i));
            fw_report_markup(f->out, "{r}{c} {c}", i ? ";" : "", fw_report_x(f->view, p.x),
                             fw_report_y(f->view, p.y));
        }
        fw_text_add(f->out, "\"/></circle>\n");
    }
}

typedef struct link_line {
    int a, b;
    double ax, ay, bx, by;
} link_line;

static void line_at(const film *f, const link_line *l, double t_s) {
    fw_vec2 p = place(f, l->a, l->ax, l->ay, t_s), q = place(f, l->b, l->bx, l->by, t_s);
    fw_report_markup(f->out, "M{c} {c}L{c} {c}", fw_report_x(f->view, p.x),
                     fw_report_y(f->view, p.y), fw_report_x(f->view, q.x),
                     fw_report_y(f->view, q.y));
}

/* where a spring or rod is held by the ground */
static void anchor(const film *f, int body, double x, double y) {
    if (body != FW_GROUND) return;
    fw_report_markup(f->out, "<path d=\"M{c} {c}m-4-4h8v8h-8z\" fill=\"#57606a\"/>\n",
                     fw_report_x(f->view, x), fw_report_y(f->view, y));
}

static void moving_line(const film *f, const link_line *l, const char *look) {
    fw_report_markup(f->out, "<path fill=\"none\" {r} d=\"", look);
    line_at(f, l, f->still_s);
    if (f->frames == 0) {
        fw_text_add(f->out, "\"/>\n");
        return;
    }
    fw_text_add(f->out, "\"><animate attributeName=\"d\" ");
    timing(f);
    fw_text_add(f->out, " values=\"");
    for (int i = 0; i < f->frames; i++) {
        fw_text_add(f->out, i ? ";" : "");
        line_at(f, l, instant(f, i));
    }
    fw_text_add(f->out, "\"/></path>\n");
}

static void links(const film *f) {
    for (int i = 0; i < f->mechanism->nspring; i++) {
        const fw_spring *s = &f->mechanism->spring[i];
        const link_line l = {s->body_a, s->body_b, s->ax_m, s->ay_m, s->bx_m, s->by_m};
        moving_line(f, &l,
                    s->cable ? "stroke=\"#424a53\" stroke-width=\"1.2\""
                             : "stroke=\"#8250df\" stroke-width=\"2\" stroke-dasharray=\"2 2\"");
        anchor(f, s->body_a, s->ax_m, s->ay_m);
        anchor(f, s->body_b, s->bx_m, s->by_m);
    }
    for (int i = 0; i < f->mechanism->ntie; i++) {
        const fw_tie *t = &f->mechanism->tie[i];
        link_line l = {t->body_a, t->body_b, t->ax_m, t->ay_m, t->bx_m, t->by_m};
        if (t->kind == FW_TIE_WELD) continue;
        if (t->kind == FW_TIE_PRISMATIC) { /* the guide, a piece of it to both sides */
            double reach = 0.07 * f->view->width / f->view->scale;
            fw_vec2 p = place(f, t->body_a, 0, 0, f->still_s);
            fw_vec2 q = place(f, t->body_b, t->bx_m, t->by_m, f->still_s);
            double pose[3], c = cos(t->axis_rad), s = sin(t->axis_rad);
            fw_report_pose_at(f->motion, t->body_a, f->still_s, pose);
            double dx = q.x - p.x, dy = q.y - p.y, ca = cos(pose[2]), sa = sin(pose[2]);
            double along = (ca * dx + sa * dy - t->ax_m) * c + (ca * dy - sa * dx - t->ay_m) * s;
            double x = t->ax_m + along * c, y = t->ay_m + along * s;
            l = (link_line){t->body_a,     t->body_a,     x - reach * c,
                            y - reach * s, x + reach * c, y + reach * s};
        }
        moving_line(f, &l,
                    t->kind == FW_TIE_PRISMATIC
                        ? "stroke=\"#57606a\" stroke-width=\"2\" stroke-linecap=\"round\""
                        : "stroke=\"#1f2328\" stroke-width=\"2.5\" stroke-linecap=\"round\"");
        if (t->kind == FW_TIE_PRISMATIC) continue;
        anchor(f, t->body_a, t->ax_m, t->ay_m);
        anchor(f, t->body_b, t->bx_m, t->by_m);
    }
}

static void still_parts(const film *f) {
    if (!fw_report_drawn(f->layout)) return;
    fw_text_add(f->out, "<path fill=\"#eceff2\" stroke=\"#b6bec7\" stroke-width=\"0.7\" d=\"");
    for (int i = 0; i < f->layout->npiece; i++) {
        const fw_piece *p = &f->layout->piece[i];
        if (p->role == FW_ROLE_FRAME || (p->body == FW_GROUND && p->role == FW_ROLE_STRUCTURE))
            fw_report_path(f->out, f->view, &p->contour);
    }
    fw_text_add(f->out, "\"/>\n");
}

fw_status fw_report_film_draw(fw_arena *arena, const fw_report_film *from) {
    film f = *from;
    while (f.frames > 16 && (long)f.frames * f.motion->nbody * 3 > NUMBERS)
        f.frames = f.frames * 3 / 4;
    fw_report_bends bends;
    FW_TRY(fw_report_bends_make(arena, f.device, f.layout, &bends));
    still_parts(&f);
    if (fw_report_drawn(f.layout)) ghost(&f);
    bodies(&f);
    if (!fw_report_drawn(f.layout)) ghost(&f); /* sticks would hide it */
    flexures(&f, &bends);
    links(&f);
    pins(&f);
    return fw_text_end(f.out);
}

/* ---- poses that are no motion in time ---- */

fw_status fw_report_poses(fw_arena *arena, const fw_mechanism *mechanism, int count, double *q,
                          fw_motion *motion) {
    *motion =
        (fw_motion){.nbody = mechanism->nbody, .npin = mechanism->npin, .nsample = count, .q = q};
    FW_NEED(motion->t_s = fw_arena_array(arena, double, (size_t)count));
    FW_NEED(motion->peak = fw_arena_array(arena, fw_peak, (size_t)mechanism->npin));
    for (int i = 0; i < count; i++)
        motion->t_s[i] = count > 1 ? (double)i / (count - 1) : 0.0;
    for (int i = 0; i < mechanism->npin; i++)
        motion->peak[i].angle_rad = (double)NAN; /* flexures without a colour of utilisation */
    return FW_OK;
}

static void add_point(fw_box *box, const film *f, int body, double x, double y, double t) {
    fw_vec2 p = place(f, body, x, y, t);
    fw_report_box_add(box, p.x, p.y);
}

void fw_report_poses_reach(fw_box *box, const fw_mechanism *mechanism, const fw_motion *motion) {
    const film f = {.mechanism = mechanism, .motion = motion};
    for (int k = 0; k < motion->nsample; k++) {
        double t = motion->t_s[k];
        for (int b = 0; b < mechanism->nbody; b++)
            add_point(box, &f, b, 0, 0, t);
        for (int i = 0; i < mechanism->npin; i++)
            add_point(box, &f, mechanism->pin[i].body_a, mechanism->pin[i].ax_m,
                      mechanism->pin[i].ay_m, t);
        for (int i = 0; i < mechanism->nspring; i++) {
            const fw_spring *s = &mechanism->spring[i];
            add_point(box, &f, s->body_a, s->ax_m, s->ay_m, t);
            add_point(box, &f, s->body_b, s->bx_m, s->by_m, t);
        }
        for (int i = 0; i < mechanism->ntie; i++) {
            const fw_tie *s = &mechanism->tie[i];
            if (s->kind != FW_TIE_PRISMATIC) add_point(box, &f, s->body_a, s->ax_m, s->ay_m, t);
            add_point(box, &f, s->body_b, s->bx_m, s->by_m, t);
        }
    }
}

fw_report_view fw_report_poses_view(const fw_device *device, const fw_layout *layout,
                                    const fw_box *reach, double width) {
    if (fw_report_drawn(layout)) return fw_report_device_view(device, layout, reach, width);
    double size = fmax(reach->x1 - reach->x0, reach->y1 - reach->y0);
    return fw_report_view_fit(*reach, width, size > 0.0 && isfinite(size) ? 0.12 * size : 1e-3);
}
