#include "footfall/io/law_text.hpp"

#include <cmath>
#include <limits>
#include <string>
#include <variant>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace footfall {
namespace {

std::string error_of(const std::string& text) {
    try {
        return "accepted as " + law_text(parse_normal_law(text));
    } catch (const InvalidInput& error) {
        return error.what();
    }
}

TEST(LawText, ReadsANameAndItsParameters) {
    const auto law =
        std::get<AzadFeatherstoneNormal<>>(parse_normal_law("azad-featherstone:stiffness=8.5e6,damping=0"));
    EXPECT_EQ(law.stiffness, 8.5e6);
    EXPECT_EQ(law.damping, 0);
}

TEST(LawText, ConvertsUnitsAndForgivesSpacesAndOrder) {
    const auto law = std::get<AzadFeatherstoneNormal<>>(
        parse_normal_law(" azad-featherstone : damping = 3.1 kN s/m^1.5 , stiffness=+8.5 MN/m^1.5 "));
    EXPECT_EQ(law.stiffness, 8.5e6);
    EXPECT_EQ(law.damping, 3.1e3);
}

TEST(LawText, FillsInTheDefaults) {
    const auto law = std::get<HuntCrossleyNormal<>>(parse_normal_law("hunt-crossley:stiffness=2,damping=3,q=2"));
    EXPECT_EQ(law.n, 1.5);
    EXPECT_EQ(law.p, 1.5);
    EXPECT_EQ(law.q, 2);
}

TEST(LawText, ReadsALawWithoutParameters) {
    EXPECT_TRUE(std::holds_alternative<NoFriction<>>(parse_friction_law("none")));
    EXPECT_THROW((void)parse_friction_law("none:mu=1"), InvalidInput);
}

TEST(LawText, ReadsAFrictionLaw) {
    EXPECT_EQ(name_of(parse_friction_law("none")), "none");
    EXPECT_THROW((void)parse_friction_law("azad-featherstone"), InvalidInput);
    EXPECT_THROW((void)parse_friction_law("hunt-crossley:stiffness=1,damping=1"), InvalidInput);
}

TEST(LawText, SaysWhichLawOrParameterWasMeant) {
    EXPECT_NE(error_of("azad-fetherstone:stiffness=1").find("did you mean 'azad-featherstone'?"), std::string::npos);
    EXPECT_NE(error_of("linear:stifness=1").find("unknown parameter 'stifness': did you mean 'stiffness'?"),
              std::string::npos);
    EXPECT_NE(error_of("qqqqqqqqqqqq").find("unknown normal law 'qqqqqqqqqqqq'. There are azad-featherstone"),
              std::string::npos);
}

TEST(LawText, SaysWhatIsMissingWrongOrGivenTwice) {
    EXPECT_EQ(error_of("linear:stiffness=1"),
              "normal law 'linear': damping (d, normal damping) is missing: add damping=NUMBER, in N s/m");
    EXPECT_EQ(error_of("linear:stiffness=0,damping=1"),
              "normal law 'linear': stiffness (k, normal stiffness): is 0 N/m; allowed is > 0, finite");
    EXPECT_EQ(error_of("linear:stiffness=1,stiffness=2,damping=1"), "normal law 'linear': 'stiffness' is given twice");
    EXPECT_EQ(error_of("linear:stiffness"), "normal law 'linear:stiffness': expected key=value, got 'stiffness'");
    EXPECT_NE(error_of("linear:stiffness=1 N,damping=1").find("expected a stiffness (N/m), got a force (N): '1 N'"),
              std::string::npos);
    EXPECT_NE(error_of("hunt-crossley:stiffness=1 N/m^1.5,damping=1").find("expected a plain number"),
              std::string::npos);
    for (const char* bad :
         {"", ":", "linear:", "linear:stiffness=1,damping=1,", "linear:=1", "linear:stiffness=,damping=1",
          "linear:stiffness=nan,damping=1", "linear:stiffness=inf,damping=1", "linear:stiffness=1e999,damping=1",
          "linear:stiffness=++1,damping=1"}) {
        EXPECT_THROW((void)parse_normal_law(bad), InvalidInput) << bad;
    }
}

RC_GTEST_PROP(LawText, OfAnyParametersReadsBackToTheLastBit, (double stiffness, double damping)) {
    RC_PRE(std::isfinite(stiffness) && std::isfinite(damping) && stiffness != 0);
    for_each_law<NormalLaw>([&]<class Law>(Law law) {
        bool first = true;
        for (const auto& parameter : Law::parameters()) {
            law.*parameter.member = std::abs(first ? stiffness : damping);
            first = false;
            if (!parameter.allows(law.*parameter.member)) law.*parameter.member = 0.5;
        }
        const auto again = std::get<Law>(parse_normal_law(law_text(NormalLaw(law))));
        for (const auto& parameter : Law::parameters()) {
            RC_ASSERT((again.*parameter.member) == (law.*parameter.member));
        }
    });
}

}  // namespace
}  // namespace footfall
