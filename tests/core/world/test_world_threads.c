// The same bits from any number of threads, from the world's own and from a host's task system that cuts the work as it
// likes. Truth: the hash of all that one thread says.
#define _POSIX_C_SOURCE 200809L // signals
#include "worlds.h"

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

enum { BODIES = 3000, FRAMES = 8 };

// ---- a host: starts a thread for each part, parts of odd sizes, joins them in finish

typedef struct host_part {
    void (*run)(void *, uint32_t, uint32_t, uint32_t);
    void *work;
    uint32_t first, end, worker;
    pthread_t thread;
} host_part;

typedef struct host {
    host_part parts[4];
    int started;
    uint32_t least;
} host;

static void *run_part(void *context) {
    host_part *p = context;
    // Pieces of the part; of every second worker the last ones first.
    enum { PIECE = 7 };
    uint32_t pieces = (p->end - p->first + PIECE - 1) / PIECE;
    for (uint32_t k = 0; k < pieces; k++) {
        uint32_t first = p->first + PIECE * (p->worker % 2 ? k : pieces - 1 - k);
        p->run(p->work, first, p->end - first > PIECE ? first + PIECE : p->end, p->worker);
    }
    return NULL;
}

static void *host_start(void *context, void (*run)(void *, uint32_t, uint32_t, uint32_t), void *work, uint32_t count,
                        uint32_t least) {
    host *h = context;
    h->least = least;
    for (uint32_t i = 4; i-- > 0;) {
        uint32_t first = (uint32_t)((uint64_t)count * i / 4), end = (uint32_t)((uint64_t)count * (i + 1) / 4);
        h->parts[i] = (host_part){.run = run, .work = work, .first = first, .end = end, .worker = i};
        CHECK(pthread_create(&h->parts[i].thread, NULL, run_part, &h->parts[i]) == 0);
    }
    h->started++;
    return h;
}

static void host_finish(void *context, void *handle) {
    host *h = context;
    CHECK(handle == h);
    for (int i = 0; i < 4; i++) pthread_join(h->parts[i].thread, NULL);
}

// ----

static uint64_t hash;

static void add(const void *data, size_t size) {
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++) hash = (hash ^ bytes[i]) * 1099511628211u;
}

static void add_frame(const ovoid_contacts *f) {
    for (size_t i = 0; i < f->count; i++) add(&f->items[i], sizeof *f->items);
    if (f->witnesses) add(f->witnesses, f->count * sizeof *f->witnesses);
    size_t counts[] = {f->count, f->bodies, f->pairs, f->aged, f->queried, f->added, f->dropped, f->moved, f->rebuilt};
    add(counts, sizeof counts);
}

static void add_manifolds(const ovoid_world_manifolds *m) {
    for (size_t i = 0; i < m->count; i++) add(&m->items[i], sizeof *m->items);
    for (size_t i = 0; i < m->part_count; i++) {
        add(&m->parts[i], sizeof *m->parts);
        for (uint32_t k = 0; k < m->points[i].count; k++) {
            // Without its padding.
            add(&m->points[i].points[k], offsetof(ovoid_manifold_point, id));
            add(&m->points[i].points[k].id, sizeof m->points[i].points[k].id);
        }
    }
    for (size_t i = 0; i < m->ended_count; i++) add(&m->ended[i], sizeof *m->ended);
    size_t counts[] = {m->count, m->begun, m->ended_count, m->part_count, m->kept};
    add(counts, sizeof counts);
    add_frame(&m->step);
}

// A batch with two wrong poses: the first is named, and no body is moved.
static void check_refused(ovoid_world *w, const ovoid_id *ids, ovoid_pose *poses) {
    enum { FIRST = 800, SECOND = 1400 };
    ovoid_pose right[2] = {poses[FIRST], poses[SECOND]};
    ovoid_error error = {0};
    poses[FIRST].position.x = NAN;
    poses[SECOND].position.y = 1e60;
    CHECK_EQ((int)ovoid_world_move_many(w, &(ovoid_world_moves){ids, poses, BODIES}, &error),
             (int)OVOID_ERROR_NOT_FINITE);
    CHECK_EQ(error.place, FIRST);
    poses[FIRST] = right[0];
    CHECK_EQ((int)ovoid_world_move_many(w, &(ovoid_world_moves){ids, poses, BODIES}, &error), (int)OVOID_ERROR_RANGE);
    CHECK_EQ(error.place, SECOND);
    poses[SECOND] = right[1];
}

// Moves all in another order of the bodies.
static void move_exchanged(ovoid_world *w, ovoid_id *ids, ovoid_pose *poses) {
    enum { ONE = 3, OTHER = 2000 };
    for (int k = 0; k < 2; k++) {
        ovoid_id id = ids[ONE];
        ovoid_pose pose = poses[ONE];
        ids[ONE] = ids[OTHER], poses[ONE] = poses[OTHER];
        ids[OTHER] = id, poses[OTHER] = pose;
        if (k == 0) CHECK(ovoid_world_move_many(w, &(ovoid_world_moves){ids, poses, BODIES}, NULL) == OVOID_OK);
    }
}

// A life of a few frames, the same for all; its hash. Half of the frames have manifolds.
static uint64_t live(ovoid_shape **shapes, const ovoid_world_options *o, size_t *contacts) {
    uint64_t s = 11;
    ovoid_error error = {0};
    ovoid_world *w = ovoid_world_create(o, &error);
    if (!CHECK(w != NULL)) printf("  %s\n", error.message);
    static ovoid_id ids[BODIES + 1];
    static ovoid_pose poses[BODIES + 1];
    static ovoid_world_body bodies[BODIES];
    hash = 14695981039346656037u;
    for (int i = 0; i < BODIES; i++)
        bodies[i] = (ovoid_world_body){
            .body = {.shape = shapes[random_next(&s) % WORLD_SHAPES], .pose = {random_place(&s, 18), random_quat(&s)}}};
    CHECK(ovoid_world_add_many(w, &(ovoid_world_additions){bodies, BODIES, ids}, NULL) == OVOID_OK);
    for (int f = 0; f < FRAMES; f++) {
        ovoid_contact_query q = {.kind = (ovoid_query_kind)(f / 2), .margin = f / 2 ? 0.1 : 0};
        ovoid_contacts frame;
        CHECK(ovoid_world_compute_contacts(w, &q, &frame, NULL) == OVOID_OK);
        add_frame(&frame);
        *contacts = frame.count;
        ovoid_world_manifold_query manifold_query = {.options = {.margin = f % 4 ? 0.05 : 0}, .ahead = f % 3};
        ovoid_world_manifolds manifolds;
        for (int i = f; i < BODIES; i += 30) {
            const ovoid_material m = {.margin = 0.001 * (i % 7), .friction = 0.1 * i, .restitution = 1.0 / (i + 1)};
            CHECK(ovoid_world_set_material(w, ids[i], &m, NULL) == OVOID_OK);
        }
        for (int k = 0; k < 2 && f % 2; k++) {
            CHECK(ovoid_world_compute_manifolds(w, &manifold_query, &manifolds, NULL) == OVOID_OK);
            add_manifolds(&manifolds);
        }
        for (int i = 0; i < BODIES; i++) {
            ovoid_vec3 d = random_place(&s, i % 50 ? 0.02 : 5);
            ovoid_pose *p = &bodies[i].body.pose;
            p->position = (ovoid_vec3){p->position.x + d.x, p->position.y + d.y, p->position.z + d.z};
            p->rotation.x += random_uniform(&s, -0.01, 0.01);
            poses[i] = *p;
        }
        check_refused(w, ids, poses);
        // One by one, all at once, out of order, and with one of them twice: the last pose is right.
        ids[BODIES] = ids[17];
        poses[BODIES] = poses[17];
        if (f % 4 == 3) poses[17].position.x += 1;
        for (int i = 0; i < BODIES && f % 4 == 0; i++) CHECK(ovoid_world_move(w, ids[i], &poses[i], NULL) == OVOID_OK);
        if (f % 4 == 2) move_exchanged(w, ids, poses);
        if (f % 2)
            CHECK(ovoid_world_move_many(w, &(ovoid_world_moves){ids, poses, BODIES + (f % 4 == 3)}, NULL) == OVOID_OK);
        for (int i = f; i < BODIES; i += 100) {
            CHECK(ovoid_world_remove(w, ids[i], NULL) == OVOID_OK);
            ids[i] = ovoid_world_add(w, &bodies[i], NULL);
        }
    }
    ovoid_world_destroy(w);
    return hash;
}

// ---- signals: one that the host holds back does not come by way of a world's thread

#if defined(_WIN32)
static void test_signals(ovoid_shape **shapes) { (void)shapes; } // there are none
#else

static volatile sig_atomic_t heard;
static void hear(int number) { heard = number; }

static void test_signals(ovoid_shape **shapes) {
    sigset_t held;
    struct sigaction action = {.sa_handler = hear};
    CHECK(sigaction(SIGUSR1, &action, NULL) == 0);
    ovoid_world_options o = {.threads = 4};
    ovoid_world *w = ovoid_world_create(&o, NULL);
    if (!CHECK(w != NULL)) return;
    sigemptyset(&held);
    sigaddset(&held, SIGUSR1);
    CHECK(pthread_sigmask(SIG_BLOCK, &held, NULL) == 0);
    uint64_t s = 3;
    ovoid_contact_query q = {.kind = OVOID_QUERY_COLLIDE};
    ovoid_contacts found;
    for (int round = 0; round < 20 && !heard; round++) {
        if (round == 0) CHECK(kill(getpid(), SIGUSR1) == 0);
        for (int i = 0; i < 200; i++) {
            ovoid_world_body b = {
                .body = {.shape = shapes[i % WORLD_SHAPES], .pose = {random_place(&s, 5), random_quat(&s)}}};
            CHECK(ovoid_world_add(w, &b, NULL) != 0);
        }
        CHECK(ovoid_world_compute_contacts(w, &q, &found, NULL) == OVOID_OK);
    }
    CHECK(!heard);
    CHECK(pthread_sigmask(SIG_UNBLOCK, &held, NULL) == 0);
    CHECK_EQ(heard, SIGUSR1);
    ovoid_world_destroy(w);
}
#endif

int main(void) {
    ovoid_shape *shapes[WORLD_SHAPES];
    uint64_t s = 2;
    world_make_shapes(&s, 1, shapes);
    size_t contacts = 0, others = 0;
    uint64_t truth = live(shapes, NULL, &contacts);
    CHECK_LE(500, contacts);
    for (uint32_t threads = 2; threads <= 8; threads += threads < 4 ? 1 : 2) {
        ovoid_world_options o = {.threads = threads};
        check_seed = threads;
        CHECK(live(shapes, &o, &others) == truth);
    }
    host h = {.started = 0};
    ovoid_world_options o = {.threads = 4, .tasks = {host_start, host_finish, &h}};
    CHECK(live(shapes, &o, &others) == truth);
    CHECK_LE(FRAMES, h.started);
    ovoid_error error = {0};
    o.tasks.finish = NULL;
    CHECK(!ovoid_world_create(&o, &error) && error.code == OVOID_ERROR_ARGUMENT);
    check_seed = 0;
    test_signals(shapes);
    world_destroy_shapes(shapes);
    return check_end();
}
