// The output of ovoid decompose: the report, JSON, CSV, and the parts as an OBJ file.
#include "base/args.h"
#include "base/finish.h"
#include "base/message.h"
#include "body/decompose.h"
#include "io/fields.h"

#include <string.h>

static size_t count_vertices(const decomposed *d) {
    size_t count = 0;
    for (size_t i = 0; i < d->view.part_count; i++) count += ovoid_shape_get_polytope(d->view.parts[i]).vertex_count;
    return count;
}

static double sum_volumes(const decomposed *d) {
    double sum = 0;
    for (size_t i = 0; i < d->view.part_count; i++) sum += ovoid_shape_get_measures(d->view.parts[i]).volume;
    return sum;
}

// ---- for people

static void print_length(FILE *file, const char *title, const ovoid_decomposition_length *l, const char *unit) {
    fprintf(file, "%-11s ", title);
    if (l->lower > 0)
        fprintf(file, "%.6g .. ", l->lower);
    else
        fprintf(file, "at most ");
    fprintf(file, "%.6g%s%s", l->upper, *unit ? " " : "", unit);
    if (l->lower > 0) fprintf(file, "; at (%.6g, %.6g, %.6g), part %u", l->point.x, l->point.y, l->point.z, l->part);
    fputc('\n', file);
}

void decomposed_write_text(FILE *file, const decomposed *d) {
    ovoid_solid_report r = ovoid_solid_get_report(d->view.solid);
    const ovoid_decomposition_proof *p = &d->proof;
    fprintf(file, "%-11s ", "solid");
    message_write_text(file, d->path);
    fprintf(file, "; triangles: %llu; components: %llu; volume: %.6g\n", (unsigned long long)r.triangles,
            (unsigned long long)r.components, r.volume);
    fprintf(file, "%-11s %zu; vertices: %zu; volumes: %.6g\n", "parts", d->view.part_count, count_vertices(d),
            sum_volumes(d));
    if (d->is_grown)
        fprintf(file, "%-11s 0; the parts were grown by %.6g, which suffices\n", "uncovered", d->grown);
    else
        print_length(file, "uncovered", &p->uncovered, d->unit);
    print_length(file, "excess", &p->excess, d->unit);
    fprintf(file, "%-11s parts D > 0 apart: the solid is apart by at least D - %.6g, at most D + %.6g\n", "so",
            p->uncovered.upper, p->excess.upper);
    fprintf(file, "%-11s parts that overlap prove only that the solid is within %.6g\n", "", p->excess.upper);
}

// ---- JSON, CSV

static void write_field(FILE *file, const char *name, double number) {
    fprintf(file, ",\"%s\":", name);
    json_write_number(file, number);
}

static void write_length(FILE *file, const char *name, const ovoid_decomposition_length *l) {
    fprintf(file, ",\"%s\":{\"lower\":", name);
    json_write_number(file, l->lower);
    write_field(file, "upper", l->upper);
    if (l->lower > 0) {
        fprintf(file, ",\"point\":[%.17g,%.17g,%.17g],\"part\":%u", l->point.x, l->point.y, l->point.z, l->part);
    }
    fputc('}', file);
}

void decomposed_write_json(FILE *file, const decomposed *d) {
    ovoid_solid_report r = ovoid_solid_get_report(d->view.solid);
    fputs("{\"mesh\":", file);
    ovoid_text_write_json(file, d->path);
    if (*d->unit) {
        fputs(",\"unit\":", file);
        ovoid_text_write_json(file, d->unit);
    }
    fprintf(file, ",\"triangles\":%llu", (unsigned long long)r.triangles);
    write_field(file, "volume", r.volume);
    fprintf(file, ",\"parts\":%zu,\"vertices\":%zu", d->view.part_count, count_vertices(d));
    write_field(file, "parts_volume", sum_volumes(d));
    if (d->is_grown) write_field(file, "grown", d->grown);
    write_length(file, "uncovered", &d->proof.uncovered);
    write_length(file, "excess", &d->proof.excess);
    fputs(",\"excess_of_parts\":[", file);
    for (size_t i = 0; i < d->view.part_count; i++) {
        if (i) fputc(',', file);
        json_write_number(file, d->excess[i]);
    }
    fprintf(file, "],\"cells\":%zu}\n", d->proof.cells);
}

void decomposed_write_csv(FILE *file, const decomposed *d) {
    ovoid_solid_report r = ovoid_solid_get_report(d->view.solid);
    const ovoid_decomposition_proof *p = &d->proof;
    fputs("mesh,triangles,volume,parts,vertices,parts_volume,grown,uncovered_lower,uncovered_upper,excess_lower,"
          "excess_upper,cells\n",
          file);
    ovoid_text_write_csv(file, d->path);
    fprintf(file, ",%llu,%.17g,%zu,%zu,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%zu\n", (unsigned long long)r.triangles,
            r.volume, d->view.part_count, count_vertices(d), sum_volumes(d), d->grown, p->uncovered.lower,
            p->uncovered.upper, p->excess.lower, p->excess.upper, p->cells);
}

// ---- the parts

/// Faces of a solid part or a flat one; a segment or a point as a triangle that uses points twice.
static void write_part(FILE *file, const ovoid_shape *shape, size_t number, size_t first) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    fprintf(file, "o part_%zu\n", number);
    for (uint32_t i = 0; i < p.vertex_count; i++) {
        const double *v = p.vertices + 3 * (size_t)i;
        fprintf(file, "v %.17g %.17g %.17g\n", p.origin.x + v[0], p.origin.y + v[1], p.origin.z + v[2]);
    }
    for (uint32_t t = 0; t < p.triangle_count; t++) {
        const uint32_t *c = p.triangles + 3 * (size_t)t;
        fprintf(file, "f %zu %zu %zu\n", first + c[0], first + c[1], first + c[2]);
    }
    if (p.triangle_count == 0) fprintf(file, "f %zu %zu %zu\n", first, first + p.vertex_count - 1, first);
}

static void write_parts(FILE *file, const decomposed *d) {
    fprintf(file, "# %zu convex parts. Uncovered by them at most %.17g; standing out of the solid at most %.17g.\n",
            d->view.part_count, d->proof.uncovered.upper, d->proof.excess.upper);
    size_t first = 1;
    for (size_t i = 0; i < d->view.part_count; i++) {
        write_part(file, d->view.parts[i], i, first);
        first += ovoid_shape_get_polytope(d->view.parts[i]).vertex_count;
    }
}

/// A function that writes a file of a decomposition.
typedef void (*writer)(FILE *file, const decomposed *d);

static int write_file(const char *path, const decomposed *d, writer write) {
    ovoid_output *output = finish_open(path);
    if (!output) return EXIT_INPUT;
    write(ovoid_output_get_file(output), d);
    return finish_close(output, 0);
}

int decomposed_write_parts(const char *path, const decomposed *d) {
    for (size_t i = 0; i < d->view.part_count; i++)
        if (ovoid_shape_get_radius(d->view.parts[i]) > 0) {
            message_error("part %zu has a rounding radius, which an OBJ file cannot say", i);
            return EXIT_INPUT;
        }
    return write_file(path, d, write_parts);
}

// ---- the proof

static void write_proof(FILE *file, const decomposed *d) {
    (void)ovoid_decomposition_write_json(file, &d->view, &d->found); // the stream keeps its error state
}

int decomposed_write_proof(const char *path, const decomposed *d) {
    enum { ROUNDS = 12 };
    decomposed checked = *d;
    ovoid_error error;
    ovoid_decomposition_options options = {.work = DECOMPOSED_CHECK_WORK / 8};
    double step = 1e-3 * (d->found.uncovered.upper + d->found.excess.upper);
    ovoid_code code = OVOID_ERROR_LIMIT;
    for (int round = 0; round < ROUNDS && code == OVOID_ERROR_LIMIT; round++, step *= 2) {
        code = ovoid_decomposition_verify(&d->view, &checked.found, &options, &error);
        if (code != OVOID_ERROR_LIMIT) break;
        // A search may happen to end below its target; then the check would need more cells.
        int is_excess = strncmp(error.message, "excess", 6) == 0;
        *(is_excess ? &checked.found.excess.upper : &checked.found.uncovered.upper) += step;
    }
    if (code) return message_error("%s: the proof could not be written: %s", path, error.message), EXIT_INPUT;
    return write_file(path, &checked, write_proof);
}
