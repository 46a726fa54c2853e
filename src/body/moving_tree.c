// Moving bodies as trees.
#include "body/moving_tree.h"

#include "base/environment.h"
#include "body/body_find.h"
#include "motion/motion_gap.h"

static const ovoid_pose still = {{0, 0, 0}, {1, 0, 0, 0}};
static const ovoid_pose no_part = {{0, 0, 0}, {0, 0, 0, 0}};

int moving_tree_make(const ovoid_moving_body *body, int has_boxes, moving_tree *moving) {
    const ovoid_body own = {.shape = body->shape, .compound = body->compound, .pose = still, .solid = body->solid};
    moving->body = body;
    moving->has_boxes = has_boxes;
    if (!body_tree_make(&own, &moving->tree)) return 0;
    moving->tree.pose = &still;
    if (!body->shape || has_boxes) return 1;
    compound_node node = node_make_shape(body->shape);
    moving->center = node.center;
    moving->radius = node.radius;
    return 1;
}

ovoid_limit moving_trees_make(const ovoid_moving_body *a, const ovoid_moving_body *b, moving_trees *trees) {
    trees->has_solid = a->solid || b->solid;
    if (!moving_tree_make(a, trees->has_solid, &trees->a)) return OVOID_LIMIT_SHAPE_A;
    return moving_tree_make(b, trees->has_solid, &trees->b) ? OVOID_LIMIT_NONE : OVOID_LIMIT_SHAPE_B;
}

ovoid_moving_shape moving_tree_get_leaf(const moving_tree *moving, uint32_t place, moving_room *room) {
    const body_tree *tree = &moving->tree;
    if (tree->compound) {
        const compound_part *part = &tree->compound->parts[place];
        return (ovoid_moving_shape){part->shape, moving->body->motion, part->pose};
    }
    if (tree->solid) triangle_begin(&room->triangle);
    return (ovoid_moving_shape){body_tree_get_leaf(tree, place, &room->triangle).shape, moving->body->motion, no_part};
}

static ovoid_moving_shape make_ball(const moving_tree *moving, vec3 center, double radius, moving_room *room) {
    point_make(&room->ball, radius);
    return (ovoid_moving_shape){&room->ball.shape, moving->body->motion, {center, still.rotation}};
}

// Centres and half sizes are off by a few u of the extent (frame.h); those of compounds have room for it.
ovoid_moving_shape moving_tree_make_ball(const moving_tree *moving, tree_ref ref, moving_room *room) {
    const body_tree *tree = &moving->tree;
    if (!moving->has_boxes && tree->shape) return make_ball(moving, moving->center, moving->radius, room);
    if (!moving->has_boxes) {
        const compound_node *node = &tree->compound->nodes[ref_get_index(ref)];
        return make_ball(moving, node->center, node->radius, room);
    }
    tree_box around = body_tree_get_box(tree, ref);
    double radius = vec3_norm(around.half) * (1 + 0x1p-48) + 64 * 0x1p-53 * tree->extent + OVOID_LENGTH_MIN;
    if (tree->compound && !ref_is_leaf(ref)) radius = min2(radius, tree->compound->nodes[ref].radius);
    return make_ball(moving, vec3_add(tree->center, around.center), radius, room);
}

moving_shapes moving_trees_make_balls(const moving_trees *trees, tree_ref a, tree_ref b, moving_couple *couple) {
    couple->made[0] = moving_tree_make_ball(&trees->a, a, &couple->rooms[0]);
    couple->made[1] = moving_tree_make_ball(&trees->b, b, &couple->rooms[1]);
    return (moving_shapes){&couple->made[0], &couple->made[1]};
}

moving_shapes moving_trees_get_leaves(const moving_trees *trees, uint32_t a, uint32_t b, moving_couple *couple) {
    couple->made[0] = moving_tree_get_leaf(&trees->a, a, &couple->rooms[0]);
    couple->made[1] = moving_tree_get_leaf(&trees->b, b, &couple->rooms[1]);
    return (moving_shapes){&couple->made[0], &couple->made[1]};
}

moving_shapes moving_trees_get_pair(const moving_trees *trees, tree_ref a, tree_ref b, moving_couple *couple) {
    if (!ref_is_leaf(a) || !ref_is_leaf(b)) return moving_trees_make_balls(trees, a, b, couple);
    uint32_t place_a = body_tree_get_leaf_place(&trees->a.tree, a),
             place_b = body_tree_get_leaf_place(&trees->b.tree, b);
    return moving_trees_get_leaves(trees, place_a, place_b, couple);
}

static ovoid_body get_body(const ovoid_moving_body *body, double time) {
    return (ovoid_body){.shape = body->shape,
                        .compound = body->compound,
                        .pose = ovoid_motion_compute_pose(&body->motion, time),
                        .solid = body->solid};
}

void moving_trees_ask(const moving_trees *trees, double margin, double time, moving_answer *out) {
    const tree_ref root_a = body_tree_get_root(&trees->a.tree), root_b = body_tree_get_root(&trees->b.tree);
    moving_couple couple;
    moving_shapes balls = moving_trees_make_balls(trees, root_a, root_b, &couple);
    motion_pair pieces;
    ovoid_pair at;
    (void)motion_pair_make(balls.a, balls.b, time, &pieces);
    out->shift = motion_pair_find_pair(&pieces, time, &at);
    out->pair = (ovoid_body_pair){get_body(trees->a.body, time), get_body(trees->b.body, time)};
    query_goal goal = query_goal_make_within(margin);
    body_find_internal(&out->pair, &(body_request){NULL, &goal, NULL, NULL}, &out->answer);
}

int moving_answer_is_apart(const moving_answer *x, int linear) {
    const ovoid_body_answer *answer = &x->answer;
    if (answer->status != OVOID_SEPARATED || !(answer->deciding.lower > x->shift)) return 0;
    body_tree a, b;
    contained_component found;
    if (!linear) return 1;
    if (!body_tree_make(&x->pair.a, &a) || !body_tree_make(&x->pair.b, &b)) return 0;
    return trees_find_inside(&a, &b, 1, &found) == 0;
}

// ---- boxes and parts

// The box of a part, or of the ball around a node or triangle.
static box find_box(const moving_tree *moving, tree_ref ref, double begin, double end) {
    moving_room room;
    int is_leaf = ref_is_leaf(ref) && !moving->body->solid;
    ovoid_moving_shape m = is_leaf ? moving_tree_get_leaf(moving, body_tree_get_leaf_place(&moving->tree, ref), &room)
                                   : moving_tree_make_ball(moving, ref, &room);
    return ovoid_moving_shape_compute_box(&m, begin, end);
}

// The boxes of the nodes some steps below the root.
static box compute_box(const ovoid_moving_body *body, double begin, double end) {
    enum { DEPTH = 4 };
    const ovoid_box none = {{NAN, NAN, NAN}, {NAN, NAN, NAN}};
    struct {
        tree_ref ref;
        int depth;
    } stack[2 * DEPTH + BOX8];
    moving_tree moving;
    if (!moving_tree_make(body, body->solid != NULL, &moving)) return none;
    int count = 1, deepest = body->solid ? 1 : DEPTH;
    box all = box_make_empty();
    stack[0].ref = body_tree_get_root(&moving.tree);
    stack[0].depth = 0;
    while (count > 0) {
        tree_ref ref = stack[--count].ref, children[BOX8];
        int depth = stack[count].depth;
        if (depth == deepest || ref_is_leaf(ref)) {
            box own = find_box(&moving, ref, begin, end);
            if (isnan(own.min.x)) return none;
            all = box_join(&all, &own);
            continue;
        }
        uint32_t more = body_tree_get_children(&moving.tree, ref, children);
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
