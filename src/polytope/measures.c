// Measures of a polyhedron by summing over its triangles: volume, centroid and inertia of a solid are sums over the
// tetrahedra from a point inside to each triangle (D. Eberly, Polyhedral mass properties (revisited), 2002); flat
// bodies sum over triangles, segments over their length. The enclosing sphere is moved toward its farthest point (M.
// Badoiu, K. L. Clarkson, Smaller core-sets for balls, 2003), from the middle of the box; its radius is then measured
// and rounded up.
#include "linear/mat3.h"
#include "ovoid/polytope.h"

// Moments about a point: mass (volume, area, length), first and second moments.
typedef struct moments {
    double mass;
    vec3 first;
    sym3 second; // of x x'
} moments;

// A simplex with corner sum s = a + b + c (+ 0 for the reference point), mass m, n corners: mean s / n, second moment
// m (sum of p p' + s s') / (n (n + 1)).
static void add_simplex(moments *sum, const vec3 *p, int count, int corners, double mass) {
    vec3 s = {0, 0, 0};
    sym3 squares = {0, 0, 0, 0, 0, 0};
    for (int i = 0; i < count; i++) {
        s = vec3_add(s, p[i]);
        squares = sym3_add(squares, sym3_outer(p[i], 1));
    }
    sum->mass += mass;
    sum->first = vec3_add_scaled(sum->first, s, mass / corners);
    squares = sym3_add(squares, sym3_outer(s, 1));
    sum->second = sym3_add(sum->second, sym3_scale(squares, mass / (corners * (corners + 1.0))));
}

static vec3 scaled_vertex(const ovoid_polytope *p, uint32_t i, vec3 about, double unit) {
    return vec3_scale(vec3_sub(vec3_at(p->vertices, i), about), unit);
}

// About the reference point, in lengths times `unit`, and the area of the surface.
static moments sum_moments(const ovoid_polytope *p, vec3 about, double unit, double *area) {
    moments sum = {0, {0, 0, 0}, {0, 0, 0, 0, 0, 0}};
    *area = 0;
    for (uint32_t t = 0; t < p->triangle_count; t++) {
        vec3 x[3];
        for (int k = 0; k < 3; k++) x[k] = scaled_vertex(p, p->triangles[3 * (size_t)t + k], about, unit);
        vec3 n = vec3_cross(vec3_sub(x[1], x[0]), vec3_sub(x[2], x[0]));
        double flat = vec3_norm(n) / 2;
        *area += flat;
        if (p->rank == 3)
            add_simplex(&sum, x, 3, 4, vec3_dot(x[0], n) / 6);
        else
            add_simplex(&sum, x, 3, 3, flat);
    }
    if (p->rank == 1) {
        vec3 x[2] = {scaled_vertex(p, 0, about, unit), scaled_vertex(p, 1, about, unit)};
        add_simplex(&sum, x, 2, 2, vec3_norm(vec3_sub(x[1], x[0])));
    }
    if (p->rank == 2) *area *= 2;
    return sum;
}

static void find_box(const ovoid_polytope *p, ovoid_measures *m) {
    m->box_min = m->box_max = vec3_at(p->vertices, 0);
    for (uint32_t i = 1; i < p->vertex_count; i++) {
        vec3 v = vec3_at(p->vertices, i);
        m->box_min = (vec3){fmin(m->box_min.x, v.x), fmin(m->box_min.y, v.y), fmin(m->box_min.z, v.z)};
        m->box_max = (vec3){fmax(m->box_max.x, v.x), fmax(m->box_max.y, v.y), fmax(m->box_max.z, v.z)};
    }
}

// The vertex farthest from c.
static vec3 find_farthest(const ovoid_polytope *p, vec3 c, double *distance) {
    vec3 best = c;
    *distance = 0;
    for (uint32_t i = 0; i < p->vertex_count; i++) {
        vec3 v = vec3_at(p->vertices, i);
        double d = vec3_norm(vec3_sub(v, c));
        if (d > *distance) *distance = d, best = v;
    }
    return best;
}

static void find_sphere(const ovoid_polytope *p, ovoid_measures *m) {
    vec3 c = vec3_scale(vec3_add(m->box_min, m->box_max), 0.5), best = c;
    double least = INFINITY;
    // Steps of 1 / (i + 1) toward the farthest vertex: within 1 / sqrt(i) of the least radius.
    for (int i = 1; i <= 64; i++) {
        double distance;
        vec3 far = find_farthest(p, c, &distance);
        if (distance < least) least = distance, best = c;
        c = vec3_add_scaled(c, vec3_sub(far, c), 1 / (i + 1.0));
    }
    m->sphere_center = best;
    // The norm of a difference has relative error below 4 u; underflow of its squares hides less than the least length.
    m->sphere_radius = least > 0 ? least * (1 + 8 * 0x1p-53) + OVOID_LENGTH_MIN : 0;
}

// value / unit^power; a zero stays zero though the power overflows, so that very large bodies have infinite, not
// undefined, inertia.
static double unscaled(double value, double unit, int power) {
    for (int i = 0; i < power && value != 0; i++) value /= unit;
    return value;
}

static sym3 unscaled_sym3(sym3 s, double unit, int power) {
    return (sym3){unscaled(s.xx, unit, power), unscaled(s.xy, unit, power), unscaled(s.xz, unit, power),
                  unscaled(s.yy, unit, power), unscaled(s.yz, unit, power), unscaled(s.zz, unit, power)};
}

ovoid_measures ovoid_polytope_compute_measures(const ovoid_polytope *polytope) {
    ovoid_measures m = {.volume = 0};
    find_box(polytope, &m);
    find_sphere(polytope, &m);
    // In units of a power of two near the body's size, about the middle of its box.
    int exponent;
    (void)frexp(m.sphere_radius, &exponent);
    double unit = ldexp(1, -exponent);
    vec3 about = vec3_scale(vec3_add(m.box_min, m.box_max), 0.5);
    moments sum = sum_moments(polytope, about, unit, &m.area);
    vec3 mean = sum.mass > 0 ? vec3_scale(sum.first, 1 / sum.mass) : (vec3){0, 0, 0};
    m.centroid = vec3_add_scaled(about, mean, 1 / unit);
    m.area = unscaled(m.area, unit, 2);
    if (polytope->rank == 3) m.volume = unscaled(sum.mass, unit, 3);
    // Second moments about the centroid, then the inertia tensor trace(S) I - S.
    sym3 s = sym3_add(sum.second, sym3_outer(mean, -sum.mass));
    double trace = sym3_trace(s);
    s = sym3_add(sym3_diagonal(trace, trace, trace), sym3_scale(s, -1));
    m.inertia = unscaled_sym3(s, unit, 2 + (int)polytope->rank);
    return m;
}
