// ovoid as a contestant: a world for frames and for the monitor; for the planner a world of the parts alone, against
// which the links are queried as probes.
#include "many/many_ours.h"

#include <ovoid/ovoid.h>

// --- a swarm, and the monitor: a world

typedef struct self {
    const workcell *cell; ///< NULL: a swarm
    ovoid_world *world;
    ovoid_id *ids;
    uint32_t moving; ///< bodies 0 .. moving - 1 move
    ovoid_contact_query query;
    const swarm *what; ///< of a swarm
    // The planner's.
    ovoid_world *parts;
    ovoid_couple *couples;
    uint32_t couple_count;
} self;

static void destroy(void *state) {
    self *s = state;
    ovoid_world_destroy(s->world);
    ovoid_world_destroy(s->parts);
    free(s->couples);
    free(s->ids);
    free(s);
}

static self *create_world(uint32_t count, uint32_t threads) {
    self *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->ids = malloc(sizeof *s->ids * count);
    s->world = ovoid_world_create(&(ovoid_world_options){.threads = threads}, NULL);
    if (s->ids && s->world) return s;
    destroy(s);
    return NULL;
}

/// The bodies' ids are their numbers here, since they are added in order. 0, and the state destroyed, on failure.
static int add_bodies(self *s, const ovoid_world_body *list, uint32_t count) {
    if (list && ovoid_world_add_many(s->world, &(ovoid_world_additions){list, count, s->ids}, NULL) == OVOID_OK)
        return 1;
    destroy(s);
    return 0;
}

static void *create_swarm(const swarm *what, const ovoid_pose *poses) {
    self *s = create_world(what->body_count, what->threads);
    if (!s) return NULL;
    ovoid_world_body *list = calloc(what->body_count, sizeof *list);
    for (uint32_t i = 0; list && i < what->body_count; i++)
        list[i].body = (ovoid_body){.shape = what->shapes[what->shape_of[i]].shape, .pose = poses[i]};
    int good = add_bodies(s, list, what->body_count);
    free(list);
    if (!good) return NULL;
    s->moving = what->body_count;
    s->what = what;
    return s;
}

static uint32_t get_index(ovoid_id id) { return (uint32_t)(id >> 32); }

/// Moves all bodies and queries one frame; `all` receives the contacts whose status counts.
static void run_frame(self *s, const ovoid_pose *poses, meetings *all) {
    ovoid_contacts frame;
    if (ovoid_world_move_many(s->world, &(ovoid_world_moves){s->ids, poses, s->moving}, NULL) != OVOID_OK ||
        ovoid_world_compute_contacts(s->world, &s->query, &frame, NULL) != OVOID_OK) {
        all->failed = 1;
        return;
    }
    for (size_t i = 0; i < frame.count; i++) {
        const ovoid_contact *c = &frame.items[i];
        if (c->verdict.status == OVOID_SEPARATED && c->verdict.upper > s->query.margin) continue;
        meetings_add(all, get_index(c->a), get_index(c->b), c->verdict.upper);
    }
}

static void run_swarm(void *state, const ovoid_pose *poses, meetings *touching) { run_frame(state, poses, touching); }

static const swarm_peer our_swarm = {"ovoid", create_swarm, run_swarm, destroy};

/// The same frame with a contact point and the depth of each pair that touches.
static void *create_swarm_depth(const swarm *what, const ovoid_pose *poses) {
    self *s = create_swarm(what, poses);
    if (s) s->query.kind = OVOID_QUERY_DEPTH;
    return s;
}

static const swarm_peer our_depths = {"ovoid, a point each", create_swarm_depth, run_swarm, destroy};

/// Do two bodies touch whose bracket holds 0?
static int is_touching(const self *s, const ovoid_pose *poses, uint32_t a, uint32_t b) {
    const body *shapes = s->what->shapes;
    const ovoid_pair pair = {shapes[s->what->shape_of[a]].shape, shapes[s->what->shape_of[b]].shape, poses[a],
                             poses[b]};
    return ovoid_collide(&pair, NULL, NULL).status != OVOID_SEPARATED;
}

/// The same frame with up to four contact points of each pair. A kept manifold is used again while its bracket is not
/// wider than ten times the motion of a frame.
static void run_swarm_manifolds(void *state, const ovoid_pose *poses, meetings *touching) {
    self *s = state;
    const ovoid_world_manifold_query query = {.options = {.tolerance = 10 * s->what->step}};
    ovoid_world_manifolds frame;
    if (ovoid_world_move_many(s->world, &(ovoid_world_moves){s->ids, poses, s->moving}, NULL) != OVOID_OK ||
        ovoid_world_compute_manifolds(s->world, &query, &frame, NULL) != OVOID_OK) {
        touching->failed = 1;
        return;
    }
    for (size_t i = 0; i < frame.count; i++) {
        const ovoid_world_manifold *m = &frame.items[i];
        uint32_t a = get_index(m->a), b = get_index(m->b);
        if (m->verdict.status == OVOID_SEPARATED) continue;
        if (m->verdict.status != OVOID_OVERLAPPING && !is_touching(s, poses, a, b)) continue;
        meetings_add(touching, a, b, m->verdict.upper);
    }
}

static const swarm_peer our_manifolds = {"ovoid, manifolds", create_swarm, run_swarm_manifolds, destroy};

// --- a robot

enum { GROUP_LINK = 1, GROUP_PART = 2, LINKS_MOST = 16 };

/// Links and parts; only pairs with a link are queried.
static int add_cell(self *s, const workcell *what, const ovoid_pose *links) {
    uint32_t count = what->link_count + what->part_count;
    ovoid_world_body *list = calloc(count, sizeof *list);
    for (uint32_t i = 0; list && i < count; i++) {
        int is_link = i < what->link_count;
        const ovoid_pose *pose = is_link ? &links[i] : &what->parts[i - what->link_count];
        list[i] = (ovoid_world_body){
            .body = {.shape = what->shapes[what->shape_of[i]].shape, .pose = *pose},
            .groups = {is_link ? GROUP_LINK : GROUP_PART, is_link ? GROUP_LINK | GROUP_PART : GROUP_LINK}};
    }
    int good = add_bodies(s, list, count);
    free(list);
    for (uint32_t i = 0; good && i < what->link_count; i++)
        for (uint32_t k = i + 1; k < what->link_count; k++)
            if (what->ignored[i * what->link_count + k])
                (void)ovoid_world_add_ignored(s->world, s->ids[i], s->ids[k], NULL);
    return good;
}

/// The planner's world: parts alone.
static int add_parts(self *s, const workcell *what) {
    ovoid_world_body *list = calloc((size_t)what->part_count + 1, sizeof *list);
    for (uint32_t i = 0; list && i < what->part_count; i++)
        list[i].body =
            (ovoid_body){.shape = what->shapes[what->shape_of[what->link_count + i]].shape, .pose = what->parts[i]};
    s->parts = ovoid_world_create(NULL, NULL);
    int good = list && s->parts &&
               ovoid_world_add_many(s->parts, &(ovoid_world_additions){list, what->part_count, NULL}, NULL) == OVOID_OK;
    free(list);
    return good;
}

/// The pairs of links that are queried.
static int add_couples(self *s, const workcell *what) {
    uint32_t count = what->link_count;
    s->couples = malloc(sizeof *s->couples * count * count);
    if (!s->couples) return 0;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t k = i + 1; k < count; k++)
            if (!what->ignored[i * count + k]) s->couples[s->couple_count++] = (ovoid_couple){i, k};
    return 1;
}

static void *create_cell(const workcell *what, const ovoid_pose *links) {
    self *s = create_world(what->link_count + what->part_count, 1);
    if (!s || !add_cell(s, what, links)) return NULL;
    s->cell = what;
    s->moving = what->link_count;
    s->query = (ovoid_contact_query){.kind = OVOID_QUERY_DISTANCE, .margin = what->margin};
    if (add_parts(s, what) && add_couples(s, what)) return s;
    destroy(s);
    return NULL;
}

/// Queries the links as probes that are not in the world: with the parts, then with one another.
static int is_hit(void *state, const ovoid_pose *links) {
    self *s = state;
    ovoid_world_body probes[LINKS_MOST];
    for (uint32_t i = 0; i < s->moving; i++)
        probes[i] =
            (ovoid_world_body){.body = {.shape = s->cell->shapes[s->cell->shape_of[i]].shape, .pose = links[i]}};
    ovoid_world_probes all = {probes, s->moving, s->couples, s->couple_count};
    ovoid_world_hit hit;
    return ovoid_world_find_any_of(s->parts, &all, &hit, NULL) != OVOID_OK || hit.b;
}

static void measure(void *state, const ovoid_pose *links, meetings *near) { run_frame(state, links, near); }

static const cell_peer our_cell = {"ovoid", create_cell, is_hit, measure, destroy};

static const swarm_peer *const swarms[] = {&our_swarm, &our_depths, &our_manifolds, NULL};
static const cell_peer *const cells[] = {&our_cell, NULL};

many_peers many_get_ours(void) { return (many_peers){swarms, cells}; }
