// The results that ovoid verify reads, and the bodies that each of them names: of a scene, which may move, of a list
// with pairs, or two.
#include "verify.h"

#include "base/covers.h"
#include "base/message.h"
#include "pairs/answers.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void verify_close_bodies(body_source *bodies) {
    frames_close(&bodies->frames);
    ovoid_scene_destroy(bodies->scene);
    ovoid_pairs_reader_close(bodies->pairs);
    ovoid_shapes_destroy(bodies->list);
    inputs_close_body(&bodies->bodies[0]);
    inputs_close_body(&bodies->bodies[1]);
}

/// Opens the bodies of ovoid batch. 0, or EXIT_INPUT after a message.
static int open_list(body_source *bodies, const verify_settings *s) {
    ovoid_error error;
    read_settings read = solids_get_read(&s->read, &s->choice);
    bodies->list = inputs_read_list(s->list, &read);
    if (!bodies->list) return EXIT_INPUT;
    bodies->pairs = ovoid_pairs_reader_open(s->pairs, ovoid_shapes_get_count(bodies->list), &error);
    ovoid_code code = OVOID_OK;
    if (bodies->pairs && s->part.count)
        code = ovoid_pairs_reader_set_part(bodies->pairs, s->part.index - 1, s->part.count, &error);
    if (bodies->pairs && !code) return 0;
    message_error("%s", error.message);
    return EXIT_INPUT;
}

/// Opens the bodies of ovoid distance. 0, or EXIT_INPUT after a message.
static int open_pair(body_source *bodies, const verify_settings *s, const cli_operands *paths) {
    bodies->paths[0] = paths->items[1];
    bodies->paths[1] = paths->items[2];
    const ovoid_pose poses[2] = {s->pose_a, s->pose_b};
    read_settings read = solids_get_read(&s->read, &s->choice);
    if (inputs_open_pair(bodies->paths, &read, s->choice.parts, bodies->bodies)) return EXIT_INPUT;
    if (solids_make_pair(bodies->paths, bodies->bodies, poses, &bodies->solids))
        solids_describe(&bodies->solids, &bodies->meshes);
    else
        solids_describe_bodies(bodies->bodies, &bodies->meshes);
    bodies->pair = (ovoid_body_pair){inputs_get_body(&bodies->bodies[0], &s->pose_a),
                                     inputs_get_body(&bodies->bodies[1], &s->pose_b)};
    return 0;
}

int verify_open_bodies(body_source *bodies, const verify_settings *s, const cli_operands *paths) {
    if (s->list) return open_list(bodies, s);
    if (paths->count == 3) return open_pair(bodies, s, paths);
    bodies->scene = inputs_read_scene(paths->items[1], s->choice.hull);
    if (!bodies->scene) return EXIT_INPUT;
    return s->motion ? frames_open(&bodies->frames, s->motion, bodies->scene) : 0;
}

static int refuse(verify *v, const char *message) {
    v->refused = 1;
    snprintf(v->error.message, sizeof v->error.message, "%s:%lld: %s", v->path,
             (long long)ovoid_results_reader_get_line(v->reader), message);
    return 0;
}

static void disprove(claim *item, const char *message) { snprintf(item->message, sizeof item->message, "%s", message); }

static int is_impact(const ovoid_record *record) { return (record->fields & OVOID_RECORD_IMPACT) != 0; }

/// 1 if the result needs no later frame than the one at hand: it is of the last frame that is not after it, or an
/// impact of the one that ends its interval. 1 without a motion, which has one frame.
static int has_come(const verify *v, const ovoid_record *record) {
    const cli_frames *f = &v->bodies.frames;
    if (!v->settings->motion || !(record->fields & OVOID_RECORD_TIME)) return 1;
    return f->count && (is_impact(record) ? f->time > record->frame : f->time >= record->time);
}

/// A result of a motion is of the frame at hand, or it is wrong.
static void verify_frame(const verify *v, const ovoid_record *record, claim *item) {
    const cli_frames *f = &v->bodies.frames;
    if (!(record->fields & OVOID_RECORD_TIME))
        disprove(item, "it has no time, which the results of a motion have");
    else if (is_impact(record) ? f->earlier != record->frame || !(f->time > record->frame) : f->time != record->time)
        disprove(item, is_impact(record) ? "the motion has no such frame" : "the motion has no frame at this time");
}

/// Sets both bodies of an impact, and their motions.
static void set_impact(const verify *v, const ovoid_record *record, size_t a, size_t b, claim *item) {
    const cli_frames *f = &v->bodies.frames;
    ovoid_motion motions[2] = {frames_get_motion(f, a), frames_get_motion(f, b)};
    double at = isfinite(record->hit_after) ? record->hit_after : record->free_for;
    item->duration = f->time - f->earlier;
    item->pair.a.pose = ovoid_motion_compute_pose(&motions[0], at);
    item->pair.b.pose = ovoid_motion_compute_pose(&motions[1], at);
    if (!(at >= 0 && at <= item->duration && record->free_for >= 0) || record->time != record->frame + at)
        disprove(item, "its times are not those of an impact between two frames");
    const ovoid_body *bodies[2] = {&item->pair.a, &item->pair.b};
    for (int i = 0; i < 2; i++)
        item->moving[i] = (ovoid_moving_body){.shape = bodies[i]->shape,
                                              .compound = bodies[i]->compound,
                                              .motion = motions[i],
                                              .solid = bodies[i]->solid};
}

static int is_same_volume(double a, double b) { return a == b || (isnan(a) && isnan(b)); }

static int is_same_mesh(const ovoid_convexity *a, const ovoid_convexity *b) {
    return is_same_volume(a->mesh_volume, b->mesh_volume) && is_same_volume(a->hull_volume, b->hull_volume);
}

static double get_allowance(ovoid_mesh_kind kind, const ovoid_convexity *mesh) {
    return kind == OVOID_MESH_HULL ? mesh->allowance : 0;
}

/// What a result says of its meshes must be so.
static void verify_meshes(const ovoid_record *record, const ovoid_record *meshes, claim *item) {
    if (item->message[0]) return;
    if (record->kind_a != meshes->kind_a || record->kind_b != meshes->kind_b)
        disprove(item, "kind_a and kind_b are not what the bodies are taken as: --solid, --parts and --hull choose");
    else if (get_allowance(record->kind_a, &record->mesh_a) != get_allowance(meshes->kind_a, &meshes->mesh_a) ||
             get_allowance(record->kind_b, &record->mesh_b) != get_allowance(meshes->kind_b, &meshes->mesh_b))
        disprove(item, "allowance_a and allowance_b are not those of the meshes and their hulls");
    else if (!(record->fields & OVOID_RECORD_MESHES))
        return;
    else if (!is_same_mesh(&record->mesh_a, &meshes->mesh_a) || !is_same_mesh(&record->mesh_b, &meshes->mesh_b))
        disprove(item, "the volumes are not those of the meshes and their hulls");
}

/// Of a scene: an answer about solids goes with a pair that has one, and what is said of the meshes must be so.
static void verify_objects(const ovoid_scene *scene, ovoid_couple couple, const ovoid_record *record, claim *item) {
    ovoid_record meshes = {.a = NULL};
    int have_solids = item->pair.a.solid || item->pair.b.solid;
    answers_describe(scene, couple, &meshes);
    if (!item->message[0] && !record->solid != !have_solids)
        disprove(item, have_solids ? "it is an answer about hulls or parts, and an object is a solid: give --hull"
                                   : "it is an answer about solids, which the objects are not: give no --hull");
    verify_meshes(record, &meshes, item);
}

/// What the result says of the margin of the question, without which of its sign.
static unsigned get_flags(const verify *v, const ovoid_record *record) {
    if (is_impact(record)) return SEEN_IMPACT;
    exit_code side = results_judge(&record->answer, v->margin > 0 ? v->margin : 0);
    return SEEN_RESULT | (side == EXIT_TOUCH ? SEEN_NEAR : side == EXIT_NOT_PROVEN ? SEEN_OPEN : 0);
}

/// Notes that a pair has a result, or an impact, in this frame: one of each. 0 where the run is refused.
static int note_result(verify *v, ovoid_couple couple, const ovoid_record *record, claim *item) {
    unsigned flags = get_flags(v, record);
    unsigned char *known = seen_add(&v->rest.seen, couple);
    if (!known) return refuse(v, "out of memory");
    if (*known & flags & (SEEN_RESULT | SEEN_IMPACT))
        disprove(item, is_impact(record) ? "the pair has another impact between these frames"
                                         : "the pair has another result, in an earlier line");
    else
        v->rest.results += (flags & SEEN_RESULT) != 0;
    *known |= (unsigned char)flags;
    return 1;
}

/// Finds the objects of the scene that the result names, which is of the frame at hand. 0 where the run is refused.
static int find_in_scene(verify *v, const ovoid_record *record, claim *item) {
    const ovoid_scene *scene = v->bodies.scene;
    size_t none = (size_t)-1;
    size_t a = record->a ? ovoid_scene_find(scene, record->a) : none;
    size_t b = record->b ? ovoid_scene_find(scene, record->b) : none;
    if (a == none || b == none) {
        disprove(item, "the scene has no object of that name");
        return 1;
    }
    const cli_frames *f = &v->bodies.frames;
    if (v->settings->motion) verify_frame(v, record, item);
    if (!v->settings->motion && record->fields & OVOID_RECORD_TIME) disprove(item, "it has a time: give the --motion");
    ovoid_pose pose_a = f->poses ? f->poses[a] : ovoid_scene_get(scene, a).pose;
    ovoid_pose pose_b = f->poses ? f->poses[b] : ovoid_scene_get(scene, b).pose;
    item->pair = (ovoid_body_pair){answers_get_body(scene, a, &pose_a), answers_get_body(scene, b, &pose_b)};
    verify_objects(scene, (ovoid_couple){(uint32_t)a, (uint32_t)b}, record, item);
    if (is_impact(record) && !item->message[0]) set_impact(v, record, a, b, item);
    if (!item->message[0] && (a == b || ovoid_scene_is_ignored(scene, a, b)))
        disprove(item, "the scene does not ask about this pair");
    return item->message[0] || note_result(v, (ovoid_couple){(uint32_t)a, (uint32_t)b}, record, item);
}

/// Reads the next pair of the pairs file, which must be the one that the result names. 0 where there is none.
static int find_in_list(verify *v, const ovoid_record *record, claim *item) {
    const body_source *bodies = &v->bodies;
    ovoid_indexed_pair pair;
    int got = ovoid_pairs_reader_read(bodies->pairs, &pair, &v->error);
    if (got < 0) return v->refused = 1, 0;
    if (got == 0) return refuse(v, "there are more results than pairs");
    item->pair = (ovoid_body_pair){{.shape = ovoid_shapes_get(bodies->list, pair.a).shape, .pose = pair.pose_a},
                                   {.shape = ovoid_shapes_get(bodies->list, pair.b).shape, .pose = pair.pose_b}};
    if (record->a || record->b || record->index_a != pair.a || record->index_b != pair.b)
        disprove(item, "a and b are not those of the pair with the same place in the pairs");
    ovoid_record meshes = {.mesh_a = ovoid_shapes_get(bodies->list, pair.a).convexity,
                           .mesh_b = ovoid_shapes_get(bodies->list, pair.b).convexity};
    if (!v->settings->choice.hull) meshes.kind_a = meshes.mesh_a.kind, meshes.kind_b = meshes.mesh_b.kind;
    verify_meshes(record, &meshes, item);
    return 1;
}

static void find_given(verify *v, const ovoid_record *record, claim *item) {
    const body_source *bodies = &v->bodies;
    if (v->rest.results++) disprove(item, "the pair has another result, in an earlier line");
    int are_solids = bodies->solids.solids[0] || bodies->solids.solids[1];
    item->pair = are_solids ? bodies->solids.pair : bodies->pair;
    if (!record->a || !record->b || strcmp(record->a, bodies->paths[0]) != 0 ||
        strcmp(record->b, bodies->paths[1]) != 0)
        disprove(item, "a and b are not the two bodies given");
    else if (record->solid && !are_solids)
        disprove(item, "it is an answer about solids, which the bodies are not: give --solid, or no --hull");
    else if (!record->solid && are_solids)
        disprove(item, "it is an answer about hulls or parts, and a body is a solid: give --hull or --parts");
    verify_meshes(record, &bodies->meshes, item);
}

/// A copy of `size` bytes; NULL for none, and where memory is out.
static void *copy(const void *data, size_t size) {
    void *made = size ? malloc(size) : NULL;
    if (made) memcpy(made, data, size);
    return made;
}

/// Stores the record with copies of the arrays that it points to. 0 where memory is out.
static int store_record(const ovoid_record *record, claim *item) {
    ovoid_record *stored = &item->record;
    *stored = *record;
    stored->a = stored->b = NULL;
    stored->solid = copy(record->solid, record->solid ? sizeof *record->solid : 0);
    stored->cover = cover_copy(record->cover);
    stored->exclusions = copy(record->exclusions, record->exclusion_count * sizeof *record->exclusions);
    stored->steps = copy(record->steps, record->step_count * sizeof *record->steps);
    stored->groups = copy(record->groups, record->group_count * sizeof *record->groups);
    return contacts_copy(stored) && !stored->cover == !(record->cover && record->cover->point_count) &&
           !stored->exclusions == !record->exclusion_count && !stored->steps == !record->step_count &&
           !stored->groups == !record->group_count && !stored->solid == !record->solid;
}

void verify_drop(claim *item) {
    free((void *)item->record.cover);
    free((void *)item->record.exclusions);
    free((void *)item->record.steps);
    free((void *)item->record.groups);
    free((void *)item->record.solid);
    contacts_clear(&item->record);
    item->record = (ovoid_record){.a = NULL};
}

/// The margin of a result; negative: none. Without one impacts are those of touching.
static double get_margin(const ovoid_record *record) {
    return record->fields & OVOID_RECORD_MARGIN ? record->margin : -1;
}

/// The margin of the question is that of --margin, or else that of the first result.
static void settle_margin(verify *v) {
    const ovoid_record *record = &v->record;
    double own = get_margin(record);
    if (isnan(v->margin) && (!is_impact(record) || own > 0)) v->margin = own;
}

/// All results have the margin of the question.
static void verify_margin(const verify *v, const ovoid_record *record, claim *item) {
    double least = is_impact(record) ? 0 : -1;
    if (!isnan(v->margin) && get_margin(record) != fmax(v->margin, least))
        disprove(item, "its margin is not the one that was asked");
}

/// Makes the item of the record that was read. 0 where the run is refused.
static int make_result(verify *v, claim *item) {
    const ovoid_record *record = &v->record;
    int got = 1;
    *item = (claim){.kind = CLAIM_RESULT, .line = ovoid_results_reader_get_line(v->reader)};
    verify_margin(v, record, item);
    if (v->bodies.scene)
        got = find_in_scene(v, record, item);
    else if (v->bodies.list)
        got = find_in_list(v, record, item);
    else
        find_given(v, record, item);
    v->has_record = 0;
    if (!got) return 0;
    if (store_record(record, item)) return 1;
    verify_drop(item);
    return refuse(v, "out of memory");
}

/// Reads the next record, where none waits. 0 where the run is refused.
static int read_record(verify *v) {
    if (v->has_record || v->has_ended) return 1;
    int got = ovoid_results_reader_read(v->reader, &v->record, &v->error);
    v->has_record = got > 0;
    v->has_ended = got <= 0;
    if (got > 0) settle_margin(v);
    if (got < 0) v->refused = 1;
    return got >= 0;
}

/// Goes on to the next frame. 1, 0 where there is none, or the run is refused.
static int go_on(verify *v) {
    int got = v->settings->motion ? frames_next(&v->bodies.frames) : 0;
    if (got < 0) v->refused = 1, v->error.message[0] = 0;
    return got > 0 && verify_begin_rest(v);
}

int verify_read(verify *v, claim *item) {
    verify_rest *rest = &v->rest;
    for (;;) {
        if (rest->next < rest->count) return *item = rest->items[rest->next++], 1;
        if (!read_record(v)) return 0;
        int goes_on = v->bodies.scene && !(v->has_record && has_come(v, &v->record));
        if (v->has_record && !goes_on) return make_result(v, item);
        if (!goes_on) return 0;
        // What the frame lacks comes before the next frame.
        int has_frame = !v->settings->motion || v->bodies.frames.count;
        if (has_frame && !rest->is_listed) {
            if (!verify_list_rest(v)) return 0;
            continue;
        }
        if (go_on(v)) continue;
        return v->has_record && !v->refused ? make_result(v, item) : 0;
    }
}
