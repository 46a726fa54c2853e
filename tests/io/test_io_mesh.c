// Readers of meshes. Truth: files written here byte by byte, so that every point and face is known; the table of bad
// inputs says of each by name which error it must give and where. Real files, where they are: counts of their own
// headers, and agreement between formats.
#include "files.h"

static double sum_of(const ovoid_faces *faces) {
    double sum = 0;
    for (size_t i = 0; i < 3 * faces->vertex_count; i++) sum += faces->vertices[i] * (double)(i % 7 + 1);
    return sum;
}

// ---- one tetrahedron in every format: points (0,0,0) (1,0,0) (0,1,0) (0,0,1), four faces

static const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
static const unsigned faces_of[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

/// Bytes under construction.
typedef struct buffer {
    unsigned char data[4096];
    size_t size;
} buffer;

static void put(buffer *b, const void *data, size_t size) {
    memcpy(b->data + b->size, data, size);
    b->size += size;
}
static void put_text(buffer *b, const char *text) { put(b, text, strlen(text)); }

// The bytes of a number in either order, on any machine.
static void put_bits(buffer *b, uint64_t bits, int size, int big) {
    for (int i = 0; i < size; i++) b->data[b->size++] = (unsigned char)(bits >> 8 * (big ? size - 1 - i : i));
}
static void put_float(buffer *b, double value, int big) {
    float f = (float)value;
    uint32_t bits;
    memcpy(&bits, &f, 4);
    put_bits(b, bits, 4, big);
}
static void put_double(buffer *b, double value, int big) {
    uint64_t bits;
    memcpy(&bits, &value, 8);
    put_bits(b, bits, 8, big);
}

static buffer make_binary_stl(const char *header) {
    buffer b = {.size = 0};
    char head[80] = {0};
    strncpy(head, header, 79);
    put(&b, head, 80);
    put_bits(&b, 4, 4, 0);
    for (int f = 0; f < 4; f++) {
        for (int k = 0; k < 3; k++) put_float(&b, NAN, 0); // the normal is not looked at
        for (int k = 0; k < 3; k++)
            for (int j = 0; j < 3; j++) put_float(&b, corners[faces_of[f][k]][j], 0);
        put_bits(&b, 0xabcd, 2, 0);
    }
    return b;
}

static buffer make_binary_ply(int big) {
    buffer b = {.size = 0};
    put_text(&b, "ply\r\nformat binary_");
    put_text(&b, big ? "big" : "little");
    put_text(&b, "_endian 1.0\r\ncomment x\r\nelement junk 2\r\nproperty list uchar short stuff\r\n"
                 "element vertex 4\r\nproperty double x\r\nproperty uchar red\r\nproperty float y\r\n"
                 "property double z\r\nelement face 4\r\nproperty list uchar int vertex_indices\r\n"
                 "property ushort flags\r\nend_header\r\n");
    for (int i = 0; i < 2; i++) {
        put_bits(&b, 1, 1, big);
        put_bits(&b, 77, 2, big);
    }
    for (int i = 0; i < 4; i++) {
        put_double(&b, corners[i][0], big);
        put_bits(&b, 9, 1, big);
        put_float(&b, corners[i][1], big);
        put_double(&b, corners[i][2], big);
    }
    for (int f = 0; f < 4; f++) {
        put_bits(&b, 3, 1, big);
        for (int k = 0; k < 3; k++) put_bits(&b, faces_of[f][k], 4, big);
        put_bits(&b, 5, 2, big);
    }
    return b;
}

static const char text_stl[] =
    "solid  a body \r\n"
    "facet normal nan 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\n"
    "endloop\nendfacet\n"
    " FACET normal 0 0 0 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 0 1 endloop endfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex -0 0 0\nvertex 0 0 1e0\nvertex 0 1 0\n"
    "endloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 1.0\n"
    "endloop\nendfacet\n"
    "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 1 0 0\nvertex 0 0 1.0\n"
    "endloop\nendfacet\nendsolid a body";

static const char text_obj[] = "# a comment\r\nmtllib a b.mtl\nv 0 0 0 1\n\tv\t1 0 \\\n 0\nvt 0.5\nvn 0 0 1\n"
                               "v 0 1 0 0.1 0.2 0.3\nv 0 0 1\nusemtl x\ns off\n"
                               "f 1/9999/7 3//-5 2/1\nf -4 -3 -1\nf 1 \\\r\n4 \\\n3\nf 2 3 4\nl 1 2\np 3\n";

static const char text_off[] = "COFF # colours\n# a comment\n4 4 6\n\n0 0 0 255 0 0 255\n1 0 0 0 0 0 0\n0 1 0 1 1 1 1\n"
                               "0 0 1 1 1 1 1 # last\n3 0 2 1 255 0 0\n3 0 1 3\n3 0 3 2\n3 1 2 3";

static const char text_ply[] = "ply\nformat ascii 1.0\nobj_info y\nelement vertex 4\nproperty float32 x\n"
                               "property float y\nproperty float z\nproperty int8 q\nelement face 4\n"
                               "property list uint8 int32 vertex_index\nelement edge 1\nproperty int a\nend_header\n"
                               "0 0 0 -1\n1 0 0 2\n0 1 0 3\n0 0 1 4\n3 0 2 1\n3 0 1 3\n3 0 3 2 3 1 2 3\n17\n";

// A glTF file whose triangles lie in a data URI: the same points, moved by (10, 0, 0) and doubled by its two nodes.
static const char text_gltf[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
    "\"nodes\":[{\"name\":\"up\",\"translation\":[10,0,0],\"children\":[1]},"
    "{\"name\":\"down\",\"scale\":[2,2,2],\"mesh\":0}],"
    "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
    "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],"
    "\"max\":[1,1,0]}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
    "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
    "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}";

// The file holds the tetrahedron, to the last bit, with its faces in the order above.
static void check_tetrahedron(const char *path, double scale) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_read_options options = {.scale = scale};
    ovoid_mesh *mesh = ovoid_mesh_read(path, &options, &error);
    if (!CHECK(mesh != NULL)) {
        printf("  %s\n", error.message);
        return;
    }
    CHECK_EQ(ovoid_mesh_get_part_count(mesh), 1);
    ovoid_faces faces = ovoid_mesh_get_part(mesh, 0).faces;
    CHECK_EQ(faces.vertex_count, 4);
    CHECK_EQ(faces.face_count, 4);
    // STL gives the points in the order of the faces; compare the corners of each face.
    for (unsigned f = 0, at = 0; f < faces.face_count && f < 4; at += faces.sizes[f], f++) {
        CHECK_EQ(faces.sizes[f], 3);
        for (int k = 0; k < 3; k++)
            for (int j = 0; j < 3; j++) {
                double found = faces.vertices[3 * faces.indices[at + (unsigned)k] + (unsigned)j];
                CHECK_EQ(found, corners[faces_of[f][k]][j] * scale);
            }
    }
    ovoid_mesh_destroy(mesh);
}

static void check_formats(void) {
    buffer b = make_binary_stl("binary");
    check_tetrahedron(file_write("binary.stl", b.data, b.size), 1);
    check_tetrahedron(file_write("binary", b.data, b.size), 0.001); // no extension: known by its bytes
    b = make_binary_stl("solid but binary");
    check_tetrahedron(file_write("solid.STL", b.data, b.size), 1);
    check_tetrahedron(file_write_text("text.stl", text_stl), 0.0254);
    check_tetrahedron(file_write_text("text.obj", text_obj), 1);
    // A byte order mark before each kind of text; STL in capitals.
    static const char *const marked[] = {text_obj, text_off, text_ply, text_stl};
    static const char *const names[] = {"mark.obj", "mark.off", "mark.ply", "mark.stl"};
    for (int i = 0; i < 4; i++) {
        char text[2000];
        snprintf(text, sizeof text, "\xef\xbb\xbf%s", marked[i]);
        check_tetrahedron(file_write_text(names[i], text), 1);
    }
    char capitals[sizeof text_stl];
    for (size_t i = 0; i < sizeof text_stl; i++)
        capitals[i] = text_stl[i] >= 'a' && text_stl[i] <= 'z' ? (char)(text_stl[i] - 32) : text_stl[i];
    check_tetrahedron(file_write_text("capital.stl", capitals), 1);
    check_tetrahedron(file_write_text("text.off", text_off), 100);
    check_tetrahedron(file_write_text("text.ply", text_ply), 1);
    for (int big = 0; big < 2; big++) {
        b = make_binary_ply(big);
        check_tetrahedron(file_write(big ? "big.ply" : "little.ply", b.data, b.size), 1);
    }
}

// COLLADA of centimetres with z up: coordinates become metres and keep their axes.
static const char text_dae[] =
    "<?xml version=\"1.0\"?><COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\"><asset>"
    "<unit name=\"centimeter\" meter=\"0.01\"/><up_axis>Z_UP</up_axis></asset><library_geometries><geometry id=\"g\">"
    "<mesh><source id=\"p\"><float_array id=\"a\" count=\"9\">0 0 0 100 0 0 0 200 300</float_array><technique_common>"
    "<accessor source=\"#a\" count=\"3\" stride=\"3\"><param name=\"X\" type=\"float\"/><param name=\"Y\" "
    "type=\"float\"/>"
    "<param name=\"Z\" type=\"float\"/></accessor></technique_common></source><vertices id=\"v\"><input "
    "semantic=\"POSITION\" source=\"#p\"/></vertices><triangles count=\"1\"><input semantic=\"VERTEX\" source=\"#v\" "
    "offset=\"0\"/><p>0 1 2</p></triangles></mesh></geometry></library_geometries><library_visual_scenes><visual_scene "
    "id=\"s\"><node id=\"n\"><instance_geometry url=\"#g\"/></node></visual_scene></library_visual_scenes><scene>"
    "<instance_visual_scene url=\"#s\"/></scene></COLLADA>";

static void check_collada(void) {
    if (!ovoid_io_has_assimp()) {
        check_skip("COLLADA: this build has no Assimp");
        return;
    }
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_mesh *mesh = ovoid_mesh_read(file_write_text("units.dae", text_dae), NULL, &error);
    if (!CHECK(mesh != NULL)) {
        printf("  %s\n", error.message);
        return;
    }
    ovoid_faces faces = ovoid_mesh_get_part(mesh, 0).faces;
    CHECK_EQ(faces.vertex_count, 3);
    const double truth[9] = {0, 0, 0, 1, 0, 0, 0, 2, 3};
    // Assimp computes in floats: a few units in their last place.
    for (size_t i = 0; i < 9 && faces.vertex_count == 3; i++) CHECK_NEAR(faces.vertices[i], truth[i], 1e-6);
    ovoid_mesh_destroy(mesh);
    // The unit that is wanted: its metres are converted, other files are taken to be in it.
    ovoid_read_options options = {.scale = 2, .unit = "mm"};
    mesh = ovoid_mesh_read(file_path("units.dae"), &options, &error);
    if (CHECK(mesh != NULL)) CHECK_NEAR(ovoid_mesh_get_part(mesh, 0).faces.vertices[3], 2000, 2e-3);
    ovoid_mesh_destroy(mesh);
}

// Node transforms: p -> (10, 0, 0) + 2 p, exact in floats.
static void check_nodes(void) {
    if (!ovoid_io_has_assimp()) {
        check_skip("glTF: this build has no Assimp");
        return;
    }
    ovoid_read_options options = {.parts = 1};
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_mesh *mesh = ovoid_mesh_read(file_write_text("nodes.gltf", text_gltf), &options, &error);
    if (!CHECK(mesh != NULL)) {
        printf("  %s\n", error.message);
        return;
    }
    ovoid_mesh_part part = ovoid_mesh_get_part(mesh, 0);
    CHECK(strcmp(part.name, "down") == 0);
    CHECK_EQ(part.faces.vertex_count, 3);
    CHECK_EQ(part.faces.face_count, 1);
    const double truth[9] = {10, 0, 0, 12, 0, 0, 10, 2, 0};
    for (size_t i = 0; i < 9 && part.faces.vertex_count == 3; i++) CHECK_EQ(part.faces.vertices[i], truth[i]);
    ovoid_mesh_destroy(mesh);
}

// ---- parts

static const char objects[] = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\no first one\nf 2 3 4\n"
                              "o empty\no cloud\nv 5 5 5\nv 6 6 6\no last\nv 7 7 7\nf 3 4 -1\nf -1 4 3\nl 2 3\n";

static void check_parts(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    const char *path = file_write_text("objects.obj", objects);
    ovoid_read_options options = {.parts = 1};
    ovoid_mesh *mesh = ovoid_mesh_read(path, &options, &error);
    if (!CHECK(mesh != NULL)) return;
    // The empty object is left out; the first one takes the points it uses, not the stray (9, 9, 9).
    static const struct {
        const char *name;
        size_t points, faces;
        double sum; ///< of all coordinates
    } truth[] = {{"first one", 3, 1, 2}, {"cloud", 2, 0, 33}, {"last", 4, 2, 23}};
    CHECK_EQ(ovoid_mesh_get_part_count(mesh), 3);
    for (size_t i = 0; i < ovoid_mesh_get_part_count(mesh) && i < 3; i++) {
        ovoid_mesh_part part = ovoid_mesh_get_part(mesh, i);
        CHECK(strcmp(part.name, truth[i].name) == 0);
        CHECK_EQ(part.faces.vertex_count, truth[i].points);
        CHECK_EQ(part.faces.face_count, truth[i].faces);
        double sum = 0;
        for (size_t k = 0; k < 3 * part.faces.vertex_count; k++) sum += part.faces.vertices[k];
        CHECK_EQ(sum, truth[i].sum);
        for (size_t k = 0, at = 0; k < part.faces.face_count; k++)
            for (uint32_t j = 0; j < part.faces.sizes[k]; j++, at++)
                CHECK(part.faces.indices[at] < part.faces.vertex_count);
    }
    ovoid_mesh_destroy(mesh);
    // As one: every point of the file, faces of all objects.
    mesh = ovoid_mesh_read(path, NULL, &error);
    CHECK(mesh && ovoid_mesh_get_part_count(mesh) == 1);
    if (mesh) {
        CHECK_EQ(ovoid_mesh_get_part(mesh, 0).faces.vertex_count, 7);
        CHECK_EQ(ovoid_mesh_get_part(mesh, 0).faces.face_count, 3);
    }
    ovoid_mesh_destroy(mesh);
}

static void check_solids(void) {
    static const char two[] = "solid one\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\n"
                              "endloop\nendfacet\nendsolid\nsolid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\n"
                              "vertex 0 1 0\nvertex 2 0 0\nendloop\nendfacet\nendsolid\n";
    ovoid_read_options options = {.parts = 1};
    const char *path = file_write_text("two.stl", two);
    ovoid_mesh *mesh = ovoid_mesh_read(path, &options, NULL);
    CHECK(mesh && ovoid_mesh_get_part_count(mesh) == 2 && strcmp(ovoid_mesh_get_part(mesh, 0).name, "one") == 0 &&
          ovoid_mesh_get_part(mesh, 1).faces.vertex_count == 3);
    ovoid_mesh_destroy(mesh);
    // As one, the two share the points that are equal.
    mesh = ovoid_mesh_read(path, NULL, NULL);
    CHECK(mesh && ovoid_mesh_get_part_count(mesh) == 1 && ovoid_mesh_get_part(mesh, 0).faces.vertex_count == 4);
    ovoid_mesh_destroy(mesh);
}

// ---- numbers: what C's own reader of decimal numbers says

static void check_numbers(void) {
    static const char *const texts[] = {"0.1",
                                        "-0.30000000000000004",
                                        "1e22",
                                        "1e23",
                                        "123456789012345678901234567890",
                                        "4.9406564584124654e-324",
                                        ".5",
                                        "5.",
                                        "+7",
                                        "1.7976931348623157e30",
                                        "9007199254740993",
                                        "0.000001",
                                        "2.2250738585072011e-308",
                                        "6.8103397437e-5",
                                        "0e999",
                                        "1E-400",
                                        "00000000000000000000000000000000001.5",
                                        "0.1000000000000000055511151231257827"};
    char text[4096] = "";
    size_t count = sizeof texts / sizeof *texts;
    for (size_t i = 0; i < count; i++) {
        strcat(text, "v 0 1 ");
        strcat(text, texts[i]);
        strcat(text, "\n");
    }
    ovoid_mesh *mesh = ovoid_mesh_read(file_write_text("numbers.obj", text), NULL, NULL);
    if (!CHECK(mesh && ovoid_mesh_get_part(mesh, 0).faces.vertex_count == count)) return;
    for (size_t i = 0; i < count; i++)
        CHECK_EQ(ovoid_mesh_get_part(mesh, 0).faces.vertices[3 * i + 2], strtod(texts[i], NULL));
    ovoid_mesh_destroy(mesh);
    // Random doubles, all exponents, come back from 17 digits.
    uint64_t s = 5;
    size_t n = 3000;
    double *values = malloc(n * sizeof *values);
    char *long_text = malloc(n * 64), *at = long_text;
    for (size_t i = 0; i < n; i++) {
        values[i] = random_normal(&s) * pow(10, random_uniform(&s, -320, 48));
        at += sprintf(at, "v 0 0 %.17g\n", values[i]);
    }
    mesh = ovoid_mesh_read(file_write_text("random.obj", long_text), NULL, NULL);
    CHECK(mesh != NULL);
    for (size_t i = 0; mesh && i < n; i++) CHECK_EQ(ovoid_mesh_get_part(mesh, 0).faces.vertices[3 * i + 2], values[i]);
    ovoid_mesh_destroy(mesh);
    free(values);
    free(long_text);
}

// ---- bad inputs by name

#define PLY_HEAD "ply\nformat ascii 1.0\n"
#define PLY_XYZ "property float x\nproperty float y\nproperty float z\n"
#define PLY_FACES "property list uchar int vertex_indices\n"

static const bad_input bad_inputs[] = {
    {"empty.stl", "", -1, "empty", OVOID_ERROR_EMPTY},
    {"short.stl", "short", -1, "5 bytes"},
    {"pointer.stl", "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 9\n", -1,
     "is a Git LFS pointer"},
    {"mark.obj", "\xef\xbb\xbf", -1, "no points", OVOID_ERROR_EMPTY},
    {"no_facets.stl", "solid a\nendsolid a\n", -1, "no points", OVOID_ERROR_EMPTY},
    {"cut.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n", 6, "truncated"},
    {"cut_after_facet.stl",
     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n", 9,
     "\"endsolid\" is missing"},
    {"four_corners.stl",
     "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 2 0\nendloop\n", 7,
     "\"vertex\" stands where \"endloop\""},
    {"nan.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex nan 0 0\n", 5, "not a number",
     OVOID_ERROR_NOT_FINITE},
    {"word.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 zero 0\n", 4, "\"zero\""},
    {"empty.obj", "", -1, "empty", OVOID_ERROR_EMPTY},
    {"no_points.obj", "# nothing\nvt 0 0\n", -1, "no points", OVOID_ERROR_EMPTY},
    {"missing.obj", "v 0 0 0\nv 1 2\n", 2, "coordinate z"},
    {"word.obj", "v 0 0 0\nv 1 2 x3\n", 2, "\"x3\" is not a coordinate"},
    {"glued.obj", "v 0 0 0\nv 1 2 3x\n", 2, "\"3x\""},
    {"infinite.obj", "v 0 0 0\n\n# c\nv 1 -inf 0\n", 4, "vertex 1 has a coordinate that is inf",
     OVOID_ERROR_NOT_FINITE},
    {"overflow.obj", "v 0 0 1e999\n", 1, "infinite", OVOID_ERROR_NOT_FINITE},
    {"nan.obj", "v 0 0 NaN\n", 1, "not a number", OVOID_ERROR_NOT_FINITE},
    {"huge.obj", "v 0 0 1e91\n", 1, "1e+91", OVOID_ERROR_RANGE},
    {"index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\nv 0 0 1\nf 1 2 5\nf 1 2 9\n", 7, "no vertex 9; the file has 4",
     OVOID_ERROR_INDEX},
    {"zero_index.obj", "v 0 0 0\nf 0 1 1\n", 2, "no vertex 0", OVOID_ERROR_INDEX},
    {"negative.obj", "v 0 0 0\nf -1 -2 -1\n", 2, "no vertex -2; 1 come before", OVOID_ERROR_INDEX},
    {"big_index.obj", "v 0 0 0\nf 1 1 99999999999999999999\n", 2, "no vertex 9999", OVOID_ERROR_INDEX},
    {"no_index.obj", "v 0 0 0\nf a b c\n", 2, "\"a\" is not a vertex index"},
    {"half_index.obj", "v 0 0 0\nf 1.5 1 1\n", 2, "\"1.5\""},
    {"no_corners.obj", "v 0 0 0\nf\n", 2, "without vertices"},
    {"joined.obj", "v 0 0 0\nv 1 \\\n 2 \\\n 3\nv 4 5\n", 5, "coordinate z"},
    {"statement.obj", "v 0 0 0\nvertex 1 0 0\n", 2, "\"vertex\" is not a statement"},
    {"empty.off", "", -1, "empty", OVOID_ERROR_EMPTY},
    {"word.off", "FOO\n1 0 0\n0 0 0\n", 1, "\"FOO\""},
    {"four.off", "4OFF\n1 0 0\n0 0 0 0\n", 1, "4OFF"},
    {"binary.off", "OFF BINARY\n", 1, "binary OFF"},
    {"no_counts.off", "OFF\n", 2, "counts are missing"},
    {"counts.off", "OFF\n3 -1 0\n", 2, ">= 0"},
    {"promise.off", "OFF\n100000000 1 0\n0 0 0\n", 2, "truncated"},
    {"face_promise.off", "OFF\n1 9999999999 0\n0 0 0\n", 2, "truncated"},
    {"cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0 #######################\n", 5, "2 of 3 vertices"},
    {"cut_faces.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 # ###############\n", 7, "1 of 2 faces"},
    {"index.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", 6, "no vertex 3", OVOID_ERROR_INDEX},
    {"short_face.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n", 6, "has 3 of them"},
    {"long_face.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4000000000 0 1 2\n", 6, "number of vertices"},
    {"six.off", "OFF\n1 0 0\n0 0 0 1 1 1\n", 3, "more than three numbers"},
    {"nan.off", "OFF\n1 0 0\n0 nan 0\n", 3, "not a number", OVOID_ERROR_NOT_FINITE},
    {"empty.ply", "", -1, "empty", OVOID_ERROR_EMPTY},
    {"magic.ply", "plx\n", 1, "begin with ply"},
    {"no_end.ply", PLY_HEAD "element vertex 1\n", 4, "end_header"},
    {"format.ply", "ply\nformat ascii 2.0\n", 2, "version 1.0"},
    {"no_format.ply", "ply\nelement vertex 1\n" PLY_XYZ "end_header\n0 0 0\n", 6, "no format"},
    {"line.ply", PLY_HEAD "elephant vertex 1\n", 3, "not a line"},
    {"no_vertex.ply", PLY_HEAD "element face 0\n" PLY_FACES "end_header\n", 5, "before the vertices"},
    {"no_z.ply", PLY_HEAD "element vertex 1\nproperty float x\nproperty float y\nend_header\n0 0\n", 6, "x, y and z"},
    {"twice.ply", PLY_HEAD "element vertex 1\nproperty float x\nproperty float x\n", 5, "twice"},
    {"type.ply", PLY_HEAD "element vertex 1\nproperty quad x\n", 4, "a type and a name"},
    {"list_type.ply", PLY_HEAD "element face 1\nproperty list float int vertex_indices\n", 4, "integer type"},
    {"promise.ply", PLY_HEAD "element vertex 1000000000\n" PLY_XYZ "end_header\n0 0 0\n", 8, "truncated"},
    {"cut.ply", PLY_HEAD "element vertex 2\n" PLY_XYZ "end_header\n0 0 0\n 0.000000 1\n", 10, "a number is missing"},
    {"more.ply", PLY_HEAD "element vertex 1\n" PLY_XYZ "end_header\n0 0 0\n1 1 1\n", 9, "more after"},
    {"word.ply", PLY_HEAD "element vertex 1\n" PLY_XYZ "end_header\n0 0 zero\n", 8, "\"zero\""},
    {"nan.ply", PLY_HEAD "element vertex 1\n" PLY_XYZ "end_header\n0 0 nan\n", 8, "not a number",
     OVOID_ERROR_NOT_FINITE},
    {"index.ply", PLY_HEAD "element vertex 1\n" PLY_XYZ "element face 1\n" PLY_FACES "end_header\n0 0 0\n3 0 0 -1\n",
     11, "no vertex -1", OVOID_ERROR_INDEX},
    {"half.ply", PLY_HEAD "element vertex 1\n" PLY_XYZ "element face 1\n" PLY_FACES "end_header\n0 0 0\n3 0 0 0.5\n",
     11, "no vertex 0.5", OVOID_ERROR_INDEX},
    {"list.ply", PLY_HEAD "element vertex 1\n" PLY_XYZ "element face 1\n" PLY_FACES "end_header\n0 0 0\n3000000 0 0\n",
     11, "a list of 3000000 items"},
    {"unknown.xyz", "0 0 0\n", -1, "not a mesh"},
    {"no_extension", "0 0 0\n", -1, "not a mesh"},
    {"hostile.blend", "BLENDER", -1, "not a mesh"},
};

static int accepts(const char *path, ovoid_error *error) {
    ovoid_mesh *mesh = ovoid_mesh_read(path, NULL, error);
    ovoid_mesh_destroy(mesh);
    return mesh != NULL;
}

// Binary files, cut and with counts that are wrong.
static void check_bad_binaries(void) {
    ovoid_error error;
    buffer b = make_binary_stl("x");
    CHECK(!ovoid_mesh_read(file_write("cut.stl", b.data, b.size - 1), NULL, &error));
    CHECK(error.code == OVOID_ERROR_FORMAT && strstr(error.message, "truncated"));
    CHECK(!ovoid_mesh_read(file_write("long.stl", b.data, b.size + 1), NULL, &error));
    CHECK(error.code == OVOID_ERROR_FORMAT && strstr(error.message, "bad count"));
    memset(b.data + 80, 0xff, 4); // 4 billion triangles in 284 bytes
    CHECK(!ovoid_mesh_read(file_write("count.stl", b.data, b.size), NULL, &error));
    CHECK(error.code == OVOID_ERROR_FORMAT && strstr(error.message, "4294967295 triangles"));
    b = make_binary_stl("x");
    b.data[84 + 2 * 50 + 12 + 3] = 0x7f; // infinity into a corner of triangle 2
    b.data[84 + 2 * 50 + 12 + 2] = 0x80;
    CHECK(!ovoid_mesh_read(file_write("infinite.stl", b.data, b.size), NULL, &error));
    CHECK(error.code == OVOID_ERROR_NOT_FINITE && error.place == 2);
    b = make_binary_ply(0);
    CHECK(!ovoid_mesh_read(file_write("cut.ply", b.data, b.size - 1), NULL, &error));
    CHECK(error.code == OVOID_ERROR_FORMAT && strstr(error.message, "truncated"));
    CHECK(!ovoid_mesh_read(file_write("long.ply", b.data, b.size + 1), NULL, &error));
    CHECK(error.code == OVOID_ERROR_FORMAT && strstr(error.message, "more after"));
}

// Paths that are no regular files, options that make no sense.
static void check_bad_paths(void) {
    ovoid_error error;
    CHECK(!ovoid_mesh_read(file_path("absent.stl"), NULL, &error));
    CHECK(error.code == OVOID_ERROR_FILE && strstr(error.message, "absent.stl: cannot be opened"));
    CHECK(!ovoid_mesh_read("/dev/null", NULL, &error));
    CHECK(error.code == OVOID_ERROR_FILE && strstr(error.message, "not a regular file"));
    CHECK(!ovoid_mesh_read(OVOID_BUILD_DIR, NULL, &error));
    CHECK(error.code == OVOID_ERROR_FILE && strstr(error.message, "not a regular file"));
    const double scales[] = {-1, NAN, INFINITY, 1e300};
    const char *path = file_write_text("text.obj", text_obj);
    for (int i = 0; i < 4; i++) {
        ovoid_read_options options = {.scale = scales[i]};
        CHECK(!ovoid_mesh_read(path, &options, &error) && error.code == OVOID_ERROR_ARGUMENT);
    }
    CHECK(strstr(error.message, "the scale 1e+300 must be above 0 and at most 1e+50") != NULL);
    CHECK(!ovoid_mesh_read(path, &(ovoid_read_options){.scale = -1}, NULL));
    CHECK(!ovoid_mesh_read(path, &(ovoid_read_options){.unit = "yd"}, &error) && error.code == OVOID_ERROR_ARGUMENT);
    CHECK(strstr(error.message, "the unit \"yd\" is none of m, cm, mm, um, in, ft") != NULL);
    CHECK_EQ(ovoid_unit_get_scale("in", "m"), 0.0254);
    CHECK_EQ(ovoid_unit_get_scale("inch", "m"), 0);
    CHECK_EQ(ovoid_unit_get_scale("m", "inch"), 0);
    CHECK_EQ(ovoid_unit_get_scale("in", "mm"), 25.4);
    CHECK_EQ(ovoid_unit_get_scale("um", "m"), 1e-6);
    CHECK_EQ(ovoid_unit_get_scale("ft", "in"), 12);
    CHECK_EQ(ovoid_unit_get_scale("mm", "um"), 1000);
    // A path longer than a message: its end is what is shown.
    char long_path[400];
    memset(long_path, 'x', sizeof long_path);
    strcpy(long_path + sizeof long_path - 10, "/lost.stl");
    CHECK(!ovoid_mesh_read(long_path, NULL, &error) && strstr(error.message, "/lost.stl: cannot be opened"));
}

// What only Assimp reads: refused with its words, or for want of it.
static void check_bad_scene_file(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    CHECK(!ovoid_mesh_read(file_write_text("broken.gltf", "{\"asset\":"), NULL, &error));
    CHECK(error.code == OVOID_ERROR_FORMAT && strstr(error.message, "Assimp"));
}

// One point more than the limit, three bytes each.
static void check_limit(void) {
    const char *path = file_path("limit.ply");
    FILE *file = fopen(path, "wb");
    if (!CHECK(file != NULL)) return;
    fprintf(file,
            "ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty uchar x\nproperty uchar y\n"
            "property uchar z\nend_header\n",
            OVOID_MESH_POINTS_MAX + 1);
    for (int i = 0; i <= OVOID_MESH_POINTS_MAX; i++) fputs("xyz", file);
    fclose(file);
    ovoid_error error = {OVOID_OK, -1, ""};
    CHECK(!ovoid_mesh_read(path, NULL, &error));
    CHECK(error.code == OVOID_ERROR_LIMIT && error.place == OVOID_MESH_POINTS_MAX);
    remove(path);
}

// Every cut and thousands of changed bytes of every format: no crash, no leak (the sanitizers say), and either a mesh
// whose indices are good or an error with a sentence. Assimp is not tried: its importers are not ours to vouch for.
static void try_bytes(const char *name, const void *data, size_t size) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_read_options options = {.parts = (int)(size % 2)};
    ovoid_mesh *mesh = ovoid_mesh_read(file_write(name, data, size), &options, &error);
    if (!mesh) {
        CHECK(error.code != OVOID_OK && error.message[0]);
        return;
    }
    for (size_t p = 0; p < ovoid_mesh_get_part_count(mesh); p++) {
        ovoid_faces faces = ovoid_mesh_get_part(mesh, p).faces;
        CHECK(faces.vertex_count > 0 && isfinite(sum_of(&faces)));
        for (size_t f = 0, at = 0; f < faces.face_count; f++)
            for (uint32_t k = 0; k < faces.sizes[f]; k++, at++) CHECK(faces.indices[at] < faces.vertex_count);
    }
    ovoid_mesh_destroy(mesh);
}

static void check_damaged(void) {
    buffer files[7];
    static const char *const names[7] = {"damaged_b.stl", "damaged_t.stl", "damaged.obj",  "damaged.off",
                                         "damaged_t.ply", "damaged_b.ply", "damaged_o.obj"};
    memset(files, 0, sizeof files);
    files[0] = make_binary_stl("x");
    put_text(&files[1], text_stl);
    put_text(&files[2], text_obj);
    put_text(&files[3], text_off);
    put_text(&files[4], text_ply);
    files[5] = make_binary_ply(1);
    put_text(&files[6], objects);
    uint64_t s = 11;
    for (int f = 0; f < 7; f++) {
        for (size_t size = 0; size < files[f].size; size += 3) try_bytes(names[f], files[f].data, size);
        for (int i = 0; i < 400; i++) {
            check_seed = s;
            buffer b = files[f];
            int changes = 1 + (int)(random_next(&s) % 4);
            for (int k = 0; k < changes; k++) {
                static const char likely[] = "0123456789-+.e/\\ \n\r#fvoglp\x00\xff";
                size_t at = random_next(&s) % b.size;
                b.data[at] = random_next(&s) % 2 ? (unsigned char)likely[random_next(&s) % (sizeof likely - 1)]
                                                 : (unsigned char)random_next(&s);
            }
            try_bytes(names[f], b.data, b.size);
        }
    }
    check_seed = 0;
}

// ---- real files

static void check_real(void) {
    const char *folder = check_data_folder();
    if (!folder) {
        check_skip("real meshes: no data folder");
        return;
    }
    // Parts, points and faces as grep counts them in the files (v, f and o lines; triangles of the STL header).
    static const struct {
        const char *name;
        size_t parts, points, faces;
        size_t stray; ///< points that no face uses: they are in no part
    } files[] = {{"scans/bunny.obj", 1, 453, 902, 0},
                 {"scans/duck_vhacd.obj", 5, 208, 396, 0},
                 {"scenes/env.obj", 1, 6540, 2180, 0},
                 {"scans/teddy2_VHACD_CHs.obj", 15, 1261, 2432, 15},
                 {"compounds/000.obj", 5, 0, 0, 0},
                 {"robots/panda/meshes/collision/link1.stl", 1, 152, 300, 0},
                 {"robots/panda/meshes/collision/finger.stl", 1, 18, 32, 0}};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char path[600];
        snprintf(path, sizeof path, "%s/%s", folder, files[i].name);
        ovoid_error error = {OVOID_OK, -1, ""};
        ovoid_mesh *mesh = ovoid_mesh_read(path, NULL, &error);
        if (!CHECK(mesh != NULL)) {
            printf("  %s\n", error.message);
            continue;
        }
        ovoid_faces faces = ovoid_mesh_get_part(mesh, 0).faces;
        if (files[i].points) {
            CHECK_EQ(faces.vertex_count, files[i].points);
            CHECK_EQ(faces.face_count, files[i].faces);
        }
        size_t whole = faces.vertex_count, sum = 0;
        ovoid_mesh_destroy(mesh);
        ovoid_read_options options = {.parts = 1};
        mesh = ovoid_mesh_read(path, &options, &error);
        if (!CHECK(mesh != NULL)) continue;
        CHECK_EQ(ovoid_mesh_get_part_count(mesh), files[i].parts);
        for (size_t p = 0; p < ovoid_mesh_get_part_count(mesh); p++)
            sum += ovoid_mesh_get_part(mesh, p).faces.vertex_count;
        CHECK_EQ(sum + files[i].stray, whole); // the parts of these files share no points
        ovoid_mesh_destroy(mesh);
    }
}

int main(void) {
    check_formats();
    check_nodes();
    check_collada();
    check_parts();
    check_solids();
    check_numbers();
    check_bad_inputs(bad_inputs, sizeof bad_inputs / sizeof *bad_inputs, accepts);
    check_bad_binaries();
    check_bad_paths();
    check_bad_scene_file();
    check_limit();
    check_damaged();
    check_real();
    return check_end();
}
