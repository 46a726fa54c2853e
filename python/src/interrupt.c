// Ctrl-C while the library works: by a watch that looks for signals twenty times a second, or between pieces of work.
#include "src/module.h"

#include <time.h>

static double get_seconds(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int is_stopped(void *context) {
    interrupt *i = context;
    if (i->is_raised) return 1;
    // The clock costs a tenth of what a state of a robot does.
    if (++i->calls % 8) return 0;
    double now = get_seconds();
    if (now - i->looked < 0.05) return 0;
    i->looked = now;
    PyEval_RestoreThread(i->thread);
    i->is_raised = PyErr_CheckSignals() != 0;
    i->thread = PyEval_SaveThread();
    return i->is_raised;
}

ovoid_watch interrupt_begin(interrupt *i) {
    *i = (interrupt){.looked = get_seconds()};
    i->thread = PyEval_SaveThread();
    return (ovoid_watch){is_stopped, i};
}

int interrupt_end(interrupt *i) {
    PyEval_RestoreThread(i->thread);
    return i->is_raised ? -1 : 0;
}

// ---- pieces

int progress_check(PyObject *progress) {
    if (!progress || progress == Py_None || PyCallable_Check(progress)) return 0;
    PyErr_SetString(PyExc_TypeError, "progress: a function of (done, total) is wanted");
    return -1;
}

// Under the interpreter's lock: -1 where a signal's handler or the callback raised.
static int look_around(const pieces *p, size_t done) {
    if (PyErr_CheckSignals()) return -1;
    if (!p->progress || p->progress == Py_None) return 0;
    PyObject *said = PyObject_CallFunction(p->progress, "nn", (Py_ssize_t)done, (Py_ssize_t)p->total);
    Py_XDECREF(said);
    return said ? 0 : -1;
}

int pieces_run(module_state *state, const pieces *p) {
    ovoid_error error;
    for (size_t done = 0, size = p->least; done < p->total;) {
        size_t count = p->total - done < size ? p->total - done : size;
        double begun = get_seconds();
        ovoid_code code;
        Py_BEGIN_ALLOW_THREADS;
        code = p->run(p->context, done, count, &error);
        Py_END_ALLOW_THREADS;
        if (code != OVOID_OK) {
            raise_error(state, &error);
            return -1;
        }
        done += count;
        if (look_around(p, done)) return -1;
        if (get_seconds() - begun < 0.02 && size < ((size_t)1 << 24)) size *= 2;
    }
    return 0;
}
