// PLY (Greg Turk, Stanford, 1994): a text header that names elements and their properties, then the elements as text or
// as little- or big-endian bytes. Of the element "vertex" the properties x, y, z are read, of "face" the list
// vertex_indices (or vertex_index); all others are skipped by their types. Counts that exceed the file's size are
// refused before elements are read.
#include "io/mesh/readers.h"

#include "io/mesh/cursor.h"

#include <string.h>

enum { PROPERTIES = 64, ELEMENTS = 16 };

/// Types of numbers.
typedef enum ply_type { PLY_NONE, PLY_I8, PLY_U8, PLY_I16, PLY_U16, PLY_I32, PLY_U32, PLY_F32, PLY_F64 } ply_type;

/// A property of an element; a list where count_type is not PLY_NONE.
typedef struct ply_property {
    ply_type type, count_type;
    char role; ///< 'x', 'y', 'z', 'f' (a face's vertices), or 0
} ply_property;

typedef enum ply_kind { PLY_OTHER, PLY_VERTEX, PLY_FACE } ply_kind;

typedef struct ply_element {
    ply_kind kind;
    int64_t count;
    int property_count;
    ply_property properties[PROPERTIES];
} ply_element;

typedef enum ply_format { PLY_UNKNOWN, PLY_TEXT, PLY_LITTLE, PLY_BIG } ply_format;

/// The file as it is read.
typedef struct ply_file {
    mesh_reader *reader;
    cursor c;
    mesh_part *part;
    ply_format format;
    int element_count;
    ply_element elements[ELEMENTS];
    int64_t item; ///< the present vertex or face: the place of errors in binary files
} ply_file;

static where here(const ply_file *p) {
    return (where){p->reader->path, p->format == PLY_LITTLE || p->format == PLY_BIG ? 0 : p->c.line, p->item};
}

// ---- header

static int type_size(ply_type type) {
    static const int sizes[] = {0, 1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[type];
}

static ply_type find_type(const char *word, size_t length) {
    static const struct {
        const char *name, *other;
        ply_type type;
    } types[] = {{"char", "int8", PLY_I8},      {"uchar", "uint8", PLY_U8},    {"short", "int16", PLY_I16},
                 {"ushort", "uint16", PLY_U16}, {"int", "int32", PLY_I32},     {"uint", "uint32", PLY_U32},
                 {"float", "float32", PLY_F32}, {"double", "float64", PLY_F64}};
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (word_is(word, length, types[i].name) || word_is(word, length, types[i].other)) return types[i].type;
    return PLY_NONE;
}

static ovoid_code fail_header(ply_file *p, const char *sentence) {
    where at = {p->reader->path, p->c.line, -1};
    return io_fail(p->reader->error, OVOID_ERROR_FORMAT, at, "%s", sentence);
}

static ovoid_code read_format(ply_file *p) {
    const char *word;
    size_t length = cursor_read_word(&p->c, &word);
    if (word_is(word, length, "ascii")) p->format = PLY_TEXT;
    if (word_is(word, length, "binary_little_endian")) p->format = PLY_LITTLE;
    if (word_is(word, length, "binary_big_endian")) p->format = PLY_BIG;
    double version;
    if (p->format == PLY_UNKNOWN || !cursor_read_number(&p->c, &version) || version != 1)
        return fail_header(p, "the format must be ascii, binary_little_endian or binary_big_endian, version 1.0");
    return OVOID_OK;
}

static ovoid_code read_element_line(ply_file *p) {
    if (p->element_count == ELEMENTS) return fail_header(p, "more than 16 elements");
    ply_element *e = &p->elements[p->element_count++];
    *e = (ply_element){.kind = PLY_OTHER};
    const char *word;
    size_t length = cursor_read_word(&p->c, &word);
    if (word_is(word, length, "vertex")) e->kind = PLY_VERTEX;
    if (word_is(word, length, "face")) e->kind = PLY_FACE;
    if (!cursor_read_integer(&p->c, &e->count) || e->count < 0)
        return fail_header(p, "an element needs a name and a count >= 0");
    if (word_is(word, length, "tristrips") && e->count)
        return fail_header(p, "triangle strips (tristrips) are not read: save the triangles as faces, as MeshLab does");
    for (int i = 0; i < p->element_count - 1; i++)
        if (e->kind != PLY_OTHER && p->elements[i].kind == e->kind)
            return fail_header(p, "the element is declared twice");
    return OVOID_OK;
}

// The role of a property.
static char find_role(ply_kind kind, int is_list, const char *name, size_t length) {
    if (kind == PLY_VERTEX && !is_list && length == 1 && name[0] >= 'x' && name[0] <= 'z') return name[0];
    if (kind == PLY_FACE && is_list &&
        (word_is(name, length, "vertex_indices") || word_is(name, length, "vertex_index")))
        return 'f';
    return 0;
}

static int is_integer_type(ply_type type) { return type >= PLY_I8 && type <= PLY_U32; }

static ovoid_code read_property_line(ply_file *p) {
    if (!p->element_count) return fail_header(p, "a property before the first element");
    ply_element *e = &p->elements[p->element_count - 1];
    if (e->property_count == PROPERTIES) return fail_header(p, "more than 64 properties");
    ply_property *property = &e->properties[e->property_count++];
    *property = (ply_property){PLY_NONE, PLY_NONE, 0};
    const char *word;
    size_t length = cursor_read_word(&p->c, &word);
    int is_list = word_is(word, length, "list");
    if (is_list) {
        length = cursor_read_word(&p->c, &word);
        property->count_type = find_type(word, length);
        length = cursor_read_word(&p->c, &word);
        if (!is_integer_type(property->count_type))
            return fail_header(p, "the count of a list must be an integer type");
    }
    property->type = find_type(word, length);
    length = cursor_read_word(&p->c, &word);
    if (property->type == PLY_NONE || !length) return fail_header(p, "a property needs a type and a name");
    property->role = find_role(e->kind, is_list, word, length);
    if (property->role == 'f' && !is_integer_type(property->type))
        return fail_header(p, "vertex indices must be of an integer type");
    for (int i = 0; i < e->property_count - 1; i++)
        if (property->role && e->properties[i].role == property->role)
            return fail_header(p, "the property is declared twice");
    return OVOID_OK;
}

static int has_role(const ply_element *e, char role) {
    for (int i = 0; i < e->property_count; i++)
        if (e->properties[i].role == role) return 1;
    return 0;
}

// OK if there is a format, and an element of vertices with x, y and z.
static ovoid_code validate_header(ply_file *p) {
    if (p->format == PLY_UNKNOWN) return fail_header(p, "the header names no format");
    int vertices = 0;
    for (int i = 0; i < p->element_count; i++) {
        const ply_element *e = &p->elements[i];
        if (e->kind == PLY_FACE && !vertices) return fail_header(p, "the faces come before the vertices");
        if (e->kind != PLY_VERTEX) continue;
        vertices = 1;
        if (!has_role(e, 'x') || !has_role(e, 'y') || !has_role(e, 'z'))
            return fail_header(p, "a vertex needs the properties x, y and z");
    }
    return vertices ? OVOID_OK : fail_header(p, "there is no element \"vertex\"");
}

static ovoid_code read_header(ply_file *p) {
    skip_line(&p->c); // "ply"
    for (;;) {
        if (!skip_to_text(&p->c, 0)) return fail_header(p, "truncated: the header has no end_header");
        const char *word;
        size_t length = cursor_read_word(&p->c, &word);
        ovoid_code code = OVOID_OK;
        if (word_is(word, length, "format"))
            code = read_format(p);
        else if (word_is(word, length, "element"))
            code = read_element_line(p);
        else if (word_is(word, length, "property"))
            code = read_property_line(p);
        else if (word_is(word, length, "end_header"))
            break;
        else if (!word_is(word, length, "comment") && !word_is(word, length, "obj_info"))
            code = fail_header(p, "not a line of a PLY header");
        if (code) return code;
        skip_line(&p->c);
    }
    ovoid_code code = validate_header(p);
    skip_line(&p->c);
    return code;
}

// ---- elements

// The fewest bytes an element can take.
static int64_t least_bytes(const ply_file *p, const ply_element *e) {
    int64_t sum = 0;
    for (int i = 0; i < e->property_count; i++) {
        const ply_property *property = &e->properties[i];
        sum += p->format == PLY_TEXT ? 2 : type_size(property->count_type ? property->count_type : property->type);
    }
    return sum;
}

// All counts together must fit into the bytes that follow; a last line end may be missing.
static ovoid_code validate_counts(ply_file *p) {
    int64_t left = p->c.end - p->c.at + 1;
    for (int i = 0; i < p->element_count; i++) {
        const ply_element *e = &p->elements[i];
        int64_t least = least_bytes(p, e);
        if (least && e->count > left / least)
            return io_fail(p->reader->error, OVOID_ERROR_FORMAT, here(p),
                           "truncated: the header promises %lld items where %lld bytes follow", (long long)e->count,
                           (long long)(left - 1));
        if (!least && e->count) return fail_header(p, "an element has no properties");
        left -= e->count * least;
    }
    return OVOID_OK;
}

static double number_of_bits(ply_type type, uint64_t bits) {
    float f;
    double d;
    uint32_t low = (uint32_t)bits;
    switch (type) {
    case PLY_I8: return (double)(int8_t)(uint8_t)bits;
    case PLY_I16: return (double)(int16_t)(uint16_t)bits;
    case PLY_I32: return (double)(int32_t)low;
    case PLY_F32: memcpy(&f, &low, sizeof f); return (double)f;
    case PLY_F64: memcpy(&d, &bits, sizeof d); return d;
    default: return (double)bits;
    }
}

// The next number, text or binary. All integer types fit into a double.
static ovoid_code read_value(ply_file *p, ply_type type, double *value) {
    if (p->format == PLY_TEXT) {
        const char *word = "";
        if (skip_to_text(&p->c, 0) && cursor_read_number(&p->c, value)) return OVOID_OK;
        int length = (int)cursor_read_word(&p->c, &word);
        if (!length) return io_fail(p->reader->error, OVOID_ERROR_FORMAT, here(p), "truncated: a number is missing");
        return io_fail(p->reader->error, OVOID_ERROR_FORMAT, here(p), "\"%.*s\" is not a number",
                       length < 40 ? length : 40, word);
    }
    int size = type_size(type);
    if (p->c.end - p->c.at < size)
        return io_fail(p->reader->error, OVOID_ERROR_FORMAT, here(p), "truncated in item %lld", (long long)p->item);
    uint64_t bits = 0;
    for (int i = 0; i < size; i++) {
        int byte = p->format == PLY_LITTLE ? size - 1 - i : i;
        bits = bits << 8 | (unsigned char)p->c.at[byte];
    }
    p->c.at += size;
    *value = number_of_bits(type, bits);
    return OVOID_OK;
}

static ovoid_code add_corner(ply_file *p, double v) {
    if (!(v >= 0 && v < (double)p->part->point_count) || v != (double)(uint32_t)v)
        return io_fail(p->reader->error, OVOID_ERROR_INDEX, here(p),
                       "face %lld: there is no vertex %.17g; there are %zu", (long long)p->item, v,
                       p->part->point_count);
    return mesh_add_index(p->reader, p->part, (uint32_t)v);
}

// Reads a list: a face's vertices are stored, any other list is skipped.
static ovoid_code read_list(ply_file *p, const ply_property *property) {
    double count;
    ovoid_code code = read_value(p, property->count_type, &count);
    if (code) return code;
    if (!(count >= 0 && count <= (double)(p->c.end - p->c.at)) || count != (double)(uint32_t)count)
        return io_fail(p->reader->error, OVOID_ERROR_FORMAT, here(p), "item %lld: a list of %.17g items",
                       (long long)p->item, count);
    for (uint32_t i = 0; i < (uint32_t)count; i++) {
        double value;
        code = read_value(p, property->type, &value);
        if (!code && property->role == 'f') code = add_corner(p, value);
        if (code) return code;
    }
    return property->role == 'f' ? mesh_end_face(p->reader, p->part, (uint32_t)count) : OVOID_OK;
}

static ovoid_code read_item(ply_file *p, const ply_element *e) {
    double xyz[3] = {0, 0, 0};
    for (int i = 0; i < e->property_count; i++) {
        const ply_property *property = &e->properties[i];
        double value = 0;
        ovoid_code code = property->count_type ? read_list(p, property) : read_value(p, property->type, &value);
        if (code) return code;
        if (property->role >= 'x') xyz[property->role - 'x'] = value;
    }
    return e->kind == PLY_VERTEX ? mesh_add_point(p->reader, p->part, xyz, here(p)) : OVOID_OK;
}

ovoid_code mesh_read_ply(mesh_reader *reader) {
    const char *data = reader->file.data;
    ply_file p = {.reader = reader, .c = {data, data + reader->file.size, 1}, .item = -1};
    if (reader->file.size < 3 || memcmp(data, "ply", 3) != 0)
        return fail_header(&p, "the file does not begin with ply");
    p.part = mesh_add_part(reader, "", 0);
    if (!p.part) return OVOID_ERROR_MEMORY;
    ovoid_code code = read_header(&p);
    if (!code) code = validate_counts(&p);
    for (int i = 0; i < p.element_count && !code; i++)
        for (p.item = 0; p.item < p.elements[i].count && !code; p.item++) code = read_item(&p, &p.elements[i]);
    if (code) return code;
    // Bytes after the last element mean that a count is wrong.
    int has_more = p.format == PLY_TEXT ? skip_to_text(&p.c, 0) : p.c.at < p.c.end;
    return has_more ? io_fail(reader->error, OVOID_ERROR_FORMAT, here(&p), "there is more after the last element")
                    : OVOID_OK;
}
