// What a host gives, checked before anything is done with it.
#pragma once

#include <cstddef>

#include "footfall/host/contact_set.hpp"

namespace footfall::host {

/// Throws InvalidInput unless every array has its size and every number can be used. `asks`: a contact whose law needs
/// radius, spin and rolling, or -1; `law` is that law's name.
void check_step(const HostStep& host, std::size_t contacts, int asks, std::string_view law);
void check_options(const ContactSetOptions& options);

/// The phase of contact i that a number stands for. Throws InvalidInput where it stands for none.
[[nodiscard]] Phase phase_at(std::size_t i, int number);

}  // namespace footfall::host
