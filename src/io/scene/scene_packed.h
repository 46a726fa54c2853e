// The file of a packed scene: its header, then objects (packed_object), their indices in the order of the names
// (uint32_t), ignored pairs (uint64_t), names (each ended by a zero byte), shapes (uint64_t size, then the bytes of a
// .ovoid file), bodies. Each of these begins at a multiple of 8 bytes. docs/scene.md has the table of a body.
#ifndef OVOID_IO_SCENE_SCENE_PACKED_H
#define OVOID_IO_SCENE_SCENE_PACKED_H

#include "io/scene/scene.h"
#include "io/scene/scene_bytes.h"
#include "tools/checksum.h"

#include <string.h>

enum { PACKED_VERSION = 2 };
/// What another byte order shows as another number.
#define PACKED_ORDER 0x01020304u
#define PACKED_MAGIC "\x89OVSCN\n\x1a"

/// For which choice of meshes the bodies are.
enum { PACKED_SOLIDS = 0, PACKED_HULLS = 1, PACKED_EITHER = 2 };

typedef struct packed_header {
    char magic[8];
    uint32_t version, order;
    uint64_t size, checksum; ///< of the file; of all that is behind this number
    char unit[4];
    uint32_t choice;
    uint64_t object_count, ignored_count, name_size, shape_count, body_count;
} packed_header;

typedef struct packed_object {
    double pose[7];
    uint32_t name, body; ///< the place of its name; its body
} packed_object;

/// Kinds of bodies, and the flags of a mesh.
enum { PACKED_SHAPE = 0, PACKED_MESH = 1, PACKED_COMPOUND = 2 };
enum { PACKED_PARTS = 1, PACKED_HULL = 2, PACKED_SOLID = 4, PACKED_ASKED = 8, PACKED_TRIANGLES = 16 };

static inline size_t packed_round(size_t size) { return (size + 7) / 8 * 8; }

static inline uint64_t packed_compute_checksum(const packed_header *header) {
    const char *from = (const char *)(&header->checksum + 1);
    return checksum_words(from, (size_t)header->size - (size_t)(from - (const char *)header));
}

/// Reads a packed scene from the bytes, which the scene takes over, or frees where it fails.
ovoid_code scene_unpack(scene_reader *r, bytes file);

/// 1 if the bytes are those of a packed scene, or begin as one and end within its first word.
static inline int packed_is(bytes file) {
    return file.size && memcmp(file.data, PACKED_MAGIC, file.size < 8 ? file.size : 8) == 0;
}

#endif
