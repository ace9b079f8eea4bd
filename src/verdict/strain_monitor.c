/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "verdict/strain_monitor.h"
#include <math.h>

fw_status fw_verdict_strain_monitor_new(fw_arena *arena, const fw_mechanism *mechanism,
                                        const fw_layout *layout, bool cycles,
                                        fw_verdict_strain_monitor *monitor) {
    size_t n = (size_t)mechanism->nhinge;
    *monitor =
        (fw_verdict_strain_monitor){.mechanism = mechanism, .layout = layout, .arena = arena};
    FW_NEED(monitor->hinge = fw_arena_array(arena, fw_verdict_strain_peak, n));
    if (cycles) FW_NEED(monitor->root = fw_arena_alloc(arena, n, sizeof *monitor->root));
    return FW_OK;
}

/* a turn by less than this share of the limit strain is none: with an exponent of fatigue of 10, a
   million of them do not add up to one at the limit */
static const double gate_share = 1e-3;

static void start_counting(fw_verdict_strain_monitor *w, int k) {
    const fw_flexure_result *c = &w->mechanism->hinge[k].closed_form;
    for (int side = 0; w->root && side < 2; side++)
        w->root[k][side] =
            (fw_maths_turning){.gate = gate_share * c->limit_angle_rad * c->strain_per_rad};
}

static void count(fw_verdict_strain_monitor *w, int k, const fw_layout_hinge_layout *drawn,
                  const fw_verdict_hinge_load *load, const fw_dynamics_instant *now) {
    double strain[2];
    fw_verdict_hinge_root_strains(w->mechanism, &w->mechanism->hinge[k], drawn, load, strain);
    for (int side = 0; side < 2; side++) {
        if (now->begins) fw_maths_turning_jump(&w->root[k][side]);
        fw_maths_turning_add(&w->root[k][side], w->arena, now->t_s, strain[side]);
    }
}

static const double fw_strains_settle = 2;

double fw_verdict_strain_monitor_error(const fw_verdict_strain_monitor *saw,
                                       const fw_verdict_strain_monitor *looser, double margin) {
    double most = 0;
    for (int k = 0; k < saw->mechanism->nhinge; k++)
        if (saw->hinge[k].seen > 0 && looser->hinge[k].seen > 0)
            most = fmax(most, fabs(saw->hinge[k].strain - looser->hinge[k].strain));
    return fw_strains_settle * margin * most;
}

double fw_verdict_strain_monitor_unsettled(const void *saw, const void *looser, double margin,
                                           double accuracy) {
    const fw_verdict_strain_monitor *monitor = saw;
    double limit = HUGE_VAL;
    for (int k = 0; k < monitor->mechanism->nhinge; k++) {
        const fw_flexure_result *c = &monitor->mechanism->hinge[k].closed_form;
        limit = fmin(limit, c->limit_angle_rad * c->strain_per_rad);
    }
    return fw_verdict_strain_monitor_error(monitor, looser, margin) /
           (fmin(10 * accuracy, 0.03) * limit);
}

static void keep(fw_verdict_strain_peak *p, double t_s, double strain, double between) {
    if (strain <= p->strain) return;
    p->strain = strain;
    p->t_s = t_s;
    p->between = between;
}

/* peak of the parabola through three instants, spacings a and b about the middle one:
     slope = ((s1-s0) b/a + (s2-s1) a/b)/(a+b), bend = 2 ((s2-s1)/b - (s1-s0)/a)/(a+b)
     at t1 - slope/bend, s1 - slope^2/(2 bend)
   in: times s, strains; error O(spacing^3) of the peak's height, and `between` bounds it; cost none
   source: Newton's divided differences; test_watch.c finds_the_peak_between_instants */
void fw_verdict_strain_peak_add(fw_verdict_strain_peak *p, double t_s, double strain) {
    if (p->seen >= 2) {
        double a = p->t[1] - p->t[0], b = t_s - p->t[1];
        double up = p->s[1] - p->s[0], down = strain - p->s[1];
        if (a > 0.0 && b > 0.0 && up >= 0.0 && down <= 0.0 && up - down > 0.0) {
            double slope = (up * b / a + down * a / b) / (a + b);
            double bend = 2.0 * (down / b - up / a) / (a + b);
            double add = -slope * slope / (2.0 * bend);
            keep(p, p->t[1] - slope / bend, p->s[1] + add, add);
        }
    }
    keep(p, t_s, strain, 0.0); /* the first and the last instant have no neighbours */
    p->t[0] = p->t[1];
    p->s[0] = p->s[1];
    p->t[1] = t_s;
    p->s[1] = strain;
    p->seen++;
}

static double turned(const fw_mechanism *m, const fw_dynamics_instant *now, int body) {
    return body == FW_GROUND ? 0.0 : now->q[3 * body + 2] - m->body[body].phi_rad;
}

/* they take 50 kB each: only where a run has hinges as beams */
static fw_status make_beams(fw_verdict_strain_monitor *w) {
    const fw_mechanism *m = w->mechanism;
    fw_flexure_elastica **beam = fw_arena_alloc(w->arena, (size_t)m->nhinge, sizeof *beam);
    FW_NEED(beam);
    for (int k = 0; k < m->nhinge; k++)
        FW_TRY(fw_verdict_hinge_beam(w->arena, &m->hinge[k], &beam[k]));
    w->beam = beam;
    return FW_OK;
}

void fw_verdict_strain_monitor_record(void *context, const fw_dynamics_instant *now) {
    fw_verdict_strain_monitor *w = context;
    const fw_mechanism *m = w->mechanism;
    if (now && now->hinge == FW_HINGE_ELASTICA && !w->beam && !w->no_memory)
        w->no_memory = make_beams(w) != FW_OK;
    for (int k = 0; k < m->nhinge; k++) {
        const fw_mechanism_hinge *hinge = &m->hinge[k];
        const fw_mechanism_pin *pin = &m->pin[hinge->pin];
        if (!now) {
            w->hinge[k] = (fw_verdict_strain_peak){0};
            start_counting(w, k);
            continue;
        }
        if (now->begins) w->hinge[k].seen = 0; /* no parabola across a jump */
        fw_verdict_hinge_load load = {
            now->angle_rad[hinge->pin], now->reaction_N[2 * hinge->pin],
            now->reaction_N[2 * hinge->pin + 1],
            0.5 * (turned(m, now, pin->body_a) + turned(m, now, pin->body_b))};
        const fw_layout_hinge_layout *drawn =
            w->layout && w->layout->drawn ? &w->layout->hinge[hinge->pin] : NULL;
        fw_flexure_elastica *beam = w->beam && now->hinge == FW_HINGE_ELASTICA ? w->beam[k] : NULL;
        fw_verdict_strain_peak_add(&w->hinge[k], now->t_s,
                                   fw_verdict_hinge_strain_exact(m, hinge, drawn, beam, &load));
        if (w->root) count(w, k, drawn, &load, now);
    }
}
