// The traversal of both trees from the pair of roots down (S. Quinlan, Efficient distance computation between
// non-convex objects, 1994): the larger node of a pair is replaced by its children, eight bounds at a time, the nearest
// visited first. A pair whose bound is beyond what the goal needs, or not below the best pair's upper bound less the
// tolerance, is left out. The stack is as deep as both trees together; nothing is allocated.
#include "body/search.h"
#include "tools/heap.h"

enum { WAITING_ROOM = 1280, HEAP_MOST = 1024 };
_Static_assert(WAITING_ROOM > 2 * (BOX8 - 1) * SOLID_DEPTH_MAX + 1, "the deepest trees leave room for a heap");

// The children of a node that are not left out, farthest first.
typedef struct children {
    waiting_pair pair[BOX8];
    uint32_t count;
} children;

static void insert(children *c, const waiting_pair *w) {
    uint32_t at = c->count++;
    for (; at > 0 && c->pair[at - 1].lower < w->lower; at--) c->pair[at] = c->pair[at - 1];
    c->pair[at] = *w;
}

// The bounds of the children of a solid's node, in lanes. side 0: nodes of a beside a box of b.
static void bound_boxes(const solid_search *h, int side, solid_ref node, const tree_box *rest, double lower[BOX8]) {
    const ovoid_solid *s = side ? h->b.solid : h->a.solid;
    solid8_other other;
    solid_frame_turn(&h->frame, side, rest, search_get_normal(h), &other);
    other.unit = s->unit;
    h->kernels->boxes(&s->boxes[node], &other, lower);
}

// Of the two children of a compound's node.
static void bound_nodes(const solid_search *h, int side, const solid_ref *two, const tree_box *rest,
                        double lower[BOX8]) {
    for (int i = 0; i < 2; i++) {
        tree_box own = solid_view_get_box(side ? &h->b : &h->a, two[i]);
        lower[i] = solid_frame_find_gap(&h->frame, side ? rest : &own, side ? &own : rest, search_get_normal(h)).lower;
    }
}

static void bound_children(solid_search *h, const waiting_pair *w, int side, const tree_box *rest, children *found) {
    const solid_view *v = side ? &h->b : &h->a;
    solid_ref node = side ? w->b : w->a, all[BOX8];
    uint32_t count = solid_view_get_children(v, node, all);
    double lower[BOX8];
    if (v->solid)
        bound_boxes(h, side, node, rest, lower);
    else
        bound_nodes(h, side, all, rest, lower);
    h->out->visited += count;
    found->count = 0;
    for (uint32_t i = 0; i < count; i++) {
        solid_ref child = all[i];
        waiting_pair next = {side ? w->a : child, side ? child : w->b, lower[i] - h->frame.claim, h->normal_count - 1};
        if (search_is_left_out(h, next.lower))
            search_exclude_boxes(h, &next);
        else
            insert(found, &next);
    }
}

// Two leaves, of which at least one is no triangle.
static void visit_pair(solid_search *h, const waiting_pair *w) {
    uint32_t a = ref_get_place(w->a), b = ref_get_place(w->b);
    if (a == h->warm_a && b == h->warm_b) return;
    if (search_is_filtered(h, a, b)) return;
    search_visit_leaves(h, a, b, NULL);
}

// Children that are triangles, of a node beside a triangle: in lanes.
static void visit_triangles(solid_search *h, int side, const children *found) {
    uint32_t places[BOX8], one = ref_get_place(side ? found->pair[0].a : found->pair[0].b);
    for (uint32_t i = 0; i < found->count; i++) {
        // The nearest first.
        const waiting_pair *w = &found->pair[found->count - 1 - i];
        places[i] = ref_get_place(side ? w->b : w->a);
    }
    search_visit_triangles(h, side, one, places, found->count);
}

// A waiting pair in 16 bytes: the six bits of its normal's number are where a node's or triangle's has none.
typedef struct packed_pair {
    uint32_t a, b;
    double lower;
} packed_pair;

enum { PACKED_SHIFT = 28, PACKED_MASK = 7 };
_Static_assert(OVOID_SOLID_TRIANGLES_MAX <= (size_t)1 << PACKED_SHIFT, "the number of a triangle or node has room");
_Static_assert(SEARCH_NORMALS <= (PACKED_MASK + 1) * (PACKED_MASK + 1), "the number of a normal has room");

static packed_pair pack(const waiting_pair *w) {
    uint32_t low = w->normal & PACKED_MASK, high = w->normal / (PACKED_MASK + 1);
    return (packed_pair){w->a | low << PACKED_SHIFT, w->b | high << PACKED_SHIFT, w->lower};
}

static waiting_pair unpack(packed_pair p) {
    uint32_t low = p.a >> PACKED_SHIFT & PACKED_MASK, high = p.b >> PACKED_SHIFT & PACKED_MASK;
    const uint32_t own = ~((uint32_t)PACKED_MASK << PACKED_SHIFT);
    return (waiting_pair){p.a & own, p.b & own, p.lower, high * (PACKED_MASK + 1) + low};
}

// Pairs that wait: of boxes that overlap the last one first, since each has to be opened; then the nearest, from a heap
// (J. W. J. Williams, Algorithm 232: heapsort, 1964), so that none is opened whose bound is above the answer. The stack
// is at the beginning of the memory, the heap behind the most that the stack can take; where it is full, pairs go to
// the stack.
typedef struct waiting {
    packed_pair all[WAITING_ROOM], *heap;
    uint32_t stacked, heaped, heap_room;
} waiting;

// Down a path of both trees each node leaves all its children but one.
static uint32_t find_most_stacked(const solid_view *v) {
    return v->solid ? (BOX8 - 1) * v->solid->depth : v->compound ? COMPOUND_DEPTH_MAX : 0;
}

static void waiting_begin(waiting *q, const solid_search *h) {
    uint32_t most = 1 + find_most_stacked(&h->a) + find_most_stacked(&h->b);
    q->stacked = q->heaped = 0;
    q->heap = q->all + most;
    q->heap_room = WAITING_ROOM - most < HEAP_MOST ? WAITING_ROOM - most : HEAP_MOST;
}

static int is_nearer(const void *a, const void *b) {
    return ((const packed_pair *)a)->lower < ((const packed_pair *)b)->lower;
}

static void push_heap(waiting *q, const waiting_pair *w) {
    packed_pair item = pack(w);
    heap_push(q->heap, q->heaped++, sizeof item, &item, is_nearer);
}

static packed_pair pop_heap(waiting *q) {
    packed_pair top;
    heap_pop(q->heap, q->heaped--, sizeof top, &top, is_nearer);
    return top;
}

static waiting_pair pop(waiting *q) { return unpack(q->stacked ? q->all[--q->stacked] : pop_heap(q)); }

// Children wait; triangles beside a triangle are visited at once.
static void pass_on(solid_search *h, int side, const children *found, waiting *q) {
    children leaves = {.count = 0};
    for (uint32_t i = 0; i < found->count; i++) {
        const waiting_pair *w = &found->pair[i];
        if (ref_is_triangle(w->a) && ref_is_triangle(w->b) && h->a.solid && h->b.solid)
            leaves.pair[leaves.count++] = *w;
        else if (w->lower > 0 && q->heaped < q->heap_room)
            push_heap(q, w);
        else
            q->all[q->stacked++] = pack(w);
    }
    if (leaves.count) visit_triangles(h, side, &leaves);
}

waiting_pair search_make_roots(const solid_search *h) {
    waiting_pair w = {solid_view_get_root(&h->a), solid_view_get_root(&h->b), 0, h->normal_count - 1};
    tree_box a = solid_view_get_box(&h->a, w.a), b = solid_view_get_box(&h->b, w.b);
    w.lower = solid_frame_find_gap(&h->frame, &a, &b, search_get_normal(h)).lower - h->frame.claim;
    return w;
}

void search_traverse(solid_search *h) {
    waiting q;
    waiting_begin(&q, h);
    waiting_pair roots = search_make_roots(h);
    q.all[q.stacked++] = pack(&roots);
    h->out->visited++;
    while (q.stacked + q.heaped > 0 && !search_is_decided(h)) {
        waiting_pair w = pop(&q);
        if (search_is_left_out(h, w.lower)) {
            search_exclude_boxes(h, &w);
            continue;
        }
        if (ref_is_triangle(w.a) && ref_is_triangle(w.b)) {
            visit_pair(h, &w);
            continue;
        }
        tree_box a = solid_view_get_box(&h->a, w.a), b = solid_view_get_box(&h->b, w.b);
        int side = !pair_is_split_first(w.a, &a, w.b, &b);
        children found;
        bound_children(h, &w, side, side ? &a : &b, &found);
        pass_on(h, side, &found, &q);
    }
}
