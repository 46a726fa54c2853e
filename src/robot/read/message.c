#include "robot/read/message.h"

#include "robot/read/note.h"

#include <math.h>
#include <stdarg.h>
#include <string.h>

void message_report(const message_reader *r, const yaml_value *at, ovoid_code code, const char *format, ...) {
    char sentence[256];
    va_list list;
    va_start(list, format);
    (void)vsnprintf(sentence, sizeof sentence, format, list);
    va_end(list);
    where place = {r->path, at->line, -1};
    if (r->object)
        io_report(r->error, code, place, "object \"%.60s\": %s", r->object, sentence);
    else
        io_report(r->error, code, place, "%s", sentence);
}

void message_note(const message_reader *r, const yaml_value *at, const char *format, ...) {
    va_list list;
    va_start(list, format);
    note_tell(r->options, r->path, at ? at->line : 0, format, list);
    va_end(list);
}

static int is_nothing(const yaml_value *v) {
    return v->kind == YAML_TEXT && (!v->text[0] || strcmp(v->text, "~") == 0 || strcmp(v->text, "null") == 0);
}

ovoid_code message_find(const message_reader *r, const yaml_value *map, const char *key, const yaml_value **member) {
    const yaml_value *found = NULL;
    *member = NULL;
    if (map->kind != YAML_MAP) return message_fail(r, map, OVOID_ERROR_FORMAT, "there must be a map with \"%s\"", key);
    for (const yaml_value *v = map->first; v; v = v->next) {
        if (strcmp(v->key, key) != 0) continue;
        if (found) return message_fail(r, v, OVOID_ERROR_FORMAT, "\"%s\" is there twice", key);
        found = v;
    }
    if (found && !is_nothing(found)) *member = found;
    return OVOID_OK;
}

ovoid_code message_find_kind(const message_reader *r, const yaml_value *map, const char *key, yaml_kind kind,
                             const yaml_value **member) {
    static const char *const words[] = {"a text", "a list", "a map"};
    ovoid_code code = message_find(r, map, key, member);
    if (code || !*member || (*member)->kind == kind) return code;
    return message_fail(r, *member, OVOID_ERROR_FORMAT, "\"%s\" must be %s", key, words[kind]);
}

ovoid_code message_read_text(const message_reader *r, const yaml_value *map, const char *key, const char **text) {
    const yaml_value *member;
    ovoid_code code = message_find_kind(r, map, key, YAML_TEXT, &member);
    if (code) return code;
    *text = pool_copy(r->memory, member ? member->text : "", member ? strlen(member->text) : 0);
    return *text ? OVOID_OK : io_fail_memory(r->error, r->path);
}

ovoid_code message_read_number(const message_reader *r, const yaml_value *value, double *number) {
    const char *end = value->text + strlen(value->text);
    // YAML writes them .nan and .inf; neither is of use.
    if (value->kind != YAML_TEXT || number_read(value->text, end, number) != end)
        return message_fail(r, value, OVOID_ERROR_FORMAT, "\"%.40s\" must be a finite number", value->text);
    if (!isfinite(*number))
        return message_fail(r, value, OVOID_ERROR_NOT_FINITE, "\"%.40s\" is not finite", value->text);
    return OVOID_OK;
}

ovoid_code message_read_numbers(const message_reader *r, const yaml_value *value, const char *const *keys, size_t count,
                                double *numbers) {
    const yaml_value *item = value->first;
    if (value->kind == YAML_TEXT || value->count != count)
        return message_fail(r, value, OVOID_ERROR_FORMAT, "there must be %zu numbers: [...] or {%s: ...}", count,
                            keys[0]);
    for (size_t i = 0; i < count; i++) {
        ovoid_code code = value->kind == YAML_MAP ? message_find(r, value, keys[i], &item) : OVOID_OK;
        if (!code && !item) code = message_fail(r, value, OVOID_ERROR_FORMAT, "\"%s\" is missing", keys[i]);
        if (!code) code = message_read_number(r, item, &numbers[i]);
        if (code) return code;
        item = item->next;
    }
    return OVOID_OK;
}

ovoid_code message_read_pose(const message_reader *r, const yaml_value *value, ovoid_pose *pose) {
    static const char *const keys[] = {"x", "y", "z", "w"};
    const yaml_value *position, *orientation;
    double p[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1};
    *pose = ovoid_pose_make_identity();
    if (!value) return OVOID_OK;
    ovoid_code code = message_find(r, value, "position", &position);
    if (!code) code = message_find(r, value, "orientation", &orientation);
    if (!code && position) code = message_read_numbers(r, position, keys, 3, p);
    if (!code && orientation) code = message_read_numbers(r, orientation, keys, 4, q);
    if (code) return code;
    *pose = (ovoid_pose){{p[0], p[1], p[2]}, {q[3], q[0], q[1], q[2]}};
    code = ovoid_pose_compute_check(pose);
    if (code == OVOID_ERROR_ROTATION) return message_fail(r, value, code, "the pose has a quaternion of four zeros");
    return code ? message_fail(r, value, code, "the pose has a number above %g", OVOID_LENGTH_MAX) : OVOID_OK;
}

void message_note_others(const message_reader *r, const yaml_value *map, const char *known) {
    for (const yaml_value *v = map->first; v && map->kind == YAML_MAP; v = v->next) {
        const char *at = known;
        size_t length = strlen(v->key);
        while (at && !(strncmp(at, v->key, length) == 0 && (!at[length] || at[length] == '|')))
            at = (at = strchr(at, '|')) ? at + 1 : NULL;
        if (!at) message_note(r, v, "\"%.60s\" is not read", v->key);
    }
}
