/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shapes of a mechanism in um with y up: bodies in their own axes (origin in the centre of mass,
   turned back by the drawn angle), what stands still and flexures in the axes of the file. */
#include "base/json.h"
#include "base/constants.h"
#include "flexure/path.h"
#include "report/figure.h"
#include "report/json_parts.h"
#include <math.h>
#include <string.h>

typedef struct frame { /* world -> local: turn by -phi about (x, y), then that point is the origin
                        */
    double x_m, y_m, c, s;
} frame;

static frame frame_of(const fw_mechanism *m, int body) {
    if (body < 0) return (frame){0.0, 0.0, 1.0, 0.0};
    const fw_mechanism_mass *b = &m->body[body];
    return (frame){b->x_m, b->y_m, cos(b->phi_rad), sin(b->phi_rad)};
}

static fw_geometry_vec2 into(const frame *f, fw_geometry_vec2 p) {
    double x = p.x - f->x_m, y = p.y - f->y_m;
    return (fw_geometry_vec2){f->c * x + f->s * y, -f->s * x + f->c * y};
}

static void point(fw_text *out, const char *command, fw_geometry_vec2 p) {
    fw_text_add(out, command);
    fw_report_preview_put_um(out, p.x);
    fw_text_add(out, " ");
    fw_report_preview_put_um(out, p.y);
}

/* y points up: counter-clockwise is SVG's positive sweep in these axes */
static void arc_to(fw_text *out, const frame *f, const fw_geometry_segment *s, double sweep,
                   fw_geometry_vec2 to) {
    fw_text_add(out, "A");
    fw_report_preview_put_um(out, s->radius);
    fw_text_add(out, " ");
    fw_report_preview_put_um(out, s->radius);
    fw_text_printf(out, " 0 %d %d", fabs(sweep) > FW_PI ? 1 : 0, sweep > 0.0 ? 1 : 0);
    point(out, " ", into(f, to));
}

static void contour(fw_text *out, const frame *f, const fw_geometry_contour *c) {
    if (c->count == 0) return;
    point(out, "M", into(f, c->segment[0].a));
    for (int i = 0; i < c->count; i++) {
        const fw_geometry_segment *s = &c->segment[i];
        if (s->kind == FW_LINE) {
            if (i + 1 < c->count) point(out, "L", into(f, s->b));
        } else if (fabs(s->sweep_rad) < 1.8 * FW_PI) {
            arc_to(out, f, s, s->sweep_rad, s->b);
        } else { /* an arc that ends where it starts has no direction: two halves */
            double cosine = cos(0.5 * s->sweep_rad), sine = sin(0.5 * s->sweep_rad);
            double x = s->a.x - s->centre.x, y = s->a.y - s->centre.y;
            fw_geometry_vec2 half = {s->centre.x + cosine * x - sine * y,
                                     s->centre.y + sine * x + cosine * y};
            arc_to(out, f, s, 0.5 * s->sweep_rad, half);
            arc_to(out, f, s, 0.5 * s->sweep_rad, s->b);
        }
    }
    fw_text_add(out, "Z");
}

/* an outline as a string; no letter of a path needs an escape */
static void path(fw_json *out, const char *key, const frame *f, const fw_geometry_contour *c) {
    fw_text *text = fw_json_value(out, key);
    fw_text_add(text, "\"");
    contour(text, f, c);
    fw_text_add(text, "\"");
}

/* ---- bodies ---- */

typedef bool (*wanted)(const fw_layout_piece *piece, int body);

static bool structure(const fw_layout_piece *p, int body) {
    return p->body == body && p->role == FW_ROLE_STRUCTURE;
}

static bool chip(const fw_layout_piece *p, int body) {
    (void)body;
    return p->role == FW_ROLE_FRAME;
}

static bool tether(const fw_layout_piece *p, int body) {
    (void)body;
    return p->role == FW_ROLE_TETHER;
}

static void outlines(fw_json *out, const char *key, const fw_layout *layout, const frame *f,
                     wanted want, int body) {
    bool first = true;
    fw_json_list(out, key);
    for (int i = 0; fw_report_drawn(layout) && i < layout->npiece; i++) {
        if (!want(&layout->piece[i], body)) continue;
        if (!first) fw_json_line(out, 0);
        path(out, NULL, f, &layout->piece[i].contour);
        first = false;
    }
    fw_json_end(out);
}

void fw_report_preview_outlines(fw_json *out, const char *key, const fw_geometry_region *region) {
    const frame world = frame_of(NULL, FW_GROUND);
    fw_json_list(out, key);
    for (int i = 0; region && i < region->count; i++)
        path(out, NULL, &world, &region->contour[i]);
    fw_json_end(out);
}

/* what stands for a body that nobody has drawn: a line or hull through its joints */
static void figure_outline(fw_json *out, const fw_report_drawing_figure *figure, int body) {
    fw_json_list(out, "outline");
    for (int i = 0; i < figure->count; i++) {
        const fw_report_figure_part *p = &figure->part[i];
        if (p->role != FW_FIGURE_BODY || p->of != body) continue;
        fw_text *text = fw_json_value(out, NULL);
        fw_text_add(text, "\"");
        for (int k = 0; k < p->noutline; k++)
            point(text, k ? "L" : "M", p->outline[k]);
        if (p->noutline == 0) {
            point(text, "M", (fw_geometry_vec2){p->end[0].x_m, p->end[0].y_m});
            point(text, "L", (fw_geometry_vec2){p->end[1].x_m, p->end[1].y_m});
        }
        fw_text_add(text, p->noutline > 2 ? "Z\"" : "\"");
    }
    fw_json_end(out);
}

static void body_json(const fw_report_preview *in, const fw_report_drawing_figure *figure, int b,
                      fw_json *out) {
    const fw_mechanism_mass *m = &in->mechanism->body[b];
    const frame f = frame_of(in->mechanism, b);
    bool drawn = fw_report_outlined(in->layout, b);
    fw_json_object(out, NULL);
    fw_json_text(out, "id", m->id);
    fw_json_truth(out, "fixed", false);
    fw_json_truth(out, "platform", in->device->body[b].platform);
    fw_json_truth(out, "drawn", drawn);
    if (drawn)
        outlines(out, "outline", in->layout, &f, structure, b);
    else
        figure_outline(out, figure, b);
    fw_json_list(out, "rest");
    fw_json_number(out, NULL, m->x_m, 9);
    fw_json_number(out, NULL, m->y_m, 9);
    fw_json_number(out, NULL, m->phi_rad, 9);
    fw_json_end(out);
    /* of a layout that cannot be made: one that stands in for it is none */
    const fw_device_body *stated = &in->device->body[b];
    bool known = !in->layout || in->layout->nfault == 0 || in->layout->body[b].area_m2 > 0.0;
    bool has = known || !isnan(stated->mass_kg), turns = known || !isnan(stated->inertia_kg_m2);
    fw_json_number(out, "mass_kg", has ? m->mass_kg : (double)NAN, 6);
    fw_json_number(out, "inertia_kg_m2", turns ? m->inertia_kg_m2 : (double)NAN, 6);
    fw_json_end(out);
}

static void bodies(const fw_report_preview *in, const fw_report_drawing_figure *figure,
                   fw_json *out) {
    const fw_layout *layout = in->layout;
    fw_json_list(out, "bodies");
    for (int b = 0; b < in->mechanism->nbody; b++) {
        fw_json_line(out, 0);
        body_json(in, figure, b, out);
    }
    const frame world = frame_of(in->mechanism, FW_GROUND);
    fw_json_line(out, 0);
    fw_json_object(out, NULL);
    fw_json_text(out, "id", "ground");
    fw_json_truth(out, "fixed", true);
    fw_json_truth(out, "platform", false);
    fw_json_truth(out, "drawn", fw_report_drawn(layout));
    outlines(out, "outline", layout, &world, structure, FW_GROUND);
    outlines(out, "islands", layout, &world, structure, FW_ISLAND);
    outlines(out, "frame", layout, &world, chip, 0);
    outlines(out, "tethers", layout, &world, tether, 0);
    fw_json_end(out);
    fw_json_end(out);
}

/* ---- flexures ---- */

static const char *body_id(const fw_mechanism *m, int body) {
    return body >= 0 && body < m->nbody ? m->body[body].id : "ground";
}

/* a frame fixed to a body, where one end of the centre line is, along which the line runs there */
static void end_frame(fw_json *out, const fw_mechanism *m, int body, fw_geometry_pose at) {
    const frame f = frame_of(m, body);
    fw_geometry_vec2 p = into(&f, (fw_geometry_vec2){at.x_m, at.y_m});
    fw_json_object(out, NULL);
    fw_json_text(out, "body", body_id(m, body));
    fw_report_preview_point(out, "at_um", p.x, p.y);
    fw_json_number(out, "angle_rad", at.angle_rad - (body >= 0 ? m->body[body].phi_rad : 0.0), 7);
    fw_json_end(out);
}

/* the centre line in the flexure's frame: from the root of `lower` to that of `upper` */
static int centre_line(const fw_device_flexure *flexure, double fillet_m, fw_geometry_pose *pose,
                       int most) {
    const fw_flexure_input in = fw_flexure_input_of(flexure, fillet_m);
    fw_flexure_course path;
    fw_flexure_path_of(&in, &path);
    int n = 0, each = (most - 1) / (path.n > 0 ? path.n : 1);
    for (int i = 0; i < path.n; i++) {
        const fw_geometry_strip_piece *p = &path.shape[i].piece;
        int parts = p->curvature_per_m == 0.0 ? 1 : each;
        for (int k = 0; k < parts; k++)
            pose[n++] =
                fw_geometry_strip_along(path.start[i], p->curvature_per_m, p->length_m * k / parts);
    }
    pose[n++] = path.start[path.n];
    return n;
}

static fw_geometry_pose to_world(const fw_layout_hinge_layout *h, fw_geometry_pose p) {
    double c = cos(h->axis_rad), s = sin(h->axis_rad);
    return (fw_geometry_pose){h->arc_centre.x + c * p.x_m - s * p.y_m,
                              h->arc_centre.y + s * p.x_m + c * p.y_m, p.angle_rad + h->axis_rad};
}

static void line_of(const fw_report_preview *in, const fw_report_bend *bend, fw_json *out) {
    enum { MOST = FW_STRIP_MOST + 2 };
    const fw_layout_hinge_layout *h = &in->layout->hinge[bend->joint];
    const fw_device_flexure *flexure =
        &in->device->flexure[in->device->revolute[bend->joint].flexure];
    fw_geometry_pose pose[MOST];
    int n = centre_line(flexure, h->fillet_m, pose, flexure->kind == FW_FLEXURE_PATH ? MOST : 25);
    fw_text *text = fw_json_value(out, "centre_line");
    fw_text_add(text, "\"");
    for (int i = 0; i < n; i++) {
        pose[i] = to_world(h, pose[i]);
        point(text, i ? "L" : "M", (fw_geometry_vec2){pose[i].x_m, pose[i].y_m});
    }
    fw_text_add(text, "\"");
    fw_json_list(out, "ends");
    end_frame(out, in->mechanism, bend->lower, pose[0]);
    end_frame(out, in->mechanism, bend->upper, pose[n - 1]);
    fw_json_end(out);
    fw_report_preview_um(out, "width_um", flexure->width_m);
}

static void flexure_json(const fw_report_preview *in, const fw_report_bend *bend, fw_json *out) {
    const fw_mechanism *m = in->mechanism;
    const fw_device_revolute *joint = &in->device->revolute[bend->joint];
    const frame world = frame_of(m, FW_GROUND);
    fw_json_object(out, NULL);
    fw_json_text(out, "id", joint->id);
    fw_json_whole(out, "pin", bend->joint);
    fw_json_text(out, "flexure", in->device->flexure[joint->flexure].id);
    fw_json_list(out, "between");
    fw_json_text(out, NULL, body_id(m, bend->lower));
    fw_json_text(out, NULL, body_id(m, bend->upper));
    fw_json_end(out);
    fw_report_preview_bodies(out, "bodies", bend->lower, bend->upper);
    path(out, "path", &world, &bend->piece->contour);
    fw_report_preview_point(out, "centre_um", bend->centre.x, bend->centre.y);
    fw_json_list(out, "points");
    for (int k = 0; k < bend->npoint; k++) { /* x, y and the share of the upper body */
        fw_report_preview_um(out, NULL, bend->point[k].x_m);
        fw_report_preview_um(out, NULL, bend->point[k].y_m);
        fw_json_fixed(out, NULL, bend->point[k].weight, 4);
    }
    fw_json_end(out);
    line_of(in, bend, out);
    fw_json_end(out);
}

static void flexures(const fw_report_preview *in, const fw_report_bends *bends, fw_json *out) {
    fw_json_list(out, "flexures");
    for (int i = 0; i < bends->count; i++) {
        fw_json_line(out, 0);
        flexure_json(in, &bends->item[i], out);
    }
    fw_json_end(out);
}

/* ---- pins ---- */

/* limit of a joint in a variant; NaN: none, or not judged */
static double limit_in(const fw_report_preview *in, int flow, int joint) {
    const fw_verdict_variant_verdict *v = in->flow[flow].variant;
    for (int i = 0; v && v->hinge && i < v->nhinge; i++)
        if (v->hinge[i].joint == joint) return v->hinge[i].limit_angle_rad;
    return (double)NAN;
}

static bool same_flow(const char *a, const char *b) { /* NULL: the description's own */
    return a == b || (a && b && strcmp(a, b) == 0);
}

/* the motion that is shown, as the verdict judged it; NULL: it did not */
static const fw_verdict_variant_verdict *shown_verdict(const fw_report_preview *in, int *scene) {
    const fw_mechanism_variant *shown = in->mechanism->variant;
    *scene = FW_NONE;
    for (int k = 0; in->scene && k < in->device->nscene; k++)
        if (strcmp(in->device->scene[k].name, in->scene->name) == 0) *scene = k;
    for (int i = 0; shown && in->verdict && *scene != FW_NONE && i < in->verdict->nvariant; i++) {
        const fw_verdict_variant_verdict *v = &in->verdict->variant[i];
        if (v->variant && v->used && same_flow(v->variant->flow, shown->flow)) return v;
    }
    return NULL;
}

/* What the verdict says that a hinge uses in the motion that is shown, by whatever limit rules there
   (strain with the joint force, fatigue). The picture and the plot have one angle for the whole of
   it: the one at which the peak of this motion would use all. */
typedef struct rule {
    double utilisation, limit_rad; /* NaN: nothing is known */
    const char *criterion;         /* of the worst scene; NULL: none */
} rule;

static rule rule_of(const fw_report_preview *in, const fw_verdict_variant_verdict *v, int scene,
                    int pin) {
    rule r = {(double)NAN, fw_report_pin_limit(in->mechanism, pin), NULL};
    for (int k = 0; v && in->motion && k < v->nhinge; k++) {
        if (v->hinge[k].joint != pin) continue;
        double used = v->used[(size_t)k * ((size_t)in->device->nscene + 1) + (size_t)scene];
        double peak = fabs(in->motion->peak[pin].angle_rad);
        if (!isfinite(used)) continue;
        r.utilisation = used;
        if (v->hinge[k].limit) r.criterion = v->hinge[k].limit->criterion;
        if (used > 0.0 && peak > 0.0) r.limit_rad = peak / used;
    }
    return r;
}

static void pins(const fw_report_preview *in, fw_json *out) {
    const fw_mechanism *m = in->mechanism;
    int scene;
    const fw_verdict_variant_verdict *judged = shown_verdict(in, &scene);
    fw_json_list(out, "pins");
    for (int i = 0; i < m->npin; i++) {
        const fw_mechanism_pin *p = &m->pin[i];
        fw_geometry_vec2 at = fw_mechanism_pin_place(m, p, 0);
        fw_json_line(out, 0);
        fw_json_object(out, NULL);
        fw_json_text(out, "id", p->id);
        fw_json_text(out, "a", body_id(m, p->body_a));
        fw_json_text(out, "b", body_id(m, p->body_b));
        fw_report_preview_bodies(out, "bodies", p->body_a, p->body_b);
        fw_report_preview_point(out, "at_um", at.x, at.y);
        fw_report_preview_point(out, "on_a_um", p->ax_m, p->ay_m);
        fw_report_preview_point(out, "on_b_um", p->bx_m, p->by_m);
        fw_json_number(out, "free_angle_rad", p->free_angle_rad, 9);
        fw_json_truth(out, "flexure", p->hinge != FW_NONE);
        fw_json_list(out, "limit_rad");
        for (int k = 0; k < in->nflow; k++)
            fw_json_number(out, NULL, limit_in(in, k, i), 7);
        fw_json_end(out);
        rule shown = rule_of(in, judged, scene, i);
        fw_json_number(out, "shown_limit_rad", shown.limit_rad, 7);
        fw_json_number(out, "shown_utilisation", shown.utilisation, 7);
        fw_json_text(out, "shown_criterion", shown.criterion);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void box_um(fw_json *out, const char *key, const fw_geometry_box *box) {
    const double side[4] = {box->x0, box->y0, box->x1, box->y1};
    if (!(box->x1 >= box->x0 && box->y1 >= box->y0)) {
        fw_json_null(out, key);
        return;
    }
    fw_json_list(out, key);
    for (int i = 0; i < 4; i++)
        fw_report_preview_um(out, NULL, side[i]);
    fw_json_end(out);
}

/* where the corners of what is drawn of a body, and its pins, come to at so many instants */
static void swept(const fw_report_preview *in, int body, fw_geometry_vec2 p, fw_geometry_box *box) {
    enum { INSTANTS = 96 };
    const fw_dynamics_motion *x = in->motion;
    double end = x->t_s[x->nsample - 1];
    for (int i = 0; i <= INSTANTS; i++) {
        fw_geometry_vec2 q = fw_report_moved(in->mechanism, x, body, end * i / INSTANTS, p);
        if (isfinite(q.x) && isfinite(q.y)) fw_report_box_add(box, q.x, q.y);
    }
}

static void motion_box(const fw_report_preview *in, fw_geometry_box *box) {
    const fw_mechanism *m = in->mechanism;
    if (!in->motion || in->motion->nsample < 1) return;
    for (int i = 0; fw_report_drawn(in->layout) && i < in->layout->npiece; i++) {
        const fw_layout_piece *p = &in->layout->piece[i];
        if (p->role != FW_ROLE_STRUCTURE || p->body < 0) continue;
        fw_geometry_box b = fw_geometry_contour_box(&p->contour);
        const fw_geometry_vec2 corner[4] = {{b.x0, b.y0}, {b.x1, b.y0}, {b.x1, b.y1}, {b.x0, b.y1}};
        for (int k = 0; k < 4; k++)
            swept(in, p->body, corner[k], box);
    }
    for (int i = 0; i < m->npin; i++) {
        fw_geometry_vec2 p = fw_mechanism_pin_place(m, &m->pin[i], 0);
        swept(in, m->pin[i].body_a, p, box);
        swept(in, m->pin[i].body_b, p, box);
    }
}

/* what a picture has to hold: everything drawn of bodies and ground but the frame; centres and
   pins where nothing is drawn; springs. And a picture of the scene: its cables and electrodes, and
   wherever the motion takes the bodies */
static void boxes(const fw_report_preview *in, fw_json *out) {
    const fw_mechanism *m = in->mechanism;
    fw_geometry_box box = fw_report_box_empty();
    for (int i = 0; fw_report_drawn(in->layout) && i < in->layout->npiece; i++) {
        const fw_layout_piece *p = &in->layout->piece[i];
        if (p->role != FW_ROLE_STRUCTURE && p->role != FW_ROLE_FLEXURE) continue;
        fw_geometry_box b = fw_geometry_contour_box(&p->contour);
        fw_report_box_add(&box, b.x0, b.y0);
        fw_report_box_add(&box, b.x1, b.y1);
    }
    for (int b = 0; b < m->nbody; b++)
        fw_report_box_add(&box, m->body[b].x_m, m->body[b].y_m);
    for (int i = 0; i < m->npin; i++) {
        fw_geometry_vec2 p = fw_mechanism_pin_place(m, &m->pin[i], 0);
        fw_report_box_add(&box, p.x, p.y);
    }
    fw_report_preview_attached_box(m, &box);
    box_um(out, "box_um", &box);
    fw_report_preview_scene_box(m, in->scene, &box);
    motion_box(in, &box);
    box_um(out, "scene_box_um", &box);
}

fw_status fw_report_preview_shapes(fw_arena *arena, const fw_report_preview *in, fw_json *out) {
    static const char *const empty[] = {"bodies", "flexures", "pins", "ties", "springs", "loads"};
    const fw_mechanism *m = in->mechanism;
    if (!m) {
        fw_json_null(out, "box_um");
        fw_json_null(out, "scene_box_um");
        for (size_t i = 0; i < sizeof empty / sizeof empty[0]; i++) {
            fw_json_list(out, empty[i]);
            fw_json_end(out);
        }
        return FW_OK;
    }
    fw_report_drawing_figure figure = {0};
    fw_report_bends bends;
    double *rest = fw_arena_array(arena, double, 3 * (size_t)m->nbody);
    FW_NEED(rest);
    for (int b = 0; b < m->nbody; b++) {
        rest[3 * b] = m->body[b].x_m;
        rest[3 * b + 1] = m->body[b].y_m;
        rest[3 * b + 2] = m->body[b].phi_rad;
    }
    FW_TRY(fw_report_figure_make(arena, m, rest, 1, &figure));
    FW_TRY(fw_report_bends_make(arena, in->device, in->layout, &bends));
    boxes(in, out);
    fw_json_line(out, 0);
    bodies(in, &figure, out);
    fw_json_line(out, 0);
    flexures(in, &bends, out);
    fw_json_line(out, 0);
    pins(in, out);
    fw_json_line(out, 0);
    fw_report_preview_attached(in, out);
    return FW_OK;
}
