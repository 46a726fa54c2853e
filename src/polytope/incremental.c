// The incremental hull with exact decisions. M. Kallay, The complexity of incremental convex hull algorithms in R^d,
// 1984: the points are added in their order, and each replaces the facets that it is above, the visible ones, by a cone
// over their horizon. Facets are triangles; why the exact sign of a determinant decides all is said in quickhull.c. A
// list of the points above each facet, which quickhull keeps, does not pay for few points: to compare a new point with
// all facets, whose planes are numbers side by side, costs less than to move points from list to list.
//
// Heights. Let m be the largest absolute coordinate along each axis, and M = m.x m.y m.z. A plane has the normal n =
// (a - c) x (b - c) and the offset n . c, and the height of q over it is n . q - n . c. An entry of n, such as that of
// x, is a difference of two products of at most 4 m.y m.z, and off by 4 roundings of their sum, 32 u m.y m.z. With
// differences q - c of up to 2 m that makes 192 u M in the height. The two dot products with the rounded n have terms
// of up to 8 M, 24 M in all, each rounded at most 4 times with the last difference: 96 u M each. So the height is off
// by less than 384 u M; 512 u M covers the second order and what underflows, which is below 2^-1072, as M >= 2^-1020.
#include "polytope/quickhull.h"

#include "base/allocator.h"
#include "linear/both.h"
#include "linear/exact.h"
#include "simd/areas.h"

#include <string.h>

#define HEIGHT_ERROR (512 * 0x1p-53)

// An edge of a visible facet on the horizon, and the edge back of the facet that stays; later the new facet there.
typedef struct edge {
    uint16_t from, to, across;
} edge;

// What is known about a facet and the last point.
enum { MARK_NONE, MARK_UNSURE, MARK_ABOVE };

// Facets have places; of a free place the offset is infinite, so that all points are below. x, y and z follow one
// another.
typedef struct builder {
    const double *grid;
    double *x, *y, *z, *offset, *height; // of planes; of the last point over them
    uint16_t (*vertex)[3];               // counter-clockwise from outside
    uint16_t (*across)[3];               // 4 times the facet beyond an edge, and the number of the edge there
    uint16_t *visible;                   // the facets that the last point is above; at the end the numbers of all
    uint16_t *unsure;                    // those of which doubles do not show that
    uint16_t *spare;                     // free places
    uint16_t *starts;                    // of a corner of the horizon: the new facet that starts there
    edge *horizon;
    uint8_t *marks;
    uint8_t *state;      // of the points; until the end POINT_ON_FACE if it is not known to be inside
    int is_on;           // the last point lies in the plane of a facet
    uint32_t count;      // points
    uint32_t used, room; // places; room is a multiple of 8
    uint32_t spare_count;
    double bound; // of the rounding of heights
} builder;

// ---- memory ----

// The memory of n places behind *at.
static void *take(char **at, size_t n, size_t size) {
    void *items = *at;
    *at += (n * size + 7) / 8 * 8;
    return items;
}

// A closed surface of n corners has 2 n - 4 triangles, and a horizon at most n edges. NULL if memory runs out.
static void *allocate(builder *b, const ovoid_allocator *allocator) {
    size_t room = (2 * (size_t)b->count + 7) / 8 * 8, edges = (size_t)b->count + 3;
    size_t place = 5 * sizeof *b->x + sizeof *b->vertex + sizeof *b->across + 3 * sizeof *b->visible + 1;
    char *memory = allocator_allocate(allocator, room * place + edges * (sizeof(edge) + sizeof *b->starts) + 64, 1);
    char *at = memory;
    if (!memory) return NULL;
    b->room = (uint32_t)room;
    b->x = take(&at, room, sizeof *b->x);
    b->y = take(&at, room, sizeof *b->y);
    b->z = take(&at, room, sizeof *b->z);
    b->offset = take(&at, room, sizeof *b->offset);
    b->height = take(&at, room, sizeof *b->height);
    b->vertex = take(&at, room, sizeof *b->vertex);
    b->across = take(&at, room, sizeof *b->across);
    b->visible = take(&at, room, sizeof *b->visible);
    b->unsure = take(&at, room, sizeof *b->unsure);
    b->spare = take(&at, room, sizeof *b->spare);
    b->horizon = take(&at, edges, sizeof(edge));
    b->starts = take(&at, edges, sizeof *b->starts);
    b->marks = take(&at, room, 1);
    memset(b->starts, 0, edges * sizeof *b->starts);
    memset(b->marks, 0, room);
    memset(b->x, 0, 3 * room * sizeof *b->x);
    for (size_t f = 0; f < room; f++) b->offset[f] = INFINITY;
    return memory;
}

// ---- facets ----

static vec3 get_point(const builder *b, uint32_t i) { return vec3_at(b->grid, i); }

static void set_facet(builder *b, uint32_t f, const uint32_t corner[3]) {
    vec3 c = get_point(b, corner[2]);
    vec3 n = vec3_cross(vec3_sub(get_point(b, corner[0]), c), vec3_sub(get_point(b, corner[1]), c));
    b->x[f] = n.x, b->y[f] = n.y, b->z[f] = n.z;
    b->offset[f] = vec3_dot(n, c);
    for (int k = 0; k < 3; k++) b->vertex[f][k] = (uint16_t)corner[k];
}

static void clear_facet(builder *b, uint32_t f) {
    b->x[f] = b->y[f] = b->z[f] = 0;
    b->offset[f] = INFINITY;
}

static uint16_t make_side(uint32_t f, uint32_t k) { return (uint16_t)(4 * f + k); }

// The exact sign of the height of a point over a facet. height: computed, or 0, which does not decide.
static int get_side(const builder *b, uint32_t f, uint32_t p, double height) {
    if (height > b->bound) return 1;
    if (-height > b->bound) return -1;
    const uint16_t *v = b->vertex[f];
    return -orient3d_sign(get_point(b, v[0]), get_point(b, v[1]), get_point(b, v[2]), get_point(b, p));
}

// Lists the facets that are not clearly above the point, with its heights; returns their number.
static uint32_t list_near(const builder *b, uint32_t p) {
    const simd_planes planes = {b->x, b->y, b->z, b->offset, b->used};
    return heights_find(&planes, &(heights_query){get_point(b, p), -b->bound},
                        &(heights_result){b->height, b->visible});
}

// 1 if the point is above a facet of which doubles do not show it, which then is visible.
static int decide(builder *b, uint32_t f, uint32_t p) {
    int side = get_side(b, f, p, 0);
    b->is_on |= side == 0;
    b->marks[f] = side > 0 ? MARK_ABOVE : MARK_NONE;
    return side > 0;
}

// Adds to the list of visible facets those that doubles do not decide; returns their number. The facets that a point is
// above are connected through edges, so that of the many facets of a face with which it is coplanar only those beside
// visible ones are looked at, if there are any.
static uint32_t decide_unsure(builder *b, uint32_t p, uint32_t visible, uint32_t unsure) {
    for (uint32_t i = 0; i < unsure && visible == 0; i++)
        if (decide(b, b->unsure[i], p)) b->visible[visible++] = b->unsure[i];
    for (uint32_t i = 0; i < visible; i++)
        for (int k = 0; k < 3; k++) {
            uint16_t across = b->across[b->visible[i]][k] / 4;
            if (b->marks[across] == MARK_UNSURE && decide(b, across, p)) b->visible[visible++] = across;
        }
    for (uint32_t i = 0; i < unsure; i++)
        if (b->marks[b->unsure[i]] == MARK_UNSURE) b->marks[b->unsure[i]] = MARK_NONE;
    return visible;
}

// Lists the facets that the point is above; returns their number.
static uint32_t list_visible(builder *b, uint32_t p) {
    uint32_t near = list_near(b, p), visible = 0, unsure = 0;
    b->is_on = 0;
    for (uint32_t i = 0; i < near; i++) {
        uint16_t f = b->visible[i];
        int is_clear = b->height[f] > b->bound;
        b->marks[f] = is_clear ? MARK_ABOVE : MARK_UNSURE;
        if (is_clear)
            b->visible[visible++] = f;
        else
            b->unsure[unsure++] = f;
    }
    return unsure ? decide_unsure(b, p, visible, unsure) : visible;
}

// ---- adding a point ----

static void make_simplex(builder *b, const uint32_t corner[4]) {
    const simplex s = simplex_make(b->grid, corner);
    for (uint32_t f = 0; f < 4; f++) {
        set_facet(b, f, s.triangles[f]);
        for (int k = 0; k < 3; k++) b->across[f][k] = (uint16_t)s.across[f][k];
    }
    b->used = 4;
}

// Lists the edges between visible facets and others; returns their number, or more than there are points if these are
// too many.
static uint32_t find_horizon(const builder *b, uint32_t visible) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < visible && count <= b->count; i++) {
        const uint16_t *v = b->vertex[b->visible[i]], *across = b->across[b->visible[i]];
        for (int k = 0; k < 3; k++) {
            b->horizon[count] = (edge){v[k], v[k == 2 ? 0 : k + 1], across[k]};
            count += b->marks[across[k] / 4] != MARK_ABOVE;
        }
    }
    return count;
}

// A place for a new facet: that of a visible one, while there are, a free one, or one more.
static uint32_t find_place(builder *b, uint32_t i, uint32_t visible) {
    if (i < visible) return b->visible[i];
    return b->spare_count ? b->spare[--b->spare_count] : b->used++;
}

// The cone from the point over the horizon, in the places of the visible facets. 0 if the horizon is not one closed
// loop, which exact signs exclude.
static int make_cone(builder *b, uint32_t p, uint32_t visible, uint32_t edges) {
    if (edges > b->count || b->used + edges > b->room + visible + b->spare_count) return 0;
    for (uint32_t i = 0; i < edges; i++) {
        edge *e = &b->horizon[i];
        uint32_t f = find_place(b, i, visible);
        set_facet(b, f, (uint32_t[]){e->from, e->to, p});
        b->across[f][0] = e->across;
        b->across[e->across / 4][e->across % 4] = make_side(f, 0);
        b->starts[e->from] = e->across = (uint16_t)f;
        b->marks[f] = MARK_NONE;
    }
    for (uint32_t i = 0; i < edges; i++) {
        uint32_t f = b->horizon[i].across, after = b->starts[b->horizon[i].to];
        if (b->vertex[after][0] != b->horizon[i].to || b->vertex[after][2] != p) return 0;
        b->across[f][1] = make_side(after, 2);
        b->across[after][2] = make_side(f, 1);
    }
    for (uint32_t i = edges; i < visible; i++) {
        uint16_t f = b->spare[b->spare_count++] = b->visible[i];
        clear_facet(b, f);
        b->marks[f] = MARK_NONE;
    }
    return 1;
}

static ovoid_code add_points(builder *b, const uint32_t corner[4]) {
    for (uint32_t p = 0; p < b->count; p++) {
        if (p == corner[0] || p == corner[1] || p == corner[2] || p == corner[3]) continue;
        uint32_t visible = list_visible(b, p);
        if (visible && !make_cone(b, p, visible, find_horizon(b, visible))) return OVOID_ERROR_HULL;
        if (!visible && !b->is_on) b->state[p] = POINT_INSIDE;
    }
    return OVOID_OK;
}

// ---- the result ----

static int is_free(const builder *b, uint32_t f) { return b->offset[f] == INFINITY; }

// 1 if a point lies on a facet.
static int is_on_facet(const builder *b, uint32_t p) {
    uint32_t near = list_near(b, p);
    for (uint32_t i = 0; i < near; i++)
        if (get_side(b, b->visible[i], p, b->height[b->visible[i]]) == 0) return 1;
    return 0;
}

// The corner beyond edge k of a facet.
static uint32_t get_beyond(const builder *b, uint32_t f, int k) {
    uint32_t side = b->across[f][k], back = side % 4;
    return b->vertex[side / 4][back ? back - 1 : 2];
}

// 1 if the corners beyond all edges of a facet are clearly below it.
static int has_creases(const builder *b, uint32_t f) {
    vec3 n = {b->x[f], b->y[f], b->z[f]}, q[3];
    for (int k = 0; k < 3; k++) q[k] = get_point(b, get_beyond(b, f, k));
    both top = both_vec3_dot(both_vec3_make(n, n), both_vec3_make(q[0], q[1]));
    return max2(max2(top[0], top[1]), vec3_dot(n, q[2])) - b->offset[f] < -b->bound;
}

// Counts in b->starts the creases at each point: the edges whose facets are not coplanar.
static void count_creases(const builder *b) {
    memset(b->starts, 0, b->count * sizeof *b->starts);
    // As many edges as facets end at a corner.
    for (uint32_t f = 0; f < b->used; f++)
        for (int k = 0; k < 3 && !is_free(b, f); k++) b->starts[b->vertex[f][k]]++;
    for (uint32_t f = 0; f < b->used; f++) {
        if (is_free(b, f) || has_creases(b, f)) continue;
        const uint16_t *v = b->vertex[f];
        for (int k = 0; k < 3; k++) {
            // Each edge is looked at from the first of its facets.
            if (b->across[f][k] / 4 < f || get_side(b, f, get_beyond(b, f, k), 0)) continue;
            b->starts[v[k]]--;
            b->starts[v[k == 2 ? 0 : k + 1]]--;
        }
    }
}

// A point at which three creases meet is extreme; a corner of fewer lies on its facets. Of other points those that were
// in the plane of a facet may lie on one; a corner all of whose facets were replaced lies inside.
static void set_states(const builder *b) {
    count_creases(b);
    for (uint32_t i = 0; i < b->count; i++) {
        if (b->starts[i] >= 3)
            b->state[i] = POINT_EXTREME;
        else if (b->state[i] != POINT_INSIDE)
            b->state[i] = is_on_facet(b, i) ? POINT_ON_FACE : POINT_INSIDE;
    }
}

// Copies the facets in the order of their places.
static void copy_facets(const builder *b, surface *s) {
    uint16_t *number = b->visible;
    uint32_t met = 0;
    for (uint32_t f = 0; f < b->used; f++) {
        number[f] = (uint16_t)met;
        met += !is_free(b, f);
    }
    for (uint32_t f = 0; f < b->used; f++) {
        if (is_free(b, f)) continue;
        for (uint32_t k = 0; k < 3; k++) {
            s->triangles[3 * number[f] + k] = b->vertex[f][k];
            s->across[3 * number[f] + k] = make_side(number[b->across[f][k] / 4], b->across[f][k] % 4);
        }
    }
}

static int extract(const builder *b, surface *s, const ovoid_allocator *allocator) {
    s->triangle_count = b->used - b->spare_count;
    s->triangles = allocator_allocate(allocator, s->triangle_count, 3 * sizeof *s->triangles);
    s->across = allocator_allocate(allocator, s->triangle_count, 3 * sizeof *s->across);
    if (!s->triangles || !s->across) return 0;
    set_states(b);
    copy_facets(b, s);
    return 1;
}

static double bound_heights(const points *p) {
    vec3 most = {0, 0, 0};
    for (uint32_t i = 0; i < p->count; i++) {
        vec3 q = vec3_abs(vec3_at(p->grid, i));
        most = (vec3){max2(most.x, q.x), max2(most.y, q.y), max2(most.z, q.z)};
    }
    return HEIGHT_ERROR * most.x * most.y * most.z;
}

ovoid_code incremental_find(const points *p, const ovoid_allocator *allocator, surface *s) {
    builder b = {.grid = p->grid, .count = p->count, .bound = bound_heights(p)};
    b.state = s->state = allocator_allocate(allocator, p->count, 1);
    void *memory = allocate(&b, allocator);
    if (!memory || !b.state) {
        allocator_release(allocator, memory);
        return OVOID_ERROR_MEMORY;
    }
    memset(b.state, POINT_ON_FACE, p->count);
    make_simplex(&b, s->corner);
    ovoid_code code = add_points(&b, s->corner);
    if (!code && !extract(&b, s, allocator)) code = OVOID_ERROR_MEMORY;
    allocator_release(allocator, memory);
    return code;
}
