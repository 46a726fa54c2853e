// Wavefront OBJ: points, polygons, objects. Of a face corner `v/vt/vn` only the vertex index is read: broken texture
// and normal indices do no harm. Negative indices count back from the last point. Positive ones may refer to later
// points; they are checked at the end. A backslash at a line's end joins the next line to it. With parts, each object
// `o` becomes a part of its own; where there is none, each group `g`. Linear in the file.
#include "io/mesh/readers.h"

#include "io/mesh/cursor.h"

#include <stdlib.h>
#include <string.h>

/// An `o` or `g` line, and where its elements begin.
typedef struct obj_object {
    const char *name;
    size_t length;
    size_t first_point, first_element, first_index;
} obj_object;

/// The state of reading: all points and elements in one part, and the objects.
typedef struct obj_text {
    mesh_reader *reader;
    cursor c;
    mesh_part *all;     ///< points, indices and sizes (here also of elements of one or two points)
    int joined;         ///< 1: some lines end with a backslash
    uint64_t top_index; ///< largest index seen, 1-based, and its line
    int64_t top_line;
    obj_object *objects, *groups;
    size_t object_count, object_capacity;
    size_t group_count, group_capacity;
} obj_text;

static where here(const obj_text *s) { return (where){s->reader->path, s->c.line, -1}; }

// Makes one line of lines that end with a backslash: the backslash becomes a blank, the line end a vertical tab, which
// is a blank too and is counted as a line where the statement ends. 1 if there were any.
static int join_lines(bytes file) {
    int joined = 0;
    char *end = file.data + file.size;
    for (char *at = file.data; (at = memchr(at, '\\', (size_t)(end - at))); at++) {
        char *after = at + 1;
        while (after < end && *after == '\r') after++;
        if (after == end || *after != '\n') continue;
        // At the first such line, vertical tabs that are in the file already are replaced, so that they do not count.
        if (!joined)
            for (char *tab = file.data; (tab = memchr(tab, '\v', (size_t)(end - tab)));) *tab = ' ';
        joined = 1;
        *at = ' ';
        *after = '\v';
    }
    return joined;
}

// 1 if the statement goes on.
static int has_more(obj_text *s) {
    skip_blanks(&s->c);
    return !is_line_end(&s->c);
}

// Skips the rest of the statement.
static void skip_statement(obj_text *s, const char *begin) {
    skip_line(&s->c);
    if (!s->joined) return;
    for (; (begin = memchr(begin, '\v', (size_t)(s->c.at - begin))); begin++) s->c.line++;
}

static ovoid_code read_point(obj_text *s) {
    double xyz[3];
    ovoid_code code = cursor_read_xyz(&s->c, s->reader->path, xyz, s->reader->error);
    return code ? code : mesh_add_point(s->reader, s->all, xyz, here(s));
}

// Reads a corner, `v`, `v/vt`, `v//vn` or `v/vt/vn`; *index is the 0-based vertex, which may come later in the file.
static ovoid_code read_corner(obj_text *s, uint32_t *index) {
    const char *word;
    size_t length = cursor_read_word(&s->c, &word);
    int shown = (int)(length < 40 ? length : 40);
    int64_t v;
    const char *after = integer_read(word, word + length, &v);
    if (!after || (after < word + length && *after != '/'))
        return io_fail(s->reader->error, OVOID_ERROR_FORMAT, here(s), "\"%.*s\" is not a vertex index", shown, word);
    int64_t count = (int64_t)s->all->point_count;
    if (v == 0 || v < -count || v > OVOID_MESH_POINTS_MAX)
        return io_fail(s->reader->error, OVOID_ERROR_INDEX, here(s), "there is no vertex %.*s; %lld come before", shown,
                       word, (long long)count);
    if (v > (int64_t)s->top_index) {
        s->top_index = (uint64_t)v;
        s->top_line = s->c.line;
    }
    *index = (uint32_t)(v < 0 ? count + v : v - 1);
    return OVOID_OK;
}

// Reads an element over points: f, l or p. Its size is stored whatever it is; those that are no faces are removed at
// the end.
static ovoid_code read_element(obj_text *s, int is_face) {
    uint32_t size = 0;
    while (has_more(s)) {
        uint32_t index = 0;
        ovoid_code code = read_corner(s, &index);
        if (!code) code = mesh_add_index(s->reader, s->all, index);
        if (code) return code;
        size++;
    }
    if (!size) return io_fail(s->reader->error, OVOID_ERROR_FORMAT, here(s), "an element without vertices");
    if (!array_reserve((void **)&s->all->sizes, &s->all->face_capacity, s->all->face_count, sizeof(uint32_t)))
        return io_fail_memory(s->reader->error, s->reader->path);
    // Elements that are no faces are marked by the top bit; only their points count.
    s->all->sizes[s->all->face_count++] = is_face && size >= 3 ? size : size | 0x80000000u;
    return OVOID_OK;
}

static ovoid_code read_name(obj_text *s, obj_object **objects, size_t *count, size_t *capacity) {
    skip_blanks(&s->c);
    const char *name = s->c.at;
    while (!is_line_end(&s->c)) s->c.at++;
    const char *end = s->c.at;
    while (end > name && is_blank(end[-1])) end--;
    if (!array_reserve((void **)objects, capacity, *count, sizeof(obj_object)))
        return io_fail_memory(s->reader->error, s->reader->path);
    (*objects)[(*count)++] =
        (obj_object){name, (size_t)(end - name), s->all->point_count, s->all->face_count, s->all->index_count};
    return OVOID_OK;
}

// 1 for a statement that does not concern points and faces.
static int is_known_word(const char *word, size_t length) {
    static const char *const words[] = {
        "vt",     "vn",    "vp",         "s",         "mg",   "usemtl", "mtllib",   "usemap",   "maplib",
        "cstype", "deg",   "bmat",       "step",      "curv", "curv2",  "surf",     "parm",     "trim",
        "hole",   "scrv",  "sp",         "end",       "con",  "bevel",  "c_interp", "d_interp", "lod",
        "ctech",  "stech", "shadow_obj", "trace_obj", "vc",   "call",   "csh",      "g",        "o"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (word_is(word, length, words[i])) return 1;
    return 0;
}

static ovoid_code read_statement(obj_text *s) {
    const char *word, *begin = s->c.at;
    size_t length = cursor_read_word(&s->c, &word);
    ovoid_code code = OVOID_OK;
    if (word_is(word, length, "v"))
        code = read_point(s);
    else if (word_is(word, length, "f") || word_is(word, length, "fo"))
        code = read_element(s, 1);
    else if (word_is(word, length, "l") || word_is(word, length, "p"))
        code = read_element(s, 0);
    else if (word_is(word, length, "o"))
        code = read_name(s, &s->objects, &s->object_count, &s->object_capacity);
    else if (word_is(word, length, "g"))
        code = read_name(s, &s->groups, &s->group_count, &s->group_capacity);
    else if (!is_known_word(word, length))
        code = io_fail(s->reader->error, OVOID_ERROR_FORMAT, here(s), "\"%.*s\" is not a statement of OBJ",
                       (int)(length < 40 ? length : 40), word);
    skip_statement(s, begin);
    return code;
}

// ---- one part or several

// Removes the elements that are no faces.
static void remove_non_faces(mesh_part *part) {
    size_t faces = 0, from = 0, to = 0;
    for (size_t i = 0; i < part->face_count; i++) {
        uint32_t size = part->sizes[i] & 0x7fffffffu;
        if (size == part->sizes[i]) {
            memmove(part->indices + to, part->indices + from, size * sizeof(uint32_t));
            to += size;
            part->sizes[faces++] = size;
        }
        from += size;
    }
    part->face_count = faces;
    part->index_count = to;
}

/// Which points of the whole file have an index in the present part.
typedef struct renumbering {
    uint32_t *owner, *number;
    uint32_t part; ///< 1-based; owner[i] == part: point i is number[i] of it
} renumbering;

// Copies a point, which was checked and scaled when it was read.
static ovoid_code copy_point(mesh_reader *reader, mesh_part *part, const double *xyz) {
    if (!array_reserve((void **)&part->points, &part->point_capacity, part->point_count, 3 * sizeof(double)))
        return io_fail_memory(reader->error, reader->path);
    memcpy(part->points + 3 * part->point_count++, xyz, 3 * sizeof(double));
    return OVOID_OK;
}

// Copies the elements [first, last) of the whole, whose indices begin at `at`, with the points they use.
static ovoid_code copy_elements(mesh_reader *reader, mesh_part *part, const mesh_part *all, const size_t range[3],
                                renumbering *map) {
    size_t at = range[2];
    ovoid_code code = OVOID_OK;
    for (size_t e = range[0]; e < range[1] && !code; e++) {
        uint32_t size = all->sizes[e] & 0x7fffffffu;
        for (uint32_t k = 0; k < size && !code; k++) {
            uint32_t i = all->indices[at++];
            if (map->owner[i] != map->part) {
                map->owner[i] = map->part;
                map->number[i] = (uint32_t)part->point_count;
                code = copy_point(reader, part, all->points + 3 * (size_t)i);
            }
            if (!code) code = mesh_add_index(reader, part, map->number[i]);
        }
        if (code) break;
        if (size != all->sizes[e])
            part->index_count -= size;
        else
            code = mesh_end_face(reader, part, size);
    }
    return code;
}

// Adds an object as a part: its elements are those from `begin` to `end`.
static ovoid_code add_object(mesh_reader *reader, const mesh_part *all, obj_object begin, obj_object end,
                             renumbering *map) {
    map->part++;
    mesh_part *part = mesh_add_part(reader, begin.name, begin.length);
    if (!part) return OVOID_ERROR_MEMORY;
    if (begin.first_element < end.first_element)
        return copy_elements(reader, part, all, (size_t[3]){begin.first_element, end.first_element, begin.first_index},
                             map);
    ovoid_code code = OVOID_OK;
    for (size_t i = begin.first_point; i < end.first_point && !code; i++)
        code = copy_point(reader, part, all->points + 3 * i);
    return code;
}

// Splits the whole into one part for each object, and one for elements before the first.
static ovoid_code split_objects(mesh_reader *reader, const mesh_part *all, const obj_object *objects, size_t count) {
    renumbering map = {calloc(all->point_count + 1, sizeof(uint32_t)), calloc(all->point_count + 1, sizeof(uint32_t)),
                       0};
    ovoid_code code = map.owner && map.number ? OVOID_OK : io_fail_memory(reader->error, reader->path);
    const obj_object none = {"", 0, 0, 0, 0};
    const obj_object end = {"", 0, all->point_count, all->face_count, all->index_count};
    // Points before the first object belong to the objects that use them, unless there are elements too.
    if (!code && objects[0].first_element > 0) code = add_object(reader, all, none, objects[0], &map);
    for (size_t i = 0; i < count && !code; i++)
        code = add_object(reader, all, objects[i], i + 1 < count ? objects[i + 1] : end, &map);
    free(map.owner);
    free(map.number);
    return code;
}

static ovoid_code make_parts(obj_text *s) {
    mesh_reader *reader = s->reader;
    const obj_object *objects = s->object_count ? s->objects : s->groups;
    size_t count = s->object_count ? s->object_count : s->group_count;
    if (!reader->parts || !count) {
        remove_non_faces(s->all);
        mesh_part *part = mesh_add_part(reader, "", 0);
        if (!part) return OVOID_ERROR_MEMORY;
        char *name = part->name;
        *part = *s->all;
        part->name = name;
        *s->all = (mesh_part){.name = NULL};
        return OVOID_OK;
    }
    return split_objects(reader, s->all, objects, count);
}

// Skips a first line of two numbers, the counts of points and faces, which some writers add to OBJ.
static void skip_counts(cursor *c) {
    cursor after = *c;
    int64_t count;
    if (!skip_to_text(&after, '#') || !cursor_read_integer(&after, &count) || !cursor_read_integer(&after, &count))
        return;
    skip_blanks(&after);
    if (!is_line_end(&after)) return;
    *c = after;
    skip_line(c);
}

ovoid_code mesh_read_obj(mesh_reader *reader) {
    const char *data = reader->file.data;
    mesh_part all = {.name = NULL};
    obj_text s = {.reader = reader, .c = {data, data + reader->file.size, 1}, .all = &all};
    s.joined = join_lines(reader->file);
    skip_counts(&s.c);
    ovoid_code code = OVOID_OK;
    while (!code && skip_to_text(&s.c, '#')) code = read_statement(&s);
    if (!code && s.top_index > all.point_count)
        code = io_fail(reader->error, OVOID_ERROR_INDEX, (where){reader->path, s.top_line, -1},
                       "there is no vertex %llu; the file has %zu", (unsigned long long)s.top_index, all.point_count);
    if (!code) code = make_parts(&s);
    free(s.objects);
    free(s.groups);
    free(all.points);
    free(all.indices);
    free(all.sizes);
    return code;
}
