// The check of a decomposition's proof, and a liar: true proofs of random solids and parts, altered one field at a
// time, must be refused unless they are still true. Truth: points in extended precision, by brute force over triangles.
#include "check.h"
#include "decompositions.h"

enum { LIES = 22 };

typedef struct truth {
    ovoid_decomposition d;
    ovoid_decomposition_proof proof;
    ovoid_decomposition_options options;
    long_mesh solid, parts[4];
    double size;
} truth;

static struct { long refused, held; } counts[LIES];

static ovoid_decomposition_length *get_length(ovoid_decomposition_proof *p, int which) {
    return which ? &p->excess : &p->uncovered;
}

// The truth about a point that shows a length, or -1 where it shows nothing.
static double measure(const truth *t, const ovoid_decomposition_length *l, int which) {
    long3 x = long3_from(l->point);
    if (l->part >= t->d.part_count) return -1;
    if (!which)
        return long_mesh_distance(&t->solid, x) > 1e-13 * t->size ? -1
                                                                  : (double)long_parts_distance(t->parts, &t->d, x);
    ovoid_decomposition own = {t->d.solid, &t->d.parts[l->part], 1};
    double off = (double)long_parts_distance(&t->parts[l->part], &own, x);
    return (double)long_mesh_distance(&t->solid, x) - off;
}

// An alteration of one length; 0 where it changes nothing.
static int alter(ovoid_decomposition_length *l, int lie, double size) {
    ovoid_decomposition_length before = *l;
    switch (lie) {
    case 0: l->upper = l->lower + 0.5 * (l->upper - l->lower); break;
    case 1: l->upper *= 0.5; break;
    case 2: l->upper = 0; break;
    case 3: l->upper = l->lower; break;
    case 4: l->upper *= 1 - 1e-6; break;
    case 5: l->upper = nextafter(l->upper, 0); break;
    case 6: l->upper = nextafter(l->upper, INFINITY); break;
    case 7: l->upper = NAN; break;
    case 8: l->upper = -l->upper; break;
    case 9: l->upper = INFINITY; break;
    case 10: l->lower = l->upper; break;
    case 11: l->lower = 0.5 * (l->lower + l->upper); break;
    case 12: l->lower *= 1 + 1e-6; break;
    case 13: l->lower = nextafter(l->lower, INFINITY); break;
    case 14: l->lower = NAN; break;
    case 15: l->lower = -1; break;
    case 16: l->point.x += 0.1 * size; break;
    case 17: l->point = (ovoid_vec3){0, 0, 0}; break;
    case 18: l->point.y = NAN; break;
    case 19: l->point.z = nextafter(l->point.z, 1e9); break;
    case 20: l->part++; break;
    default: l->part = UINT32_MAX; break;
    }
    return memcmp(&before, l, sizeof before) != 0;
}

// What an accepted claim says must be true of random points, of the solid's and the parts' corners, and of its own
// point.
static void hold(const truth *t, const ovoid_decomposition_length *l, int which, uint64_t *s) {
    double slack = 1e-13 * t->size;
    CHECK(l->lower >= 0 && l->lower <= l->upper);
    if (l->lower > 0) CHECK_LE(l->lower, measure(t, l, which) + slack);
    // Better shown than by the true proof's own point: the truth is at least that.
    ovoid_decomposition_proof own = t->proof;
    CHECK_LE(get_length(&own, which)->lower, l->upper);
    ovoid_box box = ovoid_solid_get_report(t->d.solid).box;
    for (int i = 0; i < 20; i++) {
        long3 x = long3_from(draw_in(s, &box));
        if (!which && long_mesh_distance(&t->solid, x) <= 0)
            CHECK_LE((double)long_parts_distance(t->parts, &t->d, x), l->upper + slack);
        for (size_t k = 0; which && k < t->d.part_count; k++)
            for (size_t c = 0; c < 3 * t->parts[k].count; c += 7)
                CHECK_LE((double)long_mesh_distance(&t->solid, t->parts[k].corners[c]), l->upper + slack);
        if (which) break;
    }
}

static void tell_lies(const truth *t, uint64_t *s) {
    for (int which = 0; which < 2; which++)
        for (int lie = 0; lie < LIES; lie++) {
            ovoid_decomposition_proof altered = t->proof;
            ovoid_error error = {.message = ""};
            if (!alter(get_length(&altered, which), lie, t->size)) continue;
            ovoid_code code = ovoid_decomposition_verify(&t->d, &altered, &t->options, &error);
            if (code == OVOID_OK) {
                counts[lie].held++;
                hold(t, get_length(&altered, which), which, s);
            } else {
                counts[lie].refused++;
                CHECK(code == OVOID_ERROR_ARGUMENT || code == OVOID_ERROR_LIMIT);
                CHECK(strstr(error.message, which ? "excess: " : "uncovered: "));
            }
        }
    ovoid_decomposition_proof swapped = t->proof;
    swapped.uncovered = t->proof.excess, swapped.excess = t->proof.uncovered;
    if (ovoid_decomposition_verify(&t->d, &swapped, &t->options, NULL) == OVOID_OK) {
        hold(t, &swapped.uncovered, 0, s);
        hold(t, &swapped.excess, 1, s);
    }
}

// Boxes about the solid's, some in it, some beside it.
static size_t make_boxes(const ovoid_solid *solid, ovoid_shape *parts[4], uint64_t *s) {
    ovoid_box box = ovoid_solid_get_report(solid).box;
    size_t count = 1 + random_next(s) % 3;
    for (size_t i = 0; i < count; i++) {
        ovoid_vec3 a = draw_in(s, &box), b = draw_in(s, &box);
        parts[i] = i ? make_box_between(a, b) : make_box_between(box.min, box.max);
    }
    return count;
}

static void check_random(int rounds) {
    for (int i = 0; i < rounds; i++) {
        uint64_t s = check_seed = 900 + (uint64_t)i;
        double scale = i % 3 == 2 ? 1e-40 : 1;
        mesh m = {NULL, NULL, 0, 0, 0, 0};
        mesh_add_random(&m, scale, &s);
        ovoid_solid *solid = mesh_make_solid(&m);
        ovoid_shape *parts[4] = {NULL, NULL, NULL, NULL};
        truth t = {.d = {solid, (const ovoid_shape *const *)parts, 0}, .size = scale};
        t.d.part_count = make_boxes(solid, parts, &s);
        // Without the box around all, something is uncovered.
        if (i % 2 && t.d.part_count > 1) t.d.parts++, t.d.part_count--;
        ovoid_decomposition_options tight = {.tolerance = 0.02 * scale, .work = 20000};
        t.options = (ovoid_decomposition_options){.work = 60000};
        ovoid_error error = {.message = ""};
        CHECK_EQ(ovoid_decomposition_compute_proof(&t.d, &tight, &t.proof, &error), OVOID_OK);
        t.solid = long_mesh_of_solid(solid);
        for (size_t k = 0; k < t.d.part_count; k++) t.parts[k] = long_mesh_of_shape(t.d.parts[k]);
        ovoid_code code = ovoid_decomposition_verify(&t.d, &t.proof, &t.options, &error);
        if (!CHECK_EQ(code, OVOID_OK)) printf("  %s\n", error.message);
        tell_lies(&t, &s);
        free(t.solid.corners);
        for (size_t k = 0; k < t.d.part_count; k++) free(t.parts[k].corners);
        for (int k = 0; k < 4; k++) ovoid_shape_destroy(parts[k]);
        ovoid_solid_destroy(solid);
        mesh_clear(&m);
    }
    check_seed = 0;
}

int main(void) {
    check_random(12);
    for (int i = 0; i < LIES; i++)
        printf("lie %d: refused %ld, still true %ld\n", i, counts[i].refused, counts[i].held);
    CHECK(ovoid_decomposition_verify(NULL, NULL, NULL, NULL) == OVOID_ERROR_ARGUMENT);
    return check_end();
}
