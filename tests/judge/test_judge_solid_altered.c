// A liar for ovoid_body_verify. Right answers about solids, surfaces, hulls and compounds are altered one field
// at a time (alter.h), their exclusions too, and others are forged: an overlap without a reason, a distance of what
// overlaps, touching within a wide bracket.
//
// Truth, by other means than the check's: the judge's exact arithmetic (of pairs without a compound); brute force over
// all triangles (is there a common point, how far are the surfaces apart); and the right answer, whose bracket must
// have a point in common with any other true one. What these show to be false must be refused.
#include "alter.h"
#include "judge.h"
#include "options.h"
#include "solids.h"

enum { CAPACITY = 20000, KINDS = 12 };
static ovoid_exclusion items[CAPACITY];
static judge *court;

typedef struct truth {
    ovoid_body_pair pair;
    ovoid_body_answer right;
    ovoid_exclusions all;
    solid_truth brute;
    double slack;
    int has_compound;
    uint32_t count_a, count_b;
} truth;

// ---- what answers claim

static int is_finite_vector(ovoid_vec3 v) { return isfinite(v.x) && isfinite(v.y) && isfinite(v.z); }

// A bracket that has no point in common with the right one, or that is none.
static int bracket_is_false(const truth *t, const ovoid_body_answer *x) {
    const ovoid_body_answer *r = &t->right;
    if (!(x->lower <= x->upper) || x->lower > r->upper || x->upper < r->lower) return 1;
    if (x->deciding.lower > r->deciding.upper || x->deciding.upper < r->deciding.lower) return 1;
    if (t->brute.is_common) return x->lower > t->slack;
    return x->upper < t->brute.surfaces - t->slack || x->lower > t->brute.surfaces + t->slack;
}

static int status_is_false(const truth *t, const ovoid_body_answer *x) {
    double tolerance = 1e-8 * (t->slack / 1e-13);
    switch (x->status) {
    case OVOID_SEPARATED: return !(x->lower > 0) || x->inside;
    case OVOID_OVERLAPPING: return !(x->upper < 0);
    case OVOID_TOUCHING: return !(x->lower <= 0 && x->upper >= 0 && x->upper - x->lower <= tolerance) || x->inside;
    case OVOID_UNDECIDED: return !(x->lower <= 0 && x->upper >= 0) || x->inside;
    }
    return 1;
}

static int is_false(const truth *t, const ovoid_body_answer *x, const ovoid_exclusions *all) {
    ovoid_error error;
    int claims = x->status != OVOID_UNDECIDED || x->lower != -INFINITY || x->upper != INFINITY;
    if (x->limit >= OVOID_LIMIT_POSE_A && x->limit <= OVOID_LIMIT_SHAPE_B)
        return claims || x->limit != OVOID_LIMIT_OPTIONS;
    if (x->part_a >= t->count_a || x->part_b >= t->count_b || !is_finite_vector(x->common)) return 1;
    if (bracket_is_false(t, x) || status_is_false(t, x)) return 1;
    if (t->has_compound) return 0;
    ovoid_code code = judge_verify_solid(court, &t->pair, x, all, 0, &error);
    judge_forget(court);
    return code != OVOID_OK;
}

// ---- lies

static void tell(truth *t, const ovoid_body_answer *x, const ovoid_exclusions *all, alter_count *n) {
    int is_refused = ovoid_body_verify(&t->pair, x, &(ovoid_body_basis){.exclusions = all}, NULL) != OVOID_OK;
    alter_take(n, !is_refused && is_false(t, x, all), is_refused);
}

#define REAL(member, tolerance) ALTER_FIELD(ovoid_body_answer, member, ALTER_REAL, tolerance)
#define VECTOR(member, tolerance) REAL(member.x, tolerance), REAL(member.y, tolerance), REAL(member.z, tolerance)
#define WHOLE(member) ALTER_FIELD(ovoid_body_answer, member, ALTER_U32, 0)
static const alter_field fields[] = {
    ALTER_FIELD(ovoid_body_answer, status, ALTER_INT, 0),
    ALTER_FIELD(ovoid_body_answer, limit, ALTER_INT, 0),
    REAL(lower, 1e-9),
    REAL(upper, 1e-9),
    VECTOR(parting, 1e-9),
    ALTER_FIELD(ovoid_body_answer, inside, ALTER_INT, 0),
    WHOLE(component),
    VECTOR(common, 1e-3),
    WHOLE(part_a),
    WHOLE(part_b),
    ALTER_FIELD(ovoid_body_answer, deciding.status, ALTER_INT, 0),
    REAL(deciding.lower, 1e-9),
    REAL(deciding.upper, 1e-9),
    VECTOR(deciding.point_a, 1e-9),
    VECTOR(deciding.point_b, 1e-9),
    VECTOR(deciding.normal, 1e-9),
    VECTOR(deciding.proof.normal, 1e-9),
    VECTOR(deciding.proof.normal_low, 1e-9),
    ALTER_FIELD(ovoid_body_answer, deciding.proof.kind, ALTER_INT, 0),
    WHOLE(deciding.proof.count),
    WHOLE(deciding.proof.a[0]),
    WHOLE(deciding.proof.b[0]),
    WHOLE(deciding.proof.b[1]),
    REAL(deciding.proof.weight_a[0], 1e-9),
    REAL(deciding.proof.weight_b[1], 1e-9),
};
enum { FIELDS = sizeof fields / sizeof *fields };
#define ITEM(member) ALTER_FIELD(ovoid_exclusion, member, ALTER_U32, 0)
#define ITEM_REAL(member) ALTER_FIELD(ovoid_exclusion, member, ALTER_REAL, 1e-9)
static const alter_field item_fields[] = {ITEM(first_a),           ITEM(end_a),
                                          ITEM(first_b),           ITEM(end_b),
                                          ITEM_REAL(normal.x),     ITEM_REAL(normal.y),
                                          ITEM_REAL(normal.z),     ITEM_REAL(lower),
                                          ITEM_REAL(normal_low.x), ITEM_REAL(normal_low.z)};
enum { ITEM_FIELDS = sizeof item_fields / sizeof *item_fields };
static alter_count counts[FIELDS], item_counts[ITEM_FIELDS], forged_count, list_count;

static const alter_table table = ALTER_TABLE(fields, counts);

// scale: the unit of the bodies, of lengths.
static void lie_about(truth *t, const ovoid_body_answer *other, double scale) {
    ovoid_body_answer x = t->right;
    alter_walk w = alter_walk_make(&table, &x, sizeof x, other);
    w.scale = scale;
    for (alter_count *n; (n = alter_next(&w));) tell(t, &x, &t->all, n);
}

static void lie_about_exclusions(truth *t, double scale) {
    const size_t count = t->all.count, which[3] = {0, count / 2, count ? count - 1 : 0};
    alter_field own[ITEM_FIELDS];
    const alter_table item_table = ALTER_TABLE(own, item_counts);
    memcpy(own, item_fields, sizeof own);
    own[7].tolerance *= scale; // lower
    for (int k = 0; k < 3 && count; k++) {
        const ovoid_exclusion other = items[(which[k] + 1) % count];
        alter_walk w = alter_walk_make(&item_table, &items[which[k]], sizeof *items, &other);
        for (alter_count *n; (n = alter_next(&w));) tell(t, &t->right, &t->all, n);
    }
    // Fewer or more than there are, and none.
    alter_name = "exclusions";
    for (int i = 0; i < 4 && count; i++) {
        ovoid_exclusions all = t->all;
        all.count = i == 0 ? 0 : i == 1 ? count - 1 : i == 2 ? count / 2 : all.capacity + 1;
        tell(t, &t->right, i == 3 ? &all : &all, &list_count);
    }
}

// ---- forgeries

static void forge(truth *t, const char *name, const ovoid_body_answer *x) {
    alter_name = name;
    alter_way = "forged";
    tell(t, x, &t->all, &forged_count);
}

// An overlap of depth r by every reason that there is.
static void forge_overlaps(truth *t, double r, uint64_t *s) {
    ovoid_body_answer x = t->right;
    x.status = OVOID_OVERLAPPING;
    x.limit = OVOID_LIMIT_NONE;
    x.upper = -r;
    x.lower = fmin(x.lower, x.upper);
    for (int inside = 0; inside <= OVOID_BODY_COMMON_POINT; inside++) {
        x.inside = (ovoid_body_inside)inside;
        x.component = 0;
        x.common = inside == OVOID_BODY_COMMON_POINT ? random_vec3(s, 10 * r) : (ovoid_vec3){0, 0, 0};
        forge(t, "overlapping", &x);
        x.deciding.upper = fmin(x.deciding.upper, x.upper);
        forge(t, "overlapping, and so the surfaces", &x);
        x.deciding = t->right.deciding;
    }
}

static void forge_all(truth *t, double scale, uint64_t *s) {
    const ovoid_body_answer *r = &t->right;
    double size = scale * random_uniform(s, 1e-3, 1);
    forge_overlaps(t, size, s);
    forge_overlaps(t, fabs(r->deciding.lower), s);
    ovoid_body_answer x = *r;
    x.status = OVOID_SEPARATED, x.inside = OVOID_BODY_INSIDE_NONE, x.component = 0, x.common = (ovoid_vec3){0, 0, 0};
    x.lower = r->deciding.lower, x.upper = r->deciding.upper;
    forge(t, "separated by the surfaces", &x);
    x.upper = 0.5 * x.upper, x.lower = fmin(x.lower, x.upper);
    forge(t, "separated by half of it", &x);
    x = *r, x.inside = OVOID_BODY_INSIDE_NONE, x.component = 0, x.common = (ovoid_vec3){0, 0, 0};
    for (int status = 0; status < 3; status += 2) {
        x.status = status ? OVOID_TOUCHING : OVOID_UNDECIDED;
        x.lower = fmin(r->lower, 0), x.upper = fmax(r->upper, 0);
        forge(t, "open", &x);
        x.upper = 0.5 * fmax(r->deciding.upper, 0);
        forge(t, "open, below the surfaces", &x);
        x.lower = -size, x.upper = size;
        forge(t, "open, wide", &x);
    }
    // As shallow as may be, and deeper than was found.
    x = *r;
    for (double by = 1e-9; by < 10; by *= 30) {
        x.upper = r->upper - by * scale;
        x.lower = fmin(r->lower, x.upper);
        forge(t, "deeper", &x);
        x = *r;
        x.lower = r->lower + by * scale;
        x.upper = fmax(x.lower, r->upper);
        forge(t, "farther", &x);
        x = *r;
    }
}

// ---- cases

typedef struct sample {
    mesh a, b;
    int is_open_a, is_open_b;
} sample;

static void open_mesh(mesh *m, int *is_open) {
    if (m->triangles > 6) m->triangles -= 2, *is_open = 1;
}

static void make_meshes(sample *x, int kind, uint64_t *s) {
    if (kind % 3 == 0) {
        cubes a = cubes_make(s), b = kind % 2 ? a : cubes_make(s);
        mesh_add_cubes(&x->a, &a, 1);
        mesh_add_cubes(&x->b, &b, 1);
    } else if (kind == 1 || kind == 4) {
        // The one may be within the other.
        mesh_add_star(&x->a, (ovoid_vec3){0, 0, 0}, 1, 4, 6, 0.2, s);
        mesh_add_star(&x->b, (ovoid_vec3){0, 0, 0}, 0.1, 3, 4, 0.3, s);
    } else {
        mesh_add_random(&x->a, 1, s);
        mesh_add_random(&x->b, random_uniform(s, 0.3, 1), s);
    }
    double thin = kind == 5 ? 1e-3 : 1;
    for (size_t i = 0; i < x->a.points; i++) x->a.xyz[3 * i + 2] *= thin;
    if (kind == 7) open_mesh(&x->a, &x->is_open_a);
    if (kind == 8 || kind == 9) open_mesh(&x->b, &x->is_open_b);
}

static ovoid_pose make_pose(int kind, double scale, uint64_t *s) {
    ovoid_vec3 at = random_vec3(s, kind == 1 || kind == 4 ? 0.3 : 2);
    if (kind % 3) return (ovoid_pose){{scale * at.x, scale * at.y, scale * at.z}, random_quat(s)};
    return (ovoid_pose){{scale * rint(at.x), scale * rint(at.y), scale * rint(at.z)}, {1, 0, 0, 0}};
}

// The second body: its solid, or its hull, alone or with its copy as a compound.
static void set_second(truth *t, mesh *m, int kind, ovoid_shape **shape, ovoid_compound **compound) {
    if (kind != 10 && kind != 11) return;
    *shape = ovoid_shape_create_from_points(m->xyz, m->points, NULL, NULL);
    ovoid_polytope p = ovoid_shape_get_polytope(*shape);
    mesh hull = {NULL, NULL, 0, 0, 0, 0};
    for (uint32_t k = 0; k < p.vertex_count; k++) {
        const double *v = p.vertices + 3 * (size_t)k;
        mesh_add_point(&hull, v[0] + p.origin.x, v[1] + p.origin.y, v[2] + p.origin.z);
    }
    for (uint32_t k = 0; k < p.triangle_count; k++)
        mesh_add_triangle(&hull, p.triangles[3 * k], p.triangles[3 * k + 1], p.triangles[3 * k + 2]);
    mesh_clear(m);
    *m = hull;
    t->count_b = 1;
    const ovoid_posed_shape parts[2] = {{*shape, {{0, 0, 0}, {1, 0, 0, 0}}}, {*shape, {{0, 0, 0}, {1, 0, 0, 0}}}};
    if (kind == 11) *compound = ovoid_compound_create(parts, 2, NULL, NULL), t->has_compound = 1, t->count_b = 2;
}

static ovoid_body_answer ask(const truth *t, int query, ovoid_exclusions *all) {
    double margin = 0.5 * fmax(t->brute.surfaces, 0);
    return query == 0   ? ovoid_body_distance(&t->pair, NULL, &(ovoid_body_evidence){.exclusions = all})
           : query == 1 ? ovoid_body_collide(&t->pair, NULL, &(ovoid_body_evidence){.exclusions = all})
                        : ovoid_body_within(&t->pair, margin, NULL, &(ovoid_body_evidence){.exclusions = all});
}

static void try_answer(truth *t, int query, double scale, uint64_t *s) {
    static ovoid_body_answer other;
    ovoid_error error;
    t->all = (ovoid_exclusions){.items = items, .capacity = CAPACITY};
    t->right = ask(t, query, &t->all);
    if (t->all.count > t->all.capacity) return;
    if (!CHECK_EQ(ovoid_body_verify(&t->pair, &t->right, &(ovoid_body_basis){.exclusions = &t->all}, &error), OVOID_OK))
        printf("  %s\n", error.message);
    CHECK(!is_false(t, &t->right, &t->all));
    lie_about(t, &other, scale);
    lie_about_exclusions(t, scale);
    forge_all(t, scale, s);
    other = t->right;
}

static void try_case(uint64_t seed) {
    uint64_t s = check_seed = seed;
    int kind = (int)(seed % KINDS);
    double scale = seed % 5 == 4 ? pow(10, random_uniform(&s, -9, 9)) : 1;
    sample x = {.is_open_a = 0};
    make_meshes(&x, kind, &s);
    truth t = {.has_compound = 0};
    ovoid_shape *shape = NULL;
    ovoid_compound *compound = NULL;
    for (size_t i = 0; i < 3 * x.a.points; i++) x.a.xyz[i] *= scale;
    for (size_t i = 0; i < 3 * x.b.points; i++) x.b.xyz[i] *= scale;
    set_second(&t, &x.b, kind, &shape, &compound);
    ovoid_solid *a = mesh_make_solid(&x.a), *b = shape ? NULL : mesh_make_solid(&x.b);
    if (CHECK(a && (b || shape))) {
        t.count_a = (uint32_t)x.a.triangles;
        if (b) t.count_b = (uint32_t)x.b.triangles;
        t.pair = (ovoid_body_pair){{.solid = a, .pose = make_pose(kind, scale, &s)},
                                   {.solid = b, .shape = compound ? NULL : shape, .compound = compound}};
        t.pair.b.pose = make_pose(kind, scale, &s);
        t.brute = find_truth_of(&x.a, &t.pair.a.pose, x.is_open_a, &x.b, &t.pair.b.pose, x.is_open_b);
        t.slack = 1e-13 * 8 * scale;
        try_answer(&t, (int)(random_next(&s) % 3), scale, &s);
    }
    ovoid_solid_destroy(a);
    ovoid_solid_destroy(b);
    ovoid_compound_destroy(compound);
    ovoid_shape_destroy(shape);
    mesh_clear(&x.a);
    mesh_clear(&x.b);
}

int main(int count, char **arguments) {
    uint64_t first = 1, cases = 48;
    const test_option options[] = {{"seed", "of the first case (1)", &first, NULL, NULL, NULL},
                                   {"cases", "how many (48)", &cases, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    court = judge_create();
    for (uint64_t seed = first; court && seed < first + cases; seed++) try_case(seed);
    check_seed = 0;
    judge_destroy(court);
    alter_print_table(&table);
    for (int i = 0; i < ITEM_FIELDS; i++) alter_print(item_fields[i].name, &item_counts[i]);
    alter_print("exclusions", &list_count);
    alter_print("forged", &forged_count);
    return check_end();
}
