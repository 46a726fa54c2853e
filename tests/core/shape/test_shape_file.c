// Files of shapes. A file read is the shape written, bit for bit. Every byte flipped in every bit, every truncation and
// every extension is refused; the same with the checksum mended gives a refusal or a shape that holds what it promises
// (its file is then the changed file itself), and never a crash. Files are small, so all of it is tried.
#include "check.h"
#include "countdown.h"
#include "ellipsoid/contain.h"
#include "linear/rotation.h"
#include "ovoid/query.h"
#include "shape/file.h"
#include "shape_files.h"

#define CAPACITY 20000

static uint8_t file[CAPACITY], other[CAPACITY];
static double cloud[3 * 1000];

static void put(size_t i, vec3 v) {
    cloud[3 * i] = v.x;
    cloud[3 * i + 1] = v.y;
    cloud[3 * i + 2] = v.z;
}

// Writes the shape into `file`, in the version that it would be written in.
static size_t write_file(const ovoid_shape *s) {
    size_t size = ovoid_shape_write(s, NULL, 0);
    if (!CHECK_LE(size, CAPACITY)) return 0;
    memset(file, 0xaa, sizeof file);
    size_t tried = ovoid_shape_write(s, file, size - 1);
    CHECK_EQ(tried, size);
    CHECK_EQ(file[0], 0xaa);
    tried = ovoid_shape_write(s, file, sizeof file);
    CHECK_EQ(tried, size);
    CHECK_EQ(file[size], 0xaa);
    return size;
}

// What was written into `file` is the shape.
static size_t check_same_read(const ovoid_shape *s, size_t size) {
    ovoid_error e = {0};
    ovoid_shape *t = ovoid_shape_read(file, size, NULL, &e);
    if (!t) printf("    %s\n", e.message);
    shape_files_check_same(s, t);
    ovoid_shape_destroy(t);
    return size;
}

static size_t check_round_trip(const ovoid_shape *s) { return check_same_read(s, write_file(s)); }

// A changed file with a good checksum: refused as FORMAT, or a shape that is what the file says and holds its promises.
static void check_mended(size_t size) {
    ovoid_error e = {0};
    ovoid_shape *t = ovoid_shape_read(other, size, NULL, &e);
    if (!t) {
        CHECK_EQ(e.code, OVOID_ERROR_FORMAT);
        CHECK(e.place >= 0 && e.place <= (int64_t)size);
        return;
    }
    static uint8_t again[CAPACITY];
    size_t written = shape_write_version(t, other[8], again, sizeof again);
    CHECK_EQ(written, size);
    CHECK(!memcmp(again, other, size));
    ovoid_polytope p = ovoid_shape_get_polytope(t);
    CHECK(ellipsoid_is_enclosing(&p, &t->outer));
    CHECK(p.rank < 3 || ellipsoid_is_enclosed(&p, &t->inner));
    ovoid_shape_destroy(t);
}

// Every bit of every byte.
static void check_flips(size_t size) {
    for (size_t i = 0; i < size; i++)
        for (int bit = 0; bit < 8; bit++) {
            memcpy(other, file, size);
            other[i] ^= (uint8_t)(1 << bit);
            ovoid_error e = {0};
            ovoid_shape *t = ovoid_shape_read(other, size, NULL, &e);
            CHECK(t == NULL);
            CHECK_EQ(e.code, OVOID_ERROR_FORMAT);
            shape_files_mend(other, size);
            check_mended(size);
        }
    // Whole bytes too, some values that are special as parts of doubles and counts.
    static const uint8_t values[] = {0x00, 0xff, 0x7f, 0x80, 0xf0};
    for (size_t i = 0; i < size - 8; i++)
        for (size_t k = 0; k < sizeof values; k++) {
            memcpy(other, file, size);
            other[i] = values[k];
            shape_files_mend(other, size);
            check_mended(size);
        }
}

static void check_lengths(size_t size) {
    for (size_t i = 0; i <= size + 100; i++) {
        memset(other, 0, sizeof other);
        memcpy(other, file, size);
        // As large as it is, so that a sanitizer sees any byte read beyond.
        uint8_t *exact = malloc(i + 1);
        memcpy(exact, other, i);
        ovoid_error e = {0};
        ovoid_shape *t = ovoid_shape_read(exact, i, NULL, &e);
        CHECK_EQ(t != NULL, i == size);
        CHECK_EQ(e.code, i == size ? OVOID_OK : OVOID_ERROR_FORMAT);
        ovoid_shape_destroy(t);
        // With size and checksum of its own.
        if (i > 32 && i != size) {
            for (int k = 0; k < 8; k++) exact[16 + k] = (uint8_t)((uint64_t)i >> 8 * k);
            shape_files_mend(exact, i);
            t = ovoid_shape_read(exact, i, NULL, &e);
            CHECK(t == NULL);
            CHECK_EQ(e.code, OVOID_ERROR_FORMAT);
            ovoid_shape_destroy(t);
        }
        free(exact);
    }
}

// What only a forger would write: two vertices exchanged for others, the frame moved, ellipsoids a little off.
static void check_forged(void) {
    ovoid_shape *s = ovoid_shape_create_box((vec3){1, 1, 1}, NULL, NULL);
    size_t size = write_file(s);
    static const struct forgery {
        size_t at;
        double value;
        const char *word;
    } forgeries[] = {
        {328, 0.5, "inner"},        // a vertex moved inward: the inner ellipsoid sticks out or the vertex is lost
        {328, -1.0000001, "outer"}, // a vertex moved out of the outer ellipsoid
        {328, -0.0, "length"},      // not as written
        {328, -0x1p-1074, "inner"}, //
        {32, -1, "radius"},         //
        {32, NAN, "radius"},        //
        {40, 1e51, "origin"},       //
        {40, 0.1, "body frame"},    // origin + vertex is no double
        {104 + 24, 2.9, "outer"},   // Q of the outer ellipsoid: 3 for a cube of half size 1
        {104 + 24, INFINITY, "ellipsoid"}, //
        {216 + 24, 1.01, "inner"},         // Q of the inner ellipsoid: 1
        {216, 1e-5, "inner"},              // its centre
        {216 + 72, -1, "ellipsoid"},       // a negative volume
    };
    for (size_t i = 0; i < sizeof forgeries / sizeof *forgeries; i++) {
        memcpy(other, file, size);
        memcpy(other + forgeries[i].at, &forgeries[i].value, 8);
        shape_files_mend(other, size);
        ovoid_error e = {0};
        ovoid_shape *t = ovoid_shape_read(other, size, NULL, &e);
        CHECK(t == NULL);
        CHECK_EQ(e.code, OVOID_ERROR_FORMAT);
        if (!CHECK(strstr(e.message, forgeries[i].word) != NULL)) printf("    forgery %zu: %s\n", i, e.message);
        ovoid_shape_destroy(t);
    }
    // A file of a gigabyte's vertices that is short: refused before anything is allocated.
    memcpy(other, file, 336);
    uint64_t count = 40000000, total = 336;
    memcpy(other + 24, &count, 8);
    memcpy(other + 16, &total, 8);
    shape_files_mend(other, 336);
    ovoid_error e = {0};
    CHECK(ovoid_shape_read(other, 336, NULL, &e) == NULL);
    CHECK_EQ(e.code, OVOID_ERROR_FORMAT);
    e = (ovoid_error){0};
    CHECK(ovoid_shape_read(NULL, 0, NULL, &e) == NULL);
    CHECK_EQ(e.code, OVOID_ERROR_FORMAT);
    CHECK(ovoid_shape_read(NULL, 10, NULL, NULL) == NULL);
    ovoid_shape_destroy(s);
}

static void check_memory(size_t size) {
    ovoid_shape *s = NULL;
    for (long k = 0; !s; k++) {
        countdown c = {k, 0};
        ovoid_allocator counted = countdown_make_allocator(&c);
        ovoid_error e = {0};
        s = ovoid_shape_read(file, size, &(ovoid_shape_options){.allocator = &counted}, &e);
        CHECK_EQ(e.code, s ? OVOID_OK : OVOID_ERROR_MEMORY);
        CHECK_EQ(c.held, s ? 1 : 0);
        if (!s) continue;
        ovoid_shape_destroy(s);
        CHECK_EQ(c.held, 0);
    }
}

// One shape of each kind through everything.
static void check_kinds(void) {
    uint64_t seed = 3;
    for (size_t i = 0; i < 10; i++)
        put(i, (vec3){1e6 + random_normal(&seed), random_normal(&seed), random_normal(&seed)});
    ovoid_shape_options phases = {.inner = OVOID_INNER_PHASES, .radius = 0.125};
    ovoid_shape *shapes[] = {
        ovoid_shape_create_sphere(1, NULL, NULL),
        ovoid_shape_create_capsule(0.5, 1, NULL, NULL),
        ovoid_shape_create_box((vec3){1, 2, 0}, &phases, NULL),
        ovoid_shape_create_box((vec3){1, 2, 3}, &phases, NULL),
        ovoid_shape_create_from_points(cloud, 10, NULL, NULL),
        ovoid_shape_create_pyramid(&(ovoid_prism){1, 1, 7}, NULL, NULL),
    };
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        size_t size = check_round_trip(shapes[i]);
        check_flips(size);
        check_lengths(size);
        check_memory(size);
        if (shapes[i]->rank == 3) {
            size = check_same_read(shapes[i], shape_write_version(shapes[i], 3, file, sizeof file));
            check_flips(size);
            check_lengths(size);
            check_memory(size);
        }
        ovoid_shape_destroy(shapes[i]);
    }
}

// Hard bodies at all sizes survive the way through a file.
static void check_hard(void) {
    uint64_t s = 33;
    static const double stretch[][3] = {{1, 1, 1},     {1, 1, 1e-6},  {1, 1e-6, 1e-6},   {1, 1e-3, 1e-9},
                                        {1, 1, 1e-13}, {1, 1, 1e-16}, {1, 1e-16, 1e-16}, {1, 1e-6, 0}};
    static const double sizes[] = {1e-120, 1e-9, 1, 1e9, 1e40};
    for (size_t i = 0; i < sizeof stretch / sizeof *stretch; i++)
        for (size_t k = 0; k < 2 * sizeof sizes / sizeof *sizes; k++) {
            check_seed = s;
            mat3 r =
                quat_to_mat3((ovoid_quat){random_normal(&s), random_normal(&s), random_normal(&s), random_normal(&s)});
            vec3 away = {k % 2 ? 1e7 : 0, 0, 0};
            for (size_t j = 0; j < 60; j++) {
                vec3 v = {random_normal(&s) * stretch[i][0], random_normal(&s) * stretch[i][1],
                          random_normal(&s) * stretch[i][2]};
                put(j, vec3_scale(vec3_add(mat3_mul_vec3(r, v), away), sizes[k / 2]));
            }
            ovoid_shape_options o = {.inner = (ovoid_inner_method)(k / 2 % 2)};
            ovoid_shape *shape = ovoid_shape_create_from_points(cloud, 60, &o, NULL);
            check_round_trip(shape);
            ovoid_shape_destroy(shape);
        }
    check_seed = 0;
}

// Small bodies of wild coordinates: needles, ribbons thinner than an ellipsoid can be stored, points that nearly agree.
static void check_wild(void) {
    uint64_t s = 71;
    for (int i = 0; i < 4000; i++) {
        check_seed = s;
        size_t n = 1 + random_next(&s) % 8;
        for (size_t k = 0; k < 3 * n; k++) {
            double v = (double)(random_next(&s) % 7) - 3;
            cloud[k] =
                i % 2 ? v * pow(10, -8 * (int)(random_next(&s) % 3)) : ldexp(v, (int)(random_next(&s) % 160) - 80);
        }
        ovoid_shape_options o = {.inner = (ovoid_inner_method)(i / 2 % 2)};
        ovoid_shape *shape = ovoid_shape_create_from_points(cloud, n, &o, NULL);
        check_round_trip(shape);
        ovoid_shape_destroy(shape);
    }
    check_seed = 0;
}

static void check_game_hulls(void) {
    const char *folder = check_data_folder();
    char path[1024];
    snprintf(path, sizeof path, "%s/pieces/game_hulls.bin", folder ? folder : "");
    FILE *in = folder ? fopen(path, "rb") : NULL;
    if (!in) {
        check_skip("pieces/game_hulls.bin is absent");
        return;
    }
    uint32_t n;
    for (; fread(&n, sizeof n, 1, in) == 1; check_seed++) {
        for (uint32_t i = 0; i < 3 * n; i++) {
            float v = 0;
            size_t got = fread(&v, sizeof v, 1, in);
            if (got != 1 || n > 1000) break;
            cloud[i] = v;
        }
        ovoid_shape *shape = n <= 1000 ? ovoid_shape_create_from_points(cloud, n, NULL, NULL) : NULL;
        if (CHECK(shape != NULL)) check_round_trip(shape);
        ovoid_shape_destroy(shape);
    }
    CHECK_EQ(check_seed, 3378);
    check_seed = 0;
    fclose(in);
}

// Bodies down to the smallest doubles, whose ellipsoids underflow to points: their files are read, and nothing of them
// is infinite or not a number. (Found by fuzzing: a power of two and its reciprocal overflowed.)
static void check_tiny(void) {
    static const double corners[5][3] = {{0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 1}, {1, 1, 2}};
    for (int e = -400; e > -1074; e -= 7)
        for (size_t count = 1; count <= 5; count++) {
            for (size_t i = 0; i < count; i++)
                put(i, (vec3){ldexp(corners[i][0], e), ldexp(corners[i][1], e), ldexp(corners[i][2], e)});
            ovoid_shape *shape = ovoid_shape_create_from_points(cloud, count, NULL, NULL);
            if (!CHECK(shape)) continue;
            ovoid_fit outer = ovoid_shape_get_outer(shape), inner = ovoid_shape_get_inner(shape);
            CHECK(vec3_is_finite(outer.ellipsoid.center) && vec3_is_finite(inner.ellipsoid.center));
            CHECK(isfinite(outer.ellipsoid.q.xx) && isfinite(inner.ellipsoid.q.xx));
            size_t size = ovoid_shape_write(shape, file, CAPACITY);
            ovoid_shape *again = ovoid_shape_read(file, size, NULL, NULL);
            if (!CHECK(again && ovoid_shape_write(again, other, CAPACITY) == size && memcmp(file, other, size) == 0))
                break;
            ovoid_pair pair = {shape, again, ovoid_pose_make_identity(), ovoid_pose_make_identity()};
            for (int far = 0; far < 2; far++, pair.pose_b.position.y = 5) {
                ovoid_answer bounds = ovoid_pair_compute_bounds(&pair), distance = ovoid_distance(&pair, NULL, NULL);
                double size_of_body = ldexp(4, e);
                CHECK_LE(fmax(bounds.lower, distance.lower), 5 * far + size_of_body);
                CHECK_LE(5 * far - size_of_body, fmin(bounds.upper, distance.upper));
                CHECK(ovoid_answer_verify(&pair, &bounds, NULL, NULL) == OVOID_OK);
            }
            ovoid_shape_destroy(shape);
            ovoid_shape_destroy(again);
        }
}

int main(void) {
    check_kinds();
    check_tiny();
    check_forged();
    check_hard();
    check_wild();
    check_game_hulls();
    return check_end();
}
