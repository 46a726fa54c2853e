// Numbers, read and written. Truth: the C library's own strtod and printf, which glibc rounds correctly.
#include "check.h"
#include "io/text.h"

static void check_written(double value) {
    char found[32], truth[40];
    size_t n = number_write(found, value, 17);
    snprintf(truth, sizeof truth, "%.17g", value);
    if (!CHECK(strcmp(found, truth) == 0 && n == strlen(found))) printf("  %s, not %s\n", found, truth);
    n = number_write(found, value, 6);
    snprintf(truth, sizeof truth, "%.6g", value);
    CHECK(strcmp(found, truth) == 0 && n == strlen(found));
}

static void check_read(const char *text) {
    double value = 0;
    const char *end = text + strlen(text);
    if (!CHECK(number_read(text, end, &value) == end)) {
        printf("  %s\n", text);
        return;
    }
    double truth = strtod(text, NULL);
    if (!CHECK(memcmp(&value, &truth, sizeof value) == 0)) printf("  %s: %.17g, not %.17g\n", text, value, truth);
}

static double random_bits(uint64_t *s) {
    for (;;) {
        uint64_t bits = random_next(s);
        double value;
        memcpy(&value, &bits, sizeof value);
        if (isfinite(value)) return value;
    }
}

// Any double; those of daily use; whole numbers and their neighbours; powers of two and of ten and their neighbours.
static void check_both(void) {
    uint64_t s = 41;
    for (int i = 0; i < 200000; i++) {
        check_seed = s;
        double value = random_bits(&s);
        switch (i % 5) {
        case 1: value = random_normal(&s) * pow(10, random_uniform(&s, -30, 20)); break;
        case 2: value = (double)(int64_t)(random_next(&s) % 2000001) - 1e6; break;
        case 3: value = ldexp(1, (int)(random_next(&s) % 240) - 120); break;
        case 4: value = pow(10, (double)(random_next(&s) % 40) - 20) * (double)(random_next(&s) % 10); break;
        }
        if (random_next(&s) % 2) value = nextafter(value, random_next(&s) % 2 ? INFINITY : -INFINITY);
        check_written(value);
        // 17 digits bring the double back; fewer and more are other numbers.
        char text[80];
        snprintf(text, sizeof text, "%.*g", (int)(random_next(&s) % 22) + 1, value);
        check_read(text);
    }
    check_seed = 0;
}

// 17 to 19 digits times each power of ten that is read without the C library, and some beyond.
static void check_powers(void) {
    uint64_t s = 47;
    for (int power = -50; power <= 50; power++)
        for (int i = 0; i < 300; i++) {
            check_seed = s;
            char text[80];
            uint64_t digits = random_next(&s) % 9999999999999999999u;
            snprintf(text, sizeof text, "%llue%d", (unsigned long long)(i % 3 ? digits : digits / 100), power);
            check_read(text);
            // All digits are the same, so that carries run through.
            memset(text, '0' + i % 10, 19);
            snprintf(text + 19 - i % 4, sizeof text - 19, "e%d", power);
            check_read(text);
        }
    check_seed = 0;
}

// Ties between two doubles, exact and missed by one digit far behind.
static void check_ties(void) {
    uint64_t s = 43;
    for (int i = 0; i < 20000; i++) {
        check_seed = s;
        // The middle of two neighbours has one bit more: written out exactly as a decimal.
        double a = (double)(((uint64_t)1 << 52) + (random_next(&s) >> 12));
        char text[120];
        snprintf(text, sizeof text, "%.0f.5", a);
        check_read(text);
        snprintf(text, sizeof text, "%.0f.49999999999999999999999", a);
        check_read(text);
        int shift = (int)(random_next(&s) % 30);
        snprintf(text, sizeof text, "%.40Lf", ldexpl((long double)a + 0.5L, -52 - shift));
        check_read(text);
        snprintf(text, sizeof text, "%.18Le", ldexpl((long double)a + 0.5L, -shift));
        check_read(text);
    }
    check_seed = 0;
    check_read("9007199254740993");
    check_read("9007199254740992.9999999999");
    check_read("5e-324");
    check_read("2.4703282292062327208e-324");
    check_read("1.7976931348623158e308");
    check_read("1.7976931348623159e308");
    check_read("18446744073709551615");
    check_read("99999999999999999999e-20");
    check_read("-.0000");
    check_read("00000.5e+0000000001");
}

// What is no number, and where a number ends.
static void check_ends(void) {
    static const struct {
        const char *text;
        int length; ///< of the number; -1: none
        double value;
    } cases[] = {{"1,2", 1, 1},
                 {"1e", 1, 1},
                 {"1e+", 1, 1},
                 {"1.5.2", 3, 1.5},
                 {"-", -1, 0},
                 {"+.", -1, 0},
                 {".", -1, 0},
                 {"e5", -1, 0},
                 {"", -1, 0},
                 {"x", -1, 0},
                 {"0x10", 1, 0},
                 {"- 1", -1, 0},
                 {"5.", 2, 5},
                 {"1e5e5", 3, 1e5},
                 {"infx", 3, INFINITY},
                 {"-Infinity", 9, -INFINITY},
                 {"in", -1, 0},
                 {"12345678:9", 8, 12345678},
                 {"1.234567?9", 8, 1.234567},
                 {"12345/789", 5, 12345}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        double value = 0;
        const char *end = cases[i].text + strlen(cases[i].text), *after = number_read(cases[i].text, end, &value);
        int length = after ? (int)(after - cases[i].text) : -1;
        CHECK_EQ(length, cases[i].length);
        CHECK_EQ(value, cases[i].value);
    }
    double nan = 0;
    const char *word = "NaN";
    CHECK(number_read(word, word + 3, &nan) && isnan(nan));
    // A number of a thousand digits is refused, not cut.
    char text[1200];
    memset(text, '1', sizeof text);
    CHECK(number_read(text, text + sizeof text, &nan) == NULL);
}

int main(void) {
    check_both();
    check_powers();
    check_ties();
    check_ends();
    check_written(0.0);
    check_written(-0.0);
    check_written(99999999999999999.0);
    check_written(9.9999999999999999e16);
    check_written(0.0001);
    check_written(0.00099999999999999999);
    check_written(123456);
    return check_end();
}
