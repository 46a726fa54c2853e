// GJK of eight couples in lanes against the search of each couple alone, bit for bit, no tolerance, for every
// instruction set: couples of all sizes side by side, from the line of centres and from another direction.
#include "small_searches.h"

#include "simd/group_gjk.h"

enum { ROUNDS = 3000 };
static const group_gjk_kernels *kernels;
static long ends[5];

typedef struct couple {
    small_gjk_query query;
    double rows[2][9], vertices[2][3 * SMALL_GJK_POINTS];
    small_gjk_result alone;
} couple;

static pair8 lanes;
static group_gjk group;
static couple couples[PAIR8];

static void put(lane_column *to, const double *from, int count, unsigned k) {
    for (int i = 0; i < count; i++) to[i].lane[k] = from[i];
}

static void fill_vertices(double *to, const simd_points *from) {
    for (uint32_t i = 0; i < from->padded_count; i++) {
        to[3 * i] = from->x[i];
        to[3 * i + 1] = from->y[i];
        to[3 * i + 2] = from->z[i];
    }
}

// A couple's numbers in its lane. Along n, in A's frame, the direction is what is turned back to the world.
static void put_lane(couple *c, unsigned k, int is_along_n) {
    small_gjk_query *q = &c->query;
    put(lanes.world_a, c->rows[0], 9, k);
    put(lanes.world_b, c->rows[1], 9, k);
    put(lanes.offset, q->offset, 3, k);
    put(lanes.between, q->start, 3, k);
    put(lanes.n, q->start, 3, k);
    lanes.radii.lane[k] = q->lower_radii;
    lanes.tolerance.lane[k] = q->tolerance;
    lanes.size.lane[k] = 1;
    group.points_a[k] = q->a;
    group.points_b[k] = q->b;
    fill_vertices(c->vertices[0], &q->a);
    fill_vertices(c->vertices[1], &q->b);
    group.vertices_a[k] = c->vertices[0];
    group.vertices_b[k] = c->vertices[1];
    if (!is_along_n) return;
    const double *r = c->rows[0];
    vec3 n = vec3_at(q->start, 0);
    for (int i = 0; i < 3; i++) q->start[i] = (r[3 * i] * n.x + r[3 * i + 1] * n.y) + r[3 * i + 2] * n.z;
}

static void compare(unsigned some, small_gjk_end end) {
    for (; some; some &= some - 1) {
        unsigned k = (unsigned)__builtin_ctz(some);
        const small_gjk_result *alone = &couples[k].alone;
        small_gjk_result x = {.end = end};
        if (end != SMALL_GJK_OPEN) gjk8_get_result(&group.search, k, end, &x);
        // A first support that ends near is the only corner.
        if (end == SMALL_GJK_NEAR && alone->end == SMALL_GJK_APART) x.end = SMALL_GJK_APART;
        CHECK(same_search(&x, alone));
        ends[end]++;
    }
}

// A result that is put into a lane is what it ends near with.
static void check_put(unsigned k, const small_gjk_result *r) {
    gjk8 g;
    small_gjk_result x;
    if (r->end != SMALL_GJK_NEAR && r->end != SMALL_GJK_APART) return;
    gjk8_put_result(&g, k, r);
    gjk8_get_result(&g, k, SMALL_GJK_NEAR, &x);
    x.end = r->end;
    CHECK(same_search(&x, r));
}

// Eight couples of one goal, of which some are at work.
static void run_group(uint64_t *s) {
    small_gjk_query goal;
    double rows[2][9];
    fill_search(s, &goal, rows);
    const pair8_query numbers = {.hidden = goal.claim / 3, .iterations = goal.iterations};
    gjk8 *g = &group.search;
    group.is_along_n = random_next(s) % 2;
    unsigned some = random_next(s) % 2 ? PAIR8_ALL : 1 + (unsigned)(random_next(s) % PAIR8_ALL);
    for (unsigned k = 0; k < PAIR8; k++) {
        couple *c = &couples[k];
        small_gjk_query *q = &c->query;
        fill_search(s, q, c->rows);
        q->far = goal.far;
        q->near = goal.near;
        q->wants_bracket = goal.wants_bracket;
        q->iterations = goal.iterations;
        q->claim = 0 * 1.0 + 3 * numbers.hidden;
        put_lane(c, k, group.is_along_n);
        simd_run_small_gjk_unposed(q, &c->alone);
        check_put(k, &c->alone);
    }
    g->active = some;
    g->far = goal.far;
    g->near = goal.near;
    g->wants_bracket = goal.wants_bracket;
    kernels->begin(&lanes, &numbers, &group);
    kernels->support(&lanes, &group);
    gjk8_ends all = {0, 0, 0, 0}, now = kernels->start(&group);
    for (;;) {
        CHECK(((now.apart | now.near | now.inside | now.open) & g->active) == 0);
        all.apart |= now.apart;
        all.near |= now.near;
        all.inside |= now.inside;
        all.open |= now.open;
        if (!g->active) break;
        kernels->support(&lanes, &group);
        now = kernels->advance(g);
    }
    // All have ended, each once; and they stayed as they ended.
    CHECK((all.apart | all.near | all.inside | all.open) == some);
    CHECK(!(all.apart & all.near) && !(all.inside & all.open) && !((all.apart | all.near) & (all.inside | all.open)));
    compare(all.apart, SMALL_GJK_APART);
    compare(all.near, SMALL_GJK_NEAR);
    compare(all.inside, SMALL_GJK_INSIDE);
    compare(all.open, SMALL_GJK_OPEN);
}

int main(void) {
    if (!make_bodies(32)) return 1;
    for (int isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++) {
        uint64_t s = 23;
        kernels = group_gjk_get_kernels_of((simd_isa)isa);
        if (!kernels && isa >= SIMD_AVX2) check_skip("an instruction set that this machine or build lacks");
        for (int i = 0; kernels && i < ROUNDS; i++) {
            check_seed = (uint64_t)i;
            run_group(&s);
        }
    }
    for (int i = 0; i < 4; i++) CHECK_LE(500, ends[i]);
    destroy_bodies();
    return check_end();
}
