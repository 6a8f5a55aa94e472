//! Initial pose given by a user or a program.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{Pose2, Stream};

use crate::likelihood_map::{CellState, LikelihoodMap};
use crate::parameters::AmclCompat;
use crate::particles::{Covariance2, Particles};

/// Initial pose, as in `geometry_msgs/PoseWithCovarianceStamped`.
#[derive(Clone, Debug, PartialEq)]
pub struct InitialPose {
    /// Frame of the pose.
    pub frame: String,
    /// `map_from_base` at the time of the message.
    pub pose: Pose2,
    /// Row-major 6 by 6 covariance of x, y, z, roll, pitch, yaw.
    pub covariance: [f64; 36],
    /// Motion of the base by odometry since the time of the message; identity for a current pose.
    pub then_from_now: Pose2,
}

/// Maximum accepted covariance entry \[m^2, rad^2\]: a standard deviation of about 30 km is a
/// mistake.
const MAX_COVARIANCE_M2: f64 = 1e9;

impl InitialPose {
    /// Checks everything that does not depend on the map.
    pub(crate) fn check(
        &self,
        global_frame: &str,
        compat: AmclCompat,
    ) -> Result<(), Box<Diagnostic>> {
        let error = |code, message: String, help: &str| {
            Err(Box::new(Diagnostic::error(code, message).help(help.to_owned())))
        };
        if self.frame.trim_start_matches('/') != global_frame.trim_start_matches('/') {
            let frame = if self.frame.is_empty() { "no frame" } else { &self.frame };
            return error(
                "guess-in-other-frame",
                format!("the initial pose is given in `{frame}`, the map is `{global_frame}`"),
                &format!("give it in `{global_frame}`: it is the fixed frame to choose in RViz"),
            );
        }
        if !(self.pose.is_finite() && self.then_from_now.is_finite()) {
            return error(
                "bad-guess",
                "a number of the initial pose is not finite".into(),
                "give x and y in metres and a unit quaternion",
            );
        }
        let bad = |entry: &f64| entry.is_nan() || entry.abs() > MAX_COVARIANCE_M2;
        let negative = |entry: f64| entry < 0.0;
        let wrong = self.covariance.iter().position(bad).or_else(|| {
            let is_checked = |index: usize| compat == AmclCompat::Nav2 || index.is_multiple_of(7);
            (0..36).find(|&index| is_checked(index) && negative(self.covariance[index]))
        });
        if let Some(index) = wrong {
            return error(
                "bad-covariance",
                format!(
                    "entry {index} of the covariance of the initial pose is {}",
                    self.covariance[index]
                ),
                "variances are squared standard deviations: finite and not negative; \
                 0.25, 0.25, 0.0685 at 0, 7 and 35 are usual",
            );
        }
        let Covariance2 { xx, xy, yy, .. } = Covariance2::from_rows(&self.covariance);
        if xy * xy > xx * yy * (1.0 + 1e-9) {
            return error(
                "bad-covariance",
                format!(
                    "the covariance {xy} of x and y of the initial pose is impossible: \
                         their variances are only {xx} and {yy}"
                ),
                "entry 1 squared is at most entry 0 times entry 7",
            );
        }
        Ok(())
    }

    /// Pose of the base now.
    pub(crate) fn map_from_base(&self) -> Pose2 {
        self.pose * self.then_from_now
    }
}

/// Checks the pose against the map. Returns a warning for a pose that is not in free space.
pub(crate) fn check_position(
    map: &LikelihoodMap,
    pose: Pose2,
    compat: AmclCompat,
) -> Result<Option<Diagnostic>, Box<Diagnostic>> {
    let info = map.info();
    let Pose2 { x_m, y_m, .. } = pose;
    let state = map.state(map.cell_at(x_m, y_m));
    let is_outside = match compat {
        AmclCompat::None => state.is_none(),
        // Nav2 compares metres with a number of cells.
        AmclCompat::Nav2 => x_m.abs() > info.width as f64 || y_m.abs() > info.height as f64,
    };
    if is_outside {
        let (low, high) =
            (info.point_at(0.0, 0.0), info.point_at(info.width as f64, info.height as f64));
        let outside = Diagnostic::error(
            "guess-outside-of-map",
            format!("the initial pose ({x_m:.3}, {y_m:.3}) is outside of the map"),
        )
        .note(format!(
            "the map extends from ({:.3}, {:.3}) to ({:.3}, {:.3})",
            low.0, low.1, high.0, high.1
        ))
        .help("give a pose on the map, or check the origin in the map's YAML");
        return Err(outside.into());
    }
    let location = match state {
        Some(CellState::Free) => return Ok(None),
        Some(CellState::Occupied) => "in a wall of the map",
        Some(CellState::Unknown) => "in unknown space of the map",
        None => "outside of the map",
    };
    Ok(Some(Diagnostic::warning(
        "guess-not-free",
        format!("the initial pose ({x_m:.3}, {y_m:.3}) is {location}"),
    )))
}

/// Adds `count` particles, normally distributed around a pose.
pub(crate) fn scatter(
    particles: &mut Particles,
    count: usize,
    mean: Pose2,
    covariance: Covariance2,
    stream: &mut Stream,
) {
    let Covariance2 { xx, xy, yy, yaw } = covariance;
    // Cholesky decomposition of the 2 by 2 position covariance.
    let along = libm::sqrt(xx.max(0.0));
    let shared = if along > 0.0 { xy / along } else { 0.0 };
    let across = libm::sqrt((yy - shared * shared).max(0.0));
    let turn = libm::sqrt(yaw.max(0.0));
    for _ in 0..count {
        let (a, b, c) = (stream.normal(), stream.normal(), stream.normal());
        let (x_m, y_m) = (mean.x_m + along * a, mean.y_m + shared * a + across * b);
        particles.push(Pose2::new(x_m, y_m, mean.yaw_rad + turn * c));
    }
}
