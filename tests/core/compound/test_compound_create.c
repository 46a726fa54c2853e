// Making compounds: errors by name and place, memory that runs out at every allocation, the order, the outer and inner
// ellipsoids. Truth: the parts themselves, their vertices posed in double-double; the supports of spheres in closed
// form.
#include "compounds.h"
#include "countdown.h"
#include "linear/dd3.h"
#include "pairs.h"

// ---- what is refused

static void expect(const ovoid_posed_shape *parts, size_t count, ovoid_code code, int64_t place) {
    ovoid_error error = {0};
    ovoid_compound *c = ovoid_compound_create(parts, count, NULL, &error);
    CHECK(c == NULL);
    CHECK_EQ(error.code, code);
    CHECK_EQ(error.place, place);
    CHECK(error.message[0] != 0);
    CHECK(ovoid_compound_create(parts, count, NULL, NULL) == NULL);
    ovoid_compound_destroy(c);
}

static void check_errors(const ovoid_shape *shape) {
    const ovoid_pose here = {{0, 0, 0}, {1, 0, 0, 0}};
    ovoid_posed_shape parts[3] = {{shape, here}, {shape, here}, {shape, here}};
    expect(NULL, 3, OVOID_ERROR_EMPTY, -1);
    expect(parts, 0, OVOID_ERROR_EMPTY, -1);
    expect(parts, OVOID_COMPOUND_PARTS_MAX + 1, OVOID_ERROR_LIMIT, -1);
    parts[1].shape = NULL;
    expect(parts, 3, OVOID_ERROR_ARGUMENT, 1);
    parts[1].shape = shape;
    parts[2].pose.rotation = (ovoid_quat){0, 0, 0, 0};
    expect(parts, 3, OVOID_ERROR_ROTATION, 2);
    parts[2].pose.rotation.x = NAN;
    expect(parts, 3, OVOID_ERROR_NOT_FINITE, 2);
    parts[2].pose = here;
    parts[0].pose.position.y = INFINITY;
    expect(parts, 3, OVOID_ERROR_NOT_FINITE, 0);
    parts[0].pose.position.y = 1.1e50;
    expect(parts, 3, OVOID_ERROR_RANGE, 0);
    // Each coordinate is in range, the place is not.
    parts[0].pose.position = (ovoid_vec3){0.9e50, 0.9e50, 0};
    expect(parts, 3, OVOID_ERROR_RANGE, 0);
    ovoid_compound_destroy(NULL);
}

static void check_memory(ovoid_shape *const shapes[SHAPES]) {
    ovoid_posed_shape parts[SHAPES];
    for (int i = 0; i < SHAPES; i++) parts[i] = (ovoid_posed_shape){shapes[i], {{i, 0, 0}, {1, 0, 0, 0}}};
    for (long k = 0;; k++) {
        countdown memory = {k, 0};
        ovoid_allocator allocator = countdown_make_allocator(&memory);
        ovoid_error error = {0};
        ovoid_compound *c = ovoid_compound_create(parts, SHAPES, &(ovoid_compound_options){&allocator}, &error);
        if (c) {
            CHECK(k > 3);
            // All working memory has gone back.
            CHECK_EQ(memory.held, 1);
            ovoid_compound_destroy(c);
        } else
            CHECK_EQ(error.code, OVOID_ERROR_MEMORY);
        CHECK_EQ(memory.held, 0);
        if (c || k > 1000) break;
    }
}

// ---- what is made

static double find_support(const ovoid_posed_shape *part, ovoid_vec3 n) {
    ovoid_polytope p = ovoid_shape_get_polytope(part->shape);
    double most = -INFINITY;
    for (uint32_t k = 0; k < p.vertex_count; k++) {
        vec3 v = vec3_add(vec3_at(p.vertices, k), p.origin);
        most = fmax(most, vec3_dot(n, ovoid_pose_compute_point(&part->pose, v)));
    }
    return most + ovoid_shape_get_radius(part->shape);
}
static double find_ellipsoid_support(const ovoid_ellipsoid *e, ovoid_vec3 n) {
    return vec3_dot(n, e->center) + sqrt(fmax(sym3_quadratic(e->q, n), 0));
}

// How far a vertex is out of an ellipsoid, in its own measure: at most 1 where it is inside.
static double measure_vertex(const ovoid_ellipsoid *e, const ovoid_posed_shape *part, uint32_t k) {
    ovoid_polytope p = ovoid_shape_get_polytope(part->shape);
    vec3 v = vec3_at(p.vertices, k);
    dd3 local = {two_sum(v.x, p.origin.x), two_sum(v.y, p.origin.y), two_sum(v.z, p.origin.z)};
    dd33 r = dd33_from_quat(quat_scaled(part->pose.rotation));
    // The place as a sum of a double and a rest far below the error that is looked for.
    vec3 at = {dd_add(dd3_dot(r.r0, local), dd_from(part->pose.position.x)).high,
               dd_add(dd3_dot(r.r1, local), dd_from(part->pose.position.y)).high,
               dd_add(dd3_dot(r.r2, local), dd_from(part->pose.position.z)).high};
    return membership(e, at);
}

static void check_bounds(const ovoid_compound *c, uint64_t *s) {
    ovoid_ellipsoid outer = ovoid_compound_get_outer(c), inner = ovoid_compound_get_inner(c);
    size_t count = ovoid_compound_get_part_count(c);
    double size = sqrt(outer.q.xx + outer.q.yy + outer.q.zz) + vec3_norm(outer.center);
    for (size_t i = 0; i < count; i++) {
        ovoid_posed_shape part = ovoid_compound_get_part(c, i);
        ovoid_polytope p = ovoid_shape_get_polytope(part.shape);
        // A flat compound's Q is all but singular: directions only.
        for (uint32_t k = 0; k < p.vertex_count && count > 2; k++) CHECK_LE(measure_vertex(&outer, &part, k), 1);
    }
    int holder = -1;
    for (int i = 0; i < 200; i++) {
        vec3 n = random_unit(s);
        double most = -INFINITY, of_inner = find_ellipsoid_support(&inner, n);
        for (size_t k = 0; k < count; k++) {
            ovoid_posed_shape part = ovoid_compound_get_part(c, k);
            most = fmax(most, find_support(&part, n));
        }
        // What the test's own sums are off by.
        CHECK_LE(most, find_ellipsoid_support(&outer, n) + 1e-15 * size);
        CHECK_LE(of_inner, most + 1e-15 * size);
    }
    // The inner one is in one part.
    for (size_t k = 0; k < count && holder < 0; k++) {
        ovoid_posed_shape part = ovoid_compound_get_part(c, k);
        holder = (int)k;
        for (int i = 0; i < 200 && holder >= 0; i++) {
            vec3 n = random_unit(s);
            if (find_ellipsoid_support(&inner, n) > find_support(&part, n) + 1e-15 * size) holder = -1;
        }
    }
    CHECK(holder >= 0);
}

static void check_order(const ovoid_compound *c, const ovoid_posed_shape *parts) {
    size_t count = ovoid_compound_get_part_count(c);
    const uint32_t *order = ovoid_compound_get_order(c);
    uint8_t *seen = calloc(count, 1);
    for (size_t i = 0; i < count; i++) {
        CHECK(order[i] < count && !seen[order[i]]);
        if (order[i] < count) seen[order[i]] = 1;
        ovoid_posed_shape part = ovoid_compound_get_part(c, i);
        const ovoid_pose *p = &part.pose, *q = &parts[i].pose;
        CHECK(part.shape == parts[i].shape && p->position.x == q->position.x && p->rotation.z == q->rotation.z);
    }
    CHECK_LE(ovoid_compound_get_size(c), 472 * count + 1024);
    free(seen);
}

static void check_made(ovoid_shape *const shapes[SHAPES], double scale, uint64_t *s) {
    for (int round = 0; round < 12; round++) {
        check_seed = *s;
        size_t count = 1 + random_next(s) % 40;
        ovoid_posed_shape parts[40];
        for (size_t i = 0; i < count; i++)
            parts[i] = (ovoid_posed_shape){shapes[random_next(s) % (round % 2 ? 3 : SHAPES)],
                                           {random_vec3(s, scale * round), random_quat(s)}};
        ovoid_compound *a = ovoid_compound_create(parts, count, NULL, NULL);
        ovoid_compound *b = ovoid_compound_create(parts, count, NULL, NULL);
        if (CHECK(a && b)) {
            check_order(a, parts);
            check_bounds(a, s);
            CHECK(!memcmp(ovoid_compound_get_order(a), ovoid_compound_get_order(b), count * sizeof(uint32_t)));
        }
        ovoid_compound_destroy(a);
        ovoid_compound_destroy(b);
    }
    check_seed = 0;
}

// Spheres of different radii: the support of the set is known.
static void check_spheres(void) {
    ovoid_shape *big = ovoid_shape_create_sphere(2, NULL, NULL), *small = ovoid_shape_create_sphere(0.5, NULL, NULL);
    ovoid_posed_shape parts[2] = {{big, {{-3, 0, 0}, {1, 0, 0, 0}}}, {small, {{3, 1, 0}, {1, 2, 0, 0}}}};
    ovoid_compound *c = ovoid_compound_create(parts, 2, NULL, NULL);
    if (CHECK(c != NULL)) {
        ovoid_ellipsoid e = ovoid_compound_get_outer(c);
        uint64_t s = 5;
        for (int i = 0; i < 1000; i++) {
            vec3 n = random_unit(&s);
            CHECK_LE(fmax(-3 * n.x + 2, 3 * n.x + n.y + 0.5), find_ellipsoid_support(&e, n) + 1e-15);
        }
        CHECK_LE(find_ellipsoid_support(&e, (vec3){0, 0, 1}), 8);
    }
    ovoid_compound_destroy(c);
    ovoid_shape_destroy(big);
    ovoid_shape_destroy(small);
}

int main(void) {
    for (int i = 0; i < 3; i++) {
        static const double scales[3] = {1, 1e-9, 1e9};
        uint64_t s = 17 + (uint64_t)i;
        ovoid_shape *shapes[SHAPES];
        if (!make_shapes(shapes, scales[i], &s)) return check_end();
        check_errors(shapes[0]);
        if (i == 0) check_memory(shapes);
        check_made(shapes, scales[i], &s);
        destroy_shapes(shapes);
    }
    check_spheres();
    return check_end();
}
