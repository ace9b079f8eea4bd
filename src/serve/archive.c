/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A directory as one .zip with the same bytes every time: files by name, the date of all is the
   first that the format knows, permissions are those of a plain file. Runs in a process of its own
   with limits, because compressing takes time. */
#include "serve/jobs.h"
#include <fcntl.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zip.h>

enum { DOS_DATE_1980_01_01 = (1 << 5) | 1, PLAIN_FILE = 0100644 };

static bool add(zip_t *zip, const fw_serve_job_file *file) {
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
        ok = add(zip, &job.file[i]);
    if (zip && zip_close(zip) != 0) {
        zip_discard(zip);
        ok = false;
    }
    ok = ok && rename("archive.tmp", "archive.zip") == 0;
    if (job.fd >= 0) close(job.fd);
    fw_arena_free(arena);
    return ok ? 0 : fw_status_exit(FW_IO);
}
