// Exclusions that grow: those of a fixed array, bit for bit, from any allocator; where memory is out the answer is the
// same and the count says that the proof is not all there.
#include "compounds.h"
#include "countdown.h"
#include "proofs/covers.h"

#include <string.h>

enum { CAPACITY = 100000, PARTS = 200 };
static ovoid_exclusion items[CAPACITY];
STATIC_COVER(cover);
STATIC_COVER(other);

typedef ovoid_body_answer query(const ovoid_body_pair *pair, const ovoid_options *options,
                                const ovoid_body_evidence *evidence);

static int is_accepted(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_exclusions *all) {
    return ovoid_body_verify(pair, x, &(ovoid_body_basis){.exclusions = all}, NULL) == OVOID_OK;
}

static void check_released(ovoid_exclusions *grown, const countdown *memory) {
    ovoid_exclusions_release(grown);
    CHECK_EQ(memory->held, 0);
    CHECK(!grown->items && !grown->capacity && !grown->count);
    ovoid_exclusions_release(grown);
    CHECK_EQ(memory->held, 0);
}

// With the k-th allocation failing, until none fails.
static size_t check_memory(const ovoid_body_pair *pair, query *ask, const ovoid_body_answer *truth,
                           const ovoid_exclusions *all) {
    for (long k = 0;; k++) {
        countdown memory = {k, 0};
        ovoid_allocator allocator = countdown_make_allocator(&memory);
        ovoid_exclusions grown = {.grows = 1, .allocator = &allocator, .cover = &other};
        ovoid_body_answer x = ask(pair, NULL, &(ovoid_body_evidence){.exclusions = &grown});
        CHECK(!memcmp(&x, truth, sizeof x));
        CHECK_EQ(grown.count, all->count);
        CHECK_LE(memory.held, 1);
        int is_complete = grown.count <= grown.capacity;
        CHECK_EQ(is_complete, memory.left >= 0);
        if (is_complete) {
            CHECK(!grown.count || !memcmp(grown.items, all->items, grown.count * sizeof *grown.items));
            CHECK(is_accepted(pair, &x, &grown));
            // The next query writes over them, in the room that is there.
            size_t capacity = grown.capacity;
            x = ask(pair, NULL, &(ovoid_body_evidence){.exclusions = &grown});
            CHECK(grown.count == all->count && grown.capacity == capacity && is_accepted(pair, &x, &grown));
        } else {
            CHECK(!is_accepted(pair, &x, &grown));
        }
        size_t capacity = grown.capacity;
        check_released(&grown, &memory);
        if (is_complete) return capacity;
    }
}

// From malloc, beginning with what an earlier query left; and arrays of the caller's, which stay.
static void check_fixed(const ovoid_body_pair *pair, query *ask, const ovoid_exclusions *all,
                        ovoid_exclusions *standard) {
    ovoid_body_answer x = ask(pair, NULL, &(ovoid_body_evidence){.exclusions = standard});
    CHECK(standard->count == all->count && is_accepted(pair, &x, standard));
    ovoid_exclusion few[3];
    ovoid_exclusions fixed = {.items = few, .capacity = 3};
    ask(pair, NULL, &(ovoid_body_evidence){.exclusions = &fixed});
    CHECK(fixed.items == few && fixed.capacity == 3 && fixed.count == all->count);
    ovoid_exclusions_release(&fixed);
    CHECK(fixed.items == few && fixed.capacity == 3);
}

static size_t check_pair(const ovoid_body_pair *pair, ovoid_exclusions *standard) {
    static query *const queries[] = {ovoid_body_distance, ovoid_body_depth, ovoid_body_collide};
    size_t most = 0;
    for (int i = 0; i < 3; i++) {
        ovoid_exclusions all = {.items = items, .capacity = CAPACITY, .cover = &cover};
        ovoid_body_answer x = queries[i](pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        CHECK_LE(all.count, CAPACITY);
        size_t capacity = check_memory(pair, queries[i], &x, &all);
        CHECK(capacity >= all.count && capacity <= 64 + 4 * all.count);
        check_fixed(pair, queries[i], &all, standard);
        if (all.count > most) most = all.count;
    }
    return most;
}

int main(void) {
    ovoid_exclusions standard = {.grows = 1, .cover = &other};
    size_t most = 0;
    for (int i = 0; i < 8; i++) {
        uint64_t s = check_seed = 77 + (uint64_t)i;
        ovoid_shape *shapes[SHAPES];
        if (!make_shapes(shapes, 1, &s)) return check_end();
        ovoid_compound *a = make_compound(shapes, PARTS, 6, &s), *b = make_compound(shapes, PARTS, 6, &s);
        ovoid_body_pair pair = {{.compound = a, .pose = {{0, 0, 0}, {1, 0, 0, 0}}},
                                {.compound = b, .pose = {{4.0 * i, 0, 0}, random_quat(&s)}}};
        size_t count = CHECK(a && b) ? check_pair(&pair, &standard) : 0;
        if (count > most) most = count;
        ovoid_compound_destroy(a);
        ovoid_compound_destroy(b);
        destroy_shapes(shapes);
    }
    CHECK(most > 256); // room was doubled more than once
    ovoid_exclusions_release(&standard);
    ovoid_exclusions_release(NULL);
    return check_end();
}
