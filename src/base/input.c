/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is read: whole files, files that only grow, and the packs beside the program. */
#include "base/output.h"
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <link.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/auxv.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- whole files ---- */

/* what may be read: a file of bytes. A pipe would be waited for, a device has no end, and both would
   give something else the second time; opened without waiting, and refused by what they are. */
static const char *not_a_file(mode_t mode) {
    if (S_ISREG(mode)) return NULL;
    if (S_ISDIR(mode)) return "it is a directory";
    if (S_ISFIFO(mode))
        return "it is a pipe; for standard input give - as the name of the device file";
    if (S_ISSOCK(mode)) return "it is a socket";
    return "it is a device";
}

/* the descriptor, or -1 with *why and the system's *reason (errno; 0: it has none) */
static int open_file(const char *path, const char **why, int *reason) {
    int fd;
    do
        fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    while (fd < 0 && errno == EINTR);
    struct stat info;
    const bool refused = fd < 0 || fstat(fd, &info) != 0;
    *reason = refused ? errno : S_ISDIR(info.st_mode) ? EISDIR : 0;
    *why = refused ? strerror(*reason) : not_a_file(info.st_mode);
    if (fd >= 0 && *why) {
        close(fd);
        fd = -1;
    } else if (*reason == ENXIO && fd < 0)
        *why = "it is a socket";
    return fd;
}

/* bytes of a file and one, so that its end is seen without more room; of what has no size yet, a usual one */
static size_t room_for(int fd, size_t most) {
    struct stat about;
    if (fstat(fd, &about) != 0 || !S_ISREG(about.st_mode) || about.st_size <= 0) return 64 * 1024;
    const uintmax_t size = (uintmax_t)about.st_size;
    return size < most ? (size_t)size + 1 : most + 1;
}

fw_status fw_input_read(fw_arena *arena, const char *path, size_t most, fw_diags *diags,
                        char **data, size_t *n) {
    int standard = strcmp(path, "-") == 0;
    fw_place place = {.file = standard ? "standard input" : path};
    const char *why;
    int reason = 0, fd = standard ? STDIN_FILENO : open_file(path, &why, &reason);
    if (fd < 0) {
        fw_diag_error(fw_diags_because(diags, reason), 220, place, "cannot be read: %s", why);
        return FW_IO;
    }
    size_t capacity = room_for(fd, most), length = 0;
    char *buffer = fw_arena_raw(arena, capacity + 1);
    fw_status status = buffer ? FW_OK : FW_NOMEM;
    while (status == FW_OK) {
        ssize_t got = read(fd, buffer + length, capacity - length);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) {
            fw_diag_error(fw_diags_because(diags, errno), 220, place, "cannot be read: %s",
                          strerror(errno));
            status = FW_IO;
        }
        if (got <= 0) break;
        length += (size_t)got;
        if (length > most) {
            fw_diag_error(diags, 221, place,
                          "is larger than %zu bytes, the most that is read from one file", most);
            status = FW_INPUT;
        } else if (length == capacity) {
            buffer = fw_arena_grow(arena, buffer, length, 2 * capacity + 1, 1);
            capacity *= 2;
            if (!buffer) status = FW_NOMEM;
        }
    }
    if (!standard) close(fd);
    if (status != FW_OK) return status;
    buffer[length] = '\0';
    *data = buffer;
    *n = length;
    return FW_OK;
}

/* ---- files that only grow ---- */

static fw_status append_failed(const fw_append *file, int number, const char *what) {
    fw_place place = {file->path, 0, 0};
    fw_diag_error(fw_diags_because(file->diags, errno), number, place, "%s: %s", what,
                  strerror(errno));
    return FW_IO;
}

static fw_status read_all(fw_arena *arena, size_t most, fw_append *file) {
    struct stat info;
    if (fstat(file->fd, &info) != 0) return append_failed(file, 220, "cannot be read");
    if (!S_ISREG(info.st_mode)) {
        errno = EINVAL;
        return append_failed(file, 220, "is not a file");
    }
    if ((unsigned long long)info.st_size > most) {
        errno = EFBIG;
        append_failed(file, 221, "is too large");
        return FW_LIMIT;
    }
    file->n = (size_t)info.st_size;
    FW_NEED(file->text = fw_arena_array(arena, char, file->n + 1));
    for (size_t done = 0; done < file->n;) {
        ssize_t got = pread(file->fd, file->text + done, file->n - done, (off_t)done);
        if (got < 0 && errno == EINTR) continue;
        if (got <= 0) return append_failed(file, 220, "cannot be read");
        done += (size_t)got;
    }
    return FW_OK;
}

fw_status fw_append_open(fw_arena *arena, const char *path, size_t most, fw_diags *diags,
                         fw_append *file) {
    *file = (fw_append){.path = path, .fd = -1, .diags = diags};
    file->fd = open(path, O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC | O_NONBLOCK | O_NOCTTY, 0666);
    if (file->fd < 0) return append_failed(file, 222, "cannot be opened for writing");
    int locked;
    do
        locked = flock(file->fd, LOCK_EX);
    while (locked != 0 && errno == EINTR);
    fw_status status =
        locked == 0 ? read_all(arena, most, file) : append_failed(file, 222, "cannot be locked");
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
    fw_status status = append_failed(file, 222, "could not be written, and is as it was");
    fw_append_take_back(file, file->n);
    return status;
}

void fw_append_take_back(fw_append *file, size_t n) {
    if (ftruncate(file->fd, (off_t)n) != 0 || fsync(file->fd) != 0)
        append_failed(file, 222, "its last line should not be there and could not be taken away");
    else
        file->n = n;
}

void fw_append_close(fw_append *file) {
    if (file->fd < 0) return;
    struct stat info;
    if (fstat(file->fd, &info) == 0 && info.st_size == 0 && S_ISREG(info.st_mode))
        unlink(file->path);
    close(file->fd);
    file->fd = -1;
}

/* ---- packs ----

   They lie beside the very program or library that asks, so that an installed tree can be moved. */

/* the file that this code was loaded from; false: it is not known */
static bool own_file(char path[PATH_MAX]) {
    static const char here = 0; /* an object of that file, as dladdr1 asks for */
    Dl_info info;
    void *extra = NULL;
    if (!dladdr1(&here, &info, &extra, RTLD_DL_LINKMAP) || !extra) return false;
    const struct link_map *map = extra;
    if (map->l_name[0]) return realpath(map->l_name, path) != NULL;
    if (realpath("/proc/self/exe", path)) return true;
    const char *called = (const char *)getauxval(AT_EXECFN); /* a bare root has no /proc */
    return called && realpath(called, path) != NULL;
}

static bool is_place(const char *part, size_t n) {
    static const char *const name[] = {"bin", "lib", "lib64"};
    for (size_t i = 0; i < sizeof name / sizeof name[0]; i++)
        if (strlen(name[i]) == n && memcmp(name[i], part, n) == 0) return true;
    return false;
}

/* PREFIX of PREFIX/bin/FILE or PREFIX/lib/.../FILE: what stands before the last such directory. false:
   there is none, as in a build tree */
static bool prefix_of(char *path) {
    for (char *end = strrchr(path, '/'); end && end > path; end = strrchr(path, '/')) {
        *end = '\0';
        const char *part = strrchr(path, '/');
        if (!part || !is_place(part + 1, strlen(part + 1))) continue;
        path[part - path] = '\0';
        return true;
    }
    return false;
}

static bool readable(const char *path) {
    return access(path, R_OK) == 0;
}

fw_status fw_data_path(fw_arena *arena, const char *override, const char *name, const char **path) {
    static const char *const root[] = {FW_INSTALL_DATA_DIR, FW_SOURCE_DATA_DIR};
    char own[PATH_MAX];
    if (override && override[0]) {
        FW_NEED(*path = fw_arena_printf(arena, "%s/%s", override, name));
        if (!readable(*path)) *path = NULL;
        return FW_OK;
    }
    if (own_file(own) && prefix_of(own)) {
        FW_NEED(*path = fw_arena_printf(arena, "%s/share/flexwright/%s", own, name));
        if (readable(*path)) return FW_OK;
    }
    for (size_t i = 0; i < sizeof root / sizeof root[0]; i++) {
        FW_NEED(*path = fw_arena_printf(arena, "%s/%s", root[i], name));
        if (readable(*path)) return FW_OK;
    }
    *path = NULL;
    return FW_OK;
}

static int by_name(const void *a, const void *b) {
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

fw_status fw_data_names(fw_arena *arena, const char *override, const char *directory,
                        const char *const **name, size_t *n) {
    enum { MOST = 256 };
    const char *path, **found = fw_arena_array(arena, const char *, MOST);
    FW_NEED(found);
    *name = found, *n = 0;
    FW_TRY(fw_data_path(arena, override, directory, &path));
    DIR *dir = path ? opendir(path) : NULL;
    if (path && !dir) return errno == ENOMEM ? FW_NOMEM : FW_IO;
    fw_status status = FW_OK;
    errno = 0;
    for (struct dirent *e; dir && status == FW_OK && *n < MOST && (e = readdir(dir));) {
        const size_t length = strlen(e->d_name);
        if (length < 5 || strcmp(e->d_name + length - 4, ".xml") != 0) continue;
        found[*n] = fw_arena_strndup(arena, e->d_name, length - 4);
        status = found[(*n)++] ? FW_OK : FW_NOMEM;
    }
    if (status == FW_OK && dir && errno != 0) status = FW_IO;
    if (dir) closedir(dir);
    if (status == FW_OK && *n > 1) qsort(found, *n, sizeof *found, by_name);
    return status;
}
