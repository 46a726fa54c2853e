// The table of supports against a search of all vertices: the same index and the same bits, for every direction. The
// directions are random ones, those of the cells' own corners and edges, and those along which many vertices tie. The
// kernel against its scalar twin.
#include "base/allocator.h"
#include "polytope/hull.h"
#include "shape/support_table.h"
#include "simd/support.h"

#include "check.h"

enum { MOST = 3000, PADDED = MOST + 8 };
static double xyz[3 * MOST], x[PADDED], y[PADDED], z[PADDED];

static double digit_of(uint32_t i, uint32_t place) { return i / place % 3; }

static uint64_t bits_of(double v) {
    uint64_t b;
    memcpy(&b, &v, sizeof b);
    return b;
}

static support_result find_among_all(uint32_t count, vec3 n) {
    simd_points points = {x, y, z, (count + 7) / 8 * 8};
    return simd_find_support_scalar(&points, n);
}

static void check_direction(const support_table *t, const simd_cell *cells, uint32_t count, vec3 n) {
    simd_extreme found;
    if (!support_table_find(t, cells, n, &found)) {
        CHECK(!(vec3_max_abs(n) > 1e-80 && vec3_max_abs(n) < 1e80));
        return;
    }
    support_result expected = find_among_all(count, n);
    CHECK_EQ(found.index, expected.index);
    CHECK(bits_of(found.value) == bits_of(expected.value));
    CHECK(found.x == x[found.index] && found.y == y[found.index] && found.z == z[found.index]);
}

static vec3 random_direction(uint64_t *state) {
    double a = random_normal(state), b = random_normal(state), c = random_normal(state);
    return (vec3){a, b, c};
}

/// Directions that map onto corners and edges of cells, of those that are divided too, and one bit beside.
static void check_corners(const support_table *t, const simd_cell *cells, uint32_t count, uint64_t *state) {
    sym3 inverse = sym3_inverse(t->root);
    for (int i = 0; i < 2000; i++) {
        double step = 1.0 / (8 * t->k), a = step * (double)(random_next(state) % (16 * t->k + 1)) - 1,
               b = step * (double)(random_next(state) % (16 * t->k + 1)) - 1;
        if (i % 3 == 0) b = random_uniform(state, -1, 1);
        if (i % 5 == 0) a = nextafter(a, random_uniform(state, -2, 2));
        vec3 v = i % 6 < 2 ? (vec3){1, a, b} : i % 6 < 4 ? (vec3){a, 1, b} : (vec3){a, b, 1};
        if (i & 1) v = vec3_neg(v);
        check_direction(t, cells, count, sym3_mul_vec3(inverse, v));
    }
}

/// Directions along which vertices tie: edges' and facets' normals.
static void check_ties(const support_table *t, const simd_cell *cells, uint32_t count, uint64_t *state) {
    for (int i = 0; i < 500; i++) {
        vec3 p[3];
        for (int k = 0; k < 3; k++) p[k] = vec3_at(xyz, random_next(state) % count);
        check_direction(t, cells, count, vec3_cross(vec3_sub(p[1], p[0]), vec3_sub(p[2], p[0])));
        check_direction(t, cells, count, vec3_cross(vec3_sub(p[1], p[0]), random_direction(state)));
    }
    for (uint32_t i = 0; i < 27; i++)
        check_direction(t, cells, count, (vec3){digit_of(i, 1) - 1, digit_of(i, 3) - 1, digit_of(i, 9) - 1});
}

static void check_strange(const support_table *t, const simd_cell *cells) {
    simd_extreme found;
    const double strange[] = {NAN, INFINITY, 1e300, 0, 1e-300};
    for (int i = 0; i < 5; i++) {
        vec3 n = {strange[i], i == 1 ? 1 : strange[i], strange[i]};
        CHECK(!support_table_find(t, cells, n, &found));
    }
}

/// Makes the hull of the points in xyz and the table of its vertices, which replace the points. Returns their number.
static uint32_t make_table(uint32_t count, support_table *t, simd_cell **cells) {
    ovoid_allocator allocator = allocator_make(NULL);
    hull solid;
    ovoid_error error;
    CHECK_EQ(hull_create((xyz_points){xyz, count}, &allocator, &solid, &error), OVOID_OK);
    ovoid_polytope p = hull_get_polytope(&solid);
    support_block *blocks;
    CHECK_EQ(support_table_create(&p, &allocator, t, &blocks), OVOID_OK);
    *cells = blocks ? allocator_allocate(&allocator, t->cell_count, sizeof **cells) : NULL;
    if (*cells) support_table_fill(p.vertices, blocks, t->cell_count, *cells);
    allocator_release(&allocator, blocks);
    count = p.vertex_count;
    memcpy(xyz, p.vertices, 3 * sizeof *xyz * count);
    for (uint32_t i = 0; i < (count + 7) / 8 * 8; i++) {
        uint32_t k = i < count ? i : 0;
        x[i] = xyz[3 * k], y[i] = xyz[3 * k + 1], z[i] = xyz[3 * k + 2];
    }
    hull_destroy(&solid, &allocator);
    return count;
}

static void release(simd_cell *cells) {
    ovoid_allocator allocator = allocator_make(NULL);
    allocator_release(&allocator, cells);
}

/// Is there a table, and is it right? Its blocks stay below twice the vertices.
static void check_table(const char *name, uint32_t given, uint64_t *state, int wanted) {
    support_table t;
    simd_cell *cells;
    uint32_t count = make_table(given, &t, &cells);
    CHECK((t.k > 0) == wanted && (cells != NULL) == wanted);
    if (wanted && !t.k) printf("%s: no table of %u vertices\n", name, count);
    CHECK_LE(t.cell_count, 2 * count);
    if (!t.k) return;
    for (int i = 0; i < 3000; i++) check_direction(&t, cells, count, random_direction(state));
    check_corners(&t, cells, count, state);
    check_ties(&t, cells, count, state);
    check_strange(&t, cells);
    release(cells);
}

static void set(uint32_t i, vec3 v) { xyz[3 * i] = v.x, xyz[3 * i + 1] = v.y, xyz[3 * i + 2] = v.z; }

static void check_round_bodies(uint64_t *state) {
    static const uint32_t counts[] = {SUPPORT_TABLE_LEAST, 100, 333, 1000, 2999};
    static const vec3 stretches[] = {{1, 1, 1}, {4, 2, 1}, {1, 1e-4, 1}, {1, 1, 1e-9}, {1e40, 1e40, 3e40}};
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
        for (size_t s = 0; s < sizeof stretches / sizeof *stretches; s++) {
            for (uint32_t i = 0; i < counts[c]; i++) {
                vec3 v = vec3_unit(random_direction(state));
                set(i, (vec3){v.x * stretches[s].x, v.y * stretches[s].y, v.z * stretches[s].z});
            }
            check_table("round", counts[c], state, 1);
        }
}

/// Vertices in threes that are a few roundings apart: along directions near them, which of the three wins is rounding.
static void check_clusters(uint64_t *state) {
    for (uint32_t round = 0; round < 12; round++) {
        uint32_t count = 300 + 90 * round;
        for (uint32_t i = 0; i < count; i += 3) {
            vec3 v = vec3_unit(random_direction(state));
            for (uint32_t k = 0; k < 3; k++) {
                vec3 off = vec3_scale(random_direction(state), (k ? 1 : 0) * (round % 2 ? 0x1p-51 : 0x1p-53));
                set(i + k, vec3_add(v, off));
            }
        }
        support_table t;
        simd_cell *cells;
        count = make_table(count, &t, &cells);
        if (!t.k) continue;
        for (int i = 0; i < 40000; i++) {
            vec3 p = vec3_at(xyz, random_next(state) % count);
            check_direction(&t, cells, count, vec3_add_scaled(p, random_direction(state), i % 2 ? 0.02 : 0.1));
        }
        release(cells);
    }
}

/// Where all vertices of a ring are extreme along nearly one direction; and a flat disc.
static void check_rings(uint64_t *state) {
    for (uint32_t sides = 60; sides <= 1000; sides = 4 * sides + 1)
        for (uint32_t rings = 1; rings <= 2; rings++) {
            uint32_t count = rings * sides;
            if (count < SUPPORT_TABLE_LEAST) continue;
            for (uint32_t i = 0; i < count; i++) {
                double angle = 6.283185307179586 * (i % sides) / sides;
                set(i, (vec3){cos(angle), sin(angle), i < sides ? 0 : 2});
            }
            check_table("rings", count, state, 1);
        }
}

/// Integer points on a sphere, of whose products with integer directions many are equal; all in one place; a nearly
/// flat polygon, turned; and bodies that have no table.
static void check_special(uint64_t *state) {
    uint32_t count = 0;
    for (int i = -33; i <= 33; i++)
        for (int j = -33; j <= 33; j++)
            for (int k = -33; k <= 33; k++)
                if (i * i + j * j + k * k == 1089) set(count++, (vec3){i, j, k});
    check_table("lattice", count, state, 1);
    for (uint32_t i = 0; i < 512; i++) {
        vec3 v = vec3_scale(vec3_unit(random_direction(state)), 1e-13);
        set(i, vec3_add(v, (vec3){1, 1, 1}));
    }
    support_table t;
    simd_cell *cells;
    (void)make_table(512, &t, &cells);
    release(cells);
    vec3 side = vec3_unit(random_direction(state)), up = vec3_unit(vec3_cross(side, random_direction(state)));
    for (uint32_t i = 0; i < 200; i++) {
        double angle = 6.283185307179586 * i / 200;
        set(i, vec3_add_scaled(vec3_scale(side, cos(angle)), up, sin(angle)));
    }
    check_table("turned polygon", 200, state, 1);
    for (uint32_t i = 0; i < 512; i++) set(i, vec3_scale(vec3_unit(random_direction(state)), 1e-100));
    check_table("too small", 512, state, 0);
    for (uint32_t i = 0; i < SUPPORT_TABLE_LEAST - 1; i++) set(i, vec3_unit(random_direction(state)));
    check_table("too few", SUPPORT_TABLE_LEAST - 1, state, 0);
}

static void check_kernel(uint64_t *state) {
    static simd_cell cells[3];
    for (int i = 0; i < 3000; i++) {
        for (uint32_t k = 0; k < 24; k++) {
            simd_cell *c = &cells[k / 8];
            // Every other time on a small grid: values tie, and zeros have both signs.
            vec3 v = random_direction(state);
            if (i & 1) v = (vec3){(double)(k % 3) - 1, (double)(k / 3 % 2), -0.0};
            c->x[k % 8] = v.x, c->y[k % 8] = v.y, c->z[k % 8] = v.z;
            c->index[k % 8] = 3 * k;
        }
        vec3 n = i & 2 ? (vec3){1, -1, 0} : random_direction(state);
        uint32_t count = 1 + (uint32_t)(random_next(state) % 24);
        simd_extreme p = simd_find_in_cell(cells, cells + 1, count, &n);
        simd_extreme q = simd_find_in_cell_scalar(cells, cells + 1, count, &n);
        CHECK(p.index == q.index && bits_of(p.value) == bits_of(q.value) && bits_of(p.x) == bits_of(q.x));
    }
}

int main(void) {
    uint64_t state = check_seed = 20240611;
    check_round_bodies(&state);
    check_clusters(&state);
    check_rings(&state);
    check_kernel(&state);
    check_special(&state);
    return check_end();
}
