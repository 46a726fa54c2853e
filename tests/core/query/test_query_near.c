// Bodies within rounding of touching, whose vertices lie 1e-15 apart, whose meshes have a seam, or far from the origin,
// asked with earlier proofs: their own, another pair's, damaged ones. Truth: the query without a proof, of which no
// proof may lose a sign or a narrow bracket; and the checker. The same of batches, worlds and compounds.
#include "check.h"
#include "options.h"
#include "ovoid/ovoid.h"
#include "proofs/covers.h"

enum { PAIRS = 3000, KINDS = 4, VERTICES = 40 };

static const double margin = 0.1;

/// A point or two at each of a few places of the unit sphere.
static ovoid_shape *make_rock(uint64_t *s, int doubled) {
    double xyz[3 * VERTICES];
    size_t places = 4 + random_next(s) % 7, count = 0;
    for (size_t i = 0; i < places; i++) {
        double p[3] = {random_normal(s), random_normal(s), random_normal(s)}, length = hypot(hypot(p[0], p[1]), p[2]);
        for (int copy = 0; copy <= doubled; copy++)
            for (int k = 0; k < 3; k++) xyz[count++] = p[k] / length + (copy ? 1e-15 * random_normal(s) : 0);
    }
    return ovoid_shape_create_from_points(xyz, count / 3, NULL, NULL);
}

/// Two rings whose last points are the first ones, but for the rounding of 2 pi.
static ovoid_shape *make_tube(uint64_t *s) {
    double xyz[3 * VERTICES], radius = random_uniform(s, 0.2, 1.2), half = random_uniform(s, 0.2, 1.2);
    int sides = 3 + (int)(random_next(s) % 10), count = 0;
    for (int i = 0; i <= sides; i++)
        for (int end = 0; end < 2; end++) {
            double angle = 2 * 3.14159265358979323846 * i / sides, r = end ? radius : 1;
            xyz[count++] = r * cos(angle);
            xyz[count++] = r * sin(angle);
            xyz[count++] = end ? half : -half;
        }
    return ovoid_shape_create_from_points(xyz, (size_t)count / 3, NULL, NULL);
}

static ovoid_pose random_pose(uint64_t *s, double far) {
    ovoid_vec3 at = {far + 3 * random_normal(s), far + 3 * random_normal(s), far + 3 * random_normal(s)};
    return (ovoid_pose){at, {random_normal(s), random_normal(s), random_normal(s), random_normal(s)}};
}

/// Kinds: doubled vertices, seams, both 1e6 from the origin, one in another.
static ovoid_pair make_pair(uint64_t *s, int kind) {
    ovoid_shape *a = kind == 1 ? make_tube(s) : make_rock(s, kind != 3),
                *b = kind == 1 || kind == 3 ? make_tube(s) : make_rock(s, 1);
    double far = kind == 2 ? 1e6 : 0;
    ovoid_pair p = {a, b, random_pose(s, far), random_pose(s, far)};
    if (!a || !b) return p;
    double depth = kind == 3 ? random_uniform(s, 0, 0.5) : 0;
    for (int round = 0; round < 2; round++) {
        ovoid_answer x = ovoid_depth(&p, NULL, NULL, NULL);
        double by = 0.5 * (x.lower + x.upper) + depth;
        p.pose_b.position.x -= by * x.normal.x;
        p.pose_b.position.y -= by * x.normal.y;
        p.pose_b.position.z -= by * x.normal.z;
    }
    return p;
}

static ovoid_answer ask(int query, const ovoid_pair *p, const ovoid_proof *earlier, ovoid_cover *cover) {
    switch (query) {
    case 0: return ovoid_collide(p, NULL, earlier);
    case 1: return ovoid_within(p, margin, NULL, earlier);
    case 2: return ovoid_distance(p, NULL, earlier);
    default: return ovoid_depth(p, NULL, earlier, cover);
    }
}

/// 1 if a limit kept the bracket wide.
static int is_stuck(const ovoid_answer *x) {
    return x->limit == OVOID_LIMIT_PRECISION || x->limit == OVOID_LIMIT_CAPACITY || x->limit == OVOID_LIMIT_ITERATIONS;
}

static long asked, decided_by_proof;

static void compare(int query, const ovoid_pair *p, const ovoid_proof *earlier, const ovoid_answer *cold) {
    STATIC_COVER(cover);
    ovoid_answer warm = ask(query, p, earlier, &cover);
    ovoid_error error = {0};
    asked++;
    if (cold->status != OVOID_UNDECIDED)
        CHECK_EQ(warm.status, cold->status);
    else
        decided_by_proof += warm.status != OVOID_UNDECIDED;
    CHECK(is_stuck(cold) || !is_stuck(&warm));
    CHECK(warm.lower <= cold->upper && cold->lower <= warm.upper);
    if (!CHECK(ovoid_answer_verify(p, &warm, &(ovoid_answer_basis){.cover = query == 3 ? &cover : NULL}, &error) ==
               OVOID_OK))
        puts(error.message);
}

static ovoid_proof damage(const ovoid_proof *of, uint64_t *s) {
    ovoid_proof p = *of;
    switch (random_next(s) % 6) {
    case 0: p.count = (uint32_t)(random_next(s) % (OVOID_PROOF_PAIRS + 2)); break;
    case 1: p.a[random_next(s) % 4] = (uint32_t)(random_next(s) % 12); break;
    case 2: p.normal = (ovoid_vec3){-p.normal.x, p.normal.y, p.normal.z}; break;
    case 3: p.kind = (ovoid_proof_kind)(random_next(s) % 6); break;
    case 4: p.normal_low = (ovoid_vec3){1e-17, 0, 1e-9}; break;
    default: ((unsigned char *)&p)[random_next(s) % sizeof p] ^= (unsigned char)(1 + random_next(s) % 255); break;
    }
    return p;
}

/// The couple in a batch with its proof, among seven that have none: all have the sign of the single query, and as
/// narrow a bracket that has a point in common with the other.
static void check_batch(const ovoid_pair *p, const ovoid_proof *earlier) {
    const ovoid_posed_shape bodies[2] = {{p->shape_a, p->pose_a}, {p->shape_b, p->pose_b}};
    const ovoid_couple couples[8] = {{0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}, {0, 1}};
    ovoid_proof proofs[8] = {{.count = 0}};
    ovoid_answer answers[8];
    proofs[3] = *earlier;
    ovoid_batch batch = {
        .bodies = bodies, .body_count = 2, .couples = couples, .couple_count = 8, .proofs = proofs, .answers = answers};
    ovoid_answer cold = ovoid_distance(p, NULL, NULL), warm = ovoid_distance(p, NULL, earlier);
    CHECK_EQ(ovoid_distance_batch(&batch, NULL), OVOID_OK);
    for (int i = 0; i < 8; i++) {
        const ovoid_answer *alone = i == 3 ? &warm : &cold;
        CHECK(answers[i].status == alone->status && answers[i].limit == alone->limit);
        CHECK(answers[i].lower <= alone->upper && alone->lower <= answers[i].upper);
        CHECK_EQ(ovoid_answer_verify(p, &answers[i], NULL, NULL), OVOID_OK);
    }
}

/// A world answers in lanes, in another order of steps: the brackets have a point in common, and the signs agree,
/// unless both brackets are within some roundings of zero, where each may or may not reach it.
static void check_verdict(const ovoid_verdict *verdict, const ovoid_answer *alone) {
    CHECK(verdict->lower <= alone->upper && alone->lower <= verdict->upper);
    double most = 0x1p-48;
    int is_near = fmax(fabs(verdict->lower), fabs(verdict->upper)) <= most &&
                  fmax(fabs(alone->lower), fabs(alone->upper)) <= most;
    if (!is_near) CHECK_EQ(verdict->status, alone->status);
}

static void check_world(const ovoid_pair *p, uint64_t *s) {
    static const ovoid_query_kind kinds[] = {OVOID_QUERY_COLLIDE, OVOID_QUERY_WITHIN, OVOID_QUERY_DISTANCE,
                                             OVOID_QUERY_DEPTH};
    int query = (int)(random_next(s) % 4);
    ovoid_pair now = *p;
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_world_body a = {.body = {.shape = p->shape_a, .pose = p->pose_a}},
                     b = {.body = {.shape = p->shape_b, .pose = p->pose_b}};
    ovoid_id ids[2] = {ovoid_world_add(w, &a, NULL), ovoid_world_add(w, &b, NULL)};
    ovoid_contact_query q = {kinds[query], query ? margin : 0, NULL};
    for (int step = 0; step < 4; step++) {
        ovoid_contacts found;
        if (!CHECK(ovoid_world_compute_contacts(w, &q, &found, NULL) == OVOID_OK)) break;
        ovoid_answer alone = ask(query, &now, NULL, NULL);
        if (found.count && alone.status != OVOID_UNDECIDED) check_verdict(&found.items[0].verdict, &alone);
        now.pose_b.position.x += 1e-16 * random_normal(s);
        CHECK_EQ(ovoid_world_move(w, ids[1], &now.pose_b, NULL), OVOID_OK);
    }
    ovoid_world_destroy(w);
}

/// Both as compounds of one part and another far away.
static void check_compounds(const ovoid_pair *p, const ovoid_proof *foreign) {
    ovoid_posed_shape a[2] = {{p->shape_a, ovoid_pose_make_identity()}, {p->shape_a, {{30, 0, 0}, {1, 0, 0, 0}}}};
    ovoid_posed_shape b[2] = {{p->shape_b, ovoid_pose_make_identity()}, {p->shape_b, {{0, 0, 30}, {1, 0, 0, 0}}}};
    ovoid_compound *ca = ovoid_compound_create(a, 2, NULL, NULL), *cb = ovoid_compound_create(b, 2, NULL, NULL);
    static ovoid_exclusion items[64];
    STATIC_COVER(cover);
    ovoid_exclusions all = {.items = items, .capacity = 64, .cover = &cover};
    ovoid_body_pair pair = {{.compound = ca, .pose = p->pose_a}, {.compound = cb, .pose = p->pose_b}};
    ovoid_body_answer cold = ovoid_body_depth(&pair, NULL, NULL);
    for (int i = 0; i < 2; i++) {
        ovoid_body_proof earlier = {cold.part_a, cold.part_b, i ? *foreign : cold.deciding.proof};
        ovoid_body_answer warm =
            ovoid_body_depth(&pair, NULL, &(ovoid_body_evidence){.earlier = &earlier, .exclusions = &all});
        if (cold.status != OVOID_UNDECIDED) CHECK_EQ(warm.status, cold.status);
        CHECK(is_stuck(&cold.deciding) || !is_stuck(&warm.deciding));
        CHECK_EQ(ovoid_body_verify(&pair, &warm, &(ovoid_body_basis){.exclusions = &all}, NULL), OVOID_OK);
    }
    ovoid_compound_destroy(ca);
    ovoid_compound_destroy(cb);
}

static void check_pair(uint64_t *s, int kind, ovoid_proof foreign[4]) {
    STATIC_COVER(cover);
    ovoid_pair p = make_pair(s, kind);
    if (!CHECK(p.shape_a && p.shape_b)) return;
    for (int query = 0; query < 4; query++) {
        ovoid_answer cold = ask(query, &p, NULL, &cover);
        ovoid_proof own = cold.proof, other = foreign[random_next(s) % 4], damaged = damage(&own, s);
        compare(query, &p, &own, &cold);
        compare(query, &p, &other, &cold);
        compare(query, &p, &damaged, &cold);
        foreign[query] = own;
    }
    check_batch(&p, &foreign[random_next(s) % 4]);
    check_world(&p, s);
    check_compounds(&p, &foreign[0]);
    ovoid_shape_destroy((ovoid_shape *)p.shape_a);
    ovoid_shape_destroy((ovoid_shape *)p.shape_b);
}

/// Rocks that touch along slivers: the last simplex of a search with a cap leaves an upper bound of 1e-3 of the size.
static void check_slivers(void) {
    static const double of_a[] = {
        0x1.c71dbbf01e85fp-3,  -0x1.5a282b466f717p-1, -0x1.67af82de5b387p-1, 0x1.c71dbbf01e861p-3,
        -0x1.5a282b466f718p-1, -0x1.67af82de5b392p-1, -0x1.7c2de35edc116p-1, 0x1.1f9ccb54cc21ap-2,
        -0x1.3754f24078abep-1, -0x1.7c2de35edc119p-1, 0x1.1f9ccb54cc205p-2,  -0x1.3754f24078ac7p-1,
        0x1.ef013f46b4e3bp-1,  0x1.30478205d4671p-3,  -0x1.a9b957dc1a9ecp-3, 0x1.ef013f46b4e36p-1,
        0x1.30478205d4663p-3,  -0x1.a9b957dc1a9ddp-3, -0x1.b5c712090362bp-3, -0x1.7f080c327a4bbp-1,
        -0x1.41a40f3ce1d84p-1, -0x1.80da76b1c29c5p-1, -0x1.29697cb12468cp-1, -0x1.3fdcb590b625bp-2,
        -0x1.80da76b1c29bcp-1, -0x1.29697cb12468bp-1, -0x1.3fdcb590b625p-2,  0x1.16c973dd48a87p-1,
        -0x1.2ec3bba64c423p-2, -0x1.91e08da657562p-1, -0x1.8c292ba2b393dp-4, 0x1.f40995b58af74p-1,
        -0x1.89068a0d75a8bp-3, -0x1.8c292ba2b3953p-4, 0x1.f40995b58af6ap-1,  -0x1.89068a0d75a88p-3};
    static const double of_b[] = {
        -0x1.0ee8423690db6p-1, 0x1.3f83be368193dp-1,  -0x1.26630db06666cp-1, -0x1.0ee8423690dbap-1,
        0x1.3f83be3681949p-1,  -0x1.26630db066658p-1, 0x1.11771d3e79769p-2,  0x1.90108634ed6c7p-2,
        -0x1.c309ba0f04a53p-1, 0x1.11771d3e7975p-2,   0x1.90108634ed6e5p-2,  -0x1.c309ba0f04a54p-1,
        -0x1.4a23dc48f8104p-5, 0x1.6b6a3ec06cdbcp-1,  0x1.6810fbdb55119p-1,  -0x1.4a23dc48f80a6p-5,
        0x1.6b6a3ec06cdb7p-1,  0x1.6810fbdb55118p-1,  0x1.d30b43dd6db24p-1,  -0x1.0eecbdd473ebap-7,
        -0x1.a3811e11f365cp-2, 0x1.d30b43dd6db16p-1,  -0x1.0eecbdd4740ap-7,  -0x1.a3811e11f365ep-2};
    ovoid_shape *a = ovoid_shape_create_from_points(of_a, sizeof of_a / sizeof of_a[0] / 3, NULL, NULL),
                *b = ovoid_shape_create_from_points(of_b, sizeof of_b / sizeof of_b[0] / 3, NULL, NULL);
    const ovoid_pair p = {a,
                          b,
                          {{-0x1.d810ee9fccc02p+0, -0x1.378c1527ba562p+1, -0x1.95d689132efa9p+1},
                           {-0x1.51f4ceffa3dd6p+0, 0x1.02d7fa3a48b79p-1, 0x1.6fa14e669a934p-1, 0x1.22974c66c3d2dp-3}},
                          {{-0x1.e1a2f89637a17p-1, -0x1.a6cf18fdf966dp+0, -0x1.45f0f7e8b7229p+1},
                           {0x1.7a7f29af2da79p-6, 0x1.54e50b7ee0e45p+0, -0x1.a16c6722f659ep+0, 0x1.85df82a3d64ccp-1}}};
    const ovoid_options capped = {.cap = margin};
    ovoid_answer x = ovoid_distance(&p, &capped, NULL);
    CHECK(x.status != OVOID_UNDECIDED);
    CHECK_EQ(ovoid_collide(&p, NULL, NULL).status, x.status);
    CHECK(x.upper - x.lower < 1e-15);
    CHECK_EQ(ovoid_answer_verify(&p, &x, &(ovoid_answer_basis){.options = &capped}, NULL), OVOID_OK);
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
}

/// Calls of one iteration that go on from one another: none loses a sign that the query alone has with as few. (Which
/// of the brackets is narrower is open: one iteration from a good simplex may lead to a worse one.)
static void check_few_iterations(uint64_t *s) {
    ovoid_shape *a = make_rock(s, 0), *b = make_tube(s);
    ovoid_pair p = {a, b, random_pose(s, 0), random_pose(s, 0)};
    const ovoid_options few = {.iterations = 1};
    ovoid_answer cold = ovoid_distance(&p, &few, NULL), x = cold;
    for (int i = 0; i < 30 && x.limit == OVOID_LIMIT_ITERATIONS; i++) {
        x = ovoid_distance(&p, &few, &x.proof);
        CHECK(x.status == cold.status || cold.status == OVOID_UNDECIDED);
        CHECK_EQ(ovoid_answer_verify(&p, &x, &(ovoid_answer_basis){.options = &few}, NULL), OVOID_OK);
    }
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
}

/// Cubes of any size, and skewed ones, on one another: a depth decides what a yes or no decides, in batches too.
static void check_sizes(uint64_t *s) {
    for (int exponent = 40; exponent >= -124; exponent--)
        for (int turned = 0; turned < 6; turned++) {
            double half = 0.5 * pow(10, exponent);
            double xyz[24];
            for (int i = 0; i < 24; i++) xyz[i] = (i / 3 >> i % 3 & 1 ? 1 : -1) * half * (1 + 0.03 * turned * (i % 5));
            ovoid_shape *cube = ovoid_shape_create_from_points(xyz, 8, NULL, NULL);
            if (!CHECK(cube != NULL)) return;
            ovoid_pair p = {cube, cube, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
            p.pose_b.position.x = (turned % 3) * 0.4 * half;
            if (turned > 2) p.pose_b.rotation = random_pose(s, 0).rotation;
            STATIC_COVER(cover);
            ovoid_answer deep = ovoid_depth(&p, NULL, NULL, &cover), sign = ovoid_collide(&p, NULL, NULL);
            CHECK_EQ(sign.status, OVOID_OVERLAPPING);
            CHECK_EQ(deep.status, OVOID_OVERLAPPING);
            CHECK_EQ(ovoid_answer_verify(&p, &deep, &(ovoid_answer_basis){.cover = &cover}, NULL), OVOID_OK);
            const ovoid_posed_shape bodies[2] = {{cube, p.pose_a}, {cube, p.pose_b}};
            ovoid_couple couple = {0, 1};
            ovoid_answer batched;
            ovoid_batch batch = {
                .bodies = bodies, .body_count = 2, .couples = &couple, .couple_count = 1, .answers = &batched};
            CHECK_EQ(ovoid_depth_batch(&batch, NULL), OVOID_OK);
            CHECK(batched.lower == deep.lower && batched.upper == deep.upper);
            ovoid_shape_destroy(cube);
        }
}

int main(int count, char **arguments) {
    uint64_t pairs = PAIRS, s = 20261123;
    const test_option options[] = {{.name = "pairs", .help = "pairs, four queries each", .whole = &pairs},
                                   {.name = "seed", .help = "another sequence of pairs", .whole = &s},
                                   {.name = NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    ovoid_proof foreign[4] = {{.count = 0}};
    for (uint64_t i = 0; i < pairs; i++) check_pair(&s, (int)(i % KINDS), foreign);
    for (int i = 0; i < 200; i++) check_few_iterations(&s);
    check_slivers();
    check_sizes(&s);
    printf("%ld warm queries; %ld of them decided what the query alone does not\n", asked, decided_by_proof);
    return check_end();
}
