// The text is words between blanks. The first line names the scene. An object is "* name", its pose (newer format), the
// number of its shapes, each with sizes, pose and colour, and its subframes (newer format). "." ends the file. Numbers
// stay texts of the tree, with their lines: who reads the tree judges them. Cost: linear in the file.
#include "robot/read/scene/geometry_text.h"

#include <stdlib.h>
#include <string.h>

/// Lists of an object, filled as its shapes come.
typedef struct object_lists {
    yaml_value *primitives, *primitive_poses, *meshes, *mesh_poses;
} object_lists;

/// The state of reading. After an error nothing more is read.
typedef struct text_reader {
    const char *path, *at, *end;
    int64_t line;
    pool *memory;
    ovoid_error *error;
    ovoid_code code;
    yaml_value none; ///< stands for a value that memory is missing for
    int has_pose;    ///< the newer format: objects have poses and subframes; -1: not known yet
} text_reader;

static void fail(text_reader *t, ovoid_code code, const char *sentence) {
    if (!t->code) t->code = io_fail(t->error, code, (where){t->path, t->line, -1}, "%s", sentence);
}

/// A value of the tree; never NULL, but one that nothing holds where there is no memory.
static yaml_value *add(text_reader *t, yaml_value *parent, yaml_kind kind, const char *key) {
    yaml_value *value = pool_get(t->memory, 1, sizeof *value);
    if (!value) {
        if (!t->code) t->code = io_fail_memory(t->error, t->path);
        t->none = (yaml_value){.kind = kind, .text = ""};
        return &t->none;
    }
    *value = (yaml_value){.kind = kind, .line = t->line, .key = key, .text = ""};
    if (parent) yaml_append(parent, value);
    return value;
}

// ---- words

static int is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

static void skip_blanks(text_reader *t) {
    for (; t->at < t->end && is_blank(*t->at); t->at++) t->line += *t->at == '\n';
}

static const char *keep(text_reader *t, const char *from, const char *to) {
    const char *text = pool_copy(t->memory, from, (size_t)(to - from));
    if (!text && !t->code) t->code = io_fail_memory(t->error, t->path);
    return text ? text : "";
}

/// The next word; "" after an error, and where there is none.
static const char *take_word(text_reader *t) {
    skip_blanks(t);
    const char *from = t->at;
    while (t->at < t->end && !is_blank(*t->at)) t->at++;
    if (from == t->at) fail(t, OVOID_ERROR_FORMAT, "the file ends before the object does");
    return t->code ? "" : keep(t, from, t->at);
}

/// What is left of the line, without the blanks around it.
static const char *take_line(text_reader *t) {
    while (t->at < t->end && *t->at != '\n' && is_blank(*t->at)) t->at++;
    const char *from = t->at;
    while (t->at < t->end && *t->at != '\n') t->at++;
    const char *to = t->at;
    while (to > from && is_blank(to[-1])) to--;
    return keep(t, from, to);
}

/// A word that is a count.
static size_t take_count(text_reader *t, const char *sentence) {
    const char *word = take_word(t);
    char *end;
    unsigned long long count = strtoull(word, &end, 10);
    if (word[0] < '0' || word[0] > '9' || *end) fail(t, OVOID_ERROR_FORMAT, sentence);
    // Each of what is counted takes bytes: a count above them ends at the end of the file.
    return t->code ? 0 : (size_t)count;
}

static void add_word(text_reader *t, yaml_value *list) {
    const char *word = take_word(t);
    add(t, list, YAML_TEXT, NULL)->text = word;
}

static void add_numbers(text_reader *t, yaml_value *parent, const char *key, size_t count) {
    skip_blanks(t);
    yaml_value *list = add(t, parent, YAML_LIST, key);
    for (size_t i = 0; i < count && !t->code; i++) add_word(t, list);
}

static void add_pose(text_reader *t, yaml_value *parent, const char *key) {
    skip_blanks(t);
    yaml_value *pose = add(t, parent, YAML_MAP, key);
    add_numbers(t, pose, "position", 3);
    add_numbers(t, pose, "orientation", 4);
}

// ---- shapes

static void read_mesh(text_reader *t, yaml_value *list) {
    yaml_value *mesh = add(t, list, YAML_MAP, NULL);
    size_t points = take_count(t, "a mesh begins with the number of its vertices");
    size_t triangles = take_count(t, "a mesh needs the number of its triangles");
    yaml_value *vertices = add(t, mesh, YAML_LIST, "vertices");
    for (size_t i = 0; i < points && !t->code; i++) add_numbers(t, vertices, NULL, 3);
    yaml_value *corners = add(t, mesh, YAML_LIST, "triangles");
    for (size_t i = 0; i < triangles && !t->code; i++) add_numbers(t, corners, NULL, 3);
}

/// A message gives the height of cylinders and cones before the radius; the text gives the radius first.
static void swap_first(yaml_value *sizes) {
    if (sizes->count != 2) return;
    const char *radius = sizes->first->text;
    sizes->first->text = sizes->last->text;
    sizes->last->text = radius;
}

static void read_primitive(text_reader *t, const char *type, size_t size_count, yaml_value *list) {
    yaml_value *primitive = add(t, list, YAML_MAP, NULL);
    add(t, primitive, YAML_TEXT, "type")->text = type;
    add_numbers(t, primitive, "dimensions", size_count);
    if (primitive->last) swap_first(primitive->last);
}

static void read_shape(text_reader *t, const object_lists *lists) {
    static const char *const types[] = {"box", "sphere", "cylinder", "cone"};
    static const size_t sizes[] = {3, 1, 2, 2};
    const char *word = take_word(t);
    size_t type = 0;
    while (type < 4 && strcmp(word, types[type]) != 0) type++;
    int is_mesh = strcmp(word, "mesh") == 0;
    if (is_mesh)
        read_mesh(t, lists->meshes);
    else if (type < 4)
        read_primitive(t, types[type], sizes[type], lists->primitives);
    else if (strcmp(word, "plane") == 0)
        fail(t, OVOID_ERROR_FORMAT, "planes are not read; put a box in the plane's place");
    else
        fail(t, OVOID_ERROR_FORMAT, "a shape must be box, sphere, cylinder, cone or mesh");
    add_pose(t, is_mesh ? lists->mesh_poses : lists->primitive_poses, NULL);
    for (int i = 0; i < 4; i++) (void)take_word(t); // the colour
}

// ---- objects

/// 1: the line that comes has several words: an object's pose, where the older format has the number of shapes.
static int comes_pose(text_reader *t) {
    skip_blanks(t);
    const char *at = t->at;
    while (at < t->end && !is_blank(*at)) at++;
    while (at < t->end && *at != '\n' && is_blank(*at)) at++;
    return at < t->end && *at != '\n';
}

static void read_subframes(text_reader *t, yaml_value *object) {
    size_t count = take_count(t, "behind an object's shapes the number of its subframes must stand");
    yaml_value *names = add(t, object, YAML_LIST, "subframe_names");
    yaml_value *poses = add(t, object, YAML_LIST, "subframe_poses");
    for (size_t i = 0; i < count && !t->code; i++) {
        skip_blanks(t);
        const char *name = take_line(t);
        add(t, names, YAML_TEXT, NULL)->text = name;
        add_pose(t, poses, NULL);
    }
}

static void read_object(text_reader *t, yaml_value *objects) {
    yaml_value *object = add(t, objects, YAML_MAP, NULL);
    const char *name = take_line(t);
    add(t, object, YAML_TEXT, "id")->text = name;
    if (t->has_pose < 0) t->has_pose = comes_pose(t);
    if (t->has_pose) add_pose(t, object, "pose");
    size_t count = take_count(t, "an object's name is followed by the number of its shapes, or by its pose");
    const object_lists lists = {add(t, object, YAML_LIST, "primitives"), add(t, object, YAML_LIST, "primitive_poses"),
                                add(t, object, YAML_LIST, "meshes"), add(t, object, YAML_LIST, "mesh_poses")};
    for (size_t i = 0; i < count && !t->code; i++) read_shape(t, &lists);
    if (t->has_pose) read_subframes(t, object);
}

static yaml_value *read_scene(text_reader *t) {
    yaml_value *root = add(t, NULL, YAML_MAP, NULL), *world = add(t, root, YAML_MAP, "world");
    yaml_value *objects = add(t, world, YAML_LIST, "collision_objects");
    if (memchr(t->at, 0, (size_t)(t->end - t->at))) fail(t, OVOID_ERROR_FORMAT, "there is a byte of zero");
    (void)take_line(t);
    while (!t->code) {
        skip_blanks(t);
        char mark = t->at < t->end ? *t->at++ : 0;
        if (mark == '.') break;
        if (mark == '*')
            read_object(t, objects);
        else
            fail(t, OVOID_ERROR_FORMAT,
                 "MoveIt's text of a scene has \"* name\" or \".\" here (a planning scene in YAML ends in .yaml)");
    }
    return root;
}

ovoid_code geometry_text_read(const char *path, pool *memory, yaml_value **root, ovoid_error *error) {
    bytes file;
    ovoid_code code = bytes_read_input(path, YAML_SIZE_MAX, &file, error);
    if (code) return code;
    bytes text = bytes_skip_mark(file);
    text_reader t = {.path = path,
                     .at = text.data,
                     .end = text.data + text.size,
                     .line = 1,
                     .memory = memory,
                     .error = error,
                     .has_pose = -1};
    *root = read_scene(&t);
    free(file.data);
    return t.code;
}
