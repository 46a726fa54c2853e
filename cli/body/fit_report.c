// The findings of ovoid fit as a report, a table, JSON lines and CSV. Numbers for programs have 17 digits; a number
// that is not finite is null in JSON and empty in CSV.
#include "body/fit.h"

#include "base/message.h"
#include "io/fields.h"

#include <math.h>

static const char *const step_titles[FIT_STEPS] = {"outer", "phase 1", "phase 2", "phase 3", "inner"};
static const char *const step_keys[FIT_STEPS] = {"outer", "phase1", "phase2", "phase3", "inner"};

/// 1 if the allowance is along an axis.
static int has_axis(const fitted *f) {
    const ovoid_vec3 axis = f->allowance.axis;
    return fabs(axis.x) + fabs(axis.y) + fabs(axis.z) > 0;
}

static const char *get_rank_name(uint32_t rank) {
    static const char *const names[] = {"a point", "a segment", "flat", "solid"};
    return rank < 4 ? names[rank] : "?";
}

/// The name of the measure of a body of that rank.
static const char *get_measure_name(uint32_t rank) { return rank == 3 ? "volume" : rank == 2 ? "area" : "length"; }

/* ---- for people ---- */

/// Writes one step: its volume, as a share of the body's, its gap, radii and time.
static void write_step(FILE *file, const fitted *f, int step) {
    const ovoid_fit *s = &f->steps[step];
    ovoid_vec3 radii = ovoid_ellipsoid_compute_radii(&s->ellipsoid);
    char share[16] = "-", gap[16] = "-", sizes[64];
    if (isnan(s->volume)) return;
    if (f->measure > 0) snprintf(share, sizeof share, "%.4f", s->volume / f->measure);
    if (!isnan(s->gap)) snprintf(gap, sizeof gap, "%.1e", s->gap);
    snprintf(sizes, sizeof sizes, "%.6g %.6g %.6g", radii.x, radii.y, radii.z);
    fprintf(file, "  %-8s %-12.6g %8s  %-8s %-34s %8.3f ms\n", step_titles[step], s->volume, share, gap, sizes,
            1e3 * f->seconds[step]);
}

/// Writes file and part.
static void write_name(FILE *file, const fitted *f) {
    message_write_text(file, f->file);
    if (*f->name) fputs(": ", file);
    message_write_text(file, f->name);
    fputc('\n', file);
}

void fit_write_report(FILE *file, const fitted *f) {
    const ovoid_report *r = &f->report;
    const ovoid_measures *m = &f->measures;
    write_name(file, f);
    if (f->unit[0]) fprintf(file, "  unit     %s\n", f->unit);
    fprintf(file, "  points   %llu given: %llu vertices, %llu duplicates, %llu interior (%llu of them on a face)\n",
            (unsigned long long)r->points, (unsigned long long)r->vertices, (unsigned long long)r->duplicates,
            (unsigned long long)r->interior, (unsigned long long)r->coplanar);
    fprintf(file, "  hull     %s, %u facets of %u triangles\n", get_rank_name(r->rank), (unsigned)f->facets,
            (unsigned)f->triangles);
    if (f->measure > 0) fprintf(file, "  %-8s %.9g\n", get_measure_name(r->rank), f->measure);
    if (f->convexity.mesh_volume >= 0 && r->rank == 3 && m->volume > 0)
        fprintf(file, "  mesh     %.9g enclosed, %.4g %% of the hull\n", f->convexity.mesh_volume,
                100 * f->convexity.mesh_volume / m->volume);
    if (f->convexity.kind != OVOID_MESH_HULL)
        fprintf(file, "  mesh     a %s: all that is said here is of its hull\n",
                ovoid_mesh_kind_get_name(f->convexity.kind));
    if (r->rank == 3) fprintf(file, "  surface  %.9g\n", m->area);
    fprintf(file, "  box      %.6g x %.6g x %.6g\n", m->box.max.x - m->box.min.x, m->box.max.y - m->box.min.y,
            m->box.max.z - m->box.min.z);
    if (f->radius > 0) fprintf(file, "  rounding radius %.9g (not part of the measures)\n", f->radius);
    if (f->allowance.outside > 0 || f->allowance.inside > 0)
        fprintf(file, "  allowance %.9g outside, %.9g inside\n", f->allowance.outside, f->allowance.inside);
    const ovoid_vec3 axis = f->allowance.axis;
    if (has_axis(f)) fprintf(file, "  axis     (%.9g, %.9g, %.9g): nothing outside along it\n", axis.x, axis.y, axis.z);
    if (f->is_lean) fputs("  lean     an inner ellipsoid of the moments, no table of supports, no Gauss map\n", file);
    fprintf(file, "\n  %-8s %-12s %8s  %-8s %-34s %8s\n", "", get_measure_name(r->rank), "of body", "gap", "radii",
            "time");
    for (int i = 0; i < FIT_STEPS; i++) write_step(file, f, i);
    fprintf(file, "\n  read in %.3f ms, made into a shape in %.3f ms\n", 1e3 * f->read_seconds, 1e3 * f->make_seconds);
    if (!f->output) return;
    fputs("  written to ", file);
    message_write_text(file, f->output);
    fputc('\n', file);
}

void fit_write_table_title(FILE *file, const char *unit) {
    char volume[16];
    snprintf(volume, sizeof volume, "volume%s%.4s%s", unit[0] ? "/" : "", unit, unit[0] ? "3" : "");
    fprintf(file, "%8s %8s %6s  %-9s %-12s", "points", "vertices", "facets", "hull", volume);
    for (int i = 0; i < FIT_STEPS; i++) fprintf(file, " %8s", step_titles[i]);
    fprintf(file, " %9s  %s\n", "time/ms", "body");
}

void fit_write_table_row(FILE *file, const fitted *f) {
    fprintf(file, "%8llu %8llu %6u  %-9s %-12.6g", (unsigned long long)f->report.points,
            (unsigned long long)f->report.vertices, (unsigned)f->facets, get_rank_name(f->report.rank), f->measure);
    for (int i = 0; i < FIT_STEPS; i++) {
        if (f->measure > 0 && !isnan(f->steps[i].volume))
            fprintf(file, " %8.4f", f->steps[i].volume / f->measure);
        else
            fprintf(file, " %8s", "-");
    }
    fprintf(file, " %9.3f  ", 1e3 * f->make_seconds);
    write_name(file, f);
}

/* ---- for programs ---- */

static const char *name_kind(int kind) { return ovoid_mesh_kind_get_name((ovoid_mesh_kind)kind); }
static const field_names kinds = {name_kind, OVOID_MESH_HULL, OVOID_MESH_SURFACE};

#define FIT(member) FIELD_AT(fitted, member), .column = FIELD_COLUMN
static const field body_fields[] = {
    {"file", FIELD_TEXT, FIT(file)},
    {"name", FIELD_TEXT, FIT(name)},
    {"points", FIELD_WHOLE, FIT(report.points)},
    {"vertices", FIELD_WHOLE, FIT(report.vertices)},
    {"duplicates", FIELD_WHOLE, FIT(report.duplicates)},
    {"interior", FIELD_WHOLE, FIT(report.interior)},
    {"coplanar", FIELD_WHOLE, FIT(report.coplanar)},
    {"rank", FIELD_WHOLE, FIT(report.rank)},
    {"facets", FIELD_WHOLE, FIT(facets)},
    {"triangles", FIELD_WHOLE, FIT(triangles)},
    {"radius", FIELD_MEASURE, FIT(radius)},
    {"outside", FIELD_MEASURE, FIT(allowance.outside)},
    {"inside", FIELD_MEASURE, FIT(allowance.inside)},
    {"axis", FIELD_VECTOR, FIT(allowance.axis), .bit = FIELD_NOT_ZERO},
    {"lean", FIELD_FLAG, FIT(is_lean), .bit = FIELD_NOT_ZERO},
    {"volume", FIELD_MEASURE, FIT(measures.volume)},
    {"area", FIELD_MEASURE, FIT(measures.area)},
    {"mesh_kind", FIELD_NAME, FIT(convexity.kind), .names = &kinds},
    {"mesh_volume", FIELD_MEASURE, FIT(convexity.mesh_volume)},
};
static const field_table body_table = FIELD_TABLE(fitted, body_fields);

static const field time_fields[] = {
    {"read_seconds", FIELD_SECONDS, FIT(read_seconds)},
    {"make_seconds", FIELD_SECONDS, FIT(make_seconds)},
    {"output", FIELD_TEXT, FIT(output)},
};
static const field_table time_table = FIELD_TABLE(fitted, time_fields);

/// A step's ellipsoid.
typedef struct step_row {
    double volume, gap, radius[3], seconds;
    ovoid_vec3 center;
    uint32_t iterations;
} step_row;

#define STEP(member) FIELD_AT(step_row, member)
static const field step_fields[] = {
    {"volume", FIELD_MEASURE, STEP(volume), .column = FIELD_COLUMN},
    {"gap", FIELD_MEASURE, STEP(gap), .column = FIELD_COLUMN},
    {"center", FIELD_VECTOR, STEP(center)},
    {"radii", FIELD_VECTOR, STEP(radius)},
    {"radius1", FIELD_MEASURE, STEP(radius[0]), .column = FIELD_COLUMN, .bit = 1},
    {"radius2", FIELD_MEASURE, STEP(radius[1]), .column = FIELD_COLUMN, .bit = 1},
    {"radius3", FIELD_MEASURE, STEP(radius[2]), .column = FIELD_COLUMN, .bit = 1},
    {"iterations", FIELD_WHOLE, STEP(iterations)},
    {"seconds", FIELD_SECONDS, STEP(seconds), .column = FIELD_COLUMN},
};
static const field_table step_table = FIELD_TABLE(step_row, step_fields);

static step_row make_step(const fitted *f, int step) {
    const ovoid_fit *s = &f->steps[step];
    if (isnan(s->volume)) return (step_row){s->volume, s->gap, {NAN, NAN, NAN}, NAN, {0, 0, 0}, 0};
    ovoid_vec3 radii = ovoid_ellipsoid_compute_radii(&s->ellipsoid);
    return (step_row){s->volume,           s->gap,       {radii.x, radii.y, radii.z}, f->seconds[step],
                      s->ellipsoid.center, s->iterations};
}

void fit_write_json(FILE *file, const fitted *f) {
    fields_write_members(file, "\"", "{", (fields_item){&body_table, f, 0});
    for (int i = 0; i < FIT_STEPS; i++) {
        const step_row step = make_step(f, i);
        fprintf(file, ",\"%s\":", step_keys[i]);
        if (isnan(step.volume))
            fputs("null", file);
        else
            fields_write_json(file, "\"", (fields_item){&step_table, &step, 0});
    }
    fields_write_members(file, "\"", ",", (fields_item){&time_table, f, 0});
    fputs("}\n", file);
}

void fit_write_csv_title(FILE *file) {
    fields_write_csv_header(file, "", &body_table, FIELD_COLUMN);
    for (int i = 0; i < FIT_STEPS; i++)
        for (const field *column = step_fields; column < step_fields + step_table.count; column++)
            if (column->column) fprintf(file, ",%s_%s", step_keys[i], column->key);
    fields_write_csv_header(file, ",", &time_table, FIELD_COLUMN);
    fputc('\n', file);
}

void fit_write_csv_row(FILE *file, const fitted *f) {
    fields_write_csv(file, "", (fields_item){&body_table, f, 0}, FIELD_COLUMN);
    for (int i = 0; i < FIT_STEPS; i++) {
        const step_row step = make_step(f, i);
        fields_write_csv(file, ",", (fields_item){&step_table, &step, 1}, FIELD_COLUMN);
    }
    fields_write_csv(file, ",", (fields_item){&time_table, f, 0}, FIELD_COLUMN);
    fputc('\n', file);
}
