/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "pack_fixture.h"
#include "process/pack.h"
#include <stdlib.h>
#include <sys/wait.h>

static const char *const flows[] = {COPPER, SILICON};

static void packs_are_clean(void **state) {
    (void)state;
    for (int i = 0; i < 2; i++) {
        fw_process_flow *f = read_pack(arena, flows[i], NULL, NULL, &diags);
        assert_non_null(f);
        assert_int_equal(diags.count, 0); /* no warning and no note either */
        assert_string_equal(f->id, flows[i]);
        assert_int_equal(strlen(f->sha256), 64);
        assert_non_null(f->thickness);
        assert_int_equal(f->nstep, i == 0 ? 28 : 23);
    }
}

static fw_status pack_schema(fw_text *out) {
    return fw_xml_schema(&fw_process_pack_table, out);
}

static fw_status laboratory_schema(fw_text *out) {
    return fw_xml_schema(&fw_process_laboratory_table, out);
}

static void element(const fw_xml_table *table, const fw_xml_element_row *e, fw_text *out) {
    fw_xml_page_element(e, out);
    if (e->text) fw_text_add(out, "\nIt holds text.\n");
    if (e->nattribute > 0) fw_text_add(out, FW_XML_PAGE_HEAD);
    for (int k = 0; k < e->nattribute; k++)
        fw_xml_page_attribute(table, &e->attribute[k], out);
}

static bool of_packs_too(const char *name) {
    const fw_xml_element_row *e;
    for (int i = 0; (e = fw_xml_row_at(&fw_process_pack_table, i)) != NULL; i++)
        if (strcmp(e->name, name) == 0) return true;
    return false;
}

static fw_status reference_page(fw_text *out) {
    const fw_xml_table *table = &fw_process_pack_table;
    const fw_xml_element_row *e;
    fw_text_add(out,
                "<!-- generated from src/process/process_table.c; do not edit -->\n"
                "# Process packs\n\n"
                "A process pack is XML in UTF-8: a flow, or what all flows share (`base.xml`). "
                "What it means is in [theory/process.md](../theory/process.md).\n"
                "The schema for editors is [process.rng](../../processes/process.rng). A "
                "laboratory pack is a `<process>` with `flow`, and only `<source>`, `<q>`, "
                "`<choose>`, `<tool>` and "
                "`<correlation>` "
                "in it ([laboratory.rng](../../processes/laboratory.rng)).\n");
    for (int i = 0; (e = fw_xml_row_at(table, i)) != NULL; i++)
        element(table, e, out);
    fw_text_add(out, "\n## Of laboratory packs alone\n");
    for (int i = 0; (e = fw_xml_row_at(&fw_process_laboratory_table, i)) != NULL; i++)
        if (!of_packs_too(e->name)) element(&fw_process_laboratory_table, e, out);
    return fw_text_end(out);
}

/* to regenerate them: FW_WRITE_REFERENCE=1 test_pack */
static void compare(const char *name, fw_status (*generate)(fw_text *)) {
    fw_text text = fw_text_new(arena);
    char path[512];
    snprintf(path, sizeof path, "%s/%s", FW_TEST_SOURCE_DIR, name);
    assert_int_equal(generate(&text), FW_OK);
    if (getenv("FW_WRITE_REFERENCE")) {
        FILE *f = fopen(path, "wb");
        assert_non_null(f);
        assert_int_equal(fwrite(text.data, 1, text.length, f), text.length);
        assert_int_equal(fclose(f), 0);
    }
    char *committed;
    size_t n;
    assert_int_equal(fw_input_read(arena, path, 1 << 20, &diags, &committed, &n), FW_OK);
    if (n != text.length || memcmp(committed, text.data, n) != 0)
        fail_msg("%s differs from src/process/process_table.c; run FW_WRITE_REFERENCE=1 test_pack",
                 name);
}

static void pages_are_current(void **state) {
    (void)state;
    compare("docs/reference/process.md", reference_page);
    compare("processes/process.rng", pack_schema);
    compare("processes/laboratory.rng", laboratory_schema);
}

static void rows_are_complete(void **state) {
    (void)state;
    const fw_xml_table *const tables[] = {&fw_process_pack_table, &fw_process_laboratory_table};
    const fw_xml_element_row *e;
    for (int k = 0; k < 2; k++)
        for (int i = 0; (e = fw_xml_row_at(tables[k], i)) != NULL; i++) {
            assert_int_equal(fw_xml_row_index(tables[k], e->name), i); /* names are unique */
            assert_true(e->sentence && e->sentence[strlen(e->sentence) - 1] == '.');
            for (int n = 0; n < e->nattribute; n++) {
                const fw_xml_attribute_row *a = &e->attribute[n];
                assert_true(a->sentence && strchr(".?", a->sentence[strlen(a->sentence) - 1]));
                assert_true(!a->required || !a->fallback);
                assert_true(!a->ranged || (a->min < a->max && a->reason));
                assert_true((a->kind == FW_KIND_WORD) == (a->words != NULL));
                assert_true((a->kind == FW_KIND_REF) == (a->space > 0));
                assert_true(a->space < tables[k]->nspace);
            }
        }
}

static void packs_follow_the_schema(void **state) {
    (void)state;
    if (system("xmllint --version >/dev/null 2>&1") != 0) skip();
    static const char *const names[] = {"base", COPPER, SILICON};
    for (int i = 0; i < 3; i++) {
        const char *command =
            fw_arena_printf(arena,
                            "xmllint --noout --nonet --relaxng '%s/processes/process.rng' "
                            "'%s/processes/%s.xml' >/dev/null 2>&1",
                            FW_TEST_SOURCE_DIR, FW_TEST_SOURCE_DIR, names[i]);
        assert_non_null(command);
        int status = system(command);
        assert_true(WIFEXITED(status));
        assert_int_equal(WEXITSTATUS(status), 0);
    }
}

/* every step with hydrofluoric acid: hazard with first aid, gluconate, buddy, two signatures */
static void hydrofluoric_acid(void **state) {
    (void)state;
    int found = 0;
    fw_process_flow *f = read_pack(arena, COPPER, NULL, NULL, &diags);
    for (int i = 0; i < f->nstep; i++) {
        fw_process_step *s = &f->step[i];
        bool acid = strcmp(s->equipment->id, "hf-bench") == 0, named = false;
        for (int k = 0; k < s->nhazard; k++) {
            if (strncmp(s->hazard[k]->id, "h.hf", 4) != 0) continue;
            named = true;
            assert_true(s->hazard[k]->buddy);
            assert_non_null(strstr(s->hazard[k]->first_aid, "calcium gluconate"));
            assert_non_null(strstr(s->hazard[k]->ghs, "GHS06"));
            assert_true(s->hazard[k]->waste[0] && s->hazard[k]->ppe[0]);
        }
        assert_int_equal(acid, named);
        if (named) assert_true(s->second_signature);
        found += named;
    }
    assert_int_equal(found, 5);
}

/* `stated` means the paper; everything else names its source and status, and a step that the paper
   does not describe says so */
static void provenance(void **state) {
    (void)state;
    static const struct {
        int flow;
        const char *id, *unit;
        double value;
    } paper[] = {{0, "cu.d", "um", 9},
                 {0, "cu.J", "mA/cm2", 20},
                 {0, "ps.J", "mA/cm2", 20},
                 {0, "mould.height", "um", 16},
                 {0, "bath.hf-parts", "1", 3},
                 {0, "bath.ipa-parts", "1", 5},
                 {0, "bath.acetic-parts", "1", 2},
                 {0, "bath.hf-strength", "%", 48},
                 {0, "mould.spins", "1", 2},
                 {0, "device.side", "mm", 3},
                 {1, "device.side", "mm", 3},
                 {1, "si.d", "um", 50},
                 {1, "al.d", "um", 1},
                 {1, "al.flow", "{sccm}", 100},
                 {1, "al.p", "mbar", 1.9e-2},
                 {1, "pan.phosphoric", "1", 80},
                 {1, "pan.nitric", "1", 5},
                 {1, "pan.water", "1", 10},
                 {1, "pan.R", "Ao/s", 10},
                 {1, "rie.sf6", "{sccm}", 50},
                 {1, "rie.o2", "{sccm}", 2},
                 {1, "rie.p", "mTorr", 80},
                 {1, "rie.power", "W", 250},
                 {1, "rie.t", "min", 90}};
    int n = (int)(sizeof paper / sizeof paper[0]), stated = 0;
    for (int k = 0; k < 2; k++) {
        fw_process_flow *f = read_pack(arena, flows[k], NULL, NULL, &diags);
        for (int i = 0; i < n; i++) {
            if (paper[i].flow != k) continue;
            const fw_quantity *q = fw_process_flow_quantity(f, paper[i].id);
            assert_non_null(q);
            assert_int_equal(q->status, FW_STATED);
            assert_false(q->unknown);
            assert_string_equal(q->unit, paper[i].unit);
            assert_relative(fw_quantity_in_unit(q), paper[i].value, 1e-12);
        }
        for (int i = 0; i < f->nquantity; i++) {
            const fw_quantity *q = f->quantity[i];
            assert_true(q->source && q->source[0]);
            stated += q->status == FW_STATED;
            if (q->status == FW_STATED)
                assert_non_null(strstr(q->source, "plane 3 DOF compliant micromanipulator"));
        }
    }
    assert_int_equal(stated, n); /* nothing else claims to be stated */
}

static void the_unknown_is_unknown(void **state) {
    (void)state;
    static const char *const copper[] = {"ps.d",      "ps.P",      "wafer.type",   "seed.c-cuso4",
                                         "seed.c-hf", "seed.T",    "seed.t-short", "resist.type",
                                         "cu.bath-T", "release.R", "seed.R"};
    static const char *const silicon[] = {"al.power", "al.R",         "al.base", "resist.type",
                                          "pan.T",    "pan.c-nitric", "rie.A",   "rie.electrode",
                                          "rie.bias", "rie.kappa",    "rie.T",   "rie.A-reference"};
    fw_process_flow *c = read_pack(arena, COPPER, NULL, NULL, &diags),
                    *s = read_pack(arena, SILICON, NULL, NULL, &diags);
    for (size_t i = 0; i < sizeof copper / sizeof copper[0]; i++)
        assert_true(fw_process_flow_quantity(c, copper[i])->unknown);
    for (size_t i = 0; i < sizeof silicon / sizeof silicon[0]; i++)
        assert_true(fw_process_flow_quantity(s, silicon[i])->unknown);
}

/* each mistake is found at its place, with its number */
static void mistakes(void **state) {
    (void)state;
    static const struct {
        const char *from, *to;
        int number;
        const char *says;
    } bad[] = {
        {"<purpose>", "<purpos>x</purpos><purpose>", 160, "did you mean <purpose>?"},
        {"batch=\"1\" attended=\"8\"", "bach=\"1\" attended=\"8\"", 161, "did you mean 'batch'?"},
        {" op=\"inspect\" title=\"Incoming", " title=\"Incoming", 162, "op="},
        {"op=\"inspect\"", "op=\"inspekt\"", 163, "did you mean 'inspect'?"},
        {"<step id=\"S01\"", "<step id=\"../S01\"", 545, "a letter or _ first"},
        {"<step id=\"S01\"", "<step id=\"S01&#13;&#10;BEGIN:VALARM\"", 545, "letters, digits"},
        {"<q id=\"al.R\"", "<q id=\"=al.R\"", 545, "must be a letter"},
        {"<q id=\"al.R\"", "<q id=\"al.d\"", 164, "'al.d' is used twice"},
        {"q=\"al.power\" tol", "q=\"al.powr\" tol", 165, "did you mean 'al.power'?"},
        {"<hazard-ref ref=\"h.sputter\"/>", "<hazard-ref ref=\"h.sputtr\"/>", 165, "no hazard"},
        {"equipment=\"sputter\"", "equipment=\"sputterer\"", 165, "no equipment"},
        {"goto=\"S02\"", "goto=\"S99\"", 165, "no step"},
        {"<lag from=\"S02\"", "<lag from=\"S77\"", 165, "no step"},
        {"law=\"rate\"", "law=\"rat\"", 166, "did you mean 'rate'?"},
        {"<arg name=\"thickness\" q=\"al.d\"/>", "<arg name=\"thicknes\" q=\"al.d\"/>", 167,
         "did you mean 'thickness'?"},
        {"<arg name=\"rate\" q=\"al.R\"/>", "", 168, "'rate'"},
        {"<arg name=\"rate\" q=\"al.R\"/>", "<arg name=\"rate\" q=\"al.d\"/>", 169, "'al.d'"},
        {"<expr>(phosphoric + nitric + water)*part</expr>",
         "<expr>phosphoric + nitrc + water</expr>", 170, ""},
        {"<expr>(phosphoric + nitric + water)*part</expr>", "", 170, "needs an <expr>"},
        {"overrun=\"0\" k=\"2\"", "overrun=\"some\" k=\"2\"", 165, "overrun"},
        {"tol-lo=\"98\"", "tol-lo=\"low\"", 171, "tol-lo"},
        {"max=\"2\" unit=\"h\"", "min=\"3\" max=\"2\" unit=\"h\"", 171, "min is longer"},
        {"max=\"2\" unit=\"h\"", "max=\"2\" unit=\"um\"", 169, "unit of time"},
        {"<change kind=\"remove\" material=\"carrier-wax\"/>",
         "<change kind=\"remove\" material=\"porous-silicon\"/>", 172, "porous-silicon"},
        {"status=\"typical\" src=\"typical\" note=\"SC1",
         "status=\"stated\" src=\"guess\" note=\"SC1", 173, "assumed"},
        {"<hazard-ref ref=\"h.pan\"/>", "<hazard-ref ref=\"h.hf-organic\"/>", 174,
         "second-signature"},
        {"xmlns=\"urn:flexwright:process:1\"", "xmlns=\"urn:other\"", 178, "urn:flexwright"},
        {"<endpoint>Five sites measured, edge looked at all round.</endpoint>", "", 180,
         "<endpoint>"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        diags = fw_diags_new(arena);
        assert_null(read_pack(arena, SILICON, bad[i].from, bad[i].to, &diags));
        bool found = false;
        for (size_t k = 0; k < diags.count; k++)
            if (diags.item[k].number == bad[i].number &&
                strstr(diags.item[k].message, bad[i].says)) {
                found = true;
                assert_string_equal(diags.item[k].place.file, "flow.xml");
                assert_true(diags.item[k].place.line > 0 && diags.item[k].place.column > 0);
            }
        if (!found)
            fail_msg("mistake %zu: no FW-D%d with '%s', but '%s'", i, bad[i].number, bad[i].says,
                     diags.count ? diags.item[0].message : "nothing");
    }
}

static void place_is_exact(void **state) {
    (void)state;
    size_t n = 0;
    const char *text = pack_text(arena, SILICON, &n);
    const char *at = strstr(text, "law=\"rate\"");
    int line = 1, column = 1;
    for (const char *c = text; c < at; c++, column++)
        if (*c == '\n') {
            line++;
            column = 0;
        }
    assert_null(read_pack(arena, SILICON, "law=\"rate\"", "law=\"rats\"", &diags));
    for (size_t i = 0; i < diags.count; i++)
        if (diags.item[i].number == 166) {
            assert_int_equal(diags.item[i].place.line, line);
            assert_int_equal(diags.item[i].place.column, column + 5);
            return;
        }
    fail_msg("not reported");
}

static void chemicals_must_not_meet(void **state) {
    (void)state;
    fw_process_flow *f =
        read_pack(arena, SILICON, "<hazard-ref ref=\"h.pan\"/><hazard-ref ref=\"h.sharp\"/>",
                  "<hazard-ref ref=\"h.pan\"/><hazard-ref ref=\"h.solvent\"/>", &diags);
    assert_non_null(f);
    bool warned = false;
    for (size_t i = 0; i < diags.count; i++)
        warned = warned || diags.item[i].number == 175;
    assert_true(warned);
}

static void a_flow_may_replace_shared_values(void **state) {
    (void)state;
    fw_process_flow *f = read_pack(arena, COPPER, "<!-- device -->",
                                   "<q id=\"cu.rho\" value=\"8.9\" u=\"0.1\" unit=\"g/cm3\" "
                                   "status=\"assumed\" src=\"guess\"/>",
                                   &diags);
    assert_non_null(f);
    assert_int_equal(diags.count, 1);
    assert_int_equal(diags.item[0].number, 177);
    assert_relative(fw_process_flow_quantity(f, "cu.rho")->value, 8900.0, 1e-12);
    fw_process_step *s = step_of(f, "C22");
    for (int i = 0; i < s->nargument; i++)
        if (strcmp(s->argument[i].name, "density") == 0)
            assert_ptr_equal(s->argument[i].q, fw_process_flow_quantity(f, "cu.rho"));
}

static void broken_files(void **state) {
    (void)state;
    size_t nb = 0, n = 0;
    const char *base = pack_text(arena, "base", &nb), *text = pack_text(arena, COPPER, &n);
    for (size_t cut = 0; cut < n; cut += 1997) { /* every truncation is refused, none crashes */
        fw_arena *own = fw_arena_new(0);
        fw_diags d = fw_diags_new(own);
        fw_process_flow *f = NULL;
        assert_int_equal(
            fw_process_flow_read(own, "base.xml", base, nb, "flow.xml", text, cut, &d, &f),
            FW_INPUT);
        assert_null(f);
        assert_true(d.errors > 0);
        fw_arena_free(own);
    }
    fw_process_flow *f = NULL;
    assert_int_equal(
        fw_process_flow_read(arena, "base.xml", text, n, "flow.xml", text, n, &diags, &f),
        FW_INPUT); /* a flow is no shared pack */
    diags = fw_diags_new(arena);
    assert_int_equal(
        fw_process_flow_read(arena, "base.xml", base, nb, "flow.xml", base, nb, &diags, &f),
        FW_INPUT);
}

/* the allocator fails at the n-th request, for every n: always a clean FW_NOMEM */
static void out_of_memory(void **state) {
    (void)state;
    size_t nb = 0, n = 0;
    const char *base = pack_text(arena, "base", &nb), *text = pack_text(arena, SILICON, &n);
    long failures = 0;
    for (long at = 1;; at += at < 200 ? 1 : 37) {
        fw_arena *own = fw_arena_new(0);
        fw_diags d = fw_diags_new(own);
        fw_process_flow *f = NULL;
        fw_arena_fail_at(at, 1);
        fw_status status =
            fw_process_flow_read(own, "base.xml", base, nb, "flow.xml", text, n, &d, &f);
        if (status == FW_OK) status = fw_process_flow_compute(own, f, &plain_facts, &d);
        fw_arena_fail_at(0, 0);
        fw_arena_free(own);
        if (status == FW_OK) break;
        assert_int_equal(status, FW_NOMEM);
        failures++;
    }
    assert_true(failures > 200);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
int main(void) {
    const struct CMUnitTest tests[] = {TEST(packs_are_clean),
                                       TEST(pages_are_current),
                                       TEST(rows_are_complete),
                                       TEST(packs_follow_the_schema),
                                       TEST(hydrofluoric_acid),
                                       TEST(provenance),
                                       TEST(the_unknown_is_unknown),
                                       TEST(mistakes),
                                       TEST(place_is_exact),
                                       TEST(chemicals_must_not_meet),
                                       TEST(a_flow_may_replace_shared_values),
                                       TEST(broken_files),
                                       TEST(out_of_memory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
