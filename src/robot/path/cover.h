// Segments of a path that are proven free by balls around bodies, eight intervals of the segment at a time, without a
// step to verify. What stays open, pairs and intervals, is the search's.
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

/// Eight intervals; of those that repeat others no bit is set.
typedef struct cover_lanes {
    double begin[COVER8], end[COVER8];
    unsigned used;
} cover_lanes;

enum { COVER_LEVELS = 3 };

/// The memory, in one block, and the segment that was set.
typedef struct path_cover {
    path_work *w;
    const robot8_kernels *kernels;
    void *block;
    uint64_t moved; ///< of the cell, that the boxes are for
    cover_item *items;
    double *lengths; ///< of each frame: the steps' offsets from the world to it, summed
    double *levers;  ///< of each moving step above each item: how far its centres are from the axis, slides aside
    double *slides;  ///< of each step: the farthest that it slides in the segment
    double *slacks;  ///< of each step: what rounding may change of its speed, turn and slide
    double *gaps;    ///< of each item that nothing moves: its distance from all obstacles, at least; else below zero
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
    motion_rest *rests;    ///< of each pair, seen from the one of its items with fewer steps below what both hang on
    step_rate *rates;      ///< of each step of the links
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
    frame8 *world;
    rate8 *still;
    // The segment.
    const path_any_hit *hits;
    ovoid_robot_answer hit; ///< of the state that was found to hit
    double hit_at;          ///< or infinity
    const double *q0, *q1;
    const uint8_t *queried; ///< masks of path_search
    uint32_t mask_groups;
    double margin;
    uint32_t blocks;
    // What is left: the pairs, and the interval that holds all in which one is open.
    uint8_t *left;
    int is_open;
    double begin, end;
} path_cover;

/// Memory for the cell of a work; 0: none.
int path_cover_create(path_cover *c, path_work *w);
void path_cover_destroy(path_cover *c);

/// The segment that the work was set to just before, and which pairs are queried, as the masks of a search have them.
typedef struct cover_segment {
    const double *q0, *q1;
    double margin;
    const uint8_t *queried;
    uint8_t *left; ///< receives what is open in the end: masks too
    uint32_t mask_groups;
    size_t mask_count;
    const path_any_hit *hits; ///< asked whether a state is one
} cover_segment;
void path_cover_set_segment(path_cover *c, const cover_segment *segment);

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
/// The rates of all steps, and the bounds of all items and pairs, of the segment.
void cover_set_bounds(path_cover *c);
/// Boxes and gaps made anew where obstacles have moved.
void cover_renew_boxes(path_cover *c);

/// The lanes of the block in which an open pair may meet, by the vertices of its hull along the normal that parted it
/// last; all where there is none.
unsigned cover_test_known(path_cover *c, uint32_t number, unsigned lanes);
/// One exact query of each open pair from `first` on, in the middle of one of its open lanes. Where that state hits,
/// hit_at and hit say so; else the pair has a normal, if the query parted it.
void cover_find_hit(path_cover *c, const cover_list *list, uint32_t first);
/// What is open, as cover_test_known has it, along its normal and those of more exact queries; what stays open stays in
/// the list.
void cover_test_hulls(path_cover *c, cover_list *list);

/// Frames and rates of all links in the lanes.
void cover_open_block(path_cover *c, const cover_lanes *lanes);
/// What the blocks share: lanes' middles and reaches, frames of items.
moving8 cover_get_link(const path_cover *c, uint32_t item);
void cover_compute_reach(const path_cover *c, const motion_rest *rest, double more, double reach[COVER8]);
double cover_get_margin(const path_cover *c, uint32_t item);

/// Looks at eight intervals of the segment. The lanes in which pairs are open: bit k that from k/8 to (k+1)/8.
unsigned path_cover_look(path_cover *c);
/// Divides open lanes and looks again, some times. 1: all is proven; else `left`, `begin` and `end` say what is open.
int path_cover_refine(path_cover *c, unsigned open);

#endif
