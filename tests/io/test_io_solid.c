// Solids of mesh files. Truth: volumes in closed form, which a wrong cut of a polygon changes; sentences and codes of
// what is refused.
#include "check.h"
#include "files.h"

#include <ovoid/io.h>

#include <string.h>

// A prism along z over the polygon of the points "x y" counter-clockwise; first: where its faces begin.
static const char *write_prism(const char *name, const char *const *points, int count, int first, double height) {
    static char data[4096];
    int at = 0;
    for (int side = 0; side < 2; side++)
        for (int i = 0; i < count; i++)
            at += snprintf(data + at, sizeof data - (size_t)at, "v %s %g\n", points[i], side * height);
    for (int side = 0; side < 2; side++) {
        at += snprintf(data + at, sizeof data - (size_t)at, "f");
        for (int i = 0; i < count; i++) {
            int k = (first + (side ? i : count - i)) % count;
            at += snprintf(data + at, sizeof data - (size_t)at, " %d", 1 + k + side * count);
        }
        at += snprintf(data + at, sizeof data - (size_t)at, "\n");
    }
    for (int i = 0; i < count; i++) {
        int k = (i + 1) % count;
        at += snprintf(data + at, sizeof data - (size_t)at, "f %d %d %d %d\n", 1 + i, 1 + k, 1 + k + count,
                       1 + i + count);
    }
    return file_write_text(name, data);
}

static const char *const corner[6] = {"0 0", "2 0", "2 1", "1 1", "1 2", "0 2"};
static const char *const cup[8] = {"0 0", "4 0", "4 3", "3 3", "3 1", "1 1", "1 3", "0 3"};

static void check_polygons(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    for (int first = 0; first < 6; first++) {
        ovoid_solid *solid = ovoid_solid_read_file(write_prism("l.obj", corner, 6, first, 1.5), NULL, &error);
        if (!CHECK(solid != NULL)) continue;
        ovoid_solid_report r = ovoid_solid_get_report(solid);
        CHECK_EQ(r.is_closed, 1);
        CHECK_EQ(r.triangles, 20);
        CHECK_NEAR(r.volume, 4.5, 1e-12);
        // The notch is outside, the corner of it inside.
        int64_t winding = 9;
        CHECK(ovoid_solid_compute_winding(solid, (ovoid_vec3){1.5, 1.5, 0.7}, &winding) && winding == 0);
        CHECK(ovoid_solid_compute_winding(solid, (ovoid_vec3){0.9, 0.9, 0.7}, &winding) && winding == 1);
        ovoid_solid_destroy(solid);
    }
    const ovoid_read_options half = {.scale = 0.5, .parts = 1};
    ovoid_solid *solid = ovoid_solid_read_file(write_prism("l.obj", corner, 6, 0, 1.5), &half, &error);
    if (CHECK(solid != NULL)) CHECK_NEAR(ovoid_solid_get_report(solid).volume, 4.5 / 8, 1e-12);
    ovoid_solid_destroy(solid);
}

static void check_refused(const char *path, ovoid_code code, int64_t place, const char *words) {
    ovoid_error error = {OVOID_OK, -1, ""};
    CHECK(ovoid_solid_read_file(path, NULL, &error) == NULL);
    CHECK_EQ(error.code, code);
    CHECK_EQ(error.place, place);
    CHECK(strstr(error.message, words) != NULL);
    CHECK(ovoid_solid_read_file(path, NULL, NULL) == NULL);
}

int main(void) {
    check_polygons();
    check_refused(write_prism("u.obj", cup, 8, 0, 1), OVOID_ERROR_FORMAT, 0, "u.obj: face 0 cannot be cut");
    check_refused(file_write_text("cloud.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"), OVOID_ERROR_EMPTY, -1, "no faces");
    check_refused(file_path("absent.obj"), OVOID_ERROR_FILE, -1, "absent.obj");
    return check_end();
}
