// Errors with code, place and sentence, and asserts.
#ifndef OVOID_BASE_ERROR_H
#define OVOID_BASE_ERROR_H

#include "base/compiler.h"
#include "ovoid/base.h"

/// Writes code, place and the formatted sentence to *error (NULL is allowed).
COMPILER_PRINTF(4, 5)
void error_write(ovoid_error *error, ovoid_code code, int64_t place, const char *format, ...);

/// error_write with the code as its value: a macro, so that static analysis sees that the value is not OVOID_OK.
#define error_set(error, code, ...) (error_write((error), (code), __VA_ARGS__), (code))

/// An assert that the host can hook: a programmer's error, not bad data.
#ifdef NDEBUG
#define OVOID_ASSERT(expression) ((void)0)
#else
#define OVOID_ASSERT(expression) ((expression) ? (void)0 : assert_fail(#expression, __FILE__, __LINE__))
#endif
/// Calls the hook, if one is set, and aborts.
_Noreturn void assert_fail(const char *expression, const char *file, int line);

#endif
