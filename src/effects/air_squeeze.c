/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Squeeze film between two side walls that stand opposite each other, length a along the wafer and
   depth b across it: the air must leave through the edges. With the gap g of the walls' middles,

     g = n.(p_1 - p_0),   force along g:  -c(g) g',   c = 12 mu_eff I/g^3,
     I = a b^3/12 (1 - (192 b/(pi^5 a)) sum over odd k of tanh(k pi a/(2 b))/k^5),
     mu_eff = mu/(1 + 9.638 Kn^1.159),   Kn = mean free path/g,

   n the normal of the second wall, which turns with its body; the walls count as parallel. c is
   that of the incompressible Reynolds equation with ambient pressure at the edges: 0.4217 mu
   a^4/g^3 for a square. Source: Blech, J. Lubr. Technol. 105 (1983) 615 (small squeeze numbers);
   Veijola, Kuisma, Lahdenpera and Ryhanen, Sensors and Actuators A 48 (1995) 239 (rarefaction, Kn
   up to 880 within 5 %). Valid for squeeze number 12 mu omega b^2/(p g^2) and film Reynolds number
   rho omega g^2/mu below 1, and g small against both sides. Test: test_air.c (I against a solution
   by differences). */
#include "effects/air.h"
#include "base/constants.h"
#include <math.h>

static const double slip = 9.638, slip_power = 1.159;

/* the series converges like exp only in its first term; 40 terms leave 1e-9 of what it subtracts.
   tanh(x)/k^5 -> 1/k^5, whose tail behind K is below 1/(8 K^4) */
double fw_effects_rectangle_integral(double a_m, double b_m) {
    double a = fmax(a_m, b_m), b = fmin(a_m, b_m), sum = 0;
    for (int k = 79; k > 0; k -= 2)
        sum += tanh(k * FW_PI * a / (2 * b)) / ((double)k * k * k * k * k);
    return a * b * b * b / 12 * (1 - 192 * b / (FW_PI * FW_PI * FW_PI * FW_PI * FW_PI * a) * sum);
}

fw_effects_squeeze fw_effects_air_squeeze(const fw_effects_gas *gas, double length_m,
                                          double depth_m, double gap_m) {
    return (fw_effects_squeeze){.c0_Nsm2 = 12 * gas->viscosity_Pas *
                                           fw_effects_rectangle_integral(length_m, depth_m),
                                .path_m = gas->path_m,
                                .least_m = 1e-6 * gap_m};
}

double fw_effects_squeeze_at(const fw_effects_squeeze *film, double gap_m, double *slope) {
    double g = fmax(gap_m, film->least_m), rare = slip * pow(film->path_m / g, slip_power);
    double c = film->c0_Nsm2 / (g * g * g * (1 + rare));
    if (slope) *slope = gap_m < g ? 0 : c / g * (slip_power * rare / (1 + rare) - 3);
    return c;
}

double fw_effects_air_depth(const fw_mechanism *m, const fw_device_air *air) {
    if (!isnan(air->depth_m)) return air->depth_m;
    return m->variant ? m->variant->thickness_m : (double)NAN;
}

typedef struct opening { /* gap, its rate, its gradient (6) by the ports and that of its rate */
    double gap, rate, by[6], rate_by[6], n[2], t[2];
} opening;

/* d = p1 - p0, n(phi1), t = dn/dphi1: the gradient is (-n, 0, n, t.d); second derivatives -t and t
   of (p0, phi1), (p1, phi1), and -n.d of (phi1, phi1) */
static opening look(const fw_effects_force_element *e, const fw_effects_port_state *s) {
    const fw_effects_squeeze *film = e->data;
    const double *p = s->p, *w = s->w;
    double angle = p[5] + film->angle_rad, dx = p[3] - p[0], dy = p[4] - p[1];
    opening o = {.n = {cos(angle), sin(angle)}};
    o.t[0] = -o.n[1], o.t[1] = o.n[0];
    o.gap = o.n[0] * dx + o.n[1] * dy;
    o.by[0] = -o.n[0], o.by[1] = -o.n[1];
    o.by[3] = o.n[0], o.by[4] = o.n[1];
    o.by[5] = o.t[0] * dx + o.t[1] * dy;
    for (int i = 0; i < 6; i++)
        o.rate += o.by[i] * w[i];
    for (int k = 0; k < 2; k++) {
        o.rate_by[k] = -o.t[k] * w[5];
        o.rate_by[3 + k] = o.t[k] * w[5];
        o.rate_by[5] += o.t[k] * (w[3 + k] - w[k]);
    }
    o.rate_by[5] -= o.gap * w[5];
    return o;
}

static void force(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    opening o = look(e, s);
    double modal_load = -fw_effects_squeeze_at(e->data, o.gap, NULL) * o.rate;
    for (int i = 0; i < 6; i++)
        f[i] = modal_load * o.by[i];
}

static void tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                    double *stiffness, double *damping) {
    opening o = look(e, s);
    double slope, c = fw_effects_squeeze_at(e->data, o.gap, &slope), modal_load = -c * o.rate;
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            damping[6 * i + j] = c * o.by[i] * o.by[j];
            stiffness[6 * i + j] = o.by[i] * (slope * o.rate * o.by[j] + c * o.rate_by[j]);
        }
    for (int k = 0; k < 2; k++) {
        stiffness[6 * k + 5] += modal_load * o.t[k];
        stiffness[6 * 5 + k] += modal_load * o.t[k];
        stiffness[6 * (3 + k) + 5] -= modal_load * o.t[k];
        stiffness[6 * 5 + 3 + k] -= modal_load * o.t[k];
    }
    stiffness[6 * 5 + 5] += modal_load * o.gap;
}

static void power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  double out[2]) {
    opening o = look(e, s);
    out[0] = fw_effects_squeeze_at(e->data, o.gap, NULL) * o.rate * o.rate;
    out[1] = 0;
}

static bool valid(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  const char **why) {
    if (look(e, s).gap > ((const fw_effects_squeeze *)e->data)->least_m) return true;
    *why = "the walls of its squeeze film touch, and a film of no thickness has no formula: widen "
           "the gap, or state a <contact> that holds the walls apart";
    return false;
}

static const fw_effects_element_class squeeze_class = {
    .effect = "air", .force = force, .tangent = tangent, .power = power, .valid = valid};

static double turn_of(const fw_mechanism *m, int body) {
    return body == FW_GROUND ? 0 : m->body[body].phi_rad;
}

fw_status fw_effects_air_squeeze_add(const fw_effect_case *c, fw_effects_loads *loads,
                                     const fw_device_air *air) {
    const fw_mechanism *m = c->mechanism;
    fw_effects_squeeze *data = fw_arena_one(c->arena, fw_effects_squeeze);
    fw_effects_force_element *e = fw_effects_loads_add_element(c->arena, loads, &squeeze_class, 2);
    FW_NEED(data && e);
    const fw_effects_gas gas = fw_effects_gas_of(air);
    *data = fw_effects_air_squeeze(&gas, air->length_m, fw_effects_air_depth(m, air), air->gap_m);
    double out = air->direction_rad + turn_of(m, air->body), frame = turn_of(m, air->against);
    data->angle_rad = out - frame;
    fw_geometry_vec2 wall = fw_mechanism_local_place(m, air->body, air->x_m, air->y_m);
    fw_geometry_vec2 other = {wall.x + air->gap_m * cos(out), wall.y + air->gap_m * sin(out)};
    if (air->against != FW_GROUND) { /* into its frame */
        const fw_mechanism_mass *b = &m->body[air->against];
        double dx = other.x - b->x_m, dy = other.y - b->y_m;
        other = (fw_geometry_vec2){cos(frame) * dx + sin(frame) * dy,
                                   -sin(frame) * dx + cos(frame) * dy};
    }
    e->id = air->body == FW_GROUND ? "ground" : m->body[air->body].id;
    e->place = air->place;
    e->port[0] = (fw_effects_port){air->body, air->x_m, air->y_m};
    e->port[1] = (fw_effects_port){air->against, other.x, other.y};
    e->dissipates = true;
    e->data = data;
    return FW_OK;
}
