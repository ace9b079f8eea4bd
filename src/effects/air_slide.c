/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Couette film: the air between the face of a body and the plane below it is sheared. With the gap
   g, viscosity mu_eff and the velocity field v + omega x r of the face,

     force -mu_eff A/g v at the centre of mass,   couple -mu_eff I_p/g omega,
     mu_eff = mu/(1 + 2 Kn),   Kn = mean free path/g   (slip on both walls)

   A area, I_p polar moment about the centre of mass; the plane takes the opposite. Source: Couette
   flow with first-order slip, e.g. Veijola and Turowski, J. Microelectromech. Syst. 10 (2001) 263.
   Valid while the gap is small against the penetration depth sqrt(2 nu/omega) and the face's size;
   accommodation 1. For Kn >> 1 it becomes the free-molecular mu A/(2 path) v. Test: test_air.c. */
#include "effects/air.h"

fw_effects_damper fw_effects_air_slide(const fw_effects_gas *gas, const fw_effects_face *face,
                                       double gap_m) {
    double per_gap = gas->viscosity_Pas / (gap_m + 2 * gas->path_m);
    return (fw_effects_damper){per_gap * face->area_m2, per_gap * face->polar_m4};
}

/* v = B w, v the velocity of the body's port over the plane, which may itself turn about its own:
   d = p0 - p1, v = w0 - w1 - omega1 (-dy, dx). Forces -c B^T v, couples -k (omega0 - omega1). */
static void rows_of(const fw_effects_port_state *s, double b[2][6], double v[2]) {
    double dx = s->p[0] - s->p[3], dy = s->p[1] - s->p[4];
    const double all[2][6] = {{1, 0, 0, -1, 0, dy}, {0, 1, 0, 0, -1, -dx}};
    for (int i = 0; i < 2; i++) {
        v[i] = 0;
        for (int j = 0; j < 6; j++)
            b[i][j] = all[i][j], v[i] += all[i][j] * s->w[j];
    }
}

static void force(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    const fw_effects_damper *d = e->data;
    double b[2][6], v[2], turn = d->couple_Nms * (s->w[2] - s->w[5]);
    rows_of(s, b, v);
    for (int j = 0; j < 6; j++)
        f[j] = -d->force_Ns_per_m * (b[0][j] * v[0] + b[1][j] * v[1]);
    f[2] -= turn, f[5] += turn;
}

static void tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                    double *stiffness, double *damping) {
    const fw_effects_damper *d = e->data;
    const double c = d->force_Ns_per_m, spin = s->w[5];
    double b[2][6], v[2];
    rows_of(s, b, v);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++) {
            damping[6 * i + j] = c * (b[0][i] * b[0][j] + b[1][i] * b[1][j]);
            stiffness[6 * i + j] = 0;
        }
    for (int sign = 1, j = 0; j < 6; j += 3, sign = -1) { /* columns of d: p0 and, negative, p1 */
        for (int i = 0; i < 6; i++) { /* dv/ddx = (0, -spin), dv/ddy = (spin, 0) */
            stiffness[6 * i + j] = -sign * c * b[1][i] * spin;
            stiffness[6 * i + j + 1] = sign * c * b[0][i] * spin;
        }
        stiffness[6 * 5 + j] -= sign * c * v[1];
        stiffness[6 * 5 + j + 1] += sign * c * v[0];
    }
    damping[6 * 2 + 2] += d->couple_Nms, damping[6 * 5 + 5] += d->couple_Nms;
    damping[6 * 2 + 5] -= d->couple_Nms, damping[6 * 5 + 2] -= d->couple_Nms;
}

static void power(const fw_effects_force_element *e, const fw_effects_port_state *s,
                  double out[2]) {
    const fw_effects_damper *d = e->data;
    double b[2][6], v[2], spin = s->w[2] - s->w[5];
    rows_of(s, b, v);
    out[0] = d->force_Ns_per_m * (v[0] * v[0] + v[1] * v[1]) + d->couple_Nms * spin * spin;
    out[1] = 0;
}

static const fw_effects_element_class slide_class = {
    .effect = "air", .force = force, .tangent = tangent, .power = power};

fw_status fw_effects_air_slide_add(const fw_effect_case *c, fw_effects_loads *loads,
                                   const fw_device_air *air, int body) {
    fw_effects_damper *data = fw_arena_one(c->arena, fw_effects_damper);
    fw_effects_force_element *e = fw_effects_loads_add_element(c->arena, loads, &slide_class, 2);
    FW_NEED(data && e);
    const fw_effects_gas gas = fw_effects_gas_of(air);
    const fw_effects_face face = fw_effects_air_face(c->mechanism, air, body);
    const fw_mechanism_mass *at = &c->mechanism->body[body];
    *data = fw_effects_air_slide(&gas, &face, air->gap_m);
    e->id = at->id;
    e->place = air->place;
    e->port[0] = (fw_effects_port){body, 0, 0};
    e->port[1] = (fw_effects_port){FW_GROUND, at->x_m, at->y_m};
    e->dissipates = true;
    e->data = data;
    return FW_OK;
}
