// The two parts of a normal force, kept apart so that the ledger never has to guess.
#pragma once

namespace footfall {

/// A normal force as its law returns it [N], or that force over a power of the root depth.
template <class S>
struct NormalForce {
    S elastic;      ///< f_K: the derivative of the stored energy with respect to the depth
    S dissipative;  ///< f_D: the rest; its power f_D zdot leaves the system
    /// What the law's own states, as they move, take out of what is stored [W], or that over the same power of s.
    S relaxation = S(0);

    [[nodiscard]] constexpr S total() const noexcept { return elastic + dissipative; }
};

}  // namespace footfall
