// Contact in a whole cell: a point x of the world, below which both chains begin, that stays inside both bodies.
//
// The ball of radius r around x lies in a body in the middle of the cell. The body's own point at x comes no farther
// than m from x in the cell, m being the sum over its joints of the way h_i times the distance of x from the axis
// (prove.c). Where m < r, the body still holds x. Near the axes of the joints m is small, whatever the bodies' size:
// that is where links that touch in all states mostly overlap. Both r and -m are concave in x for convex bodies, so a
// search by steps finds a good point; it need not be the best. Cost: two depths of a point for each point that is
// tried.
#include "robot/matrix/cell_contact.h"

#include "robot/model/inner_balls.h"

#define UP (1 + 0x1p-40)

enum { STEPS = 8, DIRECTIONS = 14 };

// The way of a joint through the cell, and the distance of x from its axis, rounded up.
static double find_way(const cell_contact *c, uint32_t step, vec3 x) {
    const path_work *w = c->w;
    const step_speed *v = &w->speeds[step];
    double way = 0.5 * v->slide + v->slide_slack;
    if (!(v->turn > 0)) return way;
    uint32_t child = w->steps[step].child;
    vec3 from = c->middle->frames[child].position, d = vec3_sub(x, from);
    double far = vec3_sum_abs(d), error = frame_error_at(&w->frame_errors[child], far);
    double distance = vec3_norm(vec3_cross(c->middle->axes[step], d));
    double size = far + (vec3_sum_abs(x) + vec3_sum_abs(from));
    return way + (0.5 * v->turn + v->turn_slack) * ((distance + CELL_SLACK * size) + 2 * error) * UP;
}

static double find_motion(const cell_contact *c, uint32_t item, uint32_t count, vec3 x) {
    const item_link *links = c->w->links + c->w->first[item];
    double moved = 0;
    for (uint32_t i = 0; i < count; i++) moved = (moved + find_way(c, links[i].step, x)) * UP;
    return moved;
}

// The radius of a ball around x that is proven to lie in the item; 0: there is none.
static double find_inside(const cell_contact *c, uint32_t which, vec3 x) {
    const cell_item *item = &cell_items(c->w->cell)[which];
    const link_frame *f = &c->middle->frames[item->frame];
    ovoid_pose at = {x, {1, 0, 0, 0}}, pose = {f->position, f->rotation};
    if (item->solid) {
        ovoid_body_pair pair = {{.shape = c->point, .pose = at}, {.solid = item->solid, .pose = pose}};
        ovoid_body_answer found = ovoid_body_distance(&pair, NULL, NULL);
        return found.inside == OVOID_BODY_A_INSIDE && found.deciding.lower > 0 ? found.deciding.lower : 0;
    }
    ovoid_pair pair = {c->point, item->shape, at, pose};
    double upper = ovoid_depth(&pair, NULL, NULL, NULL).upper;
    return upper < 0 ? -upper : 0;
}

// By how much x stays inside both items in the cell.
static double find_spare(const cell_contact *c, vec3 x) {
    item_pair of = cell_pairs(c->w->cell)[c->pair];
    const pair_chain *k = &c->w->pairs[c->pair];
    double a = find_inside(c, of.a, x) - find_motion(c, of.a, k->count_a, x) - c->w->errors[of.a];
    if (!(a > c->spare)) return a;
    double b = find_inside(c, of.b, x) - find_motion(c, of.b, k->count_b, x) - c->w->errors[of.b];
    return min2(a, b) - 0x1p-46 * vec3_sum_abs(x);
}

int cell_contact_is_proven(cell_contact *c) {
    c->spare = -INFINITY;
    if (c->pair != OVOID_ROBOT_NONE) c->spare = find_spare(c, c->at);
    return c->spare > 0;
}

// ---- the search

static void try_point(cell_contact *c, vec3 x) {
    double spare = find_spare(c, x);
    if (spare > c->spare) c->spare = spare, c->at = x;
}

// The points of the axes of an item's joints that are nearest to x.
static void try_axes(cell_contact *c, uint32_t item, uint32_t count, vec3 x) {
    const item_link *links = c->w->links + c->w->first[item];
    for (uint32_t i = 0; i < count; i++) {
        uint32_t step = links[i].step;
        if (!(c->w->speeds[step].turn > 0)) continue;
        vec3 from = c->middle->frames[c->w->steps[step].child].position, axis = c->middle->axes[step];
        try_point(c, vec3_add_scaled(from, axis, vec3_dot(axis, vec3_sub(x, from))));
    }
}

// The middles of a cube's faces, and its corners.
static vec3 get_direction(int i) {
    if (i < 6) return (vec3){(i == 0) - (i == 1), (i == 2) - (i == 3), (i == 4) - (i == 5)};
    return vec3_scale((vec3){i & 1 ? 1 : -1, i & 2 ? 1 : -1, (i - 6) & 4 ? 1 : -1}, 0.57);
}

static void climb(cell_contact *c, double step) {
    for (int i = 0; i < STEPS && !(c->spare > 0); i++) {
        double before = c->spare;
        for (int k = 0; k < DIRECTIONS && !(c->spare > 0); k++)
            try_point(c, vec3_add_scaled(c->at, get_direction(k), step));
        if (!(c->spare > before)) step *= 0.5;
    }
}

int cell_contact_find(cell_contact *c, uint32_t pair, const ovoid_answer *deepest) {
    item_pair of = cell_pairs(c->w->cell)[pair];
    const pair_chain *k = &c->w->pairs[pair];
    vec3 middle = vec3_scale(vec3_add(deepest->point_a, deepest->point_b), 0.5);
    cell_contact now = *c;
    now.pair = pair;
    now.spare = -INFINITY;
    try_point(&now, middle);
    try_axes(&now, of.a, k->count_a, middle);
    try_axes(&now, of.b, k->count_b, middle);
    climb(&now, max2(-deepest->upper, 0));
    if (now.spare > c->spare) *c = now;
    return c->spare > 0;
}

static void add_shares(const cell_contact *c, uint32_t item, uint32_t count, double *shares) {
    const item_link *links = c->w->links + c->w->first[item];
    for (uint32_t i = 0; i < count; i++) {
        uint32_t variable = c->w->cell->robot->joint_variable[c->w->joints[links[i].step]];
        shares[variable] += find_way(c, links[i].step, c->at);
    }
}

void cell_contact_add_shares(const cell_contact *c, double *shares) {
    item_pair of = cell_pairs(c->w->cell)[c->pair];
    const pair_chain *k = &c->w->pairs[c->pair];
    add_shares(c, of.a, k->count_a, shares);
    add_shares(c, of.b, k->count_b, shares);
}
