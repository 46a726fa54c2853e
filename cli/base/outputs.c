// The rules for output paths. Two paths are the same file if device and inode are equal, so neither a link nor a path
// through other folders hides an input.
#include "base/outputs.h"

#include <string.h>
#include <strings.h>
#include <sys/stat.h>

/// Extensions that name a format: an output with one of these must be in that format.
static const char *const known[] = {"stl",   "obj",    "off", "ply",   "dae",  "gltf", "glb",
                                    "3ds",   "x3d",    "fbx", "3mf",   "json", "csv",  "svg",
                                    "ovoid", "ovoids", "png", "jsonl", "pdf",  "jpg",  "html"};

int outputs_has_extension(const char *path, const char *word) {
    const char *dot = strrchr(path, '.');
    return dot && !strchr(dot, '/') && strcasecmp(dot + 1, word) == 0;
}

/// 1 if the extension is one of "one|two", or is not known.
static int is_allowed(const char *path, const char *formats) {
    for (const char *at = formats; *at;) {
        char word[16];
        size_t length = strcspn(at, "|");
        memcpy(word, at, length);
        word[length] = 0;
        if (outputs_has_extension(path, word)) return 1;
        at += length + (at[length] == '|');
    }
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (outputs_has_extension(path, known[i])) return 0;
    return 1;
}

int outputs_is_same_file(const char *a, const char *b) {
    struct stat one, two;
    if (strcmp(a, "-") == 0 || strcmp(b, "-") == 0) return 0;
    if (strcmp(a, b) == 0) return stat(a, &one) != 0 || S_ISREG(one.st_mode);
    return stat(a, &one) == 0 && stat(b, &two) == 0 && S_ISREG(one.st_mode) && one.st_dev == two.st_dev &&
           one.st_ino == two.st_ino;
}

static const char *get_path(const cli_option *o, const void *settings) {
    return *(const char *const *)((const char *)settings + o->offset);
}

static int validate_output(const cli_command *command, const cli_option *o, const void *settings,
                           const cli_operands *operands) {
    const char *path = get_path(o, settings);
    if (!is_allowed(path, o->choices))
        return args_complain(command, "%s: --%s %s: the output is %s; choose a name that says so", command->name,
                             o->name, path, o->choices);
    for (int i = 0; i < operands->count; i++)
        if (outputs_is_same_file(path, operands->items[i]))
            return args_complain(command, "%s: --%s %s would overwrite its own input; choose another name",
                                 command->name, o->name, path);
    for (const cli_option *other = command->options; other->name; other++) {
        if (other == o || (other->kind != OPTION_FILE && other->kind != OPTION_OUTPUT)) continue;
        const char *theirs = get_path(other, settings);
        if (theirs && outputs_is_same_file(path, theirs))
            return args_complain(command, "%s: --%s and --%s are one file, %s; choose another name", command->name,
                                 o->name, other->name, path);
    }
    return -1;
}

static int validate_outputs(const cli_command *command, const void *settings, const cli_operands *operands) {
    int code = -1;
    for (const cli_option *o = command->options; o->name && code < 0; o++)
        if (o->kind == OPTION_OUTPUT && get_path(o, settings)) code = validate_output(command, o, settings, operands);
    return code;
}

int command_parse(const cli_command *command, int argc, char **argv, void *settings, cli_operands *operands) {
    int code = args_parse(command, argc, argv, settings, operands);
    return code < 0 ? validate_outputs(command, settings, operands) : code;
}
