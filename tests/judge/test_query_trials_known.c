// Pairs on which other libraries failed, from their issue threads. Truth: brute force over all features in exact
// arithmetic (the bodies have few vertices), the exact judge for every answer, and the number of the thread where there
// is one. Poses given as matrices are applied to the vertices in doubles, so the hulls judged are those asked about.
#include "check.h"
#include "trials/ask.h"

static tally counts = {.name = "known cases"};

typedef struct known {
    const char *name;
    const double *a, *b;
    size_t count_a, count_b;
    double d, tolerance; // of the thread; infinite: brute force only
    int sign;            // -1, 0, 1; 2: not known beforehand
} known;

// The bracket holds the truth, to 1e-9 of the pair's size; the sign is the truth's.
static judge_truth check_pair(const char *name, const ovoid_pair *pair) {
    uint64_t state = 1;
    judge_truth truth;
    CHECK_EQ(judge_compute_truth(trial_judge, pair, &truth, NULL), OVOID_OK);
    (void)trial_ask(&counts, pair, &(trial_hints){.truth = &truth}, &state);
    ovoid_answer x = ovoid_depth(pair, NULL, NULL, NULL);
    printf("%-18s %-11s %.17g, brute force %.17g\n", name, ovoid_status_get_name(x.status), 0.5 * (x.lower + x.upper),
           truth.low);
    CHECK_LE(x.lower, truth.high);
    CHECK_LE(truth.low, x.upper);
    CHECK_LE(x.upper - x.lower, 1e-9 * pair_size(pair));
    CHECK(x.status != OVOID_UNDECIDED);
    if (x.status == OVOID_SEPARATED) CHECK_EQ(truth.sign, 1);
    if (x.status == OVOID_OVERLAPPING) CHECK_EQ(truth.sign, -1);
    ovoid_shape_destroy((ovoid_shape *)pair->shape_a);
    ovoid_shape_destroy((ovoid_shape *)pair->shape_b);
    judge_forget(trial_judge);
    return truth;
}

static void check_known(const known *k) {
    ovoid_pair pair = {ovoid_shape_create_from_points(k->a, k->count_a, NULL, NULL),
                       ovoid_shape_create_from_points(k->b, k->count_b, NULL, NULL), ovoid_pose_make_identity(),
                       ovoid_pose_make_identity()};
    judge_truth truth = check_pair(k->name, &pair);
    if (k->sign != 2) CHECK_EQ(truth.sign, k->sign);
    CHECK_NEAR(truth.low, k->d, k->tolerance);
}

// One set of points in two poses.
static void check_posed(const char *name, const double *xyz, size_t count, ovoid_pose a, ovoid_pose b, int sign) {
    ovoid_pair pair = {ovoid_shape_create_from_points(xyz, count, NULL, NULL),
                       ovoid_shape_create_from_points(xyz, count, NULL, NULL), a, b};
    judge_truth truth = check_pair(name, &pair);
    CHECK_EQ(truth.sign, sign);
}

// The corners of a box of these full sizes under a 3 x 4 matrix.
static void set_box(double *xyz, double x, double y, double z, const double *m) {
    for (int i = 0; i < 8; i++) {
        double v[3] = {i & 1 ? x / 2 : -x / 2, i & 2 ? y / 2 : -y / 2, i & 4 ? z / 2 : -z / 2};
        for (int r = 0; r < 3; r++)
            xyz[3 * i + r] = m[4 * r] * v[0] + m[4 * r + 1] * v[1] + m[4 * r + 2] * v[2] + m[4 * r + 3];
    }
}

typedef struct boxes {
    const char *name;
    double size_a[3], at_a[12], size_b[3], at_b[12], d, tolerance;
    int sign;
} boxes;

static const boxes box_cases[] = {
    // Off by far at a tolerance of 1e-6; the thread has the distance. Its matrices have 10 digits.
    {"coal#604",
     {0.363, 0.277, 0.363},
     {0.9999195703, 0.01021849413, 0.007512347878, 1.503354966, -0.01021878248, 0.9999477869, -3.329855922e-17,
      -0.8531707835, -0.007511955635, -7.676704888e-05, 0.9999717819, 0.7700092418},
     {0.363, 0.363, 0.277},
     {0.9998670967, -0.01297708324, 0.009868343982, 1.48838308, 0.01297771517, 0.9999157859, 5.255670031e-17,
      -1.102020834, -0.009867512928, 0.0001280685574, 0.9999513067, 0.4497073799},
     3.57545430925419e-06,
     1e-9,
     1},
    // Kissing boxes of one orientation: EPA threw, since the origin was outside of its polytope.
    {"fcl#493",
     {0.5, 0.5, 0.5},
     {0.96193976625564348026, 0.15401279915737359216, 0.22572537250328919556, 2.0770063995786869349,
      -0.19134171618254486313, 0.96936494951283913579, 0.15401279915737359216, 0.48468247475641951239,
      -0.19509032201612822033, -0.19134171618254486313, 0.96193976625564348026, 1.1543291419087275962},
     {0.5, 0.5, 0.5},
     {0.96193976625564348026, 0.15401279915737359216, 0.22572537250328919556, 2, -0.19134171618254486313,
      0.96936494951283913579, 0.15401279915737359216, 0, -0.19509032201612822033, -0.19134171618254486313,
      0.96193976625564348026, 1.25},
     0,
     1e-14,
     2},
    {"fcl#495",
     {0.25, 0.25, 0.25},
     {0.94096063217417758029, 0.29296840037289501035, 0.16959541586174811667, 0.073242100093223821977,
      -0.23569836841299879326, 0.92661523595848427348, -0.29296840037289506586, 0.2316538089896212349,
      -0.2429801799032638987, 0.23569836841299884878, 0.94096063217417758029, 1.3089245921032497399},
     {0.25, 0.25, 0.25},
     {0.94096063217417758029, 0.29296840037289501035, 0.16959541586174811667, 0, -0.23569836841299879326,
      0.92661523595848427348, -0.29296840037289506586, 0, -0.2429801799032638987, 0.23569836841299884878,
      0.94096063217417758029, 1.25},
     0,
     1e-14,
     2},
    // "Incorrectly calls EPA": brute force says that they overlap by 3.4e-5.
    {"fcl#399",
     {0.23768037557601928711, 0.15702305734157562256, 0.25},
     {-0.099432387353076273628, 0.99504432079443971837, 0, 0.29526406526565551758, -0.99504432079443971837,
      -0.099432387353076273628, 0, -0.013230856508016586304, 0, 0, 1, 0},
     {0.010000000000000000208, 0.78165709971381591797, 0.25},
     {0.99506598442099225554, 0.099215354901756730444, 0, 0.22759585694545214629, -0.099215354901756730444,
      0.99506598442099225554, 0, 0.14974093549228112421, 0, 0, 1, 0},
     0,
     1,
     2},
    // Calls of EPA for boxes that only touch, from the wild: each ended in an exception.
    {"fcl#390",
     {0.03, 0.12, 0.1},
     {-3.0627937852578681533e-08, -0.99999999999999888978, -2.8893865161583314238e-08, 0.63499979627350811029,
      0.9999999999999980016, -3.0627939739957803544e-08, 6.4729926918527511769e-08, -0.48500002215636439651,
      -6.4729927722963847085e-08, -2.8893863029448751323e-08, 0.99999999999999711342, 1.0778146458339641356},
     {0.025, 0.35, 1.845},
     {0, -1, 0, 0.8, 1, 0, 0, -0.4575, 0, 0, 1, 1.0225},
     0,
     1,
     2},
    {"fcl#395",
     {0.46, 0.48, 0.01},
     {1, 0, 0, -0.72099999999999997424, 0, 1, 0, -0.77200000000000001954, 0, 0, 1, 0.81000000000000005329},
     {0.049521, 0.146, 0.0725},
     {0.10758262492983036718, -0.6624881850015212903, -0.74130653817877356637, -0.42677133002999478872,
      0.22682184885125472595, -0.709614040775253474, 0.6670830248314786326, -0.76596851247746788882,
      -0.96797615037608542021, -0.23991106241273435495, 0.07392465377049164954, 0.80746731400091054098},
     0,
     1,
     2},
    {"fcl#398",
     {0.61399999999999999023, 3, 0.036999999999999998168},
     {1, 0, 0, -0.67500000000000004441, 0, 1, 0, 0, 0, 0, 1, 0.91149999999999997691},
     {0.49399999999999999467, 0.55200000000000004619, 0.010000000000000000208},
     {1, 0, 0, -0.692, 0, 1, 0, 0, 0, 0, 1, 0.935},
     0,
     1e-15,
     2},
    {"fcl#415",
     {0.49, 0.05, 0.21},
     {4.8966386501092529215e-12, -1, 0, -0.43999999999999994671, 1, 4.8966386501092529215e-12, 0,
      -0.61499999999858001587, 0, 0, 1, 0.35499999999999998224},
     {0.035, 0.12, 0.03},
     {0.83512153565236335595, -0.55006546945762568868, -9.4542360608233572896e-16, -0.40653441507331000704,
      0.55006546945762568868, 0.83512153565236313391, 1.1787444236552387666e-15, -0.69166166923735727945,
      1.2902271444330665572e-16, -1.4878153530113264589e-15, 1, 0.43057093858718892276},
     0,
     1,
     2},
    {"fcl#428",
     {0.2, 0.33, 0.1},
     {1, 0, 0, -0.071000000000000035305, 0, 1, 0, -0.77200000000000001954, 0, 0, 1, 0.79999999999999993339},
     {0.452, 0.27, 0.6},
     {1, 0, 0, 0.12099999999999999645, 0, 1, 0, -0.78769605692727695523, 0, 0, 1, 0.53422044196125151316},
     0,
     1,
     2},
    // The thread expects 0, to its tolerance.
    {"fcl#445",
     {0.31650000000000000355, 0.22759999999999999676, 0.1768000000000000127},
     {0.44540578475530234748, 0.89532881496493399442, -8.8937407685638678971e-09, 1.2652949075960071568,
      -0.89532881496493377238, 0.44540578475530190339, -2.8948680226084145336e-08, 1.4551012423210101243,
      -2.1957263975186326105e-08, 2.0856732016652919226e-08, 0.99999999999999955591, 0.49480006232932938204},
     {0.49430000000000001714, 0.35460000000000002629, 0.075200000000000002953},
     {0.44171122913485860728, 0.8971572827861190591, -1.622764514865468214e-09, 1.1304016226141906376,
      -0.8971572827861190591, 0.44171122913485860728, -5.1621053952306079594e-09, 1.8410802645284281009,
      -3.9144271413829990148e-09, 3.7360349218094348098e-09, 1, 0.44400006232932492933},
     0,
     1e-5,
     2},
    // An edge of one box on a face of the other, in the plane of both centres.
    {"drake#21673",
     {0.050000000000000002776, 0.55000000000000004441, 0.2999999999999999889},
     {0.00079632671073326442932, -0.99999968293183538748, 0, 0.75000000000000055511, 0.99999968293183538748,
      0.00079632671073326442932, 0, -2.4083553715553102684e-15, 0, 0, 1, 0.14999999999999999445},
     {0.25, 0.2000000000000000111, 0.14999999999999999445},
     {6.1232339957367660359e-17, 0, 1, 0.75, -1, 6.1232339957367660359e-17, 6.1232339957367660359e-17, 0,
      -6.1232339957367660359e-17, -1, 3.7493994566546440196e-33, 0.14999999999999999445},
     0,
     1,
     2},
    // Two unit boxes 4 apart along y: 3.16228 was the answer, 3 is the truth.
    {"fcl#508",
     {1, 1, 1},
     {1, 0, 0, 0, 0, 1, 0, 4, 0, 0, 1, 0},
     {1, 1, 1},
     {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
     3,
     0,
     1},
    // Two cubes, one on the other: NaN; the depth is 2 - 1.9.
    {"libccd#25",
     {2, 2, 2},
     {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
     {2, 2, 2},
     {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 1.9},
     -0.1,
     1e-15,
     -1},
    // Penetrating cubes were called apart, 2 of 10 000 (the thread has no numbers; random ones are in
    // test_query_trials_generators.c): here of one orientation, centres near.
    {"openGJK#13",
     {1, 1, 1},
     {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
     {1, 1, 1},
     {0, -1, 0, 0.5, 1, 0, 0, 0.25, 0, 0, 1, 0.125},
     -0.5,
     0,
     -1},
};

static void test_boxes(void) {
    for (size_t i = 0; i < sizeof box_cases / sizeof *box_cases; i++) {
        const boxes *k = &box_cases[i];
        double a[24], b[24];
        set_box(a, k->size_a[0], k->size_a[1], k->size_a[2], k->at_a);
        set_box(b, k->size_b[0], k->size_b[1], k->size_b[2], k->at_b);
        check_known(&(known){k->name, a, b, 8, 8, k->d, k->tolerance, k->sign});
    }
}

static void test_points(void) {
    // A point and seven: no convergence.
    static const double dolfinx_a[] = {44.2919, 39.7508, 18.8208};
    static const double dolfinx_b[] = {46.0659, 38.6251, 16.3637, 44.2764, 42.3867, 18.239,  50.0397,
                                       38.4649, 19.9843, 47.1963, 40.4563, 19.1057, 48.0266, 38.5593,
                                       18.2475, 45.1735, 40.495,  17.3336, 48.0415, 40.4456, 18.1963};
    check_known(&(known){"dolfinx#3653", dolfinx_a, dolfinx_b, 1, 7, 0, 10, 1});

    // Overlapping prisms at coordinates of 9e4, singles: 0.0033 apart. Their sides are nearly what the z extent is:
    // 300.
    static const double open_a[] = {90945.08f, 54122.54f,  300, 91077.46f, 53745.082f, 300, 91454.92f, 53877.46f,  300,
                                    91322.54f, 54254.918f, 300, 90945.08f, 54122.54f,  0,   91077.46f, 53745.082f, 0,
                                    91454.92f, 53877.46f,  0,   91322.54f, 54254.918f, 0};
    static const double open_b[] = {90919.64f, 54037.383f, 300, 91162.62f, 53719.637f, 300, 91480.36f, 53962.617f, 300,
                                    91237.38f, 54280.363f, 300, 90919.64f, 54037.383f, 0,   91162.62f, 53719.637f, 0,
                                    91480.36f, 53962.617f, 0,   91237.38f, 54280.363f, 0};
    check_known(&(known){"openGJK#52", open_a, open_b, 8, 8, -300, 0, -1});

    // Flat polygons that cross: 0.509 apart. Coplanar bodies have depth 0.
    static const double flat_a[] = {0.795121,  -0.727851, 0, -0.178424, -0.989183, 0,
                                    -0.412644, -0.770664, 0, 0.566564,  0.548772,  0};
    static const double flat_b[] = {-0.211223, -0.511346, 0, -0.347973, 0.45872, 0, 0.277308, 0.969689, 0};
    check_known(&(known){"openGJK#3", flat_a, flat_b, 4, 3, 0, 0, 0});

    // Six points each: no agreement between GJK and the truth.
    static const double six_a[] = {1.9408982677575293,  1.7555630101186028, 0.18558370457138618,  0.8325772811802072,
                                   0.07348739881751665, 1.7363835855830982, 0.4647979626331866,   0.7802364656205514,
                                   0.7683352436509485,  1.8147849498111688, 0.1710650007346617,   1.802196858095821,
                                   0.05742372721610556, 1.6599005060005285, 0.014474511746654706, 1.5270861966500002,
                                   0.4945624540164677,  0.7162419894551117};
    static const double six_b[] = {0.13746727993941066,  0.20129636190312772, 0.34482818309629215, 0.5315223185064999,
                                   0.859293459032485,    0.6275795914219559,  0.5810087058274663,  0.42871589938255994,
                                   0.6201313431197037,   0.48395328848552066, 0.35710287272501984, 0.27586601014041534,
                                   0.1586377710691551,   0.6421620047252284,  0.6487788989727401,  0.5185197562895357,
                                   0.058044153658207476, 0.4020269780737239};
    check_known(&(known){"distance3d#27", six_a, six_b, 6, 6, 0, 10, 2});

    // One hull of six vertices, twice, in one orientation: overlapping, and called apart.
    static const double warp[] = {-0.0611590669, -0.13801524,  -0.158372656, 0.0620514415,  0.135089189,  -0.159879193,
                                  -0.105518319,  -0.100999095, -0.188289702, -0.107238553,  -0.102976903, 0.1569262,
                                  -0.0851279497, -0.122304708, 0.156887323,  -0.0590926372, -0.104567274, -0.242715642};
    const ovoid_quat turn = {0.5425650813, 0.0029009761, 0.0001424328, 0.8400087479};
    check_posed("mujoco_warp#1527", warp, 6, (ovoid_pose){{-0.141666584, 0, 0}, turn},
                (ovoid_pose){{0.141666584, 0, 0}, turn}, -1);

    // A long box and a turned one that overlap: an assertion failed.
    static const double long_a[] = {-119.5, -120.5, -119.5, -119.5, -119.5, -119.5, -119.5, -120.5,
                                    -120.5, -119.5, -119.5, -120.5, -89.5,  -120.5, -119.5, -89.5,
                                    -119.5, -119.5, -89.5,  -120.5, -120.5, -89.5,  -119.5, -120.5};
    static const double turned_b[] = {-90.0,         -120.14644661, -120.85355335, -90.0,         -120.85355339,
                                      -120.14644656, -90.70710679,  -119.64644658, -120.35355338, -90.70710679,
                                      -120.35355336, -119.64644659, -89.29289321,  -119.64644664, -120.35355341,
                                      -89.29289321,  -120.35355342, -119.64644662, -90.0,         -119.14644661,
                                      -119.85355344, -90.0,         -119.85355339, -119.14644665};
    check_known(&(known){"distance3d#72", long_a, turned_b, 8, 8, -1, 1, -1});
}

// A cube given with each corner three times, as 24 vertices (godot#41522): the same answer as from 8.
static void test_duplicates(void) {
    double corners[24], many[72];
    const double here[12] = {1, 0, 0, 0.25, 0, 1, 0, 0, 0, 0, 1, 0};
    set_box(corners, 1, 1, 1, here);
    for (int i = 0; i < 24; i++) memcpy(many + 3 * i, corners + 3 * (i % 8), 3 * sizeof(double));
    check_known(&(known){"godot#41522", many, corners, 24, 8, -1, 0, -1});
}

int main(void) {
    trial_judge = judge_create();
    if (!CHECK(trial_judge != NULL)) return check_end();
    test_boxes();
    test_points();
    test_duplicates();
    judge_destroy(trial_judge);
    tally_print_header();
    tally_print(&counts);
    check_passed += (long)(counts.answers - counts.wrong);
    check_failed += (long)counts.wrong;
    return check_end();
}
