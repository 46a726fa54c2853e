// Every public function of the core that computes gives the same bits whatever floating-point environment it is called
// in, traps nothing, and leaves its settings as they were and its raised exception flags raised. Truth: the bits in the
// default environment; the caller's own control and status words. Environments: four rounding modes, subnormals kept or
// flushed, exceptions masked or not, and each flag alone, none and all set beforehand. On x86-64 the words are MXCSR
// and those of the x87; elsewhere what <fenv.h> shows.
#include "check.h"
#include "ovoid/ovoid.h"
#include "proofs/covers.h"

#include <fenv.h>

// ---- bits, with integers only: no arithmetic of the test's own may raise a flag

static uint64_t hash;

static void add(const void *data, size_t size) {
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++) hash = (hash ^ bytes[i]) * 1099511628211u;
}
#define ADD(value) add(&(value), sizeof(value))

static void add_vec3s(const ovoid_vec3 *v, size_t count) { add(v, count * sizeof *v); }

static void add_fit(ovoid_fit f) {
    ADD(f.ellipsoid);
    ADD(f.volume);
    ADD(f.gap);
    ADD(f.iterations);
    ADD(f.converged);
}

// ---- what the functions are called with

static ovoid_shape *hull_shape, *box_shape, *flat_shape, *far_shape;
static ovoid_areas *hull_areas, *cube_areas;
static ovoid_pair pairs[6];
static ovoid_proof known[6];
static ovoid_fit outer, inner, shrunk, stretched;
static ovoid_ellipsoid other;
static double cloud[3 * 24];
static const ovoid_vec3 point = {0.3, -1.7, 2.9}, turn = {0.1, 0.2, -0.7}, small = {1e-310, -3e-320, 0.1};
enum { PAIRS = sizeof pairs / sizeof *pairs };
static const double third = 1.0 / 3;

// ---- the public functions

static void ask_pose(void) {
    ovoid_pose p = ovoid_pose_make_rpy(point, turn);
    ADD(p);
    ovoid_vec3 v[3] = {ovoid_pose_compute_point(&p, turn), ovoid_pose_compute_local_point(&p, turn),
                       ovoid_pose_compute_point(&p, small)};
    add_vec3s(v, 3);
    ovoid_pose more[2] = {ovoid_pose_compute_product(&p, &pairs[0].pose_b), ovoid_pose_compute_inverse(&p)};
    ADD(more);
    double matrix[16];
    ovoid_pose_compute_transform(&p, matrix);
    ADD(matrix);
    ovoid_code made[2] = {ovoid_pose_make_transform(matrix, &more[0], NULL),
                          ovoid_pose_make_axis_angle(point, small, third, &more[1])};
    ADD(made);
    ADD(more);
    p.position.y = third;
    ovoid_code code = ovoid_pose_validate(&p);
    ADD(code);
    p.position.y = 1e60;
    code = ovoid_pose_validate(&p);
    ADD(code);
}

static void add_answer(const ovoid_answer *x) {
    add(x, offsetof(ovoid_answer, proof));
    ADD(x->proof.normal);
    ADD(x->proof.normal_low);
    ADD(x->proof.kind);
    add(x->proof.a, x->proof.count * sizeof *x->proof.a);
    add(x->proof.b, x->proof.count * sizeof *x->proof.b);
    add(x->proof.weight_a, x->proof.count * sizeof *x->proof.weight_a);
    ADD(x->proof.inner_a);
}

static void ask_collide(void) {
    for (int i = 0; i < PAIRS; i++) {
        ovoid_answer x = ovoid_collide(&pairs[i], NULL, NULL), warm = ovoid_collide(&pairs[i], NULL, &known[i]);
        add_answer(&x);
        add_answer(&warm);
    }
}

static void ask_prepared(void) {
    for (int i = 0; i < PAIRS; i++) {
        ovoid_prepared_shape a, b;
        ovoid_prepared_shape_make(&(ovoid_posed_shape){pairs[i].shape_a, pairs[i].pose_a}, &a);
        ovoid_prepared_shape_make(&(ovoid_posed_shape){pairs[i].shape_b, pairs[i].pose_b}, &b);
        ovoid_proof proof = known[i];
        ovoid_evidence wanted = {.proof = &proof};
        ovoid_verdict v[5] = {ovoid_prepared_collide((ovoid_prepared_pair){&a, &b}, NULL, NULL),
                              ovoid_prepared_within((ovoid_prepared_pair){&a, &b}, third, NULL, NULL),
                              ovoid_prepared_distance((ovoid_prepared_pair){&a, &b}, NULL, NULL),
                              ovoid_prepared_depth((ovoid_prepared_pair){&a, &b}, NULL, NULL),
                              ovoid_prepared_distance((ovoid_prepared_pair){&a, &b}, NULL, &wanted)};
        ADD(v);
        ADD(proof.normal);
        int is = ovoid_verdict_is_within(&v[1], third);
        ADD(is);
    }
}

static void ask_within(void) {
    for (int i = 0; i < PAIRS; i++) {
        ovoid_answer x = ovoid_within(&pairs[i], third, NULL, &known[i]);
        add_answer(&x);
        int is = ovoid_answer_is_within(&x, third);
        ADD(is);
    }
}

static void ask_distance(void) {
    ovoid_options options = {.relative_tolerance = 1e-7, .cap = 2.25};
    for (int i = 0; i < PAIRS; i++) {
        ovoid_answer x = ovoid_distance(&pairs[i], i % 2 ? &options : NULL, NULL);
        add_answer(&x);
    }
}

static void ask_depth(void) {
    STATIC_COVER(cover);
    for (int i = 0; i < PAIRS; i++) {
        ovoid_answer x = ovoid_depth(&pairs[i], NULL, NULL, &cover);
        add_answer(&x);
        add(cover.a, cover.point_count * sizeof *cover.a);
        add(cover.triangles, cover.triangle_count * sizeof *cover.triangles);
        ovoid_code code = ovoid_answer_verify(&pairs[i], &x, &(ovoid_answer_basis){.cover = &cover}, NULL);
        ADD(code);
        x.lower = x.upper;
        code = ovoid_answer_verify(&pairs[i], &x, &(ovoid_answer_basis){.cover = &cover}, NULL);
        ADD(code);
        x = ovoid_depth_from(&pairs[i], NULL, &x.proof, &cover);
        add_answer(&x);
    }
}

static void ask_batch(void) {
    ovoid_posed_shape bodies[2 * PAIRS];
    ovoid_couple couples[PAIRS];
    ovoid_proof proofs[PAIRS];
    ovoid_answer answers[PAIRS];
    for (uint32_t i = 0; i < PAIRS; i++) {
        bodies[2 * i] = (ovoid_posed_shape){pairs[i].shape_a, pairs[i].pose_a};
        bodies[2 * i + 1] = (ovoid_posed_shape){pairs[i].shape_b, pairs[i].pose_b};
        couples[i] = (ovoid_couple){2 * i, 2 * i + 1};
        proofs[i] = known[i];
    }
    ovoid_batch batch = {bodies, 2 * PAIRS, couples, PAIRS, NULL, proofs, NULL, answers, NULL};
    ovoid_code code[4] = {ovoid_collide_batch(&batch, NULL), ovoid_within_batch(&batch, third, NULL),
                          ovoid_distance_batch(&batch, NULL), ovoid_depth_batch(&batch, NULL)};
    ADD(code);
    for (int i = 0; i < PAIRS; i++) add_answer(&answers[i]);
}

static void ask_bounds(void) {
    for (int i = 0; i < PAIRS; i++) {
        ovoid_answer x = ovoid_pair_compute_bounds(&pairs[i]);
        add_answer(&x);
    }
}

static void ask_smooth(void) {
    for (int i = 0; i < PAIRS; i++)
        for (int order = 0; order <= 2; order += 2) {
            ovoid_smooth x = ovoid_pair_compute_smooth(&pairs[i], order);
            const ovoid_smooth_value *v[2] = {&x.outer, &x.inner};
            for (int k = 0; k < 2; k++) {
                ADD(v[k]->value);
                ADD(v[k]->error);
                ADD(v[k]->condition);
                add_vec3s(&v[k]->point_a, 3);
                ADD(v[k]->gradient);
                ADD(v[k]->hessian);
            }
        }
    STATIC_COVER(cover);
    for (int i = 0; i < PAIRS; i++) {
        ovoid_answer x = ovoid_depth(&pairs[i], NULL, NULL, &cover);
        ovoid_gradient g = ovoid_answer_compute_gradient(&pairs[i], &x, &cover);
        ADD(g);
    }
}

static void ask_compounds(void) {
    ovoid_posed_shape parts[6];
    for (int i = 0; i < 6; i++) parts[i] = (ovoid_posed_shape){i == 3 ? hull_shape : pairs[i].shape_a, pairs[i].pose_b};
    ovoid_compound *compound = ovoid_compound_create(parts, 5, NULL, NULL);
    ovoid_ellipsoid both[2] = {ovoid_compound_get_outer(compound), ovoid_compound_get_inner(compound)};
    ADD(both);
    static ovoid_exclusion items[256];
    for (int i = 0; i < 3; i++) {
        ovoid_exclusions all = {.items = items, .capacity = 256};
        ovoid_body_pair p = {{.compound = compound, .pose = pairs[i].pose_b},
                             {.compound = compound, .pose = {{2.5 * i, third, 0}, {1, 0, 0, 1}}}};
        ovoid_body_answer x[4] = {ovoid_body_collide(&p, NULL, NULL), ovoid_body_within(&p, third, NULL, NULL),
                                  ovoid_body_distance(&p, NULL, NULL),
                                  ovoid_body_depth(&p, NULL, &(ovoid_body_evidence){.exclusions = &all})};
        for (int k = 0; k < 4; k++) {
            add_answer(&x[k].deciding);
            ADD(x[k].part_a);
            ADD(x[k].visited);
        }
        for (size_t k = 0; k < all.count && k < 256; k++) ADD(items[k].lower);
        ovoid_code code = ovoid_body_verify(&p, &x[3], &(ovoid_body_basis){.exclusions = &all}, NULL);
        ADD(code);
    }
    ovoid_compound_destroy(compound);
}

static void add_impact(const ovoid_impact *x) {
    ADD(x->status);
    ADD(x->limit);
    ADD(x->iterations);
    ADD(x->free_until);
    ADD(x->hit_at);
    add_answer(&x->free);
    add_answer(&x->hit);
}

static void ask_motions(void) {
    const ovoid_vec3 linear = {-2.9, third, 0.1}, angular = {third, 1.7, -0.9};
    const double times[3] = {0, third, 1};
    const ovoid_pose poses[3] = {pairs[0].pose_b, pairs[1].pose_b, pairs[0].pose_a};
    ovoid_moving_shape a = {.shape = hull_shape, .motion = ovoid_motion_make_path(times, poses, 3)};
    ovoid_moving_shape b = {.shape = box_shape,
                            .motion = ovoid_motion_make_velocity(pairs[3].pose_b, linear, angular, 1),
                            .part = pairs[1].pose_b};
    ovoid_pose p[2] = {ovoid_motion_compute_pose(&a.motion, 0.7), ovoid_moving_shape_compute_pose(&b, third)};
    ADD(p);
    ovoid_code code = ovoid_motion_validate(&b.motion, NULL);
    ADD(code);
    ovoid_box box = ovoid_moving_shape_compute_box(&a, 0.1, third);
    ADD(box);
    static ovoid_step steps[1000];
    ovoid_motion_options o = {.begin = 0.01, .end = 0.99, .steps = steps, .capacity = 1000};
    ovoid_impact x = ovoid_impact_find(&(ovoid_moving_pair){a, b, 0.01}, &o);
    add_impact(&x);
    code = ovoid_impact_verify(&(ovoid_moving_pair){a, b, 0.01}, &x, &(ovoid_motion_basis){.steps = steps}, NULL);
    ADD(code);
    ovoid_approach y = ovoid_approach_find(&(ovoid_moving_pair){a, b, 0}, &o);
    ADD(y.lower);
    ADD(y.upper);
    ADD(y.time);
    code = ovoid_approach_verify(&(ovoid_moving_pair){a, b, 0}, &y, &(ovoid_motion_basis){.steps = steps}, NULL);
    ADD(code);
    x = ovoid_shape_cast(&pairs[0], linear, third, NULL);
    add_impact(&x);
    ovoid_moving_body bodies[2] = {{.shape = hull_shape, .motion = a.motion}, {.shape = box_shape, .motion = b.motion}};
    ovoid_body_impact z = ovoid_body_impact_find(&(ovoid_moving_body_pair){bodies[0], bodies[1], 0.01}, &o);
    add_impact(&z.impact);
    static ovoid_step_group groups[8];
    o.groups = groups;
    o.group_capacity = 8;
    z = ovoid_body_impact_find(&(ovoid_moving_body_pair){bodies[0], bodies[1], 0.01}, &o);
    ADD(z.group_count);
    code = ovoid_body_impact_verify(&(ovoid_moving_body_pair){bodies[0], bodies[1], 0.01}, &z,
                                    &(ovoid_motion_basis){.steps = steps, .groups = groups}, NULL);
    ADD(code);
    box = ovoid_moving_body_compute_box(&bodies[1], 0, third);
    ADD(box);
    ovoid_posed_shape body = {hull_shape, pairs[0].pose_b};
    ovoid_ray ray = {point, {2.1, 2.2, -2.7}, INFINITY, 0.01};
    ovoid_ray_hit hit = ovoid_shape_cast_ray(&body, &ray);
    ADD(hit.lower);
    ADD(hit.upper);
    ADD(hit.point);
    ADD(hit.normal);
}

static void add_hit(const ovoid_world_hit *hit) {
    ADD(hit->a);
    ADD(hit->b);
    ADD(hit->lower);
    ADD(hit->answer.part_a);
    if (hit->b) add_answer(&hit->answer.deciding);
}

static void ask_world_between(ovoid_world *w, ovoid_id id) {
    ovoid_world_hit hit, items[4];
    ovoid_world_hits hits = {.items = items, .capacity = 4};
    ovoid_world_body probe = ovoid_world_make_point(w, point);
    ovoid_world_cast cast;
    ovoid_world_ray ray = {.ray = {point, turn, 1e3, 0.1}};
    int code = (int)ovoid_world_find_any(w, NULL, &hit, NULL);
    add_hit(&hit);
    code += (int)ovoid_world_find_any_of(w, &(ovoid_world_probes){.items = &probe, .count = 1}, &hit, NULL);
    add_hit(&hit);
    const ovoid_world_body couple[2] = {probe, probe};
    const ovoid_couple both = {0, 1};
    const ovoid_world_probes state = {couple, 2, &both, 1};
    code += (int)ovoid_world_find_any_of(w, &state, &hit, NULL);
    add_hit(&hit);
    code += (int)ovoid_world_find_nearest(w, &(ovoid_world_query){.id = id}, &hit, NULL);
    add_hit(&hit);
    code += (int)ovoid_world_find_nearest_pair(w, NULL, &hit, NULL);
    add_hit(&hit);
    code += (int)ovoid_world_find_nearest(w, &(ovoid_world_query){.probe = &probe}, &hit, NULL);
    add_hit(&hit);
    code += (int)ovoid_world_find_overlaps(w, &(ovoid_world_query){.probe = &probe, .margin = third}, &hits, NULL);
    ADD(hits.count);
    for (size_t i = 0; i < hits.count && i < 4; i++) add_hit(&items[i]);
    code += (int)ovoid_world_cast_ray(w, &ray, &cast, NULL);
    ADD(cast);
    probe.body.shape = hull_shape;
    code += (int)ovoid_world_cast_body(w, &(ovoid_world_sweep){probe, turn}, &cast, NULL);
    ADD(cast);
    ADD(code);
}

static void ask_world(void) {
    static const double steps[8] = {0.1, 0.11, 0.12, 0.14, 0.16, 0.2, 0.3, 1e-310};
    ovoid_world *w = ovoid_world_create(NULL, NULL);
    ovoid_world_body bodies[PAIRS];
    ovoid_id ids[PAIRS];
    for (int i = 0; i < PAIRS; i++)
        bodies[i] = (ovoid_world_body){.body = {.shape = pairs[i].shape_b, .pose = pairs[i].pose_b}};
    int code = (int)ovoid_world_add_many(w, &(ovoid_world_additions){bodies, PAIRS, ids}, NULL);
    for (int k = 0; k < 8; k++) {
        ovoid_contact_query q = {.kind = (ovoid_query_kind)(k / 2), .margin = k / 2 ? third : 0};
        ovoid_contacts f;
        code += (int)ovoid_world_compute_contacts(w, &q, &f, NULL);
        add(f.items, f.count * sizeof *f.items);
        ovoid_contact_proof x = {.exclusions = NULL};
        for (size_t i = 0; i < f.count; i++) {
            code += (int)ovoid_world_compute_proof(w, &f.items[i], &x, NULL);
            add_answer(&x.answer.deciding);
        }
        for (int i = 0; i < PAIRS; i++) {
            bodies[i].body.pose.position.z = steps[k];
            bodies[i].body.pose.rotation.y = steps[7 - k];
            code += (int)ovoid_world_move(w, ids[i], &bodies[i].body.pose, NULL);
        }
    }
    ask_world_between(w, ids[1]);
    int looked_at = ovoid_world_is_pair(w, ids[0], ids[1]);
    ADD(looked_at);
    code += (int)ovoid_world_remove(w, ids[2], NULL);
    ADD(code);
    ovoid_world_destroy(w);
}

static void ask_paper(void) {
    const ovoid_areas *areas[2] = {hull_areas, hull_areas};
    ovoid_pair p = {hull_shape, hull_shape, pairs[0].pose_a, pairs[0].pose_b};
    ovoid_paper_bounds b = ovoid_paper_compute_bounds(&p, areas, OVOID_RULE_SIGNS, third);
    ADD(b.nearest);
    ADD(b.lower);
    ADD(b.upper);
    add_vec3s(&b.q1, 4);
}

static void add_shape(ovoid_shape *shape) {
    if (!shape) return;
    static unsigned char bytes[1 << 16];
    size_t size = ovoid_shape_write(shape, bytes, sizeof bytes);
    add(bytes, size);
    ovoid_measures m = ovoid_shape_get_measures(shape);
    ADD(m);
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    add(p.planes, p.facet_count * sizeof *p.planes);
    add_fit(ovoid_shape_get_outer(shape));
    add_fit(ovoid_shape_get_inner(shape));
    double radius = ovoid_shape_get_radius(shape);
    ADD(radius);
    ovoid_shape *again = ovoid_shape_read(bytes, size, NULL, NULL), *copy = ovoid_shape_create_copy(shape, NULL, NULL);
    int both = (again != NULL) + (copy != NULL);
    ADD(both);
    ovoid_shape_destroy(again);
    ovoid_shape_destroy(copy);
    ovoid_shape_destroy(shape);
}

static void ask_points(void) {
    ovoid_shape_options o = {.radius = third, .inner = OVOID_INNER_PHASES};
    add_shape(ovoid_shape_create_from_points(cloud, 24, NULL, NULL));
    add_shape(ovoid_shape_create_from_points(cloud, 5, &o, NULL));
}

static void ask_changes(void) {
    ovoid_shape *shape = ovoid_shape_create_from_points(cloud, 24, NULL, NULL);
    const ovoid_plane plane = {{third, 0.1, 0.7}, 0.01};
    add_shape(ovoid_shape_create_deformed(shape, cloud, NULL, NULL));
    ovoid_shape_halves halves = ovoid_shape_create_divided(shape, &plane, NULL, NULL);
    int code = (int)halves.code;
    ADD(code);
    add_shape(halves.below);
    add_shape(halves.above);
    ovoid_shape_destroy(shape);
}

static void ask_faces(void) {
    static const double corners[12] = {0.1, 0.2, 0.3, 1.1, 0.2, 0.3, 0.1, 1.2, 0.3, 0.1, 0.2, 1.3};
    static const uint32_t indices[12] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}, sizes[4] = {3, 3, 3, 3};
    ovoid_faces faces = {corners, 4, indices, sizes, 4};
    add_shape(ovoid_shape_create_from_faces(&faces, NULL, NULL));
    ovoid_error error = {0};
    faces.face_count = 3;
    add_shape(ovoid_shape_create_from_faces(&faces, NULL, &error));
    ADD(error.code);
}

static void ask_primitives(void) {
    ovoid_shape_options o = {.radius = 0.1};
    add_shape(ovoid_shape_create_box((ovoid_vec3){third, 0.1, 2}, &o, NULL));
    add_shape(ovoid_shape_create_sphere(third, &o, NULL));
    add_shape(ovoid_shape_create_capsule(third, 0.7, &o, NULL));
    add_shape(ovoid_shape_create_prism(&(ovoid_prism){third, 0.7, 7}, &o, NULL));
    add_shape(ovoid_shape_create_pyramid(&(ovoid_prism){third, 0.7, 7}, &o, NULL));
    // Subnormal lengths are lengths.
    ovoid_error error = {0};
    add_shape(ovoid_shape_create_box((ovoid_vec3){-1e-310, 1, 1}, NULL, &error));
    ADD(error.code);
    add_shape(ovoid_shape_create_box((ovoid_vec3){1e-310, 3e-312, 1e-320}, NULL, NULL));
}

static void ask_fits(void) {
    ovoid_polytope p = ovoid_shape_get_polytope(hull_shape);
    ovoid_fit f;
    ovoid_code code = ovoid_ellipsoid_compute_outer(&p, &(ovoid_ellipsoid_options){.gap = third}, &f, NULL);
    ADD(code);
    add_fit(f);
    code = ovoid_ellipsoid_compute_inner(&p, &(ovoid_ellipsoid_options){.gap = 1e-4}, &f, NULL);
    ADD(code);
    add_fit(f);
    add_fit(ovoid_ellipsoid_compute_shrunk(&p, &outer.ellipsoid));
    add_fit(ovoid_ellipsoid_compute_stretched(&p, &shrunk.ellipsoid));
    add_fit(ovoid_ellipsoid_compute_enlarged(&p, &stretched.ellipsoid));
    ovoid_measures m = ovoid_polytope_compute_measures(&p);
    ADD(m);
}

static void ask_ellipsoids(void) {
    ovoid_vec3 radii = ovoid_ellipsoid_compute_radii(&outer.ellipsoid), common = {0, 0, 0};
    ADD(radii);
    double volume = ovoid_ellipsoid_compute_volume(&outer.ellipsoid);
    ADD(volume);
    ovoid_ellipsoid e = ovoid_ellipsoid_compute_posed(&outer.ellipsoid, &pairs[0].pose_b);
    ADD(e);
    ovoid_nearest n[3] = {ovoid_ellipsoid_compute_nearest_to_point(&inner.ellipsoid, point),
                          ovoid_ellipsoid_compute_nearest_by_sphere(&inner.ellipsoid, &other),
                          ovoid_ellipsoid_compute_nearest(&inner.ellipsoid, &other)};
    ADD(n);
    int overlap = ovoid_ellipsoid_is_overlapping(&inner.ellipsoid, &outer.ellipsoid, &common);
    ADD(overlap);
    ADD(common);
}

static void ask_areas(void) {
    ovoid_polytope p = ovoid_shape_get_polytope(hull_shape);
    ovoid_areas *areas =
        ovoid_areas_create(&p, &inner.ellipsoid, &(ovoid_areas_options){.split = OVOID_SPLIT_CUBE, .k = 4}, NULL);
    ovoid_area_counts counts = ovoid_areas_get_counts(areas);
    ADD(counts.cells);
    ADD(counts.facet_entries);
    ADD(counts.vertex_entries);
    ovoid_areas_destroy(areas);
    ovoid_split_counts split = ovoid_polytope_compute_split(&p, &inner.ellipsoid);
    ADD(split);
}

static void ask_exits(void) {
    static const ovoid_area_rule rules[4] = {OVOID_RULE_ALL, OVOID_RULE_RAY, OVOID_RULE_SIGNS, OVOID_RULE_PAPER};
    for (int i = 0; i < 4; i++) {
        ovoid_exit e = ovoid_areas_find_exit(hull_areas, point, turn, rules[i]);
        ADD(e);
    }
    uint32_t touched, v[3] = {ovoid_areas_find_support(hull_areas, point, &touched),
                              ovoid_areas_find_support(cube_areas, turn, &touched),
                              ovoid_areas_find_support(cube_areas, small, NULL)};
    ADD(v);
    ADD(touched);
}

static const struct {
    const char *name;
    void (*ask)(void);
} functions[] = {{"poses", ask_pose},
                 {"collide", ask_collide},
                 {"prepared", ask_prepared},
                 {"within", ask_within},
                 {"distance", ask_distance},
                 {"depth and check", ask_depth},
                 {"batches", ask_batch},
                 {"bounds", ask_bounds},
                 {"smooth, gradient", ask_smooth},
                 {"compounds", ask_compounds},
                 {"smooth", ask_smooth},
                 {"motions", ask_motions},
                 {"paper", ask_paper},
                 {"from points", ask_points},
                 {"deformed, divided", ask_changes},
                 {"from faces", ask_faces},
                 {"primitives", ask_primitives},
                 {"fits", ask_fits},
                 {"ellipsoids", ask_ellipsoids},
                 {"areas", ask_areas},
                 {"exits", ask_exits},
                 {"worlds", ask_world}};
enum { FUNCTIONS = sizeof functions / sizeof *functions };

// ---- environments

#if defined(__x86_64__) && defined(__GLIBC__)
enum { SETTINGS = 4 * 2 * 2 * 8 };

// The i-th environment: flags beforehand, masks, subnormals, rounding.
static void set_environment(const fenv_t *standard, int i) {
    static const unsigned flags[8] = {0, 0x3f, 1, 2, 4, 8, 16, 32};
    fenv_t e = *standard;
    e.__mxcsr = flags[i % 8] | (i / 8 % 2 ? 0 : 0x1f80u) | (i / 16 % 2 ? 0x8040u : 0) | (unsigned)(i / 32) << 13;
    e.__control_word = (unsigned short)(e.__control_word | (i / 32) << 10);
    fesetenv(&e);
}
// The low six bits of MXCSR are its flags: none is lost. Nothing of the x87 is used.
static int is_kept(const fenv_t *a, const fenv_t *b) {
    unsigned flags = a->__mxcsr & 0x3f;
    return a->__mxcsr >> 6 == b->__mxcsr >> 6 && (b->__mxcsr & flags) == flags &&
           a->__control_word == b->__control_word && a->__status_word == b->__status_word;
}
static unsigned get_word(const fenv_t *e) { return e->__mxcsr; }
#else
enum { SETTINGS = 4 * 2 };

static void set_environment(const fenv_t *standard, int i) {
    static const int modes[4] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
    fesetenv(standard);
    fesetround(modes[i / 2]);
    if (i % 2) feraiseexcept(FE_ALL_EXCEPT);
}
// What <fenv.h> shows of it: an fenv_t holds more than the environment, as the address of the last instruction.
static int is_kept(const fenv_t *a, const fenv_t *b) {
    fenv_t now;
    int flags[2], modes[2];
    fegetenv(&now);
    for (int i = 0; i < 2; i++) {
        fesetenv(i ? b : a);
        flags[i] = fetestexcept(FE_ALL_EXCEPT);
        modes[i] = fegetround();
    }
    fesetenv(&now);
    return (flags[0] & flags[1]) == flags[0] && modes[0] == modes[1];
}
static unsigned get_word(const fenv_t *e) {
    (void)e;
    return 0;
}
#endif

static void check_function(int f) {
    fenv_t standard, before, after;
    fegetenv(&standard);
    hash = 14695981039346656037u;
    functions[f].ask();
    uint64_t truth = hash;
    for (int i = 0; i < SETTINGS; i++) {
        set_environment(&standard, i);
        fegetenv(&before);
        hash = 14695981039346656037u;
        functions[f].ask();
        fegetenv(&after);
        fesetenv(&standard);
        check_seed = (uint64_t)i;
        if (!CHECK(hash == truth) && check_failed < 20)
            printf("  %s in %04x: other bits\n", functions[f].name, get_word(&before));
        if (!CHECK(is_kept(&before, &after)) && check_failed < 20)
            printf("  %s: %04x before, %04x after\n", functions[f].name, get_word(&before), get_word(&after));
    }
}

// ----

static void make_pairs(void) {
    const ovoid_pose here = {{0, 0, 0}, {1, 0, 0, 0}};
    const ovoid_shape *a[6] = {hull_shape, hull_shape, box_shape, box_shape, flat_shape, far_shape};
    const ovoid_shape *b[6] = {box_shape, hull_shape, box_shape, box_shape, hull_shape, box_shape};
    // Apart, deep, face to face, shallow, a flat one, one far from its frame's origin.
    const ovoid_vec3 at[6] = {{3.1, 0.2, 0.4}, {0.1, 0.2, 0.3}, {2, 0, 0},
                              {1.9, 0.1, 0.2}, {0, 0.1, 1.3},   {-1e9, 0, 2}};
    for (int i = 0; i < PAIRS; i++) {
        pairs[i] = (ovoid_pair){a[i], b[i], here, here};
        pairs[i].pose_b.position = at[i];
        if (i < 2) pairs[i].pose_b.rotation = (ovoid_quat){0.3, 0.1, -0.7, 0.2};
        known[i] = ovoid_depth(&pairs[i], NULL, NULL, NULL).proof;
    }
}

int main(void) {
    uint64_t s = 7;
    for (int i = 0; i < 72; i++) cloud[i] = random_uniform(&s, -1, 1);
    hull_shape = ovoid_shape_create_from_points(cloud, 24, NULL, NULL);
    box_shape = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    flat_shape = ovoid_shape_create_box((ovoid_vec3){1, 1, 0}, NULL, NULL);
    double away[72];
    for (int i = 0; i < 72; i++) away[i] = cloud[i] + (i % 3 ? 0 : -1e9);
    far_shape = ovoid_shape_create_from_points(away, 24, NULL, NULL);
    CHECK(hull_shape && box_shape && flat_shape && far_shape);
    if (check_failed) return check_end();
    make_pairs();
    ovoid_polytope p = ovoid_shape_get_polytope(hull_shape);
    outer = ovoid_shape_get_outer(hull_shape);
    inner = ovoid_shape_get_inner(hull_shape);
    shrunk = ovoid_ellipsoid_compute_shrunk(&p, &outer.ellipsoid);
    stretched = ovoid_ellipsoid_compute_stretched(&p, &shrunk.ellipsoid);
    other = ovoid_ellipsoid_compute_posed(&outer.ellipsoid, &pairs[0].pose_b);
    hull_areas = ovoid_areas_create(&p, &inner.ellipsoid, NULL, NULL);
    cube_areas =
        ovoid_areas_create(&p, &inner.ellipsoid, &(ovoid_areas_options){.split = OVOID_SPLIT_CUBE, .k = 2}, NULL);
    CHECK(hull_areas && cube_areas);
    for (int f = 0; f < FUNCTIONS && hull_areas && cube_areas; f++) check_function(f);
    ovoid_areas_destroy(hull_areas);
    ovoid_areas_destroy(cube_areas);
    ovoid_shape_destroy(hull_shape);
    ovoid_shape_destroy(box_shape);
    ovoid_shape_destroy(flat_shape);
    ovoid_shape_destroy(far_shape);
    return check_end();
}
