// Pieces of JSON.
#ifndef OVOID_CLI_BASE_JSON_H
#define OVOID_CLI_BASE_JSON_H

#include <stdio.h>

/// Writes a text as a JSON string. Bytes above 127 pass unchanged: names are UTF-8.
void json_write_text(FILE *file, const char *text);

/// Writes a number with 17 digits; "null" where it is not finite.
void json_write_number(FILE *file, double number);
/// Writes numbers as an array.
void json_write_numbers(FILE *file, const double *numbers, size_t count);

#endif
