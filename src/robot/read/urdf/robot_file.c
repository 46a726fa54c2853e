// A robot from its files: reads them and hands out views. One tree of XML is in memory at a time for each file.
#include "robot/read/urdf/reader.h"

#include <stdlib.h>
#include <string.h>

static const ovoid_robot_read_options no_options;

static ovoid_code validate_options(const robot_reader *r) {
    const ovoid_robot_read_options *o = r->options;
    where at = {r->path, 0, -1};
    if (o->shape && o->shape->radius != 0)
        return io_fail(r->error, OVOID_ERROR_ARGUMENT, at,
                       "a robot's shapes have no radius; give links padding instead");
    if (!(o->tolerance >= 0))
        return io_fail(r->error, OVOID_ERROR_ARGUMENT, at, "the tolerance of cylinders is not a length >= 0");
    for (size_t i = 0; i < o->package_count; i++)
        if (!o->packages[i].name || !o->packages[i].name[0] || !o->packages[i].folder)
            return io_fail(r->error, OVOID_ERROR_ARGUMENT, at, "package %zu has no name or no folder", i);
    for (size_t i = 0; i < o->scale_count; i++)
        if (!(o->scales[i].factor > 0 && o->scales[i].factor <= OVOID_LENGTH_MAX))
            return io_fail(r->error, OVOID_ERROR_ARGUMENT, at, "scale %zu has the factor %g; it must be above zero", i,
                           o->scales[i].factor);
    return OVOID_OK;
}

// A text, or the file of its path.
static ovoid_code read_root(const robot_reader *r, const ovoid_robot_text *text, pool *memory, xml_element **root) {
    if (!text->data) return xml_read(text->path, memory, root, r->error);
    if (text->size > XML_SIZE_MAX)
        return io_fail(r->error, OVOID_ERROR_LIMIT, (where){text->path, 0, -1}, "the text has %zu bytes, above %zu",
                       text->size, XML_SIZE_MAX);
    return xml_read_text(text->path, (bytes){(char *)text->data, text->size}, memory, root, r->error);
}

static ovoid_code read_part(robot_reader *r, const ovoid_robot_text *text,
                            ovoid_code (*read)(robot_reader *, const xml_element *)) {
    xml_element *root;
    r->path = text->path;
    ovoid_code code = read_root(r, text, &r->scratch, &root);
    return code ? code : read(r, root);
}

ovoid_robot_file *ovoid_robot_file_read(const char *urdf, const char *srdf, const ovoid_robot_read_options *options,
                                        ovoid_error *error) {
    const ovoid_robot_text texts[2] = {{urdf, NULL, 0}, {srdf, NULL, 0}};
    return ovoid_robot_file_read_text(&texts[0], srdf ? &texts[1] : NULL, options, error);
}

ovoid_robot_file *ovoid_robot_file_read_text(const ovoid_robot_text *urdf, const ovoid_robot_text *srdf,
                                             const ovoid_robot_read_options *options, ovoid_error *error) {
    robot_reader r = {.path = urdf->path, .options = options ? options : &no_options, .error = error};
    r.file = calloc(1, sizeof *r.file);
    ovoid_code code = r.file ? validate_options(&r) : robot_fail_memory(&r);
    if (!code) code = read_part(&r, urdf, urdf_read);
    if (!code && srdf) code = read_part(&r, srdf, srdf_read);
    if (!code) code = robot_finish_ignored(&r);
    pool_clear(&r.scratch);
    free(r.ignored);
    free(r.unknown);
    if (!code) return r.file;
    ovoid_robot_file_destroy(r.file);
    return NULL;
}

void ovoid_robot_file_destroy(ovoid_robot_file *file) {
    if (!file) return;
    for (size_t i = 0; i < file->shape_count; i++) ovoid_shape_destroy(file->shapes[i]);
    for (size_t i = 0; i < file->solid_count; i++) ovoid_solid_destroy(file->solids[i]);
    free(file->shapes);
    free(file->solids);
    pool_clear(&file->memory);
    free(file);
}

ovoid_robot_description ovoid_robot_file_get_description(const ovoid_robot_file *file) { return file->description; }

size_t ovoid_robot_file_get_mesh_count(const ovoid_robot_file *file) { return file->mesh_count; }
ovoid_robot_mesh ovoid_robot_file_get_mesh(const ovoid_robot_file *file, size_t i) { return file->meshes[i]; }

size_t ovoid_robot_file_get_ignored_count(const ovoid_robot_file *file) { return file->ignored_count; }
ovoid_robot_ignored ovoid_robot_file_get_ignored(const ovoid_robot_file *file, size_t i) { return file->ignored[i]; }

size_t ovoid_robot_file_get_fixed_mimic_count(const ovoid_robot_file *file) { return file->fixed_mimic_count; }

size_t ovoid_robot_file_get_group_count(const ovoid_robot_file *file) { return file->group_count; }
ovoid_robot_group ovoid_robot_file_get_group(const ovoid_robot_file *file, size_t i) { return file->groups[i]; }

size_t ovoid_robot_file_get_end_effector_count(const ovoid_robot_file *file) { return file->effector_count; }
ovoid_robot_end_effector ovoid_robot_file_get_end_effector(const ovoid_robot_file *file, size_t i) {
    return file->effectors[i];
}

size_t ovoid_robot_file_get_state_count(const ovoid_robot_file *file) { return file->state_count; }
ovoid_robot_state ovoid_robot_file_get_state(const ovoid_robot_file *file, size_t i) { return file->states[i]; }

const ovoid_robot_link_sphere *ovoid_robot_file_get_spheres(const ovoid_robot_file *file, size_t *count) {
    *count = file->sphere_count;
    return file->spheres;
}

const uint32_t *ovoid_robot_file_get_passive(const ovoid_robot_file *file, size_t *count) {
    *count = file->passive_count;
    return file->passive;
}
