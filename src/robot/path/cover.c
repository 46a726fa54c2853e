// What covers are made of once for a cell: balls and slabs in the links' frames, lengths of the chain, boxes of
// obstacles by their axes.
#include "robot/path/cover.h"

#include "ovoid/query.h"

#include <string.h>

#define UP (1 + 0x1p-40)
// How far a box' axes may be from a group's to be one of it, as cosines: the box is made larger by that.
#define SKEW_MOST 1e-6
// Boxes beyond these are held by larger ones along the axes of the first group.
enum { GROUPS_MOST = 16 };

// ---- items

static outer_ball place_ball(const cell_item *item, outer_ball own, double lengths) {
    return (outer_ball){ovoid_pose_compute_point(&item->in_link, own.center), (own.radius + CELL_SLACK * lengths) * UP};
}

static uint32_t find_nearest(const cover_item *item, vec3 x) {
    uint32_t nearest = 0;
    double least = INFINITY;
    for (uint32_t i = 0; i < item->count; i++) {
        double square = vec3_norm_squared(vec3_sub(x, item->balls[i].center));
        if (square < least) least = square, nearest = i;
    }
    return nearest;
}

static vec3 place_vertex(const cell_item *item, const mat3 *rotation, uint32_t which) {
    vec3 own = vec3_add(item->shape->origin, vec3_at(shape_vertices(item->shape), which));
    return vec3_add(item->in_link.position, mat3_mul_vec3(*rotation, own));
}

// The vertices of an item, cluster by cluster; where the next item's begin.
static double *set_vertices(cover_item *to, const cell_item *item, double *next) {
    mat3 rotation = quat_to_mat3(item->in_link.rotation);
    to->vertices = next;
    to->vertex_count = item->shape->vertex_count;
    for (uint32_t k = 0; k < to->count; k++) {
        vertex_cluster *cluster = &to->clusters[k];
        *cluster = (vertex_cluster){.vertices = next, .center = to->balls[k].center};
        for (uint32_t i = 0; i < to->vertex_count; i++) {
            vec3 x = place_vertex(item, &rotation, i);
            if (find_nearest(to, x) != k) continue;
            next[0] = x.x, next[1] = x.y, next[2] = x.z;
            next += 3;
            cluster->count++;
            cluster->radius = max2(cluster->radius, vec3_norm(vec3_sub(x, cluster->center)) * UP);
        }
    }
    return next;
}

static double *set_item(path_cover *c, uint32_t which, double *vertices) {
    const cell_item *item = &cell_items(c->w->cell)[which];
    const outer_balls *outer = &item->inside->outer;
    cover_item *to = &c->items[which];
    // What a centre, or a vertex, is made up of.
    double lengths = 4 * (item->far + vec3_norm(item->shape->origin) + vec3_norm(item->in_link.position));
    to->one = place_ball(item, outer->one, lengths);
    to->count = outer->count;
    to->link = item->side.link;
    to->far = vec3_norm(to->one.center);
    for (uint32_t i = 0; i < outer->count; i++) {
        to->balls[i] = place_ball(item, outer->balls[i], lengths);
        to->far = max2(to->far, vec3_norm(to->balls[i].center));
    }
    to->far *= UP;
    vertices = set_vertices(to, item, vertices);
    to->hull = (item->shape->lower_radius + 2 * CELL_SLACK * lengths) * UP;
    to->slabs = slabs_find(to->vertices, to->vertex_count, to->hull);
    return vertices;
}

// ---- lengths

static double norm_across(vec3 axis, vec3 v) {
    return (vec3_norm(vec3_cross(axis, v)) + CELL_SLACK * vec3_norm(v)) * UP;
}

// How far the item's centres are from the axis of a step, offsets along the axis of the first one left out.
static double find_lever(const path_cover *c, uint32_t item, uint32_t step, uint32_t beyond) {
    const path_work *w = c->w;
    const cover_item *it = &c->items[item];
    uint32_t child = w->steps[step].child;
    if (child == it->link) {
        double far = norm_across(w->axes[step], it->one.center);
        for (uint32_t i = 0; i < it->count; i++) far = max2(far, norm_across(w->axes[step], it->balls[i].center));
        return far;
    }
    const chain_step *next = &w->steps[beyond];
    double rest = c->lengths[it->link] - c->lengths[next->child] + c->lengths[it->link] * 0x1p-45;
    return (norm_across(w->axes[step], next->origin) + rest + it->far) * UP;
}

// Up from the item; `beyond`: the step before on the way.
static void set_levers(path_cover *c, const uint32_t *maker, uint32_t item) {
    const path_work *w = c->w;
    uint32_t at = w->first[item], beyond = OVOID_ROBOT_NONE;
    for (uint32_t s = maker[c->items[item].link]; s != OVOID_ROBOT_NONE;) {
        const chain_step *step = &w->steps[s];
        if (step->kind != STEP_FIXED) c->levers[at++] = find_lever(c, item, s, beyond);
        beyond = s;
        s = step->parent == OVOID_ROBOT_NONE ? OVOID_ROBOT_NONE : maker[step->parent];
    }
}

static void set_lengths(path_cover *c) {
    const path_work *w = c->w;
    c->lengths[w->cell->robot->root] = 0;
    for (uint32_t i = 0; i < w->step_count; i++) {
        const chain_step *s = &w->steps[i];
        double parent = s->parent == OVOID_ROBOT_NONE ? 0 : c->lengths[s->parent];
        c->lengths[s->child] = (parent + vec3_norm(s->origin)) * UP;
    }
}

// ---- obstacles

// 1: the columns of b are those of a, in any order and of any sign, but for SKEW_MOST; m: the absolute cosines.
static int are_aligned(const mat3 *a, const mat3 *b, mat3 *m) {
    mat3 cosines = mat3_mul(mat3_transpose(*a), *b);
    *m = (mat3){vec3_abs(cosines.r0), vec3_abs(cosines.r1), vec3_abs(cosines.r2)};
    const vec3 rows[3] = {m->r0, m->r1, m->r2};
    for (int i = 0; i < 3; i++) {
        double most = vec3_max_abs(rows[i]);
        if (!(most > 1 - SKEW_MOST) || !((rows[i].x + rows[i].y) + rows[i].z - most < SKEW_MOST)) return 0;
    }
    return 1;
}

static uint32_t find_group(path_cover *c, const oriented_box *b) {
    mat3 m;
    for (uint32_t i = 0; i < c->group_count; i++)
        if (vec3_max_abs(b->half) == 0 || are_aligned(&c->groups[i].rotation, &b->rotation, &m)) return i;
    if (c->group_count == GROUPS_MOST) return 0;
    c->groups[c->group_count] = (cover_group_boxes){b->rotation, 0, 0};
    return c->group_count++;
}

static cover_box make_box(const mat3 *rotation, const oriented_box *b) {
    mat3 cosines = mat3_mul(mat3_transpose(*rotation), b->rotation);
    vec3 center = mat3_mul_transposed_vec3(*rotation, b->center);
    vec3 half = {vec3_dot(vec3_abs(cosines.r0), b->half), vec3_dot(vec3_abs(cosines.r1), b->half),
                 vec3_dot(vec3_abs(cosines.r2), b->half)};
    double size = vec3_sum_abs(b->center) + vec3_sum_abs(b->half);
    return (cover_box){
        {center.x, center.y, center.z}, {half.x, half.y, half.z}, (b->radius + 4 * CELL_SLACK * size) * UP};
}

static void set_boxes(path_cover *c) {
    const ovoid_robot_cell *cell = c->w->cell;
    const cell_part *parts = cell_parts(cell);
    c->group_count = 0;
    for (uint32_t i = 0; i < cell->parts.count; i++) c->group_of[i] = find_group(c, &parts[i].box);
    uint32_t next = 0;
    for (uint32_t g = 0; g < c->group_count; g++) {
        c->groups[g].first = next;
        for (uint32_t i = 0; i < cell->parts.count; i++) {
            if (c->group_of[i] != g) continue;
            c->parts[next] = i;
            c->box_of[i] = next;
            c->boxes[next++] = make_box(&c->groups[g].rotation, &parts[i].box);
        }
        c->groups[g].end = next;
    }
}

// How far an item that nothing moves is from a part, at least: by boxes where they show that it is apart, else exactly.
static double find_gap(const path_cover *c, uint32_t item, uint32_t part, const link_frame *at) {
    const cell_item *it = &cell_items(c->w->cell)[item];
    const cell_part *p = &cell_parts(c->w->cell)[part];
    oriented_box box = item_place_box(it, at, c->w->errors[item]);
    double gap = oriented_boxes_compute_lower(&box, &p->box);
    if (gap > 0) return gap;
    ovoid_pair pair = {it->shape, p->shape, {at->position, at->rotation}, p->pose};
    return ovoid_distance(&pair, NULL, NULL).lower - c->w->errors[item] * UP;
}

static void set_gaps(path_cover *c) {
    path_work *w = c->w;
    path_compute_frames(w, c->segments[0].q0, c->segments[0].q1, 0, &c->state);
    for (uint32_t i = 0; i < w->cell->items.count; i++) {
        c->gaps[i] = -1;
        if (w->first[i] < w->first[i + 1]) continue;
        const link_frame *at = &c->state.frames[cell_items(w->cell)[i].frame];
        c->gaps[i] = INFINITY;
        for (uint32_t k = 0; k < w->cell->parts.count; k++)
            if (path_is_queried(w, i, k)) c->gaps[i] = min2(c->gaps[i], find_gap(c, i, k, at));
    }
}

void cover_renew_boxes(path_cover *c) {
    if (c->moved == c->w->cell->moved) return;
    c->moved = c->w->cell->moved;
    set_boxes(c);
    set_gaps(c);
}

// ---- memory

static size_t count_vertices(const ovoid_robot_cell *cell) {
    size_t count = 0;
    for (size_t i = 0; i < cell->items.count; i++) count += cell_items(cell)[i].shape->vertex_count;
    return count;
}

// The arrays, each at the next multiple of 64 bytes: placed from `at` where that is not NULL. How many bytes they take;
// SIZE_MAX: more than there are.
static size_t place_arrays(path_cover *c, char *at) {
    const ovoid_robot_cell *cell = c->w->cell;
    size_t items = cell->items.count, parts = cell->parts.count, pairs = cell->pairs.count, frames = cell->frame_count;
    size_t numbers = items * parts + pairs, steps = c->w->step_count, links = c->w->first[items];
    const struct {
        void **to;
        size_t count, size;
    } arrays[] = {{(void **)&c->items, items, sizeof *c->items},
                  {(void **)&c->lengths, frames, sizeof *c->lengths},
                  {(void **)&c->levers, links, sizeof *c->levers},
                  {(void **)&c->slides, steps, sizeof *c->slides},
                  {(void **)&c->slacks, 2 * steps, sizeof *c->slacks},
                  {(void **)&c->sums, frames, sizeof *c->sums},
                  {(void **)&c->shares, steps, sizeof *c->shares},
                  {(void **)&c->gaps, items, sizeof *c->gaps},
                  {(void **)&c->groups, GROUPS_MOST, sizeof *c->groups},
                  {(void **)&c->boxes, parts, sizeof *c->boxes},
                  {(void **)&c->some, parts, sizeof *c->some},
                  {(void **)&c->parts, parts, sizeof *c->parts},
                  {(void **)&c->group_of, parts, sizeof *c->group_of},
                  {(void **)&c->box_of, parts, sizeof *c->box_of},
                  {(void **)&c->some_numbers, parts, sizeof *c->some_numbers},
                  {(void **)&c->near, parts, sizeof *c->near},
                  {(void **)&c->some_lanes, parts, sizeof *c->some_lanes},
                  {(void **)&c->swept, cell->boxes.count, 1},
                  {(void **)&c->some_left, parts, sizeof *c->some_left},
                  {(void **)&c->vertices, 3 * count_vertices(cell), sizeof *c->vertices},
                  {(void **)&c->normals, numbers, sizeof *c->normals},
                  {(void **)&c->proofs, numbers, sizeof *c->proofs},
                  {(void **)&c->hit_counts, numbers, 1},
                  {(void **)&c->world, 1, sizeof *c->world},
                  {(void **)&c->still, 1, sizeof *c->still},
                  {(void **)&c->rests, pairs, sizeof *c->rests},
                  {(void **)&c->speeds, steps, sizeof *c->speeds},
                  {(void **)&c->rates, cell->steps.count, sizeof *c->rates},
                  {(void **)&c->segments[0].rates, COVER_SEGMENTS * cell->steps.count, sizeof(step_rate)},
                  {(void **)&c->segments[0].left, COVER_SEGMENTS * c->mask_count, 1},
                  {(void **)&c->is_moving, frames, sizeof *c->is_moving},
                  {(void **)&c->values8, cell->robot->value_count, sizeof *c->values8},
                  {(void **)&c->frames8, cell->robot->link_count, sizeof *c->frames8},
                  {(void **)&c->rates8, cell->robot->link_count, sizeof *c->rates8},
                  {(void **)&c->ones, items, sizeof *c->ones},
                  {(void **)&c->balls, items * OUTER_BALLS, sizeof *c->balls},
                  {(void **)&c->reaches, items, sizeof *c->reaches},
                  {(void **)&c->have_rests, pairs, 1},
                  {(void **)&c->have_one, items, 1},
                  {(void **)&c->have_balls, items, 1},
                  {(void **)&c->lists[0].items, numbers, sizeof *c->lists[0].items},
                  {(void **)&c->lists[1].items, numbers, sizeof *c->lists[1].items},
                  {(void **)&c->lists[2].items, numbers, sizeof *c->lists[2].items},
                  {(void **)&c->carried.items, numbers, sizeof *c->carried.items},
                  {(void **)&c->state_memory, 1, path_get_state_size(cell)}};
    size_t total = 0;
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        if (at) *arrays[i].to = at + total;
        total = allocator_end_array(total, arrays[i].count, arrays[i].size);
    }
    return total;
}

static void set_world(frame8 *f) {
    memset(f, 0, sizeof *f);
    static const int ones[] = {FRAME8_QUATERNION, FRAME8_ROTATION, FRAME8_ROTATION + 4, FRAME8_ROTATION + 8};
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < COVER8; k++) f->column[ones[i]][k] = 1;
}

int path_cover_create(path_cover *c, path_work *w) {
    const ovoid_robot_cell *cell = w->cell;
    *c = (path_cover){.w = w, .kernels = robot8_get_kernels(), .moved = cell->moved - 1};
    c->mask_count = cell->items.count * cell->boxes.count + (cell->pairs.count + ROBOT8 - 1) / ROBOT8;
    size_t total = place_arrays(c, NULL);
    c->block = allocator_allocate(&w->allocator, total, 1);
    uint32_t *maker = allocator_allocate(&w->allocator, w->cell->frame_count, sizeof *maker);
    if (c->block && maker) {
        memset(c->block, 0, total);
        (void)place_arrays(c, c->block);
        for (uint32_t i = 1; i < COVER_SEGMENTS; i++) {
            c->segments[i].rates = c->segments[0].rates + i * cell->steps.count;
            c->segments[i].left = c->segments[0].left + i * c->mask_count;
        }
        c->state = path_place_state(w->cell, c->state_memory);
        set_world(&c->frames8[w->cell->robot->root]);
        set_world(c->world);
        set_lengths(c);
        path_work_find_makers(w, maker);
        double *vertices = c->vertices;
        for (uint32_t i = 0; i < w->cell->items.count; i++) {
            vertices = set_item(c, i, vertices);
            set_levers(c, maker, i);
        }
    }
    int has_memory = c->block && maker;
    allocator_release(&w->allocator, maker);
    if (!has_memory) path_cover_destroy(c);
    return has_memory;
}

void path_cover_destroy(path_cover *c) {
    if (!c->block) return;
    allocator_release(&c->w->allocator, c->block);
    c->block = NULL;
}
