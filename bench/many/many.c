// `bench --many`.
#include "many/many.h"

#include "common/build.h"
#include "common/module.h"
#include "many/many_ours.h"

#include <stdio.h>

many_plan many_plan_make(void) { return (many_plan){{1000, 10000, 100000}, 3, 40, 16, 200, 100000, 4000, NULL, NULL}; }

many_plan many_plan_make_smoke(void) { return (many_plan){{50, 200}, 2, 0, 2, 2, 20, 20, NULL, NULL}; }

static void enter(many_field *all, many_peers peers) {
    for (; *peers.swarms && all->swarm_count < CONTESTANTS_MOST; peers.swarms++)
        all->swarms[all->swarm_count++] = *peers.swarms;
    for (; *peers.cells && all->cell_count < CONTESTANTS_MOST; peers.cells++)
        all->cells[all->cell_count++] = *peers.cells;
}

typedef many_peers (*get_many_peers)(void);

static void load_built(many_field *all) {
    static const struct { const char *name, *path; } modules[] = {OVOID_BENCH_MANY_MODULES{"", ""}};
    for (size_t i = 0; i + 1 < sizeof modules / sizeof modules[0]; i++) {
        if (!modules[i].path[0]) {
            printf("without %s: it was not found when this was built\n", modules[i].name);
            continue;
        }
        get_many_peers get = (get_many_peers)module_load(modules[i].path, "bench_get_many_peers");
        if (get) enter(all, get());
    }
}

int many_run(const many_plan *plan, const char *csv, const char *svg, int alone) {
    static rows all;
    many_field who = {0};
    printf("%s\n", get_build());
    enter(&who, many_get_ours());
    if (!alone) load_built(&who);
    if (!many_run_swarms(&all, &who, plan) || !many_run_cells(&all, &who, plan)) return 0;
    return (!csv || rows_write_csv(&all, csv)) && (!svg || rows_write_svg(&all, svg));
}
