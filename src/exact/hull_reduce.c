// Points are dropped one by one while the hull of the rest is proven to contain the origin.
#include "exact/hull_reduce.h"

#include "pair/cover.h"

// The hull of the points that are not dropped; its depth around the origin, 0 if it does not contain it.
static double depth_without(hull_memory *memory, const hull_points *points, const int *dropped) {
    expansion *e = &memory->hull;
    int n = 0;
    for (int i = 0; i < points->count; i++)
        if (!dropped[i]) memory->left[n++] = points->w[i];
    if (!expansion_make_hull(e, memory->left, n, points->slack)) return 0;
    uint32_t triangles = expansion_pack(e);
    surface s = surface_make(e->w, e->points, (const uint16_t(*)[3])e->triangles, triangles);
    return surface_compute_depth(&s, points->error);
}

// The order of a double pyramid: two corners that no triangle joins, then the ring around the first.
static int order_as_double_pyramid(const expansion *e, int kept[6]) {
    int joined[6][6] = {{0}}, n = (int)e->points;
    for (uint32_t i = 0; i < e->faces; i++) {
        if (!e->f[i].alive) continue;
        for (int k = 0; k < 3; k++) joined[e->f[i].v[k]][e->f[i].v[(k + 1) % 3]] = 1;
    }
    for (int a = 0; a < n; a++)
        for (int b = a + 1; b < n; b++) {
            int ring = 0;
            for (int c = 0; c < n; c++) ring += c != a && c != b && joined[a][c] && joined[b][c];
            if (joined[a][b] || ring != n - 2) continue;
            // Around the ring: from each corner to the next one that is joined to it and not met yet.
            int met[6] = {0}, order[6] = {a, b}, length = 2, at = -1;
            for (int c = 0; c < n && at < 0; c++)
                if (c != a && c != b) at = c;
            while (at >= 0) {
                met[at] = 1;
                order[length++] = at;
                int next = -1;
                for (int c = 0; c < n && next < 0; c++)
                    if (c != a && c != b && !met[c] && joined[at][c]) next = c;
                at = next;
            }
            if (length != n) continue;
            for (int i = 0; i < n; i++) kept[i] = order[i];
            return 1;
        }
    return 0;
}

int hull_find_reduced(hull_memory *memory, const hull_points *points, int kept[6]) {
    const vec3 *w = points->w;
    const int count = points->count;
    expansion *e = &memory->hull;
    hull_room_give(&memory->room, e);
    int dropped[HULL_POINTS_MAX] = {0}, left[HULL_POINTS_MAX], n = count;
    if (count > HULL_POINTS_MAX || !(depth_without(memory, points, dropped) > 0)) return 0;
    for (int i = 0; i < count && n > 4; i++) {
        dropped[i] = 1;
        if (depth_without(memory, points, dropped) > 0)
            n--;
        else
            dropped[i] = 0;
    }
    if (n > 6) return 0;
    n = 0;
    for (int i = 0; i < count; i++)
        if (!dropped[i]) left[n++] = i;
    int order[6] = {0, 1, 2, 3, 4, 5};
    vec3 few[6];
    for (int i = 0; i < n; i++) few[i] = w[left[i]];
    // The hull lists the corners in the order in which it took them.
    if (n > 4) {
        if (!expansion_make_hull(e, few, n, points->slack) || e->points != (uint32_t)n ||
            !order_as_double_pyramid(e, order))
            return 0;
        for (int i = 0; i < n; i++) kept[i] = left[e->a[order[i]]];
    } else {
        for (int i = 0; i < n; i++) kept[i] = left[i];
    }
    return n;
}
