// A ring of points near a circle, each counter-clockwise of the one before, the first of the last, goes around the axis
// at least once. If no middle of two neighbours is farther than s inside of the circle, every point of the circle is
// within s of the polygon: the farthest one of an arc lies over the middle of its chord, or nearer.
#include "shape/round.h"

#include "linear/vec3.h"
#include "shape/rim.h"

// What rounding adds to the distance from an axis, of that distance.
#define OFF_AXIS (16 * 0x1p-53)

static vec3 get_vertex(const ovoid_shape *s, uint32_t i) { return vec3_add(s->origin, vec3_at(shape_vertices(s), i)); }

// In units of the radius, so that no square underflows.
static int is_ring(const ovoid_shape *s, const ovoid_round *round, uint32_t count) {
    double least = 1 - s->allowance.outside / round->radius - OFF_AXIS;
    double most = 1 + s->allowance.inside / round->radius + OFF_AXIS;
    for (uint32_t i = 0; i < count; i++) {
        vec3 v = get_vertex(s, i), w = get_vertex(s, i + 1 < count ? i + 1 : 0);
        vec3 a = {v.x / round->radius, v.y / round->radius, 0}, b = {w.x / round->radius, w.y / round->radius, 0};
        if (v.z != -round->half_length || !(vec3_norm(a) <= most) || !(a.x * b.y > a.y * b.x)) return 0;
        if (!(vec3_norm(vec3_scale(vec3_add(a, b), 0.5)) >= least)) return 0;
    }
    return 1;
}

// The second ring has the points of the first, higher up.
static int is_lifted(const ovoid_shape *s, const ovoid_round *round, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        vec3 a = get_vertex(s, i), b = get_vertex(s, count + i);
        if (a.x != b.x || a.y != b.y || b.z != round->half_length) return 0;
    }
    return 1;
}

int round_is_held(const ovoid_shape *s, const ovoid_round *round) {
    if (round->kind == OVOID_ROUND_ELLIPSOID) return ellipsoid_is_held(s, round->half_axes);
    uint32_t all = s->vertex_count, is_flat = !(round->half_length > 0);
    int is_cone = round->kind == OVOID_ROUND_CONE;
    uint32_t count = is_flat ? all : is_cone ? all - 1 : all / 2;
    vec3 axis = s->allowance.axis;
    if (axis.x != 0 || axis.y != 0 || axis.z != 1 || count < 3 || !is_ring(s, round, count)) return 0;
    if (is_flat) return 1;
    if (!is_cone) return all == 2 * count && is_lifted(s, round, count);
    vec3 apex = get_vertex(s, count);
    return apex.x == 0 && apex.y == 0 && apex.z == round->half_length;
}

vec3 rim_compute_point(const ovoid_shape *s, uint32_t number) {
    if (shape_is_ellipsoid(s)) return vec3_sub(ellipsoid_compute_point(s->round.half_axes, number), s->origin);
    double t = (number & (RIM_STEPS - 1)) * (1 / (double)RIM_STEPS), part = s->round.radius / (1 + t * t);
    double c = (1 - t * t) * part, d = 2 * t * part, half = s->round.half_length;
    uint32_t quarter = number >> 28 & 3;
    double x = quarter & 1 ? d : c, y = quarter & 1 ? c : d;
    if (quarter == 1 || quarter == 2) x = -x;
    if (quarter & 2) y = -y;
    return vec3_sub((vec3){x, y, number & RIM_UPPER ? half : -half}, s->origin);
}
