// Cost as the work grows: a query over the vertices of its bodies; many pairs, in one batch and each by its own call; a
// batch on several threads; a shape's memory.
#define _POSIX_C_SOURCE 200809L
#include "pairs/scale.h"

#include "common/build.h"
#include "common/random.h"
#include "common/rows.h"
#include "pairs/ours.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

enum { PASSES = 9, THREADS_MOST = 64 };

// --- vertices

static timing time_query(const workload *work, question what) {
    double samples[PASSES];
    found *answers = malloc(sizeof *answers * work->pair_count);
    void *self = ours.create(work);
    for (int pass = -1; self && answers && pass < PASSES; pass++) {
        // The first pass warms the caches.
        double start = get_own_seconds();
        ours.run(self, what, 0, answers);
        if (pass >= 0) samples[pass] = (get_own_seconds() - start) / work->pair_count * 1e9;
    }
    timing result = timing_make(samples, self && answers ? PASSES : 0);
    if (self) ours.destroy(self);
    free(answers);
    return result;
}

static const struct curve_of_queries {
    const char *line;
    placement place;
    question what;
} query_curves[] = {
    {"collide, gap 500%", PLACE_FAR, QUESTION_COLLIDE},  {"collide, gap 10%", PLACE_TENTH, QUESTION_COLLIDE},
    {"collide, gap 1%", PLACE_NEAR, QUESTION_COLLIDE},   {"collide, over 30%", PLACE_OVER, QUESTION_COLLIDE},
    {"distance, gap 50%", PLACE_MID, QUESTION_DISTANCE}, {"distance, gap 1%", PLACE_NEAR, QUESTION_DISTANCE},
    {"depth, over 30%", PLACE_OVER, QUESTION_DEPTH}};
enum { QUERY_CURVES = sizeof query_curves / sizeof query_curves[0] };

static int add_queries(rows *all, const bodies *set) {
    for (int i = 0; i < QUERY_CURVES; i++) {
        workload work = workload_create_still("", set, query_curves[i].place);
        if (!work.pairs) return 0;
        rows_add(all, (row){"Time of a query", "vertices", "ns", query_curves[i].line, set->items[0].vertex_count,
                            time_query(&work, query_curves[i].what), 0, 0});
        workload_destroy(&work);
    }
    return 1;
}

// --- memory

static void add_memory(rows *all, const bodies *set) {
    double bytes = 0;
    for (uint32_t i = 0; i < set->count; i++) bytes += (double)ovoid_shape_get_size(set->items[i].shape) / set->count;
    rows_add(all, (row){"Memory of a shape",
                        "vertices",
                        "KiB",
                        "shape",
                        set->items[0].vertex_count,
                        {bytes / 1024, bytes / 1024, bytes / 1024, bytes / 1024, bytes / 1024},
                        0,
                        0});
}

static int visit_sizes(rows *all, int smoke, int (*visit)(rows *, const bodies *)) {
    static const uint32_t sizes[] = {8, 32, 128, 512, 2048, 8192, 26000};
    for (int i = 0; i < (smoke ? 2 : 7); i++) {
        uint32_t count = smoke ? 3 : sizes[i] > 5000 ? 6 : sizes[i] > 1000 ? 20 : 100;
        bodies set = bodies_create_hulls(sizes[i], count);
        int good = set.count > 0 && visit(all, &set);
        bodies_destroy(&set);
        if (!good) return 0;
    }
    return 1;
}

static int visit_memory(rows *all, const bodies *set) {
    add_memory(all, set);
    return 1;
}

// --- pairs and threads

/// Pairs as a batch takes them: bodies 2 i and 2 i + 1.
typedef struct crowd {
    ovoid_posed_shape *bodies;
    ovoid_couple *couples;
    ovoid_verdict *verdicts;
    ovoid_witness *witnesses;
    uint32_t count;
} crowd;

static void crowd_destroy(crowd *c) {
    free(c->bodies);
    free(c->couples);
    free(c->verdicts);
    free(c->witnesses);
}

/// Hulls in random poses, the centres of a pair within two sizes: some touch, most do not. 0 if memory runs out.
static int crowd_create(crowd *c, const bodies *set, uint32_t count) {
    *c = (crowd){malloc(sizeof *c->bodies * 2 * count), malloc(sizeof *c->couples * count),
                 malloc(sizeof *c->verdicts * count), malloc(sizeof *c->witnesses * count), count};
    if (!c->bodies || !c->couples || !c->verdicts || !c->witnesses) return 0;
    uint64_t state = 4;
    for (uint32_t i = 0; i < count; i++) {
        const body *a = &set->items[i % set->count], *b = &set->items[(i / set->count + i + 1) % set->count];
        double size = body_get_reach(a) + body_get_reach(b), apart = random_uniform(&state, 0.2, 2) * size;
        ovoid_vec3 u = random_unit(&state);
        ovoid_quat turn_a = random_rotation(&state), turn_b = random_rotation(&state);
        c->bodies[2 * (size_t)i] = (ovoid_posed_shape){a->shape, {{0, 0, 0}, turn_a}};
        c->bodies[2 * (size_t)i + 1] = (ovoid_posed_shape){b->shape, {{u.x * apart, u.y * apart, u.z * apart}, turn_b}};
        c->couples[i] = (ovoid_couple){2 * i, 2 * i + 1};
    }
    return 1;
}

/// The couples of one thread: from first to end, exclusive. Of distances the witnesses are wanted too.
typedef struct share {
    ovoid_batch batch;
    question what;
    int failed;
    double seconds; ///< that its thread had the processor
} share;

static share share_make(const crowd *c, question what, uint32_t from, uint32_t to) {
    return (share){{.bodies = c->bodies,
                    .body_count = 2 * (size_t)c->count,
                    .couples = c->couples + from,
                    .couple_count = to - from,
                    .verdicts = c->verdicts + from,
                    .witnesses = what == QUESTION_DISTANCE ? c->witnesses + from : NULL},
                   what,
                   0,
                   0};
}

static void *run_share(void *data) {
    share *s = data;
    ovoid_code code =
        s->what == QUESTION_DISTANCE ? ovoid_distance_batch(&s->batch, NULL) : ovoid_collide_batch(&s->batch, NULL);
    s->failed |= code != OVOID_OK;
    return NULL;
}

/// For a thread. The clock costs as much as a few pairs.
static void *time_share(void *data) {
    share *s = data;
    double start = get_own_seconds();
    (void)run_share(s);
    s->seconds = get_own_seconds() - start;
    return NULL;
}

/// The same pairs, each by its own query.
static void *run_singly(void *data) {
    const share *s = data;
    for (size_t i = 0; i < s->batch.couple_count; i++) {
        const ovoid_posed_shape *a = &s->batch.bodies[s->batch.couples[i].a],
                                *b = &s->batch.bodies[s->batch.couples[i].b];
        ovoid_pair pair = {a->shape, b->shape, a->pose, b->pose};
        ovoid_answer x = ours_get_answer(&pair, s->what, 0, NULL);
        s->batch.verdicts[i] = (ovoid_verdict){x.status, x.stage, x.limit, x.iterations, x.lower, x.upper};
        if (s->batch.witnesses) s->batch.witnesses[i] = (ovoid_witness){x.point_a, x.point_b, x.normal};
    }
    return NULL;
}

/// Seconds for all pairs on so many threads, by the time that the slowest had its processor; 0 if a thread cannot be
/// started.
static double time_threads(const crowd *c, question what, uint32_t count, uint32_t threads) {
    pthread_t ids[THREADS_MOST];
    share shares[THREADS_MOST];
    double slowest = 0;
    uint32_t started = 0;
    for (; started < threads; started++) {
        uint32_t from = (uint32_t)((uint64_t)count * started / threads);
        uint32_t to = (uint32_t)((uint64_t)count * (started + 1) / threads);
        shares[started] = share_make(c, what, from, to);
        if (pthread_create(&ids[started], NULL, time_share, &shares[started])) break;
    }
    for (uint32_t i = 0; i < started; i++) {
        (void)pthread_join(ids[i], NULL);
        if (shares[i].seconds > slowest) slowest = shares[i].seconds;
    }
    return started == threads ? slowest : 0;
}

static row make_pairs_row(row named, uint32_t count, double *seconds, uint32_t passes) {
    for (uint32_t i = 0; i < passes; i++) seconds[i] *= 1e9 / count;
    named.y_name = "ns per pair";
    named.y = timing_make(seconds, passes);
    return named;
}

/// Times growing numbers of pairs.
static void add_pairs(rows *all, const crowd *c, question what, int is_batch) {
    static const char *const lines[2][2] = {{"collide, one by one", "collide, in a batch"},
                                            {"distance, one by one", "distance, in a batch"}};
    void *(*run)(void *) = is_batch ? run_share : run_singly;
    double seconds[PASSES];
    for (uint64_t count = 1; count <= c->count; count *= 10) {
        // Small numbers of pairs are repeated, so that the clock's own cost does not matter.
        uint32_t passes = count > 100000 ? 3 : 5, again = count < 1000 ? (uint32_t)(1000 / count) : 1;
        share s = share_make(c, what, 0, (uint32_t)count);
        for (uint32_t pass = 0; pass < passes; pass++) {
            double start = get_own_seconds();
            for (uint32_t k = 0; k < again; k++) (void)run(&s);
            seconds[pass] = (get_own_seconds() - start) / again;
        }
        row named = {.chart = "Many pairs on one thread",
                     .x_name = "pairs",
                     .line = lines[what == QUESTION_DISTANCE][is_batch],
                     .x = (double)count};
        rows_add(all, make_pairs_row(named, (uint32_t)count, seconds, passes));
    }
}

/// The same batch cut into a part for each thread, up to one for each core.
static void add_threads(rows *all, const crowd *c, question what) {
    uint32_t count = c->count < 1000000 ? c->count : 1000000;
    double seconds[PASSES];
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    for (uint32_t threads = 1; threads <= cores && threads <= THREADS_MOST; threads *= 2) {
        for (uint32_t pass = 0; pass < 5; pass++) seconds[pass] = time_threads(c, what, count, threads);
        const char *line = what == QUESTION_DISTANCE ? "distance" : "collide";
        row named = {.chart = "A batch on several threads", .x_name = "threads", .line = line, .x = threads};
        rows_add(all, make_pairs_row(named, count, seconds, 5));
    }
}

static int visit_pairs(rows *all, uint32_t most) {
    bodies set = bodies_create_hulls(32, 100);
    crowd c = {0};
    int good = set.count && crowd_create(&c, &set, most);
    if (good) {
        static const question asked[] = {QUESTION_COLLIDE, QUESTION_DISTANCE};
        for (int i = 0; i < 2; i++) {
            add_pairs(all, &c, asked[i], 1);
            add_pairs(all, &c, asked[i], 0);
            add_threads(all, &c, asked[i]);
        }
    }
    crowd_destroy(&c);
    bodies_destroy(&set);
    return good;
}

int scale_run(const char *csv, const char *svg, uint32_t most_pairs, int smoke) {
    static rows all;
    printf("%s\n", get_build());
    if (!visit_sizes(&all, smoke, add_queries) || !visit_sizes(&all, smoke, visit_memory) ||
        !visit_pairs(&all, most_pairs))
        return 0;
    return (!csv || rows_write_csv(&all, csv)) && (!svg || rows_write_svg(&all, svg));
}
