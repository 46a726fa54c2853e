// Soundness (docs/error-analysis.md): all bounds of the lanes are lowered or raised by FLOAT_CLAIM z and by what B can
// be off its place; they are turned into doubles and out of the couple's unit without rounding.
#include "query/batch_floats.h"

#include "base/compiler.h"
#include "query/batch_supports.h"
#include "query/lane_group.h"

#include <math.h>

void batch_floats_begin(batch_floats *s) {
    s->few.count = s->next.count = 0;
    s->is_wide = s->options->absolute_tolerance == 0 && s->options->relative_tolerance < 0x1p-24;
    s->few.rows.far = s->next.rows.far = (float)(s->goal->far * (1 + 0x1p-22) + 0x1p-126);
    s->few.rows.near = s->next.rows.near = (float)(s->goal->near * (1 - 0x1p-22) - 0x1p-126);
    s->entry.count = 0;
    for (unsigned i = 0; i < FLOAT_QUEUES; i++) s->queues[i].count = 0;
    s->group.blocks = 1;
    s->group.live = 0;
    s->group.most = (float)(s->goal->iterations < 24 ? s->goal->iterations : 24);
    s->used = s->free_count = 0;
}

// The lanes that kernels read for the first `count`.
static unsigned get_end(const float_gjk_kernels *kernels, unsigned count) {
    return (count + kernels->width - 1) & ~(kernels->width - 1);
}

static unsigned get_id(const float_query *q, unsigned k) { return (unsigned)q->id.lane[k]; }
static const float_couple *get_couple(const batch_floats *s, const float_query *q, unsigned k) {
    return &s->couples[get_id(q, k)];
}

// ---- the ends

static void free_couple(batch_floats *s, const float_query *q, unsigned k) {
    s->free[s->free_count++] = (uint8_t)get_id(q, k);
}

// How a couple ended.
typedef struct float_end {
    double lower, upper;
    float size; // s
    ovoid_stage stage;
    uint32_t iterations;
} float_end;

static int is_narrow(const batch_floats *s, const float_end *end) {
    return !s->is_wide &&
           end->upper - end->lower <= options_compute_tolerance(s->options, (double)end->size, OVOID_LENGTH_MIN);
}

// The sign is known, and the query asked for no more.
static void write_verdict(const batch_floats *s, size_t index, const float_end *end) {
    s->verdicts[index] = (ovoid_verdict){
        end->lower > 0 ? OVOID_SEPARATED : OVOID_OVERLAPPING,
        end->stage,
        is_narrow(s, end) ? OVOID_LIMIT_NONE : OVOID_LIMIT_ANSWERED,
        end->iterations,
        end->lower,
        end->upper,
    };
}

// The direction along which a couple's lower bound was found.
static void write_normal(const batch_floats *s, size_t index, const float_column n[3], unsigned k) {
    if (!s->normals) return;
    for (int i = 0; i < 3; i++) s->normals[index][i] = n[i].lane[k];
}

static void write_corners(const batch_floats *s, size_t index, const float_found *found, unsigned k) {
    for (int i = 0; s->corners && i < 4; i++) {
        unsigned id = (unsigned)found->corner[i].lane[k];
        s->corners[index][i][0] = (uint16_t)(id % FLOAT_GJK_POINTS);
        s->corners[index][i][1] = (uint16_t)(id / FLOAT_GJK_POINTS);
    }
}

static void write_end(batch_floats *s, const float_gjk *g, unsigned k, int is_inside) {
    const float_couple *couple = get_couple(s, &g->query, k);
    uint32_t steps = (uint32_t)g->steps.lane[k];
    const float_end end = {
        .lower = (double)(is_inside ? couple->lower : g->lower.lane[k] * couple->unit),
        .upper = (double)(g->upper.lane[k] * couple->unit),
        .size = couple->size,
        .stage = steps > 0 ? OVOID_STAGE_GJK : OVOID_STAGE_SUPPORT,
        .iterations = steps,
    };
    write_verdict(s, couple->index, &end);
    if (is_inside)
        write_corners(s, couple->index, &g->found, k);
    else
        write_normal(s, couple->index, g->n, k);
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

static void find_supports(batch_floats *s, const float_gjk_kernels *kernels) {
    float_gjk *g = &s->group;
    float_bodies bodies;
    for (unsigned rest = g->live; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        const float_couple *couple = get_couple(s, &g->query, k);
        bodies.a[k] = couple->a;
        bodies.b[k] = couple->b;
    }
    batch_supports_find(g, kernels, &bodies);
}

// Advances the group until at most `few` lanes are live.
static void run(batch_floats *s, const float_gjk_kernels *kernels, unsigned few) {
    while (count_lanes(s->group.live) > few) {
        if (!s->group.blocks) find_supports(s, kernels);
        float_ends ends = (s->corners ? kernels->advance_named : kernels->advance)(&s->group);
        end_lanes(s, &s->group, &ends);
    }
}

// The first `count` idle lanes of the group.
static unsigned find_idle(const float_gjk *g, unsigned count) {
    unsigned idle = ~g->live & FLOATS_ALL, found = 0;
    for (; count; count--, idle &= idle - 1) found |= idle & -idle;
    return found;
}

// About the angle between neighbours of a round body with as many vertices as both have.
static float compute_tilt(const float_couple *couple) {
    return 2 / sqrtf((float)(couple->a->vertex_count + couple->b->vertex_count));
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
    if (!g->blocks) {
        for (unsigned rest = lanes; rest; rest &= rest - 1) {
            unsigned k = compiler_count_low_zeros(rest);
            g->given.tilt.lane[k] = compute_tilt(get_couple(s, &g->query, k));
        }
        return;
    }
    for (unsigned k = 0; k < FLOATS; k++) put_points(get_couple(s, &g->query, lanes >> k & 1 ? k : any), &points, k);
    s->kernels->load(&points, lanes, g);
}

// Searches the couples of a queue one by one. The group is idle.
static void search_each(batch_floats *s, float_queue *q) {
    float_points points;
    while (q->count) {
        s->alone->fill(q, 1, &s->group);
        const float_couple *couple = get_couple(s, &s->group.query, 0);
        if (s->group.blocks) {
            put_points(couple, &points, 0);
            s->alone->load(&points, 1, &s->group);
        } else {
            s->group.given.tilt.lane[0] = compute_tilt(couple);
        }
        run(s, s->alone, 0);
    }
}

// Couples of so many eights are searched one by one if they are at most so many: those of more vertices gain more.
static unsigned get_few(uint32_t blocks) { return 2 + blocks / 2; }

// Searches the couples of a queue until less than `least` wait and few lanes are live. The lanes of a group have bodies
// of like sizes. To fill a group when half of it is idle took a tenth longer, as vertices are read for all lanes.
static void search_queue(batch_floats *s, uint32_t blocks, unsigned least) {
    float_queue *q = &s->queues[blocks];
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
    int is_inside = (int)(found->inside >> k & 1);
    const float_end end = {
        .lower = (double)(is_inside ? couple->lower : found->lower.lane[k] * couple->unit),
        .upper = (double)(is_inside ? found->upper.lane[k] * couple->unit : couple->upper),
        .size = couple->size,
        .stage = is_inside ? OVOID_STAGE_INNER : OVOID_STAGE_OUTER,
    };
    write_verdict(s, couple->index, &end);
    if (!is_inside) write_normal(s, couple->index, q->start, k);
    free_couple(s, q, k);
}

static uint32_t get_blocks(const float_couple *couple) {
    uint32_t a = couple->a->padded_count, b = couple->b->padded_count, most = (a > b ? a : b) / 8;
    return most <= FLOAT_GJK_BLOCKS ? most : 0;
}

// Takes the lanes of a query through the ellipsoids to the queues of the search.
static void try_ellipsoids(batch_floats *s, const float_gjk_kernels *kernels, float_query *query, unsigned lanes) {
    float_bounds found;
    float_shapes shapes;
    unsigned any = compiler_count_low_zeros(lanes), end = get_end(kernels, 32 - compiler_count_high_zeros(lanes));
    for (unsigned k = 0; k < end; k++) {
        const float_couple *couple = get_couple(s, query, lanes >> k & 1 ? k : any);
        shapes.a[k] = shape_get_floats(couple->a);
        shapes.b[k] = shape_get_floats(couple->b);
    }
    kernels->ellipsoids(&shapes, lanes, query, &found);
    unsigned ended = found.apart | found.inside, of[FLOAT_QUEUES] = {0};
    for (unsigned rest = ended; rest; rest &= rest - 1) write_bounds(s, query, &found, compiler_count_low_zeros(rest));
    for (unsigned rest = lanes & ~ended; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest);
        of[get_blocks(get_couple(s, query, k))] |= 1u << k;
    }
    for (uint32_t i = 0; i < FLOAT_QUEUES; i++) {
        if (!of[i]) continue;
        kernels->append(query, of[i], &s->queues[i]);
        if (s->queues[i].count >= FLOATS) search_queue(s, i, FLOATS);
    }
}

// Takes the last couples of the entry, in the caller's room. Of one couple the numbers may have been stored just now: a
// load of sixteen would wait for them.
static void try_last(batch_floats *s, float_query *room) {
    float_column *columns = (float_column *)room;
    float_queue *q = &s->entry;
    unsigned count = q->count < FLOATS ? q->count : FLOATS;
    q->count -= count;
    for (int i = 0; i < FLOAT_GIVEN; i++)
        if (count == 1)
            columns[i].lane[0] = q->columns[i][q->count];
        else
            memcpy(columns[i].lane, q->columns[i] + q->count, sizeof columns[i].lane);
    try_ellipsoids(s, count == 1 ? s->alone : s->kernels, room, (1u << count) - 1);
}

// ---- the spheres

static const ovoid_shape *get_shape(const double *row) { return (const void *)row; }

static void write_spheres(const batch_floats *s, const float_block *b, const float_spheres *found, unsigned k) {
    const float_end end = {
        .lower = (double)found->lower.lane[k],
        .upper = (double)found->upper.lane[k],
        .size = found->size.lane[k],
        .stage = OVOID_STAGE_SPHERE,
    };
    write_verdict(s, b->index[k], &end);
}

static void fetch_floats(const double *shape) {
    const char *floats = (const char *)shape_get_floats(get_shape(shape));
    compiler_prefetch(floats);
    compiler_prefetch(floats + 64);
}

// Couples go on to the ellipsoids, at once if they are nearly as many as there are lanes.
static void go_on(batch_floats *s, const float_block *b, const float_spheres *found, float_query *query) {
    const float_gjk_kernels *kernels = b->count == 1 ? s->alone : s->kernels;
    for (unsigned rest = found->open; rest; rest &= rest - 1) {
        unsigned k = compiler_count_low_zeros(rest), id = s->free_count ? s->free[--s->free_count] : s->used++;
        query->id.lane[k] = (float)id;
        s->couples[id] = (float_couple){
            .index = b->index[k],
            .a = get_shape(b->rows.shape_a[k]),
            .b = get_shape(b->rows.shape_b[k]),
            .unit = found->unit.lane[k],
            .lower = found->lower.lane[k],
            .upper = found->upper.lane[k],
            .size = found->size.lane[k],
        };
        fetch_floats(b->rows.shape_a[k]);
        fetch_floats(b->rows.shape_b[k]);
    }
    if (count_lanes(found->open) >= FLOATS - FLOATS / 4) {
        try_ellipsoids(s, kernels, query, found->open);
        return;
    }
    kernels->append(query, found->open, &s->entry);
    if (s->entry.count >= FLOATS) try_last(s, query);
}

static void copy_row(float_rows *to, unsigned at, const float_rows *from, unsigned k) {
    to->pose_a[at] = from->pose_a[k];
    to->pose_b[at] = from->pose_b[k];
    to->shape_a[at] = from->shape_a[k];
    to->shape_b[at] = from->shape_b[k];
    to->extents[at] = from->extents[k];
}

// Takes a block through the spheres. The lanes that are none repeat one of its couples.
static void enter(batch_floats *s, float_block *b) {
    float_query query;
    float_spheres found;
    unsigned all = (1u << b->count) - 1;
    const float_gjk_kernels *kernels = b->count == 1 ? s->alone : s->kernels;
    for (unsigned k = b->count; k < get_end(kernels, b->count); k++) copy_row(&b->rows, k, &b->rows, 0);
    kernels->spheres(&b->rows, all, &query, &found);
    for (unsigned rest = found.apart; rest; rest &= rest - 1)
        write_spheres(s, b, &found, compiler_count_low_zeros(rest));
    for (unsigned rest = all & ~(found.apart | found.open); rest; rest &= rest - 1)
        s->pass_on(s->self, b->index[compiler_count_low_zeros(rest)]);
    if (found.open) go_on(s, b, &found, &query);
    b->count = 0;
}

// ---- couples

// Stands for a body without a shape, whose couple is passed on.
static const ovoid_shape no_shape;

// Finds the couples from `first` on, a block at most, and prefetches what the spheres around the origins read.
static void find_block(const batch_floats *s, size_t first, float_block *b) {
    const ovoid_batch *batch = s->batch;
    size_t left = first < batch->couple_count ? batch->couple_count - first : 0;
    b->count = left < FLOATS ? (unsigned)left : FLOATS;
    for (unsigned k = 0; k < b->count; k++) {
        const ovoid_couple *couple = &batch->couples[first + k];
        const ovoid_posed_shape *one = &batch->bodies[couple->a], *other = &batch->bodies[couple->b];
        const ovoid_shape *shape_a = one->shape ? one->shape : &no_shape;
        const ovoid_shape *shape_b = other->shape ? other->shape : &no_shape;
        compiler_prefetch(shape_a);
        compiler_prefetch(shape_b);
        b->index[k] = first + k;
        b->rows.pose_a[k] = &one->pose.position.x;
        b->rows.pose_b[k] = &other->pose.position.x;
        b->rows.shape_a[k] = (const void *)shape_a;
        b->rows.shape_b[k] = (const void *)shape_b;
    }
}

static void fetch_bodies(const ovoid_batch *batch, size_t first) {
    for (size_t i = first; i < first + FLOATS && i < batch->couple_count; i++) {
        compiler_prefetch(&batch->bodies[batch->couples[i].a]);
        compiler_prefetch(&batch->bodies[batch->couples[i].b]);
    }
}

// 1 for a couple that is for floats.
static int fits(const ovoid_shape *a, const ovoid_shape *b) {
    int is_thin = (a->vertex_count <= 2) | (b->vertex_count <= 2);
    return (a->is_plain & b->is_plain) && !(is_thin && closed_fits(a, b));
}

// The couples that are for floats.
static unsigned find_fit(float_block *b) {
    unsigned fit = 0;
    for (unsigned k = 0; k < b->count; k++) {
        const ovoid_shape *one = get_shape(b->rows.shape_a[k]), *other = get_shape(b->rows.shape_b[k]);
        b->rows.extents[k] = one->extent + other->extent;
        fit |= (unsigned)fits(one, other) << k;
    }
    return fit;
}

// Adds lane k of a block to the few that wait.
static void add(batch_floats *s, const float_block *b, unsigned k) {
    float_block *to = &s->few;
    unsigned at = to->count++;
    to->index[at] = b->index[k];
    copy_row(&to->rows, at, &b->rows, k);
    if (to->count == FLOATS) enter(s, to);
}

void batch_floats_take(batch_floats *s, size_t first) {
    float_block *b = &s->next;
    if (!b->count) find_block(s, first, b);
    unsigned count = b->count, fit = find_fit(b);
    if (fit == (1u << count) - 1) {
        enter(s, b);
    } else {
        for (unsigned k = 0; k < count; k++)
            if (fit >> k & 1)
                add(s, b, k);
            else
                s->pass_on(s->self, b->index[k]);
    }
    find_block(s, first + FLOATS, b);
    fetch_bodies(s->batch, first + 2 * FLOATS);
}

int batch_floats_fit(const ovoid_shape *a, const ovoid_shape *b) {
    return fits(a, b) && a->vertex_count <= FLOAT_GJK_POINTS && b->vertex_count <= FLOAT_GJK_POINTS;
}

void batch_floats_add(batch_floats *s, size_t index, const float_posed_pair *bodies) {
    float_block *to = &s->few;
    unsigned at = to->count++;
    to->index[at] = index;
    to->rows.pose_a[at] = &bodies->pose_a->position.x;
    to->rows.pose_b[at] = &bodies->pose_b->position.x;
    to->rows.shape_a[at] = (const void *)bodies->a;
    to->rows.shape_b[at] = (const void *)bodies->b;
    to->rows.extents[at] = bodies->a->extent + bodies->b->extent;
    if (to->count == FLOATS) enter(s, to);
}

void batch_floats_end(batch_floats *s) {
    float_query room;
    if (s->few.count) enter(s, &s->few);
    if (s->entry.count) try_last(s, &room);
    for (uint32_t blocks = 0; blocks < FLOAT_QUEUES; blocks++)
        if (s->queues[blocks].count) search_queue(s, blocks, 1);
    run(s, s->kernels, 0);
}
