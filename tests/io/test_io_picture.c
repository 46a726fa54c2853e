// Pictures. Truth: the document is well-formed XML, read by a checker written here; outlines of ellipsoids have the
// extent that the formula of their supports gives, faces those of the projected vertices; nearer bodies come later in
// the document; sizes and limits hold. What a picture looks like, only people can judge.
#include "files.h"
#include "ovoid/paper.h"

static ovoid_picture_body make_body(const char *name, ovoid_shape *shape, double x, double y, double z) {
    CHECK(shape != NULL);
    ovoid_picture_body body = {name, shape, ovoid_pose_make_identity(), 0, NULL, 0};
    body.pose.position = (ovoid_vec3){x, y, z};
    return body;
}

static char *draw(const ovoid_picture *picture, const ovoid_picture_options *options, size_t *size) {
    ovoid_error error = {OVOID_OK, -1, ""};
    const char *path = file_path("picture.svg");
    if (!CHECK(ovoid_picture_write_svg(path, picture, options, &error) == OVOID_OK)) {
        printf("  %s\n", error.message);
        exit(1);
    }
    return file_read(path, size);
}

// ---- well-formed: tags nest, attributes have quotes, no stray marks, every number is one

static int is_well_formed(const char *c) {
    const char *open[64];
    size_t lengths[64], depth = 0;
    while (*c) {
        if (*c == '&') {
            c += strcspn(c, ";<");
            if (*c != ';') return 0;
        }
        if (*c == '>') return 0;
        if (*c++ != '<') continue;
        int is_end = *c == '/';
        c += is_end;
        size_t length = strcspn(c, " />\n");
        if (!length) return 0;
        if (is_end) {
            if (!depth || lengths[depth - 1] != length || memcmp(open[depth - 1], c, length) != 0) return 0;
            depth--;
            c += length;
        } else {
            if (depth == 64) return 0;
            open[depth] = c;
            lengths[depth++] = length;
            c += length;
            while (*c == ' ' || *c == '\n') {
                c += strspn(c, " \n");
                c += strcspn(c, "=<>");
                if (c[0] != '=' || c[1] != '"') return 0;
                c += 2;
                c += strcspn(c, "\"<");
                if (*c++ != '"') return 0;
            }
            if (*c == '/') {
                depth--;
                c++;
            }
        }
        if (*c++ != '>') return 0;
    }
    return depth == 0;
}

static void check_document(const char *text) {
    CHECK(is_well_formed(text));
    CHECK(!strstr(text, "nan") && !strstr(text, "inf"));
    CHECK(strstr(text, "<svg xmlns=") == text);
}

// ---- extents of paths

/// The box of the points of a path, without those of a curve that only bend it.
typedef struct box {
    double low_x, low_y, high_x, high_y;
} box;

static void box_add(box *b, double x, double y) {
    b->low_x = fmin(b->low_x, x);
    b->high_x = fmax(b->high_x, x);
    b->low_y = fmin(b->low_y, y);
    b->high_y = fmax(b->high_y, y);
}

// The path's `d` follows `mark` in the text.
static box read_path(const char *text, const char *mark) {
    box b = {INFINITY, INFINITY, -INFINITY, -INFINITY};
    const char *c = strstr(text, mark);
    if (c) c = strstr(c, " d=\"");
    if (!CHECK(c != NULL)) return b;
    c += 4;
    double x = 0, y = 0;
    while (*c && *c != '"') {
        char command = *c++;
        int pairs = command == 'c' ? 3 : command == 'z' ? 0 : 1;
        double px = x, py = y;
        for (int k = 0; k < pairs; k++) {
            char *end;
            double dx = strtod(c, &end), dy = strtod(end, &end);
            c = end;
            px = command == 'M' ? dx : x + dx;
            py = command == 'M' ? dy : y + dy;
        }
        if (!pairs) continue;
        box_add(&b, x = px, y = py);
    }
    return b;
}

// A box of half sizes 1, 2, 3 seen along y: its faces are 2 by 6; the ellipsoids' half axes are the sizes, times
// sqrt(3) outside. Pictures have tenths of pixels; the ellipses' extreme points are ends of curves here.
static void check_extents(void) {
    ovoid_shape *shape = ovoid_shape_create_box((ovoid_vec3){1, 2, 3}, NULL, NULL);
    ovoid_picture_body body = make_body("box", shape, 5, 6, 7);
    ovoid_picture picture = {.bodies = &body, .body_count = 1};
    ovoid_picture_options options = {.width = 800, .height = 1000, .view = {0, -1, 0}};
    size_t size;
    char *text = draw(&picture, &options, &size);
    check_document(text);
    box outer = read_path(text, "class=\"outer\""), inner = read_path(text, "class=\"inner\"");
    // The outer ellipse fills the height between the margins of 36 and 70: 6 sqrt(3) lengths in 894 pixels.
    double scale = 894 / (6 * sqrt(3.0));
    // The ellipsoids' gap is 1e-6 in volume; their lengths are good to a thousandth.
    CHECK_NEAR(outer.high_y - outer.low_y, 894, 1);
    CHECK_NEAR(outer.high_x - outer.low_x, 2 * sqrt(3.0) * scale, 1);
    CHECK_NEAR(inner.high_y - inner.low_y, 6 * scale, 1);
    CHECK_NEAR(inner.high_x - inner.low_x, 2 * scale, 1);
    CHECK_NEAR((outer.low_x + outer.high_x) / 2, 400, 0.5);
    CHECK_NEAR((inner.low_y + inner.high_y) / 2, (outer.low_y + outer.high_y) / 2, 0.5);
    box faces = read_path(text, "<g opacity=\".5\"");
    CHECK_NEAR(faces.high_x - faces.low_x, 2 * scale, 1);
    CHECK_NEAR(faces.high_y - faces.low_y, 6 * scale, 1);
    free(text);
    ovoid_shape_destroy(shape);
}

// Of two boxes before each other the nearer is painted last, from wherever they are seen.
static void check_order(void) {
    ovoid_shape *plate = ovoid_shape_create_box((ovoid_vec3){5, 5, 0.1}, NULL, NULL);
    ovoid_shape *cube = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    // The cube lies on one end of the plate; from above its centre is farther away than the plate's when seen aslant.
    ovoid_picture_body bodies[2] = {make_body(NULL, plate, 0, 0, 0), make_body(NULL, cube, -4, 0, 1.3)};
    ovoid_picture picture = {.bodies = bodies, .body_count = 2};
    for (int side = -1; side <= 1; side += 2) {
        ovoid_picture_options options = {.view = {3, 0.1, side}, .layers = OVOID_PICTURE_INNER};
        size_t size;
        char *text = draw(&picture, &options, &size);
        const char *first = strstr(text, "url(#g0)"), *second = strstr(text, "url(#g1)");
        CHECK(first && second && (side > 0 ? first < second : second < first));
        free(text);
    }
    ovoid_shape_destroy(plate);
    ovoid_shape_destroy(cube);
}

// What rests on a plate is painted after it, seen from above, and before it, seen from below: also where the two touch
// or a rounding error overlaps them, and though the centre of the plate is nearer to the eye.
static void check_resting(void) {
    ovoid_shape *plate = ovoid_shape_create_box((ovoid_vec3){400, 300, 10}, NULL, NULL);
    ovoid_shape *crate = ovoid_shape_create_box((ovoid_vec3){50, 50, 50}, NULL, NULL);
    static const double heights[] = {50, 50 - 1e-12, 49.9, 50.1};
    for (int i = 0; i < 8; i++) {
        ovoid_picture_body bodies[2] = {make_body(NULL, plate, 0, 0, -10),
                                        make_body(NULL, crate, 0, 0, heights[i / 2])};
        double side = i % 2 ? -1 : 1;
        bodies[1].pose.position.x = -200 * side;
        ovoid_picture picture = {.bodies = bodies, .body_count = 2};
        ovoid_picture_options options = {.view = {1, -1.6, 0.9 * side}, .layers = OVOID_PICTURE_INNER};
        for (int swap = 0; swap < 2; swap++) {
            size_t size;
            char *text = draw(&picture, &options, &size);
            const char *first = strstr(text, swap ? "url(#g1)" : "url(#g0)");
            const char *second = strstr(text, swap ? "url(#g0)" : "url(#g1)");
            CHECK(first && second && (side > 0 ? first < second : second < first));
            free(text);
            ovoid_picture_body moved = bodies[0];
            bodies[0] = bodies[1];
            bodies[1] = moved;
        }
    }
    ovoid_shape_destroy(plate);
    ovoid_shape_destroy(crate);
}

// The pieces of faces that areas give, counted in pictures from opposite sides: each face is seen in one of them. The
// truth is the core's own count, made independently of pictures.
static void check_areas(void) {
    double points[3 * 40];
    uint64_t s = 19;
    for (int i = 0; i < 40; i++) {
        points[3 * i] = random_normal(&s);
        points[3 * i + 1] = 2 * random_normal(&s) + points[3 * i];
        points[3 * i + 2] = 0.5 * random_normal(&s) - points[3 * i];
    }
    ovoid_shape *shape = ovoid_shape_create_from_points(points, 40, NULL, NULL);
    ovoid_picture_body body = make_body(NULL, shape, 1, 2, 3);
    body.pose.rotation = (ovoid_quat){1, 0.5, -0.3, 0.2};
    ovoid_picture picture = {.bodies = &body, .body_count = 1};
    size_t found = 0;
    for (int side = -1; side <= 1; side += 2) {
        ovoid_picture_options options = {.view = {side, 2 * side, 0.7 * side}, .layers = OVOID_PICTURE_AREAS};
        size_t size;
        char *text = draw(&picture, &options, &size);
        // The last group of faces is the front; its paths begin a piece with M.
        const char *group = text, *next;
        while ((next = strstr(group + 1, "<g opacity="))) group = next;
        const char *end = strstr(group, "</g>");
        for (const char *c = group; c < end; c++) found += *c == 'M';
        free(text);
    }
    ovoid_polytope polytope = ovoid_shape_get_polytope(shape);
    ovoid_ellipsoid inner = ovoid_shape_get_inner(shape).ellipsoid;
    ovoid_split_counts counts = ovoid_polytope_compute_split(&polytope, &inner);
    CHECK_EQ(found, counts.pieces);
    CHECK(counts.pieces > counts.faces);
    ovoid_shape_destroy(shape);
}

// Every kind of body, every layer, hostile names, links with and without an answer.
static void check_kinds(void) {
    const double points[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
    ovoid_shape_options rounded = {.radius = 0.2};
    ovoid_shape *shapes[] = {ovoid_shape_create_from_points(points, 1, NULL, NULL),
                             ovoid_shape_create_from_points(points, 2, NULL, NULL),
                             ovoid_shape_create_from_points(points, 4, NULL, NULL),
                             ovoid_shape_create_sphere(0.5, NULL, NULL),
                             ovoid_shape_create_capsule(0.3, 1, NULL, NULL),
                             ovoid_shape_create_from_points(points, 4, &rounded, NULL),
                             ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, &rounded, NULL),
                             ovoid_shape_create_pyramid(&(ovoid_prism){1, 1, 7}, NULL, NULL)};
    enum { COUNT = sizeof shapes / sizeof *shapes };
    static const char *const names[COUNT] = {"<&>\"'", "\xff\x01x", "\xc3\xa4", "",
                                             "a b",    "]]>",       NULL,       "long name of a body"};
    ovoid_picture_body bodies[COUNT];
    for (int i = 0; i < COUNT; i++) bodies[i] = make_body(names[i], shapes[i], 3 * i, i % 3, 0.3 * i);
    ovoid_answer answers[3];
    memset(answers, 0, sizeof answers);
    answers[0].point_b = (ovoid_vec3){1, 2, 3};
    answers[0].lower = answers[0].upper = 3.7;
    answers[1].upper = INFINITY; // nothing to draw
    answers[2].point_a.x = NAN;
    ovoid_picture_link links[3] = {{0, 1, &answers[0]}, {1, 2, &answers[1]}, {2, 3, &answers[2]}};
    ovoid_picture picture = {bodies, COUNT, links, 3, "Title <&>", "m"};
    // All by default, each alone, all, all but one.
    static const uint32_t sets[] = {0, 1, 2, 4, 8, 16, 32, 63, 61};
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        uint32_t layers = sets[i];
        ovoid_picture_options options = {.layers = layers, .view = {layers % 3 - 1.0, layers % 5 - 2.0, layers % 2}};
        size_t size;
        char *text = draw(&picture, &options, &size);
        check_document(text);
        if (!layers || layers & OVOID_PICTURE_WITNESS) {
            const char *witness = strstr(text, "class=\"witness\"");
            CHECK(witness && !strstr(witness + 1, "class=\"witness\"") && strstr(text, ">3.7 m<"));
        }
        if (layers & OVOID_PICTURE_NAMES) CHECK(strstr(text, "&#60;&#38;&#62;\"'") && strstr(text, "\xef\xbf\xbdx"));
        free(text);
    }
    for (int i = 0; i < COUNT; i++) ovoid_shape_destroy(shapes[i]);
}

// The label of a witness: one number where the bracket is narrow, else its ends with the decimals of the larger; a pair
// that touches is called so.
static void check_lengths(void) {
    static const struct {
        ovoid_status status;
        double lower, upper;
        const char *text;
    } cases[] = {{OVOID_TOUCHING, -2.309e-26, 2.309e-26, ">touching<"},
                 {OVOID_UNDECIDED, -0.1445, 2.371e-11, ">-0.1445 \xe2\x80\xa6 0 mm<"},
                 {OVOID_UNDECIDED, -1e-9, 12.3456, ">0 \xe2\x80\xa6 12.35 mm<"},
                 {OVOID_SEPARATED, 0.01234567, 1.5, ">0.012 \xe2\x80\xa6 1.5 mm<"},
                 {OVOID_SEPARATED, 2.00001, 2.00002, ">2 mm<"},
                 {OVOID_OVERLAPPING, -3, -0.00011, ">depth 0 \xe2\x80\xa6 3 mm<"},
                 {OVOID_SEPARATED, 1e-30, 1e-30, ">1e-30 mm<"},
                 {OVOID_UNDECIDED, 0, 0, ">0 mm<"}};
    ovoid_shape *shape = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_picture_body bodies[2] = {make_body(NULL, shape, 0, 0, 0), make_body(NULL, shape, 3, 0, 0)};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        ovoid_answer answer = {.status = cases[i].status, .lower = cases[i].lower, .upper = cases[i].upper};
        ovoid_picture_link link = {0, 1, &answer};
        ovoid_picture picture = {bodies, 2, &link, 1, NULL, "mm"};
        size_t size;
        char *text = draw(&picture, NULL, &size);
        if (!CHECK(strstr(text, cases[i].text))) printf("  %s\n", cases[i].text);
        free(text);
    }
    ovoid_shape_destroy(shape);
}

// 10 000 triangles stay below 500 kilobytes: three points of at most 14 bytes each, and little else. Far from the
// origin nothing is lost.
static size_t count_text(const char *text, const char *what) {
    size_t found = 0;
    for (const char *at = strstr(text, what); at; at = strstr(at + 1, what)) found++;
    return found;
}

// Many bodies: without ellipsoids unless they are asked for, so that faces hide what is behind them; the names of
// bodies that others hide are left out, and so are those without room. Eleven of the small boxes are behind the wall.
static void check_many(void) {
    enum { COUNT = 14 };
    static const char *const names[COUNT] = {"wall", "b1", "b2", "b3",  "b4",  "b5",   "b6",
                                             "b7",   "b8", "b9", "b10", "b11", "left", "right"};
    ovoid_shape *wall = ovoid_shape_create_box((ovoid_vec3){10, 0.5, 10}, NULL, NULL);
    ovoid_shape *small = ovoid_shape_create_box((ovoid_vec3){0.5, 0.5, 0.5}, NULL, NULL);
    ovoid_picture_body bodies[COUNT];
    bodies[0] = make_body(names[0], wall, 0, -5, 0);
    for (int i = 1; i < COUNT; i++)
        bodies[i] = make_body(names[i], small, i < 12 ? 1.5 * (i - 6) : i == 12 ? -15 : 15, 0, 0);
    ovoid_picture picture = {.bodies = bodies, .body_count = COUNT};
    ovoid_picture_options options = {.view = {0, -1, 0}};
    size_t size;
    char *text = draw(&picture, &options, &size);
    check_document(text);
    CHECK(strstr(text, ">wall<") && strstr(text, ">left<") && strstr(text, ">right<") && !strstr(text, ">b1<"));
    CHECK_EQ(count_text(text, ">b"), 0);
    CHECK_EQ(count_text(text, "ellipsoid<"), 0);
    CHECK_EQ(count_text(text, "dasharray"), 0);
    free(text);
    // Twelve bodies have ellipsoids; all at one place, there is room for some names only.
    for (int i = 1; i < 12; i++) bodies[i] = make_body("a long name of a body", small, 0, 0, 0);
    picture.body_count = 12;
    text = draw(&picture, &options, &size);
    CHECK_EQ(count_text(text, "ellipsoid<"), 2);
    options.layers = OVOID_PICTURE_NAMES;
    picture.bodies = bodies + 1;
    picture.body_count = 11;
    options.width = options.height = 300;
    free(text);
    text = draw(&picture, &options, &size);
    CHECK(count_text(text, "a long name") >= 1 && count_text(text, "a long name") <= 6);
    free(text);
    ovoid_shape_destroy(wall);
    ovoid_shape_destroy(small);
}

// A mesh in the place of its hull: one path a face, those that look away first, whichever way the faces are turned; an
// octahedron has eight, four of them toward an eye above.
static void check_mesh(void) {
    static const double xyz[] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    static const uint32_t sizes[8] = {3, 3, 3, 3, 3, 3, 3, 3};
    uint32_t indices[24];
    for (uint32_t i = 0; i < 8; i++) {
        const uint32_t corner[3] = {i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2)};
        int is_odd = (i & 1) ^ (i >> 1 & 1) ^ (i >> 2);
        for (uint32_t k = 0; k < 3; k++) indices[3 * i + k] = corner[is_odd ? 2 - k : k];
    }
    ovoid_shape *hull = ovoid_shape_create_from_points(xyz, 6, NULL, NULL);
    ovoid_picture_body body = make_body("mesh", hull, 3, 2, 1);
    const ovoid_faces faces = {xyz, 6, indices, sizes, 8};
    body.mesh = &faces;
    ovoid_picture picture = {.bodies = &body, .body_count = 1};
    ovoid_picture_options options = {.view = {0, 0, 1}, .layers = OVOID_PICTURE_MESHES | OVOID_PICTURE_LEGEND};
    size_t size;
    char *first = NULL;
    for (int turned = 0; turned < 2; turned++) {
        for (uint32_t i = 0; i < 8 && turned; i++) {
            uint32_t swap = indices[3 * i];
            indices[3 * i] = indices[3 * i + 2];
            indices[3 * i + 2] = swap;
        }
        char *text = draw(&picture, &options, &size);
        check_document(text);
        CHECK(strstr(text, ">mesh<") && !strstr(text, ">polyhedron<"));
        const char *group = strstr(text, "stroke-width=\".6\"");
        if (CHECK(group != NULL)) {
            char *end = strstr(group, "</g>");
            *end = 0;
            CHECK_EQ(count_text(group, "<path"), 8);
        }
        if (turned) free(text);
        if (!turned) first = text;
    }
    free(first);
    // Without the layer, and without faces, the polyhedron.
    options.layers = OVOID_PICTURE_LEGEND;
    char *text = draw(&picture, &options, &size);
    CHECK(strstr(text, ">polyhedron<") && !strstr(text, "stroke-width=\".6\""));
    free(text);
    ovoid_shape_destroy(hull);
}

static void check_size(void) {
    enum { COUNT = 5000 };
    double *points = malloc(3 * COUNT * sizeof *points);
    uint64_t s = 7;
    for (int i = 0; i < COUNT; i++) {
        double x = random_normal(&s), y = random_normal(&s), z = random_normal(&s), r = sqrt(x * x + y * y + z * z);
        points[3 * i] = x / r;
        points[3 * i + 1] = y / r;
        points[3 * i + 2] = z / r;
    }
    ovoid_shape *shape = ovoid_shape_create_from_points(points, COUNT, NULL, NULL);
    ovoid_picture_body body = make_body("ball", shape, 1e9, -1e9, 1e9);
    ovoid_picture picture = {.bodies = &body, .body_count = 1};
    size_t size;
    char *text = draw(&picture, NULL, &size);
    check_document(text);
    CHECK_LE(size, 500000);
    CHECK_LE(100000, size);
    // The outline of a ball: as wide as high.
    box outer = read_path(text, "class=\"outer\"");
    CHECK_NEAR(outer.high_x - outer.low_x, outer.high_y - outer.low_y, 1);
    free(text);
    free(points);
    ovoid_shape_destroy(shape);
}

static void check_bad(void) {
    ovoid_shape *shape = ovoid_shape_create_box((ovoid_vec3){1, 1, 1}, NULL, NULL);
    ovoid_picture_body body = make_body("box", shape, 0, 0, 0);
    ovoid_answer answer;
    memset(&answer, 0, sizeof answer);
    ovoid_picture_link link = {0, 1, &answer};
    ovoid_picture picture = {&body, 0, NULL, 0, NULL, NULL};
    ovoid_error error = {OVOID_OK, -1, ""};
    const char *path = file_path("bad.svg");
    remove(path);
    CHECK(ovoid_picture_write_svg(path, &picture, NULL, &error) == OVOID_ERROR_EMPTY &&
          error.code == OVOID_ERROR_EMPTY);
    picture.body_count = 1;
    picture.links = &link;
    picture.link_count = 1;
    CHECK(ovoid_picture_write_svg(path, &picture, NULL, &error) == OVOID_ERROR_INDEX);
    picture.link_count = 0;
    body.pose.rotation.w = 0;
    CHECK(ovoid_picture_write_svg(path, &picture, NULL, &error) == OVOID_ERROR_ROTATION && error.place == 0);
    body.pose.rotation.w = 1;
    CHECK(ovoid_picture_write_svg(file_path("no_folder/x.svg"), &picture, NULL, &error) == OVOID_ERROR_FILE);
    size_t size;
    CHECK(file_read(path, &size) == NULL);
    ovoid_shape_destroy(shape);
}

// A stream receives the bytes of the file, and what it does not take is an error.
static void check_stream(void) {
    ovoid_shape *shape = ovoid_shape_create_box((ovoid_vec3){1, 2, 3}, NULL, NULL);
    ovoid_picture_body body = make_body("box", shape, 0, 0, 0);
    ovoid_picture picture = {.bodies = &body, .body_count = 1};
    ovoid_error error = {OVOID_OK, -1, ""};
    size_t size;
    char *wanted = draw(&picture, NULL, &size);
    FILE *file = fopen(file_path("stream.svg"), "wb");
    CHECK(file && ovoid_picture_write_stream(file, &picture, NULL, &error) == OVOID_OK);
    if (file) fclose(file);
    char *text = file_read(file_path("stream.svg"), &size);
    CHECK(text && strcmp(text, wanted) == 0);
    file = fopen("/dev/full", "wb");
    if (file) CHECK(ovoid_picture_write_stream(file, &picture, NULL, &error) == OVOID_ERROR_FILE);
    if (file) fclose(file);
    picture.body_count = 0;
    CHECK(ovoid_picture_write_stream(stdout, &picture, NULL, &error) == OVOID_ERROR_EMPTY);
    free(text);
    free(wanted);
    ovoid_shape_destroy(shape);
}

// A segment is drawn from end to end, though a vertex off it by less than rounding is the first or the last.
static void check_nearly_straight(void) {
    const double ends[6] = {0, 0, 0, 39, 0, 0};
    const double bent[2][9] = {{0, 0, 0, 39, 0, 0, 1, 1e-20, 0}, {1, 1e-20, 0, 0, 0, 0, 39, 0, 0}};
    ovoid_shape *straight = ovoid_shape_create_from_points(ends, 2, NULL, NULL);
    ovoid_picture_body body = make_body("", straight, 0, 0, 0);
    ovoid_picture picture = {.bodies = &body, .body_count = 1};
    size_t size;
    char *wanted = draw(&picture, NULL, &size);
    for (int i = 0; i < 2; i++) {
        body.shape = ovoid_shape_create_from_points(bent[i], 3, NULL, NULL);
        char *text = draw(&picture, NULL, &size);
        CHECK(strcmp(text, wanted) == 0);
        free(text);
        ovoid_shape_destroy((ovoid_shape *)(uintptr_t)body.shape);
    }
    free(wanted);
    ovoid_shape_destroy(straight);
}

int main(void) {
    check_extents();
    check_order();
    check_resting();
    check_areas();
    check_kinds();
    check_lengths();
    check_size();
    check_many();
    check_mesh();
    check_bad();
    check_stream();
    check_nearly_straight();
    return check_end();
}
