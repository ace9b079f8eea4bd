/* SPDX-License-Identifier: GPL-3.0-or-later */
/* LD_PRELOAD library of the fault tests: counts one kind of call of a program from its main on, and makes the n-th of
   them fail. What it does is said by the environment:

       FW_FAULT_KIND    memory, or open, write, short, fsync, rename, read, close, mmap, fork, socket, opendir, mkdir,
                        stat, unlink, pictures (memory, asked for by what draws), pipe (and pairs of sockets, and what events
                        are told by), watch (one more), wait (poll), interrupted (other waiting, for events and processes), send
                        (and receive), exec, descriptor (fcntl, dup2)
       FW_FAULT_AT      n, from 1; 0 or absent: only count
       FW_FAULT_EVER    1: every later one fails, too
       FW_FAULT_ERRNO   number of the error (memory: always ENOMEM; short: a write of half the bytes, at least one, is done)
       FW_FAULT_REPORT  file that gets a line "KIND COUNT" of every kind at the end, from the process that was started and no child of it
       FW_FAULT_TRACE   1: who made the call that failed, and who was active at SIGSEGV or SIGABRT, to standard error
       FW_FAULT_CHILDREN 1: the program itself runs as it is, and those of its children that are this program again count from
                        their own main
       FW_FAULT_KILL    1: instead of failing, the call is preceded by kill -9

   What happens before main (the loader, constructors of libraries) is neither counted nor failed: nothing of ours runs
   there. The allocator's own calls of mmap are not seen; its failure is what `memory` is. */
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <link.h>
#include <malloc.h>
#include <poll.h>
#include <signal.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

/* the allocator under ours: of glibc, by their other names, so that dlsym need not be asked while it allocates */
extern void *__libc_malloc(size_t);
extern void *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);

enum kind {
    NONE,
    MEMORY,
    OPEN,
    WRITE,
    SHORT,
    FSYNC,
    RENAME,
    READ,
    CLOSE,
    MMAP,
    FORK,
    SOCKET,
    OPENDIR,
    MKDIR,
    STAT,
    UNLINK,
    PICTURES,
    PIPE,
    WAIT,
    SEND,
    EXEC,
    DESCRIPTOR,
    WATCH,
    INTERRUPTED,
    KINDS
};
static const char *const name[KINDS] = {
    "none",   "memory",  "open",  "write", "short",  "fsync",    "rename", "read", "close", "mmap", "fork",
    "socket", "opendir", "mkdir", "stat",  "unlink", "pictures", "pipe",   "wait", "send",  "exec", "descriptor",
    "watch",  "interrupted"};

static enum kind wanted;
static long at;
static int ever, error_number, trace, killing, running, spared;
static atomic_long counts[KINDS];
static pid_t first;
static char report[4096];

static void say(const char *text) {
    syscall(SYS_write, 2, text, strlen(text));
}

static void who(const char *what) {
    void *frame[48];
    static atomic_flag busy = ATOMIC_FLAG_INIT;
    if (atomic_flag_test_and_set(&busy)) return;
    int kept = running;
    running = 0; /* what this needs of memory is not of the program */
    int n = backtrace(frame, 48);
    say(what);
    backtrace_symbols_fd(frame, n, 2);
    say("fault: end\n");
    running = kept;
    atomic_flag_clear(&busy);
}

static int fault(enum kind kind) {
    if (!running) return 0;
    long n = atomic_fetch_add(&counts[kind], 1) + 1;
    if (kind != wanted || at == 0 || n < at || (n > at && !ever)) return 0;
    if (killing) {
        syscall(SYS_kill, getpid(), SIGKILL);
        return 0;
    }
    if (trace && n == at) who("fault: this call fails\n");
    errno = kind == MEMORY || kind == PICTURES ? ENOMEM : error_number;
    return 1;
}

static void crash(int number) {
    who(number == SIGSEGV ? "fault: segmentation fault\n" : "fault: abort\n");
    signal(number, SIG_DFL);
    raise(number);
}

/* ---- memory ---- */

/* What draws asks for memory that the program has made sure of before (report/png.c), and does not survive its lack:
   a kind of its own, `pictures`, by who calls. */
static struct { uintptr_t from, to; } drawing[16];
static int parts;

static int is_of_drawing(struct dl_phdr_info *library, size_t size, void *ignored) {
    static const char *const names[] = {"libcairo", "libpixman", "libfreetype", "libfontconfig",
                                        "libpng"};
    (void)size, (void)ignored;
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++)
        for (int k = 0; strstr(library->dlpi_name, names[i]) && k < library->dlpi_phnum; k++) {
            const ElfW(Phdr) *part = &library->dlpi_phdr[k];
            if (part->p_type != PT_LOAD || !(part->p_flags & PF_X) || parts == 16) continue;
            drawing[parts].from = library->dlpi_addr + part->p_vaddr;
            drawing[parts].to = drawing[parts].from + part->p_memsz;
            parts++;
        }
    return 0;
}

static enum kind asked_by(const void *caller) {
    for (int i = 0; i < parts; i++)
        if ((uintptr_t)caller >= drawing[i].from && (uintptr_t)caller < drawing[i].to)
            return PICTURES;
    return MEMORY;
}
#define LACKING() fault(asked_by(__builtin_return_address(0)))

void *malloc(size_t n) {
    return LACKING() ? NULL : __libc_malloc(n);
}

void *calloc(size_t count_, size_t size) {
    return LACKING() ? NULL : __libc_calloc(count_, size);
}

void *realloc(void *block, size_t n) {
    return LACKING() ? NULL : __libc_realloc(block, n);
}

int posix_memalign(void **block, size_t alignment, size_t n) {
    int kept = errno;
    void *got = LACKING() ? NULL : __libc_memalign(alignment, n);
    errno = kept;
    if (!got) return ENOMEM;
    *block = got;
    return 0;
}

void *aligned_alloc(size_t alignment, size_t n) {
    return LACKING() ? NULL : __libc_memalign(alignment, n);
}

void *memalign(size_t alignment, size_t n) {
    return LACKING() ? NULL : __libc_memalign(alignment, n);
}

/* ---- files ---- */

static void *next(const char *symbol) {
    return dlsym(RTLD_NEXT, symbol);
}

/* the pointer to the function below ours, looked up once */
#define BELOW(result, symbol, arguments)                                                           \
    static result(*below) arguments;                                                               \
    if (!below) below = (result(*) arguments)next(symbol)

static mode_t mode_of(int flags, va_list arguments) {
    return flags & (O_CREAT | O_TMPFILE) ? va_arg(arguments, mode_t) : 0;
}

#define OPENER(symbol)                                                                             \
    int symbol(const char *path, int flags, ...) {                                                 \
        va_list arguments;                                                                         \
        va_start(arguments, flags);                                                                \
        mode_t mode = mode_of(flags, arguments);                                                   \
        va_end(arguments);                                                                         \
        return fault(OPEN) ? -1 : (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);           \
    }
#define OPENER_AT(symbol)                                                                          \
    int symbol(int directory, const char *path, int flags, ...) {                                  \
        va_list arguments;                                                                         \
        va_start(arguments, flags);                                                                \
        mode_t mode = mode_of(flags, arguments);                                                   \
        va_end(arguments);                                                                         \
        return fault(OPEN) ? -1 : (int)syscall(SYS_openat, directory, path, flags, mode);          \
    }
OPENER(open)
OPENER(open64)
OPENER_AT(openat)
OPENER_AT(openat64)

#define FOPENER(symbol)                                                                            \
    FILE *symbol(const char *path, const char *mode) {                                             \
        BELOW(FILE *, #symbol, (const char *, const char *));                                      \
        return fault(OPEN) ? NULL : below(path, mode);                                             \
    }
FOPENER(fopen)
FOPENER(fopen64)

static ssize_t half(int fd, const void *data, size_t n) {
    if (n > 1 && fault(SHORT)) n = (n + 1) / 2;
    return syscall(SYS_write, fd, data, n);
}

ssize_t write(int fd, const void *data, size_t n) {
    return fault(WRITE) ? -1 : half(fd, data, n);
}

enum { STREAM_HAS_FAILED = 0x20 }; /* _IO_ERR_SEEN of glibc: what ferror tells */

/* standard output of the C library ends in write inside of it, unseen from here: what is put out by it is */
size_t fwrite(const void *data, size_t size, size_t n, FILE *to) {
    BELOW(size_t, "fwrite", (const void *, size_t, size_t, FILE *));
    if (to == stderr || !fault(WRITE)) return below(data, size, n, to);
    to->_flags |= STREAM_HAS_FAILED;
    return 0;
}

int fflush(FILE *to) {
    BELOW(int, "fflush", (FILE *));
    if (to == stderr || !fault(WRITE)) return below(to);
    if (to) to->_flags |= STREAM_HAS_FAILED;
    return EOF;
}

ssize_t read(int fd, void *data, size_t n) {
    if (n > 1 && fault(SHORT)) n = 1;
    return fault(READ) ? -1 : syscall(SYS_read, fd, data, n);
}

ssize_t pread(int fd, void *data, size_t n, off_t offset) {
    if (n > 1 && fault(SHORT)) n = 1;
    return fault(READ) ? -1 : syscall(SYS_pread64, fd, data, n, offset);
}

size_t fread(void *data, size_t size, size_t n, FILE *from) {
    BELOW(size_t, "fread", (void *, size_t, size_t, FILE *));
    return fault(READ) ? 0 : below(data, size, n, from);
}

int fsync(int fd) {
    return fault(FSYNC) ? -1 : (int)syscall(SYS_fsync, fd);
}

int fdatasync(int fd) {
    return fault(FSYNC) ? -1 : (int)syscall(SYS_fdatasync, fd);
}

/* the file is closed and the error told, as Linux does */
int close(int fd) {
    int failing = fault(CLOSE), why = errno, done = (int)syscall(SYS_close, fd);
    if (!failing || done != 0) return done;
    errno = why;
    return -1;
}

int rename(const char *from, const char *to) {
    return fault(RENAME) ? -1 : (int)syscall(SYS_rename, from, to);
}

int renameat2(int a, const char *from, int b, const char *to, unsigned flags) {
    return fault(RENAME) ? -1 : (int)syscall(SYS_renameat2, a, from, b, to, flags);
}

int renameat(int a, const char *from, int b, const char *to) {
    return fault(RENAME) ? -1 : (int)syscall(SYS_renameat2, a, from, b, to, 0);
}

int link(const char *from, const char *to) {
    return fault(RENAME) ? -1 : (int)syscall(SYS_link, from, to);
}

int mkdir(const char *path, mode_t mode) {
    return fault(MKDIR) ? -1 : (int)syscall(SYS_mkdir, path, mode);
}

int unlink(const char *path) {
    return fault(UNLINK) ? -1 : (int)syscall(SYS_unlink, path);
}

int unlinkat(int directory, const char *path, int flags) {
    return fault(UNLINK) ? -1 : (int)syscall(SYS_unlinkat, directory, path, flags);
}

int rmdir(const char *path) {
    return fault(UNLINK) ? -1 : (int)syscall(SYS_rmdir, path);
}

DIR *opendir(const char *path) {
    BELOW(DIR *, "opendir", (const char *));
    return fault(OPENDIR) ? NULL : below(path);
}

DIR *fdopendir(int fd) {
    BELOW(DIR *, "fdopendir", (int));
    return fault(OPENDIR) ? NULL : below(fd);
}

struct dirent *readdir(DIR *dir) {
    BELOW(struct dirent *, "readdir", (DIR *));
    return fault(OPENDIR) ? NULL : below(dir);
}

int stat(const char *path, struct stat *info) {
    BELOW(int, "stat", (const char *, struct stat *));
    return fault(STAT) ? -1 : below(path, info);
}

int lstat(const char *path, struct stat *info) {
    BELOW(int, "lstat", (const char *, struct stat *));
    return fault(STAT) ? -1 : below(path, info);
}

int fstat(int fd, struct stat *info) {
    BELOW(int, "fstat", (int, struct stat *));
    return fault(STAT) ? -1 : below(fd, info);
}

/* ---- the rest ---- */

void *mmap(void *address, size_t n, int protection, int flags, int fd, off_t offset) {
    return fault(MMAP) ? MAP_FAILED
                       : (void *)syscall(SYS_mmap, address, n, protection, flags, fd, offset);
}

pid_t fork(void) {
    BELOW(pid_t, "fork", (void));
    return fault(FORK) ? -1 : below();
}

int socket(int domain, int type, int protocol) {
    return fault(SOCKET) ? -1 : (int)syscall(SYS_socket, domain, type, protocol);
}

int bind(int fd, const struct sockaddr *address, socklen_t n) {
    return fault(SOCKET) ? -1 : (int)syscall(SYS_bind, fd, address, n);
}

int listen(int fd, int backlog) {
    return fault(SOCKET) ? -1 : (int)syscall(SYS_listen, fd, backlog);
}

int accept(int fd, struct sockaddr *address, socklen_t *n) {
    return fault(SOCKET) ? -1 : (int)syscall(SYS_accept4, fd, address, n, 0);
}

int accept4(int fd, struct sockaddr *address, socklen_t *n, int flags) {
    return fault(SOCKET) ? -1 : (int)syscall(SYS_accept4, fd, address, n, flags);
}

int setsockopt(int fd, int level, int option, const void *value, socklen_t n) {
    return fault(SOCKET) ? -1 : (int)syscall(SYS_setsockopt, fd, level, option, value, n);
}

int pipe2(int fd[2], int flags) {
    return fault(PIPE) ? -1 : (int)syscall(SYS_pipe2, fd, flags);
}

int pipe(int fd[2]) {
    return fault(PIPE) ? -1 : (int)syscall(SYS_pipe2, fd, 0);
}

int socketpair(int domain, int type, int protocol, int fd[2]) {
    return fault(PIPE) ? -1 : (int)syscall(SYS_socketpair, domain, type, protocol, fd);
}

int epoll_create1(int flags) {
    return fault(PIPE) ? -1 : (int)syscall(SYS_epoll_create1, flags);
}

int epoll_ctl(int fd, int what, int of, struct epoll_event *event) {
    if (what == EPOLL_CTL_ADD && fault(WATCH)) return -1; /* to take one out needs nothing */
    return (int)syscall(SYS_epoll_ctl, fd, what, of, event);
}

int eventfd(unsigned n, int flags) {
    return fault(PIPE) ? -1 : (int)syscall(SYS_eventfd2, n, flags);
}

int poll(struct pollfd *of, nfds_t n, int timeout_ms) {
    BELOW(int, "poll", (struct pollfd *, nfds_t, int));
    return fault(WAIT) ? -1 : below(of, n, timeout_ms);
}

int ppoll(struct pollfd *of, nfds_t n, const struct timespec *time, const sigset_t *mask) {
    BELOW(int, "ppoll", (struct pollfd *, nfds_t, const struct timespec *, const sigset_t *));
    return fault(WAIT) ? -1 : below(of, n, time, mask);
}

int epoll_wait(int fd, struct epoll_event *event, int most, int timeout_ms) {
    BELOW(int, "epoll_wait", (int, struct epoll_event *, int, int));
    return fault(INTERRUPTED) ? -1 : below(fd, event, most, timeout_ms);
}

pid_t waitpid(pid_t pid, int *status, int options) {
    BELOW(pid_t, "waitpid", (pid_t, int *, int));
    return fault(INTERRUPTED) ? -1 : below(pid, status, options);
}

ssize_t send(int fd, const void *data, size_t n, int flags) {
    return fault(SEND) ? -1 : syscall(SYS_sendto, fd, data, n, flags, NULL, 0);
}

ssize_t recv(int fd, void *data, size_t n, int flags) {
    return fault(SEND) ? -1 : syscall(SYS_recvfrom, fd, data, n, flags, NULL, NULL);
}

ssize_t sendmsg(int fd, const struct msghdr *message, int flags) {
    return fault(SEND) ? -1 : syscall(SYS_sendmsg, fd, message, flags);
}

int execv(const char *path, char *const argv[]) {
    BELOW(int, "execv", (const char *, char *const *));
    return fault(EXEC) ? -1 : below(path, argv);
}

int dup2(int from, int to) {
    return fault(DESCRIPTOR) ? -1 : (int)syscall(SYS_dup2, from, to);
}

int fcntl(int fd, int what, ...) {
    va_list arguments;
    va_start(arguments, what);
    const long argument = va_arg(arguments, long); /* a number or a pointer; where there is none, it is not looked at */
    va_end(arguments);
    return fault(DESCRIPTOR) ? -1 : (int)syscall(SYS_fcntl, fd, what, argument);
}

/* ---- from main to the end ---- */

static void tell(void) {
    running = 0;
    if (!report[0] || spared || getpid() != first) return;
    int fd = (int)syscall(SYS_openat, AT_FDCWD, report, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (fd < 0) return;
    for (size_t i = 1; i < KINDS; i++) {
        char line[64];
        int n = snprintf(line, sizeof line, "%s %ld\n", name[i], atomic_load(&counts[i]));
        if (syscall(SYS_write, fd, line, (size_t)n) < 0) say("fault: no report\n");
    }
    syscall(SYS_close, fd);
}

static long number(const char *variable) {
    const char *text = getenv(variable);
    return text ? atol(text) : 0;
}

static void settings(void) {
    const char *kind = getenv("FW_FAULT_KIND"), *file = getenv("FW_FAULT_REPORT");
    for (size_t i = 1; kind && i < KINDS; i++)
        if (strcmp(kind, name[i]) == 0) wanted = (enum kind)i;
    at = number("FW_FAULT_AT");
    ever = number("FW_FAULT_EVER") != 0;
    error_number = (int)number("FW_FAULT_ERRNO");
    trace = number("FW_FAULT_TRACE") != 0;
    killing = number("FW_FAULT_KILL") != 0;
    if (file && strlen(file) < sizeof report) strcpy(report, file);
    first = getpid();
    spared = number("FW_FAULT_CHILDREN") != 0;
    if (spared)
        unsetenv("FW_FAULT_CHILDREN"), unsetenv("FW_FAULT_REPORT");
    else
        unsetenv("LD_PRELOAD"); /* other programs that it starts run as they are */
    if (!trace) return;
    void *frame[2];
    backtrace(frame, 2); /* loads what it needs */
    static char own_stack[1 << 16];
    sigaltstack(&(stack_t){.ss_sp = own_stack, .ss_size = sizeof own_stack}, NULL);
    struct sigaction action = {.sa_handler = crash, .sa_flags = SA_ONSTACK};
    sigaction(SIGSEGV, &action, NULL);
    sigaction(SIGABRT, &action, NULL);
}

static int (*program_main)(int, char **, char **);

static int counted_main(int argc, char **argv, char **environment) {
    settings();
    dl_iterate_phdr(is_of_drawing, NULL);
    atexit(tell);
    running = !spared;
    return program_main(argc, argv, environment);
}

int __libc_start_main(int (*main_)(int, char **, char **), int argc, char **argv,
                      int (*init)(int, char **, char **), void (*fini)(void), void (*loader)(void),
                      void *stack);
int __libc_start_main(int (*main_)(int, char **, char **), int argc, char **argv,
                      int (*init)(int, char **, char **), void (*fini)(void), void (*loader)(void),
                      void *stack) {
    typedef int start(int (*)(int, char **, char **), int, char **, int (*)(int, char **, char **),
                      void (*)(void), void (*)(void), void *);
    start *below = (start *)next("__libc_start_main");
    program_main = main_;
    return below(counted_main, argc, argv, init, fini, loader, stack);
}
