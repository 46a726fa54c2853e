// Supports of the cores of swept spheres, and the smooth pieces that they consist of. A core's support function is the
// greatest of a few smooth ones: a box has one for each corner, a cylinder one for each rim, a cone one for the apex
// and one for the rim, a segment two, a hull one for each point, an ellipsoid one. Each is linear, or linear and the
// norm |L n| of a linear image, whose second derivative is known.
//
// Errors, as in swept.c: a support point is one of its core to 60 u s, and no point of the core is farther along the
// unit direction by more than that.
#ifndef OVOID_QUERY_SWEPT_PATCH_H
#define OVOID_QUERY_SWEPT_PATCH_H

#include "base/compiler.h"
#include "linear/vec3.h"
#include "ovoid/swept.h"

/// The part of n across the axis, of which z is the part along it. square: of n's length. Where not much is left,
/// rounding has left some of it along the axis, up to 4 u |n|: of the second pass that leaves 8 u^2 |n|, which is 2 u
/// of what is kept.
COMPILER_INLINED vec3 patch_find_across(vec3 axis, vec3 n, double z, double square) {
    vec3 off = vec3_add_scaled(n, axis, -z);
    if (vec3_norm_squared(off) > 0x1p-6 * square) return off;
    off = vec3_add_scaled(off, axis, -vec3_dot(axis, off));
    return vec3_norm_squared(off) > 0x1p-102 * square ? off : (vec3){0, 0, 0};
}

/// A direction in the core's axes, of which a box, an ellipsoid and a hull have three.
COMPILER_INLINED vec3 patch_turn(const ovoid_swept_sphere *s, vec3 n) {
    return (vec3){vec3_dot(s->axis[0], n), vec3_dot(s->axis[1], n), vec3_dot(s->axis[2], n)};
}
/// A point of these axes in the world, from the core's centre.
COMPILER_INLINED vec3 patch_turn_back(const ovoid_swept_sphere *s, vec3 m) {
    return vec3_add(vec3_add_scaled(vec3_scale(s->axis[0], m.x), s->axis[1], m.y), vec3_scale(s->axis[2], m.z));
}

/// The number of the hull's point that is the farthest along m, in the hull's axes.
COMPILER_NOINLINE static size_t patch_find_farthest(const ovoid_swept_sphere *s, vec3 m) {
    size_t best = 0;
    double most = -INFINITY;
    for (size_t i = 0; i < s->count; i++) {
        double height = vec3_dot(vec3_at(s->points, i), m);
        best = height > most ? i : best;
        most = max2(height, most);
    }
    return best;
}

COMPILER_INLINED vec3 patch_find_round_end(const ovoid_swept_sphere *s, vec3 n, double square) {
    vec3 axis = s->axis[0];
    double z = vec3_dot(axis, n), h = s->half[0], radius = s->half[1];
    vec3 off = patch_find_across(axis, n, z, square);
    double across = sqrt(vec3_norm_squared(off)), scale = across > 0 ? radius / across : 0;
    // The apex of a cone, or the rim of its base.
    if (s->core == OVOID_SWEPT_CONE && 2 * h * z >= radius * across) return vec3_scale(axis, h);
    return vec3_add_scaled(vec3_scale(axis, s->core == OVOID_SWEPT_CONE ? -h : copysign(h, z)), off, scale);
}

/// A core's point, from its centre, that is the farthest along n, of any length. square: of that length
COMPILER_INLINED vec3 patch_find_end(const ovoid_swept_sphere *s, vec3 n, double square) {
    const double *half = s->half;
    if (s->core == OVOID_SWEPT_CYLINDER || s->core == OVOID_SWEPT_CONE) return patch_find_round_end(s, n, square);
    if (s->core == OVOID_SWEPT_POINT) return (vec3){0, 0, 0};
    vec3 m = {vec3_dot(s->axis[0], n), 0, 0};
    if (s->core == OVOID_SWEPT_SEGMENT) return vec3_scale(s->axis[0], copysign(half[0], m.x));
    m.y = vec3_dot(s->axis[1], n), m.z = vec3_dot(s->axis[2], n);
    if (s->core == OVOID_SWEPT_POINTS) {
        m = vec3_at(s->points, patch_find_farthest(s, m));
    } else if (s->core == OVOID_SWEPT_BOX) {
        m = (vec3){copysign(half[0], m.x), copysign(half[1], m.y), copysign(half[2], m.z)};
    } else {
        m = (vec3){half[0] * m.x, half[1] * m.y, half[2] * m.z};
        double length = vec3_norm(m), scale = length > 0 ? 1 / length : 0;
        m = (vec3){half[0] * (m.x * scale), half[1] * (m.y * scale), half[2] * (m.z * scale)};
    }
    return patch_turn_back(s, m);
}

// ---- an ellipsoid in other axes

/// The rows of its form Q in these axes: its farthest point along n, from its centre, is Q n / sqrt(n.Q n).
typedef struct ellipsoid_form {
    vec3 row[3];
} ellipsoid_form;

/// axis: three at right angles.
static inline ellipsoid_form ellipsoid_make_form(const ovoid_swept_sphere *s, const vec3 axis[3]) {
    ellipsoid_form to = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
    for (int k = 0; k < 3; k++) {
        const vec3 turned = {vec3_dot(axis[0], s->axis[k]), vec3_dot(axis[1], s->axis[k]),
                             vec3_dot(axis[2], s->axis[k])},
                   a = vec3_scale(turned, s->half[k]);
        to.row[0] = vec3_add_scaled(to.row[0], a, a.x);
        to.row[1] = vec3_add_scaled(to.row[1], a, a.y);
        to.row[2] = vec3_add_scaled(to.row[2], a, a.z);
    }
    return to;
}

/// Q n.
COMPILER_INLINED vec3 ellipsoid_apply_form(const ellipsoid_form *form, vec3 n) {
    return (vec3){vec3_dot(form->row[0], n), vec3_dot(form->row[1], n), vec3_dot(form->row[2], n)};
}

/// The least half axis.
static inline double ellipsoid_find_least(const ovoid_swept_sphere *s) {
    return min2(s->half[0], min2(s->half[1], s->half[2]));
}

/// How far the farthest points by the form are off: with the half axes a, the least b, by 16 u a^2 / b, twice.
static inline double ellipsoid_find_doubt(const ovoid_swept_sphere *s) {
    const double most = max2(s->half[0], max2(s->half[1], s->half[2]));
    return 32 * 0x1p-53 * most * (most / ellipsoid_find_least(s));
}

// ---- smooth pieces

/// Two unit vectors across a unit direction.
typedef struct patch_plane {
    vec3 n, e[2];
} patch_plane;

static inline patch_plane patch_make_plane(vec3 n) {
    vec3 e = vec3_orthogonal(n);
    return (patch_plane){n, {e, vec3_cross(n, e)}};
}

/// The symmetric matrix (xx, xy, yy) of a plane's vectors.
typedef struct patch_form {
    double xx, xy, yy;
} patch_form;

/// A smooth piece along a unit n: its point from the core's centre, which is its gradient; its second derivative along
/// the plane's vectors; and for the norm |L n| of which the latter is, how much longer |L t| may be than |L n|, as a
/// part, for any unit t.
typedef struct patch {
    vec3 at;
    patch_form second;
    double ratio;
} patch;

/// The piece that is the greatest along n.
COMPILER_INLINED unsigned patch_choose(const ovoid_swept_sphere *s, vec3 n) {
    switch (s->core) {
    case OVOID_SWEPT_SEGMENT:
    case OVOID_SWEPT_CYLINDER: return vec3_dot(s->axis[0], n) < 0;
    case OVOID_SWEPT_BOX: {
        vec3 m = patch_turn(s, n);
        return (unsigned)(m.x < 0) | (unsigned)(m.y < 0) << 1 | (unsigned)(m.z < 0) << 2;
    }
    case OVOID_SWEPT_CONE: {
        double z = vec3_dot(s->axis[0], n);
        return !(2 * s->half[0] * z >= s->half[1] * vec3_norm(patch_find_across(s->axis[0], n, z, 1)));
    }
    case OVOID_SWEPT_POINTS: return (unsigned)patch_find_farthest(s, patch_turn(s, n));
    default: return 0;
    }
}

/// The piece of a rim around the axis, `height` along it from the centre. 0 where n is near the axis, along which the
/// rim has no smooth support.
COMPILER_INLINED int patch_find_rim(const ovoid_swept_sphere *s, const patch_plane *of, double height, patch *to) {
    vec3 axis = s->axis[0], off = patch_find_across(axis, of->n, vec3_dot(axis, of->n), 1);
    double square = vec3_norm_squared(off);
    if (!(square > 1e-8)) return 0;
    double scale = 1 / sqrt(square), second = s->half[1] * scale;
    vec3 out = vec3_scale(off, scale), around = vec3_cross(axis, out);
    double x = vec3_dot(around, of->e[0]), y = vec3_dot(around, of->e[1]);
    to->at = vec3_add_scaled(vec3_scale(axis, height), out, s->half[1]);
    to->second = (patch_form){second * x * x, second * x * y, second * y * y};
    to->ratio = scale;
    return 1;
}

COMPILER_INLINED void patch_find_ellipsoid(const ovoid_swept_sphere *s, const patch_plane *of, patch *to) {
    const double *h = s->half;
    vec3 m[3];
    for (int i = 0; i < 3; i++) {
        vec3 t = patch_turn(s, i == 0 ? of->n : of->e[i - 1]);
        m[i] = (vec3){h[0] * t.x, h[1] * t.y, h[2] * t.z};
    }
    double scale = 1 / vec3_norm(m[0]);
    vec3 u = vec3_scale(m[0], scale);
    double x = vec3_dot(u, m[1]), y = vec3_dot(u, m[2]);
    to->at = patch_turn_back(s, (vec3){h[0] * u.x, h[1] * u.y, h[2] * u.z});
    to->second = (patch_form){(vec3_norm_squared(m[1]) - x * x) * scale, (vec3_dot(m[1], m[2]) - x * y) * scale,
                              (vec3_norm_squared(m[2]) - y * y) * scale};
    to->ratio = max2(h[0], max2(h[1], h[2])) * scale;
}

/// A piece by its number; 0 where it is not smooth.
COMPILER_INLINED int patch_find(const ovoid_swept_sphere *s, unsigned piece, const patch_plane *of, patch *to) {
    const double *h = s->half;
    *to = (patch){{0, 0, 0}, {0, 0, 0}, 0};
    switch (s->core) {
    case OVOID_SWEPT_SEGMENT: to->at = vec3_scale(s->axis[0], piece ? -h[0] : h[0]); return 1;
    case OVOID_SWEPT_BOX:
        to->at =
            patch_turn_back(s, (vec3){piece & 1 ? -h[0] : h[0], piece & 2 ? -h[1] : h[1], piece & 4 ? -h[2] : h[2]});
        return 1;
    case OVOID_SWEPT_POINTS: to->at = patch_turn_back(s, vec3_at(s->points, piece)); return 1;
    case OVOID_SWEPT_ELLIPSOID: patch_find_ellipsoid(s, of, to); return 1;
    case OVOID_SWEPT_CYLINDER: return patch_find_rim(s, of, piece ? -h[0] : h[0], to);
    case OVOID_SWEPT_CONE:
        if (piece) return patch_find_rim(s, of, -h[0], to);
        to->at = vec3_scale(s->axis[0], h[0]);
        return 1;
    default: return 1;
    }
}

#endif
