// From the state of a search to the answer, and the pipeline that all queries share.
#ifndef OVOID_QUERY_ANSWER_H
#define OVOID_QUERY_ANSWER_H

#include "query/search.h"

/// The answer; its beginning alone.
void answer_write(search *s, ovoid_answer *out);
ovoid_verdict answer_make_verdict(search *s);

/// The exact methods, from the bounds and the simplex that the stages before them left, until the question is answered
/// or there is no more to be done. cover may be NULL.
void answer_search(search *s, const ovoid_pair *pair, const ovoid_proof *earlier, simplex *start, ovoid_cover *cover);

/// 1 if the options' numbers make sense; fills in the defaults. NULL: all of them.
int options_make(const ovoid_options *given, ovoid_options *options);

/// The answer of a query that was refused: no bracket.
ovoid_answer answer_make_refused(ovoid_limit limit);

/// The whole pipeline for one question; cover may be NULL.
ovoid_answer answer_find(const ovoid_pair *pair, const ovoid_options *given, const question *ask,
                         const ovoid_proof *earlier, ovoid_cover *cover);

/// Likewise inside a public function: the floating-point environment is the default one already.
void answer_find_inside(const ovoid_pair *pair, const ovoid_options *given, question ask, const ovoid_proof *earlier,
                        ovoid_cover *cover, ovoid_answer *out);

/// ovoid_answer_check, likewise inside.
ovoid_code answer_check_inside(const ovoid_pair *pair, const ovoid_answer *x, const ovoid_cover *cover,
                               ovoid_error *error);

/// Of that, the lower bound alone: does the proof's normal show it?
ovoid_code lower_check_inside(const ovoid_pair *pair, double lower, const ovoid_proof *proof, ovoid_error *error);

/// The questions.
static inline question question_make_collide(void) {
    return (question){.far = 0, .near = -INFINITY, .beyond = OVOID_LIMIT_ANSWERED};
}
static inline question question_make_within(double margin) {
    return (question){.far = margin, .near = margin, .wants_bracket = 1, .beyond = OVOID_LIMIT_ANSWERED};
}
static inline question question_make_distance(const ovoid_options *options) {
    double cap = options && options->cap != 0 ? options->cap : INFINITY;
    return (question){.far = cap, .near = -INFINITY, .wants_bracket = 1, .beyond = OVOID_LIMIT_CAP};
}
static inline question question_make_depth(const ovoid_options *options) {
    question ask = question_make_distance(options);
    ask.wants_depth = 1;
    return ask;
}

/// Does a pair start from the line of centres, without a look at the outer ellipsoids? Far apart it is as good a
/// direction. Of few vertices a support costs less than the ellipsoids: they are worth it only where the sign is asked
/// and the spheres overlap so that the line may not part the bodies and another direction may. spheres: the lower bound
/// of the enclosing spheres (glance.h).
enum { LINE_VERTICES = 40 };
static inline int question_takes_line(const question *ask, const ovoid_shape *a, const ovoid_shape *b, double spheres) {
    double reach = a->reach + b->reach;
    if (a->vertex_count + b->vertex_count > LINE_VERTICES) return ask->far == INFINITY && spheres > reach;
    return ask->far == INFINITY || spheres > -0.3 * reach || spheres < -0.6 * reach;
}

#endif
