// Worlds at random: test_world_soak [--lives N] [--seed S] [--seconds T]. 3 lives where nothing is said, so that what
// is checked does not depend on the machine; --seconds: as many as that takes. Every frame is compared with all pairs
// asked one by one (worlds.h), and the world's memory with what its bodies and pairs may take (world_life.h).
#include "world_life.h"

#include <time.h>

enum { FRAMES = 400 };

// When to stop; 0: never.
static time_t end_at;
static int is_over(void) { return end_at && time(NULL) > end_at; }

// One life; the worlds of other seeds are of other scales.
static void run(uint64_t seed) {
    static const double scales[4] = {1, 1e-9, 1e9, 1};
    check_seed = seed;
    ovoid_shape *shapes[WORLD_SHAPES];
    life l;
    life_begin(&l, seed, scales[seed % 4], shapes);
    ovoid_contact_query q = {.kind = OVOID_QUERY_COLLIDE};
    for (int f = 0; f < FRAMES && !is_over(); f++) {
        life_frame(&l, &q);
        life_step(&l);
    }
    life_end(&l);
}

int main(int count, char **arguments) {
    uint64_t seed = 1, most = 3;
    for (int i = 1; i + 1 < count; i += 2) {
        if (!strcmp(arguments[i], "--lives")) most = strtoull(arguments[i + 1], NULL, 10);
        if (!strcmp(arguments[i], "--seed")) seed = strtoull(arguments[i + 1], NULL, 10);
        if (!strcmp(arguments[i], "--seconds")) end_at = time(NULL) + strtol(arguments[i + 1], NULL, 10);
    }
    uint64_t lives = 0;
    for (; (end_at || lives < most) && !is_over() && !check_failed; lives++) run(seed++);
    printf("%llu lives, %ld checks\n", (unsigned long long)lives, check_passed);
    return check_end();
}
