//! Quantiles of the chi-square distribution.

/// Maximum number of terms of a series; 60 are enough for the degrees of freedom of a pose.
const MAX_TERM_COUNT: usize = 500;

/// Number of halvings of a bracket, down to the rounding of a double.
const HALVING_COUNT: usize = 100;

/// Returns the quantile of the chi-square distribution: the value that is not exceeded with the probability.
/// Infinite for a probability of 1, NaN outside 0 to 1.
#[must_use]
pub fn chi_square_quantile(probability: f64, degrees_of_freedom: u32) -> f64 {
    if !(0.0..=1.0).contains(&probability) {
        return f64::NAN;
    }
    if probability >= 1.0 {
        return f64::INFINITY;
    }
    let is_below = |value: f64| chi_square_probability(value, degrees_of_freedom) < probability;
    let (mut low, mut high) = (0.0, 1.0);
    while is_below(high) && high < 1e9 {
        high *= 2.0;
    }
    for _ in 0..HALVING_COUNT {
        let middle = 0.5 * (low + high);
        if is_below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

/// Returns the probability that a value of the chi-square distribution is at most `value`: the regularized
/// incomplete gamma function P(k/2, x/2), by its series (DLMF 8.11.4):
/// `P(a, x) = xᵃ e⁻ˣ Σ xⁿ / Γ(a + n + 1)`.
#[must_use]
pub fn chi_square_probability(value: f64, degrees_of_freedom: u32) -> f64 {
    let (a, x) = (0.5 * f64::from(degrees_of_freedom), 0.5 * value);
    if x <= 0.0 {
        return 0.0;
    }
    let mut term = libm::exp(a * libm::log(x) - x - libm::lgamma(a + 1.0));
    let mut sum = term;
    for number in 1..MAX_TERM_COUNT {
        term *= x / (a + number as f64);
        sum += term;
        // Terms grow while the number is below x.
        if term <= f64::EPSILON * sum && number as f64 > x {
            return sum.min(1.0);
        }
    }
    // Beyond the series, far in the tail.
    1.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_tables() {
        let check = |probability: f64, degrees: u32, expected: f64| {
            let found = chi_square_quantile(probability, degrees);
            assert!((found - expected).abs() < 5e-4, "{probability} {degrees}: {found}");
        };
        check(0.95, 1, 3.8415);
        check(0.95, 2, 5.9915);
        check(0.95, 3, 7.8147);
        check(0.025, 3, 0.2158);
        check(0.975, 3, 9.3484);
        check(0.99, 6, 16.8119);
        check(0.5, 100, 99.3341);
    }

    #[test]
    fn two_degrees_of_freedom_are_an_exponential() {
        for value in [0.1_f64, 1.0, 7.0, 40.0] {
            let expected = 1.0 - libm::exp(-0.5 * value);
            assert!((chi_square_probability(value, 2) - expected).abs() < 1e-12);
        }
    }

    #[test]
    fn borders() {
        assert!(chi_square_quantile(0.0, 3) < 1e-20);
        assert_eq!(chi_square_quantile(1.0, 3), f64::INFINITY);
        assert!(chi_square_quantile(1.5, 3).is_nan() && chi_square_quantile(f64::NAN, 3).is_nan());
        assert_eq!(chi_square_probability(-1.0, 3), 0.0);
    }
}
