//! The engine behind a node.

use periplus_geometry::Pose2;
use periplus_grid::OccupancyGrid;
use periplus_params::ParamValues;
use periplus_scan_matching::Symmetric3;
use periplus_slam::{
    Gmapping, GmappingSettings, Localizer, MapSnapshot, Mapper, SessionError, Settings, Slam,
    Update,
};

use crate::slam_toolbox::Program;

/// Mapping or localization engine of the node.
pub(crate) enum Engine {
    Graph(Box<Slam>),
    Localizer(Box<Localizer>),
    Particles(Box<Gmapping>),
}

/// Start pose on a stored graph.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Start {
    /// Origin of the graph.
    First,
    /// At a pose in the map.
    At(Pose2),
}

/// A map to be rasterized.
pub(crate) enum Drawing {
    /// Rasterized on another thread.
    MapSnapshot(MapSnapshot),
    /// Rasterized map; `None` if it would be too large.
    Map(Option<OccupancyGrid>),
}

/// Covariance of a start pose: variances \[m², rad²\].
pub(crate) const SURE: Symmetric3 = Symmetric3::diagonal(0.25, 0.25, 0.07);

/// The settings of the graph for a program of `slam_toolbox`.
pub(crate) fn settings(program: Program, values: &ParamValues, slices_per_scan: usize) -> Settings {
    Settings {
        is_lifelong: program == Program::Lifelong,
        slices_per_scan,
        // A node may run for weeks.
        keeps_each_pose: false,
        audits_live: true,
        ..Settings::of(values)
    }
}

/// Minimum number of slices per scan for particles, which have no background work.
const LEAST_SLICES: usize = 4;

/// The settings of the particles for a node, which may run for weeks.
fn gmapping_settings(values: &ParamValues, slices_per_scan: usize) -> GmappingSettings {
    GmappingSettings {
        slices_per_scan: slices_per_scan.max(LEAST_SLICES),
        keeps_each_pose: false,
        ..GmappingSettings::of(values)
    }
}

impl Engine {
    /// An empty map; none for a program that needs a stored one.
    pub(crate) fn empty(program: Program, values: &ParamValues, slices: usize) -> Option<Self> {
        match program {
            Program::Localization => None,
            Program::Gmapping => {
                Some(Self::Particles(Box::new(Gmapping::new(gmapping_settings(values, slices)))))
            }
            Program::Async | Program::Sync | Program::Lifelong => {
                Some(Self::Graph(Box::new(Slam::new(settings(program, values, slices)))))
            }
        }
    }

    /// A stored map, to continue or to localize on.
    pub(crate) fn stored(
        bytes: &[u8],
        settings: Settings,
        own_scans: Option<usize>,
        start: Start,
    ) -> Result<Self, SessionError> {
        let slam = Slam::resume(bytes, settings)?;
        let pose = match start {
            Start::First => slam.poses().first().copied().unwrap_or(Pose2::IDENTITY),
            Start::At(pose) => pose,
        };
        let mut engine = match own_scans {
            Some(own_scans) => Self::Localizer(Box::new(Localizer::new(slam, own_scans))),
            None => Self::Graph(Box::new(slam)),
        };
        engine.place(pose, SURE);
        Ok(engine)
    }

    pub(crate) fn mapper(&self) -> &dyn Mapper {
        match self {
            Self::Graph(slam) => &**slam,
            Self::Localizer(localizer) => &**localizer,
            Self::Particles(particles) => &**particles,
        }
    }

    pub(crate) fn add_scan(
        &mut self,
        scan: &periplus_geometry::LaserScan2,
        odom_from_base: Pose2,
    ) -> Update {
        let odom_from_base = Some(odom_from_base);
        match self {
            Self::Graph(slam) => slam.add_scan(scan, odom_from_base),
            Self::Localizer(localizer) => localizer.add_scan(scan, odom_from_base),
            Self::Particles(particles) => particles.add_scan(scan, odom_from_base),
        }
    }

    /// The graph, if the map is one.
    pub(crate) fn graph(&self) -> Option<&Slam> {
        match self {
            Self::Graph(slam) => Some(slam),
            Self::Localizer(localizer) => Some(localizer.stored()),
            Self::Particles(_) => None,
        }
    }

    /// The graph, if it grows.
    pub(crate) fn graph_mut(&mut self) -> Option<&mut Slam> {
        match self {
            Self::Graph(slam) => Some(slam),
            Self::Localizer(_) | Self::Particles(_) => None,
        }
    }

    /// Sets the pose of the robot; false if the engine does not support it.
    pub(crate) fn place(&mut self, map_from_base: Pose2, covariance: Symmetric3) -> bool {
        match self {
            Self::Graph(slam) => slam.place(map_from_base, covariance),
            Self::Localizer(localizer) => localizer.place(map_from_base, covariance),
            Self::Particles(_) => return false,
        }
        true
    }

    /// Covariance of the pose, along the axes of the map.
    pub(crate) fn covariance(&self) -> Symmetric3 {
        match self {
            Self::Graph(slam) => slam.covariance(),
            Self::Localizer(localizer) => localizer.covariance(),
            Self::Particles(particles) => particles.covariance(),
        }
    }

    /// Entropy of the particle weights, for the particle filter.
    pub(crate) fn entropy(&self) -> Option<f64> {
        match self {
            Self::Particles(particles) => Some(particles.entropy()),
            Self::Graph(_) | Self::Localizer(_) => None,
        }
    }

    /// Version of the map: changes with it.
    pub(crate) fn version(&self) -> (usize, usize) {
        match self {
            Self::Graph(slam) => (slam.counts().kept, slam.map_revision()),
            // What is stored stays.
            Self::Localizer(_) => (0, 0),
            Self::Particles(particles) => (particles.counts().kept, 0),
        }
    }

    pub(crate) fn drawing(&self) -> Drawing {
        match self {
            Self::Graph(slam) => Drawing::MapSnapshot(slam.snapshot()),
            Self::Localizer(localizer) => Drawing::MapSnapshot(localizer.snapshot()),
            Self::Particles(particles) => Drawing::Map(particles.map()),
        }
    }
}
