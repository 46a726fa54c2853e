// Writing an error.
#include "base/error.h"

#include <fenv.h>
#include <stdarg.h>
#include <stdio.h>

void error_write(ovoid_error *error, ovoid_code code, int64_t place, const char *format, ...) {
    if (!error) return;
    error->code = code;
    error->place = place;
    // Some C libraries print numbers with long doubles, which raise the x87's own flags.
    fenv_t before;
    (void)fegetenv(&before);
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(error->message, sizeof error->message, format, arguments);
    va_end(arguments);
    (void)fesetenv(&before);
}
