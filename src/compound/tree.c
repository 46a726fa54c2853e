// The tree over a compound's parts, built from the top down: parts are sorted along each axis by their boxes' centres,
// and cut where the surfaces of both sides, weighed by their parts, sum up to least (J. Goldsmith, J. Salmon, Automatic
// creation of object hierarchies for ray tracing, 1987), a quarter of the parts at least to each side. Ties go to the
// lower index, so the tree depends on the parts alone. Cost: all vertices for each level.
//
// What is proven: every node's box, sphere and ellipsoid contain its parts, radii and all rounding included. A posed
// vertex as it comes here is off by less than 46 u E (compound.h); a box's centre and half sizes by 4 u E, the sphere's
// radius by 8 u of itself: 64 u E, with the largest E of the compound, covers all of it.
#include "compound/compound.h"

#include "base/allocator.h"
#include "ellipsoid/contain.h"
#include "ellipsoid/fit.h"
#include "linear/box.h"
#include "linear/rotation.h"
#include "polytope/sort.h"

#include <string.h>

// Working memory: boxes in the caller's order, and the order itself.
typedef struct builder {
    double *xyz; ///< working memory for all vertices
    ovoid_compound *compound;
    const ovoid_posed_shape *parts;
    const parts_vertices *all;
    box *boxes;
    uint32_t *order, *scratch;
    double *areas;
    double error; ///< 64 u E, and what underflow can hide
    int failed;   ///< no memory
} builder;

double posed_shape_compute_extent(const ovoid_posed_shape *body) {
    const ovoid_shape *s = body->shape;
    return (vec3_norm(body->pose.position) + vec3_norm(s->origin)) + (s->span + s->lower_radius);
}

// The box of a part's vertices, without its radius.
static box find_box(const parts_vertices *all, uint32_t part) {
    box b = {vec3_at(all->xyz, all->starts[part]), vec3_at(all->xyz, all->starts[part])};
    for (size_t k = all->starts[part] + 1; k < all->starts[part + 1]; k++) {
        vec3 v = vec3_at(all->xyz, k);
        b = box_join(&b, &(box){v, v});
    }
    return b;
}

static box grow(box b, double by) {
    vec3 all = {by, by, by};
    return (box){vec3_sub(b.min, all), vec3_add(b.max, all)};
}

// The largest distance of a part's vertices from a point, without the radius.
static double find_reach(const parts_vertices *all, uint32_t part, vec3 center) {
    double most = 0;
    for (size_t k = all->starts[part]; k < all->starts[part + 1]; k++)
        most = max2(most, vec3_norm_squared(vec3_sub(vec3_at(all->xyz, k), center)));
    return sqrt(most);
}

// Drops a node's ellipsoid if the box is about as narrow. The ellipsoid's average support over all directions is at
// most the root of a third of the trace, that of a box half the sum of its half sizes. An ellipsoid a tenth larger
// still pays in some directions (measured).
static void drop_if_wide(compound_node *n) {
    double of_box = 0.5 * (n->half.x + n->half.y + n->half.z);
    if (!(sqrt(sym3_trace(n->round) / 3) < 1.1 * of_box)) n->round = (sym3){0, 0, 0, 0, 0, 0};
}

// The smallest ellipsoid around a node's vertices, enlarged by the largest radius; used if it is proven and narrower
// than the box. Only if there is a part of rank 3, since flat parts need a hull to find their rank.
static void fit_ellipsoid(builder *b, compound_node *n) {
    uint32_t rank = 0;
    double radius = 0;
    size_t count = 0;
    for (uint32_t k = n->first; k < n->end; k++) {
        uint32_t part = b->order[k];
        size_t from = b->all->starts[part], size = b->all->starts[part + 1] - from;
        memcpy(b->xyz + 3 * count, b->all->xyz + 3 * from, 3 * size * sizeof(double));
        count += size;
        rank = b->parts[part].shape->rank > rank ? b->parts[part].shape->rank : rank;
        radius = max2(radius, b->parts[part].shape->lower_radius);
    }
    if (rank < 3 || count > UINT32_MAX) return;
    ovoid_polytope points = {.vertices = b->xyz, .vertex_count = (uint32_t)count, .rank = rank};
    ovoid_fit fit;
    ovoid_code code = ellipsoid_fit_outer(&points, &(fit_options){0.02, NULL, &b->compound->allocator, NULL}, &fit);
    if (code == OVOID_ERROR_MEMORY) b->failed = 1; // the tree must not depend on the memory there is
    if (code != OVOID_OK) return;
    if (!ellipsoid_is_enclosing(&points, &fit.ellipsoid)) return;
    n->round = ellipsoid_enlarge(fit.ellipsoid, radius + b->error).q;
    n->shift = vec3_sub(fit.ellipsoid.center, n->center);
    drop_if_wide(n);
}

// The bounds of the parts order[first..end).
static compound_node make_node(builder *b, uint32_t first, uint32_t end) {
    box all = b->boxes[b->order[first]];
    for (uint32_t k = first + 1; k < end; k++) all = box_join(&all, &b->boxes[b->order[k]]);
    compound_node n = {.first = first, .end = end};
    n.center = vec3_add(vec3_scale(all.min, 0.5), vec3_scale(all.max, 0.5));
    n.half =
        vec3_add(vec3_sub(vec3_scale(all.max, 0.5), vec3_scale(all.min, 0.5)), (vec3){b->error, b->error, b->error});
    for (uint32_t k = first; k < end; k++) {
        uint32_t part = b->order[k];
        n.radius = max2(n.radius, find_reach(b->all, part, n.center) + b->parts[part].shape->lower_radius);
    }
    n.radius = n.radius * (1 + 16 * 0x1p-53) + b->error;
    fit_ellipsoid(b, &n);
    return n;
}

// A part and its box's centre along an axis, for sorting.
typedef struct along {
    const box *boxes;
    int axis;
} along;

static int compare_along(const void *context, uint32_t a, uint32_t b) {
    const along *by = context;
    double x = vec3_get(by->boxes[a].min, by->axis) + vec3_get(by->boxes[a].max, by->axis);
    double y = vec3_get(by->boxes[b].min, by->axis) + vec3_get(by->boxes[b].max, by->axis);
    if (x < y || x > y) return x < y ? -1 : 1;
    return a < b ? -1 : a > b;
}

static double find_area(const box *b) {
    vec3 d = vec3_sub(b->max, b->min);
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

// The best cut of a sorted run: the least sum of surfaces weighed by their parts, with at least a quarter of the parts
// on each side.
static uint32_t find_cut(const builder *b, const uint32_t *order, uint32_t count, double *cost) {
    box right = b->boxes[order[count - 1]];
    for (uint32_t k = count - 1; k > 0; k--) {
        right = box_join(&right, &b->boxes[order[k]]);
        b->areas[k] = find_area(&right) * (count - k);
    }
    uint32_t best = 0, least = count / 4 > 0 ? count / 4 : 1;
    box left = b->boxes[order[0]];
    for (uint32_t k = 1; k <= count - least; k++) {
        double sum = find_area(&left) * k + b->areas[k];
        left = box_join(&left, &b->boxes[order[k]]);
        if (k < least || (best > 0 && !(sum < *cost))) continue;
        best = k;
        *cost = sum;
    }
    return best;
}

// Sorts the parts order[first..end) along the best axis; returns where the right half begins.
static uint32_t split(builder *b, uint32_t first, uint32_t end) {
    uint32_t count = end - first, best = 0, *run = b->order + first;
    double least = INFINITY;
    int axis = 0;
    for (int i = 0; i < 3; i++) {
        along by = {b->boxes, i};
        sort_indices(run, b->scratch, count, (index_order){compare_along, &by});
        double cost = 0;
        uint32_t cut = find_cut(b, run, count, &cost);
        if (best > 0 && !(cost < least)) continue;
        best = cut;
        least = cost;
        axis = i;
    }
    along by = {b->boxes, axis};
    if (axis != 2) sort_indices(run, b->scratch, count, (index_order){compare_along, &by});
    return first + best;
}

// Builds nodes in preorder, with a stack of the right halves.
static void build(builder *b) {
    struct {
        size_t node;
        uint32_t first, end;
    } stack[COMPOUND_DEPTH_MAX] = {{0, 0, b->compound->count}};
    for (int waiting = 1; waiting > 0;) {
        waiting--;
        size_t node = stack[waiting].node;
        uint32_t first = stack[waiting].first, end = stack[waiting].end;
        for (; end - first > 1; node++) {
            b->compound->nodes[node] = make_node(b, first, end);
            uint32_t middle = split(b, first, end);
            stack[waiting].node = node + 2 * (size_t)(middle - first);
            stack[waiting].first = middle;
            stack[waiting].end = end;
            waiting++;
            end = middle;
        }
        b->compound->nodes[node] = make_node(b, first, end);
    }
}

int tree_build(ovoid_compound *c, const ovoid_posed_shape *parts, const parts_vertices *all) {
    uint32_t count = c->count;
    builder b = {.compound = c,
                 .parts = parts,
                 .all = all,
                 .order = c->order,
                 .error = 64 * 0x1p-53 * c->extent + OVOID_LENGTH_MIN};
    b.boxes = allocator_allocate(&c->allocator, count, sizeof(box));
    b.scratch = allocator_allocate(&c->allocator, count, sizeof(uint32_t));
    b.areas = allocator_allocate(&c->allocator, count, sizeof(double));
    b.xyz = allocator_allocate(&c->allocator, all->starts[count], 3 * sizeof(double));
    int ok = b.boxes && b.scratch && b.areas && b.xyz;
    if (ok) {
        for (uint32_t i = 0; i < count; i++) {
            b.boxes[i] = grow(find_box(all, i), parts[i].shape->lower_radius);
            b.order[i] = i;
        }
        build(&b);
        ok = !b.failed;
        for (uint32_t k = 0; k < count; k++) {
            c->parts[k] = part_make(&parts[c->order[k]]);
            c->places[c->order[k]] = k;
        }
    }
    allocator_release(&c->allocator, b.boxes);
    allocator_release(&c->allocator, b.scratch);
    allocator_release(&c->allocator, b.areas);
    allocator_release(&c->allocator, b.xyz);
    return ok;
}

compound_node node_make_shape(const ovoid_shape *s) {
    vec3 low = s->measures.box.min, high = s->measures.box.max;
    double error = 64 * 0x1p-53 * (vec3_norm(s->origin) + s->span + s->lower_radius) + OVOID_LENGTH_MIN,
           grown = s->lower_radius + error;
    vec3 middle = vec3_add(vec3_scale(low, 0.5), vec3_scale(high, 0.5));
    vec3 half = vec3_add(vec3_sub(vec3_scale(high, 0.5), vec3_scale(low, 0.5)), (vec3){grown, grown, grown});
    double reach = vec3_norm(vec3_sub(s->center, middle)) + s->reach;
    compound_node n = {.half = half,
                       .radius = min2(reach + s->lower_radius, vec3_norm(half)) * (1 + 16 * 0x1p-53) + error};
    n.center = vec3_add(middle, s->origin);
    n.end = 1;
    if (s->rank < 3) return n;
    n.round = ellipsoid_enlarge(s->outer, grown).q;
    n.shift = vec3_sub(s->outer.center, middle);
    drop_if_wide(&n);
    return n;
}

compound_part part_make(const ovoid_posed_shape *body) {
    const ovoid_shape *s = body->shape;
    compound_part p = {.shape = s, .pose = body->pose, .rotation = quat_to_mat3(body->pose.rotation)};
    p.at = vec3_add(body->pose.position, mat3_mul_vec3(p.rotation, s->origin));
    p.center = vec3_add(p.at, mat3_mul_vec3(p.rotation, s->center));
    double rounding = 64 * 0x1p-53 * posed_shape_compute_extent(body) + OVOID_LENGTH_MIN;
    p.reach = (s->reach + s->lower_radius) * (1 + 4 * 0x1p-53) + rounding;
    return p;
}
