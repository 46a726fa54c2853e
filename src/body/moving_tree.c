// Moving bodies as trees.
#include "body/moving_tree.h"

#include "base/environment.h"
#include "body/body_find.h"
#include "body/compound_impact.h"
#include "motion/motion_gap.h"

static const ovoid_pose still = {{0, 0, 0}, {1, 0, 0, 0}};
static const ovoid_pose no_part = {{0, 0, 0}, {0, 0, 0, 0}};

int moving_tree_make(const ovoid_moving_body *body, moving_tree *tree) {
    const ovoid_body own = {.shape = body->shape, .compound = body->compound, .pose = still, .solid = body->solid};
    tree->body = body;
    if (!solid_view_make(&own, &tree->view)) return 0;
    tree->view.pose = &still;
    return 1;
}

ovoid_moving_shape moving_tree_get_leaf(const moving_tree *tree, uint32_t place, moving_room *room) {
    const solid_view *v = &tree->view;
    if (v->compound) {
        const compound_part *part = &v->compound->parts[place];
        return (ovoid_moving_shape){part->shape, tree->body->motion, part->pose};
    }
    if (v->solid) triangle_begin(&room->triangle);
    return (ovoid_moving_shape){solid_view_get_leaf(v, place, &room->triangle).shape, tree->body->motion, no_part};
}

// Centres and half sizes are off by a few u of the extent (frame.h); those of compounds have room for it.
ovoid_moving_shape moving_tree_make_ball(const moving_tree *tree, solid_ref ref, moving_room *room) {
    const solid_view *v = &tree->view;
    tree_box around = solid_view_get_box(v, ref);
    double radius = vec3_norm(around.half) * (1 + 0x1p-48) + 64 * 0x1p-53 * v->extent + OVOID_LENGTH_MIN;
    if (v->compound && !ref_is_triangle(ref)) radius = min2(radius, v->compound->nodes[ref].radius);
    point_make(&room->ball, radius);
    return (ovoid_moving_shape){
        &room->ball.shape, tree->body->motion, {vec3_add(v->center, around.center), still.rotation}};
}

moving_shapes moving_trees_get_pair(const moving_tree *a, solid_ref ref_a, const moving_tree *b, solid_ref ref_b,
                                    ovoid_moving_shape made[2], moving_room rooms[2]) {
    if (ref_is_triangle(ref_a) && ref_is_triangle(ref_b)) {
        made[0] = moving_tree_get_leaf(a, ref_get_place(ref_a), &rooms[0]);
        made[1] = moving_tree_get_leaf(b, ref_get_place(ref_b), &rooms[1]);
    } else {
        made[0] = moving_tree_make_ball(a, ref_a, &rooms[0]);
        made[1] = moving_tree_make_ball(b, ref_b, &rooms[1]);
    }
    return (moving_shapes){&made[0], &made[1]};
}

int moving_trees_split_first(const moving_tree *a, solid_ref ref_a, const moving_tree *b, solid_ref ref_b) {
    return solid_views_split_first(&a->view, ref_a, &b->view, ref_b);
}

static ovoid_body get_body(const ovoid_moving_body *body, double time) {
    return (ovoid_body){.shape = body->shape,
                        .compound = body->compound,
                        .pose = ovoid_motion_compute_pose(&body->motion, time),
                        .solid = body->solid};
}

void moving_trees_ask(const moving_tree *a, const moving_tree *b, double margin, double time, moving_answer *out) {
    moving_room rooms[2];
    ovoid_moving_shape ball_a = moving_tree_make_ball(a, solid_view_get_root(&a->view), &rooms[0]),
                       ball_b = moving_tree_make_ball(b, solid_view_get_root(&b->view), &rooms[1]);
    motion_pair pieces;
    ovoid_pair at;
    (void)motion_pair_make(&ball_a, &ball_b, time, &pieces);
    out->shift = motion_pair_find_pair(&pieces, time, &at);
    out->pair = (ovoid_body_pair){get_body(a->body, time), get_body(b->body, time)};
    query_goal goal = query_goal_make_within(margin);
    solid_find_internal(&out->pair, NULL, &goal, NULL, NULL, &out->answer);
}

int moving_answer_is_apart(const moving_answer *x, int linear) {
    const ovoid_solid_answer *answer = &x->answer;
    if (answer->status != OVOID_SEPARATED || !(answer->surfaces.lower > x->shift)) return 0;
    solid_view a, b;
    ovoid_solid_inside inside;
    uint32_t component;
    if (!linear) return 1;
    if (!solid_view_make(&x->pair.a, &a) || !solid_view_make(&x->pair.b, &b)) return 0;
    return solid_find_inside(&a, &b, 1, &inside, &component) == 0;
}

// ---- boxes

// The balls around the root's children.
static box compute_box(const ovoid_moving_body *body, double begin, double end) {
    moving_tree tree;
    moving_room room;
    if (!body->solid) return moving_body_compute_box(body, begin, end);
    const ovoid_box none = {{NAN, NAN, NAN}, {NAN, NAN, NAN}};
    if (!moving_tree_make(body, &tree)) return none;
    solid_ref children[BOX8], root = solid_view_get_root(&tree.view);
    box all = box_make_empty();
    uint32_t count = solid_view_get_children(&tree.view, root, children);
    for (uint32_t i = 0; i < count; i++) {
        ovoid_moving_shape ball = moving_tree_make_ball(&tree, children[i], &room);
        box own = ovoid_moving_shape_compute_box(&ball, begin, end);
        if (isnan(own.min.x)) return none;
        all = box_join(&all, &own);
    }
    return all;
}

ovoid_box ovoid_moving_body_compute_box(const ovoid_moving_body *body, double begin, double end) {
    ENVIRONMENT_RETURN(ovoid_box, begin, compute_box(body, begin, end));
}
