/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What joins bodies beside hinges, and what drives them. Points are in the bodies' axes; of the
   ground, of the file. */
#include "base/json.h"
#include "effects/effects.h"
#include "mechanism/mechanism.h"
#include "report/report_page.h"
#include "report/json_parts.h"
#include <math.h>
#include <string.h>

/* bodies a and b with their points */
static void between(fw_json *out, int a, int b, fw_geometry_vec2 on_a, fw_geometry_vec2 on_b) {
    fw_report_preview_bodies(out, "bodies", a, b);
    fw_report_preview_point(out, "on_a_um", on_a.x, on_a.y);
    fw_report_preview_point(out, "on_b_um", on_b.x, on_b.y);
}

static void joints(const fw_mechanism *m, fw_json *out) {
    static const char *const kind[] = {[FW_JOINT_PRISMATIC] = "prismatic",
                                       [FW_JOINT_DISTANCE] = "distance",
                                       [FW_JOINT_WELD] = "weld"};
    fw_json_list(out, "ties");
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        fw_json_object(out, NULL);
        fw_json_text(out, "id", t->id);
        fw_json_text(out, "kind", kind[t->kind]);
        between(out, t->body_a, t->body_b, (fw_geometry_vec2){t->ax_m, t->ay_m},
                (fw_geometry_vec2){t->bx_m, t->by_m});
        /* in the frame of a */
        fw_json_number(out, "axis_rad", t->kind == FW_JOINT_PRISMATIC ? t->axis_rad : (double)NAN,
                       9);
        fw_json_end(out);
    }
    fw_json_end(out);
}

static void springs(const fw_mechanism *m, fw_json *out) {
    fw_json_list(out, "springs");
    for (int i = 0; i < m->nspring; i++) {
        const fw_device_spring *s = &m->spring[i];
        fw_json_object(out, NULL);
        fw_json_text(out, "id", s->id);
        between(out, s->body_a, s->body_b, (fw_geometry_vec2){s->ax_m, s->ay_m},
                (fw_geometry_vec2){s->bx_m, s->by_m});
        fw_json_truth(out, "cable", s->cable);
        fw_report_preview_um(out, "length_um", s->length_m);
        fw_json_end(out);
    }
    fw_json_end(out);
}

/* ---- loads of the scene ---- */

static void begin(fw_json *out, const char *kind) {
    fw_json_object(out, NULL);
    fw_json_text(out, "kind", kind);
}

static void end(fw_json *out, const fw_quantity_law *law) {
    fw_json_text(out, "law", law ? fw_quantity_law_name(law) : NULL);
    fw_json_end(out);
}

static void force(const fw_device_force *f, fw_json *out) {
    begin(out, "force");
    fw_json_whole(out, "body", f->body);
    fw_report_preview_point(out, "at_um", f->x_m, f->y_m);
    fw_json_list(out, "force_N");
    fw_json_number(out, NULL, f->fx_N, 6);
    fw_json_number(out, NULL, f->fy_N, 6);
    fw_json_end(out);
    end(out, f->law);
}

static void torque(const fw_device_torque *t, fw_json *out) {
    begin(out, "torque");
    fw_json_whole(out, "body", t->body);
    fw_json_number(out, "torque_Nm", t->value_Nm, 6);
    end(out, t->law);
}

static void tendon(const fw_device_tendon *t, fw_json *out) {
    begin(out, "tendon");
    fw_json_text(out, "id", t->id);
    fw_json_list(out, "eyelets");
    for (int k = 0; k < t->neyelet; k++) {
        fw_json_object(out, NULL);
        fw_json_whole(out, "body", t->eyelet[k].body);
        fw_report_preview_point(out, "at_um", t->eyelet[k].x_m, t->eyelet[k].y_m);
        fw_json_end(out);
    }
    fw_json_end(out);
    fw_json_number(out, "pull_N", t->pull_N, 6);
    fw_json_number(out, "draw_m", t->draw_m, 6);
    end(out, t->law);
}

static double comb_length(const fw_device_comb *c) {
    return isnan(c->length_m) ? 2.0 * c->overlap_m : c->length_m;
}

/* Has somebody drawn the rotor? Then a point within its outermost finger, or behind its face, lies
   in the body's outline. Axes of the drive: x where the rotor is pulled, from the given point. */
static bool comb_drawn(const fw_report_preview *in, const fw_device_comb *c) {
    const fw_mechanism *m = in->mechanism;
    bool fingers = c->kind == FW_ELECTRODES_COMB;
    double turn = c->direction_rad + (c->body_a >= 0 ? m->body[c->body_a].phi_rad : 0.0);
    double x = fingers ? 0.0 : -1e-6;
    double y = fingers ? (c->fingers - 1) * (fw_device_comb_width_m(c) + c->gap_m) : 0.0;
    fw_geometry_vec2 p = fw_mechanism_local_place(m, c->body_b, c->bx_m, c->by_m);
    p.x += x * cos(turn) - y * sin(turn);
    p.y += x * sin(turn) + y * cos(turn);
    for (int i = 0; fw_report_drawn(in->layout) && i < in->layout->npiece; i++) {
        const fw_layout_piece *piece = &in->layout->piece[i];
        if (piece->body == c->body_b && piece->role == FW_ROLE_STRUCTURE &&
            fw_geometry_contour_contains(&piece->contour, p))
            return true;
    }
    return false;
}

static void comb(const fw_report_preview *in, const fw_device_comb *c, fw_json *out) {
    bool fingers = c->kind == FW_ELECTRODES_COMB;
    begin(out, "comb-drive");
    fw_json_text(out, "id", c->id);
    fw_report_preview_bodies(out, "bodies", c->body_a, c->body_b);
    fw_report_preview_point(out, "at_um", c->bx_m, c->by_m); /* of the rotor, bodies[1] */
    fw_json_number(out, "direction_rad", c->direction_rad, 9);
    fw_json_number(out, "voltage_V", c->voltage_V, 6);
    fw_json_truth(out, "drawn", comb_drawn(in, c));
    fw_json_text(out, "electrodes", fingers ? "comb" : "plate");
    fw_json_whole(out, "fingers", fingers ? c->fingers : 0);
    fw_report_preview_um(out, "gap_um", c->gap_m);
    fw_report_preview_um(out, "length_um", comb_length(c));
    fw_report_preview_um(out, "overlap_um", fingers ? c->overlap_m : 0.0);
    fw_report_preview_um(out, "width_um", fingers ? fw_device_comb_width_m(c) : 0.0);
    end(out, c->law);
}

static void applied(const fw_report_preview *in, fw_json *out) {
    for (int i = 0; i < in->scene->nforce; i++)
        force(&in->scene->force[i], out);
    for (int i = 0; i < in->scene->ntorque; i++)
        torque(&in->scene->torque[i], out);
}

static void tendons(const fw_report_preview *in, fw_json *out) {
    for (int i = 0; i < in->scene->ntendon; i++) {
        if (i || in->scene->nforce || in->scene->ntorque) fw_json_line(out, 0);
        tendon(&in->scene->tendon[i], out);
    }
}

static void combs(const fw_report_preview *in, fw_json *out) {
    for (int i = 0; i < in->scene->ncomb; i++)
        comb(in, &in->scene->comb[i], out);
}

/* The effects whose loads are drawn, in the order of "loads" and "load_factor"; those of all other
   effects are named. */
static const struct {
    const char *effect;
    void (*loads)(const fw_report_preview *in, fw_json *out);
} drawn[] = {{"applied-load", applied}, {"tendon", tendons}, {"comb-drive", combs}};

static bool is_drawn(const char *effect) {
    for (size_t i = 0; i < sizeof drawn / sizeof drawn[0]; i++)
        if (strcmp(drawn[i].effect, effect) == 0) return true;
    return false;
}

static void loads(const fw_report_preview *in, fw_json *out) {
    fw_json_list(out, "loads");
    for (size_t i = 0; in->scene && i < sizeof drawn / sizeof drawn[0]; i++)
        drawn[i].loads(in, out);
    fw_json_end(out);
}

/* loads that the rows of other effects find in the scene, by the names that the rows give them */
static void loads_not_drawn(const fw_report_preview *in, fw_json *out) {
    size_t count;
    const fw_effect_row *const *row = fw_effect_rows(&count);
    fw_json_list(out, "not_drawn");
    for (size_t i = 0; in->scene && i < count; i++) {
        fw_effects_load_scaling found = {.count = 0};
        if (!row[i]->loads || is_drawn(row[i]->id)) continue;
        row[i]->loads(in->scene, &found);
        for (int k = 0; k < found.count; k++)
            fw_json_text(out, NULL, found.item[k].name);
    }
    fw_json_end(out);
}

void fw_report_preview_attached(const fw_report_preview *in, fw_json *out) {
    joints(in->mechanism, out);
    fw_json_line(out, 0);
    springs(in->mechanism, out);
    fw_json_line(out, 0);
    loads(in, out);
    loads_not_drawn(in, out);
}

/* ---- how much of a load acts when ---- */

/* the law and its rate at a row's instant, at a jump those after it; NULL: 1 */
static void law_at(const fw_quantity_law *law, const fw_dynamics_motion *x, int row,
                   double value[3]) {
    int other = row + 1 < x->nsample ? row + 1 : row - 1;
    double t = x->t_s[row], beside = other < 0 ? t : 0.5 * (t + x->t_s[other]);
    value[0] = 1.0, value[1] = value[2] = 0.0;
    if (law) fw_quantity_law_value(law, t, beside, value);
}

/* a list for one load: its factor at every instant; null: always 1 */
static void factor(const fw_quantity_law *law, const fw_dynamics_motion *x, fw_json *out) {
    if (!law || fw_quantity_law_is_constant(law)) {
        fw_json_null(out, NULL);
        return;
    }
    fw_json_line(out, 0);
    fw_json_list(out, NULL);
    for (int i = 0; i < x->nsample; i++) {
        double value[3];
        law_at(law, x, i, value);
        fw_json_number(out, NULL, value[0], 5);
    }
    fw_json_end(out);
}

void fw_report_preview_factors(const fw_device_scene *s, const fw_dynamics_motion *x,
                               fw_json *out) {
    fw_json_list(out, "load_factor");
    for (int i = 0; s && i < s->nforce; i++)
        factor(s->force[i].law, x, out);
    for (int i = 0; s && i < s->ntorque; i++)
        factor(s->torque[i].law, x, out);
    for (int i = 0; s && i < s->ntendon; i++)
        factor(s->tendon[i].law, x, out);
    for (int i = 0; s && i < s->ncomb; i++)
        factor(s->comb[i].law, x, out);
    fw_json_end(out);
}

/* ---- how much cables pull ---- */

typedef struct moving { /* a point with its velocity */
    double x, y, vx, vy;
} moving;

/* q and v: a row of the motion, of every body; v NULL: at rest */
static moving eyelet_at(const fw_device_eyelet *e, const double *q, const double *v) {
    if (e->body < 0) return (moving){e->x_m, e->y_m, 0.0, 0.0};
    const double *p = q + 3 * e->body, c = cos(p[2]), s = sin(p[2]);
    double x = c * e->x_m - s * e->y_m, y = s * e->x_m + c * e->y_m;
    moving m = {p[0] + x, p[1] + y, 0.0, 0.0};
    if (v) {
        const double *w = v + 3 * e->body;
        m.vx = w[0] - w[2] * y, m.vy = w[1] + w[2] * x;
    }
    return m;
}

static double path_of(const fw_device_tendon *t, const double *q, const double *v, double *rate) {
    double length = 0.0;
    *rate = 0.0;
    for (int i = 0; i + 1 < t->neyelet; i++) {
        moving a = eyelet_at(&t->eyelet[i], q, v), b = eyelet_at(&t->eyelet[i + 1], q, v);
        double dx = b.x - a.x, dy = b.y - a.y, far = hypot(dx, dy);
        length += far;
        if (far > 0.0) *rate += (dx * (b.vx - a.vx) + dy * (b.vy - a.vy)) / far;
    }
    return length;
}

/* Tension of a cable at a row, as effects/tendon.c has it (its formulas and source there): pulled
   max(0, pull s); drawn k g + c g' where that and k g are above 0, g = path + draw s - rest. `rest`
   in m. Exact but for the row's rounding; test_live_attached.c checks it by differences. */
static double tension(const fw_device_tendon *t, const fw_dynamics_motion *x, int row,
                      double rest_m) {
    size_t at = (size_t)row * 3 * (size_t)x->nbody;
    double s[3], rate;
    law_at(t->law, x, row, s);
    if (!isnan(t->pull_N)) return fmax(0.0, t->pull_N * s[0]);
    double length = path_of(t, x->q + at, x->v ? x->v + at : NULL, &rate);
    double spring = t->stiffness_N_per_m * (length + t->draw_m * s[0] - rest_m);
    double both = spring + t->damping_Ns_per_m * (rate + t->draw_m * s[1]);
    return fmin(spring, both) > 0.0 ? both : 0.0;
}

static bool active(const fw_dynamics_motion *x, const char *effect) {
    for (int i = 0; i < x->ledger.count; i++)
        if (strcmp(x->ledger.item[i].id, effect) == 0) return x->ledger.item[i].active;
    return false;
}

fw_status fw_report_preview_tensions(fw_arena *arena, const fw_mechanism *m,
                                     const fw_device_scene *s, const fw_dynamics_motion *x,
                                     fw_json *out) {
    double *rest = fw_arena_array(arena, double, 3 * (size_t)m->nbody + 1), none;
    FW_NEED(rest);
    for (int b = 0; b < m->nbody; b++)
        rest[3 * b] = m->body[b].x_m, rest[3 * b + 1] = m->body[b].y_m,
                 rest[3 * b + 2] = m->body[b].phi_rad;
    fw_json_list(out, "tension_N");
    for (int i = 0; s && i < s->ntendon && active(x, "tendon"); i++) {
        const fw_device_tendon *t = &s->tendon[i];
        double rest_m = path_of(t, rest, NULL, &none) + (isnan(t->slack_m) ? 0.0 : t->slack_m);
        fw_json_line(out, 0);
        fw_json_list(out, NULL);
        for (int row = 0; row < x->nsample; row++)
            fw_json_number(out, NULL, tension(t, x, row, rest_m), 5);
        fw_json_end(out);
    }
    fw_json_end(out);
    return FW_OK;
}

/* ---- what the picture has to hold of it ---- */

/* A point within `reach_m` of the box as it was; from farther away a cable or spring comes in at
   the picture's edge. */
static void add(fw_geometry_box *box, const fw_geometry_box *was, double reach_m,
                const fw_mechanism *m, int body, double x_m, double y_m) {
    fw_geometry_vec2 p = fw_mechanism_local_place(m, body, x_m, y_m);
    fw_report_box_add(box, fmin(fmax(p.x, was->x0 - reach_m), was->x1 + reach_m),
                      fmin(fmax(p.y, was->y0 - reach_m), was->y1 + reach_m));
}

static bool reach_of(const fw_geometry_box *box, double *reach_m) {
    double size = fmax(box->x1 - box->x0, box->y1 - box->y0);
    *reach_m = size > 0.0 ? 0.5 * size : 1e-3;
    return box->x1 >= box->x0 && box->y1 >= box->y0;
}

void fw_report_preview_attached_box(const fw_mechanism *m, fw_geometry_box *box) {
    const fw_geometry_box was = *box;
    double reach;
    if (!reach_of(&was, &reach)) return;
    for (int i = 0; i < m->nspring; i++) {
        const fw_device_spring *k = &m->spring[i];
        add(box, &was, reach, m, k->body_a, k->ax_m, k->ay_m);
        add(box, &was, reach, m, k->body_b, k->bx_m, k->by_m);
    }
    for (int i = 0; i < m->njoint; i++) {
        const fw_device_joint *t = &m->joint[i];
        add(box, &was, reach, m, t->body_a, t->ax_m, t->ay_m);
        add(box, &was, reach, m, t->body_b, t->bx_m, t->by_m);
    }
}

void fw_report_preview_scene_box(const fw_mechanism *m, const fw_device_scene *s,
                                 fw_geometry_box *box) {
    const fw_geometry_box was = *box;
    double reach;
    if (!reach_of(&was, &reach)) return;
    for (int i = 0; s && i < s->ncomb; i++) {
        const fw_device_comb *c = &s->comb[i];
        /* of the fingers on either side of its point, whatever way they lie */
        double half =
            fmax(comb_length(c), (c->fingers + 1) * (fw_device_comb_width_m(c) + c->gap_m));
        if (c->kind == FW_ELECTRODES_PLATE) half = 0.5 * c->length_m + c->gap_m;
        add(box, &was, reach, m, c->body_b, c->bx_m - half, c->by_m - half);
        add(box, &was, reach, m, c->body_b, c->bx_m + half, c->by_m + half);
    }
    for (int i = 0; s && i < s->ntendon; i++)
        for (int k = 0; k < s->tendon[i].neyelet; k++) {
            const fw_device_eyelet *e = &s->tendon[i].eyelet[k];
            add(box, &was, reach, m, e->body, e->x_m, e->y_m);
        }
}
