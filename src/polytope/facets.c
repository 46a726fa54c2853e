// Facets of a triangulated hull.
//
// Faces that were flat before their points were rounded come as bundles of triangles whose planes differ in the last
// bits, some of them slivers whose own normal is noise. They are joined from the largest triangle on: to it every
// triangle that is reached over edges, faces the same way and has its three corners within FACET_FLATNESS of its plane.
// The facet's normal is the sum of its triangles' areas as vectors, so that slivers do not count; its offset is the
// largest n . v of its corners and of the corners next to them. The triangles remain the body; planes are
// approximations.
#include "polytope/facets.h"

#include "base/allocator.h"
#include "linear/exact.h"
#include "polytope/sort.h"

#include <string.h>

#define NOTHING UINT32_MAX

// a b - c d, rounded.
static double compute_minor(dd a, dd b, dd c, dd d) { return dd_sub(dd_mul(a, b), dd_mul(c, d)).high; }

vec3 compute_area(vec3 a, vec3 b, vec3 c) {
    dd px = two_sum(b.x, -a.x), py = two_sum(b.y, -a.y), pz = two_sum(b.z, -a.z);
    dd qx = two_sum(c.x, -a.x), qy = two_sum(c.y, -a.y), qz = two_sum(c.z, -a.z);
    return (vec3){compute_minor(py, qz, pz, qy), compute_minor(pz, qx, px, qz), compute_minor(px, qy, py, qx)};
}

static vec3 get_area(const surface *s, const double *grid, uint32_t t) {
    const uint32_t *corner = s->triangles + 3 * (size_t)t;
    return compute_area(vec3_at(grid, corner[0]), vec3_at(grid, corner[1]), vec3_at(grid, corner[2]));
}

double compute_extent(const double *xyz, uint32_t count) {
    double extent = 0;
    for (uint32_t i = 0; i < count; i++) extent = fmax(extent, vec3_max_abs(vec3_at(xyz, i)));
    return extent;
}

thickness surface_compute_thickness(const surface *s, const double *grid, uint32_t count) {
    // The largest triangle, then the mean normal of its side of the surface.
    vec3 largest = {0, 0, 0}, sum = {0, 0, 0};
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        vec3 area = get_area(s, grid, t);
        if (vec3_norm_squared(area) > vec3_norm_squared(largest)) largest = area;
    }
    largest = vec3_unit(largest);
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        vec3 area = get_area(s, grid, t);
        if (vec3_dot(area, largest) > 0) sum = vec3_add(sum, area);
    }
    vec3 n = vec3_unit(sum);
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        double d = vec3_dot(n, vec3_at(grid, i));
        low = fmin(low, d);
        high = fmax(high, d);
    }
    return (thickness){n, high - low};
}

// ---- joining triangles ----

typedef struct joiner {
    const surface *s;
    const double *grid;
    double *area;    // of each triangle, twice
    uint32_t *order; // triangles, the largest first
    uint32_t *queue; // of the facet that grows
    uint32_t *facet_of;
    ovoid_plane *planes; // of each facet's first triangle
    double flatness;
} joiner;

static int compare_areas(const void *context, uint32_t a, uint32_t b) {
    const double *area = context;
    return (area[a] < area[b]) - (area[a] > area[b]);
}

// The largest distance of a triangle's corners from a plane.
static double compute_distance(const joiner *j, uint32_t t, const ovoid_plane *plane) {
    double distance = 0;
    for (size_t i = 0; i < 3; i++) {
        vec3 corner = vec3_at(j->grid, j->s->triangles[3 * (size_t)t + i]);
        distance = fmax(distance, fabs(vec3_dot(plane->normal, corner) - plane->offset));
    }
    return distance;
}

// A triangle that faces the other way is the back of something thin, however near it is.
static int is_joining(const joiner *j, uint32_t t, const ovoid_plane *plane) {
    return j->facet_of[t] == NOTHING && compute_distance(j, t, plane) <= j->flatness &&
           vec3_dot(get_area(j->s, j->grid, t), plane->normal) > 0;
}

static void grow_facet(joiner *j, uint32_t seed, uint32_t facet) {
    ovoid_plane *plane = j->planes + facet;
    plane->normal = vec3_unit(get_area(j->s, j->grid, seed));
    plane->offset = vec3_dot(plane->normal, vec3_at(j->grid, j->s->triangles[3 * (size_t)seed]));
    uint32_t count = 1;
    j->queue[0] = seed;
    j->facet_of[seed] = facet;
    for (uint32_t i = 0; i < count; i++)
        for (size_t k = 0; k < 3; k++) {
            uint32_t t = j->s->across[3 * (size_t)j->queue[i] + k];
            if (!is_joining(j, t, plane)) continue;
            j->facet_of[t] = facet;
            j->queue[count++] = t;
        }
}

// A triangle lower than the flatness has no plane of its own: it goes with the neighbor whose facet it is nearest to.
// NOTHING for a proper triangle.
static uint32_t find_host(const joiner *j, uint32_t t) {
    const uint32_t *corner = j->s->triangles + 3 * (size_t)t;
    double longest = 0, nearest = 4 * j->flatness;
    uint32_t host = NOTHING;
    for (int k = 0; k < 3; k++) {
        vec3 edge = vec3_sub(vec3_at(j->grid, corner[(k + 1) % 3]), vec3_at(j->grid, corner[k]));
        longest = fmax(longest, vec3_norm(edge));
        uint32_t facet = j->facet_of[j->s->across[3 * (size_t)t + (size_t)k]];
        double distance = facet == NOTHING ? INFINITY : compute_distance(j, t, j->planes + facet);
        if (distance <= nearest) host = facet, nearest = distance;
    }
    return j->area[t] <= longest * j->flatness ? host : NOTHING;
}

static uint32_t join(joiner *j) {
    uint32_t count = j->s->triangle_count, joined = 0;
    for (uint32_t t = 0; t < count; t++) {
        j->area[t] = vec3_norm(get_area(j->s, j->grid, t));
        j->order[t] = t;
        j->facet_of[t] = NOTHING;
    }
    sort_indices(j->order, j->queue, count, compare_areas, j->area);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t t = j->order[i];
        if (j->facet_of[t] != NOTHING) continue;
        j->facet_of[t] = find_host(j, t);
        if (j->facet_of[t] == NOTHING) grow_facet(j, t, joined++);
    }
    return joined;
}

// From the planes of first triangles to those of facets: the sum of the areas that face the same way.
static void compute_normals(const joiner *j, ovoid_plane *planes, uint32_t count) {
    for (uint32_t f = 0; f < count; f++) planes[f] = (ovoid_plane){{0, 0, 0}, -INFINITY};
    for (uint32_t t = 0; t < j->s->triangle_count; t++) {
        uint32_t f = j->facet_of[t];
        vec3 area = get_area(j->s, j->grid, t);
        if (vec3_dot(area, j->planes[f].normal) > 0) planes[f].normal = vec3_add(planes[f].normal, area);
    }
    for (uint32_t f = 0; f < count; f++) planes[f].normal = vec3_unit(planes[f].normal);
}

// The corners of each triangle support its own facet and those across its edges.
void facets_set_offsets(const surface *s, const double *vertices, facets *f) {
    for (uint32_t t = 0; t < s->triangle_count; t++)
        for (size_t k = 0; k < 4; k++) {
            uint32_t beyond = k < 3 ? s->across[3 * (size_t)t + k] : t;
            ovoid_plane *plane = f->planes + f->of[beyond];
            for (size_t i = 0; i < 3; i++) {
                vec3 corner = vec3_at(vertices, s->triangles[3 * (size_t)t + i]);
                plane->offset = fmax(plane->offset, vec3_dot(plane->normal, corner));
            }
        }
}

int facets_create(const surface *s, const points *p, facets *f, const ovoid_allocator *allocator) {
    joiner j = {.s = s, .grid = p->grid, .facet_of = f->of};
    j.flatness = FACET_FLATNESS * compute_extent(p->grid, p->count);
    j.planes =
        allocator_allocate(allocator, s->triangle_count, sizeof *j.planes + sizeof *j.area + 2 * sizeof *j.order);
    if (!j.planes) return 0;
    j.area = (double *)(j.planes + s->triangle_count);
    j.order = (uint32_t *)(j.area + s->triangle_count);
    j.queue = j.order + s->triangle_count;
    f->count = join(&j);
    f->planes = allocator_allocate(allocator, f->count, sizeof *f->planes);
    if (f->planes) compute_normals(&j, f->planes, f->count);
    allocator_release(allocator, j.planes);
    return f->planes != NULL;
}

// ---- adjacency ----

int neighbors_compute(const surface *s, uint32_t *starts, uint32_t *neighbors, const ovoid_allocator *allocator) {
    // Euler's formula: a closed surface of 2 n - 4 triangles has n corners.
    uint32_t count = s->triangle_count / 2 + 2;
    size_t edges = 3 * (size_t)s->triangle_count;
    uint32_t *unsorted = allocator_allocate(allocator, edges + count, sizeof *unsorted);
    if (!unsorted) return 0;
    uint32_t *end = unsorted + edges;
    memset(starts, 0, ((size_t)count + 1) * sizeof *starts);
    for (size_t e = 0; e < edges; e++) starts[s->triangles[e] + 1]++;
    for (uint32_t v = 0; v < count; v++) starts[v + 1] += starts[v];

    // Each edge occurs once in each direction. First the lists in any order, then their transpose, which is sorted.
    memcpy(end, starts, count * sizeof *end);
    for (size_t e = 0; e < edges; e++) {
        size_t next = e % 3 == 2 ? e - 2 : e + 1;
        unsorted[end[s->triangles[e]]++] = s->triangles[next];
    }
    memcpy(end, starts, count * sizeof *end);
    for (uint32_t v = 0; v < count; v++)
        for (uint32_t i = starts[v]; i < starts[v + 1]; i++) neighbors[end[unsorted[i]]++] = v;
    allocator_release(allocator, unsorted);
    return 1;
}
