/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "xml/xml_reader.h"
#include "test.h"

static const fw_xml_source_text sources[] = {{"s", "a source", ""}, {"t", "another", ""}};

static fw_status read_q(fw_arena *arena, const char *attributes, fw_quantity *q, fw_diags *diags) {
    char xml[512];
    fw_xml_element *root;
    snprintf(xml, sizeof xml, "<q %s/>", attributes);
    *diags = fw_diags_new(arena);
    assert_int_equal(fw_xml_read(arena, "t", xml, strlen(xml), diags, &root), FW_OK);
    return fw_xml_quantity_read(arena, root, sources, 2, diags, q);
}

static void good_quantities(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags;
    fw_quantity q;
    assert_int_equal(read_q(arena,
                            "id='a' value='9' u='0.5' unit='um' status='stated' src='t' note='n'",
                            &q, &diags),
                     FW_OK);
    assert_relative(q.value, 9e-6, 1e-15);
    assert_relative(q.uncertainty, 0.5e-6, 1e-15);
    assert_int_equal(q.status, FW_STATED);
    assert_string_equal(q.source, "another");
    assert_string_equal(q.note, "n");
    assert_string_equal(q.unit, "um");
    assert_true(q.dimension.m == 1 && !q.unknown);
    assert_relative(fw_quantity_in_unit(&q), 9.0, 1e-15);

    assert_int_equal(read_q(arena,
                            "id='a' value='20' urel='0.1' unit='mA/cm2' status='typical' src='s'",
                            &q, &diags),
                     FW_OK);
    assert_relative(q.value, 200.0, 1e-15);
    assert_relative(q.uncertainty, 20.0, 1e-14);

    /* uniform from 10 to 22 Cel: 12/sqrt(12) = sqrt(12) */
    assert_int_equal(read_q(arena,
                            "id='a' value='20' lo='10' hi='22' unit='Cel' status='assumed' src='s'",
                            &q, &diags),
                     FW_OK);
    assert_near(q.value, 293.15, 1e-12);
    assert_relative(q.uncertainty, 3.4641016151377544, 1e-14);

    assert_int_equal(
        read_q(arena, "id='a' unknown='true' unit='Cel' status='assumed' src='s'", &q, &diags),
        FW_OK);
    assert_true(q.unknown);
    assert_int_equal(diags.count, 0);
    fw_arena_free(arena);
}

static void bad_quantities(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int number, column;
    } bad[] = {
        {"value='9' u='0' unit='um' status='stated' src='s'", 43, 1},
        {"id='a' u='0' unit='um' status='stated' src='s'", 43, 1},
        {"id='a' value='9' u='0' status='stated' src='s'", 43, 1},
        {"id='a' value='9' u='0' unit='um' src='s'", 43, 1},
        {"id='a' value='9' u='0' unit='um' status='stated'", 43, 1},
        {"id='a' value='9,5' u='0' unit='um' status='stated' src='s'", 70, 18},
        {"id='a' value='nan' u='0' unit='um' status='stated' src='s'", 70, 18},
        {"id='a' value='9' unit='um' status='stated' src='s'", 71, 1},
        {"id='a' value='9' lo='8' unit='um' status='stated' src='s'", 71, 1},
        {"id='a' value='9' u='-1' unit='um' status='stated' src='s'", 71, 24},
        {"id='a' value='9' lo='9.5' hi='10' unit='um' status='stated' src='s'", 71, 25},
        {"id='a' value='9' u='1e308' urel='0' unit='um' status='stated' src='s'", 71, 1},
        {"id='a' value='9' u='0' unit='N/umm' status='stated' src='s'", 21, 35},
        {"id='a' value='9' u='0' unit='um' status='maybe' src='s'", 48, 45},
        {"id='a' value='9' u='0' unit='um' status='stated' src='x'", 46, 58},
        {"id='a' value='9' u='0' unit='um' status='stated' src='s' ul='1'", 42, 61},
        {"id='a' unknown='yes' unit='um' status='stated' src='s'", 48, 20},
        {"id='a' unknown='true' value='1' unit='um' status='stated' src='s'", 70, 33},
        {"id='a' value='1e308' u='0' unit='km' status='stated' src='s'", 28, 18},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        fw_arena *arena = fw_arena_new(0);
        fw_diags diags;
        fw_quantity q;
        if (read_q(arena, bad[i].text, &q, &diags) != FW_INPUT || !q.unknown)
            fail_msg("<q %s> is accepted", bad[i].text);
        if (diags.count != 1 || diags.item[0].number != bad[i].number ||
            diags.item[0].place.column != bad[i].column)
            fail_msg("<q %s>: %zu, column %d, FW-D%03d %s", bad[i].text, diags.count,
                     diags.item[0].place.column, diags.item[0].number, diags.item[0].message);
        fw_arena_free(arena);
    }
}

static void all_mistakes_at_once(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    fw_diags diags;
    fw_quantity q;
    assert_int_equal(read_q(arena, "value='x' unit='y' status='z' src='w' v='u'", &q, &diags),
                     FW_INPUT);
    assert_int_equal(diags.errors, 6);
    fw_arena_free(arena);
}

static void sources_are_collected(void **state) {
    (void)state;
    fw_arena *arena = fw_arena_new(0);
    const char *xml = "<p><source id='a'>first</source><x/><source id='b'/></p>";
    const char *bad = "<p><source id='a'>1</source><source id='a'>2</source><source/></p>";
    fw_diags diags = fw_diags_new(arena);
    fw_xml_element *root;
    fw_xml_source_text *source;
    int n;
    assert_int_equal(fw_xml_read(arena, "t", xml, strlen(xml), &diags, &root), FW_OK);
    assert_int_equal(fw_xml_sources_read(arena, root, &diags, &source, &n), FW_OK);
    assert_int_equal(n, 2);
    assert_string_equal(source[0].text, "first");
    assert_string_equal(source[1].text, "");
    assert_int_equal(fw_xml_read(arena, "t", bad, strlen(bad), &diags, &root), FW_OK);
    assert_int_equal(fw_xml_sources_read(arena, root, &diags, &source, &n), FW_INPUT);
    assert_int_equal(diags.errors, 2);
    fw_arena_free(arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_quantities),
        cmocka_unit_test(bad_quantities),
        cmocka_unit_test(all_mistakes_at_once),
        cmocka_unit_test(sources_are_collected),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
