// An assembly of a thousand real parts that are not convex, each in a cell of a grid a hundredth wider than itself: all
// are apart, as their boxes show, and a world finds the clearances of those that are near; of the pairs that touch in a
// second, tighter grid each answer is checked by its proof. Skipped where the folder of data is not there.
#include "check.h"

#include <ovoid/io.h>
#include <ovoid/ovoid.h>

enum { MESHES = 40, PARTS = 1000, SIDE = 10, CAPACITY = 20000 };

typedef struct assembly {
    ovoid_solid *solids[MESHES];
    size_t count;
} assembly;

// Scaled so that the longest side of its box is 1. NULL where it is not there, or is convex or open.
static ovoid_solid *read_part(const char *folder, int number) {
    char path[512];
    ovoid_error error = {OVOID_OK, -1, ""};
    snprintf(path, sizeof path, "%s/compounds/%03d.obj", folder, number);
    ovoid_solid *solid = ovoid_solid_read_file(path, NULL, &error);
    if (!solid) return NULL;
    ovoid_solid_report r = ovoid_solid_get_report(solid);
    double x = r.box.max.x - r.box.min.x, y = r.box.max.y - r.box.min.y, z = r.box.max.z - r.box.min.z;
    const ovoid_read_options read = {.scale = 1 / fmax(x, fmax(y, z))};
    ovoid_solid_destroy(solid);
    ovoid_shapes *hull = ovoid_shapes_read_file(path, &read, NULL, &error);
    if (!CHECK(hull != NULL)) return NULL;
    int is_nonconvex = ovoid_shapes_get(hull, 0).convexity.kind != OVOID_MESH_HULL;
    ovoid_shapes_destroy(hull);
    return is_nonconvex && r.is_closed ? ovoid_solid_read_file(path, &read, &error) : NULL;
}

// A part in its cell: the middle of its box in the middle of the cell.
static ovoid_world_body place(const assembly *a, size_t i, double cell) {
    const ovoid_solid *solid = a->solids[i % a->count];
    ovoid_solid_report r = ovoid_solid_get_report(solid);
    ovoid_world_body b = {.body = {.solid = solid, .pose = ovoid_pose_make_identity()}};
    b.body.pose.position = (ovoid_vec3){cell * (double)(i % SIDE) - (r.box.min.x + r.box.max.x) / 2,
                                        cell * (double)(i / SIDE % SIDE) - (r.box.min.y + r.box.max.y) / 2,
                                        cell * (double)(i / SIDE / SIDE) - (r.box.min.z + r.box.max.z) / 2};
    return b;
}

static ovoid_world *make_world(const assembly *a, double cell) {
    static ovoid_world_body bodies[PARTS];
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    for (size_t i = 0; i < PARTS; i++) bodies[i] = place(a, i, cell);
    CHECK_EQ(ovoid_world_add_many(w, &(ovoid_world_additions){bodies, PARTS, NULL}, NULL), OVOID_OK);
    return w;
}

static void check_answer(const ovoid_world *w, const ovoid_contact *c) {
    static ovoid_exclusion items[CAPACITY];
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
    ovoid_world_body a, b;
    ovoid_error error = {OVOID_OK, -1, ""};
    CHECK(ovoid_world_get(w, c->a, &a, NULL) == OVOID_OK && ovoid_world_get(w, c->b, &b, NULL) == OVOID_OK);
    const ovoid_body_pair pair = {a.body, b.body};
    ovoid_body_answer x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
    CHECK_EQ(x.status, c->verdict.status);
    if (all.count > CAPACITY) return;
    if (!CHECK_EQ(ovoid_body_verify(&pair, &x, &(ovoid_body_basis){.exclusions = &all}, &error), OVOID_OK))
        printf("  %s\n", error.message);
}

static void check_grid(const assembly *a, double cell) {
    ovoid_world *w = make_world(a, cell);
    const ovoid_contact_query q = {.kind = OVOID_QUERY_DISTANCE, .margin = 0.05};
    ovoid_contacts f;
    ovoid_error error = {OVOID_OK, -1, ""};
    CHECK_EQ(ovoid_world_compute_contacts(w, &q, &f, &error), OVOID_OK);
    size_t overlaps = 0, open = 0;
    for (size_t i = 0; i < f.count; i++) {
        const ovoid_verdict *v = &f.items[i].verdict;
        overlaps += v->status == OVOID_OVERLAPPING;
        open += v->status == OVOID_UNDECIDED || v->status == OVOID_TOUCHING;
        // Boxes of unit size in cells that are wider are apart by that.
        if (cell > 1) CHECK_LE(cell - 1 - 1e-9, v->lower);
        if (v->status == OVOID_SEPARATED) CHECK_LE(v->upper - v->lower, 1e-7);
        if (i % 7 == 0) check_answer(w, &f.items[i]);
    }
    CHECK(f.count > 100 && open == 0 && (overlaps > 50) == (cell < 1));
    printf("cells of %g: %zu pairs within 0.05, %zu of them overlap\n", cell, f.count, overlaps);
    // Where nothing moves nothing is asked again.
    CHECK_EQ(ovoid_world_compute_contacts(w, &q, &f, &error), OVOID_OK);
    CHECK_EQ(f.queried, 0);
    ovoid_world_destroy(w);
}

int main(void) {
    const char *folder = check_data_folder();
    assembly a = {.count = 0};
    for (int number = 0; folder && number < 120 && a.count < MESHES; number++) {
        a.solids[a.count] = read_part(folder, number);
        a.count += a.solids[a.count] != NULL;
    }
    if (a.count == 0) {
        check_skip("the meshes are not there (OVOID_DATA)");
        return check_end();
    }
    printf("%d parts of %zu meshes\n", PARTS, a.count);
    check_grid(&a, 1.01);
    check_grid(&a, 0.9);
    for (size_t i = 0; i < a.count; i++) ovoid_solid_destroy(a.solids[i]);
    return check_end();
}
