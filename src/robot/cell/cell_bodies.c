// Cells: obstacles, attached bodies, paddings and allowed pairs come and go here; cell_compile.c makes arrays of them.
#include "robot/cell/cell.h"

#include "base/environment.h"
#include "base/error.h"

#include <string.h>

// ---- arrays

int cell_reserve(const ovoid_allocator *memory, cell_array *a, size_t count, size_t size) {
    if (count <= a->capacity) return 1;
    size_t capacity = count + count / 2 + 8;
    void *items = allocator_allocate(memory, capacity, size);
    if (!items) return 0;
    if (a->count) memcpy(items, a->items, a->count * size);
    allocator_release(memory, a->items);
    a->items = items;
    a->capacity = capacity;
    return 1;
}

// The place of a key, or the place that it would have.
static size_t find_key(const cell_array *keys, uint64_t key) {
    const uint64_t *k = keys->items;
    size_t low = 0, high = keys->count;
    while (low < high) {
        size_t middle = low + (high - low) / 2;
        if (k[middle] < key)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

int keys_are_holding(const cell_array *keys, uint64_t key) {
    size_t at = find_key(keys, key);
    return at < keys->count && ((const uint64_t *)keys->items)[at] == key;
}

ovoid_code keys_set(const ovoid_allocator *memory, cell_array *keys, uint64_t key, int is_in) {
    if (keys_are_holding(keys, key) == !!is_in) return OVOID_OK;
    if (!cell_reserve(memory, keys, keys->count + 1, sizeof key)) return OVOID_ERROR_MEMORY;
    size_t at = find_key(keys, key), rest = keys->count - at;
    uint64_t *k = keys->items;
    if (is_in) {
        memmove(k + at + 1, k + at, rest * sizeof *k);
        k[at] = key;
        keys->count++;
    } else {
        memmove(k + at, k + at + 1, (rest - 1) * sizeof *k);
        keys->count--;
    }
    return OVOID_OK;
}

// ---- create, destroy

// The topmost link that each link never moves against.
static void find_rigid(const ovoid_robot *r, uint32_t *rigid) {
    rigid[r->root] = r->root;
    for (uint32_t i = 0; i < r->joint_count; i++) {
        const ovoid_robot_joint *j = &r->joints[r->order[i]];
        rigid[j->child] = j->type == OVOID_JOINT_FIXED ? rigid[j->parent] : j->child;
    }
}

static ovoid_robot_cell *create(const ovoid_robot *robot, const ovoid_allocator *allocator, ovoid_error *error) {
    if (!robot) {
        error_write(error, OVOID_ERROR_ARGUMENT, -1, "a cell needs a robot");
        return NULL;
    }
    ovoid_allocator memory = allocator_make(allocator);
    ovoid_robot_cell *c = allocator_allocate(&memory, 1, sizeof *c);
    if (c) {
        *c = (ovoid_robot_cell){.robot = robot, .allocator = memory, .version = 1};
        c->padding = allocator_allocate(&memory, robot->link_count, sizeof *c->padding);
        c->rigid = allocator_allocate(&memory, robot->link_count, sizeof *c->rigid);
    }
    if (!c || !c->padding || !c->rigid) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for a cell");
        ovoid_robot_cell_destroy(c);
        return NULL;
    }
    for (uint32_t i = 0; i < robot->link_count; i++) c->padding[i] = 0;
    find_rigid(robot, c->rigid);
    if (cell_compile(c, error) == OVOID_OK) return c;
    ovoid_robot_cell_destroy(c);
    return NULL;
}

ovoid_robot_cell *ovoid_robot_cell_create(const ovoid_robot *robot, const ovoid_robot_cell_options *options,
                                          ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_robot_cell *, robot, create(robot, options ? options->allocator : NULL, error));
}

static void release_hull(cell_body *b) {
    ovoid_shape_destroy(b->hull);
    b->hull = NULL;
}

static void destroy(ovoid_robot_cell *c) {
    ovoid_allocator memory = c->allocator;
    for (size_t i = 0; i < c->bodies.count; i++) release_hull((cell_body *)c->bodies.items + i);
    void *all[] = {c->bodies.items, c->allowed_links.items, c->allowed_bodies.items, c->padding,
                   c->rigid,        c->items.items,         c->parts.items,          c->boxes.items,
                   c->pairs.items,  c->groups.items,        c->insides.items,        c->group_pairs.items,
                   c->own.items,    c->steps.items,         c->step_joints.items,    c};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) allocator_release(&memory, all[i]);
}

void ovoid_robot_cell_destroy(ovoid_robot_cell *cell) {
    if (!cell) return;
    ENVIRONMENT_RUN(destroy(cell));
}

int ovoid_robot_is_rigid_pair(const ovoid_robot *robot, uint32_t a, uint32_t b) {
    // The tops of both, up the fixed joints.
    uint32_t top[2] = {a, b};
    for (int k = 0; k < 2; k++)
        for (uint32_t j = robot->parent_joint[top[k]];
             j != OVOID_ROBOT_NONE && robot->joints[j].type == OVOID_JOINT_FIXED; j = robot->parent_joint[top[k]])
            top[k] = robot->joints[j].parent;
    return top[0] == top[1];
}

// ---- bodies

static ovoid_code validate_body(const ovoid_body *body, ovoid_error *error) {
    if (!body || !!body->shape + !!body->compound + !!body->solid != 1)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "a body needs exactly one of shape, compound and solid");
    ovoid_code code = ovoid_pose_validate(&body->pose);
    return code == OVOID_OK ? code
                            : error_set(error, code, -1, "the body's pose is refused: %s", ovoid_code_get_name(code));
}

// The hull that a solid's boxes and cheap proofs are of; NULL for all else.
static ovoid_code create_hull(const ovoid_robot_cell *c, const ovoid_body *body, ovoid_shape **hull,
                              ovoid_error *error) {
    const ovoid_shape_options options = {.allocator = &c->allocator};
    *hull = NULL;
    if (!body->solid) return OVOID_OK;
    ovoid_error why;
    size_t count = (size_t)ovoid_solid_get_report(body->solid).points;
    *hull = ovoid_shape_create_from_points(ovoid_solid_get_points(body->solid), count, &options, &why);
    if (*hull) return OVOID_OK;
    return error_set(error, why.code, -1, "the hull of a solid cannot be made: %s", why.message);
}

// What is inside a solid, for which there is the hull.
static ovoid_code find_inside(const ovoid_robot_cell *c, const ovoid_body *body, const ovoid_shape *hull,
                              shape_inside *inside, ovoid_error *error) {
    *inside = (shape_inside){.size = 0};
    if (!hull) return OVOID_OK;
    ovoid_shape *point = shape_create_point(&c->allocator);
    ovoid_code code = point ? shape_inside_find(hull, body->solid, point, inside) : OVOID_ERROR_MEMORY;
    ovoid_shape_destroy(point);
    return code == OVOID_OK ? code : error_set(error, code, -1, "no memory for a body of the cell");
}

// A free slot; it is used only once the body has its place.
static ovoid_code find_slot(ovoid_robot_cell *c, uint32_t *slot) {
    cell_body *bodies = c->bodies.items;
    for (; c->used < c->bodies.count; c->used++)
        if (!bodies[c->used].is_used) return *slot = c->used, OVOID_OK;
    if (!cell_reserve(&c->allocator, &c->bodies, c->bodies.count + 1, sizeof(cell_body))) return OVOID_ERROR_MEMORY;
    *slot = (uint32_t)c->bodies.count++;
    ((cell_body *)c->bodies.items)[*slot] = (cell_body){.generation = 0};
    return OVOID_OK;
}

static void forget_allowed(ovoid_robot_cell *c, uint32_t slot) {
    uint64_t *k = c->allowed_bodies.items;
    size_t kept = 0;
    for (size_t i = 0; i < c->allowed_bodies.count; i++)
        if ((uint32_t)(k[i] >> 32) != slot) k[kept++] = k[i];
    c->allowed_bodies.count = kept;
}

static ovoid_id add(ovoid_robot_cell *c, const ovoid_robot_attachment *given, ovoid_error *error) {
    const ovoid_body *body = &given->body;
    const uint32_t *touching = given->touching;
    size_t count = given->touching_count;
    uint32_t slot = 0, link = given->link;
    ovoid_shape *hull;
    ovoid_code code = validate_body(body, error);
    if (code != OVOID_OK) return 0;
    for (size_t i = 0; i < count; i++)
        if (touching[i] >= c->robot->link_count)
            return (void)error_set(error, OVOID_ERROR_INDEX, (int64_t)i, "there is no link %u", touching[i]), 0;
    if (create_hull(c, body, &hull, error) != OVOID_OK) return 0;
    shape_inside inside;
    code = find_inside(c, body, hull, &inside, error);
    if (code == OVOID_OK) code = find_slot(c, &slot);
    if (code == OVOID_OK) {
        cell_body *b = (cell_body *)c->bodies.items + slot;
        *b = (cell_body){*body, hull, inside.region, inside.gap, b->generation + 1, link, 1};
        for (size_t i = 0; code == OVOID_OK && i < count; i++)
            code = keys_set(&c->allocator, &c->allowed_bodies, cell_make_key(slot, touching[i]), 1);
        if (code == OVOID_OK) {
            code = link == OVOID_ROBOT_NONE ? cell_append_obstacle(c, slot, error) : cell_compile(c, error);
            if (code == OVOID_OK) return cell_make_id(slot, b->generation);
        }
        ((cell_body *)c->bodies.items)[slot].is_used = 0;
        ((cell_body *)c->bodies.items)[slot].hull = NULL;
        forget_allowed(c, slot);
        (void)cell_compile(c, NULL); // no larger than before: its memory is there
    }
    ovoid_shape_destroy(hull);
    if (code == OVOID_ERROR_MEMORY) error_write(error, code, -1, "no memory for a body of the cell");
    return 0;
}

ovoid_id ovoid_robot_cell_add(ovoid_robot_cell *cell, const ovoid_body *body, ovoid_error *error) {
    const ovoid_robot_attachment obstacle = {.link = OVOID_ROBOT_NONE, .body = *body};
    ENVIRONMENT_RETURN(ovoid_id, cell, add(cell, &obstacle, error));
}

static ovoid_code validate_link(const ovoid_robot_cell *c, uint32_t link, ovoid_error *error) {
    if (link < c->robot->link_count) return OVOID_OK;
    return error_set(error, OVOID_ERROR_INDEX, -1, "there is no link %u, but %u", link, c->robot->link_count);
}

ovoid_id ovoid_robot_cell_attach(ovoid_robot_cell *cell, const ovoid_robot_attachment *attachment, ovoid_error *error) {
    if (validate_link(cell, attachment->link, error) != OVOID_OK) return 0;
    ENVIRONMENT_RETURN(ovoid_id, cell, add(cell, attachment, error));
}

// 1 if the id is of a body that is there.
static int is_body(const ovoid_robot_cell *c, ovoid_id id) {
    uint32_t slot = (uint32_t)(id >> 32);
    if (slot >= c->bodies.count) return 0;
    const cell_body *b = &cell_bodies(c)[slot];
    return b->is_used && cell_make_id(slot, b->generation) == id;
}

// The slot of an id, or NULL with the error.
static cell_body *find_body(ovoid_robot_cell *c, ovoid_id id, ovoid_error *error) {
    if (is_body(c, id)) return (cell_body *)c->bodies.items + (uint32_t)(id >> 32);
    error_write(error, OVOID_ERROR_INDEX, -1, "the id is of no body of this cell");
    return NULL;
}

static ovoid_code remove_body(ovoid_robot_cell *c, ovoid_id id, ovoid_error *error) {
    cell_body *b = find_body(c, id, error);
    if (!b) return OVOID_ERROR_INDEX;
    uint32_t slot = (uint32_t)(id >> 32);
    b->is_used = 0;
    release_hull(b);
    c->used = slot < c->used ? slot : c->used;
    forget_allowed(c, slot);
    return cell_compile(c, error);
}

ovoid_code ovoid_robot_cell_remove(ovoid_robot_cell *cell, ovoid_id id, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, id, remove_body(cell, id, error));
}

static ovoid_code move(ovoid_robot_cell *c, ovoid_id id, const ovoid_pose *pose, ovoid_error *error) {
    cell_body *b = find_body(c, id, error);
    if (!b) return OVOID_ERROR_INDEX;
    ovoid_body moved = b->body;
    moved.pose = *pose;
    ovoid_code code = validate_body(&moved, error);
    if (code != OVOID_OK) return code;
    b->body.pose = *pose;
    if (b->link != OVOID_ROBOT_NONE) return cell_compile(c, error);
    cell_place_parts(c);
    c->moved++;
    return OVOID_OK;
}

ovoid_code ovoid_robot_cell_move(ovoid_robot_cell *cell, ovoid_id id, const ovoid_pose *pose, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, id, move(cell, id, pose, error));
}

// ---- pairs and paddings

static ovoid_code set_allowed(ovoid_robot_cell *c, ovoid_couple links, int allowed, ovoid_error *error) {
    uint32_t a = links.a, b = links.b;
    ovoid_code code = validate_link(c, a, error);
    if (code == OVOID_OK) code = validate_link(c, b, error);
    if (code == OVOID_OK && a == b)
        code = error_set(error, OVOID_ERROR_ARGUMENT, -1, "a link and itself are no pair: %u", a);
    if (code != OVOID_OK) return code;
    code = keys_set(&c->allocator, &c->allowed_links, cell_make_key(a < b ? a : b, a < b ? b : a), allowed);
    if (code != OVOID_OK) return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a pair of links");
    return cell_compile(c, error);
}

ovoid_code ovoid_robot_cell_add_allowed(ovoid_robot_cell *cell, uint32_t a, uint32_t b, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, cell, set_allowed(cell, (ovoid_couple){a, b}, 1, error));
}

ovoid_code ovoid_robot_cell_remove_allowed(ovoid_robot_cell *cell, uint32_t a, uint32_t b, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, cell, set_allowed(cell, (ovoid_couple){a, b}, 0, error));
}

// A body of the cell and a link.
typedef struct body_and_link {
    ovoid_id id;
    uint32_t link;
} body_and_link;

static ovoid_code set_body_allowed(ovoid_robot_cell *c, body_and_link pair, int allowed, ovoid_error *error) {
    ovoid_code code = validate_link(c, pair.link, error);
    if (code != OVOID_OK) return code;
    const cell_body *b = find_body(c, pair.id, error);
    if (!b) return OVOID_ERROR_INDEX;
    uint64_t key = cell_make_key((uint32_t)(pair.id >> 32), pair.link);
    code = keys_set(&c->allocator, &c->allowed_bodies, key, allowed);
    if (code != OVOID_OK) return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a pair");
    if (b->link != OVOID_ROBOT_NONE || !c->is_whole) return cell_compile(c, error);
    // The links that are allowed to touch an obstacle change nothing in the arrays.
    c->version++;
    return OVOID_OK;
}

ovoid_code ovoid_robot_cell_add_body_allowed(ovoid_robot_cell *cell, ovoid_id id, uint32_t link, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, id, set_body_allowed(cell, (body_and_link){id, link}, 1, error));
}

ovoid_code ovoid_robot_cell_remove_body_allowed(ovoid_robot_cell *cell, ovoid_id id, uint32_t link,
                                                ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, id, set_body_allowed(cell, (body_and_link){id, link}, 0, error));
}

ovoid_code ovoid_robot_cell_set_padding(ovoid_robot_cell *cell, uint32_t link, double padding, ovoid_error *error) {
    ovoid_code code = validate_link(cell, link, error);
    if (code != OVOID_OK) return code;
    if (!(padding >= 0 && padding <= OVOID_LENGTH_MAX))
        return error_set(error, OVOID_ERROR_RADIUS, -1, "a padding is a length from 0 to 1e50");
    cell->padding[link] = padding;
    cell->moved++;
    return OVOID_OK;
}

int ovoid_robot_cell_is_allowed(const ovoid_robot_cell *cell, uint32_t a, uint32_t b) {
    return !cell_are_links_queried(cell, a, b);
}

int ovoid_robot_cell_is_body_allowed(const ovoid_robot_cell *cell, ovoid_id id, uint32_t link) {
    if (!is_body(cell, id)) return 0;
    uint32_t slot = (uint32_t)(id >> 32), holder = cell_bodies(cell)[slot].link;
    if (holder != OVOID_ROBOT_NONE && cell->rigid[holder] == cell->rigid[link]) return 1;
    return keys_are_holding(&cell->allowed_bodies, cell_make_key(slot, link));
}

double ovoid_robot_cell_get_padding(const ovoid_robot_cell *cell, uint32_t link) { return cell->padding[link]; }
