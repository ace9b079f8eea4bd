/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The figure of a mechanism without shapes: outlines, guides, marks, and that all of it is in view
   over the whole motion. */
#include "report/figure.h"
#include "test.h"
#include <math.h>
#include <string.h>

enum { MOST = 16, POSES = 21 };

/* built by hand: a bar on a pin, a slider on it that a driven rod holds, a plate, a spring */
typedef struct scene {
    fw_mechanism_mass body[MOST];
    fw_mechanism_pin pin[MOST];
    fw_device_joint joint[4];
    fw_device_driver driver[2];
    fw_device_spring spring[2];
    fw_mechanism m;
    fw_device device;
} scene;

static void crank_on_a_slide(scene *s) {
    *s = (scene){.device = {.name = "test"}};
    s->m = (fw_mechanism){.device = &s->device,
                          .body = s->body,
                          .pin = s->pin,
                          .joint = s->joint,
                          .driver = s->driver,
                          .spring = s->spring,
                          .nbody = 3,
                          .npin = 2,
                          .njoint = 2,
                          .ndriver = 1,
                          .nspring = 1};
    s->body[0] = (fw_mechanism_mass){.id = "bar"};
    s->body[1] = (fw_mechanism_mass){.id = "slider"};
    s->body[2] = (fw_mechanism_mass){.id = "plate"};
    /* the bar: a pin at its left end, a guide along it, and a corner above */
    s->pin[0] = (fw_mechanism_pin){
        .id = "O", .body_a = FW_GROUND, .body_b = 0, .bx_m = -1, .hinge = FW_NONE};
    s->pin[1] = (fw_mechanism_pin){.id = "P",
                                   .body_a = 0,
                                   .ax_m = 0,
                                   .ay_m = 0.5,
                                   .body_b = 2,
                                   .hinge = FW_NONE,
                                   .stop_stiffness_Nm_per_rad = 1,
                                   .stop_min_rad = -0.5,
                                   .stop_max_rad = (double)NAN};
    s->joint[0] =
        (fw_device_joint){.id = "S", .kind = FW_JOINT_PRISMATIC, .body_a = 0, .body_b = 1};
    s->joint[1] = (fw_device_joint){.id = "R",
                                    .kind = FW_JOINT_DISTANCE,
                                    .body_a = FW_GROUND,
                                    .ax_m = 5,
                                    .ay_m = -4,
                                    .body_b = 1,
                                    .length_m = 1};
    s->driver[0] = (fw_device_driver){.id = "d", .revolute = FW_NONE, .joint = 1};
    s->spring[0] = (fw_device_spring){
        .id = "k", .body_a = FW_GROUND, .ax_m = -3, .ay_m = 2, .body_b = 2, .stiffness_N_per_m = 1};
}

/* the bar turns, the slider goes from 1 to 3 along it */
static void poses(double *q) {
    for (int k = 0; k < POSES; k++) {
        double phi = 0.1 * k, s = 1 + 2.0 * k / (POSES - 1), *p = q + 9 * k;
        double x = cos(phi), y = sin(phi);
        memcpy(p, (double[9]){x, y, phi, x + s * x, y + s * y, phi, x - 0.5 * y, y + 0.5 * x, 0},
               9 * sizeof *p);
    }
}

static const fw_report_figure_part *find(const fw_report_drawing_figure *f,
                                         fw_report_figure_role role, int of) {
    for (int i = 0; i < f->count; i++)
        if (f->part[i].role == role && (of == FW_NONE || f->part[i].of == of)) return &f->part[i];
    fail_msg("no part of role %d", (int)role);
    return NULL;
}

static int count_of(const fw_report_drawing_figure *f, fw_report_figure_role role) {
    int n = 0;
    for (int i = 0; i < f->count; i++)
        n += f->part[i].role == role;
    return n;
}

static void parts_of_a_mechanism(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    scene s;
    crank_on_a_slide(&s);
    double q[9 * POSES];
    poses(q);
    fw_report_drawing_figure f;
    assert_int_equal(fw_report_figure_make(arena, &s.m, q, POSES, &f), FW_OK);
    /* the guide starts at point a and reaches beyond the slider at its farthest */
    const fw_report_figure_part *rail = find(&f, FW_FIGURE_RAIL, FW_NONE);
    assert_int_equal(rail->of, 0);
    assert_true(rail->end[0].x_m == 0 && rail->end[1].x_m > 3.05 && rail->end[1].x_m < 4.5);
    /* the bar: its pin, the end of its guide, the corner; its centre and point a lie inside */
    const fw_report_figure_part *bar = find(&f, FW_FIGURE_BODY, 0);
    assert_int_equal(bar->noutline, 3);
    /* the slider has its joint in its centre: its block stands for it; the plate has no extent */
    assert_int_equal(count_of(&f, FW_FIGURE_BODY), 1);
    assert_int_equal(find(&f, FW_FIGURE_PLATE, FW_NONE)->of, 2);
    assert_int_equal(find(&f, FW_FIGURE_BLOCK, FW_NONE)->of, 1);
    /* a driven rod, a spring, feet of pin, rod and spring, one stop, two pins */
    assert_int_equal(count_of(&f, FW_FIGURE_ROD), 0);
    assert_int_equal(count_of(&f, FW_FIGURE_DRIVEN_ROD), 1);
    assert_int_equal(count_of(&f, FW_FIGURE_SPRING), 1);
    assert_int_equal(count_of(&f, FW_FIGURE_FOOT), 3);
    assert_int_equal(count_of(&f, FW_FIGURE_STOP), 1);
    assert_int_equal(count_of(&f, FW_FIGURE_PIN), 2);
    fw_arena_free(arena);
}

/* identity: every vertex of every part lies in the box at every pose, and the view has margins */
static void everything_is_in_view(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    scene s;
    crank_on_a_slide(&s);
    double q[9 * POSES];
    poses(q);
    fw_report_drawing_figure f;
    assert_int_equal(fw_report_figure_make(arena, &s.m, q, POSES, &f), FW_OK);
    fw_geometry_box box = fw_report_box_empty();
    for (int i = 0; i < f.count; i++)
        fw_report_figure_reach(&box, &f.part[i], q, POSES, 3);
    fw_report_view view = fw_report_figure_view(&box, 700);
    for (int i = 0; i < f.count; i++)
        for (int k = 0; k < POSES; k++) {
            const fw_report_figure_part *p = &f.part[i];
            for (int j = 0; j < (p->noutline ? p->noutline : 2); j++) {
                fw_report_figure_point at = p->end[j < 2 ? j : 0];
                if (p->noutline)
                    at = (fw_report_figure_point){p->end[0].body, p->outline[j].x, p->outline[j].y};
                fw_geometry_vec2 w = fw_report_figure_place(q + 9 * k, at);
                double x = fw_report_x(&view, w.x), y = fw_report_y(&view, w.y);
                assert_true(x > 25 && x < view.width - 25 && y > 25 && y < view.height - 35);
            }
        }
    fw_arena_free(arena);
}

/* all points of a body on a circle, and its centre: the outline runs through them, once around */
static void outline_is_convex(void **state) {
    (void)state;
    for (int n = 3; n <= MOST; n++) {
        fw_arena *arena = fw_arena_new(0);
        scene s = {.device = {.name = "hub"}};
        s.m = (fw_mechanism){
            .device = &s.device, .body = s.body, .pin = s.pin, .nbody = 1, .npin = n};
        for (int i = 0; i < n; i++) {
            double a = 2.399963 * i; /* in no order */
            s.pin[i] = (fw_mechanism_pin){.id = "p",
                                          .body_a = 0,
                                          .ax_m = 2 * cos(a),
                                          .ay_m = 2 * sin(a),
                                          .body_b = FW_GROUND,
                                          .hinge = FW_NONE};
        }
        double q[3] = {0, 0, 0};
        fw_report_drawing_figure f;
        assert_int_equal(fw_report_figure_make(arena, &s.m, q, 1, &f), FW_OK);
        const fw_report_figure_part *b = find(&f, FW_FIGURE_BODY, 0);

        double around = 0;
        for (int i = 0; i < b->noutline; i++) {
            fw_geometry_vec2 u = b->outline[i], v = b->outline[(i + 1) % b->noutline];
            around += remainder(atan2(v.y, v.x) - atan2(u.y, u.x), 2 * acos(-1.0));
        }
        assert_int_equal(b->noutline, n);
        assert_true(fabs(around - 2 * acos(-1.0)) < 1e-9);
        fw_arena_free(arena);
    }
}

/* a viewer moves between key frames only where all have the same commands */
static void frames_have_the_same_commands(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    scene s;
    crank_on_a_slide(&s);
    double q[9 * POSES];
    poses(q);
    fw_report_drawing_figure f;
    assert_int_equal(fw_report_figure_make(arena, &s.m, q, POSES, &f), FW_OK);
    fw_report_view view = fw_report_figure_view(&(fw_geometry_box){-4, -4, 5, 5}, 700);
    fw_text text = fw_text_new(arena);
    const fw_report_figure_pen pen = {.view = &view,
                                      .out = &text,
                                      .still = q,
                                      .frame = q,
                                      .nbody = 3,
                                      .frames = POSES,
                                      .seconds = 8,
                                      .mark = 5.5};
    fw_report_figure_draw(find(&f, FW_FIGURE_SPRING, FW_NONE), &pen);
    assert_int_equal(fw_text_end(&text), FW_OK);
    const char *values = strstr(text.data, "values=\"");
    assert_non_null(values);
    int corners[POSES] = {0}, frame = 0;
    for (const char *c = values + 8; *c != '"'; c++)
        if (*c == ';')
            frame++;
        else if (*c == 'L')
            corners[frame]++;
    assert_int_equal(frame, POSES - 1);
    for (int i = 0; i < POSES; i++)
        assert_int_equal(corners[i], corners[0]);
    assert_true(corners[0] >= 11);
    assert_null(strstr(text.data, "nan"));
    fw_arena_free(arena);
}

/* a stop's arc goes from its one angle to its other one, the long way round where that is how far it lets turn */
static void a_stop_shows_its_range(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const double q[3] = {0}, to_rad[] = {0.5, 2, 4};
    fw_report_view view = fw_report_figure_view(&(fw_geometry_box){-4, -4, 5, 5}, 700);
    for (int i = 0; i < 3; i++) {
        fw_text text = fw_text_new(arena);
        const fw_report_figure_part part = {
            .role = FW_FIGURE_STOP, .end = {{FW_GROUND, 0, 0}}, .turns_with = FW_GROUND, .from_rad = 0, .to_rad = to_rad[i]};
        const fw_report_figure_pen pen = {.view = &view, .out = &text, .still = q, .nbody = 1, .mark = 10};
        fw_report_figure_draw(&part, &pen);
        assert_int_equal(fw_text_end(&text), FW_OK);
        const char *arc = strstr(text.data, "A33 33 0 ");
        assert_non_null(arc);
        assert_int_equal(arc[9], i < 2 ? '0' : '1');
    }
    fw_arena_free(arena);
}

static void memory_may_be_short(void **state) {
    (void)state;
    for (long n = 1; n < 100; n++) {
        fw_arena *arena = fw_arena_new(0);
        scene s;
        crank_on_a_slide(&s);
        double q[9 * POSES];
        poses(q);
        fw_report_drawing_figure f;
        fw_arena_fail_at(n, 1);
        fw_status status = fw_report_figure_make(arena, &s.m, q, POSES, &f);
        fw_arena_fail_at(0, 0);
        fw_arena_free(arena);
        if (status == FW_OK) {
            assert_true(n > 4);
            return;
        }
        assert_int_equal(status, FW_NOMEM);
    }
    fail_msg("never had memory enough");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_of_a_mechanism), cmocka_unit_test(everything_is_in_view),
        cmocka_unit_test(outline_is_convex),    cmocka_unit_test(frames_have_the_same_commands),
        cmocka_unit_test(a_stop_shows_its_range),
        cmocka_unit_test(memory_may_be_short),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
