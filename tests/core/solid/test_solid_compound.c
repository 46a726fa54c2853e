// Pairs of a solid and a compound. Truth: brute force over the triangles of the parts' hulls in extended precision, as
// for two solids, with what is inside decided by solid angles; the check without search of each answer, which altered
// answers do not pass; and the same pairs with each part alone, of which the nearest decides.
#include "solids.h"

enum { CAPACITY = 60000, PARTS = 9 };
static ovoid_exclusion items[CAPACITY];

typedef struct assembly {
    ovoid_shape *shapes[PARTS];
    mesh meshes[PARTS];
    ovoid_posed_shape parts[PARTS];
    size_t count;
    ovoid_compound *compound;
} assembly;

// Random hulls, spread over `apart` times their size, at poses of any kind.
static void make(assembly *m, size_t count, double scale, double apart, uint64_t *s) {
    *m = (assembly){.count = count};
    for (size_t i = 0; i < count; i++) {
        double points[36];
        size_t n = 4 + random_next(s) % 9;
        for (size_t k = 0; k < 3 * n; k++) points[k] = random_uniform(s, -scale, scale);
        m->shapes[i] = ovoid_shape_create_from_points(points, n, NULL, NULL);
        ovoid_polytope p = ovoid_shape_get_polytope(m->shapes[i]);
        for (uint32_t k = 0; k < p.vertex_count; k++)
            mesh_add_point(&m->meshes[i], p.vertices[3 * k] + p.origin.x, p.vertices[3 * k + 1] + p.origin.y,
                           p.vertices[3 * k + 2] + p.origin.z);
        for (uint32_t k = 0; k < p.triangle_count; k++)
            mesh_add_triangle(&m->meshes[i], p.triangles[3 * k], p.triangles[3 * k + 1], p.triangles[3 * k + 2]);
        m->parts[i] = (ovoid_posed_shape){m->shapes[i], {random_vec3(s, apart * scale), random_quat(s)}};
    }
    m->compound = ovoid_compound_create(m->parts, count, NULL, NULL);
    CHECK(m->compound != NULL);
}

static void destroy(assembly *m) {
    ovoid_compound_destroy(m->compound);
    for (size_t i = 0; i < m->count; i++) {
        ovoid_shape_destroy(m->shapes[i]);
        mesh_clear(&m->meshes[i]);
    }
}

typedef struct truth {
    double surfaces;
    int is_common;
} truth;

static truth find_truth(const mesh *a, const ovoid_pose *pose_a, const assembly *b, const ovoid_pose *pose_b) {
    long double best = INFINITY;
    int is_common = 0;
    long3 *p = long_place_mesh(a, pose_a);
    for (size_t k = 0; k < b->count; k++) {
        ovoid_pose pose = ovoid_pose_compute_product(pose_b, &b->parts[k].pose);
        const mesh *part = &b->meshes[k];
        long3 *q = long_place_mesh(part, &pose);
        for (size_t i = 0; i < a->triangles; i++)
            for (size_t j = 0; j < part->triangles; j++) {
                long double d = long_triangles_distance(p + 3 * i, q + 3 * j);
                best = d < best ? d : best;
                is_common |= d <= 0;
            }
        is_common |= fabsl(long_winding(p, a->triangles, q[0])) > 0.5L;
        for (size_t i = 0; i < 3 * a->triangles && !is_common; i++)
            is_common = fabsl(long_winding(q, part->triangles, p[i])) > 0.5L;
        free(q);
    }
    free(p);
    return (truth){(double)best, is_common};
}

static int is_proven(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_exclusions *all) {
    ovoid_error error = {.message = ""};
    ovoid_code code = ovoid_body_verify(pair, x, &(ovoid_body_basis){.exclusions = all}, &error);
    if (code != OVOID_OK) printf("  %s\n", error.message);
    return code == OVOID_OK;
}

static void check_sign(const ovoid_body_answer *x, truth t, double slack) {
    CHECK(x->lower <= x->upper);
    if (t.is_common) CHECK(x->status != OVOID_SEPARATED && (x->status == OVOID_OVERLAPPING || t.surfaces <= slack));
    if (t.is_common) return;
    CHECK(x->status == OVOID_SEPARATED || t.surfaces <= slack);
    CHECK(x->lower <= t.surfaces + slack && t.surfaces <= x->upper + slack);
}

// The nearest of the parts alone has the distance of all.
static void check_parts(const ovoid_body_pair *pair, const assembly *m, const ovoid_body_answer *x, double slack) {
    double lower = INFINITY;
    const ovoid_pose *body = pair->a.compound ? &pair->a.pose : &pair->b.pose;
    for (size_t k = 0; k < m->count; k++) {
        ovoid_body_pair one = *pair;
        ovoid_body part = {.shape = m->shapes[k], .pose = ovoid_pose_compute_product(body, &m->parts[k].pose)};
        *(pair->a.compound ? &one.a : &one.b) = part;
        ovoid_body_answer y = ovoid_body_distance(&one, NULL, NULL);
        if (y.status == OVOID_OVERLAPPING) CHECK_EQ(x->status, OVOID_OVERLAPPING);
        lower = fmin(lower, y.lower);
        uint32_t decides = pair->a.compound ? x->part_a : x->part_b;
        if (x->status == OVOID_SEPARATED && k == decides) CHECK_NEAR(y.lower, x->lower, slack);
    }
    if (x->status == OVOID_SEPARATED) CHECK_NEAR(lower, x->lower, slack);
}

static void check_pair(const ovoid_body_pair *pair, const assembly *m, truth t, double size, uint64_t *s) {
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
    double slack = 1e-12 * size;
    ovoid_body_answer x = ovoid_body_distance(pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    CHECK(all.count <= all.capacity && is_proven(pair, &x, &all));
    check_sign(&x, t, slack);
    if (x.status == OVOID_SEPARATED) CHECK_LE(x.upper - x.lower, 1.01e-9 * size);
    check_parts(pair, m, &x, 2e-9 * size);

    ovoid_body_proof earlier = {x.part_a, x.part_b, x.deciding.proof};
    ovoid_body_answer y =
        ovoid_body_collide(pair, NULL, &(ovoid_body_evidence){.earlier = &earlier, .exclusions = &all});
    CHECK(is_proven(pair, &y, &all));
    check_sign(&y, t, slack);
    double margin = t.surfaces * random_uniform(s, 0.5, 2);
    y = ovoid_body_within(pair, margin, NULL, &(ovoid_body_evidence){.exclusions = &all});
    CHECK(is_proven(pair, &y, &all));
    if (!t.is_common && fabs(t.surfaces - margin) > 2e-9 * size)
        CHECK_EQ(ovoid_body_answer_is_within(&y, margin), t.surfaces < margin);
}

// What is altered is refused.
static void check_altered(const ovoid_body_pair *pair, const ovoid_body_answer *x, ovoid_exclusions *all) {
    ovoid_body_answer y = *x;
    if (x->status == OVOID_SEPARATED) {
        y.status = OVOID_OVERLAPPING;
        y.upper = -x->lower;
    } else {
        y.status = OVOID_SEPARATED;
    }
    CHECK(ovoid_body_verify(pair, &y, &(ovoid_body_basis){.exclusions = all}, NULL) == OVOID_ERROR_PROOF);
    y = *x;
    y.lower += 0.01;
    y.deciding.lower += 0.01;
    CHECK(ovoid_body_verify(pair, &y, &(ovoid_body_basis){.exclusions = all}, NULL) == OVOID_ERROR_PROOF);
    if (x->inside) {
        y = *x;
        y.inside = x->inside == OVOID_BODY_A_INSIDE ? OVOID_BODY_B_INSIDE : OVOID_BODY_A_INSIDE;
        CHECK(ovoid_body_verify(pair, &y, &(ovoid_body_basis){.exclusions = all}, NULL) == OVOID_ERROR_PROOF);
        y = *x;
        y.component = 1000;
        CHECK(ovoid_body_verify(pair, &y, &(ovoid_body_basis){.exclusions = all}, NULL) == OVOID_ERROR_PROOF);
    }
    if (all->count == 0) return;
    ovoid_exclusion kept = all->items[all->count - 1];
    all->count--;
    CHECK(ovoid_body_verify(pair, x, &(ovoid_body_basis){.exclusions = all}, NULL) == OVOID_ERROR_PROOF);
    all->count++;
    all->items[all->count - 1].normal = (ovoid_vec3){-kept.normal.x, -kept.normal.y, -kept.normal.z};
    if (kept.lower > 0)
        CHECK(ovoid_body_verify(pair, x, &(ovoid_body_basis){.exclusions = all}, NULL) == OVOID_ERROR_PROOF);
    all->items[all->count - 1] = kept;
}

static void check_random(int rounds, double scale, double far, uint64_t seed) {
    int common = 0, inside = 0;
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = seed + (uint64_t)i;
        mesh a = {NULL, NULL, 0, 0, 0, 0};
        assembly b;
        // Each fourth time small parts about the middle of a star.
        int is_within = i % 4 == 0;
        double small = is_within ? 0.02 : 0.4;
        if (is_within)
            mesh_add_star(&a, (ovoid_vec3){0, 0, 0}, scale, 6, 8, 0.4, &s);
        else
            mesh_add_random(&a, scale, &s);
        make(&b, 1 + (size_t)i % PARTS, small * scale, (is_within ? 0.2 : i % 3 ? 1.5 : 0.5) / small, &s);
        ovoid_solid *solid = mesh_make_solid(&a);
        ovoid_vec3 place = random_vec3(&s, far), at = random_vec3(&s, is_within ? 0.3 * scale : 2 * scale);
        ovoid_pose pose = {{place.x + at.x, place.y + at.y, place.z + at.z}, random_quat(&s)};
        ovoid_body_pair pair = {{.solid = solid, .pose = {place, random_quat(&s)}},
                                {.compound = b.compound, .pose = pose}};
        truth t = find_truth(&a, &pair.a.pose, &b, &pose);
        common += t.is_common;
        inside += t.is_common && t.surfaces > 0;
        double size = 9 * scale + far * 1e-5;
        check_pair(&pair, &b, t, size, &s);
        ovoid_body_pair turned = {pair.b, pair.a};
        check_pair(&turned, &b, t, size, &s);
        ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
        ovoid_body_answer x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        if (scale == 1 && far == 0 && t.surfaces > 0.05) check_altered(&pair, &x, &all);
        ovoid_solid_destroy(solid);
        destroy(&b);
        mesh_clear(&a);
    }
    check_seed = 0;
    printf("%d pairs of scale %g: %d have points in common, %d by containment\n", rounds, scale, common, inside);
    CHECK(common > 0 && common < rounds && (inside > 0 || rounds < 40));
}

// Two compounds, which have an answer of their own: the same distance, and never another sign.
static void check_compounds(int rounds) {
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = 7000 + (uint64_t)i;
        assembly a, b;
        make(&a, 1 + (size_t)i % 5, 0.4, 3, &s);
        make(&b, 1 + (size_t)i % PARTS, 0.4, 3, &s);
        ovoid_body_pair pair = {{.compound = a.compound, .pose = {{0, 0, 0}, random_quat(&s)}},
                                {.compound = b.compound, .pose = {random_vec3(&s, 3), random_quat(&s)}}};
        ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
        ovoid_body_answer x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        CHECK(is_proven(&pair, &x, &all));
        ovoid_answer y = ovoid_body_distance(&pair, NULL, NULL).deciding;
        CHECK_EQ(x.status, y.status);
        if (x.status == OVOID_SEPARATED) CHECK_NEAR(x.upper, y.upper, 1e-7);
        destroy(&a);
        destroy(&b);
    }
    check_seed = 0;
}

// A body with none or two of the three, and solids where compounds are asked about.
static void check_refusals(void) {
    uint64_t s = 3;
    mesh a = {NULL, NULL, 0, 0, 0, 0};
    assembly b;
    mesh_add_angle(&a, 1, 0.3, 0.2);
    make(&b, 3, 1, 1, &s);
    ovoid_solid *solid = mesh_make_solid(&a);
    const ovoid_pose pose = ovoid_pose_make_identity();
    const ovoid_body one = {.solid = solid, .pose = pose};
    const ovoid_body bad[4] = {{.pose = pose},
                               {.solid = solid, .compound = b.compound, .pose = pose},
                               {.solid = solid, .shape = b.shapes[0], .pose = pose},
                               {.shape = b.shapes[0], .compound = b.compound, .pose = pose}};
    for (int i = 0; i < 4; i++) {
        ovoid_body_pair first = {bad[i], one}, second = {one, bad[i]};
        ovoid_body_answer x = ovoid_body_distance(&first, NULL, NULL);
        CHECK_EQ(x.limit, OVOID_LIMIT_SHAPE_A);
        CHECK(is_proven(&first, &x, NULL));
        CHECK_EQ(ovoid_body_collide(&second, NULL, NULL).limit, OVOID_LIMIT_SHAPE_B);
        CHECK_EQ(ovoid_body_distance(&first, NULL, NULL).limit, OVOID_LIMIT_SHAPE_A);
    }
    ovoid_body_pair with = {one, {.compound = b.compound, .pose = pose}};
    with.b.pose.position.x = 2 * OVOID_LENGTH_MAX;
    CHECK_EQ(ovoid_body_collide(&with, NULL, NULL).limit, OVOID_LIMIT_POSE_B);
    ovoid_solid_destroy(solid);
    destroy(&b);
    mesh_clear(&a);
}

int main(void) {
    check_random(40, 1, 0, 1000);
    check_random(12, 1, 1e6, 2000);
    check_random(8, 1e-20, 0, 3000);
    check_random(8, 1e20, 0, 4000);
    check_compounds(20);
    check_refusals();
    return check_end();
}
