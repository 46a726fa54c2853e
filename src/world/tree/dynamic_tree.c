// Single steps of the dynamic tree: adding, removing and refitting a leaf, and the tree's cost.
#include "world/tree/wide_tree.h"

void dynamic_tree_make(dynamic_tree *t, tree_node *nodes, uint32_t capacity) {
    *t = (dynamic_tree){.nodes = nodes, .capacity = capacity, .used = 2};
    nodes[0] = (tree_node){.bounds = box_make_empty(), .parent = NONE, .body = NONE};
}

static uint32_t take_couple(dynamic_tree *t) {
    uint32_t at = t->free;
    if (at) {
        t->free = t->nodes[at].link;
        return at;
    }
    at = t->used;
    t->used += 2;
    return at;
}

static void release_couple(dynamic_tree *t, uint32_t at) {
    t->nodes[at].link = t->free;
    t->free = at;
}

// Stores a node at another place, and updates its children's parent or its body's leaf.
static void put_node(dynamic_tree *t, uint32_t at, const tree_node *n, uint32_t parent, uint32_t *leaf_of) {
    t->nodes[at] = *n;
    t->nodes[at].parent = parent;
    if (n->child) {
        t->nodes[n->child].parent = at;
        t->nodes[n->child + 1].parent = at;
    } else {
        leaf_of[n->body] = at;
    }
}

// Recomputes the bounds of inner nodes from `at` upward, until one does not change. The sibling of the changed child is
// known without reading the parent, so both are fetched at once.
static void refit_up(dynamic_tree *t, uint32_t at) {
    uint32_t couple = at == NONE ? 0 : t->nodes[at].child;
    while (at != NONE) {
        tree_node *n = &t->nodes[at];
        box joined = box_join(&t->nodes[couple].bounds, &t->nodes[couple + 1].bounds);
        if (box_is_same(&joined, &n->bounds)) return;
        n->bounds = joined;
        wide_tree_set_box(t, n);
        couple = at & ~1u;
        at = n->parent;
    }
}

// The node beside which a new leaf adds least surface: descends to the cheaper child while that costs less than
// staying.
static uint32_t find_sibling(const dynamic_tree *t, const box *bounds) {
    uint32_t at = 0;
    while (t->nodes[at].child) {
        uint32_t child = t->nodes[at].child;
        double cost[2];
        for (uint32_t k = 0; k < 2; k++) {
            box joined = box_join(&t->nodes[child + k].bounds, bounds);
            cost[k] = box_compute_surface(&joined) - box_compute_surface(&t->nodes[child + k].bounds);
        }
        box joined = box_join(&t->nodes[at].bounds, bounds);
        // Staying adds a node with the joined surface; descending enlarges this node to it.
        double here = box_compute_surface(&joined);
        double grown = here - box_compute_surface(&t->nodes[at].bounds);
        uint32_t better = cost[1] < cost[0];
        if (here <= grown + cost[better]) break;
        at = child + better;
    }
    return at;
}

void dynamic_tree_add(dynamic_tree *t, uint32_t body, const box *bounds, uint32_t *leaf_of) {
    tree_node leaf = {.bounds = *bounds, .body = body};
    t->changes++;
    t->wide_count = 0;
    if (t->leaf_count++ == 0) {
        put_node(t, 0, &leaf, NONE, leaf_of);
        return;
    }
    uint32_t at = find_sibling(t, bounds), couple = take_couple(t);
    tree_node sibling = t->nodes[at];
    put_node(t, couple, &sibling, at, leaf_of);
    put_node(t, couple + 1, &leaf, at, leaf_of);
    t->nodes[at].child = couple;
    t->nodes[at].body = NONE;
    refit_up(t, at);
}

void dynamic_tree_remove(dynamic_tree *t, uint32_t leaf, uint32_t *leaf_of) {
    t->changes++;
    t->wide_count = 0;
    if (--t->leaf_count == 0) {
        t->nodes[0].body = NONE;
        t->nodes[0].bounds = box_make_empty();
        return;
    }
    // The sibling takes the parent's place.
    uint32_t parent = t->nodes[leaf].parent, couple = leaf & ~1u;
    tree_node sibling = t->nodes[leaf ^ 1u];
    put_node(t, parent, &sibling, t->nodes[parent].parent, leaf_of);
    release_couple(t, couple);
    refit_up(t, t->nodes[parent].parent);
}

void dynamic_tree_refit(dynamic_tree *t, uint32_t leaf, const box *bounds) {
    t->nodes[leaf].bounds = *bounds;
    wide_tree_set_box(t, &t->nodes[leaf]);
    refit_up(t, t->nodes[leaf].parent);
}

double dynamic_tree_compute_cost(const dynamic_tree *t) {
    if (t->leaf_count < 2) return 0;
    double sum = 0, whole = box_compute_surface(&t->nodes[0].bounds);
    for (uint32_t at = 0; at != NONE;) {
        const tree_node *n = &t->nodes[at];
        if (n->child) sum += box_compute_surface(&n->bounds);
        at = n->child ? n->child : dynamic_tree_skip(t, at);
    }
    return whole > 0 ? sum / whole : 0;
}
