// The C++ header in a program without exceptions (-fno-exceptions): everything works, what was created by a C function
// is adopted, and what would throw ends the program by abort. Truth: the signal that ends the child.
#include <ovoid/ovoid.hpp>

#include "check.h"

#include <csignal>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#ifdef __cpp_exceptions
#error "this test is for a compiler without exceptions"
#endif

int main() {
    ovoid_error e;
    const ovoid::shape box(ovoid_shape_create_box({1, 2, 3}, nullptr, &e));
    const ovoid::shape none(ovoid_shape_create_sphere(-1, nullptr, &e));
    CHECK(box && !none && e.code == OVOID_ERROR_RADIUS);
    const ovoid::answer a = ovoid::distance({box, box, {}, ovoid::vec3(4, 0, 0)});
    CHECK(a.lower <= 2 && a.upper >= 2);

    std::fflush(stdout);
    const pid_t child = fork();
    if (child == 0) {
        const rlimit no_core = {0, 0};
        setrlimit(RLIMIT_CORE, &no_core);
        std::signal(SIGABRT, SIG_DFL);
        const ovoid::shape bad = ovoid::shape::sphere(-1);
        _exit(bad ? 1 : 2);
    }
    int status = 0;
    CHECK(child > 0 && waitpid(child, &status, 0) == child);
    CHECK(WIFSIGNALED(status) && WTERMSIG(status) == SIGABRT);
    return check_end();
}
