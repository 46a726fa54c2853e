// Making motions, checking them, and the pose of a moving body at a time. Rotations are interpolated along the shorter
// arc: K. Shoemake, Animating rotation with quaternion curves, 1985. The cylinder around the axis is found when a piece
// is entered, at the cost of one pass over the vertices of a body that turns.
#include "motion/motion.h"

#include "base/environment.h"
#include "base/error.h"
#include "linear/pose.h"
#include "linear/rotation.h"
#include "motion/motion_angle.h"
#include "shape/block.h"

#define LONGEST_TIME 1e100
#define LARGEST_TURN 1e9

ovoid_motion ovoid_motion_make_still(ovoid_pose pose) {
    return (ovoid_motion){.kind = OVOID_MOTION_STILL, .start = pose};
}

ovoid_motion ovoid_motion_make_velocity(ovoid_pose start, ovoid_vec3 linear, ovoid_vec3 angular, double duration) {
    return (ovoid_motion){
        .kind = OVOID_MOTION_VELOCITY, .start = start, .linear = linear, .angular = angular, .duration = duration};
}

ovoid_motion ovoid_motion_make_poses(ovoid_pose start, ovoid_pose end, double duration) {
    return (ovoid_motion){.kind = OVOID_MOTION_POSES, .start = start, .end = end, .duration = duration};
}

ovoid_motion ovoid_motion_make_path(const double *times, const ovoid_pose *poses, size_t count) {
    return (ovoid_motion){.kind = OVOID_MOTION_PATH, .times = times, .poses = poses, .count = count};
}

// ---- validity

static ovoid_code refuse_pose(const ovoid_pose *pose, int64_t place, const char *which, ovoid_error *error) {
    ovoid_code code = pose_validate(pose);
    switch (code) {
    case OVOID_OK: return code;
    case OVOID_ERROR_NOT_FINITE:
        return error_set(error, code, place, "the %s pose holds NaN or infinity; give finite numbers", which);
    case OVOID_ERROR_ROTATION:
        return error_set(error, code, place, "the %s pose has a quaternion of four zeros; (1, 0, 0, 0) is no rotation",
                         which);
    default:
        return error_set(error, code, place, "the %s pose is farther than %g away; choose another unit of length",
                         which, OVOID_LENGTH_MAX);
    }
}

static ovoid_code validate_duration(const ovoid_motion *m, ovoid_error *error) {
    if (m->duration > 0 && m->duration <= LONGEST_TIME) return OVOID_OK;
    return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a motion lasts %g; its duration must be above 0 and at most %g",
                     m->duration, LONGEST_TIME);
}

static ovoid_code validate_velocity(const ovoid_motion *m, ovoid_error *error) {
    if (!vec3_is_finite(m->linear) || !vec3_is_finite(m->angular) || !vec3_is_finite(m->pivot))
        return error_set(error, OVOID_ERROR_NOT_FINITE, -1, "a velocity or the pivot holds NaN or infinity");
    double way = vec3_max_abs(m->linear) * m->duration, angle = vec3_max_abs(m->angular) * m->duration;
    double far = way + vec3_max_abs(m->start.position) + 4 * vec3_max_abs(m->pivot);
    if (!(far <= OVOID_LENGTH_MAX))
        return error_set(error, OVOID_ERROR_RANGE, -1, "a motion goes %g far; at most %g is allowed", far,
                         OVOID_LENGTH_MAX);
    if (!(angle <= LARGEST_TURN))
        return error_set(error, OVOID_ERROR_RANGE, -1, "a motion turns %g radians; at most %g are allowed", angle,
                         LARGEST_TURN);
    return OVOID_OK;
}

// The last knot whose time is not after t, but never the last one of all. Safe for any times, sorted or not.
static size_t find_knot(const ovoid_motion *m, double t) {
    size_t low = 0, high = m->count - 1;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (m->times[middle] <= t)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static ovoid_code validate_path(const ovoid_motion *m, double begin, double end, ovoid_error *error) {
    if (!m->times || !m->poses || m->count < 2)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a path needs times and poses, two at least; it has %zu",
                         m->times && m->poses ? m->count : 0);
    size_t first = begin > -INFINITY ? find_knot(m, begin) : 0, last = m->count - 1;
    if (end < INFINITY) last = find_knot(m, end) + 1;
    for (size_t i = first; i <= last; i++) {
        if (!(fabs(m->times[i]) <= LONGEST_TIME))
            return error_set(error, OVOID_ERROR_RANGE, (int64_t)i, "time %zu of a path is %g; at most %g is allowed", i,
                             m->times[i], LONGEST_TIME);
        if (i > first && !(m->times[i] > m->times[i - 1]))
            return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)i,
                             "time %zu of a path is %.17g, the one before it %.17g; times must increase", i,
                             m->times[i], m->times[i - 1]);
        ovoid_code code = refuse_pose(&m->poses[i], (int64_t)i, "path's", error);
        if (code != OVOID_OK) return code;
    }
    return OVOID_OK;
}

ovoid_code motion_validate(const ovoid_motion *m, double begin, double end, ovoid_error *error) {
    if (m->kind == OVOID_MOTION_PATH) return validate_path(m, begin, end, error);
    ovoid_code code = refuse_pose(&m->start, -1, "starting", error);
    if (code != OVOID_OK) return code;
    switch (m->kind) {
    case OVOID_MOTION_STILL: return OVOID_OK;
    case OVOID_MOTION_VELOCITY:
        code = validate_duration(m, error);
        return code == OVOID_OK ? validate_velocity(m, error) : code;
    case OVOID_MOTION_POSES:
        code = validate_duration(m, error);
        return code == OVOID_OK ? refuse_pose(&m->end, -1, "last", error) : code;
    default: return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a motion has kind %d, which is none", (int)m->kind);
    }
}

ovoid_code ovoid_motion_validate(const ovoid_motion *motion, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, motion, motion_validate(motion, -INFINITY, INFINITY, error));
}

// ---- pieces

double motion_get_begin(const ovoid_motion *m) {
    return m->kind == OVOID_MOTION_STILL ? -INFINITY : m->kind == OVOID_MOTION_PATH ? m->times[0] : 0;
}

double motion_get_end(const ovoid_motion *m) {
    return m->kind == OVOID_MOTION_STILL  ? INFINITY
           : m->kind == OVOID_MOTION_PATH ? m->times[m->count - 1]
                                          : m->duration;
}

static double norm_above(vec3 v) {
    double m = vec3_max_abs(v);
    return m > 0 ? m * vec3_norm((vec3){v.x / m, v.y / m, v.z / m}) * (1 + 8 * ROUNDING) : 0;
}

// A turn about the origin of the body's local frame, from one pose to another.
static void set_poses(motion_piece *p, const ovoid_pose *first, const ovoid_pose *last) {
    const ovoid_pose back = {{0, 0, 0},
                             {first->rotation.w, -first->rotation.x, -first->rotation.y, -first->rotation.z}},
                     to = {{0, 0, 0}, last->rotation};
    p->first = *first;
    p->last = *last;
    p->has_last = 1;
    p->from = first->position;
    p->travel = vec3_sub(last->position, first->position);
    p->inner.position = (vec3){0, 0, 0};
    ovoid_quat q = quat_scaled(pose_compute_product(&to, &back).rotation);
    vec3 v = q.w < 0 ? (vec3){-q.x, -q.y, -q.z} : (vec3){q.x, q.y, q.z};
    double sine = vec3_norm(v), norm = sqrt(q.w * q.w + sine * sine);
    ovoid_quat a = first->rotation, b = last->rotation;
    if (a.w == b.w && a.x == b.x && a.y == b.y && a.z == b.z) return;
    // An angle of zero may be a rounded one: it stays a turn about an unknown axis, within its error.
    p->axis = vec3_max_abs(v) > 0 ? vec3_unit(v) : (vec3){1, 0, 0};
    p->turn = max2(2 * turn_compute_angle((turn){fabs(q.w) / norm, sine / norm}), 0x1p-60);
    p->turn_error = 64 * ROUNDING;
}

// The reciprocal of a slower turn's speed may overflow: the turn is taken as one of this speed, and as much in error.
#define SLOWEST 0x1p-900

static void set_velocity(motion_piece *p, const ovoid_motion *m) {
    double most = vec3_max_abs(m->angular);
    p->begin = 0;
    p->end = m->duration;
    p->span = 1;
    p->first = m->start;
    p->travel = m->linear;
    p->axis = vec3_unit(m->angular);
    if (most > 0) p->turn = most >= SLOWEST ? most * vec3_norm(vec3_scale(m->angular, 1 / most)) : SLOWEST;
    p->turn_error = most > 0 && most < SLOWEST ? SLOWEST : 12 * ROUNDING * p->turn;
    // The body as seen from the pivot.
    vec3 arm = {0, 0, 0};
    if (p->turn > 0) arm = mat3_mul_vec3(quat_to_mat3(m->start.rotation), m->pivot);
    p->from = vec3_add(m->start.position, arm);
    p->inner.position = vec3_neg(arm);
    p->fixed = p->turn > 0 ? 160 * ROUNDING * norm_above(m->pivot) : 0;
}

void motion_find_piece(const ovoid_motion *m, double time, motion_piece *p) {
    *p = (motion_piece){.begin = -INFINITY, .end = INFINITY, .span = 1};
    if (m->kind == OVOID_MOTION_VELOCITY) {
        set_velocity(p, m);
    } else if (m->kind == OVOID_MOTION_POSES) {
        p->begin = 0;
        p->end = p->span = m->duration;
        set_poses(p, &m->start, &m->end);
    } else if (m->kind == OVOID_MOTION_PATH) {
        size_t i = find_knot(m, time);
        p->begin = m->times[i];
        p->end = m->times[i + 1];
        p->span = p->end - p->begin;
        set_poses(p, &m->poses[i], &m->poses[i + 1]);
    } else {
        p->is_still = 1;
        p->first = m->start;
        p->from = m->start.position;
    }
    p->inner.rotation = p->first.rotation;
    p->fixed += 4 * ROUNDING * norm_above(p->first.position);
}

void motion_piece_find_place(const motion_piece *p, double time, motion_place *out) {
    *out = (motion_place){p->first, 0, 0};
    if (p->is_still || time <= p->begin) return;
    if (p->has_last && time >= p->end) {
        out->pose = p->last;
        return;
    }
    double s = (time - p->begin) / p->span;
    vec3 way = vec3_scale(p->travel, s);
    out->shift = 16 * ROUNDING * norm_above(way);
    if (vec3_max_abs(way) > 0 || p->turn > 0) out->shift += p->fixed;
    out->pose.position = vec3_add(p->from, way);
    if (!(p->turn > 0)) return;
    double angle = p->turn * s;
    turn half = turn_compute(0.5 * angle);
    ovoid_pose outer = {out->pose.position,
                        {half.cosine, half.sine * p->axis.x, half.sine * p->axis.y, half.sine * p->axis.z}};
    out->pose = pose_compute_product(&outer, &p->inner);
    out->turn = (160 + 16 * angle) * ROUNDING;
}

static ovoid_pose compute_pose(const ovoid_motion *m, double time) {
    motion_piece p;
    motion_place place;
    motion_find_piece(m, time, &p);
    motion_piece_find_place(&p, min2(time, p.end), &place);
    return place.pose;
}

ovoid_pose ovoid_motion_compute_pose(const ovoid_motion *motion, double time) {
    ENVIRONMENT_RETURN(ovoid_pose, time, compute_pose(motion, time));
}

// ---- bodies

static int is_none(const ovoid_pose *part) {
    ovoid_quat q = part->rotation;
    return q.w == 0 && q.x == 0 && q.y == 0 && q.z == 0 && !(vec3_max_abs(part->position) > 0);
}

void moving_find_pose(const ovoid_moving_shape *moving, double time, ovoid_pose *pose) {
    *pose = compute_pose(&moving->motion, time);
    if (!is_none(&moving->part)) *pose = pose_compute_product(pose, &moving->part);
}

static ovoid_pose compute_moving_pose(const ovoid_moving_shape *moving, double time) {
    ovoid_pose pose;
    moving_find_pose(moving, time, &pose);
    return pose;
}

ovoid_pose ovoid_moving_shape_compute_pose(const ovoid_moving_shape *moving, double time) {
    ENVIRONMENT_RETURN(ovoid_pose, time, compute_moving_pose(moving, time));
}

// The cylinder about the axis that holds all vertices and what stands out of them and turns with them. Axis and pivot
// are rounded, each by two or three rotations of 42 u: 512 u of all lengths, and the axis' error times the arm.
static void find_cylinder(motion_body *b) {
    const ovoid_shape *shape = b->moving->shape;
    const double *v = shape_vertices(shape);
    double low = INFINITY, high = -INFINITY, wide = 0;
    for (uint32_t i = 0; i < shape->vertex_count; i++) {
        vec3 y = vec3_sub(vec3_at(v, i), b->pivot);
        double along = vec3_dot(b->axis, y);
        low = min2(low, along);
        high = max2(high, along);
        wide = max2(wide, vec3_norm_squared(vec3_cross(b->axis, y)));
    }
    double slack = (512 * ROUNDING + b->axis_error) * b->reach + b->across;
    b->low = low - slack;
    b->high = high + slack;
    b->wide = min2(sqrt(wide) + slack, b->reach);
}

int motion_body_make(const ovoid_moving_shape *moving, double time, motion_body *b) {
    const ovoid_shape *shape = moving->shape;
    b->moving = moving;
    motion_find_piece(&moving->motion, time, &b->piece);
    b->has_part = !is_none(&moving->part);
    if (b->has_part && pose_validate(&moving->part) != OVOID_OK) return 0;
    // The pivot, from the part's frame, then from the shape's body frame.
    const motion_piece *p = &b->piece;
    mat3 first = quat_to_mat3(p->inner.rotation), part = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    vec3 pivot = vec3_neg(mat3_mul_transposed_vec3(first, p->inner.position)), at = {0, 0, 0};
    if (b->has_part) {
        part = quat_to_mat3(moving->part.rotation);
        at = moving->part.position;
        pivot = mat3_mul_transposed_vec3(part, vec3_sub(pivot, at));
    }
    b->pivot = vec3_sub(pivot, shape->origin);
    // What stands out of the vertices is a part of the body where its support is known with it (motion_gap.c).
    int is_part = shape_has_axis(shape) || shape_is_round(shape);
    b->across = is_part ? shape->allowance.outside : 0;
    b->radius = is_part ? shape->radius : shape->lower_radius;
    b->reach =
        (shape->extent + b->across + norm_above(shape->origin) + 2 * norm_above(at) + norm_above(p->inner.position)) *
        (1 + 256 * ROUNDING);
    b->axis_error = p->turn > 0 ? min2(1, 2 * p->turn_error / p->turn + 256 * ROUNDING) : 0;
    b->axis = mat3_mul_transposed_vec3(part, mat3_mul_transposed_vec3(first, p->axis));
    b->low = b->high = b->wide = 0;
    if (p->turn > 0) find_cylinder(b);
    return 1;
}

double motion_body_find_pose(const motion_body *b, double time, ovoid_pose *pose) {
    motion_place place;
    motion_piece_find_place(&b->piece, time, &place);
    *pose = place.pose;
    double shift = place.shift + place.turn * b->reach;
    if (!b->has_part) return shift;
    *pose = pose_compute_product(pose, &b->moving->part);
    double far = norm_above(place.pose.position) + norm_above(b->moving->part.position);
    return shift + 64 * ROUNDING * (far + b->reach);
}
