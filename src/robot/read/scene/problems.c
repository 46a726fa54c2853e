// Planning problems of a folder, as MotionBenchMaker writes them (C. Chamzas and others, MotionBenchMaker: a tool to
// generate and benchmark motion planning datasets, 2022): sceneX.yaml and requestX.yaml beside each other. Cost: n log
// n in the files.
#define _POSIX_C_SOURCE 200809L
#include "robot/read/text/pool.h"

#include "ovoid/robot_io.h"

#include <dirent.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { FOLDERS_DEEP = 3 };

struct ovoid_problems {
    pool memory;
    ovoid_problem *items;
    size_t count, capacity;
};

/// The state of the search.
typedef struct problem_search {
    const char *root;
    ovoid_problems *out;
    ovoid_error *error;
} problem_search;

/// "folder/first rest", without the blank; NULL where there is no memory.
static char *join(pool *memory, const char *folder, const char *first, const char *rest) {
    size_t size = strlen(folder) + strlen(first) + strlen(rest) + 2;
    char *path = pool_get(memory, size, 1);
    if (path) (void)snprintf(path, size, "%s/%s%s", folder, first, rest);
    return path;
}

static int is_request(const char *name) {
    size_t length = strlen(name);
    if (strncmp(name, "request", 7) != 0) return 0;
    return (length > 5 && strcmp(name + length - 5, ".yaml") == 0) ||
           (length > 4 && strcmp(name + length - 4, ".yml") == 0);
}

// The problem of a request, whose scene has the same name but for its first word.
static ovoid_code add_problem(const problem_search *s, const char *below, const char *folder, const char *file) {
    ovoid_problems *out = s->out;
    struct stat status;
    pool *memory = &out->memory;
    const char *rest = file + strlen("request");
    char *request = join(memory, folder, file, ""), *scene = join(memory, folder, "scene", rest),
         *name = join(memory, below, rest, "");
    if (!request || !scene || !name ||
        !array_reserve((void **)&out->items, &out->capacity, out->count, sizeof *out->items))
        return io_fail_memory(s->error, s->root);
    name[strlen(name) - strlen(strrchr(rest, '.'))] = 0;
    if (stat(scene, &status) != 0)
        return io_fail(s->error, OVOID_ERROR_FILE, (where){request, 0, -1}, "there is no scene%s beside it", rest);
    out->items[out->count++] = (ovoid_problem){below[0] ? name : name + 1, scene, request};
    return OVOID_OK;
}

static ovoid_code search(const problem_search *s, const char *below, int deep);

static ovoid_code look_at(const problem_search *s, const char *below, const char *folder, const char *name, int deep) {
    struct stat status;
    pool *memory = &s->out->memory;
    if (name[0] == '.') return OVOID_OK;
    if (is_request(name)) return add_problem(s, below, folder, name);
    if (deep == FOLDERS_DEEP) return OVOID_OK;
    const char *path = join(memory, folder, name, ""), *deeper = below[0] ? join(memory, below, name, "") : NULL;
    if (!below[0]) deeper = pool_copy(memory, name, strlen(name));
    if (!path || !deeper) return io_fail_memory(s->error, s->root);
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode) ? search(s, deeper, deep + 1) : OVOID_OK;
}

static ovoid_code search(const problem_search *s, const char *below, int deep) {
    const char *folder = below[0] ? join(&s->out->memory, s->root, below, "") : s->root;
    if (!folder) return io_fail_memory(s->error, s->root);
    DIR *listing = opendir(folder);
    if (!listing)
        return io_fail(s->error, OVOID_ERROR_FILE, (where){folder, 0, -1}, "is no folder that can be read: %s",
                       strerror(errno));
    ovoid_code code = OVOID_OK;
    for (struct dirent *entry; !code && (entry = readdir(listing)) != NULL;)
        code = look_at(s, below, folder, entry->d_name, deep);
    closedir(listing);
    return code;
}

static int compare_problems(const void *a, const void *b) {
    const ovoid_problem *m = a, *n = b;
    int order = strcmp(m->name, n->name);
    return order ? order : strcmp(m->request, n->request);
}

ovoid_problems *ovoid_problems_find(const char *folder, ovoid_error *error) {
    problem_search s = {folder, calloc(1, sizeof *s.out), error};
    ovoid_code code = s.out ? search(&s, "", 0) : io_fail_memory(error, folder);
    if (!code && !s.out->count)
        code = io_fail(error, OVOID_ERROR_EMPTY, (where){folder, 0, -1},
                       "there are no problems: files sceneX.yaml and requestX.yaml");
    if (!code) {
        qsort(s.out->items, s.out->count, sizeof *s.out->items, compare_problems);
        return s.out;
    }
    ovoid_problems_destroy(s.out);
    return NULL;
}

void ovoid_problems_destroy(ovoid_problems *problems) {
    if (!problems) return;
    free(problems->items);
    pool_clear(&problems->memory);
    free(problems);
}

size_t ovoid_problems_get_count(const ovoid_problems *problems) { return problems->count; }
ovoid_problem ovoid_problems_get(const ovoid_problems *problems, size_t i) { return problems->items[i]; }
