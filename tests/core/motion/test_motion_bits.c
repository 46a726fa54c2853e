// The same bits from every compiler: a hash of poses, boxes and motions' checks, stored, as no other step's arithmetic
// is in it; and with --print one of impacts, approaches and rays too, which scripts/bits.sh and scripts/ports.sh
// compare between builds (their queries' bits are those of test_query_bits); --cases N of the first N cases only. Truth
// of the stored one: what gcc 12 gave at -O2.
#include "moving.h"
#include "options.h"

#define STORED 0x94e8ece75b062bf8u

enum { CASES = 600 };

static uint64_t add_impact(uint64_t hash, const ovoid_impact *x) {
    BITS_ADD(hash, x->status);
    BITS_ADD(hash, x->limit);
    BITS_ADD(hash, x->iterations);
    BITS_ADD(hash, x->free_until);
    BITS_ADD(hash, x->hit_at);
    uint64_t steps = x->step_count;
    BITS_ADD(hash, steps);
    return bits_add_answer(hash, &x->hit);
}

static uint64_t hash_motions(uint64_t cases) {
    uint64_t hash = BITS_START;
    for (uint64_t seed = 1; seed <= cases; seed++) {
        moving_case c;
        moving_make(&c, seed);
        for (int i = 0; i <= 10; i++) {
            ovoid_pose a = ovoid_moving_shape_compute_pose(&c.a, i / 10.0),
                       b = ovoid_moving_shape_compute_pose(&c.b, i / 10.0);
            BITS_ADD(hash, a);
            BITS_ADD(hash, b);
        }
        ovoid_box box[2] = {ovoid_moving_shape_compute_box(&c.a, 0.1, 0.7), ovoid_moving_shape_compute_box(&c.b, 0, 1)};
        BITS_ADD(hash, box);
        moving_destroy(&c);
    }
    return hash;
}

static uint64_t hash_impacts(uint64_t cases) {
    uint64_t hash = BITS_START;
    for (uint64_t seed = 1; seed <= cases; seed++) {
        moving_case c;
        moving_make(&c, seed);
        ovoid_impact x = ovoid_impact_find(&(ovoid_moving_pair){c.a, c.b, seed % 2 ? 0 : 0.125 * c.size}, NULL);
        hash = add_impact(hash, &x);
        if (seed % 4 == 0) {
            ovoid_approach y = ovoid_approach_find(&(ovoid_moving_pair){c.a, c.b, 0}, NULL);
            BITS_ADD(hash, y.lower);
            BITS_ADD(hash, y.upper);
            BITS_ADD(hash, y.time);
        }
        ovoid_pair pair = moving_get_pair(&c.a, &c.b, 0);
        x = ovoid_shape_cast(&pair, moving_scaled(pair.pose_b.position, -2), 0, NULL);
        hash = add_impact(hash, &x);
        ovoid_posed_shape body = {pair.shape_a, pair.pose_a};
        ovoid_ray ray = {pair.pose_b.position, moving_scaled(pair.pose_b.position, -1), INFINITY, 0};
        ovoid_ray_hit hit = ovoid_shape_cast_ray(&body, &ray);
        BITS_ADD(hash, hit.lower);
        BITS_ADD(hash, hit.upper);
        BITS_ADD(hash, hit.point);
        moving_destroy(&c);
    }
    return hash;
}

int main(int count, char **arguments) {
    int print = 0;
    uint64_t few = 0;
    const test_option options[] = {{"print", "the hashes", NULL, NULL, NULL, &print},
                                   {"cases", "so many alone, and no check of the hash", &few, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    uint64_t cases = few > 0 && few < CASES ? few : CASES;
    uint64_t hash = hash_motions(cases), impacts = hash_impacts(cases);
    if (print)
        printf("%-10s %016llx\n%-10s %016llx\n", "motions", (unsigned long long)hash, "impacts",
               (unsigned long long)impacts);
    if (few > 0) return check_end();
    if (!CHECK(hash == STORED)) printf("the hash is 0x%016llxu\n", (unsigned long long)hash);
    CHECK(hash_impacts(cases) == impacts);
    return check_end();
}
