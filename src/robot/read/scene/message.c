#include "robot/read/scene/message.h"

#include "robot/read/text/note.h"

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
    ovoid_code code = message_refuse_others(r, value, "position|orientation");
    if (!code) code = message_find(r, value, "position", &position);
    if (!code) code = message_find(r, value, "orientation", &orientation);
    if (!code && position) code = message_read_numbers(r, position, keys, 3, p);
    if (!code && orientation) code = message_read_numbers(r, orientation, keys, 4, q);
    if (code) return code;
    *pose = (ovoid_pose){{p[0], p[1], p[2]}, {q[3], q[0], q[1], q[2]}};
    code = ovoid_pose_validate(pose);
    if (code == OVOID_ERROR_ROTATION) return message_fail(r, value, code, "the pose has a quaternion of four zeros");
    return code ? message_fail(r, value, code, "the pose has a number above %g", OVOID_LENGTH_MAX) : OVOID_OK;
}

// 1: one of "one|two" is the key.
static int is_known(const char *key, const char *known) {
    size_t length = strlen(key);
    for (const char *at = known; at; at = (at = strchr(at, '|')) ? at + 1 : NULL)
        if (strncmp(at, key, length) == 0 && (!at[length] || at[length] == '|')) return 1;
    return 0;
}

ovoid_code message_refuse_others(const message_reader *r, const yaml_value *map, const char *known) {
    if (map->kind != YAML_MAP) return OVOID_OK;
    for (const yaml_value *v = map->first; v; v = v->next)
        if (!is_known(v->key, known))
            return message_fail(r, v, OVOID_ERROR_FORMAT,
                                "\"%.60s\" is no key that is read here; take it out if nothing depends on it", v->key);
    return OVOID_OK;
}

ovoid_code message_refuse_filled(const message_reader *r, const yaml_value *map, const char *key, const char *why) {
    const yaml_value *v;
    ovoid_code code = message_find(r, map, key, &v);
    if (code || !v || (v->kind != YAML_TEXT && v->count == 0)) return code;
    return message_fail(r, v, OVOID_ERROR_FORMAT, "\"%s\" %s", key, why);
}

ovoid_code message_read_frame(const message_reader *r, const yaml_value *header, const char **frame) {
    ovoid_code code = message_refuse_others(r, header, "frame_id|stamp|seq");
    if (!code) code = message_read_text(r, header, "frame_id", frame);
    // ROS 1 wrote names with a slash before them.
    if (!code && (*frame)[0] == '/') ++*frame;
    return code;
}

ovoid_code message_read_transform(const message_reader *r, const yaml_value *value, double values[7]) {
    static const char *const keys[] = {"x", "y", "z", "w"};
    const yaml_value *translation, *rotation;
    double q[4] = {0, 0, 0, 1};
    ovoid_code code = message_refuse_others(r, value, "translation|rotation");
    if (!code) code = message_find(r, value, "translation", &translation);
    if (!code) code = message_find(r, value, "rotation", &rotation);
    if (code) return code;
    values[0] = values[1] = values[2] = 0;
    if (translation) code = message_read_numbers(r, translation, keys, 3, values);
    if (!code && rotation) code = message_read_numbers(r, rotation, keys, 4, q);
    if (!code && q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0)
        code = message_fail(r, rotation, OVOID_ERROR_ROTATION, "a rotation is a quaternion of four zeros");
    values[3] = q[3], values[4] = q[0], values[5] = q[1], values[6] = q[2];
    return code;
}

int transform_is_identity(const double v[7]) {
    return v[0] == 0 && v[1] == 0 && v[2] == 0 && v[4] == 0 && v[5] == 0 && v[6] == 0;
}
