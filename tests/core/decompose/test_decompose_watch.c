// Decompositions that a host stops at its k-th question. Truth: what a stopped call gave does not contradict the whole
// one: brackets that hold the same lengths, parts that cover.
#include "decompositions.h"
#include "patience.h"

#include <ovoid/decompose.h>

static ovoid_error error;

static ovoid_solid *make_angle(void) {
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_angle(&m, 4, 1, 0.5);
    ovoid_solid *s = mesh_make_solid(&m);
    mesh_clear(&m);
    return s;
}

static int do_agree(const ovoid_decomposition_length *x, const ovoid_decomposition_length *y) {
    return x->lower <= y->upper && y->lower <= x->upper;
}

// The hull of an angle stands out by 1.5.
static void check_proof(const ovoid_solid *solid) {
    ovoid_shape *hull = ovoid_shape_create_from_points(ovoid_solid_get_points(solid), 12, NULL, NULL);
    const ovoid_shape *part = hull;
    ovoid_decomposition d = {solid, &part, 1};
    patience p;
    ovoid_decomposition_options o = {.tolerance = 1e-2};
    ovoid_decomposition_proof all, is;
    CHECK_EQ(ovoid_decomposition_compute_proof(&d, &o, &all, &error), OVOID_OK);
    size_t whole = SIZE_MAX;
    for (size_t most = 0; most < whole && most < 100000; most += 1 + most / 8) {
        o.watch = make_watch(&p, most);
        if (!CHECK_EQ(ovoid_decomposition_compute_proof(&d, &o, &is, &error), OVOID_OK)) break;
        CHECK(do_agree(&is.uncovered, &all.uncovered) && do_agree(&is.excess, &all.excess));
        CHECK(is.excess.lower <= 1.5 && is.excess.upper >= 1.5);
        CHECK(is.cells <= 12 + 6 * most);
        if (p.asked <= most) whole = most;
        if (whole < SIZE_MAX) CHECK_EQ(is.cells, all.cells);
        // Said once for each of the two lengths at most.
        if (whole == SIZE_MAX) CHECK(p.asked <= most + 2 && is.excess.upper >= all.excess.upper);
    }
    CHECK(whole > 3 && whole < SIZE_MAX);
    ovoid_shape_destroy(hull);
}

static void check_parts(const ovoid_solid *solid, double wanted, size_t count) {
    patience p;
    size_t whole = SIZE_MAX;
    for (size_t most = 0; most < whole && most < 10000; most += 1 + most / 4) {
        ovoid_decomposition_options o = {.error = wanted, .parts = count, .watch = make_watch(&p, most)};
        ovoid_parts *parts = ovoid_parts_create_from_solid(solid, &o, &error);
        if (!CHECK(parts != NULL)) return;
        ovoid_decomposition d = {solid, ovoid_parts_get_shapes(parts), ovoid_parts_get_count(parts)};
        ovoid_decomposition_options narrow = {.tolerance = 0.05, .work = 4000};
        ovoid_decomposition_proof is;
        CHECK_EQ(ovoid_decomposition_compute_proof(&d, &narrow, &is, &error), OVOID_OK);
        CHECK_LE(is.uncovered.lower, 1e-9);
        CHECK(d.part_count <= most + 1 || p.asked <= most);
        if (p.asked <= most) whole = most;
        if (whole < SIZE_MAX && count) CHECK_LE(d.part_count, count);
        ovoid_parts_destroy(parts);
    }
    CHECK(whole > 2 && whole < SIZE_MAX);
}

int main(void) {
    ovoid_solid *angle = make_angle();
    check_proof(angle);
    check_parts(angle, 0.01, 0);
    uint64_t seed = 501;
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_random(&m, 1, &seed);
    ovoid_solid *random = mesh_make_solid(&m);
    check_parts(random, 0, 2);
    check_parts(random, 0.2, 0);
    mesh_clear(&m);
    ovoid_solid_destroy(random);
    ovoid_solid_destroy(angle);
    return check_end();
}
