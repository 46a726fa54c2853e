// An audit of spheres against a link: arguments, memory, the two searches, and their results in the caller's unit.
#include "base/environment.h"
#include "base/error.h"
#include "robot/model/robot.h"
#include "robot/spheres/spheres.h"

enum { CELLS = 1 << 16, CELLS_LEAST = 64 };

// Cells that the search for the deepest point begins with.
static size_t count_roots(const spheres_link *link) {
    size_t count = 0;
    for (uint32_t i = 0; i < link->part_count; i++)
        count += link->parts[i].triangles ? link->parts[i].triangle_count : 6;
    return count;
}

ovoid_code spheres_heap_open(spheres_heap *heap, const spheres_link *link, size_t cells, ovoid_error *error) {
    cells += count_roots(link);
    *heap = (spheres_heap){allocator_allocate(&link->memory, cells, sizeof *heap->cells), 0, cells, NULL};
    return heap->cells ? OVOID_OK : error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for %zu cells", cells);
}

double spheres_link_get_size(const spheres_link *link) { return vec3_norm(vec3_sub(link->box.max, link->box.min)); }

// A length in the caller's unit, a power of two, rounded up: only what underflows is rounded.
static double scale_up(double x, double unit) {
    double scaled = x * unit;
    return x == 0 || fabs(scaled) > 0x1p-1000 ? scaled : scaled + 0x1p-1074;
}

static ovoid_robot_bracket scale_volume(ovoid_robot_bracket b, double unit) {
    // What underflows is below the least number there is.
    double upper = b.upper * unit * unit * unit;
    return (ovoid_robot_bracket){b.lower * unit * unit * unit, b.upper > 0 ? upper + 0x1p-1074 : 0};
}

static ovoid_code audit_link(const spheres_link *link, const spheres_tree *tree, const ovoid_robot_audit_options *o,
                             ovoid_robot_sphere_audit *audit, ovoid_error *error) {
    spheres_heap heap;
    size_t depth_cells = o->depth_cells ? o->depth_cells : CELLS,
           volume_cells = o->volume_cells ? o->volume_cells : CELLS;
    ovoid_code code = spheres_heap_open(&heap, link, depth_cells > volume_cells ? depth_cells : volume_cells, error);
    if (code != OVOID_OK) return code;
    heap.capacity = depth_cells + count_roots(link);
    heap.watch = &o->watch;
    double tolerance = o->tolerance > 0 ? o->tolerance / link->unit : 1e-5 * spheres_link_get_size(link);
    spheres_depth d = spheres_find_depth(link, tree, tolerance, &heap);
    *audit = (ovoid_robot_sphere_audit){.depth = {-scale_up(-d.lower, link->unit), scale_up(d.upper, link->unit)},
                                        .point = vec3_scale(d.point, link->unit),
                                        .element = link->parts[d.part].element,
                                        .sphere = tree->given[d.sphere],
                                        .uncovered = {0, INFINITY},
                                        .excess = {0, INFINITY},
                                        .link = {0, INFINITY},
                                        .spheres = {0, INFINITY},
                                        .cells = d.cells};
    if (!o->without_volumes) {
        heap.capacity = volume_cells;
        spheres_volumes v = spheres_find_volumes(link, tree, &heap, &audit->cells);
        audit->uncovered = scale_volume(v.uncovered, link->unit);
        audit->excess = scale_volume(v.excess, link->unit);
        audit->link = scale_volume(v.link, link->unit);
        audit->spheres = scale_volume(v.spheres, link->unit);
    }
    allocator_release(&link->memory, heap.cells);
    return OVOID_OK;
}

static ovoid_code validate_options(const ovoid_robot_audit_options *o, ovoid_error *error) {
    if (!(o->tolerance >= 0) || isinf(o->tolerance))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "the tolerance %g is no length: give one >= 0", o->tolerance);
    if ((o->depth_cells && o->depth_cells < CELLS_LEAST) || (o->volume_cells && o->volume_cells < CELLS_LEAST))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "fewer than %d cells", CELLS_LEAST);
    if (o->depth_cells > (size_t)1 << 24 || o->volume_cells > (size_t)1 << 24)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "more than 2^24 cells");
    return OVOID_OK;
}

static ovoid_code compute_audit(const ovoid_robot_sphere_model *model, const ovoid_robot_audit_options *options,
                                ovoid_robot_sphere_audit *audit, ovoid_error *error) {
    static const ovoid_robot_audit_options none;
    if (!options) options = &none;
    if (!model || !model->robot || !audit)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "no robot, or no room for the audit (NULL)");
    ovoid_code code = validate_options(options, error);
    if (code == OVOID_OK) code = spheres_validate(model->spheres, model->count, error);
    if (code != OVOID_OK) return code;
    ovoid_allocator memory = allocator_make(options->allocator);
    spheres_link link;
    code = spheres_link_open(&link, model->robot, model->link, &memory, error);
    if (code != OVOID_OK) return code;
    spheres_tree tree;
    code = spheres_tree_open(&tree, model->spheres, model->count, &link, error);
    if (code == OVOID_OK) {
        code = audit_link(&link, &tree, options, audit, error);
        spheres_tree_close(&tree);
    }
    spheres_link_close(&link);
    return code;
}

ovoid_code ovoid_robot_compute_sphere_audit(const ovoid_robot_sphere_model *model,
                                            const ovoid_robot_audit_options *options, ovoid_robot_sphere_audit *audit,
                                            ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, model, compute_audit(model, options, audit, error));
}
