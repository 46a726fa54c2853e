// Imports that are not trusted: the child process, its records, and Assimp's importers behind them. Truth: what each
// child does is written here, so that how it ends is known; every record stream is made by hand; the hostile files are
// known to break Assimp 5.2 (fuzz/corpus/assimp), whatever its version they must not break the caller.
#define _XOPEN_SOURCE 700
#include "files.h"

#include "io/mesh/child.h"
#include "io/mesh/stream.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HAS_ASAN
#endif
#endif
#ifdef __SANITIZE_ADDRESS__
#define HAS_ASAN
#endif

// ---- children

static void write_much(int output, void *context) {
    unsigned char block[1000];
    for (size_t i = 0; i < sizeof block; i++) block[i] = (unsigned char)(i * 7);
    for (int i = 0; i < *(int *)context; i++) child_write(output, block, sizeof block);
}

static void die_of_signal(int output, void *context) {
    child_write(output, "ab", 2);
    raise(*(int *)context);
}

static void leave(int output, void *context) {
    (void)output;
    _exit(*(int *)context);
}

// Counts without a sign: how far it comes in its second of processor time is the machine's affair.
static void run_forever(int output, void *context) {
    (void)output;
    for (volatile unsigned *turn = context;; ++*turn) continue;
}

static void wait_forever(int output, void *context) {
    (void)output, (void)context;
    for (;;) pause();
}

static void write_forever(int output, void *context) {
    char block[4096] = {0};
    (void)context;
    for (;;) child_write(output, block, sizeof block);
}

// "1" for each of: much memory refused, much memory had once it is allowed.
static void take_memory(int output, void *context) {
    size_t size = *(size_t *)context;
    char said[2] = {'0', '0'};
    void *volatile memory = malloc(size); // a compiler may leave out what nobody looks at
    if (!memory) said[0] = '1';
    free(memory);
    child_allow_memory(2 * size);
    memory = malloc(size);
    if (memory) said[1] = '1';
    free(memory);
    child_write(output, said, 2);
}

// The number of open files, as one byte; and words to standard output that nobody may see.
static void count_files(int output, void *context) {
    unsigned char count = 0;
    (void)context;
    for (int file = 0; file < 1024; file++) count += fcntl(file, F_GETFD) != -1;
    if (write(1, "seen\n", 5) != 5) count = 255;
    child_write(output, &count, 1);
}

static void write_file(int output, void *context) {
    int file = open(context, O_WRONLY | O_CREAT, 0600);
    (void)output;
    if (file >= 0 && write(file, "x", 1) == 1) _exit(9);
    _exit(8);
}

/// What came of a child.
typedef struct outcome {
    size_t size;
    unsigned sum;
    char first[16];
    child_end end;
} outcome;

// Runs the work and takes at most `most` bytes.
static outcome run(void (*work)(int, void *), void *context, child_limits limits, size_t most) {
    outcome o = {.size = 0};
    child c;
    char block[700];
    ptrdiff_t n;
    if (!CHECK(child_start(&c, &limits, work, context) == 0)) return o;
    while (o.size < most && (n = child_read(&c, block, sizeof block)) > 0) {
        for (ptrdiff_t i = 0; i < n; i++) o.sum += (unsigned char)block[i];
        if (o.size == 0) memcpy(o.first, block, (size_t)(n < 16 ? n : 16));
        o.size += (size_t)n;
    }
    o.end = child_finish(&c, o.size >= most);
    return o;
}

// So much time that no machine is too slow for what is not meant to run into a limit.
static const child_limits usual = {.memory = (size_t)256 << 20, .cpu_seconds = 3600, .seconds = 36000};
static const size_t all = SIZE_MAX;

static void check_good_child(void) {
    int blocks = 3000;
    outcome o = run(write_much, &blocks, usual, all);
    unsigned sum = 0;
    for (unsigned i = 0; i < 1000; i++) sum += (i * 7) & 255;
    CHECK_EQ(o.size, 3000000);
    CHECK_EQ(o.sum, 3000 * sum);
    CHECK(!o.end.signal && !o.end.exit_code && !o.end.is_late && !o.end.is_slow);
}

static void check_bad_children(void) {
    const int signals[] = {SIGSEGV, SIGABRT, SIGFPE, SIGKILL, SIGTERM, SIGUSR1};
    for (size_t i = 0; i < sizeof signals / sizeof *signals; i++) {
        int number = signals[i];
        outcome o = run(die_of_signal, &number, usual, all);
        CHECK_EQ(o.end.signal, number);
        CHECK(o.size == 2 && o.first[0] == 'a' && o.first[1] == 'b');
    }
    int code = 7;
    unsigned turns = 0;
    CHECK_EQ(run(leave, &code, usual, all).end.exit_code, 7);
    // These two never end but by their limits, however slow the machine: one works, one waits.
    child_limits one_second = {.memory = usual.memory, .cpu_seconds = 1, .seconds = usual.seconds};
    CHECK(run(run_forever, &turns, one_second, all).end.is_slow);
    CHECK_EQ(turns, 0); // the child's memory is not ours
    child_limits one_second_clock = {.memory = usual.memory, .cpu_seconds = usual.cpu_seconds, .seconds = 1};
    CHECK(run(wait_forever, NULL, one_second_clock, all).end.is_late);
    // One that never stops writing is stopped when its reader has enough.
    int number = run(write_forever, NULL, usual, 1000000).end.signal;
    CHECK(number == SIGKILL || number == SIGPIPE);
}

static void check_limits(void) {
    outcome o = run(count_files, NULL, usual, all);
    CHECK(o.size == 1);
    CHECK_EQ(o.first[0], 4);
    const char *path = file_path("never.txt");
    remove(path);
    o = run(write_file, (void *)(intptr_t)path, usual, all);
    CHECK(o.end.signal == SIGXFSZ || o.end.exit_code == 8);
    size_t size = (size_t)1 << 30;
    o = run(take_memory, &size, usual, all);
#ifdef HAS_ASAN
    CHECK(o.size == 0 && (o.end.signal || o.end.exit_code)); // its malloc does not return NULL, it ends the child
#else
    CHECK(o.size == 2 && o.first[0] == '1' && o.first[1] == '1');
#endif
}

static volatile sig_atomic_t handled;
static void handle(int number) { handled = number; }

// Handlers of the caller's stay out of the child, and its mask is as it was.
static void check_signals_of_host(void) {
    signal(SIGUSR1, handle);
    int number = SIGUSR1;
    CHECK_EQ(run(die_of_signal, &number, usual, all).end.signal, SIGUSR1);
    CHECK_EQ(handled, 0);
    sigset_t now;
    sigprocmask(SIG_SETMASK, NULL, &now);
    CHECK(!sigismember(&now, SIGUSR1) && !sigismember(&now, SIGINT));
    // A host that does not want to hear of children: how one ended cannot be known, and nothing hangs.
    signal(SIGCHLD, SIG_IGN);
    number = SIGSEGV;
    outcome o = run(die_of_signal, &number, usual, all);
    CHECK(o.size == 2 && !o.end.is_late);
    signal(SIGCHLD, SIG_DFL);
}

// ---- records

static unsigned char stream[1 << 12];
static size_t stream_size, stream_at;

static int write_stream(void *context, const void *data, size_t size) {
    (void)context;
    if (size > sizeof stream - stream_size) return 0;
    memcpy(stream + stream_size, data, size);
    stream_size += size;
    return 1;
}

// Three bytes at a time, so that records come in pieces.
static ptrdiff_t read_stream(void *context, void *buffer, size_t size) {
    (void)context;
    size_t n = stream_size - stream_at < 3 ? stream_size - stream_at : 3;
    if (n > size) n = size;
    memcpy(buffer, stream + stream_at, n);
    stream_at += n;
    return (ptrdiff_t)n;
}

// Reads what is in the stream. *ended as record_read_mesh says.
static ovoid_mesh *read_records(int *ended, ovoid_code *code, ovoid_error *error) {
    mesh_reader reader = {.path = "records", .scale = 1, .parts = 1, .error = error};
    reader.mesh = calloc(1, sizeof *reader.mesh);
    record_source source = {read_stream, NULL};
    stream_at = 0;
    *code = record_read_mesh(&reader, &source, ended);
    return reader.mesh;
}

static record_sink *start_stream(void) {
    static record_sink sink;
    stream_size = 0;
    sink = (record_sink){.write = write_stream};
    return &sink;
}

static void write_triangle(record_sink *sink) {
    static const double points[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}};
    static const unsigned corners[3] = {0, 3, 2};
    record_write_part(sink, "body", 4);
    record_write_mesh(sink);
    for (int i = 0; i < 4; i++) record_write_point(sink, points[i]);
    record_write_face(sink, corners, 3);
}

// A good stream, and each of its beginnings: cut, never accepted.
static void check_good_stream(void) {
    record_sink *sink = start_stream();
    write_triangle(sink);
    record_write_end(sink, OVOID_OK, "");
    size_t whole = stream_size;
    for (stream_size = 0; stream_size <= whole; stream_size++) {
        int ended;
        ovoid_code code;
        ovoid_mesh *mesh = read_records(&ended, &code, NULL);
        CHECK_EQ(ended, stream_size == whole);
        CHECK_EQ(code == OVOID_OK, stream_size == whole);
        if (!code) {
            ovoid_mesh_part part = ovoid_mesh_get_part(mesh, 0);
            CHECK(strcmp(part.name, "body") == 0 && part.faces.vertex_count == 3 && part.faces.face_count == 1);
            CHECK(part.faces.indices[0] == 0 && part.faces.indices[1] == 1 && part.faces.indices[2] == 2);
        }
        ovoid_mesh_destroy(mesh);
    }
    stream_size = 0;
}

// Appends raw bytes.
static void put_raw(const void *data, size_t size) { (void)write_stream(NULL, data, size); }
static void put_number(uint32_t value) { put_raw(&value, sizeof value); }

static void expect_bad(const char *name, ovoid_code wanted, const char *phrase) {
    ovoid_error error = {OVOID_OK, -1, ""};
    int ended;
    ovoid_code code;
    ovoid_mesh_destroy(read_records(&ended, &code, &error));
    if (!CHECK(ended && code == wanted && error.code == wanted && strstr(error.message, phrase)))
        printf("  %s: ended %d, code %d, \"%s\"\n", name, ended, (int)code, error.message);
}

static void check_bad_streams(void) {
    const double nan_point[3] = {0, NAN, 0}, far_point[3] = {0, 0, 1e60};
    start_stream();
    put_raw("X", 1);
    expect_bad("no record", OVOID_ERROR_FORMAT, "make no sense");
    record_sink *sink = start_stream();
    record_write_point(sink, nan_point);
    record_write_end(sink, OVOID_OK, "");
    expect_bad("a point before its part", OVOID_ERROR_FORMAT, "make no sense");
    sink = start_stream();
    record_write_part(sink, "", 0);
    record_write_point(sink, nan_point);
    record_write_end(sink, OVOID_OK, "");
    expect_bad("not a number", OVOID_ERROR_NOT_FINITE, "not a number");
    sink = start_stream();
    record_write_part(sink, "", 0);
    record_write_point(sink, far_point);
    record_write_end(sink, OVOID_OK, "");
    expect_bad("far", OVOID_ERROR_RANGE, "beyond");
    const unsigned corners[3] = {0, 1, 4};
    sink = start_stream();
    write_triangle(sink);
    record_write_face(sink, corners, 3);
    record_write_end(sink, OVOID_OK, "");
    expect_bad("an index past the end", OVOID_ERROR_INDEX, "no vertex 4");
    sink = start_stream();
    write_triangle(sink);
    record_write_mesh(sink);
    record_write_face(sink, corners, 1);
    record_write_end(sink, OVOID_OK, "");
    expect_bad("an index into the mesh before", OVOID_ERROR_INDEX, "no vertex 0");
    start_stream();
    put_raw("P", 1);
    put_number(0xffffffffu);
    expect_bad("a long name", OVOID_ERROR_FORMAT, "make no sense");
    start_stream();
    put_raw("Z", 1);
    put_number(0xfffffffeu);
    put_number(0);
    expect_bad("an unknown code", OVOID_ERROR_FORMAT, "make no sense");
    sink = start_stream();
    record_write_end(sink, OVOID_ERROR_FORMAT, "two\033 words\nand a line");
    expect_bad("words", OVOID_ERROR_FORMAT, "records: two? words");
}

// ---- Assimp

// A file of the corpus, without its first byte, under another name.
static const char *copy_case(const char *name) {
    char path[512];
    size_t size = 0;
    snprintf(path, sizeof path, "%s/fuzz/corpus/assimp/%s", OVOID_SOURCE_DIR, name);
    char *data = file_read(path, &size);
    if (!CHECK(data && size > 1)) exit(1);
    const char *copy = file_write(name, data + 1, size - 1);
    free(data);
    return copy;
}

static void check_hostile_file(const char *name, ovoid_code wanted) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_mesh *mesh = ovoid_mesh_read(copy_case(name), NULL, &error);
    if (!CHECK(mesh ? wanted == OVOID_OK : error.code == wanted && strstr(error.message, name)))
        printf("  %s: code %d, \"%s\"\n", name, (int)error.code, error.message);
    ovoid_mesh_destroy(mesh);
}

static const char gltf[] = "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
                           "\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
                           "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
                           "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
                           "\"buffers\":[{\"byteLength\":36,\"uri\":\"%s\"}]}";

static void write_gltf(const char *name, const char *place) {
    char text[1000];
    snprintf(text, sizeof text, gltf, place);
    file_write_text(name, text);
}

// 1 if the glTF file of that name is read, in a child or here; else the error has a phrase.
static int can_read(const char *name, int trusted, const char *phrase) {
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_read_options options = {.trusted = trusted};
    ovoid_mesh *mesh = ovoid_mesh_read(file_path(name), &options, &error);
    if (mesh) CHECK_EQ(ovoid_mesh_get_part(mesh, 0).faces.vertex_count, 3);
    if (!mesh && !CHECK(strstr(error.message, phrase))) printf("  %s: %s\n", name, error.message);
    ovoid_mesh_destroy(mesh);
    return mesh != NULL;
}

// 1 if a glTF file whose points are at that place is read.
static int can_read_buffer(const char *place, int trusted, const char *phrase) {
    write_gltf("side.gltf", place);
    return can_read("side.gltf", trusted, phrase);
}

static void make_link(const char *to, const char *name) {
    const char *path = file_path(name);
    (void)unlink(path);
    CHECK(symlink(to, path) == 0);
}

// Links within the folder are followed, to files, folders and other links; one that leads out of it is refused by name.
// A folder of links to files that lie together (as build systems install them) is read.
static void check_links(void) {
    mkdir(file_path("below/deep"), 0777);
    make_link("../side.bin", "below/out.bin");
    make_link("deep/in.bin", "below/in.bin");
    make_link("../../side.bin", "below/deep/in.bin");
    make_link("..", "below/up");
    make_link("deep", "below/down");
    make_link("nowhere.bin", "below/none.bin");
    make_link("circle.bin", "below/circle.bin");
    mkdir(file_path("below2"), 0777);
    file_write("below2/side.bin", (const float[9]){0, 0, 0, 1, 0, 0, 0, 1, 0}, 36);
    make_link("../below2/side.bin", "below/alike.bin");
    file_write("below/deep/side.bin", (const float[9]){0, 0, 0, 1, 0, 0, 0, 1, 0}, 36);
    mkdir(file_path("beside"), 0777);
    write_gltf("below/side.gltf", "side.bin");
    make_link("../below/side.gltf", "beside/side.gltf");
    make_link("../below/side.bin", "beside/side.bin");
    write_gltf("beside/other.gltf", "side.bin");
    static const struct {
        const char *place, *phrase; // no phrase: it is read
    } cases[] = {{"side.bin", NULL},
                 {"deep/side.bin", NULL},
                 {"down/side.bin", NULL},
                 {"out.bin", "out.bin: a link leads out of the folder of the file that names it, to /"},
                 {"in.bin", "in.bin: a link leads out"},
                 {"down/in.bin", "in.bin: a link leads out"},
                 {"up/side.bin", "up/side.bin: a link leads out"},
                 {"alike.bin", "alike.bin: a link leads out"},
                 {"none.bin", "none.bin: cannot be opened: No such file"},
                 {"circle.bin", "circle.bin: cannot be opened"},
                 {"down", "down: is not a regular file"}};
    for (int trusted = 0; trusted < 2; trusted++) {
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            write_gltf("below/links.gltf", cases[i].place);
            CHECK_EQ(can_read("below/links.gltf", trusted, cases[i].phrase), !cases[i].phrase);
        }
        CHECK(can_read("beside/side.gltf", trusted, ""));
        CHECK(!can_read("beside/other.gltf", trusted, "a link leads out"));
    }
}

// What a file names is read from below its folder only, and only if it is a regular file.
static void check_other_files(void) {
    const float points[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    char above[600];
    mkdir(file_path("below"), 0777);
    file_write("below/side.bin", points, sizeof points);
    file_write("side.bin", points, sizeof points);
    mkfifo(file_path("side.pipe"), 0600);
    snprintf(above, sizeof above, "../test_files/side.bin");
    for (int trusted = 0; trusted < 2; trusted++) {
        static const char out[] = "is not below the folder of the file that names it";
        CHECK(can_read_buffer("side.bin", trusted, ""));
        CHECK(can_read_buffer("below/side.bin", trusted, ""));
        CHECK(!can_read_buffer("missing.bin", trusted, "missing.bin: cannot be opened: No such file"));
        CHECK(!can_read_buffer(above, trusted, out));
        CHECK(!can_read_buffer("below/../side.bin", trusted, out));
        CHECK(!can_read_buffer("/dev/zero", trusted, ""));
        CHECK(!can_read_buffer(file_path("side.bin") + strlen(OVOID_BUILD_DIR), trusted, ""));
        CHECK(!can_read_buffer("side.pipe", trusted, "is not a regular file")); // it would be waited for
        CHECK(!can_read_buffer("below", trusted, "is not a regular file"));
    }
    // A path without a folder.
    char before[1024];
    if (CHECK(getcwd(before, sizeof before) && chdir(OVOID_BUILD_DIR "/test_files") == 0)) {
        ovoid_mesh *mesh = ovoid_mesh_read("side.gltf", NULL, NULL);
        CHECK(!mesh); // the last place was a folder
        write_gltf("side.gltf", "side.bin");
        mesh = ovoid_mesh_read("side.gltf", NULL, NULL);
        CHECK(mesh);
        ovoid_mesh_destroy(mesh);
        CHECK(chdir(before) == 0);
    }
}

// In the child and in this process: the same mesh.
static void check_trusted(void) {
    const char *path = copy_case("good.3mf");
    ovoid_mesh *meshes[2];
    for (int trusted = 0; trusted < 2; trusted++) {
        ovoid_read_options options = {.parts = 1, .trusted = trusted};
        meshes[trusted] = ovoid_mesh_read(path, &options, NULL);
        if (!CHECK(meshes[trusted])) return;
    }
    CHECK_EQ(ovoid_mesh_get_part_count(meshes[0]), ovoid_mesh_get_part_count(meshes[1]));
    ovoid_mesh_part a = ovoid_mesh_get_part(meshes[0], 0), b = ovoid_mesh_get_part(meshes[1], 0);
    CHECK(strcmp(a.name, b.name) == 0 && a.faces.face_count == b.faces.face_count);
    CHECK(a.faces.vertex_count == b.faces.vertex_count &&
          memcmp(a.faces.vertices, b.faces.vertices, 24 * a.faces.vertex_count) == 0);
    ovoid_mesh_destroy(meshes[0]);
    ovoid_mesh_destroy(meshes[1]);
}

#ifndef HAS_ASAN
// Many threads, some in malloc while others fork.
static void *import_often(void *context) {
    long bad = 0;
    for (int i = 0; i < 20; i++) {
        ovoid_mesh *mesh = ovoid_mesh_read(context, NULL, NULL);
        bad += mesh == NULL;
        ovoid_mesh_destroy(mesh);
        for (size_t k = 1; k < 300; k++) free(malloc(k * 97));
    }
    return (void *)bad;
}

static void check_threads(void) {
    char path[512];
    snprintf(path, sizeof path, "%s", copy_case("good.3mf"));
    pthread_t threads[6];
    for (int i = 0; i < 6; i++) CHECK(pthread_create(&threads[i], NULL, import_often, path) == 0);
    for (int i = 0; i < 6; i++) {
        void *bad;
        CHECK(pthread_join(threads[i], &bad) == 0 && bad == NULL);
    }
}
#endif

static int count_own_files(void) {
    int count = 0;
    for (int file = 0; file < 1024; file++) count += fcntl(file, F_GETFD) != -1;
    return count;
}

int main(void) {
    int files = count_own_files();
    check_good_child();
    check_bad_children();
    check_limits();
    check_signals_of_host();
    check_good_stream();
    check_bad_streams();
    if (ovoid_io_has_assimp()) {
        // 3 000 000 000 numbers promised; an object that is a part of itself.
#ifdef HAS_ASAN
        check_hostile_file("huge.dae", OVOID_ERROR_FORMAT);
#else
        check_hostile_file("huge.dae", OVOID_ERROR_LIMIT);
#endif
        check_hostile_file("self.3mf", OVOID_ERROR_FORMAT);
        check_hostile_file("good.3mf", OVOID_OK);
        check_other_files();
        check_links();
        check_trusted();
#ifdef HAS_ASAN
        check_skip("AddressSanitizer's own malloc may be locked in the child of a process with threads");
#else
        check_threads();
#endif
    } else
        check_skip("Assimp was not built in");
    // Nothing is left: no child, no open file.
    CHECK(waitpid(-1, NULL, WNOHANG) == -1 && errno == ECHILD);
    CHECK_EQ(count_own_files(), files);
    return check_end();
}
