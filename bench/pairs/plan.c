// The workloads, family by family; one is in memory at a time, with the bodies of its family.
#include "pairs/plan.h"

#include <stdio.h>
#include <string.h>

typedef struct visit {
    const plan *what;
    visitor call;
    void *context;
} visit;

static int is_wanted(const plan *what, const char *name) { return !what->only || strstr(name, what->only) != NULL; }

/// Passes the workload to the visitor, if there is memory for it, and destroys it.
static int hand_on(const visit *v, workload work) {
    int good = work.pairs != NULL && v->call(v->context, &work);
    workload_destroy(&work);
    return good;
}

static int visit_still(const visit *v, const char *family, const bodies *all, const placement *places, uint32_t count) {
    for (uint32_t i = 0; i < count; i++) {
        char name[40];
        (void)snprintf(name, sizeof name, "%s %s", family, placement_get_name(places[i]));
        if (!is_wanted(v->what, name)) continue;
        if (!hand_on(v, workload_create_still(name, all, places[i]))) return 0;
    }
    return 1;
}

static const placement every_place[] = {PLACE_FAR, PLACE_MID, PLACE_TENTH, PLACE_NEAR, PLACE_SLIGHT, PLACE_OVER};
enum { EVERY_PLACE = sizeof every_place / sizeof every_place[0] };

static int is_family_wanted(const plan *what, const char *family) {
    for (int i = 0; i < PLACE_COUNT; i++) {
        char name[40];
        (void)snprintf(name, sizeof name, "%s %s", family, placement_get_name((placement)i));
        if (is_wanted(what, name)) return 1;
    }
    return 0;
}

static int visit_hulls(const visit *v) {
    for (uint32_t i = 0; i < v->what->size_count && is_family_wanted(v->what, "hulls"); i++) {
        bodies all = bodies_create_hulls(v->what->sizes[i], v->what->count);
        int good = all.count > 0 && visit_still(v, "hulls", &all, every_place, EVERY_PLACE);
        bodies_destroy(&all);
        if (!good) return 0;
    }
    return 1;
}

static int visit_moving_hulls(const visit *v) {
    static const placement places[] = {PLACE_MID, PLACE_NEAR, PLACE_OVER};
    uint32_t tracks = v->what->smoke ? 5 : 40, frames = v->what->smoke ? 3 : 10;
    for (uint32_t i = 0; i < v->what->size_count && is_family_wanted(v->what, "motion"); i++) {
        bodies all = bodies_create_hulls(v->what->sizes[i], tracks);
        int good = all.count > 0;
        for (int k = 0; good && k < 3; k++) {
            char name[40];
            (void)snprintf(name, sizeof name, "motion %s", placement_get_name(places[k]));
            if (is_wanted(v->what, name)) good = hand_on(v, workload_create_moving(name, &all, places[k], frames));
        }
        bodies_destroy(&all);
        if (!good) return 0;
    }
    return 1;
}

static int visit_paper(const visit *v) {
    static const char *const names[] = {"paper cylinders", "paper complex", "paper spheres"};
    bodies all = bodies_create_paper();
    int good = all.count > 0;
    for (uint32_t i = 0; good && i < 3; i++)
        if (is_wanted(v->what, names[i]))
            good =
                hand_on(v, workload_create_passing(names[i], &all, 1 + 10 * i, 10 + 10 * i, v->what->smoke ? 3 : 60));
    bodies_destroy(&all);
    return good;
}

static int visit_boxes(const visit *v) {
    if (!is_family_wanted(v->what, "boxes")) return 1;
    bodies all = bodies_create_boxes(v->what->count);
    int good = all.count > 0 && visit_still(v, "boxes", &all, every_place, EVERY_PLACE);
    bodies_destroy(&all);
    return good;
}

static int visit_real(const visit *v) {
    if (!v->what->data || !is_family_wanted(v->what, "real")) return 1;
    char path[4096];
    (void)snprintf(path, sizeof path, "%s/pieces/game_hulls.bin", v->what->data);
    bodies all = bodies_create_from_clouds(path, v->what->count);
    int good = all.count < 2 || visit_still(v, "real", &all, every_place, EVERY_PLACE);
    bodies_destroy(&all);
    return good;
}

int plan_visit(const plan *what, visitor call, void *context) {
    visit v = {what, call, context};
    return visit_hulls(&v) && visit_boxes(&v) && visit_real(&v) && visit_moving_hulls(&v) && visit_paper(&v);
}
