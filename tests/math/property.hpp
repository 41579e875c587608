// A property inside a typed test, where RapidCheck has no macro.
#pragma once

#include <utility>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace footfall::test {

/// Fails the running test, with the seed and a minimal example, unless `property` holds on random draws.
template <class Property>
void check_property(Property&& property) {
    rc::detail::checkGTest(std::forward<Property>(property));
}

}  // namespace footfall::test
