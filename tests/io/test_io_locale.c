// A locale whose decimal sign is a comma changes nothing. Truth: what every writer wrote and every reader read before
// the locale was set, byte for byte and bit for bit; and the caller's locale is in force after each call.
#define _POSIX_C_SOURCE 200809L
#include "files.h"
#include "ovoid/ovoid.h"
#include "proofs/covers.h"

#include <locale.h>

enum { ITEMS = 16, ROOM = 1 << 18 };

/// What was written, or the numbers that were read.
static struct item {
    const char *name;
    size_t size;
    char data[ROOM];
} items[2][ITEMS];
static int item_count[2], round_now;

static void keep(const char *name, const void *data, size_t size) {
    struct item *x = &items[round_now][item_count[round_now]++];
    CHECK(size > 0 && size <= ROOM);
    x->name = name;
    x->size = size <= ROOM ? size : ROOM;
    memcpy(x->data, data, x->size);
    // The caller's own locale is as it was.
    char half[8];
    (void)snprintf(half, sizeof half, "%.1f", 0.5);
    CHECK(strcmp(half, round_now ? "0,5" : "0.5") == 0);
}

static void keep_file(const char *name, const char *path) {
    size_t size = 0;
    char *data = file_read(path, &size);
    if (CHECK(data != NULL)) keep(name, data, size);
    free(data);
}

// ---- writers

static ovoid_record make_record(const ovoid_pair *pair, ovoid_cover *cover) {
    return (ovoid_record){.a = "box", .b = "ball", .answer = ovoid_depth(pair, NULL, NULL, cover), .cover = cover};
}

static void write_results(const ovoid_pair *pair) {
    STATIC_COVER(cover);
    ovoid_record record = make_record(pair, &cover);
    for (int kind = 0; kind < 3; kind++) {
        const char *path = file_path("locale_results.txt");
        FILE *file = fopen(path, "w");
        if (!CHECK(file != NULL)) return;
        if (kind == 0) CHECK_EQ(ovoid_record_write_json(file, &record), OVOID_OK);
        if (kind == 1) CHECK_EQ(ovoid_record_write_csv(file, &record), OVOID_OK);
        if (kind == 2) CHECK_EQ(ovoid_records_write_table(file, &record, 1, NULL), OVOID_OK);
        fclose(file);
        keep_file(kind == 0 ? "json" : kind == 1 ? "csv" : "table", path);
    }
}

static void write_drawings(const ovoid_pair *pair) {
    const double y[] = {0.5, 1.25, 1e-3};
    ovoid_series series = {.name = "half", .count = 3, .y = y};
    ovoid_chart chart = {.series = &series, .series_count = 1, .y_log = 1};
    const char *path = file_path("locale_chart.svg");
    FILE *file = fopen(path, "w");
    if (!CHECK(file != NULL)) return;
    CHECK_EQ(ovoid_chart_write_svg(file, &chart), OVOID_OK);
    fclose(file);
    keep_file("chart", path);
    ovoid_picture_body bodies[2] = {{"box", pair->shape_a, pair->pose_a, 0, NULL, 0},
                                    {"ball", pair->shape_b, pair->pose_b, 0, NULL, 0}};
    ovoid_answer answer = ovoid_distance(pair, NULL, NULL);
    ovoid_picture_link link = {0, 1, &answer};
    ovoid_picture picture = {bodies, 2, &link, 1, "a title", "m"};
    path = file_path("locale_picture.svg");
    CHECK_EQ(ovoid_picture_write_svg(path, &picture, NULL, NULL), OVOID_OK);
    keep_file("picture", path);
}

// ---- readers

static void read_mesh(const char *name, const char *text) {
    ovoid_error error = {OVOID_OK, -1, ""};
    for (int trusted = 0; trusted < 2; trusted++) {
        ovoid_read_options options = {.trusted = trusted};
        ovoid_mesh *mesh = ovoid_mesh_read(file_write_text(name, text), &options, &error);
        if (!CHECK(mesh != NULL)) {
            printf("  %s\n", error.message);
            return;
        }
        ovoid_faces faces = ovoid_mesh_get_part(mesh, 0).faces;
        CHECK(faces.vertex_count == 3 && faces.vertices[0] == 0.5 && faces.vertices[2] == 0.25);
        keep(name, faces.vertices, 3 * faces.vertex_count * sizeof(double));
        ovoid_mesh_destroy(mesh);
    }
}

static const char x3d[] = "<?xml version=\"1.0\"?><X3D><Scene><Shape><IndexedFaceSet coordIndex=\"0 1 2 -1\">"
                          "<Coordinate point=\"0.5 0 0.25 1.5 0 0 0 1.5 0\"/></IndexedFaceSet></Shape></Scene></X3D>";
static const char dae[] =
    "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">"
    "<library_geometries><geometry id=\"g\"><mesh><source id=\"p\"><float_array id=\"a\" count=\"9\">0.5 0 0.25 1.5 0 "
    "0 0 "
    "1.5 0</float_array><technique_common><accessor source=\"#a\" count=\"3\" stride=\"3\"><param name=\"X\" "
    "type=\"float\"/><param name=\"Y\" type=\"float\"/><param name=\"Z\" type=\"float\"/></accessor></technique_common>"
    "</source><vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"1\">"
    "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry>"
    "</library_geometries><library_visual_scenes><visual_scene id=\"s\"><node><instance_geometry url=\"#g\"/></node>"
    "</visual_scene></library_visual_scenes><scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>";

static void read_meshes(void) {
    read_mesh("locale.obj", "v 0.5 0 0.25\nv 1.5 0 0\nv 0 1.5 0\nf 1 2 3\n");
    read_mesh("locale.off", "OFF\n3 1 0\n0.5 0 0.25\n1.5 0 0\n0 1.5 0\n3 0 1 2\n");
    read_mesh("locale.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0.5 0 0.25\nvertex 1.5 0 0\n"
                            "vertex 0 1.5 0\nendloop\nendfacet\nendsolid a\n");
    if (ovoid_io_has_assimp()) {
        read_mesh("locale.x3d", x3d);
        read_mesh("locale.dae", dae);
    } else {
        check_skip("built without Assimp");
    }
}

static void read_scene(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    const char *path = file_write_text(
        "locale.json", "{\"objects\":[{\"name\":\"a\",\"box\":[0.5,1.5,2.5],\"pose\":{\"xyz\":[0.25,0,1e-3]}}]}");
    ovoid_scene *scene = ovoid_scene_read(path, NULL, &error);
    if (!CHECK(scene != NULL)) return;
    ovoid_pose pose = ovoid_scene_get(scene, 0).pose;
    CHECK(pose.position.x == 0.25 && pose.position.z == 1e-3);
    path = file_write_text("locale.csv", "time,body,vx,vy,vz,wx,wy,wz\n0.5,a,0.25,0,0,0,0,1.5\n");
    ovoid_motion_reader *reader = ovoid_motion_reader_open(path, scene, &error);
    ovoid_motion_line line;
    if (CHECK(reader != NULL) && CHECK(ovoid_motion_reader_read(reader, &line, &error) == 1))
        CHECK(line.time == 0.5 && line.linear.x == 0.25 && line.angular.z == 1.5);
    ovoid_motion_reader_close(reader);
    ovoid_scene_destroy(scene);
    keep("scene", &pose, sizeof pose);
}

static void run(const ovoid_pair *pair) {
    write_results(pair);
    write_drawings(pair);
    read_meshes();
    read_scene();
}

int main(void) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){0.5, 1.5, 0.25}, NULL, NULL);
    ovoid_shape *ball = ovoid_shape_create_sphere(0.75, NULL, NULL);
    ovoid_pair pair = {box, ball, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
    pair.pose_b.position.x = 2.125;
    run(&pair);
    // Made when the tests were configured (tests/CMakeLists.txt), where the system has the sources of locales.
    setenv("LOCPATH", OVOID_BUILD_DIR "/locales", 1);
    round_now = 1;
    if (!setlocale(LC_ALL, "de_DE.UTF-8")) {
        check_skip("no locale with a decimal comma (Debian: locales)");
    } else {
        run(&pair);
        CHECK_EQ(item_count[0], item_count[1]);
        for (int i = 0; i < item_count[0]; i++) {
            const struct item *a = &items[0][i], *b = &items[1][i];
            if (!CHECK(a->size == b->size && memcmp(a->data, b->data, a->size) == 0)) printf("  %s\n", a->name);
        }
        setlocale(LC_ALL, "C");
    }
    ovoid_shape_destroy(box);
    ovoid_shape_destroy(ball);
    return check_end();
}
