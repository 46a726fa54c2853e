// The header of a shard, made from the command line and the inputs.
#ifndef OVOID_CLI_SHARD_HEADER_H
#define OVOID_CLI_SHARD_HEADER_H

#include "shard/write.h"

/// The header's text, which the caller frees; NULL after a message.
char *shard_header_make(const shard_job *job, const char *head, size_t head_size, size_t *size);

/// Says why two headers are not of one run, or what differs. 0 where but for the part they are the same; else the
/// message has been written as "path: what differs from other".
int shard_header_differs(const char *path, const shard_header *header, const char *other, const shard_header *first);

#endif
