// A robot as data: links, joints, elements, which pairs are not queried, obstacles, states, answers.
#include "robot/page.h"

#include "base/json.h"
#include "base/message.h"
#include "page/shapes.h"
#include "page/write.h"
#include "robot/page_clearance.h"

#include <stdlib.h>
#include <string.h>

/// Most states of a page.
#define STATES_MOST 10000

// ---- the answers, as they come

int robot_page_open(robot_page *p, const char *path) {
    *p = (robot_page){.answers = NULL};
    int code = page_open(&p->page, path);
    if (code || !path) return code;
    p->answers = open_memstream(&p->text, &p->size);
    if (p->answers) return 0;
    page_close(&p->page);
    return message_error("out of memory"), EXIT_INPUT;
}

void robot_page_add_state(robot_page *p, const report_form *form, const report_state *state) {
    if (!p->answers || state->index >= STATES_MOST) return;
    if (p->count++) fputc(',', p->answers);
    report_write_json(p->answers, form, state);
}

void robot_page_add_path(robot_page *p, const path_report *report) {
    path_report plain = *report;
    plain.steps = NULL;
    // Edges of states that are on the page.
    if (!p->answers || (report->is_edge && 2 * report->number + 2 > STATES_MOST)) return;
    if (p->count++) fputc(',', p->answers);
    path_write_json(p->answers, &plain);
}

void robot_page_close(robot_page *p) {
    if (p->answers) fclose(p->answers);
    free(p->text);
    page_close(&p->page);
    *p = (robot_page){.answers = NULL};
}

// ---- the robot

static void write_key(FILE *file, const char *before, const char *key, const char *text) {
    fprintf(file, "%s\"%s\":", before, key);
    page_write_text(file, text);
}

static void write_value(FILE *file, const char *key, double number) {
    fprintf(file, ",\"%s\":", key);
    json_write_number(file, number);
}

static void write_joint(FILE *file, const ovoid_robot_description *d, const ovoid_robot_joint *j) {
    write_key(file, "{", "name", j->name);
    write_key(file, ",", "type", ovoid_joint_type_get_name(j->type));
    write_key(file, ",", "parent", d->links[j->parent].name);
    write_key(file, ",", "child", d->links[j->child].name);
    fputs(",\"origin\":", file);
    page_write_pose(file, &j->origin);
    if (j->type != OVOID_JOINT_FIXED && j->type != OVOID_JOINT_FLOATING) page_write_vector(file, ",", "axis", j->axis);
    if (j->type == OVOID_JOINT_REVOLUTE || j->type == OVOID_JOINT_PRISMATIC) {
        write_value(file, "lower", j->lower);
        write_value(file, "upper", j->upper);
    }
    if (j->velocity > 0) write_value(file, "velocity", j->velocity);
    if (j->mimic != OVOID_ROBOT_NONE) {
        write_key(file, ",\"mimic\":{", "joint", d->joints[j->mimic].name);
        write_value(file, "multiplier", j->multiplier);
        write_value(file, "offset", j->offset);
        fputc('}', file);
    }
    fputc('}', file);
}

static void write_tree(FILE *file, const cli_cell *cell) {
    const ovoid_robot_description *d = &cell->description;
    char name[CELL_SIDE_ROOM];
    fputs(",\"robot\":{\"links\":[", file);
    for (size_t i = 0; i < d->link_count; i++) {
        if (i) fputc(',', file);
        page_write_text(file, d->links[i].name);
    }
    fputs("],\"joints\":[", file);
    for (size_t i = 0; i < d->joint_count; i++) {
        if (i) fputc(',', file);
        write_joint(file, d, &d->joints[i]);
    }
    fputs("],\"variables\":[", file);
    for (size_t i = 0; i < ovoid_robot_get_variable_count(cell->robot.robot); i++) {
        if (i) fputc(',', file);
        cell_format_variable(name, cell, i);
        page_write_text(file, name);
    }
    fputc(']', file);
}

/// Adds the shapes of a robot and its obstacles; 0 where memory is out.
static int add_shapes(page_shapes *shapes, const cli_cell *cell) {
    size_t number;
    int done = 1;
    for (size_t i = 0; i < cell->description.element_count && done; i++)
        done = page_shapes_add(shapes, cell->description.elements[i].shape, &number);
    for (size_t i = 0; i < cell->id_count && done; i++)
        done = page_shapes_add(shapes, ovoid_obstacles_get(cell->obstacles, i).shape, &number);
    return done;
}

/// Writes the number and the pose of a shape that was added before.
static void write_place(FILE *file, page_shapes *shapes, const ovoid_shape *shape, const ovoid_pose *pose) {
    size_t number = 0;
    (void)page_shapes_add(shapes, shape, &number);
    fprintf(file, ",\"shape\":%zu,\"pose\":", number);
    page_write_pose(file, pose);
    fputc('}', file);
}

static void write_elements(FILE *file, page_shapes *shapes, const cli_cell *cell) {
    const ovoid_robot_description *d = &cell->description;
    fputs(",\"elements\":[", file);
    for (size_t i = 0; i < d->element_count; i++) {
        const ovoid_robot_element *e = &d->elements[i];
        write_key(file, i ? ",{" : "{", "link", d->links[e->link].name);
        if (e->name) write_key(file, ",", "name", e->name);
        write_place(file, shapes, e->shape, &e->pose);
    }
    // What a link holds is one of its elements.
    size_t count = d->element_count;
    for (size_t i = 0; i < cell->id_count; i++) {
        ovoid_obstacle o = ovoid_obstacles_get(cell->obstacles, i);
        if (cell->placed[i].link == OVOID_ROBOT_NONE) continue;
        write_key(file, count++ ? ",{" : "{", "link", d->links[cell->placed[i].link].name);
        write_key(file, ",", "name", o.name);
        write_place(file, shapes, o.shape, &cell->placed[i].pose);
    }
    fputs("],\"obstacles\":[", file);
    count = 0;
    for (size_t i = 0; i < cell->id_count; i++) {
        ovoid_obstacle o = ovoid_obstacles_get(cell->obstacles, i);
        if (cell->placed[i].link != OVOID_ROBOT_NONE) continue;
        write_key(file, count++ ? ",{" : "{", "name", o.name);
        write_place(file, shapes, o.shape, &cell->placed[i].pose);
    }
    fputc(']', file);
}

// ---- pairs that are not queried

static int compare_pairs(const void *a, const void *b) {
    const ovoid_robot_pair *p = a, *q = b;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return p->b < q->b ? -1 : p->b > q->b;
}

/// 1 if two links, a < b, are disabled, or never move against each other.
static int is_left_out(const cli_cell *cell, uint32_t a, uint32_t b) {
    const ovoid_robot_description *d = &cell->description;
    const ovoid_robot_pair key = {a, b, NULL};
    // The compiled description has them sorted.
    if (d->disabled_count && bsearch(&key, d->disabled, d->disabled_count, sizeof key, compare_pairs)) return 1;
    return ovoid_robot_is_rigid_pair(cell->robot.robot, a, b);
}

/// Writes the pairs of links with elements that are not queried. 0 where memory is out.
static int write_disabled(FILE *file, const cli_cell *cell) {
    const ovoid_robot_description *d = &cell->description;
    unsigned char *has_element = calloc(d->link_count + 1, 1);
    const char *before = "";
    if (!has_element) return 0;
    for (size_t i = 0; i < d->element_count; i++) has_element[d->elements[i].link] = 1;
    fputs(",\"disabled\":[", file);
    for (uint32_t a = 0; a < d->link_count; a++)
        for (uint32_t b = a + 1; b < d->link_count && has_element[a]; b++) {
            if (!has_element[b] || !is_left_out(cell, a, b)) continue;
            fprintf(file, "%s[", before);
            page_write_text(file, d->links[a].name);
            fputc(',', file);
            page_write_text(file, d->links[b].name);
            fputc(']', file);
            before = ",";
        }
    fputc(']', file);
    free(has_element);
    return 1;
}

// ---- states and answers

/// Writes the states, at most STATES_MOST, and their times where they have some; returns how many are left out.
static size_t write_states(FILE *file, const cli_states *states) {
    size_t count = states->count < STATES_MOST ? states->count : STATES_MOST;
    states_write_json(file, states, "states", count);
    return states->count - count;
}

/// Writes the answers, and the clearance of a path. 0, or EXIT_INPUT after a message.
static int write_answers(robot_page *p, const robot_page_source *s) {
    FILE *file = p->page.file, *answers = p->answers;
    p->answers = NULL;
    if (fclose(answers) != 0) return message_error("out of memory"), EXIT_INPUT;
    fputs(s->checker ? ",\"answers\":[],\"path\":{\"edges\":[" : ",\"answers\":[", file);
    page_copy_json(file, p->text, p->size);
    fputs("]", file);
    if (!s->checker) return 0;
    const ovoid_robot_query_options options = cell_make_options(s->settings);
    int code = s->has_clearance ? page_write_clearance(file, s->cell, s->states, s->checker, &options) : 0;
    fputc('}', file);
    return code;
}

int robot_page_check(const cli_command *command, cli_cell *cell) {
    if (!cell_has_solids(cell)) return 0;
    cell_close(cell);
    return args_complain(
        command,
        "%s: --html draws hulls and asks about them, and there are meshes that are none: add --hull to "
        "ask about hulls",
        command->name);
}

int robot_page_write(robot_page *p, const robot_page_source *s) {
    const page_head head = {s->urdf, NULL, "m", s->settings->margin > 0 ? s->settings->margin : -1};
    page_shapes shapes = {.items = NULL};
    if (!p->page.path) return 0;
    if (s->settings->paddings.count)
        message_warning("the page has no paddings: what it finds by itself is without them");
    int code = page_begin(&p->page, &head);
    FILE *file = p->page.file;
    if (!code && !add_shapes(&shapes, s->cell)) code = EXIT_INPUT, message_error("out of memory");
    if (!code) code = page_shapes_write(&shapes, file);
    if (!code) {
        fputs(",\"bodies\":[],\"pairs\":[]", file);
        write_tree(file, s->cell);
        write_elements(file, &shapes, s->cell);
        if (!write_disabled(file, s->cell)) code = EXIT_INPUT, message_error("out of memory");
    }
    if (!code) {
        p->page.left_out.states = write_states(file, s->states);
        code = write_answers(p, s);
        fputc('}', file);
    }
    page_shapes_clear(&shapes);
    return page_end(&p->page, code) ? EXIT_INPUT : 0;
}
