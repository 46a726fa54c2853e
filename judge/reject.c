// Writing a refusal: the judge's sentence about a claim that does not hold.
#include "parts.h"

#include <stdarg.h>
#include <stdio.h>

ovoid_code judge_reject(ovoid_error *error, ovoid_code code, const char *format, ...) {
    if (error) {
        va_list arguments;
        error->code = code;
        error->place = -1;
        va_start(arguments, format);
        vsnprintf(error->message, sizeof error->message, format, arguments);
        va_end(arguments);
    }
    return code;
}
