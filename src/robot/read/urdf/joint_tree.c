// Do the joints make one tree of all links, and do mimicking joints follow one that moves? Each link is looked at a
// bounded number of times: linear.
#include "robot/read/urdf/reader.h"

#include <string.h>

enum { NOT_SEEN, ON_THE_WAY, DONE };

// The joint above each link: at most one.
static ovoid_code find_parents(robot_reader *r, const xml_element *const *joints) {
    const ovoid_robot_description *d = &r->file->description;
    r->parents = pool_get(&r->scratch, d->link_count + 1, sizeof *r->parents);
    if (!r->parents) return robot_fail_memory(r);
    memset(r->parents, 0xff, (d->link_count + 1) * sizeof *r->parents);
    for (uint32_t i = 0; i < d->joint_count; i++) {
        const ovoid_robot_joint *j = &d->joints[i];
        if (j->parent == j->child)
            return robot_fail(r, joints[i], OVOID_ERROR_FORMAT, "joins the link \"%.60s\" with itself",
                              d->links[j->child].name);
        uint32_t other = r->parents[j->child];
        if (other != OVOID_ROBOT_NONE)
            return robot_fail(r, joints[i], OVOID_ERROR_FORMAT,
                              "its child, the link \"%.50s\", is that of the joint \"%.50s\" (line %lld) too",
                              d->links[j->child].name, d->joints[other].name, (long long)joints[other]->line);
        r->parents[j->child] = i;
    }
    return OVOID_OK;
}

// A link from which no way up ends at a root is on a loop, or hangs on one.
static ovoid_code find_loop(robot_reader *r, const xml_element *const *joints) {
    const ovoid_robot_description *d = &r->file->description;
    unsigned char *seen = pool_get(&r->scratch, d->link_count, 1);
    if (!seen) return robot_fail_memory(r);
    for (uint32_t i = 0; i < d->link_count; i++) {
        uint32_t at = i;
        while (seen[at] == NOT_SEEN && r->parents[at] != OVOID_ROBOT_NONE) {
            seen[at] = ON_THE_WAY;
            at = d->joints[r->parents[at]].parent;
        }
        if (seen[at] == ON_THE_WAY)
            return robot_fail(r, joints[r->parents[at]], OVOID_ERROR_FORMAT,
                              "closes a loop: the link \"%.60s\" would hang on itself", d->links[at].name);
        for (at = i; seen[at] == ON_THE_WAY; at = d->joints[r->parents[at]].parent) seen[at] = DONE;
        seen[at] = DONE;
    }
    return OVOID_OK;
}

static ovoid_code validate_root(robot_reader *r, const xml_element *const *links) {
    const ovoid_robot_description *d = &r->file->description;
    uint32_t root = OVOID_ROBOT_NONE;
    for (uint32_t i = 0; i < d->link_count; i++) {
        if (r->parents[i] != OVOID_ROBOT_NONE) continue;
        if (root != OVOID_ROBOT_NONE)
            return robot_fail(
                r, links[i], OVOID_ERROR_FORMAT,
                "is no joint's child, nor is the link \"%.50s\" (line %lld): a robot has one root; join them, by "
                "a fixed joint for example",
                d->links[root].name, (long long)links[root]->line);
        root = i;
    }
    return OVOID_OK;
}

static int has_one_variable(ovoid_joint_type type) { return ovoid_joint_type_get_variable_count(type) == 1; }

static ovoid_code validate_mimic(robot_reader *r, const xml_element *at, uint32_t i) {
    const ovoid_robot_description *d = &r->file->description;
    const ovoid_robot_joint *j = &d->joints[i], *leader = &d->joints[j->mimic];
    if (j->mimic == i) return robot_fail(r, at, OVOID_ERROR_FORMAT, "mimics itself");
    if (!has_one_variable(j->type))
        return robot_fail(r, at, OVOID_ERROR_FORMAT, "is %s: only joints of one variable can mimic",
                          ovoid_joint_type_get_name(j->type));
    if (!has_one_variable(leader->type))
        return robot_fail(r, at, OVOID_ERROR_FORMAT, "mimics the joint \"%.60s\", which is %s and has not one variable",
                          leader->name, ovoid_joint_type_get_name(leader->type));
    return OVOID_OK;
}

// A mimicking joint may follow one that mimics, but the row must end.
static ovoid_code validate_mimics(robot_reader *r, const xml_element *const *joints) {
    const ovoid_robot_description *d = &r->file->description;
    unsigned char *seen = pool_get(&r->scratch, d->joint_count, 1);
    if (!seen) return robot_fail_memory(r);
    for (uint32_t i = 0; i < d->joint_count; i++) {
        uint32_t at = i;
        for (; seen[at] == NOT_SEEN && d->joints[at].mimic != OVOID_ROBOT_NONE; at = d->joints[at].mimic) {
            ovoid_code code = validate_mimic(r, xml_find(joints[at], "mimic"), at);
            if (code) return code;
            seen[at] = ON_THE_WAY;
        }
        if (seen[at] == ON_THE_WAY)
            return robot_fail(r, xml_find(joints[at], "mimic"), OVOID_ERROR_FORMAT,
                              "mimics itself by way of the joint \"%.60s\"", d->joints[d->joints[at].mimic].name);
        for (at = i; seen[at] == ON_THE_WAY; at = d->joints[at].mimic) seen[at] = DONE;
        seen[at] = DONE;
    }
    return OVOID_OK;
}

ovoid_code tree_validate(robot_reader *r, const xml_element *const *links, const xml_element *const *joints) {
    ovoid_code code = find_parents(r, joints);
    if (!code) code = find_loop(r, joints);
    if (!code) code = validate_root(r, links);
    return code ? code : validate_mimics(r, joints);
}
