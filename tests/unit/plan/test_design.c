/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The public library: life of a design, order of calls, places of mistakes, documents, parallel
   use, NULL everywhere, memory that runs out. */
#include "base/arena.h"
#include "base/status.h"
#include "test.h"
#include <stdbool.h>
#include <flexwright.h>
#include <locale.h>
#include <pthread.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#define GALLERY FW_TEST_SOURCE_DIR "/docs/gallery/reference-six-bar/device.xml"
#define OTHER   FW_TEST_SOURCE_DIR "/docs/gallery/leaf-four-bar/device.xml"

static fw_design_options options(void) {
    fw_design_options o = fw_design_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.samples = 51;
    o.hinge_model = "revolute"; /* what is asked here is asked of any model, and pins are fast */
    if (!test_cases(1, 0)) o.corners = "none";
    return o;
}

static fw_design *fresh(void) {
    fw_design_options o = options();
    fw_design *design = fw_design_new(&o);
    assert_non_null(design);
    return design;
}

static const char *text_of(fw_design *design, int document) {
    const char *text;
    size_t n;
    assert_int_equal(fw_design_document(design, document, &text, &n), FW_STATUS_OK);
    assert_int_equal(strlen(text), n);
    return text;
}

static char *file_of(const char *path, size_t *n) {
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    char *data = malloc(1 << 20);
    assert_non_null(data);
    *n = fread(data, 1, 1 << 20, file);
    fclose(file);
    return data;
}

static void statuses_are_those_of_the_rooms(void **state) {
    (void)state;
    for (int i = FW_STATUS_OK; i <= FW_STATUS_INTERNAL; i++)
        assert_string_equal(fw_status_name(i), fw_status_text((fw_status)i));
    assert_string_equal(fw_status_name(-1), "unknown status");
    assert_string_equal(fw_status_name(FW_STATUS_INTERNAL + 1), "unknown status");
    assert_string_equal(fw_library_version(), FW_VERSION);
}

static void a_whole_life(void **state) {
    (void)state;
    fw_design *design = fresh();
    assert_null(fw_design_name(design));
    assert_int_equal(fw_design_decision(design), -1);
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_OK);
    assert_string_equal(fw_design_name(design), "reference-six-bar");
    assert_int_equal(fw_design_judge(design), FW_STATUS_OK);
    assert_int_equal(fw_design_decision(design), 0);
    assert_int_equal(fw_design_fabricate(design), FW_STATUS_OK);
    assert_int_equal(fw_design_simulate(design), FW_STATUS_OK);
    char room[] = "fw-design-XXXXXX", out[64], path[96], command[80];
    assert_non_null(mkdtemp(room));
    snprintf(out, sizeof out, "%s/out", room);
    assert_int_equal(fw_design_write(design, out, FW_DESIGN_EVERYTHING), FW_STATUS_OK);
    static const char *const expected[] = {"verdict.json", "report.html", "manifest.json",
                                           "masks/al-masked-rie.gds", "device.svg"};
    for (size_t i = 0; i < sizeof expected / sizeof expected[0]; i++) {
        snprintf(path, sizeof path, "%s/%s", out, expected[i]);
        assert_int_equal(access(path, R_OK), 0);
    }
    /* the document is the file, and again after writing twice */
    static const struct {
        int document;
        const char *name;
    } same[] = {{FW_DOCUMENT_VERDICT_JSON, "verdict.json"},
                {FW_DOCUMENT_DEVICE_SVG, "device.svg"},
                {FW_DOCUMENT_REPORT_HTML, "report.html"}};
    assert_int_equal(fw_design_write(design, out, FW_DESIGN_EVERYTHING), FW_STATUS_OK);
    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++) {
        size_t n;
        snprintf(path, sizeof path, "%s/%s", out, same[i].name);
        char *file = file_of(path, &n);
        const char *text = text_of(design, same[i].document);
        assert_int_equal(strlen(text), n);
        assert_memory_equal(text, file, n);
        free(file);
    }
    snprintf(path, sizeof path, "%s/motion.csv", room);
    assert_int_equal(fw_design_save(design, FW_DOCUMENT_MOTION_CSV, path), FW_STATUS_OK);
    assert_int_equal(access(path, R_OK), 0);
    assert_int_equal(fw_design_save(design, FW_DOCUMENT_MOTION_CSV, "/nowhere/motion.csv"),
                     FW_STATUS_IO);
    assert_int_equal(fw_design_write(design, "/nowhere\001/../proc/no", 0), FW_STATUS_IO);
    fw_design_free(design);
    snprintf(command, sizeof command, "rm -rf %s", room);
    assert_int_equal(system(command), 0);
}

static void documents_and_their_stages(void **state) {
    (void)state;
    static const struct {
        int document;
        const char *begins;
        int judged, fabricated, simulated; /* there after that stage alone */
    } row[] = {{FW_DOCUMENT_VERDICT_JSON, "{\n", 1, 1, 0},
               {FW_DOCUMENT_VERDICT_TEXT, "reference-six-bar: ACCEPT\n", 1, 1, 0},
               {FW_DOCUMENT_SIMULATE_JSON, "{", 0, 0, 1},
               {FW_DOCUMENT_SIMULATE_TEXT, "scene ", 0, 0, 1},
               {FW_DOCUMENT_MOTION_CSV, "t_s,", 0, 0, 1},
               {FW_DOCUMENT_ANIMATION_SVG, "<", 0, 0, 1},
               {FW_DOCUMENT_MASKS_JSON, "{\"schema\":\"flexwright.masks/1\"", 0, 1, 0},
               {FW_DOCUMENT_RECIPES_JSON, "{\"schema\":\"flexwright.recipes/1\"", 0, 1, 0},
               {FW_DOCUMENT_DEVICE_SVG, "<", 1, 1, 0},
               {FW_DOCUMENT_REPORT_HTML, "<!DOCTYPE html>", 1, 1, 0}};
    for (int stage = 0; stage < 4; stage++) {
        fw_design *design = fresh();
        assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_OK);
        if (stage == 1 || stage == 2) assert_int_equal(fw_design_judge(design), FW_STATUS_OK);
        if (stage == 2) assert_int_equal(fw_design_fabricate(design), FW_STATUS_OK);
        if (stage == 3) assert_int_equal(fw_design_simulate(design), FW_STATUS_OK);
        for (size_t i = 0; i < sizeof row / sizeof row[0]; i++) {
            const int there[] = {0, row[i].judged, row[i].fabricated, row[i].simulated};
            const char *text = "";
            size_t n = 7;
            int status = fw_design_document(design, row[i].document, &text, &n);
            assert_int_equal(status, there[stage] ? FW_STATUS_OK : FW_STATUS_USAGE);
            if (status == FW_STATUS_OK) {
                assert_memory_equal(text, row[i].begins, strlen(row[i].begins) - (i == 0));
                assert_int_equal(strlen(text), n);
                assert_ptr_equal(text, text_of(design, row[i].document)); /* composed once */
            } else {
                assert_null(text);
                assert_int_equal(n, 0);
            }
        }
        fw_design_free(design);
    }
}

static void text_style(void **state) {
    (void)state;
    fw_design *design = fresh();
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_OK);
    assert_int_equal(fw_design_judge(design), FW_STATUS_OK);
    const char *normal = text_of(design, FW_DOCUMENT_VERDICT_TEXT);
    assert_non_null(strstr(normal, "\n  hinge "));
    assert_int_equal(fw_design_text_style(design, FW_DETAIL_QUIET, 1), FW_STATUS_OK);
    const char *quiet = text_of(design, FW_DOCUMENT_VERDICT_TEXT);
    assert_null(strstr(quiet, "\n  hinge "));
    assert_non_null(strstr(quiet, "\033["));
    assert_non_null(strstr(normal, "\n  hinge ")); /* the older text is still there */
    assert_int_equal(fw_design_text_style(design, 2, 0), FW_STATUS_USAGE);
    fw_design_free(design);
}

static void mistakes_have_places(void **state) {
    (void)state;
    static const char wrong[] = "<?xml version=\"1.0\"?>\n"
                                "<device xmlns=\"urn:flexwright:device:1\" name=\"x\">\n"
                                "  <parameter name=\"t\" value=\"10 parsec\"/>\n"
                                "  <nonsense/>\n"
                                "</device>\n";
    fw_design *design = fresh();
    assert_int_equal(fw_design_read_memory(design, "page.xml", wrong, sizeof wrong - 1),
                     FW_STATUS_INPUT);
    bool third = false, fourth = false;
    for (size_t i = 0; i < fw_design_diagnostics(design); i++) {
        const fw_diagnostic *d = fw_design_diagnostic(design, i);
        assert_non_null(d->message);
        assert_true(d->number > 0 && d->column >= 0);
        assert_string_equal(d->file, "page.xml");
        third = third || (d->line == 3 && d->severity == FW_SEVERITY_ERROR);
        fourth = fourth || (d->line == 4 && d->severity == FW_SEVERITY_ERROR);
    }
    assert_true(third && fourth);
    assert_null(fw_design_diagnostic(design, fw_design_diagnostics(design)));
    const char *text = text_of(design, FW_DOCUMENT_DIAGNOSTICS_TEXT);
    assert_non_null(strstr(text, "page.xml:3:"));
    assert_non_null(strstr(text, "   3 |   <parameter name=\"t\""));
    /* what failed stays failed, and says so */
    assert_int_equal(fw_design_judge(design), FW_STATUS_USAGE);
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_USAGE);
    assert_int_equal(fw_design_set(design, "t", "1 um"), FW_STATUS_USAGE);
    assert_null(fw_design_name(design));
    fw_design_free(design);
    design = fresh();
    assert_int_equal(fw_design_read(design, "/nowhere/device.xml"), FW_STATUS_IO);
    assert_string_equal(fw_design_diagnostic(design, 0)->file, "/nowhere/device.xml");
    fw_design_free(design);
    static char large[9 * 1024 * 1024];
    design = fresh();
    assert_int_equal(fw_design_read_memory(design, NULL, large, sizeof large), FW_STATUS_INPUT);
    assert_int_equal(fw_design_diagnostic(design, 0)->number, 221);
    assert_string_equal(fw_design_diagnostic(design, 0)->file, "memory");
    fw_design_free(design);
}

static void memory_is_as_good_as_a_file(void **state) {
    (void)state;
    size_t n;
    char *xml = file_of(GALLERY, &n);
    fw_design *a = fresh(), *b = fresh();
    assert_int_equal(fw_design_read(a, GALLERY), FW_STATUS_OK);
    char name[] = "device.xml";
    assert_int_equal(fw_design_read_memory(b, name, xml, n), FW_STATUS_OK);
    memset(xml, 'x', n); /* ours again */
    memset(name, 'x', sizeof name - 1);
    free(xml);
    assert_int_equal(fw_design_judge(a), FW_STATUS_OK);
    assert_int_equal(fw_design_judge(b), FW_STATUS_OK);
    assert_string_equal(text_of(a, FW_DOCUMENT_VERDICT_JSON), text_of(b, FW_DOCUMENT_VERDICT_JSON));
    assert_string_equal(text_of(a, FW_DOCUMENT_REPORT_HTML), text_of(b, FW_DOCUMENT_REPORT_HTML));
    fw_design_free(a);
    fw_design_free(b);
}

static void values_that_are_set(void **state) {
    (void)state;
    fw_design *design = fresh();
    char path[] = "flexure[leg]/@width", value[] = "10 um";
    for (int i = 0; i < 40; i++) /* the list grows; the last one counts */
        assert_int_equal(fw_design_set(design, "arc", i < 39 ? "500 parsec" : "200 deg"),
                         FW_STATUS_OK);
    assert_int_equal(fw_design_set(design, path, value), FW_STATUS_OK);
    assert_int_equal(fw_design_set(design, "", "1"), FW_STATUS_USAGE);
    memset(path, 'x', sizeof path - 1);
    memset(value, 'x', sizeof value - 1);
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_INPUT); /* no flexure[leg] */
    const char *text = text_of(design, FW_DOCUMENT_DIAGNOSTICS_TEXT);
    assert_non_null(strstr(text, "leg"));
    assert_null(strstr(text, "xxxx"));
    fw_design_free(design);
}

static void two_designs_interleaved(void **state) {
    (void)state;
    fw_design *alone[2], *a = fresh(), *b = fresh();
    const char *file[] = {GALLERY, OTHER};
    for (int i = 0; i < 2; i++) {
        alone[i] = fresh();
        assert_int_equal(fw_design_read(alone[i], file[i]), FW_STATUS_OK);
        assert_int_equal(fw_design_judge(alone[i]), FW_STATUS_OK);
        assert_int_equal(fw_design_fabricate(alone[i]), FW_STATUS_OK);
    }
    assert_int_equal(fw_design_read(a, file[0]), FW_STATUS_OK);
    assert_int_equal(fw_design_read(b, file[1]), FW_STATUS_OK);
    assert_int_equal(fw_design_judge(a), FW_STATUS_OK);
    assert_int_equal(fw_design_judge(b), FW_STATUS_OK);
    assert_int_equal(fw_design_fabricate(b), FW_STATUS_OK);
    assert_int_equal(fw_design_fabricate(a), FW_STATUS_OK);
    fw_design *both[] = {a, b};
    static const int document[] = {FW_DOCUMENT_VERDICT_JSON, FW_DOCUMENT_MASKS_JSON,
                                   FW_DOCUMENT_RECIPES_JSON, FW_DOCUMENT_REPORT_HTML};
    for (int i = 0; i < 2; i++)
        for (size_t k = 0; k < sizeof document / sizeof document[0]; k++)
            assert_string_equal(text_of(both[i], document[k]), text_of(alone[i], document[k]));
    for (int i = 0; i < 2; i++) {
        fw_design_free(alone[i]);
        fw_design_free(both[i]);
    }
}

typedef struct worker {
    const char *file, *want;
    int wrong;
} worker;

static void *work(void *argument) { /* no cmocka in here: it is not made for threads */
    worker *w = argument;
    for (int i = 0, n = test_cases(4, 2); i < n; i++) {
        fw_design_options o = options();
        fw_design *design = fw_design_new(&o);
        const char *text = NULL;
        if (!design || fw_design_read(design, w->file) != FW_STATUS_OK ||
            fw_design_judge(design) != FW_STATUS_OK ||
            fw_design_document(design, FW_DOCUMENT_VERDICT_JSON, &text, NULL) != FW_STATUS_OK ||
            strcmp(text, w->want) != 0)
            w->wrong++;
        fw_design_free(design);
    }
    return NULL;
}

static void designs_in_parallel(void **state) {
    (void)state;
    const int threads = test_cases(4, 2);
    fw_design *alone[2];
    worker w[4] = {0};
    pthread_t thread[4];
    for (int i = 0; i < 2; i++) {
        alone[i] = fresh();
        assert_int_equal(fw_design_read(alone[i], i ? OTHER : GALLERY), FW_STATUS_OK);
        assert_int_equal(fw_design_judge(alone[i]), FW_STATUS_OK);
    }
    for (int i = 0; i < threads; i++) {
        w[i] =
            (worker){i % 2 ? OTHER : GALLERY, text_of(alone[i % 2], FW_DOCUMENT_VERDICT_JSON), 0};
        assert_int_equal(pthread_create(&thread[i], NULL, work, &w[i]), 0);
    }
    for (int i = 0; i < threads; i++) {
        assert_int_equal(pthread_join(thread[i], NULL), 0);
        assert_int_equal(w[i].wrong, 0);
    }
    fw_design_free(alone[0]);
    fw_design_free(alone[1]);
}

static void null_is_wrong_usage(void **state) {
    (void)state;
    const char *text = "";
    size_t n = 1;
    fw_design_options_init(NULL, 8);
    fw_design_free(NULL);
    fw_design_cancel(NULL);
    fw_design_cancel_clear(NULL);
    assert_int_equal(fw_design_set(NULL, "a", "b"), FW_STATUS_USAGE);
    assert_int_equal(fw_design_read(NULL, GALLERY), FW_STATUS_USAGE);
    assert_int_equal(fw_design_read_memory(NULL, "a", "b", 1), FW_STATUS_USAGE);
    assert_int_equal(fw_design_judge(NULL), FW_STATUS_USAGE);
    assert_int_equal(fw_design_fabricate(NULL), FW_STATUS_USAGE);
    assert_int_equal(fw_design_simulate(NULL), FW_STATUS_USAGE);
    assert_int_equal(fw_design_write(NULL, "out", 1), FW_STATUS_USAGE);
    assert_int_equal(fw_design_save(NULL, 0, "out"), FW_STATUS_USAGE);
    assert_int_equal(fw_design_text_style(NULL, 0, 0), FW_STATUS_USAGE);
    assert_int_equal(fw_design_document(NULL, 0, &text, &n), FW_STATUS_USAGE);
    assert_null(text);
    assert_int_equal(n, 0);
    assert_int_equal(fw_design_decision(NULL), -1);
    assert_int_equal(fw_design_diagnostics(NULL), 0);
    assert_null(fw_design_diagnostic(NULL, 0));
    assert_null(fw_design_name(NULL));
    fw_design *design = fw_design_new(NULL);
    assert_non_null(design);
    assert_int_equal(fw_design_set(design, NULL, "b"), FW_STATUS_USAGE);
    assert_int_equal(fw_design_set(design, "a", NULL), FW_STATUS_USAGE);
    assert_int_equal(fw_design_read(design, NULL), FW_STATUS_USAGE);
    assert_int_equal(fw_design_read_memory(design, NULL, NULL, 3), FW_STATUS_USAGE);
    assert_int_equal(fw_design_read_memory(design, NULL, "x", SIZE_MAX), FW_STATUS_USAGE);
    assert_int_equal(fw_design_judge(design), FW_STATUS_USAGE);
    assert_int_equal(fw_design_fabricate(design), FW_STATUS_USAGE);
    assert_int_equal(fw_design_simulate(design), FW_STATUS_USAGE);
    assert_int_equal(fw_design_write(design, "out", 1), FW_STATUS_USAGE);
    assert_int_equal(fw_design_write(design, NULL, 1), FW_STATUS_USAGE);
    assert_int_equal(fw_design_save(design, 0, NULL), FW_STATUS_USAGE);
    assert_int_equal(fw_design_document(design, 0, NULL, NULL), FW_STATUS_USAGE);
    assert_int_equal(fw_design_document(design, -1, &text, NULL), FW_STATUS_USAGE);
    assert_int_equal(fw_design_document(design, 11, &text, NULL), FW_STATUS_USAGE);
    /* each said what was wrong */
    assert_int_equal(fw_design_diagnostics(design), 14);
    for (size_t i = 0; i < 14; i++)
        assert_int_equal(fw_design_diagnostic(design, i)->number, 230);
    /* and the design is still good */
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_OK);
    assert_int_equal(fw_design_judge(design), FW_STATUS_OK);
    assert_int_equal(fw_design_write(design, "out", 32), FW_STATUS_USAGE);
    assert_int_equal(fw_design_write(design, "out", FW_DESIGN_MASKS), FW_STATUS_USAGE);
    fw_design_free(design);
}

static void options_out_of_range(void **state) {
    (void)state;
    for (int i = 0; i < 13; i++) {
        fw_design_options o = options();
        switch (i) {
        case 0:
            o.accuracy = 0.2;
            break;
        case 1:
            o.accuracy = (double)NAN;
            break;
        case 2:
            o.rtol = 1.0;
            break;
        case 3:
            o.rtol = (double)INFINITY;
            break;
        case 4:
            o.samples = 1;
            break;
        case 5:
            o.samples = -5;
            break;
        case 6:
            o.mask_tolerance_m = 0.3e-9;
            break;
        case 7:
            o.mask_tolerance_m = -1.0;
            break;
        case 8:
            o.method = "magic";
            break;
        case 9:
            o.mask_formats = "gds,tiff";
            break;
        case 10:
            o.mask_vertices = 200;
            break;
        case 11:
            o.mask_flatten = "outside";
            break;
        default:
            o.integrator = "";
        }
        fw_design *design = fw_design_new(&o);
        assert_non_null(design);
        assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_USAGE);
        assert_int_equal(fw_design_diagnostics(design), 1);
        fw_design_free(design);
    }
}

/* a caller with an older, shorter struct: what lies behind it is neither read nor written */
static void a_shorter_struct(void **state) {
    (void)state;
    size_t known = offsetof(fw_design_options, accuracy);
    fw_design_options o;
    memset(&o, 0xff, sizeof o);
    fw_design_options_init(&o, known);
    assert_int_equal(o.size, known);
    assert_int_equal(((unsigned char *)&o)[known], 0xff);
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.flow = "al-masked-rie";
    fw_design *design = fw_design_new(&o);
    assert_non_null(design);
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_OK);
    fw_design_free(design);
    /* one that was not initialised, and a longer one with something in the unknown part */
    static const size_t wrong[] = {0, sizeof(size_t), 5000, SIZE_MAX};
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        o = options();
        o.size = wrong[i];
        design = fw_design_new(&o);
        assert_non_null(design);
        assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_USAGE);
        fw_design_free(design);
    }
    struct {
        fw_design_options known;
        double later;
    } longer = {.known = options()};
    longer.known.size = sizeof longer;
    for (int i = 0; i < 2; i++) {
        longer.later = i;
        design = fw_design_new(&longer.known);
        assert_int_equal(fw_design_read(design, GALLERY), i ? FW_STATUS_USAGE : FW_STATUS_OK);
        fw_design_free(design);
    }
    o = options();
    o.memory_cap = 1000; /* too little for anything */
    assert_null(fw_design_new(&o));
}

static void a_cancelled_design(void **state) {
    (void)state;
    fw_design *design = fresh();
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_OK);
    fw_design_cancel(design);
    assert_int_equal(fw_design_simulate(design), FW_STATUS_CANCELLED);
    fw_design_cancel_clear(design);
    assert_int_equal(fw_design_simulate(design), FW_STATUS_OK); /* and again */
    fw_design_free(design);
}

static void the_callers_locale_is_his(void **state) {
    (void)state;
    locale_t own = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    own = duplocale(own); /* not the static one */
    locale_t before = uselocale(own);
    fw_design *design = fresh();
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_OK);
    assert_ptr_equal(uselocale((locale_t)0), own);
    fw_design_free(design);
    assert_ptr_equal(uselocale(before), own);
    freelocale(own);
}

/* 0 or the status of a whole life; *same is whether the verdict came out as it should */
static int life(const char *want, int *same) {
    fw_design_options o = options();
    o.flow = "al-masked-rie";
    fw_design *design = fw_design_new(&o);
    if (!design) return FW_STATUS_NOMEM;
    const char *text = NULL;
    int status = fw_design_set(design, "arc", "240 deg");
    if (status == FW_STATUS_OK) status = fw_design_read(design, GALLERY);
    if (status == FW_STATUS_OK) status = fw_design_judge(design);
    if (status == FW_STATUS_OK) status = fw_design_fabricate(design);
    if (status == FW_STATUS_OK)
        status = fw_design_document(design, FW_DOCUMENT_VERDICT_JSON, &text, NULL);
    *same = want && text && strcmp(want, text) == 0;
    if (status == FW_STATUS_OK)
        status = fw_design_document(design, FW_DOCUMENT_RECIPES_JSON, &text, NULL);
    if (status == FW_STATUS_OK)
        status = fw_design_document(design, FW_DOCUMENT_DIAGNOSTICS_TEXT, &text, NULL);
    for (size_t i = 0; i < fw_design_diagnostics(design); i++)
        if (!fw_design_diagnostic(design, i)) status = FW_STATUS_INTERNAL;
    fw_design_free(design);
    return status;
}

static void memory_runs_out(void **state) {
    (void)state;
    fw_design_options o = options();
    o.flow = "al-masked-rie";
    fw_design *design = fw_design_new(&o);
    assert_int_equal(fw_design_set(design, "arc", "240 deg"), FW_STATUS_OK);
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_OK);
    assert_int_equal(fw_design_judge(design), FW_STATUS_OK);
    const char *want = text_of(design, FW_DOCUMENT_VERDICT_JSON);
    int same;
    fw_arena_fail_at(0, 0);
    assert_int_equal(life(want, &same), FW_STATUS_OK);
    assert_true(same);
    long all = fw_arena_count(), nomem = 0;
    for (long i = 0; i < 60;
         i += test_fewest(test_cases(1, 6),
                          12)) /* dense where the library itself allocates, then over all */
        for (int ever = 0; ever < 2; ever++) {
            long n = i < 30 ? i + 1 : all - (i - 30) * (all / 30);
            fw_arena_fail_at(n, ever);
            int status = life(want, &same);
            fw_arena_fail_at(0, 0);
            nomem += status == FW_STATUS_NOMEM;
            if (status != FW_STATUS_NOMEM && !(status == FW_STATUS_OK && same))
                fail_msg("allocation %ld of %ld%s: status %d", n, all, ever ? " and later" : "",
                         status);
        }
    assert_true(nomem > 30 / test_fewest(test_cases(1, 6), 12));
    fw_design_free(design);
}

/* what the last call said, number of its last error; 0: none */
static int32_t last_of_call(fw_design *design) {
    int32_t number = 0;
    for (size_t i = fw_design_diagnostics_before(design); i < fw_design_diagnostics(design); i++)
        if (fw_design_diagnostic(design, i)->severity == FW_SEVERITY_ERROR)
            number = fw_design_diagnostic(design, i)->number;
    return number;
}

static void a_call_has_its_own_diagnostics(void **state) {
    (void)state;
    assert_int_equal(fw_design_diagnostics_before(NULL), 0);
    fw_design *design = fresh();
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_OK);
    assert_int_equal(fw_design_diagnostics_before(design), 0);
    for (int i = 0; i < 130; i++) {
        assert_int_equal(fw_design_set(design, "t", "1 um"), FW_STATUS_USAGE);
        assert_int_equal(last_of_call(design), 230);
    }
    assert_int_equal(fw_design_diagnostics(design), 100);
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_USAGE);
    assert_string_equal(fw_design_diagnostic(design, 99)->message,
                        "one design reads one description");
    assert_int_equal(fw_design_diagnostics_before(design), 99);
    assert_int_equal(fw_design_simulate(design), FW_STATUS_OK); /* says nothing wrong */
    assert_int_equal(last_of_call(design), 0);
    fw_design_free(design);
}

/* whether the design's own cap refused or the machine is told apart, and each says what helps */
static void want_of_memory_says_whose(void **state) {
    (void)state;
    fw_design_options o = options();
    o.memory_cap = 32 << 20;
    o.samples = 200000;
    fw_design *design = fw_design_new(&o);
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_OK);
    assert_int_equal(last_of_call(design), 0);
    for (int i = 0; i < 2; i++) { /* each call says it */
        assert_int_equal(fw_design_simulate(design), FW_STATUS_NOMEM);
        assert_int_equal(last_of_call(design), 720);
    }
    const fw_diagnostic *d = fw_design_diagnostic(design, fw_design_diagnostics(design) - 1);
    assert_non_null(strstr(d->message, "may take 32 MiB"));
    assert_non_null(strstr(d->message, "memory_cap"));
    assert_int_equal(fw_design_write(design, NULL, 1),
                     FW_STATUS_USAGE); /* and other mistakes are theirs */
    assert_int_equal(last_of_call(design), 230);
    fw_design_free(design);
    design = fresh();
    assert_int_equal(fw_design_read(design, GALLERY), FW_STATUS_OK);
    for (long n = 1; n < 40; n += 13) {
        fw_arena_fail_at(n, 1);
        assert_int_equal(fw_design_simulate(design), FW_STATUS_NOMEM);
        fw_arena_fail_at(0, 0);
        assert_int_equal(last_of_call(design), 721);
    }
    assert_int_equal(fw_design_simulate(design), FW_STATUS_OK);
    fw_design_free(design);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(statuses_are_those_of_the_rooms),
        cmocka_unit_test(a_whole_life),
        cmocka_unit_test(documents_and_their_stages),
        cmocka_unit_test(text_style),
        cmocka_unit_test(mistakes_have_places),
        cmocka_unit_test(memory_is_as_good_as_a_file),
        cmocka_unit_test(values_that_are_set),
        cmocka_unit_test(two_designs_interleaved),
        cmocka_unit_test(designs_in_parallel),
        cmocka_unit_test(null_is_wrong_usage),
        cmocka_unit_test(options_out_of_range),
        cmocka_unit_test(a_shorter_struct),
        cmocka_unit_test(a_cancelled_design),
        cmocka_unit_test(the_callers_locale_is_his),
        cmocka_unit_test(memory_runs_out),
        cmocka_unit_test(a_call_has_its_own_diagnostics),
        cmocka_unit_test(want_of_memory_says_whose),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
