/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Descriptions that are mostly valid, through judging, masks, recipes and documents, each with little memory and half a second
   of the processor: then it is cancelled, as a user would. The first byte says what is asked of it. What must hold: it ends as it
   says, what it writes is JSON, what was cancelled stops (how long that takes is printed, the longest), and two methods that
   both say how exact they are agree within what they say.

   With FUZZ_ALONE: fuzzed_judge RUNS [SEED [NUMBER]], of which NUMBER alone is run and kept as kept.xml; the same on every machine but for what the limit of time cuts off. */
#include "device/device_table.h"
#include "flexwright.h"
#include "mutate.h"
#include <glob.h>
#include <jansson.h>
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/time.h>
#include <time.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t n, size_t most, unsigned seed);

static const double LIMIT_S = 0.5; /* of 200 runs 8 take longer than twice that, and half of all the time */
static fw_design *running;
static double cancelled_s, longest_s;
static long compared, agreed, judged, stopped;

static double cpu_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void wrong(const char *what) {
    fprintf(stderr, "fuzz_judge: %s\n", what);
    abort();
}

static void over(int number) {
    (void)number;
    if (running) fw_design_cancel(running);
    if (cancelled_s == 0) cancelled_s = cpu_s();
}

static void timer(double seconds) {
    struct itimerval t = {
        .it_value = {(time_t)seconds, (suseconds_t)(1e6 * (seconds - floor(seconds)))}};
    setitimer(ITIMER_PROF, &t, NULL);
}

static fw_design *begin(const char *text, size_t n, unsigned how, const char *method) {
    fw_design_options o = fw_design_options_default();
    o.data_directory = FW_TEST_SOURCE_DIR;
    o.accuracy = how & 1 ? 0.1 : 0.05;
    o.corners = how & 6 ? "none" : "auto"; /* most of the time where all are judged, and advice takes as long again */
    o.advice = how & 24 ? "none" : "auto";
    o.hinge_model = how & 2 ? "auto" : "revolute";
    o.mask_formats = "all";
    o.force = 1;
    o.memory_cap = (size_t)128 << 20;
    if (method) o.method = method, o.rtol = 1e-8, o.samples = 3;
    running = fw_design_new(&o);
    if (!running) return NULL;
    return fw_design_read_memory(running, "f.xml", text, n) == FW_STATUS_OK ? running : NULL;
}

static int ends(int status) {
    if (status < 0 || status == FW_STATUS_INTERNAL ||
        strcmp(fw_status_name(status), "unknown status") == 0)
        wrong(fw_status_name(status));
    return status == FW_STATUS_OK;
}

static json_t *document(int which) {
    const char *text;
    size_t n;
    if (fw_design_document(running, which, &text, &n) != FW_STATUS_OK) return NULL;
    json_error_t error;
    json_t *root = json_loadb(text, n, JSON_REJECT_DUPLICATES, &error);
    if (!root) wrong(error.text);
    return root;
}

static void texts(const int *which, size_t n) {
    for (size_t i = 0; i < n; i++) {
        const char *text;
        size_t length;
        if (fw_design_document(running, which[i], &text, &length) == FW_STATUS_OK &&
            strlen(text) != length)
            wrong("a document with a NUL");
    }
}

static void judge(const char *text, size_t n, unsigned how) {
    static const int said[] = {FW_DOCUMENT_VERDICT_TEXT, FW_DOCUMENT_DEVICE_SVG,
                               FW_DOCUMENT_REPORT_HTML, FW_DOCUMENT_DIAGNOSTICS_TEXT};
    if (begin(text, n, how, NULL) && ends(fw_design_judge(running))) {
        judged++;
        json_decref(document(FW_DOCUMENT_VERDICT_JSON));
        if (ends(fw_design_fabricate(running))) {
            json_decref(document(FW_DOCUMENT_MASKS_JSON));
            json_decref(document(FW_DOCUMENT_RECIPES_JSON));
        }
        texts(said, sizeof said / sizeof *said);
    }
    if (running) json_decref(document(FW_DOCUMENT_DIAGNOSTICS_JSON));
}

static void others(const char *text, size_t n, unsigned how) {
    if (!begin(text, n, how, NULL)) return;
    static const int said[] = {FW_DOCUMENT_STATICS_SVG, FW_DOCUMENT_ASSEMBLE_SVG,
                               FW_DOCUMENT_MODES_SVG, FW_DOCUMENT_WORKSPACE_SVG};
    if (ends(fw_design_statics(running))) json_decref(document(FW_DOCUMENT_STATICS_JSON));
    if (ends(fw_design_assemble(running))) json_decref(document(FW_DOCUMENT_ASSEMBLE_JSON));
    if (ends(fw_design_modes(running))) json_decref(document(FW_DOCUMENT_MODES_JSON));
    if (ends(fw_design_workspace(running))) json_decref(document(FW_DOCUMENT_WORKSPACE_JSON));
    texts(said, sizeof said / sizeof *said);
}

/* the peaks of all hinges by one method; NULL: not computed */
static json_t *peaks(const char *text, size_t n, const char *method) {
    json_t *found = NULL;
    if (begin(text, n, 30, method) && ends(fw_design_simulate(running)) &&
        !fw_design_unreliable(running)) {
        json_t *root = document(FW_DOCUMENT_SIMULATE_JSON);
        found = json_incref(json_object_get(root, "peaks"));
        json_decref(root);
    }
    fw_design_free(running);
    running = NULL;
    return found;
}

static double number(const json_t *object, const char *key) {
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? json_number_value(value) : (double)NAN;
}

static void two_methods(const char *text, size_t n) {
    json_t *a = peaks(text, n, "chain");
    json_t *b = cancelled_s > 0 ? NULL : peaks(text, n, "udwadia-kalaba"); /* its time is over */
    for (size_t i = 0; a && b && i < json_array_size(a) && json_array_size(a) == json_array_size(b);
         i++) {
        const json_t *p = json_array_get(a, i), *q = json_array_get(b, i);
        const double x = number(p, "angle_rad"), y = number(q, "angle_rad");
        const double band = number(p, "error_rad") + number(q, "error_rad");
        if (!isfinite(x) || !isfinite(y) || !isfinite(band)) continue;
        compared++;
        const double by = fabs(fabs(x) - fabs(y));
        if (by <= 3 * band + 1e-6 * fabs(x) + 1e-9)
            agreed++;
        else
            fprintf(stderr, "two methods: hinge %s: %.9g and %.9g rad, said to be within %.2g\n",
                    json_string_value(json_object_get(p, "hinge")), x, y, band);
    }
    json_decref(a);
    json_decref(b);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n) {
    if (n < 2) return 0;
    static int ready;
    if (!ready) signal(SIGPROF, over), ready = 1;
    const char *text = (const char *)data + 1;
    cancelled_s = 0;
    timer(LIMIT_S);
    switch (data[0] % 8) {
    case 0:
    case 1:
    case 2:
        others(text, n - 1, data[0] / 8u);
        break;
    case 3:
        two_methods(text, n - 1);
        break;
    default:
        judge(text, n - 1, data[0] / 8u);
        break;
    }
    timer(0);
    stopped += cancelled_s > 0;
    if (getenv("FUZZ_SAY") && running && fw_design_diagnostics(running) > 0)
        fprintf(stderr, "%d: %s\n", data[0] % 8, fw_design_diagnostic(running, 0)->message);
    if (cancelled_s > 0 && cpu_s() - cancelled_s > longest_s) longest_s = cpu_s() - cancelled_s;
    fw_design_free(running);
    running = NULL;
    return 0;
}

/* numbers mostly, and half of the time one alone: a description that is refused does not come far */
static void change(fuzz_text *text) {
    for (size_t k = fuzz_below(2) ? 1 : 1 + fuzz_below(3); k > 0; k--)
        fuzz_mutate_number(text);
    if (fuzz_below(4) == 0) fuzz_mutate_xml(text, &fw_device_table);
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t n, size_t most, unsigned seed) {
    if (n < 1) return n;
    fuzz_seed = 0x9e3779b97f4a7c15ULL ^ ((uint64_t)seed << 17 | seed);
    fuzz_text text = {(char *)data + 1, n - 1, most - 1};
    if (fuzz_below(4) == 0) data[0] = (uint8_t)fuzz_below(256);
    change(&text);
    return text.n + 1;
}

#ifdef FUZZ_ALONE
enum { ROOM = 1 << 18 }; /* the last byte ends the text */

int main(int argc, char **argv) {
    const long runs = argc > 1 ? strtol(argv[1], NULL, 10) : 100;
    const uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    const long only = argc > 3 ? strtol(argv[3], NULL, 10) : -1;
    static const char *const patterns[] = {"docs/gallery/*/device.xml", "tests/data/*/*.xml",
                                           "docs/mechanisms/*.xml"};
    unsigned char *room = malloc(ROOM);
    glob_t found = {0};
    if (!room) return 1;
    fuzz_seed ^= seed * 0x2545f4914f6cdd1dULL;
    for (size_t i = 0; i < sizeof patterns / sizeof *patterns; i++) {
        char path[512];
        snprintf(path, sizeof path, FW_TEST_SOURCE_DIR "/%s", patterns[i]);
        if (glob(path, i ? GLOB_APPEND : 0, NULL, &found) != 0) wrong(path);
    }
    for (long i = 0; i < runs; i++) {
        FILE *file = fopen(found.gl_pathv[fuzz_below(found.gl_pathc)], "rb");
        if (!file) return 1;
        size_t n = 1 + fread(room + 1, 1, ROOM - 2, file);
        fclose(file);
        room[0] = (unsigned char)fuzz_below(256);
        fuzz_text text = {(char *)room + 1, n - 1, ROOM - 2};
        change(&text);
        room[text.n + 1] = '\0';
        if (room[0] % 8 > 3 && !strstr((char *)room + 1, "<material")) room[0] &= 0xfb; /* not judged */
        if (only >= 0 && i != only) continue;
        if (only >= 0) {
            FILE *kept = fopen("kept.xml", "wb");
            if (kept) fwrite(room + 1, 1, text.n, kept), fclose(kept);
            printf("run %ld asks for %d, options %u\n", i, room[0] % 8, room[0] / 8u);
        }
        const double before = cpu_s();
        LLVMFuzzerTestOneInput(room, text.n + 1);
        if (cpu_s() - before > 3 * LIMIT_S)
            printf("run %ld took %.1f s of the processor\n", i, cpu_s() - before);
    }
    globfree(&found);
    free(room);
    printf("%ld runs, %ld judged to the end, %ld stopped; %ld of %ld peaks by two methods within "
           "what they say; "
           "longest %.2f s to stop\n",
           runs, judged, stopped, agreed, compared, longest_s);
    return agreed != compared;
}
#endif
