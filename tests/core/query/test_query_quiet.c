// Queries allocate nothing and leave no floating-point flag behind that the caller did not have: malloc and its family
// are replaced by counters in this program. Truth: the counter. glibc only, and not on sanitizers, which own malloc.
#include "check.h"
#include "ovoid/ovoid.h"
#include "proofs/covers.h"

#if defined(__SANITIZE_ADDRESS__) || !defined(__GLIBC__)
#define OWN_MALLOC 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define OWN_MALLOC 0
#endif
#endif
#ifndef OWN_MALLOC
#define OWN_MALLOC 1
#endif

static volatile long allocations;

#if OWN_MALLOC
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void *malloc(size_t size) {
    allocations++;
    return __libc_malloc(size);
}
void *calloc(size_t count, size_t size) {
    allocations++;
    return __libc_calloc(count, size);
}
void *realloc(void *memory, size_t size) {
    allocations++;
    return __libc_realloc(memory, size);
}
void *aligned_alloc(size_t alignment, size_t size) {
    allocations++;
    return __libc_memalign(alignment, size);
}
#endif

int main(void) {
    if (!OWN_MALLOC) {
        check_skip("allocations are counted with glibc only, and not under a sanitizer");
        return check_end();
    }
    ovoid_shape *a = ovoid_shape_create_prism(&(ovoid_prism){1, 1, 40}, NULL, NULL);
    ovoid_shape *b = ovoid_shape_create_box((ovoid_vec3){0.5, 1, 2}, NULL, NULL);
    CHECK(a && b && allocations > 0);
    STATIC_COVER(cover);
    uint64_t s = 1;
    ovoid_posed_shape parts[3] = {
        {a, {{0, 0, 3}, {1, 0, 0, 0}}}, {b, {{1, 0, 0}, {1, 2, 0, 0}}}, {b, {{0, -2, 0}, {3, 2, 0, 1}}}};
    ovoid_compound *compound = ovoid_compound_create(parts, 3, NULL, NULL);
    static ovoid_exclusion items[64];
    ovoid_exclusions all = {.items = items, .capacity = 64, .cover = &cover};
    CHECK(compound != NULL);
    long before = allocations;
    double sum = 0;
    for (int i = 0; i < 2000; i++) {
        ovoid_pair p = {a, b, {{0, 0, 0}, {1, 0.1, 0.2, 0.3}}, {{0, 0, 0}, {1, 0, 0, 0}}};
        p.pose_b.position =
            (ovoid_vec3){random_uniform(&s, -3, 3), random_uniform(&s, -3, 3), random_uniform(&s, -3, 3)};
        ovoid_answer x = ovoid_depth(&p, NULL, NULL, &cover);
        sum += x.lower + ovoid_collide(&p, NULL, &x.proof).upper + ovoid_within(&p, 0.1, NULL, NULL).upper;
        sum += ovoid_distance(&p, NULL, NULL).upper + ovoid_pair_compute_bounds(&p).upper;
        sum += ovoid_answer_verify(&p, &x, &(ovoid_answer_basis){.cover = &cover}, NULL);
        sum += ovoid_depth_from(&p, NULL, &x.proof, &cover).upper;
        static ovoid_manifold_polygon polygon;
        ovoid_manifold_points points;
        ovoid_manifold_options with = {.margin = 0.1, .cover = &cover, .points = &points};
        ovoid_manifold contact = ovoid_manifold_find(&p, &with, NULL);
        contact = ovoid_manifold_find(&p, &with, &contact);
        sum += contact.lower + ovoid_manifold_compute_points(&p, &contact).grown;
        sum += ovoid_manifold_verify(&p, &contact, &with, NULL);
        sum += ovoid_manifold_compute_polygon(&p, &contact, &with, &polygon);
        ovoid_moving_shape moving[2] = {{.shape = a, .motion = ovoid_motion_make_poses(p.pose_a, p.pose_b, 1)},
                                        {.shape = b, .motion = ovoid_motion_make_poses(p.pose_b, p.pose_a, 1)}};
        ovoid_moving_body whole[2] = {{.compound = compound, .motion = moving[0].motion},
                                      {.shape = b, .motion = moving[1].motion}};
        static ovoid_step steps[100];
        ovoid_motion_options o = {.steps = steps, .capacity = 100};
        ovoid_impact hit = ovoid_impact_find(&(ovoid_moving_pair){moving[0], moving[1], 0}, &o);
        if (hit.step_count <= 100)
            sum += ovoid_impact_verify(&(ovoid_moving_pair){moving[0], moving[1], 0}, &hit,
                                       &(ovoid_motion_basis){.steps = steps}, NULL);
        if (i % 20 == 0) {
            sum += ovoid_approach_find(&(ovoid_moving_pair){moving[0], moving[1], 0}, NULL).upper;
            sum += (double)ovoid_body_impact_find(&(ovoid_moving_body_pair){whole[0], whole[1], 0}, NULL).tested;
            sum += ovoid_moving_body_compute_box(&whole[0], 0, 1).min.x;
        }
        ovoid_ray ray = {{9, 1, 0}, {-1, 0.1, 0}, INFINITY, 0};
        sum += ovoid_shape_cast_ray(&(ovoid_posed_shape){a, p.pose_b}, &ray).iterations;
        sum += ovoid_shape_cast(&p, (ovoid_vec3){1, 2, 3}, 0, NULL).free_until;
        ovoid_body_pair bodies = {{.compound = compound, .pose = p.pose_a}, {.compound = compound, .pose = p.pose_b}};
        ovoid_body_answer y = ovoid_body_depth(&bodies, NULL, &(ovoid_body_evidence){.exclusions = &all});
        sum += y.upper + (double)ovoid_body_verify(&bodies, &y, &(ovoid_body_basis){.exclusions = &all}, NULL);
    }
    CHECK(isfinite(sum));
    CHECK_EQ(allocations - before, 0);
    ovoid_compound_destroy(compound);
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    return check_end();
}
