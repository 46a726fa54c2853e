// Failing memory: for every k, the k-th allocation of each operation fails. Truth: then the operation says MEMORY, and
// nothing leaks (the leak checker of the sanitizers says so at the end); with enough memory it succeeds. jansson is
// told of the functions that fail.
#include "failing.h"
#include "files.h"

#include <jansson.h>

// ---- the operations: each returns 1 where it succeeded

static const char *mesh_path;

static int read_mesh(ovoid_error *error) {
    ovoid_read_options options = {.parts = 1};
    ovoid_mesh *mesh = ovoid_mesh_read(mesh_path, &options, error);
    ovoid_mesh_destroy(mesh);
    return mesh != NULL;
}

static int read_parts(ovoid_error *error) {
    ovoid_read_options options = {.parts = 1};
    ovoid_shapes *shapes = ovoid_shapes_read_file(file_path("memory.obj"), &options, NULL, error);
    ovoid_shapes_destroy(shapes);
    return shapes != NULL;
}

static int read_list(ovoid_error *error) {
    ovoid_shapes *shapes = ovoid_shapes_read_list(file_path("memory.txt"), NULL, NULL, error);
    ovoid_shapes_destroy(shapes);
    return shapes != NULL;
}

static int read_scene(ovoid_error *error) {
    ovoid_scene *scene = ovoid_scene_read(file_path("memory.json"), NULL, error);
    ovoid_scene_destroy(scene);
    return scene != NULL;
}

static ovoid_scene *packed;

static int pack_scene(ovoid_error *error) {
    return ovoid_scene_write(packed, file_path("memory.ovoids"), error) == OVOID_OK;
}

static int unpack_scene(ovoid_error *error) {
    ovoid_scene *scene = ovoid_scene_read(file_path("memory.ovoids"), NULL, error);
    ovoid_scene_destroy(scene);
    return scene != NULL;
}

static int read_pairs(ovoid_error *error) {
    ovoid_pairs_reader *reader = ovoid_pairs_reader_open(file_path("memory.csv"), 2, error);
    ovoid_indexed_pair pair;
    int got = reader ? ovoid_pairs_reader_read(reader, &pair, error) : -1;
    ovoid_pairs_reader_close(reader);
    return got == 1;
}

static int read_compound(ovoid_error *error) {
    ovoid_read_options options = {.parts = 1};
    ovoid_shapes *parts = ovoid_shapes_read_file(file_path("memory.obj"), &options, NULL, error);
    ovoid_compound *compound = parts ? ovoid_shapes_create_compound(parts, NULL, error) : NULL;
    int made = compound != NULL;
    ovoid_compound_destroy(compound);
    ovoid_shapes_destroy(parts);
    return made;
}

static ovoid_scene *moved;

static int read_motion(ovoid_error *error) {
    ovoid_motion_reader *reader = ovoid_motion_reader_open(file_path("memory_motion.csv"), moved, error);
    ovoid_motion_line line;
    int got = reader ? ovoid_motion_reader_read(reader, &line, error) : -1;
    if (got == 1 && ovoid_motion_reader_skip(reader, 2, error) != OVOID_OK) got = -1;
    if (got == 1) got = ovoid_motion_reader_read(reader, &line, error);
    ovoid_motion_reader_close(reader);
    return got == 1;
}

static int read_results(ovoid_error *error) {
    ovoid_results_reader *reader = ovoid_results_reader_open(file_path("memory.jsonl"), error);
    ovoid_record record;
    int got = reader ? ovoid_results_reader_read(reader, &record, error) : -1;
    ovoid_results_reader_close(reader);
    return got == 1;
}

static ovoid_shape *shapes[2];

static int write_picture(ovoid_error *error) {
    ovoid_picture_body bodies[2] = {{"a", shapes[0], ovoid_pose_make_identity(), 0, NULL, 0},
                                    {"b", shapes[1], ovoid_pose_make_identity(), 0, NULL, 0}};
    ovoid_picture picture = {.bodies = bodies, .body_count = 2, .title = "t"};
    ovoid_picture_options options = {.layers = 63};
    return ovoid_picture_write_svg(file_path("memory.svg"), &picture, &options, error) == OVOID_OK;
}

static const char obj[] = "o a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 2 4\no b\nv 5 0 0\nv 6 0 0\nv 5 1 0\n"
                          "v 5 0 1\nf 5 6 7\nf 8 7 6\n";
static const char stl[] = "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\n"
                          "endfacet\nendsolid\n";
static const char off[] = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
static const char ply[] =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
static const char scene[] =
    "{\"objects\":[{\"name\":\"a\",\"mesh\":\"memory.obj\"},{\"name\":\"b\",\"mesh\":\"memory.obj\"},"
    "{\"name\":\"e\",\"compound\":[{\"box\":[1,1,1]},{\"mesh\":\"memory.obj\",\"parts\":true}]},"
    "{\"name\":\"c\",\"box\":[1,1,1]},{\"name\":\"d\",\"points\":[[0,0,0],[1,0,0]]}],\"ignore\":[[\"a\",\"b\"]]}";
static const char csv[] = "a,b,ax,ay,az,aqw,aqx,aqy,aqz,bx,by,bz,bqw,bqx,bqy,bqz\n0,1,0,0,0,1,0,0,0,0,0,0,1,0,0,0\n";

int main(void) {
    json_set_alloc_funcs(__wrap_malloc, free);
    const char *meshes[] = {file_write_text("memory.obj", obj), file_write_text("memory.stl", stl),
                            file_write_text("memory.off", off), file_write_text("memory.ply", ply)};
    for (int i = 0; i < 4; i++) {
        mesh_path = meshes[i];
        check_operation(mesh_path, 0, read_mesh);
    }
    check_operation("parts", 0, read_parts);
    check_operation("compound", 0, read_compound);
    file_write_text("memory.txt", "memory.obj\nmemory.stl\nmemory.obj\n");
    check_operation("list", 0, read_list);
    file_write_text("memory.json", scene);
    check_operation("scene", 1, read_scene);
    packed = ovoid_scene_read(file_path("memory.json"), NULL, NULL);
    check_operation("packing", 0, pack_scene);
    check_operation("packed scene", 0, unpack_scene);
    ovoid_scene_destroy(packed);
    file_write_text("memory.csv", csv);
    check_operation("pairs", 0, read_pairs);
    moved = ovoid_scene_read(file_path("memory.json"), NULL, NULL);
    file_write_text("memory_motion.csv", "time,body,x,y,z,qw,qx,qy,qz\n0,a,0,0,0,1,0,0,0\n"
                                         "1,b,0,0,0,1,0,0,0\n2,a,0,0,0,1,0,0,0\n");
    check_operation("motion", 0, read_motion);
    ovoid_scene_destroy(moved);
    FILE *file = fopen(file_path("memory.jsonl"), "wb");
    ovoid_exclusion exclusion = {0, 1, 0, 1, {0, 0, 1}, {0, 0, 0}, 1};
    ovoid_step step = {1, {0, 0, 1}, OVOID_STEP_A};
    ovoid_record record = {.a = "a", .b = "b"};
    record.exclusions = &exclusion;
    record.steps = &step;
    ovoid_step_group group = {0, 1, 0, 1, 1};
    record.groups = &group;
    record.group_count = record.exclusion_count = record.step_count = 1;
    ovoid_record_write_json(file, &record);
    fclose(file);
    check_operation("results", 1, read_results);
    shapes[0] = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    shapes[1] = ovoid_shape_create_capsule(0.1, 1, NULL, NULL);
    check_operation("picture", 0, write_picture);
    ovoid_shape_destroy(shapes[0]);
    ovoid_shape_destroy(shapes[1]);
    return check_end();
}
