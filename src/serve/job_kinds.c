/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which commands a page may start, and with which options: what is not in these tables cannot be
   said. No option here names a file but one that came with the request, and a log beside the description. And what a job
   has made: the list of its files, and the process that packs them. */
#include "serve/jobs.h"
#include "serve/serve.h"
#include <dirent.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zip.h>

enum { /* bit per kind */
       PLAN = 1,
       CHECK = 2,
       WORKSPACE = 4,
       MODES = 8,
       STATICS = 16,
       ASSEMBLE = 32,
       TRADEOFF = 64,
       HINGE = 128,
       RECIPE = 256,
       MASK = 512,
       SIMULATE = 1024,
       STUDY = 2048,
       CALIBRATE = 4096,
       ALL = 4095, /* that are about a description alone */
       LOG = 8192,
       ABOUT = ALL | LOG, /* a description */
       MADE = PLAN | RECIPE | MASK,
       OF_FILE = 65536, /* no kind: the value names one of the request's files */
       OF_LOG = 131072  /* no kind: the value names a log beside the description */
};

typedef struct kind_row {
    const char *name;
    unsigned bit;
} kind_row;
static const kind_row kinds[] = {
    {"plan", PLAN},           {"check", CHECK},       {"workspace", WORKSPACE}, {"modes", MODES},
    {"statics", STATICS},     {"assemble", ASSEMBLE}, {"tradeoff", TRADEOFF},   {"hinge", HINGE},
    {"recipe", RECIPE},       {"mask", MASK},         {"simulate", SIMULATE},   {"study", STUDY},
    {"calibrate", CALIBRATE}, {"log", LOG},
};

typedef struct option_row {
    const char *name, *option; /* in JSON, on the command line */
    unsigned kinds;
} option_row;
static const option_row options[] = {
    {"flow", "flow", ABOUT | CALIBRATE},
    {"accuracy", "accuracy", ABOUT},
    {"effects", "effects", ABOUT},
    {"corners", "corners", ABOUT},
    {"lab", "lab", ABOUT | CALIBRATE | OF_FILE},
    {"advice", "advice", CHECK | MADE},
    {"measurements", "measurements", CHECK | MADE},
    {"hinge_model", "hinge-model", ABOUT},
    {"force", "force", MADE},
    {"mask_tolerance", "mask-tolerance", MADE},
    {"mask_flatten", "mask-flatten", MADE},
    {"mask_format", "mask-format", MADE},
    {"mask_vertices", "mask-vertices", MADE},
    {"wafers", "wafers", PLAN | RECIPE | LOG},
    {"operators", "operators", PLAN | RECIPE},
    {"day", "day", PLAN | RECIPE},
    {"planned", "planned", PLAN | RECIPE},
    {"scene", "scene", SIMULATE | MODES | STATICS | ASSEMBLE | TRADEOFF},
    {"at", "at", MODES},
    {"path", "path", STATICS},
    {"method", "method", SIMULATE},
    {"integrator", "integrator", SIMULATE},
    {"stabilise", "stabilise", SIMULATE},
    {"rtol", "rtol", SIMULATE},
    {"samples", "samples", SIMULATE},
    {"independent", "independent", ASSEMBLE},
    {"rates", "rates", ASSEMBLE},
    {"accelerations", "accelerations", ASSEMBLE},
    {"level", "level", HINGE},
    {"budget", "budget", TRADEOFF},
    {"no_time", "no-time", TRADEOFF},
    {"study", "study", STUDY},
    {"run", "run", LOG | CALIBRATE | OF_LOG},
    {"entries", "entries", LOG | OF_FILE},
    {"lot", "lot", LOG},
};

enum { MOST_ARGUMENTS = 128, MOST_TEXT = 2000 };

typedef struct command {
    fw_arena *arena;
    const json_t *files; /* names and texts that came with the request */
    const struct fw_serve_beside *beside;
    const char *log; /* the one that "run" names, whole; NULL: none */
    const char **argv;
    size_t n;
    const char *why;
} command;

static fw_status wrong(command *c, const char *what, const char *why) {
    c->why = fw_arena_printf(c->arena, "%.80s %s", what, why);
    return c->why ? FW_INPUT : FW_NOMEM;
}

static fw_status push(command *c, const char *argument) {
    FW_NEED(argument);
    if (c->n == MOST_ARGUMENTS)
        return wrong(c, "\"set\" and \"options\"", "hold more entries than a job takes (128)");
    c->argv[c->n++] = argument;
    return FW_OK;
}

/* a value as a text for the command line */
static fw_status value_text(command *c, const char *name, const json_t *value, const char **text) {
    char number[64];
    if (json_is_string(value)) {
        if (json_string_length(value) > MOST_TEXT ||
            strlen(json_string_value(value)) != json_string_length(value))
            return wrong(c, name, "has a value that is longer than 2000 bytes or holds a NUL");
        *text = json_string_value(value);
        return FW_OK;
    }
    if (!json_is_number(value)) return wrong(c, name, "needs a text or a number as its value");
    FW_NEED(*text = fw_arena_strdup(
                c->arena, fw_number_text(number, sizeof number, json_number_value(value), 17)));
    return FW_OK;
}

/* "a.xml,b.xml", all of them files of the request? */
static bool are_files(const command *c, const char *text) {
    for (const char *at = text;; at++) {
        size_t n = strcspn(at, ",");
        const char *name = fw_arena_strndup(c->arena, at, n);
        if (!name || !json_object_get(c->files, name)) return false;
        at += n;
        if (!*at) return true;
    }
}

/* calibrate reads it, log keeps it */
static fw_status one_log(command *c, unsigned kind, const char *name, const char *text) {
    if (!c->beside || !c->beside->directory || !fw_serve_beside_is_log(c->beside, text))
        return wrong(c, name,
                     "has to name a log beside the description, or a new one: letters, digits, '-' "
                     "and '_' before .log, and not a file that is there and no log");
    FW_NEED(c->log = fw_arena_printf(c->arena, "%s%s", c->beside->directory, text));
    return kind == LOG ? push(c, fw_arena_printf(c->arena, "--run=%s", c->log)) : FW_OK;
}

static fw_status one_option(command *c, unsigned kind, const char *name, const json_t *value) {
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++) {
        if (strcmp(options[i].name, name) != 0) continue;
        /* a page keeps one set of options for all kinds */
        if (!(options[i].kinds & kind) || json_is_null(value) || json_is_false(value)) return FW_OK;
        if (json_is_true(value))
            return push(c, fw_arena_printf(c->arena, "--%s", options[i].option));
        const char *text;
        FW_TRY(value_text(c, name, value, &text));
        if ((options[i].kinds & OF_FILE) && !are_files(c, text))
            return wrong(c, name, "has to name files of the request, commas between");
        if (options[i].kinds & OF_LOG) return one_log(c, kind, name, text);
        return push(c, fw_arena_printf(c->arena, "--%s=%s", options[i].option, text));
    }
    return wrong(c, name, "is not an option of a job");
}

static fw_status one_set(command *c, const char *path, const json_t *value) {
    const char *text;
    if (!*path || strchr(path, '=') || strlen(path) > MOST_TEXT)
        return wrong(c, path,
                     "cannot be set: a path is not empty, has no '=' and at most 2000 bytes");
    FW_TRY(value_text(c, path, value, &text));
    return push(c, fw_arena_printf(c->arena, "--set=%s=%s", path, text));
}

static fw_status all(command *c, unsigned kind, const json_t *request) {
    const char *name;
    const json_t *value;
    json_t *set = json_object_get(request, "set"), *option = json_object_get(request, "options");
    if ((set && !json_is_object(set)) || (option && !json_is_object(option)))
        return wrong(c, "\"set\" and \"options\"", "must be objects");
    if (kind & ABOUT) json_object_foreach(set, name, value) FW_TRY(one_set(c, name, value));
    json_object_foreach(option, name, value) FW_TRY(one_option(c, kind, name, value));
    return FW_OK;
}

/* letters, digits, '-' and one '.' inside: no path, no option, and none of the names that a job uses itself */
static bool is_file_name(const char *name, const char *device) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyz0123456789-";
    size_t stem = strspn(name, plain), n = strlen(name);
    if (stem == 0 || name[0] == '-' || name[stem] != '.' || n > 60) return false;
    size_t end = strspn(name + stem + 1, plain);
    return end > 0 && stem + 1 + end == n && strcmp(name, device) != 0 &&
           strncmp(name, "archive.", 8) != 0;
}

enum { MOST_FILES = 4 };

static fw_status check_files(command *c, const json_t *files, const char *device) {
    const char *name;
    json_t *text;
    if (!files || json_is_null(files)) return FW_OK;
    if (!json_is_object(files) || json_object_size(files) > MOST_FILES)
        return wrong(c, "\"files\"", "must be an object of at most 4 names and texts");
    json_object_foreach((json_t *)files, name, text) {
        if (!is_file_name(name, device))
            return wrong(c, name,
                         "cannot be the name of a file: small letters, digits and '-', one '.' "
                         "inside, and not a name that the job uses itself");
        if (!json_is_string(text)) return wrong(c, name, "needs its text");
    }
    c->files = files;
    return FW_OK;
}

static const kind_row *kind_named(const char *name) {
    for (size_t i = 0; name && i < sizeof kinds / sizeof kinds[0]; i++)
        if (strcmp(kinds[i].name, name) == 0) return &kinds[i];
    return NULL;
}

static fw_status no_such_kind(fw_arena *arena, const char **why) {
    size_t count = sizeof kinds / sizeof kinds[0];
    fw_text text = fw_text_new(arena);
    fw_text_add(&text, "\"kind\" must be ");
    for (size_t i = 0; i < count; i++)
        fw_text_printf(&text, "%s%s", i == 0 ? "" : i + 1 < count ? ", " : " or ", kinds[i].name);
    FW_TRY(fw_text_end(&text));
    *why = text.data;
    return FW_INPUT;
}

/* behind what the request asks for, before the file */
static const struct {
    const char *word;
    unsigned kinds;
} last[] = {
    {"--output=out", ALL},
    {"--output=out/laboratory.xml", CALIBRATE},
    {"--json", ABOUT},
    {"--verbose", ABOUT | CALIBRATE},
    {"--color=never", ABOUT | CALIBRATE},
    {"--", ABOUT | CALIBRATE},
};

fw_status fw_serve_job_command(fw_arena *arena, const void *json, const char *file,
                               const struct fw_serve_beside *beside, const char **kind,
                               const char *const **argv, const char **why) {
    command c = {.arena = arena,
                 .beside = beside,
                 .argv = fw_arena_array(arena, const char *, MOST_ARGUMENTS + 10)};
    FW_NEED(c.argv);
    const kind_row *row = kind_named(json_string_value(json_object_get(json, "kind")));
    if (!row) return no_such_kind(arena, why);
    *kind = row->name;
    c.argv[c.n++] = "flexwright";
    c.argv[c.n++] = row->name;
    if (row->bit == STUDY && (json_object_get(json, "resume") || json_object_get(json, "results")))
        c.argv[c.n++] = "--resume";
    fw_status status = check_files(&c, json_object_get(json, "files"), file);
    if (status == FW_OK) status = all(&c, row->bit, json);
    *why = c.why;
    if (status != FW_OK) return status;
    /* of a log that is read; nothing can be added and reported in one run */
    if (row->bit == LOG && c.log && !json_object_get(json_object_get(json, "options"), "entries"))
        c.argv[c.n++] = "--report=out/log.html";
    for (size_t i = 0; i < sizeof last / sizeof last[0]; i++)
        if (last[i].kinds & row->bit) c.argv[c.n++] = last[i].word;
    c.argv[c.n++] = row->bit == CALIBRATE && c.log ? c.log : file;
    c.argv[c.n] = NULL;
    *argv = c.argv;
    return FW_OK;
}

/* ---- the files of a job ----
   A request names a file by its path in this list; no path of a request reaches the file system. */

enum { MOST_DEPTH = 4 };

typedef struct listing {
    fw_serve_job *job;
    size_t capacity;
} listing;

static fw_status add_to_list(listing *l, const char *path, uint64_t bytes) {
    fw_serve_job *job = l->job;
    if (job->files == FW_JOB_MOST_FILES) return FW_OK;
    if (job->files == l->capacity) {
        size_t more = l->capacity ? 2 * l->capacity : 64;
        FW_NEED(job->file =
                    fw_arena_grow(job->arena, job->file, l->capacity, more, sizeof *job->file));
        l->capacity = more;
    }
    job->file[job->files++] =
        (fw_serve_job_file){.path = path, .type = fw_serve_reply_type(path), .bytes = bytes};
    return FW_OK;
}

static fw_status list(listing *l, int parent, const char *name, const char *below, int depth);

static fw_status list_entry(listing *l, int fd, const char *name, const char *below, int depth) {
    struct stat info;
    const char *path = fw_arena_printf(l->job->arena, "%s%s", below, name);
    FW_NEED(path);
    if (fstatat(fd, name, &info, AT_SYMLINK_NOFOLLOW) != 0) return FW_OK;
    if (S_ISREG(info.st_mode)) return add_to_list(l, path, (uint64_t)info.st_size);
    if (!S_ISDIR(info.st_mode) || depth == MOST_DEPTH) return FW_OK;
    const char *deeper = fw_arena_printf(l->job->arena, "%s/", path);
    FW_NEED(deeper);
    return list(l, fd, name, deeper, depth + 1);
}

static fw_status list(listing *l, int parent, const char *name, const char *below, int depth) {
    int fd = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    DIR *dir = fd >= 0 ? fdopendir(fd) : NULL;
    if (!dir) {
        if (fd >= 0) close(fd);
        return FW_OK;
    }
    fw_status status = FW_OK;
    for (struct dirent *e; status == FW_OK && (e = readdir(dir));)
        if (strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0)
            status = list_entry(l, fd, e->d_name, below, depth);
    closedir(dir);
    return status;
}

static int by_path(const void *a, const void *b) {
    return strcmp(((const fw_serve_job_file *)a)->path, ((const fw_serve_job_file *)b)->path);
}

fw_status fw_serve_job_list(fw_serve_job *job) {
    listing l = {.job = job};
    job->files = 0;
    FW_TRY(list(&l, job->fd, "out", "", 0));
    if (job->files) qsort(job->file, job->files, sizeof *job->file, by_path);
    return FW_OK;
}

int fw_serve_job_open(const fw_serve_job *job, const fw_serve_job_file *file) {
    int out = openat(job->fd, "out", O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    int fd =
        out >= 0 ? openat(out, file->path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC) : -1;
    if (out >= 0) close(out);
    struct stat info;
    if (fd < 0 ||
        (fstat(fd, &info) == 0 && S_ISREG(info.st_mode) && (uint64_t)info.st_size == file->bytes))
        return fd;
    close(fd);
    return -1;
}

/* ---- the archive ----
   A directory as one .zip with the same bytes every time: files by name, the date of all is the
   first that the format knows, permissions are those of a plain file. Runs in a process of its
   own with limits, because compressing takes time. */

enum { DOS_DATE_1980_01_01 = (1 << 5) | 1, PLAIN_FILE = 0100644 };

static bool add_to_archive(zip_t *zip, const fw_serve_job_file *file) {
    char path[4200];
    if (snprintf(path, sizeof path, "out/%s", file->path) >= (int)sizeof path) return false;
    zip_source_t *source = zip_source_file(zip, path, 0, -1);
    if (!source) return false;
    zip_int64_t at = zip_file_add(zip, file->path, source, ZIP_FL_ENC_UTF_8);
    if (at < 0) {
        zip_source_free(source);
        return false;
    }
    zip_uint64_t index = (zip_uint64_t)at;
    return zip_file_set_dostime(zip, index, 0, DOS_DATE_1980_01_01, 0) == 0 &&
           zip_set_file_compression(zip, index, ZIP_CM_DEFLATE, 6) == 0 &&
           zip_file_set_external_attributes(zip, index, 0, ZIP_OPSYS_UNIX,
                                            (zip_uint32_t)PLAIN_FILE << 16) == 0;
}

int fw_serve_archive_main(void) {
    fw_arena *arena = fw_arena_new(0);
    fw_serve_job job = {.arena = arena, .fd = open(".", O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
    zip_t *zip = NULL;
    bool ok = arena && job.fd >= 0 && fw_serve_job_list(&job) == FW_OK;
    if (ok) zip = zip_open("archive.tmp", ZIP_CREATE | ZIP_TRUNCATE, NULL);
    ok = zip != NULL;
    for (size_t i = 0; ok && i < job.files; i++)
        ok = add_to_archive(zip, &job.file[i]);
    if (zip && zip_close(zip) != 0) {
        zip_discard(zip);
        ok = false;
    }
    ok = ok && rename("archive.tmp", "archive.zip") == 0;
    if (job.fd >= 0) close(job.fd);
    fw_arena_free(arena);
    return ok ? 0 : fw_status_exit(FW_IO);
}
