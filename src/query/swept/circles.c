// Theorem. Let h(n) be the overlap of a box and a cylinder or a cone along a unit n, and n* a direction in which it is
// the least, and above 0. Where both bodies have one farthest point around n*, a corner and a point of a rim or an
// apex, h is the sum of a linear function and of R |n x w|, w the axis: across n* and along w nothing bends it, so that
// h / |n| bends down there, and n* is no minimum. So n* is one of these:
// - the axis of a disc, at w or -w;
// - on the circle across an edge of the box, whose arcs query/swept/arcs.c shows to be no lower, or
// - where the side of the round body has more than one farthest point: on the circle across the axis of a cylinder, and
//   on the one around that of a cone. Between the directions in which an edge of the box is across, that is the circles
//   above, h is a constant and a cosine there: its minimum is where a corner goes straight to the axis.
//
// (For two boxes that leaves the 15 axes of exact/boxes.c.)
//
// Errors, in parts u s as in swept.c: the axis and the centre in the box's axes are taken as they were rounded, which
// moves no point by more than 10 u s; a value is summed to 40 u s; that of a direction that is off by some u is by as
// many u s. |n x w| is computed from the product, so that nothing is lost near the axis. The cosines and sines of the
// arcs' proofs add the slope that is left.
#include "query/swept/arcs.h"

// A box beside a round body.
typedef struct box_search {
    edged_search of;
    const double *half;
} box_search;

// The circle across the box's axis k, in the plane of the axes i and j.
typedef struct circle {
    int i, j, k;
    arc_plane plane;
} circle;

// ---- directions

static double measure(const box_search *q, const double n[3]) {
    const double round = edged_measure_round(&q->of, n);
    const double box = (q->half[0] * fabs(n[0]) + q->half[1] * fabs(n[1])) + q->half[2] * fabs(n[2]);
    return (box + round) - dot3(n, q->of.center);
}

// Of a direction and its reverse; of a cylinder the lesser one is that to its centre.
static void take_both(box_search *q, const double n[3], free_body free, int edge) {
    const double m[3] = {-n[0], -n[1], -n[2]};
    const int is_ahead = dot3(n, q->of.center) >= 0;
    if (q->of.is_cone || is_ahead) edged_take(&q->of, measure(q, n), n, free, edge);
    if (q->of.is_cone || !is_ahead) edged_take(&q->of, measure(q, m), m, free, edge);
}

static void take_faces(box_search *q) {
    for (int k = 0; k < 3; k++) {
        double n[3] = {0, 0, 0};
        n[k] = 1;
        take_both(q, n, FREE_EDGED, k);
    }
    // The apex of a cone is no disc; that direction is as good as others.
    take_both(q, q->of.axis, FREE_ROUND, 0);
}

static void take_corners(box_search *q) {
    for (int i = 0; i < 8; i++) {
        const double sign[3] = {i & 1 ? -1 : 1, i & 2 ? -1 : 1, i & 4 ? -1 : 1};
        double v[3], n[3];
        int is_corner = 1;
        for (int k = 0; k < 3; k++) v[k] = sign[k] * q->half[k] - q->of.center[k];
        if (!edged_aim_corner(&q->of, v, n)) continue;
        for (int k = 0; k < 3; k++) is_corner &= n[k] * sign[k] >= 0;
        if (is_corner) edged_take(&q->of, measure(q, n), n, FREE_ROUND, 0);
    }
}

// ---- the circle across an edge

static circle make_circle(const box_search *q, int k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    const double *axis = q->of.axis;
    return (circle){i, j, k, arcs_make_plane(&q->of, k, (plane_vector){axis[i], axis[j]}, axis[k] * axis[k])};
}

// The quarter between two axes of the box, with their signs.
static int hold_quarter(box_search *q, circle *o, double x, double y) {
    arc_plane *plane = &o->plane;
    plane->first = (plane_vector){x, 0};
    plane->last = (plane_vector){0, y};
    plane->corner = (plane_vector){x * q->half[o->i] - q->of.center[o->i], y * q->half[o->j] - q->of.center[o->j]};
    plane->side = x * y;
    const double ahead = min2(x * plane->corner.x, y * plane->corner.y);
    if (ahead >= 0 && ahead + q->of.ball >= q->of.low) return 1;
    return arcs_hold(&q->of, plane);
}

static int hold_circle(box_search *q, circle *o) {
    for (int i = 0; i < 4; i++)
        if (!hold_quarter(q, o, i & 1 ? -1 : 1, i & 2 ? -1 : 1)) return 0;
    return 1;
}

static int search_circles(box_search *q) {
    circle circles[3];
    take_faces(q);
    for (int k = 0; k < 3; k++) {
        circle *o = &circles[k];
        *o = make_circle(q, k);
        for (int i = 2; i < o->plane.breaks; i++) {
            double n[3];
            n[o->i] = o->plane.at[i].x, n[o->j] = o->plane.at[i].y, n[k] = 0;
            edged_take(&q->of, measure(q, n), n, FREE_BOTH, k);
        }
    }
    take_corners(q);
    for (int k = 0; k < 3; k++)
        if (!(q->of.low > 0 && hold_circle(q, &circles[k]))) return 0;
    if (q->of.is_on_arc) {
        const circle *o = &circles[q->of.edge];
        q->of.n[o->i] = q->of.in_plane.x, q->of.n[o->j] = q->of.in_plane.y, q->of.n[o->k] = 0;
    }
    return q->of.low > 0;
}

// ---- all

int cores_have_circles(const cores *p) {
    const ovoid_swept_core a = p->a->core, b = p->b->core, other = a == OVOID_SWEPT_BOX ? b : a;
    return (a == OVOID_SWEPT_BOX || b == OVOID_SWEPT_BOX) &&
           (other == OVOID_SWEPT_CYLINDER || other == OVOID_SWEPT_CONE);
}

int cores_search_circles(const cores *p, double tolerance, least_overlap *at) {
    const int is_box_b = p->b->core == OVOID_SWEPT_BOX;
    const ovoid_swept_sphere *box = is_box_b ? p->b : p->a, *round = is_box_b ? p->a : p->b;
    const vec3 axis = patch_turn(box, round->axis[0]), center = patch_turn(box, is_box_b ? vec3_neg(p->d) : p->d);
    box_search q = {edged_make(p, is_box_b, axis, center, tolerance), box->half};
    if (!search_circles(&q)) return 0;
    const double *n = q.of.n;
    const edged_direction of = {is_box_b, vec3_unit(patch_turn_back(box, (vec3){n[0], n[1], n[2]})),
                                box->axis[q.of.edge]};
    return edged_set_points(p, &q.of, &of, at);
}
