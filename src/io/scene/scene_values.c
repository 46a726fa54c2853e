// The values of a scene file: numbers, poses, keys, and the sentences that say where one of them is wrong.
#include "io/scene/scene.h"

#include <string.h>

ovoid_code scene_fail(scene_reader *r, ovoid_code code, const char *key, const char *sentence) {
    // The line of the wrong member, or of the object that lacks one.
    json_step steps[5] = {{"objects", 0}, {NULL, r->index}};
    size_t count = 2;
    char part[40] = "";
    if (r->part != NO_PART) {
        steps[count++] = (json_step){"compound", 0};
        steps[count++] = (json_step){NULL, (size_t)r->part};
        snprintf(part, sizeof part, "part %ld: ", r->part);
    }
    if (key) steps[count++] = (json_step){key, 0};
    where at = {r->path, json_find_line(r->file, steps, count), -1};
    if (r->name) return io_fail(r->error, code, at, "object \"%.60s\": %s%s", r->name, part, sentence);
    return io_fail(r->error, code, at, "object %zu: %s%s", r->index, part, sentence);
}

ovoid_code scene_fail_member(scene_reader *r, ovoid_code code, const char *key, const char *what) {
    char sentence[160];
    snprintf(sentence, sizeof sentence, "\"%.60s\" %s", key, what);
    return scene_fail(r, code, key, sentence);
}

ovoid_code scene_fail_key(scene_reader *r, const char *key, const char *owner, const char *const *words) {
    char sentence[256];
    int length = snprintf(sentence, sizeof sentence, "\"%.60s\" is not a key of %s (", key, owner);
    for (int i = 0; words[i] && length < (int)sizeof sentence; i++)
        length += snprintf(sentence + length, sizeof sentence - (size_t)length, i ? ", %s" : "%s", words[i]);
    if (length < (int)sizeof sentence) snprintf(sentence + length, sizeof sentence - (size_t)length, ")");
    return scene_fail(r, OVOID_ERROR_FORMAT, key, sentence);
}

// ---- values

// Numbers in JSON are finite.
int scene_read_numbers(const json_t *value, double *numbers, size_t count) {
    if (!json_is_array(value) || json_array_size(value) != count) return 0;
    for (size_t i = 0; i < count; i++) {
        const json_t *item = json_array_get(value, i);
        if (!json_is_number(item)) return 0;
        numbers[i] = json_number_value(item);
    }
    return 1;
}

int scene_has_only(json_t *object, const char *const *words, const char **unknown) {
    const char *key;
    json_t *value;
    json_object_foreach(object, key, value) {
        size_t i = 0;
        while (words[i] && strcmp(words[i], key) != 0) i++;
        *unknown = key;
        if (!words[i]) return 0;
    }
    return 1;
}

// ---- objects

ovoid_code scene_read_pose(scene_reader *r, json_t *value, ovoid_pose *pose) {
    *pose = ovoid_pose_make_identity();
    if (!value) return OVOID_OK;
    static const char *const words[] = {"xyz", "quat_wxyz", "rpy", NULL};
    const char *unknown;
    if (!json_is_object(value) || !scene_has_only(value, words, &unknown))
        return scene_fail_member(r, OVOID_ERROR_FORMAT, "pose", "must be {\"xyz\", and \"quat_wxyz\" or \"rpy\"}");
    json_t *xyz = json_object_get(value, "xyz"), *quat = json_object_get(value, "quat_wxyz");
    json_t *rpy = json_object_get(value, "rpy");
    double p[3] = {0, 0, 0}, q[4] = {1, 0, 0, 0}, angles[3];
    if (quat && rpy) return scene_fail_member(r, OVOID_ERROR_FORMAT, "pose", "has both quat_wxyz and rpy");
    if (xyz && !scene_read_numbers(xyz, p, 3))
        return scene_fail_member(r, OVOID_ERROR_FORMAT, "pose", "needs three numbers in xyz");
    if (quat && !scene_read_numbers(quat, q, 4))
        return scene_fail_member(r, OVOID_ERROR_FORMAT, "pose", "needs four numbers in quat_wxyz");
    if (rpy && !scene_read_numbers(rpy, angles, 3))
        return scene_fail_member(r, OVOID_ERROR_FORMAT, "pose", "needs three numbers in rpy");
    *pose = (ovoid_pose){{p[0], p[1], p[2]}, {q[0], q[1], q[2], q[3]}};
    if (rpy) *pose = ovoid_pose_make_rpy(pose->position, (ovoid_vec3){angles[0], angles[1], angles[2]});
    ovoid_code code = ovoid_pose_validate(pose);
    if (code == OVOID_ERROR_ROTATION) return scene_fail_member(r, code, "pose", "has a quaternion of four zeros");
    return code ? scene_fail_member(r, code, "pose", "has a number out of range") : OVOID_OK;
}
