// The search of float_gjk.h in lanes, written once over lanes of floats: simd/floats/scalar.c, avx2.c and avx512.c
// include this. The vertices are columns, and a support is a maximum over them.
#include "simd/kernels/float_gjk.h"
#include "simd/kernels/simplex_step.h"

// The bodies of one side.
typedef struct float_side {
    lane factor;
    const float *const *bodies;
    const uint32_t *own; // eights of each
    int is_uniform;      // 1 if all have as many as the group
} float_side;

// Eight columns, number i of all. Eights beyond a body's own repeat its first.
LANES_INLINE void read_vertices(const float_side *side, uint32_t i, uint32_t blocks, int at, lane c[8]) {
    const float *rows[FLOATS];
    for (int k = at; k < at + LANES; k++) {
        uint32_t own = side->own[k], block = i % blocks;
        uint32_t row = side->is_uniform ? i : i / blocks * own + (block < own ? block : 0);
        rows[k] = side->bodies[k] + 8 * row;
    }
    read_eight(rows, at, c);
    for (int j = 0; j < 8; j++) c[j] = c[j] * side->factor;
}

LANES_INLINE int is_uniform(const uint32_t own[FLOATS], uint32_t blocks, int at) {
    uint32_t differs = 0;
    for (int k = at; k < at + LANES; k++) differs |= own[k] ^ blocks;
    return !differs;
}

// The columns of one body of each couple. Idle lanes that stay idle are overwritten too where no lane is kept.
LANES_INLINE void load_body(float_side *side, const float_column *factors, float_column *to, const float_gjk *s,
                            unsigned lanes) {
    for (int at = 0; has_more(lanes, at); at += LANES) {
        if (!get_lanes(lanes, at)) continue;
        float_places places = get_places(s, lanes, at);
        lane c[8];
        side->factor = get(factors, at);
        side->is_uniform = is_uniform(side->own, s->blocks, at);
        for (uint32_t i = 0; i < 3 * s->blocks; i++) {
            read_vertices(side, i, s->blocks, at, c);
            for (uint32_t j = 0; j < 8; j++) put_new(&to[8 * i + j], at, &places, c[j]);
        }
    }
}

LANES_TARGET static void run_float_load(const float_points *from, unsigned lanes, float_gjk *to) {
    float_side a = {lane_set(0), from->a, from->blocks_a, 0}, b = {lane_set(0), from->b, from->blocks_b, 0};
    load_body(&a, &to->query.factor_a, to->columns.a, to, lanes);
    load_body(&b, &to->query.factor_b, to->columns.b, to, lanes);
}

// ---- supports

LANES_INLINE lane3 get_vertex(const float_column *p, int count, int i, int at) {
    return (lane3){get(&p[i], at), get(&p[count + i], at), get(&p[2 * count + i], at)};
}

LANES_INLINE void take_better(float_support *best, float_support other, int is_least) {
    lane_mask is_better = is_least ? lane_less(other.value, best->value) : lane_greater(other.value, best->value);
    best->value = is_least ? lane_min(other.value, best->value) : lane_top(other.value, best->value);
    best->at = lane3_select(is_better, other.at, best->at);
    best->index = lane_select(is_better, other.index, best->index);
}

LANES_INLINE float_support measure(const float_column *p, int count, int i, lane3 n, int at) {
    lane3 v = get_vertex(p, count, i, at);
    return (float_support){lane3_dot(v, n), v, lane_set(i)};
}

// The greatest of `count` vertices, or the least. Two chains, as each comparison waits for the one before.
LANES_INLINE float_support find_extreme(const float_column *p, int count, lane3 n, int at, int is_least) {
    float_support even = measure(p, count, 0, n, at);
    if (count == 1) return even;
    float_support odd = measure(p, count, 1, n, at);
    for (int i = 2; i < count; i += 2) {
        take_better(&even, measure(p, count, i, n, at), is_least);
        take_better(&odd, measure(p, count, i + 1, n, at), is_least);
    }
    take_better(&even, odd, is_least);
    return even;
}

// ---- rounds

// Adds what a vector of lanes found.
LANES_INLINE void add_ends(float_ends *all, const lane_mask ends[3], lane_mask goes, unsigned live, int at) {
    unsigned apart = lane_bits(ends[0]) & live, near = lane_bits(ends[1]) & live, inside = lane_bits(ends[2]) & live;
    all->apart |= apart << at;
    all->near |= near << at;
    all->inside |= inside << at;
    all->open |= (live & ~(apart | near | inside | lane_bits(goes))) << at;
}

// In the lanes that go on the new corner takes the place of the first that does not stay.
LANES_INLINE void replace_corner(float_gjk *s, int at, const lane_step *step, const float_meeting *m, int has_ids) {
    lane_mask taken = lane_not(step->goes);
    for (int i = 0; i < 3; i++) {
        lane_mask here = lane_and(lane_not(taken), lane_not(step->keeps[i]));
        taken = lane_or(taken, here);
        put_some3(&s->old[3 * i], at, here, m->w);
        if (has_ids) put_some(&s->found.corner[i], at, here, m->id);
        lane_mask stays = lane_or(here, step->keeps[i]), was = lane_sign(get(&s->is_valid[i], at));
        stays = lane_or(lane_and(step->goes, stays), lane_and(lane_not(step->goes), was));
        lane_store_mask(s->is_valid[i].lane + at, stays);
    }
}

LANES_INLINE float_meeting find_meeting(const float_gjk *s, lane3 n, int at, int count) {
    const float_column *a = count == 1 ? s->given.a : s->columns.a, *b = count == 1 ? s->given.b : s->columns.b;
    float_support high_a = find_extreme(a, count, n, at, 0);
    float_support low_b = find_extreme(b, count, turn_to_b(s, n, at), at, 1);
    return meet(s, n, at, high_a, low_b);
}

// What a support shows: the bounds, and the lanes that end by them.
typedef struct lane_bounds {
    lane lower, upper;
    lane_mask apart, near;
} lane_bounds;

// scale: one through the length of the support's direction; distance: of the simplex.
LANES_INLINE lane_bounds test_bounds(const float_gjk *s, int at, const float_meeting *m, const float_simplex *k,
                                     lane scale, lane distance) {
    lane claim = get(&s->query.claim, at), near_to = get(&s->query.near, at);
    lane_bounds b = {.lower = m->gap * scale - claim, .upper = lane3_norm(m->w) + claim};
    b.apart = lane_greater(b.lower, get(&s->query.far, at));
    lane_mask positive = lane_and(lane_greater(b.lower, lane_set(0)), lane_not(b.apart));
    lane_mask near = lane_at_most(b.upper, near_to);
    lane_mask nearer = lane_and(lane_at_most(distance + claim, near_to), lane_not(near));
    b.near = lane_and(positive, near);
    nearer = lane_and(positive, nearer);
    if (lane_bits(nearer) & get_lanes(s->live, at)) {
        lane norm = compute_norm(k->old, k->valid) + claim;
        nearer = lane_and(nearer, lane_at_most(norm, near_to));
        b.near = lane_or(b.near, nearer);
        b.upper = lane_select(nearer, norm, b.upper);
    }
    return b;
}

LANES_INLINE float_simplex get_simplex(const float_gjk *s, int at) {
    float_simplex k;
    for (int i = 0; i < 3; i++) {
        k.old[i] = get3(&s->old[3 * i], at);
        k.valid[i] = lane_sign(get(&s->is_valid[i], at));
    }
    return k;
}

// Of a search. Tilted: supports may be along other directions than the simplex's. Named: the corners' numbers are kept.
typedef enum float_kind { FLOAT_PLAIN, FLOAT_TILTED, FLOAT_NAMED } float_kind;

LANES_INLINE void advance_lanes(float_gjk *s, int at, int count, float_kind kind, float_ends *all) {
    lane3 n = get3(s->n, at);
    unsigned live = get_lanes(s->live, at);
    float_meeting m = find_meeting(s, n, at, count);
    float_simplex k = get_simplex(s, at);
    lane claim = get(&s->query.claim, at), steps = get(&s->steps, at) + lane_set(1);
    lane square = get(&s->square, at), height = get(&s->height, at), inverse = lane_set(1) / lane_sqrt(square);
    lane scale = inverse;
    if (kind == FLOAT_TILTED) scale = lane_set(1) / lane_sqrt(lane3_dot(n, n));
    lane_bounds b = test_bounds(s, at, &m, &k, scale, height * inverse);
    lane_step step = step_lanes(k.old, k.valid, m.w);
    lane_mask goes = lane_not(lane_or(b.apart, b.near)), inside = lane_and(goes, step.inside);
    if (lane_bits(inside) & live) {
        lane depth = measure_tetrahedron(k.old, m.w);
        inside = lane_and(inside, lane_greater(depth, claim));
        b.upper = lane_select(inside, claim - depth, b.upper);
        if (kind == FLOAT_NAMED) put(&s->found.corner[3], at, m.id);
    }
    lane high = lane3_dot(step.n, m.w), norm = lane3_dot(step.n, step.n);
    lane_mask gains = lane_less(high * high * square, height * height * norm);
    // A support that is a corner again gains nothing. A height within the error says nothing of the sign.
    gains = lane_and(gains, is_clear(high, norm, claim));
    gains = lane_and(gains, lane_less(steps, lane_set(s->most)));
    goes = lane_and(goes, lane_from_bits(live));
    step.goes = lane_and(lane_and(goes, lane_not(step.inside)), gains);
    replace_corner(s, at, &step, &m, kind == FLOAT_NAMED);
    put_some3(kind == FLOAT_TILTED ? s->given.heading : s->n, at, step.goes, step.n);
    put(&s->height, at, lane_select(step.goes, high, height));
    put(&s->square, at, lane_select(step.goes, norm, square));
    put(&s->steps, at, steps);
    put(&s->lower, at, b.lower);
    put(&s->upper, at, b.upper);
    if (kind == FLOAT_TILTED) step.goes = choose_direction(s, at, step.goes, lane_and(goes, lane_not(inside)), m.w);
    add_ends(all, (lane_mask[3]){b.apart, b.near, inside}, step.goes, live, at);
}

LANES_INLINE float_ends advance_all(float_gjk *s, int count, float_kind kind) {
    float_ends all = {0, 0, 0, 0};
    for (int at = 0; has_more(s->live, at); at += LANES)
        if (get_lanes(s->live, at)) advance_lanes(s, at, count, kind, &all);
    s->live &= ~(all.apart | all.near | all.inside | all.open);
    return all;
}

// Loops of a known length in vectors; one lane takes as long in those of any length, which are less code.
#if LANES > 1
#define FLOAT_RETURN_OF_BLOCKS(blocks, RUN)                                                                            \
    switch (blocks) {                                                                                                  \
    case 1: return RUN(8);                                                                                             \
    case 2: return RUN(16);                                                                                            \
    case 3: return RUN(24);                                                                                            \
    default: return RUN(32);                                                                                           \
    }
#else
#define FLOAT_RETURN_OF_BLOCKS(blocks, RUN) return RUN(8 * (int)(blocks))
#endif

LANES_TARGET static void run_float_turn(float_gjk *s) {
    for (int at = 0; has_more(s->live, at); at += LANES)
        if (get_lanes(s->live, at)) put3(s->given.b, at, turn_to_b(s, get3(s->n, at), at));
}

LANES_TARGET static float_ends run_float_advance(float_gjk *s) {
    if (!s->blocks) return advance_all(s, 1, FLOAT_TILTED);
#define RUN(count) advance_all(s, count, FLOAT_PLAIN)
    FLOAT_RETURN_OF_BLOCKS(s->blocks, RUN);
#undef RUN
}

LANES_TARGET static float_ends run_float_advance_named(float_gjk *s) {
#define RUN(count) advance_all(s, count, FLOAT_NAMED)
    FLOAT_RETURN_OF_BLOCKS(s->blocks, RUN);
#undef RUN
}

// ---- nearest points

// The simplex, its nearest point's direction and the height along it times its length, |n|^2.
typedef struct float_walk {
    lane3 old[3], n;
    lane id[3], height, square, steps, fresh;
    lane_mask valid[3], live, near, inside;
} float_walk;

// The first support is the simplex, and its direction the next one.
LANES_INLINE float_walk begin_walk(const float_gjk *s, lane_mask some, int at, int count) {
    float_meeting m = find_meeting(s, get3(s->query.translation, at), at, count);
    lane zero = lane_set(0), square = lane3_dot(m.w, m.w);
    lane_mask none = lane_none(), live = lane_and(some, is_clear(square, square, get(&s->query.claim, at)));
    return (float_walk){.old = {m.w, m.w, m.w},
                        .n = m.w,
                        .valid = {live, none, none},
                        .id = {m.id, zero, zero},
                        .height = square,
                        .square = square,
                        .steps = zero,
                        .fresh = zero,
                        .live = live,
                        .near = none,
                        .inside = none};
}

// In the lanes that go on the new corner takes the place of the first that does not stay.
LANES_INLINE void take_walk(float_walk *k, const lane_step *step, const float_meeting *m) {
    lane_mask taken = lane_not(step->goes);
    for (int i = 0; i < 3; i++) {
        lane_mask here = lane_and(lane_not(taken), lane_not(step->keeps[i]));
        taken = lane_or(taken, here);
        k->old[i] = lane3_select(here, m->w, k->old[i]);
        k->id[i] = lane_select(here, m->id, k->id[i]);
        lane_mask stays = lane_or(here, step->keeps[i]);
        k->valid[i] = lane_or(lane_and(step->goes, stays), lane_and(lane_not(step->goes), k->valid[i]));
    }
    k->n = lane3_select(step->goes, step->n, k->n);
}

// A support and a step of all lanes at work. A support that is a corner again ends the search, and so does one that is
// no nearer: whether the corners are the nearest is seen in doubles.
LANES_INLINE void advance_walk(const float_gjk *s, float_walk *k, int at, int count) {
    float_meeting m = find_meeting(s, k->n, at, count);
    lane claim = get(&s->query.claim, at);
    lane_mask known = is_nearest(m.gap, k->height, k->square, claim);
    for (int i = 0; i < 3; i++) {
        lane_mask same = lane_and(lane_at_least(k->id[i], m.id), lane_at_most(k->id[i], m.id));
        known = lane_or(known, lane_and(k->valid[i], same));
    }
    lane_step step = step_lanes(k->old, k->valid, m.w);
    lane high = lane3_dot(step.n, m.w), norm = lane3_dot(step.n, step.n);
    lane_mask inside = lane_and(lane_and(step.inside, lane_not(known)), k->live);
    lane_mask gains = lane_and(lane_less(high * high * k->square, k->height * k->height * norm), lane_not(known));
    lane_mask near = lane_and(lane_not(lane_or(gains, inside)), k->live);
    lane_mask goes = lane_and(lane_and(gains, is_clear(high, norm, claim)), lane_less(k->steps, lane_set(s->most)));
    step.goes = lane_and(lane_and(goes, lane_not(inside)), k->live);
    take_walk(k, &step, &m);
    k->height = lane_select(step.goes, high, k->height);
    k->square = lane_select(step.goes, norm, k->square);
    k->steps = lane_select(step.goes, k->steps + lane_set(1), k->steps);
    k->fresh = lane_select(inside, m.id, k->fresh);
    k->near = lane_or(k->near, near);
    k->inside = lane_or(k->inside, inside);
    k->live = step.goes;
}

LANES_INLINE float_ends approach(float_gjk *s, unsigned lanes, int count) {
    float_ends all = {0, 0, 0, 0};
    for (int at = 0; has_more(lanes, at); at += LANES) {
        unsigned some = get_lanes(lanes, at);
        if (!some) continue;
        float_walk k = begin_walk(s, lane_from_bits(some), at, count);
        while (lane_bits(k.live)) advance_walk(s, &k, at, count);
        put_found(&s->found, at, k.valid, k.id, k.fresh);
        put(&s->found.steps, at, k.steps);
        all.near |= lane_bits(k.near) << at;
        all.inside |= lane_bits(k.inside) << at;
    }
    all.open = lanes & ~(all.near | all.inside);
    return all;
}

LANES_TARGET static float_ends run_float_approach(float_gjk *s, unsigned lanes) {
#define RUN(count) approach(s, lanes, count)
    FLOAT_RETURN_OF_BLOCKS(s->blocks, RUN);
#undef RUN
}
