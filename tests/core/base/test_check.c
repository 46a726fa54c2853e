// The tests' own words: a check that must fail fails, and one that must pass passes. Truth: the arithmetic of whole
// numbers, which doubles do not have above 2^53. The checks that must fail are made in silence and taken back.
#include "check.h"

#include <limits.h>

// 1 if the check said what it must, and counted it.
static int is_said(int ok, int wanted, long before_passed, long before_failed) {
    int good =
        ok == wanted && check_passed - before_passed == (wanted != 0) && check_failed - before_failed == (wanted == 0);
    check_passed = before_passed;
    check_failed = before_failed;
    return good;
}

// A failing check prints; here it does not, as of the twenty-first.
#define EXPECT(check, wanted)                                                                                          \
    do {                                                                                                               \
        long passed_ = check_passed, failed_ = check_failed;                                                           \
        check_failed = 1000;                                                                                           \
        int ok_ = (check), good_ = is_said(ok_, (wanted), passed_, 1000);                                              \
        check_failed = failed_;                                                                                        \
        CHECK(good_ &&#check);                                                                                         \
    } while (0)

static void check_whole_numbers(void) {
    const uint64_t large = ((uint64_t)1 << 53) + 1;
    EXPECT(CHECK_EQ(large, (uint64_t)1 << 53), 0);
    EXPECT(CHECK_EQ(large, large), 1);
    EXPECT(CHECK_EQ(large, 0x1p53), 0);
    EXPECT(CHECK_EQ(0x1p53, large - 1), 1);
    EXPECT(CHECK_LE(large, 0x1p53), 0);
    EXPECT(CHECK_LE(0x1p53, large), 1);
    EXPECT(CHECK_EQ(UINT64_MAX, UINT64_MAX - 1), 0);
    EXPECT(CHECK_EQ(UINT64_MAX, -1), 0);
    EXPECT(CHECK_EQ(UINT64_MAX, 0x1p64), 0);
    EXPECT(CHECK_LE(UINT64_MAX, 0x1p64), 1);
    EXPECT(CHECK_LE(-1, (size_t)0), 1);
    EXPECT(CHECK_LE((size_t)0, -1), 0);
    EXPECT(CHECK_EQ(INT64_MIN, INT64_MIN), 1);
    EXPECT(CHECK_EQ(INT64_MIN, INT64_MIN + 1), 0);
    EXPECT(CHECK_EQ(INT64_MIN, -0x1p63), 1);
    EXPECT(CHECK_LE(-0x1.8p63, INT64_MIN), 1);
    EXPECT(CHECK_LE(INT64_MIN, -0x1.8p63), 0);
    EXPECT(CHECK_EQ((uint8_t)200, 200), 1);
    EXPECT(CHECK_EQ((int8_t)-100, -100), 1);
    EXPECT(CHECK_EQ(UINT_MAX, -1), 0);
}

static void check_doubles(void) {
    EXPECT(CHECK_EQ(0.5, 0), 0);
    EXPECT(CHECK_LE(0.5, 0), 0);
    EXPECT(CHECK_LE(0, 0.5), 1);
    EXPECT(CHECK_LE(-0.5, 0), 1);
    EXPECT(CHECK_LE(-1, -0.5), 1);
    EXPECT(CHECK_LE(-0.5, -1), 0);
    EXPECT(CHECK_EQ(-0.0, 0.0), 1);
    EXPECT(CHECK_EQ(NAN, NAN), 0);
    EXPECT(CHECK_EQ(NAN, 0), 0);
    EXPECT(CHECK_LE(NAN, 1), 0);
    EXPECT(CHECK_LE(1, NAN), 0);
    EXPECT(CHECK_LE(1.0, NAN), 0);
    EXPECT(CHECK_LE(1, INFINITY), 1);
    EXPECT(CHECK_LE(-INFINITY, INT64_MIN), 1);
    EXPECT(CHECK_LE(0.1f, 0.1), 0);
    EXPECT(CHECK_NEAR(1, 1.5, 0.5), 1);
    EXPECT(CHECK_NEAR(1, 1.5, 0.49), 0);
    EXPECT(CHECK_NEAR(NAN, 1, 1), 0);
    EXPECT(CHECK_NEAR(1, 1, NAN), 0);
    EXPECT(CHECK(0), 0);
    EXPECT(CHECK(2), 1);
}

// Arguments are evaluated once.
static void check_evaluation(void) {
    int a = 0, b = 0;
    CHECK_EQ(++a, ++b);
    CHECK_LE(++a, ++b);
    CHECK_NEAR(++a, ++b, 0);
    CHECK(a == 3 && b == 3);
}

int main(void) {
    check_whole_numbers();
    check_doubles();
    check_evaluation();
    return check_end();
}
