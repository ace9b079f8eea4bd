/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Where the points of a probe are and how they move: p = x + R(phi) s, p' = v + omega (-r_y, r_x)
   with the arm r = R(phi) s; points of a ground that stretches: p + strain law (p - centre).
   In: poses and velocities in SI. Out: m, m/s. Error: round-off, 1e-16 of world coordinates. Cost: a
   sine and a cosine. Test: test_probe.py. */
#include "probe/probe.h"
#include <math.h>

/* law of a stretching ground and its rate; 0 where there is none */
static double stretch(const fw_probe *p, const fw_probe_state *s, int order) {
    const fw_effects_stretch *g = &p->loads.stretch;
    double value[3];
    if (!g->law || (order > 0 && s->still)) return 0;
    fw_quantity_law_value(g->law, s->t_s, s->piece_s, value);
    return g->strain * value[order];
}

static fw_geometry_vec2 from_centre(const fw_probe *p, const fw_effects_port *at) {
    const fw_geometry_vec2 c = p->loads.stretch.centre_m;
    return (fw_geometry_vec2){at->x_m - c.x, at->y_m - c.y};
}

static fw_geometry_vec2 arm(const fw_effects_port *at, const double *q) {
    double c = cos(q[3 * at->body + 2]), s = sin(q[3 * at->body + 2]);
    return (fw_geometry_vec2){c * at->x_m - s * at->y_m, s * at->x_m + c * at->y_m};
}

fw_geometry_vec2 fw_probe_place(const fw_probe *p, int side, const fw_probe_state *s) {
    const fw_effects_port *at = &p->point[side];
    if (at->body == FW_GROUND) {
        const fw_geometry_vec2 far = from_centre(p, at);
        double by = stretch(p, s, 0);
        return (fw_geometry_vec2){at->x_m + by * far.x, at->y_m + by * far.y};
    }
    const fw_geometry_vec2 r = arm(at, s->q);
    return (fw_geometry_vec2){s->q[3 * at->body] + r.x, s->q[3 * at->body + 1] + r.y};
}

fw_geometry_vec2 fw_probe_speed(const fw_probe *p, int side, const fw_probe_state *s) {
    const fw_effects_port *at = &p->point[side];
    if (at->body == FW_GROUND) {
        const fw_geometry_vec2 far = from_centre(p, at);
        double by = stretch(p, s, 1);
        return (fw_geometry_vec2){by * far.x, by * far.y};
    }
    if (!s->v) return (fw_geometry_vec2){0, 0};
    const double *v = s->v + 3 * at->body;
    const fw_geometry_vec2 r = arm(at, s->q);
    return (fw_geometry_vec2){v[0] - v[2] * r.y, v[1] + v[2] * r.x};
}

double fw_probe_along(const fw_probe *p, double x, double y) {
    double direction = p->asked->direction_rad;
    return isnan(direction) ? hypot(x, y) : x * cos(direction) + y * sin(direction);
}
