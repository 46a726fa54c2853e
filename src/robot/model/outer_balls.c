// Covers of a hull. A segment is cut into equal parts; a flat body has one ball. A closed surface of triangles is cut
// by a plane across the longest side of its box; a fan closes both parts along the cut. The piece with the largest ball
// is cut next, until there are OUTER_BALLS.
//
// Why the balls cover: a point of the hull that is on none of the surfaces has a winding number other than zero about
// the surface, and the winding numbers about the two parts add up to it, so the point is in the hull of one part's
// corners, which its ball holds. A corner that a cut makes is rounded: the part's surface then differs from that of the
// exact cut by triangles whose points are within 8 u of the body's size of an edge, for each of at most seven cuts.
// SLACK, 256 u of the size, is added to radii for that and for what rounds off when a vertex is placed.
#include "robot/model/outer_balls.h"

#include "linear/box.h"
#include "polytope/sphere.h"

#include <string.h>

#define SLACK 0x1p-45
// Of seven cuts most surfaces take a quarter of this; where it does not do, there are fewer balls.
enum { ROOM_A_TRIANGLE = 40, ROOM = 2048 };

// Corners of the triangles of one piece.
typedef struct triangle {
    vec3 corner[3];
} triangle;

// A piece of the hull: its triangles are a range of the pool.
typedef struct piece {
    size_t first, count;
    sphere ball;
} piece;

typedef struct cutter {
    triangle *pool, *below; ///< below: where the triangles of one part are gathered
    size_t used, capacity;
    piece pieces[OUTER_BALLS];
    uint32_t count;
} cutter;

typedef struct cut {
    int axis;
    double at;
} cut;

// A part of a piece that is being gathered.
typedef struct part {
    triangle *triangles;
    size_t count, capacity;
    int is_full;
} part;

static int is_same(vec3 a, vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

// What has two corners in one place has no surface.
static void add_triangle(part *to, vec3 a, vec3 b, vec3 c) {
    if (is_same(a, b) || is_same(b, c) || is_same(c, a)) return;
    if (to->count == to->capacity)
        to->is_full = 1;
    else
        to->triangles[to->count++] = (triangle){{a, b, c}};
}

// The point of an edge in the plane, the same for both directions of the edge.
static vec3 cut_edge(vec3 low, vec3 high, cut plane) {
    double begin = vec3_get(low, plane.axis), end = vec3_get(high, plane.axis),
           share = (plane.at - begin) / (end - begin);
    vec3 x = vec3_add_scaled(low, vec3_sub(high, low), share);
    if (plane.axis == 0) x.x = plane.at;
    if (plane.axis == 1) x.y = plane.at;
    if (plane.axis == 2) x.z = plane.at;
    return x;
}

static vec3 cut_between(vec3 a, vec3 b, cut plane) {
    return vec3_get(a, plane.axis) <= plane.at ? cut_edge(a, b, plane) : cut_edge(b, a, plane);
}

// The parts of a triangle on both sides of a plane, and of the fan about `*hub`, the first corner that was cut.
static void cut_triangle(const triangle *t, cut plane, part sides[2], vec3 *hub) {
    int side[3], above = 0;
    for (int i = 0; i < 3; i++) above += side[i] = vec3_get(t->corner[i], plane.axis) > plane.at;
    if (above == 0 || above == 3) {
        add_triangle(&sides[above == 3], t->corner[0], t->corner[1], t->corner[2]);
        return;
    }
    // The corner that is alone on its side, and the two others.
    int lone = above == 1, first = side[0] == side[1] ? 2 : side[0] == side[2] ? 1 : 0;
    vec3 a = t->corner[first], b = t->corner[(first + 1) % 3], c = t->corner[(first + 2) % 3];
    vec3 ab = cut_between(a, b, plane), ac = cut_between(a, c, plane);
    if (!(hub->x < INFINITY)) *hub = ab;
    add_triangle(&sides[lone], a, ab, ac);
    add_triangle(&sides[!lone], ab, b, c);
    add_triangle(&sides[!lone], ab, c, ac);
    for (int i = 0; i < 2; i++) add_triangle(&sides[i], *hub, ab, ac);
}

static sphere find_ball(const triangle *triangles, size_t count) {
    return sphere_compute_smallest(&triangles->corner[0].x, (uint32_t)(3 * count));
}

// The plane across the longest side of the piece's box, in its middle.
static cut choose_cut(const triangle *triangles, size_t count) {
    box b = box_make_around(&triangles->corner[0].x, (uint32_t)(3 * count));
    vec3 size = vec3_sub(b.max, b.min), middle = vec3_scale(vec3_add(b.min, b.max), 0.5);
    int axis = vec3_find_largest(size);
    return (cut){axis, vec3_get(middle, axis)};
}

// Cuts a piece in two; 0: there is no room for the parts, or one of them is empty.
static int divide(cutter *c, piece *which) {
    const triangle *all = c->pool + which->first;
    cut plane = choose_cut(all, which->count);
    part sides[2] = {{c->below, 0, c->capacity, 0}, {c->pool + c->used, 0, c->capacity - c->used, 0}};
    vec3 hub = {INFINITY, 0, 0};
    for (size_t i = 0; i < which->count; i++) cut_triangle(&all[i], plane, sides, &hub);
    size_t end = c->used + sides[1].count;
    if (sides[0].is_full || sides[1].is_full || !sides[0].count || !sides[1].count ||
        c->capacity - end < sides[0].count)
        return 0;
    c->pieces[c->count++] = (piece){c->used, sides[1].count, find_ball(sides[1].triangles, sides[1].count)};
    memcpy(c->pool + end, c->below, sides[0].count * sizeof *c->below);
    *which = (piece){end, sides[0].count, find_ball(c->below, sides[0].count)};
    c->used = end + sides[0].count;
    return 1;
}

static void divide_all(cutter *c) {
    while (c->count < OUTER_BALLS) {
        uint32_t largest = 0;
        for (uint32_t i = 1; i < c->count; i++)
            if (c->pieces[i].ball.radius > c->pieces[largest].ball.radius) largest = i;
        if (!divide(c, &c->pieces[largest])) return;
    }
}

static void put_surface(const ovoid_shape *s, const ovoid_polytope *p, triangle *to) {
    for (size_t i = 0; i < p->triangle_count; i++)
        for (int k = 0; k < 3; k++)
            to[i].corner[k] = vec3_add(s->origin, vec3_at(p->vertices, p->triangles[3 * i + k]));
}

// A ball in the user's frame with what the body stands out of its vertices, and rounding.
static outer_ball grow(const ovoid_shape *s, sphere ball) {
    double size = s->extent + vec3_norm(s->origin) + s->lower_radius;
    return (outer_ball){ball.center, (ball.radius + s->lower_radius + 4 * SLACK * size) * (1 + SLACK)};
}

// Equal parts of a segment.
static void cover_segment(const ovoid_shape *s, const ovoid_polytope *p, outer_balls *outer) {
    vec3 from = vec3_add(s->origin, vec3_at(p->vertices, 0)),
         along = vec3_sub(vec3_at(p->vertices, 1), vec3_at(p->vertices, 0));
    double half = vec3_norm(along) / (2 * OUTER_BALLS);
    for (int i = 0; i < OUTER_BALLS; i++)
        outer->balls[i] = grow(s, (sphere){vec3_add_scaled(from, along, (i + 0.5) / OUTER_BALLS), half});
    outer->count = OUTER_BALLS;
}

static void cover_solid(const ovoid_shape *s, const ovoid_polytope *p, cutter *c, outer_balls *outer) {
    put_surface(s, p, c->pool);
    c->used = p->triangle_count;
    c->pieces[0] = (piece){0, c->used, {outer->one.center, outer->one.radius}};
    divide_all(c);
    outer->count = c->count;
    for (uint32_t i = 0; i < c->count && c->count > 1; i++) outer->balls[i] = grow(s, c->pieces[i].ball);
}

// Side by side; the first is repeated.
static void set_lanes(outer_balls *outer) {
    for (uint32_t i = 0; i < COVER8; i++) {
        const outer_ball *b = &outer->balls[i < outer->count ? i : 0];
        const double all[BALLS8_COLUMNS] = {b->center.x, b->center.y, b->center.z, b->radius};
        for (int k = 0; k < BALLS8_COLUMNS; k++) outer->lanes.column[k][i] = all[k];
    }
}

static int find_balls(const ovoid_shape *s, const ovoid_allocator *memory, outer_balls *outer) {
    ovoid_polytope p = ovoid_shape_get_polytope(s);
    sphere all = sphere_compute_smallest(p.vertices, p.vertex_count);
    all.center = vec3_add(all.center, s->origin);
    outer->one = outer->balls[0] = grow(s, all);
    outer->count = 1;
    if (p.vertex_count == 2) cover_segment(s, &p, outer);
    if (p.rank < 3) return 1;
    cutter c = {.capacity = ROOM_A_TRIANGLE * (size_t)p.triangle_count + ROOM, .count = 1};
    c.pool = allocator_allocate(memory, c.capacity, sizeof *c.pool);
    c.below = allocator_allocate(memory, c.capacity, sizeof *c.below);
    int has_memory = c.pool && c.below;
    if (has_memory) cover_solid(s, &p, &c, outer);
    allocator_release(memory, c.below);
    allocator_release(memory, c.pool);
    return has_memory;
}

int outer_balls_find(const ovoid_shape *s, const ovoid_allocator *memory, outer_balls *outer) {
    if (!find_balls(s, memory, outer)) return 0;
    outer->slabs = slabs_find_of_shape(s);
    set_lanes(outer);
    return 1;
}
