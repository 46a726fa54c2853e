// PAIRS.csv and output files. Truth: texts written here; what a folder holds after each outcome.
#define _XOPEN_SOURCE 700 // symlink, lstat
#define FILES_FOLDER "test_io_pairs"
#include "files.h"

#include <dirent.h>
#include <unistd.h>

#define HEADER "a,b,ax,ay,az,aqw,aqx,aqy,aqz,bx,by,bz,bqw,bqx,bqy,bqz\n"
#define GOOD "0,2,1,2,3,1,0,0,0,4,5,6,0,1,0,0\n"

static void check_good(void) {
    const char *path = file_write_text("good.csv", "\xef\xbb\xbf" HEADER GOOD
                                                   "\n 2 , 1 ,-1e-3,+2.5,0,\t0.5,.5,0.5,-0.5,0,0,0,2,0,0,0\r\n\r\n"
                                                   "1,1,0,0,0,1,0,0,0,0,0,0,1,0,0,0.1");
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_pairs_reader *reader = ovoid_pairs_reader_open(path, 3, &error);
    if (!CHECK(reader != NULL)) return;
    ovoid_indexed_pair p;
    int got = ovoid_pairs_reader_read(reader, &p, &error);
    CHECK(got == 1 && p.a == 0 && p.b == 2 && p.pose_a.position.z == 3 && p.pose_b.position.x == 4);
    CHECK(p.pose_a.rotation.w == 1 && p.pose_b.rotation.w == 0 && p.pose_b.rotation.x == 1);
    got = ovoid_pairs_reader_read(reader, &p, &error);
    CHECK(got == 1 && p.a == 2 && p.b == 1 && p.pose_a.position.x == -1e-3 && p.pose_a.position.y == 2.5);
    CHECK(p.pose_a.rotation.z == -0.5 && p.pose_b.rotation.w == 2);
    got = ovoid_pairs_reader_read(reader, &p, &error);
    CHECK(got == 1 && p.pose_b.rotation.z == 0.1);
    got = ovoid_pairs_reader_read(reader, &p, &error);
    CHECK(got == 0 && error.code == OVOID_OK);
    ovoid_pairs_reader_close(reader);
}

static const bad_input bad_files[] = {
    {"empty.csv", "", 1, "the file is empty", OVOID_ERROR_EMPTY},
    {"pointer.csv", "version https://git-lfs.github.com/spec/v1\n", -1, "is a Git LFS pointer"},
    {"header.csv", "a,b\n", 1, "the first line must be a,b,ax"},
    {"no_header.csv", GOOD, 1, "the first line must be"},
    {"few.csv", HEADER GOOD "0,1,2\n", 3, "fewer than 16 columns"},
    {"many.csv", HEADER "0,2,1,2,3,1,0,0,0,4,5,6,0,1,0,0,7\n", 2, "more than 16 columns"},
    {"word.csv", HEADER "0,2,1,2,3,1,0,0,0,4,5,six,0,1,0,0\n", 2, "column bz: \"six\""},
    {"blank.csv", HEADER "0,2,1,,3,1,0,0,0,4,5,6,0,1,0,0\n", 2, "column ay: \"\" is not a number"},
    {"glued.csv", HEADER "0,2,1 2,2,3,1,0,0,0,4,5,6,0,1,0\n", 2, "column ax: \"1 2\""},
    {"shape.csv", HEADER GOOD "0,3,1,2,3,1,0,0,0,4,5,6,0,1,0,0\n", 3, "no shape 3; the list has 3", OVOID_ERROR_INDEX},
    {"negative.csv", HEADER "-1,2,1,2,3,1,0,0,0,4,5,6,0,1,0,0\n", 2, "column a: there is no shape -1",
     OVOID_ERROR_INDEX},
    {"half.csv", HEADER "0.5,2,1,2,3,1,0,0,0,4,5,6,0,1,0,0\n", 2, "no shape 0.5", OVOID_ERROR_INDEX},
    {"nan.csv", HEADER "0,2,nan,2,3,1,0,0,0,4,5,6,0,1,0,0\n", 2, "column ax is not finite", OVOID_ERROR_NOT_FINITE},
    {"infinite.csv", HEADER "0,2,1,2,3,1,0,0,0,4,5,6,0,1,0,1e999\n", 2, "column bqz is not", OVOID_ERROR_NOT_FINITE},
    {"zero.csv", HEADER "0,2,1,2,3,1,0,0,0,4,5,6,0,0,0,0\n", 2, "pose of b has a quaternion of", OVOID_ERROR_ROTATION},
    {"far.csv", HEADER "0,2,1e99,2,3,1,0,0,0,4,5,6,0,1,0,0\n", 2, "pose of a has a number out of", OVOID_ERROR_RANGE},
};

static int read_all(const char *path, ovoid_error *error) {
    ovoid_pairs_reader *reader = ovoid_pairs_reader_open(path, 3, error);
    ovoid_indexed_pair pair;
    int got = reader ? 1 : -1;
    while (got == 1) got = ovoid_pairs_reader_read(reader, &pair, error);
    ovoid_pairs_reader_close(reader);
    return got;
}

static int accepts(const char *path, ovoid_error *error) { return read_all(path, error) != -1; }

static void check_bad(void) {
    check_bad_inputs(bad_files, sizeof bad_files / sizeof *bad_files, accepts);
    ovoid_error error;
    CHECK(read_all(file_path("absent.csv"), &error) == -1 && error.code == OVOID_ERROR_FILE);
    CHECK(read_all(OVOID_BUILD_DIR, &error) == -1 && error.code == OVOID_ERROR_FILE);
    CHECK(read_all(OVOID_BUILD_DIR, NULL) == -1);
    check_damaged_lines(HEADER, GOOD GOOD, read_all);
}

// Lines around the borders of the reader's buffer, 65536 bytes, come out whole.
static void check_many(void) {
    enum { COUNT = 5000 };
    const char *path = file_path("many.csv");
    FILE *file = fopen(path, "wb");
    fputs(HEADER, file);
    for (int i = 0; i < COUNT; i++)
        fprintf(file, "%d,%d,%d,%.17g,0,1,0,0,0,0,0,0,1,0,0,0\n", i, COUNT - 1 - i, i, i / 3.0);
    fclose(file);
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_pairs_reader *reader = ovoid_pairs_reader_open(path, COUNT, &error);
    ovoid_indexed_pair p;
    for (int i = 0; reader && i < COUNT; i++) {
        int got = ovoid_pairs_reader_read(reader, &p, &error);
        CHECK(got == 1 && p.a == (size_t)i && p.b == (size_t)(COUNT - 1 - i) && p.pose_a.position.x == i &&
              p.pose_a.position.y == i / 3.0);
    }
    CHECK(reader && ovoid_pairs_reader_read(reader, &p, &error) == 0);
    ovoid_pairs_reader_close(reader);
}

// ---- output files

static int count_files(const char *folder) {
    DIR *dir = opendir(folder);
    int count = 0;
    while (dir && readdir(dir)) count++;
    if (dir) closedir(dir);
    return count;
}

static void check_holds(const char *path, const char *text) {
    size_t size = 0;
    char *found = file_read(path, &size);
    CHECK(found && size == strlen(text) && memcmp(found, text, size) == 0);
    free(found);
}

static void check_output(void) {
    const char *folder = file_path("out");
    mkdir(folder, 0777);
    const char *path = file_path("out/a.txt");
    remove(path);
    int before = count_files(folder);
    ovoid_error error = {OVOID_OK, -1, ""};
    // Not there until it is committed; a second one replaces it and keeps its rights.
    for (int round = 0; round < 2; round++) {
        ovoid_output *output = ovoid_output_open(path, &error);
        if (!CHECK(output != NULL)) return;
        fprintf(ovoid_output_get_file(output), "round %d", round);
        CHECK(round ? access(path, F_OK) == 0 : access(path, F_OK) != 0);
        CHECK(ovoid_output_commit(output, &error) == OVOID_OK);
        CHECK(ovoid_output_commit(output, &error) == OVOID_ERROR_ARGUMENT);
        ovoid_output_close(output);
        check_holds(path, round ? "round 1" : "round 0");
        struct stat status;
        CHECK(stat(path, &status) == 0 && (round == 0 || (status.st_mode & 0777) == 0640));
        chmod(path, 0640);
    }
    // Given up: the old file stays, nothing else does.
    ovoid_output *output = ovoid_output_open(path, &error);
    if (output) fputs("never", ovoid_output_get_file(output));
    ovoid_output_close(output);
    check_holds(path, "round 1");
    CHECK_EQ(count_files(folder), before + 1);
    // Through a link: the link stays one.
    const char *link_path = file_path("out/link");
    remove(link_path);
    CHECK(symlink("a.txt", link_path) == 0);
    output = ovoid_output_open(link_path, &error);
    if (output) fputs("linked", ovoid_output_get_file(output));
    CHECK(output && ovoid_output_commit(output, &error) == OVOID_OK);
    ovoid_output_close(output);
    check_holds(path, "linked");
    struct stat status;
    CHECK(lstat(link_path, &status) == 0 && S_ISLNK(status.st_mode));
    // Through links to nothing: the last one's target is made, the links stay.
    const char *second_path = file_path("out/second");
    remove(path);
    remove(second_path);
    CHECK(symlink("link", second_path) == 0);
    output = ovoid_output_open(second_path, &error);
    if (output) fputs("made", ovoid_output_get_file(output));
    CHECK(output && ovoid_output_commit(output, &error) == OVOID_OK);
    ovoid_output_close(output);
    check_holds(path, "made");
    CHECK(lstat(link_path, &status) == 0 && S_ISLNK(status.st_mode));
    CHECK(lstat(second_path, &status) == 0 && S_ISLNK(status.st_mode));
    remove(link_path);
    remove(path);
    // In a ring, and into a folder that is not there: refused.
    CHECK(symlink("second", link_path) == 0);
    CHECK(!ovoid_output_open(second_path, &error) && strstr(error.message, "cannot be written"));
    remove(link_path);
    CHECK(symlink("nowhere/a.txt", link_path) == 0);
    CHECK(!ovoid_output_open(second_path, &error) && strstr(error.message, "cannot be written"));
    remove(link_path);
    remove(second_path);
    CHECK_EQ(count_files(folder), before);
}

static void check_bad_output(void) {
    ovoid_error error = {OVOID_OK, -1, ""};
    CHECK(!ovoid_output_open(file_path("no_folder/x"), &error) && error.code == OVOID_ERROR_FILE);
    CHECK(!ovoid_output_open(OVOID_BUILD_DIR, &error) && strstr(error.message, "is a folder"));
    // A device is written to, not replaced; a full one is reported.
    ovoid_output *output = ovoid_output_open("/dev/null", &error);
    if (CHECK(output != NULL)) {
        fputs("x", ovoid_output_get_file(output));
        CHECK(ovoid_output_commit(output, &error) == OVOID_OK);
    }
    ovoid_output_close(output);
    struct stat status;
    CHECK(stat("/dev/null", &status) == 0 && S_ISCHR(status.st_mode));
    if (access("/dev/full", W_OK) != 0) {
        check_skip("there is no /dev/full");
        return;
    }
    for (int size = 1; size < 100000; size += 99000) { // seen at the flush; seen while writing
        output = ovoid_output_open("/dev/full", &error);
        if (!CHECK(output != NULL)) return;
        for (int i = 0; i < size; i++) fputc('x', ovoid_output_get_file(output));
        CHECK(ovoid_output_commit(output, &error) == OVOID_ERROR_FILE && strstr(error.message, "written in full"));
        ovoid_output_close(output);
    }
}

/* ---- parts: all of them together are the whole file, line by line */

/// Reads a part behind the first `skipped` of its pairs, which are numbered by ax: the numbers are appended.
static int read_part(const char *path, const size_t part[2], uint64_t skipped, double *numbers, size_t *count,
                     ovoid_error *error) {
    ovoid_pairs_reader *reader = ovoid_pairs_reader_open(path, 3, error);
    if (!CHECK(reader != NULL)) return -1;
    ovoid_code code = ovoid_pairs_reader_set_part(reader, part[0], part[1], error);
    if (!code) code = ovoid_pairs_reader_skip(reader, skipped, error);
    int got = code ? -1 : 1;
    ovoid_indexed_pair p;
    while (got == 1) {
        got = ovoid_pairs_reader_read(reader, &p, error);
        if (got == 1) numbers[(*count)++] = p.pose_a.position.x;
    }
    ovoid_pairs_reader_close(reader);
    return got;
}

/// A file of so many numbered pairs, with blank lines, blanks and both line ends; the last one has none.
static const char *write_numbered(int count) {
    static char text[20000];
    size_t size = (size_t)snprintf(text, sizeof text, "%s", HEADER);
    for (int i = 0; i < count; i++)
        size += (size_t)snprintf(text + size, sizeof text - size, "%s0,2,%d,%*d,3,1,0,0,0,4,5,6,0,1,0,0%s",
                                 i % 4 == 1 ? "\n  \n\n" : "", i, 1 + i * 7 % 19, 2,
                                 i == count - 1 ? ""
                                 : i % 3        ? "\n"
                                                : "\r\n");
    return file_write_text("numbered.csv", text);
}

static void check_parts(void) {
    double numbers[128];
    ovoid_error error;
    for (int lines = 0; lines < 60; lines += 1 + lines / 4) {
        const char *path = write_numbered(lines);
        for (size_t parts = 1; parts < 80; parts += 1 + parts / 3) {
            size_t count = 0;
            for (size_t i = 0; i < parts; i++)
                CHECK_EQ(read_part(path, (size_t[]){i, parts}, 0, numbers, &count, &error), 0);
            CHECK_EQ((int)count, lines);
            for (int i = 0; i < (int)count; i++) CHECK(numbers[i] == i);
        }
        // Pairs that are left out, also more than there are.
        for (uint64_t skipped = 0; skipped < 20; skipped += 3) {
            size_t all = 0, rest = 0;
            CHECK_EQ(read_part(path, (size_t[]){1, 2}, 0, numbers, &all, &error), 0);
            double last = all ? numbers[all - 1] : 0;
            CHECK_EQ(read_part(path, (size_t[]){1, 2}, skipped, numbers, &rest, &error), 0);
            CHECK_EQ(rest, skipped < all ? all - (size_t)skipped : 0);
            CHECK(!rest || numbers[rest - 1] == last);
        }
    }
}

static void check_bad_parts(void) {
    double numbers[8];
    size_t count = 0;
    ovoid_error error;
    const char *path = file_write_text("parts.csv", HEADER GOOD "\n" GOOD GOOD "0,9,1,2,3,1,0,0,0,4,5,6,0,1,0,0\n");
    for (size_t parts = 1; parts < 5; parts++) {
        CHECK_EQ(read_part(path, (size_t[]){parts - 1, parts}, 0, numbers, &count, &error), -1);
        CHECK(error.code == OVOID_ERROR_INDEX && error.place == 6);
        CHECK(strstr(error.message, "parts.csv:6: column b") != NULL);
        count = 0;
    }
    CHECK_EQ(read_part(path, (size_t[]){2, 2}, 0, numbers, &count, &error), -1);
    CHECK(error.code == OVOID_ERROR_ARGUMENT && strstr(error.message, "there is no part 2 of 2"));
}

int main(void) {
    check_good();
    check_parts();
    check_bad_parts();
    check_bad();
    check_many();
    check_output();
    check_bad_output();
    return check_end();
}
