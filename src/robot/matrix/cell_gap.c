// The least gap of a pair along a fixed direction n over a cell, by a Taylor expansion in the joints' angles about the
// middle of the cell.
//
// Joint i turns by t_i, at most h_i, about the axis a_i through o_i. It moves a point x by t_i a_i x (x - o_i), to
// first order; to second order joints i and j, i above j or the same, by t_i t_j a_i x (a_j x (x - o_j)), half of it
// where they are the same. Along n these are linear in x: t_i (n x a_i) . (x - o_i), t_i t_j ((n x a_i) x a_j) . (x -
// o_j). So a body of vertices x and radius r reaches along n at most
//
//     r + max over x of  n . x + sum h_i |L_i(x)| + sum over i > j of h_i h_j |Q_ij(x)| + sum h_i^2 / 2 max(0, Q_ii(x))
//
// and a sixth of the third derivative. Only vertices that may be the farthest count with what the joints move them, and
// with its direction, not the whole body with all of its way. The derivatives' bounds grow from the item up: where D1,
// D2, D3 bound those by the joints below, one more makes them D1 + h r, D2 + 2 h D1 + h^2 r and
// D3 + 3 h D2 + 3 h^2 D1 + h^3 r, r being the greatest distance of a vertex from its axis in the cell.
//
// Cost: a dot product for each vertex, and one for each term for the few that may be the farthest.
#include "robot/matrix/cell_gap.h"

#include "shape/block.h"

#define UP (1 + 0x1p-40)

// Chains of more joints that turn are bounded to second order, not to third.
enum { QUADRATIC = 8, TERMS = CELL_GAP_TURNS + QUADRATIC * (QUADRATIC + 1) / 2, LANES = 8 };

// A linear function of a vertex in the item's own frame, and by how much of it the vertex moves.
typedef struct gap_term {
    vec3 lever;
    double offset, weight;
} gap_term;

static double find_radius(const cell_gap *g, uint32_t which, const chain_turn *t, double error) {
    const sphere_place *place = &g->w->places[which];
    vec3 center = {place->center[0], place->center[1], place->center[2]}, d = vec3_sub(center, t->from);
    double size = vec3_sum_abs(d) + vec3_sum_abs(center) + vec3_sum_abs(t->from);
    double rounded = cell_items(g->w->cell)[which].shape->lower_radius * (1 - 0x1p-40);
    return ((vec3_norm(vec3_cross(t->axis, d)) + CELL_SLACK * size) + error + (place->reach - rounded)) * UP;
}

static void add_turn(const cell_gap *g, const item_link *link, chain_motion *m) {
    const path_work *w = g->w;
    const cell_item *item = &cell_items(w->cell)[m->item];
    const step_speed *v = &w->speeds[link->step];
    uint32_t child = w->steps[link->step].child;
    chain_turn *t = &m->turns[m->count++];
    *t = (chain_turn){g->middle->axes[link->step], g->middle->frames[child].position, 0.5 * v->turn + v->turn_slack, 0,
                      link->step};
    vec3 position = g->middle->frames[item->frame].position;
    double far = vec3_sum_abs(vec3_sub(position, t->from)) + item->far;
    double error = 2 * frame_error_at(&w->frame_errors[child], far) + w->errors[m->item];
    t->radius = find_radius(g, m->item, t, error) + m->d1;
    double h = t->half, r = t->radius;
    m->d3 = (m->d3 + h * (3 * m->d2 + h * (3 * m->d1 + h * r))) * UP;
    m->d2 = (m->d2 + h * (2 * m->d1 + h * r)) * UP;
    m->d1 = (m->d1 + h * r) * UP;
    // What the term of the first order is off by. A term of the second order, of this joint and itself or one below it,
    // is off by no more than this joint's half way times what the other one's term of the first order is off by.
    double first = h * (2 * error + 0x1p-45 * (item->far + vec3_sum_abs(position) + vec3_sum_abs(t->from)));
    m->rounded = (m->rounded + first) * UP;
    m->slack = (m->slack + (first + h * m->rounded)) * UP;
}

static int sum_chain(const cell_gap *g, uint32_t item, uint32_t count, chain_motion *m) {
    const path_work *w = g->w;
    const item_link *links = w->links + w->first[item];
    m->item = item, m->links = count, m->count = 0;
    m->d1 = m->d2 = m->d3 = m->sliding = m->rounded = m->slack = 0;
    for (uint32_t i = 0; i < count; i++) {
        const step_speed *v = &w->speeds[links[i].step];
        if (v->turn > 0) {
            if (m->count == CELL_GAP_TURNS) return 0;
            add_turn(g, &links[i], m);
        }
        if (v->slide > 0) m->sliding = (m->sliding + (0.5 * v->slide + v->slide_slack)) * UP;
    }
    return 1;
}

int cell_gap_make(cell_gap *g, const path_work *w, const path_state *middle, uint32_t pair) {
    item_pair of = cell_pairs(w->cell)[pair];
    const pair_chain *k = &w->pairs[pair];
    g->w = w, g->middle = middle;
    return sum_chain(g, of.a, k->count_a, &g->a) && sum_chain(g, of.b, k->count_b, &g->b);
}

// ---- along a direction

static double get_remainder(const chain_motion *m) { return m->count > QUADRATIC ? m->d2 / 2 : m->d3 / 6; }

static void make_terms(const cell_gap *g, const chain_motion *m, vec3 n, gap_term *terms) {
    const link_frame *f = &g->middle->frames[cell_items(g->w->cell)[m->item].frame];
    uint32_t count = 0;
    for (uint32_t i = 0; i < m->count; i++) {
        vec3 lever = vec3_cross(n, m->turns[i].axis);
        terms[count++] = (gap_term){mat3_mul_transposed_vec3(f->matrix, lever),
                                    vec3_dot(lever, vec3_sub(f->position, m->turns[i].from)), m->turns[i].half};
    }
    if (m->count > QUADRATIC) return;
    for (uint32_t i = 0; i < m->count; i++)
        for (uint32_t j = 0; j <= i; j++) {
            const chain_turn *t = &m->turns[j];
            vec3 lever = vec3_cross(vec3_cross(n, m->turns[i].axis), t->axis);
            double weight = m->turns[i].half * t->half * (i == j ? 0.5 : 1);
            terms[count++] = (gap_term){mat3_mul_transposed_vec3(f->matrix, lever),
                                        vec3_dot(lever, vec3_sub(f->position, t->from)), weight};
        }
}

static double measure(const gap_term *t, vec3 x) { return vec3_dot(t->lever, x) + t->offset; }

// Vertices side by side, in the item's own frame.
typedef struct vertex_lanes {
    double x[LANES], y[LANES], z[LANES];
} vertex_lanes;

static void measure_lanes(const gap_term *t, const vertex_lanes *v, double along[LANES]) {
    for (uint32_t k = 0; k < LANES; k++)
        along[k] = ((t->lever.x * v->x[k] + t->lever.y * v->y[k]) + t->lever.z * v->z[k]) + t->offset;
}

static void add_sizes(const gap_term *t, const vertex_lanes *v, double sum[LANES]) {
    double along[LANES];
    measure_lanes(t, v, along);
    for (uint32_t k = 0; k < LANES; k++) sum[k] += t->weight * fabs(along[k]);
}

static void add_positive(const gap_term *t, const vertex_lanes *v, double sum[LANES]) {
    double along[LANES];
    measure_lanes(t, v, along);
    for (uint32_t k = 0; k < LANES; k++) sum[k] += t->weight * max2(along[k], 0);
}

// Adds how far the cell moves vertices.
static void add_moves(const gap_term *terms, uint32_t turns, const vertex_lanes *v, double sum[LANES]) {
    for (uint32_t i = 0; i < turns; i++) add_sizes(&terms[i], v, sum);
    if (turns > QUADRATIC) return;
    const gap_term *t = terms + turns;
    for (uint32_t i = 0; i < turns; i++) {
        for (uint32_t j = 0; j < i; j++) add_sizes(t++, v, sum);
        add_positive(t++, v, sum);
    }
}

// A side of a pair along a direction.
typedef struct side {
    const cell_item *item;
    const chain_motion *m;
    gap_term terms[TERMS];
    vec3 along;    ///< the direction, in the item's own frame
    double most;   ///< the farthest that a vertex comes from the frame's origin
    vec3 farthest; ///< that vertex
} side;

// How far the farthest of eight vertices comes in the cell; the lanes need not differ.
static void try_lanes(side *s, const vertex_lanes *v) {
    double sum[LANES];
    measure_lanes(&(gap_term){s->along, 0, 0}, v, sum);
    add_moves(s->terms, s->m->count, v, sum);
    for (uint32_t k = 0; k < LANES; k++) s->most = max2(s->most, sum[k]);
}

static void try_vertex(side *s, vec3 x) {
    vertex_lanes v;
    for (uint32_t k = 0; k < LANES; k++) v.x[k] = x.x, v.y[k] = x.y, v.z[k] = x.z;
    try_lanes(s, &v);
}

// Vertices in the order of the block; eight that come no farther with all of the motion are left. 0: one of them comes
// to the limit, and the others were not tried.
static int try_vertices(side *s, double limit) {
    const ovoid_shape *shape = s->item->shape;
    const double *x = shape_x(shape), *y = shape_y(shape), *z = shape_z(shape);
    double moved = (s->m->d1 + s->m->d2 / 2) * UP + vec3_dot(s->along, shape->origin);
    for (uint32_t i = 0; i < shape->vertex_count; i += LANES) {
        double most = -INFINITY;
        for (uint32_t k = 0; k < LANES; k++)
            most = max2(most, (s->along.x * x[i + k] + s->along.y * y[i + k]) + s->along.z * z[i + k]);
        if (!(most + moved > s->most)) continue;
        vertex_lanes v;
        for (uint32_t k = 0; k < LANES; k++) {
            v.x[k] = x[i + k] + shape->origin.x;
            v.y[k] = y[i + k] + shape->origin.y;
            v.z[k] = z[i + k] + shape->origin.z;
        }
        try_lanes(s, &v);
        if (s->most >= limit) return 0;
    }
    return 1;
}

// The farthest vertex of the shape along a direction of its own frame.
static uint32_t find_support(const ovoid_shape *shape, vec3 n) {
    const double *x = shape_x(shape), *y = shape_y(shape), *z = shape_z(shape);
    double most[LANES];
    uint32_t block[LANES] = {0};
    for (uint32_t k = 0; k < LANES; k++) most[k] = -INFINITY;
    for (uint32_t i = 0; i < shape->vertex_count; i += LANES)
        for (uint32_t k = 0; k < LANES; k++) {
            double along = (n.x * x[i + k] + n.y * y[i + k]) + n.z * z[i + k];
            block[k] = along > most[k] ? i : block[k];
            most[k] = along > most[k] ? along : most[k];
        }
    uint32_t best = 0;
    for (uint32_t k = 1; k < LANES; k++)
        if (most[k] > most[best]) best = k;
    return block[best] + best;
}

// The farthest vertex of the middle along n.
static vec3 begin_side(const cell_gap *g, const chain_motion *m, vec3 n, side *s) {
    s->m = m;
    s->item = &cell_items(g->w->cell)[m->item];
    s->along = mat3_mul_transposed_vec3(g->middle->frames[s->item->frame].matrix, n);
    const ovoid_shape *shape = s->item->shape;
    uint32_t i = find_support(shape, s->along);
    s->farthest = vec3_add((vec3){shape_x(shape)[i], shape_y(shape)[i], shape_z(shape)[i]}, shape->origin);
    s->most = -INFINITY;
    return s->farthest;
}

// How far the item comes along n from the point `from`, at most, when its vertices come `most` from their frame.
static double find_reach(const cell_gap *g, const side *s, vec3 n, vec3 from) {
    const chain_motion *m = s->m;
    vec3 position = g->middle->frames[s->item->frame].position;
    double size = s->item->far + vec3_sum_abs(position) + vec3_sum_abs(from) + (m->d1 + m->d2 / 2);
    double more = (s->item->shape->lower_radius + m->sliding) + (get_remainder(m) + m->slack) + 0x1p-46 * size;
    return (s->most + vec3_dot(n, vec3_sub(position, from))) + more * UP;
}

static double find_gap(const cell_gap *g, vec3 n, const side *a, const side *b) {
    vec3 from = g->middle->frames[a->item->frame].position;
    double reach_a = find_reach(g, a, n, from), reach_b = find_reach(g, b, vec3_scale(n, -1), from);
    return -(reach_a + reach_b) - 0x1p-50 * (fabs(reach_a) + fabs(reach_b));
}

double cell_gap_compute(const cell_gap *g, vec3 n, double needed) {
    side a, b;
    vec3 back = vec3_scale(n, -1);
    a.most = vec3_dot(begin_side(g, &g->a, n, &a), a.along);
    b.most = vec3_dot(begin_side(g, &g->b, back, &b), b.along);
    // What joints move only takes from this.
    if (!(find_gap(g, n, &a, &b) > needed)) return -INFINITY;
    make_terms(g, &g->a, n, a.terms);
    make_terms(g, &g->b, back, b.terms);
    a.most = b.most = -INFINITY;
    try_vertex(&a, a.farthest);
    try_vertex(&b, b.farthest);
    double spare = find_gap(g, n, &a, &b) - needed;
    if (!(spare > 0)) return -INFINITY;
    double limit_a = a.most + spare, limit_b = b.most + spare;
    // Other vertices may come farther by some of what is to spare, and need no closer look then.
    if (spare < INFINITY) a.most += 0.25 * spare, b.most += 0.25 * spare;
    return try_vertices(&a, limit_a) && try_vertices(&b, limit_b) ? find_gap(g, n, &a, &b) : -INFINITY;
}

// ---- by which joints

static void add_shares(const cell_gap *g, const side *s, const cell_gap_shares *to) {
    const path_work *w = g->w;
    const chain_motion *m = s->m;
    for (uint32_t i = 0; i < m->count; i++) {
        const chain_turn *t = &m->turns[i];
        uint32_t variable = w->cell->robot->joint_variable[w->joints[t->step]], value = w->steps[t->step].value;
        double slope = t->half * measure(&s->terms[i], s->farthest);
        to->shares[variable] += fabs(slope) + 0.5 * t->half * (m->d1 + t->half * t->radius);
        to->slopes[variable] += w->other_values[value] < w->values[value] ? -slope : slope;
    }
    const item_link *links = w->links + w->first[m->item];
    for (uint32_t i = 0; i < m->links; i++) {
        double slide = w->speeds[links[i].step].slide;
        if (slide > 0) to->shares[w->cell->robot->joint_variable[w->joints[links[i].step]]] += 0.5 * slide;
    }
}

// A side with the farthest vertex of the middle.
static void move_support(const cell_gap *g, const chain_motion *m, vec3 n, side *s) {
    vec3 support = begin_side(g, m, n, s);
    make_terms(g, m, n, s->terms);
    try_vertex(s, support);
}

void cell_gap_add_shares(const cell_gap *g, vec3 n, const cell_gap_shares *to) {
    side a, b;
    move_support(g, &g->a, n, &a);
    move_support(g, &g->b, vec3_scale(n, -1), &b);
    add_shares(g, &a, to);
    add_shares(g, &b, to);
}
