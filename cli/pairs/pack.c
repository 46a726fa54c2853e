// ovoid pack: a scene and its meshes in one file, which is read in a small part of the time.
#include "commands.h"

#include "base/inputs.h"
#include "base/message.h"
#include "base/outputs.h"

#include <ovoid/io.h>

typedef struct settings {
    const char *output;
    int hull;
} settings;

static const cli_option options[] = {
    INPUTS_HULL_OPTION(settings),
    {"output", 'o', OPTION_OUTPUT, offsetof(settings, output), "FILE.ovoids", "ovoids",
     "write to FILE.ovoids, which appears whole or not at all (required)"},
    {0},
};

static int run(const cli_command *command, int argc, char **argv) {
    settings s = {.output = NULL};
    cli_operands paths;
    ovoid_error error;
    int code = command_parse(command, argc, argv, &s, &paths);
    if (code >= 0) return code;
    if (!s.output) return args_complain(command, "pack: --output FILE.ovoids is missing");
    // Other commands tell a scene by its name.
    if (!outputs_has_extension(s.output, "ovoids"))
        return args_complain(command, "pack: --output %s: the output is ovoids; choose a name that says so", s.output);
    ovoid_scene *scene = inputs_read_scene(paths.items[0], s.hull);
    if (!scene) return EXIT_INPUT;
    inputs_warn_scene(scene);
    code = ovoid_scene_write(scene, s.output, &error) ? EXIT_INPUT : EXIT_APART;
    if (code) message_error("%s", error.message);
    if (!code)
        message_note("%zu objects, %zu hulls of meshes", ovoid_scene_get_count(scene),
                     ovoid_scene_get_mesh_count(scene));
    ovoid_scene_destroy(scene);
    return code;
}

const cli_command command_pack = {
    .name = "pack",
    .summary = "a scene and its meshes in one file, read in a small part of the time",
    .usage = "[OPTION...] SCENE.json -o SCENE.ovoids",
    .description =
        "Reads a scene as check does and writes all that was read: names, poses, pairs to ignore, the unit, and the "
        "bodies, with the hulls and triangles of meshes. Every command that takes SCENE.json takes SCENE.ovoids and "
        "gives the same results, to the byte. That is for scenes that are read often, as by the shards of a command: "
        "6000 objects of 20 meshes are read with a seventieth of the instructions.\n\n"
        "Meshes are as --hull says, or without it: where that matters, the other commands must say the same. They are "
        "not read again, except for the pictures of view and --html, which find them beside SCENE.ovoids. The file is "
        "of this version of the format and of this byte order; another one, or a damaged file, is refused.",
    .exits = "0 done\n"
             "2 the command line is wrong\n"
             "3 bad input, or output that could not be written",
    .examples = "ovoid pack cell.json -o cell.ovoids\n"
                "ovoid check cell.ovoids --margin 0.02 --json -o near.jsonl\n"
                "ovoid verify near.jsonl cell.ovoids",
    .options = options,
    .operands_min = 1,
    .operands_max = 1,
    .run = run,
};
