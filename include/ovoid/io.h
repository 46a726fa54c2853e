/**
 * @file io.h
 * Files: meshes, shapes, scenes, lists, pairs, results and pictures. A second library, libovoid_io, so that the core
 * does not depend on jansson and Assimp. docs/formats.md and docs/scene.md describe every format.
 *
 * Every function returns a code or NULL and fills *error (which may be NULL); message is "path:line: what is wrong" and
 * place the line of a text file, the vertex or face of a binary one. The path "-" reads standard input, except for
 * .ovoid files; a byte order mark (UTF-8) before a text is skipped. Nothing prints, exits or leaks, and no file makes a
 * reader allocate more than a small multiple of its own size. Memory comes from malloc. Numbers are read and written
 * with a point in every locale. Do not use one object in several threads at once; different objects are independent.
 */
#ifndef OVOID_IO_H
#define OVOID_IO_H

#include "ovoid/body.h"
#include "ovoid/decompose.h"
#include "ovoid/manifold.h"
#include "ovoid/motion.h"

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The largest file that is read as a mesh, shape or list, bytes. */
#define OVOID_FILE_SIZE_MAX ((size_t)1 << 30)

/** The largest scene, bytes: JSON takes up to 80 times as much in memory. */
#define OVOID_SCENE_SIZE_MAX ((size_t)1 << 26)

/** The largest number of parts of a mesh file. */
#define OVOID_MESH_PARTS_MAX 65536

/** The largest number of points of a mesh file, after equal ones are merged. */
#define OVOID_MESH_POINTS_MAX 20000000

/* ---- meshes ---- */

/** The mesh of a file: one part or several. Owned by the caller. */
typedef struct ovoid_mesh ovoid_mesh;

/** One part: a view into the mesh. */
typedef struct ovoid_mesh_part {
    const char *name;  /**< its name in the file; "" if it has none; never NULL */
    ovoid_faces faces; /**< points and polygons; point clouds have no faces */
} ovoid_mesh_part;

/** How to read a mesh; all zero, or NULL, is the default. */
typedef struct ovoid_read_options {
    double scale; /**< each coordinate is multiplied by it; > 0; 0 means 1 */
    const char
        *unit; /**< in which coordinates are wanted, a word of ovoid_unit_get_scale: files that say their unit
                    (COLLADA, which is read in metres) are converted, all others are in it; NULL: no conversion */
    int parts; /**< 0: everything is one part; 1: each object of the file is a part (OBJ `o`, STL `solid`, nodes) */
    int hull; /**< for shapes from meshes: 1: each is the convex hull; 0: if the mesh is its hull only nearly, the shape
                 has the allowance that keeps brackets true for the mesh (ovoid_convexity.allowance), and
                 ovoid_shape_read_file refuses other meshes; without effect on parts, whose hulls are the body */
    int solid; /**< of ovoid_shapes_read_file: 1: also for a mesh that is its hull the triangles are read as a solid */
    int trusted; /**< 0: Assimp's importers run in a child process; 1: in this process, which their faults may crash */
} ovoid_read_options;

/**
 * How many of the unit `to` one of the unit `from` is, one rounding: "m", "cm", "mm", "um", "in", "ft"; 0 for any other
 * word. ovoid_unit_get_scale("mm", "m") is 0.001, the ovoid_read_options.scale that makes metres of millimetres.
 */
OVOID_API double ovoid_unit_get_scale(const char *from, const char *to);

/**
 * Reads a mesh. STL (text, binary), OBJ, OFF, PLY (text, binary) have readers here; COLLADA (.dae), glTF (.gltf, .glb),
 * 3DS, X3D, FBX, 3MF are read through Assimp, if it was built in, with the transforms of their nodes applied. The first
 * bytes of a file decide its format, else its extension; standard input is OBJ unless its bytes say otherwise. One
 * part: every point of the file. Several: the points that the object's faces use; for an object without faces the
 * points that it declares; objects without points are left out. Only STL's equal points are merged. Assimp's importers
 * are not safe with hostile bytes. They run in a child process (fork) with limits on memory and time, and their output
 * is checked like a file: a crash there is an error here. The host receives a SIGCHLD. If fork must not be used, or not
 * while other threads run, set options->trusted for files that you trust. docs/formats.md says more. Errors: FILE,
 * FORMAT, EMPTY (no points), NOT_FINITE, RANGE, INDEX, LIMIT, ARGUMENT (scale), MEMORY.
 */
OVOID_API ovoid_mesh *ovoid_mesh_read(const char *path, const ovoid_read_options *options, ovoid_error *error);
/** Frees it; NULL is allowed. */
OVOID_API void ovoid_mesh_destroy(ovoid_mesh *mesh);
/** Number of parts, at least 1. */
OVOID_API size_t ovoid_mesh_get_part_count(const ovoid_mesh *mesh);
/** Part i < part count. */
OVOID_API ovoid_mesh_part ovoid_mesh_get_part(const ovoid_mesh *mesh, size_t i);

/** 1 if ovoid_mesh_read can use Assimp. */
OVOID_API int ovoid_io_has_assimp(void);

/** The kind of body as which a mesh is queried. */
typedef enum ovoid_mesh_kind {
    OVOID_MESH_HULL = 0, /**< its convex hull; also any shape that does not come from a mesh */
    OVOID_MESH_PARTS,    /**< a compound of its parts' hulls */
    OVOID_MESH_SOLID,    /**< the body that its triangles enclose */
    OVOID_MESH_SURFACE   /**< its triangles, which enclose nothing */
} ovoid_mesh_kind;
/** "hull", "parts", "solid" or "surface". */
OVOID_API const char *ovoid_mesh_kind_get_name(ovoid_mesh_kind kind);

/** What kind of body a mesh is, compared with its hull. */
typedef struct ovoid_convexity {
    ovoid_mesh_kind kind; /**< the kind unless the caller asks for another: HULL, SOLID or SURFACE; HULL for points
                             without faces, and if there is no mesh */
    double allowance; /**< for HULL: 0, or the `inside` of the hull's allowance that keeps brackets true for the mesh
                         itself, as ovoid_triangles_compute_hull_match proves */
    uint64_t edges_unmatched; /**< for SURFACE: the number of open edges */
    double mesh_volume; /**< for information: the enclosed volume, counted as often as the triangles wind around it; NaN
                           if they are not closed, or there are none */
    double hull_volume; /**< of the hull without its rounding radius; 0 if it is flat; NaN if there is no mesh */
} ovoid_convexity;

/**
 * The kind of a part of a mesh: hull, solid or surface, by exact signs (ovoid_triangles_compute_hull_match). hull: of
 * its points. A part with a face that cannot be cut into triangles counts as a solid, which ovoid_mesh_create_solid
 * refuses with the reason. Errors: MEMORY. Cost: that of ovoid_triangles_compute_hull_match.
 */
OVOID_API ovoid_code ovoid_mesh_part_compute_convexity(const ovoid_mesh_part *part, const ovoid_shape *hull,
                                                       ovoid_convexity *convexity, ovoid_error *error);

/**
 * The triangles of a part as a solid; if the part is not closed they are a surface, as its report says. A polygon is
 * cut into triangles from the first corner for which all of them face as the polygon does. Errors: those of
 * ovoid_solid_create_from_triangles; EMPTY (no faces), FORMAT (place: a face for which no corner works). The caller
 * destroys it.
 */
OVOID_API ovoid_solid *ovoid_mesh_create_solid(const ovoid_mesh *mesh, size_t part, ovoid_error *error);

/**
 * The triangles of a mesh file as one solid, by ovoid_mesh_create_solid. options->parts is ignored. Errors: those of
 * ovoid_mesh_read and of ovoid_mesh_create_solid.
 */
OVOID_API ovoid_solid *ovoid_solid_read_file(const char *path, const ovoid_read_options *options, ovoid_error *error);

/* ---- shapes ---- */

/** 1 if the path is that of a shape file: it ends in ".ovoid". */
OVOID_API int ovoid_path_is_shape(const char *path);

/**
 * A shape from a file: a `.ovoid` file, of which every byte is checked, or a mesh file that is its convex hull, exactly
 * or nearly; in the second case the shape has the allowance that keeps brackets true for the mesh. Any other mesh,
 * closed and not convex or open, is refused (NOT_CONVEX), unless read->hull asks for the hull. Points without faces
 * give their hull. For a `.ovoid` file a scale other than 1 or a radius is refused (ARGUMENT). read->parts is ignored.
 * The caller destroys it. Cost: that of the hull and of ovoid_mesh_part_compute_convexity, unless read->hull.
 */
OVOID_API ovoid_shape *ovoid_shape_read_file(const char *path, const ovoid_read_options *read,
                                             const ovoid_shape_options *options, ovoid_error *error);

/** Writes a `.ovoid` file through an ovoid_output: completely, or the path is unchanged. */
OVOID_API ovoid_code ovoid_shape_write_file(const ovoid_shape *shape, const char *path, ovoid_error *error);

/** Shapes with names. Owned by the caller. */
typedef struct ovoid_shapes ovoid_shapes;

/** A named shape: a view. */
typedef struct ovoid_named_shape {
    const char *name; /**< of the part, or "part 3" if it has none (counted from 0); of a whole file: its path */
    const ovoid_shape *shape;
    ovoid_convexity convexity; /**< of the mesh: the shape is the hull of any mesh; HULL for a `.ovoid` file */
    const ovoid_solid *solid;  /**< the triangles of a mesh that is not its hull; NULL: it is, or the caller asked for
                                  its hull (options->hull, options->parts), or it is from a list */
} ovoid_named_shape;

/**
 * The shapes of one file: one, or with read->parts one for each part. Each is a hull; its convexity says whether the
 * mesh is its hull.
 */
OVOID_API ovoid_shapes *ovoid_shapes_read_file(const char *path, const ovoid_read_options *read,
                                               const ovoid_shape_options *options, ovoid_error *error);

/**
 * The shapes of a LIST: a text file with one path a line, relative to the list's folder. Empty lines and lines that
 * begin with '#' are skipped and not counted. A path that occurs twice is read once. read->parts is ignored.
 */
OVOID_API ovoid_shapes *ovoid_shapes_read_list(const char *path, const ovoid_read_options *read,
                                               const ovoid_shape_options *options, ovoid_error *error);

/**
 * The compound whose parts are these shapes, in this order, each at its place in the file. It borrows them: destroy it
 * first. Errors: those of ovoid_compound_create. allocator: NULL for malloc.
 */
OVOID_API ovoid_compound *ovoid_shapes_create_compound(const ovoid_shapes *shapes,
                                                       const ovoid_compound_options *options, ovoid_error *error);

/** Frees it; NULL is allowed. */
OVOID_API void ovoid_shapes_destroy(ovoid_shapes *shapes);
/** How many there are. */
OVOID_API size_t ovoid_shapes_get_count(const ovoid_shapes *shapes);
/** Shape i < count. */
OVOID_API ovoid_named_shape ovoid_shapes_get(const ovoid_shapes *shapes, size_t i);

/* ---- scenes ---- */

/**
 * A scene: {"unit": "mm", "objects": [...], "ignore": [["a", "b"], ...]}. All lengths are in its unit, if it names one.
 * Each object has a "name" and exactly one of these, along z
 * and around the origin:
 *
 *     "mesh": path, relative to the scene file
 *     "box": [x, y, z], full sizes
 *     "sphere": radius
 *     "capsule": {"radius", "length"}, the length of its segment
 *     "cylinder" or "cone": {"radius", "length", "sides"}, 32 sides by default
 *     "ellipsoid": {"half_axes": [a, b, c]}, and "tolerance"
 *     "points": [[x, y, z], ...]
 *     "compound": [part, ...], each like an object, without a name and not a compound itself
 *
 * Optional: "pose": {"xyz", and "quat_wxyz" or "rpy"}; "radius", a rounding radius around the body; for meshes and
 * points "scale", and "unit", from which they are converted to that of the scene (to metres where it names none); for
 * meshes "parts": true, a compound of the hulls of the file's objects, "hull": true (or "solid": false), the convex
 * hull, or "solid": true, the triangles. Where none is said a mesh is what ovoid_mesh_part_compute_convexity says: the
 * hull, with the allowance of that, a solid, or a surface. A mesh with a radius or an allowance, and one in a compound,
 * must be its hull then. Anything else is refused: unknown keys, unknown names in "ignore", two objects of one name,
 * wrong types, a zero quaternion. docs/scene.md has examples.
 */
typedef struct ovoid_scene ovoid_scene;

/** One object: a view. */
typedef struct ovoid_scene_object {
    const char *name;
    const ovoid_shape *shape;       /**< NULL for a compound; for a solid its hull, for callers without solids */
    const ovoid_compound *compound; /**< NULL for all but compounds */
    ovoid_pose pose;
    const char *mesh;         /**< the path of its mesh or `.ovoid` file; NULL: it has none */
    ovoid_read_options read;  /**< how that was read */
    const ovoid_solid *solid; /**< NULL for all but solids. Objects of equal geometry share all three */
    ovoid_mesh_kind kind; /**< the kind as which it is queried; HULL for a shape of any origin, PARTS for a compound */
    ovoid_convexity convexity; /**< of a mesh of one part, whatever its kind; else both volumes are NaN */
    int is_asked;              /**< 1: the scene asks for the solid ("solid": true) */
} ovoid_scene_object;

/** Reads a scene and the meshes it names. options: of all shapes; their radius must be 0. The caller destroys it. */
OVOID_API ovoid_scene *ovoid_scene_read(const char *path, const ovoid_shape_options *options, ovoid_error *error);
/** Reads a scene in which a mesh is its convex hull, unless the scene says "solid": true or "hull": false for it. */
OVOID_API ovoid_scene *ovoid_scene_read_hulls(const char *path, const ovoid_shape_options *options, ovoid_error *error);
/** Frees it; NULL is allowed. */
OVOID_API void ovoid_scene_destroy(ovoid_scene *scene);
/**
 * Writes a packed scene through an ovoid_output: one binary file with all that was read, the shapes of meshes too,
 * which both readers read in a small part of the time. What they return is the same, to the bit. The choice of hulls is
 * kept: where it matters, the reader that was used reads the file, and the other one refuses it (ARGUMENT). Paths of
 * meshes are relative to the packed file, as to the scene. The file is of this version and byte order. Errors: FILE,
 * MEMORY.
 */
OVOID_API ovoid_code ovoid_scene_write(const ovoid_scene *scene, const char *path, ovoid_error *error);
/** How many objects there are. */
OVOID_API size_t ovoid_scene_get_count(const ovoid_scene *scene);
/** The unit of all its lengths, a word of ovoid_unit_get_scale; "" if it names none. */
OVOID_API const char *ovoid_scene_get_unit(const ovoid_scene *scene);
/** Object i < count. */
OVOID_API ovoid_scene_object ovoid_scene_get(const ovoid_scene *scene, size_t i);
/**
 * Reads the mesh of object i again, with all its triangles, as for a picture: a scene keeps only what is queried. The
 * caller destroys it. NULL after an error: ARGUMENT (the object has no mesh, or a `.ovoid` file), FORMAT (the file is
 * not the one that the scene was made from: it was changed since that was read or packed), and those of
 * ovoid_mesh_read.
 */
OVOID_API ovoid_mesh *ovoid_scene_read_mesh(const ovoid_scene *scene, size_t i, ovoid_error *error);
/** The object as a body at a pose: its solid, compound or shape. */
OVOID_API ovoid_body ovoid_scene_get_body(const ovoid_scene *scene, size_t i, const ovoid_pose *pose);
/** The number of hulls of meshes; each part of a file counts, and each scale. */
OVOID_API size_t ovoid_scene_get_mesh_count(const ovoid_scene *scene);
/** Hull i < mesh count, of an object or of a part of a compound, with the name of its part of the file. */
OVOID_API ovoid_named_shape ovoid_scene_get_mesh(const ovoid_scene *scene, size_t i);
/** The solid that is queried instead of that hull; NULL: the hull is queried. */
OVOID_API const ovoid_solid *ovoid_scene_get_mesh_solid(const ovoid_scene *scene, size_t i);
/** The object of that name, or (size_t)-1. */
OVOID_API size_t ovoid_scene_find(const ovoid_scene *scene, const char *name);
/** 1 if "ignore" names the pair, in either order. */
OVOID_API int ovoid_scene_is_ignored(const ovoid_scene *scene, size_t a, size_t b);
/** The number of pairs of objects that "ignore" does not name. */
OVOID_API size_t ovoid_scene_get_pair_count(const ovoid_scene *scene);

/* ---- pairs ---- */

/**
 * A PAIRS.csv read line by line. Header: a,b,ax,ay,az,aqw,aqx,aqy,aqz,bx,by,bz,bqw,bqx,bqy,bqz. Errors: FORMAT,
 * INDEX (a shape that is not in the list), NOT_FINITE, RANGE, ROTATION; place is the line.
 */
typedef struct ovoid_pairs_reader ovoid_pairs_reader;

/** One line. */
typedef struct ovoid_indexed_pair {
    size_t a, b; /**< 0-based shapes of the list */
    ovoid_pose pose_a, pose_b;
} ovoid_indexed_pair;

/** Opens the file ("-": standard input) and reads the header. shape_count: a and b must be below it. */
OVOID_API ovoid_pairs_reader *ovoid_pairs_reader_open(const char *path, size_t shape_count, ovoid_error *error);
/** The next pair. 1: *pair is filled; 0: the end; -1: *error is filled. */
OVOID_API int ovoid_pairs_reader_read(ovoid_pairs_reader *reader, ovoid_indexed_pair *pair, ovoid_error *error);
/**
 * Restricts the reader, before the first pair is read, to part `part` of `parts`, counted from 0: the lines that begin
 * in an equal share of the file's bytes. All parts together have each line once. The bytes before the part are not
 * read. Errors: ARGUMENT (part >= parts, not a regular file), FILE.
 */
OVOID_API ovoid_code ovoid_pairs_reader_set_part(ovoid_pairs_reader *reader, size_t part, size_t parts,
                                                 ovoid_error *error);
/** Skips that many pairs, or all that are left, without parsing their lines. Errors: FILE, LIMIT. */
OVOID_API ovoid_code ovoid_pairs_reader_skip(ovoid_pairs_reader *reader, uint64_t count, ovoid_error *error);
/** Frees it; NULL is allowed. */
OVOID_API void ovoid_pairs_reader_close(ovoid_pairs_reader *reader);

/* ---- motions ---- */

/** The columns of a MOTION.csv, by its header. */
typedef enum ovoid_motion_columns {
    OVOID_MOTION_COLUMNS_POSE = 0, /**< time,body,x,y,z,qw,qx,qy,qz */
    OVOID_MOTION_COLUMNS_VELOCITY  /**< time,body,vx,vy,vz,wx,wy,wz */
} ovoid_motion_columns;

/** A line: the pose of a body of the scene at a time, or its velocity from then on. */
typedef struct ovoid_motion_line {
    double time;
    size_t body;                /**< object of the scene */
    ovoid_pose pose;            /**< of OVOID_MOTION_COLUMNS_POSE */
    ovoid_vec3 linear, angular; /**< of OVOID_MOTION_COLUMNS_VELOCITY: of the body frame's origin, length a unit of
                                     time; radians a unit of time about axes of the world */
} ovoid_motion_line;

/**
 * A MOTION.csv read line by line: times that never decrease, a body at most once at each time. Errors: FORMAT (also:
 * times out of order, an unknown body, a body twice at one time), NOT_FINITE, RANGE, ROTATION; place is the line.
 */
typedef struct ovoid_motion_reader ovoid_motion_reader;

/** Opens the file ("-": standard input) and reads the header. The scene is borrowed: its names are the bodies. */
OVOID_API ovoid_motion_reader *ovoid_motion_reader_open(const char *path, const ovoid_scene *scene, ovoid_error *error);
/** The columns of its lines. */
OVOID_API ovoid_motion_columns ovoid_motion_reader_get_columns(const ovoid_motion_reader *reader);
/** The next line. 1: *line is filled; 0: the end; -1: *error is filled. */
OVOID_API int ovoid_motion_reader_read(ovoid_motion_reader *reader, ovoid_motion_line *line, ovoid_error *error);
/**
 * Skips the frames, all lines of one time, before number `frame`, counted from 0; the frame of the line that was read
 * last is one of them. What they change is not lost: the lines that are read next are the last line of each body in
 * the skipped frames, by the bodies, each with the time of the last of these frames; then those of frame `frame`. Does
 * nothing where a line of that frame or of a later one was read. Of skipped lines only times and names are checked;
 * their numbers are if they are read. Where the file has fewer frames, all are skipped. UINT64_MAX: the rest of the
 * file is left out, and its frames are counted by the times alone, which are checked. Errors: as of reading, MEMORY.
 * Memory: a line for each body. Cost: a tenth of reading.
 */
OVOID_API ovoid_code ovoid_motion_reader_skip(ovoid_motion_reader *reader, uint64_t frame, ovoid_error *error);
/** The number of frames of which a line was read or skipped. */
OVOID_API uint64_t ovoid_motion_reader_get_frame_count(const ovoid_motion_reader *reader);
/** The 1-based line of the file that was read last. */
OVOID_API int64_t ovoid_motion_reader_get_line(const ovoid_motion_reader *reader);
/** Frees it; NULL is allowed. */
OVOID_API void ovoid_motion_reader_close(ovoid_motion_reader *reader);

/* ---- results ---- */

/** Optional fields of a record, beside the answer of a pair. */
typedef enum ovoid_record_field {
    OVOID_RECORD_TIME = 1,    /**< of a frame, or of an impact */
    OVOID_RECORD_PARTS = 2,   /**< the parts of compounds to which the answer belongs */
    OVOID_RECORD_IMPACT = 4,  /**< that the time is that of an impact, and its bracket; also the margin */
    OVOID_RECORD_MARGIN = 8,  /**< the margin of the query */
    OVOID_RECORD_PROOF = 16,  /**< of CSV: the proof, as the last column; JSON always has it */
    OVOID_RECORD_MESHES = 32, /**< the volumes of the bodies' meshes and of their hulls */
    OVOID_RECORD_SOLIDS = 64, /**< of CSV: the triangles that decide, and what is inside; JSON has them with `solid` */
    OVOID_RECORD_CONTACTS = 128 /**< the contact manifolds of the bodies; not of an impact */
} ovoid_record_field;

/** The largest number of exclusions, steps and groups, all together, of a record in a line of JSON. */
#define OVOID_RECORD_ITEMS_MAX ((size_t)1 << 16)

/** The longest line of results that is read, bytes: more than a record of OVOID_RECORD_ITEMS_MAX items takes. */
#define OVOID_RECORD_SIZE_MAX ((size_t)1 << 25)

/** The part of a body that is not a compound. */
#define OVOID_RECORD_NO_PART UINT32_MAX

/** The contact of a part of a and a part of b, as in results files. */
typedef struct ovoid_record_contact {
    uint32_t part_a, part_b; /**< 0-based; 0: the body is not a compound */
    ovoid_manifold manifold; /**< of its memory the flags alone are written, the rest is zero where it was read */
    const ovoid_manifold_point *points;
    size_t point_count;       /**< that of the manifold */
    double grown;             /**< as in ovoid_manifold_points */
    double inner, outer;      /**< the areas of its polygon */
    const ovoid_cover *cover; /**< of a proof by a search; NULL: none */
} ovoid_record_contact;

/** The answer for one pair of bodies, as in results files. */
typedef struct ovoid_record {
    const char *a, *b;       /**< names; NULL: the indices identify the bodies */
    size_t index_a, index_b; /**< of a batch; ignored if there are names */
    ovoid_answer answer;
    const ovoid_cover *cover; /**< of ovoid_depth; NULL if there is none */
    unsigned fields;          /**< ovoid_record_field bits: which of the following are given; 0: none */
    double time;
    double frame;            /**< of an impact: the time of the frame before, the origin of the next times; NaN: none */
    double margin;           /**< of the query; for an impact also of the next two fields */
    double free_for;         /**< until frame + free_for the pair is proven farther apart than the margin */
    double hit_after;        /**< at frame + hit_after, rounded `time`, it is within the margin, proven by the answer.
                                  Infinite: nothing is proven from frame + free_for, rounded `time`, to the next
                                  frame; the answer is that at free_for, its limit says why the search ended */
    uint32_t part_a, part_b; /**< 0-based; OVOID_RECORD_NO_PART: the body is not a compound */
    const ovoid_exclusion *exclusions; /**< the proof of a compound's answer beside the parts' own; NULL: none */
    size_t exclusion_count;
    const ovoid_step *steps; /**< the proof of free_for; NULL: none */
    size_t step_count;
    const ovoid_step_group *groups; /**< of compounds: to which parts the steps belong; NULL: none */
    size_t group_count;
    ovoid_mesh_kind kind_a, kind_b; /**< the kinds of the bodies; always written */
    ovoid_convexity mesh_a, mesh_b; /**< of their meshes: the allowance, written where it is not 0 and the kind is HULL;
                                         the volumes, NaN where there is no mesh, or it has none */
    const ovoid_body_answer *solid; /**< the answer of solids, beside `answer`; NULL: there is none */
    double contact_margin, contact_angle; /**< with OVOID_RECORD_CONTACTS: the options of the contacts */
    ovoid_limit
        contact_limit; /**< NONE, or why the bodies have no contacts, however near they are: SHAPE_B, both are solids */
    const ovoid_record_contact *contacts; /**< up to the margin, sorted by part_a, then part_b; NULL: none */
    size_t contact_count;
} ovoid_record;

/**
 * Makes a record one of solids: `solid` is the answer, which must live as long, and `answer` that of the deciding pair
 * with the bracket, status and limit of the bodies. The caller fills in the meshes' kinds and the exclusions.
 */
OVOID_API void ovoid_record_set_solid(ovoid_record *record, const ovoid_body_answer *answer);

/**
 * One line of JSON with the keys time, frame, free_for, hit_after, a, part_a, b, part_b, status, limit, margin, within,
 * lower, upper, point_a, point_b, normal, stage, iterations, proof, in this order, the first four, the parts and the
 * margin where they are given; numbers with 17 digits; infinity and NaN are null. Of a solid or a surface triangle_a
 * and triangle_b stand behind a and b. Behind iterations stand kind_a, of a hull that its mesh is only nearly
 * allowance_a, and where they are given mesh_volume_a and hull_volume_a; then what belongs to b. Behind within, where
 * one solid has a component in the other, inside and component; docs/formats.md has them. within is what the bracket
 * says of the margin: "yes", "no" (farther), "at" (the bracket is as narrow as asked and holds the margin) or
 * "unproven". Before the proof stand contact_margin, contact_angle and, where there are some, contacts. FILE where the
 * stream failed; LIMIT, and nothing is written, where the record has too many items.
 */
OVOID_API ovoid_code ovoid_record_write_json(FILE *file, const ovoid_record *record);

/**
 * Writes the header of CSV, with the columns of ovoid_record_write_json: vectors are three columns, the proof, if it is
 * wanted, is one field of JSON. fields: of all records; TIME, IMPACT, MESHES, SOLIDS, CONTACTS and PROOF choose
 * columns, all others are always there; contacts are a column of JSON.
 */
OVOID_API ovoid_code ovoid_record_write_csv_header(FILE *file, unsigned fields);
/** Writes one line of CSV, with the columns that the record's fields choose; a column without a value is empty. */
OVOID_API ovoid_code ovoid_record_write_csv(FILE *file, const ovoid_record *record);

/**
 * The signed distance as text for people, in at most 63 characters: the decimal of fewest digits in the bracket; if it
 * is wider than 1e-6 of its larger end, or undecided, both ends to six digits, "1.26795 .. 3". Returns the length.
 */
OVOID_API size_t ovoid_answer_write_distance(char text[64], const ovoid_answer *answer);

/**
 * A table for people, in the given order, with a column for the time if the first record has one. The part of a
 * compound follows its name, as in "arm[3]"; the columns of the bracket are the distance, as in
 * ovoid_answer_write_distance, and the width. unit: of the lengths, for the title; NULL or "": none. Behind the numbers
 * are the result for a record's margin, and the limit that left a bracket wide. Below a pair stand its contacts, each
 * with its points.
 */
OVOID_API ovoid_code ovoid_records_write_table(FILE *file, const ovoid_record *records, size_t count, const char *unit);
/** The contacts of a record, as they stand below its row of a table. */
OVOID_API ovoid_code ovoid_record_write_contacts(FILE *file, const ovoid_record *record);

/** A results file of JSON lines, read strictly: the keys above, each once, no other. A record's fields are its keys. */
typedef struct ovoid_results_reader ovoid_results_reader;

/** Opens the file; "-" is standard input. */
OVOID_API ovoid_results_reader *ovoid_results_reader_open(const char *path, ovoid_error *error);
/** The next record, valid until the next call. 1: *record is filled; 0: the end; -1: *error is filled. */
OVOID_API int ovoid_results_reader_read(ovoid_results_reader *reader, ovoid_record *record, ovoid_error *error);
/** The 1-based line of the last record. */
OVOID_API int64_t ovoid_results_reader_get_line(const ovoid_results_reader *reader);
/** Frees it; NULL is allowed. */
OVOID_API void ovoid_results_reader_close(ovoid_results_reader *reader);

/* ---- proofs of decompositions ---- */

/** A proof of <ovoid/decompose.h> in a file, and its numbers of triangles and parts. */
typedef struct ovoid_decomposition_record {
    ovoid_decomposition_proof proof; /**< cells: 0 */
    uint64_t triangles, parts;
} ovoid_decomposition_record;

/** Writes a proof as one line of JSON: its two lengths, and the numbers of triangles and parts. FILE. */
OVOID_API ovoid_code ovoid_decomposition_write_json(FILE *file, const ovoid_decomposition *decomposition,
                                                    const ovoid_decomposition_proof *proof);
/** Reads a proof, strictly; ovoid_decomposition_verify checks whether it is true. FILE, FORMAT, LIMIT, MEMORY. */
OVOID_API ovoid_code ovoid_decomposition_read_json(const char *path, ovoid_decomposition_record *record,
                                                   ovoid_error *error);
/** 1 if the file begins like a proof of a decomposition; 0 for standard input. */
OVOID_API int ovoid_decomposition_is_proof(const char *path);

/* ---- texts of files, written and read ---- */

/**
 * The number of bytes of the first character of the text; 0 if it should not be shown: it is not UTF-8, controls
 * terminals (C0, DEL, C1), changes the direction of the text (U+202A and others) or has no width.
 */
OVOID_API size_t ovoid_text_get_visible_length(const char *text);

/**
 * Writes a text of JSON, in quotes. Characters that should not be shown are escaped; bytes that are not UTF-8 become
 * U+FFFD.
 */
OVOID_API void ovoid_text_write_json(FILE *file, const char *text);

/**
 * Writes a field of CSV that no spreadsheet takes for a formula. It is in quotes if it has a comma, a semicolon, a
 * quote or blanks at an end. It has an apostrophe before it if its first character, blanks aside, is one of = + - @ '
 * or the wide forms of these four. Each byte that should not be shown is written as `\xHH`, and so is the backslash of
 * a text that looks like that. ovoid_text_read_csv reverses all of it.
 */
OVOID_API void ovoid_text_write_csv(FILE *file, const char *text);

/**
 * Reads the first field of a line of CSV that ends with a zero byte, or before it with "\n" or "\r\n", into text, which
 * has room for `room` bytes; the line's length and one is enough. Returns the position behind the field: the comma, or
 * the end. NULL and FORMAT: quotes that do not close, or in a text without them; an escape of zero; no room.
 */
OVOID_API const char *ovoid_text_read_csv(const char *line, char *text, size_t room, ovoid_error *error);

/* ---- output files ---- */

/** A file that appears completely or not at all: written under another name in the same folder, then renamed. */
typedef struct ovoid_output ovoid_output;

/**
 * Opens an output. A path that exists and is not a regular file (a device, a pipe) is written to directly; "-": stdout.
 */
OVOID_API ovoid_output *ovoid_output_open(const char *path, ovoid_error *error);
/** The stream to write to; the caller must not close it. */
OVOID_API FILE *ovoid_output_get_file(ovoid_output *output);
/** The path of the unfinished file, for signal handlers that must remove it; NULL if it is written to directly. */
OVOID_API const char *ovoid_output_get_temporary(const ovoid_output *output);
/**
 * Flushes the file and renames it to its path; FILE if anything was not written (a full disk), and the path is
 * unchanged.
 */
OVOID_API ovoid_code ovoid_output_commit(ovoid_output *output, ovoid_error *error);
/** Frees it; an uncommitted file is removed. NULL is allowed. */
OVOID_API void ovoid_output_close(ovoid_output *output);

/* ---- pictures ---- */

/** The layers of a picture. */
typedef enum ovoid_picture_layer {
    OVOID_PICTURE_OUTER = 1,   /**< outer ellipsoids: outlines and a few lines on them */
    OVOID_PICTURE_INNER = 2,   /**< inner ellipsoids */
    OVOID_PICTURE_AREAS = 4,   /**< the 8 areas: faces split along the inner ellipsoid's octants and tinted by them */
    OVOID_PICTURE_WITNESS = 8, /**< witness points, the line between them and its length */
    OVOID_PICTURE_NAMES = 16,  /**< names at the bodies */
    OVOID_PICTURE_LEGEND = 32, /**< legend and scale bar */
    OVOID_PICTURE_MESHES = 64  /**< the bodies' meshes, if they have one, instead of polyhedra */
} ovoid_picture_layer;

/** Of ovoid_picture_body.is_mesh: the mesh is the body and closed. */
#define OVOID_PICTURE_CLOSED 2

// New members come last.
/** A body of a picture. */
typedef struct ovoid_picture_body { // NOLINT(clang-analyzer-optin.performance.Padding)
    const char *name;               /**< may be NULL */
    const ovoid_shape *shape;
    ovoid_pose pose;
    uint32_t
        group; /**< bodies of one group, for example the parts of a compound, have one colour; 0: a colour of its own */
    const ovoid_faces *mesh; /**< whose hull the shape is, in the frame that the pose moves; NULL: none; not drawn for a
                                shape with a rounding radius */
    int is_mesh; /**< 1: the mesh is the body, and the shape only its hull: the mesh is drawn for all layers, and no
                    inner ellipsoid. OVOID_PICTURE_CLOSED: it is also closed, and faces that look away are left out */
} ovoid_picture_body;

/** A pair of a picture: its witness points are drawn. */
typedef struct ovoid_picture_link {
    size_t a, b;
    const ovoid_answer *answer;
} ovoid_picture_link;

/** A picture. */
typedef struct ovoid_picture {
    const ovoid_picture_body *bodies;
    size_t body_count;
    const ovoid_picture_link *links;
    size_t link_count;
    const char *title; /**< may be NULL */
    const char *unit;  /**< of the lengths written, for example "m"; may be NULL */
} ovoid_picture;

/** How to draw; all zero, or NULL, is the default. */
typedef struct ovoid_picture_options {
    uint32_t width, height; /**< pixels; 0 means 1200 and 800 */
    ovoid_vec3 view;        /**< from the scene to the eye; zero means three quarters from above: (1, -1.6, 0.9) */
    uint32_t layers; /**< ovoid_picture_layer bits; 0 means all but the areas and meshes, and for more than 12 bodies
                        meshes and no ellipsoids; without inner ellipsoids, faces hide what is behind them */
} ovoid_picture_options;

/** Writes an SVG picture through an ovoid_output. At most 1 000 000 triangles in all (LIMIT). */
OVOID_API ovoid_code ovoid_picture_write_svg(const char *path, const ovoid_picture *picture,
                                             const ovoid_picture_options *options, ovoid_error *error);

/** Writes the picture to a stream, as one svg element. Its errors are those of ovoid_picture_write_svg. */
OVOID_API ovoid_code ovoid_picture_write_stream(FILE *file, const ovoid_picture *picture,
                                                const ovoid_picture_options *options, ovoid_error *error);

/* ---- charts ---- */

/** How a series is drawn. */
typedef enum ovoid_series_kind {
    OVOID_SERIES_LINE = 0, /**< points joined by lines, with marks if they are few */
    OVOID_SERIES_POINTS,   /**< marks only */
    OVOID_SERIES_BARS,     /**< bars from zero, side by side */
    OVOID_SERIES_STACK,    /**< bars on top of each other, in the order of the series */
    OVOID_SERIES_TICKS     /**< upright ticks */
} ovoid_series_kind;

/** One row of values. Values that are not finite, or not positive on a logarithmic axis, leave a gap. */
typedef struct ovoid_series {
    const char *name; /**< for the legend; NULL: none */
    ovoid_series_kind kind;
    size_t count;
    const double *x; /**< NULL: 0, 1, 2, ... */
    const double *y; /**< count values */
    const double *low,
        *high; /**< a band around the line, also where y has a gap, or a whisker on the bar; both or NULL */
} ovoid_series;

/** A chart; all zero but the series is the default. The arrays and texts are borrowed. */
typedef struct ovoid_chart {
    const char *title, *x_label, *y_label; /**< may be NULL */
    const ovoid_series *series;
    size_t series_count;
    const char *const *categories; /**< labels of x = 0, 1, 2, ...; NULL: a number axis */
    size_t category_count;
    int x_log, y_log;       /**< logarithmic axes */
    double y_min, y_max;    /**< 0 and 0: the range of the values */
    uint32_t width, height; /**< pixels; 0 means 720 and 400 */
} ovoid_chart;

/**
 * Writes the chart as one svg element, which is a file of its own or a part of an HTML page. The same chart gives the
 * same bytes. FILE if the stream failed, LIMIT for more than 12 series (there are no more distinct colours).
 */
OVOID_API ovoid_code ovoid_chart_write_svg(FILE *file, const ovoid_chart *chart);

#ifdef __cplusplus
}
#endif
#endif
