// The tree of boxes over a solid's triangles, built top down. A range of triangles is cut in two, and the part with the
// largest surface cut again, until there are eight or none of them has more than eight; those are the children of a
// node (I. Wald, C. Benthin, S. Boulos, Getting rid of packets, 2008). A cut is the best of sixteen places along each
// axis by the surface area heuristic (I. Wald, On fast construction of SAH-based bounding volume hierarchies, 2007),
// moved to a multiple of eight triangles, so that all but one or two nodes of triangles are full. Each side gets at
// least a quarter, so no path is longer than 64. Quickselect puts the triangles there (C. A. R. Hoare, Algorithm 65:
// find, 1961), ties by their index, so the tree depends only on the input.
#include "base/allocator.h"
#include "solid/solid.h"

#include <string.h>

enum { BINS = 16 };

// Triangles at [first, end) of the order.
typedef struct range {
    uint32_t first, end;
    box bounds;
    double surface;
    uint32_t level; ///< of its node, the root is 1; set while it is on the stack
} range;

typedef struct builder {
    ovoid_solid *solid;
    const solid_triangle *triangles;
    box *bounds; ///< of each triangle, in the tree's frame and unit
} builder;

uint32_t tree_get_most_nodes(uint32_t triangles) {
    // A cut leaves at least three triangles on each side, so at most a third as many nodes hold triangles; the other
    // nodes have at least two children, so there are fewer of them.
    return 2 * (triangles / 3) + 1;
}

// Twice the centre of a triangle's box.
static double get_center(const builder *b, uint32_t t, int axis) {
    return vec3_get(b->bounds[t].min, axis) + vec3_get(b->bounds[t].max, axis);
}

static int is_before(const builder *b, uint32_t t, uint32_t pivot, double center, int axis) {
    double x = get_center(b, t, axis);
    return x < center || (x <= center && t < pivot);
}

// Reorders the triangles so that those at [first, middle) come before those at [middle, end) along the axis.
static void select_first(const builder *b, uint32_t first, uint32_t middle, uint32_t end, int axis) {
    uint32_t *order = b->solid->order;
    while (end - first > 1) {
        uint32_t at = first + (end - first) / 2, pivot = order[at], last = first;
        double center = get_center(b, pivot, axis);
        order[at] = order[end - 1];
        for (uint32_t i = first; i + 1 < end; i++) {
            if (!is_before(b, order[i], pivot, center, axis)) continue;
            uint32_t t = order[i];
            order[i] = order[last];
            order[last++] = t;
        }
        order[end - 1] = order[last];
        order[last] = pivot;
        if (last == middle) return;
        if (last < middle)
            first = last + 1;
        else
            end = last;
    }
}

static range make_range(const builder *b, uint32_t first, uint32_t end) {
    range r = {first, end, box_make_empty(), 0, 0};
    for (uint32_t i = first; i < end; i++) r.bounds = box_join(&r.bounds, &b->bounds[b->solid->order[i]]);
    r.surface = box_compute_surface(&r.bounds);
    return r;
}

// The least cost of a cut after one of the bins along an axis; *left: the number of triangles on the left of that cut.
static double find_cut(const builder *b, const range *r, int axis, box centers, uint32_t *left) {
    uint32_t count[BINS] = {0};
    box bounds[BINS];
    double low = vec3_get(centers.min, axis), width = vec3_get(centers.max, axis) - low;
    if (!(width > 0)) return INFINITY;
    for (int i = 0; i < BINS; i++) bounds[i] = box_make_empty();
    double scale = BINS * (1 - 0x1p-40) / width;
    for (uint32_t i = r->first; i < r->end; i++) {
        uint32_t t = b->solid->order[i];
        double at = (get_center(b, t, axis) - low) * scale;
        int bin = at < BINS ? (int)at : BINS - 1;
        count[bin]++;
        bounds[bin] = box_join(&bounds[bin], &b->bounds[t]);
    }
    double after[BINS], best = INFINITY;
    box all = box_make_empty();
    for (int i = BINS - 1; i > 0; i--) {
        all = box_join(&all, &bounds[i]);
        after[i] = box_compute_surface(&all);
    }
    all = box_make_empty();
    uint32_t before = 0, total = r->end - r->first;
    for (int i = 0; i + 1 < BINS; i++) {
        all = box_join(&all, &bounds[i]);
        before += count[i];
        if (before == 0 || before == total) continue;
        double cost = before * box_compute_surface(&all) + (total - before) * after[i + 1];
        if (cost < best) best = cost, *left = before;
    }
    return best;
}

// Cuts a range of more than eight triangles in two.
static void cut(const builder *b, const range *r, range two[2]) {
    uint32_t count = r->end - r->first, left = count / 2, least = (count + 3) / 4;
    box centers = box_make_empty();
    for (uint32_t i = r->first; i < r->end; i++) {
        uint32_t t = b->solid->order[i];
        vec3 c = {get_center(b, t, 0), get_center(b, t, 1), get_center(b, t, 2)};
        centers = box_add_point(&centers, c);
    }
    double best = INFINITY;
    int axis = 0;
    for (int k = 0; k < 3; k++) {
        uint32_t found = left;
        double cost = find_cut(b, r, k, centers, &found);
        if (cost < best) best = cost, axis = k, left = found;
    }
    left = left < least ? least : left > count - least ? count - least : left;
    uint32_t whole = (left + BOX8 / 2) / BOX8 * BOX8;
    if (whole >= least && whole + least <= count) left = whole;
    uint32_t middle = r->first + left;
    select_first(b, r->first, middle, r->end, axis);
    two[0] = make_range(b, r->first, middle);
    two[1] = make_range(b, middle, r->end);
}

// The children of a range; returns their number.
static uint32_t divide(const builder *b, const range *whole, range child[BOX8]) {
    uint32_t count = whole->end - whole->first;
    if (count <= BOX8) {
        for (uint32_t i = 0; i < count; i++) child[i] = make_range(b, whole->first + i, whole->first + i + 1);
        return count;
    }
    child[0] = *whole;
    for (count = 1; count < BOX8; count++) {
        uint32_t widest = BOX8;
        for (uint32_t i = 0; i < count; i++)
            if (child[i].end - child[i].first > BOX8 && (widest == BOX8 || child[i].surface > child[widest].surface))
                widest = i;
        if (widest == BOX8) break;
        // Keeps the children in order, so that the triangles of a node remain a range.
        memmove(&child[widest + 2], &child[widest + 1], (count - widest - 1) * sizeof *child);
        range parent = child[widest];
        cut(b, &parent, &child[widest]);
    }
    return count;
}

static void set_node(solid_node *n, const range *r, uint32_t children) {
    box8_round_out(&r->bounds, n->low, n->high);
    n->first = r->first;
    n->end = r->end;
    n->children = children;
}

// Makes the node of a range; its children that are nodes are pushed on the stack.
static uint32_t make_node(const builder *b, const range *whole, uint32_t node, range *stack, uint32_t *nodes) {
    ovoid_solid *s = b->solid;
    range child[BOX8];
    uint32_t count = divide(b, whole, child), waiting = 0;
    box8 *n = &s->boxes[node];
    memset(n, 0, sizeof *n);
    set_node(&s->nodes[node], whole, count);
    for (uint32_t i = 0; i < BOX8; i++) {
        if (i >= count) {
            for (int k = 0; k < 3; k++) n->low[k][i] = 0x1p100f, n->high[k][i] = -0x1p100f;
            continue;
        }
        box8_set_lane(n, i, &child[i].bounds);
        if (child[i].end - child[i].first == 1) {
            n->child[i] = child[i].first;
            n->leaves |= 1u << i;
        } else {
            n->child[i] = s->node_count++;
            stack[waiting] = child[i];
            stack[waiting].level = whole->level + 1;
            nodes[waiting++] = n->child[i];
        }
    }
    return waiting;
}

box solid_make_bounds(const ovoid_solid *s, const solid_triangle *t) {
    box all = box_make_empty();
    for (int i = 0; i < 3; i++) {
        all = box_add_point(&all, solid_to_tree(s, vec3_at(s->points, t->point[i])));
    }
    return all;
}

int solid_build_tree(ovoid_solid *s, const solid_triangle *triangles) {
    builder b = {s, triangles, allocator_allocate(&s->allocator, s->triangle_count, sizeof(box))};
    if (!b.bounds) return 0;
    for (uint32_t t = 0; t < s->triangle_count; t++) {
        b.bounds[t] = solid_make_bounds(s, &triangles[t]);
        s->order[t] = t;
    }
    range stack[SOLID_DEPTH_MAX * BOX8] = {make_range(&b, 0, s->triangle_count)};
    uint32_t nodes[SOLID_DEPTH_MAX * BOX8] = {0};
    stack[0].level = 1;
    s->node_count = 1;
    for (uint32_t count = 1; count > 0;) {
        range whole = stack[--count];
        s->depth = whole.level > s->depth ? whole.level : s->depth;
        count += make_node(&b, &whole, nodes[count], stack + count, nodes + count);
    }
    allocator_release(&s->allocator, b.bounds);
    return 1;
}
