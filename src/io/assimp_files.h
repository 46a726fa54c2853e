// The files that Assimp's importers may see.
#ifndef OVOID_IO_ASSIMP_FILES_H
#define OVOID_IO_ASSIMP_FILES_H

#include "io/text.h"

#include <assimp/cfileio.h>

/// The file that is being imported, by its path and bytes, and what to call before another one is read.
typedef struct assimp_files {
    const char *path;
    bytes file;
    void (*before_reading)(size_t size); ///< may be NULL
} assimp_files;

/// What aiImportFileExWithProperties takes. The files must live as long.
struct aiFileIO assimp_files_make(assimp_files *files);

#endif
