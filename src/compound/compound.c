// Creating a compound in one block of memory; its accessors.
#include "compound/compound.h"

#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "linear/pose.h"
#include "linear/rotation.h"

// OVOID_OK, or what is wrong with a part.
static ovoid_code validate_part(const ovoid_posed_shape *part, size_t i, ovoid_error *error) {
    if (!part->shape) return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)i, "part %zu has no shape", i);
    ovoid_code code = pose_validate(&part->pose);
    if (code == OVOID_OK && !(posed_shape_compute_extent(part) <= OVOID_LENGTH_MAX)) code = OVOID_ERROR_RANGE;
    if (code == OVOID_OK) return OVOID_OK;
    const char *what = code == OVOID_ERROR_ROTATION     ? "has a quaternion of four zeros"
                       : code == OVOID_ERROR_NOT_FINITE ? "has a pose with NaN or infinity"
                                                        : "lies beyond the largest length, 1e50";
    return error_set(error, code, (int64_t)i, "part %zu %s", i, what);
}

static ovoid_code validate_parts(const ovoid_posed_shape *parts, size_t count, ovoid_error *error) {
    if (!parts || count == 0) return error_set(error, OVOID_ERROR_EMPTY, -1, "a compound needs at least one part");
    if (count > OVOID_COMPOUND_PARTS_MAX)
        return error_set(error, OVOID_ERROR_LIMIT, -1, "%zu parts, at most %zu are allowed", count,
                         OVOID_COMPOUND_PARTS_MAX);
    for (size_t i = 0; i < count; i++) {
        ovoid_code code = validate_part(&parts[i], i, error);
        if (code != OVOID_OK) return code;
    }
    return OVOID_OK;
}

// The next 64-byte boundary after count items from *at.
static size_t advance(size_t *at, size_t count, size_t size) {
    size_t start = *at;
    *at = (start + count * size + 63) / 64 * 64;
    return start;
}

// The block with its arrays laid out, not yet filled.
static ovoid_compound *create_block(size_t count, const ovoid_allocator *memory) {
    size_t size = 0, header = advance(&size, 1, sizeof(ovoid_compound));
    size_t nodes = advance(&size, 2 * count - 1, sizeof(compound_node));
    size_t parts = advance(&size, count, sizeof(compound_part));
    size_t order = advance(&size, count, sizeof(uint32_t)), places = advance(&size, count, sizeof(uint32_t));
    char *block = allocator_allocate(memory, 1, size);
    if (!block) return NULL;
    ovoid_compound *c = (ovoid_compound *)(void *)(block + header);
    *c = (ovoid_compound){.count = (uint32_t)count, .size = size, .allocator = *memory};
    c->nodes = (compound_node *)(void *)(block + nodes);
    c->parts = (compound_part *)(void *)(block + parts);
    c->order = (uint32_t *)(void *)(block + order);
    c->places = (uint32_t *)(void *)(block + places);
    return c;
}

// All parts' vertices in the compound's frame.
static void pose_vertices(const ovoid_posed_shape *parts, size_t count, parts_vertices *all) {
    size_t at = 0;
    for (size_t i = 0; i < count; i++) {
        const ovoid_shape *shape = parts[i].shape;
        mat3 r = quat_to_mat3(parts[i].pose.rotation);
        all->starts[i] = at;
        for (uint32_t k = 0; k < shape->vertex_count; k++, at++) {
            vec3 v = vec3_add(vec3_at(shape_vertices(shape), k), shape->origin);
            v = vec3_add(parts[i].pose.position, mat3_mul_vec3(r, v));
            all->xyz[3 * at] = v.x, all->xyz[3 * at + 1] = v.y, all->xyz[3 * at + 2] = v.z;
        }
    }
    all->starts[count] = at;
}

// Fills the block from the parts; 0 if memory runs out.
static int fill(ovoid_compound *c, const ovoid_posed_shape *parts, const ovoid_allocator *memory) {
    size_t vertices = 0;
    for (size_t i = 0; i < c->count; i++) {
        vertices += parts[i].shape->vertex_count;
        c->extent = max2(c->extent, posed_shape_compute_extent(&parts[i]));
        c->allowance = max2(c->allowance, shape_get_width(parts[i].shape));
    }
    parts_vertices all = {allocator_allocate(memory, 3 * vertices, sizeof(double)),
                          allocator_allocate(memory, (size_t)c->count + 1, sizeof(size_t))};
    int ok = all.xyz && all.starts;
    if (ok) {
        pose_vertices(parts, c->count, &all);
        ok = tree_build(c, parts, &all) && compound_compute_bounds(c, parts, &all);
    }
    allocator_release(memory, all.xyz);
    allocator_release(memory, all.starts);
    return ok;
}

static ovoid_compound *create(const ovoid_posed_shape *parts, size_t count, const ovoid_compound_options *options,
                              ovoid_error *error) {
    if (validate_parts(parts, count, error) != OVOID_OK) return NULL;
    ovoid_allocator memory = allocator_make(options ? options->allocator : NULL);
    ovoid_compound *c = create_block(count, &memory);
    if (c && fill(c, parts, &memory)) return c;
    allocator_release(&memory, c);
    error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for a compound of %zu parts", count);
    return NULL;
}

ovoid_compound *ovoid_compound_create(const ovoid_posed_shape *parts, size_t count,
                                      const ovoid_compound_options *options, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_compound *, parts, create(parts, count, options, error));
}

void ovoid_compound_destroy(ovoid_compound *compound) {
    if (!compound) return;
    ovoid_allocator memory = compound->allocator;
    ENVIRONMENT_RUN(allocator_release(&memory, compound));
}

size_t ovoid_compound_get_part_count(const ovoid_compound *compound) { return compound->count; }
ovoid_posed_shape ovoid_compound_get_part(const ovoid_compound *compound, size_t i) {
    OVOID_ASSERT(i < compound->count);
    const compound_part *part = &compound->parts[compound->places[i]];
    return (ovoid_posed_shape){part->shape, part->pose};
}
const uint32_t *ovoid_compound_get_order(const ovoid_compound *compound) { return compound->order; }
ovoid_ellipsoid ovoid_compound_get_outer(const ovoid_compound *compound) { return compound->outer; }
ovoid_ellipsoid ovoid_compound_get_inner(const ovoid_compound *compound) { return compound->inner; }
size_t ovoid_compound_get_size(const ovoid_compound *compound) { return compound->size; }
