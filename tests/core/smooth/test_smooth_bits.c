// The smooth bracket and its derivatives are the same bits from every compiler and level of optimisation: a hash over
// families of shapes near and in each other, stored. Truth: what gcc 12 gave at -O2; clang, -O0 and sanitizers must
// give it too. A change of the arithmetic, or of the shapes' ellipsoids, changes the number; then take the one printed,
// after a look at the other tests.
#include "bits.h"

#define STORED 0xc73a428e8b3c5ae3u

enum { PAIRS = 60 };

static uint64_t add_side(uint64_t hash, const ovoid_smooth_value *v) {
    BITS_ADD(hash, v->value);
    BITS_ADD(hash, v->error);
    BITS_ADD(hash, v->condition);
    BITS_ADD(hash, v->is_smooth);
    BITS_ADD(hash, v->iterations);
    BITS_ADD(hash, v->point_a);
    BITS_ADD(hash, v->point_b);
    BITS_ADD(hash, v->normal);
    BITS_ADD(hash, v->gradient);
    BITS_ADD(hash, v->hessian);
    return hash;
}

int main(void) {
    ovoid_shape *shapes[BITS_SHAPES];
    uint64_t all = BITS_START;
    int made = CHECK(bits_make_shapes(shapes));
    for (int f = 0; f < BITS_FAMILIES && made; f++)
        for (uint32_t i = 0; i < PAIRS; i++) {
            ovoid_pair pair = bits_make_pair(shapes, (bits_family)f, i);
            ovoid_smooth s = ovoid_pair_compute_smooth(&pair, 2);
            all = add_side(add_side(all, &s.outer), &s.inner);
        }
    for (int i = 0; i < BITS_SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    if (!CHECK(all == STORED)) printf("the hash is 0x%016llxu\n", (unsigned long long)all);
    return check_end();
}
