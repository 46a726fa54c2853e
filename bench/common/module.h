// Shared modules, each with its libraries in a scope of its own: Bullet in double and in single precision could not be
// linked into one program.
#ifndef OVOID_BENCH_COMMON_MODULE_H
#define OVOID_BENCH_COMMON_MODULE_H

/// A function of a module; the caller casts it to its type.
typedef void (*module_function)(void);
/// The function `name` that the module in the file exports; NULL, with a line on stderr, if there is none.
module_function module_load(const char *path, const char *name);

#endif
