// Ovoid as a contestant for contacts: the manifold and its points in one call.
#include "contacts/contacts.h"

#include <ovoid/manifold.h>

#include <stdlib.h>
#include <string.h>

typedef struct self {
    const contact_work *work;
    ovoid_manifold *manifolds;
    ovoid_manifold_options options;
    ovoid_manifold_points points;
    uint64_t warm, kept;
} self;

static void *create(const contact_work *work) {
    self *s = calloc(1, sizeof *s);
    if (!s) return NULL;
    s->work = work;
    s->manifolds = calloc(work->pair_count, sizeof *s->manifolds);
    s->options = (ovoid_manifold_options){.margin = work->margin, .tolerance = work->tolerance, .keep = work->margin};
    s->options.points = &s->points;
    if (s->manifolds) return s;
    free(s);
    return NULL;
}

static uint32_t run(void *state, uint32_t frame, int warm) {
    self *s = state;
    const contact_work *w = s->work;
    uint32_t count = 0;
    for (uint32_t i = 0; i < w->pair_count; i++) {
        const placed *p = w->pairs + (size_t)frame * w->pair_count + i;
        const ovoid_pair pair = {w->bodies[p->a].shape, w->bodies[p->b].shape, p->pose_a, p->pose_b};
        ovoid_manifold contact = ovoid_manifold_find(&pair, &s->options, warm ? s->manifolds + i : NULL);
        s->kept += warm &&
                   !memcmp((const char *)&contact.memory, (const char *)&s->manifolds[i].memory, sizeof contact.memory);
        s->manifolds[i] = contact;
        count += s->points.count;
    }
    if (warm) s->warm += w->pair_count;
    return count;
}

static void destroy(void *state) {
    self *s = state;
    free(s->manifolds);
    free(s);
}

double contacts_get_kept(const void *state) {
    const self *s = state;
    return s->warm ? (double)s->kept / (double)s->warm : 0;
}

const contact_peer contacts_ours = {"ovoid", 0, create, run, destroy};
