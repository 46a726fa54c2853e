// The depth that features prove, demanded up to a least one. Truth: the same proof without a demand, which measures
// every side. What a demand ends early must be below its least depth; from there on the depth has the same bits.
#include "check.h"
#include "manifold/manifold.h"
#include "manifolds.h"
#include "places.h"

static ovoid_shape *create(int kind, uint64_t *s) {
    const ovoid_vec3 half = {random_uniform(s, 0.3, 3), random_uniform(s, 0.3, 3), random_uniform(s, 0.2, 0.6)};
    if (kind == 0) return ovoid_shape_create_box(half, NULL, NULL);
    if (kind == 1)
        return ovoid_shape_create_prism(&(ovoid_prism){.sides = 7, .radius = half.x, .half_length = half.z}, NULL,
                                        NULL);
    double xyz[3 * 12];
    for (int i = 0; i < 12; i++) {
        vec3 p = vec3_unit((vec3){random_normal(s), random_normal(s), random_normal(s)});
        xyz[3 * i] = half.x * p.x;
        xyz[3 * i + 1] = half.y * p.y;
        xyz[3 * i + 2] = half.z * p.z;
    }
    return ovoid_shape_create_from_points(xyz, 12, NULL, NULL);
}

// A contact's features with the polygon's tables, as the verifier makes them.
typedef struct opened {
    pair_frame frame;
    manifold_state state;
    manifold_axis axis;
} opened;

static int open_contact(const ovoid_pair *pair, opened *to) {
    ovoid_manifold m = ovoid_manifold_find(pair, NULL, NULL);
    ordered_pair o = ordered_pair_make(pair, &m);
    manifold_terms terms;
    if (frame_make(&o.pair, &to->frame) != OVOID_LIMIT_NONE || !manifold_terms_make(NULL, &to->frame, &terms)) return 0;
    if (!manifold_open(&to->frame, &o.manifold, &to->state) || !(to->state.frame.gap < 0)) return 0;
    to->axis = (manifold_axis){o.manifold.axis, o.manifold.feature_a, o.manifold.feature_b};
    manifold_clip(&terms, &to->axis, &o.manifold, &to->state);
    return 1;
}

static double prove(const opened *c, double least) {
    return manifold_prove_depth(&c->state, &c->axis, &(depth_demand){least, INFINITY});
}

// How many proofs of each axis a demand kept, and how many it ended.
typedef struct tally {
    int kept, ended;
} tally;

static void check_demands(const opened *c, tally *of_axis) {
    double all = prove(c, -INFINITY), gap = -c->state.frame.gap;
    const double least[] = {0.2 * gap, 0.5 * gap, 0.8 * gap, gap, (1 - 1e-6) * all, all, (1 + 1e-6) * all};
    for (size_t i = 0; i < sizeof least / sizeof *least; i++) {
        if (!(least[i] > 0)) continue;
        double found = prove(c, least[i]);
        if (all >= least[i]) {
            CHECK(found == all);
            of_axis->kept++;
        } else {
            CHECK(found < least[i]);
            of_axis->ended++;
        }
    }
    // Enough is enough, whatever the other features prove.
    double enough = manifold_prove_depth(&c->state, &c->axis, &(depth_demand){-INFINITY, 0.5 * gap});
    CHECK(all >= 0.5 * gap ? enough >= 0.5 * gap && enough <= all : enough == all);
}

int main(void) {
    tally of_axis[OVOID_MANIFOLD_FREE + 1] = {{0, 0}};
    static opened contact;
    for (uint64_t seed = 1; seed <= 3000; seed++) {
        uint64_t s = check_seed = seed;
        ovoid_shape *a = create((int)(seed % 3), &s), *b = create((int)(seed / 3 % 3), &s);
        ovoid_pair pair = {a, b, {{0, 0, 0}, random_quat(&s)}, {{0, 0, 0}, random_quat(&s)}};
        place_at_distance(&pair, -0.3 * pow(10, -random_uniform(&s, 0, 3)), 12, &s);
        if (open_contact(&pair, &contact)) check_demands(&contact, of_axis + contact.axis.kind);
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    check_seed = 0;
    // Facets and edges both prove depths, and fail to.
    for (int axis = OVOID_MANIFOLD_FACE_A; axis <= OVOID_MANIFOLD_EDGES; axis++) {
        CHECK_LE(100, of_axis[axis].kept);
        CHECK_LE(100, of_axis[axis].ended);
    }
    return check_end();
}
