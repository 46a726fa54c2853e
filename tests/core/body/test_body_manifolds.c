// The manifolds of two bodies, part by part. Truth: ovoid_manifold_find of every pair of parts, one by one: what is not
// proven farther than the margin must be there with the same bits, and nothing else; and the answer of
// ovoid_body_depth.
#include "bits.h"
#include "compounds.h"
#include "ovoid/body_manifolds.h"

enum { MOST = 4096 };

// A scene: two compounds, or a compound and a shape, near each other.
typedef struct scene {
    ovoid_shape *shapes[SHAPES];
    ovoid_compound *compounds[2];
    ovoid_body_pair pair;
    ovoid_manifold_options options;
} scene;

static ovoid_body make_body(const scene *x, int side, int is_shape, uint64_t *s) {
    ovoid_body body = {.pose = {random_vec3(s, 1.5), random_quat(s)}};
    if (is_shape)
        body.shape = x->shapes[random_next(s) % 4];
    else
        body.compound = x->compounds[side];
    return body;
}

static int scene_begin(scene *x, uint64_t seed) {
    uint64_t s = check_seed = seed;
    *x = (scene){.options = {.margin = seed % 3 ? random_uniform(&s, 0, 0.4) : 0}};
    if (!make_shapes(x->shapes, 1, &s)) return 0;
    for (int i = 0; i < 2; i++) x->compounds[i] = make_compound(x->shapes, 2 + random_next(&s) % 20, 3, &s);
    x->pair =
        (ovoid_body_pair){make_body(x, 0, seed % 8 == 5, &s), make_body(x, 1, seed % 8 == 2 || seed % 8 == 5, &s)};
    return CHECK(x->compounds[0] && x->compounds[1]);
}

static void scene_end(scene *x) {
    for (int i = 0; i < 2; i++) ovoid_compound_destroy(x->compounds[i]);
    destroy_shapes(x->shapes);
}

static const ovoid_body_manifold *find_item(const ovoid_body_manifolds *all, size_t a, size_t b) {
    for (size_t i = 0; i < all->count; i++)
        if (all->items[i].part_a == a && all->items[i].part_b == b) return &all->items[i];
    return NULL;
}

static int is_same(const void *a, const void *b, size_t size) { return memcmp(a, b, size) == 0; }

// The smallest signed distance over all pairs of parts, as manifolds give it.
static bracket check_pairs(const scene *x, const ovoid_body_manifolds *all, size_t *listed) {
    bracket best = {INFINITY, INFINITY};
    for (size_t a = 0; a < get_count(&x->pair.a); a++)
        for (size_t b = 0; b < get_count(&x->pair.b); b++) {
            ovoid_pair parts = get_pair(&x->pair, a, b);
            const ovoid_body_manifold *own = find_item(all, a, b),
                                      *before = all->earlier ? find_item(
                                                                   &(ovoid_body_manifolds){
                                                                       .items = (ovoid_body_manifold *)all->earlier,
                                                                       .count = all->earlier_count},
                                                                   a, b)
                                                             : NULL;
            ovoid_manifold alone = ovoid_manifold_find(&parts, &x->options, before ? &before->manifold : NULL);
            best.lower = fmin(best.lower, alone.lower);
            best.upper = fmin(best.upper, alone.upper);
            CHECK_EQ(own != NULL, !(alone.lower > x->options.margin));
            if (!own) continue;
            ++*listed;
            CHECK(is_same(&own->manifold, &alone, sizeof alone));
            // An upper bound of a search needs its cover.
            if (alone.proof != OVOID_MANIFOLD_PROOF_SEARCH)
                CHECK_EQ(ovoid_body_manifold_verify(&x->pair, own, &x->options, NULL), OVOID_OK);
            ovoid_body_manifold wrong = *own;
            wrong.manifold.lower += 0.5;
            CHECK_EQ(ovoid_body_manifold_verify(&x->pair, &wrong, &x->options, NULL), OVOID_ERROR_PROOF);
            ovoid_manifold_points of_parts = ovoid_manifold_compute_points(&parts, &alone),
                                  points = ovoid_body_manifold_compute_points(&x->pair, own);
            const ovoid_manifold_points *of_query = &all->points[own - all->items];
            CHECK(points_are_same(of_query, &points) && points_are_same(&of_parts, &points));
            CHECK_EQ(points.count, alone.count);
            CHECK_EQ(points.grown, of_parts.grown);
            // Two bounds of the same excess, measured in the query and after it.
            CHECK_NEAR(of_query->grown, points.grown, 0.01 * points.grown);
        }
    return best;
}

// Without what was found before, then with it at poses a little later.
static size_t test_scene(uint64_t seed) {
    static ovoid_body_manifold items[2][MOST];
    scene x;
    uint64_t s = seed + 1000;
    size_t listed = 0;
    if (!scene_begin(&x, seed)) return 0;
    static ovoid_manifold_points points[MOST];
    ovoid_body_manifolds all = {.items = items[0], .points = points, .capacity = MOST};
    for (int frame = 0; frame < 3; frame++) {
        size_t here = 0;
        CHECK_EQ(ovoid_body_manifolds_find(&x.pair, &x.options, &all), OVOID_LIMIT_NONE);
        bracket best = check_pairs(&x, &all, &here);
        CHECK_EQ(here, all.count);
        listed += here;
        for (size_t i = 1; i < all.count; i++) {
            const ovoid_body_manifold *p = &all.items[i - 1], *q = p + 1;
            CHECK(p->part_a < q->part_a || (p->part_a == q->part_a && p->part_b < q->part_b));
        }
        // What is left out is bounded more loosely than by the manifolds of all pairs.
        ovoid_body_answer truth = ovoid_body_depth(&x.pair, NULL, NULL);
        CHECK_LE(all.lower, truth.upper);
        CHECK_LE(truth.lower, all.upper);
        CHECK(all.lower <= best.lower + 1e-9 || all.count == 0);
        CHECK(all.count == 0 || all.upper == best.upper);
        CHECK(all.count > 0 || all.lower > x.options.margin);
        all.earlier = all.items;
        all.earlier_count = all.count;
        all.items = items[(frame + 1) % 2];
        ovoid_vec3 d = random_vec3(&s, frame ? 0.05 : 1e-9);
        ovoid_vec3 *at = &x.pair.b.pose.position;
        *at = (ovoid_vec3){at->x + d.x, at->y + d.y, at->z + d.z};
    }
    scene_end(&x);
    return listed;
}

// ---- room

static void test_room(uint64_t seed) {
    static ovoid_body_manifold whole[MOST], some[MOST];
    scene x;
    if (!scene_begin(&x, seed)) return;
    x.options.margin = 1;
    ovoid_body_manifolds all = {.items = whole, .capacity = MOST};
    CHECK_EQ(ovoid_body_manifolds_find(&x.pair, &x.options, &all), OVOID_LIMIT_NONE);
    for (size_t capacity = 0; capacity <= all.count; capacity++) {
        memset(some, 0x5a, sizeof some);
        ovoid_body_manifolds part = {.items = capacity ? some : NULL, .capacity = capacity};
        CHECK_EQ(ovoid_body_manifolds_find(&x.pair, &x.options, &part), OVOID_LIMIT_NONE);
        CHECK_EQ(part.count, all.count);
        CHECK(part.lower == all.lower && part.upper == all.upper);
        for (size_t i = 0; i < capacity; i++) {
            const ovoid_body_manifold *own = find_item(&all, some[i].part_a, some[i].part_b);
            CHECK(own && is_same(&own->manifold, &some[i].manifold, sizeof own->manifold));
        }
        const unsigned char *after = (const unsigned char *)&some[capacity];
        CHECK_EQ(*after, 0x5a);
    }
    // What is missing in `earlier` is found as if there were none.
    ovoid_body_manifolds warm = {.items = some, .capacity = MOST, .earlier = whole, .earlier_count = all.count / 2};
    CHECK_EQ(ovoid_body_manifolds_find(&x.pair, &x.options, &warm), OVOID_LIMIT_NONE);
    CHECK_EQ(warm.count, all.count);
    scene_end(&x);
}

// ---- what is refused

static void test_refused(void) {
    static ovoid_body_manifold items[16];
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    static const double xyz[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    static const uint32_t faces[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    ovoid_solid *solid = ovoid_solid_create_from_triangles(&(ovoid_triangles){xyz, 4, faces, 4}, NULL, NULL);
    CHECK(box && solid);
    const ovoid_pose here = {{0, 0, 0}, {1, 0, 0, 0}}, bad = {{NAN, 0, 0}, {1, 0, 0, 0}};
    const ovoid_body good = {.shape = box, .pose = here}, hollow = {.solid = solid, .pose = here},
                     none = {.pose = here}, lost = {.shape = box, .pose = bad};
    const struct {
        ovoid_body_pair pair;
        double margin;
        ovoid_limit limit;
    } trials[] = {{{hollow, hollow}, 0, OVOID_LIMIT_SHAPE_B}, {{hollow, lost}, 0, OVOID_LIMIT_POSE_B},
                  {{lost, hollow}, 0, OVOID_LIMIT_POSE_A},    {{hollow, good}, -1, OVOID_LIMIT_OPTIONS},
                  {{none, good}, 0, OVOID_LIMIT_SHAPE_A},     {{good, none}, 0, OVOID_LIMIT_SHAPE_B},
                  {{lost, good}, 0, OVOID_LIMIT_POSE_A},      {{good, lost}, 0, OVOID_LIMIT_POSE_B},
                  {{good, good}, -1, OVOID_LIMIT_OPTIONS},    {{good, good}, NAN, OVOID_LIMIT_OPTIONS},
                  {{good, good}, 0, OVOID_LIMIT_NONE}};
    for (size_t i = 0; i < sizeof trials / sizeof *trials; i++) {
        ovoid_body_manifolds all = {.items = items, .capacity = 16, .count = 7};
        const ovoid_manifold_options options = {.margin = trials[i].margin};
        int is_right = trials[i].limit == OVOID_LIMIT_NONE;
        CHECK_EQ(ovoid_body_manifolds_find(&trials[i].pair, &options, &all), trials[i].limit);
        CHECK_EQ(all.count, is_right);
        if (!is_right) CHECK(all.lower == -INFINITY && all.upper == INFINITY);
    }
    // A manifold of other bodies: parts that do not exist.
    ovoid_body_pair pair = {good, good};
    ovoid_body_manifolds all = {.items = items, .capacity = 16};
    ovoid_error error = {0};
    CHECK_EQ(ovoid_body_manifolds_find(&pair, NULL, &all), OVOID_LIMIT_NONE);
    items[0].part_b = 1;
    CHECK_EQ(ovoid_body_manifold_compute_points(&pair, &items[0]).count, 0);
    CHECK_EQ(ovoid_body_manifold_verify(&pair, &items[0], NULL, &error), OVOID_ERROR_PROOF);
    CHECK(error.place == 1 && strstr(error.message, "part 1 of body b"));
    items[0].part_a = 3;
    CHECK_EQ(ovoid_body_manifold_verify(&pair, &items[0], NULL, &error), OVOID_ERROR_PROOF);
    CHECK(error.place == 0 && strstr(error.message, "part 3 of body a"));
    ovoid_solid_destroy(solid);
    ovoid_shape_destroy(box);
}

int main(void) {
    size_t listed = 0;
    for (uint64_t seed = 1; seed <= 120; seed++) listed += test_scene(seed);
    CHECK_LE(1000, listed);
    for (uint64_t seed = 1; seed <= 6; seed++) test_room(seed);
    test_refused();
    return check_end();
}
