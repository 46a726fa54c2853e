// Answers about solids. Theorem. The surfaces: each exclusion is a rectangle in the table of all pairs of triangles;
// along its normal all of its triangles of one body end before those of the other begin, by `lower` at least; with the
// deciding pair the rectangles cover the table, so no two triangles are nearer than the least bound. The bodies: if the
// surfaces are apart, each component of one lies completely inside or completely outside of the other body, so one of
// its points decides, by how often the other surface winds around it. Upper bounds of an overlap: it is at least as
// deep as its two triangles cross, or as the component's distance from the other surface; lower bounds: a translation
// along one direction separates all points of both.
//
// The winding number is counted along a ray from the point toward +x, in the frame of the body around it; if that meets
// an edge, along a ray of no symmetry.
#include "parts.h"
#include "shell.h"

#include <stdlib.h>

/// One body: triangles, or a shape as its triangle 0.
typedef struct side {
    const ovoid_body *of;
    const uint32_t *order; ///< NULL: a shape
    uint32_t count, place;
    uint32_t *corners; ///< three points of each triangle, in the caller's order; NULL: a shape
    const double *points;
    uint32_t point_count;
    body posed; ///< of the shape; of a solid with all points
    int is_closed;
} side;

typedef struct trial {
    pool *p;
    side a, b;
    const ovoid_body_answer *x;
    const ovoid_exclusion *items;
    size_t count;
    ovoid_error *error;
} trial;

static ovoid_code reject(const trial *t, const char *why) {
    return judge_reject(t->error, OVOID_ERROR_PROOF, "%s", why);
}

static ovoid_code reject_item(const trial *t, size_t i, const char *why) {
    (void)judge_reject(t->error, OVOID_ERROR_PROOF, "exclusion %zu %s", i, why);
    if (t->error) t->error->place = (int64_t)i;
    return OVOID_ERROR_PROOF;
}

// --- the sides

static ovoid_code read_side(pool *p, const ovoid_body *of, uint32_t triangle, side *s, ovoid_error *error) {
    *s = (side){.of = of, .count = 1};
    if (!of->shape == !of->solid)
        return judge_reject(error, OVOID_ERROR_ARGUMENT, "a body has neither a shape nor a solid, or both");
    if (!judge_is_pose_valid(&of->pose))
        return judge_reject(error, OVOID_ERROR_PROOF, "an answer for a pose that is none");
    if (of->shape) {
        s->posed = body_make(p, of->shape, &of->pose);
    } else {
        ovoid_solid_report r = ovoid_solid_get_report(of->solid);
        s->order = ovoid_solid_get_order(of->solid);
        s->count = (uint32_t)r.triangles;
        s->points = ovoid_solid_get_points(of->solid);
        s->point_count = (uint32_t)r.points;
        ovoid_polytope all = {.vertex_count = s->point_count, .vertices = s->points};
        s->posed = body_make_hull(p, &all, &of->pose);
        s->corners = judge_allocate(3 * (size_t)s->count, sizeof *s->corners);
        for (uint32_t i = 0; i < s->count; i++) ovoid_solid_get_triangle(of->solid, i, s->corners + 3 * (size_t)i);
        s->is_closed = judge_is_chain_closed(p, s->points, s->corners, s->count);
    }
    if (triangle >= s->count) return judge_reject(error, OVOID_ERROR_PROOF, "there is no triangle %u", triangle);
    if (s->order && !judge_is_order(s->order, s->count, triangle, &s->place))
        return judge_reject(error, OVOID_ERROR_PROOF, "the order does not name each triangle once");
    return OVOID_OK;
}

static ovoid_vec3 get_point(const side *s, uint32_t i) {
    const double *v = s->points + 3 * (size_t)i;
    return (ovoid_vec3){v[0], v[1], v[2]};
}

// --- the deciding pair

/// A triangle as a body, its corners in `room`.
static body make_leaf(pool *p, const side *s, uint32_t triangle, double room[9]) {
    static const uint32_t corners[3] = {0, 1, 2};
    if (!s->corners) return s->posed;
    for (int i = 0; i < 9; i++) room[i] = s->points[3 * (size_t)s->corners[3 * (size_t)triangle + i / 3] + i % 3];
    ovoid_polytope one = {.rank = 2, .vertex_count = 3, .vertices = room, .triangle_count = 1, .triangles = corners};
    return body_make_hull(p, &one, &s->of->pose);
}

static ovoid_code verify_leaves(judge *context, const trial *t, int points) {
    double room[2][9];
    posed s =
        posed_join(t->p, make_leaf(t->p, &t->a, t->x->part_a, room[0]), make_leaf(t->p, &t->b, t->x->part_b, room[1]));
    ovoid_answer own = t->x->deciding;
    // The tolerance of "touching" is relative to the bodies, whose triangles may be small, so it is not checked for the
    // pair of triangles.
    if (own.status == OVOID_TOUCHING) own.status = OVOID_UNDECIDED, own.limit = OVOID_LIMIT_PRECISION;
    ovoid_code code = judge_verify_posed(context, &s, &own, NULL, t->error);
    if (code != OVOID_OK || !points || t->x->deciding.status == OVOID_UNDECIDED) return code;
    return judge_verify_points_posed(&s, &t->x->deciding, t->error);
}

static ovoid_code verify_touching(const judge *context, const trial *t) {
    const ovoid_body_answer *x = t->x;
    ovoid_vec3 a = t->a.of->pose.position, b = t->b.of->pose.position;
    double radii = num_to_double(num_add(t->p, t->a.posed.radius, t->b.posed.radius));
    const posed both = posed_join(t->p, t->a.posed, t->b.posed);
    double size = t->a.posed.extent + t->b.posed.extent + radii + hypot(hypot(b.x - a.x, b.y - a.y), b.z - a.z);
    size += both.allowed;
    const ovoid_answer bodies = {.lower = x->lower, .upper = x->upper};
    return judge_verify_touching(context, &bodies, size, t->a.posed.reach + t->b.posed.reach, t->error);
}

// --- directions

/// The farthest point of the triangles at [first, end) along the direction (way 1) or against it (-1), times the body's
/// n.
static num find_reach(pool *p, const side *s, uint32_t first, uint32_t end, nvec n, int way) {
    if (!s->corners) return body_support(p, &s->posed, n, way);
    double *points = judge_allocate(9 * (size_t)(end - first), sizeof *points);
    body range = s->posed;
    range.polytope.vertices = points;
    range.polytope.vertex_count = 0;
    for (uint32_t place = first; place < end; place++)
        for (int i = 0; i < 3; i++) {
            ovoid_vec3 v = get_point(s, s->corners[3 * (size_t)s->order[place] + i]);
            double *to = points + 3 * (size_t)range.polytope.vertex_count++;
            to[0] = v.x, to[1] = v.y, to[2] = v.z;
        }
    num support = body_support(p, &range, n, way);
    free(points);
    return support;
}

/// 1 if the ranges of the exclusion are proven to be `lower` apart along its normal: k gap >= (lower + radii) k |n|.
static int is_shown(const trial *t, const ovoid_exclusion *e) {
    pool *p = t->p;
    if (!is_finite(e->normal) || !is_finite(e->normal_low) || !isfinite(e->lower)) return 0;
    nvec n = nvec_add(p, nvec_from(p, e->normal), nvec_from(p, e->normal_low));
    if (nvec_is_zero(n)) return 0;
    const body *a = &t->a.posed, *b = &t->b.posed;
    num top = find_reach(p, &t->a, e->first_a, e->end_a, n, 1),
        bottom = find_reach(p, &t->b, e->first_b, e->end_b, n, -1);
    num gap = num_sub(p, num_mul(p, bottom, a->n), num_mul(p, top, b->n)), one = number_from_integer(p, 1);
    num grown = num_add(p, num_add(p, a->radius, a->outside), num_add(p, b->radius, b->outside));
    num claimed = num_mul(p, num_add(p, number_from(p, e->lower), grown), num_mul(p, a->n, b->n));
    return num_compare_roots(p, claimed, nvec_norm_squared(p, n), gap, one) <= 0;
}

static ovoid_code verify_exclusions(const trial *t) {
    pair_table all = {t->a.count, t->b.count, t->a.place, t->b.place, t->items, t->count};
    uint32_t row, column;
    for (size_t i = 0; i < t->count; i++) {
        const ovoid_exclusion *e = &t->items[i];
        if (!(e->first_a < e->end_a && e->end_a <= t->a.count && e->first_b < e->end_b && e->end_b <= t->b.count))
            return reject_item(t, i, "names triangles that there are not");
        if (!(e->lower >= t->x->deciding.lower)) return reject_item(t, i, "is below the answer's lower bound");
    }
    if (!judge_is_covered(&all, &row, &column))
        return judge_reject(t->error, OVOID_ERROR_PROOF, "nothing excludes triangle %u of a and triangle %u of b",
                            t->a.order ? t->a.order[row] : row, t->b.order ? t->b.order[column] : column);
    for (size_t i = 0; i < t->count; i++) {
        size_t mark = pool_get_mark(t->p);
        int is = is_shown(t, &t->items[i]);
        pool_release(t->p, mark);
        if (!is) return reject_item(t, i, "is not shown by its normal");
    }
    return OVOID_OK;
}

// --- containment

/// The point x of a frame, `factor` times.
typedef struct scaled {
    nvec x;
    num factor;
} scaled;

/// A point of a body's component in the other body's frame: M'(n x - n position), M of the other, x in the world.
static scaled find_point(pool *p, const side *own, const side *other, ovoid_vec3 local) {
    nvec x = body_point(p, &own->posed, nvec_from(p, local));
    nvec from = nvec_scale(p, other->posed.position, own->posed.n);
    return (scaled){body_rotate_back(p, &other->posed, nvec_sub(p, x, from)), num_mul(p, own->posed.n, other->posed.n)};
}

/// The signed crossing of a ray with a triangle, corners from the ray's origin: 1, -1, 0; *ok = 0 if it meets an
/// edge's line or the origin is in the triangle's plane.
static int count_crossing(pool *p, nvec g, const nvec c[3], int *ok) {
    int s[3];
    for (int i = 0; i < 3; i++) s[i] = num_sign(nvec_det(p, g, c[i], c[(i + 1) % 3]));
    if (s[0] * s[1] < 0 || s[1] * s[2] < 0 || s[2] * s[0] < 0) return 0;
    int facing = num_sign(nvec_det(p, c[0], c[1], c[2]));
    if (!(s[0] && s[1] && s[2] && facing)) {
        // A triangle without area bounds nothing, whatever the ray.
        *ok &= nvec_is_zero(nvec_cross(p, nvec_sub(p, c[1], c[0]), nvec_sub(p, c[2], c[0])));
        return 0;
    }
    return facing == s[0] ? facing : 0;
}

/// 1 if all three have the sign, which is not 0.
static int are_beyond(num a, num b, num c) {
    int sign = num_sign(a);
    return sign != 0 && num_sign(b) == sign && num_sign(c) == sign;
}

/// How often the solid winds around the point, by one ray; is_axis: that ray is +x, and most triangles miss it.
static long count_winding(pool *p, const side *s, const scaled *at, ovoid_vec3 ray, int is_axis, int *ok) {
    nvec g = nvec_from(p, ray);
    long winding = 0;
    *ok = 1;
    for (uint32_t t = 0; t < s->count && *ok; t++) {
        size_t mark = pool_get_mark(p);
        nvec c[3];
        for (int i = 0; i < 3; i++) {
            nvec corner = nvec_from(p, get_point(s, s->corners[3 * (size_t)t + i]));
            c[i] = nvec_sub(p, nvec_scale(p, corner, at->factor), at->x);
        }
        int misses = is_axis && (are_beyond(c[0].y, c[1].y, c[2].y) || are_beyond(c[0].z, c[1].z, c[2].z));
        if (!misses) winding += count_crossing(p, g, c, ok);
        pool_release(p, mark);
    }
    return winding;
}

/// 1 if the other body winds around the point, 0 if not, -1 if undecided: the point is on its surface.
static int is_inside(const trial *t, const side *own, const side *other, ovoid_vec3 local) {
    static const ovoid_vec3 rays[] = {{1, 0, 0},         {1009, 2003, -3001}, {-4001, 907, 1301},
                                      {577, -2741, 991}, {-1511, -3307, 271}, {89, 233, 4657}};
    size_t mark = pool_get_mark(t->p);
    scaled at = find_point(t->p, own, other, local);
    int is = -1;
    for (size_t i = 0; i < sizeof rays / sizeof *rays && is < 0; i++) {
        int ok;
        long winding = count_winding(t->p, other, &at, rays[i], i == 0, &ok);
        if (ok) is = winding != 0;
    }
    pool_release(t->p, mark);
    return is;
}

static uint32_t find_root(uint32_t *parent, uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

/// A point of each component, in the order of the least point of each; returns their number. Freed by the caller.
static uint32_t find_components(const side *s, uint32_t **points) {
    uint32_t *parent = judge_allocate((size_t)s->point_count + 1, sizeof *parent), count = 0;
    for (uint32_t i = 0; i < s->point_count; i++) parent[i] = i;
    for (size_t i = 0; i < 3 * (size_t)s->count; i++) {
        uint32_t a = find_root(parent, s->corners[i]), b = find_root(parent, s->corners[i - i % 3]);
        parent[a > b ? a : b] = a > b ? b : a;
    }
    for (uint32_t i = 0; i < s->point_count; i++)
        if (parent[i] == i) parent[count++] = i;
    *points = parent;
    return count;
}

/// 1 if component `only` of own (any component if it is UINT32_MAX) is inside the other, 0 if none is, -1 if undecided;
/// -2: there is no such component.
static int has_inside(const trial *t, const side *own, const side *other, uint32_t only) {
    if (!other->is_closed) return 0;
    if (!own->corners) {
        const double *v = own->posed.polytope.vertices;
        if (only && only != UINT32_MAX) return -2;
        return is_inside(t, own, other, (ovoid_vec3){v[0], v[1], v[2]});
    }
    uint32_t *points, count = find_components(own, &points);
    int is = only != UINT32_MAX && only >= count ? -2 : 0;
    for (uint32_t i = 0; i < count && !is; i++)
        if (only == UINT32_MAX || only == i) is = is_inside(t, own, other, get_point(own, points[i]));
    free(points);
    return is;
}

// --- a common point

/// The number of triangles of a side; a shape's are in its body frame. corner: three points of one, relative to `at`.
static uint32_t count_triangles(const side *s) { return s->corners ? s->count : s->posed.polytope.triangle_count; }

static void get_triangle(pool *p, const side *s, const scaled *at, uint32_t t, nvec corner[3]) {
    for (int i = 0; i < 3; i++) {
        ovoid_vec3 v;
        if (s->corners) {
            v = get_point(s, s->corners[3 * (size_t)t + i]);
        } else {
            const ovoid_polytope *own = &s->posed.polytope;
            const double *x = own->vertices + 3 * (size_t)own->triangles[3 * (size_t)t + i];
            v = (ovoid_vec3){x[0], x[1], x[2]};
        }
        corner[i] = nvec_sub(p, nvec_scale(p, nvec_from(p, v), at->factor), at->x);
    }
}

/// 1 if all triangles are at least r from the origin of `at`; r in its units.
static int are_beyond_ball(pool *p, const side *s, const scaled *at, num r) {
    num square = num_mul(p, r, r);
    int ok = 1;
    for (uint32_t t = 0; t < count_triangles(s) && ok; t++) {
        size_t mark = pool_get_mark(p);
        nvec c[3];
        get_triangle(p, s, at, t, c);
        ok = triangle_is_farther(p, c[0], c[1], c[2], square);
        pool_release(p, mark);
    }
    return ok;
}

/// 1 if the side winds around the point; for a shape, which is convex, by one ray after another as for a solid.
static int covers(const trial *t, const side *s, const scaled *at) {
    static const ovoid_vec3 rays[] = {{1009, 2003, -3001}, {-4001, 907, 1301}, {577, -2741, 991}};
    if (s->corners ? !s->is_closed : s->posed.polytope.rank < 3) return 0;
    for (size_t i = 0; i < sizeof rays / sizeof *rays; i++) {
        long winding = 0;
        int ok = 1;
        for (uint32_t k = 0; k < count_triangles(s) && ok; k++) {
            size_t mark = pool_get_mark(t->p);
            nvec c[3];
            get_triangle(t->p, s, at, k, c);
            winding += count_crossing(t->p, nvec_from(t->p, rays[i]), c, &ok);
            pool_release(t->p, mark);
        }
        if (ok) return winding != 0;
    }
    return 0;
}

/// 1 if the side has the clearance r at the point: the ball of that radius lies in it; or, if r is below 0, it has a
/// point no farther than -r.
/// farther than -r.
static int has_clearance(const trial *t, const side *s, const scaled *at, num r) {
    pool *p = t->p;
    num core = num_mul(p, num_add(p, num_sub(p, r, s->posed.radius), s->posed.inside), at->factor);
    if (num_sign(core) <= 0) {
        num most = num_neg(p, core);
        if (covers(t, s, at)) return 1;
        if (count_triangles(s)) return !are_beyond_ball(p, s, at, most);
        const double *vertex = s->posed.polytope.vertices;
        if (!vertex) return 0;
        nvec v = nvec_from(p, (ovoid_vec3){vertex[0], vertex[1], vertex[2]});
        nvec d = nvec_sub(p, nvec_scale(p, v, at->factor), at->x);
        return num_compare(p, nvec_norm_squared(p, d), num_mul(p, most, most)) <= 0;
    }
    return covers(t, s, at) && are_beyond_ball(p, s, at, core);
}

/// The distance of the origin to a segment in doubles.
static double measure_segment(const double a[3], const double b[3]) {
    double along = 0, length = 0, square = 0;
    for (int k = 0; k < 3; k++) along -= a[k] * (b[k] - a[k]), length += (b[k] - a[k]) * (b[k] - a[k]);
    double at = length > 0 ? fmin(fmax(along / length, 0), 1) : 0;
    for (int k = 0; k < 3; k++) square += (a[k] + at * (b[k] - a[k])) * (a[k] + at * (b[k] - a[k]));
    return sqrt(square);
}

/// The distance of the origin to a triangle in doubles: to its plane if the foot is between its edges.
static double measure_triangle(double c[3][3]) {
    double n[3], foot[3], best = INFINITY, offset = 0, length = 0;
    int inner = 1;
    for (int k = 0; k < 3; k++) {
        int u = (k + 1) % 3, v = (k + 2) % 3;
        n[k] = (c[1][u] - c[0][u]) * (c[2][v] - c[0][v]) - (c[1][v] - c[0][v]) * (c[2][u] - c[0][u]);
        offset += n[k] * c[0][k];
        length += n[k] * n[k];
    }
    for (int k = 0; k < 3; k++) foot[k] = length > 0 ? n[k] * offset / length : 0;
    for (int i = 0; i < 3; i++) {
        const double *a = c[i], *b = c[(i + 1) % 3];
        double turn = 0;
        for (int k = 0; k < 3; k++) {
            int u = (k + 1) % 3, v = (k + 2) % 3;
            turn += n[k] * ((b[u] - a[u]) * (foot[v] - a[v]) - (b[v] - a[v]) * (foot[u] - a[u]));
        }
        inner &= turn > 0;
        best = fmin(best, measure_segment(a, b));
    }
    return inner && length > 0 ? fabs(offset) / sqrt(length) : best;
}

/// The distance of the point from the side's triangles, or its first vertex, in doubles: to divide a depth between the
/// sides.
static double measure_distance(const trial *t, const side *s, const scaled *at) {
    double factor = num_to_double(at->factor), best = INFINITY;
    for (uint32_t k = 0; k < count_triangles(s); k++) {
        size_t mark = pool_get_mark(t->p);
        nvec corner[3];
        double c[3][3];
        get_triangle(t->p, s, at, k, corner);
        for (int i = 0; i < 3; i++) {
            c[i][0] = num_to_double(corner[i].x) / factor;
            c[i][1] = num_to_double(corner[i].y) / factor;
            c[i][2] = num_to_double(corner[i].z) / factor;
        }
        best = fmin(best, measure_triangle(c));
        pool_release(t->p, mark);
    }
    return best < INFINITY ? best : 0;
}

/// The common point, given in a's frame, in the frame of a side; a shape's vertices are relative to its origin.
static scaled find_common(const trial *t, const side *s) {
    pool *p = t->p;
    nvec local = nvec_from(p, t->x->common);
    nvec own = nvec_sub(p, local, t->a.posed.origin);
    nvec from = nvec_sub(p, body_point(p, &t->a.posed, own), nvec_scale(p, s->posed.position, t->a.posed.n));
    scaled at = {body_rotate_back(p, &s->posed, from), num_mul(p, t->a.posed.n, s->posed.n)};
    at.x = nvec_sub(p, at.x, nvec_scale(p, s->posed.origin, at.factor));
    return at;
}

/// The clearance in doubles.
static double measure_clearance(const trial *t, const side *s, const scaled *at) {
    double distance = measure_distance(t, s, at),
           radius = num_to_double(num_sub(t->p, s->posed.radius, s->posed.inside));
    return (covers(t, s, at) ? distance : -distance) + radius;
}

static ovoid_code verify_common_point(const trial *t) {
    const ovoid_body_answer *x = t->x;
    const char *why = "the common point does not show the overlap";
    if (!is_finite(x->common)) return reject(t, why);
    scaled in_a = find_common(t, &t->a), in_b = find_common(t, &t->b);
    double a = measure_clearance(t, &t->a, &in_a), b = measure_clearance(t, &t->b, &in_b);
    // The clearance beyond the claim is divided between both sides in halves.
    num share = number_from(t->p, a - 0.5 * ((a + b) + x->upper));
    num rest = num_sub(t->p, number_from(t->p, -x->upper), share);
    return has_clearance(t, &t->a, &in_a, share) && has_clearance(t, &t->b, &in_b, rest) ? OVOID_OK : reject(t, why);
}

// --- the bodies

static ovoid_code verify_apart(const trial *t) {
    const ovoid_body_answer *x = t->x;
    if (!(x->lower > 0 && x->lower <= x->deciding.lower && x->upper >= x->deciding.upper) || x->inside)
        return reject(t, "the distance is not that of the surfaces");
    if (has_inside(t, &t->a, &t->b, UINT32_MAX) || has_inside(t, &t->b, &t->a, UINT32_MAX))
        return reject(t, "one body is inside of the other");
    return OVOID_OK;
}

static ovoid_code verify_overlap(const trial *t) {
    const ovoid_body_answer *x = t->x;
    if (!(x->upper < 0)) return reject(t, "an overlap whose bracket reaches 0");
    if (!x->inside)
        return x->deciding.upper < 0 && x->upper >= x->deciding.upper ? OVOID_OK
                                                                      : reject(t, "an overlap without a reason");
    if (x->inside == OVOID_BODY_COMMON_POINT) return verify_common_point(t);
    if (x->inside != OVOID_BODY_A_INSIDE && x->inside != OVOID_BODY_B_INSIDE)
        return reject(t, "an overlap without a reason");
    if (!(x->deciding.lower > 0 && x->upper >= -x->deciding.lower))
        return reject(t, "the surfaces are nearer than is claimed of what is inside");
    const side *own = x->inside == OVOID_BODY_A_INSIDE ? &t->a : &t->b, *other = own == &t->a ? &t->b : &t->a;
    return has_inside(t, own, other, x->component) == 1 ? OVOID_OK : reject(t, "what is said to be inside is not");
}

static ovoid_code verify_depth(const trial *t) {
    ovoid_exclusion all = {0, t->a.count, 0, t->b.count, t->x->parting, {0, 0, 0}, t->x->lower};
    if (t->x->lower == -INFINITY) return OVOID_OK;
    return is_shown(t, &all) ? OVOID_OK : reject(t, "the depth is not shown by its direction");
}

static ovoid_code verify_bodies(const judge *context, const trial *t) {
    const ovoid_body_answer *x = t->x;
    if (!(x->lower <= x->upper)) return reject(t, "the bracket is empty");
    if (x->status == OVOID_SEPARATED) return verify_apart(t);
    ovoid_code code = OVOID_OK;
    if (x->status == OVOID_OVERLAPPING)
        code = verify_overlap(t);
    else if (x->inside || !(x->lower <= 0 && x->upper >= 0 && x->upper >= x->deciding.upper))
        code = reject(t, "the status does not follow from the bracket");
    if (code == OVOID_OK && x->status == OVOID_TOUCHING) code = verify_touching(context, t);
    return code == OVOID_OK ? verify_depth(t) : code;
}

ovoid_code judge_verify_solid(judge *context, const ovoid_body_pair *pair, const ovoid_body_answer *answer,
                              const ovoid_exclusions *exclusions, int points, ovoid_error *error) {
    if (!context || !pair || !answer) return judge_reject(error, OVOID_ERROR_ARGUMENT, "a pointer is NULL");
    // A refusal claims nothing.
    if (answer->status == OVOID_UNDECIDED && answer->lower == -INFINITY && answer->upper == INFINITY) return OVOID_OK;
    if (exclusions && exclusions->count > exclusions->capacity)
        return judge_reject(error, OVOID_ERROR_PROOF, "%zu exclusions, but there was room for %zu", exclusions->count,
                            exclusions->capacity);
    size_t mark = pool_get_mark(context->p);
    trial t = {.p = context->p, .x = answer, .error = error};
    if (exclusions) t.items = exclusions->items, t.count = exclusions->count;
    ovoid_code code = read_side(t.p, &pair->a, answer->part_a, &t.a, error);
    if (code == OVOID_OK) code = read_side(t.p, &pair->b, answer->part_b, &t.b, error);
    if (code == OVOID_OK) code = verify_leaves(context, &t, points);
    if (code == OVOID_OK) code = verify_exclusions(&t);
    if (code == OVOID_OK) code = verify_bodies(context, &t);
    free(t.a.corners);
    free(t.b.corners);
    pool_release(context->p, mark);
    return code;
}
