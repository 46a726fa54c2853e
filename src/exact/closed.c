// A point, a segment and a box are the sets of all c + sum t_i g_i, |t_i| <= 1, of zero, one and three segments g_i at
// right angles. The nearest points of two of them, one of which is no box:
// - Two segments: V. J. Lumelsky, On fast computation of distance between line segments, 1985: the nearest points of
//   the lines where both parameters are within their ends; else one of them is at an end.
// - A box and a point: each of the point's coordinates along the box's axes, cut off at the faces.
// - A box and a segment: the square of the distance from the box is a convex function of the segment's parameter, made
//   of parabolas between the at most six parameters at which the segment passes a face's plane. Its derivative grows,
//   so its zero is between two of them, where the derivative is linear.
//
// The nearest points give the upper bound, and the features that they lie in the normal: the difference itself where
// one of them is an end or a corner, but the cross product of two edges, and the face's own normal, since a difference
// that is short has digits for a length but not for a direction. The gap along the normal, whatever it is, is the lower
// bound; where rounding leaves it below the upper one by more than the tolerance, the search for all pairs answers.
//
// Where many points are nearest, as of parallel segments or of a segment along a face, those in the middle are taken.
//
// Of bodies whose cores overlap the radii alone prove the overlap. The normal is then that of the face which the core
// is the least behind; of a point in a box that is the depth, for which another proof is needed (exact/inside.h).
#include "exact/closed.h"

// Nearest points: their parameters, in the world's axes where they are from A's body frame and their difference, B's
// minus A's, and the normal from A to B.
typedef struct nearest_pair {
    double a[3], b[3];
    double gap;
    vec3 point_a, difference, normal;
} nearest_pair;

static double clamp(double t) { return max2(-1, min2(1, t)); }

// ---- two segments, or points

// The parameter on one of two parallel segments of the middle of what lies beside the other one, which reaches from
// middle - half to middle + half in the parameters of the first; of segments one behind the other, the end.
static double find_beside(double middle, double half) {
    double low = max2(-1, middle - half), high = min2(1, middle + half);
    return clamp(0.5 * (low + high));
}

// The parameters of the nearest points of two segments d apart, in the world: s on A, t on B.
static void find_parameters(vec3 d, vec3 u, vec3 v, double *s, double *t) {
    double uu = vec3_norm_squared(u), vv = vec3_norm_squared(v), uv = vec3_dot(u, v), ud = vec3_dot(u, d),
           vd = vec3_dot(v, d);
    // The square of a length above zero may be zero.
    if (!(uu > 0)) {
        *s = 0;
        *t = vv > 0 ? clamp(-vd / vv) : 0;
        return;
    }
    if (!(vv > 0)) {
        *t = 0;
        *s = clamp(ud / uu);
        return;
    }
    double det = uu * vv - uv * uv;
    *s = det > 1e-14 * (uu * vv) ? clamp((ud * vv - vd * uv) / det) : find_beside(ud / uu, fabs(uv) / uu);
    *t = (*s * uv - vd) / vv;
    if (fabs(*t) <= 1) return;
    *t = clamp(*t);
    *s = clamp((ud + *t * uv) / uu);
}

// w without its part along e.
static vec3 take_off(vec3 w, vec3 e) { return vec3_add_scaled(w, e, -vec3_dot(w, e) / vec3_norm_squared(e)); }

// The unit normal for the difference w of points at s of u and t of v.
static vec3 find_segments_normal(vec3 w, vec3 u, vec3 v, int is_inside_u, int is_inside_v) {
    vec3 n = w;
    if (is_inside_u & is_inside_v) {
        n = vec3_cross(u, v);
        double square = vec3_norm_squared(n);
        if (!(square > 1e-20 * (vec3_norm_squared(u) * vec3_norm_squared(v)))) n = take_off(w, u);
        if (vec3_dot(n, w) < 0) n = vec3_neg(n);
    } else if (is_inside_u) {
        n = take_off(w, u);
    } else if (is_inside_v) {
        n = take_off(w, v);
    }
    n = vec3_unit(n);
    if (vec3_norm_squared(n) > 0.5) return n;
    return vec3_orthogonal(vec3_unit(is_inside_u ? u : is_inside_v ? v : (vec3){0, 0, 1}));
}

// The middle of a point or a segment, turned; that of a sphere around its frame's origin needs no turn.
static inline vec3 turn_middle(const mat3 *turn, const ovoid_shape *s) {
    return closed_is_origin(s) ? (vec3){0, 0, 0} : mat3_mul_vec3(*turn, closed_get_middle(s));
}

static void find_segments(const pair_frame *f, nearest_pair *out) {
    vec3 middle = turn_middle(&f->world, f->a);
    vec3 d = vec3_add(f->offset, vec3_sub(turn_middle(&f->world_b, f->b), middle));
    vec3 u = mat3_mul_vec3(f->world, closed_get_half(f->a)), v = mat3_mul_vec3(f->world_b, closed_get_half(f->b));
    double s, t;
    find_parameters(d, u, v, &s, &t);
    vec3 w = vec3_add_scaled(vec3_add_scaled(d, v, t), u, -s);
    vec3 n = find_segments_normal(w, u, v, fabs(s) < 1, fabs(t) < 1);
    out->a[0] = s;
    out->b[0] = t;
    out->point_a = vec3_add_scaled(middle, u, s);
    out->difference = w;
    out->gap = vec3_dot(n, d) - fabs(vec3_dot(n, u)) - fabs(vec3_dot(n, v));
    out->normal = n;
}

// The same operations, without those of the half of a point, which is zero.
static void find_point_and_segment(const pair_frame *f, int is_point_a, nearest_pair *out) {
    vec3 middle = turn_middle(&f->world, f->a);
    vec3 d = vec3_add(f->offset, vec3_sub(turn_middle(&f->world_b, f->b), middle));
    vec3 e =
        is_point_a ? mat3_mul_vec3(f->world_b, closed_get_half(f->b)) : mat3_mul_vec3(f->world, closed_get_half(f->a));
    double square = vec3_norm_squared(e), along = vec3_dot(e, d);
    // The square of a length above zero may be zero.
    double t = square > 0 ? clamp((is_point_a ? -along : along) / square) : 0;
    vec3 w = vec3_add_scaled(d, e, is_point_a ? t : -t);
    int is_inside = fabs(t) < 1;
    vec3 n = vec3_unit(is_inside ? take_off(w, e) : w);
    if (!(vec3_norm_squared(n) > 0.5)) n = vec3_orthogonal(vec3_unit(is_inside ? e : (vec3){0, 0, 1}));
    *(is_point_a ? out->b : out->a) = t;
    out->point_a = is_point_a ? middle : vec3_add_scaled(middle, e, t);
    out->difference = w;
    out->gap = vec3_dot(n, d) - fabs(vec3_dot(n, e));
    out->normal = n;
}

static void find_points(const pair_frame *f, nearest_pair *out) {
    out->point_a = turn_middle(&f->world, f->a);
    out->difference = vec3_add(f->offset, vec3_sub(turn_middle(&f->world_b, f->b), out->point_a));
    closed_points found = closed_find_points(out->difference);
    out->normal = found.normal;
    out->gap = found.gap;
}

// ---- a box and a segment, or a point, in the world's axes from the box's centre

// A segment y + s e, and a box of half axes `axis`; in units of these, t_i = from[i] + s way[i]. Of a point e, way and
// rise are not set.
typedef struct in_box {
    int is_point;
    vec3 y, e, axis[3];
    vec3 center;                       ///< of the box, from its body frame's origin, world
    double from[3], way[3], square[3]; ///< square: of the half axis' length
    double rise[3];                    ///< way; 0 where the segment is along the faces, to rounding
} in_box;

static double find_excess(double t) { return t - clamp(t); }

// Half the derivative by s of the squared distance, without the part of axis `except`, if that is one.
static double find_slope(const in_box *q, double s, int except) {
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += i == except ? 0 : q->square[i] * q->rise[i] * find_excess(q->from[i] + s * q->way[i]);
    return sum;
}

static int is_inside(const in_box *q, double s) {
    int sum = 1;
    for (int i = 0; i < 3; i++) sum &= fabs(q->from[i] + s * q->way[i]) < 1;
    return sum;
}

// The parameter of the segment's point nearest to the box; of several the middle, but the first where that is inside of
// the box, since a point on a face is one of fewer vertices, and as good a common point. low to high: the slope is
// negative at low and positive at high; first to last: where it was found to be zero.
static double find_nearest(const in_box *q) {
    double low = -1, high = 1, at_low = find_slope(q, low, 3), at_high = find_slope(q, high, 3);
    if (at_low > 0) return low;
    if (at_high < 0) return high;
    double first = at_low < 0 ? INFINITY : low, last = at_low < 0 ? -INFINITY : low;
    if (!(at_high > 0)) {
        first = min2(first, high);
        last = high;
    }
    for (int k = 0; k < 6; k++) {
        int i = k >> 1;
        double s = ((k & 1 ? 1 : -1) - q->from[i]) / q->rise[i];
        // Not so where the segment is along the faces.
        if (!(s > low && s < high)) continue;
        double slope = find_slope(q, s, i);
        if (slope < 0) {
            low = s, at_low = slope;
        } else if (slope > 0) {
            high = s, at_high = slope;
        } else {
            first = min2(first, s);
            last = max2(last, s);
        }
    }
    if (first <= last) {
        double middle = 0.5 * (first + last);
        return is_inside(q, middle) ? first : middle;
    }
    double s = low + (high - low) * (-at_low / (at_high - at_low));
    return min2(high, max2(low, s));
}

static void set_way(const ovoid_shape *thin, const mat3 *turn, in_box *q) {
    q->e = mat3_mul_vec3(*turn, closed_get_half(thin));
    double least = 0x1p-92 * vec3_norm_squared(q->e);
    for (int i = 0; i < 3; i++) {
        double along = vec3_dot(q->axis[i], q->e);
        q->way[i] = along * (1 / q->square[i]);
        q->rise[i] = along * along > least * q->square[i] ? q->way[i] : 0;
    }
}

static void set_in_box(const pair_frame *f, int is_box_a, in_box *q) {
    const ovoid_shape *box = is_box_a ? f->a : f->b, *thin = is_box_a ? f->b : f->a;
    const mat3 *turn = is_box_a ? &f->world : &f->world_b, *turn_thin = is_box_a ? &f->world_b : &f->world;
    vec3 middle = turn_middle(turn_thin, thin);
    q->is_point = thin->vertex_count == 1;
    q->center = mat3_mul_vec3(*turn, box->box.center);
    q->y =
        is_box_a ? vec3_add(f->offset, vec3_sub(middle, q->center)) : vec3_sub(vec3_sub(middle, q->center), f->offset);
    for (int i = 0; i < 3; i++) {
        q->axis[i] = mat3_mul_vec3(*turn, box->box.axis[i]);
        q->square[i] = vec3_norm_squared(q->axis[i]);
        q->from[i] = vec3_dot(q->axis[i], q->y) * (1 / q->square[i]);
    }
    if (!q->is_point) set_way(thin, turn_thin, q);
}

// The gap of the segment from the box along m.
static double find_box_gap(const in_box *q, vec3 m) {
    double gap = vec3_dot(m, q->y);
    if (!q->is_point) gap -= fabs(vec3_dot(m, q->e));
    for (int i = 0; i < 3; i++) gap -= fabs(vec3_dot(m, q->axis[i]));
    return gap;
}

// Of a segment that enters the box: the normal of the face behind which it is the least.
static vec3 find_face(const in_box *q) {
    double best = -INFINITY;
    vec3 n = {1, 0, 0};
    for (int i = 0; i < 3; i++) {
        double way = q->is_point ? 0 : fabs(q->way[i]), gap = (fabs(q->from[i]) - way - 1) * sqrt(q->square[i]);
        if (!(gap > best)) continue;
        best = gap;
        n = q->from[i] < 0 ? vec3_neg(q->axis[i]) : q->axis[i];
    }
    return vec3_unit(n);
}

// The unit normal toward the segment's point, which is off the box by w, beyond the faces of the axes in `beyond`.
static vec3 find_box_normal(const in_box *q, vec3 w, unsigned beyond, int is_inside) {
    vec3 n = w;
    if (beyond == 0) return find_face(q);
    if (is_inside && (beyond == 3 || beyond == 5 || beyond == 6)) {
        vec3 edge = q->axis[beyond == 3 ? 2 : beyond == 5 ? 1 : 0], across = vec3_cross(q->e, edge);
        if (vec3_norm_squared(across) > 1e-20 * (vec3_norm_squared(q->e) * vec3_norm_squared(edge)))
            n = vec3_dot(across, w) < 0 ? vec3_neg(across) : across;
    }
    return vec3_unit(n);
}

static void find_in_box(const pair_frame *f, int is_box_a, nearest_pair *out) {
    double *of_box = is_box_a ? out->a : out->b, *of_thin = is_box_a ? out->b : out->a;
    in_box q;
    set_in_box(f, is_box_a, &q);
    double s = q.is_point ? 0 : find_nearest(&q);
    // w: the sum of what is beyond the faces, which has digits for a direction; off: the points' difference.
    unsigned beyond = 0;
    vec3 w = {0, 0, 0}, on_box = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        double t = q.is_point ? q.from[i] : q.from[i] + s * q.way[i], excess = find_excess(t);
        of_box[i] = t - excess;
        w = vec3_add_scaled(w, q.axis[i], excess);
        on_box = vec3_add_scaled(on_box, q.axis[i], of_box[i]);
        beyond |= (unsigned)(fabs(excess) > 0) << i;
    }
    of_thin[0] = s;
    vec3 on_thin = q.is_point ? q.y : vec3_add_scaled(q.y, q.e, s), off = vec3_sub(on_thin, on_box);
    vec3 n = find_box_normal(&q, w, beyond, !q.is_point && fabs(s) < 1);
    out->gap = find_box_gap(&q, n);
    out->normal = is_box_a ? n : vec3_neg(n);
    out->difference = is_box_a ? off : vec3_neg(off);
    out->point_a = vec3_add(is_box_a ? q.center : vec3_add(f->offset, q.center), is_box_a ? on_box : on_thin);
}

// ---- the points as pairs of vertices

// A parameter between its ends, as the weight of the end at 1, and the vertex bits that it sets.
typedef struct cut {
    double weight;
    unsigned bit;
} cut;

// Bits of A are 0 to 2, those of B 3 to 5.
static void add_cuts(const double *t, uint32_t count, unsigned first, cut *cuts, uint32_t *cut_count, unsigned *set) {
    for (uint32_t i = 0; i < count; i++) {
        double weight = 0.5 * (1 + t[i]);
        unsigned bit = 1u << (first + i);
        if (!(weight > 0)) continue;
        if (!(weight < 1)) {
            *set |= bit;
            continue;
        }
        uint32_t at = (*cut_count)++;
        for (; at > 0 && cuts[at - 1].weight < weight; at--) cuts[at] = cuts[at - 1];
        cuts[at] = (cut){weight, bit};
    }
}

static uint32_t count_axes(const ovoid_shape *s) { return s->vertex_count == 8 ? 3 : s->vertex_count - 1; }

static uint32_t get_vertex(const ovoid_shape *s, unsigned bits) {
    return s->vertex_count == 8 ? s->box.corner[bits & 7] : s->vertex_count == 2 ? bits & 1 : 0;
}

// The number of cuts.
static uint32_t count_cuts(const double *t, uint32_t count) {
    uint32_t sum = 0;
    for (uint32_t i = 0; i < count; i++) {
        double weight = 0.5 * (1 + t[i]);
        sum += (uint32_t)((weight > 0) & (weight < 1));
    }
    return sum;
}

// The two points as one convex combination of pairs of vertices: from the pair with the ends at -1 one parameter after
// another goes to its end at 1, the one of the largest weight first. There are at most three cuts.
static void write_points(const pair_frame *f, const nearest_pair *found, simplex *points) {
    cut cuts[6];
    uint32_t count = 0, axes_a = count_axes(f->a), axes_b = count_axes(f->b);
    unsigned bits = 0;
    if (axes_a > 0) add_cuts(found->a, axes_a, 0, cuts, &count, &bits);
    if (axes_b > 0) add_cuts(found->b, axes_b, 3, cuts, &count, &bits);
    points->count = (int)count + 1;
    double left = 1;
    for (uint32_t i = 0; i < 4; i++) {
        if (i > count) {
            points->p[i].a = points->p[i].b = 0;
            points->weight[i] = 0;
            continue;
        }
        double next = i < count ? cuts[i].weight : 0;
        points->p[i].a = get_vertex(f->a, bits);
        points->p[i].b = get_vertex(f->b, bits >> 3);
        points->weight[i] = left - next;
        if (i < count) bits |= cuts[i].bit;
        left = next;
    }
}

// ---- the answer

// Radii go along the difference, or where they overlap along the normal (pair/proof.c).
static closed_cores find_cores(const pair_frame *f, const nearest_pair *found, double distance) {
    int is_apart = distance > f->a->radius + f->b->radius;
    vec3 n = is_apart ? vec3_scale(found->difference, 1 / distance) : found->normal;
    vec3 a = vec3_add(f->world_origin, found->point_a);
    return (closed_cores){a, vec3_add(a, found->difference), n};
}

static void find_nearest_pair(const pair_frame *f, nearest_pair *found) {
    uint32_t a = f->a->vertex_count, b = f->b->vertex_count;
    if (a == 8 || b == 8)
        find_in_box(f, a == 8, found);
    else if (a + b == 2)
        find_points(f, found);
    else if (a + b == 3)
        find_point_and_segment(f, a == 1, found);
    else
        find_segments(f, found);
}

int closed_run(const placed_query *query, small_end *end) {
    const pair_frame *f = query->frame;
    nearest_pair found;
    if (!closed_is_moderate(f)) return 0;
    find_nearest_pair(f, &found);
    double distance = vec3_norm(found.difference);
    if (!closed_set_bounds(query, found.gap, distance, end)) return 0;
    // Points inside a box and inside a segment take more pairs than an answer holds.
    if (count_cuts(found.a, count_axes(f->a)) + count_cuts(found.b, count_axes(f->b)) > 3) return 0;
    if (!query->is_bare) write_points(f, &found, &end->points);
    end->normal = vec3_clear_signs(found.normal);
    end->inner = (vec3){0, 0, 0};
    closed_cores cores = find_cores(f, &found, distance);
    closed_set_witness(f, &cores, end);
    return 1;
}
