// URDF (http://wiki.ros.org/urdf/XML): links and joints. Where the format leaves a value out, its own default stands;
// nothing is guessed: a joint without the limits that its type needs, a second origin, an axis of zero are refused.
#include "robot/read/urdf/reader.h"

#include <math.h>
#include <string.h>

/// The elements of the links and of the joints, in the order of the file.
typedef struct urdf_parts {
    const xml_element **links, **joints;
} urdf_parts;

static size_t count_children(const xml_element *root, const char *name) {
    size_t count = 0;
    for (const xml_element *e = root->first; e; e = e->next) count += (size_t)xml_is(e, name);
    return count;
}

// The children of that name, each with a name that no other has.
static ovoid_code collect(robot_reader *r, const xml_element *root, const char *kind, const xml_element ***elements,
                          name_index *names) {
    size_t count = count_children(root, kind), n = 0;
    if (count > OVOID_ROBOT_LINKS_MAX)
        return robot_fail(r, root, OVOID_ERROR_LIMIT, "there are %zu <%s>; at most %zu are read", count, kind,
                          OVOID_ROBOT_LINKS_MAX);
    *elements = pool_get(&r->scratch, count, sizeof **elements);
    names->entries = pool_get(&r->scratch, count + 1, sizeof *names->entries); // one for a virtual joint
    if (!*elements || !names->entries) return robot_fail_memory(r);
    names->count = count;
    for (const xml_element *e = root->first; e; e = e->next) {
        if (!xml_is(e, kind)) continue;
        const char *name;
        ovoid_code code = robot_get_text(r, e, "name", &name);
        if (!code && !(name = pool_copy(&r->file->memory, name, strlen(name)))) code = robot_fail_memory(r);
        if (code) return code;
        names->entries[n] = (name_entry){name, (uint32_t)n};
        (*elements)[n++] = e;
    }
    size_t twice = name_index_sort(names);
    if (twice == count) return OVOID_OK;
    const xml_element *first = (*elements)[names->entries[twice - 1].index];
    return robot_fail(r, (*elements)[names->entries[twice].index], OVOID_ERROR_FORMAT,
                      "the name is that of the %s of line %lld too", kind, (long long)first->line);
}

// ---- joints

static ovoid_code read_type(robot_reader *r, const xml_element *e, ovoid_joint_type *type) {
    const char *word;
    ovoid_code code = robot_get_text(r, e, "type", &word);
    if (code) return code;
    for (int t = OVOID_JOINT_FIXED; t <= OVOID_JOINT_FLOATING; t++)
        if (strcmp(word, ovoid_joint_type_get_name((ovoid_joint_type)t)) == 0) {
            *type = (ovoid_joint_type)t;
            return OVOID_OK;
        }
    return robot_fail(r, e, OVOID_ERROR_FORMAT,
                      "its type is \"%.40s\", not one of revolute, continuous, prismatic, fixed, floating, planar",
                      word);
}

// The link that <parent link="..."> or <child link="..."> names.
static ovoid_code read_end(robot_reader *r, const xml_element *joint, const char *which, uint32_t *link) {
    const xml_element *e;
    const char *name;
    ovoid_code code = robot_get_child(r, joint, which, &e);
    if (!code && !e) code = robot_fail(r, joint, OVOID_ERROR_FORMAT, "needs a <%s link=\"...\"/>", which);
    if (!code) code = robot_get_text(r, e, "link", &name);
    if (code) return code;
    *link = name_index_find(&r->link_names, name);
    if (*link != OVOID_ROBOT_NONE) return OVOID_OK;
    return robot_fail(r, e, OVOID_ERROR_FORMAT, "its %s, the link \"%.60s\", is not there", which, name);
}

static ovoid_code read_axis(robot_reader *r, const xml_element *joint, ovoid_robot_joint *out) {
    const xml_element *e;
    double v[3] = {1, 0, 0};
    ovoid_code code = robot_get_child(r, joint, "axis", &e);
    if (code) return code;
    if (e && robot_read_numbers(r, e, "xyz", v, 3) < 0) return OVOID_ERROR_FORMAT;
    out->axis = (ovoid_vec3){v[0], v[1], v[2]};
    if (out->type == OVOID_JOINT_FIXED || out->type == OVOID_JOINT_FLOATING) return OVOID_OK;
    if (v[0] == 0 && v[1] == 0 && v[2] == 0)
        return robot_fail(r, e, OVOID_ERROR_ROTATION, "its axis is zero; the default is \"1 0 0\"");
    return OVOID_OK;
}

static ovoid_code read_limits(robot_reader *r, const xml_element *joint, ovoid_robot_joint *out) {
    const xml_element *e;
    int is_limited = out->type == OVOID_JOINT_REVOLUTE || out->type == OVOID_JOINT_PRISMATIC;
    ovoid_code code = robot_get_child(r, joint, "limit", &e);
    if (code) return code;
    if (!e && is_limited)
        return robot_fail(r, joint, OVOID_ERROR_FORMAT,
                          "a %s joint needs a <limit lower=\"...\" upper=\"...\" velocity=\"...\"/>%s",
                          ovoid_joint_type_get_name(out->type),
                          out->type == OVOID_JOINT_REVOLUTE ? "; one without limits is continuous" : "");
    if (!is_limited) out->lower = -INFINITY, out->upper = INFINITY;
    if (!e) return OVOID_OK;
    if (robot_read_numbers(r, e, "velocity", &out->velocity, 1) < 0) return OVOID_ERROR_FORMAT;
    if (out->velocity < 0) return robot_fail(r, e, OVOID_ERROR_FORMAT, "its velocity limit is below zero");
    if (!is_limited) return OVOID_OK;
    int has_lower = robot_read_numbers(r, e, "lower", &out->lower, 1);
    int has_upper = has_lower < 0 ? -1 : robot_read_numbers(r, e, "upper", &out->upper, 1);
    if (has_upper < 0) return OVOID_ERROR_FORMAT;
    if (!has_lower || !has_upper)
        robot_note(r, e, "the limits of joint \"%.80s\" have no %s: 0 by default", out->name,
                   has_upper   ? "lower"
                   : has_lower ? "upper"
                               : "lower and no upper");
    if (out->lower > out->upper)
        return robot_fail(r, e, OVOID_ERROR_FORMAT, "lower, %g, is above upper, %g", out->lower, out->upper);
    return OVOID_OK;
}

static ovoid_code read_mimic(robot_reader *r, const xml_element *joint, ovoid_robot_joint *out) {
    const xml_element *e;
    const char *name;
    out->mimic = OVOID_ROBOT_NONE, out->multiplier = 1, out->offset = 0;
    ovoid_code code = robot_get_child(r, joint, "mimic", &e);
    if (code || !e) return code;
    if (out->type == OVOID_JOINT_FIXED) {
        r->file->fixed_mimic_count++;
        robot_note(r, e, "joint \"%.80s\" is fixed: its <mimic> has no effect", out->name);
        return OVOID_OK;
    }
    code = robot_get_text(r, e, "joint", &name);
    if (code) return code;
    out->mimic = name_index_find(&r->joint_names, name);
    if (out->mimic == OVOID_ROBOT_NONE)
        return robot_fail(r, e, OVOID_ERROR_FORMAT, "it mimics the joint \"%.60s\", which is not there", name);
    if (robot_read_numbers(r, e, "multiplier", &out->multiplier, 1) < 0) return OVOID_ERROR_FORMAT;
    return robot_read_numbers(r, e, "offset", &out->offset, 1) < 0 ? OVOID_ERROR_FORMAT : OVOID_OK;
}

static ovoid_code read_joint(robot_reader *r, const xml_element *e, ovoid_robot_joint *out) {
    const xml_element *origin;
    ovoid_code code = robot_ignore_others(r, e, "origin|parent|child|axis|limit|mimic");
    if (!code) code = read_type(r, e, &out->type);
    if (!code) code = read_end(r, e, "parent", &out->parent);
    if (!code) code = read_end(r, e, "child", &out->child);
    if (!code) code = robot_get_child(r, e, "origin", &origin);
    if (!code) code = robot_read_origin(r, origin, &out->origin);
    if (!code) code = read_axis(r, e, out);
    if (!code) code = read_limits(r, e, out);
    return code ? code : read_mimic(r, e, out);
}

static ovoid_code read_joints(robot_reader *r, const urdf_parts *parts) {
    ovoid_robot_file *file = r->file;
    size_t count = r->joint_names.count;
    // One more for the joint of an SRDF's virtual joint.
    file->joints = pool_get(&file->memory, count + 1, sizeof *file->joints);
    if (!file->joints) return robot_fail_memory(r);
    for (size_t i = 0; i < count; i++) {
        const name_entry *entry = &r->joint_names.entries[i];
        file->joints[entry->index].name = entry->name;
    }
    for (size_t i = 0; i < count; i++) {
        ovoid_code code = read_joint(r, parts->joints[i], &file->joints[i]);
        if (code) return code;
    }
    file->description.joints = file->joints;
    file->description.joint_count = count;
    return OVOID_OK;
}

// ---- the robot

// xacro is a language of macros that makes URDF; a file of it is known by its elements and expressions.
static ovoid_code refuse_xacro(robot_reader *r, const xml_element *e) {
    for (; e; e = e->next) {
        int found = strncmp(e->name, "xacro:", 6) == 0;
        for (const xml_attribute *a = e->attributes; a && !found; a = a->next)
            found = strstr(a->value, "${") != NULL || strstr(a->value, "$(") != NULL;
        if (found)
            return robot_fail(r, e, OVOID_ERROR_FORMAT,
                              "this is xacro, of which URDF is made: run \"xacro FILE > robot.urdf\" and give that");
        // The recursion is at most XML_DEPTH_MAX deep.
        ovoid_code code = refuse_xacro(r, e->first);
        if (code) return code;
    }
    return OVOID_OK;
}

static ovoid_code validate_root(robot_reader *r, const xml_element *root) {
    ovoid_code code = refuse_xacro(r, root);
    if (code) return code;
    if (xml_is(root, "sdf"))
        return robot_fail(r, root, OVOID_ERROR_FORMAT, "this is SDF, which is not read; convert it to URDF");
    if (!xml_is(root, "robot"))
        return robot_fail(r, root, OVOID_ERROR_FORMAT, "the root of a URDF is <robot>, not <%.60s>", root->name);
    if (count_children(root, "link")) return OVOID_OK;
    if (xml_find(root, "group") || xml_find(root, "disable_collisions"))
        return robot_fail(r, root, OVOID_ERROR_EMPTY, "this is an SRDF; it is given beside the URDF");
    return robot_fail(r, root, OVOID_ERROR_EMPTY, "the robot has no links");
}

ovoid_code urdf_read(robot_reader *r, const xml_element *root) {
    urdf_parts parts = {NULL, NULL};
    ovoid_robot_file *file = r->file;
    ovoid_code code = validate_root(r, root);
    if (!code) code = robot_ignore_others(r, root, "link|joint");
    if (!code) code = robot_ignore_attributes(r, root);
    if (!code) code = collect(r, root, "link", &parts.links, &r->link_names);
    if (!code) code = collect(r, root, "joint", &parts.joints, &r->joint_names);
    if (code) return code;
    const char *name = xml_get(root, "name");
    file->description.name = pool_copy(&file->memory, name ? name : "", name ? strlen(name) : 0);
    size_t count = r->link_names.count;
    file->links = pool_get(&file->memory, count + 1, sizeof *file->links);
    if (!file->links || !file->description.name) return robot_fail_memory(r);
    for (size_t i = 0; i < count; i++) file->links[r->link_names.entries[i].index].name = r->link_names.entries[i].name;
    file->description.links = file->links;
    file->description.link_count = count;
    code = read_joints(r, &parts);
    if (!code) code = tree_validate(r, parts.links, parts.joints);
    return code ? code : geometry_read(r, parts.links);
}
