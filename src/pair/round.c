// Supports of cylinders and cones in closed form.
#include "pair/round.h"

double round_find_support(const ovoid_shape *s, vec3 n, vec3 *point) {
    double half = s->round.half_length, radius = s->round.radius, across = sqrt(n.x * n.x + n.y * n.y);
    double end = n.z < 0 ? -half : half, rim = radius;
    if (s->round.kind == OVOID_ROUND_CONE) {
        int is_apex = half * n.z >= radius * across - half * n.z;
        end = is_apex ? half : -half;
        rim = is_apex ? 0 : radius;
    }
    double part = across > 0 ? rim / across : 0;
    *point = (vec3){n.x * part - s->origin.x, n.y * part - s->origin.y, end - s->origin.z};
    return (end * n.z + rim * across) - vec3_dot(n, s->origin);
}

double round_compute_radii(const pair_frame *f, vec3 n, double error) {
    vec3 in_b = mat3_mul_transposed_vec3(f->rotation, n);
    double a = shape_is_round(f->a) ? f->a->radius : shape_compute_lower_radius(f->a, n, error);
    double b = shape_is_round(f->b) ? f->b->radius : shape_compute_lower_radius(f->b, in_b, error);
    return a + b;
}

static double measure_support(const ovoid_shape *s, vec3 n) {
    vec3 point;
    if (shape_is_round(s)) return round_find_support(s, n, &point);
    simd_points points = shape_get_points(s);
    return simd_find_support(&points, n).value;
}

double round_measure_gap(const pair_frame *f, vec3 n) {
    vec3 in_b = vec3_neg(mat3_mul_transposed_vec3(f->rotation, n));
    return (vec3_dot(n, f->translation) - measure_support(f->b, in_b)) - measure_support(f->a, n);
}

double round_compute_lower(const pair_frame *f, vec3 n, double gap) {
    double lower = nextafter(gap - round_compute_radii(f, n, AXIS_CLAIM), -INFINITY);
    return lower - (f->claim + ROUND_CLAIM * f->size);
}
