// What of a body is clipped, seen along the normal. A facet of many corners is used with as many of them as fit: their
// hull is in the facet, so what is found in it is true of the body.
#include "manifold/manifold.h"

_Static_assert(2 * PATCH_CORNERS == OVOID_MANIFOLD_CORNERS, "a polygon has at most as many corners as two patches");

// Of a facet of more corners than a patch has room for, as many of them, from the one that is extreme on.
static void take_some(const ovoid_shape *s, uint32_t facet, uint32_t low, manifold_patch *p) {
    uint32_t start = shape_loop_starts(s)[facet], count = shape_loop_starts(s)[facet + 1] - start, first = 0;
    if (count <= PATCH_CORNERS) return; // take_facet has them all
    while (first < count && shape_loop_vertices(s)[start + first] != low) first++;
    p->at.count = PATCH_CORNERS;
    for (uint32_t i = 0; i < PATCH_CORNERS; i++) {
        uint32_t corner = start + (first + (uint32_t)((uint64_t)i * count / PATCH_CORNERS)) % count;
        p->at.vertices[i] = shape_loop_vertices(s)[corner];
        p->edges[i] = shape_loop_edges(s)[corner];
    }
}

static void take_facet(const ovoid_shape *s, uint32_t facet, uint32_t low, manifold_patch *p) {
    const uint32_t *starts = shape_loop_starts(s), *vertices = shape_loop_vertices(s), *edges = shape_loop_edges(s);
    uint32_t start = starts[facet], count = starts[facet + 1] - start;
    if (count > PATCH_CORNERS) {
        take_some(s, facet, low, p);
        return;
    }
    p->at.count = count;
    for (uint32_t i = 0; i < count; i++) {
        p->at.vertices[i] = vertices[start + i];
        p->edges[i] = edges[start + i];
    }
}

// Seen from outside of B its facets turn the other way.
static void reverse(manifold_patch *p) {
    for (uint32_t i = 0, k = p->at.count - 1; i < k; i++, k--) {
        uint32_t vertex = p->at.vertices[i];
        p->at.vertices[i] = p->at.vertices[k];
        p->at.vertices[k] = vertex;
    }
    for (uint32_t i = 0, k = p->at.count - 2; i < k && p->at.count > 2; i++, k--) {
        uint32_t edge = p->edges[i];
        p->edges[i] = p->edges[k];
        p->edges[k] = edge;
    }
}

// The corners of an edge or a vertex.
static void take_thin(const ovoid_shape *s, uint32_t feature, manifold_patch *p) {
    uint32_t index = feature_get_index(feature);
    p->at.count = 1;
    p->at.vertices[0] = index;
    if (feature_get_kind(feature) != OVOID_MANIFOLD_EDGE) return;
    edge_ends e = shape_get_ends(s, index);
    p->at.count = 2;
    p->at.vertices[0] = e.from;
    p->at.vertices[1] = e.to;
    p->edges[0] = p->edges[1] = index;
}

// The plane through a segment that is level across it.
static void set_line_slope(manifold_patch *p) {
    const simd_patch *at = &p->at;
    double dx = at->x[1] - at->x[0], dy = at->y[1] - at->y[0], dz = at->z[1] - at->z[0], square = dx * dx + dy * dy;
    if (!(square > 0)) return;
    p->slope_x = dz * dx / square;
    p->slope_y = dz * dy / square;
    p->steepness = sqrt(1 + dz * dz / square);
}

void patch_set_slope(manifold_patch *p, vec3 plane) {
    p->slope_x = -plane.x / plane.z;
    p->slope_y = -plane.y / plane.z;
    p->steepness = max2(1, 1 / fabs(plane.z));
}

static void set_side(simd_patch *p, uint32_t i, double x, double y, uint32_t corner) {
    p->side_x[i] = x;
    p->side_y[i] = y;
    p->side_at[i] = x * p->x[corner] + y * p->y[corner];
}

// The ends of a segment; the sides of a point.
static void set_thin_sides(simd_patch *p) {
    p->side_count = 4;
    if (p->count == 2) {
        set_side(p, 2, p->side_y[0], -p->side_x[0], 0);
        set_side(p, 3, -p->side_y[0], p->side_x[0], 1);
    } else
        for (uint32_t i = 0; i < 4; i++) set_side(p, i, i < 2 ? 1 - 2.0 * i : 0, i < 2 ? 0 : 5 - 2.0 * i, 0);
}

void patch_place(const simd_placing *placing, manifold_patch *p) {
    // The first one again behind the last, to a whole number of lanes.
    for (uint32_t i = p->at.count; i < simd_patch_pad(p->at.count); i++) p->at.vertices[i] = p->at.vertices[0];
    patch_get_kernels()->place(placing, &p->at);
    p->at.side_count = p->at.count;
    p->slope_x = p->slope_y = 0;
    p->steepness = 1;
    if (p->at.count < 3) set_thin_sides(&p->at);
    if (p->at.count == 2) set_line_slope(p);
}

// What the patches of A and of B differ in: the body, and how its vertices are placed.
typedef struct patch_body {
    const ovoid_shape *shape;
    vec3 u, v, n; ///< the frame's axes in the axes of the body
    vec3 shift;   ///< of the body along them
    uint32_t low; ///< the vertex that is extreme
    int is_b;
} patch_body;

static void make_patch(const patch_body *body, uint32_t feature, manifold_patch *p) {
    if (feature_get_kind(feature) == OVOID_MANIFOLD_FACET)
        take_facet(body->shape, feature_get_index(feature), body->low, p);
    else
        take_thin(body->shape, feature, p);
    if (body->is_b) reverse(p);
    vec3 u = body->u, v = body->v, n = body->n, t = body->shift;
    const simd_placing placing = {
        shape_get_points(body->shape), {u.x, u.y, u.z, v.x, v.y, v.z, n.x, n.y, n.z}, {t.x, t.y, t.z}};
    patch_place(&placing, p);
    if (p->at.count < 3) return;
    vec3 normal = shape_get_facet_normal(body->shape, feature_get_index(feature));
    patch_set_slope(p, (vec3){vec3_dot(u, normal), vec3_dot(v, normal), vec3_dot(n, normal)});
}

void patch_make_a(const manifold_frame *m, uint32_t feature, manifold_patch *p) {
    make_patch(&(patch_body){m->pair->a, m->u, m->v, m->n, {0, 0, 0}, m->low_a, 0}, feature, p);
}

void patch_make_b(const manifold_frame *m, uint32_t feature, manifold_patch *p) {
    make_patch(&(patch_body){m->pair->b, m->u_in_b, m->v_in_b, m->n_in_b, {m->tu, m->tv, m->tn}, m->low_b, 1}, feature,
               p);
}

double patch_measure_distance(const manifold_patch *p, double x, double y) {
    double least = INFINITY, nearest = INFINITY;
    uint32_t count = p->at.count;
    for (uint32_t i = 0; count > 2 && i < count; i++) least = min2(least, patch_get_side(p, i, x, y));
    if (count > 2 && least >= 0) return 0;
    for (uint32_t i = 0; i < (count > 1 ? patch_get_edge_count(p) : 1); i++)
        nearest = min2(nearest, segment_measure_square(&p->at.x[i], &p->at.y[i], (vec3){x, y, 0}));
    return sqrt(nearest);
}
