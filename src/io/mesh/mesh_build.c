// A mesh under construction. A reader never trusts a count: arrays grow with what the file really holds.
#include "io/mesh/mesh_build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

mesh_part *mesh_add_part(mesh_reader *reader, const char *name, size_t length) {
    ovoid_mesh *mesh = reader->mesh;
    if (mesh->part_count >= OVOID_MESH_PARTS_MAX) {
        io_report(reader->error, OVOID_ERROR_LIMIT, (where){reader->path, 0, -1}, "more than %d parts",
                  OVOID_MESH_PARTS_MAX);
        return NULL;
    }
    char *copy = text_copy(name, length);
    if (!copy || !array_reserve((void **)&mesh->parts, &mesh->part_capacity, mesh->part_count, sizeof(mesh_part))) {
        free(copy);
        io_fail_memory(reader->error, reader->path);
        return NULL;
    }
    mesh_part *part = &mesh->parts[mesh->part_count++];
    *part = (mesh_part){.name = copy};
    return part;
}

ovoid_code mesh_add_point(mesh_reader *reader, mesh_part *part, const double xyz[3], where at) {
    double scaled[3];
    for (int k = 0; k < 3; k++) {
        if (!isfinite(xyz[k]))
            return io_fail(reader->error, OVOID_ERROR_NOT_FINITE, at, "vertex %zu has a coordinate that is %s",
                           reader->mesh->point_count, isnan(xyz[k]) ? "not a number" : "infinite");
        scaled[k] = xyz[k] * reader->scale;
        if (!(fabs(scaled[k]) <= OVOID_LENGTH_MAX))
            return io_fail(reader->error, OVOID_ERROR_RANGE, at, "vertex %zu has the coordinate %g, beyond %g",
                           reader->mesh->point_count, scaled[k], OVOID_LENGTH_MAX);
    }
    if (reader->mesh->point_count >= OVOID_MESH_POINTS_MAX)
        return io_fail(reader->error, OVOID_ERROR_LIMIT, at, "more than %d points", OVOID_MESH_POINTS_MAX);
    if (!array_reserve((void **)&part->points, &part->point_capacity, part->point_count, 3 * sizeof(double)))
        return io_fail_memory(reader->error, reader->path);
    memcpy(part->points + 3 * part->point_count++, scaled, sizeof scaled);
    reader->mesh->point_count++;
    return OVOID_OK;
}

ovoid_code mesh_add_index(mesh_reader *reader, mesh_part *part, uint32_t index) {
    if (reader->mesh->index_count++ >= MESH_INDICES_MAX)
        return io_fail(reader->error, OVOID_ERROR_LIMIT, (where){reader->path, 0, -1}, "more than %d corners of faces",
                       MESH_INDICES_MAX);
    if (!array_reserve((void **)&part->indices, &part->index_capacity, part->index_count, sizeof(uint32_t)))
        return io_fail_memory(reader->error, reader->path);
    part->indices[part->index_count++] = index;
    return OVOID_OK;
}

ovoid_code mesh_end_face(mesh_reader *reader, mesh_part *part, uint32_t size) {
    if (size < 3) {
        part->index_count -= size;
        return OVOID_OK;
    }
    if (!array_reserve((void **)&part->sizes, &part->face_capacity, part->face_count, sizeof(uint32_t)))
        return io_fail_memory(reader->error, reader->path);
    part->sizes[part->face_count++] = size;
    return OVOID_OK;
}
