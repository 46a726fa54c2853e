// Moving bodies as trees.
#include "body/moving_tree.h"

#include "base/environment.h"
#include "body/body_find.h"
#include "motion/motion_gap.h"

static const ovoid_pose still = {{0, 0, 0}, {1, 0, 0, 0}};
static const ovoid_pose no_part = {{0, 0, 0}, {0, 0, 0, 0}};

int moving_tree_make(const ovoid_moving_body *body, int has_boxes, moving_tree *tree) {
    const ovoid_body own = {.shape = body->shape, .compound = body->compound, .pose = still, .solid = body->solid};
    tree->body = body;
    tree->has_boxes = has_boxes;
    if (!solid_view_make(&own, &tree->view)) return 0;
    tree->view.pose = &still;
    if (!body->shape || has_boxes) return 1;
    compound_node node = node_make_shape(body->shape);
    tree->center = node.center;
    tree->radius = node.radius;
    return 1;
}

ovoid_limit moving_trees_make(const ovoid_moving_body *a, const ovoid_moving_body *b, moving_trees *trees) {
    trees->has_solid = a->solid || b->solid;
    if (!moving_tree_make(a, trees->has_solid, &trees->a)) return OVOID_LIMIT_SHAPE_A;
    return moving_tree_make(b, trees->has_solid, &trees->b) ? OVOID_LIMIT_NONE : OVOID_LIMIT_SHAPE_B;
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

static ovoid_moving_shape make_ball(const moving_tree *tree, vec3 center, double radius, moving_room *room) {
    point_make(&room->ball, radius);
    return (ovoid_moving_shape){&room->ball.shape, tree->body->motion, {center, still.rotation}};
}

// Centres and half sizes are off by a few u of the extent (frame.h); those of compounds have room for it.
ovoid_moving_shape moving_tree_make_ball(const moving_tree *tree, solid_ref ref, moving_room *room) {
    const solid_view *v = &tree->view;
    if (!tree->has_boxes && v->shape) return make_ball(tree, tree->center, tree->radius, room);
    if (!tree->has_boxes) {
        const compound_node *node = compound_get_node(v->compound, ref);
        return make_ball(tree, node->center, node->radius, room);
    }
    tree_box around = solid_view_get_box(v, ref);
    double radius = vec3_norm(around.half) * (1 + 0x1p-48) + 64 * 0x1p-53 * v->extent + OVOID_LENGTH_MIN;
    if (v->compound && !ref_is_triangle(ref)) radius = min2(radius, v->compound->nodes[ref].radius);
    return make_ball(tree, vec3_add(v->center, around.center), radius, room);
}

moving_shapes moving_trees_make_balls(const moving_trees *trees, solid_ref a, solid_ref b, moving_couple *couple) {
    couple->made[0] = moving_tree_make_ball(&trees->a, a, &couple->rooms[0]);
    couple->made[1] = moving_tree_make_ball(&trees->b, b, &couple->rooms[1]);
    return (moving_shapes){&couple->made[0], &couple->made[1]};
}

moving_shapes moving_trees_get_pair(const moving_trees *trees, solid_ref a, solid_ref b, moving_couple *couple) {
    if (!ref_is_triangle(a) || !ref_is_triangle(b)) return moving_trees_make_balls(trees, a, b, couple);
    couple->made[0] = moving_tree_get_leaf(&trees->a, ref_get_place(a), &couple->rooms[0]);
    couple->made[1] = moving_tree_get_leaf(&trees->b, ref_get_place(b), &couple->rooms[1]);
    return (moving_shapes){&couple->made[0], &couple->made[1]};
}

int moving_trees_split_first(const moving_trees *trees, solid_ref a, solid_ref b) {
    const solid_view *of_a = &trees->a.view, *of_b = &trees->b.view;
    return trees->has_solid ? solid_views_split_first(of_a, a, of_b, b) : parts_views_split_first(of_a, a, of_b, b);
}

static ovoid_body get_body(const ovoid_moving_body *body, double time) {
    return (ovoid_body){.shape = body->shape,
                        .compound = body->compound,
                        .pose = ovoid_motion_compute_pose(&body->motion, time),
                        .solid = body->solid};
}

void moving_trees_ask(const moving_trees *trees, double margin, double time, moving_answer *out) {
    const solid_ref root_a = solid_view_get_root(&trees->a.view), root_b = solid_view_get_root(&trees->b.view);
    moving_couple couple;
    moving_shapes balls = moving_trees_make_balls(trees, root_a, root_b, &couple);
    motion_pair pieces;
    ovoid_pair at;
    (void)motion_pair_make(balls.a, balls.b, time, &pieces);
    out->shift = motion_pair_find_pair(&pieces, time, &at);
    out->pair = (ovoid_body_pair){get_body(trees->a.body, time), get_body(trees->b.body, time)};
    query_goal goal = query_goal_make_within(margin);
    solid_find_internal(&out->pair, NULL, &goal, NULL, NULL, &out->answer);
}

int moving_answer_is_apart(const moving_answer *x, int linear) {
    const ovoid_body_answer *answer = &x->answer;
    if (answer->status != OVOID_SEPARATED || !(answer->deciding.lower > x->shift)) return 0;
    solid_view a, b;
    ovoid_body_inside inside;
    uint32_t component;
    if (!linear) return 1;
    if (!solid_view_make(&x->pair.a, &a) || !solid_view_make(&x->pair.b, &b)) return 0;
    return solid_find_inside(&a, &b, 1, &inside, &component) == 0;
}

// ---- boxes and parts

// The box of a part, or of the ball around a node or triangle.
static box find_box(const moving_tree *tree, solid_ref ref, double begin, double end) {
    moving_room room;
    int is_leaf = ref_is_triangle(ref) && !tree->body->solid;
    ovoid_moving_shape m =
        is_leaf ? moving_tree_get_leaf(tree, ref_get_place(ref), &room) : moving_tree_make_ball(tree, ref, &room);
    return ovoid_moving_shape_compute_box(&m, begin, end);
}

// The boxes of the nodes some steps below the root.
static box compute_box(const ovoid_moving_body *body, double begin, double end) {
    enum { DEPTH = 4 };
    const ovoid_box none = {{NAN, NAN, NAN}, {NAN, NAN, NAN}};
    struct {
        solid_ref ref;
        int depth;
    } stack[2 * DEPTH + BOX8];
    moving_tree tree;
    if (!moving_tree_make(body, body->solid != NULL, &tree)) return none;
    int count = 1, deepest = body->solid ? 1 : DEPTH;
    box all = box_make_empty();
    stack[0].ref = solid_view_get_root(&tree.view);
    stack[0].depth = 0;
    while (count > 0) {
        solid_ref ref = stack[--count].ref, children[BOX8];
        int depth = stack[count].depth;
        if (depth == deepest || ref_is_triangle(ref)) {
            box own = find_box(&tree, ref, begin, end);
            if (isnan(own.min.x)) return none;
            all = box_join(&all, &own);
            continue;
        }
        uint32_t more = solid_view_get_children(&tree.view, ref, children);
        for (uint32_t i = 0; i < more; i++, count++) {
            stack[count].ref = children[i];
            stack[count].depth = depth + 1;
        }
    }
    return all;
}

ovoid_box ovoid_moving_body_compute_box(const ovoid_moving_body *body, double begin, double end) {
    ENVIRONMENT_RETURN(ovoid_box, begin, compute_box(body, begin, end));
}

ovoid_moving_shape ovoid_moving_body_get_part(const ovoid_moving_body *body, size_t i) {
    if (!body->compound) return (ovoid_moving_shape){body->shape, body->motion, no_part};
    ovoid_posed_shape part = ovoid_compound_get_part(body->compound, i);
    return (ovoid_moving_shape){part.shape, body->motion, part.pose};
}
