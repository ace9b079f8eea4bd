/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What finds no room in a drawing is kept with its place and the reason, and the room that is named for
   it is room: the device with that very change is drawn whole. */
#include "fixture.h"
#include "layout/draw.h"
#include "layout/layout.h"
#include "test.h"
#include <stdio.h>
#include <string.h>

static fw_device_scene scene;
static fw_device_comb comb;
static fw_device_tendon tendon;
static fw_device_eyelet eyelet;

typedef struct drawn {
    fw_arena *arena;
    fw_diags diags;
    const fw_layout *layout;
} drawn;

static drawn draw(const fw_device *device) {
    drawn d = {.arena = fw_arena_new(0)};
    assert_non_null(d.arena);
    d.diags = fw_diags_new(d.arena);
    assert_int_equal(fw_layout_build(d.arena, device, &d.diags, &d.layout), FW_OK);
    return d;
}

/* the only thing missing, with its nearest room; warned of at its place */
static const fw_layout_missing *only_missing(drawn *d, const fw_device *device, int number) {
    assert_int_equal(fw_layout_rooms_find(d->arena, device, d->layout, &d->layout), FW_OK);
    assert_int_equal(d->layout->nmissing, 1);
    const fw_layout_missing *m = &d->layout->missing[0];
    int said = 0;
    assert_int_equal(m->number, number);
    assert_non_null(m->why);
    assert_non_null(m->room);
    for (size_t i = 0; i < d->diags.count; i++)
        said += d->diags.item[i].number == number && d->diags.item[i].severity == FW_WARNING &&
                d->diags.item[i].place.line == m->place.line && m->place.line > 0;
    assert_int_equal(said, 1);
    assert_true(isfinite(m->at.x + m->at.y));
    return m;
}

static void nothing_missing(const fw_device *device) {
    drawn d = draw(device);
    if (d.layout->nmissing > 0) fail_msg("%s", d.layout->missing[0].why);
    fw_arena_free(d.arena);
}

/* a plate on one hinge, with electrodes at a place of its own axes */
static void paddle_with_comb(fixture *f, fw_device_electrodes kind, double x_m, double y_m) {
    fixture_paddle(f);
    f->body[0].x_m = 0.5e-3;
    f->body[0].y_m = 0.3e-3;
    double c = cos(M_PI / 6), s = sin(M_PI / 6);
    comb = (fw_device_comb){.id = "push",
                            .kind = kind,
                            .body_a = FW_GROUND,
                            .bx_m = c * x_m - s * y_m,
                            .by_m = s * x_m + c * y_m,
                            .direction_rad = M_PI / 6,
                            .fingers = 5,
                            .gap_m = 9e-6,
                            .overlap_m = 40e-6,
                            .length_m = 100e-6,
                            .width_m = 10e-6,
                            .place = {"test.xml", 12, 5}};
    scene = (fw_device_scene){.name = "s", .comb = &comb, .ncomb = 1};
    f->device.die.tethers = false;
    f->device.scene = &scene;
    f->device.nscene = 1;
}

static bool take_place(const char *room, double *x_m, double *y_m) {
    const char *at = strstr(room, "x=\"");
    double x = 0, y = 0;
    if (!at || sscanf(at, "x=\"%lf um\" y=\"%lf um\"", &x, &y) != 2) return false;
    *x_m = 1e-6 * x;
    *y_m = 1e-6 * y;
    return true;
}

/* five digits of a micrometre are what a user writes */
static void a_comb_names_a_place_that_has_room(void **unused) {
    (void)unused;
    static const double wrong[][2] = {{-0.5e-3, -0.2e-3}, {0.55e-3, 0.0}, {0.2e-3, 0.0}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        fixture f;
        paddle_with_comb(&f, FW_ELECTRODES_COMB, wrong[i][0], wrong[i][1]);
        drawn d = draw(&f.device);
        if (d.layout->nmissing == 0) { /* a stem reaches it */
            fw_arena_free(d.arena);
            continue;
        }
        const fw_layout_missing *m = only_missing(&d, &f.device, 131);
        assert_ptr_equal(m->comb, &comb);
        assert_string_equal(m->name, "comb drive push");
        if (!take_place(m->room, &comb.bx_m, &comb.by_m)) fail_msg("%s", m->room);
        nothing_missing(&f.device);
        fw_arena_free(d.arena);
    }
}

static void too_many_fingers_are_fewer(void **unused) {
    (void)unused;
    fixture f;
    int fewer = 0;
    paddle_with_comb(&f, FW_ELECTRODES_COMB, 0.48e-3, 0.0);
    nothing_missing(&f.device);
    comb.fingers = 101;
    drawn d = draw(&f.device);
    const fw_layout_missing *m = only_missing(&d, &f.device, 131);
    const char *at = strstr(m->room, "fingers=\"");
    if (!at || sscanf(at, "fingers=\"%d\"", &fewer) != 1) fail_msg("%s: %s", m->why, m->room);
    assert_in_range(fewer, 1, 100);
    comb.fingers = fewer;
    nothing_missing(&f.device);
    fw_arena_free(d.arena);
}

/* on a die that is stated, what is said is the most that has room: with one more there is none */
static void as_many_fingers_as_there_is_room_for(void **unused) {
    (void)unused;
    fixture f;
    int most = 0;
    paddle_with_comb(&f, FW_ELECTRODES_COMB, 0.48e-3, 0.0);
    comb.fingers = 22;
    drawn d = draw(&f.device);
    f.device.die.width_m = d.layout->die.x1 - d.layout->die.x0;
    f.device.die.height_m = d.layout->die.y1 - d.layout->die.y0;
    fw_arena_free(d.arena);
    comb.fingers = 38; /* 37, 36, 34 and 30 are tried, and then what is between */
    d = draw(&f.device);
    const fw_layout_missing *m = only_missing(&d, &f.device, 131);
    const char *at = strstr(m->room, "fingers=\"");
    if (!at || sscanf(at, "fingers=\"%d\"", &most) != 1) fail_msg("%s: %s", m->why, m->room);
    fw_arena_free(d.arena);
    for (int more = 0; more < 2; more++) {
        comb.fingers = most + more;
        d = draw(&f.device);
        if (d.layout->nmissing != more) fail_msg("%d fingers: %d missing", comb.fingers, d.layout->nmissing);
        fw_arena_free(d.arena);
    }
}

static void short_fingers_are_longer(void **unused) {
    (void)unused;
    fixture f;
    double um = 0;
    paddle_with_comb(&f, FW_ELECTRODES_COMB, 0.48e-3, 0.0);
    comb.length_m = 45e-6;
    drawn d = draw(&f.device);
    const fw_layout_missing *m = only_missing(&d, &f.device, 131);
    const char *at = strstr(m->room, "length=\"");
    if (!at || sscanf(at, "length=\"%lf um\"", &um) != 1) fail_msg("%s", m->room);
    comb.length_m = 1e-6 * um;
    nothing_missing(&f.device);
    fw_arena_free(d.arena);
}

/* their place is not what they lack: one width is named, by the reason and by the proposal, and it is drawn */
static void narrow_fingers_are_wider(void **unused) {
    (void)unused;
    fixture f;
    double um = 0, named = 0;
    paddle_with_comb(&f, FW_ELECTRODES_COMB, 0.48e-3, 0.0);
    comb.width_m = 2e-6;
    drawn d = draw(&f.device);
    const fw_layout_missing *m = only_missing(&d, &f.device, 131);
    const char *reason = strstr(m->why, "make them ");
    if (!reason || sscanf(reason, "make them %lf um wide or wider", &named) != 1) fail_msg("%s", m->why);
    if (strncmp(m->room, "width=\"", 7) || sscanf(m->room, "width=\"%lf um\"", &um) != 1)
        fail_msg("%s", m->room);
    assert_non_null(strstr(fw_layout_missing_way(m), "instead"));
    assert_true(um == named && um > 2 && um < 10);
    comb.width_m = 1e-6 * um;
    nothing_missing(&f.device);
    fw_arena_free(d.arena);
}

/* fingers that are wide enough lack something else, and are not told to be as wide as they are */
static void wide_fingers_are_not_told_to_be_wide(void **unused) {
    (void)unused;
    fixture f;
    for (int i = 0; i <= 8; i++) {
        paddle_with_comb(&f, FW_ELECTRODES_COMB, 0.4e-3 + 10e-6 * i, 0.0);
        comb.width_m = 8e-6, comb.gap_m = 5e-6;
        drawn d = draw(&f.device);
        for (int k = 0; k < d.layout->nmissing; k++)
            assert_null(strstr(d.layout->missing[k].why, "wide or wider"));
        fw_arena_free(d.arena);
    }
}

/* where neither another place nor another width does alone both are named, and what is named is drawn */
static void narrow_fingers_without_room_get_both(void **unused) {
    (void)unused;
    fixture f;
    double um = 0;
    paddle_with_comb(&f, FW_ELECTRODES_COMB, 0.3e-3, 0.0); /* inside its own body */
    comb.width_m = 2e-6;
    drawn d = draw(&f.device);
    const fw_layout_missing *m = only_missing(&d, &f.device, 131);
    if (sscanf(m->room, "with width=\"%lf um\"", &um) != 1) fail_msg("%s", m->room);
    const double x = comb.bx_m, y = comb.by_m;
    comb.width_m = 1e-6 * um;
    drawn wide = draw(&f.device);
    assert_int_equal(wide.layout->nmissing, 1); /* the width alone does not do */
    fw_arena_free(wide.arena);
    if (!take_place(m->room, &comb.bx_m, &comb.by_m)) fail_msg("%s", m->room);
    assert_true(comb.bx_m != x || comb.by_m != y);
    nothing_missing(&f.device);
    fw_arena_free(d.arena);
}

/* of a width that the file does not state the default is what may be too little */
static void unstated_width_is_the_default(void **unused) {
    (void)unused;
    fixture f;
    paddle_with_comb(&f, FW_ELECTRODES_COMB, 0.3e-3, 0.0); /* inside its own body */
    comb.width_m = 0;
    drawn d = draw(&f.device);
    const fw_layout_missing *m = only_missing(&d, &f.device, 131);
    if (!take_place(m->room, &comb.bx_m, &comb.by_m)) fail_msg("%s", m->room);
    nothing_missing(&f.device);
    fw_arena_free(d.arena);
}

static void a_plate_names_a_place_that_has_room(void **unused) {
    (void)unused;
    fixture f;
    paddle_with_comb(&f, FW_ELECTRODES_PLATE, 0.3e-3, 0.0); /* inside its own body */
    drawn d = draw(&f.device);
    const fw_layout_missing *m = only_missing(&d, &f.device, 131);
    if (!take_place(m->room, &comb.bx_m, &comb.by_m)) fail_msg("%s", m->room);
    nothing_missing(&f.device);
    fw_arena_free(d.arena);
}

static void no_insulation_has_no_room(void **unused) {
    (void)unused;
    fixture f;
    paddle_with_comb(&f, FW_ELECTRODES_COMB, 0.48e-3, 0.0);
    comb.body_a = 0;
    drawn d = draw(&f.device);
    const fw_layout_missing *m = only_missing(&d, &f.device, 131);
    assert_non_null(strstr(m->why, "nothing insulates"));
    assert_non_null(strstr(m->room, "none was found"));
    fw_arena_free(d.arena);
}

static void paddle_with_eyelet(fixture *f, int body, double x_m, double y_m) {
    fixture_paddle(f);
    f->device.die.tethers = false;
    eyelet = (fw_device_eyelet){.body = body, .x_m = x_m, .y_m = y_m, .place = {"test.xml", 9, 7}};
    tendon = (fw_device_tendon){
        .id = "t", .eyelet = &eyelet, .neyelet = 1, .pull_N = 1e-3, .draw_m = NONE};
    scene = (fw_device_scene){.name = "s", .tendon = &tendon, .ntendon = 1};
    f->device.scene = &scene;
    f->device.nscene = 1;
}

static void an_eyelet_names_a_place_that_has_room(void **unused) {
    (void)unused;
    static const struct {
        int body;
        double x_m, y_m;
    } wrong[] = {{0, 0.0, 1.2e-3}, {FW_GROUND, 0.7e-3, 2.5e-3}};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        fixture f;
        paddle_with_eyelet(&f, wrong[i].body, wrong[i].x_m, wrong[i].y_m);
        drawn d = draw(&f.device);
        const fw_layout_missing *m = only_missing(&d, &f.device, 131);
        assert_ptr_equal(m->eyelet, &eyelet);
        if (!take_place(m->room, &eyelet.x_m, &eyelet.y_m)) fail_msg("%s: %s", m->why, m->room);
        nothing_missing(&f.device);
        fw_arena_free(d.arena);
    }
}

/* electrodes of one flow's scenes are no matter of another flow; tethers are of all */
static void flows_lack_what_their_scenes_have(void **unused) {
    (void)unused;
    fixture f;
    paddle_with_comb(&f, FW_ELECTRODES_PLATE, 0.3e-3, 0.0);
    scene.flow = "dry";
    drawn d = draw(&f.device);
    const fw_layout_missing tethers = {.number = 127};
    assert_int_equal(d.layout->nmissing, 1);
    assert_true(fw_layout_missing_in_flow(&f.device, d.layout->missing, "dry"));
    assert_false(fw_layout_missing_in_flow(&f.device, d.layout->missing, "wet"));
    assert_true(fw_layout_missing_in_flow(&f.device, &tethers, "wet"));
    fw_arena_free(d.arena);
}

/* ---- tethers ---- */

static int pieces_named(const fw_layout *l, const char *label) {
    int n = 0;
    for (int i = 0; i < l->npiece; i++)
        n += strcmp(l->piece[i].label, label) == 0;
    return n;
}

static bool is_missing(const fw_layout *l, int number, const char *name) {
    for (int i = 0; i < l->nmissing; i++)
        if (l->missing[i].number == number && strcmp(l->missing[i].name, name) == 0) return true;
    return false;
}

/* a plate in a ring of another body: no straight finger goes through that */
static const char enclosed[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><material ref=\"silicon-100\" "
    "thickness=\"50 um\"/><flexure id=\"f\" kind=\"csfh\" radius=\"80 um\" angle=\"240 deg\" "
    "width=\"8 um\" gap=\"8 um\"/><mechanism>"
    "<body id=\"ring\" x=\"0 mm\" y=\"0 mm\">"
    "<bar x=\"0.4 mm\" y=\"0 mm\" to-x=\"0.4 mm\" to-y=\"1.3 mm\" width=\"80 um\"/>"
    "<bar x=\"0.4 mm\" y=\"1.3 mm\" to-x=\"2.8 mm\" to-y=\"1.3 mm\" width=\"80 um\"/>"
    "<bar x=\"2.8 mm\" y=\"1.3 mm\" to-x=\"2.8 mm\" to-y=\"-1.3 mm\" width=\"80 um\"/>"
    "<bar x=\"2.8 mm\" y=\"-1.3 mm\" to-x=\"0.4 mm\" to-y=\"-1.3 mm\" width=\"80 um\"/>"
    "<bar x=\"0.4 mm\" y=\"-1.3 mm\" to-x=\"0.4 mm\" to-y=\"%s mm\" width=\"80 um\"/></body>"
    "<body id=\"stage\" x=\"0.8 mm\" y=\"0 mm\"><plate x=\"0.7 mm\" width=\"1 mm\" height=\"0.9 "
    "mm\"/>"
    "</body><revolute id=\"A\" a=\"ground\" b=\"ring\" hinge=\"f\"/>"
    "<revolute id=\"B\" a=\"ring\" a-x=\"0.8 mm\" b=\"stage\" hinge=\"f\"/></mechanism>%s</device>";

static drawn draw_enclosed(const char *down_to, const char *rest, const fw_device **device) {
    drawn d = {.arena = fw_arena_new(0)};
    static char xml[8192];
    assert_non_null(d.arena);
    snprintf(xml, sizeof xml, enclosed, down_to, rest);
    d.diags = fw_diags_new(d.arena);
    fw_status status =
        fw_device_read(d.arena, "t.xml", xml, strlen(xml), NULL, 0, &d.diags, device);
    if (status == FW_OK) status = fw_layout_build(d.arena, *device, &d.diags, &d.layout);
    if (status != FW_OK || !d.layout->drawn)
        fail_msg("%s: %s", fw_status_text(status),
                 d.diags.count ? d.diags.item[0].message : d.layout->why_not);
    return d;
}

/* a plate on one hinge, and what else there is of it */
static const char plate[] =
    "<device xmlns=\"urn:flexwright:device:1\" name=\"d\"><material ref=\"silicon-100\" "
    "thickness=\"50 um\"/><flexure id=\"f\" kind=\"leaf\" length=\"300 um\" width=\"8 um\" "
    "gap=\"10 um\"/><mechanism>"
    "<body id=\"p\" x=\"0.1 mm\" y=\"1 mm\" plate-width=\"0.8 mm\" plate-height=\"0.6 mm\" "
    "plate-x=\"0 mm\" plate-y=\"0.8 mm\"/>"
    "<revolute id=\"A\" a=\"ground\" b=\"p\" b-x=\"-0.1 mm\" b-y=\"-1 mm\" hinge=\"f\"/>%s"
    "</mechanism></device>";

/* the first tether, with a spring at a place of the plate (mm, its frame at (0.1, 1)) */
static fw_geometry_vec2 first_cut(bool spring, double x, double y, double *nearest_m) {
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const fw_device *device;
    const fw_layout *layout;
    char xml[4096], rest[512] = "";
    snprintf(rest, sizeof rest,
             "<spring id=\"s\" a=\"p\" a-x=\"%.4f mm\" a-y=\"%.4f mm\" b=\"ground\" b-x=\"3 mm\" "
             "b-y=\"3 mm\" stiffness=\"1 N/m\"/>",
             x, y);
    snprintf(xml, sizeof xml, plate, spring ? rest : "");
    assert_int_equal(fw_device_read(arena, "t.xml", xml, strlen(xml), NULL, 0, &diags, &device),
                     FW_OK);
    assert_int_equal(fw_layout_build(arena, device, &diags, &layout), FW_OK);
    assert_true(layout->ntether > 0);
    *nearest_m = HUGE_VAL;
    for (int i = 0; i < layout->ntether; i++) {
        fw_geometry_vec2 cut = layout->tether[i].cut;
        *nearest_m = fmin(*nearest_m, hypot(cut.x - 1e-3 * (x + 0.1), cut.y - 1e-3 * (y + 1)));
    }
    fw_geometry_vec2 cut = layout->tether[0].cut;
    fw_arena_free(arena);
    return cut;
}

/* where a spring presses on the body there is no stub: the tether goes elsewhere; a spring that is not
   there moves none */
static void a_tether_keeps_from_where_its_body_acts(void **unused) {
    (void)unused;
    double nearest;
    fw_geometry_vec2 was = first_cut(false, 0, 0, &nearest);
    fw_geometry_vec2 away = first_cut(true, 0, -0.2, &nearest);
    assert_true(was.x == away.x && was.y == away.y);
    first_cut(true, 1e3 * was.x - 0.1, 1e3 * was.y - 1, &nearest);
    assert_true(nearest >= 50e-6);
}

static void an_enclosed_body_has_no_tether(void **unused) {
    (void)unused;
    const fw_device *device;
    drawn d = draw_enclosed("0", "", &device);
    const fw_layout_missing *m = only_missing(&d, device, 127);
    assert_string_equal(m->name, "the tethers of link stage");
    assert_non_null(strstr(m->why, "link ring"));
    /* the ring is 360 um from the left on; the finger keeps its room to either side */
    const char *at = strstr(m->room, "x = "), *aside = strstr(m->room, "link ring ");
    double x_um, by_um;
    assert_true(at && aside && strstr(aside, "farther aside"));
    assert_int_equal(sscanf(at + 4, "%lf", &x_um), 1);
    assert_int_equal(sscanf(aside + 10, "%lf", &by_um), 1);
    assert_near(by_um, ceil(x_um - 360 + 1e6 * (0.5 * fw_layout_rule.tether_m + fw_layout_rule.strip_clear_m)), 1e-9);
    assert_non_null(strstr(m->why, "from the lower side"));
    assert_int_equal(pieces_named(d.layout, "tether of link stage"), 0);
    fw_arena_free(d.arena);
    /* who says that it is to be without is taken at their word */
    d = draw_enclosed("0", "<die tethers=\"no\"/>", &device);
    assert_int_equal(d.layout->nmissing, 0);
    fw_arena_free(d.arena);
    /* half of a side open: there is a way in, though not at the middle */
    d = draw_enclosed("-0.9", "", &device);
    if (d.layout->nmissing > 0)
        fail_msg("%s: %s", d.layout->missing[0].why, d.layout->missing[0].room);
    assert_true(pieces_named(d.layout, "tether of link stage") > 0);
    fw_arena_free(d.arena);
}

static uint64_t state = 20261123;
static double lot(double low, double high) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(state >> 11) / 9007199254740992.0;
}

static void move_hinges(fixture *f, double by_m) {
    for (int j = 0; j < f->device.nrevolute; j++) {
        f->revolute[j].x_m += lot(-by_m, by_m);
        f->revolute[j].y_m += lot(-by_m, by_m);
    }
}

/* Devices moved at random: whatever is to be held has a tether or is said to lack it, and whatever
   moves the device is a piece or is said to be none. */
static void all_is_drawn_or_said(void **unused) {
    (void)unused;
    static void (*const make[])(fixture *) = {fixture_six_bar, fixture_four_bar, fixture_stage};
    static const int held[] = {2, 1, 6};
    const int cases = test_fewest(90, 18);
    int without = 0, whole = 0;
    for (int k = 0; k < cases; k++) {
        fixture f;
        char name[96], label[64];
        make[k % 3](&f);
        move_hinges(&f, 0.15e-3);
        const fw_device_body *b = &f.body[held[k % 3]];
        comb = (fw_device_comb){.id = "c",
                                .kind = k % 2 ? FW_ELECTRODES_COMB : FW_ELECTRODES_PLATE,
                                .body_a = FW_GROUND,
                                .body_b = held[k % 3],
                                .bx_m = lot(-0.5e-3, 0.5e-3),
                                .by_m = lot(-0.3e-3, 0.3e-3),
                                .direction_rad = 0.5 * M_PI * (int)lot(0, 4),
                                .fingers = 3,
                                .gap_m = 9e-6,
                                .overlap_m = 40e-6,
                                .length_m = 100e-6,
                                .width_m = 10e-6};
        scene = (fw_device_scene){.name = "s", .comb = &comb, .ncomb = 1};
        f.device.scene = &scene;
        f.device.nscene = k % 5 < 2;
        drawn d = {.arena = fw_arena_new(0)};
        d.diags = fw_diags_new(d.arena);
        if (fw_layout_build(d.arena, &f.device, &d.diags, &d.layout) == FW_OK) {
            snprintf(label, sizeof label, "tether of %s %s", b->platform ? "platform" : "link",
                     b->id);
            snprintf(name, sizeof name, "the tethers of %s", label + strlen("tether of "));
            assert_int_equal(pieces_named(d.layout, label) == 0, is_missing(d.layout, 127, name));
            if (f.device.nscene > 0)
                assert_int_equal(pieces_named(d.layout, "stator of comb drive c") == 0,
                                 is_missing(d.layout, 131, "comb drive c"));
            *(d.layout->nmissing > 0 ? &without : &whole) += 1;
        }
        fw_arena_free(d.arena);
    }
    if (9 * without < cases || 9 * whole < cases) fail_msg("%d without, %d whole", without, whole);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_comb_names_a_place_that_has_room),
        cmocka_unit_test(too_many_fingers_are_fewer),
        cmocka_unit_test(as_many_fingers_as_there_is_room_for),
        cmocka_unit_test(short_fingers_are_longer),
        cmocka_unit_test(narrow_fingers_are_wider),
        cmocka_unit_test(wide_fingers_are_not_told_to_be_wide),
        cmocka_unit_test(narrow_fingers_without_room_get_both),
        cmocka_unit_test(unstated_width_is_the_default),
        cmocka_unit_test(a_plate_names_a_place_that_has_room),
        cmocka_unit_test(no_insulation_has_no_room),
        cmocka_unit_test(an_eyelet_names_a_place_that_has_room),
        cmocka_unit_test(flows_lack_what_their_scenes_have),
        cmocka_unit_test(a_tether_keeps_from_where_its_body_acts),
        cmocka_unit_test(an_enclosed_body_has_no_tether),
        cmocka_unit_test(all_is_drawn_or_said),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
