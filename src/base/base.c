// Version, names of codes, the assert hook.
#include "base/error.h"

#include <stdlib.h>

#define TEXT_OF(x) #x
#define TEXT(x) TEXT_OF(x)

const char *ovoid_get_version(void) {
    return TEXT(OVOID_VERSION_MAJOR) "." TEXT(OVOID_VERSION_MINOR) "." TEXT(OVOID_VERSION_PATCH);
}

const char *ovoid_code_get_name(ovoid_code code) {
    switch (code) {
    case OVOID_OK: return "ok";
    case OVOID_ERROR_MEMORY: return "out of memory";
    case OVOID_ERROR_ARGUMENT: return "bad argument";
    case OVOID_ERROR_NOT_FINITE: return "not finite";
    case OVOID_ERROR_EMPTY: return "empty";
    case OVOID_ERROR_RANGE: return "out of range";
    case OVOID_ERROR_RADIUS: return "bad radius";
    case OVOID_ERROR_ROTATION: return "not a rotation";
    case OVOID_ERROR_INDEX: return "bad index";
    case OVOID_ERROR_NOT_CONVEX: return "not convex";
    case OVOID_ERROR_HULL: return "hull failed";
    case OVOID_ERROR_FORMAT: return "bad format";
    case OVOID_ERROR_FILE: return "file error";
    case OVOID_ERROR_LIMIT: return "limit exceeded";
    case OVOID_ERROR_PROOF: return "proof does not hold";
    }
    return "unknown code";
}

static ovoid_assert_hook assert_hook;

void ovoid_set_assert_hook(ovoid_assert_hook hook) { assert_hook = hook; }

void assert_fail(const char *expression, const char *file, int line) {
    if (assert_hook) assert_hook(expression, file, line);
    abort();
}
