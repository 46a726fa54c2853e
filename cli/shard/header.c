// Options that change what is answered are in the header as they are on a command line, all of them, so that defaults
// of other versions would show; paths of inputs are not: their content is in the digest.
#include "shard/header.h"

#include "base/message.h"

#include <ovoid/ovoid.h>

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/// 1 for what changes no answer: how many threads, and where results go.
static int is_free(const cli_option *o) {
    return o->kind == OPTION_OUTPUT || o->kind == OPTION_PART || strcmp(o->name, "threads") == 0;
}

static void write_list(FILE *file, const cli_option *o, const args_list *list) {
    for (int i = 0; i < list->count; i++) fprintf(file, " --%s=%s", o->name, list->items[i]);
}

static void write_numbers(FILE *file, const double *numbers, int count) {
    for (int i = 0; i < count; i++) fprintf(file, "%s%.17g", i ? "," : "", numbers[i]);
}

/// " --name=value", numbers so that they can be told apart.
static void write_option(FILE *file, const cli_option *o, const void *settings) {
    const char *place = (const char *)settings + o->offset;
    if (o->kind == OPTION_LIST) {
        write_list(file, o, (const args_list *)(const void *)place);
        return;
    }
    fprintf(file, " --%s=", o->name);
    switch (o->kind) {
    case OPTION_FLAG:
    case OPTION_CHOICE: fprintf(file, "%d", *(const int *)(const void *)place); break;
    case OPTION_COUNT:
    case OPTION_AMOUNT:
    case OPTION_SET: fprintf(file, "%u", *(const unsigned *)(const void *)place); break;
    case OPTION_LENGTH:
    case OPTION_POSITIVE:
    case OPTION_SHARE: write_numbers(file, (const double *)(const void *)place, 1); break;
    case OPTION_VECTOR: write_numbers(file, (const double *)(const void *)place, 3); break;
    case OPTION_POSE: write_numbers(file, (const double *)(const void *)place, 7); break;
    default: break;
    }
}

/// Adds the files that options and operands name. 0, or EXIT_INPUT after a message.
static int add_files(shard_digest *d, const shard_job *job) {
    int code = 0;
    for (const cli_option *o = job->command->options; o->name && !code; o++) {
        if (o->kind != OPTION_FILE) continue;
        const char *path = *(const char *const *)(const void *)((const char *)job->settings + o->offset);
        if (!path) continue;
        shard_digest_add(d, o->name, strlen(o->name) + 1);
        code = shard_digest_add_file(d, path);
    }
    for (int i = 0; i < job->operands->count && !code; i++) code = shard_digest_add_file(d, job->operands->items[i]);
    return code;
}

static void write_options(FILE *file, const shard_job *job) {
    fputs(shard_header_get_word(SHARD_OPTIONS), file);
    for (const cli_option *o = job->command->options; o->name; o++)
        if (o->kind != OPTION_FILE && !is_free(o)) write_option(file, o, job->settings);
    fputc('\n', file);
}

/// 1 if no line is longer than one that is read.
static int is_readable(const char *text, size_t size) {
    size_t length = 0;
    for (size_t i = 0; i < size; i++) {
        length = text[i] == '\n' ? 0 : length + 1;
        if (length >= SHARD_LINE_MAX) return 0;
    }
    return 1;
}

char *shard_header_make(const shard_job *job, const char *head, size_t head_size, size_t *size) {
    shard_digest inputs = job->seen;
    char *text = NULL;
    if (add_files(&inputs, job)) return NULL;
    FILE *file = open_memstream(&text, size);
    if (!file) return message_error("out of memory"), NULL;
    fprintf(file, "%s\n%s %s\n%s %s\n%s %s\n", SHARD_MAGIC, shard_header_get_word(SHARD_TOOL), ovoid_get_version(),
            shard_header_get_word(SHARD_COMMAND), job->command->name, shard_header_get_word(SHARD_FORMAT),
            job->is_json ? "json" : "csv");
    write_options(file, job);
    fprintf(file, "%s %016" PRIx64 "\n%s %" PRIu64 "\n%s %u/%u\nhead %zu\n", shard_header_get_word(SHARD_INPUTS),
            shard_digest_get(&inputs), shard_header_get_word(SHARD_MOST), job->most, shard_header_get_word(SHARD_PART),
            job->part.index, job->part.count, head_size);
    fflush(file);
    int good = !ferror(file) && is_readable(text, *size);
    if (head_size) fwrite(head, 1, head_size, file);
    if (fclose(file) == 0 && good) return text;
    message_error("%s", good ? "out of memory" : "the options are too long for the header of a shard");
    free(text);
    return NULL;
}

/// What a field says, for people.
static const char *get_meaning(int field) {
    static const char *const meanings[SHARD_FIELDS] = {"of ovoid",
                                                       "of the command",
                                                       "in the format",
                                                       "with the options",
                                                       "of inputs with the digest",
                                                       "with the limit",
                                                       "part"};
    return meanings[field];
}

/// The first option of one line that is not the same in the other, " --name=value".
static const char *find_difference(const char *a, const char *b, int *length) {
    size_t same = 0, begin = 0;
    for (; a[same] && a[same] == b[same]; same++)
        if (a[same] == ' ') begin = same + 1;
    *length = (int)strcspn(a + begin, " ");
    return a + begin;
}

int shard_header_differs(const char *path, const shard_header *h, const char *other, const shard_header *first) {
    for (int i = 0; i < SHARD_FIELDS; i++) {
        const char *a = h->fields[i], *b = first->fields[i];
        if (i == SHARD_PART || strcmp(a, b) == 0) continue;
        int lengths[2] = {(int)strlen(a), (int)strlen(b)};
        if (i == SHARD_OPTIONS) {
            const char *whole = a;
            a = find_difference(a, b, &lengths[0]);
            b = find_difference(b, whole, &lengths[1]);
        }
        message_error("%s: is %s %.*s, and %s %.*s: they are not of one run", path, get_meaning(i), lengths[0], a,
                      other, lengths[1], b);
        return 1;
    }
    if (h->head_size == first->head_size && memcmp(h->head, first->head, h->head_size) == 0) return 0;
    message_error("%s: has other columns than %s: they are not of one run", path, other);
    return 1;
}
