// Robots from texts, for the tests of their readers: files of the tests' folder, and the notes of their reading.
#ifndef OVOID_TESTS_ROBOT_FILES_H
#define OVOID_TESTS_ROBOT_FILES_H

#include "files.h"

#include "ovoid/robot_io.h"

/// The notes of one reading, one after another.
typedef struct note_list {
    char text[1 << 14];
    size_t length, count;
} note_list;

static note_list notes;

static inline void add_note(void *context, const ovoid_robot_note *note) {
    note_list *list = context;
    char line[2048];
    int length = snprintf(line, sizeof line, "%s:%lld: %s\n",
                          strrchr(note->path, '/') ? strrchr(note->path, '/') + 1 : note->path, (long long)note->line,
                          note->text);
    if (length < 0 || (size_t)length >= sizeof line) length = sizeof line - 1;
    list->count++;
    if (list->length + (size_t)length >= sizeof list->text) return;
    memcpy(list->text + list->length, line, (size_t)length + 1);
    list->length += (size_t)length;
}

/// Options that collect the notes; there are none at first.
static inline ovoid_robot_read_options make_read_options(void) {
    notes.length = notes.count = 0;
    notes.text[0] = 0;
    // Packages of the machine are not searched.
    return (ovoid_robot_read_options){
        .ros_package_path = "", .ament_prefix_path = "", .note = add_note, .context = &notes};
}

static inline int has_note(const char *phrase) {
    int found = strstr(notes.text, phrase) != NULL;
    if (!found) printf("  notes, without \"%s\":\n%s", phrase, notes.text);
    return found;
}

/// The robot of a text; NULL after a failure, which is printed if error is NULL.
static inline ovoid_robot_file *read_urdf(const char *text, const ovoid_robot_read_options *options,
                                          ovoid_error *error) {
    ovoid_error own = {OVOID_OK, -1, ""};
    ovoid_robot_file *file =
        ovoid_robot_file_read(file_write_text("robot.urdf", text), NULL, options, error ? error : &own);
    if (!file && !error) printf("  %s\n", own.message);
    return file;
}

static inline ovoid_robot_file *read_both(const char *urdf, const char *srdf, const ovoid_robot_read_options *options,
                                          ovoid_error *error) {
    ovoid_error own = {OVOID_OK, -1, ""};
    const char *first = file_write_text("robot.urdf", urdf), *second = file_write_text("robot.srdf", srdf);
    ovoid_robot_file *file = ovoid_robot_file_read(first, second, options, error ? error : &own);
    if (!file && !error) printf("  %s\n", own.message);
    return file;
}

/// How many elements of that kind were ignored.
static inline size_t count_ignored(const ovoid_robot_file *file, const char *name) {
    for (size_t i = 0; i < ovoid_robot_file_get_ignored_count(file); i++) {
        ovoid_robot_ignored kind = ovoid_robot_file_get_ignored(file, i);
        if (strcmp(kind.name, name) == 0) return kind.count;
    }
    return 0;
}

#endif
