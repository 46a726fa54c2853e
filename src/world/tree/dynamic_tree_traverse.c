// Traversals of the tree with a small stack; below it they follow the order of the tree, without a stack.
#include "world/tree/dynamic_tree_traverse.h"

typedef struct traversal_entry {
    uint32_t node;
    double key;
} traversal_entry;

// Visits the subtree below a node when the stack is full, in the order of the tree.
static void run_below(const tree_traversal *traversal, uint32_t root) {
    uint32_t end = dynamic_tree_skip(traversal->tree, root);
    for (uint32_t at = root; at != end;) {
        const tree_node *n = &traversal->tree->nodes[at];
        int is_near = traversal->measure(traversal->context, &n->bounds) <= *traversal->bound;
        if (is_near && !n->child) traversal->visit(traversal->context, n->body);
        at = is_near && n->child ? n->child : dynamic_tree_skip(traversal->tree, at);
    }
}

void dynamic_tree_find_nearest(const tree_traversal *traversal) {
    const tree_node *nodes = traversal->tree->nodes;
    traversal_entry stack[TREE_STACK + 2];
    uint32_t count = 0;
    if (!traversal->tree->leaf_count) return;
    stack[count++] = (traversal_entry){0, traversal->measure(traversal->context, &nodes[0].bounds)};
    while (count) {
        traversal_entry e = stack[--count];
        const tree_node *n = &nodes[e.node];
        if (!(e.key <= *traversal->bound)) continue;
        if (!n->child) {
            traversal->visit(traversal->context, n->body);
        } else if (count >= TREE_STACK) {
            run_below(traversal, e.node);
        } else {
            traversal_entry left = {n->child, traversal->measure(traversal->context, &nodes[n->child].bounds)};
            traversal_entry right = {n->child + 1, traversal->measure(traversal->context, &nodes[n->child + 1].bounds)};
            int is_right_first = right.key < left.key;
            stack[count++] = is_right_first ? left : right;
            stack[count++] = is_right_first ? right : left;
        }
    }
}

int dynamic_tree_find_overlaps_below(const dynamic_tree *t, const box *bounds, uint32_t root, tree_touch *touch,
                                     void *context) {
    uint32_t end = dynamic_tree_skip(t, root);
    for (uint32_t at = root; at != end;) {
        const tree_node *n = &t->nodes[at];
        int is_near = box_is_overlapping(bounds, &n->bounds);
        if (is_near && !n->child && !touch(context, n)) return 0;
        at = is_near && n->child ? n->child : dynamic_tree_skip(t, at);
    }
    return 1;
}
