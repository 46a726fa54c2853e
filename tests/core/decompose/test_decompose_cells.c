// The upper ends of the two lengths, where the points from below do not hide them. Truth: single cells, whose bounds
// may not be below the distance of any point that the cell has of the solid, or of the part, by brute force in extended
// precision; pieces of a cell or of the solid, whose volumes add up to its own; and searches that end early, whose
// upper ends may not be below closed forms. Tolerances are roundings of coordinates of about 1.
#include "decompositions.h"

#include "decompose/piece.h"
#include "decompose/searches.h"

#define SLACK 1e-12

static long3 as_long(vec3 p, double unit) { return (long3){p.x * unit, p.y * unit, p.z * unit}; }

static vec3 draw_in_box(uint64_t *s, const ovoid_box *b) {
    double x = random_uniform(s, b->min.x, b->max.x), y = random_uniform(s, b->min.y, b->max.y);
    return (vec3){x, y, random_uniform(s, b->min.z, b->max.z)};
}

static vec3 draw_on_surface(uint64_t *s, const ovoid_solid *solid) {
    uint32_t p[3];
    const double *xyz = ovoid_solid_get_points(solid);
    ovoid_solid_get_triangle(solid, random_next(s) % ovoid_solid_get_report(solid).triangles, p);
    double u = random_uniform(s, 0, 1), v = random_uniform(s, 0, 1 - u);
    vec3 a = vec3_at(xyz, p[0]);
    vec3 x = vec3_add_scaled(a, vec3_sub(vec3_at(xyz, p[1]), a), u);
    return vec3_add_scaled(x, vec3_sub(vec3_at(xyz, p[2]), a), v);
}

// From a fiftieth of the size to all of it, anywhere or at the surface.
static cell draw_cell(uint64_t *s, const body *b, uint32_t owner) {
    ovoid_box around = ovoid_solid_get_report(b->solid).box;
    double reach = b->diagonal * b->unit * pow(2, random_uniform(s, -6, -1));
    vec3 middle = random_next(s) % 2 ? draw_in_box(s, &around) : draw_on_surface(s, b->solid);
    cell c = {.bound = INFINITY, .owner = owner};
    for (int i = 0; i < 4; i++) c.corner[i] = vec3_scale(vec3_add(middle, random_vec3(s, reach)), b->inverse);
    return c;
}

// A corner, or a random mean of all.
static vec3 draw_in_cell(uint64_t *s, const cell *c, int number) {
    if (number < 4) return c->corner[number];
    vec3 x = {0, 0, 0};
    double w[4], sum = 0;
    for (int i = 0; i < 4; i++) sum += w[i] = -log(random_uniform(s, 1e-9, 1));
    for (int i = 0; i < 4; i++) x = vec3_add_scaled(x, c->corner[i], w[i] / sum);
    return x;
}

// ---- bounds of cells

typedef struct scene {
    ovoid_solid *solid;
    ovoid_shape *parts[4];
    ovoid_decomposition d;
    ovoid_decomposition_options o;
    body b;
    long_mesh long_solid, long_parts[4];
} scene;

// A part that has faces nearly where the solid's are, or hulls of some of the solid's points, moved.
static void draw_parts(scene *e, uint64_t *s) {
    size_t points = ovoid_solid_get_report(e->solid).points;
    const double *all = ovoid_solid_get_points(e->solid);
    int is_hull = random_next(s) % 2 == 0;
    e->d.part_count = is_hull ? 1 : 1 + random_next(s) % 4;
    for (size_t i = 0; i < e->d.part_count; i++) {
        size_t count = is_hull ? points : 12;
        double *xyz = malloc(3 * count * sizeof *xyz), scale = random_uniform(s, 0.9, 1.1);
        for (size_t k = 0; k < count; k++) {
            const double *from = all + 3 * (is_hull ? k : random_next(s) % points);
            for (int j = 0; j < 3; j++)
                xyz[3 * k + (size_t)j] = is_hull ? scale * from[j] : from[j] + random_uniform(s, -0.1, 0.1);
        }
        e->parts[i] = ovoid_shape_create_from_points(xyz, count, NULL, NULL);
        e->long_parts[i] = long_mesh_of_shape(e->parts[i]);
        free(xyz);
    }
}

static void draw_scene(scene *e, uint64_t *s) {
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    // One in four is convex, so that a part can have all its faces.
    if (random_next(s) % 4)
        mesh_add_random(&m, 1, s);
    else
        mesh_add_star(&m, (ovoid_vec3){0, 0, 0}, 1, 4, 6, 0, s);
    *e = (scene){.solid = mesh_make_solid(&m)};
    mesh_clear(&m);
    draw_parts(e, s);
    e->d.solid = e->solid;
    e->d.parts = (const ovoid_shape *const *)e->parts;
    e->long_solid = long_mesh_of_solid(e->solid);
    CHECK_EQ(body_validate_options(NULL, &e->o, NULL), OVOID_OK);
    CHECK_EQ(body_open_parts(&e->b, &e->d, &e->o, NULL), OVOID_OK);
}

static void clear_scene(scene *e) {
    body_close(&e->b);
    for (size_t i = 0; i < e->d.part_count; i++) {
        free(e->long_parts[i].corners);
        ovoid_shape_destroy(e->parts[i]);
    }
    free(e->long_solid.corners);
    ovoid_solid_destroy(e->solid);
}

static cell_search make_search(scene *e, double lower) {
    return (cell_search){.problem = &e->b, .tolerance = 1e-9, .ceiling = INFINITY, .lower = lower, .options = &e->o};
}

static void check_uncovered(scene *e, double lower, uint64_t *s) {
    cell_search search = make_search(e, lower);
    uncovered_set_functions(&search);
    cell c = draw_cell(s, &e->b, (uint32_t)(random_next(s) % e->d.part_count));
    search.find_bound(&search, &c);
    for (int i = 0; i < 16; i++) {
        long3 x = as_long(draw_in_cell(s, &c, i), e->b.unit);
        if (long_mesh_distance(&e->long_solid, x) > 0) continue;
        CHECK_LE((double)long_parts_distance(e->long_parts, &e->d, x), c.bound * e->b.unit + SLACK);
    }
}

static void check_excess(scene *e, double lower, uint64_t *s) {
    cell_search search = make_search(e, lower);
    excess_set_functions(&search);
    cell c = draw_cell(s, &e->b, (uint32_t)(random_next(s) % e->d.part_count));
    search.find_bound(&search, &c);
    for (int i = 0; i < 16; i++) {
        long3 x = as_long(draw_in_cell(s, &c, i), e->b.unit);
        if (long_mesh_distance(&e->long_parts[c.owner], x) > 0) continue;
        CHECK_LE((double)long_mesh_distance(&e->long_solid, x), c.bound * e->b.unit + SLACK);
    }
}

static void check_bounds(int rounds) {
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = 1000 + (uint64_t)i;
        scene e;
        draw_scene(&e, &s);
        for (int k = 0; k < 100; k++) {
            // With a lower end that is known already, a search stops to look sooner.
            double lower = k % 2 ? 0 : e.b.diagonal * random_uniform(&s, 0, 0.2);
            check_uncovered(&e, lower, &s);
            check_excess(&e, lower, &s);
        }
        clear_scene(&e);
    }
    check_seed = 0;
}

// The k-th of the 48 ways to name axes and turn them round.
static vec3 swap_axes(vec3 x, int k) {
    const double c[3] = {k & 1 ? -x.x : x.x, k & 2 ? -x.y : x.y, k & 4 ? -x.z : x.z};
    int i = k / 8 % 3, j = (i + 1 + k / 24) % 3;
    return (vec3){c[i], c[j], c[3 - i - j]};
}

// A box whose upper face has a small square in its middle, so that no triangle is near all of a large cell.
static void add_box_with_square(mesh *m, vec3 low, vec3 high) {
    mesh_add_box(m, low, high, 0);
    // The last two faces take the places of the upper one.
    m->triangles -= 2;
    memcpy(m->indices + 6, m->indices + 30, 6 * sizeof *m->indices);
    const uint32_t outer[4] = {4, 5, 7, 6};
    for (int i = 0; i < 4; i++) mesh_add_point(m, i == 1 || i == 2 ? 0.1 : -0.1, i >= 2 ? 0.1 : -0.1, high.z);
    for (uint32_t i = 0; i < 4; i++) {
        uint32_t j = (i + 1) % 4;
        mesh_add_triangle(m, outer[i], outer[j], 8 + j);
        mesh_add_triangle(m, outer[i], 8 + j, 8 + i);
    }
    mesh_add_triangle(m, 8, 9, 10);
    mesh_add_triangle(m, 8, 10, 11);
}

// A box as the solid, and as the part one that is higher by 0.3. The cell's middle is 0.05 below the solid's top, one
// corner at the part's, 0.3 from the solid; another reaches far beyond a side that both have, 0.9 from the middle. The
// depth below that side must not stand for that below the top, whichever triangle is looked at first.
static void check_unlike_faces(void) {
    static const vec3 corners[4] = {{1, 0, -0.1}, {-0.3, 0, 0.35}, {-0.35, 0.5, -0.125}, {-0.35, -0.5, -0.125}};
    const vec3 low = {-2, -2, -2};
    for (int k = 0; k < 48; k++) {
        mesh m = {NULL, NULL, 0, 0, 0, 0};
        add_box_with_square(&m, low, (vec3){0.9, 2, 0.05});
        for (size_t i = 0; i < m.points; i++) {
            vec3 x = swap_axes(vec3_at(m.xyz, i), k);
            memcpy(m.xyz + 3 * i, &x, sizeof x);
        }
        ovoid_shape *part = make_box_between(swap_axes(low, k), swap_axes((vec3){0.9, 2, 0.35}, k));
        scene e = {.solid = mesh_make_solid(&m), .d = {.parts = (const ovoid_shape *const *)&part, .part_count = 1}};
        e.d.solid = e.solid;
        CHECK(ovoid_solid_get_report(e.solid).is_closed);
        CHECK_EQ(body_validate_options(NULL, &e.o, NULL), OVOID_OK);
        CHECK_EQ(body_open_parts(&e.b, &e.d, &e.o, NULL), OVOID_OK);
        cell_search search = make_search(&e, 0);
        excess_set_functions(&search);
        cell c = {.bound = INFINITY};
        for (int i = 0; i < 4; i++) c.corner[i] = vec3_scale(swap_axes(corners[i], k), e.b.inverse);
        search.find_bound(&search, &c);
        CHECK_LE(0.3, c.bound * e.b.unit + SLACK);
        CHECK_LE(c.bound * e.b.unit, 0.9);
        body_close(&e.b);
        ovoid_shape_destroy(part);
        ovoid_solid_destroy(e.solid);
        mesh_clear(&m);
    }
}

// ---- pieces of cells

static long double find_volume(const cell *c) {
    long3 a = as_long(c->corner[0], 1), e[3];
    for (int i = 0; i < 3; i++) e[i] = long3_sub(as_long(c->corner[i + 1], 1), a);
    return fabsl(long3_dot(e[0], long3_cross(e[1], e[2]))) / 6;
}

static void check_pieces(const cell *c, const cell *pieces, uint32_t count) {
    long double sum = 0;
    box around = cell_compute_box(c);
    for (uint32_t i = 0; i < count; i++) {
        sum += find_volume(&pieces[i]);
        box own = cell_compute_box(&pieces[i]);
        CHECK_LE(box_compute_distance(&own, &around), 0);
        CHECK(own.min.x >= around.min.x - SLACK && own.max.x <= around.max.x + SLACK);
        CHECK_EQ(pieces[i].owner, c->owner);
        CHECK_EQ(pieces[i].depth, c->depth + 1);
    }
    CHECK_NEAR((double)sum, (double)find_volume(c), SLACK);
}

static void check_cuts(int rounds) {
    int seen[3] = {0, 0, 0};
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = 5000 + (uint64_t)i;
        cell c = {.bound = 3, .owner = 7, .depth = 11}, pieces[CELL_PIECES];
        for (int k = 0; k < 4; k++) c.corner[k] = random_vec3(&s, 1);
        check_pieces(&c, pieces, cell_halve(&c, pieces));
        ovoid_plane plane = {vec3_unit(random_vec3(&s, 1)), random_uniform(&s, -0.5, 0.5)};
        uint32_t first_above = 0, count = cell_cut(&c, &plane, pieces, &first_above);
        if (!count) continue;
        check_pieces(&c, pieces, count);
        seen[first_above == 1 ? 0 : count == 6 ? 1 : 2]++;
        for (uint32_t k = 0; k < count; k++)
            for (int j = 0; j < 4; j++) {
                double above = vec3_dot(plane.normal, pieces[k].corner[j]) - plane.offset;
                CHECK_LE(k < first_above ? above : -above, SLACK);
            }
    }
    for (int i = 0; i < 3; i++) CHECK(seen[i] > rounds / 20);
    check_seed = 0;
}

// ---- pieces of the solid

static double find_piece_volume(const piece *p) {
    ovoid_shape *shape = ovoid_shape_create_from_points(&p->points[0].x, p->point_count, NULL, NULL);
    ovoid_polytope faces = ovoid_shape_get_polytope(shape);
    double volume = ovoid_polytope_compute_measures(&faces).volume;
    ovoid_shape_destroy(shape);
    return volume;
}

// A cube cut by random planes that go on from piece to piece: what meets inside, far from all triangles, is a corner of
// all pieces around it, and the volumes of their hulls add up to the cube's.
static void check_divided(int rounds) {
    enum { PLANES = 4 };
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_box(&m, (vec3){-1, -1, -1}, (vec3){1, 1, 1}, 0);
    ovoid_solid *cube = mesh_make_solid(&m);
    mesh_clear(&m);
    ovoid_decomposition_options o;
    body b;
    CHECK_EQ(body_validate_options(NULL, &o, NULL), OVOID_OK);
    CHECK_EQ(body_open(&b, cube, &o, NULL), OVOID_OK);
    double unit = 1 / (b.unit * b.unit * b.unit);
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = 9000 + (uint64_t)i;
        piece pieces[1 << PLANES];
        size_t count = 1;
        CHECK_EQ(piece_create(&b, &pieces[0], NULL), OVOID_OK);
        for (int k = 0; k < PLANES; k++) {
            ovoid_plane plane = {vec3_unit(random_vec3(&s, 1)), 0.3 * b.inverse * random_uniform(&s, -1, 1)};
            for (size_t j = count; j-- > 0;) {
                piece sides[2];
                int is_cut;
                CHECK_EQ(piece_divide(&b, &pieces[j], &plane, sides, &is_cut, NULL), OVOID_OK);
                if (!is_cut) continue;
                piece_destroy(&b, &pieces[j]);
                pieces[j] = sides[0];
                pieces[count++] = sides[1];
            }
        }
        CHECK(count > 8);
        double volume = 0;
        for (size_t j = 0; j < count; j++) {
            volume += find_piece_volume(&pieces[j]);
            piece_destroy(&b, &pieces[j]);
        }
        // Slivers thinner than what counts as on a plane may be lost.
        CHECK_NEAR(volume, 8 * unit, 1e-6);
    }
    body_close(&b);
    ovoid_solid_destroy(cube);
    check_seed = 0;
}

// A sheet in the plane of a cut, with nothing beside it, goes to the piece below: none of it is lost.
static void check_sheet(void) {
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_box(&m, (vec3){-1, -1, -1}, (vec3){1, 1, 1}, 0);
    mesh_add_box(&m, (vec3){-1, -1, 3}, (vec3){1, 1, 4}, 0);
    mesh_add_box(&m, (vec3){-1, -1, 2}, (vec3){1, 1, 2}, 0);
    ovoid_solid *s = mesh_make_solid(&m);
    ovoid_decomposition_options o;
    body b;
    CHECK_EQ(body_validate_options(NULL, &o, NULL), OVOID_OK);
    CHECK_EQ(body_open(&b, s, &o, NULL), OVOID_OK);
    piece whole, sides[2];
    int is_cut = 0;
    ovoid_plane plane = {{0, 0, 1}, 2 * b.inverse};
    CHECK_EQ(piece_create(&b, &whole, NULL), OVOID_OK);
    CHECK_EQ(piece_divide(&b, &whole, &plane, sides, &is_cut, NULL), OVOID_OK);
    if (CHECK(is_cut)) {
        box below = box_make_around(&sides[0].points[0].x, sides[0].point_count);
        box above = box_make_around(&sides[1].points[0].x, sides[1].point_count);
        CHECK_NEAR(below.max.z * b.unit, 2, SLACK);
        CHECK_NEAR(above.min.z * b.unit, 3, SLACK);
        for (int i = 0; i < 2; i++) piece_destroy(&b, &sides[i]);
    }
    piece_destroy(&b, &whole);
    body_close(&b);
    ovoid_solid_destroy(s);
    mesh_clear(&m);
}

// ---- searches that end early

static void check_length(const ovoid_decomposition_length *l, double truth) {
    CHECK_LE(l->lower, truth + SLACK);
    CHECK_LE(truth, l->upper + SLACK);
}

// A cube of 2, turned, and two halves of it with a gap of 0.2 between them: no corner of the cube is uncovered, its
// middle is, by 0.1. And a cube with a hole of 1 in its middle: the cube as a part stands out of it by 1/2.
static void check_few_cells(void) {
    uint64_t s = 11;
    ovoid_pose turned = {{0, 0, 0}, random_quat(&s)};
    mesh m = {NULL, NULL, 0, 0, 0, 0}, parts = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_box(&m, (vec3){-1, -1, -1}, (vec3){1, 1, 1}, 0);
    mesh_add_box(&parts, (vec3){-1, -1, -1}, (vec3){-0.1, 1, 1}, 0);
    mesh_add_box(&parts, (vec3){0.1, -1, -1}, (vec3){1, 1, 1}, 0);
    mesh hollow = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_box(&hollow, (vec3){-1, -1, -1}, (vec3){1, 1, 1}, 0);
    mesh_add_box(&hollow, (vec3){-0.5, -0.5, -0.5}, (vec3){0.5, 0.5, 0.5}, 1);
    mesh *all[3] = {&m, &parts, &hollow};
    for (int k = 0; k < 3; k++)
        for (size_t i = 0; i < all[k]->points; i++) {
            vec3 x = ovoid_pose_compute_point(&turned, vec3_at(all[k]->xyz, i));
            memcpy(all[k]->xyz + 3 * i, &x, sizeof x);
        }
    ovoid_solid *cube = mesh_make_solid(&m), *with_hole = mesh_make_solid(&hollow);
    ovoid_shape *halves[2], *whole = ovoid_shape_create_from_points(m.xyz, 8, NULL, NULL);
    for (size_t i = 0; i < 2; i++) halves[i] = ovoid_shape_create_from_points(parts.xyz + 24 * i, 8, NULL, NULL);
    ovoid_decomposition gap = {cube, (const ovoid_shape *const *)halves, 2};
    ovoid_decomposition hole = {with_hole, (const ovoid_shape *const *)&whole, 1};
    for (size_t work = 1; work < 5000; work += 1 + work / 2) {
        ovoid_decomposition_options o = {.tolerance = 1e-6, .work = work, .cells = 4096};
        ovoid_decomposition_proof p;
        double excess[2];
        o.excesses = excess;
        CHECK_EQ(ovoid_decomposition_compute_proof(&gap, &o, &p, NULL), OVOID_OK);
        check_length(&p.uncovered, 0.1);
        check_length(&p.excess, 0);
        CHECK_EQ(ovoid_decomposition_compute_proof(&hole, &o, &p, NULL), OVOID_OK);
        check_length(&p.uncovered, 0);
        check_length(&p.excess, 0.5);
        CHECK_LE(0.5, excess[0] + SLACK);
    }
    for (int i = 0; i < 2; i++) ovoid_shape_destroy(halves[i]);
    ovoid_shape_destroy(whole);
    ovoid_solid_destroy(cube);
    ovoid_solid_destroy(with_hole);
    for (int k = 0; k < 3; k++) mesh_clear(all[k]);
}

// A part as large as may be around a solid as small: nothing is uncovered, and the part's corners stand out.
static void check_much_larger(void) {
    mesh m = {NULL, NULL, 0, 0, 0, 0};
    mesh_add_angle(&m, 4e-60, 1e-60, 1e-60);
    ovoid_solid *s = mesh_make_solid(&m);
    ovoid_shape *part = make_box_between((vec3){-1e40, -1e40, -1e40}, (vec3){1e40, 1e40, 1e40});
    ovoid_decomposition d = {s, (const ovoid_shape *const *)&part, 1};
    ovoid_decomposition_options o = {.work = 1000};
    ovoid_decomposition_proof p;
    CHECK_EQ(ovoid_decomposition_compute_proof(&d, &o, &p, NULL), OVOID_OK);
    CHECK_EQ(p.uncovered.lower, 0);
    CHECK_NEAR(p.excess.lower / 1e40, sqrt(3), 0.01);
    CHECK_LE(sqrt(3), p.excess.upper / 1e40 + SLACK);
    ovoid_shape_destroy(part);
    ovoid_solid_destroy(s);
    mesh_clear(&m);
}

int main(void) {
    check_bounds(24);
    check_unlike_faces();
    check_cuts(2000);
    check_divided(12);
    check_sheet();
    check_few_cells();
    check_much_larger();
    return check_end();
}
