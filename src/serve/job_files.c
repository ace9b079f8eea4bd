/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The files of a job, and their archive. A request names a file by its path in this list; no path
   of a request reaches the file system. */
#include "serve/jobs.h"
#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zip.h>

enum { MOST_DEPTH = 4 };

static const char *type_of(const char *path) {
    static const struct {
        const char *ending, *type;
    } known[] = {{".html", "text/html; charset=utf-8"},
                 {".svg", "image/svg+xml"},
                 {".png", "image/png"},
                 {".json", "application/json"},
                 {".csv", "text/csv; charset=utf-8"},
                 {".txt", "text/plain; charset=utf-8"},
                 {".ics", "text/calendar; charset=utf-8"},
                 {".xml", "application/xml"}};
    const char *dot = strrchr(path, '.');
    for (size_t i = 0; dot && i < sizeof known / sizeof known[0]; i++)
        if (strcmp(dot, known[i].ending) == 0) return known[i].type;
    return "application/octet-stream";
}

typedef struct listing {
    fw_serve_job *job;
    size_t capacity;
} listing;

static fw_status add(listing *l, const char *path, uint64_t bytes) {
    fw_serve_job *job = l->job;
    if (job->files == FW_JOB_MOST_FILES) return FW_OK;
    if (job->files == l->capacity) {
        size_t more = l->capacity ? 2 * l->capacity : 64;
        FW_NEED(job->file =
                    fw_arena_grow(job->arena, job->file, l->capacity, more, sizeof *job->file));
        l->capacity = more;
    }
    job->file[job->files++] =
        (fw_serve_job_file){.path = path, .type = type_of(path), .bytes = bytes};
    return FW_OK;
}

static fw_status list(listing *l, int parent, const char *name, const char *below, int depth);

static fw_status one(listing *l, int fd, const char *name, const char *below, int depth) {
    struct stat info;
    const char *path = fw_arena_printf(l->job->arena, "%s%s", below, name);
    FW_NEED(path);
    if (fstatat(fd, name, &info, AT_SYMLINK_NOFOLLOW) != 0) return FW_OK;
    if (S_ISREG(info.st_mode)) return add(l, path, (uint64_t)info.st_size);
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
            status = one(l, fd, e->d_name, below, depth);
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
