/**
 * @file error.hpp
 * Used by all C++ headers: errors as exceptions, owners of handles, arrays as views, options that begin as zero.
 *
 * With -fno-exceptions everything compiles, and a function that would throw calls std::abort. To handle errors there,
 * create with the C function, read its ovoid_error, and let an owner adopt the handle, as in
 * shape(ovoid_shape_create_box(...)).
 */
#ifndef OVOID_CPP_ERROR_HPP
#define OVOID_CPP_ERROR_HPP

#include "ovoid/base.h"

#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <stdexcept>
#include <type_traits>
#include <utility>

/** The C++ interface of ovoid: the C structs, with owners, conversions and exceptions. */
namespace ovoid {

/** An error of the C library: what() is its sentence, never empty. */
class error : public std::runtime_error {
  public:
    /** From the C error. */
    explicit error(const ovoid_error &from) : std::runtime_error(from.message), code_(from.code), place_(from.place) {}
    /** What went wrong; never OVOID_OK. */
    ovoid_code code() const noexcept { return code_; }
    /** 0-based vertex, face or item, or 1-based line of a file; -1 if none applies. */
    std::int64_t place() const noexcept { return place_; }

  private:
    ovoid_code code_;
    std::int64_t place_;
};

/** The name of a code, in words, for example "not finite". */
inline const char *name(ovoid_code code) noexcept { return ovoid_code_get_name(code); }
/** The library's version as "major.minor.patch". */
inline const char *version() noexcept { return ovoid_get_version(); }
/** Sets the function that a failed assert of the library calls; nullptr removes it. The hook must not throw. */
inline void set_assert_hook(ovoid_assert_hook hook) noexcept { ovoid_set_assert_hook(hook); }

namespace detail {

[[noreturn]] inline void fail(const ovoid_error &e) {
#if defined(__cpp_exceptions) || defined(_CPPUNWIND)
    throw error(e);
#else
    (void)e;
    std::abort();
#endif
}

/// Throws an error with the sentence of the code, or with the given text.
[[noreturn]] inline void fail(ovoid_code code, const char *text = nullptr, std::int64_t place = -1) {
    ovoid_error e;
    e.code = code;
    e.place = place;
    if (!text) text = ovoid_code_get_name(code);
    std::size_t i = 0;
    for (; text[i] && i + 1 < sizeof e.message; i++) e.message[i] = text[i];
    e.message[i] = 0;
    fail(e);
}

inline void require(ovoid_code code, const ovoid_error &e) {
    if (code != OVOID_OK) fail(e);
}
template <class Handle> Handle *require(Handle *handle, const ovoid_error &e) {
    if (!handle) fail(e);
    return handle;
}

/// A pointer without an owner; const if the object that holds it is const.
template <class Handle> class pointer {
  public:
    constexpr pointer() noexcept = default;
    constexpr explicit pointer(Handle *handle) noexcept : handle_(handle) {}
    /** The C handle, borrowed; nullptr if there is none. */
    Handle *get() noexcept { return handle_; }
    /** The C handle, borrowed; nullptr if there is none. */
    const Handle *get() const noexcept { return handle_; }
    /** False if there is none: after a move, or by default. */
    explicit operator bool() const noexcept { return handle_ != nullptr; }

  private:
    Handle *handle_ = nullptr;
};

/// Owns the handle of a View: moves and never copies, destroys once. A moved-from owner is empty.
template <class View, class Handle, void (*Destroy)(Handle *)> class owner : public View {
  public:
    owner() noexcept = default;
    /** Adopts a handle that a C function created; nullptr: empty. */
    explicit owner(Handle *created) noexcept : View(created) {}
    owner(owner &&other) noexcept : View(other.release()) {}
    owner &operator=(owner &&other) noexcept {
        reset(other.release());
        return *this;
    }
    owner(const owner &) = delete;
    owner &operator=(const owner &) = delete;
    ~owner() { Destroy(const_cast<Handle *>(this->get())); }
    /** Gives up the handle: the caller destroys it. */
    Handle *release() noexcept {
        Handle *handle = const_cast<Handle *>(this->get());
        static_cast<View &>(*this) = View();
        return handle;
    }
    /** Destroys the handle and adopts another one, or none. */
    void reset(Handle *created = nullptr) noexcept {
        Handle *before = const_cast<Handle *>(this->get());
        static_cast<View &>(*this) = View(created);
        Destroy(before);
    }
};

} // namespace detail

/** A C struct that begins with every field zero, which in all options of ovoid is the default. */
template <class C> struct zeroed : C {
    /** Every field zero. */
    constexpr zeroed() noexcept : C() {}
    /** From the C struct. */
    constexpr zeroed(const C &from) noexcept : C(from) {}
};

/** A view of an array that is owned elsewhere; converts to std::span if the compiler has it. */
template <class T> class span {
  public:
    /** The type of an item. */
    using value_type = std::remove_cv_t<T>;
    constexpr span() noexcept = default;
    /** Of count items. */
    constexpr span(T *data, std::size_t size) noexcept : data_(data), size_(size) {}
    /** The first item. */
    constexpr T *data() const noexcept { return data_; }
    /** Number of items. */
    constexpr std::size_t size() const noexcept { return size_; }
    /** True if there are none. */
    constexpr bool empty() const noexcept { return size_ == 0; }
    /** For range-for. */
    constexpr T *begin() const noexcept { return data_; }
    /** Past the last item. */
    constexpr T *end() const noexcept { return data_ + size_; }
    /** Item i < size. */
    constexpr T &operator[](std::size_t i) const noexcept { return data_[i]; }

  private:
    T *data_ = nullptr;
    std::size_t size_ = 0;
};

namespace detail {

/// The items of a container as a C array of type C; its elements are C, or C with constructors and no more fields.
template <class C, class Container> span<const C> items_of(const Container &container) {
    using element = std::remove_cv_t<std::remove_pointer_t<decltype(std::data(container))>>;
    static_assert(std::is_base_of<C, element>::value || std::is_same<C, element>::value,
                  "the container must hold the C struct, or the type of <ovoid/ovoid.hpp> that derives from it");
    static_assert(sizeof(element) == sizeof(C), "an element must have no fields but those of the C struct");
    return {std::data(container), std::size(container)};
}

} // namespace detail
} // namespace ovoid

#endif
