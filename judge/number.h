// Exact numbers m 2^e with an integer m of any size (GMP): every double is one, and so is every sum, difference and
// product of them. There is no division: if a bound needs one, both sides are multiplied instead. Numbers live in a
// pool that is released as a stack, so that code reads like formulas.
#ifndef OVOID_JUDGE_NUMBER_H
#define OVOID_JUDGE_NUMBER_H

#include <gmp.h>

#include "ovoid/linear.h"

/// A number of a pool; constant once made.
typedef struct number {
    mpz_t m;
    long e;
} number;
typedef const number *num;

/// Zeroed memory for count items; if there is none the program ends (judge_set_out_of_memory).
void *judge_allocate(size_t count, size_t size);

/// The memory of numbers. pool_release frees all numbers made since pool_get_mark returned the mark.
typedef struct pool pool;
pool *number_pool_create(void);
void number_pool_destroy(pool *p);
size_t pool_get_mark(const pool *p);
void pool_release(pool *p, size_t mark);

/// A number from a finite double, from an integer, from m 2^e.
num number_from(pool *p, double x);
num number_from_integer(pool *p, long x);
num number_from_mpz(pool *p, const mpz_t m, long e);

num num_add(pool *p, num a, num b);
num num_sub(pool *p, num a, num b);
num num_mul(pool *p, num a, num b);
num num_neg(pool *p, num a);
/// a 2^k
num num_scaled(pool *p, num a, long k);
/// a, with trailing zero bits moved into the exponent.
num num_trimmed(pool *p, num a);

/// -1, 0, 1
int num_sign(num a);
/// The least k with |a| < 2^k, of a number that is not zero.
long num_get_exponent(num a);
/// num_sign(a - b)
int num_compare(pool *p, num a, num b);
/// The sign of a sqrt(p) - b sqrt(q) for p, q >= 0: decided by the signs and the squares.
int num_compare_roots(pool *p, num a, num p_radicand, num b, num q_radicand);

/// Bounds of sqrt(a), a >= 0, of about `bits` bits: floor and the next number above.
num num_root_below(pool *p, num a, long bits);
num num_root_above(pool *p, num a, long bits);
/// Bounds of a / b, b > 0, relative precision about 2^-bits.
num num_quotient_below(pool *p, num a, num b, long bits);

/// The nearest double toward zero and the doubles below and above (for reports and brackets).
double num_to_double(num a);
double num_to_double_below(num a);
double num_to_double_above(num a);

/// Room for one number that outlives a release: a slot made before the mark, written later.
typedef number *slot;
slot slot_make(pool *p);
void slot_set(slot s, num a);

/// Vectors of three.
typedef struct nvec {
    num x, y, z;
} nvec;
nvec nvec_from(pool *p, ovoid_vec3 v);
/// Room for a vector that outlives a release; writes it, and returns it as a vector.
typedef struct nvec_slot {
    slot x, y, z;
} nvec_slot;
nvec_slot nvec_slot_make(pool *p);
nvec nvec_slot_set(nvec_slot s, nvec v);
nvec nvec_zero(pool *p);
nvec nvec_add(pool *p, nvec a, nvec b);
nvec nvec_sub(pool *p, nvec a, nvec b);
nvec nvec_scale(pool *p, nvec a, num s);
nvec nvec_cross(pool *p, nvec a, nvec b);
num nvec_dot(pool *p, nvec a, nvec b);
num nvec_norm_squared(pool *p, nvec a);
/// det(a, b, c)
num nvec_det(pool *p, nvec a, nvec b, nvec c);
int nvec_is_zero(nvec a);

#endif
