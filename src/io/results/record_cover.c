// Covers in results: the surface around the origin that proves an upper bound, as pairs of vertices and triangles of
// these.
#include "io/json.h"
#include "io/results/record.h"

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

const char *record_cover_read(const json_t *value, ovoid_cover *cover) {
    const json_t *pairs = json_object_get(value, "pairs"), *triangles = json_object_get(value, "triangles");
    size_t points = json_array_size(pairs), count = json_array_size(triangles);
    double v[3];
    if (json_object_size(value) != 2 || !json_is_array(pairs) || !json_is_array(triangles))
        return "must have \"pairs\" and \"triangles\", two lists, and no more";
    if (!points || points > OVOID_COVER_POINTS) return "must have 1 to 512 pairs";
    if (count > 2 * OVOID_COVER_POINTS) return "must have at most 1024 triangles";
    for (size_t i = 0; i < points; i++) {
        if (!json_read_wholes(json_array_get(pairs, i), 2, UINT32_MAX, v))
            return "must have pairs of vertices as its \"pairs\"";
        cover->a[i] = (uint32_t)v[0];
        cover->b[i] = (uint32_t)v[1];
    }
    for (size_t i = 0; i < count; i++) {
        if (!json_read_wholes(json_array_get(triangles, i), 3, (double)(points - 1), v))
            return "must have triples of pairs as its \"triangles\"";
        for (int k = 0; k < 3; k++) cover->triangles[i][k] = (uint16_t)v[k];
    }
    cover->point_count = (uint32_t)points;
    cover->triangle_count = (uint32_t)count;
    return NULL;
}
