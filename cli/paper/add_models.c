// Chart 0: vertices, faces, faces after splitting; a picture of each family.
#include "paper/experiment.h"

/// The least and the largest of a family.
typedef struct span {
    uint32_t low, high;
} span;

static void take(span *s, uint32_t value) {
    if (!s->high || value < s->low) s->low = value;
    if (value > s->high) s->high = value;
}

static void add_pictures(const experiment *e) {
    static const ovoid_vec3 view = {1, -1.6, 0.9};
    const int shown[FAMILY_COUNT] = {0, 4, 1 + MODELS_EACH + 4, 1 + 2 * MODELS_EACH + 9};
    ovoid_picture_body bodies[FAMILY_COUNT];
    for (int i = 0; i < FAMILY_COUNT; i++)
        bodies[i] = (ovoid_picture_body){e->models[shown[i]].name,
                                         e->models[shown[i]].shape,
                                         {{2.6 * i * 0.85, 2.6 * i * 0.53, 0}, {1, 0, 0, 0}},
                                         0,
                                         NULL,
                                         0};
    const ovoid_picture picture = {bodies, FAMILY_COUNT, NULL, 0, NULL, NULL};
    const ovoid_picture_options options = {1000, 420, view,
                                           OVOID_PICTURE_AREAS | OVOID_PICTURE_INNER | OVOID_PICTURE_NAMES};
    report_add_picture(
        e->report, "models", &picture, &options,
        "One of each family: the enclosed ellipsoid and the eight areas that its axes cut the faces into.");
}

void experiment_add_models(const experiment *e) {
    static const char *const paper[FAMILY_COUNT][3] = {{"8", "12", "36"},
                                                       {"14 to 62", "24 to 120", "59 to 212"},
                                                       {"30 to 142", "56 to 280", "91 to 308"},
                                                       {"22 to 102", "40 to 200", "123 to 630"}};
    span spans[FAMILY_COUNT][3] = {{{0, 0}}};
    report_add_section(e->report, "Chart 0: the models");
    report_add_text(e->report,
                    "A box moves past ten cylinders, ten complex cylinders and ten spheres. A cylinder of k sides with "
                    "a vertex in the middle of each cap has 2k + 2 vertices and 4k triangles; a closed mesh of V "
                    "vertices has 2V - 4. Both fit the paper's numbers exactly, so these are taken to be its models.");
    report_table *t = report_begin_table(
        e->report, "models", "model,vertices,faces,hull vertices,facets,pieces after splitting,polyhedron volume");
    for (int i = 0; i < MODEL_COUNT; i++) {
        const paper_model *m = &e->models[i];
        ovoid_polytope mesh = paper_model_get_mesh(m), hull = ovoid_shape_get_polytope(m->shape);
        ovoid_ellipsoid inner = ovoid_shape_get_inner(m->shape).ellipsoid;
        ovoid_split_counts split = ovoid_polytope_compute_split(&mesh, &inner);
        take(&spans[m->family][0], m->vertex_count);
        take(&spans[m->family][1], m->triangle_count);
        take(&spans[m->family][2], split.pieces);
        report_add_row(t, "%s,%u,%u,%u,%u,%u,%.4f", m->name, m->vertex_count, m->triangle_count, hull.vertex_count,
                       hull.facet_count, split.pieces, ovoid_shape_get_measures(m->shape).volume);
    }
    report_end_table(t, 0);
    add_pictures(e);
    t = report_begin_table(e->report, "models_ranges",
                           "family,vertices (paper),here,faces (paper),here,after splitting (paper),here");
    for (int i = 0; i < FAMILY_COUNT; i++) {
        const span *s = spans[i];
        report_add_row(t, "%s,%s,%u to %u,%s,%u to %u,%s,%u to %u", paper_family_get_name((paper_family)i), paper[i][0],
                       s[0].low, s[0].high, paper[i][1], s[1].low, s[1].high, paper[i][2], s[2].low, s[2].high);
    }
    report_end_table(t, FAMILY_COUNT);
    char pieces[80];
    snprintf(pieces, sizeof pieces, "vertices and faces are its own; a sphere has %u to %u pieces",
             spans[FAMILY_SPHERE][2].low, spans[FAMILY_SPHERE][2].high);
    report_add_verdict(e->report,
                       (report_verdict){"Its models have 8 to 142 vertices; split, a sphere has 123 to 630 pieces.",
                                        REPORT_HOLDS_IN_PART, pieces, "any number of vertices"});
    report_add_finding(
        e->report,
        (report_finding){
            "Three coordinate planes cut 40 to 200 faces of a sphere into 123 to 630 pieces, about three times as "
            "many.",
            "The box agrees (36). Cylinders give more pieces than there, spheres fewer: each plane cuts only the faces "
            "around its own circle.",
            "Where the planes cut depends on the ellipsoid's axes; a factor of three for spheres is more than three "
            "planes through the centre can give, so the paper must have split in another way."});
}
