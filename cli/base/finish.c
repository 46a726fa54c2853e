// Ends of output: flushing, a full disk, a reader that has gone, interruption.
#include "base/finish.h"

#include "base/args.h"
#include "base/message.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <unistd.h>

/// Signals that may end the program at any moment, and can be held back; then its own faults, which cannot.
static const int numbers[] = {SIGINT,    SIGTERM, SIGHUP,  SIGQUIT, SIGXCPU, SIGALRM, SIGUSR1, SIGUSR2,
                              SIGVTALRM, SIGPROF, SIGABRT, SIGSEGV, SIGBUS,  SIGFPE,  SIGILL};
enum { NUMBER_COUNT = sizeof numbers / sizeof *numbers, HELD_COUNT = NUMBER_COUNT - 5 };

/// The path of the unfinished file, in a form that a signal handler may read.
static char unfinished[4096];
static volatile sig_atomic_t has_unfinished;

static void end_by_signal(int number) {
    if (has_unfinished) unlink(unfinished);
    signal(number, SIG_DFL);
    raise(number);
}

static void set_handler(int number, void (*handler)(int)) {
    struct sigaction action;
    memset(&action, 0, sizeof action);
    sigemptyset(&action.sa_mask);
    action.sa_handler = handler;
    sigaction(number, &action, NULL);
}

void finish_catch_signals(void) {
    set_handler(SIGPIPE, SIG_IGN);
    set_handler(SIGXFSZ, SIG_IGN);
    for (size_t i = 0; i < NUMBER_COUNT; i++) {
        struct sigaction now;
        sigaction(numbers[i], NULL, &now);
        if (now.sa_handler == SIG_DFL)
            set_handler(numbers[i], end_by_signal); // a signal that nohup ignores stays ignored
    }
}

void finish_set_unfinished(const char *path) {
    has_unfinished = 0;
    if (!path || strlen(path) >= sizeof unfinished) return;
    memcpy(unfinished, path, strlen(path) + 1);
    has_unfinished = 1;
}

static void change_mask(int how) {
    sigset_t set;
    sigemptyset(&set);
    for (size_t i = 0; i < HELD_COUNT; i++) sigaddset(&set, numbers[i]);
    sigprocmask(how, &set, NULL);
}

void finish_hold_signals(void) { change_mask(SIG_BLOCK); }
void finish_release_signals(void) { change_mask(SIG_UNBLOCK); }

int finish_is_unread(FILE *file) {
    struct pollfd poll_file = {fileno(file), POLLOUT, 0};
    return poll(&poll_file, 1, 0) == 1 && (poll_file.revents & (POLLERR | POLLHUP));
}

int finish_file(FILE *file) {
    errno = 0;
    if (fflush(file) == 0 && !ferror(file)) return 0;
    if (finish_is_unread(file)) return EXIT_PIPE;
    message_error("the output could not be written: %s", errno ? strerror(errno) : "write error");
    return EXIT_INPUT;
}

ovoid_output *finish_open(const char *path) {
    ovoid_error error;
    finish_hold_signals();
    ovoid_output *output = ovoid_output_open(path, &error);
    if (output) finish_set_unfinished(ovoid_output_get_temporary(output));
    finish_release_signals();
    if (!output) finish_report_failure(&error);
    return output;
}

int finish_output(ovoid_output *output) {
    ovoid_error error;
    int unread = finish_is_unread(ovoid_output_get_file(output));
    if (ovoid_output_commit(output, &error) == OVOID_OK) return 0;
    if (unread) return EXIT_PIPE;
    finish_report_failure(&error);
    return EXIT_INPUT;
}

int finish_close(ovoid_output *output, int code) {
    if (!code) code = finish_output(output);
    ovoid_output_close(output);
    finish_set_unfinished(NULL);
    return code;
}

int finish_chart(const char *path, const ovoid_chart *chart) {
    ovoid_output *output = finish_open(path);
    if (!output) return EXIT_INPUT;
    (void)ovoid_chart_write_svg(ovoid_output_get_file(output), chart); // finish_output checks the stream
    return finish_close(output, 0);
}

void finish_report_failure(const ovoid_error *error) {
    int is_stdout = strncmp(error->message, "-:", 2) == 0;
    message_error("%s%s", is_stdout ? "standard output" : "", error->message + is_stdout);
}
