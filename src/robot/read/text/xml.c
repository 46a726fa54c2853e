// XML through expat (https://libexpat.github.io), without document types: a file that declares an entity is refused, so
// that none can grow by being read. Cost: linear in the file; some ten bytes of memory for each of its bytes.
#include "robot/read/text/xml.h"

#include <expat.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/// The state of reading.
typedef struct xml_reader {
    const char *path;
    pool *memory;
    ovoid_error *error;
    XML_Parser parser;
    xml_element *root, *open; ///< open: the innermost element that has not ended
    size_t depth;
    ovoid_code failed; ///< why the reader stopped the parser
} xml_reader;

/// Stops the parser with a sentence about the present line.
COMPILER_PRINTF(3, 4)
static void stop(xml_reader *r, ovoid_code code, const char *format, ...) {
    if (r->failed) return;
    char sentence[200];
    va_list list;
    va_start(list, format);
    (void)vsnprintf(sentence, sizeof sentence, format, list);
    va_end(list);
    r->failed = code;
    int64_t line = code == OVOID_ERROR_MEMORY ? 0 : (int64_t)XML_GetCurrentLineNumber(r->parser);
    io_report(r->error, code, (where){r->path, line, -1}, "%s", sentence);
    XML_StopParser(r->parser, XML_FALSE);
}

static void stop_memory(xml_reader *r) { stop(r, OVOID_ERROR_MEMORY, "there is not enough memory"); }

static const char *keep(xml_reader *r, const char *text) { return pool_copy(r->memory, text, strlen(text)); }

static xml_element *make_element(xml_reader *r, const char *name, const char **attributes) {
    xml_element *e = pool_get(r->memory, 1, sizeof *e);
    if (!e) return NULL;
    *e = (xml_element){.name = keep(r, name), .line = (int64_t)XML_GetCurrentLineNumber(r->parser), .text = ""};
    int is_good = e->name != NULL;
    const xml_attribute **end = &e->attributes;
    for (; is_good && attributes[0]; attributes += 2) {
        xml_attribute *a = pool_get(r->memory, 1, sizeof *a);
        if (!a) return NULL;
        *a = (xml_attribute){keep(r, attributes[0]), keep(r, attributes[1]), NULL};
        is_good = a->name && a->value;
        *end = a;
        end = (const xml_attribute **)&a->next;
    }
    return is_good ? e : NULL;
}

static void begin_element(void *context, const char *name, const char **attributes) {
    xml_reader *r = context;
    if (r->failed) return;
    if (++r->depth > XML_DEPTH_MAX) {
        stop(r, OVOID_ERROR_LIMIT, "elements are nested more than %d deep", XML_DEPTH_MAX);
        return;
    }
    xml_element *e = make_element(r, name, attributes);
    if (!e) {
        stop_memory(r);
        return;
    }
    e->parent = r->open;
    if (!r->open)
        r->root = e;
    else if (r->open->last)
        r->open->last = r->open->last->next = e;
    else
        r->open->first = r->open->last = e;
    r->open = e;
}

static void end_element(void *context, const char *name) {
    xml_reader *r = context;
    (void)name;
    if (r->failed) return;
    r->open = r->open->parent;
    r->depth--;
}

// Text comes in pieces; only the first is kept, and of it what is no blank: nothing that is read here is longer.
static void take_text(void *context, const char *text, int length) {
    xml_reader *r = context;
    if (r->failed || !r->open || r->open->text[0] || r->open->first) return;
    while (length && strchr(" \t\r\n", text[0])) text++, length--;
    while (length && strchr(" \t\r\n", text[length - 1])) length--;
    if (!length) return;
    r->open->text = pool_copy(r->memory, text, (size_t)length);
    if (r->open->text) return;
    r->open->text = "";
    stop_memory(r);
}

static void refuse_entity(void *context, const char *name, int is_parameter, const char *value, int length,
                          const char *base, const char *system, const char *public_name, const char *notation) {
    (void)is_parameter, (void)value, (void)length, (void)base, (void)system, (void)public_name, (void)notation;
    stop(context, OVOID_ERROR_FORMAT, "the entity \"%.60s\" is declared; entities are not read: write its text instead",
         name);
}

static void refuse_reference(void *context, const char *name, int is_parameter) {
    (void)is_parameter;
    stop(context, OVOID_ERROR_FORMAT, "the entity \"%.60s\" is not known; entities are not read", name);
}

// What expat says, in its own words.
static ovoid_code fail_parser(xml_reader *r) {
    enum XML_Error why = XML_GetErrorCode(r->parser);
    if (why == XML_ERROR_NO_MEMORY) return io_fail_memory(r->error, r->path);
    where at = {r->path, (int64_t)XML_GetCurrentLineNumber(r->parser), -1};
    return io_fail(r->error, OVOID_ERROR_FORMAT, at, "XML: %s", XML_ErrorString(why));
}

static ovoid_code parse(xml_reader *r, bytes file) {
    XML_SetUserData(r->parser, r);
    XML_SetElementHandler(r->parser, begin_element, end_element);
    XML_SetCharacterDataHandler(r->parser, take_text);
    XML_SetEntityDeclHandler(r->parser, refuse_entity);
    XML_SetSkippedEntityHandler(r->parser, refuse_reference);
    // All at once: given in pieces, a long token would be looked at again with each.
    enum XML_Status status = XML_Parse(r->parser, file.data, (int)file.size, XML_TRUE);
    if (r->failed) return r->failed;
    return status == XML_STATUS_OK ? OVOID_OK : fail_parser(r);
}

ovoid_code xml_read_text(const char *path, bytes text, pool *memory, xml_element **root, ovoid_error *error) {
    xml_reader r = {.path = path, .memory = memory, .error = error, .parser = XML_ParserCreate(NULL)};
    ovoid_code code = r.parser ? parse(&r, text) : io_fail_memory(error, path);
    XML_ParserFree(r.parser);
    *root = code ? NULL : r.root;
    return code;
}

ovoid_code xml_read(const char *path, pool *memory, xml_element **root, ovoid_error *error) {
    bytes file;
    ovoid_code code = bytes_read_input(path, XML_SIZE_MAX, &file, error);
    if (code) return code;
    code = xml_read_text(path, file, memory, root, error);
    free(file.data);
    return code;
}

const char *xml_get(const xml_element *element, const char *name) {
    for (const xml_attribute *a = element->attributes; a; a = a->next)
        if (strcmp(a->name, name) == 0) return a->value;
    return NULL;
}

const xml_element *xml_find(const xml_element *element, const char *name) {
    for (const xml_element *e = element->first; e; e = e->next)
        if (xml_is(e, name)) return e;
    return NULL;
}

int xml_is(const xml_element *element, const char *name) { return strcmp(element->name, name) == 0; }
