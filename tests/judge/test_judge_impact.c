// The answers at free_until and hit_at before the exact judge: for the poses that ovoid_moving_shape_compute_pose gives
// there, each bound must be shown by its proof in rational arithmetic, and the one at the hit must be at most the
// margin.
#include "judge.h"
#include "moving.h"

int main(void) {
    judge *context = judge_create();
    long hits = 0;
    for (uint64_t seed = 1; seed <= 400; seed++) {
        moving_case c;
        check_seed = seed;
        moving_make(&c, seed);
        double margin = seed % 3 ? 0 : 0.1 * c.size;
        ovoid_impact x = ovoid_impact_find(&(ovoid_moving_pair){c.a, c.b, margin}, NULL);
        ovoid_pair pair = moving_get_pair(&c.a, &c.b, x.free_until);
        ovoid_error error = {.message = ""};
        if (!CHECK_EQ(judge_verify_answer(context, &pair, &x.free, NULL, &error), OVOID_OK))
            printf("  %s\n", error.message);
        if (x.status == OVOID_IMPACT_HIT) {
            pair = moving_get_pair(&c.a, &c.b, x.hit_at);
            if (!CHECK_EQ(judge_verify_answer(context, &pair, &x.hit, NULL, &error), OVOID_OK))
                printf("  %s\n", error.message);
            CHECK_LE(x.hit.upper, margin);
            hits++;
        }
        judge_forget(context);
        moving_destroy(&c);
    }
    CHECK_LE(20, hits);
    judge_destroy(context);
    return check_end();
}
