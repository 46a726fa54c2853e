// Cells from files, and names for what is in them.
#include "robot/cell_files.h"

#include "base/message.h"
#include "io/fields.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int compare_ids(const void *a, const void *b) {
    const cell_id *p = a, *q = b;
    return p->id < q->id ? -1 : p->id > q->id;
}

int cell_reserve_bodies(cli_cell *cell, size_t more) {
    size_t count = cell->body_count + more + 1;
    cell_body *bodies = realloc(cell->bodies, count * sizeof *bodies);
    if (bodies) cell->bodies = bodies;
    cell_id *ids = realloc(cell->ids, count * sizeof *ids);
    if (ids) cell->ids = ids;
    if (bodies && ids) return 0;
    message_error("out of memory");
    return EXIT_INPUT;
}

void cell_sort_ids(cli_cell *cell) {
    for (size_t i = 0; i < cell->body_count; i++) cell->ids[i] = (cell_id){cell->bodies[i].at.id, i};
    if (cell->body_count) qsort(cell->ids, cell->body_count, sizeof *cell->ids, compare_ids);
}

/// Tells of obstacles whose frame is a link: they stand still.
static void tell_frames(const cli_cell *cell, const char *scene) {
    for (size_t i = 0; i < ovoid_obstacles_get_count(cell->obstacles); i++) {
        ovoid_obstacle o = ovoid_obstacles_get(cell->obstacles, i);
        uint32_t link = o.frame && !o.link ? ovoid_robot_find_link(cell->robot.robot, o.frame) : OVOID_ROBOT_NONE;
        if (link == OVOID_ROBOT_NONE || link == ovoid_robot_get_root(cell->robot.robot)) continue;
        message_note("%s: %s is given in the frame of link %s: it stands where that is in the scene's robot_state, and "
                     "does not move with it",
                     scene, o.name, o.frame);
    }
}

/// Reads the scene and adds its obstacles. 0, or an exit code after a message.
static int add_obstacles(cli_cell *cell, const cell_settings *settings) {
    ovoid_error error;
    ovoid_robot_read_options options = {.tolerance = settings->robot->tolerance,
                                        .hull = settings->robot->hull,
                                        .note = robot_warn,
                                        .context = &cell->robot};
    if (!settings->scene) return 0;
    cell->obstacles = ovoid_obstacles_read(settings->scene, &options, &error);
    if (!cell->obstacles) return message_error("%s", error.message), EXIT_INPUT;
    size_t count = ovoid_obstacles_get_count(cell->obstacles);
    ovoid_placed_obstacle *placed = malloc((count + 1) * sizeof *placed);
    if (!placed || cell_reserve_bodies(cell, count)) return free(placed), EXIT_INPUT;
    ovoid_code code = ovoid_robot_cell_add_obstacles(cell->cell, cell->obstacles, placed, &error);
    for (size_t i = 0; i < count && !code; i++) {
        ovoid_obstacle o = ovoid_obstacles_get(cell->obstacles, i);
        cell->bodies[cell->body_count++] = (cell_body){o.name, o.shape, o.solid, placed[i]};
    }
    free(placed);
    if (code) return message_error("%s", error.message), EXIT_INPUT;
    tell_frames(cell, settings->scene);
    cell_sort_ids(cell);
    return 0;
}

int cell_set_paddings(const cli_command *command, const cli_cell *cell, ovoid_robot_cell *padded,
                      const args_list *given) {
    for (int pass = 0; pass < 2; pass++)
        for (int i = 0; i < given->count; i++) {
            ovoid_error error;
            link_value v;
            int code = robot_split_value(command, "padding", given->items[i], &v), is_of_all = !v.link[0];
            if (code) return code;
            if (is_of_all == pass) continue;
            uint32_t link = is_of_all ? 0 : ovoid_robot_find_link(cell->robot.robot, v.link);
            if (link == OVOID_ROBOT_NONE)
                return args_complain(command, "%s: --padding \"%s\": there is no such link", command->name,
                                     given->items[i]);
            size_t end = is_of_all ? cell->description.link_count : link + 1;
            for (; link < end; link++)
                if (ovoid_robot_cell_set_padding(padded, link, v.value, &error) != OVOID_OK)
                    return args_complain(command, "%s: --padding \"%s\": %s", command->name, given->items[i],
                                         error.message);
        }
    return 0;
}

int cell_open(const cli_command *command, const char *urdf, const cell_settings *settings, cli_cell *cell) {
    ovoid_error error;
    *cell = (cli_cell){.cell = NULL};
    int code = robot_open(command, urdf, settings->robot, &cell->robot);
    if (code) return code;
    cell->description = ovoid_robot_get_description(cell->robot.robot);
    cell->cell = ovoid_robot_cell_create(cell->robot.robot, NULL, &error);
    if (!cell->cell) message_error("%s: %s", urdf, error.message), code = EXIT_INPUT;
    if (!code) code = add_obstacles(cell, settings);
    // Those of the options count before those of the scene.
    if (!code) code = cell_set_paddings(command, cell, cell->cell, &settings->paddings);
    if (code) cell_close(cell);
    return code;
}

void cell_close(cli_cell *cell) {
    ovoid_robot_cell_destroy(cell->cell);
    ovoid_obstacles_destroy(cell->obstacles);
    cell_free_held(cell);
    free(cell->ids);
    free(cell->bodies);
    robot_close(&cell->robot);
    *cell = (cli_cell){.cell = NULL};
}

ovoid_robot_query_options cell_make_options(const cell_settings *settings) {
    return (ovoid_robot_query_options){.margin = settings->margin, .limit_slack = settings->slack};
}

// ---- names

/// The body of an id; body_count: there is none.
static size_t find_body(const cli_cell *cell, ovoid_id id) {
    const cell_id key = {id, 0};
    const cell_id *found = cell->ids ? bsearch(&key, cell->ids, cell->body_count, sizeof key, compare_ids) : NULL;
    return found ? found->body : cell->body_count;
}

/// The place of an obstacle among those of its name, which follow one another.
static cell_side get_obstacle(const cli_cell *cell, ovoid_id id) {
    size_t i = find_body(cell, id), first = i;
    if (i == cell->body_count) return (cell_side){.obstacle = "?", .is_alone = 1};
    const char *name = cell->bodies[i].name;
    while (first && strcmp(cell->bodies[first - 1].name, name) == 0) first--;
    int is_last = i + 1 == cell->body_count || strcmp(cell->bodies[i + 1].name, name) != 0;
    return (cell_side){.obstacle = name, .number = i - first, .is_alone = first == i && is_last};
}

/// What a link holds, as an element that has the object's name, behind the link's own.
static cell_side get_held(const cli_cell *cell, const ovoid_robot_side *side) {
    size_t at = find_body(cell, side->body);
    cell_side s = {.link = cell->description.links[side->link].name};
    for (size_t i = 0; i < cell->description.element_count; i++)
        s.number += cell->description.elements[i].link == side->link;
    for (size_t i = 0; i < at; i++) s.number += cell->bodies[i].at.link == side->link;
    s.element = at < cell->body_count ? cell->bodies[at].name : NULL;
    return s;
}

cell_side cell_get_side(const cli_cell *cell, const ovoid_robot_side *side) {
    const ovoid_robot_description *d = &cell->description;
    if (side->link == OVOID_ROBOT_NONE) return get_obstacle(cell, side->body);
    if (side->body) return get_held(cell, side);
    cell_side s = {.link = d->links[side->link].name, .is_alone = 1};
    for (uint32_t i = 0; i < d->element_count; i++) {
        if (d->elements[i].link != side->link || i == side->element) continue;
        s.is_alone = 0;
        s.number += i < side->element;
    }
    for (size_t i = 0; i < cell->body_count; i++) s.is_alone &= cell->bodies[i].at.link != side->link;
    if (side->element != OVOID_ROBOT_NONE) s.element = d->elements[side->element].name;
    return s;
}

int cell_format_side(char text[CELL_SIDE_ROOM], const cli_cell *cell, const ovoid_robot_side *side) {
    cell_side s = cell_get_side(cell, side);
    const char *name = s.link ? s.link : s.obstacle;
    if (s.is_alone) return snprintf(text, CELL_SIDE_ROOM, "%.60s", name);
    if (s.element) return snprintf(text, CELL_SIDE_ROOM, "%.60s[%.60s]", name, s.element);
    return snprintf(text, CELL_SIDE_ROOM, "%.60s[%zu]", name, s.number);
}

void cell_write_side_json(FILE *file, const cli_cell *cell, const ovoid_robot_side *side) {
    cell_side s = cell_get_side(cell, side);
    fputs(s.link ? "{\"link\":" : "{\"obstacle\":", file);
    ovoid_text_write_json(file, s.link ? s.link : s.obstacle);
    fprintf(file, ",\"%s\":%zu", s.link ? "element" : "part", s.number);
    if (s.element) {
        fputs(",\"name\":", file);
        ovoid_text_write_json(file, s.element);
    }
    fputc('}', file);
}

void cell_write_field(FILE *file, const char *text) {
    if (text) ovoid_text_write_csv(file, text);
}

/// Link and element, both empty for an obstacle.
static void write_link(FILE *file, const cell_side *s) {
    cell_write_field(file, s->link);
    fputc(',', file);
    if (s->link && s->element)
        cell_write_field(file, s->element);
    else if (s->link)
        fprintf(file, "%zu", s->number);
}

void cell_write_pair_csv(FILE *file, const cli_cell *cell, const ovoid_robot_side *a, const ovoid_robot_side *b) {
    if (!a) {
        fputs(",,,,,", file);
        return;
    }
    cell_side first = cell_get_side(cell, a), second = cell_get_side(cell, b);
    write_link(file, &first);
    fputc(',', file);
    write_link(file, &second);
    fputc(',', file);
    cell_write_field(file, second.obstacle);
    fputc(',', file);
    if (!second.link) fprintf(file, "%zu", second.number);
}

void cell_format_variable(char text[CELL_SIDE_ROOM], const cli_cell *cell, size_t variable) {
    ovoid_robot_variable v = ovoid_robot_get_variable(cell->robot.robot, variable);
    const ovoid_robot_joint *joint = &cell->description.joints[v.joint];
    snprintf(text, CELL_SIDE_ROOM, "%.100s%s", joint->name, robot_get_component(joint, v.component));
}

void cell_write_variable_name(FILE *file, const cli_cell *cell, size_t variable) {
    char name[CELL_SIDE_ROOM];
    cell_format_variable(name, cell, variable);
    message_write_text(file, name);
}

void cell_write_variable_json(FILE *file, const cli_cell *cell, size_t variable) {
    char name[CELL_SIDE_ROOM];
    cell_format_variable(name, cell, variable);
    ovoid_text_write_json(file, name);
}

const char *cell_get_status_name(ovoid_robot_status status) {
    static const char *const names[] = {"undecided", "free", "hit", "refused"};
    return names[status];
}

int cell_get_exit(ovoid_robot_status status) {
    if (status == OVOID_ROBOT_FREE) return EXIT_APART;
    return status == OVOID_ROBOT_HIT ? EXIT_TOUCH : EXIT_NOT_PROVEN;
}

void cell_format_bracket(char text[64], double lower, double upper) {
    ovoid_answer answer = {.lower = lower, .upper = upper};
    answer.status = lower > 0 ? OVOID_SEPARATED : upper < 0 ? OVOID_OVERLAPPING : OVOID_UNDECIDED;
    (void)ovoid_answer_write_distance(text, &answer);
}

/// The value of a joint that follows others.
static double get_value(const cli_cell *cell, uint32_t joint, const double *q) {
    const ovoid_robot_joint *j = &cell->description.joints[joint];
    if (j->mimic == OVOID_ROBOT_NONE) return q[ovoid_robot_get_joint_variable(cell->robot.robot, joint)];
    return j->multiplier * get_value(cell, j->mimic, q) + j->offset;
}

/// The first joint that follows the variable and is outside its limits; NONE: there is none.
static uint32_t find_follower(const cli_cell *cell, uint32_t variable, const double *q) {
    for (uint32_t i = 0; i < cell->description.joint_count; i++) {
        const ovoid_robot_joint *j = &cell->description.joints[i];
        int is_limited = j->type == OVOID_JOINT_REVOLUTE || j->type == OVOID_JOINT_PRISMATIC;
        if (j->mimic == OVOID_ROBOT_NONE || !is_limited ||
            ovoid_robot_get_joint_variable(cell->robot.robot, i) != variable)
            continue;
        double value = get_value(cell, i, q);
        if (value < j->lower || value > j->upper) return i;
    }
    return OVOID_ROBOT_NONE;
}

void cell_tell_outside(void) {
    message_note("limits are those of the URDF: if the robot may go farther, --limit-slack S takes states that are "
                 "outside by at most S, radians or metres");
}

void cell_tell_links(const cli_cell *cell, const ovoid_robot_side *a, const ovoid_robot_side *b) {
    if (a->element == OVOID_ROBOT_NONE || b->element == OVOID_ROBOT_NONE || cell->description.disabled_count) return;
    message_note(
        "two links of the robot touch, and no SRDF says which may, as neighbours do: give it by --srdf; \"ovoid "
        "robot matrix ROBOT.urdf -o ROBOT.srdf\" writes one");
}

void cell_write_refusal(FILE *file, const cli_cell *cell, const ovoid_robot_answer *answer, const double *q) {
    ovoid_robot_variable v = ovoid_robot_get_variable(cell->robot.robot, answer->variable);
    cell_write_variable_name(file, cell, answer->variable);
    double value = q[answer->variable];
    int is_outside = value < v.lower || value > v.upper;
    uint32_t follower = is_outside ? OVOID_ROBOT_NONE : find_follower(cell, answer->variable, q);
    if (is_outside) {
        fprintf(file, ": %.9g is outside its limits, %.9g .. %.9g", value, v.lower, v.upper);
    } else if (answer->code == OVOID_ERROR_RANGE && follower != OVOID_ROBOT_NONE) {
        const ovoid_robot_joint *j = &cell->description.joints[follower];
        fputs(": ", file);
        message_write_text(file, j->name);
        fprintf(file, ", which follows it, is %.9g, outside its limits, %.9g .. %.9g", get_value(cell, follower, q),
                j->lower, j->upper);
    } else {
        fprintf(file, ": %s", ovoid_code_get_name(answer->code));
    }
}

const char *cell_get_empty(void) {
    return "nothing is compared: no link has collision geometry that another link or an obstacle could touch (--visual "
           "takes visual geometry)";
}
