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
// The normal of cores that overlap is that of the face which the core is the least behind.
#include "linear/nearest.h"

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

static void find_segments(vec3 u, vec3 v, vec3 d, nearest_pair *out) {
    double s, t;
    find_parameters(d, u, v, &s, &t);
    vec3 w = vec3_add_scaled(vec3_add_scaled(d, v, t), u, -s);
    // A difference that is not short has digits enough for a direction.
    double square = vec3_norm_squared(w), all = vec3_norm_squared(d) + (vec3_norm_squared(u) + vec3_norm_squared(v));
    vec3 n = square > 0x1p-16 * all ? vec3_scale(w, 1 / sqrt(square))
                                    : find_segments_normal(w, u, v, fabs(s) < 1, fabs(t) < 1);
    out->a[0] = s;
    out->b[0] = t;
    out->point_a = vec3_scale(u, s);
    out->difference = w;
    out->gap = vec3_dot(n, d) - fabs(vec3_dot(n, u)) - fabs(vec3_dot(n, v));
    out->normal = n;
}

// The same operations of a segment with the half axis e and a point, without those of the half of a point, which is
// zero.
static void find_point_and_segment(vec3 e, vec3 d, int is_point_a, nearest_pair *out) {
    double square = vec3_norm_squared(e), along = vec3_dot(e, d);
    // The square of a length above zero may be zero.
    double t = square > 0 ? clamp((is_point_a ? -along : along) / square) : 0;
    vec3 w = vec3_add_scaled(d, e, is_point_a ? t : -t);
    int is_inside = fabs(t) < 1;
    vec3 n = vec3_unit(is_inside ? take_off(w, e) : w);
    if (!(vec3_norm_squared(n) > 0.5)) n = vec3_orthogonal(vec3_unit(is_inside ? e : (vec3){0, 0, 1}));
    *(is_point_a ? out->b : out->a) = t;
    out->point_a = is_point_a ? (vec3){0, 0, 0} : vec3_scale(e, t);
    out->difference = w;
    out->gap = vec3_dot(n, d) - fabs(vec3_dot(n, e));
    out->normal = n;
}

static void find_points(vec3 d, nearest_pair *out) {
    nearest_points found = nearest_find_points(d);
    out->point_a = (vec3){0, 0, 0};
    out->difference = d;
    out->normal = found.normal;
    out->gap = found.gap;
}

// ---- a box and a segment, or a point, in the world's axes from the box's centre

// A segment y + s e, and a box of half axes `axis`; in units of these, t_i = from[i] + s way[i]. Of a point e, way and
// rise are not set.
typedef struct in_box {
    int is_point;
    vec3 y, e, axis[3];
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

static void set_way(vec3 e, in_box *q) {
    q->e = e;
    double least = 0x1p-92 * vec3_norm_squared(e);
    for (int i = 0; i < 3; i++) {
        double along = vec3_dot(q->axis[i], e);
        q->way[i] = along * (1 / q->square[i]);
        q->rise[i] = along * along > least * q->square[i] ? q->way[i] : 0;
    }
}

// y: the middle of the point or segment from that of the box.
static void set_in_box(const nearest_core *box, const nearest_core *thin, vec3 y, in_box *q) {
    q->is_point = thin->dimension == 0;
    q->y = y;
    for (int i = 0; i < 3; i++) {
        q->axis[i] = box->axis[i];
        q->square[i] = vec3_norm_squared(q->axis[i]);
        q->from[i] = vec3_dot(q->axis[i], q->y) * (1 / q->square[i]);
    }
    if (!q->is_point) set_way(thin->axis[0], q);
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

static void find_in_box(const nearest_core *a, const nearest_core *b, vec3 d, nearest_pair *out) {
    int is_box_a = a->dimension == 3;
    double *of_box = is_box_a ? out->a : out->b, *of_thin = is_box_a ? out->b : out->a;
    in_box q;
    if (is_box_a)
        set_in_box(a, b, d, &q);
    else
        set_in_box(b, a, vec3_neg(d), &q);
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
    out->point_a = is_box_a ? on_box : q.is_point ? (vec3){0, 0, 0} : vec3_scale(q.e, s);
}

void nearest_find(const nearest_core *a, const nearest_core *b, vec3 d, nearest_pair *out) {
    if (a->dimension == 3 || b->dimension == 3)
        find_in_box(a, b, d, out);
    else if (a->dimension + b->dimension == 0)
        find_points(d, out);
    else if (a->dimension + b->dimension == 1)
        find_point_and_segment(a->dimension == 0 ? b->axis[0] : a->axis[0], d, a->dimension == 0, out);
    else
        find_segments(a->axis[0], b->axis[0], d, out);
}
