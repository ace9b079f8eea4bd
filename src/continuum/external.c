/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "continuum/external.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

const char *fw_continuum_program(fw_arena *arena, const char *name) {
    const char *path = getenv("PATH");
    for (const char *p = path ? path : "/usr/local/bin:/usr/bin:/bin"; *p;) {
        size_t n = strcspn(p, ":");
        struct stat info;
        if (n > 0 && *p == '/') { /* a relative entry would depend on where one stands */
            const char *file = fw_arena_printf(arena, "%.*s/%s", (int)n, p, name);
            if (!file) return NULL;
            if (stat(file, &info) == 0 && S_ISREG(info.st_mode) && access(file, X_OK) == 0)
                return file;
        }
        p += n + (p[n] == ':');
    }
    return NULL;
}

fw_status fw_continuum_external_room_open(const fw_arena *work, fw_continuum_external_room *room) {
    room->work = work;
    const char *base = getenv("TMPDIR");
    if (!base || *base != '/' || strlen(base) > 400) base = "/tmp";
    snprintf(room->path, sizeof room->path, "%s/flexwright-XXXXXX", base);
    if (mkdtemp(room->path)) return FW_OK; /* mode 0700 */
    room->path[0] = 0;
    return FW_IO;
}

void fw_continuum_external_room_close(fw_continuum_external_room *room) {
    if (!room->path[0]) return;
    DIR *dir = opendir(room->path);
    if (dir) { /* programs that are run here write plain files only */
        for (struct dirent *e; (e = readdir(dir));)
            if (strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0)
                unlinkat(dirfd(dir), e->d_name, 0);
        closedir(dir);
    }
    rmdir(room->path);
    room->path[0] = 0;
}

static void path_in(char file[700], const fw_continuum_external_room *room, const char *name) {
    snprintf(file, 700, "%s/%s", room->path, name);
}

fw_status fw_continuum_external_write(const fw_continuum_external_room *room, const char *name,
                                      const char *data, size_t n) {
    char file[700];
    path_in(file, room, name);
    int fd = open(file, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600);
    if (fd < 0) return FW_IO;
    while (n > 0) {
        ssize_t done = write(fd, data, n);
        if (done < 0 && errno == EINTR) continue;
        if (done <= 0) break;
        data += done, n -= (size_t)done;
    }
    return close(fd) == 0 && n == 0 ? FW_OK : FW_IO;
}

/* between fork and exec: only calls that are safe there */
static void become(const char *directory, char *const *argv, char *const *environment, int null,
                   int log, pid_t parent) {
    const struct rlimit none = {0, 0};
    sigset_t all;
    setpgid(0, 0); /* an interrupt of the terminal reaches us, and we end it */
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(126);
    setrlimit(RLIMIT_CORE, &none);
    sigemptyset(&all);
    sigprocmask(SIG_SETMASK, &all, NULL);
    signal(SIGPIPE, SIG_DFL);
    if (directory && chdir(directory) != 0) _exit(126);
    if (dup2(null, 0) < 0 || dup2(log, 1) < 0 || dup2(log, 2) < 0) _exit(126);
    close_range(3, ~0U, 0);
    execve(argv[0], argv, environment);
    _exit(127);
}

static double now_s(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static fw_status wait_for(const fw_arena *work, pid_t child, double timeout_s,
                          fw_continuum_external_run *run) {
    double start = now_s();
    struct timespec nap = {0, 1000000};
    struct rusage used = {0};
    int state = 0;
    bool killed = false;
    run->end = FW_EXTERNAL_DONE;
    for (;;) {
        pid_t got = wait4(child, &state, killed ? 0 : WNOHANG, &used);
        if (got == child) break;
        if (got < 0 && errno != EINTR) return FW_IO;
        if (killed) continue;
        if (fw_arena_cancelled(work))
            run->end = FW_EXTERNAL_CANCELLED;
        else if (now_s() - start > timeout_s)
            run->end = FW_EXTERNAL_TIMEOUT;
        if (run->end != FW_EXTERNAL_DONE) {
            kill(-child, SIGKILL);
            kill(child, SIGKILL); /* should it not yet lead its group */
            killed = true;
            continue;
        }
        nanosleep(&nap, NULL);
        if (nap.tv_nsec < 50000000) nap.tv_nsec *= 2;
    }
    run->cpu_s = (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
                 1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
    run->code = WIFEXITED(state) ? WEXITSTATUS(state) : -WTERMSIG(state);
    if (run->end == FW_EXTERNAL_DONE && run->code != 0) run->end = FW_EXTERNAL_FAILED;
    return FW_OK;
}

enum { MOST_WORDS = 400 };

static fw_status call(const fw_continuum_external_room *room, const char *directory,
                      char *const *environment, const char *const *argv, const char *log,
                      double timeout_s, fw_continuum_external_run *run) {
    char file[700];
    path_in(file, room, log);
    char *words[MOST_WORDS + 1] = {NULL};
    for (int i = 0; argv[i] && i < MOST_WORDS; i++)
        memcpy(&words[i], &argv[i], sizeof words[i]); /* execve does not write to them */
    *run = (fw_continuum_external_run){.end = FW_EXTERNAL_FAILED};

    int null = open("/dev/null", O_RDONLY | O_CLOEXEC);
    int out = open(file, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0600);
    pid_t parent = getpid(), child = null < 0 || out < 0 ? -1 : fork();
    if (child == 0) become(directory, words, environment, null, out, parent);
    if (null >= 0) close(null);
    if (out >= 0) close(out);
    return child < 0 ? FW_IO : wait_for(room->work, child, timeout_s, run);
}

fw_status fw_continuum_external_call(const fw_continuum_external_room *room,
                                     const char *const *argv, const char *log, double timeout_s,
                                     fw_continuum_external_run *run) {
    char home[700];
    snprintf(home, sizeof home, "HOME=%s", room->path);
    char threads[] = "OMP_NUM_THREADS=1", locale[] = "LC_ALL=C", path[] = "PATH=/usr/bin:/bin";
    char *const environment[] = {threads, locale, path, home, NULL};
    return call(room, room->path, environment, argv, log, timeout_s, run);
}

fw_status fw_continuum_external_call_here(const fw_continuum_external_room *room,
                                          const char *const *argv, const char *log,
                                          double timeout_s, fw_continuum_external_run *run) {
    return call(room, NULL, environ, argv, log, timeout_s, run);
}
