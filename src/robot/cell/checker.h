// A thread's memory for the states of a cell, and what its queries share.
#ifndef OVOID_ROBOT_CELL_CHECKER_H
#define OVOID_ROBOT_CELL_CHECKER_H

#include "robot/cell/cell.h"
#include "robot/cell/near_list.h"
#include "robot/model/pair_table.h"

/// The place of a sphere around items.
typedef struct sphere_place {
    double center[3]; ///< world
    double reach;     ///< its radius, by how much the items may be elsewhere, and what rounding does to the centre
} sphere_place;

/// A sphere by its centre, and by its reach without what rounding does to the centre.
static inline sphere_place sphere_place_make(vec3 center, double reach) {
    return (sphere_place){{center.x, center.y, center.z}, reach + CELL_SLACK * vec3_sum_abs(center)};
}

/// 1 where two spheres are proven farther apart than the margin.
static inline int spheres_are_far(const sphere_place *a, const sphere_place *b, double margin) {
    double x = b->center[0] - a->center[0], y = b->center[1] - a->center[1], z = b->center[2] - a->center[2];
    double reach = (a->reach + b->reach) + margin, square = (x * x + y * y) + z * z;
    return square * (1 - 0x1p-40) > reach * reach;
}

/// The box of an item in its own frame's state; error: what its points may be off by.
static inline oriented_box item_place_box(const cell_item *item, const link_frame *f, double error) {
    vec3 center = vec3_add(f->position, mat3_mul_vec3(f->matrix, item->middle));
    return (oriented_box){f->matrix, center, item->half, item->radius + error};
}

/// Which pair: of an item and a part of an obstacle, or of the cell's pairs of items.
typedef struct pair_name {
    uint32_t item;  ///< NONE: a pair of items
    uint32_t index; ///< the part, or the pair of items; NONE: there is none
} pair_name;

/// What the checker's searches of paths work with; made by the first of them.
typedef struct path_memory path_memory;

/// Where the centre of a group's sphere stays within the limits: `wander` from the anchor, in the world.
typedef struct group_reach {
    vec3 anchor;
    double wander;
} group_reach;

/// What the masks of reach are for; level below zero: they are not made yet.
typedef struct reach_key {
    double margin, level;
    uint64_t moved; ///< of the cell
} reach_key;

/// What is near in some of eight states: a group and a part, or a pair of groups.
typedef struct near_lanes {
    uint32_t group;
    uint32_t index;  ///< of the part, or of the pair
    uint32_t states; ///< a bit for each
} near_lanes;

/// What spheres and boxes leave of eight states.
typedef struct lane_filter {
    int is_made, is_on; ///< for these states; for the one that was taken
    double level;       ///< of the errors that are counted in
    near_lanes *parts, *pairs;
    size_t part_count, pair_count;
} lane_filter;

struct ovoid_robot_checker {
    const ovoid_robot_cell *cell;
    ovoid_allocator allocator;
    uint64_t version;    ///< of the cell, that the memory is for
    double level;        ///< the magnitude that `errors` are of; below zero: none
    pair_name last;      ///< the pair that ended the last state
    uint32_t last_count; ///< how many states one after another
    const robot8_kernels *kernels;
    uint32_t generation; ///< of what is remembered: a proof is of use where its mark is this
    uint32_t *part_marks, *pair_marks;
    /// Eight states side by side. Their values, their links' frames, their groups' spheres.
    double (*values8)[ROBOT8];
    frame8 *frames8;
    sphere8 *spheres8;
    lane_filter filter;
    int lane;           ///< of the state that is placed; below zero: it was placed alone
    link_frame *frames; ///< of links; of others where `stamps` say so
    uint64_t *stamps;   ///< of each frame: the state that it was computed for
    uint64_t state;     ///< how many states were placed
    frame_error *frame_errors;
    double *values, *cosines, *sines; ///< padded to a multiple of 8
    sphere_place *places;             ///< of each group
    inner_balls *balls;               ///< of each item, in the world, where `ball_stamps` say so
    uint64_t *ball_stamps;
    double *errors;                    ///< of each item: what its points may be off by
    double *group_errors;              ///< of each group: what its points may be off by
    ovoid_proof *part_proofs;          ///< of item i and part k at i part_count + k
    ovoid_proof *pair_proofs;          ///< of each pair of items
    near_key *near_keys;               ///< two of each pair that there is
    double *near_row;                  ///< a row of gradients
    uint64_t *part_nears, *pair_nears; ///< of each pair: the last state in which it was found near
    group_reach *reaches;              ///< of each group
    double (*reach_gaps)[ROBOT8];      ///< of each group and eight parts: how far they stay apart, at least
    uint8_t *reach_masks;              ///< and which it may come near
    reach_key reach_key;
    int has_limits; ///< the state that is placed, or the states, are within their limits
    const pair_table **pair_tables, **group_tables; ///< of each pair of items, of groups; NULL: there is none
    void *block;                                    ///< the memory of all these arrays
    ovoid_cover cover; ///< of depths that need more memory than a search has; NULL: none did
    path_memory *path; ///< NULL: no path was searched since the cell has changed
    void (*path_destroy)(path_memory *memory);
};

/// How many pairs there are to find.
static inline size_t checker_count_pairs(const ovoid_robot_checker *checker) {
    return checker->cell->items.count * checker->cell->parts.count + checker->cell->pairs.count;
}

/// Makes the checker's memory fit its cell; all is forgotten where that has changed.
ovoid_code checker_renew(ovoid_robot_checker *made, ovoid_error *error);

/// The answer where there is no pair to ask about.
static inline ovoid_robot_answer answer_make_empty(void) {
    const ovoid_robot_side none = {OVOID_ROBOT_NONE, OVOID_ROBOT_NONE, 0, 0};
    return (ovoid_robot_answer){.code = OVOID_ERROR_EMPTY, .a = none, .b = none, .lower = -INFINITY, .upper = INFINITY};
}

/// OVOID_OK where margin and slack are numbers >= 0; else ARGUMENT.
ovoid_code query_options_validate(const ovoid_robot_query_options *options, ovoid_error *error);

/// Makes errors those of states of that magnitude.
void checker_set_level(ovoid_robot_checker *checker, double magnitude);

/// The frames of the links, from the values.
void checker_compute_frames(ovoid_robot_checker *checker);

/// Sets the reaches of all groups; 0: they are infinite.
int checker_find_reaches(ovoid_robot_checker *checker);
/// Makes the masks fit the obstacles, the errors and the margin.
void checker_renew_masks(ovoid_robot_checker *checker, double margin);

/// The parts of a block that a group may come near; all, where states may be beyond their limits.
static inline unsigned checker_get_mask(const ovoid_robot_checker *checker, uint32_t group, uint32_t block) {
    const ovoid_robot_cell *c = checker->cell;
    if (checker->has_limits) return checker->reach_masks[group * c->boxes.count + block];
    return block + 1 < c->boxes.count ? 0xff : (1u << (c->parts.count - block * ROBOT8)) - 1;
}

/// Frames, places and errors of a state; options: the limits. The codes of a refused state, with its variable as
/// place.
ovoid_code checker_place(ovoid_robot_checker *checker, const double *q, double limit_slack, ovoid_error *error);

/// What is refused of a state, or OVOID_OK; and the magnitude of its errors.
typedef struct lane_state {
    ovoid_code code;
    uint32_t variable;
    double magnitude;
} lane_state;

/// Frames and places of up to eight states, side by side; those that are refused have none.
void checker_place_lanes(ovoid_robot_checker *checker, const double *q, size_t count, double limit_slack,
                         lane_state states[ROBOT8]);
/// Finds what spheres and boxes leave of the states that were placed; the search of each is then to have these options
/// and their margin.
void checker_filter_lanes(ovoid_robot_checker *checker, const ovoid_robot_query_options *options);
/// Makes one of them the state that is placed.
void checker_take_lane(ovoid_robot_checker *checker, uint32_t which, const lane_state *state);

/// A pair as its query wants it.
typedef struct checker_pair {
    ovoid_pair pair;
    solid_sides solids;
    const ovoid_robot_side *a, *b;
    ovoid_proof *proof;
    uint32_t *mark;
    const mat3 *rotation; ///< of a, where the proof is kept in its frame: of two links; NULL: in the world
    double error;         ///< of the poses: what the distance may be off by
    double padding;       ///< what is subtracted from it
    uint64_t *near;       ///< the last state in which it was found near
} checker_pair;

checker_pair checker_make_part_pair(ovoid_robot_checker *checker, uint32_t item, uint32_t part);
checker_pair checker_make_item_pair(ovoid_robot_checker *checker, uint32_t pair);

/// 1 where a table proves it of a state, by itself or in its lane.
static inline int checker_is_table_far(const ovoid_robot_checker *checker, const pair_table *table, double margin) {
    if (!table) return 0;
    if (checker->lane < 0) return pair_table_is_far(table, checker->values, 1, margin);
    return pair_table_is_far(table, checker->values8[0] + checker->lane, ROBOT8, margin);
}

/// 1 where the boxes of a pair, or its table, prove it farther apart than the margin; padding is added.
int checker_is_part_far(ovoid_robot_checker *checker, uint32_t item, uint32_t part, double margin);
int checker_is_pair_far(ovoid_robot_checker *checker, uint32_t pair, double margin);

/// The frame of an item of the state that is placed.
const link_frame *checker_get_frame(ovoid_robot_checker *checker, uint32_t which);

/// 1 where balls that cover one body prove it farther apart than the margin from the slabs around the other; padding is
/// added.
int checker_is_cover_far(ovoid_robot_checker *checker, const checker_pair *pair, pair_name name, double margin);

/// 1 where what is known to lie inside both bodies overlaps: then a bracket of the signed
/// distance as the poses are, the upper bound below zero.
int checker_prove_overlap(ovoid_robot_checker *checker, pair_name name, double *lower, double *upper);

/// Called for each pair that is not proven farther apart than `margin`; 0 ends the search.
typedef int checker_visit(void *context, const checker_pair *pair, pair_name name);

/// All pairs that the enclosing spheres and boxes leave.
typedef struct checker_search {
    ovoid_robot_checker *checker;
    const ovoid_robot_query_options *options;
    const double *margin; ///< may fall on the way
    checker_visit *visit;
    void *context;
    int expects_nears; ///< 1: what was near in the state before is visited, whatever its boxes say
} checker_search;
void checker_find_pairs(const checker_search *s);

/// d(distance)/d(variables) of the state placed last, from the gradient by both poses.
void checker_compute_gradient(const ovoid_robot_checker *checker, const checker_pair *p, const double gradient[12],
                              const double *q, double *row);

/// The answer to a state by a checker that fits its cell; 0: the state is refused.
int collide_state(ovoid_robot_checker *checker, const double *q, const ovoid_robot_query_options *options,
                  ovoid_robot_answer *answer);
/// The number of the pair that ended the last state that hit.
static inline uint32_t checker_get_last_number(const ovoid_robot_checker *checker) {
    size_t parts = checker->cell->parts.count, first = checker->cell->items.count * parts;
    if (checker->last.item == OVOID_ROBOT_NONE) return (uint32_t)(first + checker->last.index);
    return (uint32_t)(checker->last.item * parts + checker->last.index);
}

/// The states of a batch from `first` to before `end`, by a checker that has forgotten all and fits its cell.
void collide_block(ovoid_robot_checker *checker, const ovoid_robot_batch *batch, size_t first, size_t end);

/// OK where there are checkers, made to fit their cells.
ovoid_code checkers_validate(ovoid_robot_checker *const *checkers, size_t count, ovoid_error *error);
/// Many of a kind, in blocks; `run` does those from `first` to before `end` with a checker, which it makes forget all.
typedef struct checkers_job {
    void (*run)(void *context, ovoid_robot_checker *checker, size_t first, size_t end);
    void *context;
    size_t count;
} checkers_job;
/// Each checker takes blocks on a thread of its own. LIMIT: not all of these could be started; all is done.
ovoid_code checkers_run(ovoid_robot_checker *const *checkers, size_t count, const checkers_job *job,
                        ovoid_error *error);

/// What the pair's last query proved, or NULL. Of two links the normal is kept in the frame of the first, with which it
/// turns: what parted them often still does. A proof is measured again, so any normal is safe.
static inline const ovoid_proof *pair_get_earlier(const ovoid_robot_checker *checker, const checker_pair *p) {
    if (*p->mark != checker->generation) return NULL;
    if (p->rotation) p->proof->normal = mat3_mul_vec3(*p->rotation, p->proof->normal);
    return p->proof;
}
static inline void pair_remember(const ovoid_robot_checker *checker, const checker_pair *p, const ovoid_proof *proof) {
    *p->proof = *proof;
    *p->mark = checker->generation;
    if (!p->rotation) return;
    p->proof->normal = mat3_mul_transposed_vec3(*p->rotation, proof->normal);
    p->proof->normal_low = (vec3){0, 0, 0};
}

/// Did the pair's last query part its bodies?
static inline int pair_was_apart(const ovoid_robot_checker *checker, const checker_pair *p) {
    return *p->mark == checker->generation && p->proof->kind == OVOID_PROOF_POINTS;
}

/// a + b + c, not below the exact sum.
static inline double add_up(double a, double b, double c) { return ((a + b) + c) * (1 + 0x1p-50); }

/// The length by which the bodies may be nearer than they are as posed.
static inline double pair_get_clear(const checker_pair *p) { return add_up(p->padding, p->error, 0); }

/// Moves the exact query's bracket outward by the poses' errors, and by the padding.
static inline double lower_outward(const checker_pair *p, double lower) {
    double moved = lower - p->padding - p->error;
    return moved - 0x1p-51 * (fabs(lower) + p->padding + p->error);
}
static inline double upper_outward(const checker_pair *p, double upper) {
    double moved = upper - p->padding + p->error;
    return moved + 0x1p-51 * (fabs(upper) + p->padding + p->error);
}

#endif
