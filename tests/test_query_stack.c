// How much stack a query takes at most: each runs in a thread whose stack was filled with a pattern; what is gone of
// the pattern was used. Truth: the numbers of docs/query.md. Not measured under a sanitizer, which has stacks of its
// own, nor without optimisation.
#define _XOPEN_SOURCE 700 // pthread_attr_setstack
#include "bits.h"

#include <pthread.h>

#if defined(__SANITIZE_ADDRESS__) || !defined(__OPTIMIZE__)
#define MEASURED 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define MEASURED 0
#endif
#endif
#ifndef MEASURED
#define MEASURED 1
#endif

enum { STACK = 256 << 10, PATTERN = 0xa5, PAIRS = 80 };

static _Alignas(65536) unsigned char stack[STACK];
static ovoid_cover cover;
static ovoid_smooth smooth;
static ovoid_gradient gradient;

/// One call of a query.
typedef struct call {
    int query;
    ovoid_pair pair;
    ovoid_answer answer; ///< for the check
} call;
static const struct {
    const char *name;
    size_t most; ///< stated, in bytes
} queries[] = {{"nothing", 16 << 10},  {"collide", 192 << 10}, {"within", 192 << 10}, {"distance", 192 << 10},
               {"depth", 96 << 10},    {"bounds", 12 << 10},   {"check", 56 << 10},   {"smooth", 96 << 10},
               {"gradient", 32 << 10}, {"impact", 208 << 10},  {"ray", 208 << 10}};
enum { QUERIES = sizeof queries / sizeof *queries };

static ovoid_compound_impact found;
static ovoid_ray_hit hit;

// Of two shapes as solids that change places: what both trees and a pair of parts take.
static ovoid_compound_impact find_impact(const ovoid_pair *p) {
    ovoid_moving_solid a = {.shape = p->shape_a, .motion = ovoid_motion_make_poses(p->pose_a, p->pose_b, 1)};
    ovoid_moving_solid b = {.shape = p->shape_b, .motion = ovoid_motion_make_poses(p->pose_b, p->pose_a, 1)};
    return ovoid_compound_impact_find(&a, &b, 0, NULL);
}

static void *run(void *argument) {
    call *c = argument;
    switch (c->query) {
    case 1: c->answer = ovoid_collide(&c->pair, NULL, NULL); break;
    case 2: c->answer = ovoid_within(&c->pair, 0.01, NULL, NULL); break;
    case 3: c->answer = ovoid_distance(&c->pair, NULL, NULL); break;
    case 4: c->answer = ovoid_depth(&c->pair, NULL, NULL, &cover); break;
    case 5: c->answer = ovoid_bounds(&c->pair); break;
    case 6: CHECK(ovoid_answer_check(&c->pair, &c->answer, &cover, NULL) == OVOID_OK); break;
    case 7: smooth = ovoid_smooth_compute(&c->pair, 2); break;
    case 8: gradient = ovoid_answer_compute_gradient(&c->pair, &c->answer, &cover); break;
    case 9: found = find_impact(&c->pair); break;
    case 10:
        hit = ovoid_ray_cast(&(ovoid_body){c->pair.shape_a, c->pair.pose_a},
                             &(ovoid_ray){c->pair.pose_b.position, {1, 2, 3}, INFINITY, 0});
        break;
    default: break;
    }
    return NULL;
}

static size_t measure(call *c) {
    pthread_attr_t attributes;
    pthread_t thread;
    memset(stack, PATTERN, sizeof stack);
    CHECK(pthread_attr_init(&attributes) == 0);
    CHECK(pthread_attr_setstack(&attributes, stack, sizeof stack) == 0);
    if (CHECK(pthread_create(&thread, &attributes, run, c) == 0)) CHECK(pthread_join(thread, NULL) == 0);
    (void)pthread_attr_destroy(&attributes);
    size_t untouched = 0;
    while (untouched < sizeof stack && stack[untouched] == PATTERN) untouched++;
    return sizeof stack - untouched;
}

int main(void) {
    if (!MEASURED) {
        check_skip("stacks are measured in optimised builds without sanitizers");
        return check_end();
    }
    ovoid_shape *shapes[BITS_SHAPES];
    size_t most[QUERIES] = {0};
    if (!CHECK(bits_make_shapes(shapes))) return check_end();
    static call c;
    // A thread that asks nothing has used what the system takes.
    size_t base = measure(&c);
    for (int f = 0; f < BITS_FAMILIES; f++)
        for (uint32_t i = 0; i < PAIRS; i++) {
            c.pair = bits_make_pair(shapes, (bits_family)f, i);
            for (c.query = 1; c.query < QUERIES; c.query++) {
                // The check is of the depth's answer: the query before the bounds; the gradient too.
                if (c.query == 6) c.answer = ovoid_depth(&c.pair, NULL, NULL, &cover);
                size_t used = measure(&c) - base;
                if (used > most[c.query]) most[c.query] = used;
            }
        }
    for (int q = 1; q < QUERIES; q++) {
        printf("%-10s %zu bytes of stack\n", queries[q].name, most[q]);
        CHECK_LE(most[q], queries[q].most);
    }
    for (int i = 0; i < BITS_SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
