// The smooth bracket and the gradient of the exact distance. Truth: the bracket holds the exact one, is no wider than
// it says where its sides come from the same ellipsoids, its derivatives are finite and symmetric and do not change
// where both bodies are moved together.
#include "bodies.h"

static void check_side(const ovoid_smooth_value *v, int order) {
    fuzz_require(v->error >= 0 && v->condition >= 1);
    double sum[3] = {0}, row[3] = {0}, most = 0;
    for (int i = 0; i < 12; i++) {
        fuzz_require(isfinite(v->gradient[i]) && (order > 0 || v->gradient[i] == 0));
        if (i % 6 < 3) sum[i % 3] += v->gradient[i];
        for (int j = 0; j < 12; j++) {
            fuzz_require(isfinite(v->hessian[i][j]) && v->hessian[i][j] == v->hessian[j][i]);
            if (i % 6 < 3 && j < 3) row[j] += v->hessian[i][j], most = fmax(most, fabs(v->hessian[i][j]));
        }
    }
    for (int k = 0; k < 3; k++) fuzz_require(sum[k] == 0 && fabs(row[k]) <= 1e-12 * most);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    fuzz_bytes from = {data, size};
    int is_wild = take_byte(&from) > 96, order = take_byte(&from) & 3;
    ovoid_shape *a = take_any_shape(&from, is_wild), *b = take_any_shape(&from, is_wild);
    if (a && b) {
        ovoid_pair pair = {a, b, take_any_pose(&from, is_wild), take_any_pose(&from, is_wild)};
        static uint64_t memory[OVOID_COVER_SIZE / sizeof(uint64_t)];
        static ovoid_cover cover = {.memory = memory, .size = sizeof memory};
        ovoid_smooth s = ovoid_pair_compute_smooth(&pair, order);
        ovoid_answer x = ovoid_depth(&pair, NULL, NULL, &cover);
        ovoid_gradient g = ovoid_answer_compute_gradient(&pair, &x, &cover);
        fuzz_require(s.outer.value <= x.upper && x.lower <= s.inner.value);
        fuzz_require(g.slope >= 0 && g.slope <= 1 && g.turn >= 0 && g.slide >= 0 && g.margin >= 0);
        fuzz_require(!g.has_rotation || g.has_translation);
        for (int i = 0; i < 12; i++) fuzz_require(isfinite(g.gradient[i]));
        if (s.limit == OVOID_LIMIT_NONE) {
            check_side(&s.outer, order);
            check_side(&s.inner, order);
        }
    }
    ovoid_shape_destroy(a);
    ovoid_shape_destroy(b);
    return 0;
}
