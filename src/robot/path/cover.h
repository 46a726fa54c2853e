// Segments of paths, some at a time, that are proven free by balls around bodies, eight intervals side by side, without
// a step to verify. What stays open, pairs and intervals, is the search's.
#ifndef OVOID_ROBOT_PATH_COVER_H
#define OVOID_ROBOT_PATH_COVER_H

#include "robot/path/motion.h"

/// By how much a ball's centre may leave its second order over an interval of half width h, rounding of all that is
/// computed of it included: constant + first h + second h^2 + third h^3.
typedef struct motion_rest {
    double constant, first, second, third;
    double turn; ///< the sum of the speeds of the joints that turn it
} motion_rest;

/// What the bounds of an item's motion are made of, for s from 0 to 1.
typedef struct motion_size {
    double turn, slide;             ///< sums of the speeds
    double turn_slack, slide_slack; ///< of what rounding may change of these
    double rotation, position;      ///< what frame and centre may be off by
    double distance;                ///< of the centre from the world's origin
} motion_size;

/// Sums over the steps from the world down to a frame.
typedef struct motion_sums {
    double turn, slide;             ///< of the speeds
    double turn_slack, slide_slack; ///< of what rounding may change of these
    double state_turn, state_slide; ///< of what rounding may change of the state that is looked at
    double far;                     ///< of the farthest that each slides in the segment
} motion_sums;

/// What a step adds to the third derivative's bound of a point: for each unit of its lever, where it turns; where it
/// slides. And the slides from the world down to it, its own one with them.
typedef struct step_share {
    double turn, slide, slides;
} step_share;

/// Balls and slabs of an item in its link's frame.
typedef struct cover_item {
    outer_ball one, balls[OUTER_BALLS];
    body_slabs slabs;
    double far;             ///< no centre is farther from the link's origin
    double hull;            ///< what the body stands out of its vertices, rounding of these counted
    const double *vertices; ///< xyz, in the link's frame, by clusters
    uint32_t vertex_count;
    vertex_cluster clusters[OUTER_BALLS]; ///< by the ball whose centre is nearest
    uint32_t count, link;
    motion_size size; ///< of the segment
    motion_rest rest; ///< of the segment, in the world
} cover_item;

/// Boxes of obstacles along the same axes: a range of them.
typedef struct cover_group_boxes {
    mat3 rotation;
    uint32_t first, end;
} cover_group_boxes;

/// A pair that is open in some lanes.
typedef struct cover_open {
    uint32_t number;
    uint8_t lanes;
} cover_open;

/// A direction from the body that a pair is seen from, in its frame, and how far that body reaches along it.
typedef struct cover_normal {
    vec3 along;
    double support;
} cover_normal;

/// A list of these; as many as there are pairs have room.
typedef struct cover_list {
    cover_open *items;
    uint32_t count;
} cover_list;

/// Eight intervals, each of a segment; of those that repeat others no bit is set.
typedef struct cover_lanes {
    double begin[COVER8], end[COVER8];
    uint8_t segment[COVER8];
    unsigned used;
} cover_lanes;

/// How fast the own values of a step go along a segment.
typedef struct step_rate {
    double length[3], turn;
} step_rate;

/// A segment, and what is known of it in the end.
typedef struct cover_segment {
    const double *q0, *q1;
    step_rate *rates; ///< of each step of the links
    uint32_t parts;   ///< lanes of the first block
    double hit_at;    ///< a state that hits; or infinity
    ovoid_robot_answer hit;
    // What is left: the pairs, as masks of a search, and the interval that holds all in which one is open.
    uint8_t *left;
    int is_open;
    double begin, end;
} cover_segment;

enum { COVER_LEVELS = 3, COVER_SEGMENTS = 4 };

/// Which pairs are queried, as the masks of a search have them; and with what.
typedef struct cover_query {
    const uint8_t *queried;
    uint32_t mask_groups;
    double margin;
    path_state state;          ///< memory for one
    const pair_table **tables; ///< of each pair, NULL where it has none; or NULL
    const ovoid_watch *watch;  ///< asked before each block but the first
    uint32_t generation;       ///< of what a checker remembers: what an earlier one left is forgotten
} cover_query;

/// The memory, in one block, and the segments that were added.
typedef struct path_cover {
    path_work *w;
    const robot8_kernels *kernels;
    void *block;
    uint64_t moved; ///< of the cell, that the boxes are for
    cover_item *items;
    double *lengths;    ///< of each frame: the steps' offsets from the world to it, summed
    double *levers;     ///< of each moving step above each item: how far its centres are from the axis, slides aside
    double *slides;     ///< of each step: the farthest that it slides in the segment
    double *slacks;     ///< of each step: what rounding may change of its speed, turn and slide
    motion_sums *sums;  ///< of each frame
    step_share *shares; ///< of each step
    double *gaps;       ///< of each item that nothing moves: its distance from all obstacles, at least; else below zero
    cover_group_boxes *groups;
    uint32_t group_count;
    cover_box *boxes, *some;     ///< by groups; those of an item that are open
    uint32_t *parts;             ///< of each box
    uint32_t *group_of, *box_of; ///< of each part
    uint32_t *some_numbers;      ///< of each of `some`
    uint8_t *near, *some_lanes, *some_left;
    uint8_t *swept;        ///< bits of parts, that an item may come near
    double *vertices;      ///< of all items
    cover_normal *normals; ///< of each pair: along which an exact query parted it last; zero: none
    ovoid_proof *proofs;   ///< of each pair: hints for its next query
    uint8_t *hit_counts;   ///< of each pair: in how many segments it was found to hit by a query, about
    motion_rest *rests;    ///< of each pair, seen from the one of its items with fewer steps below what both hang on
    step_speed *speeds;    ///< of each step: the largest of the segments'
    step_rate8 *rates;     ///< of each step of the links
    uint8_t *is_moving;    ///< of each frame
    double (*values8)[COVER8];
    frame8 *frames8;
    rate8 *rates8;
    motion8 *ones, *balls;     ///< of each item, of each ball of it
    double (*reaches)[COVER8]; ///< of each item's one ball: its radius, and its rest in the world
    uint8_t *have_rests;
    uint8_t *have_one, *have_balls;
    cover_list lists[COVER_LEVELS], carried;
    cover_lanes lanes[COVER_LEVELS];
    void *state_memory;
    path_state state; ///< of items that nothing moves
    double middle[COVER8], half[COVER8];
    const cover_lanes *current; ///< the lanes that are open
    unsigned wanted;            ///< those of segments of which no hit is known
    frame8 *world;
    rate8 *still;
    cover_query query;
    cover_segment segments[COVER_SEGMENTS];
    size_t mask_count;
    uint32_t segment_count, set_segment; ///< set_segment: that which the work is set to
    uint32_t blocks;
    double level; ///< the largest of the segments'
} path_cover;

/// Memory for the cell of a work; 0: none.
int path_cover_create(path_cover *c, path_work *w);
void path_cover_destroy(path_cover *c);

/// No segment is there.
void path_cover_begin(path_cover *c, const cover_query *query);
/// Adds the segment that the work was set to just before, in so many lanes at first: up to COVER_SEGMENTS, and COVER8
/// lanes in all.
void path_cover_add(path_cover *c, const double *q0, const double *q1, uint32_t parts);
/// Bounds and boxes for all that were added.
void path_cover_set(path_cover *c);
/// Proves what it can: each segment has then a hit, or open pairs, or is free. The work is set to any of them.
void path_cover_prove(path_cover *c);

/// The motion of the second ball of a pair seen from the first item, in the frame of that item's link.
motion_rest cover_find_pair_rest(const path_cover *c, uint32_t pair, int is_from_b);
/// The same for the vertices of a body, from that of its balls' centres; radius: of the ball around all of it.
motion_rest cover_find_hull_rest(const motion_rest *of_centers, double radius);
/// Of a pair seen from the item that pairs are seen from; computed where it is first asked for.
const motion_rest *cover_get_rest(path_cover *c, uint32_t pair);
/// 1 where a pair is seen from its second item.
static inline int cover_is_from_b(const path_cover *c, uint32_t pair) {
    return c->w->pairs[pair].count_b < c->w->pairs[pair].count_a;
}
/// Rates of the segment that the work was set to, and what is the largest of all segments so far.
void cover_add_rates(path_cover *c, cover_segment *segment);
/// The bounds of all items, of all segments.
void cover_set_bounds(path_cover *c);
/// Boxes and gaps made anew where obstacles have moved.
void cover_renew_boxes(path_cover *c);

/// The lanes of the block in which an open pair may meet, by the vertices of its hull along the normal that parted it
/// last; all where there is none.
unsigned cover_test_known(path_cover *c, uint32_t number, unsigned lanes);
/// One exact query of each open pair, in the middle of one of its open lanes. Where that state hits, the lane's segment
/// says so; else the pair has a normal, if the query parted it.
void cover_query_middles(path_cover *c, cover_list *list);
/// Of lanes that are set one in the middle: deepest inside, if the pair meets.
unsigned cover_choose_lane(unsigned lanes);
/// The pose of an item in the middle of a lane, and the rotation of its link.
ovoid_pose cover_get_pose(const path_cover *c, uint32_t item, unsigned lane);
mat3 cover_get_rotation(const path_cover *c, uint32_t item, unsigned lane);
/// Open pairs from `first` on, in the middles of their open lanes: where balls inside the bodies show that one hits,
/// the lane's segment says so.
void cover_find_inner_hit(path_cover *c, const cover_list *list, uint32_t first);
/// A pair whose bodies are so deep in one another in the middle of a lane, or (0) may be. 1: it hits, as the lane's
/// segment says, and as a check of the answer finds it.
int cover_take_overlap(path_cover *c, uint32_t number, unsigned lane, double depth);
/// What is open, as cover_test_known has it, along its normal and those of more exact queries; what stays open stays in
/// the list.
void cover_test_hulls(path_cover *c, cover_list *list);

/// Frames and rates of all links in the lanes.
void cover_open_block(path_cover *c, const cover_lanes *lanes);
/// What the blocks share: lanes' middles and reaches, frames of items.
moving8 cover_get_link(const path_cover *c, uint32_t item);
void cover_compute_reach(const path_cover *c, const motion_rest *rest, double more, double reach[COVER8]);
double cover_get_margin(const path_cover *c, uint32_t item);

/// All queried pairs in the lanes of the block that was opened: what is open goes to the list.
void cover_test_all(path_cover *c, cover_list *to);
/// The pairs of a list in the lanes of the block that was opened.
void cover_test_open(path_cover *c, const cover_list *from, cover_list *to);
/// Adds a pair where it is open in any lane.
void cover_list_add(cover_list *to, uint32_t number, unsigned lanes);

#endif
