// A hash table of pairs.
#include "seen.h"
#include "tools/hash.h"

#include <stdlib.h>
#include <string.h>

/// The larger index is not 0, so no key is.
static uint64_t make_key(ovoid_couple c) { return c.a < c.b ? (uint64_t)c.b << 32 | c.a : (uint64_t)c.a << 32 | c.b; }

static int is_end(const void *table, size_t slot, const void *key) {
    uint64_t held = ((const uint64_t *)table)[slot];
    return !held || held == *(const uint64_t *)key;
}

/// The slot of a key, or the empty one where it would be.
static size_t find_slot(const cli_seen *s, uint64_t key) {
    return hash_find(hash_number(key), s->slot_count, s->slots, &key, is_end);
}

static int grow(cli_seen *s) {
    cli_seen grown = {.slot_count = s->slot_count ? 2 * s->slot_count : 1024, .count = s->count};
    grown.slots = calloc(grown.slot_count, sizeof *grown.slots);
    grown.flags = calloc(grown.slot_count, 1);
    if (!grown.slots || !grown.flags) return seen_clear(&grown), 0;
    for (size_t i = 0; i < s->slot_count; i++) {
        if (!s->slots[i]) continue;
        size_t at = find_slot(&grown, s->slots[i]);
        grown.slots[at] = s->slots[i];
        grown.flags[at] = s->flags[i];
    }
    free(s->slots);
    free(s->flags);
    s->slots = grown.slots;
    s->flags = grown.flags;
    s->slot_count = grown.slot_count;
    return 1;
}

unsigned char *seen_add(cli_seen *s, ovoid_couple couple) {
    if (2 * (s->count + 1) > s->slot_count && !grow(s)) return NULL;
    uint64_t key = make_key(couple);
    size_t at = find_slot(s, key);
    if (!s->slots[at]) s->slots[at] = key, s->count++;
    return &s->flags[at];
}

unsigned seen_get(const cli_seen *s, ovoid_couple couple) {
    return s->slot_count ? s->flags[find_slot(s, make_key(couple))] : 0;
}

void seen_empty(cli_seen *s) {
    if (s->slots) memset(s->slots, 0, s->slot_count * sizeof *s->slots);
    if (s->flags) memset(s->flags, 0, s->slot_count);
    s->count = 0;
}

void seen_clear(cli_seen *s) {
    free(s->slots);
    free(s->flags);
    *s = (cli_seen){.slots = NULL};
}
