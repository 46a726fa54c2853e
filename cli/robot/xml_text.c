// Tags of a text that a parser has accepted: what is looked for is where they are, not whether they are right.
#include "robot/xml_text.h"

#include <string.h>

static int begins(const char *at, const char *end, const char *word) {
    size_t size = strlen(word);
    return (size_t)(end - at) >= size && memcmp(at, word, size) == 0;
}

/// Behind the next place of a word, or the end.
static const char *pass(const char *at, const char *end, const char *word) {
    size_t size = strlen(word);
    for (; (size_t)(end - at) >= size; at++)
        if (memcmp(at, word, size) == 0) return at + size;
    return end;
}

/// Behind the '>' that ends a tag or a declaration; not one in quotes or in brackets.
static const char *pass_tag(const char *at, const char *end) {
    char quote = 0;
    int depth = 0;
    for (; at < end; at++) {
        if (quote) {
            if (*at == quote) quote = 0;
        } else if (*at == '"' || *at == '\'') {
            quote = *at;
        } else if (*at == '>' && depth == 0) {
            return at + 1;
        } else {
            depth += (*at == '[') - (*at == ']');
        }
    }
    return end;
}

static int is_name_end(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '/' || c == '>'; }

int xml_find_tag(const char **at, const char *end, xml_tag *tag) {
    for (;;) {
        const char *open = memchr(*at, '<', (size_t)(end - *at));
        if (!open) return 0;
        if (begins(open, end, "<!--"))
            *at = pass(open + 4, end, "-->");
        else if (begins(open, end, "<![CDATA["))
            *at = pass(open, end, "]]>");
        else if (begins(open, end, "<?"))
            *at = pass(open, end, "?>");
        else if (begins(open, end, "<!"))
            *at = pass_tag(open, end);
        else {
            *at = pass_tag(open, end);
            *tag = (xml_tag){.begin = open, .end = *at};
            tag->is_end = open + 1 < end && open[1] == '/';
            tag->is_empty = *at - open > 2 && (*at)[-2] == '/';
            tag->name = open + 1 + tag->is_end;
            while (tag->name + tag->name_size < end && !is_name_end(tag->name[tag->name_size])) tag->name_size++;
            return 1;
        }
    }
}

int xml_tag_is(const xml_tag *tag, const char *name) {
    return tag->name_size == strlen(name) && memcmp(tag->name, name, tag->name_size) == 0;
}

/// One character of a value from *at on; its entity is passed over whole.
static char take_character(const char **at, const char *end) {
    static const char *const entities[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;"};
    for (int i = 0; i < 5; i++)
        if (begins(*at, end, entities[i])) {
            *at += strlen(entities[i]);
            return "&<>\"'"[i];
        }
    return *(*at)++;
}

int xml_tag_read_attribute(const xml_tag *tag, const char *key, char *value, size_t room) {
    for (const char *at = tag->name + tag->name_size; at < tag->end;) {
        while (at < tag->end && is_name_end(*at)) at++;
        const char *name = at;
        while (at < tag->end && *at != '=' && !is_name_end(*at)) at++;
        size_t size = (size_t)(at - name), used = 0;
        while (at < tag->end && *at != '"' && *at != '\'') at++;
        if (at == tag->end) return 0;
        char quote = *at++;
        const char *last = memchr(at, quote, (size_t)(tag->end - at));
        if (!last) return 0;
        int is_it = size == strlen(key) && memcmp(name, key, size) == 0;
        while (is_it && at < last && used + 1 < room) value[used++] = take_character(&at, last);
        if (is_it) {
            value[used] = 0;
            return at == last;
        }
        at = last + 1;
    }
    return 0;
}

void xml_write_attribute(FILE *file, const char *key, const char *text) {
    static const char special[] = "&<>\"\t\n\r";
    static const char *const escapes[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&#9;", "&#10;", "&#13;"};
    fprintf(file, " %s=\"", key);
    for (const char *c = text; *c; c++) {
        const char *at = strchr(special, *c);
        if (at)
            fputs(escapes[at - special], file);
        else
            fputc(*c, file);
    }
    fputc('"', file);
}
