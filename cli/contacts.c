// Contact manifolds of a pair. The manifolds come from one traversal of both bodies; a bound that a search proved needs
// the search's cover, which that traversal does not keep, so such a pair of parts is searched once more by itself: the
// same bits.
#include "contacts.h"

#include "base/covers.h"

#include <stdlib.h>
#include <string.h>

/// The largest angle between facets and the plane of contact, which is the default.
#define ANGLE_MOST 1.45

int contacts_settle(const cli_command *command, const contacts_settings *settings) {
    if (settings->angle > 0 && !settings->wanted)
        return args_complain(command, "%s: --contact-angle goes with --contacts", command->name);
    if (settings->angle > ANGLE_MOST)
        return args_complain(command, "%s: --contact-angle: at most %g radians are possible", command->name,
                             ANGLE_MOST);
    return -1;
}

ovoid_manifold_options contacts_make_options(const contacts_settings *settings, double margin, double tolerance) {
    return (ovoid_manifold_options){.margin = margin > 0 ? margin : 0,
                                    .tolerance = tolerance,
                                    .angle = settings->angle > 0 ? settings->angle : ANGLE_MOST};
}

int contacts_get_parts(const ovoid_body_pair *bodies, const uint32_t parts[2], ovoid_pair *pair) {
    const ovoid_body *body[2] = {&bodies->a, &bodies->b};
    ovoid_posed_shape found[2];
    for (int i = 0; i < 2; i++) {
        found[i] = (ovoid_posed_shape){body[i]->shape, body[i]->pose};
        if (!body[i]->compound != (parts[i] == OVOID_RECORD_NO_PART)) return 0;
        if (!body[i]->compound && !body[i]->shape) return 0;
        if (!body[i]->compound) continue;
        if (parts[i] >= ovoid_compound_get_part_count(body[i]->compound)) return 0;
        found[i] = ovoid_compound_get_part(body[i]->compound, parts[i]);
        found[i].pose = ovoid_pose_compute_product(&body[i]->pose, &found[i].pose);
    }
    *pair = (ovoid_pair){found[0].shape, found[1].shape, found[0].pose, found[1].pose};
    return 1;
}

/// The same for the parts of a contact, which are 0 of what is no compound.
static int get_contact_parts(const ovoid_body_pair *bodies, const ovoid_record_contact *contact, ovoid_pair *pair) {
    uint32_t parts[2] = {contact->part_a, contact->part_b};
    if (!bodies->a.compound && parts[0] == 0) parts[0] = OVOID_RECORD_NO_PART;
    if (!bodies->b.compound && parts[1] == 0) parts[1] = OVOID_RECORD_NO_PART;
    return contacts_get_parts(bodies, parts, pair);
}

/* ---- memory: one block for contacts and points, one for each cover */

/// Makes room for contacts whose points are beside them.
static ovoid_record_contact *make_block(size_t count) {
    ovoid_record_contact *contacts = calloc(count, sizeof *contacts + 4 * sizeof *contacts->points);
    if (!contacts) return NULL;
    ovoid_manifold_point *points = (ovoid_manifold_point *)(contacts + count);
    for (size_t i = 0; i < count; i++) contacts[i].points = points + 4 * i;
    return contacts;
}

int contacts_copy(ovoid_record *record) {
    size_t count = record->contact_count;
    const ovoid_record_contact *from = record->contacts;
    int failed = 0;
    record->contacts = NULL;
    if (!count) return 1;
    ovoid_record_contact *to = make_block(count);
    for (size_t i = 0; to && i < count; i++) {
        const ovoid_manifold_point *points = to[i].points;
        memcpy((void *)points, from[i].points, from[i].point_count * sizeof *points);
        to[i] = from[i];
        to[i].points = points;
        to[i].cover = cover_copy(from[i].cover);
        failed |= from[i].cover && !to[i].cover;
    }
    record->contacts = to;
    if (!to) record->contact_count = 0;
    return to && !failed;
}

void contacts_clear(ovoid_record *record) {
    for (size_t i = 0; record->contacts && i < record->contact_count; i++) free((void *)record->contacts[i].cover);
    free((void *)record->contacts);
    record->contacts = NULL;
    record->contact_count = 0;
}

/* ---- finding */

/// The manifolds of both bodies, in memory that the caller frees; *limit: why there are none. NULL without memory.
static ovoid_body_manifold *find_manifolds(const ovoid_body_pair *pair, const ovoid_manifold_options *options,
                                           size_t *count, ovoid_limit *limit) {
    ovoid_body_manifolds room = {.capacity = 4};
    for (;;) {
        ovoid_body_manifold *items = realloc(room.items, room.capacity * sizeof *items);
        if (!items) return free(room.items), NULL;
        room.items = items;
        *limit = ovoid_body_manifolds_find(pair, options, &room);
        *count = room.count;
        if (room.count <= room.capacity) return items;
        room.capacity = room.count;
    }
}

static int has_solid(const ovoid_body_pair *bodies) { return bodies->a.solid || bodies->b.solid; }

static ovoid_manifold_points compute_points(const ovoid_body_pair *bodies, const ovoid_record_contact *contact) {
    const ovoid_body_manifold item = {contact->part_a, contact->part_b, contact->manifold};
    return ovoid_body_manifold_compute_points(bodies, &item);
}

typedef struct areas {
    double inner, outer;
} areas;

/// The areas of a contact's polygon. Those of a facet of a solid, which need not be convex, are not known: pair is
/// NULL, and both are 0.
static int compute_areas(const ovoid_pair *pair, const ovoid_record_contact *contact,
                         const ovoid_manifold_options *options, areas *found) {
    ovoid_manifold_polygon polygon;
    *found = (areas){0, 0};
    if (!pair) return 1;
    if (ovoid_manifold_compute_polygon(pair, &contact->manifold, options, &polygon) != OVOID_OK) return 0;
    *found = (areas){polygon.inner, polygon.outer};
    return 1;
}

/// Completes a contact: its points, areas, and where one is given a copy of the cover of its search. 0 where the pair
/// has no such contact, -1 where memory is out.
static int complete(const ovoid_body_pair *bodies, const ovoid_manifold_options *options, ovoid_cover *cover,
                    ovoid_record_contact *contact) {
    ovoid_pair pair;
    areas found_areas;
    int is_solid = has_solid(bodies);
    if (!is_solid && !get_contact_parts(bodies, contact, &pair)) return 0;
    ovoid_manifold_options asked = *options;
    asked.cover = cover;
    if (cover) contact->manifold = ovoid_manifold_find(&pair, &asked, NULL);
    contact->cover = cover_copy(cover);
    if (cover && cover->point_count && !contact->cover) return -1;
    const ovoid_manifold_points found = compute_points(bodies, contact);
    memcpy((void *)contact->points, found.points, found.count * sizeof *found.points);
    contact->point_count = found.count;
    contact->grown = found.grown;
    if (!compute_areas(is_solid ? NULL : &pair, contact, options, &found_areas)) return 0;
    contact->inner = found_areas.inner;
    contact->outer = found_areas.outer;
    return found.count > 0;
}

static int has_search(const ovoid_body_manifold *found) { return found->manifold.proof == OVOID_MANIFOLD_PROOF_SEARCH; }

int contacts_find(const ovoid_body_pair *pair, const ovoid_manifold_options *options, ovoid_record *record) {
    size_t count = 0;
    ovoid_cover cover = {.memory = NULL};
    record->contact_margin = options->margin;
    record->contact_angle = options->angle;
    record->contacts = NULL;
    record->contact_count = 0;
    ovoid_body_manifold *found = find_manifolds(pair, options, &count, &record->contact_limit);
    ovoid_record_contact *contacts = found && count ? make_block(count) : NULL;
    int failed = !found || (count && !contacts);
    for (size_t i = 0; i < count && !failed; i++) {
        ovoid_record_contact *to = &contacts[record->contact_count];
        to->part_a = found[i].part_a;
        to->part_b = found[i].part_b;
        to->manifold = found[i].manifold;
        int searches = has_search(&found[i]);
        failed = searches && !cover_take_memory(&cover);
        int completed = failed ? 0 : complete(pair, options, searches ? &cover : NULL, to);
        record->contact_count += completed > 0;
        failed |= completed < 0;
    }
    free(cover.memory);
    free(found);
    record->contacts = contacts;
    return !failed;
}

/* ---- verifying */

static ovoid_code fail(ovoid_error *error, const char *what) {
    snprintf(error->message, sizeof error->message, "%s", what);
    return error->code = OVOID_ERROR_PROOF;
}

static ovoid_code refuse(ovoid_error *error, size_t i, const char *what) {
    snprintf(error->message, sizeof error->message, "contact %zu: %.200s", i, what);
    return error->code = OVOID_ERROR_PROOF;
}

static int is_same_vector(ovoid_vec3 a, ovoid_vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; }

static int is_same_point(const ovoid_manifold_point *a, const ovoid_manifold_point *b) {
    return a->id == b->id && a->separation == b->separation && is_same_vector(a->point_a, b->point_a) &&
           is_same_vector(a->point_b, b->point_b);
}

/// Points and areas follow from the features: the same numbers, but for the sign of a zero.
static ovoid_code verify_numbers(const ovoid_body_pair *bodies, const ovoid_record_contact *c,
                                 const ovoid_manifold_options *options, ovoid_error *error) {
    const ovoid_manifold_points found = compute_points(bodies, c);
    ovoid_pair pair;
    areas of_polygon;
    if (found.count != c->point_count || found.grown != c->grown)
        return fail(error, "its points are not those of its features");
    for (size_t i = 0; i < c->point_count; i++)
        if (!is_same_point(&found.points[i], &c->points[i])) return fail(error, "a point is not that of the features");
    int is_solid = has_solid(bodies), has_parts = is_solid || get_contact_parts(bodies, c, &pair);
    if (has_parts && compute_areas(is_solid ? NULL : &pair, c, options, &of_polygon) && of_polygon.inner == c->inner &&
        of_polygon.outer == c->outer)
        return OVOID_OK;
    return fail(error, "its areas are not those of its polygon");
}

static ovoid_code verify_one(const ovoid_body_pair *bodies, const ovoid_record *record, size_t i,
                             const ovoid_manifold_options *options, ovoid_error *error) {
    const ovoid_record_contact *c = &record->contacts[i], *before = i ? c - 1 : NULL;
    ovoid_pair pair;
    const ovoid_body_manifold item = {c->part_a, c->part_b, c->manifold};
    ovoid_manifold_options asked = *options;
    asked.cover = (ovoid_cover *)c->cover;
    if (!has_solid(bodies) && !get_contact_parts(bodies, c, &pair))
        return refuse(error, i, "the bodies have no such parts");
    if (before && (before->part_a > c->part_a || (before->part_a == c->part_a && before->part_b >= c->part_b)))
        return refuse(error, i, "it is not in the order of its parts");
    if (!c->cover != (c->manifold.proof != OVOID_MANIFOLD_PROOF_SEARCH))
        return refuse(error, i, "a cover goes with the proof of a search");
    ovoid_error why = {.message = ""};
    ovoid_code code = ovoid_body_manifold_verify(bodies, &item, &asked, &why);
    if (code == OVOID_OK) code = verify_numbers(bodies, c, &asked, &why);
    return code == OVOID_OK ? OVOID_OK : refuse(error, i, why.message);
}

/// Looks for contacts anew, of which the record must have each. Which it has was sorted before.
static ovoid_code verify_all_there(const ovoid_body_pair *bodies, const ovoid_record *record,
                                   const ovoid_manifold_options *options, ovoid_error *error) {
    size_t count = 0, k = 0;
    ovoid_limit limit;
    ovoid_body_manifold *found = find_manifolds(bodies, options, &count, &limit);
    if (!found) return error->code = OVOID_ERROR_MEMORY;
    ovoid_code code = OVOID_OK;
    if (limit != record->contact_limit) code = fail(error, "contact_limit is not that of the bodies");
    for (size_t i = 0; i < count && code == OVOID_OK; i++) {
        while (k < record->contact_count &&
               (record->contacts[k].part_a < found[i].part_a ||
                (record->contacts[k].part_a == found[i].part_a && record->contacts[k].part_b < found[i].part_b)))
            k++;
        int is_there = k < record->contact_count && record->contacts[k].part_a == found[i].part_a &&
                       record->contacts[k].part_b == found[i].part_b;
        if (is_there) continue;
        code = error->code = OVOID_ERROR_PROOF;
        snprintf(error->message, sizeof error->message, "there is no contact of parts %lu and %lu",
                 (unsigned long)found[i].part_a, (unsigned long)found[i].part_b);
    }
    free(found);
    return code;
}

ovoid_code contacts_verify(const ovoid_body_pair *pair, const ovoid_record *record, double tolerance,
                           ovoid_error *error) {
    const ovoid_manifold_options options = {
        .margin = record->contact_margin, .tolerance = tolerance, .angle = record->contact_angle};
    if (!(record->contact_angle > 0 && record->contact_angle <= ANGLE_MOST) || !(record->contact_margin >= 0))
        return fail(error, "contact_margin or contact_angle is out of range");
    ovoid_code code = OVOID_OK;
    for (size_t i = 0; i < record->contact_count && code == OVOID_OK; i++)
        code = verify_one(pair, record, i, &options, error);
    return code == OVOID_OK ? verify_all_there(pair, record, &options, error) : code;
}
