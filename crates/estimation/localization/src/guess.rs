//! Where somebody says that the robot is.

use periplus_diagnostics::Diagnostic;
use periplus_geometry::{Pose2, Stream};

use crate::known_map::{CellState, KnownMap};
use crate::particles::{Covariance2, Particles};
use crate::settings::Compat;

/// Where somebody says that the robot is, as `geometry_msgs/PoseWithCovarianceStamped` does.
#[derive(Clone, Debug, PartialEq)]
pub struct Guess {
    /// The frame in which it is said.
    pub frame: String,
    /// `map_from_base` at the time of the guess.
    pub pose: Pose2,
    /// Six by six numbers, row by row, of x, y, z, roll, pitch, yaw.
    pub covariance: [f64; 36],
    /// How odometry has moved the robot since: `then_from_now`. Identity when the guess is new.
    pub moved: Pose2,
}

/// Larger ones are slips: the standard deviation would be above 30 km.
const LARGEST_COVARIANCE: f64 = 1e9;

impl Guess {
    /// What makes it useless, whatever the map.
    pub(crate) fn check(&self, global_frame: &str, compat: Compat) -> Result<(), Box<Diagnostic>> {
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
        if !(self.pose.is_finite() && self.moved.is_finite()) {
            return error(
                "bad-guess",
                "a number of the initial pose is not finite".into(),
                "give x and y in metres and a quaternion of length one",
            );
        }
        let bad = |entry: &f64| entry.is_nan() || entry.abs() > LARGEST_COVARIANCE;
        let negative = |entry: f64| entry < 0.0;
        let wrong = self.covariance.iter().position(bad).or_else(|| {
            let is_checked = |index: usize| compat == Compat::Nav2 || index.is_multiple_of(7);
            (0..36).find(|&index| is_checked(index) && negative(self.covariance[index]))
        });
        if let Some(index) = wrong {
            return error(
                "bad-covariance",
                format!(
                    "entry {index} of the covariance of the initial pose is {}",
                    self.covariance[index]
                ),
                "variances are squares of standard deviations: 0 or more and finite; \
                 0.25, 0.25, 0.0685 at 0, 7 and 35 are usual",
            );
        }
        let Covariance2 { xx, xy, yy, .. } = Covariance2::from_rows(&self.covariance);
        if xy * xy > xx * yy * (1.0 + 1e-9) {
            return error(
                "bad-covariance",
                format!(
                    "x and y of the initial pose cannot vary together by {xy}: \
                         their variances are only {xx} and {yy}"
                ),
                "entry 1 squared is at most entry 0 times entry 7",
            );
        }
        Ok(())
    }

    /// Where the robot is now.
    pub(crate) fn now(&self) -> Pose2 {
        self.pose * self.moved
    }
}

/// Whether the robot can be there at all; what is doubtful about it otherwise.
pub(crate) fn check_place(
    map: &KnownMap,
    pose: Pose2,
    compat: Compat,
) -> Result<Option<Diagnostic>, Box<Diagnostic>> {
    let lattice = map.lattice();
    let Pose2 { x_m, y_m, .. } = pose;
    let state = map.state(map.cell_at(x_m, y_m));
    let is_outside = match compat {
        Compat::None => state.is_none(),
        // Metres held against a number of cells.
        Compat::Nav2 => x_m.abs() > lattice.width as f64 || y_m.abs() > lattice.height as f64,
    };
    if is_outside {
        let (low, high) = (
            lattice.point_at(0.0, 0.0),
            lattice.point_at(lattice.width as f64, lattice.height as f64),
        );
        let outside = Diagnostic::error(
            "guess-outside-of-map",
            format!("the initial pose ({x_m:.3}, {y_m:.3}) is outside of the map"),
        )
        .note(format!(
            "the map reaches from ({:.3}, {:.3}) to ({:.3}, {:.3})",
            low.0, low.1, high.0, high.1
        ))
        .help("give a pose on the map, or check the origin in the map's YAML");
        return Err(outside.into());
    }
    let what = match state {
        Some(CellState::Free) => return Ok(None),
        Some(CellState::Occupied) => "in a wall of the map",
        Some(CellState::Unknown) => "where the map knows nothing",
        None => "outside of the map",
    };
    Ok(Some(Diagnostic::warning(
        "guess-not-free",
        format!("the initial pose ({x_m:.3}, {y_m:.3}) is {what}"),
    )))
}

/// So many particles around a pose, normally distributed.
pub(crate) fn scatter(
    particles: &mut Particles,
    count: usize,
    mean: Pose2,
    covariance: Covariance2,
    stream: &mut Stream,
) {
    let Covariance2 { xx, xy, yy, yaw } = covariance;
    // Cholesky's root of two by two numbers.
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
