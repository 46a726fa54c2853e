// Quickhull with exact decisions.
//
// C. B. Barber, D. P. Dobkin, H. Huhdanpaa, The quickhull algorithm for convex hulls, 1996: every facet keeps the
// points above it; the highest point of a facet is added to the hull: the facets that it is above, the visible ones,
// are replaced by a cone over their horizon, and their points are distributed among the cone's facets. Here facets are
// triangles, and the exact sign of a determinant decides whether a point is above one. So nothing is merged, no
// tolerance is needed and no point above a facet is lost:
//
// Let a point q be above a replaced facet f and outside of the new hull; then it is above a facet of the cone. The
// facets of the old hull that q is strictly above are connected through edges. If q is above a facet g that stays, some
// edge on the way from f to g is part of the horizon, q is above both of its facets, and the plane of the cone through
// this edge has a normal that is a nonnegative combination of theirs.
//
// Heights in doubles only choose the next point. Triangles may be coplanar; the new point is strictly above a facet at
// each horizon edge, so it is not collinear with the edge and no triangle degenerates. Points exactly on a new triangle
// are kept with it until it is replaced. At the end a point of the surface is extreme if at least three of its edges
// are creases; others are marked as on a face, and the caller runs again without them.
//
// The order of the facets is free. Those with many points are processed first, in turn, so that no list is distributed
// too often; those with few points last in, first out: the facets of a cone while they, their neighbors and their
// points are in the cache. Many points are sorted along a space-filling curve. At 100 000 points both together halve
// the time.
//
// The sign is first computed in doubles with the facet's normal, against a bound of its rounding (Shewchuk 1997), so
// that the exact determinant is left for points within about 1e-15 of the body's size.
#include "polytope/quickhull.h"

#include "base/allocator.h"
#include "base/error.h"
#include "linear/exact.h"
#include "polytope/curve.h"

#include <string.h>

#define NOTHING UINT32_MAX

// From this number of points on their order in memory matters, and a facet has few points if it has at most FEW.
enum { MANY = 2048, FEW = 128 };

typedef struct facet {
    vec3 normal;        // (a - c) x (b - c), rounded
    uint32_t vertex[3]; // a, b, c
    uint32_t across[3]; // the edges back from beyond a b, b c, c a (make_side)
    uint32_t points;    // its list: the highest point above it first; NOTHING if it is empty
    uint32_t pending;   // the next facet of the queue or the stack, NOTHING at its end
    uint32_t stamp;     // of the last point for which is_above was computed
    uint8_t is_queued, is_above, is_free;
} facet;
_Static_assert(sizeof(facet) == 64, "a line of the cache");

// Edge k of a facet, in one number: there are at most 2^24 points, and so fewer than 2^26 facets. The edge beyond is
// stored by its number so that it need not be searched for among three, which would follow no pattern.
static uint32_t make_side(uint32_t f, uint32_t k) { return 4 * f + k; }
static uint32_t get_facet_of(uint32_t side) { return side / 4; }

// Of the list of a facet: the height of its first point, if that is above the facet; the number of its points.
typedef struct list_head {
    double height;
    uint32_t count;
} list_head;

// An edge of a replaced facet on the horizon, and the edge back of the facet that stays.
typedef struct edge {
    uint32_t from, to, across;
} edge;

// A growing array of n items.
typedef struct array {
    void *items;
    uint32_t count, capacity;
} array;

typedef struct builder {
    const double *grid;
    const ovoid_allocator *allocator;
    uint8_t *state;
    uint32_t *next;     // of a point in its list; of a corner of the horizon: the facet that starts there
    array facets, free; // facet, with a list_head for each behind the last; uint32_t
    list_head *heads;
    array visible, horizon; // uint32_t, edge
    array fresh;            // of the last point: pointers to its facets, as many as its horizon has edges
    uint32_t first, last;   // of the queue of facets with points above
    uint32_t top, few;      // of the stack of facets with at most `few` points above
    uint32_t stamp;
    double bound; // of the rounding of normal . (q - c), for any facet and point q
} builder;

static int array_grow(array *a, size_t size, const ovoid_allocator *allocator) {
    if (a->capacity > UINT32_MAX / 2) return 0;
    uint32_t capacity = a->capacity ? 2 * a->capacity : 64;
    void *items = allocator_allocate(allocator, capacity, size);
    if (!items) return 0;
    if (a->count) memcpy(items, a->items, a->count * size);
    allocator_release(allocator, a->items);
    a->items = items;
    a->capacity = capacity;
    return 1;
}

static int push_index(array *a, uint32_t value, const ovoid_allocator *allocator) {
    if (a->count == a->capacity && !array_grow(a, sizeof value, allocator)) return 0;
    ((uint32_t *)a->items)[a->count++] = value;
    return 1;
}

static facet *get_facet(const builder *b, uint32_t f) { return (facet *)b->facets.items + f; }

static vec3 get_point(const builder *b, uint32_t p) { return vec3_at(b->grid, p); }

int orient2d_sign(vec3 a, vec3 b, vec3 c, int axis) {
    // In the projection along the axis the three points lie in a plane; with the fourth one a unit below the first, the
    // determinant is the area.
    vec3 p[3] = {a, b, c};
    for (int i = 0; i < 3; i++)
        p[i] = axis == 0   ? (vec3){p[i].y, p[i].z, 0}
               : axis == 1 ? (vec3){p[i].z, p[i].x, 0}
                           : (vec3){p[i].x, p[i].y, 0};
    return orient3d_sign(p[0], p[1], p[2], (vec3){p[0].x, p[0].y, -1});
}

// ---- the first simplex ----

static int is_collinear(vec3 a, vec3 b, vec3 c) {
    for (int axis = 0; axis < 3; axis++)
        if (orient2d_sign(a, b, c, axis)) return 0;
    return 1;
}

static int is_before(vec3 p, vec3 q) { return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z; }

// The least and the greatest point in the order of x, y, z; these are the ends if all points are collinear.
static void find_ends(const builder *b, uint32_t count, uint32_t end[2]) {
    vec3 least = get_point(b, 0), most = least;
    end[0] = end[1] = 0;
    for (uint32_t i = 1; i < count; i++) {
        vec3 p = get_point(b, i);
        if (is_before(p, least))
            least = p, end[0] = i;
        else if (is_before(most, p))
            most = p, end[1] = i;
    }
}

// Two points far apart, starting from those in `far`. If all points are nearly collinear these are the ends of the
// line, in any direction.
static void find_far(const builder *b, uint32_t count, uint32_t far[2]) {
    for (int k = 0; k < 2; k++) {
        vec3 from = get_point(b, far[1 - k]);
        double most = vec3_norm_squared(vec3_sub(get_point(b, far[k]), from));
        for (uint32_t i = 0; i < count; i++) {
            double square = vec3_norm_squared(vec3_sub(get_point(b, i), from));
            if (square > most) most = square, far[k] = i;
        }
    }
}

// The distance of a point from the span of the first `rank` + 1 corners, times a constant; in doubles.
static double compute_height(const vec3 corner[3], vec3 normal, int rank, vec3 p) {
    vec3 d = vec3_sub(p, corner[0]);
    if (rank == 2) return fabs(vec3_dot(normal, d));
    return vec3_norm_squared(rank == 1 ? vec3_cross(normal, d) : d);
}

static int is_in_span(const vec3 corner[3], int rank, vec3 p) {
    return rank == 2 ? orient3d_sign(corner[0], corner[1], corner[2], p) == 0 : is_collinear(corner[0], corner[1], p);
}

// The next corner: the farthest point, if it is outside the span of the others by exact signs; else any point that is.
// 0 if there is none.
static int find_corner(const builder *b, uint32_t count, int rank, uint32_t corner[4]) {
    vec3 c[3] = {{0, 0, 0}};
    for (int i = 0; i <= rank; i++) c[i] = get_point(b, corner[i]);
    // Powers of two near the present lengths, so that no square overflows.
    double unit = 0x1p-240;
    for (int i = 0; i < 3; i++) c[i] = vec3_scale(c[i], unit);
    vec3 edge1 = vec3_sub(c[1], c[0]), normal = rank == 2 ? vec3_cross(edge1, vec3_sub(c[2], c[0])) : edge1;
    double best = -1;
    for (uint32_t i = 0; i < count; i++) {
        double height = compute_height(c, normal, rank, vec3_scale(get_point(b, i), unit));
        if (height > best) best = height, corner[rank + 1] = i;
    }
    for (int i = 0; i < 3; i++) c[i] = vec3_scale(c[i], 1 / unit);
    if (!is_in_span(c, rank, get_point(b, corner[rank + 1]))) return 1;
    for (uint32_t i = 0; i < count; i++)
        if (!is_in_span(c, rank, get_point(b, i))) {
            corner[rank + 1] = i;
            return 1;
        }
    return 0;
}

static void find_simplex(const builder *b, uint32_t count, surface *s) {
    find_ends(b, count, s->corner);
    if (s->corner[0] == s->corner[1]) return;
    s->rank = 1;
    uint32_t end[2] = {s->corner[0], s->corner[1]};
    find_far(b, count, s->corner);
    if (!find_corner(b, count, 1, s->corner)) {
        s->corner[0] = end[0];
        s->corner[1] = end[1];
        return;
    }
    s->rank = 2;
    if (!find_corner(b, count, 2, s->corner)) return;
    s->rank = 3;
}

void simplex_find(const points *p, surface *s) {
    builder b = {.grid = p->grid};
    find_simplex(&b, p->count, s);
}

// ---- facets ----

// Memory for facets and their list heads; what there is of them is copied. 0 if memory runs out.
static int reserve_facets(builder *b, uint32_t capacity) {
    const facet *old = b->facets.items;
    facet *items = allocator_allocate(b->allocator, capacity, sizeof(facet) + sizeof(list_head));
    if (!items) return 0;
    list_head *heads = (list_head *)(items + capacity);
    if (old) {
        memcpy(items, old, b->facets.count * sizeof *items);
        memcpy(heads, b->heads, b->facets.count * sizeof *heads);
        allocator_release(b->allocator, b->facets.items);
    }
    b->facets.items = items;
    b->facets.capacity = capacity;
    b->heads = heads;
    return 1;
}

static uint32_t get_index(const builder *b, const facet *f) { return (uint32_t)(f - (const facet *)b->facets.items); }
static list_head *get_head(const builder *b, const facet *f) { return b->heads + get_index(b, f); }

// A free facet, with nothing across yet. NOTHING if memory runs out.
static inline __attribute__((always_inline)) uint32_t add_facet(builder *b, uint32_t u, uint32_t v, uint32_t w) {
    uint32_t index;
    if (b->free.count)
        index = ((uint32_t *)b->free.items)[--b->free.count];
    else {
        if (b->facets.count == b->facets.capacity && !reserve_facets(b, 2 * b->facets.capacity)) return NOTHING;
        index = b->facets.count++;
        *get_facet(b, index) = (facet){.pending = NOTHING};
    }
    facet *f = get_facet(b, index);
    vec3 c = get_point(b, w), p = vec3_sub(get_point(b, u), c), q = vec3_sub(get_point(b, v), c);
    f->normal = vec3_cross(p, q);
    f->vertex[0] = u;
    f->vertex[1] = v;
    f->vertex[2] = w;
    f->across[0] = f->across[1] = f->across[2] = f->points = NOTHING;
    get_head(b, f)->count = 0;
    f->stamp = 0;
    f->is_free = 0;
    return index;
}

static double get_height(const builder *b, const facet *f, uint32_t p) {
    return vec3_dot(f->normal, vec3_sub(get_point(b, p), get_point(b, f->vertex[2])));
}

// The exact sign of the height over the facet's plane.
static int get_side(const builder *b, const facet *f, uint32_t p, double height) {
    if (height > b->bound) return 1;
    if (-height > b->bound) return -1;
    return -orient3d_sign(get_point(b, f->vertex[0]), get_point(b, f->vertex[1]), get_point(b, f->vertex[2]),
                          get_point(b, p));
}

static void queue_facet(builder *b, facet *f) {
    if (f->is_queued) return;
    uint32_t index = get_index(b, f);
    f->is_queued = 1;
    if (b->heads[index].count <= b->few) {
        f->pending = b->top;
        b->top = index;
        return;
    }
    f->pending = NOTHING;
    if (b->first == NOTHING)
        b->first = index;
    else
        get_facet(b, b->last)->pending = index;
    b->last = index;
}

static int has_above(const builder *b, const facet *f) {
    return f->points != NOTHING && b->state[f->points] == POINT_EXTREME;
}

// Puts a point into a facet's list. Points above count as extreme until proven otherwise.
static void list_point(builder *b, facet *f, uint32_t p, int side, double height) {
    list_head *head = get_head(b, f);
    b->state[p] = side > 0 ? POINT_EXTREME : POINT_ON_FACE;
    int is_first = f->points == NOTHING || (side > 0 && (!has_above(b, f) || height > head->height));
    if (is_first) head->height = height;
    uint32_t *link = is_first ? &f->points : &b->next[f->points];
    b->next[p] = *link;
    *link = p;
    head->count++;
    if (side > 0 && !b->few) queue_facet(b, f);
}

// Assigns a point to the first of the facets that it is above, else to one that it is on; else it is inside. Only a
// point that was above a replaced facet can be above a new one. apex: the last corner of all of the facets; NOTHING:
// they have none in common.
static inline void place_point(builder *b, uint32_t p, facet *const *facets, uint32_t count, uint32_t apex) {
    facet *on = NULL;
    vec3 offset = apex == NOTHING ? (vec3){0, 0, 0} : vec3_sub(get_point(b, p), get_point(b, apex));
    for (uint32_t i = 0; i < count; i++) {
        facet *f = facets[i];
        double height = apex == NOTHING ? get_height(b, f, p) : vec3_dot(f->normal, offset);
        // Most facets are clearly above the point.
        if (-height > b->bound) continue;
        int side = get_side(b, f, p, height);
        if (side > 0) {
            list_point(b, f, p, side, height);
            return;
        }
        if (side == 0) on = f;
    }
    if (on)
        list_point(b, on, p, 0, 0);
    else
        b->state[p] = POINT_INSIDE;
}

// Queues new facets, whose lists are complete; with few points each facet was queued with its first point.
static void queue_facets(builder *b, facet *const *facets, uint32_t count) {
    for (uint32_t i = 0; i < count && b->few; i++)
        if (has_above(b, facets[i])) queue_facet(b, facets[i]);
}

simplex simplex_make(const double *grid, const uint32_t corner[4]) {
    static const uint8_t triangles[4][3] = {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}};
    static const uint8_t across[4][3] = {{4, 8, 12}, {0, 14, 9}, {1, 6, 13}, {2, 10, 5}};
    vec3 p[4];
    simplex s;
    for (int i = 0; i < 4; i++) p[i] = vec3_at(grid, corner[i]);
    // The fourth corner below the first three.
    int is_turned = orient3d_sign(p[0], p[1], p[2], p[3]) < 0;
    const uint32_t c[4] = {corner[0], corner[is_turned ? 2 : 1], corner[is_turned ? 1 : 2], corner[3]};
    for (int t = 0; t < 4; t++)
        for (int k = 0; k < 3; k++) {
            s.triangles[t][k] = c[triangles[t][k]];
            s.across[t][k] = across[t][k];
        }
    return s;
}

static void make_simplex(builder *b, uint32_t count, const uint32_t c[4]) {
    const simplex s = simplex_make(b->grid, c);
    // The first facets of all, which are numbered from 0 and whose memory there is.
    facet *f[4];
    for (uint32_t i = 0; i < 4; i++) {
        (void)add_facet(b, s.triangles[i][0], s.triangles[i][1], s.triangles[i][2]);
        f[i] = get_facet(b, i);
        for (int k = 0; k < 3; k++) f[i]->across[k] = s.across[i][k];
    }
    for (uint32_t p = 0; p < count; p++) {
        b->state[p] = POINT_EXTREME;
        if (p != c[0] && p != c[1] && p != c[2] && p != c[3]) place_point(b, p, f, 4, NOTHING);
    }
    queue_facets(b, f, 4);
}

// ---- adding a point ----

// Writes the facets that the point is above, starting from one of them, to b->visible, and the edges around them to
// b->horizon.
static int find_horizon(builder *b, uint32_t start, uint32_t p) {
    b->visible.count = b->horizon.count = 0;
    b->stamp++;
    get_facet(b, start)->stamp = b->stamp;
    get_facet(b, start)->is_above = 1;
    if (!push_index(&b->visible, start, b->allocator)) return 0;
    for (uint32_t i = 0; i < b->visible.count; i++) {
        const facet *f = get_facet(b, ((uint32_t *)b->visible.items)[i]);
        for (int k = 0; k < 3; k++) {
            uint32_t across = get_facet_of(f->across[k]);
            facet *g = get_facet(b, across);
            int is_new = g->stamp != b->stamp;
            if (is_new) {
                g->stamp = b->stamp;
                g->is_above = get_side(b, g, p, get_height(b, g, p)) > 0;
            }
            if (g->is_above) {
                if (is_new && !push_index(&b->visible, across, b->allocator)) return 0;
                continue;
            }
            if (b->horizon.count == b->horizon.capacity && !array_grow(&b->horizon, sizeof(edge), b->allocator))
                return 0;
            uint32_t to = f->vertex[k == 2 ? 0 : k + 1];
            ((edge *)b->horizon.items)[b->horizon.count++] = (edge){f->vertex[k], to, f->across[k]};
        }
    }
    return 1;
}

static int reserve_fresh(builder *b) {
    allocator_release(b->allocator, b->fresh.items);
    b->fresh.items = allocator_allocate(b->allocator, b->horizon.capacity, sizeof(facet *));
    b->fresh.capacity = b->fresh.items ? b->horizon.capacity : 0;
    return b->fresh.items != NULL;
}

// Links the facet across the edge to the new facet, of which that is edge 0.
static int join_across(builder *b, const edge *e, uint32_t index) {
    facet *g = get_facet(b, get_facet_of(e->across));
    uint32_t k = e->across % 4;
    g->across[k] = make_side(index, 0);
    return g->vertex[k] == e->to && g->vertex[k == 2 ? 0 : k + 1] == e->from;
}

// The cone from the point over the horizon; b->fresh has its facets. OVOID_ERROR_HULL if
// the horizon is not one closed loop, which exact signs exclude.
static ovoid_code make_cone(builder *b, uint32_t p) {
    edge *edges = b->horizon.items;
    if (b->fresh.capacity < b->horizon.capacity && !reserve_fresh(b)) return OVOID_ERROR_MEMORY;
    facet **fresh = b->fresh.items;
    for (uint32_t i = 0; i < b->horizon.count; i++) {
        uint32_t index = add_facet(b, edges[i].from, edges[i].to, p);
        if (index == NOTHING) return OVOID_ERROR_MEMORY;
        get_facet(b, index)->across[0] = edges[i].across;
        if (!join_across(b, &edges[i], index)) return OVOID_ERROR_HULL;
        b->next[edges[i].from] = index;
        edges[i].across = index;
    }
    for (uint32_t i = 0; i < b->horizon.count; i++) {
        uint32_t index = edges[i].across, after = b->next[edges[i].to];
        if (after >= b->facets.count || get_facet(b, after)->vertex[0] != edges[i].to ||
            get_facet(b, after)->vertex[2] != p || get_facet(b, after)->across[2] != NOTHING)
            return OVOID_ERROR_HULL;
        get_facet(b, index)->across[1] = make_side(after, 2);
        get_facet(b, after)->across[2] = make_side(index, 1);
        fresh[i] = get_facet(b, index);
    }
    return OVOID_OK;
}

// Distributes the points of the facets that the point replaces, and frees these facets.
static int share_points(builder *b, uint32_t p) {
    facet *const *fresh = b->fresh.items;
    for (uint32_t i = 0; i < b->visible.count; i++) {
        uint32_t index = ((uint32_t *)b->visible.items)[i];
        facet *f = get_facet(b, index);
        for (uint32_t q = f->points, after; q != NOTHING; q = after) {
            after = b->next[q];
            if (q != p) place_point(b, q, fresh, b->horizon.count, p);
        }
        f->points = NOTHING;
        f->is_free = 1;
        if (!push_index(&b->free, index, b->allocator)) return 0;
    }
    queue_facets(b, fresh, b->horizon.count);
    return 1;
}

static ovoid_code add_point(builder *b, uint32_t start) {
    uint32_t p = get_facet(b, start)->points;
    if (!find_horizon(b, start, p)) return OVOID_ERROR_MEMORY;
    ovoid_code code = make_cone(b, p);
    if (code) return code;
    return share_points(b, p) ? OVOID_OK : OVOID_ERROR_MEMORY;
}

static ovoid_code build(builder *b, uint32_t count, const uint32_t corner[4]) {
    make_simplex(b, count, corner);
    while (b->first != NOTHING || b->top != NOTHING) {
        uint32_t *list = b->first != NOTHING ? &b->first : &b->top, index = *list;
        facet *f = get_facet(b, index);
        *list = f->pending;
        f->is_queued = 0;
        if (f->is_free || !has_above(b, f)) continue;
        ovoid_code code = add_point(b, index);
        if (code) return code;
    }
    return OVOID_OK;
}

// ---- the result ----

// The vertex of the facet beyond edge k of f.
static uint32_t get_beyond(const builder *b, const facet *f, int k) {
    uint32_t side = f->across[k], back = side % 4;
    return get_facet(b, get_facet_of(side))->vertex[back ? back - 1 : 2];
}

// Sets the states of the points that were corners of facets at some time: inside if no facet is left at them, on a face
// if fewer than three of the remaining edges are creases. (A corner all of whose facets are replaced is strictly
// inside: the new point is above all of them.)
static void mark_corners(builder *b, uint32_t count) {
    uint32_t *creases = b->next;
    memset(creases, 0xff, count * sizeof *creases);
    for (uint32_t i = 0; i < b->facets.count; i++) {
        const facet *f = get_facet(b, i);
        if (f->is_free) continue;
        for (int k = 0; k < 3; k++) creases[f->vertex[k]] = 0;
    }
    for (uint32_t i = 0; i < b->facets.count; i++) {
        const facet *f = get_facet(b, i);
        if (f->is_free) continue;
        for (int k = 0; k < 3; k++) {
            // Each edge is counted at the first of its facets.
            if (get_facet_of(f->across[k]) < i) continue;
            uint32_t beyond = get_beyond(b, f, k);
            if (!get_side(b, f, beyond, get_height(b, f, beyond))) continue;
            creases[f->vertex[k]]++;
            creases[f->vertex[k == 2 ? 0 : k + 1]]++;
        }
    }
    for (uint32_t i = 0; i < count; i++) {
        if (b->state[i] != POINT_EXTREME) continue;
        if (creases[i] == NOTHING)
            b->state[i] = POINT_INSIDE;
        else if (creases[i] < 3)
            b->state[i] = POINT_ON_FACE;
    }
}

// From this number of triangles on the surface does not stay in the nearest cache.
#define WALK_LEAST 1020

// Lists the facets in use and writes their numbers into their stamps: in the order in memory, but many in that of a
// walk over edges from the first one, breadth first, so that a loop over them finds their corners in the cache.
static void number_facets(const builder *b, uint32_t *list, uint32_t used) {
    uint32_t met = 0;
    for (uint32_t i = 0; i < b->facets.count; i++) {
        facet *f = get_facet(b, i);
        if (f->is_free) continue;
        f->stamp = NOTHING;
        if (used < WALK_LEAST || met == 0) f->stamp = met, list[met++] = i;
    }
    // The list is the queue of the walk too.
    for (uint32_t i = 0; i < met && met < used; i++)
        for (int k = 0; k < 3; k++) {
            uint32_t across = get_facet_of(get_facet(b, list[i])->across[k]);
            facet *f = get_facet(b, across);
            if (f->stamp == NOTHING) f->stamp = met, list[met++] = across;
        }
}

// Copies the facets in use to plain arrays.
static int extract(builder *b, uint32_t count, surface *s) {
    uint32_t used = b->facets.count - b->free.count;
    s->triangles = allocator_allocate(b->allocator, used, 3 * sizeof *s->triangles);
    s->across = allocator_allocate(b->allocator, used, 3 * sizeof *s->across);
    if (!s->triangles || !s->across) return 0;
    s->triangle_count = used;
    // The list is in the last third of an array that is written from its start: each entry is read before its place is.
    uint32_t *list = s->across + 2 * (size_t)used;
    number_facets(b, list, used);
    size_t i = 0;
    for (uint32_t t = 0; t < used; t++) {
        const facet *f = get_facet(b, list[t]);
        for (int k = 0; k < 3; k++, i++) {
            s->triangles[i] = f->vertex[k];
            s->across[i] = make_side(get_facet(b, get_facet_of(f->across[k]))->stamp, f->across[k] % 4);
        }
    }
    mark_corners(b, count);
    return 1;
}

// Shewchuk's (7 + 56 u) u on the permanent, which is at most six times the volume of the points' box; rounded up
// generously.
double quickhull_bound_heights(const box *b) {
    vec3 size = vec3_sub(b->max, b->min);
    return 9e-16 * 6 * size.x * size.y * size.z;
}

// The hull of points in their order in memory, from its first simplex.
static ovoid_code find_hull(builder *b, uint32_t count, surface *s) {
    b->first = b->last = b->top = NOTHING;
    box whole = box_make_around(b->grid, count);
    b->bound = quickhull_bound_heights(&whole);
    b->state = s->state = allocator_allocate(b->allocator, count, 1);
    b->next = allocator_allocate(b->allocator, count, sizeof *b->next);
    // A hull of all points has about two facets a point; many points are mostly inside.
    int has_facets = reserve_facets(b, count < 32 ? 64 : count < 1 << 13 ? 2 * count : 1 << 14);
    ovoid_code code = s->state && b->next && has_facets ? build(b, count, s->corner) : OVOID_ERROR_MEMORY;
    if (!code && !extract(b, count, s)) code = OVOID_ERROR_MEMORY;
    allocator_release(b->allocator, b->next);
    allocator_release(b->allocator, b->facets.items);
    allocator_release(b->allocator, b->free.items);
    allocator_release(b->allocator, b->visible.items);
    allocator_release(b->allocator, b->horizon.items);
    allocator_release(b->allocator, b->fresh.items);
    return code;
}

// Translates the surface of points in another order to the order in which they were given. 0 if memory runs out.
static int restore_order(const curve *c, uint32_t count, surface *s, const ovoid_allocator *allocator) {
    uint8_t *state = allocator_allocate(allocator, count, 1);
    if (!state) return 0;
    for (uint32_t i = 0; i < count; i++) state[c->given[i]] = s->state[i];
    allocator_release(allocator, s->state);
    s->state = state;
    for (size_t i = 0; i < 3 * (size_t)s->triangle_count; i++) s->triangles[i] = c->given[s->triangles[i]];
    for (int i = 0; i < 4; i++) s->corner[i] = c->given[s->corner[i]];
    return 1;
}

// The corners of the first simplex by their places on the curve.
static void follow_corners(const curve *c, uint32_t count, uint32_t corner[4]) {
    uint32_t given[4];
    memcpy(given, corner, sizeof given);
    for (uint32_t i = 0; i < count; i++)
        for (int k = 0; k < 4; k++)
            if (c->given[i] == given[k]) corner[k] = i;
}

static ovoid_code find_hull_along_curve(builder *b, uint32_t count, surface *s) {
    curve c;
    if (!curve_create(b->grid, count, b->allocator, &c)) return OVOID_ERROR_MEMORY;
    b->grid = c.grid;
    b->few = FEW;
    follow_corners(&c, count, s->corner);
    ovoid_code code = find_hull(b, count, s);
    if (!code && !restore_order(&c, count, s, b->allocator)) code = OVOID_ERROR_MEMORY;
    curve_destroy(&c, b->allocator);
    return code;
}

ovoid_code quickhull_create(const points *p, const ovoid_allocator *allocator, surface *s, ovoid_error *error) {
    uint32_t count = p->count;
    builder b = {.grid = p->grid, .allocator = allocator};
    *s = (surface){0};
    find_simplex(&b, count, s);
    if (s->rank < 3) return OVOID_OK;
    ovoid_code code = count <= INCREMENTAL_MOST ? incremental_find(p, allocator, s)
                      : count < MANY            ? find_hull(&b, count, s)
                                                : find_hull_along_curve(&b, count, s);
    if (code) surface_destroy(s, allocator);
    if (code == OVOID_ERROR_MEMORY) return error_set(error, code, -1, "no memory for the hull of %u points", count);
    if (code) return error_set(error, code, -1, "the hull of %u points does not close", count);
    return OVOID_OK;
}

void surface_destroy(surface *s, const ovoid_allocator *allocator) {
    allocator_release(allocator, s->state);
    allocator_release(allocator, s->triangles);
    allocator_release(allocator, s->across);
    allocator_release(allocator, s->areas);
    allocator_release(allocator, s->edges.starts);
    allocator_release(allocator, s->edges.neighbors);
    allocator_release(allocator, s->edges.corners);
    *s = (surface){0};
}
