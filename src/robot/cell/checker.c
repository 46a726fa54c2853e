// Checkers: their memory, where a state puts things, and which pairs of these are near by their enclosing bodies.
#include "robot/cell/checker.h"

#include "base/compiler.h"
#include "base/environment.h"
#include "base/error.h"

#include <string.h>

// ---- memory

static void release_all(ovoid_robot_checker *x) {
    void *all[] = {x->frames,       x->stamps,  x->frame_errors, x->values,      x->cosines,     x->sines,
                   x->places,       x->errors,  x->group_errors, x->part_proofs, x->pair_proofs, x->part_marks,
                   x->pair_marks,   x->values8, x->frames8,      x->spheres8,    x->near_keys,   x->filter.parts,
                   x->filter.pairs, x->balls,   x->ball_stamps,  x->near_row,    x->part_nears,  x->pair_nears};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) allocator_release(&x->allocator, all[i]);
    path_memory_destroy(x->path);
    *x = (ovoid_robot_checker){.cell = x->cell, .allocator = x->allocator, .kernels = x->kernels};
}

// Cleared memory that is the checker's; *is_there becomes 0 where there is none.
static void *take(const ovoid_robot_checker *x, size_t count, size_t size, int *is_there) {
    void *memory = allocator_allocate(&x->allocator, count, size);
    *is_there = *is_there && memory;
    return memory ? memset(memory, 0, count * size) : NULL;
}

static void forget(ovoid_robot_checker *x) {
    x->last = (pair_name){OVOID_ROBOT_NONE, OVOID_ROBOT_NONE};
    x->last_count = 0;
    if (++x->generation) return;
    // The generation has wrapped around to 0: marks of earlier generations would be taken for marks of this one.
    memset(x->part_marks, 0, x->cell->items.count * x->cell->parts.count * sizeof *x->part_marks);
    memset(x->pair_marks, 0, x->cell->pairs.count * sizeof *x->pair_marks);
    x->generation = 1;
}

static void set_world(frame8 *f) {
    memset(f, 0, sizeof *f);
    static const int ones[] = {FRAME8_QUATERNION, FRAME8_ROTATION, FRAME8_ROTATION + 4, FRAME8_ROTATION + 8};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < ROBOT8; k++) f->column[ones[i]][k] = 1;
}

ovoid_code checker_renew(ovoid_robot_checker *x, ovoid_error *error) {
    const ovoid_robot_cell *c = x->cell;
    if (!c->is_whole)
        return error_set(error, OVOID_ERROR_MEMORY, -1, "the cell's last change found no memory: change it again");
    if (x->version == c->version) return OVOID_OK;
    release_all(x);
    int ok = 1;
    size_t frames = c->frame_count, groups = c->groups.count, proofs = c->items.count * c->parts.count;
    size_t values = (c->robot->value_count + ROBOT8 - 1) / ROBOT8 * ROBOT8;
    x->frames = take(x, frames, sizeof *x->frames, &ok);
    x->stamps = take(x, frames, sizeof *x->stamps, &ok);
    x->frame_errors = take(x, frames, sizeof *x->frame_errors, &ok);
    x->values = take(x, values, sizeof *x->values, &ok);
    x->cosines = take(x, values, sizeof *x->cosines, &ok);
    x->sines = take(x, values, sizeof *x->sines, &ok);
    x->places = take(x, groups, sizeof *x->places, &ok);
    x->errors = take(x, c->items.count, sizeof *x->errors, &ok);
    x->group_errors = take(x, groups, sizeof *x->group_errors, &ok);
    x->part_proofs = take(x, proofs, sizeof *x->part_proofs, &ok);
    x->pair_proofs = take(x, c->pairs.count, sizeof *x->pair_proofs, &ok);
    x->part_marks = take(x, proofs, sizeof *x->part_marks, &ok);
    x->pair_marks = take(x, c->pairs.count, sizeof *x->pair_marks, &ok);
    x->near_keys = take(x, 2 * checker_count_pairs(x), sizeof *x->near_keys, &ok);
    x->values8 = take(x, values, sizeof *x->values8, &ok);
    x->frames8 = take(x, c->robot->link_count, sizeof *x->frames8, &ok);
    x->near_row = take(x, c->robot->variable_count, sizeof *x->near_row, &ok);
    x->part_nears = take(x, proofs, sizeof *x->part_nears, &ok);
    x->pair_nears = take(x, c->pairs.count, sizeof *x->pair_nears, &ok);
    x->balls = take(x, c->items.count, sizeof *x->balls, &ok);
    x->ball_stamps = take(x, c->items.count, sizeof *x->ball_stamps, &ok);
    x->spheres8 = take(x, groups, sizeof *x->spheres8, &ok);
    x->filter.parts = take(x, groups * c->parts.count, sizeof *x->filter.parts, &ok);
    x->filter.pairs = take(x, c->group_pairs.count, sizeof *x->filter.pairs, &ok);
    if (!ok) {
        release_all(x);
        return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a checker");
    }
    x->version = c->version;
    x->level = x->lane = -1;
    x->frames[c->robot->root] = frame_make_world();
    set_world(&x->frames8[c->robot->root]);
    forget(x);
    return OVOID_OK;
}

static ovoid_robot_checker *create(const ovoid_robot_cell *cell, const ovoid_allocator *allocator, ovoid_error *error) {
    if (!cell) {
        error_write(error, OVOID_ERROR_ARGUMENT, -1, "a checker needs a cell");
        return NULL;
    }
    ovoid_allocator memory = allocator_make(allocator);
    ovoid_robot_checker *x = allocator_allocate(&memory, 1, sizeof *x);
    if (!x) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for a checker");
        return NULL;
    }
    *x = (ovoid_robot_checker){.cell = cell, .allocator = memory, .kernels = robot8_get_kernels()};
    if (checker_renew(x, error) == OVOID_OK) return x;
    allocator_release(&memory, x);
    return NULL;
}

ovoid_robot_checker *ovoid_robot_checker_create(const ovoid_robot_cell *cell, const ovoid_allocator *allocator,
                                                ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_robot_checker *, cell, create(cell, allocator, error));
}

static void destroy(ovoid_robot_checker *x) {
    ovoid_allocator memory = x->allocator;
    release_all(x);
    allocator_release(&memory, x);
}

void ovoid_robot_checker_destroy(ovoid_robot_checker *checker) {
    if (!checker) return;
    ENVIRONMENT_RUN(destroy(checker));
}

void ovoid_robot_checker_reset(ovoid_robot_checker *checker) {
    if (checker->version == checker->cell->version) forget(checker);
}

ovoid_code query_options_validate(const ovoid_robot_query_options *o, ovoid_error *error) {
    if (o->margin >= 0 && o->limit_slack >= 0) return OVOID_OK;
    return error_set(error, OVOID_ERROR_ARGUMENT, -1,
                     "the margin and the slack of the limits are lengths of at least 0");
}

// ---- where a state puts things

void checker_set_level(ovoid_robot_checker *x, double magnitude) {
    double level = robot_compute_level(x->cell->robot, magnitude);
    if (level == x->level) return;
    const ovoid_robot_cell *c = x->cell;
    step_list links = {c->robot, c->steps.items, c->step_joints.items, c->steps.count};
    step_list own = {c->robot, c->own.items, NULL, c->own.count};
    x->frame_errors[c->robot->root] = (frame_error){0, 0, 0};
    steps_compute_errors(&links, level, x->frame_errors);
    steps_compute_errors(&own, level, x->frame_errors);
    for (size_t i = 0; i < c->groups.count; i++) {
        const cell_group *g = &cell_groups(c)[i];
        x->group_errors[i] = frame_error_at(&x->frame_errors[g->link], g->far);
        for (uint32_t k = g->first; k < g->end; k++) {
            const cell_item *item = &cell_items(c)[k];
            x->errors[k] = frame_error_at(&x->frame_errors[item->frame], item->far);
            x->group_errors[i] = max2(x->group_errors[i], x->errors[k]);
        }
    }
    x->level = level;
}

// The frames of the links.
static void compute_frames(ovoid_robot_checker *x) {
    const ovoid_robot_cell *c = x->cell;
    uint32_t padded = (c->robot->value_count + ROBOT8 - 1) / ROBOT8 * ROBOT8;
    x->kernels->half_turns(x->values, padded, x->cosines, x->sines);
    steps_compute_frames(c->steps.items, c->steps.count, c->robot->root, x->values, x->cosines, x->sines, x->frames);
}

static void place_groups(ovoid_robot_checker *x) {
    for (size_t i = 0; i < x->cell->groups.count; i++) {
        const cell_group *g = &cell_groups(x->cell)[i];
        const link_frame *f = &x->frames[g->link];
        vec3 center = vec3_add(f->position, mat3_mul_vec3(f->matrix, g->center));
        x->places[i] = sphere_place_make(center, g->reach + x->group_errors[i]);
    }
}

ovoid_code checker_place(ovoid_robot_checker *x, const double *q, double limit_slack, ovoid_error *error) {
    const ovoid_robot *r = x->cell->robot;
    double magnitude;
    if (limit_slack < INFINITY && !state_is_within_limits(r, q, limit_slack))
        return ovoid_robot_validate_limits(r, q, limit_slack, error);
    ovoid_code code = robot_compute_values(r, q, x->values, 1, &magnitude, error);
    if (code != OVOID_OK) return code;
    checker_set_level(x, magnitude);
    x->state++;
    x->lane = -1;
    x->filter.is_on = 0;
    compute_frames(x);
    place_groups(x);
    return OVOID_OK;
}

static void load_frame(const frame8 *from, int k, link_frame *f) {
    const double(*c)[ROBOT8] = from->column;
    *f = (link_frame){{c[0][k], c[1][k], c[2][k]},
                      {c[3][k], c[4][k], c[5][k], c[6][k]},
                      {{c[7][k], c[8][k], c[9][k]}, {c[10][k], c[11][k], c[12][k]}, {c[13][k], c[14][k], c[15][k]}}};
}

// ---- items

// A frame, computed where it is first asked for: those fixed to links; of states in lanes, those of links too.
static const link_frame *get_frame(ovoid_robot_checker *x, uint32_t which) {
    uint32_t links = x->cell->robot->link_count;
    if (x->stamps[which] == x->state || (which < links && x->lane < 0)) return &x->frames[which];
    x->stamps[which] = x->state;
    if (which < links) {
        load_frame(&x->frames8[which], x->lane, &x->frames[which]);
        return &x->frames[which];
    }
    const chain_step *s = (const chain_step *)x->cell->own.items + (which - links);
    const link_frame *parent = get_frame(x, s->parent == OVOID_ROBOT_NONE ? x->cell->robot->root : s->parent);
    step_apply(s, parent, x->values, (turn){1, 0}, &x->frames[which]);
    return &x->frames[which];
}

static ovoid_pose get_pose(ovoid_robot_checker *x, const cell_item *item) {
    const link_frame *f = get_frame(x, item->frame);
    return (ovoid_pose){f->position, f->rotation};
}

static oriented_box place_box(ovoid_robot_checker *x, uint32_t item) {
    const cell_item *it = &cell_items(x->cell)[item];
    return item_place_box(it, get_frame(x, it->frame), x->errors[item]);
}

// The box of a group.
static oriented_box place_group_box(ovoid_robot_checker *x, uint32_t group) {
    const cell_group *g = &cell_groups(x->cell)[group];
    const link_frame *f = get_frame(x, g->link);
    vec3 center = vec3_add(f->position, mat3_mul_vec3(f->matrix, g->middle));
    return (oriented_box){f->matrix, center, g->half, g->radius + x->group_errors[group]};
}

int checker_is_part_far(ovoid_robot_checker *x, uint32_t item, uint32_t part, double margin) {
    oriented_box box = place_box(x, item);
    double padding = x->cell->padding[cell_items(x->cell)[item].side.link];
    return oriented_boxes_are_far(&box, &cell_parts(x->cell)[part].box, add_up(margin, padding, 0));
}

int checker_is_pair_far(ovoid_robot_checker *x, uint32_t pair, double margin) {
    item_pair p = cell_pairs(x->cell)[pair];
    oriented_box a = place_box(x, p.a), b = place_box(x, p.b);
    return oriented_boxes_are_far(&a, &b, margin);
}

// ---- what is inside the bodies

// The balls inside an item, placed where they are first asked for.
static const inner_balls *get_balls(ovoid_robot_checker *x, uint32_t item) {
    inner_balls *world = &x->balls[item];
    if (x->ball_stamps[item] == x->state) return world;
    x->ball_stamps[item] = x->state;
    const cell_item *it = &cell_items(x->cell)[item];
    const link_frame *f = get_frame(x, it->frame);
    const double position[3] = {f->position.x, f->position.y, f->position.z};
    x->kernels->place_balls(&f->matrix, position, &it->inside->balls, world);
    return world;
}

// How deep an item's balls come into a region, which rounding moves by parts of `size`; at most zero: none is shown to.
static double compute_depth(ovoid_robot_checker *x, uint32_t item, const inner_region *g, double radius, double size) {
    const shape_inside *in = cell_items(x->cell)[item].inside;
    // Of a body that may be smaller than its shape too little is known.
    if (!(radius >= 0)) return 0;
    double more = radius - CELL_SLACK * size * g->condition;
    double deep = x->kernels->balls_in_region(get_balls(x, item), g, more);
    if (!(deep > 0)) return 0;
    double limit = (in->most + more) * g->scale + g->offset;
    return 0.499 * min2(deep / (limit * g->scale), in->least + more);
}

static double get_size(ovoid_robot_checker *x, uint32_t item) {
    const cell_item *it = &cell_items(x->cell)[item];
    return it->inside->size + vec3_sum_abs(get_frame(x, it->frame)->position);
}

// How deep the balls of two items come into one another.
static double compute_balls_depth(ovoid_robot_checker *x, item_pair both) {
    const shape_inside *a = cell_items(x->cell)[both.a].inside, *b = cell_items(x->cell)[both.b].inside;
    oriented_box box = place_box(x, both.b);
    // Balls that do not come into the box around the other body meet none of its balls.
    const inner_region around = {mat3_transpose(box.rotation), box.center, box.half, 1, box.radius, 1};
    double deep = x->kernels->balls_in_balls(get_balls(x, both.a), &around, get_balls(x, both.b));
    return deep > 0 ? 0.499 * deep / (a->most + b->most) : 0;
}

int checker_prove_overlap(ovoid_robot_checker *x, pair_name name, double *lower, double *upper) {
    const cell_part *part = name.item == OVOID_ROBOT_NONE ? NULL : &cell_parts(x->cell)[name.index];
    item_pair both = part ? (item_pair){name.item, 0} : cell_pairs(x->cell)[name.index];
    double depth = part ? compute_depth(x, both.a, &part->inside, part->shape->upper_radius,
                                        get_size(x, both.a) + part->inside_size)
                        : compute_balls_depth(x, both);
    *upper = -depth;
    if (!(depth > 0)) return 0;
    oriented_box box_a = place_box(x, both.a), box_b = part ? part->box : place_box(x, both.b);
    *lower = oriented_boxes_compute_lower(&box_a, &box_b);
    return 1;
}

// ---- pairs

checker_pair checker_make_part_pair(ovoid_robot_checker *x, uint32_t item, uint32_t part) {
    const ovoid_robot_cell *c = x->cell;
    const cell_item *a = &cell_items(c)[item];
    const cell_part *b = &cell_parts(c)[part];
    size_t at = item * c->parts.count + part;
    checker_pair p = {.a = &a->side,
                      .b = &b->side,
                      .proof = &x->part_proofs[at],
                      .mark = &x->part_marks[at],
                      .near = &x->part_nears[at]};
    p.pair = (ovoid_pair){a->shape, b->shape, get_pose(x, a), b->pose};
    p.solids = cell_get_part_solids(a, b);
    p.error = x->errors[item];
    p.padding = c->padding[a->side.link];
    return p;
}

checker_pair checker_make_item_pair(ovoid_robot_checker *x, uint32_t pair) {
    const ovoid_robot_cell *c = x->cell;
    item_pair both = cell_pairs(c)[pair];
    const cell_item *a = &cell_items(c)[both.a], *b = &cell_items(c)[both.b];
    checker_pair p = {.a = &a->side,
                      .b = &b->side,
                      .proof = &x->pair_proofs[pair],
                      .mark = &x->pair_marks[pair],
                      .near = &x->pair_nears[pair]};
    p.pair = (ovoid_pair){a->shape, b->shape, get_pose(x, a), get_pose(x, b)};
    p.solids = cell_get_item_solids(a, b);
    p.rotation = &get_frame(x, a->frame)->matrix;
    p.error = x->errors[both.a] + x->errors[both.b];
    return p;
}

// Was the pair near in the state before?
static int is_expected(const checker_search *s, const uint64_t *near) {
    return s->expects_nears && *near && *near + 1 == s->checker->state;
}

// The boxes of a lane group that a group of items is near, by its sphere.
static unsigned find_near_boxes(const checker_search *s, uint32_t items, uint32_t group) {
    const ovoid_robot_checker *x = s->checker;
    const ovoid_robot_cell *c = x->cell;
    const sphere_place *sphere = &x->places[items];
    double reach = add_up(sphere->reach, *s->margin, c->padding[cell_groups(c)[items].link]);
    unsigned near = x->kernels->near_boxes(&cell_boxes(c)[group], sphere->center, reach);
    return group + 1 < c->boxes.count ? near : near & ((1u << (c->parts.count - group * ROBOT8)) - 1);
}

static int visit_part(const checker_search *s, uint32_t item, uint32_t part) {
    checker_pair p = checker_make_part_pair(s->checker, item, part);
    return s->visit(s->context, &p, (pair_name){item, part});
}

// Each item of a group against a part that the group is near.
static int visit_items(const checker_search *s, const cell_group *g, uint32_t part) {
    const ovoid_robot_cell *c = s->checker->cell;
    if (cell_is_allowed(c, &cell_items(c)[g->first].side, &cell_parts(c)[part].side)) return 1;
    if (g->is_box_of_item) return visit_part(s, g->first, part);
    for (uint32_t item = g->first; item < g->end; item++) {
        size_t pair = item * c->parts.count + part;
        if (!is_expected(s, &s->checker->part_nears[pair]) && checker_is_part_far(s->checker, item, part, *s->margin))
            continue;
        if (!visit_part(s, item, part)) return 0;
    }
    return 1;
}

// A part that the sphere of a group is near.
static int visit_near_part(const checker_search *s, const cell_group *g, const oriented_box *box, uint32_t part) {
    const ovoid_robot_cell *c = s->checker->cell;
    double margin = add_up(*s->margin, c->padding[g->link], 0);
    if (is_expected(s, &s->checker->part_nears[g->first * c->parts.count + part])) return visit_items(s, g, part);
    return oriented_boxes_are_far(box, &cell_parts(c)[part].box, margin) || visit_items(s, g, part);
}

static int visit_parts(const checker_search *s) {
    const ovoid_robot_cell *c = s->checker->cell;
    for (uint32_t i = 0; i < c->groups.count; i++) {
        const cell_group *g = &cell_groups(c)[i];
        for (uint32_t group = 0; group < c->boxes.count; group++) {
            unsigned near = find_near_boxes(s, i, group);
            if (!near) continue;
            oriented_box box = place_group_box(s->checker, i);
            for (; near; near &= near - 1)
                if (!visit_near_part(s, g, &box, group * ROBOT8 + compiler_count_low_zeros(near))) return 0;
        }
    }
    return 1;
}

static int visit_group_pair(const checker_search *s, const group_pair *both) {
    ovoid_robot_checker *x = s->checker;
    int are_boxes_of_items =
        cell_groups(x->cell)[both->a].is_box_of_item && cell_groups(x->cell)[both->b].is_box_of_item;
    for (uint32_t i = both->first; i < both->end; i++) {
        if (!are_boxes_of_items && !is_expected(s, &x->pair_nears[i]) && checker_is_pair_far(x, i, *s->margin))
            continue;
        checker_pair p = checker_make_item_pair(x, i);
        if (!s->visit(s->context, &p, (pair_name){OVOID_ROBOT_NONE, i})) return 0;
    }
    return 1;
}

// What the filter leaves of the state, in the order of the search.
static int visit_filtered_parts(const checker_search *s) {
    ovoid_robot_checker *x = s->checker;
    uint32_t state = 1u << x->lane;
    const near_lanes *end = x->filter.parts + x->filter.part_count;
    for (const near_lanes *near = x->filter.parts; near < end; near++) {
        if (!(near->states & state)) continue;
        oriented_box box = place_group_box(x, near->group);
        if (!visit_near_part(s, &cell_groups(x->cell)[near->group], &box, near->index)) return 0;
    }
    return 1;
}

static void visit_filtered_pairs(const checker_search *s) {
    ovoid_robot_checker *x = s->checker;
    uint32_t state = 1u << x->lane;
    const near_lanes *end = x->filter.pairs + x->filter.pair_count;
    for (const near_lanes *near = x->filter.pairs; near < end; near++)
        if ((near->states & state) && !visit_group_pair(s, &cell_group_pairs(x->cell)[near->index])) return;
}

static void visit_pairs(const checker_search *s) {
    ovoid_robot_checker *x = s->checker;
    for (uint32_t i = 0; i < x->cell->group_pairs.count; i++) {
        const group_pair *both = &cell_group_pairs(x->cell)[i];
        if (spheres_are_far(&x->places[both->a], &x->places[both->b], *s->margin)) continue;
        if (!is_expected(s, &x->pair_nears[both->first])) {
            oriented_box a = place_group_box(x, both->a), b = place_group_box(x, both->b);
            if (oriented_boxes_are_far(&a, &b, *s->margin)) continue;
        }
        if (!visit_group_pair(s, both)) return;
    }
}

void checker_find_pairs(const checker_search *s) {
    int is_filtered = s->checker->filter.is_on;
    if (!s->options->without_obstacles && !(is_filtered ? visit_filtered_parts(s) : visit_parts(s))) return;
    if (s->options->without_self) return;
    if (is_filtered)
        visit_filtered_pairs(s);
    else
        visit_pairs(s);
}
