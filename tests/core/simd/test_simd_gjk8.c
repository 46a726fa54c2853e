// GJK of eight couples in lanes against the search of each couple alone, bit for bit, no tolerance, for every
// instruction set; lanes are filled again while others are at work, couples of all sizes and goals side by side.
#include "small_searches.h"

#include "simd/gjk8.h"

enum { COUPLES = 6000 };
static const gjk8_kernels *kernels;
static long ends[5];

typedef struct couple {
    small_gjk_query query;
    double rows[2][9];
    small_gjk_result alone;
} couple;

static void compare(const gjk8 *g, unsigned lanes, small_gjk_end end, couple *const at[PAIR8]) {
    for (unsigned rest = lanes; rest; rest &= rest - 1) {
        unsigned k = (unsigned)__builtin_ctz(rest);
        small_gjk_result x = {.end = end};
        if (end != SMALL_GJK_OPEN) gjk8_get_result(g, k, end, &x);
        CHECK(same_search(&x, &at[k]->alone));
        ends[end]++;
    }
}

// All couples of one goal, as a batch has them.
static void run_goal(uint64_t *s) {
    static gjk8 g;
    static small_gjk_bodies bodies[PAIR8];
    g.bodies = bodies;
    static couple couples[PAIR8];
    couple *at[PAIR8];
    small_gjk_query goal;
    double rows[2][9];
    fill_search(s, &goal, rows);
    g.active = 0;
    for (int i = 0; i < COUPLES / 100;) {
        for (unsigned k = 0; k < PAIR8 && i < COUPLES / 100; k++) {
            if (g.active >> k & 1) continue;
            couple *c = at[k] = &couples[k];
            fill_search(s, &c->query, c->rows);
            c->query.far = goal.far;
            c->query.near = goal.near;
            c->query.wants_bracket = goal.wants_bracket;
            simd_run_small_gjk(&c->query, &c->alone);
            i++;
            kernels->begin(&g, k, &c->query);
        }
        if (!g.active) continue;
        gjk8_ends e = kernels->advance(&g);
        CHECK(((e.apart | e.near | e.inside | e.open) & g.active) == 0);
        compare(&g, e.apart, SMALL_GJK_APART, at);
        compare(&g, e.near, SMALL_GJK_NEAR, at);
        compare(&g, e.inside, SMALL_GJK_INSIDE, at);
        compare(&g, e.open, SMALL_GJK_OPEN, at);
    }
}

int main(void) {
    if (!make_bodies()) return 1;
    for (int isa = SIMD_SCALAR; isa < SIMD_ISA_COUNT; isa++) {
        uint64_t s = 23;
        kernels = gjk8_get_kernels_of((simd_isa)isa);
        if (!kernels && isa >= SIMD_AVX2) check_skip("an instruction set that this machine or build lacks");
        for (int i = 0; kernels && i < 400; i++) run_goal(&s);
    }
    for (int i = 0; i < 4; i++) CHECK_LE(500, ends[i]);
    destroy_bodies();
    return check_end();
}
