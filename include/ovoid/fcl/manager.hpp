/**
 * @file manager.hpp
 * A broad-phase manager with the interface of FCL's, for <ovoid/fcl.hpp>. A tree of boxes is built over all objects by
 * halving them along the longest axis of their centres, down to blocks of sixteen; objects that are registered after
 * that are kept in a list beside it until they are a sixteenth of all, or until the next setup() or update(). An update
 * refits the tree, and builds it anew where its boxes have grown by a fifth.
 */
#ifndef OVOID_FCL_MANAGER_HPP
#define OVOID_FCL_MANAGER_HPP

#include "ovoid/fcl/blocks.hpp"
#include "ovoid/fcl/pairs.hpp"
#include "ovoid/fcl/pose.hpp"

#include <fcl/fcl.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <unordered_map>
#include <vector>

namespace ovoid {
namespace fcl {

/**
 * FCL's manager of objects, in the place of fcl::DynamicAABBTreeCollisionManager and its sisters. The objects remain
 * the caller's and must live while they are registered. Their boxes are those of the last registration or update, as in
 * FCL: after an object was moved, obj->computeAABB() and update(). A callback that returns true ends the query.
 *
 * An object is registered once, however often it is handed in; one that is not registered is not updated or
 * unregistered. Queries do not change the manager: several threads may ask one at the same time, but not change it.
 * A callback may change it: an object that it registers takes part from the next query on, and one that it unregisters
 * must live until the query ends, since pairs with it may be on their way to the callback. Octrees are objects like
 * others.
 */
template <class S> class BroadPhaseManager : public ::fcl::BroadPhaseCollisionManager<S> {
  public:
    using object = ::fcl::CollisionObject<S>;
    using base = ::fcl::BroadPhaseCollisionManager<S>;

    /** Adds objects with their present boxes and builds the tree. */
    void registerObjects(const std::vector<object *> &objects) override {
        for (object *o : objects) add(o);
        if (queries_ == 0) build();
    }
    /** Adds an object with its present box. */
    void registerObject(object *o) override {
        add(o);
        if (count_recent() > 16 + leaves_ / 16) setup();
    }
    /** Removes an object. */
    void unregisterObject(object *o) override {
        const auto found = places_.find(o);
        if (found == places_.end()) return;
        const std::size_t place = found->second;
        places_.erase(found);
        objects_[place].of = nullptr;
        set_box(place, detail::empty_box());
        if (places_.size() < objects_.size() / 2 && queries_ == 0) build();
    }
    /** Builds the tree, if objects were registered since it was built. */
    void setup() override {
        if (count_recent() > 0 && queries_ == 0) build();
    }
    /** Reads the boxes of all objects. */
    void update() override {
        const bool is_free = queries_ == 0;
        if (count_recent() > 0 && is_free) return build();
        for (std::size_t k = leaves_; k < objects_.size(); k++)
            if (objects_[k].of) recent_[k - leaves_] = box_of(objects_[k].of);
        if (leaves_ == 0) return;
        refit();
        if (is_free && !(tree_.measure() <= 1.2 * measure_)) build();
    }
    /** Reads the box of one object. */
    void update(object *o) override {
        const auto found = places_.find(o);
        if (found != places_.end()) set_box(found->second, box_of(o));
        setup();
    }
    /** Reads the boxes of some objects. */
    void update(const std::vector<object *> &objects) override {
        if (objects.size() > objects_.size() / 8) return update();
        for (object *o : objects) update(o);
    }
    /** Removes all objects. */
    void clear() override {
        places_.clear();
        for (auto &o : objects_) o.of = nullptr;
        if (queries_ == 0) build();
    }
    /** Writes the objects in the place of what the vector holds. */
    void getObjects(std::vector<object *> &objects) const override {
        objects.clear();
        for (const auto &o : objects_)
            if (o.of) objects.push_back(o.of);
    }
    bool empty() const override { return places_.empty(); }
    std::size_t size() const override { return places_.size(); }

    /** Calls back with each object whose box meets that of `o`, and `o`. */
    void collide(object *o, void *data, ::fcl::CollisionCallBack<S> callback) const override {
        const asked query(queries_);
        const ovoid_box box = box_of(o);
        const auto take = [&](std::size_t i) { return objects_[i].of && callback(objects_[i].of, o, data); };
        find_overlaps(box, objects_.size(), take);
    }
    /** Calls back with the objects whose boxes are nearer to that of `o` than the least distance so far, and `o`. */
    void distance(object *o, void *data, ::fcl::DistanceCallBack<S> callback) const override {
        const asked query(queries_);
        nearest found(callback, data);
        find_near(o, found);
    }
    /** Calls back with each two objects whose boxes meet, in an order that helps the callback. */
    void collide(void *data, ::fcl::CollisionCallBack<S> callback) const override {
        const asked query(queries_);
        const std::size_t end = objects_.size();
        pair_queue queue(callback, data, objects_, objects_);
        const auto take = [&](std::size_t i, std::size_t j) { return queue.push(i, j); };
        if (tree_.find_own(take)) return;
        for (std::size_t k = leaves_; k < end; k++)
            if (objects_[k].of && find_overlaps(box_at(k), k, [&](std::size_t i) { return take(i, k); })) return;
        queue.flush();
    }
    /** Calls back with two objects while their boxes are nearer than the least distance so far. */
    void distance(void *data, ::fcl::DistanceCallBack<S> callback) const override {
        const asked query(queries_);
        const std::size_t end = objects_.size();
        nearest found(callback, data);
        if (find_own(found)) return;
        for (std::size_t k = leaves_; k < end; k++)
            if (objects_[k].of && find_near(box_at(k), k, found, objects_[k].of)) return;
    }
    /**
     * Calls back with each object of this manager and each of the other whose boxes meet. The other one may be any
     * manager of FCL: then its objects are asked one by one, by their present boxes. FCL's managers cannot be asked
     * with one of this class, as they take it for one of their own.
     */
    void collide(base *other, void *data, ::fcl::CollisionCallBack<S> callback) const override {
        if (other == this) return collide(data, callback);
        const auto *ours = dynamic_cast<const BroadPhaseManager *>(other);
        if (!ours) return collide_objects(objects_of(*other), data, callback);
        const asked query(queries_), other_query(ours->queries_);
        const std::size_t end = objects_.size(), other_end = ours->objects_.size();
        pair_queue queue(callback, data, objects_, ours->objects_);
        const auto take = [&](std::size_t i, std::size_t j) { return queue.push(i, j); };
        if (tree_.find_both(ours->tree_, take)) return;
        for (std::size_t k = ours->leaves_; k < other_end; k++)
            if (find_overlaps(ours->box_at(k), end, [&](std::size_t i) { return take(i, k); })) return;
        for (std::size_t k = leaves_; k < end; k++)
            if (ours->find_overlaps(box_at(k), ours->leaves_, [&](std::size_t j) { return take(k, j); })) return;
        queue.flush();
    }
    /** Calls back with an object of each manager while their boxes are nearer than the least distance so far. */
    void distance(base *other, void *data, ::fcl::DistanceCallBack<S> callback) const override {
        if (other == this) return distance(data, callback);
        const asked query(queries_);
        nearest found(callback, data);
        for (object *o : objects_of(*other))
            if (find_near(o, found)) return;
    }

  private:
    /// The callback of a distance query, and the least distance so far.
    class nearest {
      public:
        nearest(::fcl::DistanceCallBack<S> callback, void *data) : callback_(callback), data_(data) {}
        /// True if the query is over: the callback says so, or no two boxes can be nearer.
        bool take(object *x, object *y) {
            if (!x || !y) return false;
            if (callback_(x, y, data_, least_)) return true;
            const double least = static_cast<double>(least_);
            bound2_ = least > 0 ? least * least : 0;
            return bound2_ == 0;
        }
        const double &bound2() const { return bound2_; }

      private:
        ::fcl::DistanceCallBack<S> callback_;
        void *data_;
        S least_ = std::numeric_limits<S>::max();
        double bound2_ = std::numeric_limits<double>::infinity();
    };

    using pair_queue = detail::pair_queue<S>;

    /// A query that is being answered: while there is one the tree is not built anew under it.
    class asked {
      public:
        explicit asked(std::atomic<int> &queries) : queries_(queries) { ++queries_; }
        ~asked() { --queries_; }
        asked(const asked &) = delete;
        asked &operator=(const asked &) = delete;

      private:
        std::atomic<int> &queries_;
    };

    /// Calls back with each object of this manager and each of others, by their present boxes.
    void collide_objects(const std::vector<object *> &others, void *data, ::fcl::CollisionCallBack<S> callback) const {
        const asked query(queries_);
        detail::registered_objects<S> there;
        for (object *o : others) there.emplace_back(o);
        pair_queue queue(callback, data, objects_, there);
        for (std::size_t k = 0; k < there.size(); k++)
            if (find_overlaps(there[k].get_box(), objects_.size(), [&](std::size_t i) { return queue.push(i, k); }))
                return;
        queue.flush();
    }

    static ovoid_box box_of(const object *o) {
        const auto &box = o->getAABB();
        return {detail::to_vec3<S>(box.min_), detail::to_vec3<S>(box.max_)};
    }
    static std::vector<object *> objects_of(const base &manager) {
        std::vector<object *> objects;
        manager.getObjects(objects);
        return objects;
    }

    std::size_t count_recent() const { return objects_.size() - leaves_; }
    ovoid_box box_at(std::size_t recent) const { return recent_[recent - leaves_]; }

    void add(object *o) {
        const auto found = places_.emplace(o, objects_.size());
        if (!found.second) return set_box(found.first->second, box_of(o));
        objects_.emplace_back(o);
        recent_.push_back(box_of(o));
    }
    /// Sets the box of an object, and those of the tree that hold it.
    void set_box(std::size_t place, const ovoid_box &box) {
        if (place >= leaves_)
            recent_[place - leaves_] = box;
        else
            tree_.set(place, box);
    }
    void refit() {
        tree_.fill(leaves_, [this](std::size_t i) {
            objects_[std::min(i + 16, leaves_ - 1)].fetch_box();
            return objects_[i].of ? objects_[i].get_box() : detail::empty_box();
        });
    }

    /// An object and the doubled centre of its box, for the build.
    struct item {
        detail::registered<S> of;
        double centre[3];
    };
    /// Builds the tree over all objects that are registered.
    void build() {
        std::vector<item> items;
        items.reserve(places_.size());
        for (const auto &o : objects_)
            if (o.of && places_.count(o.of) > 0) items.push_back(make_item(o));
        if (!items.empty()) split(items.data(), items.data() + items.size());
        leaves_ = items.size();
        objects_.clear();
        recent_.clear();
        for (const item &x : items) {
            places_[x.of.of] = objects_.size();
            objects_.push_back(x.of);
        }
        refit();
        measure_ = tree_.measure();
    }
    static item make_item(const detail::registered<S> &o) {
        const ovoid_box box = o.get_box();
        item made{o, {box.min.x + box.max.x, box.min.y + box.max.y, box.min.z + box.max.z}};
        for (double &c : made.centre)
            if (!std::isfinite(c)) c = 0; // no order is known of NaN
        return made;
    }
    /// Puts the items into the order of the tree's leaves: the halves of a range are those of its blocks.
    static void split(item *first, item *end) {
        const auto size = static_cast<std::ptrdiff_t>(detail::block_size);
        const auto half = (end - first + size - 1) / size / 2 * size;
        if (half == 0) return;
        int axis = 0;
        double longest = -1;
        for (int k = 0; k < 3; k++) {
            const auto ends = std::minmax_element(
                first, end, [k](const item &x, const item &y) { return x.centre[k] < y.centre[k]; });
            const double length = ends.second->centre[k] - ends.first->centre[k];
            if (length > longest) longest = length, axis = k;
        }
        std::nth_element(first, first + half, end,
                         [axis](const item &x, const item &y) { return x.centre[axis] < y.centre[axis]; });
        split(first, first + half);
        split(first + half, end);
    }

    /// Takes the places below `end` whose boxes meet a box, until `take` returns true: then it returns true.
    template <class Take> bool find_overlaps(const ovoid_box &box, std::size_t end, const Take &take) const {
        if (tree_.find(box, take)) return true;
        for (std::size_t k = leaves_; k < end; k++)
            if (detail::overlap_test()(box_at(k), box) && take(k)) return true;
        return false;
    }
    bool find_near(object *o, nearest &found) const { return find_near(box_of(o), objects_.size(), found, o); }
    /// Asks for the places below `end` and an object with this box.
    bool find_near(const ovoid_box &box, std::size_t end, nearest &found, object *o) const {
        const auto take = [&](std::size_t i) { return found.take(objects_[i].of, o); };
        if (tree_.find_near(box, found.bound2(), take)) return true;
        for (std::size_t k = leaves_; k < end; k++)
            if (detail::compute_gap2(box_at(k), box) < found.bound2() && take(k)) return true;
        return false;
    }
    /// Asks for the pairs of the tree. Those with the nearest boxes come first, as the distance of one of them ends
    /// most of the search.
    bool find_own(nearest &found) const {
        double least2 = std::numeric_limits<double>::infinity();
        std::size_t first = 0, second = 0;
        const auto seek = [&](std::size_t i, std::size_t j) {
            least2 = detail::compute_gap2(tree_.box(i), tree_.box(j)), first = i, second = j;
            return least2 == 0;
        };
        tree_.find_own_near(least2, seek);
        if (first != second && found.take(objects_[first].of, objects_[second].of)) return true;
        const auto take = [&](std::size_t i, std::size_t j) {
            return (i != first || j != second) && found.take(objects_[i].of, objects_[j].of);
        };
        return tree_.find_own_near(found.bound2(), take);
    }

    detail::registered_objects<S> objects_; ///< of the tree's leaves, then those registered since
    detail::block_tree tree_;               ///< of the boxes of the first objects
    std::vector<ovoid_box> recent_;         ///< of the objects that are not in the tree
    std::unordered_map<object *, std::size_t> places_;
    std::size_t leaves_ = 0; ///< of the tree
    double measure_ = 0;     ///< of the tree, when it was built
    mutable std::atomic<int> queries_{0};
};

} // namespace fcl
} // namespace ovoid

#endif
