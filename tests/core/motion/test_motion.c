// Motions, and the boxes they sweep. Truth: sine, cosine and rotation in long double (64 bits of mantissa, glibc's are
// good to an ulp of them), within the bounds that docs/motion.md derives; given poses bit for bit; boxes hold every
// vertex at sampled times, and are no wider than promised. Bad motions: code, place and a sentence.
#include "bits.h"
#include "linear/mat3.h"
#include "linear/rotation.h"
#include "motion/motion_angle.h"

#define U 0x1p-53L

static void check_angles(void) {
    uint64_t s = 1;
    long double worst = 0, worst_angle = 0;
    for (int i = 0; i < 200000; i++) {
        double x = random_uniform(&s, 0, i % 2 ? 7 : i % 3 ? 1e4 : 1e9);
        if (i % 5 == 0) x = (double)(i / 5) * (HALF_PI / 2); // where the quadrants meet
        turn t = turn_compute(x);
        worst = fmaxl(worst, fmaxl(fabsl(t.cosine - cosl(x)), fabsl(t.sine - sinl(x))));
        double a = i % 7 ? random_uniform(&s, 0, HALF_PI) : exp(random_uniform(&s, -60, 0));
        turn of = {(double)cosl(a), (double)sinl(a)};
        worst_angle = fmaxl(worst_angle, fabsl(turn_compute_angle(of) - atan2l(of.sine, of.cosine)));
    }
    printf("sine and cosine: %.2Lf u, angle %.2Lf u\n", worst / U, worst_angle / U);
    CHECK_LE(worst, 6 * U);
    CHECK_LE(worst_angle, 10 * U);
    CHECK_EQ(turn_compute_angle((turn){1, 0}), 0);
    CHECK_EQ(turn_compute_angle((turn){0, 1}), HALF_PI);
}

// ---- poses in long double

typedef struct wide {
    long double x, y, z;
} wide;

static wide cross(wide a, wide b) {
    return (wide){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static wide add(wide a, wide b, long double s) { return (wide){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z}; }
static long double dot(wide a, wide b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static wide widen(ovoid_vec3 v) { return (wide){v.x, v.y, v.z}; }

// R(q) v
static wide rotate(ovoid_quat q, wide v) {
    wide p = {q.x, q.y, q.z};
    long double n = (long double)q.w * q.w + dot(p, p);
    wide c = cross(p, v), e = cross(p, c);
    return add(add(v, c, 2 * q.w / n), e, 2 / n);
}
// Rodrigues
static wide turn_about(wide axis, long double angle, wide v) {
    long double n = sqrtl(dot(axis, axis));
    if (!(n > 0)) return v;
    axis = (wide){axis.x / n, axis.y / n, axis.z / n};
    return add(add(v, cross(axis, v), sinl(angle)), cross(axis, cross(axis, v)), 1 - cosl(angle));
}
static long double apart(wide a, ovoid_vec3 b) {
    wide d = add(a, widen(b), -1);
    return sqrtl(dot(d, d));
}

static ovoid_quat random_quat(uint64_t *s) {
    double scale = exp(random_uniform(s, -30, 30));
    return (ovoid_quat){scale * random_normal(s), scale * random_normal(s), scale * random_normal(s),
                        scale * random_normal(s)};
}
static ovoid_vec3 random_vec3(uint64_t *s, double scale) {
    return (ovoid_vec3){scale * random_normal(s), scale * random_normal(s), scale * random_normal(s)};
}
static double norm(ovoid_vec3 v) { return vec3_norm(v); }

// Where a point of the body is: the exact motion against the computed pose.
static void check_point(const ovoid_motion *m, double time, wide truth, ovoid_vec3 local, double angle, double way) {
    ovoid_pose pose = ovoid_motion_compute_pose(m, time);
    wide x = add(rotate(pose.rotation, widen(local)), widen(pose.position), 1);
    ovoid_vec3 found = {(double)x.x, (double)x.y, (double)x.z};
    double arm = norm(local) + norm(m->pivot), most = 16 * way + 4 * norm(m->start.position) + 160 * norm(m->pivot);
    most += (160 + 16 * angle) * arm;
    // The found point is rounded to doubles here.
    CHECK_LE(apart(truth, found), U * (most + 4 * (arm + way + norm(m->start.position))));
}

static void check_velocity(uint64_t seed) {
    uint64_t s = check_seed = seed;
    double spin = exp(random_uniform(&s, -20, 8));
    ovoid_pose start = {random_vec3(&s, exp(random_uniform(&s, -5, 5))), random_quat(&s)};
    ovoid_motion m = ovoid_motion_make_velocity(start, random_vec3(&s, 3), random_vec3(&s, spin), 2.5);
    if (seed % 2) m.pivot = random_vec3(&s, 1);
    ovoid_vec3 local = random_vec3(&s, 2);
    CHECK_EQ(ovoid_motion_validate(&m, NULL), OVOID_OK);
    ovoid_pose first = ovoid_motion_compute_pose(&m, 0), before = ovoid_motion_compute_pose(&m, -3);
    CHECK(memcmp(&first, &start, sizeof first) == 0 && memcmp(&before, &start, sizeof first) == 0);
    for (int i = 0; i < 4; i++) {
        double t = i == 3 ? 2.5 : random_uniform(&s, 0, 2.5);
        wide w = widen(m.angular), c = add(rotate(start.rotation, widen(m.pivot)), widen(start.position), 1);
        wide arm = rotate(start.rotation, add(widen(local), widen(m.pivot), -1));
        long double angle = sqrtl(dot(w, w)) * t;
        wide x = add(add(c, widen(m.linear), t), turn_about(w, angle, arm), 1);
        check_point(&m, t, x, local, (double)angle, t * norm(m.linear));
    }
}

// Slerp by the relative rotation q1 q0^-1, its shorter half angle from atan2.
static wide slerp(const ovoid_pose *a, const ovoid_pose *b, long double share, wide local, double *turned) {
    ovoid_quat p = quat_scaled(a->rotation), q = quat_scaled(b->rotation);
    wide pv = {p.x, p.y, p.z}, qv = {q.x, q.y, q.z};
    long double w = (long double)q.w * p.w + dot(qv, pv);
    wide v = add(add((wide){qv.x * p.w, qv.y * p.w, qv.z * p.w}, pv, -q.w), cross(qv, pv), -1);
    if (w < 0) {
        w = -w;
        v = (wide){-v.x, -v.y, -v.z};
    }
    long double angle = 2 * atan2l(sqrtl(dot(v, v)), w);
    *turned = (double)(share * angle);
    wide at = add(widen(a->position), add(widen(b->position), widen(a->position), -1), share);
    return add(at, turn_about(v, share * angle, rotate(p, local)), 1);
}

static void check_poses(uint64_t seed) {
    uint64_t s = check_seed = seed;
    ovoid_pose a = {random_vec3(&s, 2), random_quat(&s)}, b = {random_vec3(&s, 2), random_quat(&s)};
    // Also nearly the same rotation, and nearly opposite quaternions.
    double tiny = exp(random_uniform(&s, -40, 0)), sign = seed % 4 == 1 ? -1 : 1;
    if (seed % 2)
        b.rotation = (ovoid_quat){sign * (a.rotation.w + tiny * a.rotation.x), sign * a.rotation.x,
                                  sign * (a.rotation.y - tiny * a.rotation.z), sign * a.rotation.z};
    ovoid_motion m = ovoid_motion_make_poses(a, b, 0.7);
    CHECK_EQ(ovoid_motion_validate(&m, NULL), OVOID_OK);
    ovoid_pose end = ovoid_motion_compute_pose(&m, 0.7), after = ovoid_motion_compute_pose(&m, 1e9);
    CHECK(memcmp(&end, &b, sizeof end) == 0 && memcmp(&after, &b, sizeof end) == 0);
    ovoid_vec3 local = random_vec3(&s, 2);
    for (int i = 0; i < 4; i++) {
        double t = random_uniform(&s, 0, 0.7), turned;
        wide x = slerp(&a, &b, (long double)t / 0.7, widen(local), &turned);
        check_point(&m, t, x, local, turned, norm(a.position) + norm(b.position));
    }
}

static void check_path(void) {
    const double times[4] = {-1, 0.25, 0.5, 4};
    ovoid_pose poses[4];
    uint64_t s = 5;
    for (int i = 0; i < 4; i++) poses[i] = (ovoid_pose){random_vec3(&s, 1), random_quat(&s)};
    ovoid_motion m = ovoid_motion_make_path(times, poses, 4);
    CHECK_EQ(ovoid_motion_validate(&m, NULL), OVOID_OK);
    for (int i = 0; i < 4; i++) {
        ovoid_pose at = ovoid_motion_compute_pose(&m, times[i]);
        CHECK(memcmp(&at, &poses[i], sizeof at) == 0);
    }
    ovoid_motion piece = ovoid_motion_make_poses(poses[2], poses[3], 3.5);
    ovoid_pose x = ovoid_motion_compute_pose(&m, 2.25), y = ovoid_motion_compute_pose(&piece, 1.75);
    CHECK(memcmp(&x, &y, sizeof x) == 0);
    ovoid_moving_shape moving = {.motion = m, .part = {{1, 2, 3}, {0.5, 0.1, 0.2, 0.3}}};
    ovoid_pose part = ovoid_moving_shape_compute_pose(&moving, 2.25),
               product = ovoid_pose_compute_product(&x, &moving.part);
    CHECK(memcmp(&part, &product, sizeof part) == 0);
}

// ---- bad motions

static void check_bad(const char *what, ovoid_motion m, ovoid_code code, int64_t place) {
    ovoid_error error = {0};
    ovoid_code found = ovoid_motion_validate(&m, &error);
    if (!CHECK_EQ(found, code) || !CHECK_EQ(error.place, place)) printf("  %s: %s\n", what, error.message);
    CHECK(strlen(error.message) > 20);
    ovoid_moving_shape moving = {.motion = m};
    CHECK(isnan(ovoid_moving_shape_compute_box(&moving, 0, 1).min.x));
}

static void check_refusals(void) {
    const ovoid_pose id = ovoid_pose_make_identity();
    const ovoid_vec3 zero = {0, 0, 0};
    ovoid_pose bad = id, none = id, far = id;
    bad.position.y = NAN;
    none.rotation.w = 0;
    far.position.z = 1e51;
    check_bad("NaN pose", ovoid_motion_make_still(bad), OVOID_ERROR_NOT_FINITE, -1);
    check_bad("no rotation", ovoid_motion_make_poses(id, none, 1), OVOID_ERROR_ROTATION, -1);
    check_bad("far", ovoid_motion_make_poses(id, far, 1), OVOID_ERROR_RANGE, -1);
    const double durations[5] = {0, -1, NAN, INFINITY, 1e101};
    for (int i = 0; i < 5; i++) {
        check_bad("duration", ovoid_motion_make_poses(id, id, durations[i]), OVOID_ERROR_ARGUMENT, -1);
        check_bad("duration", ovoid_motion_make_velocity(id, zero, zero, durations[i]), OVOID_ERROR_ARGUMENT, -1);
    }
    ovoid_motion m = ovoid_motion_make_velocity(id, (ovoid_vec3){0, INFINITY, 0}, zero, 1);
    check_bad("infinite velocity", m, OVOID_ERROR_NOT_FINITE, -1);
    m = ovoid_motion_make_velocity(id, zero, (ovoid_vec3){0, NAN, 0}, 1);
    check_bad("NaN spin", m, OVOID_ERROR_NOT_FINITE, -1);
    check_bad("too far", ovoid_motion_make_velocity(id, (ovoid_vec3){1e40, 0, 0}, zero, 1e20), OVOID_ERROR_RANGE, -1);
    check_bad("too many turns", ovoid_motion_make_velocity(id, zero, (ovoid_vec3){0, 2e9, 0}, 1), OVOID_ERROR_RANGE,
              -1);
    m = ovoid_motion_make_still(id);
    m.kind = (ovoid_motion_kind)7;
    check_bad("kind", m, OVOID_ERROR_ARGUMENT, -1);
    double times[3] = {0, 1, 1};
    ovoid_pose poses[3] = {id, id, id};
    check_bad("one pose", ovoid_motion_make_path(times, poses, 1), OVOID_ERROR_ARGUMENT, -1);
    check_bad("no poses", ovoid_motion_make_path(times, NULL, 3), OVOID_ERROR_ARGUMENT, -1);
    m = ovoid_motion_make_path(times, poses, 3);
    ovoid_error error;
    CHECK_EQ(ovoid_motion_validate(&m, &error), OVOID_ERROR_ARGUMENT);
    CHECK_EQ(error.place, 2);
    times[1] = NAN;
    check_bad("NaN time", ovoid_motion_make_path(times, poses, 3), OVOID_ERROR_RANGE, 1);
    times[1] = 0.5;
    poses[1] = none;
    check_bad("path's pose", ovoid_motion_make_path(times, poses, 3), OVOID_ERROR_ROTATION, 1);
    ovoid_moving_shape still = {.motion = ovoid_motion_make_still(id)};
    CHECK(isnan(ovoid_moving_shape_compute_box(&still, 1, 0).min.x));
    CHECK(isnan(ovoid_moving_shape_compute_box(&still, NAN, 0).min.x));
}

// ---- boxes

static void grow(ovoid_box *box, ovoid_vec3 x, double r) {
    box->min = (ovoid_vec3){fmin(box->min.x, x.x - r), fmin(box->min.y, x.y - r), fmin(box->min.z, x.z - r)};
    box->max = (ovoid_vec3){fmax(box->max.x, x.x + r), fmax(box->max.y, x.y + r), fmax(box->max.z, x.z + r)};
}

// What all vertices sweep at sampled times, and the largest of them about the pivot.
static ovoid_box sample(const ovoid_moving_shape *m, double begin, double end, double *reach) {
    ovoid_polytope p = ovoid_shape_get_polytope(m->shape);
    ovoid_box box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    *reach = 0;
    for (int i = 0; i <= 400; i++) {
        ovoid_pose pose = ovoid_moving_shape_compute_pose(m, begin + (end - begin) * i / 400);
        for (uint32_t v = 0; v < p.vertex_count; v++) {
            ovoid_vec3 x = vec3_add(p.origin, vec3_at(p.vertices, v));
            grow(&box, ovoid_pose_compute_point(&pose, x), ovoid_shape_get_radius(m->shape));
            *reach = fmax(*reach, vec3_norm(x) + vec3_norm(m->motion.pivot) + 2 * vec3_norm(m->part.position));
        }
    }
    return box;
}

static void check_box(const ovoid_moving_shape *m, double begin, double end, double turned) {
    double reach, slack;
    ovoid_box box = ovoid_moving_shape_compute_box(m, begin, end), inner = sample(m, begin, end, &reach);
    double low[3] = {inner.min.x - box.min.x, inner.min.y - box.min.y, inner.min.z - box.min.z};
    double high[3] = {box.max.x - inner.max.x, box.max.y - inner.max.y, box.max.z - inner.max.z};
    // A sampled vertex is up to turned / 400 of its way, squared, below the true extent; rounding is on both sides.
    double size = reach + vec3_max_abs(box.min) + vec3_max_abs(box.max);
    slack = 1e-12 * size;
    if (turned > 0) slack += reach * (turned <= 4 ? 1.0 / 32 + turned * turned / (8 * 400.0 * 400.0) : 2);
    for (int i = 0; i < 3; i++) {
        CHECK_LE(-1e-13 * size, low[i]);
        CHECK_LE(-1e-13 * size, high[i]);
        CHECK_LE(low[i], slack);
        CHECK_LE(high[i], slack);
    }
}

static void check_boxes(uint64_t seed) {
    uint64_t s = check_seed = seed;
    ovoid_shape *shape = bits_make_shape((bits_family)(seed % BITS_FAR), &s);
    const double spins[4] = {0, 0.3, 2.5, 700};
    double spin = spins[seed % 4];
    ovoid_vec3 axis = vec3_unit(random_vec3(&s, 1));
    ovoid_pose start = {random_vec3(&s, 3), random_quat(&s)}, end = {random_vec3(&s, 3), random_quat(&s)};
    ovoid_moving_shape m = {.shape = shape};
    m.motion = ovoid_motion_make_velocity(start, random_vec3(&s, 2), vec3_scale(axis, spin), 1);
    if (seed % 3 == 0) m.motion.pivot = random_vec3(&s, 1);
    if (seed % 5 == 0) m.part = (ovoid_pose){random_vec3(&s, 1), random_quat(&s)};
    check_box(&m, 0, 1, spin);
    check_box(&m, 0.25, 0.5, spin / 4);
    check_box(&m, 0.5, 0.5, 0);
    m.motion = ovoid_motion_make_poses(start, end, 2);
    check_box(&m, 0, 2, 3.2);
    const double times[3] = {0, 1, 3};
    const ovoid_pose poses[3] = {start, end, start};
    m.motion = ovoid_motion_make_path(times, poses, 3);
    check_box(&m, -1, 9, 3.2);
    m.motion = ovoid_motion_make_still(start);
    check_box(&m, -1e300, 1e300, 0);
    ovoid_shape_destroy(shape);
}

// A turn so slow that the reciprocal of its speed overflows turns by nothing that can be seen.
static void check_slow(void) {
    ovoid_shape *shape = ovoid_shape_create_box((ovoid_vec3){1, 2, 3}, NULL, NULL);
    const ovoid_pose start = {{1, 0, 0}, {1, 0, 0, 0}};
    const double speeds[] = {5e-324, 1e-310, 1e-300, 1e-280};
    for (int i = 0; i < 4; i++) {
        ovoid_moving_shape m = {
            shape,
            ovoid_motion_make_velocity(start, (ovoid_vec3){1, 0, 0}, (ovoid_vec3){0, speeds[i], 0}, 2),
            {{0, 0, 0}, {0, 0, 0, 0}}};
        ovoid_box box = ovoid_moving_shape_compute_box(&m, 0, 2);
        CHECK_NEAR(box.min.x, 0, 1e-12);
        CHECK_NEAR(box.max.x, 4, 1e-12);
        ovoid_pose end = ovoid_motion_compute_pose(&m.motion, 2);
        CHECK_NEAR(end.position.x, 3, 1e-15);
        CHECK_NEAR(end.rotation.y, 0, 1e-15);
        ovoid_moving_shape still = {shape, ovoid_motion_make_still((ovoid_pose){{4, 0, 0}, {1, 0, 0, 0}}), m.part};
        ovoid_impact x = ovoid_impact_find(&(ovoid_moving_pair){m, still, 0}, NULL);
        CHECK(x.status == OVOID_IMPACT_HIT && fabs(x.hit_at - 1) < 1e-6);
    }
    ovoid_shape_destroy(shape);
}

int main(void) {
    check_angles();
    for (uint64_t seed = 1; seed <= 500; seed++) check_velocity(seed);
    for (uint64_t seed = 1; seed <= 500; seed++) check_poses(seed);
    for (uint64_t seed = 1; seed <= 240; seed++) check_boxes(seed);
    check_seed = 0;
    check_path();
    check_refusals();
    check_slow();
    return check_end();
}
