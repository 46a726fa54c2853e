// The files that Assimp's importers may open.
#ifndef OVOID_IO_MESH_ASSIMP_FILES_H
#define OVOID_IO_MESH_ASSIMP_FILES_H

#include "io/text.h"

#include <assimp/cfileio.h>

/// The imported file, by its path and bytes, and a callback before another one is read.
typedef struct assimp_files {
    const char *path;
    bytes file;
    void (*before_reading)(size_t size); ///< may be NULL
    ovoid_error refused;                 ///< why the first file that was not opened was not; code OVOID_OK: none
} assimp_files;

/// The callbacks for aiImportFileExWithProperties. The files must outlive the import.
struct aiFileIO assimp_files_make(assimp_files *files);

#endif
