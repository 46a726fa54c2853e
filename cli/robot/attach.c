// Objects that links hold, from the command line: "hand=box 0.04 0.04 0.1 at 0 0 0.1 touch fingers". They are attached
// to the cell as those of a scene are. An object of the scene is taken out of the world and held where it stands, seen
// from its link in the first state.
#include "base/inputs.h"
#include "base/message.h"
#include "robot/cell_files.h"

#include <ovoid/ovoid.h>

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/// What was made of one text.
typedef struct cell_held {
    struct cell_held *next;
    char *text;    ///< the parts of `words` point into it
    cli_body file; ///< a mesh; all NULL: none
    ovoid_shape *shape;
} cell_held;

/// A text, cut apart. NULL: not given.
typedef struct attach_words {
    char *link, *object, *at, *scale, *touch;
} attach_words;

/// What attaching one text works with.
typedef struct attacher {
    const cli_command *command;
    const cell_settings *settings;
    const double *q;
    cli_cell *cell;
    const char *given; ///< the text as it was given
    cell_held *held;
    attach_words words;
    uint32_t link, *touching;
    size_t touching_count;
} attacher;

#define complain(a, ...) complain_of(a, (snprintf(why, sizeof why, __VA_ARGS__), why))
enum { WHY_ROOM = 400 };

static int complain_of(const attacher *a, const char *why) {
    const char *file = a->settings->attached_in;
    if (file) return message_error("%s: \"attached\": \"%.150s\": %s", file, a->given, why), EXIT_INPUT;
    (void)args_complain(a->command, "%s: --attach \"%.150s\": %s", a->command->name, a->given, why);
    return EXIT_USAGE;
}

// ---- words

/// Behind a word that has a blank on both sides, whose first blank becomes the end of what stands before; or NULL.
static char *cut_word(char *text, const char *word) {
    size_t size = strlen(word);
    for (char *at = text; (at = strchr(at, ' ')); at++) {
        if (strncmp(at + 1, word, size) != 0 || at[1 + size] != ' ') continue;
        *at = 0;
        return at + size + 2;
    }
    return NULL;
}

static char *trim(char *text) {
    while (*text == ' ') text++;
    for (size_t size = strlen(text); size && text[size - 1] == ' '; size--) text[size - 1] = 0;
    return text;
}

/// Cuts the text into its words. 0, or EXIT_USAGE.
static int cut(attacher *a) {
    char why[WHY_ROOM], *equals = strchr(a->held->text, '=');
    attach_words *w = &a->words;
    if (!equals || equals == a->held->text || !equals[1])
        return complain(a, "LINK=OBJECT is wanted, as \"hand=box 0.04 0.04 0.1 at 0 0 0.1\"");
    *equals = 0;
    w->link = trim(a->held->text);
    w->object = equals + 1;
    // The words may stand in any order: each is looked for in all that is left, and ends what stands before it.
    char **const values[] = {&w->at, &w->scale, &w->touch};
    static const char *const names[] = {"at", "scale", "touch"};
    for (int i = 0; i < 3; i++) *values[i] = cut_word(w->object, names[i]);
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            if (i != k && *values[i] && !*values[k]) *values[k] = cut_word(*values[i], names[k]);
    w->object = trim(w->object);
    for (int i = 0; i < 3; i++)
        if (*values[i]) *values[i] = trim(*values[i]);
    return 0;
}

// ---- links

static int complain_no_link(const attacher *a, const char *name) {
    enum { WORDS_MAX = 256 };
    const ovoid_robot_description *d = &a->cell->description;
    const char *words[WORDS_MAX];
    char why[WHY_ROOM];
    size_t count = d->link_count < WORDS_MAX ? d->link_count : WORDS_MAX;
    for (size_t i = 0; i < count; i++) words[i] = d->links[i].name;
    const char *similar = args_find_similar(name, words, count);
    return complain(a, "there is no link%s \"%.60s\"%s%.60s%s", name == a->words.link ? "" : " or group", name,
                    similar ? "; did you mean " : ": \"ovoid robot info\" lists them", similar ? similar : "",
                    similar ? "?" : "");
}

static void add_touching(attacher *a, uint32_t link) {
    if (link == a->link) return;
    for (size_t i = 0; i < a->touching_count; i++)
        if (a->touching[i] == link) return;
    a->touching[a->touching_count++] = link;
}

static void add_group(attacher *a, size_t group) {
    ovoid_robot_group g = ovoid_robot_file_get_group(a->cell->robot.file, group);
    for (size_t i = 0; i < g.link_count; i++) add_touching(a, g.links[i]);
}

/// The link or the group of that name. 0 where there is neither.
static int add_name(attacher *a, const char *name) {
    uint32_t link = ovoid_robot_find_link(a->cell->robot.robot, name);
    if (link != OVOID_ROBOT_NONE) return add_touching(a, link), 1;
    for (size_t i = 0; i < ovoid_robot_file_get_group_count(a->cell->robot.file); i++)
        if (strcmp(ovoid_robot_file_get_group(a->cell->robot.file, i).name, name) == 0) return add_group(a, i), 1;
    return 0;
}

/// The links of the end effectors that the link carries or belongs to.
static void add_effectors(attacher *a) {
    const ovoid_robot_file *file = a->cell->robot.file;
    for (size_t i = 0; i < ovoid_robot_file_get_end_effector_count(file); i++) {
        ovoid_robot_end_effector e = ovoid_robot_file_get_end_effector(file, i);
        ovoid_robot_group g = ovoid_robot_file_get_group(file, e.group);
        int is_of_it = e.link == a->link;
        for (size_t k = 0; k < g.link_count; k++) is_of_it |= g.links[k] == a->link;
        if (is_of_it) add_group(a, e.group);
    }
}

/// The link that holds, and those that may be touched. 0, or an exit code after a message.
static int find_links(attacher *a) {
    a->link = ovoid_robot_find_link(a->cell->robot.robot, a->words.link);
    if (a->link == OVOID_ROBOT_NONE) return complain_no_link(a, a->words.link);
    a->touching = malloc((a->cell->description.link_count + 1) * sizeof *a->touching);
    if (!a->touching) return message_error("out of memory"), EXIT_INPUT;
    if (!a->words.touch) add_effectors(a);
    for (char *at = a->words.touch, *comma; at; at = comma ? comma + 1 : NULL) {
        comma = strchr(at, ',');
        if (comma) *comma = 0;
        if (!add_name(a, trim(at))) return complain_no_link(a, trim(at));
    }
    return 0;
}

// ---- shapes

/// The primitive that the words name; *is_one: whether they name one. 0, or an exit code after a message.
static int make_primitive(attacher *a, int *is_one) {
    static const struct {
        const char *word;
        int count;
        const char *sizes;
    } kinds[] = {{"box", 3, "box X Y Z"},
                 {"sphere", 1, "sphere RADIUS"},
                 {"cylinder", 2, "cylinder RADIUS LENGTH"},
                 {"capsule", 2, "capsule RADIUS LENGTH"},
                 {"cone", 2, "cone RADIUS LENGTH"}};
    const ovoid_shape_options options = {.tolerance = a->settings->robot->tolerance};
    size_t head = strcspn(a->words.object, " "), i = 0;
    double v[3] = {0, 0, 0};
    char why[WHY_ROOM], *at = a->words.object + head, *end = at;
    int count = 0;
    while (i < 5 && (strlen(kinds[i].word) != head || strncmp(kinds[i].word, a->words.object, head) != 0)) i++;
    *is_one = i < 5;
    if (i == 5) return 0;
    for (; count < 3 && (v[count] = strtod(at, &end), end != at); count++) at = end;
    if (*at || count != kinds[i].count) return complain(a, "%s is wanted, full sizes in metres", kinds[i].sizes);
    a->words.object[head] = 0;
    ovoid_error error;
    const ovoid_vec3 half = {v[0] / 2, v[1] / 2, v[2] / 2};
    a->held->shape = i == 0   ? ovoid_shape_create_box(half, NULL, &error)
                     : i == 1 ? ovoid_shape_create_sphere(v[0], NULL, &error)
                     : i == 2 ? ovoid_shape_create_cylinder(v[0], v[1] / 2, &options, &error)
                     : i == 3 ? ovoid_shape_create_capsule(v[0], v[1] / 2, NULL, &error)
                              : ovoid_shape_create_cone(v[0], v[1] / 2, &options, &error);
    return a->held->shape ? 0 : complain_of(a, error.message);
}

/// Attaches one body, and adds it to the bodies of the cell or puts it in the place of one. 0, or EXIT_INPUT.
static int hold(attacher *a, const cell_body *body, size_t place) {
    cli_cell *cell = a->cell;
    ovoid_error error;
    const ovoid_body shape = {.shape = body->solid ? NULL : body->shape, .pose = body->at.pose, .solid = body->solid};
    const ovoid_robot_attachment held = {a->link, shape, a->touching, a->touching_count};
    cell->bodies[place] = *body;
    cell->bodies[place].at.link = a->link;
    cell->bodies[place].at.id = ovoid_robot_cell_attach(cell->cell, &held, &error);
    if (cell->bodies[place].at.id) return 0;
    (void)complain_of(a, error.message);
    return EXIT_INPUT;
}

/// Holds a shape that belongs to nobody else. 0, or an exit code after a message.
static int hold_new(attacher *a, const char *name, const ovoid_shape *shape, const ovoid_solid *solid) {
    char why[WHY_ROOM];
    cell_body body = {.name = name, .shape = shape, .solid = solid, .at.pose = ovoid_pose_make_identity()};
    if (a->words.at && !args_parse_pose(a->words.at, &body.at.pose))
        return complain(a,
                        "at \"%.60s\": a position is wanted, \"0 0 0.1\", perhaps with a quaternion w x y z, or with "
                        "\"rpy R P Y\" or \"deg R P Y\"",
                        a->words.at);
    if (cell_reserve_bodies(a->cell, 1)) return EXIT_INPUT;
    return hold(a, &body, a->cell->body_count++);
}

/// A mesh file. 0, or an exit code after a message.
static int hold_file(attacher *a) {
    char why[WHY_ROOM];
    read_settings read = {.hull = a->settings->robot->hull};
    if (a->words.scale && !(args_parse_number(a->words.scale, &read.scale) && read.scale > 0))
        return complain(a, "scale \"%.60s\" is no number above 0", a->words.scale);
    int code = inputs_open_body(a->words.object, &read, 0, &a->held->file);
    if (code) return code;
    ovoid_named_shape part = ovoid_shapes_get(a->held->file.parts, 0);
    if (part.solid && !ovoid_solid_get_report(part.solid).is_closed)
        inputs_warn_surface(a->words.object, part.convexity.edges_unmatched);
    const char *slash = strrchr(a->words.object, '/');
    return hold_new(a, slash ? slash + 1 : a->words.object, part.shape, part.solid);
}

// ---- objects of the scene

static int is_of_scene(const attacher *a, size_t i) {
    return strcmp(a->cell->bodies[i].name, a->words.object) == 0 && a->cell->bodies[i].at.link == OVOID_ROBOT_NONE;
}

/// Links that an obstacle may touch, by the scene, may touch it when it is held, too.
static void keep_allowed(attacher *a, ovoid_id id) {
    for (uint32_t i = 0; i < a->cell->description.link_count; i++)
        if (ovoid_robot_cell_is_body_allowed(a->cell->cell, id, i)) add_touching(a, i);
}

/// Holds what stands in the world at a place that is seen from the link, whose pose is given. 0, or EXIT_INPUT.
static int hold_obstacle(attacher *a, size_t i, const ovoid_pose *link) {
    cell_body body = a->cell->bodies[i];
    const ovoid_pose in_link = ovoid_pose_compute_inverse(link);
    body.at.pose = ovoid_pose_compute_product(&in_link, &body.at.pose);
    keep_allowed(a, body.at.id);
    if (ovoid_robot_cell_remove(a->cell->cell, body.at.id, NULL) != OVOID_OK) return EXIT_INPUT;
    return hold(a, &body, i);
}

/// All parts of an object. 0, or an exit code after a message.
static int hold_object(attacher *a) {
    char why[WHY_ROOM];
    ovoid_error error;
    if (a->words.at || a->words.scale)
        return complain(a,
                        "%s is an object of the scene, and is held where it stands in the first state: without \"at\" "
                        "and \"scale\"",
                        a->words.object);
    if (!a->q)
        return complain(a, "an object of the scene is held where it stands in the first state: not with --shard");
    ovoid_pose *links = calloc(a->cell->description.link_count + 1, sizeof *links);
    if (!links) return message_error("out of memory"), EXIT_INPUT;
    int code = 0;
    if (ovoid_robot_compute_poses(a->cell->robot.robot, a->q, links, &error) != OVOID_OK)
        message_error("the first state: %s", error.message), code = EXIT_INPUT;
    for (size_t i = 0; i < a->cell->body_count && !code; i++)
        if (is_of_scene(a, i)) code = hold_obstacle(a, i, &links[a->link]);
    free(links);
    return code;
}

/// 1: the scene has an object of that name.
static int has_object(const attacher *a) {
    size_t i = 0;
    while (i < a->cell->body_count && !is_of_scene(a, i)) i++;
    return i < a->cell->body_count;
}

static int complain_nothing(const attacher *a) {
    enum { WORDS_MAX = 256 };
    const char *words[WORDS_MAX];
    char why[WHY_ROOM];
    for (size_t i = 0; i < a->cell->body_count; i++) {
        const cell_body *body = &a->cell->bodies[i];
        if (body->at.link == OVOID_ROBOT_NONE || strcmp(body->name, a->words.object) != 0) continue;
        return complain(a, "%.60s is held already, by %.60s", body->name,
                        a->cell->description.links[body->at.link].name);
    }
    size_t count = a->cell->body_count < WORDS_MAX ? a->cell->body_count : WORDS_MAX;
    for (size_t i = 0; i < count; i++) words[i] = a->cell->bodies[i].name;
    const char *similar = args_find_similar(a->words.object, words, count);
    return complain(a, "\"%.60s\" is no object of the scene and no mesh file%s%.60s%s", a->words.object,
                    similar ? "; did you mean " : "; boxes are \"box X Y Z\", spheres \"sphere R\"",
                    similar ? similar : "", similar ? "?" : "");
}

// ---- all of them

static int attach(attacher *a) {
    char why[WHY_ROOM];
    int is_primitive = 0, code = cut(a);
    if (!code) code = find_links(a);
    if (!code && !has_object(a)) code = make_primitive(a, &is_primitive);
    if (code) return code;
    if (is_primitive && a->words.scale) return complain(a, "scale is for mesh files");
    if (is_primitive) return hold_new(a, a->words.object, a->held->shape, NULL);
    if (has_object(a)) return hold_object(a);
    return access(a->words.object, R_OK) == 0 ? hold_file(a) : complain_nothing(a);
}

int cell_attach(const cli_command *command, const cell_settings *settings, const double *q, cli_cell *cell) {
    int code = 0;
    for (int i = 0; i < settings->attached.count && !code; i++) {
        attacher a = {
            .command = command, .settings = settings, .q = q, .cell = cell, .given = settings->attached.items[i]};
        a.held = calloc(1, sizeof *a.held);
        if (a.held) a.held->text = strdup(a.given);
        if (!a.held || !a.held->text) return free(a.held), message_error("out of memory"), EXIT_INPUT;
        a.held->next = cell->held;
        cell->held = a.held;
        code = attach(&a);
        free(a.touching);
        cell_sort_ids(cell);
    }
    return code;
}

void cell_free_held(cli_cell *cell) {
    while (cell->held) {
        cell_held *held = cell->held;
        cell->held = held->next;
        inputs_close_body(&held->file);
        ovoid_shape_destroy(held->shape);
        free(held->text);
        free(held);
    }
}

void cell_tell_held(const cli_cell *cell, const cell_settings *settings) {
    for (size_t i = 0; i < cell->body_count && settings->attached.count; i++) {
        const cell_body *body = &cell->bodies[i];
        char *text = NULL;
        size_t size = 0, count = 0;
        FILE *list = body->at.link == OVOID_ROBOT_NONE ? NULL : open_memstream(&text, &size);
        for (uint32_t k = 0; list && k < cell->description.link_count; k++) {
            if (k == body->at.link || !ovoid_robot_cell_is_body_allowed(cell->cell, body->at.id, k)) continue;
            fprintf(list, "%s%s", count++ ? ", " : "; it may touch ", cell->description.links[k].name);
        }
        if (list && fclose(list) == 0)
            message_note("%s holds %s%s", cell->description.links[body->at.link].name, body->name, text);
        free(text);
    }
}
