/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/output.h"
#include "base/text.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

struct fw_output {
    fw_arena *arena;
    fw_diags *diags;
    const char *path;  /* the target, no trailing '/' */
    const char *build; /* where it is built, beside the target; NULL after commit or abort */
    fw_output_file *file;
    size_t count, capacity;
};

static fw_status failed(fw_diags *diags, const char *path, const char *what) {
    fw_diag_error(diags, 222, (fw_place){.file = path}, "cannot %s: %s; nothing was changed", what,
                  strerror(errno));
    return FW_IO;
}

void fw_output_remove_tree(int parent, const char *name) {
    int fd = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (fd >= 0) {
        DIR *dir = fdopendir(fd);
        if (dir) {
            for (struct dirent *e; (e = readdir(dir));)
                if (strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0)
                    fw_output_remove_tree(fd, e->d_name);
            closedir(dir);
        } else
            close(fd);
        unlinkat(parent, name, AT_REMOVEDIR);
    } else
        unlinkat(parent, name, 0);
}

static int directory_is_empty(const char *path) {
    DIR *dir = opendir(path);
    if (!dir) return 0;
    int empty = 1;
    for (struct dirent *e; (e = readdir(dir));)
        if (strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0) empty = 0;
    closedir(dir);
    return empty;
}

void fw_output_remove_leftovers(fw_arena *arena, const char *path) {
    const char *slash = strrchr(path, '/');
    const char *parent = slash ? fw_arena_strndup(arena, path, (size_t)(slash - path) + 1) : ".";
    const char *prefix = fw_arena_printf(arena, "%s.tmp-", slash ? slash + 1 : path);
    DIR *dir = parent && prefix ? opendir(parent) : NULL;
    if (!dir) return;
    for (struct dirent *e; (e = readdir(dir));) {
        if (strncmp(e->d_name, prefix, strlen(prefix)) != 0) continue;
        char *end;
        long pid = strtol(e->d_name + strlen(prefix), &end, 10);
        char proc[64];
        snprintf(proc, sizeof proc, "/proc/%ld", pid);
        if (*end == '\0' && pid > 0 && access(proc, F_OK) != 0)
            fw_output_remove_tree(dirfd(dir), e->d_name);
    }
    closedir(dir);
}

static fw_status make_parents(fw_arena *arena, const char *path, fw_diags *diags) {
    char *copy = fw_arena_strdup(arena, path);
    FW_NEED(copy);
    for (char *slash = strchr(copy + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        if (mkdir(copy, 0777) != 0 && errno != EEXIST)
            return failed(diags, path, "make the directories above it");
        *slash = '/';
    }
    return FW_OK;
}

/* sha256 that the manifest lists for `name`, or NULL */
static const char *listed(const json_t *manifest, const char *name) {
    const json_t *outputs = json_object_get(manifest, "outputs"), *entry;
    size_t i;
    json_array_foreach(outputs, i, entry) {
        const char *text = json_string_value(json_object_get(entry, "name"));
        if (text && strcmp(text, name) == 0)
            return json_string_value(json_object_get(entry, "sha256"));
    }
    return NULL;
}

static fw_status unchanged(fw_output *o, const json_t *manifest, const char *name) {
    const char *path = fw_arena_printf(o->arena, "%s/%s", o->path, name);
    const char *hash = listed(manifest, name);
    FW_NEED(path);
    fw_place place = {.file = path};
    if (!hash) {
        fw_diag_error(
            o->diags, 223, place,
            "was not written by flexwright, and replacing %s would delete it: move it, or "
            "choose another directory with -o",
            o->path);
        return FW_IO;
    }
    char *data, now[65];
    size_t n;
    fw_mark mark = fw_arena_mark(o->arena);
    FW_TRY(fw_input_read(o->arena, path, SIZE_MAX / 4, o->diags, &data, &n));
    fw_sha256(data, n, now);
    fw_arena_rewind(o->arena, mark);
    if (strcmp(hash, now) == 0) return FW_OK;
    fw_diag_error(
        o->diags, 223, place,
        "was changed since flexwright wrote it, and replacing %s would lose that: move it, "
        "or choose another directory with -o",
        o->path);
    return FW_IO;
}

/* every file below the directory is one that the manifest lists, with the content it had */
static fw_status only_ours(fw_output *o, const json_t *manifest, const char *below) {
    const char *path = fw_arena_printf(o->arena, "%s/%s", o->path, below);
    DIR *dir = path ? opendir(path) : NULL;
    if (!dir) return path ? failed(o->diags, path, "look into the directory") : FW_NOMEM;
    fw_status status = FW_OK;
    for (struct dirent *e; status == FW_OK && (e = readdir(dir));) {
        if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0) continue;
        const char *name = fw_arena_printf(o->arena, "%s%s%s", below, *below ? "/" : "", e->d_name);
        struct stat info;
        if (!name)
            status = FW_NOMEM;
        else if (fstatat(dirfd(dir), e->d_name, &info, AT_SYMLINK_NOFOLLOW) != 0)
            status = failed(o->diags, name, "look at the file");
        else if (S_ISDIR(info.st_mode))
            status = only_ours(o, manifest, name);
        else if (strcmp(name, "manifest.json") != 0)
            status = unchanged(o, manifest, name);
    }
    closedir(dir);
    return status;
}

/* what is there may be replaced: nothing, an empty directory, or exactly what a manifest lists */
static fw_status check_target(fw_output *o) {
    struct stat info;
    if (lstat(o->path, &info) != 0) return FW_OK;
    fw_place place = {.file = o->path};
    if (!S_ISDIR(info.st_mode)) {
        fw_diag_error(o->diags, 223, place, "%s: choose a directory with -o",
                      S_ISLNK(info.st_mode) ? "is a symbolic link, which is not followed"
                                            : "exists and is not a directory");
        return FW_IO;
    }
    if (directory_is_empty(o->path)) return FW_OK;
    const char *path = fw_arena_printf(o->arena, "%s/manifest.json", o->path);
    FW_NEED(path);
    json_t *manifest = json_load_file(path, 0, NULL);
    if (!manifest) {
        fw_diag_error(o->diags, 223, place,
                      "is not empty and was not written by flexwright (no manifest.json in it): "
                      "choose another directory with -o, or empty it");
        return FW_IO;
    }
    fw_status status = only_ours(o, manifest, "");
    json_decref(manifest);
    return status;
}

/* not built yet, its target looked at */
static fw_status begin(fw_arena *arena, const char *path, fw_diags *diags, fw_output **output) {
    size_t n = strlen(path);
    while (n > 1 && path[n - 1] == '/')
        n--;
    fw_output *o = fw_arena_one(arena, fw_output);
    FW_NEED(o);
    *o = (fw_output){.arena = arena, .diags = diags, .path = fw_arena_strndup(arena, path, n)};
    FW_NEED(o->path);
    *output = o;
    return check_target(o);
}

fw_status fw_output_check(fw_arena *arena, const char *path, fw_diags *diags) {
    fw_output *o;
    FW_TRY(begin(arena, path, diags, &o));
    char *above = fw_arena_strdup(arena, o->path);
    FW_NEED(above);
    for (struct stat info;;) { /* what is there of the way to it: the last part must take files */
        char *slash = strrchr(above, '/');
        const char *at = !slash ? "." : slash == above ? "/" : above;
        if (slash) *slash = '\0';
        if (stat(at, &info) == 0) {
            if (!S_ISDIR(info.st_mode))
                errno = ENOTDIR;
            else if (access(at, W_OK | X_OK) == 0)
                return FW_OK;
            return failed(diags, at, "make a directory there");
        }
        if (!slash || slash == above) return failed(diags, at, "make a directory there");
    }
}

fw_status fw_output_open(fw_arena *arena, const char *path, fw_diags *diags, fw_output **output) {
    fw_output *o;
    FW_TRY(begin(arena, path, diags, &o));
    FW_TRY(make_parents(arena, o->path, diags));
    fw_output_remove_leftovers(arena, o->path);
    o->build = fw_arena_printf(arena, "%s.tmp-%ld", o->path, (long)getpid());
    FW_NEED(o->build);
    fw_output_remove_tree(AT_FDCWD, o->build);
    if (mkdir(o->build, 0777) != 0) return failed(diags, o->build, "make the directory");
    *output = o;
    return FW_OK;
}

/* writes, syncs and closes; every one of the three may be the first to report a full disk */
static int write_whole(const char *path, const void *data, size_t n) {
    int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (fd < 0) return 0;
    const char *p = data;
    while (n > 0) {
        ssize_t done = write(fd, p, n);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) {
            int why = done == 0 ? ENOSPC : errno;
            close(fd);
            errno = why;
            return 0;
        }
        p += done;
        n -= (size_t)done;
    }
    int ok = fsync(fd) == 0 || errno == EINVAL; /* EINVAL: a pipe or device has nothing to sync */
    int why = errno;
    if (close(fd) != 0 && ok) return 0;
    errno = why;
    return ok;
}

static fw_status remember(fw_output *o, const char *name, const void *data, size_t n) {
    if (o->count == o->capacity) {
        size_t more = o->capacity ? 2 * o->capacity : 16;
        fw_output_file *file = fw_arena_grow(o->arena, o->file, o->count, more, sizeof *o->file);
        FW_NEED(file);
        o->file = file;
        o->capacity = more;
    }
    char hash[65];
    fw_sha256(data, n, hash);
    fw_output_file entry = {fw_arena_strdup(o->arena, name), n, fw_arena_strdup(o->arena, hash)};
    FW_NEED(entry.name);
    FW_NEED(entry.sha256);
    size_t at = o->count++;
    for (; at > 0 && strcmp(o->file[at - 1].name, name) > 0; at--)
        o->file[at] = o->file[at - 1];
    o->file[at] = entry;
    return FW_OK;
}

fw_status fw_output_write(fw_output *o, const char *name, const void *data, size_t n) {
    const char *path = fw_arena_printf(o->arena, "%s/%s", o->build, name);
    FW_NEED(path);
    FW_TRY(make_parents(o->arena, path, o->diags));
    if (!write_whole(path, data, n)) return failed(o->diags, path, "write the file");
    return remember(o, name, data, n);
}

const fw_output_file *fw_output_files(const fw_output *o, size_t *count) {
    *count = o->count;
    return o->file;
}

static int sync_directory(const char *path) {
    int fd = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (fd < 0) return 0;
    int ok = fsync(fd) == 0 || errno == EINVAL;
    close(fd);
    return ok;
}

fw_status fw_output_commit(fw_output *o) {
    if (!sync_directory(o->build)) return failed(o->diags, o->build, "sync the directory");
    struct stat info;
    if (lstat(o->path, &info) != 0) {
        if (rename(o->build, o->path) != 0)
            return failed(o->diags, o->path, "put the results in place");
    } else if (renameat2(AT_FDCWD, o->build, AT_FDCWD, o->path, RENAME_EXCHANGE) == 0) {
        fw_output_remove_tree(AT_FDCWD, o->build); /* now holds what was there before */
    } else { /* a file system without exchange: move the old one aside first */
        const char *aside = fw_arena_printf(o->arena, "%s.tmp-%ld-old", o->path, (long)getpid());
        FW_NEED(aside);
        if (rename(o->path, aside) != 0)
            return failed(o->diags, o->path, "move the earlier results aside");
        if (rename(o->build, o->path) != 0) {
            rename(aside, o->path);
            return failed(o->diags, o->path, "put the results in place");
        }
        fw_output_remove_tree(AT_FDCWD, aside);
    }
    o->build = NULL;
    const char *slash = strrchr(o->path, '/');
    const char *parent =
        slash ? fw_arena_strndup(o->arena, o->path, (size_t)(slash - o->path) + 1) : ".";
    FW_NEED(parent);
    sync_directory(parent);
    return FW_OK;
}

void fw_output_abort(fw_output *o) {
    if (o && o->build) {
        fw_output_remove_tree(AT_FDCWD, o->build);
        o->build = NULL;
    }
}

fw_status fw_output_single(fw_arena *arena, const char *path, const void *data, size_t n,
                           fw_diags *diags) {
    if (strcmp(path, "-") == 0) {
        if (fwrite(data, 1, n, stdout) != n || fflush(stdout) != 0)
            return failed(diags, "standard output", "write");
        return FW_OK;
    }
    struct stat info;
    if (stat(path, &info) == 0 && !S_ISREG(info.st_mode)) /* a device or pipe: no rename */
        return write_whole(path, data, n) ? FW_OK : failed(diags, path, "write");
    const char *build = fw_arena_printf(arena, "%s.tmp-%ld", path, (long)getpid());
    FW_NEED(build);
    if (!write_whole(build, data, n) || rename(build, path) != 0) {
        int why = errno;
        unlink(build);
        errno = why;
        return failed(diags, path, "write the file");
    }
    return FW_OK;
}

fw_status fw_input_read(fw_arena *arena, const char *path, size_t most, fw_diags *diags,
                        char **data, size_t *n) {
    int standard = strcmp(path, "-") == 0;
    fw_place place = {.file = standard ? "standard input" : path};
    int fd = standard ? STDIN_FILENO : open(path, O_RDONLY | O_CLOEXEC);
    struct stat info;
    if (fd < 0 || (!standard && fstat(fd, &info) == 0 && S_ISDIR(info.st_mode))) {
        fw_diag_error(diags, 220, place, "cannot be read: %s",
                      fd < 0 ? strerror(errno) : "it is a directory");
        if (fd >= 0) close(fd);
        return FW_IO;
    }
    size_t capacity = 64 * 1024, length = 0;
    char *buffer = fw_arena_alloc(arena, capacity + 1, 1);
    fw_status status = buffer ? FW_OK : FW_NOMEM;
    while (status == FW_OK) {
        ssize_t got = read(fd, buffer + length, capacity - length);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) {
            fw_diag_error(diags, 220, place, "cannot be read: %s", strerror(errno));
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

static fw_status append_failed(const fw_append *file, int number, const char *what) {
    fw_place place = {file->path, 0, 0};
    fw_diag_error(file->diags, number, place, "%s: %s", what, strerror(errno));
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
    file->fd = open(path, O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
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
    if (ftruncate(file->fd, (off_t)file->n) != 0)
        append_failed(file, 222, "its last line is not complete and could not be taken away");
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
