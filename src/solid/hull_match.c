// Is the body of triangles the convex hull of their points?
//
// Let H be the hull, c its centroid, and M the body: the triangles and all points around which they wind.
//
// Exact match. A triangle lies on the boundary of H if its plane has no point of H on one side. If all do (those
// without area bound nothing and are left out), no triangle enters the interior of H, so the winding number is the same
// all over it; if it is not 0 at c, M is H. A plane has no point of H on one side if some vertex of H is on it and the
// neighbors of that vertex are not on both sides: H lies in the cone from the vertex through its neighbors.
//
// Near match. Let n be a direction and h = max over H of n.x, and let all three corners v of a triangle have n.(v - c)
// >= (1 - l) (h - n.c). Then the triangle does not enter the interior of K = c + (1 - l) (H - c), for which n.(x - c)
// <= (1 - l) (h - n.c). If this is so for all triangles with one l < 1, and the winding number at c is not 0, it is not
// 0 in the whole interior of K: K lies in M, and M in H. For every direction the supports of H and K differ by l times
// that of H - c, at most w = l max |v - c| over the vertices of H. So for convex B
// d(H, B) <= d(M, B) <= d(K, B) <= d(H, B) + w,
// depths included. The same holds for other bodies, which are unions of convex ones. (The distance of M and H alone
// would not do: a slot may be arbitrarily thin.)
//
// n is the normal of a triangle of H nearby: its plane supports H exactly, and in double-double arithmetic its rounding
// is negligible. If no triangle will do, as for slivers, n comes from the depth of the triangle in H, and h from all
// vertices of H.
//
// Neither M nor K needs to be near H for this: for any solid with one l < 1, w is the gap of its hull.
//
// Cost: for each triangle the neighbors of a vertex; if it does not match exactly, the triangles around its corners.
#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "linear/dd3.h"
#include "ovoid/query.h"
#include "shape/block.h"
#include "solid/edges.h"
#include "solid/merge.h"

/// Limits of w: shares of the diagonal and of the largest coordinate (a few roundings to single precision), summed; and
/// a share of the diagonal for the sum.
#define SHARE_OF_DIAGONAL 1e-6
#define SHARE_OF_COORDINATE 4e-7
#define LARGEST_SHARE 1e-4

/// The largest l of a solid's hull gap: K is at least half as large as H.
#define LARGEST_GAP 0.5

/// How many vertices of H may be read for triangles that need all of them: for each triangle, and in addition.
#define LOOKS_OF_TRIANGLE 64
#define LOOKS 20000000

typedef struct match {
    const ovoid_shape *shape;
    ovoid_polytope hull;
    const solid_parts *parts;
    const ovoid_allocator *allocator;
    double scale;              ///< a power of two: body frame's coordinates below 1
    vec3 center;               ///< c, in that unit
    double reach;              ///< no vertex is farther from c than this, in that unit
    uint32_t *vertices;        ///< for each point the equal vertex of H, or UINT32_MAX
    uint32_t *starts, *around; ///< the triangles of H around each vertex
    double least, most;        ///< the least l that is needed; the largest that is allowed
    uint64_t looks;            ///< reads of vertices that are left
    uint32_t last;             ///< a vertex of H near the last triangle
} match;

static vec3 get_vertex(const match *m, uint32_t i) { return vec3_scale(vec3_at(m->hull.vertices, i), m->scale); }

// ---- exact match

// 1 if no vertex of H is on one side of the plane through the corners, given one that is on it.
static int is_support(const match *m, const vec3 corner[3], uint32_t vertex) {
    int above = 0, below = 0;
    for (uint32_t i = m->hull.neighbor_starts[vertex]; i < m->hull.neighbor_starts[vertex + 1]; i++) {
        int side = orient3d_sign(corner[0], corner[1], corner[2], get_vertex(m, m->hull.neighbors[i]));
        above |= side < 0;
        below |= side > 0;
        if (above && below) return 0;
    }
    return 1;
}

// A vertex of H that is farthest along n, to rounding.
static uint32_t climb(match *m, vec3 n) {
    uint32_t at = m->last, before;
    double best = vec3_dot(n, get_vertex(m, at));
    do {
        before = at;
        for (uint32_t i = m->hull.neighbor_starts[before]; i < m->hull.neighbor_starts[before + 1]; i++) {
            double height = vec3_dot(n, get_vertex(m, m->hull.neighbors[i]));
            if (height > best) best = height, at = m->hull.neighbors[i];
        }
    } while (at != before);
    return m->last = at;
}

// ---- near match

// The least l with which the plane of H's triangle t separates K from the corners, rounded up; infinity if rounding
// hides it. Differences of doubles are exact in pairs of them; each later operation is off by less than 2^-100 of its
// operands' sizes.
static double measure_plane(const match *m, const vec3 corner[3], uint32_t t) {
    const uint32_t *v = m->hull.triangles + 3 * (size_t)t;
    dd3 o = dd3_from(get_vertex(m, v[0]));
    dd3 e = dd3_sub(dd3_from(get_vertex(m, v[1])), o), f = dd3_sub(dd3_from(get_vertex(m, v[2])), o);
    dd3 n = dd3_cross(e, f);
    double size = vec3_norm(dd3_high(e)) * vec3_norm(dd3_high(f)), off = 0x1p-92 * size * m->reach;
    double height = -dd3_dot(n, dd3_sub(dd3_from(m->center), o)).high, deepest = 0;
    for (int i = 0; i < 3; i++) deepest = max2(deepest, -dd3_dot(n, dd3_sub(dd3_from(corner[i]), o)).high);
    // |v - c| is at most reach for the corners as well, as they lie in H.
    return height > 2 * off ? (deepest * (1 + 0x1p-50) + off) / (height - off) * (1 + 0x1p-50) : INFINITY;
}

// About the same as measure_plane, in doubles, to choose among planes.
static double estimate_plane(const match *m, const vec3 corner[3], uint32_t t) {
    const uint32_t *v = m->hull.triangles + 3 * (size_t)t;
    vec3 o = get_vertex(m, v[0]);
    vec3 n = vec3_cross(vec3_sub(get_vertex(m, v[1]), o), vec3_sub(get_vertex(m, v[2]), o));
    double height = vec3_dot(n, vec3_sub(o, m->center)), deepest = 0;
    for (int i = 0; i < 3; i++) deepest = max2(deepest, vec3_dot(n, vec3_sub(o, corner[i])));
    return height > 0 ? deepest / height : INFINITY;
}

typedef struct best_plane {
    double estimate;
    uint32_t triangle; ///< of H, or UINT32_MAX
} best_plane;

static void look_around(const match *m, const vec3 corner[3], uint32_t vertex, best_plane *best) {
    for (uint32_t i = m->starts[vertex]; i < m->starts[vertex + 1]; i++) {
        double estimate = estimate_plane(m, corner, m->around[i]);
        if (estimate < best->estimate) *best = (best_plane){estimate, m->around[i]};
    }
}

// The least l by a direction and all vertices of H. Coordinates are below 1, |n| is at most 1.01: each product is off
// by less than 2^-50.
static double measure_direction(const match *m, const vec3 corner[3], vec3 n) {
    double h = -INFINITY, deepest = 0, off = 0x1p-48;
    for (uint32_t i = 0; i < m->hull.vertex_count; i++) h = max2(h, vec3_dot(n, get_vertex(m, i)));
    for (int i = 0; i < 3; i++) deepest = max2(deepest, h - vec3_dot(n, corner[i]));
    double height = h - vec3_dot(n, m->center);
    return height > 2 * off ? (deepest + off) / (height - off) * (1 + 0x1p-50) : INFINITY;
}

// The least l by the depth of the triangle in H; infinity if all reads are used up. 0 if memory runs out.
static int measure_depth(match *m, const vec3 corner[3], double *l) {
    *l = INFINITY;
    if (m->looks < 2 * (uint64_t)m->hull.vertex_count) return 1;
    m->looks -= 2 * (uint64_t)m->hull.vertex_count;
    double xyz[9];
    for (int i = 0; i < 3; i++) {
        vec3 v = vec3_add(vec3_scale(corner[i], 1 / m->scale), m->hull.origin);
        xyz[3 * i] = v.x, xyz[3 * i + 1] = v.y, xyz[3 * i + 2] = v.z;
    }
    const ovoid_shape_options options = {.allocator = m->allocator};
    ovoid_error why;
    ovoid_shape *triangle = ovoid_shape_create_from_points(xyz, 3, &options, &why);
    if (!triangle) return why.code != OVOID_ERROR_MEMORY;
    ovoid_pair pair = {m->shape, triangle, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    vec3 n = ovoid_depth(&pair, NULL, NULL, NULL).normal;
    ovoid_shape_destroy(triangle);
    *l = min2(measure_direction(m, corner, n), measure_direction(m, corner, vec3_scale(n, -1)));
    return 1;
}

// ---- all triangles

static int has_area(const vec3 c[3]) { return !solid_is_collinear(c[0], c[1], c[2]); }

// 0 if a triangle separates H from the body by more than is allowed, -1 if memory runs out.
static int match_triangle(match *m, uint32_t t) {
    const uint32_t *point = m->parts->triangles[t].point;
    vec3 corner[3];
    best_plane best = {INFINITY, UINT32_MAX};
    for (int i = 0; i < 3; i++)
        corner[i] = vec3_scale(vec3_sub(vec3_at(m->parts->points, point[i]), m->hull.origin), m->scale);
    if (!has_area(corner)) return 1;
    for (int i = 0; i < 3; i++) {
        uint32_t v = m->vertices[point[i]];
        if (v == UINT32_MAX) continue;
        if (is_support(m, corner, v)) return 1;
        m->last = v;
        look_around(m, corner, v, &best);
    }
    vec3 n = vec3_unit(vec3_cross(vec3_sub(corner[1], corner[0]), vec3_sub(corner[2], corner[0])));
    uint32_t v = climb(m, vec3_dot(n, vec3_sub(corner[0], m->center)) < 0 ? vec3_scale(n, -1) : n);
    if (orient3d_sign(corner[0], corner[1], corner[2], get_vertex(m, v)) == 0 && is_support(m, corner, v)) return 1;
    look_around(m, corner, v, &best);
    double l = best.triangle == UINT32_MAX ? INFINITY : measure_plane(m, corner, best.triangle);
    if (!(l <= m->most)) {
        double deep;
        if (!measure_depth(m, corner, &deep)) return -1;
        l = min2(l, deep);
    }
    m->least = max2(m->least, l);
    return l <= m->most;
}

// Checks that all vertices of H are points of triangles, and lists its triangles around them.
static int prepare(match *m, const solid_merger *merger) {
    const ovoid_polytope *p = &m->hull;
    for (uint32_t i = 0; i < m->parts->point_count; i++) m->vertices[i] = UINT32_MAX;
    for (uint32_t v = 0; v < p->vertex_count; v++) {
        uint32_t point = merger_find(merger, vec3_add(vec3_at(p->vertices, v), p->origin));
        if (point == UINT32_MAX) return 0;
        m->vertices[point] = v;
    }
    for (uint32_t v = 0; v < p->vertex_count + 2; v++) m->starts[v] = 0;
    for (size_t i = 0; i < 3 * (size_t)p->triangle_count; i++) m->starts[p->triangles[i] + 2]++;
    for (uint32_t v = 2; v < p->vertex_count + 2; v++) m->starts[v] += m->starts[v - 1];
    for (size_t i = 0; i < 3 * (size_t)p->triangle_count; i++)
        m->around[m->starts[p->triangles[i] + 1]++] = (uint32_t)(i / 3);
    return 1;
}

static void measure_hull(match *m) {
    ovoid_measures measures = ovoid_shape_get_measures(m->shape);
    double extent = 0, coordinate = 0;
    for (uint32_t v = 0; v < m->hull.vertex_count; v++) {
        extent = max2(extent, vec3_max_abs(vec3_at(m->hull.vertices, v)));
        coordinate = max2(coordinate, vec3_max_abs(vec3_add(vec3_at(m->hull.vertices, v), m->hull.origin)));
    }
    m->scale = ldexp(1, -find_unit_exponent(extent) - 1);
    m->center = vec3_scale(measures.centroid, m->scale);
    for (uint32_t v = 0; v < m->hull.vertex_count; v++)
        m->reach = max2(m->reach, vec3_norm(vec3_sub(get_vertex(m, v), m->center)) * (1 + 0x1p-48));
    double diagonal = vec3_norm(vec3_sub(measures.box.max, measures.box.min));
    double most = min2(SHARE_OF_DIAGONAL * diagonal + SHARE_OF_COORDINATE * coordinate, LARGEST_SHARE * diagonal);
    m->most = most * m->scale / m->reach;
    m->looks = LOOKS + LOOKS_OF_TRIANGLE * (uint64_t)m->parts->triangle_count;
}

static int winds_around_center(const match *m) {
    int64_t winding = 0;
    for (uint32_t t = 0; t < m->parts->triangle_count; t++) {
        const uint32_t *point = m->parts->triangles[t].point;
        vec3 corner[3];
        for (int i = 0; i < 3; i++)
            corner[i] = vec3_scale(vec3_sub(vec3_at(m->parts->points, point[i]), m->hull.origin), m->scale);
        int crossing = has_area(corner) ? ray_count_crossing(m->center, corner, point) : 0;
        if (crossing == 2) return 0;
        winding += crossing;
    }
    return winding != 0;
}

// Whether the triangles lie on or near the hull's boundary; -1 if memory runs out.
static int match_triangles(match *m, const solid_merger *merger) {
    const ovoid_allocator *a = m->allocator;
    m->vertices = allocator_allocate(a, m->parts->point_count, sizeof(uint32_t));
    m->starts = allocator_allocate(a, (size_t)m->hull.vertex_count + 2, sizeof(uint32_t));
    m->around = allocator_allocate(a, m->hull.triangle_count, 3 * sizeof(uint32_t));
    int is_hull = m->vertices && m->starts && m->around ? prepare(m, merger) : -1;
    for (uint32_t t = 0; t < m->parts->triangle_count && is_hull > 0; t++) is_hull = match_triangle(m, t);
    allocator_release(a, m->vertices);
    allocator_release(a, m->starts);
    allocator_release(a, m->around);
    return is_hull;
}

// Whether K lies in the body; -1 if memory runs out.
static int match_body(match *m, const solid_merger *merger) {
    int is_hull = match_triangles(m, merger);
    return is_hull > 0 ? winds_around_center(m) : is_hull;
}

// w, rounded up; it remains a valid length.
static double compute_gap(const match *m) { return m->least * m->reach / m->scale * (1 + 0x1p-50); }

static int fill(match *m, const solid_merger *merger, ovoid_hull_match *out) {
    solid_edges edges;
    if (!solid_find_edges(m->parts, m->allocator, &edges)) return 0;
    *out = (ovoid_hull_match){.is_closed = edges.unmatched == 0, .edges_unmatched = edges.unmatched};
    if (!out->is_closed || m->hull.rank < 3) return 1;
    measure_hull(m);
    int is_hull = match_body(m, merger);
    if (is_hull < 0) return 0;
    out->is_hull = is_hull;
    if (is_hull) out->allowance = compute_gap(m);
    return 1;
}

static ovoid_code match_hull(const ovoid_triangles *given, const ovoid_shape *hull, ovoid_hull_match *out,
                             ovoid_error *error) {
    *out = (ovoid_hull_match){.is_closed = 0};
    if (!hull) return error_set(error, OVOID_ERROR_ARGUMENT, -1, "no hull to compare with");
    ovoid_code code = solid_validate_triangles(given, error);
    if (code != OVOID_OK) return code;
    ovoid_allocator allocator = allocator_make(NULL);
    solid_merger merger;
    int is_made = merger_make(&merger, given, &allocator);
    if (is_made) {
        solid_parts parts = {merger.points, merger.triangles, merger.count, (uint32_t)given->count};
        match m = {hull, ovoid_shape_get_polytope(hull), &parts, .allocator = &allocator};
        is_made = fill(&m, &merger, out);
        merger_destroy(&merger, &allocator);
    }
    if (is_made) return OVOID_OK;
    return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory to compare %zu triangles with their hull", given->count);
}

ovoid_code ovoid_triangles_compute_hull_match(const ovoid_triangles *triangles, const ovoid_shape *hull,
                                              ovoid_hull_match *found, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, hull, match_hull(triangles, hull, found, error));
}

static ovoid_code measure_gap(const ovoid_solid *solid, const ovoid_shape *hull, double *gap, ovoid_error *error) {
    *gap = INFINITY;
    match m = {hull, ovoid_shape_get_polytope(hull), .allocator = &solid->allocator};
    int is_plain = hull->lower_radius == 0 && hull->upper_radius == 0 && m.hull.rank == 3;
    if (!solid->report.is_closed || !is_plain) return OVOID_OK;
    const ovoid_triangles given = {solid->points, solid->point_count, solid->triangles->point, solid->triangle_count};
    solid_merger merger;
    int is_inside = -1;
    if (merger_make(&merger, &given, m.allocator)) {
        const solid_parts parts = {merger.points, merger.triangles, merger.count, solid->triangle_count};
        m.parts = &parts;
        measure_hull(&m);
        m.most = LARGEST_GAP;
        is_inside = match_body(&m, &merger);
        merger_destroy(&merger, m.allocator);
    }
    if (is_inside > 0) *gap = compute_gap(&m);
    if (is_inside >= 0) return OVOID_OK;
    return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory to compare a solid of %u triangles with its hull",
                     solid->triangle_count);
}

ovoid_code ovoid_solid_compute_hull_gap(const ovoid_solid *solid, const ovoid_shape *hull, double *gap,
                                        ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, hull, measure_gap(solid, hull, gap, error));
}
