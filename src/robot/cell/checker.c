// Checkers: their memory, where a state puts things, and which pairs of these are near by their enclosing bodies.
#include "robot/cell/checker.h"

#include "base/compiler.h"
#include "base/environment.h"
#include "base/error.h"

#include <stddef.h>
#include <string.h>

// ---- memory

// The counts of a checker's arrays.
typedef enum array_count {
    PER_FRAME,
    PER_LINK,
    PER_VALUE, // of the robot, padded
    PER_VARIABLE,
    PER_GROUP,
    PER_ITEM,
    PER_ITEM_AND_PART,
    PER_PAIR,
    TWO_PER_PAIR,
    PER_GROUP_AND_PART,
    PER_GROUP_AND_BOXES,
    PER_GROUP_PAIR,
    ARRAY_COUNTS
} array_count;

#define ARRAY(member, count)                                                                                           \
    { offsetof(ovoid_robot_checker, member), sizeof *((ovoid_robot_checker *)NULL)->member, count }
static const struct {
    size_t pointer, size; // where the checker has it, and the size of an item
    array_count count;
} arrays[] = {ARRAY(frames, PER_FRAME),
              ARRAY(stamps, PER_FRAME),
              ARRAY(frame_errors, PER_FRAME),
              ARRAY(values, PER_VALUE),
              ARRAY(cosines, PER_VALUE),
              ARRAY(sines, PER_VALUE),
              ARRAY(places, PER_GROUP),
              ARRAY(errors, PER_ITEM),
              ARRAY(group_errors, PER_GROUP),
              ARRAY(part_proofs, PER_ITEM_AND_PART),
              ARRAY(pair_proofs, PER_PAIR),
              ARRAY(part_marks, PER_ITEM_AND_PART),
              ARRAY(pair_marks, PER_PAIR),
              ARRAY(near_keys, TWO_PER_PAIR),
              ARRAY(values8, PER_VALUE),
              ARRAY(frames8, PER_LINK),
              ARRAY(near_row, PER_VARIABLE),
              ARRAY(part_nears, PER_ITEM_AND_PART),
              ARRAY(pair_nears, PER_PAIR),
              ARRAY(balls, PER_ITEM),
              ARRAY(ball_stamps, PER_ITEM),
              ARRAY(spheres8, PER_GROUP),
              ARRAY(filter.parts, PER_GROUP_AND_PART),
              ARRAY(pair_tables, PER_PAIR),
              ARRAY(reaches, PER_GROUP),
              ARRAY(reach_masks, PER_GROUP_AND_BOXES),
              ARRAY(reach_gaps, PER_GROUP_AND_BOXES),
              ARRAY(group_tables, PER_GROUP_PAIR),
              ARRAY(filter.pairs, PER_GROUP_PAIR)};

static void release_all(ovoid_robot_checker *checker) {
    allocator_release(&checker->allocator, checker->block);
    allocator_release(&checker->allocator, checker->cover.memory);
    if (checker->path) checker->path_destroy(checker->path);
    *checker =
        (ovoid_robot_checker){.cell = checker->cell, .allocator = checker->allocator, .kernels = checker->kernels};
}

// All arrays in one block, cleared. 0 without memory.
static int make_arrays(ovoid_robot_checker *checker, const size_t counts[ARRAY_COUNTS]) {
    size_t total = 0;
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        total = allocator_end_array(total, counts[arrays[i].count], arrays[i].size);
    char *at = checker->block = allocator_allocate(&checker->allocator, total, 1);
    if (!at) return 0;
    memset(at, 0, total);
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        memcpy((char *)checker + arrays[i].pointer, &at, sizeof at);
        at += allocator_end_array(0, counts[arrays[i].count], arrays[i].size);
    }
    return 1;
}

static void forget(ovoid_robot_checker *checker) {
    checker->last = (pair_name){OVOID_ROBOT_NONE, OVOID_ROBOT_NONE};
    checker->last_count = 0;
    if (++checker->generation) return;
    // The generation has wrapped around to 0: marks of earlier generations would be taken for marks of this one.
    memset(checker->part_marks, 0,
           checker->cell->items.count * checker->cell->parts.count * sizeof *checker->part_marks);
    memset(checker->pair_marks, 0, checker->cell->pairs.count * sizeof *checker->pair_marks);
    checker->generation = 1;
}

static void set_world(frame8 *f) {
    memset(f, 0, sizeof *f);
    static const int ones[] = {FRAME8_QUATERNION, FRAME8_ROTATION, FRAME8_ROTATION + 4, FRAME8_ROTATION + 8};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < ROBOT8; k++) f->column[ones[i]][k] = 1;
}

// The tables hold for the elements of two links, whichever of them are queried; attached bodies have none. A pair of
// groups has one where all its pairs do.
static void set_tables(ovoid_robot_checker *checker, const pair_tables *tables) {
    const ovoid_robot_cell *c = checker->cell;
    for (uint32_t i = 0; i < c->group_pairs.count; i++) {
        const group_pair *both = &cell_group_pairs(c)[i];
        const pair_table *table = pair_tables_find(tables, cell_groups(c)[both->a].link, cell_groups(c)[both->b].link);
        checker->group_tables[i] = table;
        for (uint32_t k = both->first; k < both->end; k++) {
            item_pair items = cell_pairs(c)[k];
            int is_known = !cell_items(c)[items.a].side.body && !cell_items(c)[items.b].side.body;
            checker->pair_tables[k] = is_known ? table : NULL;
            if (!is_known) checker->group_tables[i] = NULL;
        }
    }
}

ovoid_code checker_renew(ovoid_robot_checker *made, ovoid_error *error) {
    const ovoid_robot_cell *c = made->cell;
    if (!c->is_whole)
        return error_set(error, OVOID_ERROR_MEMORY, -1, "the cell's last change found no memory: change it again");
    if (made->version == c->version) return OVOID_OK;
    release_all(made);
    const size_t counts[ARRAY_COUNTS] = {[PER_FRAME] = c->frame_count,
                                         [PER_LINK] = c->robot->link_count,
                                         [PER_VALUE] = (c->robot->value_count + ROBOT8 - 1) / ROBOT8 * ROBOT8,
                                         [PER_VARIABLE] = c->robot->variable_count,
                                         [PER_GROUP] = c->groups.count,
                                         [PER_ITEM] = c->items.count,
                                         [PER_ITEM_AND_PART] = c->items.count * c->parts.count,
                                         [PER_PAIR] = c->pairs.count,
                                         [TWO_PER_PAIR] = 2 * checker_count_pairs(made),
                                         [PER_GROUP_AND_PART] = c->groups.count * c->parts.count,
                                         [PER_GROUP_AND_BOXES] = c->groups.count * c->boxes.count,
                                         [PER_GROUP_PAIR] = c->group_pairs.count};
    const pair_tables *tables = robot_get_pair_tables(c->robot);
    if (!tables || !make_arrays(made, counts))
        return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a checker");
    set_tables(made, tables);
    made->version = c->version;
    made->level = made->lane = -1;
    made->frames[c->robot->root] = frame_make_world();
    set_world(&made->frames8[c->robot->root]);
    made->reach_key.level = -1;
    (void)checker_find_reaches(made);
    forget(made);
    return OVOID_OK;
}

static ovoid_robot_checker *create(const ovoid_robot_cell *cell, const ovoid_allocator *allocator, ovoid_error *error) {
    if (!cell) {
        error_write(error, OVOID_ERROR_ARGUMENT, -1, "a checker needs a cell");
        return NULL;
    }
    ovoid_allocator memory = allocator_make(allocator);
    ovoid_robot_checker *made = allocator_allocate(&memory, 1, sizeof *made);
    if (!made) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for a checker");
        return NULL;
    }
    *made = (ovoid_robot_checker){.cell = cell, .allocator = memory, .kernels = robot8_get_kernels()};
    if (checker_renew(made, error) == OVOID_OK) return made;
    allocator_release(&memory, made);
    return NULL;
}

ovoid_robot_checker *ovoid_robot_checker_create(const ovoid_robot_cell *cell,
                                                const ovoid_robot_checker_options *options, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_robot_checker *, cell, create(cell, options ? options->allocator : NULL, error));
}

static void destroy(ovoid_robot_checker *checker) {
    ovoid_allocator memory = checker->allocator;
    release_all(checker);
    allocator_release(&memory, checker);
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

void checker_set_level(ovoid_robot_checker *checker, double magnitude) {
    double level = robot_compute_level(checker->cell->robot, magnitude);
    if (level == checker->level) return;
    const ovoid_robot_cell *c = checker->cell;
    step_list links = {c->robot, c->steps.items, c->step_joints.items, c->steps.count};
    step_list own = {c->robot, c->own.items, NULL, c->own.count};
    checker->frame_errors[c->robot->root] = (frame_error){0, 0, 0};
    steps_compute_errors(&links, level, checker->frame_errors);
    steps_compute_errors(&own, level, checker->frame_errors);
    for (size_t i = 0; i < c->groups.count; i++) {
        const cell_group *g = &cell_groups(c)[i];
        checker->group_errors[i] = frame_error_at(&checker->frame_errors[g->link], g->far);
        for (uint32_t k = g->first; k < g->end; k++) {
            const cell_item *item = &cell_items(c)[k];
            checker->errors[k] = frame_error_at(&checker->frame_errors[item->frame], item->far);
            checker->group_errors[i] = max2(checker->group_errors[i], checker->errors[k]);
        }
    }
    checker->level = level;
}

// The frames of the links.
void checker_compute_frames(ovoid_robot_checker *checker) {
    const ovoid_robot_cell *c = checker->cell;
    uint32_t padded = (c->robot->value_count + ROBOT8 - 1) / ROBOT8 * ROBOT8;
    checker->kernels->half_turns(checker->values, padded, checker->cosines, checker->sines);
    steps_compute_frames(c->steps.items, c->steps.count, c->robot->root, checker->values, checker->cosines,
                         checker->sines, checker->frames);
}

static void place_groups(ovoid_robot_checker *checker) {
    for (size_t i = 0; i < checker->cell->groups.count; i++) {
        const cell_group *g = &cell_groups(checker->cell)[i];
        const link_frame *f = &checker->frames[g->link];
        vec3 center = vec3_add(f->position, mat3_mul_vec3(f->matrix, g->center));
        checker->places[i] = sphere_place_make(center, g->reach + checker->group_errors[i]);
    }
}

ovoid_code checker_place(ovoid_robot_checker *checker, const double *q, double limit_slack, ovoid_error *error) {
    const ovoid_robot *r = checker->cell->robot;
    double magnitude;
    if (limit_slack < INFINITY && !state_is_within_limits(r, q, limit_slack))
        return ovoid_robot_validate_limits(r, q, limit_slack, error);
    ovoid_code code = robot_compute_values(r, q, checker->values, 1, &magnitude, error);
    if (code != OVOID_OK) return code;
    checker_set_level(checker, magnitude);
    checker->state++;
    checker->lane = -1;
    checker->filter.is_on = 0;
    checker->has_limits = limit_slack == 0;
    checker_compute_frames(checker);
    place_groups(checker);
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
const link_frame *checker_get_frame(ovoid_robot_checker *checker, uint32_t which) {
    uint32_t links = checker->cell->robot->link_count;
    if (checker->stamps[which] == checker->state || (which < links && checker->lane < 0))
        return &checker->frames[which];
    checker->stamps[which] = checker->state;
    if (which < links) {
        load_frame(&checker->frames8[which], checker->lane, &checker->frames[which]);
        return &checker->frames[which];
    }
    const chain_step *s = (const chain_step *)checker->cell->own.items + (which - links);
    const link_frame *parent =
        checker_get_frame(checker, s->parent == OVOID_ROBOT_NONE ? checker->cell->robot->root : s->parent);
    step_apply(s, parent, checker->values, (turn){1, 0}, &checker->frames[which]);
    return &checker->frames[which];
}

static ovoid_pose get_pose(ovoid_robot_checker *checker, const cell_item *item) {
    const link_frame *f = checker_get_frame(checker, item->frame);
    return (ovoid_pose){f->position, f->rotation};
}

static oriented_box place_box(ovoid_robot_checker *checker, uint32_t item) {
    const cell_item *it = &cell_items(checker->cell)[item];
    return item_place_box(it, checker_get_frame(checker, it->frame), checker->errors[item]);
}

// The box of a group.
static oriented_box place_group_box(ovoid_robot_checker *checker, uint32_t group) {
    const cell_group *g = &cell_groups(checker->cell)[group];
    const link_frame *f = checker_get_frame(checker, g->link);
    vec3 center = vec3_add(f->position, mat3_mul_vec3(f->matrix, g->middle));
    return (oriented_box){f->matrix, center, g->half, g->radius + checker->group_errors[group]};
}

int checker_is_part_far(ovoid_robot_checker *checker, uint32_t item, uint32_t part, double margin) {
    oriented_box box = place_box(checker, item);
    double padding = checker->cell->padding[cell_items(checker->cell)[item].side.link];
    return oriented_boxes_are_far(&box, &cell_parts(checker->cell)[part].box, add_up(margin, padding, 0));
}

int checker_is_pair_far(ovoid_robot_checker *checker, uint32_t pair, double margin) {
    item_pair p = cell_pairs(checker->cell)[pair];
    if (checker_is_table_far(checker, checker->pair_tables[pair], margin)) return 1;
    oriented_box a = place_box(checker, p.a), b = place_box(checker, p.b);
    return oriented_boxes_are_far(&a, &b, margin);
}

// ---- what is inside the bodies

// The balls inside an item, placed where they are first asked for.
static const inner_balls *get_balls(ovoid_robot_checker *checker, uint32_t item) {
    inner_balls *world = &checker->balls[item];
    if (checker->ball_stamps[item] == checker->state) return world;
    checker->ball_stamps[item] = checker->state;
    const cell_item *it = &cell_items(checker->cell)[item];
    const link_frame *f = checker_get_frame(checker, it->frame);
    const double position[3] = {f->position.x, f->position.y, f->position.z};
    checker->kernels->place_balls(&f->matrix, position, &it->inside->balls, world);
    return world;
}

// How deep an item's balls come into a region, which rounding moves by parts of `size`; at most zero: none is shown to.
static double compute_depth(ovoid_robot_checker *checker, uint32_t item, const inner_region *g, double radius,
                            double size) {
    // Too little is known of a body that may be smaller than its shape.
    if (!(radius >= 0)) return 0;
    const placed_balls balls = {cell_items(checker->cell)[item].inside, get_balls(checker, item)};
    return placed_balls_find_region_depth(checker->kernels, balls, g, radius - CELL_SLACK * size * g->condition);
}

static double get_size(ovoid_robot_checker *checker, uint32_t item) {
    const cell_item *it = &cell_items(checker->cell)[item];
    return it->inside->size + vec3_sum_abs(checker_get_frame(checker, it->frame)->position);
}

// How deep the balls of two items come into one another.
static double compute_balls_depth(ovoid_robot_checker *checker, item_pair both) {
    const placed_balls a = {cell_items(checker->cell)[both.a].inside, get_balls(checker, both.a)};
    const placed_balls b = {cell_items(checker->cell)[both.b].inside, get_balls(checker, both.b)};
    oriented_box box = place_box(checker, both.b);
    const inner_region around = {mat3_transpose(box.rotation), box.center, box.half, 1, box.radius, 1};
    return placed_balls_find_depth(checker->kernels, a, &around, b);
}

int checker_prove_overlap(ovoid_robot_checker *checker, pair_name name, double *lower, double *upper) {
    const cell_part *part = name.item == OVOID_ROBOT_NONE ? NULL : &cell_parts(checker->cell)[name.index];
    item_pair both = part ? (item_pair){name.item, 0} : cell_pairs(checker->cell)[name.index];
    double depth = part ? compute_depth(checker, both.a, &part->inside, part->shape->upper_radius,
                                        get_size(checker, both.a) + part->inside_size)
                        : compute_balls_depth(checker, both);
    *upper = -depth;
    if (!(depth > 0)) return 0;
    oriented_box box_a = place_box(checker, both.a), box_b = part ? part->box : place_box(checker, both.b);
    *lower = oriented_boxes_compute_lower(&box_a, &box_b);
    return 1;
}

// ---- pairs

checker_pair checker_make_part_pair(ovoid_robot_checker *checker, uint32_t item, uint32_t part) {
    const ovoid_robot_cell *c = checker->cell;
    const cell_item *a = &cell_items(c)[item];
    const cell_part *b = &cell_parts(c)[part];
    size_t at = item * c->parts.count + part;
    checker_pair p = {.a = &a->side,
                      .b = &b->side,
                      .proof = &checker->part_proofs[at],
                      .mark = &checker->part_marks[at],
                      .near = &checker->part_nears[at]};
    p.pair = (ovoid_pair){a->shape, b->shape, get_pose(checker, a), b->pose};
    p.solids = cell_get_part_solids(a, b);
    p.error = checker->errors[item];
    p.padding = c->padding[a->side.link];
    return p;
}

checker_pair checker_make_item_pair(ovoid_robot_checker *checker, uint32_t pair) {
    const ovoid_robot_cell *c = checker->cell;
    item_pair both = cell_pairs(c)[pair];
    const cell_item *a = &cell_items(c)[both.a], *b = &cell_items(c)[both.b];
    checker_pair p = {.a = &a->side,
                      .b = &b->side,
                      .proof = &checker->pair_proofs[pair],
                      .mark = &checker->pair_marks[pair],
                      .near = &checker->pair_nears[pair]};
    p.pair = (ovoid_pair){a->shape, b->shape, get_pose(checker, a), get_pose(checker, b)};
    p.solids = cell_get_item_solids(a, b);
    p.rotation = &checker_get_frame(checker, a->frame)->matrix;
    p.error = checker->errors[both.a] + checker->errors[both.b];
    return p;
}

// Was the pair near in the state before?
static int is_expected(const checker_search *s, const uint64_t *near) {
    return s->expects_nears && *near && *near + 1 == s->checker->state;
}

// The boxes of a lane group that a group of items is near, by its sphere.
static unsigned find_near_boxes(const checker_search *s, uint32_t items, uint32_t group) {
    const ovoid_robot_checker *checker = s->checker;
    unsigned mask = checker_get_mask(checker, items, group);
    if (!mask) return 0;
    const ovoid_robot_cell *c = checker->cell;
    const sphere_place *sphere = &checker->places[items];
    double reach = add_up(sphere->reach, *s->margin, c->padding[cell_groups(c)[items].link]);
    unsigned near = checker->kernels->near_boxes(&cell_boxes(c)[group], sphere->center, reach);
    return near & mask;
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
    checker_renew_masks(s->checker, *s->margin);
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
    ovoid_robot_checker *checker = s->checker;
    int are_boxes_of_items =
        cell_groups(checker->cell)[both->a].is_box_of_item && cell_groups(checker->cell)[both->b].is_box_of_item;
    for (uint32_t i = both->first; i < both->end; i++) {
        if (!are_boxes_of_items && !is_expected(s, &checker->pair_nears[i]) &&
            checker_is_pair_far(checker, i, *s->margin))
            continue;
        checker_pair p = checker_make_item_pair(checker, i);
        if (!s->visit(s->context, &p, (pair_name){OVOID_ROBOT_NONE, i})) return 0;
    }
    return 1;
}

// What the filter leaves of the state, in the order of the search.
static int visit_filtered_parts(const checker_search *s) {
    ovoid_robot_checker *checker = s->checker;
    uint32_t state = 1u << checker->lane;
    const near_lanes *end = checker->filter.parts + checker->filter.part_count;
    for (const near_lanes *near = checker->filter.parts; near < end; near++) {
        if (!(near->states & state)) continue;
        oriented_box box = place_group_box(checker, near->group);
        if (!visit_near_part(s, &cell_groups(checker->cell)[near->group], &box, near->index)) return 0;
    }
    return 1;
}

static void visit_filtered_pairs(const checker_search *s) {
    ovoid_robot_checker *checker = s->checker;
    uint32_t state = 1u << checker->lane;
    const near_lanes *end = checker->filter.pairs + checker->filter.pair_count;
    for (const near_lanes *near = checker->filter.pairs; near < end; near++)
        if ((near->states & state) && !visit_group_pair(s, &cell_group_pairs(checker->cell)[near->index])) return;
}

static void visit_pairs(const checker_search *s) {
    ovoid_robot_checker *checker = s->checker;
    for (uint32_t i = 0; i < checker->cell->group_pairs.count; i++) {
        const group_pair *both = &cell_group_pairs(checker->cell)[i];
        if (spheres_are_far(&checker->places[both->a], &checker->places[both->b], *s->margin) ||
            checker_is_table_far(checker, checker->group_tables[i], *s->margin))
            continue;
        if (!is_expected(s, &checker->pair_nears[both->first])) {
            oriented_box a = place_group_box(checker, both->a), b = place_group_box(checker, both->b);
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
