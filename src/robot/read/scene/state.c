// The state, frames, paddings and allowed collisions of a planning scene, with the meaning that MoveIt gives them
// (moveit_core: PlanningScene::setPlanningSceneMsg, AllowedCollisionMatrix, Transforms). Cost: linear in the file, and
// n log n for names.
#include "robot/read/scene/state.h"

#include <string.h>

static ovoid_code keep_text(const message_reader *r, const char *text, const char **kept) {
    *kept = pool_copy(r->memory, text, strlen(text));
    return *kept ? OVOID_OK : io_fail_memory(r->error, r->path);
}

// The items of a list that may be absent.
static const yaml_value *get_first(const yaml_value *list) { return list ? list->first : NULL; }
static size_t get_count(const yaml_value *list) { return list ? list->count : 0; }

// ---- the state

// The lists of names and of what belongs to each: as many.
static ovoid_code find_lists(const message_reader *r, const yaml_value *map, const char *const keys[2],
                             const yaml_value *lists[2]) {
    lists[0] = lists[1] = NULL;
    ovoid_code code = map ? message_find_kind(r, map, keys[0], YAML_LIST, &lists[0]) : OVOID_OK;
    if (!code && map) code = message_find_kind(r, map, keys[1], YAML_LIST, &lists[1]);
    if (code || get_count(lists[0]) == get_count(lists[1])) return code;
    return message_fail(r, map, OVOID_ERROR_FORMAT, "there are %zu %s but %zu %s", get_count(lists[0]), keys[0],
                        get_count(lists[1]), keys[1]);
}

static ovoid_code read_joint(const message_reader *r, const yaml_value *name, const yaml_value *value, int is_multiple,
                             scene_state *state) {
    scene_joint *joint = &state->joints[state->joint_count++];
    joint->is_multiple = is_multiple;
    joint->line = name->line;
    if (name->kind != YAML_TEXT) return message_fail(r, name, OVOID_ERROR_FORMAT, "a joint's name must be a text");
    ovoid_code code = keep_text(r, name->text, &joint->name);
    if (code) return code;
    return is_multiple ? message_read_transform(r, value, joint->values) : message_read_number(r, value, joint->values);
}

static ovoid_code read_joints(const message_reader *r, const yaml_value *robot, scene_state *state) {
    static const char *const maps[2] = {"joint_state", "multi_dof_joint_state"};
    static const char *const keys[2][2] = {{"name", "position"}, {"joint_names", "transforms"}};
    static const char *const others[2] = {"header|name|position|velocity|effort",
                                          "header|joint_names|transforms|twist|wrench"};
    const yaml_value *lists[2][2];
    for (int i = 0; i < 2; i++) {
        const yaml_value *map;
        ovoid_code code = message_find_kind(r, robot, maps[i], YAML_MAP, &map);
        if (!code && map) code = message_refuse_others(r, map, others[i]);
        if (!code) code = find_lists(r, map, keys[i], lists[i]);
        if (code) return code;
    }
    state->joints = pool_get(r->memory, get_count(lists[0][0]) + get_count(lists[1][0]), sizeof *state->joints);
    if (!state->joints) return io_fail_memory(r->error, r->path);
    for (int i = 0; i < 2; i++) {
        const yaml_value *value = get_first(lists[i][1]);
        for (const yaml_value *name = get_first(lists[i][0]); name; name = name->next, value = value->next) {
            ovoid_code code = read_joint(r, name, value, i, state);
            if (code) return code;
        }
    }
    return OVOID_OK;
}

// ---- frames

// MoveIt keeps the transform as the pose of header.frame_id in child_frame_id, which must be the model's frame. One
// without a name, which it drops, is taken where it moves nothing.
static ovoid_code read_frame(message_reader *r, const yaml_value *value, scene_state *state) {
    const yaml_value *transform, *header;
    const char *child, *name = "";
    double v[7];
    ovoid_code code = message_refuse_others(r, value, "header|child_frame_id|transform");
    if (!code) code = message_find_kind(r, value, "transform", YAML_MAP, &transform);
    if (!code) code = message_find_kind(r, value, "header", YAML_MAP, &header);
    if (!code) code = message_read_text(r, value, "child_frame_id", &child);
    if (!code && header) code = message_read_frame(r, header, &name);
    if (!code && !transform) code = message_fail(r, value, OVOID_ERROR_FORMAT, "a fixed frame needs a transform");
    if (!code) code = message_read_transform(r, transform, v);
    if (code || (transform_is_identity(v) && !name[0])) return code;
    if (!name[0] || !child[0])
        return message_fail(r, value, OVOID_ERROR_FORMAT,
                            "a fixed frame needs its name, header: frame_id, and child_frame_id, the model's frame");
    if (state->model && strcmp(state->model, child) != 0)
        return message_fail(r, value, OVOID_ERROR_FORMAT, "fixed frames are given in \"%.60s\" and in \"%.60s\"",
                            state->model, child);
    scene_frame *frame = &state->frames[state->frame_count++];
    *frame = (scene_frame){name, {{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}}};
    state->model = child;
    state->model_line = value->line;
    return ovoid_pose_validate(&frame->pose)
               ? message_fail(r, value, OVOID_ERROR_RANGE, "the frame is farther away than %g", OVOID_LENGTH_MAX)
               : OVOID_OK;
}

static ovoid_code read_frames(message_reader *r, const yaml_value *root, scene_state *state) {
    const yaml_value *list;
    ovoid_code code = message_find_kind(r, root, "fixed_frame_transforms", YAML_LIST, &list);
    if (code) return code;
    state->frames = pool_get(r->memory, get_count(list), sizeof *state->frames);
    if (!state->frames) return io_fail_memory(r->error, r->path);
    for (const yaml_value *v = get_first(list); v && !code; v = v->next) code = read_frame(r, v, state);
    return code;
}

// ---- paddings and scales

static ovoid_code read_link_number(const message_reader *r, const yaml_value *value, const char *key, const char **link,
                                   double *number) {
    const yaml_value *at;
    char keys[32];
    (void)snprintf(keys, sizeof keys, "link_name|%s", key);
    ovoid_code code = message_refuse_others(r, value, keys);
    if (!code) code = message_read_text(r, value, "link_name", link);
    if (!code) code = message_find(r, value, key, &at);
    if (!code && (!(*link)[0] || !at))
        code = message_fail(r, value, OVOID_ERROR_FORMAT, "there must be link_name and %s", key);
    return code ? code : message_read_number(r, at, number);
}

static ovoid_code read_paddings(const message_reader *r, const yaml_value *root, scene_state *state) {
    const yaml_value *list;
    ovoid_code code = message_find_kind(r, root, "link_padding", YAML_LIST, &list);
    if (code) return code;
    state->paddings = pool_get(r->memory, get_count(list), sizeof *state->paddings);
    if (!state->paddings) return io_fail_memory(r->error, r->path);
    for (const yaml_value *v = get_first(list); v && !code; v = v->next) {
        scene_padding *p = &state->paddings[state->padding_count++];
        p->line = v->line;
        code = read_link_number(r, v, "padding", &p->link, &p->padding);
        if (!code && !(p->padding >= 0 && p->padding <= OVOID_LENGTH_MAX))
            code =
                message_fail(r, v, OVOID_ERROR_RADIUS, "link_padding: the padding of %.60s is %g", p->link, p->padding);
    }
    return code;
}

// MoveIt scales links against obstacles and leaves them between links. Here a link has one size, which the robot's
// reader sets.
static ovoid_code validate_scales(const message_reader *r, const yaml_value *root) {
    const yaml_value *list;
    ovoid_code code = message_find_kind(r, root, "link_scale", YAML_LIST, &list);
    for (const yaml_value *v = get_first(list); v && !code; v = v->next) {
        const char *link;
        double scale;
        code = read_link_number(r, v, "scale", &link, &scale);
        if (!code && scale != 1)
            code = message_fail(r, v, OVOID_ERROR_FORMAT,
                                "link_scale: %.60s is %g times as large; a scene cannot scale a link here: take "
                                "link_scale out and give the robot that scale (--scale %.60s=%g)",
                                link, scale, link, scale);
    }
    return code;
}

// ---- allowed collisions

static ovoid_code read_flag(const message_reader *r, const yaml_value *v, unsigned char *flag) {
    static const char *const words[] = {"false", "0", "False", "true", "1", "True"};
    for (unsigned i = 0; i < 6; i++)
        if (v->kind == YAML_TEXT && strcmp(v->text, words[i]) == 0) return *flag = i > 2, OVOID_OK;
    return message_fail(r, v, OVOID_ERROR_FORMAT, "\"%.40s\" is neither true nor false", v->text);
}

// The list of a row, {enabled: [...]} or the list itself: as long as there are names.
static ovoid_code find_row(const message_reader *r, const yaml_value *v, size_t count, const yaml_value **row) {
    *row = v;
    ovoid_code code = v->kind == YAML_MAP ? message_refuse_others(r, v, "enabled") : OVOID_OK;
    if (!code && v->kind == YAML_MAP) code = message_find_kind(r, v, "enabled", YAML_LIST, row);
    if (code || (*row && (*row)->kind == YAML_LIST && (*row)->count == count)) return code;
    return message_fail(r, v, OVOID_ERROR_FORMAT, "allowed_collision_matrix: a row needs %zu entries", count);
}

// Rows are looked at before there is memory for them, so that a short file cannot ask for much.
static ovoid_code read_rows(const message_reader *r, const yaml_value *list, scene_matrix *m) {
    const yaml_value *row;
    for (const yaml_value *v = get_first(list); v; v = v->next) {
        ovoid_code code = find_row(r, v, m->count, &row);
        if (code) return code;
    }
    m->entries = pool_get(r->memory, m->count * m->count + 1, 1);
    if (!m->entries) return io_fail_memory(r->error, r->path);
    unsigned char *at = m->entries;
    for (const yaml_value *v = get_first(list); v; v = v->next) {
        ovoid_code code = find_row(r, v, m->count, &row);
        for (const yaml_value *flag = get_first(row); flag && !code; flag = flag->next) code = read_flag(r, flag, at++);
        if (code) return code;
    }
    return OVOID_OK;
}

// Names as an index, each once.
static ovoid_code read_names(const message_reader *r, const yaml_value *list, name_index *names) {
    names->count = 0;
    names->entries = pool_get(r->memory, get_count(list), sizeof *names->entries);
    if (!names->entries) return io_fail_memory(r->error, r->path);
    for (const yaml_value *v = get_first(list); v; v = v->next) {
        if (v->kind != YAML_TEXT) return message_fail(r, v, OVOID_ERROR_FORMAT, "a name must be a text");
        name_entry *entry = &names->entries[names->count];
        entry->index = (uint32_t)names->count++;
        ovoid_code code = keep_text(r, v->text, &entry->name);
        if (code) return code;
    }
    return OVOID_OK;
}

static ovoid_code sort_names(const message_reader *r, const yaml_value *at, name_index *names) {
    size_t twice = name_index_sort(names);
    if (twice == names->count) return OVOID_OK;
    return message_fail(r, at, OVOID_ERROR_FORMAT, "allowed_collision_matrix: \"%.60s\" is there twice",
                        names->entries[twice].name);
}

static ovoid_code read_defaults(const message_reader *r, const yaml_value *map, scene_matrix *m) {
    static const char *const keys[2] = {"default_entry_names", "default_entry_values"};
    const yaml_value *lists[2];
    ovoid_code code = find_lists(r, map, keys, lists);
    if (!code) code = read_names(r, lists[0], &m->defaults);
    const yaml_value *v = get_first(lists[1]);
    for (size_t i = 0; !code && i < m->defaults.count; i++, v = v->next) {
        unsigned char flag = 0;
        code = read_flag(r, v, &flag);
        m->defaults.entries[i].index = flag;
    }
    return code ? code : sort_names(r, map, &m->defaults);
}

static ovoid_code read_matrix(const message_reader *r, const yaml_value *root, scene_matrix *m) {
    static const char *const keys[2] = {"entry_names", "entry_values"};
    const yaml_value *map, *lists[2];
    ovoid_code code = message_find_kind(r, root, "allowed_collision_matrix", YAML_MAP, &map);
    if (code || !map) return code;
    code = message_refuse_others(r, map, "entry_names|entry_values|default_entry_names|default_entry_values");
    if (!code) code = find_lists(r, map, keys, lists);
    if (!code) code = read_names(r, lists[0], &m->rows);
    m->count = m->rows.count;
    if (!code) code = read_rows(r, lists[1], m);
    if (!code) code = sort_names(r, map, &m->rows);
    if (!code) code = read_defaults(r, map, m);
    // One that names nothing is that of a scene that was written without.
    if (!code && m->count + m->defaults.count) m->line = map->line;
    return code;
}

int scene_matrix_is_allowed(const scene_matrix *m, const char *a, const char *b) {
    uint32_t i = name_index_find(&m->rows, a), k = name_index_find(&m->rows, b);
    if (i != UINT32_MAX && k != UINT32_MAX) return m->entries[i < k ? i * m->count + k : k * m->count + i];
    // If the two defaults differ, the one that forbids wins; one alone counts.
    i = name_index_find(&m->defaults, a), k = name_index_find(&m->defaults, b);
    if (i == UINT32_MAX || k == UINT32_MAX) return (i != UINT32_MAX && i) || (k != UINT32_MAX && k);
    return i && k;
}

// ---- all of it

ovoid_code scene_state_read(message_reader *r, const yaml_value *root, scene_state *state) {
    const yaml_value *robot;
    ovoid_code code = message_find_kind(r, root, "robot_state", YAML_MAP, &robot);
    if (!code && robot)
        code = message_refuse_others(r, robot, "joint_state|multi_dof_joint_state|attached_collision_objects|is_diff");
    if (!code && robot) code = read_joints(r, robot, state);
    if (!code) code = read_frames(r, root, state);
    if (!code) code = read_paddings(r, root, state);
    if (!code) code = validate_scales(r, root);
    return code ? code : read_matrix(r, root, &state->matrix);
}
