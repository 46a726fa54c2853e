// Files of spheres. Numbers have 17 digits, and spheres stand in their link's frame without a rotation, so what is read
// again is the same doubles, and what was proven of them holds.
#include "robot/spheres/spheres.h"
#include "robot/xml_text.h"

#include "base/finish.h"
#include "base/message.h"
#include "base/outputs.h"
#include "io/fields.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/// A file that is written again.
typedef struct source {
    const char *path;
    char *text;
    size_t size;
} source;

/// Reads a text; 0 after a message.
static int read_source(source *s) {
    FILE *file = fopen(s->path, "rb");
    char *text = NULL;
    FILE *memory = open_memstream(&text, &s->size);
    char block[4096];
    size_t size;
    int good = file && memory;
    while (good && (size = fread(block, 1, sizeof block, file)) > 0) good = fwrite(block, 1, size, memory) == size;
    if (good) good = !ferror(file);
    if (!good) message_error("%s: cannot be read again: %s", s->path, strerror(errno));
    if (file) (void)fclose(file); // it was read
    if (memory && fclose(memory) != 0) good = 0;
    s->text = text;
    if (good && memchr(text, 0, s->size)) {
        message_error("%s: is no UTF-8, so it cannot be written again with spheres: choose .srdf or .csv", s->path);
        good = 0;
    }
    return good;
}

/// Writes a text up to `end`, without the blanks before that.
static void write_until(FILE *file, const char *text, const char *end) {
    while (end > text && strchr(" \t\r\n", end[-1])) end--;
    (void)fwrite(text, 1, (size_t)(end - text), file);
}

// ---- URDF

static void write_collisions(FILE *file, const sphere_list *list, uint32_t link) {
    size_t count, first = sphere_list_find(list, link, &count);
    for (size_t i = first; i < first + count; i++) {
        const ovoid_robot_sphere *s = &list->items[i].ball;
        fprintf(file, "\n    <collision><origin xyz=\"%.17g %.17g %.17g\"/><geometry><sphere radius=\"%.17g\"/>",
                s->center.x, s->center.y, s->center.z, s->radius);
        fputs("</geometry></collision>", file);
    }
}

/// The link that a start tag names, if it has spheres; else NONE.
static uint32_t find_named(const cli_cell *cell, const sphere_list *list, const xml_tag *tag, const char *key) {
    char name[1024];
    size_t count = 0;
    if (!xml_tag_read_attribute(tag, key, name, sizeof name)) return OVOID_ROBOT_NONE;
    uint32_t link = ovoid_robot_find_link(cell->robot.robot, name);
    if (link != OVOID_ROBOT_NONE) (void)sphere_list_find(list, link, &count);
    return count ? link : OVOID_ROBOT_NONE;
}

/// The robot's text, in which links that have spheres have no other collision elements. How many links were found.
static size_t write_urdf(FILE *file, const cli_cell *cell, const sphere_list *list, const source *s) {
    const char *at = s->text, *end = s->text + s->size, *written = s->text;
    uint32_t link = OVOID_ROBOT_NONE;
    size_t depth = 0, found = 0;
    int is_dropping = 0;
    for (xml_tag tag; xml_find_tag(&at, end, &tag);) {
        if (tag.is_end) depth--;
        if (!tag.is_end && depth == 1 && xml_tag_is(&tag, "link")) {
            link = tag.is_empty ? OVOID_ROBOT_NONE : find_named(cell, list, &tag, "name");
        } else if (depth == 2 && link != OVOID_ROBOT_NONE && xml_tag_is(&tag, "collision")) {
            if (!tag.is_end) write_until(file, written, tag.begin);
            is_dropping = !tag.is_end && !tag.is_empty;
            if (!is_dropping) written = tag.end;
        } else if (tag.is_end && depth == 1 && link != OVOID_ROBOT_NONE) {
            write_until(file, written, tag.begin);
            write_collisions(file, list, link);
            fputs("\n  ", file);
            written = tag.begin;
            link = OVOID_ROBOT_NONE;
            found++;
        }
        if (!tag.is_end && !tag.is_empty) depth++;
    }
    (void)fwrite(written, 1, (size_t)(end - written), file);
    return found;
}

// ---- SRDF

static void write_approximations(FILE *file, const cli_cell *cell, const sphere_list *list) {
    for (size_t i = 0; i < list->count; i++) {
        const ovoid_robot_link_sphere *s = &list->items[i];
        if (i == 0 || s[-1].link != s->link) {
            fputs("\n  <link_sphere_approximation", file);
            xml_write_attribute(file, "link", cell->description.links[s->link].name);
            fputc('>', file);
        }
        fprintf(file, "\n    <sphere center=\"%.17g %.17g %.17g\" radius=\"%.17g\"/>", s->ball.center.x,
                s->ball.center.y, s->ball.center.z, s->ball.radius);
        if (i + 1 == list->count || s[1].link != s->link) fputs("\n  </link_sphere_approximation>", file);
    }
}

static void write_new_srdf(FILE *file, const cli_cell *cell, const sphere_list *list) {
    fputs("<?xml version=\"1.0\"?>\n<robot", file);
    xml_write_attribute(file, "name", cell->description.name ? cell->description.name : "");
    fputc('>', file);
    write_approximations(file, cell, list);
    fputs("\n</robot>\n", file);
}

/// The text of an SRDF, with these spheres in the place of those of the same links. 0 where its root has no end tag.
static size_t write_srdf(FILE *file, const cli_cell *cell, const sphere_list *list, const source *s) {
    const char *at = s->text, *end = s->text + s->size, *written = s->text;
    size_t depth = 0, found = 0;
    int is_dropping = 0;
    for (xml_tag tag; xml_find_tag(&at, end, &tag);) {
        if (tag.is_end) depth--;
        if (depth == 1 && xml_tag_is(&tag, "link_sphere_approximation")) {
            int is_replaced = !tag.is_end && find_named(cell, list, &tag, "link") != OVOID_ROBOT_NONE;
            if (is_replaced) write_until(file, written, tag.begin);
            if (is_replaced || (tag.is_end && is_dropping)) written = tag.end;
            is_dropping = is_replaced && !tag.is_empty;
        } else if (tag.is_end && depth == 0) {
            write_until(file, written, tag.begin);
            write_approximations(file, cell, list);
            fputc('\n', file);
            written = tag.begin;
            found++;
        }
        if (!tag.is_end && !tag.is_empty) depth++;
    }
    (void)fwrite(written, 1, (size_t)(end - written), file);
    return found;
}

// ---- tables

static void write_csv(FILE *file, const cli_cell *cell, const sphere_list *list) {
    fputs("link,x,y,z,radius\n", file);
    for (size_t i = 0; i < list->count; i++) {
        const ovoid_robot_sphere *s = &list->items[i].ball;
        cell_write_field(file, cell->description.links[list->items[i].link].name);
        fprintf(file, ",%.17g,%.17g,%.17g,%.17g\n", s->center.x, s->center.y, s->center.z, s->radius);
    }
}

static void write_json(FILE *file, const cli_cell *cell, const sphere_list *list) {
    fputs("{\"collision_spheres\":{", file);
    for (size_t i = 0; i < list->count; i++) {
        const ovoid_robot_link_sphere *s = &list->items[i];
        int is_first = i == 0 || s[-1].link != s->link;
        if (is_first) {
            fputs(i ? "]," : "", file);
            ovoid_text_write_json(file, cell->description.links[s->link].name);
            fputs(":[", file);
        }
        fprintf(file, "%s{\"center\":[%.17g,%.17g,%.17g],\"radius\":%.17g}", is_first ? "" : ",", s->ball.center.x,
                s->ball.center.y, s->ball.center.z, s->ball.radius);
    }
    fputs(list->count ? "]}}\n" : "}}\n", file);
}

static size_t count_links(const sphere_list *list) {
    size_t count = 0;
    for (size_t i = 0; i < list->count; i++) count += i == 0 || list->items[i].link != list->items[i - 1].link;
    return count;
}

/// Writes the file's content. 0, or an exit code after a message.
static int write_content(FILE *file, const char *path, const cli_cell *cell, const sphere_list *list, source *s) {
    if (outputs_has_extension(path, "csv")) return write_csv(file, cell, list), 0;
    if (outputs_has_extension(path, "json")) return write_json(file, cell, list), 0;
    if (!s->path) return write_new_srdf(file, cell, list), 0;
    if (!read_source(s)) return EXIT_INPUT;
    int is_urdf = outputs_has_extension(path, "urdf");
    size_t wanted = is_urdf ? count_links(list) : 1;
    size_t found = is_urdf ? write_urdf(file, cell, list, s) : write_srdf(file, cell, list, s);
    if (found == wanted) return 0;
    message_error("%s: %zu of %zu elements could be written again with spheres; choose .csv, and write them by hand",
                  s->path, found, wanted);
    return EXIT_INPUT;
}

int spheres_write(const char *path, const cli_cell *cell, const sphere_list *list, const char *urdf, const char *srdf) {
    ovoid_output *output = finish_open(path);
    if (!output) return EXIT_INPUT;
    source s = {.path = outputs_has_extension(path, "urdf") ? urdf : srdf};
    int code = write_content(ovoid_output_get_file(output), path, cell, list, &s);
    free(s.text);
    return finish_close(output, code);
}
