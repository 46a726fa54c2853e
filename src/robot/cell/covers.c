// Pairs that balls and slabs part, before anything exact is asked: eight balls that cover one body, in the frame of the
// other one, against its extent along thirteen directions (simd/robot/cover8_kernel.h). Two links are tried both ways.
#include "robot/cell/checker.h"

// A body where it is in the world.
typedef struct placed_body {
    const mat3 *rotation;
    vec3 position;
    double size; ///< the lengths that its slabs, or balls, are made of
} placed_body;

// What rounding does to a ball's place in the other body's frame, at most.
static double find_slack(const placed_body *a, const placed_body *b) {
    return CELL_SLACK * (4 * (vec3_sum_abs(a->position) + vec3_sum_abs(b->position)) + (a->size + b->size));
}

static int are_balls_far(const ovoid_robot_checker *checker, const outer_balls *balls, const body_place *place,
                         const body_slabs *slabs, double reach) {
    return !checker->kernels->near_resting(&balls->lanes, place, slabs, reach);
}

static body_place find_place(const placed_body *a, const placed_body *in) {
    mat3 back = mat3_transpose(*in->rotation);
    return (body_place){mat3_mul(back, *a->rotation), mat3_mul_vec3(back, vec3_sub(a->position, in->position))};
}

static placed_body get_item(ovoid_robot_checker *checker, uint32_t item) {
    const cell_item *it = &cell_items(checker->cell)[item];
    const link_frame *f = checker_get_frame(checker, it->frame);
    return (placed_body){&f->matrix, f->position, it->inside->size};
}

int checker_is_cover_far(ovoid_robot_checker *checker, const checker_pair *p, pair_name name, double margin) {
    const ovoid_robot_cell *c = checker->cell;
    double reach = add_up(margin, p->padding, p->error);
    if (name.item != OVOID_ROBOT_NONE) {
        const cell_part *part = &cell_parts(c)[name.index];
        placed_body a = get_item(checker, name.item), b = {&part->box.rotation, part->pose.position, part->size};
        body_place place = find_place(&a, &b);
        return are_balls_far(checker, &cell_items(c)[name.item].inside->outer, &place, &part->slabs,
                             reach + find_slack(&a, &b));
    }
    item_pair both = cell_pairs(c)[name.index];
    placed_body a = get_item(checker, both.a), b = get_item(checker, both.b);
    const outer_balls *of_a = &cell_items(c)[both.a].inside->outer, *of_b = &cell_items(c)[both.b].inside->outer;
    body_place place = find_place(&a, &b);
    reach += find_slack(&a, &b);
    if (are_balls_far(checker, of_a, &place, &of_b->slabs, reach)) return 1;
    place = find_place(&b, &a);
    return are_balls_far(checker, of_b, &place, &of_a->slabs, reach);
}
