// Motions of a robot's bodies along a segment of a path: how far they come in an interval, and what that proves.
#ifndef OVOID_ROBOT_PATH_MOTION_H
#define OVOID_ROBOT_PATH_MOTION_H

#include "ovoid/robot_path.h"
#include "robot/cell/checker.h"

/// A number of the cell's pairs taken apart: an item and a part, or (other) two items.
typedef struct pair_parts {
    uint32_t item, other, part, pair; ///< part NONE: two items, pair among the cell's
} pair_parts;
static inline size_t path_count_numbers(const ovoid_robot_cell *c) {
    return c->items.count * c->parts.count + c->pairs.count;
}
static inline pair_parts pair_take_apart(const ovoid_robot_cell *c, uint32_t number) {
    size_t parts = c->items.count * c->parts.count;
    if (number < parts)
        return (pair_parts){(uint32_t)(number / c->parts.count), 0, (uint32_t)(number % c->parts.count), 0};
    uint32_t pair = (uint32_t)(number - parts);
    return (pair_parts){cell_pairs(c)[pair].a, cell_pairs(c)[pair].b, OVOID_ROBOT_NONE, pair};
}

/// How fast a step of the chain goes along the segment, for s from 0 to 1, and what rounding may add to the values that
/// it is at.
typedef struct step_speed {
    double turn, slide; ///< radians, lengths
    double turn_slack, slide_slack;
} step_speed;

/// The chains of two items: how many moving steps of each are below the lowest frame that is above both, and that frame
/// (NONE: the world).
typedef struct pair_chain {
    uint32_t count_a, count_b, frame;
} pair_chain;

/// The moving steps from an item up to the world, and the bounds of its motion in an interval by the first ones.
typedef struct item_link {
    uint32_t step;
    double moved;   ///< no point comes farther from where it is in the middle, by this step and those before it
    double curved;  ///< no point's second derivative by s of the segment is longer, by the same steps
    double rounded; ///< no point is farther from the exact path's state, by the rounding of the state that is looked at
} item_link;

/// The memory of a path's search and check. Arrays in one block.
typedef struct path_work {
    const ovoid_robot_cell *cell;
    ovoid_allocator allocator;
    void *step_block, *block;
    chain_step *steps; ///< of all frames that items have
    uint32_t *joints;  ///< of each step: its joint; NONE: fixed
    uint32_t step_count;
    uint32_t *first;   ///< of each item: its links; one more at the end
    item_link *links;  ///< of all items
    pair_chain *pairs; ///< of each pair of items
    vec3 *axes;        ///< of each step that turns, in the child's frame
    step_speed *speeds;
    double *values, *other_values; ///< of the joints, padded to a multiple of 8
    double *cosines, *sines;
    uint32_t padded;
    double *state; ///< variables
    frame_error *frame_errors;
    double *errors;       ///< of each item
    sphere_place *places; ///< of each item, in the middle of the interval
    double level;         ///< the magnitude that the errors are of; below zero: none
} path_work;

/// Memory for a cell; MEMORY with *error filled.
ovoid_code path_work_create(path_work *w, const ovoid_robot_cell *cell, const ovoid_allocator *allocator,
                            ovoid_error *error);
void path_work_destroy(path_work *w);
/// The step that makes each frame; NONE for the root's.
void path_work_find_makers(const path_work *w, uint32_t *maker);

/// The segment from q0 to q1: speeds and errors. The codes of a refused state, and ARGUMENT: a floating joint moves.
ovoid_code path_set_segment(path_work *w, const double *q0, const double *q1, double limit_slack, ovoid_error *error);

/// Errors of that level, as of a segment with larger numbers.
void path_set_level(path_work *w, double level);

/// The places of everything at one t: all frames, the axes of the steps that turn along the segment, a box around each
/// item.
typedef struct path_state {
    link_frame *frames;
    vec3 *axes;
    oriented_box *boxes;
} path_state;
/// Bytes of one, and one in memory of so many.
size_t path_get_state_size(const ovoid_robot_cell *cell);
path_state path_place_state(const ovoid_robot_cell *cell, void *memory);
/// The state at t of the segment, 0 to 1; its frames alone, to which the boxes of single items may be added.
void path_compute_state(path_work *w, const double *q0, const double *q1, double t, const path_state *at);
void path_compute_frames(path_work *w, const double *q0, const double *q1, double t, const path_state *at);
void path_place_item(const path_work *w, const path_state *at, uint32_t which);

/// Places and motions of all items for the interval of half width `half` around the frames' t, and of one item. The
/// first order holds joint by joint, so for t = 1/2 and half = 1/2 it is that of the whole box between the two states.
void path_set_interval(path_work *w, const path_state *middle, double half);
void path_set_item(path_work *w, const path_state *middle, uint32_t which, double half);

/// How far a pair's bodies move against each other in the interval, as item_link has it of one.
typedef struct path_motion {
    double moved, curved, rounded;
} path_motion;
path_motion path_get_motion(const path_work *w, const pair_parts *of);

/// A pair of the cell at some frames. Numbers: item * parts + part, then the pairs of items.
typedef struct path_pair {
    ovoid_pair pair;
    solid_sides solids;
    const ovoid_robot_side *a, *b;
    double error, padding, apart; ///< apart: of two items, how far their points are from their frames' origins
    path_motion motion;
    uint32_t frame; ///< in which normals are given; NONE: the world
} path_pair;
path_pair path_make_pair(const path_work *w, uint32_t number, const link_frame *frames);

/// A direction of the world in the frame of the pair's normals.
vec3 path_turn_back(const path_pair *p, const link_frame *frames, vec3 world);

/// A lower bound of the pair's signed distance at the frames that it was made for, along the exact direction that has
/// the normal in its frame; padding and errors counted.
double path_measure(const path_work *w, const path_pair *p, const link_frame *frames, vec3 normal);

/// The bodies' distance or depth at their poses, of solids theirs, not their hulls'. outward: the pair's error and
/// padding.
ovoid_answer path_ask_exactly(const path_pair *p, const checker_pair *outward);

/// A place of a path by its segment and t in it, 0 to 1: between two states that of their segment, at a state the end
/// of the one before, which is no refused one where the path came that far.
typedef struct path_place {
    size_t segment;
    const double *q0, *q1;
    double t;
} path_place;
path_place path_find_place(const ovoid_robot_cell *cell, const ovoid_robot_path *path, double s);
/// The pair at a place, as an answer tells a hit and as its check asks for it again: from the state there, the rounding
/// of the exact path's state and the bodies alone, so that both get the same bits. The segment is that which was set.
ovoid_robot_answer path_ask_hit(path_work *w, const path_place *place, uint32_t number, const path_state *memory);
/// The number of a pair by its sides; NONE: there is none.
uint32_t path_find_number(const ovoid_robot_cell *cell, const ovoid_robot_side *a, const ovoid_robot_side *b);
/// 1 where SOLID holds: the bodies at the frames are proven farther apart than the margin and their motion.
int path_is_solid_far(const path_pair *p, double margin);

/// 1 where OUTER, MIDDLE or ENDS hold for the interval that was set.
unsigned path_find_far_parts(const path_work *w, uint32_t item, uint32_t group, double margin);
int path_is_far_pair(const path_work *w, uint32_t pair, double margin);
/// path_is_far_pair by the boxes of the bodies, which are closer to them than spheres.
int path_is_far_by_boxes(const path_work *w, uint32_t number, const path_state *at, double margin);

/// An interval of the segment, and the states at its beginning, end and middle.
typedef struct path_span {
    double begin, end;
    const path_state *at_begin, *at_end, *middle;
} path_span;
/// What boxes say of a pair: far in the middle; or along *normal, the axis that parts them best there, ENDS holds.
typedef enum path_boxes { PATH_BOXES_OPEN, PATH_BOXES_FAR, PATH_BOXES_PART } path_boxes;
path_boxes path_test_boxes(const path_work *w, uint32_t number, const path_span *span, double margin, vec3 *normal);
/// A distance that the pair is not farther apart than, nearly: of the spheres' centres.
double path_get_center_distance(const path_work *w, const pair_parts *of);
static inline int path_is_above(double gap, double margin, double by) { return gap > (margin + by) * (1 + 0x1p-50); }

/// 1 where a gap that is above `begin` and `end` at the ends of an interval of that width stays above the margin: it
/// lies above its chord less curved width^2 s (1 - s) / 2, for s from 0 to 1 over the interval.
static inline int path_is_free_between(double begin, double end, double margin, double curved, double width) {
    double k = 0.5 * curved * width * width * (1 + 0x1p-40), rise = end - begin, least = begin < end ? begin : end;
    if (fabs(rise) < k) {
        double by = k - rise;
        least = begin - by * by / (4 * k);
    }
    return least - 0x1p-45 * (fabs(begin) + fabs(end) + k) > margin;
}

/// A search for any state of the segment that was set that hits.
typedef struct path_any_hit {
    path_work *w;
    ovoid_robot_checker *checker;
    const ovoid_robot_query_options *options;
    const double *q0, *q1;
    path_state state; ///< memory
} path_any_hit;
/// 1 where the state at t hits; *hit says what, as path_ask_hit has it.
int path_is_any_hit_at(const path_any_hit *search, double t, ovoid_robot_answer *hit);
/// The time of a hit, 0 to 1, or infinity: none was found. *states grows by the states looked at.
double path_find_any_hit(const path_any_hit *search, uint32_t *states, ovoid_robot_answer *hit);

/// 1 where one of two bodies is a solid.
static inline int path_has_solid(const path_work *w, const pair_parts *of) {
    const cell_item *items = cell_items(w->cell);
    return items[of->item].solid ||
           (of->part != OVOID_ROBOT_NONE ? cell_parts(w->cell)[of->part].solid : items[of->other].solid);
}

/// 1 where no step of the chain moves along the segment.
int path_is_still(const path_work *w);

/// 1 where a part, or a pair of items, is queried.
static inline int path_is_queried(const path_work *w, uint32_t item, uint32_t part) {
    return !cell_is_allowed(w->cell, &cell_items(w->cell)[item].side, &cell_parts(w->cell)[part].side);
}

#endif
