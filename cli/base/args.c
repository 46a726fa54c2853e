// Parsing of the command line by a command's table of options. GNU habits: options and operands in any order, "--"
// ends the options, "--name value" and "--name=value", unambiguous beginnings of names, "-ofile".
#include "base/args.h"

#include "base/help.h"
#include "base/message.h"

#include <ovoid/ovoid.h>

#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/// The largest number of words among which a suggestion is searched.
#define WORDS_MAX 64

int args_complain(const cli_command *command, const char *format, ...) {
    char text[512];
    va_list list;
    va_start(list, format);
    vsnprintf(text, sizeof text, format, list);
    va_end(list);
    message_error("%s", text);
    if (command)
        fprintf(stderr, "Help: ovoid %s --help\n", command->name);
    else
        fprintf(stderr, "Help: ovoid --help\n");
    return EXIT_USAGE;
}

/// Edit distance with swaps of neighbours (V. I. Levenshtein 1966; F. J. Damerau 1964), of words below 32 letters.
static size_t compute_edits(const char *a, const char *b) {
    size_t n = strlen(a), m = strlen(b), d[33][33];
    if (n > 32 || m > 32) return 99;
    for (size_t i = 0; i <= n; i++) d[i][0] = i;
    for (size_t j = 0; j <= m; j++) d[0][j] = j;
    for (size_t i = 1; i <= n; i++)
        for (size_t j = 1; j <= m; j++) {
            size_t best = d[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            if (d[i - 1][j] + 1 < best) best = d[i - 1][j] + 1;
            if (d[i][j - 1] + 1 < best) best = d[i][j - 1] + 1;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && d[i - 2][j - 2] + 1 < best)
                best = d[i - 2][j - 2] + 1;
            d[i][j] = best;
        }
    return d[n][m];
}

const char *args_find_similar(const char *word, const char *const *words, size_t count) {
    const char *found = NULL;
    size_t length = strlen(word), most = length < 4 ? 1 : 2, best = most + 1;
    // A prefix of a word means that word.
    for (size_t i = 0; i < count && length > 1; i++)
        if (strncmp(words[i], word, length) == 0) return words[i];
    for (size_t i = 0; i < count; i++) {
        size_t edits = compute_edits(word, words[i]);
        if (edits < best) best = edits, found = words[i];
    }
    return found;
}

/// The option whose name is `name`, or begins with it and is the only one that does; NULL if none or several.
static const cli_option *find_by_name(const cli_command *command, const char *name, size_t length) {
    const cli_option *found = NULL;
    for (const cli_option *o = command->options; o->name; o++) {
        if (strncmp(o->name, name, length) != 0) continue;
        if (!o->name[length]) return o;
        if (found) return NULL;
        found = o;
    }
    return found;
}

static const cli_option *find_by_letter(const cli_command *command, char letter) {
    for (const cli_option *o = command->options; o->name; o++)
        if (o->letter == letter) return o;
    return NULL;
}

/// Reports an unknown option and suggests the nearest known one.
static int complain_unknown(const cli_command *command, const char *given, const char *name, size_t length) {
    const char *words[WORDS_MAX];
    size_t count = 0;
    words[count++] = "help";
    for (const cli_option *o = command->options; o->name && count < WORDS_MAX; o++) words[count++] = o->name;
    char word[64];
    snprintf(word, sizeof word, "%.*s", (int)(length < 63 ? length : 63), name);
    const char *similar = args_find_similar(word, words, count);
    if (strcmp(word, "html") == 0)
        return args_complain(command,
                             "%s: unknown option %s; \"ovoid view\" makes pages and pictures of bodies and scenes",
                             command->name, given);
    if (similar)
        return args_complain(command, "%s: unknown option %s; did you mean --%s?", command->name, given, similar);
    return args_complain(command, "%s: unknown option %s", command->name, given);
}

int args_parse_number(const char *text, double *value) {
    char *end;
    while (isspace((unsigned char)*text)) text++;
    if (!*text) return 0;
    *value = strtod(text, &end);
    while (isspace((unsigned char)*end)) end++;
    return !*end;
}

/// Parses numbers separated by spaces or commas, at most `most`; their count, or -1 if there are more or other text.
static int parse_numbers(const char *text, double *values, int most) {
    for (int count = 0;; count++) {
        while (isspace((unsigned char)*text) || *text == ',') text++;
        if (!*text) return count;
        if (count == most) return -1;
        char *end;
        values[count] = strtod(text, &end);
        if (end == text || (*end && !isspace((unsigned char)*end) && *end != ',')) return -1;
        text = end;
    }
}

/// The index of a word of that length in "one|two|three", or -1.
static int find_choice(const char *choices, const char *word, size_t length) {
    for (int place = 0; choices; place++) {
        const char *bar = strchr(choices, '|');
        size_t size = bar ? (size_t)(bar - choices) : strlen(choices);
        if (size == length && strncmp(choices, word, size) == 0) return place;
        choices = bar ? bar + 1 : NULL;
    }
    return -1;
}

int args_parse_pose(const char *text, ovoid_pose *pose) {
    static const double degree = 0.017453292519943295;
    double v[7], angles[3];
    size_t head = strcspn(text, "rd");
    if (!text[head]) {
        int count = parse_numbers(text, v, 7);
        if (count == 3) v[3] = 1, v[4] = v[5] = v[6] = 0;
        *pose = (ovoid_pose){{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
        return count == 3 || count == 7;
    }
    char position[256];
    int is_degrees = strncmp(text + head, "deg", 3) == 0;
    if (head >= sizeof position || (!is_degrees && strncmp(text + head, "rpy", 3) != 0)) return 0;
    memcpy(position, text, head);
    position[head] = 0;
    if (parse_numbers(position, v, 3) != 3 || parse_numbers(text + head + 3, angles, 3) != 3) return 0;
    double unit = is_degrees ? degree : 1;
    *pose = ovoid_pose_make_rpy((ovoid_vec3){v[0], v[1], v[2]},
                                (ovoid_vec3){unit * angles[0], unit * angles[1], unit * angles[2]});
    return 1;
}

int args_is_origin(const ovoid_pose *pose) {
    ovoid_vec3 p = pose->position;
    return p.x == 0 && p.y == 0 && p.z == 0 && pose->rotation.w == 1;
}

static int set_pose(const cli_command *command, const cli_option *o, const char *text, ovoid_pose *pose) {
    if (!args_parse_pose(text, pose))
        return args_complain(
            command,
            "%s: --%s needs a pose in one argument: \"0 0 1.5\", a position; \"0 0 1.5 1 0 0 0\", with "
            "a quaternion w x y z; \"0 0 1.5 rpy 0 0 0.5\" or \"0 0 1.5 deg 0 0 30\", with roll, pitch "
            "and yaw; got \"%s\"",
            command->name, o->name, text);
    ovoid_code code = ovoid_pose_validate(pose);
    if (code == OVOID_OK) return -1;
    char why[80] = "NaN or infinity";
    if (code == OVOID_ERROR_ROTATION)
        snprintf(why, sizeof why, "the quaternion is zero; that of no rotation is 1 0 0 0");
    if (code == OVOID_ERROR_RANGE) snprintf(why, sizeof why, "a position above %g", OVOID_LENGTH_MAX);
    return args_complain(command, "%s: --%s \"%s\": %s", command->name, o->name, text, why);
}

static int set_length(const cli_command *command, const cli_option *o, const char *text, double *value) {
    int is_share = o->kind == OPTION_SHARE, has_zero = o->kind == OPTION_LENGTH;
    double most = is_share ? 1 : OVOID_LENGTH_MAX;
    int is_good = args_parse_number(text, value) && *value >= 0 && *value <= most && (has_zero || *value > 0);
    if (is_good && !(is_share && *value == 1)) return -1;
    return args_complain(command, "%s: --%s needs a number %s 0 %s %g, got \"%s\"", command->name, o->name,
                         has_zero ? "from" : "above",
                         is_share   ? "and below"
                         : has_zero ? "to"
                                    : "and at most",
                         most, text);
}

static int set_count(const cli_command *command, const cli_option *o, const char *text, unsigned *value) {
    char *end;
    errno = 0;
    long number = strtol(text, &end, 10);
    int least = o->kind == OPTION_COUNT;
    if (end == text || *end || errno || number < least || number > 1000000000)
        return args_complain(command, "%s: --%s needs a whole number from %d up, got \"%s\"", command->name, o->name,
                             least, text);
    *value = (unsigned)number;
    return -1;
}

static int set_choice(const cli_command *command, const cli_option *o, const char *text, int *value) {
    *value = find_choice(o->choices, text, strlen(text));
    if (*value < 0)
        return args_complain(command, "%s: --%s is one of %s, not \"%s\"", command->name, o->name, o->choices, text);
    return -1;
}

static int set_set(const cli_command *command, const cli_option *o, const char *text, unsigned *bits) {
    *bits = 0;
    for (const char *word = text;;) {
        size_t length = strcspn(word, ",");
        int place = find_choice(o->choices, word, length);
        if (place < 0)
            return args_complain(command, "%s: --%s is a list of %s, with commas between; got \"%s\"", command->name,
                                 o->name, o->choices, text);
        *bits |= 1u << place;
        if (!word[length]) return -1;
        word += length + 1;
    }
}

static int add_to_list(const cli_command *command, const cli_option *o, const char *text, args_list *list) {
    if (list->count == ARGS_LIST_MAX)
        return args_complain(command, "%s: --%s is there more than %d times", command->name, o->name, ARGS_LIST_MAX);
    list->items[list->count++] = text;
    return -1;
}

static int set_vector(const cli_command *command, const cli_option *o, const char *text, ovoid_vec3 *value) {
    double v[3];
    int finite = parse_numbers(text, v, 3) == 3 && isfinite(v[0]) && isfinite(v[1]) && isfinite(v[2]);
    if (!finite || (v[0] == 0 && v[1] == 0 && v[2] == 0))
        return args_complain(command, "%s: --%s needs three numbers in one argument, not all zero; got \"%s\"",
                             command->name, o->name, text);
    *value = (ovoid_vec3){v[0], v[1], v[2]};
    return -1;
}

static int set_part(const cli_command *command, const cli_option *o, const char *text, shard_part *part) {
    char *slash, *end;
    long long index = strtoll(text, &slash, 10);
    long long count = *slash == '/' ? strtoll(slash + 1, &end, 10) : 0;
    int is_good = *slash == '/' && end > slash + 1 && !*end && isdigit((unsigned char)slash[1]) && index >= 1;
    if (!is_good || index > count || count > SHARD_PARTS_MAX)
        return args_complain(command,
                             "%s: --%s needs I/N, part I of N, with I from 1 to N and N at most %d; got \"%s\"",
                             command->name, o->name, SHARD_PARTS_MAX, text);
    *part = (shard_part){(unsigned)index, (unsigned)count};
    return -1;
}

/// Stores one option's value. -1 to continue, or an exit code.
static int set_value(const cli_command *command, const cli_option *o, const char *text, void *settings) {
    void *place = (char *)settings + o->offset;
    switch (o->kind) {
    case OPTION_FLAG: *(int *)place = 1; return -1;
    case OPTION_LENGTH:
    case OPTION_POSITIVE:
    case OPTION_SHARE: return set_length(command, o, text, place);
    case OPTION_COUNT:
    case OPTION_AMOUNT: return set_count(command, o, text, place);
    case OPTION_CHOICE: return set_choice(command, o, text, place);
    case OPTION_SET: return set_set(command, o, text, place);
    case OPTION_VECTOR: return set_vector(command, o, text, place);
    case OPTION_POSE: return set_pose(command, o, text, place);
    case OPTION_PART: return set_part(command, o, text, place);
    case OPTION_LIST: return add_to_list(command, o, text, place);
    case OPTION_TEXT:
    case OPTION_FILE:
    case OPTION_OUTPUT: break;
    }
    if (!*text) return args_complain(command, "%s: --%s needs a path, got nothing", command->name, o->name);
    *(const char **)place = text;
    return -1;
}

/// The position of the parser.
typedef struct cursor {
    int argc, next;
    char **argv;
} cursor;

/// Stores an option's value: the text after "=" or the letter, else the next argument.
static int take_value(const cli_command *command, const cli_option *o, const char *attached, cursor *at,
                      void *settings) {
    if (o->kind == OPTION_FLAG) {
        if (attached) return args_complain(command, "%s: --%s takes no value", command->name, o->name);
        return set_value(command, o, NULL, settings);
    }
    if (attached) return set_value(command, o, attached, settings);
    if (at->next >= at->argc)
        return args_complain(command, "%s: --%s needs a value: %s", command->name, o->name, o->value);
    return set_value(command, o, at->argv[at->next++], settings);
}

/// Parses "--name" or "--name=value".
static int parse_long(const cli_command *command, const char *given, cursor *at, void *settings) {
    const char *name = given + 2, *equals = strchr(name, '=');
    size_t length = equals ? (size_t)(equals - name) : strlen(name);
    const cli_option *o = find_by_name(command, name, length);
    if (!o && length && strncmp("help", name, length) == 0) return help_print_command(stdout, command);
    if (!o) return complain_unknown(command, given, name, length);
    return take_value(command, o, equals ? equals + 1 : NULL, at, settings);
}

/// Parses "-o value" or "-ovalue"; one letter an argument.
static int parse_short(const cli_command *command, const char *given, cursor *at, void *settings) {
    if (given[1] == 'h' && !given[2]) return help_print_command(stdout, command);
    const cli_option *o = find_by_letter(command, given[1]);
    if (!o) return complain_unknown(command, given, given + 1, strlen(given + 1));
    return take_value(command, o, given[2] ? given + 2 : NULL, at, settings);
}

/// Reports a missing operand: word `place` of the usage's operands.
static int complain_missing(const cli_command *command, int place) {
    int line = (int)strcspn(command->usage, "\n");
    const char *word = command->usage + strcspn(command->usage, "]") + 1;
    for (int i = 0; i < place; i++) word += strspn(word, " ") + strcspn(word + strspn(word, " "), " \n");
    word += strspn(word, " ");
    int length = (int)strcspn(word, " \n");
    if (length > 3 && strncmp(word + length - 3, "...", 3) == 0) length -= 3;
    return args_complain(command, "%s: %.*s is missing. Usage: ovoid %s %.*s", command->name, length, word,
                         command->name, line, command->usage);
}

/// Reports too few operands or too many; -1 if their number is right.
static int validate_count(const cli_command *command, const cli_operands *operands) {
    if (operands->count < command->operands_min) return complain_missing(command, operands->count);
    if (command->operands_max >= 0 && operands->count > command->operands_max)
        return args_complain(command, "%s: one argument too many: %s%s", command->name,
                             operands->items[command->operands_max],
                             find_by_name(command, "states", 6) ? "; states are given by --states FILE" : "");
    return -1;
}

/// Refuses standard input in two places; -1 if it is used once at most.
static int validate_input(const cli_command *command, const void *settings, const cli_operands *operands) {
    int count = 0;
    for (int i = 0; i < operands->count; i++) count += strcmp(operands->items[i], "-") == 0;
    for (const cli_option *o = command->options; o->name; o++) {
        const char *path = o->kind == OPTION_FILE ? *(const char *const *)((const char *)settings + o->offset) : NULL;
        count += path && strcmp(path, "-") == 0;
    }
    if (count < 2) return -1;
    return args_complain(command, "%s: standard input, \"-\", can be read once only", command->name);
}

int args_parse(const cli_command *command, int argc, char **argv, void *settings, cli_operands *operands) {
    cursor at = {argc, 0, argv};
    int ended = 0, code = -1;
    *operands = (cli_operands){(const char **)argv, 0};
    while (at.next < argc && code < 0) {
        char *given = argv[at.next++];
        if (ended || given[0] != '-' || !given[1])
            argv[operands->count++] = given; // an operand, also a lone "-"
        else if (strcmp(given, "--") == 0)
            ended = 1;
        else if (given[1] == '-')
            code = parse_long(command, given, &at, settings);
        else
            code = parse_short(command, given, &at, settings);
    }
    if (code < 0) code = validate_count(command, operands);
    return code < 0 ? validate_input(command, settings, operands) : code;
}

const char *args_get_last_word(const cli_command *command) {
    const char *blank = strrchr(command->name, ' ');
    return blank ? blank + 1 : command->name;
}

const cli_command *args_find_subcommand(const cli_command *command, const char *name) {
    for (const cli_command *const *c = command->subcommands; c && *c; c++)
        if (strcmp(args_get_last_word(*c), name) == 0) return *c;
    return NULL;
}
