// Robots as they are published, in several dialects of URDF: links, joints, variables and elements. Truth: the tags of
// the files, counted by grep; the variables by hand. Skipped where the data is absent.
#include "robot_files.h"

#include "ovoid/ovoid.h"

/// A robot and what there is in its files.
typedef struct known_robot {
    const char *urdf, *srdf; ///< srdf: NULL for none
    size_t links, joints, variables, elements, meshes, disabled, groups, states;
    int needs_assimp;
} known_robot;

static const known_robot robots[] = {
    {"panda/urdf/panda.urdf", "panda/srdf/panda.srdf", 13, 12, 8, 17, 9, 35, 3, 1, 0},
    {"panda/urdf/panda_collision.urdf", NULL, 13, 12, 8, 39, 0, 0, 0, 0, 0},
    // A base that floats: a link, a joint and 7 variables more than in the URDF.
    {"panda_mbm/panda.urdf", "panda_mbm/panda.srdf", 14, 13, 14, 11, 10, 34, 3, 5, 0},
    {"panda_mbm/panda_spherized.urdf", NULL, 13, 12, 7, 59, 0, 0, 0, 0, 0},
    {"fetch_mbm/fetch.urdf", "fetch_mbm/fetch.srdf", 17, 16, 8, 15, 13, 74, 5, 0, 0},
    {"fetch_mbm/fetch_spherized.urdf", NULL, 17, 16, 8, 111, 0, 0, 0, 0, 0},
    {"allegro_hand/urdf/allegro_right_hand.urdf", NULL, 21, 20, 16, 21, 0, 0, 0, 0, 0},
    {"anymal_b/robots/anymal.urdf", "anymal_b/srdf/anymal.srdf", 24, 23, 19, 41, 0, 43, 12, 1, 0},
    {"kinova_jaco/robots/kinova.urdf", "kinova_jaco/srdf/kinova.srdf", 13, 12, 6, 11, 9, 0, 1, 1, 1},
    {"solo12/robots/solo12.urdf", "solo12/srdf/solo.srdf", 17, 16, 12, 17, 10, 12, 11, 2, 0},
};

static void test_robot(const char *data, const known_robot *k) {
    char urdf[600], srdf[600];
    ovoid_error error = {OVOID_OK, -1, ""};
    ovoid_robot_read_options options = make_read_options();
    snprintf(urdf, sizeof urdf, "%s/robots/%s", data, k->urdf);
    snprintf(srdf, sizeof srdf, "%s/robots/%s", data, k->srdf ? k->srdf : "");
    FILE *there = fopen(urdf, "rb");
    if (!there || (k->needs_assimp && !ovoid_io_has_assimp())) {
        check_skip(k->urdf);
        if (there) fclose(there);
        return;
    }
    fclose(there);
    ovoid_robot_file *file = ovoid_robot_file_read(urdf, k->srdf ? srdf : NULL, &options, &error);
    if (!CHECK(file)) {
        printf("  %s\n", error.message);
        return;
    }
    ovoid_robot_description d = ovoid_robot_file_get_description(file);
    ovoid_robot *robot = ovoid_robot_create(&d, NULL, &error);
    int good = CHECK_EQ(d.link_count, k->links) & CHECK_EQ(d.joint_count, k->joints) & CHECK(robot) &
               CHECK_EQ(d.element_count, k->elements) & CHECK_EQ(d.disabled_count, k->disabled) &
               CHECK_EQ(ovoid_robot_file_get_mesh_count(file), k->meshes) &
               CHECK_EQ(ovoid_robot_file_get_group_count(file), k->groups) &
               CHECK_EQ(ovoid_robot_file_get_state_count(file), k->states);
    if (robot) good &= CHECK_EQ(ovoid_robot_get_variable_count(robot), k->variables);
    if (!good) printf("  %s\n", k->urdf);
    ovoid_robot_destroy(robot);
    ovoid_robot_file_destroy(file);
}

int main(void) {
    const char *data = check_data_folder();
    for (size_t i = 0; i < sizeof robots / sizeof *robots && data; i++) test_robot(data, &robots[i]);
    if (!data) check_skip("OVOID_DATA is absent: no robots");
    return check_end();
}
