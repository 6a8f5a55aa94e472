//! Limits of a speed from parameters.

use periplus_params::ParamValues;

use crate::{AccelerationLimits, ControlRelease, SpeedLimiter};

/// Returns the limits of the parameters below a prefix such as `linear.x`. Missing minima are the
/// negative maxima, and NaN is unlimited.
#[must_use]
pub fn limiter_of(values: &ParamValues, prefix: &str, release: ControlRelease) -> SpeedLimiter {
    let number = |name: &str| {
        let name = format!("{prefix}.{name}");
        values.find(&name).and_then(|_| values.number(&name)).filter(|number| number.is_finite())
    };
    let applies = |kind: &str| {
        let name = format!("{prefix}.has_{kind}_limits");
        let given = values.find(&name).and_then(|_| values.flag(&name));
        given.unwrap_or(release >= ControlRelease::Jazzy)
    };
    let range = |kind: &str| {
        let max = number(&format!("max_{kind}")).filter(|_| applies(kind))?;
        Some([number(&format!("min_{kind}")).unwrap_or(-max), max])
    };
    let acceleration = number("max_acceleration").filter(|_| applies("acceleration")).map(|max| {
        if release < ControlRelease::Jazzy {
            return AccelerationLimits::between(number("min_acceleration").unwrap_or(-max), max);
        }
        let or = |name: &str, default: f64| number(name).unwrap_or(default);
        AccelerationLimits {
            max_acceleration: max,
            max_deceleration: or("max_deceleration", or("min_acceleration", -max)),
            max_acceleration_reverse: or("max_acceleration_reverse", -max),
            max_deceleration_reverse: or("max_deceleration_reverse", max),
        }
    });
    SpeedLimiter {
        velocity: range("velocity"),
        acceleration,
        jerk: range("jerk"),
        limits_jerk_as_jazzy: release >= ControlRelease::Jazzy,
    }
}

#[cfg(test)]
mod tests {
    use periplus_params::ParamValue;

    use super::*;
    use crate::DIFF_DRIVE;

    fn limiter(given: &[(&str, ParamValue)], release: ControlRelease) -> SpeedLimiter {
        let mut values = ParamValues::defaults(&DIFF_DRIVE);
        given.iter().for_each(|(name, value)| assert!(values.set(name, value.clone()), "{name}"));
        limiter_of(&values, "linear.x", release)
    }

    #[test]
    fn releases_differ() {
        let number = |name, value| (name, ParamValue::Number(value));
        let given =
            [number("linear.x.max_velocity", 2.0), number("linear.x.max_acceleration", 3.0)];
        let jazzy = limiter(&given, ControlRelease::Jazzy);
        assert_eq!(jazzy.velocity, Some([-2.0, 2.0]));
        assert_eq!(jazzy.acceleration, Some(AccelerationLimits::between(-3.0, 3.0)));
        assert_eq!(jazzy.jerk, None);
        // Humble applies no limits without being asked.
        let humble = limiter(&given, ControlRelease::Humble);
        assert_eq!((humble.velocity, humble.acceleration), (None, None));
        let flag = |name, value| (name, ParamValue::Bool(value));
        let asked = [
            given[0].clone(),
            flag("linear.x.has_velocity_limits", true),
            number("linear.x.min_velocity", -0.5),
        ];
        let humble = limiter(&asked, ControlRelease::Humble);
        assert_eq!(humble.velocity, Some([-0.5, 2.0]));
        let free = [number("linear.x.max_velocity", f64::NAN)];
        assert_eq!(limiter(&free, ControlRelease::Main).velocity, None);
    }
}
