// Step (g): where a ray from the ellipsoid's centre leaves the polyhedron, and the vertex extreme along a direction.
// Both are the largest of many dot products; the areas list those that can be the largest. docs/areas.md has the
// proofs.
//
// Every rule takes the same stored points and the same mapped direction, so the products are the same bits, and ties go
// to the lowest index: rules that are sound give the same answer as testing all facets, bit for bit.
#include "base/environment.h"
#include "paper/area.h"
#include "shape/direction_cells.h"

/// The best facet so far.
typedef struct best_facet {
    double value;
    uint32_t facet, touched;
} best_facet;

static inline void test_facet(best_facet *b, const ovoid_areas *a, uint32_t facet, vec3 u) {
    double value = vec3_dot(a->duals[facet], u);
    b->touched++;
    if (value > b->value || (value == b->value && facet < b->facet)) {
        b->value = value;
        b->facet = facet;
    }
}

uint32_t octants_find_kept(vec3 toward, ovoid_area_rule rule) {
    if (rule == OVOID_RULE_ALL) return 0xff;
    uint32_t kept = 0;
    // -sqrt(2)/2 |v| |toward| with |v| = sqrt(3): the paper's areas have the vectors (+-1, +-1, +-1).
    double limit = -sqrt(0.5) * sqrt(3) * vec3_norm(toward);
    for (uint32_t octant = 0; octant < 8; octant++) {
        // The products of toward with the three axes that span the octant.
        double x = octant & 1 ? -toward.x : toward.x, y = octant & 2 ? -toward.y : toward.y,
               z = octant & 4 ? -toward.z : toward.z;
        // An octant lies behind if all three do: the vectors behind are a convex cone.
        int is_dropped = rule == OVOID_RULE_SIGNS ? x < 0 && y < 0 && z < 0 : (x + y) + z < limit;
        if (!is_dropped) kept |= 1u << octant;
    }
    return kept;
}

/// Tests the facets of the kept octants, each once: where the first kept octant lists it.
static void test_octants(best_facet *b, const ovoid_areas *a, uint32_t kept, vec3 u) {
    const area_table *t = &a->by_octant;
    for (uint32_t octant = 0; octant < 8; octant++) {
        if (!(kept >> octant & 1)) continue;
        uint32_t before = kept & ((1u << octant) - 1);
        const uint32_t *list = t->entries + t->starts[octant];
        for (uint32_t i = 0; i < t->counts[octant]; i++)
            if (!(a->octants[list[i]] & before)) test_facet(b, a, list[i], u);
    }
}

/// Tests the facets of the cell that holds the ray.
static void test_cell(best_facet *b, const ovoid_areas *a, vec3 u) {
    const area_table *t = a->k > 0 ? &a->facets : &a->by_octant;
    uint32_t cell = a->k > 0 ? cube_cell_of(u, a->k) : octant_of(u);
    const uint32_t *list = t->entries + t->starts[cell];
    for (uint32_t i = 0; i < t->counts[cell]; i++) test_facet(b, a, list[i], u);
}

static ovoid_exit find_exit(const ovoid_areas *areas, ovoid_vec3 direction, ovoid_vec3 toward, ovoid_area_rule rule) {
    vec3 u = sym3_mul_vec3(areas->inverse_root, direction_scaled(direction));
    best_facet best = {-INFINITY, 0, 0};
    if (rule == OVOID_RULE_ALL)
        for (uint32_t j = 0; j < areas->polytope.facet_count; j++) test_facet(&best, areas, j, u);
    else if (rule == OVOID_RULE_RAY)
        test_cell(&best, areas, u);
    else {
        vec3 w = sym3_mul_vec3(areas->inverse_root, direction_scaled(toward));
        test_octants(&best, areas, octants_find_kept(w, rule), u);
    }

    // The ray's length up to that facet's plane, in the body frame.
    ovoid_plane p = areas->polytope.planes[best.facet];
    double rise = vec3_dot(p.normal, direction), height = p.offset - vec3_dot(p.normal, areas->center);
    ovoid_exit e = {INFINITY, areas->center, best.facet, best.touched};
    if (best.value > 0 && rise > 0) {
        e.t = height / rise;
        e.point = vec3_add_scaled(areas->center, direction, e.t);
    }
    return e;
}

ovoid_exit ovoid_areas_find_exit(const ovoid_areas *areas, ovoid_vec3 direction, ovoid_vec3 toward,
                                 ovoid_area_rule rule) {
    vec3 both[2] = {direction, toward};
    ENVIRONMENT_RETURN(ovoid_exit, both, find_exit(areas, both[0], both[1], rule));
}

static uint32_t find_support(const ovoid_areas *areas, ovoid_vec3 direction, uint32_t *touched) {
    const area_table *t = &areas->vertices;
    vec3 n = sym3_mul_vec3(areas->root, direction_scaled(direction));
    uint32_t cell = areas->k > 0 ? cube_cell_of(n, areas->k) : octant_of(n);
    const uint32_t *list = t->entries + t->starts[cell];
    uint32_t best = list[0];
    double most = -INFINITY;
    for (uint32_t i = 0; i < t->counts[cell]; i++) {
        double value = vec3_dot(vec3_at(areas->polytope.vertices, list[i]), direction);
        if (value > most) {
            most = value;
            best = list[i];
        }
    }
    if (touched) *touched = t->counts[cell];
    return best;
}

uint32_t ovoid_areas_find_support(const ovoid_areas *areas, ovoid_vec3 direction, uint32_t *touched) {
    ENVIRONMENT_RETURN(uint32_t, direction, find_support(areas, direction, touched));
}
