// Pictures: a scene of convex bodies as SVG, from an orthographic camera that fits all of it. Bodies are painted from
// far to near (the painter's algorithm). For two that are apart, the plane that separates them says which is nearer:
// the body on the eye's side of it is painted later, and that is exact. For bodies that touch, or overlap by less than
// can be seen, it is the plane of least overlap. Only for bodies that overlap by more, and where three hide each other
// in a ring, the depth of their centres decides.
// Cost: linear in the triangles, quadratic in the bodies whose pictures overlap.
#include "io/draw/picture_parts.h"

#include "io/locale.h"
#include "io/text.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { TRIANGLES_MAX = 1000000, BODIES_ORDERED_MAX = 1000, BODIES_FEW = 12 };

// Pixels of overlap that are not seen.
#define OVERLAP_UNSEEN 1.0

// ---- the order of painting

static vec3 get_center(const figure *f) { return f->outer.center; }

// 1 if the boxes of pixels overlap.
static int is_overlapping(const figure *a, const figure *b) {
    return a->low.x <= b->high.x && b->low.x <= a->high.x && a->low.y <= b->high.y && b->low.y <= a->high.y;
}

// How far the normal of the plane between a and b, from a to b, points toward the eye; 0 where they overlap too far to
// have one.
static double find_plane(const figure *a, const figure *b, const camera *c) {
    ovoid_pair pair = {a->body->shape, b->body->shape, a->body->pose, b->body->pose};
    ovoid_answer answer = ovoid_collide(&pair, NULL, NULL);
    if (answer.status != OVOID_SEPARATED) answer = ovoid_depth(&pair, NULL, &answer.proof, NULL);
    return answer.lower * c->scale >= -OVERLAP_UNSEEN ? vec3_dot(answer.normal, c->eye) : 0;
}

// 1 if a must be painted before b, -1 if after, 0 if the order is free.
static int compare_figures(const figure *a, const figure *b, const camera *c) {
    if (!is_overlapping(a, b)) return 0;
    double toward = find_plane(a, b, c);
    if (fabs(toward) < 1e-9) toward = camera_get_depth(c, get_center(b)) - camera_get_depth(c, get_center(a));
    return (toward > 0) - (toward < 0);
}

// Counts for each figure those not yet painted that must come before it; painted figures have -1.
static void count_before(const figure_list *list, const camera *c, int *before, signed char *relation) {
    const figure *figures = list->figures;
    const size_t count = list->count;
    for (size_t i = 0; i < count; i++)
        for (size_t j = i + 1; j < count; j++) {
            int order = compare_figures(&figures[i], &figures[j], c);
            relation[i * count + j] = (signed char)order;
            relation[j * count + i] = (signed char)-order;
            if (order > 0) before[j]++;
            if (order < 0) before[i]++;
        }
}

// The next figure to paint: of those that none must precede, the farthest.
static size_t find_next(const figure_list *list, const camera *c, const int *before) {
    const figure *figures = list->figures;
    const size_t count = list->count;
    size_t best = count;
    double best_depth = 0;
    int best_is_free = 0;
    for (size_t i = 0; i < count; i++) {
        if (before[i] < 0) continue;
        int is_free = before[i] == 0;
        double depth = camera_get_depth(c, get_center(&figures[i]));
        if (best < count && (is_free < best_is_free || (is_free == best_is_free && depth >= best_depth))) continue;
        best = i;
        best_depth = depth;
        best_is_free = is_free;
    }
    return best;
}

// Finds the order of painting. Beyond BODIES_ORDERED_MAX bodies only the depth of centres counts.
static ovoid_code sort_figures(const figure_list *list, const camera *c) {
    const size_t count = list->count;
    int *before = calloc(count + 1, sizeof *before);
    int is_exact = count <= BODIES_ORDERED_MAX;
    signed char *relation = calloc(is_exact ? count * count + 1 : 1, 1);
    ovoid_code code = before && relation ? OVOID_OK : OVOID_ERROR_MEMORY;
    if (!code && is_exact) count_before(list, c, before, relation);
    for (size_t k = 0; k < count && !code; k++) {
        size_t i = list->order[k] = find_next(list, c, before);
        before[i] = -1;
        for (size_t j = 0; j < count && is_exact; j++)
            if (before[j] > 0 && relation[i * count + j] > 0) before[j]--;
    }
    free(before);
    free(relation);
    return code;
}

// ---- the frame

static void widen(vec2 *low, vec2 *high, vec2 a, vec2 b) {
    *low = (vec2){fmin(low->x, a.x), fmin(low->y, a.y)};
    *high = (vec2){fmax(high->x, b.x), fmax(high->y, b.y)};
}

// Chooses scale and origin so that bodies, outer ellipsoids and witness points fill the picture between title and
// legend.
static void fit_camera(const ovoid_picture *picture, figure *figures, drawing *d) {
    camera *c = &d->camera;
    c->center = get_center(&figures[0]);
    vec2 low = {INFINITY, INFINITY}, high = {-INFINITY, -INFINITY};
    for (size_t i = 0; i < picture->body_count; i++) {
        figure_project(&figures[i], c);
        widen(&low, &high, figures[i].low, figures[i].high);
        if (!(d->layers & OVOID_PICTURE_OUTER)) continue;
        vec2 a, b;
        ellipsoid_get_extent(&figures[i].outer, c, &a, &b);
        widen(&low, &high, a, b);
    }
    double top = picture->title ? 64 : 36, bottom = d->layers & OVOID_PICTURE_LEGEND ? 70 : 36, side = 44;
    double width = fmax(d->width - 2 * side, 10), height = fmax(d->height - top - bottom, 10);
    double size = fmax((high.x - low.x) / width, (high.y - low.y) / height);
    c->scale = size > 0 ? 1 / size : 1;
    c->origin.x = side + width / 2 - c->scale * (low.x + high.x) / 2;
    c->origin.y = top + height / 2 - c->scale * (low.y + high.y) / 2;
    for (size_t i = 0; i < picture->body_count; i++) figure_project(&figures[i], c);
}

// ---- the document

static void write_head(const ovoid_picture *picture, const drawing *d) {
    fprintf(d->file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%lu\" height=\"%lu\" viewBox=\"0 0 %lu %lu\" "
            "font-family=\"Helvetica,Arial,'DejaVu Sans',sans-serif\">\n",
            (unsigned long)d->width, (unsigned long)d->height, (unsigned long)d->width, (unsigned long)d->height);
    // A background of its own: the picture looks the same on light and dark pages.
    fputs("<linearGradient id=\"ground\" x2=\"0\" y2=\"1\"><stop stop-color=\"#fdfdfe\"/><stop offset=\"1\" "
          "stop-color=\"#eef1f5\"/></linearGradient>\n<rect width=\"100%\" height=\"100%\" rx=\"10\" "
          "fill=\"url(#ground)\"/>\n",
          d->file);
    if (!picture->title) return;
    fprintf(d->file, "<text x=\"28\" y=\"40\" font-size=\"20\" font-weight=\"600\" fill=\"#1d2430\">");
    svg_escape(d->file, picture->title);
    fputs("</text>\n", d->file);
}

static ovoid_code draw_figure(const figure *f, const drawing *d, ovoid_error *error) {
    int has_outer = (d->layers & OVOID_PICTURE_OUTER) && f->has_ellipsoids;
    int has_inner = (d->layers & OVOID_PICTURE_INNER) && f->has_ellipsoids;
    const ovoid_faces *mesh = f->rounded ? NULL : f->body->mesh;
    int has_mesh = (d->layers & OVOID_PICTURE_MESHES || f->body->is_mesh) && mesh && mesh->face_count;
    fputs("<g>\n", d->file);
    if (has_outer) figure_draw_outer_back(f, d);
    ovoid_code code = has_mesh ? figure_draw_mesh(f, d, error) : figure_draw_back(f, d, error);
    if (!code && has_inner && !has_mesh) figure_draw_inner(f, d);
    if (!code && !has_mesh) code = figure_draw_front(f, d, error);
    if (!code && has_outer) figure_draw_outer_front(f, d);
    fputs("</g>\n", d->file);
    return code;
}

// Draws all bodies and texts in the order of painting.
static ovoid_code draw_ordered(const ovoid_picture *picture, const figure_list *list, const drawing *d,
                               ovoid_error *error) {
    ovoid_code code = OVOID_OK;
    for (size_t k = 0; k < list->count && !code; k++) code = draw_figure(&list->figures[list->order[k]], d, error);
    labels l = {.count = 0, .frame_low = {8, 8}, .frame_high = {d->width - 8.0, d->height - 8.0}};
    if (picture->title) labels_block(&l, (vec2){0, 0}, (vec2){40 + text_get_width(picture->title, 20), 54});
    if (d->layers & OVOID_PICTURE_LEGEND) draw_legend(picture, d, &l);
    if (d->layers & OVOID_PICTURE_WITNESS) draw_links(picture, d, &l);
    if (d->layers & OVOID_PICTURE_NAMES) draw_names(list, d, &l);
    return code;
}

static ovoid_code draw_all(const ovoid_picture *picture, figure *figures, drawing *d, ovoid_error *error) {
    fit_camera(picture, figures, d);
    write_head(picture, d);
    size_t *order = malloc((picture->body_count + 1) * sizeof *order);
    const figure_list list = {figures, order, picture->body_count};
    ovoid_code code = order ? sort_figures(&list, &d->camera) : OVOID_ERROR_MEMORY;
    if (code)
        io_fail_memory(error, "picture");
    else
        code = draw_ordered(picture, &list, d, error);
    free(order);
    fputs("</svg>\n", d->file);
    return code;
}

// ---- the picture

// Checks that bodies and links are in range, and that there are not too many triangles.
static ovoid_code validate_picture(const char *path, const ovoid_picture *picture, ovoid_error *error) {
    where at = {path, 0, -1};
    if (!picture->body_count) return io_fail(error, OVOID_ERROR_EMPTY, at, "a picture needs at least one body");
    uint64_t triangles = 0;
    for (size_t i = 0; i < picture->body_count; i++) {
        at.place = (int64_t)i;
        ovoid_code code = ovoid_pose_validate(&picture->bodies[i].pose);
        if (code) return io_fail(error, code, at, "the pose of body %zu: %s", i, ovoid_code_get_name(code));
        const ovoid_faces *mesh = picture->bodies[i].mesh;
        triangles += ovoid_shape_get_polytope(picture->bodies[i].shape).triangle_count + (mesh ? mesh->face_count : 0);
    }
    at.place = -1;
    if (triangles > TRIANGLES_MAX)
        return io_fail(error, OVOID_ERROR_LIMIT, at, "%llu triangles; at most %d are drawn",
                       (unsigned long long)triangles, TRIANGLES_MAX);
    for (size_t i = 0; i < picture->link_count; i++)
        if (picture->links[i].a >= picture->body_count || picture->links[i].b >= picture->body_count)
            return io_fail(error, OVOID_ERROR_INDEX, at, "link %zu joins a body that is not there", i);
    return OVOID_OK;
}

// The layers where none are asked for. Ellipsoids would bury many bodies, and faces that hide nothing confuse.
static uint32_t get_layers(const ovoid_picture *picture) {
    uint32_t layers = OVOID_PICTURE_WITNESS | OVOID_PICTURE_NAMES | OVOID_PICTURE_LEGEND;
    return picture->body_count > BODIES_FEW ? layers | OVOID_PICTURE_MESHES
                                            : layers | OVOID_PICTURE_OUTER | OVOID_PICTURE_INNER;
}

static drawing make_drawing(const ovoid_picture *picture, const ovoid_picture_options *options, FILE *file) {
    static const ovoid_picture_options defaults = {.width = 0};
    if (!options) options = &defaults;
    vec3 view = options->view;
    if (!(vec3_norm(vec3_unit(view)) > 0.5)) view = (vec3){1, -1.6, 0.9};
    return (drawing){.file = file,
                     .camera = camera_make(view),
                     .width = options->width ? options->width : 1200,
                     .height = options->height ? options->height : 800,
                     .layers = options->layers ? options->layers : get_layers(picture)};
}

static ovoid_code write_picture(const char *path, const ovoid_picture *picture, drawing *d, ovoid_error *error) {
    figure *figures = calloc(picture->body_count, sizeof *figures);
    if (!figures) return io_fail_memory(error, path);
    ovoid_code code = OVOID_OK;
    for (size_t i = 0; i < picture->body_count && !code; i++) {
        figures[i].number = (int)i;
        code = figure_make(&figures[i], &picture->bodies[i], path, error);
    }
    if (!code) code = draw_all(picture, figures, d, error);
    for (size_t i = 0; i < picture->body_count; i++) figure_clear(&figures[i]);
    free(figures);
    return code;
}

static ovoid_code write_valid(const char *path, FILE *file, const ovoid_picture *picture,
                              const ovoid_picture_options *options, ovoid_error *error) {
    drawing d = make_drawing(picture, options, file);
    locale_scope locale = locale_enter();
    ovoid_code code = write_picture(path, picture, &d, error);
    locale_leave(locale);
    return code;
}

ovoid_code ovoid_picture_write_stream(FILE *file, const ovoid_picture *picture, const ovoid_picture_options *options,
                                      ovoid_error *error) {
    ovoid_code code = validate_picture("picture", picture, error);
    if (!code) code = write_valid("picture", file, picture, options, error);
    if (code || !(fflush(file) || ferror(file))) return code;
    return io_fail(error, OVOID_ERROR_FILE, (where){"picture", 0, -1}, "the stream failed");
}

ovoid_code ovoid_picture_write_svg(const char *path, const ovoid_picture *picture, const ovoid_picture_options *options,
                                   ovoid_error *error) {
    ovoid_code code = validate_picture(path, picture, error);
    if (code) return code;
    ovoid_output *output = ovoid_output_open(path, error);
    if (!output) return OVOID_ERROR_FILE;
    code = write_valid(path, ovoid_output_get_file(output), picture, options, error);
    if (!code) code = ovoid_output_commit(output, error);
    ovoid_output_close(output);
    return code;
}
