// What computed poses of a motion may be off by, and the box that a body sweeps. Truth: the motion as docs/motion.md
// defines it, in long double: each vertex is within `shift` of where the exact motion has it, and inside the box. Still
// bodies and straight ways too, whose boxes have no room but their padding.
#include "extended.h"
#include "moving.h"

#include "motion/motion.h"

// Quaternions to an exact relative rotation, the shorter way: its axis and angle.
static long double find_relative(ovoid_quat p, ovoid_quat q, extended3 *axis) {
    // q p^-1
    long double w = (long double)q.w * p.w + (long double)q.x * p.x + (long double)q.y * p.y + (long double)q.z * p.z;
    extended3 a = {p.x, p.y, p.z}, b = {q.x, q.y, q.z};
    extended3 v = extended3_sub(extended3_sub(extended3_scale(b, p.w), extended3_scale(a, q.w)), extended3_cross(b, a));
    long double sine = extended3_norm(v), sign = w < 0 ? -1 : 1;
    *axis = sine > 0 ? extended3_scale(v, sign / sine) : (extended3){1, 0, 0};
    return 2 * atan2l(sine, fabsl(w));
}

// A point of the body's local frame between two poses, s of the way.
static extended3 find_between(const ovoid_pose *first, const ovoid_pose *last, long double s, extended3 v) {
    extended3 axis, from = extended3_from(first->position), to = extended3_from(last->position);
    long double angle = find_relative(first->rotation, last->rotation, &axis);
    extended3 at = extended3_add(from, extended3_scale(extended3_sub(to, from), s));
    return extended3_add(at, extended3_turn(axis, s * angle, extended3_rotate(first->rotation, v)));
}

static extended3 find_velocity_point(const ovoid_motion *m, long double t, extended3 v) {
    extended3 pivot = extended3_from(m->pivot), w = extended3_from(m->angular);
    long double rate = extended3_norm(w);
    extended3 arm = extended3_rotate(m->start.rotation, extended3_sub(v, pivot));
    extended3 at = extended3_place(&m->start, pivot);
    if (rate > 0) arm = extended3_turn(extended3_scale(w, 1 / rate), rate * t, arm);
    return extended3_add(extended3_add(at, extended3_scale(extended3_from(m->linear), t)), arm);
}

// Where the exact motion has a point of what moves.
static extended3 find_point(const ovoid_motion *m, double time, extended3 v) {
    if (m->kind == OVOID_MOTION_STILL) return extended3_place(&m->start, v);
    if (m->kind == OVOID_MOTION_VELOCITY) return find_velocity_point(m, time, v);
    if (m->kind == OVOID_MOTION_POSES) return find_between(&m->start, &m->end, (long double)time / m->duration, v);
    size_t i = 0;
    while (i + 2 < m->count && m->times[i + 1] <= time) i++;
    long double s = ((long double)time - m->times[i]) / ((long double)m->times[i + 1] - m->times[i]);
    return find_between(&m->poses[i], &m->poses[i + 1], s, v);
}

// A vertex of the shape in the frame of what moves.
static extended3 find_vertex(const ovoid_moving_shape *m, const ovoid_polytope *p, uint32_t i) {
    extended3 v = extended3_add(extended3_from(p->origin), extended3_from(vec3_at(p->vertices, i)));
    ovoid_quat q = m->part.rotation;
    int has_part = q.w != 0 || q.x != 0 || q.y != 0 || q.z != 0;
    return has_part ? extended3_place(&m->part, v) : v;
}

static void check_shift(const ovoid_moving_shape *m, double time, double size) {
    ovoid_polytope p = ovoid_shape_get_polytope(m->shape);
    motion_body b;
    ovoid_pose pose;
    CHECK(motion_body_make(m, time, &b));
    double shift = motion_body_find_pose(&b, time, &pose);
    long double most = 0, slack = EXTENDED_ROUNDING * 64 * (size + b.reach + vec3_norm(pose.position));
    slack *= 1 + b.piece.turn;
    for (uint32_t i = 0; i < p.vertex_count && i < 16; i++) {
        extended3 local = extended3_add(extended3_from(p.origin), extended3_from(vec3_at(p.vertices, i)));
        extended3 meant = find_point(&m->motion, time, find_vertex(m, &p, i));
        most = fmaxl(most, extended3_norm(extended3_sub(meant, extended3_place(&pose, local))));
    }
    CHECK_LE((double)(most - slack), shift);
}

static void check_box(const ovoid_moving_shape *m, double begin, double end, double size, double spin, uint64_t *s) {
    ovoid_polytope p = ovoid_shape_get_polytope(m->shape);
    ovoid_box box = ovoid_moving_shape_compute_box(m, begin, end);
    double radius = ovoid_shape_get_radius(m->shape);
    for (int k = 0; k < 12; k++) {
        double time = k == 0 ? begin : k == 1 ? end : random_uniform(s, begin, end);
        for (uint32_t i = 0; i < p.vertex_count && i < 16; i++) {
            extended3 x = find_point(&m->motion, time, find_vertex(m, &p, i));
            long double slack = EXTENDED_ROUNDING * (64 + 4 * spin) * (size + extended3_norm(x));
            int ok = x.x + radius <= box.max.x + slack && x.y + radius <= box.max.y + slack &&
                     x.z + radius <= box.max.z + slack && x.x - radius >= box.min.x - slack &&
                     x.y - radius >= box.min.y - slack && x.z - radius >= box.min.z - slack;
            CHECK(ok);
        }
    }
}

int main(void) {
    for (uint64_t seed = 1; EXTENDED && seed <= 600; seed++) {
        moving_case c;
        uint64_t s = check_seed = seed;
        moving_make(&c, seed);
        for (int k = 0; k < 6; k++) {
            double time = k ? random_uniform(&s, 0, 1) : 0;
            check_shift(&c.a, time, c.size);
            check_shift(&c.b, time, c.size);
        }
        double begin = random_uniform(&s, 0, 0.5);
        check_box(&c.a, begin, random_uniform(&s, 0.5, 1), c.size, c.spin, &s);
        check_box(&c.b, 0, 1, c.size, c.spin, &s);
        // Straight, and at rest: a box without any bulge.
        c.a.motion = ovoid_motion_make_velocity(c.a.motion.start, bits_vec3(&s, 3 * c.size), (ovoid_vec3){0, 0, 0}, 1);
        c.a.motion.start.rotation = bits_quat(&s);
        check_box(&c.a, 0, 1, c.size, 0, &s);
        c.b.motion = ovoid_motion_make_still((ovoid_pose){bits_vec3(&s, c.size), bits_quat(&s)});
        check_box(&c.b, 0, 1, c.size, 0, &s);
        moving_destroy(&c);
    }
    if (!EXTENDED) check_skip("long double has no more digits than double here");
    return check_end();
}
