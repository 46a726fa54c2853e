// The step of GJK's simplex: the vector kernel against its scalar twin, bit for bit; and the twin against the
// definition: the distance along its direction is that of the nearest of all faces, edges and corners, each by its own
// formula in long double. Tolerance 1e-9 of the size: what doubles leave of simplices that are not slivers (others are
// not asked).
#include "simd/corner.h"

#include "check.h"

typedef long double real;
typedef struct point {
    real x, y, z;
} point;

static point sub(point a, point b) { return (point){a.x - b.x, a.y - b.y, a.z - b.z}; }
static real dot(point a, point b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static point cross(point a, point b) {
    return (point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static point along(point a, point e, real t) { return (point){a.x + t * e.x, a.y + t * e.y, a.z + t * e.z}; }

/// The segment's point nearest to the origin.
static point nearest_of_segment(point a, point b) {
    point e = sub(b, a);
    real t = -dot(a, e) / dot(e, e);
    return t <= 0 ? a : t >= 1 ? b : along(a, e, t);
}

/// The triangle's point nearest to the origin: the foot on its plane if it is inside, else on an edge.
static point nearest_of_triangle(point a, point b, point c) {
    point n = cross(sub(b, a), sub(c, a)), foot = along((point){0, 0, 0}, n, dot(n, a) / dot(n, n));
    real u = dot(n, cross(sub(b, foot), sub(c, foot))), v = dot(n, cross(sub(c, foot), sub(a, foot)));
    real w = dot(n, cross(sub(a, foot), sub(b, foot)));
    if (u >= 0 && v >= 0 && w >= 0) return foot;
    point edge[3] = {nearest_of_segment(a, b), nearest_of_segment(b, c), nearest_of_segment(c, a)};
    int best = 0;
    for (int i = 1; i < 3; i++)
        if (dot(edge[i], edge[i]) < dot(edge[best], edge[best])) best = i;
    return edge[best];
}

static int is_inside(const point *p) {
    for (int i = 0; i < 4; i++) {
        point a = p[(i + 1) % 4], n = cross(sub(p[(i + 2) % 4], a), sub(p[(i + 3) % 4], a));
        if ((dot(n, sub(p[i], a)) > 0) != (-dot(n, a) > 0)) return 0;
    }
    return 1;
}

static point random_point(uint64_t *s) {
    return (point){random_uniform(s, -1, 1), random_uniform(s, -1, 1), random_uniform(s, -1, 1)};
}

static int same_bits(const corner_step *a, const corner_step *b) {
    double d[6] = {a->x, a->y, a->z, b->x, b->y, b->z};
    return memcmp(d, d + 3, sizeof(double) * 3) == 0 && (a->square == b->square || isnan(a->square)) &&
           a->kept == b->kept && a->is_inside == b->is_inside && a->is_sliver == b->is_sliver;
}

static corner_step step(const corner_lanes *old, unsigned valid, point a) {
    vec3 w = {(double)a.x, (double)a.y, (double)a.z};
    corner_step twin = simd_step_from_corner_scalar(old, valid, w), s = simd_step_from_corner(old, valid, &w);
    CHECK(same_bits(&s, &twin));
    return s;
}

static void set_lane(corner_lanes *old, int i, point p) {
    old->x[i] = (double)p.x;
    old->y[i] = (double)p.y;
    old->z[i] = (double)p.z;
}

/// The old corners of the lanes in valid, whose nearest point is theirs alone, and a new one beyond it.
static long check_step(uint64_t *s, unsigned valid) {
    corner_lanes old;
    point p[4], v = {0, 0, 0};
    int count = 0;
    for (int i = 0; i < 4; i++) set_lane(&old, i, random_point(s));
    for (int i = 0; i < 3; i++)
        if (valid >> i & 1) p[count++] = (point){old.x[i], old.y[i], old.z[i]};
    if (count == 1) v = p[0];
    if (count == 2) v = nearest_of_segment(p[0], p[1]);
    if (count == 3) v = nearest_of_triangle(p[0], p[1], p[2]);
    // Inside: no corner or edge alone is as near.
    for (int i = 0; i < count; i++) {
        point edge = count == 3 ? nearest_of_segment(p[i], p[(i + 1) % 3]) : p[i];
        if (count > 1 && dot(edge, edge) < dot(v, v) * 1.0001L) return 0;
    }
    point a = random_point(s);
    if (!(dot(a, v) < 0.999L * dot(v, v))) return 0;
    p[count] = a;
    corner_step x = step(&old, valid, a);
    if (x.is_sliver) return 0;
    if (count == 3 && is_inside(p)) {
        CHECK(x.is_inside);
        return 1;
    }
    // The nearest of all triangles of the simplex; of fewer corners, of the segment.
    point best = count == 1 ? nearest_of_segment(p[0], a) : nearest_of_triangle(p[0], p[1], a);
    for (int i = 1; i < 3 && count == 3; i++) {
        point other = nearest_of_triangle(p[i], p[(i + 1) % 3], a);
        if (dot(other, other) < dot(best, best)) best = other;
    }
    point n = {x.x, x.y, x.z};
    CHECK(!x.is_inside);
    CHECK_NEAR(dot(n, a) / sqrtl(dot(n, n)), sqrtl(dot(best, best)), 1e-9);
    // The corners that stay are on the plane through the nearest point.
    for (int i = 0; i < 3; i++)
        if (x.kept >> i & 1) {
            CHECK(valid >> i & 1);
            CHECK_NEAR(dot(n, (point){old.x[i], old.y[i], old.z[i]}) / sqrtl(dot(n, n)), dot(n, a) / sqrtl(dot(n, n)),
                       1e-9);
        }
    return 1;
}

/// Degenerate simplices on a small grid, at several scales: the same bits, and no lane that is not there.
static void check_grid(uint64_t *s, double scale) {
    corner_lanes old;
    for (int i = 0; i < 4; i++)
        set_lane(&old, i,
                 (point){scale * ((double)(random_next(s) % 3) - 1), scale * ((double)(random_next(s) % 3) - 1),
                         scale * ((double)(random_next(s) % 3) - 1)});
    point a = {scale * ((double)(random_next(s) % 3) - 1), scale * ((double)(random_next(s) % 3) - 1), scale};
    for (unsigned valid = 1; valid < 8; valid++) {
        corner_step x = step(&old, valid, a);
        CHECK((x.kept & ~valid) == 0 && x.kept != 7);
    }
}

int main(void) {
    uint64_t s = 5;
    for (unsigned valid = 1; valid < 8; valid++) {
        long checked = 0;
        for (int i = 0; i < 60000; i++) checked += check_step(&s, valid);
        CHECK_LE(500, checked);
    }
    for (int i = 0; i < 3000; i++)
        for (int k = -1; k < 2; k++) check_grid(&s, k == 0 ? 1 : k < 0 ? 0x1p-300 : 0x1p150);
    return check_end();
}
