/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a reader sees of effects: ledger and pull-in in the page and in the terminal, actuators in
   the drawing and in the preview. */
#include "test.h"
#include "report/fixture.h"
#include "report/report.h"
#include "report/report_page.h"
#include <cairo.h>

typedef struct whole { /* with fewer allocations than matter */
    fw_arena *arena;
    fixture *f;
} whole;

static whole whole_new(void) {
    fw_arena *arena = fw_arena_new(0);
    return (whole){arena, fixture_new(arena, 0.3)};
}

static char *page_of(const whole *w) {
    fw_text out = fw_text_new(w->arena);
    assert_int_equal(fw_report_write_html(w->arena, &w->f->input, &out), FW_OK);
    return out.data;
}

static int times(const char *text, const char *what) {
    int n = 0;
    for (const char *at = text; (at = strstr(at, what)); at += strlen(what))
        n++;
    return n;
}

/* `first` stands before `second` in the text */
static void assert_order(const char *text, const char *first, const char *second) {
    const char *a = strstr(text, first), *b = a ? strstr(a, second) : NULL;
    if (!b) fail_msg("%s does not stand before %s", first, second);
}

static fw_dynamics_motion *motion_of(const whole *w) {
    return (fw_dynamics_motion *)(uintptr_t)w->f->variant_verdict[0].motion[0];
}

static void ledger_on_the_page(void **state) {
    (void)state;
    whole w = whole_new();
    fw_effect_ledger *l = &motion_of(&w)->ledger;
    l->item[2].active = false, l->left_out = 2.5e-4;
    fw_effect_entry swap = l->item[0]; /* what is not called for comes first in the ledger */
    l->item[0] = l->item[3], l->item[3] = swap;
    w.f->verdict.accuracy_wanted = 1e-3;
    const char *section = strstr(page_of(&w), "Ledger of effects");
    assert_non_null(section);
    assert_order(section, ">applied-load<", "Not called for: gravity");
    assert_order(section, ">joint-damping</th><td>left out<", "Not called for: gravity");
    assert_order(section, "left out: 0.025\u00a0%", "accuracy wanted: 0.10\u00a0%");
    assert_null(strstr(section, "<th scope=\"row\" class=\"id\">gravity"));
    assert_null(strstr(section, "Pull-in")); /* no comb drive */
    fw_arena_free(w.arena);
}

static void pull_in_on_the_page(void **state) {
    (void)state;
    whole w = whole_new();
    static const fw_statics_pull_in beyond = {.kind = FW_PULL_IN_SIDE,
                                              .comb = "right<",
                                              .voltage_V = 31.25,
                                              .largest_V = 40,
                                              .margin = 0.78125,
                                              .fringe = 0.16,
                                              .fingers_V = HUGE_VAL},
                                    never = {.kind = FW_PULL_IN_NONE,
                                             .comb = "left",
                                             .voltage_V = HUGE_VAL,
                                             .largest_V = 5,
                                             .margin = HUGE_VAL,
                                             .why = "nothing moves"};
    static const fw_statics_pull_in *list[2] = {&beyond, &never};
    w.f->variant_verdict[0].pull_in = list;
    const char *section = strstr(page_of(&w), "Pull-in");
    assert_non_null(section);
    assert_order(section, "class=\"bad\"><th scope=\"row\">step-load", "right&lt;");
    assert_order(section, "31.25", "side: moves aside between the fingers");
    assert_order(section, ">40", "0.781");
    assert_order(section, "gentle-step", "none found (nothing moves)");
    fw_text out = fw_text_new(w.arena);
    const fw_report_terminal_style style = {0};
    assert_int_equal(fw_report_verdict_text(&w.f->input, style, &out), FW_OK);
    assert_non_null(strstr(out.data, "comb drive right< at 31.25 V (at least 29.01 V; side); "
                                     "the scene asks for up to 40 V"));
    assert_int_equal(times(out.data, "pull-in in"), 1);
    fw_arena_free(w.arena);
}

static void ledger_in_the_terminal(void **state) {
    (void)state;
    whole w = whole_new();
    fw_dynamics_motion *motion = motion_of(&w);
    motion->stabilise = "projection";
    fw_text out = fw_text_new(w.arena);
    assert_int_equal(
        fw_report_simulate_text(&w.f->device.scene[0], &w.f->mechanism[0], motion, &out), FW_OK);
    assert_order(out.data, "\n  applied-load       yes", "\n  not called for: gravity\n");
    assert_null(strstr(out.data, "the scene has no <gravity>"));
    fw_arena_free(w.arena);
}

/* a cable from the platform over the frame, a comb and a plate on it */
static void actuate(whole *w) {
    static fw_device_eyelet eyelet[3] = {{.body = 2, .x_m = 0.4e-3},
                                         {.body = FW_GROUND, .x_m = 3.5e-3, .y_m = 3.6e-3},
                                         {.body = FW_GROUND, .x_m = 3.5e-3, .y_m = 4.6e-3}};
    static fw_device_tendon tendon[2];
    static fw_device_comb comb[2];
    tendon[0] = (fw_device_tendon){.id = "cable&1", .eyelet = eyelet, .neyelet = 3};
    comb[0] = (fw_device_comb){.id = "teeth",
                               .body_a = FW_GROUND,
                               .body_b = 2,
                               .fingers = 30,
                               .gap_m = 5e-6,
                               .overlap_m = 20e-6,
                               .length_m = (double)NAN};
    comb[1] = (fw_device_comb){.id = "faces",
                               .kind = FW_ELECTRODES_PLATE,
                               .body_a = FW_GROUND,
                               .body_b = 0,
                               .gap_m = 5e-6,
                               .length_m = 200e-6,
                               .direction_rad = 2};
    for (int s = 0; s < 2; s++) { /* both scenes have the same */
        w->f->device.scene[s].tendon = tendon, w->f->device.scene[s].ntendon = 1;
        w->f->device.scene[s].comb = comb, w->f->device.scene[s].ncomb = 2;
    }
}

static void actuators_are_drawn(void **state) {
    (void)state;
    whole w = whole_new(), bare = whole_new();
    actuate(&w);
    fw_text out = fw_text_new(w.arena), without = fw_text_new(w.arena);
    assert_int_equal(fw_report_device_svg(w.arena, &w.f->device, &w.f->layout, &w.f->verdict, &out),
                     FW_OK);
    assert_int_equal(
        fw_report_device_svg(w.arena, &bare.f->device, &bare.f->layout, &bare.f->verdict, &without),
        FW_OK);
    assert_int_equal(times(out.data, "stroke-dasharray=\"6 3\""), 2); /* two parts of one cable */
    assert_int_equal(times(out.data, ">cable&amp;1<"), 1);
    assert_int_equal(times(out.data, ">teeth<"), 1);
    assert_int_equal(times(out.data, ">faces<"), 1);
    /* rotor: root and 12 fingers, a plate; a dot and an arrow head of the cable */
    assert_int_equal(times(out.data, "Z\" fill=\"#7b3294\""), 13 + 1 + 1);
    assert_int_equal(times(out.data, "Z\" fill=\"#ffffff\""), 14 + 1); /* stator: one finger more */
    assert_null(strstr(without.data, "#7b3294"));

    fw_text picture = fw_text_new(w.arena), plain = fw_text_new(w.arena);
    assert_int_equal(
        fw_report_device_png(w.arena, &w.f->device, &w.f->layout, &w.f->verdict, 320, &picture),
        FW_OK);
    w.f->device.scene[0].ncomb = w.f->device.scene[1].ncomb = 0; /* the same view, without combs */
    assert_int_equal(
        fw_report_device_png(w.arena, &w.f->device, &w.f->layout, &w.f->verdict, 320, &plain),
        FW_OK);
    assert_true(picture.length != plain.length ||
                memcmp(picture.data, plain.data, plain.length) != 0);
    fw_arena_free(w.arena);
    fw_arena_free(bare.arena);
}

/* ---- the preview ---- */

typedef struct reading {
    const fw_text *from;
    size_t at;
} reading;

static cairo_status_t next_bytes(void *closure, unsigned char *to, unsigned int length) {
    reading *r = closure;
    if (r->at + length > r->from->length) return CAIRO_STATUS_READ_ERROR;
    memcpy(to, r->from->data + r->at, length);
    r->at += length;
    return CAIRO_STATUS_SUCCESS;
}

enum { ACROSS = 16, COLOURS = 3 };

/* mean of each colour, 0 to 255, in ACROSS x ACROSS parts of a preview of so many pixels */
static void preview(const whole *w, const fw_layout *layout, int width_px,
                    double mean[ACROSS * ACROSS][COLOURS]) {
    fw_text png = fw_text_new(w->arena);
    assert_int_equal(
        fw_report_device_png(w->arena, &w->f->device, layout, &w->f->verdict, width_px, &png),
        FW_OK);
    reading r = {&png, 0};
    cairo_surface_t *s = cairo_image_surface_create_from_png_stream(next_bytes, &r);
    assert_int_equal(cairo_surface_status(s), CAIRO_STATUS_SUCCESS);
    const int wide = cairo_image_surface_get_width(s), high = cairo_image_surface_get_height(s);
    const unsigned char *data = cairo_image_surface_get_data(s);
    double n[ACROSS * ACROSS] = {0};
    assert_int_equal(wide, width_px);
    memset(mean, 0, ACROSS * ACROSS * sizeof *mean);
    for (int y = 0; y < high; y++)
        for (int x = 0; x < wide; x++) {
            int part = y * ACROSS / high * ACROSS + x * ACROSS / wide;
            n[part]++;
            for (int c = 0; c < COLOURS; c++) /* blue, green, red, nothing */
                mean[part][c] += data[(size_t)y * (size_t)cairo_image_surface_get_stride(s) +
                                      4 * (size_t)x + (size_t)c];
        }
    for (int i = 0; i < ACROSS * ACROSS; i++)
        for (int c = 0; c < COLOURS; c++)
            mean[i][c] /= n[i];
    cairo_surface_destroy(s);
}

/* Twice as many pixels show the same picture: lines, dots and marks are as wide for its width. With shapes and faults, and as
   sticks; every part of it, where a line of another width would be another share of ink. */
static void previews_of_any_size_are_alike(void **state) {
    (void)state;
    whole w = whole_new();
    actuate(&w);
    fw_layout_fault fault = {.number = 120,
                             .message = "too near",
                             .body = {2},
                             .nbody = 1,
                             .joint = {1, 4},
                             .njoint = 2,
                             .at = {1e-3, 1e-3}};
    w.f->layout.fault = &fault;
    w.f->layout.nfault = 1;
    for (int k = 0; k < 2; k++) {
        double one[ACROSS * ACROSS][COLOURS], two[ACROSS * ACROSS][COLOURS];
        const fw_layout *layout = k ? NULL : &w.f->layout;
        preview(&w, layout, 640, one);
        preview(&w, layout, 1280, two);
        for (int i = 0; i < ACROSS * ACROSS; i++)
            for (int c = 0; c < COLOURS; c++)
                assert_near(one[i][c], two[i][c], 1.5);
    }
    fw_arena_free(w.arena);
}

/* the outline of a part that is wrong is 2 px wide at 640 px, as in the drawing: so many pixels change by it */
static void a_mark_is_as_wide_as_drawn(void **state) {
    (void)state;
    enum { PX = 1280 };
    whole w = whole_new();
    fw_layout_fault fault = {
        .number = 120, .message = "too near", .body = {2}, .nbody = 1, .at = {1e-3, 1e-3}};
    const fw_report_view view = fw_report_device_view(&w.f->device, &w.f->layout, NULL, PX);
    cairo_surface_t *s[2];
    for (int k = 0; k < 2; k++) {
        w.f->layout.fault = &fault;
        w.f->layout.nfault = k;
        fw_text png = fw_text_new(w.arena);
        assert_int_equal(
            fw_report_device_png(w.arena, &w.f->device, &w.f->layout, &w.f->verdict, PX, &png),
            FW_OK);
        reading r = {&png, 0};
        s[k] = cairo_image_surface_create_from_png_stream(next_bytes, &r);
        assert_int_equal(cairo_surface_status(s[k]), CAIRO_STATUS_SUCCESS);
    }
    double changed = 0, length = 0;
    const int n = PX * cairo_image_surface_get_height(s[0]);
    for (int i = 0; i < n; i++)
        changed += memcmp(cairo_image_surface_get_data(s[0]) + 4 * i,
                          cairo_image_surface_get_data(s[1]) + 4 * i, 3) != 0;
    for (int i = 0; i < w.f->layout.npiece; i++)
        if (w.f->layout.piece[i].body == 2)
            length += fw_geometry_contour_perimeter(&w.f->layout.piece[i].contour) * view.scale;
    assert_near(changed / length, 4 + 0.7,
                0.7); /* some pixels on either side are covered in part */
    cairo_surface_destroy(s[0]);
    cairo_surface_destroy(s[1]);
    fw_arena_free(w.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ledger_on_the_page),
        cmocka_unit_test(pull_in_on_the_page),
        cmocka_unit_test(ledger_in_the_terminal),
        cmocka_unit_test(actuators_are_drawn),
        cmocka_unit_test(previews_of_any_size_are_alike),
        cmocka_unit_test(a_mark_is_as_wide_as_drawn),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
