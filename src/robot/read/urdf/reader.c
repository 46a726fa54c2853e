// Errors, notes, ignored elements and the values of attributes.
#include "robot/read/urdf/reader.h"

#include "robot/read/text/note.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

// ---- errors and notes

/// The element itself, or the one around it, that is a child of the root.
static const xml_element *find_top(const xml_element *element) {
    while (element->parent && element->parent->parent) element = element->parent;
    return element;
}

void robot_report(const robot_reader *r, const xml_element *element, ovoid_code code, const char *format, ...) {
    char sentence[256];
    va_list list;
    va_start(list, format);
    (void)vsnprintf(sentence, sizeof sentence, format, list);
    va_end(list);
    const xml_element *top = find_top(element);
    const char *name = top->parent ? xml_get(top, "name") : NULL;
    where at = {r->path, element->line, -1};
    if (name)
        io_report(r->error, code, at, "%.20s \"%.60s\": %s", top->name, name, sentence);
    else
        io_report(r->error, code, at, "%s", sentence);
}

ovoid_code robot_fail_memory(const robot_reader *r) { return io_fail_memory(r->error, r->path); }

void robot_note(const robot_reader *r, const xml_element *element, const char *format, ...) {
    va_list list;
    va_start(list, format);
    note_tell(r->options, r->path, element ? element->line : 0, format, list);
    va_end(list);
}

// ---- ignored elements

ovoid_code robot_ignore(robot_reader *r, const char *parent, const char *between, const char *name) {
    if (!array_reserve((void **)&r->ignored, &r->ignored_capacity, r->ignored_count, sizeof *r->ignored))
        return robot_fail_memory(r);
    r->ignored[r->ignored_count++] = (ignored_name){parent, between, name};
    return OVOID_OK;
}

int robot_is_among(const char *word, const char *words) {
    size_t length = strlen(word);
    for (const char *at = words; at;) {
        const char *bar = strchr(at, '|');
        size_t size = bar ? (size_t)(bar - at) : strlen(at);
        if (size == length && memcmp(at, word, size) == 0) return 1;
        at = bar ? bar + 1 : NULL;
    }
    return 0;
}

ovoid_code robot_ignore_others(robot_reader *r, const xml_element *element, const char *known) {
    ovoid_code code = OVOID_OK;
    for (const xml_element *e = element->first; e && !code; e = e->next)
        if (!robot_is_among(e->name, known)) code = robot_ignore(r, element->name, "/", e->name);
    return code;
}

static int compare_ignored(const void *a, const void *b) {
    const ignored_name *m = a, *n = b;
    int order = strcmp(m->parent, n->parent);
    if (!order) order = strcmp(m->between, n->between);
    return order ? order : strcmp(m->name, n->name);
}

ovoid_code robot_finish_ignored(robot_reader *r) {
    ignored_name *all = r->ignored;
    size_t count = r->ignored_count, kinds = 0;
    if (!count) return OVOID_OK;
    qsort(all, count, sizeof *all, compare_ignored);
    for (size_t i = 0; i < count; i++) kinds += !i || compare_ignored(&all[i], &all[i - 1]) != 0;
    ovoid_robot_file *file = r->file;
    file->ignored = pool_get(&file->memory, kinds, sizeof *file->ignored);
    if (!file->ignored) return robot_fail_memory(r);
    for (size_t i = 0, k = 0; i < count; i++) {
        if (i && compare_ignored(&all[i], &all[i - 1]) == 0) {
            file->ignored[k - 1].count++;
            continue;
        }
        size_t size = strlen(all[i].parent) + strlen(all[i].name) + 2;
        char *text = pool_get(&file->memory, size, 1);
        if (!text) return robot_fail_memory(r);
        (void)snprintf(text, size, "%s%s%s", all[i].parent, all[i].between, all[i].name);
        file->ignored[k++] = (ovoid_robot_ignored){text, 1};
        file->ignored_count = k;
    }
    return OVOID_OK;
}

// ---- unknown names

ovoid_code robot_add_unknown(robot_reader *r, const xml_element *element, const char *kind, const char *name) {
    if (!array_reserve((void **)&r->unknown, &r->unknown_capacity, r->unknown_count, sizeof *r->unknown))
        return robot_fail_memory(r);
    r->unknown[r->unknown_count++] = (unknown_name){kind, name, element};
    return OVOID_OK;
}

static int compare_names(const unknown_name *a, const unknown_name *b) {
    int order = strcmp(a->kind, b->kind);
    return order ? order : strcmp(a->name, b->name);
}

static int compare_unknown(const void *a, const void *b) {
    const unknown_name *m = a, *n = b;
    int order = compare_names(m, n);
    return order ? order : (m->at->line > n->at->line) - (m->at->line < n->at->line);
}

void robot_finish_unknown(const robot_reader *r) {
    if (r->unknown_count) qsort(r->unknown, r->unknown_count, sizeof *r->unknown, compare_unknown);
    for (size_t i = 0, next; i < r->unknown_count; i = next) {
        const unknown_name *u = &r->unknown[i];
        for (next = i + 1; next < r->unknown_count && compare_names(u, &r->unknown[next]) == 0;) next++;
        if (next > i + 1)
            robot_note(r, u->at, "there is no %s %.100s; all %zu places that name it are passed over", u->kind, u->name,
                       next - i);
        else
            robot_note(r, u->at, "there is no %s %.100s; what <%.60s> says of it is passed over", u->kind, u->name,
                       u->at->name);
    }
}

// ---- attributes and children

ovoid_code robot_get_text(const robot_reader *r, const xml_element *element, const char *name, const char **text) {
    *text = xml_get(element, name);
    if (*text && (*text)[0]) return OVOID_OK;
    return robot_fail(r, element, OVOID_ERROR_FORMAT, "<%.40s> needs %s=\"...\"", element->name, name);
}

ovoid_code robot_get_child(const robot_reader *r, const xml_element *element, const char *name,
                           const xml_element **child) {
    *child = NULL;
    for (const xml_element *e = element->first; e; e = e->next) {
        if (!xml_is(e, name)) continue;
        if (*child)
            return robot_fail(r, e, OVOID_ERROR_FORMAT, "<%.40s> has a second <%s>; remove one", element->name, name);
        *child = e;
    }
    return OVOID_OK;
}

static const char *skip_blanks(const char *at) { return at + strspn(at, " \t\r\n"); }

int robot_read_numbers(const robot_reader *r, const xml_element *element, const char *name, double *values,
                       size_t count) {
    const char *text = xml_get(element, name);
    if (!text) return 0;
    const char *at = skip_blanks(text), *end = text + strlen(text);
    size_t found = 0;
    for (; found < count; found++) {
        const char *after = number_read(at, end, &values[found]);
        if (!after || (after < end && !strchr(" \t\r\n", *after))) break;
        if (!isfinite(values[found])) {
            (void)robot_fail(r, element, OVOID_ERROR_NOT_FINITE, "<%.40s %s=\"%.60s\"> is not finite", element->name,
                             name, text);
            return -1;
        }
        at = skip_blanks(after);
    }
    if (found == count && at == end) return 1;
    (void)robot_fail(r, element, OVOID_ERROR_FORMAT, "<%.40s %s=\"%.60s\"> must be %s", element->name, name, text,
                     count == 1   ? "a number"
                     : count == 3 ? "three numbers with blanks between"
                                  : "numbers with blanks between");
    return -1;
}

ovoid_code robot_read_number(const robot_reader *r, const xml_element *element, const char *name, double *value) {
    const char *text;
    ovoid_code code = robot_get_text(r, element, name, &text);
    if (!code && robot_read_numbers(r, element, name, value, 1) < 0) code = OVOID_ERROR_FORMAT;
    return code;
}

ovoid_code robot_read_origin(const robot_reader *r, const xml_element *origin, ovoid_pose *pose) {
    *pose = ovoid_pose_make_identity();
    if (!origin) return OVOID_OK;
    double xyz[3] = {0, 0, 0}, rpy[3] = {0, 0, 0}, q[4];
    int has_xyz = robot_read_numbers(r, origin, "xyz", xyz, 3);
    int has_rpy = has_xyz < 0 ? -1 : robot_read_numbers(r, origin, "rpy", rpy, 3);
    int has_quat = has_rpy < 0 ? -1 : robot_read_numbers(r, origin, "quat_xyzw", q, 4);
    if (has_quat < 0) return OVOID_ERROR_FORMAT;
    if (has_rpy && has_quat) return robot_fail(r, origin, OVOID_ERROR_FORMAT, "<origin> has both rpy and quat_xyzw");
    ovoid_vec3 position = {xyz[0], xyz[1], xyz[2]};
    *pose = ovoid_pose_make_rpy(position, (ovoid_vec3){rpy[0], rpy[1], rpy[2]});
    if (has_quat) pose->rotation = (ovoid_quat){q[3], q[0], q[1], q[2]};
    ovoid_code code = ovoid_pose_validate(pose);
    if (code == OVOID_ERROR_ROTATION) return robot_fail(r, origin, code, "<origin> has a quaternion of four zeros");
    return code ? robot_fail(r, origin, code, "<origin> has a number above %g", OVOID_LENGTH_MAX) : OVOID_OK;
}
