// Bodies that change: deformed, with another allowance, or divided by a plane. W.-K. Su, J.-S. Liu, I-F. Chen,
// Enhancing Collision Detection Method Based on Enclosed Ellipsoid by Facial Areas Splitting, name these as the cases
// in which the offline steps run again.
#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "linear/vec3.h"
#include "polytope/sort.h"
#include "shape/block.h"
#include "shape/create.h"

static ovoid_shape *create_deformed(const ovoid_shape *shape, const double *xyz, const ovoid_shape_options *options,
                                    ovoid_error *error) {
    if (shape) return shape_create_from_points((xyz_points){xyz, shape->vertex_count}, options, error);
    error_write(error, OVOID_ERROR_ARGUMENT, -1, "no shape to deform");
    return NULL;
}

ovoid_shape *ovoid_shape_create_deformed(const ovoid_shape *shape, const double *xyz,
                                         const ovoid_shape_options *options, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_shape *, xyz, create_deformed(shape, xyz, options, error));
}

// ---- another allowance

static ovoid_shape *create_allowed(const ovoid_shape *shape, const ovoid_shape_options *options, ovoid_error *error) {
    const ovoid_shape_options given = {.allowance = options ? options->allowance : (ovoid_allowance){0},
                                       .allocator = options ? options->allocator : NULL};
    ovoid_shape_options o;
    if (shape_options_make(&given, &o, error) != OVOID_OK) return NULL;
    ovoid_shape *to = ovoid_shape_create_copy(shape, &o, error);
    if (to) block_set_radius(to, to->radius, o.allowance);
    return to;
}

ovoid_shape *ovoid_shape_create_allowed(const ovoid_shape *shape, const ovoid_shape_options *options,
                                        ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_shape *, shape, create_allowed(shape, options, error));
}

// ---- division

// An edge that the plane cuts, from the vertex below to the vertex above, as an edge of one facet.
typedef struct crossing {
    uint32_t below, above, facet;
} crossing;

// The state of a division. In a solid each edge occurs twice, from the triangles on either side.
typedef struct division {
    const ovoid_shape *shape;
    const ovoid_shape_options *options;
    ovoid_error *error;
    double *height;  // of each vertex above the plane, in lengths of the normal
    double *points;  // of the part under construction, user's frame
    double *cuts;    // the points where edges are cut, user's frame
    crossing *edges; // room for all possible crossings
    uint32_t *order; // room for twice as many
    uint32_t edge_count, cut_count;
} division;

static vec3 get_user_vertex(const ovoid_shape *s, uint32_t i) {
    return vec3_add(vec3_at(shape_vertices(s), i), s->origin);
}

static void add_edge(division *d, uint32_t a, uint32_t b, uint32_t facet) {
    double ha = d->height[a], hb = d->height[b];
    if (!(ha < 0 && hb > 0) && !(ha > 0 && hb < 0)) return;
    d->edges[d->edge_count++] = ha < 0 ? (crossing){a, b, facet} : (crossing){b, a, facet};
}

static int compare_crossings(const void *context, uint32_t a, uint32_t b) {
    const crossing *x = (const crossing *)context + a, *y = (const crossing *)context + b;
    if (x->below != y->below) return x->below < y->below ? -1 : 1;
    return (x->above > y->above) - (x->above < y->above);
}

// Edges between two triangles of one facet are left out, since they are not edges of the body: a point on them would
// lie on the new edge to rounding, and make slivers.
static void find_cuts(division *d) {
    ovoid_polytope p = ovoid_shape_get_polytope(d->shape);
    for (uint32_t t = 0; t < p.triangle_count && p.rank == 3; t++)
        for (int k = 0; k < 3; k++)
            add_edge(d, p.triangles[3 * (size_t)t + k], p.triangles[3 * (size_t)t + (k + 1) % 3], p.triangle_facets[t]);
    for (uint32_t v = 0; v < p.vertex_count && p.rank < 3; v++)
        for (uint32_t k = p.neighbor_starts[v]; k < p.neighbor_starts[v + 1]; k++) add_edge(d, v, p.neighbors[k], v);
    for (uint32_t i = 0; i < d->edge_count; i++) d->order[i] = i;
    sort_indices(d->order, d->order + d->edge_count, d->edge_count, (index_order){compare_crossings, d->edges});
    for (uint32_t i = 0; i + 1 < d->edge_count; i += 2) {
        const crossing *e = &d->edges[d->order[i]], *twin = &d->edges[d->order[i + 1]];
        if (p.rank == 3 && e->facet == twin->facet) continue;
        vec3 a = get_user_vertex(d->shape, e->below), b = get_user_vertex(d->shape, e->above);
        double t = d->height[e->below] / (d->height[e->below] - d->height[e->above]);
        vec3 x = vec3_add_scaled(a, vec3_sub(b, a), t);
        double *to = d->cuts + 3 * (size_t)d->cut_count++;
        to[0] = x.x, to[1] = x.y, to[2] = x.z;
    }
}

// The part on one side: +1 above, -1 below. *part is NULL if no vertex lies there.
static ovoid_code create_part(division *d, int side, ovoid_shape **part) {
    size_t count = 0, inside = 0;
    for (uint32_t i = 0; i < d->shape->vertex_count; i++) {
        if (side * d->height[i] < 0) continue;
        vec3 x = get_user_vertex(d->shape, i);
        double *to = d->points + 3 * count++;
        to[0] = x.x, to[1] = x.y, to[2] = x.z;
        inside += d->height[i] != 0;
    }
    if (!inside) return OVOID_OK;
    for (size_t i = 0; i < 3 * (size_t)d->cut_count; i++) d->points[3 * count + i] = d->cuts[i];
    ovoid_error why = {0};
    *part = shape_create_from_points((xyz_points){d->points, count + d->cut_count}, d->options, &why);
    if (!*part && d->error) *d->error = why;
    return *part ? OVOID_OK : why.code;
}

static ovoid_shape_halves divide(division *d, const ovoid_plane *plane) {
    // Heights in units of the normal's largest entry; nothing overflows, lengths are below 1e50.
    vec3 n = vec3_scale(plane->normal, 1 / vec3_max_abs(plane->normal));
    double offset = plane->offset / vec3_max_abs(plane->normal);
    for (uint32_t i = 0; i < d->shape->vertex_count; i++)
        d->height[i] = vec3_dot(n, get_user_vertex(d->shape, i)) - offset;
    find_cuts(d);
    ovoid_shape_halves halves = {0};
    halves.code = create_part(d, -1, &halves.below);
    if (!halves.code) halves.code = create_part(d, 1, &halves.above);
    if (!halves.code) return halves;
    ovoid_shape_destroy(halves.below);
    return (ovoid_shape_halves){.code = halves.code};
}

static ovoid_code validate_division(const ovoid_shape *shape, const ovoid_plane *plane, ovoid_error *error) {
    if (!shape) return error_set(error, OVOID_ERROR_ARGUMENT, -1, "no shape to divide");
    if (!vec3_is_finite(plane->normal) || !isfinite(plane->offset))
        return error_set(error, OVOID_ERROR_NOT_FINITE, -1, "the plane is not finite");
    double size = vec3_max_abs(plane->normal);
    if (!(size > 1e-150 && size < 1e150))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "the plane's normal is zero or of no sensible length");
    return OVOID_OK;
}

static ovoid_shape_halves create_divided(const ovoid_shape *shape, const ovoid_plane *plane,
                                         const ovoid_shape_options *options, ovoid_error *error) {
    ovoid_shape_options o;
    ovoid_shape_halves halves = {.code = validate_division(shape, plane, error)};
    if (!halves.code) halves.code = shape_options_make(options, &o, error);
    if (halves.code) return halves;
    // Every triangle has at most two edges that the plane cuts.
    size_t vertices = shape->vertex_count, edges = 2 * (size_t)shape->counts.triangles + shape->counts.neighbors;
    ovoid_allocator memory = allocator_make(o.allocator);
    double *doubles = allocator_allocate(&memory, 4 * vertices + 6 * edges, sizeof *doubles);
    crossing *crossings = allocator_allocate(&memory, edges + 1, sizeof *crossings + 2 * sizeof(uint32_t));
    division d = {.shape = shape, .options = options, .error = error, .height = doubles, .edges = crossings};
    if (doubles && crossings) {
        d.cuts = doubles + vertices;
        d.points = d.cuts + 3 * edges;
        d.order = (uint32_t *)(crossings + edges + 1);
        halves = divide(&d, plane);
    } else
        halves.code = error_set(error, OVOID_ERROR_MEMORY, -1, "no memory to divide a shape of %zu vertices", vertices);
    allocator_release(&memory, crossings);
    allocator_release(&memory, doubles);
    return halves;
}

ovoid_shape_halves ovoid_shape_create_divided(const ovoid_shape *shape, const ovoid_plane *plane,
                                              const ovoid_shape_options *options, ovoid_error *error) {
    OVOID_ASSERT(plane);
    ENVIRONMENT_RETURN(ovoid_shape_halves, plane, create_divided(shape, plane, options, error));
}
