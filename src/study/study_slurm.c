/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A study as an array job of Slurm, a task each shard, and a job that puts the shards together when all of them are done.

   What a task does is `study FILE --shard I/N --resume`: one that is killed and put in the queue again goes on with what
   its directory holds. Scripts say FILE and options as they were given and go to the directory that they were given in, so
   that the merged results have the bytes of a run on one machine. Test: tests/cli/test_slurm.py */
#include "base/output.h"
#include "study/study.h"
#include "study/study_parts.h"
#include <errno.h>
#include <spawn.h>
#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- shards that are to be put together ---- */

static fw_status shard_of(fw_study *study, const char *directory, sqlite3 *db, int n, bool *seen) {
    const char *hash = fw_study_store_says(study->arena, db, "hash"),
               *shard = fw_study_store_says(study->arena, db, "shard"),
               *shards = fw_study_store_says(study->arena, db, "shards"), *words;
    fw_place place = {.file = directory};
    int i = shard ? atoi(shard) : 0, of = shards ? atoi(shards) : 0;
    if (!hash || strcmp(hash, study->hash) != 0) {
        FW_TRY(fw_study_difference(study, fw_study_store_says, db, &words));
        return fw_diag_error(&study->diags, 497, place,
                             "its store is of another study, inputs, options or version of the "
                             "program than %s is now%s; merge takes the options of the shards",
                             study->options.file, words);
    }
    if (of != n || i < 1 || i > n)
        return fw_diag_error(&study->diags, 497, place,
                             "its store is shard %d of %d, and %d directories were named; name "
                             "those of all shards, each once",
                             i, of, n);
    if (seen[i - 1])
        return fw_diag_error(&study->diags, 497, place, "shard %d of %d is named twice", i, n);
    seen[i - 1] = true;
    return FW_OK;
}

fw_status fw_study_check_shards(fw_study *study, const char *const *directory, int n) {
    bool *seen = fw_arena_array(study->arena, bool, (size_t)n);
    FW_NEED(seen);
    for (int i = 0; i < n; i++) {
        const char *path = fw_arena_printf(study->arena, "%s/study.sqlite", directory[i]), *value;
        sqlite3 *db = NULL;
        FW_NEED(path);
        FW_TRY(fw_study_store_said(study->arena, &study->diags, directory[i], "hash", &value));
        const bool open = sqlite3_open_v2(path, &db, SQLITE_OPEN_READONLY, NULL) == SQLITE_OK;
        const fw_status status = open ? shard_of(study, directory[i], db, n, seen) : FW_IO;
        sqlite3_close(db);
        FW_TRY(status);
    }
    return FW_OK;
}

/* ---- words of a shell ---- */

/* as one word; percent: each % twice, as patterns of file names of Slurm want it */
static void add_word(fw_text *out, const char *word, bool percent) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_-./:=@,+";
    bool quoted = !*word || word[strspn(word, plain)];
    fw_text_add(out, quoted ? "'" : "");
    for (const char *at = word; *at; at++)
        if (*at == '\'')
            fw_text_add(out, "'\\''");
        else
            fw_text_bytes(out, *at == '%' && percent ? "%%" : at, *at == '%' && percent ? 2 : 1);
    fw_text_add(out, quoted ? "'" : "");
}

static void add_path(fw_text *out, const char *directory, const char *name) {
    add_word(out, directory, false);
    fw_text_printf(out, "/%s", name);
}

/* ---- the two scripts ---- */

static void begin_script(const fw_study *study, const char *what, const char *log, fw_text *out) {
    fw_text_printf(out, "#!/bin/sh\n# flexwright %s: %s\n", FW_VERSION, what);
    fw_text_printf(out, "#SBATCH --job-name=%s\n#SBATCH --requeue\n#SBATCH --open-mode=append\n",
                   study->asked->name);
    fw_text_add(out, "#SBATCH --output=");
    add_word(out, study->options.output, true);
    fw_text_printf(out, "/slurm/%s\n", log);
}

static void enter(const fw_study_cluster *c, fw_text *out) {
    for (int i = 0; i < c->nsbatch; i++)
        fw_text_printf(out, "#SBATCH %s\n", c->sbatch[i]);
    fw_text_add(out, "set -eu\ncd -- ");
    add_word(out, c->where, false);
    if (c->data) {
        fw_text_add(out, "\nexport FLEXWRIGHT_DATA=");
        add_word(out, c->data, false);
    }
    fw_text_add(out, "\nflexwright=");
    add_word(out, c->program, false);
    fw_text_add(out, "\nexec \"${FLEXWRIGHT:-$flexwright}\" study ");
}

static void add_arguments(const fw_study_cluster *c, fw_text *out) {
    for (int i = 0; i < c->nargument; i++)
        fw_text_add(out, " "), add_word(out, c->argument[i], false);
    fw_text_add(out, " --no-progress");
}

static void array_script(const fw_study *study, const fw_study_cluster *c, fw_text *out) {
    begin_script(study,
                 "a shard of the study each task; one that is killed and requeued goes on with "
                 "what it has",
                 "shard-%a.log", out);
    fw_text_printf(out, "#SBATCH --array=1-%d\n", c->shards);
    if (c->jobs > 1) fw_text_printf(out, "#SBATCH --cpus-per-task=%d\n", c->jobs);
    enter(c, out);
    add_word(out, study->options.file, false);
    add_arguments(c, out);
    fw_text_printf(out,
                   " \\\n    --jobs %d --shard \"$SLURM_ARRAY_TASK_ID/%d\" --resume "
                   "-o ",
                   c->jobs, c->shards);
    add_path(out, study->options.output, "shards/\"$SLURM_ARRAY_TASK_ID\"\n");
}

static void merge_script(const fw_study *study, const fw_study_cluster *c, fw_text *out) {
    begin_script(study, "all shards put together, after array.sh", "merge.log", out);
    enter(c, out);
    fw_text_add(out, "merge");
    for (int i = 1; i <= c->shards; i++) {
        char name[24];
        snprintf(name, sizeof name, "shards/%d", i);
        fw_text_add(out, " \\\n    ");
        add_path(out, study->options.output, name);
    }
    fw_text_add(out, " \\\n   ");
    add_arguments(c, out);
    fw_text_add(out, " -o ");
    add_word(out, study->options.output, false);
    fw_text_add(out, "\n");
}

static fw_status write_script(fw_study *study, const fw_study_cluster *c, const char *name,
                              void (*compose)(const fw_study *, const fw_study_cluster *,
                                              fw_text *)) {
    fw_text text = fw_text_new(study->arena);
    const char *path = fw_arena_printf(study->arena, "%s/%s", study->options.output, name);
    FW_NEED(path);
    compose(study, c, &text);
    FW_TRY(fw_text_end(&text));
    return fw_output_single(study->arena, path, text.data, text.length, &study->diags);
}

/* ---- handing them over ---- */

/* what sbatch prints: the number of the job, of a federation ;CLUSTER behind it */
static fw_status take_number(fw_study *study, int from, const char **job) {
    char said[64];
    size_t n = 0;
    for (ssize_t got; n + 1 < sizeof said;) {
        got = read(from, said + n, sizeof said - 1 - n);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) break;
        n += (size_t)got;
    }
    said[n] = '\0';
    said[strspn(said, "0123456789")] = '\0';
    FW_NEED(*job = fw_arena_strdup(study->arena, said));
    return FW_OK;
}

static bool start(char *const *words, int *from, pid_t *child) {
    int ends[2];
    posix_spawn_file_actions_t actions;
    if (pipe(ends) != 0) return false;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], 1);
    posix_spawn_file_actions_addclose(&actions, ends[0]);
    posix_spawn_file_actions_addclose(&actions, ends[1]);
    int wrong = posix_spawnp(child, words[0], &actions, NULL, words, environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
    if (wrong != 0) close(ends[0]), errno = wrong;
    *from = ends[0];
    return wrong == 0;
}

/* array: the job that it waits for; NULL: none */
static fw_status submit(fw_study *study, const char *name, const char *array, const char **job) {
    const char *script = fw_arena_printf(study->arena, "%s/%s", study->options.output, name),
               *after =
                   fw_arena_printf(study->arena, "--dependency=afterok:%s", array ? array : "");
    FW_NEED(script && after ? script : NULL);
    const char *line[] = {
        "sbatch", "--parsable", array ? after : script, array ? "--kill-on-invalid-dep=yes" : NULL,
        script,   NULL};
    char *words[sizeof line / sizeof line[0]];
    memcpy(words, line, sizeof line); /* it does not write to them */
    fw_place place = {.file = script};
    const char *rest = array ? fw_arena_printf(study->arena,
                                               "; job %s of the shards is in the queue: scancel "
                                               "it, or submit merge.sh by hand",
                                               array)
                             : "";
    FW_NEED(rest);
    pid_t child;
    int from, state = 0;
    if (!start(words, &from, &child))
        return fw_diag_error(fw_diags_because(&study->diags, errno), 555, place,
                             "sbatch could not be started: %s; on a machine without Slurm "
                             "--no-submit writes the scripts only%s",
                             strerror(errno), rest);
    fw_status status = take_number(study, from, job);
    close(from);
    while (waitpid(child, &state, 0) < 0 && errno == EINTR)
        continue;
    FW_TRY(status);
    if (state == 0 && **job) return FW_OK;
    return fw_diag_error(&study->diags, 555, place,
                         "sbatch did not take it (exit status %d); what it said stands above%s",
                         WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state), rest);
}

/* ---- all of it ---- */

static bool has_line_break(const fw_study *study, const fw_study_cluster *c) {
    bool some = strpbrk(study->options.output, "\r\n") || strpbrk(c->where, "\r\n");
    for (int i = 0; i < c->nargument; i++)
        some = some || strpbrk(c->argument[i], "\r\n");
    for (int i = 0; i < c->nsbatch; i++)
        some = some || strpbrk(c->sbatch[i], "\r\n");
    return some;
}

static fw_status check(fw_study *study, const fw_study_cluster *c) {
    const char *shards = fw_arena_printf(study->arena, "%s/shards", study->options.output);
    FW_NEED(shards);
    FW_TRY(fw_study_check_apart(study));
    if (has_line_break(study, c))
        return fw_diag_error(&study->diags, 554, (fw_place){.file = study->options.file},
                             "a line of a batch script cannot hold the line break that a "
                             "directory or an option has");
    if (!study->options.resume && access(shards, F_OK) == 0)
        return fw_diag_error(&study->diags, 554, (fw_place){.file = shards},
                             "shards of an earlier run are there; --resume goes on with them, or "
                             "name another directory with -o");
    return FW_OK;
}

fw_status fw_study_slurm(fw_study *study, fw_study_cluster *cluster) {
    static const char *const part[] = {"", "/shards", "/slurm"};
    bool made;
    FW_TRY(check(study, cluster));
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        const char *path = fw_arena_printf(study->arena, "%s%s", study->options.output, part[i]);
        FW_NEED(path);
        FW_TRY(fw_output_directory(study->arena, path, &made));
    }
    FW_TRY(write_script(study, cluster, "array.sh", array_script));
    FW_TRY(write_script(study, cluster, "merge.sh", merge_script));
    if (!cluster->submit) return FW_OK;
    FW_TRY(submit(study, "array.sh", NULL, &cluster->array_job));
    return submit(study, "merge.sh", cluster->array_job, &cluster->merge_job);
}
