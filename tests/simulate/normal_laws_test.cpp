// Every normal law by its name in a scenario, on the paper's sphere: the ledger closes, and the restitution is what
// theory or its source says.
#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "footfall/io/scenario.hpp"
#include "footfall/simulate/run.hpp"
#include "simulate/scenes.hpp"
#include "simulate/tried_laws.hpp"

namespace footfall {
namespace {

using test::ball_mass;

/// Keys of [contact.normal] besides `law`.
using Keys = std::map<std::string, double>;

/// The paper's ball, by itself 1 ms above the ground, falls at `speed` under a law that is called by its name.
Run bounce(const std::string& law, const Keys& keys, double speed, double end = 1, double mass = ball_mass) {
    std::string text = fmt::format(
        "[time]\nend = {}\n[gravity]\nacceleration = [0, 0, 0]\n"
        "[body]\nmass = {}\ninertia = \"solid-sphere\"\n[[body.spheres]]\nradius = 0.0165\n"
        "[body.initial]\nposition = [0, 0, {}]\nvelocity = [0, 0, {}]\n[contact.normal]\nlaw = \"{}\"\n",
        end, mass, 0.0165 + 1e-3 * speed, -speed, law);
    for (const auto& [key, value] : keys) text += fmt::format("{} = {}\n", key, value);
    Simulation simulation = parse_scenario(text).simulation;
    simulation.options.sample_period = 0;
    simulation.options.tolerance = 1e-12;
    return run(simulation);
}

double restitution(const Run& run) {
    EXPECT_EQ(run.impacts.size(), 1u);
    return run.impacts.empty() ? -1 : run.impacts[0].restitution().value_or(-1);
}

/// Restitution under f = k z^n (1 + a zdot), any k and n, by quadrature in the phase plane: d (1 + e) =
/// ln((1 + d)/(1 - d e)) with d = a zdot_in. Marhefka & Orin 1999.
double depth_damped_restitution(long double d) {
    long double low = 0, high = std::min(1.0L, 1 / d);
    for (int i = 0; i < 200; ++i) {
        const long double e = 0.5L * (low + high);
        (std::log1p(d) - std::log1p(-d * e) < d * (1 + e) ? low : high) = e;
    }
    return static_cast<double>(low);
}

/// (2/5) B((2/5)(b + 1), 3/2), the integral of x^b sqrt(1 - x^(5/2)) over [0, 1].
double hertz_moment(double b) {
    const double p = 0.4 * (b + 1);
    return 0.4 * std::tgamma(p) * std::tgamma(1.5) / std::tgamma(p + 1.5);
}

/// The deepest point of Hertz's impact.
double hertz_depth(double stiffness, double speed) {
    return std::pow(5 * ball_mass * speed * speed / (4 * stiffness), 0.4);
}

/// The name and the keys of every law of the registry.
std::vector<std::pair<std::string, Keys>> every_law() {
    std::vector<std::pair<std::string, Keys>> all;
    for (const NormalLaw& law : test::tried_normal_laws()) {
        Keys keys;
        std::visit(
            [&](const auto& l) {
                for (const auto& p : l.parameters()) keys.emplace(p.key, l.*p.member);
            },
            law);
        all.emplace_back(name_of(law), keys);
    }
    return all;
}

TEST(NormalLaws, CloseTheLedgerOfAnImpactWhoseLossIsTheDampers) {
    for (const auto& [law, keys] : every_law()) {
        for (const double speed : {0.05, 1.0}) {
            const footfall::Run run = bounce(law, keys, speed);
            const double e = restitution(run), energy = 0.5 * ball_mass * speed * speed;
            EXPECT_LE(run.max_residual, 1e-11) << law;
            EXPECT_NEAR(run.final.ledger.contact.normal_damper, energy * (1 - e * e), 1e-9 * energy) << law;
            EXPECT_NEAR(run.final.ledger.contact.stored(), 0, 1e-12 * energy) << law;
            EXPECT_TRUE(law == "hertz" ? std::abs(e - 1) < 1e-10 : e > 0.1 && e < 0.999) << law << " " << e;
        }
    }
}

TEST(HertzLaw, GivesTheClosedFormOfDurationDepthAndForceAndAllTheEnergyBack) {
    // Johnson 1985, section 11.4: T = 2.94 z*/v, exactly (4/5) sqrt(pi) Gamma(2/5) / Gamma(9/10).
    const double factor = 0.8 * std::sqrt(std::acos(-1.0)) * std::tgamma(0.4) / std::tgamma(0.9);
    ASSERT_NEAR(factor, 2.94, 0.005);
    for (const double speed : {1e-3, 0.1, 10.0}) {
        const footfall::Run run = bounce("hertz", {{"stiffness", 8.5e6}}, speed);
        const double depth = hertz_depth(8.5e6, speed);
        ASSERT_EQ(run.impacts.size(), 1u);
        const Impact& impact = run.impacts[0];
        EXPECT_NEAR(restitution(run), 1, 1e-10) << speed;
        EXPECT_NEAR(impact.peak_indentation / depth, 1, 1e-9) << speed;
        EXPECT_NEAR(impact.peak_normal_force / (8.5e6 * std::pow(depth, 1.5)), 1, 1e-9) << speed;
        EXPECT_NEAR((impact.recovered.value_or(0) - impact.touchdown) / (factor * depth / speed), 1, 1e-9) << speed;
    }
}

TEST(TsujiLaw, GivesTheRestitutionAskedForAtEverySpeedAndStiffness) {
    for (const double e : {1.0, 0.95, 0.8, 0.5, 0.2, 0.1}) {
        for (const double speed : {1e-3, 0.1, 10.0}) {
            for (const double k : {1e4, 8.5e6}) {
                const footfall::Run run =
                    bounce("tsuji", {{"stiffness", k}, {"mass", ball_mass}, {"restitution", e}}, speed, 30);
                EXPECT_NEAR(restitution(run), e, 1e-9) << speed << " " << k;
            }
        }
    }
}

TEST(TsujiLaw, OfAnotherMassThanTheBodysGivesAnotherRestitution) {
    const footfall::Run run = bounce("tsuji", {{"stiffness", 8.5e6}, {"mass", 4 * ball_mass}, {"restitution", 0.8}}, 1);
    EXPECT_LT(restitution(run), 0.7);
}

TEST(MarhefkaOrinLaw, GivesItsSolutionInThePhasePlaneWhateverTheStiffnessMassAndExponent) {
    for (const double alpha : {0.05, 0.3, 2.0}) {
        for (const double speed : {1e-3, 0.1, 1.0, 5.0}) {
            const double expected = depth_damped_restitution(1.5 * alpha * speed);
            const footfall::Run plain = bounce("marhefka-orin", {{"stiffness", 8.5e6}, {"alpha", alpha}}, speed);
            EXPECT_NEAR(restitution(plain), expected, 1e-9) << alpha << " " << speed;
            const footfall::Run other =
                bounce("marhefka-orin", {{"stiffness", 3e5}, {"alpha", alpha}, {"n", 1}}, speed, 1, 1.5);
            EXPECT_NEAR(restitution(other), expected, 1e-9) << alpha << " " << speed;
        }
    }
}

TEST(MarhefkaOrinLaw, HasItsParameterAsTheSlopeOfRestitutionAtLowSpeed) {
    for (const double alpha : {0.05, 0.3, 2.0}) {
        const double speed = 1e-4 / alpha;
        const footfall::Run run = bounce("marhefka-orin", {{"stiffness", 8.5e6}, {"alpha", alpha}}, speed, 30);
        EXPECT_NEAR((1 - restitution(run)) / (alpha * speed), 1, 1e-3);
    }
}

TEST(ImpactSpeedLaws, GiveTheRestitutionOfTheirDampingAtEverySpeed) {
    for (const double e : {1.0, 0.9, 0.6, 0.3, 0.1}) {
        const double damping_nikravesh = 0.75 * (1 - e * e), damping_flores = 1.6 * (1 - e) / e;
        for (const double speed : {0.01, 1.0}) {
            const Keys keys{{"stiffness", 8.5e6}, {"restitution", e}};
            const double nikravesh = restitution(bounce("lankarani-nikravesh", keys, speed, 30)),
                         flores = restitution(bounce("flores", keys, speed, 30));
            EXPECT_NEAR(nikravesh, e == 1 ? 1 : depth_damped_restitution(damping_nikravesh), 1e-9) << e << " " << speed;
            EXPECT_NEAR(flores, e == 1 ? 1 : depth_damped_restitution(damping_flores), 1e-9) << e << " " << speed;
        }
    }
}

TEST(ImpactSpeedLaws, OfFloresMeetsTheRestitutionAskedForAndThatOfLankaraniAndNikraveshOnlyNearOne) {
    for (const double e : {0.95, 0.9, 0.8, 0.7, 0.5, 0.3, 0.1}) {
        const Keys keys{{"stiffness", 8.5e6}, {"restitution", e}};
        const double nikravesh = restitution(bounce("lankarani-nikravesh", keys, 1, 30)),
                     flores = restitution(bounce("flores", keys, 1, 30));
        EXPECT_LE(std::abs(flores - e), 0.046) << e;
        EXPECT_LT(std::abs(flores - e), std::abs(nikravesh - e)) << e;
        EXPECT_GE(nikravesh, 0.66) << e;
        EXPECT_EQ(std::abs(nikravesh - e) < 0.015, e >= 0.9) << e;
    }
}

TEST(ImpactSpeedLaws, AreToldTheSpeedOfEachOfManyImpacts) {
    // Hardly any gravity, so that it does nothing while the ball touches: every bounce loses the same share.
    for (const char* law : {"lankarani-nikravesh", "flores"}) {
        const Simulation simulation = [&] {
            Simulation s =
                parse_scenario(fmt::format("[time]\nend = 600\n"
                                           "[gravity]\nacceleration = [0, 0, -0.01]\n[body]\nmass = 0.154\n"
                                           "inertia = \"solid-sphere\"\n[[body.spheres]]\nradius = 0.0165\n"
                                           "[body.initial]\nposition = [0, 0, 0.02]\nvelocity = [0, 0, -1]\n"
                                           "[contact.normal]\nlaw = \"{}\"\nstiffness = 8.5e6\nrestitution = 0.8\n",
                                           law))
                    .simulation;
            s.options.sample_period = 0;
            s.options.tolerance = 1e-12;
            return s;
        }();
        const footfall::Run run = footfall::run(simulation);
        ASSERT_GE(run.impacts.size(), 4u) << law;
        const double first = run.impacts[0].restitution().value_or(-1);
        for (std::size_t i = 1; i < 4; ++i) {
            EXPECT_LT(run.impacts[i].speed_in, 0.9 * run.impacts[i - 1].speed_in);
            EXPECT_NEAR(run.impacts[i].restitution().value_or(-1), first, 1e-4) << law << " " << i;
        }
    }
}

TEST(FalconLaw, LosesByItsScalingInSpeedAndByTheIntegralOverHertzsImpact) {
    // Weak damping: 1 - e = 2 D z*^(b+1) I_b / (m v), with z* of Hertz's impact, thus v^((4b - 1)/5).
    for (const double b : {0.0, 0.25, 0.5, 1.0, 1.5}) {
        std::vector<double> loss;
        for (const double speed : {0.1, 1.0}) {
            const double depth = hertz_depth(8.5e6, speed);
            const double share = 2 * std::pow(hertz_depth(8.5e6, 1), b + 1) * hertz_moment(b) / ball_mass;
            const double damping = 1e-4 / share;
            const double expected = 2 * damping * std::pow(depth, b + 1) * hertz_moment(b) / (ball_mass * speed);
            const footfall::Run run =
                bounce("falcon", {{"stiffness", 8.5e6}, {"damping", damping}, {"exponent", b}}, speed);
            loss.push_back(1 - restitution(run));
            EXPECT_NEAR(loss.back() / expected, 1, 1e-3) << b << " " << speed;
        }
        EXPECT_NEAR(std::log10(loss[1] / loss[0]), (4 * b - 1) / 5, 5e-4) << b;
    }
}

TEST(FalconLaw, HasTheSameRestitutionAtEverySpeedByDefault) {
    const Keys keys{{"stiffness", 8.5e6}, {"damping", 300}};
    const double e = restitution(bounce("falcon", keys, 1));
    EXPECT_LT(e, 0.9);
    for (const double speed : {1e-3, 0.05, 10.0}) EXPECT_NEAR(restitution(bounce("falcon", keys, speed, 30)), e, 1e-9);
}

TEST(KuwabaraKonoLaw, FollowsTheSeriesOfViscoelasticSpheres) {
    // Ramirez et al. 1999: e = 1 - C1 x + C2 x^2 - ..., x = (3/2) A (K/m)^(2/5) v^(1/5), C1 = 1.15344, C2 = (3/5) C1^2.
    // Schwager & Poeschel 2008: a contact that ends at zero force adds 0.26667 x^(5/2).
    const double C1 = 2.5 * std::pow(0.8, 0.4) * hertz_moment(0.5), C2 = 0.6 * C1 * C1, C5 = 4.0 / 15.0;
    ASSERT_NEAR(C1, 1.15344, 1e-5);
    ASSERT_NEAR(C2, 0.79826, 1e-5);
    for (const double x : {3e-3, 1e-2, 3e-2}) {
        for (const double speed : {0.01, 1.0}) {
            const double A = x / (1.5 * std::pow(8.5e6 / ball_mass, 0.4) * std::pow(speed, 0.2));
            const double e = restitution(bounce("kuwabara-kono", {{"stiffness", 8.5e6}, {"damping_time", A}}, speed));
            // The next term is of order x^3; the one in C5 stands well above it.
            EXPECT_NEAR(e, 1 - C1 * x + C2 * x * x + C5 * std::pow(x, 2.5), 0.6 * x * x * x) << x;
        }
    }
}

TEST(NormalLaws, LetGoABallThatStartsPressedIntoTheGround) {
    for (const auto& [law, keys] : every_law()) {
        std::string text = fmt::format(
            "[time]\nend = 0.5\n[gravity]\nacceleration = [0, 0, 0]\n"
            "[body]\nmass = 0.154\ninertia = \"solid-sphere\"\n[[body.spheres]]\nradius = 0.0165\n"
            "[body.initial]\nposition = [0, 0, 0.0164]\n"
            "[contact]\nallow_initial_penetration = true\n[contact.normal]\nlaw = \"{}\"\n",
            law);
        for (const auto& [key, value] : keys) text += fmt::format("{} = {}\n", key, value);
        const footfall::Run run = footfall::run(parse_scenario(text).simulation);
        EXPECT_TRUE(test::finite(run.final)) << law;
        EXPECT_LE(run.max_residual, 1e-8) << law;
        EXPECT_GT(run.final.body.position.z(), 0.01645) << law;
        EXPECT_GT(run.final.body.velocity.z(), 0) << law;
    }
}

}  // namespace
}  // namespace footfall
