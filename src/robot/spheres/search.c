// Balls that cover points, with few of other points in them. First: centres far from one another (T. F. Gonzalez,
// Clustering to minimize the maximum intercluster distance, 1985), points to the nearest centre, the smallest ball of
// each group (E. Welzl, Smallest enclosing disks, 1991), and again (S. Lloyd, Least squares quantization in PCM, 1982).
// Then moves: a ball is pushed, grown, or taken away to halve another; after each the balls shrink to what they alone
// hold. A move is kept if it is not worse by more than a threshold that falls to zero (G. Dueck, T. Scheuer, Threshold
// accepting, 1990): no exponential function, so the same bits everywhere. Every state covers all points.
#include "robot/spheres/search.h"

#include <stdlib.h>
#include <string.h>

// ---- blocks of points

static int compare_x(const void *a, const void *b) {
    double x = ((const vec3 *)a)->x, y = ((const vec3 *)b)->x;
    return (x > y) - (x < y);
}
static int compare_y(const void *a, const void *b) {
    double x = ((const vec3 *)a)->y, y = ((const vec3 *)b)->y;
    return (x > y) - (x < y);
}
static int compare_z(const void *a, const void *b) {
    double x = ((const vec3 *)a)->z, y = ((const vec3 *)b)->z;
    return (x > y) - (x < y);
}

// Equal keys are told apart by the other coordinates, so that the order does not depend on whose qsort it is.
static int compare_xyz(const void *a, const void *b) {
    int x = compare_x(a, b), y = compare_y(a, b);
    return x ? x : y ? y : compare_z(a, b);
}
static int compare_yzx(const void *a, const void *b) {
    int y = compare_y(a, b), z = compare_z(a, b);
    return y ? y : z ? z : compare_x(a, b);
}
static int compare_zxy(const void *a, const void *b) {
    int z = compare_z(a, b), x = compare_x(a, b);
    return z ? z : x ? x : compare_y(a, b);
}

void spheres_sort_blocks(vec3 *points, uint32_t count) {
    if (count <= BLOCK) return;
    box b = box_make_around(&points[0].x, count);
    double x = b.max.x - b.min.x, y = b.max.y - b.min.y, z = b.max.z - b.min.z;
    qsort(points, count, sizeof *points, x >= y && x >= z ? compare_xyz : y >= z ? compare_yzx : compare_zxy);
    uint32_t half = (count / 2 + BLOCK - 1) / BLOCK * BLOCK;
    spheres_sort_blocks(points, half);
    spheres_sort_blocks(points + half, count - half);
}

static void find_boxes(const vec3 *points, uint32_t count, sample_boxes *boxes) {
    for (uint32_t i = 0; i < count; i += BLOCK)
        boxes->blocks[i / BLOCK] = box_make_around(&points[i].x, count - i < BLOCK ? count - i : BLOCK);
    for (uint32_t i = 0; i < count; i += GROUP)
        boxes->groups[i / GROUP] = box_make_around(&points[i].x, count - i < GROUP ? count - i : GROUP);
}

static int is_in(const sphere *ball, vec3 x) {
    return vec3_norm_squared(vec3_sub(x, ball->center)) <= ball->radius * ball->radius;
}

// 1 where is_in says no of every point of the box.
static int is_away(const sphere *ball, const box *b) {
    vec3 c = ball->center;
    double x = max2(max2(b->min.x - c.x, c.x - b->max.x), 0), y = max2(max2(b->min.y - c.y, c.y - b->max.y), 0),
           z = max2(max2(b->min.z - c.z, c.z - b->max.z), 0);
    return (x * x + y * y) + z * z > ball->radius * ball->radius * (1 + 0x1p-40);
}

// 1 where is_in says yes of every point of the box.
static int is_around(const sphere *ball, const box *b) {
    vec3 c = ball->center;
    double x = max2(b->max.x - c.x, c.x - b->min.x), y = max2(b->max.y - c.y, c.y - b->min.y),
           z = max2(b->max.z - c.z, c.z - b->min.z);
    return (x * x + y * y) + z * z < ball->radius * ball->radius * (1 - 0x1p-40);
}

// Where a ball is to a box: is_in says no of all its points, or yes of all, or not the same of all. One of negative
// radius is no ball.
typedef enum ball_place { BALL_AWAY, BALL_AROUND, BALL_ACROSS } ball_place;

static ball_place find_place(const sphere *ball, const box *b) {
    if (ball->radius < 0 || is_away(ball, b)) return BALL_AWAY;
    return is_around(ball, b) ? BALL_AROUND : BALL_ACROSS;
}

// A block of points, and whether all of them are in a ball.
typedef struct block_range {
    uint32_t first, end;
    int is_whole;
} block_range;

// The next block after *found of which a ball may hold a point; 0: there is none.
static int find_block(const sample_boxes *boxes, uint32_t count, const sphere *ball, block_range *found) {
    for (uint32_t i = found->end; i < count;) {
        if (i % GROUP == 0 && find_place(ball, &boxes->groups[i / GROUP]) == BALL_AWAY) {
            i += GROUP;
            continue;
        }
        ball_place place = find_place(ball, &boxes->blocks[i / BLOCK]);
        *found = (block_range){i, count - i < BLOCK ? count : i + BLOCK, place == BALL_AROUND};
        if (place != BALL_AWAY) return 1;
        i += BLOCK;
    }
    return 0;
}

// A ball that takes the place of another.
typedef struct ball_change {
    const sphere *old, *new;
} ball_change;

// 1 where both balls hold the same points of a box.
static int is_unchanged(const ball_change *c, const box *b) {
    ball_place old = find_place(c->old, b);
    return old != BALL_ACROSS && find_place(c->new, b) == old;
}

// The next block after *found of which one ball may hold a point and the other not.
static int find_changed(const sample_boxes *boxes, uint32_t count, const ball_change *c, block_range *found) {
    for (uint32_t i = found->end; i < count;) {
        if (i % GROUP == 0 && is_unchanged(c, &boxes->groups[i / GROUP])) {
            i += GROUP;
            continue;
        }
        *found = (block_range){i, count - i < BLOCK ? count : i + BLOCK, 0};
        if (!is_unchanged(c, &boxes->blocks[i / BLOCK])) return 1;
        i += BLOCK;
    }
    return 0;
}

// By how much the change alters the number of balls that hold a point.
static int count_change(const ball_change *c, vec3 x) {
    return (c->new->radius >= 0 && is_in(c->new, x)) - (c->old->radius >= 0 && is_in(c->old, x));
}

static void change_hits(spheres_samples *s, const ball_change *c) {
    block_range r = {0, 0, 0};
    while (find_changed(&s->point_boxes, s->point_count, c, &r))
        for (uint32_t i = r.first; i < r.end; i++)
            s->point_hits[i] = (uint16_t)(s->point_hits[i] + count_change(c, s->points[i]));
    r = (block_range){0, 0, 0};
    while (find_changed(&s->outside_boxes, s->outside_count, c, &r))
        for (uint32_t i = r.first; i < r.end; i++) {
            long before = s->outside_hits[i] > 0;
            s->outside_hits[i] = (uint16_t)(s->outside_hits[i] + count_change(c, s->outside[i]));
            s->excess += (s->outside_hits[i] > 0) - before;
        }
}

void spheres_samples_recount(spheres_samples *s) {
    find_boxes(s->points, s->point_count, &s->point_boxes);
    find_boxes(s->outside, s->outside_count, &s->outside_boxes);
    memset(s->point_hits, 0, s->point_count * sizeof *s->point_hits);
    memset(s->outside_hits, 0, s->outside_count * sizeof *s->outside_hits);
    s->excess = 0;
    static const sphere none = {{0, 0, 0}, -1};
    for (uint32_t i = 0; i < s->ball_count; i++) change_hits(s, &(ball_change){&none, &s->balls[i]});
}

void spheres_samples_gather(spheres_samples *s, uint32_t i) {
    const sphere *ball = &s->balls[i];
    s->own_count = 0;
    block_range r = {0, 0, 0};
    while (find_block(&s->point_boxes, s->point_count, ball, &r))
        for (uint32_t k = r.first; k < r.end; k++)
            if (s->point_hits[k] == 1 && (r.is_whole || is_in(ball, s->points[k])))
                s->own[s->own_count++] = s->points[k];
}

// A radius whose square, rounded, is not below that of any point it was made for.
static sphere widen(sphere ball) { return (sphere){ball.center, ball.radius * (1 + 0x1p-40)}; }

static void replace(spheres_samples *s, uint32_t i, sphere ball) {
    change_hits(s, &(ball_change){&s->balls[i], &ball});
    s->balls[i] = ball;
}

void spheres_samples_fit(spheres_samples *s, uint32_t i, const vec3 *also) {
    spheres_samples_gather(s, i);
    if (also) s->own[s->own_count++] = *also;
    if (s->own_count)
        replace(s, i, widen(sphere_compute_smallest(&s->own[0].x, s->own_count)));
    else
        replace(s, i, (sphere){s->balls[i].center, 0});
}

// ---- the first balls

static uint32_t find_nearest(const spheres_samples *s, uint32_t count, vec3 x, double *square) {
    uint32_t nearest = 0;
    *square = INFINITY;
    for (uint32_t i = 0; i < count; i++) {
        double d = vec3_norm_squared(vec3_sub(x, s->balls[i].center));
        if (d < *square) *square = d, nearest = i;
    }
    return nearest;
}

static uint32_t draw_index(spheres_samples *s, uint32_t count) { return (uint32_t)(random_share(&s->random) * count); }

static void spread_centers(spheres_samples *s, uint32_t count) {
    s->balls[0].center = s->points[draw_index(s, s->point_count)];
    for (uint32_t i = 1; i < count; i++) {
        double farthest = -1;
        for (uint32_t k = 0; k < s->point_count; k++) {
            double square;
            (void)find_nearest(s, i, s->points[k], &square);
            if (square > farthest) farthest = square, s->balls[i].center = s->points[k];
        }
    }
}

static void fit_groups(spheres_samples *s) {
    for (uint32_t i = 0; i < s->ball_count; i++) {
        s->own_count = 0;
        for (uint32_t k = 0; k < s->point_count; k++)
            if (s->point_hits[k] == i) s->own[s->own_count++] = s->points[k];
        if (s->own_count) s->balls[i] = widen(sphere_compute_smallest(&s->own[0].x, s->own_count));
    }
}

void spheres_samples_begin(spheres_samples *s, uint32_t count) {
    enum { ROUNDS = 12 };
    s->ball_count = count;
    for (uint32_t i = 0; i < count; i++) s->balls[i] = (sphere){s->points[0], 0};
    spread_centers(s, count);
    for (int round = 0; round < ROUNDS; round++) {
        double square;
        for (uint32_t k = 0; k < s->point_count; k++)
            s->point_hits[k] = (uint16_t)find_nearest(s, count, s->points[k], &square);
        fit_groups(s);
    }
    spheres_samples_recount(s);
}

// ---- moves

static int is_near(const sphere *a, const sphere *b) {
    return vec3_norm(vec3_sub(a->center, b->center)) <= a->radius + b->radius;
}

// Balls that meet ball i shrink to their own points, one after another from a random one on.
static void shrink_neighbours(spheres_samples *s, uint32_t i) {
    uint32_t first = draw_index(s, s->ball_count);
    for (uint32_t k = 0; k < s->ball_count; k++) {
        uint32_t other = (first + k) % s->ball_count;
        if (other != i && is_near(&s->balls[i], &s->balls[other])) spheres_samples_fit(s, other, NULL);
    }
}

static vec3 draw_step(spheres_samples *s, double size) {
    double x = random_share(&s->random), y = random_share(&s->random), z = random_share(&s->random);
    return (vec3){(2 * x - 1) * size, (2 * y - 1) * size, (2 * z - 1) * size};
}

// Pushes ball i, which keeps its own points, and makes it larger by up to `growth`.
static void push(spheres_samples *s, uint32_t i, double step, double growth) {
    spheres_samples_gather(s, i);
    vec3 center = vec3_add(s->balls[i].center, draw_step(s, step * s->balls[i].radius));
    double radius = s->own_count ? sphere_compute_radius(&s->own[0].x, s->own_count, center) : 0;
    radius = max2(radius, s->balls[i].radius * 0.5) * (1 + growth * random_share(&s->random));
    replace(s, i, widen((sphere){center, radius}));
    shrink_neighbours(s, i);
    spheres_samples_fit(s, i, NULL);
}

// The ball that grows least by taking a point in.
static uint32_t find_taker(const spheres_samples *s, vec3 x, uint32_t but) {
    uint32_t best = but;
    double least = INFINITY;
    for (uint32_t i = 0; i < s->ball_count; i++) {
        double growth = vec3_norm(vec3_sub(x, s->balls[i].center)) - s->balls[i].radius;
        if (i != but && growth < least) least = growth, best = i;
    }
    return best;
}

// Takes ball i away, whose own points go to others, and puts it around half of what the largest ball of some holds.
static void relocate(spheres_samples *s, uint32_t i) {
    spheres_samples_gather(s, i);
    replace(s, i, (sphere){s->balls[i].center, -1});
    // One at a time: the first may let a ball grow over the others.
    for (uint32_t k = 0; k < s->point_count; k++) {
        if (s->point_hits[k]) continue;
        vec3 x = s->points[k];
        spheres_samples_fit(s, find_taker(s, x, i), &x);
    }
    uint32_t split = i;
    for (int tries = 0; tries < 3; tries++) {
        uint32_t k = draw_index(s, s->ball_count);
        if (k != i && (split == i || s->balls[k].radius > s->balls[split].radius)) split = k;
    }
    if (split == i) return;
    spheres_samples_gather(s, split);
    vec3 normal = draw_step(s, 1), middle = s->balls[split].center;
    uint32_t count = 0;
    for (uint32_t k = 0; k < s->own_count; k++)
        if (vec3_dot(vec3_sub(s->own[k], middle), normal) > 0) s->own[count++] = s->own[k];
    if (count == 0) return;
    replace(s, i, widen(sphere_compute_smallest(&s->own[0].x, count)));
    spheres_samples_fit(s, split, NULL);
    shrink_neighbours(s, i);
}

// Takes balls i and k away and cuts what they alone held by a plane: one ball for each side.
static void divide(spheres_samples *s, uint32_t i, uint32_t k) {
    vec3 middle = vec3_scale(vec3_add(s->balls[i].center, s->balls[k].center), 0.5);
    vec3 between = vec3_sub(s->balls[k].center, s->balls[i].center);
    double size = s->balls[i].radius + s->balls[k].radius, apart = vec3_norm(between);
    double kind = random_share(&s->random);
    // Across the line of centres, turned a little; or across an axis of the frame; or any plane.
    vec3 normal = draw_step(s, kind < 0.5 ? 0.5 * apart : 1);
    if (kind < 0.5)
        normal = vec3_add(between, normal);
    else if (kind < 0.8)
        normal = kind < 0.6 ? (vec3){1, 0, 0} : kind < 0.7 ? (vec3){0, 1, 0} : (vec3){0, 0, 1};
    double off = random_share(&s->random);
    middle = vec3_add(middle, draw_step(s, 0.3 * size * off * off * off));
    replace(s, i, (sphere){s->balls[i].center, -1});
    replace(s, k, (sphere){s->balls[k].center, -1});
    for (int side = 0; side < 2; side++) {
        s->own_count = 0;
        for (uint32_t p = 0; p < s->point_count; p++)
            if (s->point_hits[p] == 0 && (side || vec3_dot(vec3_sub(s->points[p], middle), normal) > 0))
                s->own[s->own_count++] = s->points[p];
        if (s->own_count) replace(s, side ? k : i, widen(sphere_compute_smallest(&s->own[0].x, s->own_count)));
    }
    shrink_neighbours(s, i);
    shrink_neighbours(s, k);
}

// A ball of three, the smallest: it is the one to be spared.
static uint32_t draw_small(spheres_samples *s) {
    uint32_t best = draw_index(s, s->ball_count);
    for (int tries = 0; tries < 2; tries++) {
        uint32_t i = draw_index(s, s->ball_count);
        if (s->balls[i].radius < s->balls[best].radius) best = i;
    }
    return best;
}

static void move(spheres_samples *s, double heat) {
    uint32_t i = draw_index(s, s->ball_count), k = draw_index(s, s->ball_count);
    double kind = random_share(&s->random);
    if (kind < 0.04)
        relocate(s, draw_small(s));
    else if (kind < 0.4 && i != k && is_near(&s->balls[i], &s->balls[k]))
        divide(s, i, k);
    else
        push(s, i, 0.01 + 0.3 * heat * random_share(&s->random), kind < 0.5 ? 0.3 * heat : 0.05);
}

static int is_within_region(const spheres_samples *s) {
    for (uint32_t i = 0; i < s->ball_count; i++) {
        vec3 c = s->balls[i].center;
        double r = s->balls[i].radius;
        if (c.x - r < s->region.min.x || c.y - r < s->region.min.y || c.z - r < s->region.min.z ||
            c.x + r > s->region.max.x || c.y + r > s->region.max.y || c.z + r > s->region.max.z)
            return 0;
    }
    return 1;
}

// Balls and hits as they are in `from`.
static void copy_state(spheres_samples *to, const spheres_samples *from) {
    memcpy(to->balls, from->balls, from->ball_count * sizeof *to->balls);
    memcpy(to->point_hits, from->point_hits, from->point_count * sizeof *to->point_hits);
    memcpy(to->outside_hits, from->outside_hits, from->outside_count * sizeof *to->outside_hits);
    to->excess = from->excess;
}

void spheres_samples_improve(spheres_samples *s, spheres_samples *scratch, size_t moves, double hot, double cold) {
    if (s->ball_count < 2) return;
    long allowed = s->excess / 50;
    scratch->ball_count = s->ball_count, scratch->point_count = s->point_count,
    scratch->outside_count = s->outside_count;
    copy_state(scratch, s);
    for (size_t k = 0; k < moves && !watch_is_stopped(s->watch); k++) {
        double heat = hot + (cold - hot) * ((double)k / (double)moves);
        move(s, heat);
        long worse = s->excess - scratch->excess;
        if (worse <= (long)(heat * heat * (double)allowed * random_share(&s->random)) && is_within_region(s))
            copy_state(scratch, s);
        else
            copy_state(s, scratch);
    }
}
