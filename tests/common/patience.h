// A host's watch that stops a call at its k-th question.
#ifndef OVOID_TESTS_PATIENCE_H
#define OVOID_TESTS_PATIENCE_H

#include <ovoid/base.h>

/// Returns 1 from a question on.
typedef struct patience {
    size_t asked, most;
} patience;

static inline int patience_is_over(void *context) {
    patience *p = context;
    return ++p->asked > p->most;
}

static inline ovoid_watch make_watch(patience *p, size_t most) {
    *p = (patience){0, most};
    return (ovoid_watch){patience_is_over, p};
}

#endif
