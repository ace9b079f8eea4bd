/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a page may send as a body, to every row of the server's table that takes one (serve/routes.c): the handlers themselves,
   and what a worker computes, in this process and with a third of a second each. The first line of an input is a path, the rest
   its body; JSON is changed value by value, keys are drawn from those of all seeds and from the words of the reference page, and
   descriptions by the table of their rows. What must hold beside no crash: an answer, with a status that the reference page has,
   which is JSON and of an error says why; what was saved is what was sent; a job is one of the program's commands, with options
   before "--" and one file behind it, and nothing that it names lies elsewhere.

   As a program of libFuzzer (FW_FUZZ, clang); and alone, with FUZZ_ALONE:
   fuzzed_bodies RUNS [SEED]  starts from tests/fuzz/seeds/body-*, and is the same on every machine */
#include "device/device_table.h"
#include "mutate.h"
#include "serve/server.h"
#include <fcntl.h>
#include <glob.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t n, size_t most, unsigned seed);
size_t LLVMFuzzerMutate(uint8_t *data, size_t n, size_t most); /* of the fuzzer */

enum { ROOM = 1 << 18, WORDS_MOST = 4000, ROWS_MOST = 60, NODES_MOST = 400 };
static const double limit_s = 0.3, stops_s = 5;

static fw_arena *kept;
static fw_serve_server server;
static fw_plan_live *live;
static fw_cancel too_long;
static double cancelled_s, longest_s;
static const char *beside; /* the directory of the file that is served */
static const char *word[WORDS_MOST];
static size_t words;
static const fw_serve_route *row[ROWS_MOST]; /* that take a body */
static size_t rows, answered[600];

static void wrong(const char *what) {
    fprintf(stderr, "fuzz_bodies: %s\n", what);
    abort();
}

static double cpu_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void over(int number) {
    fw_cancel_request(&too_long, number);
    if (cancelled_s == 0) cancelled_s = cpu_s();
}

/* ---- what is needed once ---- */

static char *whole(const char *path, size_t *n) {
    FILE *file = fopen(path, "rb");
    char *text = fw_arena_array(kept, char, ROOM);
    if (!file || !text) wrong(path);
    *n = fread(text, 1, ROOM - 1, file);
    text[*n] = '\0';
    fclose(file);
    return text;
}

static void learn(const char *text, size_t n) {
    if (n == 0 || n > 60 || words == WORDS_MOST) return;
    for (size_t i = 0; i < words; i++)
        if (strlen(word[i]) == n && memcmp(word[i], text, n) == 0) return;
    word[words++] = fw_arena_strndup(kept, text, n);
}

/* what the page's reference has between backticks, and of "a", "b" each alone */
static void learn_reference(void) {
    size_t n;
    const char *at = whole(FW_TEST_SOURCE_DIR "/docs/reference/serve.md", &n);
    for (; (at = strchr(at, '`')) != NULL; at++) {
        const char *end = strchr(++at, '`');
        if (!end) return;
        for (const char *in = at; in < end;) {
            const size_t span = strcspn(in, "\"{}:, `");
            learn(in, span);
            in += span + 1;
        }
        at = end;
    }
}

static void learn_keys(json_t *node) {
    const char *key;
    json_t *value;
    size_t i;
    json_object_foreach(node, key, value) {
        learn(key, strlen(key));
        learn_keys(value);
    }
    json_array_foreach(node, i, value) learn_keys(value);
    if (json_is_string(node)) learn(json_string_value(node), json_string_length(node));
}

static glob_t seeds(void) {
    glob_t found;
    if (glob(FW_TEST_SOURCE_DIR "/tests/fuzz/seeds/body-*", 0, NULL, &found) != 0)
        wrong("no seeds");
    return found;
}

static void learn_all(void) {
    glob_t found = seeds();
    for (size_t i = 0; i < found.gl_pathc; i++) {
        size_t n;
        const char *text = whole(found.gl_pathv[i], &n), *body = strchr(text, '\n');
        json_t *json = body ? json_loads(body, 0, NULL) : NULL;
        if (!json) wrong(found.gl_pathv[i]);
        learn_keys(json);
        json_decref(json);
    }
    globfree(&found);
    learn_reference();
    const fw_serve_route *at;
    for (size_t i = 0; (at = fw_serve_route_at(i)) != NULL; i++)
        if (strcmp(at->method, "POST") == 0 && rows < ROWS_MOST) row[rows++] = at;
    if (words < 100 || rows < 2) wrong("nothing is known of bodies");
}

static void leave(void) {
    fw_serve_jobs_close(server.jobs);
    fw_serve_file_watch_close(server.watch);
    fw_plan_live_free(live);
    fw_serve_scratch_close(server.scratch); /* the file that is served, and drafts, are in it */
    fw_arena_free(kept);
}

static void prepare(void) {
    if (kept) return;
    const fw_plan_live_settings settings = {
        .data_directory = FW_TEST_SOURCE_DIR, .memory_cap = (size_t)256 << 20, .cancel = &too_long};
    const struct sigaction act = {.sa_handler = over};
    sigaction(SIGPROF, &act, NULL);
    if (!(kept = fw_arena_new(0))) exit(1);
    fw_diags diags = fw_diags_new(kept);
    server = (fw_serve_server){.arena = kept};
    learn_all();
    if (fw_serve_scratch_open(kept, &diags, &server.scratch) != FW_OK) wrong("no directory");
    const int own = fw_serve_scratch_make(server.scratch, "beside");
    beside = fw_serve_scratch_path(kept, server.scratch, "beside");
    const char *file = fw_arena_printf(kept, "%s/device.xml", beside);
    int at = own < 0 ? -1 : openat(own, "device.xml", O_CREAT | O_WRONLY, 0600);
    if (at < 0 || !file || write(at, "<device/>", 9) != 9) wrong("no file");
    close(at), close(own);
    setenv("XDG_STATE_HOME", beside, 1);
    if (fw_serve_file_watch_open(kept, file, FW_SERVE_MOST_BODY, &server.events, &diags,
                                 &server.watch) != FW_OK ||
        fw_serve_jobs_open(kept, server.scratch, &server.events, &server.jobs) != FW_OK ||
        !(live = fw_plan_live_new(&settings)))
        wrong("the parts of the server");
    atexit(leave);
}

/* ---- what must hold ---- */

static bool may_be(unsigned status) {
    static const unsigned of_the_page[] = {200, 202, 400, 404, 409, 413, 422, 429, 500, 503};
    for (size_t i = 0; i < sizeof of_the_page / sizeof *of_the_page; i++)
        if (of_the_page[i] == status) return true;
    return false;
}

/* the document of an answer */
static json_t *document(unsigned status, const char *text, size_t n) {
    json_t *json = json_loadb(text, n, JSON_REJECT_DUPLICATES | JSON_DECODE_ANY, NULL);
    const json_t *error = json_object_get(json, "error");
    if (!may_be(status)) wrong("a status that the page does not know");
    if (!json_is_object(json)) wrong("an answer that is no JSON");
    if (status >= 400 && status != 409 && !json_string_length(json_object_get(error, "message")))
        wrong("an error without a message");
    if (status < 400 && error) wrong("an error with a good status");
    answered[status]++;
    return json;
}

/* of a command: options, "--", one file; what they name lies with the job, or is a log beside the description */
static void check_command(const fw_serve_job *job) {
    const char *const *at = job->argv;
    const size_t own = strlen(beside);
    if (strcmp(at[0], "flexwright") != 0 || strcmp(at[1], job->kind) != 0) wrong("another command");
    int outputs = 0;
    for (at += 2; *at && strcmp(*at, "--") != 0; at++) {
        if (strncmp(*at, "--", 2) != 0) wrong(*at);
        outputs += strncmp(*at, "--output", 8) == 0;
        if (strncmp(*at, "--run=", 6) == 0 &&
            (strncmp(*at + 6, beside, own) != 0 || strchr(*at + 6 + own + 1, '/') != NULL))
            wrong(*at);
    }
    if (outputs > 1) wrong("two outputs");
    if (!*at || !at[1] || at[2]) wrong("not one file behind the options");
    if (strchr(at[1], '/') && (strncmp(at[1], beside, own) != 0 || strstr(at[1], "..")))
        wrong(at[1]);
}

static void after_job(const json_t *answer) {
    const json_t *id = json_object_get(answer, "id");
    fw_serve_job *job =
        id ? fw_serve_jobs_find(server.jobs, (unsigned)json_integer_value(id)) : NULL;
    if (!id) return;
    if (!job) wrong("a job that is not there");
    check_command(job);
    fw_serve_job_forget(server.jobs, job);
}

static const char *text_of(const json_t *json) {
    return json_string_value(json_object_get(json, "text"));
}

static json_t *ask(fw_arena *arena, const fw_serve_route *route, char *body, size_t n) {
    fw_serve_request r = {.server = &server,
                          .arena = arena,
                          .route = route,
                          .path = route->path,
                          .method = route->method,
                          .declared = n,
                          .received = n,
                          .body = body,
                          .reply = {.fd = -1}};
    route->handle(&r);
    if (r.reply.status == 0) wrong("no answer");
    return document(r.reply.status, r.reply.data, r.reply.n);
}

/* what was taken is what is there */
static void after_text(fw_arena *arena, const fw_serve_route *route, const json_t *sent) {
    bool known;
    const fw_serve_route *get = fw_serve_route_find("GET", route->path, &known);
    if (!get) return;
    json_t *now = ask(arena, get, NULL, 0);
    const char *text = text_of(now);
    if (!text || strcmp(text, text_of(sent)) != 0) wrong("what was saved is another text");
    json_decref(now);
}

/* "now" as a version is that of the file */
static char *with_version(fw_arena *arena, const char *body, size_t *n) {
    static const char asked[] = "\"now\"";
    fw_diags own = fw_diags_new(arena);
    fw_serve_file_state state;
    const char *at = memmem(body, *n, asked, sizeof asked - 1);
    char *copy = fw_arena_array(arena, char, *n + 80);
    if (!copy) wrong("no memory");
    memcpy(copy, body, *n);
    if (!at || fw_serve_file_watch_read(arena, server.watch, &own, &state) != FW_OK) return copy;
    const size_t head = (size_t)(at - body), tail = *n - head - (sizeof asked - 1);
    const int hash = snprintf(copy + head, 80, "\"%s\"", state.version);
    memcpy(copy + head + (size_t)hash, at + sizeof asked - 1, tail);
    *n = head + (size_t)hash + tail;
    return copy;
}

static unsigned computed_status(fw_status status) {
    return status == FW_OK                            ? 200
           : status == FW_USAGE || status == FW_INPUT ? 400
           : status == FW_LIMIT || status == FW_NOMEM ? 413
           : status == FW_CANCELLED                   ? 409
                                                      : 500;
}

static void compute(const fw_serve_route *route, const char *body, size_t n) {
    struct itimerval limit = {.it_value = {0, (suseconds_t)(1e6 * limit_s)}}, none = {0};
    fw_cancel_clear(&too_long);
    cancelled_s = 0;
    setitimer(ITIMER_PROF, &limit, NULL);
    const fw_plan_live_answer a = fw_serve_worker_answer(live, route->compute, body, n);
    setitimer(ITIMER_PROF, &none, NULL);
    const double late = cancelled_s > 0 ? cpu_s() - cancelled_s : 0;
    if (late > longest_s) longest_s = late;
    if (late > stops_s) wrong("it does not stop");
    if (!a.text || strlen(a.text) != a.length) wrong("an answer with a NUL");
    json_decref(document(computed_status(a.status), a.text, a.length));
}

static void one(fw_arena *arena, const char *text, size_t n) {
    const char *end = memchr(text, '\n', n);
    const size_t path = end ? (size_t)(end - text) : n;
    const fw_serve_route *route = NULL;
    for (size_t i = 0; i < rows; i++)
        if (strlen(row[i]->path) == path && memcmp(row[i]->path, text, path) == 0) route = row[i];
    if (!route || !end) return;
    size_t length = n - path - 1;
    char *body = with_version(arena, end + 1, &length);
    char *exact = malloc(length ? length : 1); /* a sanitizer sees what is read beyond it */
    if (!exact) return;
    memcpy(exact, body, length);
    bool known;
    const fw_serve_route *found = fw_serve_route_find("POST", route->path, &known);
    if (found != route) wrong("a row that is not found");
    if (fw_serve_route_find("PUT", route->path, &known) || !known)
        wrong("a method that no row has");
    json_t *computed = json_loadb(exact, length, 0, NULL), *answer = NULL;
    /* rows without a worker's work are those whose handler answers at once */
    if (route->compute != FW_COMPUTE_TABLE)
        compute(route, exact, length);
    else {
        answer = ask(arena, route, exact, length);
        if (!json_object_get(answer, "error") && strcmp(route->path, "/api/jobs") == 0)
            after_job(answer);
        else if (json_is_true(json_object_get(answer, "kept")) ||
                 (json_object_get(answer, "writable") && text_of(answer) && text_of(computed) &&
                  strcmp(text_of(answer), text_of(computed)) == 0))
            after_text(arena, route, computed);
    }
    json_decref(computed), json_decref(answer);
    free(exact);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n) {
    prepare();
    fw_arena *arena = fw_arena_new(0);
    if (arena) one(arena, (const char *)data, n);
    fw_arena_free(arena);
    return 0;
}

/* ---- changes ---- */

typedef struct place { /* of a value: a key of an object, or a number of a list */
    json_t *in;
    const char *key;
    size_t index;
} place;

static size_t places(json_t *node, place *to, size_t n) {
    const char *key;
    json_t *value;
    size_t i;
    json_object_foreach(node, key, value) {
        if (n < NODES_MOST) to[n++] = (place){node, key, 0};
        n = places(value, to, n);
    }
    json_array_foreach(node, i, value) {
        if (n < NODES_MOST) to[n++] = (place){node, NULL, i};
        n = places(value, to, n);
    }
    return n;
}

static json_t *at_place(const place *p) {
    return p->key ? json_object_get(p->in, p->key) : json_array_get(p->in, p->index);
}

static void set(const place *p, json_t *value) {
    if (!value) return;
    if (p->key)
        json_object_set_new_nocheck(p->in, p->key, value);
    else
        json_array_set_new(p->in, p->index, value);
}

static const char *any_word(void) {
    return word[fuzz_below(words)];
}

static json_t *odd_value(void) {
    static const char *const odd[] = {"null",
                                      "true",
                                      "false",
                                      "0",
                                      "-1",
                                      "1e308",
                                      "1e-320",
                                      "2147483648",
                                      "9007199254740993",
                                      "0.1",
                                      "\"\"",
                                      "[]",
                                      "{}",
                                      "[[[]]]",
                                      "\"-\"",
                                      "\"--output=/x/y\"",
                                      "\"../../x\"",
                                      "\"a\\u0000b\"",
                                      "\"\\u009b31m\"",
                                      "\"NaN\"",
                                      "3",
                                      "100000",
                                      "\"1 um\"",
                                      "{\"x_m\": 1e9}"};
    return json_loads(odd[fuzz_below(sizeof odd / sizeof *odd)], JSON_DECODE_ANY | JSON_ALLOW_NUL,
                      NULL);
}

static json_t *changed_text(const json_t *value, size_t room) {
    char *data = malloc(room + 1);
    fuzz_text text = {data, json_string_length(value), room};
    if (!data || text.n > room) {
        free(data);
        return NULL;
    }
    memcpy(data, json_string_value(value), text.n);
    if (memchr(data, '<', text.n) && fuzz_below(8))
        fuzz_mutate_xml(&text, &fw_device_table);
    else if (fuzz_below(2))
        fuzz_mutate_number(&text);
    else
        fuzz_mutate_bytes(&text);
    json_t *now = json_stringn(text.data, text.n); /* NULL: it is no text any more */
    free(data);
    return now;
}

static void change(json_t *json, size_t room) {
    static place p[NODES_MOST];
    const size_t n = places(json, p, 0);
    if (n == 0) return;
    const place *at = &p[fuzz_below(n)];
    /* a description is the largest part of most bodies and one value of many */
    const bool large = fuzz_below(2);
    for (size_t i = 0; i < n && large; i++)
        if (json_is_string(at_place(&p[i])) && json_string_length(at_place(&p[i])) > 100) at = &p[i];
    const bool outer = at->in == json; /* most of what is missing or unknown there is refused at once */
    switch (outer && fuzz_below(8) ? 7 : fuzz_below(10)) {
    case 0:
        if (at->key)
            json_object_del(at->in, at->key);
        else
            json_array_remove(at->in, at->index);
        break;
    case 1:
        set(at, odd_value());
        break;
    case 2:
        set(at, json_deep_copy(at_place(&p[fuzz_below(n)])));
        break;
    case 3:
        set(at, json_string(any_word()));
        break;
    case 4:
    case 5:
        if (json_is_object(at->in))
            json_object_set_new(at->in, any_word(),
                                fuzz_below(2) ? odd_value() : json_string(any_word()));
        else
            json_array_append_new(at->in, odd_value());
        break;
    default:
        if (json_is_string(at_place(at)))
            set(at, changed_text(at_place(at), room));
        else if (json_is_number(at_place(at)))
            set(at, json_real((double)fuzz_below(2000) * 0.01 - 5));
        else if (fuzz_below(4) == 0)
            set(at, odd_value());
    }
}

static void mutate(fuzz_text *t) {
    char *end = memchr(t->data, '\n', t->n);
    const size_t head = end ? (size_t)(end - t->data) + 1 : 0;
    json_t *json =
        end && fuzz_below(20) ? json_loadb(end + 1, t->n - head, JSON_ALLOW_NUL, NULL) : NULL;
    if (!json) {
        fuzz_text rest = {t->data + head, t->n - head, t->room - head};
        if (rest.n > 0) fuzz_mutate_bytes(&rest);
        t->n = head + rest.n;
        return;
    }
    for (size_t k = 1 + fuzz_below(2); k > 0; k--)
        change(json, t->room / 2);
    const char *path = fuzz_below(40) ? NULL : row[fuzz_below(rows)]->path;
    char *body = json_dumps(json, JSON_COMPACT);
    const size_t n = body ? strlen(body) : 0, length = path ? strlen(path) + 1 : head;
    if (n > 0 && length + n < t->room) {
        if (path) memcpy(t->data, path, length - 1), t->data[length - 1] = '\n';
        memcpy(t->data + length, body, n);
        t->n = length + n;
    }
    free(body);
    json_decref(json);
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t n, size_t most, unsigned seed) {
    prepare();
    fuzz_seed = 0x9e3779b97f4a7c15ULL ^ ((uint64_t)seed << 17 | seed);
    fuzz_text text = {(char *)data, n, most};
#ifndef FUZZ_ALONE
    if (fuzz_below(8) == 0)
        return LLVMFuzzerMutate(data, n, most); /* what the fuzzer itself makes of it */
#endif
    mutate(&text);
    return text.n;
}

#ifdef FUZZ_ALONE
/* Every row has a seed, as it stands it is taken, and of each changes of changes are sent. */
int main(int argc, char **argv) {
    const long runs = argc > 1 ? strtol(argv[1], NULL, 10) : 1000;
    const uint64_t seed = argc > 2 ? strtoull(argv[2], NULL, 10) : 1;
    char *room = malloc(ROOM);
    if (!room) return 1;
    prepare();
    fuzz_seed ^= seed * 0x2545f4914f6cdd1dULL;
    glob_t found = seeds();
    for (size_t k = 0; k < rows; k++) {
        bool any = false;
        for (size_t i = 0; i < found.gl_pathc; i++) {
            size_t n;
            const char *text = whole(found.gl_pathv[i], &n);
            any = any || (strncmp(text, row[k]->path, strlen(row[k]->path)) == 0 &&
                          text[strlen(row[k]->path)] == '\n');
            if (k == 0) LLVMFuzzerTestOneInput((const uint8_t *)text, n);
        }
        if (!any) wrong(row[k]->path); /* a seed is wanted */
    }
    for (long i = 0; i < runs;) {
        FILE *file = fopen(found.gl_pathv[fuzz_below(found.gl_pathc)], "rb");
        if (!file) wrong("a seed");
        fuzz_text text = {room, fread(room, 1, ROOM, file), ROOM};
        fclose(file);
        for (long end = i + 1 + (long)fuzz_below(6); i < end && i < runs; i++) {
            mutate(&text);
            LLVMFuzzerTestOneInput((const uint8_t *)room, text.n);
        }
    }
    globfree(&found);
    for (unsigned s = 0; s < 600; s++)
        if (answered[s] > 0) printf("%u: %zu\n", s, answered[s]);
    printf("stopped after at most %.2f s; nothing wrong\n", longest_s);
    free(room);
    return 0;
}
#endif
