// Contacts of convex bodies with edges, corners, steps and thin walls of solids. Truth: closed forms.

#include "body/manifolds/solid_pair.h"
#include "manifolds.h"
#include "ovoid/body_manifolds.h"
#include "solids.h"

enum { MOST = 64 };

typedef struct scene {
    ovoid_solid *solid;
    ovoid_shape *shape;
    ovoid_body_pair pair;
    ovoid_manifold_options options;
    ovoid_body_manifold items[MOST];
    ovoid_manifold_points points[MOST];
    ovoid_body_manifolds found;
} scene;

static const ovoid_pose origin = {{0, 0, 0}, {1, 0, 0, 0}};

static void find(scene *x) {
    x->found = (ovoid_body_manifolds){.items = x->items, .points = x->points, .capacity = MOST};
    CHECK_EQ(ovoid_body_manifolds_find(&x->pair, &x->options, &x->found), OVOID_LIMIT_NONE);
    for (size_t i = 0; i < x->found.count; i++) {
        ovoid_error error = {.message = ""};
        if (!CHECK_EQ(ovoid_body_manifold_verify(&x->pair, &x->items[i], &x->options, &error), OVOID_OK))
            printf("  %s\n", error.message);
    }
}

static void begin(scene *x, ovoid_solid *solid, ovoid_shape *shape) {
    *x = (scene){.solid = solid, .shape = shape, .options = {.margin = 0.01}};
    x->pair = (ovoid_body_pair){{.shape = shape, .pose = origin}, {.solid = solid, .pose = origin}};
    CHECK(solid && shape);
}

static void end(scene *x) {
    ovoid_solid_destroy(x->solid);
    ovoid_shape_destroy(x->shape);
}

static void check_normal(const scene *x, size_t i, ovoid_vec3 up) {
    if (!CHECK(i < x->found.count)) return;
    CHECK(vec3_norm(vec3_add(x->items[i].manifold.normal, vec3_unit(up))) <= 1e-9);
}

// A prism along y from -2 to 2 over a polygon in x and z, counter-clockwise seen from -y.
static ovoid_solid *make_prism(const double (*xz)[2], uint32_t count, const uint32_t (*caps)[3]) {
    mesh m = {0};
    for (int side = 0; side < 2; side++)
        for (uint32_t i = 0; i < count; i++) mesh_add_point(&m, xz[i][0], side ? 2 : -2, xz[i][1]);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t k = (i + 1) % count;
        mesh_add_triangle(&m, i, k + count, k);
        mesh_add_triangle(&m, i, i + count, k + count);
    }
    for (uint32_t i = 0; i + 2 < count; i++) {
        mesh_add_triangle(&m, caps[i][0], caps[i][1], caps[i][2]);
        mesh_add_triangle(&m, caps[i][0] + count, caps[i][2] + count, caps[i][1] + count);
    }
    ovoid_solid *s = mesh_make_solid(&m);
    mesh_clear(&m);
    if (s) CHECK(ovoid_solid_get_report(s).is_closed && ovoid_solid_get_report(s).volume > 0);
    return s;
}

static ovoid_shape *make_box(double x, double y, double z) {
    return ovoid_shape_create_box((ovoid_vec3){x, y, z}, NULL, NULL);
}

// ---- a roof

// A level box on the ridge: one contact along the box's face, its two points at the ends of the box.
static void test_ridge(void) {
    static const double xz[3][2] = {{-2, -1}, {2, -1}, {0, 0}};
    static const uint32_t caps[1][3] = {{0, 1, 2}};
    scene x;
    begin(&x, make_prism(xz, 3, caps), make_box(0.5, 0.7, 0.3));
    x.pair.a.pose.position = (ovoid_vec3){0.1, 0.2, 0.299};
    find(&x);
    CHECK_EQ(x.found.count, 1);
    check_normal(&x, 0, (ovoid_vec3){0, 0, 1});
    CHECK_EQ(x.items[0].manifold.axis, OVOID_MANIFOLD_FACE_A);
    CHECK_EQ(x.points[0].count, 2);
    for (uint32_t i = 0; i < x.points[0].count; i++) {
        CHECK_NEAR(x.points[0].points[i].separation, -0.001, 1e-9);
        CHECK_NEAR(fabs(x.points[0].points[i].point_b.y - 0.2), 0.7, 1e-9);
        CHECK_NEAR(x.points[0].points[i].point_b.x, 0, 1e-9);
    }
    // A ball beside the ridge, off both slopes' regions: the normal is from the ridge to its centre.
    ovoid_shape_destroy(x.shape);
    x.shape = ovoid_shape_create_sphere(0.5, NULL, NULL);
    x.pair.a.shape = x.shape;
    double lean = 0.2, away = 0.499;
    x.pair.a.pose.position = (ovoid_vec3){away * sin(lean), 0.3, away * cos(lean)};
    find(&x);
    CHECK_EQ(x.found.count, 1);
    check_normal(&x, 0, (ovoid_vec3){sin(lean), 0, cos(lean)});
    CHECK_NEAR(x.items[0].manifold.lower, -0.001, 1e-9);
    // Beyond the slope's own normal, at atan 1/2, the slope takes over.
    x.pair.a.pose.position = (ovoid_vec3){1 + away / sqrt(5), 0.3, -0.5 + 2 * away / sqrt(5)};
    find(&x);
    CHECK_EQ(x.found.count, 1);
    check_normal(&x, 0, (ovoid_vec3){1, 0, 2});
    CHECK_EQ(x.items[0].manifold.axis, OVOID_MANIFOLD_FACE_B);
    end(&x);
}

// ---- a groove, and a corner of wall and floor

static void test_groove(void) {
    static const double xz[5][2] = {{-2, -1}, {2, -1}, {2, 2}, {0, 0}, {-2, 2}};
    static const uint32_t caps[3][3] = {{0, 1, 3}, {1, 2, 3}, {0, 3, 4}};
    scene x;
    begin(&x, make_prism(xz, 5, caps), ovoid_shape_create_sphere(0.5, NULL, NULL));
    x.pair.a.pose.position = (ovoid_vec3){0, 0.1, 0.499 * sqrt(2)};
    find(&x);
    CHECK_EQ(x.found.count, 2);
    double sum = 0;
    for (size_t i = 0; i < x.found.count; i++) {
        CHECK_NEAR(fabs(x.items[i].manifold.normal.x), sqrt(0.5), 1e-9);
        CHECK_NEAR(x.items[i].manifold.normal.z, -sqrt(0.5), 1e-9);
        CHECK_NEAR(x.items[i].manifold.lower, -0.001, 1e-9);
        sum += x.items[i].manifold.normal.x;
    }
    CHECK_NEAR(sum, 0, 1e-9);
    end(&x);
}

static void test_corner(void) {
    static const double xz[6][2] = {{-2, -1}, {2, -1}, {2, 0}, {0, 0}, {0, 2}, {-2, 2}};
    static const uint32_t caps[4][3] = {{0, 1, 3}, {1, 2, 3}, {0, 3, 5}, {3, 4, 5}};
    scene x;
    begin(&x, make_prism(xz, 6, caps), make_box(0.5, 0.7, 0.3));
    // Two thousandths in the wall, one in the floor: each has its four points. Tilted down toward the wall, the box is
    // deepest below the floor where the floor has ended.
    for (int tilted = 0; tilted < 2; tilted++) {
        x.pair.a.pose = (ovoid_pose){{tilted ? 0.493 : 0.498, 0.2, 0.299}, {1, 0, tilted ? -0.005 : 0, 0}};
        find(&x);
        CHECK_EQ(x.found.count, 2);
        int has_wall = 0, has_floor = 0;
        for (size_t i = 0; i < x.found.count; i++) {
            const ovoid_vec3 n = x.items[i].manifold.normal;
            has_wall |= fabs(n.x + 1) < 1e-9;
            has_floor |= fabs(n.z + 1) < 1e-9;
            CHECK_EQ(x.points[i].count, 4);
        }
        CHECK(has_wall && has_floor);
    }
    end(&x);
}

// ---- the rim of a table, and a rail

static ovoid_solid *make_block(double half, double low, double high) {
    const double xz[4][2] = {{-half, low}, {half, low}, {half, high}, {-half, high}};
    static const uint32_t caps[2][3] = {{0, 1, 2}, {0, 2, 3}};
    return make_prism(xz, 4, caps);
}

static void test_rim(void) {
    scene x;
    begin(&x, make_block(1, -2, 0), make_box(0.5, 0.7, 0.3));
    // Half over the rim: only the table's top, four points, two of them on the rim.
    x.pair.a.pose.position = (ovoid_vec3){1, 0, 0.299};
    find(&x);
    CHECK_EQ(x.found.count, 1);
    check_normal(&x, 0, (ovoid_vec3){0, 0, 1});
    CHECK_EQ(x.items[0].manifold.axis, OVOID_MANIFOLD_FACE_B);
    CHECK_EQ(x.points[0].count, 4);
    for (uint32_t i = 0; i < x.points[0].count; i++) {
        CHECK_NEAR(x.points[0].points[i].separation, -0.001, 1e-12);
        CHECK_LE(x.points[0].points[i].point_a.x, 1 + 1e-9);
    }
    // Tilted down over the rim: the rim touches the box's face, along that face's normal.
    double lean = 0.05;
    x.pair.a.pose = (ovoid_pose){{1 + 0.3 * sin(lean), 0, 0.299 * cos(lean)}, {cos(lean / 2), 0, sin(lean / 2), 0}};
    find(&x);
    CHECK_EQ(x.found.count, 1);
    check_normal(&x, 0, (ovoid_vec3){sin(lean), 0, cos(lean)});
    CHECK_EQ(x.items[0].manifold.axis, OVOID_MANIFOLD_FACE_A);
    end(&x);
    // A rail that is narrower than the box and much thinner than it is deep.
    begin(&x, make_block(0.05, -2, 0), make_box(0.5, 0.7, 0.3));
    x.pair.a.pose.position = (ovoid_vec3){0.02, 0, 0.299};
    find(&x);
    CHECK_EQ(x.found.count, 1);
    check_normal(&x, 0, (ovoid_vec3){0, 0, 1});
    CHECK_EQ(x.points[0].count, 4);
    end(&x);
    // A blade, whose sides make less than the angle with the normal that a facet may have.
    static const double xz[3][2] = {{-0.05, -2}, {0.05, -2}, {0, 0}};
    static const uint32_t caps[1][3] = {{0, 1, 2}};
    begin(&x, make_prism(xz, 3, caps), make_box(0.5, 0.7, 0.3));
    x.pair.a.pose.position = (ovoid_vec3){0.02, 0, 0.299};
    find(&x);
    CHECK_EQ(x.found.count, 1);
    check_normal(&x, 0, (ovoid_vec3){0, 0, 1});
    CHECK_EQ(x.items[0].manifold.facet_b & OVOID_MANIFOLD_KIND, OVOID_MANIFOLD_EDGE);
    CHECK_EQ(x.points[0].count, 2);
    end(&x);
}

// ---- too deep

// A plate that the box has gone through: no normal of it leads out, and that is said.
static void test_plate(void) {
    scene x;
    begin(&x, make_block(2, -0.01, 0), make_box(0.5, 0.7, 0.3));
    x.pair.a.pose.position = (ovoid_vec3){0.1, 0, 0.291};
    find(&x);
    CHECK_EQ(x.found.count, 1);
    CHECK_EQ(x.found.through, 0);
    check_normal(&x, 0, (ovoid_vec3){0, 0, 1});
    x.pair.a.pose.position.z = 0.1;
    find(&x);
    CHECK_EQ(x.found.count, 0);
    CHECK_EQ(x.found.through, 1);
    CHECK_LE(x.found.lower, 0);
    end(&x);
    // Inside of a block, away from its surface.
    begin(&x, make_block(2, -3, 1), make_box(0.2, 0.2, 0.2));
    x.pair.a.pose.position = (ovoid_vec3){0, 0, -1};
    find(&x);
    CHECK_EQ(x.found.count, 0);
    CHECK_LE(x.found.upper, 0);
    end(&x);
}

// The low edge of a tilted box comes back from beyond a rim: the kept corners of the rim are beside the box, where the
// plane of its face is below it, and are no deeper than the box.
static void test_kept(void) {
    const double tilt = 0.05, beyond = 2e-3;
    scene x;
    begin(&x, make_block(1, -2, 0), make_box(0.5, 2.5, 0.3));
    x.options.keep = 5e-3;
    // The edge from the centre: a vector in the box, turned.
    double edge_x = 0.5 * cos(tilt) - 0.3 * sin(tilt), edge_z = -0.5 * sin(tilt) - 0.3 * cos(tilt);
    x.pair.a.pose = (ovoid_pose){{1 + beyond - edge_x, 0, -0.01 - edge_z}, {cos(tilt / 2), 0, sin(tilt / 2), 0}};
    find(&x);
    CHECK_EQ(x.found.count, 1);
    ovoid_body_manifold earlier = x.items[0];
    x.pair.a.pose.position.x -= 2 * beyond;
    x.found = (ovoid_body_manifolds){
        .items = x.items, .points = x.points, .capacity = MOST, .earlier = &earlier, .earlier_count = 1};
    CHECK_EQ(ovoid_body_manifolds_find(&x.pair, &x.options, &x.found), OVOID_LIMIT_NONE);
    CHECK_EQ(x.found.count, 1);
    uint32_t at_rim = 0;
    for (uint32_t i = 0; i < x.points[0].count; i++) {
        CHECK_LE(x.items[0].manifold.lower - 1e-9, x.points[0].points[i].separation);
        at_rim += x.points[0].points[i].point_b.x > 1 - 0.5 * beyond;
    }
    CHECK_EQ(at_rim, 2);
    end(&x);
}

// ---- forged: all that is measured is true, but the normal is not one that the solid has

// A manifold along a normal of the frame at the facet of a triangle, as if it had been found.
static ovoid_body_manifold forge(const scene *x, uint32_t triangle, ovoid_manifold_axis axis, vec3 n) {
    solid_pair p;
    manifold_terms terms;
    manifold_state state;
    facet_depths depths;
    ovoid_body_manifold item = {.part_b = triangle};
    ovoid_manifold *m = &item.manifold;
    CHECK_EQ(solid_pair_make(&p, &(ovoid_posed_shape){x->shape, x->pair.a.pose}, &x->pair.b), OVOID_LIMIT_NONE);
    CHECK(manifold_terms_make(&x->options, &p.frame, &terms));
    facet_contact c = {.axis = axis, .n = vec3_unit(n), .facet_b = OVOID_MANIFOLD_FACET | triangle};
    c.plane = solid_pair_get_plane(&p, x->solid->places[triangle]);
    const facet_choice choice = {c.n,        OVOID_MANIFOLD_VERTEX, shape_find_extreme(x->shape, c.n).index, 0, 0,
                                 terms.least};
    c.facet_a = facet_choose(x->shape, &choice);
    const clip_rules rules = facet_contact_make_rules(&p, &terms, NULL);
    const tree_ends ends = solid_pair_make_ends(&p, terms.margin);
    CHECK(facet_contact_clip(&p, &(facet_clip){&c, &rules, &ends}, &state, &depths));
    corner_choice chosen = corners_choose(&state, NULL, terms.slack);
    m->axis = axis;
    m->normal = frame_direction_to_world(&p.frame, c.n);
    m->feature_a = axis == OVOID_MANIFOLD_FREE ? OVOID_MANIFOLD_DIRECTION : OVOID_MANIFOLD_VERTEX | state.frame.low_a;
    m->feature_b = axis == OVOID_MANIFOLD_FREE ? OVOID_MANIFOLD_DIRECTION : c.facet_b;
    m->facet_a = c.facet_a;
    m->facet_b = c.facet_b;
    m->count = (uint8_t)chosen.count;
    m->corners = (uint16_t)state.polygon.count;
    m->share = (float)chosen.share;
    for (uint32_t i = 0; i < chosen.count; i++) {
        state.polygon.corners[i] = state.polygon.corners[chosen.index[i]];
        m->id[i] = state.polygon.corners[i].id;
    }
    facet_contact_measure(&p, &terms, &state, m);
    return item;
}

static void check_forged(const scene *x, const ovoid_body_manifold *item, const char *words) {
    ovoid_error error = {.message = ""};
    CHECK_EQ(ovoid_body_manifold_verify(&x->pair, item, &x->options, &error), words ? OVOID_ERROR_PROOF : OVOID_OK);
    if (words && !CHECK(strstr(error.message, words) != NULL)) printf("  %s\n", error.message);
}

static void test_forged(void) {
    scene x;
    begin(&x, make_block(1, -2, 0), make_box(0.5, 0.7, 0.3));
    x.pair.a.pose.position = (ovoid_vec3){0.9, 0, 0.299};
    find(&x);
    CHECK_EQ(x.found.count, 1);
    uint32_t top = x.items[0].part_b, side = 0;
    for (uint32_t t = 0; t < 12; t++)
        if (solid_compute_facet_normal(x.solid, x.solid->facets[x.solid->places[t]]).x > 0.5)
            side = x.solid->order[x.solid->facets[x.solid->places[t]]];
    ovoid_body_manifold item = forge(&x, top, OVOID_MANIFOLD_FACE_B, (vec3){0, 0, -1});
    check_forged(&x, &item, NULL);
    // The top along a direction that it does not have, and the side as if the box had come in from there.
    item = forge(&x, top, OVOID_MANIFOLD_FREE, (vec3){0.1, 0, -1});
    check_forged(&x, &item, "the solid rises beside the contact");
    item = forge(&x, side, OVOID_MANIFOLD_FACE_B, (vec3){-1, 0, 0});
    CHECK_LE(item.manifold.lower, -0.5);
    check_forged(&x, &item, "not nearest to the solid over this facet");
    end(&x);
}

// ---- compounds, and surfaces that are not closed

static void test_compound(void) {
    scene x;
    begin(&x, make_block(2, -1, 0), make_box(0.2, 0.2, 0.2));
    ovoid_posed_shape parts[3] = {{x.shape, {{-0.5, 0, 0}, {1, 0, 0, 0}}},
                                  {x.shape, {{0.5, 0, 0}, {1, 0, 0, 0}}},
                                  {x.shape, {{0, 0, 1}, {1, 0, 0, 0}}}};
    ovoid_compound *both = ovoid_compound_create(parts, 3, NULL, NULL);
    x.pair.a = (ovoid_body){.compound = both, .pose = {{0.1, 0.1, 0.199}, {1, 0, 0, 0}}};
    find(&x);
    CHECK_EQ(x.found.count, 2);
    for (size_t i = 0; i < x.found.count; i++) {
        CHECK_EQ(x.items[i].part_a, i);
        CHECK_EQ(x.points[i].count, 4);
        check_normal(&x, i, (ovoid_vec3){0, 0, 1});
    }
    ovoid_compound_destroy(both);
    end(&x);
}

// One square of two triangles, from both sides: the side of the body's centre counts.
static void test_sheet(void) {
    mesh m = {0};
    for (int i = 0; i < 4; i++) mesh_add_point(&m, i == 0 || i == 3 ? -2 : 2, i < 2 ? -2 : 2, 0);
    mesh_add_triangle(&m, 0, 1, 2);
    mesh_add_triangle(&m, 0, 2, 3);
    scene x;
    begin(&x, mesh_make_solid(&m), make_box(0.5, 0.7, 0.3));
    mesh_clear(&m);
    for (int side = -1; side <= 1; side += 2) {
        x.pair.a.pose.position = (ovoid_vec3){0.1, 0.2, side * 0.299};
        find(&x);
        CHECK_EQ(x.found.count, 1);
        check_normal(&x, 0, (ovoid_vec3){0, 0, side});
        CHECK_EQ(x.points[0].count, 4);
        CHECK_NEAR(x.items[0].manifold.lower, -0.001, 1e-12);
    }
    // Over its border, tilted: the border's edge.
    x.pair.a.pose = (ovoid_pose){{2, 0, 0.299}, {1, 0, 0.02, 0}};
    find(&x);
    CHECK_EQ(x.found.count, 1);
    CHECK_EQ(x.items[0].manifold.axis, OVOID_MANIFOLD_FACE_A);
    end(&x);
}

int main(void) {
    test_ridge();
    test_groove();
    test_corner();
    test_rim();
    test_plate();
    test_kept();
    test_forged();
    test_compound();
    test_sheet();
    return check_end();
}
