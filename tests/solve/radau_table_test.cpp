// Every coefficient of the implicit method against the equation that defines it, to the rounding of long double.
#include "footfall/solve/radau_table.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <limits>

#include <gtest/gtest.h>

namespace footfall {
namespace {

namespace table = radau_table;
using Real = long double;
using Complex = std::complex<Real>;
constexpr std::size_t s = table::stages;

/// The sum of terms, and how far rounding may move it from what it should be: each term is right to one unit.
template <class T>
struct Sum {
    T value{};
    Real size = 0;
    void operator+=(const T& term) {
        value += term;
        size += std::abs(term);
    }
};

template <class T>
void expect_equal(const Sum<T>& sum, const T& wanted, const char* what, std::size_t i, std::size_t k) {
    const Real allowed = 8 * std::numeric_limits<Real>::epsilon() * (sum.size + std::abs(wanted));
    EXPECT_LE(static_cast<double>(std::abs(sum.value - wanted)), static_cast<double>(allowed))
        << what << ", " << i << ", " << k;
}

Real power(Real x, std::size_t k) { return std::pow(x, static_cast<Real>(k)); }
Complex plain(const table::Complex& z) { return {z.re, z.im}; }

TEST(RadauTable, WeightsIntegratePolynomialsOfDegreeEight) {
    for (std::size_t k = 1; k <= 2 * s - 1; ++k) {
        Sum<Real> sum;
        for (std::size_t j = 0; j < s; ++j) sum += table::a[s - 1][j] * power(table::c[j], k - 1);
        expect_equal(sum, 1 / static_cast<Real>(k), "B", 0, k);
    }
    // Together with c_5 = 1 these nine equations have one solution: Radau's.
    EXPECT_EQ(table::c[s - 1], 1);
    for (std::size_t i = 1; i < s; ++i) EXPECT_LT(table::c[i - 1], table::c[i]);
}

TEST(RadauTable, StagesCollocate) {
    for (std::size_t i = 0; i < s; ++i)
        for (std::size_t k = 1; k <= s; ++k) {
            Sum<Real> sum;
            for (std::size_t j = 0; j < s; ++j) sum += table::a[i][j] * power(table::c[j], k - 1);
            expect_equal(sum, power(table::c[i], k) / static_cast<Real>(k), "C", i, k);
        }
}

TEST(RadauTable, InverseTimesWeightsIsOne) {
    for (std::size_t i = 0; i < s; ++i)
        for (std::size_t k = 0; k < s; ++k) {
            Sum<Real> sum;
            for (std::size_t j = 0; j < s; ++j) sum += table::inverse[i][j] * table::a[j][k];
            expect_equal(sum, Real(i == k ? 1 : 0), "A^-1 A", i, k);
        }
}

TEST(RadauTable, EigenvectorsBelongToTheirEigenvalues) {
    for (std::size_t i = 0; i < s; ++i) {
        Sum<Real> real;
        std::array<Sum<Complex>, 2> pairs;
        for (std::size_t j = 0; j < s; ++j) {
            real += table::inverse[i][j] * table::t_real[j];
            for (std::size_t p = 0; p < 2; ++p) pairs[p] += table::inverse[i][j] * plain(table::t[p][j]);
        }
        expect_equal(real, table::lambda_real * table::t_real[i], "real", i, 0);
        for (std::size_t p = 0; p < 2; ++p) {
            expect_equal(pairs[p], plain(table::lambda[p]) * plain(table::t[p][i]), "pair", i, p);
            EXPECT_GT(table::lambda[p].im, 0);
        }
    }
    EXPECT_NE(table::lambda[0].im, table::lambda[1].im);  // so that these, and their conjugates, are all
    EXPECT_EQ(table::t_real[s - 1], 1);
    for (const auto& t : table::t) EXPECT_EQ(plain(t[s - 1]), Complex(1));
}

TEST(RadauTable, RowsTurnEveryEigenvectorIntoItsOwnCoordinate) {
    for (std::size_t p = 0; p < 3; ++p)
        for (std::size_t q = 0; q < 3; ++q) {
            Sum<Complex> same, conjugate;
            for (std::size_t j = 0; j < s; ++j) {
                const Complex row = p < 2 ? plain(table::from_z[p][j]) : Complex(table::from_z_real[j]);
                const Complex vector = q < 2 ? plain(table::t[q][j]) : Complex(table::t_real[j]);
                same += row * vector;
                conjugate += row * std::conj(vector);
            }
            expect_equal(same, Complex(p == q ? 1 : 0), "row", p, q);
            expect_equal(conjugate, Complex(p == 2 && q == 2 ? 1 : 0), "row on the conjugate", p, q);
        }
}

TEST(RadauTable, EstimateIsAnEmbeddedFormulaOfOrderFive) {
    Sum<Real> product;
    product += table::gamma0 * table::lambda_real;
    expect_equal(product, Real(1), "gamma0", 0, 0);
    for (std::size_t k = 1; k <= s + 1; ++k) {
        Sum<Real> sum;
        for (std::size_t j = 0; j < s; ++j) {
            sum += table::a[s - 1][j] * power(table::c[j], k - 1);
            sum += table::estimate_f[j] * power(table::c[j], k - 1);
        }
        const Real wanted = 1 / static_cast<Real>(k) - (k == 1 ? table::gamma0 : 0);
        if (k <= s) {
            expect_equal(sum, wanted, "estimate", 0, k);
        } else {
            EXPECT_GT(std::abs(sum.value - wanted), 1e-4L);  // of order 5, no higher: it sees an error
        }
    }
    for (std::size_t k = 0; k < s; ++k) {
        Sum<Real> sum;
        for (std::size_t j = 0; j < s; ++j) sum += table::estimate[j] * table::a[j][k];
        expect_equal(sum, table::estimate_f[k], "in terms of Z", 0, k);
    }
}

}  // namespace
}  // namespace footfall
