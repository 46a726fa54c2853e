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

enum { ALL_LANES = (1 << COVER8) - 1 };

// ---- a block's motions

static void compute_values(const path_cover *c) {
    const ovoid_robot *r = c->w->cell->robot;
    const cover_segment *of[COVER8];
    for (int k = 0; k < COVER8; k++) of[k] = &c->segments[c->current->segment[k]];
    for (uint32_t i = 0; i < r->value_count; i++) {
        const value_source *from = &r->sources[i];
        double q0[COVER8], q1[COVER8];
        for (int k = 0; k < COVER8; k++) q0[k] = of[k]->q0[from->variable], q1[k] = of[k]->q1[from->variable];
        for (int k = 0; k < COVER8; k++)
            c->values8[i][k] = from->factor * (q0[k] + c->middle[k] * (q1[k] - q0[k])) + from->offset;
    }
    // Floating joints do not turn in a segment; their quaternions are those that the work was set with.
    for (uint32_t i = 0; i < 4 * r->free_count; i++) {
        uint32_t value = r->free_values[i / 4] + i % 4;
        for (int k = 0; k < COVER8; k++) c->values8[value][k] = c->w->values[value];
    }
}

static void spread_rates(const path_cover *c) {
    const chain_step *steps = c->w->cell->steps.items;
    for (uint32_t i = 0; i < c->w->cell->steps.count; i++) {
        step_rate8 *to = &c->rates[i];
        if (!to->is_moving || steps[i].kind == STEP_FIXED) continue;
        uint32_t lengths = step_count_lengths(steps[i].kind);
        for (int k = 0; k < COVER8; k++) {
            const step_rate *from = &c->segments[c->current->segment[k]].rates[i];
            for (uint32_t n = 0; n < lengths; n++) to->length[n][k] = from->length[n];
            to->turn[k] = from->turn;
        }
    }
}

// The lanes of segments that have no hit.
static unsigned find_wanted(const path_cover *c, const cover_lanes *lanes) {
    unsigned wanted = lanes->used;
    for (unsigned k = 0; k < COVER8; k++)
        if (c->segments[lanes->segment[k]].hit_at < INFINITY) wanted &= ~(1u << k);
    return wanted;
}

void cover_open_block(path_cover *c, const cover_lanes *lanes) {
    const ovoid_robot_cell *cell = c->w->cell;
    c->current = lanes;
    c->wanted = find_wanted(c, lanes);
    for (int k = 0; k < COVER8; k++) {
        c->middle[k] = 0.5 * (lanes->begin[k] + lanes->end[k]);
        c->half[k] = 0.5 * (lanes->end[k] - lanes->begin[k]);
    }
    compute_values(c);
    // All lanes of one segment go as fast in each block.
    if (c->blocks == 0 || c->segment_count > 1) spread_rates(c);
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

void cover_list_add(cover_list *to, uint32_t number, unsigned lanes) {
    if (lanes) to->items[to->count++] = (cover_open){number, (uint8_t)lanes};
}

// ---- obstacles

double cover_get_margin(const path_cover *c, uint32_t item) {
    return c->query.margin + c->w->cell->padding[cell_items(c->w->cell)[item].side.link];
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
    for (uint32_t k = 0; k < count; k++) cover_list_add(to, c->some_numbers[k], c->some_left[k]);
}

static void gather(path_cover *c, uint32_t *count, const cover_open *open, uint32_t box) {
    c->some[*count] = c->boxes[box];
    c->some_numbers[*count] = open->number;
    c->some_lanes[(*count)++] = open->lanes;
}

// The boxes that an item may come near in any lane: a ball around all that its one ball sweeps.
static unsigned find_near_boxes(const path_cover *c, uint32_t item, uint32_t boxes, const double sphere[4]) {
    unsigned near = c->kernels->near_boxes(&cell_boxes(c->w->cell)[boxes], sphere, sphere[3]);
    return near & c->query.queried[(size_t)item * c->query.mask_groups + boxes];
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
        if (!(c->near[i] & c->wanted)) continue;
        c->some[kept] = c->some[i];
        c->some_numbers[kept] = c->some_numbers[i];
        c->some_lanes[kept++] = (uint8_t)(c->near[i] & c->wanted);
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
    if (c->query.mask_groups == 0) return;
    find_sphere(c, item, sphere);
    for (uint32_t k = 0; k < c->query.mask_groups; k++)
        any |= c->swept[k] = (uint8_t)find_near_boxes(c, item, k, sphere);
    if (!any) return;
    add_radius(c->reaches[item], cover_get_margin(c, item), reach);
    for (uint32_t group = 0; group < c->group_count; group++) test_group(c, item, group, reach, to);
}

// Items that are far from the base first: those are what hits.
static void test_items(path_cover *c, cover_list *to) {
    for (uint32_t item = (uint32_t)c->w->cell->items.count; item-- > 0 && c->wanted;) {
        if (c->gaps[item] > cover_get_margin(c, item) * (1 + 0x1p-40)) continue;
        uint32_t before = to->count;
        test_item(c, item, to);
        cover_find_inner_hit(c, to, before);
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
    cover_compute_reach(c, rest, c->query.margin, reach);
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
        all[k] = ((c->reaches[both.a][k] + c->reaches[both.b][k]) + c->query.margin) * (1 + 0x1p-50);
    unsigned near = c->kernels->near_points(a, b, all) & c->wanted;
    if (!near) return 0;
    cover_compute_reach(c, cover_get_rest(c, pair), c->query.margin, reach);
    add_radius(reach, c->items[both.a].one.radius + c->items[both.b].one.radius, all);
    moving8 body = cover_get_link(c, both.a);
    return near & c->kernels->near_point(b, a, &body, all);
}

// What a variable is at a place of a segment.
static double get_variable(const cover_segment *segment, uint32_t variable, double at) {
    if (variable == OVOID_ROBOT_NONE) return 0;
    return segment->q0[variable] + at * (segment->q1[variable] - segment->q0[variable]);
}

// Does the pair's table show that it stays apart between two places of a segment?
static int is_apart_between(const cover_segment *segment, const pair_table *table, double begin, double end) {
    table_range range;
    for (int k = 0; k < 2; k++) {
        double from = get_variable(segment, table->axes[k].variable, begin),
               to = get_variable(segment, table->axes[k].variable, end);
        range.low[k] = min2(from, to);
        range.high[k] = max2(from, to);
    }
    return pair_table_is_apart(table, &range);
}

// The table of a pair, if it says something of this query: that bodies are apart, by no margin.
static const pair_table *get_table(const path_cover *c, uint32_t pair) {
    return c->query.tables && c->query.margin == 0 ? c->query.tables[pair] : NULL;
}

// 1 if a pair's table shows that it stays apart in all segments.
static int is_apart_everywhere(const path_cover *c, uint32_t pair) {
    const pair_table *table = get_table(c, pair);
    uint32_t apart = 0;
    while (table && apart < c->segment_count && is_apart_between(&c->segments[apart], table, 0, 1)) apart++;
    return table && apart == c->segment_count;
}

// The lanes that a pair's table leaves open.
static unsigned test_table(const path_cover *c, uint32_t pair, unsigned lanes) {
    const pair_table *table = get_table(c, pair);
    unsigned open = lanes;
    for (; table && lanes; lanes &= lanes - 1) {
        unsigned k = compiler_count_low_zeros(lanes);
        const cover_segment *segment = &c->segments[c->current->segment[k]];
        double begin = c->middle[k] - c->half[k], end = c->middle[k] + c->half[k];
        if (is_apart_between(segment, table, begin, end)) open &= ~(1u << k);
    }
    return open;
}

// By its table, by what parted the pair last, by balls and slabs, by hulls.
static unsigned test_pair(path_cover *c, uint32_t pair, unsigned lanes) {
    int is_from_b = cover_is_from_b(c, pair);
    lanes = test_table(c, pair, lanes);
    if (!lanes) return 0;
    uint32_t number = (uint32_t)(c->w->cell->items.count * c->w->cell->parts.count) + pair;
    unsigned open = cover_test_known(c, number, lanes);
    if (open) open = find_near_slabs(c, get_pair(c, pair, is_from_b), cover_get_rest(c, pair), open);
    return open;
}

static void test_pairs(path_cover *c, cover_list *to) {
    const ovoid_robot_cell *cell = c->w->cell;
    const uint8_t *masks = c->query.queried + cell->items.count * c->query.mask_groups;
    uint32_t first = (uint32_t)(cell->items.count * cell->parts.count);
    for (uint32_t i = 0; i < cell->pairs.count && c->wanted; i++) {
        if (!(masks[i / ROBOT8] >> i % ROBOT8 & 1) || is_apart_everywhere(c, i)) continue;
        unsigned near = find_near_ones(c, i);
        uint32_t before = to->count;
        if (near) cover_list_add(to, first + i, test_pair(c, i, near));
        cover_find_inner_hit(c, to, before);
    }
}

// ---- what is open

void cover_test_all(path_cover *c, cover_list *to) {
    to->count = 0;
    test_items(c, to);
    test_pairs(c, to);
}

// What was open in an earlier block, in the lanes of this one.
void cover_test_open(path_cover *c, const cover_list *from, cover_list *to) {
    uint32_t parts = (uint32_t)c->w->cell->parts.count, first = (uint32_t)c->w->cell->items.count * parts;
    to->count = 0;
    for (uint32_t i = 0; i < from->count;) {
        const cover_open *open = &from->items[i];
        if (open->number >= first) {
            cover_list_add(to, open->number, test_pair(c, open->number - first, open->lanes));
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
