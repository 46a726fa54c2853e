// How far bodies come along a segment. All bounds are rounded upward by factors that cover their few operations.
#include "robot/path/motion.h"
#include "base/error.h"

#include <string.h>

#define UP (1 + 0x1p-40) // covers the rounding of sums and products of a few numbers that are not negative

// ---- memory

// The parts of the block, one after another.
typedef struct block_part {
    void **to;
    size_t count, size;
} block_part;

static int allocate_block(const path_work *w, void **block, const block_part *parts, size_t count) {
    size_t total = 0, at = 0;
    for (size_t i = 0; i < count; i++) total = allocator_end_array(total, parts[i].count, parts[i].size);
    *block = allocator_allocate(&w->allocator, total, 1);
    if (!*block) return 0;
    for (size_t i = 0; i < count; i++) {
        *parts[i].to = (char *)*block + at;
        at = allocator_end_array(at, parts[i].count, parts[i].size);
    }
    return 1;
}

void path_work_find_makers(const path_work *w, uint32_t *maker) {
    for (uint32_t i = 0; i < w->cell->frame_count; i++) maker[i] = OVOID_ROBOT_NONE;
    for (uint32_t i = 0; i < w->step_count; i++) maker[w->steps[i].child] = i;
}

// The moving steps from a frame up to the world, written where links is not NULL; how many.
static uint32_t climb(const path_work *w, const uint32_t *maker, uint32_t frame, item_link *links) {
    uint32_t count = 0;
    for (uint32_t s = maker[frame]; s != OVOID_ROBOT_NONE;) {
        const chain_step *step = &w->steps[s];
        if (step->kind != STEP_FIXED) {
            if (links) links[count].step = s;
            count++;
        }
        s = step->parent == OVOID_ROBOT_NONE ? OVOID_ROBOT_NONE : maker[step->parent];
    }
    return count;
}

// Steps that two items have in common are the last ones of both.
static pair_chain find_pair_chain(const path_work *w, item_pair p) {
    uint32_t a = w->first[p.a + 1], b = w->first[p.b + 1];
    while (a > w->first[p.a] && b > w->first[p.b] && w->links[a - 1].step == w->links[b - 1].step) a--, b--;
    int has_common = a < w->first[p.a + 1];
    return (pair_chain){a - w->first[p.a], b - w->first[p.b],
                        has_common ? w->steps[w->links[a].step].child : OVOID_ROBOT_NONE};
}

static void set_steps(path_work *w) {
    const ovoid_robot_cell *c = w->cell;
    const uint32_t *joints = c->step_joints.items;
    if (c->steps.count) memcpy(w->steps, c->steps.items, c->steps.count * sizeof *w->steps);
    if (c->own.count) memcpy(w->steps + c->steps.count, c->own.items, c->own.count * sizeof *w->steps);
    for (uint32_t i = 0; i < w->step_count; i++) {
        uint32_t joint = w->joints[i] = i < c->steps.count ? joints[i] : OVOID_ROBOT_NONE;
        w->axes[i] = joint == OVOID_ROBOT_NONE ? (vec3){0, 0, 1} : vec3_unit(c->robot->joints[joint].axis);
    }
}

static int allocate_steps(path_work *w) {
    size_t count = w->step_count;
    const block_part parts[] = {{(void **)&w->steps, count, sizeof *w->steps},
                                {(void **)&w->joints, count, sizeof *w->joints},
                                {(void **)&w->axes, count, sizeof *w->axes},
                                {(void **)&w->speeds, count, sizeof *w->speeds}};
    return allocate_block(w, &w->step_block, parts, sizeof parts / sizeof *parts);
}

static int allocate_rest(path_work *w, const uint32_t *maker) {
    const ovoid_robot_cell *c = w->cell;
    size_t items = c->items.count, links = 0;
    for (size_t i = 0; i < items; i++) links += climb(w, maker, cell_items(c)[i].frame, NULL);
    const block_part parts[] = {{(void **)&w->first, items + 1, sizeof *w->first},
                                {(void **)&w->links, links, sizeof *w->links},
                                {(void **)&w->pairs, c->pairs.count, sizeof *w->pairs},
                                {(void **)&w->values, w->padded, sizeof *w->values},
                                {(void **)&w->other_values, w->padded, sizeof *w->other_values},
                                {(void **)&w->cosines, w->padded, sizeof *w->cosines},
                                {(void **)&w->sines, w->padded, sizeof *w->sines},
                                {(void **)&w->state, c->robot->variable_count, sizeof *w->state},
                                {(void **)&w->frame_errors, c->frame_count, sizeof *w->frame_errors},
                                {(void **)&w->errors, items, sizeof *w->errors},
                                {(void **)&w->places, items, sizeof *w->places}};
    return allocate_block(w, &w->block, parts, sizeof parts / sizeof *parts);
}

static int make_work(path_work *w, uint32_t *maker) {
    const ovoid_robot_cell *c = w->cell;
    if (!allocate_steps(w)) return 0;
    set_steps(w);
    path_work_find_makers(w, maker);
    if (!allocate_rest(w, maker)) return 0;
    // The padding is turned like the rest.
    memset(w->values, 0, w->padded * sizeof *w->values);
    w->first[0] = 0;
    for (size_t i = 0; i < c->items.count; i++)
        w->first[i + 1] = w->first[i] + climb(w, maker, cell_items(c)[i].frame, w->links + w->first[i]);
    for (uint32_t i = 0; i < c->pairs.count; i++) w->pairs[i] = find_pair_chain(w, cell_pairs(c)[i]);
    return 1;
}

ovoid_code path_work_create(path_work *w, const ovoid_robot_cell *c, const ovoid_allocator *allocator,
                            ovoid_error *error) {
    *w = (path_work){.cell = c,
                     .allocator = *allocator,
                     .level = -1,
                     .padded = (c->robot->value_count + ROBOT8 - 1) / ROBOT8 * ROBOT8,
                     .step_count = (uint32_t)(c->steps.count + c->own.count)};
    uint32_t *maker = allocator_allocate(allocator, c->frame_count, sizeof *maker);
    int has_memory = maker && make_work(w, maker);
    allocator_release(allocator, maker);
    if (has_memory) return OVOID_OK;
    path_work_destroy(w);
    return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a path");
}

void path_work_destroy(path_work *w) {
    allocator_release(&w->allocator, w->step_block);
    allocator_release(&w->allocator, w->block);
}

// ---- a segment

void path_set_level(path_work *w, double level) {
    const ovoid_robot_cell *c = w->cell;
    step_list list = {c->robot, w->steps, w->joints, w->step_count};
    w->frame_errors[c->robot->root] = (frame_error){0, 0, 0};
    steps_compute_errors(&list, level, w->frame_errors);
    for (size_t i = 0; i < c->items.count; i++) {
        const cell_item *item = &cell_items(c)[i];
        w->errors[i] = frame_error_at(&w->frame_errors[item->frame], item->far);
    }
    w->level = level;
}

// How fast value k of a joint goes, and by what the state that is looked at may be off the exact one there.
static void find_speed(const path_work *w, const joint_lead *lead, double most, uint32_t k, double *speed,
                       double *slack) {
    double a = w->values[k], b = w->other_values[k], scale = lead->spread * most + lead->offset_spread;
    *speed = (fabs(b - a) + 8 * ROUNDING * (fabs(a) + fabs(b)) + 2 * lead->error * scale) * UP;
    *slack = 16 * ROUNDING * lead->spread * most;
}

static void set_speed(path_work *w, uint32_t step, const double *q0, const double *q1) {
    const ovoid_robot *r = w->cell->robot;
    uint32_t joint = w->joints[step];
    const chain_step *s = &w->steps[step];
    step_speed v = {0, 0, 0, 0};
    uint32_t lengths = step_count_lengths(s->kind);
    // The quaternion of a floating joint stays: path_set_segment has seen to it.
    uint32_t count = lengths + (s->kind == STEP_TURN || s->kind == STEP_PLANE);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t variable = r->joint_variable[joint] + (lengths > 1 ? i : 0);
        double speed, slack;
        // A variable that stays has the same bits everywhere.
        if (q0[variable] == q1[variable]) continue;
        find_speed(w, &r->leads[joint], max2(fabs(q0[variable]), fabs(q1[variable])), s->value + i, &speed, &slack);
        if (i < lengths)
            v.slide += speed, v.slide_slack += slack;
        else
            v.turn = speed, v.turn_slack = slack;
    }
    w->speeds[step] = v;
}

static ovoid_code validate_floating(const path_work *w, const double *q0, const double *q1, ovoid_error *error) {
    const ovoid_robot *r = w->cell->robot;
    for (uint32_t i = 0; i < r->variable_count; i++) {
        const ovoid_robot_joint *j = &r->joints[r->variables[i].joint];
        if (j->type == OVOID_JOINT_FLOATING && r->variables[i].component >= 3 && q0[i] != q1[i])
            return error_set(
                error, OVOID_ERROR_ARGUMENT, (int64_t)i,
                "joint \"%.80s\" is floating and turns along the path: give it the same quaternion in both "
                "states, or divide the path",
                j->name);
    }
    return OVOID_OK;
}

ovoid_code path_set_segment(path_work *w, const double *q0, const double *q1, double limit_slack, ovoid_error *error) {
    const ovoid_robot *r = w->cell->robot;
    ovoid_code code = OVOID_OK;
    const double *ends[2] = {q0, q1};
    double magnitude[2] = {0, 0}, *values[2] = {w->values, w->other_values};
    for (int i = 0; code == OVOID_OK && i < 2; i++) {
        if (limit_slack < INFINITY) code = ovoid_robot_validate_limits(r, ends[i], limit_slack, error);
        if (code == OVOID_OK) code = robot_compute_values(r, ends[i], values[i], 1, &magnitude[i], error);
    }
    if (code == OVOID_OK) code = validate_floating(w, q0, q1, error);
    if (code != OVOID_OK) return code;
    for (uint32_t i = 0; i < w->step_count; i++) set_speed(w, i, q0, q1);
    double level = robot_compute_level(r, max2(magnitude[0], magnitude[1]));
    if (level != w->level) path_set_level(w, level);
    return OVOID_OK;
}

int path_is_still(const path_work *w) {
    for (uint32_t i = 0; i < w->step_count; i++)
        if (w->speeds[i].turn > 0 || w->speeds[i].slide > 0) return 0;
    return 1;
}

void path_compute_state(path_work *w, const double *q0, const double *q1, double t, const path_state *at) {
    path_compute_frames(w, q0, q1, t, at);
    for (uint32_t i = 0; i < w->cell->items.count; i++) path_place_item(w, at, i);
}

void path_place_item(const path_work *w, const path_state *at, uint32_t which) {
    const cell_item *item = &cell_items(w->cell)[which];
    at->boxes[which] = item_place_box(item, &at->frames[item->frame], w->errors[which]);
}

void path_compute_frames(path_work *w, const double *q0, const double *q1, double t, const path_state *at) {
    link_frame *frames = at->frames;
    const ovoid_robot_cell *c = w->cell;
    const double *q = t == 0 ? q0 : t == 1 ? q1 : w->state;
    if (q == w->state)
        for (uint32_t i = 0; i < c->robot->variable_count; i++) w->state[i] = q0[i] + t * (q1[i] - q0[i]);
    double magnitude;
    // Between two states that are taken, none is refused.
    (void)robot_compute_values(c->robot, q, w->values, 1, &magnitude, NULL);
    frames[c->robot->root] = frame_make_world();
    robot8_get_kernels()->half_turns(w->values, w->padded, w->cosines, w->sines);
    steps_compute_frames(w->steps, w->step_count, c->robot->root, w->values, w->cosines, w->sines, frames);
    for (uint32_t i = 0; i < w->step_count; i++)
        if (w->speeds[i].turn > 0) at->axes[i] = mat3_mul_vec3(frames[w->steps[i].child].matrix, w->axes[i]);
}

// ---- an interval

// From the item up. With T and S the motions of a step up to s and up to the middle, |T1 T2 x - S1 S2 x| <= |T2 x - S2
// x|
// + |T1 y - S1 y|, y = S2 x: to the first order each step moves the item from where it is in the middle. A point's
// distance from a joint's axis at any s is that in the middle and what the steps before it move.
//
// The second derivative of a point by the values of joints i above j is a_i x (a_j x (x - o_j)), no longer than the
// distance from axis j; for a j that slides, a_i x a_j; for an i that slides, zero.
static void set_motion(path_work *w, const path_state *middle, uint32_t item, double half) {
    const sphere_place *place = &w->places[item];
    vec3 center = {place->center[0], place->center[1], place->center[2]};
    double moved = 0, curved = 0, rounded = 0,
           below = 0; // below: sum of speed times radius of the steps so far, for s from 0 to 1
    for (uint32_t i = w->first[item]; i < w->first[item + 1]; i++) {
        item_link *link = &w->links[i];
        const step_speed *v = &w->speeds[link->step];
        if (v->turn > 0) {
            uint32_t child = w->steps[link->step].child;
            vec3 from = middle->frames[child].position, d = vec3_sub(center, from);
            // Norms that only errors grow with are bounded by sums.
            double far = vec3_sum_abs(d), error = frame_error_at(&w->frame_errors[child], far);
            double size = far + (vec3_sum_abs(center) + vec3_sum_abs(from));
            double distance = vec3_norm(vec3_cross(middle->axes[link->step], d));
            double in_middle = ((distance + CELL_SLACK * size) + 2 * error + place->reach) * UP;
            double radius = (in_middle + moved) * UP;
            moved = (moved + (half * v->turn + v->turn_slack) * in_middle) * UP;
            curved = (curved + v->turn * (v->turn * radius + 2 * below)) * UP;
            rounded = (rounded + v->turn_slack * radius) * UP;
            below = (below + v->turn * radius) * UP;
        }
        moved = (moved + (half * v->slide + v->slide_slack)) * UP;
        below = (below + v->slide) * UP;
        rounded = (rounded + v->slide_slack) * UP;
        link->moved = moved;
        link->curved = curved;
        link->rounded = rounded;
    }
}

void path_set_item(path_work *w, const path_state *middle, uint32_t which, double half) {
    const cell_item *item = &cell_items(w->cell)[which];
    const link_frame *f = &middle->frames[item->side.link];
    vec3 center = vec3_add(f->position, mat3_mul_vec3(f->matrix, item->center));
    w->places[which] = (sphere_place){{center.x, center.y, center.z}, (item->reach + w->errors[which]) * UP};
    set_motion(w, middle, which, half);
}

void path_set_interval(path_work *w, const path_state *middle, double half) {
    for (uint32_t i = 0; i < w->cell->items.count; i++) path_set_item(w, middle, i, half);
}

static const item_link *get_link(const path_work *w, uint32_t item, uint32_t count) {
    static const item_link still = {0, 0, 0, 0};
    return count ? &w->links[w->first[item] + count - 1] : &still;
}

static uint32_t count_links(const path_work *w, uint32_t item) { return w->first[item + 1] - w->first[item]; }

// Against the world, by all of its links.
static const item_link *get_all_links(const path_work *w, uint32_t item) {
    return get_link(w, item, count_links(w, item));
}

path_motion path_get_motion(const path_work *w, const pair_parts *of) {
    if (of->part != OVOID_ROBOT_NONE) {
        const item_link *link = get_all_links(w, of->item);
        return (path_motion){link->moved, link->curved, link->rounded};
    }
    const pair_chain *k = &w->pairs[of->pair];
    const item_link *a = get_link(w, of->item, k->count_a), *b = get_link(w, of->other, k->count_b);
    return (path_motion){(a->moved + b->moved) * UP, (a->curved + b->curved) * UP, (a->rounded + b->rounded) * UP};
}

// ---- pairs

static ovoid_pose get_pose(const link_frame *f) { return (ovoid_pose){f->position, f->rotation}; }

path_pair path_make_pair(const path_work *w, uint32_t number, const link_frame *frames) {
    pair_parts of = pair_take_apart(w->cell, number);
    const cell_item *a = &cell_items(w->cell)[of.item];
    path_pair p = {.a = &a->side, .error = w->errors[of.item], .motion = path_get_motion(w, &of)};
    ovoid_pose pose = get_pose(&frames[a->frame]);
    if (of.part != OVOID_ROBOT_NONE) {
        const cell_part *b = &cell_parts(w->cell)[of.part];
        p.b = &b->side;
        p.pair = (ovoid_pair){a->shape, b->shape, pose, b->pose};
        p.solids = cell_get_part_solids(a, b);
        p.padding = w->cell->padding[a->side.link];
        p.frame = OVOID_ROBOT_NONE;
    } else {
        const cell_item *b = &cell_items(w->cell)[of.other];
        p.b = &b->side;
        p.pair = (ovoid_pair){a->shape, b->shape, pose, get_pose(&frames[b->frame])};
        p.solids = cell_get_item_solids(a, b);
        p.error += w->errors[of.other];
        p.apart = a->far + b->far;
        p.frame = w->pairs[of.pair].frame;
    }
    return p;
}

vec3 path_turn_back(const path_pair *p, const link_frame *frames, vec3 world) {
    return p->frame == OVOID_ROBOT_NONE ? world : mat3_mul_transposed_vec3(frames[p->frame].matrix, world);
}

double path_measure(const path_work *w, const path_pair *p, const link_frame *frames, vec3 normal) {
    vec3 world = p->frame == OVOID_ROBOT_NONE ? normal : mat3_mul_vec3(frames[p->frame].matrix, normal);
    double gap = ovoid_pair_compute_gap(&p->pair, world), error = p->error + p->padding;
    if (!(gap > -INFINITY)) return -INFINITY;
    // The turned normal is off by the frame's rotation and the rounding of the product: the gap by that times what the
    // bodies are apart, at most.
    if (p->frame != OVOID_ROBOT_NONE) {
        double apart = vec3_norm(vec3_sub(p->pair.pose_b.position, p->pair.pose_a.position)) + p->apart;
        error += (2 * w->frame_errors[p->frame].quaternion + 64 * ROUNDING) * apart * UP;
    }
    return gap - error - 0x1p-50 * (fabs(gap) + error);
}

ovoid_answer path_ask_exactly(const path_pair *p, const checker_pair *outward) {
    ovoid_answer answer = ovoid_depth(&p->pair, NULL, NULL, NULL);
    if (!sides_have_solid(&p->solids)) return answer;
    return solid_pair_distance(&p->pair, &p->solids, NULL, &answer, pair_get_clear(outward));
}

path_place path_find_place(const ovoid_robot_cell *cell, const ovoid_robot_path *path, double s) {
    size_t count = cell->robot->variable_count, last = path->count > 1 ? path->count - 2 : 0, segment = (size_t)s;
    if (segment > 0 && (double)segment == s) segment--;
    segment = segment < last ? segment : last;
    const double *q0 = path->states + segment * count;
    return (path_place){segment, q0, segment + 1 < path->count ? q0 + count : q0, s - (double)segment};
}

ovoid_robot_answer path_ask_hit(path_work *w, const path_place *place, uint32_t number, const path_state *memory) {
    pair_parts of = pair_take_apart(w->cell, number);
    path_compute_frames(w, place->q0, place->q1, place->t, memory);
    path_set_item(w, memory, of.item, 0);
    if (of.part == OVOID_ROBOT_NONE) path_set_item(w, memory, of.other, 0);
    path_pair p = path_make_pair(w, number, memory->frames);
    const checker_pair outward = {.pair = p.pair, .error = p.error + p.motion.rounded, .padding = p.padding};
    ovoid_answer answer = path_ask_exactly(&p, &outward);
    return (ovoid_robot_answer){.status = OVOID_ROBOT_HIT,
                                .a = *p.a,
                                .b = *p.b,
                                .lower = lower_outward(&outward, answer.lower),
                                .upper = upper_outward(&outward, answer.upper)};
}

static int is_side(const ovoid_robot_side *a, const ovoid_robot_side *b) {
    return a->link == b->link && a->element == b->element && a->body == b->body && a->part == b->part;
}

static uint32_t find_item(const ovoid_robot_cell *cell, const ovoid_robot_side *side) {
    for (uint32_t i = 0; i < cell->items.count; i++)
        if (is_side(&cell_items(cell)[i].side, side)) return i;
    return OVOID_ROBOT_NONE;
}

static uint32_t find_part(const ovoid_robot_cell *cell, const ovoid_robot_side *side) {
    for (uint32_t i = 0; i < cell->parts.count; i++)
        if (is_side(&cell_parts(cell)[i].side, side)) return i;
    return OVOID_ROBOT_NONE;
}

uint32_t path_find_number(const ovoid_robot_cell *cell, const ovoid_robot_side *a, const ovoid_robot_side *b) {
    uint32_t item = find_item(cell, a), part = find_part(cell, b), parts = (uint32_t)cell->parts.count;
    if (item == OVOID_ROBOT_NONE) return OVOID_ROBOT_NONE;
    if (part != OVOID_ROBOT_NONE) return item * parts + part;
    uint32_t other = find_item(cell, b);
    for (uint32_t i = 0; i < cell->pairs.count; i++)
        if (cell_pairs(cell)[i].a == item && cell_pairs(cell)[i].b == other)
            return (uint32_t)cell->items.count * parts + i;
    return OVOID_ROBOT_NONE;
}

int path_is_solid_far(const path_pair *p, double margin) {
    static const ovoid_answer none = {.lower = -INFINITY};
    double far = add_up(add_up(margin, p->padding, p->error), p->motion.moved, 0);
    return sides_have_solid(&p->solids) && solid_pair_within(&p->pair, &p->solids, far, &none, far).lower > far;
}

// ---- spheres

unsigned path_find_far_parts(const path_work *w, uint32_t item, uint32_t group, double margin) {
    const ovoid_robot_cell *c = w->cell;
    double reach =
        (w->places[item].reach + margin + c->padding[cell_items(c)[item].side.link] + get_all_links(w, item)->moved) *
        UP;
    unsigned near = robot8_get_kernels()->near_boxes(&cell_boxes(c)[group], w->places[item].center, reach);
    return ~near & 0xff;
}

int path_is_far_pair(const path_work *w, uint32_t pair, double margin) {
    item_pair p = cell_pairs(w->cell)[pair];
    const pair_parts of = {p.a, p.b, OVOID_ROBOT_NONE, pair};
    const double *a = w->places[p.a].center, *b = w->places[p.b].center;
    double size = ((fabs(a[0]) + fabs(a[1])) + fabs(a[2])) + ((fabs(b[0]) + fabs(b[1])) + fabs(b[2]));
    double moved = (margin + path_get_motion(w, &of).moved) * UP;
    return spheres_are_far(&w->places[p.a], &w->places[p.b], moved + CELL_SLACK * size);
}

double path_get_center_distance(const path_work *w, const pair_parts *of) {
    const double *a = w->places[of->item].center, *b = w->places[of->other].center;
    // A cell without obstacles has no parts.
    vec3 other = {b[0], b[1], b[2]};
    if (of->part != OVOID_ROBOT_NONE) other = cell_parts(w->cell)[of->part].box.center;
    return vec3_norm(vec3_sub(other, (vec3){a[0], a[1], a[2]}));
}

// The boxes of a pair at a state.
static const oriented_box *get_box(const path_state *at, uint32_t item) { return &at->boxes[item]; }
static const oriented_box *get_other_box(const path_work *w, const pair_parts *of, const path_state *at) {
    return of->part != OVOID_ROBOT_NONE ? &cell_parts(w->cell)[of->part].box : &at->boxes[of->other];
}

// What a pair's boxes are measured with.
typedef struct box_pair {
    pair_parts of;
    path_motion motion;
    double padding, apart;
    uint32_t frame;
} box_pair;

static box_pair make_box_pair(const path_work *w, uint32_t number) {
    pair_parts of = pair_take_apart(w->cell, number);
    const cell_item *a = &cell_items(w->cell)[of.item];
    path_motion motion = path_get_motion(w, &of);
    if (of.part != OVOID_ROBOT_NONE) return (box_pair){of, motion, w->cell->padding[a->side.link], 0, OVOID_ROBOT_NONE};
    return (box_pair){of, motion, 0, a->far + cell_items(w->cell)[of.other].far, w->pairs[of.pair].frame};
}

// The gap of the boxes at a state, as path_measure has that of the bodies.
static double measure_boxes(const path_work *w, const box_pair *p, const path_state *at, vec3 normal) {
    const oriented_box *a = get_box(at, p->of.item), *b = get_other_box(w, &p->of, at);
    vec3 world = p->frame == OVOID_ROBOT_NONE ? normal : mat3_mul_vec3(at->frames[p->frame].matrix, normal);
    double size = (vec3_sum_abs(a->center) + vec3_sum_abs(b->center)) + (vec3_sum_abs(a->half) + vec3_sum_abs(b->half));
    double error = p->padding + 4 * BOX_SLACK * size;
    if (p->frame != OVOID_ROBOT_NONE) error += 2 * w->frame_errors[p->frame].quaternion * (size + p->apart) * UP;
    return oriented_boxes_measure_gap(a, b, world) - error - p->motion.rounded;
}

int path_is_far_by_boxes(const path_work *w, uint32_t number, const path_state *at, double margin) {
    box_pair p = make_box_pair(w, number);
    return oriented_boxes_are_far(get_box(at, p.of.item), get_other_box(w, &p.of, at),
                                  add_up(margin, p.padding, p.motion.moved));
}

path_boxes path_test_boxes(const path_work *w, uint32_t number, const path_span *span, double margin, vec3 *normal) {
    box_pair p = make_box_pair(w, number);
    vec3 world;
    if (oriented_boxes_part(get_box(span->middle, p.of.item), get_other_box(w, &p.of, span->middle),
                            add_up(margin, p.padding, p.motion.moved), &world))
        return PATH_BOXES_FAR;
    const mat3 *rotation = p.frame == OVOID_ROBOT_NONE ? NULL : &span->middle->frames[p.frame].matrix;
    *normal = rotation ? mat3_mul_transposed_vec3(*rotation, world) : world;
    double begin = measure_boxes(w, &p, span->at_begin, *normal);
    if (!(begin > margin)) return PATH_BOXES_OPEN;
    double end = measure_boxes(w, &p, span->at_end, *normal);
    return path_is_free_between(begin, end, margin, p.motion.curved, span->end - span->begin) ? PATH_BOXES_PART
                                                                                              : PATH_BOXES_OPEN;
}

size_t path_get_state_size(const ovoid_robot_cell *c) {
    return c->frame_count * sizeof(link_frame) + (c->steps.count + c->own.count) * sizeof(vec3) +
           c->items.count * sizeof(oriented_box);
}

path_state path_place_state(const ovoid_robot_cell *c, void *memory) {
    link_frame *frames = memory;
    vec3 *axes = (vec3 *)(frames + c->frame_count);
    return (path_state){frames, axes, (oriented_box *)(axes + c->steps.count + c->own.count)};
}
