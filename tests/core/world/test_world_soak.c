// Worlds at random: test_world_soak [--lives N] [--seed S] [--seconds T]. 3 lives where nothing is said, so that what
// is checked does not depend on the machine; --seconds: as many as that takes. Every frame is compared with all pairs
// asked one by one (worlds.h), a quarter of the frames have manifolds, compared likewise (worlds.h), and the
// world's memory is compared with what its bodies, pairs and manifolds may take (world_life.h).
#include "options.h"
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
    static life l;
    life_begin(&l, seed, scales[seed % 4], shapes);
    ovoid_contact_query q = {.kind = OVOID_QUERY_COLLIDE};
    for (int f = 0; f < FRAMES && !is_over(); f++) {
        life_frame(&l, &q);
        life_step(&l);
    }
    life_end(&l);
}

int main(int count, char **arguments) {
    uint64_t seed = 1, most = 3, seconds = 0;
    const test_option options[] = {
        {"lives", "worlds (3)", &most, NULL, NULL, NULL},
        {"seed", "of the first (1)", &seed, NULL, NULL, NULL},
        {"seconds", "goes on for so long, whatever their number", &seconds, NULL, NULL, NULL},
        {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    if (seconds) end_at = time(NULL) + (time_t)seconds;
    uint64_t lives = 0;
    for (; (end_at || lives < most) && !is_over() && !check_failed; lives++) run(seed++);
    printf("%llu lives, %ld checks\n", (unsigned long long)lives, check_passed);
    return check_end();
}
