// Filling in ovoid_error.
#ifndef OVOID_BASE_ERROR_H
#define OVOID_BASE_ERROR_H

#include "ovoid/base.h"

/// Writes code, place and the formatted sentence to *error (NULL is allowed) and returns the code.
#if defined(__GNUC__)
__attribute__((format(printf, 4, 5)))
#endif
ovoid_code
error_set(ovoid_error *error, ovoid_code code, int64_t place, const char *format, ...);

/// An assert that the host can hook: a programmer's error, not bad data.
#ifdef NDEBUG
#define OVOID_ASSERT(expression) ((void)0)
#else
#define OVOID_ASSERT(expression) ((expression) ? (void)0 : assert_fail(#expression, __FILE__, __LINE__))
#endif
void assert_fail(const char *expression, const char *file, int line);

#endif
