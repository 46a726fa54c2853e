// MoveIt's text of a scene's geometry (.scene), as RViz and PlanningScene::saveGeometryToStream write it.
#ifndef OVOID_ROBOT_READ_SCENE_GEOMETRY_TEXT_H
#define OVOID_ROBOT_READ_SCENE_GEOMETRY_TEXT_H

#include "robot/read/text/yaml_tree.h"

/// Reads the file as the tree of the planning scene that it describes; all of the tree is in the pool.
ovoid_code geometry_text_read(const char *path, pool *memory, yaml_value **root, ovoid_error *error);

#endif
