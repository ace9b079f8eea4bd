/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The n-th allocation of the arenas failing, once and for ever after, in everything that the library
   does: the answer is "out of memory" or (where a caller can do without) the same result to the byte;
   never a crash, never another result, never half a directory. What libraries under ours allocate
   themselves is tried by loops.py.

       memory DEVICE [COUNT [WORK [SEED]]]

   A first run finds the places of the code that allocate, told apart by who called whom over five
   calls; of each place the first allocation is failed. COUNT of the places for each kind of work, drawn by
   the seed; 0: all of them; default 120. */
#include "base/text.h"
#include "faults/sites.h"
#include "plan/design.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { DOCUMENTS = 5, SECONDS = 120 };

typedef struct work {
    const char *name;
    int (*compute)(fw_design *design);
    int document[DOCUMENTS]; /* what is compared; those after the first 0 are not there */
    int count;
} work;

static char out[64];
static bool written; /* what is composed after that may fail */

static int judge(fw_design *d) {
    return fw_design_judge(d);
}

static int plan(fw_design *d) {
    int status = fw_design_judge(d);
    if (status == FW_STATUS_OK) status = fw_design_fabricate(d);
    if (status == FW_STATUS_OK) status = fw_design_write(d, out, FW_DESIGN_EVERYTHING);
    written = status == FW_STATUS_OK;
    return status;
}

static const work works[] = {
    {"plan",
     plan,
     {FW_DOCUMENT_VERDICT_JSON, FW_DOCUMENT_VERDICT_TEXT, FW_DOCUMENT_MASKS_JSON,
      FW_DOCUMENT_RECIPES_JSON, FW_DOCUMENT_REPORT_HTML},
     5},
    {"judge",
     judge,
     {FW_DOCUMENT_VERDICT_JSON, FW_DOCUMENT_DEVICE_SVG, FW_DOCUMENT_DIAGNOSTICS_TEXT},
     3},
    {"simulate",
     fw_design_simulate,
     {FW_DOCUMENT_MOTION_CSV, FW_DOCUMENT_FORCES_CSV, FW_DOCUMENT_ANIMATION_SVG,
      FW_DOCUMENT_DIAGNOSTICS_TEXT},
     4},
    {"statics",
     fw_design_statics,
     {FW_DOCUMENT_STATICS_JSON, FW_DOCUMENT_STATICS_SVG, FW_DOCUMENT_LOAD_PATH_CSV,
      FW_DOCUMENT_DIAGNOSTICS_TEXT},
     4},
    {"modes",
     fw_design_modes,
     {FW_DOCUMENT_MODES_JSON, FW_DOCUMENT_MODES_SVG, FW_DOCUMENT_DIAGNOSTICS_TEXT},
     3},
    {"assemble",
     fw_design_assemble,
     {FW_DOCUMENT_ASSEMBLE_JSON, FW_DOCUMENT_ASSEMBLE_SVG, FW_DOCUMENT_DIAGNOSTICS_TEXT},
     3},
    {"workspace",
     fw_design_workspace,
     {FW_DOCUMENT_WORKSPACE_JSON, FW_DOCUMENT_WORKSPACE_SVG, FW_DOCUMENT_CERTIFICATE_JSON,
      FW_DOCUMENT_DIAGNOSTICS_TEXT},
     4},
};

typedef struct outcome {
    int status;
    long allocations;
    char hash[DOCUMENTS][65];
    bool written;
} outcome;

static outcome compute(const work *w, const char *device, long n, int ever) {
    outcome o = {.status = FW_STATUS_NOMEM};
    fw_design_options options = fw_design_options_default();
    options.samples = 101;
    options.path = 1;
    fw_arena_fail_at(n, ever);
    fw_design *design = fw_design_new(&options);
    if (design) o.status = fw_design_read(design, device);
    if (design && o.status == FW_STATUS_OK) o.status = w->compute(design);
    for (int i = 0; design && o.status == FW_STATUS_OK && i < w->count; i++) {
        const char *text;
        size_t length;
        o.status = fw_design_document(design, w->document[i], &text, &length);
        if (o.status == FW_STATUS_OK) fw_sha256(text, length, o.hash[i]);
    }
    fw_design_free(design);
    o.allocations = fw_arena_count();
    o.written = written;
    return o;
}

/* in a process of its own, which may crash or hang; false: it did, and *how says so */
static bool run(const work *w, const char *device, long n, int ever, outcome *o, const char **how) {
    int pipes[2], ended;
    if (pipe(pipes) != 0) exit(70);
    pid_t child = fork();
    if (child == 0) {
        alarm(SECONDS);
        *o = compute(w, device, n, ever);
        _exit(write(pipes[1], o, sizeof *o) != (ssize_t)sizeof *o);
    }
    close(pipes[1]);
    ssize_t got = read(pipes[0], o, sizeof *o);
    close(pipes[0]);
    if (child < 0 || waitpid(child, &ended, 0) != child) exit(70);
    *how = WIFSIGNALED(ended) ? strsignal(WTERMSIG(ended)) : "no answer";
    return got == (ssize_t)sizeof *o && WIFEXITED(ended) && WEXITSTATUS(ended) == 0;
}

static bool exists(const char *path) {
    struct stat info;
    return stat(path, &info) == 0;
}

typedef struct tally {
    long runs, nomem, same, wrong;
} tally;

/* NULL or what is wrong */
static const char *wrong_with(const work *w, const outcome *o, const outcome *clean) {
    static char text[160];
    if (o->status == FW_STATUS_NOMEM) return exists(out) != o->written ? "half a directory" : NULL;
    if (o->status != clean->status) {
        snprintf(text, sizeof text, "status %d (%s)", o->status, fw_status_name(o->status));
        return text;
    }
    if (w->compute == plan && o->status == FW_STATUS_OK && !exists(out)) return "no directory";
    for (int i = 0; i < w->count; i++)
        if (strcmp(o->hash[i], clean->hash[i]) != 0) {
            snprintf(text, sizeof text, "success with another document %d", w->document[i]);
            return text;
        }
    return NULL;
}

static void try_one(const work *w, const char *device, long n, int ever, const outcome *clean,
                    tally *t) {
    char command[200];
    outcome o;
    const char *wrong;
    snprintf(command, sizeof command, "rm -rf %s %s.tmp-*", out, out);
    if (exists(out) && system(command) != 0) exit(70);
    if (run(w, device, n, ever, &o, &wrong)) {
        wrong = wrong_with(w, &o, clean);
        t->nomem += o.status == FW_STATUS_NOMEM;
        t->same += o.status != FW_STATUS_NOMEM && !wrong;
    }
    t->runs++;
    if (!wrong) return;
    t->wrong++;
    printf("%s: allocation %ld of %ld%s: %s\n", w->name, n, clean->allocations,
           ever ? " and all later" : "", wrong);
    fflush(stdout);
}

static unsigned long drawn(unsigned long *seed) { /* D. E. Knuth's constants of MMIX */
    *seed = *seed * 6364136223846793005ul + 1442695040888963407ul;
    return *seed >> 33;
}

static bool try_work(const work *w, const char *device, long count, unsigned long seed) {
    outcome clean;
    const char *how;
    sites *found = sites_new();
    sites_note(found);
    bool ran = run(w, device, 0, 0, &clean, &how);
    sites_note(NULL);
    if (!ran || clean.status == FW_STATUS_NOMEM) {
        printf("%s: without a fault: %s\n", w->name, ran ? fw_status_name(clean.status) : how);
        return false;
    }
    tally t = {0};
    long places = found->count;
    if (count == 0 || count > places) count = places;
    for (long i = 0; i < count; i++) { /* those drawn move to the front */
        long k = i + (long)(drawn(&seed) % (unsigned long)(places - i)), n = found->first[k];
        found->first[k] = found->first[i];
        try_one(w, device, n, (int)(drawn(&seed) % 2), &clean, &t);
    }
    sites_free(found);
    printf("%s: %ld allocations at %ld places, %ld runs: %ld out of memory, %ld without harm, %ld "
           "wrong\n",
           w->name, clean.allocations, places, t.runs, t.nomem, t.same, t.wrong);
    fflush(stdout);
    return t.wrong == 0;
}

int main(int argc, char **argv) {
    if (argc < 2) return 2;
    long count = argc > 2 ? atol(argv[2]) : 120;
    unsigned long seed = argc > 4 ? strtoul(argv[4], NULL, 10) : 1;
    char room[] = "memory-XXXXXX", command[64];
    if (!mkdtemp(room)) return 70;
    snprintf(out, sizeof out, "%s/out", room);
    bool good = true;
    for (size_t i = 0; i < sizeof works / sizeof works[0]; i++)
        if (argc < 4 || strcmp(argv[3], works[i].name) == 0)
            good = try_work(&works[i], argv[1], count, seed) && good;
    snprintf(command, sizeof command, "rm -rf %s", room);
    return system(command) != 0 || !good;
}
