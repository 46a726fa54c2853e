// What the module and its caller pass each other: numbers in one array, in the order of their fields, arrays by
// address. A call reads its numbers from the array's beginning and writes its results there. Addresses are the caller's
// to release; handles are addresses of shapes, compounds, solids, robots.
#ifndef OVOID_WEB_EXCHANGE_H
#define OVOID_WEB_EXCHANGE_H

#include "ovoid/ovoid.h"

/// A function that the module exports under its own name.
#define EXPORT(name) __attribute__((export_name(#name))) name

/// Room of the array.
#define EXCHANGE_COUNT 4096

/// The array, and the error of the last call that failed.
extern double exchange[EXCHANGE_COUNT];
extern ovoid_error exchange_error;

/// The cover of the last depth that was asked, and of the next check.
extern ovoid_cover cover;

/// Reads and writes fields one after another.
const double *read_vec3(const double *from, ovoid_vec3 *v);
const double *read_pose(const double *from, ovoid_pose *pose);
double *write_vec3(double *to, ovoid_vec3 v);
double *write_sym3(double *to, ovoid_sym3 m);
double *write_pose(double *to, const ovoid_pose *pose);

/// What a body is: two bits each of `kinds`, those of a first.
enum { IS_SHAPE, IS_COMPOUND, IS_SOLID };

/// A body of one kind, with its pose.
const double *read_body(const double *from, unsigned kind, const void *body, ovoid_body *out);

/// A number as an unsigned one: what is none, or too large, becomes the largest, which is no index of anything.
uint32_t read_index(double x);

/// Both tolerances, the cap, the iterations.
const double *read_options(const double *from, ovoid_options *options);

/// 15 numbers, the proof left out.
double *write_answer(double *to, const ovoid_answer *answer);
const double *read_answer(const double *from, ovoid_answer *answer);

/// 38 numbers.
double *write_proof(double *to, const ovoid_proof *proof);
const double *read_proof(const double *from, ovoid_proof *proof);

#endif
