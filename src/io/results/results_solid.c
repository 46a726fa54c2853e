// What a record of solids has beside the answer of the deciding pair, and what meshes are taken as: written and read.
//
// "status", "limit", "lower" and "upper" are those of the bodies; the proof's "surfaces" are those of the two surfaces,
// and its "parting" the direction along which the bodies' boxes show `lower`, where that is 0 or below.
#include "io/json.h"
#include "io/results/record.h"

#include <math.h>
#include <string.h>

static const char *const kinds[] = {"hull", "parts", "solid", "surface"};

const char *ovoid_mesh_kind_get_name(ovoid_mesh_kind kind) {
    return (unsigned)kind < sizeof kinds / sizeof *kinds ? kinds[kind] : "unknown";
}

void ovoid_record_set_solid(ovoid_record *record, const ovoid_solid_answer *answer) {
    record->solid = answer;
    record->answer = answer->surfaces;
    record->answer.status = answer->status;
    record->answer.limit = answer->limit;
    record->answer.lower = answer->lower;
    record->answer.upper = answer->upper;
}

static int has_triangles(ovoid_mesh_kind kind) { return kind == OVOID_MESH_SOLID || kind == OVOID_MESH_SURFACE; }

static const char *const insides[] = {"", "a in b", "b in a", "common point"};

/// 1 where the body is the hull of a mesh that is so only nearly.
static int has_allowance(ovoid_mesh_kind kind, const ovoid_convexity *mesh) {
    return kind == OVOID_MESH_HULL && mesh->allowance > 0;
}

static const char *find_inside(const ovoid_solid_answer *x) {
    return (unsigned)x->inside < sizeof insides / sizeof *insides ? insides[x->inside] : "";
}

/// 1 where the lower bound of the bodies is that of a direction.
static int has_parting(const ovoid_answer *bodies) { return bodies->lower <= 0 && bodies->lower != -INFINITY; }

// ---- written

static void write_side(FILE *file, const char *key, int side, double number) {
    fprintf(file, ",\"%s_%c\":", key, side ? 'b' : 'a');
    json_write_number(file, number);
}

void record_write_kind(FILE *file, const ovoid_record *record, int side) {
    ovoid_mesh_kind kind = side ? record->kind_b : record->kind_a;
    const ovoid_convexity *mesh = side ? &record->mesh_b : &record->mesh_a;
    fprintf(file, ",\"kind_%c\":\"%s\"", side ? 'b' : 'a', ovoid_mesh_kind_get_name(kind));
    if (has_allowance(kind, mesh)) write_side(file, "allowance", side, mesh->allowance);
    if (record->fields & OVOID_RECORD_MESHES) {
        write_side(file, "mesh_volume", side, mesh->mesh_volume);
        write_side(file, "hull_volume", side, mesh->hull_volume);
    }
}

void record_write_triangle(FILE *file, const ovoid_record *record, int side) {
    if (record->solid && has_triangles(side ? record->kind_b : record->kind_a))
        fprintf(file, ",\"triangle_%c\":%lu", side ? 'b' : 'a',
                (unsigned long)(side ? record->solid->triangle_b : record->solid->triangle_a));
}

static void write_vector(FILE *file, ovoid_vec3 v) {
    const double x[3] = {v.x, v.y, v.z};
    for (int k = 0; k < 3; k++) {
        fputc(k ? ',' : '[', file);
        json_write_number(file, x[k]);
    }
    fputc(']', file);
}

void record_write_inside(FILE *file, const ovoid_record *record) {
    const ovoid_solid_answer *x = record->solid;
    if (!x || !x->inside) return;
    fprintf(file, ",\"inside\":\"%s\"", find_inside(x));
    if (x->inside == OVOID_SOLID_COMMON_POINT) {
        fputs(",\"common\":", file);
        write_vector(file, x->common);
    } else {
        fprintf(file, ",\"component\":%lu", (unsigned long)x->component);
    }
}

void record_write_surfaces(FILE *file, const char *q, const ovoid_record *record) {
    const ovoid_solid_answer *x = record->solid;
    if (!x) return;
    fprintf(file, ",%ssurfaces%s:{%sstatus%s:%s%s%s,%slimit%s:%s%s%s,%slower%s:", q, q, q, q, q,
            ovoid_status_get_name(x->surfaces.status), q, q, q, q, ovoid_limit_get_name(x->surfaces.limit), q, q, q);
    json_write_number(file, x->surfaces.lower);
    fprintf(file, ",%supper%s:", q, q);
    json_write_number(file, x->surfaces.upper);
    fputc('}', file);
    if (!has_parting(&record->answer)) return;
    fprintf(file, ",%sparting%s:", q, q);
    write_vector(file, x->parting);
}

void record_write_solid_header(FILE *file, unsigned fields) {
    int has_volumes = (fields & OVOID_RECORD_MESHES) != 0;
    fputs(has_volumes ? ",kind_a,allowance_a,mesh_volume_a,hull_volume_a,kind_b,allowance_b,mesh_volume_b,hull_volume_b"
                      : ",kind_a,allowance_a,kind_b,allowance_b",
          file);
    if (fields & OVOID_RECORD_SOLIDS) fputs(",triangle_a,triangle_b,inside", file);
}

void record_write_solid_columns(FILE *file, const ovoid_record *record) {
    const ovoid_solid_answer *x = record->solid;
    for (int side = 0; side < 2; side++) {
        const ovoid_convexity *mesh = side ? &record->mesh_b : &record->mesh_a;
        ovoid_mesh_kind kind = side ? record->kind_b : record->kind_a;
        fprintf(file, ",%s,", ovoid_mesh_kind_get_name(kind));
        if (has_allowance(kind, mesh)) record_write_column(file, mesh->allowance);
        if (!(record->fields & OVOID_RECORD_MESHES)) continue;
        fputc(',', file);
        if (isfinite(mesh->mesh_volume)) record_write_column(file, mesh->mesh_volume);
        fputc(',', file);
        if (isfinite(mesh->hull_volume)) record_write_column(file, mesh->hull_volume);
    }
    if (!(record->fields & OVOID_RECORD_SOLIDS)) return;
    fputc(',', file);
    if (x && has_triangles(record->kind_a)) fprintf(file, "%lu", (unsigned long)x->triangle_a);
    fputc(',', file);
    if (x && has_triangles(record->kind_b)) fprintf(file, "%lu", (unsigned long)x->triangle_b);
    fprintf(file, ",%s", x ? find_inside(x) : "");
}

// ---- read

static int find_kind(const char *text) {
    for (int i = 0; i < (int)(sizeof kinds / sizeof *kinds); i++)
        if (text && strcmp(kinds[i], text) == 0) return i;
    return -1;
}

// Both bodies have a kind, or neither has: hulls. Only the hull of a mesh has an allowance.
static const char *read_kinds(const json_t *line, ovoid_record *record, const char **key) {
    static const char *const keys[] = {"kind_a", "kind_b"}, *const allowances[] = {"allowance_a", "allowance_b"};
    ovoid_mesh_kind *const kinds_read[] = {&record->kind_a, &record->kind_b};
    ovoid_convexity *const meshes[] = {&record->mesh_a, &record->mesh_b};
    int has_kinds = json_object_get(line, keys[0]) || json_object_get(line, keys[1]);
    for (int i = 0; i < 2; i++) {
        const json_t *value = json_object_get(line, *key = keys[i]);
        if (has_kinds && !value) return "is missing: both bodies have a kind";
        int kind = value ? find_kind(json_string_value(value)) : OVOID_MESH_HULL;
        if (kind < 0) return "is not a kind of mesh";
        *kinds_read[i] = (ovoid_mesh_kind)kind;
        value = json_object_get(line, *key = allowances[i]);
        if (value && (kind != OVOID_MESH_HULL || !has_kinds)) return "goes with a hull";
        if (value && (!record_read_number(value, NAN, &meshes[i]->allowance) || !(meshes[i]->allowance > 0)))
            return "must be a number above 0";
    }
    return NULL;
}

// All four keys, beside kinds, or none.
static const char *read_volumes(const json_t *line, ovoid_record *record, const char **key) {
    static const char *const keys[] = {"mesh_volume_a", "mesh_volume_b", "hull_volume_a", "hull_volume_b"};
    double *const volumes[] = {&record->mesh_a.mesh_volume, &record->mesh_b.mesh_volume, &record->mesh_a.hull_volume,
                               &record->mesh_b.hull_volume};
    int present = 0;
    for (int i = 0; i < 4; i++) present += json_object_get(line, keys[i]) != NULL;
    if (!present) return NULL;
    if (!json_object_get(line, *key = "kind_a")) return "is missing: volumes come with kinds";
    for (int i = 0; i < 4; i++) {
        const json_t *value = json_object_get(line, *key = keys[i]);
        if (!value) return "is missing: volumes come together";
        if (!record_read_number(value, NAN, volumes[i])) return "must be a number or null";
    }
    record->fields |= OVOID_RECORD_MESHES;
    return NULL;
}

static const char *read_triangle(const json_t *line, ovoid_mesh_kind kind, const char *name, uint32_t *triangle,
                                 const char **key) {
    const json_t *value = json_object_get(line, name);
    double whole = 0;
    *key = name;
    if (!value != !has_triangles(kind)) return "goes with a solid or a surface";
    if (value && !record_read_whole(value, UINT32_MAX, &whole)) return "must be a whole number >= 0";
    *triangle = (uint32_t)whole;
    return NULL;
}

static ovoid_solid_inside find_inside_named(const char *text) {
    for (unsigned i = 1; text && i < sizeof insides / sizeof *insides; i++)
        if (strcmp(insides[i], text) == 0) return (ovoid_solid_inside)i;
    return OVOID_SOLID_INSIDE_NONE;
}

static const char *read_inside(const json_t *line, ovoid_solid_answer *x, const char **key) {
    const json_t *inside = json_object_get(line, "inside"), *component = json_object_get(line, "component"),
                 *common = json_object_get(line, "common");
    double whole;
    *key = "inside";
    if (!inside && !component && !common) return NULL;
    x->inside = find_inside_named(json_string_value(inside));
    if (!x->inside) return "must be \"a in b\" or \"b in a\", with a component, or \"common point\", with \"common\"";
    int is_point = x->inside == OVOID_SOLID_COMMON_POINT;
    *key = is_point ? "component" : "common";
    if (is_point ? component : common) return "does not go with what \"inside\" says";
    *key = is_point ? "common" : "component";
    if (is_point) return common && record_read_vector(common, &x->common) ? NULL : "must be three numbers";
    if (!record_read_whole(component, UINT32_MAX, &whole)) return "must be a whole number >= 0";
    x->component = (uint32_t)whole;
    return NULL;
}

static const char *read_surfaces(const json_t *json, ovoid_answer *x, const char **key) {
    const char *status = json_string_value(json_object_get(json, "status"));
    const char *limit = json_string_value(json_object_get(json, "limit"));
    int found = status ? record_find_status(status) : -1, stopped = limit ? record_find_limit(limit) : -1;
    *key = "surfaces";
    if (!json_is_object(json) || json_object_size(json) != 4 || found < 0 || stopped < 0 ||
        !record_read_number(json_object_get(json, "lower"), -INFINITY, &x->lower) ||
        !record_read_number(json_object_get(json, "upper"), INFINITY, &x->upper))
        return "must have a status, a limit, lower and upper";
    x->status = (ovoid_status)found;
    x->limit = (ovoid_limit)stopped;
    return NULL;
}

const char *record_read_solid(const json_t *line, ovoid_record *record, ovoid_solid_answer *x, const char **key) {
    const json_t *proof = json_object_get(line, "proof");
    const json_t *surfaces = json_object_get(proof, "surfaces"), *parting = json_object_get(proof, "parting");
    static const char *const own[] = {"triangle_a", "triangle_b", "inside", "component", "common"};
    const char *wrong = read_kinds(line, record, key);
    if (!wrong) wrong = read_volumes(line, record, key);
    if (wrong) return wrong;
    if (!surfaces) {
        for (int i = 0; i < 5; i++)
            if (json_object_get(line, *key = own[i])) return "goes with a proof that has \"surfaces\"";
        *key = "parting";
        return parting ? "goes with \"surfaces\"" : NULL;
    }
    *key = "kind_a";
    if (!has_triangles(record->kind_a) && !has_triangles(record->kind_b))
        return "must say what is a solid or a surface, where a proof has \"surfaces\"";
    const ovoid_answer *answer = &record->answer;
    *x = (ovoid_solid_answer){.status = answer->status,
                              .limit = answer->limit,
                              .lower = answer->lower,
                              .upper = answer->upper,
                              .surfaces = *answer};
    wrong = read_triangle(line, record->kind_a, "triangle_a", &x->triangle_a, key);
    if (!wrong) wrong = read_triangle(line, record->kind_b, "triangle_b", &x->triangle_b, key);
    // Of a compound beside a solid the deciding part.
    if (record->kind_a == OVOID_MESH_PARTS && record->part_a != OVOID_RECORD_NO_PART) x->triangle_a = record->part_a;
    if (record->kind_b == OVOID_MESH_PARTS && record->part_b != OVOID_RECORD_NO_PART) x->triangle_b = record->part_b;
    if (!wrong) wrong = read_inside(line, x, key);
    if (!wrong) wrong = read_surfaces(surfaces, &x->surfaces, key);
    if (wrong) return wrong;
    *key = "parting";
    if (!parting != !has_parting(answer)) return "goes with a lower bound of at most 0";
    if (parting && !record_read_vector(parting, &x->parting)) return "must be three numbers";
    record->solid = x;
    return NULL;
}
