// Decimal numbers, read and written correctly rounded and with a point, in any locale.
//
// Up to 15 digits and a power of ten up to 22 are exact in doubles, so that one multiplication or division rounds
// correctly (W. D. Clinger, How to read floating point numbers accurately, 1990). Up to 19 digits times a power of ten
// between 10^-44 and 10^44 are read as the product of two words and of the first 128 bits of that power (D. Lemire,
// Number parsing at a gigabyte per second, 2021; N. Mushtak and D. Lemire, Fast number parsing without fallback, 2023,
// prove that these bits decide the rounding). All other numbers go to the C library, some ten times slower.
//
// Powers of ten up to 44 are exact in double-double, since 5^44 < 2^106, by which numbers are written.
#include "io/powers.h"
#include "io/text.h"
#include "linear/exact.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

// The exact power 10^k, 0 <= k <= POWER_MAX.
static dd exact_power(int k) {
    return k <= 22 ? dd_from(power_of_ten[k]) : two_product(power_of_ten[22], power_of_ten[k - 22]);
}

// ---- reading

static int is_digit(char c) { return c >= '0' && c <= '9'; }

// Reads inf, infinity or nan.
static const char *read_special(const char *at, const char *end, double sign, double *value) {
    if (text_begins_with(at, end, "nan")) {
        *value = NAN;
        return at + 3;
    }
    if (!text_begins_with(at, end, "inf")) return NULL;
    *value = sign * INFINITY;
    return text_begins_with(at, end, "infinity") ? at + 8 : at + 3;
}

// Reads with strtod the numbers that the fast path cannot round; strtod needs the locale's point and a terminated text.
// A text that does not fit into `copy` is refused; the exact value of any double does (767 digits and an exponent).
static const char *read_slow(const char *begin, const char *end, double *value) {
    char copy[1024];
    size_t length = (size_t)(end - begin);
    const char *point = localeconv()->decimal_point;
    size_t point_length = strlen(point);
    if (length + point_length >= sizeof copy) return NULL;
    size_t n = 0;
    for (const char *c = begin; c < end; c++) {
        if (*c == '.') {
            memcpy(copy + n, point, point_length);
            n += point_length;
        } else {
            copy[n++] = *c;
        }
    }
    copy[n] = 0;
    *value = strtod(copy, NULL);
    return end;
}

/// A number of 128 bits.
typedef struct wide {
    uint64_t high, low;
} wide;

static wide multiply(uint64_t a, uint64_t b) {
    uint64_t a1 = a >> 32, a0 = (uint32_t)a, b1 = b >> 32, b0 = (uint32_t)b;
    uint64_t low = a0 * b0, middle = a1 * b0 + (low >> 32), other = a0 * b1 + (uint32_t)middle;
    return (wide){a1 * b1 + (middle >> 32) + (other >> 32), other << 32 | (uint32_t)low};
}

// The bits of the product of w, whose first bit is set, and of 5^q that a double and its rounding need: 55 at least.
static wide multiply_power(uint64_t w, int q) {
    const uint64_t *power = power_of_five[q + POWER_MAX];
    wide product = multiply(w, power[0]);
    // All later bits are ones: what is behind them may carry.
    if ((product.high & 0x1ff) == 0x1ff) {
        uint64_t more = multiply(w, power[1]).high;
        product.low += more;
        product.high += product.low < more;
    }
    return product;
}

// floor(q log2 10).
static int find_binary_power(int q) { return (int)(217706 * (uint64_t)(q + 32768) >> 16) - 108853; }

// Rounds mantissa 10^q, to the nearest double and half way to the even one; 0 where q is out of range.
static int read_exact(uint64_t mantissa, int q, double *value) {
    if (q < -POWER_MAX || q > POWER_MAX) return 0;
    *value = 0;
    if (!mantissa) return 1;
    int zeros = __builtin_clzll(mantissa);
    wide product = multiply_power(mantissa << zeros, q);
    int upper = (int)(product.high >> 63), shift = upper + 9;
    uint64_t bits = product.high >> shift; // 54: one more than a double has
    int power = find_binary_power(q) + 63 + upper - zeros;
    // Half way only where 5^q, or 5^-q as a factor of the mantissa, has at most 64 bits.
    int is_exact = product.low <= 1 && q >= -4 && q <= 23 && bits << shift == product.high;
    if (is_exact && (bits & 3) == 1) bits--;
    bits = (bits + (bits & 1)) >> 1;
    // A carry makes 2^53, whose bits go into the exponent.
    bits += ((uint64_t)(power + 1022) << 52);
    memcpy(value, &bits, sizeof *value);
    return 1;
}

/// The digits of a number, without its point.
typedef struct digit_run {
    uint64_t mantissa; ///< the first 19 digits behind leading zeros
    int count, used;   ///< all digits; those behind leading zeros
} digit_run;

// The value of eight digits, the first one in the lowest byte; -1 where they are none. Pairs, then fours, then all are
// put together side by side in one word (D. Lemire, 2021, as above).
static int64_t read_eight(const char *at) {
    const unsigned char *b = (const unsigned char *)at;
    uint64_t v = (uint64_t)b[0] | (uint64_t)b[1] << 8 | (uint64_t)b[2] << 16 | (uint64_t)b[3] << 24 |
                 (uint64_t)b[4] << 32 | (uint64_t)b[5] << 40 | (uint64_t)b[6] << 48 | (uint64_t)b[7] << 56;
    if (((v & 0xf0f0f0f0f0f0f0f0) | ((v + 0x0606060606060606) & 0xf0f0f0f0f0f0f0f0) >> 4) != 0x3333333333333333)
        return -1;
    v -= 0x3030303030303030;
    v = v * 10 + (v >> 8);
    const uint64_t ends = 0x000000ff000000ff;
    return (int64_t)(((v & ends) * 0x000f424000000064 + (v >> 16 & ends) * 0x0000271000000001) >> 32);
}

// Adds the digits that begin at `at`, and returns the byte after them.
static const char *read_digits(const char *at, const char *end, digit_run *run) {
    const char *begin = at;
    while (at < end && is_digit(*at)) {
        int64_t eight = run->mantissa && run->used <= 11 && end - at >= 8 ? read_eight(at) : -1;
        if (eight >= 0) {
            run->mantissa = run->mantissa * 100000000 + (uint64_t)eight;
            run->used += 8;
            at += 8;
            continue;
        }
        if (run->used < 19) run->mantissa = run->mantissa * 10 + (uint64_t)(*at - '0');
        run->used += run->mantissa > 0;
        at++;
    }
    run->count += (int)(at - begin);
    return at;
}

const char *number_read(const char *at, const char *end, double *value) {
    const char *begin = at;
    double sign = 1;
    if (at < end && (*at == '-' || *at == '+')) sign = *at++ == '-' ? -1 : 1;
    if (at < end && !is_digit(*at) && *at != '.') return read_special(at, end, sign, value);
    // Digits before and after the point; beyond 19 they do not fit and mark the number as slow.
    digit_run run = {0};
    int exponent = 0;
    at = read_digits(at, end, &run);
    if (at < end && *at == '.') {
        int before = run.count;
        at = read_digits(at + 1, end, &run);
        exponent = before - run.count;
    }
    if (!run.count) return NULL;
    if (at < end && (*at == 'e' || *at == 'E')) {
        int64_t power;
        const char *after = integer_read(at + 1, end, &power);
        if (after) {
            at = after;
            exponent = power > 100000 ? 100000 : power < -100000 ? -100000 : exponent + (int)power;
        }
    }
    if (run.mantissa <= (uint64_t)1 << 53 && exponent >= -22 && exponent <= 22) {
        double m = (double)run.mantissa;
        *value = sign * (exponent < 0 ? m / power_of_ten[-exponent] : m * power_of_ten[exponent]);
        return at;
    }
    if (run.used > 19 || !read_exact(run.mantissa, exponent, value)) return read_slow(begin, at, value);
    *value *= sign;
    return at;
}

const char *integer_read(const char *at, const char *end, int64_t *value) {
    int negative = 0;
    if (at < end && (*at == '-' || *at == '+')) negative = *at++ == '-';
    if (at == end || !is_digit(*at)) return NULL;
    int64_t v = 0;
    for (; at < end && is_digit(*at); at++) v = v > (INT64_MAX - 9) / 10 ? INT64_MAX : v * 10 + (*at - '0');
    *value = negative ? -v : v;
    return at;
}

// ---- writing

// The 17 digits of |value| and the power of ten of the first; 0 where double-double does not decide the last one.
static int find_digits(double value, uint64_t *digits, int *power) {
    int e;
    (void)frexp(value, &e);
    // The estimate of the power is right or one too small.
    int p = (int)floor((e - 1) * 0.30102999566398120);
    for (int attempt = 0; attempt < 2; attempt++, p++) {
        if (16 - p < 0 || 16 - p > POWER_MAX) return 0;
        dd scaled = dd_mul(dd_from(value), exact_power(16 - p));
        if (scaled.high >= 1.5e17) continue;
        // high is a whole number here: above 2^53 all doubles are.
        double below = floor(scaled.low), rest = scaled.low - below;
        uint64_t n = (uint64_t)((int64_t)scaled.high + (int64_t)below) + (rest > 0.5);
        if (n >= 100000000000000000u) continue;
        if (n < 10000000000000000u || fabs(rest - 0.5) < 1e-9) return 0;
        *digits = n;
        *power = p;
        return 1;
    }
    return 0;
}

// %.17g of a number by its digits: no zeros at the end, an exponent below 1e-4 and from 1e17 on.
static size_t write_digits(char out[32], uint64_t n, int power, int is_negative) {
    char text[17];
    for (int i = 16; i >= 0; i--, n /= 10) text[i] = (char)('0' + n % 10);
    int count = 17;
    while (count > 1 && text[count - 1] == '0') count--;
    char *at = out;
    if (is_negative) *at++ = '-';
    int before = power < -4 ? 1 : power + 1; // digits before the point; 0 or less: zeros after it
    if (before <= 0) {
        memcpy(at, "0.000", 5);
        at += 2 - before;
    }
    for (int i = 0; i < count || i < before; i++) {
        if (i == before && i > 0) *at++ = '.';
        *at++ = (char)(i < count ? text[i] : '0');
    }
    *at = 0;
    if (power < -4) at += snprintf(at, 8, "e-%02d", -power);
    return (size_t)(at - out);
}

// Writes with the C library, and replaces the locale's point, which may have several bytes.
static size_t write_slow(char out[32], double value, int digits) {
    size_t n = (size_t)snprintf(out, 32, "%.*g", digits, value);
    const char *point = localeconv()->decimal_point;
    if (point[0] == '.' && !point[1]) return n;
    char *at = strstr(out, point);
    if (!at) return n;
    size_t length = strlen(point);
    *at = '.';
    memmove(at + 1, at + length, n - (size_t)(at - out) - length + 1);
    return n - length + 1;
}

size_t number_write(char out[32], double value, int digits) {
    if (isnan(value)) return (size_t)snprintf(out, 32, "nan");
    if (isinf(value)) return (size_t)snprintf(out, 32, value < 0 ? "-inf" : "inf");
    uint64_t n;
    int power;
    if (digits == 17 && value != 0 && find_digits(fabs(value), &n, &power))
        return write_digits(out, n, power, value < 0);
    if (value == 0 && !signbit(value)) {
        memcpy(out, "0", 2);
        return 1;
    }
    return write_slow(out, value, digits);
}
