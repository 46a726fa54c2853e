// Whether triangles are closed, as a chain of pieces of lines: each piece is run through as often one way as the other.
//
// First edges are sorted by their ends, and equal ones cancel. In most meshes nothing is left, or all that is left is
// open. But an edge from a to c also cancels with those from c to b and from b to a where b is exactly between a and c:
// a triangle a b c without area has such edges, and so has a corner on the edge of a neighbor. What is left is
// therefore swept over in the order of its points (by x, then y, then z), each edge starting at its first point:
//
// From p go edges in one direction to q1 < q2 < ... < qk, run through m1 ... mk times. As pieces of the line they are p
// q1 with m1 + ... + mk, q1 q2 with m2 + ... + mk, and so on: these replace them, and all but the first start later in
// the sweep. Afterwards no two edges leave a point in one direction. If any is left that is run through at all, take
// the first point of its line with such an edge: the piece behind this point is run through by that edge alone, so the
// chain is not zero there. So nothing is left if and only if the chain is closed.
//
// Winding numbers are defined for such chains: a small circle around a piece of a line crosses the surface as often
// upward as downward. This is less than a manifold, of which each edge has two triangles.
//
// Cost: linear, and n log n in the edges that equal ones leave.
#include "solid/edges.h"

#include "base/allocator.h"
#include "linear/exact.h"
#include "polytope/sort.h"

// ---- equal ends

/// An edge from its point of lower number to the other; after the sweep has begun, from the first point to the last.
typedef struct edge {
    uint32_t from, to;
    int32_t count; ///< how often it is run through, less how often the other way
    uint32_t next; ///< of the same `from`, or UINT32_MAX
} edge;

typedef struct chain {
    const solid_parts *parts;
    double scale; ///< a power of two: coordinates below 1
    edge *edges;
    uint32_t count;
    uint32_t *first;                 ///< of each point: an edge from it, or UINT32_MAX
    sort_entry *entries, *scratch;   ///< room for all edges
    uint32_t *order, *order_scratch; ///< room for as many points as unmatched edges have ends
    uint32_t *group, *group_scratch; ///< room for all unmatched edges
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

static void keep_unmatched(chain *c, uint32_t count) {
    for (uint32_t i = 0, end, forward; i < count; i = end) {
        end = find_run(c, i, count, &forward);
        if (2 * forward == end - i) continue;
        c->edges[c->count++] = (edge){(uint32_t)(c->entries[i].key >> 32), (uint32_t)c->entries[i].key,
                                      (int32_t)(2 * (int64_t)forward - (int64_t)(end - i)), UINT32_MAX};
    }
}

// ---- pieces of lines

static vec3 get_point(const chain *c, uint32_t i) { return vec3_scale(vec3_at(c->parts->points, i), c->scale); }

static int compare_points(const void *context, uint32_t a, uint32_t b) {
    const double *p = (const double *)context + 3 * (size_t)a, *q = (const double *)context + 3 * (size_t)b;
    for (int k = 0; k < 3; k++)
        if (p[k] < q[k] || p[k] > q[k]) return p[k] < q[k] ? -1 : 1;
    return 0;
}

// Three points are on a line if they look so along each axis: each of the three determinants is that of a projection.
int solid_is_collinear(vec3 a, vec3 b, vec3 c) {
    vec3 u = vec3_sub(b, a), v = vec3_sub(c, a);
    if (vec3_max_abs(vec3_cross(u, v)) > 1e-10 * vec3_max_abs(u) * vec3_max_abs(v)) return 0;
    for (int axis = 0; axis < 3; axis++) {
        vec3 ahead = {a.x + 4 * (axis == 0), a.y + 4 * (axis == 1), a.z + 4 * (axis == 2)};
        if (orient3d_sign(a, ahead, b, c) != 0) return 0;
    }
    return 1;
}

static void insert(chain *c, uint32_t e) {
    c->edges[e].next = c->first[c->edges[e].from];
    c->first[c->edges[e].from] = e;
}

// Each edge from its first point, listed there; the points in the order of the sweep.
static uint32_t order_points(chain *c) {
    const double *points = c->parts->points;
    uint32_t count = 0;
    for (uint32_t i = 0; i < c->parts->point_count; i++) c->first[i] = UINT32_MAX;
    for (uint32_t e = 0; e < c->count; e++) {
        edge *x = &c->edges[e];
        if (compare_points(points, x->from, x->to) > 0) *x = (edge){x->to, x->from, -x->count, UINT32_MAX};
        for (int end = 0; end < 2; end++) {
            uint32_t p = end ? x->to : x->from;
            if (c->first[p] != UINT32_MAX) continue;
            c->first[p] = 0;
            c->order[count++] = p;
        }
    }
    for (uint32_t i = 0; i < count; i++) c->first[c->order[i]] = UINT32_MAX;
    for (uint32_t e = 0; e < c->count; e++) insert(c, e);
    sort_indices(c->order, c->order_scratch, count, compare_points, points);
    return count;
}

// A number that parallel edges share but for rounding.
static uint64_t make_direction_key(const chain *c, const edge *e) {
    vec3 d = vec3_sub(get_point(c, e->to), get_point(c, e->from));
    if (vec3_max_abs(d) < 0x1p-500) d = vec3_scale(d, 0x1p500);
    d = vec3_unit(vec3_scale(d, 1 / vec3_max_abs(d)));
    return (uint64_t)((4 + 0.537 * d.x + 0.692 * d.y + 0.482 * d.z) * 0x1p60);
}

// Keys of parallel edges are no farther apart.
#define KEY_WINDOW 0x1p20

static int compare_ends(const void *context, uint32_t a, uint32_t b) {
    const chain *c = context;
    return compare_points(c->parts->points, c->edges[a].to, c->edges[b].to);
}

// Replaces edges from one point in one direction by the pieces of the line; the first of them stays.
static void cut(chain *c, uint32_t *group, uint32_t count) {
    if (count < 2) return;
    sort_indices(group, c->group_scratch, count, compare_ends, c);
    for (uint32_t i = count - 1; i > 0; i--) {
        edge *piece = &c->edges[group[i]], *before = &c->edges[group[i - 1]];
        before->count += piece->count;
        piece->from = before->to;
        if (piece->from != piece->to && piece->count != 0) insert(c, group[i]);
    }
}

// Cuts the edges from a point and returns how many that are left are run through.
static uint32_t sweep_point(chain *c, uint32_t point) {
    uint32_t count = 0, left = 0;
    for (uint32_t e = c->first[point]; e != UINT32_MAX; e = c->edges[e].next)
        c->entries[count++] = (sort_entry){make_direction_key(c, &c->edges[e]), e};
    sort_entries(c->entries, c->scratch, count);
    vec3 from = get_point(c, point);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t size = 0, e = c->entries[i].index;
        if (e == UINT32_MAX) continue;
        vec3 to = get_point(c, c->edges[e].to);
        c->group[size++] = e;
        for (uint32_t j = i + 1; j < count && (double)(c->entries[j].key - c->entries[i].key) <= KEY_WINDOW; j++) {
            uint32_t other = c->entries[j].index;
            if (other == UINT32_MAX || !solid_is_collinear(from, to, get_point(c, c->edges[other].to))) continue;
            c->group[size++] = other;
            c->entries[j].index = UINT32_MAX;
        }
        cut(c, c->group, size);
        left += c->edges[c->group[0]].count != 0;
    }
    return left;
}

static uint64_t sweep(chain *c) {
    uint32_t points = order_points(c);
    uint64_t left = 0;
    for (uint32_t i = 0; i < points; i++) left += sweep_point(c, c->order[i]);
    return left;
}

static int sweep_unmatched(chain *c, uint32_t count, const ovoid_allocator *a, solid_edges *edges) {
    size_t unmatched = (size_t)edges->unmatched;
    c->edges = allocator_allocate(a, unmatched, sizeof(edge));
    c->first = allocator_allocate(a, c->parts->point_count, sizeof(uint32_t));
    c->order = allocator_allocate(a, 2 * unmatched, 2 * sizeof(uint32_t));
    c->group = allocator_allocate(a, unmatched, 2 * sizeof(uint32_t));
    int is_made = c->edges && c->first && c->order && c->group;
    if (is_made) {
        c->order_scratch = c->order + 2 * unmatched;
        c->group_scratch = c->group + unmatched;
        keep_unmatched(c, count);
        edges->unmatched = sweep(c);
    }
    allocator_release(a, c->edges);
    allocator_release(a, c->first);
    allocator_release(a, c->order);
    allocator_release(a, c->group);
    return is_made;
}

int solid_find_edges(const solid_parts *p, const ovoid_allocator *a, solid_edges *edges) {
    double extent = 0;
    for (uint32_t i = 0; i < p->point_count; i++) extent = max2(extent, vec3_max_abs(vec3_at(p->points, i)));
    chain c = {.parts = p, .scale = ldexp(1, -find_unit_exponent(extent))};
    c.entries = allocator_allocate(a, p->triangle_count, 3 * sizeof(sort_entry));
    c.scratch = allocator_allocate(a, p->triangle_count, 3 * sizeof(sort_entry));
    int is_made = c.entries && c.scratch;
    if (is_made) {
        uint32_t count = list_edges(&c);
        count_runs(&c, count, edges);
        if (edges->unmatched) is_made = sweep_unmatched(&c, count, a, edges);
    }
    allocator_release(a, c.entries);
    allocator_release(a, c.scratch);
    return is_made;
}
