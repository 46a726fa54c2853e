// The kernel of gauss.h: of a box and another body by the box's axes, where that is clear; else of any two bodies.
// Narrow lanes have the latter alone, which has the same bits: downloads are smaller.
#if LANES >= 4
#include "simd/kernels/gauss/box.h"
#else
#include "simd/kernels/gauss/gauss.h"
#endif

LANES_INLINE int gauss_find_any(const gauss_query *q, gauss_plane *out) {
    gauss_body first, second;
    gauss_mirror(&q->a, &first);
    gauss_pose(&q->b, q, &second);
    uint32_t of_first = gauss_bound_facets(&first, &second), of_second = gauss_bound_facets(&second, &first);
    gauss_least least = {INFINITY, 0, GAUSS_FACET_A};
    gauss_try_facet(&first, &second, of_first, GAUSS_FACET_A, &least);
    gauss_try_facet(&second, &first, of_second, GAUSS_FACET_B, &least);
    if (!(least.height > q->claim)) return 0;
    gauss_try_facets(&first, &second, of_first, GAUSS_FACET_A, &least);
    gauss_try_facets(&second, &first, of_second, GAUSS_FACET_B, &least);
    if (!(least.height > q->claim)) return 0;
    const gauss_body *of = least.kind == GAUSS_FACET_A ? &first : &second;
    *out = (gauss_plane){least.height, gauss_get_normal(of, least.facet), least.kind, least.facet, least.facet};
    gauss_list of_arcs, of_others;
    gauss_arcs others;
    gauss_find_arcs(&first, &second, least.height, &of_arcs);
    gauss_find_arcs(&second, &first, least.height, &of_others);
    gauss_put_arcs(&second, &of_others, &others);
    gauss_search s = {GAUSS_SLACK * q->size, out, 0};
    for (uint32_t i = 0; i < of_arcs.count; i++) {
        gauss_arc arc = gauss_get_arc(&first, of_arcs.arc[i]);
        gauss_try_arc(&s, of_arcs.arc[i], &arc, &others);
    }
    out->height -= s.blur * q->size;
    return out->height > q->claim;
}

LANES_INLINE int run_gauss(const gauss_query *q, gauss_plane *out) {
#if LANES >= 4
    if (q->box.side) {
        gauss_found found = gauss_find_by_box(q, out);
        if (found != GAUSS_OPEN) return found == GAUSS_FOUND;
    }
#endif
    return gauss_find_any(q, out);
}
