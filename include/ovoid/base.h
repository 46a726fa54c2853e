/**
 * @file base.h
 * Version, errors and memory: what every other header stands on.
 *
 * Floating-point environment: every function of the core library computes in the default one (round to nearest,
 * subnormals kept, no exception trapped) and returns with the caller's settings as they were: rounding mode, masks,
 * flush-to-zero. So the caller may have set anything; the answers have the same bits. Exception flags that are raised
 * stay raised, and others may be, as by the functions of libm; who tests them puts calls between feholdexcept and
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

/** The version of these headers; ovoid_get_version is the library's. */
#define OVOID_VERSION_MAJOR 0
/** Grows with every release that adds or, before 1.0, changes something. */
#define OVOID_VERSION_MINOR 2
/** Grows with every release that only mends. */
#define OVOID_VERSION_PATCH 0

/** Marks what the shared library exports. */
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
    OVOID_ERROR_ROTATION,   /**< a quaternion of four zeros, an axis of zero, a matrix that is no rotation */
    OVOID_ERROR_INDEX,      /**< an index past the end of what it points into */
    OVOID_ERROR_NOT_CONVEX, /**< the faces given do not bound a convex body */
    OVOID_ERROR_HULL,       /**< the hull does not close: exact signs do not let it happen */
    OVOID_ERROR_FORMAT,     /**< bytes that do not follow the file format */
    OVOID_ERROR_FILE,       /**< a file could not be opened, read or written */
    OVOID_ERROR_LIMIT,      /**< more items than a documented limit allows */
    OVOID_ERROR_PROOF       /**< a proof does not show what it claims */
} ovoid_code;

/** An error: code, place and one sentence. Filled by the callee only when something fails. */
typedef struct ovoid_error {
    ovoid_code code;
    int64_t place;     /**< 0-based vertex, face or item, or 1-based line of a file; -1 where none applies */
    char message[256]; /**< what is wrong, where, what to do; always terminated */
} ovoid_error;

/** Lengths (coordinates, positions, radii) above this are refused, so that no product can overflow. */
#define OVOID_LENGTH_MAX 1e50

/** Below this length nothing is resolved: brackets are never narrower. It stands for all underflow. */
#define OVOID_LENGTH_MIN 1e-130

/**
 * Where memory comes from. allocate returns at least `size` bytes aligned to 64, or NULL; release takes what
 * allocate returned. Both must be callable from several threads if shapes are created in several threads.
 */
typedef struct ovoid_allocator {
    void *(*allocate)(void *context, size_t size);
    void (*release)(void *context, void *memory);
    void *context;
} ovoid_allocator;

/**
 * A host's question to a call that may run long: may it go on? is_stopped(context) is called in the calling thread,
 * many times a second; 1 ends the call, and is then to be said again until it returns. What it gives is true: as though
 * the most it may look at were used up. The floating-point environment is the default one. All zero: nobody asks.
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
 * What an assert of the library calls before it aborts: a programmer's error such as a NULL pair or world. The default
 * writes nothing. Set once, before other threads use the library. Asserts exist in builds without NDEBUG only.
 */
typedef void (*ovoid_assert_hook)(const char *expression, const char *file, int line);
/** Sets the hook; NULL takes it away. */
OVOID_API void ovoid_set_assert_hook(ovoid_assert_hook hook);

#ifdef __cplusplus
}
#endif
#endif
