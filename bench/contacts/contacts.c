// Contact points: pairs face on face and in random poses, moved a little from frame to frame. All contestants get the
// same poses, in turn, round after round; a number is the least of the rounds, in processor time.
#include "contacts/contacts.h"

#include "common/bodies.h"
#include "common/measure.h"
#include "common/module.h"
#include "common/random.h"

#include <ovoid/query.h>
#include <ovoid/shape.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FRAMES = 9, PEERS_MOST = 16, BODIES = 60 };

/// Motion of a frame, depth and margin: in parts of the pair's size.
#define MOTION 1e-4
#define DEPTH 1e-3
#define MARGIN 2.5e-3

typedef struct contestant {
    const contact_peer *who;
    void *self;
    double cold, warm; ///< seconds a pair
    double points;     ///< of a pair
} contestant;

/// The contestants of a workload: ovoid at two tolerances, then the peers.
typedef struct contestants {
    const contact_peer *peers[PEERS_MOST];
    uint32_t count;
} contestants;

typedef struct kind {
    const char *name;
    uint32_t vertices; ///< 0: boxes
    int is_face;
} kind;

static const kind kinds[] = {{"boxes, face on face", 0, 1}, {"boxes, random", 0, 0},
                             {"hulls 8, random", 8, 0},     {"hulls 32, face on face", 32, 1},
                             {"hulls 32, random", 32, 0},   {"hulls 128, random", 128, 0}};

// ---- poses ----

static ovoid_vec3 add(ovoid_vec3 a, ovoid_vec3 b, double s) {
    return (ovoid_vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
static ovoid_quat unit(ovoid_quat q) {
    double l = 1 / sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return (ovoid_quat){q.w * l, q.x * l, q.y * l, q.z * l};
}
// The pose that turns the body's facet 0 to face up (or down), its first corner near the axis, then turns it about z.
static ovoid_pose pose_on_facet(const body *b, double up, uint64_t *s) {
    ovoid_polytope p = ovoid_shape_get_polytope(b->shape);
    ovoid_vec3 n = p.planes[0].normal;
    // Half way between n and z.
    ovoid_quat q = {1 + up * n.z, up * n.y, -up * n.x, 0};
    if (q.w < 1e-6) q = (ovoid_quat){0, 1, 0, 0};
    double half = random_uniform(s, 0, 3);
    ovoid_pose turn = {{0, 0, 0}, unit(q)}, about = {{0, 0, 0}, {cos(half), 0, 0, sin(half)}};
    ovoid_pose pose = ovoid_pose_compute_product(&about, &turn);
    ovoid_vec3 middle = {0, 0, 0};
    uint32_t count = 0;
    for (uint32_t i = 0; i < 3 * p.triangle_count; i++) {
        if (p.triangle_facets[i / 3]) continue;
        const double *v = p.vertices + 3 * (size_t)p.triangles[i];
        ovoid_vec3 at = ovoid_pose_compute_point(&pose, (ovoid_vec3){v[0], v[1], v[2]});
        middle = add(middle, at, 1);
        count++;
    }
    pose.position = (ovoid_vec3){-middle.x / count, -middle.y / count, -middle.z / count};
    return pose;
}

// B is moved along the normal of their distance until it is as deep.
static void set_depth(placed *p, const body *items, double depth) {
    ovoid_pair pair = {items[p->a].shape, items[p->b].shape, p->pose_a, p->pose_b};
    for (int k = 0; k < 3; k++) {
        ovoid_answer x = ovoid_depth(&pair, NULL, NULL, NULL);
        pair.pose_b.position = add(pair.pose_b.position, x.normal, -depth - x.upper);
    }
    p->pose_b = pair.pose_b;
}

static placed place(const bodies *all, const kind *k, uint64_t *s) {
    placed p = {(uint32_t)(random_next(s) % all->count),
                (uint32_t)(random_next(s) % all->count),
                {{0, 0, 0}, {1, 0, 0, 0}},
                {{0, 0, 0}, {1, 0, 0, 0}},
                0,
                0};
    const body *a = all->items + p.a, *b = all->items + p.b;
    p.size = body_get_reach(a) + body_get_reach(b);
    p.pose_a.rotation = random_rotation(s);
    p.pose_b = (ovoid_pose){add(p.pose_a.position, random_unit(s), p.size), random_rotation(s)};
    if (k->is_face) {
        p.pose_a = pose_on_facet(a, 1, s);
        p.pose_b = pose_on_facet(b, -1, s);
        p.pose_b.position.x += random_uniform(s, 0, 0.05) * p.size;
    }
    set_depth(&p, all->items, DEPTH * p.size);
    ovoid_pose by = {random_unit(s), random_rotation(s)};
    p.pose_a = ovoid_pose_compute_product(&by, &p.pose_a);
    p.pose_b = ovoid_pose_compute_product(&by, &p.pose_b);
    return p;
}

static void fill_frames(placed *pairs, uint32_t count, const bodies *all, const kind *k) {
    uint64_t s = 1;
    for (uint32_t i = 0; i < count; i++) {
        pairs[i] = place(all, k, &s);
        for (uint32_t f = 1; f < FRAMES; f++) {
            placed *p = pairs + (size_t)f * count + i;
            *p = pairs[i];
            p->pose_b.position = add(p->pose_b.position, random_unit(&s), MOTION * p->size / 2);
            ovoid_vec3 r = random_unit(&s);
            ovoid_pose turn = {{0, 0, 0}, unit((ovoid_quat){1, MOTION * r.x / 2, MOTION * r.y / 2, MOTION * r.z / 2})};
            p->pose_b.rotation = ovoid_pose_compute_product(&p->pose_b, &turn).rotation;
        }
    }
}

// ---- the table ----

static void time_entrant(contestant *e, const contact_work *w) {
    // Once without the clock, so that each finds its data in the cache.
    (void)e->who->run(e->self, 0, 0);
    double begin = get_own_seconds();
    uint32_t points = e->who->run(e->self, 0, 0);
    double cold = (get_own_seconds() - begin) / w->pair_count;
    begin = get_own_seconds();
    for (uint32_t f = 1; f < w->frame_count; f++) (void)e->who->run(e->self, f, 1);
    double warm = (get_own_seconds() - begin) / w->pair_count / (w->frame_count - 1);
    e->cold = fmin(e->cold, cold);
    e->warm = fmin(e->warm, warm);
    e->points = (double)points / w->pair_count;
}

static void print_row(const kind *k, const contestant *e, uint32_t count) {
    printf("%-24s", k->name);
    for (uint32_t i = 0; i < count; i++) {
        if (!e[i].self)
            printf("  %20s", "-");
        else
            printf("  %7.0f %6.0f %5.2f", 1e9 * e[i].cold, 1e9 * e[i].warm, e[i].points);
    }
    printf("  kept %.2f %.2f\n", contacts_get_kept(e[0].self), contacts_get_kept(e[1].self));
}

static int run_kind(const kind *k, const contacts_plan *plan, const contestants *all) {
    bodies set = k->vertices ? bodies_create_hulls(k->vertices, BODIES) : bodies_create_boxes(BODIES);
    placed *pairs = malloc(sizeof *pairs * plan->pairs * FRAMES);
    contestant e[PEERS_MOST + 2] = {{0}};
    contact_work work[2];
    int good = pairs && set.count;
    if (good) fill_frames(pairs, plan->pairs, &set, k);
    double size = good ? pairs[0].size : 1;
    for (int i = 0; i < 2; i++)
        work[i] = (contact_work){
            set.items, pairs, set.count, plan->pairs, FRAMES, MARGIN * size, (i ? 1 : 10) * MOTION * size};
    for (uint32_t i = 0; i < all->count + 2 && good; i++) {
        e[i] = (contestant){i < 2 ? &contacts_ours : all->peers[i - 2], NULL, INFINITY, INFINITY, 0};
        e[i].self = e[i].who->create(work + (i == 1));
        good = i >= 2 || e[i].self;
    }
    for (uint32_t r = 0; r < plan->rounds && good; r++)
        for (uint32_t i = 0; i < all->count + 2; i++)
            if (e[i].self) time_entrant(e + i, work);
    if (good) print_row(k, e, all->count + 2);
    for (uint32_t i = 0; i < all->count + 2; i++)
        if (e[i].self) e[i].who->destroy(e[i].self);
    bodies_destroy(&set);
    free(pairs);
    return good;
}

static int load(contestants *all, const char *path) {
    const contact_peer *const *(*get)(void) =
        (const contact_peer *const *(*)(void))module_load(path, "bench_get_contact_peers");
    if (!get) return 0;
    for (const contact_peer *const *p = get(); *p && all->count < PEERS_MOST; p++) all->peers[all->count++] = *p;
    return 1;
}

static const struct { const char *name, *path; } built[] = {OVOID_BENCH_CONTACT_MODULES{NULL, NULL}};

int contacts_run(const contacts_plan *plan) {
    contestants all = {.count = 0};
    for (int i = 0; built[i].name && !plan->alone; i++)
        if (*built[i].path) (void)load(&all, built[i].path);
    for (uint32_t i = 0; i < plan->module_count; i++)
        if (!load(&all, plan->modules[i])) return 0;
    printf(
        "nanoseconds a pair, cold and warm, and points a pair; ovoid at a tolerance of ten motions and of one\n%-24s",
        "");
    printf("  %20s  %20s", "ovoid, ten", "ovoid, one");
    for (uint32_t i = 0; i < all.count; i++) printf("  %20s", all.peers[i]->name);
    printf("\n");
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++)
        if (!plan->only || strstr(kinds[k].name, plan->only))
            if (!run_kind(kinds + k, plan, &all)) return 0;
    return 1;
}
