// Queries of swept spheres (ovoid/swept.h): closed forms without shapes, frames and proofs. Of a point and another core
// the point's coordinates along the other one's axes, cut off at its ends, of a cylinder and a cone in the plane of
// axis and point; of segments, and of a box and a segment, the nearest points of linear/nearest.h; of two boxes the
// separating axes. Other pairs are searched (query/swept/approach.h).
//
// Errors, in parts u s, u = 2^-53, s the sum of both bodies' reaches and radii and of the distance of the centres. The
// axes are numbers that are given, so nothing is turned, and what is measured in the world (pair/reject.h, off by less
// than 60 u s) bounds that: the gap along any unit normal bounds the distance from below, and two points of the cores
// bound it from above, whatever the angles of the axes. Axes whose products are off by 32 u together are those of a
// rotation to 32 u in norm, which moves no point of a core by more than 32 u s: what is read as if they were at right
// angles, the reach of a box, the distance of a point and a core, and two boxes, is off by that and the roundings of
// its sums, less than 60 u s again. All bounds are widened by FRAME_REJECT, 384 u s.
//
// Two boxes are apart exactly where one of 15 axes separates them (S. Gottschalk, M. C. Lin, D. Manocha, OBBTree: a
// hierarchical structure for rapid interference detection, 1996): the six axes a_i, b_j, and a_i x b_j. All gaps are
// off by less than 200 u s. An axis decides where its gap is beyond SAT_DOUBT s on either side of zero; that of a cross
// product is not divided by its length, at most 1, which makes it decide less. Of edges that are parallel to
// SAT_PARALLEL the cross product is no axis: were all such edges turned parallel, which moves no point by more than 4
// SAT_PARALLEL s, it would be zero and the other axes would decide, whose gaps change by less than 8 SAT_PARALLEL s;
// and boxes that overlap by more than a movement overlap without it. Both are covered by SAT_DOUBT.
#include "ovoid/swept.h"
#include "base/compiler.h"
#include "base/environment.h"
#include "query/swept/approach.h"
#include "query/swept/overlap.h"

#define SAT_DOUBT 0x1p-34
#define SAT_PARALLEL 0x1p-40

// ---- two boxes

// Of the axes so far: one separates the boxes; one leaves it open.
typedef struct axes_found {
    int is_apart, is_open;
} axes_found;

static inline void take_axis(double gap, double doubt, axes_found *found) {
    found->is_apart |= gap > doubt;
    found->is_open |= !(gap < -doubt);
}

// The gaps along the boxes' own axes. c: the products of A's and B's axes, without signs.
static inline void take_faces(const swept_placed *of, double c[3][3], double doubt, axes_found *found) {
    const double *a = of->a->half, *b = of->b->half;
    for (int i = 0; i < 3; i++) {
        double of_b = (b[0] * c[i][0] + b[1] * c[i][1]) + b[2] * c[i][2],
               of_a = (a[0] * c[0][i] + a[1] * c[1][i]) + a[2] * c[2][i];
        take_axis(fabs(vec3_dot(of->a->axis[i], of->d)) - a[i] - of_b, doubt, found);
        take_axis(fabs(vec3_dot(of->b->axis[i], of->d)) - b[i] - of_a, doubt, found);
    }
}

static int is_parallel(vec3 a, vec3 b) { return vec3_norm_squared(vec3_cross(a, b)) < SAT_PARALLEL * SAT_PARALLEL; }

// The gaps along the cross products of A's axis i and B's axes.
static inline void take_edges(const swept_placed *of, double c[3][3], int i, double doubt, axes_found *found) {
    static const int next[5] = {0, 1, 2, 0, 1};
    const double *a = of->a->half, *b = of->b->half;
    int k = next[i + 1], m = next[i + 2];
    vec3 across = vec3_cross(of->d, of->a->axis[i]);
    for (int j = 0; j < 3; j++) {
        int p = next[j + 1], q = next[j + 2];
        double of_a = c[m][j] * a[k] + c[k][j] * a[m], of_b = c[i][q] * b[p] + c[i][p] * b[q];
        double gap = fabs(vec3_dot(across, of->b->axis[j])) - of_a - of_b;
        axes_found here = {0, 0};
        take_axis(gap, doubt, &here);
        if (here.is_open && !here.is_apart && is_parallel(of->a->axis[i], of->b->axis[j])) here.is_open = 0;
        found->is_apart |= here.is_apart;
        found->is_open |= here.is_open;
    }
}

// Of two boxes without radii the sign alone: with radii they may be apart or not between the axes.
COMPILER_NOINLINE static ovoid_verdict separate_boxes(const swept_placed *p) {
    double c[3][3], doubt = SAT_DOUBT * p->size;
    axes_found found = {0, 0};
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) c[i][j] = fabs(vec3_dot(p->a->axis[i], p->b->axis[j]));
    take_faces(p, c, doubt, &found);
    for (int i = 0; i < 3 && !found.is_apart && !found.is_open; i++) take_edges(p, c, i, doubt, &found);
    if (found.is_apart) return swept_make_verdict(p->claim, p->far + p->claim, 0);
    if (found.is_open) return swept_undecided;
    return swept_make_verdict(-p->size, -p->claim, 0);
}

// ---- two points

// Both radii go along the line of the points; 0 where it is none to rounding.
COMPILER_INLINED int measure_points(ovoid_swept_pair pair, ovoid_witness *witness, ovoid_verdict *to) {
    const swept *a = pair.a, *b = pair.b;
    vec3 d = vec3_sub(b->center, a->center);
    double distance = vec3_norm(d), gap = distance - (a->radius + b->radius), size = distance + (a->radius + b->radius),
           claim = FRAME_REJECT * size;
    if (!((distance > LEAST) & (size < MOST) & (a->radius >= 0) & (b->radius >= 0))) return 0;
    *to = swept_make_verdict(gap - claim, gap + claim, TOLERANCE * size);
    if (!witness) return 1;
    vec3 n = vec3_scale(d, 1 / distance);
    witness->normal = vec3_clear_signs(n);
    witness->point_a = vec3_clear_signs(vec3_add_scaled(a->center, n, a->radius));
    witness->point_b = vec3_clear_signs(vec3_add_scaled(b->center, n, -b->radius));
    return 1;
}

// ---- a point and another core

// The core's point is the point less the gap along the normal, which goes to it from the core.
static void write_points(const swept_placed *p, vec3 normal, double gap, ovoid_witness *to) {
    int is_point_b = p->b->core == 0;
    const swept *point = is_point_b ? p->b : p->a, *core = is_point_b ? p->a : p->b;
    vec3 on_point = vec3_add_scaled(point->center, normal, -point->radius),
         on_core = vec3_add_scaled(point->center, normal, core->radius - gap);
    to->normal = vec3_clear_signs(is_point_b ? normal : vec3_neg(normal));
    to->point_a = vec3_clear_signs(is_point_b ? on_core : on_point);
    to->point_b = vec3_clear_signs(is_point_b ? on_point : on_core);
}

// 0 if the point is so near to the core's surface or axis that no direction has digits, and more than the sign is asked
// for where it has none here.
COMPILER_INLINED int measure_point(const swept_placed *p, swept_question asked, ovoid_witness *witness,
                                   ovoid_verdict *to) {
    int is_point_b = p->b->core == OVOID_SWEPT_POINT;
    const swept *core = is_point_b ? p->a : p->b;
    swept_way_out out = swept_leave_core(core, is_point_b ? p->d : vec3_neg(p->d));
    double gap = out.is_inside ? -out.depth : out.distance;
    if (asked == OF_SIGN) {
        // A point that is not seen to be outside may be deep inside.
        double lower = out.is_inside || gap > p->claim ? gap - p->radii - p->claim : -p->size;
        *to = swept_make_verdict(lower, gap - p->radii + p->claim, TOLERANCE * p->size);
        return to->status != OVOID_UNDECIDED;
    }
    if (!out.is_inside && !(gap > 0x1p-20 * p->size)) return 0;
    *to = swept_make_verdict(gap - p->radii - p->claim, gap - p->radii + p->claim, TOLERANCE * p->size);
    if (witness) write_points(p, out.is_inside ? out.off : vec3_scale(out.off, 1 / gap), gap, witness);
    return 1;
}

// ---- two segments

static inline double cut_off(double t, double h) { return max2(-h, min2(h, t)); }

// By the parameters s and t along the unit axes (V. J. Lumelsky, On fast computation of distance between line segments,
// 1985): those of the lines' nearest points, cut off one after the other. 0 where the segments are nearly parallel or
// cross, which linear/nearest.h knows to take apart.
COMPILER_INLINED int measure_segments(const swept_placed *p, swept_question asked, ovoid_witness *witness,
                                      ovoid_verdict *to) {
    vec3 u = p->a->axis[0], v = p->b->axis[0];
    double h = p->a->half[0], k = p->b->half[0];
    double uv = vec3_dot(u, v), ud = vec3_dot(u, p->d), vd = vec3_dot(v, p->d), det = 1 - uv * uv;
    double t = cut_off(cut_off((ud - uv * vd) * (1 / det), h) * uv - vd, k), s = cut_off(ud + t * uv, h);
    vec3 w = vec3_add_scaled(vec3_add_scaled(p->d, v, t), u, -s);
    double square = vec3_norm_squared(w);
    if (!((det > 0x1p-20) & (square > 0x1p-16 * (p->size * p->size)))) return 0;
    double distance = sqrt(square), scale = 1 / distance, tolerance = TOLERANCE * p->size;
    nearest_pair found = {.point_a = vec3_scale(u, s), .difference = w, .normal = vec3_scale(w, scale)};
    found.gap = (vec3_dot(w, p->d) - h * fabs(vec3_dot(w, u)) - k * fabs(vec3_dot(w, v))) * scale;
    *to = swept_conclude(p, asked, &found, distance, tolerance);
    if (to->status == OVOID_UNDECIDED) return 0;
    if (witness) swept_write_witness(p, &found, found.normal, witness);
    return 1;
}

// ---- other pairs

// The half axes of a segment or a box.
static inline nearest_core scale_axes(const swept *s, vec3 *axes) {
    axes[0] = vec3_scale(s->axis[0], s->half[0]);
    if (s->core == OVOID_SWEPT_SEGMENT) return (nearest_core){1, axes};
    axes[1] = vec3_scale(s->axis[1], s->half[1]);
    axes[2] = vec3_scale(s->axis[2], s->half[2]);
    return (nearest_core){3, axes};
}

COMPILER_NOINLINE static ovoid_verdict measure_nearest(const swept_placed *p, swept_question asked,
                                                       ovoid_witness *witness) {
    vec3 axes_a[3], axes_b[3];
    const nearest_core a = scale_axes(p->a, axes_a), b = scale_axes(p->b, axes_b);
    nearest_pair found;
    nearest_find(&a, &b, p->d, &found);
    ovoid_verdict v = swept_answer(p, asked, &found, TOLERANCE * p->size, witness);
    return v.status == OVOID_UNDECIDED && asked & OF_CONTACT ? swept_measure_overlap(p, witness) : v;
}

// Searches of directions that are no numbers would read beside the points. A segment, a cylinder and a cone have one
// axis.
static inline int has_finite_axes(const swept *s) {
    const uint32_t count = s->core == OVOID_SWEPT_POINT                                     ? 0
                           : s->core == OVOID_SWEPT_BOX || s->core >= OVOID_SWEPT_ELLIPSOID ? 3
                                                                                            : 1;
    double zero = 0;
    for (uint32_t k = 0; k < count; k++) zero += swept_show_finite(s->axis[k]);
    return zero == 0;
}

static inline int has_half_axes(unsigned core) { return core == OVOID_SWEPT_SEGMENT || core == OVOID_SWEPT_BOX; }

COMPILER_INLINED ovoid_verdict find(ovoid_swept_pair pair, swept_question asked, ovoid_witness *witness) {
    ovoid_verdict v;
    unsigned a = pair.a->core, b = pair.b->core;
    if ((a | b) == OVOID_SWEPT_POINT) return measure_points(pair, witness, &v) ? v : swept_undecided;
    swept_placed p = swept_place(pair.a, pair.b);
    if (!swept_is_moderate(&p)) return swept_undecided;
    double gap = p.distance - p.reach - p.radii - p.claim;
    if (!(asked & OF_DISTANCE) && gap > 0) return swept_make_verdict(gap, p.far - p.radii + p.claim, 0);
    int is_ellipsoid_or_points = a >= OVOID_SWEPT_ELLIPSOID || b >= OVOID_SWEPT_ELLIPSOID;
    if (!is_ellipsoid_or_points && (a == OVOID_SWEPT_POINT || b == OVOID_SWEPT_POINT))
        return measure_point(&p, asked, witness, &v) ? v : swept_undecided;
    if ((a == OVOID_SWEPT_SEGMENT) & (b == OVOID_SWEPT_SEGMENT) && measure_segments(&p, asked, witness, &v)) return v;
    if (!has_finite_axes(pair.a) || !has_finite_axes(pair.b)) return swept_undecided;
    // Functions that are not inline get a copy, so that the closed forms before this have the pair in registers.
    const swept_placed shared = p;
    if ((a == OVOID_SWEPT_BOX) & (b == OVOID_SWEPT_BOX) & !(p.radii > 0) & !(asked & OF_DISTANCE)) {
        v = separate_boxes(&shared);
        return asked & OF_CONTACT && v.status != OVOID_SEPARATED ? swept_measure_overlap(&shared, witness) : v;
    }
    if ((a == OVOID_SWEPT_SEGMENT && has_half_axes(b)) || (a == OVOID_SWEPT_BOX && b == OVOID_SWEPT_SEGMENT))
        return measure_nearest(&shared, asked, witness);
    return swept_approach(&shared, asked, witness);
}

// One for each question, so that none does what another one needs.
COMPILER_NOINLINE static ovoid_verdict find_sign(ovoid_swept_pair pair) { return find(pair, OF_SIGN, NULL); }
COMPILER_NOINLINE static ovoid_verdict find_distance(ovoid_swept_pair pair, ovoid_witness *witness) {
    return find(pair, OF_DISTANCE, witness);
}
COMPILER_NOINLINE static ovoid_verdict find_contact(ovoid_swept_pair pair, ovoid_witness *witness) {
    return find(pair, OF_CONTACT, witness);
}
COMPILER_NOINLINE static ovoid_verdict find_depth(ovoid_swept_pair pair, ovoid_witness *witness) {
    return find(pair, OF_BOTH, witness);
}

ovoid_verdict ovoid_swept_collide(ovoid_swept_pair pair) { ENVIRONMENT_RETURN_CALL(find_sign(pair)); }

ovoid_verdict ovoid_swept_distance(ovoid_swept_pair pair, ovoid_witness *witness) {
    ENVIRONMENT_RETURN_CALL(find_distance(pair, witness));
}

ovoid_verdict ovoid_swept_contact(ovoid_swept_pair pair, ovoid_witness *witness) {
    ENVIRONMENT_RETURN_CALL(find_contact(pair, witness));
}

ovoid_verdict ovoid_swept_depth(ovoid_swept_pair pair, ovoid_witness *witness) {
    ENVIRONMENT_RETURN_CALL(find_depth(pair, witness));
}
