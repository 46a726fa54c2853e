// The bounds that proofs of paths stand on, for robots that are made to break them: long thin links, wrists that turn
// many times, hinges one above the other, slides, planar bases, mimics with factors, at three scales. Truth: kinematics
// in long double, straight from the description, at states of the exact path: no vertex may come farther than `moved`
// says, no gap along a normal may fall below its chord by more than `curved` says, and no gap that is measured may be
// above the true one. Long double's own error, some 1e-18 of the lengths, is allowed for by 1e-15; bounds must be
// reached to 0.9 in some trials, so that they are not merely large. Then whole paths are swept: no state before
// free_until may overlap.
#include "check.h"
#include "options.h"
#include "robots.h"

#include "robot/path/motion.h"

#include <math.h>

enum { JOINTS = 8, TRIALS = 400, SAMPLES = 16, SWEEPS = 40, SWEEP = 300, OBSTACLES = 6, VERTICES = 8 };
typedef long double real;
typedef struct real3 {
    real x, y, z;
} real3;
typedef struct frame {
    real m[3][3];
    real3 p;
} frame;

static ovoid_error error;
static double moved_most, curved_most; // of what is allowed
static long frees, hits;

// ---- kinematics in long double

static frame multiply(const frame *a, const frame *b) {
    frame c;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            c.m[i][k] = a->m[i][0] * b->m[0][k] + a->m[i][1] * b->m[1][k] + a->m[i][2] * b->m[2][k];
    c.p = (real3){a->m[0][0] * b->p.x + a->m[0][1] * b->p.y + a->m[0][2] * b->p.z + a->p.x,
                  a->m[1][0] * b->p.x + a->m[1][1] * b->p.y + a->m[1][2] * b->p.z + a->p.y,
                  a->m[2][0] * b->p.x + a->m[2][1] * b->p.y + a->m[2][2] * b->p.z + a->p.z};
    return c;
}

static real3 apply(const frame *a, real3 v) {
    return (real3){a->m[0][0] * v.x + a->m[0][1] * v.y + a->m[0][2] * v.z + a->p.x,
                   a->m[1][0] * v.x + a->m[1][1] * v.y + a->m[1][2] * v.z + a->p.y,
                   a->m[2][0] * v.x + a->m[2][1] * v.y + a->m[2][2] * v.z + a->p.z};
}

// The rotation of a quaternion of any length.
static frame turn_by(real w, real x, real y, real z) {
    real s = 2 / (w * w + x * x + y * y + z * z);
    return (frame){{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                    {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
                    {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}},
                   {0, 0, 0}};
}

static frame make_frame(const ovoid_pose *p) {
    frame f = turn_by(p->rotation.w, p->rotation.x, p->rotation.y, p->rotation.z);
    f.p = (real3){p->position.x, p->position.y, p->position.z};
    return f;
}

static real get_value(const ovoid_robot *r, uint32_t joint, const real *q) {
    const ovoid_robot_joint *j = &ovoid_robot_get_description(r).joints[joint];
    if (j->mimic == OVOID_ROBOT_NONE) return q[ovoid_robot_get_joint_variable(r, joint)];
    return j->multiplier * get_value(r, j->mimic, q) + j->offset;
}

static frame move_joint(const ovoid_robot *r, uint32_t joint, const real *q) {
    const ovoid_robot_joint *j = &ovoid_robot_get_description(r).joints[joint];
    real n = sqrtl((real)j->axis.x * j->axis.x + (real)j->axis.y * j->axis.y + (real)j->axis.z * j->axis.z);
    real x = j->axis.x / n, y = j->axis.y / n, z = j->axis.z / n, angle = 0;
    real3 by = {0, 0, 0};
    if (j->type == OVOID_JOINT_PLANAR) { // about z here: the plane's directions are x and y
        const real *v = q + ovoid_robot_get_joint_variable(r, joint);
        by = (real3){v[0], v[1], 0};
        angle = v[2];
    } else if (j->type == OVOID_JOINT_PRISMATIC) {
        real v = get_value(r, joint, q);
        by = (real3){v * x, v * y, v * z};
    } else if (j->type != OVOID_JOINT_FIXED)
        angle = get_value(r, joint, q);
    frame f = turn_by(cosl(angle / 2), x * sinl(angle / 2), y * sinl(angle / 2), z * sinl(angle / 2));
    f.p = by;
    return f;
}

// All links' frames; the joints are in order.
static void place(const ovoid_robot *r, const real *q, frame *links) {
    ovoid_robot_description d = ovoid_robot_get_description(r);
    links[0] = turn_by(1, 0, 0, 0);
    for (uint32_t i = 0; i < d.joint_count; i++) {
        frame origin = make_frame(&d.joints[i].origin), moved = move_joint(r, i, q);
        frame at = multiply(&links[d.joints[i].parent], &origin);
        links[d.joints[i].child] = multiply(&at, &moved);
    }
}

// ---- robots that are made to break bounds

typedef struct machine {
    ovoid_robot_link links[JOINTS + 1];
    ovoid_robot_joint joints[JOINTS];
    ovoid_robot_element elements[JOINTS + 1];
    ovoid_shape *shapes[3];
    ovoid_robot *r;
    ovoid_robot_cell *cell;
    double scale, q[2][3 * JOINTS];
} machine;

static const char *const names[JOINTS + 1] = {"a", "b", "c", "d", "e", "f", "g", "h", "i"};

static ovoid_vec3 pick_axis(uint64_t *s) {
    static const ovoid_vec3 axes[4] = {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {1, 0, 0}};
    return random_below(s, 3) ? axes[random_below(s, 4)] : random_vec3(s, 1);
}

static void make_joint(uint64_t *s, machine *m, uint32_t i, int is_tree) {
    static const ovoid_joint_type types[6] = {OVOID_JOINT_REVOLUTE,  OVOID_JOINT_CONTINUOUS, OVOID_JOINT_CONTINUOUS,
                                              OVOID_JOINT_PRISMATIC, OVOID_JOINT_PLANAR,     OVOID_JOINT_REVOLUTE};
    ovoid_robot_joint *j = &m->joints[i];
    double length = random_below(s, 3) ? random_uniform(s, 0, 2) * m->scale : 0;
    *j = (ovoid_robot_joint){.name = names[i],
                             .type = types[random_below(s, 6)],
                             .parent = is_tree ? random_below(s, i + 1) : i,
                             .child = i + 1,
                             .origin = {{length, 0, 0}, {1, 0, 0, 0}},
                             .axis = pick_axis(s),
                             .lower = -1e6,
                             .upper = 1e6,
                             .mimic = OVOID_ROBOT_NONE,
                             .multiplier = 1};
    if (random_below(s, 3) == 0) j->origin.rotation = random_pose(s, 1).rotation;
    if (j->type == OVOID_JOINT_PLANAR) j->axis = (ovoid_vec3){0, 0, 1};
    uint32_t leader = random_below(s, i + 1);
    if (leader == i || !has_one_variable(j) || !has_one_variable(&m->joints[leader]) || random_below(s, 2)) return;
    j->mimic = leader;
    j->multiplier = random_uniform(s, -4, 4);
    j->offset = random_uniform(s, -1, 1);
}

static void make_machine(uint64_t *s, machine *m) {
    static const double scales[3] = {1e-3, 1, 1e3};
    uint32_t count = 1 + random_below(s, JOINTS);
    int is_tree = random_below(s, 2) == 0;
    *m = (machine){.scale = scales[random_below(s, 3)]};
    double c = m->scale;
    m->shapes[0] = ovoid_shape_create_box((ovoid_vec3){c, 1e-4 * c, 1e-4 * c}, NULL, &error);
    m->shapes[1] = ovoid_shape_create_box((ovoid_vec3){0.1 * c, 0.2 * c, 0.05 * c}, NULL, &error);
    m->shapes[2] = ovoid_shape_create_box((ovoid_vec3){0.01 * c, 1e-6 * c, 0.5 * c}, NULL, &error);
    for (uint32_t i = 0; i <= count; i++) {
        m->links[i].name = names[i];
        m->elements[i] = (ovoid_robot_element){i, NULL, m->shapes[random_below(s, 3)], random_pose(s, 0.5 * c), NULL};
    }
    for (uint32_t i = 0; i < count; i++) make_joint(s, m, i, is_tree);
    const ovoid_robot_description d = {.links = m->links,
                                       .link_count = count + 1,
                                       .joints = m->joints,
                                       .joint_count = count,
                                       .elements = m->elements,
                                       .element_count = count + 1};
    m->r = ovoid_robot_create(&d, NULL, &error);
    m->cell = m->r ? ovoid_robot_cell_create(m->r, NULL, &error) : NULL;
    if (!m->cell) printf("%s\n", error.message), exit(1);
    // A wrist may turn many times, or nothing but one joint moves, in which bounds are sharp.
    size_t n = ovoid_robot_get_variable_count(m->r), only = random_below(s, 3) ? n : random_below(s, (uint32_t)n + 1);
    for (size_t i = 0; i < n; i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(m->r, i);
        int is_length = m->joints[v.joint].type == OVOID_JOINT_PRISMATIC ||
                        (m->joints[v.joint].type == OVOID_JOINT_PLANAR && v.component < 2);
        double reach = is_length ? c : random_below(s, 4) ? 1 : 60;
        m->q[0][i] = random_uniform(s, -reach, reach);
        m->q[1][i] = only < n && only != i ? m->q[0][i] : random_uniform(s, -reach, reach);
    }
}

static void destroy_machine(machine *m) {
    ovoid_robot_cell_destroy(m->cell);
    ovoid_robot_destroy(m->r);
    for (int i = 0; i < 3; i++) ovoid_shape_destroy(m->shapes[i]);
}

// ---- the bounds of an interval

// The vertices of an item at s of the exact path, in the frame of a link, or the world's (NONE).
static void place_vertices(const machine *m, const cell_item *item, real s, uint32_t in, real3 *vertices) {
    frame links[JOINTS + 1], own = make_frame(&item->in_link);
    real q[3 * JOINTS];
    size_t n = ovoid_robot_get_variable_count(m->r);
    for (size_t i = 0; i < n; i++) q[i] = m->q[0][i] + s * ((real)m->q[1][i] - m->q[0][i]);
    place(m->r, q, links);
    frame at = multiply(&links[item->side.link], &own);
    ovoid_polytope p = ovoid_shape_get_polytope(item->shape);
    for (uint32_t i = 0; i < VERTICES; i++) {
        const double *v = p.vertices + 3 * (size_t)i;
        real3 x = apply(&at, (real3){v[0], v[1], v[2]});
        if (in != OVOID_ROBOT_NONE) {
            const frame *f = &links[in];
            real3 d = {x.x - f->p.x, x.y - f->p.y, x.z - f->p.z};
            x = (real3){f->m[0][0] * d.x + f->m[1][0] * d.y + f->m[2][0] * d.z,
                        f->m[0][1] * d.x + f->m[1][1] * d.y + f->m[2][1] * d.z,
                        f->m[0][2] * d.x + f->m[1][2] * d.y + f->m[2][2] * d.z};
        }
        vertices[i] = x;
    }
}

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

// ---- whole paths

static ovoid_quat get_rotation(const frame *f) {
    // Of the four forms the one without a small divisor.
    const real(*m)[3] = f->m;
    real t[4] = {1 + m[0][0] + m[1][1] + m[2][2], 1 + m[0][0] - m[1][1] - m[2][2], 1 - m[0][0] + m[1][1] - m[2][2],
                 1 - m[0][0] - m[1][1] + m[2][2]};
    int k = 0;
    for (int i = 1; i < 4; i++) k = t[i] > t[k] ? i : k;
    real x = m[2][1] - m[1][2], y = m[0][2] - m[2][0], z = m[1][0] - m[0][1];
    real xy = m[0][1] + m[1][0], xz = m[0][2] + m[2][0], yz = m[1][2] + m[2][1];
    const real forms[4][4] = {{t[0], x, y, z}, {x, t[1], xy, xz}, {y, xy, t[2], yz}, {z, xz, yz, t[3]}};
    return (ovoid_quat){(double)forms[k][0], (double)forms[k][1], (double)forms[k][2], (double)forms[k][3]};
}

static ovoid_pose find_pose(const frame *links, const cell_item *item) {
    frame own = make_frame(&item->in_link), at = multiply(&links[item->side.link], &own);
    return (ovoid_pose){{(double)at.p.x, (double)at.p.y, (double)at.p.z}, get_rotation(&at)};
}

// At s: no pair may overlap by more than rounding the poses to doubles does.
static void sweep_state(const machine *m, double at) {
    const ovoid_robot_cell *c = m->cell;
    frame links[JOINTS + 1];
    real q[3 * JOINTS];
    for (size_t i = 0; i < ovoid_robot_get_variable_count(m->r); i++)
        q[i] = m->q[0][i] + at * ((real)m->q[1][i] - m->q[0][i]);
    place(m->r, q, links);
    double allowed = 1e-13 * (1 + 100 * m->scale);
    for (size_t i = 0; i < c->items.count; i++) {
        ovoid_pose pose = find_pose(links, &cell_items(c)[i]);
        for (size_t k = 0; k < c->parts.count; k++) {
            ovoid_pair pair = {cell_items(c)[i].shape, cell_parts(c)[k].shape, pose, cell_parts(c)[k].pose};
            ovoid_answer is = ovoid_within(&pair, 0, NULL, NULL);
            if (is.status == OVOID_OVERLAPPING) is = ovoid_depth(&pair, NULL, NULL, NULL);
            CHECK(is.upper > -allowed);
        }
    }
}

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
    test_sweeps(rounds);
    return check_end();
}
