// The words of contacts in results.
#include "ovoid/manifold.h"

const char *ovoid_manifold_axis_get_name(ovoid_manifold_axis axis) {
    static const char *const names[] = {"none", "face a", "face b", "edges", "free"};
    return (unsigned)axis < sizeof names / sizeof *names ? names[axis] : "unknown";
}

const char *ovoid_manifold_proof_get_name(ovoid_manifold_proof proof) {
    static const char *const names[] = {"none", "points", "facets", "search", "normal"};
    return (unsigned)proof < sizeof names / sizeof *names ? names[proof] : "unknown";
}
