// A segment in blocks of eight intervals: the links' frames and rates in the middles, then all queried pairs.
//
// Within an interval, time t from -1 to 1, the centre of a ball is at x + v t + a t^2 / 2, but for its rest; so at
// x + a/4 + v t + u a/4 for some u from -1 to 1. An obstacle's box is far where the box around these points is, in the
// box' axes, by more than the radius and the rest. Two bodies of the robot are seen from one of them: a ball of the
// other is far from a ball of it along some direction, or from the slabs around it along one of theirs or as a box.
// First one ball a body, then, of what that leaves, up to eight.
#include "robot/path/cover.h"

#include "base/compiler.h"

#include <string.h>

// How many blocks a segment is given at most, and how many open lanes one holds after its first.
enum { BLOCKS_MOST = 5, OPEN_MOST = 4, ALL_LANES = (1 << COVER8) - 1 };

// ---- a block's motions

static void compute_values(const path_cover *c, const double middle[COVER8]) {
    const ovoid_robot *r = c->w->cell->robot;
    for (uint32_t i = 0; i < r->value_count; i++) {
        const value_source *from = &r->sources[i];
        double q0 = c->q0[from->variable], change = c->q1[from->variable] - q0;
        for (int k = 0; k < COVER8; k++) c->values8[i][k] = from->factor * (q0 + middle[k] * change) + from->offset;
    }
    // Floating joints do not turn in a segment; their quaternions are those that the work was set with.
    for (uint32_t i = 0; i < 4 * r->free_count; i++) {
        uint32_t value = r->free_values[i / 4] + i % 4;
        for (int k = 0; k < COVER8; k++) c->values8[value][k] = c->w->values[value];
    }
}

void cover_open_block(path_cover *c, const cover_lanes *lanes) {
    const ovoid_robot_cell *cell = c->w->cell;
    for (int k = 0; k < COVER8; k++) {
        c->middle[k] = 0.5 * (lanes->begin[k] + lanes->end[k]);
        c->half[k] = 0.5 * (lanes->end[k] - lanes->begin[k]);
    }
    compute_values(c, c->middle);
    c->kernels->chain(cell->steps.items, (uint32_t)cell->steps.count, (const double(*)[ROBOT8])c->values8, c->frames8);
    const rate_chain chain = {cell->steps.items, c->rates, c->frames8, (uint32_t)cell->steps.count};
    c->kernels->rates(&chain, c->half, c->rates8);
    memset(c->have_one, 0, cell->items.count);
    memset(c->have_balls, 0, cell->items.count);
    c->blocks++;
}

moving8 cover_get_link(const path_cover *c, uint32_t item) {
    uint32_t link = c->items[item].link;
    return (moving8){&c->frames8[link], &c->rates8[link]};
}

static void move_ball(path_cover *c, uint32_t item, const outer_ball *ball, motion8 *to) {
    moving8 link = cover_get_link(c, item);
    const double center[3] = {ball->center.x, ball->center.y, ball->center.z};
    c->kernels->move(&link, center, to);
}

// What a rest makes of each lane's interval, and a length more.
void cover_compute_reach(const path_cover *c, const motion_rest *rest, double more, double reach[COVER8]) {
    for (int k = 0; k < COVER8; k++) {
        double h = c->half[k];
        double left = rest->constant + h * (rest->first + h * (rest->second + h * rest->third));
        double all = (more + left) * (1 + 0x1p-40);
        // Where errors have no bound nothing is far.
        reach[k] = all < INFINITY ? all : INFINITY;
    }
}

static void add_radius(const double reach[COVER8], double radius, double all[COVER8]) {
    for (int k = 0; k < COVER8; k++) all[k] = (reach[k] + radius) * (1 + 0x1p-50);
}

static const motion8 *get_one(path_cover *c, uint32_t item) {
    if (c->have_one[item]) return &c->ones[item];
    c->have_one[item] = 1;
    move_ball(c, item, &c->items[item].one, &c->ones[item]);
    cover_compute_reach(c, &c->items[item].rest, c->items[item].one.radius, c->reaches[item]);
    return &c->ones[item];
}

static const motion8 *get_balls(path_cover *c, uint32_t item) {
    motion8 *to = c->balls + (size_t)item * OUTER_BALLS;
    for (uint32_t i = 0; !c->have_balls[item] && i < c->items[item].count; i++)
        move_ball(c, item, &c->items[item].balls[i], &to[i]);
    c->have_balls[item] = 1;
    return to;
}

static void add_open(cover_list *to, uint32_t number, unsigned lanes) {
    if (lanes) to->items[to->count++] = (cover_open){number, (uint8_t)lanes};
}

// ---- obstacles

double cover_get_margin(const path_cover *c, uint32_t item) {
    return c->margin + c->w->cell->padding[cell_items(c->w->cell)[item].side.link];
}

// The boxes that are gathered in `some`, of one group, against all balls of an item: what is open goes to the list.
static void test_some(path_cover *c, uint32_t item, uint32_t group, uint32_t count, cover_list *to) {
    const cover_item *it = &c->items[item];
    const cover_boxes boxes = {c->groups[group].rotation, c->some, count};
    const motion8 *balls = get_balls(c, item);
    double reach[COVER8], all[COVER8];
    cover_compute_reach(c, &it->rest, cover_get_margin(c, item), reach);
    memset(c->some_left, 0, count);
    for (uint32_t i = 0; i < it->count; i++) {
        add_radius(reach, it->balls[i].radius, all);
        c->kernels->near_moving(&boxes, &balls[i], all, c->near);
        for (uint32_t k = 0; k < count; k++) c->some_left[k] |= c->near[k] & c->some_lanes[k];
    }
    for (uint32_t k = 0; k < count; k++) add_open(to, c->some_numbers[k], c->some_left[k]);
}

static void gather(path_cover *c, uint32_t *count, const cover_open *open, uint32_t box) {
    c->some[*count] = c->boxes[box];
    c->some_numbers[*count] = open->number;
    c->some_lanes[(*count)++] = open->lanes;
}

// The boxes that an item may come near in any lane: a ball around all that its one ball sweeps.
static unsigned find_near_boxes(const path_cover *c, uint32_t item, uint32_t boxes, const double sphere[4]) {
    unsigned near = c->kernels->near_boxes(&cell_boxes(c->w->cell)[boxes], sphere, sphere[3]);
    return near & c->queried[(size_t)item * c->mask_groups + boxes];
}

static void find_sphere(path_cover *c, uint32_t item, double sphere[4]) {
    double low[3], high[3], square = 0, reach = 0, size = 0;
    c->kernels->enclose(get_one(c, item), low, high);
    for (int k = 0; k < COVER8; k++) reach = max2(reach, c->reaches[item][k]);
    for (int k = 0; k < 3; k++) {
        double half = 0.5 * (high[k] - low[k]);
        sphere[k] = 0.5 * (low[k] + high[k]);
        square += half * half;
        size += fabs(sphere[k]);
    }
    sphere[3] = ((sqrt(square) + reach) + cover_get_margin(c, item) + CELL_SLACK * size) * (1 + 0x1p-40);
}

// An item against boxes of a group that are gathered, by one ball; those that it leaves are gathered anew.
static uint32_t keep_near(path_cover *c, uint32_t item, uint32_t group, uint32_t count, const double reach[COVER8]) {
    const cover_boxes boxes = {c->groups[group].rotation, c->some, count};
    uint32_t kept = 0;
    c->kernels->near_moving(&boxes, get_one(c, item), reach, c->near);
    for (uint32_t i = 0; i < count; i++) {
        if (!c->near[i]) continue;
        c->some[kept] = c->some[i];
        c->some_numbers[kept] = c->some_numbers[i];
        c->some_lanes[kept++] = c->near[i];
    }
    return kept;
}

static void test_group(path_cover *c, uint32_t item, uint32_t group, const double reach[COVER8], cover_list *to) {
    const ovoid_robot_cell *cell = c->w->cell;
    uint32_t count = 0;
    for (uint32_t k = 0; k < cell->boxes.count; k++)
        for (unsigned near = c->swept[k]; near; near &= near - 1) {
            uint32_t part = k * ROBOT8 + compiler_count_low_zeros(near);
            const cover_open open = {(uint32_t)(item * cell->parts.count + part), ALL_LANES};
            if (c->group_of[part] == group) gather(c, &count, &open, c->box_of[part]);
        }
    if (count) count = keep_near(c, item, group, count, reach);
    if (count) test_some(c, item, group, count, to);
}

static void test_item(path_cover *c, uint32_t item, cover_list *to) {
    unsigned any = 0;
    double sphere[4], reach[COVER8];
    if (c->mask_groups == 0) return;
    find_sphere(c, item, sphere);
    for (uint32_t k = 0; k < c->mask_groups; k++) any |= c->swept[k] = (uint8_t)find_near_boxes(c, item, k, sphere);
    if (!any) return;
    add_radius(c->reaches[item], cover_get_margin(c, item), reach);
    for (uint32_t group = 0; group < c->group_count; group++) test_group(c, item, group, reach, to);
}

// Items that are far from the base first: those are what hits.
static void test_items(path_cover *c, cover_list *to) {
    for (uint32_t item = (uint32_t)c->w->cell->items.count; item-- > 0 && !(c->hit_at < INFINITY);) {
        if (c->gaps[item] > cover_get_margin(c, item) * (1 + 0x1p-40)) continue;
        uint32_t before = to->count;
        test_item(c, item, to);
        cover_find_hit(c, to, before);
    }
}

// ---- pairs of items

// A pair's first item is the one that the second is seen from.
static item_pair get_pair(const path_cover *c, uint32_t pair, int is_from_b) {
    item_pair both = cell_pairs(c->w->cell)[pair];
    return is_from_b ? (item_pair){both.b, both.a} : both;
}

// The lanes in which a ball of the second item may meet the slabs of the first.
static unsigned find_near_slabs(path_cover *c, item_pair both, const motion_rest *rest, unsigned lanes) {
    const cover_item *to = &c->items[both.b];
    const motion8 *balls = get_balls(c, both.b);
    moving8 body = cover_get_link(c, both.a);
    double reach[COVER8], all[COVER8];
    cover_compute_reach(c, rest, c->margin, reach);
    unsigned near = 0;
    for (uint32_t i = 0; i < to->count && (near & lanes) != lanes; i++) {
        add_radius(reach, to->balls[i].radius, all);
        near |= c->kernels->near_slabs(&balls[i], &body, &c->items[both.a].slabs, all);
    }
    return near & lanes;
}

// By the balls around both, in the world; then seen from the first item.
static unsigned find_near_ones(path_cover *c, uint32_t pair) {
    item_pair both = get_pair(c, pair, cover_is_from_b(c, pair));
    const motion8 *a = get_one(c, both.a), *b = get_one(c, both.b);
    double reach[COVER8], all[COVER8];
    for (int k = 0; k < COVER8; k++)
        all[k] = ((c->reaches[both.a][k] + c->reaches[both.b][k]) + c->margin) * (1 + 0x1p-50);
    unsigned near = c->kernels->near_points(a, b, all);
    if (!near) return 0;
    cover_compute_reach(c, cover_get_rest(c, pair), c->margin, reach);
    add_radius(reach, c->items[both.a].one.radius + c->items[both.b].one.radius, all);
    moving8 body = cover_get_link(c, both.a);
    return near & c->kernels->near_point(b, a, &body, all);
}

// By what parted the pair last, by balls and slabs, by hulls.
static unsigned test_pair(path_cover *c, uint32_t pair, unsigned lanes) {
    int is_from_b = cover_is_from_b(c, pair);
    uint32_t number = (uint32_t)(c->w->cell->items.count * c->w->cell->parts.count) + pair;
    unsigned open = cover_test_known(c, number, lanes);
    if (open) open = find_near_slabs(c, get_pair(c, pair, is_from_b), cover_get_rest(c, pair), open);
    return open;
}

static void test_pairs(path_cover *c, cover_list *to) {
    const ovoid_robot_cell *cell = c->w->cell;
    const uint8_t *masks = c->queried + cell->items.count * c->mask_groups;
    uint32_t first = (uint32_t)(cell->items.count * cell->parts.count);
    for (uint32_t i = 0; i < cell->pairs.count && !(c->hit_at < INFINITY); i++) {
        if (!(masks[i / ROBOT8] >> i % ROBOT8 & 1)) continue;
        unsigned near = find_near_ones(c, i);
        uint32_t before = to->count;
        if (near) add_open(to, first + i, test_pair(c, i, near));
        cover_find_hit(c, to, before);
    }
}

// ---- what is open

unsigned path_cover_look(path_cover *c) {
    cover_lanes *lanes = &c->lanes[0];
    for (int k = 0; k < COVER8; k++) lanes->begin[k] = k * (1.0 / COVER8), lanes->end[k] = (k + 1) * (1.0 / COVER8);
    cover_open_block(c, lanes);
    cover_list *to = &c->lists[0];
    to->count = 0;
    test_items(c, to);
    if (!(c->hit_at < INFINITY)) test_pairs(c, to);
    cover_test_hulls(c, to);
    unsigned open = 0;
    for (uint32_t i = 0; i < to->count; i++) open |= to->items[i].lanes;
    return open;
}

// What was open in an earlier block, in the lanes of this one.
static void test_open(path_cover *c, const cover_list *from, cover_list *to) {
    uint32_t parts = (uint32_t)c->w->cell->parts.count, first = (uint32_t)c->w->cell->items.count * parts;
    to->count = 0;
    for (uint32_t i = 0; i < from->count;) {
        const cover_open *open = &from->items[i];
        if (open->number >= first) {
            add_open(to, open->number, test_pair(c, open->number - first, open->lanes));
            i++;
            continue;
        }
        uint32_t item = open->number / parts, group = c->group_of[open->number % parts], count = 0;
        for (; i < from->count && from->items[i].number < first; i++) {
            uint32_t number = from->items[i].number;
            if (number / parts != item || c->group_of[number % parts] != group) break;
            gather(c, &count, &from->items[i], c->box_of[number % parts]);
        }
        test_some(c, item, group, count, to);
    }
}

// What is open is so in the end: the search's.
static void leave(path_cover *c, const cover_list *open, const cover_lanes *lanes, unsigned mask) {
    uint32_t parts = (uint32_t)c->w->cell->parts.count, items = (uint32_t)c->w->cell->items.count;
    for (uint32_t i = 0; i < open->count; i++) {
        if (!(open->items[i].lanes & mask)) continue;
        uint32_t number = open->items[i].number, first = items * parts;
        uint32_t at = number < first ? number / parts * c->mask_groups * ROBOT8 + number % parts
                                     : items * c->mask_groups * ROBOT8 + (number - first);
        c->left[at / ROBOT8] |= (uint8_t)(1u << at % ROBOT8);
        c->is_open = 1;
    }
    for (; mask; mask &= mask - 1) {
        unsigned k = compiler_count_low_zeros(mask);
        c->begin = min2(c->begin, lanes->begin[k]);
        c->end = max2(c->end, lanes->end[k]);
    }
}

// Each lane of the mask in as many equal parts as there is room for; of[k]: the lane that lane k is a part of.
static void divide(const cover_lanes *from, unsigned mask, cover_lanes *to, unsigned of[COVER8]) {
    unsigned open = 0, lanes[OPEN_MOST], at = 0;
    for (; mask; mask &= mask - 1) lanes[open++] = compiler_count_low_zeros(mask);
    unsigned parts = open == 1 ? 8 : open == 2 ? 4 : 2;
    for (unsigned k = 0; k < open; k++) {
        double begin = from->begin[lanes[k]], width = (from->end[lanes[k]] - begin) / parts;
        for (unsigned i = 0; i < parts; i++, at++) {
            to->begin[at] = begin + i * width, to->end[at] = begin + (i + 1) * width;
            of[at] = lanes[k];
        }
    }
    to->used = (1u << at) - 1;
    for (; at < COVER8; at++) to->begin[at] = to->begin[0], to->end[at] = to->end[0], of[at] = of[0];
}

// The open pairs of those lanes, in the parts of these.
static void carry_over(const cover_list *from, const cover_lanes *lanes, const unsigned of[COVER8], cover_list *to) {
    to->count = 0;
    for (uint32_t i = 0; i < from->count; i++) {
        unsigned open = 0;
        for (unsigned k = 0; k < COVER8; k++) open |= (lanes->used >> k & from->items[i].lanes >> of[k] & 1u) << k;
        add_open(to, from->items[i].number, open);
    }
}

// A block of parts of the open lanes of the level before, at most OPEN_MOST of them.
static void look_closer(path_cover *c, uint32_t level, unsigned mask) {
    const cover_list *from = &c->lists[level];
    if (level + 1 == COVER_LEVELS || c->blocks == BLOCKS_MOST) {
        leave(c, from, &c->lanes[level], mask);
        return;
    }
    cover_lanes *lanes = &c->lanes[level + 1];
    unsigned of[COVER8] = {0}, open = 0;
    divide(&c->lanes[level], mask, lanes, of);
    carry_over(from, lanes, of, &c->carried);
    cover_open_block(c, lanes);
    cover_list *to = &c->lists[level + 1];
    test_open(c, &c->carried, to);
    cover_find_hit(c, to, 0);
    cover_test_hulls(c, to);
    for (uint32_t i = 0; i < to->count; i++) open |= to->items[i].lanes;
    while (open && !(c->hit_at < INFINITY)) {
        unsigned some = 0;
        for (int i = 0; i < OPEN_MOST && open; i++, open &= open - 1) some |= open & (~open + 1);
        look_closer(c, level + 1, some);
    }
}

int path_cover_refine(path_cover *c, unsigned open) {
    c->is_open = 0;
    c->begin = 1, c->end = 0;
    while (open && !(c->hit_at < INFINITY)) {
        unsigned some = 0;
        for (int i = 0; i < OPEN_MOST && open; i++, open &= open - 1) some |= open & (~open + 1);
        look_closer(c, 0, some);
    }
    return !c->is_open;
}

void path_cover_set_segment(path_cover *c, const cover_segment *segment) {
    c->q0 = segment->q0, c->q1 = segment->q1;
    c->margin = segment->margin;
    c->queried = segment->queried, c->mask_groups = segment->mask_groups;
    c->left = segment->left;
    memset(c->left, 0, segment->mask_count);
    c->blocks = 0;
    c->hits = segment->hits;
    c->hit_at = INFINITY;
    cover_set_bounds(c);
    cover_renew_boxes(c);
    // Frames that moved along an earlier segment may be still along this one.
    for (uint32_t i = 0; i < c->w->cell->steps.count; i++)
        if (!c->rates[i].is_moving)
            memset(&c->rates8[((const chain_step *)c->w->cell->steps.items)[i].child], 0, sizeof *c->rates8);
}
