// Random steps of random hosts: the account of every one closes.
//
// FOOTFALL_SOAK_STEPS in the environment says how many there are, FOOTFALL_SOAK_SEED which.
#include <cmath>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "footfall/host/contact_set.hpp"
#include "host/random_host.hpp"

namespace footfall::test {
namespace {

std::uint64_t from_environment(const char* name, std::uint64_t otherwise) {
    const char* const text = std::getenv(name);
    return text ? std::strtoull(text, nullptr, 10) : otherwise;
}

TEST(HostSoak, ClosesTheAccountOfEveryStep) {
    const std::uint64_t steps = from_environment("FOOTFALL_SOAK_STEPS", 2000);
    const std::uint64_t first = from_environment("FOOTFALL_SOAK_SEED", 1);
    constexpr std::uint64_t steps_of_a_host = 10, most_contacts = 12;
    std::uint64_t in_contact = 0, unresolved = 0;
    for (std::uint64_t k = 0; k * steps_of_a_host < steps; ++k) {
        const std::uint64_t seed = 1'000'003 * first + k;
        Draw draw(seed);
        const std::size_t contacts = 1 + draw.below(most_contacts);
        std::vector<ContactParameters> laws;
        for (std::size_t i = 0; i < contacts; ++i) laws.push_back(random_contact(draw));
        LinearHost host(draw, contacts, 1 + draw.below(3 * contacts));
        ContactSetOptions options;
        options.max_evaluations = 10'000;  // steps that need more are tried, and ended
        ContactSet set(laws, options);
        const double dt = draw.decades(1e-4, 1e-2);
        for (std::uint64_t s = 0; s < steps_of_a_host; ++s) {
            const ContactSetStep& step = set.step(host.given(dt));
            ASSERT_TRUE(std::isfinite(step.residual)) << "seed " << seed << ", step " << s;
            ASSERT_LE(std::abs(step.residual), set.options().tolerance * step.energy_scale)
                << "seed " << seed << ", step " << s;
            // What an implicit end makes, where it lifts what it carries, is not beyond all that there is.
            ASSERT_GE(step.unresolved_loss, -2 * step.energy_scale) << "seed " << seed << ", step " << s;
            in_contact += step.evaluations > 0 ? 1 : 0;
            unresolved += step.unresolved_time > 0 ? 1 : 0;
            host.move(dt, step.impulse, step.double_impulse);
        }
    }
    RecordProperty("in_contact", static_cast<int>(in_contact));
    RecordProperty("unresolved", static_cast<int>(unresolved));
    EXPECT_GT(in_contact, steps / 2);
    EXPECT_LT(unresolved, in_contact / 5);
}

}  // namespace
}  // namespace footfall::test
