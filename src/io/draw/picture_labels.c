// The texts of a picture: names, lengths, legend, scale bar. A text takes the best free place near its point; greedily,
// in the order of importance.
#include "io/draw/picture_parts.h"

#include "io/text.h"

#include <math.h>
#include <string.h>

static const char ink[] = "#1d2430", accent[] = "#b3203a";

// ---- places

void labels_block(labels *l, vec2 low, vec2 high) {
    if (l->count == LABELS_MAX) return;
    l->low[l->count] = low;
    l->high[l->count++] = high;
}

static double overlap(double low_a, double high_a, double low_b, double high_b) {
    return fmax(0, fmin(high_a, high_b) - fmax(low_a, low_b));
}

// The share of a text that earlier ones may cover: beyond it there is no room.
#define COVERED_MAX 0.2

// The area in which a box overlaps earlier ones or leaves the picture.
static double get_cost(const labels *l, vec2 low, vec2 high) {
    double cost = 0, area = (high.x - low.x) * (high.y - low.y);
    for (size_t i = 0; i < l->count; i++)
        cost += overlap(low.x, high.x, l->low[i].x, l->high[i].x) * overlap(low.y, high.y, l->low[i].y, l->high[i].y);
    double inside = overlap(low.x, high.x, l->frame_low.x, l->frame_high.x) *
                    overlap(low.y, high.y, l->frame_low.y, l->frame_high.y);
    return cost + 3 * (area - inside);
}

int labels_place(labels *l, const label *text, vec2 *at) {
    const vec2 near = text->near, size = text->size;
    // Above, right, left, below, the corners; then the same farther away, which costs a little.
    static const vec2 directions[8] = {{0, -1}, {1, 0}, {-1, 0}, {0, 1}, {1, -1}, {-1, -1}, {1, 1}, {-1, 1}};
    double best_cost = INFINITY, best_overlap = INFINITY;
    *at = near;
    for (int ring = 0; ring < 4; ring++)
        for (int i = 0; i < 8; i++) {
            double away = text->gap + 16 * ring;
            vec2 p = {near.x + directions[i].x * (size.x / 2 + away), near.y + directions[i].y * (size.y / 2 + away)};
            vec2 low = {p.x - size.x / 2, p.y - size.y / 2}, high = {p.x + size.x / 2, p.y + size.y / 2};
            double covered = get_cost(l, low, high), cost = covered + 0.05 * size.x * size.y * (ring + 0.2 * i / 8);
            if (cost >= best_cost) continue;
            best_cost = cost;
            best_overlap = covered;
            *at = p;
        }
    if (best_overlap > COVERED_MAX * size.x * size.y || l->count == LABELS_MAX) return 0;
    labels_block(l, (vec2){at->x - size.x / 2, at->y - size.y / 2}, (vec2){at->x + size.x / 2, at->y + size.y / 2});
    return 1;
}

/// How a text is drawn, in SVG's words; size in pixels.
typedef struct text_style {
    const char *anchor;
    int size;
    const char *weight, *fill;
} text_style;

// A text with a light rim, so that it can be read on anything.
static void write_text(FILE *file, vec2 at, const text_style *style, const char *text) {
    fprintf(file,
            "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" font-size=\"%d\" font-weight=\"%s\" fill=\"%s\" "
            "stroke=\"#fbfcfd\" stroke-width=\"3.5\" stroke-linejoin=\"round\" paint-order=\"stroke\">",
            at.x, at.y, style->anchor, style->size, style->weight, style->fill);
    svg_escape(file, text);
    fputs("</text>\n", file);
}

// ---- names

// 1 if the pixel is inside the picture of a solid or flat figure.
static int is_inside(const figure *f, vec2 p) {
    const ovoid_polytope *polytope = &f->polytope;
    if (p.x <= f->low.x || p.x >= f->high.x || p.y <= f->low.y || p.y >= f->high.y) return 0;
    if (f->ball > 0) return 1;
    for (uint32_t t = 0; t < polytope->triangle_count; t++) {
        double side[3];
        for (uint32_t k = 0; k < 3; k++) {
            vec2 a = f->pixels[polytope->triangles[3 * t + k]], b = f->pixels[polytope->triangles[3 * t + (k + 1) % 3]];
            side[k] = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
        }
        if ((side[0] > 0 && side[1] > 0 && side[2] > 0) || (side[0] < 0 && side[1] < 0 && side[2] < 0)) return 1;
    }
    return 0;
}

// The topmost vertex of figure order[place] that no later one hides; 0 where all are hidden.
static int find_top(const figure_list *list, size_t place, vec2 *top) {
    const figure *f = &list->figures[list->order[place]];
    int found = 0;
    for (uint32_t v = 0; v < f->polytope.vertex_count; v++) {
        vec2 p = f->pixels[v];
        int is_hidden = found && p.y >= top->y;
        for (size_t later = place + 1; later < list->count && !is_hidden; later++)
            is_hidden = is_inside(&list->figures[list->order[later]], p);
        if (is_hidden) continue;
        *top = p;
        found = 1;
    }
    return found;
}

void draw_names(const figure_list *list, const drawing *d, labels *l) {
    enum { SIZE = 14 };
    const color dark = {0.05, 0.07, 0.10};
    // The nearest bodies first.
    for (size_t place = list->count; place-- > 0;) {
        const figure *f = &list->figures[list->order[place]];
        const char *name = f->body->name;
        vec2 top, at, size = {name ? text_get_width(name, SIZE) : 0, 1.2 * SIZE};
        if (!name || !name[0] || !find_top(list, place, &top)) continue;
        top.y -= f->ball * d->camera.scale;
        if (!labels_place(l, &(label){top, size, 6}, &at)) continue;
        char hex[8];
        color_write(color_mix(f->base, dark, 0.55), hex);
        write_text(d->file, (vec2){at.x, at.y + 0.35 * SIZE}, &(text_style){"middle", SIZE, "600", hex}, name);
    }
}

// ---- witness points

// A value to the last of four digits of `largest`, which is no smaller: of the ends of a bracket the smaller one has no
// more decimals than the larger.
static void write_number(char out[32], double value, double largest) {
    enum { DIGITS = 4 };
    double step = pow(10, floor(log10(largest)) - (DIGITS - 1));
    // Adding zero makes -0 positive.
    if (step > 0 && isfinite(value / step)) value = step * round(value / step) + 0.0;
    number_write(out, value, DIGITS);
}

// The distance or the depth, as one number where four digits of the bracket agree, else as its ends.
static void write_length(char *out, size_t size, const ovoid_answer *answer, const char *unit) {
    if (answer->status == OVOID_TOUCHING) {
        snprintf(out, size, "touching");
        return;
    }
    char low[32], high[32];
    double sign = answer->upper < 0 ? -1 : 1, largest = fmax(fabs(answer->lower), fabs(answer->upper));
    write_number(low, sign > 0 ? answer->lower : -answer->upper, largest);
    write_number(high, sign > 0 ? answer->upper : -answer->lower, largest);
    const char *blank = unit && unit[0] ? " " : "";
    if (!unit) unit = "";
    const char *what = sign < 0 ? "depth " : "";
    if (strcmp(low, high) == 0 || !isfinite(answer->upper - answer->lower))
        snprintf(out, size, "%s%s%s%s", what, isfinite(answer->upper) ? high : low, blank, unit);
    else
        snprintf(out, size, "%s%s \xe2\x80\xa6 %s%s%s", what, low, high, blank, unit);
}

static int is_drawable(const ovoid_answer *answer) {
    return vec3_is_finite(answer->point_a) && vec3_is_finite(answer->point_b) && isfinite(answer->upper);
}

static void draw_link_line(const ovoid_answer *answer, const drawing *d) {
    vec2 a = camera_project(&d->camera, answer->point_a), b = camera_project(&d->camera, answer->point_b);
    fprintf(d->file,
            "<path fill=\"none\" stroke=\"#fff\" stroke-opacity=\".8\" stroke-width=\"4.5\" stroke-linecap=\"round\" "
            "d=\"M%.1f %.1fL%.1f %.1f\"/>\n<path class=\"witness\" fill=\"none\" stroke=\"%s\" stroke-width=\"2\" "
            "stroke-linecap=\"round\" d=\"M%.1f %.1fL%.1f %.1f\"/>\n",
            a.x, a.y, b.x, b.y, accent, a.x, a.y, b.x, b.y);
    const vec2 ends[2] = {a, b};
    for (int i = 0; i < 2; i++)
        fprintf(d->file,
                "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"4.2\" fill=\"%s\" stroke=\"#fff\" stroke-width=\"1.4\"/>\n",
                ends[i].x, ends[i].y, accent);
}

void draw_links(const ovoid_picture *picture, const drawing *d, labels *l) {
    enum { SIZE = 14 };
    // All lines come first, so that texts avoid them.
    for (size_t i = 0; i < picture->link_count; i++) {
        const ovoid_answer *answer = picture->links[i].answer;
        if (!is_drawable(answer)) continue;
        draw_link_line(answer, d);
        vec2 a = camera_project(&d->camera, answer->point_a), b = camera_project(&d->camera, answer->point_b);
        for (int k = 0; k <= 4; k++) {
            vec2 p = {a.x + k * (b.x - a.x) / 4, a.y + k * (b.y - a.y) / 4};
            labels_block(l, (vec2){p.x - 6, p.y - 6}, (vec2){p.x + 6, p.y + 6});
        }
    }
    for (size_t i = 0; i < picture->link_count; i++) {
        const ovoid_answer *answer = picture->links[i].answer;
        if (!is_drawable(answer)) continue;
        vec2 a = camera_project(&d->camera, answer->point_a), b = camera_project(&d->camera, answer->point_b);
        char text[128];
        write_length(text, sizeof text, answer, picture->unit);
        vec2 size = {text_get_width(text, SIZE) + 14, 1.5 * SIZE};
        vec2 at;
        if (!labels_place(l, &(label){{(a.x + b.x) / 2, (a.y + b.y) / 2}, size, 9}, &at)) continue;
        fprintf(d->file,
                "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" rx=\"%.1f\" fill=\"#fff\" "
                "fill-opacity=\".93\" stroke=\"%s\" stroke-opacity=\".5\"/>\n"
                "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\" font-size=\"%d\" font-weight=\"600\" fill=\"%s\">",
                at.x - size.x / 2, at.y - size.y / 2, size.x, size.y, size.y / 2, accent, at.x, at.y + 0.35 * SIZE,
                SIZE, accent);
        svg_escape(d->file, text);
        fputs("</text>\n", d->file);
    }
}

// ---- legend and scale bar

// The length 1, 2 or 5 times a power of ten nearest below the one given.
static double round_length(double length) {
    double power = pow(10, floor(log10(length))), m = length / power;
    return power * (m >= 5 ? 5 : m >= 2 ? 2 : 1);
}

static void draw_scale_bar(const drawing *d, const char *unit) {
    double length = round_length(0.16 * d->width / d->camera.scale), pixels = length * d->camera.scale;
    double x = 28, y = d->height - 30.0;
    char number[32], text[64];
    write_number(number, length, 6);
    snprintf(text, sizeof text, "%s%s%s", number, unit && unit[0] ? " " : "", unit ? unit : "");
    fprintf(d->file,
            "<path class=\"scale\" fill=\"none\" stroke=\"%s\" stroke-width=\"1.6\" d=\"M%.1f %.1fv8h%.1fv-8\"/>\n",
            ink, x, y - 4, pixels);
    write_text(d->file, (vec2){x + pixels / 2, y - 8}, &(text_style){"middle", 13, "400", ink}, text);
}

/// One line of the legend.
typedef struct legend_item {
    uint32_t layer; ///< the layer that it explains; 0: always shown
    const char *text;
} legend_item;

static const legend_item legend_items[] = {{0, "polyhedron"},
                                           {OVOID_PICTURE_OUTER, "outer ellipsoid"},
                                           {OVOID_PICTURE_INNER, "inner ellipsoid"},
                                           {OVOID_PICTURE_AREAS, "areas"},
                                           {OVOID_PICTURE_WITNESS, "witness points"}};

// The sign before a text of the legend, 26 pixels wide, centred at y.
static void draw_sign(const drawing *d, uint32_t layer, double x, double y) {
    FILE *file = d->file;
    if (layer == 0)
        fprintf(
            file,
            "<path fill=\"#7d9cc4\" d=\"M%.1f %.1fl11 -6l11 6v8l-11 6l-11 -6z\"/><path fill=\"none\" "
            "stroke=\"#27364d\" stroke-width=\".9\" d=\"M%.1f %.1fl11 -6l11 6v8l-11 6l-11 -6zl11 6l11 -6m-11 6v8\"/>\n",
            x + 2, y - 4, x + 2, y - 4);
    if (layer == OVOID_PICTURE_OUTER)
        fprintf(file,
                "<ellipse cx=\"%.1f\" cy=\"%.1f\" rx=\"13\" ry=\"8\" fill=\"#3f78b8\" fill-opacity=\".08\" "
                "stroke=\"#35659b\" stroke-width=\"1.4\"/>\n",
                x + 13, y);
    if (layer == OVOID_PICTURE_INNER)
        fprintf(file,
                "<radialGradient id=\"legend\" cx=\".5\" cy=\".5\" r=\".62\" fx=\".36\" fy=\".28\"><stop "
                "stop-color=\"#a9c2e2\"/><stop offset=\".5\" stop-color=\"#3b6da7\"/><stop offset=\"1\" "
                "stop-color=\"#234066\"/></radialGradient><ellipse cx=\"%.1f\" cy=\"%.1f\" rx=\"12\" ry=\"7\" "
                "fill=\"url(#legend)\"/>\n",
                x + 13, y);
    for (int i = 0; i < 8 && layer == OVOID_PICTURE_AREAS; i++) {
        char hex[8];
        color_write(octant_get_color(i), hex);
        int column = 6 * (i % 4), row = 6 * (i / 4);
        fprintf(file, "<rect x=\"%.1f\" y=\"%.1f\" width=\"6\" height=\"6\" fill=\"%s\"/>\n", x + 1 + column,
                y - 6 + row, hex);
    }
    if (layer == OVOID_PICTURE_WITNESS)
        fprintf(file,
                "<path stroke=\"%s\" stroke-width=\"2\" d=\"M%.1f %.1fh18\"/><circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.6\" "
                "fill=\"%s\"/><circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.6\" fill=\"%s\"/>\n",
                accent, x + 4, y, x + 4, y, accent, x + 22, y, accent);
}

static int has_meshes(const ovoid_picture *picture, const drawing *d) {
    for (size_t i = 0; i < picture->body_count; i++) {
        const ovoid_picture_body *b = &picture->bodies[i];
        if (b->mesh && (d->layers & OVOID_PICTURE_MESHES || b->is_mesh)) return 1;
    }
    return 0;
}

void draw_legend(const ovoid_picture *picture, const drawing *d, labels *l) {
    enum { SIZE = 13, LINE = 24 };
    draw_scale_bar(d, picture->unit);
    // One row at the bottom, from the right; an item that nothing in the picture shows is left out.
    double x = d->width - 28.0, y = d->height - 30.0;
    for (size_t i = sizeof legend_items / sizeof *legend_items; i-- > 0;) {
        const legend_item *item = &legend_items[i];
        if (item->layer && !(d->layers & item->layer)) continue;
        if (item->layer == OVOID_PICTURE_WITNESS && !picture->link_count) continue;
        const char *text = item->layer || !has_meshes(picture, d) ? item->text : "mesh";
        double width = text_get_width(text, SIZE);
        write_text(d->file, (vec2){x - width, y + 0.35 * SIZE}, &(text_style){"start", SIZE, "400", ink}, text);
        draw_sign(d, item->layer, x - width - 34, y);
        x -= width + 34 + 26;
    }
    labels_block(l, (vec2){0, d->height - 52.0}, (vec2){d->width, d->height});
}
