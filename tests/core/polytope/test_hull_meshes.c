// Hulls of real points: clouds of game hulls (some degenerate), scans and convex decompositions, CGAL's demo meshes.
// Every one must have a hull that holds what hulls.h asks for.
#define _POSIX_C_SOURCE 200809L // popen
#include "hulls.h"

#define MOST 1000000

static double *cloud;

static void release(hull *h) {
    ovoid_allocator memory = allocator_make(NULL);
    hull_destroy(h, &memory);
}

static void check_game_hulls(const char *folder) {
    char path[1024];
    snprintf(path, sizeof path, "%s/pieces/game_hulls.bin", folder ? folder : "");
    FILE *file = folder ? fopen(path, "rb") : NULL;
    if (!file) {
        check_skip("pieces/game_hulls.bin is absent");
        return;
    }
    uint32_t n, hulls = 0;
    while (fread(&n, sizeof n, 1, file) == 1 && CHECK_LE(n, MOST)) {
        for (uint32_t i = 0; i < 3 * n; i++) {
            float v = 0;
            size_t got = fread(&v, sizeof v, 1, file);
            CHECK_EQ(got, 1);
            cloud[i] = v;
        }
        check_seed = hulls++;
        hull h = check_hull(cloud, n);
        release(&h);
    }
    check_seed = 0;
    CHECK_EQ(hulls, 3378);
    fclose(file);
}

// The points so far, unless there are none.
static size_t finish(size_t count) {
    if (count) {
        hull h = check_hull(cloud, count);
        release(&h);
        check_seed++;
    }
    return 0;
}

// An OBJ file: as a whole, and each object.
static void check_obj(const char *folder, const char *name, int objects) {
    char path[1024], line[512];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "r");
    if (!file) {
        check_skip(path);
        return;
    }
    size_t count = 0;
    while (fgets(line, sizeof line, file)) {
        if (objects && line[0] == 'o' && line[1] == ' ') count = finish(count);
        double *v = cloud + 3 * count;
        if (line[0] == 'v' && line[1] == ' ' && count < MOST && sscanf(line + 2, "%lf %lf %lf", v, v + 1, v + 2) == 3)
            count++;
    }
    finish(count);
    fclose(file);
}

// CGAL's meshes: OFF files one after another as tar unpacks them.
static void check_cgal(void) {
    static const char tarball[] = "/usr/share/doc/libcgal-demo/data.tar.gz";
    FILE *there = fopen(tarball, "r"), *stream = NULL;
    if (there) {
        fclose(there);
        stream = popen("tar -xzOf /usr/share/doc/libcgal-demo/data.tar.gz --wildcards '*.off'", "r");
    }
    if (!stream) {
        check_skip("the meshes of libcgal-demo are absent");
        return;
    }
    check_seed = 0;
    char line[4096];
    size_t count = 0, wanted = 0;
    int in_counts = 0;
    while (fgets(line, sizeof line, stream)) {
        double *v = cloud + 3 * count;
        if (line[0] == 'O' || line[0] == 'C') {
            in_counts = 1;
            wanted = count = 0;
        } else if (in_counts) {
            in_counts = sscanf(line, "%zu", &wanted) != 1;
        } else if (count < wanted && count < MOST && sscanf(line, "%lf %lf %lf", v, v + 1, v + 2) == 3) {
            if (++count == wanted) count = finish(count), wanted = 0;
        }
    }
    CHECK_EQ(check_seed, 139);
    check_seed = 0;
    pclose(stream);
}

int main(void) {
    cloud = malloc(3 * MOST * sizeof *cloud);
    const char *folder = check_data_folder();
    if (folder) {
        static const char *scans[] = {"scans/bunny.obj", "scans/duck.obj", "scans/teddy.obj", "scenes/env.obj",
                                      "scenes/rob.obj"};
        static const char *parts[] = {"scans/duck_vhacd.obj", "scans/teddy2_VHACD_CHs.obj", "compounds/086.obj",
                                      "compounds/360.obj", "compounds/009.obj"};
        check_game_hulls(folder);
        for (size_t i = 0; i < sizeof scans / sizeof *scans; i++) check_obj(folder, scans[i], 0);
        for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) check_obj(folder, parts[i], 1);
    } else
        check_skip("the folder of real data is absent");
    check_cgal();
    free(cloud);
    return check_end();
}
