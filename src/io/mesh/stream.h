// A mesh as a stream of records, from an untrusted importer to its reader, which checks each point and index like those
// of any file.
#ifndef OVOID_IO_MESH_STREAM_H
#define OVOID_IO_MESH_STREAM_H

#include "io/mesh/mesh_build.h"

/// The output of records. write returns 0 where it failed; later records are dropped then.
typedef struct record_sink {
    int (*write)(void *context, const void *data, size_t size);
    void *context;
    size_t used;
    int failed;
    unsigned char buffer[1 << 16];
} record_sink;

/// Begins a part; its name is cut at RECORD_TEXT_MAX bytes.
void record_write_part(record_sink *sink, const char *name, size_t length);
/// Begins a mesh: the corners of its faces count its points, from 0.
void record_write_mesh(record_sink *sink);
void record_write_point(record_sink *sink, const double xyz[3]);
void record_write_face(record_sink *sink, const unsigned *corners, uint32_t count);
/// Ends the stream: OVOID_OK and no text, or the error with its sentence. Flushes.
void record_write_end(record_sink *sink, ovoid_code code, const char *text);

/// The input of records: as read(), 0 at the end, -1: failed.
typedef struct record_source {
    ptrdiff_t (*read)(void *context, void *buffer, size_t size);
    void *context;
} record_source;

/// Longest name or sentence, bytes.
enum { RECORD_TEXT_MAX = 4096 };

/// Adds a stream's records to the mesh. *ended: 1 if the last record came; then the code is the stream's, or the error
/// of its contents. 0: the source ended before; no error is filled.
ovoid_code record_read_mesh(mesh_reader *reader, const record_source *source, int *ended);

#endif
