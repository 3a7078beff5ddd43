#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>

namespace glimt {

/// A container that copies share until one of them is edited, so that copies of a scene are cheap. What has the same
/// identity() has the same elements.
template <class T>
class Shared {
 public:
  using value_type = typename T::value_type;
  using const_iterator = typename T::const_iterator;

  Shared() = default;
  Shared(T value) : value_(std::make_shared<T>(std::move(value))) {}  // NOLINT: reads as the container
  Shared(std::initializer_list<value_type> list) : Shared(T(list)) {}

  const T& get() const { return value_ ? *value_ : none(); }
  operator const T&() const { return get(); }  // NOLINT: reads as the container

  auto begin() const { return get().begin(); }
  auto end() const { return get().end(); }
  std::size_t size() const { return get().size(); }
  bool empty() const { return get().empty(); }
  const value_type& operator[](std::size_t i) const { return get()[i]; }
  const value_type& front() const { return get().front(); }
  const value_type& back() const { return get().back(); }

  /// The elements, to be changed before the next copy is made; copies made before keep theirs. It has a new identity.
  T& edit() {
    if (!value_)
      value_ = std::make_shared<T>();
    else
      value_ = value_.use_count() == 1 ? std::make_shared<T>(std::move(*value_)) : std::make_shared<T>(*value_);
    return *value_;
  }

  /// Of the elements, for caches; it lives as long as some copy does. Null where it was never given any.
  std::shared_ptr<const void> identity() const { return value_; }

  friend bool operator==(const Shared& a, const Shared& b) { return a.value_ == b.value_ || a.get() == b.get(); }

 private:
  static const T& none() {
    static const T empty;
    return empty;
  }

  std::shared_ptr<T> value_;
};

}  // namespace glimt
