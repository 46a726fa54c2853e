// replay FOLDER [VARIANTS]: runs a fuzz target over every file of its corpus, and over up to 256 (VARIANTS) truncated
// lengths and as many single changed bytes of each, so that the ordinary tests keep what fuzzing found. Each run counts
// as passed; a target that is not content aborts.
#define _POSIX_C_SOURCE 200809L
#include "fuzz.h"

#include <dirent.h>

static long passed;
static size_t variants = 256;

static void run(const uint8_t *data, size_t size) {
    // A copy of just that size, so that a sanitizer sees the first byte read past the end.
    uint8_t *copy = malloc(size ? size : 1);
    fuzz_require(copy != NULL);
    if (size) memcpy(copy, data, size);
    (void)LLVMFuzzerTestOneInput(copy, size);
    free(copy);
    passed++;
}

static void run_variants(uint8_t *data, size_t size) {
    run(data, size);
    size_t step = size / variants + 1;
    for (size_t length = 0; length < size; length += step) run(data, length);
    for (size_t place = 0; place < size; place += step) {
        uint8_t kept = data[place];
        data[place] = (uint8_t)(kept ^ (1u << (place % 8)));
        run(data, size);
        data[place] = kept;
    }
}

static void run_file(const char *path) {
    static uint8_t data[1 << 20]; // seeds are small
    FILE *file = fopen(path, "rb");
    fuzz_require(file != NULL);
    size_t size = fread(data, 1, sizeof data, file);
    (void)fclose(file);
    run_variants(data, size);
}

int main(int argc, char **argv) {
    DIR *folder = argc >= 2 ? opendir(argv[1]) : NULL;
    if (argc == 3) variants = strtoul(argv[2], NULL, 10);
    if (!folder || !variants) {
        printf("0 passed, 1 failed: no folder\n");
        return 1;
    }
    for (struct dirent *entry; (entry = readdir(folder)) != NULL;) {
        char path[4096];
        if (entry->d_name[0] == '.') continue;
        (void)snprintf(path, sizeof path, "%s/%s", argv[1], entry->d_name);
        run_file(path);
    }
    (void)closedir(folder);
    printf("%ld passed, %d failed, 0 skipped\n", passed, passed == 0);
    return passed == 0;
}
