/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drives of hand-made drawings: a body on a base, one or two stators beside it; shorted, not drawn, without a
   pad, at rest and in motion. */
#include "test.h"
#include "wiring/wiring.h"
#include <math.h>
#include <string.h>

#define UM 1e-6

typedef struct bench {
    fw_arena *arena;
    fw_layout layout;
    fw_layout_piece piece[12];
    fw_layout_electrode electrode[2];
    fw_device device;
    fw_device_scene scene[2];
    fw_device_comb comb[2];
    fw_wiring_asked asked;
} bench;

static const char *const stator_label[2] = {"stator of comb drive left", "stator of comb drive "
                                                                         "right"};

static int add(bench *b, fw_layout_role role, int body, const char *label, double x0, double y0,
               double x1, double y1, int joint) {
    fw_geometry_contour c;
    fw_geometry_box box = {x0 * UM, y0 * UM, x1 * UM, y1 * UM};
    assert_int_equal(fw_geometry_contour_rectangle(b->arena, box, &c), FW_OK);
    if (joint >= 0) c.segment[joint].flags |= FW_SEGMENT_JOINT;
    b->piece[b->layout.npiece] = (fw_layout_piece){
        .role = role, .body = body, .joint = FW_NONE, .label = label, .contour = c};
    return b->layout.npiece++;
}

/* edges of a rectangle in the order in which it is drawn: bottom, right, top, left */
enum { BOTTOM, RIGHT, TOP };

static bench *bench_new(double gap_um, double pad_um, double volts) {
    fw_arena *arena = fw_arena_new(0);
    bench *b = fw_arena_one(arena, bench);
    b->arena = arena;
    b->layout = (fw_layout){.drawn = true, .piece = b->piece, .electrode = b->electrode};
    b->layout.die = (fw_geometry_box){-600 * UM, -600 * UM, 600 * UM, 600 * UM};
    add(b, FW_ROLE_STRUCTURE, 0, "link A", -70, 0, 70, 200, BOTTOM);
    add(b, FW_ROLE_STRUCTURE, FW_GROUND, "base", -70, -200, 70, 0, TOP);
    for (int k = 0; k < 2; k++) {
        double side = k ? 1 : -1, near = side * (70 + gap_um), far = near + side * pad_um;
        add(b, FW_ROLE_STRUCTURE, FW_ISLAND, stator_label[k], fmin(near, far), 20, fmax(near, far),
            20 + pad_um, -1);
        b->comb[k] = (fw_device_comb){.id = k ? "right" : "left",
                                      .kind = FW_ELECTRODES_PLATE,
                                      .body_a = FW_GROUND,
                                      .body_b = 0,
                                      .direction_rad = k,
                                      .gap_m = gap_um * UM,
                                      .voltage_V = volts};
        b->electrode[k] = (fw_layout_electrode){
            .comb = &b->comb[k], .stator = stator_label[k], .at = {near * UM, 50 * UM}};
        b->scene[k] = (fw_device_scene){.name = k ? "pull right" : "pull left",
                                        .duration_s = 1e-3,
                                        .comb = &b->comb[k],
                                        .ncomb = 1};
    }
    b->layout.nelectrode = 2;
    b->device = (fw_device){.scene = b->scene, .nscene = 2};
    b->asked.carrier =
        (fw_wiring_carrier){.insulates = true, .words = "glass", .thickness_m = (double)NAN};
    return b;
}

static const fw_wiring *find(bench *b) {
    const fw_wiring *w = NULL;
    assert_int_equal(fw_wiring_find(b->arena, &b->device, &b->layout, &b->asked, &w), FW_OK);
    return w;
}

static const fw_wiring_gap *gap_between(const fw_wiring *w, int p, int q) {
    for (int i = 0; i < w->ngap; i++)
        if (w->gap[i].a == p && w->gap[i].b == q) return &w->gap[i];
    return NULL;
}

static void a_good_device_has_three_nets(void **unused) {
    (void)unused;
    bench *b = bench_new(10, 120, 50);
    const fw_wiring *w = find(b);
    assert_int_equal(w->nnet, 3);
    assert_string_equal(w->net[0].name, "rotor");
    assert_int_equal(w->net[0].pieces, 2);
    assert_relative(w->net[0].area_m2, 56000e-12, 1e-12);
    assert_int_equal(w->net[1].kind, FW_WIRING_STATOR);
    for (int i = 0; i < 3; i++)
        assert_true(w->net[i].needed && w->net[i].padded);
    assert_string_equal(w->net[0].pad_on, "base");
    assert_near(w->net[1].high_V, 50, 0);
    assert_near(w->net[1].low_V, 0, 0);
    assert_int_equal(w->ndrive, 2);
    assert_int_equal(w->nrefusal, 0);
    assert_int_equal(w->nopen, 0);
    const fw_wiring_gap *g = gap_between(w, 0, 1);
    assert_near(g->m, 10e-6, 1e-12);
    assert_near(g->volts, 50, 0);
    assert_relative(g->field_V_per_m, 5e6, 1e-6);
    assert_true(isnan(g->moved_m));
    /* the two are driven in different scenes: one may be at 50 V while the other is at 0 */
    assert_near(gap_between(w, 1, 2)->volts, 50, 0);
    fw_arena_free(b->arena);
}

/* rotor and stator joined: the stator's piece is cut off from a bar that grows out of the link */
static void shorted_is_refused(void **unused) {
    (void)unused;
    bench *b = bench_new(0, 120, 50);
    fw_geometry_contour link;
    fw_geometry_outline o = fw_geometry_outline_start(b->arena, (fw_geometry_vec2){-70 * UM, 0});
    const double corner[5][2] = {{70, 0}, {70, 200}, {-70, 200}, {-70, 140}, {-70, 20}};
    for (int i = 0; i < 5; i++)
        fw_geometry_outline_line(&o, (fw_geometry_vec2){corner[i][0] * UM, corner[i][1] * UM},
                                 i == 0 || i == 4 ? FW_SEGMENT_JOINT : 0);
    assert_int_equal(fw_geometry_outline_close(&o, &link), FW_OK);
    b->piece[0].contour = link;
    assert_int_equal(find(b)->drive[0].fault, FW_WIRING_FINE);
    b->piece[2].contour.segment[RIGHT].flags |= FW_SEGMENT_JOINT;
    const fw_wiring *w = find(b);
    assert_int_equal(w->nnet, 2);
    assert_int_equal(w->drive[0].fault, FW_WIRING_SHORTED);
    assert_int_equal(w->drive[1].fault, FW_WIRING_FINE);
    assert_non_null(strstr(w->refusal[0], "comb drive left is shorted"));
    assert_non_null(strstr(w->refusal[0], "(-70, 50) um"));
    fw_arena_free(b->arena);
}

static void a_carrier_that_conducts_shorts_all(void **unused) {
    (void)unused;
    bench *b = bench_new(10, 120, 50);
    add(b, FW_ROLE_FRAME, FW_GROUND, "frame", -400, -400, -300, 400, -1);
    b->asked.carrier.insulates = false;
    const fw_wiring *w = find(b);
    assert_int_equal(w->nnet, 1); /* islands fall out, the frame stands on the carrier */
    assert_string_equal(w->net[0].name, "rotor and frame and carrier");
    assert_int_equal(w->net[0].pieces, 3);
    for (int i = 0; i < 2; i++)
        assert_int_equal(w->drive[i].fault, FW_WIRING_SHORTED);
    fw_arena_free(b->arena);
}

static void no_room_for_a_pad_is_refused(void **unused) {
    (void)unused;
    bench *b = bench_new(10, 95, 50); /* 95 um less 10 um on either side is no square of 80 um */
    const fw_wiring *w = find(b);
    assert_int_equal(w->drive[0].fault, FW_WIRING_NO_PAD);
    assert_string_equal(fw_wiring_contact_word(&w->net[1]), "none");
    assert_non_null(strstr(w->refusal[0], "no contact for its stator"));
    assert_int_equal(w->nrefusal, 2);
    fw_arena_free(b->arena);
}

static void what_is_not_drawn_is_not_guaranteed(void **unused) {
    (void)unused;
    bench *b = bench_new(10, 120, 50);
    b->electrode[1].stator = NULL;
    b->electrode[1].why_not = "its stator would cross the base";
    const fw_wiring *w = find(b);
    assert_int_equal(w->drive[1].fault, FW_WIRING_NOT_DRAWN);
    assert_int_equal(w->nrefusal, 0);
    assert_int_equal(w->nopen, 1);
    assert_non_null(strstr(w->open[0], "its stator would cross the base"));
    /* its piece is there all the same, and nobody needs it */
    assert_int_equal(w->nremark, 1);
    assert_non_null(strstr(w->remark[0], "needed by no scene"));
    fw_arena_free(b->arena);
}

/* a drive of another flow's scene asks for nothing */
static void scenes_of_other_flows_do_not_count(void **unused) {
    (void)unused;
    bench *b = bench_new(10, 120, 50);
    b->scene[1].flow = "another";
    b->asked.flow = "this";
    const fw_wiring *w = find(b);
    assert_int_equal(w->ndrive, 1);
    assert_false(w->net[2].needed);
    assert_int_equal(w->nremark, 1);
    fw_arena_free(b->arena);
}

/* 300 V across 10 um lie in the range in which air breaks down, 400 V beyond it */
static void voltage_is_held_against_breakdown(void **unused) {
    (void)unused;
    static const struct {
        double volts;
        int refusals, open;
    } row[] = {{250, 0, 0}, {300, 0, 2}, {400, 2, 0}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        bench *b = bench_new(10, 120, row[i].volts);
        const fw_wiring *w = find(b);
        assert_int_equal(w->nrefusal, row[i].refusals);
        assert_int_equal(w->nopen, row[i].open);
        fw_arena_free(b->arena);
    }
}

/* 500 V across 100 um are nothing at 1 atm; at 5 kPa that is 0.375 Torr cm, where air bears some 330 V, and the 340 um between
   the stators are 1.3 Torr cm, which surely do not bear it. Where only one scene is there nothing is sure. */
static void thin_air_breaks_down(void **unused) {
    (void)unused;
    for (int scenes = 0; scenes <= 2; scenes++) {
        bench *b = bench_new(100, 120, 500);
        fw_device_air air = {.pressure_Pa = 5e3, .temperature_K = (double)NAN};
        for (int i = 0; i < scenes; i++)
            b->scene[i].air = &air, b->scene[i].nair = 1;
        const fw_wiring *w = find(b);
        assert_int_equal(w->nrefusal, scenes == 2);
        assert_int_equal(w->nopen, scenes == 0 ? 0 : scenes == 1 ? 3 : 2);
        fw_arena_free(b->arena);
    }
}

/* what the motion leaves of a gap counts, and walls come off it */
static void gaps_in_motion(void **unused) {
    (void)unused;
    bench *b = bench_new(10, 120, 50);
    fw_wiring_moved moved[] = {
        {.stator = stator_label[0], .scene = "pull left", .m = 4e-6, .t_s = 1e-3},
        {.stator = stator_label[0], .scene = "pull right", .m = 9e-6, .t_s = 2e-3},
        {.stator = stator_label[1], .scene = "pull right", .m = 0, .t_s = 3e-3}};
    b->asked.moved = moved;
    b->asked.nmoved = 3;
    b->asked.wall_m = 0.5e-6;
    const fw_wiring *w = find(b);
    const fw_wiring_gap *left = gap_between(w, 0, 1), *right = gap_between(w, 0, 2);
    assert_near(left->made_m, 3.5e-6, 1e-18);
    assert_string_equal(left->scene, "pull left");
    assert_relative(left->field_V_per_m, 50 / 3.5e-6, 1e-12);
    assert_near(right->made_m, -0.5e-6, 1e-18);
    assert_int_equal(w->nrefusal, 1);
    assert_non_null(strstr(w->refusal[0], "stator of comb drive right touch in scene pull right"));
    fw_arena_free(b->arena);
}

/* below 0 where the law may be: its largest size either way */
static void the_range_of_a_voltage(void **unused) {
    (void)unused;
    bench *b = bench_new(10, 120, -30);
    const fw_wiring *w = find(b);
    assert_near(w->net[1].low_V, -30, 0);
    assert_near(w->net[1].high_V, 0, 0);
    assert_near(gap_between(w, 1, 2)->volts, 30, 0);
    fw_arena_free(b->arena);
}

/* a part of the frame on which nothing hangs but a tether: a net of its own, one with the rotor until it is broken */
static void a_tether_is_broken(void **unused) {
    (void)unused;
    bench *b = bench_new(10, 120, 50);
    add(b, FW_ROLE_FRAME, FW_GROUND, "frame", -300, 300, 300, 400, BOTTOM);
    int finger_at = add(b, FW_ROLE_TETHER, FW_GROUND, "tether of link A", -300, 200, 300, 300, TOP);
    b->piece[0].contour.segment[TOP].flags |= FW_SEGMENT_JOINT;
    /* the cut at the link is as wide as the link */
    fw_geometry_contour finger;
    fw_geometry_outline o =
        fw_geometry_outline_start(b->arena, (fw_geometry_vec2){-70 * UM, 200 * UM});
    const double corner[3][2] = {{70, 200}, {300, 300}, {-300, 300}};
    for (int i = 0; i < 3; i++)
        fw_geometry_outline_line(&o, (fw_geometry_vec2){corner[i][0] * UM, corner[i][1] * UM},
                                 i % 2 ? 0 : FW_SEGMENT_JOINT);
    assert_int_equal(fw_geometry_outline_close(&o, &finger), FW_OK);
    b->piece[finger_at].contour = finger;
    const fw_wiring *w = find(b);
    assert_int_equal(w->nnet, 4);
    assert_string_equal(w->net[3].name, "frame");
    assert_int_equal(w->net[3].pieces, 2);
    assert_true(w->net[3].tethered);
    assert_int_equal(w->nrefusal, 0);
    const fw_wiring_gap *g = gap_between(w, 0, 3);
    assert_true(!g || g->m > 50e-6);
    assert_int_equal(w->nremark, 2);
    fw_arena_free(b->arena);
}

/* the handle below an oxide is a net of its own */
static void a_handle_is_seen(void **unused) {
    (void)unused;
    bench *b = bench_new(10, 120, 200);
    b->asked.carrier.thickness_m = 2e-6;
    b->asked.carrier.handle = true;
    b->asked.carrier.breakdown_V_per_m = 500e6;
    b->asked.carrier.breakdown_share = 0.3;
    const fw_wiring *w = find(b);
    const fw_wiring_gap *rotor = gap_between(w, 0, 3), *stator = gap_between(w, 1, 3);
    assert_near(stator->volts, 200, 0);
    assert_relative(stator->breakdown_V[0], 400, 1e-12); /* two standard uncertainties either way */
    assert_relative(stator->breakdown_V[1], 1600, 1e-12);
    assert_true(rotor->breakdown_V[0] < 100); /* 2 um of air */
    assert_int_equal(w->nopen, 1);
    assert_non_null(strstr(w->open[0], "rotor and the handle"));
    fw_arena_free(b->arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_good_device_has_three_nets),
        cmocka_unit_test(shorted_is_refused),
        cmocka_unit_test(a_carrier_that_conducts_shorts_all),
        cmocka_unit_test(no_room_for_a_pad_is_refused),
        cmocka_unit_test(what_is_not_drawn_is_not_guaranteed),
        cmocka_unit_test(scenes_of_other_flows_do_not_count),
        cmocka_unit_test(voltage_is_held_against_breakdown),
        cmocka_unit_test(thin_air_breaks_down),
        cmocka_unit_test(gaps_in_motion),
        cmocka_unit_test(the_range_of_a_voltage),
        cmocka_unit_test(a_tether_is_broken),
        cmocka_unit_test(a_handle_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
