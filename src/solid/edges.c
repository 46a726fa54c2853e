// Whether triangles are closed, as a chain of pieces of lines: each piece occurs as often in one direction as in the
// other.
//
// First the edges are sorted by their ends, and equal ones cancel. In most meshes none remain, or all that remain are
// open. But an edge from a to c also cancels with the edges from c to b and from b to a if b is exactly between a and
// c: a triangle a b c without area has these edges, and so has a corner on the edge of a neighbour. So the ends of the
// remaining edges are examined: for a point and a line through it, count how many edges on that line leave the point,
// minus how many arrive. The number of times that the line is covered changes at its points by these counts, and it is
// 0 far out; so it is 0 everywhere if and only if all counts are 0.
//
// Winding numbers are defined for these chains: a small circle around a piece of a line crosses the surface as often
// upward as downward. This needs less than a manifold, in which each edge has two triangles.
//
// Cost: linear, except for the edges of one point, each of which is compared with those that are parallel to rounding.
#include "solid/edges.h"

#include "base/allocator.h"
#include "linear/exact.h"
#include "polytope/sort.h"

// ---- equal ends

/// An edge as one of its two points sees it.
typedef struct edge_end {
    uint32_t point, other;
    int32_t leaving; ///< edges that leave the point minus edges that arrive
} edge_end;

typedef struct chain {
    const solid_parts *parts;
    double scale;                  ///< a power of two: coordinates below 1
    sort_entry *entries, *scratch; ///< room for all edges
    edge_end *ends;                ///< of the edges that do not cancel
    uint32_t *order;               ///< of the ends of one point
} chain;

static uint64_t make_key(uint32_t a, uint32_t b) { return a < b ? (uint64_t)a << 32 | b : (uint64_t)b << 32 | a; }

static uint32_t list_edges(chain *c) {
    uint32_t count = 0;
    for (uint32_t t = 0; t < c->parts->triangle_count; t++)
        for (int i = 0; i < 3; i++) {
            uint32_t a = c->parts->triangles[t].point[i], b = c->parts->triangles[t].point[(i + 1) % 3];
            if (a != b) c->entries[count++] = (sort_entry){make_key(a, b), a < b};
        }
    sort_entries(c->entries, c->scratch, count);
    return count;
}

// The end of the run of edges that are equal to the i-th, and how many go forward.
static uint32_t find_run(const chain *c, uint32_t i, uint32_t count, uint32_t *forward) {
    uint32_t end = i;
    for (*forward = 0; end < count && c->entries[end].key == c->entries[i].key; end++)
        *forward += c->entries[end].index;
    return end;
}

static void count_runs(const chain *c, uint32_t count, solid_edges *edges) {
    *edges = (solid_edges){0, 0};
    for (uint32_t i = 0, end, forward; i < count; i = end) {
        end = find_run(c, i, count, &forward);
        edges->unmatched += 2 * forward != end - i;
        edges->crowded += end - i > 2;
    }
}

static uint32_t list_ends(chain *c, uint32_t count) {
    uint32_t ends = 0;
    for (uint32_t i = 0, end, forward; i < count; i = end) {
        end = find_run(c, i, count, &forward);
        int32_t net = (int32_t)(2 * (int64_t)forward - (int64_t)(end - i));
        uint32_t low = (uint32_t)(c->entries[i].key >> 32), high = (uint32_t)c->entries[i].key;
        if (net == 0) continue;
        c->ends[ends++] = (edge_end){low, high, net};
        c->ends[ends++] = (edge_end){high, low, -net};
    }
    return ends;
}

// ---- pieces of lines

static vec3 get_point(const chain *c, uint32_t i) { return vec3_scale(vec3_at(c->parts->points, i), c->scale); }

// Three points are on a line if they appear on a line along each axis: each of the three determinants is that of a
// projection.
int solid_is_collinear(vec3 a, vec3 b, vec3 c) {
    vec3 u = vec3_sub(b, a), v = vec3_sub(c, a);
    if (vec3_max_abs(vec3_cross(u, v)) > 1e-10 * vec3_max_abs(u) * vec3_max_abs(v)) return 0;
    for (int axis = 0; axis < 3; axis++) {
        vec3 ahead = {a.x + 4 * (axis == 0), a.y + 4 * (axis == 1), a.z + 4 * (axis == 2)};
        if (orient3d_sign(a, ahead, b, c) != 0) return 0;
    }
    return 1;
}

// A number that is about the same for parallel edges.
static uint64_t make_line_key(const chain *c, const edge_end *e) {
    vec3 d = vec3_sub(get_point(c, e->other), get_point(c, e->point));
    if (vec3_max_abs(d) < 0x1p-500) d = vec3_scale(d, 0x1p500);
    d = vec3_unit(vec3_scale(d, 1 / vec3_max_abs(d)));
    return (uint64_t)(fabs(0.537 * d.x + 0.692 * d.y + 0.482 * d.z) * 0x1p60);
}

// Keys of parallel edges are no farther apart.
#define KEY_WINDOW ((uint64_t)1 << 20)

// The number of lines through one point whose count is not 0; entries name the ends of its edges by their keys.
static uint32_t count_open_lines(const chain *c, uint32_t count) {
    uint32_t open = 0;
    for (uint32_t i = 0; i < count; i++) {
        if (c->order[i] == UINT32_MAX) continue;
        const edge_end *e = &c->ends[c->order[i]];
        vec3 point = get_point(c, e->point), other = get_point(c, e->other);
        int64_t leaving = e->leaving;
        for (uint32_t j = i + 1; j < count && c->entries[j].key - c->entries[i].key <= KEY_WINDOW; j++) {
            const edge_end *f = c->order[j] == UINT32_MAX ? NULL : &c->ends[c->order[j]];
            if (!f || !solid_is_collinear(point, other, get_point(c, f->other))) continue;
            leaving += f->leaving;
            c->order[j] = UINT32_MAX;
        }
        open += leaving != 0;
    }
    return open;
}

// The number of open ends of pieces of lines.
static uint64_t count_open_ends(chain *c, uint32_t count) {
    uint32_t *by_point = c->order + count;
    uint64_t open = 0;
    for (uint32_t i = 0; i < count; i++) c->entries[i] = (sort_entry){c->ends[i].point, i};
    sort_entries(c->entries, c->scratch, count);
    for (uint32_t i = 0; i < count; i++) by_point[i] = c->entries[i].index;
    for (uint32_t i = 0, end; i < count; i = end) {
        uint32_t point = c->ends[by_point[i]].point, size = 0;
        for (end = i; end < count && c->ends[by_point[end]].point == point; end++)
            c->entries[size++] = (sort_entry){make_line_key(c, &c->ends[by_point[end]]), by_point[end]};
        sort_entries(c->entries, c->scratch, size);
        for (uint32_t k = 0; k < size; k++) c->order[k] = c->entries[k].index;
        open += count_open_lines(c, size);
    }
    return open;
}

// Finds the open pieces of edges; each has two open ends.
static int match_pieces(chain *c, uint32_t count, const ovoid_allocator *a, solid_edges *edges) {
    size_t ends = 2 * (size_t)edges->unmatched;
    c->ends = allocator_allocate(a, ends, sizeof(edge_end));
    c->order = allocator_allocate(a, ends, 2 * sizeof(uint32_t));
    int is_made = c->ends && c->order;
    if (is_made) edges->unmatched = (count_open_ends(c, list_ends(c, count)) + 1) / 2;
    allocator_release(a, c->ends);
    allocator_release(a, c->order);
    return is_made;
}

int solid_find_edges(const solid_parts *p, const ovoid_allocator *a, solid_edges *edges) {
    double extent = 0;
    for (uint32_t i = 0; i < p->point_count; i++) extent = max2(extent, vec3_max_abs(vec3_at(p->points, i)));
    chain c = {.parts = p, .scale = ldexp(1, -find_unit_exponent(extent))};
    // Twice as many ends if all edges of the mesh are open.
    c.entries = allocator_allocate(a, p->triangle_count, 6 * sizeof(sort_entry));
    c.scratch = allocator_allocate(a, p->triangle_count, 6 * sizeof(sort_entry));
    int is_made = c.entries && c.scratch;
    if (is_made) {
        uint32_t count = list_edges(&c);
        count_runs(&c, count, edges);
        if (edges->unmatched) is_made = match_pieces(&c, count, a, edges);
    }
    allocator_release(a, c.entries);
    allocator_release(a, c.scratch);
    return is_made;
}
