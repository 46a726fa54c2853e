// Tetrahedra cut by planes, and the search that cuts the one with the greatest bound first (A. H. Land, A. G. Doig, An
// automatic method of solving discrete programming problems, 1960). Pieces cover the cell up to the rounding of their
// corners, which the problem's pad covers.
#include "decompose/tetrahedra.h"

#include "base/watch.h"
#include "linear/tetrahedron.h"
#include "tools/heap.h"

vec3 cell_compute_middle(const cell *c) {
    vec3 sum = vec3_add(vec3_add(c->corner[0], c->corner[1]), vec3_add(c->corner[2], c->corner[3]));
    return vec3_scale(sum, 0.25);
}

double cell_compute_radius(const cell *c, vec3 x) {
    double most = 0;
    for (int i = 0; i < 4; i++) most = max2(most, vec3_norm_squared(vec3_sub(c->corner[i], x)));
    return sqrt(most) * (1 + 8 * ROUNDING);
}

box cell_compute_box(const cell *c) { return box_make_around(&c->corner[0].x, 4); }

// The pieces of a cell so far.
typedef struct division {
    const cell *whole;
    cell *pieces;
    uint32_t count;
} division;

static void add_piece(division *d, const vec3 corner[4]) {
    cell *piece = &d->pieces[d->count++];
    *piece = *d->whole;
    piece->depth = d->whole->depth + 1;
    for (int i = 0; i < 4; i++) piece->corner[i] = corner[i];
}

// The prism over two triangles with corresponding corners, as three tetrahedra.
static void add_prism(division *d, const vec3 a[3], const vec3 b[3]) {
    add_piece(d, (vec3[]){a[0], a[1], a[2], b[0]});
    add_piece(d, (vec3[]){a[1], a[2], b[0], b[1]});
    add_piece(d, (vec3[]){a[2], b[0], b[1], b[2]});
}

// The point of the edge from a, below the plane by da < 0, to b, above it.
static vec3 cross_edge(vec3 a, double da, vec3 b, double db) {
    return vec3_add_scaled(a, vec3_sub(b, a), da / (da - db));
}

uint32_t cell_cut(const cell *c, const ovoid_plane *plane, cell pieces[CELL_PIECES], uint32_t *first_above) {
    vec3 low[4], high[4];
    double dl[4], dh[4];
    int below = 0, above = 0;
    for (int i = 0; i < 4; i++) {
        double d = vec3_dot(plane->normal, c->corner[i]) - plane->offset;
        if (d < 0)
            low[below] = c->corner[i], dl[below++] = d;
        else
            high[above] = c->corner[i], dh[above++] = d;
    }
    // A plane through a corner, to rounding, would leave the cell unchanged, and a sliver.
    double deepest = 0, highest = 0;
    for (int i = 0; i < below; i++) deepest = max2(deepest, -dl[i]);
    for (int i = 0; i < above; i++) highest = max2(highest, dh[i]);
    if (min2(deepest, highest) <= CELL_TOUCH) return 0;
    division d = {c, pieces, 0};
    if (below == 2) {
        vec3 x[2][2];
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) x[i][j] = cross_edge(low[i], dl[i], high[j], dh[j]);
        *first_above = 3;
        add_prism(&d, (vec3[]){low[0], x[0][0], x[0][1]}, (vec3[]){low[1], x[1][0], x[1][1]});
        add_prism(&d, (vec3[]){high[0], x[0][0], x[1][0]}, (vec3[]){high[1], x[0][1], x[1][1]});
        return d.count;
    }
    // One corner alone: a tetrahedron, and a prism over what is left of the opposite side.
    vec3 x[3];
    *first_above = below == 1 ? 1 : 3;
    if (below == 1) {
        for (int i = 0; i < 3; i++) x[i] = cross_edge(low[0], dl[0], high[i], dh[i]);
        add_piece(&d, (vec3[]){low[0], x[0], x[1], x[2]});
        add_prism(&d, x, high);
        return d.count;
    }
    for (int i = 0; i < 3; i++) x[i] = cross_edge(low[i], dl[i], high[0], dh[0]);
    add_prism(&d, x, low);
    add_piece(&d, (vec3[]){high[0], x[0], x[1], x[2]});
    return d.count;
}

uint32_t cell_halve(const cell *c, cell pieces[CELL_PIECES]) {
    vec3 halves[2][4];
    division d = {c, pieces, 0};
    (void)tetrahedron_halve(c->corner, halves);
    for (int k = 0; k < 2; k++) add_piece(&d, halves[k]);
    return d.count;
}

// ---- the heap

static int is_worse(const void *a, const void *b) { return ((const cell *)a)->bound > ((const cell *)b)->bound; }

static void push(cell_search *s, const cell *c) { heap_push((heap){s->heap, s->count++, sizeof *c, is_worse}, c); }

static cell pop(cell_search *s) {
    cell top;
    heap_pop((heap){s->heap, s->count--, sizeof top, is_worse}, &top);
    return top;
}

// ---- the search

void cell_search_raise(cell_search *s, double lower, vec3 point, uint32_t owner) {
    if (!(lower > s->lower)) return;
    s->lower = lower;
    s->point = point;
    s->point_owner = owner;
}

static void drop(cell_search *s, const cell *c) {
    s->dropped = max2(s->dropped, c->bound);
    if (s->owners) s->owners[c->owner] = max2(s->owners[c->owner], c->bound);
}

void cell_search_add(cell_search *s, cell *c) {
    s->looked++;
    s->find_bound(s, c);
    if (c->bound <= cell_search_get_goal(s))
        drop(s, c);
    else
        push(s, c);
}

void cell_search_add_box(cell_search *s, const box *around, uint32_t owner) {
    vec3 corners[6][4];
    tetrahedra_fill_box(around, corners);
    for (int i = 0; i < 6; i++) {
        cell c = {.bound = INFINITY, .owner = owner};
        memcpy(c.corner, corners[i], sizeof c.corner);
        cell_search_add(s, &c);
    }
}

// The pieces that must be examined.
static uint32_t cut(cell_search *s, const cell *c, cell pieces[CELL_PIECES]) {
    ovoid_plane plane;
    uint32_t first_above;
    cell_plane kind = s->find_plane(s, c, &plane);
    uint32_t count = kind == CELL_HALVES ? 0 : cell_cut(c, &plane, pieces, &first_above);
    if (count == 0) return cell_halve(c, pieces);
    return kind == CELL_BELOW ? first_above : count;
}

double cell_search_run(cell_search *s) {
    const ovoid_decomposition_options *o = s->options;
    while (s->count > 0 && s->heap[0].bound > cell_search_get_goal(s)) {
        if (s->looked >= s->work || s->count + CELL_PIECES > s->room || s->heap[0].depth >= CELL_DEPTH) break;
        if (watch_is_stopped(&o->watch) || s->lower > s->ceiling) break;
        cell c = pop(s), pieces[CELL_PIECES];
        uint32_t count = cut(s, &c, pieces);
        for (uint32_t i = 0; i < count; i++) cell_search_add(s, &pieces[i]);
        if (o->progress && s->looked / 1024 != (s->looked - count) / 1024)
            o->progress(o->progress_context, s->looked, s->work);
    }
    for (size_t i = 0; i < s->count; i++) drop(s, &s->heap[i]);
    return max2(s->lower, s->dropped);
}
