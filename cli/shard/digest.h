// Digests of bytes, files and shapes: by them shards of other inputs are told apart, and damaged blocks of files found.
#ifndef OVOID_CLI_SHARD_DIGEST_H
#define OVOID_CLI_SHARD_DIGEST_H

#include <ovoid/io.h>

/// A digest that grows. Not cryptographic: it notices accidents, not an adversary.
typedef struct shard_digest {
    uint64_t lanes[4];
    unsigned char rest[32]; ///< bytes that do not fill a step yet
    size_t rest_size;
    uint64_t size; ///< bytes so far
} shard_digest;

shard_digest shard_digest_make(void);
void shard_digest_add(shard_digest *digest, const void *bytes, size_t size);
/// The value for all bytes so far.
uint64_t shard_digest_get(const shard_digest *digest);

/// Adds that many bytes from the stream's place on. 0: they are not there.
int shard_digest_add_stream(shard_digest *digest, FILE *file, uint64_t count);

/// Adds a regular file's size and content; of one above SHARD_WHOLE_MAX bytes the content of SHARD_SAMPLES pieces of
/// SHARD_SAMPLE bytes, evenly spaced, with the first and the last ones, so that any file costs a part of a second. 0,
/// or EXIT_INPUT after a message.
int shard_digest_add_file(shard_digest *digest, const char *path);
enum { SHARD_SAMPLES = 256, SHARD_SAMPLE = 1 << 20, SHARD_WHOLE_MAX = SHARD_SAMPLES * SHARD_SAMPLE };

/// Adds a shape: its vertices, ellipsoids, radius and allowance; and the solid that counts in its place, or NULL.
void shard_digest_add_body(shard_digest *digest, const ovoid_shape *shape, const ovoid_solid *solid);

/// Adds all shapes of a list, or all meshes of a scene.
void shard_digest_add_shapes(shard_digest *digest, const ovoid_shapes *shapes);
void shard_digest_add_scene(shard_digest *digest, const ovoid_scene *scene);

#endif
