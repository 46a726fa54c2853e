// The tree of links: its root, each link's joint, and an order of the joints in which parents come before children.
// Linear: a breadth-first search over the joints sorted by their parent links.
#include "base/error.h"
#include "robot/model/robot.h"

// The joint above each link; ARGUMENT where a link hangs on two.
static ovoid_code find_parents(ovoid_robot *r, ovoid_error *error) {
    for (uint32_t i = 0; i < r->link_count; i++) r->parent_joint[i] = OVOID_ROBOT_NONE;
    for (uint32_t i = 0; i < r->joint_count; i++) {
        const ovoid_robot_joint *j = &r->joints[i];
        uint32_t other = r->parent_joint[j->child];
        if (other != OVOID_ROBOT_NONE)
            return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)j->child,
                             "link \"%.60s\" hangs on two joints, \"%.60s\" and \"%.60s\"", r->links[j->child].name,
                             r->joints[other].name, j->name);
        r->parent_joint[j->child] = i;
    }
    return OVOID_OK;
}

// The root; ARGUMENT where there is none, or another.
static ovoid_code find_root(ovoid_robot *r, ovoid_error *error) {
    r->root = OVOID_ROBOT_NONE;
    for (uint32_t i = 0; i < r->link_count; i++) {
        if (r->parent_joint[i] != OVOID_ROBOT_NONE) continue;
        if (r->root != OVOID_ROBOT_NONE)
            return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)i,
                             "two roots: links \"%.80s\" and \"%.80s\" hang on no joint", r->links[r->root].name,
                             r->links[i].name);
        r->root = i;
    }
    if (r->root != OVOID_ROBOT_NONE) return OVOID_OK;
    return error_set(error, OVOID_ERROR_ARGUMENT, 0,
                     "a loop: every link hangs on a joint, \"%.80s\" too, so none is the root", r->links[0].name);
}

// The joints sorted by parent: starts[l] .. starts[l + 1] of `order`-like `sorted`.
static void sort_by_parent(const ovoid_robot *r, uint32_t *starts, uint32_t *sorted) {
    for (uint32_t i = 0; i <= r->link_count; i++) starts[i] = 0;
    for (uint32_t i = 0; i < r->joint_count; i++) starts[r->joints[i].parent]++;
    for (uint32_t i = 0, sum = 0; i <= r->link_count; i++) starts[i] = sum += starts[i];
    for (uint32_t i = r->joint_count; i-- > 0;) sorted[--starts[r->joints[i].parent]] = i;
}

ovoid_code tree_find_order(ovoid_robot *r, uint32_t *scratch, ovoid_error *error) {
    ovoid_code code = find_parents(r, error);
    if (code == OVOID_OK) code = find_root(r, error);
    if (code != OVOID_OK) return code;
    uint32_t *starts = scratch, *sorted = scratch + r->link_count + 1, count = 0;
    sort_by_parent(r, starts, sorted);
    uint32_t link = r->root;
    for (uint32_t next = 0;; link = r->joints[r->order[next++]].child) {
        for (uint32_t k = starts[link]; k < starts[link + 1]; k++) r->order[count++] = sorted[k];
        if (next == count) break;
    }
    if (count == r->joint_count) return OVOID_OK;
    // One root, one joint above every other link: what is not reached hangs on itself.
    for (uint32_t k = 0; k < count; k++) r->parent_joint[r->joints[r->order[k]].child] = OVOID_ROBOT_NONE;
    for (link = 0; r->parent_joint[link] == OVOID_ROBOT_NONE;) link++;
    return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)link,
                     "a loop: link \"%.80s\" hangs on itself, by joint \"%.80s\"", r->links[link].name,
                     r->joints[r->parent_joint[link]].name);
}
