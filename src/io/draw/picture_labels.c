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

// The area in which a box overlaps earlier ones or leaves the picture.
static double get_cost(const labels *l, vec2 low, vec2 high) {
    double cost = 0, area = (high.x - low.x) * (high.y - low.y);
    for (size_t i = 0; i < l->count; i++)
        cost += overlap(low.x, high.x, l->low[i].x, l->high[i].x) * overlap(low.y, high.y, l->low[i].y, l->high[i].y);
    double inside = overlap(low.x, high.x, l->frame_low.x, l->frame_high.x) *
                    overlap(low.y, high.y, l->frame_low.y, l->frame_high.y);
    return cost + 3 * (area - inside);
}

vec2 labels_place(labels *l, vec2 near, vec2 size, double gap) {
    // Above, right, left, below, the corners; then the same farther away, which costs a little.
    static const vec2 directions[8] = {{0, -1}, {1, 0}, {-1, 0}, {0, 1}, {1, -1}, {-1, -1}, {1, 1}, {-1, 1}};
    vec2 best = near;
    double best_cost = INFINITY;
    for (int ring = 0; ring < 4; ring++)
        for (int i = 0; i < 8; i++) {
            double away = gap + 16 * ring;
            vec2 p = {near.x + directions[i].x * (size.x / 2 + away), near.y + directions[i].y * (size.y / 2 + away)};
            vec2 low = {p.x - size.x / 2, p.y - size.y / 2}, high = {p.x + size.x / 2, p.y + size.y / 2};
            double cost = get_cost(l, low, high) + 0.05 * size.x * size.y * (ring + 0.2 * i / 8);
            if (cost >= best_cost) continue;
            best_cost = cost;
            best = p;
        }
    labels_block(l, (vec2){best.x - size.x / 2, best.y - size.y / 2}, (vec2){best.x + size.x / 2, best.y + size.y / 2});
    return best;
}

double text_get_width(const char *text, double font_size) {
    double width = 0;
    for (; *text; text++) {
        if (((unsigned char)*text & 0xc0) == 0x80) continue;
        width += strchr("iljtfI.,:;|!'() ", *text)                        ? 0.38
                 : strchr("mwMW@", *text) || (unsigned char)*text >= 0x80 ? 1.0
                                                                          : 0.69;
    }
    return width * font_size;
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

void draw_names(const figure *figures, size_t count, const drawing *d, labels *l) {
    enum { SIZE = 14 };
    const color dark = {0.05, 0.07, 0.10};
    for (size_t i = 0; i < count; i++) {
        const figure *f = &figures[i];
        if (!f->body->name || !f->body->name[0]) continue;
        // The topmost vertex, and the room for a text above it.
        uint32_t top = 0;
        for (uint32_t k = 1; k < f->polytope.vertex_count; k++)
            if (f->pixels[k].y < f->pixels[top].y) top = k;
        char hex[8];
        color_write(color_mix(f->base, dark, 0.55), hex);
        vec2 at = labels_place(l, (vec2){f->pixels[top].x, f->low.y},
                               (vec2){text_get_width(f->body->name, SIZE), 1.2 * SIZE}, 6);
        write_text(d->file, (vec2){at.x, at.y + 0.35 * SIZE}, &(text_style){"middle", SIZE, "600", hex}, f->body->name);
    }
}

// ---- witness points

static void write_number(char out[32], double value, int digits) { number_write(out, value, digits); }

// The distance or the depth, as one number where four digits of the bracket agree, else as its ends.
static void write_length(char *out, size_t size, const ovoid_answer *answer, const char *unit) {
    char low[32], high[32];
    double sign = answer->upper < 0 ? -1 : 1;
    write_number(low, sign > 0 ? answer->lower : -answer->upper, 4);
    write_number(high, sign > 0 ? answer->upper : -answer->lower, 4);
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
        vec2 at = labels_place(l, (vec2){(a.x + b.x) / 2, (a.y + b.y) / 2}, size, 9);
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

void draw_legend(const ovoid_picture *picture, const drawing *d, labels *l) {
    enum { SIZE = 13, LINE = 24 };
    draw_scale_bar(d, picture->unit);
    // One row at the bottom, from the right; an item that nothing in the picture shows is left out.
    double x = d->width - 28.0, y = d->height - 30.0;
    for (size_t i = sizeof legend_items / sizeof *legend_items; i-- > 0;) {
        const legend_item *item = &legend_items[i];
        if (item->layer && !(d->layers & item->layer)) continue;
        if (item->layer == OVOID_PICTURE_WITNESS && !picture->link_count) continue;
        double width = text_get_width(item->text, SIZE);
        write_text(d->file, (vec2){x - width, y + 0.35 * SIZE}, &(text_style){"start", SIZE, "400", ink}, item->text);
        draw_sign(d, item->layer, x - width - 34, y);
        x -= width + 34 + 26;
    }
    labels_block(l, (vec2){0, d->height - 52.0}, (vec2){d->width, d->height});
}
