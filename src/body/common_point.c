// A point that two bodies have in common where their surfaces touch and no two triangles are seen to cross: what proves
// that bodies with flush faces overlap. clearance.c says what such a point shows.
//
// Tried in this order, each within a number of evaluations: points beside the middle of what two flush triangles have
// in common, on both sides; points beside the middles of some triangles of each body, and those middles; then boxes
// of what the bodies' boxes have in common, the most promising first: the clearance of a point changes by no more than
// the point moves, so a box of half diagonal h around a point that is outside of a body by h or more is dropped.
#include "body/clearance.h"

#include "ovoid/shape.h"

enum { FLUSH_TRIES = 240, SAMPLE_TRIES = 240, BOX_TRIES = 480, SAMPLES = 20, LEAF_PAIRS = 64, BOXES = 128 };

typedef struct hunt {
    const framed_pair *pair;
    tree_box room; ///< what the bodies' boxes have in common, in a's frame
    uint32_t left; ///< evaluations
    common_point found;
} hunt;

/// 1 if the point shows an overlap. *least: the smaller of both clearances.
static int try_point(hunt *h, vec3 point, double *least) {
    *least = INFINITY;
    if (h->left == 0) return 0;
    h->left--;
    double a = framed_pair_find_clearance(h->pair, 0, point, 0), b = framed_pair_find_clearance(h->pair, 1, point, 0);
    *least = min2(a, b);
    double depth = (a + b) - h->pair->frame->claim;
    if (!(depth > 0) || !(depth > h->found.depth)) return 0;
    h->found = (common_point){point, depth};
    return 1;
}

// ---- beside triangles

// From a point of a surface to one side, near and nearer; farther again once a point is found.
static int try_side(hunt *h, vec3 from, vec3 normal, double length) {
    static const double steps[] = {0x1p-3, 0x1p-8, 0x1p-14};
    double least;
    for (int i = 0; i < 3; i++) {
        double step = steps[i] * length;
        if (!try_point(h, vec3_add_scaled(from, normal, step), &least)) continue;
        while (try_point(h, vec3_add_scaled(from, normal, step *= 2), &least)) {
        }
        return 1;
    }
    return 0;
}

static vec3 find_middle(const vec3 *corner, int count) {
    vec3 sum = {0, 0, 0};
    for (int i = 0; i < count; i++) sum = vec3_add_scaled(sum, corner[i], 1.0 / count);
    return sum;
}

static double find_longest(const vec3 t[3]) {
    double longest = 0;
    for (int i = 0; i < 3; i++) longest = max2(longest, vec3_norm(vec3_sub(t[(i + 1) % 3], t[i])));
    return longest;
}

static vec3 find_normal(const vec3 t[3]) { return vec3_unit(vec3_cross(vec3_sub(t[1], t[0]), vec3_sub(t[2], t[0]))); }

// Inward first, where the triangles are oriented outward.
static int try_sides(hunt *h, vec3 from, const vec3 t[3]) {
    vec3 n = find_normal(t);
    double length = find_longest(t);
    return try_side(h, from, vec3_neg(n), length) || try_side(h, from, n, length);
}

// ---- the triangles of leaves, in a's frame

static uint32_t count_triangles(const body_tree *tree, uint32_t place) {
    if (tree->solid) return 1;
    return tree->compound ? tree->compound->parts[place].shape->counts.triangles : tree->shape->counts.triangles;
}

// Triangle i of a leaf.
typedef struct leaf_triangle {
    uint32_t place, i;
} leaf_triangle;

static void get_triangle(const hunt *h, int side, leaf_triangle of, vec3 corner[3]) {
    const framed_pair *pair = h->pair;
    const body_tree *tree = side ? pair->b : pair->a;
    uint32_t place = of.place, i = of.i;
    for (int k = 0; k < 3; k++) {
        vec3 x;
        if (tree->solid) {
            x = solid_get_corner(tree->solid, place, k);
        } else {
            const compound_part *part = tree->compound ? &tree->compound->parts[place] : NULL;
            ovoid_polytope p = ovoid_shape_get_polytope(part ? part->shape : tree->shape);
            vec3 own = vec3_at(p.vertices, p.triangles[3 * (size_t)i + (size_t)k]);
            x = part ? vec3_add(part->at, mat3_mul_vec3(part->rotation, own)) : vec3_add(p.origin, own);
        }
        corner[k] = side ? vec3_add(pair->frame->translation, mat3_mul_vec3(pair->frame->to_a, x)) : x;
    }
}

// ---- flush triangles

enum { CLIPPED = 9 };

// A convex polygon.
typedef struct polygon {
    vec3 corner[CLIPPED];
    int count;
} polygon;

// What of a convex polygon is on the inner side of an edge of a triangle (I. E. Sutherland, G. W. Hodgman, Reentrant
// polygon clipping, 1974).
static void clip(const polygon *from, vec3 edge, vec3 inward, polygon *to) {
    to->count = 0;
    for (int i = 0; i < from->count; i++) {
        vec3 p = from->corner[i], q = from->corner[(i + 1) % from->count];
        double at_p = vec3_dot(inward, vec3_sub(p, edge)), at_q = vec3_dot(inward, vec3_sub(q, edge));
        if (at_p >= 0) to->corner[to->count++] = p;
        if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0))
            to->corner[to->count++] = vec3_add_scaled(p, vec3_sub(q, p), at_p / (at_p - at_q));
    }
}

/// The middle of what two triangles of one plane have in common; 0 where they have no area in common.
static int find_common_middle(const vec3 a[3], const vec3 b[3], vec3 *middle) {
    polygon common = {{a[0], a[1], a[2]}, 3};
    vec3 n = find_normal(b);
    for (int i = 0; i < 3 && common.count >= 3; i++) {
        vec3 inward = vec3_cross(n, vec3_sub(b[(i + 1) % 3], b[i]));
        const polygon whole = common;
        clip(&whole, b[i], inward, &common);
    }
    if (common.count >= 3) *middle = find_middle(common.corner, common.count);
    return common.count >= 3;
}

static int are_flush(const vec3 a[3], const vec3 b[3]) {
    vec3 n = find_normal(a), m = find_normal(b);
    double length = max2(find_longest(a), find_longest(b)), off = vec3_max_abs(vec3_cross(n, m));
    if (!(vec3_norm_squared(n) > 0.5) || !(vec3_norm_squared(m) > 0.5) || !(off <= 1e-6)) return 0;
    for (int i = 0; i < 3; i++) off = max2(off, fabs(vec3_dot(n, vec3_sub(b[i], a[0]))) / length);
    return off <= 1e-6;
}

static int try_flush_leaves(hunt *h, uint32_t place_a, uint32_t place_b) {
    uint32_t tried = 0, count_a = count_triangles(h->pair->a, place_a), count_b = count_triangles(h->pair->b, place_b);
    for (uint32_t i = 0; i < count_a; i++)
        for (uint32_t j = 0; j < count_b; j++) {
            vec3 a[3], b[3], middle;
            if (tried == LEAF_PAIRS || h->left == 0) return 0;
            get_triangle(h, 0, (leaf_triangle){place_a, i}, a);
            get_triangle(h, 1, (leaf_triangle){place_b, j}, b);
            if (!are_flush(a, b) || !find_common_middle(a, b, &middle)) continue;
            tried++;
            if (try_sides(h, middle, a)) return 1;
        }
    return 0;
}

static int try_flush(hunt *h, const flush_pairs *flush) {
    h->left = FLUSH_TRIES;
    for (uint32_t i = 0; i < flush->count; i++)
        if (try_flush_leaves(h, flush->pair[i].a, flush->pair[i].b)) return 1;
    return 0;
}

// ---- some triangles of each

static int is_in_room(const hunt *h, vec3 p) {
    vec3 d = vec3_sub(p, h->room.center);
    return fabs(d.x) <= h->room.half.x && fabs(d.y) <= h->room.half.y && fabs(d.z) <= h->room.half.z;
}

static int try_samples(hunt *h, int side) {
    const body_tree *tree = side ? h->pair->b : h->pair->a;
    h->left = SAMPLE_TRIES / 2;
    for (uint32_t i = 0; i < SAMPLES; i++) {
        uint32_t place = (uint32_t)((uint64_t)i * tree->count / SAMPLES), count = count_triangles(tree, place);
        vec3 t[3];
        double least;
        if (count == 0) continue;
        get_triangle(h, side, (leaf_triangle){place, i % count}, t);
        vec3 middle = find_middle(t, 3);
        if (!is_in_room(h, middle)) continue;
        if (try_point(h, middle, &least) || try_sides(h, middle, t)) return 1;
    }
    return 0;
}

// ---- boxes

typedef struct hunt_box {
    tree_box box;
    double bound; ///< the smaller clearance is nowhere in it larger
} hunt_box;

static int take_best(hunt_box *all, uint32_t *count, hunt_box *best) {
    uint32_t at = 0;
    if (*count == 0) return 0;
    for (uint32_t i = 1; i < *count; i++)
        if (all[i].bound > all[at].bound) at = i;
    *best = all[at];
    all[at] = all[--*count];
    return 1;
}

/// Across its longest side; 0 is the lower half.
static tree_box halve(const tree_box *b, int which) {
    tree_box half = *b;
    double *size = b->half.x >= b->half.y && b->half.x >= b->half.z ? &half.half.x
                   : b->half.y >= b->half.z                         ? &half.half.y
                                                                    : &half.half.z;
    double *center = size == &half.half.x ? &half.center.x : size == &half.half.y ? &half.center.y : &half.center.z;
    *size *= 0.5;
    *center += which ? *size : -*size;
    return half;
}

static int try_boxes(hunt *h) {
    hunt_box all[BOXES], w = {h->room, INFINITY};
    uint32_t count = 0;
    double least;
    h->left = BOX_TRIES;
    if (try_point(h, h->room.center, &least)) return 1;
    do {
        for (int i = 0; i < 2; i++) {
            hunt_box next = {.box = halve(&w.box, i)};
            if (try_point(h, next.box.center, &least)) return 1;
            next.bound = least + vec3_norm(next.box.half);
            if (next.bound > h->pair->frame->claim && count < BOXES) all[count++] = next;
        }
    } while (h->left > 1 && take_best(all, &count, &w));
    return 0;
}

// ---- all

static int has_inside(const body_tree *tree) {
    if (tree->solid) return tree->solid->report.is_closed;
    return tree->compound || tree->shape->rank == 3 || tree->shape->upper_radius > 0;
}

/// What both boxes have in common, in a's frame.
static int find_room(const framed_pair *pair, tree_box *room) {
    const tree_frame *f = pair->frame;
    tree_box a = body_tree_get_box(pair->a, body_tree_get_root(pair->a)),
             b = body_tree_get_box(pair->b, body_tree_get_root(pair->b));
    a.center = vec3_add(pair->a->center, a.center);
    b.center = vec3_add(vec3_add(pair->a->center, f->between), mat3_mul_vec3(f->to_a, b.center));
    b.half = mat3_mul_vec3(f->absolute_a, b.half);
    vec3 low_a = vec3_sub(a.center, a.half), low_b = vec3_sub(b.center, b.half);
    vec3 high_a = vec3_add(a.center, a.half), high_b = vec3_add(b.center, b.half);
    vec3 low = {max2(low_a.x, low_b.x), max2(low_a.y, low_b.y), max2(low_a.z, low_b.z)};
    vec3 high = {min2(high_a.x, high_b.x), min2(high_a.y, high_b.y), min2(high_a.z, high_b.z)};
    *room = (tree_box){vec3_scale(vec3_add(low, high), 0.5), vec3_scale(vec3_sub(high, low), 0.5)};
    return room->half.x >= 0 && room->half.y >= 0 && room->half.z >= 0;
}

int framed_pair_find_common_point(const framed_pair *pair, const flush_pairs *flush, common_point *found) {
    hunt h = {.pair = pair};
    if (!has_inside(pair->a) && !has_inside(pair->b)) return 0;
    if (!find_room(pair, &h.room)) return 0;
    int is = try_flush(&h, flush) || try_samples(&h, 0) || try_samples(&h, 1) ||
             (has_inside(pair->a) && has_inside(pair->b) && try_boxes(&h));
    *found = h.found;
    return is;
}
