// Solids of triangles, against each other and against shapes.
#include "ovoid/solid.h"
#include "src/exchange.h"

#include <stdlib.h>

ovoid_solid *EXPORT(solid_create)(const double *xyz, size_t point_count, const uint32_t *indices, size_t count) {
    return ovoid_solid_create_from_triangles(xyz, point_count, indices, count, NULL, &exchange_error);
}
void EXPORT(solid_destroy)(ovoid_solid *solid) { ovoid_solid_destroy(solid); }

/// Points, triangles, components, unmatched and crowded edges, degenerate, duplicates, closed, volume, area, box.
void EXPORT(solid_describe)(const ovoid_solid *solid) {
    ovoid_solid_report r = ovoid_solid_get_report(solid);
    double *to = exchange;
    *to++ = (double)r.points, *to++ = (double)r.triangles, *to++ = (double)r.components;
    *to++ = (double)r.edges_unmatched, *to++ = (double)r.edges_crowded, *to++ = (double)r.degenerate;
    *to++ = (double)r.duplicates, *to++ = r.is_closed, *to++ = r.volume, *to++ = r.area;
    write_vec3(write_vec3(to, r.box.min), r.box.max);
}

// The exclusions of the last query that asked for a proof, and of the next check.
static ovoid_exclusions exclusions;

ovoid_exclusion *EXPORT(get_exclusions)(void) { return exclusions.items; }
size_t EXPORT(get_exclusion_size)(void) { return sizeof(ovoid_exclusion); }

/// Room for so many exclusions: their address; 0 where there is no memory.
ovoid_exclusion *EXPORT(set_exclusions)(size_t count) {
    if (count > exclusions.capacity) {
        void *items = count <= SIZE_MAX / sizeof(ovoid_exclusion)
                          ? realloc(exclusions.items, count * sizeof(ovoid_exclusion))
                          : NULL;
        if (!items) return NULL;
        exclusions.items = items;
        exclusions.capacity = count;
    }
    exclusions.count = count;
    return exclusions.items;
}

static const double *read_body(const double *from, int is_solid, const void *body, ovoid_body *out) {
    *out = (ovoid_body){.shape = is_solid ? NULL : body, .solid = is_solid ? body : NULL};
    return read_pose(from, &out->pose);
}

static ovoid_solid_answer ask(int kind, const ovoid_body_pair *pair, double margin, const ovoid_options *options,
                              ovoid_exclusions *out) {
    switch (kind) {
    case 0: return ovoid_solid_collide(pair, options, NULL, out);
    case 1: return ovoid_solid_within(pair, margin, options, NULL, out);
    default: return ovoid_solid_distance(pair, options, NULL, out);
    }
}

/// kind: collide, within, distance. Bit 0 of solids: a is a solid, bit 1: b; bit 2: keep the exclusions. Reads both
/// poses, the margin, tolerances, cap; writes status, limit, lower, upper, parting, inside, component, both triangles,
/// how many exclusions there are, then the surfaces' answer and its proof.
void EXPORT(solid_query)(int kind, int solids, const void *a, const void *b) {
    ovoid_body_pair pair;
    const double *from = read_body(exchange, solids & 1, a, &pair.a);
    from = read_body(from, solids & 2, b, &pair.b);
    double margin = *from++;
    ovoid_options options = {.absolute_tolerance = from[0], .relative_tolerance = from[1], .cap = from[2]};
    ovoid_solid_answer s = ask(kind, &pair, margin, &options, solids & 4 ? &exclusions : NULL);
    // Once more where there was too little room: the search is the same.
    if (solids & 4 && exclusions.count > exclusions.capacity && set_exclusions(exclusions.count))
        s = ask(kind, &pair, margin, &options, &exclusions);
    double *to = exchange;
    *to++ = s.status, *to++ = s.limit, *to++ = s.lower, *to++ = s.upper;
    to = write_vec3(to, s.parting);
    *to++ = s.inside, *to++ = s.component, *to++ = s.triangle_a, *to++ = s.triangle_b;
    *to++ = solids & 4 ? (double)exclusions.count : 0;
    write_proof(write_answer(to, &s.surfaces), &s.surfaces.proof);
}

/// Reads both poses and what solid_query wrote; the exclusions are those of set_exclusions. 0, or the error's code.
int EXPORT(solid_check)(int solids, const void *a, const void *b) {
    ovoid_body_pair pair;
    ovoid_solid_answer s = {0};
    const double *from = read_body(read_body(exchange, solids & 1, a, &pair.a), solids & 2, b, &pair.b);
    s.status = (ovoid_status)*from++;
    s.limit = (ovoid_limit)*from++;
    s.lower = *from++, s.upper = *from++;
    from = read_vec3(from, &s.parting);
    s.inside = (ovoid_solid_inside)*from++;
    s.component = read_index(*from++);
    s.triangle_a = read_index(*from++), s.triangle_b = read_index(*from++);
    from++;
    read_proof(read_answer(from, &s.surfaces), &s.surfaces.proof);
    return (int)ovoid_solid_answer_check(&pair, &s, &exclusions, &exchange_error);
}
