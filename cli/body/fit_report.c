// The findings of ovoid fit as a report, a table, JSON lines and CSV. Numbers for programs have 17 digits; a number
// that is not finite is null in JSON and empty in CSV.
#include "body/fit.h"

#include "base/json.h"
#include "base/message.h"

#include <math.h>

static const char *const step_titles[FIT_STEPS] = {"outer", "phase 1", "phase 2", "phase 3", "inner"};
static const char *const step_keys[FIT_STEPS] = {"outer", "phase1", "phase2", "phase3", "inner"};

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

static void write_vector(FILE *file, ovoid_vec3 v) {
    const double items[] = {v.x, v.y, v.z};
    json_write_numbers(file, items, 3);
}

static void write_step_json(FILE *file, const fitted *f, int step) {
    const ovoid_fit *s = &f->steps[step];
    if (isnan(s->volume)) {
        fprintf(file, ",\"%s\":null", step_keys[step]);
        return;
    }
    fprintf(file, ",\"%s\":{\"volume\":", step_keys[step]);
    json_write_number(file, s->volume);
    fprintf(file, ",\"gap\":");
    json_write_number(file, s->gap);
    fprintf(file, ",\"center\":");
    write_vector(file, s->ellipsoid.center);
    fprintf(file, ",\"radii\":");
    write_vector(file, ovoid_ellipsoid_compute_radii(&s->ellipsoid));
    fprintf(file, ",\"iterations\":%u,\"seconds\":%.9f}", (unsigned)s->iterations, f->seconds[step]);
}

void fit_write_json(FILE *file, const fitted *f) {
    const ovoid_report *r = &f->report;
    fprintf(file, "{\"file\":");
    json_write_text(file, f->file);
    fprintf(file, ",\"name\":");
    json_write_text(file, f->name);
    fprintf(file, ",\"points\":%llu,\"vertices\":%llu,\"duplicates\":%llu,\"interior\":%llu,\"coplanar\":%llu",
            (unsigned long long)r->points, (unsigned long long)r->vertices, (unsigned long long)r->duplicates,
            (unsigned long long)r->interior, (unsigned long long)r->coplanar);
    fprintf(file,
            ",\"rank\":%u,\"facets\":%u,\"triangles\":%u,\"radius\":%.17g,\"outside\":%.17g,\"inside\":%.17g,"
            "\"volume\":%.17g,\"area\":%.17g",
            (unsigned)r->rank, (unsigned)f->facets, (unsigned)f->triangles, f->radius, f->allowance.outside,
            f->allowance.inside, f->measures.volume, f->measures.area);
    fprintf(file, ",\"mesh_kind\":\"%s\",\"mesh_volume\":", ovoid_mesh_kind_get_name(f->convexity.kind));
    json_write_number(file, f->convexity.mesh_volume);
    for (int i = 0; i < FIT_STEPS; i++) write_step_json(file, f, i);
    fprintf(file, ",\"read_seconds\":%.9f,\"make_seconds\":%.9f,\"output\":", f->read_seconds, f->make_seconds);
    if (f->output)
        json_write_text(file, f->output);
    else
        fputs("null", file);
    fputs("}\n", file);
}

void fit_write_csv_title(FILE *file) {
    fprintf(file, "file,name,points,vertices,duplicates,interior,coplanar,rank,facets,triangles,radius,outside,inside,"
                  "volume,area,mesh_kind,mesh_volume");
    for (int i = 0; i < FIT_STEPS; i++)
        fprintf(file, ",%s_volume,%s_gap,%s_radius1,%s_radius2,%s_radius3,%s_seconds", step_keys[i], step_keys[i],
                step_keys[i], step_keys[i], step_keys[i], step_keys[i]);
    fprintf(file, ",read_seconds,make_seconds,output\n");
}

/// Writes a comma and a number, or nothing after the comma where it is not finite.
static void write_column(FILE *file, double number) {
    fputc(',', file);
    if (isfinite(number)) fprintf(file, "%.17g", number);
}

void fit_write_csv_row(FILE *file, const fitted *f) {
    const ovoid_report *r = &f->report;
    ovoid_text_write_csv(file, f->file);
    fputc(',', file);
    ovoid_text_write_csv(file, f->name);
    fprintf(file, ",%llu,%llu,%llu,%llu,%llu,%u,%u,%u", (unsigned long long)r->points, (unsigned long long)r->vertices,
            (unsigned long long)r->duplicates, (unsigned long long)r->interior, (unsigned long long)r->coplanar,
            (unsigned)r->rank, (unsigned)f->facets, (unsigned)f->triangles);
    write_column(file, f->radius);
    write_column(file, f->allowance.outside);
    write_column(file, f->allowance.inside);
    write_column(file, f->measures.volume);
    write_column(file, f->measures.area);
    fprintf(file, ",%s", ovoid_mesh_kind_get_name(f->convexity.kind));
    write_column(file, f->convexity.mesh_volume);
    for (int i = 0; i < FIT_STEPS; i++) {
        int none = isnan(f->steps[i].volume);
        ovoid_vec3 radii = ovoid_ellipsoid_compute_radii(&f->steps[i].ellipsoid);
        write_column(file, f->steps[i].volume);
        write_column(file, f->steps[i].gap);
        write_column(file, none ? NAN : radii.x);
        write_column(file, none ? NAN : radii.y);
        write_column(file, none ? NAN : radii.z);
        write_column(file, none ? NAN : f->seconds[i]);
    }
    write_column(file, f->read_seconds);
    write_column(file, f->make_seconds);
    fputc(',', file);
    if (f->output) ovoid_text_write_csv(file, f->output);
    fputc('\n', file);
}
