// The report of a solid's triangles: closed or not, connected components, duplicates, triangles without area.
//
// Edges: solid/edges.c. Components: union by points (B. A. Galler, M. J. Fischer, An improved equivalence algorithm,
// 1964).
#include "base/allocator.h"
#include "linear/dd3.h"
#include "polytope/sort.h"
#include "solid/edges.h"
#include "solid/solid.h"

// Room for sorting three entries a triangle.
typedef struct room {
    sort_entry *entries, *scratch;
} room;

static uint64_t make_key(uint32_t a, uint32_t b) { return (uint64_t)a << 32 | b; }

static void sort_points(uint32_t p[3]) {
    for (int i = 0; i < 3; i++) {
        int k = i % 2;
        if (p[k] <= p[k + 1]) continue;
        uint32_t kept = p[k];
        p[k] = p[k + 1];
        p[k + 1] = kept;
    }
}

// Counts duplicates: triangles are sorted by their two least points first, then, stably, by the greatest.
static void count_duplicates(const solid_parts *p, room *r, ovoid_solid_report *report) {
    for (int pass = 0; pass < 2; pass++) {
        for (uint32_t i = 0; i < p->triangle_count; i++) {
            uint32_t t = pass ? r->entries[i].index : i;
            uint32_t q[3] = {p->triangles[t].point[0], p->triangles[t].point[1], p->triangles[t].point[2]};
            sort_points(q);
            r->entries[i] = (sort_entry){pass ? make_key(q[0], q[1]) : q[2], t};
        }
        sort_entries(r->entries, r->scratch, p->triangle_count);
    }
    uint32_t last[3] = {UINT32_MAX, UINT32_MAX, UINT32_MAX};
    for (uint32_t i = 0; i < p->triangle_count; i++) {
        const uint32_t *own = p->triangles[r->entries[i].index].point;
        uint32_t q[3] = {own[0], own[1], own[2]};
        sort_points(q);
        report->duplicates += q[0] == last[0] && q[1] == last[1] && q[2] == last[2];
        for (int k = 0; k < 3; k++) last[k] = q[k];
    }
}

static uint32_t find_root(uint32_t *parent, uint32_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
}

static uint32_t find_components(const solid_parts *p, uint32_t *parent) {
    for (uint32_t i = 0; i < p->point_count; i++) parent[i] = i;
    for (uint32_t t = 0; t < p->triangle_count; t++)
        for (int i = 1; i < 3; i++) {
            uint32_t a = find_root(parent, p->triangles[t].point[0]), b = find_root(parent, p->triangles[t].point[i]);
            // Joined under the lower index, so the order of the triangles does not matter.
            parent[a > b ? a : b] = a > b ? b : a;
        }
    uint32_t count = 0;
    for (uint32_t i = 0; i < p->point_count; i++)
        if (parent[i] == i) parent[count++] = i;
    return count;
}

// A closed surface whose volume is at most this share of its area, in units of its size, encloses nothing: it is a
// sheet with two sides, whose volume is the result of rounding. A sheet of 1 m counts as flat below 2 pm of thickness.
#define FLAT 0x1p-40

// Volume and area about the middle of the points, and triangles without area.
static void measure(const solid_parts *p, ovoid_solid_report *report) {
    vec3 middle = vec3_scale(vec3_add(report->box.min, report->box.max), 0.5);
    double unit = ldexp(1, find_unit_exponent(vec3_max_abs(vec3_sub(report->box.max, middle)))), scale = 1 / unit;
    double volume = 0, area = 0;
    for (uint32_t t = 0; t < p->triangle_count; t++) {
        vec3 c[3];
        for (int i = 0; i < 3; i++)
            c[i] = vec3_scale(vec3_sub(vec3_at(p->points, p->triangles[t].point[i]), middle), scale);
        vec3 normal = vec3_cross(vec3_sub(c[1], c[0]), vec3_sub(c[2], c[0]));
        double twice = vec3_norm(normal);
        volume += vec3_dot(c[0], normal) / 6;
        area += twice / 2;
        double longest = max2(vec3_norm(vec3_sub(c[1], c[0])), vec3_norm(vec3_sub(c[2], c[0])));
        if (twice > 1e-10 * longest * longest) continue;
        dd3 o = dd3_from(vec3_at(p->points, p->triangles[t].point[0]));
        dd3 e = dd3_sub(dd3_from(vec3_at(p->points, p->triangles[t].point[1])), o);
        dd3 f = dd3_sub(dd3_from(vec3_at(p->points, p->triangles[t].point[2])), o);
        dd s = dd_from(scale);
        dd3 exact = dd3_cross(dd3_mul(e, s), dd3_mul(f, s));
        report->degenerate += !(vec3_max_abs(dd3_high(exact)) > 0x1p-96 * longest * longest);
    }
    report->volume = report->is_closed ? volume * unit * unit * unit : 0;
    report->area = area * unit * unit;
    report->is_flat = report->is_closed && fabs(volume) <= FLAT * area;
}

uint32_t solid_compute_report(const solid_parts *p, const ovoid_allocator *allocator, uint32_t *components,
                              ovoid_solid_report *report) {
    room r = {allocator_allocate(allocator, p->triangle_count, 3 * sizeof(sort_entry)),
              allocator_allocate(allocator, p->triangle_count, 3 * sizeof(sort_entry))};
    uint32_t count = 0;
    solid_edges edges;
    if (r.entries && r.scratch && solid_find_edges(p, allocator, &edges)) {
        report->edges_unmatched = edges.unmatched;
        report->edges_crowded = edges.crowded;
        report->is_closed = edges.unmatched == 0;
        count_duplicates(p, &r, report);
        measure(p, report);
        count = find_components(p, components);
    }
    report->points = p->point_count;
    report->triangles = p->triangle_count;
    report->components = count;
    allocator_release(allocator, r.entries);
    allocator_release(allocator, r.scratch);
    return count;
}
