// Soundness (docs/error-analysis.md): all bounds of the lanes are lowered or raised by FLOAT_CLAIM z and by what the
// doubles that the lanes' numbers are made of can be off; they are turned into doubles and out of the couple's unit
// without rounding.
#include "query/batch_floats.h"

#include "base/compiler.h"

static void begin(batch_floats *s) {
    s->is_begun = 1;
    s->entry.count = 0;
    for (unsigned i = 0; i < FLOAT_GJK_BLOCKS; i++) s->queues[i].count = 0;
    s->group.blocks = 1;
    s->group.live = 0;
    s->group.most = (float)(s->goal->iterations < 24 ? s->goal->iterations : 24);
    for (unsigned i = 0; i < FLOAT_COUPLES; i++) s->free[i] = (uint8_t)i;
    s->free_count = FLOAT_COUPLES;
}

static unsigned get_id(const float_query *q, unsigned k) { return (unsigned)q->id.lane[k]; }
static const float_couple *get_couple(const batch_floats *s, const float_query *q, unsigned k) {
    return &s->couples[get_id(q, k)];
}

// ---- the ends

static void free_couple(batch_floats *s, const float_query *q, unsigned k) {
    s->free[s->free_count++] = (uint8_t)get_id(q, k);
}

static void write_verdict(const batch_floats *s, const float_couple *couple, const small_end *end) {
    query_goal goal = *s->goal;
    goal.tolerance = couple->tolerance;
    s->verdicts[couple->index] = answer_make_small_verdict(end, &goal);
}

static void write_end(batch_floats *s, const float_gjk *g, unsigned k, int is_inside) {
    const float_couple *couple = get_couple(s, &g->query, k);
    small_end end;
    end.lower = is_inside ? couple->lower : (double)g->lower.lane[k] * couple->unit;
    end.upper = (double)g->upper.lane[k] * couple->unit;
    end.iterations = (uint32_t)g->steps.lane[k];
    end.stage = end.iterations > 0 ? OVOID_STAGE_GJK : OVOID_STAGE_SUPPORT;
    end.kind = is_inside ? OVOID_PROOF_HULL : OVOID_PROOF_POINTS;
    write_verdict(s, couple, &end);
    free_couple(s, &g->query, k);
}

static void end_lanes(batch_floats *s, const float_gjk *g, const float_ends *ends) {
    for (unsigned rest = ends->apart | ends->near; rest; rest &= rest - 1)
        write_end(s, g, compiler_count_low_zeros(rest), 0);
    for (unsigned rest = ends->inside; rest; rest &= rest - 1) write_end(s, g, compiler_count_low_zeros(rest), 1);
    for (unsigned rest = ends->open; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        s->leave_open(s->self, get_couple(s, &g->query, k)->index);
        free_couple(s, &g->query, k);
    }
}

// ---- the search

// Advances the group until at most `few` lanes are live.
static void run(batch_floats *s, const float_gjk_kernels *kernels, unsigned few) {
    while (count_lanes(s->group.live) > few) {
        float_ends ends = kernels->advance(&s->group);
        end_lanes(s, &s->group, &ends);
    }
}

// The first `count` idle lanes of the group.
static unsigned find_idle(const float_gjk *g, unsigned count) {
    unsigned idle = ~g->live & FLOATS_ALL, found = 0;
    for (; count; count--, idle &= idle - 1) found |= idle & -idle;
    return found;
}

static void put_points(const float_couple *couple, float_points *to, unsigned k) {
    to->a[k] = shape_get_float_columns(couple->a);
    to->b[k] = shape_get_float_columns(couple->b);
    to->blocks_a[k] = couple->a->padded_count / 8;
    to->blocks_b[k] = couple->b->padded_count / 8;
}

// Fills idle lanes of the group with the last couples of a queue. The rows of the other lanes repeat one of these.
static void fill(batch_floats *s, float_queue *q) {
    float_gjk *g = &s->group;
    unsigned room = FLOATS - count_lanes(g->live), lanes = find_idle(g, room < q->count ? room : q->count);
    unsigned any = compiler_count_low_zeros(lanes);
    float_points points;
    s->kernels->fill(q, lanes, g);
    for (unsigned k = 0; k < FLOATS; k++) put_points(get_couple(s, &g->query, lanes >> k & 1 ? k : any), &points, k);
    s->kernels->load(&points, lanes, g);
}

// Searches the couples of a queue one by one. The group is idle.
static void search_each(batch_floats *s, float_queue *q) {
    float_points points;
    while (q->count) {
        s->alone->fill(q, 1, &s->group);
        put_points(get_couple(s, &s->group.query, 0), &points, 0);
        s->alone->load(&points, 1, &s->group);
        run(s, s->alone, 0);
    }
}

// Couples of so many eights are searched one by one if they are at most so many: those of more vertices gain more.
static unsigned get_few(uint32_t blocks) { return 2 + blocks / 2; }

// Searches the couples of a queue until less than `least` wait and few lanes are live. The lanes of a group have bodies
// of like sizes. To fill a group when half of it is idle took a tenth longer, as vertices are read for all lanes.
static void search_queue(batch_floats *s, uint32_t blocks, unsigned least) {
    float_queue *q = &s->queues[blocks - 1];
    int is_few = q->count <= get_few(blocks);
    if (s->group.blocks != blocks || is_few) run(s, s->kernels, 0);
    s->group.blocks = blocks;
    if (is_few) search_each(s, q);
    while (q->count >= least) {
        fill(s, q);
        run(s, s->kernels, FLOATS / 4);
    }
}

// ---- the ellipsoids

static void write_bounds(batch_floats *s, const float_query *q, const float_bounds *found, unsigned k) {
    const float_couple *couple = get_couple(s, q, k);
    small_end end;
    int is_inside = (int)(found->inside >> k & 1);
    end.lower = is_inside ? couple->lower : (double)found->lower.lane[k] * couple->unit;
    end.upper = is_inside ? (double)found->upper.lane[k] * couple->unit : couple->upper;
    end.iterations = 0;
    end.stage = is_inside ? OVOID_STAGE_INNER : OVOID_STAGE_OUTER;
    end.kind = is_inside ? OVOID_PROOF_INNER : OVOID_PROOF_POINTS;
    write_verdict(s, couple, &end);
    free_couple(s, q, k);
}

static uint32_t get_blocks(const float_couple *couple) {
    uint32_t a = couple->a->padded_count, b = couple->b->padded_count;
    return (a > b ? a : b) / 8;
}

// Takes the last couples of a queue as a query. Of one couple the numbers may have been stored just now: a load of
// sixteen would wait for them.
static void take_last(float_queue *q, unsigned count, float_query *to) {
    float_column *columns = (float_column *)to;
    q->count -= count;
    if (count == 1)
        for (int i = 0; i < FLOAT_GIVEN; i++) columns[i].lane[0] = q->columns[i][q->count];
    else
        for (int i = 0; i < FLOAT_GIVEN; i++) memcpy(columns[i].lane, q->columns[i] + q->count, sizeof columns[i].lane);
}

// Takes couples through the ellipsoids to the queues of the search.
static void enter(batch_floats *s) {
    float_query query;
    float_bounds found;
    float_shapes shapes;
    unsigned count = s->entry.count < FLOATS ? s->entry.count : FLOATS, all = (1u << count) - 1;
    unsigned of[FLOAT_GJK_BLOCKS] = {0};
    const float_gjk_kernels *kernels = count == 1 ? s->alone : s->kernels;
    take_last(&s->entry, count, &query);
    for (unsigned k = 0; k < (count == 1 ? 1 : FLOATS); k++) {
        const float_couple *couple = get_couple(s, &query, k < count ? k : 0);
        shapes.a[k] = shape_get_floats(couple->a);
        shapes.b[k] = shape_get_floats(couple->b);
        of[get_blocks(couple) - 1] |= 1u << k;
    }
    kernels->ellipsoids(&shapes, all, &query, &found);
    unsigned ended = found.apart | found.inside;
    for (unsigned rest = ended; rest; rest &= rest - 1) write_bounds(s, &query, &found, compiler_count_low_zeros(rest));
    for (uint32_t i = 0; i < FLOAT_GJK_BLOCKS; i++) {
        unsigned open = of[i] & all & ~ended;
        if (!open) continue;
        kernels->append(&query, open, &s->queues[i]);
        if (s->queues[i].count >= FLOATS) search_queue(s, i + 1, FLOATS);
    }
}

// ---- couples

static void put_couple(batch_floats *s, const lane_group *e, unsigned k, const pair8_floats *numbers) {
    float_queue *q = &s->entry;
    const ovoid_shape *a = get_a(e, k)->shape, *b = get_b(e, k)->shape;
    const pair8 *o = e->lanes;
    unsigned at = q->count++, id = s->free[--s->free_count];
    double scale = numbers->scale.lane[k];
    q->columns[FLOAT_NUMBERS][at] = (float)(shape_get_floats(a)->unit * scale);
    q->columns[FLOAT_NUMBERS + 1][at] = (float)(shape_get_floats(b)->unit * scale);
    q->columns[FLOAT_NUMBERS + 2][at] = (float)id;
    float_couple *to = &s->couples[id];
    to->index = e->index[k];
    to->a = a;
    to->b = b;
    to->unit = numbers->unit.lane[k];
    to->lower = o->lower.lane[k];
    to->upper = o->upper.lane[k];
    to->tolerance = o->tolerance.lane[k];
}

void batch_floats_add(batch_floats *s, const lane_group *e, unsigned some, const pair8_floats *numbers) {
    float_queue *q = &s->entry;
    if (!s->is_begun) begin(s);
    if (some == PAIR8_ALL)
        for (int i = 0; i < FLOAT_NUMBERS; i++)
            memcpy(q->columns[i] + q->count, numbers->numbers[i], sizeof numbers->numbers[i]);
    for (unsigned rest = some; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        for (int i = 0; i < FLOAT_NUMBERS && some != PAIR8_ALL; i++) q->columns[i][q->count] = numbers->numbers[i][k];
        put_couple(s, e, k, numbers);
    }
    if (q->count >= FLOATS) enter(s);
}

void batch_floats_end(batch_floats *s) {
    if (!s->is_begun) return;
    if (s->entry.count) enter(s);
    for (uint32_t blocks = 1; blocks <= FLOAT_GJK_BLOCKS; blocks++)
        if (s->queues[blocks - 1].count) search_queue(s, blocks, 1);
    run(s, s->kernels, 0);
}
