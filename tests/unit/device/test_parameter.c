/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parameters and --set. */
#include "files.h"

#define P(name, value) "<parameter name=\"" name "\" value=\"" value "\"/>"
#define DIE(width)     "<die width=\"" width "\"/>"

static void order_does_not_matter(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const fw_device *d = sound(arena,
                               DEVICE(DIE("c") P("c", "a + 2*b") P("a", "b^2/(1 mm)") P("b", "2 mm")
                                          P("r", "c/arc") P("arc", "2 rad") ARM),
                               NULL, 0);
    assert_relative(d->die.width_m, 8e-3, 1e-14);
    assert_string_equal(d->parameter[0].name, "c"); /* in file order */
    assert_string_equal(d->parameter[2].unit, "mm");
    assert_string_equal(d->parameter[0].unit, "");
    assert_relative(d->parameter[3].value, 4e-3, 1e-14);
    assert_true(isinf(d->parameter[0].min) && isinf(d->parameter[0].max));
    fw_arena_free(arena);
}

static void set_replaces_parameters(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *xml = DEVICE("<parameter name=\"w\" value=\"2 mm\" min=\"1 mm\" max=\"5 mm\"/>" P(
        "v", "2*w") DIE("v") ARM);
    const fw_device_set set[] = {{"w", "3 mm"}};
    const fw_device *d = sound(arena, xml, set, 1);
    assert_relative(d->die.width_m, 6e-3, 1e-14);
    assert_true(d->parameter[0].overridden && !d->parameter[1].overridden);
    const fw_device_set other[] = {
        {"w", "1 mm"}, {"v", "w + 1 mm"}, {"w", "4 mm"}}; /* the last one holds */
    d = sound(arena, xml, other, 3);
    assert_relative(d->parameter[1].value, 5e-3, 1e-14);
    const fw_device_set low = {"w", "0.5 mm"}, wrong = {"w", "3 mg"}, bare = {"w", "3"},
                        odd = {"w", "3 mm +"}, circle = {"w", "v"}, far = {"ww", "1 mm"},
                        empty = {"", "1 mm"}, null = {"w", NULL};
    only_error(arena, xml, &low, 1, 57, "at least 1 mm");
    only_error(arena, xml, &wrong, 1, 25, "a mass, and a length is wanted");
    only_error(arena, xml, &bare, 1, 24, "has no unit");
    only_error(arena, xml, &odd, 1, 20, "too early");
    only_error(arena, xml, &circle, 1, 53, "w -> v -> w");
    only_error(arena, xml, &far, 1, 55, "no parameter has this name");
    only_error(arena, xml, &empty, 1, 55, "no parameter");
    only_error(arena, xml, &null, 1, 33, "empty");
    fw_arena_free(arena);
}

static void set_replaces_attributes(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    size_t n;
    char *xml = load(arena, GALLERY, &n);
    const fw_device_set set[] = {{"flexure[A]/@length", "312 um"},
                                 {"hinge[C]/@x", "0.81 mm"},
                                 {"scene[step-load]/@duration", "20 ms"},
                                 {"flow[al-masked-rie]/@thickness", "40 um"},
                                 {"die/@height", "6 mm"},
                                 {"flexure[B]/@fillet", "3 um"},
                                 {"link[AB]/@width", "2*link"},
                                 {"material/@poisson", "0.1"}};
    const fw_device *d = sound(arena, xml, set, 8);
    assert_relative(d->flexure[0].length_m, 312e-6, 1e-15);
    assert_relative(d->revolute[2].x_m, 0.81e-3, 1e-15);
    assert_relative(d->scene[0].duration_s, 0.02, 1e-15);
    assert_relative(d->flow[0].thickness_m, 40e-6, 1e-15);
    assert_relative(d->die.height_m, 6e-3, 1e-15);
    assert_relative(d->flexure[1].fillet_m, 3e-6, 1e-15);
    assert_relative(d->body[0].width_m, 240e-6, 1e-15);
    assert_relative(d->material.poisson.value, 0.1, 1e-15);
    const struct {
        fw_device_set set;
        int number;
        const char *says;
    } bad[] = {
        {{"flexure[A]/@lenght", "1 um"}, 55, "'length'"},
        {{"flexur[A]/@length", "1 um"}, 55, "'flexure'"},
        {{"flexure[AA]/@length", "1 um"}, 55, "no such element has this id"},
        {{"scene[step-laod]/@duration", "1 s"}, 55, "'step-load'"},
        {{"flexure/@length", "1 um"}, 55, "several"},
        {{"mechanism/@x", "1 um"}, 55, "no such element"},
        {{"air[a]/@x", "1 um"}, 55, "no such element"},
        {{"flexure[A]", "1 um"}, 55, "no path"},
        {{"flexure[A/@length", "1 um"}, 55, "no path"},
        {{"[A]/@length", "1 um"}, 55, "no such element"},
        {{"flexure[A]/@length", "1 kg"}, 25, "length=\"1 kg\""},
        {{"flexure[A]/@length", "-1 um"}, 47, "at least 1 um"},
        {{"flexure[A]/@kind", "leef"}, 48, "csfh, leaf"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        only_error(arena, xml, &bad[i].set, 1, bad[i].number, bad[i].says);
    fw_arena_free(arena);
}

/* <line> of an outline has other attributes than <line> of a flexure */
static void set_knows_where_an_element_stands(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    size_t n;
    char *xml = load(arena, "docs/gallery/free-form-gripper/device.xml", &n);
    const fw_device_set set[] = {{"mechanism/body[left]/outline/line[2]/@to-x", "141 um"},
                                 {"device/mechanism/body[left]/outline/arc[2]/@radius", "65 um"}};
    sound(arena, xml, set, 2);
    const fw_device_set wrong = {"mechanism/body[left]/outline/line[2]/@length", "141 um"};
    only_error(arena, xml, &wrong, 1, 55, "no such attribute");
    fw_arena_free(arena);
}

/* of many --set the message names the one that is wrong, as its file */
static void a_set_names_its_path(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    size_t n;
    char *xml = load(arena, GALLERY, &n);
    const fw_device_set set[] = {{"flexure[A]/@length", "312 umm"},
                                 {"arc", "240 deg"},
                                 {"flexure[B]/@lenght", "1 um"},
                                 {"link", "0.5 m"},
                                 {"die/@height", "6 mm"}};
    static const char *const file[] = {"--set flexure[B]/@lenght", "--set link",
                                       "--set flexure[A]/@length"};
    fw_diags diags = fw_diags_new(arena);
    const fw_device *device;
    assert_int_equal(fw_device_read(arena, "g.xml", xml, n, set, 5, &diags, &device), FW_INPUT);
    assert_int_equal(diags.count, 3);
    for (int i = 0; i < 3; i++) {
        assert_string_equal(diags.item[i].place.file, file[i]);
        assert_int_equal(diags.item[i].place.line, 0);
    }
    fw_text out = fw_text_new(arena);
    fw_diags_print(&diags, &out, "g.xml", xml, n, 0);
    assert_non_null(strstr(out.data, "--set flexure[A]/@length: error: "));
    assert_non_null(strstr(out.data, "did you mean 'um'?"));
    fw_arena_free(arena);
}

/* the misspelt end of a reference may be the declaration: both places are told */
static void both_ends_of_a_reference(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    only_error(arena,
               DEVICE("\n <flow ref=\"al-masked-rei\"/>" ARM
                      "<scene name=\"s\" duration=\"1 ms\" flow=\"al-masked-rie\"/>"),
               NULL, 0, 46, "did you mean 'al-masked-rei', declared at 2:13?");
    fw_arena_free(arena);
}

static void one_mistake_is_said_once(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    /* v, w and the die depend on what failed */
    only_error(arena, DEVICE(P("u", "2 mn") P("v", "2*u") P("w", "u + v") DIE("w") ARM), NULL, 0,
               21, "'mn'");
    only_error(arena, DEVICE(P("u", "v") P("v", "u") P("w", "u + v") DIE("w") ARM), NULL, 0, 53,
               "u -> v -> u");
    only_error(arena, DEVICE(P("g", "2 mm") DIE("2*g") ARM), NULL, 0, 54, "'g0'");
    only_error(arena, DEVICE(DIE("2*nothing") ARM), NULL, 0, 22, "<parameter");
    fw_arena_free(arena);
}

static void a_long_chain(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_text xml = fw_text_new(arena);
    fw_text_add(&xml, "<device xmlns=\"urn:flexwright:device:1\" name=\"d\">");
    for (int i = 199; i > 0; i--)
        fw_text_printf(&xml, "<parameter name=\"p%d\" value=\"p%d + 1 um\"/>", i, i - 1);
    fw_text_add(&xml, "<parameter name=\"p0\" value=\"1 um\"/>" ARM "</device>");
    const fw_device *d = sound(arena, xml.data, NULL, 0);
    assert_relative(d->parameter[0].value, 200e-6, 1e-13);
    fw_arena_free(arena);
}

/* of what is declared twice, which has its own error, a list has the name once */
static void a_list_of_names_has_each_once(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags = fw_diags_new(arena);
    const fw_device *device;
    const char *xml = DEVICE("<mechanism><body id=\"p\" mass=\"1 mg\" inertia=\"1 mg mm^2\" x=\"0 mm\" y=\"0 mm\"/>"
                             "<body id=\"pin\" mass=\"1 mg\" inertia=\"1 mg mm^2\" x=\"1 mm\" y=\"0 mm\"/>"
                             "<body id=\"p\" mass=\"1 mg\" inertia=\"1 mg mm^2\" x=\"2 mm\" y=\"0 mm\"/>"
                             "<revolute id=\"A\" a=\"ground\" b=\"q\"/></mechanism>");
    assert_int_equal(fw_device_read(arena, "t.xml", xml, strlen(xml), NULL, 0, &diags, &device), FW_INPUT);
    assert_int_equal(diags.item[diags.count - 1].number, 46);
    assert_non_null(strstr(diags.item[diags.count - 1].message, "declared are: p pin"));
    assert_null(strstr(diags.item[diags.count - 1].message, "p pin p"));
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_list_of_names_has_each_once),
        cmocka_unit_test(order_does_not_matter),
        cmocka_unit_test(set_replaces_parameters),
        cmocka_unit_test(set_replaces_attributes),
        cmocka_unit_test(set_knows_where_an_element_stands),
        cmocka_unit_test(a_set_names_its_path),
        cmocka_unit_test(both_ends_of_a_reference),
        cmocka_unit_test(one_mistake_is_said_once),
        cmocka_unit_test(a_long_chain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
