/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "test.h"
#include "base/svg.h"
#include <math.h>

static fw_arena *arena;

static int make(void **state) {
    (void)state;
    arena = fw_arena_new(0);
    return arena == NULL;
}

static int drop(void **state) {
    (void)state;
    fw_arena_free(arena);
    return 0;
}

static void elements_are_templates(void **state) {
    (void)state;
    fw_text out = fw_text_new(arena);
    fw_svg_put(&out, "circle cx='{c}' cy='{3}' r='3'", 1.005, -2.0);
    fw_svg_put(&out, "text x='{i}'>it's {s}\n", 4, "<a>");
    fw_svg_open(&out, "g class='a b'\n");
    fw_svg_put(&out, "path");
    fw_svg_put(&out, "tspan class='readout'>");
    fw_svg_close(&out, "g\n");
    assert_string_equal(out.data, "<circle cx=\"1\" cy=\"-2\" r=\"3\"/><text x=\"4\">it's "
                                  "&lt;a&gt;</text>\n<g class=\"a b\">\n<path/><tspan "
                                  "class=\"readout\"></tspan></g>\n");
}

static void paths_follow_in_pieces(void **state) {
    (void)state;
    fw_text out = fw_text_new(arena);
    fw_svg_path(&out, "fill='{r}'", "none");
    fw_text_add(&out, "M0 0L1 0.5 2 1");
    fw_svg_path_end(&out);
    fw_svg_path(&out, "");
    fw_svg_point(&out, 'M', 0.12345, -1.0, 4);
    fw_svg_more(&out, "stroke='{r}' stroke-dasharray='6 3'", "red");
    fw_svg_finish(&out, ">");
    fw_svg_animate_path(&out, 8);
    fw_text_add(&out, "M0 0;M1 1");
    fw_svg_finish(&out, "/>");
    fw_svg_close(&out, "path\n");
    assert_string_equal(out.data,
                        "<path fill=\"none\" d=\"M0 0L1 0.5 2 1\"/>\n"
                        "<path d=\"M0.1235 -1\" stroke=\"red\" stroke-dasharray=\"6 3\">"
                        "<animate attributeName=\"d\" dur=\"8s\" repeatCount=\"indefinite\" "
                        "values=\"M0 0;M1 1\"/></path>\n");
}

static void documents_have_a_frame(void **state) {
    (void)state;
    fw_text out = fw_text_new(arena);
    fw_svg_begin(&out, &(fw_svg_frame){.width = 2000,
                                       .height = 1000.5,
                                       .decimals = 6,
                                       .size = FW_SVG_SIZE_BEFORE,
                                       .unit_mm = 1e-3,
                                       .mm_decimals = 9,
                                       .file = true,
                                       .links = true,
                                       .lead = "version='1.1'"});
    fw_svg_title(&out, "{s}: masks", "a & b");
    fw_svg_paper(&out, "#fff");
    fw_svg_end(&out);
    assert_string_equal(
        out.data, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg "
                  "xmlns=\"http://www.w3.org/2000/svg\" "
                  "xmlns:xlink=\"http://www.w3.org/1999/xlink\" version=\"1.1\" width=\"2mm\" "
                  "height=\"1.0005mm\" viewBox=\"0 0 2000 1000.5\">\n<title>a &amp; b: "
                  "masks</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n"
                  "</svg>\n");
}

static void a_picture_of_a_page_has_a_font(void **state) {
    (void)state;
    fw_text out = fw_text_new(arena);
    fw_svg_begin(&out, &(fw_svg_frame){.width = 310,
                                       .height = 20,
                                       .size = FW_SVG_SIZE_BEHIND,
                                       .trail = "role='img'",
                                       .font = fw_svg_font_step,
                                       .font_size = 10});
    fw_svg_inset(&out, "y='{i}'", 3);
    assert_string_equal(out.data,
                        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 310 20\" "
                        "width=\"310\" height=\"20\" role=\"img\" "
                        "font-family=\"Helvetica, Arial, sans-serif\" font-size=\"10\">\n"
                        "<svg y=\"3\">\n");
}

static void ticks_have_the_digits_of_their_step(void **state) {
    (void)state;
    static const struct {
        double value, step;
        const char *text;
    } row[] = {{0.3, 0.1, "0.3"}, {-0.05, 0.05, "\u22120.05"},
               {20.0, 5.0, "20"}, {-1e-18, 0.2, "0"},
               {1.0, 0.5, "1"},   {-400.0, 200.0, "\u2212400"}};
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        fw_text out = fw_text_new(arena);
        fw_svg_tick(&out, row[i].value, row[i].step);
        assert_string_equal(out.data, row[i].text);
    }
}

static void grids_stay_in_the_plot(void **state) {
    (void)state;
    fw_text out = fw_text_new(arena);
    const fw_svg_axes axes = {10, 110, 5, 55, 0, 1, -1, 1, 2, 2};
    assert_true(fw_svg_axes_x(&axes, 0.5) == 60 && fw_svg_axes_y(&axes, -1) == 55);
    fw_svg_grid(&out, &axes);
    int lines = 0, zero = 0;
    for (const char *c = out.data; (c = strstr(c, "<path")); c++)
        lines++;
    for (const char *c = out.data; (c = strstr(c, "#8c959f")); c++)
        zero++;
    assert_int_equal(lines, 6);
    assert_int_equal(zero, 2);
}

/* of numbers that differ in their last bits: the next multiple of a step is the same number */
static void grids_of_hardly_any_range_end(void **state) {
    (void)state;
    const double one = nextafter(0.62, 1);
    fw_text out = fw_text_new(arena);
    const fw_svg_axes axes = {10, 110, 5, 55, 0.62, one, 1e9, nextafter(1e9, 2e9), 6, 6};
    fw_svg_grid(&out, &axes);
    assert_int_equal(fw_text_end(&out), FW_OK);
    int lines = 0;
    for (const char *c = out.data; (c = strstr(c, "<path")); c++)
        lines++;
    assert_true(lines <= 14);
    const fw_svg_axes none = {10, 110, 5, 55, 0, 1, 0, 1, 0, 0};
    out = fw_text_new(arena);
    fw_text_add(&out, "");
    fw_svg_grid(&out, &none);
    assert_true(fw_text_end(&out) == FW_OK && out.length == 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elements_are_templates),
        cmocka_unit_test(paths_follow_in_pieces),
        cmocka_unit_test(documents_have_a_frame),
        cmocka_unit_test(a_picture_of_a_page_has_a_font),
        cmocka_unit_test(ticks_have_the_digits_of_their_step),
        cmocka_unit_test(grids_stay_in_the_plot),
        cmocka_unit_test(grids_of_hardly_any_range_end),
    };
    return cmocka_run_group_tests(tests, make, drop);
}
