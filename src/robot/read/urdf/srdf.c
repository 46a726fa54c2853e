// SRDF (http://wiki.ros.org/srdf): what is known of a robot beside its URDF. Names that the URDF does not have are told
// and passed over, since SRDFs are often kept for several variants of a robot; wrong numbers are refused. groups.c
// reads groups and states.
#include "robot/read/urdf/reader.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static size_t count_children(const xml_element *root, const char *name) {
    size_t count = 0;
    for (const xml_element *e = root->first; e; e = e->next) count += (size_t)xml_is(e, name);
    return count;
}

/// The link that an attribute names; OVOID_ROBOT_NONE, told, where there is none of that name.
static ovoid_code read_link(robot_reader *r, const xml_element *e, const char *attribute, uint32_t *link) {
    const char *name;
    ovoid_code code = robot_get_text(r, e, attribute, &name);
    if (code) return code;
    *link = name_index_find(&r->link_names, name);
    return *link == OVOID_ROBOT_NONE ? robot_add_unknown(r, e, "link", name) : OVOID_OK;
}

// ---- disabled pairs

enum { PAIRS_MOST = 1 << 24 };

typedef struct pair_list {
    ovoid_robot_pair *pairs; ///< a < b
    size_t count;
} pair_list;

static int compare_pairs(const void *a, const void *b) {
    const ovoid_robot_pair *m = a, *n = b;
    if (m->a != n->a) return m->a < n->a ? -1 : 1;
    return (m->b > n->b) - (m->b < n->b);
}

static ovoid_code read_pair(robot_reader *r, const xml_element *e, pair_list *list) {
    uint32_t a, b = OVOID_ROBOT_NONE;
    const char *reason = xml_get(e, "reason");
    ovoid_code code = read_link(r, e, "link1", &a);
    if (!code) code = read_link(r, e, "link2", &b);
    if (code || a == OVOID_ROBOT_NONE || b == OVOID_ROBOT_NONE) return code;
    if (a == b) {
        robot_note(r, e, "<%s> names the link %.100s twice", e->name, r->file->links[a].name);
        return OVOID_OK;
    }
    if (reason && !(reason = pool_copy(&r->file->memory, reason, strlen(reason)))) return robot_fail_memory(r);
    list->pairs[list->count++] = (ovoid_robot_pair){a < b ? a : b, a < b ? b : a, reason};
    return OVOID_OK;
}

// Sorts the pairs and keeps each once; none that `without` has.
static void settle_pairs(pair_list *list, const pair_list *without) {
    size_t kept = 0;
    if (list->count) qsort(list->pairs, list->count, sizeof *list->pairs, compare_pairs);
    for (size_t i = 0; i < list->count; i++) {
        const ovoid_robot_pair *p = &list->pairs[i];
        if (i && compare_pairs(p, p - 1) == 0) continue;
        if (without->count && bsearch(p, without->pairs, without->count, sizeof *p, compare_pairs)) continue;
        list->pairs[kept++] = *p;
    }
    list->count = kept;
}

// The pairs of the elements of that name, with room for more.
static ovoid_code read_pairs(robot_reader *r, const xml_element *root, const char *name, size_t more, pair_list *list) {
    size_t most = count_children(root, name);
    list->pairs = pool_get(&r->file->memory, most + more, sizeof *list->pairs);
    list->count = 0;
    if (!list->pairs) return robot_fail_memory(r);
    for (const xml_element *e = root->first; e; e = e->next) {
        ovoid_code code = xml_is(e, name) ? read_pair(r, e, list) : OVOID_OK;
        if (code) return code;
    }
    return OVOID_OK;
}

// <disable_default_collisions>: all pairs of the link that <enable_collisions> does not name.
static ovoid_code read_defaults(robot_reader *r, const xml_element *root, pair_list *list) {
    size_t links = r->file->description.link_count, most = count_children(root, "disable_default_collisions");
    pair_list enabled;
    const pair_list none = {NULL, 0};
    ovoid_code code = read_pairs(r, root, "enable_collisions", 0, &enabled);
    if (code) return code;
    settle_pairs(&enabled, &none);
    *list = none;
    if (most == 0) return OVOID_OK;
    if (most > PAIRS_MOST / links)
        return robot_fail(r, root, OVOID_ERROR_LIMIT, "more than %d pairs are disabled by default", (int)PAIRS_MOST);
    list->pairs = pool_get(&r->file->memory, most * links, sizeof *list->pairs);
    if (!list->pairs) return robot_fail_memory(r);
    for (const xml_element *e = root->first; e; e = e->next) {
        uint32_t link;
        if (!xml_is(e, "disable_default_collisions")) continue;
        if ((code = read_link(r, e, "link", &link)) != OVOID_OK) return code;
        for (uint32_t other = 0; link != OVOID_ROBOT_NONE && other < links; other++)
            if (other != link)
                list->pairs[list->count++] =
                    (ovoid_robot_pair){link < other ? link : other, link < other ? other : link, "Default"};
    }
    settle_pairs(list, &enabled);
    return OVOID_OK;
}

// The pairs, sorted, each once. As in MoveIt: those by default, less those that are enabled, and those that are named.
static ovoid_code read_disabled(robot_reader *r, const xml_element *root) {
    pair_list defaults, list;
    const pair_list none = {NULL, 0};
    ovoid_code code = read_defaults(r, root, &defaults);
    if (!code) code = read_pairs(r, root, "disable_collisions", defaults.count, &list);
    if (code) return code;
    if (defaults.count) memcpy(list.pairs + list.count, defaults.pairs, defaults.count * sizeof *list.pairs);
    list.count += defaults.count;
    settle_pairs(&list, &none);
    r->file->description.disabled = list.pairs;
    r->file->description.disabled_count = list.count;
    return OVOID_OK;
}

// ---- the virtual joint

static uint32_t find_root(const robot_reader *r) {
    uint32_t root = 0;
    while (r->parents[root] != OVOID_ROBOT_NONE) root++;
    return root;
}

static ovoid_code add_virtual(robot_reader *r, const xml_element *e, const char *name, const char *frame,
                              ovoid_joint_type type) {
    ovoid_robot_file *file = r->file;
    ovoid_robot_description *d = &file->description;
    uint32_t root = find_root(r), link = (uint32_t)d->link_count, joint = (uint32_t)d->joint_count;
    name = pool_copy(&file->memory, name, strlen(name));
    frame = pool_copy(&file->memory, frame, strlen(frame));
    if (!name || !frame) return robot_fail_memory(r);
    if (name_index_find(&r->link_names, frame) != OVOID_ROBOT_NONE)
        return robot_fail(r, e, OVOID_ERROR_FORMAT, "its parent_frame \"%.60s\" is a link of the robot", frame);
    if (name_index_find(&r->joint_names, name) != OVOID_ROBOT_NONE)
        return robot_fail(r, e, OVOID_ERROR_FORMAT, "the URDF has a joint of that name");
    file->links[link] = (ovoid_robot_link){frame};
    file->joints[joint] = (ovoid_robot_joint){.name = name,
                                              .type = type,
                                              .parent = link,
                                              .child = root,
                                              .origin = ovoid_pose_make_identity(),
                                              .axis = {0, 0, 1},
                                              .lower = -INFINITY,
                                              .upper = INFINITY,
                                              .mimic = OVOID_ROBOT_NONE,
                                              .multiplier = 1};
    r->parents[root] = joint;
    r->parents[link] = OVOID_ROBOT_NONE;
    // Room for one more was made for it; the order of names stays.
    name_index *names[2] = {&r->link_names, &r->joint_names};
    const name_entry entries[2] = {{frame, link}, {name, joint}};
    for (int k = 0; k < 2; k++) {
        names[k]->entries[names[k]->count++] = entries[k];
        (void)name_index_sort(names[k]);
    }
    d->link_count++;
    d->joint_count++;
    return OVOID_OK;
}

static ovoid_code read_virtual(robot_reader *r, const xml_element *e) {
    static const struct {
        const char *word;
        ovoid_joint_type type;
    } types[] = {{"fixed", OVOID_JOINT_FIXED}, {"planar", OVOID_JOINT_PLANAR}, {"floating", OVOID_JOINT_FLOATING}};
    const char *name, *frame, *word;
    uint32_t child = OVOID_ROBOT_NONE;
    ovoid_code code = robot_get_text(r, e, "name", &name);
    if (!code) code = robot_get_text(r, e, "parent_frame", &frame);
    if (!code) code = robot_get_text(r, e, "type", &word);
    if (!code) code = read_link(r, e, "child_link", &child);
    if (code || child == OVOID_ROBOT_NONE) return code;
    size_t i = 0;
    while (i < 3 && strcmp(types[i].word, word) != 0) i++;
    if (i == 3)
        return robot_fail(r, e, OVOID_ERROR_FORMAT, "its type is \"%.40s\", not fixed, planar or floating", word);
    if (r->parents[child] != OVOID_ROBOT_NONE) {
        robot_note(r, e, "<virtual_joint> does not hold the root link but %.100s; it is passed over",
                   r->file->links[child].name);
        return OVOID_OK;
    }
    if (!r->options->fixed_base) return add_virtual(r, e, name, frame, types[i].type);
    r->file->description.frame = pool_copy(&r->file->memory, frame, strlen(frame));
    return r->file->description.frame ? OVOID_OK : robot_fail_memory(r);
}

// ---- spheres and passive joints

static ovoid_code read_sphere(robot_reader *r, const xml_element *e, uint32_t link) {
    double center[3] = {0, 0, 0}, radius;
    if (robot_read_numbers(r, e, "center", center, 3) < 0) return OVOID_ERROR_FORMAT;
    ovoid_code code = robot_read_number(r, e, "radius", &radius);
    if (code) return code;
    if (radius < 0) return robot_fail(r, e, OVOID_ERROR_RADIUS, "<sphere radius=\"%g\"> is below zero", radius);
    // Radius zero says that the link has no spheres.
    if (radius > 0)
        r->file->spheres[r->file->sphere_count++] =
            (ovoid_robot_link_sphere){link, {{center[0], center[1], center[2]}, radius}};
    return OVOID_OK;
}

static ovoid_code read_spheres(robot_reader *r, const xml_element *root) {
    size_t most = 0;
    for (const xml_element *e = root->first; e; e = e->next)
        if (xml_is(e, "link_sphere_approximation")) most += count_children(e, "sphere");
    r->file->spheres = pool_get(&r->file->memory, most, sizeof *r->file->spheres);
    if (!r->file->spheres) return robot_fail_memory(r);
    for (const xml_element *e = root->first; e; e = e->next) {
        uint32_t link;
        if (!xml_is(e, "link_sphere_approximation")) continue;
        ovoid_code code = read_link(r, e, "link", &link);
        if (!code) code = robot_ignore_others(r, e, "sphere");
        for (const xml_element *s = e->first; s && !code && link != OVOID_ROBOT_NONE; s = s->next)
            if (xml_is(s, "sphere")) code = read_sphere(r, s, link);
        if (code) return code;
    }
    return OVOID_OK;
}

static ovoid_code read_passive(robot_reader *r, const xml_element *root) {
    ovoid_robot_file *file = r->file;
    file->passive = pool_get(&file->memory, count_children(root, "passive_joint"), sizeof *file->passive);
    if (!file->passive) return robot_fail_memory(r);
    for (const xml_element *e = root->first; e; e = e->next) {
        const char *name;
        if (!xml_is(e, "passive_joint")) continue;
        ovoid_code code = robot_get_text(r, e, "name", &name);
        if (code) return code;
        uint32_t joint = name_index_find(&r->joint_names, name);
        if (joint != OVOID_ROBOT_NONE)
            file->passive[file->passive_count++] = joint;
        else if ((code = robot_add_unknown(r, e, "joint", name)) != OVOID_OK)
            return code;
    }
    return OVOID_OK;
}

ovoid_code srdf_read(robot_reader *r, const xml_element *root) {
    if (!xml_is(root, "robot"))
        return robot_fail(r, root, OVOID_ERROR_FORMAT, "the root of an SRDF is <robot>, not <%.60s>", root->name);
    if (xml_find(root, "link") || xml_find(root, "joint"))
        return robot_fail(r, root, OVOID_ERROR_FORMAT, "this is a URDF; an SRDF has groups and disabled pairs");
    const char *name = xml_get(root, "name"), *own = r->file->description.name;
    if (name && strcmp(name, own) != 0)
        robot_note(r, root, "the SRDF is of the robot %.100s, the URDF of %.100s", name, own);
    ovoid_code code =
        robot_ignore_others(r, root,
                            "group|group_state|disable_collisions|disable_default_collisions|"
                            "enable_collisions|virtual_joint|passive_joint|link_sphere_approximation|end_effector");
    if (!code) code = robot_ignore_attributes(r, root);
    const xml_element *joint = NULL;
    if (!code) code = robot_get_child(r, root, "virtual_joint", &joint);
    if (!code && joint) code = read_virtual(r, joint);
    if (!code) code = read_disabled(r, root);
    if (!code) code = read_spheres(r, root);
    if (!code) code = read_passive(r, root);
    if (!code) code = groups_read(r, root);
    if (!code) robot_finish_unknown(r);
    return code;
}
