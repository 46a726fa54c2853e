// A liar: true contacts whose fields are altered one at a time. Each alteration must be refused by the verifier, or be
// true by manifolds.h, which does not use the proof; the polygon's corners and share are compared with those before.
#include "alter.h"
#include "manifolds.h"
#include "places.h"
#include "proofs/covers.h"

#define VEC3(member)                                                                                                   \
    ALTER_FIELD(ovoid_manifold, member.x, ALTER_REAL, 1e-9), ALTER_FIELD(ovoid_manifold, member.y, ALTER_REAL, 1e-9),  \
        ALTER_FIELD(ovoid_manifold, member.z, ALTER_REAL, 1e-9)

static const alter_field fields[] = {ALTER_FIELD(ovoid_manifold, status, ALTER_INT, 0),
                                     ALTER_FIELD(ovoid_manifold, limit, ALTER_INT, 0),
                                     ALTER_FIELD(ovoid_manifold, lower, ALTER_REAL, 1e-9),
                                     ALTER_FIELD(ovoid_manifold, upper, ALTER_REAL, 1e-9),
                                     VEC3(normal),
                                     ALTER_FIELD(ovoid_manifold, id[0], ALTER_U32, 0),
                                     ALTER_FIELD(ovoid_manifold, id[1], ALTER_U32, 0),
                                     ALTER_FIELD(ovoid_manifold, id[2], ALTER_U32, 0),
                                     ALTER_FIELD(ovoid_manifold, id[3], ALTER_U32, 0),
                                     ALTER_FIELD(ovoid_manifold, feature_a, ALTER_U32, 0),
                                     ALTER_FIELD(ovoid_manifold, feature_b, ALTER_U32, 0),
                                     ALTER_FIELD(ovoid_manifold, facet_a, ALTER_U32, 0),
                                     ALTER_FIELD(ovoid_manifold, facet_b, ALTER_U32, 0),
                                     ALTER_FIELD(ovoid_manifold, axis, ALTER_INT, 0)};
enum { FIELDS = sizeof fields / sizeof *fields };
static alter_count counts[FIELDS];
static const alter_table table = {fields, FIELDS, counts};
static alter_count of_bytes, of_share, of_mixed;

// 1 if the altered contact claims something false.
static int is_lie(const asked_manifold *q, const ovoid_manifold *right) {
    const ovoid_manifold *m = &q->manifold;
    if (find_lie(q)) return 1;
    // Corners and share of a polygon with kept corners depend on the contact before.
    if (q->options.keep > 0) return 0;
    if (m->axis != right->axis || m->facet_a != right->facet_a || m->facet_b != right->facet_b) return 0;
    return m->corners != right->corners || m->count != right->count || fabs((double)(m->share - right->share)) > 1e-4;
}

static void take(alter_count *count, const asked_manifold *q, const ovoid_manifold *right) {
    int is_refused = ovoid_manifold_verify(&q->pair, &q->manifold, &q->options, NULL) != OVOID_OK;
    alter_take(count, !is_refused && is_lie(q, right), is_refused);
}

// Small numbers and parts of another contact.
static void alter_rest(asked_manifold *q, const ovoid_manifold *other) {
    const ovoid_manifold right = q->manifold;
    alter_name = "count, proof, corners";
    for (int k = 0; k < 6; k++)
        for (int which = 0; which < 3; which++) {
            q->manifold = right;
            if (which == 0) q->manifold.count = (uint8_t)k;
            if (which == 1) q->manifold.proof = (uint8_t)k;
            if (which == 2) q->manifold.corners = (uint16_t)(right.corners + k - 3);
            if (memcmp(&q->manifold, &right, sizeof right)) take(&of_bytes, q, &right);
        }
    static const float shares[] = {0, -1, 2, 0.5F, 1, 0.99F, INFINITY, NAN};
    alter_name = "share";
    for (size_t k = 0; k < sizeof shares / sizeof *shares; k++) {
        q->manifold = right;
        q->manifold.share = shares[k];
        if (memcmp(&q->manifold.share, &right.share, sizeof right.share)) take(&of_share, q, &right);
    }
    alter_name = "parts of another";
    for (int which = 0; which < 4; which++) {
        q->manifold = right;
        if (which == 0) q->manifold.normal = other->normal;
        if (which == 1)
            q->manifold.lower = other->lower, q->manifold.upper = other->upper, q->manifold.status = other->status;
        if (which == 2) memcpy(q->manifold.id, other->id, sizeof other->id);
        if (which == 3) q->manifold = ovoid_manifold_make_swapped(&right);
        if (memcmp(&q->manifold, &right, sizeof right)) take(&of_mixed, q, &right);
    }
    q->manifold = right;
}

static ovoid_shape *create(int kind, uint64_t *s) {
    double xyz[3 * 20];
    ovoid_error error;
    ovoid_shape_options round = {.radius = 0.1};
    if (kind == 0) return ovoid_shape_create_box((ovoid_vec3){1, 0.8, 0.6}, NULL, &error);
    if (kind == 1) return ovoid_shape_create_box((ovoid_vec3){1, 0.8, 0.6}, &round, &error);
    if (kind == 2) return ovoid_shape_create_prism(&(ovoid_prism){1, 0.5, 12}, NULL, &error);
    for (int i = 0; i < 20; i++) {
        vec3 p = vec3_unit((vec3){random_normal(s), random_normal(s), random_normal(s)});
        for (int k = 0; k < 3; k++) xyz[3 * i + k] = (&p.x)[k];
    }
    return ovoid_shape_create_from_points(xyz, 20, NULL, &error);
}

static void place(ovoid_pair *pair, double want, uint64_t *s) {
    vec3 d = vec3_unit((vec3){0.2 * random_normal(s), 0.2 * random_normal(s), 1});
    double near = 0, far = 6;
    for (int k = 0; k < 40; k++) {
        pair->pose_b.position = vec3_scale(d, (near + far) / 2);
        if (ovoid_depth(pair, NULL, NULL, NULL).lower > want)
            far = (near + far) / 2;
        else
            near = (near + far) / 2;
    }
}

int main(void) {
    STATIC_COVER(cover);
    ovoid_manifold other = {0};
    for (uint64_t seed = 1; seed <= 400; seed++) {
        uint64_t s = check_seed = seed;
        int kind = (int)(seed % 4), is_face = seed % 8 < 4;
        ovoid_shape *a = create(kind, &s), *b = create((int)(seed / 8) % 4, &s);
        ovoid_pair pair = {a, b, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
        pair.pose_b.rotation = is_face ? (ovoid_quat){1, 0, 0, random_normal(&s)} : random_quat(&s);
        place(&pair, random_uniform(&s, -0.05, 0.03), &s);
        ovoid_manifold_options o = {.margin = 0.02, .keep = seed % 3 ? 0 : 0.005, .cover = &cover};
        asked_manifold q = ask_manifold(&pair, &o, NULL);
        check_manifold(&q);
        const ovoid_manifold right = q.manifold;
        alter_walk walk = alter_walk_make(&table, &q.manifold, sizeof q.manifold, seed > 1 ? &other : NULL);
        for (alter_count *count; (count = alter_next(&walk)) != NULL;) take(count, &q, &right);
        if (right.count) alter_rest(&q, seed > 1 ? &other : &right);
        other = right;
        ovoid_shape_destroy(a);
        ovoid_shape_destroy(b);
    }
    check_seed = 0;
    alter_print_table(&table);
    alter_print("count, proof, corners", &of_bytes);
    alter_print("share", &of_share);
    alter_print("parts of another", &of_mixed);
    return check_end();
}
