// Reading a robot: options become those of the library, notes become warnings.
#include "robot/inputs.h"

#include "base/message.h"
#include "robot/xacro.h"

#include <stdlib.h>
#include <string.h>

/// Most notes that are shown.
#define NOTES_MAX 50

/// The packages of the options: NAME=DIR, cut at the sign.
typedef struct package_list {
    ovoid_robot_package items[ARGS_LIST_MAX];
    char *texts[ARGS_LIST_MAX];
    int count;
} package_list;

static void free_packages(package_list *list) {
    for (int i = 0; i < list->count; i++) free(list->texts[i]);
}

/// 0, or an exit code after a message.
static int split_packages(const cli_command *command, const args_list *given, package_list *list) {
    list->count = 0;
    for (int i = 0; i < given->count; i++) {
        const char *equals = strchr(given->items[i], '=');
        if (!equals || equals == given->items[i] || !equals[1])
            return args_complain(command, "%s: --package needs NAME=DIR, got \"%s\"", command->name, given->items[i]);
        size_t size = strlen(given->items[i]) + 1;
        char *text = malloc(size);
        if (!text) {
            message_error("out of memory");
            return EXIT_INPUT;
        }
        memcpy(text, given->items[i], size);
        text[equals - given->items[i]] = 0;
        list->texts[list->count] = text;
        list->items[list->count++] = (ovoid_robot_package){text, text + (equals - given->items[i]) + 1};
    }
    return 0;
}

int robot_split_value(const cli_command *command, const char *option, const char *text, link_value *is) {
    const char *equals = strrchr(text, '='), *number = equals ? equals + 1 : text;
    size_t length = equals ? (size_t)(equals - text) : 0;
    if (!args_parse_number(number, &is->value) || equals == text || length >= sizeof is->link)
        return args_complain(command, "%s: --%s needs LINK=NUMBER or a NUMBER for all links, got \"%s\"", command->name,
                             option, text);
    memcpy(is->link, text, length);
    is->link[length] = 0;
    return 0;
}

/// The factors of links as the library takes them.
typedef struct scale_list {
    ovoid_robot_link_scale items[ARGS_LIST_MAX];
    link_value values[ARGS_LIST_MAX];
    size_t count;
} scale_list;

/// 0, or an exit code after a message.
static int split_scales(const cli_command *command, const args_list *given, scale_list *list) {
    for (list->count = 0; list->count < (size_t)given->count; list->count++) {
        link_value *v = &list->values[list->count];
        int code = robot_split_value(command, "scale", given->items[list->count], v);
        if (code) return code;
        list->items[list->count] = (ovoid_robot_link_scale){*v->link ? v->link : NULL, v->value};
    }
    return 0;
}

void robot_warn(void *context, const ovoid_robot_note *note) {
    cli_robot *robot = context;
    if (robot->note_count++ >= NOTES_MAX) return;
    if (note->line)
        message_warning("%s:%lld: %s", note->path, (long long)note->line, note->text);
    else
        message_warning("%s: %s", note->path, note->text);
}

/// The texts of a robot: those of xacro files are expanded, all others are left to the library.
typedef struct robot_texts {
    ovoid_robot_text urdf, srdf;
} robot_texts;

/// 0, or an exit code after a message.
static int expand_texts(const cli_command *command, const char *urdf, const robot_settings *s, robot_texts *texts) {
    static const args_list none;
    int has_urdf = xacro_is_file(urdf), has_srdf = xacro_is_file(s->srdf);
    *texts = (robot_texts){{urdf, NULL, 0}, {s->srdf, NULL, 0}};
    if (s->xacro.count && !has_urdf && !has_srdf)
        return args_complain(command, "%s: --xacro goes with a file that ends in .xacro", command->name);
    int code = has_urdf ? xacro_expand(command, urdf, &s->xacro, &texts->urdf) : 0;
    if (!code && has_srdf) code = xacro_expand(command, s->srdf, has_urdf ? &none : &s->xacro, &texts->srdf);
    return code;
}

static int read_file(const robot_texts *texts, const robot_settings *s, const package_list *packages,
                     const scale_list *scales, cli_robot *robot) {
    ovoid_error error;
    ovoid_robot_read_options options = {.packages = packages->items,
                                        .package_count = (size_t)packages->count,
                                        .parts = s->parts,
                                        .hull = s->hull,
                                        .scales = scales->items,
                                        .scale_count = scales->count,
                                        .visual = s->visual,
                                        .fixed_base = !s->free_base,
                                        .tolerance = s->tolerance,
                                        .note = robot_warn,
                                        .context = robot};
    robot->file = ovoid_robot_file_read_text(&texts->urdf, texts->srdf.path ? &texts->srdf : NULL, &options, &error);
    if (robot->note_count > NOTES_MAX) message_warning("and %zu more", robot->note_count - NOTES_MAX);
    if (robot->file) {
        ovoid_robot_description description = ovoid_robot_file_get_description(robot->file);
        robot->robot = ovoid_robot_create(&description, NULL, &error);
        if (!robot->robot) message_error("%s: %s", texts->urdf.path, error.message);
    } else {
        message_error("%s", error.message);
        if (texts->urdf.data || texts->srdf.data) message_note("lines of a .xacro file are those that xacro writes");
    }
    if (robot->robot) return 0;
    robot_close(robot);
    return EXIT_INPUT;
}

/// Meshes that are named in a warning.
enum { MESHES_NAMED = 3 };

/// Whether the hull of a mesh, or of an object of it, stands for what is not convex because it was asked for.
static int is_replaced(const ovoid_robot_mesh *mesh, const robot_settings *settings) {
    return mesh->convexity.kind != OVOID_MESH_HULL && (settings->hull || mesh->kind == OVOID_MESH_PARTS);
}

/// Warns in one line of the meshes of which hulls were asked for that add to them.
static void warn_hulls(const cli_robot *robot, const robot_settings *settings) {
    size_t count = 0, size = 0;
    double mesh = 0, hull = 0;
    char *text = NULL, share[64] = "", more[40] = "";
    FILE *list = open_memstream(&text, &size);
    for (size_t i = 0; i < ovoid_robot_file_get_mesh_count(robot->file) && list; i++) {
        ovoid_robot_mesh m = ovoid_robot_file_get_mesh(robot->file, i);
        if (!is_replaced(&m, settings)) continue;
        if (count < MESHES_NAMED) fprintf(list, "%s%s", count ? ", " : "", m.address);
        count++;
        if (m.convexity.mesh_volume > 0) mesh += m.convexity.mesh_volume, hull += m.convexity.hull_volume;
    }
    if (mesh > 0) snprintf(share, sizeof share, ", which add %.2g %% of volume", 100 * (hull / mesh - 1));
    if (count > MESHES_NAMED) snprintf(more, sizeof more, " and %zu more", count - MESHES_NAMED);
    if (list && fclose(list) == 0 && count)
        message_warning("%s that are not convex, or not closed, count as their hulls%s: %s%s",
                        settings->parts ? "objects of meshes" : "meshes", share, text, more);
    free(text);
}

/// What the options hold, in memory: it would be 20 KB of the stack below the library's queries.
typedef struct option_lists {
    package_list packages;
    scale_list scales;
} option_lists;

int robot_open_beside(const cli_command *command, const char *urdf, const robot_settings *settings, cli_robot *robot) {
    *robot = (cli_robot){NULL, NULL, 0};
    option_lists *lists = calloc(1, sizeof *lists);
    robot_texts texts = {.urdf.data = NULL};
    if (!lists) {
        message_error("out of memory");
        return EXIT_INPUT;
    }
    int code = split_packages(command, &settings->packages, &lists->packages);
    if (!code) code = split_scales(command, &settings->scales, &lists->scales);
    if (!code) code = expand_texts(command, urdf, settings, &texts);
    if (!code) code = read_file(&texts, settings, &lists->packages, &lists->scales, robot);
    free((char *)texts.urdf.data);
    free((char *)texts.srdf.data);
    free_packages(&lists->packages);
    free(lists);
    return code;
}

int robot_settle(const cli_command *command, const robot_settings *settings) {
    if (settings->hull && settings->parts)
        return args_complain(command, "%s: --hull does not go with --parts", command->name);
    if (settings->free_base && settings->fixed_base)
        return args_complain(command, "%s: --free-base does not go with --fixed-base", command->name);
    if (settings->free_base && !settings->srdf)
        return args_complain(command, "%s: --free-base is of the virtual joint of an SRDF: --srdf FILE", command->name);
    return -1;
}

int robot_open(const cli_command *command, const char *urdf, const robot_settings *settings, cli_robot *robot) {
    int code = robot_open_beside(command, urdf, settings, robot);
    if (!code) warn_hulls(robot, settings);
    return code;
}

void robot_close(cli_robot *robot) {
    ovoid_robot_destroy(robot->robot);
    ovoid_robot_file_destroy(robot->file);
    *robot = (cli_robot){NULL, NULL, 0};
}

const char *robot_get_component(const ovoid_robot_joint *joint, uint32_t component) {
    static const char *const planar[] = {" x", " y", " angle"};
    static const char *const floating[] = {" x", " y", " z", " qw", " qx", " qy", " qz"};
    if (joint->type == OVOID_JOINT_PLANAR) return planar[component];
    return joint->type == OVOID_JOINT_FLOATING ? floating[component] : "";
}
