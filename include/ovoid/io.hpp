/**
 * @file io.hpp
 * Files from C++: shapes, meshes, lists, scenes, and the readers of pairs, motions and results. Links libovoid_io.
 * If something cannot be read or written, ovoid::error is thrown: its message is "path:line: what is wrong", its place
 * the line. Records, pictures and charts are plain structs: the functions of <ovoid/io.h> write them.
 */
#ifndef OVOID_IO_HPP
#define OVOID_IO_HPP

#include "ovoid/io.h"
#include "ovoid/ovoid.hpp"

#include <string>

namespace ovoid {

/** How to read a mesh: scale, parts, hull, trusted. */
using read_options = zeroed<ovoid_read_options>;

/**
 * A shape from a file: an `.ovoid` file, or a mesh that is its own hull; with how.hull, the hull of any mesh. Throws as
 * ovoid_shape_read_file fails.
 */
inline shape read_shape(const std::string &path, const ovoid_read_options &how = read_options(),
                        const ovoid_shape_options &o = shape_options()) {
    ovoid_error e;
    return shape(detail::require(ovoid_shape_read_file(path.c_str(), &how, &o, &e), e));
}
/** Writes an `.ovoid` file. If it fails, the path is unchanged. Throws FILE. */
inline void write_shape(shape_view s, const std::string &path) {
    ovoid_error e;
    detail::require(ovoid_shape_write_file(s.get(), path.c_str(), &e), e);
}

/** The triangles of a mesh file as one solid. Throws as ovoid_solid_read_file fails. */
inline solid read_solid(const std::string &path, const ovoid_read_options &how = read_options()) {
    ovoid_error e;
    return solid(detail::require(ovoid_solid_read_file(path.c_str(), &how, &e), e));
}

/** The contents of a mesh file. */
class mesh : public detail::owner<detail::pointer<ovoid_mesh>, ovoid_mesh, ovoid_mesh_destroy> {
  public:
    using owner::owner;
    /** Reads a mesh file. Throws as ovoid_mesh_read fails. */
    static mesh read(const std::string &path, const ovoid_read_options &how = read_options()) {
        ovoid_error e;
        return mesh(detail::require(ovoid_mesh_read(path.c_str(), &how, &e), e));
    }
    /** Number of parts. */
    std::size_t size() const noexcept { return ovoid_mesh_get_part_count(get()); }
    /** Part i < size: a view. Its points make a shape: shape::from_points(points_of(part)). */
    ovoid_mesh_part operator[](std::size_t i) const noexcept { return ovoid_mesh_get_part(get(), i); }
    /** A solid of the triangles of part i < size, by ovoid_mesh_create_solid. */
    solid create_solid(std::size_t i) const {
        ovoid_error e;
        return solid(detail::require(ovoid_mesh_create_solid(get(), i, &e), e));
    }
    /** What part i < size is: convex, a solid or a surface. hull: of its points. */
    ovoid_convexity compute_convexity(std::size_t i, const shape_view &hull) const {
        ovoid_convexity convexity;
        ovoid_error e{};
        const ovoid_mesh_part part = ovoid_mesh_get_part(get(), i);
        detail::require(ovoid_mesh_part_compute_convexity(&part, hull.get(), &convexity, &e), e);
        return convexity;
    }
};
/** The coordinates of a part's points, x y z x y z ... */
inline span<const double> points_of(const ovoid_mesh_part &part) noexcept {
    return {part.faces.vertices, 3 * part.faces.vertex_count};
}

/** Shapes with names. */
class shapes : public detail::owner<detail::pointer<ovoid_shapes>, ovoid_shapes, ovoid_shapes_destroy> {
  public:
    using owner::owner;
    /** The shapes of one file. Throws as ovoid_shapes_read_file fails. */
    static shapes read_file(const std::string &path, const ovoid_read_options &how = read_options(),
                            const ovoid_shape_options &o = shape_options()) {
        ovoid_error e;
        return shapes(detail::require(ovoid_shapes_read_file(path.c_str(), &how, &o, &e), e));
    }
    /** The shapes of a list of paths. Throws as ovoid_shapes_read_list fails. */
    static shapes read_list(const std::string &path, const ovoid_read_options &how = read_options(),
                            const ovoid_shape_options &o = shape_options()) {
        ovoid_error e;
        return shapes(detail::require(ovoid_shapes_read_list(path.c_str(), &how, &o, &e), e));
    }
    /** The number of shapes. */
    std::size_t size() const noexcept { return ovoid_shapes_get_count(get()); }
    /** The name of shape i < size. */
    const char *name(std::size_t i) const noexcept { return ovoid_shapes_get(get(), i).name; }
    /** Whether the mesh of shape i < size fills it. */
    ovoid_convexity convexity(std::size_t i) const noexcept { return ovoid_shapes_get(get(), i).convexity; }
    /** Shape i < size. */
    shape_view operator[](std::size_t i) const noexcept { return shape_view(ovoid_shapes_get(get(), i).shape); }
    /** The compound of these shapes, which it borrows. Throws as ovoid_compound_create fails. */
    compound create_compound(const ovoid_allocator *allocator = nullptr) const {
        ovoid_error e;
        const ovoid_compound_options o = {allocator};
        return compound(detail::require(ovoid_shapes_create_compound(get(), &o, &e), e));
    }
};

/** A scene: named bodies and pairs to ignore. */
class scene : public detail::owner<detail::pointer<ovoid_scene>, ovoid_scene, ovoid_scene_destroy> {
  public:
    using owner::owner;
    /** Reads a scene and the meshes that it names. Throws as ovoid_scene_read fails. */
    static scene read(const std::string &path, const ovoid_shape_options &o = shape_options()) {
        ovoid_error e;
        return scene(detail::require(ovoid_scene_read(path.c_str(), &o, &e), e));
    }
    /** Reads a scene and takes the hulls of its meshes: ovoid_scene_read_hulls. */
    static scene read_hulls(const std::string &path, const ovoid_shape_options &o = shape_options()) {
        ovoid_error e;
        return scene(detail::require(ovoid_scene_read_hulls(path.c_str(), &o, &e), e));
    }
    /** The number of objects. */
    std::size_t size() const noexcept { return ovoid_scene_get_count(get()); }
    /** Writes a packed scene, which both readers read in a small part of the time. Throws as ovoid_scene_write fails.
     */
    void write(const std::string &path) const {
        ovoid_error e;
        detail::require(ovoid_scene_write(get(), path.c_str(), &e), e);
    }
    /** The unit of all lengths, for example "mm"; "" if the scene names none. */
    const char *unit() const noexcept { return ovoid_scene_get_unit(get()); }
    /** The name of object i < size. */
    const char *name(std::size_t i) const noexcept { return ovoid_scene_get(get(), i).name; }
    /** Object i < size as a body, ready for queries and worlds. */
    body operator[](std::size_t i) const noexcept {
        const ovoid_pose at = ovoid_scene_get(get(), i).pose;
        return ovoid_scene_get_body(get(), i, &at);
    }
    /** The mesh of object i < size, read again. Throws as ovoid_scene_read_mesh fails: a changed file is refused. */
    ovoid::mesh read_mesh(std::size_t i) const {
        ovoid_error e;
        return ovoid::mesh(detail::require(ovoid_scene_read_mesh(get(), i, &e), e));
    }
    /** The index of the object with a name; size() if there is none. */
    std::size_t find(const std::string &named) const noexcept {
        const std::size_t i = ovoid_scene_find(get(), named.c_str());
        return i < size() ? i : size();
    }
    /** The number of meshes, each with a hull. */
    std::size_t mesh_count() const noexcept { return ovoid_scene_get_mesh_count(get()); }
    /** Hull i < mesh_count, with its name and whether its mesh fills it. */
    ovoid_named_shape mesh(std::size_t i) const noexcept { return ovoid_scene_get_mesh(get(), i); }
    /** The solid that queries use instead of hull i; empty if they use the hull. */
    solid_view mesh_solid(std::size_t i) const noexcept { return solid_view(ovoid_scene_get_mesh_solid(get(), i)); }
    /** True if the scene says to ignore the pair. */
    bool is_ignored(std::size_t a, std::size_t b) const noexcept { return ovoid_scene_is_ignored(get(), a, b) != 0; }
    /** The number of pairs of objects, without the ignored ones. */
    std::size_t pair_count() const noexcept { return ovoid_scene_get_pair_count(get()); }
};

/** Reads a PAIRS.csv line by line. */
class pairs_reader
    : public detail::owner<detail::pointer<ovoid_pairs_reader>, ovoid_pairs_reader, ovoid_pairs_reader_close> {
  public:
    using owner::owner;
    /** Opens the file. Throws FILE, FORMAT. */
    static pairs_reader open(const std::string &path, std::size_t shape_count) {
        ovoid_error e;
        return pairs_reader(detail::require(ovoid_pairs_reader_open(path.c_str(), shape_count, &e), e));
    }
    /**
     * Restricts the reader to part `part` of `parts`, counted from 0, equal shares of the file's bytes. To be called
     * before the first read. Throws ARGUMENT, FILE.
     */
    void set_part(std::size_t part, std::size_t parts) {
        ovoid_error e;
        if (ovoid_pairs_reader_set_part(get(), part, parts, &e) != OVOID_OK) detail::fail(e);
    }
    /** Skips this many pairs, or fewer if the file ends. Throws FILE, LIMIT. */
    void skip(std::uint64_t count) {
        ovoid_error e;
        if (ovoid_pairs_reader_skip(get(), count, &e) != OVOID_OK) detail::fail(e);
    }
    /** Reads the next pair; false at the end. Throws if the file is wrong. */
    bool read(ovoid_indexed_pair &next) {
        ovoid_error e;
        const int found = ovoid_pairs_reader_read(get(), &next, &e);
        if (found < 0) detail::fail(e);
        return found > 0;
    }
};

/** Reads a MOTION.csv line by line. It borrows the scene. */
class motion_reader
    : public detail::owner<detail::pointer<ovoid_motion_reader>, ovoid_motion_reader, ovoid_motion_reader_close> {
  public:
    using owner::owner;
    /** Opens the file. Throws FILE, FORMAT. */
    static motion_reader open(const std::string &path, const scene &of) {
        ovoid_error e;
        return motion_reader(detail::require(ovoid_motion_reader_open(path.c_str(), of.get(), &e), e));
    }
    /** Which columns its lines have. */
    ovoid_motion_columns columns() const noexcept { return ovoid_motion_reader_get_columns(get()); }
    /** Reads the next line; false at the end. Throws if the file is wrong. */
    bool read(ovoid_motion_line &next) {
        ovoid_error e;
        const int found = ovoid_motion_reader_read(get(), &next, &e);
        if (found < 0) detail::fail(e);
        return found > 0;
    }
    /** The number of the last line read, from 1. */
    std::int64_t line() const noexcept { return ovoid_motion_reader_get_line(get()); }
    /**
     * Skips the frames before number `frame`, counted from 0; the last line of each body in them is read next;
     * UINT64_MAX: counts those of the rest of the file, which is left out. Throws as ovoid_motion_reader_skip fails.
     */
    void skip(std::uint64_t frame) {
        ovoid_error e;
        if (ovoid_motion_reader_skip(get(), frame, &e) != OVOID_OK) detail::fail(e);
    }
    /** The number of frames of which a line was read or skipped. */
    std::uint64_t frame_count() const noexcept { return ovoid_motion_reader_get_frame_count(get()); }
};

/** Reads a results file of JSON lines. */
class results_reader
    : public detail::owner<detail::pointer<ovoid_results_reader>, ovoid_results_reader, ovoid_results_reader_close> {
  public:
    using owner::owner;
    /** Opens the file. Throws FILE. */
    static results_reader open(const std::string &path) {
        ovoid_error e;
        return results_reader(detail::require(ovoid_results_reader_open(path.c_str(), &e), e));
    }
    /** Reads the next record, which is valid until the next call; false at the end. Throws if the file is wrong. */
    bool read(ovoid_record &next) {
        ovoid_error e;
        const int found = ovoid_results_reader_read(get(), &next, &e);
        if (found < 0) detail::fail(e);
        return found > 0;
    }
    /** The line number of the last record, from 1. */
    std::int64_t line() const noexcept { return ovoid_results_reader_get_line(get()); }
};

/** A file that is put in place whole by commit, or not at all. */
class output : public detail::owner<detail::pointer<ovoid_output>, ovoid_output, ovoid_output_close> {
  public:
    using owner::owner;
    /** Starts a file. Throws FILE. */
    static output open(const std::string &path) {
        ovoid_error e;
        return output(detail::require(ovoid_output_open(path.c_str(), &e), e));
    }
    /** The stream to write to; must not be closed. */
    std::FILE *file() noexcept { return ovoid_output_get_file(get()); }
    /** Puts the file in its place. Throws FILE; then the path is unchanged. */
    void commit() {
        ovoid_error e;
        detail::require(ovoid_output_commit(get(), &e), e);
    }
};

} // namespace ovoid

#endif
