// Covers of motions. Truth: kinematics in long double, straight from the description, of robots that are made to break
// bounds. No centre of a ball may leave its second order by more than its rest says, in the world and as seen from
// another body; no test in lanes may call far what is no farther than its reach at some sampled time. Bounds must be
// nearly reached, and half the distance mostly shown, so that neither is merely large. Balls are audited by the search
// of robot_spheres.h. Verdicts: those of the search with steps, whose every step is verified; what is called free is
// swept in long double too. All instruction sets give the same bits.
#include "check.h"
#include "options.h"
#include "path_machines.h"

#include "ovoid/robot_path.h"
#include "ovoid/robot_spheres.h"
#include "robot/path/cover.h"

enum { TRIALS = 200, SAMPLES = 32, SHAPES = 10, EDGES = 150, OBSTACLES = 5, SWEEP = 40 };

typedef struct tally {
    long far, asked;
    double most;
} tally;
static tally world, relative, boxes, points, point, slabs, hulls;

static real3 add3(real3 a, real3 b, real by) { return (real3){a.x + by * b.x, a.y + by * b.y, a.z + by * b.z}; }
static real dot3(real3 a, real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static real norm3(real3 a) { return sqrtl(dot3(a, a)); }
static real3 widen(vec3 v) { return (real3){v.x, v.y, v.z}; }
static real3 load(double (*column)[COVER8], int lane) {
    return (real3){column[0][lane], column[1][lane], column[2][lane]};
}

// ---- balls that cover

static ovoid_shape *make_shape(uint64_t *s, int which) {
    double xyz[96];
    for (int i = 0; i < 96; i++)
        xyz[i] = random_uniform(s, -0.3, 0.2) * (i % 3 == which % 3 ? 3 : 1) + (which == 7 ? 1e3 : 0);
    switch (which) {
    case 0: return ovoid_shape_create_box((ovoid_vec3){0.1, 0.5, 0.2}, NULL, &error);
    case 1: return ovoid_shape_create_sphere(0.1, NULL, &error);
    case 2: return ovoid_shape_create_capsule(0.03, 0.2, NULL, &error);
    case 3: return ovoid_shape_create_cylinder(0.1, 0.2, NULL, &error);
    case 4: return ovoid_shape_create_from_points(xyz, 32, &(ovoid_shape_options){.radius = 0.03}, &error);
    case 5: return ovoid_shape_create_from_points((double[]){0, 0, 0, 1, 0, 0, 0, 1, 0}, 3, NULL, &error);
    // Of few corners a piece's ball hangs on those that cuts make.
    case 8: return ovoid_shape_create_from_points(xyz, 4, NULL, &error);
    case 9: return ovoid_shape_create_from_points(xyz, 6, NULL, &error);
    default: return ovoid_shape_create_from_points(xyz, 32, NULL, &error);
    }
}

// The robot of one link with one element.
static ovoid_robot *make_lone(const ovoid_shape *shape) {
    static const ovoid_robot_link link = {"lone"};
    const ovoid_robot_element element = {0, NULL, shape, {{0, 0, 0}, {1, 0, 0, 0}}, NULL};
    const ovoid_robot_description d = {.links = &link, .link_count = 1, .elements = &element, .element_count = 1};
    return ovoid_robot_create(&d, NULL, &error);
}

static void check_audit(const ovoid_robot *r, const outer_ball *balls, uint32_t count) {
    ovoid_robot_sphere spheres[OUTER_BALLS];
    for (uint32_t i = 0; i < count; i++) spheres[i] = (ovoid_robot_sphere){balls[i].center, balls[i].radius};
    ovoid_robot_sphere_model model = {r, 0, spheres, count};
    // Balls that touch the corners of the body to rounding are shown to cover with 1e-10 of it to spare.
    for (uint32_t i = 0; i < count; i++) spheres[i].radius *= 1 + 1e-10;
    ovoid_robot_audit_options o = {.without_volumes = 1, .tolerance = 1e-12, .depth_cells = 1 << 13};
    ovoid_robot_sphere_audit audit;
    CHECK_EQ(ovoid_robot_compute_sphere_audit(&model, &o, &audit, &error), OVOID_OK);
    CHECK_LE(audit.depth.lower, 0);
    CHECK_LE(audit.depth.upper, 1e-5);
}

// Points of the hull of the vertices, thickened: each in a ball, to the bit.
static void check_points(uint64_t *s, const ovoid_shape *shape, const outer_balls *outer) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    for (int i = 0; i < 4000; i++) {
        real3 x = {0, 0, 0};
        real sum = 0, least = INFINITY, radius = shape->lower_radius;
        int corners = 1 + (int)random_below(s, 4);
        for (int k = 0; k < corners; k++) {
            real weight = random_uniform(s, 0, 1);
            x = add3(x, widen(vec3_at(p.vertices, random_below(s, p.vertex_count))), weight);
            sum += weight;
        }
        x = add3((real3){p.origin.x, p.origin.y, p.origin.z}, x, 1 / sum);
        for (uint32_t k = 0; k < outer->count; k++)
            least =
                fminl(least, norm3(add3(x, widen(outer->balls[k].center), -1)) + radius - (real)outer->balls[k].radius);
        CHECK_LE((double)least, 0);
        CHECK(norm3(add3(x, widen(outer->one.center), -1)) + radius <= (real)outer->one.radius);
    }
}

static void test_balls(void) {
    uint64_t s = 5;
    for (int i = 0; i < 20 * SHAPES; i++) {
        check_seed = (uint64_t)i;
        ovoid_shape *shape = make_shape(&s, i % SHAPES);
        ovoid_robot *r = shape ? make_lone(shape) : NULL;
        if (!r) printf("%s\n", error.message), exit(1);
        const outer_balls *outer = &robot_get_inside(r, 0)->outer;
        double most = 0;
        for (uint32_t k = 0; k < outer->count; k++) most = fmax(most, outer->balls[k].radius);
        // What is longer than thick is cut into pieces that are smaller.
        if (i % SHAPES != 1 && i % SHAPES != 5 && i % SHAPES < 8)
            CHECK(outer->count == OUTER_BALLS && most < 0.75 * outer->one.radius);
        check_points(&s, shape, outer);
        if (i < 2 * SHAPES) {
            check_audit(r, outer->balls, outer->count);
            check_audit(r, &outer->one, 1);
        }
        ovoid_robot_destroy(r);
        ovoid_shape_destroy(shape);
    }
    check_seed = 0;
}

// ---- the bounds of motions

typedef struct trial {
    machine m;
    path_work w;
    path_cover c;
    uint8_t *masks;
    double ends[2][2][3 * JOINTS]; // of two segments: first and last state
    cover_lanes lanes;
} trial;

static void add_segment(trial *t, const double *q0, const double *q1) {
    CHECK_EQ(path_set_segment(&t->w, q0, q1, INFINITY, &error), OVOID_OK);
    path_cover_add(&t->c, q0, q1, COVER8);
}

static void begin_segments(trial *t) {
    const ovoid_robot_cell *cell = t->m.cell;
    size_t groups = cell->boxes.count, count = cell->items.count * groups + (cell->pairs.count + 7) / 8 + 1;
    if (!t->masks) t->masks = malloc(count);
    memset(t->masks, 0xff, count);
    path_cover_begin(&t->c, &(cover_query){.queried = t->masks, .mask_groups = (uint32_t)groups});
}

// The machine's own segment, and one along which other joints move, or the same ones by less or more.
static void make_ends(uint64_t *s, trial *t) {
    size_t count = ovoid_robot_get_variable_count(t->m.r);
    for (int k = 0; k < 2; k++) memcpy(t->ends[0][k], t->m.q[k], count * sizeof(double));
    for (size_t i = 0; i < count; i++) {
        double change = t->m.q[1][i] - t->m.q[0][i];
        t->ends[1][0][i] = t->m.q[1][i];
        t->ends[1][1][i] = t->m.q[1][i] + (random_below(s, 3) ? random_uniform(s, -2, 2) * change : 0);
    }
}

static void open_trial(uint64_t *s, trial *t) {
    make_machine(s, &t->m);
    ovoid_allocator memory = t->m.cell->allocator;
    CHECK_EQ(path_work_create(&t->w, t->m.cell, &memory, &error), OVOID_OK);
    CHECK(path_cover_create(&t->c, &t->w));
    make_ends(s, t);
    // Eighths of an interval, of the whole segment or of a part of it that a wrist of many turns turns little in.
    double parts = (double)(1u << random_below(s, 9)), begin = random_below(s, (uint32_t)parts) / parts;
    int has_two = random_below(s, 2) == 0;
    for (int k = 0; k < COVER8; k++) {
        t->lanes.begin[k] = begin + k / (COVER8 * parts);
        t->lanes.end[k] = begin + (k + 1) / (COVER8 * parts);
        t->lanes.segment[k] = (uint8_t)(has_two && random_below(s, 2));
    }
    t->lanes.used = 0xff;
    // Along another segment everything moved.
    double other[3 * JOINTS];
    for (size_t i = 0; i < ovoid_robot_get_variable_count(t->m.r); i++)
        other[i] = t->m.q[0][i] + random_uniform(s, 1, 2);
    const cover_lanes before = {{0}, {1, 1, 1, 1, 1, 1, 1, 1}, {0}, 0xff};
    begin_segments(t);
    add_segment(t, t->m.q[0], other);
    path_cover_set(&t->c);
    cover_open_block(&t->c, &before);
    begin_segments(t);
    for (int k = 0; k <= has_two; k++) add_segment(t, t->ends[k][0], t->ends[k][1]);
    path_cover_set(&t->c);
    cover_open_block(&t->c, &t->lanes);
}

static void close_trial(trial *t) {
    free(t->masks);
    path_cover_destroy(&t->c);
    path_work_destroy(&t->w);
    destroy_machine(&t->m);
}

// Time from -1 to 1 over a lane, as s of the segment.
static real get_time(const trial *t, int lane, real time) {
    return (t->lanes.begin[lane] + (real)t->lanes.end[lane]) / 2 +
           time * (t->lanes.end[lane] - (real)t->lanes.begin[lane]) / 2;
}

// The state of a lane's segment there.
static void find_state(const trial *t, int lane, real time, real *q) {
    const double(*ends)[3 * JOINTS] = t->ends[t->lanes.segment[lane]];
    for (size_t i = 0; i < ovoid_robot_get_variable_count(t->m.r); i++)
        q[i] = ends[0][i] + get_time(t, lane, time) * ((real)ends[1][i] - ends[0][i]);
}

static real3 look_from(const frame *f, real3 x) {
    real3 d = add3(x, f->p, -1);
    return (real3){f->m[0][0] * d.x + f->m[1][0] * d.y + f->m[2][0] * d.z,
                   f->m[0][1] * d.x + f->m[1][1] * d.y + f->m[2][1] * d.z,
                   f->m[0][2] * d.x + f->m[1][2] * d.y + f->m[2][2] * d.z};
}

// A centre of an item at a time of a lane, in the world; `from`: in the frame of that item's link.
static real3 find_center(const trial *t, uint32_t item, vec3 center, const uint32_t *from, int lane, real time) {
    real q[3 * JOINTS];
    frame links[JOINTS + 1];
    find_state(t, lane, time, q);
    place(t->m.r, q, links);
    real3 x = apply(&links[t->c.items[item].link], widen(center));
    return from ? look_from(&links[t->c.items[*from].link], x) : x;
}

static real evaluate_rest(const motion_rest *r, real h) {
    return r->constant + h * (r->first + h * (r->second + h * (real)r->third));
}

// In the world: what the kernels compute and the truth, in all lanes.
static void check_world(uint64_t *s, trial *t, uint32_t item) {
    const cover_item *it = &t->c.items[item];
    uint32_t which = random_below(s, it->count + 1);
    vec3 center = which < it->count ? it->balls[which].center : it->one.center;
    const double own[3] = {center.x, center.y, center.z};
    moving8 link = cover_get_link(&t->c, item);
    motion8 motion;
    t->c.kernels->move(&link, own, &motion);
    for (int lane = 0; lane < COVER8; lane += 3) {
        real rest = evaluate_rest(&it->rest, t->c.half[lane]);
        for (int k = -SAMPLES; k <= SAMPLES; k += 8) {
            real time = (real)k / SAMPLES;
            real3 x = add3(load(&motion.column[0], lane), load(&motion.column[3], lane), time);
            x = add3(x, load(&motion.column[6], lane), 2 * time * time);
            real off = norm3(add3(x, find_center(t, item, center, NULL, lane, time), -1));
            CHECK(off <= rest);
            if (rest < 10 * t->m.scale) world.most = fmax(world.most, (double)(off / rest));
        }
        world.asked++;
    }
}

// Seen from a body: derivatives by differences of the truth, five points a hundredth of the interval apart, which are
// right to 1e-8 of the lengths where joints turn by less than a radian in half of it.
static void check_point(trial *t, uint32_t from, uint32_t item, vec3 center, const motion_rest *of_point) {
    const motion_rest rest = *of_point;
    int lane = 3;
    real h = t->c.half[lane], d = 0.01L, most = rest.third * h * h * h;
    if (rest.turn * h > 1 || t->c.items[item].size.slide * h > t->m.scale) return;
    real3 y[5];
    for (int k = 0; k < 5; k++) y[k] = find_center(t, item, center, &from, lane, (k - 2) * d);
    real3 v = add3(add3(add3(add3((real3){0, 0, 0}, y[3], 8), y[1], -8), y[4], -1), y[0], 1);
    real3 a = add3(add3(add3(add3(add3((real3){0, 0, 0}, y[2], -30), y[3], 16), y[1], 16), y[4], -1), y[0], -1);
    for (int k = -SAMPLES; k <= SAMPLES; k += 8) {
        real time = (real)k / SAMPLES;
        real3 x = add3(add3(y[2], v, time / (12 * d)), a, time * time / (24 * d * d));
        real off = norm3(add3(x, find_center(t, item, center, &from, lane, time), -1));
        CHECK(off <= most + 1e-7L * t->m.scale);
        if (most > 1e-4L * t->m.scale) relative.most = fmax(relative.most, (double)(off / most));
    }
    relative.asked++;
}

// The centre of a body's ball, and a vertex.
static void check_relative(uint64_t *s, trial *t, uint32_t pair, int is_from_b) {
    item_pair both = cell_pairs(t->m.cell)[pair];
    uint32_t from = is_from_b ? both.b : both.a, item = is_from_b ? both.a : both.b;
    const cover_item *it = &t->c.items[item];
    motion_rest rest = cover_find_pair_rest(&t->c, pair, is_from_b), hull = cover_find_hull_rest(&rest, it->one.radius);
    check_point(t, from, item, it->one.center, &rest);
    check_point(t, from, item, vec3_at(it->vertices, random_below(s, it->vertex_count)), &hull);
}

// A test in lanes: with a reach that comes to the distance in truth it must not say far; with half of it, it may.
static void count_far(tally *to, unsigned near_at_all, unsigned near_half, const real least[COVER8]) {
    for (int lane = 0; lane < COVER8; lane++) {
        CHECK(near_at_all >> lane & 1);
        if (!(least[lane] > 0)) continue;
        to->asked++;
        to->far += !(near_half >> lane & 1);
    }
}

static void set_reach(const trial *t, const motion_rest *rest, const real least[COVER8], double share, double *reach) {
    cover_compute_reach(&t->c, rest, 0, reach);
    for (int k = 0; k < COVER8; k++) reach[k] += share * (double)fmaxl(least[k], 0) * (1 + 1e-12);
}

static real find_box_distance(const cover_boxes *b, real3 x) {
    mat3 r = b->rotation;
    const real3 axes[3] = {{r.r0.x, r.r1.x, r.r2.x}, {r.r0.y, r.r1.y, r.r2.y}, {r.r0.z, r.r1.z, r.r2.z}};
    real square = 0;
    for (int k = 0; k < 3; k++) {
        real out = fmaxl(fabsl(dot3(axes[k], x) - b->boxes->center[k]) - b->boxes->half[k], 0);
        square += out * out;
    }
    return sqrtl(square);
}

static void check_box(uint64_t *s, trial *t, uint32_t item) {
    const cover_item *it = &t->c.items[item];
    double scale = t->m.scale;
    cover_box box = {
        {scale * random_normal(s), scale * random_normal(s), scale * random_normal(s)},
        {scale * random_uniform(s, 0, 0.5), scale * random_uniform(s, 0, 0.5), scale * random_uniform(s, 0, 0.5)},
        0};
    const cover_boxes all = {quat_to_mat3(random_pose(s, 1).rotation), &box, 1};
    const double own[3] = {it->one.center.x, it->one.center.y, it->one.center.z};
    moving8 link = cover_get_link(&t->c, item);
    motion8 motion;
    t->c.kernels->move(&link, own, &motion);
    real least[COVER8];
    for (int lane = 0; lane < COVER8; lane++) {
        least[lane] = INFINITY;
        for (int k = -SAMPLES; k <= SAMPLES; k += 4)
            least[lane] =
                fminl(least[lane],
                      find_box_distance(&all, find_center(t, item, it->one.center, NULL, lane, (real)k / SAMPLES)));
    }
    double reach[COVER8];
    unsigned char full, half;
    set_reach(t, &it->rest, least, 1, reach);
    t->c.kernels->near_moving(&all, &motion, reach, &full);
    set_reach(t, &it->rest, least, 0.5, reach);
    t->c.kernels->near_moving(&all, &motion, reach, &half);
    count_far(&boxes, full, half, least);
}

// The distance of a point from the box that an element is.
static real find_element_distance(const trial *t, uint32_t item, real3 in_link) {
    const cell_item *it = &cell_items(t->m.cell)[item];
    frame own = make_frame(&it->in_link);
    real3 x = look_from(&own, in_link), h = widen(it->half), m = widen(it->middle);
    real3 d = add3(x, m, -1);
    real3 out = {fmaxl(fabsl(d.x) - h.x, 0), fmaxl(fabsl(d.y) - h.y, 0), fmaxl(fabsl(d.z) - h.z, 0)};
    return norm3(out);
}

// A pair's two balls, in the world and seen from the first; the second's ball and the first's slabs.
static void check_balls(trial *t, uint32_t pair, int is_from_b) {
    item_pair both = cell_pairs(t->m.cell)[pair];
    uint32_t from = is_from_b ? both.b : both.a, item = is_from_b ? both.a : both.b;
    const cover_item *a = &t->c.items[from], *b = &t->c.items[item];
    moving8 links[2] = {cover_get_link(&t->c, from), cover_get_link(&t->c, item)};
    const double centers[2][3] = {{a->one.center.x, a->one.center.y, a->one.center.z},
                                  {b->one.center.x, b->one.center.y, b->one.center.z}};
    motion8 motions[2];
    for (int k = 0; k < 2; k++) t->c.kernels->move(&links[k], centers[k], &motions[k]);
    real apart[COVER8], from_body[COVER8];
    for (int lane = 0; lane < COVER8; lane++) {
        apart[lane] = from_body[lane] = INFINITY;
        for (int k = -SAMPLES; k <= SAMPLES; k += 4) {
            real3 x = find_center(t, item, b->one.center, &from, lane, (real)k / SAMPLES);
            apart[lane] = fminl(apart[lane], norm3(add3(x, widen(a->one.center), -1)));
            from_body[lane] = fminl(from_body[lane], find_element_distance(t, from, x));
        }
    }
    double reach[2][COVER8];
    motion_rest rest = cover_find_pair_rest(&t->c, pair, is_from_b), sum = a->rest;
    sum.constant += b->rest.constant, sum.first += b->rest.first;
    sum.second += b->rest.second, sum.third += b->rest.third;
    for (int k = 0; k < 2; k++) set_reach(t, &sum, apart, k ? 0.5 : 1, reach[k]);
    count_far(&points, t->c.kernels->near_points(&motions[0], &motions[1], reach[0]),
              t->c.kernels->near_points(&motions[0], &motions[1], reach[1]), apart);
    for (int k = 0; k < 2; k++) set_reach(t, &rest, apart, k ? 0.5 : 1, reach[k]);
    count_far(&point, t->c.kernels->near_point(&motions[1], &motions[0], &links[0], reach[0]),
              t->c.kernels->near_point(&motions[1], &motions[0], &links[0], reach[1]), apart);
    for (int k = 0; k < 2; k++) set_reach(t, &rest, from_body, k ? 0.5 : 1, reach[k]);
    count_far(&slabs, t->c.kernels->near_slabs(&motions[1], &links[0], &a->slabs, reach[0]),
              t->c.kernels->near_slabs(&motions[1], &links[0], &a->slabs, reach[1]), from_body);
}

// The vertices of the second along a normal that is fixed in the first.
static void check_hull(uint64_t *s, trial *t, uint32_t pair, int is_from_b) {
    item_pair both = cell_pairs(t->m.cell)[pair];
    uint32_t from = is_from_b ? both.b : both.a, item = is_from_b ? both.a : both.b;
    const cover_item *a = &t->c.items[from], *b = &t->c.items[item];
    // Towards the other body in the middle, or anywhere.
    vec3 normal = vec3_unit(random_vec3(s, 1));
    if (random_below(s, 3)) {
        real3 x = find_center(t, item, b->one.center, &from, 3, 0);
        x = add3(x, widen(a->one.center), -1);
        if (norm3(x) > 0) normal = vec3_unit((vec3){(double)x.x, (double)x.y, (double)x.z});
    }
    double support = -INFINITY;
    for (uint32_t i = 0; i < a->vertex_count; i++) support = fmax(support, vec3_dot(normal, vec3_at(a->vertices, i)));
    const moving_hull hull = {cover_get_link(&t->c, from),
                              cover_get_link(&t->c, item),
                              b->clusters,
                              b->count,
                              b->one.center,
                              b->one.radius,
                              normal,
                              support};
    real least[COVER8];
    for (int lane = 0; lane < COVER8; lane++) {
        least[lane] = INFINITY;
        for (int k = -SAMPLES; k <= SAMPLES; k += 4) {
            real3 in_a[VERTICES], in_b[VERTICES];
            real q[3 * JOINTS], most = -INFINITY;
            find_state(t, lane, (real)k / SAMPLES, q);
            place_in_state(&t->m, &cell_items(t->m.cell)[from], q, a->link, in_a);
            place_in_state(&t->m, &cell_items(t->m.cell)[item], q, a->link, in_b);
            for (int i = 0; i < VERTICES; i++) most = fmaxl(most, dot3(widen(normal), in_a[i]));
            for (int i = 0; i < VERTICES; i++) least[lane] = fminl(least[lane], dot3(widen(normal), in_b[i]) - most);
        }
    }
    motion_rest centers = cover_find_pair_rest(&t->c, pair, is_from_b);
    motion_rest rest = cover_find_hull_rest(&centers, b->one.radius);
    rest.constant += a->hull + b->hull;
    double reach[2][COVER8];
    for (int k = 0; k < 2; k++) set_reach(t, &rest, least, k ? 0.5 : 1, reach[k]);
    count_far(&hulls, t->c.kernels->near_hull(&hull, reach[0]), t->c.kernels->near_hull(&hull, reach[1]), least);
}

static void print_tally(const char *name, const tally *t) {
    printf("%-10s %ld asked, %.3g of the bound reached, %.3g shown to half\n", name, t->asked, t->most,
           (double)t->far / (double)t->asked);
}

static void test_bounds(int rounds) {
    uint64_t s = 77;
    for (int i = 0; i < TRIALS * rounds; i++) {
        check_seed = (uint64_t)i;
        trial t = {.masks = NULL};
        open_trial(&s, &t);
        uint32_t item = random_below(&s, (uint32_t)t.m.cell->items.count);
        check_world(&s, &t, item);
        check_box(&s, &t, item);
        if (t.m.cell->pairs.count > 0) {
            uint32_t pair = random_below(&s, (uint32_t)t.m.cell->pairs.count);
            int is_from_b = random_below(&s, 2) == 0;
            check_relative(&s, &t, pair, is_from_b);
            check_balls(&t, pair, is_from_b);
            check_hull(&s, &t, pair, is_from_b);
        }
        close_trial(&t);
    }
    check_seed = 0;
    print_tally("world", &world);
    print_tally("relative", &relative);
    print_tally("boxes", &boxes);
    print_tally("points", &points);
    print_tally("point", &point);
    print_tally("slabs", &slabs);
    print_tally("hulls", &hulls);
    CHECK(world.most > 0.5 && world.most <= 1);
    CHECK(relative.most > 0.5);
}

// ---- instruction sets

// All kernels on one trial, their results side by side.
typedef struct kernel_results {
    rate8 rates[JOINTS + 1];
    motion8 motions[2];
    unsigned char boxes;
    unsigned bits[4];
} kernel_results;

static void run_kernels(const robot8_kernels *k, trial *t, const double reach[COVER8], kernel_results *to) {
    path_cover *c = &t->c;
    item_pair both = cell_pairs(t->m.cell)[0];
    const cover_item *a = &c->items[both.a], *b = &c->items[both.b];
    const cover_boxes box = {
        {{0, 1, 0}, {0.6, 0, 0.8}, {0.8, 0, -0.6}}, &(cover_box){{0, 0, 0}, {reach[0], 0, reach[1]}, 0}, 1};
    c->kernels = k;
    memset(to, 0, sizeof *to);
    cover_open_block(c, &t->lanes);
    memcpy(to->rates, c->rates8, t->m.cell->robot->link_count * sizeof *c->rates8);
    moving8 links[2] = {cover_get_link(c, both.a), cover_get_link(c, both.b)};
    k->move(&links[0], &a->one.center.x, &to->motions[0]);
    k->move(&links[1], &b->one.center.x, &to->motions[1]);
    k->near_moving(&box, &to->motions[0], reach, &to->boxes);
    to->bits[0] = k->near_points(&to->motions[0], &to->motions[1], reach);
    to->bits[1] = k->near_point(&to->motions[1], &to->motions[0], &links[0], reach);
    to->bits[2] = k->near_slabs(&to->motions[1], &links[0], &a->slabs, reach);
    const moving_hull hull = {links[0],      links[1],      b->clusters,   b->count,
                              b->one.center, b->one.radius, {0.6, 0, 0.8}, 0};
    to->bits[3] = k->near_hull(&hull, reach);
}

static void test_lanes(void) {
    uint64_t s = 3;
    static kernel_results first, other;
    long mixed = 0;
    for (int i = 0; i < TRIALS; i++) {
        check_seed = (uint64_t)i;
        trial t = {.masks = NULL};
        open_trial(&s, &t);
        double reach[COVER8];
        for (int k = 0; k < COVER8; k++) reach[k] = t.m.scale * random_uniform(&s, 0, 2);
        for (int isa = SIMD_SCALAR; t.m.cell->pairs.count && isa < SIMD_ISA_COUNT; isa++) {
            const robot8_kernels *kernels = robot8_get_kernels_of((simd_isa)isa);
            if (!kernels && isa >= SIMD_AVX2 && i == 0) check_skip("an instruction set that this machine lacks");
            if (!kernels) continue;
            run_kernels(kernels, &t, reach, isa == SIMD_SCALAR ? &first : &other);
            CHECK(isa == SIMD_SCALAR || memcmp(&first, &other, sizeof first) == 0);
        }
        for (int k = 0; k < 4; k++) mixed += first.bits[k] != 0 && first.bits[k] != 0xff;
        close_trial(&t);
    }
    check_seed = 0;
    CHECK(mixed > 50);
}

// ---- verdicts

static long frees, hits, undecided, covered;

static ovoid_robot_path_answer ask(ovoid_robot_checker *x, const double *states, const ovoid_robot_path_options *o) {
    const ovoid_robot_path path = {states, 2};
    ovoid_robot_path_answer answer;
    CHECK_EQ(ovoid_robot_path_find_hit(x, &(ovoid_robot_path_query){&path, o}, &answer, &error), OVOID_OK);
    return answer;
}

// The verdict by covers, beside that of a search whose steps are verified; both of the cell as it is.
static void compare_verdicts(const machine *m, ovoid_robot_checker *x, const double *states, double margin) {
    enum { STEPS = 100000 };
    static ovoid_robot_step steps[STEPS];
    const ovoid_robot_path path = {states, 2};
    const ovoid_robot_path_options known = {
        .query = {.margin = margin, .limit_slack = INFINITY}, .states = 5000, .steps = steps, .capacity = STEPS};
    ovoid_robot_path_options any = {.query = known.query, .states = 5000, .any_hit = 1};
    ovoid_robot_path_answer is = ask(x, states, &any), truth = ask(x, states, &known);
    if (truth.step_count <= STEPS)
        CHECK_EQ(ovoid_robot_path_verify(m->cell, &truth, &(ovoid_robot_path_basis){{&path, &known}, steps}, &error),
                 OVOID_OK);
    frees += is.status == OVOID_ROBOT_FREE, hits += is.status == OVOID_ROBOT_HIT;
    undecided += is.status == OVOID_ROBOT_UNDECIDED || truth.status == OVOID_ROBOT_UNDECIDED;
    covered += is.status == OVOID_ROBOT_FREE && is.states == 0;
    if (is.status != OVOID_ROBOT_UNDECIDED && truth.status != OVOID_ROBOT_UNDECIDED) CHECK_EQ(is.status, truth.status);
    if (is.status == OVOID_ROBOT_FREE) CHECK(is.free_until == 1 && is.hit_at == INFINITY && is.step_count == 0);
    if (is.status != OVOID_ROBOT_HIT) return;
    CHECK(is.hit_at >= truth.free_until && is.hit.upper <= margin);
    // Nothing but the hit is claimed, and it is true.
    if (is.free_until == 0)
        CHECK_EQ(ovoid_robot_path_verify(m->cell, &is, &(ovoid_robot_path_basis){{&path, &any}, NULL}, &error),
                 OVOID_OK);
}

// Edges of a machine among obstacles, which move in between; the checker is the same.
static void test_verdicts(int rounds) {
    uint64_t s = 41;
    for (int i = 0; i < EDGES * rounds; i++) {
        check_seed = (uint64_t)i;
        machine m;
        make_machine(&s, &m);
        ovoid_id ids[OBSTACLES];
        for (int k = 0; k < OBSTACLES; k++) {
            ovoid_body body = {.shape = m.shapes[k % 3], .pose = random_pose(&s, 2.5 * m.scale)};
            if (random_below(&s, 2)) body.pose.rotation = (ovoid_quat){1, 0, 0, 0};
            ids[k] = ovoid_robot_cell_add(m.cell, &body, &error);
        }
        // Some links are wider toward obstacles.
        for (uint32_t k = 0; k < m.cell->robot->link_count; k++)
            if ((i + (int)k) % 3 == 0)
                CHECK_EQ(ovoid_robot_cell_set_padding(m.cell, k, 0.2 * m.scale, &error), OVOID_OK);
        // Of a chain of boxes that touch their neighbours nothing would be free.
        for (uint32_t a = 0; a < m.cell->robot->link_count; a++)
            for (uint32_t b = a + 1; b < m.cell->robot->link_count; b++)
                if (random_below(&s, 4)) (void)ovoid_robot_cell_add_allowed(m.cell, a, b, &error);
        ovoid_robot_checker *x = ovoid_robot_checker_create(m.cell, NULL, &error);
        size_t n = ovoid_robot_get_variable_count(m.r);
        double states[2 * 3 * JOINTS], share = pow(0.5, random_below(&s, 8));
        for (int k = 0; k < 6; k++) {
            for (size_t v = 0; v < n; v++) {
                states[v] = k ? states[v] : m.q[0][v];
                states[n + v] = states[v] + share * random_uniform(&s, -1, 1) * (m.q[1][v] - m.q[0][v]);
            }
            compare_verdicts(&m, x, states, random_below(&s, 3) ? 0 : 0.05 * m.scale);
            memcpy(states, states + n, n * sizeof *states);
            ovoid_pose to = random_pose(&s, 2.5 * m.scale);
            CHECK_EQ(ovoid_robot_cell_move(m.cell, ids[random_below(&s, OBSTACLES)], &to, &error), OVOID_OK);
        }
        ovoid_robot_checker_destroy(x);
        destroy_machine(&m);
    }
    check_seed = 0;
    printf("%ld free, %ld of them by covers alone, %ld hit, %ld undecided\n", frees, covered, hits, undecided);
    CHECK(frees > 300 && hits > 60 && 10 * covered > 9 * frees);
}

int main(int argc, char **argv) {
    uint64_t wanted = 1;
    const test_option options[] = {{"rounds", "how many (1)", &wanted, NULL, NULL, NULL},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, argc, argv);
    if (code >= 0) return code;
    test_balls();
    test_bounds((int)wanted);
    test_lanes();
    test_verdicts((int)wanted);
    return check_end();
}
