// Worlds at random for as long as one likes: test_world_soak [--seconds N] [--seed S], 2 seconds where nothing is said.
// Every frame is compared with all pairs asked one by one (worlds.h), and the memory of a world that has lived for a
// while must not grow any more.
#include "world_life.h"

#include <time.h>

enum { FRAMES = 400 };

// One life; the worlds of other seeds are of other scales.
static void run(uint64_t seed, time_t end) {
    static const double scales[4] = {1, 1e-9, 1e9, 1};
    check_seed = seed;
    ovoid_shape *shapes[WORLD_SHAPES];
    life l;
    life_begin(&l, seed, scales[seed % 4], shapes);
    ovoid_frame_query q = {.question = OVOID_QUESTION_COLLIDE};
    // All pairs of the most bodies there may be, and twice the room for each: no life needs more.
    size_t least = 0;
    for (int f = 0; f < FRAMES && time(NULL) <= end; f++) {
        size_t memory = life_frame(&l, &q);
        if (f == FRAMES / 4) least = memory;
        if (f > FRAMES / 4) CHECK_LE(memory, 3 * least);
        life_step(&l);
    }
    life_end(&l);
}

int main(int count, char **arguments) {
    long seconds = 2;
    uint64_t seed = 1;
    for (int i = 1; i + 1 < count; i += 2) {
        if (!strcmp(arguments[i], "--seconds")) seconds = strtol(arguments[i + 1], NULL, 10);
        if (!strcmp(arguments[i], "--seed")) seed = strtoull(arguments[i + 1], NULL, 10);
    }
    time_t end = time(NULL) + seconds;
    long lives = 0;
    for (; time(NULL) <= end && !check_failed; lives++) run(seed++, end);
    printf("%ld lives, %ld checks\n", lives, check_passed);
    return check_end();
}
