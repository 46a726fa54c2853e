// Pictures of the pairs that an SRDF disables wrongly: both links in the state that shows it, and the witness points of
// the two parts that overlap most.
#include "robot/matrix/matrix.h"

#include "base/finish.h"
#include "base/message.h"

#include <ovoid/query.h>

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// A picture in the making.
typedef struct pair_picture {
    ovoid_picture_body *bodies; ///< the elements of a, then those of b
    size_t count, count_a;
    ovoid_answer answer; ///< of the pair below
    ovoid_picture_link deepest;
} pair_picture;

/// Adds the elements of a link where it is; the first one has its name.
static void add_link(pair_picture *p, const ovoid_robot_description *d, uint32_t link, const ovoid_pose *at,
                     uint32_t group) {
    const char *name = d->links[link].name;
    for (size_t i = 0; i < d->element_count; i++) {
        const ovoid_robot_element *e = &d->elements[i];
        if (e->link != link) continue;
        ovoid_pose pose = ovoid_pose_compute_product(at, &e->pose);
        p->bodies[p->count++] = (ovoid_picture_body){name, e->shape, pose, group, NULL, 0};
        name = NULL;
    }
}

static void find_deepest(pair_picture *p) {
    for (size_t a = 0; a < p->count_a; a++)
        for (size_t b = p->count_a; b < p->count; b++) {
            const ovoid_picture_body *one = &p->bodies[a], *other = &p->bodies[b];
            const ovoid_pair pair = {one->shape, other->shape, one->pose, other->pose};
            ovoid_answer answer = ovoid_depth(&pair, NULL, NULL, NULL);
            int is_first = a == 0 && b == p->count_a;
            if (!is_first && answer.lower >= p->answer.lower) continue;
            p->answer = answer;
            p->deepest = (ovoid_picture_link){a, b, NULL};
        }
    p->deepest.answer = &p->answer;
}

/// "DIR/003 left right.svg" with what a file name should not have as '_'; NULL where memory is out.
static char *make_path(const char *folder, size_t number, const char *a, const char *b) {
    size_t size = strlen(folder) + strlen(a) + strlen(b) + 40;
    char *path = malloc(size);
    if (!path) return NULL;
    int before = snprintf(path, size, "%s/", folder);
    snprintf(path + before, size - (size_t)before, "%03zu-%s-%s.svg", number, a, b);
    for (char *c = path + before; *c; c++)
        if (!isalnum((unsigned char)*c) && !strchr("-_.", *c)) *c = '_';
    return path;
}

/// Draws what was found. 0, or EXIT_INPUT after a message.
static int write_picture(const char *path, const pair_picture *p, const char *title) {
    ovoid_error error;
    const ovoid_picture picture = {p->bodies, p->count, &p->deepest, 1, title, "m"};
    const ovoid_picture_options how = {.layers = OVOID_PICTURE_WITNESS | OVOID_PICTURE_NAMES | OVOID_PICTURE_LEGEND |
                                                 OVOID_PICTURE_INNER};
    finish_hold_signals();
    ovoid_code code = ovoid_picture_write_svg(path, &picture, &how, &error);
    finish_release_signals();
    if (code == OVOID_OK) return 0;
    finish_report_failure(&error);
    return EXIT_INPUT;
}

static int draw_pair(const char *folder, const matrix_view *v, size_t number, const ovoid_robot_matrix_pair *pair) {
    const ovoid_robot_description *d = &v->description;
    const char *a = d->links[pair->a].name, *b = d->links[pair->b].name;
    ovoid_pose *poses = malloc((d->link_count + 1) * sizeof *poses);
    pair_picture p = {.bodies = malloc((d->element_count + 1) * sizeof *p.bodies)};
    char *path = make_path(folder, number, a, b), title[300];
    ovoid_error error;
    int code = EXIT_INPUT;
    snprintf(title, sizeof title, "%.120s and %.120s touch: hit in %zu of %zu samples", a, b, pair->hits,
             pair->samples);
    if (!poses || !p.bodies || !path)
        message_error("out of memory for a picture");
    else if (ovoid_robot_compute_poses(v->robot, pair->hit, poses, &error) != OVOID_OK)
        message_error("%s", error.message);
    else {
        add_link(&p, d, pair->a, &poses[pair->a], 1);
        p.count_a = p.count;
        add_link(&p, d, pair->b, &poses[pair->b], 2);
        find_deepest(&p);
        code = write_picture(path, &p, title);
    }
    free(path);
    free(p.bodies);
    free(poses);
    return code;
}

int matrix_write_pictures(const char *folder, const matrix_view *v) {
    size_t drawn = 0;
    if (mkdir(folder, 0777) != 0 && errno != EEXIST) {
        message_error("%s: %s", folder, strerror(errno));
        return EXIT_INPUT;
    }
    for (size_t i = 0; i < ovoid_robot_matrix_get_count(v->matrix); i++) {
        ovoid_robot_matrix_pair p = ovoid_robot_matrix_get_pair(v->matrix, i);
        if (matrix_find(v, &p) != FINDING_WRONG || !p.hit) continue;
        int code = draw_pair(folder, v, ++drawn, &p);
        if (code) return code;
    }
    message_note("%zu picture%s in %s", drawn, drawn == 1 ? "" : "s", folder);
    return 0;
}
