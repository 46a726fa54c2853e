// The flat facets of a surface, and how it bends at the edges of its triangles: what contacts need to know so that an
// edge inside of a flat region touches nothing.
//
// A facet grows from the largest triangle that is in none yet, over triangles with a common point, as long as all three
// corners are in the plane of that first triangle to within the surface's flatness, and turn the same way. So the plane
// does not drift from triangle to triangle, and a finely divided sphere stays round. A facet is named by the place of
// its first triangle.
#include "base/allocator.h"
#include "polytope/sort.h"
#include "solid/solid.h"

#include <string.h>

// A few roundings of coordinates to single precision.
#define FLATNESS 0x1p-22

// A triangle that is thinner than this part of its length has no normal.
#define THINNEST 0x1p-40

// Working memory, and the triangles around each point.
typedef struct grower {
    ovoid_solid *solid;
    uint32_t *starts, *ring; // of each point the places of its triangles
    uint32_t *queue;
    sort_entry *entries, *scratch;
} grower;

static vec3 get_point(const ovoid_solid *s, uint32_t i) { return solid_to_tree(s, vec3_at(s->points, i)); }

// Twice the area vector of a triangle, in the tree's unit; zero where it has no area.
static vec3 compute_area(const ovoid_solid *s, uint32_t place) {
    const uint32_t *c = s->triangles[place].point;
    vec3 a = get_point(s, c[0]), u = vec3_sub(get_point(s, c[1]), a), v = vec3_sub(get_point(s, c[2]), a);
    vec3 area = vec3_cross(u, v);
    double longest = max2(vec3_norm_squared(u), max2(vec3_norm_squared(v), vec3_norm_squared(vec3_sub(u, v))));
    return vec3_norm(area) > THINNEST * longest ? area : (vec3){0, 0, 0};
}

vec3 solid_compute_facet_normal(const ovoid_solid *s, uint32_t facet) {
    vec3 n = vec3_unit(compute_area(s, facet));
    return s->report.volume < 0 ? vec3_neg(n) : n;
}

static void list_rings(grower *g) {
    const ovoid_solid *s = g->solid;
    memset(g->starts, 0, ((size_t)s->point_count + 1) * sizeof *g->starts);
    for (uint32_t t = 0; t < s->triangle_count; t++)
        for (int i = 0; i < 3; i++) g->starts[s->triangles[t].point[i]]++;
    uint32_t sum = 0;
    for (uint32_t i = 0; i <= s->point_count; i++) {
        sum += g->starts[i];
        g->starts[i] = sum;
    }
    // From the last triangle, so that each list ascends and begins where the count of those before it ends.
    for (uint32_t t = s->triangle_count; t-- > 0;)
        for (int i = 3; i-- > 0;) g->ring[--g->starts[s->triangles[t].point[i]]] = t;
}

// The largest first, equal ones by their place.
static void sort_by_area(grower *g) {
    for (uint32_t t = 0; t < g->solid->triangle_count; t++) {
        double square = vec3_norm_squared(compute_area(g->solid, t));
        uint64_t bits;
        memcpy(&bits, &square, sizeof bits);
        g->entries[t] = (sort_entry){~bits, t};
    }
    sort_entries(g->entries, g->scratch, g->solid->triangle_count);
}

// ---- growing

typedef struct plane {
    vec3 normal, point; // in the tree's frame and unit
} plane;

static int is_in_plane(const ovoid_solid *s, uint32_t place, const plane *of) {
    if (!(vec3_dot(compute_area(s, place), of->normal) > 0)) return 0;
    for (int i = 0; i < 3; i++) {
        vec3 d = vec3_sub(get_point(s, s->triangles[place].point[i]), of->point);
        if (!(fabs(vec3_dot(of->normal, d)) * s->unit <= s->flatness)) return 0;
    }
    return 1;
}

// Returns how many triangles the facet has.
static uint32_t grow(grower *g, uint32_t first) {
    ovoid_solid *s = g->solid;
    uint32_t count = 1;
    const plane own = {vec3_unit(compute_area(s, first)), get_point(s, s->triangles[first].point[0])};
    g->queue[0] = s->facets[first] = first;
    for (uint32_t done = 0; done < count; done++)
        for (int i = 0; i < 3; i++) {
            uint32_t p = s->triangles[g->queue[done]].point[i];
            for (uint32_t k = g->starts[p]; k < g->starts[p + 1]; k++) {
                uint32_t t = g->ring[k];
                if (s->facets[t] != UINT32_MAX || !is_in_plane(s, t, &own)) continue;
                s->facets[t] = first;
                g->queue[count++] = t;
            }
        }
    return count;
}

static void grow_all(grower *g) {
    ovoid_solid *s = g->solid;
    memset(s->facets, 0xff, s->triangle_count * sizeof *s->facets);
    for (uint32_t i = 0; i < s->triangle_count; i++) {
        uint32_t t = g->entries[i].index;
        if (s->facets[t] != UINT32_MAX) continue;
        int has_area = vec3_norm_squared(compute_area(s, t)) > 0;
        if (!has_area) s->facets[t] = t;
        if (!has_area)
            s->bends[t] = SOLID_NO_AREA;
        else if (grow(g, t) == 1)
            s->bends[t] = SOLID_ALONE;
    }
}

// ---- edges

// The corner of a triangle that is not an end of an edge of it; UINT32_MAX if the edge is not one of it.
static uint32_t find_beyond(const solid_triangle *t, uint32_t a, uint32_t b) {
    for (int i = 0; i < 3; i++) {
        uint32_t p = t->point[i], q = t->point[(i + 1) % 3];
        if ((p == a && q == b) || (p == b && q == a)) return t->point[(i + 2) % 3];
    }
    return UINT32_MAX;
}

static solid_bend find_bend(const grower *g, uint32_t place, int edge) {
    const ovoid_solid *s = g->solid;
    uint32_t a = s->triangles[place].point[edge], b = s->triangles[place].point[(edge + 1) % 3];
    uint32_t at = g->starts[a + 1] - g->starts[a] < g->starts[b + 1] - g->starts[b] ? a : b;
    vec3 n = solid_compute_facet_normal(s, s->facets[place]);
    solid_bend bend = SOLID_OPEN;
    for (uint32_t k = g->starts[at]; k < g->starts[at + 1]; k++) {
        uint32_t t = g->ring[k], beyond = t == place ? UINT32_MAX : find_beyond(&s->triangles[t], a, b);
        if (beyond == UINT32_MAX || s->bends[t] & SOLID_NO_AREA) continue;
        if (s->facets[t] == s->facets[place]) return SOLID_FLAT;
        int rises = vec3_dot(n, vec3_sub(get_point(s, beyond), get_point(s, a))) > 0;
        bend = rises || bend == SOLID_CONCAVE ? SOLID_CONCAVE : SOLID_CONVEX;
    }
    return bend;
}

static void find_bends(const grower *g) {
    ovoid_solid *s = g->solid;
    for (uint32_t t = 0; t < s->triangle_count; t++)
        for (int i = 0; i < 3 && !(s->bends[t] & SOLID_NO_AREA); i++)
            s->bends[t] |= (uint8_t)(find_bend(g, t, i) << (2 * i));
}

int solid_find_facets(ovoid_solid *s) {
    const ovoid_allocator *a = &s->allocator;
    grower g = {.solid = s};
    s->flatness = FLATNESS * s->reach + 0x1p-49 * s->extent;
    g.starts = allocator_allocate(a, (size_t)s->point_count + 1, sizeof *g.starts);
    g.ring = allocator_allocate(a, s->triangle_count, 3 * sizeof *g.ring);
    g.queue = allocator_allocate(a, s->triangle_count, sizeof *g.queue);
    g.entries = allocator_allocate(a, s->triangle_count, sizeof *g.entries);
    g.scratch = allocator_allocate(a, s->triangle_count, sizeof *g.scratch);
    int is_made = g.starts && g.ring && g.queue && g.entries && g.scratch;
    if (is_made) {
        list_rings(&g);
        sort_by_area(&g);
        grow_all(&g);
        find_bends(&g);
    }
    allocator_release(a, g.starts);
    allocator_release(a, g.ring);
    allocator_release(a, g.queue);
    allocator_release(a, g.entries);
    allocator_release(a, g.scratch);
    return is_made;
}
