/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "layout/layout.h"
#include "test.h"

typedef struct sheet {
    fw_arena *arena;
    fw_layout_piece *piece;
    int n, capacity;
} sheet;

static const fw_geometry_box die = {-0.8e-3, -0.5e-3, 4.8e-3, 4.5e-3};
static const fw_geometry_box window = {-0.55e-3, -0.25e-3, 4.55e-3, 4.25e-3};

static fw_device device(fw_device_parameter *parameter, int n) {
    return (fw_device){.name = "six-bar",
                       .parameter = parameter,
                       .nparameter = n,
                       .thickness_m = 50e-6,
                       .die = {.lane_m = (double)NAN, .title = "REFERENCE SIX-BAR"}};
}

static fw_status annotate(sheet *s, const fw_device *d, fw_geometry_box inner,
                          fw_geometry_box outer) {
    *s = (sheet){.arena = fw_arena_new(0)};
    return fw_layout_annotate(s->arena, d, inner, outer, NULL, &s->piece, &s->n, &s->capacity);
}

static double area_of(const sheet *s, fw_layout_role role) {
    double sum = 0;
    for (int i = 0; i < s->n; i++)
        if (s->piece[i].role == role) sum += fw_geometry_contour_area(&s->piece[i].contour);
    return sum;
}

static int count_of(const sheet *s, const char *label) {
    int n = 0;
    for (int i = 0; i < s->n; i++)
        n += strcmp(s->piece[i].label, label) == 0;
    return n;
}

static fw_device_parameter two[] = {
    {.name = "arc", .value = 240 * 3.14159265358979323846 / 180, .unit = "deg"},
    {.name = "link", .value = 120e-6, .unit = "um"},
};

static void everything_is_there(void **state) {
    (void)state;
    sheet s;
    fw_device d = device(two, 2);
    assert_int_equal(annotate(&s, &d, window, die), FW_OK);
    assert_int_equal(count_of(&s, "alignment cross"), 4);
    assert_int_equal(count_of(&s, "corner bracket"), 4);
    assert_int_equal(count_of(&s, "dicing lane"), 4);
    assert_true(count_of(&s, "title") > 10 && count_of(&s, "version") > 10);
    assert_true(count_of(&s, "parameter text") > 20);
    /* the lane is the ring between two rectangles, 100 um wide */
    double outer = 5.6e-3 * 5e-3, inner = 5.4e-3 * 4.8e-3;
    assert_relative(area_of(&s, FW_ROLE_DICING), outer - inner, 1e-12);
    for (int i = 0; i < s.n; i++) {
        assert_int_equal(s.piece[i].body, FW_NONE - 1);
        assert_int_equal(s.piece[i].joint, FW_NONE);
        assert_true(fw_geometry_contour_area(&s.piece[i].contour) > 0);
    }
    fw_arena_free(s.arena);
}

/* text and marks stay between the window and the lane, with room, and clear of each other */
static void nothing_overlaps(void **state) {
    (void)state;
    sheet s;
    fw_device d = device(two, 2);
    assert_int_equal(annotate(&s, &d, window, die), FW_OK);
    const double lane = 100e-6, least = 5e-6 - 1e-15;
    for (int i = 0; i < s.n; i++) {
        if (s.piece[i].role == FW_ROLE_DICING) continue;
        fw_geometry_box b = fw_geometry_contour_box(&s.piece[i].contour);
        assert_true(b.x0 >= die.x0 + lane + least && b.x1 <= die.x1 - lane - least);
        assert_true(b.y0 >= die.y0 + lane + least && b.y1 <= die.y1 - lane - least);
        assert_true(b.x1 <= window.x0 - least || b.x0 >= window.x1 + least ||
                    b.y1 <= window.y0 - least || b.y0 >= window.y1 + least);
        for (int j = 0; j < i; j++) {
            fw_geometry_vec2 p, q;
            double gap =
                fw_geometry_contour_distance(&s.piece[i].contour, &s.piece[j].contour, &p, &q);
            if (s.piece[j].role != FW_ROLE_DICING && gap < least)
                fail_msg("%s and %s are %g m apart", s.piece[i].label, s.piece[j].label, gap);
        }
    }
    fw_arena_free(s.arena);
}

static bool same(fw_geometry_vec2 p, fw_geometry_vec2 q) {
    return p.x == q.x && p.y == q.y;
}

static void lane_joints_have_partners(void **state) {
    (void)state;
    sheet s;
    fw_device d = device(NULL, 0);
    assert_int_equal(annotate(&s, &d, window, die), FW_OK);
    int joints = 0, partners = 0;
    for (int i = 0; i < s.n; i++)
        for (int a = 0; a < s.piece[i].contour.count; a++) {
            const fw_geometry_segment *p = &s.piece[i].contour.segment[a];
            if (!(p->flags & FW_SEGMENT_JOINT)) continue;
            joints++;
            for (int j = 0; j < s.n; j++)
                for (int b = 0; j != i && b < s.piece[j].contour.count; b++) {
                    const fw_geometry_segment *q = &s.piece[j].contour.segment[b];
                    partners += q->flags & FW_SEGMENT_JOINT && same(p->a, q->b) && same(p->b, q->a);
                }
        }
    assert_int_equal(joints, 8);
    assert_int_equal(partners, 8);
    fw_arena_free(s.arena);
}

static void long_text_is_cut(void **state) {
    (void)state;
    fw_device_parameter many[60];
    for (int i = 0; i < 60; i++)
        many[i] = (fw_device_parameter){.name = "a-rather-long-name", .value = 1e-6, .unit = "um"};
    sheet s;
    fw_device d = device(many, 60);
    char title[400];
    memset(title, 'W', sizeof title - 1);
    title[sizeof title - 1] = '\0';
    d.die.title = title;
    assert_int_equal(annotate(&s, &d, window, die), FW_OK);
    for (int i = 0; i < s.n; i++) {
        fw_geometry_box b = fw_geometry_contour_box(&s.piece[i].contour);
        if (s.piece[i].role == FW_ROLE_TEXT)
            assert_true(b.x0 >= window.x0 - 1e-15 && b.x1 <= window.x1 + 1e-15);
    }
    assert_true(count_of(&s, "parameter text") > 100);
    assert_int_equal(count_of(&s, "version"), 0);
    fw_arena_free(s.arena);
}

/* the drawing is the same for all flows: neither their thickness nor their order shows on it */
static void flows_leave_no_mark(void **state) {
    (void)state;
    fw_device_flow_use flow[] = {{.ref = "al-masked-rie", .thickness_m = (double)NAN},
                                 {.ref = "copper-on-porous-silicon", .thickness_m = 9e-6}};
    fw_device_flow_use swapped[] = {flow[1], flow[0]};
    sheet s[3];
    fw_device d = device(two, 2);
    assert_int_equal(annotate(&s[0], &d, window, die), FW_OK);
    for (int k = 1; k < 3; k++) {
        d.flow = k == 1 ? flow : swapped;
        d.nflow = 2;
        assert_int_equal(annotate(&s[k], &d, window, die), FW_OK);
        assert_int_equal(s[k].n, s[0].n);
        for (int i = 0; i < s[0].n; i++) {
            const fw_geometry_contour *a = &s[0].piece[i].contour, *b = &s[k].piece[i].contour;
            assert_int_equal(a->count, b->count);
            for (int j = 0; j < a->count; j++)
                assert_true(a->segment[j].a.x == b->segment[j].a.x &&
                            a->segment[j].a.y == b->segment[j].a.y);
        }
    }
    for (int k = 0; k < 3; k++)
        fw_arena_free(s[k].arena);
    d = device(NULL, 0);
    assert_int_equal(annotate(&s[0], &d, window, die), FW_OK);
    assert_int_equal(count_of(&s[0], "parameter text"), 0); /* only declared parameters */
    fw_arena_free(s[0].arena);
}

static void narrow_bars(void **state) {
    (void)state;
    sheet s;
    fw_device d = device(two, 2);
    fw_geometry_box tight = {die.x0 + 120e-6, die.y0 + 120e-6, die.x1 - 120e-6, die.y1 - 120e-6};
    assert_int_equal(annotate(&s, &d, tight, die), FW_OK); /* 100 um of them are lane */
    assert_int_equal(count_of(&s, "alignment cross"), 0);
    assert_int_equal(count_of(&s, "dicing lane"), 4);
    fw_arena_free(s.arena);
    d.die.lane_m = 200e-6; /* more than the bar */
    assert_int_equal(annotate(&s, &d, tight, die), FW_GEOMETRY);
    fw_arena_free(s.arena);
    d.die.lane_m = (double)NAN;
    assert_int_equal(annotate(&s, &d, die, window), FW_GEOMETRY);
    fw_arena_free(s.arena);
    assert_int_equal(annotate(&s, &d, (fw_geometry_box){(double)NAN, 0, 1, 1}, die), FW_GEOMETRY);
    fw_arena_free(s.arena);
}

/* a frame without room for crosses says so, and the one that is named has it */
static void missing_crosses_are_said(void **state) {
    (void)state;
    static const double frame_um[] = {60, 79, 80, 250};
    for (size_t i = 0; i < sizeof frame_um / sizeof *frame_um; i++) {
        sheet s = {.arena = fw_arena_new(0)};
        fw_device d = device(NULL, 0);
        fw_diags diags = fw_diags_new(s.arena);
        double in = 100e-6 + frame_um[i] * 1e-6; /* 100 um of lane */
        fw_geometry_box inner = {die.x0 + in, die.y0 + in, die.x1 - in, die.y1 - in};
        d.die.title = NULL;
        assert_int_equal(fw_layout_annotate(s.arena, &d, inner, die, &diags, &s.piece, &s.n, &s.capacity), FW_OK);
        int said = 0;
        for (size_t k = 0; k < diags.count; k++)
            said += diags.item[k].number == 619 && strstr(diags.item[k].message, "with <die frame=\"80 um\">");
        assert_int_equal(said, frame_um[i] < 80);
        assert_int_equal(count_of(&s, "alignment cross"), said ? 0 : 4);
        fw_arena_free(s.arena);
    }
}

/* the narrowest of the four bars decides, whichever it is, and is named as wide as it is */
static void one_narrow_bar_is_enough(void **state) {
    (void)state;
    for (int narrow = -1; narrow < 4; narrow++) {
        sheet s = {.arena = fw_arena_new(0)};
        fw_device d = device(NULL, 0);
        fw_diags diags = fw_diags_new(s.arena);
        double in[4];
        for (int k = 0; k < 4; k++)
            in[k] = 100e-6 + (k == narrow ? 61e-6 + k * 1e-6 : 250e-6 + k * 10e-6); /* 100 um of lane */
        fw_geometry_box inner = {die.x0 + in[0], die.y0 + in[1], die.x1 - in[2], die.y1 - in[3]};
        d.die.title = NULL;
        assert_int_equal(fw_layout_annotate(s.arena, &d, inner, die, &diags, &s.piece, &s.n, &s.capacity), FW_OK);
        char wide[40];
        int said = 0;
        snprintf(wide, sizeof wide, "narrowest bar is %d um wide", 61 + narrow);
        for (size_t k = 0; k < diags.count; k++)
            said += diags.item[k].number == 619 && strstr(diags.item[k].message, wide);
        assert_int_equal(said, narrow >= 0);
        assert_int_equal(count_of(&s, "alignment cross"), narrow < 0 ? 4 : 0);
        fw_arena_free(s.arena);
    }
}

static void short_memory(void **state) {
    (void)state;
    fw_device d = device(two, 2);
    fw_status status = FW_NOMEM;
    for (long at = 1; status != FW_OK && at < 5000; at += 7) {
        sheet s = {.arena = fw_arena_new(0)};
        fw_arena_fail_at(at, 1);
        status = fw_layout_annotate(s.arena, &d, window, die, NULL, &s.piece, &s.n, &s.capacity);
        fw_arena_fail_at(0, 0);
        assert_true(status == FW_OK || status == FW_NOMEM);
        fw_arena_free(s.arena);
    }
    assert_int_equal(status, FW_OK);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(everything_is_there),
        cmocka_unit_test(nothing_overlaps),
        cmocka_unit_test(lane_joints_have_partners),
        cmocka_unit_test(long_text_is_cut),
        cmocka_unit_test(flows_leave_no_mark),
        cmocka_unit_test(narrow_bars),
        cmocka_unit_test(missing_crosses_are_said),
        cmocka_unit_test(one_narrow_bar_is_enough),
        cmocka_unit_test(short_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
