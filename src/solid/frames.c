// The frames of a solid's nodes. Around a patch of a surface of size h that is not parallel to the solid's axes, a box
// along these axes is too thick by the order of h, a box along the patch by the order of h squared. So each node has
// axes of its own (S. Gottschalk, M. C. Lin, D. Manocha, OBBTree: a hierarchical structure for rapid interference
// detection, 1996), shared by its children's boxes: eight are still compared at once.
//
// The axes are those of five candidates along which the children's boxes have the least surface: the solid's own, the
// principal axes of the surface, those with the mean normal as the first, the parent's, and those of one triangle. Of a
// child with many triangles a sample is measured. The boxes themselves are around all triangles.
#include "solid/solid.h"

enum { SAMPLE = 32, CANDIDATES = 5 };

static vec3 get_point(const ovoid_solid *s, uint32_t place, int corner) {
    return solid_to_tree(s, solid_get_corner(s, place, corner));
}

mat3 axes_make(vec3 first, vec3 second) {
    if (!(vec3_norm_squared(vec3_cross(first, second)) >
          0x1p-40 * vec3_norm_squared(first) * vec3_norm_squared(second)))
        return axes_upright;
    // Across both only to u / 2^-20, since these may be nearly parallel; the second product mends that.
    vec3 along = vec3_unit(first), across = vec3_unit(vec3_cross(along, second));
    vec3 between = vec3_unit(vec3_cross(across, along));
    return (mat3){along, between, vec3_cross(along, between)};
}

// ---- measuring

// Triangles at [first, end), each step-th of them.
typedef struct sample {
    const ovoid_solid *solid;
    uint32_t first, end, step;
} sample;

static sample make_sample(const ovoid_solid *s, tree_ref ref) {
    uint32_t at = ref_get_index(ref);
    if (ref_is_leaf(ref)) return (sample){s, at, at + 1, 1};
    uint32_t first = s->nodes[at].first, end = s->nodes[at].end;
    return (sample){s, first, end, (end - first + SAMPLE - 1) / SAMPLE};
}

// The box along axes, in the tree's unit.
static box measure(const sample *r, const mat3 *axes) {
    box all = box_make_empty();
    for (uint32_t t = r->first; t < r->end; t += r->step) {
        for (int i = 0; i < 3; i++) all = box_add_point(&all, mat3_mul_vec3(*axes, get_point(r->solid, t, i)));
    }
    return all;
}

static double measure_children(const ovoid_solid *s, uint32_t node, const mat3 *axes) {
    double sum = 0;
    for (uint32_t i = 0; i < s->nodes[node].children; i++) {
        const sample r = make_sample(s, solid_get_child(s, node, i));
        const box around = measure(&r, axes);
        sum += box_compute_surface(&around);
    }
    return sum;
}

// ---- candidates

// What is summed over triangles, each weighted by twice its area: the weights, the points, their squares, the normals.
typedef struct moments {
    double weight;
    vec3 sum, normal;
    sym3 square;
} moments;

// The square's integral over a triangle of weight 1: (9 g g' + the sum of p p') / 12, g its centroid.
static void add_triangle(const ovoid_solid *s, uint32_t place, moments *m) {
    const vec3 p[3] = {get_point(s, place, 0), get_point(s, place, 1), get_point(s, place, 2)};
    vec3 n = vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0]));
    vec3 g = vec3_scale(vec3_add(vec3_add(p[0], p[1]), p[2]), 1.0 / 3);
    double w = vec3_norm(n);
    sym3 square = sym3_outer(g, 9);
    for (int i = 0; i < 3; i++) square = sym3_add(square, sym3_outer(p[i], 1));
    m->weight += w;
    m->sum = vec3_add_scaled(m->sum, g, w);
    m->normal = vec3_add(m->normal, n);
    m->square = sym3_add(m->square, sym3_scale(square, w / 12));
}

static moments sum_moments(const ovoid_solid *s, uint32_t node) {
    moments m = {.weight = 0};
    for (uint32_t i = 0; i < s->nodes[node].children; i++) {
        const sample r = make_sample(s, solid_get_child(s, node, i));
        for (uint32_t t = r.first; t < r.end; t += r.step) add_triangle(s, t, &m);
    }
    return m;
}

static sym3 find_covariance(const moments *m) {
    vec3 mean = vec3_scale(m->sum, 1 / m->weight);
    return sym3_add(sym3_scale(m->square, 1 / m->weight), sym3_outer(mean, -1));
}

static mat3 find_principal_axes(sym3 covariance) {
    eigen3 e = sym3_compute_eigen(covariance);
    return axes_make(e.v.r2, e.v.r1);
}

// The mean normal, and the longest axis across it.
static mat3 find_axes_across(sym3 covariance, vec3 normal) {
    vec3 n = vec3_unit(normal), u = vec3_unit(vec3_orthogonal(n)), v = vec3_cross(n, u);
    mat3 basis = {u, v, {0, 0, 0}};
    // A normal of length zero has no axes across it: its basis turns the covariance to zero.
    eigen3 e = sym3_compute_eigen(sym3_rotate(covariance, basis));
    return axes_make(mat3_mul_transposed_vec3(basis, e.v.r2), vec3_cross(n, mat3_mul_transposed_vec3(basis, e.v.r2)));
}

// Along the second longest edge: the longest of one half of a rectangle is its diagonal.
static mat3 find_axes_of_triangle(const ovoid_solid *s, uint32_t place) {
    vec3 edge[3];
    double length[3];
    for (int i = 0; i < 3; i++) {
        edge[i] = vec3_sub(get_point(s, place, (i + 1) % 3), get_point(s, place, i));
        length[i] = vec3_norm_squared(edge[i]);
    }
    int longest = vec3_find_largest(vec3_at(length, 0));
    int second = length[(longest + 1) % 3] >= length[(longest + 2) % 3] ? (longest + 1) % 3 : (longest + 2) % 3;
    return axes_make(edge[second], edge[longest]);
}

static mat3 choose_axes(const ovoid_solid *s, uint32_t node) {
    mat3 candidate[CANDIDATES] = {axes_upright, s->frames[node].axes, find_axes_of_triangle(s, s->nodes[node].first)};
    int count = 3;
    const moments m = sum_moments(s, node);
    if (m.weight > 0x1p-100) {
        sym3 covariance = find_covariance(&m);
        candidate[count++] = find_principal_axes(covariance);
        candidate[count++] = find_axes_across(covariance, m.normal);
    }
    double least = INFINITY;
    mat3 best = axes_upright;
    for (int i = 0; i < count; i++) {
        double surface = measure_children(s, node, &candidate[i]);
        if (!(surface < least * (1 - 1e-9))) continue;
        least = surface;
        best = candidate[i];
    }
    return best;
}

// ---- boxes

// The children's boxes, and the node's around them. A child starts with the node's axes as its candidate.
static void set_boxes(ovoid_solid *s, uint32_t node) {
    node_frame *frame = &s->frames[node];
    box8 *boxes = &s->turned[node];
    *boxes = s->boxes[node];
    box all = box_make_empty();
    for (uint32_t i = 0; i < s->nodes[node].children; i++) {
        tree_ref ref = solid_get_child(s, node, i);
        sample r = make_sample(s, ref);
        r.step = 1;
        box around = measure(&r, &frame->axes);
        box8_set_lane(boxes, i, &around);
        all = box_join(&all, &around);
        if (!ref_is_leaf(ref)) s->frames[ref].axes = frame->axes;
    }
    box8_round_out(&all, frame->low, frame->high);
}

void solid_make_frames(ovoid_solid *s) {
    s->frames[0].axes = axes_upright;
    // A node's children have higher numbers.
    for (uint32_t node = 0; node < s->node_count; node++) {
        s->frames[node].axes = choose_axes(s, node);
        set_boxes(s, node);
    }
}
