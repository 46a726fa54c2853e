// The kernels of solid8.h, written once over lanes.
//
// Two triangles: the nearest points of nine pairs of edges (C. Ericson, Real-Time Collision Detection, 2004, 5.1.9) and
// of six corners above the inside of the other one; the shortest difference of them is the direction along which the
// gap is measured. Whatever the edges are, the parameters are kept in [0, 1], so the points are points of the
// triangles, and any direction gives a true gap.
#include "simd/kernels/lanes.h"
#include "simd/solid8.h"

#define TINY 1e-300

LANES_INLINE lane3 spread(vec3 v) { return (lane3){lane_set(v.x), lane_set(v.y), lane_set(v.z)}; }
LANES_INLINE lane9 spread9(const mat3 *m) { return (lane9){spread(m->r0), spread(m->r1), spread(m->r2)}; }
LANES_INLINE lane least(lane a, lane b) { return lane_select(lane_less(a, b), a, b); }
LANES_INLINE lane clamp(lane x) { return least(lane_max(x, lane_set(0)), lane_set(1)); }
LANES_INLINE lane3 lane3_abs(lane3 v) { return (lane3){lane_abs(v.x), lane_abs(v.y), lane_abs(v.z)}; }

// The distance by gaps along three axes: their norm where one is above zero, else the largest.
LANES_INLINE lane join_gaps(lane3 gap) {
    lane zero = lane_set(0), most = lane_max(lane_max(gap.x, gap.y), gap.z);
    lane3 out = {lane_max(gap.x, zero), lane_max(gap.y, zero), lane_max(gap.z, zero)};
    lane norm = lane3_norm(out);
    return lane_select(lane_greater(norm, zero), norm, most);
}

// Eight boxes beside the other one: half sizes, and from their centres to its centre.
typedef struct lane_boxes {
    lane3 half, d;
} lane_boxes;

LANES_INLINE lane lane3_get(lane3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

// The gap across axis i of the node and axis j of the other box, times |i x j| (S. Gottschalk, M. C. Lin, D. Manocha,
// OBBTree, 1996); none where they are nearly parallel. i and j are constants.
LANES_INLINE lane find_across(const lane_boxes *boxes, const solid8_other *other, int i, int j) {
    const vec3 row[3] = {other->rotation.r0, other->rotation.r1, other->rotation.r2};
    const vec3 size[3] = {other->absolute.r0, other->absolute.r1, other->absolute.r2};
    int k = (i + 1) % 3, l = (i + 2) % 3, m = (j + 1) % 3, n = (j + 2) % 3;
    double u = vec3_get(row[j], k), v = vec3_get(row[j], l);
    double reach = vec3_get(other->half, m) * vec3_get(size[n], i) + vec3_get(other->half, n) * vec3_get(size[m], i);
    if (!(u * u + v * v > SOLID8_PARALLEL)) reach = INFINITY;
    lane at = lane3_get(boxes->d, l) * lane_set(u) - lane3_get(boxes->d, k) * lane_set(v);
    lane own = lane3_get(boxes->half, l) * lane_set(vec3_get(size[j], k)) +
               lane3_get(boxes->half, k) * lane_set(vec3_get(size[j], l));
    return lane_abs(at) - own - lane_set(reach);
}

LANES_INLINE lane find_across_all(const lane_boxes *boxes, const solid8_other *other, int i) {
    return lane_max(lane_max(find_across(boxes, other, i, 0), find_across(boxes, other, i, 1)),
                    find_across(boxes, other, i, 2));
}

LANES_TARGET static void run_boxes(const box8 *node, const solid8_other *other, double lower[BOX8]) {
    lane9 rotation = spread9(&other->rotation), absolute = spread9(&other->absolute);
    lane3 center = spread(other->center), turned = spread(other->turned), own = spread(other->half);
    lane3 normal = spread(other->normal), sizes = lane3_abs(normal);
    lane unit = lane_set(0.5 * other->unit), reach = lane_set(other->reach), tiny = lane_set(TINY);
    for (int at = 0; at < BOX8; at += LANES) {
        lane3 low = {lane_load_floats(node->low[0] + at), lane_load_floats(node->low[1] + at),
                     lane_load_floats(node->low[2] + at)};
        lane3 high = {lane_load_floats(node->high[0] + at), lane_load_floats(node->high[1] + at),
                      lane_load_floats(node->high[2] + at)};
        lane3 half = lane3_scale(lane3_sub(high, low), unit);
        lane3 d = lane3_sub(center, lane3_scale(lane3_add(high, low), unit));
        lane3 gap = lane3_sub(lane3_sub(lane3_abs(d), half), turned);
        lane first = join_gaps(gap);
        lane3 turned_d = lane3_abs(lane9_mul3(rotation, d));
        gap = lane3_sub(lane3_sub(turned_d, lane9_mul3(absolute, half)), own);
        first = lane_max(first, join_gaps(gap));
        lane along = lane3_dot(normal, d) - lane3_dot(sizes, half) - reach;
        lane square = lane3_dot(d, d), both = lane3_dot(lane3_abs(d), half) + lane3_dot(turned_d, own);
        lane line = lane_select(lane_greater(square, tiny), (square - both) / lane_sqrt(square), along);
        lane best = lane_max(lane_max(first, along), line);
        if (other->across) {
            // |i x j| is at most 1: a gap above the errors is no less than its product.
            const lane_boxes boxes = {half, d};
            lane across = lane_max(lane_max(find_across_all(&boxes, other, 0), find_across_all(&boxes, other, 1)),
                                   find_across_all(&boxes, other, 2));
            best = lane_select(lane_greater(across, lane_max(best, lane_set(other->least))), across, best);
        }
        lane_store(lower + at, best);
    }
}

// The shortest difference so far.
typedef struct nearest {
    lane square;
    lane3 d;
} nearest;

LANES_INLINE void take_nearest(nearest *best, lane_mask is_possible, lane3 d) {
    lane square = lane3_dot(d, d);
    lane_mask better = lane_and(is_possible, lane_less(square, best->square));
    best->square = lane_select(better, square, best->square);
    best->d = lane3_select(better, d, best->d);
}

LANES_INLINE lane_mask always(void) { return lane_not(lane_none()); }

// An edge of one triangle: where it begins, its direction, its square.
typedef struct edge {
    lane3 from, along;
    lane square;
} edge;

LANES_INLINE edge make_edge(lane3 from, lane3 to) {
    lane3 along = lane3_sub(to, from);
    return (edge){from, along, lane_max(lane3_dot(along, along), lane_set(TINY))};
}

LANES_INLINE void take_edges(nearest *best, const edge *p, const edge *q) {
    lane3 r = lane3_sub(p->from, q->from);
    lane a = p->square, e = q->square, f = lane3_dot(q->along, r), c = lane3_dot(p->along, r);
    lane b = lane3_dot(p->along, q->along);
    lane s = clamp((b * f - c * e) / lane_max(a * e - b * b, lane_set(TINY)));
    lane t = clamp((b * s + f) / e);
    s = clamp((b * t - c) / a);
    take_nearest(best, always(), lane3_sub(lane3_scale(q->along, t), lane3_add_scaled(r, p->along, s)));
}

// A triangle: its edges, and the cross product of the first two.
typedef struct sides {
    const edge *of;
    lane3 normal;
} sides;

LANES_INLINE sides make_sides(const lane3 corner[3], edge of[3]) {
    for (int i = 0; i < 3; i++) of[i] = make_edge(corner[i], corner[(i + 1) % 3]);
    return (sides){of, lane3_cross(of[0].along, of[1].along)};
}

// A corner above the inside of a triangle: sign 1 where the corner is of the other body, whose points are subtracted
// from.
LANES_INLINE void take_corner(nearest *best, lane3 corner, sides s, lane sign) {
    const edge *of = s.of;
    lane3 normal = s.normal;
    lane zero = lane_set(0), square = lane3_dot(normal, normal);
    lane_mask inside = lane_greater(square, zero);
    for (int i = 0; i < 3; i++) {
        lane side = lane3_dot(lane3_cross(normal, of[i].along), lane3_sub(corner, of[i].from));
        inside = lane_and(inside, lane_at_least(side, zero));
    }
    lane height = lane3_dot(normal, lane3_sub(corner, of[0].from)) / lane_max(square, lane_set(TINY));
    take_nearest(best, inside, lane3_scale(normal, height * sign));
}

LANES_INLINE lane find_top(const lane3 corner[3], lane3 n) {
    return lane_max(lane_max(lane3_dot(corner[0], n), lane3_dot(corner[1], n)), lane3_dot(corner[2], n));
}
LANES_INLINE lane find_bottom(const lane3 corner[3], lane3 n) {
    return least(least(lane3_dot(corner[0], n), lane3_dot(corner[1], n)), lane3_dot(corner[2], n));
}

// What is measured of LANES pairs (solid8_gaps).
typedef struct lane_gaps {
    lane lower, upper;
    lane3 normal;
} lane_gaps;

LANES_INLINE void put_gaps(solid8_gaps *out, int at, const lane_gaps *g) {
    lane_store(out->lower + at, g->lower);
    lane_store(out->upper + at, g->upper);
    lane_store(out->normal[0] + at, g->normal.x);
    lane_store(out->normal[1] + at, g->normal.y);
    lane_store(out->normal[2] + at, g->normal.z);
}

// Gaps along the normal given and along the line of the middles; and where they are not enough.
LANES_INLINE lane_mask run_directions(const solid8_triangle *one, const lane3 p[3], const lane3 q[3], lane_gaps *out) {
    lane third = lane_set(1.0 / 3);
    lane3 n = spread(one->normal);
    lane gap = find_bottom(q, n) - find_top(p, n);
    lane3 d =
        lane3_scale(lane3_sub(lane3_add(lane3_add(q[0], q[1]), q[2]), lane3_add(lane3_add(p[0], p[1]), p[2])), third);
    lane_mask good = always();
    lane3 line = lane3_unit(d, &good);
    lane along = find_bottom(q, line) - find_top(p, line);
    lane_mask better = lane_and(good, lane_greater(along, gap));
    gap = lane_select(better, along, gap);
    *out = (lane_gaps){gap, lane_set(INFINITY), lane3_select(better, line, n)};
    return lane_at_most(gap, lane_set(one->enough));
}

LANES_TARGET static void run_triangles(const solid8_triangle *one, const solid8_triangles *eight, solid8_gaps *out) {
    lane3 p[3], q[3];
    edge a[3], b[3];
    lane_gaps gaps;
    lane9 rotation = spread9(&one->rotation);
    lane3 translation = spread(one->translation);
    for (int i = 0; i < 3; i++) p[i] = spread(one->corner[i]);
    sides side_a = make_sides(p, a);
    for (int at = 0; at < BOX8; at += LANES) {
        for (int i = 0; i < 3; i++) {
            lane3 own = {lane_load(eight->corner[i][0] + at), lane_load(eight->corner[i][1] + at),
                         lane_load(eight->corner[i][2] + at)};
            q[i] = lane3_add(lane9_mul3(rotation, own), translation);
        }
        // A lane whose gap is enough keeps it whatever its neighbours need: the bits do not depend on LANES.
        lane_mask open = run_directions(one, p, q, &gaps);
        if (!lane_bits(open)) {
            put_gaps(out, at, &gaps);
            continue;
        }
        sides side_b = make_sides(q, b);
        nearest best = {lane_set(INFINITY), {lane_set(0), lane_set(0), lane_set(0)}};
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) take_edges(&best, &a[i], &b[j]);
        for (int i = 0; i < 3; i++) {
            take_corner(&best, q[i], side_a, lane_set(1));
            take_corner(&best, p[i], side_b, lane_set(-1));
        }
        lane_mask good = always();
        lane3 n = lane3_unit(best.d, &good);
        lane zero = lane_set(0);
        n = lane3_select(good, n, (lane3){zero, zero, zero});
        lane lower = lane_select(good, find_bottom(q, n) - find_top(p, n), lane_set(-INFINITY));
        lane upper = lane_select(good, lane_sqrt(best.square), lane_set(INFINITY));
        gaps = (lane_gaps){lane_select(open, lower, gaps.lower), lane_select(open, upper, gaps.upper),
                           lane3_select(open, n, gaps.normal)};
        put_gaps(out, at, &gaps);
    }
}
