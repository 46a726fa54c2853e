// Contacts for a solver: boxes that fall onto a floor. In each step a world gives the contacts of all pairs; an impulse
// at each point, kept by the point's id from step to step, holds the boxes apart.
#include <ovoid/ovoid.h>

#include <math.h>
#include <stdio.h>

enum { BOXES = 5, STEPS = 240, SWEEPS = 20, POINTS = 64 };

static const double step = 1.0 / 120, gravity = 9.81, half = 0.25;

/// The impulse of a point, found again by its pair and its id.
typedef struct impulse {
    ovoid_id a, b;
    uint32_t id;
    double value;
} impulse;

static impulse kept[POINTS];
static size_t kept_count;

/// The impulse of the last step; NULL: the point is new.
static const impulse *find_impulse(ovoid_id a, ovoid_id b, uint32_t id) {
    for (size_t i = 0; i < kept_count; i++)
        if (kept[i].a == a && kept[i].b == b && kept[i].id == id) return &kept[i];
    return NULL;
}

/// The body of an id: the floor is 0, the boxes follow. Here they move along z alone.
typedef struct boxes {
    ovoid_id ids[BOXES + 1];
    double z[BOXES + 1], speed[BOXES + 1];
} boxes;

static size_t find_box(const boxes *all, ovoid_id id) {
    size_t i = 0;
    while (all->ids[i] != id) i++;
    return i;
}

/// Impulses along the normals, by sweeps over all points (projected Gauss-Seidel). Returns how many ids were known.
static size_t solve(boxes *all, const ovoid_world_manifolds *found) {
    size_t count = 0, known = 0;
    impulse next[POINTS];
    for (size_t k = 0; k < found->count; k++) {
        const ovoid_world_manifold *pair = &found->items[k];
        const ovoid_manifold_points *points = &found->points[pair->first];
        for (uint32_t i = 0; i < points->count && count < POINTS; i++) {
            const uint32_t id = points->points[i].id;
            const impulse *last = find_impulse(pair->a, pair->b, id);
            next[count++] = (impulse){pair->a, pair->b, id, last ? last->value : 0};
            known += last != NULL;
        }
    }
    for (int sweep = 0; sweep <= SWEEPS; sweep++) {
        size_t at = 0;
        for (size_t k = 0; k < found->count; k++) {
            const ovoid_world_manifold *pair = &found->items[k];
            const ovoid_manifold_points *points = &found->points[pair->first];
            size_t a = find_box(all, pair->a), b = find_box(all, pair->b);
            double n = found->parts[pair->first].manifold.normal.z, inverse = (a > 0) + (b > 0);
            for (uint32_t i = 0; i < points->count && at < count; i++, at++) {
                // The first sweep applies the impulses of the last step; the others let no point come nearer than it
                // may.
                double gap = points->points[i].separation, closing = n * (all->speed[b] - all->speed[a]);
                double wanted = gap > 0 ? -gap / step : fmin(0.5, -0.1 * gap / step);
                double change = sweep == 0 ? next[at].value : (wanted - closing) / inverse;
                double value = sweep == 0 ? change : fmax(0, next[at].value + change);
                change = sweep == 0 ? change : value - next[at].value;
                next[at].value = value;
                if (a > 0) all->speed[a] -= n * change;
                if (b > 0) all->speed[b] += n * change;
            }
        }
    }
    kept_count = count;
    for (size_t i = 0; i < count; i++) kept[i] = next[i];
    return known;
}

int main(void) {
    ovoid_error error;
    ovoid_shape *floor = ovoid_shape_create_box((ovoid_vec3){2, 2, 0.5}, NULL, &error);
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){half, half, half}, NULL, &error);
    ovoid_world *world = ovoid_world_create(NULL, &error);
    boxes all = {.z = {-0.5}};
    if (!floor || !box || !world) return 1;
    for (size_t i = 0; i <= BOXES; i++) {
        if (i > 0) all.z[i] = half + (i - 1.0) * (2 * half + 0.05) + 0.05;
        ovoid_world_body body = {.body = {.shape = i ? box : floor, .pose = {{0, 0, all.z[i]}, {1, 0, 0, 0}}}};
        all.ids[i] = ovoid_world_add(world, &body, &error);
        if (!all.ids[i]) return 1;
    }
    size_t begun = 0, ended = 0, known = 0;
    for (int t = 0; t < STEPS; t++) {
        ovoid_world_manifold_query query = {.options = {.margin = 0.02}, .ahead = 1};
        ovoid_world_manifolds found;
        if (ovoid_world_compute_manifolds(world, &query, &found, &error) != OVOID_OK) return 1;
        begun += found.begun;
        ended += found.ended_count;
        for (size_t i = 1; i <= BOXES; i++) all.speed[i] -= gravity * step;
        known = solve(&all, &found);
        for (size_t i = 1; i <= BOXES; i++) {
            all.z[i] += all.speed[i] * step;
            const ovoid_pose pose = {{0, 0, all.z[i]}, {1, 0, 0, 0}};
            if (ovoid_world_move(world, all.ids[i], &pose, &error) != OVOID_OK) return 1;
        }
    }
    double top = BOXES * 2 * half - half;
    printf("%zu contacts began, %zu ended; at rest %zu points were known by their ids\n", begun, ended, known);
    printf("the topmost box is at %.3f, where it stands; its speed is %.3f\n", all.z[BOXES], fabs(all.speed[BOXES]));
    int is_wrong = fabs(all.z[BOXES] - top) > 0.01 || fabs(all.speed[BOXES]) > 0.01 || known != BOXES * 4;
    ovoid_world_destroy(world);
    ovoid_shape_destroy(floor);
    ovoid_shape_destroy(box);
    return is_wrong;
}
