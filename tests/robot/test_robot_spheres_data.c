// The spheres that public robots come with, beside as many found here: what theirs leave uncovered, and what both have
// outside. Links are the convex hulls of the collision meshes of the URDF beside. Truth: the audit; what is found here
// is covered, and has less volume outside than theirs have once their radii are grown until they cover. The readers
// below read these files and no others. With the argument --full: both robots, and a longer search; these are the
// numbers of docs/robot-spheres.md.
#include "check.h"
#include "options.h"
#include "ovoid/robot_spheres.h"

enum { MOST_SPHERES = 64, MOST_PARTS = 16 };

static char *read_all(const char *path, size_t *size) {
    FILE *f = fopen(path, "rb");
    if (!f) return NULL;
    (void)fseek(f, 0, SEEK_END);
    *size = (size_t)ftell(f);
    rewind(f);
    char *text = calloc(1, *size + 1);
    if (text) *size = fread(text, 1, *size, f);
    (void)fclose(f);
    return text;
}

// The vertices of an OBJ or a binary STL file; their number.
static size_t read_points(const char *path, double **xyz) {
    size_t size, count = 0;
    char *text = read_all(path, &size);
    if (!text) return 0;
    *xyz = malloc((size / 5 + 9) * sizeof **xyz);
    if (strstr(path, ".obj")) {
        for (char *at = text; at && *at; at = strchr(at, '\n') ? strchr(at, '\n') + 1 : NULL)
            if (sscanf(at, "v %lf %lf %lf", *xyz + 3 * count, *xyz + 3 * count + 1, *xyz + 3 * count + 2) == 3) count++;
    } else {
        uint32_t triangles;
        memcpy(&triangles, text + 80, 4);
        for (uint32_t t = 0; t < triangles; t++)
            for (int k = 0; k < 9; k++) {
                float x;
                memcpy(&x, text + 84 + 50 * (size_t)t + 12 + 4 * (size_t)k, 4);
                (*xyz)[3 * count + (size_t)k] = (double)x;
                if (k == 8) count += 3;
            }
    }
    free(text);
    return count;
}

// The text of the element that begins at `at`, as a copy.
static char *copy_element(const char *at, const char *end) {
    const char *stop = strstr(at, end);
    size_t size = stop ? (size_t)(stop - at) : strlen(at);
    char *copy = calloc(1, size + 1);
    if (copy) memcpy(copy, at, size);
    return copy;
}

static ovoid_pose read_origin(const char *collision) {
    ovoid_vec3 xyz = {0, 0, 0}, rpy = {0, 0, 0};
    const char *origin = strstr(collision, "<origin");
    const char *a = origin ? strstr(origin, "xyz=\"") : NULL, *b = origin ? strstr(origin, "rpy=\"") : NULL;
    if (a) (void)sscanf(a, "xyz=\"%lf %lf %lf", &xyz.x, &xyz.y, &xyz.z);
    if (b) (void)sscanf(b, "rpy=\"%lf %lf %lf", &rpy.x, &rpy.y, &rpy.z);
    return ovoid_pose_make_rpy(xyz, rpy);
}

/// A link: its parts and its spheres.
typedef struct body {
    ovoid_robot_element parts[MOST_PARTS];
    ovoid_robot_sphere spheres[MOST_SPHERES];
    size_t part_count, sphere_count;
} body;

static ovoid_shape *read_mesh(const char *folder, const char *mesh) {
    char name[256] = "", path[1024];
    (void)sscanf(strstr(mesh, "meshes/"), "%255[^\"]", name);
    (void)snprintf(path, sizeof path, "%s/%s", folder, name);
    double *xyz = NULL;
    size_t count = read_points(path, &xyz);
    ovoid_shape *shape = count ? ovoid_shape_create_from_points(xyz, count, NULL, NULL) : NULL;
    free(xyz);
    return shape;
}

// What the collision elements of a link are.
static void read_link(body *b, const char *link, const char *folder) {
    for (const char *at = link; (at = strstr(at, "<collision")) != NULL; at++) {
        char *collision = copy_element(at, "</collision>");
        const char *sphere = strstr(collision, "<sphere"), *mesh = strstr(collision, "<mesh");
        ovoid_pose pose = read_origin(collision);
        double radius = 0;
        if (sphere && b->sphere_count < MOST_SPHERES && sscanf(sphere, "<sphere radius=\"%lf", &radius) == 1)
            b->spheres[b->sphere_count++] = (ovoid_robot_sphere){pose.position, radius};
        ovoid_shape *shape = sphere ? ovoid_shape_create_sphere(radius, NULL, NULL)
                             : mesh ? read_mesh(folder, mesh)
                                    : NULL;
        if (shape && b->part_count < MOST_PARTS)
            b->parts[b->part_count++] = (ovoid_robot_element){0, NULL, shape, pose, NULL};
        else
            ovoid_shape_destroy(shape);
        free(collision);
    }
}

static void free_parts(body *b) {
    for (size_t i = 0; i < b->part_count; i++) ovoid_shape_destroy((ovoid_shape *)(uintptr_t)b->parts[i].shape);
}

static void read_named(body *b, const char *text, const char *name, const char *folder) {
    char tag[300];
    (void)snprintf(tag, sizeof tag, "<link name=\"%s\"", name);
    *b = (body){.part_count = 0};
    const char *at = strstr(text, tag);
    if (!at) return;
    char *link = copy_element(at, "</link>");
    read_link(b, link, folder);
    free(link);
}

/// Sums over a robot's links.
typedef struct sums {
    double link, theirs_uncovered, theirs_excess, grown_excess, needed_excess, ours_excess;
    size_t less_than_grown;
    size_t spheres, less;
} sums;

static size_t rounds = 60;
// Of audits: 0 the default. Without --full of a few links, and coarse.
static ovoid_robot_audit_options cells = {.volume_cells = 4096};

// Grows each sphere only as it must: the one that is nearest to the deepest uncovered point, again and again; what is
// left, less than a ten-thousandth of a metre, all of them.
static void grow_as_needed(const ovoid_robot *robot, ovoid_robot_sphere *s, size_t count) {
    ovoid_robot_audit_options o = {.tolerance = 1e-5, .without_volumes = 1};
    for (int round = 0; round < 2000; round++) {
        ovoid_robot_sphere_audit a;
        ovoid_error error;
        CHECK_EQ(ovoid_robot_compute_sphere_audit(&(ovoid_robot_sphere_model){robot, 0, s, count}, &o, &a, &error),
                 OVOID_OK);
        if (a.depth.upper <= 0) return;
        if (a.depth.lower > 1e-4)
            s[a.sphere].radius += a.depth.lower;
        else
            for (size_t i = 0; i < count; i++) s[i].radius += a.depth.upper + 1e-6;
    }
    CHECK(!"the spheres cover after 2000 rounds");
}

static void compare(const char *name, const body *link, const body *given, sums *sum) {
    ovoid_error error = {0};
    ovoid_robot_link one = {name};
    ovoid_robot_description d = {
        .links = &one, .link_count = 1, .elements = link->parts, .element_count = link->part_count};
    ovoid_robot *robot = ovoid_robot_create(&d, NULL, &error);
    ovoid_robot_sphere_audit theirs, grown, needed, ours;
    ovoid_robot_sphere found[MOST_SPHERES], larger[MOST_SPHERES];
    size_t count = given->sphere_count;
    ovoid_robot_cover_options options = {.rounds = rounds};
    CHECK_EQ(ovoid_robot_compute_sphere_audit(&(ovoid_robot_sphere_model){robot, 0, given->spheres, count}, &cells,
                                              &theirs, &error),
             OVOID_OK);
    for (size_t i = 0; i < count; i++) {
        larger[i] = given->spheres[i];
        larger[i].radius += theirs.depth.upper > 0 ? theirs.depth.upper : 0;
    }
    CHECK_EQ(
        ovoid_robot_compute_sphere_audit(&(ovoid_robot_sphere_model){robot, 0, larger, count}, &cells, &grown, &error),
        OVOID_OK);
    memcpy(larger, given->spheres, count * sizeof *larger);
    grow_as_needed(robot, larger, count);
    CHECK_EQ(
        ovoid_robot_compute_sphere_audit(&(ovoid_robot_sphere_model){robot, 0, larger, count}, &cells, &needed, &error),
        OVOID_OK);
    CHECK_LE(needed.depth.upper, 0.0);
    CHECK_LE(needed.excess.lower, grown.excess.upper);
    ovoid_robot_sphere_cover cover = {.spheres = found, .capacity = count};
    CHECK_EQ(ovoid_robot_compute_sphere_cover(robot, &options, &cover, &error), OVOID_OK);
    count = cover.count;
    CHECK_EQ(
        ovoid_robot_compute_sphere_audit(&(ovoid_robot_sphere_model){robot, 0, found, count}, &cells, &ours, &error),
        OVOID_OK);
    CHECK_LE(cover.depth.upper, 0.0);
    CHECK_LE(ours.depth.upper, 0.0);
    CHECK_LE(ours.excess.lower, grown.excess.upper);
    double l = ours.link.upper;
    printf("%-26s %3zu | %6.2f mm %5.1f %% %6.1f-%.1f %% | %6.1f %% | %6.1f %% | %6.1f-%.1f %% %s\n", name, count,
           1e3 * theirs.depth.lower, 100 * theirs.uncovered.lower / l, 100 * theirs.excess.lower / l,
           100 * theirs.excess.upper / l, 100 * grown.excess.lower / l, 100 * needed.excess.lower / l,
           100 * ours.excess.lower / l, 100 * ours.excess.upper / l,
           ours.excess.upper < theirs.excess.lower ? "less" : "");
    sum->link += l, sum->theirs_uncovered += theirs.uncovered.lower;
    sum->theirs_excess += theirs.excess.lower, sum->ours_excess += ours.excess.upper;
    sum->needed_excess += needed.excess.lower;
    sum->grown_excess += grown.excess.lower, sum->less_than_grown += ours.excess.upper < grown.excess.lower;
    sum->spheres += count, sum->less += ours.excess.upper < theirs.excess.lower;
    ovoid_robot_destroy(robot);
}

// A link of one sphere, one of four, a small one.
static int is_in_short(const char *name) {
    static const char *const names[] = {"panda_link0", "panda_link2", "panda_leftfinger"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (strcmp(name, names[i]) == 0) return 1;
    return 0;
}

static void test_robot(const char *data, const char *folder_name, const char *robot) {
    char folder[600], path[1000];
    size_t size;
    (void)snprintf(folder, sizeof folder, "%s/robots/%s", data, folder_name);
    (void)snprintf(path, sizeof path, "%s/%s.urdf", folder, robot);
    char *plain = read_all(path, &size);
    (void)snprintf(path, sizeof path, "%s/%s_spherized.urdf", folder, robot);
    char *spherized = read_all(path, &size);
    if (!plain || !spherized) {
        check_skip(robot);
        free(plain), free(spherized);
        return;
    }
    printf("link, spheres | theirs: deepest uncovered, uncovered volume, volume outside | grown to cover, outside | "
           "each as needed | "
           "ours outside; of the link\n");
    sums sum = {0};
    for (const char *at = plain; (at = strstr(at, "<link name=\"")) != NULL; at++) {
        char name[256] = "";
        (void)sscanf(at, "<link name=\"%255[^\"]", name);
        body link, given;
        read_named(&link, plain, name, folder);
        read_named(&given, spherized, name, folder);
        int is_wanted = !rounds || is_in_short(name);
        if (is_wanted && link.part_count && given.sphere_count) compare(name, &link, &given, &sum);
        free_parts(&link);
        free_parts(&given);
    }
    printf("%s: %zu spheres; theirs leave %.2f %% uncovered and have %.1f %% outside, grown to cover %.1f %%, each as "
           "needed %.1f %%, ours "
           "%.1f %%; less on %zu links, than the grown on %zu\n",
           robot, sum.spheres, 100 * sum.theirs_uncovered / sum.link, 100 * sum.theirs_excess / sum.link,
           100 * sum.grown_excess / sum.link, 100 * sum.needed_excess / sum.link, 100 * sum.ours_excess / sum.link,
           sum.less, sum.less_than_grown);
    free(plain), free(spherized);
}

int main(int count, char **arguments) {
    const char *data = check_data_folder();
    int full = 0;
    const test_option options[] = {{"full", "all robots and cells, which takes long", NULL, NULL, NULL, &full},
                                   {NULL, NULL, NULL, NULL, NULL, NULL}};
    int code = options_read(options, count, arguments);
    if (code >= 0) return code;
    if (full) rounds = 0, cells.volume_cells = 0;
    if (data) {
        test_robot(data, "panda_mbm", "panda");
        if (full) test_robot(data, "fetch_mbm", "fetch");
    } else
        check_skip("no folder of data: the robots' spheres");
    return check_end();
}
