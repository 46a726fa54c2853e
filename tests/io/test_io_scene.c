// Scenes, lists of shapes, shape files. Truth: scenes written here; the table of bad ones says of each by name which
// error it must give and in which line.
#include "files.h"

#include "ovoid/shape.h"

static const char tetrahedron[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
static const char two_parts[] =
    "o low\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 4 3 2\no\nv 0 0 5\nv 1 0 5\nv 0 1 5\n"
    "v 0 0 6\nf 5 6 7\nf 8 7 6\n";

static const char good[] =
    "{\"objects\": [\n"
    "  {\"name\": \"arm\", \"mesh\": \"tetra.obj\", \"pose\": {\"xyz\": [1, 2, 3], \"quat_wxyz\": [2, 0, 0, 0]}},\n"
    "  {\"name\": \"h\\u00e4nd\", \"mesh\": \"tetra.obj\", \"scale\": 2, \"unit\": \"mm\"},\n"
    "  {\"name\": \"again\", \"mesh\": \"tetra.obj\", \"pose\": {\"rpy\": [0, 0, 1.5707963267948966]}},\n"
    "  {\"name\": \"padded\", \"mesh\": \"tetra.obj\", \"radius\": 0.25},\n"
    "  {\"name\": \"box\", \"box\": [2, 4, 6], \"radius\": 0.5},\n"
    "  {\"name\": \"ball\", \"sphere\": 3},\n"
    "  {\"name\": \"pill\", \"capsule\": {\"radius\": 0.5, \"length\": 4}},\n"
    "  {\"name\": \"can\", \"cylinder\": {\"radius\": 1, \"length\": 2, \"sides\": 5}},\n"
    "  {\"name\": \"hat\", \"cone\": {\"radius\": 1, \"length\": 2}},\n"
    "  {\"name\": \"cloud\", \"points\": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], \"unit\": \"cm\"}\n"
    "], \"ignore\": [[\"arm\", \"box\"], [\"pill\", \"ball\"], [\"box\", \"arm\"]]}\n";

// The extent of a shape along an axis, from its vertices.
static double get_size(const ovoid_shape *shape, int axis) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    double low = INFINITY, high = -INFINITY;
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        low = fmin(low, p.vertices[3 * i + (uint32_t)axis]);
        high = fmax(high, p.vertices[3 * i + (uint32_t)axis]);
    }
    return high - low;
}

// A scene in millimetres: objects of other units are converted, all else is as it stands.
static void check_unit(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_scene *scene = ovoid_scene_read(
        file_write_text("unit_mm.json",
                        "{\"unit\": \"mm\", \"objects\": ["
                        "{\"name\": \"inch\", \"points\": [[0, 0, 0], [2, 0, 0]], \"unit\": \"in\"},"
                        "{\"name\": \"um\", \"points\": [[0, 0, 0], [2, 0, 0]], \"unit\": \"um\"},"
                        "{\"name\": \"mm\", \"points\": [[0, 0, 0], [2, 0, 0]], \"pose\": {\"xyz\": [7, "
                        "0, 0]}}]}"),
        NULL, &error);
    if (!CHECK(scene != NULL)) return;
    CHECK(strcmp(ovoid_scene_get_unit(scene), "mm") == 0);
    CHECK_EQ(get_size(ovoid_scene_get(scene, 0).shape, 0), 50.8);
    CHECK_EQ(get_size(ovoid_scene_get(scene, 1).shape, 0), 0.002);
    CHECK_EQ(get_size(ovoid_scene_get(scene, 2).shape, 0), 2);
    CHECK_EQ(ovoid_scene_get(scene, 2).pose.position.x, 7);
    ovoid_scene_destroy(scene);
}

// An ellipsoid is the true body, with its tolerance.
static void check_ellipsoid(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_scene *scene = ovoid_scene_read(
        file_write_text("egg.json", "{\"objects\": [{\"name\": \"egg\", \"ellipsoid\": "
                                    "{\"half_axes\": [1, 2, 3], \"tolerance\": 0.12}, \"radius\": 0.5}]}"),
        NULL, &error);
    if (!CHECK(scene != NULL)) return;
    const ovoid_shape *egg = ovoid_scene_get(scene, 0).shape;
    ovoid_round round = ovoid_shape_get_round(egg);
    CHECK_EQ(round.kind, OVOID_ROUND_ELLIPSOID);
    CHECK(round.half_axes.x == 1 && round.half_axes.y == 2 && round.half_axes.z == 3);
    CHECK_EQ(ovoid_shape_get_polytope(egg).vertex_count, 102);
    CHECK_EQ(ovoid_shape_get_radius(egg), 0.5);
    ovoid_scene_destroy(scene);
}

static void check_good(void) {
    file_write_text("tetra.obj", tetrahedron);
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_scene *scene = ovoid_scene_read(file_write_text("good.json", good), NULL, &error);
    if (!CHECK(scene != NULL)) {
        printf("  %s\n", error.message);
        return;
    }
    CHECK_EQ(ovoid_scene_get_count(scene), 10);
    CHECK(strcmp(ovoid_scene_get_unit(scene), "") == 0);
    // Sizes along x, y, z without the radius, the radius, the vertices.
    static const struct {
        const char *name;
        double x, y, z, radius;
        uint32_t vertices;
    } truth[] = {{"arm", 1, 1, 1, 0, 4},    {"h\xc3\xa4nd", 0.002, 0.002, 0.002, 0, 4},
                 {"again", 1, 1, 1, 0, 4},  {"padded", 1, 1, 1, 0.25, 4},
                 {"box", 2, 4, 6, 0.5, 8},  {"ball", 0, 0, 0, 3, 1},
                 {"pill", 0, 0, 4, 0.5, 2}, {"can", -1, -1, 2, 0, 10},
                 {"hat", -1, -1, 2, 0, 33}, {"cloud", 0.01, 0.01, 0.01, 0, 4}};
    for (size_t i = 0; i < 10; i++) {
        ovoid_scene_object o = ovoid_scene_get(scene, i);
        CHECK(strcmp(o.name, truth[i].name) == 0);
        CHECK_EQ(ovoid_scene_find(scene, truth[i].name), i);
        // Sums of two rounded coordinates: a few units in the last place.
        if (truth[i].x >= 0) CHECK_NEAR(get_size(o.shape, 0), truth[i].x, 1e-15);
        if (truth[i].y >= 0) CHECK_NEAR(get_size(o.shape, 1), truth[i].y, 1e-15);
        CHECK_NEAR(get_size(o.shape, 2), truth[i].z, 1e-15);
        CHECK_EQ(ovoid_shape_get_radius(o.shape), truth[i].radius);
        CHECK_EQ(ovoid_shape_get_polytope(o.shape).vertex_count, truth[i].vertices);
    }
    // The same mesh, scale and radius: one shape.
    CHECK(ovoid_scene_get(scene, 0).shape == ovoid_scene_get(scene, 2).shape);
    CHECK(ovoid_scene_get(scene, 0).shape != ovoid_scene_get(scene, 1).shape);
    CHECK(ovoid_scene_get(scene, 0).shape != ovoid_scene_get(scene, 3).shape);
    // Poses.
    ovoid_pose pose = ovoid_scene_get(scene, 0).pose;
    CHECK(pose.position.x == 1 && pose.position.y == 2 && pose.position.z == 3 && pose.rotation.w == 2);
    pose = ovoid_scene_get(scene, 1).pose;
    CHECK(pose.position.x == 0 && pose.rotation.w == 1 && pose.rotation.z == 0);
    pose = ovoid_scene_get(scene, 2).pose;
    ovoid_vec3 turned = ovoid_pose_compute_point(&pose, (ovoid_vec3){1, 0, 0}); // a quarter turn about z
    CHECK_NEAR(turned.x, 0, 1e-15);
    CHECK_NEAR(turned.y, 1, 1e-15);
    // Pairs to ignore.
    for (size_t i = 0; i < 10; i++)
        for (size_t j = 0; j < 10; j++) {
            int truly = (i == 0 && j == 4) || (i == 4 && j == 0) || (i == 5 && j == 6) || (i == 6 && j == 5);
            CHECK_EQ(ovoid_scene_is_ignored(scene, i, j), truly);
        }
    CHECK_EQ(ovoid_scene_get_pair_count(scene), 10 * 9 / 2 - 2);
    CHECK(ovoid_scene_find(scene, "nobody") == (size_t)-1);
    ovoid_scene_destroy(scene);
}

static const char compounds[] =
    "{\"objects\": [\n"
    "  {\"name\": \"file\", \"mesh\": \"parts.obj\", \"parts\": true, \"radius\": 0.5, \"unit\": \"cm\"},\n"
    "  {\"name\": \"hull\", \"mesh\": \"parts.obj\", \"hull\": true, \"radius\": 0.5, \"unit\": \"cm\"},\n"
    "  {\"name\": \"again\", \"unit\": \"cm\", \"radius\": 0.5, \"parts\": true, \"mesh\": \"parts.obj\"},\n"
    "  {\"name\": \"tool\", \"pose\": {\"xyz\": [9, 0, 0]}, \"compound\": [\n"
    "    {\"box\": [1, 2, 3], \"pose\": {\"xyz\": [1, 0, 0]}},\n"
    "    {\"sphere\": 2},\n"
    "    {\"box\": [1, 2, 3], \"pose\": {\"xyz\": [0, 5, 0], \"rpy\": [0, 0, 1]}},\n"
    "    {\"mesh\": \"parts.obj\", \"parts\": true, \"pose\": {\"xyz\": [0, 0, 7]}}]},\n"
    "  {\"name\": \"box\", \"box\": [1, 2, 3]}]}\n";

// Compounds: from a mesh's objects and from parts; equal geometries are one body.
static void check_compounds(void) {
    file_write_text("parts.obj", two_parts);
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_scene *scene = ovoid_scene_read(file_write_text("compounds.json", compounds), NULL, &error);
    if (!CHECK(scene != NULL)) {
        printf("  %s\n", error.message);
        return;
    }
    ovoid_scene_object file = ovoid_scene_get(scene, 0), hull = ovoid_scene_get(scene, 1);
    ovoid_scene_object again = ovoid_scene_get(scene, 2), tool = ovoid_scene_get(scene, 3);
    ovoid_scene_object box = ovoid_scene_get(scene, 4);
    CHECK(file.compound && !file.shape && hull.shape && !hull.compound && file.compound == again.compound);
    CHECK_EQ(ovoid_compound_get_part_count(file.compound), 2);
    for (size_t i = 0; i < 2; i++) {
        ovoid_posed_shape part = ovoid_compound_get_part(file.compound, i);
        CHECK(ovoid_shape_get_radius(part.shape) == 0.5 && part.pose.position.z == 0 && part.pose.rotation.w == 1);
        CHECK_NEAR(get_size(part.shape, 2), 0.01, 1e-17);
    }
    // Five parts: the last two are those of the mesh.
    CHECK(tool.pose.position.x == 9 && tool.compound && ovoid_compound_get_part_count(tool.compound) == 5);
    ovoid_posed_shape first = ovoid_compound_get_part(tool.compound, 0),
                      third = ovoid_compound_get_part(tool.compound, 2);
    CHECK(first.shape == box.shape && third.shape == box.shape);
    CHECK(first.pose.position.x == 1 && third.pose.position.y == 5 && third.pose.rotation.z > 0.4);
    CHECK_EQ(ovoid_shape_get_radius(ovoid_compound_get_part(tool.compound, 1).shape), 2);
    ovoid_posed_shape last = ovoid_compound_get_part(tool.compound, 4);
    CHECK(last.pose.position.z == 7 && ovoid_shape_get_radius(last.shape) == 0);
    CHECK_NEAR(get_size(last.shape, 2), 1, 1e-15);
    ovoid_scene_destroy(scene);
}

// A mesh that is not its hull is a solid, or where it is open a surface, unless its hull is asked for.
static void check_solids(void) {
    static const char text[] =
        "{\"objects\": [{\"name\": \"a\", \"mesh\": \"l.obj\", \"pose\": {\"xyz\": [1, 0, 0]}},\n"
        "  {\"name\": \"b\", \"mesh\": \"l.obj\", \"solid\": true}, {\"name\": \"c\", \"mesh\": \"l.obj\", \"solid\": "
        "false},\n"
        "  {\"name\": \"d\", \"mesh\": \"l.obj\", \"radius\": 0.5, \"hull\": true}, {\"name\": \"e\", \"mesh\": "
        "\"open.obj\", "
        "\"solid\": true},\n"
        "  {\"name\": \"f\", \"mesh\": \"open.obj\"}, {\"name\": \"g\", \"compound\": [{\"mesh\": \"l.obj\", \"hull\": "
        "true}]},\n"
        "  {\"name\": \"h\", \"mesh\": \"l.obj\", \"scale\": 2}, {\"name\": \"i\", \"mesh\": \"l.obj\"}]}";
    static const char angle[] =
        "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 0 0 1\nv 2 0 1\nv 2 1 1\nv 1 1 1\nv 1 2 1\nv 0 2 1\n"
        "f 4 3 2\nf 4 2 1\nf 4 1 6\nf 4 6 5\nf 10 8 9\nf 10 7 8\nf 10 12 7\nf 10 11 12\nf 1 2 8 7\nf 2 3 9 8\nf 3 4 10 "
        "9\n"
        "f 4 5 11 10\nf 5 6 12 11\nf 6 1 7 12\n";
    static const ovoid_mesh_kind kinds[9] = {OVOID_MESH_SOLID, OVOID_MESH_SOLID,   OVOID_MESH_HULL,
                                             OVOID_MESH_HULL,  OVOID_MESH_SURFACE, OVOID_MESH_SURFACE,
                                             OVOID_MESH_PARTS, OVOID_MESH_SOLID,   OVOID_MESH_SOLID};
    char open[sizeof angle];
    memcpy(open, angle, sizeof angle);
    *strstr(open, "f 6 1") = 0;
    file_write_text("l.obj", angle);
    file_write_text("open.obj", open);
    ovoid_error error = {OVOID_OK, -1, ""};
    const char *path = file_write_text("solids.json", text);
    ovoid_scene *scene = NULL;
    for (int hulls = 0; hulls < 2; hulls++) {
        scene = hulls ? ovoid_scene_read_hulls(path, NULL, &error) : ovoid_scene_read(path, NULL, &error);
        if (!CHECK(scene != NULL)) {
            printf("  %s\n", error.message);
            return;
        }
        for (size_t i = 0; i < 9; i++) {
            ovoid_scene_object o = ovoid_scene_get(scene, i);
            int is_asked = i == 1 || i == 4;
            int is_solid = kinds[i] == OVOID_MESH_SOLID || kinds[i] == OVOID_MESH_SURFACE;
            if (hulls && !is_asked) is_solid = 0;
            CHECK_EQ(o.is_asked, is_asked);
            CHECK_EQ(o.kind, is_solid || !hulls || i == 6 ? kinds[i] : OVOID_MESH_HULL);
            CHECK_EQ(o.solid != NULL, is_solid);
            CHECK_EQ(o.shape != NULL, i != 6);
            ovoid_body body = ovoid_scene_get_body(scene, i, &o.pose);
            CHECK(body.solid == o.solid && (body.shape != NULL) == (i != 6 && !is_solid) &&
                  body.compound == o.compound);
            CHECK_EQ(body.pose.position.x, i == 0);
        }
        CHECK_NEAR(ovoid_scene_get(scene, 0).convexity.mesh_volume, 3, 1e-12);
        CHECK_EQ(ovoid_scene_get_mesh_solid(scene, 0) == NULL, hulls);
        ovoid_scene_destroy(scene);
    }
    // Equal geometries are one solid; another scale is another one.
    scene = ovoid_scene_read(file_write_text("solids.json", text), NULL, &error);
    if (!CHECK(scene != NULL)) return;
    CHECK(ovoid_scene_get(scene, 0).solid == ovoid_scene_get(scene, 8).solid);
    CHECK_NEAR(ovoid_solid_get_report(ovoid_scene_get(scene, 7).solid).volume, 24, 1e-12);
    CHECK(ovoid_scene_get_mesh_solid(scene, 0) == ovoid_scene_get(scene, 0).solid);
    ovoid_scene_destroy(scene);
}

// Many objects: names, geometries that are all different, and all the same.
static void check_many(void) {
    enum { COUNT = 3000 };
    char *text = malloc(COUNT * 100 + 100), *at = text;
    at += sprintf(at, "{\"objects\": [");
    for (int i = 0; i < COUNT; i++)
        at += sprintf(at, "%s{\"name\": \"n%d\", \"sphere\": %d}", i ? "," : "", i, i % 2 ? i : 1);
    sprintf(at, "]}");
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_scene *scene = ovoid_scene_read(file_write_text("many.json", text), NULL, &error);
    free(text);
    if (!CHECK(scene != NULL)) return;
    for (size_t i = 0; i < COUNT; i++) {
        const ovoid_shape *shape = ovoid_scene_get(scene, i).shape;
        CHECK_EQ(ovoid_shape_get_radius(shape), i % 2 ? (double)i : 1);
        CHECK_EQ(shape == ovoid_scene_get(scene, 0).shape, i % 2 == 0 || i == 1);
    }
    ovoid_scene_destroy(scene);
}

#define OBJECT(rest) "{\"objects\": [\n{\"name\": \"a\", \"sphere\": 1},\n{\"name\": \"b\",\n" rest "}]}"
#define BOX "\"box\": [1, 1, 1],\n"

static const bad_input bad_scenes[] = {
    {"empty.json", "", -1, "empty", OVOID_ERROR_EMPTY},
    {"c_parts.json", OBJECT(BOX "\"parts\": true"), 5, "object \"b\": \"parts\" is for meshes"},
    {"c_parts_type.json", OBJECT("\"mesh\": \"tetra.obj\",\n\"parts\": 1"), 5, "\"parts\" must be true or false"},
    {"c_none.json", OBJECT("\"compound\": []"), 4, "\"compound\" must be a list of parts"},
    {"c_type.json", OBJECT("\"compound\": {}"), 4, "\"compound\" must be a list of parts"},
    {"c_number.json", OBJECT("\"compound\": [\n7]"), 5, "object \"b\": part 0: must be a JSON object"},
    {"c_radius.json", OBJECT("\"radius\": 1,\n\"compound\": [{\"sphere\": 1}]"), 4, "\"radius\" is for the parts"},
    {"c_scale.json", OBJECT("\"compound\": [{\"sphere\": 1}],\n\"scale\": 2"), 5, "\"scale\" is for meshes and points"},
    {"c_name.json", OBJECT("\"compound\": [{\"sphere\": 1},\n{\"sphere\": 1, \"name\": \"x\"}]"), 5,
     "object \"b\": part 1: \"name\" is not a key of parts (pose, mesh, box, sphere, capsule, cylinder, cone, "
     "ellipsoid, "
     "points, radius, allowance, hull, parts, scale, unit)"},
    {"c_nested.json", OBJECT("\"compound\": [\n{\"compound\": [{\"sphere\": 1}]}]"), 5,
     "part 0: \"compound\" is not a key of parts"},
    {"c_size.json", OBJECT("\"compound\": [{\"sphere\": 1},\n{\"pose\": {},\n\"sphere\": -1}]"), 6,
     "object \"b\": part 1: \"sphere\" must be a radius"},
    {"c_pose.json", OBJECT("\"compound\": [{\"sphere\": 1,\n\"pose\": 1}]"), 5, "part 0: \"pose\" must"},
    {"c_bare.json", OBJECT("\"compound\": [{\"pose\": {}}]"), 4, "part 0: no geometry"},
    {"c_absent.json", OBJECT("\"compound\": [{\"mesh\": \"absent.obj\"}]"), 4, "part 0: ", OVOID_ERROR_FILE},
    {"c_far.json", OBJECT("\"compound\": [{\"sphere\": 1, \"pose\": {\"xyz\": [1e99, 0, 0]}}]"), 4,
     "part 0: \"pose\" has a number out of range", OVOID_ERROR_RANGE},
    {"syntax.json", "{\"objects\": [\n{\"name\": }]}", 2, "JSON: "},
    {"late.json", "{\"objects\": [\n{\"name\": 3},\n{\"name\": \"a\", \"sphere\": 1,}\n]}", 3, "JSON: "},
    {"last.json", "{\"objects\": [\n{\"name\": \"a\", \"sphere\": 1}\n],\n\"ignore\": [}", 4, "JSON: "},
    {"comma.json", "{\"objects\": [\n{\"name\": \"a\", \"sphere\": 1}\n,]}", 3, "JSON: "},
    {"element.json", "{\"objects\": [\n{\"name\": \"a\", \"sphere\": 1},\n3]}", 3, "must be a JSON object"},
    {"array.json", "[]", 1, "must be a JSON object"},
    {"twice.json", "{\"objects\": [],\n\"objects\": []}", 2, "JSON: duplicate"},
    {"key.json", "{\"objects\": [],\n\"color\": 3}", 2,
     "\"color\" is not a key of scenes, which have \"objects\", \"unit\" and \"ignore\""},
    {"no_objects.json", "{\"ignore\": []}", -1, "needs \"objects\""},
    {"none.json", "{\"objects\": []}", -1, "no objects", OVOID_ERROR_EMPTY},
    {"number.json", "{\"objects\": [\n3]}", 2, "object 0: must be a JSON object"},
    {"no_name.json", "{\"objects\": [\n{\"sphere\": 1}]}", 2, "object 0: \"name\" must be"},
    {"empty_name.json", "{\"objects\": [{\n\"name\": \"\"}]}", 2, "object 0: \"name\" must be"},
    {"object_key.json", OBJECT(BOX "\"colour\": 1"), 5, "object \"b\": \"colour\" is not a key"},
    {"no_geometry.json", OBJECT("\"pose\": {}"), 3, "object \"b\": no geometry"},
    {"two.json", OBJECT(BOX "\n\"sphere\": 1"), 6, "\"sphere\" is a second geometry"},
    {"same_name.json", "{\"objects\": [{\"name\": \"x\", \"sphere\": 1},\n{\"name\": \"x\", \"sphere\": 2}]}", 2,
     "object \"x\": \"name\" is that of an earlier object"},
    {"box.json", OBJECT("\"box\": [1, 2]"), 4, "\"box\" must be three sizes"},
    {"box_sign.json", OBJECT("\"box\": [1, 2, -3]"), 4, "\"box\" must be three sizes"},
    {"box_type.json", OBJECT("\"box\": [1, 2, \"3\"]"), 4, "\"box\" must be three sizes"},
    {"box_empty.json", OBJECT("\"box\": {}"), 4, "\"box\" must be three sizes"},
    {"box_both.json", OBJECT("\"box\": {\"half\": [1, 2, 3], \"size\": [2, 4, 6]}"), 4, "\"box\" must be three sizes"},
    {"box_key.json", OBJECT("\"box\": {\"sizes\": [1, 2, 3]}"), 4, "\"box\" must be three sizes"},
    {"box_half_sign.json", OBJECT("\"box\": {\"half\": [1, 2, -3]}"), 4, "\"box\" must be three sizes"},
    {"box_half_count.json", OBJECT("\"box\": {\"half\": [1, 2]}"), 4, "\"box\" must be three sizes"},
    {"sphere.json", OBJECT("\"sphere\": -1"), 4, "\"sphere\" must be a radius"},
    {"huge.json", OBJECT("\"sphere\": 1e999"), 4, "JSON: "},
    {"capsule.json", OBJECT("\"capsule\": {\"radius\": 1}"), 4, "\"capsule\" needs \"length\""},
    {"capsule_key.json", OBJECT("\"capsule\": {\"radius\": 1, \"length\": 1, \"sides\": 3}"), 4, "\"capsule\" must be"},
    {"axis.json", OBJECT("\"sphere\": 1, \"allowance\": {\"outside\": 1, \"axis\": [0, 0, 0]}"), 3,
     "\"axis\" of an allowance must be"},
    {"axes.json", OBJECT("\"sphere\": 1, \"allowance\": {\"outside\": 1, \"axis\": 3}"), 3,
     "\"axis\" of an allowance must be"},
    {"egg.json", OBJECT("\"ellipsoid\": [1, 2, 3]"), 4, "\"ellipsoid\" must be"},
    {"egg_two.json", OBJECT("\"ellipsoid\": {\"half_axes\": [1, 2]}"), 4, "\"ellipsoid\" must be"},
    {"egg_sign.json", OBJECT("\"ellipsoid\": {\"half_axes\": [1, 2, -3]}"), 4, "\"ellipsoid\" must be"},
    {"sides.json", OBJECT("\"cylinder\": {\"radius\": 1, \"length\": 1, \"sides\": 2}"), 4,
     "\"cylinder\" needs a whole number of sides"},
    {"half_sides.json", OBJECT("\"cone\": {\"radius\": 1, \"length\": 1, \"sides\": 3.5}"), 4,
     "\"cone\" needs a whole number of sides"},
    {"points.json", OBJECT("\"points\": []"), 4, "\"points\" must be a list"},
    {"points_type.json", OBJECT("\"points\": [[0, 0, 0], [1, 2]]"), 4, "\"points\" must be a list"},
    {"radius.json", OBJECT(BOX "\"radius\": -0.1"), 5, "\"radius\" must be a number >= 0", OVOID_ERROR_RADIUS},
    {"scale.json", OBJECT(BOX "\"scale\": 2"), 5, "\"scale\" is for meshes and points"},
    {"scale_zero.json", OBJECT("\"points\": [[0, 0, 0]],\n\"scale\": 0"), 5, "\"scale\" must be"},
    {"unit.json", OBJECT("\"points\": [[0, 0, 0]],\n\"unit\": \"yd\""), 5, "\"unit\" must be m, cm"},
    {"unit_dae.json", OBJECT("\"mesh\": \"x.dae\",\n\"unit\": \"mm\""), 5, "is not for COLLADA"},
    {"scene_unit.json", "{\"objects\": [{\"name\": \"a\", \"sphere\": 1}],\n\"unit\": \"yd\"}", 2,
     "\"unit\" must be m, cm, mm, um, in or ft"},
    {"mesh_type.json", OBJECT("\"mesh\": 3"), 4, "\"mesh\" must be the path"},
    {"mesh_absent.json", OBJECT("\"mesh\": \"nowhere.stl\""), 4, "nowhere.stl: cannot be opened", OVOID_ERROR_FILE},
    {"pose_type.json", OBJECT(BOX "\"pose\": [1, 2, 3]"), 5, "\"pose\" must be"},
    {"pose_key.json", OBJECT(BOX "\"pose\": {\"rotation\": 1}"), 5, "\"pose\" must be"},
    {"pose_both.json", OBJECT(BOX "\"pose\": {\"rpy\": [0, 0, 0], \"quat_wxyz\": [1, 0, 0, 0]}"), 5, "has both"},
    {"xyz.json", OBJECT(BOX "\"pose\": {\"xyz\": [1, 2]}"), 5, "three numbers in xyz"},
    {"quat.json", OBJECT(BOX "\"pose\": {\"quat_wxyz\": [1, 2, 3]}"), 5, "four numbers in quat_wxyz"},
    {"zero.json", OBJECT(BOX "\"pose\": {\"quat_wxyz\": [0, 0, 0, 0]}"), 5, "four zeros", OVOID_ERROR_ROTATION},
    {"far.json", OBJECT(BOX "\"pose\": {\"xyz\": [0, 0, 1e99]}"), 5, "out of range", OVOID_ERROR_RANGE},
    {"ignore_type.json", "{\"ignore\": {},\n\"objects\": [{\"name\": \"x\", \"sphere\": 1}]}", 1,
     "\"ignore\" must be a list"},
    {"ignore_pair.json", "{\"ignore\": [\n[\"x\"]],\n\"objects\": [{\"name\": \"x\", \"sphere\": 1}]}", 2,
     "must be two names"},
    {"ignore_name.json", "{\"objects\": [{\"name\": \"x\", \"sphere\": 1}],\n\"ignore\": [\n\n[\"x\", \"y\"]]}", 4,
     "there is no object \"y\""},
    {"ignore_self.json", "{\"objects\": [{\"name\": \"x\", \"sphere\": 1}],\n\"ignore\": [[\"x\", \"x\"]]}", 2,
     "one object twice"},
};

static int accepts(const char *path, ovoid_error *error) {
    ovoid_scene *scene = ovoid_scene_read(path, NULL, error);
    ovoid_scene_destroy(scene);
    return scene != NULL;
}

static void check_bad(void) {
    check_bad_inputs(bad_scenes, sizeof bad_scenes / sizeof *bad_scenes, accepts);
    // What is wrong inside a mesh has the mesh's own path and line.
    file_write_text("broken.obj", "v 0 0 0\nv 1 0 nan\n");
    ovoid_error error = {OVOID_OK, -1, ""};
    const char *path = file_write_text("inside.json", OBJECT("\"mesh\": \"broken.obj\""));
    CHECK(!ovoid_scene_read(path, NULL, &error) && error.code == OVOID_ERROR_NOT_FINITE && error.place == 2 &&
          strstr(error.message, "broken.obj:2:"));
    // The radius is the scene's business.
    ovoid_shape_options options = {.radius = 1};
    CHECK(!ovoid_scene_read(file_path("good.json"), &options, &error) && error.code == OVOID_ERROR_ARGUMENT);
}

// Changed bytes: a scene or an error with a sentence, never a crash or a leak (the sanitizers say).
static void check_damaged(void) {
    uint64_t s = 31;
    size_t length = strlen(good);
    for (int i = 0; i < 600; i++) {
        check_seed = s;
        char text[4096];
        memcpy(text, good, length);
        for (int k = 0; k < 3; k++)
            text[random_next(&s) % length] = "0123456789\"[]{},:.-e \n\xffx"[random_next(&s) % 24];
        size_t size = i % 4 ? length : random_next(&s) % length;
        ovoid_error error = {OVOID_OK, -1, ""};
        ovoid_scene *scene = ovoid_scene_read(file_write("damaged.json", text, size), NULL, &error);
        CHECK(scene ? ovoid_scene_get_count(scene) > 0 : error.code != OVOID_OK && error.message[0]);
        ovoid_scene_destroy(scene);
    }
    check_seed = 0;
}

// ---- shapes and lists of them

static void check_shapes(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    const char *path = file_write_text("parts.obj", two_parts);
    ovoid_read_options parts = {.scale = 2, .parts = 1};
    ovoid_shapes *shapes = ovoid_shapes_read_file(path, &parts, NULL, &error);
    if (CHECK(shapes && ovoid_shapes_get_count(shapes) == 2)) {
        CHECK(strcmp(ovoid_shapes_get(shapes, 0).name, "low") == 0);
        CHECK(strcmp(ovoid_shapes_get(shapes, 1).name, "part 1") == 0);
        CHECK_NEAR(get_size(ovoid_shapes_get(shapes, 1).shape, 2), 2, 1e-15);
    }
    ovoid_shapes_destroy(shapes);
    shapes = ovoid_shapes_read_file(path, NULL, NULL, &error);
    CHECK(shapes && ovoid_shapes_get_count(shapes) == 1 && strcmp(ovoid_shapes_get(shapes, 0).name, path) == 0);
    if (shapes) CHECK_NEAR(get_size(ovoid_shapes_get(shapes, 0).shape, 2), 6, 1e-15);
    ovoid_shapes_destroy(shapes);
}

static int accepts_list(const char *path, ovoid_error *error) {
    ovoid_shapes *shapes = ovoid_shapes_read_list(path, NULL, NULL, error);
    ovoid_shapes_destroy(shapes);
    return shapes != NULL;
}

static void check_list(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    file_write_text("tetra.obj", tetrahedron);
    file_write_text("parts.obj", two_parts);
    const char *path = file_write_text("list.txt", "# shapes\n\n tetra.obj \r\nparts.obj\n# again\ntetra.obj");
    ovoid_shapes *shapes = ovoid_shapes_read_list(path, NULL, NULL, &error);
    if (CHECK(shapes && ovoid_shapes_get_count(shapes) == 3)) {
        CHECK(ovoid_shapes_get(shapes, 0).shape == ovoid_shapes_get(shapes, 2).shape);
        CHECK(strcmp(ovoid_shapes_get(shapes, 1).name, file_path("parts.obj")) == 0);
    }
    ovoid_shapes_destroy(shapes);
    static const bad_input bad[] = {
        {"none.txt", "# nothing\n\n", -1, "names no files", OVOID_ERROR_EMPTY},
        {"absent.txt", "tetra.obj\nno.obj\n", 2, "no.obj: cannot be opened", OVOID_ERROR_FILE},
        {"empty.txt", "", -1, "the file is empty", OVOID_ERROR_EMPTY}};
    check_bad_inputs(bad, sizeof bad / sizeof *bad, accepts_list);
}

// A shape written to a file comes back with the same bytes; damaged ones are refused with their path.
static void check_shape_files(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_shape *shape = ovoid_shape_read_file(file_write_text("tetra.obj", tetrahedron), NULL, NULL, &error);
    const char *path = file_path("tetra.ovoid");
    if (!CHECK(shape && ovoid_shape_write_file(shape, path, &error) == OVOID_OK)) return;
    ovoid_shape *back = ovoid_shape_read_file(path, NULL, NULL, &error);
    size_t size, again;
    char *bytes = file_read(path, &size);
    if (CHECK(back != NULL) && CHECK(ovoid_shape_write_file(back, file_path("again.ovoid"), &error) == OVOID_OK)) {
        char *other = file_read(file_path("again.ovoid"), &again);
        CHECK(size == again && memcmp(bytes, other, size) == 0);
        free(other);
    }
    ovoid_shape_destroy(back);
    ovoid_read_options scaled = {.scale = 2};
    CHECK(!ovoid_shape_read_file(path, &scaled, NULL, &error) && error.code == OVOID_ERROR_ARGUMENT);
    ovoid_shape_options rounded = {.radius = 1};
    CHECK(!ovoid_shape_read_file(path, NULL, &rounded, &error) && error.code == OVOID_ERROR_ARGUMENT);
    CHECK(!ovoid_shape_read_file(file_write("cut.ovoid", bytes, size - 1), NULL, NULL, &error));
    CHECK(error.code == OVOID_ERROR_FORMAT && strstr(error.message, "cut.ovoid: "));
    CHECK(ovoid_shape_write_file(shape, file_path("no_folder/x.ovoid"), &error) == OVOID_ERROR_FILE);
    free(bytes);
    ovoid_shape_destroy(shape);
}

// Bodies that differ by the axis of their allowance alone are not the same.
static void check_axes(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    const char *path = file_write_text(
        "axes_of.json",
        "{\"objects\": [\n"
        "{\"name\": \"a\", \"box\": [1, 1, 1], \"allowance\": {\"outside\": 0.5, \"axis\": [0, 2, 0]}},\n"
        "{\"name\": \"b\", \"box\": [1, 1, 1], \"allowance\": {\"outside\": 0.5}},\n"
        "{\"name\": \"c\", \"cone\": {\"radius\": 1, \"length\": 2}}]}\n");
    ovoid_scene *scene = ovoid_scene_read(path, NULL, &error);
    if (!CHECK(scene != NULL)) return;
    static const double wanted[3][2] = {{1, 0}, {0, 0}, {0, 1}};
    for (size_t i = 0; i < 3; i++) {
        ovoid_vec3 axis = ovoid_shape_get_allowance(ovoid_scene_get(scene, i).shape).axis;
        CHECK(axis.x == 0 && axis.y == wanted[i][0] && axis.z == wanted[i][1]);
    }
    ovoid_scene_destroy(scene);
}

// Bare sizes and "size" are full ones, "half" the half ones; also of a part of a compound.
static void check_boxes(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    const char *path =
        file_write_text("boxes_of.json", "{\"objects\": [\n"
                                         "{\"name\": \"a\", \"box\": [1, 2, 3]},\n"
                                         "{\"name\": \"b\", \"box\": {\"size\": [1, 2, 3]}},\n"
                                         "{\"name\": \"c\", \"box\": {\"half\": [0.5, 1, 1.5]}},\n"
                                         "{\"name\": \"d\", \"compound\": [{\"box\": {\"half\": [0.5, 1, 1.5]}}]},\n"
                                         "{\"name\": \"e\", \"box\": {\"half\": [1, 2, 3]}}]}\n");
    ovoid_scene *scene = ovoid_scene_read(path, NULL, &error);
    if (!CHECK(scene != NULL)) return;
    for (size_t i = 0; i < 4; i++) {
        ovoid_scene_object object = ovoid_scene_get(scene, i);
        const ovoid_shape *shape = i < 3 ? object.shape : ovoid_compound_get_part(object.compound, 0).shape;
        CHECK_NEAR(ovoid_shape_get_measures(shape).volume, 6, 1e-12); // of eight corners, exact but for their sum
    }
    // The same numbers by another key are another body.
    CHECK_NEAR(ovoid_shape_get_measures(ovoid_scene_get(scene, 4).shape).volume, 48, 1e-11);
    ovoid_scene_destroy(scene);
}

int main(void) {
    check_unit();
    check_ellipsoid();
    check_boxes();
    check_axes();
    check_good();
    check_compounds();
    check_solids();
    check_many();
    check_bad();
    check_damaged();
    check_shapes();
    check_list();
    check_shape_files();
    return check_end();
}
