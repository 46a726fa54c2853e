// A liar for ovoid_body_verify: true answers about compounds and shapes, of all four queries, are altered
// one field at a time (alter.h), and their exclusions: each field of some, one left out, doubled, another's, two
// swapped. Truth: exact arithmetic (the judge), by the parts of every exclusion; and for the limit what its words
// promise. What these show to be false must be refused; what is still true may pass. Answers as they were must pass.
#include "compounds.h"
#include "judge.h"
#include "options.h"
#include "proofs/alter_answer.h"
#include "proofs/covers.h"

#include <time.h>

enum { CAPACITY = 600 };
static ovoid_exclusion items[CAPACITY], altered[CAPACITY];
STATIC_COVER(cover);
static judge *court;

typedef struct told {
    ovoid_body_pair pair;
    ovoid_options options;
    ovoid_body_answer other;
    uint32_t counts[2];
    double most;
} told;

#define EXCLUSION_VEC3(member)                                                                                         \
    ALTER_FIELD(ovoid_exclusion, member.x, ALTER_REAL, 1e-9),                                                          \
        ALTER_FIELD(ovoid_exclusion, member.y, ALTER_REAL, 1e-9),                                                      \
        ALTER_FIELD(ovoid_exclusion, member.z, ALTER_REAL, 1e-9)
static const alter_field exclusion_fields[] = {ALTER_FIELD(ovoid_exclusion, first_a, ALTER_U32, 0),
                                               ALTER_FIELD(ovoid_exclusion, end_a, ALTER_U32, 0),
                                               ALTER_FIELD(ovoid_exclusion, first_b, ALTER_U32, 0),
                                               ALTER_FIELD(ovoid_exclusion, end_b, ALTER_U32, 0),
                                               EXCLUSION_VEC3(normal),
                                               EXCLUSION_VEC3(normal_low),
                                               ALTER_FIELD(ovoid_exclusion, lower, ALTER_REAL, 1e-9)};
enum { EXCLUSION_FIELDS = sizeof exclusion_fields / sizeof *exclusion_fields };
static const alter_field part_fields[] = {
    ALTER_FIELD(ovoid_body_answer, part_a, ALTER_U32, 0),      ALTER_FIELD(ovoid_body_answer, part_b, ALTER_U32, 0),
    ALTER_FIELD(ovoid_body_answer, status, ALTER_INT, 0),      ALTER_FIELD(ovoid_body_answer, limit, ALTER_INT, 0),
    ALTER_FIELD(ovoid_body_answer, lower, ALTER_REAL, 1e-9),   ALTER_FIELD(ovoid_body_answer, upper, ALTER_REAL, 1e-9),
    ALTER_FIELD(ovoid_body_answer, inside, ALTER_INT, 0),      ALTER_FIELD(ovoid_body_answer, component, ALTER_U32, 0),
    ALTER_FIELD(ovoid_body_answer, common.x, ALTER_REAL, 1e-9)};
enum { PART_FIELDS = sizeof part_fields / sizeof *part_fields };

static alter_count of_answer[ALTER_ANSWER_FIELDS], of_parts[PART_FIELDS], of_fields[EXCLUSION_FIELDS], of_forged,
    of_lists, of_cover;
static const alter_table answer_table = ALTER_TABLE(alter_answer_fields, of_answer),
                         part_table = ALTER_TABLE(part_fields, of_parts),
                         exclusion_table = ALTER_TABLE(exclusion_fields, of_fields);

static void tell(const told *t, const ovoid_body_answer *x, const ovoid_exclusions *all, alter_count *n) {
    ovoid_error why = {.message = ""};
    int is_refused = ovoid_body_verify(&t->pair, x, &(ovoid_body_basis){.options = &t->options, .exclusions = all},
                                       NULL) != OVOID_OK;
    judge_set_options(court, &t->options);
    int is_lie = !is_refused && (judge_verify_compound(court, &t->pair, x, all, &why) != OVOID_OK ||
                                 alter_limit_is_false(&x->deciding, t->most, 0, t->options.cap));
    if (!alter_take(n, is_lie, is_refused) && check_failed < 20)
        printf("  %s %s [%.17g, %.17g]: %s\n", ovoid_status_get_name(x->status), ovoid_limit_get_name(x->limit),
               x->lower, x->upper, why.message);
}

static void lie_about_answer(const told *t, const ovoid_body_answer *x, const ovoid_exclusions *all) {
    ovoid_answer deciding = x->deciding;
    alter_walk of_deciding = alter_walk_make(&answer_table, &deciding, sizeof deciding, &t->other.deciding);
    for (alter_count *n; (n = alter_next(&of_deciding));) {
        const ovoid_body_answer y = ovoid_body_answer_make(&deciding, x->part_a, x->part_b);
        tell(t, &y, all, n);
    }
    alter_name = "forged", alter_way = "";
    for (int which = 0; which < ALTER_ANSWER_FORGERIES; which++, deciding = x->deciding) {
        if (!alter_answer_forge(&deciding, &t->other.deciding, t->counts, which)) continue;
        const ovoid_body_answer y = ovoid_body_answer_make(&deciding, x->part_a, x->part_b);
        tell(t, &y, all, &of_forged);
    }
    ovoid_body_answer y = *x;
    alter_walk w = alter_walk_make(&part_table, &y, sizeof y, &t->other);
    for (alter_count *n; (n = alter_next(&w));) tell(t, &y, all, n);
}

static void lie_about_exclusions(const told *t, const ovoid_body_answer *x, const ovoid_exclusions *all, uint64_t *s) {
    ovoid_exclusions y = {.items = altered, .capacity = CAPACITY, .count = all->count, .cover = all->cover};
    size_t at = random_next(s) % all->count, other = random_next(s) % all->count, bytes = all->count * sizeof *items;
    memcpy(altered, items, bytes);
    alter_walk w = alter_walk_make(&exclusion_table, &altered[at], sizeof *altered, &items[other]);
    for (alter_count *n; (n = alter_next(&w));) tell(t, x, &y, n);
    alter_name = "exclusions", alter_way = "left out, doubled or swapped";
    for (int which = 0; which < 5; which++) {
        memcpy(altered, items, bytes);
        y.count = all->count, y.capacity = CAPACITY;
        switch (which) {
        case 0: memmove(&altered[at], &altered[at + 1], (--y.count - at) * sizeof *altered); break;
        case 1: altered[at] = altered[other]; break;
        case 2: altered[at] = items[other], altered[other] = items[at]; break;
        case 3: y.count = 0; break;
        default: y.capacity = all->count - 1; break;
        }
        if (at != other || which > 2) tell(t, x, &y, &of_lists);
    }
}

static void lie_about_cover(const told *t, const ovoid_body_answer *x, const ovoid_exclusions *all, uint64_t *s) {
    static own_cover y;
    const ovoid_cover *kept = all->cover;
    ovoid_exclusions with = *all;
    with.cover = &y.cover;
    uint32_t point = (uint32_t)(random_next(s) % kept->point_count),
             at = (uint32_t)(random_next(s) % kept->triangle_count);
    alter_name = "cover", alter_way = "altered";
    for (int which = 0; which < 5; which++) {
        own_cover_copy(&y, kept);
        switch (which) {
        case 0: y.cover.triangle_count--; break;
        case 1: y.a[point] = UINT32_MAX; break;
        case 2: y.triangles[at][which] = (uint16_t)kept->point_count; break;
        case 3: y.cover.point_count = y.cover.triangle_count = 0; break;
        default: y.b[point] = kept->b[(point + 1) % kept->point_count]; break;
        }
        if (which != 4 || y.b[point] != kept->b[point]) tell(t, x, &with, &of_cover);
    }
}

static ovoid_body_answer ask(const told *t, int query, double margin, ovoid_exclusions *all) {
    switch (query) {
    case 0: return ovoid_body_collide(&t->pair, &t->options, &(ovoid_body_evidence){.exclusions = all});
    case 1: return ovoid_body_within(&t->pair, margin, &t->options, &(ovoid_body_evidence){.exclusions = all});
    case 2: return ovoid_body_distance(&t->pair, &t->options, &(ovoid_body_evidence){.exclusions = all});
    default: return ovoid_body_depth(&t->pair, &t->options, &(ovoid_body_evidence){.exclusions = all});
    }
}

static uint32_t find_vertex_count(const ovoid_body *body, uint32_t part) {
    return ovoid_shape_get_polytope(get_part(body, part).shape).vertex_count;
}

static void check_pair(told *t, uint64_t *s) {
    static ovoid_body_answer last;
    ovoid_exclusions all = {.items = items, .capacity = CAPACITY, .cover = &cover};
    ovoid_error error = {.message = ""};
    t->options = (ovoid_options){0};
    uint64_t which = random_next(s) % 6;
    if (which == 1) t->options.absolute_tolerance = random_uniform(s, 0, 2);
    if (which == 2) t->options.relative_tolerance = random_uniform(s, 0, 0.1);
    if (which == 3) t->options.cap = random_uniform(s, 0, 3);
    ovoid_body_answer x = ask(t, (int)(random_next(s) % 4), random_uniform(s, 0, 2), &all);
    if (all.count > CAPACITY) return;
    double relative = t->options.relative_tolerance > 0 ? t->options.relative_tolerance : 1e-9;
    // No compound here is larger, the shape that lies 1000 from its own origin counted.
    t->most = fmax(t->options.absolute_tolerance, relative * 5000);
    t->other = last;
    t->counts[0] = find_vertex_count(&t->pair.a, x.part_a);
    t->counts[1] = find_vertex_count(&t->pair.b, x.part_b);
    if (!CHECK(ovoid_body_verify(&t->pair, &x, &(ovoid_body_basis){.options = &t->options, .exclusions = &all},
                                 &error) == OVOID_OK))
        puts(error.message);
    lie_about_answer(t, &x, &all);
    if (all.count) lie_about_exclusions(t, &x, &all, s);
    if (cover.point_count) lie_about_cover(t, &x, &all, s);
    last = x;
}

static void run_round(uint64_t s) {
    ovoid_shape *shapes[SHAPES];
    if (!make_shapes(shapes, 1, &s)) return;
    double reach = random_next(&s) % 2 ? 1.5 : 4;
    ovoid_compound *a = make_compound(shapes, 1 + random_next(&s) % 8, reach, &s),
                   *b = make_compound(shapes, 1 + random_next(&s) % 8, reach, &s);
    for (int i = 0; i < 12 && CHECK(a && b); i++) {
        told t = {.pair = {{.compound = a, .pose = {random_vec3(&s, reach), random_quat(&s)}},
                           {.compound = b, .pose = {random_vec3(&s, 2 * reach), random_quat(&s)}}}};
        if (i % 4 == 3) t.pair.b.compound = NULL, t.pair.b.shape = shapes[random_next(&s) % SHAPES];
        if (i % 8 == 7) t.pair.a.compound = NULL, t.pair.a.shape = shapes[0];
        check_pair(&t, &s);
    }
    ovoid_compound_destroy(a);
    ovoid_compound_destroy(b);
    judge_forget(court);
    destroy_shapes(shapes);
}

int main(int count, char **arguments) {
    double seconds = 12;
    uint64_t seed = 1;
    const test_option options[] = {{"seconds", "about how long (12)", NULL, &seconds, NULL, NULL},
                                   {"seed", "of the first round (1)", &seed, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    court = judge_create();
    if (!CHECK(court != NULL)) return check_end();
    time_t end = time(NULL) + (time_t)seconds;
    for (uint64_t round = 0; round == 0 || time(NULL) < end; round++) run_round((seed + round) * 1000003);
    alter_print_table(&answer_table);
    alter_print("forged", &of_forged);
    alter_print_table(&part_table);
    alter_print_table(&exclusion_table);
    alter_print("list of exclusions", &of_lists);
    alter_print("cover", &of_cover);
    judge_destroy(court);
    return check_end();
}
