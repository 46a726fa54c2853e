// Theorem. The difference B - A of two parallelepipeds is the set Z of all c + sum t_k g_k, |t_k| <= 1, of six segments
// g_k, three of each body: a zonotope (P. McMullen, On zonotopes, 1971). Each face of Z holds two segments that are not
// parallel, so its normal is that of a pair, g_i x g_j; and along any unit n, Z reaches from n.c - sum |n.g_k| to n.c +
// sum |n.g_k|. Hence the origin's depth in Z is the least of sum |n.g_k| - |n.c| over the normals of the 15 pairs,
// where none of these is negative. (For boxes these are the 15 axes of S. Gottschalk, M. C. Lin, D. Manocha, OBBTree: a
// hierarchical structure for rapid interference detection, 1996, who ask for a separating one.)
//
// Where no segment but its own two lies in a pair's plane, each face is a parallelogram, whose other four segments are
// at the ends that their signs say. Then the nearest face's foot has two unknown weights, and the faces make a closed
// surface of 32 differences and 60 triangles: the cover. Whoever checks that asks besides that each triangle has the
// origin behind it beyond rounding (pair/cover.h). That is asked here whether a cover is wanted or not, so that the
// answer is the same: of half a parallelogram of edges 2 u, 2 v the determinant is 4 |u x v| height, and the squares of
// its two edges are at most 12 (|u|^2 + |v|^2) together; with twice that for rounding 16 |u x v|^2 height^2 must be
// above 24 (|u|^2 + |v|^2) times the doubt.
//
// Errors, in parts of the pair's s (pair/frame.h), sum |g_k| + |c| <= 3 s: a posed corner is off by 91 u s, and the
// corners from centre and axes by less than 32 u s more: together half a claim. A normal is off by 7 u / sin of its
// pair's angle, which moves a height by less than 26 u s / sin, and heights are summed to 27 u s: 64 u s / sin in all
// (simd/box_axes.h). Both bounds are lowered by two claims on top of that, so that a measurement of the corners alone,
// as that of who checks, confirms them.
#include "exact/boxes.h"

#include "exact/closed.h"
#include "exact/cover_memory.h"
#include "pair/cover.h"
#include "simd/box_axes.h"

#include <string.h>

enum { COVER_POINTS = 32, COVER_TRIANGLES = 60, PATTERNS = 64 };

static const double sign_of[2] = {-1, 1};

static vec3 get_segment(const box_axes_query *q, uint32_t k) {
    return (vec3){q->segment[0][k], q->segment[1][k], q->segment[2][k]};
}

static void set_segment(box_axes_query *q, uint32_t k, vec3 g) {
    q->segment[0][k] = g.x;
    q->segment[1][k] = g.y;
    q->segment[2][k] = g.z;
}

static void make_query(const pair_frame *f, box_axes_query *q) {
    const parallelepiped *a = &f->a->box, *b = &f->b->box;
    for (uint32_t k = 0; k < 3; k++) {
        set_segment(q, k, a->axis[k]);
        set_segment(q, 3 + k, mat3_mul_vec3(f->rotation, b->axis[k]));
        q->segment[k][6] = q->segment[k][7] = 0;
    }
    vec3 c = vec3_sub(frame_b(f, b->center), a->center);
    q->center[0] = c.x;
    q->center[1] = c.y;
    q->center[2] = c.z;
    q->error = 64 * 0x1p-53 * f->size;
    q->doubt = 1.5 * triangle_compute_doubt(f->size, f->claim);
}

// The pair of the least height, lowered by its error; of several the first.
static uint32_t find_nearest(const box_axes *axes) {
    uint32_t nearest = 0;
    for (uint32_t i = 1; i < BOX_AXES_PAIRS; i++)
        if (axes->height[i] - axes->error[i] < axes->height[nearest] - axes->error[nearest]) nearest = i;
    return nearest;
}

// The ends of the segments, as bits, of the face of a pair that looks along its normal (side 1) or against it (0);
// those of its own segments are 0.
static uint32_t find_face(const box_axes *axes, uint32_t pair, int side) {
    uint32_t ends = 0;
    for (uint32_t k = 0; k < BOX_AXES_SEGMENTS; k++)
        if ((int)(axes->positive[k] >> pair & 1) == side) ends |= 1u << k;
    return ends & ~(1u << box_axes_first[pair] | 1u << box_axes_second[pair]);
}

// A corner of Z by its ends. A's segments are turned: where theirs are at +1, A is at the end of -1.
static difference get_corner(const pair_frame *f, const box_axes_query *q, uint32_t ends) {
    vec3 w = {q->center[0], q->center[1], q->center[2]};
    for (uint32_t k = 0; k < BOX_AXES_SEGMENTS; k++) w = vec3_add_scaled(w, get_segment(q, k), sign_of[ends >> k & 1]);
    return (difference){w, f->a->box.corner[~ends & 7], f->b->box.corner[ends >> 3]};
}

// The foot of the origin on the nearest face, which looks toward `outward`, as three of the face's corners. 0 if it is
// not in the face, to rounding.
static int find_foot(const pair_frame *f, const box_axes_query *q, uint32_t pair, uint32_t face, vec3 foot,
                     evidence *found) {
    uint32_t i = box_axes_first[pair], j = box_axes_second[pair];
    vec3 u = get_segment(q, i), v = get_segment(q, j), n = vec3_cross(u, v);
    vec3 low = get_corner(f, q, face).w, to = vec3_sub(foot, vec3_add(low, vec3_add(u, v)));
    double scale = 1 / vec3_norm_squared(n);
    // The foot is the face's middle + s u + t v.
    double s = vec3_dot(vec3_cross(to, v), n) * scale, t = vec3_dot(vec3_cross(u, to), n) * scale;
    if (!(fabs(s) <= 1 && fabs(t) <= 1)) return 0;
    uint32_t from = face_set_weights(s, t, found) ? face | 1u << i | 1u << j : face;
    found->p[0] = get_corner(f, q, from);
    found->p[1] = get_corner(f, q, from ^ 1u << i);
    found->p[2] = get_corner(f, q, from ^ 1u << j);
    vec3 off = vec3_neg(foot);
    for (int k = 0; k < 3; k++) off = vec3_add_scaled(off, found->p[k].w, found->weight[k]);
    return vec3_norm(off) <= f->claim;
}

// ---- boxes that an axis separates

// The unit vectors of a box's edges in the world, by rows; turned: room for them.
static inline const double *turn_edges(const parallelepiped *box, const mat3 *turn, mat3 *turned) {
    if (box->is_upright) return &turn->r0.x;
    vec3 x = mat3_mul_vec3(*turn, box->unit[0]), y = mat3_mul_vec3(*turn, box->unit[1]),
         z = mat3_mul_vec3(*turn, box->unit[2]);
    *turned = (mat3){{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}};
    return &turned->r0.x;
}

// What the gap of boxes is off beyond that of a box and a segment (docs/error-analysis.md).
#define BOXES_CLAIM (16 * 0x1p-53)

int boxes_separate(const placed_query *query, small_end *end) {
    const pair_frame *f = query->frame;
    const parallelepiped *box_a = &f->a->box, *box_b = &f->b->box;
    mat3 turned_a, turned_b;
    box_separation found;
    if (!closed_is_moderate(f)) return 0;
    const box_separation_query q = {turn_edges(box_a, &f->world, &turned_a),
                                    turn_edges(box_b, &f->world_b, &turned_b),
                                    box_a->half,
                                    box_b->half,
                                    frame_world_difference(f, box_a->center, box_b->center),
                                    query->goal->far + f->lower_radii};
    if (!box_separation_find(&q, &found)) return 0;
    double claim = reject_get_claim(f);
    end->lower = found.gap - f->lower_radii - (claim + BOXES_CLAIM * f->size);
    if (!(end->lower > query->goal->far)) return 0;
    uint32_t a = box_a->corner[found.high_a], b = box_b->corner[found.low_b];
    vec3 w = frame_world_difference(f, vec3_at(shape_vertices(f->a), a), vec3_at(shape_vertices(f->b), b));
    end->upper = vec3_norm(w) - f->upper_radii + claim;
    end->normal = vec3_clear_signs(found.n);
    small_end_set_corner(end, w, a, b);
    end->stage = OVOID_STAGE_SUPPORT;
    end->iterations = 0;
    return 1;
}

// ---- the cover

typedef struct builder {
    const pair_frame *frame;
    const box_axes_query *query;
    cover_arrays *cover;
    uint32_t point_count, triangle_count;
    vec3 w[COVER_POINTS];
    uint8_t point_of[PATTERNS]; ///< 1 + the point; 0: none yet
} builder;

// The index of a corner; COVER_POINTS if there are too many.
static uint32_t add_point(builder *b, uint32_t ends) {
    cover_arrays *c = b->cover;
    if (b->point_of[ends]) return b->point_of[ends] - 1u;
    if (b->point_count == COVER_POINTS) return COVER_POINTS;
    uint32_t at = b->point_count++;
    difference vertex = get_corner(b->frame, b->query, ends);
    b->w[at] = frame_difference(b->frame, vertex.a, vertex.b);
    c->a[at] = vertex.a;
    c->b[at] = vertex.b;
    b->point_of[ends] = (uint8_t)(at + 1);
    return at;
}

// Two triangles, counter-clockwise from outside.
static int add_face(builder *b, const box_axes *axes, uint32_t pair, int side) {
    uint32_t i = 1u << box_axes_first[pair], j = 1u << box_axes_second[pair], face = find_face(axes, pair, side);
    uint32_t ring[4] = {face, face | (side ? i : j), face | i | j, face | (side ? j : i)}, v[4];
    for (int k = 0; k < 4; k++)
        if ((v[k] = add_point(b, ring[k])) == COVER_POINTS) return 0;
    for (int k = 1; k < 3; k++) {
        uint16_t *triangle = b->cover->triangles[b->triangle_count++];
        triangle[0] = (uint16_t)v[0];
        triangle[1] = (uint16_t)v[k];
        triangle[2] = (uint16_t)v[k + 1];
    }
    return 1;
}

// All faces, the nearest pair's first. 0 if they do not show the depth.
static int build_cover(const pair_frame *f, const box_axes_query *q, const box_axes *axes, uint32_t nearest,
                       double depth, ovoid_cover *cover) {
    builder b = {.frame = f, .query = q, .cover = cover_get_arrays(cover)};
    for (uint32_t i = 0; i < BOX_AXES_PAIRS; i++) {
        uint32_t pair = (nearest + i) % BOX_AXES_PAIRS;
        int near = !(axes->along[pair] >= 0);
        if (!add_face(&b, axes, pair, near) || !add_face(&b, axes, pair, !near)) return 0;
    }
    cover_show_arrays(cover, b.point_count, b.triangle_count);
    surface all = surface_make(b.w, cover->point_count, cover->triangles, cover->triangle_count);
    return surface_is_closed(&all) && surface_compute_depth(&all, f->claim) >= depth;
}

// ---- the depth

static int is_for_here(const search *s) {
    const pair_frame *f = s->frame;
    return f->a->box.is_present && f->b->box.is_present && f->size > 0x1p-100 && f->size < 0x1p100;
}

int boxes_take_depth(search *s, ovoid_cover *cover) {
    const pair_frame *f = s->frame;
    box_axes_query q;
    box_axes axes;
    if (!is_for_here(s)) return 0;
    make_query(f, &q);
    if (!box_axes_find(&q, &axes)) return 0;
    uint32_t pair = find_nearest(&axes);
    double slack = axes.error[pair] + 2 * f->claim, depth = axes.height[pair] - slack;
    // The direction from A to B along which Z is nearest behind the origin.
    int is_along = axes.along[pair] >= 0;
    vec3 n = {axes.n[0][pair], axes.n[1][pair], axes.n[2][pair]}, normal = is_along ? n : vec3_neg(n);
    const search_depth found = {-axes.height[pair] - slack - f->lower_radii, -depth - f->upper_radii, normal,
                                OVOID_STAGE_EPA};
    if (!(depth > 0) || !search_needs_depth(s, &found)) return 0;
    evidence foot;
    if (!find_foot(f, &q, pair, find_face(&axes, pair, !is_along), vec3_scale(normal, -axes.height[pair]), &foot))
        return 0;
    if (search_wants_cover(s, cover, found.upper) && !build_cover(f, &q, &axes, pair, depth, cover)) {
        cover_clear(cover);
        return 0;
    }
    search_take_depth(s, &found, &foot);
    return 1;
}
