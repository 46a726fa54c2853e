// The contacts of a pair as lines below its row of a table: of each its axis, normal, area and bracket, then its
// points.
#include "io/results/record.h"
#include "io/text.h"

#include <math.h>

static void write_number(FILE *file, double value, int digits) {
    char text[32];
    number_write(text, value, digits);
    fputs(text, file);
}

static void write_vector(FILE *file, ovoid_vec3 v) {
    const double x[3] = {v.x, v.y, v.z};
    for (int k = 0; k < 3; k++) {
        fputc(' ', file);
        // What is only rounding beside a unit vector, or beside lengths of that size, is no news to people.
        write_number(file, fabs(x[k]) < 1e-15 ? 0 : x[k], 6);
    }
}

/// What stays the same while a corner does: the vertex, or the two edges.
static void write_id(FILE *file, uint32_t id) {
    const unsigned long index = id & ~OVOID_MANIFOLD_KIND;
    switch (id & OVOID_MANIFOLD_KIND) {
    case OVOID_MANIFOLD_ID_VERTEX_A: fprintf(file, "vertex %lu of a", index); break;
    case OVOID_MANIFOLD_ID_VERTEX_B: fprintf(file, "vertex %lu of b", index); break;
    case OVOID_MANIFOLD_ID_CROSSING: fprintf(file, "edges %lu and %lu", index >> 15, index & 0x7fff); break;
    default: fputs("nearest points", file); break;
    }
}

static void write_area(FILE *file, const ovoid_record_contact *c) {
    if (!(c->manifold.corners > 2 && c->outer > 0)) return;
    fputs(", area ", file);
    write_number(file, c->inner, 6);
    // An area that is known to six digits is one number.
    if (c->outer - c->inner <= 1e-6 * c->outer) return;
    fputs(" .. ", file);
    write_number(file, c->outer, 6);
}

static void write_contact(FILE *file, const ovoid_record *record, const ovoid_record_contact *c) {
    char distance[64];
    const ovoid_answer bracket = {.status = c->manifold.status, .lower = c->manifold.lower, .upper = c->manifold.upper};
    ovoid_answer_write_distance(distance, &bracket);
    fprintf(file, "  contact by %s, distance %s, normal", ovoid_manifold_axis_get_name(c->manifold.axis), distance);
    write_vector(file, c->manifold.normal);
    write_area(file, c);
    if (record->part_a != OVOID_RECORD_NO_PART) fprintf(file, ", part %lu of a", (unsigned long)c->part_a);
    if (record->part_b != OVOID_RECORD_NO_PART) fprintf(file, ", part %lu of b", (unsigned long)c->part_b);
    fputc('\n', file);
    for (const ovoid_manifold_point *p = c->points; p < c->points + c->point_count; p++) {
        fputs("    at", file);
        write_vector(file, p->point_a);
        fputs(", separation ", file);
        write_number(file, p->separation, 6);
        fputs(", ", file);
        write_id(file, p->id);
        fputc('\n', file);
    }
}

ovoid_code ovoid_record_write_contacts(FILE *file, const ovoid_record *record) {
    for (size_t i = 0; i < record->contact_count; i++) write_contact(file, record, &record->contacts[i]);
    if (record->fields & OVOID_RECORD_CONTACTS && record->contact_limit != OVOID_LIMIT_NONE)
        fprintf(file, "  no contacts (%s): two solids or surfaces have none\n",
                ovoid_limit_get_name(record->contact_limit));
    return ferror(file) ? OVOID_ERROR_FILE : OVOID_OK;
}
