// The whole answer of one contact: the query of its pair, with the cached proof as warm start, and a proof that can be
// checked.
#include "base/environment.h"
#include "base/error.h"
#include "body/body_find.h"
#include "world/pair_update.h"

// The pair of the list, or NULL, by bisection.
static const world_pair *find_pair(const ovoid_world *w, uint64_t key) {
    size_t first = 0, end = w->pair_count;
    while (first < end) {
        size_t middle = first + (end - first) / 2;
        const world_pair *p = &w->pairs[middle];
        uint64_t here = key_make(p->a, p->b);
        if (here == key) return p;
        if (here < key)
            first = middle + 1;
        else
            end = middle;
    }
    return NULL;
}

static ovoid_code compute_proof(const ovoid_world *w, const ovoid_contact *contact, ovoid_contact_proof *proof,
                                ovoid_error *error) {
    OVOID_ASSERT(w && contact && proof);
    uint32_t a = world_find_body(w, contact->a), b = world_find_body(w, contact->b);
    if (a == NONE) return world_refuse_id(error, 0, contact->a);
    if (b == NONE) return world_refuse_id(error, 1, contact->b);
    if (a >= b || !w->has_query)
        return error_set(error, OVOID_ERROR_ARGUMENT, -1,
                         "no contact of this world: a must come before b, after a first query");
    const world_pair *p = find_pair(w, key_make(a, b));
    const pair_cache *warm = p && p->flags & PAIR_KNOWN ? &w->pair_cache[p->slot] : NULL;
    pair_query(w, (ovoid_couple){a, b}, warm, proof->exclusions, &proof->answer);
    return OVOID_OK;
}

ovoid_code ovoid_world_compute_proof(const ovoid_world *w, const ovoid_contact *contact, ovoid_contact_proof *proof,
                                     ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_code, w, compute_proof(w, contact, proof, error));
}
