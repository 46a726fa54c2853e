// A block of the long run: scenes of a pair each, a scene a few frames, a frame a few questions. Each answer must pass
// ovoid_answer_verify; the brackets of all answers of one frame must have a common point, since each claims to hold the
// same number; an answer that was not cut short must be as narrow as promised; and one in so many goes before the
// judge.
#define _POSIX_C_SOURCE 199309L // for the processor's clock
#include "long_run.h"

#include "check.h"
#include "shapes.h"

#include <string.h>
#include <time.h>

#define FRAMES 5
#define RING 16

typedef struct work {
    const block_run *run;
    counts c;
    item pool[POOL_MOST];
    uint32_t pool_count;
    uint64_t until_exact;
    ovoid_proof ring[RING]; // the last proofs found, of whatever pair
    uint32_t at;
    uint64_t memory[OVOID_COVER_SIZE / sizeof(uint64_t)];
    ovoid_cover cover;
} work;

// The present pair. low and high: bounds of d from the answers of this frame.
typedef struct scene {
    ovoid_pair pair;
    const item *a, *b;
    double size, unresolved, low, high;
    uint32_t frame;
} scene;

static const char *const question_names[] = {"collide", "within", "distance", "depth", "bounds"};

void counts_add(counts *sum, const counts *more) {
    uint64_t iterations = sum->iterations > more->iterations ? sum->iterations : more->iterations;
    uint64_t *x = (uint64_t *)sum;
    const uint64_t *y = (const uint64_t *)more;
    for (size_t i = 0; i < sizeof *sum / sizeof *x; i++) x[i] += y[i];
    sum->iterations = iterations;
}

// --- the pool

static item make_item(ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    ovoid_measures m = ovoid_shape_get_measures(shape);
    item x = {.shape = shape, .origin = p.origin, .radius = ovoid_shape_get_radius(shape)};
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        const double *v = p.vertices + 3 * (size_t)i;
        x.extent = fmax(x.extent, hypot(hypot(v[0], v[1]), v[2]));
    }
    x.reach = m.sphere_radius + x.radius;
    x.center =
        (ovoid_vec3){m.sphere_center.x + p.origin.x, m.sphere_center.y + p.origin.y, m.sphere_center.z + p.origin.z};
    return x;
}

static void fill_pool(work *w, uint64_t *r) {
    const block_run *run = w->run;
    const long_family *f = run->family;
    for (w->pool_count = 0; w->pool_count < f->pool; w->pool_count++) {
        ovoid_shape *shape;
        if (f->make_b && w->pool_count >= f->pool / 2)
            shape = f->make_b(r);
        else if (f->make)
            shape = f->make(r);
        else {
            const cloud *c = &run->clouds->items[random_next(r) % run->clouds->count];
            shape = make_points(c->xyz, c->count, 0);
        }
        w->pool[w->pool_count] = make_item(shape);
    }
}

// --- judging

static void report(work *w, const scene *s, const ovoid_answer *x, question_kind kind, const char *why) {
    const block_run *run = w->run;
    run->report(run->context, run->family, run->number, &s->pair, x, question_names[kind], why);
}

static void fail(work *w, const scene *s, const ovoid_answer *x, question_kind kind, const char *why) {
    w->c.wrong++;
    report(w, s, x, kind, why);
}

static void check_exactly(work *w, const scene *s, const ovoid_answer *x, const ovoid_cover *cover, question_kind kind,
                          const ovoid_options *options) {
    ovoid_error error = {0};
    int in_full = options == NULL;
    judge *j = w->run->judge;
    w->c.exact++;
    judge_set_options(j, options);
    int has_points = in_full && x->status != OVOID_UNDECIDED &&
                     (kind == ASK_DEPTH || (kind == ASK_DISTANCE && x->status == OVOID_SEPARATED));
    if (judge_verify_answer(j, &s->pair, x, cover, &error) != OVOID_OK ||
        (has_points && judge_verify_points(j, &s->pair, x, &error) != OVOID_OK))
        fail(w, s, x, kind, error.message);
}

// What was asked with the default options: the sign, and for a distance or a depth a narrow bracket.
static void check_completeness(work *w, const scene *s, const ovoid_answer *x, question_kind kind) {
    const block_run *run = w->run;
    int is_wide = x->upper - x->lower - s->unresolved > 1.0001e-9 * s->size;
    int wants_bracket = kind == ASK_DEPTH || (kind == ASK_DISTANCE && x->status == OVOID_SEPARATED);
    if (is_wide && x->status == OVOID_TOUCHING) fail(w, s, x, kind, "touching, and the bracket is wide");
    if (is_wide && wants_bracket && (x->limit == OVOID_LIMIT_NONE || x->limit == OVOID_LIMIT_ANSWERED))
        w->c.vague++, report(w, s, x, kind, "wide, and no limit says why");
    if (x->iterations >= 1000) report(w, s, x, kind, "a thousand steps");
    w->c.open += x->status == OVOID_UNDECIDED;
    w->c.wide += is_wide && wants_bracket;
    if (!run->is_shown) return;
    const char *what = x->status == OVOID_UNDECIDED   ? "open"
                       : x->stage == OVOID_STAGE_NONE ? "decided by no stage"
                       : is_wide && wants_bracket     ? "wide"
                                                      : NULL;
    if (what) report(w, s, x, kind, what);
}

// options: NULL where the answer is to be complete.
static void check_answer(work *w, scene *s, const ovoid_answer *x, const ovoid_cover *cover, question_kind kind,
                         const ovoid_options *options) {
    ovoid_error error;
    int in_full = options == NULL;
    counts *c = &w->c;
    c->queries++;
    c->questions[kind]++;
    c->statuses[x->status]++;
    c->stages[x->stage]++;
    c->limits[x->limit]++;
    if (x->iterations > c->iterations) c->iterations = x->iterations;
    if (ovoid_answer_verify(&s->pair, x, &(ovoid_answer_basis){.options = options, .cover = cover}, &error) != OVOID_OK)
        fail(w, s, x, kind, error.message);
    s->low = fmax(s->low, x->lower);
    s->high = fmin(s->high, x->upper);
    if (!(s->low <= s->high)) {
        fail(w, s, x, kind, "its bracket excludes another one of this pair, or the known distance");
        s->low = -INFINITY, s->high = INFINITY;
    }
    if (in_full && kind != ASK_BOUNDS) check_completeness(w, s, x, kind);
    if (--w->until_exact == 0) {
        w->until_exact = w->run->sample;
        check_exactly(w, s, x, cover, kind, options);
    }
}

// --- earlier proofs

static void set_garbage(ovoid_proof *p, uint64_t *r) {
    unsigned char *bytes = (unsigned char *)p;
    size_t before = offsetof(ovoid_proof, kind), after = offsetof(ovoid_proof, count);
    for (size_t i = 0; i < 8; i++) {
        size_t at = (size_t)(random_next(r) % sizeof *p);
        if (at < before || at >= after) bytes[at] = (unsigned char)random_next(r);
    }
}

// The proof to hand in, or NULL. last: that of the frame before; stale: of five to eight queries before.
static const ovoid_proof *choose_earlier(work *w, const scene *s, uint64_t *r, ovoid_proof *spare) {
    uint64_t choice = random_next(r) % 16;
    warm_kind kind = choice < 6 ? WARM_NONE : choice < 11 ? WARM_LAST : choice < 13 ? WARM_STALE : WARM_FOREIGN;
    if (choice == 15 && random_next(r) % 4 == 0) kind = WARM_GARBAGE;
    if (s->frame == 0 && kind == WARM_LAST) kind = WARM_FOREIGN;
    w->c.warm[kind]++;
    switch (kind) {
    case WARM_NONE: return NULL;
    case WARM_LAST: return &w->ring[(w->at + RING - 1) % RING];
    case WARM_STALE: return &w->ring[(w->at + RING - 5 - (uint32_t)(random_next(r) % 4)) % RING];
    case WARM_GARBAGE:
        *spare = w->ring[(w->at + RING - 1) % RING];
        set_garbage(spare, r);
        return spare;
    default: *spare = w->ring[(uint32_t)(random_next(r) % RING)]; return spare;
    }
}

static void keep_proof(work *w, const ovoid_answer *x) {
    w->ring[w->at] = x->proof;
    w->at = (w->at + 1) % RING;
}

// --- questions

static double choose_margin(const scene *s, uint64_t *r) {
    const double factors[] = {0, 0.5, 1, 1 + 1e-12, 2};
    double d = isfinite(s->high) ? fabs(s->high) : s->size;
    return random_next(r) % 8 ? d * factors[random_next(r) % 5] : 0.01 * s->size;
}

static ovoid_answer ask(work *w, scene *s, question_kind kind, uint64_t *r) {
    ovoid_proof spare;
    const ovoid_proof *earlier = kind == ASK_BOUNDS ? NULL : choose_earlier(w, s, r, &spare);
    ovoid_options some = {0}, *options = NULL;
    if (random_next(r) % 32 == 0) {
        options = &some;
        w->c.limited++;
        if (random_next(r) % 2) some.iterations = 1 + (uint32_t)(random_next(r) % 4);
        if (random_next(r) % 2) some.relative_tolerance = log_uniform(r, 1e-12, 0.1);
        if (random_next(r) % 4 == 0) some.cap = s->size * random_uniform(r, 0, 1);
    }
    ovoid_answer x;
    const ovoid_cover *cover = NULL;
    switch (kind) {
    case ASK_COLLIDE: x = ovoid_collide(&s->pair, options, earlier); break;
    case ASK_WITHIN: {
        double margin = choose_margin(s, r);
        x = ovoid_within(&s->pair, margin, options, earlier);
        int within = ovoid_answer_is_within(&x, margin);
        if ((within == 1 && !(x.upper <= margin)) || (within == 0 && !(x.lower > margin)))
            fail(w, s, &x, kind, "its word is not what the bracket says");
        break;
    }
    case ASK_DISTANCE: x = ovoid_distance(&s->pair, options, earlier); break;
    case ASK_DEPTH:
        // The cover is that of the last depth, of this pair or of another one.
        x = earlier ? ovoid_depth_from(&s->pair, options, earlier, &w->cover)
                    : ovoid_depth(&s->pair, options, NULL, &w->cover);
        cover = &w->cover;
        break;
    default: x = ovoid_pair_compute_bounds(&s->pair); break;
    }
    check_answer(w, s, &x, cover, kind, kind == ASK_BOUNDS ? NULL : options);
    keep_proof(w, &x);
    return x;
}

// --- scenes

static double sum_abs(ovoid_vec3 v) { return fabs(v.x) + fabs(v.y) + fabs(v.z); }

// A new place: nothing is known of d, the size is that of docs/query.md.
static void begin_frame(scene *s) {
    const ovoid_pair *p = &s->pair;
    ovoid_vec3 a = ovoid_pose_compute_point(&p->pose_a, s->a->origin),
               b = ovoid_pose_compute_point(&p->pose_b, s->b->origin);
    s->size = hypot(hypot(a.x - b.x, a.y - b.y), a.z - b.z) + s->a->extent + s->b->extent + s->a->radius + s->b->radius;
    s->unresolved = 0x1p-88 * (sum_abs(p->pose_a.position) + sum_abs(p->pose_b.position) + sum_abs(s->a->origin) +
                               sum_abs(s->b->origin)) +
                    16 * OVOID_LENGTH_MIN;
    s->low = -INFINITY, s->high = INFINITY;
}

// Moves B along the normal of a complete answer: the distance becomes the gap, to rounding.
static void set_gap(scene *s, const ovoid_answer *x, double gap) {
    double step = gap - (x->lower > 0 ? x->lower : x->upper);
    ovoid_vec3 *p = &s->pair.pose_b.position;
    *p = (ovoid_vec3){p->x + x->normal.x * step, p->y + x->normal.y * step, p->z + x->normal.z * step};
}

// One percent of the size, in place and orientation.
static void move_a_little(scene *s, uint64_t *r) {
    ovoid_vec3 d = random_vec3(r, 0.01 * (s->a->reach + s->b->reach)), *p = &s->pair.pose_b.position;
    ovoid_quat *q = &s->pair.pose_b.rotation;
    double norm = 0.01 * (fabs(q->w) + fabs(q->x) + fabs(q->y) + fabs(q->z));
    *p = (ovoid_vec3){p->x + d.x, p->y + d.y, p->z + d.z};
    q->w += norm * random_uniform(r, -1, 1);
    q->x += norm * random_uniform(r, -1, 1);
    q->y += norm * random_uniform(r, -1, 1);
}

static int is_pose_in_range(const ovoid_pose *p) { return sum_abs(p->position) < 1e49; }

// Two bodies of the pool, A of its first half where B has a maker of its own.
static scene choose_bodies(const work *w, uint64_t *r) {
    const long_family *f = w->run->family;
    uint32_t half = f->make_b ? w->pool_count / 2 : w->pool_count, from = f->make_b ? half : 0;
    const item *a = &w->pool[random_next(r) % half], *b = &w->pool[from + random_next(r) % (w->pool_count - from)];
    return (scene){.a = a, .b = f->place == PLACE_SAME ? a : b};
}

// Gives the pair a new pose. If the distance is known, it is the first bracket of the frame.
static void place_frame(const long_family *f, scene *s, uint64_t *r) {
    double d = place_pair(f, s->a, s->b, &s->pair, r);
    begin_frame(s);
    if (!isnan(d)) s->low = s->high = d;
}

// The next place of a scene: a new one, at another gap along the normal of the last answer, or a little aside.
static void go_on(const long_family *f, scene *s, const ovoid_answer *last, uint64_t *r) {
    int is_normal_known = last->lower > 0 || last->limit == OVOID_LIMIT_NONE;
    if (f->place == PLACE_ALIGNED || f->place == PLACE_COMMON || f->place == PLACE_STACKED) {
        place_frame(f, s, r);
        return;
    }
    if (is_normal_known && random_next(r) % 2)
        set_gap(s, last, random_gap(r) * (s->a->reach + s->b->reach));
    else
        move_a_little(s, r);
    begin_frame(s);
}

static void run_scene(work *w, uint64_t *r) {
    const long_family *f = w->run->family;
    scene s = choose_bodies(w, r);
    place_frame(f, &s, r);
    w->c.pairs++;
    ovoid_answer x = ask(w, &s, random_next(r) % 2 ? ASK_DEPTH : ASK_DISTANCE, r);
    for (s.frame = 1; s.frame <= FRAMES; s.frame++) {
        go_on(f, &s, &x, r);
        if (!is_pose_in_range(&s.pair.pose_b)) return;
        w->c.pairs++;
        (void)ask(w, &s, ASK_COLLIDE, r);
        (void)ask(w, &s, ASK_WITHIN, r);
        const question_kind more[] = {ASK_COLLIDE, ASK_WITHIN, ASK_BOUNDS, ASK_DISTANCE};
        (void)ask(w, &s, more[random_next(r) % 4], r);
        x = ask(w, &s, random_next(r) % 4 ? ASK_DISTANCE : ASK_DEPTH, r);
    }
}

// Of this thread's processor, so that a loaded machine does not count.
static uint64_t nanoseconds_now(void) {
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (uint64_t)now.tv_sec * 1000000000u + (uint64_t)now.tv_nsec;
}

void block_execute(const block_run *run, counts *sum) {
    uint64_t start = nanoseconds_now(), r = run->seed;
    work *w = calloc(1, sizeof *w);
    if (w) w->cover = (ovoid_cover){.memory = w->memory, .size = sizeof w->memory};
    if (!w) abort();
    w->run = run;
    w->until_exact = run->sample;
    trial_seed = run->seed;
    fill_pool(w, &r);
    while (w->c.queries < BLOCK_QUERIES) run_scene(w, &r);
    judge_forget(run->judge);
    for (uint32_t i = 0; i < w->pool_count; i++) ovoid_shape_destroy(w->pool[i].shape);
    w->c.blocks = 1;
    w->c.nanoseconds = nanoseconds_now() - start;
    counts_add(sum, &w->c);
    free(w);
}
