// Gaps and overlaps down to about 1e-28 of the pair's size, in double-double (fine.h).
//
// First GJK again (gjk.c), from the points and the direction that the double search ended with: apart, it ends with a
// direction along which the gap is positive. Where the origin lies on a vertex, an edge or a triangle of the difference
// body, to the rounding of double-doubles, that does not decide the sign: a triangle may be a face or lie inside the
// body. So the search goes on in the directions orthogonal to it (surround): in the difference body, projected along
// the simplices that hold the origin, GJK finds either a direction that supports it there, hence touching, or another
// simplex that holds the origin. At most three such simplices span space; their two to four points are four to six in
// all, E. Steinitz's number (1913), and are the tetrahedron or double pyramid of a proof.
//
// The simplices decide nothing: every claim is measured (fine.c). Cost: some microseconds a step, of which there are
// about ten, and never more than STEPS.
#include "exact/refine.h"

#include "pair/fine.h"
#include "pair/hull_weights.h"
#include "pair/proof.h"

enum { STEPS = 128 };

typedef struct fine_point {
    dd3 w; ///< where the simplex lives: the difference, or its projection
    uint32_t a, b;
} fine_point;

typedef struct fine_simplex {
    fine_point p[4];
    dd weight[4];
    int count;
    dd3 nearest; ///< to the origin
    dd distance;
} fine_simplex;

typedef struct refinement {
    search *s;
    fine_frame f;
    double noise; ///< distances up to this count as zero
    int steps, most;
    int has_points; ///< the upper bound was found by this stage
} refinement;

// --- bounds

static int is_done(const search *s) { return search_is_done(s) || (s->kind == OVOID_PROOF_HULL && s->upper < 0); }

// Measures the gap along n and takes it as lower bound if it is the best so far. An n that is not of unit length shows
// nothing.
static fine_support probe(refinement *r, dd3 n) {
    search *s = r->s;
    if (!(fabs(vec3_norm(dd3_high(n)) - 1) <= 1e-13)) return (fine_support){.gap = {-INFINITY, 0}};
    fine_support found = fine_find_support(&r->f, n);
    double lower = fine_compute_lower(&r->f, found.gap, r->f.claim);
    r->steps++;
    if (!(lower > s->lower)) return found;
    s->lower = lower;
    s->stage = OVOID_STAGE_REFINE;
    s->world = dd3_high(n);
    s->world_low = dd3_low(n);
    return found;
}

// A weight as two doubles >= 0.
static void split_weight(dd weight, double *high, double *low) {
    *high = weight.low < 0 ? nextafter(weight.high, 0) : weight.high;
    *low = (weight.high - *high) + weight.low;
}

// Takes the simplex's nearest point as upper bound; the low half of each weight becomes the weight of a second entry of
// the same pair.
static void take_points(refinement *r, const fine_simplex *points) {
    search *s = r->s;
    double upper = fine_compute_upper(&r->f, points->distance, r->f.claim);
    if (!(upper < s->upper) || points->count > 3) return;
    s->upper = upper;
    s->kind = OVOID_PROOF_POINTS;
    s->stage = OVOID_STAGE_REFINE;
    r->has_points = 1;
    int n = points->count;
    s->witness = (evidence){.count = 2 * n};
    for (int i = 0; i < n; i++) {
        s->witness.p[i] = s->witness.p[n + i] = (difference){dd3_high(points->p[i].w), points->p[i].a, points->p[i].b};
        split_weight(points->weight[i], &s->witness.weight[i], &s->witness.weight[n + i]);
    }
}

static void take_hull(refinement *r, const fine_point *p, int count) {
    search *s = r->s;
    dd3 w[OVOID_PROOF_PAIRS];
    evidence hull = {.count = count};
    for (int i = 0; i < count; i++) {
        w[i] = fine_difference(&r->f, p[i].a, p[i].b);
        hull.p[i] = (difference){dd3_high(w[i]), p[i].a, p[i].b};
    }
    double upper = fine_measure_hull(&r->f, w, count, r->f.claim);
    if (!(upper < 0) || !(upper < s->upper)) return;
    hull_set_weights(w, count, hull.weight);
    s->upper = upper;
    s->kind = OVOID_PROOF_HULL;
    s->stage = OVOID_STAGE_REFINE;
    s->witness = hull;
}

// --- the simplex's nearest point

// The span of orthonormal vectors.
typedef struct subspace {
    dd3 axis[3];
    int dimensions;
} subspace;

static const subspace nothing = {.dimensions = 0};

// The part of v orthogonal to a subspace.
static dd3 across(dd3 v, const subspace *b) {
    for (int i = 0; i < b->dimensions; i++) v = dd3_sub(v, dd3_mul(b->axis[i], dd3_dot(b->axis[i], v)));
    return v;
}

// The nearest point of the affine hull of some points (up to three), if it is inside their hull.
static int find_nearest(const refinement *r, fine_simplex *points) {
    const dd one = {1, 0};
    dd3 p = points->p[0].w;
    points->weight[0] = one;
    points->nearest = p;
    if (points->count > 1) {
        dd3 e1 = dd3_sub(points->p[1].w, p);
        dd ee = dd3_dot(e1, e1), s, t = {0, 0};
        if (!(ee.high > r->noise * r->noise)) return 0;
        if (points->count == 3) {
            // The second edge made orthogonal to the first.
            dd3 e2 = dd3_sub(points->p[2].w, p), f = dd3_sub(e2, dd3_mul(e1, dd_div(dd3_dot(e1, e2), ee)));
            dd ff = dd3_dot(f, f);
            if (!(ff.high > r->noise * r->noise)) return 0;
            t = dd_neg(dd_div(dd3_dot(p, f), ff));
            if (!(t.high > 0)) return 0;
            p = dd3_add_scaled(p, e2, t);
        }
        s = dd_neg(dd_div(dd3_dot(p, e1), ee));
        dd rest = dd_sub(dd_sub(one, s), t);
        if (!(s.high > 0) || !(rest.high > 0)) return 0;
        points->weight[0] = rest, points->weight[1] = s, points->weight[2] = t;
        points->nearest = dd3_add_scaled(p, e1, s);
    }
    points->distance = dd3_norm(points->nearest);
    return 1;
}

// 1 if the origin is inside the tetrahedron or on its surface, as the signs of four determinants have it.
static int is_inside(const fine_simplex *points) {
    static const int faces[4][3] = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}};
    int above = 0, below = 0;
    for (int i = 0; i < 4; i++) {
        double det =
            dd3_dot(points->p[faces[i][0]].w, dd3_cross(points->p[faces[i][1]].w, points->p[faces[i][2]].w)).high;
        above += det >= 0;
        below += det <= 0;
    }
    return above == 4 || below == 4;
}

// Reduces the simplex to its face of fewest points that is nearest to the origin.
static void reduce(const refinement *r, fine_simplex *points) {
    fine_simplex best = {.count = 0, .distance = {INFINITY, 0}};
    for (int size = 1; size <= 3 && best.distance.high > r->noise; size++)
        for (int some = 1; some < 1 << points->count; some++) {
            fine_simplex part = {.count = 0};
            for (int i = 0; i < points->count; i++)
                if (some >> i & 1 && part.count < 4) part.p[part.count++] = points->p[i];
            if (part.count == size && find_nearest(r, &part) && dd_is_less(part.distance, best.distance)) best = part;
        }
    *points = best;
}

// The unit direction to the nearest point, orthogonal to the simplex and to a subspace that holds the origin.
static dd3 find_direction(const fine_simplex *points, const subspace *b) {
    dd3 n = points->nearest;
    subspace own = nothing;
    for (int i = 1; i < points->count; i++) {
        dd3 e = dd3_sub(points->p[i].w, points->p[0].w);
        own.axis[i - 1] = dd3_unit(across(e, &own));
        own.dimensions = i;
    }
    if (points->count == 3) {
        // A triangle's own normal: the nearest point may be as near as its rounding.
        n = dd3_cross(own.axis[0], own.axis[1]);
        if (dd3_dot(n, points->p[0].w).high < 0) n = dd3_neg(n);
    }
    n = dd3_unit(n);
    n = across(across(n, &own), b);
    return dd3_unit(n);
}

static int is_known(const fine_simplex *points, const fine_support *p) {
    for (int i = 0; i < points->count; i++)
        if (points->p[i].a == p->a && points->p[i].b == p->b) return 1;
    return 0;
}

// Adds the difference of a support, projected along a subspace.
static void add(const refinement *r, fine_simplex *points, fine_support p, const subspace *b) {
    dd3 w = across(fine_difference(&r->f, p.a, p.b), b);
    points->p[points->count++] = (fine_point){w, p.a, p.b};
}

// --- GJK

// Probes along the normals of the triangles around the nearest point, where that is so near that its direction is
// rounding.
static void probe_triangles(refinement *r, const fine_simplex *points) {
    for (int left = 0; left < 4 && !is_done(r->s); left++) {
        fine_simplex t = {.count = 0};
        for (int i = 0; i < points->count; i++)
            if (i != left && t.count < 3) t.p[t.count++] = points->p[i];
        if (t.count == 3 && (points->count == 4 || left == 3)) (void)probe(r, find_direction(&t, &nothing));
    }
}

// Runs GJK until the query is answered, or the origin is on or in the simplex, or nothing improves.
static void find_distance(refinement *r, fine_simplex *points) {
    double last = INFINITY;
    while (r->steps < r->most) {
        if (points->count == 4 && is_inside(points)) {
            take_hull(r, points->p, 4);
            if (is_done(r->s)) return;
        }
        fine_simplex all = *points;
        reduce(r, points);
        take_points(r, points);
        if (is_done(r->s) || points->distance.high <= r->noise) return;
        if (!(points->distance.high < last)) {
            probe_triangles(r, &all);
            return;
        }
        last = points->distance.high;
        fine_support p = probe(r, find_direction(points, &nothing));
        if (is_done(r->s)) return;
        if (is_known(points, &p)) {
            probe_triangles(r, &all);
            return;
        }
        add(r, points, p, &nothing);
    }
}

// --- contact

// The first direction orthogonal to a subspace.
static dd3 find_first(const subspace *b, dd3 normal) {
    if (b->dimensions == 2) return dd3_unit(dd3_cross(b->axis[0], b->axis[1]));
    dd3 best = across(normal, b);
    for (int i = 0; i < 3 && vec3_norm(dd3_high(best)) < 0.25; i++)
        best = across(dd3_from((vec3){i == 0, i == 1, i == 2}), b);
    return across(dd3_unit(best), b);
}

// Finds points of the difference body whose projections along a subspace hold the origin, none of them at it. 0 if a
// direction orthogonal to the subspace supports the body at the origin, to rounding, or if no such points are found.
static int surround(refinement *r, const subspace *b, dd3 normal, fine_simplex *points) {
    double last = INFINITY;
    dd3 n = find_first(b, normal);
    points->count = 0;
    while (r->steps < r->most) {
        fine_support p = probe(r, n);
        if (p.gap.high >= -r->noise || is_known(points, &p)) return 0;
        add(r, points, p, b);
        fine_simplex face = *points;
        reduce(r, &face);
        if (points->count == 4 && face.distance.high > r->noise && is_inside(points)) return 1;
        *points = face;
        if (points->distance.high <= r->noise) return points->count > 1;
        if (!(points->distance.high < last) || points->count > 3 - b->dimensions) return 0;
        last = points->distance.high;
        n = find_direction(points, b);
    }
    return 0;
}

// Simplices that hold the origin, each in the space orthogonal to those before; together they span `space`.
typedef struct surrounding {
    subspace space;
    fine_point p[OVOID_PROOF_PAIRS];
    int sizes[3], levels, count;
} surrounding;

static void append(surrounding *c, const fine_simplex *points) {
    for (int i = 0; i < points->count; i++) {
        c->p[c->count++] = points->p[i];
        if (i == 0) continue;
        dd3 e = dd3_unit(across(dd3_sub(points->p[i].w, points->p[0].w), &c->space));
        c->space.axis[c->space.dimensions] = dd3_unit(across(e, &c->space));
        c->space.dimensions++;
    }
    c->sizes[c->levels++] = points->count;
}

// Takes the points as a hull, in the order of a proof: tips first, then the ring.
static void take_surrounding(refinement *r, const surrounding *c) {
    static const uint8_t as_they_are[6] = {0, 1, 2, 3, 4, 5}, tips_last[6] = {3, 4, 0, 1, 2},
                         crossed[6] = {0, 1, 2, 4, 3, 5};
    const uint8_t *order = c->sizes[0] == 3 ? tips_last : c->count == 6 ? crossed : as_they_are;
    fine_point p[OVOID_PROOF_PAIRS];
    for (int i = 0; i < c->count; i++) p[i] = c->p[order[i]];
    take_hull(r, p, c->count);
}

// Whether the difference body lies all around the origin, which is on the simplex.
static void find_side(refinement *r, const fine_simplex *on, dd3 normal) {
    surrounding c = {.space = nothing};
    if (on->count > 1) append(&c, on);
    while (c.space.dimensions < 3) {
        fine_simplex points;
        if (!surround(r, &c.space, normal, &points)) return;
        append(&c, &points);
    }
    take_surrounding(r, &c);
}

// --- the stage

// 1 if something is left to find: the sign near contact, or a bracket that rounding kept a little too wide. Near
// contact one of the bounds is near zero; slivers may have left the other one far off.
static int is_wanted(const search *s) {
    if (search_is_done(s) || s->limit == OVOID_LIMIT_ITERATIONS) return 0;
    if (s->upper < 0 && s->kind != OVOID_PROOF_POINTS) return 0;
    double near = fmin(fabs(s->lower), fabs(s->upper));
    return fmin(near, s->upper - s->lower) <= 0x1p-10 * s->frame->size + 64 * s->frame->hidden;
}

// The double search's points, and the support along its direction.
static void set_start(refinement *r, fine_simplex *points, const fine_support *first) {
    const search *s = r->s;
    *points = (fine_simplex){.distance = {INFINITY, 0}};
    add(r, points, *first, &nothing);
    if (s->kind != OVOID_PROOF_POINTS) return;
    for (int i = 0; i < s->witness.count && points->count < 4; i++) {
        fine_support p = {.a = s->witness.p[i].a, .b = s->witness.p[i].b};
        if (!is_known(points, &p)) add(r, points, p, &nothing);
    }
}

// The upper bound with the weights rounded as the proof states them.
static void state_points(refinement *r) {
    search *s = r->s;
    ovoid_proof proof = {.count = (uint32_t)s->witness.count};
    for (int i = 0; i < s->witness.count; i++) {
        proof.a[i] = s->witness.p[i].a;
        proof.b[i] = s->witness.p[i].b;
        proof.weight_a[i] = proof.weight_b[i] = s->witness.weight[i];
    }
    s->upper = fine_compute_upper(&r->f, fine_measure_points(&r->f, &proof), r->f.claim);
}

static void run(refinement *r) {
    search *s = r->s;
    dd3 normal = dd3_from(frame_direction_to_world(s->frame, s->normal));
    fine_support first = probe(r, normal);
    if (is_done(s)) return;
    fine_simplex points;
    set_start(r, &points, &first);
    find_distance(r, &points);
    // The bodies can only be in contact: their cores touch, or their radii decide nothing.
    if (!is_done(s) && points.distance.high <= 0x1p-40) find_side(r, &points, normal);
}

void refine_run(search *s, const ovoid_pair *pair) {
    refinement r = {.s = s};
    if (!is_wanted(s) || !fine_make(pair, &r.f)) return;
    r.noise = 2 * r.f.claim;
    // The exact methods take at most twice the goal's iterations, all together.
    int64_t left = 2 * (int64_t)s->goal.iterations - (int64_t)s->iterations;
    // The first round and the last round may take a few supports more.
    if (left < 10) return;
    left -= 8;
    r.most = left < STEPS ? (int)left : STEPS;
    run(&r);
    if (r.has_points && s->kind == OVOID_PROOF_POINTS) state_points(&r);
    s->iterations += (uint32_t)r.steps;
    s->limit = is_done(s) ? OVOID_LIMIT_NONE : OVOID_LIMIT_PRECISION;
}
