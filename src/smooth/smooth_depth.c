// How deep two overlapping ellipsoids are, from below: that no direction has a larger gap than the one found.
//
// By an ellipsoid enclosed in their sum. For any orthogonal S, |Ea'm| + |Eb'm| >= |M m| with M = Ea' + S Eb', equal at
// m = n where S takes q = Eb'n/sb to p = Ea'n/sa. So the depth is at least that of d in the ellipsoid of M' M, where n
// is a critical direction too; and it is the global one, with depth r, if the ball of radius r around d touches it from
// inside: by the S-lemma, if M' M - r s I is positive semidefinite, s = sa + sb. (The two quadratics x' (M'M)^-1 x - 1
// and (|x - d|^2 - r^2) / (r s) have the same gradient, n / s times 2, where they touch; their difference is convex
// then.) A residue of w across n moves d by its length, and the depth by no more. The free turn of S about p is chosen
// to bring both bodies' other axes together.
//
// Else by a hull of points of the sum that grows around the origin, as EPA's (van den Bergen 2001, expand.c): the
// radius that its surface keeps from the origin, proven by cover.c, is inside the sum. The points lie on a smooth
// surface, so the error falls with the square of the faces' size: about 4 points for each factor of 4. Cost: 10 to 100
// microseconds, 80 KB of stack.
#include "ellipsoid/distance/pencil.h"
#include "exact/expand.h"
#include "pair/cover.h"
#include "smooth/smooth_state.h"

// The vectors of the orthogonal map that takes q to p and brings Eb's other axes to those of Ea, by columns: x -> S x.
typedef struct turn {
    vec3 p[3], q[3]; ///< S = sum of p[k] q[k]'
} turn;

static turn find_turn(const smooth_pair *pair, const smooth_state *state) {
    vec3 p1 = vec3_orthogonal(state->p), q1 = vec3_orthogonal(state->q);
    vec3 p2 = vec3_cross(state->p, p1), q2 = vec3_cross(state->q, q1);
    vec3 a1 = root3_map(&pair->a.root, p1), a2 = root3_map(&pair->a.root, p2);
    vec3 b1 = root3_map(&pair->b.root, q1), b2 = root3_map(&pair->b.root, q2);
    // Of all turns and reflections, that with the largest sum of (Ea p_i).(Eb q_j) over the pairs joined.
    double xx = vec3_dot(a1, b1), xy = vec3_dot(a1, b2), yx = vec3_dot(a2, b1), yy = vec3_dot(a2, b2);
    double turned = vec3_norm((vec3){xx + yy, yx - xy, 0}), mirrored = vec3_norm((vec3){xx - yy, yx + xy, 0});
    double sign = turned >= mirrored ? 1 : -1;
    double most = max2(turned, mirrored), c = 1, s = 0;
    if (most > 0) c = (xx + sign * yy) / most, s = (yx - sign * xy) / most;
    vec3 t1 = vec3_add_scaled(vec3_scale(p1, c), p2, s);
    vec3 t2 = vec3_add_scaled(vec3_scale(p2, sign * c), p1, -sign * s);
    return (turn){{state->p, t1, t2}, {state->q, q1, q2}};
}

double smooth_compute_bound(const smooth_pair *pair, const smooth_state *state) {
    double depth = -state->gap, off = vec3_norm(state->across);
    if (!(depth > 0) || off > 0x1p-20 * depth) return INFINITY;
    root3 sum = pair->a.root;
    if (vec3_norm_squared(state->p) > 0.5 && vec3_norm_squared(state->q) > 0.5) {
        turn t = find_turn(pair, state);
        vec3 b[3];
        for (int k = 0; k < 3; k++) b[k] = root3_map(&pair->b.root, t.q[k]);
        for (int k = 0; k < 3; k++) {
            // The columns of M' = Ea + Eb S'.
            const double px[3] = {t.p[k].x, t.p[k].y, t.p[k].z};
            for (int i = 0; i < 3; i++) sum.axis[i] = vec3_add_scaled(sum.axis[i], b[k], px[i]);
        }
    } else if (!(vec3_norm_squared(state->p) > 0.5)) {
        sum = pair->b.root;
    }
    double room = depth * (state->sa + state->sb) * (1 + 0x1p-40), trace = 0;
    for (int k = 0; k < 3; k++) trace += vec3_norm_squared(sum.axis[k]);
    room += 128 * 0x1p-53 * trace;
    sym3 m = sym3_diagonal(-room, -room, -room);
    for (int k = 0; k < 3; k++) m = sym3_add(m, sym3_outer(sum.axis[k], 1));
    ldl3 f;
    return ldl3_make(m, &f) ? state->gap + off + pair->claim : INFINITY;
}

// The point of the sum (of B less A) that is farthest along n.
static vec3 find_support(const smooth_pair *pair, vec3 n) {
    smooth_state state;
    smooth_evaluate(pair, vec3_neg(n), &state);
    return state.w;
}

static int grow(const smooth_pair *pair, expansion *e, vec3 *n, uint32_t *steps) {
    static const vec3 axes[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    vec3 w[6];
    for (int i = 0; i < 6; i++) w[i] = find_support(pair, axes[i]);
    if (!expansion_make_hull(e, w, 6, 0x1p-46 * pair->size)) return 0;
    double least = INFINITY;
    while (e->points < EXPANSION_POINTS - 1) {
        uint16_t nearest = expansion_find_nearest(e);
        const expansion_face *f = &e->f[nearest];
        if (!(vec3_norm_squared(f->n) > 0.5)) return 0;
        vec3 point = find_support(pair, f->n);
        double high = vec3_dot(f->n, point);
        ++*steps;
        if (high < least) least = high, *n = vec3_neg(f->n);
        if (least - f->low <= 1e-9 * pair->size) return 1;
        if (!expansion_join(e, nearest, expansion_add_point(e, point, 0, 0))) return 0;
    }
    return 1;
}

double smooth_grow(const smooth_pair *pair, vec3 *n, uint32_t *steps) {
    expansion e;
    expansion_room room;
    expansion_room_give(&room, &e);
    *n = (vec3){1, 0, 0};
    if (!grow(pair, &e, n, steps)) return INFINITY;
    uint32_t triangles = expansion_pack(&e);
    surface s = surface_make(e.w, e.points, (const uint16_t(*)[3])e.triangles, triangles);
    double depth = surface_compute_depth(&s, pair->claim);
    return depth > 0 ? -depth : INFINITY;
}
