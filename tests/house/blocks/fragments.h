// What the fragments of C and C++ on the pages speak of without declaring it; test_blocks.sh compiles each below this.
// PAGE_name is defined.
#include <ovoid/io.h>
#include <ovoid/ovoid.h>
#include <ovoid/robot_io.h>
#include <ovoid/robot_path.h>
#include <ovoid/robot_spheres.h>
#include <stdio.h>

extern ovoid_error error;
extern const ovoid_shape *box, *pill, *wall, *rod;
extern ovoid_pose pose, start, arm_pose, box_pose, at, to;
extern ovoid_pair pair;
extern const double *xyz;
extern uint32_t count;
extern ovoid_vec3 linear, angular;
extern double duration;
extern const ovoid_posed_shape *parts;
#ifdef PAGE_pairs
extern ovoid_answer answer;
#endif
#ifdef PAGE_compound
extern ovoid_body_pair bodies;
#endif
#ifdef PAGE_world
extern ovoid_world_body body;
extern ovoid_contact_query query;
extern ovoid_contacts frame;
extern ovoid_contact_proof proof;
#endif
#ifdef PAGE_robot_spheres
extern ovoid_robot *robot;
extern uint32_t link;
extern ovoid_robot_sphere spheres[8], found[8];
#endif
#ifdef PAGE_robot_path
extern ovoid_robot_checker *checker;
#endif
