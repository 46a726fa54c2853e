// The frame of a pair, and the gaps of boxes in it.
#include "body/tree_frame.h"

#include "linear/rotation.h"

static mat3 absolute_matrix(mat3 m) { return (mat3){vec3_abs(m.r0), vec3_abs(m.r1), vec3_abs(m.r2)}; }

void tree_frame_make(const body_tree *a, const body_tree *b, tree_frame *f) {
    f->world = quat_to_mat3(a->pose->rotation);
    f->world_b = quat_to_mat3(b->pose->rotation);
    f->to_a = mat3_mul_transposed(f->world, f->world_b);
    f->to_b = mat3_transpose(f->to_a);
    f->absolute_a = absolute_matrix(f->to_a);
    f->absolute_b = absolute_matrix(f->to_b);
    f->offset = vec3_sub(b->pose->position, a->pose->position);
    f->translation = mat3_mul_transposed_vec3(f->world, f->offset);
    f->translation_a = vec3_neg(mat3_mul_transposed_vec3(f->world_b, f->offset));
    f->between = vec3_sub(vec3_add(f->translation, mat3_mul_vec3(f->to_a, b->center)), a->center);
    f->size = trees_compute_size(a, b, f->offset);
    f->claim = trees_compute_claim(a, b, f->size);
    f->check = TREE_CHECK * f->size + OVOID_LENGTH_MIN;
}

// The gap of boxes of the given half sizes around two centres, and its direction, along the axes of the frame.
static box_gap find_axis_gap(vec3 d, vec3 half) {
    vec3 gap = vec3_sub(vec3_abs(d), half);
    vec3 out = {max2(gap.x, 0), max2(gap.y, 0), max2(gap.z, 0)};
    double norm = vec3_norm(out), most = max2(gap.x, max2(gap.y, gap.z));
    if (!(norm > 0)) out = (vec3){gap.x >= most, gap.x < most && gap.y >= most, gap.x < most && gap.y < most};
    vec3 n = vec3_unit((vec3){d.x < 0 ? -out.x : out.x, d.y < 0 ? -out.y : out.y, d.z < 0 ? -out.z : out.z});
    return (box_gap){norm > 0 ? norm : most, n};
}

static double find_reach(vec3 half, vec3 n) { return vec3_dot(half, vec3_abs(n)); }

// A box along the axes of the frame, and another one beside it.
typedef struct box_beside {
    vec3 own, other;      // half sizes
    vec3 d;               // from its centre to the other's
    const mat3 *rotation; // to the other's frame
    const mat3 *absolute; // the sizes of the rotation's entries
} box_beside;

// The direction across an axis of each box along which the gap is largest (S. Gottschalk, M. C. Lin, D. Manocha,
// OBBTree, 1996); x where all axes are parallel.
static vec3 find_across(const box_beside *boxes) {
    const vec3 row[3] = {boxes->rotation->r0, boxes->rotation->r1, boxes->rotation->r2};
    const vec3 size[3] = {boxes->absolute->r0, boxes->absolute->r1, boxes->absolute->r2};
    vec3 best = {1, 0, 0};
    double most = -INFINITY;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            // Axis i of the frame and row j of the rotation.
            int k = (i + 1) % 3, l = (i + 2) % 3, m = (j + 1) % 3, n = (j + 2) % 3;
            double u = vec3_get(row[j], k), v = vec3_get(row[j], l), square = u * u + v * v;
            if (!(square > SOLID8_PARALLEL)) continue;
            double at = vec3_get(boxes->d, l) * u - vec3_get(boxes->d, k) * v;
            double reach = vec3_get(boxes->own, l) * fabs(u) + vec3_get(boxes->own, k) * fabs(v) +
                           vec3_get(boxes->other, m) * vec3_get(size[n], i) +
                           vec3_get(boxes->other, n) * vec3_get(size[m], i);
            double scale = 1 / sqrt(square), gap = (fabs(at) - reach) * scale;
            if (!(gap > most)) continue;
            most = gap;
            scale = copysign(scale, at);
            double entry[3] = {0, 0, 0};
            entry[l] = u * scale;
            entry[k] = -v * scale;
            best = (vec3){entry[0], entry[1], entry[2]};
        }
    return best;
}

box_gap tree_frame_find_gap(const tree_frame *f, const turned_box *a, const turned_box *b, vec3 normal) {
    // In the frame of a's box: the vector between the centres, and the rotation to b's box.
    vec3 between = vec3_sub(vec3_add(f->between, mat3_mul_vec3(f->to_a, b->box.center)), a->box.center);
    vec3 d = mat3_mul_vec3(a->axes, between);
    const mat3 to_b = mat3_mul(mat3_mul(b->axes, f->to_b), mat3_transpose(a->axes)), absolute = absolute_matrix(to_b);
    vec3 half_a = a->box.half, half_b = b->box.half;
    box_gap best = find_axis_gap(d, vec3_add(half_a, mat3_mul_transposed_vec3(absolute, half_b)));
    box_gap next = find_axis_gap(mat3_mul_vec3(to_b, d), vec3_add(half_b, mat3_mul_vec3(absolute, half_a)));
    next.normal = mat3_mul_transposed_vec3(to_b, next.normal);
    if (next.lower > best.lower) best = next;
    int is_given = vec3_norm_squared(normal) > 0;
    vec3 tried[2] = {is_given ? mat3_mul_vec3(a->axes, normal)
                              : find_across(&(box_beside){half_a, half_b, d, &to_b, &absolute}),
                     vec3_unit(d)};
    for (int i = 0; i < 2; i++) {
        vec3 n = tried[i];
        if (!(vec3_norm_squared(n) > 0.5)) continue;
        double gap = vec3_dot(n, d) - find_reach(half_a, n) - find_reach(half_b, mat3_mul_vec3(to_b, n));
        if (gap > best.lower) best = (box_gap){gap, n};
    }
    best.normal = mat3_mul_transposed_vec3(a->axes, best.normal);
    return best;
}

box_gap tree_frame_find_parting(const tree_frame *f, const body_tree *a, const body_tree *b) {
    turned_box box_a = body_tree_get_turned_box(a, body_tree_get_root(a)),
               box_b = body_tree_get_turned_box(b, body_tree_get_root(b));
    box_gap gap = tree_frame_find_gap(f, &box_a, &box_b, (vec3){1, 0, 0});
    gap.lower -= f->claim;
    gap.normal = mat3_mul_vec3(f->world, gap.normal);
    return gap;
}

solid8_other tree_frame_turn(const tree_frame *f, const framed_node *node, vec3 normal) {
    // A box of b beside a node of a, or the other way round; the normal goes from a to b.
    const turned_box *rest = node->rest;
    vec3 half = rest->box.half;
    const mat3 rotation = mat3_mul(mat3_mul(rest->axes, node->side ? f->to_a : f->to_b), mat3_transpose(*node->axes));
    const mat3 all = absolute_matrix(rotation);
    vec3 center =
        mat3_mul_vec3(*node->axes, node->side ? mat3_mul_vec3(f->to_b, vec3_sub(rest->box.center, f->between))
                                              : vec3_add(f->between, mat3_mul_vec3(f->to_a, rest->box.center)));
    int is_given = vec3_norm_squared(normal) > 0;
    vec3 tried = mat3_mul_vec3(*node->axes, node->side ? vec3_neg(mat3_mul_vec3(f->to_b, normal)) : normal);
    return (solid8_other){.center = center,
                          .turned = mat3_mul_transposed_vec3(all, half),
                          .half = half,
                          .rotation = rotation,
                          .absolute = all,
                          .normal = tried,
                          .reach = is_given ? find_reach(half, mat3_mul_vec3(rotation, tried)) : INFINITY,
                          .across = !is_given,
                          .least = f->claim};
}
