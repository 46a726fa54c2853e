// The areas of a polyhedron: the space of the unit sphere, the polar dual points, and their tables. W.-K. Su, J.-S.
// Liu, I-F. Chen, Enhancing Collision Detection Method Based on Enclosed Ellipsoid by Facial Areas Splitting, 3.2-3.3.
//
// Sphere space: x' = Q^-1/2 (x - c), with the symmetric root as in the paper, so that its axes are near the body's own.
// A ray direction maps as u' = Q^-1/2 u, a normal as n' = Q^1/2 n: vertices and normals keep their products,
// x' . n' = (x - c) . n. The ray c + t u leaves facet n . x = d where t (n . u) = d - n . c; so it leaves the body
// where 1/t = max_j f_j . u, f_j = n_j / (d_j - n_j . c): the support of the polar dual's points. docs/areas.md has the
// proofs.
#include "paper/area.h"

#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"
#include "shape/direction_cells.h"

#include <string.h>

int sphere_space_make(sym3 q, sym3 *root, sym3 *inverse_root, double *ratio) {
    eigen3 e = sym3_compute_eigen(q);
    if (!(e.value[0] > 0) || !isfinite(e.value[2])) return 0;
    double r[3], inverse[3];
    for (int i = 0; i < 3; i++) {
        r[i] = sqrt(e.value[i]);
        inverse[i] = 1 / r[i];
    }
    *root = sym3_from_eigen(r, e.v);
    *inverse_root = sym3_from_eigen(inverse, e.v);
    *ratio = r[2] * inverse[0];
    return isfinite(*ratio);
}

vec3 direction_scaled(vec3 v) {
    double m = vec3_max_abs(v);
    if (m > 1e-20 && m < 1e20 && vec3_is_finite(v)) return v;
    if (!(m > 0) || !vec3_is_finite(v)) return (vec3){0, 0, 0};
    int e;
    (void)frexp(m, &e);
    return (vec3){ldexp(v.x, -e), ldexp(v.y, -e), ldexp(v.z, -e)};
}

/// The Frobenius norm of A B - 1.
static double product_defect(sym3 a, sym3 b) {
    vec3 x = sym3_mul_vec3(a, (vec3){b.xx, b.xy, b.xz}), y = sym3_mul_vec3(a, (vec3){b.xy, b.yy, b.yz}),
         z = sym3_mul_vec3(a, (vec3){b.xz, b.yz, b.zz});
    x.x -= 1;
    y.y -= 1;
    z.z -= 1;
    return sqrt(vec3_norm_squared(x) + vec3_norm_squared(y) + vec3_norm_squared(z));
}

/// Makes the table of the vertices. A search computes their products with n in the body frame, to agree bit for bit
/// with a search of all; so errors[i] bounds, for |n'| <= sqrt(3), how far x_i . n as computed is from x'_i . n' as
/// stored. With u = 2^-53, s the least radius, |n| <= |n'| / s: the maps are inverse but for `defect`; x_i . n is off
/// by
/// 4 u |x_i| |n|, n' by 4 u ratio |n'|, x' by 4 u |x - c| / s. Doubled, and again for the sqrt(3).
static ovoid_code create_vertices(ovoid_areas *a, double ratio) {
    const double u = 0x1p-53;
    uint32_t count = a->polytope.vertex_count;
    double defect = product_defect(a->root, a->inverse_root) + 32 * u * ratio;
    double stretch = sym3_trace(a->inverse_root); // at least 1 / s
    vec3 *points = allocator_allocate(&a->allocator, count, sizeof *points);
    double *errors = allocator_allocate(&a->allocator, count, sizeof *errors);
    ovoid_code code = OVOID_ERROR_MEMORY;
    if (points && errors) {
        for (uint32_t i = 0; i < count; i++) {
            vec3 x = vec3_at(a->polytope.vertices, i), y = vec3_sub(x, a->center);
            points[i] = sym3_mul_vec3(a->inverse_root, y);
            errors[i] = 4 * (stretch * (vec3_norm(y) * (defect + 16 * u) + 8 * u * vec3_norm(x)) +
                             vec3_norm(points[i]) * 16 * u * ratio);
        }
        code = area_table_create(&a->vertices, &(area_points){points, errors, count}, a->k, &a->allocator);
    }
    allocator_release(&a->allocator, points);
    allocator_release(&a->allocator, errors);
    return code;
}

/// Makes the polar dual points. Returns -1, or the facet that has the centre on or above it.
static int64_t make_duals(ovoid_areas *a) {
    for (uint32_t j = 0; j < a->polytope.facet_count; j++) {
        ovoid_plane p = a->polytope.planes[j];
        double height = p.offset - vec3_dot(p.normal, a->center);
        a->duals[j] = vec3_scale(sym3_mul_vec3(a->root, p.normal), 1 / height);
        if (!(height > 0) || !vec3_is_finite(a->duals[j])) return j;
    }
    return -1;
}

/// Makes the tables of the facets: by octants for the rules that drop some, by the cube's cells where the split has
/// them. A search computes the products of the stored points with the mapped direction, as the table does, so there are
/// no errors but its own.
static ovoid_code create_facets(ovoid_areas *a) {
    uint32_t count = a->polytope.facet_count;
    double *errors = allocator_allocate(&a->allocator, count, sizeof *errors);
    if (!errors) return OVOID_ERROR_MEMORY;
    memset(errors, 0, count * sizeof *errors);
    area_points points = {a->duals, errors, count};
    ovoid_code code = area_table_create(&a->by_octant, &points, 0, &a->allocator);
    if (code == OVOID_OK && a->k > 0) code = area_table_create(&a->facets, &points, a->k, &a->allocator);
    allocator_release(&a->allocator, errors);
    if (code != OVOID_OK) return code;
    memset(a->octants, 0, count);
    for (uint32_t octant = 0; octant < 8; octant++)
        for (uint32_t i = 0; i < a->by_octant.counts[octant]; i++)
            a->octants[a->by_octant.entries[a->by_octant.starts[octant] + i]] |= (uint8_t)(1u << octant);
    return OVOID_OK;
}

/// OVOID_OK, or an error if areas cannot be made from the input.
static ovoid_code validate_input(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid,
                                 const ovoid_areas_options *options, ovoid_error *error) {
    uint32_t k = options->k;
    if (!polytope || !ellipsoid)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "areas need a polytope and an ellipsoid; one is NULL");
    if (polytope->rank < 3)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1,
                         "areas need a solid; the polytope has rank %u: a flat body has no inside to look out from",
                         (unsigned)polytope->rank);
    if (options->split == OVOID_SPLIT_CUBE ? k < 1 || k > 64 || (k & (k - 1)) != 0
                                           : options->split != OVOID_SPLIT_OCTANTS)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1,
                         "the areas' k is %u: a cube's edge has 1, 2, 4, 8, 16, 32 or 64 cells", (unsigned)k);
    return OVOID_OK;
}

/// Fills the block; on failure ovoid_areas_destroy frees what was made so far.
static ovoid_code fill_areas(ovoid_areas *a, const ovoid_ellipsoid *ellipsoid, ovoid_error *error) {
    double ratio;
    if (!sphere_space_make(ellipsoid->q, &a->root, &a->inverse_root, &ratio))
        return error_set(error, OVOID_ERROR_ARGUMENT, -1, "the areas' ellipsoid is flat: its matrix is not definite");
    a->duals = allocator_allocate(&a->allocator, a->polytope.facet_count, sizeof *a->duals);
    a->octants = allocator_allocate(&a->allocator, a->polytope.facet_count, sizeof *a->octants);
    ovoid_code code = a->duals && a->octants ? OVOID_OK : OVOID_ERROR_MEMORY;
    int64_t facet = code == OVOID_OK ? make_duals(a) : -1;
    if (facet >= 0)
        return error_set(error, OVOID_ERROR_ARGUMENT, facet,
                         "the ellipsoid's centre is not inside: facet %lld does not pass above it", (long long)facet);
    if (code == OVOID_OK) code = create_facets(a);
    if (code == OVOID_OK) code = create_vertices(a, ratio);
    return code == OVOID_OK ? code : error_set(error, code, -1, "no memory for the tables of the areas");
}

static ovoid_areas *create_areas(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid,
                                 const ovoid_areas_options *options, ovoid_error *error) {
    const ovoid_areas_options o = options ? *options : (ovoid_areas_options){0};
    if (validate_input(polytope, ellipsoid, &o, error) != OVOID_OK) return NULL;
    ovoid_allocator use = allocator_make(o.allocator);
    ovoid_areas *a = allocator_allocate(&use, 1, sizeof *a);
    if (!a) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for the areas");
        return NULL;
    }
    *a = (ovoid_areas){.polytope = *polytope, .center = ellipsoid->center, .allocator = use};
    a->k = o.split == OVOID_SPLIT_CUBE ? o.k : 0;
    if (fill_areas(a, ellipsoid, error) != OVOID_OK) {
        ovoid_areas_destroy(a);
        return NULL;
    }
    return a;
}

ovoid_areas *ovoid_areas_create(const ovoid_polytope *polytope, const ovoid_ellipsoid *ellipsoid,
                                const ovoid_areas_options *options, ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_areas *, polytope, create_areas(polytope, ellipsoid, options, error));
}

static void destroy(ovoid_areas *areas) {
    ovoid_allocator allocator = areas->allocator;
    area_table_destroy(&areas->by_octant, &allocator);
    area_table_destroy(&areas->facets, &allocator);
    area_table_destroy(&areas->vertices, &allocator);
    allocator_release(&allocator, areas->duals);
    allocator_release(&allocator, areas->octants);
    allocator_release(&allocator, areas);
}

void ovoid_areas_destroy(ovoid_areas *areas) {
    if (!areas) return;
    ENVIRONMENT_RUN(destroy(areas));
}

ovoid_area_counts ovoid_areas_get_counts(const ovoid_areas *areas) {
    const area_table *facets = areas->k > 0 ? &areas->facets : &areas->by_octant;
    uint64_t bytes = sizeof *areas + areas->polytope.facet_count * (sizeof *areas->duals + sizeof *areas->octants);
    bytes += area_table_get_bytes(&areas->by_octant) + area_table_get_bytes(&areas->facets) +
             area_table_get_bytes(&areas->vertices);
    return (ovoid_area_counts){facets->cells, facets->entry_count, areas->vertices.entry_count, bytes};
}
