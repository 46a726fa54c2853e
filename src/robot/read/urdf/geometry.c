// The collision geometry of a URDF's links: it is read whole before any mesh is looked for, and all meshes are found
// before any shape is made, so that those that are absent are told at once. Cost: n log n, plus the shapes.
#include "robot/read/urdf/geometry.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// ---- reading

// A length that must not be negative.
static ovoid_code read_size(robot_reader *r, const xml_element *e, const char *name, double *size) {
    ovoid_code code = robot_read_number(r, e, name, size);
    if (code || *size >= 0) return code;
    return robot_fail(r, e, OVOID_ERROR_RADIUS, "<%s %s=\"%g\"> is below zero", e->name, name, *size);
}

static ovoid_code read_box(robot_reader *r, const xml_element *e, double size[3]) {
    const char *text;
    ovoid_code code = robot_get_text(r, e, "size", &text);
    if (code) return code;
    if (robot_read_numbers(r, e, "size", size, 3) < 0) return OVOID_ERROR_FORMAT;
    for (int k = 0; k < 3; k++)
        if (size[k] < 0)
            return robot_fail(r, e, OVOID_ERROR_RADIUS, "<box size=\"%.60s\"> has a size below zero", text);
    return OVOID_OK;
}

static ovoid_code read_mesh(robot_reader *r, const xml_element *e, geometry *g) {
    double *scale = g->what.size;
    scale[0] = scale[1] = scale[2] = 1;
    ovoid_code code = robot_get_text(r, e, "filename", &g->address);
    if (code) return code;
    if (robot_read_numbers(r, e, "scale", scale, 3) < 0) return OVOID_ERROR_FORMAT;
    if (scale[0] == 0 || scale[1] == 0 || scale[2] == 0)
        return robot_fail(r, e, OVOID_ERROR_FORMAT, "<mesh scale=\"%.60s\"> has a factor of zero", xml_get(e, "scale"));
    return OVOID_OK;
}

static ovoid_code read_shape(robot_reader *r, const xml_element *e, geometry *g) {
    static const char *const words[] = {"box", "sphere", "capsule", "cylinder"};
    size_t kind = 0;
    while (kind < 4 && !xml_is(e, words[kind])) kind++;
    g->what.kind = kind < 4 ? (primitive_kind)kind : PRIMITIVE_MESH;
    if (kind == 0) return read_box(r, e, g->what.size);
    if (kind < 4) {
        ovoid_code code = read_size(r, e, "radius", &g->what.size[0]);
        return code || kind == 1 ? code : read_size(r, e, "length", &g->what.size[1]);
    }
    if (xml_is(e, "mesh")) return read_mesh(r, e, g);
    return robot_fail(r, e, OVOID_ERROR_FORMAT,
                      "<%.60s> is no geometry; there are box, sphere, capsule, cylinder, mesh", e->name);
}

static ovoid_code read_geometry(robot_reader *r, const xml_element *e, geometry *g) {
    const xml_element *origin, *shape;
    ovoid_code code = robot_ignore_others(r, e, "origin|geometry");
    if (!code) code = robot_get_child(r, e, "origin", &origin);
    if (!code) code = robot_read_origin(r, origin, &g->pose);
    if (!code) code = robot_get_child(r, e, "geometry", &shape);
    if (code) return code;
    if (!shape || !shape->first) return robot_fail(r, e, OVOID_ERROR_FORMAT, "<%s> needs a <geometry>", e->name);
    if (shape->first->next)
        return robot_fail(r, shape->first->next, OVOID_ERROR_FORMAT,
                          "<geometry> holds more than one shape; give each a <%s> of its own", e->name);
    const char *name = xml_get(e, "name");
    g->at = shape->first;
    g->address = g->path = "";
    if (name && *name && !(g->name = pool_copy(&r->file->memory, name, strlen(name)))) return robot_fail_memory(r);
    return read_shape(r, g->at, g);
}

// ---- scales

// The factor of a link: its own, or that of all that have none.
static double find_factor(const ovoid_robot_read_options *o, const char *link) {
    double factor = 1;
    for (size_t i = 0; i < o->scale_count; i++) {
        if (o->scales[i].link && strcmp(o->scales[i].link, link) == 0) return o->scales[i].factor;
        if (!o->scales[i].link) factor = o->scales[i].factor;
    }
    return factor;
}

static ovoid_code validate_scales(const robot_reader *r) {
    const ovoid_robot_read_options *o = r->options;
    where at = {r->path, 0, -1};
    for (size_t i = 0; i < o->scale_count; i++) {
        const char *link = o->scales[i].link;
        if (link && name_index_find(&r->link_names, link) == UINT32_MAX)
            return io_fail(r->error, OVOID_ERROR_ARGUMENT, at, "there is no link \"%.60s\" to scale", link);
        for (size_t k = 0; k < i; k++)
            if (link == o->scales[k].link || (link && o->scales[k].link && strcmp(link, o->scales[k].link) == 0))
                return io_fail(r->error, OVOID_ERROR_ARGUMENT, at, "there are two scales of %s%.60s",
                               link ? "link " : "all links", link ? link : "");
    }
    return OVOID_OK;
}

// ---- links

// The word of the elements that are a link's geometry.
static const char *choose(const robot_reader *r, const xml_element *link) {
    return r->options->visual && !xml_find(link, "collision") ? "visual" : "collision";
}

static ovoid_code read_link(robot_reader *r, const xml_element *link, uint32_t index, geometry_list *list) {
    const char *word = choose(r, link);
    ovoid_code code = robot_ignore_others(r, link, word);
    double factor = find_factor(r->options, r->file->description.links[index].name);
    for (const xml_element *e = link->first; e && !code; e = e->next) {
        if (!xml_is(e, word)) continue;
        geometry *g = &list->items[list->count];
        g->link = index;
        g->index = (uint32_t)list->count++;
        code = read_geometry(r, e, g);
        for (int k = 0; k < 3; k++) g->what.size[k] *= factor;
    }
    return code;
}

// What has only visual geometry is not compared with anything: the caller is told of which links that is so.
static void tell_visual(const robot_reader *r, const xml_element *const *links) {
    char names[160] = "";
    size_t count = 0, used = 0;
    const xml_element *first = NULL;
    for (size_t i = 0; i < r->file->description.link_count && !r->options->visual; i++) {
        if (!xml_find(links[i], "visual") || xml_find(links[i], "collision")) continue;
        if (!count++) first = links[i];
        const char *name = r->file->description.links[i].name;
        size_t length = strlen(name);
        if (used + length + 8 > sizeof names) continue;
        used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", name);
    }
    if (count)
        robot_note(r, first, "%zu link%s only <visual> geometry, which is not compared: %s%s", count,
                   count == 1 ? " has" : "s have", names, count > 1 && used + 8 > sizeof names ? ", ..." : "");
}

static ovoid_code read_all(robot_reader *r, const xml_element *const *links, geometry_list *list) {
    size_t most = 0, link_count = r->file->description.link_count;
    for (size_t i = 0; i < link_count; i++)
        for (const xml_element *e = links[i]->first; e; e = e->next) most++;
    list->items = pool_get(&r->scratch, most, sizeof *list->items);
    list->order = pool_get(&r->scratch, most, sizeof *list->order);
    if (!list->items || !list->order) return robot_fail_memory(r);
    ovoid_code code = OVOID_OK;
    for (uint32_t i = 0; i < link_count && !code; i++) code = read_link(r, links[i], i, list);
    if (!code) tell_visual(r, links);
    return code;
}

void geometry_sort(geometry_list *list, int (*compare)(const void *, const void *)) {
    for (size_t i = 0; i < list->count; i++) list->order[i] = &list->items[i];
    if (list->count) qsort(list->order, list->count, sizeof *list->order, compare);
}

// ---- elements

static ovoid_code make_elements(robot_reader *r, const geometry_list *list) {
    ovoid_robot_file *file = r->file;
    size_t count = 0, n = 0;
    for (size_t i = 0; i < list->count; i++) count += list->items[i].shape_count;
    ovoid_robot_element *elements = pool_get(&file->memory, count, sizeof *elements);
    if (!elements) return robot_fail_memory(r);
    for (size_t i = 0; i < list->count; i++) {
        const geometry *g = &list->items[i];
        for (size_t k = 0; k < g->shape_count; k++) {
            const char *name = g->part_names && g->part_names[k] ? g->part_names[k] : g->name;
            elements[n++] = (ovoid_robot_element){g->link, name, file->shapes[g->shape + k], g->pose, g->solid};
        }
    }
    file->description.elements = elements;
    file->description.element_count = count;
    return OVOID_OK;
}

ovoid_code geometry_read(robot_reader *r, const xml_element *const *links) {
    geometry_list list = {NULL, NULL, 0};
    ovoid_code code = validate_scales(r);
    if (!code) code = read_all(r, links, &list);
    if (!code) code = geometry_find(r, &list);
    if (!code) code = geometry_make(r, &list);
    return code ? code : make_elements(r, &list);
}
