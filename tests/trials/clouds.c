// Reads the file of clouds.
#include "clouds.h"

#include "check.h"

clouds clouds_read(void) {
    clouds all = {NULL, 0};
    const char *data = check_data_folder();
    char path[1024];
    snprintf(path, sizeof path, "%s/pieces/game_hulls.bin", data ? data : "");
    FILE *f = data ? fopen(path, "rb") : NULL;
    if (!f) return all;
    uint32_t n;
    while (fread(&n, sizeof n, 1, f) == 1 && n > 0 && n < 100000) {
        float *raw = malloc(n * 3 * sizeof *raw);
        cloud c = {malloc(n * 3 * sizeof(double)), n};
        all.items = realloc(all.items, (all.count + 1) * sizeof *all.items);
        if (!raw || !c.xyz || !all.items || fread(raw, 12, n, f) != n) abort();
        for (uint32_t i = 0; i < 3 * n; i++) c.xyz[i] = raw[i];
        all.items[all.count++] = c;
        free(raw);
    }
    fclose(f);
    return all;
}

void clouds_destroy(clouds all) {
    for (size_t i = 0; i < all.count; i++) free(all.items[i].xyz);
    free(all.items);
}
