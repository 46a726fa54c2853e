// ovoid view: a scene, a pair or one body as an SVG picture, or as a page for the browser: polyhedra, ellipsoids,
// areas, witness points.
#include "commands.h"

#include "base/finish.h"
#include "base/inputs.h"
#include "base/message.h"
#include "base/outputs.h"
#include "page/scenes.h"
#include "pairs/answers.h"
#include "pairs/solids.h"

#include <ovoid/ovoid.h>

#include <stdlib.h>
#include <string.h>

typedef struct settings {
    read_settings read;
    ovoid_pose pose_a, pose_b;
    const char *output, *html;
    ovoid_vec3 from;
    unsigned layers, width, height;
    solids_choice choice;
    double margin; ///< negative: not given
} settings;

static const cli_option options[] = {
    {"output", 'o', OPTION_OUTPUT, offsetof(settings, output), "FILE", "svg",
     "the picture, an SVG file (default: standard output, unless there is --html)"},
    PAGE_OPTION(settings),
    {"pose-a", 0, OPTION_POSE, offsetof(settings, pose_a), ARGS_POSE, NULL,
     "pose of A" ARGS_POSE_HELP " (default: \"0 0 0\")"},
    {"pose-b", 0, OPTION_POSE, offsetof(settings, pose_b), ARGS_POSE, NULL, "pose of B"},
    SOLIDS_OPTIONS(settings, "A and B are compounds of their files' objects, as with ovoid distance"),
    {"margin", 0, OPTION_LENGTH, offsetof(settings, margin), "M", NULL,
     "draw the witness points of all pairs within M (default: of each of at most 12 objects and the one nearest to "
     "it)"},
    {"layers", 0, OPTION_SET, offsetof(settings, layers), "LIST", "outer|inner|areas|witness|names|legend|meshes",
     "what is drawn with the polyhedra, with commas between: outer, inner (ellipsoids), areas (the 8 facial areas), "
     "witness, names, legend, meshes (in the place of their hulls) (default: all but areas and meshes; above 12 bodies "
     "or parts meshes and no ellipsoids)"},
    {"from", 0, OPTION_VECTOR, offsetof(settings, from), "\"X Y Z\"", NULL,
     "direction from the scene to the eye (default: \"1 -1.6 0.9\")"},
    {"width", 0, OPTION_COUNT, offsetof(settings, width), "W", NULL, "pixels (default: 1200)"},
    {"height", 0, OPTION_COUNT, offsetof(settings, height), "H", NULL, "pixels (default: 800)"},
    INPUTS_OPTIONS(settings),
    {0},
};

/// The largest number of objects whose nearest pairs are drawn by default: more would hide the bodies.
#define OBJECTS_FEW 12

/// The objects of a link.
typedef struct linked_couple {
    ovoid_couple couple;
    double lower;
} linked_couple;

/// The contents of the picture.
typedef struct drawing {
    ovoid_body *bodies; ///< the objects
    size_t *first;      ///< for each object: the index of its first drawn body; the other parts of a compound follow
    ovoid_picture_body *drawn; ///< shapes, and the parts of compounds
    ovoid_picture_link *links;
    ovoid_answer *answers;  ///< of the links
    linked_couple *couples; ///< of the links
    ovoid_mesh **meshes;    ///< of the objects, if they are drawn
    ovoid_faces *faces;     ///< of the drawn bodies that have a mesh
    size_t body_count, drawn_count, link_count, link_capacity;
    answer_room room;
} drawing;

/// Makes room for that many objects and drawn bodies; 0 after a message.
static int make_drawing(drawing *d, size_t bodies, size_t drawn) {
    *d = (drawing){.bodies = calloc(bodies + 1, sizeof *d->bodies),
                   .first = calloc(bodies + 1, sizeof *d->first),
                   .drawn = calloc(drawn + 1, sizeof *d->drawn),
                   .meshes = calloc(bodies + 1, sizeof(ovoid_mesh *)),
                   .faces = calloc(drawn + 1, sizeof *d->faces)};
    if (d->bodies && d->first && d->drawn && d->meshes && d->faces) return 1;
    message_error("out of memory");
    return 0;
}

static void clear_drawing(drawing *d) {
    for (size_t i = 0; d->meshes && i < d->body_count; i++) ovoid_mesh_destroy(d->meshes[i]);
    free(d->meshes);
    free(d->faces);
    free(d->bodies);
    free(d->first);
    free(d->drawn);
    free(d->links);
    free(d->answers);
    free(d->couples);
    answer_room_clear(&d->room);
}

static size_t count_parts(const ovoid_compound *compound) {
    return compound ? ovoid_compound_get_part_count(compound) : 1;
}

static int get_mesh_use(const ovoid_solid *solid) {
    if (!solid) return 0;
    return ovoid_solid_get_report(solid).is_closed ? OVOID_PICTURE_CLOSED : 1;
}

/// Adds an object: a shape, a solid with its hull, or the parts of a compound, of which the first has the name.
static void add_body(drawing *d, const char *name, const ovoid_body *body, const ovoid_shape *hull) {
    d->first[d->body_count] = d->drawn_count;
    d->bodies[d->body_count] = *body;
    uint32_t group = (uint32_t)++d->body_count;
    for (size_t i = 0; i < count_parts(body->compound); i++) {
        ovoid_posed_shape part = {hull, body->pose};
        if (body->compound) {
            part = ovoid_compound_get_part(body->compound, i);
            part.pose = ovoid_pose_compute_product(&body->pose, &part.pose);
        }
        d->drawn[d->drawn_count++] =
            (ovoid_picture_body){i ? NULL : name, part.shape, part.pose, group, NULL, get_mesh_use(body->solid)};
    }
}

/// The largest number of bodies and parts that are drawn as polyhedra by default; more are drawn as their meshes.
#define POLYHEDRA_MOST 12

/// Reads the mesh of the object that was added last, if it has one to draw. 0, or EXIT_INPUT after a message.
static int add_mesh(drawing *d, unsigned layers, size_t drawn, const mesh_source *source) {
    int is_wanted = layers ? (layers & OVOID_PICTURE_MESHES) != 0 : drawn > POLYHEDRA_MOST;
    size_t number = d->body_count - 1, first = d->first[number];
    is_wanted |= d->drawn[first].is_mesh;
    if (!is_wanted || !inputs_has_mesh(source)) return 0;
    ovoid_mesh *mesh = d->meshes[number] = inputs_read_mesh(source);
    if (!mesh) return EXIT_INPUT;
    for (size_t i = first; i < d->drawn_count && i - first < ovoid_mesh_get_part_count(mesh); i++) {
        d->faces[i] = ovoid_mesh_get_part(mesh, i - first).faces;
        d->drawn[i].mesh = &d->faces[i];
    }
    return 0;
}

/// An answer, and the deciding parts of compounds.
typedef struct found_answer {
    ovoid_answer answer;
    uint32_t part_a, part_b;
} found_answer;

/// Answers a pair as ovoid check does. 0, or EXIT_INPUT after a message.
static int find(drawing *d, size_t a, size_t b, const answers_query *query, found_answer *found) {
    const ovoid_body_pair pair = {d->bodies[a], d->bodies[b]};
    ovoid_record record = {.a = NULL};
    if (!answers_find(&d->room, &pair, query, &record)) return message_error("out of memory"), EXIT_INPUT;
    *found = (found_answer){record.answer, pair.a.compound ? record.part_a : 0, pair.b.compound ? record.part_b : 0};
    return 0;
}

static int add_link(drawing *d, size_t a, size_t b, const found_answer *found) {
    if (d->link_count == d->link_capacity) {
        size_t capacity = d->link_capacity ? 2 * d->link_capacity : 64;
        ovoid_picture_link *links = realloc(d->links, capacity * sizeof *links);
        if (links) d->links = links;
        ovoid_answer *answers = realloc(d->answers, capacity * sizeof *answers);
        if (answers) d->answers = answers;
        linked_couple *couples = realloc(d->couples, capacity * sizeof *couples);
        if (couples) d->couples = couples;
        if (!links || !answers || !couples) return message_error("out of memory"), EXIT_INPUT;
        d->link_capacity = capacity;
    }
    d->links[d->link_count] = (ovoid_picture_link){.a = d->first[a] + found->part_a, .b = d->first[b] + found->part_b};
    d->couples[d->link_count] = (linked_couple){{(uint32_t)a, (uint32_t)b}, found->answer.lower};
    d->answers[d->link_count++] = found->answer;
    return 0;
}

static const answers_query distance_query = {.query = QUERY_DISTANCE, .margin = -1};

/// Links each object with the nearest one; a mutually nearest pair once.
static int link_nearest(drawing *d, const ovoid_scene *scene) {
    int code = 0;
    size_t none = d->body_count, *nearest = malloc((d->body_count + 1) * sizeof *nearest);
    if (!nearest) return message_error("out of memory"), EXIT_INPUT;
    for (size_t a = 0; a < d->body_count && !code; a++) {
        found_answer best = {.part_a = 0}, found;
        nearest[a] = none;
        for (size_t b = 0; b < d->body_count && !code; b++) {
            if (b == a || (scene && ovoid_scene_is_ignored(scene, a, b))) continue;
            // The lower index comes first, so that both ways give the same answer.
            code = find(d, a < b ? a : b, a < b ? b : a, &distance_query, &found);
            if (!code && (nearest[a] == none || found.answer.lower < best.answer.lower)) best = found, nearest[a] = b;
        }
        size_t b = nearest[a];
        int is_linked = b < a && nearest[b] == a;
        if (!code && b != none && !is_linked) code = add_link(d, a < b ? a : b, a < b ? b : a, &best);
    }
    free(nearest);
    return code;
}

/// Links all pairs that are not proven farther than the margin.
static int link_within(drawing *d, const ovoid_scene *scene, double margin) {
    const answers_query within = {.query = QUERY_WITHIN, .margin = margin};
    int code = 0;
    for (size_t a = 0; a < d->body_count; a++)
        for (size_t b = a + 1; b < d->body_count && !code; b++) {
            found_answer found;
            if (scene && ovoid_scene_is_ignored(scene, a, b)) continue;
            code = find(d, a, b, &within, &found);
            if (code || ovoid_answer_is_within(&found.answer, margin) == 0) continue;
            code = find(d, a, b, &distance_query, &found);
            if (!code) code = add_link(d, a, b, &found);
        }
    return code;
}

/// 1 if an SVG picture is wanted.
static int is_drawn(const settings *s) { return s->output || !s->html; }

/// Writes the picture; returns the exit code.
static int write_picture(drawing *d, const settings *s, const ovoid_scene *scene) {
    ovoid_error error;
    for (size_t i = 0; i < d->link_count; i++) d->links[i].answer = &d->answers[i];
    ovoid_picture picture = {.bodies = d->drawn,
                             .body_count = d->drawn_count,
                             .links = d->links,
                             .link_count = d->link_count,
                             .unit = scene ? ovoid_scene_get_unit(scene) : inputs_get_unit(&s->read)};
    ovoid_picture_options how = {.width = s->width, .height = s->height, .view = s->from, .layers = s->layers};
    finish_hold_signals();
    ovoid_code written = ovoid_picture_write_svg(s->output ? s->output : "-", &picture, &how, &error);
    finish_release_signals();
    if (written == OVOID_OK) return EXIT_APART;
    if (finish_is_unread(stdout) && !s->output) return EXIT_PIPE;
    finish_report_failure(&error);
    return EXIT_INPUT;
}

/// Finds the links and writes the picture, if one is wanted; returns the exit code.
static int draw(drawing *d, const settings *s, const ovoid_scene *scene) {
    int code = 0;
    if (s->margin >= 0)
        code = link_within(d, scene, s->margin);
    else if (d->body_count <= OBJECTS_FEW || s->layers & OVOID_PICTURE_WITNESS)
        code = link_nearest(d, scene);
    return code || !is_drawn(s) ? code : write_picture(d, s, scene);
}

static int compare_couples(const void *a, const void *b) {
    const linked_couple *p = a, *q = b;
    if (p->lower != q->lower) return p->lower < q->lower ? -1 : 1;
    if (p->couple.a != q->couple.a) return p->couple.a < q->couple.a ? -1 : 1;
    return p->couple.b < q->couple.b ? -1 : p->couple.b > q->couple.b;
}

/// Writes the page of a scene, with its links. 0, or an exit code after a message.
static int write_page(cli_page *page, drawing *d, const settings *s, const ovoid_scene *scene, const char *path) {
    if (!page->path) return 0;
    ovoid_pose *poses = inputs_copy_poses(scene);
    if (!poses) return EXIT_INPUT;
    if (d->link_count) qsort(d->couples, d->link_count, sizeof *d->couples, compare_couples);
    const answers_job job = {.scene = scene,
                             .poses = poses,
                             .query = QUERY_DISTANCE,
                             .margin = s->margin,
                             .couples = d->couples,
                             .stride = sizeof *d->couples,
                             .count = d->link_count};
    int code = page_write_scene(page, path, &job);
    free(poses);
    return code;
}

static int draw_scene(const settings *s, const char *path, cli_page *page) {
    ovoid_scene *scene = inputs_read_scene(path, s->choice.hull);
    if (!scene) return EXIT_INPUT;
    inputs_warn_scene(scene);
    size_t count = ovoid_scene_get_count(scene), drawn = 0;
    for (size_t i = 0; i < count; i++) drawn += count_parts(ovoid_scene_get(scene, i).compound);
    drawing d;
    int code = make_drawing(&d, count, drawn) ? 0 : EXIT_INPUT;
    for (size_t i = 0; i < count && !code; i++) {
        ovoid_scene_object object = ovoid_scene_get(scene, i);
        ovoid_body body = ovoid_scene_get_body(scene, i, &object.pose);
        add_body(&d, object.name, &body, object.shape);
        const mesh_source mesh = inputs_find_mesh(scene, i);
        if (is_drawn(s)) code = add_mesh(&d, s->layers, drawn, &mesh);
    }
    if (!code) code = draw(&d, s, scene);
    if (!code) code = write_page(page, &d, s, scene, path);
    clear_drawing(&d);
    ovoid_scene_destroy(scene);
    return code;
}

/// The file's name without its folder.
static const char *get_base(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}

/// Draws one body, or A and B.
static int draw_bodies(const settings *s, const cli_operands *paths, cli_page *page) {
    page_body listed[2];
    cli_body bodies[2] = {{NULL, NULL, NULL}, {NULL, NULL, NULL}};
    size_t drawn = 0;
    const ovoid_pose poses[2] = {s->pose_a, s->pose_b};
    const read_settings read = solids_get_read(&s->read, &s->choice);
    const ovoid_solid *solids[2] = {NULL, NULL};
    drawing d;
    int code = 0;
    for (int i = 0; i < paths->count && !code; i++) {
        code = inputs_open_body(paths->items[i], &read, s->choice.parts, &bodies[i]);
        if (!code) solids[i] = solids_get(paths->items[i], &bodies[i]);
        drawn += count_parts(bodies[i].compound);
    }
    if (!make_drawing(&d, 2, drawn)) code = EXIT_INPUT;
    if (!code) inputs_warn_bodies(paths->items, bodies, (size_t)paths->count, &read);
    for (int i = 0; i < paths->count && !code; i++) {
        ovoid_body body = inputs_get_body(&bodies[i], &poses[i]);
        if (solids[i]) body = (ovoid_body){.solid = solids[i], .pose = poses[i]};
        mesh_source mesh = {.path = paths->items[i], .read = inputs_make_options(&read)};
        mesh.read.parts = s->choice.parts;
        add_body(&d, get_base(paths->items[i]), &body, bodies[i].shape);
        listed[i] = (page_body){.name = get_base(paths->items[i]),
                                .body = inputs_get_body(&bodies[i], &poses[i]),
                                .solid = solids[i],
                                .mesh = mesh,
                                .convexity = ovoid_shapes_get(bodies[i].parts, 0).convexity};
        if (is_drawn(s)) code = add_mesh(&d, s->layers, drawn, &mesh);
    }
    if (!code) code = draw(&d, s, NULL);
    const page_bodies_source source = {listed, (size_t)paths->count, inputs_get_unit(&s->read), s->margin};
    if (!code) code = page_write_files(page, &source);
    clear_drawing(&d);
    inputs_close_body(&bodies[0]);
    inputs_close_body(&bodies[1]);
    return code;
}

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.read.unit = INPUTS_NO_UNIT,
                  .pose_a = ovoid_pose_make_identity(),
                  .pose_b = ovoid_pose_make_identity(),
                  .margin = -1};
    cli_operands paths;
    int code = command_parse(command, argc, argv, &s, &paths);
    if (code < 0) code = solids_settle(command, &s.choice);
    if (code < 0) code = page_settle(command, s.html, (shard_part){0, 0});
    if (code >= 0) return code;
    if (is_drawn(&s) && !s.output && message_is_terminal(stdout))
        return args_complain(command, "view: --output FILE is missing, and standard output is a terminal");
    int is_scene = paths.count == 1 && inputs_is_scene(paths.items[0]);
    if (is_scene && (s.choice.parts || s.choice.solid))
        return args_complain(command, "view: --%s is for A and B; a scene says its own (\"%s\": true)",
                             s.choice.parts ? "parts" : "solid", s.choice.parts ? "parts" : "solid");
    if (is_scene && (s.read.unit != INPUTS_NO_UNIT || s.read.scale > 0))
        return args_complain(command,
                             "view: --unit and --scale are for A and B; a scene says its own (\"unit\": \"mm\")");
    int is_moved_b = !args_is_origin(&s.pose_b);
    if (is_scene ? is_moved_b || !args_is_origin(&s.pose_a) : is_moved_b && paths.count == 1)
        return args_complain(command, is_scene ? "view: --pose-a and --pose-b are for A and B; a scene says its own"
                                               : "view: --pose-b is for B, which is missing");
    cli_page page;
    if (page_open(&page, s.html)) return EXIT_INPUT;
    code = is_scene ? draw_scene(&s, paths.items[0], &page) : draw_bodies(&s, &paths, &page);
    page_close(&page);
    return code;
}

const cli_command command_view = {
    .name = "view",
    .summary = "a picture of a scene or of bodies",
    .usage = "[OPTION...] SCENE.json -o PICTURE.svg\n"
             "[OPTION...] A [B] -o PICTURE.svg\n"
             "[OPTION...] SCENE.json --html PAGE.html",
    .description = "Draws a scene, a pair or one body as an SVG picture: the polyhedra, the ellipsoid around each and "
                   "the one inside it, the witness points of pairs and the distance between them. With --html, "
                   "writes a page for the browser that shows the same and checks the proofs of these pairs.",
    .exits = "0 drawn\n"
             "2 the command line is wrong\n"
             "3 bad input, or a picture or a page that could not be written",
    .examples = "ovoid view cell.json -o cell.svg\n"
                "ovoid view a.stl b.stl --pose-b \"0 0 2 1 0 0 0\" -o pair.svg\n"
                "ovoid view cell.json --html cell.html\n"
                "ovoid view rock.obj --layers inner,areas -o areas.svg",
    .options = options,
    .operands_min = 1,
    .operands_max = 2,
    .run = run,
};
