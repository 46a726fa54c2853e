// Spheres that are proven to cover a link. A search covers points of the link with little outside it; the audit then
// names the deepest uncovered point, which is added to the points, until what is left is small; all radii grow by that,
// and the audit proves that nothing is left. The proof is the audit's, whatever the search did.
#include "base/environment.h"
#include "base/error.h"
#include "robot/spheres/search.h"

enum {
    MOVES = 8000,
    SHORT = 1000,
    STARTS = 8,
    STARTS_SHORT = 2,
    PHASES = 10,
    PHASES_SHORT = 2,
    EXCHANGES = 400,
    EXCHANGES_EARLY = 100,
    CELLS = 1 << 14
};

#define HEAT 0.25

// What a search for a cover works with.
typedef struct cover_work {
    const spheres_link *link;
    spheres_samples now, scratch;
    box *boxes;                  ///< all of the samples' boxes
    ovoid_robot_sphere *written; ///< the balls in the caller's unit, for the audit
    spheres_heap heap;
    size_t moves;
    uint64_t seed;
} cover_work;

static void close_work(cover_work *m) {
    const ovoid_allocator *memory = &m->link->memory;
    allocator_release(memory, m->heap.cells);
    allocator_release(memory, m->written);
    allocator_release(memory, m->scratch.outside_hits);
    allocator_release(memory, m->scratch.point_hits);
    allocator_release(memory, m->scratch.balls);
    allocator_release(memory, m->now.own);
    allocator_release(memory, m->boxes);
    allocator_release(memory, m->now.balls);
    allocator_release(memory, m->now.outside_hits);
    allocator_release(memory, m->now.point_hits);
    allocator_release(memory, m->now.outside);
    allocator_release(memory, m->now.points);
}

static void open_boxes(cover_work *m, const ovoid_allocator *memory, size_t points) {
    const size_t counts[] = {points / BLOCK + 1, points / GROUP + 1, OUTSIDE / BLOCK + 1, OUTSIDE / GROUP + 1};
    m->boxes = allocator_allocate(memory, counts[0] + counts[1] + counts[2] + counts[3], sizeof *m->boxes);
    if (!m->boxes) return;
    m->now.point_boxes = (sample_boxes){m->boxes, m->boxes + counts[0]};
    box *outside = m->now.point_boxes.groups + counts[1];
    m->now.outside_boxes = (sample_boxes){outside, outside + counts[2]};
}

static ovoid_code open_work(cover_work *m, const spheres_link *link, size_t balls, ovoid_error *error) {
    const ovoid_allocator *memory = &link->memory;
    size_t room = SAMPLES + SAMPLES_MORE;
    m->link = link;
    m->now.point_room = (uint32_t)room;
    m->now.points = allocator_allocate(memory, room, sizeof *m->now.points);
    m->now.outside = allocator_allocate(memory, OUTSIDE, sizeof *m->now.outside);
    m->now.point_hits = allocator_allocate(memory, room, sizeof *m->now.point_hits);
    m->now.outside_hits = allocator_allocate(memory, OUTSIDE, sizeof *m->now.outside_hits);
    m->now.balls = allocator_allocate(memory, balls, sizeof *m->now.balls);
    open_boxes(m, memory, room);
    m->now.own = allocator_allocate(memory, room + 1, sizeof *m->now.own);
    m->scratch.balls = allocator_allocate(memory, balls, sizeof *m->scratch.balls);
    m->scratch.point_hits = allocator_allocate(memory, room, sizeof *m->scratch.point_hits);
    m->scratch.outside_hits = allocator_allocate(memory, OUTSIDE, sizeof *m->scratch.outside_hits);
    m->written = allocator_allocate(memory, balls, sizeof *m->written);
    if (m->boxes && m->now.points && m->now.outside && m->now.point_hits && m->now.outside_hits && m->now.balls &&
        m->now.own && m->scratch.balls && m->scratch.point_hits && m->scratch.outside_hits && m->written &&
        spheres_heap_open(&m->heap, link, CELLS, NULL) == OVOID_OK)
        return OVOID_OK;
    close_work(m);
    return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a cover of %zu spheres", balls);
}

// ---- points

static vec3 draw_in(uint64_t *random, const box *b) {
    double x = random_share(random), y = random_share(random), z = random_share(random);
    return (vec3){b->min.x + (b->max.x - b->min.x) * x, b->min.y + (b->max.y - b->min.y) * y,
                  b->min.z + (b->max.z - b->min.z) * z};
}

// A random point of a part: of the box around it, enlarged, and brought to the part where it is outside, so that
// corners and edges, on which a cover hangs, get more than their share.
static vec3 draw_point(const spheres_link *link, const spheres_part *part, uint64_t *random) {
    vec3 side = vec3_scale(vec3_sub(part->box.max, part->box.min), 0.2);
    box b = {vec3_sub(part->box.min, side), vec3_add(part->box.max, side)};
    vec3 x = draw_in(random, &b);
    ovoid_answer a = spheres_part_probe(link, part, x);
    return a.status == OVOID_SEPARATED ? vec3_scale(a.point_a, 1 / link->unit) : x;
}

// How many points a search is worth: a short one not many.
static uint32_t choose_count(const cover_work *m, uint32_t most) {
    return m->moves < most / 2 - 1000 ? 2000 + 2 * (uint32_t)m->moves : most;
}

// Points of all parts: of the vertices as many as there is room for at even steps, then random ones.
static void draw_points(cover_work *m) {
    spheres_samples *s = &m->now;
    uint32_t most = choose_count(m, SAMPLES);
    s->point_count = 0;
    for (uint32_t i = 0; i < m->link->part_count; i++) {
        const spheres_part *part = &m->link->parts[i];
        uint32_t end = (uint32_t)((uint64_t)most * (i + 1) / m->link->part_count);
        uint32_t room = (end - s->point_count) / 2, step = room ? part->point_count / room + 1 : 1;
        for (uint32_t k = 0; room && k < part->point_count; k += step) s->points[s->point_count++] = part->points[k];
        while (s->point_count < end) s->points[s->point_count++] = draw_point(m->link, part, &s->random);
    }
    if (s->point_count == 0) s->points[s->point_count++] = m->link->points[0];
    spheres_sort_blocks(s->points, s->point_count);
}

static int is_outside(const spheres_link *link, vec3 x) {
    box at = {x, x};
    for (uint32_t i = 0; i < link->part_count; i++)
        if (box_is_overlapping(&at, &link->parts[i].box) && spheres_part_probe(link, &link->parts[i], x).upper <= 0)
            return 0;
    return 1;
}

// Points outside the link in the box of the balls there are.
static void draw_outside(cover_work *m) {
    spheres_samples *s = &m->now;
    box b = m->link->box;
    for (uint32_t i = 0; i < s->ball_count; i++) {
        double r = s->balls[i].radius * 1.25;
        vec3 side = {r, r, r};
        box of_ball = {vec3_sub(s->balls[i].center, side), vec3_add(s->balls[i].center, side)};
        b = box_join(&b, &of_ball);
    }
    s->region = b;
    s->outside_count = 0;
    uint32_t most = choose_count(m, OUTSIDE), tries = 0;
    for (; tries < 2 * most && s->outside_count < most; tries++) {
        vec3 x = draw_in(&s->random, &b);
        if (is_outside(m->link, x)) s->outside[s->outside_count++] = x;
    }
    s->weight = (b.max.x - b.min.x) * (b.max.y - b.min.y) * (b.max.z - b.min.z) / tries;
    spheres_sort_blocks(s->outside, s->outside_count);
    spheres_samples_recount(s);
}

// ---- proof

static ovoid_code audit(cover_work *m, double tolerance, spheres_depth *depth, ovoid_error *error) {
    for (uint32_t i = 0; i < m->now.ball_count; i++)
        m->written[i] = (ovoid_robot_sphere){vec3_scale(m->now.balls[i].center, m->link->unit),
                                             max2(m->now.balls[i].radius, 0) * m->link->unit};
    spheres_tree tree;
    ovoid_code code = spheres_tree_open(&tree, m->written, m->now.ball_count, m->link, error);
    if (code != OVOID_OK) return code;
    *depth = spheres_find_depth(m->link, &tree, tolerance, &m->heap);
    depth->sphere = tree.given[depth->sphere];
    spheres_tree_close(&tree);
    return OVOID_OK;
}

// Adds the deepest uncovered point, and what covers it, until none is deeper than about the tolerance.
static ovoid_code exchange(cover_work *m, int rounds, double tolerance, ovoid_error *error) {
    spheres_samples *s = &m->now;
    for (int round = 0; round < rounds; round++) {
        spheres_depth depth;
        ovoid_code code = audit(m, tolerance, &depth, error);
        if (code != OVOID_OK || depth.lower <= tolerance || s->point_count == s->point_room) return code;
        spheres_samples_fit(s, depth.sphere, &depth.point);
        s->points[s->point_count] = depth.point;
        s->point_hits[s->point_count++] = 0;
        spheres_samples_recount(s);
    }
    return OVOID_OK;
}

// Radii grow by what is proven to suffice, at the end by more each time: one ball around all ends it.
static ovoid_code finish(cover_work *m, double tolerance, spheres_depth *depth, ovoid_error *error) {
    for (int round = 0;; round++) {
        ovoid_code code = audit(m, tolerance / 4, depth, error);
        if (code != OVOID_OK || depth->upper <= 0) return code;
        double growth = ldexp(depth->upper + 4 * m->link->pad, round < 4 ? 0 : round - 4);
        for (uint32_t i = 0; i < m->now.ball_count; i++)
            m->now.balls[i].radius = max2(m->now.balls[i].radius, 0) + growth;
    }
}

// The best of several beginnings, each improved a little.
static void make_start(cover_work *m, uint32_t count) {
    spheres_samples *s = &m->now;
    double least = INFINITY;
    int starts = count == 1 ? 1 : m->moves < SHORT ? STARTS_SHORT : STARTS;
    for (int start = 0; start < starts; start++) {
        s->outside_count = 0;
        spheres_samples_begin(s, count);
        draw_outside(m);
        spheres_samples_improve(s, &m->scratch, m->moves / (4 * (size_t)starts), 0.7, 0);

        double excess = s->weight * (double)s->excess;
        if (!(excess < least)) continue;
        least = excess;
        for (uint32_t i = 0; i < count; i++)
            m->written[i] = (ovoid_robot_sphere){s->balls[i].center, s->balls[i].radius};
    }
    for (uint32_t i = 0; i < count; i++) s->balls[i] = (sphere){m->written[i].center, m->written[i].radius};
}

static ovoid_code make_cover(cover_work *m, uint32_t count, spheres_depth *depth, ovoid_error *error) {
    double tolerance = 3e-4 * spheres_link_get_size(m->link);
    ovoid_code code = OVOID_OK;
    // Each phase ends with audits, which a short search does not pay for.
    int phases = m->moves < SHORT ? PHASES_SHORT : PHASES, warm = phases / 2;
    m->now.random = m->seed;
    draw_points(m);
    make_start(m, count);
    for (int phase = 0; code == OVOID_OK && phase < phases; phase++) {
        double hot = phase < warm ? HEAT * (1 - (double)phase / warm) : 0, cold = max2(hot - HEAT / warm, 0);
        draw_outside(m);
        spheres_samples_improve(&m->now, &m->scratch, 3 * m->moves / (4 * (size_t)phases), hot, cold);
        code = exchange(m, phase + 1 < phases ? EXCHANGES_EARLY : EXCHANGES, tolerance, error);
    }
    return code == OVOID_OK ? finish(m, tolerance, depth, error) : code;
}

// How far a ball stands out of the link, at most: no farther than out of one part, of which the farthest point of the
// ball is its radius farther than its centre.
static double find_excess(const cover_work *m) {
    double most = 0;
    for (uint32_t i = 0; i < m->now.ball_count; i++) {
        double least = INFINITY;
        for (uint32_t k = 0; k < m->link->part_count; k++)
            least = min2(least, spheres_part_probe(m->link, &m->link->parts[k], m->now.balls[i].center).upper);
        most = max2(most, least + m->now.balls[i].radius * m->link->unit);
    }
    return most * (1 + 8 * ROUNDING);
}

// Tries with one more ball each time, or an eighth more.
static ovoid_code make_fewest(cover_work *m, size_t room, double excess, spheres_depth *depth, ovoid_error *error) {
    double best = INFINITY;
    for (size_t count = 1; count <= room; count += 1 + count / 8) {
        ovoid_code code = make_cover(m, (uint32_t)count, depth, error);
        if (code != OVOID_OK) return code;
        double reached = find_excess(m);
        if (reached <= excess) return OVOID_OK;
        best = min2(best, reached);
        if (watch_is_stopped(m->now.watch)) break;
    }
    return error_set(error, OVOID_ERROR_LIMIT, (int64_t)room,
                     "no cover of at most %zu spheres stands out by %g or less; the best by %g: give more spheres",
                     room, excess, best);
}

static ovoid_code cover_link(const spheres_link *link, const ovoid_robot_cover_options *o,
                             ovoid_robot_sphere_cover *cover, ovoid_error *error) {
    cover_work m = {.moves = o->rounds ? o->rounds : MOVES, .seed = o->seed};
    ovoid_code code = open_work(&m, link, cover->capacity, error);
    if (code != OVOID_OK) return code;
    m.now.watch = m.heap.watch = &o->watch;
    spheres_depth depth;
    code = o->excess > 0 ? make_fewest(&m, cover->capacity, o->excess, &depth, error)
                         : make_cover(&m, (uint32_t)cover->capacity, &depth, error);
    if (code == OVOID_OK) {
        cover->count = m.now.ball_count;
        for (size_t i = 0; i < cover->count; i++) cover->spheres[i] = m.written[i];
        cover->depth = (ovoid_robot_bracket){depth.lower * link->unit, depth.upper * link->unit};
    }
    close_work(&m);
    return code;
}

static ovoid_code validate(const ovoid_robot_cover_options *o, size_t capacity, ovoid_error *error) {
    if (capacity < 1 || capacity > SPHERES_MOST)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "room for %zu spheres: give 1 to %d", capacity, SPHERES_MOST);
    if (!(o->excess >= 0) || isinf(o->excess))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "the excess %g is no length: give one >= 0", o->excess);
    return OVOID_OK;
}

static ovoid_code compute_cover(const ovoid_robot *robot, const ovoid_robot_cover_options *options,
                                ovoid_robot_sphere_cover *cover, ovoid_error *error) {
    static const ovoid_robot_cover_options none;
    if (!options) options = &none;
    if (!robot || !cover || !cover->spheres)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "no robot, or no room for spheres (NULL)");
    ovoid_code code = validate(options, cover->capacity, error);
    if (code != OVOID_OK) return code;
    ovoid_allocator memory = allocator_make(options->allocator);
    spheres_link link;
    code = spheres_link_open(&link, robot, cover->link, &memory, error);
    if (code != OVOID_OK) return code;
    code = cover_link(&link, options, cover, error);
    spheres_link_close(&link);
    return code;
}

ovoid_code ovoid_robot_compute_sphere_cover(const ovoid_robot *robot, const ovoid_robot_cover_options *options,
                                            ovoid_robot_sphere_cover *cover, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, robot, compute_cover(robot, options, cover, error));
}
