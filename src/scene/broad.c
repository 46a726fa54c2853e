// The tree's single steps: add, remove, refit, cost.
#include "scene/broad.h"

void broad_make(broad *t, broad_node *nodes, uint32_t capacity) {
    *t = (broad){.nodes = nodes, .capacity = capacity, .used = 2};
    nodes[0] = (broad_node){.bounds = box_make_empty(), .parent = NONE, .body = NONE};
}

static uint32_t take_couple(broad *t) {
    uint32_t at = t->free;
    if (at) {
        t->free = t->nodes[at].next;
        return at;
    }
    at = t->used;
    t->used += 2;
    return at;
}

static void release_couple(broad *t, uint32_t at) {
    t->nodes[at].next = t->free;
    t->free = at;
}

// A node's contents at another place: those below it and the body learn of it.
static void put_node(broad *t, uint32_t at, const broad_node *n, uint32_t parent, uint32_t *leaf_of) {
    t->nodes[at] = *n;
    t->nodes[at].parent = parent;
    if (n->child) {
        t->nodes[n->child].parent = at;
        t->nodes[n->child + 1].parent = at;
    } else {
        leaf_of[n->body] = at;
    }
}

// Bounds of the inner nodes from `at` upward, until one stays as it was.
static void refit_up(broad *t, uint32_t at) {
    while (at != NONE) {
        broad_node *n = &t->nodes[at];
        box joined = box_join(&t->nodes[n->child].bounds, &t->nodes[n->child + 1].bounds);
        if (box_is_same(&joined, &n->bounds)) return;
        n->bounds = joined;
        at = n->parent;
    }
}

// The node beside which a new leaf adds least surface: down to the cheaper child, while that is cheaper than here.
static uint32_t find_sibling(const broad *t, const box *bounds) {
    uint32_t at = 0;
    while (t->nodes[at].child) {
        uint32_t child = t->nodes[at].child;
        double cost[2];
        for (uint32_t k = 0; k < 2; k++) {
            box joined = box_join(&t->nodes[child + k].bounds, bounds);
            cost[k] = box_compute_surface(&joined) - box_compute_surface(&t->nodes[child + k].bounds);
        }
        box joined = box_join(&t->nodes[at].bounds, bounds);
        // Beside this node: one more node of the joined surface. Below it: this node grows by what it lacks.
        double here = box_compute_surface(&joined);
        double grown = here - box_compute_surface(&t->nodes[at].bounds);
        uint32_t better = cost[1] < cost[0];
        if (here <= grown + cost[better]) break;
        at = child + better;
    }
    return at;
}

void broad_add(broad *t, uint32_t body, const box *bounds, uint32_t *leaf_of) {
    broad_node leaf = {.bounds = *bounds, .body = body};
    t->changes++;
    if (t->leaf_count++ == 0) {
        put_node(t, 0, &leaf, NONE, leaf_of);
        return;
    }
    uint32_t at = find_sibling(t, bounds), couple = take_couple(t);
    broad_node sibling = t->nodes[at];
    put_node(t, couple, &sibling, at, leaf_of);
    put_node(t, couple + 1, &leaf, at, leaf_of);
    t->nodes[at].child = couple;
    t->nodes[at].body = NONE;
    refit_up(t, at);
}

void broad_remove(broad *t, uint32_t leaf, uint32_t *leaf_of) {
    t->changes++;
    if (--t->leaf_count == 0) {
        t->nodes[0].body = NONE;
        t->nodes[0].bounds = box_make_empty();
        return;
    }
    // The sibling takes the parent's place.
    uint32_t parent = t->nodes[leaf].parent, couple = leaf & ~1u;
    broad_node sibling = t->nodes[leaf ^ 1u];
    put_node(t, parent, &sibling, t->nodes[parent].parent, leaf_of);
    release_couple(t, couple);
    refit_up(t, t->nodes[parent].parent);
}

void broad_refit(broad *t, uint32_t leaf, const box *bounds) {
    t->nodes[leaf].bounds = *bounds;
    refit_up(t, t->nodes[leaf].parent);
}

double broad_compute_cost(const broad *t) {
    if (t->leaf_count < 2) return 0;
    double sum = 0, whole = box_compute_surface(&t->nodes[0].bounds);
    for (uint32_t at = 0; at != NONE;) {
        const broad_node *n = &t->nodes[at];
        if (n->child) sum += box_compute_surface(&n->bounds);
        at = n->child ? n->child : broad_skip(t, at);
    }
    return whole > 0 ? sum / whole : 0;
}
