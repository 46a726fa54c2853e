// Making the frame of a pair, and supports in it.
#include "pair/frame.h"

#include "linear/both.h"
#include "linear/dd3.h"
#include "linear/pose.h"
#include "pair/round.h"

// R(q)/|q|^2 v in double-double: v + 2 (w (p x v) + p x (p x v)) / |q|^2 with q = (w, p).
static dd3 rotate_exactly(ovoid_quat q, vec3 v) {
    q = quat_scaled(q);
    dd w = dd_from(q.w), p[3] = {dd_from(q.x), dd_from(q.y), dd_from(q.z)};
    dd x[3] = {dd_from(v.x), dd_from(v.y), dd_from(v.z)}, c[3], e[3], out[3];
    dd norm = dd_add(dd_add(dd_mul(w, w), dd_mul(p[0], p[0])), dd_add(dd_mul(p[1], p[1]), dd_mul(p[2], p[2])));
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        c[i] = dd_sub(dd_mul(p[j], x[k]), dd_mul(p[k], x[j]));
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        e[i] = dd_add(dd_mul(w, c[i]), dd_sub(dd_mul(p[j], c[k]), dd_mul(p[k], c[j])));
    }
    for (int i = 0; i < 3; i++) out[i] = dd_add(x[i], dd_mul(dd_from(2), dd_div(e[i], norm)));
    return (dd3){out[0], out[1], out[2]};
}

// The origin of a body frame in the world, in double-double.
static dd3 place(const ovoid_shape *shape, const ovoid_pose *pose) {
    vec3 p = pose->position;
    if (!shape->has_origin) return (dd3){dd_from(p.x), dd_from(p.y), dd_from(p.z)};
    dd3 o = rotate_exactly(pose->rotation, shape->origin);
    return (dd3){dd_add(o.x, dd_from(p.x)), dd_add(o.y, dd_from(p.y)), dd_add(o.z, dd_from(p.z))};
}

// For shapes with an origin: the difference of the frames' origins is formed before it is rounded to doubles. Returns
// the error that this can hide; the plain difference of two positions hides none, since it is off by one rounding of
// itself.
static double place_origins(pair_frame *f, const ovoid_pair *pair) {
    dd3 a = place(f->a, &pair->pose_a), b = place(f->b, &pair->pose_b);
    f->world_origin = dd3_high(a);
    f->offset = dd3_high(dd3_sub(b, a));
    return 0x1p-95 * (vec3_max_abs(f->world_origin) + vec3_max_abs(dd3_high(b)) + vec3_max_abs(f->a->origin) +
                      vec3_max_abs(f->b->origin));
}

// Sets both rotations to the world, with the operations of quat_to_mat3, and the difference of the spheres' centres. 0:
// a quaternion needs scaling, and nothing is set.
static int place_plain(pair_frame *f, ovoid_quat a, ovoid_quat b) {
    both_mat3 r;
    if (!both_quat_to_mat3(a, b, &r)) return 0;
    f->world = both_mat3_get(&r, 0);
    f->world_b = both_mat3_get(&r, 1);
    both_vec3 d = both_mat3_mul_vec3(&r, both_vec3_make(f->a->center, f->b->center));
    f->between = vec3_add(f->offset, (vec3){d.x[1] - d.x[0], d.y[1] - d.y[0], d.z[1] - d.z[0]});
    return 1;
}

// The rotations of any quaternions but zero.
static void place_scaled(pair_frame *f, ovoid_quat a, ovoid_quat b) {
    f->world = quat_to_mat3(a);
    f->world_b = quat_to_mat3(b);
    f->between = frame_world_difference(f, f->a->center, f->b->center);
}

ovoid_limit frame_place(const ovoid_pair *pair, pair_frame *f) {
    const ovoid_pose *a = &pair->pose_a, *b = &pair->pose_b;
    if (!pair->shape_a) return OVOID_LIMIT_SHAPE_A;
    if (!pair->shape_b) return OVOID_LIMIT_SHAPE_B;
    f->a = pair->shape_a;
    f->b = pair->shape_b;
    f->world_origin = a->position;
    f->offset = vec3_sub(b->position, a->position);
    f->turned_a = f->turned_b = NULL;
    f->hidden = OVOID_LENGTH_MIN;
    int is_plain = position_is_valid(a->position) & position_is_valid(b->position);
    if (f->a->has_origin | f->b->has_origin) {
        if (pose_validate(a) != OVOID_OK) return OVOID_LIMIT_POSE_A;
        if (pose_validate(b) != OVOID_OK) return OVOID_LIMIT_POSE_B;
        f->hidden += place_origins(f, pair);
    }
    if (!is_plain || !place_plain(f, a->rotation, b->rotation)) {
        if (pose_validate(a) != OVOID_OK) return OVOID_LIMIT_POSE_A;
        if (pose_validate(b) != OVOID_OK) return OVOID_LIMIT_POSE_B;
        place_scaled(f, a->rotation, b->rotation);
    }
    frame_set_lengths(f);
    return OVOID_LIMIT_NONE;
}

static mat3 get_rotation(const ovoid_prepared_shape *shape) {
    const double *r = shape->rotation;
    return (mat3){{r[0], r[1], r[2]}, {r[3], r[4], r[5]}, {r[6], r[7], r[8]}};
}

void frame_place_rotations(const ovoid_prepared_shape *a, const ovoid_prepared_shape *b, pair_frame *f) {
    f->world = get_rotation(a);
    f->world_b = get_rotation(b);
    f->turned_a = a->turned_count ? a->turned : NULL;
    f->turned_b = b->turned_count ? b->turned : NULL;
}

void frame_relate(pair_frame *f) {
    f->rotation = mat3_mul_transposed(f->world, f->world_b);
    f->translation = mat3_mul_transposed_vec3(f->world, f->offset);
}

ovoid_limit frame_make(const ovoid_pair *pair, pair_frame *f) {
    ovoid_limit refused = frame_place(pair, f);
    if (refused == OVOID_LIMIT_NONE) frame_relate(f);
    return refused;
}

simd_pair shapes_find_pair(const ovoid_shape *a, const ovoid_shape *b, vec3 in_a, vec3 in_b) {
    if (a->support.k | b->support.k) {
        simd_extreme x = shape_find_extreme(a, in_a), y = shape_find_extreme(b, in_b);
        return (simd_pair){{x.value, x.index}, {y.value, y.index}};
    }
    simd_points points_a = shape_get_points(a), points_b = shape_get_points(b);
    return simd_find_pair(&points_a, in_a, &points_b, in_b);
}

// Used if one of the shapes has a table of supports, which gives the vertices with their indices.
static frame_support find_support_apart(const pair_frame *f, vec3 n, vec3 in_b) {
    simd_extreme a = shape_find_extreme(f->a, n), b = shape_find_extreme(f->b, in_b);
    double gap = (vec3_dot(n, f->translation) - b.value) - a.value;
    vec3 w = vec3_sub(frame_b(f, (vec3){b.x, b.y, b.z}), (vec3){a.x, a.y, a.z});
    return (frame_support){a.index, b.index, gap, w};
}

frame_support frame_find_support(const pair_frame *f, vec3 n) {
    if (f->is_true) return round_find_ends(f, n);
    if (f->a->support.k | f->b->support.k)
        return find_support_apart(f, n, vec3_neg(mat3_mul_transposed_vec3(f->rotation, n)));
    simd_pair ends = frame_find_pair(f, n, vec3_neg(mat3_mul_transposed_vec3(f->rotation, n)));
    double gap = (vec3_dot(n, f->translation) - ends.low.value) - ends.high.value;
    return (frame_support){ends.high.index, ends.low.index, gap, frame_difference(f, ends.high.index, ends.low.index)};
}

double frame_measure_gap(const pair_frame *f, vec3 n) {
    simd_points points_a = shape_get_points(f->a), points_b = shape_get_points(f->b);
    vec3 in_b = vec3_neg(mat3_mul_transposed_vec3(f->rotation, n));
    double high = simd_find_support(&points_a, &n).value;
    double low = simd_find_support(&points_b, &in_b).value;
    return (vec3_dot(n, f->translation) - low) - high;
}
