// Our hulls beside those of Qhull (C. B. Barber, D. P. Dobkin, H. Huhdanpaa, 1996), another program, which works in
// doubles with tolerances. On random clouds no four points are so near a plane that its tolerance, about 1e-15 of the
// size, would matter: vertices must be the same points, volume and area the same to the rounding of sums of a few
// thousand terms. The times of both are printed, not judged.
#include "hulls.h"
#include "linear/mat3.h"

#include <libqhull_r/qhull_ra.h>
#include <time.h>

#define MOST 100000

static double cloud[3 * MOST];
static uint8_t is_vertex[MOST];

static double get_seconds(void) {
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

typedef struct outcome {
    double volume, area, seconds;
    int code;
} outcome;

// Qhull's hull; its vertices into is_vertex. It writes nothing anywhere.
static outcome run_qhull(size_t count) {
    outcome o = {0};
    qhT qh;
    FILE *nothing = fopen("/dev/null", "w");
    char command[] = "qhull";
    memset(&qh, 0, sizeof qh);
    qh_zero(&qh, nothing);
    o.seconds = -get_seconds();
    o.code = qh_new_qhull(&qh, 3, (int)count, cloud, 0, command, nothing, nothing);
    o.seconds += get_seconds();
    memset(is_vertex, 0, count);
    if (o.code == 0) {
        qh_getarea(&qh, qh.facet_list);
        o.volume = qh.totvol;
        o.area = qh.totarea;
        for (vertexT *v = qh.vertex_list; v && v->next; v = v->next) is_vertex[qh_pointid(&qh, v->point)] = 1;
    }
    int current, total;
    qh_freeqhull(&qh, 1);
    qh_memfreeshort(&qh, &current, &total);
    fclose(nothing);
    return o;
}

static void check_against_qhull(size_t count, const char *name) {
    ovoid_allocator memory = allocator_make(NULL);
    hull h;
    double seconds = -get_seconds();
    ovoid_code code = hull_create((xyz_points){cloud, count}, &memory, &h, NULL);
    seconds += get_seconds();
    outcome o = run_qhull(count);
    CHECK_EQ(code, OVOID_OK);
    CHECK_EQ(o.code, 0);
    uint32_t at = 0, differing = 0;
    for (size_t k = 0; k < count; k++) {
        vec3 p = vec3_at(cloud, k);
        int kept = at < h.vertex_count && h.vertices[3 * at] == p.x && h.vertices[3 * at + 1] == p.y &&
                   h.vertices[3 * at + 2] == p.z;
        at += (uint32_t)kept;
        differing += kept != is_vertex[k];
    }
    CHECK_EQ(differing, 0);
    ovoid_polytope p = hull_get_polytope(&h);
    ovoid_measures m = ovoid_polytope_compute_measures(&p);
    CHECK_NEAR(m.volume, o.volume, 1e-12 * o.volume);
    CHECK_NEAR(m.area, o.area, 1e-12 * o.area);
    if (name)
        printf("%s, %zu points, %u vertices: ours %.1f ms, Qhull %.1f ms\n", name, count, h.vertex_count, 1e3 * seconds,
               1e3 * o.seconds);
    hull_destroy(&h, &memory);
}

static void fill(size_t count, uint64_t *s, int kind) {
    for (size_t i = 0; i < count; i++) {
        vec3 v = {random_normal(s), random_normal(s), random_normal(s)};
        if (kind == 1) v = vec3_unit(v);
        if (kind == 2) v = (vec3){random_uniform(s, -1, 1), random_uniform(s, -1, 1), random_uniform(s, -1, 1)};
        if (kind == 3) v = (vec3){v.x, 3 * v.y, v.z / 300};
        cloud[3 * i] = v.x;
        cloud[3 * i + 1] = v.y;
        cloud[3 * i + 2] = v.z;
    }
}

int main(void) {
    uint64_t s = 11;
    for (int i = 0; i < 200; i++) {
        check_seed = s;
        size_t n = 4 + random_next(&s) % 100;
        fill(n, &s, i % 4);
        check_against_qhull(n, NULL);
    }
    check_seed = 0;
    static const char *names[] = {"normal", "sphere", "cube", "slab"};
    for (int kind = 0; kind < 4; kind++)
        for (size_t n = 1000; n <= MOST; n *= 10) {
            fill(n, &s, kind);
            check_against_qhull(n, names[kind]);
        }
    return check_end();
}
