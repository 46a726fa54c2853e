// Measurements of a pair in double-double.
#include "pair/fine.h"

#include "simd/support.h"

static dd3 scaled(dd3 v, double unit) { return (dd3){dd_scale(v.x, unit), dd_scale(v.y, unit), dd_scale(v.z, unit)}; }

int fine_make(const ovoid_pair *pair, fine_frame *f) {
    f->a = pair->shape_a;
    f->b = pair->shape_b;
    f->world_a = dd33_from_quat(pair->pose_a.rotation);
    f->world_b = dd33_from_quat(pair->pose_b.rotation);
    // Positions differ exactly, however far they are.
    vec3 a = pair->pose_a.position, b = pair->pose_b.position;
    dd3 apart = {two_sum(b.x, -a.x), two_sum(b.y, -a.y), two_sum(b.z, -a.z)};
    double hidden = 0;
    if (f->a->has_origin || f->b->has_origin) {
        dd3 origins = dd3_sub(dd33_mul_vec3(&f->world_b, f->b->origin), dd33_mul_vec3(&f->world_a, f->a->origin));
        apart = dd3_add(apart, origins);
        hidden = 0x1p-95 * (vec3_max_abs(f->a->origin) + vec3_max_abs(f->b->origin));
    }
    double size = f->a->span + f->b->span + f->a->lower_radius + f->b->lower_radius + vec3_norm(dd3_high(apart));
    if (!(hidden + OVOID_LENGTH_MIN <= 0x1p-60 * size)) return 0;
    int exponent;
    (void)frexp(size, &exponent);
    f->unit = ldexp(1, -exponent);
    f->apart = scaled(apart, f->unit);
    f->lower_radii = dd_scale(two_sum(f->a->lower_radius, f->b->lower_radius), f->unit);
    f->upper_radii = dd_scale(two_sum(f->a->upper_radius, f->b->upper_radius), f->unit);
    f->check = (FINE_CHECK * size + hidden) * f->unit;
    f->claim = 2 * f->check;
    return 1;
}

static dd3 vertex(const fine_frame *f, const ovoid_shape *shape, const dd33 *rotation, uint32_t i) {
    return dd33_mul_vec3(rotation, vec3_scale(shape_get_vertex(shape, i), f->unit));
}

dd3 fine_difference(const fine_frame *f, uint32_t a, uint32_t b) {
    return dd3_sub(dd3_add(vertex(f, f->b, &f->world_b, b), f->apart), vertex(f, f->a, &f->world_a, a));
}

// The vertex of largest m.v. A dot product of doubles is off by 4 u |m| |v|, the direction's rounding included.
static uint32_t find_extreme(const ovoid_shape *s, dd3 m, dd *largest) {
    vec3 n = dd3_high(m);
    const double *v = shape_vertices(s);
    simd_points points = shape_get_points(s);
    support_result top = simd_find_support(&points, &n);
    double near = top.value - 0x1p-49 * s->extent;
    uint32_t best = top.index;
    *largest = dd3_dot_vec3(m, vec3_at(v, best));
    for (uint32_t i = 0; i < s->vertex_count; i++) {
        if (!(vec3_dot(n, vec3_at(v, i)) >= near) || i == top.index) continue;
        dd value = dd3_dot_vec3(m, vec3_at(v, i));
        if (dd_is_less(*largest, value)) *largest = value, best = i;
    }
    return best;
}

fine_support fine_find_support(const fine_frame *f, dd3 n) {
    fine_support s;
    dd high, low;
    s.a = find_extreme(f->a, dd33_mul_transposed(&f->world_a, n), &high);
    s.b = find_extreme(f->b, dd33_mul_transposed(&f->world_b, dd3_neg(n)), &low);
    dd gap = dd_sub(dd3_dot(n, f->apart), dd_scale(dd_add(high, low), f->unit));
    s.gap = dd_div(gap, dd3_norm(n));
    return s;
}

double fine_compute_lower(const fine_frame *f, dd gap, double error) {
    return dd_round_down(dd_scale(dd_sub(dd_sub(gap, f->lower_radii), dd_from(error)), 1 / f->unit));
}

double fine_compute_upper(const fine_frame *f, dd distance, double error) {
    return dd_round_up(dd_scale(dd_add(dd_sub(distance, f->upper_radii), dd_from(error)), 1 / f->unit));
}

// The weighted point of A, or of B: weights of any size, scaled so that no product leaves the range.
static dd3 weighted(const fine_frame *f, const ovoid_proof *p, int of_b) {
    const ovoid_shape *shape = of_b ? f->b : f->a;
    const dd33 *rotation = of_b ? &f->world_b : &f->world_a;
    const uint32_t *v = of_b ? p->b : p->a, count = p->count;
    const double *weights = of_b ? p->weight_b : p->weight_a;
    double most = 0;
    for (uint32_t i = 0; i < count; i++) most = fmax(most, weights[i]);
    int exponent;
    (void)frexp(most, &exponent);
    dd3 sum = dd3_from((vec3){0, 0, 0});
    dd whole = {0, 0};
    for (uint32_t i = 0; i < count; i++) {
        double weight = ldexp(weights[i], -exponent);
        sum = dd3_add(sum, dd3_mul_double(vertex(f, shape, rotation, v[i]), weight));
        whole = dd_add(whole, dd_from(weight));
    }
    return (dd3){dd_div(sum.x, whole), dd_div(sum.y, whole), dd_div(sum.z, whole)};
}

dd fine_measure_points(const fine_frame *f, const ovoid_proof *p) {
    dd3 a = weighted(f, p, 0), b = weighted(f, p, 1);
    return dd3_norm(dd3_sub(dd3_add(b, f->apart), a));
}

// The triangles of a tetrahedron, and of double pyramids with the tips 0 and 1 over a ring of three or four, all with
// the same orientation as seen from inside.
static const uint8_t surfaces[3][8][3] = {
    {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}},
    {{0, 2, 3}, {0, 3, 4}, {0, 4, 2}, {1, 3, 2}, {1, 4, 3}, {1, 2, 4}},
    {{0, 2, 3}, {0, 3, 4}, {0, 4, 5}, {0, 5, 2}, {1, 3, 2}, {1, 4, 3}, {1, 5, 4}, {1, 2, 5}},
};

// A closed surface all of whose triangles have the same orientation as seen from the origin winds around it: each adds
// a solid angle of one sign. A determinant of corners of norm W that are off by e is off by 4 W^2 e, its evaluation by
// 32 E W^3.
double fine_measure_hull(const fine_frame *f, const dd3 *w, int count, double error) {
    if (count < 4 || count > 6) return INFINITY;
    double reach = 0, depth = INFINITY;
    for (int i = 0; i < count; i++) reach = fmax(reach, dd3_norm(w[i]).high * (1 + 0x1p-50));
    double slack = reach * reach * (4 * error + 32 * 0x1p-102 * reach);
    int triangles = 2 * count - 4, above = 0, below = 0;
    for (int i = 0; i < triangles; i++) {
        const uint8_t *v = surfaces[count - 4][i];
        dd3 a = w[v[0]], b = w[v[1]], c = w[v[2]];
        double det = dd3_dot(a, dd3_cross(b, c)).high;
        above += det > slack;
        below += det < -slack;
        double area = dd3_norm(dd3_cross(dd3_sub(b, a), dd3_sub(c, a))).high * (1 + 0x1p-40) + 16 * reach * error;
        depth = fmin(depth, (fabs(det) - slack) / area * (1 - 0x1p-40));
    }
    if ((above != triangles && below != triangles) || !(depth > 0)) return INFINITY;
    double upper = fine_compute_upper(f, dd_from(-depth), 0);
    return upper < 0 ? upper : INFINITY;
}
