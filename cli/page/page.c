// The frame of a page: template, head, notes about omissions, rest of the template.
#include "page/page.h"

#include "base/finish.h"
#include "base/members.h"
#include "base/message.h"
#include "page/write.h"

#include <ovoid/ovoid.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

/// The version of the data's format.
#define FORMAT 1

// ---- the command line

static const char **words;
static int word_count;

void page_keep_words(int argc, char **argv) {
    words = malloc(((size_t)argc + 1) * sizeof *words);
    if (!words) return;
    for (word_count = 0; word_count < argc; word_count++) words[word_count] = argv[word_count];
}

/// 1 if a shell needs no quotes for the word.
static int is_plain(const char *word) {
    static const char plain[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+=./,:@%";
    return *word && !word[strspn(word, plain)];
}

/// Writes a word with the quotes that a shell needs.
static void write_word(FILE *file, const char *word) {
    if (is_plain(word)) {
        fputs(word, file);
        return;
    }
    fputc('\'', file);
    for (; *word; word++) *word == '\'' ? fputs("'\\''", file) : fputc(*word, file);
    fputc('\'', file);
}

/// The command line, "ovoid check scene.json"; NULL if memory runs out.
static char *make_command(void) {
    char *text = NULL;
    size_t size;
    FILE *file = words ? open_memstream(&text, &size) : NULL;
    if (!file) return NULL;
    fputs("ovoid", file);
    for (int i = 1; i < word_count; i++) {
        fputc(' ', file);
        write_word(file, words[i]);
    }
    if (fclose(file) == 0) return text;
    free(text);
    return NULL;
}

// ---- the page

int page_settle(const cli_command *command, const char *path, shard_part part) {
    if (path && strcmp(path, "-") == 0) return args_complain(command, "%s: --html needs a file", command->name);
    if (path && part.count)
        return args_complain(command, "%s: --html is of everything, --shard of a part of it", command->name);
    return -1;
}

int page_open(cli_page *page, const char *path) {
    *page = (cli_page){.path = path};
    return path ? page_template_read(&page->template) : 0;
}

static const char *get_base(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash && slash[1] ? slash + 1 : path;
}

/// Writes the title; two file names are separated by a comma.
static void write_title(FILE *file, const page_head *head) {
    char title[1024];
    snprintf(title, sizeof title, "%s%s%s", get_base(head->title), head->other ? ", " : "",
             head->other ? get_base(head->other) : "");
    fputs(",\"title\":", file);
    page_write_text(file, title);
}

static void write_head(FILE *file, const page_head *head, const char *command) {
    fprintf(file, "<script id=\"ovoid-data\" type=\"application/json\">{\"format\":%d,\"version\":\"%s\"", FORMAT,
            ovoid_get_version());
    write_title(file, head);
    fputs(",\"command\":", file);
    page_write_text(file, command);
    fputs(",\"unit\":", file);
    if (*head->unit)
        page_write_text(file, head->unit);
    else
        fputs("null", file);
    member_write_number(file, ",", "margin", head->margin >= 0 ? head->margin : NAN);
}

int page_begin(cli_page *page, const page_head *head) {
    char *command = make_command();
    if (!command) return message_error("out of memory"), EXIT_INPUT;
    page->output = finish_open(page->path);
    if (page->output) {
        page->file = ovoid_output_get_file(page->output);
        fwrite(page->template.text, 1, page->template.mark, page->file);
        write_head(page->file, head, command);
    }
    free(command);
    return page->output ? 0 : EXIT_INPUT;
}

/// Counts of what was left out, by the keys of the data, with the words for people.
typedef struct left_item {
    const char *key;
    size_t count;
} left_item;

enum { LEFT_ITEMS = 8 };

static void list_left_out(const page_left_out *left, left_item items[LEFT_ITEMS]) {
    const left_item all[LEFT_ITEMS] = {{"pairs", left->pairs},   {"bodies", left->bodies}, {"meshes", left->meshes},
                                       {"proofs", left->proofs}, {"frames", left->frames}, {"events", left->events},
                                       {"states", left->states}, {"steps", left->steps}};
    memcpy(items, all, sizeof all);
}

/// Writes the counts that are not 0, and returns how many there are.
static int write_left_out(FILE *file, const page_left_out *left) {
    left_item items[LEFT_ITEMS];
    int count = 0;
    list_left_out(left, items);
    for (int i = 0; i < LEFT_ITEMS; i++)
        if (items[i].count)
            fprintf(file, "%s\"%s\":%zu", count++ ? "," : ",\"left_out\":{", items[i].key, items[i].count);
    if (count) fputc('}', file);
    return count;
}

static void say_left_out(const page_left_out *left) {
    left_item items[LEFT_ITEMS];
    char text[300] = "";
    size_t length = 0;
    list_left_out(left, items);
    for (int i = 0; i < LEFT_ITEMS; i++)
        if (items[i].count)
            length += (size_t)snprintf(text + length, sizeof text - length, "%s%s: %zu", length ? ", " : "",
                                       items[i].key, items[i].count);
    message_note("the page leaves out what is too much for a browser, the farthest first: %s", text);
}

int page_end(cli_page *page, int code) {
    if (code) return code;
    const page_template *t = &page->template;
    const size_t after = t->mark + sizeof PAGE_MARK - 1;
    int is_short = write_left_out(page->file, &page->left_out);
    fputs("}</script>", page->file);
    fwrite(t->text + after, 1, t->size - after, page->file);
    code = finish_output(page->output);
    if (!code && is_short) say_left_out(&page->left_out);
    return code;
}

void page_close(cli_page *page) {
    if (page->output) {
        ovoid_output_close(page->output);
        finish_set_unfinished(NULL);
    }
    page_template_clear(&page->template);
    *page = (cli_page){.path = NULL};
}
