/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "serve/child.h"
#include "base/output.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#define PREFIX "flexwright-serve-"
#define PAGE   "open.html"

struct fw_serve_scratch {
    const char *path, *name;
    int parent_fd, fd, lock;
};

/* a directory of ours whose server is gone? Then the lock is free. One without a lock is just being
   made, or is not ours to judge. */
static bool left_behind(int parent, const char *name) {
    if (strncmp(name, PREFIX, strlen(PREFIX)) != 0) return false;
    int fd = openat(parent, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    struct stat info;
    bool ours = fd >= 0 && fstat(fd, &info) == 0 && info.st_uid == geteuid();
    int lock = ours ? openat(fd, "lock", O_RDWR | O_NOFOLLOW | O_CLOEXEC) : -1;
    bool left = lock >= 0 && flock(lock, LOCK_EX | LOCK_NB) == 0;
    if (lock >= 0) close(lock);
    if (fd >= 0) close(fd);
    return left;
}

static void remove_left_behind(int parent) {
    int fd = openat(parent, ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR *dir = fd >= 0 ? fdopendir(fd) : NULL;
    if (!dir) {
        if (fd >= 0) close(fd);
        return;
    }
    for (struct dirent *e; (e = readdir(dir));)
        if (left_behind(parent, e->d_name)) fw_output_remove_tree(parent, e->d_name);
    closedir(dir);
}

fw_status fw_serve_scratch_open(fw_arena *arena, fw_diags *diags, fw_serve_scratch **scratch) {
    const char *wanted = getenv("TMPDIR");
    if (!wanted || !*wanted) wanted = "/tmp";
    char *parent = realpath(wanted, NULL);
    char *path = fw_arena_printf(arena, "%s/" PREFIX "XXXXXX", parent ? parent : wanted);
    free(parent);
    FW_NEED(path);
    fw_serve_scratch *s = fw_arena_one(arena, fw_serve_scratch);
    FW_NEED(s);
    *s = (fw_serve_scratch){.path = path, .name = strrchr(path, '/') + 1, .fd = -1, .lock = -1};
    FW_NEED(parent = fw_arena_strndup(arena, path, (size_t)(s->name - path)));
    s->parent_fd = open(parent, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (s->parent_fd >= 0) {
        remove_left_behind(s->parent_fd);
        if (mkdtemp(path)) s->fd = open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    }
    if (s->fd >= 0) s->lock = openat(s->fd, "lock", O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (s->lock < 0 || flock(s->lock, LOCK_EX | LOCK_NB) != 0) {
        fw_diag_error(diags, 222, (fw_place){.file = path},
                      "cannot make a directory for the work of the page: %s", strerror(errno));
        return FW_IO;
    }
    *scratch = s;
    return FW_OK;
}

void fw_serve_scratch_close(fw_serve_scratch *s) {
    if (!s) return;
    fw_output_remove_tree(s->parent_fd, s->name);
    close(s->lock);
    close(s->fd);
    close(s->parent_fd);
}

int fw_serve_scratch_make(fw_serve_scratch *s, const char *name) {
    if (mkdirat(s->fd, name, 0700) != 0) return -1;
    return openat(s->fd, name, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
}

const char *fw_serve_scratch_path(fw_arena *arena, const fw_serve_scratch *s, const char *name) {
    return fw_arena_printf(arena, "%s/%s", s->path, name);
}

const char *fw_serve_scratch_page(fw_arena *arena, fw_serve_scratch *s, const char *url) {
    const char *path = fw_serve_scratch_path(arena, s, PAGE);
    const char *text =
        fw_arena_printf(arena,
                        "<!doctype html><meta charset=\"utf-8\"><title>Flexwright</title>"
                        "<meta http-equiv=\"refresh\" content=\"0;url=%s\">\n",
                        url);
    int fd = openat(s->fd, PAGE, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    if (fd < 0) return NULL;
    bool ok = text && write(fd, text, strlen(text)) == (ssize_t)strlen(text);
    return close(fd) == 0 && ok ? path : NULL;
}

void fw_serve_scratch_drop_page(fw_serve_scratch *s) {
    unlinkat(s->fd, PAGE, 0);
}

void fw_serve_scratch_remove(fw_serve_scratch *s, const char *name) {
    fw_output_remove_tree(s->fd, name);
}
