// The files in the folder of this program.
#ifndef OVOID_CLI_BASE_BESIDE_H
#define OVOID_CLI_BASE_BESIDE_H

/// Room for a folder, and for a path in it.
enum { BESIDE_FOLDER_ROOM = 4096, BESIDE_PATH_ROOM = BESIDE_FOLDER_ROOM + 32 };

/// The folder of this program; 0 if the system does not tell.
int beside_find_folder(char folder[BESIDE_FOLDER_ROOM]);

#endif
