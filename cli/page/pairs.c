// Answers are lines of JSON, as in results, without their members "a" and "b": the page has numbers of bodies instead.
#include "page/pairs.h"

#include "base/inputs.h"
#include "base/message.h"
#include "page/write.h"

#include <stdlib.h>
#include <string.h>

/// The number of pairs that are answered before they are written.
#define BLOCK 1024

/// The largest number of bytes of the proofs of a page.
#define PROOF_BYTES_MOST 20000000u

/// The settings of lines of JSON.
static const output_settings as_json = {.json = 1};

/// The end of the member of an object that begins at `at`: the comma or the brace behind it.
static const char *find_end(const char *at, const char *end) {
    int depth = 0, is_quoted = 0;
    for (; at < end; at++) {
        if (is_quoted) {
            if (*at == '\\')
                at++;
            else
                is_quoted = *at != '"';
        } else if (*at == '"') {
            is_quoted = 1;
        } else if (!depth && (*at == ',' || *at == '}')) {
            return at;
        } else {
            depth += (*at == '{' || *at == '[') - (*at == '}' || *at == ']');
        }
    }
    return at;
}

static int begins_with(const char *member, const char *end, const char *key) {
    return (size_t)(end - member) > strlen(key) && memcmp(member, key, strlen(key)) == 0;
}

static int is_name(const char *member, const char *end) {
    return begins_with(member, end, "\"a\":") || begins_with(member, end, "\"b\":");
}

/// 1 if the member is a proof for which there is no room.
static int is_left_out(page_pairs *list, const char *member, const char *end) {
    if (!begins_with(member, end, "\"proof\":")) return 0;
    list->proof_bytes += (size_t)(end - member);
    if (list->proof_bytes <= PROOF_BYTES_MOST) return 0;
    list->page->left_out.proofs++;
    return 1;
}

/// Writes an object without its members "a" and "b", and without a proof that is left out.
static void write_answer(page_pairs *list, const char *line, const char *end) {
    const char *before = "{";
    for (const char *member = line + 1, *next; member < end && *member != '}'; member = next + (*next == ',')) {
        next = find_end(member, end);
        if (next == end) break;
        if (is_name(member, next) || is_left_out(list, member, next)) continue;
        fputs(before, list->file);
        page_copy_json(list->file, member, (size_t)(next - member));
        before = ",";
    }
    fputc('}', list->file);
}

static void write_pair(page_pairs *l, ovoid_couple couple, const char *line, const char *end) {
    fprintf(l->file, "%s{\"a\":%lu,\"b\":%lu", l->count++ ? "," : "", (unsigned long)l->numbers[couple.a],
            (unsigned long)l->numbers[couple.b]);
    if (l->frame != PAGE_NO_FRAME) fprintf(l->file, ",\"frame\":%zu", l->frame);
    fputs(",\"answer\":", l->file);
    write_answer(l, line, end);
    fputc('}', l->file);
}

page_pairs page_pairs_begin(cli_page *page, const page_choice *choice) {
    fputs(",\"pairs\":[", page->file);
    return (page_pairs){page, page->file, choice->numbers, 0, PAGE_NO_FRAME, 0};
}

void page_pairs_end(page_pairs *list) { fputc(']', list->file); }

/// Answers a block of pairs: a line for each of them. 0, or an exit code after a message.
static int answer(const answers_job *job, char **text, size_t *size) {
    unsigned fields = OVOID_RECORD_PARTS | (job->margin >= 0 ? OVOID_RECORD_MARGIN : 0) |
                      (job->contacts ? OVOID_RECORD_CONTACTS : 0) | inputs_get_fields(job->scene);
    FILE *file = open_memstream(text, size);
    if (!file) return message_error("out of memory"), EXIT_INPUT;
    cli_results results = {.file = file, .settings = &as_json, .unit = "", .fields = fields};
    answers_job block = *job;
    block.results = &results;
    block.take = NULL;
    int code = answers_run(&block);
    if (fclose(file) == 0) return code;
    return message_error("out of memory"), EXIT_INPUT;
}

int page_pairs_add(page_pairs *list, const answers_job *job, const page_pair *pairs, size_t count) {
    int code = 0;
    for (size_t first = 0; first < count && !code; first += BLOCK) {
        char *text = NULL;
        size_t size = 0;
        answers_job block = *job;
        block.couples = &pairs[first].couple;
        block.stride = sizeof *pairs;
        block.count = count - first < BLOCK ? count - first : BLOCK;
        code = answer(&block, &text, &size);
        const char *line = text;
        for (size_t i = 0; i < block.count && !code; i++) {
            const char *end = line + strcspn(line, "\n");
            write_pair(list, pairs[first + i].couple, line, end);
            line = end + (*end == '\n');
        }
        free(text);
    }
    return code;
}

int page_pairs_add_record(page_pairs *list, ovoid_couple couple, const ovoid_record *record) {
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    int is_written = file && results_write_line(file, &as_json, record), code = EXIT_INPUT;
    if (!file || fclose(file) != 0)
        message_error("out of memory");
    else if (!is_written)
        results_report_long(record->a ? record->a : "a", record->b ? record->b : "b");
    else
        write_pair(list, couple, text, text + size), code = 0;
    free(text);
    return code;
}
