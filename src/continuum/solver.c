/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "continuum/solver.h"
#include "base/constants.h"
#include "base/output.h"
#include "base/text.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
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

fw_status fw_continuum_program(fw_arena *arena, const char *name, const char **path) {
    const char *all = getenv("PATH");
    *path = NULL;
    for (const char *p = all ? all : "/usr/local/bin:/usr/bin:/bin"; *p;) {
        size_t n = strcspn(p, ":");
        struct stat info;
        if (n > 0 && *p == '/') { /* a relative entry would depend on where one stands */
            const char *file = fw_arena_printf(arena, "%.*s/%s", (int)n, p, name);
            FW_NEED(file);
            if (stat(file, &info) == 0 && S_ISREG(info.st_mode) && access(file, X_OK) == 0) {
                *path = file;
                return FW_OK;
            }
        }
        p += n + (p[n] == ':');
    }
    return FW_OK;
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
        fw_arena_tell(work, "waiting for another program", now_s() - start, -timeout_s, "s");
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

/* one number in columns [from, to) of a line of n bytes; Fortran writes "0.1-100" for exponents
   beyond two digits: that is 0 here */
static bool number_in(const char *line, size_t n, size_t from, size_t to, double *value) {
    if (to > n) to = n;
    while (from < to && line[from] == ' ')
        from++;
    while (to > from && line[to - 1] == ' ')
        to--;
    if (from >= to) return false;
    if (fw_number_parse(line + from, to - from, value)) return true;
    *value = 0.0;
    for (size_t i = from + 1; i < to; i++)
        if (line[i] == '-' && line[i - 1] >= '0' && line[i - 1] <= '9') return true;
    return false;
}

/* words separated by blanks; how many were numbers */
static int numbers_in(const char *line, size_t n, double *value, int most) {
    int count = 0;
    for (size_t i = 0; i < n && count < most;) {
        while (i < n && line[i] == ' ')
            i++;
        size_t from = i;
        while (i < n && line[i] != ' ')
            i++;
        if (i > from && !number_in(line, n, from, i, &value[count++])) return -1;
    }
    return count;
}

/* which step ends at this time; -1: none */
static int step_of(double time, int nstep) {
    double whole = floor(time + 0.5);
    return fabs(time - whole) < 1e-6 && whole >= 1.0 && whole <= nstep ? (int)whole - 1 : -1;
}

static bool starts(const char *line, size_t n, const char *with) {
    size_t k = strlen(with);
    return n >= k && memcmp(line, with, k) == 0;
}

fw_status fw_continuum_results_print(const char *text, const int *node, int nnode,
                                     fw_continuum_result_step *step, int nstep) {
    int now = -1;
    bool forces = false;
    for (const char *line = text; *line;) {
        size_t n = strcspn(line, "\n");
        double value[4];
        if (starts(line, n, " displacements") || starts(line, n, " forces")) {
            size_t at = n;
            while (at > 0 && line[at - 1] != ' ')
                at--;
            if (!number_in(line, n, at, n, &value[0])) return FW_SOLVER;
            now = step_of(value[0], nstep);
            forces = line[1] == 'f';
        } else if (n > 0 && now >= 0) {
            if (numbers_in(line, n, value, 4) != 4) return FW_SOLVER;
            for (int i = 0; i < nnode; i++) {
                if (node[i] != (int)value[0]) continue;
                double *to = forces ? step[now].force[i] : step[now].move[i];
                memcpy(to, value + 1, 3 * sizeof *to);
                *(forces ? &step[now].have_force[i] : &step[now].have_move[i]) = true;
            }
        }
        line += n + (line[n] == '\n');
    }
    return FW_OK;
}

/* Trigonometric solution of the characteristic cubic (O. K. Smith, Comm. ACM 4 (1961) 168): with
   m = tr/3, B = A - m I, p^2 = tr(B B)/6, q = det(B)/2: values m + 2 p cos(phi + 2 k pi/3),
   phi = acos(q/p^3)/3. Error some 1e-15 of the largest; test_external.c: against rotations */
void fw_continuum_results_principal(const double a[6], double value[3]) {
    double m = (a[0] + a[1] + a[2]) / 3.0, x = a[0] - m, y = a[1] - m, z = a[2] - m;
    double off = a[3] * a[3] + a[4] * a[4] + a[5] * a[5];
    double p = sqrt((x * x + y * y + z * z + 2.0 * off) / 6.0);
    double det = x * (y * z - a[4] * a[4]) - a[3] * (a[3] * z - a[4] * a[5]) +
                 a[5] * (a[3] * a[4] - y * a[5]);
    double r = p > 0.0 ? 0.5 * det / (p * p * p) : 0.0;
    double phi = acos(fmax(-1.0, fmin(1.0, r))) / 3.0;
    value[2] = m + 2.0 * p * cos(phi);
    value[0] = m + 2.0 * p * cos(phi + 2.0 * FW_PI / 3.0);
    value[1] = 3.0 * m - value[0] - value[2];
}

static void add_to_peak(fw_continuum_result_peak *peak, int node, const double tensor[6]) {
    double v[3];
    fw_continuum_results_principal(tensor, v);
    double a = v[1] - v[0], b = v[2] - v[1], c = v[2] - v[0];
    peak->mises = fmax(peak->mises, sqrt(0.5 * (a * a + b * b + c * c)));
    double most = fmax(fabs(v[0]), fabs(v[2]));
    if (!(most > peak->principal)) return;
    peak->principal = most;
    peak->node = node;
}

/* Blocks of the ASCII format: "  100CL" with the time in columns 13-24, " -4" with the name, " -1"
   records of a node in columns 4-13 and values of 12 columns each, " -3" at the end (cgx manual,
   section 11) */
fw_status fw_continuum_results_fields(const char *text, fw_continuum_result_peak *strain,
                                      fw_continuum_result_peak *stress, int nstep, int *nfound) {
    fw_continuum_result_peak *into = NULL;
    int now = -1;
    *nfound = 0;
    for (const char *line = text; *line;) {
        size_t n = strcspn(line, "\n");
        double value[7];
        if (starts(line, n, "  100CL")) {
            if (!number_in(line, n, 12, 24, &value[0])) return FW_SOLVER;
            now = step_of(value[0], nstep);
        } else if (starts(line, n, " -4") && now >= 0) {
            bool is_strain = starts(line, n, " -4  TOSTRAIN");
            into = is_strain ? &strain[now] : starts(line, n, " -4  STRESS ") ? &stress[now] : NULL;
            if (into) *into = (fw_continuum_result_peak){0};
            if (is_strain) *nfound = now + 1;
        } else if (starts(line, n, " -3")) {
            into = NULL;
        } else if (into && starts(line, n, " -1")) {
            if (!number_in(line, n, 3, 13, &value[6])) return FW_SOLVER;
            for (size_t i = 0; i < 6; i++)
                if (!number_in(line, n, 13 + 12 * i, 25 + 12 * i, &value[i])) return FW_SOLVER;
            add_to_peak(into, (int)value[6], value);
        }
        line += n + (line[n] == '\n');
    }
    return FW_OK;
}

const char *const fw_continuum_install =
    "CalculiX is not installed (program ccx): on Debian, apt install calculix-ccx";

enum { MOST_BYTES = 400 << 20 };

static fw_status bad_shape(fw_diags *diags, fw_place place, const char *why) {
    fw_diag_error(diags, 213, place, "the flexure cannot be meshed: %s", why);
    return FW_GEOMETRY;
}

fw_status fw_continuum_usable(const fw_continuum_material *m, double refinement, fw_place place,
                              fw_diags *diags) {
    bool good = m->cubic ? m->c44_Pa > 0.0 && m->c11_Pa > fabs(m->c12_Pa) &&
                               m->c11_Pa + 2.0 * m->c12_Pa > 0.0 && isfinite(m->crystal_rad)
                         : m->youngs_Pa > 0.0 && m->poisson > -1.0 && m->poisson < 0.5;
    if (!good) return bad_shape(diags, place, "the elastic constants are not those of a solid");
    if (refinement == 0.0 || (refinement >= 0.5 && refinement <= 4.0)) return FW_OK;
    return bad_shape(diags, place, "the refinement is not between 0.5 and 4");
}

fw_status fw_continuum_good_mesh(fw_arena *arena, const fw_continuum_shape *shape,
                                 double refinement, bool plane_stress, fw_place place,
                                 fw_diags *diags, fw_continuum_mesh *mesh) {
    const char *why = "";
    fw_status status = fw_continuum_mesh_build(arena, shape, refinement, plane_stress, mesh, &why);
    if (status == FW_GEOMETRY) return bad_shape(diags, place, why);
    FW_TRY(status);
    if (fw_continuum_mesh_quality(mesh).least_jacobian > 0.02) return FW_OK;
    return bad_shape(diags, place,
                     "bricks would fold over at the root; the fillet is too small or too large for "
                     "the width, or the curve too tight");
}

static fw_status failed(const fw_continuum_solver_call *call, double timeout_s,
                        const fw_continuum_external_run *run, fw_diags *diags) {
    char limit[32];
    if (run->end == FW_EXTERNAL_CANCELLED) return FW_CANCELLED;
    if (run->end == FW_EXTERNAL_TIMEOUT) {
        fw_diag_error(diags, 215, call->place,
                      "CalculiX was ended after %s s; refine less, or allow more time",
                      fw_number_text(limit, sizeof limit, timeout_s, 4));
        return FW_LIMIT;
    }
    fw_diag_error(diags, 215, call->place,
                  "CalculiX ended with %s %d; run the written deck by hand to see its messages",
                  run->code < 0 ? "signal" : "status", run->code < 0 ? -run->code : run->code);
    return FW_SOLVER;
}

static fw_status read_back(fw_arena *arena, const fw_continuum_external_room *room,
                           const char *name, fw_diags *diags, char **text) {
    size_t n;
    const char *file = fw_arena_printf(arena, "%s/%s", room->path, name);
    FW_NEED(file);
    return fw_input_read(arena, file, MOST_BYTES, diags, text, &n);
}

static fw_status run_in(fw_arena *arena, const fw_continuum_solver_call *call,
                        const fw_continuum_external_room *room, fw_diags *diags,
                        fw_continuum_solver_result *out) {
    const char *argv[] = {call->program, "job", NULL};
    double timeout_s = call->timeout_s > 0.0 ? call->timeout_s : 600.0;
    fw_continuum_external_run run;
    int fields = 0;
    char *text;
    FW_TRY(fw_continuum_external_write(room, "job.inp", call->deck->data, call->deck->length));
    FW_TRY(fw_continuum_external_call(room, argv, "log.txt", timeout_s, &run));
    out->cpu_s = run.cpu_s;
    if (run.end != FW_EXTERNAL_DONE) return failed(call, timeout_s, &run, diags);
    FW_TRY(read_back(arena, room, "job.dat", diags, &text));
    fw_status status =
        fw_continuum_results_print(text, call->node, call->nnode, out->step, call->nstep);
    if (status == FW_OK) {
        FW_TRY(read_back(arena, room, "job.frd", diags, &text));
        status = fw_continuum_results_fields(text, out->strain, out->stress, call->nstep, &fields);
    }
    for (int i = 0; i < call->nstep && status == FW_OK; i++)
        for (int k = 0; k < call->nnode; k++)
            if (!out->step[i].have_move[k]) status = FW_SOLVER;
    if (status == FW_OK && fields < call->nstep) status = FW_SOLVER;
    if (status == FW_SOLVER)
        fw_diag_error(diags, 216, call->place,
                      "CalculiX ended without an error, but its results are incomplete: it did not "
                      "converge, or it writes another format than version 2.20");
    return status;
}

fw_status fw_continuum_solver_run(fw_arena *arena, const fw_continuum_solver_call *call,
                                  fw_diags *diags, fw_continuum_solver_result *result) {
    fw_continuum_external_room room;
    *result = (fw_continuum_solver_result){.cpu_s = 0.0};
    if (call->nstep > FW_RESULT_STEPS || call->nnode > FW_RESULT_NODES) return FW_LIMIT;
    FW_TRY(fw_text_end(call->deck));
    if (fw_arena_cancelled(arena)) return FW_CANCELLED;
    if (fw_continuum_external_room_open(arena, &room) != FW_OK) {
        fw_diag_error(diags, 215, call->place,
                      "no private directory could be made below TMPDIR or /tmp");
        return FW_IO;
    }
    fw_status status = run_in(arena, call, &room, diags, result);
    fw_continuum_external_room_close(&room);
    if (status == FW_IO)
        fw_diag_error(diags, 215, call->place,
                      "CalculiX could not be started, or the disk is full");
    return status;
}
