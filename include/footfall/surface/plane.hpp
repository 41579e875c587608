// The ground as a plane, and how deep a sphere is in it.
#pragma once

namespace footfall {

/// z of a sphere [m]: negative where it is above the plane. `along_normal` is the centre's coordinate along the plane's
/// normal, `height` the plane's.
template <class S>
[[nodiscard]] constexpr S depth_in_plane(const S& along_normal, const S& radius, const S& height) noexcept {
    return radius + height - along_normal;
}

}  // namespace footfall
