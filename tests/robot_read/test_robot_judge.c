// Verdicts on states and edges of robots, held against kinematics and convex bodies in long double. Truth: of a state,
// each queried pair is APART where a direction leaves a gap between all vertices of both bodies, as posed by
// exact_robot.h; it MEETS where four differences of vertices have the origin inside, or where two points are nearer
// than the rounding radii. Where the direction and the vertices come from does not matter: they are checked here, in
// long double, whose own error of some 1e-17 of the lengths is allowed for by 1e-15. What is neither is OPEN, within
// 1e-9 of touching. An edge is judged at states of the exact line. A free state must have no pair that is not APART, a
// hit must not be APART.
// --states, --edges: a longer run (make soak-robot). Robots of trees with all types of joints; published arms where the
// data is.
#include "exact_robot.h"
#include "options.h"
#include "robot_files.h"
#include "robots.h"

#include "ovoid/ovoid.h"
#include "ovoid/robot_path.h"

enum { BODIES = 96, VERTICES = 512, OBSTACLES = 10, SHAPES = 5, SAMPLES = 64, BATCH = 64, EDGE_BATCH = 8, TREES = 12 };
static const real slack = 1e-15L, near_touch = 1e-9L;

typedef enum truth { APART, MEETS, OPEN } truth;

/// A convex body: of a link, or an obstacle, which is of the root.
typedef struct body {
    const ovoid_shape *shape;
    ovoid_pose in_link;
    uint32_t link;
    ovoid_id id;           ///< of an obstacle; 0: of the robot
    real center[3], bound; ///< a ball around it, in its own frame
} body;

typedef struct setup {
    ovoid_robot *robot;
    ovoid_robot_cell *cell;
    ovoid_robot_checker *checker;
    body bodies[BODIES];
    unsigned char is_queried[BODIES][BODIES];
    size_t count, variables;
} setup;

/// The bodies of a state, in long double.
typedef struct placed {
    exact_frame frame;
    real center[3], points[VERTICES][3];
    int has_points;
} placed;

static ovoid_error error;
static ovoid_shape *shapes[SHAPES];
static placed bodies[BODIES];
static long states_free, states_hit, edges_free, edges_hit, meeting_hits, left_open, undecided, pairs_judged;

// ---- a cell

static void measure(body *b) {
    ovoid_polytope p = ovoid_shape_get_polytope(b->shape);
    if (!CHECK_LE(p.vertex_count, (uint32_t)VERTICES)) exit(1);
    for (int k = 0; k < 3; k++) {
        b->center[k] = 0;
        for (uint32_t i = 0; i < p.vertex_count; i++) b->center[k] += (real)p.vertices[3 * i + k] / p.vertex_count;
    }
    b->bound = 0;
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        real sum = 0;
        for (int k = 0; k < 3; k++) {
            real d = p.vertices[3 * i + k] - b->center[k];
            sum += d * d;
        }
        b->bound = fmaxl(b->bound, sqrtl(sum));
    }
    b->bound = (b->bound + ovoid_shape_get_radius(b->shape)) * (1 + slack);
}

static void add_body(setup *s, body b) {
    if (!CHECK_LE(s->count + 1, (size_t)BODIES)) exit(1);
    measure(&b);
    s->bodies[s->count++] = b;
}

static void find_queried(setup *s) {
    for (size_t i = 0; i < s->count; i++)
        for (size_t k = i + 1; k < s->count; k++) {
            const body *a = &s->bodies[i], *b = &s->bodies[k];
            if (a->id) continue;
            s->is_queried[i][k] = b->id ? !ovoid_robot_cell_is_body_allowed(s->cell, b->id, a->link)
                                        : a->link != b->link && !ovoid_robot_cell_is_allowed(s->cell, a->link, b->link);
        }
}

/// The cell of a robot among obstacles that are about `reach` away.
static void open_cell(uint64_t *random, const ovoid_robot_description *d, double reach, setup *s) {
    s->count = 0;
    memset(s->is_queried, 0, sizeof s->is_queried);
    s->robot = ovoid_robot_create(d, NULL, &error);
    s->cell = s->robot ? ovoid_robot_cell_create(s->robot, NULL, &error) : NULL;
    if (!CHECK(s->cell)) exit(1);
    s->variables = ovoid_robot_get_variable_count(s->robot);
    ovoid_robot_description own = ovoid_robot_get_description(s->robot);
    for (size_t i = 0; i < own.element_count; i++)
        add_body(s,
                 (body){.shape = own.elements[i].shape, .in_link = own.elements[i].pose, .link = own.elements[i].link});
    for (int i = 0; i < OBSTACLES; i++) {
        ovoid_body b = {.shape = shapes[random_below(random, SHAPES)], .pose = random_pose(random, reach)};
        ovoid_id id = ovoid_robot_cell_add(s->cell, &b, &error);
        if (CHECK(id)) add_body(s, (body){b.shape, b.pose, ovoid_robot_get_root(s->robot), id, {0}, 0});
    }
    find_queried(s);
    s->checker = ovoid_robot_checker_create(s->cell, NULL, &error);
    if (!CHECK(s->checker)) exit(1);
}

static void close_cell(setup *s) {
    ovoid_robot_checker_destroy(s->checker);
    ovoid_robot_cell_destroy(s->cell);
    ovoid_robot_destroy(s->robot);
}

// ---- the truth of a state

static void transform(const exact_frame *f, const real *v, real *out) {
    for (int k = 0; k < 3; k++) out[k] = f->p[k] + f->r[k][0] * v[0] + f->r[k][1] * v[1] + f->r[k][2] * v[2];
}

static void place_bodies(const setup *s, const real *q) {
    static exact_frame links[EXACT_LINKS];
    exact_poses_at(s->robot, q, links);
    for (size_t i = 0; i < s->count; i++) {
        const body *b = &s->bodies[i];
        const exact_frame *link = &links[b->link];
        exact_frame local;
        real p[3] = {b->in_link.position.x, b->in_link.position.y, b->in_link.position.z};
        exact_rotation(b->in_link.rotation, local.r);
        multiply((real(*)[3])(uintptr_t)link->r, local.r, bodies[i].frame.r);
        transform(link, p, bodies[i].frame.p);
        transform(&bodies[i].frame, b->center, bodies[i].center);
        bodies[i].has_points = 0;
    }
}

static void place_points(const setup *s, size_t i) {
    if (bodies[i].has_points) return;
    ovoid_polytope p = ovoid_shape_get_polytope(s->bodies[i].shape);
    for (uint32_t k = 0; k < p.vertex_count; k++) {
        real v[3] = {p.vertices[3 * k], p.vertices[3 * k + 1], p.vertices[3 * k + 2]};
        transform(&bodies[i].frame, v, bodies[i].points[k]);
    }
    bodies[i].has_points = 1;
}

static real dot(const real *a, const real *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// The gap along a direction, less both radii and what long double may lose; negative: none.
static real find_gap(const setup *s, size_t a, size_t b, ovoid_vec3 normal) {
    real n[3] = {normal.x, normal.y, normal.z}, norm = sqrtl(dot(n, n)), high = -INFINITY, low = INFINITY;
    if (!(norm > 0)) return -INFINITY;
    uint32_t a_count = ovoid_shape_get_polytope(s->bodies[a].shape).vertex_count;
    uint32_t b_count = ovoid_shape_get_polytope(s->bodies[b].shape).vertex_count;
    for (uint32_t i = 0; i < a_count; i++) high = fmaxl(high, dot(n, bodies[a].points[i]));
    for (uint32_t i = 0; i < b_count; i++) low = fminl(low, dot(n, bodies[b].points[i]));
    real radii = (real)ovoid_shape_get_radius(s->bodies[a].shape) + ovoid_shape_get_radius(s->bodies[b].shape);
    return (low - high) / norm - radii - slack * (fabsl(high) + fabsl(low)) / norm;
}

static real determinant(const real *a, const real *b, const real *c) {
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// Is the origin strictly inside the tetrahedron? Each corner must be on the origin's side of the other three.
static int has_origin(const real *p[4]) {
    int sign = 0;
    for (int i = 0; i < 4; i++) {
        const real *a = p[(i + 1) % 4], *b = p[(i + 2) % 4], *c = p[(i + 3) % 4];
        real volume = (i % 2 ? 1 : -1) * determinant(a, b, c);
        real size = sqrtl(dot(a, a) * dot(b, b) * dot(c, c));
        if (!(fabsl(volume) > slack * size)) return 0;
        if (sign && (volume > 0 ? 1 : -1) != sign) return 0;
        sign = volume > 0 ? 1 : -1;
    }
    return 1;
}

/// A proven common point: some four of the differences of a proof's vertices have the origin inside (Caratheodory).
static int meets_by_hull(const real differences[][3], uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = i + 1; j < count; j++)
            for (uint32_t k = j + 1; k < count; k++)
                for (uint32_t l = k + 1; l < count; l++) {
                    const real *corners[4] = {differences[i], differences[j], differences[k], differences[l]};
                    if (has_origin(corners)) return 1;
                }
    return 0;
}

/// Two points, one of each polyhedron, nearer than the radii.
static int meets_by_points(const setup *s, size_t a, size_t b, const ovoid_proof *proof) {
    real sum_a = 0, sum_b = 0, p[3] = {0}, r[3] = {0};
    for (uint32_t i = 0; i < proof->count; i++) {
        sum_a += proof->weight_a[i], sum_b += proof->weight_b[i];
        for (int k = 0; k < 3; k++) {
            p[k] += proof->weight_a[i] * bodies[a].points[proof->a[i]][k];
            r[k] += proof->weight_b[i] * bodies[b].points[proof->b[i]][k];
        }
    }
    real between[3],
        radii = (real)ovoid_shape_get_radius(s->bodies[a].shape) + ovoid_shape_get_radius(s->bodies[b].shape);
    for (int k = 0; k < 3; k++) between[k] = p[k] / sum_a - r[k] / sum_b;
    return sqrtl(dot(between, between)) * (1 + slack) + slack * (fabsl(p[0]) + fabsl(p[1]) + fabsl(p[2])) < radii;
}

/// Is a point, relative to the corners of a body, strictly inside all its triangles?
static int has_inside(const setup *s, size_t i, const real *point) {
    ovoid_polytope p = ovoid_shape_get_polytope(s->bodies[i].shape);
    for (uint32_t t = 0; t < p.triangle_count; t++) {
        real corners[3][3];
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++) corners[c][k] = bodies[i].points[p.triangles[3 * t + c]][k] - point[k];
        real size = sqrtl(dot(corners[0], corners[0]) * dot(corners[1], corners[1]) * dot(corners[2], corners[2]));
        if (!(determinant(corners[0], corners[1], corners[2]) > slack * size)) return 0;
    }
    return p.rank == 3;
}

/// A point of the frame of the first body that is inside both polyhedra.
static int meets_by_point(const setup *s, size_t a, size_t b, ovoid_vec3 in_a) {
    real v[3] = {in_a.x, in_a.y, in_a.z}, point[3];
    transform(&bodies[a].frame, v, point);
    return has_inside(s, a, point) && has_inside(s, b, point);
}

static ovoid_pose round_frame(const exact_frame *f) {
    // Shepperd's quaternion of the largest of its four numbers.
    real m[3][3], w[4], t;
    memcpy(m, f->r, sizeof m);
    w[0] = 1 + m[0][0] + m[1][1] + m[2][2], w[1] = 1 + m[0][0] - m[1][1] - m[2][2];
    w[2] = 1 - m[0][0] + m[1][1] - m[2][2], w[3] = 1 - m[0][0] - m[1][1] + m[2][2];
    int most = 0;
    for (int i = 1; i < 4; i++)
        if (w[i] > w[most]) most = i;
    t = w[most];
    real q[4][4] = {{t, m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]},
                    {m[2][1] - m[1][2], t, m[1][0] + m[0][1], m[0][2] + m[2][0]},
                    {m[0][2] - m[2][0], m[1][0] + m[0][1], t, m[2][1] + m[1][2]},
                    {m[1][0] - m[0][1], m[0][2] + m[2][0], m[2][1] + m[1][2], t}};
    return (ovoid_pose){{(double)f->p[0], (double)f->p[1], (double)f->p[2]},
                        {(double)q[most][0], (double)q[most][1], (double)q[most][2], (double)q[most][3]}};
}

static ovoid_pair make_pair(const setup *s, size_t a, size_t b) {
    return (ovoid_pair){s->bodies[a].shape, s->bodies[b].shape, round_frame(&bodies[a].frame),
                        round_frame(&bodies[b].frame)};
}

/// The pair at the rounded poses gives a direction or vertices; they are checked at the exact ones.
static truth judge_pair(const setup *s, size_t a, size_t b) {
    real between[3];
    for (int k = 0; k < 3; k++) between[k] = bodies[b].center[k] - bodies[a].center[k];
    if (sqrtl(dot(between, between)) > (s->bodies[a].bound + s->bodies[b].bound) * (1 + slack)) return APART;
    pairs_judged++;
    place_points(s, a), place_points(s, b);
    ovoid_pair pair = make_pair(s, a, b);
    ovoid_answer found = ovoid_distance(&pair, NULL, NULL);
    if (found.lower > 0) return find_gap(s, a, b, found.proof.normal) > 0 ? APART : OPEN;
    real differences[OVOID_PROOF_PAIRS][3];
    for (uint32_t i = 0; i < found.proof.count; i++)
        for (int k = 0; k < 3; k++)
            differences[i][k] = bodies[b].points[found.proof.b[i]][k] - bodies[a].points[found.proof.a[i]][k];
    int is_met = 0;
    if (found.proof.kind == OVOID_PROOF_HULL)
        is_met = meets_by_hull((const real(*)[3])differences, found.proof.count);
    else if (found.proof.kind == OVOID_PROOF_POINTS)
        is_met = meets_by_points(s, a, b, &found.proof);
    else if (found.proof.kind == OVOID_PROOF_INNER)
        is_met = meets_by_point(s, a, b, found.proof.inner_a);
    return is_met ? MEETS : OPEN;
}

/// Counts the pairs of a state that are not APART; *meeting receives how many of them MEET.
static long judge_state(const setup *s, const real *q, long *meeting) {
    long not_apart = 0;
    *meeting = 0;
    place_bodies(s, q);
    for (size_t i = 0; i < s->count; i++)
        for (size_t k = i + 1; k < s->count; k++) {
            if (!s->is_queried[i][k]) continue;
            truth is = judge_pair(s, i, k);
            not_apart += is != APART, *meeting += is == MEETS;
        }
    return not_apart;
}

static size_t find_body(const setup *s, const ovoid_robot_side *side) {
    for (size_t i = 0; i < s->count; i++)
        if (side->body ? s->bodies[i].id == side->body : !s->bodies[i].id && i == side->element) return i;
    return s->count;
}

/// The pair that an answer names at a state, which must not be apart by more than rounding. Nearly all of them are
/// proven to meet, so that the judge would see a hit that is called free.
static void check_hit(const setup *s, const real *q, const ovoid_robot_answer *answer) {
    size_t a = find_body(s, &answer->a), b = find_body(s, &answer->b);
    if (!CHECK(a < s->count && b < s->count)) return;
    place_bodies(s, q);
    truth is = judge_pair(s, a, b);
    meeting_hits += is == MEETS;
    if (is == APART) {
        place_points(s, a), place_points(s, b);
        ovoid_pair pair = make_pair(s, a, b);
        CHECK(find_gap(s, a, b, ovoid_distance(&pair, NULL, NULL).proof.normal) <= near_touch);
    }
}

// ---- states and edges

static void check_state(const setup *s, const double *q, const ovoid_robot_answer *answer) {
    real exact[EXACT_VARIABLES];
    long meeting;
    for (size_t i = 0; i < s->variables; i++) exact[i] = q[i];
    if (answer->status == OVOID_ROBOT_FREE) {
        long bad = judge_state(s, exact, &meeting);
        states_free++;
        CHECK_EQ(meeting, 0);
        left_open += bad - meeting;
    } else if (answer->status == OVOID_ROBOT_HIT) {
        states_hit++;
        check_hit(s, exact, answer);
    } else {
        undecided++;
    }
}

static void check_states(uint64_t *random, const setup *s, uint64_t count) {
    static double q[BATCH * EXACT_VARIABLES];
    ovoid_robot_answer answers[BATCH];
    for (uint64_t done = 0; done < count; done += BATCH) {
        for (size_t i = 0; i < BATCH; i++) make_random_state(random, s->robot, q + i * s->variables);
        ovoid_robot_batch batch = {q, BATCH, NULL, answers};
        CHECK_EQ(ovoid_robot_collide_batch((ovoid_robot_checker *const[]){s->checker}, 1, &batch, &error), OVOID_OK);
        for (size_t i = 0; i < BATCH; i++) {
            ovoid_robot_answer alone;
            check_state(s, q + i * s->variables, &answers[i]);
            CHECK_EQ(ovoid_robot_collide(s->checker, &(ovoid_robot_query){q + i * s->variables, NULL}, &alone, &error),
                     OVOID_OK);
            if (!CHECK_EQ(alone.status, answers[i].status)) check_state(s, q + i * s->variables, &alone);
        }
    }
}

/// The exact line between both states of an edge.
static void find_state(const setup *s, const double *edge, real t, real *q) {
    for (size_t i = 0; i < s->variables; i++) q[i] = edge[i] + t * ((real)edge[s->variables + i] - edge[i]);
}

static void check_free(uint64_t *random, const setup *s, const double *edge, real end) {
    real q[EXACT_VARIABLES];
    for (int i = 0; i < SAMPLES; i++) {
        long meeting;
        real t = i == 0 ? 0 : i == 1 ? end * (1 - 1e-12L) : end * (real)random_uniform(random, 0, 1);
        find_state(s, edge, t, q);
        long bad = judge_state(s, q, &meeting);
        if (!CHECK_EQ(meeting, 0)) printf("  at s = %.17Lg\n", t);
        left_open += bad - meeting;
    }
}

static void judge_edge(uint64_t *random, const setup *s, const double *edge, const ovoid_robot_path_answer *answer) {
    if (answer->status == OVOID_ROBOT_FREE) {
        edges_free++;
        check_free(random, s, edge, 1);
    } else if (answer->status == OVOID_ROBOT_HIT) {
        real q[EXACT_VARIABLES];
        edges_hit++;
        find_state(s, edge, answer->hit_at, q);
        check_hit(s, q, &answer->hit);
        if (answer->free_until > 0) check_free(random, s, edge, answer->free_until);
    } else {
        undecided++;
    }
}

static void check_edge(uint64_t *random, const setup *s, const double *edge, int any_hit) {
    ovoid_robot_path_options how = {.any_hit = any_hit};
    ovoid_robot_path path = {edge, 2};
    ovoid_robot_path_answer answer;
    CHECK_EQ(ovoid_robot_path_find_hit(s->checker, &(ovoid_robot_path_query){&path, &how}, &answer, &error), OVOID_OK);
    judge_edge(random, s, edge, &answer);
}

static void check_edge_batch(uint64_t *random, const setup *s, const double *edges, size_t count) {
    ovoid_robot_path_options how = {.any_hit = 1};
    ovoid_robot_path_answer answers[EDGE_BATCH];
    const ovoid_robot_edge_batch batch = {edges, count, &how, answers};
    CHECK_EQ(ovoid_robot_path_find_hit_batch(&s->checker, 1, &batch, &error), OVOID_OK);
    for (size_t i = 0; i < count; i++) judge_edge(random, s, edges + 2 * i * s->variables, &answers[i]);
}

/// From a state that is free, by a tenth of the limits or all of them; what floats stays.
static void make_edge(uint64_t *random, const setup *s, double *edge) {
    ovoid_robot_answer at;
    double part = random_below(random, 2) ? 0.1 : 1;
    for (int tries = 0; tries < 50; tries++) {
        make_random_state(random, s->robot, edge);
        if (ovoid_robot_collide(s->checker, &(ovoid_robot_query){edge, NULL}, &at, &error) != OVOID_OK) break;
        if (at.status == OVOID_ROBOT_FREE) break;
    }
    make_random_state(random, s->robot, edge + s->variables);
    for (size_t i = 0; i < s->variables; i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(s->robot, i);
        int is_floating = ovoid_robot_get_description(s->robot).joints[v.joint].type == OVOID_JOINT_FLOATING;
        double *end = &edge[s->variables + i], reach = isfinite(v.lower) ? part : part * 0.1;
        *end = is_floating ? edge[i] : edge[i] + reach * (*end - edge[i]);
    }
}

static void check_robot(uint64_t *random, const setup *s, uint64_t states, uint64_t edges) {
    static double all[EDGE_BATCH * 2 * EXACT_VARIABLES];
    check_states(random, s, states);
    // Any hit one by one, and as many side by side.
    for (uint64_t i = 0; i < edges; i += EDGE_BATCH) {
        size_t count = edges - i < EDGE_BATCH ? (size_t)(edges - i) : EDGE_BATCH;
        for (size_t k = 0; k < count; k++) make_edge(random, s, all + 2 * k * s->variables);
        for (size_t k = 0; k < count; k++) check_edge(random, s, all + 2 * k * s->variables, 0);
        if (i / EDGE_BATCH % 2)
            for (size_t k = 0; k < count; k++) check_edge(random, s, all + 2 * k * s->variables, 1);
        else
            check_edge_batch(random, s, all, count);
    }
}

// ---- robots

static void make_shapes(void) {
    uint64_t random = 5;
    double points[60];
    for (int i = 0; i < 60; i++) points[i] = random_uniform(&random, -0.15, 0.15);
    shapes[0] = ovoid_shape_create_box((ovoid_vec3){0.1, 0.05, 0.2}, NULL, &error);
    shapes[1] = ovoid_shape_create_sphere(0.1, NULL, &error);
    shapes[2] = ovoid_shape_create_capsule(0.03, 0.2, NULL, &error);
    shapes[3] = ovoid_shape_create_from_points(points, 20, NULL, &error);
    shapes[4] = ovoid_shape_create_box((ovoid_vec3){0.3, 0.3, 0.01}, NULL, &error);
    for (int i = 0; i < SHAPES; i++)
        if (!shapes[i]) exit(1);
}

static void check_trees(uint64_t *random, uint64_t states, uint64_t edges) {
    static random_robot tree;
    static setup s;
    for (int t = 0; t < TREES; t++) {
        size_t count = 0;
        make_random_robot(random, &tree);
        for (uint32_t i = 0; i < tree.d.link_count; i++)
            if (random_below(random, 2))
                tree.elements[count++] = (ovoid_robot_element){i, NULL, shapes[random_below(random, SHAPES)],
                                                               random_pose(random, 0.1), NULL};
        tree.d.element_count = count;
        open_cell(random, &tree.d, 1.5, &s);
        check_robot(random, &s, states / TREES, edges / TREES);
        close_cell(&s);
    }
}

/// A published arm as hulls, its base fixed, among random obstacles.
static void check_arm(uint64_t *random, const char *data, const char *name, uint64_t states, uint64_t edges) {
    static setup s;
    char urdf[600], srdf[600];
    snprintf(urdf, sizeof urdf, "%s/robots/%s.urdf", data, name);
    snprintf(srdf, sizeof srdf, "%s/robots/%s.srdf", data, name);
    ovoid_robot_read_options how = {.fixed_base = 1, .hull = 1, .ros_package_path = "", .ament_prefix_path = ""};
    ovoid_robot_file *file = ovoid_robot_file_read(urdf, srdf, &how, &error);
    if (!file) {
        check_skip(name);
        return;
    }
    ovoid_robot_description d = ovoid_robot_file_get_description(file);
    for (int k = 0; k < 4; k++) {
        open_cell(random, &d, 0.7, &s);
        check_robot(random, &s, states / 4, edges / 4);
        close_cell(&s);
    }
    ovoid_robot_file_destroy(file);
}

int main(int count, char **arguments) {
    uint64_t states = 1024, edges = 48, seed = 1;
    const test_option options[] = {{.name = "states", .help = "of each kind of robot", .whole = &states},
                                   {.name = "edges", .help = "of each kind of robot", .whole = &edges},
                                   {.name = "seed", .help = "of the random numbers", .whole = &seed},
                                   {NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    check_seed = seed;
    make_shapes();
    check_trees(&seed, states, edges);
    const char *data = check_data_folder();
    if (!data) check_skip("OVOID_DATA is absent: no published arms");
    if (data) check_arm(&seed, data, "panda_mbm/panda", states, edges);
    if (data) check_arm(&seed, data, "fetch_mbm/fetch", states, edges);
    printf("states: %ld free, %ld hit; edges: %ld free, %ld hit; pairs judged: %ld, open: %ld; undecided: %ld\n",
           states_free, states_hit, edges_free, edges_hit, pairs_judged, left_open, undecided);
    // Few are within rounding of touching.
    CHECK_LE((double)left_open, 1e-4 * (double)pairs_judged + 2);
    CHECK(states_free && edges_free && edges_hit);
    CHECK_LE(0.9 * (double)states_hit, (double)meeting_hits);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
