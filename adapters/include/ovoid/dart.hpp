/**
 * @file dart.hpp
 * A collision detector for DART (6.12) that asks ovoid: collide with contacts, distance, raycast. Header only.
 * Including it registers the detector by the name "ovoid", so a world file may name it; in a program:
 *
 *     world->getConstraintSolver()->setCollisionDetector(ovoid::dartsim::detector::create());
 *
 * Boxes, spheres, capsules, cylinders, cones, pyramids and convex hulls of spheres with equal radii are what they say,
 * cylinders and cones to an allowance of a two-hundredth of their radius. An ellipsoid is a polyhedron in it, with an
 * allowance of 0.2 % of its largest radius. A plane is the half space below it. A mesh that is convex is a solid; any
 * other is answered by its flat facets, and triangle by triangle where bodies are deep in one another, for distances
 * and for two meshes. Shapes of other kinds (soft meshes, height maps, point clouds, voxel grids, line segments,
 * arrows) are refused: ovoid::error is thrown when they are added to a group.
 *
 * Threads: as DART's own detectors, one for each thread.
 */
#ifndef OVOID_DART_HPP
#define OVOID_DART_HPP

#include "ovoid/dart_shapes.hpp"

#include <dart/collision/CollisionDetector.hpp>
#include <dart/collision/CollisionFilter.hpp>
#include <dart/collision/CollisionGroup.hpp>
#include <dart/collision/CollisionObject.hpp>
#include <dart/collision/DistanceFilter.hpp>

#include <functional>
#include <limits>
#include <numeric>

namespace ovoid {
namespace dartsim {

class detector;

/** Settings of a detector. */
using settings = adapters::contact_settings;

namespace detail {

namespace engine = ::dart::collision;

/// A shape frame as ovoid's parts, and where they are.
class object final : public engine::CollisionObject {
  public:
    object(engine::CollisionDetector *of, const ::dart::dynamics::ShapeFrame *frame, std::uint64_t id)
        : CollisionObject(of, frame), id_(id) {}
    void updateEngineData() override {
        pose_ = from_dart(getTransform());
        box_ = compute_box(geometry_, pose_);
    }
    void set(geometry made) {
        geometry_ = std::move(made);
        version_++;
        shape_id_ = getShape()->getID();
        shape_version_ = getShape()->getVersion();
    }
    /// Whether the frame has another shape than the one that was translated, or that one was changed.
    bool is_changed() const { return getShape()->getID() != shape_id_ || getShape()->getVersion() != shape_version_; }
    const geometry &shape() const { return geometry_; }
    const ovoid_pose &pose() const { return pose_; }
    const ovoid_box &box() const { return box_; }
    /// What tells it from every other object, and from itself before its shape changed.
    std::uint64_t id() const { return id_ << 20 | (version_ & 0xfffff); }

  private:
    geometry geometry_;
    ovoid_pose pose_ = {};
    ovoid_box box_ = {};
    std::uint64_t id_, version_ = 0;
    std::size_t shape_id_ = 0, shape_version_ = 0;
};

/// The objects of a group, in the order in which they came.
class group final : public engine::CollisionGroup {
  public:
    explicit group(const engine::CollisionDetectorPtr &of) : CollisionGroup(of) {}
    const std::vector<object *> &objects() const { return objects_; }
    /// The objects at their present poses.
    const std::vector<object *> &read() {
        updateEngineData();
        return objects_;
    }

  protected:
    void initializeEngineData() override {}
    void addCollisionObjectToEngine(engine::CollisionObject *added) override {
        auto *ours = static_cast<object *>(added);
        if (std::find(objects_.begin(), objects_.end(), ours) == objects_.end()) objects_.push_back(ours);
    }
    void addCollisionObjectsToEngine(const std::vector<engine::CollisionObject *> &added) override {
        for (engine::CollisionObject *one : added) addCollisionObjectToEngine(one);
    }
    void removeCollisionObjectFromEngine(engine::CollisionObject *removed) override {
        objects_.erase(std::remove(objects_.begin(), objects_.end(), removed), objects_.end());
    }
    void removeAllCollisionObjectsFromEngine() override { objects_.clear(); }
    void updateCollisionGroupEngineData() override {}

  private:
    std::vector<object *> objects_;
};

using couple = std::pair<object *, object *>;

/// Pairs whose boxes meet, in the order of the objects: by a sweep along x. second: NULL, pairs within the first.
inline std::vector<couple> find_couples(const std::vector<object *> &first, const std::vector<object *> *second) {
    struct entry {
        object *of;
        std::size_t number;
        bool is_second;
    };
    std::vector<entry> all;
    for (std::size_t i = 0; i < first.size(); i++) all.push_back({first[i], i, false});
    for (std::size_t i = 0; second && i < second->size(); i++) all.push_back({(*second)[i], i, true});
    std::stable_sort(all.begin(), all.end(),
                     [](const entry &a, const entry &b) { return a.of->box().min.x < b.of->box().min.x; });
    std::vector<std::pair<std::size_t, std::size_t>> numbers;
    for (std::size_t i = 0; i < all.size(); i++)
        for (std::size_t k = i + 1; k < all.size() && all[k].of->box().min.x <= all[i].of->box().max.x; k++) {
            if ((second && all[i].is_second == all[k].is_second) || !do_boxes_meet(all[i].of->box(), all[k].of->box()))
                continue;
            const bool in_order = second ? all[k].is_second : all[i].number < all[k].number;
            numbers.emplace_back(all[in_order ? i : k].number, all[in_order ? k : i].number);
        }
    std::sort(numbers.begin(), numbers.end());
    std::vector<couple> found;
    for (const auto &[a, b] : numbers) found.emplace_back(first[a], second ? (*second)[b] : first[b]);
    return found;
}

/// The key of two parts: their objects and their numbers.
struct part_key {
    std::uint64_t a, b, parts;
    bool operator==(const part_key &other) const { return a == other.a && b == other.b && parts == other.parts; }
};
struct part_key_hash {
    std::size_t operator()(const part_key &of) const noexcept {
        return std::size_t((of.a * UINT64_C(0x9e3779b97f4a7c15) ^ of.b) * UINT64_C(0xff51afd7ed558ccd) ^ of.parts);
    }
};

/// The contacts of the last steps.
class memories {
  public:
    ovoid_manifold &find(const part_key &of) {
        if (contacts_.size() >= limit_) drop_old();
        auto &found = contacts_[of];
        found.second = now_;
        return found.first;
    }
    void begin_step() { now_++; }

  private:
    void drop_old() {
        for (auto i = contacts_.begin(); i != contacts_.end();)
            i = i->second.second + 1 >= now_ ? std::next(i) : contacts_.erase(i);
        limit_ = std::max<std::size_t>(1024, 4 * contacts_.size());
    }
    std::unordered_map<part_key, std::pair<ovoid_manifold, std::uint64_t>, part_key_hash> contacts_;
    std::uint64_t now_ = 0;
    std::size_t limit_ = 1024;
};

} // namespace detail

/** The detector. DART's filters, options and results are as in its own detectors. */
class detector final : public ::dart::collision::CollisionDetector {
    using collision_group = ::dart::collision::CollisionGroup;
    using collision_option = ::dart::collision::CollisionOption;
    using collision_result = ::dart::collision::CollisionResult;
    using distance_option = ::dart::collision::DistanceOption;
    using distance_result = ::dart::collision::DistanceResult;

  public:
    using CollisionDetector::createCollisionGroup;

    /** A detector. */
    static std::shared_ptr<detector> create(const settings &chosen = settings()) {
        return std::shared_ptr<detector>(new detector(chosen));
    }
    /** The name under which it is registered: "ovoid". */
    static const std::string &getStaticType() {
        static const std::string name = "ovoid";
        return name;
    }
    const std::string &getType() const override { return getStaticType(); }
    std::shared_ptr<CollisionDetector> cloneWithoutCollisionObjects() const override { return create(chosen_); }
    std::unique_ptr<collision_group> createCollisionGroup() override {
        return std::make_unique<detail::group>(shared_from_this());
    }

    /** Contacts of the group's objects with one another: up to four points for each pair of parts that overlap. */
    bool collide(collision_group *of, const collision_option &option = {false, 1u, nullptr},
                 collision_result *result = nullptr) override {
        if (!is_ours(of)) return false;
        return collide_couples(detail::find_couples(read(of), nullptr), option, result);
    }
    /** Contacts of the first group's objects with those of the second. */
    bool collide(collision_group *first, collision_group *second, const collision_option &option = {false, 1u, nullptr},
                 collision_result *result = nullptr) override {
        if (!is_ours(first) || !is_ours(second)) return false;
        const std::vector<detail::object *> &a = read(first), &b = read(second);
        return collide_couples(detail::find_couples(a, &b), option, result);
    }
    /**
     * The least signed distance of two objects of the group, at most the true one and within 1e-9 of the size of it;
     * the penetration depth, negative, if option.distanceLowerBound lets it be asked.
     */
    double distance(collision_group *of, const distance_option &option = {false, 0.0, nullptr},
                    distance_result *result = nullptr) override {
        if (!is_ours(of)) return 0;
        std::vector<detail::couple> couples;
        const std::vector<detail::object *> &all = read(of);
        for (std::size_t i = 0; i < all.size(); i++)
            for (std::size_t k = i + 1; k < all.size(); k++) couples.emplace_back(all[i], all[k]);
        return find_nearest(couples, option, result);
    }
    /** The least signed distance of an object of the first group and one of the second. */
    double distance(collision_group *first, collision_group *second,
                    const distance_option &option = {false, 0.0, nullptr}, distance_result *result = nullptr) override {
        if (!is_ours(first) || !is_ours(second)) return 0;
        std::vector<detail::couple> couples;
        const std::vector<detail::object *> &b = read(second);
        for (detail::object *a : read(first))
            for (detail::object *other : b) couples.emplace_back(a, other);
        return find_nearest(couples, option, result);
    }
    /** The hits of a ray: the first one, or the first of each object. */
    bool raycast(collision_group *of, const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                 const ::dart::collision::RaycastOption &option = {},
                 ::dart::collision::RaycastResult *result = nullptr) override;

    /** Number of shapes that are kept. */
    std::size_t shape_count() const { return table_.size(); }
    /** Number of queries that were refused, because a body's transform was not finite. They have no contact. */
    std::size_t refused_count() const noexcept { return refused_; }

  protected:
    std::unique_ptr<::dart::collision::CollisionObject>
    createCollisionObject(const ::dart::dynamics::ShapeFrame *frame) override {
        auto made = std::make_unique<detail::object>(this, frame, ++objects_);
        made->set(detail::translate(table_, *frame->getShape()));
        return made;
    }
    void refreshCollisionObject(::dart::collision::CollisionObject *changed) override {
        static_cast<detail::object *>(changed)->set(detail::translate(table_, *changed->getShape()));
    }

  private:
    struct found {
        double distance;
        detail::couple objects;
        ovoid_vec3 a, b;
    };
    explicit detector(const settings &chosen) : chosen_(chosen) {
        mCollisionObjectManager.reset(new ManagerForSharableCollisionObjects(this));
    }
    bool is_ours(collision_group *of) const { return of && of->getCollisionDetector().get() == this; }
    /// The group's objects at their present poses. DART tells of changed shapes where frames do; others are looked for.
    const std::vector<detail::object *> &read(collision_group *of) {
        auto *ours = static_cast<detail::group *>(of);
        for (detail::object *one : ours->objects())
            if (one->is_changed()) refreshCollisionObject(one);
        return ours->read();
    }
    bool collide_couples(const std::vector<detail::couple> &couples, const collision_option &option,
                         collision_result *result);
    /// The contacts of two objects; false: none. Stops when `most` are in the result.
    bool collide_parts(const detail::couple &of, const collision_option &option, collision_result *result);
    /// Those of a mesh and convex parts.
    bool collide_mesh(const detail::couple &of, const collision_option &option, collision_result *result);
    bool add(const detail::couple &of, const detail::manifold &contact, const collision_option &option,
             collision_result *result) const;
    detail::manifold find_manifold(const detail::couple &of, std::size_t a, std::size_t b);
    double find_nearest(const std::vector<detail::couple> &couples, const distance_option &option,
                        distance_result *result) const;
    static void measure(const detail::couple &of, found &least);

    settings chosen_;
    adapters::shape_table table_;
    detail::memories memories_;
    std::uint64_t objects_ = 0;
    std::size_t refused_ = 0;
};

inline bool detector::collide_couples(const std::vector<detail::couple> &couples, const collision_option &option,
                                      collision_result *result) {
    if (result) result->clear();
    if (option.maxNumContacts == 0) return false;
    memories_.begin_step();
    bool any = false;
    for (const detail::couple &one : couples) {
        if (option.collisionFilter && option.collisionFilter->ignoresCollision(one.first, one.second)) continue;
        any = collide_parts(one, option, result) || any;
        if (result ? result->getNumContacts() >= option.maxNumContacts : any) return any;
    }
    return any;
}

inline bool detector::collide_parts(const detail::couple &of, const collision_option &option,
                                    collision_result *result) {
    const detail::geometry &a = of.first->shape(), &b = of.second->shape();
    bool any = false;
    if (a.plane || b.plane) {
        if (a.plane && b.plane) return false; // two half spaces: nothing that a body could do about it
        const detail::object &solid = a.plane ? *of.second : *of.first, &flat = a.plane ? *of.first : *of.second;
        for (const detail::part &one : solid.shape().parts) {
            const detail::manifold contact = detail::meet_plane(one, solid.pose(), *flat.shape().plane, flat.pose());
            any = add(of, a.plane ? contact.flipped() : contact, option, result) || any;
        }
        return any;
    }
    if (!a.mesh != !b.mesh && collide_mesh(of, option, result)) return true;
    // Each part's box in the world, and those of the other that it meets.
    for (std::size_t i = 0; i < a.parts.size(); i++) {
        const ovoid_box box = a.parts.size() == 1 ? of.first->box() : detail::compute_box(a.parts[i], of.first->pose());
        if (!detail::do_boxes_meet(box, of.second->box())) continue;
        for (std::size_t k = 0; k < b.parts.size(); k++) {
            if (b.parts.size() > 1 && !detail::do_boxes_meet(box, detail::compute_box(b.parts[k], of.second->pose())))
                continue;
            any = add(of, find_manifold(of, i, k), option, result) || any;
            if (result ? result->getNumContacts() >= option.maxNumContacts : any) return any;
        }
    }
    return any;
}

/// The contacts of the flat facets of a mesh and the parts of a body; false: there is none. Bodies that are too deep in
/// one another for a facet to lead out have none here, and are asked triangle by triangle.
inline bool detector::collide_mesh(const detail::couple &of, const collision_option &option, collision_result *result) {
    const bool is_first = of.first->shape().mesh != nullptr;
    const detail::object &mesh = is_first ? *of.first : *of.second, &convex = is_first ? *of.second : *of.first;
    bool any = false;
    for (const detail::part &one : convex.shape().parts) {
        if (!detail::do_boxes_meet(detail::compute_box(one, convex.pose()), mesh.box())) continue;
        const ovoid_body_pair pair = {{one.made->made.get(), nullptr, convex.pose(), nullptr},
                                      {nullptr, nullptr, mesh.pose(), mesh.shape().mesh->get()}};
        ovoid_manifold_options options = {};
        options.tolerance = chosen_.tolerance * one.made->radius;
        body_manifolds all;
        if (all.find(pair, options) != OVOID_LIMIT_NONE) refused_++;
        for (const ovoid_body_manifold &facet : all) {
            const detail::manifold contact = {facet.manifold.normal, all.points_of(facet)};
            any = add(of, is_first ? contact.flipped() : contact, option, result) || any;
            if (result ? result->getNumContacts() >= option.maxNumContacts : any) return any;
        }
    }
    return any;
}

inline detail::manifold detector::find_manifold(const detail::couple &of, std::size_t a, std::size_t b) {
    const detail::part &x = of.first->shape().parts[a], &y = of.second->shape().parts[b];
    const adapters::contact_query query = {x.made.get(), y.made.get(), of.first->pose(), of.second->pose(), 0};
    if (query.is_far()) return {};
    ovoid_manifold &kept = memories_.find({of.first->id(), of.second->id(), std::uint64_t(a) << 32 | b});
    const ovoid_manifold_points points = adapters::find_contact(query, chosen_, kept);
    if (adapters::is_refused(kept)) refused_++;
    return {kept.normal, points};
}

inline bool detector::add(const detail::couple &of, const detail::manifold &contact, const collision_option &option,
                          collision_result *result) const {
    bool any = false;
    for (std::uint32_t i = 0; i < contact.points.count; i++) {
        const ovoid_manifold_point &p = contact.points.points[i];
        if (p.separation > 0) continue;
        any = true;
        if (!result || result->getNumContacts() >= option.maxNumContacts) return true;
        ::dart::collision::Contact made;
        made.collisionObject1 = of.first;
        made.collisionObject2 = of.second;
        if (option.enableContact) {
            // DART's normal is from the second to the first.
            made.normal = -detail::to_dart(contact.normal);
            made.point = 0.5 * (detail::to_dart(p.point_a) + detail::to_dart(p.point_b));
            made.penetrationDepth = -p.separation;
        }
        result->addContact(made);
        if (!option.enableContact) return true;
    }
    return any;
}

inline double detector::find_nearest(const std::vector<detail::couple> &couples, const distance_option &option,
                                     distance_result *result) const {
    if (result) result->clear();
    found least = {std::numeric_limits<double>::infinity(), {nullptr, nullptr}, {}, {}};
    for (const detail::couple &one : couples) {
        if (option.distanceFilter && !option.distanceFilter->needDistance(one.first, one.second)) continue;
        measure(one, least);
        if (least.distance <= option.distanceLowerBound) break;
    }
    if (!least.objects.first) return 0;
    const double clamped = std::max(least.distance, option.distanceLowerBound);
    if (result) {
        result->minDistance = clamped;
        result->unclampedMinDistance = least.distance;
        result->shapeFrame1 = least.objects.first->getShapeFrame();
        result->shapeFrame2 = least.objects.second->getShapeFrame();
        if (option.enableNearestPoints) {
            result->nearestPoint1 = detail::to_dart(least.a);
            result->nearestPoint2 = detail::to_dart(least.b);
        }
    }
    return clamped;
}

inline void detector::measure(const detail::couple &of, found &least) {
    const detail::geometry &a = of.first->shape(), &b = of.second->shape();
    if (a.plane && b.plane) return;
    if (a.plane || b.plane) {
        const detail::object &solid = a.plane ? *of.second : *of.first, &flat = a.plane ? *of.first : *of.second;
        for (const detail::part &one : solid.shape().parts) {
            const detail::nearest near = detail::measure_plane(one, solid.pose(), *flat.shape().plane, flat.pose());
            if (near.distance < least.distance)
                least = {near.distance, of, a.plane ? near.on_plane : near.on_part,
                         a.plane ? near.on_part : near.on_plane};
        }
        return;
    }
    for (const detail::part &x : a.parts)
        for (const detail::part &y : b.parts) {
            const ovoid_pair pair = {x.made->made.get(), y.made->made.get(), of.first->pose(), of.second->pose()};
            ovoid_options options = {};
            if (least.distance > 0 && std::isfinite(least.distance)) options.cap = least.distance;
            const ovoid_answer answer = ovoid_depth(&pair, &options, nullptr, nullptr);
            if (answer.limit == OVOID_LIMIT_CAP || !(answer.lower < least.distance)) continue;
            least = {answer.lower, of, answer.point_a, answer.point_b};
        }
}

inline bool detector::raycast(collision_group *of, const Eigen::Vector3d &from, const Eigen::Vector3d &to,
                              const ::dart::collision::RaycastOption &option,
                              ::dart::collision::RaycastResult *result) {
    if (result) result->clear();
    if (!is_ours(of)) return false;
    std::vector<::dart::collision::RayHit> hits;
    for (const detail::object *one : read(of)) {
        detail::ray_hit hit = detail::cast_ray(one->shape(), one->pose(), from, to);
        if (!hit.is_hit) continue;
        hits.emplace_back();
        hits.back().mCollisionObject = one;
        hits.back().mFraction = hit.fraction;
        hits.back().mPoint = from + hit.fraction * (to - from);
        hits.back().mNormal = hit.normal;
    }
    const auto nearer = [](const auto &a, const auto &b) { return a.mFraction < b.mFraction; };
    if (!option.mEnableAllHits && !hits.empty()) {
        std::iter_swap(hits.begin(), std::min_element(hits.begin(), hits.end(), nearer));
        hits.resize(1);
    }
    if (option.mSortByClosest) std::stable_sort(hits.begin(), hits.end(), nearer);
    const bool any = !hits.empty();
    if (result) result->mRayHits = std::move(hits);
    return any;
}

namespace detail {

/// Enters the detector into DART's factory when the program starts.
inline const ::dart::collision::CollisionDetector::Registrar<detector> registrar{
    detector::getStaticType(),
    [] { return std::static_pointer_cast<::dart::collision::CollisionDetector>(detector::create()); }};

} // namespace detail

} // namespace dartsim
} // namespace ovoid

#endif
