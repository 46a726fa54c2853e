// Contacts of any bodies in any poses, from an earlier contact of any bytes. Truth: the verifier without a cover where
// the proof needs none, the bracket of ovoid_depth, and the same contact from the other side.
#include "bodies.h"

// Of an earlier contact the upper bound alone is taken on trust, so it must claim none.
static ovoid_manifold take_earlier(fuzz_bytes *from, const ovoid_manifold *right) {
    ovoid_manifold m = *right;
    uint8_t *bytes = (uint8_t *)&m;
    int count = take_byte(from) & 31;
    for (int i = 0; i < count; i++) bytes[(uint8_t)take_byte(from) % sizeof m] = (uint8_t)take_byte(from);
    m.memory.flags &= ~1U;
    return m;
}

static void check(const ovoid_pair *pair, const ovoid_manifold *m, const ovoid_manifold_options *o) {
    ovoid_error error = {OVOID_OK, -1, ""};
    static ovoid_manifold_polygon polygon;
    fuzz_require(m->count <= 4 && (m->axis == OVOID_MANIFOLD_NONE) == (m->count == 0));
    fuzz_require(ovoid_manifold_verify(pair, m, o, &error) == OVOID_OK);
    ovoid_manifold_points p = ovoid_manifold_compute_points(pair, m);
    fuzz_require(p.count == m->count);
    for (uint32_t i = 0; i < p.count; i++) fuzz_require(isfinite(p.points[i].separation) && p.points[i].id == m->id[i]);
    if (!m->count) return;
    fuzz_require(ovoid_manifold_compute_polygon(pair, m, o, &polygon) == OVOID_OK);
    fuzz_require(polygon.inner <= polygon.outer && polygon.count <= OVOID_MANIFOLD_CORNERS);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static uint64_t memory[OVOID_COVER_SIZE / sizeof(uint64_t)];
    static ovoid_cover cover = {.memory = memory, .size = sizeof memory};
    fuzz_bytes from = {data, size};
    int is_wild = take_byte(&from) > 96;
    double margin = fabs(take_double(&from)), keep = fabs(take_double(&from)), tolerance = fabs(take_double(&from));
    ovoid_shape *a = take_any_shape(&from, is_wild), *b = take_any_shape(&from, is_wild);
    if (a && b) {
        ovoid_pair pair = {a, b, take_any_pose(&from, is_wild), take_any_pose(&from, is_wild)};
        ovoid_manifold_options o = {.margin = margin, .keep = keep, .tolerance = tolerance, .cover = &cover};
        ovoid_manifold cold = ovoid_manifold_find(&pair, &o, NULL);
        check(&pair, &cold, &o);
        ovoid_answer x = ovoid_depth(&pair, NULL, NULL, NULL);
        fuzz_require(cold.lower <= x.upper && x.lower <= cold.upper);
        ovoid_manifold earlier = take_earlier(&from, &cold), warm = ovoid_manifold_find(&pair, &o, &earlier);
        check(&pair, &warm, &o);
        (void)ovoid_manifold_verify(&pair, &earlier, &o, NULL);
        (void)ovoid_manifold_compute_points(&pair, &earlier);
    }
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    return 0;
}
