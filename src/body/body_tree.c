// A posed body as a tree, and triangles as shapes.
#include "body/body_tree.h"

#include "base/compiler.h"
#include "linear/pose.h"

#include <string.h>

// Sets what is left of the tree of a shape.
static void set_shape(body_tree *tree) {
    const ovoid_shape *s = tree->shape;
    const ovoid_box *b = &s->measures.box;
    tree->center = vec3_add(s->origin, vec3_scale(vec3_add(b->min, b->max), 0.5));
    tree->half = vec3_scale(vec3_sub(b->max, b->min), 0.5);
    double r = s->lower_radius;
    tree->half = vec3_add(tree->half, (vec3){r, r, r});
    tree->extent = vec3_norm(s->origin) * (1 + 0x1p-50) + s->span + s->lower_radius;
    tree->allowance = shape_get_width(s);
    tree->count = 1;
}

// Field by field: far bodies are told apart in less time than it takes to clear two trees first.
COMPILER_INLINED int make(const ovoid_body *body, body_tree *tree) {
    const ovoid_pose *pose = &body->pose;
    if (!body_is_one(body) || (!pose_is_plain(pose) && pose_validate(pose) != OVOID_OK)) return 0;
    tree->solid = body->solid;
    tree->shape = body->shape;
    tree->compound = body->compound;
    tree->pose = pose;
    if (tree->solid) {
        tree->center = tree->solid->center;
        tree->extent = tree->solid->extent;
        tree->allowance = 0;
        tree->count = tree->solid->triangle_count;
    } else if (tree->compound) {
        tree->center = (vec3){0, 0, 0};
        tree->extent = tree->compound->extent;
        tree->allowance = tree->compound->allowance;
        tree->count = tree->compound->count;
    } else
        set_shape(tree);
    return vec3_norm(pose->position) + tree->extent <= OVOID_LENGTH_MAX;
}

int body_tree_make(const ovoid_body *body, body_tree *tree) { return make(body, tree); }

ovoid_limit body_trees_make(const ovoid_body_pair *pair, body_tree *a, body_tree *b) {
    if (!body_is_one(&pair->a)) return OVOID_LIMIT_SHAPE_A;
    if (!body_is_one(&pair->b)) return OVOID_LIMIT_SHAPE_B;
    if (!make(&pair->a, a)) return OVOID_LIMIT_POSE_A;
    return make(&pair->b, b) ? OVOID_LIMIT_NONE : OVOID_LIMIT_POSE_B;
}

void body_tree_get_range(const body_tree *tree, tree_ref ref, uint32_t *first, uint32_t *end) {
    uint32_t at = ref_get_index(ref);
    if (tree->compound) {
        *first = tree->compound->nodes[at].first;
        *end = tree->compound->nodes[at].end;
    } else if (ref_is_leaf(ref)) {
        *first = at;
        *end = at + 1;
    } else {
        *first = tree->solid->nodes[at].first;
        *end = tree->solid->nodes[at].end;
    }
}

uint32_t body_tree_get_children(const body_tree *tree, tree_ref node, tree_ref children[BOX8]) {
    if (tree->compound) {
        const compound_node *n = &tree->compound->nodes[node];
        children[0] = compound_get_ref(tree->compound, node_get_left(n));
        children[1] = compound_get_ref(tree->compound, node_get_right(n));
        return 2;
    }
    uint32_t count = tree->solid->nodes[node].children;
    for (uint32_t i = 0; i < count; i++) children[i] = solid_get_child(tree->solid, node, i);
    return count;
}

tree_box body_tree_get_box(const body_tree *tree, tree_ref ref) {
    if (tree->shape) return (tree_box){{0, 0, 0}, tree->half};
    if (tree->compound) {
        const compound_node *n = &tree->compound->nodes[ref_get_index(ref)];
        return (tree_box){n->center, n->half};
    }
    float own[2][3];
    const float *low = own[0], *high = own[1];
    if (ref_is_leaf(ref)) {
        // As its node has it: rounded to single precision, so that both have the same centre.
        box b = solid_make_bounds(tree->solid, &tree->solid->triangles[ref_get_index(ref)]);
        box8_round_out(&b, own[0], own[1]);
    } else {
        low = tree->solid->nodes[ref].low;
        high = tree->solid->nodes[ref].high;
    }
    return solid_scale_box(tree->solid, low, high);
}

// A box along axes, whose centre is turned into the tree's frame.
static turned_box turn_box(tree_box along, const mat3 *axes) {
    return (turned_box){{mat3_mul_transposed_vec3(*axes, along.center), along.half}, *axes};
}

// Along the longest edge and the plane.
static turned_box get_triangle_box(const ovoid_solid *s, uint32_t place) {
    vec3 p[3], edge[3];
    int longest = 0;
    for (int i = 0; i < 3; i++) p[i] = vec3_sub(solid_get_corner(s, place, i), s->center);
    for (int i = 0; i < 3; i++) {
        edge[i] = vec3_sub(p[(i + 1) % 3], p[i]);
        if (vec3_norm_squared(edge[i]) > vec3_norm_squared(edge[longest])) longest = i;
    }
    const mat3 axes = axes_make(edge[longest], edge[(longest + 1) % 3]);
    box around = box_make_empty();
    for (int i = 0; i < 3; i++) around = box_add_point(&around, mat3_mul_vec3(axes, p[i]));
    return turn_box((tree_box){vec3_scale(vec3_add(around.max, around.min), 0.5),
                               vec3_scale(vec3_sub(around.max, around.min), 0.5)},
                    &axes);
}

turned_box body_tree_get_turned_box(const body_tree *tree, tree_ref ref) {
    if (tree->shape || tree->compound) return (turned_box){body_tree_get_box(tree, ref), axes_upright};
    if (ref_is_leaf(ref)) return get_triangle_box(tree->solid, ref_get_index(ref));
    const node_frame *f = &tree->solid->frames[ref];
    return turn_box(solid_scale_box(tree->solid, f->low, f->high), &f->axes);
}

// From the root down, by the places below a node; ref is not the root.
static uint32_t find_parent(const ovoid_solid *s, tree_ref ref, uint32_t *lane) {
    uint32_t place = ref_is_leaf(ref) ? ref_get_index(ref) : s->nodes[ref].first;
    for (uint32_t node = 0;;) {
        tree_ref below = 0;
        for (*lane = 0; *lane < s->nodes[node].children; ++*lane) {
            below = solid_get_child(s, node, *lane);
            if (below == ref) return node;
            if (!ref_is_leaf(below) && s->nodes[below].first <= place && place < s->nodes[below].end) break;
        }
        node = below;
    }
}

turned_box body_tree_get_child_box(const body_tree *tree, tree_ref ref) {
    if (tree->shape || tree->compound || ref == body_tree_get_root(tree)) return body_tree_get_turned_box(tree, ref);
    uint32_t lane, node = find_parent(tree->solid, ref, &lane);
    const box8 *boxes = &tree->solid->turned[node];
    const float low[3] = {boxes->low[0][lane], boxes->low[1][lane], boxes->low[2][lane]};
    const float high[3] = {boxes->high[0][lane], boxes->high[1][lane], boxes->high[2][lane]};
    return turn_box(solid_scale_box(tree->solid, low, high), &tree->solid->frames[node].axes);
}

int trees_split_first(const body_tree *a, tree_ref ref_a, const body_tree *b, tree_ref ref_b) {
    if (ref_is_leaf(ref_a) || ref_is_leaf(ref_b)) return ref_is_leaf(ref_b);
    if (a->compound && b->compound) return a->compound->nodes[ref_a].radius >= b->compound->nodes[ref_b].radius;
    vec3 half_a = body_tree_get_box(a, ref_a).half, half_b = body_tree_get_box(b, ref_b).half;
    return half_a.x + half_a.y + half_a.z >= half_b.x + half_b.y + half_b.z;
}

void triangle_begin(triangle_shape *t) {
    memset(t, 0, sizeof *t);
    block_set_radius(&t->shape, 0, (ovoid_allowance){0});
    t->shape.vertex_count = t->shape.counts.vertices = 3;
    t->shape.padded_count = 8;
    t->shape.rank = 2;
    t->shape.at.x = offsetof(triangle_shape, lanes);
    t->shape.at.y = t->shape.at.x + sizeof t->lanes[0];
    t->shape.at.z = t->shape.at.y + sizeof t->lanes[0];
    t->shape.at.vertices = offsetof(triangle_shape, vertices);
    t->shape.at.size = sizeof *t;
}

void triangle_set(triangle_shape *t, const vec3 c[3]) {
    ovoid_shape *s = &t->shape;
    for (int i = 0; i < 8; i++) {
        vec3 p = c[i < 3 ? i : 0];
        t->lanes[0][i] = p.x;
        t->lanes[1][i] = p.y;
        t->lanes[2][i] = p.z;
    }
    for (int i = 0; i < 3; i++) {
        t->vertices[3 * i] = c[i].x;
        t->vertices[3 * i + 1] = c[i].y;
        t->vertices[3 * i + 2] = c[i].z;
    }
    // A sphere around the middle of the box, and the ellipsoids that queries may look at: that sphere, and a corner.
    vec3 low = {min2(c[0].x, min2(c[1].x, c[2].x)), min2(c[0].y, min2(c[1].y, c[2].y)),
                min2(c[0].z, min2(c[1].z, c[2].z))};
    vec3 high = {max2(c[0].x, max2(c[1].x, c[2].x)), max2(c[0].y, max2(c[1].y, c[2].y)),
                 max2(c[0].z, max2(c[1].z, c[2].z))};
    s->center = vec3_scale(vec3_add(low, high), 0.5);
    double reach = 0, extent = 0;
    for (int i = 0; i < 3; i++) {
        reach = max2(reach, vec3_norm(vec3_sub(c[i], s->center)));
        extent = max2(extent, vec3_norm(c[i]));
    }
    // Norms are off by 4 u, differences from the centre by u of the corner.
    s->reach = reach * (1 + 0x1p-49) + OVOID_LENGTH_MIN;
    s->extent = s->span = extent * (1 + 0x1p-49) + OVOID_LENGTH_MIN;
    s->first = c[0];
    double square = 1.01 * s->reach * s->reach;
    s->outer = (ovoid_ellipsoid){.center = s->center, .q = {square, 0, 0, square, 0, square}};
    s->inner = (ovoid_ellipsoid){.center = c[0]};
}

ovoid_posed_shape solid_get_leaf(const body_tree *tree, uint32_t place, triangle_shape *room) {
    const vec3 corner[3] = {solid_get_corner(tree->solid, place, 0), solid_get_corner(tree->solid, place, 1),
                            solid_get_corner(tree->solid, place, 2)};
    triangle_set(room, corner);
    return (ovoid_posed_shape){&room->shape, *tree->pose};
}
