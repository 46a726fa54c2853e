// Results with one number altered. Right answers of every kind of proof are written as lines of a results file; then
// every number of every line is altered in every digit, its sign and its exponent, one at a time, and the line goes the
// way of `ovoid verify`: the strict reader, the judge, the judge of the points. docs/proofs.md says which digits
// matter.
//
// Truth, by other means than the judge's proofs: brute force over all features gives d; plain doubles measure what the
// altered proof shows, to within 1000 roundings of the pair's size. So
// - what is accepted is true: lower <= d <= upper, and the status follows;
// - a bound that its proof misses by more than those roundings, points that are off by more than the bracket and the
//   tolerance leave open, a normal that is off by 3e-12 are refused;
// - a bound that claims less, a point that moved within rounding, a count of iterations are accepted.
#define _POSIX_C_SOURCE 200809L // open_memstream
#include "files.h"
#include "judge.h"
#include "proofs/covers.h"

enum { SHAPES = 6, LINE_SIZE = 1 << 17 };

static ovoid_shape *shapes[SHAPES];
static judge *the_judge;

/// What is known about the present pair.
typedef struct known {
    ovoid_pair pair;
    judge_truth truth;
    double size, radii;
    ovoid_record right;
    int has_points; ///< the points are to differ by d normal
} known;

static known k;
STATIC_COVER(cover);

/// Counts of one field: altered lines, of these refused by the reader or the judge.
typedef struct field_count {
    char name[24];
    long altered, refused;
} field_count;

static field_count counts[40];
static size_t field_total;

// ---- measuring in doubles

static ovoid_vec3 add(ovoid_vec3 a, ovoid_vec3 b, double s) {
    return (ovoid_vec3){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}
static double dot(ovoid_vec3 a, ovoid_vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static double norm(ovoid_vec3 a) { return sqrt(dot(a, a)); }

// Relative to A's position, so that nothing is lost far from the origin.
static ovoid_vec3 find_vertex(int of_b, uint32_t i) {
    const ovoid_shape *shape = of_b ? k.pair.shape_b : k.pair.shape_a;
    ovoid_pose pose = of_b ? k.pair.pose_b : k.pair.pose_a;
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    const double *v = p.vertices + 3 * (size_t)i;
    pose.position = add(pose.position, k.pair.pose_a.position, -1);
    return ovoid_pose_compute_point(&pose, (ovoid_vec3){p.origin.x + v[0], p.origin.y + v[1], p.origin.z + v[2]});
}

// Of any length: a proof's normal need not be a unit.
static ovoid_vec3 unit(ovoid_vec3 a) {
    ovoid_vec3 zero = {0, 0, 0}, small = add(zero, a, 1 / fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z))));
    return add(zero, small, 1 / norm(small));
}

static double measure_gap(ovoid_vec3 direction) {
    ovoid_vec3 n = unit(direction);
    double least = INFINITY, largest = -INFINITY;
    for (uint32_t i = 0; i < ovoid_shape_get_polytope(k.pair.shape_a).vertex_count; i++)
        largest = fmax(largest, dot(n, find_vertex(0, i)));
    for (uint32_t i = 0; i < ovoid_shape_get_polytope(k.pair.shape_b).vertex_count; i++)
        least = fmin(least, dot(n, find_vertex(1, i)));
    return least - largest - k.radii;
}

// The distance that a proof by points shows; infinite where it shows nothing.
static double measure_points(const ovoid_proof *p) {
    ovoid_vec3 a = {0, 0, 0}, b = {0, 0, 0};
    double sum_a = 0, sum_b = 0;
    for (uint32_t i = 0; i < p->count; i++) {
        if (p->a[i] >= ovoid_shape_get_polytope(k.pair.shape_a).vertex_count ||
            p->b[i] >= ovoid_shape_get_polytope(k.pair.shape_b).vertex_count)
            return INFINITY;
        a = add(a, find_vertex(0, p->a[i]), p->weight_a[i]);
        b = add(b, find_vertex(1, p->b[i]), p->weight_b[i]);
        sum_a += p->weight_a[i];
        sum_b += p->weight_b[i];
    }
    ovoid_vec3 zero = {0, 0, 0};
    return norm(add(add(zero, b, 1 / sum_b), a, -1 / sum_a)) - k.radii;
}

static double distance_of(ovoid_vec3 a, ovoid_vec3 b) { return norm(add(a, b, -1)); }

// ---- what must become of an altered answer

static int is_false(const ovoid_answer *x) {
    if (!(x->lower <= k.truth.high && x->upper >= k.truth.low)) return 1;
    if (x->lower > 0 && k.truth.sign <= 0) return 1;
    return x->upper < 0 && k.truth.sign >= 0;
}

static int is_status_wrong(const ovoid_answer *x) {
    return (x->status == OVOID_SEPARATED) != (x->lower > 0) || (x->status == OVOID_OVERLAPPING) != (x->upper < 0);
}

// What the bracket and the tolerance leave open of the points, twice.
static double find_freedom(const ovoid_answer *x) {
    double width = x->upper - x->lower, d = fmax(fabs(x->lower), fabs(x->upper));
    return 2 * (width + sqrt(width * (width + 2 * d)) + 1e-9 * k.size);
}

static int must_be_refused(const ovoid_answer *x) {
    const ovoid_answer *right = &k.right.answer;
    double slack = 1000 * 0x1p-53 * k.size;
    ovoid_vec3 n = add(x->proof.normal, x->proof.normal_low, 1);
    if (is_false(x) || is_status_wrong(x) || !(x->lower <= x->upper)) return 1;
    if (!(measure_gap(n) >= x->lower - slack)) return 1;
    if (x->proof.kind == OVOID_PROOF_POINTS && !(measure_points(&x->proof) <= x->upper + slack)) return 1;
    // The direction of the proof, whatever its length, is the normal, of length 1.
    if (!(fabs(norm(x->normal) - 1) <= 3e-12) || !(distance_of(x->normal, unit(n)) <= 3e-12)) return 1;
    double moved = distance_of(x->point_a, right->point_a) + distance_of(x->point_b, right->point_b);
    return moved > 2 * k.size || (k.has_points && moved > find_freedom(x));
}

// Less is claimed than before, or nothing else.
static int must_be_accepted(const char *field, const ovoid_answer *x) {
    const ovoid_answer *right = &k.right.answer;
    if (strcmp(field, "iterations") == 0) return 1;
    if (is_status_wrong(x)) return 0;
    if (strcmp(field, "lower") == 0 || strcmp(field, "upper") == 0) {
        if (x->status == OVOID_TOUCHING) return 0;                // as narrow as it was
        int is_finite = isfinite(x->lower) && isfinite(x->upper); // of a distance both are known
        return is_finite && x->lower <= right->lower && x->upper >= right->upper;
    }
    if (strcmp(field, "point_a") == 0 || strcmp(field, "point_b") == 0)
        return distance_of(x->point_a, right->point_a) + distance_of(x->point_b, right->point_b) <=
               8 * 0x1p-53 * k.size;
    return 0;
}

static void count_field(const char *field, int refused) {
    size_t i = 0;
    while (i < field_total && strcmp(counts[i].name, field) != 0) i++;
    if (i == field_total && field_total < 40) snprintf(counts[field_total++].name, 24, "%s", field);
    counts[i].altered++;
    counts[i].refused += refused;
}

// The next line of the reader, as `ovoid verify` looks at it. 1 where it is accepted; *record: what it said.
static int verify_next(ovoid_results_reader *reader, ovoid_record *record, ovoid_error *error) {
    int accepted = ovoid_results_reader_read(reader, record, error) == 1 &&
                   judge_verify_answer(the_judge, &k.pair, &record->answer, record->cover, error) == OVOID_OK;
    if (accepted && k.has_points) accepted = !judge_verify_points(the_judge, &k.pair, &record->answer, error);
    return accepted;
}

static void check_next(ovoid_results_reader *reader, const char *field) {
    ovoid_record record = k.right;
    ovoid_error error = {OVOID_OK, -1, ""};
    int accepted = verify_next(reader, &record, &error), is_read = accepted || error.code != OVOID_ERROR_FORMAT;
    long long line = (long long)ovoid_results_reader_get_line(reader);
    count_field(field, !accepted);
    if (accepted && !CHECK(!must_be_refused(&record.answer)))
        printf("  accepted: %s, line %lld: gap %.17g lower %.17g false %d off %g\n", field, line,
               measure_gap(record.answer.proof.normal), record.answer.lower, is_false(&record.answer),
               distance_of(record.answer.normal, unit(record.answer.proof.normal)));
    if (!accepted && is_read && !CHECK(!must_be_accepted(field, &record.answer)))
        printf("  refused: %s, line %lld: %s\n", field, line, error.message);
}

/// The lines of one answer, the right one first, and which field was altered in each.
static FILE *batch;
static char (*batch_fields)[24];
static size_t batch_count, batch_capacity;

static void add_line(const char *field, const char *line, size_t size) {
    if (batch_count == batch_capacity) {
        batch_capacity = 2 * batch_capacity + 1000;
        batch_fields = realloc(batch_fields, batch_capacity * sizeof *batch_fields);
        if (!batch_fields) exit(2);
    }
    snprintf(batch_fields[batch_count++], sizeof *batch_fields, "%s", field);
    if (fwrite(line, 1, size, batch) != size) exit(2);
}

static void check_batch(const char *path) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_results_reader *reader = ovoid_results_reader_open(path, &error);
    ovoid_record record;
    if (!CHECK(reader)) exit(1);
    if (!CHECK(verify_next(reader, &record, &error))) printf("  right, and refused: %s\n", error.message);
    for (size_t i = 1; i < batch_count; i++) check_next(reader, batch_fields[i]);
    CHECK_EQ(ovoid_results_reader_read(reader, &record, &error), 0);
    ovoid_results_reader_close(reader);
}

// ---- altering a number

/// A number in a line, and the key it stands behind.
typedef struct number {
    size_t at, size;
    char field[24];
} number;

// The next number at or behind `at`; 0 if there is none. *field keeps the last key, "p." before it in the proof.
static int find_number(const char *line, size_t at, number *n, int *in_proof) {
    for (; line[at]; at++) {
        if (line[at] == '"') {
            size_t end = at + 1;
            while (line[end] != '"') end++;
            if (line[end + 1] == ':') {
                snprintf(n->field, sizeof n->field, "%s%.*s", *in_proof ? "p." : "", (int)(end - at - 1),
                         line + at + 1);
                *in_proof |= strcmp(n->field, "proof") == 0;
            }
            at = end;
        } else if (line[at] == '-' || (line[at] >= '0' && line[at] <= '9')) {
            n->at = at;
            n->size = strspn(line + at, "-+0123456789.eE");
            return 1;
        }
    }
    return 0;
}

// The line with another text in the number's place.
static void check_replaced(const char *line, const number *n, const char *text) {
    static char altered[LINE_SIZE];
    int size = snprintf(altered, sizeof altered, "%.*s%s%s", (int)n->at, line, text, line + n->at + n->size);
    if (size > 0 && (size_t)size < sizeof altered) add_line(n->field, altered, (size_t)size);
}

static void check_digits(const char *line, const number *n) {
    char text[64];
    size_t mantissa = 0;
    for (; mantissa < n->size && line[n->at + mantissa] != 'e'; mantissa++) {
        char digit = line[n->at + mantissa];
        if (digit < '0' || digit > '9') continue;
        for (int step = 1; step < 10; step += 4) { // by 1, 5 and 9, which is back by 1
            snprintf(text, sizeof text, "%.*s", (int)n->size, line + n->at);
            text[mantissa] = (char)('0' + (digit - '0' + step) % 10);
            // A number does not begin with a zero.
            size_t first = text[0] == '-';
            if (text[first] == '0' && text[first + 1] >= '0' && text[first + 1] <= '9') continue;
            check_replaced(line, n, text);
        }
    }
}

static void check_number(const char *line, const number *n) {
    char text[64];
    check_digits(line, n);
    // The sign; ten times as much and a tenth; nothing; no number at all.
    if (line[n->at] == '-')
        snprintf(text, sizeof text, "%.*s", (int)n->size - 1, line + n->at + 1);
    else
        snprintf(text, sizeof text, "-%.*s", (int)n->size, line + n->at);
    if (strspn(text, "-0.") < strlen(text)) check_replaced(line, n, text); // -0 is 0
    double value = strtod(line + n->at, NULL);
    const double others[] = {value * 10, value / 10, value * 1e300, value * 1e-300, value + 1, value - 1};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        snprintf(text, sizeof text, "%.17g", others[i]);
        if (isfinite(others[i]) && others[i] != value) check_replaced(line, n, text);
    }
    check_replaced(line, n, "null");
}

// ---- the lines

static double find_extent(const ovoid_shape *shape) {
    ovoid_polytope p = ovoid_shape_get_polytope(shape);
    double extent = 0;
    for (uint32_t i = 0; i < p.vertex_count; i++)
        extent = fmax(extent, norm((ovoid_vec3){p.vertices[3 * i], p.vertices[3 * i + 1], p.vertices[3 * i + 2]}));
    return extent;
}

static void find_known(void) {
    if (!CHECK(judge_compute_truth(the_judge, &k.pair, &k.truth, NULL) == OVOID_OK)) exit(1);
    k.radii = ovoid_shape_get_radius(k.pair.shape_a) + ovoid_shape_get_radius(k.pair.shape_b);
    k.size = find_extent(k.pair.shape_a) + find_extent(k.pair.shape_b) + k.radii +
             distance_of(k.pair.pose_a.position, k.pair.pose_b.position);
    // Points far from the origin are rounded there.
    k.size +=
        16 * fmax(norm(k.pair.pose_a.position), norm(k.pair.pose_b.position)) * (norm(k.pair.pose_a.position) > 1e3);
}

// Alters one right answer. stride: every which number of it (covers have hundreds).
static void check_answer(ovoid_answer answer, const ovoid_cover *shown, int has_points, size_t stride) {
    char *line = NULL;
    size_t size = 0;
    const char *path = file_path("altered.jsonl");
    k.right = (ovoid_record){.answer = answer, .cover = shown && shown->point_count ? shown : NULL};
    k.has_points = has_points && answer.proof.kind != OVOID_PROOF_HULL && answer.proof.kind != OVOID_PROOF_INNER;
    FILE *file = open_memstream(&line, &size);
    if (!file || ovoid_record_write_json(file, &k.right) || fclose(file)) exit(2);
    batch = fopen(path, "wb");
    if (!batch) exit(2);
    batch_count = 0;
    add_line("", line, size);
    number n = {0, 0, ""};
    int in_proof = 0;
    for (size_t i = 0; find_number(line, n.at + n.size, &n, &in_proof); i++) {
        int is_body = strcmp(n.field, "a") == 0 || strcmp(n.field, "b") == 0; // the tool's matter: test_cli_altered.sh
        int is_cover = strcmp(n.field, "p.pairs") == 0 || strcmp(n.field, "p.triangles") == 0;
        if (!is_body && (!is_cover || i % stride == 0)) check_number(line, &n);
    }
    free(line);
    if (fclose(batch)) exit(2);
    check_batch(path);
}

static void check_pair(ovoid_pair pair) {
    k.pair = pair;
    find_known();
    check_answer(ovoid_collide(&pair, NULL, NULL), NULL, 0, 1);
    check_answer(ovoid_distance(&pair, NULL, NULL), NULL, k.truth.sign > 0, 1);
    check_answer(ovoid_depth(&pair, NULL, NULL, &cover), &cover, 1, 7);
    check_answer(ovoid_pair_compute_bounds(&pair), NULL, 0, 1);
}

static void make_shapes(void) {
    static const double tetra[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, flat[] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0};
    static const double octa[] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1}, rod[] = {0, 0, -1, 0, 0, 1};
    ovoid_shape_options round = {.radius = 0.25};
    shapes[0] = ovoid_shape_create_box((ovoid_vec3){1, 0.5, 0.75}, NULL, NULL);
    shapes[1] = ovoid_shape_create_from_points(tetra, 4, NULL, NULL);
    shapes[2] = ovoid_shape_create_from_points(tetra, 4, &round, NULL);
    shapes[3] = ovoid_shape_create_from_points(flat, 4, NULL, NULL);
    shapes[4] = ovoid_shape_create_from_points(octa, 6, NULL, NULL);
    shapes[5] = ovoid_shape_create_from_points(rod, 2, &round, NULL);
    for (int i = 0; i < SHAPES; i++)
        if (!CHECK(shapes[i])) exit(1);
}

static ovoid_pose pose_at(double x, double y, double z, ovoid_quat q) { return (ovoid_pose){{x, y, z}, q}; }

static void check_pairs(void) {
    ovoid_pose here = ovoid_pose_make_identity();
    ovoid_quat none = {1, 0, 0, 0}, turn = {3, 1, -2, 1}, half = {1, 1, 0, 0};
    check_pair((ovoid_pair){shapes[0], shapes[1], here, pose_at(3, 1, 0.5, turn)});                         // apart
    check_pair((ovoid_pair){shapes[0], shapes[0], here, pose_at(2, 0, 0, none)});                           // touching
    check_pair((ovoid_pair){shapes[0], shapes[4], pose_at(0.25, 0, 0, turn), pose_at(0.5, 0.25, 0, half)}); // deep
    check_pair((ovoid_pair){shapes[4], shapes[4], here, here});                          // six points hold the centre
    check_pair((ovoid_pair){shapes[2], shapes[2], here, pose_at(1.125, 0.5, 0, turn)});  // rounded
    check_pair((ovoid_pair){shapes[5], shapes[2], here, pose_at(1, 0.25, 0.125, turn)}); // a capsule
    check_pair((ovoid_pair){shapes[3], shapes[1], here, pose_at(1, 1, -0.125, half)});   // flat
    // Far from the origin.
    check_pair((ovoid_pair){shapes[4], shapes[0], pose_at(1e7, -1e7, 3e6, turn), pose_at(1e7 + 1, -1e7, 3e6, half)});
    check_pair((ovoid_pair){shapes[0], shapes[1], pose_at(1e7, 2e7, -3e7, turn), pose_at(1e7, 2e7, 5 - 3e7, half)});
}

int main(void) {
    the_judge = judge_create();
    if (!CHECK(the_judge)) return check_end();
    make_shapes();
    check_pairs();
    printf("%-16s %8s %8s\n", "field", "altered", "refused");
    for (size_t i = 0; i < field_total; i++)
        printf("%-16s %8ld %8ld\n", counts[i].name, counts[i].altered, counts[i].refused);
    free(batch_fields);
    judge_destroy(the_judge);
    for (int i = 0; i < SHAPES; i++) ovoid_shape_destroy(shapes[i]);
    return check_end();
}
