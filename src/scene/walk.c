#include "scene/walk.h"

typedef struct walk_entry {
    uint32_t node;
    double key;
} walk_entry;

// Below a node of a tree deeper than the stack: in the order of the tree, without one.
static void run_below(const walk *x, uint32_t root) {
    uint32_t end = broad_skip(x->tree, root);
    for (uint32_t at = root; at != end;) {
        const broad_node *n = &x->tree->nodes[at];
        int is_near = x->measure(x->context, &n->bounds) <= *x->bound;
        if (is_near && !n->child) x->visit(x->context, n->body);
        at = is_near && n->child ? n->child : broad_skip(x->tree, at);
    }
}

void walk_run(const walk *x) {
    const broad_node *nodes = x->tree->nodes;
    walk_entry stack[BROAD_STACK + 2];
    uint32_t count = 0;
    if (!x->tree->leaf_count) return;
    stack[count++] = (walk_entry){0, x->measure(x->context, &nodes[0].bounds)};
    while (count) {
        walk_entry e = stack[--count];
        const broad_node *n = &nodes[e.node];
        if (!(e.key <= *x->bound)) continue;
        if (!n->child) {
            x->visit(x->context, n->body);
        } else if (count >= BROAD_STACK) {
            run_below(x, e.node);
        } else {
            walk_entry left = {n->child, x->measure(x->context, &nodes[n->child].bounds)};
            walk_entry right = {n->child + 1, x->measure(x->context, &nodes[n->child + 1].bounds)};
            int is_right_first = right.key < left.key;
            stack[count++] = is_right_first ? left : right;
            stack[count++] = is_right_first ? right : left;
        }
    }
}

int walk_touching_below(const broad *t, const box *bounds, uint32_t root, walk_touch *touch, void *context) {
    uint32_t end = broad_skip(t, root);
    for (uint32_t at = root; at != end;) {
        const broad_node *n = &t->nodes[at];
        int is_near = box_is_overlapping(bounds, &n->bounds);
        if (is_near && !n->child && !touch(context, n)) return 0;
        at = is_near && n->child ? n->child : broad_skip(t, at);
    }
    return 1;
}
