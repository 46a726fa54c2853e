// What `ovoid verify` does, on proofs that were tampered with: a right answer of one of several pairs is changed as the
// bytes say, written as a line of results, read again and put before both checkers. Truth: brute force over all
// features in exact arithmetic. Whatever is accepted must be true.
#define _POSIX_C_SOURCE 200809L // open_memstream
#include "take.h"

#include <ovoid/io.h>

#ifdef OVOID_HAVE_JUDGE

#include <judge.h>

enum { PAIRS = 6, QUESTIONS = 5 };

/// A pair, its right answers and the truth.
typedef struct known {
    ovoid_pair pair;
    ovoid_answer answers[QUESTIONS];
    ovoid_cover cover; ///< of the depth
    uint64_t memory[OVOID_COVER_SIZE / sizeof(uint64_t)];
    judge_truth truth;
} known;

static known world[PAIRS];
static judge *the_judge;

static ovoid_pose pose_at(double x, double y, double z, ovoid_quat q) { return (ovoid_pose){{x, y, z}, q}; }

// Apart, touching, overlapping, with radii, flat, far from the origin.
static void make_pairs(void) {
    static const double tetra[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, flat[] = {0, 0, 0, 2, 0, 0, 2, 2, 0, 0, 2, 0};
    static const double octa[] = {1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1};
    ovoid_shape_options round = {.radius = 0.25};
    ovoid_shape *box = ovoid_shape_create_box((ovoid_vec3){1, 0.5, 0.75}, NULL, NULL);
    ovoid_shape *tetrahedron = ovoid_shape_create_from_points(tetra, 4, NULL, NULL);
    ovoid_shape *rounded = ovoid_shape_create_from_points(tetra, 4, &round, NULL);
    ovoid_shape *plate = ovoid_shape_create_from_points(flat, 4, NULL, NULL);
    ovoid_shape *octahedron = ovoid_shape_create_from_points(octa, 6, NULL, NULL);
    fuzz_require(box && tetrahedron && rounded && plate && octahedron);
    ovoid_pose here = ovoid_pose_make_identity();
    ovoid_quat turn = {3, 1, -2, 1}, half = {1, 1, 0, 0};
    world[0].pair = (ovoid_pair){box, tetrahedron, here, pose_at(3, 1, 0.5, turn)};
    world[1].pair = (ovoid_pair){box, box, here, pose_at(2, 0, 0, (ovoid_quat){1, 0, 0, 0})};
    world[2].pair = (ovoid_pair){box, octahedron, pose_at(0.25, 0, 0, turn), pose_at(0.5, 0.25, 0, half)};
    world[3].pair = (ovoid_pair){rounded, rounded, here, pose_at(1.125, 0.5, 0, turn)};
    world[4].pair = (ovoid_pair){plate, tetrahedron, here, pose_at(1, 1, -0.125, half)};
    world[5].pair = (ovoid_pair){octahedron, box, pose_at(1e7, -1e7, 3e6, turn), pose_at(1e7 + 1, -1e7, 3e6, half)};
}

static void make_world(void) {
    make_pairs();
    the_judge = judge_create();
    fuzz_require(the_judge != NULL);
    for (int i = 0; i < PAIRS; i++) {
        known *k = &world[i];
        k->answers[0] = ovoid_collide(&k->pair, NULL, NULL);
        k->answers[1] = ovoid_within(&k->pair, 0.5, NULL, NULL);
        k->answers[2] = ovoid_distance(&k->pair, NULL, NULL);
        k->cover = (ovoid_cover){.memory = k->memory, .size = sizeof k->memory};
        k->answers[3] = ovoid_depth(&k->pair, NULL, NULL, &k->cover);
        k->answers[4] = ovoid_pair_compute_bounds(&k->pair);
        fuzz_require(judge_compute_truth(the_judge, &k->pair, &k->truth, NULL) == OVOID_OK);
    }
}

static void change_number(fuzz_bytes *from, ovoid_answer *x) {
    double *numbers[] = {&x->lower,           &x->upper,           &x->point_a.x,       &x->point_a.y,
                         &x->point_a.z,       &x->point_b.x,       &x->point_b.y,       &x->point_b.z,
                         &x->normal.x,        &x->normal.y,        &x->normal.z,        &x->proof.normal.x,
                         &x->proof.normal.y,  &x->proof.normal.z,  &x->proof.inner_a.x, &x->proof.inner_a.y,
                         &x->proof.inner_a.z, &x->proof.inner_b.x, &x->proof.inner_b.y, &x->proof.inner_b.z};
    unsigned place = (unsigned)take_byte(from) % 32;
    double *number = place < 20   ? numbers[place]
                     : place < 26 ? &x->proof.weight_a[place - 20]
                                  : &x->proof.weight_b[place - 26];
    int how = take_byte(from);
    if (how > 64)
        *number = take_double(from);
    else if (how > 0)
        *number *= 1 + ldexp(1, -how);
    else
        *number *= 1 - ldexp(1, how);
}

/// The cover whose arrays are altered.
typedef struct altered_cover {
    ovoid_cover cover;
    uint32_t a[OVOID_COVER_POINTS], b[OVOID_COVER_POINTS];
    uint16_t triangles[2 * OVOID_COVER_POINTS][3];
} altered_cover;

static void copy_cover(altered_cover *to, const ovoid_cover *from) {
    to->cover = *from;
    if (!from->point_count) return;
    memcpy(to->a, from->a, from->point_count * sizeof *to->a);
    memcpy(to->b, from->b, from->point_count * sizeof *to->b);
    memcpy(to->triangles, from->triangles, from->triangle_count * sizeof *to->triangles);
    to->cover.a = to->a;
    to->cover.b = to->b;
    to->cover.triangles = (const uint16_t(*)[3])to->triangles;
}

static void change_cover(fuzz_bytes *from, altered_cover *altered) {
    ovoid_cover *cover = &altered->cover;
    unsigned what = (unsigned)take_byte(from) % 6, place = (uint8_t)take_byte(from), value = (uint8_t)take_byte(from);
    if (!cover->point_count) return;
    if (what == 0) altered->a[place % cover->point_count] = value;
    if (what == 1) altered->b[place % cover->point_count] = value;
    if (what == 2 && cover->triangle_count)
        altered->triangles[place % cover->triangle_count][value % 3] = (uint16_t)place;
    if (what == 3) cover->point_count = 1 + place;
    if (what == 4) cover->triangle_count = place;
    if (what == 5) cover->triangle_count *= 2;
    if (cover->triangle_count > 2 * OVOID_COVER_POINTS) cover->triangle_count = 0;
}

static void change(fuzz_bytes *from, ovoid_answer *x, altered_cover *cover) {
    ovoid_proof *p = &x->proof;
    unsigned place;
    switch ((unsigned)take_byte(from) % 10) {
    case 4: p->kind = (ovoid_proof_kind)((unsigned)take_byte(from) % 6); break;
    case 5: p->count = (unsigned)take_byte(from) % (OVOID_PROOF_PAIRS + 1); break;
    case 6: place = (unsigned)take_byte(from) % 6, p->a[place] = (uint32_t)take_byte(from); break;
    case 7: place = (unsigned)take_byte(from) % 6, p->b[place] = (uint32_t)take_byte(from); break;
    case 8:
        x->status = (ovoid_status)((unsigned)take_byte(from) % 4);
        x->limit = (ovoid_limit)((unsigned)take_byte(from) % (OVOID_LIMIT_SHAPE_B + 1));
        break;
    case 9: change_cover(from, cover); break;
    default: change_number(from, x); break;
    }
}

// Through a file, as it is handed over. 0 where its reader refuses the line.
static int pass_through_file(ovoid_record *record, ovoid_results_reader **reader) {
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    fuzz_require(file != NULL);
    fuzz_require(ovoid_record_write_json(file, record) == OVOID_OK && fclose(file) == 0);
    ovoid_error error = {OVOID_OK, -1, ""};
    *reader = ovoid_results_reader_open(fuzz_write_file("results.jsonl", (const uint8_t *)text, size), &error);
    free(text);
    fuzz_require(*reader != NULL);
    int got = ovoid_results_reader_read(*reader, record, &error);
    fuzz_require(got != 0);
    if (got < 0) fuzz_require_error(&error);
    return got > 0;
}

static void check_claim(const known *k, const ovoid_record *record) {
    const ovoid_answer *x = &record->answer;
    ovoid_error error = {OVOID_OK, -1, ""};
    int by_judge = judge_verify_answer(the_judge, &k->pair, x, record->cover, &error) == OVOID_OK;
    if (!by_judge) fuzz_require_error(&error);
    (void)judge_verify_points(the_judge, &k->pair, x, &error);
    int by_library =
        ovoid_answer_verify(&k->pair, x, &(ovoid_answer_basis){.cover = record->cover}, &error) == OVOID_OK;
    if (!by_judge && !by_library) return;
    fuzz_require(x->lower <= k->truth.high && x->upper >= k->truth.low);
    if (x->status == OVOID_SEPARATED) fuzz_require(k->truth.sign > 0);
    if (x->status == OVOID_OVERLAPPING) fuzz_require(k->truth.sign < 0);
    if (x->lower > 0) fuzz_require(k->truth.sign > 0);
    if (x->upper < 0) fuzz_require(k->truth.sign < 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    if (!the_judge) make_world();
    fuzz_bytes from = {data, size};
    const known *k = &world[(unsigned)take_byte(&from) % PAIRS];
    static altered_cover cover; // large
    copy_cover(&cover, &k->cover);
    ovoid_record record = {.answer = k->answers[(unsigned)take_byte(&from) % QUESTIONS], .cover = &cover.cover};
    while (from.size) change(&from, &record.answer, &cover);
    ovoid_results_reader *reader;
    if (pass_through_file(&record, &reader)) check_claim(k, &record);
    ovoid_results_reader_close(reader);
    return 0;
}

#else

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    (void)data, (void)size;
    return 0;
}

#endif
