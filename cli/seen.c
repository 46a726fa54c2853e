// A hash table of pairs, with linear probing.
#include "seen.h"

#include <stdlib.h>
#include <string.h>

/// The slot of a key, or the empty one where it would be.
static uint64_t *find_slot(const cli_seen *s, uint64_t key) {
    size_t at = (size_t)(key * 0x9e3779b97f4a7c15u >> 20) & (s->slot_count - 1);
    while (s->slots[at] && s->slots[at] != key) at = (at + 1) & (s->slot_count - 1);
    return &s->slots[at];
}

static int grow(cli_seen *s) {
    cli_seen grown = {.slot_count = s->slot_count ? 2 * s->slot_count : 1024};
    grown.slots = calloc(grown.slot_count, sizeof *grown.slots);
    if (!grown.slots) return 0;
    for (size_t i = 0; i < s->slot_count; i++)
        if (s->slots[i]) *find_slot(&grown, s->slots[i]) = s->slots[i];
    free(s->slots);
    s->slots = grown.slots;
    s->slot_count = grown.slot_count;
    return 1;
}

int seen_add(cli_seen *s, const ovoid_scene *scene, size_t a, size_t b) {
    if (a == b || ovoid_scene_is_ignored(scene, a, b)) return 1;
    if (2 * (s->count + 1) > s->slot_count && !grow(s)) return 0;
    // The larger index is not 0, so no key is.
    uint64_t key = a < b ? (uint64_t)b << 32 | a : (uint64_t)a << 32 | b, *slot = find_slot(s, key);
    s->count += *slot != key;
    *slot = key;
    return 1;
}

void seen_begin_frame(cli_seen *s) {
    if (s->slots) memset(s->slots, 0, s->slot_count * sizeof *s->slots);
    s->before += s->count;
    s->count = 0;
}

size_t seen_get_count(const cli_seen *s) { return s->before + s->count; }

void seen_clear(cli_seen *s) {
    free(s->slots);
    *s = (cli_seen){.slots = NULL};
}
