/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "mask/mask.h"
#include "geometry/segment.h"
#include "scene.h"
#include <jansson.h>

static const fw_output_file files[2] = {{"a.gds", 12, "00ff"}, {"a.svg", 345, "1234"}};

static const fw_mask *built(scene *s) {
    const fw_mask *mask = NULL;
    fw_status status = scene_build(s, &mask);
    if (status != FW_OK)
        fail_msg("%s", s->diags.count ? s->diags.item[0].message : fw_status_text(status));
    return mask;
}

static json_t *sheet(const fw_mask *mask, fw_arena *arena) {
    fw_text out = fw_text_new(arena);
    assert_int_equal(fw_mask_write_order(mask, 0, files, 2, &out), FW_OK);
    json_error_t error;
    json_t *json = json_loads(out.data, 0, &error);
    if (!json) fail_msg("line %d: %s", error.line, error.text);
    return json;
}

static double number(json_t *json, const char *key) {
    json_t *value = json_object_get(json, key);
    if (!json_is_number(value)) fail_msg("%s is no number", key);
    return json_number_value(value);
}

static const char *text(json_t *json, const char *key) {
    json_t *value = json_object_get(json, key);
    return json_is_string(value) ? json_string_value(value) : "(none)";
}

static fw_geometry_vec2 point(json_t *json, const char *key) {
    json_t *value = json_object_get(json, key);
    assert_int_equal(json_array_size(value), 2);
    return (fw_geometry_vec2){json_number_value(json_array_get(value, 0)) * UM,
                              json_number_value(json_array_get(value, 1)) * UM};
}

static void plates(void **state) {
    (void)state;
    static const struct {
        const char *plate;
        int first;
        const char *wrong; /* NULL: right */
    } row[] = {
        {NULL, -1, NULL},
        {"1/0", 0, NULL},
        {"2/0", 1, NULL},
        {"2/0 NOT 1/0", 1, NULL},
        {"1/0 OR 2/0 XOR 1/0 AND 63/0", 0, NULL},
        {"", -1, ""},
        {"3/0", -1, "3/0"},
        {"1/1", -1, "1/1"},
        {"1", -1, "1"},
        {"1/0 2/0", -1, " 2/0"},
        {"1/0 NOT", -1, " NOT"},
        {"1/0 NOT ", -1, ""},
        {"1/0 NOT -2/0", -1, "-2/0"},
        {"1/0 BUT 2/0", -1, " BUT 2/0"},
        {"1/0NOT 2/0", -1, "NOT 2/0"},
    };
    scene *s = scene_new(0, 0);
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        bool on[3] = {false};
        int first;
        const char *wrong = "";
        s->table.plate = row[i].plate;
        assert_int_equal(fw_mask_plate_layers(&s->table, s->table.plate, on, &first, &wrong),
                         !row[i].wrong);
        if (row[i].wrong)
            assert_string_equal(wrong, row[i].wrong);
        else
            assert_int_equal(first, row[i].first);
    }
    scene_free(s);
}

/* what the reader of tables says of a plate that is none */
static void plate_of_a_table(void **state) {
    (void)state;
    static const char *const xml =
        "<mask-table xmlns=\"urn:flexwright:masks:1\" flow=\"f\" reading=\"r\" plate=\"%s\">"
        "<layer gds=\"1/0\" id=\"a\" name=\"A\" purpose=\"p\" tone=\"data dark\" "
        "colour=\"#000000\"/></mask-table>";
    for (int good = 0; good < 2; good++) {
        scene *s = scene_new(0, 0);
        char given[600];
        fw_mask_table table;
        int n = snprintf(given, sizeof given, xml, good ? "1/0" : "1/0 NOT 9/0");
        fw_status status =
            fw_mask_table_read(s->arena, "t.xml", given, (size_t)n, &s->diags, &table);
        assert_int_equal(status, good ? FW_OK : FW_INPUT);
        if (good)
            assert_string_equal(table.plate, "1/0");
        else
            assert_says(scene_first(s, 133), "cannot be read at \"9/0\"");
        scene_free(s);
    }
}

/* ends on the boundary of the layer's union, their distance, and which side is between them */
static void assert_site(const fw_mask *mask, json_t *site) {
    fw_geometry_vec2 p = point(site, "from_um"), q = point(site, "to_um"),
                     m = point(site, "centre_um");
    bool space = strcmp(text(site, "kind"), "space") == 0, inside = false;
    double rounding = 2e-4 * UM, to_p = 1, to_q = 1;
    assert_near(hypot(p.x - q.x, p.y - q.y), number(site, "cd_um") * UM, rounding);
    assert_near(m.x, 0.5 * (p.x + q.x), rounding);
    assert_near(m.y, 0.5 * (p.y + q.y), rounding);
    for (int i = 0; i < mask->nshape; i++) {
        const fw_geometry_contour *c = &mask->shape[i].contour;
        char gds[32];
        snprintf(gds, sizeof gds, "%d/0", mask->table->layer[mask->shape[i].layer].layer);
        if (strcmp(gds, text(site, "gds")) != 0) continue;
        for (int k = -1; k <= 1; k += 2) /* the middle may lie on a joint between two pieces */
            inside = inside || fw_geometry_contour_contains(
                                   c, (fw_geometry_vec2){m.x + k * 1e-10, m.y + k * 2e-10});
        for (int k = 0; k < c->count; k++) {
            double t;
            fw_geometry_vec2 at;
            to_p = fmin(to_p, fw_geometry_segment_nearest(&c->segment[k], p, &t, &at));
            to_q = fmin(to_q, fw_geometry_segment_nearest(&c->segment[k], q, &t, &at));
        }
    }
    assert_true(inside != space);
    assert_near(to_p, 0, rounding);
    assert_near(to_q, 0, rounding);
}

static void says_what_is_drawn(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_arch(s, 50, 8, 20);
    static const double p[4][2] = {{0, 200}, {7, 200}, {7, 208}, {0, 208}};
    static const double q[4][2] = {{12, 200}, {20, 200}, {20, 208}, {12, 208}};
    scene_add(s, FW_ROLE_TEXT, "i", polygon(s->arena, p, 4));
    scene_add(s, FW_ROLE_TEXT, "l", polygon(s->arena, q, 4));
    s->options.bias_m = 1 * UM;
    s->table.plate = "1/0 NOT 2/0";
    const fw_mask *mask = built(s);
    json_t *json = sheet(mask, s->arena);
    assert_string_equal(text(json, "schema"), "flexwright.order/1");
    assert_string_equal(text(json, "mask"), "test_device-test-flow");
    assert_string_equal(text(json, "polygon_tone"), "data dark");
    assert_string_equal(text(json, "field"), "clear");
    assert_string_equal(text(json, "reading_chrome_up"), "wrong-reading");
    assert_true(json_is_true(json_object_get(json, "mirror_seen_chrome_up")));
    assert_true(json_is_false(json_object_get(json, "mirrored_in_data")));
    assert_near(number(json, "min_feature_um"), 7, 1e-6);
    assert_near(number(json, "min_space_um"), 5, 1e-6);
    assert_near(number(json, "bias_um_per_edge"), 1, 0);
    assert_near(number(json, "mask_cd_bias_um"), 0, 0);
    assert_near(number(json, "polygons"), 5, 0);
    double vertices = 0;
    for (int i = 0; i < mask->nshape; i++)
        vertices += mask->shape[i].polygon.count;
    assert_near(number(json, "vertices"), vertices, 0);
    json_t *list = json_object_get(json, "cd_sites"), *site;
    size_t i;
    int flexures = 0;
    json_array_foreach(list, i, site) {
        assert_site(mask, site);
        if (strcmp(text(site, "what"), "arch") != 0) continue;
        flexures++; /* in the middle of the arc, on its mean radius; both edges moved by the bias */
        fw_geometry_vec2 m = point(site, "centre_um");
        assert_near(number(site, "cd_um"), 10, 1e-6);
        assert_near(m.x, 0, 1e-9);
        assert_near(m.y, 50 * UM, 1e-9);
    }
    assert_int_equal(flexures, 1);
    assert_true(json_array_size(list) >= 4);
    json_t *file = json_array_get(json_object_get(json, "files"), 1);
    assert_string_equal(text(file, "sha256"), "1234");
    assert_near(number(file, "bytes"), 345, 0);
    json_decref(json);
    scene_free(s);
}

static void tone_and_reading(void **state) {
    (void)state;
    static const struct {
        const char *reading, *plate;
        int mirror; /* -1: null */
        const char *field;
    } row[] = {
        {"right-reading chrome down", "1/0", 1, "clear"},
        {"right-reading chrome up", "2/0 AND 1/0", 0, "dark"},
        {"wrong-reading chrome up", NULL, 1, "(none)"},
        {"wrong-reading chrome down", "1/0", 0, "clear"},
        {"as ever", "1/0", -1, "clear"},
    };
    for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
        scene *s = scene_new(0, 0);
        scene_box(s, "box", 0, 0, 200, 200);
        s->options.rejected = i == 1;
        s->table.reading = row[i].reading;
        s->table.plate = row[i].plate;
        const fw_mask *mask = built(s);
        json_t *json = sheet(mask, s->arena),
               *mirror = json_object_get(json, "mirror_seen_chrome_up");
        assert_string_equal(text(json, "field"), row[i].field);
        assert_int_equal(json_is_true(mirror), row[i].mirror == 1);
        assert_int_equal(json_is_null(mirror), row[i].mirror == -1);
        assert_true(
            json_is_null(json_object_get(json, "min_feature_um"))); /* 200 um: not looked at */
        fw_text out = fw_text_new(s->arena);
        assert_int_equal(fw_mask_write_order_text(mask, 0, files, 2, &out), FW_OK);
        for (size_t k = 0; k < out.length; k++)
            assert_true(out.data[k] == '\n' || (out.data[k] >= 0x20 && out.data[k] <= 0x7e));
        assert_int_equal(strstr(out.data, "REJECTED") != NULL, i == 1);
        assert_non_null(strstr(out.data, "\n00ff  12  a.gds\n1234  345  a.svg\n"));
        assert_non_null(strstr(out.data, row[i].mirror == 1   ? "mirror                 yes"
                                         : row[i].mirror == 0 ? "mirror                 no"
                                                              : "ask before writing"));
        json_decref(json);
        scene_free(s);
    }
}

static void short_memory(void **state) {
    (void)state;
    scene *s = scene_new(4 * UM, 4 * UM);
    scene_arch(s, 50, 8, 20);
    const fw_mask *mask = built(s);
    for (int form = 0; form < 2; form++) {
        fw_status status = FW_NOMEM;
        for (long at = 1; status != FW_OK && at < 100; at++) {
            fw_text out = fw_text_new(s->arena);
            fw_arena_fail_at(at, 1);
            status =
                (form ? fw_mask_write_order : fw_mask_write_order_text)(mask, 0, files, 2, &out);
            fw_arena_fail_at(0, 0);
            assert_true(status == FW_OK || status == FW_NOMEM);
        }
        assert_int_equal(status, FW_OK);
    }
    scene_free(s);
}

/* columns are as wide as what stands in them: laboratories number layers up to 65535 */
static void columns_of_long_numbers(void **state) {
    (void)state;
    for (int many = 0; many < 2; many++) {
        scene *s = scene_new(4 * UM, 4 * UM);
        scene_box(s, "bar", 0, 0, 20, 300);
        scene_box(s, "other", 30, 0, 50, 300);
        if (many) s->layer[0].layer = s->layer[0].datatype = 65535;
        if (many) s->layer[1].name = "a name of more than twenty characters";
        fw_text out = fw_text_new(s->arena);
        assert_int_equal(fw_mask_write_order_text(built(s), 0, files, 2, &out), FW_OK);
        const char *head = strstr(out.data, "\nlayer  "), *line;
        assert_non_null(head);
        long tone = strstr(head + 1, "tone") - head, name = strstr(head, "name") - head;
        line = head + 1;
        for (int k = 0; k < 3; k++) {
            const char *before = strchr(line, '\n');
            line = before + 1;
            const fw_mask_layer *y = &s->layer[k];
            assert_memory_equal(before + name, y->name, strlen(y->name));
            assert_memory_equal(before + tone, y->documentation ? "-" : y->tone, 1);
            assert_int_equal(before[name - 1], ' ');
            assert_int_equal(before[tone - 1], ' ');
        }
        head = strstr(out.data, "\nsite  ");
        assert_non_null(head);
        const char *site = strchr(head + 1, '\n');
        assert_memory_equal(site + (strstr(head, "kind") - head), "width", 5);
        scene_free(s);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(columns_of_long_numbers), cmocka_unit_test(plates),
        cmocka_unit_test(plate_of_a_table),        cmocka_unit_test(says_what_is_drawn),
        cmocka_unit_test(tone_and_reading),        cmocka_unit_test(short_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
