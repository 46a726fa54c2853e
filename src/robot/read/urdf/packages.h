// Where the meshes of a URDF are: addresses package://NAME/PATH, file:// and paths beside the file.
#ifndef OVOID_ROBOT_READ_URDF_PACKAGES_H
#define OVOID_ROBOT_READ_URDF_PACKAGES_H

#include "robot/read/text/pool.h"

#include "ovoid/robot_io.h"

enum { PACKAGES_ANCESTORS_MAX = 64 };

/// A folder above the file, and the name that the package.xml in it gives; NULL where there is none.
typedef struct package_folder {
    const char *path, *name;
} package_folder;

/// The places where packages are looked for.
typedef struct package_search {
    const ovoid_robot_read_options *options;
    const char *ros, *ament; ///< folders with colons between; NULL: not set
    pool *memory;
    const char *urdf;                             ///< the path of the file
    package_folder above[PACKAGES_ANCESTORS_MAX]; ///< its folder, the folder around that, ...
    size_t above_count;
} package_search;

/// How an address was found.
typedef enum package_result {
    PACKAGE_FOUND,
    PACKAGE_FOUND_BY_TAIL, ///< by the end of its path, the package itself being nowhere
    PACKAGE_ABSENT,
    PACKAGE_LEFT,    ///< ".." leads out of the package
    PACKAGE_UNKNOWN, ///< no package, file or path
    PACKAGE_NO_MEMORY
} package_result;

/// Prepares a search from the folder of a URDF ("-": the working folder). 0 where there is no memory.
int package_search_open(package_search *s, const char *urdf, const ovoid_robot_read_options *options, pool *memory);
/// The path of the file that is meant, in the search's memory; a regular file, which was there.
package_result package_search_find(const package_search *s, const char *address, const char **path);
/// Says where an address that is absent was looked for.
void package_search_describe(const package_search *s, const char *address, char *text, size_t room);

#endif
