//! Models of faults as plain numbers.

use periplus_geometry::Stream;

use crate::kinds::{GyroDriftParams, NoiseParams, PacketLossParams};

/// State of a channel that loses messages in bursts.
///
/// Source: E. N. Gilbert, "Capacity of a burst-noise channel", 1960, and E. O. Elliott, "Estimates of error rates for
/// codes on burst-noise channels", 1963. The share of messages in the bad state is enter / (enter + leave) in the
/// long run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ChannelState {
    /// Few messages are lost.
    #[default]
    Good,
    /// Many messages are lost.
    Bad,
}

impl ChannelState {
    /// Advances by one message. Returns the next state, and true if the message is lost.
    #[must_use]
    pub fn next(self, params: &PacketLossParams, stream: &mut Stream) -> (Self, bool) {
        let (change, loss) = (stream.unit(), stream.unit());
        let next = match self {
            Self::Good if change < params.enter_probability => Self::Bad,
            Self::Bad if change < params.leave_probability => Self::Good,
            same => same,
        };
        let probability = match next {
            Self::Good => params.good_loss_probability,
            Self::Bad => params.bad_loss_probability,
        };
        (next, loss < probability)
    }
}

/// Delay of a message \[s\]: normally distributed, and at least 0.
#[must_use]
pub fn delay_s(mean_s: f64, jitter_s: f64, stream: &mut Stream) -> f64 {
    let deviation = if jitter_s > 0.0 { jitter_s * stream.normal() } else { 0.0 };
    (mean_s + deviation).max(0.0)
}

/// Returns true during a burst of noise, `since_s` after the start of the fault. Each period has one burst at a
/// random time in it, from the stream of the fault's name.
#[must_use]
pub fn is_burst(params: &NoiseParams, since_s: f64, seed: u64, name: &str) -> bool {
    if params.period_s <= 0.0 {
        return true;
    }
    let period = libm::floor(since_s / params.period_s);
    let room_s = (params.period_s - params.length_s).max(0.0);
    let mut stream = Stream::keyed(seed, &format!("{name}/burst"), period.max(0.0) as u64);
    let start_s = period * params.period_s + room_s * stream.unit();
    (start_s..start_s + params.length_s).contains(&since_s)
}

/// Bias of a gyroscope that drifts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GyroBias {
    walk_rad_s: f64,
    last_s: Option<f64>,
}

impl GyroBias {
    /// Returns the bias `since_s` after the start of the fault \[rad/s\]: bias + rate t + random walk, whose steps have
    /// the standard deviation `random_walk` sqrt(dt).
    pub fn update(&mut self, params: &GyroDriftParams, since_s: f64, stream: &mut Stream) -> f64 {
        let dt_s = (since_s - self.last_s.unwrap_or(0.0)).max(0.0);
        self.last_s = Some(since_s);
        self.walk_rad_s += params.random_walk_rad_s_per_sqrt_s * libm::sqrt(dt_s) * stream.normal();
        params.bias_rad_s + params.rate_rad_s2 * since_s + self.walk_rad_s
    }
}

/// Returns the range that a lidar reports for a distance \[m\], by REP 117: infinite beyond its maximum, negative
/// infinite below its minimum.
#[must_use]
pub fn reported_range_m(range_m: f64, min_m: f64, max_m: f64) -> f64 {
    match range_m {
        _ if range_m.is_nan() => range_m,
        _ if range_m > max_m => f64::INFINITY,
        _ if range_m < min_m => f64::NEG_INFINITY,
        _ => range_m,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn losses_have_the_share_and_length_of_the_chain() {
        let params = PacketLossParams {
            enter_probability: 0.1,
            leave_probability: 0.4,
            ..PacketLossParams::default()
        };
        let (mut state, mut lost, mut bursts, mut stream) =
            (ChannelState::Good, 0, 0, Stream::keyed(1, "loss", 0));
        let count = 100_000;
        for _ in 0..count {
            let before = state;
            let is_lost;
            (state, is_lost) = state.next(&params, &mut stream);
            lost += i32::from(is_lost);
            bursts += i32::from(before == ChannelState::Good && state == ChannelState::Bad);
        }
        // 0.1 / (0.1 + 0.4), in bursts of 1 / 0.4 messages.
        let share = f64::from(lost) / f64::from(count);
        assert!((share - 0.2).abs() < 0.01, "{share}");
        let length = f64::from(lost) / f64::from(bursts);
        assert!((length - 2.5).abs() < 0.1, "{length}");
    }

    #[test]
    fn each_period_has_one_burst() {
        let params = NoiseParams { period_s: 2.0, length_s: 0.5, ..NoiseParams::default() };
        for period in 0..50 {
            let noisy = (0..200)
                .filter(|tick| {
                    let since_s = 2.0 * f64::from(period) + f64::from(*tick) * 0.01;
                    is_burst(&params, since_s, 3, "noise")
                })
                .count();
            assert!((49..=51).contains(&noisy), "{noisy} of 200 in period {period}");
        }
        assert!(is_burst(&NoiseParams::default(), 12.3, 0, ""));
    }

    #[test]
    fn a_random_walk_spreads_with_the_root_of_the_time() {
        let params =
            GyroDriftParams { random_walk_rad_s_per_sqrt_s: 0.1, ..GyroDriftParams::default() };
        let ends = (0..2000).map(|run| {
            let (mut bias, mut last) = (GyroBias::default(), 0.0);
            for tick in 1..=40 {
                let mut stream = Stream::keyed(run, "gyro", tick);
                last = bias.update(&params, tick as f64 * 0.1, &mut stream);
            }
            last
        });
        let variance = ends.map(|end| end * end).sum::<f64>() / 2000.0;
        // 0.1 rad/s after 1 s, 0.2 after 4 s.
        assert!((libm::sqrt(variance) - 0.2).abs() < 0.01, "{}", libm::sqrt(variance));
    }

    #[test]
    fn ranges_outside_the_limits_are_infinite() {
        let reported = [0.05, 0.1, 5.0, 10.1].map(|range_m| reported_range_m(range_m, 0.1, 10.0));
        assert_eq!(reported, [f64::NEG_INFINITY, 0.1, 5.0, f64::INFINITY]);
    }

    #[test]
    fn a_delay_is_never_negative() {
        let mut stream = Stream::keyed(0, "delay", 0);
        assert_eq!(delay_s(0.2, 0.0, &mut stream), 0.2);
        assert!((0..100).all(|_| delay_s(0.01, 0.1, &mut stream) >= 0.0));
    }
}
