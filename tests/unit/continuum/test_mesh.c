/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The lattice is valid, closed, has the volume of the exact outline; the deck says what the mesh
   is, twice the same. No solver needed. */
#include "continuum/solver.h"
#include "shapes.h"
#include "test.h"
#include <stdlib.h>

static int open_arena(void **state) {
    return (*state = fw_arena_new(0)) ? 0 : -1;
}

static int close_arena(void **state) {
    fw_arena_free(*state);
    return 0;
}

/* area between edge circle R, face of the root and fillet, from triangle and sectors */
static double fillet_area(double R, double rho, bool inner) {
    double q = inner ? R - rho : R + rho, g = asin(rho / q), face = sqrt(q * q - rho * rho);
    double sign = inner ? -1 : 1;
    return sign * (0.5 * face * rho - 0.5 * R * R * g) - 0.5 * rho * rho * (M_PI / 2 - sign * g);
}

/* strip and blocks by Pappus, fillets by sectors */
static double area_of(const fw_continuum_shape *s) {
    double k = s->piece[0].curvature_per_m, t = s->width_m, area = s->piece[0].length_m * t;
    if (s->root == FW_ROOT_RIGID) return area;
    area += 4 * s->block_half_m * s->block_length_m;
    double one = s->fillet_m * s->fillet_m * (1 - M_PI / 4);
    if (k == 0) return area + 4 * one;
    return area + 2 * (fillet_area(1 / k - t / 2, s->fillet_m, true) +
                       fillet_area(1 / k + t / 2, s->fillet_m, false));
}

static void build(fw_arena *arena, const fw_continuum_shape *shape, double refinement,
                  fw_continuum_mesh *mesh) {
    const char *why = "";
    if (fw_continuum_mesh_build(arena, shape, refinement, false, mesh, &why) != FW_OK)
        fail_msg("%s", why);
}

/* a slice in plane stress is a twentieth of the width deep; where a block's sides are free its end is held from the line of nodes on that is
   nearest to 0.28 of the width from either side, else all of it */
static void depth_and_corner(void **state) {
    for (int which = 1; which <= 4; which++)
        for (int sides_free = 0; sides_free < 2; sides_free++)
            for (int root = 0; root < 2; root++) {
                fw_continuum_shape shape = shape_of(which, (fw_continuum_root)root);
                fw_continuum_mesh mesh, slice;
                const char *why = "";
                shape.sides_free = sides_free;
                build(*state, &shape, 1, &mesh);
                assert_relative(mesh.depth_m, shape.depth_m, 1e-12);
                if (fw_continuum_mesh_build(*state, &shape, 1, true, &slice, &why) != FW_OK) fail_msg("%s", why);
                assert_relative(slice.depth_m, 0.05 * shape.width_m, 1e-12);
                if (!mesh.quiet || !sides_free || (fw_continuum_root)root == FW_ROOT_RIGID) {
                    assert_int_equal(mesh.corner, 0);
                    continue;
                }
                double far[200]; /* of lines of nodes from 0.28 of the strip's width, in its middle */
                int best = 1, across = 2 * mesh.nj + 1;
                for (int j = 1; 2 * j < mesh.nj; j++) {
                    size_t at = (size_t)mesh.ni * (size_t)across, n = at + (size_t)(2 * j);
                    far[j] = fabs(hypot(mesh.x[n] - mesh.x[at], mesh.y[n] - mesh.y[at]) / shape.width_m - 0.28);
                    if (far[j] < far[best]) best = j;
                }
                assert_int_equal(mesh.corner, best);
            }
}

/* volume by quadrature over the bricks against the outline's area; the error of quadratic edges on
   arcs falls with the fourth power of their length */
static void volume(void **state) {
    for (int which = 1; which <= 4; which++)
        for (int root = 0; root < 2; root++) {
            fw_continuum_shape shape = shape_of(which, (fw_continuum_root)root);
            const char *why;
            fw_geometry_contour outline;
            assert_int_equal(fw_continuum_outline(*state, &shape, &outline, &why), FW_OK);
            double exact = fw_geometry_contour_area(&outline), error[2];
            assert_relative(exact, area_of(&shape), 1e-12);
            for (int n = 0; n < 2; n++) {
                fw_continuum_mesh mesh;
                build(*state, &shape, 1 << n, &mesh);
                fw_continuum_quality q = fw_continuum_mesh_quality(&mesh);
                assert_true(q.least_jacobian > 0.05);
                error[n] = fabs(q.volume_m3 / (0.5 * shape.depth_m * exact) - 1);
            }
            assert_true(error[0] < 1e-4 && error[1] < 1e-5);
            if (error[0] > 1e-10) assert_true(error[1] < 0.2 * error[0]);
        }
}

/* fillets from a twentieth of the width to the width, thick and thin arcs, every refinement */
static void valid_everywhere(void **state) {
    static const double share[5] = {0.05, 0.125, 0.25, 0.5, 1};
    for (int which = 1; which <= 4; which++)
        for (int n = 0; n < 5; n++)
            for (int wide = 0; wide < 2; wide++)
                for (int level = 0; level < test_fewest(3, 2); level++) {
                    fw_mark mark = fw_arena_mark(*state);
                    fw_flexure_input in = flexure_of(which);
                    fw_continuum_shape shape;
                    fw_continuum_mesh mesh;
                    if (wide) in.width_m *= 2;
                    in.fillet_m = share[n] * in.width_m;
                    fw_continuum_shape_of(&in, &shape);
                    build(*state, &shape, 0.5 * (1 << level), &mesh);
                    double least = fw_continuum_mesh_quality(&mesh).least_jacobian;
                    if (!(least > 0.04))
                        fail_msg("H%d fillet %g level %d: %g", which, share[n], level, least);
                    fw_arena_rewind(*state, mark);
                }
}

/* lines and arcs in turn, both ends curved differently: an S */
static void general_centre_line(void **state) {
    fw_continuum_shape shape = {
        .npiece = 4,
        .piece = {{60e-6, 1 / 80e-6}, {50e-6, 0}, {90e-6, -1 / 50e-6}, {70e-6, 0}},
        .x_m = 3e-6,
        .y_m = -5e-6,
        .direction_rad = 0.7,
        .width_m = 6e-6,
        .fillet_m = 3e-6,
        .depth_m = 20e-6,
        .block_half_m = 30e-6,
        .block_length_m = 40e-6};
    fw_geometry_contour outline;
    const char *why = "";
    if (fw_continuum_outline(*state, &shape, &outline, &why) != FW_OK) fail_msg("%s", why);
    double one = shape.fillet_m * shape.fillet_m * (1 - M_PI / 4), R = 80e-6;
    double area = 270e-6 * 6e-6 + 4 * 30e-6 * 40e-6 + 2 * one + fillet_area(R - 3e-6, 3e-6, true) +
                  fillet_area(R + 3e-6, 3e-6, false);
    assert_relative(fw_geometry_contour_area(&outline), area, 1e-12);
    fw_continuum_mesh mesh;
    build(*state, &shape, 1, &mesh);
    fw_continuum_quality q = fw_continuum_mesh_quality(&mesh);
    assert_true(q.least_jacobian > 0.05);
    assert_relative(q.volume_m3, 0.5 * 20e-6 * area, 1e-4);
}

/* every node of the edges of strip and fillets lies on its line or circle */
static void edges_are_exact(void **state) {
    fw_continuum_shape shape = shape_of(1, FW_ROOT_BLOCK);
    fw_continuum_mesh mesh;
    build(*state, &shape, 1, &mesh);
    double ri = 96e-6, ro = 104e-6, a = 135 * M_PI / 180, rho = 4e-6;
    int on_strip = 0, on_fillet = 0, across = 2 * mesh.nj + 1;
    for (int i = 2 * mesh.quiet; i <= 2 * (mesh.ni - mesh.quiet); i++)
        for (int side = 0; side < 2; side++) {
            size_t at = (size_t)(i * across + (side ? across - 1 : 0));
            double x = mesh.x[at], y = mesh.y[at], R = side ? ri : ro, q = side ? R - rho : R + rho;
            double turn = a - asin(rho / q);
            double fillet = hypot(x - q * cos(turn), fabs(y) - q * sin(turn));
            if (fabs(atan2(y, x)) < turn - 1e-9) {
                assert_near(hypot(x, y), R, 1e-15);
                on_strip++;
            } else {
                assert_near(fillet, rho, 1e-15);
                on_fillet++;
            }
        }
    assert_true(on_strip > 40 && on_fillet > 30);
}

/* the faces of bricks meet in pairs or lie on the boundary, whose faces are as many as a box's; no
   two nodes have one place */
static int by_place(const void *a, const void *b) {
    return memcmp(a, b, 3 * sizeof(double));
}

static void no_gaps(void **state) {
    fw_continuum_shape shape = shape_of(3, FW_ROOT_BLOCK);
    fw_continuum_mesh mesh;
    build(*state, &shape, 0.5, &mesh);
    double(*place)[3] = fw_arena_alloc(*state, (size_t)mesh.nnode, sizeof *place);
    int n = 0, next = 0;
    for (int i = 0; i <= 2 * mesh.ni; i++)
        for (int j = 0; j <= 2 * mesh.nj; j++)
            for (int k = 0; k <= 2 * mesh.nk; k++) {
                int number = mesh.number[fw_continuum_lattice(&mesh, i, j, k)];
                assert_int_equal(number > 0, (i & 1) + (j & 1) + (k & 1) <= 1);
                if (!number) continue;
                assert_int_equal(number, ++next); /* from 1 without holes: each once */
                size_t flat = (size_t)(i * (2 * mesh.nj + 1) + j);
                place[n][0] = mesh.x[flat], place[n][1] = mesh.y[flat], place[n++][2] = mesh.z[k];
            }
    assert_int_equal(n, mesh.nnode);
    qsort(place, (size_t)n, sizeof *place, by_place);
    for (int i = 1; i < n; i++)
        assert_true(by_place(place[i - 1], place[i]) != 0);
}

static void refused(void **state) {
    fw_continuum_mesh mesh;
    const char *why = NULL;
    for (int n = 0; n < 6; n++) {
        fw_continuum_shape shape = shape_of(1, FW_ROOT_BLOCK);
        if (n == 0) shape.npiece = 0;
        if (n == 1) shape.width_m = 0;
        if (n == 2) shape.fillet_m = 60e-6;
        if (n == 3) shape.fillet_m = 0;
        if (n == 4) shape.block_half_m = 5e-6;
        if (n == 5) shape.piece[0].curvature_per_m = (double)NAN;
        assert_int_equal(fw_continuum_mesh_build(*state, &shape, 1, false, &mesh, &why),
                         FW_GEOMETRY);
        assert_non_null(why);
    }
}

/* ---- the deck ---- */

static const char *deck_of(fw_arena *arena, const fw_continuum_options *options, bool cubic) {
    fw_diags diags = fw_diags_new(arena);
    fw_continuum_shape shape = shape_of(1, FW_ROOT_BLOCK);
    fw_continuum_material material = material_of(1);
    fw_text deck = fw_text_new(arena);
    if (cubic)
        material = (fw_continuum_material){
            .cubic = true, .c11_Pa = 165.7e9, .c12_Pa = 63.9e9, .c44_Pa = 79.6e9};
    assert_int_equal(
        fw_continuum_hinge_deck(arena, &shape, &material, options, (fw_place){0}, &diags, &deck),
        FW_OK);
    return deck.data;
}

static void same_bytes(void **state) {
    fw_continuum_options options = {.large = true, .nangle = 2, .angle_rad = {0.05, 0.1}};
    for (int n = 0; n < 2; n++) {
        const char *first = deck_of(*state, &options, n), *second = deck_of(*state, &options, n);
        assert_string_equal(first, second);
    }
    assert_non_null(strstr(deck_of(*state, &options, true),
                           "*ELASTIC, TYPE=ORTHO\n165700, 63900, 165700, 63900, 63900, 165700, "
                           "79600, 79600,\n79600\n"));
    assert_non_null(strstr(deck_of(*state, &options, false), "*ELASTIC\n169000, 0.22\n"));
}

/* reads the deck back: nodes and bricks in order, every brick of 20 nodes that exist, no node of a
   rigid face held otherwise, lines within the format */
static void reads_back(void **state) {
    const char *deck = deck_of(*state, &(fw_continuum_options){0}, false), *set = "";
    int node = 0, brick = 0, entries = 0;
    unsigned char *rigid = fw_arena_alloc(*state, 100000, 1);
    for (const char *line = deck; *line; line = strchr(line, '\n') + 1) {
        size_t n = strcspn(line, "\n");
        assert_true(n < 132);
        if (*line == '*') {
            if (line[1] != '*') set = line, entries = 0;
            continue;
        }
        if (strncmp(set, "*NODE, ", 7) != 0 && strncmp(set, "*ELEMENT", 8) != 0 &&
            strncmp(set, "*NSET", 5) != 0)
            continue;
        for (const char *p = line; p < line + n;) {
            char *end;
            double value = strtod(p, &end);
            assert_true(end > p);
            size_t wide = strcspn(p, ",\n");
            assert_true(wide <= 20);
            if (strncmp(set, "*NODE, NSET=NALL", 16) == 0 && p == line)
                assert_int_equal((int)value, ++node);
            if (strncmp(set, "*ELEMENT", 8) == 0) {
                if (entries++ % 21 == 0)
                    assert_int_equal((int)value, ++brick);
                else
                    assert_true(value >= 1 && value <= node);
            }
            if (strncmp(set, "*NSET, NSET=ROOT", 16) == 0) rigid[(int)value] = 1;
            if (strncmp(set, "*NSET, NSET=MIDDLE", 18) == 0) assert_false(rigid[(int)value]);
            p += wide;
            while (*p == ',' || *p == ' ')
                p++;
        }
    }
    fw_continuum_shape shape = shape_of(1, FW_ROOT_BLOCK);
    fw_continuum_mesh mesh;
    build(*state, &shape, 1, &mesh);
    assert_int_equal(node, mesh.nnode);
    assert_int_equal(brick, mesh.nelement);
}

static void wrong_constants(void **state) {
    fw_diags diags = fw_diags_new(*state);
    fw_continuum_shape shape = shape_of(1, FW_ROOT_BLOCK);
    fw_text deck = fw_text_new(*state);
    const fw_continuum_material material[3] = {
        {.youngs_Pa = 1e11, .poisson = 0.5},
        {.youngs_Pa = -1, .poisson = 0.3},
        {.cubic = true, .c11_Pa = 1e11, .c12_Pa = 2e11, .c44_Pa = 1e11}};
    for (int n = 0; n < 3; n++) {
        assert_int_equal(fw_continuum_hinge_deck(*state, &shape, &material[n],
                                                 &(fw_continuum_options){0}, (fw_place){0}, &diags,
                                                 &deck),
                         FW_GEOMETRY);
        assert_int_equal(diags.item[n].number, 213);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(depth_and_corner, open_arena, close_arena),
        cmocka_unit_test_setup_teardown(volume, open_arena, close_arena),
        cmocka_unit_test_setup_teardown(valid_everywhere, open_arena, close_arena),
        cmocka_unit_test_setup_teardown(general_centre_line, open_arena, close_arena),
        cmocka_unit_test_setup_teardown(edges_are_exact, open_arena, close_arena),
        cmocka_unit_test_setup_teardown(no_gaps, open_arena, close_arena),
        cmocka_unit_test_setup_teardown(refused, open_arena, close_arena),
        cmocka_unit_test_setup_teardown(same_bytes, open_arena, close_arena),
        cmocka_unit_test_setup_teardown(reads_back, open_arena, close_arena),
        cmocka_unit_test_setup_teardown(wrong_constants, open_arena, close_arena),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
