/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Every file that somebody else may have written, each by its reader: the first byte says which. Inputs are changed by the tables
   of their rows (mutate.c), so that most of them come past the reader's first complaints. What must hold beside no crash: a
   status and its messages agree; no message gives orders to a terminal; what the program writes of it, it reads again.

   As a program of libFuzzer (FW_FUZZ, clang), by tests/build/fuzz.sh; and alone, with FUZZ_ALONE:
   fuzzed_files RUNS [SEED]  starts from files of this tree, and is the same on every machine
   fuzzed_files RUNS SEED KIND  only this kind, "log"
   fuzzed_files corpus DIR   writes these files as inputs of the other one, of kind K into DIR/K where that is there
   fuzzed_files inputs DIR...  reads what the other one found, for coverage.py
   fuzzed_files kinds        their names, by number

   What readers need beside an input is read once and put back: packs take a hundred times as long to read as an entry of a log. */
#include "base/output.h"
#include "device/device_table.h"
#include "drawing/drawing.h"
#include "mask/mask_parts.h"
#include "mutate.h"
#include "process/pack.h"
#include "recipe/asrun.h"
#include "serve/server.h"
#include "study/study.h"
#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t n, size_t most, unsigned seed);
size_t LLVMFuzzerMutate(uint8_t *data, size_t n, size_t most); /* of the fuzzer */

static void wrong(const char *what) {
    fprintf(stderr, "fuzz_files: %s\n", what);
    abort();
}

/* a status and what was said: FW_OK without errors, FW_INPUT with one; every message is a line */
static void agree(fw_status s, const fw_diags *diags) {
    if (s == FW_OK && diags->errors > 0) wrong("FW_OK, and errors were said");
    if (s == FW_INPUT && diags->errors == 0) wrong("FW_INPUT without a message");
    if (s != FW_OK && s != FW_INPUT && s != FW_NOMEM && s != FW_LIMIT) wrong(fw_status_text(s));
    for (size_t i = 0; i < diags->count; i++) {
        if (!fw_text_is_line(diags->item[i].message)) wrong(diags->item[i].message);
        if (diags->item[i].place.line < 0 || diags->item[i].place.column < 0)
            wrong("a place below the first");
    }
}

/* ---- what readers need beside the file ---- */

static fw_arena *kept, *of_flow,
    *scratch; /* for good; of the flow alone; of one input, then emptied */
static const char *base_text, *flow_text;
static size_t base_n, flow_n;
static fw_process_flow
    *usual; /* of flow_text: to read it takes a hundred times as long as what is asked of it */
static bool changed; /* by the input before */
static fw_arena_copy flow_as_read, emptied;

static const char *tree_file(const char *name, size_t *n) {
    fw_diags diags = fw_diags_new(kept);
    char *data = NULL;
    const char *path = fw_arena_printf(kept, FW_TEST_SOURCE_DIR "/%s", name);
    if (!path || fw_input_read(kept, path, (size_t)1 << 23, &diags, &data, n) != FW_OK) wrong(name);
    return data;
}

static const fw_process_mask_facts facts = {.structure_area_m2 = 5e-6,
                                            .die_area_m2 = 28e-6,
                                            .perimeter_m = 0.08,
                                            .narrowest_slot_m = 10e-6,
                                            .narrowest_line_m = 10e-6,
                                            .deepest_hinge_width_m = 10e-6,
                                            .dies = 30};

static fw_status read_flow(fw_arena *arena, const char *text, size_t n, fw_diags *diags,
                           fw_process_flow **flow) {
    fw_status s = fw_process_flow_read(arena, "base.xml", base_text, base_n, "flow.xml", text, n,
                                       diags, flow);
    agree(s, diags);
    return s;
}

static void prepare(void) {
    if (kept) return;
    kept = fw_arena_new(0), of_flow = fw_arena_new(0);
    scratch = fw_arena_new((size_t)64 * 1024 * 1024);
    if (!kept || !of_flow || !scratch) exit(1);
    base_text = tree_file("processes/base.xml", &base_n);
    flow_text = tree_file("processes/al-masked-rie.xml", &flow_n);
    fw_diags diags = fw_diags_new(kept);
    if (read_flow(of_flow, flow_text, flow_n, &diags, &usual) != FW_OK) wrong("the flow");
    if (!fw_arena_copy_take(of_flow, &flow_as_read) || !fw_arena_copy_take(scratch, &emptied)) exit(1);
}

/* the flow that it was, whatever the input before did to it */
static fw_process_flow *flow_again(bool to_be_changed) {
    if (changed) fw_arena_copy_put_back(of_flow, &flow_as_read);
    changed = to_be_changed;
    return usual;
}

/* ---- the readers ---- */

static void a_device(fw_arena *arena, fw_diags *diags, const char *text, size_t n) {
    const fw_device *device;
    fw_status s = fw_device_read(arena, "f", text, n, NULL, 0, diags, &device);
    agree(s, diags);
    if (s == FW_OK && !device) wrong("FW_OK without a device");
}

static void a_flow(fw_arena *arena, fw_diags *diags, const char *text, size_t n) {
    fw_process_flow *flow;
    if (read_flow(arena, text, n, diags, &flow) == FW_OK)
        fw_process_flow_compute(arena, flow, &facts, diags);
}

static void a_laboratory(fw_arena *arena, fw_diags *diags, const char *text, size_t n) {
    fw_process_flow *flow = NULL;
    fw_process_choice *choice = NULL;
    int nchoice = 0;
    fw_process_lab_choices(arena, "lab.xml", text, n, "al-masked-rie", &choice, &nchoice);
    if (nchoice == 0)
        flow = flow_again(true);
    else if (fw_process_flow_read_chosen(arena, "base.xml", base_text, base_n, "flow.xml",
                                         flow_text, flow_n, choice, nchoice, NULL, diags,
                                         &flow) != FW_OK)
        return;
    if (diags->errors > 0) return;
    fw_diags own = fw_diags_new(arena);
    fw_status s = fw_process_lab_apply(arena, "lab.xml", text, n, flow, &own);
    agree(s, &own);
    if (s == FW_OK) fw_process_flow_compute(arena, flow, &facts, &own);
}

static void a_layer_table(fw_arena *arena, fw_diags *diags, const char *text, size_t n) {
    fw_mask_table table;
    agree(fw_mask_table_read(arena, "m.xml", text, n, diags, &table), diags);
}

static void a_study(fw_arena *arena, fw_diags *diags, const char *text, size_t n) {
    const fw_device_study *study;
    agree(fw_device_study_read(arena, "s.xml", text, n, diags, &study), diags);
}

static void materials(fw_arena *arena, fw_diags *diags, const char *text, size_t n) {
    fw_device_materials found;
    agree(fw_device_materials_read(arena, "base.xml", text, n, diags, &found), diags);
}

static void a_layer_map(fw_arena *arena, fw_diags *diags, const char *text, size_t n) {
    fw_mask_layer_map map;
    agree(fw_mask_layer_map_read(arena, "layers.txt", text, n, diags, &map), diags);
}

/* a log of these lines, each with its chain: a stranger can write that, too; the last one also as words of --entry */
static void a_log(fw_arena *arena, fw_diags *diags, const char *text, size_t n) {
    static const char plan[] = "00112233445566778899aabbccddeeff00112233445566778899aabbccddeeff";
    const fw_process_flow *flow = flow_again(false);
    fw_text log = fw_text_new(arena);
    char chain[65] = "";
    for (const char *at = text; at < text + n;) {
        const char *end = memchr(at, '\n', (size_t)(text + n - at));
        if (!end) end = text + n;
        const char *both = fw_arena_printf(arena, "%s\n%.*s", chain, (int)(end - at), at);
        if (!both) return;
        fw_sha256(both, strlen(both), chain);
        fw_text_bytes(&log, at, (size_t)(end - at));
        fw_text_printf(&log, "\tchain=%s\n", chain);
        at = end + 1;
    }
    fw_recipe_asrun run;
    if (fw_text_end(&log) != FW_OK || !log.data) return;
    fw_status s =
        fw_recipe_asrun_read(arena, flow, NULL, "lot.log", log.data, log.length, diags, &run);
    agree(s, diags);
    if (s == FW_OK) {
        fw_text out[3] = {fw_text_new(arena), fw_text_new(arena), fw_text_new(arena)};
        if (fw_recipe_asrun_write_text(flow, &run, &out[0]) == FW_OK)
            for (const char *c = out[0].data; *c; c++)
                if ((unsigned char)*c < ' ' && *c != '\n')
                    wrong("a control character in a table of the log");
        fw_recipe_asrun_write_json(flow, &run, &out[1]);
        fw_recipe_asrun_write_html(flow, &run, &out[2]);
    }
    /* words of --entry: what is taken is read again */
    const char *first, *line, *words = fw_arena_strndup(arena, text, n);
    fw_diags own = fw_diags_new(arena);
    if (!words || fw_recipe_asrun_begin(arena, flow, plan, "lot", "3", NULL, &first) != FW_OK) return;
    if (fw_recipe_asrun_read(arena, flow, plan, "lot.log", first, strlen(first), &own, &run) !=
        FW_OK)
        wrong("a log that begins");
    s = fw_recipe_asrun_add(arena, flow, &run, words, (fw_place){"entry", 1, 1}, (double)NAN, &own,
                            &line);
    agree(s, &own);
    const char *whole = s == FW_OK ? fw_arena_printf(arena, "%s%s", first, line) : NULL;
    own = fw_diags_new(arena);
    if (whole && fw_recipe_asrun_read(arena, flow, plan, "lot.log", whole, strlen(whole), &own,
                                      &run) == FW_INPUT)
        wrong(own.item[0].message);
}

/* measured values; the pack that follows is one */
static void measured(fw_arena *arena, fw_diags *diags, const char *text, size_t n) {
    fw_process_flow *flow = flow_again(true);
    fw_process_measurement *row;
    fw_process_calibration found;
    int count;
    fw_status s = fw_process_measurements_read(arena, "lot.csv", text, n, diags, &row, &count);
    agree(s, diags);
    if (s != FW_OK) return;
    s = fw_process_calibrate(arena, flow, row, count, diags, &found);
    agree(s, diags);
    fw_text pack = fw_text_new(arena), said = fw_text_new(arena);
    if (s != FW_OK || fw_process_calibration_pack(flow, &found, "lot\x1b.csv", "0123456789abcdef",
                                                  &pack) != FW_OK)
        return;
    fw_process_calibration_text(flow, &found, &said);
    fw_diags own = fw_diags_new(arena);
    s = fw_process_lab_apply(arena, "lab.xml", pack.data, pack.length, flow, &own);
    /* values beyond what makes sense are said of the pack as of the table */
    for (size_t i = 0; s == FW_INPUT && i < own.count; i++)
        if (own.item[i].severity == FW_ERROR && own.item[i].number != 278 &&
            own.item[i].number != 211 && own.item[i].number != 530)
            wrong(own.item[i].message);
}

/* ---- a cell written as plain polygons, in both formats, is read as the same ---- */

enum {
    POINTS_MOST = 600
}; /* of what is written again: a DXF file's lines are compared each with each */

static void word16(fw_text *out, unsigned v) {
    const char byte[2] = {(char)(v >> 8), (char)v};
    fw_text_bytes(out, byte, 2);
}

static void word32(fw_text *out, double nm) {
    const unsigned v = (unsigned)(int)lround(nm);
    word16(out, v >> 16), word16(out, v & 0xffff);
}

/* a library of one cell "A", whose unit is 1 nm */
static void as_gds(const fw_drawing_cell_layer *layer, fw_text *out) {
    static const char head[] =
        "\0\6\0\2\2\x58\0\x1c\1\2\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\6\2\6L\0"
        "\0\x14\3\5\x3e\x41\x89\x37\x4b\xc6\xa7\xf0\x39\x44\xb8\x2f\xa0\x9b\x5a\x54"
        "\0\x1c\5\2\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\6\6\6A";
    static const char begin[] = "\0\4\x08\0\0\6\x0d\2\0\1\0\6\x0e\2\0";
    fw_text_bytes(out, head, sizeof head);
    for (int i = 0; i < layer->n; i++) {
        const fw_geometry_contour *c = &layer->outline[i];
        fw_text_bytes(out, begin, sizeof begin);
        word16(out, 8 * ((unsigned)c->count + 1) + 4), word16(out, 0x1003);
        for (int k = 0; k <= c->count; k++) {
            const fw_geometry_vec2 at = c->segment[k % c->count].a;
            word32(out, at.x * 1e9), word32(out, at.y * 1e9);
        }
        fw_text_bytes(out, "\0\4\x11", 4);
    }
    fw_text_bytes(out, "\0\4\7\0\0\4\4", 8);
}

static void as_dxf(const fw_drawing_cell_layer *layer, fw_text *out) {
    fw_text_printf(out, "0\nSECTION\n2\nENTITIES\n");
    for (int i = 0; i < layer->n; i++) {
        const fw_geometry_contour *c = &layer->outline[i];
        fw_text_printf(out, "0\nLWPOLYLINE\n8\n1\n90\n%d\n70\n1\n", c->count);
        for (int k = 0; k < c->count; k++)
            fw_text_printf(out, "10\n%.9f\n20\n%.9f\n", c->segment[k].a.x * 1e6,
                           c->segment[k].a.y * 1e6);
    }
    fw_text_printf(out, "0\nENDSEC\n0\nEOF\n");
}

static double area(const fw_drawing_cell_layer *layer) {
    double sum = 0;
    for (int i = 0; i < layer->n; i++)
        sum += fw_geometry_contour_area(&layer->outline[i]);
    return sum;
}

static void written_again(fw_arena *arena, const fw_drawing_cell_layer *layer, bool gds) {
    const fw_drawing_cell_asked asked = {.file = "f",
                                         .unit_m = gds ? (double)NAN : 1e-6,
                                         .unit = gds ? NULL : "um",
                                         .usual = "mask",
                                         .place = {"d", 1, 1}};
    fw_text out = fw_text_new(arena);
    if (gds)
        as_gds(layer, &out);
    else
        as_dxf(layer, &out);
    if (fw_text_end(&out) != FW_OK) return;
    fw_drawing_cell again;
    fw_diags own = fw_diags_new(arena);
    const fw_status s = fw_drawing_cell_read(arena, out.data, out.length, &asked, &own, &again);
    if (s == FW_NOMEM || s == FW_LIMIT) return;
    /* of a DXF file points within 1 nm are one, and an outline may not touch itself */
    if (s == FW_INPUT && !gds) return;
    if (s != FW_OK) wrong(own.item[0].message);
    if (again.nlayer != 1) wrong("a cell written again has other layers");
    /* An edge that was led through one rounded crossing may pass another one, and be led through that the next time (iterated
       snap rounding, Halperin and Packer 2002): each moves it by less than 1 nm, after which slivers may be nothing. */
    double perimeter = 0;
    for (int i = 0; i < layer->n; i++)
        perimeter += fw_geometry_contour_perimeter(&layer->outline[i]);
    if (fabs(area(layer) - area(&again.layer[0])) > 1e-9 * perimeter)
        wrong("a cell written again has another area");
}

/* outlines that touch themselves where a hole was cut open are no outlines of a DXF file */
static void same_again(fw_arena *arena, const fw_drawing_cell *cell) {
    for (int l = 0; l < cell->nlayer; l++) {
        const fw_drawing_cell_layer *layer = &cell->layer[l];
        int points = 0, joints = 0;
        bool small = layer->n > 0;
        for (int i = 0; i < layer->n; i++) {
            points += layer->outline[i].count;
            for (int k = 0; k < layer->outline[i].count; k++)
                joints += (layer->outline[i].segment[k].flags & FW_SEGMENT_JOINT) != 0;
        }
        small = small && points < POINTS_MOST && fabs(layer->box.x0) < 1 &&
                fabs(layer->box.x1) < 1 && fabs(layer->box.y0) < 1 && fabs(layer->box.y1) < 1;
        if (small) written_again(arena, layer, true);
        if (small && joints == 0) written_again(arena, layer, false);
    }
}

static void a_drawing(fw_arena *arena, fw_diags *diags, const char *text, size_t n) {
    const fw_drawing_asked asked = {.file = "f", .unit_m = (double)NAN, .place = {"d", 1, 1}};
    const fw_drawing_cell_asked cell = {
        .file = "f", .unit_m = (double)NAN, .usual = "mask", .place = {"d", 1, 1}};
    fw_drawing out;
    fw_drawing_cell placed;
    agree(fw_drawing_read(arena, text, n, &asked, diags, &out), diags);
    fw_diags own = fw_diags_new(arena);
    const fw_status s = fw_drawing_cell_read(arena, text, n, &cell, &own, &placed);
    agree(s, &own);
    if (s == FW_OK) same_again(arena, &placed);
}

/* two ways to the same number: evaluated, and compiled for times, of which it may not depend */
static void an_expression(fw_arena *arena, fw_diags *diags, const char *text, size_t n) {
    double value, again, v[3];
    fw_quantity_dimension dimension;
    fw_quantity_expression_error error;
    fw_quantity_program *program;
    (void)diags;
    fw_status s =
        fw_quantity_expression_evaluate_any(arena, text, n, NULL, &value, &dimension, &error);
    if (s == FW_INPUT && (!error.message || error.offset > n))
        wrong("an error of an expression that is nowhere");
    if (s == FW_OK) {
        if (!isfinite(value)) wrong("a value that is no number");
        if (fw_quantity_expression_evaluate(arena, text, n, NULL, dimension, &again, &error) !=
                FW_OK ||
            again != value)
            wrong("another value where its dimension was asked for");
        if (fw_quantity_program_compile(arena, text, n, NULL, dimension, &program, &error) != FW_OK)
            wrong(error.message);
        fw_quantity_program_value(program, 0.5, v);
        if (fabs(v[0] - value) > 1e-12 * fabs(value) || v[1] != 0 || v[2] != 0)
            wrong("compiled, it has another value, or one that varies");
        return;
    }
    s = fw_quantity_program_compile(arena, text, n, NULL, (fw_quantity_dimension){.m = 1}, &program,
                                    &error);
    for (int i = -1; s == FW_OK && i < 2; i++)
        fw_quantity_program_value(program, 0.5 * i, v);
}

/* what a request may say of itself, a word each line; who is let in knows the secrets and came to this address */
static void a_request(fw_arena *arena, fw_diags *diags, const char *text, size_t n) {
    fw_serve_guard guard = {.host = {"127.0.0.1:8931"},
                            .origin = {"http://127.0.0.1:8931"},
                            .addresses = 1,
                            .cookie_name = "flexwright-8931"};
    memset(guard.cookie, 'a', FW_SERVE_SECRET - 1), memset(guard.header, 'b', FW_SERVE_SECRET - 1);
    memset(guard.entry, 'c', FW_SERVE_SECRET - 1);
    const char *word[14] = {0};
    char *copy = fw_arena_strndup(arena, text, n);
    (void)diags;
    for (size_t i = 0; copy && i < sizeof word / sizeof *word; i++) {
        char *end = strchr(copy, '\n');
        if (end) *end = '\0';
        word[i] = strcmp(copy, "-") != 0 ? copy : NULL;
        copy = end ? end + 1 : NULL;
    }
    if (!word[0] || !word[1] || !word[2]) return;
    const fw_serve_guard_facts f = {.version = word[0],
                                    .method = word[1],
                                    .path = word[2],
                                    .host = word[3],
                                    .origin = word[4],
                                    .fetch_site = word[5],
                                    .content_type = word[6],
                                    .content_length = word[7],
                                    .cookie = word[8],
                                    .token = word[9],
                                    .entry = word[10],
                                    .transfer_encoding = word[11],
                                    .fetch_mode = word[12],
                                    .query = word[10] != NULL,
                                    .head_bytes = n,
                                    .seen_bytes = n};
    fw_serve_refusal r = fw_serve_guard_check(&guard, &f);
    if (r.status != 0) {
        if (!r.why || r.status < 400) wrong("a refusal without a reason");
        return;
    }
    if (!f.host || strcmp(f.host, guard.host[0]) != 0) wrong("let in under another host");
    if (f.origin && strcmp(f.origin, guard.origin[0]) != 0) wrong("let in from another origin");
    if (fw_serve_guard_is_entry(&f) ? !f.entry || strcmp(f.entry, guard.entry) != 0
                                    : !f.cookie || !strstr(f.cookie, guard.cookie))
        wrong("let in without the secret");
    if (strcmp(f.method, "GET") != 0 && (!f.token || strcmp(f.token, guard.header) != 0))
        wrong("a change without the token");
    if (fw_serve_guard_body(&f) > FW_SERVE_MOST_BODY) wrong("a body that is too large");
}

static void table_device(fuzz_text *t) {
    fuzz_mutate_xml(t, &fw_device_table);
}
static void table_pack(fuzz_text *t) {
    fuzz_mutate_xml(t, &fw_process_pack_table);
}
static void table_laboratory(fuzz_text *t) {
    fuzz_mutate_xml(t, &fw_process_laboratory_table);
}
static void table_study(fuzz_text *t) {
    fuzz_mutate_xml(t, &fw_device_study_table);
}
static void no_table(fuzz_text *t) {
    fuzz_mutate_xml(t, NULL);
}
static void drawing(fuzz_text *t) {
    if (t->n > 1 && t->data[0] == '\0')
        fuzz_mutate_gds(t), fuzz_smaller_arrays(t);
    else
        fuzz_mutate_lines(t);
}

static const struct kind {
    const char *name, *files; /* of the tree */
    void (*read)(fw_arena *arena, fw_diags *diags, const char *text, size_t n);
    void (*mutate)(fuzz_text *text);
} kinds[] = {
    {"device", "docs/gallery/*/device.xml", a_device, table_device},
    {"device", "tests/data/*/*.xml", a_device, table_device},
    {"flow", "processes/*-*.xml", a_flow, table_pack},
    {"laboratory", "tests/fuzz/seeds/laboratory*", a_laboratory, table_laboratory},
    {"layers", "masks/*.xml", a_layer_table, no_table},
    {"study", "docs/studies/*.xml", a_study, table_study},
    {"materials", "processes/base.xml", materials, table_pack},
    {"map", "tests/fuzz/seeds/layers*", a_layer_map, fuzz_mutate_lines},
    {"log", "tests/fuzz/seeds/log*", a_log, fuzz_mutate_lines},
    {"coupons", "tests/fuzz/seeds/coupons*", measured, fuzz_mutate_lines},
    {"drawing", "tests/fuzz/seeds/drawing*", a_drawing, drawing},
    {"expression", "tests/fuzz/seeds/expression*", an_expression, fuzz_mutate_bytes},
    {"request", "tests/fuzz/seeds/request*", a_request, fuzz_mutate_lines},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n) {
    if (n < 1) return 0;
    prepare();
    char *own = malloc(n); /* of its exact size: a sanitizer sees what is read beyond it */
    if (own) {
        memcpy(own, data + 1, n - 1);
        fw_diags diags = fw_diags_new(scratch);
        kinds[data[0] % KINDS].read(scratch, &diags, own, n - 1);
    }
    free(own);
    fw_arena_copy_put_back(scratch, &emptied);
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t n, size_t most, unsigned seed) {
    if (n < 1) return n;
    fuzz_seed = 0x9e3779b97f4a7c15ULL ^ ((uint64_t)seed << 17 | seed);
    const char *kind = getenv("FUZZ_KIND"); /* a run of one kind alone */
    if (kind) data[0] = (uint8_t)strtol(kind, NULL, 10);
    fuzz_text text = {(char *)data + 1, n - 1, most - 1};
#ifndef FUZZ_ALONE
    if (fuzz_below(8) == 0) { /* what the fuzzer itself makes of it */
        text.n = LLVMFuzzerMutate(data + 1, text.n, text.room);
        if (kinds[data[0] % KINDS].read == a_drawing) fuzz_smaller_arrays(&text);
        return 1 + text.n;
    }
#endif
    for (size_t k = 1 + fuzz_below(3); k > 0; k--)
        kinds[data[0] % KINDS].mutate(&text);
    return text.n + 1;
}

#ifdef FUZZ_ALONE
enum { SEEDS_MOST = 200, ROOM = 1 << 18 };

/* ROUNDS: changes of changes, from one of the files */
static void from_file(unsigned char *room, int kind, const char *path, int rounds) {
    FILE *file = fopen(path, "rb");
    if (!file) wrong(path);
    room[0] = (unsigned char)kind;
    size_t n = 1 + fread(room + 1, 1, ROOM - 1, file);
    fclose(file);
    for (int i = 0; i < rounds; i++) {
        LLVMFuzzerTestOneInput(room, n);
        fuzz_text text = {(char *)room + 1, n - 1, ROOM - 1};
        kinds[kind].mutate(&text);
        n = text.n + 1;
    }
}

/* each file of the tree that inputs begin with, behind the byte of its kind */
static int corpus(const char *directory) {
    for (int kind = 0; kind < KINDS; kind++) {
        glob_t found;
        const char *pattern = fw_arena_printf(kept, FW_TEST_SOURCE_DIR "/%s", kinds[kind].files);
        if (!pattern || glob(pattern, 0, NULL, &found) != 0) wrong(kinds[kind].files);
        for (size_t i = 0; i < found.gl_pathc; i++) {
            size_t n;
            const char *data = tree_file(found.gl_pathv[i] + strlen(FW_TEST_SOURCE_DIR "/"), &n);
            const char *own = fw_arena_printf(kept, "%s/%d/%zu", directory, kind, i);
            const char *path = fw_arena_printf(kept, "%s/%d-%zu", directory, kind, i);
            FILE *file = own ? fopen(own, "wb") : NULL;
            if (!file && path) file = fopen(path, "wb");
            if (!file || fputc(kind, file) == EOF || fwrite(data, 1, n, file) != n ||
                fclose(file) != 0)
                wrong(directory);
        }
        globfree(&found);
    }
    return 0;
}

static int inputs(char **directory) {
    unsigned char *room = malloc(ROOM);
    long n = 0;
    for (; room && *directory; directory++) {
        glob_t found;
        const char *pattern = fw_arena_printf(kept, "%s/*", *directory);
        if (!pattern || glob(pattern, 0, NULL, &found) != 0) continue;
        for (size_t i = 0; i < found.gl_pathc; i++, n++) {
            FILE *file = fopen(found.gl_pathv[i], "rb");
            if (!file) wrong(found.gl_pathv[i]);
            LLVMFuzzerTestOneInput(room, fread(room, 1, ROOM, file));
            fclose(file);
        }
        globfree(&found);
    }
    free(room);
    printf("%ld inputs: nothing wrong\n", n);
    return 0;
}

/* each file that was written for this, as it is: what was found once is looked for in every run */
static void seeds(unsigned char *room, const char *only) {
    for (int kind = 0; kind < KINDS; kind++) {
        glob_t found;
        const char *pattern = fw_arena_printf(kept, FW_TEST_SOURCE_DIR "/%s", kinds[kind].files);
        if (!strstr(kinds[kind].files, "tests/fuzz") || (only && strcmp(only, kinds[kind].name)))
            continue;
        if (!pattern || glob(pattern, 0, NULL, &found) != 0) wrong(kinds[kind].files);
        for (size_t i = 0; i < found.gl_pathc; i++)
            from_file(room, kind, found.gl_pathv[i], 1);
        globfree(&found);
    }
}

static double cpu_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* of the kinds with this name, or of all where it is NULL */
static int draw_kind(const char *only) {
    for (;;) {
        const int kind = (int)fuzz_below(KINDS);
        if (!only || strcmp(kinds[kind].name, only) == 0) return kind;
    }
}

int main(int argc, char **argv) {
    if (argc > 2 && strcmp(argv[1], "corpus") == 0) {
        prepare();
        return corpus(argv[2]);
    }
    if (argc > 2 && strcmp(argv[1], "inputs") == 0) {
        prepare();
        return inputs(argv + 2);
    }
    if (argc == 2 && strcmp(argv[1], "kinds") == 0) {
        for (int k = 0; k < KINDS; k++)
            printf("%s\n", kinds[k].name);
        return 0;
    }
    const long runs = argc > 1 ? strtol(argv[1], NULL, 10) : 1000;
    const uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    const char *only = argc > 3 ? argv[3] : NULL;
    unsigned char *room = malloc(ROOM);
    if (!room) return 1;
    prepare();
    fuzz_seed ^= seed * 0x2545f4914f6cdd1dULL;
    seeds(room, only);
    long done[KINDS] = {0};
    double took_s[KINDS] = {0};
    for (long i = 0; i < runs;) {
        const int kind = draw_kind(only);
        glob_t found;
        const char *pattern = fw_arena_printf(kept, FW_TEST_SOURCE_DIR "/%s", kinds[kind].files);
        if (!pattern || glob(pattern, 0, NULL, &found) != 0) wrong(kinds[kind].files);
        const int rounds = 1 + (int)fuzz_below(20);
        const double before = cpu_s();
        from_file(room, kind, found.gl_pathv[fuzz_below(found.gl_pathc)], rounds);
        took_s[kind] += cpu_s() - before;
        globfree(&found);
        done[kind] += rounds, i += rounds;
    }
    for (int k = 0; k < KINDS; k++)
        if (done[k] > 0)
            printf("%s %ld (%.0f us each)\n", kinds[k].name, done[k],
                   1e6 * took_s[k] / (double)done[k]);
    printf("nothing wrong\n");
    free(room);
    fw_arena_copy_free(&flow_as_read), fw_arena_copy_free(&emptied);
    fw_arena_free(of_flow), fw_arena_free(scratch), fw_arena_free(kept);
    return 0;
}
#endif
