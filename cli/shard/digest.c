// Four lanes of 64 bits, one word of each 32 bytes for each: xor, rotate, multiply by an odd number. Every step is a
// bijection of its lane, so that no single altered word goes unnoticed before the lanes are mixed. Bytes count as
// little-endian words, on any machine.
#define _FILE_OFFSET_BITS 64
#include "shard/digest.h"

#include "base/args.h"
#include "base/message.h"

#include <errno.h>
#include <string.h>
#include <sys/stat.h>

enum { STEP = 32, LANES = 4 };

/// Odd numbers without a pattern: the first bits of the fractions of the roots of 2, 3, 5 and 7.
static const uint64_t factors[LANES] = {0x6a09e667f3bcc909u, 0xbb67ae8584caa73bu, 0x3c6ef372fe94f82bu,
                                        0xa54ff53a5f1d36f1u};

static uint64_t rotate(uint64_t x, int bits) { return x << bits | x >> (64 - bits); }

static uint64_t get_word(const unsigned char *b) {
    return (uint64_t)b[0] | (uint64_t)b[1] << 8 | (uint64_t)b[2] << 16 | (uint64_t)b[3] << 24 | (uint64_t)b[4] << 32 |
           (uint64_t)b[5] << 40 | (uint64_t)b[6] << 48 | (uint64_t)b[7] << 56;
}

static void add_step(uint64_t lanes[LANES], const unsigned char *bytes) {
    for (int i = 0; i < LANES; i++) lanes[i] = rotate(lanes[i] ^ get_word(bytes + 8 * i), 29) * factors[i];
}

shard_digest shard_digest_make(void) {
    return (shard_digest){.lanes = {factors[3], factors[2], factors[1], factors[0]}};
}

void shard_digest_add(shard_digest *d, const void *bytes, size_t size) {
    const unsigned char *at = bytes;
    if (!size) return;
    d->size += size;
    // The step that was begun, whole steps, and what is left.
    if (d->rest_size) {
        size_t taken = STEP - d->rest_size < size ? STEP - d->rest_size : size;
        memcpy(d->rest + d->rest_size, at, taken);
        d->rest_size += taken;
        at += taken;
        size -= taken;
        if (d->rest_size < STEP) return;
        add_step(d->lanes, d->rest);
        d->rest_size = 0;
    }
    uint64_t lanes[LANES];
    memcpy(lanes, d->lanes, sizeof lanes);
    for (; size >= STEP; at += STEP, size -= STEP) add_step(lanes, at);
    memcpy(d->lanes, lanes, sizeof lanes);
    if (size) memcpy(d->rest, at, size);
    d->rest_size = size;
}

uint64_t shard_digest_get(const shard_digest *digest) {
    shard_digest d = *digest;
    memset(d.rest + d.rest_size, 0, STEP - d.rest_size);
    add_step(d.lanes, d.rest);
    uint64_t h = d.size;
    for (int i = 0; i < LANES; i++) {
        h = (h ^ d.lanes[i]) * factors[i];
        h ^= h >> 32;
    }
    return h;
}

/* ---- files */

static int fail(const char *path) {
    message_error("%s: cannot be read: %s", path, errno ? strerror(errno) : "it ends early");
    return EXIT_INPUT;
}

int shard_digest_add_stream(shard_digest *d, FILE *file, uint64_t count) {
    unsigned char room[1 << 14];
    while (count) {
        size_t most = count < sizeof room ? (size_t)count : sizeof room;
        if (fread(room, 1, most, file) != most) return 0;
        shard_digest_add(d, room, most);
        count -= most;
    }
    return 1;
}

/// Adds evenly spaced pieces of a file of that size.
static int add_samples(shard_digest *d, FILE *file, uint64_t size) {
    for (uint64_t i = 0; i < SHARD_SAMPLES; i++) {
        uint64_t last = size - SHARD_SAMPLE, at = last / (SHARD_SAMPLES - 1) * i;
        if (i == SHARD_SAMPLES - 1) at = last;
        if (fseeko(file, (off_t)at, SEEK_SET) != 0 || !shard_digest_add_stream(d, file, SHARD_SAMPLE)) return 0;
    }
    return 1;
}

int shard_digest_add_file(shard_digest *d, const char *path) {
    struct stat status;
    if (strcmp(path, "-") == 0 || (stat(path, &status) == 0 && !S_ISREG(status.st_mode))) {
        message_error("%s: --shard reads its inputs more than once: give a regular file",
                      strcmp(path, "-") == 0 ? "standard input" : path);
        return EXIT_INPUT;
    }
    errno = 0;
    FILE *file = fopen(path, "rb");
    int good = file && fstat(fileno(file), &status) == 0;
    if (good) {
        uint64_t size = (uint64_t)status.st_size;
        unsigned char bytes[8];
        for (int i = 0; i < 8; i++) bytes[i] = (unsigned char)(size >> 8 * i);
        shard_digest_add(d, bytes, sizeof bytes);
        good = size <= SHARD_WHOLE_MAX ? shard_digest_add_stream(d, file, size) : add_samples(d, file, size);
    }
    int code = good ? 0 : fail(path);
    if (file) (void)fclose(file); // it was read
    return code;
}

/* ---- shapes */

static void add_ellipsoid(shard_digest *d, const ovoid_ellipsoid *e) {
    const double numbers[] = {e->center.x, e->center.y, e->center.z, e->q.xx, e->q.xy,
                              e->q.xz,     e->q.yy,     e->q.yz,     e->q.zz};
    shard_digest_add(d, numbers, sizeof numbers);
}

static void add_shape(shard_digest *d, const ovoid_shape *shape) {
    const ovoid_polytope body = ovoid_shape_get_polytope(shape);
    const ovoid_fit outer = ovoid_shape_get_outer(shape), inner = ovoid_shape_get_inner(shape);
    const ovoid_allowance allowance = ovoid_shape_get_allowance(shape);
    const ovoid_round round = ovoid_shape_get_round(shape);
    const double numbers[] = {ovoid_shape_get_radius(shape),
                              round.kind,
                              round.radius,
                              round.half_length,
                              allowance.outside,
                              allowance.inside,
                              allowance.axis.x,
                              allowance.axis.y,
                              allowance.axis.z,
                              body.origin.x,
                              body.origin.y,
                              body.origin.z,
                              body.vertex_count,
                              body.triangle_count,
                              body.facet_count,
                              (double)ovoid_shape_get_size(shape)};
    shard_digest_add(d, numbers, sizeof numbers);
    shard_digest_add(d, body.vertices, 3 * sizeof *body.vertices * body.vertex_count);
    add_ellipsoid(d, &outer.ellipsoid);
    add_ellipsoid(d, &inner.ellipsoid);
}

// The points and triangles, which are all that answers come from.
static void add_solid(shard_digest *d, const ovoid_solid *solid) {
    ovoid_solid_report r = ovoid_solid_get_report(solid);
    shard_digest_add(d, ovoid_solid_get_points(solid), (size_t)r.points * 3 * sizeof(double));
    for (size_t i = 0; i < r.triangles; i++) {
        uint32_t triangle[3];
        ovoid_solid_get_triangle(solid, i, triangle);
        shard_digest_add(d, triangle, sizeof triangle);
    }
}

void shard_digest_add_body(shard_digest *d, const ovoid_shape *shape, const ovoid_solid *solid) {
    add_shape(d, shape);
    if (solid) add_solid(d, solid);
}

void shard_digest_add_shapes(shard_digest *d, const ovoid_shapes *shapes) {
    for (size_t i = 0; i < ovoid_shapes_get_count(shapes); i++)
        shard_digest_add_body(d, ovoid_shapes_get(shapes, i).shape, NULL);
}

void shard_digest_add_scene(shard_digest *d, const ovoid_scene *scene) {
    for (size_t i = 0; i < ovoid_scene_get_mesh_count(scene); i++)
        shard_digest_add_body(d, ovoid_scene_get_mesh(scene, i).shape, ovoid_scene_get_mesh_solid(scene, i));
}
