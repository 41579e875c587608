// The error of a caller who gave something that cannot be used.
#pragma once

#include <stdexcept>

namespace footfall {

/// A value that a user gave and that cannot be used; the message names it and says what is allowed.
class InvalidInput : public std::invalid_argument {
public:
    using std::invalid_argument::invalid_argument;
};

}  // namespace footfall
