/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Layouts that cannot be made: what is shown of them, and the places of their faults, on devices
   whose hinges and plates are moved by random amounts. */
#include "base/constants.h"
#include "fixture.h"
#include "layout/layout.h"
#include "test.h"
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct drawn {
    fw_arena *arena;
    fw_diags diags;
    const fw_layout *layout;
    fw_status status;
} drawn;

static drawn draw(const fixture *f) {
    drawn d = {.arena = fw_arena_new(0)};
    d.diags = fw_diags_new(d.arena);
    d.status = fw_layout_build(d.arena, &f->device, &d.diags, &d.layout);
    return d;
}

static double uniform(uint64_t *state, double from, double to) {
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return from + (to - from) * (double)(*state >> 11) / 9007199254740992.0;
}

/* a device is either drawn without a fault, or shown with every error as a fault */
static void every_error_is_a_fault(const drawn *d, const fw_device *device) {
    size_t errors = 0;
    assert_true(d->status == FW_OK || d->status == FW_GEOMETRY);
    assert_non_null(d->layout);
    assert_int_equal(d->layout->drawn, d->status == FW_OK);
    for (size_t i = 0; i < d->diags.count; i++) {
        const fw_diag *said = &d->diags.item[i];
        bool found = false;
        if (said->severity != FW_ERROR) continue;
        errors++;
        for (int k = 0; k < d->layout->nfault; k++)
            found = found || (d->layout->fault[k].number == said->number &&
                              strcmp(d->layout->fault[k].message, said->message) == 0);
        if (!found) fail_msg("no fault for: %s", said->message);
    }
    assert_int_equal(d->status == FW_OK, errors == 0);
    assert_int_equal(d->layout->nfault > 0, errors > 0);
    if (errors == 0) return;
    assert_non_null(d->layout->why_not);
    for (int b = 0; b < device->nbody; b++) { /* every body is shown */
        bool shown = false;
        for (int i = 0; i < d->layout->npiece; i++)
            shown = shown || (d->layout->piece[i].body == b &&
                              d->layout->piece[i].role == FW_ROLE_STRUCTURE);
        if (!shown) fail_msg("body %s is not shown", device->body[b].id);
    }
}

static bool inside(const fw_layout *l, int body, fw_geometry_vec2 p) {
    for (int i = 0; i < l->npiece; i++)
        if (l->piece[i].body == body && l->piece[i].role == FW_ROLE_STRUCTURE &&
            fw_geometry_contour_contains(&l->piece[i].contour, p))
            return true;
    return false;
}

static bool within(const fw_geometry_region *r, fw_geometry_vec2 p) {
    int depth = 0;
    for (int i = 0; i < r->count; i++)
        if (fw_geometry_contour_contains(&r->contour[i], p))
            depth += fw_geometry_contour_area(&r->contour[i]) > 0 ? 1 : -1;
    return depth > 0;
}

/* the outlines are those that were compared, so that points tell the overlap; on its edge either
   answer holds */
static void overlap_is_of_both(const fw_layout *l, const fw_layout_fault *f, uint64_t *state) {
    enum { POINTS = 400 };
    fw_geometry_box box = fw_geometry_contour_box(&f->overlap.contour[0]);
    int wrong = 0, in = 0;
    for (int i = 0; i < POINTS; i++) {
        fw_geometry_vec2 p = {uniform(state, box.x0 - 20e-6, box.x1 + 20e-6),
                              uniform(state, box.y0 - 20e-6, box.y1 + 20e-6)};
        bool both = inside(l, f->body[0], p) && inside(l, f->body[1], p);
        in += both;
        wrong += both != within(&f->overlap, p);
    }
    assert_int_equal(wrong, 0);
    assert_true(in > 0);
}

static void plates_that_grow(void **state) {
    (void)state;
    int overlaps = 0, bad = 0;
    for (uint64_t seed = 1; seed <= (uint64_t)test_cases(60, 20); seed++) {
        uint64_t r = seed;
        fixture f;
        fixture_six_bar(&f);
        f.device.die.width_m = f.device.die.height_m = NONE;
        f.body[2].plate_width_m = uniform(&r, 1.0e-3, 3.2e-3);
        f.body[2].plate_height_m = uniform(&r, 0.3e-3, 1.8e-3);
        f.body[2].plate_y_m = uniform(&r, 2.0e-3, 2.9e-3);
        drawn d = draw(&f);
        every_error_is_a_fault(&d, &f.device);
        bad += d.status != FW_OK;
        for (int i = 0; i < d.layout->nfault; i++) {
            const fw_layout_fault *fault = &d.layout->fault[i];
            if (fault->number != 120 || fault->overlap.count == 0 || fault->njoint > 0) continue;
            if (fault->body[0] < 0 || fault->body[1] < 0) continue;
            overlap_is_of_both(d.layout, fault, &r);
            overlaps++;
        }
        fw_arena_free(d.arena);
    }
    assert_true(bad > 8);
    assert_true(overlaps > 8);
}

static void hinges_that_meet(void **state) {
    (void)state;
    int close = 0;
    for (uint64_t seed = 1; seed <= (uint64_t)test_cases(60, 20); seed++) {
        uint64_t r = 77 * seed;
        fixture f;
        seed % 3 == 0   ? fixture_stage(&f)
        : seed % 3 == 1 ? fixture_six_bar(&f)
                        : fixture_four_bar(&f);
        f.device.die.width_m = f.device.die.height_m = NONE;
        int n = f.device.nrevolute, i = (int)uniform(&r, 0, n), k = (i + 1) % n;
        double share = uniform(&r, 0.5, 0.98); /* of the way to its neighbour */
        f.revolute[i].x_m += share * (f.revolute[k].x_m - f.revolute[i].x_m);
        f.revolute[i].y_m += share * (f.revolute[k].y_m - f.revolute[i].y_m);
        drawn d = draw(&f);
        every_error_is_a_fault(&d, &f.device);
        for (int q = 0; q < d.layout->nfault; q++)
            if (d.layout->fault[q].number == 125) {
                const fw_layout_fault *fault = &d.layout->fault[q];
                assert_int_equal(fault->njoint, 2);
                double x0 = f.revolute[fault->joint[0]].x_m, x1 = f.revolute[fault->joint[1]].x_m;
                assert_true(fabs(fault->at.x - 0.5 * (x0 + x1)) < 1e-12);
                close++;
            }
        fw_arena_free(d.arena);
    }
    assert_true(close > 5);
}

/* bars too wide, flexures without room, fillets that do not fit */
static void sizes_that_do_not_fit(void **state) {
    (void)state;
    int bad = 0;
    for (uint64_t seed = 1; seed <= (uint64_t)test_cases(60, 20); seed++) {
        uint64_t r = 1000 + seed;
        fixture f;
        seed % 2 ? fixture_six_bar(&f) : fixture_four_bar(&f);
        f.device.die.width_m = f.device.die.height_m = NONE;
        int b = seed % 2 ? 3 : 1, j = (int)uniform(&r, 0, f.device.nrevolute);
        if (seed % 5 < 2) f.body[b].width_m = uniform(&r, 0.3e-3, 1.4e-3);
        if (seed % 5 == 2) f.flexure[j].fillet_m = uniform(&r, 5e-6, 90e-6);
        if (seed % 5 == 3) f.flexure[j].angle_rad = uniform(&r, 5.0, 6.2);
        if (seed % 5 == 4) f.flexure[j].width_m = uniform(&r, 8e-6, 60e-6);
        drawn d = draw(&f);
        every_error_is_a_fault(&d, &f.device);
        bad += d.status != FW_OK;
        fw_arena_free(d.arena);
    }
    assert_true(bad > 8);
}

/* ---- the way of a base to the frame ---- */

/* leaf four-bar, all of it turned */
static void turned_four_bar(double turn_deg, bool mirrored, char *xml, size_t size) {
    static const struct {
        const char *id, *a, *b;
        double x, y, ax, ay, bx, by, axis;
    } hinge[] = {{"A", "ground", "crank", 0, 0, 0, 0, -0.1, -0.75, 0},
                 {"B", "crank", "coup", 0.2, 1.5, 0.1, 0.75, -0.85, -0.05, 20},
                 {"C", "coup", "rock", 1.9, 1.6, 0.85, 0.05, 0.05, 0.8, 180},
                 {"D", "rock", "ground", 1.8, 0, -0.05, -0.8, 0, 0, 180}};
    static const struct {
        const char *id;
        double x, y, width;
    } body[] = {{"crank", 0.1, 0.75, 0.12}, {"coup", 1.05, 1.55, 0.16}, {"rock", 1.85, 0.8, 0.12}};
    const double m = mirrored ? -1 : 1, c = cos(turn_deg * FW_PI / 180), t = sin(turn_deg * FW_PI / 180);
    size_t n = (size_t)snprintf(
        xml, size,
        "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><material ref=\"silicon-100\" "
        "thickness=\"50 um\"/><flexure id=\"leaf\" kind=\"leaf\" length=\"0.4 mm\" width=\"0.01 mm\" "
        "fillet=\"0.005 mm\"/><mechanism>");
    for (int i = 0; i < 3; i++)
        n += (size_t)snprintf(xml + n, size - n,
                              "<body id=\"%s\" x=\"%.12g mm\" y=\"%.12g mm\" phi=\"%.12g deg\" width=\"%g mm\"/>",
                              body[i].id, m * body[i].x * c - body[i].y * t,
                              m * body[i].x * t + body[i].y * c, turn_deg, body[i].width);
    for (int i = 0; i < 4; i++) {
        const bool from = i == 0, to = i == 3;
        const double gx = m * hinge[i].x * c - hinge[i].y * t, gy = m * hinge[i].x * t + hinge[i].y * c;
        n += (size_t)snprintf(
            xml + n, size - n,
            "<revolute id=\"%s\" a=\"%s\" a-x=\"%.12g mm\" a-y=\"%.12g mm\" b=\"%s\" b-x=\"%.12g mm\" "
            "b-y=\"%.12g mm\" hinge=\"leaf\" axis=\"%.12g deg\" free-angle=\"%.12g deg\"/>",
            hinge[i].id, hinge[i].a, from ? gx : m * hinge[i].ax, from ? gy : hinge[i].ay, hinge[i].b,
            to ? gx : m * hinge[i].bx, to ? gy : hinge[i].by, remainder(m * hinge[i].axis + turn_deg, 360),
            from ? remainder(turn_deg, 360) : to ? -remainder(turn_deg, 360) : 0.0);
    }
    snprintf(xml + n, size - n, "</mechanism></device>");
}

static drawn draw_text(const char *xml, const fw_device **device) {
    drawn d = {.arena = fw_arena_new(0)};
    d.diags = fw_diags_new(d.arena);
    d.status = fw_device_read(d.arena, "t.xml", xml, strlen(xml), NULL, 0, &d.diags, device);
    if (d.status != FW_OK) fail_msg("%s", d.diags.item[0].message);
    d.status = fw_layout_build(d.arena, *device, &d.diags, &d.layout);
    return d;
}

/* a base finds the frame however the whole device is turned */
static void a_turned_base_finds_the_frame(void **state) {
    (void)state;
    for (int mirrored = 0; mirrored < 2; mirrored++)
        for (int turn = 0; turn < 360; turn += 1) {
            char xml[4096];
            const fw_device *device;
            turned_four_bar(turn, mirrored, xml, sizeof xml);
            drawn d = draw_text(xml, &device);
            if (d.status != FW_OK)
                fail_msg("turned by %d deg, mirrored %d: %s", turn, mirrored, d.diags.item[0].message);
            fw_arena_free(d.arena);
        }
}

/* two ground hinges within a ring that moves: what is in the way is said of every side, and shown */
static void what_is_in_the_way_of_a_base_is_named(void **state) {
    (void)state;
    static const char ring[] =
        "<device xmlns=\"urn:flexwright:device:1\" name=\"guide\">"
        "<material ref=\"silicon-100\" thickness=\"50 um\"/>"
        "<flow ref=\"al-masked-rie\"/>"
        "<flexure id=\"leaf\" kind=\"leaf\" length=\"0.4 mm\" width=\"0.01 mm\" fillet=\"0.005 mm\"/>"
        "<mechanism>"
        "<body id=\"left\" x=\"0 mm\" y=\"-0.5 mm\" width=\"0.1 mm\"/>"
        "<body id=\"right\" x=\"1.5 mm\" y=\"-0.5 mm\" width=\"0.1 mm\"/>"
        "<body id=\"stage\" x=\"0.75 mm\" y=\"-1 mm\"><plate y=\"-0.3 mm\" width=\"3 mm\" height=\"0.2 mm\"/><plate y=\"1.6 mm\" width=\"3 mm\" height=\"0.2 mm\"/><plate x=\"1.4 mm\" y=\"0.65 mm\" width=\"0.2 mm\" height=\"2.1 mm\"/><plate x=\"-1.4 mm\" y=\"0.65 mm\" width=\"0.2 mm\" height=\"2.1 mm\"/></body>"
        "<revolute id=\"A\" a=\"ground\" a-x=\"0 mm\" a-y=\"0 mm\" b=\"left\" b-y=\"0.5 mm\" hinge=\"leaf\" axis=\"90 deg\"/>"
        "<revolute id=\"B\" a=\"left\" a-y=\"-0.5 mm\" b=\"stage\" b-x=\"-0.75 mm\" hinge=\"leaf\" axis=\"90 deg\"/>"
        "<revolute id=\"C\" a=\"ground\" a-x=\"1.5 mm\" a-y=\"0 mm\" b=\"right\" b-y=\"0.5 mm\" hinge=\"leaf\" axis=\"90 deg\"/>"
        "<revolute id=\"D\" a=\"right\" a-y=\"-0.5 mm\" b=\"stage\" b-x=\"0.75 mm\" hinge=\"leaf\" axis=\"90 deg\"/>"
        "</mechanism>"
        "</device>";
    const fw_device *device;
    drawn d = draw_text(ring, &device);
    assert_int_equal(d.status, FW_GEOMETRY);
    assert_int_equal(d.diags.errors, 1);
    const fw_diag *said = &d.diags.item[d.diags.count - 1];
    assert_int_equal(said->number, 128);
    if (!strstr(said->message, "to the upper side link stage is in the way, to the lower one link stage, "
                               "to the left one its own bar points, to the right one its own bar points"))
        fail_msg("%s", said->message);
    every_error_is_a_fault(&d, device);
    assert_int_equal(d.layout->fault[0].body[1], 2);
    fw_arena_free(d.arena);
}

/* ---- fillets below what every mask shows ---- */

/* Four arcs of one flexure end at eight places of four bodies: its fillets are said once, where the file states them,
   and no longer where they are as large as the message asks for. */
static void a_small_fillet_is_said_once(void **state) {
    (void)state;
    static const struct {
        const char *fillet;
        int said;
    } of[] = {{"3 um", 1}, {"4 um", 1}, {"4.2 um", 0}, {"6 um", 0}};
    for (int k = 0; k < 4; k++) {
        char xml[4096], arcs[8192];
        const fw_device *device;
        turned_four_bar(0, false, xml, sizeof xml);
        char *leaf = strstr(xml, "kind=\"leaf\""), *rest = strstr(xml, "/><mechanism>");
        assert_true(leaf && rest);
        *leaf = '\0';
        snprintf(arcs, sizeof arcs,
                 "%skind=\"csfh\" radius=\"100 um\" angle=\"270 deg\" width=\"8 um\" gap=\"8 um\" "
                 "fillet=\"%s\"%s",
                 xml, of[k].fillet, rest);
        for (char *axis = arcs; (axis = strstr(axis, " axis=\"")) != NULL;) /* which the layout chooses for arcs */
            memset(axis, ' ', (size_t)(strchr(axis + 7, '"') - axis) + 1);
        drawn d = draw_text(arcs, &device);
        if (d.status != FW_OK) fail_msg("%s: %s", of[k].fillet, d.layout->fault[0].message);
        int said = 0;
        for (size_t i = 0; i < d.diags.count; i++) {
            const fw_diag *one = &d.diags.item[i];
            if (one->number != 138) continue;
            said++;
            if (!strstr(one->message, "the fillets at the ends of flexure leaf have a radius of only"))
                fail_msg("%s: %s", of[k].fillet, one->message);
            assert_int_equal(one->place.column, device->flexure[0].place.column);
        }
        if (said != of[k].said) fail_msg("%s: said %d times", of[k].fillet, said);
        fw_arena_free(d.arena);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(plates_that_grow),
                                       cmocka_unit_test(hinges_that_meet),
                                       cmocka_unit_test(sizes_that_do_not_fit),
                                       cmocka_unit_test(a_turned_base_finds_the_frame),
                                       cmocka_unit_test(what_is_in_the_way_of_a_base_is_named),
                                       cmocka_unit_test(a_small_fillet_is_said_once)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
