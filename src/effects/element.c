/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Force elements where the bodies are now, at rest. */
#include "base/constants.h"
#include "effects/effect.h"
#include "effects/envelope.h"
#include "effects/modal.h"
#include <float.h>
#include <math.h>
#include <string.h>

enum { PORTS_MOST = 128, SWITCHES_MOST = 64 };

typedef struct still { /* the element alone: its ports' bodies are 0, 1, ... */
    fw_effects_force_element e;
    fw_effects_port port[PORTS_MOST];
    double q[3 * PORTS_MOST], p[3 * PORTS_MOST], w[3 * PORTS_MOST], f[3 * PORTS_MOST];
    bool on[SWITCHES_MOST];
    fw_effects_port_state state;
} still;

bool fw_effects_loads_element_fits(const fw_effects_force_element *e) {
    return e->ports <= PORTS_MOST && e->switches <= SWITCHES_MOST;
}

/* every switch as its own value says */
static void place_as_drawn(const fw_mechanism *m, const fw_effects_force_element *e, double t_s,
                           double piece_s, still *s) {
    s->e = *e;
    s->e.port = s->port;
    for (int i = 0; i < e->ports; i++) {
        int b = e->port[i].body;
        s->port[i] = e->port[i];
        if (b == FW_GROUND) continue;
        s->port[i].body = i;
        s->q[3 * i] = m->body[b].x_m, s->q[3 * i + 1] = m->body[b].y_m;
        s->q[3 * i + 2] = m->body[b].phi_rad;
    }
    fw_effects_element_place_ports(&s->e, s->q, NULL, s->p, s->w);
    s->state = (fw_effects_port_state){
        .t_s = t_s, .piece_s = piece_s, .load = 1, .p = s->p, .w = s->w, .on = s->on};
    for (int i = 0; i < e->switches; i++)
        s->on[i] = false;
    for (int i = 0; i < e->switches; i++)
        s->on[i] = e->class_->switch_value && e->class_->switch_value(&s->e, &s->state, i) > 0;
    e->class_->force(&s->e, &s->state, s->f);
}

void fw_effects_loads_element_force(const fw_mechanism *m, const fw_effects_force_element *e,
                                    double t_s, double piece_s, double *force) {
    still s;
    double local[3 * PORTS_MOST] = {0};
    if (!fw_effects_loads_element_fits(e)) return;
    place_as_drawn(m, e, t_s, piece_s, &s);
    fw_effects_element_add_forces(&s.e, s.q, s.f, local);
    for (int i = 0; i < 3 * e->ports; i++)
        if (e->port[i / 3].body != FW_GROUND) force[3 * e->port[i / 3].body + i % 3] += local[i];
}

fw_geometry_vec2 fw_effects_element_root(const fw_effects_force_element *e, int port) {
    return port < 2 ? e->root_m[port] : (fw_geometry_vec2){0, 0};
}

void fw_effects_loads_element_drag(const fw_mechanism *m, const fw_effects_force_element *e,
                                   double strain, fw_geometry_vec2 centre, double *force) {
    still s;
    double before[3 * PORTS_MOST], local[3 * PORTS_MOST] = {0};
    if (!fw_effects_loads_element_fits(e)) return;
    place_as_drawn(m, e, 0, DBL_MIN, &s);
    memcpy(before, s.f, 3 * (size_t)e->ports * sizeof *before);
    for (int i = 0; i < e->ports; i++)
        if (e->port[i].body == FW_GROUND) {
            const fw_geometry_vec2 root = fw_effects_element_root(e, i);
            s.w[3 * i] = strain * (e->port[i].x_m + root.x - centre.x);
            s.w[3 * i + 1] = strain * (e->port[i].y_m + root.y - centre.y);
        }
    e->class_->force(&s.e, &s.state, s.f);
    for (int i = 0; i < 3 * e->ports; i++)
        s.f[i] -= before[i];
    fw_effects_element_add_forces(&s.e, s.q, s.f, local);
    for (int i = 0; i < 3 * e->ports; i++)
        if (e->port[i / 3].body != FW_GROUND) force[3 * e->port[i / 3].body + i % 3] += local[i];
}

/* of 65 instants evenly over the scene, and behind every break of its laws, the one with the
   largest forces; with the element's laws NULL or end_s 0 the start */
double fw_effects_loads_element_busiest(const fw_mechanism *m, const fw_effects_force_element *e,
                                        double end_s) {
    enum { INSTANTS = 65, BREAKS_MOST = 64 };
    double at[INSTANTS + FW_ELEMENT_LAWS * BREAKS_MOST], most = -1, best = 0;
    int count = 0;
    if (e->laws == 0 || !(end_s > 0) || !fw_effects_loads_element_fits(e)) return 0;
    for (int i = 0; i < INSTANTS; i++)
        at[count++] = end_s * i / (INSTANTS - 1);
    for (int i = 0; i < e->laws; i++) {
        int found = fw_quantity_law_breaks_of(e->law[i], end_s, at + count, BREAKS_MOST);
        count += found < BREAKS_MOST ? found : BREAKS_MOST;
    }
    for (int i = 0; i < count; i++) {
        still s;
        double size = 0;
        place_as_drawn(m, e, at[i], fmax(at[i], DBL_MIN), &s);
        for (int k = 0; k < 3 * e->ports; k++)
            size += fabs(s.f[k]);
        if (size > most) most = size, best = at[i];
    }
    return best;
}

fw_status fw_effects_loads_element_tangent_at(fw_arena *arena, const fw_mechanism *m,
                                              const fw_effects_force_element *e, double t_s,
                                              double piece_s, double *stiffness, double *damping,
                                              bool *valid) {
    size_t n = 3 * (size_t)m->nbody, size = 9 * (size_t)e->ports * (size_t)e->ports;
    fw_mark mark = fw_arena_mark(arena);
    double *q, *k, *c;
    const char *why;
    still s;
    *valid = true;
    if (!fw_effects_loads_element_fits(e)) return FW_OK;
    FW_NEED(q = fw_arena_array(arena, double, n));
    FW_NEED(k = fw_arena_array(arena, double, size));
    FW_NEED(c = fw_arena_array(arena, double, size));
    for (int b = 0; b < m->nbody; b++)
        q[3 * b] = m->body[b].x_m, q[3 * b + 1] = m->body[b].y_m, q[3 * b + 2] = m->body[b].phi_rad;
    place_as_drawn(m, e, t_s, piece_s, &s);
    *valid = !e->class_->valid || e->class_->valid(&s.e, &s.state, &why);
    e->class_->tangent(&s.e, &s.state, k, c);
    const fw_effects_matrix to_k = {.n = 3 * m->nbody, .dense = stiffness},
                            to_c = {.n = 3 * m->nbody, .dense = damping};
    fw_effects_element_spread(e, q, NULL, s.f, k, c, &to_k, damping ? &to_c : NULL);
    fw_arena_rewind(arena, mark);
    return FW_OK;
}

fw_status fw_effects_loads_element_tangent(fw_arena *arena, const fw_mechanism *m,
                                           const fw_effects_loads *loads, double *stiffness,
                                           double *damping) {
    bool valid;
    for (int i = 0; i < loads->nelement; i++)
        FW_TRY(fw_effects_loads_element_tangent_at(arena, m, &loads->element[i], 0, DBL_MIN,
                                                   stiffness, damping, &valid));
    return FW_OK;
}

/* Between the ports of an element and the coordinates of bodies. With the arm r = R(phi) s of a
   port and p(r) = (-r_y, r_x): place x + r, velocity v + omega p(r);  force f: (f, p(r) . f +
   couple) tangent: J^T K J with J = d(place)/dq, and, since dp/dphi = -r, + r . f at (phi, phi);
   damping forces see the velocity, whose derivative by phi is -omega r:  stiffness += J^T C (-omega
   r). */

static fw_geometry_vec2 arm_of(const fw_effects_port *p, const double *q) {
    if (p->body == FW_GROUND) return (fw_geometry_vec2){p->x_m, p->y_m};
    double c = cos(q[3 * p->body + 2]), s = sin(q[3 * p->body + 2]);
    return (fw_geometry_vec2){c * p->x_m - s * p->y_m, s * p->x_m + c * p->y_m};
}

void fw_effects_element_place_ports(const fw_effects_force_element *e, const double *q,
                                    const double *v, double *p, double *w) {
    for (int i = 0; i < e->ports; i++) {
        int b = e->port[i].body;
        fw_geometry_vec2 r = arm_of(&e->port[i], q);
        double *at = p + 3 * i, *speed = w + 3 * i;
        at[0] = r.x, at[1] = r.y, at[2] = 0;
        speed[0] = speed[1] = speed[2] = 0;
        if (b == FW_GROUND) continue;
        at[0] += q[3 * b], at[1] += q[3 * b + 1], at[2] = q[3 * b + 2];
        if (!v) continue;
        speed[0] = v[3 * b] - v[3 * b + 2] * r.y;
        speed[1] = v[3 * b + 1] + v[3 * b + 2] * r.x;
        speed[2] = v[3 * b + 2];
    }
}

void fw_effects_element_add_forces(const fw_effects_force_element *e, const double *q,
                                   const double *f, double *force) {
    for (int i = 0; i < e->ports; i++) {
        int b = e->port[i].body;
        if (b == FW_GROUND) continue;
        fw_geometry_vec2 r = arm_of(&e->port[i], q);
        force[3 * b] += f[3 * i];
        force[3 * b + 1] += f[3 * i + 1];
        force[3 * b + 2] += r.x * f[3 * i + 1] - r.y * f[3 * i] + f[3 * i + 2];
    }
}

/* whole += J_i^T block J_j for ports i, j; J = [1 0 -ry; 0 1 rx; 0 0 1] */
static void spread_block(int bi, int bj, fw_geometry_vec2 ri, fw_geometry_vec2 rj,
                         const double *block, int stride, const fw_effects_matrix *whole) {
    double right[3][3], both[3][3];
    for (int k = 0; k < 3; k++) {
        const double *row = block + k * stride;
        right[k][0] = row[0], right[k][1] = row[1];
        right[k][2] = -rj.y * row[0] + rj.x * row[1] + row[2];
    }
    for (int k = 0; k < 3; k++) {
        both[0][k] = right[0][k], both[1][k] = right[1][k];
        both[2][k] = -ri.y * right[0][k] + ri.x * right[1][k] + right[2][k];
    }
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < 3; l++)
            fw_effects_matrix_add(whole, 3 * bi + k, 3 * bj + l, both[k][l]);
}

/* column phi_j of the stiffness: damping forces that change because the arm of port j turns */
static void spread_turning(int bi, int bj, fw_geometry_vec2 ri, fw_geometry_vec2 rj, double omega,
                           const double *block, int stride, const fw_effects_matrix *whole) {
    double f[3];
    for (int k = 0; k < 3; k++)
        f[k] = -omega * (block[k * stride] * rj.x + block[k * stride + 1] * rj.y);
    f[2] += ri.x * f[1] - ri.y * f[0];
    for (int k = 0; k < 3; k++)
        fw_effects_matrix_add(whole, 3 * bi + k, 3 * bj + 2, f[k]);
}

void fw_effects_element_spread(const fw_effects_force_element *e, const double *q, const double *v,
                               const double *f, const double *stiffness, const double *damping,
                               const fw_effects_matrix *whole_stiffness,
                               const fw_effects_matrix *whole_damping) {
    int stride = 3 * e->ports;
    for (int i = 0; i < e->ports; i++) {
        int bi = e->port[i].body;
        if (bi == FW_GROUND) continue;
        fw_geometry_vec2 ri = arm_of(&e->port[i], q);
        fw_effects_matrix_add(whole_stiffness, 3 * bi + 2, 3 * bi + 2,
                              ri.x * f[3 * i] + ri.y * f[3 * i + 1]);
        for (int j = 0; j < e->ports; j++) {
            int bj = e->port[j].body, at = 3 * i * stride + 3 * j;
            if (bj == FW_GROUND) continue;
            fw_geometry_vec2 rj = arm_of(&e->port[j], q);
            spread_block(bi, bj, ri, rj, stiffness + at, stride, whole_stiffness);
            if (!damping) continue;
            if (v)
                spread_turning(bi, bj, ri, rj, v[3 * bj + 2], damping + at, stride,
                               whole_stiffness);
            if (whole_damping) spread_block(bi, bj, ri, rj, damping + at, stride, whole_damping);
        }
    }
}

/* ---- electrodes, for the drive and for what it leaves out ---- */

static double turn_of(const fw_mechanism *m, int body) {
    return body == FW_GROUND ? 0 : m->body[body].phi_rad;
}

/* F: where edges and ends of a plate meet, C has about 0.75 (h/g)^(1/5) times what (h/g + F)(l/g + 2 E) g has beyond both:
   within 3 % of C against boundary elements in space, for gaps from 0.1 to 1.6 depths. As drawn, for the stator is longer by
   the gap that is drawn: the pull has no part of it. Test: test_fringe.c */
double fw_effects_plate_corners(const fw_effects_comb_element *d) {
    return 1.5 * pow(d->depth_m / d->gap_m, 0.2) * d->edge_F_per_m * d->gap_m *
           fw_effects_plate_edge(d->gap_m, d->width_m, d->depth_m, NULL) *
           fw_effects_plate_end(d->gap_m, d->width_m, d->length_m, NULL);
}

fw_effects_comb_element fw_effects_comb_as_drawn(const fw_effect_case *c,
                                                 const fw_device_comb *from) {
    const fw_mechanism *m = c->mechanism;
    fw_effects_comb_element d = {.kind = from->kind,
                                 .gap_m = from->gap_m,
                                 .overlap_m = from->overlap_m,
                                 .length_m = from->length_m,
                                 .depth_m = from->depth_m,
                                 .width_m = fw_device_comb_width_m(from),
                                 .lean_m = from->lean_m,
                                 .direction_rad = from->direction_rad,
                                 .turn_rad = turn_of(m, from->body_b) - turn_of(m, from->body_a),
                                 .voltage_V = from->voltage_V};
    if (m->variant) d.depth_m = m->variant->thickness_m; /* whatever is stated: FW-D713 */
    if (d.kind == FW_ELECTRODES_COMB && isnan(d.length_m)) d.length_m = 2 * d.overlap_m;
    d.edge_F_per_m =
        FW_VACUUM_PERMITTIVITY_F_PER_m * (d.kind == FW_ELECTRODES_COMB ? (double)from->fingers : 1);
    d.face_Fm = d.edge_F_per_m * d.depth_m;
    if (d.kind == FW_ELECTRODES_COMB)
        d.tip = fw_effects_comb_tips_of(d.gap_m, d.width_m, from->fingers);
    else
        d.tip.corners_F = fw_effects_plate_corners(&d);
    return d;
}

bool fw_effects_comb_drives(const fw_device_comb *c) {
    return c->voltage_V != 0;
}

int fw_effects_comb_count(const fw_effect_case *c) {
    int combs = 0;
    for (int i = 0; i < c->scene->ncomb; i++)
        combs += fw_effects_comb_drives(&c->scene->comb[i]);
    return combs;
}

/* ---- fields at the edges of electrodes ---- */

/* The fringe at both edges of one gap, over eps0 and length: how much longer the straight field would have to be, over
   the gap. Of fingers of width w, gap m on either side, deep against m, alternately at two potentials,

     F(x) = (2 ln(1 + 2x) - 2 ln x + ln(1 + 2x)/x)/pi,   x = m/w

   exactly: the cell from the middle of a finger to that of a gap is mapped onto a half plane (Schwarz and Christoffel),
   where the field is that of a strip. F' and F'' by m. Derivation: docs/theory/effects/fringe-field.md. */
double fw_effects_comb_edge(double gap_m, double width_m, double slope[2]) {
    const double x = gap_m / width_m, ln = log1p(2 * x), per = 1 / (FW_PI * x * x);
    if (slope) {
        slope[0] = -ln * per / width_m;
        slope[1] = (2 * ln / x - 2 / (1 + 2 * x)) * per / (width_m * width_m);
    }
    return (2 * (ln - log(x)) + ln / x) / FW_PI;
}

/* Two bars of width w and depth h, gap g, at +-V/2: the quarter of the section about one of them is mapped onto a half
   plane (Schwarz and Christoffel), its sides found by Newton's method; C/eps0 = K'/K of that map. With x = g/h, y = w/h

     F = (2/pi) ln(B + D/x^(1/2) + A/x),  A = a0 + a1 y^(1/2) + a2 y,  B = b0 + b1 y^(1/2)/(1 + y^(1/2)),
     D = d0/(1 + d1 y^(1/4))

   is within 0.3 % of C and 1.8 % of the pull for x from 0.035 to 4, y from 0.05 to 12; for small x it is the exact
   (2/pi) ln(A/x). */
double fw_effects_plate_edge(double gap_m, double width_m, double depth_m, double slope[2]) {
    const double y = width_m / depth_m, u = 1 / gap_m, root = sqrt(y), deep = sqrt(depth_m * u);
    const double a = fmax(0, -0.049 + 3.028 * root + 8.066 * y) * depth_m * u,
                 b = 1.993 + 1.472 * root / (1 + root), d = 4.084 / (1 + 0.449 * sqrt(root)) * deep,
                 all = a + b + d;
    if (slope) {
        const double by = -(a + 0.5 * d) * u / all;
        slope[0] = 2 / FW_PI * by;
        slope[1] = 2 / FW_PI * ((2 * a + 0.75 * d) * u * u / all - by * by);
    }
    return 2 / FW_PI * log(all);
}

/* One end of a plate, in the plane of the wafer: between that of two equal bars (half of F) and that before a wall
   without end, which is a bar and its image (F at twice the gap). Plates are drawn with a stator that is longer by the
   gap and 10 um at either end: within 0.7 % of C and 1 % of the pull of boundary elements where they are 40 gaps long, 3 % where they are 10. */
double fw_effects_plate_end(double gap_m, double width_m, double length_m, double slope[2]) {
    double equal[2], wall[2];
    const double one = fw_effects_plate_edge(gap_m, width_m, length_m, equal),
                 two = fw_effects_plate_edge(2 * gap_m, width_m, length_m, wall);
    for (int k = 0; slope && k < 2; k++)
        slope[k] = 0.21 * equal[k] + (k + 1) * 2 * 0.58 * wall[k];
    return 0.21 * one + 0.58 * two;
}

/* ---- ends of fingers ---- */

/* Seen from above, the tip of a finger stands in the slot between two fingers of the other comb. Beside one gap g it is as if
   the overlap were longer by T g,

     T = F(2 g/w) - K(w/g) (r/g)^(4/3) + G(q),   q = 2 pi (d + z)/(w + 2 g),   e = exp(-q)
     G = pi w'/(w + 2 g) e/(1 - e) - ln(1 - e)/pi + a1 e + a2 e^2 + a3 e^3

   F of fringe-field (3), exactly, far from the other comb's root; d to there, r the rounding of the tip, which is as if the
   tip were narrower (w') and farther (z). First terms of G: exact for small d; a1..a3, K, z, w' and the law across are fitted to boundary
   elements. For w/g 0.05 to 12 and d from 0.2 g on, of square tips C is within 0.3 %, the pull within 1.2 %; with r up
   to g both are within 2.6 %, up to 1.5 g within 5 %. Theory: docs/theory/effects/comb-drive.md. Test: test_fringe.c */
fw_effects_comb_tips fw_effects_comb_tips_of(double gap_m, double width_m, int fingers) {
    static const double term[3][4] = {{0.356, -0.274, -0.077, -0.852},
                                      {0.060, -0.246, 1.265, -2.199},
                                      {0.354, -0.098, 0.844, -0.179}},
                        less[3][3] = {{0.705, 0.223, -1.324},
                                      {-0.425, 1.530, -0.908},
                                      {0.111, -1.172, 1.874}};
    const double u = width_m / gap_m, t = u / (2 + u), tip = fw_device_comb_tip_m(width_m),
                 r = tip / gap_m, cube = cbrt(u), part = tip / width_m;
    const double narrower = 0.594 * pow(r, 1.23) * (1 + 0.237 * part), n = fingers;
    fw_effects_comb_tips to = {.slot_m = (width_m + 2 * gap_m) / (2 * FW_PI),
                               .back_m = 0.127 * pow(part, 1.249) * pow(r, 0.565) * gap_m,
                               .face = FW_PI * (u - narrower) / (2 + u),
                               .ends = fw_effects_comb_edge(2 * gap_m, width_m, NULL) -
                                       (0.253 + 0.071 / cube + 0.077 / (cube * cube)) * r * cbrt(r),
                               .aside = 0.097 + 0.348 * sqrt(t) - 0.115 * t,
                               .spread_m = 2 * (width_m + gap_m) * sqrt(fmax(n * n - 1, 0) / 12),
                               .edge_m = fw_effects_comb_edge(gap_m, width_m, NULL) * gap_m};
    for (int k = 0; k < 3; k++) {
        to.term[k] = term[k][0] + t * (term[k][1] + t * (term[k][2] + t * term[k][3]));
        to.less[k] = less[k][0] + t * (less[k][1] + t * less[k][2]);
    }
    return to;
}

double fw_effects_comb_tip(const fw_effects_comb_tips *tip, double away_m, double slope[2]) {
    if (!(away_m > 0)) return (double)NAN;
    const double e = exp(-(away_m + tip->back_m) / tip->slot_m), far = 1 / (1 - e), a = e * far;
    double value = a * tip->face + log(far) / FW_PI, by = a * (far * tip->face + 1 / FW_PI),
           more = a * far * (far * (1 + e) * tip->face + 1 / FW_PI), power = e;
    for (int n = 1; n <= 3; n++, power *= e) {
        value += tip->term[n - 1] * power;
        by += n * tip->term[n - 1] * power;
        more += n * n * tip->term[n - 1] * power;
    }
    if (slope) slope[0] = -by / tip->slot_m, slope[1] = more / (tip->slot_m * tip->slot_m);
    return value;
}

double fw_effects_comb_tip_aside(const fw_effects_comb_tips *tip, double away_m, double slope[2]) {
    const double e = exp(-away_m / tip->slot_m);
    double value = tip->aside, power = e;
    slope[0] = slope[1] = 0;
    for (int n = 1; n <= 3; n++, power *= e) {
        value -= tip->less[n - 1] * power;
        slope[0] += n * tip->less[n - 1] * power / tip->slot_m;
        slope[1] -= n * n * tip->less[n - 1] * power / (tip->slot_m * tip->slot_m);
    }
    return value;
}

double fw_effects_comb_away(const fw_effects_comb_element *c, double x_m, double tilt_rad) {
    return c->length_m - c->overlap_m - x_m - c->tip.spread_m * fabs(tilt_rad);
}

double fw_effects_comb_tip_share(const fw_effects_comb_element *c, double away_m) {
    double by[2];
    fw_effects_comb_tip(&c->tip, away_m, by);
    return -2 * c->gap_m * by[0];
}

/* by which the pull of tips may be off: their formula, and how round they come out */
static const double fw_tips_off = 0.05;

/* along: fingers gain what they gain in C, plates what their edges lose as the gap opens */
double fw_effects_comb_fringe(const fw_effects_comb_element *c, const double *place) {
    const double left = c->edge ? 0 : 1, g = c->gap_m;
    double by[2], end[2];
    if (c->kind == FW_ELECTRODES_COMB) {
        const double away = place ? fw_effects_comb_away(c, place[0], place[2])
                                  : 0.25 * fw_effects_comb_away(c, 0, 0),
                     tips = away > 0 ? fw_effects_comb_tip_share(c, away) : (double)INFINITY;
        return (left + 0.5) * c->tip.edge_m / c->depth_m +
               (isfinite(tips) ? fw_tips_off * tips / (1 + tips) : fw_tips_off);
    }
    fw_effects_plate_edge(g, c->width_m, c->depth_m, by);
    fw_effects_plate_end(g, c->width_m, c->length_m, end);
    return -g * g * ((left + 0.5) * by[0] / c->depth_m + left * 2 * end[0] / c->length_m);
}

const char *fw_effects_comb_out_of_range(const fw_effects_comb_element *c) {
    const double wide = c->width_m / c->gap_m, deep = c->depth_m / c->gap_m;
    if (c->kind == FW_ELECTRODES_PLATE)
        return deep < 0.25 ? "the gap is wider than four times the depth of its faces" : NULL;
    if (deep < 0.5) return "the gap is wider than twice the depth of its fingers";
    if (wide < 0.05 || wide > 12)
        return "its fingers are narrower than a twentieth of its gap, or wider than 12 gaps";
    if (c->overlap_m < 0.5 * c->gap_m) return "its fingers overlap by less than half of its gap";
    if (c->length_m < 1.5 * c->gap_m) return "its fingers are shorter than one and a half gaps";
    return NULL;
}

/* ---- what a drive may do within the envelope ---- */

/* its direction as drawn, in the world */
static fw_geometry_vec2 ahead_of(const fw_effect_case *c, const fw_device_comb *from) {
    const double turned = from->direction_rad + turn_of(c->mechanism, from->body_a);
    return (fw_geometry_vec2){cos(turned), sin(turned)};
}

/* across its direction by a motion (3 nbody) of the bodies, and what turns with it */
static double across_by(const fw_effect_case *c, const fw_device_comb *from, const double *motion) {
    const fw_mechanism *m = c->mechanism;
    const fw_geometry_vec2 at = fw_mechanism_local_place(m, from->body_b, from->bx_m, from->by_m),
                           e = ahead_of(c, from);
    double sum = 0;
    for (int k = 0; k < 2; k++) {
        const int body = k ? from->body_b : from->body_a;
        if (body == FW_GROUND) continue;
        const double *u = motion + 3 * body, rx = at.x - m->body[body].x_m,
                     ry = at.y - m->body[body].y_m;
        const double by = -e.y * (u[0] - u[2] * ry) + e.x * (u[1] + u[2] * rx);
        sum += k ? by : -by;
    }
    return sum;
}

/* In modes where all that moves is in them: bodies that go together stay as they are to each other. What is not linear
   moves aside as much of the largest way as it widens the envelope by */
fw_effects_comb_reach fw_effects_comb_reaches(const fw_effect_case *c, const fw_device_comb *from,
                                              const fw_effects_comb_element *d) {
    const fw_effects_envelope *e = c->envelope;
    const fw_quantity_law_size law = fw_quantity_law_measure(from->law, c->scene->duration_s);
    const fw_geometry_vec2 at =
        fw_mechanism_local_place(c->mechanism, from->body_b, from->bx_m, from->by_m);
    const double volt = from->voltage_V * law.most, more = 0.25 * (e->margin - 1);
    fw_effects_comb_reach r = {.square_V2 = volt * volt,
                               .turns = law.most > 0 ? 2 * law.variation / law.most : 0};
    double go = 0;
    const int body[2] = {from->body_a, from->body_b};
    for (int k = 0; k < 2; k++)
        if (body[k] != FW_GROUND) {
            const fw_mechanism_mass *b = &c->mechanism->body[body[k]];
            const double *reach = e->reach + 3 * body[k];
            go += hypot(reach[0], reach[1]) + reach[2] * hypot(at.x - b->x_m, at.y - b->y_m);
            r.tilt_rad += reach[2];
        }
    r.aside_m = r.along_m = go;
    if (!e->modal->shift[0] && !e->modal->shift[1]) {
        r.aside_m = more * go;
        for (int l = 0; l < e->modes; l++)
            r.aside_m += e->margin * e->amplitude[l] *
                         fabs(across_by(c, from, e->shape + (size_t)l * (size_t)e->n));
    }
    r.half_m =
        0.5 * (d->kind == FW_ELECTRODES_COMB ? fmin(d->length_m, d->overlap_m + go) : d->length_m);
    return r;
}

/* on a body at a point, along e and across it: += */
static void push(const fw_effect_case *c, int body, fw_geometry_vec2 at, fw_geometry_vec2 e,
                 double along_N, double across_N, double couple_Nm, double *force) {
    if (body == FW_GROUND) return;
    const fw_mechanism_mass *b = &c->mechanism->body[body];
    const double rx = at.x - b->x_m, ry = at.y - b->y_m;
    force[3 * body] += fabs(e.x) * along_N + fabs(e.y) * across_N;
    force[3 * body + 1] += fabs(e.y) * along_N + fabs(e.x) * across_N;
    force[3 * body + 2] +=
        fabs(rx * e.y - ry * e.x) * along_N + fabs(rx * e.x + ry * e.y) * across_N + couple_Nm;
}

void fw_effects_comb_push(const fw_effect_case *c, const fw_device_comb *from, double along_N,
                          double across_N, double couple_Nm, double *force) {
    const fw_geometry_vec2 at = fw_mechanism_local_place(c->mechanism, from->body_b, from->bx_m,
                                                         from->by_m),
                           ahead = ahead_of(c, from);
    push(c, from->body_a, at, ahead, along_N, across_N, couple_Nm, force);
    push(c, from->body_b, at, ahead, along_N, across_N, couple_Nm, force);
}

fw_status fw_effects_add_nothing(const fw_effect_case *c, fw_effects_loads *loads) {
    (void)c, (void)loads;
    return FW_OK;
}

fw_status fw_effects_element_ended(const fw_effects_force_element *e, const char *scene,
                                   const char *at, const char *why, fw_diags *diags) {
    const fw_diag_ended what = e->class_->closed_form ? FW_ENDED_CLOSED_FORM
                               : e->class_->beam      ? FW_ENDED_BEAM
                                                      : FW_ENDED_FORMULA;
    fw_status status = fw_diag_formula_ended(diags, 242, what, e->place, "%s of %s%s at %s: %s",
                                             e->id, FW_NAMED("scene", scene), at, why);
    return status == FW_NOMEM ? FW_NOMEM : FW_SOLVER;
}
