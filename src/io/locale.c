#define _POSIX_C_SOURCE 200809L
#include "io/locale.h"

#include <locale.h>

locale_scope locale_enter(void) {
    locale_t plain = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    // The C locale always exists; where there is no memory for it the caller's stays.
    return (locale_scope){plain ? (void *)uselocale(plain) : 0, (void *)plain};
}

void locale_leave(locale_scope scope) {
    if (!scope.plain) return;
    uselocale((locale_t)scope.callers);
    freelocale((locale_t)scope.plain);
}
