// Packed scenes. Truth: the scene of JSON that was packed: the same objects, shapes to the bit of their files, solids
// with the same triangles, in the same order; packed again it is the same file. No damaged file is read: each byte is
// altered, each length is cut, and numbers are altered under a checksum that agrees. tests/cli has the results.
#include "files.h"

#include "io/scene/scene_packed.h"

static const char cube[] = "o one\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n"
                           "o two\nv 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 5 8 7\n";
static const char angle[] =
    "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\n"
    "v 0 2 1\nf 4 3 2\nf 4 2 1\nf 4 1 6\nf 4 6 5\nf 10 8 9\nf 10 7 8\nf 10 12 7\nf 10 11 12\nf 1 2 8 7\n"
    "f 2 3 9 8\nf 3 4 10 9\nf 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n";
static const char scene_text[] =
    "{\"unit\": \"mm\", \"objects\": [\n"
    "{\"name\": \"z\", \"box\": [1, 2, 3], \"pose\": {\"xyz\": [1, 2, 3], \"rpy\": [0.1, 0.2, 0.3]}},\n"
    "{\"name\": \"b\", \"box\": [1, 2, 3], \"radius\": 0.25},\n"
    "{\"name\": \"same\", \"box\": [1, 2, 3]},\n"
    "{\"name\": \"c\", \"cylinder\": {\"radius\": 1, \"length\": 2}, \"allowance\": {\"outside\": 0.125}},\n"
    "{\"name\": \"e\", \"ellipsoid\": {\"half_axes\": [1, 2, 3], \"tolerance\": 0.01}},\n"
    "{\"name\": \"p\", \"points\": [[0,0,0],[1,0,0],[0,1,0]], \"scale\": 2},\n"
    "{\"name\": \"tetras\", \"mesh\": \"packed_cube.obj\", \"parts\": true, \"unit\": \"m\"},\n"
    "{\"name\": \"angle\", \"mesh\": \"packed_angle.obj\"},\n"
    "{\"name\": \"asked\", \"mesh\": \"packed_angle.obj\", \"solid\": true, \"scale\": 3},\n"
    "{\"name\": \"hull\", \"mesh\": \"packed_angle.obj\", \"hull\": true},\n"
    "{\"name\": \"joined\", \"compound\": [{\"box\": [1, 2, 3]}, {\"sphere\": 1, \"pose\": {\"xyz\": [0, 0, 2]}},\n"
    "  {\"mesh\": \"packed_cube.obj\", \"parts\": true, \"unit\": \"m\"}]},\n"
    "{\"name\": \"\\u00e4\\\"\", \"sphere\": 2}],\n"
    "\"ignore\": [[\"z\", \"b\"], [\"e\", \"c\"], [\"b\", \"z\"]]}\n";

// The bytes of a file; the caller frees them.
static bytes read_all(const char *path) {
    bytes file = {NULL, 0};
    CHECK(bytes_read(path, &file, NULL) == OVOID_OK);
    return file;
}

static int is_same_shape(const ovoid_shape *a, const ovoid_shape *b) {
    if (!a || !b) return a == b;
    size_t size = ovoid_shape_write(a, NULL, 0);
    char *bytes_a = calloc(1, size), *bytes_b = calloc(1, size);
    int same = ovoid_shape_write(b, NULL, 0) == size && ovoid_shape_write(a, bytes_a, size) == size &&
               ovoid_shape_write(b, bytes_b, size) == size && memcmp(bytes_a, bytes_b, size) == 0;
    free(bytes_a);
    free(bytes_b);
    return same;
}

static int is_same_compound(const ovoid_compound *a, const ovoid_compound *b) {
    if (!a || !b) return a == b;
    size_t count = ovoid_compound_get_part_count(a);
    int same = ovoid_compound_get_part_count(b) == count;
    for (size_t i = 0; i < count && same; i++) {
        ovoid_posed_shape p = ovoid_compound_get_part(a, i), q = ovoid_compound_get_part(b, i);
        same = is_same_shape(p.shape, q.shape) && memcmp(&p.pose, &q.pose, sizeof p.pose) == 0;
    }
    return same;
}

static int is_same_solid(const ovoid_solid *a, const ovoid_solid *b) {
    if (!a || !b) return a == b;
    ovoid_solid_report r = ovoid_solid_get_report(a), s = ovoid_solid_get_report(b);
    int same = r.points == s.points && r.triangles == s.triangles && r.volume == s.volume &&
               r.is_closed == s.is_closed &&
               memcmp(ovoid_solid_get_points(a), ovoid_solid_get_points(b), (size_t)r.points * 24) == 0;
    for (size_t i = 0; i < r.triangles && same; i++) {
        uint32_t p[3], q[3];
        ovoid_solid_get_triangle(a, i, p);
        ovoid_solid_get_triangle(b, i, q);
        same = memcmp(p, q, sizeof p) == 0;
    }
    return same;
}

static int is_same_number(double a, double b) { return memcmp(&a, &b, sizeof a) == 0 || (isnan(a) && isnan(b)); }

static int is_same_text(const char *a, const char *b) { return a && b ? strcmp(a, b) == 0 : a == b; }

static int is_same_convexity(const ovoid_convexity *a, const ovoid_convexity *b) {
    return a->kind == b->kind && is_same_number(a->allowance, b->allowance) &&
           a->edges_unmatched == b->edges_unmatched && is_same_number(a->mesh_volume, b->mesh_volume) &&
           is_same_number(a->hull_volume, b->hull_volume);
}

static void check_object(const ovoid_scene_object *a, const ovoid_scene_object *b) {
    CHECK(is_same_text(a->name, b->name) && memcmp(&a->pose, &b->pose, sizeof a->pose) == 0);
    CHECK(is_same_shape(a->shape, b->shape) && is_same_compound(a->compound, b->compound));
    CHECK(is_same_solid(a->solid, b->solid) && a->kind == b->kind && a->is_asked == b->is_asked);
    CHECK(is_same_text(a->mesh, b->mesh) && is_same_number(a->read.scale, b->read.scale));
    CHECK(is_same_text(a->read.unit, b->read.unit) && a->read.parts == b->read.parts && a->read.hull == b->read.hull &&
          a->read.solid == b->read.solid);
    CHECK(is_same_convexity(&a->convexity, &b->convexity));
}

static void check_same(const ovoid_scene *a, const ovoid_scene *b) {
    size_t count = ovoid_scene_get_count(a), meshes = ovoid_scene_get_mesh_count(a);
    CHECK_EQ(ovoid_scene_get_count(b), count);
    CHECK_EQ(ovoid_scene_get_mesh_count(b), meshes);
    CHECK_EQ(ovoid_scene_get_pair_count(b), ovoid_scene_get_pair_count(a));
    CHECK(strcmp(ovoid_scene_get_unit(a), ovoid_scene_get_unit(b)) == 0);
    for (size_t i = 0; i < count; i++) {
        ovoid_scene_object p = ovoid_scene_get(a, i), q = ovoid_scene_get(b, i);
        check_object(&p, &q);
        CHECK_EQ(ovoid_scene_find(b, p.name), i);
        for (size_t k = 0; k < count; k++) CHECK_EQ(ovoid_scene_is_ignored(b, i, k), ovoid_scene_is_ignored(a, i, k));
    }
    for (size_t i = 0; i < meshes; i++) {
        ovoid_named_shape p = ovoid_scene_get_mesh(a, i), q = ovoid_scene_get_mesh(b, i);
        CHECK(is_same_text(p.name, q.name) && is_same_shape(p.shape, q.shape) && is_same_solid(p.solid, q.solid));
        CHECK(is_same_convexity(&p.convexity, &q.convexity));
        CHECK(is_same_solid(ovoid_scene_get_mesh_solid(a, i), ovoid_scene_get_mesh_solid(b, i)));
    }
}

typedef ovoid_scene *scene_reader_of(const char *path, const ovoid_shape_options *options, ovoid_error *error);

// A scene, packed, read and packed again. Shared bodies stay shared.
static void check_packed(const char *json, const char *name, scene_reader_of *read) {
    char packed[300], again[310];
    ovoid_error error = {OVOID_OK, -1, ""};
    snprintf(packed, sizeof packed, "%s", file_path(name));
    snprintf(again, sizeof again, "%s.again", packed);
    ovoid_scene *scene = read(json, NULL, &error);
    if (!CHECK(scene != NULL)) return;
    CHECK_EQ(ovoid_scene_write(scene, packed, &error), OVOID_OK);
    ovoid_scene *copy = read(packed, NULL, &error);
    if (CHECK(copy != NULL)) {
        check_same(scene, copy);
        CHECK(ovoid_scene_get(copy, 0).shape == ovoid_scene_get(copy, 2).shape);
        CHECK_EQ(ovoid_scene_write(copy, again, &error), OVOID_OK);
        bytes one = read_all(packed), two = read_all(again);
        CHECK(one.size == two.size && memcmp(one.data, two.data, one.size) == 0);
        free(one.data);
        free(two.data);
    } else {
        printf("  %s\n", error.message);
    }
    ovoid_scene_destroy(scene);
    ovoid_scene_destroy(copy);
}

// The other reader refuses a file of meshes that the scene leaves open, and reads one that has none.
static void check_choice(const char *packed, scene_reader_of *other, const char *word) {
    ovoid_error error = {OVOID_OK, -1, ""};
    CHECK(other(packed, NULL, &error) == NULL);
    CHECK_EQ(error.code, OVOID_ERROR_ARGUMENT);
    CHECK(strstr(error.message, word) != NULL);
    const char *path = file_write_text("packed_free.json", "{\"objects\": [{\"name\": \"a\", \"sphere\": 1}]}");
    ovoid_scene *scene = ovoid_scene_read(path, NULL, &error);
    CHECK_EQ(ovoid_scene_write(scene, file_path("packed_free.ovoids"), &error), OVOID_OK);
    ovoid_scene_destroy(scene);
    scene = other(file_path("packed_free.ovoids"), NULL, &error);
    CHECK(scene != NULL);
    ovoid_scene_destroy(scene);
}

// A new file each time: many file systems flush one that is made empty and written anew.
static void write_bytes(const char *path, const char *data, size_t size) {
    remove(path);
    FILE *file = fopen(path, "wb");
    CHECK(file && fwrite(data, 1, size, file) == size);
    if (file) fclose(file);
}

// 1 if the bytes are read as a scene; else there is an error with a code and a sentence.
static int is_read(const char *data, size_t size) {
    char path[300];
    snprintf(path, sizeof path, "%s", file_path("packed_damaged.ovoids"));
    ovoid_error error = {OVOID_OK, -1, ""};
    write_bytes(path, data, size);
    ovoid_scene *scene = ovoid_scene_read(path, NULL, &error);
    if (!scene) CHECK(error.code != OVOID_OK && error.message[0]);
    for (size_t i = 0; scene && i < ovoid_scene_get_count(scene); i++)
        CHECK_EQ(ovoid_scene_find(scene, ovoid_scene_get(scene, i).name), i);
    ovoid_scene_destroy(scene);
    return scene != NULL;
}

static void set_checksum(bytes file) {
    packed_header *h = (packed_header *)(void *)file.data;
    if (h->size == file.size) h->checksum = packed_compute_checksum(h);
}

// Bytes that are altered under a checksum that agrees: read or refused, never worse.
static void check_lies(bytes file) {
    uint64_t s = 5;
    int taken = 0, rounds = 3000;
    char *kept = malloc(file.size);
    memcpy(kept, file.data, file.size);
    for (int i = 0; i < rounds; i++) {
        check_seed = s;
        // Half of them among the numbers of the header and the bodies at the end.
        size_t part = i % 4 == 0 ? sizeof(packed_header) : file.size;
        size_t at =
            (i % 4 == 1 ? file.size - file.size / 8 : 0) + random_next(&s) % (i % 4 == 1 ? file.size / 8 : part);
        uint64_t byte = random_next(&s);
        file.data[at] = byte % 3 ? (char)(file.data[at] + 1) : (char)(byte >> 8);
        set_checksum(file);
        taken += is_read(file.data, file.size);
        memcpy(file.data, kept, file.size);
    }
    check_seed = 0;
    CHECK(taken > 0 && taken < rounds * 3 / 4);
    free(kept);
}

// A part of a compound that is no body's own, which could not be packed again.
static void check_parts(void) {
    static const char json[] =
        "{\"objects\": [{\"name\": \"a\", \"box\": [1, 1, 1]}, {\"name\": \"b\", \"sphere\": 1}, {\"name\": \"c\", "
        "\"compound\": [{\"box\": [1, 1, 1]}, {\"sphere\": 1}]}]}";
    char path[300];
    bytes file;
    file_write_text("packed_parts.json", json);
    ovoid_scene *scene = ovoid_scene_read(file_path("packed_parts.json"), NULL, NULL);
    snprintf(path, sizeof path, "%s", file_path("packed_parts.ovoids"));
    if (!CHECK(scene != NULL)) return;
    CHECK_EQ(ovoid_scene_write(scene, path, NULL), OVOID_OK);
    ovoid_scene_destroy(scene);
    if (!CHECK(bytes_read(path, &file, NULL) == OVOID_OK)) return;
    // The second body has the shape of the first.
    uint64_t *number = (uint64_t *)(void *)(file.data + file.size) - (2 + 2 * 8) - 1;
    CHECK_EQ(*number, 1);
    *number = 0;
    set_checksum(file);
    CHECK(!is_read(file.data, file.size));
    free(file.data);
}

static void check_damaged(const char *packed) {
    bytes file = read_all(packed);
    CHECK(is_read(file.data, file.size));
    for (size_t i = 0; i < file.size; i += i < 400 ? 1 : 37) {
        char kept = file.data[i];
        file.data[i] = (char)(kept ^ (char)(1 << i % 8));
        CHECK(!is_read(file.data, file.size));
        file.data[i] = kept;
    }
    for (size_t size = 0; size < file.size; size += size < 200 ? 1 : 41) CHECK(!is_read(file.data, size));
    check_lies(file);
    free(file.data);
}

// What each refusal says.
static void check_words(const char *packed) {
    static const struct {
        size_t at;
        const char *word;
    } cases[] = {{offsetof(packed_header, version), "another version"},
                 {offsetof(packed_header, order), "another byte order"},
                 {offsetof(packed_header, checksum), "damaged"},
                 {offsetof(packed_header, object_count) + 1, "damaged"},
                 {offsetof(packed_header, size) + 2, "cut off"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ovoid_error error = {OVOID_OK, -1, ""};
        bytes file = read_all(packed);
        file.data[cases[i].at] ^= 64;
        write_bytes(file_path("packed_word.ovoids"), file.data, file.size);
        CHECK(ovoid_scene_read(file_path("packed_word.ovoids"), NULL, &error) == NULL);
        if (!CHECK(strstr(error.message, cases[i].word) != NULL)) printf("  %s\n", error.message);
        free(file.data);
    }
    // Cut anywhere, it is a packed scene that was cut.
    bytes file = read_all(packed);
    for (size_t size = 1; size < 100; size++) {
        ovoid_error error = {OVOID_OK, -1, ""};
        write_bytes(file_path("packed_word.ovoids"), file.data, size);
        CHECK(ovoid_scene_read(file_path("packed_word.ovoids"), NULL, &error) == NULL);
        const char *word =
            size < sizeof(packed_header) ? "packed scene, byte 0: it ends within its header" : "it is cut off";
        if (!CHECK(strstr(error.message, word) != NULL)) printf("  %s\n", error.message);
    }
    free(file.data);
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_scene *scene = ovoid_scene_read(packed, NULL, &error);
    CHECK_EQ(ovoid_scene_write(scene, file_path("no/such/folder.ovoids"), &error), OVOID_ERROR_FILE);
    ovoid_scene_destroy(scene);
}

// The packed file of a scene's text; valid until the eighth next path.
static const char *pack_text(const char *text) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_scene *scene = ovoid_scene_read(file_write_text("packed_text.json", text), NULL, &error);
    if (!CHECK(scene != NULL)) printf("  %s\n", error.message);
    const char *path = file_path("packed_text.ovoids");
    CHECK_EQ(ovoid_scene_write(scene, path, &error), OVOID_OK);
    ovoid_scene_destroy(scene);
    return path;
}

// A mesh that is left open is a choice, one that is not is none.
static void check_open(void) {
    ovoid_error error;
    const char *open = pack_text("{\"objects\": [{\"name\": \"a\", \"mesh\": \"packed_angle.obj\"}]}");
    CHECK(ovoid_scene_read_hulls(open, NULL, &error) == NULL);
    const char *said = pack_text("{\"objects\": [{\"name\": \"a\", \"mesh\": \"packed_angle.obj\", \"solid\": true}]}");
    ovoid_scene *scene = ovoid_scene_read_hulls(said, NULL, &error);
    CHECK(scene != NULL && ovoid_scene_get(scene, 0).solid != NULL);
    ovoid_scene_destroy(scene);
}

// Writes eight bytes into a file under a checksum that agrees: it is refused.
static void check_refused(bytes file, size_t at, const void *eight, const char *word) {
    ovoid_error error = {OVOID_OK, -1, ""};
    char *kept = malloc(file.size);
    memcpy(kept, file.data, file.size);
    memcpy(file.data + at, eight, 8);
    set_checksum(file);
    write_bytes(file_path("packed_number.ovoids"), file.data, file.size);
    ovoid_scene *scene = ovoid_scene_read(file_path("packed_number.ovoids"), NULL, &error);
    if (!CHECK(!scene && strstr(error.message, word))) printf("  %s\n", error.message);
    ovoid_scene_destroy(scene);
    memcpy(file.data, kept, file.size);
    free(kept);
}

// Numbers just beyond their range, in a file of one mesh of two parts.
static void check_numbers(void) {
    bytes file =
        read_all(pack_text("{\"objects\": [{\"name\": \"t\", \"mesh\": \"packed_cube.obj\", \"parts\": true}]}"));
    const size_t object = sizeof(packed_header), shapes = object + sizeof(packed_object) + 8 + 8;
    size_t body = shapes;
    for (int i = 0; i < 2; i++) {
        uint64_t size;
        memcpy(&size, file.data + body, sizeof size);
        body += 8 + packed_round((size_t)size);
    }
    uint64_t kind;
    memcpy(&kind, file.data + body, sizeof kind);
    CHECK_EQ(kind, (uint64_t)PACKED_MESH);
    check_refused(file, object + offsetof(packed_object, name), (uint32_t[]){0, 1}, "no body");
    check_refused(file, object + offsetof(packed_object, name), (uint32_t[]){2, 0}, "no name");
    check_refused(file, object, &(double){NAN}, "pose");
    check_refused(file, object, &(double){2 * OVOID_LENGTH_MAX}, "pose");
    check_refused(file, object + 24, &(double){NAN}, "pose");
    check_refused(file, body + 8, &(uint64_t){1}, "not the shapes");
    check_refused(file, body + 16, &(uint64_t){3}, "not the shapes");
    check_refused(file, body + 16, &(uint64_t){UINT64_MAX}, "not the shapes");
    check_refused(file, body + 24, &(uint64_t){0}, "not the shapes");
    check_refused(file, body + 32, &(double){0}, "not the shapes");
    free(file.data);
}

// The checksum of bytes: each bit of each byte and their number count, zeros at the end too.
static void check_checksum(void) {
    uint8_t data[48] = {0};
    for (size_t size = 0; size < 40; size++) {
        uint64_t sum = checksum_bytes(data, size);
        CHECK(sum != checksum_bytes(data, size + 1) && sum != checksum_bytes(data, size + 8));
        for (size_t i = 0; i < 8 * size; i++) {
            data[i / 8] ^= (uint8_t)(1 << i % 8);
            CHECK(sum != checksum_bytes(data, size));
            data[i / 8] ^= (uint8_t)(1 << i % 8);
        }
        data[size] = 1; // behind the end
        CHECK_EQ(checksum_bytes(data, size), sum);
        data[size] = 0;
    }
}

// The mesh of an object, read again: of the file that the scene was made from, and no other. Each byte of that counts.
static void check_meshes(const char *path, const char *word) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_scene *scene = ovoid_scene_read(path, NULL, &error);
    ovoid_mesh *mesh = ovoid_scene_read_mesh(scene, ovoid_scene_find(scene, "tetras"), &error);
    // Without parts it would be one; in millimetres.
    if (CHECK(mesh != NULL) && CHECK_EQ(ovoid_mesh_get_part_count(mesh), (size_t)2)) {
        ovoid_faces faces = ovoid_mesh_get_part(mesh, 0).faces;
        double largest = 0;
        for (size_t i = 0; i < 3 * faces.vertex_count; i++) largest = fmax(largest, faces.vertices[i]);
        CHECK_EQ(largest, 1000.0);
    }
    ovoid_mesh_destroy(mesh);
    CHECK(ovoid_scene_read_mesh(scene, ovoid_scene_find(scene, "z"), &error) == NULL);
    CHECK(error.code == OVOID_ERROR_ARGUMENT && strstr(error.message, "z: the object has no mesh"));
    size_t angle_object = ovoid_scene_find(scene, "angle"), length = strlen(angle);
    char *other = malloc(length + 2);
    for (size_t i = 0; i <= length; i++) {
        memcpy(other, angle, length + 1);
        // Another blank in the place of one, or a line end behind all: the mesh is the same, the file is not.
        if (i < length && other[i] != ' ') continue;
        memcpy(other + i, i < length ? "\t" : "\n", i < length ? 1 : 2);
        file_write_text("packed_angle.obj", other);
        if (!CHECK(ovoid_scene_read_mesh(scene, angle_object, &error) == NULL && error.code == OVOID_ERROR_FORMAT &&
                   strstr(error.message, word)))
            printf("  byte %zu: %s\n", i, error.message);
    }
    free(other);
    remove(file_path("packed_angle.obj"));
    CHECK(ovoid_scene_read_mesh(scene, angle_object, &error) == NULL && error.code == OVOID_ERROR_FILE);
    file_write_text("packed_angle.obj", angle);
    mesh = ovoid_scene_read_mesh(scene, angle_object, &error);
    CHECK(mesh != NULL);
    ovoid_mesh_destroy(mesh);
    ovoid_scene_destroy(scene);
}

int main(void) {
    char json[300], solids[300], hulls[300];
    file_write_text("packed_cube.obj", cube);
    file_write_text("packed_angle.obj", angle);
    snprintf(json, sizeof json, "%s", file_write_text("packed.json", scene_text));
    check_packed(json, "packed.ovoids", ovoid_scene_read);
    check_packed(json, "packed_hulls.ovoids", ovoid_scene_read_hulls);
    snprintf(solids, sizeof solids, "%s", file_path("packed.ovoids"));
    snprintf(hulls, sizeof hulls, "%s", file_path("packed_hulls.ovoids"));
    check_choice(solids, ovoid_scene_read_hulls, "with --hull to read it so");
    check_choice(hulls, ovoid_scene_read, "read it with --hull");
    check_damaged(solids);
    check_parts();
    check_words(solids);
    check_open();
    check_numbers();
    check_checksum();
    check_meshes(json, "was changed since the scene was read");
    check_meshes(solids, "was changed since the scene was packed; pack the scene again");
    return check_end();
}
