#include "pairs/field.h"

#include "common/module.h"
#include "pairs/ours.h"

#include <stdio.h>

field field_make(void) { return (field){{&ours}, 1}; }

typedef const peer *const *(*get_peers)(void);

int field_load(field *all, const char *path) {
    get_peers get = (get_peers)module_load(path, "bench_get_peers");
    if (!get) return 0;
    // Four more entrants are ovoid's.
    for (const peer *const *p = get(); *p && all->count < ENTRANTS_MOST - 4; p++) all->members[all->count++] = *p;
    return 1;
}

void field_load_built(field *all) {
    static const struct { const char *name, *path; } modules[] = {OVOID_BENCH_MODULES{"", ""}};
    for (size_t i = 0; i + 1 < sizeof modules / sizeof modules[0]; i++) {
        if (modules[i].path[0])
            (void)field_load(all, modules[i].path);
        else
            printf("without %s: it was not found when this was built\n", modules[i].name);
    }
}

uint32_t field_enter(const field *all, const workload *work, entrant *entrants) {
    uint32_t count = 0;
    entrants[count++] = (entrant){.who = &ours, .self = ours.create(work)};
    entrants[count++] = (entrant){.who = &ours, .warm = 1, .self = work->tracks ? ours.create(work) : NULL};
    entrants[count++] = (entrant){.who = &ours_prepared, .self = ours_prepared.create(work)};
    entrants[count++] =
        (entrant){.who = &ours_prepared, .warm = 1, .self = work->tracks ? ours_prepared.create(work) : NULL};
    entrants[count++] =
        (entrant){.who = &ours_in_batches, .warm = work->tracks > 0, .self = ours_in_batches.create(work)};
    for (uint32_t i = 1; i < all->count; i++)
        entrants[count++] = (entrant){.who = all->members[i], .self = all->members[i]->create(work)};
    return count;
}

void field_leave(entrant *entrants, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        if (entrants[i].self) entrants[i].who->destroy(entrants[i].self);
}
