/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is read of flexures that are paths or vary in width. Mistakes are in tests/bad. */
#include "files.h"

static const double pi = 3.14159265358979323846;

#define FLEXURE(text) DEVICE("<parameter name=\"t\" value=\"8 um\"/><material ref=\"m\"/>" text ARM)

/* widths go on from piece to piece; the middle is half way unless it is given; the least width is
   the flexure's, also where the edges are closest between the stated places */
static void pieces_in_their_order(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_device *d =
        sound(arena,
              FLEXURE("<flexure id=\"A\" kind=\"path\" width=\"t\" gap=\"6 um\" fillet=\"3 um\">"
                      "<line length=\"100 um\" width-end=\"t - 1 um\"/>"
                      "<arc radius=\"60 um\" angle=\"90 deg\" width-middle=\"9 um\"/>"
                      "<arc radius=\"70 um\" angle=\"-45 deg\" width=\"7 um\" width-end=\"6 um\"/>"
                      "<line length=\"50 um\"/></flexure>"
                      "<flexure id=\"B\" kind=\"leaf\" length=\"300 um\" width=\"12 um\"/>"),
              NULL, 0);
    assert_int_equal(d->nflexure, 2);
    const fw_device_flexure *f = d->flexure;
    assert_int_equal(f->kind, FW_FLEXURE_PATH);
    assert_int_equal(f->npiece, 4);
    static const double width[4][3] = {{8, 7.5, 7}, {7, 9, 7}, {7, 6.5, 6}, {6, 6, 6}};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++)
            assert_relative(f->piece[i].width_m[k], 1e-6 * width[i][k], 1e-12);
    assert_near(f->piece[0].curvature_per_m, 0, 0);
    assert_relative(f->piece[1].curvature_per_m, 1 / 60e-6, 1e-12);
    assert_relative(f->piece[2].curvature_per_m, -1 / 70e-6, 1e-12);
    assert_relative(f->piece[2].length_m, 70e-6 * pi / 4, 1e-12);
    assert_relative(f->length_m, 150e-6 + 30e-6 * pi + 17.5e-6 * pi, 1e-12);
    assert_relative(f->angle_rad, pi / 4, 1e-12);
    assert_relative(f->width_m, 6e-6, 1e-12);
    assert_relative(f->gap_m, 6e-6, 1e-12);
    assert_relative(f->fillet_m, 3e-6, 1e-12);
    assert_true(fw_device_flexure_varies(f) && !fw_device_flexure_varies(f + 1));
    fw_geometry_strip_piece piece[FW_STRIP_MOST];
    assert_int_equal(fw_device_flexure_pieces(f, piece), 4);
    assert_memory_equal(piece, f->piece, 4 * sizeof *piece);
    fw_arena_free(arena);
}

static void middle_of_arcs_and_leaves(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    static const char *const xml =
        FLEXURE("<flexure id=\"A\" kind=\"csfh\" radius=\"100 um\" angle=\"200 deg\" width=\"t\" "
                "width-middle=\"12 um\"/><flexure id=\"B\" kind=\"leaf\" length=\"300 um\" "
                "width=\"12 um\" width-middle=\"t\"/><flexure id=\"C\" kind=\"leaf\" "
                "length=\"300 um\" width=\"8 um\" width-middle=\"t\"/>");
    const fw_device_set set = {"flexure[A]/@width-middle", "11 um"};
    const fw_device *d = sound(arena, xml, NULL, 0), *e = sound(arena, xml, &set, 1);
    assert_relative(d->flexure[0].width_middle_m, 12e-6, 1e-12);
    assert_relative(e->flexure[0].width_middle_m, 11e-6, 1e-12);
    assert_relative(fw_device_flexure_narrowest_m(&d->flexure[0]), 8e-6, 1e-12);
    assert_relative(fw_device_flexure_narrowest_m(&d->flexure[1]), 8e-6, 1e-12);
    assert_true(fw_device_flexure_varies(&d->flexure[0]) &&
                fw_device_flexure_varies(&d->flexure[1]));
    assert_false(fw_device_flexure_varies(&d->flexure[2])); /* stated, but no other */
    fw_geometry_strip_piece piece[FW_STRIP_MOST];
    assert_int_equal(fw_device_flexure_pieces(&d->flexure[0], piece), 1);
    assert_relative(piece[0].curvature_per_m, 1e4, 1e-12);
    assert_relative(piece[0].length_m, 1e-4 * 200 * pi / 180, 1e-12);
    assert_relative(piece[0].width_m[1], 12e-6, 1e-12);
    fw_arena_free(arena);
}

/* what is wrong with one piece does not hide what is wrong with another */
static void all_mistakes_at_once(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const fw_device *d;
    static const char *const xml =
        FLEXURE("<flexure id=\"A\" kind=\"path\" width=\"t\" angle=\"3 deg\">"
                "<arc radius=\"60 um\" angle=\"0 deg\"/><line length=\"9 m\"/>"
                "<line length=\"50 um\" width=\"9 um\"/><line length=\"50 um\" width=\"10 um\"/>"
                "</flexure>");
    assert_int_equal(fw_device_read(arena, "t.xml", xml, strlen(xml), NULL, 0, &diags, &d),
                     FW_INPUT);
    static const int want[] = {262, 262, 47, 263};
    assert_int_equal(diags.errors, 4);
    for (int i = 0; i < 4; i++) {
        int found = 0;
        for (size_t k = 0; k < diags.count; k++)
            found += diags.item[k].number == want[i];
        assert_int_equal(found, i < 2 ? 2 : 1);
    }
    fw_arena_free(arena);
}

/* edges that are no arcs any more leave no width to name */
static void a_width_that_vanishes_is_no_number(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const fw_device *d;
    static const char *const xml =
        FLEXURE("<flexure id=\"A\" kind=\"path\" width=\"112 um\">"
                "<line length=\"104 um\" width-middle=\"8 um\"/></flexure>");
    assert_int_equal(fw_device_read(arena, "t.xml", xml, strlen(xml), NULL, 0, &diags, &d),
                     FW_INPUT);
    int found = 0;
    for (size_t k = 0; k < diags.count; k++) {
        assert_null(strstr(diags.item[k].message, "nan"));
        found += strstr(diags.item[k].message, "the width vanishes (") != NULL;
    }
    assert_int_equal(found, 1);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_in_their_order),
        cmocka_unit_test(middle_of_arcs_and_leaves),
        cmocka_unit_test(all_mistakes_at_once),
        cmocka_unit_test(a_width_that_vanishes_is_no_number),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
