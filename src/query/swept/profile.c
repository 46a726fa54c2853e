// Minima of the overlap of two bodies of revolution (query/swept/profile.h) along the axes of their ends, and on the
// circles of directions across their sides: in closed form, and by Newton's method for the angle around the axis.
//
// Where the axes are parallel and D is how far apart they are, h(n) is at least A(a) + B(a) - d.u a - D rho, which it
// is where n is in the plane of the axes. By the angle of n with the axis each piece of that is a sine, which bends
// down where it is above 0: the least h of bodies that overlap is at an end or at a kink.
#include "query/swept/profile.h"

enum { MOST_STEPS = 14 };
// The least sine of the axes, and how far the centres are to be apart across both axes, as a part of the size.
#define LEAST_SINE 0x1p-4
#define LEAST_ACROSS 0x1p-20
// Axes that are that near to one another are parallel.
#define PARALLEL 0x1p-44
// A slope that is none, as a part of the size, and the longest step.
#define LEVEL 1e-14
#define LONGEST 0.7
// The most that a tangent's factor may be, as a part of the size and of the sine of the axes.
#define STEEPEST 32

static profile make_profile(const ovoid_swept_sphere *s) {
    profile f = {.height = s->half[0], .radius = s->half[1], .cosine = 1, .is_cone = s->core == OVOID_SWEPT_CONE};
    if (!f.is_cone) return f;
    const double scale = 1 / sqrt(4 * f.height * f.height + f.radius * f.radius);
    f.sine = f.radius * scale, f.cosine = 2 * f.height * scale;
    return f;
}

// The other body's deepest point along an end is its rim's in the plane of both axes, or its apex.
static profile_end make_end(const profiles *q, int k, int is_up) {
    const profile *f = &q->of[k], *other = &q->of[1 - k];
    const double sign = is_up ? 1 : -1, b = sign * q->c;
    const int is_above = b >= other->sine;
    const double height = profile_find_height(other, is_above), rim = profile_find_rim(other, is_above),
                 aside = q->s * (height - q->along[1 - k]) - rim * b;
    const double radius = f->is_cone && is_up ? 0 : f->radius;
    return (profile_end){f->height + height * b + rim * q->s - sign * (q->along[k] + q->c * q->along[1 - k]),
                         radius - sqrt(aside * aside + q->m * q->m)};
}

int profiles_make(const cores *p, double tolerance, profiles *q) {
    const vec3 u = p->a->axis[0], v = vec3_neg(p->b->axis[0]);
    q->c = vec3_dot(u, v);
    const double square = (1 - q->c) * (1 + q->c);
    if (!(square >= LEAST_SINE * LEAST_SINE)) return 0;
    q->s = sqrt(square);
    q->scale = 1 / q->s, q->lift = 1 / (1 + fabs(q->c));
    q->u = u;
    q->t = vec3_unit(vec3_add_scaled(v, u, -q->c));
    const vec3 w = vec3_cross(u, q->t);
    const double ahead = vec3_dot(p->d, u), aside = vec3_dot(p->d, q->t), across = vec3_dot(p->d, w);
    q->w = across < 0 ? vec3_neg(w) : w;
    q->m = fabs(across);
    q->along[1] = aside * q->scale;
    q->along[0] = ahead - q->c * q->along[1];
    q->size = p->size, q->tolerance = tolerance;
    if (!(q->m > LEAST_ACROSS * p->size)) return 0;
    const double least = q->m * q->scale / (STEEPEST * p->size);
    q->least_square = least * least;
    q->of[0] = make_profile(p->a), q->of[1] = make_profile(p->b);
    for (int i = 0; i < 4; i++) q->end[i >> 1][i & 1] = make_end(q, i >> 1, i & 1);
    return 1;
}

int profiles_search_parallel(const cores *p, profile_spot *to, vec3 *n) {
    const vec3 u = p->a->axis[0], v = vec3_neg(p->b->axis[0]);
    const double sign = copysign(1, vec3_dot(u, v)), along = vec3_dot(p->d, u);
    if (!(vec3_norm(vec3_add_scaled(v, u, -sign)) <= PARALLEL)) return 0;
    const profile of[2] = {make_profile(p->a), make_profile(p->b)};
    const vec3 off = patch_find_across(u, p->d, along, vec3_norm_squared(p->d));
    const double apart = vec3_norm(off), at[4] = {-1, 1, of[0].sine, sign * of[1].sine},
                 rho[4] = {0, 0, of[0].cosine, of[1].cosine};
    int least = 0;
    to->value = INFINITY;
    for (int i = 0; i < 4; i++) {
        const double reach =
                         profile_find_reach(&of[0], at[i], rho[i]) + profile_find_reach(&of[1], sign * at[i], rho[i]),
                     value = reach - along * at[i] - apart * rho[i];
        if (value < to->value) to->value = value, least = i;
    }
    // What has an end there, or a side; A has no end at the apex of a cone.
    to->kind = least < 2 ? PROFILE_END : PROFILE_SIDE;
    to->k = least == 3 || (least == 1 && of[0].is_cone);
    *n = vec3_unit(vec3_add_scaled(vec3_scale(apart > 0 ? vec3_scale(off, 1 / apart) : vec3_orthogonal(u), rho[least]),
                                   u, at[least]));
    return to->value > 0;
}

vec3 profiles_find_direction(const profiles *q, const double y[2], double x) {
    const double t = (y[1] - q->c * y[0]) * q->scale;
    return vec3_unit(vec3_add_scaled(vec3_add_scaled(vec3_scale(q->u, y[0]), q->t, t), q->w, x));
}

// ---- circles

// The part of a circle on which a minimum is: h falls at its first end and rises at its last.
typedef struct circle {
    const profiles *q;
    int k;
    profile_turn from, to;
    int is_up; ///< above the other body's kink
} circle;

// The slope along the circle and the second derivative, as parts of its radius and times a power of rho(b).
typedef struct circle_slope {
    double slope, bend, rho;
} circle_slope;

static inline circle_slope find_slope(const circle *o, profile_turn at, double b, int is_up) {
    const profiles *q = o->q;
    const profile *other = &q->of[1 - o->k];
    const double square = (1 - b) * (1 + b), rho = sqrt(square), rim = profile_find_rim(other, is_up),
                 of_b = (profile_find_height(other, is_up) - q->along[1 - o->k]) * rho - rim * b, move = q->s * at.s;
    return (circle_slope){-of_b * move - q->m * at.c * rho,
                          (q->m * at.s * rho - of_b * q->s * at.c) * square - rim * move * move * q->of[o->k].cosine,
                          rho};
}

// A turn by twice the angle of that tangent.
static inline profile_turn turn_by(profile_turn at, double tangent) {
    const double square = tangent * tangent, scale = 1 / (1 + square), c = (1 - square) * scale,
                 s = 2 * tangent * scale;
    return (profile_turn){c * at.c - s * at.s, c * at.s + s * at.c};
}

// The next direction: by Newton's method, or half way between the ends; at most to the kink.
static inline profile_turn step(circle *o, profile_turn at, circle_slope by, int is_at_kink) {
    const double kink = o->q->of[1 - o->k].sine;
    const double turn = by.bend > 0 ? -by.slope * (by.rho * by.rho) / by.bend : by.slope > 0 ? -LONGEST : LONGEST;
    profile_turn next = turn_by(at, 0.5 * max2(-LONGEST, min2(LONGEST, turn)));
    if (!(o->from.c * next.s > o->from.s * next.c && next.c * o->to.s > next.s * o->to.c)) {
        const double c = o->from.c + o->to.c, s = o->from.s + o->to.s;
        next = c * c + s * s > 1e-4 ? profile_unit(c, s) : (profile_turn){-o->from.s, o->from.c};
    }
    const double past = profile_find_other(o->q, o->k, next) - kink;
    if (o->is_up ? past >= 0 : past <= 0) return next;
    o->is_up = !o->is_up;
    if (is_at_kink) return next;
    const profile *f = &o->q->of[o->k];
    const double c = max2(-1, min2(1, (kink - o->q->c * f->sine) * o->q->scale / f->cosine));
    return (profile_turn){c, sqrt(1 - c * c)};
}

static int take_circle(const circle *o, profile_turn at, double b, int is_crossing, profile_spot *to) {
    const profiles *q = o->q;
    const double a = q->of[o->k].sine;
    to->kind = is_crossing ? PROFILE_CROSSING : PROFILE_SIDE;
    to->k = o->k, to->is_up = o->is_up, to->at = at;
    to->y[o->k] = a, to->y[1 - o->k] = b, to->x = q->of[o->k].cosine * at.s;
    to->value = profile_find_part(q, o->k, a) + profile_find_part(q, 1 - o->k, b) - q->m * to->x;
    return 1;
}

// A minimum on the circle across the side of k. As the angle grows, b falls.
static int search_circle(const profiles *q, int k, profile_turn at, profile_spot *to) {
    circle o = {q, k, {1, 0}, {-1, 0}, profile_find_other(q, k, at) >= q->of[1 - k].sine};
    const double kink = q->of[1 - k].sine, level = LEVEL * q->size;
    for (int i = 0; i < MOST_STEPS; i++) {
        double b = profile_find_other(q, k, at);
        const int is_at_kink = fabs(b - kink) < 1e-15;
        circle_slope by;
        if (is_at_kink) {
            const circle_slope above = find_slope(&o, at, kink, 1), below = find_slope(&o, at, kink, 0);
            if (above.slope <= 0 && below.slope >= 0) return take_circle(&o, at, kink, 1, to);
            o.is_up = above.slope > 0;
            by = o.is_up ? above : below;
        } else {
            by = find_slope(&o, at, b, o.is_up);
            if (fabs(by.slope) <= level * by.rho && by.bend > 0) return take_circle(&o, at, b, 0, to);
        }
        *(by.slope > 0 ? &o.to : &o.from) = at;
        at = step(&o, at, by, is_at_kink);
    }
    return 0;
}

// The direction of the circle that looks to the other body.
static profile_turn find_start(const profiles *q, int k) { return profile_unit(q->s * q->along[1 - k], q->m); }

// ---- all

static void take_ends(const profiles *q, profile_spot *to) {
    to->value = INFINITY;
    for (int i = 0; i < 4; i++) {
        const int k = i >> 1, is_up = i & 1;
        if (!(q->end[k][is_up].value < to->value)) continue;
        to->kind = PROFILE_END;
        to->k = k, to->is_up = is_up;
        to->value = q->end[k][is_up].value;
        to->y[k] = is_up ? 1 : -1;
        to->y[1 - k] = to->y[k] * q->c, to->x = 0;
    }
}

int profiles_find_spot(const profiles *q, profile_spot *to) {
    profile_spot found;
    take_ends(q, to);
    for (int k = 0; k < 2; k++) {
        if (!search_circle(q, k, find_start(q, k), &found)) continue;
        if (found.value < to->value) *to = found;
    }
    return to->value < INFINITY;
}

int profiles_find_spot_near(const profiles *q, const double y[2], double most, profile_spot *to) {
    for (int i = 0; i < 2; i++) {
        // First the circle that is nearer.
        const int k = (fabs(y[1] - q->of[1].sine) < fabs(y[0] - q->of[0].sine)) ^ i;
        const profile *f = &q->of[k];
        const double c = (y[1 - k] - q->c * f->sine) * q->scale / f->cosine, cut = max2(-0.999, min2(0.999, c));
        profile_spot found;
        if (!search_circle(q, k, (profile_turn){cut, sqrt(1 - cut * cut)}, &found) || found.value >= most) continue;
        *to = found;
        return 1;
    }
    return 0;
}
