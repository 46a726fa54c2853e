// The hash set of ignored pairs.
#include "world/ignored.h"
#include "tools/hash.h"

static size_t find_home(const ignored *set, uint64_t key) { return (size_t)hash_number(key) & (set->capacity - 1); }

static int is_end(const void *table, size_t slot, const void *key) {
    uint64_t held = ((const uint64_t *)table)[slot];
    return held == IGNORED_NONE || held == *(const uint64_t *)key;
}

// The place of the key, or the free place where it would be.
static size_t find_place(const ignored *set, uint64_t key) {
    return hash_find(hash_number(key), set->capacity, set->keys, &key, is_end);
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
