/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Processes of the server's own, and the directory in which they work. */
#include "base/output.h"
#include "serve/jobs.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* ---- a process ---- */

#if defined(__SANITIZE_ADDRESS__)
#define SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SANITIZED 1
#endif
#endif

static int limit(unsigned which, uint64_t value) {
    struct rlimit r = {.rlim_cur = (rlim_t)value, .rlim_max = (rlim_t)value};
    return setrlimit(which, &r);
}

static int limit_all(const fw_serve_child_limits *l) {
#ifndef SANITIZED
    if (limit(RLIMIT_AS, l->memory_bytes) != 0 || limit(RLIMIT_FSIZE, l->file_bytes) != 0)
        return -1;
#endif
    if (l->cpu_s && limit(RLIMIT_CPU, l->cpu_s) != 0) return -1;
    if (limit(RLIMIT_NOFILE, l->files) != 0 || limit(RLIMIT_CORE, 0) != 0) return -1;
    if (l->nice) setpriority(PRIO_PROCESS, 0, l->nice);
    return 0;
}

/* `fd` as `to`, with /dev/null for -1 */
static int place(int fd, int to) {
    int from = fd >= 0 ? fd : open("/dev/null", to == 0 ? O_RDONLY : O_WRONLY);
    if (from < 0) return -1;
    return dup2(from, to) == to ? 0 : -1;
}

/* the descriptors first out of the way of 0..3, then into place; all others are closed */
static int place_all(const fw_serve_child_plan *p) {
    int fd[4] = {p->in, p->out, p->err < 0 ? 2 : p->err, p->channel};
    for (int i = 0; i < 4; i++)
        if (fd[i] >= 0 && (fd[i] = fcntl(fd[i], F_DUPFD_CLOEXEC, 10)) < 0) return -1;
    for (int i = 0; i < 3; i++)
        if (place(fd[i], i) != 0) return -1;
    if (fd[3] >= 0 && dup2(fd[3], 3) != 3) return -1;
    return close_range(fd[3] >= 0 ? 4 : 3, ~0U, 0);
}

/* in the new process, between fork and exec; the server has one thread, so no lock can be held */
static void become(const fw_serve_child_plan *p, pid_t server) {
    sigset_t none;
    sigemptyset(&none);
    sigprocmask(SIG_SETMASK, &none, NULL);
    if (setpgid(0, 0) != 0 || prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != server) return;
    if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return;
    if (p->directory >= 0 && fchdir(p->directory) != 0) return;
    if (p->temporary && setenv("TMPDIR", p->temporary, 1) != 0) return;
    if (place_all(p) != 0 || limit_all(&p->limits) != 0) return;
    execv("/proc/self/exe", (char *const *)(uintptr_t)p->argv);
}

/* to whoever reads its messages, in place of a status alone; where that is, place_all may have been on its way to change */
static _Noreturn void fail(const fw_serve_child_plan *p, const char *why) {
    static const char before[] = "flexwright: error: a process of the page could not begin: ";
    char line[sizeof before + 200];
    const int n = snprintf(line, sizeof line, "%s%.190s\n", before, why);
    if (p->err < 0 || write(p->err, line, (size_t)n) < 0)
        if (write(2, line, (size_t)n) < 0) _exit(126); /* nobody is left to be told */
    _exit(127);
}

pid_t fw_serve_child_start(const fw_serve_child_plan *plan) {
    pid_t server = getpid(), pid = fork();
    if (pid == 0) {
        become(plan, server);
        fail(plan, strerror(errno));
    }
    if (pid > 0) setpgid(pid, pid); /* whoever is first */
    return pid;
}

int fw_serve_child_ended(pid_t pid, int *status) {
    pid_t got = waitpid(pid, status, WNOHANG);
    return got == pid || (got < 0 && errno == ECHILD);
}

void fw_serve_child_kill(pid_t pid) {
    if (pid <= 0) return;
    kill(-pid, SIGKILL);
    kill(pid, SIGKILL);
    while (waitpid(pid, NULL, 0) < 0 && errno == EINTR) {
    }
}

/* ---- the directory ---- */

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
