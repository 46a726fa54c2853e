// Pages of scenes: at rest, in motion, or of files without a scene.
#include "page/scenes.h"

#include "pairs/solids.h"

#include "base/message.h"
#include "page/pairs.h"

#include <math.h>
#include <stdlib.h>

// ---- at rest

/// Begins the file with the head and the bodies. 0, or an exit code after a message.
static int begin(cli_page *page, const page_head *head, const page_body *bodies, const page_choice *choice) {
    int code = page_begin(page, head);
    return code ? code : page_write_bodies(page, bodies, choice);
}

int page_write_scene(cli_page *page, const char *title, const answers_job *job) {
    if (!page->path) return 0;
    const page_couples couples = {job->couples, job->stride, job->count};
    const page_head head = {title, NULL, ovoid_scene_get_unit(job->scene), job->margin};
    page_choice choice;
    page_body *bodies = page_bodies_list(job->scene);
    if (!bodies) return EXIT_INPUT;
    int code = page_choose(page, ovoid_scene_get_count(job->scene), &couples, &choice);
    if (!code) {
        code = begin(page, &head, bodies, &choice);
        if (!code) {
            page_pairs list = page_pairs_begin(page, &choice);
            code = page_pairs_add(&list, job, choice.pairs, choice.pair_count);
            page_pairs_end(&list);
        }
        code = page_end(page, code);
        page_choice_clear(&choice);
    }
    free(bodies);
    return code;
}

static ovoid_body get_body(const page_body *b) {
    return b->solid ? (ovoid_body){.solid = b->solid, .pose = b->body.pose} : b->body;
}

static ovoid_mesh_kind get_kind(const page_body *b) {
    return b->body.compound ? OVOID_MESH_PARTS : solids_get_kind(b->solid);
}

/// Answers and writes the one pair of two bodies. 0, or EXIT_INPUT after a message.
static int write_pair(page_pairs *list, const page_bodies_source *source) {
    const page_body *b = source->bodies;
    const ovoid_body_pair pair = {get_body(&b[0]), get_body(&b[1])};
    const answers_query query = {.query = QUERY_DISTANCE, .margin = source->margin, .wants_proof = 1};
    ovoid_record record = {.a = b[0].name,
                           .b = b[1].name,
                           .fields = OVOID_RECORD_PARTS | (source->margin >= 0 ? OVOID_RECORD_MARGIN : 0),
                           .margin = source->margin,
                           .frame = NAN,
                           .kind_a = get_kind(&b[0]),
                           .kind_b = get_kind(&b[1]),
                           .mesh_a = b[0].convexity,
                           .mesh_b = b[1].convexity};
    answer_room room = {.cover = {.memory = NULL}};
    int code = EXIT_INPUT;
    if (answers_find(&room, &pair, &query, &record))
        code = page_pairs_add_record(list, (ovoid_couple){0, 1}, &record);
    else
        message_error("out of memory");
    answer_room_clear(&room);
    return code;
}

int page_write_files(cli_page *page, const page_bodies_source *source) {
    if (!page->path) return 0;
    const page_body *bodies = source->bodies;
    const page_head head = {bodies[0].mesh.path, source->count > 1 ? bodies[1].mesh.path : NULL, source->unit,
                            source->margin};
    const page_couples none = {NULL, 0, 0};
    page_choice choice;
    int code = page_choose(page, source->count, &none, &choice);
    if (code) return code;
    code = begin(page, &head, bodies, &choice);
    if (!code) {
        page_pairs list = page_pairs_begin(page, &choice);
        if (source->count > 1) code = write_pair(&list, source);
        page_pairs_end(&list);
    }
    code = page_end(page, code);
    page_choice_clear(&choice);
    return code;
}

// ---- in motion

static int compare_nearest(const void *a, const void *b) {
    const track_pair *p = a, *q = b;
    if (p->lowest != q->lowest) return p->lowest < q->lowest ? -1 : 1;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : p->b > q->b;
}

/// Writes the pairs, those of one frame after those of another. 0, or an exit code after a message.
static int write_frames(cli_page *page, const answers_job *job, const page_run *run, const page_choice *choice) {
    const page_motion *m = run->motion;
    page_pairs list = page_pairs_begin(page, choice);
    int code = 0;
    for (size_t first = 0, end; first < choice->pair_count && !code; first = end) {
        size_t frame = page_motion_find_frame(m, run->track->pairs[choice->pairs[first].given].lowest_frame);
        for (end = first + 1; end < choice->pair_count; end++)
            if (page_motion_find_frame(m, run->track->pairs[choice->pairs[end].given].lowest_frame) != frame) break;
        answers_job at = *job;
        at.poses = m->poses + frame * m->object_count;
        list.frame = frame;
        code = page_pairs_add(&list, &at, choice->pairs + first, end - first);
    }
    page_pairs_end(&list);
    return code;
}

/// The pairs' couples, the nearest first; NULL after a message.
static ovoid_couple *sort_pairs(const cli_track *track) {
    ovoid_couple *couples = malloc((track->pair_count + 1) * sizeof *couples);
    if (!couples) return message_error("out of memory"), NULL;
    if (track->pair_count) qsort(track->pairs, track->pair_count, sizeof *track->pairs, compare_nearest);
    for (size_t i = 0; i < track->pair_count; i++) couples[i] = (ovoid_couple){track->pairs[i].a, track->pairs[i].b};
    return couples;
}

int page_write_run(cli_page *page, const char *title, const answers_job *job, const page_run *run) {
    if (!page->path) return 0;
    if (run->track->is_full)
        return message_error("--html: too many pairs for the memory; give a smaller --margin"), EXIT_INPUT;
    page_motion_add_firsts(run->motion, run->track);
    int code = page_motion_finish(run->motion);
    if (code) return code;
    const page_head head = {title, NULL, ovoid_scene_get_unit(job->scene), job->margin};
    ovoid_couple *pairs = sort_pairs(run->track);
    page_body *bodies = pairs ? page_bodies_list(job->scene) : NULL;
    const page_couples couples = {pairs, sizeof *pairs, run->track->pair_count};
    page_choice choice = {.numbers = NULL};
    if (!bodies) code = EXIT_INPUT;
    if (!code) code = page_choose(page, ovoid_scene_get_count(job->scene), &couples, &choice);
    if (!code) {
        code = begin(page, &head, bodies, &choice);
        if (!code) code = write_frames(page, job, run, &choice);
        if (!code) page_motion_write(page, run->motion, &choice, run->margin);
        code = page_end(page, code);
    }
    page_choice_clear(&choice);
    free(bodies);
    free(pairs);
    return code;
}
