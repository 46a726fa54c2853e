// Groups of an SRDF: joints with their child links, links with their parent joints, chains from a base to a tip, and
// other groups, all resolved to indices; and named states. Cost: the members of all groups, which are limited.
#include "robot/read/urdf/reader.h"

#include <stdlib.h>
#include <string.h>

/// Most members of all groups, those of subgroups counted again.
#define MEMBERS_MAX ((size_t)1 << 22)

enum { NOT_RESOLVED, RESOLVING, RESOLVED };

/// Members under construction, with repetitions.
typedef struct members {
    uint32_t *items;
    size_t count, capacity;
} members;

/// The groups' elements, in the order of the file.
typedef struct group_list {
    const xml_element **elements;
    unsigned char *states;
    name_index names;
    size_t total;     ///< members so far
    uint32_t *depths; ///< of links below the root
} group_list;

/// A group under construction.
typedef struct group_parts {
    members joints, links;
} group_parts;

static ovoid_code add(robot_reader *r, members *m, uint32_t index) {
    if (!array_reserve((void **)&m->items, &m->capacity, m->count, sizeof *m->items)) return robot_fail_memory(r);
    m->items[m->count++] = index;
    return OVOID_OK;
}

static int compare_indices(const void *a, const void *b) {
    uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

// The members sorted, each once, in the file's memory.
static ovoid_code finish_members(robot_reader *r, const members *m, const uint32_t **items, size_t *count) {
    uint32_t *kept = pool_get(&r->file->memory, m->count, sizeof *kept);
    if (!kept) return robot_fail_memory(r);
    if (m->count) qsort(m->items, m->count, sizeof *m->items, compare_indices);
    *count = 0;
    for (size_t i = 0; i < m->count; i++)
        if (!i || m->items[i] != m->items[i - 1]) kept[(*count)++] = m->items[i];
    *items = kept;
    return OVOID_OK;
}

// ---- members

// A joint brings its child link, a link its parent joint.
static ovoid_code add_joint(robot_reader *r, group_parts *g, uint32_t joint) {
    ovoid_code code = add(r, &g->joints, joint);
    return code ? code : add(r, &g->links, r->file->joints[joint].child);
}

static ovoid_code add_link(robot_reader *r, group_parts *g, uint32_t link) {
    ovoid_code code = add(r, &g->links, link);
    if (code || r->parents[link] == OVOID_ROBOT_NONE) return code;
    return add(r, &g->joints, r->parents[link]);
}

// How many joints each link is below the root: each is climbed from once.
static ovoid_code compute_depths(robot_reader *r, group_list *list) {
    const ovoid_robot_description *d = &r->file->description;
    list->depths = pool_get(&r->scratch, d->link_count, sizeof *list->depths);
    uint32_t *way = pool_get(&r->scratch, d->link_count, sizeof *way);
    if (!list->depths || !way) return robot_fail_memory(r);
    // 1 is the root's: 0 is not known.
    for (uint32_t i = 0; i < d->link_count; i++) {
        size_t count = 0;
        uint32_t at = i;
        for (; !list->depths[at] && r->parents[at] != OVOID_ROBOT_NONE; at = d->joints[r->parents[at]].parent)
            way[count++] = at;
        if (!list->depths[at]) list->depths[at] = 1;
        for (uint32_t depth = list->depths[at]; count-- > 0;) list->depths[way[count]] = ++depth;
    }
    return OVOID_OK;
}

// The links and joints between the two ends, by way of the link above both where neither is above the other.
static ovoid_code add_chain(robot_reader *r, group_list *list, const xml_element *e, group_parts *g) {
    const char *base_name, *tip_name;
    ovoid_code code = robot_get_text(r, e, "base_link", &base_name);
    if (!code) code = robot_get_text(r, e, "tip_link", &tip_name);
    if (code) return code;
    uint32_t base = name_index_find(&r->link_names, base_name), tip = name_index_find(&r->link_names, tip_name);
    if (base == OVOID_ROBOT_NONE) return robot_add_unknown(r, e, "link", base_name);
    if (tip == OVOID_ROBOT_NONE) return robot_add_unknown(r, e, "link", tip_name);
    while (base != tip && !code) {
        uint32_t *lower = list->depths[tip] >= list->depths[base] ? &tip : &base;
        code = add_joint(r, g, r->parents[*lower]);
        *lower = r->file->joints[r->parents[*lower]].parent;
        if (g->links.count > MEMBERS_MAX) break;
    }
    return code ? code : add(r, &g->links, base);
}

static ovoid_code add_named(robot_reader *r, const xml_element *e, group_parts *g) {
    const char *name;
    int is_joint = xml_is(e, "joint");
    ovoid_code code = robot_get_text(r, e, "name", &name);
    if (code) return code;
    uint32_t index = name_index_find(is_joint ? &r->joint_names : &r->link_names, name);
    if (index == OVOID_ROBOT_NONE) return robot_add_unknown(r, e, is_joint ? "joint" : "link", name);
    return is_joint ? add_joint(r, g, index) : add_link(r, g, index);
}

// ---- groups

static ovoid_code add_subgroup(robot_reader *r, group_list *list, const xml_element *e, group_parts *g) {
    const char *name;
    ovoid_code code = robot_get_text(r, e, "name", &name);
    if (code) return code;
    uint32_t index = name_index_find(&list->names, name);
    if (index == UINT32_MAX) return robot_add_unknown(r, e, "group", name);
    const ovoid_robot_group *other = &r->file->groups[index];
    for (size_t i = 0; i < other->joint_count && !code; i++) code = add(r, &g->joints, other->joints[i]);
    for (size_t i = 0; i < other->link_count && !code; i++) code = add(r, &g->links, other->links[i]);
    return code;
}

static ovoid_code add_members(robot_reader *r, group_list *list, const xml_element *group, group_parts *g) {
    ovoid_code code = OVOID_OK;
    for (const xml_element *e = group->first; e && !code; e = e->next) {
        if (xml_is(e, "joint") || xml_is(e, "link"))
            code = add_named(r, e, g);
        else if (xml_is(e, "chain"))
            code = add_chain(r, list, e, g);
        else if (xml_is(e, "group"))
            code = add_subgroup(r, list, e, g);
        else
            code = robot_ignore(r, group->name, "/", e->name);
        if (!code && list->total + g->joints.count + g->links.count > MEMBERS_MAX)
            code =
                robot_fail(r, group, OVOID_ERROR_LIMIT, "with it the groups have more than %zu members", MEMBERS_MAX);
    }
    return code;
}

static ovoid_code resolve(robot_reader *r, group_list *list, uint32_t index, int depth);

// The groups that a group names come before it.
static ovoid_code resolve_subgroups(robot_reader *r, group_list *list, const xml_element *group, int depth) {
    for (const xml_element *e = group->first; e; e = e->next) {
        const char *name = xml_is(e, "group") ? xml_get(e, "name") : NULL;
        uint32_t index = name ? name_index_find(&list->names, name) : UINT32_MAX;
        if (index == UINT32_MAX || list->states[index] == RESOLVED) continue;
        if (list->states[index] == RESOLVING)
            return robot_fail(r, e, OVOID_ERROR_FORMAT, "holds itself by way of the group \"%.60s\"", name);
        if (depth == XML_DEPTH_MAX)
            return robot_fail(r, e, OVOID_ERROR_LIMIT, "groups hold each other more than %d deep", XML_DEPTH_MAX);
        ovoid_code code = resolve(r, list, index, depth + 1);
        if (code) return code;
    }
    return OVOID_OK;
}

static ovoid_code resolve(robot_reader *r, group_list *list, uint32_t index, int depth) {
    ovoid_robot_group *out = &r->file->groups[index];
    group_parts g = {{NULL, 0, 0}, {NULL, 0, 0}};
    list->states[index] = RESOLVING;
    ovoid_code code = resolve_subgroups(r, list, list->elements[index], depth);
    if (!code) code = add_members(r, list, list->elements[index], &g);
    list->total += g.joints.count + g.links.count;
    if (!code) code = finish_members(r, &g.joints, &out->joints, &out->joint_count);
    if (!code) code = finish_members(r, &g.links, &out->links, &out->link_count);
    list->states[index] = RESOLVED;
    free(g.joints.items);
    free(g.links.items);
    return code;
}

static ovoid_code list_groups(robot_reader *r, const xml_element *root, group_list *list) {
    size_t most = 0;
    for (const xml_element *e = root->first; e; e = e->next) most += (size_t)xml_is(e, "group");
    list->elements = pool_get(&r->scratch, most, sizeof *list->elements);
    list->states = pool_get(&r->scratch, most, 1);
    list->names.entries = pool_get(&r->scratch, most, sizeof *list->names.entries);
    r->file->groups = pool_get(&r->file->memory, most, sizeof *r->file->groups);
    if (!list->elements || !list->states || !list->names.entries || !r->file->groups) return robot_fail_memory(r);
    for (const xml_element *e = root->first; e; e = e->next) {
        const char *name;
        if (!xml_is(e, "group")) continue;
        ovoid_code code = robot_get_text(r, e, "name", &name);
        if (!code && !(name = pool_copy(&r->file->memory, name, strlen(name)))) code = robot_fail_memory(r);
        if (code) return code;
        size_t i = list->names.count++;
        list->names.entries[i] = (name_entry){name, (uint32_t)i};
        list->elements[i] = e;
        r->file->groups[i].name = name;
    }
    size_t twice = name_index_sort(&list->names);
    if (twice < list->names.count)
        return robot_fail(r, list->elements[list->names.entries[twice].index], OVOID_ERROR_FORMAT,
                          "the name is that of an earlier group too");
    r->file->group_count = list->names.count;
    return OVOID_OK;
}

// ---- named states

static ovoid_code read_value(robot_reader *r, const xml_element *e, ovoid_robot_state *state, ovoid_robot_value *out) {
    const char *name, *text;
    double values[7];
    ovoid_code code = robot_get_text(r, e, "name", &name);
    if (!code) code = robot_get_text(r, e, "value", &text);
    if (code) return code;
    uint32_t joint = name_index_find(&r->joint_names, name);
    if (joint == OVOID_ROBOT_NONE) return robot_add_unknown(r, e, "joint", name);
    uint32_t count = ovoid_joint_type_get_variable_count(r->file->joints[joint].type);
    if (!count) {
        robot_note(r, e, "the state %.100s gives a value to the fixed joint %.100s", state->name, name);
        return OVOID_OK;
    }
    if (robot_read_numbers(r, e, "value", values, count) < 0) return OVOID_ERROR_FORMAT;
    double *kept = pool_get(&r->file->memory, count, sizeof *kept);
    if (!kept) return robot_fail_memory(r);
    memcpy(kept, values, count * sizeof *kept);
    // SRDF writes a quaternion x y z w, as ROS does.
    if (count == 7) kept[3] = values[6], kept[4] = values[3], kept[5] = values[4], kept[6] = values[5];
    out[state->value_count++] = (ovoid_robot_value){joint, count, kept};
    return OVOID_OK;
}

static ovoid_code read_state(robot_reader *r, const xml_element *element, ovoid_robot_state *state) {
    const char *name, *group = xml_get(element, "group");
    size_t most = 0;
    if (!group) group = "";
    ovoid_code code = robot_get_text(r, element, "name", &name);
    if (!code) code = robot_ignore_others(r, element, "joint");
    if (code) return code;
    for (const xml_element *e = element->first; e; e = e->next) most += (size_t)xml_is(e, "joint");
    ovoid_robot_value *values = pool_get(&r->file->memory, most, sizeof *values);
    state->name = pool_copy(&r->file->memory, name, strlen(name));
    state->group = pool_copy(&r->file->memory, group, strlen(group));
    if (!values || !state->name || !state->group) return robot_fail_memory(r);
    state->values = values;
    for (const xml_element *e = element->first; e && !code; e = e->next)
        if (xml_is(e, "joint")) code = read_value(r, e, state, values);
    return code;
}

static ovoid_code read_states(robot_reader *r, const xml_element *root) {
    size_t most = 0;
    for (const xml_element *e = root->first; e; e = e->next) most += (size_t)xml_is(e, "group_state");
    r->file->states = pool_get(&r->file->memory, most, sizeof *r->file->states);
    if (!r->file->states) return robot_fail_memory(r);
    for (const xml_element *e = root->first; e; e = e->next) {
        ovoid_code code = OVOID_OK;
        if (xml_is(e, "group_state")) code = read_state(r, e, &r->file->states[r->file->state_count++]);
        if (code) return code;
    }
    return OVOID_OK;
}

// ---- end effectors

static size_t find_group(const ovoid_robot_file *file, const char *name) {
    size_t i = 0;
    while (i < file->group_count && strcmp(file->groups[i].name, name) != 0) i++;
    return i;
}

// One without its name, its group or its link is passed over, as in MoveIt.
static ovoid_code read_effector(robot_reader *r, const xml_element *e) {
    static const char *const needed[] = {"name", "group", "parent_link"};
    const char *values[3];
    for (int i = 0; i < 3; i++)
        if (!(values[i] = xml_get(e, needed[i])))
            return robot_note(r, e, "<end_effector> has no %s; it is passed over", needed[i]), OVOID_OK;
    uint32_t link = name_index_find(&r->link_names, values[2]);
    size_t group = find_group(r->file, values[1]);
    if (link == OVOID_ROBOT_NONE) return robot_add_unknown(r, e, "link", values[2]);
    if (group == r->file->group_count) return robot_add_unknown(r, e, "group", values[1]);
    const char *name = pool_copy(&r->file->memory, values[0], strlen(values[0]));
    if (!name) return robot_fail_memory(r);
    r->file->effectors[r->file->effector_count++] = (ovoid_robot_end_effector){name, link, group};
    return OVOID_OK;
}

static ovoid_code read_effectors(robot_reader *r, const xml_element *root) {
    size_t most = 0;
    for (const xml_element *e = root->first; e; e = e->next) most += (size_t)xml_is(e, "end_effector");
    r->file->effectors = pool_get(&r->file->memory, most, sizeof *r->file->effectors);
    ovoid_code code = r->file->effectors ? OVOID_OK : robot_fail_memory(r);
    for (const xml_element *e = root->first; e && !code; e = e->next)
        if (xml_is(e, "end_effector")) code = read_effector(r, e);
    return code;
}

ovoid_code groups_read(robot_reader *r, const xml_element *root) {
    group_list list = {.total = 0};
    ovoid_code code = list_groups(r, root, &list);
    if (!code) code = compute_depths(r, &list);
    for (uint32_t i = 0; i < list.names.count && !code; i++)
        if (list.states[i] == NOT_RESOLVED) code = resolve(r, &list, i, 0);
    if (!code) code = read_effectors(r, root);
    return code ? code : read_states(r, root);
}
