/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "xml/xml.h"
#include "scene.h"
#include <jansson.h>
#include <stdlib.h>

static const fw_mask *built(scene *s) {
    const fw_mask *mask = NULL;
    fw_status status = scene_build(s, &mask);
    if (status != FW_OK)
        fail_msg("%s", s->diags.count ? s->diags.item[0].message : fw_status_text(status));
    return mask;
}

static fw_xml_element *parsed(scene *s, const fw_text *text) {
    fw_xml_element *root = NULL;
    fw_status status = fw_xml_read(s->arena, "out", text->data, text->length, &s->diags, &root);
    if (status != FW_OK || !root)
        fail_msg("%s", s->diags.count ? s->diags.item[0].message : "not XML");
    return root;
}

static const char *attribute(const fw_xml_element *e, const char *name) {
    const fw_xml_attribute *a = fw_xml_attribute_of(e, name);
    if (!a) fail_msg("<%s> has no %s", e->name, name);
    return a->value;
}

/* area enclosed by a path of M L A Z, by the geometry that the SVG standard gives to an arc: from
   the end points, radius and the two flags alone. y points down, so ccw in the world is negative
   here. */
static double path_area(const char *d, double *arcs) {
    double x = 0, y = 0, fx = 0, fy = 0, area = 0;
    char *next = (char *)(uintptr_t)d;
    while (*next) {
        char op = *next++;
        double nx = fx, ny = fy;
        if (op == 'A') {
            double r = strtod(next, &next), ry = strtod(next, &next);
            double rotation = strtod(next, &next);
            long large = strtol(next, &next, 10), positive = strtol(next, &next, 10);
            nx = strtod(next, &next);
            ny = strtod(next, &next);
            assert_true(r == ry && rotation == 0);
            double chord = hypot(nx - x, ny - y);
            assert_true(chord <= 2 * r * (1 + 1e-6) && chord > 0);
            double angle = 2 * asin(fmin(1, chord / (2 * r)));
            angle = large ? 2 * PI - angle : angle;
            area += (positive ? 1 : -1) * 0.5 * r * r * (angle - sin(angle));
            *arcs += 1;
        } else if (op == 'M' || op == 'L') {
            nx = strtod(next, &next);
            ny = strtod(next, &next);
        }
        if (op == 'M') {
            fx = nx;
            fy = ny;
        } else
            area += 0.5 * (x * ny - nx * y);
        x = nx;
        y = ny;
    }
    return -area;
}

static void svg_has_exact_arcs(void **state) {
    (void)state;
    uint64_t seed = 5;
    for (int i = 0; i < 50; i++) {
        scene *s = scene_new(0, 0);
        double inner = (10 + 100 * random01(&seed)) * UM, width = (4 + 30 * random01(&seed)) * UM;
        double sweep = 0.3 + 5.6 * random01(&seed), radius = (5 + 50 * random01(&seed)) * UM;
        fw_geometry_contour ring, disc;
        fw_geometry_vec2 o = {1e-3 * random01(&seed), -1e-3 * random01(&seed)};
        assert_int_equal(fw_geometry_contour_ring_sector(s->arena, o, inner, inner + width,
                                                         6 * random01(&seed), sweep, &ring),
                         FW_OK);
        assert_int_equal(
            fw_geometry_contour_disc(s->arena, (fw_geometry_vec2){2e-3, 0}, radius, &disc), FW_OK);
        scene_add(s, FW_ROLE_FLEXURE, "ring <A&B>", ring);
        scene_add(s, FW_ROLE_STRUCTURE, "disc", disc);
        fw_text out = fw_text_new(s->arena);
        assert_int_equal(fw_mask_write_svg(built(s), &out), FW_OK);
        fw_xml_element *root = parsed(s, &out), *group = root->first_child;
        while (group && strcmp(group->name, "g") != 0)
            group = group->next;
        assert_non_null(group);
        assert_string_equal(attribute(group, "id"), "device");
        const fw_xml_element *path = group->first_child->next;
        double arcs = 0;
        double want = 0.5 * sweep * width * (2 * inner + width) * 1e12;
        assert_string_equal(path->first_child->text, "ring <A&B>");
        /* coordinates are rounded to 1 pm */
        double rounding = 1e-6 * fw_geometry_contour_perimeter(&ring) * 1e6;
        assert_near(path_area(attribute(path, "d"), &arcs), want, rounding);
        assert_true(arcs >= 2);
        arcs = 0;
        want = PI * radius * radius * 1e12;
        rounding = 1e-6 * fw_geometry_contour_perimeter(&disc) * 1e6;
        assert_near(path_area(attribute(path->next, "d"), &arcs), want, rounding);
        assert_true(arcs >= 3); /* a whole circle in one arc draws nothing */
        scene_free(s);
    }
}

/* a known place: y turned round, margins added, six decimals */
static void svg_places(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    scene_box(s, "box", 100, 200, 110.000001, 230);
    fw_text out = fw_text_new(s->arena);
    assert_int_equal(fw_mask_write_svg(built(s), &out), FW_OK);
    assert_non_null(strstr(out.data, "<path d=\"M150 180L160.000001 180L160.000001 150L150 150"));
    fw_xml_element *root = parsed(s, &out);
    assert_string_equal(attribute(root, "viewBox"), "0 0 310.000001 480");
    assert_string_equal(attribute(root, "width"), "0.310000001mm");
    assert_string_equal(attribute(root, "height"), "0.48mm");
    assert_null(strstr(out.data, "REJECTED"));
    scene_free(s);
}

static void lyp_names_every_layer(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    scene_box(s, "box", 0, 0, 10, 10);
    s->options.rejected = true;
    fw_text out = fw_text_new(s->arena);
    assert_int_equal(fw_mask_write_lyp(built(s), &out), FW_OK);
    fw_xml_element *root = parsed(s, &out);
    assert_string_equal(root->name, "layer-properties");
    static const char *const source[] = {"1/0@1", "2/0@1", "63/0@1"};
    int n = 0;
    for (const fw_xml_element *e = root->first_child; e; e = e->next) {
        if (strcmp(e->name, "properties") != 0) continue;
        bool named = false, placed = false;
        for (const fw_xml_element *c = e->first_child; c; c = c->next) {
            named = named || (strcmp(c->name, "name") == 0 && strstr(c->text, "REJECTED "));
            placed = placed || (strcmp(c->name, "source") == 0 && strcmp(c->text, source[n]) == 0);
        }
        assert_true(named && placed);
        n++;
    }
    assert_int_equal(n, 3);
    scene_free(s);
}

static void certificate_is_json(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_arch(s, 50, 8, 20);
    s->options.bias_m = 0.5 * UM;
    const char *note[] = {"quote=\"\\"};
    s->options.note = note;
    s->options.nnote = 1;
    const fw_mask *mask = built(s);
    fw_text out = fw_text_new(s->arena);
    const fw_output_file file[] = {{"x.gds", 12, "00ff"}, {"x.svg", 7, "11"}};
    assert_int_equal(fw_mask_write_certificate_of(mask, "abc", file, 2, &out), FW_OK);
    json_error_t error;
    json_t *root = json_loads(out.data, JSON_REJECT_DUPLICATES, &error);
    if (!root) fail_msg("line %d: %s", error.line, error.text);
    assert_string_equal(json_string_value(json_object_get(root, "schema")), "flexwright.mask/1");
    assert_string_equal(json_string_value(json_object_get(root, "gds_sha256")), "abc");
    assert_true(json_is_false(json_object_get(root, "rejected")));
    json_t *layers = json_object_get(root, "layers"), *first = json_array_get(layers, 0);
    assert_int_equal(json_array_size(layers), 3);
    assert_int_equal(json_integer_value(json_object_get(first, "polygons")), 3);
    double area = json_number_value(json_object_get(first, "area_um2"));
    double flat = json_number_value(json_object_get(first, "polygon_area_um2"));
    double bound = json_number_value(json_object_get(first, "area_bound_um2"));
    assert_relative(area, PI * 50 * 9 + 2 * 9 * 20.5, 1e-12);
    assert_near(flat, area, bound);
    assert_near(json_number_value(json_object_get(first, "min_width_um")), 9, 1e-8);
    assert_near(json_number_value(json_object_get(first, "min_space_um")), 91, 1e-8);
    /* the empty layer has no width */
    assert_true(json_is_null(json_object_get(json_array_get(layers, 1), "min_width_um")));
    assert_int_equal(json_array_size(json_object_get(root, "files")), 2);
    assert_string_equal(json_string_value(json_object_get(root, "flattening")), "inside");
    json_t *shapes = json_object_get(root, "shapes"), *arch = json_array_get(shapes, 0);
    assert_int_equal(json_array_size(shapes), 3);
    assert_string_equal(json_string_value(json_object_get(arch, "piece")), "arch");
    assert_true(json_integer_value(json_object_get(arch, "area2_nm2")) ==
                fw_geometry_polygon_area2(&mask->shape[0].polygon));
    json_t *necks = json_object_get(root, "necks"), *neck = json_array_get(necks, 0);
    assert_int_equal(json_array_size(necks), 1);
    assert_near(json_number_value(json_object_get(neck, "width_um")), 9, 1e-9);
    json_t *vertex = json_array_get(json_object_get(neck, "vertices_nm"), 0);
    assert_int_equal(json_integer_value(json_array_get(vertex, 0)), 0);
    size_t i;
    json_t *check;
    json_array_foreach(json_object_get(root, "checks"), i, check) {
        assert_true(json_integer_value(json_object_get(check, "of")) > 0);
        assert_int_equal(json_integer_value(json_object_get(check, "not_simple")), 0);
        assert_true(json_number_value(json_object_get(check, "worst_part")) <= 1);
    }
    json_t *notes = json_object_get(root, "notes");
    assert_string_equal(json_string_value(json_array_get(notes, json_array_size(notes) - 1)),
                        "quote=\"\\");
    json_decref(root);
    scene_free(s);
}

static void rejected_is_said_everywhere(void **state) {
    (void)state;
    scene *s = scene_new(0, 0);
    scene_box(s, "box", 0, 0, 10, 10);
    s->options.rejected = true;
    const fw_mask *mask = built(s);
    fw_status (*const writer[])(const fw_mask *, fw_text *) = {fw_mask_write_gds, fw_mask_write_svg,
                                                               fw_mask_write_lyp};
    for (int i = 0; i < 3; i++) {
        fw_text out = fw_text_new(s->arena);
        assert_int_equal(writer[i](mask, &out), FW_OK);
        bool said = false;
        for (size_t k = 0; k + 8 <= out.length; k++)
            said = said || memcmp(out.data + k, "REJECTED", 8) == 0;
        assert_true(said);
    }
    fw_text out = fw_text_new(s->arena);
    assert_int_equal(fw_mask_write_certificate(mask, NULL, &out), FW_OK);
    assert_non_null(strstr(out.data, "\"rejected\": true"));
    scene_free(s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(svg_has_exact_arcs),          cmocka_unit_test(svg_places),
        cmocka_unit_test(lyp_names_every_layer),       cmocka_unit_test(certificate_is_json),
        cmocka_unit_test(rejected_is_said_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
