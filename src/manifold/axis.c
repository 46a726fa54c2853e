// The normal of a contact from the features that make it: so a contact that is kept moves with its bodies.
#include "manifold/manifold.h"

int shape_has_feature(const ovoid_shape *s, uint32_t feature) {
    uint32_t index = feature_get_index(feature);
    switch (feature_get_kind(feature)) {
    case OVOID_MANIFOLD_VERTEX: return index < s->vertex_count;
    case OVOID_MANIFOLD_EDGE: return index < s->counts.neighbors;
    case OVOID_MANIFOLD_FACET: return s->rank >= 2 && index < shape_get_loop_count(s);
    default: return 0;
    }
}

static vec3 get_vertex(const ovoid_shape *s, uint32_t i) { return vec3_at(shape_vertices(s), i); }

// An edge as its middle and the vector from its middle to its end.
typedef struct line {
    vec3 middle, half;
} line;

static line get_line(const ovoid_shape *s, uint32_t edge) {
    edge_ends e = shape_get_ends(s, edge);
    vec3 p = get_vertex(s, e.from), q = get_vertex(s, e.to);
    return (line){vec3_scale(vec3_add(p, q), 0.5), vec3_scale(vec3_sub(q, p), 0.5)};
}
static line get_line_b(const pair_frame *f, uint32_t edge) {
    line l = get_line(f->b, edge);
    return (line){frame_b(f, l.middle), mat3_mul_vec3(f->rotation, l.half)};
}

// A vertex or an edge; a facet counts as its first corner.
static line get_feature_line(const ovoid_shape *s, uint32_t feature) {
    uint32_t index = feature_get_index(feature);
    if (feature_get_kind(feature) == OVOID_MANIFOLD_EDGE) return get_line(s, index);
    if (feature_get_kind(feature) == OVOID_MANIFOLD_FACET) index = shape_loop_vertices(s)[shape_loop_starts(s)[index]];
    return (line){get_vertex(s, index), {0, 0, 0}};
}

static double clamp(double x) { return x < -1 ? -1 : x > 1 ? 1 : x; }

// Of a line the parameter of the point nearest to p.
static double find_nearest(const line *l, vec3 p) {
    double square = vec3_norm_squared(l->half);
    return square > 0 ? clamp(vec3_dot(l->half, vec3_sub(p, l->middle)) / square) : 0;
}
static vec3 line_get_point(const line *l, double t) { return vec3_add_scaled(l->middle, l->half, t); }

// C. Ericson, Real-time collision detection, 2004: the nearest points of two segments.
feature_points features_find_nearest(const pair_frame *f, uint32_t feature_a, uint32_t feature_b) {
    line a = get_feature_line(f->a, feature_a), b = get_feature_line(f->b, feature_b);
    b = (line){frame_b(f, b.middle), mat3_mul_vec3(f->rotation, b.half)};
    vec3 w = vec3_sub(b.middle, a.middle);
    double aa = vec3_norm_squared(a.half), bb = vec3_norm_squared(b.half), ab = vec3_dot(a.half, b.half);
    double det = aa * bb - ab * ab;
    double s = det > 0 ? clamp((bb * vec3_dot(a.half, w) - ab * vec3_dot(b.half, w)) / det) : 0;
    double t = find_nearest(&b, line_get_point(&a, s));
    s = find_nearest(&a, line_get_point(&b, t));
    return (feature_points){line_get_point(&a, s), line_get_point(&b, t)};
}

// Orthogonal to an edge of each, from A to B: each edge is on the side of its body that faces the other body, so n
// points from the centre of A to its edge and from the edge of B to its centre.
static int make_from_edges(const pair_frame *f, const manifold_axis *axis, vec3 *n) {
    line a = get_line(f->a, feature_get_index(axis->a)), b = get_line_b(f, feature_get_index(axis->b));
    vec3 cross = vec3_cross(vec3_unit(a.half), vec3_unit(b.half));
    if (!(vec3_norm_squared(cross) > 1e-12)) return 0;
    vec3 out = vec3_sub(a.middle, f->a->measures.centroid),
         in = vec3_sub(frame_b(f, f->b->measures.centroid), b.middle), way = vec3_add(out, in);
    double side = vec3_dot(cross, way);
    if (fabs(side) <= 1e-9 * f->size) side = vec3_dot(cross, vec3_sub(b.middle, a.middle));
    *n = vec3_unit(side < 0 ? vec3_neg(cross) : cross);
    return 1;
}

// Between the nearest points, if these are apart by more than what rounding makes of their direction.
static int make_from_points(const pair_frame *f, const manifold_axis *axis, vec3 *n) {
    feature_points p = features_find_nearest(f, axis->a, axis->b);
    vec3 d = vec3_sub(p.b, p.a);
    int has_facet =
        feature_get_kind(axis->a) == OVOID_MANIFOLD_FACET || feature_get_kind(axis->b) == OVOID_MANIFOLD_FACET;
    if (!has_facet && vec3_norm(d) > 1e-6 * f->size) *n = vec3_unit(d);
    return 1;
}

int axis_compute_normal(const pair_frame *f, const manifold_axis *axis, vec3 *n) {
    if (axis->kind == OVOID_MANIFOLD_FREE && axis->a == OVOID_MANIFOLD_DIRECTION) return axis->b == axis->a;
    if (!shape_has_feature(f->a, axis->a) || !shape_has_feature(f->b, axis->b)) return 0;
    uint32_t a = feature_get_kind(axis->a), b = feature_get_kind(axis->b);
    switch (axis->kind) {
    case OVOID_MANIFOLD_FACE_A:
        if (a != OVOID_MANIFOLD_FACET) return 0;
        *n = shape_get_facet_normal(f->a, feature_get_index(axis->a));
        return 1;
    case OVOID_MANIFOLD_FACE_B:
        if (b != OVOID_MANIFOLD_FACET) return 0;
        *n = vec3_neg(mat3_mul_vec3(f->rotation, shape_get_facet_normal(f->b, feature_get_index(axis->b))));
        return 1;
    case OVOID_MANIFOLD_EDGES:
        return a == OVOID_MANIFOLD_EDGE && b == OVOID_MANIFOLD_EDGE && make_from_edges(f, axis, n);
    case OVOID_MANIFOLD_FREE: return make_from_points(f, axis, n);
    default: return 0;
    }
}

gap_along gap_measure_along(const pair_frame *f, vec3 n) {
    gap_along g = {.n = n, .n_in_b = mat3_mul_transposed_vec3(f->rotation, n), .tn = vec3_dot(n, f->translation)};
    simd_pair ends = frame_find_pair(f, n, vec3_neg(g.n_in_b));
    g.gap = (g.tn - ends.low.value) - ends.high.value;
    g.low_a = ends.high.index;
    g.low_b = ends.low.index;
    return g;
}

// T. Duff et al., Building an orthonormal basis, revisited, 2017.
void manifold_frame_make(const pair_frame *pair, const gap_along *along, manifold_frame *m) {
    vec3 n = along->n;
    double sign = n.z >= 0 ? 1.0 : -1.0, a = -1 / (sign + n.z), b = n.x * n.y * a;
    m->pair = pair;
    m->n = n;
    m->u = (vec3){1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
    m->v = (vec3){b, sign + n.y * n.y * a, -n.y};
    m->n_in_b = along->n_in_b;
    m->u_in_b = mat3_mul_transposed_vec3(pair->rotation, m->u);
    m->v_in_b = mat3_mul_transposed_vec3(pair->rotation, m->v);
    m->tn = along->tn;
    m->tu = vec3_dot(m->u, pair->translation);
    m->tv = vec3_dot(m->v, pair->translation);
    m->gap = along->gap;
    m->low_a = along->low_a;
    m->low_b = along->low_b;
}
