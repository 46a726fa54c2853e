// States in the middles of lanes that hit: by balls that lie inside the bodies, else by an exact query.
//
// Where a ball inside one body meets a ball or a region inside the other one, the bodies overlap, and as deep as the
// ball can be made smaller and still meet it. No point of a body is farther from where the exact path has it in the
// middle of a lane than the constant part of its rest. A hit that is shown so has a wide bracket, as nothing is
// measured; what a measurement leaves open is added to it, so that it holds the bracket that a check measures.
#include "robot/path/cover.h"

#include "base/compiler.h"

#define UP (1 + 0x1p-40)
// More than the width of a measured depth without allowances, in parts of the lengths of a pair: 1e-9 of these.
#define MEASURED 0x1p-26
// In how many lanes of a pair balls are placed: more of them find few hits that an exact query would not.
enum { TRIES = 3 };

// A pair in the middle of a lane.
typedef struct hit_pair {
    uint32_t number;
    pair_parts of;
    unsigned lane;
    link_frame at_a, at_b; ///< of the items' own frames; b: where the pair is one of two items
    double error;          ///< by how much all of this may move the bodies against each other
} hit_pair;

static const cell_item *get_item(const path_cover *c, uint32_t which) { return &cell_items(c->w->cell)[which]; }
static int is_of_part(const hit_pair *p) { return p->of.part != OVOID_ROBOT_NONE; }

static link_frame find_frame(const path_cover *c, uint32_t item, unsigned lane) {
    ovoid_pose pose = cover_get_pose(c, item, lane);
    link_frame f = {pose.position, pose.rotation, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
    f.matrix = get_item(c, item)->frame == c->items[item].link ? cover_get_rotation(c, item, lane)
                                                               : quat_to_mat3(pose.rotation);
    return f;
}

static hit_pair make_pair(const path_cover *c, uint32_t number, unsigned lane) {
    hit_pair p = {.number = number, .of = pair_take_apart(c->w->cell, number), .lane = lane};
    p.at_a = find_frame(c, p.of.item, lane);
    p.error = c->items[p.of.item].rest.constant * UP;
    if (is_of_part(&p)) return p;
    p.at_b = find_frame(c, p.of.other, lane);
    p.error = (p.error + c->items[p.of.other].rest.constant) * UP;
    return p;
}

static void place_balls(const path_cover *c, const cell_item *item, const link_frame *at, inner_balls *world) {
    const double position[3] = {at->position.x, at->position.y, at->position.z};
    c->kernels->place_balls(&at->matrix, position, &item->inside->balls, world);
}

// ---- what is inside both bodies

static double find_part_depth(const path_cover *c, const hit_pair *p) {
    const cell_item *a = get_item(c, p->of.item);
    const cell_part *part = &cell_parts(c->w->cell)[p->of.part];
    // Too little is known of a body that may be smaller than its shape.
    if (!(part->shape->upper_radius >= 0)) return 0;
    double size = a->inside->size + vec3_sum_abs(p->at_a.position) + part->inside_size;
    inner_balls world;
    place_balls(c, a, &p->at_a, &world);
    return placed_balls_find_region_depth(c->kernels, (placed_balls){a->inside, &world}, &part->inside,
                                          part->shape->upper_radius - CELL_SLACK * size * part->inside.condition);
}

static double find_items_depth(const path_cover *c, const hit_pair *p) {
    const cell_item *a = get_item(c, p->of.item), *b = get_item(c, p->of.other);
    const inner_region around = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                 vec3_add(p->at_b.position, mat3_mul_vec3(p->at_b.matrix, b->inside->outer.one.center)),
                                 {0, 0, 0},
                                 1,
                                 b->inside->outer.one.radius,
                                 1};
    inner_balls world[2];
    place_balls(c, a, &p->at_a, &world[0]);
    place_balls(c, b, &p->at_b, &world[1]);
    return placed_balls_find_depth(c->kernels, (placed_balls){a->inside, &world[0]}, &around,
                                   (placed_balls){b->inside, &world[1]});
}

// ---- the answer

// The lengths of a pair, which a measurement's width is in parts of.
static double find_size(const cell_item *a, const ovoid_shape *b, vec3 apart) {
    return (a->shape->span + a->shape->lower_radius) + (b->span + b->lower_radius) + vec3_sum_abs(apart);
}

// The segment of a lane hits in its middle; its lanes are of no interest then.
static void take_hit(path_cover *c, unsigned lane, const ovoid_robot_answer *hit) {
    uint8_t which = c->current->segment[lane];
    c->segments[which].hit = *hit;
    c->segments[which].hit_at = c->middle[lane];
    for (unsigned k = 0; k < COVER8; k++)
        if (c->current->segment[k] == which) c->wanted &= ~(1u << k);
}

// The hit of a pair that is so deep: 0 where a check might not find it within the margin, or cannot be foreseen.
static int take_depth(path_cover *c, const hit_pair *p, double depth) {
    const cell_item *a = get_item(c, p->of.item);
    const cell_part *part = is_of_part(p) ? &cell_parts(c->w->cell)[p->of.part] : NULL;
    const cell_item *b = part ? NULL : get_item(c, p->of.other);
    const ovoid_shape *shape = part ? part->shape : b->shape;
    const checker_pair known = {.error = p->error, .padding = part ? c->w->cell->padding[a->side.link] : 0};
    oriented_box boxes[2] = {item_place_box(a, &p->at_a, 0), part ? part->box : item_place_box(b, &p->at_b, 0)};
    double size = find_size(a, shape, vec3_sub(part ? part->pose.position : p->at_b.position, p->at_a.position));
    double open = (shape_get_width(a->shape) + shape_get_width(shape) + 4 * p->error + MEASURED * size) * UP;
    double upper = upper_outward(&known, -depth) + open;
    if (path_has_solid(c->w, &p->of) || !(upper <= c->query.margin)) return 0;
    double lower = lower_outward(&known, oriented_boxes_compute_lower(&boxes[0], &boxes[1])) - open;
    take_hit(
        c, p->lane,
        &(ovoid_robot_answer){
            .status = OVOID_ROBOT_HIT, .a = a->side, .b = part ? part->side : b->side, .lower = lower, .upper = upper});
    return 1;
}

// As a check of the answer measures it, with the work set to the lane's segment.
static int measure(path_cover *c, uint32_t number, unsigned lane) {
    uint32_t which = c->current->segment[lane];
    const cover_segment *of = &c->segments[which];
    // The segment was added, so it is not refused.
    if (c->set_segment != which) (void)path_set_segment(c->w, of->q0, of->q1, INFINITY, NULL);
    c->set_segment = which;
    const path_place place = {0, of->q0, of->q1, c->middle[lane]};
    ovoid_robot_answer hit = path_ask_hit(c->w, &place, number, &c->query.state);
    if (!(hit.upper <= c->query.margin)) return 0;
    take_hit(c, lane, &hit);
    return 1;
}

int cover_take_overlap(path_cover *c, uint32_t number, unsigned lane, double depth) {
    hit_pair p = make_pair(c, number, lane);
    return (depth > 0 && take_depth(c, &p, depth)) || measure(c, number, lane);
}

static int is_hit_inside(path_cover *c, uint32_t number, unsigned lane) {
    hit_pair p = make_pair(c, number, lane);
    double depth = is_of_part(&p) ? find_part_depth(c, &p) : find_items_depth(c, &p);
    return depth > 0 && (take_depth(c, &p, depth) || measure(c, number, lane));
}

// In lanes of an open pair; the lanes of segments that it hits are no longer wanted.
static void look_inside(path_cover *c, const cover_open *open) {
    unsigned lanes = open->lanes & c->wanted;
    for (int tries = 0; lanes && tries < TRIES; tries++) {
        unsigned lane = cover_choose_lane(lanes);
        (void)is_hit_inside(c, open->number, lane);
        lanes &= c->wanted & ~(1u << lane);
    }
}

void cover_find_inner_hit(path_cover *c, const cover_list *list, uint32_t first) {
    for (uint32_t i = first; i < list->count && c->wanted; i++) look_inside(c, &list->items[i]);
}
