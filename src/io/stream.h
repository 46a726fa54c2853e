// A mesh as a stream of records: how an importer that is not trusted hands over what it has read. The reader believes
// nothing: each point and index is checked as those of any file.
#ifndef OVOID_IO_STREAM_H
#define OVOID_IO_STREAM_H

#include "io/mesh.h"

/// Where records go. write returns 0 where it failed; later records are dropped then.
typedef struct record_sink {
    int (*write)(void *context, const void *data, size_t size);
    void *context;
    size_t used;
    int failed;
    unsigned char buffer[1 << 16];
} record_sink;

/// A part begins: its name, cut at RECORD_TEXT_MAX bytes.
void record_write_part(record_sink *sink, const char *name, size_t length);
/// A mesh begins: the corners of faces count its points, from 0.
void record_write_mesh(record_sink *sink);
void record_write_point(record_sink *sink, const double xyz[3]);
void record_write_face(record_sink *sink, const unsigned *corners, uint32_t count);
/// The end, good or bad: OVOID_OK and no text, or the error with its sentence. Flushes.
void record_write_end(record_sink *sink, ovoid_code code, const char *text);

/// Where records come from: like read(), 0 at the end, -1: failed.
typedef struct record_source {
    ptrdiff_t (*read)(void *context, void *buffer, size_t size);
    void *context;
} record_source;

/// Longest name or sentence, bytes.
enum { RECORD_TEXT_MAX = 4096 };

/// Takes a stream into the mesh. *ended: 1 if its end came; then the code is what the stream says, or what is wrong
/// with what it brought. 0: the source ended before; no error is filled.
ovoid_code record_read_mesh(mesh_reader *reader, const record_source *source, int *ended);

#endif
