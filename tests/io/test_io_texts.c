// Texts of files as they are written for other programs. Truth: what spreadsheets take for a formula and what Unicode
// calls a control are listed here; whatever bytes a name has, it is read back as it was.
#include "check.h"
#include "files.h"

#include <stdlib.h>

/// What a writer writes of a text; valid until the next call.
static const char *get_written(void (*write)(FILE *, const char *), const char *text) {
    static char written[4096];
    FILE *file = tmpfile();
    if (!CHECK(file)) exit(1);
    write(file, text);
    rewind(file);
    size_t size = fread(written, 1, sizeof written - 1, file);
    written[size] = 0;
    fclose(file);
    return written;
}

static void expect_text(const char *wanted, const char *found) {
    if (!CHECK(strcmp(wanted, found) == 0)) printf("  wanted %s, found %s\n", wanted, found);
}

static const struct {
    const char *text, *csv, *json;
} cases[] = {
    {"plain name", "plain name", "\"plain name\""},
    {"a,b", "\"a,b\"", "\"a,b\""},
    {"a;b", "\"a;b\"", "\"a;b\""},
    {"say \"a\"", "\"say \"\"a\"\"\"", "\"say \\\"a\\\"\""},
    {" blank", "\" blank\"", "\" blank\""},
    {"blank ", "\"blank \"", "\"blank \""},
    {"=1+1", "'=1+1", "\"=1+1\""},
    {"+1", "'+1", "\"+1\""},
    {"-1", "'-1", "\"-1\""},
    {"@SUM(A1)", "'@SUM(A1)", "\"@SUM(A1)\""},
    {"=HYPERLINK(\"http://x\",\"y\")", "\"'=HYPERLINK(\"\"http://x\"\",\"\"y\"\")\"",
     "\"=HYPERLINK(\\\"http://x\\\",\\\"y\\\")\""},
    {" =1", "\"' =1\"", "\" =1\""},
    {"\xef\xbc\x9d"
     "1",
     "'\xef\xbc\x9d"
     "1",
     "\"\xef\xbc\x9d"
     "1\""},
    {"'quoted'", "''quoted'", "\"'quoted'\""},
    {"it's", "it's", "\"it's\""},
    {"\t=1", "\\x09=1", "\"\\u0009=1\""},
    {"\r=1", "\\x0d=1", "\"\\u000d=1\""},
    {"two\nlines", "two\\x0alines", "\"two\\u000alines\""},
    {"\033[31mred", "\\x1b[31mred", "\"\\u001b[31mred\""},
    {"\x7f\xc2\x9b", "\\x7f\\xc2\\x9b", "\"\\u007f\\u009b\""},
    {"gro\xc3\x9f", "gro\xc3\x9f", "\"gro\xc3\x9f\""},
    {"a\xe2\x80\xae"
     "b",
     "a\\xe2\\x80\\xaeb", "\"a\\u202eb\""},
    {"a\xe2\x81\xa6\xe2\x80\x8b\xef\xbb\xbf", "a\\xe2\\x81\\xa6\\xe2\\x80\\x8b\\xef\\xbb\\xbf",
     "\"a\\u2066\\u200b\\ufeff\""},
    {"\xf3\xa0\x81\x81", "\\xf3\\xa0\\x81\\x81", "\"\\udb40\\udc41\""},
    {"bad \xff\xc3", "bad \\xff\\xc3", "\"bad \\ufffd\\ufffd\""},
    {"C:\\mesh\\x.stl", "C:\\mesh\\x.stl", "\"C:\\\\mesh\\\\x.stl\""},
    {"C:\\x41", "C:\\x5cx41", "\"C:\\\\x41\""},
    {"\\x\001", "\\x\\x01", "\"\\\\x\\u0001\""},
};

// The text is read back from what is written, with another field behind it and without.
static void check_read_back(const char *text) {
    static const char *const behind[] = {"", ",rest", "\n", "\r\n"};
    char line[4200], back[4096];
    for (size_t i = 0; i < sizeof behind / sizeof *behind; i++) {
        snprintf(line, sizeof line, "%s%s", get_written(ovoid_text_write_csv, text), behind[i]);
        const char *end = ovoid_text_read_csv(line, back, strlen(text) + 1, NULL);
        if (!CHECK(end && strcmp(end, behind[i]) == 0) || !CHECK(strcmp(back, text) == 0))
            printf("  written %s, read %s\n", line, end ? back : "nothing");
    }
    if (text[0]) CHECK(!ovoid_text_read_csv(get_written(ovoid_text_write_csv, text), back, strlen(text), NULL));
}

// What is written has no byte that should not be shown, and begins no formula, quotes apart.
static void check_harmless(const char *text) {
    const char *written = get_written(ovoid_text_write_csv, text);
    const char *first = written + (written[0] == '"');
    CHECK(!strchr("=+-@", *first) || !*first);
    while (*written) {
        size_t length = ovoid_text_get_visible_length(written);
        if (!CHECK(length > 0)) break;
        written += length;
    }
}

static void check_random(int rounds) {
    static const char *const pieces[] = {"=",
                                         "+",
                                         "-",
                                         "@",
                                         "'",
                                         "\"",
                                         ",",
                                         ";",
                                         " ",
                                         "\t",
                                         "\n",
                                         "\r",
                                         "\\",
                                         "x",
                                         "4",
                                         "a",
                                         "\\x41",
                                         "\\x",
                                         "\xe2\x80\xae",
                                         "\xff",
                                         "\xc3",
                                         "\xc3\x9f",
                                         "\033",
                                         "\xef\xbc\x8b",
                                         "\"\"",
                                         "\xf0\x9f\x99\x82"};
    uint64_t s = 11;
    for (int i = 0; i < rounds; i++) {
        check_seed = s;
        char text[64] = "";
        for (uint64_t k = random_next(&s) % 8; k-- > 0;)
            strcat(text, pieces[random_next(&s) % (sizeof pieces / sizeof *pieces)]);
        check_read_back(text);
        check_harmless(text);
    }
    check_seed = 0;
}

static void check_refused(const char *line, const char *phrase) {
    char text[64];
    ovoid_error error = {OVOID_OK, -1, ""};
    CHECK(!ovoid_text_read_csv(line, text, sizeof text, &error));
    if (!CHECK(error.code == OVOID_ERROR_FORMAT && strstr(error.message, phrase)))
        printf("  %s: %s\n", line, error.message);
}

// A table shows what is masked as a question mark each, and cuts no character.
static void check_table(void) {
    char name[200] = "a\xe2\x80\xae\033z";
    ovoid_record record = {.a = name, .b = "b", .fields = 0};
    char text[2000];
    for (int i = 0; i < 2; i++) {
        FILE *file = tmpfile();
        if (!CHECK(file)) return;
        CHECK(ovoid_records_write_table(file, &record, 1, NULL) == OVOID_OK);
        rewind(file);
        text[fread(text, 1, sizeof text - 1, file)] = 0;
        fclose(file);
        CHECK(strstr(text, i ? "aa\xc3\x9f\xc3\x9f" : "a??z "));
        for (const char *c = text; *c; c += ovoid_text_get_visible_length(c) ? ovoid_text_get_visible_length(c) : 1)
            CHECK(*c == '\n' || ovoid_text_get_visible_length(c) > 0);
        strcpy(name, "aa");
        for (int k = 0; k < 90; k++) strcat(name, "\xc3\x9f");
    }
}

int main(void) {
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        expect_text(cases[i].csv, get_written(ovoid_text_write_csv, cases[i].text));
        expect_text(cases[i].json, get_written(ovoid_text_write_json, cases[i].text));
        check_read_back(cases[i].text);
    }
    // Written by others: only what cannot be read otherwise is an escape.
    char text[64];
    CHECK(ovoid_text_read_csv("  'abc' ,d", text, sizeof text, NULL) && strcmp(text, "'abc'") == 0);
    CHECK(ovoid_text_read_csv("\\x4G\\xC3\\x9f", text, sizeof text, NULL) && strcmp(text, "\\x4G\xc3\x9f") == 0);
    check_random(20000);
    check_refused("\"open", "closing quote");
    check_refused("\"a\" b", "follows the closing quote");
    check_refused("a\"b", "quote within");
    check_refused("a\\x00b", "zero byte");
    check_table();
    return check_end();
}
