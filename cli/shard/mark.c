// The layout. Options that change what is answered are in the header as they are on a command line, all of them, so
// that defaults of other versions would show; paths of inputs are not: their content is in the digest.
#define _FILE_OFFSET_BITS 64
#include "shard/mark.h"

#include "base/lines.h"
#include "base/message.h"
#include "tools/array.h"

#include <ovoid/ovoid.h>

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/// The first line.
#define MAGIC "ovoid shard 3\n"

/// The word before a field in its line, and what the field says, for people.
static const struct {
    const char *word, *meaning;
} lines[SHARD_FIELDS] = {{"tool", "of ovoid"},
                         {"command", "of the command"},
                         {"format", "in the format"},
                         {"options", "with the options"},
                         {"inputs", "of inputs with the digest"},
                         {"most", "with the limit"},
                         {"part", "part"},
                         {"objects", "with a number of objects of"}};

char *shard_get_mark_path(const char *path) {
    size_t size = strlen(path) + sizeof ".mark";
    char *made = malloc(size);
    if (made) snprintf(made, size, "%s.mark", path);
    return made;
}

/* ---- how far the work has come */

exit_code shard_progress_get_exit(const shard_progress *p) {
    if (p->sides[EXIT_NOT_PROVEN]) return EXIT_NOT_PROVEN;
    return p->sides[EXIT_TOUCH] ? EXIT_TOUCH : EXIT_APART;
}

void shard_progress_write(char line[SHARD_LINE_SIZE], const shard_progress *p, const shard_digest *digest) {
    shard_digest all = *digest;
    int length = snprintf(line, SHARD_LINE_SIZE,
                          "%s: %" PRIu64 " bytes, %" PRIu64 " units; apart: %" PRIu64 ", near: %" PRIu64
                          ", not proven: %" PRIu64 "; digest ",
                          p->is_done ? "done" : "kept", p->bytes, p->units, p->sides[EXIT_APART], p->sides[EXIT_TOUCH],
                          p->sides[EXIT_NOT_PROVEN]);
    shard_digest_add(&all, line, (size_t)length);
    snprintf(line + length, (size_t)(SHARD_LINE_SIZE - length), "%016" PRIx64 "\n", shard_digest_get(&all));
}

static int read_progress(const char *line, shard_progress *p) {
    *p = (shard_progress){.is_done = strncmp(line, "done", 4) == 0};
    return sscanf(line,
                  "%*s %" SCNu64 " bytes, %" SCNu64 " units; apart: %" SCNu64 ", near: %" SCNu64
                  ", not proven: %" SCNu64 ";",
                  &p->bytes, &p->units, &p->sides[EXIT_APART], &p->sides[EXIT_TOUCH], &p->sides[EXIT_NOT_PROVEN]) == 5;
}

static int is_at_end(FILE *file) {
    int c = getc(file);
    if (c != EOF) (void)ungetc(c, file);
    return c == EOF;
}

void shard_state_find(shard_state *state, FILE *mark, FILE *results) {
    char line[SHARD_LINE_SIZE], again[SHARD_LINE_SIZE];
    shard_state next = *state;
    while (!state->progress.is_done && fgets(line, sizeof line, mark) && read_progress(line, &next.progress)) {
        uint64_t from = state->progress.bytes, to = next.progress.bytes;
        if (to < from || !shard_digest_add_stream(&next.digest, results, to - from)) return;
        shard_progress_write(again, &next.progress, &next.digest);
        if (strcmp(line, again) != 0) return;
        if (next.progress.is_done && !(is_at_end(mark) && is_at_end(results))) return;
        next.mark_size = (int64_t)ftello(mark);
        *state = next;
    }
}

/* ---- a header is made */

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

static void write_fields(FILE *file, const shard_job *job, uint64_t inputs) {
    fprintf(file, MAGIC "%s %s\n%s %s\n%s %s\n%s", lines[SHARD_TOOL].word, ovoid_get_version(),
            lines[SHARD_COMMAND].word, job->command->name, lines[SHARD_FORMAT].word, job->is_json ? "json" : "csv",
            lines[SHARD_OPTIONS].word);
    for (const cli_option *o = job->command->options; o->name; o++)
        if (o->kind != OPTION_FILE && !is_free(o)) write_option(file, o, job->settings);
    size_t count = job->scene ? ovoid_scene_get_count(job->scene) : 0;
    fprintf(file, "\n%s %016" PRIx64 "\n%s %" PRIu64 "\n%s %u/%u\n%s %zu\n", lines[SHARD_INPUTS].word, inputs,
            lines[SHARD_MOST].word, job->most, lines[SHARD_PART].word, job->part.index, job->part.count,
            lines[SHARD_OBJECTS].word, count);
    for (size_t i = 0; i < count; i++) {
        const char *name = ovoid_scene_get(job->scene, i).name;
        (job->is_json ? ovoid_text_write_json : ovoid_text_write_csv)(file, name);
        fputc('\n', file);
    }
}

char *shard_header_make(const shard_job *job, size_t *size) {
    shard_digest inputs = job->seen;
    char *text = NULL;
    if (add_files(&inputs, job)) return NULL;
    FILE *file = open_memstream(&text, size);
    if (file) write_fields(file, job, shard_digest_get(&inputs));
    if (file && fclose(file) == 0) return text;
    message_error("out of memory");
    free(text);
    return NULL;
}

/* ---- a header is read */

/// The next line without its end, which the caller frees; NULL where there is none that has one.
static char *read_line(FILE *file, shard_header *h) {
    char *line = NULL;
    size_t room = 0;
    long length = lines_read(file, &line, &room);
    if (length <= 0 || line[length - 1] != '\n') return free(line), NULL;
    shard_digest_add(&h->digest, line, (size_t)length);
    line[length - 1] = 0;
    return line;
}

/// The text of a line behind "word ", in its place; NULL.
static char *take_value(char *line, const char *word) {
    size_t length = strlen(word);
    if (!line || strncmp(line, word, length) != 0) return free(line), NULL;
    size_t skipped = length + (line[length] == ' ');
    memmove(line, line + skipped, strlen(line + skipped) + 1);
    return line;
}

static int read_objects(FILE *file, shard_header *h) {
    size_t count = 0, room = 0;
    if (sscanf(h->fields[SHARD_OBJECTS], "%zu", &count) != 1 || count > UINT32_MAX) return 0;
    while (h->object_count < count) {
        if (!array_reserve((void **)&h->objects, &room, h->object_count, sizeof *h->objects)) return 0;
        char *name = read_line(file, h);
        if (!name) return 0;
        h->objects[h->object_count] = (shard_object){name, (uint32_t)h->object_count};
        h->object_count++;
    }
    return 1;
}

static int read_fields(FILE *file, shard_header *h) {
    char magic[sizeof MAGIC] = "";
    if (fread(magic, 1, sizeof MAGIC - 1, file) != sizeof MAGIC - 1 || strcmp(magic, MAGIC) != 0) return 0;
    shard_digest_add(&h->digest, MAGIC, sizeof MAGIC - 1);
    for (int i = 0; i < SHARD_FIELDS; i++)
        if (!(h->fields[i] = take_value(read_line(file, h), lines[i].word))) return 0;
    if (sscanf(h->fields[SHARD_MOST], "%" SCNu64, &h->most) != 1) return 0;
    if (sscanf(h->fields[SHARD_PART], "%u/%u", &h->part.index, &h->part.count) != 2) return 0;
    if (!h->part.index || h->part.index > h->part.count || h->part.count > SHARD_PARTS_MAX) return 0;
    return read_objects(file, h);
}

int shard_header_read(FILE *file, shard_header *h) {
    *h = (shard_header){.digest = shard_digest_make()};
    if (read_fields(file, h)) return 1;
    shard_header_clear(h);
    return 0;
}

void shard_objects_free(shard_object *objects, size_t count) {
    for (size_t i = 0; i < count; i++) free(objects[i].text);
    free(objects);
}

void shard_header_clear(shard_header *h) {
    for (int i = 0; i < SHARD_FIELDS; i++) free(h->fields[i]);
    shard_objects_free(h->objects, h->object_count);
    *h = (shard_header){.objects = NULL};
}

/* ---- two headers */

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
        message_error("%s: is %s %.*s, and %s %.*s: they are not of one run", path, lines[i].meaning, lengths[0], a,
                      other, lengths[1], b);
        return 1;
    }
    return 0;
}
