// Numbers in files have a point in any locale: calls of the C library or Assimp that print or read them are enclosed in
// these two. They change the calling thread's locale alone.
#ifndef OVOID_IO_LOCALE_H
#define OVOID_IO_LOCALE_H

/// The caller's locale, to be restored.
typedef struct locale_scope {
    void *callers, *plain;
} locale_scope;

/// Sets the C locale for the calling thread.
locale_scope locale_enter(void);
void locale_leave(locale_scope scope);

#endif
