// Batches: one query of many couples, without the interpreter's lock, on any number of threads.
//
// The couples are taken in chunks, by whichever thread is free; what is written for a couple has the same bits
// whatever is beside it, so the chunks and the threads change nothing. The calling thread works too, and looks between
// its chunks, each of some milliseconds, for signals (Ctrl-C) and calls `progress`.
#include "src/bodies.h"

#include <pthread.h>
#include <signal.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>

// Most couples of a chunk: its copy stays in the nearest cache, and in memory that malloc keeps.
// Of bodies that are no shapes a couple may take milliseconds.
enum { CHUNK_MOST = 2048, CHUNK_DEPTH = 512, CHUNK_LEAST = 64, CHUNK_OTHERS = 4 };

/// The couples as they were given: pairs of integers of 4 or 8 bytes, in a buffer or in memory of our own.
typedef struct couples {
    Py_buffer view;
    void *own;
    const void *items;
    Py_ssize_t count;
    int size; ///< of an integer
} couples;

typedef struct job {
    ovoid_batch batch; ///< all of it, but for the couples
    ovoid_options options;
    query_name name;
    double margin;
    const ovoid_body *others; ///< the bodies where they are no shapes alone, else NULL
    couples couples;
    size_t chunk;
    atomic_size_t next, done;
    atomic_int stop; ///< an exception is on its way, or a chunk was refused
} job;

// ---- the couples

// The integers as unsigned ones: a negative index is above any count.
static uint64_t get_index(const couples *c, Py_ssize_t i) {
    return c->size == 4 ? ((const uint32_t *)c->items)[i] : ((const uint64_t *)c->items)[i];
}

// 1 if an index is body_count or more. Of 31 bits at most the highest bit of a sum tells, without a comparison, so that
// the compiler takes several at once.
static int has_bad_index(const couples *c, Py_ssize_t body_count) {
    uint64_t wrong = 0;
    if (c->size == 4 && body_count <= INT32_MAX) {
        const uint32_t *x = c->items, last = (uint32_t)body_count - 1;
        uint32_t high = 0;
        for (Py_ssize_t i = 0; i < 2 * c->count; i++) high |= x[i] | (last - x[i]);
        return high >> 31 || (!body_count && c->count);
    }
    for (Py_ssize_t i = 0; i < 2 * c->count; i++) wrong |= get_index(c, i) >= (uint64_t)body_count;
    return wrong != 0;
}

static int validate_couples(module_state *state, const couples *c, Py_ssize_t body_count) {
    if (!has_bad_index(c, body_count)) return 0;
    Py_ssize_t i = 0;
    while (i < 2 * c->count - 1 && get_index(c, i) < (uint64_t)body_count) i++;
    long long index = c->size == 4 ? (int32_t)get_index(c, i) : (long long)get_index(c, i);
    raise_code(state, OVOID_ERROR_INDEX, i / 2, "couple %zd names body %lld of %zd", i / 2, index, body_count);
    return -1;
}

static void release_couples(couples *c) {
    if (c->view.obj) PyBuffer_Release(&c->view);
    free(c->own);
}

// A contiguous buffer of (n, 2) integers of 4 or 8 bytes is used where it lies; anything else is copied.
static int read_couples(module_state *state, PyObject *from, couples *c) {
    *c = (couples){.size = 8};
    if (PyObject_CheckBuffer(from)) {
        if (PyObject_GetBuffer(from, &c->view, PyBUF_FULL_RO)) {
            PyErr_Clear();
            c->view.obj = NULL;
        } else {
            const Py_buffer *v = &c->view;
            char kind = buffer_kind(v);
            if ((kind == 'i' || kind == 'u') && (v->itemsize == 4 || v->itemsize == 8) && v->ndim == 2 &&
                v->shape[1] == 2 && PyBuffer_IsContiguous(v, 'C') && (uintptr_t)v->buf % (size_t)v->itemsize == 0) {
                c->items = v->buf;
                c->size = (int)v->itemsize;
                c->count = v->shape[0];
                return 0;
            }
            PyBuffer_Release(&c->view);
            c->view.obj = NULL;
        }
    }
    items given;
    if (items_read(state, from, "couples", 2, (Py_ssize_t[]){-1, 2}, 'q', &given)) return -1;
    c->own = given.data;
    c->items = given.data;
    c->count = given.shape[0];
    return 0;
}

// ---- the work

static ovoid_code query_chunk(const job *j, const ovoid_batch *batch) {
    if (j->others) {
        bodies_query q = {j->name, j->margin, &j->options, j->others, batch->body_count};
        return bodies_ask(&q, batch->couples, batch->couple_count, batch->verdicts, batch->witnesses);
    }
    switch (j->name) {
    case QUERY_COLLIDE: return ovoid_collide_batch(batch, NULL);
    case QUERY_WITHIN: return ovoid_within_batch(batch, j->margin, NULL);
    case QUERY_DISTANCE: return ovoid_distance_batch(batch, NULL);
    default: return ovoid_depth_batch(batch, NULL);
    }
}

// Takes a chunk; 0 where there is none. The couples are copied, so that none changes between its check and its query.
static int work_chunk(job *j, ovoid_couple *copied) {
    size_t first = atomic_load(&j->stop) ? SIZE_MAX : atomic_fetch_add(&j->next, j->chunk);
    if (first >= j->batch.couple_count) return 0;
    size_t count = j->batch.couple_count - first;
    if (count > j->chunk) count = j->chunk;
    if (j->couples.size == 4)
        memcpy(copied, (const ovoid_couple *)j->couples.items + first, count * sizeof *copied);
    else
        for (size_t i = 0; i < 2 * count; i++) {
            uint64_t index = ((const uint64_t *)j->couples.items)[2 * first + i];
            *(i % 2 ? &copied[i / 2].b : &copied[i / 2].a) = index < UINT32_MAX ? (uint32_t)index : UINT32_MAX;
        }
    ovoid_batch part = j->batch;
    part.couples = copied;
    part.couple_count = count;
    part.proofs = part.proofs ? part.proofs + first : NULL;
    part.verdicts += first;
    part.witnesses = part.witnesses ? part.witnesses + first : NULL;
    if (query_chunk(j, &part) != OVOID_OK) atomic_store(&j->stop, 1);
    atomic_fetch_add(&j->done, count);
    return 1;
}

// A thread that finds no memory leaves its share to the others.
static void *work(void *context) {
    job *j = context;
    ovoid_couple *copied = malloc(j->chunk * sizeof *copied);
    while (copied && work_chunk(j, copied)) continue;
    free(copied);
    return NULL;
}

// The calling thread's share, without the lock; -1 where it was interrupted.
static int work_and_look(job *j, PyObject *progress) {
    double looked = seconds_get();
    ovoid_couple *copied = malloc(j->chunk * sizeof *copied);
    int failed = copied ? 0 : -1;
    if (failed) PyErr_NoMemory();
    PyThreadState *saved = PyEval_SaveThread();
    while (!failed && work_chunk(j, copied)) {
        double now = seconds_get();
        if (now - looked < 0.05) continue;
        looked = now;
        PyEval_RestoreThread(saved);
        failed = look_around(progress, atomic_load(&j->done), j->batch.couple_count);
        saved = PyEval_SaveThread();
    }
    if (failed) atomic_store(&j->stop, 1);
    PyEval_RestoreThread(saved);
    free(copied);
    return failed;
}

// Threads without signals, which are for Python's own; fewer where no more can be had.
static int start_threads(job *j, pthread_t *threads, int wanted) {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    int count = 0;
    while (count < wanted && !pthread_create(&threads[count], NULL, work, j)) count++;
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    return count;
}

static int run_job(module_state *state, job *j, int thread_count, PyObject *progress) {
    size_t most = j->others                ? CHUNK_OTHERS
                  : j->name == QUERY_DEPTH ? CHUNK_DEPTH
                                           : CHUNK_MOST,
           total = j->batch.couple_count;
    j->chunk = thread_count > 1 ? (total / (4 * (size_t)thread_count) + 7) / 8 * 8 : most;
    if (j->chunk < CHUNK_LEAST) j->chunk = CHUNK_LEAST;
    if (j->chunk > most) j->chunk = most;
    if (j->chunk > total) j->chunk = total + 1;
    size_t useful = (total + j->chunk - 1) / j->chunk;
    // The library checks each chunk before it writes; several are checked here, so that all or none is written.
    if (useful > 1 && validate_couples(state, &j->couples, (Py_ssize_t)j->batch.body_count)) return -1;
    pthread_t threads[THREADS_MOST];
    int others = useful <= 1 ? 0 : (size_t)thread_count < useful ? thread_count - 1 : (int)useful - 1;
    others = start_threads(j, threads, others);
    int failed = work_and_look(j, progress);
    Py_BEGIN_ALLOW_THREADS;
    for (int i = 0; i < others; i++) pthread_join(threads[i], NULL);
    Py_END_ALLOW_THREADS;
    if (failed) return -1;
    if (!atomic_load(&j->stop)) return progress ? look_around(progress, atomic_load(&j->done), total) : 0;
    if (!validate_couples(state, &j->couples, (Py_ssize_t)j->batch.body_count))
        raise_code(state, OVOID_ERROR_INDEX, -1, "the couples were changed while the batch ran");
    return -1;
}

// ---- the arrays of results

/// An array of results: one that was given, or a new one.
typedef struct result {
    Py_buffer view;
    PyObject *array;
    void *data;
} result;

static int open_result(module_state *state, PyObject *given, const char *what, record_kind kind, Py_ssize_t count,
                       result *r) {
    if (!given || given == Py_None || given == Py_True) {
        r->array = array_make(state, kind, 1, &count, &r->data);
        return r->array ? 0 : -1;
    }
    if (records_view(state, given, what, kind, count, 1, &r->view)) return -1;
    r->array = Py_NewRef(given);
    r->data = r->view.buf;
    return 0;
}

static PyObject *close_result(module_state *state, result *r, int is_good) {
    PyObject *array = r->array;
    if (r->view.obj)
        PyBuffer_Release(&r->view);
    else if (array && is_good)
        return array_wrap(state, array);
    if (is_good) return array;
    Py_XDECREF(array);
    return NULL;
}

typedef struct batch_input {
    PyObject *bodies, *couples, *out, *witnesses, *proofs, *progress;
    int threads;
} batch_input;

static PyObject *run_on(module_state *state, const batch_input *in, job *j) {
    bodies_object *bodies = (bodies_object *)in->bodies;
    result verdicts = {0}, witnesses = {0}, proofs = {0};
    int has_witnesses = in->witnesses && in->witnesses != Py_None && in->witnesses != Py_False;
    int has_proofs = in->proofs && in->proofs != Py_None, is_good = 0;
    Py_ssize_t count = j->couples.count;
    if (!open_result(state, in->out, "out", RECORD_VERDICT, count, &verdicts) &&
        !(has_witnesses && open_result(state, in->witnesses, "witnesses", RECORD_WITNESS, count, &witnesses)) &&
        !(has_proofs && open_result(state, in->proofs, "proofs", RECORD_PROOF, count, &proofs))) {
        j->batch = (ovoid_batch){.bodies = bodies->items,
                                 .body_count = (size_t)bodies->count,
                                 .couple_count = (size_t)count,
                                 .options = &j->options,
                                 .proofs = proofs.data,
                                 .verdicts = verdicts.data,
                                 .witnesses = witnesses.data};
        j->others = bodies->others;
        bodies->users++;
        is_good = !run_job(state, j, in->threads, in->progress == Py_None ? NULL : in->progress);
        bodies->users--;
    }
    PyObject *first = close_result(state, &verdicts, is_good), *second = NULL;
    if (has_witnesses) second = close_result(state, &witnesses, is_good);
    Py_XDECREF(close_result(state, &proofs, is_good));
    if (!has_witnesses || !first || !second) {
        if (has_witnesses) Py_CLEAR(first);
        Py_XDECREF(second);
        return first;
    }
    return Py_BuildValue("NN", first, second);
}

// ---- what is called

static int validate_input(module_state *state, const batch_input *in, const job *j) {
    if (Py_TYPE(in->bodies) != state->bodies) {
        PyErr_Format(PyExc_TypeError, "bodies: Bodies are wanted, as of Bodies(shapes, poses), not %R",
                     (PyObject *)Py_TYPE(in->bodies));
        return -1;
    }
    if (threads_validate(state, in->threads) || progress_validate(in->progress)) return -1;
    const bodies_object *bodies = (const bodies_object *)in->bodies;
    if (bodies->has_solids && j->name == QUERY_DEPTH) {
        PyErr_SetString(PyExc_TypeError, "bodies: depth_batch() takes Shapes and Compounds: distance_batch() of Solids "
                                         "that overlap has a bracket of their depth");
        return -1;
    }
    if (bodies->others && in->proofs && in->proofs != Py_None) {
        PyErr_SetString(PyExc_TypeError, "proofs: of Shapes alone; these bodies have Compounds or Solids");
        return -1;
    }
    const ovoid_options *o = &j->options;
    if (o->absolute_tolerance >= 0 && o->relative_tolerance >= 0 && o->cap >= 0 && j->margin >= 0) return 0;
    return limit_raise(state, OVOID_LIMIT_OPTIONS, QUERY_REFUSED);
}

#define BATCH_NAMES QUERY_NAMES, "threads", "out", "witnesses", "proofs", "progress", NULL
static PyObject *batch(PyObject *module, PyObject *arguments, PyObject *keywords, query_name name) {
    static char *names[] = {"bodies", "couples", BATCH_NAMES},
                *within_names[] = {"bodies", "couples", "margin", BATCH_NAMES};
    module_state *state = state_of_module(module);
    batch_input in = {.threads = 1};
    query_keywords k = {0};
    job j = {.name = name, .margin = 0};
    int is_read =
        name == QUERY_WITHIN
            ? arguments_read(arguments, keywords, "OOd|$" QUERY_FORMAT "iOOOO", within_names, &in.bodies, &in.couples,
                             &j.margin, QUERY_TARGETS(k), &in.threads, &in.out, &in.witnesses, &in.proofs, &in.progress)
            : arguments_read(arguments, keywords, "OO|$" QUERY_FORMAT "iOOOO", names, &in.bodies, &in.couples,
                             QUERY_TARGETS(k), &in.threads, &in.out, &in.witnesses, &in.proofs, &in.progress);
    if (!is_read || query_keywords_validate(state, &k)) return NULL;
    j.options = k.options;
    if (validate_input(state, &in, &j) || read_couples(state, in.couples, &j.couples)) return NULL;
    PyObject *made = run_on(state, &in, &j);
    release_couples(&j.couples);
    return made;
}

static PyObject *collide_batch(PyObject *module, PyObject *arguments, PyObject *keywords) {
    return batch(module, arguments, keywords, QUERY_COLLIDE);
}
static PyObject *within_batch(PyObject *module, PyObject *arguments, PyObject *keywords) {
    return batch(module, arguments, keywords, QUERY_WITHIN);
}
static PyObject *distance_batch(PyObject *module, PyObject *arguments, PyObject *keywords) {
    return batch(module, arguments, keywords, QUERY_DISTANCE);
}
static PyObject *depth_batch(PyObject *module, PyObject *arguments, PyObject *keywords) {
    return batch(module, arguments, keywords, QUERY_DEPTH);
}

#define BATCH_SIGNATURE                                                                                                \
    "*, " QUERY_SIGNATURE ", threads: int = 1, out: Records | None = None, witnesses: bool | Records = False, "        \
    "proofs: Records | None = None, progress: Progress | None = None) -> Any\n--\n\n"
#define BATCH_DOC                                                                                                      \
    " for each couple, with the same status and a true bracket, whatever couples are beside it.\n\nbodies: Bodies. "   \
    "couples: integers (m, 2), which bodies; uint32 and "                                                              \
    "int64 are "                                                                                                       \
    "not copied. Returns an array of m records:\nstatus, stage, limit, iterations, lower, upper (ovoid.Status and "    \
    "the like "                                                                                                        \
    "by number); with witnesses=True also one of\npoint_a, point_b, normal, world frame. out, witnesses: arrays to "   \
    "write "                                                                                                           \
    "into, as of ovoid.zeros. proofs: of Shapes, an array of\nproofs, the earlier ones of these couples, replaced by " \
    "the new. "                                                                                                        \
    "progress(done, total) is called now and then.\nNo other thread may change the arrays meanwhile; Ctrl-C ends it, " \
    "with "                                                                                                            \
    "part of them written."

PyMethodDef batch_methods[] = {
    {"collide_batch", METHOD_KEYWORDS(collide_batch), METH_VARARGS | METH_KEYWORDS,
     "collide_batch(bodies: Bodies, couples: Numbers, " BATCH_SIGNATURE "collide()" BATCH_DOC},
    {"within_batch", METHOD_KEYWORDS(within_batch), METH_VARARGS | METH_KEYWORDS,
     "within_batch(bodies: Bodies, couples: Numbers, margin: float, " BATCH_SIGNATURE "within()" BATCH_DOC},
    {"distance_batch", METHOD_KEYWORDS(distance_batch), METH_VARARGS | METH_KEYWORDS,
     "distance_batch(bodies: Bodies, couples: Numbers, " BATCH_SIGNATURE "distance()" BATCH_DOC},
    {"depth_batch", METHOD_KEYWORDS(depth_batch), METH_VARARGS | METH_KEYWORDS,
     "depth_batch(bodies: Bodies, couples: Numbers, " BATCH_SIGNATURE "depth()" BATCH_DOC},
    {NULL, NULL, 0, NULL}};
