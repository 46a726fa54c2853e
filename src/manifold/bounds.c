// Upper bounds of the signed distance that need no search.
//
// Theorem (frustum). Let K be the difference of the cores, B - A. Let F be a convex polygon in K, across n at n.x = -h,
// that contains the foot of the origin: F = { o_e.x <= p_e } with all p_e >= 0, e its edges, o_e unit vectors across n.
// Let c be a point and the ball of radius r around it in K, and s >= 0 with s |x| <= r for all x of F (measured from
// the foot). Then T = c + s F is in K, and the hull of F and T is a frustum with parallel edges: it is the intersection
// of -h <= n.x <= n.c and one half-space for each e, whose boundary passes at the distance
//   (p_e n.c + q_e h) / sqrt((q_e - p_e)^2 + (n.c + h)^2),  q_e = o_e.c + s p_e,
// from the origin. So the ball around the origin of the least of h, n.c and these distances is in K: the depth is at
// least that. c is the difference of the centres of the inner ellipsoids, r the sum of their least radii.
//
// F is one of these. Facets: the difference of both patches. If these are tilted, so that it spans the heights from -h'
// to -h, each of its points is moved toward c until it is at -h; it moves across n by at most
//   tau = (h' - h) / (n.c + h') (|c| + reach),
// so the polygon of all points that are deeper than tau inside of the difference's edges is in K. A facet and a vertex:
// as above where one patch is a vertex. Edges: the parallelogram of both edges.
//
// Rounding: the computed corners are within `check` of points of the cores, and what is computed of them is off by a
// few u of the size; p_e less both, and the result less both, is a bound of the exact depth.
#include "manifold/manifold.h"

#include "linear/rotation.h"
#include "simd/box8.h"

// A frustum of which sides are added.
typedef struct frustum {
    double cx, cy, cz; ///< the point above
    double h, s;       ///< as in the theorem
    double inset;      ///< each p_e is less by this
    double depth;      ///< the bound so far; negative: there is none
    double least;      ///< a bound below it is of no use
    double far_square; ///< a side whose distance has a smaller square is nearer than that
} frustum;

// Squares are off by a few roundings.
static frustum make_frustum(double least) {
    return (frustum){.least = least, .far_square = least > 0 ? least * least * (1 - 1e-9) : 0};
}

static int is_of_use(const frustum *f) { return !(f->depth < f->least); }

static void add_side(frustum *f, double ox, double oy, double p) {
    p -= f->inset;
    double q = (ox * f->cx + oy * f->cy) + f->s * p, rise = f->cz + f->h;
    double above = p * f->cz + q * f->h, square = (q - p) * (q - p) + rise * rise;
    double distance = -1;
    if (p >= 0 && above * above >= f->far_square * square) distance = above / sqrt(square) * (1 - 16 * ROUNDING);
    f->depth = min2(f->depth, distance);
}

// The sides of a patch, with the distances to their inner sides of what is opposite. sign: -1 for those of B. Edges of
// no length are no sides, and of a segment its ends are none.
static void add_sides(frustum *f, const manifold_patch *p, const double *distance, double sign) {
    for (uint32_t i = 0; i < p->at.count && p->at.count > 1 && is_of_use(f); i++)
        if (p->at.side_x[i] != 0 || p->at.side_y[i] != 0)
            add_side(f, sign * p->at.side_x[i], sign * p->at.side_y[i], distance[i]);
}

// The largest distance of a patch's corners from a place.
static double get_reach(const manifold_patch *p, double x, double y) {
    double most = 0;
    for (uint32_t i = 0; i < p->at.count; i++) {
        double dx = p->at.x[i] - x, dy = p->at.y[i] - y;
        most = max2(most, dx * dx + dy * dy);
    }
    return sqrt(most);
}

typedef struct range {
    double low, high;
} range;
static range get_range(const manifold_patch *p) {
    range r = {p->at.z[0], p->at.z[0]};
    for (uint32_t i = 1; i < p->at.count; i++) r.low = min2(r.low, p->at.z[i]), r.high = max2(r.high, p->at.z[i]);
    return r;
}

// The point above; returns the radius of the ball around it.
static double set_top(frustum *f, const manifold_frame *m) {
    const ovoid_shape *a = m->pair->a, *b = m->pair->b;
    vec3 p = a->inner.center, q = b->inner.center;
    f->cx = vec3_dot(m->u_in_b, q) + m->tu - vec3_dot(m->u, p);
    f->cy = vec3_dot(m->v_in_b, q) + m->tv - vec3_dot(m->v, p);
    f->cz = vec3_dot(m->n_in_b, q) + m->tn - vec3_dot(m->n, p);
    return a->inside.least + b->inside.least;
}

// The rounding of what is computed here of corners that are computed.
static double get_pad(const manifold_frame *m) { return m->pair->check + 64 * ROUNDING * m->pair->size; }

// Of both patches: the heights of the lowest and the highest point of their difference are -lowest and -h.
typedef struct slab {
    double h, lowest;
} slab;

// 1 if the slab is below the origin, by the least depth that is of use.
static int is_deep(const slab *s, double least) { return s->h > 0 && !(s->h < least); }

// The frustum of a slab that is deep, whose points are within the reach of one another across n. 0 if there is none.
static int start(frustum *f, const manifold_frame *m, const slab *s, double reach) {
    double radius = set_top(f, m);
    f->h = s->h;
    f->depth = min2(f->h, f->cz);
    if (!(f->cz > 0) || !is_of_use(f)) return 0;
    f->inset = get_pad(m);
    if (s->lowest > s->h)
        f->inset += (s->lowest - s->h) / (f->cz + s->lowest) * (sqrt(f->cx * f->cx + f->cy * f->cy) + reach);
    f->s = reach > 0 ? min2(1, radius / (reach * (1 + 16 * ROUNDING))) : 1;
    return 1;
}

static double prove_by_patches(const manifold_state *state, double least) {
    const manifold_frame *m = &state->frame;
    const manifold_patch *a = &state->a, *b = &state->b;
    frustum f = make_frustum(least);
    range za = get_range(a), zb = get_range(b);
    const slab s = {za.low - zb.high, za.high - zb.low};
    if (!is_deep(&s, least) || (a->at.count < 3 && b->at.count < 3 && a->at.count + b->at.count < 4)) return 0;
    double reach = get_reach(a, a->at.x[0], a->at.y[0]) + get_reach(b, a->at.x[0], a->at.y[0]);
    if (!start(&f, m, &s, reach)) return 0;
    add_sides(&f, a, state->to_a.most, 1);
    add_sides(&f, b, state->to_b.most, -1);
    return f.depth - get_pad(m);
}

// 1 if a polygon is too small for the least depth. The theorem's bounds are at least r only if p (n.c + s h) + h o.c >=
// r (n.c + h) for each edge. The sum over the edges, each times its length, has no o.c, as a polygon is closed: twice
// the area is at least r times the perimeter, which is at least the circle's of that area. So the area is at least pi
// r^2.
static int is_small(const manifold_patch *p, double least) {
    const double *x = p->at.x, *y = p->at.y, most = max2(least, 0);
    double area = 0;
    for (uint32_t i = 1; i + 1 < p->at.count; i++)
        area += (x[i] - *x) * (y[i + 1] - *y) - (y[i] - *y) * (x[i + 1] - *x);
    return fabs(area) < 6.28 * most * most;
}

// A facet of one body that makes the axis, and the other's vertex that is extreme. sign: -1 for a facet of B.
static double prove_by_facet(const manifold_state *state, double sign, double least) {
    const manifold_frame *m = &state->frame;
    const manifold_patch *p = sign > 0 ? &state->a : &state->b;
    if (p->at.count < 3 || is_small(p, least)) return 0;
    vec3 vertex = sign > 0 ? frame_place_b(m, m->low_b) : frame_place_a(m, m->low_a);
    frustum f = make_frustum(least);
    range z = get_range(p);
    const slab s = {sign > 0 ? z.low - vertex.z : vertex.z - z.high, sign > 0 ? z.high - vertex.z : vertex.z - z.low};
    double distance[PATCH_CORNERS];
    if (!is_deep(&s, least) || !start(&f, m, &s, get_reach(p, vertex.x, vertex.y))) return 0;
    for (uint32_t i = 0; i < p->at.count; i++) distance[i] = patch_get_side(p, i, vertex.x, vertex.y);
    add_sides(&f, p, distance, sign);
    return f.depth - get_pad(m);
}

// An edge across the normal.
typedef struct segment {
    vec3 p, q;
    double dx, dy, square; ///< from p to q, and the square of its length
    double out_x, out_y;   ///< unit, orthogonal to it; zero if it has no length
} segment;

static segment make_segment(vec3 p, vec3 q) {
    double dx = q.x - p.x, dy = q.y - p.y;
    return (segment){p, q, dx, dy, dx * dx + dy * dy, 0, 0};
}

static void set_out(segment *s) {
    double scale = s->square > 0 ? 1 / sqrt(s->square) : 0;
    s->out_x = -s->dy * scale;
    s->out_y = s->dx * scale;
}

// 1 if the parallelogram of two edges is too narrow for the least depth. Of opposite sides o and -o let p and p' be the
// distances of the foot. Both bounds of the theorem are at least r only if (p + p') (n.c + s h) >= 2 r (n.c + h), which
// their sum shows, as the root is at least n.c + h; so only if the width p + p' is at least 2 r. The widths are the
// area over the length of one edge and over that of the other.
static int is_narrow(const segment *a, const segment *b, double least) {
    double area = a->dx * b->dy - a->dy * b->dx, width = 2 * max2(least, 0);
    return area * area < width * width * max2(a->square, b->square) * (1 - 1e-9);
}

// Both sides of a segment, with the distances to them of what is opposite.
static void add_segment(frustum *f, const segment *s, const segment *other, double sign) {
    double x = s->out_x, y = s->out_y, at = x * s->p.x + y * s->p.y;
    double p = (x * other->p.x + y * other->p.y) - at, q = (x * other->q.x + y * other->q.y) - at;
    if (!(x != 0 || y != 0)) return;
    add_side(f, sign * x, sign * y, max2(p, q));
    add_side(f, -sign * x, -sign * y, max2(-p, -q));
}

static double get_distance(vec3 p, vec3 from) {
    double dx = p.x - from.x, dy = p.y - from.y;
    return sqrt(dx * dx + dy * dy);
}

static double prove_by_edges(const manifold_frame *m, const manifold_axis *axis, double least) {
    frustum f = make_frustum(least);
    edge_ends i = shape_get_ends(m->pair->a, feature_get_index(axis->a)),
              j = shape_get_ends(m->pair->b, feature_get_index(axis->b));
    segment a = make_segment(frame_place_a(m, i.from), frame_place_a(m, i.to)),
            b = make_segment(frame_place_b(m, j.from), frame_place_b(m, j.to));
    const slab s = {min2(a.p.z, a.q.z) - max2(b.p.z, b.q.z), max2(a.p.z, a.q.z) - min2(b.p.z, b.q.z)};
    if (!is_deep(&s, least) || is_narrow(&a, &b, least)) return 0;
    set_out(&a);
    set_out(&b);
    double reach = get_distance(a.q, a.p) + max2(get_distance(b.p, a.p), get_distance(b.q, a.p));
    if (!start(&f, m, &s, reach)) return 0;
    add_segment(&f, &a, &b, 1);
    if (is_of_use(&f)) add_segment(&f, &b, &a, -1);
    return f.depth - get_pad(m);
}

// By edges first where they make the axis: the facets beside them are tilted.
double manifold_prove_depth(const manifold_state *s, const manifold_axis *axis, const depth_demand *d) {
    double depth = 0;
    if (axis->kind == OVOID_MANIFOLD_EDGES) depth = prove_by_edges(&s->frame, axis, d->least);
    if (depth >= d->enough) return depth;
    depth = max2(depth, prove_by_patches(s, d->least));
    if (depth >= d->enough) return depth;
    if (axis->kind == OVOID_MANIFOLD_FACE_A) return max2(depth, prove_by_facet(s, 1, d->least));
    if (axis->kind == OVOID_MANIFOLD_FACE_B) return max2(depth, prove_by_facet(s, -1, d->least));
    return depth;
}

// ---- what an earlier search leaves ----

// B's rotation in the frame of A, and the place of B's sphere.
static vec3 get_place(const pair_frame *f) { return frame_b(f, f->b->center); }

void memory_set_search(ovoid_manifold_memory *m, const ovoid_pair *pair, const pair_frame *f, double upper) {
    ovoid_quat a = pair->pose_a.rotation, b = pair->pose_b.rotation;
    if (!quat_is_plain(quat_norm_squared(a))) a = quat_scaled(a);
    if (!quat_is_plain(quat_norm_squared(b))) b = quat_scaled(b);
    double scale = 1 / sqrt(quat_norm_squared(a) * quat_norm_squared(b));
    vec3 place = get_place(f);
    m->searched = box8_round_up(upper);
    m->pose[0] = (float)((a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z) * scale);
    m->pose[1] = (float)((a.w * b.x - a.x * b.w - a.y * b.z + a.z * b.y) * scale);
    m->pose[2] = (float)((a.w * b.y + a.x * b.z - a.y * b.w - a.z * b.x) * scale);
    m->pose[3] = (float)((a.w * b.z - a.x * b.y + a.y * b.x - a.z * b.w) * scale);
    m->pose[4] = (float)place.x;
    m->pose[5] = (float)place.y;
    m->pose[6] = (float)place.z;
    m->flags |= MANIFOLD_HAS_SEARCH;
}

// No point of B is farther from where it was than what its sphere's centre moved, and the sphere's radius times the
// norm of the difference of the rotations. Of that the singular values are v, v and 0: its Frobenius norm is root 2 v.
static double compute_motion(const ovoid_manifold_memory *m, const pair_frame *f) {
    const ovoid_quat q = {(double)m->pose[0], (double)m->pose[1], (double)m->pose[2], (double)m->pose[3]};
    double norm = quat_norm_squared(q);
    if (!(norm > 0.5 && norm < 2)) return INFINITY;
    mat3 r = quat_to_mat3(q);
    vec3 d0 = vec3_sub(f->rotation.r0, r.r0), d1 = vec3_sub(f->rotation.r1, r.r1), d2 = vec3_sub(f->rotation.r2, r.r2);
    double square = vec3_norm_squared(d0) + vec3_norm_squared(d1) + vec3_norm_squared(d2);
    vec3 was = {(double)m->pose[4], (double)m->pose[5], (double)m->pose[6]};
    return sqrt(square / 2) * f->b->reach + vec3_norm(vec3_sub(get_place(f), was));
}

double memory_compute_upper(const ovoid_manifold_memory *m, const pair_frame *f) {
    if (!(m->flags & MANIFOLD_HAS_SEARCH) || !isfinite(m->searched)) return INFINITY;
    // The pose at the search was rounded to floats: that is a motion too.
    double rounded = 0x1p-22 * (f->b->reach + vec3_norm(get_place(f)));
    double upper = (double)m->searched + compute_motion(m, f) + rounded + 2 * f->check;
    return upper == upper ? upper : INFINITY;
}
