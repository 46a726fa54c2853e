// The same bits from every compiler, level of optimisation and vector width: a hash of 36 000 answers, of verdicts and
// of the shapes that they are about, stored. Truth: what gcc 12 gave at -O2; clang, -O0 and sanitizers must give it
// too, and so must each vector width of this machine. scripts/bits.sh and scripts/ports.sh compare builds; --print
// shows the hash of each family, to see where bits part; --pairs N that of the first N pairs of each only, for slow
// machines. A change of any step's arithmetic changes the number; then take the one printed, after a look at the other
// tests.
#include "bits.h"
#include "options.h"

#define STORED 0x8e78a613d9f4c05eu

enum { PAIRS = 250 };

static uint64_t add_family(uint64_t hash, ovoid_shape *const shapes[BITS_SHAPES], bits_family f, uint32_t pairs) {
    for (int i = 0; i < BITS_EACH; i++) hash = bits_add_shape(hash, shapes[(int)f * BITS_EACH + i]);
    for (uint32_t i = 0; i < pairs; i++) {
        ovoid_pair p = bits_make_pair(shapes, f, i);
        hash = bits_add_pair(hash, &p);
    }
    return hash;
}

static ovoid_code ask(int question, const ovoid_batch *batch, bits_family f) {
    if (question == 0) return ovoid_collide_batch(batch, NULL);
    return question == 1 ? ovoid_within_batch(batch, 0.25 * bits_scale(f), NULL) : ovoid_distance_batch(batch, NULL);
}

// The answers of a batch of the family's pairs, and the verdicts of a batch that wants nothing else.
static uint64_t add_batches(uint64_t hash, ovoid_shape *const shapes[BITS_SHAPES], bits_family f, uint32_t pairs) {
    static ovoid_posed_shape bodies[2 * PAIRS];
    static ovoid_couple couples[PAIRS];
    static ovoid_answer answers[PAIRS];
    for (uint32_t i = 0; i < pairs; i++) {
        ovoid_pair p = bits_make_pair(shapes, f, i);
        bodies[2 * i] = (ovoid_posed_shape){p.shape_a, p.pose_a};
        bodies[2 * i + 1] = (ovoid_posed_shape){p.shape_b, p.pose_b};
        couples[i] = (ovoid_couple){2 * i, 2 * i + 1};
    }
    static ovoid_verdict verdicts[PAIRS];
    ovoid_batch batch = {.bodies = bodies,
                         .body_count = 2 * (size_t)pairs,
                         .couples = couples,
                         .couple_count = pairs,
                         .answers = answers};
    ovoid_batch alone = batch;
    alone.answers = NULL;
    alone.verdicts = verdicts;
    for (int question = 0; question < 3; question++) {
        CHECK(ask(question, &batch, f) == OVOID_OK && ask(question, &alone, f) == OVOID_OK);
        for (uint32_t i = 0; i < pairs; i++) hash = bits_add_answer(hash, &answers[i]);
        hash = bits_add(hash, verdicts, pairs * sizeof *verdicts);
    }
    return hash;
}

static uint64_t hash_all(int print, uint32_t pairs) {
    ovoid_shape *shapes[BITS_SHAPES];
    uint64_t all = BITS_START;
    int made = CHECK(bits_make_shapes(shapes));
    for (int f = 0; f < BITS_FAMILIES && made; f++) {
        uint64_t one = add_family(BITS_START, shapes, (bits_family)f, pairs);
        one = add_batches(one, shapes, (bits_family)f, pairs);
        if (print) printf("%-10s %016llx\n", bits_names[f], (unsigned long long)one);
        BITS_ADD(all, one);
    }
    for (int i = 0; i < BITS_SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    if (print) printf("%-10s %016llx\n", "all", (unsigned long long)all);
    return all;
}

static uint64_t truth;
static void check_narrower(void) { CHECK(hash_all(0, PAIRS) == truth); }

int main(int count, char **arguments) {
    int print = 0;
    uint64_t few = 0;
    const test_option options[] = {{"print", "the hash of each pair", NULL, NULL, NULL, &print},
                                   {"pairs", "so many alone, and no check of the hash", &few, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    uint64_t hash = hash_all(print, few > 0 && few < PAIRS ? (uint32_t)few : PAIRS);
    if (few > 0) return check_end();
    if (!CHECK(hash == STORED)) printf("the hash is 0x%016llxu\n", (unsigned long long)hash);
    truth = hash;
    bits_run_narrower(check_narrower);
    return check_end();
}
