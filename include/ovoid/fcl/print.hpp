/**
 * @file print.hpp
 * The print of an FCL geometry, by which <ovoid/fcl.hpp> notices that a geometry has changed, or that another one has
 * its address. It holds the type and sizes; of vertices their address, their number and at most 16 of them; of a convex
 * polytope also the mean of all; of a mesh also the volume at the root of its tree, which a refit computes anew from
 * all vertices. AABB and KDOP volumes say less about what is inside, so the prints of those meshes mix all vertices.
 */
#ifndef OVOID_FCL_PRINT_HPP
#define OVOID_FCL_PRINT_HPP

#include <fcl/fcl.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

/** @cond */
#if defined(__GNUC__)
#define OVOID_FCL_INLINE __attribute__((always_inline)) inline
#define OVOID_FCL_APART __attribute__((noinline))
#else
#define OVOID_FCL_INLINE inline
#define OVOID_FCL_APART
#endif
/** @endcond */

namespace ovoid {
namespace fcl {
namespace detail {

template <class S> using geometry = ::fcl::CollisionGeometry<S>;

/// A double by its bits.
inline std::uint64_t get_word(double value) {
    std::uint64_t word;
    std::memcpy(&word, &value, sizeof word);
    return word;
}

/// The words of a print, one after another: doubles by their bits, arrays by their addresses.
template <class Self> class print_words {
  public:
    void add(double value) { add(get_word(value)); }
    void add(const void *address) { add(static_cast<std::uint64_t>(reinterpret_cast<std::uintptr_t>(address))); }
    void add(std::uint64_t word) { static_cast<Self *>(this)->take(word); }
};

/// What a translation was made from.
struct print : print_words<print> {
    std::uint32_t type = 0, count = 0;
    std::array<std::uint64_t, 10> words{};
    std::vector<double> points; ///< x, y and z of each

    void set_type(std::uint32_t to) { type = to; }
    void take(std::uint64_t word) { words[count++] = word; }
    template <class S> void add_points(const ::fcl::Vector3<S> *at, std::size_t size, std::size_t step) {
        for (std::size_t i = 0; i < size; i += step)
            for (int k = 0; k < 3; k++) points.push_back(static_cast<double>(at[i][k]));
    }
};

/// Compares a print with the words of a geometry as they come, so that none are written. A type has always as many
/// words.
class print_comparison : public print_words<print_comparison> {
  public:
    explicit print_comparison(const print &of) : of_(of) {}
    void set_type(std::uint32_t type) { difference_ = type ^ of_.type; }
    void take(std::uint64_t word) { difference_ |= of_.words[at_++] ^ word; }
    /// Points that are one after another in memory are compared there.
    template <class S> void add_points(const ::fcl::Vector3<S> *at, std::size_t size, std::size_t step) {
        static_assert(sizeof(::fcl::Vector3<S>) == 3 * sizeof(S), "a vector is its three numbers");
        const double *point = of_.points.data();
        if (of_.points.size() != 3 * ((size + step - 1) / step)) {
            difference_ = 1;
        } else if (std::is_same<S, double>::value && step == 1) {
            difference_ |= size > 0 && std::memcmp(point, at, size * sizeof *at) != 0;
        } else {
            for (std::size_t i = 0; i < size; i += step)
                for (int k = 0; k < 3; k++) difference_ |= get_word(*point++) ^ get_word(static_cast<double>(at[i][k]));
        }
    }
    bool is_same() const { return difference_ == 0; }

  private:
    const print &of_;
    std::size_t at_ = 0;
    std::uint64_t difference_ = 0;
};

/// A word that depends on every bit of a sequence of numbers and on their order. The products do not wait for each
/// other.
class mixer {
  public:
    void add(double value) {
        const std::uint64_t word = get_word(value);
        sum_ += (word ^ word >> 31) * factor_;
        factor_ += 2 * 0x9e3779b97f4a7c15u;
    }
    template <class M> void add_all(const M &values) {
        for (int i = 0; i < static_cast<int>(values.size()); i++) add(static_cast<double>(values.data()[i]));
    }
    std::uint64_t get() const { return sum_; }

  private:
    std::uint64_t sum_ = 0, factor_ = 0x9e3779b97f4a7c15u; // odd at all times
};

template <class S> void mix_volume(mixer &m, const ::fcl::AABB<S> &v) { m.add_all(v.min_), m.add_all(v.max_); }
template <class S> void mix_volume(mixer &m, const ::fcl::OBB<S> &v) {
    m.add_all(v.axis), m.add_all(v.To), m.add_all(v.extent);
}
template <class S> void mix_volume(mixer &m, const ::fcl::RSS<S> &v) {
    m.add_all(v.axis), m.add_all(v.To), m.add(v.l[0]), m.add(v.l[1]), m.add(v.r);
}
template <class S> void mix_volume(mixer &m, const ::fcl::OBBRSS<S> &v) { mix_volume(m, v.obb); }
template <class S> void mix_volume(mixer &m, const ::fcl::kIOS<S> &v) { mix_volume(m, v.obb); }
template <class S, std::size_t N> void mix_volume(mixer &m, const ::fcl::KDOP<S, N> &v) {
    for (std::size_t i = 0; i < N; i++) m.add(v.dist(i));
}

/// The vertices and triangles of a BVHModel, whatever its volumes are.
template <class S> struct mesh_view {
    const ::fcl::Vector3<S> *vertices;
    const ::fcl::Triangle *triangles;
    int vertex_count, triangle_count;
    std::uint64_t volume; ///< the mixed numbers of the tree's root
};

template <class BV> bool view_as(const geometry<typename BV::S> *g, mesh_view<typename BV::S> &view) {
    const auto *model = static_cast<const ::fcl::BVHModel<BV> *>(g);
    if (model->getModelType() != ::fcl::BVH_MODEL_TRIANGLES || model->num_tris <= 0 || model->getNumBVs() <= 0)
        return false;
    mixer m;
    mix_volume(m, model->getBV(0).bv);
    view = {model->vertices, model->tri_indices, model->num_vertices, model->num_tris, m.get()};
    return true;
}

/// Fills the view; false if the geometry is no mesh of triangles with a tree.
template <class S> bool view_mesh(const geometry<S> *g, mesh_view<S> &view) {
    switch (g->getNodeType()) {
    case ::fcl::BV_AABB: return view_as<::fcl::AABB<S>>(g, view);
    case ::fcl::BV_OBB: return view_as<::fcl::OBB<S>>(g, view);
    case ::fcl::BV_RSS: return view_as<::fcl::RSS<S>>(g, view);
    case ::fcl::BV_kIOS: return view_as<::fcl::kIOS<S>>(g, view);
    case ::fcl::BV_OBBRSS: return view_as<::fcl::OBBRSS<S>>(g, view);
    case ::fcl::BV_KDOP16: return view_as<::fcl::KDOP<S, 16>>(g, view);
    case ::fcl::BV_KDOP18: return view_as<::fcl::KDOP<S, 18>>(g, view);
    case ::fcl::BV_KDOP24: return view_as<::fcl::KDOP<S, 24>>(g, view);
    default: return false;
    }
}

/// About how many vertices a print holds; of more it holds that many, evenly spread.
constexpr std::size_t print_vertices = 16;
inline std::size_t step_of(std::size_t count) { return count > print_vertices ? count / print_vertices : 1; }

/// All vertices mixed.
template <class S> std::uint64_t mix_vertices(const ::fcl::Vector3<S> *vertices, std::size_t count) {
    mixer m;
    for (std::size_t i = 0; i < count; i++) m.add_all(vertices[i]);
    return m.get();
}

/// The print of a mesh; false if it is none.
template <class S, class Words> bool print_mesh(const geometry<S> *g, Words &p) {
    mesh_view<S> view;
    if (!view_mesh(g, view)) return false;
    const ::fcl::NODE_TYPE type = g->getNodeType();
    const bool is_turned =
        type == ::fcl::BV_OBB || type == ::fcl::BV_RSS || type == ::fcl::BV_kIOS || type == ::fcl::BV_OBBRSS;
    p.add(static_cast<const void *>(view.vertices));
    p.add(static_cast<const void *>(view.triangles));
    p.add(static_cast<std::uint64_t>(view.vertex_count) << 32 | static_cast<std::uint64_t>(view.triangle_count));
    p.add(view.volume);
    const auto count = static_cast<std::size_t>(view.vertex_count);
    if (is_turned)
        p.template add_points<S>(view.vertices, count, step_of(count));
    else
        p.add(mix_vertices<S>(view.vertices, count));
    return true;
}

template <class S, class Words> void print_convex(const ::fcl::Convex<S> *g, Words &p) {
    const auto &vertices = g->getVertices();
    p.add(static_cast<const void *>(vertices.data()));
    p.add(static_cast<std::uint64_t>(vertices.size()));
    p.template add_points<S>(vertices.data(), vertices.size(), step_of(vertices.size()));
    for (int i = 0; i < 3; i++) p.add(static_cast<double>(g->getInteriorPoint()[i])); // the mean of all vertices
}

/// A geometry, and its type, which it is asked once for.
template <class S> struct typed {
    const geometry<S> *of;
    ::fcl::NODE_TYPE type;
};

/// The print of a geometry into p, a print or a comparison; false if it has no translation. The switch is over the
/// types that FCL names. Inline, so that the few words of a box or a sphere are compared in registers.
template <class S, class Words> OVOID_FCL_INLINE bool make_print(const typed<S> &geometry, Words &p) {
    const auto *g = geometry.of;
    const ::fcl::NODE_TYPE type = geometry.type;
    p.set_type(static_cast<std::uint32_t>(type) * 16 + sizeof(S));
    const auto add = [&p](const ::fcl::Vector3<S> &v) {
        for (int i = 0; i < 3; i++) p.add(static_cast<double>(v[i]));
    };
    const auto add_round = [&p](double radius, double length) { p.add(radius), p.add(length); };
    switch (type) {
    case ::fcl::GEOM_BOX: add(static_cast<const ::fcl::Box<S> *>(g)->side); return true;
    case ::fcl::GEOM_ELLIPSOID: add(static_cast<const ::fcl::Ellipsoid<S> *>(g)->radii); return true;
    case ::fcl::GEOM_SPHERE: p.add(static_cast<double>(static_cast<const ::fcl::Sphere<S> *>(g)->radius)); return true;
    case ::fcl::GEOM_CAPSULE: {
        const auto *s = static_cast<const ::fcl::Capsule<S> *>(g);
        add_round(s->radius, s->lz);
        return true;
    }
    case ::fcl::GEOM_CYLINDER: {
        const auto *s = static_cast<const ::fcl::Cylinder<S> *>(g);
        add_round(s->radius, s->lz);
        return true;
    }
    case ::fcl::GEOM_CONE: {
        const auto *s = static_cast<const ::fcl::Cone<S> *>(g);
        add_round(s->radius, s->lz);
        return true;
    }
    case ::fcl::GEOM_TRIANGLE: {
        const auto *s = static_cast<const ::fcl::TriangleP<S> *>(g);
        add(s->a), add(s->b), add(s->c);
        return true;
    }
    case ::fcl::GEOM_CONVEX: print_convex(static_cast<const ::fcl::Convex<S> *>(g), p); return true;
    default: return print_mesh(g, p);
    }
}

/// Has the geometry this print?
template <class S> OVOID_FCL_INLINE bool has_print(const typed<S> &g, const print &p) {
    print_comparison to(p);
    return make_print(g, to) && to.is_same();
}

} // namespace detail
} // namespace fcl
} // namespace ovoid

#endif
