// Robots: a description checked, copied into one block and compiled; what it is made of.
#include "robot/model/pair_table.h"

#include "base/allocator.h"
#include "base/environment.h"
#include "base/error.h"

#include <stdlib.h>
#include <string.h>

// The next 64-byte boundary after count items from *at; where they begin.
static size_t advance(size_t *at, size_t count, size_t size) {
    size_t start = *at;
    *at = (start + count * size + 63) / 64 * 64;
    return start;
}

// The places of the arrays in the block.
typedef struct layout {
    size_t links, joints, elements, disabled, link_names, joint_names, parent_joint, order, joint_variable, variables,
        leads, steps, step_of, value_first, sources, element_inside, free_values, followers, tables, text, size;
} layout;

static size_t text_size(const char *text) { return text ? strlen(text) + 1 : 0; }

static size_t compute_text_size(const ovoid_robot_description *d) {
    size_t size = text_size(d->name) + text_size(d->frame);
    for (size_t i = 0; i < d->link_count; i++) size += text_size(d->links[i].name);
    for (size_t i = 0; i < d->joint_count; i++) size += text_size(d->joints[i].name);
    for (size_t i = 0; i < d->element_count; i++) size += text_size(d->elements[i].name);
    for (size_t i = 0; i < d->disabled_count; i++) size += text_size(d->disabled[i].reason);
    return size;
}

static size_t count_variables(const ovoid_robot_description *d) {
    size_t count = 0;
    for (size_t i = 0; i < d->joint_count; i++)
        if (d->joints[i].mimic == OVOID_ROBOT_NONE) count += ovoid_joint_type_get_variable_count(d->joints[i].type);
    return count;
}

static size_t count_values(const ovoid_robot_description *d) {
    size_t count = 0;
    for (size_t i = 0; i < d->joint_count; i++) count += ovoid_joint_type_get_variable_count(d->joints[i].type);
    return count;
}

static layout make_layout(const ovoid_robot_description *d) {
    layout l;
    l.size = 0;
    (void)advance(&l.size, 1, sizeof(ovoid_robot));
    l.links = advance(&l.size, d->link_count, sizeof(ovoid_robot_link));
    l.joints = advance(&l.size, d->joint_count, sizeof(ovoid_robot_joint));
    l.elements = advance(&l.size, d->element_count, sizeof(ovoid_robot_element));
    l.disabled = advance(&l.size, d->disabled_count, sizeof(ovoid_robot_pair));
    l.link_names = advance(&l.size, d->link_count, sizeof(robot_name));
    l.joint_names = advance(&l.size, d->joint_count, sizeof(robot_name));
    l.parent_joint = advance(&l.size, d->link_count, sizeof(uint32_t));
    l.order = advance(&l.size, d->joint_count, sizeof(uint32_t));
    l.joint_variable = advance(&l.size, d->joint_count, sizeof(uint32_t));
    l.variables = advance(&l.size, count_variables(d), sizeof(ovoid_robot_variable));
    l.leads = advance(&l.size, d->joint_count, sizeof(joint_lead));
    l.steps = advance(&l.size, d->joint_count, sizeof(chain_step));
    l.step_of = advance(&l.size, d->joint_count, sizeof(uint32_t));
    l.value_first = advance(&l.size, d->joint_count, sizeof(uint32_t));
    l.sources = advance(&l.size, count_values(d), sizeof(value_source));
    l.followers = advance(&l.size, d->joint_count, sizeof(uint32_t));
    l.free_values = advance(&l.size, d->joint_count, sizeof(uint32_t));
    l.element_inside = advance(&l.size, d->element_count, sizeof(uint32_t));
    l.tables = advance(&l.size, 1, sizeof(pair_tables_once));
    l.text = advance(&l.size, compute_text_size(d), 1);
    return l;
}

// An item's text, copied behind what was copied before; NULL stays NULL.
static const char *copy_text(char **at, const char *text) {
    if (!text) return NULL;
    size_t size = strlen(text) + 1;
    const char *copy = memcpy(*at, text, size);
    *at += size;
    return copy;
}

static void copy_texts(ovoid_robot *r, char *at) {
    r->of.name = copy_text(&at, r->of.name);
    r->of.frame = copy_text(&at, r->of.frame);
    for (uint32_t i = 0; i < r->link_count; i++) r->links[i].name = copy_text(&at, r->links[i].name);
    for (uint32_t i = 0; i < r->joint_count; i++) r->joints[i].name = copy_text(&at, r->joints[i].name);
    for (uint32_t i = 0; i < r->element_count; i++) r->elements[i].name = copy_text(&at, r->elements[i].name);
    for (uint32_t i = 0; i < r->disabled_count; i++) r->disabled[i].reason = copy_text(&at, r->disabled[i].reason);
}

static int compare_pairs(const void *x, const void *y) {
    const ovoid_robot_pair *p = x, *q = y;
    if (p->a != q->a) return p->a < q->a ? -1 : 1;
    return (p->b > q->b) - (p->b < q->b);
}

// Disabled pairs: a < b, sorted, each once. Of equal ones which reason is kept is not said; a link beside itself is
// left out.
static void sort_disabled(ovoid_robot *r) {
    uint32_t count = 0;
    for (uint32_t i = 0; i < r->disabled_count; i++) {
        ovoid_robot_pair p = r->disabled[i];
        if (p.a == p.b) continue;
        r->disabled[count++] = p.a < p.b ? p : (ovoid_robot_pair){p.b, p.a, p.reason};
    }
    qsort(r->disabled, count, sizeof *r->disabled, compare_pairs);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < count; i++)
        if (kept == 0 || compare_pairs(&r->disabled[kept - 1], &r->disabled[i]) != 0)
            r->disabled[kept++] = r->disabled[i];
    r->disabled_count = kept;
}

static void copy_items(void *to, const void *from, size_t count, size_t size) {
    if (count) memcpy(to, from, count * size);
}

// The block with the description copied into it.
static ovoid_robot *create_copy(const ovoid_robot_description *d, const ovoid_allocator *memory) {
    layout l = make_layout(d);
    char *block = allocator_allocate(memory, 1, l.size);
    if (!block) return NULL;
    ovoid_robot *r = (ovoid_robot *)(void *)block;
    *r = (ovoid_robot){.of = *d,
                       .link_count = (uint32_t)d->link_count,
                       .joint_count = (uint32_t)d->joint_count,
                       .element_count = (uint32_t)d->element_count,
                       .disabled_count = (uint32_t)d->disabled_count,
                       .allocator = *memory};
    r->links = (void *)(block + l.links);
    r->joints = (void *)(block + l.joints);
    r->elements = (void *)(block + l.elements);
    r->disabled = (void *)(block + l.disabled);
    r->link_names = (void *)(block + l.link_names);
    r->joint_names = (void *)(block + l.joint_names);
    r->parent_joint = (void *)(block + l.parent_joint);
    r->order = (void *)(block + l.order);
    r->joint_variable = (void *)(block + l.joint_variable);
    r->variables = (void *)(block + l.variables);
    r->leads = (void *)(block + l.leads);
    r->steps = (void *)(block + l.steps);
    r->step_of = (void *)(block + l.step_of);
    r->value_first = (void *)(block + l.value_first);
    r->free_values = (void *)(block + l.free_values);
    r->followers = (void *)(block + l.followers);
    r->sources = (void *)(block + l.sources);
    r->tables = (void *)(block + l.tables);
    pair_tables_begin(r->tables);
    r->element_inside = (void *)(block + l.element_inside);
    copy_items(r->links, d->links, d->link_count, sizeof *r->links);
    copy_items(r->joints, d->joints, d->joint_count, sizeof *r->joints);
    copy_items(r->elements, d->elements, d->element_count, sizeof *r->elements);
    copy_items(r->disabled, d->disabled, d->disabled_count, sizeof *r->disabled);
    copy_texts(r, block + l.text);
    sort_disabled(r);
    r->of.links = r->links, r->of.joints = r->joints, r->of.elements = r->elements, r->of.disabled = r->disabled;
    r->of.disabled_count = r->disabled_count;
    return r;
}

static ovoid_code sort_names(ovoid_robot *r, ovoid_error *error) {
    for (uint32_t i = 0; i < r->link_count; i++) r->link_names[i] = (robot_name){r->links[i].name, i};
    for (uint32_t i = 0; i < r->joint_count; i++) r->joint_names[i] = (robot_name){r->joints[i].name, i};
    uint32_t twice = names_sort(r->link_names, r->link_count);
    if (twice != OVOID_ROBOT_NONE)
        return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)twice, "two links are named \"%.80s\"",
                         r->links[twice].name);
    twice = names_sort(r->joint_names, r->joint_count);
    if (twice != OVOID_ROBOT_NONE)
        return error_set(error, OVOID_ERROR_ARGUMENT, (int64_t)twice, "two joints are named \"%.80s\"",
                         r->joints[twice].name);
    return OVOID_OK;
}

typedef struct shape_use {
    const ovoid_shape *shape;
    const ovoid_solid *solid;
    uint32_t element;
} shape_use;

static int compare_uses(const void *x, const void *y) {
    const shape_use *m = x, *n = y;
    uintptr_t a = (uintptr_t)m->shape, b = (uintptr_t)n->shape;
    if (a == b) a = (uintptr_t)m->solid, b = (uintptr_t)n->solid;
    return (a > b) - (a < b);
}

// What is inside the shapes, each of which is looked at once.
static ovoid_code find_insides(ovoid_robot *r, ovoid_error *error) {
    uint32_t count = 0;
    ovoid_shape *point = shape_create_point(&r->allocator);
    shape_use *uses = allocator_allocate(&r->allocator, (size_t)r->element_count + 1, sizeof *uses);
    for (uint32_t i = 0; uses && i < r->element_count; i++)
        uses[i] = (shape_use){r->elements[i].shape, r->elements[i].solid, i};
    if (uses && r->element_count) qsort(uses, r->element_count, sizeof *uses, compare_uses);
    for (uint32_t i = 0; uses && i < r->element_count; i++) {
        count += i == 0 || compare_uses(&uses[i], &uses[i - 1]) != 0;
        r->element_inside[uses[i].element] = count - 1;
    }
    r->insides = uses && point ? allocator_allocate(&r->allocator, (size_t)count + 1, sizeof *r->insides) : NULL;
    ovoid_code code = r->insides ? OVOID_OK : OVOID_ERROR_MEMORY;
    for (uint32_t i = 0; code == OVOID_OK && i < r->element_count; i++) {
        if (i > 0 && compare_uses(&uses[i], &uses[i - 1]) == 0) continue;
        shape_inside *inside = &r->insides[r->element_inside[uses[i].element]];
        code = shape_inside_find(uses[i].shape, uses[i].solid, point, inside);
        if (code == OVOID_OK && !outer_balls_find(uses[i].shape, &r->allocator, &inside->outer))
            code = OVOID_ERROR_MEMORY;
    }
    allocator_release(&r->allocator, uses);
    ovoid_shape_destroy(point);
    return code == OVOID_OK ? code : error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a robot's shapes");
}

// What is worked out from the copy.
static ovoid_code compile(ovoid_robot *r, ovoid_error *error) {
    ovoid_code code = sort_names(r, error);
    if (code == OVOID_OK) code = variables_find(r, error);
    if (code != OVOID_OK) return code;
    uint32_t *scratch = allocator_allocate(&r->allocator, (size_t)r->link_count + r->joint_count + 1, sizeof *scratch);
    if (!scratch) return error_set(error, OVOID_ERROR_MEMORY, -1, "no memory for a robot of %u links", r->link_count);
    code = tree_find_order(r, scratch, error);
    allocator_release(&r->allocator, scratch);
    if (code != OVOID_OK) return code;
    chain_compile(r);
    return find_insides(r, error);
}

static void release(ovoid_robot *r) {
    ovoid_allocator memory = r->allocator;
    pair_tables_end(r);
    allocator_release(&memory, r->insides);
    allocator_release(&memory, r);
}

static ovoid_robot *create(const ovoid_robot_description *d, const ovoid_robot_options *options, ovoid_error *error) {
    static const ovoid_robot_options none = {0, NULL};
    if (!options) options = &none;
    if (description_validate(d, error) != OVOID_OK) return NULL;
    ovoid_allocator memory = allocator_make(options->allocator);
    ovoid_robot *r = create_copy(d, &memory);
    if (!r) {
        error_write(error, OVOID_ERROR_MEMORY, -1, "no memory for a robot of %zu links", d->link_count);
        return NULL;
    }
    if (compile(r, error) == OVOID_OK) {
        r->takes_shapes = options->takes_shapes;
        return r;
    }
    release(r);
    return NULL;
}

ovoid_robot *ovoid_robot_create(const ovoid_robot_description *description, const ovoid_robot_options *options,
                                ovoid_error *error) {
    ENVIRONMENT_RETURN(ovoid_robot *, description, create(description, options, error));
}

static int compare_shapes(const void *x, const void *y) {
    const ovoid_robot_element *a = x, *b = y;
    return ((uintptr_t)a->shape > (uintptr_t)b->shape) - ((uintptr_t)a->shape < (uintptr_t)b->shape);
}

void element_destroy_shape(const ovoid_robot_element *element) {
    ovoid_shape *shape;
    memcpy(&shape, &element->shape, sizeof shape);
    ovoid_shape_destroy(shape);
}

void ovoid_robot_destroy(ovoid_robot *robot) {
    if (!robot) return;
    if (robot->takes_shapes) {
        qsort(robot->elements, robot->element_count, sizeof *robot->elements, compare_shapes);
        for (uint32_t i = 0; i < robot->element_count; i++)
            if (i == 0 || robot->elements[i].shape != robot->elements[i - 1].shape)
                element_destroy_shape(&robot->elements[i]);
    }
    ENVIRONMENT_RUN(release(robot));
}

ovoid_robot_description ovoid_robot_get_description(const ovoid_robot *robot) { return robot->of; }
uint32_t ovoid_robot_find_link(const ovoid_robot *robot, const char *name) {
    return names_find(robot->link_names, robot->link_count, name);
}
uint32_t ovoid_robot_find_joint(const ovoid_robot *robot, const char *name) {
    return names_find(robot->joint_names, robot->joint_count, name);
}
uint32_t ovoid_robot_get_root(const ovoid_robot *robot) { return robot->root; }
uint32_t ovoid_robot_get_parent_joint(const ovoid_robot *robot, uint32_t link) { return robot->parent_joint[link]; }
size_t ovoid_robot_get_variable_count(const ovoid_robot *robot) { return robot->variable_count; }
ovoid_robot_variable ovoid_robot_get_variable(const ovoid_robot *robot, size_t i) { return robot->variables[i]; }
uint32_t ovoid_robot_get_joint_variable(const ovoid_robot *robot, uint32_t joint) {
    return robot->joint_variable[joint];
}
