// The mesh under construction, and what its readers share. A reader gets the whole file and adds points and faces; each
// point is checked and scaled as it comes in.
#ifndef OVOID_IO_MESH_MESH_BUILD_H
#define OVOID_IO_MESH_MESH_BUILD_H

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
    uint64_t checksum;               ///< checksum_bytes of its file
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

/// A hash table of a part's points, for finding equal ones; all zero is an empty table. A slot holds an index plus 1.
/// The caller frees slots.
typedef struct point_table {
    uint32_t *slots;
    size_t size, count;                        ///< size is a power of two, or 0; count is the part's point count
    uint32_t recent[POINT_TABLE_RECENT], turn; ///< the points found last
} point_table;

/// Adds a point, or finds the equal one that the part has already; *index is that of the point.
ovoid_code mesh_add_merged_point(mesh_reader *reader, mesh_part *part, point_table *table, const double xyz[3],
                                 where at, uint32_t *index);

/// Adds an index to the present face; unchecked.
ovoid_code mesh_add_index(mesh_reader *reader, mesh_part *part, uint32_t index);

/// The triangles of all faces, three indices each, to be freed; NULL after an error: MEMORY, FORMAT (a face that cannot
/// be cut).
uint32_t *mesh_cut_polygons(const ovoid_faces *faces, size_t *count, ovoid_error *error);

/// Ends a face of `size` indices. With fewer than three it is no face: the indices are removed.
ovoid_code mesh_end_face(mesh_reader *reader, mesh_part *part, uint32_t size);

#endif
