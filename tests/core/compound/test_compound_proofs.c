// What proves an answer about compounds, altered: it must be refused. Truth: an altered exclusion that claims more than
// its normal shows (measured here from the vertices), or a set of exclusions with a hole in it, proves nothing.
#include "compounds.h"
#include "pairs.h"
#include "proofs/covers.h"

enum { CAPACITY = 20000 };
static ovoid_exclusion items[CAPACITY];
STATIC_COVER(cover);

static double find_extreme(const ovoid_body *body, uint32_t first, uint32_t end, vec3 n) {
    double most = -INFINITY;
    for (uint32_t k = first; k < end; k++) {
        uint32_t i = body->compound ? ovoid_compound_get_order(body->compound)[k] : 0;
        ovoid_posed_shape part = get_part(body, i);
        ovoid_polytope p = ovoid_shape_get_polytope(part.shape);
        for (uint32_t v = 0; v < p.vertex_count; v++) {
            vec3 at = ovoid_pose_compute_point(&part.pose, vec3_add(vec3_at(p.vertices, v), p.origin));
            most = fmax(most, vec3_dot(n, at) + ovoid_shape_get_radius(part.shape));
        }
    }
    return most;
}

// The gap that an exclusion's normal shows, to 1e-13 of the size.
static double measure(const ovoid_body_pair *pair, const ovoid_exclusion *e) {
    vec3 n = vec3_unit(e->normal);
    return -find_extreme(&pair->b, e->first_b, e->end_b, vec3_neg(n)) - find_extreme(&pair->a, e->first_a, e->end_a, n);
}

static int is_accepted(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_exclusions *all) {
    ovoid_error error = {.message = ""};
    ovoid_code code = ovoid_body_verify(pair, x, &(ovoid_body_basis){.exclusions = all}, &error);
    CHECK(code == OVOID_OK || (code == OVOID_ERROR_PROOF && error.message[0]));
    return code == OVOID_OK;
}

static int is_at(const ovoid_body *body, uint32_t part, uint32_t first, uint32_t end) {
    for (uint32_t k = first; k < end; k++)
        if ((body->compound ? ovoid_compound_get_order(body->compound)[k] : 0) == part) return 1;
    return 0;
}

// Each number of one exclusion.
static void alter_item(const ovoid_body_pair *pair, const ovoid_body_answer *x, ovoid_exclusions *all, size_t i,
                       double size) {
    ovoid_exclusion *e = &all->items[i], kept = *e;
    double shown = measure(pair, e);
    CHECK_LE(e->lower, shown + 1e-13 * size);
    e->lower = shown + 1e-12 * size;
    CHECK(!is_accepted(pair, x, all));
    e->lower = NAN;
    CHECK(!is_accepted(pair, x, all));
    *e = kept;
    // Less than the answer claims.
    e->lower = x->lower - 1e-9 * size;
    CHECK(!is_accepted(pair, x, all));
    *e = kept;
    e->normal = vec3_neg(e->normal);
    double turned = measure(pair, e);
    if (fabs(turned - e->lower) > 1e-12 * size) CHECK_EQ(is_accepted(pair, x, all), turned > e->lower);
    e->normal = (vec3){0, 0, 0};
    CHECK(!is_accepted(pair, x, all));
    e->normal = (vec3){NAN, 0, 1};
    CHECK(!is_accepted(pair, x, all));
    *e = kept;
    // An early answer's exclusion holds the deciding pair too, and may do without it.
    int is_double =
        is_at(&pair->a, x->part_a, e->first_a, e->end_a) && is_at(&pair->b, x->part_b, e->first_b, e->end_b);
    // Ranges: smaller, empty, past the end.
    uint32_t *ends[4] = {&e->first_a, &e->end_a, &e->first_b, &e->end_b};
    for (int k = 0; k < 4; k++) {
        *ends[k] += k % 2 ? UINT32_MAX : 1;
        if (!is_double) CHECK(!is_accepted(pair, x, all));
        *e = kept;
        *ends[k] = 1000000;
        CHECK(!is_accepted(pair, x, all));
        *e = kept;
    }
    // Left out altogether.
    memmove(e, e + 1, (all->count - 1 - i) * sizeof *e);
    all->count--;
    CHECK(!is_accepted(pair, x, all));
    memmove(e + 1, e, (all->count - i) * sizeof *e);
    all->count++;
    *e = kept;
}

static void alter_answer(const ovoid_body_pair *pair, const ovoid_body_answer *x, const ovoid_exclusions *all,
                         double size) {
    ovoid_body_answer y = *x;
    y.lower = x->upper + 1e-9 * size;
    CHECK(!is_accepted(pair, &y, all));
    y = *x;
    y.upper = x->lower - 1e-9 * size;
    CHECK(!is_accepted(pair, &y, all));
    y = *x;
    y.part_a = (uint32_t)get_count(&pair->a);
    CHECK(!is_accepted(pair, &y, all));
    y = *x;
    y.part_b = UINT32_MAX;
    CHECK(!is_accepted(pair, &y, all));
    y = *x;
    y.deciding.status = y.status = y.status == OVOID_SEPARATED ? OVOID_OVERLAPPING : OVOID_SEPARATED;
    CHECK(!is_accepted(pair, &y, all));
    // Without exclusions nothing is known of the other pairs, unless there are none.
    ovoid_exclusions none = {.cover = all->cover}, cut = *all;
    if (all->count) {
        CHECK(!is_accepted(pair, x, &none));
        cut.capacity = all->count - 1;
        CHECK(!is_accepted(pair, x, &cut));
    }
    y = *x;
    y.deciding.lower = y.lower = -INFINITY;
    y.deciding.limit = y.limit = OVOID_LIMIT_ANSWERED; // a depth's would promise a narrow bracket
    if (x->status == OVOID_OVERLAPPING) CHECK(is_accepted(pair, &y, &none));
}

static void check_pair(const ovoid_body_pair *pair, double size, uint64_t *s) {
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY, .cover = &cover};
    for (int question = 0; question < 3; question++) {
        ovoid_body_answer x =
            question == 0   ? ovoid_body_distance(pair, NULL, &(ovoid_body_evidence){.exclusions = &all})
            : question == 1 ? ovoid_body_depth(pair, NULL, &(ovoid_body_evidence){.exclusions = &all})
                            : ovoid_body_within(pair, 0.1 * size, NULL, &(ovoid_body_evidence){.exclusions = &all});
        CHECK_LE(all.count, CAPACITY);
        if (!CHECK(is_accepted(pair, &x, &all))) return;
        alter_answer(pair, &x, &all, size);
        for (int i = 0; i < 6 && all.count; i++) alter_item(pair, &x, &all, random_next(s) % all.count, size);
        CHECK(is_accepted(pair, &x, &all));
        // The deciding pair may not be another one: nothing excludes it.
        ovoid_body_answer y = x;
        y.part_a = (x.part_a + 1) % (uint32_t)get_count(&pair->a);
        ovoid_pair parts = get_pair(pair, y.part_a, y.part_b);
        y.deciding = ovoid_depth(&parts, NULL, NULL, &cover);
        y.lower = fmin(y.lower, x.lower);
        if (y.part_a != x.part_a && x.status == OVOID_SEPARATED && question == 0) CHECK(!is_accepted(pair, &y, &all));
    }
}

// A range of one part with the low half of a normal: pairs of boxes that are apart by less than doubles can tell.
static void check_fine(void) {
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_posed_shape parts[3] = {
        {box, {{0, 0, 0}, {1, 0, 0, 0}}}, {box, {{0, 5, 0}, {1, 0, 0, 0}}}, {box, {{0, 10, 0}, {0, 1, 0, 0}}}};
    ovoid_compound *c = ovoid_compound_create(parts, 3, NULL, NULL);
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY};
    for (int i = 0; i < 32; i++) {
        ovoid_body_pair pair = {{.compound = c, .pose = {{0, 0, 0}, {1, 0, 0, 0}}},
                                {.compound = c, .pose = {{2, 0, 0}, {1, 0, 0, 0}}}};
        pair.b.pose.position.x += i < 20 ? 0 : ldexp(1, -i - 20);
        ovoid_body_answer x = ovoid_body_collide(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        if (i >= 20)
            CHECK_EQ(x.status, OVOID_SEPARATED);
        else
            CHECK_EQ(x.status, OVOID_TOUCHING);
        CHECK(is_accepted(&pair, &x, &all));
        x = ovoid_body_distance(&pair, NULL, &(ovoid_body_evidence){.exclusions = &all});
        CHECK(is_accepted(&pair, &x, &all));
    }
    ovoid_compound_destroy(c);
    ovoid_shape_destroy(box);
}

int main(void) {
    for (int i = 0; i < 24; i++) {
        static const double scales[3] = {1, 1e-9, 1e9};
        uint64_t s = check_seed = 31 + (uint64_t)i;
        double scale = scales[i % 3];
        ovoid_shape *shapes[SHAPES];
        if (!make_shapes(shapes, scale, &s)) return check_end();
        ovoid_compound *a = make_compound(shapes, 2 + (size_t)i, 4 * scale, &s);
        ovoid_compound *b = make_compound(shapes, 1 + (size_t)i / 2, 4 * scale, &s);
        ovoid_body_pair pair = {{.compound = a, .pose = {random_vec3(&s, 4 * scale), random_quat(&s)}},
                                {.compound = b, .pose = {random_vec3(&s, (i % 4) * 8 * scale), random_quat(&s)}}};
        if (CHECK(a && b)) check_pair(&pair, 20 * scale, &s);
        ovoid_compound_destroy(a);
        ovoid_compound_destroy(b);
        destroy_shapes(shapes);
    }
    check_seed = 0;
    check_fine();
    return check_end();
}
