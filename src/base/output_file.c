/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/output_file.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

fw_status fw_output_failed(fw_diags *diags, const char *path, const char *what) {
    fw_diag_error(diags, 222, (fw_place){.file = path}, "cannot %s: %s; nothing was changed", what,
                  strerror(errno));
    return FW_IO;
}

const char *fw_output_parent(fw_arena *arena, const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? fw_arena_strndup(arena, path, (size_t)(slash - path) + 1) : ".";
}

static int open_again(const char *path, int flags) {
    int fd;
    do
        fd = open(path, flags | O_CLOEXEC, 0666);
    while (fd < 0 && errno == EINTR);
    return fd;
}

static bool write_bytes(int fd, const char *data, size_t n) {
    while (n > 0) {
        ssize_t done = write(fd, data, n);
        if (done < 0 && errno == EINTR) continue;
        if (done == 0) errno = ENOSPC;
        if (done <= 0) return false;
        data += done;
        n -= (size_t)done;
    }
    return true;
}

/* EINVAL: a pipe or device has nothing to sync */
static bool sync_bytes(int fd) {
    int done;
    do
        done = fsync(fd);
    while (done != 0 && errno == EINTR);
    return done == 0 || errno == EINVAL;
}

/* each of writing, syncing and closing may be the first to report a full disk */
bool fw_output_put(const char *path, const void *data, size_t n) {
    int fd = open_again(path, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW);
    if (fd < 0) return false;
    bool ok = write_bytes(fd, data, n) && sync_bytes(fd);
    int why = errno;
    /* interrupted while closing: the descriptor is gone, and what was synced is on the disk */
    if (close(fd) != 0 && ok) return errno == EINTR;
    errno = why;
    return ok;
}

bool fw_output_sync_directory(const char *path) {
    int fd = open_again(path, O_RDONLY | O_DIRECTORY);
    if (fd < 0) return false;
    bool ok = sync_bytes(fd);
    int why = errno;
    close(fd);
    errno = why;
    return ok;
}

bool fw_output_exchange(const char *a, const char *b, const char *spare) {
    if (renameat2(AT_FDCWD, a, AT_FDCWD, b, RENAME_EXCHANGE) == 0) return true;
    if (errno != EINVAL && errno != ENOSYS) return false;
    if (rename(b, spare) != 0) return false;
    if (rename(a, b) == 0) {
        if (rename(spare, a) == 0) return true;
        int why = errno;
        rename(b, a);
        errno = why;
    }
    int why = errno;
    rename(spare, b);
    errno = why;
    return false;
}

/* ---- what is removed ---- */

/* Entries are read into a buffer of its own, since what is removed may be what a run leaves that found
   no memory, where opendir finds none either. */
static void remove_below(int fd) {
    char room[4096] __attribute__((aligned(16)));
    ssize_t got;
    while ((got = getdents64(fd, room, sizeof room)) > 0)
        for (ssize_t at = 0; at < got;) {
            const struct dirent64 *e = (const struct dirent64 *)(room + at);
            if (strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0)
                fw_output_remove_tree(fd, e->d_name);
            at += e->d_reclen;
        }
}

void fw_output_remove_tree(int parent, const char *name) {
    int fd = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (fd >= 0) {
        remove_below(fd);
        close(fd);
    }
    if (unlinkat(parent, name, AT_REMOVEDIR) != 0 && errno == ENOTDIR) unlinkat(parent, name, 0);
}

void fw_output_remove_leftovers(fw_arena *arena, const char *path) {
    const char *slash = strrchr(path, '/');
    const char *parent = fw_output_parent(arena, path);
    const char *prefix = fw_arena_printf(arena, "%s.tmp-", slash ? slash + 1 : path);
    DIR *dir = parent && prefix ? opendir(parent) : NULL;
    if (!dir) return;
    for (struct dirent *e; (e = readdir(dir));) {
        if (strncmp(e->d_name, prefix, strlen(prefix)) != 0) continue;
        char *end;
        long pid = strtol(e->d_name + strlen(prefix), &end, 10);
        char proc[64];
        snprintf(proc, sizeof proc, "/proc/%ld", pid);
        bool ours = *end == '\0' || strcmp(end, "-old") == 0;
        if (ours && pid > 0 && access(proc, F_OK) != 0)
            fw_output_remove_tree(dirfd(dir), e->d_name);
    }
    closedir(dir);
}

/* ---- one file ---- */

fw_status fw_output_single(fw_arena *arena, const char *path, const void *data, size_t n,
                           fw_diags *diags) {
    if (strcmp(path, "-") == 0) {
        if (fwrite(data, 1, n, stdout) != n || fflush(stdout) != 0)
            return fw_output_failed(diags, "standard output", "write");
        return FW_OK;
    }
    struct stat info;
    if (stat(path, &info) == 0 && !S_ISREG(info.st_mode)) /* a device or pipe: no rename */
        return fw_output_put(path, data, n) ? FW_OK : fw_output_failed(diags, path, "write");
    fw_output_member file = {strrchr(path, '/') ? strrchr(path, '/') + 1 : path, data, n};
    const char *parent = fw_output_parent(arena, path);
    FW_NEED(parent);
    return fw_output_members(arena, parent, &file, 1, diags);
}

/* ---- several files of a directory, all of them or none ---- */

typedef struct placed { /* names of one of them */
    const char *path;
    const char *build; /* where it is written; then what was there before, if anything was */
    const char *spare;
    bool there, replaced; /* written; put in place of an earlier one */
} placed;

static fw_status names_of(fw_arena *arena, const char *directory, const fw_output_member *file,
                          placed *p) {
    bool here = strcmp(directory, ".") == 0;
    const char *slash = here || directory[strlen(directory) - 1] == '/' ? "" : "/";
    p->path = fw_arena_printf(arena, "%s%s%s", here ? "" : directory, slash, file->name);
    FW_NEED(p->path);
    FW_NEED(p->build = fw_arena_printf(arena, "%s.tmp-%ld", p->path, (long)getpid()));
    FW_NEED(p->spare = fw_arena_printf(arena, "%s.tmp-%ld-old", p->path, (long)getpid()));
    return FW_OK;
}

static bool put_in_place(placed *p) {
    struct stat info;
    p->replaced = lstat(p->path, &info) == 0 && !S_ISDIR(info.st_mode);
    if (p->replaced) return fw_output_exchange(p->build, p->path, p->spare);
    return rename(p->build, p->path) == 0;
}

/* false: the new one stays where it is, the earlier one where the new one was written */
static bool take_back(const placed *p) {
    if (p->replaced) return fw_output_exchange(p->build, p->path, p->spare);
    return rename(p->path, p->build) == 0;
}

/* writes all of them beside their places and then puts them there; errno and *wrong: what failed */
static bool write_members(const fw_output_member *file, placed *p, size_t count, fw_diags *diags,
                          const char **wrong) {
    for (size_t i = 0; i < count; i++) {
        *wrong = p[i].path;
        p[i].there = true; /* or a part of it */
        if (!fw_output_put(p[i].build, file[i].data, file[i].n)) return false;
    }
    for (size_t i = 0; i < count; i++) {
        *wrong = p[i].path;
        if (put_in_place(&p[i])) continue;
        int why = errno;
        while (i-- > 0)
            if (!take_back(&p[i])) {
                p[i].there = false;
                fw_diag_error(diags, 222, (fw_place){.file = p[i].path},
                              "is the new one and could not be taken back: %s; the earlier one is "
                              "%s",
                              strerror(errno), p[i].replaced ? p[i].build : "none");
            }
        errno = why;
        return false;
    }
    return true;
}

fw_status fw_output_members(fw_arena *arena, const char *directory, const fw_output_member *file,
                            size_t count, fw_diags *diags) {
    placed *p = fw_arena_array(arena, placed, count);
    FW_NEED(p);
    for (size_t i = 0; i < count; i++) {
        FW_TRY(names_of(arena, directory, &file[i], &p[i]));
        fw_output_remove_leftovers(arena, p[i].path);
    }
    const char *wrong = directory;
    bool done = write_members(file, p, count, diags, &wrong);
    int why = errno;
    for (size_t i = 0; i < count; i++)
        if (p[i].there)
            unlink(p[i].build); /* what could not be put in place, or what stood there before */
    errno = why;
    if (!done) return fw_output_failed(diags, wrong, "write the file");
    fw_output_sync_directory(
        directory); /* all is said and done; a power cut now may bring back the old */
    return FW_OK;
}
