// Decimal numbers, read and written correctly rounded and with a point, in any locale.
//
// Up to 15 digits and a power of ten up to 22 are exact in doubles, so that one multiplication or division rounds
// correctly (W. D. Clinger, How to read floating point numbers accurately, 1990). Powers of ten up to 44 are exact in
// double-double, since 5^44 < 2^106: there, the product or quotient is off by at most 2^-98, which decides the rounding
// unless the true value is that near to a tie. All other numbers go to the C library, some ten times slower.
#include "io/text.h"
#include "linear/exact.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double power_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                      1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

enum { EXACT_POWER_MAX = 44 };

// The exact power 10^k, 0 <= k <= EXACT_POWER_MAX.
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

// Rounds mantissa 10^exponent where double-double decides the rounding; 0 where it does not.
static int read_exact(uint64_t mantissa, int exponent, double *value) {
    if (exponent < -EXACT_POWER_MAX || exponent > EXACT_POWER_MAX) return 0;
    // Both halves of the mantissa are exact.
    dd m = two_sum((double)(mantissa >> 32) * 0x1p32, (double)(mantissa & 0xffffffffu));
    dd v = exponent < 0 ? dd_div(m, exact_power(-exponent)) : dd_mul(m, exact_power(exponent));
    // Undecided where v is within 2^-90 of half way between two doubles: then |low| is half their distance. Below a
    // power of two the distance is half of that, so low near a quarter is undecided too.
    double quarter = 0.25 * (nextafter(v.high, INFINITY) - v.high), low = fabs(v.low), slack = 0x1p-90 * v.high;
    if (fabs(low - quarter) <= slack || fabs(low - 2 * quarter) <= slack) return 0;
    *value = v.high;
    return 1;
}

const char *number_read(const char *at, const char *end, double *value) {
    const char *begin = at;
    double sign = 1;
    if (at < end && (*at == '-' || *at == '+')) sign = *at++ == '-' ? -1 : 1;
    if (at < end && !is_digit(*at) && *at != '.') return read_special(at, end, sign, value);
    // Digits before and after the point; beyond 19 they do not fit and mark the number as slow.
    uint64_t mantissa = 0;
    int digits = 0, used = 0, exponent = 0;
    for (; at < end && is_digit(*at); at++, digits++) {
        if (used < 19) mantissa = mantissa * 10 + (uint64_t)(*at - '0');
        used += mantissa > 0;
    }
    if (at < end && *at == '.')
        for (at++; at < end && is_digit(*at); at++, digits++, exponent--) {
            if (used < 19) mantissa = mantissa * 10 + (uint64_t)(*at - '0');
            used += mantissa > 0;
        }
    if (!digits) return NULL;
    if (at < end && (*at == 'e' || *at == 'E')) {
        int64_t power;
        const char *after = integer_read(at + 1, end, &power);
        if (after) {
            at = after;
            exponent = power > 100000 ? 100000 : power < -100000 ? -100000 : exponent + (int)power;
        }
    }
    if (mantissa <= (uint64_t)1 << 53 && exponent >= -22 && exponent <= 22) {
        double m = (double)mantissa;
        *value = sign * (exponent < 0 ? m / power_of_ten[-exponent] : m * power_of_ten[exponent]);
        return at;
    }
    if (used > 19 || !read_exact(mantissa, exponent, value)) return read_slow(begin, at, value);
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
        if (16 - p < 0 || 16 - p > EXACT_POWER_MAX) return 0;
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
