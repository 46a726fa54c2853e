// The floating-point environment. Every public function of the core that computes does so in the default one: round to
// nearest, subnormals kept, no exception trapped. So its bits and its bounds are the same whatever the caller has set,
// and it returns with the caller's settings as they were. Exception flags that the caller had raised stay; others may
// be raised by the arithmetic, as libm's functions do it.
//
// On x86-64 all arithmetic is SSE's (nothing here is long double), so one control register holds all settings: it is
// read on entry, and written only if the caller's settings differ. (To restore a flag it would have to be read again on
// exit: 6 ns, half of what the shortest query takes.) Windows' sine and cosine are the x87's, so its
// kept there too. 64-bit ARM has a register of settings. Elsewhere <fenv.h> does the same, slower.
//
// A compiler does not know of that register, and may move arithmetic across reads and writes of it. So the operands and
// the results of the arithmetic are hidden from it (environment_hide): arguments passed by value after entry, the
// result before exit. Data read through pointers need no hiding.
#ifndef OVOID_BASE_ENVIRONMENT_H
#define OVOID_BASE_ENVIRONMENT_H

#include "base/arithmetic.h"

/// Makes the value of a variable unknown to the compiler; all computations of it are finished before.
#define environment_hide(variable) __asm__ volatile("" : "+m"(variable) : : "memory")

#if defined(__x86_64__) && !defined(OVOID_ENVIRONMENT_PORTABLE)

#include <stdint.h>

/// The caller's settings: MXCSR; on Windows also the x87's control and status words.
typedef struct environment {
    uint32_t control;
#if defined(_WIN32)
    uint16_t x87_control, x87_status;
#endif
} environment;

/// The settings in MXCSR (subnormals as zero, masks, rounding, flush to zero) and their default. The bits below are the
/// exception flags.
enum { ENVIRONMENT_CONTROL = 0xffc0, ENVIRONMENT_DEFAULT = 0x1f80 };

static inline uint32_t environment_read(void) {
    uint32_t control;
    __asm__ volatile("stmxcsr %0" : "=m"(control) : : "memory");
    return control;
}
static inline void environment_write(uint32_t control) { __asm__ volatile("ldmxcsr %0" : : "m"(control) : "memory"); }

#if defined(_WIN32)

enum { X87_DEFAULT = 0x37f, X87_FLAGS = 0x3f };

static inline uint16_t x87_read_status(void) {
    uint16_t status;
    __asm__ volatile("fnstsw %0" : "=m"(status) : : "memory");
    return status;
}
static inline void x87_write_control(uint16_t control) { __asm__ volatile("fldcw %0" : : "m"(control) : "memory"); }

static inline void x87_enter(environment *before) {
    __asm__ volatile("fnstcw %0" : "=m"(before->x87_control) : : "memory");
    before->x87_status = x87_read_status();
    if (before->x87_control != X87_DEFAULT) x87_write_control(X87_DEFAULT);
}
static inline void x87_leave(const environment *before) {
    if ((x87_read_status() ^ before->x87_status) & X87_FLAGS) {
        uint32_t all[7];
        __asm__ volatile("fnstenv %0" : "=m"(all) : : "memory");
        all[1] = (all[1] & ~(uint32_t)X87_FLAGS) | (before->x87_status & X87_FLAGS);
        __asm__ volatile("fldenv %0" : : "m"(all) : "memory");
    }
    x87_write_control(before->x87_control);
}

#endif

/// Sets the default environment and returns the previous one. Flags that are raised stay raised.
static inline environment environment_enter(void) {
    environment before = {.control = environment_read()};
#if defined(_WIN32)
    x87_enter(&before);
#endif
    if ((before.control & ENVIRONMENT_CONTROL) != ENVIRONMENT_DEFAULT)
        environment_write((before.control & ~(uint32_t)ENVIRONMENT_CONTROL) | ENVIRONMENT_DEFAULT);
    return before;
}
/// Restores the settings that environment_enter returned.
static inline void environment_leave(environment before) {
#if defined(_WIN32)
    x87_leave(&before);
#endif
    if ((before.control & ENVIRONMENT_CONTROL) != ENVIRONMENT_DEFAULT) environment_write(before.control);
}

#elif defined(__aarch64__) && !defined(OVOID_ENVIRONMENT_PORTABLE)

#include <stdint.h>

/// The caller's settings: FPCR, of which zero is the default.
typedef struct environment {
    uint64_t control;
} environment;

static inline environment environment_enter(void) {
    environment before;
    __asm__ volatile("mrs %0, fpcr" : "=r"(before.control) : : "memory");
    if (before.control) __asm__ volatile("msr fpcr, %0" : : "r"((uint64_t)0) : "memory");
    return before;
}
static inline void environment_leave(environment before) {
    if (before.control) __asm__ volatile("msr fpcr, %0" : : "r"(before.control) : "memory");
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

// ---- the bodies of public functions: each computes inside one of these, or in a function that does. hidden: an
// argument to hide, one that is passed by value if there is any.

/// The value of `call`.
#define ENVIRONMENT_RETURN(type, hidden, call)                                                                         \
    environment before_ = environment_enter();                                                                         \
    environment_hide(hidden);                                                                                          \
    type result_ = (call);                                                                                             \
    environment_hide(result_);                                                                                         \
    environment_leave(before_);                                                                                        \
    return result_

/// Runs `call`, which writes into `name`, declared here: for results too large to copy.
#define ENVIRONMENT_RETURN_FILLED(type, name, hidden, call)                                                            \
    type name;                                                                                                         \
    environment before_ = environment_enter();                                                                         \
    environment_hide(hidden);                                                                                          \
    (call);                                                                                                            \
    environment_hide(name);                                                                                            \
    environment_leave(before_);                                                                                        \
    return name

/// The value of a call of a COMPILER_NOINLINE function: no arithmetic can leave it, so nothing is hidden, and the
/// answer is built in the caller's memory, without a copy.
#define ENVIRONMENT_RETURN_CALL(call)                                                                                  \
    __attribute__((cleanup(environment_leave_at), unused)) environment before_ = environment_enter();                  \
    return call
static inline void environment_leave_at(const environment *before) { environment_leave(*before); }

/// Runs `call`, which returns nothing.
#define ENVIRONMENT_RUN(call)                                                                                          \
    environment before_ = environment_enter();                                                                         \
    (call);                                                                                                            \
    environment_leave(before_)

#endif
