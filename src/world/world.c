// Creating and destroying a world, adding and removing bodies. Everything that can fail is done before anything
// changes.
#include "world/state.h"

#include "base/environment.h"
#include "base/error.h"
#include "compound/compound.h"
#include "world/body_bounds.h"
#include "world/manifold_list.h"
#include "world/material.h"
#include "world/move.h"

#include <string.h>

// ---- the world

static ovoid_code validate_options(const ovoid_world_options *o, ovoid_error *error) {
    if (o->threads > OVOID_WORLD_THREADS_MAX)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "%u threads: a world has at most %u", o->threads,
                         OVOID_WORLD_THREADS_MAX);
    if (!(o->enlargement >= 0 && o->enlargement <= 100))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "enlargement %.17g: it must be in 0 .. 100", o->enlargement);
    if (!o->tasks.start != !o->tasks.finish)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "tasks: start and finish must both be set, or none");
    return OVOID_OK;
}

static ovoid_world *refuse_world(ovoid_world *w, ovoid_error *error) {
    error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for a world");
    ovoid_world_destroy(w);
    return NULL;
}

static ovoid_world *create(const ovoid_world_options *given, ovoid_error *error) {
    ovoid_world_options o = {.threads = 0};
    if (given) o = *given;
    if (validate_options(&o, error) != OVOID_OK) return NULL;
    ovoid_allocator allocator = allocator_make(o.allocator);
    ovoid_world *w = allocator_allocate(&allocator, 1, sizeof *w);
    if (!w) return refuse_world(NULL, error);
    *w = (ovoid_world){.allocator = allocator,
                       .host = {NULL, o.tasks},
                       .enlargement = o.enlargement,
                       .filter = o.filter,
                       .filter_context = o.filter_context,
                       .memory = sizeof *w};
    w->threads = o.threads ? o.threads : 1;
    w->free = NONE;
    w->gathered = world_allocate(w, w->threads, sizeof *w->gathered);
    if (!w->gathered) return refuse_world(w, error);
    memset(w->gathered, 0, w->threads * sizeof *w->gathered);
    w->point = ovoid_shape_create_sphere(0, &(ovoid_shape_options){.allocator = &w->allocator}, error);
    if (!w->point) return refuse_world(w, error);
    if (w->threads > 1 && !o.tasks.start) {
        w->host.own = thread_pool_create(w->threads, &w->allocator, error);
        if (!w->host.own) {
            ovoid_world_destroy(w);
            return NULL;
        }
    }
    return w;
}

ovoid_world *ovoid_world_create(const ovoid_world_options *options, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_world *, options, create(options, error));
}

static void destroy(ovoid_world *w) {
    thread_pool_destroy(w->host.own, &w->allocator);
    ovoid_shape_destroy(w->point);
    void *all[] = {w->bodies,       w->places,      w->marks,      w->leaf_of,
                   w->changed,      w->generations, w->tree.nodes, w->ignored.keys,
                   w->pairs,        w->pair_cache,  w->witnesses,  w->free_slots,
                   w->keys,         w->chunks,      w->contacts,   w->contact_witnesses,
                   w->cover_memory, w->tree.wide,   w->materials,  w->ranges,
                   w->seen,         w->ended,       w->depths};
    manifolds_destroy(w);
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) allocator_release(&w->allocator, all[i]);
    for (uint32_t i = 0; w->gathered && i < w->threads; i++) allocator_release(&w->allocator, w->gathered[i].keys);
    allocator_release(&w->allocator, w->gathered);
    ovoid_allocator allocator = w->allocator;
    allocator_release(&allocator, w);
}

void ovoid_world_destroy(ovoid_world *w) {
    if (!w) return;
    ENVIRONMENT_RUN(destroy(w));
}

size_t ovoid_world_get_count(const ovoid_world *w) { return w->count; }

// ---- adding

static ovoid_code refuse_memory(ovoid_error *error, size_t count) {
    return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for %zu more bodies; the world is as it was", count);
}

// The arrays indexed by body grow together: all or none.
static int reserve_bodies(ovoid_world *w, uint32_t count) {
    if (count <= w->capacity) return 1;
    uint32_t room = w->capacity < OVOID_WORLD_BODIES / 2 && 2 * w->capacity > count ? 2 * w->capacity : count;
    if (room < 16) room = 16;
    enum { ARRAYS = 8 };
    const size_t sizes[ARRAYS] = {sizeof *w->bodies,         sizeof *w->places,  sizeof *w->marks,
                                  sizeof *w->leaf_of,        sizeof *w->changed, sizeof *w->generations,
                                  2 * sizeof *w->tree.nodes, sizeof *w->seen};
    void *larger[ARRAYS];
    void *const old[ARRAYS] = {w->bodies,  w->places,      w->marks,      w->leaf_of,
                               w->changed, w->generations, w->tree.nodes, w->seen};
    for (int i = 0; i < ARRAYS; i++) {
        larger[i] = world_allocate(w, (size_t)room + 1, sizes[i]);
        if (larger[i]) continue;
        while (i--) world_release(w, larger[i], (size_t)room + 1, sizes[i]);
        return 0;
    }
    // Only the used nodes are copied; there are two for each body and two more.
    const size_t used[ARRAYS] = {w->used, w->used, w->used, w->used, w->changed_count, w->used, (w->tree.used + 1) / 2,
                                 w->used};
    for (int i = 0; i < ARRAYS; i++) {
        if (old[i] && used[i]) memcpy(larger[i], old[i], used[i] * sizes[i]);
        if (old[i]) world_release(w, old[i], (size_t)w->capacity + 1, sizes[i]);
    }
    w->bodies = larger[0];
    w->places = larger[1];
    w->marks = larger[2];
    w->leaf_of = larger[3];
    w->changed = larger[4];
    w->generations = larger[5];
    w->seen = larger[7];
    if (w->tree.nodes) {
        w->tree.nodes = larger[6];
        w->tree.capacity = room;
    } else {
        dynamic_tree_make(&w->tree, larger[6], room);
    }
    w->capacity = room;
    return 1;
}

static uint32_t take_index(ovoid_world *w) {
    uint32_t i = w->free;
    if (i != NONE) {
        w->free = w->bodies[i].next;
        return i;
    }
    i = w->used++;
    w->generations[i] = 1;
    w->marks[i] = 0;
    return i;
}

// Stores a body, but does not add its leaf.
static uint32_t add_record(ovoid_world *w, const ovoid_world_body *given) {
    uint32_t i = take_index(w);
    world_body *b = &w->bodies[i];
    body_sphere ball = body_compute_sphere(&given->body);
    *b = (world_body){.body = given->body,
                      .local = ball.local,
                      .reach = ball.reach,
                      .radius = ball.radius,
                      .size = ball.size,
                      .user = given->user,
                      .groups = groups_make(given->groups)};
    w->places[i] = (body_place){body_compute_center(&ball, &b->body.pose, &b->center_error), 0};
    material_forget(w, i);
    if (world_get_extent(&given->body) > OVOID_LENGTH_MAX / 2) w->has_vast = 1;
    body_mark_fresh(w, i);
    w->count++;
    return i;
}

static ovoid_code validate_room(const ovoid_world *w, size_t count, ovoid_error *error) {
    if (count <= OVOID_WORLD_BODIES - (size_t)w->count) return OVOID_OK;
    return error_set(error, OVOID_ERROR_LIMIT, -1, "a world holds at most %u bodies", OVOID_WORLD_BODIES);
}

// Adds many leaves at once: builds one new tree over all.
static int add_by_building(ovoid_world *w, const ovoid_world_additions *all) {
    uint32_t count = (uint32_t)all->count;
    size_t total = (size_t)w->count + count;
    tree_item *items = world_allocate(w, total, sizeof *items);
    if (!items) return 0;
    size_t at = 0;
    for (uint32_t i = 0; i < w->used; i++)
        if (w->leaf_of[i] != NONE) items[at++] = (tree_item){w->tree.nodes[w->leaf_of[i]].bounds, i};
    for (uint32_t k = 0; k < count; k++) {
        uint32_t i = add_record(w, &all->bodies[k]);
        items[at++] = (tree_item){world_compute_box(w, i), i};
        if (all->ids) all->ids[k] = body_get_id(w, i);
    }
    dynamic_tree_build(&w->tree, items, (uint32_t)total, w->leaf_of);
    world_release(w, items, total, sizeof *items);
    world_widen_tree(w);
    return 1;
}

static ovoid_code add_many(ovoid_world *w, const ovoid_world_additions *all, ovoid_error *error) {
    OVOID_ASSERT(w && all && (all->bodies || !all->count));
    size_t count = all->count;
    ovoid_code code = validate_room(w, count, error);
    for (size_t k = 0; k < count && code == OVOID_OK; k++)
        code = world_validate_body(&all->bodies[k].body, (int64_t)k, error);
    if (code != OVOID_OK) return code;
    // Indices in use: at most the bodies at one time, and freed ones.
    if (!reserve_bodies(w, w->used + (uint32_t)count)) return refuse_memory(error, count);
    if (count > 64 && count > w->count / 4) return add_by_building(w, all) ? OVOID_OK : refuse_memory(error, count);
    for (size_t k = 0; k < count; k++) {
        uint32_t i = add_record(w, &all->bodies[k]);
        box bounds = world_compute_box(w, i);
        dynamic_tree_add(&w->tree, i, &bounds, w->leaf_of);
        if (all->ids) all->ids[k] = body_get_id(w, i);
    }
    return OVOID_OK;
}

ovoid_code ovoid_world_add_many(ovoid_world *w, const ovoid_world_additions *additions, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, w, add_many(w, additions, error));
}

ovoid_id ovoid_world_add(ovoid_world *w, const ovoid_world_body *given, ovoid_error *error) {
    ovoid_id id = 0;
    const ovoid_world_additions one = {given, 1, &id};
    return ovoid_world_add_many(w, &one, error) == OVOID_OK ? id : 0;
}

// ---- removing

// Removes a body's ignored pairs, and lowers the counts of the other bodies.
static void remove_ignored(ovoid_world *w, uint32_t i) {
    for (size_t k = 0; k < w->ignored.capacity; k++) {
        uint64_t key = w->ignored.keys[k];
        if (key == IGNORED_NONE || (key_get_a(key) != i && key_get_b(key) != i)) continue;
        w->bodies[key_get_a(key) == i ? key_get_b(key) : key_get_a(key)].next--;
    }
    ignored_remove_body(&w->ignored, i);
}

static void remove_body(ovoid_world *w, uint32_t i) {
    world_body *b = &w->bodies[i];
    if (b->next) remove_ignored(w, i);
    body_mark_fresh(w, i);
    dynamic_tree_remove(&w->tree, w->leaf_of[i], w->leaf_of);
    w->leaf_of[i] = NONE;
    if (++w->generations[i] == 0) w->generations[i] = 1;
    b->next = w->free;
    w->free = i;
    w->count--;
}

// OVOID_OK if all ids are valid, and none occurs twice.
static ovoid_code validate_ids(ovoid_world *w, const ovoid_id *ids, size_t count, ovoid_error *error) {
    size_t k = 0;
    for (; k < count; k++) {
        uint32_t i = world_find_body(w, ids[k]);
        if (i == NONE || w->marks[i] & MARK_NAMED) break;
        w->marks[i] |= MARK_NAMED;
    }
    for (size_t j = 0; j < k; j++) w->marks[ids[j] >> 32] &= (uint8_t)~MARK_NAMED;
    return k == count ? OVOID_OK : world_refuse_id(error, (int64_t)k, ids[k]);
}

static ovoid_code remove_many(ovoid_world *w, const ovoid_id *ids, size_t count, ovoid_error *error) {
    OVOID_ASSERT(w && (ids || !count));
    ovoid_code code = validate_ids(w, ids, count, error);
    if (code != OVOID_OK) return code;
    for (size_t k = 0; k < count; k++) remove_body(w, (uint32_t)(ids[k] >> 32));
    return OVOID_OK;
}

ovoid_code ovoid_world_remove_many(ovoid_world *w, const ovoid_id *ids, size_t count, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, count, remove_many(w, ids, count, error));
}

ovoid_code ovoid_world_remove(ovoid_world *w, ovoid_id id, ovoid_error *error) {
    return ovoid_world_remove_many(w, &id, 1, error);
}

// ---- accessors

ovoid_world_body ovoid_world_make_point(const ovoid_world *w, ovoid_vec3 point) {
    return (ovoid_world_body){.body = {.shape = w->point, .pose = {point, {1, 0, 0, 0}}}};
}

ovoid_code ovoid_world_get(const ovoid_world *w, ovoid_id id, ovoid_world_body *out, ovoid_error *error) {
    uint32_t i = world_find_body(w, id);
    if (i == NONE) return world_refuse_id(error, -1, id);
    const world_body *b = &w->bodies[i];
    *out = (ovoid_world_body){b->body, b->groups, b->user};
    return OVOID_OK;
}

ovoid_id ovoid_world_find_next(const ovoid_world *w, ovoid_id after) {
    for (uint64_t i = after ? (after >> 32) + 1 : 0; i < w->used; i++)
        if (w->leaf_of[i] != NONE) return body_get_id(w, (uint32_t)i);
    return 0;
}
