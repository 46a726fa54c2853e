// A child process by fork: with limits of its own on memory, processor time and files (setrlimit), one pipe back, and a
// timeout that the parent enforces. Its faults cannot harm the parent. Cost: a fork, which grows with the parent's page
// tables (docs/formats.md has numbers), and the pipe.
#if defined(__linux__)
#define _GNU_SOURCE // close_range
#include <sys/prctl.h>
#else
#define _XOPEN_SOURCE 700
#endif
#include "io/mesh/child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

static double get_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// ---- in the child: only what a child of a process with threads may call

static void set_limit(int what, rlim_t value, rlim_t hard) {
    struct rlimit now;
    if (getrlimit(what, &now) != 0) return;
    if (now.rlim_max == RLIM_INFINITY || hard < now.rlim_max) now.rlim_max = hard;
    now.rlim_cur = value < now.rlim_max ? value : now.rlim_max;
    (void)setrlimit(what, &now);
}

// Bytes of address space in use; 0 where the system does not report it.
static size_t get_used_memory(void) {
    char text[64];
    int file = open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    ssize_t n = file < 0 ? -1 : read(file, text, sizeof text - 1);
    if (file >= 0) close(file);
    size_t pages = 0;
    for (ssize_t i = 0; i < n && text[i] >= '0' && text[i] <= '9'; i++) pages = 10 * pages + (size_t)(text[i] - '0');
    return pages * (size_t)sysconf(_SC_PAGESIZE);
}

static void limit_memory(size_t bytes) {
    size_t used = get_used_memory();
    if (used) set_limit(RLIMIT_AS, used + bytes, RLIM_INFINITY);
}

void child_allow_memory(size_t bytes) {
    struct rlimit now;
    if (getrlimit(RLIMIT_AS, &now) == 0 && now.rlim_cur != RLIM_INFINITY)
        set_limit(RLIMIT_AS, now.rlim_cur + bytes, RLIM_INFINITY);
}

static void set_limits(const child_limits *limits) {
    set_limit(RLIMIT_CORE, 0, 0);
    set_limit(RLIMIT_FSIZE, 0, 0);
    set_limit(RLIMIT_CPU, limits->cpu_seconds, limits->cpu_seconds + 5);
    limit_memory(limits->memory);
}

// Resets signals as in a new program: the caller's handlers must not run here.
static void reset_signals(void) {
    for (int number = 1; number < 65; number++)
        if (number != SIGKILL && number != SIGSTOP) (void)signal(number, SIG_DFL);
    sigset_t none;
    sigemptyset(&none);
    (void)sigprocmask(SIG_SETMASK, &none, NULL);
}

static void close_from(int first, int last) {
#if defined(__linux__)
    if (close_range((unsigned)first, (unsigned)last, 0) == 0) return;
#endif
    long most = sysconf(_SC_OPEN_MAX);
    for (int file = first; file <= last && file < most; file++) close(file);
}

// Redirects the standard streams to /dev/null, keeps the pipe, closes all else. Returns the pipe.
static int close_others(int output) {
    int kept = fcntl(output, F_DUPFD, 3), nowhere = open("/dev/null", O_RDWR);
    if (kept < 0 || nowhere < 0) _exit(126);
    for (int i = 0; i < 3; i++) (void)dup2(nowhere, i);
    if (kept > 3) close_from(3, kept - 1);
    close_from(kept + 1, 0x7fffffff);
    return kept;
}

static _Noreturn void run_child(int output, pid_t parent, const child_limits *limits, void (*work)(int, void *),
                                void *context) {
    reset_signals();
#if defined(__linux__)
    (void)prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(125);
#else
    (void)parent;
#endif
    output = close_others(output);
    set_limits(limits);
    work(output, context);
    _exit(0);
}

void child_write(int output, const void *data, size_t size) {
    const char *at = data;
    while (size) {
        ssize_t n = write(output, at, size);
        if (n < 0 && errno == EINTR) continue;
        if (n <= 0) _exit(124);
        at += n;
        size -= (size_t)n;
    }
}

// ---- in the parent

int child_start(child *c, const child_limits *limits, void (*work)(int output, void *context), void *context) {
    int ends[2];
    *c = (child){.pid = -1, .input = -1, .end_at = get_seconds() + limits->seconds};
    if (pipe(ends) != 0) return errno;
    for (int i = 0; i < 2; i++) (void)fcntl(ends[i], F_SETFD, FD_CLOEXEC);
    // No handler of the caller's may run in the child.
    sigset_t all, before;
    sigfillset(&all);
    (void)pthread_sigmask(SIG_SETMASK, &all, &before);
    pid_t parent = getpid();
    c->pid = fork();
    int reason = errno;
    if (c->pid == 0) run_child(ends[1], parent, limits, work, context);
    (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
    close(ends[1]);
    c->input = ends[0];
    if (c->pid > 0) return 0;
    close(ends[0]);
    return reason;
}

ptrdiff_t child_read(child *c, void *buffer, size_t size) {
    for (;;) {
        double left = c->end_at - get_seconds();
        struct pollfd poll_file = {c->input, POLLIN, 0};
        int ready = left > 0 ? poll(&poll_file, 1, (int)(left * 1000) + 1) : 0;
        if (ready == 0) {
            c->is_late = 1;
            return -1;
        }
        ssize_t n = ready > 0 ? read(c->input, buffer, size) : -1;
        if (n >= 0) return n;
        if (errno != EINTR) return -1;
    }
}

// Waits, until its time is over, for a child that has closed its pipe; 0 where it does not end. A machine that is busy
// may need long to take the dead child's memory back.
static int wait_for_end(const child *c, int *status) {
    do {
        pid_t got = waitpid(c->pid, status, WNOHANG);
        if (got == c->pid || (got < 0 && errno == ECHILD)) return 1;
        struct timespec pause = {0, 1000000};
        (void)nanosleep(&pause, NULL);
    } while (get_seconds() < c->end_at);
    return 0;
}

child_end child_finish(child *c, int is_done) {
    int status = 0;
    close(c->input);
    if (is_done || c->is_late || !wait_for_end(c, &status)) {
        (void)kill(c->pid, SIGKILL);
        while (waitpid(c->pid, &status, 0) < 0 && errno == EINTR) continue;
    }
    child_end end = {.is_late = c->is_late};
    if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
    if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
    end.is_slow = end.signal == SIGXCPU;
    return end;
}
