// Numbers of C++ as NumPy arrays that own them: moved, not copied.
#pragma once

#include <utility>
#include <vector>

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

namespace footfall::python {

namespace nb = nanobind;

/// `values` in the shape given, the last dimension fastest.
template <class Value>
nb::object to_numpy(std::vector<Value>&& values, const std::vector<std::size_t>& shape) {
    auto* kept = new std::vector<Value>(std::move(values));
    const nb::capsule owner(kept, [](void* data) noexcept { delete static_cast<std::vector<Value>*>(data); });
    return nb::cast(nb::ndarray<nb::numpy, Value>(kept->data(), shape.size(), shape.data(), owner));
}

}  // namespace footfall::python
