// Obstacles from a scene: MoveIt's planning scene in YAML (moveit_msgs/PlanningScene), its text (.scene), or ovoid's
// own scenes. An object is its parts, each convex or a solid; where an object and its parts have poses, the pose of a
// part is their product by definition. scene_state.c reads what a planning scene says beside them. Cost: n log n, plus
// the shapes.
#include "robot/read/scene/obstacles.h"
#include "robot/read/body/mesh_body.h"
#include "robot/read/scene/geometry_text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const ovoid_robot_read_options no_options;

static ovoid_code add_entry(ovoid_obstacles *o, const message_reader *r, const obstacle_entry *entry) {
    if (!array_reserve((void **)&o->entries, &o->capacity, o->count, sizeof *o->entries))
        return io_fail_memory(r->error, r->path);
    o->entries[o->count] = *entry;
    o->entries[o->count].index = o->count;
    o->count++;
    return OVOID_OK;
}

static ovoid_code keep_shape(ovoid_obstacles *o, const message_reader *r, ovoid_shape *shape) {
    if (!array_reserve((void **)&o->shapes, &o->shape_capacity, o->shape_count, sizeof *o->shapes)) {
        ovoid_shape_destroy(shape);
        return io_fail_memory(r->error, r->path);
    }
    o->shapes[o->shape_count++] = shape;
    return OVOID_OK;
}

// ---- primitives

// A type by its word, or by its number in shape_msgs/SolidPrimitive.
static int find_type(const char *word) {
    static const struct {
        const char *word, *number;
        primitive_kind kind;
    } types[] = {{"box", "1", PRIMITIVE_BOX},
                 {"sphere", "2", PRIMITIVE_SPHERE},
                 {"cylinder", "3", PRIMITIVE_CYLINDER},
                 {"cone", "4", PRIMITIVE_CONE}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strcmp(types[i].word, word) == 0 || strcmp(types[i].number, word) == 0) return (int)types[i].kind;
    return -1;
}

static ovoid_code read_primitive(const message_reader *r, const yaml_value *value, primitive *out) {
    static const char *const keys[] = {"x", "y", "z"};
    const yaml_value *type, *sizes;
    ovoid_code code = message_refuse_others(r, value, "type|dimensions|polygon");
    if (!code) code = message_find_kind(r, value, "type", YAML_TEXT, &type);
    if (!code) code = message_find_kind(r, value, "dimensions", YAML_LIST, &sizes);
    if (code) return code;
    if (!type || !sizes) return message_fail(r, value, OVOID_ERROR_FORMAT, "a primitive needs type and dimensions");
    int kind = find_type(type->text);
    if (kind < 0)
        return message_fail(r, type, OVOID_ERROR_FORMAT, "its type is \"%.40s\", not box, sphere, cylinder or cone",
                            type->text);
    *out = (primitive){.kind = (primitive_kind)kind};
    double *size = out->size;
    code = message_read_numbers(r, sizes, keys, primitive_get_size_count(out->kind), size);
    for (int k = 0; k < 3 && !code; k++)
        if (size[k] < 0) code = message_fail(r, sizes, OVOID_ERROR_RADIUS, "a dimension is below zero: %g", size[k]);
    // ROS gives the height of cylinders and cones before the radius.
    if (kind == PRIMITIVE_CYLINDER || kind == PRIMITIVE_CONE) {
        double height = size[0];
        size[0] = size[1];
        size[1] = height;
    }
    return code;
}

// ---- meshes

/// The numbers of a mesh.
typedef struct mesh_numbers {
    double *xyz;
    uint32_t *indices;
    size_t point_count, triangle_count;
} mesh_numbers;

static ovoid_code read_vertices(message_reader *r, const yaml_value *list, mesh_numbers *m) {
    static const char *const keys[] = {"x", "y", "z"};
    m->xyz = pool_get(&r->scratch, 3 * list->count, sizeof *m->xyz);
    if (!m->xyz) return io_fail_memory(r->error, r->path);
    for (const yaml_value *v = list->first; v; v = v->next) {
        ovoid_code code = message_read_numbers(r, v, keys, 3, m->xyz + 3 * m->point_count);
        if (code) return code;
        m->point_count++;
    }
    return OVOID_OK;
}

// {vertex_indices: [a, b, c]}, or the list itself.
static ovoid_code read_triangles(message_reader *r, const yaml_value *list, mesh_numbers *m) {
    static const char *const keys[] = {"a", "b", "c"};
    m->indices = pool_get(&r->scratch, 3 * list->count, sizeof *m->indices);
    if (!m->indices) return io_fail_memory(r->error, r->path);
    for (const yaml_value *v = list->first; v; v = v->next) {
        const yaml_value *corners = v;
        double index[3];
        ovoid_code code = v->kind == YAML_MAP ? message_find(r, v, "vertex_indices", &corners) : OVOID_OK;
        if (!code && !corners) code = message_fail(r, v, OVOID_ERROR_FORMAT, "a triangle needs vertex_indices");
        if (!code) code = message_read_numbers(r, corners, keys, 3, index);
        for (int k = 0; k < 3 && !code; k++) {
            if (!(index[k] >= 0 && index[k] < (double)m->point_count) || index[k] != floor(index[k]))
                code = message_fail(r, corners, OVOID_ERROR_INDEX, "a triangle names the vertex %g of %zu", index[k],
                                    m->point_count);
            else
                m->indices[3 * m->triangle_count + (size_t)k] = (uint32_t)index[k];
        }
        if (code) return code;
        m->triangle_count++;
    }
    return OVOID_OK;
}

static ovoid_code keep_solid(ovoid_obstacles *o, const message_reader *r, ovoid_solid *solid) {
    if (!solid) return OVOID_OK;
    if (!array_reserve((void **)&o->solids, &o->solid_capacity, o->solid_count, sizeof *o->solids)) {
        ovoid_solid_destroy(solid);
        return io_fail_memory(r->error, r->path);
    }
    o->solids[o->solid_count++] = solid;
    return OVOID_OK;
}

// What the triangles are, where they are given and their hull is not asked for.
static ovoid_code make_body(const message_reader *r, ovoid_obstacles *o, const yaml_value *at, const mesh_numbers *m,
                            obstacle_entry *entry) {
    const ovoid_triangles triangles = {m->xyz, m->point_count, m->indices, m->triangle_count};
    ovoid_error why;
    mesh_body body = {.shape = entry->made};
    if (m->triangle_count && !r->options->hull) {
        ovoid_code code = mesh_body_make(&triangles, entry->made,
                                         r->options->shape ? r->options->shape->allocator : NULL, &body, &why);
        if (code == OVOID_ERROR_MEMORY) return io_fail_memory(r->error, r->path);
        if (code) return message_fail(r, at, code, "%s; --hull takes its hull", why.message);
    }
    entry->made = body.shape;
    entry->solid = body.solid;
    if (body.kind == OVOID_MESH_SURFACE)
        message_note(r, at,
                     "a mesh of the object %.100s is not closed, %llu of its edges are open: it counts as its surface, "
                     "which has no inside (--hull takes its hull)",
                     r->object, (unsigned long long)body.edges_open);
    ovoid_code code = keep_shape(o, r, entry->made);
    if (!code) return keep_solid(o, r, body.solid);
    ovoid_solid_destroy(body.solid);
    return code;
}

static ovoid_code read_mesh(message_reader *r, ovoid_obstacles *o, const yaml_value *value, obstacle_entry *entry) {
    const yaml_value *vertices, *triangles;
    mesh_numbers m = {NULL, NULL, 0, 0};
    ovoid_error why;
    ovoid_code code = message_refuse_others(r, value, "vertices|triangles");
    if (!code) code = message_find_kind(r, value, "vertices", YAML_LIST, &vertices);
    if (!code) code = message_find_kind(r, value, "triangles", YAML_LIST, &triangles);
    if (!code && !vertices) code = message_fail(r, value, OVOID_ERROR_EMPTY, "a mesh needs vertices");
    if (!code) code = read_vertices(r, vertices, &m);
    if (!code && triangles) code = read_triangles(r, triangles, &m);
    if (code) return code;
    entry->what.kind = PRIMITIVE_MESH;
    entry->made = ovoid_shape_create_from_points(m.xyz, m.point_count, r->options->shape, &why);
    if (!entry->made) return message_fail(r, vertices, why.code, "%s", why.message);
    return make_body(r, o, value, &m, entry);
}

// ---- objects

/// A list of parts and that of their poses.
typedef struct part_lists {
    const yaml_value *parts, *poses;
} part_lists;

static ovoid_code find_lists(const message_reader *r, const yaml_value *object, const char *const keys[2],
                             part_lists *lists) {
    ovoid_code code = message_find_kind(r, object, keys[0], YAML_LIST, &lists->parts);
    if (!code) code = message_find_kind(r, object, keys[1], YAML_LIST, &lists->poses);
    if (code || !lists->parts) return code;
    // One part alone may have the object's pose only.
    size_t poses = lists->poses ? lists->poses->count : 0;
    if (poses == lists->parts->count || (poses == 0 && lists->parts->count == 1)) return OVOID_OK;
    return message_fail(r, lists->parts, OVOID_ERROR_FORMAT, "there are %zu %s but %zu %s", lists->parts->count,
                        keys[0], poses, keys[1]);
}

static ovoid_code read_parts(message_reader *r, ovoid_obstacles *o, const yaml_value *object, const char *const keys[2],
                             const obstacle_entry *whole) {
    part_lists lists;
    ovoid_code code = find_lists(r, object, keys, &lists);
    if (code || !lists.parts) return code;
    const yaml_value *pose = lists.poses ? lists.poses->first : NULL;
    for (const yaml_value *v = lists.parts->first; v && !code; v = v->next) {
        obstacle_entry entry = *whole;
        entry.at = v;
        entry.line = v->line;
        ovoid_pose inner;
        code = message_read_pose(r, pose, &inner);
        if (!code) code = keys[0][0] == 'm' ? read_mesh(r, o, v, &entry) : read_primitive(r, v, &entry.what);
        entry.pose = ovoid_pose_compute_product(&whole->pose, &inner);
        if (!code && ovoid_pose_validate(&entry.pose))
            code = message_fail(r, v, OVOID_ERROR_RANGE, "its pose has a number above %g", OVOID_LENGTH_MAX);
        if (!code) code = add_entry(o, r, &entry);
        if (pose) pose = pose->next;
    }
    return code;
}

// What would be an obstacle and is none here must not be passed over.
static ovoid_code refuse_others(const message_reader *r, const yaml_value *object) {
    const yaml_value *operation;
    ovoid_code code = message_refuse_others(r, object,
                                            "id|header|pose|primitives|primitive_poses|meshes|mesh_poses|planes|"
                                            "plane_poses|operation|type|subframe_names|subframe_poses");
    if (!code) code = message_refuse_filled(r, object, "planes", "are not read; put a box in the plane's place");
    if (!code) code = message_find(r, object, "operation", &operation);
    if (code || !operation || strcmp(operation->text, "0") == 0 || strcmp(operation->text, "add") == 0) return code;
    return message_fail(r, operation, OVOID_ERROR_FORMAT, "its operation is \"%.20s\"; only 0, to add, is read",
                        operation->text);
}

static ovoid_code read_frame(message_reader *r, const yaml_value *object, const char **frame) {
    const yaml_value *header;
    *frame = "";
    ovoid_code code = message_find_kind(r, object, "header", YAML_MAP, &header);
    return code || !header ? code : message_read_frame(r, header, frame);
}

// holder: what its parts have of the link that holds the object; all zero: it stands in the world.
static ovoid_code read_object(message_reader *r, ovoid_obstacles *o, const yaml_value *object, obstacle_entry holder) {
    static const char *const primitives[2] = {"primitives", "primitive_poses"}, *const meshes[2] = {"meshes",
                                                                                                    "mesh_poses"};
    const yaml_value *value;
    const char *name;
    r->object = NULL;
    ovoid_code code = message_read_text(r, object, "id", &name);
    if (code) return code;
    if (!name[0]) return message_fail(r, object, OVOID_ERROR_FORMAT, "an object needs an id");
    holder.name = r->object = name;
    holder.object = object;
    size_t before = o->count;
    code = refuse_others(r, object);
    if (!code) code = read_frame(r, object, &holder.frame);
    if (!code) code = message_find_kind(r, object, "pose", YAML_MAP, &value);
    if (!code) code = message_read_pose(r, value, &holder.pose);
    if (!code) code = read_parts(r, o, object, primitives, &holder);
    if (!code) code = read_parts(r, o, object, meshes, &holder);
    if (!code && o->count == before)
        code = message_fail(r, object, OVOID_ERROR_EMPTY, "it has neither primitives nor meshes");
    return code;
}

// ---- what links hold

static ovoid_code read_touching(const message_reader *r, const yaml_value *value, obstacle_entry *holder) {
    const yaml_value *list;
    ovoid_code code = message_find_kind(r, value, "touch_links", YAML_LIST, &list);
    if (code || !list) return code;
    const char **names = pool_get(r->memory, list->count, sizeof *names);
    if (!names) return io_fail_memory(r->error, r->path);
    for (const yaml_value *v = list->first; v; v = v->next) {
        if (v->kind != YAML_TEXT) return message_fail(r, v, OVOID_ERROR_FORMAT, "a link's name must be a text");
        names[holder->touching_count] = pool_copy(r->memory, v->text, strlen(v->text));
        if (!names[holder->touching_count++]) return io_fail_memory(r->error, r->path);
    }
    holder->touching = names;
    return OVOID_OK;
}

static ovoid_code read_attached(message_reader *r, ovoid_obstacles *o, const yaml_value *value) {
    const yaml_value *object;
    obstacle_entry holder = {.name = NULL};
    r->object = NULL;
    ovoid_code code = message_refuse_others(r, value, "link_name|object|touch_links|detach_posture|weight");
    if (!code) code = message_read_text(r, value, "link_name", &holder.link);
    if (!code) code = message_find_kind(r, value, "object", YAML_MAP, &object);
    if (!code) code = read_touching(r, value, &holder);
    if (!code && (!object || !holder.link[0]))
        code = message_fail(r, value, OVOID_ERROR_FORMAT, "an attached object needs link_name and object");
    return code ? code : read_object(r, o, object, holder);
}

static ovoid_code read_all_attached(message_reader *r, ovoid_obstacles *o, const yaml_value *root) {
    const yaml_value *robot, *list = NULL;
    ovoid_code code = message_find_kind(r, root, "robot_state", YAML_MAP, &robot);
    if (!code && robot) code = message_find_kind(r, robot, "attached_collision_objects", YAML_LIST, &list);
    for (const yaml_value *v = list ? list->first : NULL; v && !code; v = v->next) code = read_attached(r, o, v);
    r->object = NULL;
    return code;
}

// MoveIt keeps the last of two objects with one id; which of them is meant is for the file to say.
static ovoid_code refuse_twice(message_reader *r, const ovoid_obstacles *o) {
    name_index names = {.entries = pool_get(&r->scratch, o->count, sizeof *names.entries)};
    if (!names.entries) return io_fail_memory(r->error, r->path);
    for (size_t i = 0; i < o->count; i++)
        if (!i || o->entries[i].object != o->entries[i - 1].object)
            names.entries[names.count++] = (name_entry){o->entries[i].name, (uint32_t)i};
    size_t twice = name_index_sort(&names);
    if (twice == names.count) return OVOID_OK;
    r->object = names.entries[twice].name;
    return message_fail(r, o->entries[names.entries[twice].index].object, OVOID_ERROR_FORMAT,
                        "it is there twice: each object needs an id of its own");
}

// ---- shapes of primitives

static int compare_entries(const void *a, const void *b) {
    const obstacle_entry *m = *(obstacle_entry *const *)a, *n = *(obstacle_entry *const *)b;
    int order = primitive_compare(&m->what, &n->what);
    return order ? order : (m->index > n->index) - (m->index < n->index);
}

// Equal primitives are neighbours when they are sorted, and are made once.
static ovoid_code make_shapes(message_reader *r, ovoid_obstacles *o) {
    obstacle_entry **order = pool_get(&r->scratch, o->count, sizeof *order);
    if (!order) return io_fail_memory(r->error, r->path);
    for (size_t i = 0; i < o->count; i++) order[i] = &o->entries[i];
    if (o->count) qsort(order, o->count, sizeof *order, compare_entries);
    for (size_t i = 0; i < o->count; i++) {
        obstacle_entry *e = order[i];
        ovoid_error why;
        if (e->made) e->shape = e->made;
        if (!e->shape && i && primitive_compare(&order[i - 1]->what, &e->what) == 0) e->shape = order[i - 1]->shape;
        if (e->shape) continue;
        ovoid_shape *shape = primitive_create(&e->what, r->options, &why);
        r->object = e->name;
        if (!shape) return message_fail(r, e->at, why.code, "%s", why.message);
        ovoid_code code = keep_shape(o, r, shape);
        if (code) return code;
        e->shape = shape;
    }
    return OVOID_OK;
}

// ---- scenes

static ovoid_code refuse_octomap(const message_reader *r, const yaml_value *world) {
    const yaml_value *with_pose, *map = NULL;
    ovoid_code code = message_find_kind(r, world, "octomap", YAML_MAP, &with_pose);
    if (!code && with_pose) code = message_refuse_others(r, with_pose, "header|origin|octomap");
    if (!code && with_pose) code = message_find_kind(r, with_pose, "octomap", YAML_MAP, &map);
    if (!code && map) code = message_refuse_others(r, map, "header|binary|id|resolution|data");
    return code || !map
               ? code
               : message_refuse_filled(r, map, "data", "of an octomap is not read; its voxels would be missing");
}

static ovoid_code read_world(message_reader *r, ovoid_obstacles *o, const yaml_value *root) {
    const yaml_value *world, *objects = NULL;
    if (root->kind == YAML_TEXT && strchr(root->text, '*'))
        return message_fail(r, root, OVOID_ERROR_FORMAT,
                            "this is MoveIt's text of a scene: it is read where the file's name ends in .scene");
    ovoid_code code = message_find_kind(r, root, "world", YAML_MAP, &world);
    if (!code && world) code = message_find_kind(r, world, "collision_objects", YAML_LIST, &objects);
    if (code) return code;
    if (!world)
        return message_fail(r, root, OVOID_ERROR_FORMAT, "a planning scene needs world: collision_objects: [...]");
    code = message_refuse_others(r, world, "collision_objects|octomap");
    if (!code)
        code = message_refuse_others(r, root,
                                     "name|world|robot_model_name|robot_state|fixed_frame_transforms|is_diff|"
                                     "allowed_collision_matrix|link_padding|link_scale|object_colors");
    if (!code) code = refuse_octomap(r, world);
    if (!code) code = scene_state_read(r, root, &o->state);
    for (const yaml_value *v = objects ? objects->first : NULL; v && !code; v = v->next)
        code = read_object(r, o, v, (obstacle_entry){.name = NULL});
    if (!code) code = read_all_attached(r, o, root);
    if (!code) code = refuse_twice(r, o);
    return code ? code : make_shapes(r, o);
}

static ovoid_code read_planning_scene(message_reader *r, ovoid_obstacles *o) {
    yaml_value *root;
    ovoid_code code = path_has_extension(r->path, "scene") ? geometry_text_read(r->path, &r->scratch, &root, r->error)
                                                           : yaml_read(r->path, &r->scratch, &root, r->error);
    if (!code) code = read_world(r, o, root);
    pool_clear(&r->scratch);
    return code;
}

// A robot's lengths are metres. Those of a scene in another unit would be taken for metres.
static ovoid_code require_metres(const message_reader *r, const ovoid_scene *scene) {
    const char *unit = ovoid_scene_get_unit(scene);
    if (!unit[0] || strcmp(unit, "m") == 0) return OVOID_OK;
    return io_fail(r->error, OVOID_ERROR_FORMAT, (where){r->path, 0, -1},
                   "the scene is in %s, and a robot is in metres: write its lengths in metres, with \"unit\": \"m\"; a "
                   "mesh may have a \"unit\" of its own",
                   unit);
}

// Compounds are their parts; with the option hull meshes are their hulls, but where the scene says otherwise.
static ovoid_code read_own_scene(const message_reader *r, ovoid_obstacles *o) {
    o->scene = (r->options->hull ? ovoid_scene_read_hulls : ovoid_scene_read)(r->path, r->options->shape, r->error);
    if (!o->scene) return OVOID_ERROR_FILE;
    ovoid_code code = require_metres(r, o->scene);
    for (size_t i = 0; i < ovoid_scene_get_count(o->scene) && !code; i++) {
        ovoid_scene_object object = ovoid_scene_get(o->scene, i);
        if (object.solid && r->options->hull)
            return io_fail(r->error, OVOID_ERROR_FORMAT, (where){r->path, 0, -1},
                           "object \"%.60s\": \"solid\": true, but hulls are asked for", object.name);
        obstacle_entry entry = {
            .name = object.name, .frame = "", .pose = object.pose, .shape = object.shape, .solid = object.solid};
        size_t parts = object.compound ? ovoid_compound_get_part_count(object.compound) : 0;
        if (!parts) code = add_entry(o, r, &entry);
        for (size_t k = 0; k < parts && !code; k++) {
            ovoid_posed_shape part = ovoid_compound_get_part(object.compound, k);
            entry.shape = part.shape;
            entry.pose = ovoid_pose_compute_product(&object.pose, &part.pose);
            code = add_entry(o, r, &entry);
        }
    }
    return code;
}

ovoid_obstacles *ovoid_obstacles_read(const char *path, const ovoid_robot_read_options *options, ovoid_error *error) {
    ovoid_obstacles *o = calloc(1, sizeof *o);
    if (!o) {
        (void)io_fail_memory(error, path);
        return NULL;
    }
    message_reader r = {.path = path, .options = options ? options : &no_options, .error = error, .memory = &o->memory};
    o->path = pool_copy(&o->memory, path, strlen(path));
    int is_own = path_has_extension(path, "json") || path_has_extension(path, "ovoids");
    ovoid_code code = !o->path                       ? io_fail_memory(error, path)
                      : !(r.options->tolerance >= 0) ? io_fail(error, OVOID_ERROR_ARGUMENT, (where){path, 0, -1},
                                                               "the tolerance of cylinders is not a length >= 0")
                      : is_own                       ? read_own_scene(&r, o)
                                                     : read_planning_scene(&r, o);
    if (!code) return o;
    ovoid_obstacles_destroy(o);
    return NULL;
}

void ovoid_obstacles_destroy(ovoid_obstacles *o) {
    if (!o) return;
    for (size_t i = 0; i < o->shape_count; i++) ovoid_shape_destroy(o->shapes[i]);
    for (size_t i = 0; i < o->solid_count; i++) ovoid_solid_destroy(o->solids[i]);
    ovoid_scene_destroy(o->scene);
    free(o->solids);
    free(o->shapes);
    free(o->entries);
    pool_clear(&o->memory);
    free(o);
}

size_t ovoid_obstacles_get_count(const ovoid_obstacles *o) { return o->count; }

ovoid_obstacle ovoid_obstacles_get(const ovoid_obstacles *o, size_t i) {
    const obstacle_entry *e = &o->entries[i];
    return (ovoid_obstacle){e->name, e->shape, e->pose, e->solid, e->frame[0] ? e->frame : NULL, e->link};
}
