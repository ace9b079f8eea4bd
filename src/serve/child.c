/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "serve/child.h"
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

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

pid_t fw_serve_child_start(const fw_serve_child_plan *plan) {
    pid_t server = getpid(), pid = fork();
    if (pid == 0) {
        become(plan, server);
        _exit(127);
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
