// A liar for ovoid_answer_verify: true answers of every family of the trials, of all five queries, with options of
// every kind, are altered one field at a time (alter.h), their covers too. Truth: exact arithmetic (the judge), which
// looks at the altered answer as it stands; and for the limit what its words promise. What these show to be false must
// be refused; what is still true may pass. Answers as they were must pass.
#include "options.h"
#include "proofs/alter_answer.h"
#include "proofs/covers.h"
#include "trials/families.h"
#include "trials/shapes.h"

#include <time.h>

typedef struct told {
    ovoid_pair pair;
    ovoid_options options;
    ovoid_answer other; ///< of another query or pair
    uint32_t counts[2];
    double most, wide;
} told;

static alter_count counts[ALTER_ANSWER_FIELDS + 2];
static const alter_table table = ALTER_TABLE(alter_answer_fields, counts);

static int is_false(const told *t, const ovoid_answer *x, const ovoid_cover *cover) {
    judge_set_options(trial_judge, &t->options);
    return judge_verify_answer(trial_judge, &t->pair, x, cover, NULL) != OVOID_OK ||
           alter_limit_is_false(x, t->most, t->wide, t->options.cap);
}

static void tell(const told *t, const ovoid_answer *x, const ovoid_cover *cover, alter_count *n) {
    int is_refused = ovoid_answer_verify(&t->pair, x, &(ovoid_answer_basis){.options = &t->options, .cover = cover},
                                         NULL) != OVOID_OK;
    int is_lie = !is_refused && is_false(t, x, cover);
    if (!alter_take(n, is_lie, is_refused) && check_failed < 20)
        printf("  %s %s [%.17g, %.17g] kind %s count %u\n", ovoid_status_get_name(x->status),
               ovoid_limit_get_name(x->limit), x->lower, x->upper, ovoid_proof_kind_get_name(x->proof.kind),
               x->proof.count);
}

static void lie_about_cover(const told *t, const ovoid_answer *x, const ovoid_cover *cover, uint64_t *s) {
    static own_cover y;
    alter_name = "cover", alter_way = "altered";
    for (int which = 0; which < 24; which++) {
        own_cover_copy(&y, cover);
        uint32_t point = (uint32_t)(random_next(s) % cover->point_count);
        uint16_t *triangle = y.triangles[random_next(s) % cover->triangle_count], kept = triangle[0];
        switch (which % 12) {
        case 0: y.cover.point_count--; break;
        case 1: y.cover.triangle_count--; break;
        case 2: y.a[point] = t->counts[0]; break;
        case 3: y.b[point] = t->counts[1]; break;
        case 4: y.a[point] = (y.a[point] + 1) % t->counts[0]; break;
        case 5: y.b[point] = (y.b[point] + 1) % t->counts[1]; break;
        case 6: triangle[0] = triangle[1], triangle[1] = kept; break;
        case 7: triangle[random_next(s) % 3] = (uint16_t)cover->point_count; break;
        case 8: triangle[random_next(s) % 3] = (uint16_t)(random_next(s) % cover->point_count); break;
        case 9: y.cover.point_count = OVOID_COVER_POINTS_MAX + 1; break;
        case 10: y.cover.triangle_count = 2 * OVOID_COVER_POINTS_MAX + 1; break;
        default: memcpy(triangle, y.triangles[0], sizeof *y.triangles); break;
        }
        if (!own_cover_is_same(&y, cover)) tell(t, x, &y.cover, &counts[ALTER_ANSWER_FIELDS + 1]);
    }
    alter_way = "left out";
    tell(t, x, NULL, &counts[ALTER_ANSWER_FIELDS + 1]);
}

static void lie_about(const told *t, const ovoid_answer *x, const ovoid_cover *cover, uint64_t *s) {
    ovoid_error error = {.message = ""};
    if (!CHECK(ovoid_answer_verify(&t->pair, x, &(ovoid_answer_basis){.options = &t->options, .cover = cover},
                                   &error) == OVOID_OK))
        puts(error.message);
    if (x->stage == OVOID_STAGE_NONE && x->lower == -INFINITY) return;
    CHECK(!alter_limit_is_false(x, t->most, t->wide, t->options.cap));
    ovoid_answer y = *x;
    alter_walk w = alter_walk_make(&table, &y, sizeof y, &t->other);
    for (alter_count *n; (n = alter_next(&w));) tell(t, &y, cover, n);
    alter_name = "forged", alter_way = "";
    for (int which = 0; which < ALTER_ANSWER_FORGERIES; which++, y = *x)
        if (alter_answer_forge(&y, &t->other, t->counts, which)) tell(t, &y, cover, &counts[ALTER_ANSWER_FIELDS]);
    if (x->proof.kind == OVOID_PROOF_COVER) lie_about_cover(t, x, cover, s);
}

static ovoid_answer ask(const told *t, int query, double margin, ovoid_cover *cover) {
    switch (query) {
    case 0: return ovoid_collide(&t->pair, &t->options, NULL);
    case 1: return ovoid_within(&t->pair, margin, &t->options, NULL);
    case 2: return ovoid_distance(&t->pair, &t->options, NULL);
    case 3: return ovoid_depth(&t->pair, &t->options, NULL, cover);
    default: return ovoid_pair_compute_bounds(&t->pair);
    }
}

static double get_width(const ovoid_shape *s) {
    ovoid_allowance allowance = ovoid_shape_get_allowance(s);
    return allowance.outside + allowance.inside;
}

static void lie_about_trial(const trial *made, uint64_t *s) {
    STATIC_COVER(cover);
    static ovoid_answer last;
    told t = {.pair = {made->a, made->b, made->pose_a, made->pose_b}, .other = last};
    double size = pair_size(&t.pair);
    int query = (int)(random_next(s) % 5);
    switch (query < 4 ? random_next(s) % 8 : 0) {
    case 1: t.options.relative_tolerance = random_uniform(s, 0, 0.1); break;
    case 2: t.options.absolute_tolerance = random_uniform(s, 0, size); break;
    case 3: t.options.relative_tolerance = 1e-14; break;
    case 4: t.options.cap = random_uniform(s, 0, size); break;
    case 5: t.options.iterations = 1 + (uint32_t)(random_next(s) % 4); break;
    default: break;
    }
    t.counts[0] = ovoid_shape_get_polytope(made->a).vertex_count;
    t.counts[1] = ovoid_shape_get_polytope(made->b).vertex_count;
    double relative = t.options.relative_tolerance > 0 ? t.options.relative_tolerance : 1e-9;
    t.wide = (get_width(made->a) + get_width(made->b)) * (1 + 1e-12);
    t.most = fmax(t.options.absolute_tolerance, relative * size) * (1 + 1e-6) + pair_unresolved(&t.pair);
    cover.point_count = cover.triangle_count = 0;
    ovoid_answer x = ask(&t, query, random_uniform(s, 0, size), &cover);
    lie_about(&t, &x, cover.point_count ? &cover : NULL, s);
    last = x;
}

static void run_family(family *f, uint64_t seed) {
    uint64_t s = seed;
    trial made = f->make(&s);
    if (made.a && made.b) lie_about_trial(&made, &s);
    judge_forget(trial_judge);
    ovoid_shape_destroy(made.a);
    ovoid_shape_destroy(made.b);
}

int main(int count, char **arguments) {
    double seconds = 12;
    uint64_t seed = 1;
    const test_option options[] = {{"seconds", "about how long (12)", NULL, &seconds, NULL, NULL},
                                   {"seed", "of the first round (1)", &seed, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    trial_judge = judge_create();
    if (!CHECK(trial_judge != NULL)) return check_end();
    time_t end = time(NULL) + (time_t)seconds;
    for (uint64_t round = 0; round == 0 || time(NULL) < end; round++)
        for (size_t i = 0; i < family_count; i++) run_family(&families[i], (seed + round) * 1000003 + i);
    alter_print_table(&table);
    alter_print("forged", &counts[ALTER_ANSWER_FIELDS]);
    alter_print("cover", &counts[ALTER_ANSWER_FIELDS + 1]);
    judge_destroy(trial_judge);
    families_forget_data();
    return check_end();
}
