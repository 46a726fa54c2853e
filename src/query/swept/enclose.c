// The least overlap of two cores is the radius of the largest ball around the origin in their difference body, the
// points of B less those of A. A polytope of points of that body grows where it is nearest to the origin (G. van den
// Bergen, Proximity queries and penetration depth computation on 3D game objects, 2001; simd/epa8.h), until it holds
// the ball. EPA comes near to a curved surface by many points. Here none are needed where the overlap is least: around
// a local minimum n* it is proven by the second derivatives that no direction up to an angle has a lesser overlap than
// r (query/swept/descend.c), and the point r n* / cos(angle), though it is not of the body, stands for that: along any
// direction in which it is at least r away, the overlap is at least r. So where the polytope of all points holds the
// ball of radius r, so does the difference body.
//
// The surface is closed by its construction, and each of its triangles has the origin behind it beyond rounding, so it
// winds around the origin. Along its normal, as that was computed, all of a triangle is as far as its apex to 1100 u s
// (exact/epa_lanes.h), s at most twice the size as the angles are limited: below 6 claims of 384 u.
#include "query/swept/enclose.h"

#include "exact/epa_lanes.h"
#include "pair/cover.h"
#include "query/swept/divide.h"

enum { DESCENTS = 5 };
// Directions nearer than that to a minimum's lead to it.
#define SAME_COSINE 0.9995

typedef enum enclose_turn { TURN_ON, TURN_ANEW, TURN_LEFT } enclose_turn;

typedef struct enclosure {
    const cores *of;
    least_overlap *least;
    double claim, tolerance;
    double wanted; ///< the ball's radius
    int descents;
    enclose_turn turn;          ///< what ended the growth, if not the ball
    vec3 on_a[EPA8_POINTS + 1]; ///< A's points; NAN of what stands for a minimum
    epa8 lanes;
} enclosure;

static void set_wanted(enclosure *g) { g->wanted = g->least->value - 0.5 * g->tolerance; }

// A point of the difference body, and A's point of it.
typedef struct enclose_point {
    vec3 v, on_a;
} enclose_point;

static enclose_point find_end(const enclosure *g, vec3 n) {
    overlap_ends ends = cores_find_ends(g->of, n);
    return (enclose_point){ends.v, ends.on_a};
}

// The points that stand for a minimum; their number. Of three pieces their own points show more.
static int find_points(const enclosure *g, const least_overlap *at, enclose_point points[3]) {
    double tangent = at->active > 2 ? 0 : least_overlap_find_angle(at, g->wanted);
    if (tangent > 0) {
        points[0].v = vec3_scale(at->of.n, g->wanted * sqrt(1 + tangent * tangent));
        points[0].on_a = (vec3){NAN, NAN, NAN};
        return 1;
    }
    for (int i = 0; i < at->active; i++) {
        points[i].on_a = at->pieces[i].on_a.at;
        points[i].v = vec3_sub(vec3_sub(points[i].on_a, at->pieces[i].on_b.at), g->of->d);
    }
    return at->active;
}

// Of the difference body of B and A, the reverse of that of A and B: what the growth may join as its next point.
static simd_difference offer_point(enclosure *g, enclose_point p, vec3 n) {
    g->on_a[g->lanes.points] = p.on_a;
    return (simd_difference){vec3_dot(n, p.v), -p.v.x, -p.v.y, -p.v.z, g->lanes.points, 0};
}

static void add_point(enclosure *g, enclose_point p) {
    epa8 *to = &g->lanes;
    uint32_t i = to->points++;
    g->on_a[i] = p.on_a;
    to->w[0][i] = -p.v.x, to->w[1][i] = -p.v.y, to->w[2][i] = -p.v.z;
    to->a[i] = i, to->b[i] = 0;
}

// The first tetrahedron: the minimum's points, and others away from it and to the sides.
static void begin(enclosure *g) {
    static const double side[3][2] = {{1, 0}, {-0.5, 0.8660254037844386}, {-0.5, -0.8660254037844386}};
    const patch_plane *of = &g->least->of;
    enclose_point points[3] = {{{0, 0, 0}, {0, 0, 0}}};
    g->lanes.points = 0;
    int count = 1;
    if (g->least->value < INFINITY)
        count = find_points(g, g->least, points);
    else
        points[0] = find_end(g, of->n);
    for (int i = 0; i < count; i++) add_point(g, points[i]);
    // Two points are the ends of an edge, across which the others are.
    if (count == 2) {
        vec3 e = vec3_unit(vec3_cross(vec3_sub(points[1].v, points[0].v), of->n));
        add_point(g, find_end(g, e));
        add_point(g, find_end(g, vec3_neg(e)));
    }
    if (count == 3) add_point(g, find_end(g, vec3_neg(of->n)));
    for (int i = 0; i < 3 && g->lanes.points < EPA8_START; i++) {
        vec3 n = vec3_add_scaled(vec3_scale(of->e[0], side[i][0]), of->e[1], side[i][1]);
        add_point(g, find_end(g, vec3_unit(vec3_add_scaled(n, of->n, 0.5))));
    }
}

// Ends the growth: a gap that parts bodies does.
static simd_difference leave(enclosure *g, enclose_turn turn) {
    g->turn = turn;
    return (simd_difference){INFINITY, 0, 0, 0, 0, 0};
}

// Descends from a direction whose support is no higher than elsewhere, or near to it. 1 if *to is what the growth goes
// on with.
static int descend(enclosure *g, vec3 n, double height, double low, simd_difference *to) {
    least_overlap found;
    enclose_point points[3] = {{{0, 0, 0}, {0, 0, 0}}};
    found.count = 0;
    g->descents++;
    if (!cores_descend(g->of, n, height, &found)) return 0;
    if (!(found.value > 0)) {
        *to = leave(g, TURN_LEFT);
        return 1;
    }
    if (found.value < g->least->value - 0.1 * g->tolerance) {
        *g->least = found;
        *to = leave(g, TURN_ANEW);
        return 1;
    }
    int count = find_points(g, &found, points), best = 0;
    for (int i = 1; i < count; i++)
        if (vec3_dot(points[i].v, n) > vec3_dot(points[best].v, n)) best = i;
    *to = offer_point(g, points[best], vec3_neg(n));
    return -to->gap - low > 0x1p-20 * g->of->size;
}

// What the growth asks for: the farthest point along the nearest face's normal.
static simd_difference find(const void *bodies, vec3 reverse) {
    enclosure *g = (enclosure *)bodies;
    const double low = g->lanes.low[g->lanes.nearest];
    if (low >= g->wanted) return (simd_difference){-low, 0, 0, 0, 0, 0};
    const vec3 n = vec3_neg(reverse);
    const enclose_point end = find_end(g, n);
    double height = vec3_dot(n, end.v);
    simd_difference other;
    // Where the surface is not much farther than the face, there is a minimum near, to which points come slowly.
    int is_less = height < g->least->value - 0.1 * g->tolerance;
    int is_other = !(g->least->value < INFINITY) || vec3_dot(n, g->least->of.n) < SAME_COSINE;
    int is_near = height - low < 0.1 * height && (is_less || height < 1.003 * g->wanted) && is_other;
    if (is_near && g->descents < DESCENTS && descend(g, n, height, low, &other)) return other;
    return offer_point(g, end, reverse);
}

static epa8_end grow(enclosure *g) {
    epa8_query query = {.find = find,
                        .bodies = g,
                        .claim = g->claim,
                        .narrow = g->claim,
                        .near = 2 * 1100 * 0x1p-53 * g->of->size,
                        .most = 4 * EPA8_POINTS};
    query.slack = 16 * 0x1p-53 * g->of->size;
    query.doubt = triangle_compute_doubt(2 * g->of->size, g->claim);
    g->turn = TURN_ON;
    begin(g);
    return epa8_grow(&g->lanes, &query);
}

static vec3 get_point(const enclosure *g, uint32_t i) {
    const epa8 *e = &g->lanes;
    return (vec3){-e->w[0][i], -e->w[1][i], -e->w[2][i]};
}

// The weights of a triangle's corners that give the foot; 0 if one is below 0.
static int find_weights(const vec3 corner[3], vec3 n, vec3 foot, double weight[3]) {
    vec3 a = vec3_sub(corner[0], foot), b = vec3_sub(corner[1], foot), c = vec3_sub(corner[2], foot);
    double of_a = vec3_dot(n, vec3_cross(b, c)), of_b = vec3_dot(n, vec3_cross(c, a)),
           of_c = vec3_dot(n, vec3_cross(a, b)), sum = of_a + of_b + of_c;
    weight[0] = of_a / sum, weight[1] = of_b / sum, weight[2] = of_c / sum;
    return min2(weight[0], min2(weight[1], weight[2])) >= 0;
}

// The foot in a face, as the minimum's points; 0 if it is not in it.
static int take_foot(enclosure *g, uint32_t face, vec3 n, vec3 foot) {
    const uint8_t *v = g->lanes.v[face];
    const vec3 corner[3] = {get_point(g, v[0]), get_point(g, v[1]), get_point(g, v[2])};
    double weight[3];
    if (!find_weights(corner, n, foot, weight)) return 0;
    vec3 on_a = {0, 0, 0}, point = {0, 0, 0};
    for (int k = 0; k < 3; k++) {
        on_a = vec3_add_scaled(on_a, g->on_a[v[k]], weight[k]);
        point = vec3_add_scaled(point, corner[k], weight[k]);
    }
    if (!vec3_is_finite(on_a) || !(vec3_norm(vec3_sub(point, foot)) < 4 * g->claim)) return 0;
    g->least->on_a = on_a;
    g->least->on_b = vec3_sub(vec3_sub(on_a, point), g->of->d);
    return 1;
}

// The nearest face is on the body's surface and nearer than the minimum: it is the least of all. 0 if its foot is not
// found in it or another triangle of its plane.
static int take_face(enclosure *g) {
    const epa8 *e = &g->lanes;
    const uint32_t nearest = e->nearest;
    const vec3 n = {-e->n[0][nearest], -e->n[1][nearest], -e->n[2][nearest]}, foot = vec3_scale(n, -e->gap);
    int is_found = take_foot(g, nearest, n, foot);
    for (uint32_t i = 0; i < EPA8_FACES && !is_found; i++)
        is_found = (e->near[i / 64] >> i % 64 & 1) && take_foot(g, i, n, foot);
    g->least->of = patch_make_plane(n);
    g->least->value = g->least->lowest = -e->gap;
    set_wanted(g);
    return is_found;
}

// Where the overlap may be less than what is wanted, by a surface around the origin whose growth ended: on the way
// along such an n to a point that is as far as wanted, beyond the difference body, a face is passed, of which n.n_f >
// low / wanted. 0 if the surface is none around the origin.
static int find_open(const enclosure *g, direction_caps *open) {
    const epa8 *e = &g->lanes;
    open->count = 0;
    if ((e->alive[0] & e->inward[0]) | (e->alive[1] & e->inward[1])) return 0;
    for (uint32_t i = 0; i < EPA8_FACES; i++) {
        // Planes are known to less than 6 claims.
        const double low = e->low[i] - 6 * g->claim;
        if (!(e->alive[i / 64] >> i % 64 & 1) || low >= g->wanted) continue;
        if (open->count == MOST_CAPS) return 0;
        open->cap[open->count++] = (direction_cap){{-e->n[0][i], -e->n[1][i], -e->n[2][i]}, low / g->wanted - 0x1p-48};
    }
    return 1;
}

// What the growth left.
static int divide_open(const enclosure *g) {
    direction_caps open;
    return find_open(g, &open) && cores_divide(g->of, g->least, g->wanted, &open);
}

int cores_enclose(const cores *p, double claim, double tolerance, least_overlap *at, double *lower) {
    enclosure g;
    // No product of the growth overflows.
    if (!(p->size > 0x1p-100 && p->size < 0x1p100)) return 0;
    g.of = p;
    g.least = at;
    g.claim = claim;
    g.tolerance = tolerance;
    g.descents = 0;
    epa8_end end;
    do {
        set_wanted(&g);
        end = grow(&g);
    } while (g.turn == TURN_ANEW);
    *lower = g.wanted - 7 * claim;
    if (end == EPA8_LEFT && g.turn == TURN_ON && at->value < INFINITY) return divide_open(&g);
    if (end != EPA8_NARROW || g.turn == TURN_LEFT) return 0;
    if (g.lanes.low[g.lanes.nearest] < g.wanted && !take_face(&g)) return 0;
    *lower = g.wanted - 7 * claim;
    return !(g.lanes.alive[0] & g.lanes.inward[0]) && !(g.lanes.alive[1] & g.lanes.inward[1]);
}
