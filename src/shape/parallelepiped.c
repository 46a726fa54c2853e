// Eight points are the corners of a parallelepiped if three edges lead from the first of them to three others, and the
// sums of these edges to the rest. Only one triple of points can be the ends of those edges, so all 35 triples are
// tried, if the first corner has an opposite one across the centre: few other bodies do. Centre and axes are means over
// all eight corners, to average the rounding of a body that was rotated before.
#include "shape/parallelepiped.h"

#include "linear/vec3.h"

enum { CORNERS = 8 };

// The largest difference of a coordinate of a corner, relative to the extent: two roundings of a rotation.
#define CORNER_FLATNESS (4 * 0x1p-53)

// The vertex nearest to x by coordinates; CORNERS where none is within `most`.
static uint32_t find_vertex(const double *vertices, vec3 x, double most) {
    for (uint32_t i = 0; i < CORNERS; i++)
        if (vec3_max_abs(vec3_sub(vec3_at(vertices, i), x)) <= most) return i;
    return CORNERS;
}

// Sets p->corner if the edges from vertex 0 to three others span the body. 1 if all eight corners are different
// vertices.
static int find_corners(const double *vertices, const uint32_t ends[3], double most, parallelepiped *p) {
    vec3 first = vec3_at(vertices, 0);
    unsigned met = 0;
    for (unsigned bits = 0; bits < CORNERS; bits++) {
        vec3 x = first;
        for (int k = 0; k < 3; k++)
            if (bits >> k & 1) x = vec3_add(x, vec3_sub(vec3_at(vertices, ends[k]), first));
        uint32_t found = find_vertex(vertices, x, most);
        if (found == CORNERS) return 0;
        p->corner[bits] = (uint8_t)found;
        met |= 1u << found;
    }
    return met == 0xff;
}

// The mean of the corners, each with the sign of its coefficient; axis 3: all signs positive.
static vec3 compute_mean(const double *vertices, const parallelepiped *p, int axis) {
    vec3 sum = {0, 0, 0};
    for (unsigned bits = 0; bits < CORNERS; bits++) {
        vec3 v = vec3_scale(vec3_at(vertices, p->corner[bits]), 0.125);
        sum = axis == 3 || bits >> axis & 1 ? vec3_add(sum, v) : vec3_sub(sum, v);
    }
    return sum;
}

static int is_exact(const double *vertices, const parallelepiped *p, double most) {
    for (unsigned bits = 0; bits < CORNERS; bits++) {
        vec3 x = p->center;
        for (int k = 0; k < 3; k++) x = vec3_add_scaled(x, p->axis[k], bits >> k & 1 ? 1 : -1);
        if (!(vec3_max_abs(vec3_sub(x, vec3_at(vertices, p->corner[bits]))) <= most)) return 0;
    }
    return 1;
}

// 1 if a corner lies opposite of vertex 0 across the mean of all. In a parallelepiped two opposite corners are off
// twice the centre by two flatnesses and 12 roundings of the extent, and both means by 9 each.
static int has_opposite(const double *vertices, double extent) {
    vec3 twice = {0, 0, 0};
    for (uint32_t i = 0; i < CORNERS; i++) twice = vec3_add_scaled(twice, vec3_at(vertices, i), 0.25);
    vec3 opposite = vec3_sub(twice, vec3_at(vertices, 0));
    return find_vertex(vertices, opposite, 16 * CORNER_FLATNESS * extent) < CORNERS;
}

// 1 if the axes are at right angles, to the rounding of corners in units of each axis: 2^-40 lets a point's coordinates
// along the axes find its nearest point to nearly all digits. Lengths whose squares' squares are no numbers are left
// out.
static int is_right(const parallelepiped *p, double extent) {
    if (!(extent > 0x1p-200 && extent < 0x1p200)) return 0;
    for (int i = 0; i < 3; i++) {
        vec3 a = p->axis[i], b = p->axis[(i + 1) % 3];
        double square = vec3_norm_squared(a);
        if (!(square > 0x1p-40 * (extent * extent))) return 0;
        if (!(fabs(vec3_dot(a, b)) <= 0x1p-48 * sqrt(square * vec3_norm_squared(b)))) return 0;
    }
    return 1;
}

static void set_units(parallelepiped *p) {
    for (int k = 0; k < 3; k++) {
        p->half[k] = vec3_norm(p->axis[k]);
        p->unit[k] = vec3_scale(p->axis[k], 1 / p->half[k]);
    }
}

parallelepiped parallelepiped_make_centered(vec3 half) {
    return (parallelepiped){.axis = {{half.x, 0, 0}, {0, half.y, 0}, {0, 0, half.z}},
                            .corner = {0, 1, 2, 3, 4, 5, 6, 7},
                            .is_present = 1,
                            .is_right = 1,
                            .is_upright = 1,
                            .half = {half.x, half.y, half.z},
                            .unit = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

parallelepiped parallelepiped_find(const double *vertices, uint32_t count, double extent) {
    const parallelepiped none = {.is_present = 0};
    if (count != CORNERS || !has_opposite(vertices, extent)) return none;
    parallelepiped p = {.is_present = 1};
    for (uint32_t i = 1; i < CORNERS; i++)
        for (uint32_t j = i + 1; j < CORNERS; j++)
            for (uint32_t k = j + 1; k < CORNERS; k++) {
                // The edge and both of its ends have an error of this size each.
                if (!find_corners(vertices, (uint32_t[]){i, j, k}, 8 * CORNER_FLATNESS * extent, &p)) continue;
                p.center = compute_mean(vertices, &p, 3);
                for (int axis = 0; axis < 3; axis++) p.axis[axis] = compute_mean(vertices, &p, axis);
                if (!is_exact(vertices, &p, CORNER_FLATNESS * extent)) return none;
                p.is_right = (uint16_t)is_right(&p, extent);
                if (p.is_right) set_units(&p);
                return p;
            }
    return none;
}
