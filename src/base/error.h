// Filling in ovoid_error.
#ifndef OVOID_BASE_ERROR_H
#define OVOID_BASE_ERROR_H

#include "ovoid/base.h"

/// Writes code, place and the formatted sentence to *error (NULL is allowed).
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
void error_write(ovoid_error *error, ovoid_code code, int64_t place, const char *format, ...);

/// The same, with the code as its value: a macro, so that static analysis sees that what is returned is not OVOID_OK.
#define error_set(error, code, ...) (error_write((error), (code), __VA_ARGS__), (code))

/// An assert that the host can hook: a programmer's error, not bad data.
#ifdef NDEBUG
#define OVOID_ASSERT(expression) ((void)0)
#else
#define OVOID_ASSERT(expression) ((expression) ? (void)0 : assert_fail(#expression, __FILE__, __LINE__))
#endif
void assert_fail(const char *expression, const char *file, int line);

#endif
