/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The reference six-bar with the surfaces that its layout draws: loads that close gaps of 8 um, so
   that surfaces hit, rub, hold and part again; friction that holds the mechanism bent; electrodes
   that pull in up to a stop, with a tendon that goes slack. Through the readers of the description,
   layout and mechanism; the answers of tighter and tighter tolerances must become one. */
#include "quantity/law_kind.h"
#include "surfaces.h"

/* forces at the hinges' own points close their gaps and bend nothing else */
static const char scenes[] =
    "<scene name='rattle' duration='8 ms'>"
    "  <force on='AB' x='0.25 mm' y='-0.625 mm' fx='-9 mN' fy='9 mN' law='sine' frequency='400 Hz'"
    "   end='6 ms'/>"
    "  <force on='CD' fx='0.35 mN' fy='-0.2 mN'/>"
    "  <contact id='cA' on='A' stiffness='2e4 N/m' damping='1e-4 N s/m'/>"
    "  <contact id='cB' on='B' stiffness='2e4 N/m' damping='1e-4 N s/m'/>"
    "  <friction on='A' coefficient='0.3' static-coefficient='0.4'/>"
    "  <friction on='B' coefficient='0.3' static-coefficient='0.4'/>"
    "</scene>"
    "<scene name='held' duration='12 ms'>"
    "  <force on='CD' fx='2 mN' fy='-1 mN' law='sine' frequency='300 Hz' end='5 ms'/>"
    "  <contact id='cA' on='A' stiffness='2e4 N/m' damping='2e-3 N s/m'/>"
    "  <contact id='cC' on='C' stiffness='2e4 N/m' damping='2e-3 N s/m'/>"
    "  <contact id='cF' on='F' stiffness='2e4 N/m' damping='2e-3 N s/m'/>"
    "  <friction on='A' coefficient='0.3' static-coefficient='0.4'/>"
    "  <friction on='C' coefficient='0.3' static-coefficient='0.4'/>"
    "  <friction on='F' coefficient='0.3' static-coefficient='0.4'/>"
    "  <material-damping/>"
    "</scene>"
    "<scene name='pulled' duration='12 ms'>"
    "  <force on='CD' fx='4 uN'/>"
    "  <comb-drive id='comb' kind='comb' on='CD' x='0.65 mm' direction='90 deg' fingers='40'"
    "   gap='8 um' overlap='60 um' length='100 um' voltage='34 V' law='step' end='6 ms'/>"
    "  <contact id='stop' a='ground' a-x='2.45 mm' a-y='2.875 mm' b='CD' b-x='0.70 mm'"
    "   side='outside' distance='0.244 mm' stiffness='2e4 N/m' damping='2e-2 N s/m'/>"
    "  <contact id='other' a='ground' a-x='0.55 mm' a-y='2.875 mm' b='CD' b-x='-0.70 mm'"
    "   side='outside' distance='0.244 mm' stiffness='2e4 N/m' damping='2e-2 N s/m'/>"
    "  <contact id='cD' on='D' stiffness='2e4 N/m' damping='1e-4 N s/m'/>"
    "  <friction on='D' coefficient='0.3' static-coefficient='0.4' preload='0.2 mN'/>"
    "  <tendon id='left' pull='0.02 mN'>"
    "    <eyelet on='CD' x='-0.65 mm' y='0.15 mm'/><eyelet on='ground' x='-0.2 mm' y='3.8 mm'/>"
    "  </tendon>"
    "  <tendon id='right' draw='0 um' stiffness='20 N/m' slack='-2 um'>"
    "    <eyelet on='CD' x='0.65 mm' y='0.15 mm'/><eyelet on='ground' x='3.2 mm' y='3.8 mm'/>"
    "  </tendon>"
    "  <material-damping loss-factor='0.2' frequency='1 kHz'/>"
    "</scene>";

enum { SAMPLES = 2001 };
static const double GAP_M = 8e-6; /* as the description has it */

static fw_geometry_vec2 point(const double *q, int body, double x, double y) {
    if (body == FW_GROUND) return (fw_geometry_vec2){x, y};
    double c = cos(q[3 * body + 2]), s = sin(q[3 * body + 2]);
    return (fw_geometry_vec2){q[3 * body] + c * x - s * y, q[3 * body + 1] + s * x + c * y};
}

/* how far the two points of a pin are apart */
static double apart(const rig *r, const double *q, int pin) {
    const fw_mechanism_pin *p = &r->m.pin[pin];
    fw_geometry_vec2 a = point(q, p->body_a, p->ax_m, p->ay_m);
    fw_geometry_vec2 b = point(q, p->body_b, p->bx_m, p->by_m);
    return hypot(b.x - a.x, b.y - a.y);
}

static double rate(const rig *r, const double *v, int pin) {
    const fw_mechanism_pin *p = &r->m.pin[pin];
    double a = p->body_a == FW_GROUND ? 0 : v[3 * p->body_a + 2];
    return (p->body_b == FW_GROUND ? 0 : v[3 * p->body_b + 2]) - a;
}

/* what a hinge with contact and friction did, at the samples: seen from its points alone */
typedef struct history {
    int open, slides, holds, closings;
} history;

static history history_of(const rig *r, const fw_dynamics_motion *m, int pin, double gap_m) {
    history h = {0};
    bool before = false;
    for (int k = 0; k < m->nsample; k++) {
        bool closed = apart(r, hard_q(m, k), pin) > gap_m;
        bool still = fabs(rate(r, hard_v(m, k), pin)) < 1e-6;
        h.open += !closed, h.holds += closed && still, h.slides += closed && !still;
        h.closings += closed && !before;
        before = closed;
    }
    return h;
}

static double differ(const fw_dynamics_motion *a, const fw_dynamics_motion *b) {
    double worst = 0;
    for (int i = 0; i < a->nsample * a->npin; i++)
        worst = fmax(worst, fabs(a->angle_rad[i] - b->angle_rad[i]));
    return worst;
}

static const fw_dynamics_motion *at(fw_arena *arena, const rig *r, double rtol,
                                    const char *integrator, const fw_dynamics_motion *best) {
    fw_dynamics_motion_options o = {.rtol = rtol, .integrator = integrator, .samples = SAMPLES};
    const fw_dynamics_motion *m = hard_run(arena, r, o);
    print_message("%s, %s, rtol %.0e: %ld events, %ld steps, energy %.1e, off %.1e rad\n",
                  r->scene.name, m->integrator, rtol, m->stats.events, m->stats.steps,
                  m->stats.energy_error, best ? differ(m, best) : 0);
    return m;
}

/* A touch hands errors of place on as errors of speed, some sqrt(k/m) = 1e6 /s times as large
   against motions of 1e3 to 1e4 /s: more than rtol, ever less by at least 5 in two decades. From
   rtol 1e-5 to 1e-11 towards 1e-12: the angles become one, the events the same ones (from `settled`
   on), the energies close, and nothing takes more steps than its fastest vibration asks for.
   Returns the motion at 1e-12. */
static const fw_dynamics_motion *refine(fw_arena *arena, const rig *r, double settled,
                                        long most_steps) {
    const fw_dynamics_motion *best = at(arena, r, 1e-12, NULL, NULL);
    double before = (double)INFINITY;
    assert_true(best->stats.energy_error < 1e-9);
    for (int e = 5; e <= 11; e += 2) {
        if (hard_quick() && e != 7) continue;
        double rtol = pow(10, -e);
        const fw_dynamics_motion *m = at(arena, r, rtol, NULL, best);
        double off = differ(m, best);
        long missing = labs(m->stats.events - best->stats.events);
        assert_true(off < before / 5 && off < 1e4 * rtol);
        assert_true(m->stats.energy_error < 1e2 * rtol);
        assert_true(missing <= (rtol > 1.01 * settled ? best->stats.events / 5 : 0));
        assert_true(m->stats.steps < most_steps);
        before = off;
    }
    return best;
}

static history print_history(const rig *r, const fw_dynamics_motion *m, int pin) {
    history h = history_of(r, m, pin, GAP_M);
    print_message(
        "%s: %d samples open, %d rubbing, %d holding; closed %d times, turns up to %.3f\n",
        r->m.pin[pin].id, h.open, h.slides, h.holds, h.closings, m->peak[pin].angle_rad);
    return h;
}

static void rattle(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = surfaces_rig(arena, scenes, "rattle");
    const fw_dynamics_motion *best = refine(arena, &r, 1e-9, 6 * 2500);
    history h = print_history(&r, best, 0);
    assert_true(h.open > 500 && h.slides > 200 && h.closings >= 6);
    assert_true(best->stats.events < 600); /* each turn of two hinges, each touch, each parting */
    if (!hard_quick()) {
        assert_true(differ(at(arena, &r, 1e-10, "dopri5", best), best) < 1e-6);
        assert_true(differ(at(arena, &r, 1e-9, "radau5", best), best) < 1e-5);
    }
    fw_arena_free(arena);
}

/* presses the surfaces of a hinge on each other, in the middle of where they face each other, by
   `times` what closes the gap: a pair of forces at the hinge's own points */
static void press(fw_arena *arena, rig *r, int pin, double times, double gap_m, double rise_s) {
    const fw_mechanism_pin *p = &r->m.pin[pin];
    const fw_mechanism_hinge *h = &r->m.hinge[p->hinge];
    fw_flexure_hinge_at at;
    fw_flexure_hinge_law_at(&h->law, 0, &at);
    double turn = p->body_a == FW_GROUND ? 0 : r->m.body[p->body_a].phi_rad;
    double middle = 0.5 * (h->cover_from_rad + h->cover_to_rad) + turn;
    double f = times * gap_m * fmax(at.kx_N_per_m.value, at.ky_N_per_m.value);
    if (h->convex_is_a) f = -f;
    fw_quantity_law *law = fw_arena_one(arena, fw_quantity_law);
    *law = (fw_quantity_law){
        .kind = &fw_quantity_law_ramp, .rise_s = rise_s, .end_s = (double)INFINITY};
    fw_device_force *to = fw_arena_array(arena, fw_device_force, (size_t)r->scene.nforce + 2);
    memcpy(to, r->scene.force, (size_t)r->scene.nforce * sizeof *to);
    r->scene.force = to;
    for (int side = 0; side < 2; side++) {
        int body = side ? p->body_b : p->body_a;
        if (body == FW_GROUND) continue;
        to[r->scene.nforce++] = (fw_device_force){.body = body,
                                                  .x_m = side ? p->bx_m : p->ax_m,
                                                  .y_m = side ? p->by_m : p->ay_m,
                                                  .fx_N = (side ? f : -f) * cos(middle),
                                                  .fy_N = (side ? f : -f) * sin(middle),
                                                  .law = law};
    }
}

/* swung, then left alone with three hinges pressed by 1.5 times what closes them: the springs are
   bent and stay so, because friction holds */
static void held(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = surfaces_rig(arena, scenes, "held");
    const int pin[] = {0, 2, 5};
    for (int i = 0; i < 3; i++)
        press(arena, &r, pin[i], 1.5, GAP_M, 5e-4);
    const fw_dynamics_motion *best = refine(arena, &r, 1e-7, 6 * 2500);
    for (int i = 0; i < 3; i++) {
        history h = print_history(&r, best, pin[i]);
        int last = SAMPLES - 1, earlier = SAMPLES * 4 / 5;
        double fastest = 0, bent = best->angle_rad[last * best->npin + pin[i]];
        assert_true(h.open > 5 && h.slides > 100 && h.holds > 500 && h.closings == 1);
        assert_true(fabs(bent) > 0.01);
        assert_near(best->angle_rad[earlier * best->npin + pin[i]], bent, 1e-12);
        for (int k = 0; k <= last; k++) {
            double now = fabs(rate(&r, hard_v(best, k), pin[i]));
            fastest = fmax(fastest, now);
            if (k >= earlier) assert_near(now, 0, 1e-12 * fastest); /* round-off of the motion */
        }
    }
    if (!hard_quick()) assert_true(differ(at(arena, &r, 1e-11, "radau5", best), best) < 1e-5);
    fw_arena_free(arena);
}

/* a comb that pulls to the side: without stops its fingers touch, with them it stands against one
   until the voltage ends; a tendon beside it is slack then, and taut again later */
static void pulled(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    rig r = surfaces_rig(arena, scenes, "pulled"), bare = r;
    bare.scene.ncontact = 0;
    outcome out = hard_try(arena, &bare, (fw_dynamics_motion_options){.rtol = 1e-8, .samples = 2});
    assert_int_equal(out.number, 242);
    const fw_dynamics_motion *best = refine(arena, &r, 1e-7, 6 * 2500);
    const fw_device_contact_use *stop = &r.scene.contact[0];
    const fw_device_eyelet *eye = r.scene.tendon[1].eyelet;
    int against = 0, free = 0, slack = 0, taut = 0;
    double drawn = 0;
    for (int k = 0; k < SAMPLES; k++) {
        const double *q = hard_q(best, k);
        fw_geometry_vec2 tip = point(q, stop->body_b, stop->bx_m, stop->by_m);
        fw_geometry_vec2 a = point(q, eye[0].body, eye[0].x_m, eye[0].y_m);
        fw_geometry_vec2 b = point(q, eye[1].body, eye[1].x_m, eye[1].y_m);
        double away = hypot(tip.x - stop->ax_m, tip.y - stop->ay_m) - stop->distance_m;
        double length = hypot(b.x - a.x, b.y - a.y);
        if (k == 0) drawn = length + r.scene.tendon[1].slack_m;
        against += away<0, free += away> 2e-6;
        slack += length<drawn, taut += length> drawn;
        if (k == SAMPLES - 1) assert_true(away > 2e-6);
    }
    print_message("pulled: %d samples against the stop, %d away; tendon %d slack, %d taut\n",
                  against, free, slack, taut);
    assert_true(against > 100 && free > 100 && slack > 100 && taut > 100);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(rattle), cmocka_unit_test(held),
                                       cmocka_unit_test(pulled)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
