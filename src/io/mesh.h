// The mesh under construction, and what its readers share. A reader gets the whole file and adds points and faces; each
// point is checked and scaled as it comes in.
#ifndef OVOID_IO_MESH_H
#define OVOID_IO_MESH_H

#include "io/text.h"

/// A part that owns its arrays.
typedef struct mesh_part {
    char *name;
    double *points;
    uint32_t *indices, *sizes;
    size_t point_count, point_capacity; ///< capacity in points
    size_t index_count, index_capacity;
    size_t face_count, face_capacity;
} mesh_part;

struct ovoid_mesh {
    mesh_part *parts;
    size_t part_count, part_capacity;
    size_t point_count, index_count; ///< of all parts, as they were read
};

/// Most indices of a mesh: a scene of many nodes that show one mesh could ask for any number.
#define MESH_INDICES_MAX 200000000

/// What a reader works on.
typedef struct mesh_reader {
    const char *path;
    bytes file;
    double scale;
    int parts, trusted;
    ovoid_mesh *mesh;
    ovoid_error *error;
} mesh_reader;

/// A new part at the end, empty; NULL with the error filled where there is no memory or there are too many. Earlier
/// pointers become invalid.
mesh_part *mesh_add_part(mesh_reader *reader, const char *name, size_t length);

/// Checks (finite, in range, not too many), scales and adds a point. line: of a text file, or 0; place: of a binary
/// one.
ovoid_code mesh_add_point(mesh_reader *reader, mesh_part *part, const double xyz[3], where at);

enum { POINT_TABLE_RECENT = 4 };

/// The points of a part, for finding equal ones; all zero is an empty table. A slot holds an index plus 1. The caller
/// frees slots.
typedef struct point_table {
    uint32_t *slots;
    size_t size, count;                        ///< size is a power of two, or 0; count is the part's point count
    uint32_t recent[POINT_TABLE_RECENT], turn; ///< the points found last
} point_table;

/// Like mesh_add_point, unless the part has an equal point already; *index is that of the point.
ovoid_code mesh_add_merged_point(mesh_reader *reader, mesh_part *part, point_table *table, const double xyz[3],
                                 where at, uint32_t *index);

/// Adds an index to the face that is being written; unchecked.
ovoid_code mesh_add_index(mesh_reader *reader, mesh_part *part, uint32_t index);

/// Ends a face of `size` indices. Fewer than three are no face: the indices are taken back.
ovoid_code mesh_end_face(mesh_reader *reader, mesh_part *part, uint32_t size);

/// The readers. Each fills reader->mesh or the error.
ovoid_code mesh_read_stl(mesh_reader *reader);
ovoid_code mesh_read_obj(mesh_reader *reader);
ovoid_code mesh_read_off(mesh_reader *reader);
ovoid_code mesh_read_ply(mesh_reader *reader);
ovoid_code mesh_read_assimp(mesh_reader *reader);

/// 1 if the bytes are those of an STL file, text or binary.
int mesh_is_stl(bytes file);

// ---- text formats are read line by line

/// A place in a text.
typedef struct cursor {
    const char *at, *end; ///< of the whole text
    int64_t line;         ///< 1-based line of `at`
} cursor;

static inline int is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }
static inline int is_line_end(const cursor *c) { return c->at == c->end || *c->at == '\n'; }

/// Skips blanks within the line.
static inline void skip_blanks(cursor *c) {
    while (c->at < c->end && is_blank(*c->at)) c->at++;
}
/// Skips to the first byte of the next line.
void skip_line(cursor *c);
/// Skips blanks, empty lines and, where mark is not 0, comments that begin with it. 0 at the end of the text.
int skip_to_text(cursor *c, char mark);
/// A number that ends at a blank or at the line's end. 0 where there is none; nothing is skipped then.
int cursor_read_number(cursor *c, double *value);
/// Likewise an integer.
int cursor_read_integer(cursor *c, int64_t *value);
/// The bytes up to the next blank or line end; returns their number.
size_t cursor_read_word(cursor *c, const char **word);
/// Three numbers; fails with a sentence that says which is missing and shows what stands there.
ovoid_code cursor_read_xyz(cursor *c, const char *path, double xyz[3], ovoid_error *error);
/// 1 if the word equals name, in any case; name is in lower case.
int word_is(const char *word, size_t length, const char *name);

#endif
