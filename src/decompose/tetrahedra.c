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

static uint32_t add_piece(const cell *c, vec3 a, vec3 b, vec3 d, vec3 e, cell *pieces, uint32_t count) {
    pieces[count] = *c;
    pieces[count].depth = c->depth + 1;
    pieces[count].corner[0] = a;
    pieces[count].corner[1] = b;
    pieces[count].corner[2] = d;
    pieces[count].corner[3] = e;
    return count + 1;
}

// The prism over two triangles with corresponding corners, as three tetrahedra.
static uint32_t add_prism(const cell *c, const vec3 a[3], const vec3 b[3], cell *pieces, uint32_t count) {
    count = add_piece(c, a[0], a[1], a[2], b[0], pieces, count);
    count = add_piece(c, a[1], a[2], b[0], b[1], pieces, count);
    return add_piece(c, a[2], b[0], b[1], b[2], pieces, count);
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
    uint32_t count = 0;
    if (below == 2) {
        vec3 x[2][2];
        for (int i = 0; i < 2; i++)
            for (int j = 0; j < 2; j++) x[i][j] = cross_edge(low[i], dl[i], high[j], dh[j]);
        *first_above = 3;
        count = add_prism(c, (vec3[]){low[0], x[0][0], x[0][1]}, (vec3[]){low[1], x[1][0], x[1][1]}, pieces, count);
        return add_prism(c, (vec3[]){high[0], x[0][0], x[1][0]}, (vec3[]){high[1], x[0][1], x[1][1]}, pieces, count);
    }
    // One corner alone: a tetrahedron, and a prism over what is left of the opposite side.
    vec3 x[3];
    *first_above = below == 1 ? 1 : 3;
    if (below == 1) {
        for (int i = 0; i < 3; i++) x[i] = cross_edge(low[0], dl[0], high[i], dh[i]);
        count = add_piece(c, low[0], x[0], x[1], x[2], pieces, count);
        return add_prism(c, x, high, pieces, count);
    }
    for (int i = 0; i < 3; i++) x[i] = cross_edge(low[i], dl[i], high[0], dh[0]);
    count = add_prism(c, x, low, pieces, count);
    return add_piece(c, high[0], x[0], x[1], x[2], pieces, count);
}

uint32_t cell_halve(const cell *c, cell pieces[CELL_PIECES]) {
    vec3 halves[2][4];
    (void)tetrahedron_halve(c->corner, halves);
    for (int k = 0; k < 2; k++)
        add_piece(c, halves[k][0], halves[k][1], halves[k][2], halves[k][3], pieces, (uint32_t)k);
    return 2;
}

// ---- the heap

static int is_worse(const void *a, const void *b) { return ((const cell *)a)->bound > ((const cell *)b)->bound; }

static void push(cell_search *s, const cell *c) { heap_push(s->heap, s->count++, sizeof *c, c, is_worse); }

static cell pop(cell_search *s) {
    cell top;
    heap_pop(s->heap, s->count--, sizeof top, &top, is_worse);
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
