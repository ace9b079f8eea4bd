/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "study/study.h"
#include "base/output.h"
#include "study/study_parts.h"
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <sqlite3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum {
    APPLICATION = 0x46775374, /* "FwSt": PRAGMA application_id of a store of ours */
    ROWS_AT_ONCE = 512,       /* of one transaction; a reader sees them then */
    PATIENCE_MS = 20000       /* with a program that reads the store and keeps a lock of it */
};
static const double commit_s = 0.5; /* and not later than so */

struct fw_study_store {
    fw_study *study;
    const char *path;
    sqlite3 *db;
    sqlite3_stmt *add, *get, *each;
    fw_study_sample row;
    int open;      /* rows of the transaction */
    int directory; /* its lock: whoever has it writes there; -1: none */
    double begun_s;
};

/* SQLite tries other ways to open a file where one fails, so that the system's last reason may be of another try: whether
   it can be opened at all is asked again. 0: nothing is known */
static int reason_of(const fw_study_store *store) {
    const int code = sqlite3_errcode(store->db);
    if (code != SQLITE_CANTOPEN && code != SQLITE_READONLY) return sqlite3_system_errno(store->db);
    const int at = open(store->path, O_RDWR | O_CLOEXEC);
    if (at >= 0) return close(at), 0;
    return errno == ENOENT && access(store->study->options.output, W_OK) == 0 ? 0 : errno;
}

/* what SQLite has to say, and the system's reason where it knows one: a full disk, no permission */
static fw_status failed(const fw_study_store *store, const char *doing) {
    if (!store->db || sqlite3_errcode(store->db) == SQLITE_NOMEM) return FW_NOMEM;
    const int number = reason_of(store);
    const bool there = access(store->path, F_OK) == 0;
    const char *kept = there ? "; what was kept before is whole, and --resume goes on from it" : "";
    fw_diags *diags = fw_diags_because(&store->study->diags, number);
    const fw_status status = fw_diag_error(
        diags, 496, (fw_place){.file = store->path}, "%s: %s%s%s%s", doing,
        sqlite3_errmsg(store->db), number ? ": " : "", number ? strerror(number) : "", kept);
    return status == FW_NOMEM ? FW_NOMEM : FW_IO;
}

/* of a call of the system, whose errno is as it left it */
static fw_status not_done(const fw_study_store *store, const char *doing) {
    const fw_status status =
        fw_diag_error(fw_diags_because(&store->study->diags, errno), 496,
                      (fw_place){.file = store->path}, "%s: %s", doing, strerror(errno));
    return status == FW_NOMEM ? status : FW_IO;
}

static fw_status run(const fw_study_store *store, const char *sql, const char *doing) {
    return sqlite3_exec(store->db, sql, NULL, NULL, NULL) == SQLITE_OK ? FW_OK
                                                                       : failed(store, doing);
}

/* with texts in place of its question marks; second NULL: it has one */
static fw_status run_with(const fw_study_store *store, const char *sql, const char *first,
                          const char *second, const char *doing) {
    sqlite3_stmt *s = NULL;
    bool done = sqlite3_prepare_v2(store->db, sql, -1, &s, NULL) == SQLITE_OK;
    if (done) sqlite3_bind_text(s, 1, first, -1, SQLITE_TRANSIENT);
    if (done && second) sqlite3_bind_text(s, 2, second, -1, SQLITE_TRANSIENT);
    done = done && sqlite3_step(s) == SQLITE_DONE;
    const fw_status status = done ? FW_OK : failed(store, doing);
    sqlite3_finalize(s);
    return status;
}

static fw_status prepare(const fw_study_store *store, const fw_text *sql,
                         sqlite3_stmt **statement) {
    FW_TRY(fw_text_end(sql));
    return sqlite3_prepare_v2(store->db, sql->data, -1, statement, NULL) == SQLITE_OK
               ? FW_OK
               : failed(store, "a statement could not be prepared");
}

/* a name between double quotes, which are doubled within */
static void add_name(fw_text *sql, const char *name) {
    fw_text_add(sql, ", \"");
    for (const char *at = name; *at; at++)
        fw_text_printf(sql, *at == '"' ? "\"\"" : "%c", *at);
    fw_text_add(sql, "\"");
}

/* dies of a yield are read in three ways */
static int readings(const fw_study *study) {
    return study->asked->kind == FW_STUDY_IS_yield ? 2 : 0;
}

/* of a size, bytes of what each hinge uses, doubles of this machine: only --resume reads them */
static size_t uses(const fw_study *study) {
    return FW_USE_NUMBERS * (size_t)study->nuse * sizeof(double);
}

/* of a size that watches corners the one that governs, of devices that were looked at in all */
static void add_columns(fw_text *sql, const fw_study *study, bool types) {
    static const char *const end[] = {"limit_used_low", "limit_used_high"};
    if (study->watches) fw_text_printf(sql, ", corner%s", types ? " TEXT" : "");
    if (study->nuse > 0) fw_text_printf(sql, ", uses%s", types ? " BLOB" : "");
    for (int k = 0; k < readings(study); k++)
        fw_text_printf(sql, ", %s%s", end[k], types ? " REAL" : "");
    for (int k = 0; k < study->ninput + study->nresponse; k++) {
        const bool input = k < study->ninput;
        add_name(sql,
                 input ? study->input[k].what : study->response[k - study->ninput].asked->name);
        if (types && !(input && study->input[k].ntext > 0)) fw_text_add(sql, " REAL");
    }
}

/* ---- what it is of ---- */

static fw_status make_tables(fw_study_store *store) {
    const fw_study *study = store->study;
    const fw_study_options *o = &study->options;
    fw_text sql = fw_text_new(study->arena);
    fw_text_printf(&sql, "PRAGMA application_id = %d; PRAGMA page_size = 4096; BEGIN;",
                   (int)APPLICATION);
    fw_text_add(
        &sql, "CREATE TABLE study (key TEXT PRIMARY KEY, value TEXT) WITHOUT ROWID;"
              "CREATE TABLE sample (i INTEGER PRIMARY KEY, state TEXT, why TEXT, limit_used REAL");
    add_columns(&sql, study, true);
    fw_text_add(&sql, ");");
    FW_TRY(fw_text_end(&sql));
    FW_TRY(run(store, sql.data, "the store could not be begun"));
    const char *const of[][2] = {{"program", study->origin.program},
                                 {"options", study->origin.options},
                                 {"files", study->origin.files},
                                 {"asked", study->origin.asked},
                                 {"hash", study->hash},
                                 {"study", study->asked->name},
                                 {"kind", fw_device_study_kind_text(study->asked->kind)},
                                 {"device", study->device_name},
                                 {"file", o->file},
                                 {"shard", fw_arena_printf(sql.arena, "%d", o->shard)},
                                 {"shards", fw_arena_printf(sql.arena, "%d", o->shards)}};
    for (size_t i = 0; i < sizeof of / sizeof of[0] - (o->shards > 0 ? 0 : 2); i++)
        FW_TRY(run_with(store, "INSERT INTO study VALUES (?, ?)", of[i][0], of[i][1],
                        "the store could not be begun"));
    return run(store, "COMMIT", "the store could not be begun");
}

/* its first row, to be finalized; NULL: it has none, or cannot be read */
static sqlite3_stmt *first_row(sqlite3 *db, const char *sql, const char *key) {
    sqlite3_stmt *s = NULL;
    if (sqlite3_prepare_v2(db, sql, -1, &s, NULL) != SQLITE_OK) return NULL;
    if (key) sqlite3_bind_text(s, 1, key, -1, SQLITE_TRANSIENT);
    if (sqlite3_step(s) == SQLITE_ROW) return s;
    sqlite3_finalize(s);
    return NULL;
}

/* what the store says under a key, of *db; NULL: nothing, or it is no store */
const char *fw_study_store_says(fw_arena *arena, sqlite3 *db, const char *key) {
    sqlite3_stmt *s = first_row(db, "SELECT value FROM study WHERE key = ?", key);
    const char *value = s ? fw_arena_strdup(arena, (const char *)sqlite3_column_text(s, 0)) : NULL;
    sqlite3_finalize(s);
    return value;
}

static bool is_ours(sqlite3 *db) {
    sqlite3_stmt *s = first_row(db, "PRAGMA application_id", NULL);
    const bool ours = s && sqlite3_column_int(s, 0) == APPLICATION;
    sqlite3_finalize(s);
    return ours;
}

/* Opens a store. Whoever looks at the samples of a study that runs (sqlite3, a notebook) keeps a lock for as long as it
   reads; that is waited for, PATIENCE_MS long, and does not end the study. */
static bool open_database(const char *path, int how, sqlite3 **db) {
    if (sqlite3_open_v2(path, db, how, NULL) != SQLITE_OK) return false;
    sqlite3_busy_timeout(*db, PATIENCE_MS);
    return true;
}

fw_status fw_study_store_said(fw_arena *arena, fw_diags *diags, const char *directory,
                              const char *key, const char **value) {
    const char *path = fw_arena_printf(arena, "%s/study.sqlite", directory);
    sqlite3 *db = NULL;
    FW_NEED(path);
    *value = NULL;
    bool there = open_database(path, SQLITE_OPEN_READONLY, &db) && is_ours(db);
    if (there) *value = fw_study_store_says(arena, db, key);
    const fw_status status =
        there ? FW_OK
              : fw_diag_error(diags, 497, (fw_place){.file = path}, "it is no store of a study: %s",
                              db && sqlite3_errcode(db) != SQLITE_OK
                                  ? sqlite3_errmsg(db)
                                  : "it was made by another program");
    sqlite3_close(db);
    return status;
}

/* ---- opening ---- */

static fw_status prepare_all(fw_study_store *store) {
    const fw_study *study = store->study;
    fw_text add = fw_text_new(study->arena), get = fw_text_new(study->arena);
    fw_text_add(&add, "INSERT OR IGNORE INTO sample VALUES (?, ?, ?, ?");
    const int more = readings(study) + study->watches + (study->nuse > 0);
    for (int k = 0; k < study->ninput + study->nresponse + more; k++)
        fw_text_add(&add, ", ?");
    fw_text_add(&add, ")");
    FW_TRY(prepare(store, &add, &store->add));
    fw_text_add(&get, "SELECT i, state, why, limit_used");
    add_columns(&get, study, false);
    fw_text each = fw_text_new(study->arena);
    FW_TRY(fw_text_end(&get));
    fw_text_printf(&each, "%s FROM sample ORDER BY i", get.data);
    fw_text_add(&get, " FROM sample WHERE i = ?");
    FW_TRY(prepare(store, &get, &store->get));
    return prepare(store, &each, &store->each);
}

/* a store that is there: of this study, or the message says of which */
static fw_status check_same(const fw_study_store *store) {
    const char *hash = fw_study_store_says(store->study->arena, store->db, "hash"), *words;
    const char *name = fw_study_store_says(store->study->arena, store->db, "study");
    if (hash && strcmp(hash, store->study->hash) == 0) return FW_OK;
    FW_TRY(fw_study_difference(store->study, fw_study_store_says, store->db, &words));
    return fw_diag_error(&store->study->diags, 495, (fw_place){.file = store->path},
                         "it holds the samples of study '%s' of other inputs, options or another "
                         "version of the program, not those of '%s' as it is now%s; name another "
                         "directory with -o, or leave --resume out to begin anew",
                         name ? name : "?", store->study->asked->name, words);
}

/* results of what the store held before; they are written anew at the end */
static fw_status remove_results(const fw_study_store *store) {
    static const char *const name[] = {"study.json", "study.csv", "study.html", "pictures"};
    const char *directory = store->study->options.output;
    int at = open(directory, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    bool gone = at >= 0;
    for (size_t i = 0; i < sizeof name / sizeof name[0] && gone; i++) {
        fw_output_remove_tree(at, name[i]);
        gone = faccessat(at, name[i], F_OK, AT_SYMLINK_NOFOLLOW) != 0 && errno == ENOENT;
    }
    const fw_status status =
        gone ? FW_OK
             : not_done(store, "results of an earlier study beside it could not be removed");
    if (at >= 0) close(at);
    return status;
}

/* The logs of a store that another file is to take the place of: they would be read into that one. The store is closed, and
   has taken from them what was in them. *gone false: errno has the reason */
static fw_status remove_logs(const fw_study_store *store, bool *gone) {
    static const char *const end[] = {"-wal", "-shm", "-journal"};
    *gone = true;
    for (size_t i = 0; i < sizeof end / sizeof end[0] && *gone; i++) {
        const char *path = fw_arena_printf(store->study->arena, "%s%s", store->path, end[i]);
        FW_NEED(path);
        *gone = unlink(path) == 0 || errno == ENOENT;
    }
    return FW_OK;
}

/* One process at a time writes into a directory. Where a task of a cluster was put in the queue again and the one before it
   still runs, the later one waits and then finds nothing left to do. The lock is of the open directory and ends with the
   process. Where a file system has none (a directory on NFS) nobody is kept out. */
static fw_status lock_directory(fw_study_store *store) {
    const fw_study_options *o = &store->study->options;
    bool told = false;
    store->directory = open(o->output, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (store->directory < 0) return FW_OK; /* what is wrong with it, the store will say */
    while (flock(store->directory, LOCK_EX | LOCK_NB) != 0) {
        if (errno == EINTR) continue;
        if (errno != EWOULDBLOCK) return FW_OK;
        if (!o->resume)
            return fw_diag_error(&store->study->diags, 553, (fw_place){.file = o->output},
                                 "another process writes a study into this directory; name "
                                 "another one with -o, or wait with --resume until it has ended");
        if (fw_cancel_requested(o->cancel)) return FW_CANCELLED;
        if (!told && o->waits) o->waits();
        told = true;
        nanosleep(&(struct timespec){.tv_nsec = 100000000}, NULL);
    }
    return FW_OK;
}

/* a file in which nothing was begun: its process was killed before the tables were there */
static bool is_empty(fw_study_store *store) {
    struct stat info;
    sqlite3_exec(store->db, "PRAGMA schema_version", NULL, NULL, NULL); /* undoes what was open */
    return stat(store->path, &info) == 0 && info.st_size == 0;
}

/* its tables are made beside the store of an earlier study, which stays until the new one can begin */
static fw_status begin_anew(fw_study_store *store) {
    const char *path = store->path;
    const char *beside = fw_arena_printf(store->study->arena, "%s.tmp-%ld", path, (long)getpid());
    bool gone = false;
    FW_NEED(beside);
    store->path = beside;
    unlink(beside);
    fw_status status = open_database(beside, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, &store->db)
                           ? make_tables(store)
                           : failed(store, "the store could not be made");
    sqlite3_close(store->db);
    store->db = NULL, store->path = path;
    if (status == FW_OK) status = remove_logs(store, &gone);
    if (status == FW_OK && (!gone || rename(beside, path) != 0))
        status = not_done(store, "the store could not be made");
    if (status != FW_OK) {
        unlink(beside);
        return status;
    }
    FW_TRY(remove_results(store));
    return open_database(path, SQLITE_OPEN_READWRITE, &store->db)
               ? FW_OK
               : failed(store, "the store could not be opened");
}

static fw_status open_file(fw_study_store *store, bool resume) {
    if (access(store->path, F_OK) == 0) {
        bool open = open_database(store->path, SQLITE_OPEN_READWRITE, &store->db);
        bool ours = open && is_ours(store->db), empty = open && !ours && is_empty(store);
        resume = resume && ours && fw_study_store_says(store->study->arena, store->db, "hash");
        const int code = sqlite3_errcode(store->db);
        if (!ours && !empty &&
            (code == SQLITE_CANTOPEN || code == SQLITE_IOERR || code == SQLITE_NOMEM))
            return failed(store, "the store could not be opened");
        if (!ours && !empty)
            return fw_diag_error(&store->study->diags, 496, (fw_place){.file = store->path},
                                 "there is a file of this name that is no store of a study; name "
                                 "another directory with -o");
        const long held = ours && !resume ? fw_study_store_count(store) : 0;
        fw_status status =
            held > 0 ? fw_study_gives_up(store->study, fw_study_store_says, store->db, held)
                     : FW_OK;
        if (!resume) {
            sqlite3_close(store->db);
            store->db = NULL;
        }
        FW_TRY(status);
    } else {
        resume = false;
    }
    if (resume) FW_TRY(check_same(store));
    FW_TRY(resume ? remove_results(store) : begin_anew(store));
    return run(store, "PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL",
               "the store could not be opened");
}

fw_status fw_study_store_open(fw_study *study, fw_study_store **out) {
    fw_study_store *store = fw_arena_one(study->arena, fw_study_store);
    FW_NEED(*out = store);
    *store = (fw_study_store){.study = study, .directory = -1};
    FW_NEED(store->path = fw_arena_printf(study->arena, "%s/study.sqlite", study->options.output));
    FW_TRY(lock_directory(store));
    fw_output_remove_leftovers(study->arena, store->path);
    FW_TRY(fw_study_sample_new(study->arena, study, &store->row));
    FW_TRY(open_file(store, study->options.resume));
    return prepare_all(store);
}

static void let_go(fw_study_store *store) {
    sqlite3_finalize(store->add);
    sqlite3_finalize(store->get);
    sqlite3_finalize(store->each);
    store->add = store->get = store->each = NULL;
    sqlite3_close(store->db);
    store->db = NULL;
}

static fw_status commit(fw_study_store *store) {
    if (store->open == 0) return FW_OK;
    store->open = 0;
    return run(store, "COMMIT", "samples could not be written");
}

void fw_study_store_close(fw_study_store *store) {
    if (!store) return;
    if (store->db) commit(store);
    let_go(store);
    if (store->directory >= 0) close(store->directory);
    store->directory = -1;
}

void fw_study_store_abandon(fw_study_store *store) {
    bool gone;
    let_go(store);
    unlink(store->path);
    (void)remove_logs(store, &gone);
}

/* ---- rows ---- */

static void bind_number(sqlite3_stmt *s, int at, double value) {
    if (isnan(value))
        sqlite3_bind_null(s, at);
    else
        sqlite3_bind_double(s, at, value);
}

fw_status fw_study_store_add(fw_study_store *store, const fw_study_sample *sample) {
    const fw_study *study = store->study;
    sqlite3_stmt *s = store->add;
    int at = 1;
    if (store->open == 0) {
        FW_TRY(run(store, "BEGIN", "samples could not be written"));
        store->begun_s = fw_study_now_s();
    }
    sqlite3_bind_int64(s, at++, sample->i);
    sqlite3_bind_text(s, at++, fw_study_state_text(sample->run, sample->decision), -1,
                      SQLITE_STATIC);
    sqlite3_bind_text(s, at++, sample->why[0] ? sample->why : NULL, -1, SQLITE_TRANSIENT);
    bind_number(s, at++, sample->used);
    if (study->watches)
        sqlite3_bind_text(s, at++, sample->corner[0] ? sample->corner : NULL, -1, SQLITE_TRANSIENT);
    if (uses(study) > 0)
        sqlite3_bind_blob(s, at++, sample->use, (int)uses(study), SQLITE_TRANSIENT);
    if (readings(study) > 0)
        bind_number(s, at++, sample->used_low), bind_number(s, at++, sample->used_high);
    for (int k = 0; k < study->ninput; k++, at++)
        if (study->input[k].ntext > 0)
            sqlite3_bind_text(s, at, sample->text[k], -1, SQLITE_TRANSIENT);
        else
            bind_number(s, at, sample->value[k]);
    for (int k = 0; k < study->nresponse; k++)
        bind_number(s, at++, sample->response[k]);
    bool done = sqlite3_step(s) == SQLITE_DONE;
    sqlite3_reset(s);
    if (!done) {
        fw_status status = failed(store, "a sample could not be written");
        commit(store);
        return status;
    }
    store->open++;
    return store->open >= ROWS_AT_ONCE || fw_study_now_s() - store->begun_s > commit_s
               ? commit(store)
               : FW_OK;
}

static double column(sqlite3_stmt *s, int at) {
    return sqlite3_column_type(s, at) == SQLITE_NULL ? (double)NAN : sqlite3_column_double(s, at);
}

static const char *text_column(sqlite3_stmt *s, int at) {
    const char *text = (const char *)sqlite3_column_text(s, at);
    return text ? text : "";
}

static void take_row(const fw_study *study, sqlite3_stmt *s, fw_study_sample *sample) {
    int at = 4;
    sample->i = (long)sqlite3_column_int64(s, 0);
    fw_study_state_take(text_column(s, 1), sample);
    snprintf(sample->why, FW_STUDY_WHY, "%s", text_column(s, 2));
    sample->used = column(s, 3);
    if (study->watches) snprintf(sample->corner, FW_PLAN_CORNER, "%s", text_column(s, at++));
    const void *use = study->nuse > 0 ? sqlite3_column_blob(s, at++) : NULL;
    if (use && (size_t)sqlite3_column_bytes(s, at - 1) == uses(study))
        memcpy(sample->use, use, uses(study));
    if (readings(study) > 0)
        sample->used_low = column(s, at++), sample->used_high = column(s, at++);
    for (int k = 0; k < study->ninput; k++, at++) {
        bool listed = study->input[k].ntext > 0;
        sample->value[k] = listed ? (double)NAN : column(s, at);
        snprintf(sample->text[k], FW_STUDY_TEXT, "%s", listed ? text_column(s, at) : "");
    }
    for (int k = 0; k < study->nresponse; k++)
        sample->response[k] = column(s, at++);
}

fw_status fw_study_store_get(fw_study_store *store, long i, fw_study_sample *sample, bool *found) {
    sqlite3_bind_int64(store->get, 1, i);
    int step = sqlite3_step(store->get);
    *found = step == SQLITE_ROW;
    if (*found) take_row(store->study, store->get, sample);
    sqlite3_reset(store->get);
    return step == SQLITE_ROW || step == SQLITE_DONE ? FW_OK
                                                     : failed(store, "samples could not be read");
}

long fw_study_store_count(fw_study_store *store) {
    sqlite3_stmt *s = first_row(store->db, "SELECT count(*) FROM sample", NULL);
    const long n = s ? (long)sqlite3_column_int64(s, 0) : 0;
    sqlite3_finalize(s);
    return n;
}

fw_status fw_study_store_each(fw_study_store *store,
                              fw_status (*row)(void *context, const fw_study_sample *sample),
                              void *context) {
    int step;
    fw_status status = FW_OK;
    while (status == FW_OK && (step = sqlite3_step(store->each)) == SQLITE_ROW) {
        take_row(store->study, store->each, &store->row);
        status = row(context, &store->row);
    }
    sqlite3_reset(store->each);
    if (status != FW_OK) return status;
    return step == SQLITE_DONE ? FW_OK : failed(store, "samples could not be read");
}

/* ---- the file in its final form ---- */

/* Rows in order into a file beside it, which then takes its name. SQLite writes the same bytes for
   the same statements on an empty file. */
fw_status fw_study_store_finish(fw_study_store *store) {
    fw_study *study = store->study;
    fw_study_store last = {.study = study};
    FW_TRY(commit(store));
    FW_NEED(last.path = fw_arena_printf(study->arena, "%s.tmp-%ld", store->path, (long)getpid()));
    unlink(last.path);
    fw_status status =
        open_database(last.path, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, &last.db)
            ? run(&last, "PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF",
                  "the store could not be completed")
            : failed(&last, "the store could not be completed");
    if (status == FW_OK) status = make_tables(&last);
    sqlite3_close(last.db), last.db = NULL;
    if (status == FW_OK)
        status = run_with(store, "ATTACH ? AS last", last.path, NULL,
                          "the store could not be completed");
    if (status == FW_OK)
        status = run(store,
                     "PRAGMA last.journal_mode = OFF; PRAGMA last.synchronous = FULL;"
                     "INSERT INTO last.sample SELECT * FROM sample ORDER BY i; DETACH last",
                     "the store could not be completed");
    if (status != FW_OK) {
        unlink(last.path);
        return status;
    }
    let_go(store);
    bool gone;
    FW_TRY(remove_logs(store, &gone));
    if (!gone || rename(last.path, store->path) != 0) {
        status = not_done(store,
                          "the completed store could not take the place of the one it was made of");
        unlink(last.path);
        return status;
    }
    if (sqlite3_open_v2(store->path, &store->db, SQLITE_OPEN_READONLY, NULL) != SQLITE_OK)
        return failed(store, "the store could not be read again");
    return prepare_all(store);
}

/* ---- shards ---- */

/* samples that this store has as well are the same there; `shard` is attached */
static fw_status agree(fw_study_store *store, const char *directory) {
    sqlite3_stmt *s = NULL;
    static const char sql[] =
        "SELECT i FROM main.sample JOIN shard.sample AS other USING (i) WHERE main.sample.state "
        "IS NOT other.state OR main.sample.limit_used IS NOT other.limit_used LIMIT 1";
    if (sqlite3_prepare_v2(store->db, sql, -1, &s, NULL) != SQLITE_OK)
        return failed(store, "a shard could not be read");
    const int step = sqlite3_step(s);
    const long i = step == SQLITE_ROW ? (long)sqlite3_column_int64(s, 0) : 0;
    sqlite3_finalize(s);
    if (step == SQLITE_DONE) return FW_OK;
    if (step != SQLITE_ROW) return failed(store, "a shard could not be read");
    return fw_diag_error(&store->study->diags, 497, (fw_place){.file = directory},
                         "sample %ld, which every shard judges, came out otherwise here than in "
                         "another shard: the machines do not compute alike; run all shards on "
                         "machines of one kind",
                         i);
}

static fw_status merge_one(fw_study_store *store, const char *directory) {
    const fw_study *study = store->study;
    const char *path = fw_arena_printf(study->arena, "%s/study.sqlite", directory);
    FW_NEED(path);
    FW_TRY(commit(store));
    FW_TRY(run_with(store, "ATTACH ? AS shard", path, NULL, "a shard could not be read"));
    /* what chooses later samples every shard has judged, to the same bits */
    bool apart = (study->asked->kind == FW_STUDY_IS_sweep && !(study->asked->fitted > 0)) ||
                 study->asked->kind == FW_STUDY_IS_sensitivity;
    fw_status status = apart ? FW_OK : agree(store, directory);
    if (status == FW_OK)
        status = run(store,
                     apart ? "INSERT INTO main.sample SELECT * FROM shard.sample"
                           : "INSERT OR IGNORE INTO main.sample SELECT * FROM shard.sample",
                     "a shard could not be read");
    if (status == FW_OK) status = run(store, "DETACH shard", "a shard could not be read");
    return status;
}

fw_status fw_study_store_merge(fw_study_store *store, const char *const *directory, int n) {
    for (int i = 0; i < n; i++)
        FW_TRY(merge_one(store, directory[i]));
    return FW_OK;
}
