/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Ground points that move: p(t) = p + s law(t) (p - centre), s the strain (temperature with a law).
   For every block the vector d from point a to point b (constraints.c) gains

     g law(t),   g = s (p_b - centre) where b is the ground, -s (p_a - centre) where a is,

   (p of a pin that stands for a flexure is where the strip begins), so that Psi_t and Psi_tt follow
   from d' += g law', d'' += g law''; ends of springs on the ground move likewise. A pose holds the
   ground of its time. Scaled units. Exact. What the moving ground feeds in goes to the energy
   balance: lambda . Psi_t of the joints (rhs.c), and that of springs and slides (forces.c). Test: test_constraints.c, test_temperature.c. */
#include "multibody/multibody_scratch.h"

void fw_multibody_stretch_gain(const fw_multibody_model *m, const double local[2], double gain[2]) {
    for (int k = 0; k < 2; k++)
        gain[k] = m->stretch.strain * (local[k] - m->stretch.centre[k]);
}

/* of a point that goes with one `root_m` away from it: a pin that stands for a flexure */
static void gain_of_pin(const fw_multibody_model *m, const double local[2],
                        const fw_geometry_vec2 *root_m, double gain[2]) {
    const double at[2] = {local[0] + (root_m ? root_m->x / m->scale.length_m : 0),
                          local[1] + (root_m ? root_m->y / m->scale.length_m : 0)};
    fw_multibody_stretch_gain(m, at, gain);
}

/* g of every block: of b's point, less that of a's */
static void gain_of_blocks(const fw_mechanism *mechanism, fw_multibody_model *m) {
    fw_multibody_stretch *s = &m->stretch;
    for (int i = 0; i < m->nblock; i++) {
        const fw_multibody_block *b = &m->block[i];
        const fw_mechanism_pin *pin = b->pin != FW_NONE ? &mechanism->pin[b->pin] : NULL;
        double *g = s->block + 2 * i;
        if (b->b == m->nbody) {
            gain_of_pin(m, m->local + 4 * i + 2, pin ? &pin->root_b_m : NULL, g);
        } else if (b->a == m->nbody) {
            gain_of_pin(m, m->local + 4 * i, pin ? &pin->root_a_m : NULL, g);
            g[0] = -g[0], g[1] = -g[1];
        }
    }
}

static void gain_of_springs(fw_multibody_model *m) {
    for (int i = 0; i < m->nspring; i++) {
        const fw_multibody_spring *p = &m->spring[i];
        const double *end = m->spring_end + 4 * i;
        double *g = m->stretch.spring + 4 * i;
        if (p->a == m->nbody) fw_multibody_stretch_gain(m, end, g);
        if (p->b == m->nbody) fw_multibody_stretch_gain(m, end + 2, g + 2);
    }
}

fw_status fw_multibody_stretch_new(fw_arena *arena, const fw_mechanism *mechanism,
                                   const fw_effects_stretch *from, fw_geometry_vec2 centre,
                                   fw_multibody_model *m) {
    fw_multibody_stretch *s = &m->stretch;
    s->strain = from->strain;
    s->centre[0] = (from->centre_m.x - centre.x) / m->scale.length_m;
    s->centre[1] = (from->centre_m.y - centre.y) / m->scale.length_m;
    FW_NEED(s->block = fw_arena_array(arena, double, 2 * (size_t)m->nblock));
    FW_NEED(s->spring = fw_arena_array(arena, double, 4 * (size_t)m->nspring));
    gain_of_blocks(mechanism, m);
    gain_of_springs(m);
    s->law = from->law;
    m->driven = true;
    return FW_OK;
}

void fw_multibody_stretch_pose(const fw_multibody_system *sys, double t) {
    const fw_multibody_model *m = sys->model;
    const fw_multibody_stretch *s = &m->stretch;
    fw_multibody_scratch *w = sys->work;
    if (t == w->ground_t && sys->piece_s == w->ground_piece_s) return;
    const double unit = m->scale.time_s;
    fw_quantity_law_value(s->law, t * unit, sys->piece_s, w->ground);
    w->ground[1] *= unit, w->ground[2] *= unit * unit;
    w->ground_t = t, w->ground_piece_s = sys->piece_s;
    for (int i = 0; i < 2 * m->nblock; i++) /* d = ... - offset */
        w->offset[i] = m->offset[i] - w->ground[0] * s->block[i];
    for (int i = 0; i < 4 * m->nspring; i++)
        w->spring_end[i] = m->spring_end[i] + w->ground[0] * s->spring[i];
}
