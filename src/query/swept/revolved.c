// Theorem. Let h(n) = P_0(a) + P_1(b) - m x be the overlap of two bodies of revolution, as query/swept/profile.h says,
// and v the least value known. No overlap is less than r <= v where one of these shows it:
// - An end. h is no less than the end's h times cos e and `inside` times sin e together at the angle e from the axis,
//   as it is at the other body's deepest point alone: up to an angle in closed form. What is left is a box of a and b.
// - A cell, a box of a and b with a piece of each body. For any z = t n_0, t = m / x_0, m x <= t - t (n_0 - x_0 w).n,
//   which is linear in a and b. The P are concave there, so that the sum is least at corners of the cell: 4 products.
//   To that comes as much of the square below as leaves the P concave, R / 2 da^2 of a rim of radius R at most. Where
//   one end of each alone leaves it open, the chord cuts off what is closed; else the cell is halved.
// - Around a crossing, where both sides have a line of farthest points: to the line above comes (t / 2) |n - n_0|^2,
//   which is no less than t / (2 (1 + |c|)) (da^2 + db^2). Each P with that and its line bends up to an |a|, and down
//   beyond, so that it is least in the middle or at an end.
// - Around a minimum on the circle across a side, a the kink of that: on the circle, by its angle, h and its second
//   derivative are together at least r where the radius of curvature of P_1 is at least what r leaves of it, so that h
//   - r is convex but for a sine, and nowhere below its minimum. From each point of that arc, -m x falls with a by no
//   more than its slope s there, and P_0 + s a + t / (2 s^2) da^2 is least at the kink or at an end, as above; s is
//   monotone along the arc.
// What is around the minimum is a box of a and b; the cells are those of what is left. Other minima need none of that
// where they are somewhat higher: the error of a cell goes with the square of its size. Where a point that is lower is
// found, the search begins anew there. Left open are minima where a rim meets a rim, one of thirty, and those near to
// them.
//
// Errors, in parts u s as in swept.c: those of profile.h, 260; a factor t is at most 32 times the size and the sine of
// the axes, so that a line is off by 400; chords, ends and values by 100 each; slopes that are none by 200. Together
// they are below what the caller allows: 1400, and half of the tolerance.
#include "query/swept/profile.h"

#include "query/swept/points.h"

enum { MOST_CELLS = 100, MOST_HALVES = 14, MOST_SPOTS = 4, EXTENTS = 6, BOWLS = 6 };
// What is kept of an interval that is too wide, and of a cell that is not halved.
#define NARROWER 0.6
#define KEPT 0.7
// A part of the cell's size that the square of x is at least where its tangent is.
#define OFF_EDGE 0.1
// A slope that is none, as a part of the size.
#define LEVEL 1e-14
// How far beside an end a search begins.
#define BESIDE 0.2
// An end shows nothing up to an angle whose cosine is nearer to 1: its sine is at least 0.02, so that a rounded cosine
// is one of an angle where h is off by 200 u s at most.
#define LEAST_END 0x1p-12

// From end[k][0] to end[k][1].
typedef struct box {
    double end[2][2];
} box;

// Along a and b what is linear, what is subtracted from that, and the square that is 0 at y.
typedef struct tangent {
    double factor[2], most, square, y[2];
} tangent;

typedef struct revolved_search {
    const profiles *q;
    int left;     ///< cells that may be looked at
    double y[2];  ///< of what is lower
    tangent line; ///< at the spot
    int has_line;
} revolved_search;

// ---- cells

// An interval of a or b, and the part at its ends.
typedef struct interval {
    double from, to, first, last;
} interval;

// A piece of each body.
typedef struct cell {
    interval of[2];
} cell;

// At the direction of a and b; before it, where x is less than its `least` square.
COMPILER_INLINED tangent find_tangent(const profiles *q, double a, double b, double least) {
    const double t = (b - q->c * a) * q->scale, square = a * a + t * t, left = 1 - square;
    const double scale = left < least ? sqrt((1 - least) / square) : 1, most = q->m / sqrt(max2(left, least)),
                 aside = most * scale * t * q->scale;
    return (tangent){{most * scale * a - q->c * aside, aside}, most, 0.5 * most * q->lift, {scale * a, scale * b}};
}

COMPILER_INLINED tangent find_tangent_of_cell(const profiles *q, const cell *c) {
    const interval *a = &c->of[0], *b = &c->of[1];
    const double size = min2(2, max2(a->to - a->from, b->to - b->from));
    return find_tangent(q, 0.5 * (a->from + a->to), 0.5 * (b->from + b->to), max2(q->least_square, OFF_EDGE * size));
}

// A part with its line and square at the ends of an interval.
typedef struct end_heights {
    double first, last, least;
} end_heights;

// There is no more of the square than leaves the piece concave.
COMPILER_INLINED end_heights find_heights(const profiles *q, int k, const interval *x, const tangent *line) {
    const profile *f = &q->of[k];
    const double square = min2(line->square, 0.5 * profile_find_rim(f, x->to > f->sine)), factor = line->factor[k],
                 from = x->from - line->y[k], to = x->to - line->y[k];
    const double first = (x->first + factor * x->from) + square * (from * from),
                 last = (x->last + factor * x->to) + square * (to * to);
    return (end_heights){first, last, min2(first, last)};
}

// Cuts off what is closed: there the chord is not below `wanted`, which the lower end is. How much is kept.
COMPILER_INLINED double cut(const profiles *q, int k, interval *x, const end_heights *h, double wanted) {
    const double most = max2(h->first, h->last), kept = min2(1, (wanted - h->least) / (most - h->least)),
                 length = kept * (x->to - x->from);
    if (!(kept < 1)) return 1;
    const int is_last = h->last < h->first;
    const double end = is_last ? x->to - length : x->from + length, part = profile_find_part(q, k, end);
    x->from = is_last ? end : x->from, x->first = is_last ? part : x->first;
    x->to = is_last ? x->to : end, x->last = is_last ? x->last : part;
    return kept;
}

// A cell with its heights, which hold it where their least ones together are not below `wanted`.
typedef struct measured_cell {
    cell of;
    end_heights height[2];
    double wanted;
} measured_cell;

COMPILER_INLINED void measure_cell(const profiles *q, measured_cell *c) {
    const tangent line = find_tangent_of_cell(q, &c->of);
    for (int k = 0; k < 2; k++) c->height[k] = find_heights(q, k, &c->of.of[k], &line);
    c->wanted = q->low + line.most;
}

static held hold_cell(revolved_search *s, measured_cell *c, int halves);

// NOLINTNEXTLINE(misc-no-recursion): no cell is halved more than MOST_HALVES times
static held halve(revolved_search *s, const cell *c, int halves) {
    const profiles *q = s->q;
    double middle[2], part[2];
    for (int k = 0; k < 2; k++) {
        middle[k] = 0.5 * (c->of[k].from + c->of[k].to);
        part[k] = profile_find_part(q, k, middle[k]);
    }
    const double t = (middle[1] - q->c * middle[0]) * q->scale, square = 1 - (middle[0] * middle[0] + t * t);
    if (square >= 0 && part[0] + part[1] - q->m * sqrt(square) < q->low) {
        s->y[0] = middle[0], s->y[1] = middle[1];
        return LOWER;
    }
    if (halves == 0) return OPEN;
    const int k = c->of[0].to - c->of[0].from < c->of[1].to - c->of[1].from;
    measured_cell half[2] = {{.of = *c}, {.of = *c}};
    half[0].of.of[k].to = half[1].of.of[k].from = middle[k];
    half[0].of.of[k].last = half[1].of.of[k].first = part[k];
    // Both before one is asked: neither waits for the other.
    for (int i = 0; i < 2; i++) measure_cell(q, &half[i]);
    const held of_first = hold_cell(s, &half[0], halves - 1);
    return of_first == HELD ? hold_cell(s, &half[1], halves - 1) : of_first;
}

// NOLINTNEXTLINE(misc-no-recursion)
static held hold_cell(revolved_search *s, measured_cell *c, int halves) {
    const profiles *q = s->q;
    for (;;) {
        const end_heights *a = &c->height[0], *b = &c->height[1];
        if (a->least + b->least >= c->wanted) return HELD;
        if (s->left-- <= 0) return OPEN;
        const double kept =
            cut(q, 0, &c->of.of[0], a, c->wanted - b->least) * cut(q, 1, &c->of.of[1], b, c->wanted - a->least);
        if (kept > KEPT) return halve(s, &c->of, halves);
        measure_cell(q, c);
    }
}

static int is_held_by(const profiles *q, const cell *c, const tangent *line) {
    const end_heights a = find_heights(q, 0, &c->of[0], line), b = find_heights(q, 1, &c->of[1], line);
    return a.least + b.least >= q->low + line->most;
}

// The cells of a box: the kinks divide it.
static held hold_box(revolved_search *s, double a0, double a1, double b0, double b1) {
    if (!(a0 < a1 && b0 < b1)) return HELD;
    double at[2][3] = {{a0, a1, a1}, {b0, b1, b1}}, part[2][3];
    int count[2];
    for (int k = 0; k < 2; k++) {
        const double kink = s->q->of[k].sine;
        count[k] = at[k][0] < kink && kink < at[k][1] ? 2 : 1;
        if (count[k] == 2) at[k][1] = kink;
        for (int i = 0; i <= count[k]; i++) part[k][i] = profile_find_part(s->q, k, at[k][i]);
    }
    measured_cell cells[4];
    int open = 0;
    for (int i = 0; i < count[0] * count[1]; i++) {
        const int k = i % count[0], l = i / count[0];
        measured_cell *c = &cells[open];
        c->of = (cell){{{at[0][k], at[0][k + 1], part[0][k], part[0][k + 1]},
                        {at[1][l], at[1][l + 1], part[1][l], part[1][l + 1]}}};
        if (s->has_line && is_held_by(s->q, &c->of, &s->line)) continue;
        measure_cell(s->q, c);
        open++;
    }
    held is = HELD;
    for (int i = 0; i < open && is == HELD; i++) is = hold_cell(s, &cells[i], MOST_HALVES);
    return is;
}

static held hold_around(revolved_search *s, const box *all, const box *inner) {
    const double *a = all->end[0], *b = all->end[1], *c = inner->end[0], *d = inner->end[1];
    held is = hold_box(s, a[0], c[0], b[0], b[1]);
    if (is == HELD) is = hold_box(s, c[1], a[1], b[0], b[1]);
    if (is == HELD) is = hold_box(s, c[0], c[1], b[0], d[0]);
    return is == HELD ? hold_box(s, c[0], c[1], d[1], b[1]) : is;
}

// ---- ends

// The cosine of the angle up to which an end is held; 1 if it is none.
static double find_limit(const profiles *q, int k, int is_up) {
    const profile_end *end = &q->end[k][is_up];
    const double square = end->value * end->value + end->inside * end->inside, left = square - q->low * q->low;
    if (end->value < q->low || !(left >= 0)) return 1;
    const double cosine = (q->low * end->value - end->inside * sqrt(left)) / square;
    return cosine < 1 - LEAST_END ? max2(0, cosine) : 1;
}

static box find_box(const profiles *q) {
    box all;
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 2; i++) all.end[k][i] = (i ? 1 : -1) * find_limit(q, k, i);
    return all;
}

// ---- around a minimum

// A part with a line and a square that is 0 at the kink.
typedef struct lifted_part {
    int k;
    double factor, square;
} lifted_part;

// How far from the kink towards an end it is no less than there; 0 if it falls there.
static int find_extent(const profiles *q, lifted_part p, double end, double *to) {
    const profile *f = &q->of[p.k];
    const double kink = f->sine, sign = end < kink ? -1 : 1, rim = profile_find_rim(f, end > kink), cosine = f->cosine,
                 bend = rim / (cosine * cosine * cosine), at = profile_find_part(q, p.k, kink);
    *to = kink;
    if (2 * p.square < bend) {
        // Down from the kink on, also without the square.
        p.square = 0;
    } else {
        const double slope = profile_find_height(f, end > kink) - q->along[p.k] - rim * kink / cosine + p.factor;
        if (slope * sign < -LEVEL * q->size) return 0;
    }
    double move = end - kink;
    for (int i = 0; i < EXTENTS; i++, move *= NARROWER) {
        if (profile_find_part(q, p.k, kink + move) - at + (p.factor + p.square * move) * move < -LEVEL * q->size)
            continue;
        *to = kink + move;
        return 1;
    }
    return !(fabs(end - kink) > 0);
}

static int hold_crossing(const profiles *q, const tangent *line, const box *all, box *inner) {
    for (int k = 0; k < 2; k++)
        for (int i = 0; i < 2; i++)
            if (!find_extent(q, (lifted_part){k, line->factor[k], line->square}, all->end[k][i], &inner->end[k][i]))
                return 0;
    return 1;
}

// The arc of a circle on which h is no less than at its minimum, and what is on both sides of that.
typedef struct arc {
    const profiles *q;
    const profile_spot *spot;
    profile_turn end[2]; ///< as b grows
} arc;

// Is a tangent there as steep as is allowed at most?
static int is_off_edge(const profiles *q, int k, profile_turn at) {
    const double x = q->of[k].cosine * at.s;
    return at.s > 0 && x * x > q->least_square;
}

// The radius of curvature of a rim on the circle, less what is left of r, times rho^3: where it is not below 0, h - r
// is convex but for a sine, else concave.
static double find_bend(const profiles *q, double a, double b, double rim, double left) {
    const double rho = profile_find_rho(b);
    return rim * ((q->c * q->c + a * a) - a * q->c * ((3 - b * b) * b)) - left * (rho * rho * rho);
}

// Is h no less than at the minimum between that and another direction of the circle? The radius of curvature is
// monotone there, so that h - r is convex from the minimum on, as it is at that, and then concave.
static int is_bowl(const arc *r, profile_turn at) {
    const profiles *q = r->q;
    const profile_spot *spot = r->spot;
    const int k = spot->k, other = 1 - k;
    const double a = q->of[k].sine, b = spot->y[other], end = profile_find_other(q, k, at), c = q->c;
    if ((a * b - c) * (a * end - c) < 0 || (c * b - a) * (c * end - a) < 0) return 0;
    const double rim = profile_find_rim(&q->of[other], spot->is_up), part = profile_find_part(q, k, a),
                 height = profile_find_height(&q->of[other], spot->is_up) - q->along[other],
                 left = q->value - part - height * (a * c);
    return find_bend(q, a, end, rim, left) >= 0 ||
           part + profile_find_part(q, other, end) - q->m * q->of[k].cosine * at.s >= q->value;
}

// The end of the arc towards lesser or greater b, at most to `limit`.
static profile_turn find_arc_end(const arc *r, int is_last, double limit) {
    static const profile_turn turns[BOWLS] = {{0.5403, 0.84147},  {0.82534, 0.56464}, {0.93937, 0.34290},
                                              {0.97922, 0.20280}, {0.99291, 0.11887}, {0.99760, 0.06924}};
    const profiles *q = r->q;
    const profile *f = &q->of[r->spot->k];
    const profile_turn from = r->spot->at;
    const double c = (limit - q->c * f->sine) * q->scale / f->cosine, sign = is_last ? -1 : 1;
    if (is_last ? c <= from.c : c >= from.c) return from;
    const profile_turn whole = {c, sqrt(max2(0, 1 - c * c))};
    if (is_off_edge(q, r->spot->k, whole) && is_bowl(r, whole)) return whole;
    for (int i = 0; i < BOWLS; i++) {
        const double sine = sign * turns[i].s;
        const profile_turn to = profile_unit(from.c * turns[i].c - from.s * sine, from.s * turns[i].c + from.c * sine);
        if (is_last ? to.c > c : to.c < c) continue;
        if (is_off_edge(q, r->spot->k, to) && is_bowl(r, to)) return to;
    }
    return from;
}

// The slope of -m x by a on the circle across the side of k.
static double find_slope(const profiles *q, int k, profile_turn at) {
    const profile *f = &q->of[k];
    return q->m * (q->s * f->sine - q->c * f->cosine * at.c) * q->scale / (f->cosine * at.s);
}

static int hold_side(const profiles *q, const profile_spot *spot, const box *all, box *inner) {
    const int k = spot->k, other = 1 - k;
    const double kink = q->of[other].sine;
    if (!is_off_edge(q, k, spot->at)) return 0;
    arc r = {q, spot, {{0, 0}}};
    r.end[0] = find_arc_end(&r, 0, spot->is_up ? max2(all->end[other][0], kink) : all->end[other][0]);
    r.end[1] = find_arc_end(&r, 1, spot->is_up ? all->end[other][1] : min2(all->end[other][1], kink));
    for (int i = 0; i < EXTENTS; i++) {
        const double first = find_slope(q, k, r.end[0]), last = find_slope(q, k, r.end[1]);
        const double most = r.end[0].c * r.end[1].c < 0 ? 1 : max2(r.end[0].s, r.end[1].s);
        const double square = 0.5 * q->m * q->scale * q->scale / (q->of[k].cosine * most);
        const int is_held =
            find_extent(q, (lifted_part){k, max2(first, last), square}, all->end[k][0], &inner->end[k][0]) &&
            find_extent(q, (lifted_part){k, min2(first, last), square}, all->end[k][1], &inner->end[k][1]);
        for (int j = 0; j < 2; j++) inner->end[other][j] = profile_find_other(q, k, r.end[j]);
        if (is_held) return 1;
        for (int j = 0; j < 2; j++) r.end[j] = profile_unit(r.end[j].c + spot->at.c, r.end[j].s + spot->at.s);
    }
    return 0;
}

// ---- all

held revolved_hold(profiles *q, const profile_spot *spot, double lower[2]) {
    revolved_search s = {.q = q, .left = MOST_CELLS};
    q->value = spot->value;
    q->low = spot->value - 0.5 * q->tolerance;
    if (!(q->low > 0)) return OPEN;
    const box all = find_box(q);
    box inner = {{{all.end[0][1], all.end[0][1]}, {all.end[1][1], all.end[1][1]}}};
    const double t = (spot->y[1] - q->c * spot->y[0]) * q->scale;
    s.has_line = spot->kind != PROFILE_END && 1 - (spot->y[0] * spot->y[0] + t * t) > q->least_square;
    if (s.has_line) s.line = find_tangent(q, spot->y[0], spot->y[1], q->least_square);
    switch (spot->kind) {
    case PROFILE_END:
        if (fabs(all.end[spot->k][spot->is_up]) >= 1) return OPEN;
        break;
    case PROFILE_SIDE:
        if (!hold_side(q, spot, &all, &inner)) return OPEN;
        break;
    case PROFILE_CROSSING:
        if (!s.has_line || !hold_crossing(q, &s.line, &all, &inner)) return OPEN;
        break;
    }
    const held is = hold_around(&s, &all, &inner);
    lower[0] = s.y[0], lower[1] = s.y[1];
    return is;
}

// The points, of which those are chosen that are one above the other.
static int set_points(const cores *p, const profile_spot *spot, least_overlap *at) {
    const vec3 n = at->of.n;
    const overlap_ends ends = cores_find_ends(p, n);
    const double doubt = FRAME_REJECT * p->size;
    at->value = vec3_dot(n, ends.v);
    const vec3 way = vec3_add_scaled(p->d, n, at->value);
    at->on_a = spot->k == 0 || spot->kind == PROFILE_CROSSING ? vec3_add(ends.on_b, way) : ends.on_a;
    if (spot->kind == PROFILE_CROSSING)
        at->on_a = points_find_crossing(ends.on_a, points_find_line(p->a, n), at->on_a,
                                        points_find_line(p->b, vec3_neg(n)), n);
    at->on_b = vec3_sub(at->on_a, way);
    // Of a line along another one, or of two discs, the farthest points are many.
    if (points_move_in(p->a, &at->on_a, doubt)) at->on_b = vec3_sub(at->on_a, way);
    if (points_move_in(p->b, &at->on_b, doubt)) at->on_a = vec3_add(at->on_b, way);
    return fabs(at->value - spot->value) <= doubt && !points_move_in(p->a, &at->on_a, doubt);
}

// A direction beside an end that is no minimum, on the side on which the overlap falls.
static vec3 leave_end(const cores *p, int k, vec3 n) {
    const overlap_ends ends = cores_find_ends(p, n);
    const vec3 way = k == 0 ? vec3_add(ends.on_b, p->d) : vec3_sub(p->d, ends.on_a);
    return vec3_unit(vec3_add_scaled(n, vec3_unit(vec3_add_scaled(way, n, -vec3_dot(way, n))), BESIDE));
}

static int is_revolved(const ovoid_swept_sphere *s) {
    return s->core == OVOID_SWEPT_CYLINDER || s->core == OVOID_SWEPT_CONE;
}

int cores_are_revolved(const cores *p) { return is_revolved(p->a) && is_revolved(p->b); }

int cores_search_revolved(const cores *p, double tolerance, least_overlap *at) {
    profiles q;
    profile_spot spot;
    held is = OPEN;
    at->value = INFINITY;
    if (!profiles_make(p, tolerance, &q)) {
        if (profiles_search_parallel(p, &spot, &at->of.n) && set_points(p, &spot, at)) return 1;
        at->value = INFINITY;
        return 0;
    }
    if (!profiles_find_spot(&q, &spot)) return 0;
    for (int i = 0; i < MOST_SPOTS; i++) {
        double lower[2];
        is = revolved_hold(&q, &spot, lower);
        if (is != LOWER || !profiles_find_spot_near(&q, lower, q.low, &spot)) break;
    }
    at->of.n = profiles_find_direction(&q, spot.y, spot.x);
    if (is == HELD && set_points(p, &spot, at)) return 1;
    if (spot.kind == PROFILE_END) at->of.n = leave_end(p, spot.k, at->of.n);
    at->value = vec3_dot(at->of.n, cores_find_ends(p, at->of.n).v);
    return 0;
}
