// The proof of a decomposition as one line of JSON, written, and read strictly.
#include "io/json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void write_length(FILE *file, const char *name, const ovoid_decomposition_length *l) {
    const double p[] = {l->point.x, l->point.y, l->point.z};
    fprintf(file, ",\"%s\":{\"lower\":", name);
    json_write_number(file, l->lower);
    fputs(",\"upper\":", file);
    json_write_number(file, l->upper);
    for (int k = 0; k < 3; k++) {
        fputs(k ? "," : ",\"point\":[", file);
        json_write_number(file, l->lower > 0 ? p[k] : 0);
    }
    fprintf(file, "],\"part\":%lu}", l->lower > 0 ? (unsigned long)l->part : 0ul);
}

ovoid_code ovoid_decomposition_write_json(FILE *file, const ovoid_decomposition *decomposition,
                                          const ovoid_decomposition_proof *proof) {
    fprintf(file, "{\"decomposition\":1,\"triangles\":%llu,\"parts\":%zu",
            (unsigned long long)ovoid_solid_get_report(decomposition->solid).triangles, decomposition->part_count);
    write_length(file, "uncovered", &proof->uncovered);
    write_length(file, "excess", &proof->excess);
    fputs("}\n", file);
    return ferror(file) ? OVOID_ERROR_FILE : OVOID_OK;
}

/// Why the object has not these keys, each once, and no other; NULL: it has.
static const char *validate_keys(const json_t *object, const char *const *keys, size_t count) {
    if (!json_is_object(object)) return "is no object";
    for (size_t i = 0; i < count; i++)
        if (!json_object_get(object, keys[i])) return "lacks a key, or has another one";
    return json_object_size(object) == count ? NULL : "has a key too many";
}

/// A whole number from 0 to `most`; 0 where there is none.
static int read_count(const json_t *value, double most, double *count) {
    *count = json_number_value(value);
    return json_is_number(value) && *count >= 0 && *count <= most && *count == floor(*count);
}

static const char *read_length(const json_t *object, ovoid_decomposition_length *l) {
    static const char *const keys[] = {"lower", "upper", "point", "part"};
    const char *wrong = validate_keys(object, keys, 4);
    double part;
    if (wrong) return wrong;
    const json_t *lower = json_object_get(object, "lower"), *upper = json_object_get(object, "upper");
    const json_t *point = json_object_get(object, "point");
    double *to[] = {&l->point.x, &l->point.y, &l->point.z};
    if (!json_is_number(lower) || !json_is_number(upper)) return "needs numbers as lower and upper";
    if (json_array_size(point) != 3) return "needs a point of three numbers";
    for (size_t k = 0; k < 3; k++) {
        if (!json_is_number(json_array_get(point, k))) return "needs a point of three numbers";
        *to[k] = json_number_value(json_array_get(point, k));
    }
    if (!read_count(json_object_get(object, "part"), UINT32_MAX, &part)) return "needs the number of a part";
    l->lower = json_number_value(lower);
    l->upper = json_number_value(upper);
    l->part = (uint32_t)part;
    return NULL;
}

static ovoid_code read_proof(const json_t *root, where at, ovoid_decomposition_record *record, ovoid_error *error) {
    static const char *const keys[] = {"decomposition", "triangles", "parts", "uncovered", "excess"};
    double version, triangles, parts;
    const char *wrong = validate_keys(root, keys, 5), *name = "the proof";
    if (!wrong && (!read_count(json_object_get(root, "decomposition"), 1, &version) || version != 1))
        wrong = "is of another version than 1";
    if (!wrong && (!read_count(json_object_get(root, "triangles"), 0x1p53, &triangles) ||
                   !read_count(json_object_get(root, "parts"), 0x1p53, &parts)))
        wrong = "needs whole numbers as triangles and parts";
    if (!wrong && (wrong = read_length(json_object_get(root, name = "uncovered"), &record->proof.uncovered)) == NULL)
        wrong = read_length(json_object_get(root, name = "excess"), &record->proof.excess);
    if (wrong) return io_fail(error, OVOID_ERROR_FORMAT, at, "%s %s", name, wrong);
    record->triangles = (uint64_t)triangles;
    record->parts = (uint64_t)parts;
    return OVOID_OK;
}

ovoid_code ovoid_decomposition_read_json(const char *path, ovoid_decomposition_record *record, ovoid_error *error) {
    bytes file;
    json_error_t why;
    *record = (ovoid_decomposition_record){0};
    ovoid_code code = bytes_read_input(path, OVOID_RECORD_SIZE_MAX, &file, error);
    if (code) return code;
    json_t *root = json_load(bytes_skip_mark(file), JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL, &why);
    if (root)
        code = read_proof(root, (where){path, 1, -1}, record, error);
    else if ((code = json_get_failure(&why)) == OVOID_ERROR_MEMORY)
        code = io_fail_memory(error, path);
    else
        code = io_fail(error, code, (where){path, why.line, -1}, "JSON: %s", why.text);
    json_decref(root);
    free(file.data);
    return code;
}

int ovoid_decomposition_is_proof(const char *path) {
    static const char begin[] = "{\"decomposition\"";
    char text[sizeof begin] = "";
    FILE *file = strcmp(path, "-") == 0 ? NULL : fopen(path, "rb");
    size_t size = file ? fread(text, 1, sizeof begin - 1, file) : 0;
    if (file) (void)fclose(file); // it was read
    return size == sizeof begin - 1 && strcmp(text, begin) == 0;
}
