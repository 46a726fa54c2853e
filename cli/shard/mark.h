// The mark of a shard, a text file beside its results: a header that says of which run they are, and lines that say how
// far the work has come, with a digest of the results until there. So what is whole can be told from a torn end; the
// last line says that all is done.
#ifndef OVOID_CLI_SHARD_MARK_H
#define OVOID_CLI_SHARD_MARK_H

#include "base/args.h"
#include "shard/digest.h"

/// How far the work has come.
typedef struct shard_progress {
    uint64_t bytes;                      ///< of results
    uint64_t units;                      ///< of work
    uint64_t sides[EXIT_NOT_PROVEN + 1]; ///< answers, by the exit code that each of them alone would give
    int is_done;                         ///< 1: that is all
} shard_progress;

exit_code shard_progress_get_exit(const shard_progress *progress);

/// Longest line of the mark that says how far the work has come, with its end.
enum { SHARD_LINE_SIZE = 160 };

/// Makes such a line. digest: of the header and of all results so far; the line ends with that of both and itself.
void shard_progress_write(char line[SHARD_LINE_SIZE], const shard_progress *progress, const shard_digest *digest);

/// What is whole of a shard.
typedef struct shard_state {
    shard_progress progress;
    shard_digest digest; ///< of the header, and of these results
    int64_t mark_size;   ///< bytes of the mark that say so
} shard_state;

/// Goes through the lines of a mark, behind its header, as long as the results are what they say. The state begins with
/// the header's digest and size.
void shard_state_find(shard_state *state, FILE *mark, FILE *results);

/// Whose part is written.
typedef struct shard_job {
    const cli_command *command; ///< its options and operands go into the header, files by their digest
    const void *settings;
    const cli_operands *operands;
    shard_part part;
    const char *path;
    int is_json;              ///< else CSV
    const ovoid_scene *scene; ///< whose objects are the bodies, in their order; NULL: there is none
    uint64_t most;            ///< lines that the merged output has at most; 0: all
    shard_digest seen;        ///< of shapes and whatever else was read beside these files
    const char *units;        ///< of work, for messages: "pairs"
} shard_job;

/// What a header says, in its order.
enum {
    SHARD_TOOL,
    SHARD_COMMAND,
    SHARD_FORMAT,
    SHARD_OPTIONS,
    SHARD_INPUTS,
    SHARD_MOST,
    SHARD_PART,
    SHARD_OBJECTS,
    SHARD_FIELDS
};

/// An object of a scene: its name as the results have it, quotes and all.
typedef struct shard_object {
    char *text;
    uint32_t index;
} shard_object;

/// A header, taken apart.
typedef struct shard_header {
    char *fields[SHARD_FIELDS];
    shard_part part;
    uint64_t most;
    shard_object *objects;
    size_t object_count;
    shard_digest digest; ///< of its text
} shard_header;

/// The header of a job as text, which the caller frees; NULL after a message.
char *shard_header_make(const shard_job *job, size_t *size);

/// Reads a header from the beginning of a file. 1; 0 where it is none or ends early, with nothing to free.
int shard_header_read(FILE *file, shard_header *header);
void shard_header_clear(shard_header *header);

void shard_objects_free(shard_object *objects, size_t count);

/// Says why two headers are not of one run, or what differs. 0 where but for the part they are the same; else the
/// message has been written as "path: what differs from other".
int shard_header_differs(const char *path, const shard_header *header, const char *other, const shard_header *first);

/// The path of the mark of these results, which the caller frees; NULL where memory is out.
char *shard_get_mark_path(const char *path);

#endif
