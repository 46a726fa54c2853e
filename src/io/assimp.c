// COLLADA, glTF, 3DS, X3D, FBX and 3MF through Assimp (https://assimp.org), without materials, textures, bones and
// animations where its importers can be told so. Each mesh that a node shows is moved by the transforms from the root
// to the node. Coordinates keep the axes of the file: COLLADA's up axis turns nothing; its unit is applied, so that
// they are metres. Equal points, which Assimp repeats for each normal, are merged.
#include "io/mesh.h"

#ifndef OVOID_WITH_ASSIMP

int ovoid_io_has_assimp(void) { return 0; }

ovoid_code mesh_read_assimp(mesh_reader *reader) {
    return io_fail(reader->error, OVOID_ERROR_FORMAT, (where){reader->path, 0, -1},
                   "this build reads stl, obj, off and ply only; others need Assimp");
}

#else

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <stdlib.h>
#include <string.h>

enum { NODE_DEPTH_MAX = 1000 };

/// The points and faces of all nodes that Assimp's own limits let through.
typedef struct scene_walk {
    mesh_reader *reader;
    const struct aiScene *scene;
    mesh_part *part;
    point_table table;
} scene_walk;

int ovoid_io_has_assimp(void) { return 1; }

// The corner `v` of the mesh under the node's transform.
static ovoid_code add_corner(scene_walk *walk, const struct aiMesh *mesh, const struct aiMatrix4x4 *m, unsigned v) {
    where at = {walk->reader->path, 0, (int64_t)v};
    if (v >= mesh->mNumVertices)
        return io_fail(walk->reader->error, OVOID_ERROR_INDEX, at, "there is no vertex %u; the mesh has %u", v,
                       mesh->mNumVertices);
    double x = (double)mesh->mVertices[v].x, y = (double)mesh->mVertices[v].y, z = (double)mesh->mVertices[v].z;
    double xyz[3] = {(double)m->a1 * x + (double)m->a2 * y + (double)m->a3 * z + (double)m->a4,
                     (double)m->b1 * x + (double)m->b2 * y + (double)m->b3 * z + (double)m->b4,
                     (double)m->c1 * x + (double)m->c2 * y + (double)m->c3 * z + (double)m->c4};
    uint32_t index;
    ovoid_code code = mesh_add_merged_point(walk->reader, walk->part, &walk->table, xyz, at, &index);
    return code ? code : mesh_add_index(walk->reader, walk->part, index);
}

// All vertices of a mesh first, also those of no face; then the faces.
static ovoid_code add_mesh(scene_walk *walk, const struct aiMesh *mesh, const struct aiMatrix4x4 *m) {
    ovoid_code code = OVOID_OK;
    for (unsigned v = 0; v < mesh->mNumVertices && !code; v++) {
        code = add_corner(walk, mesh, m, v);
        if (!code) walk->part->index_count--;
    }
    for (unsigned f = 0; f < mesh->mNumFaces && !code; f++) {
        const struct aiFace *face = &mesh->mFaces[f];
        for (unsigned k = 0; k < face->mNumIndices && !code; k++) code = add_corner(walk, mesh, m, face->mIndices[k]);
        if (!code) code = mesh_end_face(walk->reader, walk->part, face->mNumIndices);
    }
    return code;
}

// The part that the node's meshes go to: one for each node that has any, or the first for all.
static ovoid_code start_part(scene_walk *walk, const struct aiNode *node) {
    if (walk->part && !walk->reader->parts) return OVOID_OK;
    struct aiString name = walk->reader->parts ? node->mName : (struct aiString){.length = 0};
    walk->part = mesh_add_part(walk->reader, name.data, name.length);
    free(walk->table.slots);
    walk->table = (point_table){.slots = NULL};
    return walk->part ? OVOID_OK : OVOID_ERROR_MEMORY;
}

static ovoid_code add_node(scene_walk *walk, const struct aiNode *node, struct aiMatrix4x4 parent, int depth) {
    if (depth > NODE_DEPTH_MAX)
        return io_fail(walk->reader->error, OVOID_ERROR_LIMIT, (where){walk->reader->path, 0, -1},
                       "nodes are nested more than %d deep", NODE_DEPTH_MAX);
    aiMultiplyMatrix4(&parent, &node->mTransformation);
    ovoid_code code = node->mNumMeshes ? start_part(walk, node) : OVOID_OK;
    for (unsigned i = 0; i < node->mNumMeshes && !code; i++)
        code = add_mesh(walk, walk->scene->mMeshes[node->mMeshes[i]], &parent);
    for (unsigned i = 0; i < node->mNumChildren && !code; i++)
        code = add_node(walk, node->mChildren[i], parent, depth + 1);
    return code;
}

static const struct aiScene *import(const char *path) {
    struct aiPropertyStore *store = aiCreatePropertyStore();
    if (!store) return NULL;
    static const char *const off[] = {AI_CONFIG_IMPORT_FBX_READ_MATERIALS,  AI_CONFIG_IMPORT_FBX_READ_TEXTURES,
                                      AI_CONFIG_IMPORT_FBX_READ_CAMERAS,    AI_CONFIG_IMPORT_FBX_READ_LIGHTS,
                                      AI_CONFIG_IMPORT_FBX_READ_ANIMATIONS, AI_CONFIG_IMPORT_FBX_READ_WEIGHTS};
    for (size_t i = 0; i < sizeof off / sizeof *off; i++) aiSetImportPropertyInteger(store, off[i], 0);
    aiSetImportPropertyInteger(store, AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
    const struct aiScene *scene = aiImportFileExWithProperties(path, 0, NULL, store);
    aiReleasePropertyStore(store);
    return scene;
}

ovoid_code mesh_read_assimp(mesh_reader *reader) {
    where at = {reader->path, 0, -1};
    const struct aiScene *scene = import(reader->path);
    if (!scene) {
        // Assimp's own words, on one line.
        const char *words = aiGetErrorString();
        return io_fail(reader->error, OVOID_ERROR_FORMAT, at, "Assimp cannot read it: %.*s",
                       (int)strcspn(words, "\r\n"), words);
    }
    scene_walk walk = {.reader = reader, .scene = scene};
    struct aiMatrix4x4 identity;
    aiIdentityMatrix4(&identity);
    ovoid_code code = scene->mRootNode ? add_node(&walk, scene->mRootNode, identity, 0) : OVOID_OK;
    free(walk.table.slots);
    aiReleaseImport(scene);
    return code;
}

#endif
