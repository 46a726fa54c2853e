// bench_web FILE: nanoseconds of native queries about the pairs that pairs.mjs writes, the least of several rounds
// each: collide, distance, depth, and distances in a batch.
#include <ovoid/ovoid.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { ROUNDS = 15, QUERIES = 4 };

typedef struct pairs {
    size_t count;
    ovoid_pair *items;
    ovoid_posed_shape *bodies; // two of each pair
    ovoid_couple *couples;
    ovoid_verdict *verdicts;
} pairs;

static double get_seconds(void) {
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double sum;

static void ask(const pairs *p, int query) {
    if (query == 3) {
        ovoid_batch batch = {.bodies = p->bodies,
                             .body_count = 2 * p->count,
                             .couples = p->couples,
                             .couple_count = p->count,
                             .verdicts = p->verdicts};
        if (ovoid_distance_batch(&batch, NULL)) exit(1);
        return;
    }
    for (size_t i = 0; i < p->count; i++) {
        ovoid_answer answer = query == 0   ? ovoid_collide(&p->items[i], NULL, NULL)
                              : query == 1 ? ovoid_distance(&p->items[i], NULL, NULL)
                                           : ovoid_depth(&p->items[i], NULL, NULL, NULL);
        sum += answer.lower;
    }
}

static double *read_numbers(const char *path) {
    FILE *file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END)) return NULL;
    long size = ftell(file);
    rewind(file);
    double *numbers = size > 0 ? malloc((size_t)size) : NULL;
    int is_read = numbers && fread(numbers, 1, (size_t)size, file) == (size_t)size;
    fclose(file);
    return is_read ? numbers : NULL;
}

static pairs make_pairs(const double *from) {
    size_t vertices = (size_t)from[0], hulls = (size_t)from[1], count = (size_t)from[2];
    ovoid_shape **shapes = malloc(hulls * sizeof *shapes);
    pairs p = {count, malloc(count * sizeof *p.items), malloc(2 * count * sizeof *p.bodies),
               malloc(count * sizeof *p.couples), malloc(count * sizeof *p.verdicts)};
    if (!shapes || !p.items || !p.bodies || !p.couples || !p.verdicts) exit(1);
    from += 3;
    for (size_t i = 0; i < hulls; i++, from += 3 * vertices)
        shapes[i] = ovoid_shape_create_from_points(from, vertices, NULL, NULL);
    for (size_t i = 0; i < count; i++, from += 9) {
        ovoid_pose pose = {{from[2], from[3], from[4]}, {from[5], from[6], from[7], from[8]}};
        p.items[i] = (ovoid_pair){.shape_a = shapes[(size_t)from[0]],
                                  .pose_a = ovoid_pose_make_identity(),
                                  .shape_b = shapes[(size_t)from[1]],
                                  .pose_b = pose};
        p.bodies[2 * i] = (ovoid_posed_shape){p.items[i].shape_a, p.items[i].pose_a};
        p.bodies[2 * i + 1] = (ovoid_posed_shape){p.items[i].shape_b, pose};
        p.couples[i] = (ovoid_couple){(uint32_t)(2 * i), (uint32_t)(2 * i + 1)};
    }
    free(shapes);
    return p;
}

int main(int argc, char **argv) {
    int is_help = argc == 2 && strcmp(argv[1], "--help") == 0;
    double *numbers = argc == 2 && !is_help ? read_numbers(argv[1]) : NULL;
    if (!numbers)
        return fprintf(is_help ? stdout : stderr, "bench_web: FILE, as pairs.mjs writes it\n"), is_help ? 0 : 2;
    pairs p = make_pairs(numbers);
    for (int query = 0; query < QUERIES; query++) {
        double best = 1e9;
        for (int round = 0; round < ROUNDS; round++) {
            double start = get_seconds();
            ask(&p, query);
            double seconds = get_seconds() - start;
            if (seconds < best) best = seconds;
        }
        printf("%.1f\n", 1e9 * best / (double)p.count);
    }
    return sum == 0.12345; // so that the compiler keeps the answers
}
