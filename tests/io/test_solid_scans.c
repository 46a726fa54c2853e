// Scans of real things as solids: a bunny (902 triangles) and a duck beside brute force in extended precision, apart,
// crossing, and a small copy inside. Skipped where the folder of data is not there.
#include "solids.h"

#include <ovoid/io.h>

static ovoid_exclusion items[200000];

static int read_mesh(const char *folder, const char *name, double scale, mesh *m) {
    char path[512];
    ovoid_error error = {OVOID_OK, -1, ""};
    snprintf(path, sizeof path, "%s/scans/%s", folder, name);
    ovoid_mesh *file = ovoid_mesh_read(path, NULL, &error);
    if (!file) return 0;
    ovoid_faces f = ovoid_mesh_get_part(file, 0).faces;
    for (size_t i = 0; i < f.vertex_count; i++)
        mesh_add_point(m, scale * f.vertices[3 * i], scale * f.vertices[3 * i + 1], scale * f.vertices[3 * i + 2]);
    const uint32_t *face = f.indices;
    for (size_t i = 0; i < f.face_count; face += f.sizes[i++])
        for (uint32_t k = 1; k + 1 < f.sizes[i]; k++) mesh_add_triangle(m, face[0], face[k], face[k + 1]);
    ovoid_mesh_destroy(file);
    return 1;
}

// Over every eleventh triangle of a: never below the distance, whose lower end the check proves.
static double find_surfaces(const mesh *a, const mesh *b, const ovoid_body_pair *pair) {
    long3 *p = long_place_mesh(a, &pair->a.pose), *q = long_place_mesh(b, &pair->b.pose);
    long double best = INFINITY;
    for (size_t i = 0; i < a->triangles && best > 0; i += 11)
        for (size_t j = 0; j < b->triangles && best > 0; j++)
            best = fminl(best, long_triangles_distance(p + 3 * i, q + 3 * j));
    free(p);
    free(q);
    return (double)best;
}

static void check_pair(const mesh *a, const mesh *b, const ovoid_body_pair *pair, ovoid_status status, double size) {
    ovoid_exclusions all = {.items = items, .capacity = 200000};
    ovoid_error error = {OVOID_OK, -1, ""};
    double truth = find_surfaces(a, b, pair);
    ovoid_body_answer x = ovoid_body_distance(pair, NULL, &(ovoid_body_evidence){.exclusions = &all}),
                      y = ovoid_body_collide(pair, NULL, NULL);
    CHECK_EQ(x.status, status);
    CHECK_EQ(y.status, status);
    if (!CHECK_EQ(ovoid_body_verify(pair, &x, &(ovoid_body_basis){.exclusions = &all}, &error), OVOID_OK))
        printf("  %s\n", error.message);
    CHECK_LE(x.deciding.lower, truth + 1e-12 * size);
    if (x.deciding.lower > 0) CHECK_LE(x.deciding.upper - x.deciding.lower, 1e-9 * size);
    if (!(truth > 0)) CHECK_LE(x.upper, 0);
}

int main(void) {
    const char *folder = check_data_folder();
    mesh bunny = {NULL, NULL, 0, 0, 0, 0}, small = bunny, duck = bunny;
    if (!folder || !read_mesh(folder, "bunny.obj", 1, &bunny) || !read_mesh(folder, "bunny.obj", 0.02, &small) ||
        !read_mesh(folder, "duck.obj", 1, &duck)) {
        check_skip("the scans are not there (OVOID_DATA)");
        return check_end();
    }
    ovoid_solid *a = mesh_make_solid(&bunny), *b = mesh_make_solid(&small), *d = mesh_make_solid(&duck);
    if (CHECK(a && b && d)) {
        ovoid_solid_report r = ovoid_solid_get_report(a);
        CHECK_EQ(r.triangles, 902);
        CHECK_EQ(r.is_closed, 1);
        CHECK(r.volume > 0 && ovoid_solid_get_report(d).triangles > 4000);
        double width = r.box.max.x - r.box.min.x, size = 8 * width;
        ovoid_body_pair pair = {{.solid = a, .pose = ovoid_pose_make_identity()},
                                {.solid = a, .pose = {{1.5 * width, 0.1, 0}, {3, 0, 1, 0}}}};
        check_pair(&bunny, &bunny, &pair, OVOID_SEPARATED, size);
        pair.b.pose.position.x = 0.3 * width;
        check_pair(&bunny, &bunny, &pair, OVOID_OVERLAPPING, size);
        // The small copy, around a point that the bunny winds around.
        int64_t winding = 0;
        uint64_t s = 5;
        ovoid_vec3 p = {0, 0, 0};
        for (int i = 0; i < 1000 && winding == 0; i++) {
            p = (ovoid_vec3){random_uniform(&s, r.box.min.x, r.box.max.x), random_uniform(&s, r.box.min.y, r.box.max.y),
                             random_uniform(&s, r.box.min.z, r.box.max.z)};
            if (!ovoid_solid_compute_winding(a, p, &winding)) winding = 0;
        }
        pair.b = (ovoid_body){.solid = b, .pose = {p, {1, 0, 0, 0}}};
        ovoid_body_answer x = ovoid_body_distance(&pair, NULL, NULL);
        CHECK_EQ(x.status, OVOID_OVERLAPPING);
        check_pair(&bunny, &small, &pair, OVOID_OVERLAPPING, size);
    }
    ovoid_solid_destroy(a);
    ovoid_solid_destroy(b);
    ovoid_solid_destroy(d);
    mesh_clear(&bunny);
    mesh_clear(&small);
    mesh_clear(&duck);
    return check_end();
}
