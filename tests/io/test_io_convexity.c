// What a mesh is: its hull, a solid or a surface. Truth: boxes and what is cut out of them, in closed form.
#include "files.h"

#include <stdarg.h>

/// A mesh under construction, as OBJ.
typedef struct text {
    char data[20000];
    size_t length;
    int points;
} text;

static void add(text *t, const char *format, ...) {
    va_list list;
    va_start(list, format);
    t->length += (size_t)vsnprintf(t->data + t->length, sizeof t->data - t->length, format, list);
    va_end(list);
}

static const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

// A box by its corners; turned: seen from inside; left_out: how many of its faces are missing.
static void add_box(text *t, const double low[3], const double high[3], int turned, int left_out) {
    for (int i = 0; i < 8; i++)
        add(t, "v %.17g %.17g %.17g\n", i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]);
    for (int q = left_out; q < 6; q++) {
        add(t, "f");
        for (int k = 0; k < 4; k++) add(t, " %d", t->points + 1 + quads[q][turned ? 3 - k : k]);
        add(t, "\n");
    }
    t->points += 8;
}

static ovoid_convexity compute(const text *t) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_shapes *shapes = ovoid_shapes_read_file(file_write_text("mesh.obj", t->data), NULL, NULL, &error);
    if (!CHECK(shapes != NULL)) return (ovoid_convexity){.kind = OVOID_MESH_PARTS};
    ovoid_convexity c = ovoid_shapes_get(shapes, 0).convexity;
    ovoid_shapes_destroy(shapes);
    return c;
}

static void expect(const text *t, double mesh, double hull, ovoid_mesh_kind kind) {
    ovoid_convexity c = compute(t);
    if (isnan(mesh))
        CHECK(isnan(c.mesh_volume));
    else
        CHECK_NEAR(c.mesh_volume, mesh, 1e-12 * hull);
    CHECK_NEAR(c.hull_volume, hull, 1e-12 * hull);
    CHECK_EQ(c.kind, kind);
    CHECK_EQ(c.allowance, 0);
}

static const double zero[3] = {0, 0, 0}, one[3] = {1, 1, 1}, two[3] = {2, 2, 2}, three[3] = {3, 3, 3};

static void check_boxes(void) {
    // A box, also seen from inside, and far from the origin; with a face missing, a surface.
    for (int turned = 0; turned < 2; turned++) {
        text t = {.length = 0};
        add_box(&t, zero, one, turned, 0);
        expect(&t, 1, 1, OVOID_MESH_HULL);
    }
    text open = {.length = 0};
    add_box(&open, zero, one, 0, 1);
    expect(&open, NAN, 1, OVOID_MESH_SURFACE);
    CHECK_EQ(compute(&open).edges_unmatched, 4);
    const double far_low[3] = {1e6, 1e6, 1e6}, far_high[3] = {1e6 + 1, 1e6 + 1, 1e6 + 1};
    text far = {.length = 0};
    add_box(&far, far_low, far_high, 0, 0);
    expect(&far, 1, 1, OVOID_MESH_HULL);
    // Two boxes at the ends of a diagonal; a box with a hollow; the same box twice.
    text apart = {.length = 0};
    add_box(&apart, zero, one, 0, 0);
    add_box(&apart, two, three, 0, 0);
    expect(&apart, 2, 7, OVOID_MESH_SOLID); // the hull is a unit cube moved by (2, 2, 2)
    text hollow = {.length = 0};
    add_box(&hollow, zero, three, 0, 0);
    add_box(&hollow, one, two, 1, 0);
    expect(&hollow, 26, 27, OVOID_MESH_SOLID);
    text twice = {.length = 0};
    add_box(&twice, zero, one, 0, 0);
    add_box(&twice, zero, one, 0, 0);
    expect(&twice, 2, 1, OVOID_MESH_HULL);
    // Points without faces.
    text cloud = {.length = 0};
    add_box(&cloud, zero, one, 0, 6);
    expect(&cloud, NAN, 1, OVOID_MESH_HULL);
}

// A box of triangles that share no point: equal points count as one. One triangle turned: not closed.
static void check_soup(void) {
    for (int turned = 0; turned < 2; turned++) {
        text t = {.length = 0};
        int count = 0;
        for (int q = 0; q < 6; q++)
            for (int half = 0; half < 2; half++) {
                const int corners[3] = {quads[q][0], quads[q][half ? 2 : 1], quads[q][half ? 3 : 2]};
                for (int k = 0; k < 3; k++)
                    add(&t, "v %d %s %d\n", corners[k] & 1, corners[k] & 2 ? "1" : "-0", corners[k] >> 2 & 1);
                int second = turned && !count ? 3 : 2;
                add(&t, "f %d %d %d\n", count + 1, count + second, count + 5 - second);
                count += 3;
            }
        ovoid_convexity c = compute(&t);
        CHECK(turned ? isnan(c.mesh_volume) : fabs(c.mesh_volume - 1) < 1e-15);
        CHECK_EQ(c.kind, turned ? OVOID_MESH_SURFACE : OVOID_MESH_HULL);
    }
}

// A plate of 2 x 2 squares, `thick` high, whose middle of the top is lower by `dent`: a pyramid is missing.
static text make_dented_plate(double thick, double dent) {
    text t = {.length = 0};
    for (int i = 0; i < 9; i++) add(&t, "v %d %d %.17g\n", i % 3, i / 3, i == 4 ? thick - dent : thick);
    for (int i = 0; i < 4; i++) add(&t, "v %d %d 0\n", i % 2 * 2, i / 2 * 2);
    add(&t, "f 1 2 5\nf 2 3 5\nf 3 6 5\nf 6 9 5\nf 9 8 5\nf 8 7 5\nf 7 4 5\nf 4 1 5\nf 10 12 13 11\n");
    add(&t, "f 10 11 3 2 1\nf 11 13 9 6 3\nf 13 12 7 8 9\nf 12 10 1 4 7\n");
    return t;
}

static ovoid_convexity dent_plate(double thick, double dent) {
    text t = make_dented_plate(thick, dent);
    ovoid_convexity c = compute(&t);
    if (dent > 0) CHECK_NEAR(c.hull_volume, 4 * thick, 1e-12);
    CHECK_NEAR(c.mesh_volume, 4 * thick - 4 * dent / 3, 1e-12);
    return c;
}

static void check_threshold(void) {
    // The centroid is 0.5 below the top, the farthest vertex 1.5 from it: the allowance is three times the dent. It may
    // be a millionth of the diagonal, 3, and 4e-7 of the largest coordinate, 2.
    ovoid_convexity near = dent_plate(1, 1.2e-6), far = dent_plate(1, 1.3e-6);
    CHECK_EQ(near.kind, OVOID_MESH_HULL);
    CHECK(near.allowance >= 3.6e-6 && near.allowance < 3.6001e-6);
    CHECK_EQ(far.kind, OVOID_MESH_SOLID);
    CHECK_EQ(far.allowance, 0);
    CHECK_EQ(dent_plate(1, -1.3e-6).kind, OVOID_MESH_HULL);
}

// What ovoid_shape_read_file makes of the mesh: 0, the shape, whose allowance inside is given; else the error.
static ovoid_code read_shape(const text *t, int hull, double *allowance, const char *phrase) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_read_options read = {.hull = hull, .parts = 1}; // parts has no effect
    ovoid_shape *shape = ovoid_shape_read_file(file_write_text("shape.obj", t->data), &read, NULL, &error);
    *allowance = shape ? ovoid_shape_get_allowance(shape).inside : 0;
    ovoid_shape_destroy(shape);
    if (!shape) CHECK(strstr(error.message, "shape.obj: ") && strstr(error.message, phrase));
    return shape ? OVOID_OK : error.code;
}

// A shape of a mesh that is not its hull has to be asked for.
static void check_shapes(void) {
    double allowance;
    text box = {.length = 0}, hollow = box, open = box, cloud = box;
    add_box(&box, zero, one, 0, 0);
    add_box(&hollow, zero, three, 0, 0);
    add_box(&hollow, one, two, 1, 0);
    add_box(&open, zero, one, 0, 1);
    add_box(&cloud, zero, one, 0, 6);
    CHECK_EQ(read_shape(&box, 0, &allowance, ""), OVOID_OK);
    CHECK_EQ(read_shape(&cloud, 0, &allowance, ""), OVOID_OK);
    CHECK_EQ(read_shape(&hollow, 0, &allowance, "closed and not convex"), OVOID_ERROR_NOT_CONVEX);
    CHECK_EQ(read_shape(&open, 0, &allowance, "not closed, 4 of its edges are open"), OVOID_ERROR_NOT_CONVEX);
    CHECK_EQ(read_shape(&hollow, 1, &allowance, ""), OVOID_OK);
    CHECK_EQ(read_shape(&open, 1, &allowance, ""), OVOID_OK);
    text near = make_dented_plate(1, 1.2e-6), far = make_dented_plate(1, 1.3e-6);
    CHECK_EQ(read_shape(&near, 0, &allowance, ""), OVOID_OK);
    CHECK(allowance >= 3.6e-6 && allowance < 3.6001e-6);
    CHECK_EQ(read_shape(&near, 1, &allowance, ""), OVOID_OK);
    CHECK_EQ(allowance, 0);
    CHECK_EQ(read_shape(&far, 0, &allowance, "closed and not convex"), OVOID_ERROR_NOT_CONVEX);
}

// Parts one by one, and through a scene, which names each hull of a mesh.
static void check_lists(void) {
    text t = {.length = 0};
    add(&t, "o whole\n");
    add_box(&t, zero, one, 0, 0);
    add(&t, "o hollow\n");
    add_box(&t, zero, three, 0, 0);
    add_box(&t, one, two, 1, 0);
    file_write_text("parts.obj", t.data);
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_scene *scene = ovoid_scene_read(
        file_write_text("convexity.json",
                        "{\"objects\": [{\"name\": \"a\", \"box\": [1, 1, 1]},"
                        "{\"name\": \"b\", \"mesh\": \"parts.obj\", \"parts\": true},"
                        "{\"name\": \"c\", \"mesh\": \"parts.obj\"},"
                        "{\"name\": \"d\", \"compound\": [{\"mesh\": \"parts.obj\", \"hull\": true}]}]}"),
        NULL, &error);
    if (!CHECK(scene != NULL)) return;
    // The file is there twice: as a body it may be a solid, as a part it is a hull.
    CHECK_EQ(ovoid_scene_get_mesh_count(scene), 4);
    ovoid_named_shape m[4];
    for (size_t i = 0; i < 4; i++) m[i] = ovoid_scene_get_mesh(scene, i);
    CHECK(strcmp(m[0].name, "whole") == 0 && m[0].convexity.kind == OVOID_MESH_HULL && m[0].convexity.mesh_volume == 1);
    CHECK(strcmp(m[1].name, "hollow") == 0 && m[1].convexity.kind == OVOID_MESH_SOLID);
    CHECK(strstr(m[2].name, "parts.obj") && m[2].shape == ovoid_scene_get(scene, 2).shape);
    CHECK(strstr(m[3].name, "parts.obj") && m[3].shape != m[2].shape);
    ovoid_scene_destroy(scene);
    // A shape file has no mesh.
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, &error);
    CHECK(ovoid_shape_write_file(box, file_path("box.ovoid"), &error) == OVOID_OK);
    ovoid_shape_destroy(box);
    ovoid_shapes *shapes = ovoid_shapes_read_file(file_path("box.ovoid"), NULL, NULL, &error);
    CHECK(shapes && isnan(ovoid_shapes_get(shapes, 0).convexity.mesh_volume));
    ovoid_shapes_destroy(shapes);
}

int main(void) {
    check_boxes();
    check_soup();
    check_threshold();
    check_shapes();
    check_lists();
    return check_end();
}
