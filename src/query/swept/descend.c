// A local minimum of the overlap of two cores over the directions: Newton's method for the greatest of several smooth
// functions (R. Fletcher, Practical methods of optimization, 1987, 14.2). h(n) is the greatest of its pieces
// (query/swept/patch.h); near a minimum up to three are as great as h. With n + t for n, t across n, a piece is
// v + g.t + t.H t / 2 + ..., and what is sought is the least of their maximum less h(n) |n + t|. A piece that is found
// to be greater is added, one whose weight is below 0 is dropped.
//
// Around a facet's normal no piece of the rim is smooth: facets are looked at by themselves, in closed form.
#include "query/swept/descend.h"

enum { DESCENT_STEPS = 16 };
// The cosine of the angle within which a facet is looked at.
#define FACET_COSINE 0.94
// The first step at most, and the longest one.
#define FIRST 0.2
#define LONGEST 0.5
#define FAR 2
#define NEAR 0.1
// Tangents of the widest and the narrowest angle that is looked at around a minimum, and of the next one to each.
#define WIDEST 1.5
#define NARROWEST 0.01
#define NARROWER 0.7
#define WIDER 1.2
// The step aside from the axis of a rim.
#define ASIDE 0.05
// Where the descent ends, as parts of the size: the slope, and how far pieces are from equal.
#define FLAT 1e-9
#define EVEN 1e-13

// ---- facets

// A facet whose normal is near n: its number, an axis, or -1; *normal outward.
static int find_facet(const ovoid_swept_sphere *s, vec3 n, vec3 *normal) {
    int count = s->core == OVOID_SWEPT_BOX ? 3 : s->core == OVOID_SWEPT_CYLINDER || s->core == OVOID_SWEPT_CONE;
    for (int k = 0; k < count; k++) {
        double along = vec3_dot(s->axis[k], n);
        if (!(fabs(along) > FACET_COSINE) || (s->core == OVOID_SWEPT_CONE && along > 0)) continue;
        *normal = along < 0 ? vec3_neg(s->axis[k]) : s->axis[k];
        return k;
    }
    return -1;
}

// How far a point is within the edges of the facet, and below 0 beside it.
static double measure_inside(const ovoid_swept_sphere *s, int facet, vec3 y) {
    if (s->core != OVOID_SWEPT_BOX)
        return s->half[1] - vec3_norm(vec3_add_scaled(y, s->axis[0], -vec3_dot(s->axis[0], y)));
    double least = INFINITY;
    for (int k = 0; k < 3; k++)
        if (k != facet) least = min2(least, s->half[k] - fabs(vec3_dot(s->axis[k], y)));
    return least;
}

int least_overlap_add_piece(const cores *p, int is_facet_b, least_overlap *to) {
    const patch_plane *of = &to->of, back = {vec3_neg(of->n), {vec3_neg(of->e[0]), vec3_neg(of->e[1])}};
    piece *with = &to->pieces[0];
    *with = (piece){.weight = 1, .on_a = {.at = to->on_a}, .on_b = {.at = to->on_b}};
    to->count = to->active = 1;
    return is_facet_b ? patch_find(p->a, 0, of, &with->on_a) : patch_find(p->b, 0, &back, &with->on_b);
}

// The minimum along the normal of a facet near n, if the other core's deepest point is over it, and it is not above
// `most`, the overlap along n: else there is another minimum nearby.
static int take_facet(const cores *p, int is_b, vec3 n, double most, least_overlap *to) {
    const ovoid_swept_sphere *x = is_b ? p->b : p->a, *y = is_b ? p->a : p->b;
    vec3 normal;
    int facet = find_facet(x, is_b ? vec3_neg(n) : n, &normal);
    if (facet < 0) return 0;
    vec3 end = patch_find_end(y, vec3_neg(normal), 1);
    vec3 at = is_b ? vec3_sub(end, p->d) : vec3_add(end, p->d);
    double inside = measure_inside(x, facet, at);
    if (!(inside > 0)) return 0;
    double value = x->half[facet] - vec3_dot(normal, at);
    if (value > most) return 0;
    vec3 foot = vec3_add_scaled(at, normal, value);
    *to = (least_overlap){.value = value, .lowest = value, .inside = inside};
    to->of = patch_make_plane(is_b ? vec3_neg(normal) : normal);
    to->on_a = is_b ? end : foot;
    to->on_b = is_b ? foot : end;
    return y->core != OVOID_SWEPT_ELLIPSOID || least_overlap_add_piece(p, is_b, to);
}

// ---- pieces

// Of two pieces with the same one of a core that is measured once. 0 if one is not smooth.
static int measure_piece(const cores *p, least_overlap *at, int i) {
    const patch_plane *of = &at->of, back = {vec3_neg(of->n), {vec3_neg(of->e[0]), vec3_neg(of->e[1])}};
    piece *to = &at->pieces[i];
    int same_a = 0, same_b = 0;
    while (same_a < i && at->pieces[same_a].a != to->a) same_a++;
    while (same_b < i && at->pieces[same_b].b != to->b) same_b++;
    if (same_a < i)
        to->on_a = at->pieces[same_a].on_a;
    else if (!patch_find(p->a, to->a, of, &to->on_a))
        return 0;
    if (same_b < i)
        to->on_b = at->pieces[same_b].on_b;
    else if (!patch_find(p->b, to->b, &back, &to->on_b))
        return 0;
    const patch_form *a = &to->on_a.second, *b = &to->on_b.second;
    to->form = (patch_form){a->xx + b->xx, a->xy + b->xy, a->yy + b->yy};
    vec3 v = vec3_sub(vec3_sub(to->on_a.at, to->on_b.at), p->d);
    to->value = vec3_dot(v, of->n);
    to->g[0] = vec3_dot(v, of->e[0]);
    to->g[1] = vec3_dot(v, of->e[1]);
    return 1;
}

// The piece of that number, or the place of a new one: where there is no room, of the least that is not active.
static int find_place(least_overlap *at, unsigned a, unsigned b, int *is_known) {
    int least = LEAST_PIECES - 1;
    *is_known = 1;
    for (int i = 0; i < at->count; i++) {
        if (at->pieces[i].a == a && at->pieces[i].b == b) return i;
        if (i >= at->active && at->pieces[i].value < at->pieces[least].value) least = i;
    }
    *is_known = 0;
    return at->count < LEAST_PIECES ? at->count++ : least;
}

// Forgets pieces that are too low to be the greatest within a step or two of `reach`.
static void forget_low(least_overlap *at, double reach) {
    const piece *first = &at->pieces[0];
    for (int i = at->active; i < at->count;) {
        const piece *p = &at->pieces[i];
        const double low = first->value - p->value, x = p->g[0] - first->g[0], y = p->g[1] - first->g[1];
        if (low > 0 && low * low > FAR * FAR * reach * reach * (x * x + y * y))
            at->pieces[i] = at->pieces[--at->count];
        else
            i++;
    }
}

typedef enum measured { NOT_SMOOTH, AS_KNOWN, NEW_PIECE } measured;

// Measures the pieces, with the greatest along the direction.
static measured measure_pieces(const cores *p, least_overlap *at) {
    const unsigned a = patch_choose(p->a, at->of.n), b = patch_choose(p->b, vec3_neg(at->of.n));
    int is_known, place = find_place(at, a, b, &is_known);
    if (!is_known) at->pieces[place] = (piece){.a = a, .b = b};
    at->value = -INFINITY;
    for (int i = 0; i < at->count; i++) {
        if (!measure_piece(p, at, i)) return NOT_SMOOTH;
        at->value = max2(at->value, at->pieces[i].value);
    }
    return is_known ? AS_KNOWN : NEW_PIECE;
}

// The point of a hull that is the farthest along m beside one of them, or that itself.
static unsigned find_second(const ovoid_swept_sphere *s, unsigned of, vec3 m) {
    unsigned best = of;
    double most = -INFINITY;
    for (unsigned i = 0; i < s->count; i++) {
        double height = i == of ? -INFINITY : vec3_dot(vec3_at(s->points, i), m);
        best = height > most ? i : best;
        most = max2(height, most);
    }
    return best;
}

// The piece next to the greatest of a core along n, or that itself.
static unsigned find_next(const ovoid_swept_sphere *s, unsigned of, vec3 n) {
    switch (s->core) {
    case OVOID_SWEPT_SEGMENT:
    case OVOID_SWEPT_CYLINDER:
    case OVOID_SWEPT_CONE: return 1 - of;
    case OVOID_SWEPT_BOX: {
        const vec3 m = patch_turn(s, n);
        const double x = s->half[0] * fabs(m.x), y = s->half[1] * fabs(m.y), z = s->half[2] * fabs(m.z);
        return of ^ (x < y ? (x < z ? 1 : 4) : y < z ? 2 : 4);
    }
    case OVOID_SWEPT_POINTS: return find_second(s, of, patch_turn(s, n));
    default: return of;
    }
}

static void begin_pieces(const cores *p, vec3 n, least_overlap *at) {
    const unsigned a = patch_choose(p->a, n), b = patch_choose(p->b, vec3_neg(n));
    const unsigned a2 = find_next(p->a, a, n), b2 = find_next(p->b, b, vec3_neg(n));
    at->count = 0;
    at->pieces[at->count++] = (piece){.a = a, .b = b};
    if (a2 != a) at->pieces[at->count++] = (piece){.a = a2, .b = b};
    if (b2 != b) at->pieces[at->count++] = (piece){.a = a, .b = b2};
    if (a2 != a && b2 != b) at->pieces[at->count++] = (piece){.a = a2, .b = b2};
}

static void exchange_pieces(least_overlap *at, int i, int k) {
    piece kept = at->pieces[i];
    at->pieces[i] = at->pieces[k];
    at->pieces[k] = kept;
}

// Makes the greatest piece the only active one: those of a longer step may not be the ones of a shorter one.
static void start_anew(least_overlap *at) {
    int most = 0;
    for (int i = 1; i < at->count; i++)
        if (at->pieces[i].value > at->pieces[most].value) most = i;
    exchange_pieces(at, 0, most);
    at->active = 1;
}

// Takes a piece's weight; the others share it.
static void drop(least_overlap *at, int i) {
    exchange_pieces(at, i, --at->active);
    at->pieces[at->active].weight = 0;
    double sum = 0;
    for (int k = 0; k < at->active; k++) sum += at->pieces[k].weight = max2(0, at->pieces[k].weight);
    for (int k = 0; k < at->active; k++) at->pieces[k].weight = sum > 0 ? at->pieces[k].weight / sum : 1.0 / at->active;
}

// A piece's second derivatives, of which each is divided by what it may be too large by along steps up to `reach`.
static patch_form add_piece(const piece *x, double weight, double reach) {
    double a = weight / (1 + reach * x->on_a.ratio), b = weight / (1 + reach * x->on_b.ratio);
    return (patch_form){a * x->on_a.second.xx + b * x->on_b.second.xx, a * x->on_a.second.xy + b * x->on_b.second.xy,
                        a * x->on_a.second.yy + b * x->on_b.second.yy};
}

// Of the active pieces the weighted sum.
static patch_form add_forms(const least_overlap *at, double reach) {
    patch_form sum = {0, 0, 0};
    for (int i = 0; i < at->active; i++) {
        const patch_form of = add_piece(&at->pieces[i], at->pieces[i].weight, reach);
        sum.xx += of.xx, sum.xy += of.xy, sum.yy += of.yy;
    }
    return sum;
}

// The same of the pieces as they are here, less the value.
static patch_form add_forms_here(const least_overlap *at) {
    patch_form sum = {-at->value, 0, -at->value};
    for (int i = 0; i < at->active; i++) {
        const piece *x = &at->pieces[i];
        sum.xx += x->weight * x->form.xx, sum.xy += x->weight * x->form.xy, sum.yy += x->weight * x->form.yy;
    }
    return sum;
}

static double find_least_eigenvalue(const patch_form *q) {
    double mean = (q->xx + q->yy) / 2, half = (q->xx - q->yy) / 2;
    return mean - sqrt(half * half + q->xy * q->xy);
}

typedef struct plane_step {
    double x, y;
} plane_step;

static plane_step multiply(const patch_form *q, plane_step t) {
    return (plane_step){q->xx * t.x + q->xy * t.y, q->xy * t.x + q->yy * t.y};
}

static plane_step step_of_one(const least_overlap *at) {
    patch_form q = add_forms_here(at);
    double least = find_least_eigenvalue(&q), wanted = 0.05 * at->value;
    if (least < wanted) q.xx += 0.25 * at->value - least, q.yy += 0.25 * at->value - least;
    double det = q.xx * q.yy - q.xy * q.xy;
    const double *g = at->pieces[0].g;
    return (plane_step){-(q.yy * g[0] - q.xy * g[1]) / det, -(q.xx * g[1] - q.xy * g[0]) / det};
}

// Two pieces stay equal: along the line on which they are, to the least within reach. 0 if a piece was dropped.
static int step_of_two(least_overlap *at, double reach, plane_step *to) {
    piece *p = &at->pieces[0], *q = &at->pieces[1];
    double gx = p->g[0] - q->g[0], gy = p->g[1] - q->g[1], length = sqrt(gx * gx + gy * gy);
    if (!(length > 1e-200)) return drop(at, p->value < q->value ? 0 : 1), 0;
    double fx = gx / length, fy = gy / length, ex = -fy, ey = fx, off = (q->value - p->value) / length;
    patch_form form = add_forms_here(at);
    plane_step t = {off * fx, off * fy}, along = multiply(&form, t), e = multiply(&form, (plane_step){ex, ey});
    double bend = ex * e.x + ey * e.y, slope = ex * (p->g[0] + along.x) + ey * (p->g[1] + along.y);
    double s = bend > 0.05 * at->value ? -slope / bend : slope > 0 ? -LONGEST : LONGEST;
    s = max2(-reach, min2(reach, s));
    t.x += s * ex, t.y += s * ey;
    along = multiply(&form, t);
    double weight = -(fx * (q->g[0] + along.x) + fy * (q->g[1] + along.y)) / length;
    if (!(weight >= 0 && weight <= 1)) return drop(at, weight > 0.5 ? 1 : 0), 0;
    p->weight = weight, q->weight = 1 - weight;
    *to = t;
    return 1;
}

static int step_of_three(least_overlap *at, plane_step *to) {
    piece *p = at->pieces;
    double ax = p[0].g[0] - p[2].g[0], ay = p[0].g[1] - p[2].g[1], bx = p[1].g[0] - p[2].g[0],
           by = p[1].g[1] - p[2].g[1], det = ax * by - ay * bx;
    int least = p[0].weight < p[1].weight ? 0 : 1;
    if (!(fabs(det) > 1e-12 * sqrt((ax * ax + ay * ay) * (bx * bx + by * by)))) return drop(at, least), 0;
    double u = p[2].value - p[0].value, v = p[2].value - p[1].value;
    plane_step t = {(u * by - v * ay) / det, (v * ax - u * bx) / det};
    patch_form form = add_forms_here(at);
    plane_step along = multiply(&form, t);
    double x = -(p[2].g[0] + along.x), y = -(p[2].g[1] + along.y);
    double weight[3] = {(x * by - y * bx) / det, (y * ax - x * ay) / det, 0};
    weight[2] = 1 - weight[0] - weight[1];
    least = 0;
    for (int i = 1; i < 3; i++)
        if (weight[i] < weight[least]) least = i;
    if (!(weight[least] >= 0)) return drop(at, least), 0;
    for (int i = 0; i < 3; i++) p[i].weight = weight[i];
    *to = t;
    return 1;
}

static plane_step step_of_active(least_overlap *at, double reach) {
    plane_step t;
    if (at->active == 3 && step_of_three(at, &t)) return t;
    if (at->active == 2 && step_of_two(at, reach, &t)) return t;
    at->pieces[0].weight = 1;
    return step_of_one(at);
}

// A piece's value after a step, without what is common to all.
static double predict(const piece *p, plane_step t) {
    plane_step along = multiply(&p->form, t);
    return p->value + p->g[0] * t.x + p->g[1] * t.y + 0.5 * (along.x * t.x + along.y * t.y);
}

static plane_step limit_step(plane_step t, double reach) {
    double length = sqrt(t.x * t.x + t.y * t.y), scale = length > reach ? reach / length : 1;
    return (plane_step){scale * t.x, scale * t.y};
}

// The least weight of three pieces whose mean slope is none.
static double find_least_weight(const piece *p, const piece *q, const piece *r) {
    double ax = p->g[0] - r->g[0], ay = p->g[1] - r->g[1], bx = q->g[0] - r->g[0], by = q->g[1] - r->g[1],
           det = ax * by - ay * bx;
    double u = (r->g[1] * bx - r->g[0] * by) / det, v = (r->g[0] * ay - r->g[1] * ax) / det;
    return min2(1 - u - v, min2(u, v));
}

// Makes a piece active, in the place of the one of three without which the least weight is the greatest.
static void add_active(least_overlap *at, int i) {
    const piece *p = at->pieces;
    if (at->active < 3) {
        exchange_pieces(at, i, at->active++);
        return;
    }
    const double left[3] = {find_least_weight(&p[i], &p[1], &p[2]), find_least_weight(&p[0], &p[i], &p[2]),
                            find_least_weight(&p[0], &p[1], &p[i])};
    exchange_pieces(at, i, left[0] > left[1] ? (left[0] > left[2] ? 0 : 2) : left[1] > left[2] ? 1 : 2);
}

// The step to the least of the pieces' maximum, as they are known here.
static plane_step find_step(least_overlap *at, double reach) {
    plane_step t = {0, 0};
    if (at->active == 0) at->active = 1;
    for (int k = 0; k < 2 * LEAST_PIECES; k++) {
        t = limit_step(step_of_active(at, reach), reach);
        int most = 0;
        double now = -INFINITY, other = -INFINITY;
        for (int i = 0; i < at->count; i++) {
            double value = predict(&at->pieces[i], t);
            if (i < at->active)
                now = max2(now, value);
            else if (value > other)
                other = value, most = i;
        }
        if (!(other > now + 1e-14 * at->value)) break;
        add_active(at, most);
    }
    return t;
}

static double measure_slope(const least_overlap *at) {
    double x = 0, y = 0;
    for (int i = 0; i < at->active; i++) {
        x += at->pieces[i].weight * at->pieces[i].g[0];
        y += at->pieces[i].weight * at->pieces[i].g[1];
    }
    return sqrt(x * x + y * y);
}

static void set_points(least_overlap *at) {
    at->on_a = at->on_b = (vec3){0, 0, 0};
    for (int i = 0; i < at->active; i++) {
        at->on_a = vec3_add_scaled(at->on_a, at->pieces[i].on_a.at, at->pieces[i].weight);
        at->on_b = vec3_add_scaled(at->on_b, at->pieces[i].on_b.at, at->pieces[i].weight);
    }
}

static int is_flat(least_overlap *at, double size) {
    at->slope = measure_slope(at);
    at->lowest = INFINITY;
    for (int i = 0; i < at->active; i++) at->lowest = min2(at->lowest, at->pieces[i].value);
    return at->slope <= FLAT * size && at->value - at->lowest <= EVEN * size;
}

int cores_descend(const cores *p, vec3 from, double height, least_overlap *to) {
    vec3 n = from, best = from;
    double least = INFINITY, reach = FIRST, last = FIRST, growth = 2;
    int is_seen[2] = {0, 0}, is_back = 0;
    to->active = 0;
    for (int k = 0; k < DESCENT_STEPS; k++) {
        for (int is_b = 0; is_b < 2; is_b++) {
            vec3 normal;
            if (is_seen[is_b] || find_facet(is_b ? p->b : p->a, is_b ? vec3_neg(n) : n, &normal) < 0) continue;
            is_seen[is_b] = 1;
            if (take_facet(p, is_b, n, min2(height, least) + EVEN * p->size, to)) return 1;
        }
        to->of = patch_make_plane(n);
        if (to->count == 0) begin_pieces(p, n, to);
        measured is = measure_pieces(p, to);
        if (is == NOT_SMOOTH) {
            n = vec3_unit(vec3_add_scaled(n, to->of.e[0], ASIDE));
            continue;
        }
        if (!(to->value > 0)) return 1;
        if (to->value > least + EVEN * p->size && is == AS_KNOWN) {
            reach = 0.3 * last;
            growth = 1.25;
            n = best;
            is_back = 1;
            continue;
        }
        if (to->value < least) least = to->value, best = n;
        if (is_back) start_anew(to);
        is_back = 0;
        plane_step t = find_step(to, reach);
        if (is_flat(to, p->size)) {
            to->inside = 0;
            set_points(to);
            return 1;
        }
        last = sqrt(t.x * t.x + t.y * t.y);
        forget_low(to, max2(last, NEAR));
        reach = min2(LONGEST, max2(reach, growth * last));
        n = vec3_unit(vec3_add_scaled(vec3_add_scaled(n, to->of.e[0], t.x), to->of.e[1], t.y));
    }
    return 0;
}

// ---- how far around it no overlap is less

// With t across n*, n* + t is the direction. Of convex pieces with weights w_i whose mean slope is g at n*, and of
// which the norms that have the second derivatives H_i are |x + y|, |y| <= r |t| |x|: as |x + y| is x' + y' along x and
// at least |y''|^2 / (2 (|x| + |y|)) more, h(n* + t) >= lowest - |g| |t| + t.M t / 2, M the weighted sum of H_i / (1 +
// r |t|). Of two pieces, with G = g_1 - g_2, a part of the weight w of one may go to the one that is farther on the
// side on which t is, which adds that part of w |G.t|; and c x is at least (2 c / tau) x^2 / 2 for x from 0 to tau. h
// along the unit direction is this over |n* + t|, which is at most 1 + t^2 / 2, and 1 + t^2 / (1 + |n* + a|) for a
// tangent that is not below a.
typedef struct angle_ring {
    double from, to; ///< tangents
    double wanted;
    double bent; ///< twice what t^2 is multiplied by, times `wanted`
} angle_ring;

static angle_ring make_ring(double from, double to, double wanted) {
    return (angle_ring){from, to, wanted, from > 0 ? 2 * wanted / (1 + sqrt(1 + from * from)) : wanted};
}

static int is_held(const least_overlap *at, const patch_form *m, const angle_ring *ring) {
    double bend = find_least_eigenvalue(m) - ring->bent, slope = at->slope;
    double most = bend > 0 ? slope * slope / (2 * bend) : slope * ring->to - 0.5 * bend * ring->to * ring->to;
    return at->lowest - ring->wanted >= most;
}

// On the side on which one of two pieces is farther.
static int is_side_held(const least_overlap *at, int farther, const angle_ring *ring) {
    const double reach = ring->to;
    static const double parts[] = {1, 0.3, 0.05};
    const piece *p = &at->pieces[farther], *q = &at->pieces[1 - farther];
    double gx = p->g[0] - q->g[0], gy = p->g[1] - q->g[1], length = sqrt(gx * gx + gy * gy);
    const patch_form of_p = add_piece(p, 1, reach), of_q = add_piece(q, 1, reach);
    for (int i = 0; i < 3 && length > 0; i++) {
        double moved = parts[i] * q->weight, w = p->weight + moved, rest = q->weight - moved,
               kink = 2 * moved / (reach * length);
        patch_form m = {w * of_p.xx + rest * of_q.xx + kink * gx * gx, w * of_p.xy + rest * of_q.xy + kink * gx * gy,
                        w * of_p.yy + rest * of_q.yy + kink * gy * gy};
        if (is_held(at, &m, ring)) return 1;
    }
    return 0;
}

// Of a facet some mean of the pieces rises by how far its point is within on the side of t, and bends as one of them.
static int is_facet_held(const least_overlap *at, double inside, const angle_ring *ring) {
    double bend = 0;
    for (int i = 0; i < at->active; i++) {
        const patch_form m = add_piece(&at->pieces[i], 1, ring->to);
        bend = min2(bend, find_least_eigenvalue(&m) - ring->bent);
    }
    return at->lowest - ring->wanted + ring->to * (inside + 0.5 * bend * ring->to) >= 0;
}

static int is_ring_held(const least_overlap *at, angle_ring ring) {
    if (at->active == 2) return is_side_held(at, 0, &ring) && is_side_held(at, 1, &ring);
    const patch_form m = add_forms(at, ring.to);
    return is_held(at, &m, &ring);
}

// Of a facet: h >= value cos a + inside sin a at the angle a, which is at least the value up to 2 atan(inside / value).
static double find_angle_of_facet(const least_overlap *at, double inside) {
    double tangent = inside / at->value;
    return tangent > 0.5 ? 4.0 / 3 : 2 * tangent / (1 - tangent * tangent);
}

// Three pieces' points make a facet, in which their slopes are their places around the foot: how far this is within; 0
// if it is not.
static double find_inside(const least_overlap *at) {
    double least = INFINITY, most = -INFINITY;
    for (int i = 0; i < 3; i++) {
        const double *a = at->pieces[i].g, *b = at->pieces[(i + 1) % 3].g, x = b[0] - a[0], y = b[1] - a[1];
        double side = (a[0] * y - a[1] * x) / sqrt(x * x + y * y);
        least = min2(least, side), most = max2(most, side);
    }
    return least > 0 ? least : most < 0 ? -most : 0;
}

double least_overlap_find_angle(const least_overlap *at, double wanted) {
    double inside = at->active > 2 ? find_inside(at) : at->inside;
    if (inside > 0 && at->lowest < wanted) return 0;
    if (at->active > 2 && !(inside > 0)) return 0;
    double reach = WIDEST;
    if (inside > 0) {
        reach = 0.999 * find_angle_of_facet(at, inside);
        for (; at->active > 0 && reach < WIDEST; reach *= WIDER) {
            const angle_ring ring = make_ring(reach, reach * WIDER, wanted);
            if (!is_facet_held(at, inside, &ring)) break;
        }
        return reach;
    }
    while (!is_ring_held(at, make_ring(0, reach, wanted)))
        if ((reach *= NARROWER) < NARROWEST) return 0;
    while (reach < WIDEST && is_ring_held(at, make_ring(reach, reach * WIDER, wanted))) reach *= WIDER;
    return reach;
}
