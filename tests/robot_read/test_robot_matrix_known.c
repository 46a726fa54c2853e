// The collision matrices of robots as they are published: in random states, at corners of the limits too, no pair that
// is proven never to touch is hit, and none that always touches is free. Skipped where the data is absent.
#include "robot_files.h"

#include "ovoid/robot_matrix.h"

enum { STATES = 2000, VARIABLES = 64, NEARS = 4000 };
static ovoid_robot_near items[NEARS];

typedef struct known_robot {
    const char *urdf;
    size_t never, always; ///< at least so many are proven: what the default budget gave in 2026, less a few
    size_t always_hulls;  ///< with the hulls of all meshes, whose overlaps have depths
} known_robot;

static const known_robot robots[] = {{"panda/urdf/panda.urdf", 20, 2, 5},
                                     {"panda_mbm/panda.urdf", 18, 0, 3},
                                     {"fetch_mbm/fetch.urdf", 25, 2, 6},
                                     {"allegro_hand/urdf/allegro_right_hand.urdf", 80, 3, 3}};

static void make_state(uint64_t *s, const ovoid_robot *r, double *q) {
    for (size_t i = 0; i < ovoid_robot_get_variable_count(r); i++) {
        ovoid_robot_variable v = ovoid_robot_get_variable(r, i);
        q[i] = isfinite(v.lower) ? random_uniform(s, v.lower, v.upper) : random_uniform(s, -4, 4);
        if (isfinite(v.lower) && random_next(s) % 4 == 0) q[i] = random_next(s) % 2 ? v.lower : v.upper;
    }
}

// Marks of each pair of the matrix: 1 hit, 2 not shown to be apart.
static void mark_pairs(const ovoid_robot_matrix *m, const ovoid_robot_nears *nears, unsigned char *marks) {
    ovoid_robot_matrix_pair first = ovoid_robot_matrix_get_pair(m, 0);
    const ovoid_robot_matrix_pair *begin = ovoid_robot_matrix_find_pair(m, first.a, first.b);
    memset(marks, 0, ovoid_robot_matrix_get_count(m));
    for (size_t i = 0; i < nears->count; i++) {
        const ovoid_robot_matrix_pair *p = ovoid_robot_matrix_find_pair(m, items[i].a.link, items[i].b.link);
        if (CHECK(p)) marks[p - begin] |= (unsigned char)((items[i].upper < 0) | (items[i].lower <= 0) << 1);
    }
}

static void check_states(const ovoid_robot *r, const ovoid_robot_matrix *m, ovoid_robot_checker *x) {
    uint64_t s = 11;
    double q[VARIABLES];
    unsigned char marks[1024];
    ovoid_error error;
    if (!CHECK_LE(ovoid_robot_matrix_get_count(m), sizeof marks)) return;
    for (int i = 0; i < STATES; i++) {
        ovoid_robot_nears nears = {.items = items, .capacity = NEARS};
        make_state(&s, r, q);
        CHECK_EQ(ovoid_robot_find_near(x, &(ovoid_robot_query){q, NULL}, &nears, &error), OVOID_OK);
        if (!CHECK_LE(nears.count, (size_t)NEARS)) return;
        mark_pairs(m, &nears, marks);
        for (size_t k = 0; k < ovoid_robot_matrix_get_count(m); k++) {
            ovoid_robot_touch touch = ovoid_robot_matrix_get_pair(m, k).touch;
            if (touch == OVOID_ROBOT_TOUCH_NEVER) CHECK(!(marks[k] & 1));
            if (touch == OVOID_ROBOT_TOUCH_ALWAYS) CHECK(marks[k] & 2);
        }
    }
}

static void test_matrix(const ovoid_robot_file *file, const known_robot *k, size_t always) {
    ovoid_error error;
    ovoid_robot_description d = ovoid_robot_file_get_description(file);
    d.disabled_count = 0;
    ovoid_robot *r = ovoid_robot_create(&d, NULL, &error);
    ovoid_robot_cell *cell = r ? ovoid_robot_cell_create(r, NULL, &error) : NULL;
    ovoid_robot_checker *x = cell ? ovoid_robot_checker_create(cell, NULL, &error) : NULL;
    ovoid_robot_matrix *m = r ? ovoid_robot_matrix_create(r, NULL, &error) : NULL;
    if (!CHECK(x && m) || !CHECK_LE(ovoid_robot_get_variable_count(r), (size_t)VARIABLES)) exit(1);
    size_t of[7] = {0};
    for (size_t i = 0; i < ovoid_robot_matrix_get_count(m); i++) of[ovoid_robot_matrix_get_pair(m, i).touch]++;
    printf("%s: never %zu, sampled %zu, always %zu, sampled %zu\n", k->urdf, of[OVOID_ROBOT_TOUCH_NEVER],
           of[OVOID_ROBOT_TOUCH_SAMPLED_NEVER], of[OVOID_ROBOT_TOUCH_ALWAYS], of[OVOID_ROBOT_TOUCH_SAMPLED_ALWAYS]);
    CHECK_LE(k->never, of[OVOID_ROBOT_TOUCH_NEVER]);
    CHECK_LE(always, of[OVOID_ROBOT_TOUCH_ALWAYS]);
    check_states(r, m, x);
    ovoid_robot_matrix_destroy(m);
    ovoid_robot_checker_destroy(x);
    ovoid_robot_cell_destroy(cell);
    ovoid_robot_destroy(r);
}

static void test_robot(const char *data, const known_robot *k) {
    char urdf[600];
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_robot_read_options options = make_read_options();
    snprintf(urdf, sizeof urdf, "%s/robots/%s", data, k->urdf);
    FILE *there = fopen(urdf, "rb");
    if (!there) {
        check_skip(k->urdf);
        return;
    }
    fclose(there);
    for (options.hull = 0; options.hull < 2; options.hull++) {
        ovoid_robot_file *file = ovoid_robot_file_read(urdf, NULL, &options, &error);
        if (!CHECK(file)) {
            printf("  %s\n", error.message);
            return;
        }
        test_matrix(file, k, options.hull ? k->always_hulls : k->always);
        ovoid_robot_file_destroy(file);
    }
}

int main(void) {
    const char *data = check_data_folder();
    if (!data) check_skip("OVOID_DATA is absent: no robots");
    for (size_t i = 0; data && i < sizeof robots / sizeof *robots; i++) test_robot(data, &robots[i]);
    return check_end();
}
