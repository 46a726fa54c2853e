// Finding the template, and checking it.
#include "page/template.h"

#include "base/args.h"
#include "base/beside.h"
#include "base/message.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/// The largest template, bytes.
#define SIZE_MOST ((size_t)64 << 20)

static int is_file(const char *path) {
    struct stat status;
    return stat(path, &status) == 0;
}

static int complain_absent(const char *beside, const char *shared) {
    message_error("--html: there is no template of the page: neither %s nor %s is there, and the environment variable "
                  "OVOID_PAGE is not set; \"make page\" in ovoid's sources builds it",
                  beside, shared);
    return EXIT_INPUT;
}

/// Finds the file. 0, or EXIT_INPUT after a message.
static int find(char path[BESIDE_PATH_ROOM]) {
    const char *given = getenv("OVOID_PAGE");
    char folder[BESIDE_FOLDER_ROOM], shared[BESIDE_PATH_ROOM];
    if (given && *given) {
        if (snprintf(path, BESIDE_PATH_ROOM, "%s", given) < BESIDE_PATH_ROOM) return 0;
        return message_error("--html: the path in OVOID_PAGE is too long"), EXIT_INPUT;
    }
    if (!beside_find_folder(folder)) return complain_absent("page.html", "../share/ovoid/page.html beside the program");
    snprintf(path, BESIDE_PATH_ROOM, "%s/page.html", folder);
    if (is_file(path)) return 0;
    snprintf(shared, BESIDE_PATH_ROOM, "%s/../share/ovoid/page.html", folder);
    if (!is_file(shared)) return complain_absent(path, shared);
    memcpy(path, shared, strlen(shared) + 1);
    return 0;
}

/// Reads all of a file. 0, or EXIT_INPUT after a message.
static int read_all(const char *path, page_template *t) {
    FILE *file = fopen(path, "rb");
    struct stat status;
    if (!file || fstat(fileno(file), &status) != 0) {
        message_error("--html: the template %s cannot be read: %s", path, strerror(errno));
        if (file) fclose(file);
        return EXIT_INPUT;
    }
    int code = 0;
    if (!S_ISREG(status.st_mode) || (uintmax_t)status.st_size > SIZE_MOST) {
        message_error("--html: the template %s is no file of at most %zu bytes", path, SIZE_MOST);
        code = EXIT_INPUT;
    } else if (!(t->text = malloc((size_t)status.st_size + 1))) {
        message_error("out of memory");
        code = EXIT_INPUT;
    } else {
        t->size = fread(t->text, 1, (size_t)status.st_size, file);
        t->text[t->size] = 0;
        if (t->size != (size_t)status.st_size)
            message_error("--html: the template %s could not be read in full", path), code = EXIT_INPUT;
    }
    fclose(file);
    return code;
}

/// The next mark from `at` on, also after zero bytes; the size if there is none.
static size_t find_mark(const page_template *t, size_t at) {
    const size_t length = sizeof PAGE_MARK - 1;
    for (; at + length <= t->size; at++)
        if (t->text[at] == '<' && memcmp(t->text + at, PAGE_MARK, length) == 0) return at;
    return t->size;
}

int page_template_read(page_template *t) {
    char path[BESIDE_PATH_ROOM];
    *t = (page_template){.text = NULL};
    int code = find(path);
    if (!code) code = read_all(path, t);
    if (!code) {
        t->mark = find_mark(t, 0);
        int is_there = t->mark < t->size;
        if (!is_there || find_mark(t, t->mark + 1) < t->size) {
            message_error("--html: %s is no template of the page: the text " PAGE_MARK " stands in it %s, and must "
                          "once; \"make page\" in ovoid's sources builds one",
                          path, is_there ? "several times" : "nowhere");
            code = EXIT_INPUT;
        }
    }
    if (code) page_template_clear(t);
    return code;
}

void page_template_clear(page_template *t) {
    free(t->text);
    *t = (page_template){.text = NULL};
}
