// Covers in results: the surface around the origin that proves an upper bound, as pairs of vertices and triangles of
// these.
#include "io/json.h"
#include "io/results/record.h"

#include <stdlib.h>

void record_cover_write(FILE *file, const char *q, const ovoid_cover *cover) {
    fprintf(file, "{%spairs%s:", q, q);
    for (uint32_t i = 0; i < cover->point_count; i++)
        fprintf(file, "%s[%lu,%lu]", i ? "," : "[", (unsigned long)cover->a[i], (unsigned long)cover->b[i]);
    fprintf(file, "],%striangles%s:", q, q);
    for (uint32_t i = 0; i < cover->triangle_count; i++) {
        const uint16_t *t = cover->triangles[i];
        fprintf(file, "%s[%u,%u,%u]", i ? "," : "[", (unsigned)t[0], (unsigned)t[1], (unsigned)t[2]);
    }
    fputs(cover->triangle_count ? "]}" : "[]}", file);
}

// One block: the cover, its points of A, of B, and its triangles.
static ovoid_cover *create_cover(size_t points, size_t triangles) {
    ovoid_cover *cover =
        calloc(1, sizeof *cover + points * 2 * sizeof *cover->a + triangles * sizeof *cover->triangles);
    if (!cover) return NULL;
    const uint32_t *a = (const uint32_t *)(const void *)(cover + 1), *b = a + points;
    cover->point_count = (uint32_t)points;
    cover->triangle_count = (uint32_t)triangles;
    cover->a = a;
    cover->b = b;
    cover->triangles = (const uint16_t(*)[3])(const void *)(b + points);
    return cover;
}

static const char *read_pairs(const json_t *pairs, const ovoid_cover *cover) {
    uint32_t *a = (uint32_t *)cover->a, *b = (uint32_t *)cover->b;
    double v[2];
    for (uint32_t i = 0; i < cover->point_count; i++) {
        if (!json_read_wholes(json_array_get(pairs, i), 2, UINT32_MAX, v))
            return "must have pairs of vertices as its \"pairs\"";
        a[i] = (uint32_t)v[0];
        b[i] = (uint32_t)v[1];
    }
    return NULL;
}

static const char *read_triangles(const json_t *triangles, const ovoid_cover *cover) {
    uint16_t(*to)[3] = (uint16_t(*)[3])cover->triangles;
    double v[3];
    for (uint32_t i = 0; i < cover->triangle_count; i++) {
        if (!json_read_wholes(json_array_get(triangles, i), 3, (double)(cover->point_count - 1), v))
            return "must have triples of pairs as its \"triangles\"";
        for (int k = 0; k < 3; k++) to[i][k] = (uint16_t)v[k];
    }
    return NULL;
}

const char *record_cover_read(const json_t *value, const ovoid_cover **cover) {
    const json_t *pairs = json_object_get(value, "pairs"), *triangles = json_object_get(value, "triangles");
    size_t points = json_array_size(pairs), count = json_array_size(triangles);
    if (json_object_size(value) != 2 || !json_is_array(pairs) || !json_is_array(triangles))
        return "must have \"pairs\" and \"triangles\", two lists, and no more";
    if (!points || points > OVOID_COVER_POINTS_MAX) return "must have 1 to 32767 pairs";
    if (count > 2 * OVOID_COVER_POINTS_MAX) return "must have at most 65534 triangles";
    *cover = create_cover(points, count);
    if (!*cover) return "needs more memory than there is";
    const char *wrong = read_pairs(pairs, *cover);
    return wrong ? wrong : read_triangles(triangles, *cover);
}
