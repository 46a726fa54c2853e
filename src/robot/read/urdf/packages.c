// The order in which a package is looked for: the caller's own list, which alone counts for the packages that it names;
// ROS_PACKAGE_PATH (folders that hold packages, or are one); AMENT_PREFIX_PATH (share/NAME below each); then from the
// file's folder upwards, a folder of that name, or one that is it by its own name or by its package.xml. URDFs are
// often copied together with their meshes but without the package around them: at last, from the file's folder three
// folders up, the end of the path is looked for, the longest first, two folders or files long at least; the caller is
// told of that.
#define _XOPEN_SOURCE 700
#include "robot/read/urdf/packages.h"

#include "robot/read/text/xml.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { TAIL_FOLDERS = 4 };

static int is_file(const char *path) {
    struct stat status;
    return stat(path, &status) == 0 && S_ISREG(status.st_mode);
}

/// Writes "folder/middle/rest", of which middle may be empty. 0 where that is no path, being too long.
static int make_path(char path[PATH_MAX], const char *folder, size_t folder_length, const char *middle,
                     const char *rest) {
    const char *slash = folder_length && folder[folder_length - 1] == '/' ? "" : "/";
    if (folder_length >= PATH_MAX) return 0;
    int length = snprintf(path, PATH_MAX, "%.*s%s%s%s%s", (int)folder_length, folder, slash, middle,
                          *middle && *rest ? "/" : "", rest);
    return length > 0 && length < PATH_MAX;
}

/// Tries one place: FOUND, ABSENT or NO_MEMORY.
static package_result try_place(const package_search *s, const char *folder, const char *middle, const char *rest,
                                const char **path) {
    char whole[PATH_MAX];
    if (!make_path(whole, folder, strlen(folder), middle, rest) || !is_file(whole)) return PACKAGE_ABSENT;
    *path = pool_copy(s->memory, whole, strlen(whole));
    return *path ? PACKAGE_FOUND : PACKAGE_NO_MEMORY;
}

// ---- the folders above the file

/// The name in a folder's package.xml; NULL where there is none that can be read. 0 where there is no memory.
static int read_package_name(pool *memory, const char *folder, const char **found) {
    char path[PATH_MAX];
    xml_element *root;
    *found = NULL;
    if (!make_path(path, folder, strlen(folder), "", "package.xml") || !is_file(path)) return 1;
    ovoid_code code = xml_read(path, memory, &root, NULL);
    if (code) return code != OVOID_ERROR_MEMORY;
    const xml_element *name = xml_find(root, "name");
    if (name) *found = name->text;
    return 1;
}

int package_search_open(package_search *s, const char *urdf, const ovoid_robot_read_options *options, pool *memory) {
    *s = (package_search){.options = options, .memory = memory, .urdf = urdf};
    s->ros = options->ros_package_path ? options->ros_package_path : getenv("ROS_PACKAGE_PATH");
    s->ament = options->ament_prefix_path ? options->ament_prefix_path : getenv("AMENT_PREFIX_PATH");
    const char *slash = strrchr(urdf, '/');
    const char *folder = slash ? pool_copy(memory, urdf, slash == urdf ? 1 : (size_t)(slash - urdf)) : ".";
    char whole[PATH_MAX];
    if (!folder) return 0;
    if (!realpath(folder, whole)) return 1; // the file itself cannot be read then
    for (size_t length = strlen(whole); s->above_count < PACKAGES_ANCESTORS_MAX;) {
        const char *above = pool_copy(memory, whole, length), *name;
        if (!above || !read_package_name(memory, above, &name)) return 0;
        s->above[s->above_count++] = (package_folder){above, name};
        if (length <= 1) break;
        while (length && whole[length - 1] != '/') length--;
        if (length > 1) length--; // the slash, but that of the root
    }
    return 1;
}

// ---- packages

/// The entry of the caller's list with the longest name that the address begins with; *rest is what follows.
static const ovoid_robot_package *find_given(const package_search *s, const char *address, const char **rest) {
    const ovoid_robot_package *best = NULL;
    size_t longest = 0;
    for (size_t i = 0; i < s->options->package_count; i++) {
        const ovoid_robot_package *p = &s->options->packages[i];
        size_t length = strlen(p->name);
        if (length <= longest || strncmp(address, p->name, length) != 0 || address[length] != '/') continue;
        best = p, longest = length;
        *rest = address + length + 1;
    }
    return best;
}

/// The last folder of a path.
static const char *get_base(const char *path) {
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

/// Tries each of the folders of a list with colons between: FOLDER/between/NAME/rest and, where nothing is between,
/// FOLDER/rest if the folder has that name.
static package_result try_list(const package_search *s, const char *list, const char *between, const char *name,
                               const char *rest, const char **path) {
    package_result result = PACKAGE_ABSENT;
    for (const char *at = list; at && *at && result == PACKAGE_ABSENT;) {
        size_t length = strcspn(at, ":");
        char folder[PATH_MAX], itself[PATH_MAX];
        if (length && make_path(folder, at, length, between, name)) result = try_place(s, folder, "", rest, path);
        if (length && result == PACKAGE_ABSENT && !*between && make_path(itself, at, length, "", "")) {
            itself[strlen(itself) - 1] = 0; // the slash
            if (strcmp(get_base(itself), name) == 0) result = try_place(s, itself, "", rest, path);
        }
        at += length + (at[length] == ':');
    }
    return result;
}

static package_result try_above(const package_search *s, const char *name, const char *rest, const char **path) {
    package_result result = PACKAGE_ABSENT;
    for (size_t i = 0; i < s->above_count && result == PACKAGE_ABSENT; i++) {
        const package_folder *f = &s->above[i];
        result = try_place(s, f->path, name, rest, path);
        int is_it = strcmp(get_base(f->path), name) == 0 || (f->name && strcmp(f->name, name) == 0);
        if (result == PACKAGE_ABSENT && is_it) result = try_place(s, f->path, "", rest, path);
    }
    return result;
}

/// 1 if ".." leads out of the folder in which the path begins, wherever links lead.
static int leaves(const char *path) {
    long depth = 0;
    for (const char *at = path; *at;) {
        size_t length = strcspn(at, "/");
        if (length == 2 && at[0] == '.' && at[1] == '.') {
            if (--depth < 0) return 1;
        } else if (length && !(length == 1 && at[0] == '.')) {
            depth++;
        }
        at += length + (at[length] == '/');
    }
    return 0;
}

static package_result try_tails(const package_search *s, const char *rest, const char **path) {
    for (size_t i = 0; i < s->above_count && i < TAIL_FOLDERS; i++)
        for (const char *tail = rest; tail && strchr(tail, '/');) {
            package_result result = leaves(tail) ? PACKAGE_ABSENT : try_place(s, s->above[i].path, "", tail, path);
            if (result == PACKAGE_FOUND) return PACKAGE_FOUND_BY_TAIL;
            if (result != PACKAGE_ABSENT) return result;
            tail = strchr(tail, '/') + 1;
        }
    return PACKAGE_ABSENT;
}

static package_result find_package(const package_search *s, const char *address, const char **path) {
    const char *rest;
    const ovoid_robot_package *given = find_given(s, address, &rest);
    if (given) return leaves(rest) ? PACKAGE_LEFT : try_place(s, given->folder, "", rest, path);
    size_t length = strcspn(address, "/");
    const char *name = pool_copy(s->memory, address, length);
    rest = address + length + (address[length] == '/');
    if (!name) return PACKAGE_NO_MEMORY;
    if (!*name || !*rest) return PACKAGE_UNKNOWN;
    if (leaves(rest) || strcmp(name, "..") == 0 || strcmp(name, ".") == 0) return PACKAGE_LEFT;
    package_result result = try_list(s, s->ros, "", name, rest, path);
    if (result == PACKAGE_ABSENT) result = try_list(s, s->ament, "share", name, rest, path);
    if (result == PACKAGE_ABSENT) result = try_above(s, name, rest, path);
    return result == PACKAGE_ABSENT ? try_tails(s, rest, path) : result;
}

/// The path of an address that is no package's, relative to the file; NULL where it is something else.
static const char *get_path(const char *address) {
    if (strncmp(address, "file://", 7) == 0) return address + 7;
    return strstr(address, "://") ? NULL : address;
}

package_result package_search_find(const package_search *s, const char *address, const char **path) {
    if (strlen(address) >= PATH_MAX) return PACKAGE_UNKNOWN;
    if (strncmp(address, "package://", 10) == 0) return find_package(s, address + 10, path);
    const char *plain = get_path(address);
    if (!plain || !*plain) return PACKAGE_UNKNOWN;
    char *joined = path_join(s->urdf, plain);
    *path = joined ? pool_copy(s->memory, joined, strlen(joined)) : NULL;
    free(joined);
    if (!*path) return PACKAGE_NO_MEMORY;
    return is_file(*path) ? PACKAGE_FOUND : PACKAGE_ABSENT;
}

void package_search_describe(const package_search *s, const char *address, char *text, size_t room) {
    const char *rest, *plain = get_path(address);
    if (plain) {
        (void)snprintf(text, room, "looked for %s%s", plain, *plain == '/' ? "" : " beside the URDF");
        return;
    }
    const ovoid_robot_package *given = find_given(s, address + 10, &rest);
    if (given) {
        (void)snprintf(text, room, "looked for %s in %s, the folder given for %s", rest, given->folder, given->name);
        return;
    }
    (void)snprintf(text, room,
                   "looked in ROS_PACKAGE_PATH (%s), in AMENT_PREFIX_PATH (%s), and from %s upwards for a folder %.*s",
                   s->ros && *s->ros ? s->ros : "not set", s->ament && *s->ament ? s->ament : "not set",
                   s->above_count ? s->above[0].path : ".", (int)strcspn(address + 10, "/"), address + 10);
}
