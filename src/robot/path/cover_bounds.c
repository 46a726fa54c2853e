// How far a point of a robot leaves its motion to the second order, over an interval of a segment.
//
// A derivative of order p of a point by the segment's parameter is a sum over p joints. In a product of joints, sorted
// from the world outward, the last one gives the lever, the others turn it: its length is at most the distance from the
// last axis, or 1 where the last joint slides; where another one slides it is zero. With S_k the sum of the speeds of
// the turning joints up to k, and R_k the largest distance of the point from axis k,
//
//     |x'''| <= sum over turning k of R_k (S_k^3 - S_(k-1)^3) + sum over sliding k of 3 |speed_k| S_(k-1)^2
//
// and x leaves its Taylor polynomial of the second degree about the middle by at most that times h^3 / 6 within h of
// it. Seen from a body of the robot, the same holds of the joints between the two, sorted from that body outward.
//
// R_k is the length of all offsets from the axis to the point; of the first one, only what is across the axis.
#include "robot/path/cover.h"

#include <string.h>

#define UP (1 + 0x1p-40)

// What the third derivative is bounded by, joint by joint, from the inside outward.
typedef struct third_order {
    double turn, bound;
} third_order;

static void add_slide(third_order *t, const step_speed *v) { t->bound += 3 * v->slide * t->turn * t->turn; }
static void add_turn(third_order *t, const step_speed *v, double lever) {
    if (!(v->turn > 0)) return;
    double before = t->turn;
    t->turn += v->turn;
    double growth = v->turn * (t->turn * t->turn + (t->turn * before + before * before));
    t->bound += lever * growth * UP;
}

// The steps above an item, `count` of the lowest, from the highest down to it.
static void add_down(const path_cover *c, uint32_t item, uint32_t count, third_order *t) {
    const path_work *w = c->w;
    double slides = 0;
    for (uint32_t i = w->first[item]; i < w->first[item] + count; i++) slides += c->slides[w->links[i].step];
    double rounding = slides > 0 ? c->items[item].size.distance * 0x1p-45 : 0;
    for (uint32_t i = w->first[item] + count; i-- > w->first[item];) {
        const step_speed *v = &c->speeds[w->links[i].step];
        add_slide(t, v);
        // Sliding joints beyond the axis put the point farther from it.
        slides -= c->slides[w->links[i].step];
        add_turn(t, v, c->levers[i] + max2(slides, 0) * UP + rounding);
    }
}

static motion_rest make_rest(const motion_size *size, const third_order *third) {
    double s = size->turn, l = size->slide, d = size->distance, e = size->rotation, p = size->position;
    double ds = size->turn_slack, dl = size->slide_slack;
    double velocity = s * d + l, acceleration = s * (s * d + 2 * l);
    motion_rest rest = {
        .constant = p + 4 * (e + CELL_SLACK) * d, .third = third->bound / 6 * UP, .turn = third->turn * UP};
    rest.first = (s * (16 * e * d + 8 * p) + 16 * e * l + 2 * (ds * d + dl) + 4 * CELL_SLACK * velocity) * UP;
    rest.second = (s * s * (64 * e * d + 32 * p) + 64 * e * s * l + 8 * (s * ds * d + s * dl + l * ds) +
                   4 * CELL_SLACK * acceleration) *
                  UP;
    return rest;
}

// The third derivative's bound of an item's centres in the world: each step's share, times its lever where it turns.
static double sum_shares(const path_cover *c, uint32_t item, double distance) {
    const path_work *w = c->w;
    double bound = 0, slides = c->sums[c->items[item].link].far;
    for (uint32_t i = w->first[item]; i < w->first[item + 1]; i++) {
        const step_share *share = &c->shares[w->links[i].step];
        double lever = c->levers[i];
        // Sliding joints beyond the axis put the point farther from it.
        if (slides > 0) lever += max2(slides - share->slides, 0) * UP + distance * 0x1p-45;
        bound += lever * share->turn + share->slide;
    }
    return bound * UP;
}

// Of the whole chain from the world.
static void set_item(path_cover *c, uint32_t item) {
    const path_work *w = c->w;
    cover_item *it = &c->items[item];
    const frame_error *frame = &w->frame_errors[it->link];
    const motion_sums *sums = &c->sums[it->link];
    motion_size size = {.turn = sums->turn * UP,
                        .slide = sums->slide * UP,
                        .turn_slack = sums->turn_slack * UP,
                        .slide_slack = sums->slide_slack * UP,
                        .distance = (c->lengths[it->link] + it->far + it->one.radius + sums->far) * UP};
    double turned = sums->state_turn * UP, slid = sums->state_slide * UP;
    size.rotation = (2 * frame->quaternion + turned + 64 * ROUNDING * (w->step_count + 1)) * UP;
    size.position = (frame_error_at(frame, it->far + it->one.radius) + w->errors[item] +
                     2 * (turned * size.distance + slid) + OVOID_LENGTH_MIN) *
                    UP;
    it->size = size;
    third_order t = {size.turn, sum_shares(c, item, size.distance)};
    it->rest = make_rest(&size, &t);
}

motion_rest cover_find_hull_rest(const motion_rest *of_centers, double radius) {
    motion_rest rest = *of_centers;
    // A vertex is no farther from the centre of the ball around all than its radius, so from no axis much farther.
    rest.third += radius * (rest.turn * rest.turn * rest.turn) / 6 * UP;
    return rest;
}

motion_rest cover_find_pair_rest(const path_cover *c, uint32_t pair, int is_from_b) {
    const path_work *w = c->w;
    const pair_chain *chain = &w->pairs[pair];
    item_pair both = cell_pairs(w->cell)[pair];
    uint32_t from = is_from_b ? both.b : both.a, to = is_from_b ? both.a : both.b;
    uint32_t count_from = is_from_b ? chain->count_b : chain->count_a,
             count_to = is_from_b ? chain->count_a : chain->count_b;
    const motion_size *x = &c->items[from].size, *y = &c->items[to].size;
    // An axis between the body and what both hang on is no farther from the point than both are from the world's
    // origin.
    double far = (x->distance + y->distance) * UP;
    double common = chain->frame == OVOID_ROBOT_NONE ? 0 : c->lengths[chain->frame];
    double to_length = (c->lengths[c->items[to].link] - common) + c->items[to].far, slides = 0;
    for (uint32_t i = 0; i < count_to; i++) slides += c->slides[w->links[w->first[to] + i].step];
    for (uint32_t i = 0; i < count_from; i++) slides += c->slides[w->links[w->first[from] + i].step];
    third_order t = {0, 0};
    for (uint32_t i = 0; i < count_from; i++) {
        uint32_t step = w->links[w->first[from] + i].step;
        double up = c->lengths[w->steps[step].child] - common;
        add_turn(&t, &c->speeds[step], (up + to_length + slides + far * 0x1p-45) * UP);
        add_slide(&t, &c->speeds[step]);
    }
    add_down(c, to, count_to, &t);
    const motion_size size = {(x->turn + y->turn) * UP,
                              (x->slide + y->slide) * UP,
                              x->turn_slack + y->turn_slack,
                              x->slide_slack + y->slide_slack,
                              x->rotation + y->rotation,
                              x->position + y->position,
                              far};
    return make_rest(&size, &t);
}

// What a step adds to the sums from the world down to it.
static void add_sums(path_cover *c, uint32_t step) {
    const chain_step *s = &c->w->steps[step];
    const step_speed *v = &c->speeds[step];
    motion_sums sums = {0, 0, 0, 0, 0, 0, 0};
    if (s->parent != OVOID_ROBOT_NONE) sums = c->sums[s->parent];
    third_order t = {sums.turn, 0};
    add_slide(&t, v);
    double slide = t.bound;
    add_turn(&t, v, 1);
    sums.turn = t.turn, sums.slide += v->slide;
    sums.turn_slack += c->slacks[2 * (size_t)step], sums.slide_slack += c->slacks[2 * (size_t)step + 1];
    sums.state_turn += v->turn_slack, sums.state_slide += v->slide_slack;
    sums.far += c->slides[step];
    c->sums[s->child] = sums;
    c->shares[step] = (step_share){t.bound - slide, slide, sums.far};
}

static void raise(double *most, double value) { *most = max2(*most, value); }

// What a step's speed may be off by, and the farthest that it slides: as find_speed of the motions has it.
static step_rate add_step(path_cover *c, const cover_segment *segment, uint32_t step) {
    const path_work *w = c->w;
    const ovoid_robot *r = w->cell->robot;
    uint32_t joint = w->joints[step];
    const chain_step *s = &w->steps[step];
    step_rate rate = {{0, 0, 0}, 0};
    double slacks[2] = {0, 0}, slide = 0;
    uint32_t lengths = step_count_lengths(s->kind), count = lengths + (s->kind == STEP_TURN || s->kind == STEP_PLANE);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t variable = r->joint_variable[joint] + (lengths > 1 ? i : 0);
        const joint_lead *lead = &r->leads[joint];
        double a = w->values[s->value + i], b = w->other_values[s->value + i];
        double q0 = segment->q0[variable], q1 = segment->q1[variable];
        double off = lead->error * (lead->spread * max2(fabs(q0), fabs(q1)) + lead->offset_spread);
        if (i < lengths) slide += (max2(fabs(a), fabs(b)) + off) * UP;
        if (q0 == q1) continue;
        slacks[i < lengths] += (8 * ROUNDING * (fabs(a) + fabs(b)) + 2 * off) * UP;
        if (i < lengths)
            rate.length[i] = b - a;
        else
            rate.turn = b - a;
    }
    raise(&c->slides[step], slide);
    raise(&c->slacks[2 * (size_t)step], slacks[0]), raise(&c->slacks[2 * (size_t)step + 1], slacks[1]);
    const step_speed *v = &w->speeds[step];
    step_speed *most = &c->speeds[step];
    raise(&most->turn, v->turn), raise(&most->slide, v->slide);
    raise(&most->turn_slack, v->turn_slack), raise(&most->slide_slack, v->slide_slack);
    return rate;
}

void cover_add_rates(path_cover *c, cover_segment *segment) {
    for (uint32_t i = 0; i < c->w->step_count; i++) {
        step_rate rate = add_step(c, segment, i);
        if (i < c->w->cell->steps.count) segment->rates[i] = rate;
    }
}

// Frames that moved along earlier segments may be still along these.
static void set_moving(path_cover *c, uint32_t step) {
    const chain_step *s = &c->w->steps[step];
    const step_speed *v = &c->speeds[step];
    int is_moving = v->turn > 0 || v->slide > 0 || (s->parent != OVOID_ROBOT_NONE && c->is_moving[s->parent]);
    c->is_moving[s->child] = (uint8_t)is_moving;
    if (step >= c->w->cell->steps.count) return;
    c->rates[step].is_moving = is_moving;
    if (!is_moving) memset(&c->rates8[s->child], 0, sizeof *c->rates8);
}

void cover_set_bounds(path_cover *c) {
    for (uint32_t i = 0; i < c->w->step_count; i++) set_moving(c, i), add_sums(c, i);
    for (uint32_t i = 0; i < c->w->cell->items.count; i++) set_item(c, i);
    memset(c->have_rests, 0, c->w->cell->pairs.count);
}

const motion_rest *cover_get_rest(path_cover *c, uint32_t pair) {
    if (!c->have_rests[pair]) c->rests[pair] = cover_find_pair_rest(c, pair, cover_is_from_b(c, pair));
    c->have_rests[pair] = 1;
    return &c->rests[pair];
}
