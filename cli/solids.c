// Pairs of which one body at least is a solid: reading it, the answer and its report.
#include "solids.h"

#include "json.h"
#include "message.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// ---- polygons

typedef struct vector {
    double x, y, z;
} vector;

static vector get_difference(const double *a, const double *b) {
    return (vector){a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
static vector get_normal(const double *xyz, uint32_t a, uint32_t b, uint32_t c) {
    vector u = get_difference(xyz + 3 * (size_t)b, xyz + 3 * (size_t)a);
    vector v = get_difference(xyz + 3 * (size_t)c, xyz + 3 * (size_t)a);
    return (vector){u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

/// The corner from which a polygon is cut into triangles that all face the same way; size where there is none.
static uint32_t find_apex(const double *xyz, const uint32_t *face, uint32_t size) {
    vector n = {0, 0, 0};
    for (uint32_t i = 1; i + 1 < size; i++) {
        vector t = get_normal(xyz, face[0], face[i], face[i + 1]);
        n = (vector){n.x + t.x, n.y + t.y, n.z + t.z};
    }
    double least = -1e-12 * (n.x * n.x + n.y * n.y + n.z * n.z);
    for (uint32_t apex = 0; apex < size; apex++) {
        uint32_t i = 1;
        for (; i + 1 < size; i++) {
            vector t = get_normal(xyz, face[apex], face[(apex + i) % size], face[(apex + i + 1) % size]);
            if (!(t.x * n.x + t.y * n.y + t.z * n.z >= least)) break;
        }
        if (i + 1 >= size) return apex;
    }
    return size;
}

static uint32_t *cut_polygons(const char *path, const ovoid_faces *faces, size_t *count, ovoid_error *error) {
    size_t room = 0;
    for (size_t f = 0; f < faces->face_count; f++) room += faces->sizes[f] - 2;
    uint32_t *triangles = malloc((3 * room + 1) * sizeof *triangles);
    *count = 0;
    if (!triangles) snprintf(error->message, sizeof error->message, "out of memory");
    const uint32_t *face = faces->indices;
    for (size_t f = 0; f < faces->face_count && triangles; face += faces->sizes[f++]) {
        uint32_t size = faces->sizes[f], apex = find_apex(faces->vertices, face, size);
        if (apex == size) {
            snprintf(error->message, sizeof error->message,
                     "%.150s: face %zu cannot be cut into triangles from one of its corners: triangulate the mesh",
                     path, f);
            free(triangles);
            return NULL;
        }
        for (uint32_t i = 1; i + 1 < size; i++) {
            uint32_t *t = triangles + 3 * (*count)++;
            t[0] = face[apex];
            t[1] = face[(apex + i) % size];
            t[2] = face[(apex + i + 1) % size];
        }
    }
    return triangles;
}

ovoid_solid *solids_read(const char *path, const read_settings *settings, ovoid_error *error) {
    ovoid_read_options read = inputs_make_options(settings);
    ovoid_mesh *mesh = ovoid_mesh_read(path, &read, error);
    if (!mesh) return NULL;
    ovoid_faces faces = ovoid_mesh_get_part(mesh, 0).faces;
    ovoid_solid *solid = NULL;
    size_t count;
    if (faces.face_count == 0) {
        snprintf(error->message, sizeof error->message, "%.200s has no faces: points alone are no solid", path);
    } else {
        uint32_t *triangles = cut_polygons(path, &faces, &count, error);
        if (triangles)
            solid =
                ovoid_solid_create_from_triangles(faces.vertices, faces.vertex_count, triangles, count, NULL, error);
        free(triangles);
    }
    ovoid_mesh_destroy(mesh);
    return solid;
}

// ---- the answer

/// An answer with its proof, and whether that holds.
typedef struct solids_result {
    ovoid_solid_answer answer;
    ovoid_exclusions exclusions;
    int holds;
} solids_result;

static int find_answer(const solids_query *q, solids_result *r) {
    ovoid_options options = {.absolute_tolerance = q->tolerance};
    ovoid_error error;
    for (size_t room = 4096;; room = r->exclusions.count) {
        free(r->exclusions.items);
        r->exclusions = (ovoid_exclusions){malloc(room * sizeof(ovoid_exclusion)), room, 0, NULL};
        if (!r->exclusions.items) return 0;
        r->answer = ovoid_solid_distance(&q->pair, &options, NULL, &r->exclusions);
        if (r->exclusions.count <= room) break;
    }
    r->holds = ovoid_solid_answer_check(&q->pair, &r->answer, &r->exclusions, &error) == OVOID_OK;
    if (!r->holds) message_error("the proof does not hold: %s", error.message);
    return 1;
}

static exit_code judge(const solids_query *q, const solids_result *r) {
    const ovoid_solid_answer *x = &r->answer;
    if (!r->holds) return EXIT_NOT_PROVEN;
    ovoid_answer like = x->surfaces;
    like.status = x->status;
    like.limit = x->limit;
    like.lower = x->lower;
    like.upper = x->upper;
    return results_judge(&like, q->margin);
}

static const char *get_within(const solids_query *q, const ovoid_solid_answer *x) {
    int within = ovoid_solid_answer_is_within(x, q->margin);
    return within > 0 ? "yes" : within == 0 ? "no" : x->limit == OVOID_LIMIT_NONE ? "at" : "unproven";
}

static const char *get_inside(const ovoid_solid_answer *x) {
    return x->inside == OVOID_SOLID_A_INSIDE ? "a in b" : x->inside == OVOID_SOLID_B_INSIDE ? "b in a" : "";
}

// ---- for people

static void print_body(FILE *file, const char *title, const solids_query *q, int side) {
    const ovoid_body *body = side ? &q->pair.b : &q->pair.a;
    fprintf(file, "%-11s ", title);
    message_write_text(file, q->paths[side]);
    if (body->solid) {
        ovoid_solid_report r = ovoid_solid_get_report(body->solid);
        fprintf(file, "; %s, triangles: %llu; components: %llu", r.is_closed ? "solid" : "surface",
                (unsigned long long)r.triangles, (unsigned long long)r.components);
        if (r.is_closed) fprintf(file, "; volume: %.6g", fabs(r.volume));
    } else {
        fprintf(file, "; hull, vertices: %llu", (unsigned long long)ovoid_shape_get_report(body->shape).vertices);
    }
    fputc('\n', file);
}

static void print_vector(FILE *file, const char *title, ovoid_vec3 v, const char *unit) {
    fprintf(file, "%-11s %.9g %.9g %.9g%s\n", title, v.x, v.y, v.z, unit);
}

static void print_report(FILE *file, const solids_query *q, const solids_result *r) {
    const ovoid_solid_answer *x = &r->answer;
    char unit[8], text[64];
    snprintf(unit, sizeof unit, "%s%s", q->unit[0] ? " " : "", q->unit);
    print_body(file, "a", q, 0);
    print_body(file, "b", q, 1);
    fprintf(file, "%-11s %s\n", "status", ovoid_status_get_name(x->status));
    ovoid_answer shown = {.status = x->status, .lower = x->lower, .upper = x->upper};
    int is_depth = x->upper < 0;
    if (is_depth) shown.lower = -x->upper, shown.upper = -x->lower;
    (void)ovoid_answer_write_distance(text, &shown);
    fprintf(file, "%-11s %s%s\n", is_depth ? "depth" : "distance", text, unit);
    fprintf(file, "%-11s %.17g .. %.17g%s\n", "bracket", x->lower, x->upper, unit);
    if (q->margin >= 0) fprintf(file, "%-11s %.9g%s: within: %s\n", "margin", q->margin, unit, get_within(q, x));
    if (q->pair.a.solid) fprintf(file, "%-11s %u of a\n", "triangle", (unsigned)x->triangle_a);
    if (q->pair.b.solid) fprintf(file, "%-11s %u of b\n", "triangle", (unsigned)x->triangle_b);
    if (x->inside) fprintf(file, "%-11s %s\n", "inside", get_inside(x));
    print_vector(file, "point on a", x->surfaces.point_a, unit);
    print_vector(file, "point on b", x->surfaces.point_b, unit);
    print_vector(file, "normal", x->surfaces.normal, "");
    if (x->limit != OVOID_LIMIT_NONE) fprintf(file, "%-11s %s\n", "stopped by", ovoid_limit_get_name(x->limit));
    fprintf(file, "%-11s %s; exclusions: %zu; %s\n", "proof", ovoid_proof_kind_get_name(x->surfaces.proof.kind),
            r->exclusions.count, r->holds ? "checked" : "DOES NOT HOLD");
}

// ---- for programs

static void write_numbers(FILE *file, const char *key, ovoid_vec3 v) {
    fprintf(file, ",\"%s\":[", key);
    json_write_number(file, v.x);
    fputc(',', file);
    json_write_number(file, v.y);
    fputc(',', file);
    json_write_number(file, v.z);
    fputc(']', file);
}

static void write_number(FILE *file, const char *key, double number) {
    fprintf(file, ",\"%s\":", key);
    json_write_number(file, number);
}

static void write_json_body(FILE *file, const char *key, const solids_query *q, int side) {
    const ovoid_body *body = side ? &q->pair.b : &q->pair.a;
    const char *kind = !body->solid ? "hull" : ovoid_solid_get_report(body->solid).is_closed ? "solid" : "surface";
    fprintf(file, "\"%s\":", key);
    json_write_text(file, q->paths[side]);
    fprintf(file, ",\"kind_%s\":\"%s\"", key, kind);
    fprintf(file, ",\"mesh_volume_%s\":", key);
    json_write_number(file, q->convexity[side].mesh_volume);
    fprintf(file, ",\"hull_volume_%s\":", key);
    json_write_number(file, q->convexity[side].hull_volume);
}

static void write_json(FILE *file, const solids_query *q, const solids_result *r) {
    const ovoid_solid_answer *x = &r->answer;
    fputc('{', file);
    write_json_body(file, "a", q, 0);
    fputc(',', file);
    write_json_body(file, "b", q, 1);
    fprintf(file, ",\"status\":\"%s\",\"limit\":\"%s\"", ovoid_status_get_name(x->status),
            ovoid_limit_get_name(x->limit));
    if (q->margin >= 0) {
        write_number(file, "margin", q->margin);
        fprintf(file, ",\"within\":\"%s\"", get_within(q, x));
    }
    write_number(file, "lower", x->lower);
    write_number(file, "upper", x->upper);
    write_numbers(file, "point_a", x->surfaces.point_a);
    write_numbers(file, "point_b", x->surfaces.point_b);
    write_numbers(file, "normal", x->surfaces.normal);
    fprintf(file, ",\"triangle_a\":%u,\"triangle_b\":%u,\"inside\":\"%s\"", (unsigned)x->triangle_a,
            (unsigned)x->triangle_b, get_inside(x));
    fprintf(file, ",\"checked\":%s}\n", r->holds ? "true" : "false");
}

static void write_csv_text(FILE *file, const char *text) {
    fputc('"', file);
    for (; *text; text++) fprintf(file, *text == '"' ? "\"%c" : "%c", *text);
    fputc('"', file);
}

static void write_csv(FILE *file, const solids_query *q, const solids_result *r) {
    const ovoid_solid_answer *x = &r->answer;
    const ovoid_answer *s = &x->surfaces;
    fputs("a,kind_a,b,kind_b,status,limit,lower,upper,ax,ay,az,bx,by,bz,nx,ny,nz,triangle_a,triangle_b,inside\n", file);
    for (int side = 0; side < 2; side++) {
        const ovoid_solid *solid = side ? q->pair.b.solid : q->pair.a.solid;
        write_csv_text(file, q->paths[side]);
        fprintf(file, ",%s,", !solid ? "hull" : ovoid_solid_get_report(solid).is_closed ? "solid" : "surface");
    }
    fprintf(file, "%s,%s,%.17g,%.17g", ovoid_status_get_name(x->status), ovoid_limit_get_name(x->limit), x->lower,
            x->upper);
    const ovoid_vec3 all[3] = {s->point_a, s->point_b, s->normal};
    for (int i = 0; i < 3; i++) fprintf(file, ",%.17g,%.17g,%.17g", all[i].x, all[i].y, all[i].z);
    fprintf(file, ",%u,%u,%s\n", (unsigned)x->triangle_a, (unsigned)x->triangle_b, get_inside(x));
}

int solids_answer(const solids_query *q, const output_settings *out) {
    solids_result r = {.exclusions.items = NULL};
    cli_results results;
    if (!find_answer(q, &r)) {
        message_error("out of memory");
        return EXIT_INPUT;
    }
    // The header and the line are ours.
    output_settings settings = *out;
    settings.csv = settings.proofs = 0;
    int code = (int)judge(q, &r);
    if (!results_open(&results, &settings, 0, q->unit)) {
        if (out->json)
            write_json(results.file, q, &r);
        else if (out->csv)
            write_csv(results.file, q, &r);
        else
            print_report(results.file, q, &r);
        code = results_close(&results, code);
    } else {
        code = EXIT_INPUT;
    }
    free(r.exclusions.items);
    return code;
}
