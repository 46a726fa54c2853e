// Facets of a triangulated hull.
//
// Faces that were flat before their points were rounded come as bundles of triangles whose planes differ in the last
// bits; some are slivers whose own normal is noise. Triangles are joined starting from the largest: a facet takes every
// triangle that is reached over edges, faces the same way and has its three corners within FACET_FLATNESS of the plane
// of the largest. The facet's normal is the sum of its triangles' areas as vectors, so that slivers do not matter; its
// offset is the largest n . v of its corners and of the corners next to them. The triangles remain the body; planes are
// approximations.
#include "polytope/facets.h"

#include "base/allocator.h"
#include "linear/exact.h"
#include "polytope/sort.h"
#include "simd/areas.h"

#include <string.h>

#define NOTHING UINT32_MAX

vec3 compute_area(vec3 a, vec3 b, vec3 c) {
    const double xyz[9] = {a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z};
    const uint32_t corners[3] = {0, 1, 2};
    vec3 area;
    areas_compute(&(simd_triangles){xyz, corners, 1}, &area);
    return area;
}

int surface_compute_areas(surface *s, const double *grid, const ovoid_allocator *allocator) {
    s->areas = allocator_allocate(allocator, s->triangle_count, sizeof *s->areas);
    if (s->areas) areas_compute(&(simd_triangles){grid, s->triangles, s->triangle_count}, s->areas);
    return s->areas != NULL;
}

double compute_extent(const double *xyz, uint32_t count) {
    double extent = 0;
    for (uint32_t i = 0; i < count; i++) extent = max2(extent, vec3_max_abs(vec3_at(xyz, i)));
    return extent;
}

thickness surface_compute_thickness(const surface *s, const double *grid, uint32_t count) {
    // The largest triangle, then the mean normal of its side of the surface.
    vec3 largest = {0, 0, 0}, sum = {0, 0, 0};
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        vec3 area = s->areas[t];
        if (vec3_norm_squared(area) > vec3_norm_squared(largest)) largest = area;
    }
    largest = vec3_unit(largest);
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        vec3 area = s->areas[t];
        if (vec3_dot(area, largest) > 0) sum = vec3_add(sum, area);
    }
    vec3 n = vec3_unit(sum);
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        double d = vec3_dot(n, vec3_at(grid, i));
        low = min2(low, d);
        high = max2(high, d);
    }
    return (thickness){n, high - low};
}

// ---- joining triangles ----

// What is known about a triangle before triangles are joined.
enum { TRIANGLE_PLAIN = 0, TRIANGLE_NEAR = 1, TRIANGLE_SLIVER = 2 };

typedef struct joiner {
    const surface *s;
    const double *grid;
    ovoid_plane *planes; // of each triangle
    double *area;        // of each triangle, twice
    double *top;         // the largest n . v of its corners and of those beyond its edges
    uint32_t *order;     // triangles, the largest first
    uint32_t *queue;     // of the facet that grows
    uint32_t *seeds;     // for each facet its first triangle
    uint32_t *facet_of;
    uint8_t *kinds;
    double flatness, thin; // thin: no triangle of a larger area is a sliver
} joiner;

static double compute_height(const joiner *j, uint32_t corner, const ovoid_plane *plane) {
    return fabs(vec3_dot(plane->normal, vec3_at(j->grid, corner)) - plane->offset);
}

// The largest distance of a triangle's corners from a plane.
static double compute_distance(const joiner *j, uint32_t t, const ovoid_plane *plane) {
    const uint32_t *corner = j->s->triangles + 3 * (size_t)t;
    double a = compute_height(j, corner[0], plane), b = compute_height(j, corner[1], plane);
    return max2(max2(a, b), compute_height(j, corner[2], plane));
}

// A triangle that faces the other way is the back of a thin body, however near it is.
static int is_in_plane(const joiner *j, uint32_t t, const ovoid_plane *plane) {
    return compute_distance(j, t, plane) <= j->flatness && vec3_dot(j->s->areas[t], plane->normal) > 0;
}

static void grow_facet(joiner *j, uint32_t seed, uint32_t facet) {
    const ovoid_plane *plane = j->planes + seed;
    uint32_t count = 1;
    j->queue[0] = seed;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = 0; k < 3; k++) {
            uint32_t t = surface_get_across(j->s, j->queue[i], k);
            if (j->facet_of[t] != NOTHING || !is_in_plane(j, t, plane)) continue;
            j->facet_of[t] = facet;
            j->queue[count++] = t;
        }
}

// The neighbour whose facet is nearest to a triangle lower than the flatness, which has no plane of its own. NOTHING if
// none is near.
static uint32_t find_host(const joiner *j, uint32_t t) {
    double nearest = 4 * j->flatness;
    uint32_t host = NOTHING;
    for (uint32_t k = 0; k < 3; k++) {
        uint32_t facet = j->facet_of[surface_get_across(j->s, t, k)];
        double distance = facet == NOTHING ? INFINITY : compute_distance(j, t, j->planes + j->seeds[facet]);
        if (distance <= nearest) host = facet, nearest = distance;
    }
    return host;
}

// 1 if a triangle is no higher than the flatness over its longest side.
static int is_sliver(const joiner *j, uint32_t t, const vec3 corner[3]) {
    double longest = 0;
    for (int k = 0; k < 3; k++) longest = max2(longest, vec3_norm_squared(vec3_sub(corner[(k + 1) % 3], corner[k])));
    return j->area[t] <= sqrt(longest) * j->flatness;
}

// Computes planes, areas and kinds, in the order of the triangles, for locality. A triangle is "near" if one across an
// edge may join it: the corner beyond the edge is tested first, as it mostly decides.
static void prepare(joiner *j) {
    const surface *s = j->s;
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        const uint32_t *corner = s->triangles + 3 * (size_t)t;
        vec3 c[3] = {vec3_at(j->grid, corner[0]), vec3_at(j->grid, corner[1]), vec3_at(j->grid, corner[2])};
        vec3 normal = vec3_unit(s->areas[t]);
        ovoid_plane *plane = j->planes + t;
        *plane = (ovoid_plane){normal, vec3_dot(normal, c[0])};
        j->area[t] = vec3_norm(s->areas[t]);
        j->kinds[t] = j->area[t] <= j->thin && is_sliver(j, t, c) ? TRIANGLE_SLIVER : TRIANGLE_PLAIN;
        double top = max2(plane->offset, max2(vec3_dot(normal, c[1]), vec3_dot(normal, c[2])));
        for (uint32_t k = 0; k < 3; k++) {
            double support = vec3_dot(normal, vec3_at(j->grid, surface_get_beyond(s, t, k)));
            top = max2(top, support);
            if (fabs(support - plane->offset) <= j->flatness && is_in_plane(j, surface_get_across(s, t, k), plane))
                j->kinds[t] |= TRIANGLE_NEAR;
        }
        j->top[t] = top;
        j->facet_of[t] = NOTHING;
    }
}

// Larger triangles first, equal ones in their order. 0 if memory runs out.
static int order_triangles(joiner *j, const ovoid_allocator *allocator) {
    uint32_t count = j->s->triangle_count;
    sort_entry *entries = allocator_allocate(allocator, 2 * (size_t)count, sizeof *entries);
    for (uint32_t t = 0; t < count && entries; t++) {
        // For doubles that are not negative the order of their bits is the order of their values.
        uint64_t bits;
        memcpy(&bits, &j->area[t], sizeof bits);
        entries[t] = (sort_entry){~bits, t};
    }
    if (entries) sort_entries(entries, entries + count, count);
    for (uint32_t i = 0; i < count && entries; i++) j->order[i] = entries[i].index;
    allocator_release(allocator, entries);
    return entries != NULL;
}

static uint32_t join(joiner *j) {
    uint32_t joined = 0;
    for (uint32_t i = 0; i < j->s->triangle_count; i++) {
        uint32_t t = j->order[i];
        if (j->facet_of[t] != NOTHING) continue;
        if (j->kinds[t] & TRIANGLE_SLIVER) j->facet_of[t] = find_host(j, t);
        if (j->facet_of[t] != NOTHING) continue;
        j->seeds[joined] = t;
        j->facet_of[t] = joined;
        if (j->kinds[t] & TRIANGLE_NEAR) grow_facet(j, t, joined);
        joined++;
    }
    return joined;
}

// Adds a number to a sum, and the rounding error to the rest.
static void add_compensated(double *sum, double *rest, double value) {
    dd s = two_sum(*sum, value);
    *sum = s.high;
    *rest += s.low;
}

// The planes of facets each of which is a triangle: in units of the grid, which are powers of two, the offsets are
// there. + 0.0 makes every zero positive, as sums are.
static void copy_planes(const joiner *j, const points *p, facets *f) {
    const double back[2] = {1 / p->factor[0], 1 / p->factor[1]};
    for (uint32_t i = 0; i < f->count; i++) {
        vec3 n = j->planes[j->seeds[i]].normal;
        double offset = j->top[j->seeds[i]] * back[0] * back[1];
        f->planes[i] = (ovoid_plane){{n.x + 0.0, n.y + 0.0, n.z + 0.0}, offset + 0.0};
    }
}

// Replaces the planes of first triangles by those of facets: the sum of the areas that face the same way. In a plain
// sum the roundings of thousands of slivers would turn the plane of a round face. 0 if memory runs out.
static int compute_normals(const joiner *j, facets *f, const ovoid_allocator *allocator) {
    ovoid_plane *planes = f->planes;
    vec3 *rests = allocator_allocate(allocator, f->count, sizeof *rests);
    if (!rests) return 0;
    memset(rests, 0, f->count * sizeof *rests);
    for (uint32_t i = 0; i < f->count; i++) planes[i] = (ovoid_plane){{0, 0, 0}, -INFINITY};
    for (uint32_t t = 0; t < j->s->triangle_count; t++) {
        uint32_t i = j->facet_of[t];
        vec3 area = j->s->areas[t];
        if (!(vec3_dot(area, j->planes[j->seeds[i]].normal) > 0)) continue;
        add_compensated(&planes[i].normal.x, &rests[i].x, area.x);
        add_compensated(&planes[i].normal.y, &rests[i].y, area.y);
        add_compensated(&planes[i].normal.z, &rests[i].z, area.z);
    }
    for (uint32_t i = 0; i < f->count; i++) planes[i].normal = vec3_unit(vec3_add(planes[i].normal, rests[i]));
    allocator_release(allocator, rests);
    return 1;
}

static double get_support(const ovoid_plane *plane, const double *vertices, uint32_t corner) {
    return vec3_dot(plane->normal, vec3_at(vertices, corner));
}

// The corners of a facet's triangles and those beyond their edges support it. + 0.0 makes every zero positive,
// whichever corner it comes from.
static void set_offsets(const surface *s, facets *f) {
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        ovoid_plane *plane = f->planes + f->of[t];
        for (uint32_t k = 0; k < 3; k++) {
            double own = get_support(plane, f->vertices, s->triangles[3 * (size_t)t + k]);
            double beyond = get_support(plane, f->vertices, surface_get_beyond(s, t, k));
            plane->offset = max2(plane->offset, max2(own, beyond) + 0.0);
        }
    }
}

// The planes of facets that are known. 0 if memory runs out.
static int make_planes(const joiner *j, const points *p, facets *f, const ovoid_allocator *allocator) {
    f->planes = allocator_allocate(allocator, f->count, sizeof *f->planes);
    if (!f->planes) return 0;
    if (f->count == j->s->triangle_count) {
        copy_planes(j, p, f);
        return 1;
    }
    if (compute_normals(j, f, allocator)) {
        set_offsets(j->s, f);
        return 1;
    }
    allocator_release(allocator, f->planes);
    f->planes = NULL;
    return 0;
}

int facets_create(const surface *s, const points *p, facets *f, const ovoid_allocator *allocator) {
    joiner j = {.s = s, .grid = p->grid, .facet_of = f->of};
    double extent = compute_extent(p->grid, p->count);
    j.flatness = FACET_FLATNESS * extent;
    j.thin = 4 * extent * j.flatness;
    size_t count = s->triangle_count;
    j.planes = allocator_allocate(allocator, count, sizeof *j.planes + 2 * sizeof *j.area + 3 * sizeof *j.order + 1);
    if (!j.planes) return 0;
    j.area = (double *)(j.planes + count);
    j.top = j.area + count;
    j.order = (uint32_t *)(j.top + count);
    j.queue = j.order + count;
    j.seeds = j.queue + count;
    j.kinds = (uint8_t *)(j.seeds + count);
    prepare(&j);
    int is_done = order_triangles(&j, allocator);
    if (is_done) {
        f->count = join(&j);
        is_done = make_planes(&j, p, f, allocator);
    }
    allocator_release(allocator, j.planes);
    return is_done;
}

// ---- edges ----

// As many edges end at a point as begin there, as each triangle has one of either at each corner. First they are listed
// by their ends; taken in that order, those that begin at one point are sorted.
static void sort_edges(const surface *s, uint32_t count, uint32_t *unsorted) {
    const surface_edges *to = &s->edges;
    uint32_t edges = 3 * s->triangle_count, *starts = to->starts, *end = unsorted + edges;
    memset(starts, 0, ((size_t)count + 1) * sizeof *starts);
    for (uint32_t e = 0; e < edges; e++) starts[s->triangles[e] + 1]++;
    for (uint32_t v = 0; v < count; v++) starts[v + 1] += starts[v];
    memcpy(end, starts, count * sizeof *end);
    for (uint32_t e = 0; e < edges; e += 3) {
        const uint32_t *t = s->triangles + e;
        unsorted[end[t[1]]++] = e;
        unsorted[end[t[2]]++] = e + 1;
        unsorted[end[t[0]]++] = e + 2;
    }
    memcpy(end, starts, count * sizeof *end);
    for (uint32_t v = 0, i = 0; v < count; v++)
        for (uint32_t after = starts[v + 1]; i < after; i++) {
            uint32_t e = unsorted[i], at = end[s->triangles[e]]++;
            to->neighbors[at] = v;
            to->corners[e] = at;
        }
}

int surface_find_edges(surface *s, uint32_t count, const ovoid_allocator *allocator) {
    size_t edges = 3 * (size_t)s->triangle_count;
    surface_edges *to = &s->edges;
    to->starts = allocator_allocate(allocator, (size_t)count + 1, sizeof *to->starts);
    to->neighbors = allocator_allocate(allocator, edges, sizeof *to->neighbors);
    to->corners = allocator_allocate(allocator, edges, sizeof *to->corners);
    uint32_t *unsorted = allocator_allocate(allocator, edges + count, sizeof *unsorted);
    int is_done = to->starts && to->neighbors && to->corners && unsorted;
    if (is_done) sort_edges(s, count, unsorted);
    allocator_release(allocator, unsorted);
    return is_done;
}
