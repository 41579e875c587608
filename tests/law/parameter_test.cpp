// How the laws describe themselves: what scenarios, help and range checks are made from.
#include "footfall/law/parameter.hpp"

#include <cmath>
#include <initializer_list>
#include <limits>
#include <set>
#include <string_view>
#include <type_traits>

#include <gtest/gtest.h>

#include "footfall/law/registry.hpp"
#include "footfall/math/dual.hpp"

namespace footfall {
namespace {

template <class Visit>
void for_each_law_of_all(Visit&& visit) {
    for_each_law<NormalLaw>(visit);
    for_each_law<FrictionLaw>(visit);
}

TEST(LawParameters, EveryLawSaysWhatItIs) {
    for_each_law_of_all([](const auto& law) {
        const LawDescription& d = law.description;
        EXPECT_FALSE(d.name.empty());
        for (const auto text : {d.formula, d.source, d.limits}) EXPECT_FALSE(text.empty()) << d.name;
    });
}

TEST(LawParameters, NamesAreUniqueWithinTheirList) {
    const auto count = []<class Variant>(const Variant*) {
        std::set<std::string_view> names;
        for_each_law<Variant>([&](const auto& law) { names.insert(law.description.name); });
        return names.size();
    };
    EXPECT_EQ(count(static_cast<const NormalLaw*>(nullptr)), std::variant_size_v<NormalLaw>);
    EXPECT_EQ(count(static_cast<const FrictionLaw*>(nullptr)), std::variant_size_v<FrictionLaw>);
}

TEST(LawParameters, TheNamesOfTheScenariosStand) {
    // Scenario files hold these names; a law that is renamed or taken away breaks them.
    const auto expect_all = []<class Variant>(const Variant*, std::initializer_list<std::string_view> known) {
        std::set<std::string_view> names;
        for_each_law<Variant>([&](const auto& law) { names.insert(law.description.name); });
        for (const std::string_view name : known) EXPECT_TRUE(names.contains(name)) << name;
    };
    expect_all(static_cast<const NormalLaw*>(nullptr),
               {"azad-featherstone", "kuwabara-kono", "hunt-crossley", "marhefka-orin", "flores", "tsuji",
                "lankarani-nikravesh", "falcon", "hertz", "linear"});
    expect_all(
        static_cast<const FrictionLaw*>(nullptr),
        {"none", "azad-featherstone", "azad-featherstone-passive", "linear", "regularized-coulomb", "dahl", "lugre",
         "elasto-plastic", "bliman-sorine", "seven-parameter", "reset-integrator", "haessig-friedland"});
}

TEST(LawParameters, EveryMemberIsAParameterOnce) {
    // A law is an aggregate of doubles: as many parameters as fit into it, each with its own key, symbol and place.
    // What a law keeps of its preparation or of the impact that has begun is one more, and not a parameter.
    for_each_law_of_all([](auto law) {
        const auto parameters = law.parameters();
        std::size_t members = std::is_empty_v<decltype(law)> ? 0 : sizeof(law) / sizeof(double);
        if constexpr (
            requires { law.begin_impact(1.0); } || requires { law.prepare(); })
            --members;
        EXPECT_EQ(parameters.size(), members) << law.description.name;
        std::set<std::string_view> keys, symbols;
        std::set<const double*> places;
        for (const auto& p : parameters) {
            keys.insert(p.key);
            symbols.insert(p.symbol);
            places.insert(&(law.*p.member));
            EXPECT_FALSE(p.unit.empty()) << p.key;
            EXPECT_FALSE(p.description.empty()) << p.key;
        }
        EXPECT_EQ(keys.size(), parameters.size()) << law.description.name;
        EXPECT_EQ(symbols.size(), parameters.size()) << law.description.name;
        EXPECT_EQ(places.size(), parameters.size()) << law.description.name;
    });
}

TEST(LawParameters, ValuesLeftOutAreThoseOfTheAggregateAndAllowed) {
    for_each_law_of_all([](auto law) {  // as in Law{}: what is not given takes its default
        for (const auto& p : law.parameters()) {
            if (!p.fallback) continue;
            EXPECT_EQ(law.*p.member, *p.fallback) << p.key;
            EXPECT_TRUE(p.allows(*p.fallback)) << p.key;
        }
    });
}

TEST(LawParameters, RangesRefuseWhatNoLawCanUse) {
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    for_each_law_of_all([&](auto law) {
        for (const auto& p : law.parameters()) {
            for (const double bad : {-1.0, -1e-300, nan, infinity, -infinity})
                EXPECT_FALSE(p.allows(bad)) << law.description.name << " " << p.key << " " << bad;
            for (const double good : {1e-12, 1.0}) EXPECT_TRUE(p.allows(good)) << p.key << " " << good;
            for (const double large : {std::nextafter(1.0, 2.0), 1e12})
                EXPECT_EQ(p.allows(large), !p.at_most_one) << p.key << " " << large;
            EXPECT_EQ(p.allows(0.0), p.may_be_zero()) << p.key;
            EXPECT_EQ(p.range(), p.may_be_zero() ? (p.at_most_one ? "from 0 to 1" : ">= 0")
                                                 : (p.at_most_one ? "> 0 and <= 1" : "> 0"))
                << p.key;
        }
    });
}

TEST(LawParameters, ARestitutionAboveOneIsRefusedInEveryLawThatTakesOne) {
    int laws = 0;
    for_each_law<NormalLaw>([&](auto law) {
        for (const auto& p : law.parameters()) law.*p.member = 1;
        for (const auto& p : law.parameters()) {
            if (p.key != "restitution") continue;
            ++laws;
            EXPECT_NO_THROW(check({law, NoFriction<>{}}, "sphere 0")) << law.description.name;
            law.*p.member = 1.01;
            try {
                check({law, NoFriction<>{}}, "sphere 0");
                ADD_FAILURE() << law.description.name << " took a restitution of 1.01";
            } catch (const InvalidInput& error) {
                for (const char* part : {"restitution", "1.01", "> 0 and <= 1"})
                    EXPECT_NE(std::string_view(error.what()).find(part), std::string_view::npos) << error.what();
            }
        }
    });
    EXPECT_GE(laws, 3);
}

TEST(LawParameters, EveryLossMayBeZeroAndNoSpringMayBe) {
    // No damping, no friction, no viscous term and an elastic impact are ordinary wishes.
    for_each_law_of_all([](auto law) {
        for (const auto& p : law.parameters()) {
            const bool loss = p.key == "damping" || p.key == "damping_time" || p.key == "alpha" ||
                              p.key == "coefficient" || p.key == "viscous";
            const bool spring = p.key == "stiffness";
            EXPECT_TRUE(p.may_be_zero() || !loss) << law.description.name << " " << p.key;
            EXPECT_FALSE(p.may_be_zero() && spring) << law.description.name;
        }
    });
}

TEST(LawParameters, CheckNamesThePlaceTheParameterItsValueAndWhatIsAllowed) {
    ContactParameters contact{AzadFeatherstoneNormal<>{8.5e6, 3.1e3}, LinearFriction<>{{1e5, 20, 0.5, 0}}};
    EXPECT_NO_THROW(check(contact, "sphere 2"));
    std::get<LinearFriction<>>(contact.friction).coefficient = -0.25;
    try {
        check(contact, "sphere 2");
        FAIL() << "a negative coefficient of friction was accepted";
    } catch (const InvalidInput& error) {
        for (const char* part : {"sphere 2", "linear", "coefficient", "-0.25", ">= 0"})
            EXPECT_NE(std::string_view(error.what()).find(part), std::string_view::npos)
                << part << ": " << error.what();
    }
}

TEST(LawParameters, CanBeGivenInAnyScalar) {
    for_each_law_of_all([](auto law) {
        using D = Dual<double, 1>;
        auto over = law.template cast<D>();
        const auto parameters = law.parameters();
        const auto dual = over.parameters();
        ASSERT_EQ(dual.size(), parameters.size());
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            EXPECT_EQ(dual[i].key, parameters[i].key);
            EXPECT_EQ(dual[i].unit, parameters[i].unit);
            over.*dual[i].member = D::variable(1.5 + static_cast<double>(i), 0);
            EXPECT_EQ((over.*dual[i].member).gradient[0], 1);
        }
        // Each has its own place, and it is the place of the same parameter.
        const auto back = over.template cast<D>();
        for (std::size_t i = 0; i < parameters.size(); ++i) {
            EXPECT_EQ((back.*dual[i].member).value, 1.5 + static_cast<double>(i)) << law.description.name;
            law.*parameters[i].member = 0.25;
            EXPECT_EQ((law.template cast<D>().*dual[i].member).value, 0.25) << law.description.name;
            law.*parameters[i].member = 0.5;
        }
    });
}

TEST(LawParameters, CastKeepsEveryParameter) {
    for_each_law_of_all([](auto law) {
        double value = 1.25;
        for (const auto& p : law.parameters()) law.*p.member = (value *= 2);
        const auto back = law.template cast<long double>().template cast<double>();
        for (const auto& p : law.parameters()) EXPECT_EQ(back.*p.member, law.*p.member) << p.key;
    });
}

}  // namespace
}  // namespace footfall
