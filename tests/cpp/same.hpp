// The tests' comparison of C++ answers with those of C, and the test of what a call throws.
#ifndef OVOID_TESTS_SAME_HPP
#define OVOID_TESTS_SAME_HPP

#include <ovoid/ovoid.hpp>

#include "check.h"

#include <cstddef>
#include <cstring>
#include <type_traits>

/// The same bytes; T has no padding that the compiler may fill as it likes, or is compared up to it.
template <class T> bool is_same(const T &a, const T &b) {
    static_assert(std::is_trivially_copyable<T>::value, "bytes are compared");
    return std::memcmp(&a, &b, sizeof a) == 0;
}
template <class T> bool is_same_count(const T *a, const T *b, std::size_t count) {
    return std::memcmp(a, b, count * sizeof *a) == 0;
}
/// Answers, and of their proofs what counts.
inline bool is_same_answer(const ovoid_answer &a, const ovoid_answer &b) {
    const ovoid_proof &p = a.proof, &q = b.proof;
    return std::memcmp(&a, &b, offsetof(ovoid_answer, proof)) == 0 && is_same(p.normal, q.normal) && p.kind == q.kind &&
           p.count == q.count && is_same_count(p.a, q.a, p.count) && is_same_count(p.b, q.b, p.count) &&
           is_same_count(p.weight_a, q.weight_a, p.count) && is_same_count(p.weight_b, q.weight_b, p.count);
}
inline bool is_same_shape(ovoid::shape_view a, const ovoid_shape *b) {
    return a.write() == ovoid::shape_view(b).write();
}

inline bool is_vec3(const ovoid_vec3 &v, double x, double y, double z) { return v.x == x && v.y == y && v.z == z; }

/// Takes the C shape over, so that it is destroyed.
inline ovoid::shape adopt(ovoid_shape *created) { return ovoid::shape(created); }

/// The call throws ovoid::error with this code and place, and a sentence that holds the word.
template <class Call> bool throws(ovoid_code code, std::int64_t place, const char *word, const Call &call) {
    try {
        call();
    } catch (const ovoid::error &e) {
        if (e.code() == code && e.place() == place && std::strstr(e.what(), word)) return true;
        std::printf("threw %s, place %lld: %s\n", ovoid::name(e.code()), static_cast<long long>(e.place()), e.what());
        return false;
    }
    std::printf("threw nothing\n");
    return false;
}

#endif
