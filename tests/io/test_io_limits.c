// What small and strange files may cost. Truth: each reader runs in a child process with little memory (setrlimit); it
// must refuse with a reason, not for want of memory, and not die. Its time ends where a reader hangs, and no sooner on
// a slow machine. Counts that lie, nesting, long lines; files that are none.
#define _XOPEN_SOURCE 700
#include "files.h"

#include "io/mesh/child.h"

#include <unistd.h>

// AddressSanitizer keeps freed memory for a while.
static const child_limits limits = {.memory = (size_t)96 << 20, .cpu_seconds = 3600, .seconds = 36000};

/// One reading: what and how, and what came of it.
typedef struct reading {
    const char *path;
    char kind; ///< 'm': mesh, 'p': its parts, 's': shape, 'c': scene, 'l': list, 'v': pairs, 'r': results
    ovoid_error error;
} reading;

static int read_records(ovoid_results_reader *reader, ovoid_error *error) {
    ovoid_record record;
    int got = reader ? 1 : -1;
    while (got > 0) got = ovoid_results_reader_read(reader, &record, error);
    ovoid_results_reader_close(reader);
    return got == 0;
}

static int read_pairs(ovoid_pairs_reader *reader, ovoid_error *error) {
    ovoid_indexed_pair pair;
    int got = reader ? 1 : -1;
    while (got > 0) got = ovoid_pairs_reader_read(reader, &pair, error);
    ovoid_pairs_reader_close(reader);
    return got == 0;
}

// 1 if it was accepted.
static int read_any(reading *r) {
    ovoid_read_options options = {.parts = r->kind == 'p'};
    void *got = NULL;
    switch (r->kind) {
    case 's': got = ovoid_shape_read_file(r->path, NULL, NULL, &r->error); break;
    case 'c': got = ovoid_scene_read(r->path, NULL, &r->error); break;
    case 'l': got = ovoid_shapes_read_list(r->path, NULL, NULL, &r->error); break;
    case 'v': return read_pairs(ovoid_pairs_reader_open(r->path, 2, &r->error), &r->error);
    case 'r': return read_records(ovoid_results_reader_open(r->path, &r->error), &r->error);
    default: got = ovoid_mesh_read(r->path, &options, &r->error); break;
    }
    return got != NULL; // the child ends with it
}

static void work(int output, void *context) {
    reading *r = context;
    if (read_any(r)) r->error.code = OVOID_OK;
    child_write(output, &r->error, sizeof r->error);
}

// Reads in a child; 0 where the child died.
static int run(reading *r) {
    child c;
    size_t size = 0;
    ptrdiff_t n = 1;
    ovoid_error error;
    r->error = (ovoid_error){OVOID_OK, -1, ""};
    if (child_start(&c, &limits, work, r)) return 0;
    while (size < sizeof error && (n = child_read(&c, (char *)&error + size, sizeof error - size)) > 0)
        size += (size_t)n;
    child_end end = child_finish(&c, 0);
    r->error = error;
    return size == sizeof error && !end.signal && !end.is_late;
}

static void expect(char kind, const char *path, ovoid_code wanted, const char *phrase) {
    reading r = {.path = path, .kind = kind};
    int lived = run(&r);
    if (!CHECK(lived && r.error.code == wanted && strstr(r.error.message, phrase)))
        printf("  %s: lived %d, code %d, \"%.200s\"\n", path, lived, lived ? (int)r.error.code : -1,
               lived ? r.error.message : "");
}

static void expect_text(char kind, const char *name, const char *text, ovoid_code wanted, const char *phrase) {
    expect(kind, file_write_text(name, text), wanted, phrase);
}

// ---- counts that lie

static void check_counts(void) {
    static const char *const counts[] = {"4294967295", "4294967296",          "9223372036854775807",
                                         "1000000000", "9223372036854775808", "99999999999999999999999999"};
    char text[300];
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        snprintf(text, sizeof text, "OFF\n%s 0 0\n0 0 0\n", counts[i]);
        expect_text('m', "count.off", text, OVOID_ERROR_FORMAT, "do not fit");
        snprintf(text, sizeof text, "OFF\n1 %s 0\n0 0 0\n", counts[i]);
        expect_text('m', "count.off", text, OVOID_ERROR_FORMAT, "do not fit");
        snprintf(text, sizeof text, "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n%s 0 1 2\n", counts[i]);
        expect_text('m', "count.off", text, OVOID_ERROR_FORMAT, "number of vertices");
        snprintf(text, sizeof text, "v 0 0 0\nf %s 1 1\n", counts[i]);
        expect_text('m', "count.obj", text, OVOID_ERROR_INDEX, "no vertex");
        snprintf(text, sizeof text, "v 0 0 0\nf -%s 1 1\n", counts[i]);
        expect_text('m', "count.obj", text, OVOID_ERROR_INDEX, "no vertex");
        for (int binary = 0; binary < 2; binary++) {
            const char *format = binary ? "binary_little_endian" : "ascii";
            snprintf(text, sizeof text,
                     "ply\nformat %s 1.0\nelement vertex %s\nproperty float x\nproperty float y\n"
                     "property float z\nend_header\n0 0 0\n",
                     format, counts[i]);
            expect_text('m', "count.ply", text, OVOID_ERROR_FORMAT, "promises");
            snprintf(text, sizeof text,
                     "ply\nformat %s 1.0\nelement junk %s\nelement vertex 1\nproperty float x\n"
                     "property float y\nproperty float z\nend_header\n0 0 0\n",
                     format, counts[i]);
            expect_text('m', "count.ply", text, OVOID_ERROR_FORMAT, "no properties");
        }
        snprintf(text, sizeof text,
                 "{\"objects\":[{\"name\":\"a\",\"cone\":{\"radius\":1,\"length\":1,\"sides\":%s}}]}", counts[i]);
        expect_text('c', "count.json", text, OVOID_ERROR_FORMAT, "sides");
    }
    expect_text('m', "count.off", "OFF\n-1 0 0\n", OVOID_ERROR_FORMAT, "three numbers >= 0");
    expect_text('m', "count.off", "OFF\nnan 0 0\n", OVOID_ERROR_FORMAT, "three numbers >= 0");
    expect_text('m', "count.off", "OFF\n1e9 0 0\n", OVOID_ERROR_FORMAT, "three numbers >= 0");
    expect_text('m', "count.ply", "ply\nformat ascii 1.0\nelement vertex -5\n", OVOID_ERROR_FORMAT, "count >= 0");
    // A list of 4 294 967 295 numbers.
    static const char list[] =
        "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\n"
        "property float y\nproperty float z\nelement face 1\n"
        "property list uint int vertex_indices\nend_header\n\0\0\0\0\0\0\0\0\0\0\0\0\xff\xff\xff\xff";
    expect('m', file_write("list.ply", list, sizeof list - 1), OVOID_ERROR_FORMAT, "a list of");
}

static void check_binary_counts(void) {
    unsigned char stl[84] = {0}, shape[400] = {0x89, 'O', 'V', 'O', 'I', 'D', '\n', 0x1a, 1};
    memset(stl + 80, 0xff, 4);
    expect('m', file_write("count.stl", stl, sizeof stl), OVOID_ERROR_FORMAT, "truncated");
    // Every place of the header where a count may be.
    for (size_t at = 8; at + 4 <= 32; at++) {
        unsigned char kept[4];
        memcpy(kept, shape + at, 4);
        memset(shape + at, 0xff, 4);
        expect('s', file_write("count.ovoid", shape, sizeof shape), OVOID_ERROR_FORMAT, "byte");
        memcpy(shape + at, kept, 4);
    }
}

// ---- nesting and long lines

// `count` times a piece of text between two others.
static const char *write_repeated(const char *name, const char *before, const char *piece, size_t count,
                                  const char *after) {
    const char *path = file_path(name);
    FILE *file = fopen(path, "wb");
    if (!file) exit(2);
    fputs(before, file);
    for (size_t i = 0; i < count; i++) fputs(piece, file);
    fputs(after, file);
    if (fclose(file)) exit(2);
    return path;
}

static void check_long(void) {
    expect('c', write_repeated("deep.json", "", "[", 1000000, ""), OVOID_ERROR_LIMIT, "more than 64 deep");
    expect('c', write_repeated("deep.json", "", "{\"objects\":", 1000000, ""), OVOID_ERROR_LIMIT, "more than 64 deep");
    expect('c', write_repeated("deep.json", "{\"objects\":[", "[", 1000, ""), OVOID_ERROR_LIMIT, "more than 64 deep");
    expect('r', write_repeated("deep.jsonl", "{\"a\":", "[", 900000, ""), OVOID_ERROR_LIMIT, "more than 64 deep");
    expect('r', write_repeated("long.jsonl", "", " ", 40000000, "\n"), OVOID_ERROR_LIMIT, "the line has more than");
    expect('r', write_repeated("long.jsonl", "{\"proof\":{\"cover\":{\"pairs\":[", "[0,0],", 150000, "[0,0]]}}}"),
           OVOID_ERROR_FORMAT, "missing");
    expect('v', write_repeated("long.csv", "a,b", ",", 3000000, "\n"), OVOID_ERROR_LIMIT, "the line has more than");
    expect('c', write_repeated("digits.json", "{\"objects\":[{\"name\":\"a\",\"sphere\":", "1", 1000000, "}]}"),
           OVOID_ERROR_FORMAT, "JSON");
    expect('m', write_repeated("digits.off", "OFF\n1 0 0\n0 0 ", "9", 1000000, "\n"), OVOID_ERROR_FORMAT,
           "is not a coordinate");
    expect('m', write_repeated("words.obj", "v 0 0 ", "x", 1000000, "\n"), OVOID_ERROR_FORMAT, "coordinate");
    expect('l', write_repeated("long.txt", "", "a", 1000000, "\n"), OVOID_ERROR_FILE, "");
    // Parts of a few bytes each.
    expect('p', write_repeated("parts.obj", "v 0 0 0\n", "o\np 1\n", 70000, ""), OVOID_ERROR_LIMIT, "parts");
    expect('p', write_repeated("parts.stl", "", "solid\nendsolid\n", 70000, ""), OVOID_ERROR_LIMIT, "parts");
    // Many bytes, one point.
    expect('m', write_repeated("same.obj", "", "v 0 0 0\n", 500000, ""), OVOID_OK, "");
    expect('m', write_repeated("faces.obj", "v 0 0 0\n", "f 1 1 1\n", 500000, ""), OVOID_OK, "");
}

// ---- files that are none

static void check_no_files(void) {
    char folder[512], pipe_path[512];
    snprintf(folder, sizeof folder, "%s", file_path("a_folder.off"));
    snprintf(pipe_path, sizeof pipe_path, "%s", file_path("a_pipe.off"));
    mkdir(folder, 0777);
    remove(pipe_path);
    CHECK(mkfifo(pipe_path, 0600) == 0);
    for (const char *kind = "mscl"; *kind; kind++) {
        expect(*kind, folder, OVOID_ERROR_FILE, "not a regular file");
        expect(*kind, pipe_path, OVOID_ERROR_FILE, "not a regular file");
        expect(*kind, "/dev/zero", OVOID_ERROR_FILE, "not a regular file");
        expect(*kind, file_path("is_not_there"), OVOID_ERROR_FILE, "cannot be opened");
        expect(*kind, file_write("none.off", "", 0), OVOID_ERROR_EMPTY, "empty");
    }
    // What is read line by line may be a device: its endless line ends at the limit.
    for (const char *kind = "vr"; *kind; kind++) {
        expect(*kind, folder, OVOID_ERROR_FILE, "cannot be read");
        expect(*kind, "/dev/zero", OVOID_ERROR_LIMIT, "the line has more than");
        expect(*kind, file_path("is_not_there"), OVOID_ERROR_FILE, "cannot be opened");
    }
    // More than is read, without a byte on the disk.
    const char *large = file_write("large.off", "OFF", 3);
    CHECK(truncate(large, (off_t)OVOID_FILE_SIZE_MAX + 1) == 0);
    expect('m', large, OVOID_ERROR_LIMIT, "at most");
    expect('c', large, OVOID_ERROR_LIMIT, "at most");
    remove(large);
    if (geteuid() != 0) {
        const char *closed = file_write_text("closed.off", "OFF");
        CHECK(chmod(closed, 0) == 0);
        expect('m', closed, OVOID_ERROR_FILE, "Permission");
    } else
        check_skip("root may read everything");
}

// A file of sysfs says that it has 4096 bytes, and has few: as one that shrinks while it is read.
static void check_shrinking(void) {
    const char *path = "/sys/kernel/mm/transparent_hugepage/enabled";
    struct stat status;
    if (stat(path, &status) != 0 || status.st_size < 100) {
        check_skip("no file that is shorter than it says");
        return;
    }
    expect('c', path, OVOID_ERROR_FORMAT, "JSON");
    expect('l', path, OVOID_ERROR_FILE, "always");
}

int main(void) {
    check_counts();
    check_binary_counts();
    check_long();
    check_no_files();
    check_shrinking();
    return check_end();
}
