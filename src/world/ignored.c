// The hash set of ignored pairs.
#include "world/ignored.h"

// Multiplication by the golden ratio, upper bits (D. E. Knuth, 6.4).
static size_t find_home(const ignored *set, uint64_t key) {
    uint64_t mixed = (key ^ key >> 29) * 0x9e3779b97f4a7c15u;
    return (size_t)(mixed >> 20) & (set->capacity - 1);
}

// The place of the key, or the free place where it would be.
static size_t find_place(const ignored *set, uint64_t key) {
    size_t at = find_home(set, key);
    while (set->keys[at] != key && set->keys[at] != IGNORED_NONE) at = (at + 1) & (set->capacity - 1);
    return at;
}

int ignored_is_in(const ignored *set, uint64_t key) { return set->count && set->keys[find_place(set, key)] == key; }

int ignored_add(ignored *set, uint64_t key) {
    size_t at = find_place(set, key);
    if (set->keys[at] == key) return 0;
    set->keys[at] = key;
    set->count++;
    return 1;
}

// Frees a place; the keys after it are shifted back unless their home lies between.
static void remove_at(ignored *set, size_t at) {
    size_t mask = set->capacity - 1;
    for (size_t next = (at + 1) & mask; set->keys[next] != IGNORED_NONE; next = (next + 1) & mask) {
        size_t home = find_home(set, set->keys[next]);
        if (((next - home) & mask) < ((next - at) & mask)) continue;
        set->keys[at] = set->keys[next];
        at = next;
    }
    set->keys[at] = IGNORED_NONE;
    set->count--;
}

int ignored_remove(ignored *set, uint64_t key) {
    if (!set->count) return 0;
    size_t at = find_place(set, key);
    if (set->keys[at] != key) return 0;
    remove_at(set, at);
    return 1;
}

void ignored_remove_body(ignored *set, uint32_t body) {
    for (size_t i = 0; i < set->capacity;) {
        uint64_t key = set->keys[i];
        // The key that was shifted into this place is examined next.
        if (key != IGNORED_NONE && (key_get_a(key) == body || key_get_b(key) == body))
            remove_at(set, i);
        else
            i++;
    }
}
