// The folder of this program, as the system names it.
#include "base/beside.h"

#include <string.h>
#include <unistd.h>

int beside_find_folder(char folder[BESIDE_FOLDER_ROOM]) {
    ssize_t length = readlink("/proc/self/exe", folder, BESIDE_FOLDER_ROOM - 1);
    if (length <= 0 || length == BESIDE_FOLDER_ROOM - 1) return 0;
    folder[length] = 0;
    char *slash = strrchr(folder, '/');
    if (!slash) return 0;
    *slash = 0;
    return 1;
}
