// Members of objects of JSON. What has a table of fields is written by io/fields.h.
#include "base/members.h"

#include "io/fields.h"

void member_write_key(FILE *file, const char *before, const char *key) { fprintf(file, "%s\"%s\":", before, key); }

void member_write_text(FILE *file, const char *before, const char *key, const char *text) {
    member_write_key(file, before, key);
    if (text)
        ovoid_text_write_json(file, text);
    else
        fputs("null", file);
}

void member_write_number(FILE *file, const char *before, const char *key, double number) {
    member_write_key(file, before, key);
    json_write_number(file, number);
}
