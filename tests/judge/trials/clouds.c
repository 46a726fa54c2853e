// Reads the files.
#include "clouds.h"

#include "check.h"

static cloud *add_cloud(clouds *all, uint32_t object) {
    all->items = realloc(all->items, (all->count + 1) * sizeof *all->items);
    if (!all->items) abort();
    all->items[all->count] = (cloud){NULL, 0, object};
    return &all->items[all->count++];
}

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
        if (!raw || fread(raw, 12, n, f) != n) abort();
        cloud *c = add_cloud(&all, 0);
        c->xyz = malloc(n * 3 * sizeof(double));
        if (!c->xyz) abort();
        for (uint32_t i = 0; i < 3 * n; i++) c->xyz[i] = raw[i];
        c->count = n;
        free(raw);
    }
    fclose(f);
    return all;
}

static void add_point(cloud *c, const char *line) {
    // Room grows by doubling: at every power of two.
    if ((c->count & (c->count - 1)) == 0)
        c->xyz = realloc(c->xyz, 3 * sizeof(double) * (c->count ? 2 * (size_t)c->count : 1));
    if (!c->xyz) abort();
    double *v = c->xyz + 3 * (size_t)c->count++;
    if (sscanf(line, "v %lf %lf %lf", &v[0], &v[1], &v[2]) != 3) abort();
}

static void read_parts(clouds *all, FILE *f, uint32_t object) {
    char line[256];
    cloud *part = NULL;
    while (fgets(line, sizeof line, f)) {
        if (strncmp(line, "o ", 2) == 0) part = add_cloud(all, object);
        if (strncmp(line, "v ", 2) == 0 && part) add_point(part, line);
    }
}

clouds clouds_read_compounds(void) {
    clouds all = {NULL, 0};
    const char *data = check_data_folder();
    for (uint32_t object = 0; data && object < 1000; object++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/compounds/%03u.obj", data, object);
        FILE *f = fopen(path, "r");
        if (!f) continue;
        read_parts(&all, f, object);
        fclose(f);
    }
    return all;
}

void clouds_destroy(clouds all) {
    for (size_t i = 0; i < all.count; i++) free(all.items[i].xyz);
    free(all.items);
}
