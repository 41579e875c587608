// s = sqrt(z) of each contact as a component of a plant's state, and the scale of time that goes with it.
#pragma once

namespace footfall {

/// s, never so near zero that a power of it in a denominator would overflow.
template <class S>
[[nodiscard, gnu::always_inline]] inline S off_zero(const S& s) noexcept {
    const S least(1e-60);
    return s < least && s > -least ? least : s;
}

/// g = dt/dsigma of several contacts: 1/g = sum of 1/s_i over those that `counts(i)`; 1 where none does.
/// `root_depth(i)` is s_i.
template <class S, class Counts, class RootDepth>
[[nodiscard, gnu::always_inline]] inline S shared_time_rate(int contacts, Counts&& counts, RootDepth&& root_depth) {
    S sum(0);
    for (int i = 0; i < contacts; ++i)
        if (counts(i)) sum += S(1) / root_depth(i);
    return sum == S(0) ? S(1) : S(1) / sum;
}

/// (ds/dsigma)/zdot of a contact that touches: g/(2 s).
template <class S>
[[nodiscard, gnu::always_inline]] inline S root_depth_per_depth(const S& s, const S& g) noexcept {
    return g / (S(2) * s);
}

}  // namespace footfall
