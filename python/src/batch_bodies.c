// Couples of bodies of any kind, one after another: the library's batches are of shapes.
#include "src/bodies.h"

static ovoid_verdict make_verdict(const ovoid_answer *x) {
    return (ovoid_verdict){x->status, x->stage, x->limit, x->iterations, x->lower, x->upper};
}

static ovoid_witness make_witness(const ovoid_answer *x) { return (ovoid_witness){x->point_a, x->point_b, x->normal}; }

static ovoid_answer ask_shapes(const bodies_query *q, const ovoid_body_pair *of) {
    ovoid_pair pair = {of->a.shape, of->b.shape, of->a.pose, of->b.pose};
    switch (q->name) {
    case QUERY_COLLIDE: return ovoid_collide(&pair, q->options, NULL);
    case QUERY_WITHIN: return ovoid_within(&pair, q->margin, q->options, NULL);
    case QUERY_DISTANCE: return ovoid_distance(&pair, q->options, NULL);
    default: return ovoid_depth(&pair, q->options, NULL, NULL);
    }
}

static ovoid_body_answer ask_once(const bodies_query *q, const ovoid_body_pair *pair) {
    switch (q->name) {
    case QUERY_COLLIDE: return ovoid_body_collide(pair, q->options, NULL);
    case QUERY_WITHIN: return ovoid_body_within(pair, q->margin, q->options, NULL);
    case QUERY_DISTANCE: return ovoid_body_distance(pair, q->options, NULL);
    default: return ovoid_body_depth(pair, q->options, NULL);
    }
}

// The deciding parts' answer with the bracket of the bodies.
static ovoid_answer ask(const bodies_query *q, const ovoid_body_pair *pair) {
    if (pair->a.shape && pair->b.shape) return ask_shapes(q, pair);
    ovoid_body_answer x = ask_once(q, pair);
    return ovoid_body_answer_get_answer(&x);
}

ovoid_code bodies_ask(const bodies_query *q, const ovoid_couple *couples, size_t count, ovoid_verdict *verdicts,
                      ovoid_witness *witnesses) {
    for (size_t i = 0; i < count; i++)
        if (couples[i].a >= q->body_count || couples[i].b >= q->body_count) return OVOID_ERROR_INDEX;
    for (size_t i = 0; i < count; i++) {
        ovoid_body_pair pair = {q->bodies[couples[i].a], q->bodies[couples[i].b]};
        ovoid_answer x = ask(q, &pair);
        verdicts[i] = make_verdict(&x);
        if (witnesses) witnesses[i] = make_witness(&x);
    }
    return OVOID_OK;
}
