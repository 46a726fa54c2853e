// The traversal of two trees at once, from the pair of roots down (S. Quinlan, Efficient distance computation between
// non-convex objects, 1994; E. Larsen, S. Gottschalk, M. C. Lin, D. Manocha, Fast distance queries with rectangular
// swept sphere volumes, 2000). A pair whose bound is beyond what the goal needs, or not below the best pair's upper
// bound, is left out; a pair of leaves is queried; of any other pair the larger node is replaced by its children. So
// the bracket of the answer is that of the best pair, its lower end lowered to the least bound of all that was left
// out.
//
// Nothing is allocated: the pairs that wait are in memory of the caller's stack. At worst every pair of leaves is
// queried.
#ifndef OVOID_BODY_TRAVERSE_H
#define OVOID_BODY_TRAVERSE_H

#include "base/compiler.h"
#include "body/search.h"
#include "tools/heap.h"

/// Pairs that wait: those on the stack, the last one first; then the nearest from a heap (J. W. J. Williams, Algorithm
/// 232: heapsort, 1964), so that none is opened whose bound is above the answer.
typedef struct waiting {
    waiting_pair *stack, *heap;
    uint32_t stacked, heaped, heap_room;
} waiting;

static inline void waiting_push(waiting *q, const waiting_pair *w) { q->stack[q->stacked++] = *w; }

static inline int waiting_is_nearer(const void *a, const void *b) {
    return ((const waiting_pair *)a)->lower < ((const waiting_pair *)b)->lower;
}

/// 0 where the heap is full.
static inline int waiting_push_heap(waiting *q, const waiting_pair *w) {
    if (q->heaped >= q->heap_room) return 0;
    heap_push((heap){q->heap, q->heaped++, sizeof *w, waiting_is_nearer}, w);
    return 1;
}

static inline waiting_pair waiting_pop(waiting *q) {
    waiting_pair top;
    if (q->stacked) return q->stack[--q->stacked];
    heap_pop((heap){q->heap, q->heaped--, sizeof top, waiting_is_nearer}, &top);
    return top;
}

/// The one traversal. kind: a constant of the caller.
COMPILER_INLINED void search_traverse(body_search *state, const search_kind *kind, waiting *q) {
    waiting_pair roots = kind->bound_roots(state, min2(state->far, state->enough));
    waiting_push(q, &roots);
    state->out->visited++;
    while (q->stacked + q->heaped > 0 && !search_is_decided(state)) {
        waiting_pair w = waiting_pop(q);
        if (search_is_left_out(state, w.lower))
            kind->leave_out(state, &w);
        else if (waiting_is_leaves(&w))
            kind->visit_leaves(state, &w);
        else
            kind->open(state, &w, q);
    }
}

#endif
