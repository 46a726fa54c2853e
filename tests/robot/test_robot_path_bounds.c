// The bounds that proofs of paths and of matrices stand on, for robots that are made to break them: long thin links,
// wrists that turn many times, hinges one above the other, slides, planar bases, mimics with factors, at three scales.
// Truth: kinematics in long double, straight from the description, at states of the exact path: no vertex may come
// farther than `moved` says, no gap along a normal may fall below its chord by more than `curved` says, and no gap that
// is measured may be above the true one. Long double's own error, some 1e-18 of the lengths, is allowed for by 1e-15;
// bounds must be reached to 0.9 in some trials, so that they are not merely large. In a cell of joint space no gap may
// fall below cell_gap_compute in any state, at its corners or between; that is reached to 0.9 too. Then whole paths are
// swept: no state before free_until may overlap.
#include "check.h"
#include "options.h"
#include "path_machines.h"

#include "robot/matrix/cell_gap.h"
#include "robot/matrix/narrow.h"

enum { TRIALS = 400, SAMPLES = 16, SWEEPS = 40, SWEEP = 300, STATES = 24, OBSTACLES = 6 };

static double moved_most, curved_most, fallen_most; // of what is allowed
static long frees, hits;

// ---- the bounds of an interval

static real dot(ovoid_vec3 n, real3 v) { return n.x * v.x + n.y * v.y + n.z * v.z; }

// The gap of two items along a normal of any length, for a unit one.
static real measure(const real3 *a, const real3 *b, ovoid_vec3 n) {
    real high = -INFINITY, low = INFINITY, length = sqrtl((real)n.x * n.x + (real)n.y * n.y + (real)n.z * n.z);
    for (int i = 0; i < VERTICES; i++) {
        high = fmaxl(high, dot(n, a[i]));
        low = fminl(low, dot(n, b[i]));
    }
    return (low - high) / length;
}

static real compute_far(const real3 *a, const real3 *b) {
    real far = 0;
    for (int i = 0; i < VERTICES; i++)
        far = fmaxl(far, hypotl(hypotl(a[i].x - b[i].x, a[i].y - b[i].y), a[i].z - b[i].z));
    return far;
}

typedef struct interval {
    double begin, end, middle;
    path_state at[3];
} interval;

// A pair of items over an interval: positions in its frame.
static void check_pair(uint64_t *s, const machine *m, const path_work *w, const interval *i, uint32_t pair) {
    const ovoid_robot_cell *c = m->cell;
    const cell_item *a = &cell_items(c)[cell_pairs(c)[pair].a], *b = &cell_items(c)[cell_pairs(c)[pair].b];
    const pair_parts of = {cell_pairs(c)[pair].a, cell_pairs(c)[pair].b, OVOID_ROBOT_NONE, pair};
    uint32_t in = w->pairs[pair].frame;
    path_motion motion = path_get_motion(w, &of);
    real3 middle[2][VERTICES], ends[2][2][VERTICES], at[2][VERTICES];
    ovoid_vec3 normal = random_vec3(s, 1);
    real gaps[2], width = (real)i->end - i->begin, allowed = 1e-15L * (1 + 100 * (real)m->scale);
    place_vertices(m, a, i->middle, in, middle[0]);
    place_vertices(m, b, i->middle, in, middle[1]);
    for (int k = 0; k < 2; k++) {
        place_vertices(m, a, k ? i->end : i->begin, in, ends[k][0]);
        place_vertices(m, b, k ? i->end : i->begin, in, ends[k][1]);
        gaps[k] = measure(ends[k][0], ends[k][1], normal);
        path_pair p = path_make_pair(w, (uint32_t)(c->items.count * c->parts.count) + pair, i->at[2 * k].frames);
        CHECK(path_measure(w, &p, i->at[2 * k].frames, normal) - p.motion.rounded <= gaps[k] + allowed);
    }
    for (int k = 0; k <= SAMPLES; k++) {
        real t = (real)k / SAMPLES, v = i->begin + t * width;
        place_vertices(m, a, v, in, at[0]);
        place_vertices(m, b, v, in, at[1]);
        real far = compute_far(at[0], middle[0]) + compute_far(at[1], middle[1]);
        CHECK(far <= (real)motion.moved + allowed);
        if (motion.moved > 0) moved_most = fmax(moved_most, (double)(far / motion.moved));
        real chord = (1 - t) * gaps[0] + t * gaps[1], below = chord - measure(at[0], at[1], normal);
        real most = (real)motion.curved * width * width * t * (1 - t) / 2;
        CHECK(below <= most + allowed);
        if (most > 1e-9L * m->scale) curved_most = fmax(curved_most, (double)(below / most));
    }
}

static void test_bounds(int rounds) {
    uint64_t s = 2024;
    for (int i = 0; i < TRIALS * rounds; i++) {
        check_seed = (uint64_t)i;
        machine m;
        path_work w;
        make_machine(&s, &m);
        ovoid_allocator memory = m.cell->allocator;
        CHECK_EQ(path_work_create(&w, m.cell, &memory, &error), OVOID_OK);
        CHECK_EQ(path_set_segment(&w, m.q[0], m.q[1], INFINITY, &error), OVOID_OK);
        char *room = malloc(3 * path_get_state_size(m.cell) + 1);
        interval x = {.begin = 0};
        double parts = (double)(1u << random_below(&s, 9));
        x.begin = random_below(&s, (uint32_t)parts) / parts;
        x.end = x.begin + 1 / parts;
        x.middle = 0.5 * (x.begin + x.end);
        for (size_t k = 0; k < 3; k++) {
            x.at[k] = path_place_state(m.cell, room + k * path_get_state_size(m.cell));
            path_compute_state(&w, m.q[0], m.q[1], k == 0 ? x.begin : k == 1 ? x.middle : x.end, &x.at[k]);
        }
        path_set_interval(&w, &x.at[1], 0.5 * (x.end - x.begin));
        for (uint32_t k = 0; k < m.cell->pairs.count; k++)
            if (random_below(&s, 3) == 0 || m.cell->pairs.count < 4) check_pair(&s, &m, &w, &x, k);
        free(room);
        path_work_destroy(&w);
        destroy_machine(&m);
    }
    check_seed = 0;
    printf("of the bounds are reached: first order %.3g, second order %.3g\n", moved_most, curved_most);
    CHECK(moved_most > 0.9 && moved_most <= 1.0000001);
    CHECK(curved_most > 0.9 && curved_most <= 1.0000001);
}

// ---- the bounds of a cell

// A direction in a frame, of the pair's bodies; a pair in a cell between two states.
typedef struct cell_normal {
    uint32_t frame;
    ovoid_vec3 in_frame;
} cell_normal;
typedef struct cell_check {
    uint32_t pair;
    const path_state *middle;
    const double *ends[2];
} cell_check;

static real measure_in_state(const machine *m, item_pair of, const real *q, const cell_normal *n) {
    real3 a[VERTICES], b[VERTICES];
    place_in_state(m, &cell_items(m->cell)[of.a], q, n->frame, a);
    place_in_state(m, &cell_items(m->cell)[of.b], q, n->frame, b);
    return measure(a, b, n->in_frame);
}

// Mostly corners.
static void draw_state(uint64_t *s, const machine *m, const double *const ends[2], real *q) {
    uint32_t kind = random_below(s, 4);
    for (size_t i = 0; i < ovoid_robot_get_variable_count(m->r); i++) {
        real t = kind ? (real)random_below(s, 2) : (real)random_uniform(s, 0, 1);
        q[i] = ends[0][i] + t * ((real)ends[1][i] - ends[0][i]);
    }
}

static void check_cell(uint64_t *s, const machine *m, const path_work *w, const cell_check *c) {
    item_pair of = cell_pairs(m->cell)[c->pair];
    cell_gap g;
    CHECK(cell_gap_make(&g, w, c->middle, c->pair));
    cell_normal n = {w->pairs[c->pair].frame, vec3_unit(random_vec3(s, 1))};
    const vec3 world =
        n.frame == OVOID_ROBOT_NONE ? n.in_frame : mat3_mul_vec3(c->middle->frames[n.frame].matrix, n.in_frame);
    double least = cell_gap_compute(&g, vec3_unit(world), -INFINITY), off = w->errors[of.a] + w->errors[of.b];
    real q[3 * JOINTS], middle[3 * JOINTS], allowed = 1e-15L * (1 + 100 * (real)m->scale);
    for (size_t i = 0; i < ovoid_robot_get_variable_count(m->r); i++) middle[i] = w->state[i];
    real gap = measure_in_state(m, of, middle, &n), fallen = 0;
    // The normal that is turned into the world and back is off by some roundings.
    real turned = 1e-14L * (1 + 100 * (real)m->scale) +
                  2 * w->frame_errors[n.frame == OVOID_ROBOT_NONE ? 0 : n.frame].quaternion * 100 * (real)m->scale;
    for (int k = 0; k < STATES; k++) {
        draw_state(s, m, c->ends, q);
        real now = measure_in_state(m, of, q, &n);
        CHECK(now >= least - off - turned - allowed);
        fallen = fmaxl(fallen, gap - now);
    }
    if (gap - least > 1e-6L * m->scale) fallen_most = fmax(fallen_most, (double)(fallen / (gap - least)));
}

static void check_cells(uint64_t *s, const machine *m, path_work *whole, void *room) {
    size_t count = ovoid_robot_get_variable_count(m->r);
    double ends[2][3 * JOINTS], part = ldexp(1, -(int)random_below(s, 12));
    for (size_t i = 0; i < count; i++) {
        double from = random_uniform(s, 0, 1 - part), way = fmin(fmax(m->q[1][i] - m->q[0][i], -3), 3);
        ends[0][i] = m->q[0][i] + from * way;
        ends[1][i] = m->q[0][i] + (from + part) * way;
    }
    path_state middle = path_place_state(m->cell, room);
    narrow_work narrow;
    CHECK(narrow_create(&narrow, whole));
    for (uint32_t k = 0; k < m->cell->group_pairs.count; k++) {
        const group_pair *g = &cell_group_pairs(m->cell)[k];
        const uint32_t groups[2] = {g->a, g->b};
        narrow_choose(&narrow, g->a, g->b);
        CHECK_EQ(path_set_segment(&narrow.w, ends[0], ends[1], INFINITY, &error), OVOID_OK);
        path_compute_frames(&narrow.w, ends[0], ends[1], 0.5, &middle);
        for (int side = 0; side < 2; side++)
            for (uint32_t i = cell_groups(m->cell)[groups[side]].first; i < cell_groups(m->cell)[groups[side]].end; i++)
                path_set_item(&narrow.w, &middle, i, 0.5);
        cell_check check = {g->first, &middle, {ends[0], ends[1]}};
        if (random_below(s, 3) == 0 || m->cell->pairs.count < 4) check_cell(s, m, &narrow.w, &check);
    }
    narrow_destroy(&narrow);
}

static void test_cells(int rounds) {
    uint64_t s = 77;
    for (int i = 0; i < TRIALS * rounds; i++) {
        check_seed = (uint64_t)i;
        machine m;
        path_work w;
        make_machine(&s, &m);
        ovoid_allocator memory = m.cell->allocator;
        CHECK_EQ(path_work_create(&w, m.cell, &memory, &error), OVOID_OK);
        char *room = malloc(path_get_state_size(m.cell) + 1);
        check_cells(&s, &m, &w, room);
        free(room);
        path_work_destroy(&w);
        destroy_machine(&m);
    }
    check_seed = 0;
    printf("of the bounds of cells are reached: %.3g\n", fallen_most);
    CHECK(fallen_most > 0.9 && fallen_most <= 1.0000001);
}

// ---- whole paths

static void test_sweeps(int rounds) {
    uint64_t s = 99;
    for (int i = 0; i < SWEEPS * rounds; i++) {
        check_seed = (uint64_t)i;
        machine m;
        make_machine(&s, &m);
        for (int k = 0; k < OBSTACLES; k++) {
            ovoid_body body = {.shape = m.shapes[k % 3], .pose = random_pose(&s, 1.5 * m.scale)};
            CHECK(ovoid_robot_cell_add(m.cell, &body, &error) != 0);
        }
        ovoid_robot_checker *x = ovoid_robot_checker_create(m.cell, NULL, &error);
        size_t n = ovoid_robot_get_variable_count(m.r);
        double states[2 * 3 * JOINTS];
        memcpy(states, m.q[0], n * sizeof *states);
        memcpy(states + n, m.q[1], n * sizeof *states);
        ovoid_robot_path path = {states, 2};
        ovoid_robot_path_options o = {.query = {.limit_slack = INFINITY, .without_self = 1}, .states = 20000};
        ovoid_robot_path_answer is;
        CHECK_EQ(ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, &o}, &is, &error), OVOID_OK);
        frees += is.status == OVOID_ROBOT_FREE, hits += is.status == OVOID_ROBOT_HIT;
        // Most of them where a hit would be first missed: at the end of what is free.
        for (int k = 0; k < SWEEP * rounds && is.free_until > 0; k++)
            sweep_state(&m, is.free_until * (1 - pow(random_uniform(&s, 0, 1), 3)));
        ovoid_robot_checker_destroy(x);
        destroy_machine(&m);
    }
    check_seed = 0;
    printf("swept: %ld free, %ld hit\n", frees, hits);
    CHECK(frees > 5 && hits > 5);
}

// test_robot_path_bounds [ROUNDS]: as many times the trials, each sweep as many times as dense.
int main(int argc, char **argv) {
    uint64_t wanted = 1;
    const test_option options[] = {{"rounds", "how many (1)", &wanted, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, argc, argv);
    if (code >= 0) return code;
    int rounds = (int)wanted;
    test_bounds(rounds);
    test_cells(rounds);
    test_sweeps(rounds);
    return check_end();
}
