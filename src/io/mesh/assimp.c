// COLLADA, glTF, 3DS, X3D, FBX and 3MF through Assimp (https://assimp.org), without materials, textures, bones and
// animations where its importers allow it. Each mesh of a node is moved by the transforms from the root to the node.
// Coordinates keep the axes of the file: COLLADA's up axis turns nothing; its unit is applied, so that they are metres.
// Equal points, which Assimp repeats for each normal, are merged.
//
// Some of Assimp's importers break on hostile bytes. So they run in a child process with limits (child.h), read no
// other files than they need (assimp_files.h), and return records (stream.h) that are checked like any other input: a
// crash ends the child alone. A reader that trusts the file does without the child.
#include "io/mesh/readers.h"

#ifndef OVOID_WITH_ASSIMP

int ovoid_io_has_assimp(void) { return 0; }

ovoid_code mesh_read_assimp(mesh_reader *reader) {
    return io_fail(reader->error, OVOID_ERROR_FORMAT, (where){reader->path, 0, -1},
                   "this build reads stl, obj, off and ply only; others need Assimp");
}

#else

#include "io/locale.h"
#include "io/mesh/assimp_files.h"
#include "io/mesh/assimp_load.h"
#include "io/mesh/child.h"
#include "io/mesh/stream.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <stdlib.h>
#include <string.h>

enum { NODE_DEPTH_MAX = 1000 };

// Limits of an import: a fixed part, and more for each byte of the files that it reads. Measured with Assimp 5.2: 17
// bytes of memory for each byte of FBX, less for the others; 90 for 3MF, which is compressed; a second of processor
// time for 9 MB.
#define MEMORY_FIXED ((size_t)256 << 20)
#define MEMORY_FACTOR 32
#define MEMORY_FACTOR_COMPRESSED 256
#define CPU_SECONDS 20
#define BYTES_A_CPU_SECOND ((size_t)1 << 20)
// Wall-clock time gets a factor, as the machine may be busy with other work.
#define CLOCK_FACTOR 6

int ovoid_io_has_assimp(void) {
    const char *why;
    return assimp_load(&why) != NULL;
}

// ---- the importer's side: from Assimp's scene to records

/// The scene that is being written as records.
typedef struct scene_traversal {
    record_sink *sink;
    const assimp_functions *assimp;
    const struct aiScene *scene;
    int parts, has_part;
    const char *failure; ///< why the traversal ended early, or NULL
} scene_traversal;

static void hand_over_mesh(scene_traversal *traversal, const struct aiMesh *mesh, const struct aiMatrix4x4 *m) {
    record_write_mesh(traversal->sink);
    for (unsigned v = 0; v < mesh->mNumVertices && mesh->mVertices; v++) {
        double x = (double)mesh->mVertices[v].x, y = (double)mesh->mVertices[v].y, z = (double)mesh->mVertices[v].z;
        double xyz[3] = {(double)m->a1 * x + (double)m->a2 * y + (double)m->a3 * z + (double)m->a4,
                         (double)m->b1 * x + (double)m->b2 * y + (double)m->b3 * z + (double)m->b4,
                         (double)m->c1 * x + (double)m->c2 * y + (double)m->c3 * z + (double)m->c4};
        record_write_point(traversal->sink, xyz);
    }
    for (unsigned f = 0; f < mesh->mNumFaces && mesh->mFaces && !traversal->sink->failed; f++)
        record_write_face(traversal->sink, mesh->mFaces[f].mIndices, mesh->mFaces[f].mNumIndices);
}

// Starts the part of a node's meshes: one for each node that has any, or the first for all.
static void start_part(scene_traversal *traversal, const struct aiNode *node) {
    if (traversal->has_part && !traversal->parts) return;
    int is_named = traversal->parts && node->mName.length < sizeof node->mName.data;
    record_write_part(traversal->sink, node->mName.data, is_named ? node->mName.length : 0);
    traversal->has_part = 1;
}

static void hand_over_node(scene_traversal *traversal, const struct aiNode *node, struct aiMatrix4x4 parent,
                           int depth) {
    if (depth > NODE_DEPTH_MAX) traversal->failure = "nodes are nested more than 1000 deep";
    if (traversal->failure || traversal->sink->failed) return;
    traversal->assimp->multiply(&parent, &node->mTransformation);
    if (node->mNumMeshes) start_part(traversal, node);
    for (unsigned i = 0; i < node->mNumMeshes; i++)
        if (node->mMeshes[i] < traversal->scene->mNumMeshes)
            hand_over_mesh(traversal, traversal->scene->mMeshes[node->mMeshes[i]], &parent);
    for (unsigned i = 0; i < node->mNumChildren; i++) hand_over_node(traversal, node->mChildren[i], parent, depth + 1);
}

static const struct aiScene *import(const assimp_functions *assimp, const char *path, struct aiFileIO *io) {
    struct aiPropertyStore *store = assimp->create_store();
    if (!store) return NULL;
    static const char *const off[] = {AI_CONFIG_IMPORT_FBX_READ_MATERIALS,  AI_CONFIG_IMPORT_FBX_READ_TEXTURES,
                                      AI_CONFIG_IMPORT_FBX_READ_CAMERAS,    AI_CONFIG_IMPORT_FBX_READ_LIGHTS,
                                      AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, AI_CONFIG_IMPORT_FBX_READ_WEIGHTS};
    for (size_t i = 0; i < sizeof off / sizeof *off; i++) assimp->set_integer(store, off[i], 0);
    assimp->set_integer(store, AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
    const struct aiScene *scene = assimp->import(path, 0, io, store);
    assimp->release_store(store);
    return scene;
}

// Writes why there is no scene: a file that it names was not opened, lack of memory, or Assimp's own message.
static void hand_over_failure(const assimp_functions *assimp, record_sink *sink, const ovoid_error *refused) {
    char sentence[400];
    const char *words = assimp->get_error();
    if (refused->code) {
        record_write_end(sink, refused->code, refused->message);
    } else if (!*words || strstr(words, "bad_alloc")) {
        record_write_end(sink, OVOID_ERROR_LIMIT, "Assimp ran out of the memory that a file of this size is allowed");
    } else {
        (void)snprintf(sentence, sizeof sentence, "Assimp cannot read it: %s", words);
        record_write_end(sink, OVOID_ERROR_FORMAT, sentence);
    }
}

// Imports the reader's file and writes all of it as records.
static void hand_over(const mesh_reader *reader, record_sink *sink, void (*before_reading)(size_t)) {
    assimp_files files = {.path = reader->path, .file = reader->file, .before_reading = before_reading};
    struct aiFileIO io = assimp_files_make(&files);
    // Some importers read numbers by the locale.
    locale_scope locale = locale_enter();
    const char *why;
    const assimp_functions *assimp = assimp_load(&why); // it was loaded before
    const struct aiScene *scene = import(assimp, reader->path, &io);
    locale_leave(locale);
    if (!scene) {
        hand_over_failure(assimp, sink, &files.refused);
        return;
    }
    scene_traversal traversal = {.sink = sink, .assimp = assimp, .scene = scene, .parts = reader->parts};
    struct aiMatrix4x4 identity;
    assimp->set_identity(&identity);
    if (scene->mRootNode) hand_over_node(&traversal, scene->mRootNode, identity, 0);
    record_write_end(sink, traversal.failure ? OVOID_ERROR_LIMIT : OVOID_OK,
                     traversal.failure ? traversal.failure : "");
    assimp->release_import(scene);
}

// ---- in a child

static int write_pipe(void *context, const void *data, size_t size) {
    child_write(*(const int *)context, data, size);
    return 1;
}

static void allow_reading(size_t size) { child_allow_memory(MEMORY_FACTOR * size); }

static void work(int output, void *context) {
    static record_sink sink;
    sink = (record_sink){.write = write_pipe, .context = &output};
    hand_over(context, &sink, allow_reading);
}

static ptrdiff_t read_pipe(void *context, void *buffer, size_t size) { return child_read(context, buffer, size); }

// The error for a child that ended without a last record.
static ovoid_code fail_import(const mesh_reader *reader, const child_limits *limits, const child_end *end) {
    where at = {reader->path, 0, -1};
    if (end->is_late || end->is_slow)
        return io_fail(reader->error, OVOID_ERROR_LIMIT, at,
                       "Assimp took more than %u seconds %sand was stopped; convert the file to obj, stl or ply",
                       end->is_slow ? limits->cpu_seconds : limits->seconds, end->is_slow ? "of processor time " : "");
    if (end->signal)
        return io_fail(reader->error, OVOID_ERROR_FORMAT, at,
                       "Assimp crashed (signal %d): the file is damaged or hostile, or beyond it; convert it to obj, "
                       "stl or ply",
                       end->signal);
    return io_fail(reader->error, OVOID_ERROR_FORMAT, at, "Assimp ended without a result (code %d)", end->exit_code);
}

static ovoid_code read_in_child(mesh_reader *reader) {
    size_t size = reader->file.size;
    size_t factor = path_has_extension(reader->path, "3mf") ? MEMORY_FACTOR_COMPRESSED : MEMORY_FACTOR;
    child_limits limits = {.memory = MEMORY_FIXED + factor * size,
                           .cpu_seconds = CPU_SECONDS + (unsigned)(size / BYTES_A_CPU_SECOND)};
    limits.seconds = CLOCK_FACTOR * limits.cpu_seconds;
    child c;
    int reason = child_start(&c, &limits, work, reader);
    if (reason)
        return io_fail(reader->error, OVOID_ERROR_FILE, (where){reader->path, 0, -1},
                       "no process could be started for Assimp: %s", strerror(reason));
    record_source source = {read_pipe, &c};
    int ended;
    ovoid_code code = record_read_mesh(reader, &source, &ended);
    child_end end = child_finish(&c, ended);
    return ended ? code : fail_import(reader, &limits, &end);
}

// ---- in this process

/// The records in memory.
typedef struct record_memory {
    unsigned char *data;
    size_t size, capacity, at;
} record_memory;

static int write_memory(void *context, const void *data, size_t size) {
    record_memory *m = context;
    while (m->capacity - m->size < size)
        if (!array_reserve((void **)&m->data, &m->capacity, m->capacity, 1)) return 0;
    memcpy(m->data + m->size, data, size);
    m->size += size;
    return 1;
}

static ptrdiff_t read_memory(void *context, void *buffer, size_t size) {
    record_memory *m = context;
    size_t n = m->size - m->at < size ? m->size - m->at : size;
    if (n) memcpy(buffer, m->data + m->at, n);
    m->at += n;
    return (ptrdiff_t)n;
}

static ovoid_code read_here(mesh_reader *reader) {
    record_memory memory = {NULL, 0, 0, 0};
    record_sink *sink = malloc(sizeof *sink);
    if (!sink) return io_fail_memory(reader->error, reader->path);
    *sink = (record_sink){.write = write_memory, .context = &memory};
    hand_over(reader, sink, NULL);
    record_source source = {read_memory, &memory};
    int ended;
    ovoid_code code = record_read_mesh(reader, &source, &ended);
    if (!ended) code = io_fail_memory(reader->error, reader->path);
    free(memory.data);
    free(sink);
    return code;
}

ovoid_code mesh_read_assimp(mesh_reader *reader) {
    const char *why;
    // Before the child, which has no more than its parent.
    if (!assimp_load(&why))
        return io_fail(reader->error, OVOID_ERROR_FILE, (where){reader->path, 0, -1},
                       "Assimp cannot be loaded: %s; "
                       "install it (Debian: libassimp5), or convert the mesh to stl, obj, off or ply",
                       why);
    return reader->trusted ? read_here(reader) : read_in_child(reader);
}

#endif
