// Members of objects of JSON that are written one by one.
#ifndef OVOID_CLI_BASE_MEMBERS_H
#define OVOID_CLI_BASE_MEMBERS_H

#include <stdio.h>

/// Writes "KEY": after `before`, which is a comma, a brace or both.
void member_write_key(FILE *file, const char *before, const char *key);

/// The same with a text behind it; NULL is null.
void member_write_text(FILE *file, const char *before, const char *key, const char *text);

/// The same with a number, which is null where it is not finite.
void member_write_number(FILE *file, const char *before, const char *key, double number);

#endif
