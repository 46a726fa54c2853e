// Pairs that balls and slabs leave open, by the vertices of their hulls along one direction.
//
// Seen from a body, or from the world, a vertex of the other one moves by v t + a t^2 / 2 from where it is in the
// middle of an interval, t from -1 to 1, but for its rest. Along a unit vector n that is fixed in that frame it stays
// above n.x - |n.v| + min(n.a / 2, 0) less the rest. Where that is above the support of the first body by more than
// both radii, for all vertices, the pair is apart over the interval. n is the one that parted the pair last, or that of
// an exact query in the middle of an open interval: whatever it is, the test holds. A query that finds the bodies
// within the margin names a state that is then checked for a hit.
#include "robot/path/cover.h"

#include "base/compiler.h"
#include "ovoid/query.h"

#include <string.h>

enum { VERTICES_MOST = 1024 };

// An open pair: an item that is seen from another one, or from an obstacle.
typedef struct hull_pair {
    uint32_t number, item, other, part; ///< other or part: NONE
    moving8 from;
    motion_rest rest;
    double reach[COVER8];
} hull_pair;

static hull_pair make_pair(path_cover *c, uint32_t number) {
    const ovoid_robot_cell *cell = c->w->cell;
    pair_parts of = pair_take_apart(cell, number);
    hull_pair p = {.number = number, .item = of.item, .other = OVOID_ROBOT_NONE, .part = of.part};
    double margin = c->query.margin, radii;
    if (of.part != OVOID_ROBOT_NONE) {
        const cell_part *part = &cell_parts(cell)[of.part];
        p.from = (moving8){c->world, c->still};
        p.rest = c->items[of.item].rest;
        margin = cover_get_margin(c, of.item);
        // The box' radius counts rounding of its place, which is that of the vertices.
        radii = part->box.radius + 4 * CELL_SLACK * (vec3_sum_abs(part->box.center) + vec3_sum_abs(part->box.half));
    } else {
        int is_from_b = cover_is_from_b(c, of.pair);
        p.item = is_from_b ? of.item : of.other;
        p.other = is_from_b ? of.other : of.item;
        p.from = cover_get_link(c, p.other);
        p.rest = *cover_get_rest(c, of.pair);
        radii = c->items[p.other].hull;
    }
    motion_rest rest = cover_find_hull_rest(&p.rest, c->items[p.item].one.radius);
    cover_compute_reach(c, &rest, (margin + radii) + c->items[p.item].hull, p.reach);
    return p;
}

// The largest of n . v.
static double find_support(const double *vertices, uint32_t count, vec3 n) {
    double most = -INFINITY;
    for (uint32_t i = 0; i < count; i++) most = max2(most, vec3_dot(n, vec3_at(vertices, i)));
    return most;
}

// Of an obstacle in the world, of another item in its link's frame.
static double compute_support(const path_cover *c, const hull_pair *p, vec3 n) {
    if (p->other != OVOID_ROBOT_NONE)
        return find_support(c->items[p->other].vertices, c->items[p->other].vertex_count, n);
    const cell_part *part = &cell_parts(c->w->cell)[p->part];
    vec3 own = mat3_mul_transposed_vec3(part->box.rotation, n);
    double base = vec3_dot(n, part->pose.position) + vec3_dot(own, part->shape->origin);
    return base + find_support(shape_vertices(part->shape), part->shape->vertex_count, own);
}

static void set_normal(path_cover *c, const hull_pair *p, vec3 normal) {
    c->normals[p->number] = (cover_normal){normal, compute_support(c, p, normal)};
}

static int has_normal(const path_cover *c, uint32_t number) {
    vec3 n = c->normals[number].along;
    return n.x != 0 || n.y != 0 || n.z != 0;
}

// The lanes that the pair's normal leaves open.
static unsigned find_near(const path_cover *c, const hull_pair *p, unsigned lanes) {
    const cover_item *item = &c->items[p->item];
    const moving_hull hull = {.from = p->from,
                              .link = cover_get_link(c, p->item),
                              .clusters = item->clusters,
                              .count = item->count,
                              .center = item->one.center,
                              .radius = item->one.radius,
                              .normal = c->normals[p->number].along,
                              .support = c->normals[p->number].support};
    return c->kernels->near_hull(&hull, p->reach) & lanes;
}

ovoid_pose cover_get_pose(const path_cover *c, uint32_t item, unsigned lane) {
    const cell_item *it = &cell_items(c->w->cell)[item];
    const frame8 *f = &c->frames8[c->items[item].link];
    ovoid_pose link = {{f->column[0][lane], f->column[1][lane], f->column[2][lane]},
                       {f->column[3][lane], f->column[4][lane], f->column[5][lane], f->column[6][lane]}};
    return it->frame == c->items[item].link ? link : ovoid_pose_compute_product(&link, &it->in_link);
}

// The bodies in the middle of a lane: the one that is seen is the second.
static ovoid_pair pose_pair(const path_cover *c, const hull_pair *p, unsigned lane) {
    const cell_item *items = cell_items(c->w->cell);
    ovoid_pair pair = {.shape_b = items[p->item].shape, .pose_b = cover_get_pose(c, p->item, lane)};
    if (p->other != OVOID_ROBOT_NONE) {
        pair.shape_a = items[p->other].shape;
        pair.pose_a = cover_get_pose(c, p->other, lane);
    } else {
        pair.shape_a = cell_parts(c->w->cell)[p->part].shape;
        pair.pose_a = cell_parts(c->w->cell)[p->part].pose;
    }
    return pair;
}

static mat3 get_rotation(const frame8 *f, unsigned lane) {
    const double(*m)[COVER8] = &f->column[FRAME8_ROTATION];
    return (mat3){{m[0][lane], m[1][lane], m[2][lane]},
                  {m[3][lane], m[4][lane], m[5][lane]},
                  {m[6][lane], m[7][lane], m[8][lane]}};
}

mat3 cover_get_rotation(const path_cover *c, uint32_t item, unsigned lane) {
    return get_rotation(&c->frames8[c->items[item].link], lane);
}

// An exact query in the middle of a lane. 1: it gave the pair a normal.
static int query_middle(path_cover *c, const hull_pair *p, unsigned lane) {
    ovoid_pair pair = pose_pair(c, p, lane);
    // How far bodies are apart matters up to where the motion does not.
    const ovoid_options options = {.cap = 8 * p->reach[lane], .absolute_tolerance = 0.05 * p->reach[lane]};
    ovoid_answer answer = ovoid_distance(&pair, &options, &c->proofs[p->number]);
    c->proofs[p->number] = answer.proof;
    if (answer.lower > c->query.margin) {
        set_normal(c, p, mat3_mul_transposed_vec3(get_rotation(p->from.frame, lane), answer.normal));
        return 1;
    }
    pair_parts of = pair_take_apart(c->w->cell, p->number);
    // The normal of an earlier query is for where the obstacle was then.
    if (p->part != OVOID_ROBOT_NONE) c->normals[p->number] = (cover_normal){{0, 0, 0}, 0};
    // A solid may be free where its hull is not: the search asks.
    if (!path_has_solid(c->w, &of) && answer.upper <= p->reach[lane])
        (void)cover_take_overlap(c, p->number, lane, -answer.upper);
    return 0;
}

unsigned cover_test_known(path_cover *c, uint32_t number, unsigned lanes) {
    if (!has_normal(c, number)) return lanes;
    hull_pair p = make_pair(c, number);
    return find_near(c, &p, lanes);
}

unsigned cover_choose_lane(unsigned lanes) {
    unsigned count = 0;
    for (unsigned rest = lanes; rest; rest &= rest - 1) count++;
    for (unsigned i = 0; i < count / 2; i++) lanes &= lanes - 1;
    return compiler_count_low_zeros(lanes);
}

static unsigned test_hulls(path_cover *c, const cover_open *of) {
    hull_pair p = make_pair(c, of->number);
    unsigned lanes = of->lanes & c->wanted, open = lanes & ~(1u << cover_choose_lane(lanes));
    if (c->items[p.item].vertex_count > VERTICES_MOST) return lanes;
    // What was asked for a hit gave a normal.
    if (has_normal(c, of->number)) lanes = find_near(c, &p, lanes);
    for (open &= lanes; open;) {
        unsigned lane = cover_choose_lane(open);
        if (query_middle(c, &p, lane)) lanes = find_near(c, &p, lanes);
        lanes &= c->wanted;
        open &= lanes & ~(1u << lane);
    }
    return lanes;
}

// The pair that has hit most often is asked first.
static void move_likely_first(const path_cover *c, cover_list *list) {
    uint32_t likely = 0;
    for (uint32_t i = 1; i < list->count; i++)
        if (c->hit_counts[list->items[i].number] > c->hit_counts[list->items[likely].number]) likely = i;
    if (likely == 0) return;
    cover_open open = list->items[likely];
    memmove(list->items + 1, list->items, likely * sizeof *list->items);
    list->items[0] = open;
}

static void count_hit(path_cover *c, uint32_t number) {
    if (++c->hit_counts[number] < UINT8_MAX) return;
    for (size_t i = 0; i < path_count_numbers(c->w->cell); i++) c->hit_counts[i] /= 2;
}

void cover_query_middles(path_cover *c, cover_list *list) {
    move_likely_first(c, list);
    for (uint32_t i = 0; i < list->count && c->wanted; i++) {
        unsigned lanes = list->items[i].lanes & c->wanted, wanted = c->wanted;
        if (!lanes) continue;
        hull_pair p = make_pair(c, list->items[i].number);
        (void)query_middle(c, &p, cover_choose_lane(lanes));
        if (c->wanted != wanted) count_hit(c, p.number);
    }
}

void cover_test_hulls(path_cover *c, cover_list *list) {
    uint32_t kept = 0;
    for (uint32_t i = 0; i < list->count && c->wanted; i++) {
        cover_open open = list->items[i];
        open.lanes &= (uint8_t)c->wanted;
        if (open.lanes) open.lanes = (uint8_t)test_hulls(c, &open);
        if (open.lanes) list->items[kept++] = open;
    }
    list->count = kept;
}
