// The axes of a solid's nodes and the boxes along them. Truth: the definition, in extended precision. Rows are units
// and perpendicular to 8 u; each triangle below a node is in the node's box and in its child's, up to the 4 u of a
// product of a row and a point, in the tree's unit; around a tilted plane boxes are flat; the direction that is found
// for a bound of a lane shows that bound.
#include "body/tree_frame.h"
#include "extended.h"
#include "solids.h"

#define UNIT_ROUNDING 0x1p-53L

// ---- axes

static void check_rotation(const mat3 *axes) {
    const extended3 row[3] = {extended3_from(axes->r0), extended3_from(axes->r1), extended3_from(axes->r2)};
    for (int i = 0; i < 3; i++) {
        CHECK_LE((double)fabsl(extended3_norm(row[i]) - 1), (double)(4 * UNIT_ROUNDING));
        CHECK_LE((double)fabsl(extended3_dot(row[i], row[(i + 1) % 3])), (double)(8 * UNIT_ROUNDING));
    }
    CHECK(extended3_dot(extended3_cross(row[0], row[1]), row[2]) > 0.5L);
}

static void check_axes(void) {
    for (uint64_t seed = 1; seed <= 3000; seed++) {
        uint64_t s = check_seed = seed;
        vec3 first = random_vec3(&s, pow(10, random_uniform(&s, -120, 120)));
        double nearness = pow(2, random_uniform(&s, -60, 0)), length = vec3_norm(first);
        vec3 second = vec3_add_scaled(vec3_scale(first, random_uniform(&s, -2, 2)), random_vec3(&s, length), nearness);
        const mat3 axes = axes_make(first, second);
        check_rotation(&axes);
        int is_upright = memcmp(&axes, &axes_upright, sizeof axes) == 0;
        if (!is_upright) CHECK_NEAR(vec3_dot(axes.r0, vec3_unit(first)), 1, 1e-15);
        if (nearness > 1e-3 && length > 1e-60 && length < 1e60) CHECK(!is_upright);
    }
    const vec3 zero = {0, 0, 0}, one = {1, 2, 3};
    mat3 axes = axes_make(zero, one);
    CHECK(memcmp(&axes, &axes_upright, sizeof axes) == 0);
    axes = axes_make(one, one);
    CHECK(memcmp(&axes, &axes_upright, sizeof axes) == 0);
}

// ---- boxes

static extended3 get_along(const ovoid_solid *s, const mat3 *axes, uint32_t place, int corner) {
    extended3 p = extended3_sub(extended3_from(solid_get_corner(s, place, corner)), extended3_from(s->center));
    p = extended3_scale(p, 1 / (long double)s->unit);
    return (extended3){extended3_dot(extended3_from(axes->r0), p), extended3_dot(extended3_from(axes->r1), p),
                       extended3_dot(extended3_from(axes->r2), p)};
}

static int is_between(long double low, long double x, long double high) {
    return low - 16 * UNIT_ROUNDING <= x && x <= high + 16 * UNIT_ROUNDING;
}

static int is_in_node(const node_frame *f, extended3 p) {
    return is_between(f->low[0], p.x, f->high[0]) && is_between(f->low[1], p.y, f->high[1]) &&
           is_between(f->low[2], p.z, f->high[2]);
}
static int is_in_lane(const box8 *b, uint32_t i, extended3 p) {
    return is_between(b->low[0][i], p.x, b->high[0][i]) && is_between(b->low[1][i], p.y, b->high[1][i]) &&
           is_between(b->low[2][i], p.z, b->high[2][i]);
}

static void check_boxes(const ovoid_solid *s) {
    const body_tree tree = {.solid = s, .count = s->triangle_count};
    int inside = 1, same = 1;
    for (uint32_t node = 0; node < s->node_count; node++) {
        const node_frame *f = &s->frames[node];
        check_rotation(&f->axes);
        for (uint32_t i = 0; i < s->nodes[node].children; i++) {
            uint32_t first, end;
            body_tree_get_range(&tree, solid_get_child(s, node, i), &first, &end);
            for (uint32_t t = 3 * first; t < 3 * end; t++) {
                extended3 p = get_along(s, &f->axes, t / 3, (int)(t % 3));
                inside &= is_in_node(f, p) & is_in_lane(&s->turned[node], i, p);
            }
            same &= s->turned[node].child[i] == s->boxes[node].child[i];
        }
        same &= s->turned[node].leaves == s->boxes[node].leaves;
    }
    CHECK(inside);
    CHECK(same);
}

static ovoid_solid *make_random(uint64_t *seed) {
    mesh m = {0};
    double scale = pow(10, random_uniform(seed, -9, 9));
    mesh_add_random(&m, scale, seed);
    if (random_next(seed) % 3 == 0) // a needle or a plate
        for (size_t i = 0; i < m.points; i++) m.xyz[3 * i] *= 1e-9;
    if (random_next(seed) % 3 == 0) // far from the origin
        for (size_t i = 0; i < 3 * m.points; i++) m.xyz[i] += 1e6 * scale;
    ovoid_solid *s = mesh_make_solid(&m);
    mesh_clear(&m);
    return s;
}

static void check_random_boxes(void) {
    for (uint64_t seed = 1; seed <= 150; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_solid *solid = make_random(&s);
        check_boxes(solid);
        ovoid_solid_destroy(solid);
    }
}

// A tilted square of 32 by 32 cells: no box of a node is thicker than rounding to single precision makes it.
static void check_flatness(void) {
    mesh m = {0};
    const ovoid_vec3 u = {0.6, 0.48, 0.64}, v = {-0.8, 0.36, 0.48};
    for (uint32_t i = 0; i < 33; i++)
        for (uint32_t j = 0; j < 33; j++) mesh_add_point(&m, u.x * i + v.x * j, u.y * i + v.y * j, u.z * i + v.z * j);
    for (uint32_t i = 0; i < 32; i++)
        for (uint32_t j = 0; j < 32; j++) {
            uint32_t at = 33 * i + j;
            mesh_add_triangle(&m, at, at + 33, at + 34);
            mesh_add_triangle(&m, at, at + 34, at + 1);
        }
    ovoid_solid *s = mesh_make_solid(&m);
    const body_tree tree = {.solid = s, .count = s->triangle_count};
    double thickest = 0;
    for (uint32_t node = 0; node < s->node_count + s->triangle_count; node++) {
        tree_ref ref = node < s->node_count ? node : (node - s->node_count) | TREE_LEAF;
        const turned_box own = body_tree_get_turned_box(&tree, ref), beside = body_tree_get_child_box(&tree, ref);
        vec3 half = own.box.half, other = beside.box.half;
        thickest = fmax(thickest, fmin(half.x, fmin(half.y, half.z)));
        thickest = fmax(thickest, fmin(other.x, fmin(other.y, other.z)));
    }
    CHECK_LE(thickest, 1e-6 * s->unit);
    check_boxes(s);
    ovoid_solid_destroy(s);
    mesh_clear(&m);
}

// ---- bounds

// The bounds of a node's children beside any node or leaf of the other body, and the directions found for them.
static void check_bounds(const body_tree *trees, const tree_frame *frame, int side, uint64_t *seed) {
    const body_tree *own = &trees[side], *other = &trees[!side];
    const ovoid_solid *s = own->solid;
    uint32_t node = (uint32_t)(random_next(seed) % s->node_count);
    uint32_t all = other->solid->node_count + other->count, which = (uint32_t)(random_next(seed) % all);
    tree_ref ref = which < other->solid->node_count ? which : (which - other->solid->node_count) | TREE_LEAF;
    const turned_box rest = body_tree_get_turned_box(other, ref);
    vec3 normal = vec3_unit(random_vec3(seed, random_next(seed) % 2));
    const node_frame *axes = &s->frames[node];
    const framed_node framed = {side, &axes->axes, &rest};
    solid8_other turned = tree_frame_turn(frame, &framed, normal);
    turned.unit = s->unit;
    double lower[BOX8];
    solid8_get_kernels()->boxes(&s->turned[node], &turned, lower);
    for (uint32_t i = 0; i < s->nodes[node].children; i++) {
        const turned_box child = body_tree_get_child_box(own, solid_get_child(s, node, i));
        box_gap gap = tree_frame_find_gap(frame, side ? &rest : &child, side ? &child : &rest, normal);
        // Of the axes across, the one found for the child alone may be better.
        CHECK_LE(lower[i], gap.lower + frame->claim / 8);
        if (vec3_norm_squared(normal) > 0) CHECK_LE(gap.lower, lower[i] + frame->claim / 8);
        // The direction by itself: all corners of both along it.
        vec3 n = mat3_mul_vec3(frame->world, gap.normal);
        uint32_t first, end;
        long double top = -INFINITY, bottom = INFINITY;
        body_tree_get_range(own, solid_get_child(s, node, i), &first, &end);
        const extended3 along = extended3_from(n);
        for (uint32_t t = 3 * first; t < 3 * end; t++) {
            extended3 p =
                extended3_rotate(own->pose->rotation, extended3_from(solid_get_corner(s, t / 3, (int)(t % 3))));
            long double x = extended3_dot(along, extended3_add(p, extended3_from(own->pose->position)));
            top = fmaxl(top, side ? -x : x);
        }
        body_tree_get_range(other, ref, &first, &end);
        for (uint32_t t = 3 * first; t < 3 * end; t++) {
            vec3 corner = solid_get_corner(other->solid, t / 3, (int)(t % 3));
            extended3 p = extended3_rotate(other->pose->rotation, extended3_from(corner));
            long double x = extended3_dot(along, extended3_add(p, extended3_from(other->pose->position)));
            bottom = fminl(bottom, side ? -x : x);
        }
        CHECK(bottom - top >= lower[i] - frame->claim);
    }
}

static void check_random_bounds(void) {
    for (uint64_t seed = 1; seed <= 150; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_solid *solids[2] = {make_random(&s), make_random(&s)};
        double reach = solids[0]->extent + solids[1]->extent;
        const ovoid_body bodies[2] = {{.pose = {random_vec3(&s, reach), random_quat(&s)}, .solid = solids[0]},
                                      {.pose = {random_vec3(&s, reach), random_quat(&s)}, .solid = solids[1]}};
        body_tree trees[2];
        tree_frame frame;
        if (!body_tree_make(&bodies[0], &trees[0]) || !body_tree_make(&bodies[1], &trees[1])) abort();
        tree_frame_make(&trees[0], &trees[1], &frame);
        for (int i = 0; i < 20; i++) check_bounds(trees, &frame, i % 2, &s);
        for (int i = 0; i < 2; i++) ovoid_solid_destroy(solids[i]);
    }
}

int main(void) {
    if (!EXTENDED) check_skip("long double is double here: boxes and bounds are compared with doubles only");
    check_axes();
    check_random_boxes();
    check_flatness();
    check_random_bounds();
    return check_end();
}
