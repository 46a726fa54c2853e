// The asserts that a host can hook. Truth: the contract in base.h: the hook is called once, with the expression and the
// place; where it returns, and where there is none, the process aborts. Builds with NDEBUG have no asserts.
#define _XOPEN_SOURCE 700
#include "check.h"
#include "ovoid/ovoid.h"

#include <setjmp.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

static jmp_buf out;
static int calls;
static char seen[200];

static void leave(const char *expression, const char *file, int line) {
    calls++;
    snprintf(seen, sizeof seen, "%s, %s, %d", expression, file, line);
    longjmp(out, 1);
}

static void stay(const char *expression, const char *file, int line) {
    (void)expression, (void)file;
    calls += line > 0;
}

// A programmer's error: no batch.
static void err(void) { (void)ovoid_collide_batch(NULL, NULL); }

// Which signal ends a child that errs.
static int find_end(ovoid_assert_hook hook) {
    int status = 0;
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        ovoid_set_assert_hook(hook);
        signal(SIGABRT, SIG_DFL);
        err();
        _exit(0);
    }
    if (!CHECK(child > 0 && waitpid(child, &status, 0) == child)) return 0;
    return WIFSIGNALED(status) ? WTERMSIG(status) : 0;
}

int main(void) {
#ifdef NDEBUG
    (void)find_end, (void)leave, (void)stay;
    check_skip("this build has no asserts (NDEBUG)");
#else
    ovoid_set_assert_hook(leave);
    if (setjmp(out) == 0) err();
    CHECK_EQ(calls, 1);
    if (!CHECK(strstr(seen, "batch") && strstr(seen, "batch.c, ") && !strstr(seen, ", 0"))) printf("  %s\n", seen);
    // Without a hook, and with one that returns.
    ovoid_set_assert_hook(NULL);
    CHECK_EQ(find_end(NULL), SIGABRT);
    CHECK_EQ(find_end(stay), SIGABRT);
    CHECK_EQ(calls, 1);
#endif
    return check_end();
}
