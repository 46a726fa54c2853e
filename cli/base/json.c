#include "base/json.h"

#include <ovoid/io.h>

#include <math.h>

void json_write_text(FILE *file, const char *text) { ovoid_text_write_json(file, text); }

void json_write_number(FILE *file, double number) {
    if (isfinite(number))
        fprintf(file, "%.17g", number);
    else
        fputs("null", file);
}

void json_write_numbers(FILE *file, const double *numbers, size_t count) {
    fputc('[', file);
    for (size_t i = 0; i < count; i++) {
        if (i) fputc(',', file);
        json_write_number(file, numbers[i]);
    }
    fputc(']', file);
}
