// One judge for each thread: a judge caches what it proved of a shape's inner ellipsoid, and works for one thread at a
// time. Threads take one and give it back.
#include "verdict.h"

#ifdef OVOID_HAVE_JUDGE

#include "base/args.h"
#include "base/message.h"

#include <judge.h>

#include <pthread.h>
#include <stdlib.h>
#include <unistd.h>

struct verdict {
    ovoid_options options;
    pthread_mutex_t lock;
    unsigned count; ///< judges that are free, at the front; others are made as they are needed
    judge **judges;
};

/// GMP cannot go on; nothing has been written that is not whole.
static void end_out_of_memory(void) {
    message_error("out of memory for exact arithmetic; each thread needs its own: give fewer --threads");
    _exit(EXIT_INPUT);
}

static judge *make_judge(const ovoid_options *options) {
    judge *made = judge_create();
    if (made) judge_set_options(made, options);
    return made;
}

verdict *verdict_create(unsigned threads, const ovoid_options *options) {
    judge_set_out_of_memory(end_out_of_memory);
    verdict *v = calloc(1, sizeof *v);
    if (!v) return NULL;
    v->options = *options;
    pthread_mutex_init(&v->lock, NULL);
    v->judges = calloc(threads, sizeof *v->judges);
    if (v->judges && (v->judges[0] = make_judge(options)) != NULL) v->count = 1;
    if (v->count) return v;
    verdict_destroy(v);
    return NULL;
}

void verdict_destroy(verdict *v) {
    if (!v) return;
    while (v->judges && v->count) judge_destroy(v->judges[--v->count]);
    pthread_mutex_destroy(&v->lock);
    free(v->judges);
    free(v);
}

/// A free judge, or a new one; there are no more than threads.
static judge *take(verdict *v) {
    pthread_mutex_lock(&v->lock);
    judge *taken = v->count ? v->judges[--v->count] : NULL;
    pthread_mutex_unlock(&v->lock);
    if (!taken) taken = make_judge(&v->options);
    if (!taken) end_out_of_memory();
    return taken;
}

static void give_back(verdict *v, judge *given) {
    pthread_mutex_lock(&v->lock);
    v->judges[v->count++] = given;
    pthread_mutex_unlock(&v->lock);
}

ovoid_code verdict_verify(verdict *v, const ovoid_pair *pair, const ovoid_answer *answer, const ovoid_cover *cover,
                          int points, ovoid_error *error) {
    judge *mine = take(v);
    ovoid_code code = judge_verify_answer(mine, pair, answer, cover, error);
    if (code == OVOID_OK && points && answer->status != OVOID_UNDECIDED)
        code = judge_verify_points(mine, pair, answer, error);
    give_back(v, mine);
    return code;
}

ovoid_code verdict_verify_compound(verdict *v, const ovoid_body_pair *pair, const ovoid_body_answer *answer,
                                   const ovoid_exclusions *exclusions, const ovoid_pair *points, ovoid_error *error) {
    judge *mine = take(v);
    ovoid_code code = judge_verify_compound(mine, pair, answer, exclusions, error);
    if (code == OVOID_OK && points && answer->status != OVOID_UNDECIDED)
        code = judge_verify_points(mine, points, &answer->deciding, error);
    give_back(v, mine);
    return code;
}

ovoid_code verdict_verify_solid(verdict *v, const ovoid_body_pair *pair, const ovoid_body_answer *answer,
                                const ovoid_exclusions *exclusions, int points, ovoid_error *error) {
    if (pair->a.compound || pair->b.compound)
        return ovoid_body_verify(pair, answer, &(ovoid_body_basis){.options = &v->options, .exclusions = exclusions},
                                 error);
    judge *mine = take(v);
    ovoid_code code = judge_verify_solid(mine, pair, answer, exclusions, points, error);
    give_back(v, mine);
    return code;
}

int verdict_is_exact(void) { return 1; }

#else

/// The library's check needs no working memory.
struct verdict {
    ovoid_options options;
};

verdict *verdict_create(unsigned threads, const ovoid_options *options) {
    static verdict only;
    (void)threads;
    only.options = *options;
    return &only;
}

void verdict_destroy(verdict *v) { (void)v; }

ovoid_code verdict_verify(verdict *v, const ovoid_pair *pair, const ovoid_answer *answer, const ovoid_cover *cover,
                          int points, ovoid_error *error) {
    (void)points;
    return ovoid_answer_verify(pair, answer, &(ovoid_answer_basis){.options = &v->options, .cover = cover}, error);
}

ovoid_code verdict_verify_compound(verdict *v, const ovoid_body_pair *pair, const ovoid_body_answer *answer,
                                   const ovoid_exclusions *exclusions, const ovoid_pair *points, ovoid_error *error) {
    (void)points;
    return ovoid_body_verify(pair, answer, &(ovoid_body_basis){.options = &v->options, .exclusions = exclusions},
                             error);
}

ovoid_code verdict_verify_solid(verdict *v, const ovoid_body_pair *pair, const ovoid_body_answer *answer,
                                const ovoid_exclusions *exclusions, int points, ovoid_error *error) {
    (void)points;
    return ovoid_body_verify(pair, answer, &(ovoid_body_basis){.options = &v->options, .exclusions = exclusions},
                             error);
}

int verdict_is_exact(void) { return 0; }

#endif
