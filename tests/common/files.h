// Small files for the tests of readers and writers, in a folder of the build.
#ifndef OVOID_TESTS_FILES_H
#define OVOID_TESTS_FILES_H

#include "check.h"

#include "ovoid/io.h"

#include <sys/stat.h>

/// The folder of the build; a test whose file names occur in other tests has a folder of its own.
#ifndef FILES_FOLDER
#define FILES_FOLDER "test_files"
#endif

/// The path of a file in the tests' folder; valid until the eighth next call.
static inline const char *file_path(const char *name) {
    static char paths[8][512];
    static int turn;
    char *path = paths[turn++ % 8];
    mkdir(OVOID_BUILD_DIR "/" FILES_FOLDER, 0777);
    snprintf(path, 512, "%s/%s", OVOID_BUILD_DIR "/" FILES_FOLDER, name);
    return path;
}

/// Writes a file and returns its path.
static inline const char *file_write(const char *name, const void *data, size_t size) {
    const char *path = file_path(name);
    FILE *file = fopen(path, "wb");
    if (!file || fwrite(data, 1, size, file) != size || fclose(file)) {
        printf("%s cannot be written\n", path);
        exit(2);
    }
    return path;
}

static inline const char *file_write_text(const char *name, const char *text) {
    return file_write(name, text, strlen(text));
}

/// The whole file, terminated; the caller frees it. NULL if there is none.
static inline char *file_read(const char *path, size_t *size) {
    FILE *file = fopen(path, "rb");
    if (!file) return NULL;
    char *data = malloc(1 << 24);
    *size = fread(data, 1, (1 << 24) - 1, file);
    data[*size] = 0;
    fclose(file);
    return data;
}

/// One line of a table of bad inputs, with the expected error. Most lines leave the code out.
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
typedef struct bad_input {
    const char *name; ///< of the case and, with its extension, of the file
    const char *text;
    int64_t place;
    const char *phrase; ///< part of the message
    ovoid_code code;    ///< OVOID_OK stands for the most frequent one, OVOID_ERROR_FORMAT
} bad_input;

/// Checks the error of a case; prints the actual error if it is different.
static inline void check_error(const bad_input *input, const ovoid_error *error) {
    ovoid_code code = input->code == OVOID_OK ? OVOID_ERROR_FORMAT : input->code;
    int good = error->code == code && error->place == input->place && strstr(error->message, input->phrase) &&
               strstr(error->message, input->name);
    if (!CHECK(good))
        printf("  %s: code %d, place %lld, \"%s\"\n", input->name, (int)error->code, (long long)error->place,
               error->message);
}

/// Writes each file of a table and reads it by `accepts`, which returns 1 if a file was read without an error.
static inline void check_bad_inputs(const bad_input *inputs, size_t count,
                                    int (*accepts)(const char *path, ovoid_error *error)) {
    for (size_t i = 0; i < count; i++) {
        ovoid_error error = {OVOID_OK, -2, ""};
        if (!CHECK(!accepts(file_write_text(inputs[i].name, inputs[i].text), &error)))
            printf("  %s was read\n", inputs[i].name);
        check_error(&inputs[i], &error);
    }
}

/// Damaged bytes, and lines that are cut: an end or an error with a sentence and a line, never a crash. read: 0 at the
/// end, -1 after an error.
static inline void check_damaged_lines(const char *header, const char *lines,
                                       int (*read)(const char *path, ovoid_error *error)) {
    const size_t before = strlen(header), size = strlen(lines);
    uint64_t state = 29;
    for (int i = 0; i < 2000; i++) {
        check_seed = state;
        char text[400];
        ovoid_error error = {OVOID_OK, -1, ""};
        snprintf(text, sizeof text, "%s%s", header, lines);
        text[before + random_next(&state) % size] = (char)random_next(&state);
        const size_t cut = random_next(&state) % 2 ? random_next(&state) % 40 : 0;
        int got = read(file_write("damaged.csv", text, before + size - cut), &error);
        CHECK(got == 0 || (got == -1 && error.code && error.place > 1 && error.message[0]));
    }
    check_seed = 0;
}

#endif
