/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What is written: single files, files beside others, and whole sets of files, which take the place of what was there
   in one step. */
#include "base/output.h"
#include "base/text.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* ---- files and their places ---- */

/* FW_D222 with the reason in errno: FW_IO */
static fw_status failed(fw_diags *diags, const char *path, const char *what) {
    fw_diag_error(fw_diags_because(diags, errno), 222, (fw_place){.file = path},
                  "cannot %s: %s; nothing was changed", what, strerror(errno));
    return FW_IO;
}

/* the directory that a path is in; NULL: out of memory */
static const char *parent_of(fw_arena *arena, const char *path) {
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

/* makes, writes, syncs and closes a file; each may be the first to report a full disk. false: errno says why */
static bool put_file(const char *path, const void *data, size_t n) {
    int fd = open_again(path, O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW);
    if (fd < 0) return false;
    bool ok = write_bytes(fd, data, n) && sync_bytes(fd);
    int why = errno;
    /* interrupted while closing: the descriptor is gone, and what was synced is on the disk */
    if (close(fd) != 0 && ok) return errno == EINTR;
    errno = why;
    return ok;
}

/* what a directory lists survives a power cut; false: errno says why */
static bool sync_directory(const char *path) {
    int fd = open_again(path, O_RDONLY | O_DIRECTORY);
    if (fd < 0) return false;
    bool ok = sync_bytes(fd);
    int why = errno;
    close(fd);
    errno = why;
    return ok;
}

/* What has the two names gets the other's; both must be there. false: errno says why, and all is as
   it was. In one step where the file system can, else `spare` is the name of one of them for a
   moment. */
static bool exchange(const char *a, const char *b, const char *spare) {
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
            /* the kernel pads every entry, so that the next is aligned */
            const struct dirent64 *e = (const void *)(room + at);
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
    const char *parent = parent_of(arena, path);
    const char *prefix = fw_arena_printf(arena, "%s.tmp-", slash ? slash + 1 : path);
    DIR *dir = parent && prefix ? opendir(parent) : NULL;
    if (!dir) return;
    for (struct dirent *e; (e = readdir(dir));) {
        if (strncmp(e->d_name, prefix, strlen(prefix)) != 0) continue;
        char *end;
        long pid = strtol(e->d_name + strlen(prefix), &end, 10);
        char proc[64];
        snprintf(proc, sizeof proc, "/proc/%ld", pid);
        /* SQLite has a journal beside what it writes */
        bool ours = *end == '\0' || strcmp(end, "-old") == 0 || strcmp(end, "-journal") == 0;
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
            return failed(diags, "standard output", "write");
        return FW_OK;
    }
    struct stat info;
    if (stat(path, &info) == 0 && !S_ISREG(info.st_mode)) /* a device or pipe: no rename */
        return put_file(path, data, n) ? FW_OK : failed(diags, path, "write");
    fw_output_member file = {strrchr(path, '/') ? strrchr(path, '/') + 1 : path, data, n};
    const char *parent = parent_of(arena, path);
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
    if (p->replaced) return exchange(p->build, p->path, p->spare);
    return rename(p->build, p->path) == 0;
}

/* false: the new one stays where it is, the earlier one where the new one was written */
static bool take_back(const placed *p) {
    if (p->replaced) return exchange(p->build, p->path, p->spare);
    return rename(p->path, p->build) == 0;
}

/* writes all of them beside their places and then puts them there; errno and *wrong: what failed */
static bool write_members(const fw_output_member *file, placed *p, size_t count, fw_diags *diags,
                          const char **wrong) {
    for (size_t i = 0; i < count; i++) {
        *wrong = p[i].path;
        p[i].there = true; /* or a part of it */
        if (!put_file(p[i].build, file[i].data, file[i].n)) return false;
    }
    for (size_t i = 0; i < count; i++) {
        *wrong = p[i].path;
        if (put_in_place(&p[i])) continue;
        int why = errno;
        while (i-- > 0)
            if (!take_back(&p[i])) {
                p[i].there = false;
                fw_diag_error(fw_diags_because(diags, errno), 222, (fw_place){.file = p[i].path},
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
    if (!done) return failed(diags, wrong, "write the file");
    sync_directory(directory); /* all is said and done; a power cut now may bring back the old */
    return FW_OK;
}

/* ---- a set of files ---- */

struct fw_output {
    fw_arena *arena;
    fw_diags *diags;
    const char *path;  /* the target, no trailing '/' */
    const char *build; /* where it is built, beside the target; NULL after commit or abort */
    fw_output_file *file;
    size_t count, capacity;
};

static bool is_entry(const struct dirent *e) {
    return strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0;
}

static fw_status directory_is_empty(fw_output *o, bool *empty) {
    DIR *dir = opendir(o->path);
    if (!dir)
        return errno == ENOMEM ? FW_NOMEM : failed(o->diags, o->path, "look into the directory");
    *empty = true;
    errno = 0;
    for (struct dirent *e; *empty && (e = readdir(dir)); errno = 0)
        *empty = !is_entry(e);
    int why = errno;
    closedir(dir);
    errno = why;
    return why == 0 ? FW_OK : failed(o->diags, o->path, "look into the directory");
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

fw_status fw_output_directory(fw_arena *arena, const char *path, bool *made) {
    fw_diags untold = fw_diags_new(arena);
    const fw_status status = make_parents(arena, path, &untold);
    *made = status != FW_NOMEM && mkdir(path, 0777) == 0;
    return status == FW_NOMEM ? FW_NOMEM : FW_OK;
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
    if (!dir)
        return path && errno != ENOMEM ? failed(o->diags, path, "look into the directory")
                                       : FW_NOMEM;
    fw_status status = FW_OK;
    /* an entry that cannot be read may be a person's file */
    errno = 0;
    for (struct dirent *e; status == FW_OK && (e = readdir(dir)); errno = 0) {
        if (!is_entry(e)) continue;
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
    if (status == FW_OK && errno != 0) status = failed(o->diags, path, "look into the directory");
    closedir(dir);
    return status;
}

/* *manifest of what is there, NULL: there is none, or it is not one */
static fw_status read_manifest(fw_output *o, json_t **manifest) {
    const char *path = fw_arena_printf(o->arena, "%s/manifest.json", o->path);
    FW_NEED(path);
    *manifest = NULL;
    struct stat info;
    if (lstat(path, &info) != 0)
        return errno == ENOENT ? FW_OK : failed(o->diags, path, "look at the file");
    char *text;
    size_t n;
    FW_TRY(fw_input_read(o->arena, path, SIZE_MAX / 4, o->diags, &text, &n));
    errno = 0; /* jansson tells a lack of memory by its error only sometimes */
    *manifest = json_loadb(text, n, 0, NULL);
    return !*manifest && errno == ENOMEM ? FW_NOMEM : FW_OK;
}

/* what is there may be replaced: nothing, an empty directory, or exactly what a manifest lists */
static fw_status check_target(fw_output *o) {
    struct stat info;
    if (lstat(o->path, &info) != 0)
        return errno == ENOENT || errno == ENOTDIR /* making the parents will say */
                   ? FW_OK
                   : failed(o->diags, o->path, "look at what is there");
    fw_place place = {.file = o->path};
    if (!S_ISDIR(info.st_mode)) {
        fw_diag_error(o->diags, 223, place, "%s: choose a directory with -o",
                      S_ISLNK(info.st_mode) ? "is a symbolic link, which is not followed"
                                            : "exists and is not a directory");
        return FW_IO;
    }
    bool empty;
    json_t *manifest;
    FW_TRY(directory_is_empty(o, &empty));
    if (empty) return FW_OK;
    FW_TRY(read_manifest(o, &manifest));
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
    if (mkdir(o->build, 0777) != 0) return failed(diags, o->path, "make the directory");
    *output = o;
    return FW_OK;
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
    if (!put_file(path, data, n)) return failed(o->diags, path, "write the file");
    return remember(o, name, data, n);
}

const fw_output_file *fw_output_files(const fw_output *o, size_t *count) {
    *count = o->count;
    return o->file;
}

/* the directories of the files, from the innermost: what each lists must be on the disk before the
   whole is put in place */
static fw_status sync_directories(fw_output *o) {
    const char *last = "";
    for (size_t i = 0; i < o->count; i++) { /* by name: files of a directory stand together */
        const char *name = o->file[i].name;
        for (const char *slash = strrchr(name, '/'); slash;
             slash = memrchr(name, '/', (size_t)(slash - name))) {
            size_t n = (size_t)(slash - name);
            if (strncmp(last, name, n + 1) == 0) continue;
            const char *path = fw_arena_printf(o->arena, "%s/%.*s", o->build, (int)n, name);
            FW_NEED(path);
            if (!sync_directory(path)) return failed(o->diags, path, "sync the directory");
        }
        last = name;
    }
    return sync_directory(o->build) ? FW_OK : failed(o->diags, o->build, "sync the directory");
}

fw_status fw_output_commit(fw_output *o) {
    FW_TRY(sync_directories(o));
    const char *spare = fw_arena_printf(o->arena, "%s.tmp-%ld-old", o->path, (long)getpid());
    const char *parent = parent_of(o->arena, o->path);
    FW_NEED(spare);
    FW_NEED(parent);
    struct stat info;
    bool earlier = lstat(o->path, &info) == 0;
    if (earlier ? !exchange(o->build, o->path, spare) : rename(o->build, o->path) != 0)
        return failed(o->diags, o->path, "put the results in place");
    if (earlier) fw_output_remove_tree(AT_FDCWD, o->build); /* now holds what was there before */
    o->build = NULL;
    sync_directory(parent);
    return FW_OK;
}

void fw_output_abort(fw_output *o) {
    if (o && o->build) {
        fw_output_remove_tree(AT_FDCWD, o->build);
        o->build = NULL;
    }
}
