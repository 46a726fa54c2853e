// Threads, locks and conditions of the system: all that the core needs of it beside memory. POSIX, or Windows from
// Vista on; WebAssembly has no threads, so a pool there is the caller's thread alone.
#ifndef OVOID_WORLD_THREAD_H
#define OVOID_WORLD_THREAD_H

#include <stddef.h>

/// Bytes of a thread's stack: a query takes a tenth of it, and the host's filter and allocator are called on it. Set
/// explicitly, as the system's default may be as little as 128 KB.
enum { THREAD_STACK = 1 << 20 };

#if defined(_WIN32)

#include <process.h>
#include <windows.h>

typedef HANDLE thread;
typedef SRWLOCK thread_lock;
typedef CONDITION_VARIABLE thread_condition;

/// The function of a thread: THREAD_MAIN(name, context) { ...; return THREAD_END; }
#define THREAD_MAIN(name, context) static unsigned __stdcall name(void *context)
#define THREAD_END 0u
typedef unsigned(__stdcall *thread_main)(void *context);

static inline int thread_start(thread *t, thread_main run, void *context) {
    *t = (HANDLE)_beginthreadex(NULL, THREAD_STACK, run, context, STACK_SIZE_PARAM_IS_A_RESERVATION, NULL);
    return *t != NULL;
}
static inline void thread_join(thread t) {
    (void)WaitForSingleObject(t, INFINITE);
    (void)CloseHandle(t);
}

/// The number of this process. It differs in a child made by fork, where only the caller's thread exists.
static inline long process_get_number(void) { return 0; } // there is no fork

static inline void lock_make(thread_lock *l) { InitializeSRWLock(l); }
static inline void lock_clear(thread_lock *l) { (void)l; }
static inline void lock_take(thread_lock *l) { AcquireSRWLockExclusive(l); }
static inline void lock_give(thread_lock *l) { ReleaseSRWLockExclusive(l); }

static inline void condition_make(thread_condition *c) { InitializeConditionVariable(c); }
static inline void condition_clear(thread_condition *c) { (void)c; }
static inline void condition_wait(thread_condition *c, thread_lock *l) {
    (void)SleepConditionVariableSRW(c, l, INFINITE, 0);
}
static inline void condition_wake_all(thread_condition *c) { WakeAllConditionVariable(c); }

#elif defined(__wasm__)

typedef int thread;
typedef int thread_lock;
typedef int thread_condition;

/// The function of a thread: THREAD_MAIN(name, context) { ...; return THREAD_END; }
#define THREAD_MAIN(name, context) static int name(void *context)
#define THREAD_END 0
typedef int (*thread_main)(void *context);

static inline int thread_start(thread *t, thread_main run, void *context) {
    (void)run, (void)context;
    *t = 0;
    return 0;
}
static inline void thread_join(thread t) { (void)t; }

/// The number of this process. It differs in a child made by fork, where only the caller's thread exists.
static inline long process_get_number(void) { return 0; } // there is no fork

static inline void lock_make(thread_lock *l) { *l = 0; }
static inline void lock_clear(thread_lock *l) { (void)l; }
static inline void lock_take(thread_lock *l) { (void)l; }
static inline void lock_give(thread_lock *l) { (void)l; }

static inline void condition_make(thread_condition *c) { *c = 0; }
static inline void condition_clear(thread_condition *c) { (void)c; }
static inline void condition_wait(thread_condition *c, thread_lock *l) { (void)c, (void)l; }
static inline void condition_wake_all(thread_condition *c) { (void)c; }

#else

#include <pthread.h>
#include <signal.h>
#include <unistd.h>

typedef pthread_t thread;
typedef pthread_mutex_t thread_lock;
typedef pthread_cond_t thread_condition;

/// The function of a thread: THREAD_MAIN(name, context) { ...; return THREAD_END; }
#define THREAD_MAIN(name, context) static void *name(void *context) // NOLINT(bugprone-macro-parentheses)
#define THREAD_END NULL
typedef void *(*thread_main)(void *context);

/// All signals except those of a thread's own faults, whose handlers run in that thread.
static inline sigset_t thread_find_signals(void) {
    sigset_t all;
    (void)sigfillset(&all);
    static const int faults[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
    for (size_t i = 0; i < sizeof faults / sizeof *faults; i++) (void)sigdelset(&all, faults[i]);
    return all;
}

/// 1, or 0 if the system cannot start another thread. Signals go to the host's own threads: a signal that the host
/// blocks must not be delivered to this thread.
static inline int thread_start(thread *t, thread_main run, void *context) {
    pthread_attr_t attributes;
    sigset_t held = thread_find_signals(), before;
    if (pthread_attr_init(&attributes) != 0) return 0;
    (void)pthread_sigmask(SIG_BLOCK, &held, &before);
    int ok =
        pthread_attr_setstacksize(&attributes, THREAD_STACK) == 0 && pthread_create(t, &attributes, run, context) == 0;
    (void)pthread_sigmask(SIG_SETMASK, &before, NULL);
    (void)pthread_attr_destroy(&attributes);
    return ok;
}
static inline void thread_join(thread t) { (void)pthread_join(t, NULL); }

/// The number of this process. It differs in a child made by fork, where only the caller's thread exists.
static inline long process_get_number(void) { return (long)getpid(); }

static inline void lock_make(thread_lock *l) { (void)pthread_mutex_init(l, NULL); }
static inline void lock_clear(thread_lock *l) { (void)pthread_mutex_destroy(l); }
static inline void lock_take(thread_lock *l) { (void)pthread_mutex_lock(l); }
static inline void lock_give(thread_lock *l) { (void)pthread_mutex_unlock(l); }

static inline void condition_make(thread_condition *c) { (void)pthread_cond_init(c, NULL); }
static inline void condition_clear(thread_condition *c) { (void)pthread_cond_destroy(c); }
static inline void condition_wait(thread_condition *c, thread_lock *l) { (void)pthread_cond_wait(c, l); }
static inline void condition_wake_all(thread_condition *c) { (void)pthread_cond_broadcast(c); }

#endif

#endif
