// The floating-point environment. Every public function of the core that computes does so in the default one: round to
// nearest, subnormals kept, no exception trapped. So its bits and its bounds are the same whatever the caller has set,
// and it returns with the caller's environment as it was, the exception flags included.
//
// On x86-64 all arithmetic is SSE's (nothing here is long double), so one control register holds it all: it is read on
// entering, written only where the caller's settings differ, read on leaving, written only where a flag was raised that
// had not been. Elsewhere <fenv.h> does the same, slower.
//
// A compiler knows nothing of that register, and may move arithmetic across the reading and writing of it. What the
// arithmetic starts from and what it ends in is therefore hidden from it (environment_hide): arguments passed by value
// after entering, the result before leaving. What is read through pointers needs no hiding.
#ifndef OVOID_BASE_ENVIRONMENT_H
#define OVOID_BASE_ENVIRONMENT_H

/// From here on the compiler knows nothing of the value of a variable; all that made it has been done.
#define environment_hide(variable) __asm__ volatile("" : "+m"(variable) : : "memory")

#if defined(__x86_64__) && !defined(OVOID_ENVIRONMENT_PORTABLE)

#include <stdint.h>

/// What the caller had: MXCSR.
typedef struct environment {
    uint32_t control;
} environment;

/// Subnormals as zero, masks, rounding, flush to zero; and their default. Below them are the flags.
enum { ENVIRONMENT_CONTROL = 0xffc0, ENVIRONMENT_DEFAULT = 0x1f80 };

static inline uint32_t environment_read(void) {
    uint32_t control;
    __asm__ volatile("stmxcsr %0" : "=m"(control) : : "memory");
    return control;
}
static inline void environment_write(uint32_t control) { __asm__ volatile("ldmxcsr %0" : : "m"(control) : "memory"); }

/// Makes the environment the default one; what it was. Flags that are set stay.
static inline environment environment_enter(void) {
    environment before = {environment_read()};
    if ((before.control & ENVIRONMENT_CONTROL) != ENVIRONMENT_DEFAULT)
        environment_write((before.control & ~(uint32_t)ENVIRONMENT_CONTROL) | ENVIRONMENT_DEFAULT);
    return before;
}
/// Puts back what was, the flags included.
static inline void environment_leave(environment before) {
    if (environment_read() != before.control) environment_write(before.control);
}

#else

#include <fenv.h>

typedef struct environment {
    fenv_t all;
} environment;

static inline environment environment_enter(void) {
    environment before;
    (void)fegetenv(&before.all);
    (void)fesetenv(FE_DFL_ENV);
    return before;
}
static inline void environment_leave(environment before) { (void)fesetenv(&before.all); }

#endif

/// The body of a public function: the value of `call`, computed in the default environment. hidden: an argument to
/// hide, one that is passed by value if there is any.
#define ENVIRONMENT_RETURN(type, hidden, call)                                                                         \
    environment before_ = environment_enter();                                                                         \
    environment_hide(hidden);                                                                                          \
    type result_ = (call);                                                                                             \
    environment_hide(result_);                                                                                         \
    environment_leave(before_);                                                                                        \
    return result_

#endif
