// From a cell to the arrays that its checkers run through.
#include "robot/cell/cell.h"

#include "base/error.h"

#include <stdlib.h>
#include <string.h>

enum { PAIRS_MOST = 1 << 24 };

typedef struct compiler {
    ovoid_robot_cell *cell;
    int has_memory;
} compiler;

static void append(compiler *state, cell_array *to, const void *item, size_t size) {
    if (!state->has_memory || !cell_reserve(&state->cell->allocator, to, to->count + 1, size)) {
        state->has_memory = 0;
        return;
    }
    memcpy((char *)to->items + to->count++ * size, item, size);
}

// ---- frames and items

// A frame fixed to a link, and where it is in the link's.
typedef struct placed_frame {
    uint32_t frame;
    ovoid_pose in_link;
} placed_frame;

// A new frame at a pose in another one; that one itself where the pose is the identity.
static placed_frame add_frame(compiler *state, placed_frame parent, const ovoid_pose *pose) {
    if (pose_is_identity(pose)) return parent;
    uint32_t root = state->cell->robot->root, next = state->cell->frame_count++;
    chain_step s = step_make_fixed(parent.frame == root ? OVOID_ROBOT_NONE : parent.frame, next, pose);
    append(state, &state->cell->own, &s, sizeof s);
    return (placed_frame){next, ovoid_pose_compute_product(&parent.in_link, pose)};
}

static double norm_of(vec3 v) { return vec3_norm(v) * (1 + 8 * ROUNDING); }

// The box of a shape's vertices in the user's frame.
static void find_box(const ovoid_shape *s, vec3 *middle, vec3 *half) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    const double *axes[3] = {shape_x(s), shape_y(s), shape_z(s)};
    for (int k = 0; k < 3; k++)
        for (uint32_t i = 0; i < s->vertex_count; i++) {
            low[k] = min2(low[k], axes[k][i]);
            high[k] = max2(high[k], axes[k][i]);
        }
    *middle = vec3_add((vec3){(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, (low[2] + high[2]) / 2}, s->origin);
    *half = (vec3){(high[0] - low[0]) / 2, (high[1] - low[1]) / 2, (high[2] - low[2]) / 2};
}

static void add_item(compiler *state, const ovoid_shape *shape, const ovoid_solid *solid, placed_frame at,
                     ovoid_robot_side side) {
    // The user's frame and the body frame differ by the shape's origin, without rotation.
    vec3 own = vec3_add(shape->center, shape->origin);
    double local = norm_of(own), reach = shape->reach + shape->lower_radius;
    double lengths = 2 * local + reach + norm_of(shape->origin) + 2 * norm_of(at.in_link.position);
    cell_item item = {.shape = shape,
                      .solid = solid,
                      .frame = at.frame,
                      .center = ovoid_pose_compute_point(&at.in_link, own),
                      .reach = reach + CELL_SLACK * lengths,
                      .far = (local + reach) * (1 + CELL_SLACK),
                      .side = side};
    item.in_link = at.in_link;
    find_box(shape, &item.middle, &item.half);
    item.radius = shape->lower_radius + CELL_SLACK * (lengths + 2 * norm_of(item.middle));
    append(state, &state->cell->items, &item, sizeof item);
}

static void add_attached(compiler *state, uint32_t slot) {
    const cell_body b = cell_bodies(state->cell)[slot];
    placed_frame at = add_frame(state, (placed_frame){b.link, ovoid_pose_make_identity()}, &b.body.pose);
    ovoid_robot_side side = {b.link, OVOID_ROBOT_NONE, cell_make_id(slot, b.generation), 0};
    if (!b.body.compound) {
        add_item(state, b.body.solid ? b.hull : b.body.shape, b.body.solid, at, side);
        return;
    }
    for (size_t i = 0; state->has_memory && i < ovoid_compound_get_part_count(b.body.compound); i++) {
        ovoid_posed_shape part = ovoid_compound_get_part(b.body.compound, i);
        side.part = (uint32_t)i;
        add_item(state, part.shape, NULL, add_frame(state, at, &part.pose), side);
    }
}

// What is inside of each item: an element's is the robot's, an attached body's the cell's.
static void set_insides(compiler *state) {
    ovoid_robot_cell *c = state->cell;
    cell_item *items = c->items.items;
    size_t attached = 0;
    for (size_t i = 0; i < c->items.count; i++) attached += items[i].side.body != 0;
    if (!state->has_memory || !cell_reserve(&c->allocator, &c->insides, attached, sizeof(shape_inside))) {
        state->has_memory = 0;
        return;
    }
    c->insides.count = attached;
    ovoid_shape *point = attached ? shape_create_point(&c->allocator) : NULL;
    if (attached && !point) {
        state->has_memory = 0;
        return;
    }
    shape_inside *next = c->insides.items;
    for (size_t i = 0; i < c->items.count; i++) {
        if (items[i].side.body == 0) {
            items[i].inside = robot_get_inside(c->robot, items[i].side.element);
            continue;
        }
        if (shape_inside_find(items[i].shape, items[i].solid, point, next) != OVOID_OK ||
            !outer_balls_find(items[i].shape, &c->allocator, &next->outer))
            state->has_memory = 0;
        items[i].inside = next++;
    }
    ovoid_shape_destroy(point);
}

static int compare_items(const void *x, const void *y) {
    const ovoid_robot_side *a = &((const cell_item *)x)->side, *b = &((const cell_item *)y)->side;
    if (a->link != b->link) return a->link < b->link ? -1 : 1;
    if (a->body != b->body) return a->body < b->body ? -1 : 1;
    if (a->element != b->element) return a->element < b->element ? -1 : 1;
    return (a->part > b->part) - (a->part < b->part);
}

static void add_items(compiler *state) {
    const ovoid_robot *r = state->cell->robot;
    for (uint32_t i = 0; state->has_memory && i < r->element_count; i++) {
        const ovoid_robot_element *e = &r->elements[i];
        placed_frame at = add_frame(state, (placed_frame){e->link, ovoid_pose_make_identity()}, &e->pose);
        add_item(state, e->shape, e->solid, at, (ovoid_robot_side){e->link, i, 0, 0});
    }
    for (uint32_t i = 0; state->has_memory && i < state->cell->bodies.count; i++)
        if (cell_bodies(state->cell)[i].is_used && cell_bodies(state->cell)[i].link != OVOID_ROBOT_NONE)
            add_attached(state, i);
    if (state->cell->items.count)
        qsort(state->cell->items.items, state->cell->items.count, sizeof(cell_item), compare_items);
    set_insides(state);
}

// The sphere around the box around the items' spheres.
static void set_sphere(const cell_item *items, cell_group *g) {
    vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = g->first; i < g->end; i++) {
        vec3 c = items[i].center;
        double r = items[i].reach;
        low = (vec3){min2(low.x, c.x - r), min2(low.y, c.y - r), min2(low.z, c.z - r)};
        high = (vec3){max2(high.x, c.x + r), max2(high.y, c.y + r), max2(high.z, c.z + r)};
    }
    g->center = vec3_scale(vec3_add(low, high), 0.5);
    for (uint32_t i = g->first; i < g->end; i++)
        g->reach = max2(g->reach, items[i].reach + norm_of(vec3_sub(items[i].center, g->center)));
    g->reach += CELL_SLACK * (2 * norm_of(g->center) + g->reach);
    g->far = (norm_of(g->center) + g->reach) * (1 + CELL_SLACK);
}

// The box around the items' boxes; of one item that is where its link is, that item's.
static void set_box(const cell_item *items, cell_group *g) {
    const cell_item *one = &items[g->first];
    g->is_box_of_item = g->end - g->first == 1 && one->frame == g->link;
    g->middle = one->middle, g->half = one->half, g->radius = one->radius;
    if (g->is_box_of_item) return;
    vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t i = g->first; i < g->end; i++) {
        mat3 r = quat_to_mat3(items[i].in_link.rotation);
        vec3 c = vec3_add(items[i].in_link.position, mat3_mul_vec3(r, items[i].middle)), h = items[i].half;
        vec3 out = {vec3_dot(vec3_abs(r.r0), h), vec3_dot(vec3_abs(r.r1), h), vec3_dot(vec3_abs(r.r2), h)};
        out = vec3_add(out, vec3_make(items[i].radius, items[i].radius, items[i].radius));
        low = (vec3){min2(low.x, c.x - out.x), min2(low.y, c.y - out.y), min2(low.z, c.z - out.z)};
        high = (vec3){max2(high.x, c.x + out.x), max2(high.y, c.y + out.y), max2(high.z, c.z + out.z)};
    }
    g->middle = vec3_scale(vec3_add(low, high), 0.5);
    g->half = vec3_scale(vec3_sub(high, low), 0.5);
    g->radius = CELL_SLACK * (2 * norm_of(g->middle) + norm_of(g->half));
}

static void add_groups(compiler *state) {
    const cell_item *items = cell_items(state->cell);
    for (uint32_t i = 0; state->has_memory && i < state->cell->items.count;) {
        cell_group g = {.link = items[i].side.link, .first = i};
        while (i < state->cell->items.count && items[i].side.link == g.link) i++;
        g.end = i;
        set_sphere(items, &g);
        set_box(items, &g);
        append(state, &state->cell->groups, &g, sizeof g);
    }
}

// The steps of the links with items, and of those that they hang on.
static void add_steps(compiler *state) {
    const ovoid_robot *r = state->cell->robot;
    unsigned char *is_needed = allocator_allocate(&state->cell->allocator, r->link_count, 1);
    if (!is_needed) {
        state->has_memory = 0;
        return;
    }
    memset(is_needed, 0, r->link_count);
    for (size_t i = 0; i < state->cell->groups.count; i++) is_needed[cell_groups(state->cell)[i].link] = 1;
    for (uint32_t i = r->joint_count; i-- > 0;)
        is_needed[r->joints[r->order[i]].parent] |= is_needed[r->joints[r->order[i]].child];
    for (uint32_t i = 0; i < r->joint_count; i++) {
        if (!is_needed[r->steps[i].child]) continue;
        append(state, &state->cell->steps, &r->steps[i], sizeof *r->steps);
        append(state, &state->cell->step_joints, &r->order[i], sizeof *r->order);
    }
    allocator_release(&state->cell->allocator, is_needed);
}

// ---- parts of obstacles

static void add_parts_of(compiler *state, uint32_t slot) {
    const cell_body *b = &cell_bodies(state->cell)[slot];
    ovoid_robot_side side = {OVOID_ROBOT_NONE, OVOID_ROBOT_NONE, cell_make_id(slot, b->generation), 0};
    size_t count = b->body.compound ? ovoid_compound_get_part_count(b->body.compound) : 1;
    for (size_t i = 0; i < count; i++) {
        ovoid_posed_shape posed = {b->body.solid ? b->hull : b->body.shape, b->body.pose};
        if (b->body.compound) posed = ovoid_compound_get_part(b->body.compound, i);
        side.part = (uint32_t)i;
        cell_part part = {.shape = posed.shape,
                          .solid = b->body.solid,
                          .pose = posed.pose,
                          .gap = b->gap,
                          .slabs = slabs_find_of_shape(posed.shape),
                          .size = 3 * (posed.shape->extent + vec3_max_abs(posed.shape->origin)),
                          .side = side};
        append(state, &state->cell->parts, &part, sizeof part);
    }
}

static void add_parts(compiler *state) {
    for (uint32_t slot = 0; state->has_memory && slot < state->cell->bodies.count; slot++) {
        const cell_body *b = &cell_bodies(state->cell)[slot];
        if (b->is_used && b->link == OVOID_ROBOT_NONE) add_parts_of(state, slot);
    }
}

static oriented_box place_box(const ovoid_shape *shape, const ovoid_pose *pose) {
    vec3 middle;
    oriented_box b = {.rotation = quat_to_mat3(pose->rotation)};
    find_box(shape, &middle, &b.half);
    b.center = vec3_add(pose->position, mat3_mul_vec3(b.rotation, middle));
    double size = norm_of(pose->position) + 2 * norm_of(middle) + norm_of(b.half) + norm_of(shape->origin);
    b.radius = shape->lower_radius + CELL_SLACK * size;
    return b;
}

static void put_box(box8 *group, uint32_t lane, const oriented_box *b) {
    mat3 r = b->rotation;
    const double all[] = {b->center.x, b->center.y, b->center.z, r.r0.x, r.r0.y,    r.r0.z,    r.r1.x,    r.r1.y,
                          r.r1.z,      r.r2.x,      r.r2.y,      r.r2.z, b->half.x, b->half.y, b->half.z, b->radius};
    for (int k = 0; k < BOX8_BALL; k++) group->column[k][lane] = all[k];
    double radius = b->radius + CELL_SLACK * vec3_sum_abs(b->center);
    group->column[BOX8_RADIUS][lane] = radius;
    group->column[BOX8_BALL][lane] = (norm_of(b->half) + radius) * (1 + CELL_SLACK);
}

static void place_parts(ovoid_robot_cell *c, uint32_t first) {
    cell_part *parts = c->parts.items;
    box8 *boxes = c->boxes.items;
    for (uint32_t i = first; i < c->parts.count; i++) {
        const cell_body *b = &cell_bodies(c)[parts[i].side.body >> 32];
        parts[i].pose = b->body.pose;
        if (b->body.compound) {
            ovoid_pose inner = ovoid_compound_get_part(b->body.compound, parts[i].side.part).pose;
            parts[i].pose = ovoid_pose_compute_product(&b->body.pose, &inner);
        }
        parts[i].box = place_box(parts[i].shape, &parts[i].pose);
        inner_region own = b->body.solid ? b->inside : inner_region_find(parts[i].shape);
        parts[i].inside = inner_region_place(&own, &parts[i].box.rotation, parts[i].pose.position);
        parts[i].inside_size = vec3_sum_abs(parts[i].pose.position) + vec3_sum_abs(own.center) + vec3_sum_abs(own.half);
        put_box(&boxes[i / ROBOT8], i % ROBOT8, &parts[i].box);
    }
}

void cell_place_parts(ovoid_robot_cell *c) { place_parts(c, 0); }

// The boxes of the parts from `first` on, to which those before have theirs.
static ovoid_code place_new_parts(ovoid_robot_cell *c, uint32_t first) {
    size_t groups = (c->parts.count + ROBOT8 - 1) / ROBOT8;
    if (!cell_reserve(&c->allocator, &c->boxes, groups, sizeof(box8))) return OVOID_ERROR_MEMORY;
    box8 *boxes = c->boxes.items;
    // The places beyond the last part are not looked at.
    for (size_t i = c->boxes.count; i < groups; i++) boxes[i] = (box8){0};
    c->boxes.count = groups;
    place_parts(c, first);
    return OVOID_OK;
}

// ---- pairs of items

static int is_disabled(const ovoid_robot *r, uint32_t a, uint32_t b) {
    uint32_t low = 0, high = r->disabled_count;
    while (low < high) {
        uint32_t middle = low + (high - low) / 2;
        const ovoid_robot_pair *p = &r->disabled[middle];
        if (p->a == a && p->b == b) return 1;
        if (p->a < a || (p->a == a && p->b < b))
            low = middle + 1;
        else
            high = middle;
    }
    return 0;
}

int cell_are_links_queried(const ovoid_robot_cell *c, uint32_t a, uint32_t b) {
    uint32_t low = a < b ? a : b, high = a < b ? b : a;
    if (c->rigid[a] == c->rigid[b]) return 0;
    if (!c->ignores_disabled && is_disabled(c->robot, low, high)) return 0;
    return !keys_are_holding(&c->allowed_links, cell_make_key(low, high));
}

static int is_attached_allowed(const ovoid_robot_cell *c, const ovoid_robot_side *attached, uint32_t link) {
    return attached->body &&
           keys_are_holding(&c->allowed_bodies, cell_make_key((uint32_t)(attached->body >> 32), link));
}

// Attached bodies are part of their link, but for what they may touch: a pair that the description disables for the
// links alone is queried for them.
static int are_queried(const ovoid_robot_cell *c, const ovoid_robot_side *a, const ovoid_robot_side *b) {
    if (c->rigid[a->link] == c->rigid[b->link]) return 0;
    if (!a->body && !b->body) return cell_are_links_queried(c, a->link, b->link);
    return !is_attached_allowed(c, a, b->link) && !is_attached_allowed(c, b, a->link);
}

// The pairs of items of two groups; LIMIT where there are too many.
static ovoid_code find_group_pairs(compiler *state, uint32_t a, uint32_t b) {
    ovoid_robot_cell *c = state->cell;
    const cell_group *g = cell_groups(c), *h = g + b;
    g += a;
    if (c->rigid[g->link] == c->rigid[h->link]) return OVOID_OK;
    group_pair both = {a, b, (uint32_t)c->pairs.count, 0};
    for (uint32_t i = g->first; i < g->end; i++)
        for (uint32_t k = h->first; k < h->end; k++) {
            item_pair pair = {i, k};
            if (!are_queried(c, &cell_items(c)[i].side, &cell_items(c)[k].side)) continue;
            if (c->pairs.count >= PAIRS_MOST) return OVOID_ERROR_LIMIT;
            append(state, &c->pairs, &pair, sizeof pair);
        }
    both.end = (uint32_t)c->pairs.count;
    if (both.end > both.first) append(state, &c->group_pairs, &both, sizeof both);
    return OVOID_OK;
}

static ovoid_code find_pairs(compiler *state) {
    ovoid_code code = OVOID_OK;
    for (uint32_t a = 0; a < state->cell->groups.count; a++)
        for (uint32_t b = a + 1; code == OVOID_OK && state->has_memory && b < state->cell->groups.count; b++)
            code = find_group_pairs(state, a, b);
    return code;
}

int cell_has_pairs(const ovoid_robot_cell *c, const ovoid_robot_query_options *options) {
    if (!options->without_self && c->pairs.count) return 1;
    // The first of them is one, but where obstacles are allowed.
    for (size_t i = 0; !options->without_obstacles && i < c->groups.count; i++)
        for (size_t k = 0; k < c->parts.count; k++)
            if (!cell_is_allowed(c, &cell_items(c)[cell_groups(c)[i].first].side, &cell_parts(c)[k].side)) return 1;
    return 0;
}

ovoid_code cell_compile(ovoid_robot_cell *c, ovoid_error *error) {
    c->version++;
    c->is_whole = 0;
    c->items.count = c->parts.count = c->boxes.count = c->pairs.count = c->groups.count = c->group_pairs.count = 0;
    c->steps.count = c->step_joints.count = c->own.count = c->insides.count = 0;
    c->frame_count = c->robot->link_count;
    compiler state = {c, 1};
    add_items(&state);
    add_groups(&state);
    add_steps(&state);
    add_parts(&state);
    ovoid_code code = state.has_memory ? place_new_parts(c, 0) : OVOID_ERROR_MEMORY;
    if (code == OVOID_OK) code = find_pairs(&state);
    if (code == OVOID_ERROR_LIMIT)
        return error_set(error, code, -1, "more than %d pairs of elements are to be queried", (int)PAIRS_MOST);
    if (!state.has_memory || code != OVOID_OK)
        return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for the bodies of the cell");
    c->is_whole = 1;
    return OVOID_OK;
}

ovoid_code cell_append_obstacle(ovoid_robot_cell *c, uint32_t slot, ovoid_error *error) {
    if (!c->is_whole || slot + 1 != c->bodies.count) return cell_compile(c, error);
    c->version++;
    c->is_whole = 0;
    compiler state = {c, 1};
    uint32_t first = (uint32_t)c->parts.count;
    add_parts_of(&state, slot);
    if (!state.has_memory || place_new_parts(c, first) != OVOID_OK)
        return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for the bodies of the cell");
    c->is_whole = 1;
    return OVOID_OK;
}
