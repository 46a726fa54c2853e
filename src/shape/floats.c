// A shape in single precision. A coordinate is off by the rounding of the difference in double, 2^-53 of its terms, and
// by u = 2^-24 of itself; one below 2^-126 of the unit by less than 2^-149 of it.
#include "shape/floats.h"

#include "linear/vec3.h"
#include "simd/support.h"

#include <math.h>

uint64_t shape_floats_get_size(uint32_t vertex_count) {
    uint64_t column = simd_get_padded(vertex_count) * sizeof(float);
    uint64_t size = sizeof(float_shape) + (vertex_count <= FLOAT_COLUMN_POINTS ? 3 * column : 0);
    return (size + 63) / 64 * 64;
}

static float_shape *get_floats(ovoid_shape *s) { return (float_shape *)((char *)s + SHAPE_FLOATS); }

// No coordinate about the centre is above the radius of the sphere around it.
static double find_unit(double reach) {
    int exponent;
    (void)frexp(reach, &exponent);
    return reach > 0x1p-1000 ? ldexp(1, exponent) : 1;
}

void shape_floats_fill_vertices(ovoid_shape *s) {
    float_shape *floats = get_floats(s);
    const double *from[3] = {shape_x(s), shape_y(s), shape_z(s)};
    const double center[3] = {s->center.x, s->center.y, s->center.z};
    float *to = (float *)(floats + 1);
    floats->unit = find_unit(s->reach);
    if (!shape_has_columns(s)) return;
    double scale = 1 / floats->unit;
    for (uint32_t d = 0; d < 3; d++)
        for (uint32_t i = 0; i < s->padded_count; i++)
            to[d * s->padded_count + i] = (float)((from[d][i] - center[d]) * scale);
}

static void put_vec3(float *to, vec3 v, double scale) {
    to[0] = (float)(v.x * scale);
    to[1] = (float)(v.y * scale);
    to[2] = (float)(v.z * scale);
}

// Of an inner ellipsoid thinner than 2^-20 of the unit floats would prove nothing.
void shape_floats_fill_ellipsoids(ovoid_shape *s) {
    float_shape *floats = get_floats(s);
    double scale = 1 / floats->unit;
    const ovoid_sym3 *q = &s->outer.q;
    const double outer[6] = {q->xx, q->xy, q->xz, q->yy, q->yz, q->zz};
    int is_thick = s->inside.least * scale > 0x1p-20;
    float *row = floats->row;
    put_vec3(row + FLOAT_OUTER, vec3_sub(s->outer.center, s->center), scale);
    row[FLOAT_UNIT] = (float)floats->unit;
    put_vec3(row + FLOAT_INNER, vec3_sub(s->inner.center, s->center), scale);
    for (int i = 0; i < 6; i++) row[FLOAT_OUTER_Q + i] = (float)(outer[i] * scale * scale);
    for (int i = 0; i < 6; i++) row[FLOAT_INNER_W + i] = is_thick ? (float)(s->inside.w[i] * floats->unit) : 0;
    row[FLOAT_LEAST] = is_thick ? (float)(s->inside.least * scale * (1 - 0x1p-22)) : 0;
}
