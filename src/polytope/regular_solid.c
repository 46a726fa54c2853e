// The hull and the measures of a regular prism or pyramid.
//
// Theorem. In units of corner 0 as complex numbers, let corners z_0 = 1, z_1, ..., z_(n-1) have |z_(i+1) - z_1 z_i| <=
// d all around, with z_n = z_0, ||z_1| - 1| <= d, n d <= 1e-3, and let z_1 be nearer to w = exp(2 pi i / n) than pi /
// n. Then |z_i - w^i| <= 2.1 n d.
//
// Proof. No power of |z_1| up to n exceeds 1 + 2 n d, so |z_i - z_1^i| <= 1.01 i d by induction, and |1 - z_1^n|
// <= 1.01 n d. So z_1 is within 1.02 d of a root of unity, which is w as all others are farther away than pi / n, and
// z_1^i within 1.03 i d of w^i.
//
// Here d = 144 u, u = 2^-53: a coordinate is tested with 96 u, its rounding is 5 u. So corners are off by less than
// 2^9 n u = 2^-44 n, at most 2^-32. The turn of a regular polygon of 4096 sides at a corner, the product of two sides
// and the sine, exceeds 2000 times what that changes, so the ring is strictly convex and goes around once: every vertex
// is extreme, the ends are exactly flat, the sides of a prism are rectangles, and no two facets are near one plane.
//
// Regular polygons: half of the corners' distance from each other is at most half of the inner radius (n = 3), so the
// polygon of the corners lies in the regular one enlarged by 1 + 2.1 e for an error e, and the other way around.
//
// The ends are cut in a zigzag, 0, 1, n - 1, 2, n - 2, ...: three corners in a row make a triangle, so that no vertex
// of a prism has more than seven neighbors.
#include "polytope/regular_solid.h"

#include "linear/vec3.h"
#include "polytope/closed_form.h"

#define RING_ERROR (96 * 0x1p-53)

// ---- which bodies they are

// 1 if corner i + 1 is corner i, turned as corner 1 is turned against corner 0.
static int is_turned(vec3 first, vec3 second, vec3 a, vec3 b, double most) {
    double x = (b.x * first.x - b.y * first.y) - (a.x * second.x - a.y * second.y);
    double y = (b.x * first.y + b.y * first.x) - (a.x * second.y + a.y * second.x);
    return fabs(x) <= most && fabs(y) <= most && b.z == a.z;
}

// Corner 1 against the one of a regular polygon; the other corners that the theorem leaves are 2 pi / n away from it.
static int is_next_corner(const regular_solid *s, vec3 first, vec3 second) {
    double angle = 6.283185307179586 / s->sides, c = cos(angle), t = sin(angle);
    double x = second.x - (c * first.x - t * first.y), y = second.y - (c * first.y + t * first.x);
    return x * x + y * y < 0.25 * (angle * angle) * s->radius_squared;
}

static int is_ring(const double *vertices, const regular_solid *s) {
    vec3 first = vec3_at(vertices, 0), second = vec3_at(vertices, 1);
    double most = RING_ERROR * s->radius_squared;
    if (!(fabs((second.x * second.x + second.y * second.y) - s->radius_squared) <= most)) return 0;
    for (uint32_t i = 0; i < s->sides; i++) {
        vec3 a = vec3_at(vertices, i), b = vec3_at(vertices, regular_solid_get_next(s, i));
        if (!is_turned(first, second, a, b, most)) return 0;
    }
    return is_next_corner(s, first, second);
}

// 1 if the point is `by` above the corner.
static int is_above(vec3 corner, vec3 point, double by) {
    return point.x == corner.x && point.y == corner.y && corner.z == -by && point.z == by;
}

// 1 if kind, number of sides and size may be those of such a body.
static int is_promising(const double *vertices, size_t count, regular_solid *s) {
    if (count < 4 || count > 2 * (size_t)REGULAR_SIDES_MOST) return 0;
    vec3 first = vec3_at(vertices, 0), last = vec3_at(vertices, count - 1);
    double h = s->half_length = -first.z, square = s->radius_squared = first.x * first.x + first.y * first.y;
    s->is_prism = !(last.x == 0 && last.y == 0);
    if (s->is_prism ? count % 2 || !is_above(first, vec3_at(vertices, count / 2), h) : last.z != h) return 0;
    s->sides = (uint32_t)(s->is_prism ? count / 2 : count - 1);
    double most = max2(h, sqrt(square)), least = 0x1p-18 * most;
    return s->sides >= 3 && s->sides <= REGULAR_SIDES_MOST && most >= 0x1p-200 && most <= OVOID_LENGTH_MAX / 2 &&
           h >= least && square >= least * least;
}

int regular_solid_find(const double *vertices, size_t count, regular_solid *solid) {
    regular_solid s;
    if (!is_promising(vertices, count, &s) || !is_ring(vertices, &s)) return 0;
    for (uint32_t i = 0; i < s.sides && s.is_prism; i++)
        if (!is_above(vec3_at(vertices, i), vec3_at(vertices, s.sides + i), s.half_length)) return 0;
    double x = (vertices[0] + vertices[3]) / 2, y = (vertices[1] + vertices[4]) / 2;
    s.apothem_squared = x * x + y * y;
    *solid = s;
    return 1;
}

// ---- triangles and adjacency

// The corner at a place of the zigzag 0, 1, n - 1, 2, n - 2, ...
static uint32_t get_corner(const regular_solid *s, uint32_t place) {
    return place == 0 ? 0 : place % 2 ? (place + 1) / 2 : s->sides - place / 2;
}

// The triangles of an end whose first corner is `first`, counter-clockwise as seen from above, or from below.
static uint32_t *fill_end(const regular_solid *s, uint32_t first, int is_above, uint32_t *to) {
    uint32_t a = first, b = first + 1;
    for (uint32_t place = 2; place < s->sides; place++) {
        uint32_t c = first + get_corner(s, place);
        to = (place % 2 == 0) == is_above ? closed_form_put_triangle(to, a, b, c)
                                          : closed_form_put_triangle(to, a, c, b);
        a = b, b = c;
    }
    return to;
}

void regular_solid_fill_triangles(const regular_solid *s, uint32_t *triangles, uint32_t *facets) {
    uint32_t n = s->sides, each = 1 + (uint32_t)s->is_prism, at = 0;
    for (uint32_t i = 0; i < n; i++) {
        uint32_t next = regular_solid_get_next(s, i), above = regular_solid_get_above(s, next);
        triangles = closed_form_put_triangle(triangles, i, next, above);
        if (s->is_prism) triangles = closed_form_put_triangle(triangles, i, above, n + i);
    }
    triangles = fill_end(s, 0, 0, triangles);
    if (s->is_prism) (void)fill_end(s, n, 1, triangles);
    for (; at < each * n; at++) facets[at] = at / each;
    for (; at < regular_solid_count_triangles(s); at++) facets[at] = n + (at >= (each + 1) * n - 2);
}

static uint32_t *put_ascending(uint32_t *to, uint32_t a, uint32_t b) {
    to[0] = a < b ? a : b, to[1] = a < b ? b : a;
    return to + 2;
}

// Writes the corners that an end's triangles join to corner i, ascending: those within two places of the zigzag, at
// whose end there are fewer.
static uint32_t *fill_joined(const regular_solid *s, uint32_t i, uint32_t *to) {
    uint32_t n = s->sides, mirrored = n - i;
    if (i == 0) return put_ascending(to, 1, n - 1);
    if (i <= mirrored) {
        *to++ = i - 1;
        if (2 * i + 1 < n) *to++ = i + 1;
        if (2 * i < n) *to++ = mirrored;
        if (i > 1) *to++ = mirrored + 1;
        return to;
    }
    if (mirrored == 1) *to++ = 0;
    *to++ = mirrored;
    if (2 * mirrored + 1 < n) *to++ = mirrored + 1;
    if (2 * mirrored + 2 < n) *to++ = i - 1;
    if (mirrored > 1) *to++ = i + 1;
    return to;
}

// The neighbors of the upper corner over corner i: two below, and those over the lower corner's.
static uint32_t *fill_upper(const regular_solid *s, uint32_t i, const uint32_t *joined, uint32_t *to) {
    to = put_ascending(to, i, i > 0 ? i - 1 : s->sides - 1);
    for (; *joined < s->sides; joined++) *to++ = s->sides + *joined;
    return to;
}

void regular_solid_fill_neighbors(const regular_solid *s, uint32_t *starts, uint32_t *neighbors) {
    uint32_t n = s->sides, *to = neighbors;
    for (uint32_t i = 0; i < n; i++) {
        starts[i] = (uint32_t)(to - neighbors);
        to = fill_joined(s, i, to);
        if (s->is_prism)
            to = put_ascending(to, n + i, n + regular_solid_get_next(s, i));
        else
            *to++ = n;
    }
    for (uint32_t i = 0; i < n && s->is_prism; i++) {
        starts[n + i] = (uint32_t)(to - neighbors);
        to = fill_upper(s, i, neighbors + starts[i], to);
    }
    if (!s->is_prism) starts[n] = (uint32_t)(to - neighbors);
    for (uint32_t i = 0; i < n && !s->is_prism; i++) *to++ = i;
    starts[s->is_prism ? 2 * n : n + 1] = (uint32_t)(to - neighbors);
}

// ---- planes and measures

// A side's vector area over its width: from the ring's edge d from a to b, and the way up from a.
static vec3 compute_upright(const regular_solid *s, vec3 a, vec3 d) {
    double h = 2 * s->half_length;
    return s->is_prism ? (vec3){d.y, -d.x, 0} : (vec3){h * d.y, -(h * d.x), a.x * d.y - a.y * d.x};
}

void regular_solid_fill_planes(const regular_solid *s, const double *vertices, ovoid_plane *planes) {
    uint32_t n = s->sides;
    for (uint32_t i = 0; i < n; i++) {
        vec3 a = vec3_at(vertices, i), b = vec3_at(vertices, regular_solid_get_next(s, i));
        vec3 normal = vec3_unit(compute_upright(s, a, vec3_sub(b, a)));
        double offset = max2(vec3_dot(normal, a), vec3_dot(normal, b));
        if (!s->is_prism) offset = max2(offset, normal.z * s->half_length);
        planes[i] = (ovoid_plane){vec3_clear_signs(normal), offset};
    }
    planes[n] = (ovoid_plane){{0, 0, -1}, s->half_length};
    if (s->is_prism) planes[n + 1] = (ovoid_plane){{0, 0, 1}, s->half_length};
}

// Sums over the triangles from the axis to the sides of the ring.
typedef struct ring_sums {
    double area;  // of the polygon
    double polar; // the integral of x^2 + y^2 over it
    double sides; // areas of the side facets
} ring_sums;

static ring_sums compute_sums(const regular_solid *s, const double *vertices) {
    ring_sums sums = {0, 0, 0};
    for (uint32_t i = 0; i < s->sides; i++) {
        vec3 a = vec3_at(vertices, i), b = vec3_at(vertices, regular_solid_get_next(s, i));
        double part = a.x * b.y - a.y * b.x, square = a.x * (a.x + b.x) + b.x * b.x;
        square += a.y * (a.y + b.y) + b.y * b.y;
        sums.area += part / 2;
        sums.polar += part * square / 12;
        sums.sides += vec3_norm(compute_upright(s, a, vec3_sub(b, a)));
    }
    sums.sides *= s->is_prism ? 2 * s->half_length : 0.5;
    return sums;
}

// A pyramid's sections shrink evenly to the apex: with t from 1 to 0 over its height 2 h, areas as t^2 and polar
// moments as t^4, so its mean is a quarter up and its variance along z 3 / 80 of the squared height.
ovoid_measures regular_solid_compute_measures(const regular_solid *s, const double *vertices) {
    ring_sums sums = compute_sums(s, vertices);
    double h = s->half_length, length = 2 * h, volume = sums.area * length / (s->is_prism ? 1 : 3);
    double along = volume * (h * h) * (s->is_prism ? 1.0 / 3 : 0.15), around = sums.polar * length;
    if (!s->is_prism) around /= 5;
    ovoid_measures m = {.volume = volume, .area = sums.sides + sums.area * (1 + s->is_prism)};
    m.inertia.xx = m.inertia.yy = around / 2 + along;
    m.inertia.zz = around;
    if (s->is_prism) return m;
    m.centroid.z = -h / 2;
    // The sphere through ring and apex, or the ring's own if that is lower.
    m.sphere_center.z = s->radius_squared < length * length ? -s->radius_squared / (4 * h) : -h;
    return m;
}
