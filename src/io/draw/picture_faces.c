// The faces of a body in a picture. No two faces of a convex body that look toward the eye hide each other, nor do two
// that look away: so the order within a body is free, and faces of one shade become one path. Seams between them are
// closed by a thin line of the same shade; the translucency is that of the whole group. With areas, each face is cut
// by the three planes that bound the octants of the inner ellipsoid, and tinted by the octant.
// Cost: linear in the triangles, but for sorting edges and pieces.
#include "io/draw/picture_parts.h"

#include "io/text.h"
#include "polytope/polygon.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SHADES = 40, CORNERS = 6 };

/// A convex piece of a face: a triangle, or what the octant's planes leave of one.
typedef struct piece {
    vec3 corner[CORNERS]; ///< world frame
    int count;
    int key; ///< octant * SHADES + shade
} piece;

/// Pieces that are drawn together.
typedef struct pieces {
    piece *items;
    size_t count, capacity;
    int front; ///< 1: of faces toward the eye, 0: of the others
    int areas; ///< 1: cut along the areas
} pieces;

// ---- shades

// The brightness of a facet, from 0 to 1: the light comes from the upper left and somewhat from the eye. Half of it
// reaches facets that face away from it, so that no face is flat.
static double get_light(vec3 normal, const camera *c) {
    const double l[3] = {-0.42, 0.68, 0.60};
    double lambert =
        l[0] * vec3_dot(normal, c->right) + l[1] * vec3_dot(normal, c->up) + l[2] * vec3_dot(normal, c->eye);
    return fmin(fmax(0.5 + 0.5 * lambert, 0), 1);
}

static color shade(color base, double light) {
    const color dark = {0.08, 0.10, 0.16}, white = {1, 1, 1};
    color deep = color_mix(base, dark, 0.62), bright = color_mix(base, white, 0.62);
    return light < 0.6 ? color_mix(deep, base, light / 0.6) : color_mix(base, bright, (light - 0.6) / 0.4);
}

color facet_get_color(color base, vec3 normal, const camera *c) { return shade(base, get_light(normal, c)); }

color octant_get_color(int octant) {
    static const color tints[8] = {{0.36, 0.55, 0.80}, {0.94, 0.69, 0.36}, {0.47, 0.72, 0.50}, {0.85, 0.50, 0.55},
                                   {0.65, 0.53, 0.78}, {0.38, 0.71, 0.74}, {0.88, 0.80, 0.42}, {0.62, 0.64, 0.68}};
    return tints[octant];
}

// ---- cutting along the areas

// The part of the piece where sign * dual . (x - center) >= 0 (I. E. Sutherland, G. W. Hodgman, Reentrant polygon
// clipping, 1974). A triangle has at most six corners after three cuts.
static piece cut(const piece *p, vec3 center, vec3 dual, double sign) {
    piece out = {.count = 0, .key = p->key};
    for (int i = 0; i < p->count; i++) {
        vec3 a = p->corner[i], b = p->corner[(i + 1) % p->count];
        double da = sign * vec3_dot(dual, vec3_sub(a, center)), db = sign * vec3_dot(dual, vec3_sub(b, center));
        if (da >= 0 && out.count < CORNERS) out.corner[out.count++] = a;
        if ((da < 0) != (db < 0) && da != 0 && db != 0 && out.count < CORNERS)
            out.corner[out.count++] = vec3_add_scaled(a, vec3_sub(b, a), da / (da - db));
    }
    return out;
}

static int add_piece(pieces *list, const piece *p) {
    if (p->count < 3) return 1;
    if (!array_reserve((void **)&list->items, &list->capacity, list->count, sizeof *list->items)) return 0;
    list->items[list->count++] = *p;
    return 1;
}

// The parts of the piece in the eight octants.
static int add_octants(pieces *list, const piece *whole, const solid_ellipsoid *areas) {
    for (int octant = 0; octant < 8; octant++) {
        piece p = *whole;
        for (int i = 0; i < 3 && p.count; i++) p = cut(&p, areas->center, areas->dual[i], octant >> i & 1 ? -1 : 1);
        p.key = octant * SHADES + whole->key;
        if (!add_piece(list, &p)) return 0;
    }
    return 1;
}

// ---- faces

// 1 for a facet that looks toward the eye. A flat body has one facet, seen from either side.
static int is_front(const figure *f, uint32_t facet, const camera *c) {
    return f->polytope.rank < 3 || vec3_dot(f->normals[facet], c->eye) > 0;
}

static int collect(const figure *f, const drawing *d, pieces *list) {
    const ovoid_polytope *p = &f->polytope;
    for (uint32_t t = 0; t < p->triangle_count; t++) {
        uint32_t facet = p->triangle_facets[t];
        if (is_front(f, facet, &d->camera) != list->front) continue;
        vec3 normal = f->normals[facet];
        // A flat body is lit on the side that is seen.
        if (p->rank < 3 && vec3_dot(normal, d->camera.eye) < 0) normal = vec3_neg(normal);
        piece whole = {.count = 3, .key = (int)(get_light(normal, &d->camera) * (SHADES - 1) + 0.5)};
        for (int k = 0; k < 3; k++) whole.corner[k] = f->points[p->triangles[3 * t + (uint32_t)k]];
        if (!(list->areas ? add_octants(list, &whole, &f->areas) : add_piece(list, &whole))) return 0;
    }
    return 1;
}

static int compare_pieces(const void *a, const void *b) { return ((const piece *)a)->key - ((const piece *)b)->key; }

// One path for the pieces of one key.
static void write_pieces(const figure *f, const drawing *d, pieces *list) {
    if (list->count) qsort(list->items, list->count, sizeof *list->items, compare_pieces);
    svg_path path = {d->file, 0, 0};
    for (size_t i = 0; i < list->count; i++) {
        const piece *p = &list->items[i];
        if (!i || p->key != p[-1].key) {
            char hex[8];
            color base = list->areas ? octant_get_color(p->key / SHADES) : f->base;
            color_write(shade(base, (double)(p->key % SHADES) / (SHADES - 1)), hex);
            fprintf(d->file, "%s<path fill=\"%s\" stroke=\"%s\" d=\"", i ? "\"/>\n" : "", hex, hex);
        }
        vec2 pixels[CORNERS];
        for (int k = 0; k < p->count; k++) pixels[k] = camera_project(&d->camera, p->corner[k]);
        svg_polygon(&path, pixels, (size_t)p->count);
    }
    if (list->count) fputs("\"/>\n", d->file);
}

// 1 where the inner ellipsoid shows through the faces; else they hide all that is behind them.
static int is_clear(const figure *f, const drawing *d) {
    return (d->layers & OVOID_PICTURE_INNER) && f->inner.is_solid;
}

static const char *get_opacity(const figure *f, const drawing *d, int front) {
    if (!front) return ".35";
    return !is_clear(f, d) ? "1" : d->layers & OVOID_PICTURE_AREAS ? ".58" : ".5";
}

static ovoid_code draw_faces(const figure *f, const drawing *d, int front, ovoid_error *error) {
    pieces list = {.front = front, .areas = front && (d->layers & OVOID_PICTURE_AREAS) && f->areas.is_solid};
    ovoid_code code = OVOID_OK;
    if (collect(f, d, &list)) {
        fprintf(d->file, "<g opacity=\"%s\" stroke-width=\".7\" stroke-linejoin=\"round\">\n",
                get_opacity(f, d, front));
        write_pieces(f, d, &list);
        fputs("</g>\n", d->file);
    } else {
        code = io_fail_memory(error, "picture");
    }
    free(list.items);
    return code;
}

// ---- edges

/// An edge of a triangle, the lower vertex first.
typedef struct edge {
    uint32_t a, b, facet;
} edge;

/// A figure's edges, sorted, for the front or the back.
typedef struct edge_list {
    const figure *figure;
    const drawing *drawing;
    const edge *edges;
    size_t count;
    int front; ///< 1: those of faces toward the eye
} edge_list;

static int compare_edges(const void *a, const void *b) {
    const edge *e = a, *g = b;
    if (e->a != g->a) return e->a < g->a ? -1 : 1;
    return (e->b > g->b) - (e->b < g->b);
}

/// How an edge is drawn: not at all, as a soft fold, as a sharp one, or as a part of the outline.
typedef enum edge_kind { EDGE_NONE, EDGE_SOFT, EDGE_SHARP, EDGE_OUTLINE } edge_kind;

// The kind of an edge between two facets, for the front or the back faces. other is NULL at the rim of a flat body.
static edge_kind find_kind(const edge_list *list, const edge *e, const edge *other) {
    const figure *f = list->figure;
    const camera *c = &list->drawing->camera;
    int front = list->front;
    if (!other) return front ? EDGE_OUTLINE : EDGE_NONE;
    if (e->facet == other->facet) return EDGE_NONE;
    int one = is_front(f, e->facet, c), two = is_front(f, other->facet, c);
    if (one != two) return front ? EDGE_OUTLINE : EDGE_NONE;
    if (one != front) return EDGE_NONE;
    return vec3_dot(f->normals[e->facet], f->normals[other->facet]) < 0.93 ? EDGE_SHARP : EDGE_SOFT; // about 22 degrees
}

// Writes all edges of a kind as one path (file NULL: only measures); returns their number and adds up their lengths.
static size_t write_edges(const edge_list *list, edge_kind kind, FILE *file, double *length) {
    const figure *f = list->figure;
    const edge *edges = list->edges;
    svg_path path = {file, 0, 0};
    size_t found = 0;
    for (size_t i = 0; i < list->count; i++) {
        int has_other = i + 1 < list->count && compare_edges(&edges[i], &edges[i + 1]) == 0;
        edge e = edges[i];
        edge_kind is = find_kind(list, &e, has_other ? &edges[i + 1] : NULL);
        i += (size_t)has_other;
        if (is != kind) continue;
        found++;
        vec2 a = f->pixels[e.a], b = f->pixels[e.b];
        *length += hypot(b.x - a.x, b.y - a.y);
        if (!file) continue;
        svg_move(&path, a);
        svg_line(&path, b);
    }
    return found;
}

// Draws the edges of each kind with a line of its own. Where soft folds are dense, as on a smooth hull, they fade.
static void draw_edges(const edge_list *list) {
    const figure *f = list->figure;
    const drawing *d = list->drawing;
    int front = list->front;
    const color dark = {0.07, 0.09, 0.14};
    char hex[8];
    color_write(color_mix(f->base, dark, 0.6), hex);
    for (edge_kind kind = front ? EDGE_SOFT : EDGE_SHARP; kind <= EDGE_OUTLINE; kind++) {
        double length = 0;
        size_t found = write_edges(list, kind, NULL, &length);
        if (!found) continue;
        double fade = fmin(pow(length / (double)found / 30, 1.5), 1);
        double opacity = kind == EDGE_OUTLINE ? 0.9 : (kind == EDGE_SHARP ? 0.75 : 0.38) * fade;
        double width = kind == EDGE_OUTLINE ? 1.1 : kind == EDGE_SHARP ? 0.8 : 0.55;
        if (!front) opacity *= 0.45;
        // Nearly invisible lines are left out; the folds of a rounded body come from its sphere points.
        if (opacity < 0.08 || (f->rounded && kind != EDGE_OUTLINE)) continue;
        fprintf(d->file,
                "<path fill=\"none\" stroke=\"%s\" stroke-opacity=\"%.2f\" stroke-width=\"%.2f\" "
                "stroke-linecap=\"round\"%s d=\"",
                hex, opacity, width, front ? "" : " stroke-dasharray=\"2 2.5\"");
        write_edges(list, kind, d->file, &length);
        fputs("\"/>\n", d->file);
    }
}

static ovoid_code sort_and_draw_edges(const figure *f, const drawing *d, int front, ovoid_error *error) {
    const ovoid_polytope *p = &f->polytope;
    size_t count = 3 * (size_t)p->triangle_count;
    if (!count) return OVOID_OK;
    edge *edges = malloc(count * sizeof *edges);
    if (!edges) return io_fail_memory(error, "picture");
    for (size_t i = 0; i < count; i++) {
        uint32_t a = p->triangles[i], b = p->triangles[i % 3 == 2 ? i - 2 : i + 1];
        edges[i] = (edge){a < b ? a : b, a < b ? b : a, p->triangle_facets[i / 3]};
    }
    qsort(edges, count, sizeof *edges, compare_edges);
    draw_edges(&(edge_list){f, d, edges, count, front});
    free(edges);
    return OVOID_OK;
}

// ---- bodies without faces: a point, a segment

// Draws a ball as a disc with the shades of a sphere.
static void draw_ball(const figure *f, const drawing *d) {
    char light[8], base[8], deep[8];
    color_write(shade(f->base, 0.97), light);
    color_write(shade(f->base, 0.62), base);
    color_write(shade(f->base, 0.12), deep);
    fprintf(d->file,
            "<radialGradient id=\"b%d\" cx=\".42\" cy=\".38\" r=\".72\" fx=\".32\" fy=\".24\"><stop stop-color=\"%s\"/>"
            "<stop offset=\".5\" stop-color=\"%s\"/><stop offset=\"1\" stop-color=\"%s\"/></radialGradient>\n"
            "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"url(#b%d)\" stroke=\"%s\" stroke-width=\"1.1\"/>\n",
            f->number, light, base, deep, f->pixels[0].x, f->pixels[0].y, f->ball * d->camera.scale, f->number, deep);
}

static void draw_thin(const figure *f, const drawing *d) {
    char hex[8];
    color_write(f->base, hex);
    uint32_t end[2] = {0, 0};
    if (f->polytope.rank == 1) polytope_get_ends(&f->polytope, end);
    vec2 a = f->pixels[end[0]], b = f->pixels[end[1]];
    svg_path path = {d->file, 0, 0};
    fprintf(d->file, "<path stroke=\"%s\" stroke-width=\"%s\" stroke-linecap=\"round\" d=\"", hex,
            f->polytope.rank ? "2.5" : "6");
    svg_move(&path, a);
    svg_line(&path, b);
    fputs("\"/>\n", d->file);
}

ovoid_code figure_draw_back(const figure *f, const drawing *d, ovoid_error *error) {
    if (f->polytope.rank < 3 || !is_clear(f, d)) return OVOID_OK;
    ovoid_code code = draw_faces(f, d, 0, error);
    return code ? code : sort_and_draw_edges(f, d, 0, error);
}

ovoid_code figure_draw_front(const figure *f, const drawing *d, ovoid_error *error) {
    if (f->polytope.rank < 2) {
        (f->ball > 0 ? draw_ball : draw_thin)(f, d);
        return OVOID_OK;
    }
    ovoid_code code = draw_faces(f, d, 1, error);
    return code ? code : sort_and_draw_edges(f, d, 1, error);
}
