// Bodies of unit cubes on one grid: their faces are flush wherever they meet, and no two triangles need cross. Truth:
// the cubes. Bodies that share one overlap; bodies whose cubes only touch do not, and are not apart; the distance of
// others is the least of two cubes. Quarter turns are exact; turned by other angles the bodies are off by rounding, far
// below the tolerance.
#include "options.h"
#include "solids.h"

enum { CAPACITY = 60000, ROOM = 8 };
static ovoid_exclusion items[CAPACITY];

static ovoid_solid *make_solid(const cubes *c, int n, double scale) {
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_cubes(&m, c, n);
    for (size_t i = 0; i < 3 * m.points; i++) m.xyz[i] *= scale;
    ovoid_solid *s = mesh_make_solid(&m);
    mesh_clear(&m);
    return s;
}

// The body as boxes, one a cube.
static ovoid_compound *make_compound(const cubes *c, const ovoid_shape *cube, double scale) {
    ovoid_posed_shape parts[CUBES_ALL];
    size_t count = 0;
    for (int i = 0; i < CUBES_ALL; i++)
        if (c->is[i])
            parts[count++] = (ovoid_posed_shape){
                cube,
                {{scale * (i / CUBES / CUBES + 0.5), scale * (i / CUBES % CUBES + 0.5), scale * (i % CUBES + 0.5)},
                 {1, 0, 0, 0}}};
    return ovoid_compound_create(parts, count, NULL, NULL);
}

typedef struct truth {
    int shared;    ///< cubes
    double square; ///< of the distance
} truth;

static truth find_truth(const cubes *a, const cubes *b, const int shift[3]) {
    truth t = {0, INFINITY};
    for (int i = 0; i < CUBES_ALL; i++)
        for (int j = 0; j < CUBES_ALL; j++) {
            if (!a->is[i] || !b->is[j]) continue;
            const int p[3] = {i / CUBES / CUBES, i / CUBES % CUBES, i % CUBES};
            const int q[3] = {j / CUBES / CUBES + shift[0], j / CUBES % CUBES + shift[1], j % CUBES + shift[2]};
            double square = 0;
            int same = 1;
            for (int k = 0; k < 3; k++) {
                int off = abs(p[k] - q[k]);
                same &= off == 0;
                square += off > 1 ? (off - 1) * (off - 1) : 0;
            }
            t.shared += same;
            t.square = fmin(t.square, square);
        }
    return t;
}

static struct { int shared, decided, touching, undecided, apart; } tally;

static void check(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_exclusions *all, truth t,
                  double scale) {
    ovoid_error error = {.message = ""};
    CHECK(all->count <= all->capacity);
    if (!CHECK_EQ(ovoid_body_verify(pair, x, &(ovoid_body_basis){.exclusions = all}, &error), OVOID_OK))
        printf("  %s\n", error.message);
    CHECK_LE(x->lower, x->upper);
    if (x->status == OVOID_TOUCHING) CHECK(x->lower <= 0 && x->upper >= 0 && x->upper - x->lower <= 1e-7 * scale);
    if (t.shared) {
        CHECK(x->status == OVOID_OVERLAPPING);
        tally.shared++;
        tally.decided += x->status == OVOID_OVERLAPPING;
    } else if (t.square > 0) {
        CHECK_EQ(x->status, OVOID_SEPARATED);
        CHECK_LE(x->lower, scale * sqrt(t.square) * (1 + 1e-14));
        CHECK_LE(scale * sqrt(t.square) * (1 - 1e-14), x->upper);
        tally.apart++;
    } else {
        // Touching: never more than rounding into each other or apart.
        CHECK(x->status == OVOID_TOUCHING || x->status == OVOID_UNDECIDED || fabs(x->upper) < 1e-13 * scale);
        CHECK(x->lower <= 1e-13 * scale && x->upper >= -1e-13 * scale);
        if (x->status == OVOID_UNDECIDED) CHECK(x->limit == OVOID_LIMIT_PRECISION);
        tally.touching += x->status == OVOID_TOUCHING;
        tally.undecided += x->status == OVOID_UNDECIDED;
    }
}

static void ask(const ovoid_body_pair *pair, truth t, double scale) {
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
    ovoid_body_answer x = ovoid_body_distance(pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    check(pair, &x, &all, t, scale);
    x = ovoid_body_collide(pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    check(pair, &x, &all, t, scale);
}

// The pose that turns the second body and brings it to the shift, both then turned by one rotation.
static void place(ovoid_body_pair *pair, const int shift[3], double scale, ovoid_quat turn) {
    pair->a.pose = pair->b.pose = ovoid_pose_make_identity();
    pair->b.pose.position = (ovoid_vec3){scale * shift[0], scale * shift[1], scale * shift[2]};
    ovoid_pose all = {{0, 0, 0}, turn};
    pair->a.pose = ovoid_pose_compute_product(&all, &pair->a.pose);
    pair->b.pose = ovoid_pose_compute_product(&all, &pair->b.pose);
}

static void check_rounds(int rounds, uint64_t seed) {
    static const ovoid_quat quarter[] = {{1, 0, 0, 0}, {1, 1, 0, 0}, {1, 0, 1, 0},  {1, 0, 0, 1},
                                         {0, 1, 0, 0}, {1, 1, 1, 1}, {1, -1, 1, -1}};
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = seed + (uint64_t)i;
        double scale = i % 5 == 4 ? pow(10, random_uniform(&s, -9, 9)) : 1;
        cubes a = cubes_make(&s), b = i % 7 == 6 ? a : cubes_make(&s);
        int fine = i % 10 == 9 ? 4 : 1, shift[3];
        ovoid_shape *cube = ovoid_shape_create_box((ovoid_vec3){scale / 2, scale / 2, scale / 2}, NULL, NULL);
        ovoid_solid *sa = make_solid(&a, fine, scale), *sb = make_solid(&b, i % 20 == 19 ? 3 : 1, scale);
        ovoid_compound *cb = cube ? make_compound(&b, cube, scale) : NULL;
        for (int k = 0; k < ROOM && CHECK(sa && sb && cb); k++) {
            for (int j = 0; j < 3; j++) shift[j] = k == 0 ? 0 : (int)(random_next(&s) % 5) - 2;
            truth t = find_truth(&a, &b, shift);
            ovoid_body_pair pair = {{.solid = sa}, {.solid = sb}};
            ovoid_quat turn = k % 3 == 2 ? random_quat(&s) : quarter[random_next(&s) % 7];
            place(&pair, shift, scale, turn);
            ask(&pair, t, scale);
            if (k > 2) continue;
            ovoid_body_pair parts = {pair.a, {.compound = cb, .pose = pair.b.pose}};
            ask(&parts, t, scale);
        }
        ovoid_solid_destroy(sa);
        ovoid_solid_destroy(sb);
        ovoid_compound_destroy(cb);
        ovoid_shape_destroy(cube);
    }
    check_seed = 0;
}

// A bar with the section |x| + |z| <= 1 through a block, |y| <= 1: their surfaces meet along edges of both alone, and
// no triangles are flush. Beside them each body has a fine ball elsewhere, so that few triangles are near the overlap,
// and the middle of both boxes is in neither.
static void add_block(mesh *m) {
    static const uint8_t face[10][3] = {{0, 5, 4}, {1, 6, 5}, {2, 7, 6}, {3, 4, 7}, {0, 1, 5},
                                        {1, 2, 6}, {2, 3, 7}, {3, 0, 4}, {4, 5, 6}, {4, 6, 7}};
    for (int side = 0; side < 2; side++) {
        double y = side ? 1 : -1;
        for (int i = 0; i < 4; i++) mesh_add_point(m, i == 0 || i == 3 ? 2 : -2, y, i < 2 ? 2 : -2);
        for (int i = 0; i < 4; i++) mesh_add_point(m, i % 2 ? 0 : 1 - i, y, i % 2 ? 2 - i : 0);
    }
    for (uint32_t i = 0; i < 10; i++) {
        mesh_add_triangle(m, face[i][0], face[i][1], face[i][2]);
        mesh_add_triangle(m, face[i][0] + 8u, face[i][2] + 8u, face[i][1] + 8u);
    }
    for (uint32_t i = 0; i < 4; i++) {
        mesh_add_triangle(m, i, i + 8, (i + 1) % 4 + 8);
        mesh_add_triangle(m, i, (i + 1) % 4 + 8, (i + 1) % 4);
    }
}

static void add_bar(mesh *m) {
    for (int k = 0; k < 4; k++)
        for (int i = 0; i < 4; i++)
            mesh_add_point(m, i % 2 ? 0 : 1 - i, k == 0 ? -9 : k == 3 ? 9 : 2 * k - 3, i % 2 ? 2 - i : 0);
    for (uint32_t k = 0; k < 3; k++)
        for (uint32_t i = 0; i < 4; i++) {
            uint32_t j = (i + 1) % 4;
            mesh_add_triangle(m, 4 * k + i, 4 * k + 4 + i, 4 * k + 4 + j);
            mesh_add_triangle(m, 4 * k + i, 4 * k + 4 + j, 4 * k + j);
        }
    for (uint32_t i = 1; i < 3; i++) {
        mesh_add_triangle(m, 0, i, i + 1);
        mesh_add_triangle(m, 12, 12 + i + 1, 12 + i);
    }
}

// Two bodies in their places that overlap: a point of both must be found.
static void expect_point(mesh *a, mesh *b) {
    ovoid_solid *sa = mesh_make_solid(a), *sb = mesh_make_solid(b);
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
    ovoid_body_pair pair = {{.solid = sa, .pose = ovoid_pose_make_identity()},
                            {.solid = sb, .pose = ovoid_pose_make_identity()}};
    if (CHECK(sa && sb)) {
        CHECK(ovoid_solid_get_report(sa).is_closed && ovoid_solid_get_report(sb).is_closed);
        ovoid_body_answer x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        CHECK_EQ(x.status, OVOID_OVERLAPPING);
        CHECK_EQ(x.inside, OVOID_BODY_COMMON_POINT);
        CHECK_EQ(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_OK);
    }
    ovoid_solid_destroy(sa);
    ovoid_solid_destroy(sb);
    mesh_clear(a);
    mesh_clear(b);
}

static void check_edges(void) {
    mesh a = {NULL, NULL, 0, 0, 0, 0}, b = a;
    uint64_t s = 1;
    add_block(&a);
    mesh_add_star(&a, (ovoid_vec3){-9, 0, 9}, 2, 40, 40, 0, &s);
    add_bar(&b);
    mesh_add_star(&b, (ovoid_vec3){9, 0, 9}, 2, 40, 40, 0, &s);
    expect_point(&a, &b);
}

// One thin plate that lies across the axes, in both bodies, and a fine ball of each elsewhere: among so many triangles
// only those that are flush lead to it, and boxes would have to be as small as it is thin.
static void check_plates(void) {
    const ovoid_pose tilt = {{0.117, 0.231, 0.313}, {0.8, 0.3, 0.4, 0.1}};
    mesh both[2] = {{NULL, NULL, 0, 0, 0, 0}, {NULL, NULL, 0, 0, 0, 0}};
    uint64_t s = 1;
    for (int k = 0; k < 2; k++) {
        mesh_add_angle(&both[k], 1, 0.3, 0.0002);
        for (size_t i = 0; i < both[k].points; i++) {
            double *p = both[k].xyz + 3 * i;
            ovoid_vec3 to = ovoid_pose_compute_point(&tilt, (ovoid_vec3){p[0], p[1], p[2]});
            p[0] = to.x, p[1] = to.y, p[2] = to.z;
        }
        mesh_add_star(&both[k], (ovoid_vec3){k ? 4 : -4, 0, 3}, 2, 40, 40, 0, &s);
    }
    expect_point(&both[0], &both[1]);
}

int main(int count, char **arguments) {
    check_edges();
    check_plates();
    uint64_t rounds = 200;
    const test_option options[] = {{"rounds", "how many (200)", &rounds, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    check_rounds((int)rounds, 5000);
    printf("sharing cubes %d, said to overlap %d; touching: %d said so, %d undecided; apart %d\n", tally.shared,
           tally.decided, tally.touching, tally.undecided, tally.apart);
    CHECK(tally.shared > 500 && tally.touching > 100 && tally.apart > 100);
    return check_end();
}
