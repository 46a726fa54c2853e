// Near pairs come from a world (broad phase and cached proofs, see <ovoid/world.h>); their answers come from new
// queries, so that they do not depend on earlier ones.
//
// Which pairs a world leaves out depends on the steps before: a cached proof may show that a pair is farther than the
// margin where a new query does not. What a query of its own may leave open is 1e-9 of the pair's size, and what the
// allowances of both bodies take from the distance of their polytopes, which no proof exceeds. So the world of a scene
// that moves is asked for a margin that is larger by that: every pair that it leaves out is proven farther than the
// margin by a query of its own too, whatever the steps before. The caller leaves out the rest by such queries
// (answers_job.reach).
#include "pairs/near.h"

#include "base/args.h"
#include "base/message.h"
#include "base/pipeline.h"
#include "pairs/answers.h"
#include "pairs/balls.h"

#include <math.h>
#include <stdlib.h>

/// Of a pair's size: what a query may leave open, ten times.
#define ROOM 1e-8

/// The largest number of pairs.
#define COUPLES_MAX 50000000

/// The largest number of pairs that a world may keep, with some 400 bytes for each.
#define CANDIDATES_MAX 10000000

/// Bodies that are moved by one call.
#define MOVES 1024

/// The object of an id: objects were added in order, to an empty world.
static uint32_t get_object(const cli_near *near, ovoid_id id) {
    uint32_t i = (uint32_t)((id >> 32) - (near->ids[0] >> 32));
    return near->objects ? near->objects[i] : i;
}

/// Called for each pair that comes near.
static int is_wanted(void *context, ovoid_id a, ovoid_id b) {
    cli_near *near = context;
    uint32_t p = get_object(near, a), q = get_object(near, b);
    if (!cut_has_pair(&near->cut, p < q ? p : q, p < q ? q : p)) return 0;
    if (ovoid_scene_is_ignored(near->scene, p, q)) return 0;
    atomic_fetch_add(&near->candidates, 1);
    return 1;
}

/// Allocates for the world; fails once there are too many pairs, so that it does not find and answer all of them.
static void *allocate(void *context, size_t size) {
    const cli_near *near = context;
    return near->candidates > CANDIDATES_MAX ? NULL : aligned_alloc(64, (size + 63) / 64 * 64);
}

static void release(void *context, void *memory) {
    (void)context;
    free(memory);
}

/// Lists the objects that a part of a scene at rest searches.
static int list_objects(cli_near *near) {
    size_t count = near->object_count;
    if (!near->cut.roles) return 0;
    near->objects = calloc(count + 1, sizeof *near->objects);
    if (!near->objects) return message_error("out of memory"), EXIT_INPUT;
    near->object_count = 0;
    for (size_t i = 0; i < count; i++)
        if (near->cut.roles[i] != CUT_FAR) near->objects[near->object_count++] = (uint32_t)i;
    return 0;
}

/// Of a part's objects those that are not its own are no pairs among themselves.
static ovoid_groups get_groups(const cli_near *near, uint32_t object) {
    if (!near->cut.roles) return (ovoid_groups){0, 0};
    return near->cut.roles[object] == CUT_OWN ? (ovoid_groups){1, 3} : (ovoid_groups){2, 1};
}

static int add_bodies(cli_near *near, const ovoid_pose *poses) {
    size_t count = near->object_count;
    ovoid_world_body *bodies = calloc(count + 1, sizeof *bodies);
    ovoid_error error = {OVOID_ERROR_MEMORY, -1, "out of memory"};
    near->ids = calloc(count + 1, sizeof *near->ids);
    int done = 0;
    if (bodies && near->ids) {
        for (size_t i = 0; i < count; i++) {
            uint32_t object = near->objects ? near->objects[i] : (uint32_t)i;
            bodies[i].body = answers_get_body(near->scene, object, &poses[object]);
            bodies[i].groups = get_groups(near, object);
        }
        done =
            ovoid_world_add_many(near->world, &(ovoid_world_additions){bodies, count, near->ids}, &error) == OVOID_OK;
    }
    free(bodies);
    if (!done) message_error("%s", error.message);
    return done ? 0 : EXIT_INPUT;
}

/// Tells the empty world the margin, which would change the boxes of all bodies later.
static int set_margin(const cli_near *near) {
    ovoid_error error;
    ovoid_contacts none;
    if (ovoid_world_compute_contacts(near->world, &near->query, &none, &error) == OVOID_OK) return 0;
    return message_error("%s", error.message), EXIT_INPUT;
}

static int create_world(cli_near *near, unsigned threads) {
    ovoid_error error;
    size_t most = near->object_count < OVOID_WORLD_THREADS_MAX ? near->object_count : OVOID_WORLD_THREADS_MAX;
    threads = pipeline_get_threads(threads);
    const ovoid_allocator allocator = {allocate, release, near};
    ovoid_world_options options = {.threads = threads < most ? threads : (uint32_t)most,
                                   .allocator = &allocator,
                                   .filter = is_wanted,
                                   .filter_context = near};
    near->world = ovoid_world_create(&options, &error);
    if (near->world) return set_margin(near);
    return message_error("%s", error.message), EXIT_INPUT;
}

/// How much farther than the margin the world of a scene that moves is asked; negative after a message.
static double find_room(const near_request *request) {
    double reach = 0, width = 0;
    size_t count = ovoid_scene_get_count(request->scene);
    cli_balls balls = balls_create(count);
    if (!balls.slots) return message_error("out of memory"), -1;
    for (size_t i = 0; i < count; i++) {
        ovoid_body body = answers_get_body(request->scene, i, &request->poses[i]);
        const cli_ball *ball = balls_find(&balls, &body);
        const ovoid_vec3 c = ball->center;
        reach = fmax(reach, ball->radius + fabs(c.x) + fabs(c.y) + fabs(c.z));
        width = fmax(width, answers_find_width(&body));
    }
    balls_destroy(&balls);
    // The size of a pair has the reach of both bodies, and the distance of their frames.
    return 2 * width + ROOM * (4 * reach + request->margin);
}

int near_open(cli_near *near, const near_request *request) {
    *near = (cli_near){.scene = request->scene,
                       .part = request->part,
                       .is_still = request->is_still,
                       .object_count = ovoid_scene_get_count(request->scene)};
    if (request->margin < 0) return 0;
    double room = request->is_still ? 0 : find_room(request);
    if (room < 0) return EXIT_INPUT;
    near->query = (ovoid_contact_query){.kind = OVOID_QUERY_WITHIN, .margin = request->margin + room};
    const near_scene of = {request->scene, request->poses, request->margin};
    int code = request->is_still ? cut_open(&near->cut, &of, request->part) : 0;
    if (!code) code = list_objects(near);
    if (!code) code = create_world(near, request->threads);
    if (!code) code = add_bodies(near, request->poses);
    if (code) near_close(near);
    return code;
}

void near_close(cli_near *near) {
    ovoid_world_destroy(near->world);
    free(near->ids);
    free(near->objects);
    free(near->couples);
    cut_close(&near->cut);
    near->world = NULL;
    near->ids = NULL;
    near->objects = NULL;
    near->couples = NULL;
}

int near_move(cli_near *near, const uint32_t *moved, size_t count, const ovoid_pose *poses) {
    ovoid_id ids[MOVES];
    ovoid_pose to[MOVES];
    ovoid_error error;
    for (size_t done = 0; near->world && done < count; done += MOVES) {
        size_t n = count - done < MOVES ? count - done : MOVES;
        for (size_t i = 0; i < n; i++) {
            ids[i] = near->ids[moved[done + i]];
            to[i] = poses[moved[done + i]];
        }
        if (ovoid_world_move_many(near->world, &(ovoid_world_moves){ids, to, n}, &error) == OVOID_OK) continue;
        return message_error("%s", error.message), EXIT_INPUT;
    }
    return 0;
}

/// Room for more couples. 0, or EXIT_INPUT after a message.
static int reserve(cli_near *near, size_t count) {
    if (count <= near->capacity) return 0;
    size_t capacity = 2 * near->capacity > count ? 2 * near->capacity : count;
    ovoid_couple *couples = count > COUPLES_MAX ? NULL : realloc(near->couples, capacity * sizeof *couples);
    if (couples) {
        near->couples = couples;
        near->capacity = capacity;
        return 0;
    }
    if (count <= COUPLES_MAX)
        message_error("out of memory for %zu pairs", capacity);
    else
        message_error("too many pairs: above %d; %s", COUPLES_MAX,
                      near->world      ? "give a smaller --margin"
                      : near->is_still ? "give --margin to leave out far pairs, or --shard"
                                       : "give --margin to leave out far pairs");
    return EXIT_INPUT;
}

static int find_all(cli_near *near) {
    size_t count = ovoid_scene_get_count(near->scene);
    near->count = 0;
    for (size_t a = 0; a < count; a++)
        for (size_t b = a + 1, end; b < count; b = end) {
            // The next pairs of the row that belong to one shard.
            end = b / SHARD_ROW * SHARD_ROW + SHARD_ROW < count ? b / SHARD_ROW * SHARD_ROW + SHARD_ROW : count;
            if (!shard_part_has_pair(near->part, (uint32_t)a, (uint32_t)b)) continue;
            if (reserve(near, near->count + end - b)) return EXIT_INPUT;
            for (size_t i = b; i < end; i++)
                if (!ovoid_scene_is_ignored(near->scene, a, i))
                    near->couples[near->count++] = (ovoid_couple){(uint32_t)a, (uint32_t)i};
        }
    return 0;
}

int near_find(cli_near *near) {
    ovoid_error error;
    ovoid_contacts frame;
    // The list of all pairs never changes.
    if (!near->world) return near->count ? 0 : find_all(near);
    atomic_store(&near->candidates, near->count);
    ovoid_code code = ovoid_world_compute_contacts(near->world, &near->query, &frame, &error);
    if (near->candidates > CANDIDATES_MAX) {
        message_error("more than %d pairs are near each other; give a smaller --margin%s", CANDIDATES_MAX,
                      ovoid_scene_get_pair_count(near->scene) <= COUPLES_MAX ? ", or none" : "");
        return EXIT_INPUT;
    }
    if (code) return message_error("%s", error.message), EXIT_INPUT;
    if (reserve(near, frame.count)) return EXIT_INPUT;
    for (size_t i = 0; i < frame.count; i++)
        near->couples[i] = (ovoid_couple){get_object(near, frame.items[i].a), get_object(near, frame.items[i].b)};
    near->count = frame.count;
    return 0;
}
