// Writing SVG: compact paths in tenths of a pixel, colours, escaped texts.
#include "io/draw/svg.h"

#include "io/json.h"

#include <math.h>
#include <string.h>

color color_mix(color a, color b, double t) {
    return (color){a.r + t * (b.r - a.r), a.g + t * (b.g - a.g), a.b + t * (b.b - a.b)};
}

static int to_byte(double x) { return (int)(255 * fmin(fmax(x, 0), 1) + 0.5); }

void color_write(color c, char out[8]) { snprintf(out, 8, "#%02x%02x%02x", to_byte(c.r), to_byte(c.g), to_byte(c.b)); }

// Tenths as a decimal number, with a blank before it unless a sign separates it from what came before.
static void write_tenths(FILE *file, long tenths, int is_first) {
    if (!is_first && tenths >= 0) fputc(' ', file);
    if (tenths < 0) fputc('-', file);
    long size = tenths < 0 ? -tenths : tenths;
    if (size / 10 || !(size % 10)) fprintf(file, "%ld", size / 10);
    if (size % 10) fprintf(file, ".%ld", size % 10);
}

// Coordinates far outside of any picture are clamped.
static long to_tenths(double x) { return lround(10 * fmin(fmax(x, -1e6), 1e6)); }

static void write_point(svg_path *path, vec2 to, int is_first) {
    write_tenths(path->file, to_tenths(to.x) - path->x, is_first);
    write_tenths(path->file, to_tenths(to.y) - path->y, 0);
}

static void go_to(svg_path *path, vec2 to) {
    path->x = to_tenths(to.x);
    path->y = to_tenths(to.y);
}

void svg_move(svg_path *path, vec2 to) {
    path->x = path->y = 0;
    fputc('M', path->file);
    write_point(path, to, 1);
    go_to(path, to);
}

void svg_line(svg_path *path, vec2 to) {
    fputc('l', path->file);
    write_point(path, to, 1);
    go_to(path, to);
}

void svg_curve(svg_path *path, vec2 a, vec2 b, vec2 to) {
    fputc('c', path->file);
    write_point(path, a, 1);
    write_point(path, b, 0);
    write_point(path, to, 0);
    go_to(path, to);
}

void svg_close(svg_path *path) { fputc('z', path->file); }

void svg_polygon(svg_path *path, const vec2 *points, size_t count) {
    for (size_t i = 0; i < count; i++) (i ? svg_line : svg_move)(path, points[i]);
    svg_close(path);
}

static vec2 arc_point(const ellipse *e, double c, double s) {
    return (vec2){e->center.x + e->u.x * c + e->v.x * s, e->center.y + e->u.y * c + e->v.y * s};
}

void svg_arc(svg_path *path, const ellipse *of, double from, double to) {
    int pieces = (int)ceil(fabs(to - from) / 0.7854);
    double step = (to - from) / pieces, k = 4.0 / 3 * tan(step / 4);
    svg_move(path, arc_point(of, cos(from), sin(from)));
    for (int i = 0; i < pieces; i++) {
        double c0 = cos(from + i * step), s0 = sin(from + i * step);
        double c1 = cos(from + (i + 1) * step), s1 = sin(from + (i + 1) * step);
        svg_curve(path, arc_point(of, c0 - k * s0, s0 + k * c0), arc_point(of, c1 + k * s1, s1 - k * c1),
                  arc_point(of, c1, s1));
    }
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

void svg_escape(FILE *file, const char *text) {
    for (const unsigned char *c = (const unsigned char *)text; *c;) {
        int length = utf8_get_length(c);
        if (*c == '<' || *c == '>' || *c == '&')
            fprintf(file, "&#%d;", *c);
        else if (ovoid_text_get_visible_length((const char *)c))
            fwrite(c, 1, (size_t)length, file);
        else if (*c >= 0x20 && *c != 0x7f)
            fputs("\xef\xbf\xbd", file);
        c += length ? length : 1;
    }
}
