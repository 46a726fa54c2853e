// The parts of the page are built in memory and joined at the end; each file appears completely or not at all.
#include "paper/report.h"

#include "base/finish.h"

#include <errno.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// Text that grows.
typedef struct buffer {
    FILE *file; ///< into `text`
    char *text;
    size_t size;
} buffer;

struct report {
    char *folder;
    buffer page, verdicts, contents; ///< the sections; rows of the table; items of the list
    unsigned sections;
    size_t front;    ///< where the second section begins in the page
    ovoid_code code; ///< the first failure
    ovoid_error error;
};

struct report_table {
    report *report;
    char *name, *text;
    size_t size;
    FILE *rows; ///< into `text`
};

static const char head[] =
    "<!DOCTYPE html>\n"
    "<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\"><title>The "
    "paper's experiment, repeated</title>\n"
    "<style>\n"
    "body{font:16px/1.5 Georgia,serif;color:#222;max-width:760px;margin:2em auto;padding:0 1em}\n"
    "h1,h2,th,td,figcaption{font-family:Helvetica,Arial,sans-serif}\n"
    "h1{font-size:1.7em}h2{font-size:1.25em;margin-top:2.2em;border-bottom:1px solid #ccc}\n"
    "figure{margin:1.2em 0}svg{max-width:100%;height:auto}\n"
    "table{border-collapse:collapse;font-size:13px;margin:1em 0}"
    "td,th{padding:2px 9px;text-align:right;border-bottom:1px solid "
    "#ddd}td:first-child,th:first-child{text-align:left}\n"
    "dl{display:grid;grid-template-columns:7em 1fr;gap:.2em 1em;background:#f6f6f2;padding:.7em 1em;font-size:15px}\n"
    "dt{font-weight:bold}dd{margin:0}p.more{font-size:13px;color:#666;margin-top:-.6em}\n"
    "a{color:#0b5d8a}ol{columns:2 20em;padding-left:1.4em}table.wide{display:block;overflow-x:auto}\n"
    "table.verdicts td,table.verdicts th{text-align:left;vertical-align:top;padding:5px 9px}"
    "td.yes,td.part,td.no{font-weight:bold;white-space:nowrap}"
    "td.yes a{color:#1a7f37}td.part a{color:#9a6700}td.no a{color:#b42318}\n"
    "@media(max-width:600px){table.verdicts tr{display:block;padding:.5em 0;border-bottom:1px solid #ccc}"
    "table.verdicts th{display:none}table.verdicts td{display:block;border:0;padding:2px 0}"
    "table.verdicts td:nth-child(3)::before{content:\"measured: \"}"
    "table.verdicts td:nth-child(4)::before{content:\"ovoid: \"}}\n"
    "@media print{body{font-size:11px;max-width:none}h2,figure,dl,tr{break-inside:avoid}h2{break-after:avoid}}\n"
    "</style></head><body>\n";

// Records the first failure: what, where, why.
static void fail(report *r, ovoid_code code, const char *what, const char *why) {
    if (r->code) return;
    r->code = code;
    r->error = (ovoid_error){.code = code, .place = -1};
    snprintf(r->error.message, sizeof r->error.message, "%.120s: %.120s", what, why);
}

static void fail_memory(report *r) { fail(r, OVOID_ERROR_MEMORY, "the report", "out of memory"); }

static void open_buffer(report *r, buffer *b) {
    b->file = open_memstream(&b->text, &b->size);
    if (!b->file) fail_memory(r);
}

/// Closes a buffer; the report owns its text until report_finish frees it.
static void close_buffer(report *r, buffer *b) {
    if (b->file && fclose(b->file)) fail_memory(r);
    b->file = NULL;
}

report *report_create(const char *folder) {
    report *r = calloc(1, sizeof *r);
    if (!r) return NULL;
    r->folder = strdup(folder);
    if (!r->folder) fail_memory(r);
    open_buffer(r, &r->page);
    open_buffer(r, &r->verdicts);
    open_buffer(r, &r->contents);
    if (!r->code && mkdir(folder, 0777) && errno != EEXIST) fail(r, OVOID_ERROR_FILE, folder, strerror(errno));
    return r;
}

int report_is_good(const report *r) { return !r->code; }

// The path "FOLDER/NAME.EXTENSION", to be freed; NULL without memory.
static char *make_path(const report *r, const char *name, const char *extension) {
    size_t size = strlen(r->folder) + strlen(name) + strlen(extension) + 3;
    char *path = malloc(size);
    if (path) snprintf(path, size, "%s/%s.%s", r->folder, name, extension);
    return path;
}

static void write_escaped(FILE *file, const char *text, size_t length) {
    for (size_t i = 0; i < length; i++) switch (text[i]) {
        case '&': fputs("&amp;", file); break;
        case '<': fputs("&lt;", file); break;
        case '>': fputs("&gt;", file); break;
        default: fputc(text[i], file);
        }
}

void report_add_section(report *r, const char *title) {
    if (r->code) return;
    if (r->sections == 1) r->front = (size_t)ftell(r->page.file);
    if (r->sections++ == 0)
        fputs("<h1>", r->page.file);
    else {
        fprintf(r->page.file, "<h2 id=\"s%u\">", r->sections);
        fprintf(r->contents.file, "<li><a href=\"#s%u\">", r->sections);
        write_escaped(r->contents.file, title, strlen(title));
        fputs("</a></li>\n", r->contents.file);
    }
    write_escaped(r->page.file, title, strlen(title));
    fputs(r->sections == 1 ? "</h1>\n" : "</h2>\n", r->page.file);
}

void report_add_verdict(report *r, report_verdict verdict) {
    if (r->code) return;
    static const char *const names[][2] = {{"yes", "holds"}, {"part", "holds in part"}, {"no", "does not hold"}};
    FILE *rows = r->verdicts.file;
    fputs("<tr><td>", rows);
    write_escaped(rows, verdict.claim, strlen(verdict.claim));
    fprintf(rows, "</td><td class=\"%s\"><a href=\"#s%u\">%s</a></td><td>", names[verdict.holds][0], r->sections,
            names[verdict.holds][1]);
    write_escaped(rows, verdict.measured, strlen(verdict.measured));
    fputs("</td><td>", rows);
    write_escaped(rows, verdict.ours, strlen(verdict.ours));
    fputs("</td></tr>\n", rows);
}

void report_add_text(report *r, const char *format, ...) {
    if (r->code) return;
    va_list arguments;
    va_start(arguments, format);
    char text[4096];
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    for (const char *at = text; *at;) {
        const char *end = strstr(at, "\n\n");
        size_t length = end ? (size_t)(end - at) : strlen(at);
        fputs("<p>", r->page.file);
        write_escaped(r->page.file, at, length);
        fputs("</p>\n", r->page.file);
        at += length + (end ? 2 : 0);
    }
}

void report_add_finding(report *r, report_finding finding) {
    if (r->code) return;
    const char *const names[] = {"Paper", "Here", "Why"};
    const char *const texts[] = {finding.paper, finding.measured, finding.why};
    fputs("<dl>", r->page.file);
    for (int i = 0; i < 3; i++) {
        if (!texts[i]) continue;
        fprintf(r->page.file, "<dt>%s</dt><dd>", names[i]);
        write_escaped(r->page.file, texts[i], strlen(texts[i]));
        fputs("</dd>", r->page.file);
    }
    fputs("</dl>\n", r->page.file);
}

// Writes a file of the folder with that text.
static void write_file(report *r, const char *name, const char *extension, const char *text, size_t size) {
    char *path = make_path(r, name, extension);
    if (!path) {
        fail_memory(r);
        return;
    }
    ovoid_error error = {0};
    ovoid_output *output = ovoid_output_open(path, &error);
    finish_set_unfinished(output ? ovoid_output_get_temporary(output) : NULL);
    if (output) fwrite(text, 1, size, ovoid_output_get_file(output));
    if ((!output || ovoid_output_commit(output, &error)) && !r->code) {
        r->code = error.code;
        r->error = error;
    }
    finish_set_unfinished(NULL);
    ovoid_output_close(output);
    free(path);
}

void report_add_chart(report *r, const char *name, const ovoid_chart *chart) {
    if (r->code) return;
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    ovoid_code code = file ? ovoid_chart_write_svg(file, chart) : OVOID_ERROR_MEMORY;
    if (file && fclose(file)) code = OVOID_ERROR_MEMORY;
    if (code)
        fail_memory(r);
    else {
        write_file(r, name, "svg", text, size);
        fputs("<figure>\n", r->page.file);
        fwrite(text, 1, size, r->page.file);
        fputs("</figure>\n", r->page.file);
    }
    free(text);
}

// Appends an SVG element to the page, without the declaration of SVG files.
static void embed(report *r, FILE *file) {
    char block[4096];
    int is_open = 0;
    while (fgets(block, sizeof block, file)) {
        const char *from = is_open ? block : strstr(block, "<svg");
        if (from) fputs(from, r->page.file);
        is_open = is_open || from;
    }
}

void report_add_picture(report *r, const char *name, const ovoid_picture *picture, const ovoid_picture_options *options,
                        const char *caption) {
    if (r->code) return;
    char *path = make_path(r, name, "svg");
    ovoid_error error = {0};
    FILE *file = NULL;
    if (!path)
        fail_memory(r);
    else if (ovoid_picture_write_svg(path, picture, options, &error))
        r->code = error.code, r->error = error;
    else if (!(file = fopen(path, "rb")))
        fail(r, OVOID_ERROR_FILE, name, "the picture cannot be read again");
    if (file) {
        fputs("<figure>\n", r->page.file);
        embed(r, file);
        fputs("<figcaption>", r->page.file);
        write_escaped(r->page.file, caption, strlen(caption));
        fputs("</figcaption></figure>\n", r->page.file);
        fclose(file);
    }
    free(path);
}

// ---- tables

report_table *report_begin_table(report *r, const char *name, const char *header) {
    report_table *t = calloc(1, sizeof *t);
    if (t) {
        *t = (report_table){.report = r, .name = strdup(name)};
        t->rows = open_memstream(&t->text, &t->size);
    }
    if (!t || !t->name || !t->rows) {
        fail_memory(r);
        if (t) free(t->name);
        free(t);
        return NULL;
    }
    fprintf(t->rows, "%s\n", header);
    return t;
}

void report_add_row(report_table *t, const char *format, ...) {
    if (!t) return;
    va_list arguments;
    va_start(arguments, format);
    vfprintf(t->rows, format, arguments);
    va_end(arguments);
    fputc('\n', t->rows);
}

// Appends a line of CSV as a row of a table of the page.
static const char *add_html_row(FILE *page, const char *line, const char *tag) {
    fputs("<tr>", page);
    for (const char *at = line;; at++) {
        size_t length = strcspn(at, ",\n");
        fprintf(page, "<%s>", tag);
        write_escaped(page, at, length);
        fprintf(page, "</%s>", tag);
        at += length;
        if (*at == ',') continue;
        fputs("</tr>\n", page);
        return *at ? at + 1 : at;
    }
}

void report_end_table(report_table *t, size_t in_page) {
    if (!t) return;
    report *r = t->report;
    if (fclose(t->rows)) fail_memory(r);
    if (!r->code) {
        write_file(r, t->name, "csv", t->text, t->size);
        if (in_page) {
            fputs("<table class=\"wide\">", r->page.file);
            const char *at = add_html_row(r->page.file, t->text, "th");
            for (; in_page && *at; in_page--) at = add_html_row(r->page.file, at, "td");
            fputs("</table>\n", r->page.file);
        }
        fprintf(r->page.file, "<p class=\"more\">Numbers: <a href=\"%s.csv\">%s.csv</a></p>\n", t->name, t->name);
    }
    free(t->name);
    free(t->text);
    free(t);
}

// Writes the page: its title with the text below it, the verdicts, the contents, the other sections.
static void write_page(report *r) {
    size_t front = r->sections > 1 ? r->front : r->page.size;
    buffer all = {0};
    open_buffer(r, &all);
    if (!all.file) return;
    fputs(head, all.file);
    fwrite(r->page.text, 1, front, all.file);
    if (r->verdicts.size)
        fprintf(all.file,
                "<table class=\"verdicts\"><tr><th>The paper says</th><th>here it</th><th>measured in this run</th>"
                "<th>ovoid</th></tr>\n%s</table>\n",
                r->verdicts.text);
    if (r->contents.size) fprintf(all.file, "<ol>\n%s</ol>\n", r->contents.text);
    fwrite(r->page.text + front, 1, r->page.size - front, all.file);
    fputs("</body></html>\n", all.file);
    close_buffer(r, &all);
    if (!r->code) write_file(r, "report", "html", all.text, all.size);
    free(all.text);
}

ovoid_code report_finish(report *r, ovoid_error *error) {
    close_buffer(r, &r->page);
    close_buffer(r, &r->verdicts);
    close_buffer(r, &r->contents);
    if (!r->code) write_page(r);
    ovoid_code code = r->code;
    if (error && code) *error = r->error;
    free(r->page.text);
    free(r->verdicts.text);
    free(r->contents.text);
    free(r->folder);
    free(r);
    return code;
}
