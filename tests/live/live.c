/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The functions behind the page, without a server:
     live KIND <REQUEST          the answer to one request (table, preview, picture, pose, edit, explore)
     live memory [COUNT]         10 000 requests in one process: what it holds must not grow
     live designs [COUNT]        1000 designs, one after the other, as a user of the library makes them: what the process
                                 holds (memory, files) must not grow
     live speed FILE NAME FROM TO UNIT [N]
                                 previews with a parameter moved like a slider; percentiles of CPU
 */
#include "plan/live.h"
#include "study/study.h"
#include <dirent.h>
#include <flexwright.h>
#include <jansson.h>
#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST = 32 << 20 };

static char *read_all(FILE *f, size_t *n) {
    char *data = malloc(MOST);
    if (!f || !data) {
        fputs("live: cannot read\n", stderr);
        exit(2);
    }
    *n = fread(data, 1, MOST - 1, f);
    data[*n] = '\0';
    return data;
}

typedef fw_plan_live_answer (*function)(fw_plan_live *live, const char *request, size_t n);

static fw_plan_live_answer table(fw_plan_live *live, const char *request, size_t n) {
    (void)request, (void)n;
    return fw_plan_live_table(live);
}

static function named(const char *kind) {
    return strcmp(kind, "table") == 0     ? table
           : strcmp(kind, "preview") == 0 ? fw_plan_live_preview
           : strcmp(kind, "picture") == 0 ? fw_plan_live_picture
           : strcmp(kind, "pose") == 0    ? fw_plan_live_pose
           : strcmp(kind, "edit") == 0    ? fw_plan_live_edit
           : strcmp(kind, "explore") == 0 ? fw_study_explore
                                          : NULL;
}

static int once(fw_plan_live *live, function f) {
    size_t n = 0;
    char *request = f == table ? NULL : read_all(stdin, &n);
    fw_plan_live_answer a = f(live, request, n);
    fwrite(a.text, 1, a.length, stdout);
    free(request);
    return a.status == FW_OK ? 0 : 2;
}

/* {"text": of the file, "set": {...}, ...} */
static char *request_of(const char *file, json_t *more) {
    size_t n;
    FILE *f = fopen(file, "rb");
    char *text = read_all(f, &n);
    fclose(f);
    json_t *root = json_pack("{s:s#}", "text", text, (int)n);
    json_object_update(root, more);
    char *request = json_dumps(root, JSON_COMPACT);
    json_decref(root);
    json_decref(more);
    free(text);
    return request;
}

static double cpu_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- memory ---- */

static size_t held(void) {
    struct mallinfo2 m = mallinfo2();
    return m.uordblks + m.hblkhd;
}

static void must(fw_plan_live_answer a, const char *part) {
    if (a.status == FW_OK && strstr(a.text, part)) return;
    fprintf(stderr, "live memory: no %s in %.300s\n", part, a.text);
    exit(1);
}

/* small mechanisms, devices with flexures, poses, changes, mistakes. What may be held besides goes with their number: the
   least block that each rarer request, one of 50, would lose is more */
static int memory(fw_plan_live *live, int rounds) {
    enum { WARM = 500 };
    const size_t allowed = (size_t)(4096L * (rounds - WARM) / 9500);
    static const char small[] = "tests/data/effect-costs/free.xml";
    static const char six_bar[] = "docs/gallery/reference-six-bar/device.xml";
    char *few = request_of(small, json_pack("{s:{s:i}}", "options", "samples", 20));
    char *whole = request_of(six_bar, json_object());
    char *wrong = request_of(six_bar, json_pack("{s:{s:s}}", "set", "arc", "7 deg"));
    char *drag = request_of(six_bar, json_pack("{s:{s:f}}", "platform", "x_m", 1e-4));
    char *change = request_of(
        six_bar, json_pack("{s:[{s:s,s:s}]}", "changes", "path", "arc", "value", "200 deg"));
    size_t before = 0;
    for (int i = 0; i < rounds; i++) {
        if (i % 50 == 0)
            must(fw_plan_live_preview(live, whole, strlen(whole)), "\"accept\"");
        else if (i % 50 == 1)
            must(fw_plan_live_preview(live, wrong, strlen(wrong)), "\"invalid\"");
        else if (i % 50 == 2)
            must(fw_plan_live_edit(live, change, strlen(change)), "200 deg");
        else if (i % 10 == 3)
            must(fw_plan_live_pose(live, drag, strlen(drag)), "\"reachable\":true");
        else if (i % 50 == 4)
            must(fw_plan_live_table(live), "flexure");
        else if (i % 50 == 5 && fw_plan_live_preview(live, few, 9).status != FW_USAGE)
            exit(1);
        else
            must(fw_plan_live_preview(live, few, strlen(few)), "\"motion\":{");
        if (i == WARM - 1) before = held(); /* as is the last: of one kind */
    }
    size_t after = held();
    printf("%d requests: %zu bytes held behind the first %d, %zu at the end\n", rounds, before,
           WARM, after);
    free(few), free(whole), free(wrong), free(drag), free(change);
    return after > before + allowed;
}

/* ---- designs ---- */

static int open_files(void) {
    DIR *all = opendir("/proc/self/fd");
    int n = 0;
    while (all && readdir(all))
        n++;
    if (all) closedir(all);
    return n;
}

/* one design by its number: accepted with masks and recipes, drawn differently, simulated, a wrong file, wrong values, too
   little memory, cancelled */
static void design_of(int i) {
    static const char leaf[] = "docs/gallery/leaf-four-bar/device.xml";
    static const char free_[] = "tests/data/effect-costs/free.xml";
    fw_design_options o = fw_design_options_default();
    const int kind = i % 10;
    o.data_directory = ".";
    o.accuracy = 0.1, o.samples = 11, o.corners = "none", o.advice = "none";
    o.mask_formats = "all";
    if (kind == 3) o.memory_cap = (size_t)16 << 20;
    fw_design *d = fw_design_new(&o);
    if (!d) exit(1);
    if (kind == 4) fw_design_set(d, "width", "7 deg");
    int status = fw_design_read(d, kind == 5 ? "CHANGELOG.md" : kind < 5 ? leaf : free_);
    if (kind == 6) fw_design_cancel(d);
    if (status == FW_STATUS_OK) status = kind < 5 ? fw_design_judge(d) : fw_design_simulate(d);
    if (status == FW_STATUS_OK && kind < 2) status = fw_design_fabricate(d);
    const char *text = "";
    const int document = kind >= 5  ? FW_DOCUMENT_SIMULATE_JSON
                         : kind < 2 ? FW_DOCUMENT_REPORT_HTML
                                    : FW_DOCUMENT_VERDICT_JSON;
    if (status == FW_STATUS_OK) fw_design_document(d, document, &text, NULL);
    const int wanted = kind == 4 || kind == 5 ? FW_STATUS_INPUT
                       : kind == 6            ? FW_STATUS_CANCELLED
                                              : FW_STATUS_OK;
    if (status != wanted && kind != 3) {
        fprintf(stderr, "live designs: kind %d ended with %s\n", kind, fw_status_name(status));
        exit(1);
    }
    fw_design_document(d, FW_DOCUMENT_DIAGNOSTICS_TEXT, &text, NULL);
    fw_design_free(d);
}

/* each kind once before, for what is kept for good (fonts of pictures). Allocators of libraries keep a few hundred bytes more
   or less; a block of 16 bytes that one kind loses each time is 1600 in a thousand, an arena's is 4096 in ten */
static int designs(int rounds) {
    enum { WARM = 10, ALLOWED = 1024 };
    size_t before = 0;
    int files = 0;
    for (int i = 0; i < rounds + WARM; i++) {
        if (i == WARM) before = held(), files = open_files();
        design_of(i);
    }
    const size_t after = held(); /* before anything is printed, which takes a buffer */
    const int left = open_files();
    printf("%d designs: %zu bytes and %d files held before, %zu and %d behind them\n", rounds,
           before, files, after, left);
    return after > before + ALLOWED || left != files;
}

/* ---- speed ---- */

static int rising(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static int speed(fw_plan_live *live, int argc, char **argv) {
    int n = argc > 7 ? atoi(argv[7]) : 100;
    double from = atof(argv[4]), to = atof(argv[5]);
    double *spent = calloc((size_t)(n > 0 ? n : 1), sizeof *spent);
    if (!spent || n < 1) return 2;
    for (int i = 0; i < n; i++) {
        char value[64];
        snprintf(value, sizeof value, "%.6g %s", from + (to - from) * i / (n > 1 ? n - 1 : 1),
                 argv[6]);
        char *request = request_of(argv[2], json_pack("{s:{s:s}}", "set", argv[3], value));
        double start = cpu_s();
        fw_plan_live_answer a = fw_plan_live_preview(live, request, strlen(request));
        spent[i] = cpu_s() - start;
        if (a.status != FW_OK || !strstr(a.text, "\"status\":\"ok\""))
            printf("%s: %.200s\n", value, a.text);
        free(request);
    }
    qsort(spent, (size_t)n, sizeof *spent, rising);
    printf("%d previews: CPU median %.1f ms, 95 %% %.1f ms, most %.1f ms\n", n, 1e3 * spent[n / 2],
           1e3 * spent[(int)(0.95 * n)], 1e3 * spent[n - 1]);
    free(spent);
    return 0;
}

int main(int argc, char **argv) {
    fw_plan_live *live = fw_plan_live_new(NULL);
    function f = argc > 1 ? named(argv[1]) : NULL;
    int status = 2;
    if (live && f)
        status = once(live, f);
    else if (live && argc > 1 && strcmp(argv[1], "memory") == 0)
        status = memory(live, argc > 2 && atoi(argv[2]) > 1000 ? atoi(argv[2]) : 10000);
    else if (argc > 1 && strcmp(argv[1], "designs") == 0)
        status = designs(argc > 2 && atoi(argv[2]) > 0 ? atoi(argv[2]) : 1000);
    else if (live && argc > 6 && strcmp(argv[1], "speed") == 0)
        status = speed(live, argc, argv);
    else
        fputs("live table|preview|picture|pose|edit|memory|speed ...; see tests/live/live.c\n", stderr);
    fw_plan_live_free(live);
    return status;
}
