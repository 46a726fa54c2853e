// A robot as data: links, joints, elements, which pairs are not queried, obstacles, states, answers.
#include "robot/page.h"

#include "base/members.h"
#include "base/message.h"
#include "io/fields.h"
#include "page/shapes.h"
#include "page/write.h"
#include "robot/page_clearance.h"
#include "robot/page_steps.h"

#include <stdlib.h>

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
    plain.has_proofs = 0;
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

static void write_joint(FILE *file, const ovoid_robot_description *d, const ovoid_robot_joint *j) {
    write_key(file, "{", "name", j->name);
    write_key(file, ",", "type", ovoid_joint_type_get_name(j->type));
    write_key(file, ",", "parent", d->links[j->parent].name);
    write_key(file, ",", "child", d->links[j->child].name);
    fputs(",\"origin\":", file);
    page_write_pose(file, &j->origin);
    if (j->type != OVOID_JOINT_FIXED && j->type != OVOID_JOINT_FLOATING) page_write_vector(file, ",", "axis", j->axis);
    if (j->type == OVOID_JOINT_REVOLUTE || j->type == OVOID_JOINT_PRISMATIC) {
        member_write_number(file, ",", "lower", j->lower);
        member_write_number(file, ",", "upper", j->upper);
    }
    if (j->velocity > 0) member_write_number(file, ",", "velocity", j->velocity);
    if (j->mimic != OVOID_ROBOT_NONE) {
        write_key(file, ",\"mimic\":{", "joint", d->joints[j->mimic].name);
        member_write_number(file, ",", "multiplier", j->multiplier);
        member_write_number(file, ",", "offset", j->offset);
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

/// Adds a shape, or a solid with its hull. 0, or EXIT_INPUT after a message.
static int add_shape(page_shapes *shapes, cli_page *page, const ovoid_shape *shape, const ovoid_solid *solid) {
    size_t number;
    if (solid) return page_shapes_add_solid(shapes, page, shape, solid);
    return page_shapes_add(shapes, shape, &number) ? 0 : (message_error("out of memory"), EXIT_INPUT);
}

/// Adds the shapes of a robot and its obstacles. 0, or EXIT_INPUT after a message.
static int add_shapes(page_shapes *shapes, cli_page *page, const cli_cell *cell) {
    int code = 0;
    for (size_t i = 0; i < cell->description.element_count && !code; i++) {
        const ovoid_robot_element *e = &cell->description.elements[i];
        code = add_shape(shapes, page, e->shape, e->solid);
    }
    for (size_t i = 0; i < cell->body_count && !code; i++)
        code = add_shape(shapes, page, cell->bodies[i].shape, cell->bodies[i].solid);
    return code;
}

/// Something that is drawn, and where.
typedef struct placed_shape {
    const ovoid_shape *shape;
    const ovoid_solid *solid;
    const ovoid_pose *pose;
} placed_shape;

/// Writes the number and the pose of a shape that was added before.
static void write_place(FILE *file, page_shapes *shapes, const placed_shape *at) {
    size_t number = 0;
    (void)page_shapes_add(shapes, at->shape, &number);
    fprintf(file, ",\"shape\":%zu%s,\"pose\":", number, at->solid ? ",\"solid\":true" : "");
    page_write_pose(file, at->pose);
}

/// Writes the links that an obstacle, or what a link holds, is let touch.
static void write_allowed(FILE *file, const cli_cell *cell, ovoid_id id) {
    const char *before = "";
    fputs(",\"touching\":[", file);
    for (uint32_t i = 0; i < cell->description.link_count; i++) {
        if (!ovoid_robot_cell_is_body_allowed(cell->cell, id, i)) continue;
        fputs(before, file);
        page_write_text(file, cell->description.links[i].name);
        before = ",";
    }
    fputc(']', file);
}

static void write_elements(FILE *file, page_shapes *shapes, const cli_cell *cell) {
    const ovoid_robot_description *d = &cell->description;
    fputs(",\"elements\":[", file);
    for (size_t i = 0; i < d->element_count; i++) {
        const ovoid_robot_element *e = &d->elements[i];
        write_key(file, i ? ",{" : "{", "link", d->links[e->link].name);
        if (e->name) write_key(file, ",", "name", e->name);
        write_place(file, shapes, &(placed_shape){e->shape, e->solid, &e->pose});
        fputc('}', file);
    }
    fputc(']', file);
}

/// Writes what links hold, or what stands in the world.
static void write_obstacles(FILE *file, page_shapes *shapes, const cli_cell *cell, int is_held) {
    const char *before = "{";
    fprintf(file, ",\"%s\":[", is_held ? "held" : "obstacles");
    for (size_t i = 0; i < cell->body_count; i++) {
        const cell_body *o = &cell->bodies[i];
        const ovoid_placed_obstacle *at = &o->at;
        if ((at->link != OVOID_ROBOT_NONE) != is_held) continue;
        write_key(file, before, "name", o->name);
        if (is_held) write_key(file, ",", "link", cell->description.links[at->link].name);
        write_place(file, shapes, &(placed_shape){o->shape, o->solid, &at->pose});
        write_allowed(file, cell, at->id);
        fputc('}', file);
        before = ",{";
    }
    fputc(']', file);
}

static void write_paddings(FILE *file, const cli_cell *cell) {
    const char *before = "[";
    fputs(",\"paddings\":[", file);
    for (uint32_t i = 0; i < cell->description.link_count; i++) {
        double padding = ovoid_robot_cell_get_padding(cell->cell, i);
        if (!(padding > 0)) continue;
        fputs(before, file);
        page_write_text(file, cell->description.links[i].name);
        fputc(',', file);
        json_write_number(file, padding);
        fputc(']', file);
        before = ",[";
    }
    fputc(']', file);
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
            if (!has_element[b] || !ovoid_robot_cell_is_allowed(cell->cell, a, b)) continue;
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

/// Writes the clearance of a path and the steps that prove it. 0, or EXIT_INPUT after a message.
static int write_path(robot_page *p, const robot_page_source *s) {
    const ovoid_robot_query_options options = cell_make_options(s->settings);
    if (s->path->answer.status == OVOID_ROBOT_REFUSED) return 0;
    int code = page_write_steps(p->page.file, s->path, &p->page.left_out.steps);
    return code ? code : page_write_clearance(p->page.file, s->cell, s->states, s->checker, &options);
}

/// Writes the answers. 0, or EXIT_INPUT after a message.
static int write_answers(robot_page *p, const robot_page_source *s) {
    FILE *file = p->page.file, *answers = p->answers;
    p->answers = NULL;
    if (fclose(answers) != 0) return message_error("out of memory"), EXIT_INPUT;
    fputs(s->checker ? ",\"answers\":[],\"path\":{\"edges\":[" : ",\"answers\":[", file);
    page_copy_json(file, p->text, p->size);
    fputs("]", file);
    if (!s->checker) return 0;
    int code = s->path ? write_path(p, s) : 0;
    fputc('}', file);
    return code;
}

int robot_page_write(robot_page *p, const robot_page_source *s) {
    const page_head head = {s->urdf, NULL, "m", s->settings->margin > 0 ? s->settings->margin : -1};
    page_shapes shapes = {.items = NULL};
    if (!p->page.path) return 0;
    int code = page_begin(&p->page, &head);
    FILE *file = p->page.file;
    if (!code) code = add_shapes(&shapes, &p->page, s->cell);
    if (!code) code = page_shapes_write(&shapes, file);
    if (!code) {
        fputs(",\"bodies\":[],\"pairs\":[]", file);
        write_tree(file, s->cell);
        write_elements(file, &shapes, s->cell);
        write_obstacles(file, &shapes, s->cell, 1);
        write_obstacles(file, &shapes, s->cell, 0);
        write_paddings(file, s->cell);
        member_write_number(file, ",", "limit_slack", s->settings->slack);
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
