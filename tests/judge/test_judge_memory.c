// Where memory is out the judge calls the function that the program set, also from within GMP; it does not abort.
// Truth: the exit code of a child that asks for more than there is.
#include "check.h"

#include "judge.h"
#include "number.h"

#include <stdint.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HAS_ASAN
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#define HAS_ASAN
#endif

enum { GONE = 42 };

static void leave(void) { _exit(GONE); }

static void ask_judge(void) { (void)judge_allocate(SIZE_MAX / 32, 16); }

static void ask_gmp(void) {
    void *(*allocate)(size_t) = NULL;
    mp_get_memory_functions(&allocate, NULL, NULL);
    (void)allocate(SIZE_MAX / 4);
}

static void regrow_gmp(void) {
    void *(*reallocate)(void *, size_t, size_t) = NULL;
    mp_get_memory_functions(NULL, &reallocate, NULL);
    (void)reallocate(NULL, 0, SIZE_MAX / 4);
}

static void check_child(void (*ask)(void)) {
    int status = 0;
    pid_t child = fork();
    if (child == 0) {
        judge_set_out_of_memory(leave);
        ask();
        _exit(0);
    }
    CHECK(child > 0 && waitpid(child, &status, 0) == child);
    CHECK(WIFEXITED(status) && WEXITSTATUS(status) == GONE);
}

int main(void) {
#ifdef HAS_ASAN
    (void)ask_judge, (void)ask_gmp, (void)regrow_gmp, (void)check_child;
    check_skip("AddressSanitizer ends a program that asks for too much memory");
#else
    check_child(ask_judge);
    check_child(ask_gmp);
    check_child(regrow_gmp);
#endif
    return check_end();
}
