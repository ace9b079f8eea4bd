/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What touches: the conjugate surfaces of a hinge, or two round things. With D from port 0 to port
   1, the overlap g (positive when pressed) and the force N = k g + c g' along its gradient:

     round, inside   g = |D| - distance        outside  g = distance - |D|
     flat face       g = distance - n.D        n: the normal of the face, which turns with body a
     conjugate       u = D (or -D): W of the convex body from W of the concave one
                     g = |u| - gap             u points to where the surfaces face each other
                     g = n.u - gap             else; n: where they end, the end nearer to u. It
                                               turns with the body whose surface ends there
   Of the distance, what is of something placed (a bead, a fibre) does not grow with the layer, in whose lengths the model
   counts (fw_effects_foreign). Under a temperature with a law it moves, g has a rate of its own, g_t, and N g_t is fed in.
   force -N dg/dp, stiffness dg/dp (k dg/dp + c d2g/dp2 w) + N d2g/dp2, damping c dg/dp dg/dp. It
   acts while its switch is on, min(k g, k g + c g') > 0: pressed, and not pulling.

   Stiffness of the conjugate surfaces where the scene states none: two conforming cylinders of the
   same material in line contact, each compressed over the depth Rc behind it,
     R = Rc (Rc + gap)/gap,  Ec = E/(2 (1 - nu^2)),  b^2 = 4 F R/(pi h Ec)
     k = pi h Ec / (2 ln(4 Rc/b) - 1)   at F = gap k_hinge, the force that closes the gap; ten times
   the force changes k by about a quarter. What rings and links give behind the surfaces is not in
   it: the stiffness is an upper limit. Valid b << Rc, h >> b (plane strain).
   Inputs SI. Source: K. L. Johnson, Contact Mechanics, Cambridge 1985, sections 4.2 and 5.6;
   docs/theory/effects/contact.md. Test: test_contact.c. */
#include "effects/effect.h"
#include "base/constants.h"
#include "effects/envelope.h"
#include <math.h>
#include <string.h>

enum { N = 6 };

typedef struct touch { /* data; ports: point of body a, point of body b */
    double distance_m, k_N_per_m, c_Ns_per_m;
    double
        placed_m; /* of that, of what is not of the layer and changes with time as `foreign` does */
    fw_effects_foreign foreign;
    double side; /* 1: |D| beyond the distance presses, -1: below it */
    bool face;   /* port 0 is a point of a flat face with this normal in its body's frame: */
    double face_rad;
    bool partial;            /* the surfaces face each other only in a sector of directions: */
    double sense;            /* u = sense D */
    double from_rad, to_rad; /* less the turn of the body that they go with */
    int from_port, to_port;
} touch;

typedef struct overlap {
    double value, rate, slope[N], curve[N][N];
} overlap;

/* g = o (|D| - distance) */
static void radial(const double *p, double o, double distance, bool second, overlap *g) {
    double x = p[3] - p[0], y = p[4] - p[1], l = hypot(x, y);
    double nx = l > 0 ? x / l : 1, ny = l > 0 ? y / l : 0;
    const double along[N] = {-nx, -ny, 0, nx, ny, 0}, across[N] = {ny, -nx, 0, -ny, nx, 0};
    g->value = o * (l - distance);
    for (int i = 0; i < N; i++)
        g->slope[i] = o * along[i];
    for (int i = 0; i < N && second; i++)
        for (int j = 0; j < N; j++)
            g->curve[i][j] = l > 0 ? o * across[i] * across[j] / l : 0;
}

/* g = n.u - gap, n = (cos angle, sin angle) turning with a port */
static void ended(const double *p, double o, double angle, int port, double gap, bool second,
                  overlap *g) {
    double x = p[3] - p[0], y = p[4] - p[1], c = cos(angle), s = sin(angle);
    const double along[N] = {-o * c, -o * s, 0, o * c, o * s, 0};
    const double across[N] = {o * s, -o * c, 0, -o * s, o * c, 0};
    int turn = 3 * port + 2;
    g->value = o * (c * x + s * y) - gap;
    memcpy(g->slope, along, sizeof along);
    g->slope[turn] = o * (c * y - s * x);
    if (!second) return;
    memset(g->curve, 0, sizeof g->curve);
    for (int i = 0; i < N; i++)
        if (i != turn) g->curve[i][turn] = g->curve[turn][i] = across[i];
    g->curve[turn][turn] = -o * (c * x + s * y);
}

/* from where the surfaces begin to face each other to u */
static double angle_behind(double ux, double uy, double from) {
    const double behind = fmod(atan2(uy, ux) - from, 2 * FW_PI);
    return behind < 0 ? behind + 2 * FW_PI : behind;
}

static void overlap_of(const touch *t, const double *p, double distance, bool second, overlap *g) {
    double ux = t->sense * (p[3] - p[0]), uy = t->sense * (p[4] - p[1]);
    double from = t->from_rad + p[3 * t->from_port + 2], to = t->to_rad + p[3 * t->to_port + 2];
    if (t->face)
        ended(p, -1, t->face_rad + p[2], 0, -distance, second, g);
    else if (!t->partial || angle_behind(ux, uy, from) <= to - from)
        radial(p, t->side, distance, second, g);
    else if (cos(from) * ux + sin(from) * uy > cos(to) * ux + sin(to) * uy)
        ended(p, t->sense, from, t->from_port, distance, second, g);
    else
        ended(p, t->sense, to, t->to_port, distance, second, g);
}

/* the distance and its rate: of what is placed between surfaces of a layer that grows */
static double distance_at(const touch *t, const fw_effects_port_state *s, double *rate) {
    *rate = 0;
    if (!t->foreign.law) return t->distance_m;
    double way;
    const double factor = fw_effects_foreign_at(&t->foreign, s->t_s, s->piece_s, &way);
    *rate = s->still ? 0 : t->placed_m * way;
    return t->distance_m + t->placed_m * (factor - 1);
}

static void overlap_at(const fw_effects_force_element *e, const fw_effects_port_state *s,
                       bool second, overlap *g) {
    const touch *t = e->data;
    double rate;
    const double distance = distance_at(t, s, &rate);
    overlap_of(t, s->p, distance, second, g);
    g->rate = -t->side * rate;
    for (int i = 0; i < N; i++)
        g->rate += g->slope[i] * s->w[i];
}

static void force(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    const touch *t = e->data;
    overlap g;
    overlap_at(e, s, false, &g);
    double modal_load = s->on[0] ? t->k_N_per_m * g.value + t->c_Ns_per_m * g.rate : 0;
    for (int i = 0; i < N; i++)
        f[i] = -modal_load * g.slope[i];
}

static void tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                    double *stiffness, double *damping) {
    const touch *t = e->data;
    overlap g;
    memset(stiffness, 0, N * N * sizeof *stiffness);
    memset(damping, 0, N * N * sizeof *damping);
    if (!s->on[0]) return;
    overlap_at(e, s, true, &g);
    double modal_load = t->k_N_per_m * g.value + t->c_Ns_per_m * g.rate;
    for (int j = 0; j < N; j++) {
        double turning = 0; /* of g' by p_j */
        for (int i = 0; i < N; i++)
            turning += g.curve[i][j] * s->w[i];
        double by = t->k_N_per_m * g.slope[j] + t->c_Ns_per_m * turning;
        for (int i = 0; i < N; i++) {
            stiffness[N * i + j] = g.slope[i] * by + modal_load * g.curve[i][j];
            damping[N * i + j] = t->c_Ns_per_m * g.slope[i] * g.slope[j];
        }
    }
}

static double energy(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const touch *t = e->data;
    overlap g;
    if (!s->on[0]) return 0;
    overlap_at(e, s, false, &g);
    return 0.5 * t->k_N_per_m * g.value * g.value;
}

static void power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  double power[2]) {
    const touch *t = e->data;
    overlap g;
    overlap_at(e, s, false, &g);
    power[0] = s->on[0] ? t->c_Ns_per_m * g.rate * g.rate : 0;
    double way;
    distance_at(t, s, &way);
    power[1] = s->on[0] ? -t->side * way * (t->k_N_per_m * g.value + t->c_Ns_per_m * g.rate) : 0;
}

static double switch_value(const fw_effects_force_element *e, const fw_effects_port_state *s,
                           int i) {
    (void)i;
    const touch *t = e->data;
    overlap g;
    overlap_at(e, s, false, &g);
    double elastic = t->k_N_per_m * g.value;
    return fmin(elastic, elastic + t->c_Ns_per_m * g.rate);
}

static double pressing(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const touch *t = e->data;
    overlap g;
    if (!s->on[0]) return 0;
    overlap_at(e, s, false, &g);
    return fmax(0, t->k_N_per_m * g.value + t->c_Ns_per_m * g.rate);
}

static const fw_effects_element_class class_ = {.effect = "contact",
                                                .force = force,
                                                .tangent = tangent,
                                                .energy = energy,
                                                .power = power,
                                                .switch_value = switch_value,
                                                .pressing = pressing};

/* ---- from the scene ---- */

static bool called_for(const fw_effect_case *c) {
    return c->scene->ncontact > 0;
}

static int count(const fw_effect_case *c) {
    return c->scene->ncontact;
}

double fw_effects_line_contact(double youngs_Pa, double poisson, double depth_m, double radius_m,
                               double gap_m, double force_N) {
    double modulus = youngs_Pa / (2 * (1 - poisson * poisson));
    double relative = radius_m * (radius_m + gap_m) / gap_m;
    double half = sqrt(4 * force_N * relative / (FW_PI * depth_m * modulus));
    return FW_PI * depth_m * modulus / (2 * log(4 * radius_m / fmin(half, radius_m)) - 1);
}

static double surface_stiffness(const fw_effect_case *c, const fw_mechanism_hinge *h, double gap) {
    const fw_mechanism_variant *v = c->mechanism->variant;
    fw_flexure_hinge_at at;
    if (!v || v->material.youngs.unknown || !(h->surface_radius_m > 0)) return 0;
    fw_flexure_hinge_law_at(&h->law, 0, &at);
    double nu = v->material.poisson.unknown ? 0 : v->material.poisson.value;
    return fw_effects_line_contact(v->material.youngs.value, nu, v->thickness_m,
                                   h->surface_radius_m, gap,
                                   gap * fmin(at.kx_N_per_m.value, at.ky_N_per_m.value));
}

static fw_status unknown(const fw_effect_case *c, const fw_device_contact_use *use,
                         const char *what) {
    if (!c->diags) return FW_INPUT;
    return fw_diag_error(c->diags, 246, use->place, "%s%s: %s",
                         FW_NAMED("contact", use->id ? use->id : ""), what);
}

static double drawn_turn(const fw_mechanism *m, int body) {
    return body == FW_GROUND ? 0 : m->body[body].phi_rad;
}

static fw_status put(const fw_effect_case *c, fw_effects_loads *loads,
                     const fw_device_contact_use *use, const fw_effects_port port[2],
                     const touch *from) {
    touch *t = fw_arena_one(c->arena, touch);
    fw_effects_force_element *e = fw_effects_loads_add_element(c->arena, loads, &class_, 2);
    if (!t || !e) return FW_NOMEM;
    *t = *from;
    if (use->id) e->id = use->id;
    e->place = use->place;
    e->port[0] = port[0], e->port[1] = port[1];
    e->switches = 1;
    e->data = t;
    e->size_N_per_m = t->k_N_per_m;
    e->dissipates = t->c_Ns_per_m > 0;
    if (t->foreign.law) e->law[0] = t->foreign.law, e->laws = 1, e->works = true;
    return FW_OK;
}

static fw_status add_conjugate(const fw_effect_case *c, fw_effects_loads *loads,
                               const fw_device_contact_use *use) {
    const fw_mechanism *m = c->mechanism;
    const fw_mechanism_hinge *h = fw_effects_contact_hinge(m, use);
    if (!h)
        return unknown(c, use,
                       "the joint is no flexure hinge, so it has no conjugate surfaces; name "
                       "a hinge with a flexure, or two points with a and b");
    if (!fw_effects_hinge_is_known(h))
        return unknown(c, use,
                       "the hinge is not drawn, so the direction in which it gives is not known; "
                       "give its bodies a width or a plate, or the hinge an axis");
    double gap = fw_effects_contact_gap(c, use, h);
    if (!(gap > 0))
        return unknown(
            c, use,
            "the hinge has no conjugate surfaces; give its flexure a gap and its bodies a "
            "width or a plate, or the contact a distance and a stiffness");
    double k =
        isnan(use->stiffness_N_per_m) ? surface_stiffness(c, h, gap) : use->stiffness_N_per_m;
    if (!(k > 0) || !isfinite(k))
        return unknown(c, use,
                       "the stiffness of surfaces that are not drawn, or of a material "
                       "without Young's modulus, is not known; give the contact a stiffness");
    const fw_mechanism_pin *p = &m->pin[h->pin];
    int upper = h->first_is_a ? 1 : 0;
    int body[2] = {p->body_a, p->body_b};
    touch t = {.distance_m = gap,
               .k_N_per_m = k,
               .c_Ns_per_m = isnan(use->damping_Ns_per_m) ? 0 : use->damping_Ns_per_m,
               .side = 1,
               .sense = h->convex_is_a ? -1 : 1,
               .partial = isfinite(h->cover_from_rad) && isfinite(h->cover_to_rad),
               .from_port = upper,
               .to_port = !upper};
    if (t.partial) { /* as drawn in the world, then with the body of the end */
        double a = drawn_turn(m, p->body_a);
        t.from_rad = h->cover_from_rad + a - drawn_turn(m, body[t.from_port]);
        t.to_rad = h->cover_to_rad + a - drawn_turn(m, body[t.to_port]);
    }
    FW_TRY(fw_effects_hinge_release(c, loads, p->hinge));
    /* where the surfaces are drawn, which of a crystal is not where its pin is */
    const fw_effects_port port[2] = {{p->body_a, p->ax_m - h->off_a_m.x, p->ay_m - h->off_a_m.y},
                                     {p->body_b, p->bx_m - h->off_b_m.x, p->by_m - h->off_b_m.y}};
    return put(c, loads, use, port, &t);
}

/* Of the distance of two things side by side: what is of the layer, as far as it is drawn. A round thing is drawn where its
   centre lies in what is drawn of its body, and then reaches to the nearest edge, or farther where pieces overlap; what a flat face
   meets is drawn where an edge of its body lies near the place where it begins. */
static const double drawn_near = 10e-6; /* as verdict/fabrication.c has it */

static double round_drawn(const fw_layout *layout, int body, fw_geometry_vec2 at) {
    double most = 0;
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        double near = HUGE_VAL;
        if (p->body != body || !fw_layout_is_wall(p) ||
            fw_geometry_contour_winding(&p->contour, at) == 0)
            continue;
        for (int k = 0; k < p->contour.count; k++)
            near = fmin(near, fw_geometry_segment_nearest(&p->contour.segment[k], at, NULL, NULL));
        most = fmax(most, near);
    }
    return most;
}

static bool edge_near(const fw_layout *layout, int body, fw_geometry_vec2 at) {
    for (int i = 0; i < layout->npiece; i++) {
        const fw_layout_piece *p = &layout->piece[i];
        for (int k = 0; p->body == body && fw_layout_is_wall(p) && k < p->contour.count; k++)
            if (fw_geometry_segment_nearest(&p->contour.segment[k], at, NULL, NULL) <= drawn_near)
                return true;
    }
    return false;
}

/* What is not said to be etched, and not drawn, is placed. Of a body that no drawing has, only what is said to be. A disc in a hole
   counts as of the layer: which of the two were placed, and how large it is, the file does not say. In, out: m. Error: that of
   the drawn radius, 10 um at most where outlines are as stated, times the growth of some 1e-3. Test: test_thermal.c,
   test_heated.py */
double fw_effects_contact_placed(const fw_mechanism *m, const fw_device_contact_use *use) {
    const double all = use->distance_m;
    const bool placed = use->undrawn == FW_UNDRAWN_PLACED, drawn = m->layout && m->layout->drawn;
    if (use->joint != FW_NONE || use->side == FW_CONTACT_INSIDE || !(all > 0) ||
        use->undrawn == FW_UNDRAWN_ETCHED || (!drawn && !placed))
        return 0;
    if (!drawn) return all;
    const fw_geometry_vec2 a = fw_mechanism_local_place(m, use->body_a, use->ax_m, use->ay_m),
                           b = fw_mechanism_local_place(m, use->body_b, use->bx_m, use->by_m);
    const bool has_a = fw_layout_has_outline(m->layout, use->body_a),
               has_b = fw_layout_has_outline(m->layout, use->body_b);
    if (!placed && !(has_a && has_b)) return 0;
    if (use->face) {
        const double normal = use->face_rad + drawn_turn(m, use->body_a);
        const fw_geometry_vec2 begins = {b.x - all * cos(normal), b.y - all * sin(normal)};
        return edge_near(m->layout, use->body_b, begins) ? 0 : all;
    }
    const double of_a = round_drawn(m->layout, use->body_a, a),
                 of_b = round_drawn(m->layout, use->body_b, b);
    return of_a > 0 && of_b > 0 ? 0 : fmax(0, all - of_a - of_b);
}

static touch round_of(const fw_device_contact_use *use) {
    return (touch){.distance_m = use->distance_m,
                   .k_N_per_m = use->stiffness_N_per_m,
                   .c_Ns_per_m = isnan(use->damping_Ns_per_m) ? 0 : use->damping_Ns_per_m,
                   .side = use->side == FW_CONTACT_INSIDE ? 1 : -1,
                   .face = use->face,
                   .face_rad = use->face_rad,
                   .sense = 1};
}

/* What is left between the two of a contact of two bodies, -g of the head of this file. In: q (3 nbody) m and rad, NULL:
   the drawn pose. Out: m, and slope (3 nbody) by q, or NULL. Exact. Test: test_adhesion.c two_bodies */
double fw_effects_contact_open(const fw_mechanism *m, const fw_device_contact_use *use,
                               const double *q, double *slope) {
    const int body[2] = {use->body_a, use->body_b};
    double at[N] = {0}, p[N], still[N], by[N] = {0};
    fw_effects_port port[2] = {{0, use->ax_m, use->ay_m}, {1, use->bx_m, use->by_m}};
    for (int i = 0; i < 2; i++) {
        if (body[i] == FW_GROUND) {
            port[i].body = FW_GROUND;
            continue;
        }
        const fw_mechanism_mass *b = &m->body[body[i]];
        const double drawn[3] = {b->x_m, b->y_m, b->phi_rad};
        memcpy(at + 3 * i, q ? q + 3 * body[i] : drawn, sizeof drawn);
    }
    const fw_effects_force_element e = {.port = port, .ports = 2};
    const touch t = round_of(use);
    overlap g = {0};
    fw_effects_element_place_ports(&e, at, NULL, p, still);
    overlap_of(&t, p, t.distance_m, false, &g);
    if (!slope) return -g.value;
    fw_effects_element_add_forces(&e, at, g.slope, by);
    memset(slope, 0, 3 * (size_t)m->nbody * sizeof *slope);
    for (int i = 0; i < N; i++)
        if (body[i / 3] != FW_GROUND) slope[3 * body[i / 3] + i % 3] -= by[i];
    return -g.value;
}

static fw_status add_round(const fw_effect_case *c, fw_effects_loads *loads,
                           const fw_device_contact_use *use) {
    /* of a face as made it may be below 0, where an edge has moved beyond the point that it was stated by */
    if (!(use->face ? isfinite(use->distance_m) : use->distance_m > 0) ||
        !(use->stiffness_N_per_m > 0) || !isfinite(use->stiffness_N_per_m))
        return unknown(c, use, "two round things need a distance and a stiffness above 0");
    touch t = round_of(use);
    t.placed_m = fw_effects_contact_placed(c->mechanism, use);
    t.foreign = fw_effects_foreign_of(c, use->expansion_per_K);
    if (!t.foreign.law) /* for good */
        t.distance_m += t.placed_m * (fw_effects_foreign_at(&t.foreign, 0, 0, NULL) - 1);
    if (t.placed_m == 0) t.foreign.law = NULL;
    const fw_effects_port port[2] = {{use->body_a, use->ax_m, use->ay_m},
                                     {use->body_b, use->bx_m, use->by_m}};
    return put(c, loads, use, port, &t);
}

static fw_status add(const fw_effect_case *c, fw_effects_loads *loads) {
    fw_status status = FW_OK;
    for (int i = 0; i < c->scene->ncontact; i++) {
        const fw_device_contact_use *use = &c->scene->contact[i];
        fw_status now =
            use->joint == FW_NONE ? add_round(c, loads, use) : add_conjugate(c, loads, use);
        if (now == FW_NOMEM) return now;
        if (status == FW_OK) status = now;
    }
    return status;
}

/* ---- what is said ---- */

/* m: less is within what etching moves edges by */
static const double drawn_closed = 1e-6;

/* round things that overlap as they are drawn are not two solids of one layer; conjugate surfaces
   are drawn with their gap open */
static fw_status check(const fw_effect_case *c, fw_diags *diags) {
    for (int i = 0; i < c->scene->ncontact; i++) {
        const fw_device_contact_use *use = &c->scene->contact[i];
        if (use->joint != FW_NONE || fw_diag_said(diags, 134, use->place)) continue;
        fw_geometry_vec2 a =
            fw_mechanism_local_place(c->mechanism, use->body_a, use->ax_m, use->ay_m);
        fw_geometry_vec2 b =
            fw_mechanism_local_place(c->mechanism, use->body_b, use->bx_m, use->by_m);
        const double normal = use->face_rad + drawn_turn(c->mechanism, use->body_a);
        double apart = use->face ? cos(normal) * (b.x - a.x) + sin(normal) * (b.y - a.y)
                                 : hypot(b.x - a.x, b.y - a.y);
        double past = apart - use->distance_m;
        if (use->side != FW_CONTACT_INSIDE) past = -past;
        char deep[32], far[32], at[32];
        if (!(past > drawn_closed)) continue;
        /* what somebody puts there may be pressed in */
        (use->undrawn == FW_UNDRAWN_PLACED ? fw_diag_warning : fw_diag_unreliable)(
            diags, 134, use->place,
            "%s%s overlaps by %s um in the drawn pose: what touches is %s um "
            "apart and touches at a distance of %s um; correct the points, the "
            "distance or the side",
            FW_NAMED("contact", fw_text_name(use->id)),
            fw_number_text(deep, sizeof deep, 1e6 * past, 4),
            fw_number_text(far, sizeof far, 1e6 * apart, 4),
            fw_number_text(at, sizeof at, 1e6 * use->distance_m, 4));
    }
    return diags->failed ? FW_NOMEM : FW_OK;
}

/* 0 where the envelope of the motion leaves every gap open (hinges: force and drift of W by
   nonlinear_hinge.c; points: reach of their bodies, and the same for every hinge on the way); otherwise
   what it changes is everything behind the touch. Test: test_contact.c. */
static fw_status bound(const fw_effect_case *c, double *value, const char **reason) {
    *value = (double)INFINITY;
    *reason = "surfaces may touch: what that changes is the motion itself";
    if (fw_effects_contact_may_touch(c)) return FW_OK;
    *value = 0;
    *reason = "no gap closes within the reach of the motion";
    return FW_OK;
}

static void describe(const fw_device *device, const fw_device_scene *s,
                     const fw_effects_words *to) {
    (void)device;
    for (int i = 0; i < s->ncontact; i++)
        fw_effects_say(to, "; contact {s}", s->contact[i].id);
}

const fw_effect_row fw_effect_contact = {.id = "contact",
                                         .summary = "surfaces that press on each other where a gap "
                                                    "is closed",
                                         .called_for = called_for,
                                         .bound = bound,
                                         .add = add,
                                         .check = check,
                                         .cost = 1350,
                                         .count = count,
                                         .describe = describe};
