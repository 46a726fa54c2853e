// What a compound's bounds leave to rounding: nodes, parts and both ellipsoids hold what they must, and a proof of
// bodies far from the origin holds. Truth: the parts' vertices where the exact poses have them, in long double
// (extended.h); for exclusions, the gap along their normals of the parts as the check has them, in long double too: the
// largest lower bound that the check lets pass must not be above it.
#include "compounds.h"
#include "extended.h"

#include "body/body_tree.h"

enum { CAPACITY = 4000, DIRECTIONS = 12 };
static ovoid_exclusion items[CAPACITY];

static extended3 find_vertex(const ovoid_posed_shape *part, uint32_t i) {
    ovoid_polytope p = ovoid_shape_get_polytope(part->shape);
    extended3 v = extended3_add(extended3_from(p.origin), extended3_from(vec3_at(p.vertices, i)));
    return extended3_place(&part->pose, v);
}

static uint32_t count_vertices(const ovoid_shape *shape) { return ovoid_shape_get_polytope(shape).vertex_count; }

// ---- nodes

// n' Q n
static long double compute_form(sym3 q, extended3 n) {
    return q.xx * n.x * n.x + q.yy * n.y * n.y + q.zz * n.z * n.z +
           2 * (q.xy * n.x * n.y + q.xz * n.x * n.z + q.yz * n.y * n.z);
}

static void check_vertex_in_node(const compound_node *n, extended3 v, long double radius, long double slack,
                                 uint64_t *s) {
    extended3 d = extended3_sub(v, extended3_from(n->center));
    CHECK(fabsl(d.x) + radius <= n->half.x + slack);
    CHECK(fabsl(d.y) + radius <= n->half.y + slack);
    CHECK(fabsl(d.z) + radius <= n->half.z + slack);
    CHECK(extended3_norm(d) + radius <= n->radius + slack);
    if (!node_is_round(n)) return;
    // Along any direction, that to the vertex among them.
    extended3 e = extended3_sub(d, extended3_from(n->shift));
    for (int k = 0; k < 3; k++) {
        extended3 u = k ? extended3_from(random_vec3(s, 1)) : e;
        long double norm = extended3_norm(u);
        if (!(norm > 0)) continue;
        u = extended3_scale(u, 1 / norm);
        CHECK(extended3_dot(u, e) + radius <= sqrtl(compute_form(n->round, u)) + slack);
    }
}

static void check_nodes(const ovoid_compound *c, uint64_t *s) {
    long double slack = EXTENDED_ROUNDING * 16 * c->extent;
    for (size_t k = 0; k < 2 * (size_t)c->count - 1; k++)
        for (uint32_t place = c->nodes[k].first; place < c->nodes[k].end; place++) {
            ovoid_posed_shape part = ovoid_compound_get_part(c, c->order[place]);
            for (uint32_t i = 0; i < count_vertices(part.shape); i++)
                check_vertex_in_node(&c->nodes[k], find_vertex(&part, i), ovoid_shape_get_radius(part.shape), slack, s);
        }
    for (uint32_t place = 0; place < c->count; place++) {
        ovoid_posed_shape part = ovoid_compound_get_part(c, c->order[place]);
        extended3 center = extended3_from(c->parts[place].center);
        for (uint32_t i = 0; i < count_vertices(part.shape); i++) {
            long double far = extended3_norm(extended3_sub(find_vertex(&part, i), center));
            CHECK(far + ovoid_shape_get_radius(part.shape) <= c->parts[place].reach + slack);
        }
    }
}

// ---- ellipsoids

// Along each part's directions the outer ellipsoid reaches as far as the part.
static void check_outer(const ovoid_compound *c, uint64_t *s) {
    long double slack = EXTENDED_ROUNDING * 64 * c->extent;
    for (uint32_t k = 0; k < c->count; k++) {
        ovoid_posed_shape part = ovoid_compound_get_part(c, k);
        for (uint32_t i = 0; i < count_vertices(part.shape); i++) {
            extended3 d = extended3_sub(find_vertex(&part, i), extended3_from(c->outer.center));
            for (int j = 0; j < 3; j++) {
                extended3 u = j ? extended3_from(random_vec3(s, 1)) : d;
                u = extended3_scale(u, 1 / extended3_norm(u));
                long double reach = extended3_dot(u, d) + ovoid_shape_get_radius(part.shape);
                CHECK(reach <= sqrtl(compute_form(c->outer.q, u)) + slack);
            }
        }
    }
}

// 1 if the ellipsoid is below every plane of the part as it is posed.
static int is_inside(const ovoid_ellipsoid *e, const ovoid_posed_shape *part, long double slack) {
    ovoid_polytope p = ovoid_shape_get_polytope(part->shape);
    for (uint32_t f = 0; f < p.facet_count; f++) {
        extended3 n = extended3_rotate(part->pose.rotation, extended3_from(p.planes[f].normal));
        long double low = -INFINITY;
        for (uint32_t i = 0; i < p.vertex_count; i++) low = fmaxl(low, extended3_dot(n, find_vertex(part, i)));
        n = extended3_scale(n, 1 / extended3_norm(n));
        if (extended3_dot(n, extended3_from(e->center)) + sqrtl(compute_form(e->q, n)) > low + slack) return 0;
    }
    return p.facet_count > 0;
}

static void check_inner(const ovoid_compound *c) {
    if (!(c->inner.q.xx > 0)) return;
    int found = 0;
    for (uint32_t k = 0; k < c->count && !found; k++) {
        ovoid_posed_shape part = ovoid_compound_get_part(c, k);
        found = is_inside(&c->inner, &part, 1e-14L * c->extent);
    }
    CHECK(found);
}

// ---- exclusions

static long double find_top(const body_tree *tree, uint32_t first, uint32_t end, extended3 n) {
    long double most = -INFINITY;
    for (uint32_t place = first; place < end; place++) {
        ovoid_posed_shape part = body_tree_get_leaf(tree, place, NULL);
        for (uint32_t i = 0; i < count_vertices(part.shape); i++)
            most = fmaxl(most, extended3_dot(n, find_vertex(&part, i)) + ovoid_shape_get_radius(part.shape));
    }
    return most;
}

static long double find_gap(const ovoid_body_pair *pair, const ovoid_exclusion *e) {
    body_tree a, b;
    CHECK(body_tree_make(&pair->a, &a) && body_tree_make(&pair->b, &b));
    extended3 n = extended3_from(e->normal);
    n = extended3_scale(n, 1 / extended3_norm(n));
    return -find_top(&b, e->first_b, e->end_b, extended3_scale(n, -1)) - find_top(&a, e->first_a, e->end_a, n);
}

static int is_accepted(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_exclusions *all) {
    return ovoid_body_verify(pair, x, &(ovoid_body_basis){.exclusions = all}, NULL) == OVOID_OK;
}

// The largest lower bound of an exclusion that passes, by halving from what it claims.
static void check_largest(const ovoid_body_pair *pair, const ovoid_body_answer *x, ovoid_exclusions *all, size_t i,
                          double size) {
    ovoid_exclusion *e = &all->items[i], kept = *e;
    long double gap = find_gap(pair, e);
    double low = e->lower, high = e->lower + 1e-9 * size;
    for (int k = 0; k < 60; k++) {
        double middle = low + 0.5 * (high - low);
        e->lower = middle;
        *(is_accepted(pair, x, all) ? &low : &high) = middle;
    }
    *e = kept;
    CHECK((long double)low <= gap + EXTENDED_ROUNDING * 64 * size);
}

static void check_proofs(ovoid_shape *const shapes[SHAPES], uint64_t seed) {
    uint64_t s = seed;
    ovoid_compound *c[2] = {make_compound(shapes, 2 + seed % 7, 3, &s), make_compound(shapes, 2 + seed % 5, 3, &s)};
    // Near the origin, or both as far as there are digits for their gap.
    double far = seed % 2 ? 0 : ldexp(1, (int)(random_next(&s) % 32));
    ovoid_vec3 at = random_vec3(&s, far), way = vec3_scale(vec3_unit(random_vec3(&s, 1)), random_uniform(&s, 4, 14));
    ovoid_body_pair pair = {{.compound = c[0], .pose = {at, random_quat(&s)}},
                            {.compound = c[1], .pose = {vec3_add(at, way), random_quat(&s)}}};
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
    ovoid_error error = {.message = ""};
    ovoid_body_answer x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    double size = c[0]->extent + c[1]->extent + vec3_norm(way);
    CHECK_LE(all.count, CAPACITY);
    if (!CHECK(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, &error) == OVOID_OK))
        printf("  %s\n", error.message);
    for (size_t i = 0; i < all.count && i < 8 && far < 1e3; i++) check_largest(&pair, &x, &all, i, size);
    ovoid_compound_destroy(c[0]);
    ovoid_compound_destroy(c[1]);
}

// Balls: their nodes' spheres touch what they hold, so a bound along the line of the centres has no room but its claim.
static void check_far_balls(uint64_t seed) {
    uint64_t s = check_seed = seed;
    ovoid_shape *ball = ovoid_shape_create_sphere(1, NULL, NULL);
    ovoid_posed_shape parts[2] = {{ball, {{0, 0, 0}, {1, 0, 0, 0}}}, {ball, {random_vec3(&s, 4), random_quat(&s)}}};
    ovoid_compound *c[2];
    for (int i = 0; i < 2; i++) c[i] = ovoid_compound_create(parts, 2, NULL, NULL);
    double far = ldexp(1, (int)(random_next(&s) % 36));
    ovoid_vec3 at = random_vec3(&s, far), way = vec3_scale(vec3_unit(random_vec3(&s, 1)), random_uniform(&s, 8, 20));
    ovoid_body_pair pair = {{.compound = c[0], .pose = {at, random_quat(&s)}},
                            {.compound = c[1], .pose = {vec3_add(at, way), random_quat(&s)}}};
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
    ovoid_error error = {.message = ""};
    for (int k = 0; k < 3; k++) {
        ovoid_options o = {.cap = k ? random_uniform(&s, 0, 20) : 0};
        ovoid_body_answer x = k < 2 ? ovoid_body_distance(&pair, &o, &(ovoid_body_evidence){.exclusions = &all})
                                    : ovoid_body_within(&pair, random_uniform(&s, 0, 10), NULL,
                                                        &(ovoid_body_evidence){.exclusions = &all});
        if (!CHECK(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, &error) == OVOID_OK))
            printf("  %s\n", error.message);
    }
    for (int i = 0; i < 2; i++) ovoid_compound_destroy(c[i]);
    ovoid_shape_destroy(ball);
}

int main(void) {
    for (uint64_t seed = 1; EXTENDED && seed <= 60; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_shape *shapes[SHAPES];
        if (!make_shapes(shapes, 1, &s)) break;
        ovoid_compound *c = make_compound(shapes, 1 + seed % 9, 3, &s);
        check_nodes(c, &s);
        check_outer(c, &s);
        check_inner(c);
        ovoid_compound_destroy(c);
        check_proofs(shapes, seed);
        destroy_shapes(shapes);
    }
    for (uint64_t seed = 1; seed <= 300; seed++) check_far_balls(seed);
    if (!EXTENDED) check_skip("long double has no more digits than double here");
    return check_end();
}
