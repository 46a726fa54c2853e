// Theorem. Let a point have the clearance r in one body and s in another (clearance.h), r + s > 0. Then no translation
// shorter than r + s parts the bodies, so d <= -(r + s). Proof: where both are above 0, the balls of radius r and s
// around the point and around the point as translated still overlap. Where s <= 0, the second body has a point at a
// distance of at most -s, which is translated by less than r + s, hence stays within the ball of radius r.
//
// In a closed solid the ball around a point that the surface winds around covers nothing else up to the surface. A
// convex shape is taken by the triangles of its hull: what these wind around is in the hull. Of a compound the best
// part counts; it lies in the union.
//
// The distance to a triangle is shown from both sides: its nearest point, a convex combination of the corners, is no
// nearer than the triangle; and the least corner along the unit vector toward that point is no farther.
#include "body/clearance.h"

#include "linear/rotation.h"
#include "pair/simplex.h"
#include "polytope/winding.h"

/// The distance of a point to some triangles.
typedef struct range {
    double lower, upper;
} range;

static void take_triangle(range *r, vec3 p, const vec3 corner[3]) {
    simplex s = {.count = 3};
    vec3 w[3];
    for (int i = 0; i < 3; i++) s.p[i].w = w[i] = vec3_sub(corner[i], p);
    vec3 n = simplex_reduce(&s);
    double least = min2(vec3_dot(n, w[0]), min2(vec3_dot(n, w[1]), vec3_dot(n, w[2])));
    r->lower = min2(r->lower, max2(least, 0));
    r->upper = min2(r->upper, vec3_norm(simplex_compute_point(&s)));
}

static double get_signed(const range *r, int is_inside) { return is_inside ? r->lower : -r->upper; }

// ---- solids

typedef struct near_node {
    uint32_t node;
    double square; ///< of the distance to its box, in the tree's unit
} near_node;

static double find_lane_square(const box8 *b, uint32_t i, const double p[3]) {
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        double low = b->low[k][i] - p[k], high = p[k] - b->high[k][i], out = max2(max2(low, high), 0);
        sum += out * out;
    }
    return sum;
}

static void take_corners(range *r, const ovoid_solid *s, uint32_t place, vec3 p) {
    const vec3 corner[3] = {solid_get_corner(s, place, 0), solid_get_corner(s, place, 1),
                            solid_get_corner(s, place, 2)};
    take_triangle(r, p, corner);
}

// The nearest box first; a box is rounded outward by more than its distance is off.
static range find_nearest(const ovoid_solid *s, vec3 point) {
    range r = {INFINITY, INFINITY};
    vec3 in = vec3_scale(vec3_sub(point, s->center), 1 / s->unit);
    const double p[3] = {in.x, in.y, in.z};
    near_node stack[SOLID_DEPTH_MAX * BOX8] = {{0, 0}};
    for (uint32_t count = 1; count > 0;) {
        near_node w = stack[--count];
        double enough = r.lower / s->unit;
        if (w.square >= enough * enough) continue;
        const box8 *b = &s->boxes[w.node];
        uint32_t first = count;
        for (uint32_t i = 0; i < s->nodes[w.node].children; i++) {
            double square = find_lane_square(b, i, p);
            if (square >= enough * enough) continue;
            if (b->leaves >> i & 1) {
                take_corners(&r, s, b->child[i], point);
                continue;
            }
            uint32_t at = count++;
            for (; at > first && stack[at - 1].square < square; at--) stack[at] = stack[at - 1];
            stack[at] = (near_node){b->child[i], square};
        }
    }
    return r;
}

static double find_in_solid(const ovoid_solid *s, vec3 point, int linear) {
    range r = {INFINITY, INFINITY};
    int64_t winding = 0;
    if (!linear) r = find_nearest(s, point);
    for (uint32_t i = 0; i < s->triangle_count && linear; i++) take_corners(&r, s, i, point);
    int is_known = s->report.is_closed && solid_find_winding(s, point, linear, &winding);
    return get_signed(&r, is_known && winding != 0);
}

// ---- shapes

// point: in the user's local frame. A point or a segment has no triangles.
static double find_in_shape(const ovoid_shape *s, vec3 point) {
    range r = {INFINITY, INFINITY};
    ovoid_polytope p = ovoid_shape_get_polytope(s);
    point = vec3_sub(point, p.origin);
    for (uint32_t t = 0; t < p.triangle_count; t++) {
        const uint32_t *v = p.triangles + 3 * (size_t)t;
        const vec3 corner[3] = {vec3_at(p.vertices, v[0]), vec3_at(p.vertices, v[1]), vec3_at(p.vertices, v[2])};
        take_triangle(&r, point, corner);
    }
    if (p.triangle_count == 0) {
        vec3 first = vec3_at(p.vertices, 0), last = vec3_at(p.vertices, p.vertex_count - 1);
        const vec3 corner[3] = {first, last, last};
        take_triangle(&r, point, corner);
    }
    int is_inside = p.rank == 3 && r.lower > 0 && polytope_compute_winding(&p, point) != 0;
    return get_signed(&r, is_inside) + s->upper_radius;
}

// ---- bodies

// From a's frame to that of a pose, by the world's difference.
static vec3 bring_to_pose(const framed_pair *f, vec3 point, const ovoid_pose *pose) {
    vec3 offset = vec3_sub(f->a->pose->position, pose->position);
    vec3 from = vec3_add(mat3_mul_vec3(f->frame->world, point), offset);
    return mat3_mul_transposed_vec3(quat_to_mat3(pose->rotation), from);
}

// Parts whose ball is farther than the best clearance are passed over, which can only lower it.
static double find_in_compound(const framed_pair *f, const body_tree *tree, vec3 point, vec3 in) {
    double best = -INFINITY;
    for (uint32_t place = 0; place < tree->count; place++) {
        const compound_part *part = &tree->compound->parts[place];
        if (part->reach - vec3_norm(vec3_sub(in, part->center)) <= best && best <= 0) continue;
        ovoid_posed_shape leaf = body_tree_get_leaf(tree, place, NULL);
        best = max2(best, find_in_shape(leaf.shape, bring_to_pose(f, point, &leaf.pose)));
    }
    return best;
}

double framed_pair_find_clearance(const framed_pair *f, int side, vec3 point, int linear) {
    const body_tree *tree = side ? f->b : f->a;
    vec3 in = side ? bring_to_pose(f, point, tree->pose) : point;
    return tree->solid      ? find_in_solid(tree->solid, in, linear)
           : tree->compound ? find_in_compound(f, tree, point, in)
                            : find_in_shape(tree->shape, in);
}
