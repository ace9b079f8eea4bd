/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Elements and released pins in the linear system, the forces and the envelope: an element that is
   a spring must do what a spring does, and one that stands for a pin what a stiff pin does. */
#include "quantity/law_kind.h"
#include "effects/envelope.h"
#include "effects/modal.h"
#include "test.h"

typedef struct bushing { /* springs along x and y and against turning, between two ports */
    double k_N_per_m, turn_Nm_per_rad, push_N;
} bushing;

static void force(const fw_effects_force_element *e, const fw_effects_port_state *s, double *f) {
    const bushing *d = e->data;
    double factor[3] = {1, 0, 0};
    if (e->laws > 0) fw_quantity_law_value(e->law[0], s->t_s, s->piece_s, factor);
    for (int k = 0; k < 3; k++) {
        f[k] = (k == 2 ? d->turn_Nm_per_rad : d->k_N_per_m) * (s->p[3 + k] - s->p[k]);
        f[3 + k] = -f[k];
    }
    f[3] += d->push_N * factor[0], f[0] -= d->push_N * factor[0];
}

static void tangent(const fw_effects_force_element *e, const fw_effects_port_state *s,
                    double *stiffness, double *damping) {
    const bushing *d = e->data;
    (void)s;
    memset(stiffness, 0, 36 * sizeof *stiffness);
    memset(damping, 0, 36 * sizeof *damping);
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++)
                stiffness[6 * (3 * i + k) + 3 * j + k] =
                    (k == 2 ? d->turn_Nm_per_rad : d->k_N_per_m) * (i == j ? 1 : -1);
}

static const fw_effects_element_class bushing_class = {
    .effect = "bushing", .force = force, .tangent = tangent};

typedef struct pair { /* two bars in a row from the ground; the element at the second joint */
    fw_mechanism_mass body[2];
    fw_mechanism_pin pin[2];
    fw_effects_torsion torsion[2];
    double zero[6];
    bool released[2];
    fw_effects_port port[2];
    fw_effects_force_element element;
    bushing data;
    fw_mechanism m;
    fw_effects_loads loads;
    fw_device_scene scene;
} pair;

static void pair_new(pair *p) {
    *p = (pair){.body = {{"a", 2, 0.3, 0.5, 0, 0, {0, 0}}, {"b", 1, 0.1, 1.5, 0, 0, {0, 0}}}};
    p->pin[0] = (fw_mechanism_pin){.body_a = FW_GROUND, .body_b = 0, .bx_m = -0.5};
    p->pin[1] = (fw_mechanism_pin){.body_a = 0, .body_b = 1, .ax_m = 0.5, .bx_m = -0.5};
    p->torsion[0] = (fw_effects_torsion){0, FW_GROUND, 0, 10, 0, 0};
    p->torsion[1] = (fw_effects_torsion){1, 0, 1, 20, 0, 0};
    p->port[0] = (fw_effects_port){0, 0.5, 0};
    p->port[1] = (fw_effects_port){1, -0.5, 0};
    p->element = (fw_effects_force_element){
        .class_ = &bushing_class, .port = p->port, .ports = 2, .pin = FW_NONE, .data = &p->data};
    p->m = (fw_mechanism){.body = p->body, .pin = p->pin, .nbody = 2, .npin = 2};
    p->loads = (fw_effects_loads){.nbody = 2,
                                  .constant = p->zero,
                                  .velocity = p->zero,
                                  .torsion = p->torsion,
                                  .ntorsion = 2,
                                  .element = &p->element,
                                  .nelement = 1,
                                  .released = p->released};
    p->scene = (fw_device_scene){.name = "s", .duration_s = 3};
}

static void respond(fw_arena *arena, const pair *p, double *u, double *turn) {
    const double load[6] = {0, 0, 0, 1, 3, 0.5};
    bool valid;
    assert_int_equal(fw_effects_static_response(arena, &p->m, &p->loads, load, u, turn, &valid),
                     FW_OK);
    assert_true(valid);
}

/* its turning spring adds to the pin's; its others do nothing where the pin holds */
static void element_beside_a_pin(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    pair p;
    double u[6], turn[2];
    pair_new(&p);
    p.data = (bushing){1e3, 7, 0};
    respond(arena, &p, u, turn);
    assert_near(turn[0], (3 * 1.5 + 0.5) / 10, 1e-12); /* moments at the joints, by hand */
    assert_near(turn[1], (3 * 0.5 + 0.5) / 27, 1e-12);
    fw_arena_free(arena);
}

/* the pin released: the element holds the points, and its stretch is force over stiffness */
static void element_for_a_pin(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    pair p;
    double u[6], turn[2];
    pair_new(&p);
    p.released[1] = true;
    p.data = (bushing){1e4, 0, 0};
    respond(arena, &p, u, turn);
    assert_near(turn[0], (3 * 1.5 + 0.5) / 10, 2e-3);
    double gap_x = u[3] - u[0], gap_y = u[4] - 0.5 * u[5] - u[1] - 0.5 * u[2];
    assert_near(gap_x, 1 / 1e4, 1e-12);
    assert_near(gap_y, 3 / 1e4, 1e-12);
    fw_effects_linear s;
    bool elastic;
    assert_int_equal(fw_effects_linear_new(arena, &p.m, &p.loads, &s, &elastic), FW_OK);
    assert_true(s.rows == 2 && s.pin_row[0] == 0 && s.pin_row[1] == FW_NONE);
    fw_arena_free(arena);
}

/* the force of an element at the start and at its largest, against a load of the same size */
static void forces_of_elements(void **state) {
    (void)state;
    static const fw_quantity_law ramp = {
        .kind = &fw_quantity_law_ramp, .start_s = 0.5, .rise_s = 1};
    pair p;
    double start[6], most[6];
    pair_new(&p);
    p.data = (bushing){0, 0, 5};
    fw_effects_loads_initial_force(&p.m, &p.loads, start);
    assert_near(start[3], 5, 1e-12);
    assert_near(start[0], -5, 1e-12);
    p.element.law[0] = &ramp, p.element.laws = 1;
    fw_effects_loads_initial_force(&p.m, &p.loads, start);
    assert_near(start[3], 0, 1e-12);
    fw_effects_loads_largest_force(&p.m, &p.loads, 3, most);
    assert_near(most[3], 5, 1e-12);
    fw_effects_loads_largest_force(&p.m, &p.loads, 1, most); /* the scene ends half way up */
    assert_near(most[3], 2.5, 1e-12);
}

/* an element that pushes with a law moves the modes as a load with that law does; only the turning
   of its arm under the force at the start is in its tangent, and not in the load's */
static void envelope_of_an_element(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const fw_quantity_law laws[] = {
        {.kind = &fw_quantity_law_ramp, .start_s = 0.5, .rise_s = 1},
        {.kind = &fw_quantity_law_step, .start_s = 0.5, .end_s = 1.5},
        {.kind = &fw_quantity_law_sine,
         .frequency_Hz = 0.7,
         .end_s = (double)INFINITY,
         .phase_rad = 1},
    };
    for (int i = 0; i < 3; i++) {
        pair p;
        fw_effects_envelope by_load, by_element;
        pair_new(&p);
        for (int b = 0; b < 2; b++) { /* a bent row: pushing along x turns the joints */
            p.body[b].phi_rad = b ? -0.7 : 0.5;
            p.body[b].x_m = b ? cos(0.5) + 0.5 * cos(0.7) : 0.5 * cos(0.5);
            p.body[b].y_m = b ? sin(0.5) - 0.5 * sin(0.7) : 0.5 * sin(0.5);
        }
        for (int k = 0; k < 2; k++)
            p.torsion[k].free_angle_rad = k ? -1.2 : 0.5,
            p.pin[k].free_angle_rad = p.torsion[k].free_angle_rad;
        p.port[0] = (fw_effects_port){FW_GROUND, 3, 0};
        p.port[1] = (fw_effects_port){1, 0.5, 0};
        p.data = (bushing){0, 0, 0.1};
        p.element.law[0] = &laws[i], p.element.laws = 1;
        assert_int_equal(fw_effects_envelope_of(arena, &p.m, &p.scene, &p.loads, &by_element),
                         FW_OK);
        fw_effects_timed_load load = {.body = 1, .x_m = 0.5, .fx_N = 0.1, .law = &laws[i]};
        p.loads.nelement = 0, p.loads.timed = &load, p.loads.ntimed = 1;
        assert_int_equal(fw_effects_envelope_of(arena, &p.m, &p.scene, &p.loads, &by_load), FW_OK);
        assert_true(by_element.valid && by_load.valid);
        for (int j = 0; j < 2; j++) {
            assert_near(by_element.omega[j], by_load.omega[j], 1e-2 * by_load.omega[j]);
            assert_near(by_element.amplitude[j], by_load.amplitude[j], 0.1 * by_load.amplitude[j]);
        }
        assert_near(by_element.floor, by_load.floor, 0.05 * by_load.floor);
    }
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(element_beside_a_pin),
        cmocka_unit_test(element_for_a_pin),
        cmocka_unit_test(forces_of_elements),
        cmocka_unit_test(envelope_of_an_element),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
