/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/append.h"
#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

static fw_status failed(const fw_append *file, int number, const char *what) {
    fw_place place = {file->path, 0, 0};
    fw_diag_error(file->diags, number, place, "%s: %s", what, strerror(errno));
    return FW_IO;
}

static fw_status read_all(fw_arena *arena, size_t most, fw_append *file) {
    struct stat info;
    if (fstat(file->fd, &info) != 0) return failed(file, 220, "cannot be read");
    if (!S_ISREG(info.st_mode)) {
        errno = EINVAL;
        return failed(file, 220, "is not a file");
    }
    if ((unsigned long long)info.st_size > most) {
        errno = EFBIG;
        failed(file, 221, "is too large");
        return FW_LIMIT;
    }
    file->n = (size_t)info.st_size;
    FW_NEED(file->text = fw_arena_array(arena, char, file->n + 1));
    for (size_t done = 0; done < file->n;) {
        ssize_t got = pread(file->fd, file->text + done, file->n - done, (off_t)done);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return failed(file, 220, "cannot be read");
        done += (size_t)got;
    }
    return FW_OK;
}

fw_status fw_append_open(fw_arena *arena, const char *path, size_t most, fw_diags *diags,
                         fw_append *file) {
    *file = (fw_append){.path = path, .fd = -1, .diags = diags};
    file->fd = open(path, O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
    if (file->fd < 0) return failed(file, 222, "cannot be opened for writing");
    int locked;
    do
        locked = flock(file->fd, LOCK_EX);
    while (locked != 0 && errno == EINTR);
    fw_status status =
        locked == 0 ? read_all(arena, most, file) : failed(file, 222, "cannot be locked");
    if (status != FW_OK) fw_append_close(file);
    return status;
}

fw_status fw_append_text(fw_append *file, const char *text, size_t n) {
    ssize_t put;
    do
        put = write(file->fd, text, n);
    while (put < 0 && errno == EINTR);
    if (put == (ssize_t)n && fsync(file->fd) == 0) {
        file->n += n;
        return FW_OK;
    }
    if (put >= 0 && put < (ssize_t)n) errno = ENOSPC;
    fw_status status = failed(file, 222, "could not be written, and is as it was");
    if (ftruncate(file->fd, (off_t)file->n) != 0)
        failed(file, 222, "its last line is not complete and could not be taken away");
    return status;
}

void fw_append_close(fw_append *file) {
    if (file->fd < 0) return;
    struct stat info;
    if (fstat(file->fd, &info) == 0 && info.st_size == 0 && S_ISREG(info.st_mode))
        unlink(file->path);
    close(file->fd);
    file->fd = -1;
}
