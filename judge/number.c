// Numbers m 2^e and their pool. GMP: T. Granlund and others, The GNU Multiple Precision Arithmetic Library. A released
// number keeps its limbs, so that a judge in use allocates next to nothing.
#include "number.h"

#include <math.h>
#include <stdlib.h>

#define CHUNK 1024

struct pool {
    number **chunks;
    size_t chunk_count, count;
};

pool *number_pool_create(void) { return calloc(1, sizeof(pool)); }

void number_pool_destroy(pool *p) {
    if (!p) return;
    for (size_t c = 0; c < p->chunk_count; c++) {
        for (size_t i = 0; i < CHUNK; i++) mpz_clear(p->chunks[c][i].m);
        free(p->chunks[c]);
    }
    free(p->chunks);
    free(p);
}

size_t pool_get_mark(const pool *p) { return p->count; }

void pool_release(pool *p, size_t mark) { p->count = mark; }

// Adds a chunk; as in GMP, the program ends if memory runs out.
static void pool_grow(pool *p) {
    number **chunks = judge_allocate(p->chunk_count + 1, sizeof *chunks), *chunk = judge_allocate(CHUNK, sizeof *chunk);
    for (size_t i = 0; i < p->chunk_count; i++) chunks[i] = p->chunks[i];
    for (size_t i = 0; i < CHUNK; i++) mpz_init(chunk[i].m);
    chunks[p->chunk_count++] = chunk;
    free(p->chunks);
    p->chunks = chunks;
}

static number *pool_next(pool *p) {
    if (p->count == p->chunk_count * CHUNK) pool_grow(p);
    number *n = &p->chunks[p->count / CHUNK][p->count % CHUNK];
    p->count++;
    return n;
}

num number_from(pool *p, double x) {
    number *n = pool_next(p);
    int e;
    double m = frexp(x, &e);
    mpz_set_d(n->m, ldexp(m, 53));
    n->e = e - 53;
    // Short numbers stay short.
    if (mpz_sgn(n->m) == 0)
        n->e = 0;
    else {
        mp_bitcnt_t zeros = mpz_scan1(n->m, 0);
        mpz_tdiv_q_2exp(n->m, n->m, zeros);
        n->e += (long)zeros;
    }
    return n;
}

num number_from_integer(pool *p, long x) {
    number *n = pool_next(p);
    mpz_set_si(n->m, x);
    n->e = 0;
    return n;
}

num number_from_mpz(pool *p, const mpz_t m, long e) {
    number *n = pool_next(p);
    mpz_set(n->m, m);
    n->e = e;
    return n;
}

// sum of a and b times plus or minus one, on the lower of the two exponents
static num add_signed(pool *p, num a, num b, int minus) {
    number *r = pool_next(p);
    void (*op)(mpz_t, const mpz_t, const mpz_t) = minus ? mpz_sub : mpz_add;
    if (a->e == b->e || mpz_sgn(a->m) == 0 || mpz_sgn(b->m) == 0) {
        r->e = mpz_sgn(a->m) == 0 ? b->e : a->e;
        op(r->m, a->m, b->m);
    } else if (a->e > b->e) {
        r->e = b->e;
        mpz_mul_2exp(r->m, a->m, (mp_bitcnt_t)(a->e - b->e));
        op(r->m, r->m, b->m);
    } else {
        r->e = a->e;
        mpz_mul_2exp(r->m, b->m, (mp_bitcnt_t)(b->e - a->e));
        op(r->m, a->m, r->m);
    }
    return r;
}

num num_add(pool *p, num a, num b) { return add_signed(p, a, b, 0); }
num num_sub(pool *p, num a, num b) { return add_signed(p, a, b, 1); }

num num_mul(pool *p, num a, num b) {
    number *r = pool_next(p);
    mpz_mul(r->m, a->m, b->m);
    r->e = a->e + b->e;
    return r;
}

num num_neg(pool *p, num a) {
    number *r = pool_next(p);
    mpz_neg(r->m, a->m);
    r->e = a->e;
    return r;
}

num num_scaled(pool *p, num a, long k) { return number_from_mpz(p, a->m, a->e + k); }

num num_trimmed(pool *p, num a) {
    number *r = pool_next(p);
    if (mpz_sgn(a->m) == 0) {
        mpz_set_ui(r->m, 0);
        r->e = 0;
        return r;
    }
    mp_bitcnt_t zeros = mpz_scan1(a->m, 0);
    mpz_tdiv_q_2exp(r->m, a->m, zeros);
    r->e = a->e + (long)zeros;
    return r;
}

int num_sign(num a) { return mpz_sgn(a->m); }

long num_get_exponent(num a) { return a->e + (long)mpz_sizeinbase(a->m, 2); }

int num_compare(pool *p, num a, num b) {
    int sa = num_sign(a), sb = num_sign(b);
    if (sa != sb) return sa > sb ? 1 : -1;
    if (sa == 0) return 0;
    if (num_get_exponent(a) != num_get_exponent(b)) return num_get_exponent(a) > num_get_exponent(b) ? sa : -sa;
    size_t mark = pool_get_mark(p);
    int s = num_sign(num_sub(p, a, b));
    pool_release(p, mark);
    return s;
}

int num_compare_roots(pool *p, num a, num p_radicand, num b, num q_radicand) {
    int sa = num_sign(p_radicand) ? num_sign(a) : 0, sb = num_sign(q_radicand) ? num_sign(b) : 0;
    if (sa != sb) return sa > sb ? 1 : -1;
    if (sa == 0) return 0;
    size_t mark = pool_get_mark(p);
    int s = num_compare(p, num_mul(p, num_mul(p, a, a), p_radicand), num_mul(p, num_mul(p, b, b), q_radicand));
    pool_release(p, mark);
    return sa > 0 ? s : -s;
}

num num_root_below(pool *p, num a, long bits) {
    number *r = pool_next(p);
    // Shift to about 2 * bits bits and an even exponent.
    long shift = 2 * bits - (long)mpz_sizeinbase(a->m, 2);
    if (shift < 0) shift = 0;
    if ((a->e - shift) % 2 != 0) shift++;
    mpz_mul_2exp(r->m, a->m, (mp_bitcnt_t)shift);
    r->e = (a->e - shift) / 2;
    mpz_sqrt(r->m, r->m);
    return r;
}

num num_root_above(pool *p, num a, long bits) {
    num below = num_root_below(p, a, bits);
    if (num_compare(p, num_mul(p, below, below), a) == 0) return below;
    number *r = pool_next(p);
    mpz_add_ui(r->m, below->m, 1);
    r->e = below->e;
    return r;
}

num num_quotient_below(pool *p, num a, num b, long bits) {
    number *r = pool_next(p);
    long shift = bits + (long)mpz_sizeinbase(b->m, 2) - (long)mpz_sizeinbase(a->m, 2);
    if (shift < 0) shift = 0;
    mpz_mul_2exp(r->m, a->m, (mp_bitcnt_t)shift);
    mpz_fdiv_q(r->m, r->m, b->m);
    r->e = a->e - shift - b->e;
    return r;
}

double num_to_double(num a) {
    if (num_sign(a) == 0) return 0;
    if (num_get_exponent(a) > 1100) return num_sign(a) * INFINITY;
    if (num_get_exponent(a) < -1100) return 0;
    long e;
    double m = mpz_get_d_2exp(&e, a->m);
    return ldexp(m, (int)(e + a->e));
}

// The double next to `a` on the side of `direction` (-1, 1), or `a` itself.
static double to_double_toward(num a, int direction) {
    double x = num_to_double(a);
    if (isinf(x)) return (x > 0) == (direction > 0) ? x : nextafter(x, 0);
    pool *p = judge_allocate(1, sizeof *p);
    while (isfinite(x) && num_compare(p, number_from(p, x), a) * direction < 0) x = nextafter(x, direction * INFINITY);
    number_pool_destroy(p);
    return x;
}

double num_to_double_below(num a) { return to_double_toward(a, -1); }
double num_to_double_above(num a) { return to_double_toward(a, 1); }

slot slot_make(pool *p) {
    slot s = pool_next(p);
    mpz_set_ui(s->m, 0);
    s->e = 0;
    return s;
}

void slot_set(slot s, num a) {
    mpz_set(s->m, a->m);
    s->e = a->e;
}

nvec nvec_from(pool *p, ovoid_vec3 v) { return (nvec){number_from(p, v.x), number_from(p, v.y), number_from(p, v.z)}; }

nvec_slot nvec_slot_make(pool *p) { return (nvec_slot){slot_make(p), slot_make(p), slot_make(p)}; }

nvec nvec_slot_set(nvec_slot s, nvec v) {
    slot_set(s.x, v.x);
    slot_set(s.y, v.y);
    slot_set(s.z, v.z);
    return (nvec){s.x, s.y, s.z};
}

nvec nvec_zero(pool *p) {
    num zero = number_from_integer(p, 0);
    return (nvec){zero, zero, zero};
}

nvec nvec_add(pool *p, nvec a, nvec b) {
    return (nvec){num_add(p, a.x, b.x), num_add(p, a.y, b.y), num_add(p, a.z, b.z)};
}

nvec nvec_sub(pool *p, nvec a, nvec b) {
    return (nvec){num_sub(p, a.x, b.x), num_sub(p, a.y, b.y), num_sub(p, a.z, b.z)};
}

nvec nvec_scale(pool *p, nvec a, num s) { return (nvec){num_mul(p, a.x, s), num_mul(p, a.y, s), num_mul(p, a.z, s)}; }

nvec nvec_cross(pool *p, nvec a, nvec b) {
    return (nvec){num_sub(p, num_mul(p, a.y, b.z), num_mul(p, a.z, b.y)),
                  num_sub(p, num_mul(p, a.z, b.x), num_mul(p, a.x, b.z)),
                  num_sub(p, num_mul(p, a.x, b.y), num_mul(p, a.y, b.x))};
}

num nvec_dot(pool *p, nvec a, nvec b) {
    return num_add(p, num_add(p, num_mul(p, a.x, b.x), num_mul(p, a.y, b.y)), num_mul(p, a.z, b.z));
}

num nvec_norm_squared(pool *p, nvec a) { return nvec_dot(p, a, a); }

num nvec_det(pool *p, nvec a, nvec b, nvec c) { return nvec_dot(p, a, nvec_cross(p, b, c)); }

int nvec_is_zero(nvec a) { return num_sign(a.x) == 0 && num_sign(a.y) == 0 && num_sign(a.z) == 0; }
