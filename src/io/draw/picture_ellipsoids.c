// Ellipsoids in a picture. Under an orthographic camera the outline of center + A u, |u| <= 1, is the ellipse of the
// image of A; a great circle of it is an ellipse too, of which exactly one half lies before the outline. Both are
// written as curves, not as polygons.
#include "io/draw/picture_parts.h"

#include <math.h>

static const double pi = 3.141592653589793;

// The symmetric matrix P A A' P' of the outline, in pixels.
typedef struct outline {
    double xx, xy, yy;
} outline;

static outline find_outline(const solid_ellipsoid *e, const camera *c) {
    outline o = {0, 0, 0};
    for (int i = 0; i < 3; i++) {
        vec2 v = camera_project_vector(c, e->axis[i]);
        o.xx += v.x * v.x;
        o.xy += v.x * v.y;
        o.yy += v.y * v.y;
    }
    return o;
}

void ellipsoid_get_extent(const solid_ellipsoid *e, const camera *c, vec2 *low, vec2 *high) {
    outline o = find_outline(e, c);
    vec2 center = camera_project(c, e->center), half = {sqrt(o.xx), sqrt(o.yy)};
    *low = (vec2){center.x - half.x, center.y - half.y};
    *high = (vec2){center.x + half.x, center.y + half.y};
}

// The outline as a path: center + L (cos t, sin t) with the Cholesky factor L of its matrix.
static void write_outline(const solid_ellipsoid *e, const drawing *d, double grow) {
    outline o = find_outline(e, &d->camera);
    double l00 = sqrt(o.xx), l10 = l00 > 0 ? o.xy / l00 : 0, l11 = sqrt(fmax(o.yy - l10 * l10, 0));
    svg_path path = {d->file, 0, 0};
    const ellipse whole = {camera_project(&d->camera, e->center), {grow * l00, grow * l10}, {0, grow * l11}};
    fputs(" d=\"", d->file);
    svg_arc(&path, &whole, 0, 2 * pi);
    fputs("z\"", d->file);
}

// The half of the great circle through axis i and the next one that is in front of the outline (side 1) or behind it
// (side -1). The normal at center + A u is along the sum of dual_i u_i.
static void write_half_circle(const solid_ellipsoid *e, const drawing *d, int i, int side) {
    const camera *c = &d->camera;
    int j = (i + 1) % 3;
    double a = vec3_dot(e->dual[i], c->eye), b = vec3_dot(e->dual[j], c->eye);
    double middle = atan2(b, a) + (side < 0 ? pi : 0);
    svg_path path = {d->file, 0, 0};
    const ellipse circle = {camera_project(c, e->center), camera_project_vector(c, e->axis[i]),
                            camera_project_vector(c, e->axis[j])};
    svg_arc(&path, &circle, middle - pi / 2, middle + pi / 2);
}

// The halves of all three sections on that side.
static void write_sections(const solid_ellipsoid *e, const drawing *d, int side) {
    fputs(" d=\"", d->file);
    for (int i = 0; i < 3; i++) write_half_circle(e, d, i, side);
    fputs("\"", d->file);
}

static const color dark = {0.10, 0.13, 0.18}, white = {1, 1, 1};

void figure_draw_outer_back(const figure *f, const drawing *d) {
    char hex[8];
    color_write(f->base, hex);
    fprintf(d->file, "<path class=\"outer\" fill=\"%s\" fill-opacity=\".07\"", hex);
    write_outline(&f->outer, d, 1);
    fputs("/>\n", d->file);
    if (!f->outer.is_solid) return;
    fprintf(d->file,
            "<path fill=\"none\" stroke=\"%s\" stroke-opacity=\".3\" stroke-width=\".7\" "
            "stroke-dasharray=\"3 3\"",
            hex);
    write_sections(&f->outer, d, -1);
    fputs("/>\n", d->file);
}

void figure_draw_outer_front(const figure *f, const drawing *d) {
    char hex[8];
    color_write(color_mix(f->base, dark, 0.15), hex);
    if (f->outer.is_solid) {
        fprintf(d->file, "<path fill=\"none\" stroke=\"%s\" stroke-opacity=\".55\" stroke-width=\".8\"", hex);
        write_sections(&f->outer, d, 1);
        fputs("/>\n", d->file);
    }
    fprintf(d->file, "<path fill=\"none\" stroke=\"%s\" stroke-opacity=\".9\" stroke-width=\"1.4\"", hex);
    write_outline(&f->outer, d, 1);
    fputs("/>\n", d->file);
}

void figure_draw_inner(const figure *f, const drawing *d) {
    // Under tinted areas it is nearly grey, so that the tints are visible.
    int areas = (d->layers & OVOID_PICTURE_AREAS) != 0;
    color grey = {0.55, 0.58, 0.62}, tone = areas ? color_mix(f->base, grey, 0.8) : f->base;
    char light[8], base[8], deep[8];
    color_write(color_mix(tone, white, 0.55), light);
    color_write(color_mix(tone, dark, 0.12), base);
    color_write(color_mix(tone, dark, 0.55), deep);
    fprintf(d->file,
            "<radialGradient id=\"g%d\" cx=\".5\" cy=\".5\" r=\".62\" fx=\".36\" fy=\".28\">"
            "<stop stop-color=\"%s\"/><stop offset=\".5\" stop-color=\"%s\"/>"
            "<stop offset=\"1\" stop-color=\"%s\"/></radialGradient>\n",
            f->number, light, base, deep);
    fprintf(d->file, "<path class=\"inner\" fill=\"url(#g%d)\" stroke=\"%s\" stroke-width=\".8\"", f->number, deep);
    write_outline(&f->inner, d, 1);
    fputs("/>\n", d->file);
    if (!f->inner.is_solid) return;
    fprintf(d->file, "<path fill=\"none\" stroke=\"#fff\" stroke-opacity=\"%s\" stroke-width=\"%s\"",
            areas ? ".95" : ".5", areas ? "1.6" : ".8");
    write_sections(areas ? &f->areas : &f->inner, d, 1);
    fputs("/>\n", d->file);
}
