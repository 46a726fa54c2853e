// The frame of a pair, boxes in it, and triangles as shapes.
#include "body/frame.h"

#include "linear/rotation.h"

#include <string.h>

int solid_view_make(const ovoid_body *body, solid_view *v) {
    if (!body_is_one(body) || pose_validate(&body->pose) != OVOID_OK) return 0;
    *v = (solid_view){
        .solid = body->solid, .shape = body->shape, .compound = body->compound, .pose = &body->pose, .count = 1};
    if (v->solid) {
        v->center = v->solid->center;
        v->extent = v->solid->extent;
        v->count = v->solid->triangle_count;
    } else if (v->compound) {
        v->extent = v->compound->extent;
        v->allowance = v->compound->allowance;
        v->count = v->compound->count;
    } else {
        const ovoid_shape *s = v->shape;
        const ovoid_box *b = &s->measures.box;
        v->center = vec3_add(s->origin, vec3_scale(vec3_add(b->min, b->max), 0.5));
        v->half = vec3_scale(vec3_sub(b->max, b->min), 0.5);
        double r = s->lower_radius;
        v->half = vec3_add(v->half, (vec3){r, r, r});
        v->extent = vec3_norm(s->origin) * (1 + 0x1p-50) + s->span + s->lower_radius;
        v->allowance = shape_get_width(s);
    }
    return vec3_norm(v->pose->position) + v->extent <= OVOID_LENGTH_MAX;
}

// The node of a compound's leaf: down to the child that holds the place.
static const compound_node *find_part_node(const ovoid_compound *c, uint32_t place) {
    const compound_node *n = c->nodes;
    while (!node_is_leaf(n)) n = place < node_get_left(n)->end ? node_get_left(n) : node_get_right(n);
    return n;
}

const compound_node *compound_get_node(const ovoid_compound *c, solid_ref ref) {
    return ref_is_triangle(ref) ? find_part_node(c, ref_get_place(ref)) : &c->nodes[ref];
}

void solid_view_get_range(const solid_view *v, solid_ref ref, uint32_t *first, uint32_t *end) {
    if (ref_is_triangle(ref)) {
        *first = ref_get_place(ref);
        *end = *first + 1;
    } else if (v->solid) {
        *first = v->solid->nodes[ref].first;
        *end = v->solid->nodes[ref].end;
    } else {
        *first = v->compound->nodes[ref].first;
        *end = v->compound->nodes[ref].end;
    }
}

uint32_t solid_view_get_children(const solid_view *v, solid_ref node, solid_ref children[BOX8]) {
    if (v->compound) {
        const compound_node *n = &v->compound->nodes[node], *two[2] = {node_get_left(n), node_get_right(n)};
        for (int i = 0; i < 2; i++)
            children[i] =
                node_is_leaf(two[i]) ? two[i]->first | SOLID_TRIANGLE : (solid_ref)(two[i] - v->compound->nodes);
        return 2;
    }
    uint32_t count = v->solid->nodes[node].children;
    for (uint32_t i = 0; i < count; i++) children[i] = solid_get_child(v->solid, node, i);
    return count;
}

// The triangle's box as its node has it: rounded to single precision, so that both have the same centre.
static void set_triangle_box(const ovoid_solid *s, uint32_t place, float low[3], float high[3]) {
    box b = solid_make_bounds(s, &s->triangles[place]);
    const double least[3] = {b.min.x, b.min.y, b.min.z}, most[3] = {b.max.x, b.max.y, b.max.z};
    for (int k = 0; k < 3; k++) {
        low[k] = box8_round_down(least[k]);
        high[k] = box8_round_up(most[k]);
    }
}

tree_box solid_view_get_box(const solid_view *v, solid_ref ref) {
    if (v->shape) return (tree_box){{0, 0, 0}, v->half};
    if (v->compound) {
        const compound_node *n = compound_get_node(v->compound, ref);
        return (tree_box){n->center, n->half};
    }
    float own[2][3];
    const float *low = own[0], *high = own[1];
    if (ref_is_triangle(ref)) {
        set_triangle_box(v->solid, ref_get_place(ref), own[0], own[1]);
    } else {
        low = v->solid->nodes[ref].low;
        high = v->solid->nodes[ref].high;
    }
    vec3 from = {low[0], low[1], low[2]}, to = {high[0], high[1], high[2]};
    double half = 0.5 * v->solid->unit;
    return (tree_box){vec3_scale(vec3_add(to, from), half), vec3_scale(vec3_sub(to, from), half)};
}

int solid_views_split_first(const solid_view *a, solid_ref ref_a, const solid_view *b, solid_ref ref_b) {
    tree_box box_a = solid_view_get_box(a, ref_a), box_b = solid_view_get_box(b, ref_b);
    return pair_is_split_first(ref_a, &box_a, ref_b, &box_b);
}

int parts_views_split_first(const solid_view *a, solid_ref ref_a, const solid_view *b, solid_ref ref_b) {
    if (ref_is_triangle(ref_a) || ref_is_triangle(ref_b)) return ref_is_triangle(ref_b);
    return a->compound->nodes[ref_a].radius >= b->compound->nodes[ref_b].radius;
}

static vec3 absolute(vec3 v) { return (vec3){fabs(v.x), fabs(v.y), fabs(v.z)}; }

static mat3 absolute_matrix(mat3 m) { return (mat3){absolute(m.r0), absolute(m.r1), absolute(m.r2)}; }

void solid_frame_make(const solid_view *a, const solid_view *b, solid_frame *f) {
    f->world = quat_to_mat3(a->pose->rotation);
    f->world_b = quat_to_mat3(b->pose->rotation);
    f->to_a = mat3_mul_transposed(f->world, f->world_b);
    f->to_b = mat3_transpose(f->to_a);
    f->absolute_a = absolute_matrix(f->to_a);
    f->absolute_b = absolute_matrix(f->to_b);
    f->offset = vec3_sub(b->pose->position, a->pose->position);
    f->translation = mat3_mul_transposed_vec3(f->world, f->offset);
    f->between = vec3_sub(vec3_add(f->translation, mat3_mul_vec3(f->to_a, b->center)), a->center);
    f->size = a->extent + b->extent + vec3_norm(f->offset);
    f->claim = SOLID_CLAIM * f->size + 4 * OVOID_LENGTH_MIN;
    if (a->compound || b->compound)
        f->claim += 8 * 0x1p-53 * (vec3_norm(a->pose->position) + vec3_norm(b->pose->position));
    f->check = SOLID_CHECK * f->size + OVOID_LENGTH_MIN;
}

// The gap of boxes of the given half sizes around two centres, and its direction, along the axes of the frame.
static box_gap find_axis_gap(vec3 d, vec3 half) {
    vec3 gap = vec3_sub(absolute(d), half);
    vec3 out = {max2(gap.x, 0), max2(gap.y, 0), max2(gap.z, 0)};
    double norm = vec3_norm(out), most = max2(gap.x, max2(gap.y, gap.z));
    if (!(norm > 0)) out = (vec3){gap.x >= most, gap.x < most && gap.y >= most, gap.x < most && gap.y < most};
    vec3 n = vec3_unit((vec3){d.x < 0 ? -out.x : out.x, d.y < 0 ? -out.y : out.y, d.z < 0 ? -out.z : out.z});
    return (box_gap){norm > 0 ? norm : most, n};
}

static double find_reach(vec3 half, vec3 n) { return vec3_dot(half, absolute(n)); }

// The gap along a unit direction of a's frame.
static box_gap find_gap_along(const solid_frame *f, const tree_box *a, const tree_box *b, vec3 d, vec3 n) {
    return (box_gap){vec3_dot(n, d) - find_reach(a->half, n) - find_reach(b->half, mat3_mul_vec3(f->to_b, n)), n};
}

box_gap solid_frame_find_gap(const solid_frame *f, const tree_box *a, const tree_box *b, vec3 normal) {
    vec3 d = vec3_sub(vec3_add(f->between, mat3_mul_vec3(f->to_a, b->center)), a->center);
    box_gap best = find_axis_gap(d, vec3_add(a->half, mat3_mul_vec3(f->absolute_a, b->half)));
    box_gap next = find_axis_gap(mat3_mul_vec3(f->to_b, d), vec3_add(b->half, mat3_mul_vec3(f->absolute_b, a->half)));
    next.normal = mat3_mul_vec3(f->to_a, next.normal);
    if (next.lower > best.lower) best = next;
    next = find_gap_along(f, a, b, d, normal);
    if (next.lower > best.lower) best = next;
    vec3 line = vec3_unit(d);
    if (!(vec3_norm_squared(line) > 0.5)) return best;
    next = find_gap_along(f, a, b, d, line);
    return next.lower > best.lower ? next : best;
}

box_gap solid_frame_find_parting(const solid_frame *f, const solid_view *a, const solid_view *b) {
    tree_box box_a = solid_view_get_box(a, solid_view_get_root(a)),
             box_b = solid_view_get_box(b, solid_view_get_root(b));
    box_gap gap = solid_frame_find_gap(f, &box_a, &box_b, (vec3){1, 0, 0});
    gap.lower -= f->claim;
    gap.normal = mat3_mul_vec3(f->world, gap.normal);
    return gap;
}

void solid_frame_turn(const solid_frame *f, int side, const tree_box *rest, vec3 normal, solid8_other *o) {
    // A box of b beside nodes of a, or the other way round; the normal goes from a to b.
    o->center = side ? mat3_mul_vec3(f->to_b, vec3_sub(rest->center, f->between))
                     : vec3_add(f->between, mat3_mul_vec3(f->to_a, rest->center));
    o->rotation = side ? f->to_a : f->to_b;
    o->absolute = side ? f->absolute_a : f->absolute_b;
    o->turned = mat3_mul_vec3(side ? f->absolute_b : f->absolute_a, rest->half);
    o->half = rest->half;
    vec3 in_b = mat3_mul_vec3(f->to_b, normal);
    o->normal = side ? vec3_neg(in_b) : normal;
    o->reach = find_reach(rest->half, side ? normal : in_b);
}

// ---- triangles

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

ovoid_posed_shape solid_view_get_leaf(const solid_view *v, uint32_t place, triangle_shape *room) {
    if (v->shape) return (ovoid_posed_shape){v->shape, *v->pose};
    if (v->compound) {
        const compound_part *part = &v->compound->parts[place];
        return (ovoid_posed_shape){part->shape, pose_compute_product(v->pose, &part->pose)};
    }
    const vec3 corner[3] = {solid_get_corner(v->solid, place, 0), solid_get_corner(v->solid, place, 1),
                            solid_get_corner(v->solid, place, 2)};
    triangle_set(room, corner);
    return (ovoid_posed_shape){&room->shape, *v->pose};
}
