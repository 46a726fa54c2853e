/**
 * @file base.h
 * Version, errors and memory, used by every other header.
 *
 * Floating-point environment: every function of the core library computes in the default environment (round to nearest,
 * subnormals kept, no exception trapped) and restores the caller's settings on return: rounding mode, masks,
 * flush-to-zero. So the answers have the same bits whatever the caller has set. Exception flags that are raised stay
 * raised; others may be raised too, as by the functions of libm. To test flags, put the calls between feholdexcept and
 * fesetenv. An allocator or assert hook is called in the default environment. Cost: some nanoseconds a call, 0.1
 * microseconds where the settings differ.
 */
#ifndef OVOID_BASE_H
#define OVOID_BASE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The version of these headers; ovoid_get_version returns that of the library. */
#define OVOID_VERSION_MAJOR 0
/** Grows with every release that adds or, before 1.0, changes something. */
#define OVOID_VERSION_MINOR 3
/** Grows with every release that only corrects. */
#define OVOID_VERSION_PATCH 0

/** Marks the functions that the shared library exports. */
#if defined(_WIN32) && defined(OVOID_BUILD)
#define OVOID_API __declspec(dllexport)
#elif defined(__GNUC__) && !defined(_WIN32)
#define OVOID_API __attribute__((visibility("default")))
#else
#define OVOID_API
#endif

/** What went wrong; OVOID_OK is zero. */
typedef enum ovoid_code {
    OVOID_OK = 0,
    OVOID_ERROR_MEMORY,     /**< the allocator returned NULL */
    OVOID_ERROR_ARGUMENT,   /**< a required pointer is NULL or an option is out of its range */
    OVOID_ERROR_NOT_FINITE, /**< a coordinate, radius or pose holds NaN or infinity */
    OVOID_ERROR_EMPTY,      /**< no points, no faces, no bytes */
    OVOID_ERROR_RANGE,      /**< a length above OVOID_LENGTH_MAX */
    OVOID_ERROR_RADIUS,     /**< a negative radius */
    OVOID_ERROR_ROTATION,   /**< a quaternion of four zeros, an axis of zero, a matrix that is not a rotation */
    OVOID_ERROR_INDEX,      /**< an index past the end of what it points into */
    OVOID_ERROR_NOT_CONVEX, /**< the faces given do not bound a convex body */
    OVOID_ERROR_HULL,       /**< the computed hull does not close; exact signs exclude this */
    OVOID_ERROR_FORMAT,     /**< bytes that do not follow the file format */
    OVOID_ERROR_FILE,       /**< a file could not be opened, read or written */
    OVOID_ERROR_LIMIT,      /**< more items than a documented limit allows */
    OVOID_ERROR_PROOF       /**< a proof does not prove what it claims */
} ovoid_code;

/** An error: code, place and one sentence. Filled by the callee only when something fails. */
typedef struct ovoid_error {
    ovoid_code code;
    int64_t place;     /**< 0-based vertex, face or item, or 1-based line of a file; -1 where none applies */
    char message[256]; /**< what is wrong, where, what to do; always terminated */
} ovoid_error;

/** Lengths (coordinates, positions, radii) above this are refused, so that no product can overflow. */
#define OVOID_LENGTH_MAX 1e50

/** Shorter lengths are not resolved: no bracket is narrower. This one constant covers all underflow. */
#define OVOID_LENGTH_MIN 1e-130

/**
 * The source of memory. allocate returns at least `size` bytes aligned to 64, or NULL; release frees the result of
 * allocate. Both must be callable from several threads if shapes are created in several threads.
 */
typedef struct ovoid_allocator {
    void *(*allocate)(void *context, size_t size);
    void (*release)(void *context, void *memory);
    void *context;
} ovoid_allocator;

/**
 * A callback by which the host can stop a call that may run long. is_stopped(context) is called in the calling thread,
 * many times a second. 1 ends the call; from then on it must return 1 until the call returns. The results are true, as
 * if the limit of work were used up. The floating-point environment is the default one. All zero: no callback.
 */
typedef struct ovoid_watch {
    int (*is_stopped)(void *context);
    void *context;
} ovoid_watch;

/** The name of a code, in words, for example "not finite". Never NULL. */
OVOID_API const char *ovoid_code_get_name(ovoid_code code);

/** The library's version as "major.minor.patch". */
OVOID_API const char *ovoid_get_version(void);

/**
 * The function that an assert of the library calls before it aborts, for a programmer's error such as a NULL pair or
 * world. By default there is none. Set it once, before other threads use the library. Asserts exist only in builds
 * without NDEBUG.
 */
typedef void (*ovoid_assert_hook)(const char *expression, const char *file, int line);
/** Sets the hook; NULL removes it. */
OVOID_API void ovoid_set_assert_hook(ovoid_assert_hook hook);

#ifdef __cplusplus
}
#endif
#endif
