// Ctrl-C while the library works: by a watch that looks for signals twenty times a second, or between pieces of work.
#include "src/module.h"

#include <time.h>

double seconds_get(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int threads_validate(module_state *state, int threads) {
    if (threads >= 1 && threads <= THREADS_MOST) return 0;
    raise_code(state, OVOID_ERROR_ARGUMENT, -1, "threads: 1 to %d are wanted, not %d", THREADS_MOST, threads);
    return -1;
}

int look_around(PyObject *progress, size_t done, size_t total) {
    if (PyErr_CheckSignals()) return -1;
    if (!progress || progress == Py_None) return 0;
    PyObject *said = PyObject_CallFunction(progress, "nn", (Py_ssize_t)done, (Py_ssize_t)total);
    Py_XDECREF(said);
    return said ? 0 : -1;
}

static int is_stopped(void *context) {
    interrupt *i = context;
    if (i->is_raised) return 1;
    if (++i->calls % i->every) return 0;
    double now = seconds_get();
    if (now - i->looked < 0.05) return 0;
    i->looked = now;
    PyEval_RestoreThread(i->thread);
    // Before the library has said a total, there is nothing to tell.
    i->is_raised = look_around(i->total ? i->progress : NULL, i->done, i->total) != 0;
    i->thread = PyEval_SaveThread();
    return i->is_raised;
}

ovoid_watch interrupt_begin(interrupt *i) {
    // The clock costs a tenth of what a state of a robot does.
    *i = (interrupt){.looked = seconds_get(), .every = 8};
    i->thread = PyEval_SaveThread();
    return (ovoid_watch){is_stopped, i};
}

int interrupt_end(interrupt *i) {
    PyEval_RestoreThread(i->thread);
    return i->is_raised ? -1 : 0;
}

// ---- pieces

int progress_validate(PyObject *progress) {
    if (!progress || progress == Py_None || PyCallable_Check(progress)) return 0;
    PyErr_SetString(PyExc_TypeError, "progress: a function of (done, total) is wanted");
    return -1;
}

int pieces_run(module_state *state, const pieces *p) {
    ovoid_error error;
    for (size_t done = 0, size = p->least; done < p->total;) {
        size_t count = p->total - done < size ? p->total - done : size;
        double begun = seconds_get();
        ovoid_code code;
        Py_BEGIN_ALLOW_THREADS;
        code = p->run(p->context, done, count, &error);
        Py_END_ALLOW_THREADS;
        if (code != OVOID_OK) {
            raise_error(state, &error);
            return -1;
        }
        done += count;
        if (look_around(p->progress, done, p->total)) return -1;
        if (seconds_get() - begun < 0.02 && size < ((size_t)1 << 24)) size *= 2;
    }
    return 0;
}
