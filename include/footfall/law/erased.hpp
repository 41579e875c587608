// A law that is chosen when the program runs is a variant of laws. These treat it as one of them.
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

namespace footfall {

/// visit(law), where `law` is one law or a variant of several.
template <class Law, class Visit>
[[nodiscard, gnu::always_inline]] constexpr decltype(auto) with_law(const Law& law, Visit&& visit) {
    return std::forward<Visit>(visit)(law);
}
/// Compares one index after another: std::visit calls through a table, which keeps the compiler from seeing the law.
template <std::size_t I = 0, class... Laws, class Visit>
[[nodiscard, gnu::always_inline]] constexpr decltype(auto) with_law(const std::variant<Laws...>& law, Visit&& visit) {
    if constexpr (I + 1 == sizeof...(Laws)) {
        return visit(*std::get_if<I>(&law));
    } else {
        if (law.index() == I) return visit(*std::get_if<I>(&law));
        return with_law<I + 1>(law, visit);
    }
}

/// Whether the law is chosen when the program runs.
template <class Law>
inline constexpr bool is_erased = false;
template <class... Laws>
inline constexpr bool is_erased<std::variant<Laws...>> = true;

/// The law over another scalar.
template <class T, class Law>
[[nodiscard]] constexpr auto law_over(const Law& law) {
    return law.template cast<T>();
}
template <class T, class... Laws>
[[nodiscard]] constexpr auto law_over(const std::variant<Laws...>& law) {
    using Over = std::variant<decltype(std::declval<Laws>().template cast<T>())...>;
    return std::visit([](const auto& l) { return Over(l.template cast<T>()); }, law);
}

/// Has a law compute what it keeps of its parameters, which must not change afterwards.
template <class Law>
constexpr void prepare_law(Law& law) {
    if constexpr (requires { law.prepare(); }) law.prepare();
}
template <class... Laws>
constexpr void prepare_law(std::variant<Laws...>& law) {
    std::visit([](auto& l) { prepare_law(l); }, law);
}

/// The laws of a variant for which `Keeps<Law>` is true, in their order, again as a variant.
template <class Laws, template <class> class Keeps>
struct LawsThatKeep;
template <class... Laws, template <class> class Keeps>
struct LawsThatKeep<std::variant<Laws...>, Keeps> {
    template <class... Kept>
    static std::variant<Kept...> listed(const std::tuple<Kept...>&);
    using type = decltype(listed(
        std::tuple_cat(std::declval<std::conditional_t<Keeps<Laws>::value, std::tuple<Laws>, std::tuple<>>>()...)));
};
template <class Laws, template <class> class Keeps>
using LawsThat = typename LawsThatKeep<Laws, Keeps>::type;

/// The scalar of a law, or of the first of a variant of laws.
template <class Law>
struct ScalarOf {
    using type = typename Law::value_type;
};
template <class First, class... Rest>
struct ScalarOf<std::variant<First, Rest...>> {
    using type = typename ScalarOf<First>::type;
};

}  // namespace footfall
