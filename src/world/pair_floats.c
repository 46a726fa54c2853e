// Pairs without a proof that still answers, asked in single precision, sixteen at a time (query/batch_floats.h), where
// a yes or no is wanted. The proof that is kept of an overlap are the vertices of the tetrahedron that floats found, to
// be measured in doubles (pair_revalidate.c); of bodies that are apart it is the direction.
//
// Rounding: floats prove a gap along the direction n that they have in the axes of A. What they take off is 13 u of z
// more than their roundings hide (docs/error-analysis.md), u = 2^-24, z at least a sixteenth of the pair's size: 2^-25
// of that. Turned into the world in doubles, n is off by 2^-46.
#include "linear/rotation.h"
#include "query/batch_floats.h"
#include "world/step.h"

// The pairs that are asked, by their places in `items`.
typedef struct floats_asking {
    ovoid_world *w;
    world_pair *pairs;
    const uint16_t *items;
    uint16_t open[CHUNK]; // the items that are not answered
    uint32_t open_count;
    ovoid_verdict verdicts[CHUNK]; // UNDECIDED where there is no answer
    float normals[CHUNK][3];
    uint16_t corners[CHUNK][4][2];
    batch_floats floats;
} floats_asking;

static void leave_open(void *self, size_t place) {
    floats_asking *asking = self;
    asking->open[asking->open_count++] = asking->items[place];
}

// ---- asking

// Bodies, shapes and cached answers are scattered in memory.
enum { AHEAD = 24, SHAPES_AHEAD = 12 };

static void prefetch_bodies(const ovoid_world *w, const world_pair *p) {
    compiler_prefetch(&w->bodies[p->a]);
    compiler_prefetch(&w->bodies[p->b]);
}

static void prefetch_shapes(const ovoid_world *w, const world_pair *p) {
    compiler_prefetch(w->bodies[p->a].body.shape);
    compiler_prefetch(w->bodies[p->b].body.shape);
}

static void add(floats_asking *asking, uint32_t place) {
    const ovoid_world *w = asking->w;
    const world_pair *p = &asking->pairs[asking->items[place]];
    const ovoid_body *a = &w->bodies[p->a].body, *b = &w->bodies[p->b].body;
    asking->verdicts[place].status = OVOID_UNDECIDED;
    if (a->shape && b->shape && batch_floats_fit(a->shape, b->shape))
        batch_floats_add(&asking->floats, place, &(float_posed_pair){a->shape, b->shape, &a->pose, &b->pose});
    else
        leave_open(asking, place);
}

static void ask(floats_asking *asking, uint32_t count) {
    const ovoid_world *w = asking->w;
    const world_pair *pairs = asking->pairs;
    const uint16_t *items = asking->items;
    for (uint32_t i = 0; i < count && i < AHEAD; i++) prefetch_bodies(w, &pairs[items[i]]);
    for (uint32_t i = 0; i < count; i++) {
        if (i + AHEAD < count) prefetch_bodies(w, &pairs[items[i + AHEAD]]);
        if (i + SHAPES_AHEAD < count) prefetch_shapes(w, &pairs[items[i + SHAPES_AHEAD]]);
        add(asking, i);
    }
    batch_floats_end(&asking->floats);
}

// ---- answers

static vec3 turn_normal(const ovoid_pose *pose, const float n[3]) {
    return vec3_unit(mat3_mul_vec3(quat_to_mat3(pose->rotation), (vec3){(double)n[0], (double)n[1], (double)n[2]}));
}

// The directions and vertices of couples that the spheres or the ellipsoids decide are not written.
static void cache_floats(const floats_asking *asking, const world_pair *p, uint32_t place) {
    const ovoid_verdict *verdict = &asking->verdicts[place];
    pair_cache *cache = &asking->w->pair_cache[p->slot];
    int has_normal = verdict->status == OVOID_SEPARATED && verdict->stage != OVOID_STAGE_SPHERE;
    int has_corners = verdict->status == OVOID_OVERLAPPING && verdict->stage == OVOID_STAGE_GJK;
    pair_cache_verdict(cache, verdict);
    cache->normal = (vec3){0, 0, 0};
    if (has_normal) cache->normal = turn_normal(&asking->w->bodies[p->a].body.pose, asking->normals[place]);
    cache->proof = has_corners ? OVOID_PROOF_HULL : OVOID_PROOF_NONE;
    cache->count = has_corners ? 4 : 0;
    if (has_corners) memcpy(cache->of.entry, asking->corners[place], sizeof asking->corners[place]);
}

static void take_answers(floats_asking *asking, uint32_t count) {
    ovoid_world *w = asking->w;
    for (uint32_t i = 0; i < count; i++) {
        if (i + AHEAD < count) prefetch_two_lines(&w->pair_cache[asking->pairs[asking->items[i + AHEAD]].slot]);
        if (asking->verdicts[i].status == OVOID_UNDECIDED) continue;
        world_pair *p = &asking->pairs[asking->items[i]];
        cache_floats(asking, p, i);
        pair_renew(w, p, &w->pair_cache[p->slot]);
    }
}

// ---- both

static void begin(floats_asking *asking, const ovoid_options *options, const query_goal *goal) {
    batch_floats *s = &asking->floats;
    s->kernels = float_gjk_get_kernels(FLOATS);
    s->alone = float_gjk_get_kernels(1);
    s->goal = goal;
    s->options = options;
    s->batch = NULL;
    s->verdicts = asking->verdicts;
    s->normals = asking->normals;
    s->corners = asking->corners;
    s->leave_open = s->pass_on = leave_open;
    s->self = asking;
    asking->open_count = 0;
    batch_floats_begin(s);
}

// Not inlined: its memory, 120 KB, is not beside that of the queries that follow.
COMPILER_NOINLINE uint32_t pairs_ask_floats(ovoid_world *w, world_pair *pairs, uint16_t *items, uint32_t count) {
    ovoid_options options;
    if (!count || world_is_measuring(w) || !options_make(&w->query_options, &options)) return count;
    query_goal goal = w->kind == OVOID_QUERY_COLLIDE ? query_goal_make_collide() : query_goal_make_within(w->margin);
    goal.iterations = options.iterations;
    floats_asking asking;
    asking.w = w;
    asking.pairs = pairs;
    asking.items = items;
    begin(&asking, &options, &goal);
    ask(&asking, count);
    take_answers(&asking, count);
    memcpy(items, asking.open, asking.open_count * sizeof *items);
    return asking.open_count;
}
