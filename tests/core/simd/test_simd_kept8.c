// The kernels for kept bounds and cached proofs, bit for bit: those of each instruction set against their scalar twin,
// and the twin against the measurement of one pair (pair/reject.h, pair/hull.h) and against a comparison written out
// here in the words of world/state.h. No tolerance. Odd lanes are left to the measurement of one pair; which they are
// is compared, and that no lane of the common case is one.
#include "simd/kept8.h"

#include "check.h"
#include "linear/rotation.h"
#include "ovoid/ovoid.h"
#include "pair/hull.h"
#include "pair/reject.h"

enum { SHAPES = 12, ROUNDS = 1500, POINTS = 12 };

static ovoid_shape *shapes[SHAPES];
static ovoid_posed_shape bodies[2][PAIR8];
static vec3 normals[PAIR8 + 1]; // the kernel reads one number more
static kept8_places places;
static const kept8_errors errors = {FRAME_REJECT, FRAME_CLAIM, OVOID_LENGTH_MIN};

static int make_shapes(uint64_t *s) {
    for (int i = 0; i < SHAPES; i++) {
        double xyz[3 * POINTS];
        for (size_t k = 0; k < 3 * POINTS; k++) xyz[k] = random_uniform(s, -1, 1);
        ovoid_shape_options o = {.radius = i % 4 == 3 ? 0.25 : 0};
        shapes[i] = ovoid_shape_create_from_points(xyz, POINTS, &o, NULL);
        if (!CHECK(shapes[i] != NULL)) return 0;
    }
    return 1;
}

// Now and then a number that no lane is made for.
static double spoil(uint64_t *s, double x, int is_wild) {
    static const double bad[] = {0, 1e-40, 1e40, 1e-200, 1e200};
    return is_wild && random_next(s) % 60 == 0 ? bad[random_next(s) % 5] : x;
}

static const double *pick_vertex(uint64_t *s, const ovoid_shape *shape) {
    return shape_vertices(shape) + 3 * (random_next(s) % shape->vertex_count);
}

// Every other pair of bodies is in each other, where one tetrahedron in thirty contains the origin.
static void fill(uint64_t *s, unsigned count, int is_wild) {
    places.count = count;
    for (unsigned k = 0; k < PAIR8; k++) {
        for (int side = 0; side < 2; side++) {
            ovoid_posed_shape *b = &bodies[side][k];
            b->shape = shapes[random_next(s) % SHAPES];
            double reach = k % 2 ? 0.1 : 3;
            b->pose.position =
                (vec3){random_uniform(s, -reach, reach), random_uniform(s, -1, 1), random_uniform(s, -1, 1)};
            double *q = &b->pose.rotation.w;
            for (int i = 0; i < 4; i++) q[i] = spoil(s, random_uniform(s, -1, 1), is_wild);
        }
        normals[k] = (vec3){spoil(s, random_uniform(s, -1, 1), is_wild), random_uniform(s, -1, 1), 0.25};
    }
    for (unsigned k = 0; k < PAIR8; k++) {
        unsigned from = k < count ? k : 0;
        const ovoid_posed_shape *a = &bodies[0][from], *b = &bodies[1][from];
        places.pose_a[k] = &a->pose.position.x;
        places.pose_b[k] = &b->pose.position.x;
        places.shape_a[k] = &a->shape->radius;
        places.shape_b[k] = &b->shape->radius;
        places.lengths_a[k] = &a->shape->lower_radius;
        places.lengths_b[k] = &b->shape->lower_radius;
        places.normal[k] = &normals[from].x;
        for (int i = 0; i < 4; i++) {
            places.vertex_a[i][k] = pick_vertex(s, a->shape);
            // Now and then a difference twice: a tetrahedron without volume.
            places.vertex_b[i][k] =
                i && random_next(s) % 50 == 0 ? places.vertex_b[i - 1][k] : pick_vertex(s, b->shape);
            if (i && places.vertex_b[i][k] == places.vertex_b[i - 1][k])
                places.vertex_a[i][k] = places.vertex_a[i - 1][k];
        }
    }
}

static void check_same(double found, double right) {
    if (memcmp(&found, &right, sizeof right) != 0) CHECK_EQ(found, right);
}

static void check_vector(const lane_column *c, unsigned k, vec3 right) {
    check_same(c[0].lane[k], right.x);
    check_same(c[1].lane[k], right.y);
    check_same(c[2].lane[k], right.z);
}

static pair_frame place(unsigned k) {
    ovoid_pair pair = {bodies[0][k].shape, bodies[1][k].shape, bodies[0][k].pose, bodies[1][k].pose};
    pair_frame f;
    CHECK_EQ(frame_place(&pair, &f), OVOID_LIMIT_NONE);
    return f;
}

static int is_plain_pair(unsigned k) {
    return quat_is_plain(quat_norm_squared(bodies[0][k].pose.rotation)) &&
           quat_is_plain(quat_norm_squared(bodies[1][k].pose.rotation));
}

// The twin's lane against reject_by_spheres and reject_by_normal.
static void check_gap(const kept8_gaps *found, unsigned k) {
    pair_frame f = place(k);
    rejection by_spheres, by_normal = {.lower = NAN};
    CHECK_EQ(is_plain_pair(k), 1);
    (void)reject_by_spheres(&f, INFINITY, &by_spheres);
    check_same(found->sphere.lane[k], by_spheres.lower);
    check_vector(found->between, k, f.between);
    check_same(found->distance.lane[k], vec3_norm(f.between));
    const ovoid_proof earlier = {.normal = normals[k]};
    CHECK_EQ(reject_by_normal(&f, -INFINITY, &earlier, &by_normal), 1);
    check_vector(found->n, k, by_normal.normal);
    vec3 in_a = {found->in_a[0].lane[k], found->in_a[1].lane[k], found->in_a[2].lane[k]};
    vec3 in_b = {found->in_b[0].lane[k], found->in_b[1].lane[k], found->in_b[2].lane[k]};
    simd_pair ends = frame_find_pair(&f, in_a, in_b);
    check_same((found->along.lane[k] - ends.low.value) - ends.high.value - found->radii.lane[k] - found->claim.lane[k],
               by_normal.lower);
}

// The twin's lane against hull_compute_depth; 1 if the tetrahedron contains the origin.
static int check_depth(const lane_column *upper, unsigned k) {
    pair_frame f = place(k);
    vec3 w[4];
    for (int i = 0; i < 4; i++)
        w[i] = frame_world_difference(&f, vec3_at(places.vertex_a[i][k], 0), vec3_at(places.vertex_b[i][k], 0));
    double depth = hull_compute_depth(w, 4, f.claim);
    check_same(upper->lane[k], depth > 0 ? -depth - f.upper_radii : 0);
    return depth > 0;
}

static void compare_columns(const lane_column *a, const lane_column *b, size_t count, unsigned lanes) {
    for (size_t i = 0; i < count; i++)
        for (unsigned k = 0; k < PAIR8; k++)
            if (lanes >> k & 1) check_same(b[i].lane[k], a[i].lane[k]);
}

static uint64_t odd_gaps, odd_depths, inside, outside;

static void check_proofs(const kept8_kernels *scalar, int is_wild) {
    kept8_gaps gaps, other;
    lane_column upper, other_upper;
    unsigned lanes = (1u << places.count) - 1;
    unsigned odd = scalar->gaps(&places, &errors, &gaps) & lanes;
    unsigned odd_depth = scalar->depths(&places, &errors, &upper) & lanes;
    for (unsigned k = 0; k < places.count; k++) {
        if (!(odd >> k & 1)) check_gap(&gaps, k);
        if (odd_depth >> k & 1) continue;
        int is_in = check_depth(&upper, k);
        inside += (uint64_t)is_in;
        outside += (uint64_t)!is_in;
    }
    if (!is_wild) CHECK_EQ(odd, 0);
    odd_gaps += (uint64_t)__builtin_popcount(odd);
    odd_depths += (uint64_t)__builtin_popcount(odd_depth);
    for (simd_isa isa = SIMD_SCALAR; isa <= SIMD_ISA_COUNT; isa++) {
        const kept8_kernels *kernels =
            isa == SIMD_ISA_COUNT ? kept8_get_kernels(places.count) : kept8_get_kernels_of(isa);
        if (!kernels) continue;
        CHECK_EQ(kernels->gaps(&places, &errors, &other) & lanes, odd);
        CHECK_EQ(kernels->depths(&places, &errors, &other_upper) & lanes, odd_depth);
        compare_columns((lane_column *)&gaps, (lane_column *)&other, sizeof gaps / sizeof upper, lanes & ~odd);
        compare_columns(&upper, &other_upper, 1, lanes & ~odd_depth);
    }
}

// ---- bounds

typedef struct entry {
    uint32_t a, b;
    vec3 v;
    double c;
    uint64_t rest;
} entry;
typedef struct place_of {
    vec3 at;
    double travel;
} place_of;
enum { PLACES = 40 };

static double sum_of(vec3 v) { return fabs(v.x) + fabs(v.y) + fabs(v.z); }

// Which comparisons hold, plainly.
static unsigned compare_one(const entry *e, const place_of *at, double range) {
    vec3 d = vec3_sub(at[e->b].at, at[e->a].at);
    double t = at[e->a].travel + at[e->b].travel, way = vec3_norm(vec3_sub(d, e->v));
    double slack = 0x1p-48 * (sum_of(d) + t + fabs(e->c) + range) + range;
    double centers = 0x1p-45 * (sum_of(at[e->a].at) + sum_of(at[e->b].at));
    return (unsigned)(e->c + vec3_dot(e->v, d) - t > slack) | (unsigned)(e->c - way - t > slack) << 1 |
           (unsigned)(way > e->c + slack + centers) << 2;
}

static uint64_t held[3], failed[3];

// Some comparisons are as near to equality as doubles go.
static void check_bounds(uint64_t *s, unsigned count) {
    entry all[PAIR8];
    place_of at[PLACES];
    double ranges[PAIR8];
    for (unsigned i = 0; i < PLACES; i++)
        at[i] = (place_of){{random_uniform(s, -1, 1), random_uniform(s, -1, 1), random_uniform(s, -1, 1)},
                           random_uniform(s, 0, 0.1)};
    unsigned right[3] = {0, 0, 0};
    for (unsigned k = 0; k < PAIR8; k++) {
        uint32_t a = (uint32_t)(random_next(s) % PLACES), b = (uint32_t)(random_next(s) % PLACES);
        vec3 v = {random_uniform(s, -1, 1), random_uniform(s, -1, 1), random_uniform(s, -1, 1)};
        vec3 d = vec3_sub(at[b].at, at[a].at);
        double t = at[a].travel + at[b].travel, way = vec3_norm(vec3_sub(d, v));
        ranges[k] = k % 3 ? 0 : random_uniform(s, 0, 0.1);
        double edge[] = {t - vec3_dot(v, d) + ranges[k], way + t + ranges[k], way - ranges[k],
                         random_uniform(s, -2, 2)};
        double near = random_next(s) % 2 ? 0x1p-47 : 0x1p-40;
        all[k] = (entry){a, b, v, edge[random_next(s) % 4] * (1 + near * random_uniform(s, -1, 1)), 0};
        if (k >= count) continue;
        unsigned holds = compare_one(&all[k], at, ranges[k]);
        for (int i = 0; i < 3; i++) {
            right[i] |= (holds >> i & 1) << k;
            held[i] += holds >> i & 1;
            failed[i] += !(holds >> i & 1);
        }
    }
    for (simd_isa isa = SIMD_SCALAR; isa <= SIMD_ISA_COUNT; isa++) {
        const kept8_kernels *kernels = isa == SIMD_ISA_COUNT ? kept8_get_kernels(count) : kept8_get_kernels_of(isa);
        if (!kernels) continue;
        kept8_answers found = kernels->compare(&(kept8_bounds){all, sizeof *all, &at[0].at.x, ranges, count});
        unsigned lanes = (1u << count) - 1;
        CHECK_EQ(found.plane & lanes, right[0]);
        CHECK_EQ(found.ball & lanes, right[1]);
        CHECK_EQ(found.sphere & lanes, right[2]);
    }
}

int main(void) {
    uint64_t s = 17;
    if (!make_shapes(&s)) return check_end();
    for (int round = 0; round < ROUNDS; round++) {
        check_seed = (uint64_t)round;
        fill(&s, 1 + (unsigned)round % PAIR8, round % 2);
        check_proofs(kept8_get_kernels_of(SIMD_SCALAR), round % 2);
        check_bounds(&s, 1 + (unsigned)round % PAIR8);
    }
    // Every way was gone.
    CHECK(odd_gaps > 10 && odd_depths > 10 && inside > 50 && outside > 50);
    for (int i = 0; i < 3; i++) CHECK(held[i] > 50 && failed[i] > 50);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
