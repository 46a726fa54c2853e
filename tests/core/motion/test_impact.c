// Times of impact, casts and rays whose truth is a closed form, and what must be refused. Every answer's steps are
// checked (ovoid_impact_verify). Tolerances: that of the time asked for, and rounding of the closed form.
#include "linear/vec3.h"
#include "moving.h"

static const ovoid_vec3 zero = {0, 0, 0};
static ovoid_step steps[20000];
enum { CAPACITY = sizeof steps / sizeof *steps };

static ovoid_pose at(double x, double y, double z) { return (ovoid_pose){{x, y, z}, {1, 0, 0, 0}}; }

static ovoid_moving_shape still(const ovoid_shape *shape, double x, double y, double z) {
    return (ovoid_moving_shape){.shape = shape, .motion = ovoid_motion_make_still(at(x, y, z))};
}
static ovoid_moving_shape moving(const ovoid_shape *shape, ovoid_pose start, ovoid_vec3 linear, ovoid_vec3 angular) {
    return (ovoid_moving_shape){.shape = shape, .motion = ovoid_motion_make_velocity(start, linear, angular, 1)};
}

static ovoid_impact find(const ovoid_moving_shape *a, const ovoid_moving_shape *b, double margin) {
    ovoid_motion_options o = {.steps = steps, .capacity = CAPACITY};
    ovoid_impact x = ovoid_impact_find(&(ovoid_moving_pair){*a, *b, margin}, &o);
    ovoid_error error;
    if (!CHECK_EQ(ovoid_impact_verify(&(ovoid_moving_pair){*a, *b, margin}, &x, &(ovoid_motion_basis){.steps = steps},
                                      &error),
                  OVOID_OK))
        printf("  %s\n", error.message);
    return x;
}

// Found at that time, within the tolerance of 1e-9 of the time asked about.
static void check_hit(const char *what, const ovoid_moving_shape *a, const ovoid_moving_shape *b, double margin,
                      double truth, double rounding) {
    ovoid_impact x = find(a, b, margin);
    int ok = CHECK_EQ(x.status, OVOID_IMPACT_HIT) && CHECK_EQ(x.limit, OVOID_LIMIT_NONE);
    ok &= CHECK_LE(x.free_until, truth + rounding) && CHECK_LE(truth - rounding, x.hit_at);
    ok &= CHECK_LE(x.hit_at - x.free_until, 1e-9);
    if (!ok) printf("  %s: [%.17g, %.17g], truth %.17g\n", what, x.free_until, x.hit_at, truth);
}

static void check_free(const char *what, const ovoid_moving_shape *a, const ovoid_moving_shape *b, double margin,
                       size_t most) {
    ovoid_impact x = find(a, b, margin);
    int ok = CHECK_EQ(x.status, OVOID_IMPACT_FREE) && CHECK_EQ(x.free_until, x.end) && CHECK(isinf(x.hit_at));
    ok &= CHECK_LE(x.step_count, most);
    if (!ok)
        printf("  %s: %s, free until %.17g, %zu steps\n", what, ovoid_impact_status_get_name(x.status), x.free_until,
               x.step_count);
}

// ---- closed forms

static void check_spheres(void) {
    uint64_t s = 3;
    ovoid_shape *ball = ovoid_shape_create_sphere(0.5, NULL, NULL);
    for (uint64_t i = 1; i <= 200; i++) {
        check_seed = i;
        ovoid_vec3 p = bits_vec3(&s, 6), v = bits_vec3(&s, 20);
        ovoid_moving_shape a = moving(ball, at(0, 0, 0), moving_scaled(v, -0.5), bits_vec3(&s, 50));
        ovoid_moving_shape b = moving(ball, at(p.x, p.y, p.z), moving_scaled(v, 0.5), bits_vec3(&s, 50));
        // |p + t v| = 1
        double vv = v.x * v.x + v.y * v.y + v.z * v.z, pv = p.x * v.x + p.y * v.y + p.z * v.z;
        double pp = p.x * p.x + p.y * p.y + p.z * p.z, root = pv * pv - vv * (pp - 1), t = (-pv - sqrt(root)) / vv;
        if (pp < 1.01 || fabs(root) < 1e-3 * vv || fabs(t - 1) < 1e-6) continue;
        if (root > 0 && pv < 0 && t < 1)
            check_hit("spheres", &a, &b, 0, t, 1e-12);
        else
            check_free("spheres", &a, &b, 0, 40);
    }
    check_seed = 0;
    ovoid_shape_destroy(ball);
}

static void check_box_and_wall(double scale) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){scale, scale, scale}, NULL, NULL);
    ovoid_shape *halfspace = ovoid_shape_create_box((ovoid_vec3){0.25 * scale, 8 * scale, 8 * scale}, NULL, NULL);
    ovoid_moving_shape a = still(halfspace, 0, 0, 0),
                       b = moving(box, at(5 * scale, 0, 0), (ovoid_vec3){-8 * scale, 0, 0}, zero);
    check_hit("box, wall", &a, &b, 0, 3.75 / 8, 1e-12);
    check_hit("box, wall, margin", &a, &b, 0.5 * scale, 3.25 / 8, 1e-12);
    b.motion.linear.x = -3.7499999 * scale;
    check_free("box stops before the wall", &a, &b, 0, 4);
    // Turning by 45 degrees about z toward the wall: the edge meets it when sqrt(2) sin(angle + 45 degrees) = D.
    b = moving(box, at(1.6 * scale, 0, 0), zero, (ovoid_vec3){0, 0, 0.78});
    check_hit("turning box", &a, &b, 0, (asin(1.35 / sqrt(2)) - 0.25 * acos(-1)) / 0.78, 1e-12);
    // The wall turns instead: its face x = 0.25 meets the box's edge at (0.6, 1).
    a = moving(halfspace, at(0, 0, 0), zero, (ovoid_vec3){0, 0, -1});
    b = still(box, 1.6 * scale, 0, 0);
    check_hit("turning wall", &a, &b, 0, acos(0.25 / hypot(0.6, 1)) - atan2(1, 0.6), 1e-12);
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(halfspace);
}

// A rod (capsule of radius 0.1 along x) turns about its middle toward a ball at distance 3, angle 1, through some turns
// away from it first: distance to its axis 3 sin(angle between) = 0.1 + 0.5.
static void check_rod(void) {
    ovoid_shape *rod = ovoid_shape_create_capsule(0.1, 5, NULL, NULL),
                *ball = ovoid_shape_create_sphere(0.5, NULL, NULL);
    ovoid_pose along_x = {{0, 0, 0}, {1, 0, 1, 0}};
    for (int k = 0; k < 8; k++) {
        double speed = 0.9 + 200 * k * k;
        ovoid_moving_shape a = moving(rod, along_x, zero, (ovoid_vec3){0, 0, speed});
        ovoid_moving_shape b = still(ball, 3 * cos(1), 3 * sin(1), 0);
        check_hit("rod, ball", &a, &b, 0, (1 - asin(0.2)) / speed, 1e-12);
        b = still(ball, 0, 0, 0.6 + 1e-6);
        check_free("rod under a ball", &a, &b, 0, 1);
        b = still(ball, 5.7, 0, 0.1);
        check_free("rod inside a ball's way", &a, &b, 0, 4);
    }
    ovoid_shape_destroy(rod);
    ovoid_shape_destroy(ball);
}

// A needle 1000 times as long as wide, at 1500 radians a unit of time, moved toward a wall.
static void check_needle(void) {
    ovoid_shape *needle = ovoid_shape_create_box((ovoid_vec3){1, 1e-3, 1e-3}, NULL, NULL);
    ovoid_shape *halfspace = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_moving_shape a = still(halfspace, 0, 0, 0);
    ovoid_moving_shape b = moving(needle, at(2.5, 0, 0), zero, (ovoid_vec3){0, 0, 1500});
    check_free("needle beside a wall", &a, &b, 0, 1);
    // Toward the wall: from time 0.5 on its tips can reach it, and do within a half turn.
    b.motion.linear.x = -1;
    ovoid_impact x = find(&a, &b, 0);
    CHECK_EQ(x.status, OVOID_IMPACT_HIT);
    CHECK_LE(x.hit_at - x.free_until, 1e-9);
    CHECK_LE(0.4999, x.free_until);
    CHECK_LE(x.hit_at, 0.5 + acos(-1) / 1500);
    // About its own axis it is thin at all times.
    b = moving(needle, at(0, 0, 1.0015), (ovoid_vec3){1e-4, 0, 0}, (ovoid_vec3){1500, 0, 0});
    check_free("needle about its axis", &a, &b, 0, 1);
    ovoid_shape_destroy(needle);
    ovoid_shape_destroy(halfspace);
}

// Bullets through thin plates: never a tunnel. The plane of the near face is met first.
static void check_bullets(void) {
    ovoid_shape *plate = ovoid_shape_create_box((ovoid_vec3){1e-6, 10, 10}, NULL, NULL);
    ovoid_shape *bullet = ovoid_shape_create_sphere(1e-3, NULL, NULL);
    ovoid_shape *shard = ovoid_shape_create_box((ovoid_vec3){1e-3, 1e-3, 1e-3}, NULL, NULL);
    uint64_t s = 9;
    for (uint64_t i = 1; i <= 300; i++) {
        check_seed = i;
        double speed = exp(random_uniform(&s, 0, 16));
        ovoid_vec3 aim = bits_vec3(&s, 5), from = {random_uniform(&s, 1, 9), aim.y, aim.z};
        ovoid_vec3 v = {-speed * random_uniform(&s, 10, 20), aim.z, -aim.y};
        ovoid_moving_shape a = still(plate, 0, 0, 0), b = moving(bullet, at(from.x, from.y, from.z), v, zero);
        check_hit("bullet", &a, &b, 0, (from.x - 1e-6 - 1e-3) / -v.x, 1e-12);
        b.shape = shard;
        b.motion.angular = bits_vec3(&s, 3000);
        ovoid_impact x = find(&a, &b, 0);
        CHECK_EQ(x.status, OVOID_IMPACT_HIT);
        CHECK_LE((from.x - 2e-3) / -v.x, x.hit_at);
        CHECK_LE(x.free_until, (from.x - 1e-3) / -v.x);
    }
    check_seed = 0;
    ovoid_shape_destroy(plate);
    ovoid_shape_destroy(bullet);
    ovoid_shape_destroy(shard);
}

// The unit of time is the caller's.
static void check_durations(void) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_pose from = {{3, 0.2, 0.1}, {1, 0.2, 0.1, 0}}, to = {{-3, 0, 0.3}, {1, 0, 0.5, 0.7}};
    ovoid_moving_shape a = moving(box, at(0, 0, 0), zero, (ovoid_vec3){0.5, 0, 0}), b = {.shape = box};
    double first = 0;
    for (int e = -300; e <= 330; e += 30) {
        double unit = ldexp(1, e);
        a.motion.duration = unit;
        a.motion.angular.x = 0.5 / unit;
        b.motion = ovoid_motion_make_poses(from, to, unit);
        ovoid_impact x = find(&a, &b, 0);
        CHECK_EQ(x.status, OVOID_IMPACT_HIT);
        CHECK_LE((x.hit_at - x.free_until) / unit, 1e-9);
        if (e == -300) first = x.hit_at / unit;
        CHECK_NEAR(x.hit_at / unit, first, 1e-9);
    }
    ovoid_shape_destroy(box);
}

// ---- near the margin, at rest

static void check_near(void) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_shape *ball = ovoid_shape_create_sphere(0.5, NULL, NULL);
    ovoid_moving_shape a = still(box, 0, 0, 0);
    // Past a face, an edge: 1e-9 above, 1e-9 below, touching.
    for (int k = -1; k <= 1; k++) {
        ovoid_moving_shape b = moving(ball, at(-4, 0, 1.5 + 1e-9 * k), (ovoid_vec3){8, 0, 0}, (ovoid_vec3){0, 30, 0});
        ovoid_impact x = find(&a, &b, 0);
        CHECK_EQ(x.status, k > 0 ? OVOID_IMPACT_FREE : k < 0 ? OVOID_IMPACT_HIT : OVOID_IMPACT_UNDECIDED);
        if (k == 0) CHECK_EQ(x.limit, OVOID_LIMIT_PRECISION);
        if (k <= 0) CHECK_NEAR(x.free_until, 3.0 / 8, 1e-4);
    }
    // At rest: apart, touching, overlapping; a begin within the margin.
    ovoid_moving_shape b = still(box, 3, 0, 0);
    ovoid_impact x = find(&a, &b, 0);
    CHECK_EQ(x.status, OVOID_IMPACT_FREE);
    CHECK(x.begin == 0 && x.end == 0 && x.free_until == 0 && x.step_count == 0);
    x = find(&a, &b, 1.5);
    CHECK(x.status == OVOID_IMPACT_HIT && x.hit_at == 0 && x.free_until == 0);
    b = still(box, 2, 0, 0);
    x = find(&a, &b, 0);
    CHECK(x.status == OVOID_IMPACT_UNDECIDED && x.limit == OVOID_LIMIT_PRECISION);
    b = moving(box, at(1.9, 0, 0), (ovoid_vec3){5, 0, 0}, zero);
    x = find(&a, &b, 0);
    CHECK(x.status == OVOID_IMPACT_HIT && x.hit_at == 0 && x.free_until == 0);
    // Both the same motion, a hundred turns: the gap never changes.
    a = moving(box, at(0, 0, 0), (ovoid_vec3){1, 2, 3}, (ovoid_vec3){300, -500, 200});
    b = a;
    b.part = at(2.001, 0, 0);
    check_free("the same motion", &a, &b, 0, 1);
    b.part = at(1.999, 0, 0);
    x = find(&a, &b, 0);
    CHECK(x.status == OVOID_IMPACT_HIT && x.hit_at == 0);
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(ball);
}

// ---- casts and rays

static void check_casts(double scale) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){scale, scale, scale}, NULL, NULL);
    ovoid_shape *round =
        ovoid_shape_create_box((ovoid_vec3){scale, scale, scale}, &(ovoid_shape_options){.radius = 0.25 * scale}, NULL);
    ovoid_pair pair = {box, round, at(0, 0, 0), at(4 * scale, 0.3 * scale, 0)};
    ovoid_impact x = ovoid_shape_cast(&pair, (ovoid_vec3){-8 * scale, 0, 0}, 0, NULL);
    CHECK(x.status == OVOID_IMPACT_HIT && x.limit == OVOID_LIMIT_NONE);
    CHECK_LE(x.free_until, 1.75 / 8);
    CHECK_LE(1.75 / 8, x.hit_at);
    CHECK_LE(x.hit_at - x.free_until, 2e-12);
    CHECK_NEAR(x.free.normal.x, 1, 1e-9);
    CHECK_NEAR(x.free.point_a.x, scale, 1e-9 * scale);
    // Corner on corner: rounded corner (r = 1/4) along the diagonal of both cubes.
    pair.pose_b = at(5 * scale, 5 * scale, 5 * scale);
    x = ovoid_shape_cast(&pair, (ovoid_vec3){-4 * scale, -4 * scale, -4 * scale}, 0, NULL);
    double t = (3 - 0.25 / sqrt(3)) / 4;
    CHECK(x.status == OVOID_IMPACT_HIT && x.free_until <= t + 1e-15 && t - 1e-15 <= x.hit_at);
    CHECK_LE(x.hit_at - x.free_until, 2e-12);
    x = ovoid_shape_cast(&pair, (ovoid_vec3){-4 * scale, 0, 0}, 0, NULL);
    CHECK_EQ(x.status, OVOID_IMPACT_FREE);
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(round);
}

static void check_ray(const ovoid_posed_shape *body, ovoid_ray ray, ovoid_impact_status status, double t,
                      double width) {
    ovoid_ray_hit x = ovoid_shape_cast_ray(body, &ray);
    if (!CHECK_EQ(x.status, status)) printf("  limit %s\n", ovoid_limit_get_name(x.limit));
    CHECK_LE(x.lower, t);
    if (status == OVOID_IMPACT_HIT) {
        CHECK_LE(t, x.upper);
        CHECK_LE(x.upper - x.lower, width);
        CHECK_NEAR(vec3_norm(x.normal), 1, 1e-12);
    }
}

static void check_rays(double scale) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){scale, 2 * scale, 3 * scale}, NULL, NULL);
    ovoid_shape *ball = ovoid_shape_create_sphere(scale, NULL, NULL);
    ovoid_shape *plate = ovoid_shape_create_box((ovoid_vec3){0, scale, scale}, NULL, NULL);
    ovoid_posed_shape body = {box, at(10 * scale, 0, 0)};
    double w = 1e-10; // of a way of 20 sizes
    ovoid_ray ray = {{0, scale, scale}, {2 * scale, 0, 0}, INFINITY, 0};
    check_ray(&body, ray, OVOID_IMPACT_HIT, 4.5, w);
    ray.radius = 0.5 * scale;
    check_ray(&body, ray, OVOID_IMPACT_HIT, 4.25, w);
    ray.length = 4.2;
    check_ray(&body, ray, OVOID_IMPACT_FREE, 4.2, 0);
    ray = (ovoid_ray){{10.5 * scale, 0.1 * scale, 0}, {0, 0, 1}, INFINITY, 0};
    check_ray(&body, ray, OVOID_IMPACT_HIT, 0, 0);
    ovoid_ray_hit x = ovoid_shape_cast_ray(&body, &ray);
    CHECK_NEAR(x.point.x, 11 * scale, 1e-9 * scale);
    CHECK_NEAR(x.normal.x, 1, 1e-9);
    ray = (ovoid_ray){{0, 2.001 * scale, 0}, {1, 0, 0}, INFINITY, 0};
    x = ovoid_shape_cast_ray(&body, &ray);
    CHECK(x.status == OVOID_IMPACT_FREE && isinf(x.lower) && isinf(x.upper));
    ray.direction.x = -1;
    ray.origin.y = 0;
    CHECK_EQ(ovoid_shape_cast_ray(&body, &ray).status, OVOID_IMPACT_FREE);
    // Along a rod that begins beside the ray's origin, to its far end.
    ovoid_shape *rod = ovoid_shape_create_box((ovoid_vec3){10 * scale, 0.1 * scale, 0.1 * scale}, NULL, NULL);
    body = (ovoid_posed_shape){rod, at(0, 0, 0)};
    ray = (ovoid_ray){{0, 0.2 * scale, 0}, {9.9 * scale, -0.1 * scale, 0}, INFINITY, 0};
    check_ray(&body, ray, OVOID_IMPACT_HIT, 1, 1e-8);
    ovoid_shape_destroy(rod);
    // A ball: t = b - sqrt(b^2 - c), any direction's length.
    body = (ovoid_posed_shape){ball, at(0, 0, 0)};
    ray = (ovoid_ray){{3 * scale, 0.5 * scale, 0}, {-1e-3 * scale, 0, 0}, INFINITY, 0};
    check_ray(&body, ray, OVOID_IMPACT_HIT, (3 - sqrt(0.75)) * 1e3, 1e-8);
    // Without an inside nothing is proven, and said so; a thick ray is.
    body = (ovoid_posed_shape){plate, at(0, 0, 0)};
    ray.direction = (ovoid_vec3){-scale, 0, 0};
    x = ovoid_shape_cast_ray(&body, &ray);
    CHECK(x.status == OVOID_IMPACT_UNDECIDED && x.limit == OVOID_LIMIT_PRECISION);
    CHECK_NEAR(x.lower, 3, 1e-9);
    ray.radius = 1e-6 * scale;
    check_ray(&body, ray, OVOID_IMPACT_HIT, 3 - 1e-6, w);
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(ball);
    ovoid_shape_destroy(plate);
}

// Random rays against random polyhedra: the planes of the facets clip the ray. Left out is what meets a facet so flatly
// that the planes' own rounding (64 u) shows.
static void check_clipped(uint64_t seed) {
    static const bits_family families[5] = {BITS_PLAIN, BITS_ROUND, BITS_LARGE, BITS_NEEDLE, BITS_TINY};
    uint64_t s = check_seed = seed;
    double scale = bits_scale(families[seed % 5]);
    ovoid_shape *shape = bits_make_shape(families[seed % 5], &s);
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    ovoid_posed_shape body = {shape, moving_make_pose(&s, scale)};
    for (int i = 0; i < 20 && ovoid_shape_get_radius(shape) == 0; i++) {
        ovoid_ray ray = {.length = i % 3 ? INFINITY : 1, .origin = bits_vec3(&s, 3 * scale)};
        ovoid_vec3 aim =
            ovoid_pose_compute_point(&body.pose, vec3_add(p.origin, vec3_at(p.vertices, (size_t)i % p.vertex_count)));
        ray.direction = vec3_sub(vec3_add(aim, bits_vec3(&s, 0.1 * scale)), ray.origin);
        ovoid_vec3 o = vec3_sub(ovoid_pose_compute_local_point(&body.pose, ray.origin), p.origin);
        ovoid_vec3 tip =
            vec3_sub(ovoid_pose_compute_local_point(&body.pose, vec3_add(ray.origin, ray.direction)), p.origin);
        double enter = 0, leave = ray.length, flattest = 1;
        for (uint32_t f = 0; f < p.facet_count; f++) {
            double speed = vec3_dot(p.planes[f].normal, vec3_sub(tip, o));
            double room = p.planes[f].offset - vec3_dot(p.planes[f].normal, o);
            flattest = fmin(flattest, fabs(speed) / vec3_norm(ray.direction));
            if (speed < 0) enter = fmax(enter, room / speed);
            if (speed > 0) leave = fmin(leave, room / speed);
        }
        if (flattest < 1e-3 || fabs(leave - enter) < 1e-6) continue;
        ovoid_ray_hit x = ovoid_shape_cast_ray(&body, &ray);
        CHECK_EQ(x.status, enter < leave ? OVOID_IMPACT_HIT : OVOID_IMPACT_FREE);
        if (enter < leave) CHECK(x.lower - 1e-10 <= enter && enter <= x.upper + 1e-10 && x.upper - x.lower <= 1e-10);
        if (enter < leave && enter > 1e-9) CHECK_LE(vec3_dot(x.normal, ray.direction), 0);
    }
    ovoid_shape_destroy(shape);
}

// ---- refusals

static void check_refused(const ovoid_moving_shape *a, const ovoid_moving_shape *b, double margin,
                          const ovoid_motion_options *o, ovoid_limit limit) {
    ovoid_impact x = ovoid_impact_find(&(ovoid_moving_pair){*a, *b, margin}, o);
    CHECK_EQ(x.status, OVOID_IMPACT_UNDECIDED);
    if (!CHECK_EQ(x.limit, limit)) printf("  %s\n", ovoid_limit_get_name(x.limit));
    CHECK(x.free_until == 0 && isinf(x.hit_at) && x.step_count == 0);
    CHECK_EQ(ovoid_impact_verify(&(ovoid_moving_pair){*a, *b, margin}, &x, &(ovoid_motion_basis){.options = o}, NULL),
             OVOID_OK);
    if (!(margin >= 0 && margin < INFINITY)) return;
    ovoid_approach y = ovoid_approach_find(&(ovoid_moving_pair){*a, *b, 0}, o);
    CHECK(y.limit == limit && y.lower == -INFINITY && y.upper == INFINITY);
    CHECK_EQ(ovoid_approach_verify(&(ovoid_moving_pair){*a, *b, 0}, &y, &(ovoid_motion_basis){.options = o}, NULL),
             OVOID_OK);
}

static void check_refusals(void) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_moving_shape a = still(box, 0, 0, 0), b = moving(box, at(5, 0, 0), (ovoid_vec3){-1, 0, 0}, zero), c = b;
    check_refused(&a, &b, NAN, NULL, OVOID_LIMIT_OPTIONS);
    check_refused(&a, &b, -1, NULL, OVOID_LIMIT_OPTIONS);
    check_refused(&a, &b, INFINITY, NULL, OVOID_LIMIT_OPTIONS);
    const ovoid_motion_options bad[6] = {
        {.begin = NAN}, {.end = 2}, {.begin = -1}, {.begin = 0.5, .end = 0.25}, {.tolerance = -1}, {.tolerance = NAN}};
    for (int i = 0; i < 6; i++) check_refused(&a, &b, 0, &bad[i], OVOID_LIMIT_OPTIONS);
    c.motion.duration = -1;
    check_refused(&a, &c, 0, NULL, OVOID_LIMIT_POSE_B);
    check_refused(&c, &a, 0, NULL, OVOID_LIMIT_POSE_A);
    c = b;
    c.part.position.x = 1; // a place without a rotation
    check_refused(&a, &c, 0, NULL, OVOID_LIMIT_POSE_B);
    check_refused(&c, &a, 0, NULL, OVOID_LIMIT_POSE_A);
    const double times[3] = {0, 2, 1};
    const ovoid_pose poses[3] = {at(5, 0, 0), at(6, 0, 0), at(7, 0, 0)};
    c.part = (ovoid_pose){{0, 0, 0}, {0, 0, 0, 0}};
    c.motion = ovoid_motion_make_path(times, poses, 3);
    check_refused(&a, &c, 0, NULL, OVOID_LIMIT_POSE_B);
    c.motion = ovoid_motion_make_path(NULL, NULL, 0);
    check_refused(&a, &c, 0, NULL, OVOID_LIMIT_POSE_B);
    ovoid_pair pair = {box, box, at(0, 0, 0), at(5, 0, 0)};
    CHECK_EQ(ovoid_shape_cast(&pair, (ovoid_vec3){0, NAN, 0}, 0, NULL).limit, OVOID_LIMIT_POSE_B);
    pair.pose_a.rotation.w = 0;
    CHECK_EQ(ovoid_shape_cast(&pair, zero, 0, NULL).limit, OVOID_LIMIT_POSE_A);
    ovoid_posed_shape body = {box, at(0, 0, 0)};
    const ovoid_ray rays[5] = {{{0, NAN, 0}, {1, 0, 0}, 1, 0},
                               {{0, 0, 0}, {0, 0, 0}, 1, 0},
                               {{0, 0, 0}, {1, INFINITY, 0}, 1, 0},
                               {{0, 0, 0}, {1, 0, 0}, -1, 0},
                               {{0, 0, 0}, {1, 0, 0}, 1, NAN}};
    for (int i = 0; i < 5; i++) CHECK_EQ(ovoid_shape_cast_ray(&body, &rays[i]).limit, OVOID_LIMIT_OPTIONS);
    body.pose.position.z = INFINITY;
    CHECK_EQ(ovoid_shape_cast_ray(&body, &(ovoid_ray){{5, 0, 0}, {1, 0, 0}, 1, 0}).limit, OVOID_LIMIT_POSE_B);
    ovoid_shape_destroy(box);
}

int main(void) {
    check_spheres();
    const double scales[3] = {1, 0x1p-30, 0x1p30};
    for (int i = 0; i < 3; i++) {
        check_box_and_wall(scales[i]);
        check_casts(scales[i]);
        check_rays(scales[i]);
    }
    check_rod();
    check_needle();
    check_bullets();
    check_durations();
    check_near();
    for (uint64_t seed = 1; seed <= 150; seed++) check_clipped(seed);
    check_seed = 0;
    check_refusals();
    return check_end();
}
