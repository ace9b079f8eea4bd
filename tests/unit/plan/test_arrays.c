/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers of a design as arrays: what they hold is compared with the structs that they come from, and with
   the documents in tests/python/test_package.py. docs/reference/numbers.md is written anew by
   FW_WRITE_REFERENCE=1 unit_plan test_arrays. */
#include "plan/design.h"
#include "test.h"
#include <stdlib.h>

#define SOURCE FW_TEST_SOURCE_DIR

static const char six_bar[] = SOURCE "/docs/gallery/reference-six-bar/device.xml";
static const char *const set_name[FW_DESIGN_NUMBERS] = {
    "PARAMETERS", "SCENES",       "HINGES",    "FLOW_HINGES", "FLOWS",    "GOVERNING",
    "CLEARANCES", "REQUIREMENTS", "PROBES",    "MOTION",      "PEAKS",    "MOTION_PROBES",
    "MODES",      "STATICS",      "LOAD_PATH", "ASSEMBLY",    "WORKSPACE"};

static fw_design *design_of(const char *file) {
    fw_design_options o = fw_design_options_default();
    o.data_directory = SOURCE;
    o.samples = 21;
    o.path = 1;
    o.advice = "none";
    fw_design *design = fw_design_new(&o);
    assert_non_null(design);
    assert_int_equal(fw_design_read(design, file), FW_STATUS_OK);
    return design;
}

static const double *reals(fw_design *design, int numbers, const char *name, size_t n) {
    const fw_array *a = fw_design_array_named(design, numbers, name);
    if (!a) fail_msg("no array %s", name);
    assert_int_equal(a->type, FW_ARRAY_REAL);
    assert_int_equal(a->extent[0] * a->extent[1] * a->extent[2], n);
    return a->data;
}

static size_t commas(const char *text) {
    size_t n = 0;
    for (; *text; text++)
        n += *text == ',';
    return n;
}

/* what every array promises */
static void whole(const fw_array *a) {
    assert_true(a->name[0] && a->about[0] && a->unit);
    assert_non_null(a->data);
    assert_true(a->dimensions >= 1 && a->dimensions <= 3);
    for (int i = 0; i < 3; i++) {
        if (i >= a->dimensions) assert_int_equal(a->extent[i], 1);
        for (size_t k = 0; a->label[i] && k < a->extent[i]; k++)
            assert_non_null(a->label[i][k]);
    }
    assert_int_equal(a->type == FW_ARRAY_TEXT, a->unit[0] == '\0');
    if (commas(a->unit)) assert_int_equal(commas(a->unit) + 1, a->extent[a->dimensions - 1]);
}

static void every_set_is_whole(void **state) {
    (void)state;
    static const char *const file[] = {six_bar, SOURCE "/docs/gallery/free-form-gripper/device.xml",
                                       SOURCE "/docs/gallery/comb-stage/device.xml",
                                       SOURCE "/tests/data/effects/rubbing.xml"};
    for (int f = 0; f < test_cases(4, 1); f++) {
        fw_design *d = design_of(file[f]);
        fw_design_judge(d), fw_design_simulate(d), fw_design_modes(d), fw_design_statics(d);
        fw_design_assemble(d);
        for (int set = 0; set < FW_DESIGN_NUMBERS; set++) {
            size_t n;
            int status = fw_design_arrays(d, set, &n);
            assert_true(status == FW_STATUS_OK || (status == FW_STATUS_USAGE && n == 0));
            assert_null(fw_design_array(d, set, n));
            for (size_t i = 0; i < n; i++) {
                const fw_array *a = fw_design_array(d, set, i);
                whole(a);
                assert_ptr_equal(fw_design_array_named(d, set, a->name), a);
                /* rows are rows: all of the same number, but in sets of poses */
                if (set <= FW_NUMBERS_PROBES)
                    assert_int_equal(a->extent[0], fw_design_array(d, set, 0)->extent[0]);
            }
        }
        fw_design_free(d);
    }
}

static void hinges_are_those_of_the_verdict(void **state) {
    (void)state;
    fw_design *d = design_of(six_bar);
    assert_int_equal(fw_design_judge(d), FW_STATUS_OK);
    const fw_verdict *v = &fw_plan_design_plan(d)->verdict;
    const size_t n = (size_t)v->nhinge;
    const double *drawn = reals(d, FW_NUMBERS_HINGES, "utilisation", n);
    const double *high = reals(d, FW_NUMBERS_HINGES, "utilisation_high", n);
    const double *made = reals(d, FW_NUMBERS_HINGES, "made_utilisation", n);
    for (size_t i = 0; i < n; i++) {
        double most = 0;
        assert_true(drawn[i] == v->hinge[i].utilisation && high[i] == v->hinge[i].utilisation_high);
        for (int k = 0; k < v->nvariant; k++)
            for (int c = 0; c < v->variant[k].fabricated->ncorner; c++)
                for (int h = 0; h < v->variant[k].nhinge; h++)
                    if (v->variant[k].hinge[h].joint == v->hinge[i].joint)
                        most = fmax(most, v->variant[k].fabricated->corner[c].hinge[h].utilisation);
        assert_true(made[i] == most);
    }
    fw_design_free(d);
}

/* an array stays as it is when a later stage is done, and is not composed twice */
static void arrays_stay(void **state) {
    (void)state;
    fw_design *d = design_of(six_bar);
    assert_int_equal(fw_design_simulate(d), FW_STATUS_OK);
    const fw_array *a = fw_design_array_named(d, FW_NUMBERS_MOTION, "q");
    assert_ptr_equal(a, fw_design_array_named(d, FW_NUMBERS_MOTION, "q"));
    const size_t n = a->extent[0] * a->extent[1] * a->extent[2];
    double *before = malloc(n * sizeof *before);
    assert_non_null(before);
    memcpy(before, a->data, n * sizeof *before);
    assert_int_equal(fw_design_judge(d), FW_STATUS_OK);
    assert_int_equal(fw_design_modes(d), FW_STATUS_OK);
    assert_memory_equal(before, a->data, n * sizeof *before);
    const fw_array *again = fw_design_array_named(d, FW_NUMBERS_MOTION, "q");
    assert_memory_equal(before, again->data, n * sizeof *before);
    free(before);
    fw_design_free(d);
}

static void wrong_calls(void **state) {
    (void)state;
    size_t n = 7;
    assert_int_equal(fw_design_arrays(NULL, 0, &n), FW_STATUS_USAGE);
    assert_int_equal(n, 0);
    assert_null(fw_design_array(NULL, 0, 0));
    assert_null(fw_design_array_named(NULL, 0, "t"));
    assert_int_equal(fw_design_progress(NULL, NULL, NULL), FW_STATUS_USAGE);
    fw_design *d = design_of(six_bar);
    assert_int_equal(fw_design_arrays(d, -1, &n), FW_STATUS_USAGE);
    assert_int_equal(fw_design_arrays(d, FW_DESIGN_NUMBERS, NULL), FW_STATUS_USAGE);
    assert_int_equal(fw_design_arrays(d, FW_NUMBERS_MOTION, &n), FW_STATUS_USAGE);
    const size_t said = fw_design_diagnostics(d);
    assert_null(fw_design_array(d, FW_NUMBERS_MOTION, 0));
    assert_null(fw_design_array_named(d, FW_NUMBERS_PARAMETERS, "nix"));
    assert_null(fw_design_array_named(d, FW_NUMBERS_PARAMETERS, NULL));
    assert_int_equal(fw_design_diagnostics(d), said);
    assert_int_equal(fw_design_arrays(d, FW_NUMBERS_PARAMETERS, NULL), FW_STATUS_OK);
    fw_design_free(d);
}

/* ---- progress ---- */

typedef struct told {
    int times, stop_at;
} told;

static int count(void *context, const char *what, double done, double of, const char *unit) {
    told *t = context;
    assert_true(what[0] && unit[0] && done >= 0);
    if (of < 0 || of > 0) assert_true(done <= fabs(of) * (1 + 1e-12)); /* below 0: of at most that */
    if (strcmp(unit, "s") == 0) assert_true(done > 0 && done <= of * (1 + 1e-12));
    t->times++;
    return t->times == t->stop_at;
}

static void progress(void **state) {
    (void)state;
    fw_design *quiet = design_of(six_bar), *d = design_of(six_bar), *stopped = design_of(six_bar);
    told all = {0}, some = {.stop_at = 3};
    assert_int_equal(fw_design_progress(d, count, &all), FW_STATUS_OK);
    assert_int_equal(fw_design_judge(d), FW_STATUS_OK);
    assert_int_equal(fw_design_judge(quiet), FW_STATUS_OK);
    assert_true(all.times > 10);
    const char *a, *b;
    assert_int_equal(fw_design_document(d, FW_DOCUMENT_VERDICT_JSON, &a, NULL), FW_STATUS_OK);
    assert_int_equal(fw_design_document(quiet, FW_DOCUMENT_VERDICT_JSON, &b, NULL), FW_STATUS_OK);
    assert_string_equal(a, b);
    /* an answer cancels this design alone */
    assert_int_equal(fw_design_progress(stopped, count, &some), FW_STATUS_OK);
    assert_int_equal(fw_design_judge(stopped), FW_STATUS_CANCELLED);
    assert_true(some.times < all.times);
    assert_int_equal(fw_design_simulate(d), FW_STATUS_OK);
    fw_design_cancel_clear(stopped);
    const int before = all.times;
    assert_int_equal(fw_design_progress(d, NULL, NULL), FW_STATUS_OK);
    assert_int_equal(fw_design_modes(d), FW_STATUS_OK);
    assert_int_equal(all.times, before);
    fw_design_free(quiet);
    fw_design_free(d);
    fw_design_free(stopped);
}

/* drawings of a description in memory are opened in the directory that is named, and in none else */
static void directory_of_drawings(void **state) {
    (void)state;
    fw_design_options o = fw_design_options_default();
    o.data_directory = SOURCE;
    o.directory = SOURCE "/no-such-place";
    fw_design *d = fw_design_new(&o);
    const char *name = fw_plan_design_plan(d)->options.directory;
    assert_string_equal(name, SOURCE "/no-such-place");
    assert_ptr_not_equal(name, o.directory); /* a copy */
    fw_design_free(d);
}

/* ---- the reference page ---- */

static const char *const type_name[] = {[FW_ARRAY_REAL] = "real",
                                        [FW_ARRAY_WHOLE] = "whole",
                                        [FW_ARRAY_TEXT] = "text",
                                        [FW_ARRAY_COMPLEX] = "complex",
                                        [FW_ARRAY_TRUTH] = "truth"};

static void page(fw_design *d, fw_text *out) {
    fw_text_add(out,
                "# Numbers of a design\n\nWritten by `FW_WRITE_REFERENCE=1 unit_plan test_arrays` "
                "from what the library hands out: the arrays of every set of\n"
                "`fw_design_arrays` ([C](../c-api.md), [Python](../python.md)). Units are those of "
                "`fw_array.unit`; axes are rows first.\n");
    for (int set = 0; set < FW_DESIGN_NUMBERS; set++) {
        fw_text_printf(out,
                       "\n## FW_NUMBERS_%s\n\n| array | type | axes | unit | what |\n"
                       "|---|---|---|---|---|\n",
                       set_name[set]);
        size_t n;
        assert_int_equal(fw_design_arrays(d, set, &n), FW_STATUS_OK);
        for (size_t i = 0; i < n; i++) {
            const fw_array *a = fw_design_array(d, set, i);
            fw_text_printf(out, "| %s | %s | %d | %s | %s |\n", a->name, type_name[a->type],
                           (int)a->dimensions, a->unit, a->about);
        }
    }
}

static void page_is_current(void **state) {
    (void)state;
    fw_design *d = design_of(six_bar);
    fw_design_judge(d), fw_design_simulate(d), fw_design_modes(d), fw_design_statics(d);
    fw_design_assemble(d), fw_design_workspace(d);
    fw_text text = fw_text_new(fw_plan_design_plan(d)->arena);
    page(d, &text);
    assert_int_equal(fw_text_end(&text), FW_OK);
    static char committed[1 << 16];
    const char path[] = SOURCE "/docs/reference/numbers.md";
    if (getenv("FW_WRITE_REFERENCE")) {
        FILE *f = fopen(path, "wb");
        assert_non_null(f);
        assert_int_equal(fwrite(text.data, 1, text.length, f), text.length);
        assert_int_equal(fclose(f), 0);
    }
    FILE *f = fopen(path, "rb");
    assert_non_null(f);
    committed[fread(committed, 1, sizeof committed - 1, f)] = '\0';
    fclose(f);
    assert_string_equal(text.data, committed);
    fw_design_free(d);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_set_is_whole), cmocka_unit_test(hinges_are_those_of_the_verdict),
        cmocka_unit_test(arrays_stay),        cmocka_unit_test(wrong_calls),
        cmocka_unit_test(progress),           cmocka_unit_test(directory_of_drawings),
        cmocka_unit_test(page_is_current),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
