// Supports of cylinders, cones and ellipsoids in closed form.
#include "pair/round.h"

round_end round_find_support(const ovoid_shape *s, vec3 n) {
    if (shape_is_ellipsoid(s)) {
        ellipsoid_end end = ellipsoid_find_support(s->round.half_axes, n);
        return (round_end){end.value - vec3_dot(n, s->origin), ellipsoid_find_number(end.m)};
    }
    double half = s->round.half_length, radius = s->round.radius, across = sqrt(n.x * n.x + n.y * n.y);
    double shift = vec3_dot(n, s->origin);
    if (s->round.kind == OVOID_ROUND_CYLINDER) {
        int is_upper = n.z > 0;
        double end = is_upper ? half : -half;
        return (round_end){(end * n.z + radius * across) - shift, rim_find(n.x, n.y, across, is_upper)};
    }
    double apex = half * n.z, rim = radius * across - half * n.z;
    if (half > 0 && apex >= rim) return (round_end){apex - shift, s->vertex_count - 1};
    return (round_end){rim - shift, rim_find(n.x, n.y, across, 0)};
}

// How far the true body exceeds the polyhedron's sphere and outer ellipsoid. Those of an ellipsoid hold it.
static double find_beyond(const ovoid_shape *s) {
    return shape_is_round(s) && !shape_is_ellipsoid(s) ? nextafter(s->lower_radius - s->radius, INFINITY) : 0;
}

void frame_make_true(pair_frame *f) {
    double a = shape_is_round(f->a) ? f->a->radius : f->a->lower_radius;
    double b = shape_is_round(f->b) ? f->b->radius : f->b->lower_radius;
    f->is_true = 1;
    f->beyond = nextafter(find_beyond(f->a) + find_beyond(f->b), INFINITY);
    f->lower_radii = a + b;
    f->claim += ROUND_CLAIM * f->size;
}

true_end round_find_end(const ovoid_shape *s, vec3 n) {
    if (shape_is_round(s)) {
        round_end end = round_find_support(s, n);
        return (true_end){end.value, shape_get_vertex(s, end.vertex), end.vertex};
    }
    simd_extreme x = shape_find_extreme(s, n);
    return (true_end){x.value, {x.x, x.y, x.z}, x.index};
}

frame_support round_find_ends(const pair_frame *f, vec3 n) {
    true_end a = round_find_end(f->a, n), b = round_find_end(f->b, vec3_neg(mat3_mul_transposed_vec3(f->rotation, n)));
    double gap = (vec3_dot(n, f->translation) - b.value) - a.value;
    return (frame_support){a.vertex, b.vertex, gap, vec3_sub(frame_b(f, b.point), a.point)};
}

double round_compute_radii(const pair_frame *f, vec3 n, double error) {
    vec3 in_b = mat3_mul_transposed_vec3(f->rotation, n);
    double a = shape_is_round(f->a) ? f->a->radius : shape_compute_lower_radius(f->a, n, error);
    double b = shape_is_round(f->b) ? f->b->radius : shape_compute_lower_radius(f->b, in_b, error);
    return a + b;
}

static double measure_support(const ovoid_shape *s, vec3 n) {
    if (shape_is_round(s)) return round_find_support(s, n).value;
    simd_points points = shape_get_points(s);
    return simd_find_support(&points, &n).value;
}

double round_measure_gap(const pair_frame *f, vec3 n) {
    vec3 in_b = vec3_neg(mat3_mul_transposed_vec3(f->rotation, n));
    return (vec3_dot(n, f->translation) - measure_support(f->b, in_b)) - measure_support(f->a, n);
}
