// Where the meshes are: each address is looked for once.
#include "robot/read/urdf/geometry.h"
#include "robot/read/urdf/packages.h"

#include <string.h>

static int compare_addresses(const void *a, const void *b) {
    const geometry *m = *(geometry *const *)a, *n = *(geometry *const *)b;
    int order = strcmp(m->address, n->address);
    return order ? order : (m->index > n->index) - (m->index < n->index);
}

// Tells of all that are absent, in the order of the file.
static ovoid_code tell_absent(robot_reader *r, const package_search *search, const geometry_list *list) {
    const geometry *first = NULL;
    size_t count = 0;
    for (size_t i = 0; i < list->count; i++) {
        const geometry *g = &list->items[i];
        char places[700];
        if (!g->is_absent) continue;
        package_search_describe(search, g->address, places, sizeof places);
        robot_note(r, g->at, "the mesh %.200s is absent: %s", g->address, places);
        if (!count++) first = g;
    }
    if (!count) return OVOID_OK;
    if (strncmp(first->address, "package://", 10) != 0)
        return robot_fail(r, first->at, OVOID_ERROR_FILE,
                          "the mesh \"%.70s\" is absent%s; put the file there, or write package://NAME/PATH into the "
                          "URDF and say where the package is: --package NAME=DIR",
                          first->address, count > 1 ? ", as are others" : "");
    return robot_fail(r, first->at, OVOID_ERROR_FILE,
                      "the mesh \"%.70s\" is absent%s; say where its package is: --package NAME=DIR", first->address,
                      count > 1 ? ", as are others" : "");
}

// Tells once of each package that was found by the end of a path only.
static void note_tail(const robot_reader *r, const geometry *g, const char **last) {
    const char *name = g->address + strlen("package://");
    size_t length = strcspn(name, "/");
    if (*last && strncmp(*last, name, length + 1) == 0) return;
    *last = name;
    robot_note(r, g->at, "the package %.*s is nowhere; its meshes are taken by the ends of their paths, as %.200s",
               (int)(length < 100 ? length : 100), name, g->path);
}

static ovoid_code fail_address(robot_reader *r, const geometry *g, package_result result) {
    if (result == PACKAGE_NO_MEMORY) return robot_fail_memory(r);
    if (result == PACKAGE_LEFT)
        return robot_fail(r, g->at, OVOID_ERROR_FORMAT,
                          "the mesh \"%.80s\" leaves its package by \"..\", which is refused", g->address);
    return robot_fail(r, g->at, OVOID_ERROR_FORMAT,
                      "the mesh \"%.80s\" is neither package://NAME/PATH nor file:// nor a path", g->address);
}

static ovoid_code find_mesh(robot_reader *r, const package_search *search, geometry *g, const char **last) {
    package_result result = package_search_find(search, g->address, &g->path);
    if (result == PACKAGE_FOUND_BY_TAIL) note_tail(r, g, last);
    g->is_absent = result == PACKAGE_ABSENT;
    if (g->is_absent) g->path = "";
    return result <= PACKAGE_ABSENT ? OVOID_OK : fail_address(r, g, result);
}

ovoid_code geometry_find(robot_reader *r, geometry_list *list) {
    package_search *search = pool_get(&r->scratch, 1, sizeof *search);
    if (!search || !package_search_open(search, r->path, r->options, &r->scratch)) return robot_fail_memory(r);
    const char *last = NULL;
    geometry_sort(list, compare_addresses);
    for (size_t i = 0; i < list->count; i++) {
        geometry *g = list->order[i], *before = i ? list->order[i - 1] : NULL;
        if (!*g->address) continue;
        ovoid_code code = OVOID_OK;
        if (before && strcmp(before->address, g->address) == 0)
            g->path = before->path;
        else
            code = find_mesh(r, search, g, &last);
        if (code) return code;
    }
    return tell_absent(r, search, list);
}
