// What a system tells its solver where a jump has happened.
#pragma once

namespace footfall {

/// How a solver goes on after a jump.
template <class Value>
struct GoesOn {
    Value step = Value(0);     ///< the size of the next step; 0: as long as it was
    Value stretch = Value(1);  ///< times this
    bool calm = false;         ///< nothing is stiff from here on
    bool done = false;         ///< the work ends here, whatever the clock shows
};

}  // namespace footfall
