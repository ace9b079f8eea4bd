/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "base/output_file.h"
#include "base/text.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdint.h>
#include <string.h>
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

static bool is_entry(const struct dirent *e) {
    return strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0;
}

static fw_status directory_is_empty(fw_output *o, bool *empty) {
    DIR *dir = opendir(o->path);
    if (!dir)
        return errno == ENOMEM ? FW_NOMEM
                               : fw_output_failed(o->diags, o->path, "look into the directory");
    *empty = true;
    errno = 0;
    for (struct dirent *e; *empty && (e = readdir(dir)); errno = 0)
        *empty = !is_entry(e);
    int why = errno;
    closedir(dir);
    errno = why;
    return why == 0 ? FW_OK : fw_output_failed(o->diags, o->path, "look into the directory");
}

static fw_status make_parents(fw_arena *arena, const char *path, fw_diags *diags) {
    char *copy = fw_arena_strdup(arena, path);
    FW_NEED(copy);
    for (char *slash = strchr(copy + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        if (mkdir(copy, 0777) != 0 && errno != EEXIST)
            return fw_output_failed(diags, path, "make the directories above it");
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
    if (!dir)
        return path && errno != ENOMEM ? fw_output_failed(o->diags, path, "look into the directory")
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
            status = fw_output_failed(o->diags, name, "look at the file");
        else if (S_ISDIR(info.st_mode))
            status = only_ours(o, manifest, name);
        else if (strcmp(name, "manifest.json") != 0)
            status = unchanged(o, manifest, name);
    }
    if (status == FW_OK && errno != 0)
        status = fw_output_failed(o->diags, path, "look into the directory");
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
        return errno == ENOENT ? FW_OK : fw_output_failed(o->diags, path, "look at the file");
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
                   : fw_output_failed(o->diags, o->path, "look at what is there");
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
            return fw_output_failed(diags, at, "make a directory there");
        }
        if (!slash || slash == above) return fw_output_failed(diags, at, "make a directory there");
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
    if (mkdir(o->build, 0777) != 0) return fw_output_failed(diags, o->build, "make the directory");
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
    if (!fw_output_put(path, data, n)) return fw_output_failed(o->diags, path, "write the file");
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
            if (!fw_output_sync_directory(path))
                return fw_output_failed(o->diags, path, "sync the directory");
        }
        last = name;
    }
    return fw_output_sync_directory(o->build)
               ? FW_OK
               : fw_output_failed(o->diags, o->build, "sync the directory");
}

fw_status fw_output_commit(fw_output *o) {
    FW_TRY(sync_directories(o));
    const char *spare = fw_arena_printf(o->arena, "%s.tmp-%ld-old", o->path, (long)getpid());
    const char *parent = fw_output_parent(o->arena, o->path);
    FW_NEED(spare);
    FW_NEED(parent);
    struct stat info;
    bool earlier = lstat(o->path, &info) == 0;
    if (earlier ? !fw_output_exchange(o->build, o->path, spare) : rename(o->build, o->path) != 0)
        return fw_output_failed(o->diags, o->path, "put the results in place");
    if (earlier) fw_output_remove_tree(AT_FDCWD, o->build); /* now holds what was there before */
    o->build = NULL;
    fw_output_sync_directory(parent);
    return FW_OK;
}

void fw_output_abort(fw_output *o) {
    if (o && o->build) {
        fw_output_remove_tree(AT_FDCWD, o->build);
        o->build = NULL;
    }
}
