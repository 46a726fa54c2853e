// Checks of single answers: by the judge in exact arithmetic where it was built in, else by the library's own check.
#ifndef OVOID_CLI_VERDICT_H
#define OVOID_CLI_VERDICT_H

#include <ovoid/ovoid.h>

/// Working memory for some threads.
typedef struct verdict verdict;

/// Makes the memory for that many threads at a time; NULL where memory is out. options: of the queries, whose tolerance
/// says what touching is.
verdict *verdict_create(unsigned threads, const ovoid_options *options);
void verdict_destroy(verdict *verdict);

/// Checks that the answer follows from its proof. points: also that the witness points differ by the distance along the
/// normal. OVOID_OK, or a code with a sentence in *error. Callable from several threads.
ovoid_code verdict_verify(verdict *verdict, const ovoid_pair *pair, const ovoid_answer *answer,
                          const ovoid_cover *cover, int points, ovoid_error *error);

/// The same for the answer of two bodies, of which one at least is a compound, with its exclusions and cover. points:
/// the deciding parts, where their witness points are checked; else NULL.
ovoid_code verdict_verify_compound(verdict *verdict, const ovoid_body_pair *pair, const ovoid_body_answer *answer,
                                   const ovoid_exclusions *exclusions, const ovoid_pair *points, ovoid_error *error);

/// The same for the answer of two bodies, of which one at least is a solid. points: of the deciding triangles.
ovoid_code verdict_verify_solid(verdict *verdict, const ovoid_body_pair *pair, const ovoid_body_answer *answer,
                                const ovoid_exclusions *exclusions, int points, ovoid_error *error);

/// 1 if the checks are in exact arithmetic.
int verdict_is_exact(void);

#endif
