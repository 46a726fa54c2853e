// Theorem. The difference B - A of a box and a point is a box, and so is that of a box and a segment along one of its
// edges, which is longer by the segment. The origin's depth in a box is the least way to a face.
//
// The lower bound is the gap of the supports along that face's normal, as in any search. The upper bound's proof is the
// surface of the difference, eight points and twelve triangles: the cover (pair/cover.h). Errors, in parts of the
// pair's s, are those of two boxes (exact/boxes.c): corners to half a claim, and half a claim more where an edge and
// the segment are parallel to 2^-46 only; heights to 64 u s, since the normals are at right angles. The depth is
// lowered by three claims on top of that, so that a measurement of the corners alone confirms it; and each triangle
// must have the origin behind it beyond rounding, whether a cover is wanted or not, so that the answer is the same.
#include "exact/inside.h"

#include "exact/boxes.h"
#include "exact/closed.h"
#include "exact/cover_memory.h"
#include "pair/cover.h"

enum { CORNERS = 8, TRIANGLES = 12 };

// The difference as center + sum t_k axis_k, |t_k| <= 1, in the frame.
typedef struct difference_box {
    const pair_frame *frame;
    vec3 center, axis[3];
    int is_box_a;
    int along;    ///< the axis along which the segment is; 3: it is a point
    int is_other; ///< the segment's second vertex is opposite to the axis
} difference_box;

// The axis along which a segment's half length e is; 3: a point; -1: another direction.
static int find_along(const difference_box *d, vec3 e) {
    double square = vec3_norm_squared(e);
    if (!(square > 0)) return 3;
    for (int k = 0; k < 3; k++) {
        double most = 0x1p-92 * (square * vec3_norm_squared(d->axis[k]));
        if (vec3_norm_squared(vec3_cross(e, d->axis[k])) <= most) return k;
    }
    return -1;
}

// 0: the shapes are others.
static int make_difference(const pair_frame *f, difference_box *d) {
    int is_box_a = f->a->vertex_count == 8;
    const ovoid_shape *box = is_box_a ? f->a : f->b, *thin = is_box_a ? f->b : f->a;
    if (!(box->vertex_count == 8 && box->box.is_right && thin->vertex_count <= 2)) return 0;
    if (!(f->size > 0x1p-100 && f->size < 0x1p100)) return 0;
    vec3 middle = closed_get_middle(thin), e = closed_get_half(thin), center = box->box.center;
    d->frame = f;
    d->is_box_a = is_box_a;
    d->center = is_box_a ? vec3_sub(frame_b(f, middle), center) : vec3_sub(frame_b(f, center), middle);
    if (is_box_a) e = mat3_mul_vec3(f->rotation, e);
    for (int k = 0; k < 3; k++) d->axis[k] = is_box_a ? box->box.axis[k] : mat3_mul_vec3(f->rotation, box->box.axis[k]);
    d->along = find_along(d, e);
    if (d->along < 0) return 0;
    if (d->along == 3) return 1;
    d->is_other = vec3_dot(e, d->axis[d->along]) < 0;
    d->axis[d->along] = vec3_add(d->axis[d->along], d->is_other ? vec3_neg(e) : e);
    return 1;
}

// The corner whose coefficient of axis k is positive where bit k is set. A's part of a difference is turned.
static difference get_corner(const difference_box *d, unsigned bits) {
    const pair_frame *f = d->frame;
    unsigned end = d->along < 3 ? (bits >> d->along & 1) ^ (unsigned)d->is_other : 0;
    if (d->along < 3 && !d->is_box_a) end ^= 1;
    uint32_t a = d->is_box_a ? f->a->box.corner[~bits & 7] : end, b = d->is_box_a ? end : f->b->box.corner[bits];
    return (difference){frame_difference(f, a, b), a, b};
}

// Both triangles of each face, counter-clockwise from outside.
static void set_triangles(const difference_box *d, uint16_t (*triangles)[3]) {
    int is_left = vec3_dot(vec3_cross(d->axis[0], d->axis[1]), d->axis[2]) < 0;
    for (int face = 0; face < 6; face++) {
        int i = face >> 1, j = (i + 1) % 3, k = (i + 2) % 3, is_high = face & 1, is_turned = is_left == is_high;
        unsigned corner = is_high ? 1u << i : 0, u = 1u << (is_turned ? k : j), v = 1u << (is_turned ? j : k);
        const unsigned ring[4] = {corner, corner | u, corner | u | v, corner | v};
        for (int half = 0; half < 2; half++)
            for (int n = 0; n < 3; n++) triangles[2 * face + half][n] = (uint16_t)ring[n == 0 ? 0 : half + n];
    }
}

// The nearest face: its axis, the height of the origin below it, and the unit normal from A to B along which the
// difference is nearest behind the origin; of several the first. 0: some triangle may not have the origin behind it.
typedef struct nearest_face {
    int axis;
    double height;
    vec3 normal;
} nearest_face;

static int find_nearest(const difference_box *d, nearest_face *found) {
    const pair_frame *f = d->frame;
    double doubt = 1.5 * triangle_compute_doubt(f->size, f->claim), square[3];
    found->height = INFINITY;
    for (int k = 0; k < 3; k++) square[k] = vec3_norm_squared(d->axis[k]);
    for (int k = 0; k < 3; k++) {
        vec3 n = vec3_unit(d->axis[k]);
        double along = vec3_dot(n, d->center), height = vec3_dot(n, d->axis[k]) - fabs(along);
        double u = square[(k + 1) % 3], v = square[(k + 2) % 3];
        if (!(height > 0 && 16 * (u * v) * (height * height) > 24 * (u + v) * doubt)) return 0;
        if (!(height < found->height)) continue;
        *found = (nearest_face){k, height, along < 0 ? vec3_neg(n) : n};
    }
    return 1;
}

// The origin's foot on that face, in one of its triangles.
static evidence find_foot(const difference_box *d, const nearest_face *face) {
    int i = face->axis, j = (i + 1) % 3, k = (i + 2) % 3;
    double s = -vec3_dot(d->center, d->axis[j]) / vec3_norm_squared(d->axis[j]),
           t = -vec3_dot(d->center, d->axis[k]) / vec3_norm_squared(d->axis[k]);
    unsigned low = vec3_dot(face->normal, d->axis[i]) < 0 ? 1u << i : 0, all = 1u << j | 1u << k;
    evidence foot;
    unsigned from = face_set_weights(s, t, &foot) ? low | all : low;
    foot.p[0] = get_corner(d, from);
    foot.p[1] = get_corner(d, from ^ 1u << j);
    foot.p[2] = get_corner(d, from ^ 1u << k);
    return foot;
}

static void write_cover(const difference_box *d, ovoid_cover *cover) {
    cover_arrays *to = cover_get_arrays(cover);
    for (unsigned bits = 0; bits < CORNERS; bits++) {
        difference corner = get_corner(d, bits);
        to->a[bits] = corner.a;
        to->b[bits] = corner.b;
    }
    set_triangles(d, to->triangles);
    cover_show_arrays(cover, CORNERS, TRIANGLES);
}

int inside_take_depth(search *s, ovoid_cover *cover) {
    const pair_frame *f = s->frame;
    difference_box d;
    nearest_face face;
    if (!make_difference(f, &d) || !find_nearest(&d, &face)) return 0;
    double depth = face.height - (3 * f->claim + 64 * 0x1p-53 * f->size);
    const search_depth found = {frame_find_support(f, face.normal).gap - f->lower_radii - f->claim,
                                -depth - f->upper_radii, face.normal, OVOID_STAGE_SUPPORT};
    if (!(depth > 0) || !search_needs_depth(s, &found)) return 0;
    const evidence foot = find_foot(&d, &face);
    search_take_depth(s, &found, &foot);
    if (search_wants_cover(s, cover, found.upper)) write_cover(&d, cover);
    return 1;
}
