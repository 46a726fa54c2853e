// Most couples of a batch are decided by their enclosing spheres or ellipsoids, which cost the same for every couple:
// so eight couples are taken at once, without a branch. Those that the spheres leave open are packed into full eights
// before they go on to the ellipsoids, and those that the supports along the ellipsoids' direction leave open go on to
// the exact search one by one. A couple that is in any way unusual (an earlier proof, a far origin, a quaternion to be
// scaled, a refused pose) is asked about alone, from the start.
//
// Every lane has the bits of the single query, so that nothing depends on which couples come together, and a batch may
// be cut anywhere. Working memory: five eights on the stack, 26 KB.
#include "query/crowd.h"

#include "base/error.h"
#include "query/glance.h"
#include "simd/octet.h"
#include "simd/prefetch.h"

#include <stddef.h>

// The kernels read these as rows of doubles.
_Static_assert(sizeof(ovoid_body) == 8 * sizeof(double) && offsetof(ovoid_body, pose) == sizeof(double),
               "a body is a pointer and seven numbers");
_Static_assert(offsetof(ovoid_shape, radius) == 8 && offsetof(ovoid_shape, center) == 16 &&
                   offsetof(ovoid_shape, extent) == 40 && offsetof(ovoid_shape, first) == 64,
               "what `place` reads");
_Static_assert(offsetof(ovoid_shape, inner) == offsetof(ovoid_shape, outer) + 9 * sizeof(double) &&
                   sizeof(shape_inner) == 8 * sizeof(double),
               "what `part` reads");

// Eight couples, in lanes. Their bodies and shapes are kept as the kernels read them.
typedef struct eight {
    size_t index[OCTET];
    octet_places at; ///< their bodies and shapes
    octet *lanes;
} eight;

typedef struct crowd {
    const ovoid_batch *batch;
    const octet_kernels *kernels;
    question ask; ///< without the tolerance, which is each couple's own
    octet_ask numbers;
    int wants_evidence; ///< answers or proofs, not only verdicts
    eight *waiting;     ///< couples on their way to the ellipsoids, OCTET_GROUP eights of them
    octet *lanes;       ///< of these
    unsigned waiting_count;
} crowd;

// No earlier proof: nothing in it could help.
static int is_blank(const ovoid_proof *p) {
    return p->kind == OVOID_PROOF_NONE && p->count == 0 && !(p->normal.x != 0 || p->normal.y != 0 || p->normal.z != 0);
}

void crowd_write(const ovoid_batch *batch, size_t i, const ovoid_answer *x) {
    if (batch->proofs) batch->proofs[i] = x->proof;
    if (batch->verdicts)
        batch->verdicts[i] = (ovoid_verdict){x->status, x->stage, x->limit, x->iterations, x->lower, x->upper};
    if (batch->answers && x != &batch->answers[i]) batch->answers[i] = *x;
}

static void write_verdict(const ovoid_batch *batch, size_t i, ovoid_verdict is) {
    if (batch->verdicts) batch->verdicts[i] = is;
}

void crowd_ask_single(const ovoid_batch *batch, size_t i, question ask) {
    const ovoid_body *a = &batch->bodies[batch->couples[i].a], *b = &batch->bodies[batch->couples[i].b];
    ovoid_pair pair = {a->shape, b->shape, a->pose, b->pose};
    ovoid_answer own, *out = batch->answers ? &batch->answers[i] : &own;
    const ovoid_proof *earlier = batch->proofs && !is_blank(&batch->proofs[i]) ? &batch->proofs[i] : NULL;
    answer_find_inside(&pair, batch->options, ask, earlier, NULL, out);
    crowd_write(batch, i, out);
}

// ---- one lane

static vec3 get3(const octet_column *c, unsigned k) { return (vec3){c[0].lane[k], c[1].lane[k], c[2].lane[k]}; }
static void put3(octet_column *c, unsigned k, vec3 v) {
    c[0].lane[k] = v.x;
    c[1].lane[k] = v.y;
    c[2].lane[k] = v.z;
}
static mat3 get9(const octet_column *c, unsigned k) { return (mat3){get3(c, k), get3(c + 3, k), get3(c + 6, k)}; }

static const ovoid_body *get_a(const eight *e, unsigned k) { return (const void *)e->at.body_a[k]; }
static const ovoid_body *get_b(const eight *e, unsigned k) { return (const void *)e->at.body_b[k]; }

// The frame of a lane, as frame_place and frame_relate make it; the latter's part is meant after the ellipsoids only.
static pair_frame get_frame(const eight *e, unsigned k) {
    const octet *o = e->lanes;
    double size = o->size.lane[k], hidden = OVOID_LENGTH_MIN;
    return (pair_frame){get_a(e, k)->shape,
                        get_b(e, k)->shape,
                        get9(o->world_a, k),
                        get9(o->world_b, k),
                        get_a(e, k)->pose.position,
                        get3(o->offset, k),
                        size,
                        FRAME_CLAIM * size + 2 * hidden,
                        FRAME_CHECK * size + hidden,
                        hidden,
                        o->radii.lane[k],
                        get9(o->rotation, k),
                        get3(o->translation, k)};
}

static question get_ask(const crowd *c, const eight *e, unsigned k) {
    question ask = c->ask;
    ask.tolerance = e->lanes->tolerance.lane[k];
    return ask;
}

// The verdict of a stage that answered the question, from the lane's bounds.
static void write_bounds(const crowd *c, const eight *e, unsigned k, ovoid_stage stage, unsigned narrow) {
    double lower = e->lanes->lower.lane[k], upper = e->lanes->upper.lane[k];
    ovoid_status status = lower > 0 ? OVOID_SEPARATED : OVOID_OVERLAPPING;
    ovoid_limit wide = lower > c->ask.far ? c->ask.beyond : OVOID_LIMIT_ANSWERED;
    ovoid_limit limit = narrow >> k & 1 ? OVOID_LIMIT_NONE : wide;
    write_verdict(c->batch, e->index[k], (ovoid_verdict){status, stage, limit, 0, lower, upper});
}

// Decided by the spheres. The evidence is that of the first look, taken again.
static void end_at_spheres(const crowd *c, const eight *e, unsigned k, unsigned narrow) {
    if (!c->wants_evidence) {
        write_bounds(c, e, k, OVOID_STAGE_SPHERE, narrow);
        return;
    }
    pair_frame frame = get_frame(e, k);
    question ask = get_ask(c, e, k);
    glance seen;
    ovoid_answer own, *out = c->batch->answers ? &c->batch->answers[e->index[k]] : &own;
    (void)glance_at_spheres(&frame, ask.far, &seen);
    *out = glance_make_answer(&seen, &frame, &ask);
    crowd_write(c->batch, e->index[k], out);
}

// The search as the lane's stage leaves it; *frame must outlive it.
static search get_search(const crowd *c, const eight *e, unsigned k, ovoid_stage stage, pair_frame *frame) {
    search s;
    question ask = get_ask(c, e, k);
    *frame = get_frame(e, k);
    search_make(&s, frame, &ask);
    s.stage = stage;
    return s;
}

static void end_search(const crowd *c, const eight *e, unsigned k, search *s) {
    if (!c->wants_evidence) {
        write_verdict(c->batch, e->index[k], answer_make_verdict(s));
        return;
    }
    ovoid_answer own, *out = c->batch->answers ? &c->batch->answers[e->index[k]] : &own;
    answer_write(s, out);
    crowd_write(c->batch, e->index[k], out);
}

static void end_at_inner(const crowd *c, const eight *e, unsigned k, unsigned narrow) {
    if (!c->wants_evidence) {
        write_bounds(c, e, k, OVOID_STAGE_INNER, narrow);
        return;
    }
    pair_frame frame;
    search s = get_search(c, e, k, OVOID_STAGE_INNER, &frame);
    s.upper = e->lanes->upper.lane[k];
    s.kind = OVOID_PROOF_INNER;
    s.inner_a = get3(e->lanes->inner, k);
    end_search(c, e, k, &s);
}

static void end_at_outer(const crowd *c, const eight *e, unsigned k, unsigned narrow) {
    if (!c->wants_evidence) {
        write_bounds(c, e, k, OVOID_STAGE_OUTER, narrow);
        return;
    }
    pair_frame frame;
    search s = get_search(c, e, k, OVOID_STAGE_OUTER, &frame);
    s.lower = e->lanes->lower.lane[k];
    s.normal = get3(e->lanes->n, k);
    end_search(c, e, k, &s);
}

// After the supports: answered, or the exact search goes on from their corner.
static void end_at_support(const crowd *c, const eight *e, unsigned k, uint32_t a, uint32_t b) {
    double lower = e->lanes->lower.lane[k], upper = e->lanes->upper.lane[k];
    question ask = get_ask(c, e, k);
    int is_answered = question_is_answered(&ask, lower, upper);
    // Where radii overlap the single query looks a second time (stage_support).
    if (is_answered && ask.wants_bracket && e->lanes->radii.lane[k] > 0) {
        crowd_ask_single(c->batch, e->index[k], c->ask);
        return;
    }
    if (is_answered && !c->wants_evidence) {
        write_bounds(c, e, k, OVOID_STAGE_SUPPORT, (unsigned)(upper - lower <= ask.tolerance) << k);
        return;
    }
    pair_frame frame;
    search s = get_search(c, e, k, OVOID_STAGE_SUPPORT, &frame);
    simplex start = {.p = {{get3(e->lanes->w, k), a, b}}, .weight = {1}, .count = 1};
    s.lower = lower;
    s.normal = get3(e->lanes->n, k);
    s.upper = upper;
    s.kind = OVOID_PROOF_POINTS;
    s.witness = evidence_make(&start);
    if (!is_answered) {
        ovoid_pair pair = {frame.a, frame.b, get_a(e, k)->pose, get_b(e, k)->pose};
        answer_search(&s, &pair, NULL, &start, NULL);
    }
    end_search(c, e, k, &s);
}

// ---- eight lanes

// The supports along the ellipsoids' direction for the lanes of `open`.
static void meet(const crowd *c, eight *e, unsigned open) {
    octet *o = e->lanes;
    uint32_t a[OCTET], b[OCTET];
    for (unsigned rest = open; rest; rest &= rest - 1) {
        unsigned k = (unsigned)__builtin_ctz(rest);
        pair_frame f;
        f.a = get_a(e, k)->shape;
        f.b = get_b(e, k)->shape;
        simd_pair x = frame_find_pair(&f, get3(o->n, k), get3(o->low, k));
        o->high_value.lane[k] = x.high.value;
        o->low_value.lane[k] = x.low.value;
        put3(o->vertex_a, k, frame_vertex_a(&f, a[k] = x.high.index));
        put3(o->vertex_b, k, vec3_at(shape_vertices(f.b), b[k] = x.low.index));
    }
    c->kernels->meet(o);
    for (unsigned rest = open; rest; rest &= rest - 1) {
        unsigned k = (unsigned)__builtin_ctz(rest);
        end_at_support(c, e, k, a[k], b[k]);
    }
}

static octet_ellipsoids find_ellipsoids(const eight *e) {
    octet_ellipsoids rows;
    for (unsigned k = 0; k < OCTET; k++) {
        const ovoid_shape *a = get_a(e, k)->shape, *b = get_b(e, k)->shape;
        rows.outer_a[k] = &a->outer.center.x;
        rows.outer_b[k] = &b->outer.center.x;
        rows.inner_a[k] = a->inside.w;
        rows.inner_b[k] = b->inside.w;
    }
    return rows;
}

// From the ellipsoids to the answers.
static void end_eight(const crowd *c, eight *e, unsigned some, const octet_found *found) {
    for (unsigned rest = some; rest; rest &= rest - 1) {
        unsigned k = (unsigned)__builtin_ctz(rest);
        if (found->odd >> k & 1)
            crowd_ask_single(c->batch, e->index[k], c->ask);
        else if (found->inner >> k & 1)
            end_at_inner(c, e, k, found->narrow);
        else if (found->apart >> k & 1)
            end_at_outer(c, e, k, found->narrow);
    }
    unsigned open = some & ~(found->odd | found->inner | found->apart);
    if (open) meet(c, e, open);
}

// The lanes from `count` on repeat lane 0.
static void fill(eight *e, unsigned count) {
    octet_column *column = (octet_column *)e->lanes;
    for (unsigned k = count; k < OCTET; k++) {
        e->at.body_a[k] = e->at.body_a[0];
        e->at.body_b[k] = e->at.body_b[0];
        for (int i = 0; i < OCTET_PLACED; i++) column[i].lane[k] = column[i].lane[0];
    }
}

// All that wait go on to their answers.
static void settle(crowd *c) {
    unsigned eights = (c->waiting_count + OCTET - 1) / OCTET, last = c->waiting_count % OCTET;
    octet_ellipsoids rows[OCTET_GROUP];
    octet_found found[OCTET_GROUP];
    if (last) fill(&c->waiting[eights - 1], last);
    for (unsigned i = 0; i < eights; i++) rows[i] = find_ellipsoids(&c->waiting[i]);
    c->kernels->part(rows, &c->numbers, c->lanes, eights, found);
    for (unsigned i = 0; i < eights; i++)
        end_eight(c, &c->waiting[i], i + 1 == eights && last ? (1u << last) - 1 : OCTET_ALL, &found[i]);
    c->waiting_count = 0;
}

// Lane k of e joins those that wait; e may be the eight that it goes to.
static void wait_for_others(crowd *c, const eight *e, unsigned k) {
    eight *to = &c->waiting[c->waiting_count / OCTET];
    unsigned at = c->waiting_count++ % OCTET;
    to->index[at] = e->index[k];
    to->at.body_a[at] = e->at.body_a[k];
    to->at.body_b[at] = e->at.body_b[k];
    const octet_column *from = (const octet_column *)e->lanes;
    octet_column *column = (octet_column *)to->lanes;
    for (int i = 0; i < OCTET_PLACED; i++) column[i].lane[at] = from[i].lane[k];
}

// Couples ahead: first their bodies, later the beginning of their shapes.
enum { AHEAD = 16 };

static void fetch_ahead(const ovoid_batch *batch, size_t first) {
    const ovoid_couple *couples = batch->couples;
    for (size_t i = first + 2 * AHEAD; i < first + 2 * AHEAD + OCTET && i < batch->couple_count; i++) {
        simd_prefetch(&batch->bodies[couples[i].a]);
        simd_prefetch(&batch->bodies[couples[i].b]);
    }
    for (size_t i = first + AHEAD; i < first + AHEAD + OCTET && i < batch->couple_count; i++) {
        const char *a = (const char *)batch->bodies[couples[i].a].shape;
        const char *b = (const char *)batch->bodies[couples[i].b].shape;
        simd_prefetch(a);
        simd_prefetch(a + 64);
        simd_prefetch(b);
        simd_prefetch(b + 64);
    }
}

// The ellipsoids of those that go on to them.
static void fetch_ellipsoids(const ovoid_shape *shape) {
    const char *from = (const char *)&shape->outer, *to = (const char *)&shape->inside + sizeof shape->inside - 1;
    for (; from < to; from += 64) simd_prefetch(from);
    simd_prefetch(to);
}

// A couple that the lanes are not for.
static unsigned is_unusual(const ovoid_batch *batch, size_t i, const ovoid_shape *a, const ovoid_shape *b) {
    return (a->has_origin | b->has_origin) || (batch->proofs && !is_blank(&batch->proofs[i]));
}

// The couples from `first` on, `count` of them, at most 8. The lanes that have none are lane 0 again.
static unsigned find_places(const crowd *c, size_t first, unsigned count, eight *e) {
    const ovoid_batch *batch = c->batch;
    unsigned odd = 0;
    for (unsigned k = 0; k < OCTET; k++) {
        size_t i = first + (k < count ? k : 0);
        const ovoid_body *a = &batch->bodies[batch->couples[i].a], *b = &batch->bodies[batch->couples[i].b];
        OVOID_ASSERT(a->shape && b->shape);
        e->index[k] = i;
        e->at.body_a[k] = (const void *)a;
        e->at.body_b[k] = (const void *)b;
        e->at.shape_a[k] = (const void *)a->shape;
        e->at.shape_b[k] = (const void *)b->shape;
        odd |= is_unusual(batch, i, a->shape, b->shape) << k;
    }
    return odd;
}

// Placed where they would wait, so that an eight that the spheres leave open stays there.
static void take_eight(crowd *c, size_t first, unsigned count, eight *own) {
    eight *e = c->waiting_count % OCTET ? own : &c->waiting[c->waiting_count / OCTET];
    unsigned odd = find_places(c, first, count, e), all = (1u << count) - 1;
    octet_found found = c->kernels->place(&e->at, &c->numbers, e->lanes);
    odd |= found.odd;
    // Which of them start from the line of centres.
    for (unsigned k = 0; k < OCTET; k++)
        e->lanes->line.lane[k] =
            question_takes_line(&c->ask, get_a(e, k)->shape, get_b(e, k)->shape, e->lanes->lower.lane[k]);
    unsigned apart = found.apart & ~odd & all, open = all & ~(odd | apart);
    for (unsigned rest = odd & all; rest; rest &= rest - 1)
        crowd_ask_single(c->batch, first + (unsigned)__builtin_ctz(rest), c->ask);
    for (unsigned rest = apart; rest; rest &= rest - 1)
        end_at_spheres(c, e, (unsigned)__builtin_ctz(rest), found.narrow);
    for (unsigned rest = open; rest; rest &= rest - 1) {
        unsigned k = (unsigned)__builtin_ctz(rest);
        fetch_ellipsoids((const void *)e->at.shape_a[k]);
        fetch_ellipsoids((const void *)e->at.shape_b[k]);
    }
    if (open == OCTET_ALL && e != own)
        c->waiting_count += OCTET;
    else
        for (; open; open &= open - 1) wait_for_others(c, e, (unsigned)__builtin_ctz(open));
    // Room for another eight?
    if (c->waiting_count > OCTET * (OCTET_GROUP - 1)) settle(c);
}

void crowd_run(const ovoid_batch *batch, question ask, const ovoid_options *options) {
    octet lanes[OCTET_GROUP + 1];
    eight eights[OCTET_GROUP + 1];
    for (unsigned i = 0; i <= OCTET_GROUP; i++) eights[i].lanes = &lanes[i];
    ask.iterations = options->iterations;
    int wants_evidence = batch->answers || batch->proofs;
    crowd c = {batch,
               octet_get_kernels(),
               ask,
               {ask.far, options->absolute_tolerance, options->relative_tolerance, FRAME_GLANCE, FRAME_CLAIM,
                OVOID_LENGTH_MIN, OVOID_LENGTH_MAX, wants_evidence},
               wants_evidence,
               eights,
               lanes,
               0};
    for (size_t first = 0; first < batch->couple_count; first += OCTET) {
        size_t left = batch->couple_count - first;
        fetch_ahead(batch, first);
        take_eight(&c, first, left < OCTET ? (unsigned)left : OCTET, &eights[OCTET_GROUP]);
    }
    if (c.waiting_count) settle(&c);
}
