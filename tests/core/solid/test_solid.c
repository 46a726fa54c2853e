// Solids against brute force over all pairs of triangles in extended precision, and every answer through its own check.
// What is inside is decided there by solid angles, which share nothing with the exact crossings of a ray. Long double
// has 11 bits more than double, so its distances are trusted to 1e-16 of the size; answers are claimed to 1e-9 of it.
#include "solids.h"

enum { CAPACITY = 60000 };
static ovoid_exclusion items[CAPACITY];

static void check_answer(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_exclusions *all) {
    ovoid_error error = {.message = ""};
    CHECK(all->count <= all->capacity);
    if (!CHECK_EQ(ovoid_body_verify(pair, x, &(ovoid_body_basis){.exclusions = all}, &error), OVOID_OK))
        printf("  %s\n", error.message);
}

static void check_sign(const ovoid_body_answer *x, solid_truth t, double slack) {
    if (t.is_common) CHECK(x->status == OVOID_OVERLAPPING || t.surfaces <= slack);
    if (t.is_common) CHECK(x->status != OVOID_SEPARATED);
    if (!t.is_common) CHECK(x->status == OVOID_SEPARATED || t.surfaces <= slack);
    if (!t.is_common) CHECK(x->status != OVOID_OVERLAPPING);
    if (!t.is_common) CHECK_LE(x->lower, t.surfaces + slack);
    if (!t.is_common) CHECK_LE(t.surfaces, x->upper + slack);
}

static void check_pair(const ovoid_body_pair *pair, solid_truth t, double size, uint64_t *s) {
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
    double slack = 1e-12 * size, tolerance = 1.01e-9 * size;
    ovoid_body_answer distance = ovoid_body_distance(pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    check_answer(pair, &distance, &all);
    check_sign(&distance, t, slack);
    if (distance.status == OVOID_SEPARATED) CHECK_LE(distance.upper - distance.lower, tolerance);
    if (distance.status == OVOID_SEPARATED) CHECK_EQ(distance.limit, OVOID_LIMIT_NONE);

    ovoid_body_answer collide = ovoid_body_collide(pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    check_answer(pair, &collide, &all);
    check_sign(&collide, t, slack);

    double margin = t.surfaces * random_uniform(s, 0.5, 2);
    ovoid_body_answer within = ovoid_body_within(pair, margin, NULL, &(ovoid_body_evidence){.exclusions = &all});
    check_answer(pair, &within, &all);
    int is = ovoid_body_answer_is_within(&within, margin);
    if (!t.is_common && t.surfaces > margin + tolerance) CHECK_EQ(is, 0);
    if (t.is_common || t.surfaces < margin - tolerance) CHECK(is == 1 || t.surfaces <= slack);

    // From the last answer, and from nonsense: the same truth.
    ovoid_body_proof earlier = {distance.part_a, distance.part_b, distance.deciding.proof};
    ovoid_body_answer again =
        ovoid_body_distance(pair, NULL, &(ovoid_body_evidence){.earlier = &earlier, .exclusions = &all});
    check_answer(pair, &again, &all);
    check_sign(&again, t, slack);
    earlier.part_a = (uint32_t)(random_next(s) % 200), earlier.part_b = (uint32_t)(random_next(s) % 200);
    again = ovoid_body_collide(pair, NULL, &(ovoid_body_evidence){.earlier = &earlier, .exclusions = &all});
    check_answer(pair, &again, &all);
    check_sign(&again, t, slack);

    // A cap below the distance: proven farther.
    ovoid_options options = {.cap = 0.5 * t.surfaces};
    if (t.is_common || t.surfaces <= tolerance) return;
    again = ovoid_body_distance(pair, &options, &(ovoid_body_evidence){.exclusions = &all});
    check_answer(pair, &again, &all);
    CHECK_LE(options.cap, again.lower);
}

static void check_random(int rounds, double scale, uint64_t seed) {
    int common = 0, inside = 0;
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = seed + (uint64_t)i;
        mesh a = {NULL, NULL, 0, 0, 0, 0}, b = a;
        mesh_add_random(&a, scale, &s);
        mesh_add_random(&b, scale * (i % 5 == 0 ? 0.05 : random_uniform(&s, 0.3, 1.5)), &s);
        ovoid_solid *sa = mesh_make_solid(&a), *sb = mesh_make_solid(&b);
        if (CHECK(sa && sb)) {
            double apart = scale * random_uniform(&s, 0, i % 5 == 0 ? 0.5 : 2.5);
            ovoid_body_pair pair = {{.solid = sa, .pose = {random_vec3(&s, scale), random_quat(&s)}},
                                    {.solid = sb, .pose = ovoid_pose_make_identity()}};
            pair.b.pose = (ovoid_pose){random_vec3(&s, apart), random_quat(&s)};
            ovoid_vec3 at = pair.a.pose.position;
            pair.b.pose.position.x += at.x, pair.b.pose.position.y += at.y, pair.b.pose.position.z += at.z;
            solid_truth t = find_solid_truth(&a, &pair.a.pose, &b, &pair.b.pose);
            common += t.is_common;
            inside += t.is_common && t.surfaces > 0;
            check_pair(&pair, t, 6 * scale, &s);
        }
        ovoid_solid_destroy(sa);
        ovoid_solid_destroy(sb);
        mesh_clear(&a);
        mesh_clear(&b);
    }
    check_seed = 0;
    printf("%d pairs of scale %g: %d have points in common, %d by containment\n", rounds, scale, common, inside);
    CHECK(common > 0 && common < rounds && (inside > 0 || scale != 1));
}

// A flat wedge, turned: the box along its sides has another centre than the box along the axes.
static void add_wedge(mesh *m, uint64_t *s) {
    static const double corners[6][3] = {{0, 0, 0}, {20, 0, 0}, {0, 5, 0}, {0, 0, 1}, {20, 0, 1}, {0, 5, 1}};
    static const uint32_t sides[8][3] = {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3},
                                         {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}};
    ovoid_pose turned = {{0, 0, 0}, random_quat(s)};
    for (int i = 0; i < 6; i++) {
        ovoid_vec3 p = ovoid_pose_compute_point(&turned, (ovoid_vec3){corners[i][0], corners[i][1], corners[i][2]});
        mesh_add_point(m, p.x, p.y, p.z);
    }
    for (int i = 0; i < 8; i++) mesh_add_triangle(m, sides[i][0], sides[i][1], sides[i][2]);
}

static void add_needle(mesh *m, uint64_t *s) {
    mesh_add_star(m, (ovoid_vec3){0, 0, 0}, 1, 5, 6, 0.3, s);
    for (size_t p = 0; p < m->points; p++) m->xyz[3 * p] *= 20;
}

// A yes or no, and a margin, with the last proof: the same verdict, and of bodies that are farther apart than was asked
// no more bounds than without it.
static void check_warm_cost(const ovoid_body_pair *pair, double margin) {
    for (int i = 0; i < 2; i++) {
        double m = i ? margin : 0;
        ovoid_body_answer cold = i ? ovoid_body_within(pair, m, NULL, NULL) : ovoid_body_collide(pair, NULL, NULL);
        ovoid_body_proof proof = ovoid_body_answer_get_proof(&cold);
        const ovoid_body_evidence known = {.earlier = &proof};
        ovoid_body_answer warm = i ? ovoid_body_within(pair, m, NULL, &known) : ovoid_body_collide(pair, NULL, &known);
        CHECK(warm.status == cold.status);
        CHECK(ovoid_body_answer_is_within(&warm, m) == ovoid_body_answer_is_within(&cold, m));
        if (cold.lower > m) CHECK_LE(warm.visited, cold.visited);
    }
}

// Two needles or wedges side by side: the balls around them overlap, and where the boxes of their roots part them,
// these answer.
static void check_needles(int rounds, uint64_t seed) {
    int by_boxes = 0, others = 0;
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = seed + (uint64_t)i;
        mesh needle[2] = {{NULL, NULL, 0, 0, 0, 0}, {NULL, NULL, 0, 0, 0, 0}};
        ovoid_solid *solids[2];
        for (int k = 0; k < 2; k++) {
            (i % 3 ? add_wedge : add_needle)(&needle[k], &s);
            solids[k] = mesh_make_solid(&needle[k]);
        }
        ovoid_body_pair pair = {{.solid = solids[0], .pose = {random_vec3(&s, i % 4 ? 1 : 1e4), random_quat(&s)}},
                                {.solid = solids[1]}};
        ovoid_vec3 way = random_vec3(&s, 12), at = pair.a.pose.position;
        pair.b.pose = (ovoid_pose){{at.x + way.x, at.y + way.y, at.z + way.z}, random_quat(&s)};
        solid_truth t = find_solid_truth(&needle[0], &pair.a.pose, &needle[1], &pair.b.pose);
        check_pair(&pair, t, i % 4 ? 80 : 4e4, &s);
        ovoid_exclusion roots;
        ovoid_exclusions all = {.items = &roots, .capacity = 1};
        double margin = t.surfaces * random_uniform(&s, 0, 1);
        ovoid_body_answer x = ovoid_body_within(&pair, margin, NULL, &(ovoid_body_evidence){.exclusions = &all});
        int is_first = x.tested == 0;
        by_boxes += is_first;
        others += !is_first;
        // One exclusion shows it, and the points are vertices of both.
        if (is_first) {
            check_answer(&pair, &x, &all);
            CHECK(all.count == 1 && x.visited == 1 && x.status == OVOID_SEPARATED && x.lower > margin);
            CHECK(x.lower <= t.surfaces && t.surfaces <= x.upper);
        }
        check_warm_cost(&pair, margin);
        for (int k = 0; k < 2; k++) ovoid_solid_destroy(solids[k]), mesh_clear(&needle[k]);
    }
    check_seed = 0;
    printf("%d pairs of needles and wedges: %d answered by the boxes of their roots\n", rounds, by_boxes);
    CHECK_LE(rounds / 8, by_boxes);
    CHECK_LE(rounds / 8, others);
}

// A solid and a shape, which is a solid of its own hull's triangles to brute force.
static void check_shapes(int rounds, uint64_t seed) {
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = seed + (uint64_t)i;
        mesh a = {NULL, NULL, 0, 0, 0, 0}, b = a;
        mesh_add_random(&a, 1, &s);
        double points[30];
        size_t count = 4 + random_next(&s) % 7;
        double size = i % 3 ? 1 : 0.05;
        for (size_t k = 0; k < 3 * count; k++) points[k] = random_uniform(&s, -size, size) + (i % 4 == 3 ? 1000 : 0);
        ovoid_shape *shape = ovoid_shape_create_from_points(points, count, NULL, NULL);
        ovoid_solid *solid = mesh_make_solid(&a);
        if (CHECK(shape && solid)) {
            ovoid_polytope p = ovoid_shape_get_polytope(shape);
            for (uint32_t k = 0; k < p.vertex_count; k++)
                mesh_add_point(&b, p.vertices[3 * k] + p.origin.x, p.vertices[3 * k + 1] + p.origin.y,
                               p.vertices[3 * k + 2] + p.origin.z);
            for (uint32_t k = 0; k < p.triangle_count; k++)
                mesh_add_triangle(&b, p.triangles[3 * k], p.triangles[3 * k + 1], p.triangles[3 * k + 2]);
            double far = i % 4 == 3 ? -1000 : 0;
            ovoid_body_pair pair = {{.solid = solid, .pose = {{0, 0, 0}, random_quat(&s)}},
                                    {.shape = shape, .pose = ovoid_pose_make_identity()}};
            pair.b.pose.position = random_vec3(&s, 1.5);
            pair.b.pose.position.x += far, pair.b.pose.position.y += far, pair.b.pose.position.z += far;
            solid_truth t = find_solid_truth(&a, &pair.a.pose, &b, &pair.b.pose);
            check_pair(&pair, t, far < 0 ? 4000 : 9, &s);
            ovoid_body_pair turned = {pair.b, pair.a};
            check_pair(&turned, t, far < 0 ? 4000 : 9, &s);
        }
        ovoid_solid_destroy(solid);
        ovoid_shape_destroy(shape);
        mesh_clear(&a);
        mesh_clear(&b);
    }
    check_seed = 0;
}

// A ring of 40 mm whose tube is 10 mm thick, and a peg of 10 mm in its hole, as meshes of many sides. The hole's radius
// is 15 - 5 = 10 at its narrowest, the peg's 5: apart by 5 but for what flat sides take away, of which the cosine of
// half a side's angle is the share.
static void check_peg(void) {
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    uint64_t s = 1;
    mesh_add_ring(&m, 15, 5, 360, 60, 0, &s);
    ovoid_solid *ring = mesh_make_solid(&m);
    ovoid_shape *peg = ovoid_shape_create_prism(&(ovoid_prism){5, 20, 72}, NULL, NULL);
    if (CHECK(ring && peg)) {
        ovoid_solid_report r = ovoid_solid_get_report(ring);
        CHECK_EQ(r.edges_unmatched, 0);
        CHECK_EQ(r.is_closed, 1);
        CHECK_NEAR(r.volume, 2 * 9.8696044 * 15 * 25, 0.01 * r.volume);
        ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
        ovoid_body_pair pair = {{.solid = ring, .pose = ovoid_pose_make_identity()},
                                {.shape = peg, .pose = ovoid_pose_make_identity()}};
        ovoid_body_answer x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        check_answer(&pair, &x, &all);
        CHECK_EQ(x.status, OVOID_SEPARATED);
        CHECK_NEAR(x.lower, 5, 0.01);
        CHECK_LE(x.upper - x.lower, 1e-7);
        // Moved by its clearance and more it touches, then overlaps.
        pair.b.pose.position.x = 4.9;
        CHECK_EQ(ovoid_body_collide(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all}).status, OVOID_SEPARATED);
        pair.b.pose.position.x = 5.1;
        CHECK_EQ(ovoid_body_collide(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all}).status, OVOID_OVERLAPPING);
    }
    ovoid_solid_destroy(ring);
    ovoid_shape_destroy(peg);
    mesh_clear(&m);
}

// An L of blocks and a box on one grid: boxes that meet flush overlap those of the tree's nodes, whose triangles are
// left out for what a direction shows, and for nothing else. Truth: intervals of the blocks.
static int is_common_block(const double *low, const double *high, ovoid_vec3 at, ovoid_vec3 size, int is_closed) {
    const double first[3] = {at.x, at.y, at.z}, last[3] = {at.x + size.x, at.y + size.y, at.z + size.z};
    for (int k = 0; k < 3; k++)
        if (is_closed ? first[k] > high[k] || last[k] < low[k] : first[k] >= high[k] || last[k] <= low[k]) return 0;
    return 1;
}

static ovoid_solid *make_corner(void) {
    static const double outline[6][2] = {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}};
    static const uint32_t cap[4][3] = {{3, 4, 5}, {3, 5, 0}, {3, 0, 1}, {3, 1, 2}};
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    for (int i = 0; i < 12; i++) (void)mesh_add_point(&m, outline[i % 6][0], outline[i % 6][1], i / 6);
    for (int i = 0; i < 4; i++) mesh_add_triangle(&m, cap[i][0], cap[i][2], cap[i][1]);
    for (int i = 0; i < 4; i++) mesh_add_triangle(&m, cap[i][0] + 6, cap[i][1] + 6, cap[i][2] + 6);
    for (uint32_t i = 0; i < 6; i++) {
        uint32_t k = (i + 1) % 6;
        mesh_add_triangle(&m, i, k, k + 6);
        mesh_add_triangle(&m, i, k + 6, i + 6);
    }
    ovoid_solid *made = mesh_make_solid(&m);
    mesh_clear(&m);
    return made;
}

static void check_flush(void) {
    static const double low[3] = {0, 0, 0}, high[2][3] = {{2, 1, 1}, {1, 2, 1}};
    ovoid_solid *corner = make_corner();
    ovoid_vec3 size = {2, 1, 1};
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 0.5, 0.5}, NULL, NULL);
    for (int i = 0; corner && box && i < 11 * 9 * 3; i++) {
        ovoid_vec3 at = {0.5 * (i % 11) - 2.5, 0.5 * (i / 11 % 9) - 1.5, 0.5 * (i / 99) - 0.5};
        ovoid_pose here = ovoid_pose_make_identity(), there = here;
        there.position = (ovoid_vec3){at.x + 1, at.y + 0.5, at.z + 0.5};
        int meet[2];
        for (int is_closed = 0; is_closed < 2; is_closed++)
            meet[is_closed] = is_common_block(low, high[0], at, size, is_closed) ||
                              is_common_block(low, high[1], at, size, is_closed);
        ovoid_body_pair pair = {{.solid = corner, .pose = here}, {.shape = box, .pose = there}};
        ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
        for (int which = 0; which < 3; which++) {
            ovoid_body_answer x =
                which == 0   ? ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all})
                : which == 1 ? ovoid_body_collide(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all})
                             : ovoid_body_within(&pair, 0.25, NULL, &(ovoid_body_evidence){.exclusions = &all});
            check_answer(&pair, &x, &all);
            CHECK_EQ(x.status == OVOID_SEPARATED, !meet[1]);
            CHECK(x.status != OVOID_OVERLAPPING || meet[0]);
        }
    }
    ovoid_shape_destroy(box);
    ovoid_solid_destroy(corner);
}

// ---- warm starts

static int is_worse(const ovoid_body_answer *warm, const ovoid_body_answer *cold) {
    if (cold->status != OVOID_UNDECIDED && warm->status != cold->status) return 1;
    // Which crossing shows an overlap first is left open, and with it how deep it is shown to be.
    if (cold->status == OVOID_OVERLAPPING || warm->status != cold->status) return 0;
    double least = warm->upper - warm->lower, most = cold->upper - cold->lower;
    return cold->limit != OVOID_LIMIT_ANSWERED && !(least <= most + 1e-9);
}

// Proofs of other pairs, of other poses and of any triangles, with few iterations: no answer is worse than a cold one.
static void check_warm(void) {
    uint64_t s = 23;
    long improved = 0;
    ovoid_body_proof earlier = {0};
    for (int i = 0; i < 200; i++) {
        mesh m[2] = {{.points = 0}, {.points = 0}};
        for (int k = 0; k < 2; k++) mesh_add_random(&m[k], 0.5, &s);
        ovoid_solid *a = mesh_make_solid(&m[0]), *b = mesh_make_solid(&m[1]);
        check_seed = (uint64_t)i;
        for (int k = 0; k < 20; k++) {
            ovoid_body_pair pair = {{.solid = a, .pose = {{0, 0, 0}, random_quat(&s)}},
                                    {.solid = b, .pose = {random_vec3(&s, 1), random_quat(&s)}}};
            ovoid_options o = {.iterations = k % 3 ? 1 + (uint32_t)(random_next(&s) % 20) : 1};
            if (k % 4 == 0) pair.b.pose = pair.a.pose;
            if (k % 2)
                earlier.part_a = (uint32_t)(random_next(&s) % 40), earlier.part_b = (uint32_t)(random_next(&s) % 40);
            ovoid_body_answer cold[2], warm[2];
            cold[0] = ovoid_body_distance(&pair, &o, NULL), cold[1] = ovoid_body_collide(&pair, &o, NULL);
            ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
            warm[0] = ovoid_body_distance(&pair, &o, &(ovoid_body_evidence){.earlier = &earlier, .exclusions = &all});
            if (all.count <= all.capacity)
                CHECK_EQ(
                    ovoid_body_verify(&pair, &warm[0], &(ovoid_body_basis){.options = &o, .exclusions = &all}, NULL),
                    OVOID_OK);
            warm[1] = ovoid_body_collide(&pair, &o, &(ovoid_body_evidence){.earlier = &earlier});
            for (int q = 0; q < 2; q++) {
                if (!CHECK(!is_worse(&warm[q], &cold[q])))
                    printf("  %d, %u iterations: %d [%.17g, %.17g], cold %d %d [%.17g, %.17g]\n", q, o.iterations,
                           warm[q].status, warm[q].lower, warm[q].upper, cold[q].status, cold[q].limit, cold[q].lower,
                           cold[q].upper);
                improved += warm[q].upper - warm[q].lower < cold[q].upper - cold[q].lower;
            }
            earlier = (ovoid_body_proof){warm[0].part_a, warm[0].part_b, warm[0].deciding.proof};
        }
        ovoid_solid_destroy(a);
        ovoid_solid_destroy(b);
        mesh_clear(&m[0]);
        mesh_clear(&m[1]);
    }
    check_seed = 0;
    printf("  warm: %ld brackets narrower\n", improved);
}

int main(void) {
    check_flush();
    check_peg();
    check_random(60, 1, 1000);
    check_random(30, 1e-20, 2000);
    check_random(30, 1e20, 3000);
    check_needles(180, 7000);
    check_shapes(40, 4000);
    check_warm();
    return check_end();
}
