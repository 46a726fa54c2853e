// Moving a body. Its travel grows by at least the distance that any point of it can have moved by turning; its box
// stays as long as its motion since the box was made fits into the margin that was left around it.
//
// The chord of a rotation: unit quaternions p, q with p.q >= 0 are 2 sin(a / 4) apart, a the angle between the
// rotations, and the norm of R(p) - R(q) is 2 sin(a / 2) <= 2 |p - q|. Each p, q is off by 4 u when normalised; 32 u is
// added. Of one whose square is within 2^-40 of 1 the length is off by less than that: it is taken as it is, and twice
// that is added.
#include "world/move.h"

#include "base/compiler.h"
#include "base/environment.h"
#include "base/error.h"
#include "linear/rotation.h"
#include "simd/move8.h"
#include "world/body_bounds.h"
#include "world/tree/wide_tree.h"

// Covers the rounding of a sum of few terms.
#define SLACK (1 + 0x1p-48)

// The enlargement if the world chooses it: a number of steps like the last one, between limits relative to the body's
// size. The number differs between bodies and between successive boxes of a body, most of all when the motion has just
// begun; otherwise bodies that start together would all leave their boxes in the same frames.
#define STEPS_LEAST 9.0
#define STEPS_BEGIN 2.0
#define STEPS_MOST 15.0
#define ROOM_LEAST 0.04
#define ROOM_MOST 0.5

// A finite float, whatever the size. The box is made with this rounded number.
static float make_float(double x) { return (float)min2(x, 1e38); }

// The number of steps that a body's next box should last: evenly distributed, by a hash of the body and the number of
// its boxes.
static double find_steps(uint32_t body, uint32_t boxes) {
    uint32_t h = body * 0x9e3779b9u + boxes * 0x85ebca6bu;
    h = (h ^ h >> 16) * 0xc2b2ae35u;
    double least = boxes > 1 ? STEPS_LEAST : STEPS_BEGIN;
    return least + (STEPS_MOST - least) * ((h ^ h >> 16) * 0x1p-32);
}

// The enlargement along one axis to one side, turns included.
static float compute_room(const world_body *b, double step, double steps) {
    double size = b->reach + b->radius, ahead = max2(step, 0) + (double)b->turn;
    return make_float(max2(ROOM_LEAST * size, min2(steps * ahead, ROOM_MOST * size)));
}

static void find_room(const ovoid_world *w, uint32_t i) {
    world_body *b = &w->bodies[i];
    float even = make_float(w->enlargement * (b->reach + b->radius));
    double steps = find_steps(i, b->boxes++);
    for (int k = 0; k < 3; k++) {
        b->low[k] = w->enlargement > 0 ? even : compute_room(b, -(double)b->displacement[k], steps);
        b->high[k] = w->enlargement > 0 ? even : compute_room(b, (double)b->displacement[k], steps);
    }
}

box world_compute_box(ovoid_world *w, uint32_t i) {
    world_body *b = &w->bodies[i];
    body_sphere ball = body_get_sphere(b);
    b->placed = w->places[i];
    find_room(w, i);
    double more = w->margin / 2;
    if (i < w->range_capacity) {
        body_range *range = &w->ranges[i];
        range->boxed = range->now + range->spare;
        more += range->boxed;
    }
    vec3 low = {((double)b->low[0] + more) * SLACK, ((double)b->low[1] + more) * SLACK,
                ((double)b->low[2] + more) * SLACK};
    vec3 high = {((double)b->high[0] + more) * SLACK, ((double)b->high[1] + more) * SLACK,
                 ((double)b->high[2] + more) * SLACK};
    box bounds = body_compute_box(&b->body, &ball);
    return (box){vec3_sub(bounds.min, low), vec3_add(bounds.max, high)};
}

// 1 if no point of the body left its enlarged box along an axis: the way of r plus the turns bounds the motion of each
// point.
static int is_along(double displacement, double turn, float low, float high) {
    double slack = turn + 0x1p-48 * (fabs(displacement) + turn);
    return displacement + slack <= (double)high && slack - displacement <= (double)low;
}

static int is_in_box(const world_body *b, const body_place *p) {
    vec3 d = vec3_sub(p->at, b->placed.at);
    double t = p->travel - b->placed.travel;
    return is_along(d.x, t, b->low[0], b->high[0]) && is_along(d.y, t, b->low[1], b->high[1]) &&
           is_along(d.z, t, b->low[2], b->high[2]);
}

void body_mark_fresh(ovoid_world *w, uint32_t i) {
    if (!(w->marks[i] & (MARK_BOX | MARK_FRESH))) w->changed[w->changed_count++] = i;
    w->marks[i] |= MARK_BOX | MARK_FRESH | MARK_MOVED;
    w->seen[i] = box_make_empty();
}

// Gives a leaf its body's new box, but leaves the tree above it as it is until settle_box. Workers do this at the same
// time for different bodies.
static void replace_box(ovoid_world *w, uint32_t i) {
    box *bounds = &w->tree.nodes[w->leaf_of[i]].bounds;
    box now = world_compute_box(w, i);
    if (!(w->marks[i] & (MARK_BOX | MARK_FRESH))) w->seen[i] = *bounds;
    if (!box_is_overlapping(bounds, &now)) w->marks[i] |= MARK_AWAY;
    *bounds = now;
}

// Fits the tree to a leaf's new box, and lists the body as changed. Leaves that are not settled yet may be in the tree:
// each brings the nodes above it up to date when it is its turn.
static void settle_box(ovoid_world *w, uint32_t i) {
    box now = w->tree.nodes[w->leaf_of[i]].bounds;
    if (!(w->marks[i] & (MARK_BOX | MARK_FRESH))) {
        w->changed[w->changed_count++] = i;
        w->marks[i] |= MARK_BOX;
    }
    if (w->marks[i] & MARK_AWAY) {
        dynamic_tree_remove(&w->tree, w->leaf_of[i], w->leaf_of);
        dynamic_tree_add(&w->tree, i, &now, w->leaf_of);
    } else {
        dynamic_tree_refit(&w->tree, w->leaf_of[i], &now);
    }
    w->marks[i] &= (uint8_t) ~(MARK_LEFT | MARK_AWAY);
}

void body_refresh(ovoid_world *w, uint32_t i) {
    replace_box(w, i);
    settle_box(w, i);
}

// The largest deviation from unit length of a quaternion that is used without normalisation, as most are normalised
// already.
#define NEARLY_UNIT 0x1p-40

static ovoid_quat normalised(ovoid_quat q) {
    if (!quat_is_plain(quat_norm_squared(q))) q = quat_scaled(q);
    double s = 1 / sqrt(quat_norm_squared(q));
    return (ovoid_quat){q.w * s, q.x * s, q.y * s, q.z * s};
}

static int is_same_rotation(ovoid_quat p, ovoid_quat q) { return p.w == q.w && p.x == q.x && p.y == q.y && p.z == q.z; }

static int is_same_pose(const ovoid_pose *p, const ovoid_pose *q) {
    vec3 a = p->position, b = q->position;
    return a.x == b.x && a.y == b.y && a.z == b.z && is_same_rotation(p->rotation, q->rotation);
}

// An upper bound of the norm of the difference of the two rotations.
static double compute_chord(ovoid_quat before, ovoid_quat after) {
    if (is_same_rotation(before, after)) return 0;
    ovoid_quat p = before, q = after;
    double error = 2 * NEARLY_UNIT;
    if (!(fabs(quat_norm_squared(p) - 1) < NEARLY_UNIT && fabs(quat_norm_squared(q) - 1) < NEARLY_UNIT)) {
        p = normalised(p);
        q = normalised(q);
        error = 32 * 0x1p-53;
    }
    double sign = (p.w * q.w + p.x * q.x) + (p.y * q.y + p.z * q.z) < 0 ? -1 : 1;
    ovoid_quat e = {q.w - sign * p.w, q.x - sign * p.x, q.y - sign * p.y, q.z - sign * p.z};
    return min2(2 * sqrt(quat_norm_squared(e)) * SLACK + error, 2);
}

// Moves the body, but not its box. 1 if the body has left the box.
static int place_body(ovoid_world *w, uint32_t i, const ovoid_pose *pose) {
    world_body *b = &w->bodies[i];
    body_place *p = &w->places[i];
    if (is_same_pose(&b->body.pose, pose)) return 0;
    body_sphere ball = body_get_sphere(b);
    double center_error, chord = compute_chord(b->body.pose.rotation, pose->rotation);
    vec3 at = body_compute_center(&ball, pose, &center_error), displacement = vec3_sub(at, p->at);
    double turn = (chord * b->reach + (b->center_error + center_error)) * SLACK;
    double travel = p->travel + turn;
    b->displacement[0] = (float)displacement.x;
    b->displacement[1] = (float)displacement.y;
    b->displacement[2] = (float)displacement.z;
    b->turn = (float)turn;
    *p = (body_place){at, travel + travel * 0x1p-51};
    b->center_error = center_error;
    b->body.pose = *pose;
    w->marks[i] |= MARK_MOVED | MARK_POSED;
    return !is_in_box(b, p);
}

// A pose that is valid for any body of the world, unless has_vast is set.
static int is_plain(const ovoid_pose *pose) {
    return quat_is_plain(quat_norm_squared(pose->rotation)) && fabs(pose->position.x) <= OVOID_LENGTH_MAX / 4 &&
           fabs(pose->position.y) <= OVOID_LENGTH_MAX / 4 && fabs(pose->position.z) <= OVOID_LENGTH_MAX / 4;
}

static ovoid_code validate_move(const ovoid_world *w, ovoid_id id, const ovoid_pose *pose, int64_t place,
                                ovoid_error *error) {
    uint32_t i = world_find_body(w, id);
    if (i == NONE) return world_refuse_id(error, place, id);
    if (is_plain(pose) && !w->has_vast) return OVOID_OK;
    ovoid_body moved = w->bodies[i].body;
    moved.pose = *pose;
    return world_validate_body(&moved, place, error);
}

// A batch of moves, no body twice: all workers move the bodies and replace the boxes of those that left them, then the
// tree is fitted to these in order.
typedef struct moves {
    ovoid_world *w;
    const ovoid_id *ids;
    const ovoid_pose *poses;
} moves;

// A worker's part of a batch is at least so many bodies; so many where they are only validated, since waking a worker
// costs as much as validating hundreds.
enum { LEAST = 512, LEAST_VALIDATED = 4096 };

static const move8_errors errors = {SLACK, NEARLY_UNIT, BODY_CENTER_ERROR, OVOID_LENGTH_MIN};

static void set_places(const moves *m, uint32_t item, move8_places *out, uint32_t lane) {
    uint32_t i = (uint32_t)(m->ids[item] >> 32);
    const world_body *b = &m->w->bodies[i];
    out->from[lane] = &b->body.pose.position.x;
    out->to[lane] = &m->poses[item].position.x;
    out->ball[lane] = &b->local.x;
    out->reach[lane] = &b->reach;
    out->place[lane] = &m->w->places[i].at.x;
    out->placed[lane] = &b->placed.at.x;
    out->room[lane] = b->low;
}

// Stores what a lane says of a body.
static void take_place(ovoid_world *w, uint32_t i, const ovoid_pose *pose, const move8_result *from, uint32_t lane) {
    world_body *b = &w->bodies[i];
    for (int k = 0; k < 3; k++) b->displacement[k] = (float)from->displacement[k].lane[lane];
    b->turn = (float)from->turn.lane[lane];
    w->places[i] = (body_place){{from->place[0].lane[lane], from->place[1].lane[lane], from->place[2].lane[lane]},
                                from->place[3].lane[lane]};
    b->center_error = from->center_error.lane[lane];
    b->body.pose = *pose;
    w->marks[i] |= MARK_MOVED | MARK_POSED | (from->left >> lane & 1 ? MARK_LEFT : 0);
}

// How many bodies ahead a body is prefetched. The next ones in memory come by themselves, but not across pages.
enum { BODIES_AHEAD = 16 };

static void fetch_body(const moves *m, uint32_t item) {
    uint32_t i = (uint32_t)(m->ids[item] >> 32);
    prefetch_two_lines(&m->w->bodies[i]);
    prefetch_two_lines(&m->w->bodies[i].local);
    compiler_prefetch(&m->w->places[i]);
}

// Moves up to eight bodies from an item of the batch on.
static void place_some(const moves *m, uint32_t first, uint32_t count) {
    ovoid_world *w = m->w;
    move8_places places = {.count = count};
    move8_result found;
    for (uint32_t k = 0; k < PAIR8; k++) set_places(m, k < count ? first + k : first, &places, k);
    move8_get(count)(&places, &errors, &found);
    for (uint32_t k = 0; k < count; k++) {
        uint32_t i = (uint32_t)(m->ids[first + k] >> 32);
        const ovoid_pose *pose = &m->poses[first + k];
        if (found.moved >> k & 1) take_place(w, i, pose, &found, k);
        if (found.odd >> k & 1 && place_body(w, i, pose)) w->marks[i] |= MARK_LEFT;
    }
}

static void place_bodies(void *work, uint32_t first, uint32_t end, uint32_t worker) {
    const moves *m = work;
    (void)worker;
    for (uint32_t k = first; k < end; k += PAIR8) {
        for (uint32_t j = k + BODIES_AHEAD; j < k + BODIES_AHEAD + PAIR8 && j < end; j++) fetch_body(m, j);
        place_some(m, k, end - k < PAIR8 ? end - k : PAIR8);
    }
}

// Leaves, their siblings and their parents are scattered in the tree: they are prefetched some bodies ahead.
enum { AHEAD = 24, PARENTS_AHEAD = 12 };

static void fetch_couple(const ovoid_world *w, uint32_t node) {
    const tree_node *couple = &w->tree.nodes[node & ~1u];
    compiler_prefetch(couple);
    compiler_prefetch(couple + 1);
}

static void fetch_leaf(const ovoid_world *w, uint32_t i) {
    if (w->marks[i] & MARK_LEFT) fetch_couple(w, w->leaf_of[i]);
}

static void fetch_parent(const ovoid_world *w, uint32_t i) {
    if (!(w->marks[i] & MARK_LEFT)) return;
    uint32_t parent = w->tree.nodes[w->leaf_of[i]].parent;
    if (parent != NONE) fetch_couple(w, parent);
}

static void replace_boxes(void *work, uint32_t first, uint32_t end, uint32_t worker) {
    const moves *m = work;
    (void)worker;
    for (uint32_t k = first; k < end; k++) {
        if (k + AHEAD < end) fetch_leaf(m->w, (uint32_t)(m->ids[k + AHEAD] >> 32));
        uint32_t i = (uint32_t)(m->ids[k] >> 32);
        if (m->w->marks[i] & MARK_LEFT) replace_box(m->w, i);
    }
}

static void move_by_all(moves *m, uint32_t count) {
    ovoid_world *w = m->w;
    const ovoid_id *ids = m->ids;
    task_host_run(&w->host, &(task){place_bodies, m, count, LEAST});
    task_host_run(&w->host, &(task){replace_boxes, m, count, LEAST});
    for (uint32_t k = 0; k < count; k++) {
        if (k + AHEAD < count) fetch_leaf(w, (uint32_t)(ids[k + AHEAD] >> 32));
        if (k + PARENTS_AHEAD < count) fetch_parent(w, (uint32_t)(ids[k + PARENTS_AHEAD] >> 32));
        uint32_t i = (uint32_t)(ids[k] >> 32);
        if (w->marks[i] & MARK_LEFT) settle_box(w, i);
    }
}

static void validate_some(void *work, uint32_t first, uint32_t end, uint32_t worker) {
    const moves *m = work;
    gathered *g = &m->w->gathered[worker];
    for (uint32_t k = first; k < end; k++) {
        if (k && m->ids[k] >> 32 <= m->ids[k - 1] >> 32) g->is_unordered = 1;
        if (validate_move(m->w, m->ids[k], &m->poses[k], k, NULL) == OVOID_OK) continue;
        if (k < g->refused) g->refused = k;
        return;
    }
}

// 1 if no body is named twice, all being named by valid ids.
static int are_different(ovoid_world *w, const ovoid_id *ids, uint32_t count) {
    int found = 1;
    for (uint32_t k = 0; k < count; k++) {
        uint8_t *mark = &w->marks[ids[k] >> 32];
        if (*mark & MARK_NAMED) found = 0;
        *mark |= MARK_NAMED;
    }
    for (uint32_t k = 0; k < count; k++) w->marks[ids[k] >> 32] &= (uint8_t)~MARK_NAMED;
    return found;
}

// OVOID_OK, or what is wrong with a batch; *is_once: no body is named twice, as where the indices rise.
static ovoid_code validate_moves(moves *m, uint32_t count, int *is_once, ovoid_error *error) {
    ovoid_world *w = m->w;
    for (uint32_t i = 0; i < w->threads; i++) w->gathered[i].refused = NONE, w->gathered[i].is_unordered = 0;
    task_host_run(&w->host, &(task){validate_some, m, count, LEAST_VALIDATED});
    uint32_t refused = NONE;
    int is_unordered = 0;
    for (uint32_t i = 0; i < w->threads; i++) {
        if (w->gathered[i].refused < refused) refused = w->gathered[i].refused;
        is_unordered |= w->gathered[i].is_unordered;
    }
    if (refused != NONE) return validate_move(w, m->ids[refused], &m->poses[refused], refused, error);
    *is_once = !is_unordered || are_different(w, m->ids, count);
    return OVOID_OK;
}

static ovoid_code move_many(ovoid_world *w, const ovoid_world_moves *all, ovoid_error *error) {
    OVOID_ASSERT(w && ((all->ids && all->poses) || !all->count));
    if (all->count >= NONE)
        return error_set(error, OVOID_ERROR_LIMIT, -1, "%zu moves: at most %u", all->count, NONE - 1);
    moves m = {w, all->ids, all->poses};
    int is_once;
    ovoid_code code = validate_moves(&m, (uint32_t)all->count, &is_once, error);
    if (code != OVOID_OK) return code;
    if (all->count > 1 && is_once) {
        move_by_all(&m, (uint32_t)all->count);
        return OVOID_OK;
    }
    for (size_t k = 0; k < all->count; k++) {
        uint32_t i = (uint32_t)(all->ids[k] >> 32);
        if (place_body(w, i, &all->poses[k])) body_refresh(w, i);
    }
    return OVOID_OK;
}

ovoid_code ovoid_world_move_many(ovoid_world *w, const ovoid_world_moves *given, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, w, move_many(w, given, error));
}

ovoid_code ovoid_world_move(ovoid_world *w, ovoid_id id, const ovoid_pose *pose, ovoid_error *error) {
    const ovoid_world_moves one = {&id, pose, 1};
    return ovoid_world_move_many(w, &one, error);
}

// ---- the tree over the boxes

static int rebuild(ovoid_world *w) {
    tree_item *items = world_allocate(w, w->count, sizeof *items);
    if (!items) return 0;
    uint32_t at = 0;
    for (uint32_t i = 0; i < w->used; i++)
        if (w->leaf_of[i] != NONE) items[at++] = (tree_item){w->tree.nodes[w->leaf_of[i]].bounds, i};
    dynamic_tree_build(&w->tree, items, at, w->leaf_of);
    world_release(w, items, w->count, sizeof *items);
    return 1;
}

void world_widen_tree(ovoid_world *w) {
    size_t room = wide_tree_get_capacity(w->tree.leaf_count);
    if (w->tree.wide_count || w->tree.leaf_count < 2) return;
    if (world_reserve(w, (void **)&w->tree.wide, &w->wide_capacity, 0, room, sizeof *w->tree.wide))
        wide_tree_build(&w->tree);
}

int world_mend_tree(ovoid_world *w) {
    // Rebuild the tree if half of the leaves have moved in it, or its cost has grown by a third.
    int worn = w->tree.changes > 64 + w->count / 2;
    if (!worn && w->steps % 16 == 0) worn = dynamic_tree_compute_cost(&w->tree) > 1.33 * w->tree.built;
    if (!worn || w->count < 2) return 0;
    return rebuild(w);
}

void world_set_margin(ovoid_world *w, double margin) {
    w->margin = margin;
    for (uint32_t i = 0; i < w->used; i++)
        if (w->leaf_of[i] != NONE) body_refresh(w, i);
}
