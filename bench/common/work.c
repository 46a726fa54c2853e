// Placing the bodies. The signed distance along a line through A is a convex function of the place on it, so beyond its
// minimum bisection finds where it has a given value; ovoid measures it, with a proof.
#include "common/work.h"

#include "common/random.h"

#include <stdio.h>
#include <stdlib.h>

static ovoid_vec3 add_scaled(ovoid_vec3 a, ovoid_vec3 b, double s) {
    return (ovoid_vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

const char *placement_get_name(placement place) {
    static const char *const names[PLACE_COUNT] = {"gap 500%", "gap 50%", "gap 10%", "gap 1%", "deep 1%", "over 30%"};
    return names[place];
}

static double get_gap(placement place) {
    static const double gaps[PLACE_COUNT] = {5, 0.5, 0.1, 0.01, -0.01, 0};
    return gaps[place];
}

static unsigned get_questions(placement place) {
    unsigned collide = 1u << QUESTION_COLLIDE, within = 1u << QUESTION_WITHIN, distance = 1u << QUESTION_DISTANCE;
    return place >= PLACE_SLIGHT ? collide | 1u << QUESTION_DEPTH : collide | within | distance;
}

ovoid_pair workload_get_pair(const workload *work, uint32_t index) {
    const placed *p = &work->pairs[index];
    return (ovoid_pair){work->bodies[p->a].shape, work->bodies[p->b].shape, p->pose_a, p->pose_b};
}

/// A workload with room for its pairs, which are returned; NULL if memory runs out.
static placed *make_room(workload *work, const char *name, const bodies *all, uint32_t pairs) {
    *work = (workload){.bodies = all->items, .body_count = all->count, .pair_count = pairs};
    (void)snprintf(work->name, sizeof work->name, "%s", name);
    work->vertices = all->items[all->count - 1].vertex_count;
    for (uint32_t i = 0; i < all->count; i++)
        if (all->items[i].vertex_count != work->vertices) work->vertices = 0;
    placed *room = calloc(pairs, sizeof *room);
    work->pairs = room;
    return room;
}

void workload_destroy(workload *work) {
    free((placed *)work->pairs);
    work->pairs = NULL;
}

/// Puts B along u from A so that the centres of the enclosing spheres are t apart.
static void put_at(const workload *work, placed *p, ovoid_vec3 u, double t) {
    ovoid_vec3 centers[2];
    for (int i = 0; i < 2; i++) {
        const ovoid_shape *shape = work->bodies[i ? p->b : p->a].shape;
        ovoid_vec3 local =
            add_scaled(ovoid_shape_get_measures(shape).sphere_center, ovoid_shape_get_polytope(shape).origin, 1);
        ovoid_pose pose = {{0, 0, 0}, i ? p->pose_b.rotation : p->pose_a.rotation};
        centers[i] = ovoid_pose_compute_point(&pose, local);
    }
    p->pose_b.position = add_scaled(add_scaled(add_scaled(p->pose_a.position, centers[0], 1), centers[1], -1), u, t);
}

/// Moves B along u until the signed distance is the gap; returns t.
static double put_with_gap(const workload *work, placed *p, ovoid_vec3 u, double gap) {
    double low = 0, high = p->size + (gap > 0 ? gap : 0);
    for (int i = 0; i < 40 && high - low > 1e-9 * p->size; i++) {
        double t = 0.5 * (low + high);
        put_at(work, p, u, t);
        ovoid_pair pair = {work->bodies[p->a].shape, work->bodies[p->b].shape, p->pose_a, p->pose_b};
        ovoid_answer answer = gap < 0 ? ovoid_depth(&pair, NULL, NULL, NULL) : ovoid_distance(&pair, NULL, NULL);
        if (answer.upper < gap)
            low = t;
        else
            high = t;
    }
    put_at(work, p, u, high);
    return high;
}

/// One margin for all, 5 % of the mean size.
static void set_margins(placed *pairs, uint32_t count) {
    double sum = 0;
    for (uint32_t i = 0; i < count; i++) sum += pairs[i].size;
    for (uint32_t i = 0; i < count; i++) pairs[i].margin = 0.05 * sum / count;
}

/// A pair in random orientations somewhere within ten sizes of the world's origin.
static placed make_placed(const workload *work, uint32_t a, uint32_t b, uint64_t *state) {
    placed p = {.a = a, .b = b};
    p.size = body_get_reach(&work->bodies[a]) + body_get_reach(&work->bodies[b]);
    p.pose_a.rotation = random_rotation(state);
    p.pose_b.rotation = random_rotation(state);
    ovoid_vec3 u = random_unit(state);
    p.pose_a.position = add_scaled((ovoid_vec3){0, 0, 0}, u, random_uniform(state, 0, 10) * p.size);
    return p;
}

/// Puts B along u as the placement says; returns the distance of the centres.
static double put_as(const workload *work, placed *p, ovoid_vec3 u, placement place) {
    if (place != PLACE_OVER) return put_with_gap(work, p, u, get_gap(place) * p->size);
    put_at(work, p, u, 0.3 * p->size);
    return 0.3 * p->size;
}

workload workload_create_still(const char *name, const bodies *all, placement place) {
    workload work;
    placed *pairs = make_room(&work, name, all, all->count);
    uint64_t state = 1;
    for (uint32_t i = 0; pairs && i < all->count; i++) {
        pairs[i] = make_placed(&work, i, (i + 1) % all->count, &state);
        (void)put_as(&work, &pairs[i], random_unit(&state), place);
    }
    if (pairs) set_margins(pairs, work.pair_count);
    work.questions = get_questions(place);
    return work;
}

/// p rotated by the angle about the axis: the quaternion is multiplied from the left.
static ovoid_quat rotate(ovoid_quat p, ovoid_vec3 axis, double angle) {
    double w = cos(angle / 2), s = sin(angle / 2), x = s * axis.x, y = s * axis.y, z = s * axis.z;
    ovoid_quat q = {w * p.w - x * p.x - y * p.y - z * p.z, w * p.x + x * p.w + y * p.z - z * p.y,
                    w * p.y - x * p.z + y * p.w + z * p.x, w * p.z + x * p.y - y * p.x + z * p.w};
    double n = sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return (ovoid_quat){q.w / n, q.x / n, q.y / n, q.z / n};
}

/// u moved on the unit sphere by a small step across it.
static ovoid_vec3 step_across(ovoid_vec3 u, ovoid_vec3 across, double step) {
    double along = u.x * across.x + u.y * across.y + u.z * across.z;
    ovoid_vec3 v = add_scaled(u, add_scaled(across, u, -along), step);
    double n = sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
    return (ovoid_vec3){v.x / n, v.y / n, v.z / n};
}

/// One pair over all frames. pairs: its first frame; the next ones follow at a stride of `tracks`.
static void move_around(const workload *work, placed *pairs, placement place, uint64_t *state) {
    ovoid_vec3 u = random_unit(state), across = random_unit(state), axes[2] = {random_unit(state), random_unit(state)};
    double apart = put_as(work, pairs, u, place);
    for (uint32_t i = work->tracks; i < work->pair_count; i += work->tracks) {
        placed *p = pairs + i;
        *p = pairs[i - work->tracks];
        p->pose_a.rotation = rotate(p->pose_a.rotation, axes[0], 0.01);
        p->pose_b.rotation = rotate(p->pose_b.rotation, axes[1], 0.01);
        u = step_across(u, across, 0.01 * p->size / apart);
        apart = put_as(work, p, u, place);
    }
}

workload workload_create_moving(const char *name, const bodies *all, placement place, uint32_t frames) {
    workload work;
    placed *pairs = make_room(&work, name, all, all->count * frames);
    work.tracks = all->count;
    uint64_t state = 2;
    for (uint32_t i = 0; pairs && i < all->count; i++) {
        pairs[i] = make_placed(&work, i, (i + 1) % all->count, &state);
        move_around(&work, pairs + i, place, &state);
    }
    if (pairs) set_margins(pairs, work.pair_count);
    work.questions = get_questions(place);
    return work;
}

workload workload_create_passing(const char *name, const bodies *all, uint32_t first, uint32_t last, uint32_t frames) {
    workload work;
    uint32_t tracks = last - first + 1;
    placed *pairs = make_room(&work, name, all, tracks * frames);
    work.tracks = tracks;
    work.vertices = 0;
    uint64_t state = 3;
    for (uint32_t i = 0; pairs && i < tracks; i++) {
        placed nearest = make_placed(&work, first + i, 0, &state);
        ovoid_vec3 u = random_unit(&state), across = step_across(u, random_unit(&state), 1);
        // The line of motion: at right angles to u through the nearest point.
        double along = u.x * across.x + u.y * across.y + u.z * across.z;
        ovoid_vec3 way = add_scaled(across, u, -along);
        double n = sqrt(way.x * way.x + way.y * way.y + way.z * way.z);
        (void)put_with_gap(&work, &nearest, u, 0.01 * nearest.size);
        for (uint32_t k = 0; k < frames; k++) {
            placed *p = &pairs[k * tracks + i];
            *p = nearest;
            p->pose_b.position =
                add_scaled(nearest.pose_b.position, way, 0.01 * nearest.size * ((double)k - frames / 2.0) / n);
        }
    }
    if (pairs) set_margins(pairs, work.pair_count);
    work.questions = 1u << QUESTION_COLLIDE | 1u << QUESTION_WITHIN | 1u << QUESTION_DISTANCE;
    return work;
}
