//! Interface of the mapping methods.

use std::fmt;
use std::str::FromStr;

use periplus_geometry::{LaserScan2, Pose2};
use periplus_grid::OccupancyGrid;

use crate::engine::{ConstraintResidual, Counts, MapContradiction, Slam, Update};
use crate::gmapping::Gmapping;
use crate::loops::Closure;
use crate::map::Plan;
use crate::remark::Remark;

/// A map under construction by any method.
///
/// [`Slam`] optimizes one pose graph; [`Gmapping`] keeps a map per particle. Functions of only one of them
/// are on its own type.
pub trait Mapper: Send {
    /// Returns the method.
    fn method(&self) -> Method;

    /// Takes a scan, and where odometry has the robot at its time, if it does.
    fn add_scan(&mut self, scan: &LaserScan2, odom_from_base: Option<Pose2>) -> Update;

    /// Finishes what was left for later, and makes the map as good as it gets. More scans may follow.
    fn finish(&mut self);

    /// Returns the pose of the robot at the last scan.
    fn map_from_base(&self) -> Pose2;

    /// Returns the pose at each scan that was not rejected, with its stamp \[ns\], in the order of arrival.
    fn trajectory(&self) -> Vec<(i64, Pose2)>;

    /// Prepares rasterization of the current map by rows; `None` if even that would be too large.
    fn plan(&self) -> Option<Box<dyn Plan + '_>>;

    /// The map as it is now; none when it would be too large to hold.
    fn map(&self) -> Option<OccupancyGrid> {
        let plan = self.plan()?;
        Some(plan.rows(0..plan.info().height))
    }

    /// Counts of what happened.
    fn counts(&self) -> Counts;

    /// Bytes held, about.
    fn size(&self) -> usize;

    /// Returns the loop closure candidates with the decision on each, for methods that close loops one by
    /// one.
    fn closures(&self) -> &[Closure] {
        &[]
    }

    /// Everything that is known between kept scans and counts, of methods that keep a graph.
    fn edges(&self) -> Vec<ConstraintResidual> {
        Vec::new()
    }

    /// Warnings and notices in the order of detection. The list only grows.
    fn remarks(&self) -> &[Remark] {
        &[]
    }

    /// Remarks that hold now, with the time at which each was noticed.
    fn current_remarks(&self) -> Vec<Remark> {
        Vec::new()
    }

    /// Contradictions between passes in the map, for methods that audit it.
    fn contradictions(&self) -> Vec<MapContradiction> {
        Vec::new()
    }

    /// Number of resamplings, for particle filters.
    fn resamplings(&self) -> usize {
        0
    }
}

/// A map under construction, by one of the methods.
pub enum AnyMapper {
    /// By a pose graph.
    Graph(Box<Slam>),
    /// By a particle filter.
    Gmapping(Box<Gmapping>),
}

impl AnyMapper {
    /// Returns the mapper.
    #[must_use]
    pub fn get(&self) -> &dyn Mapper {
        match self {
            Self::Graph(slam) => &**slam,
            Self::Gmapping(slam) => &**slam,
        }
    }

    /// Returns the mapper, to add scans.
    pub fn get_mut(&mut self) -> &mut dyn Mapper {
        match self {
            Self::Graph(slam) => &mut **slam,
            Self::Gmapping(slam) => &mut **slam,
        }
    }

    /// Returns the pose graph, if the method has one.
    #[must_use]
    pub fn graph(&self) -> Option<&Slam> {
        match self {
            Self::Graph(slam) => Some(slam),
            Self::Gmapping(_) => None,
        }
    }
}

/// Mapping method.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Method {
    /// Pose graph: one map, optimized when a loop is closed.
    #[default]
    Graph,
    /// Rao-Blackwellized particle filter: a map per particle.
    Gmapping,
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Graph, Self::Gmapping];

    /// The word for it.
    #[must_use]
    pub const fn word(self) -> &'static str {
        match self {
            Self::Graph => "graph",
            Self::Gmapping => "gmapping",
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl FromStr for Method {
    type Err = String;

    fn from_str(word: &str) -> Result<Self, String> {
        let named = Self::ALL.into_iter().find(|method| method.word() == word);
        named.ok_or_else(|| format!("`{word}` is no method; there are `graph` and `gmapping`"))
    }
}

impl Mapper for Slam {
    fn method(&self) -> Method {
        Method::Graph
    }

    fn add_scan(&mut self, scan: &LaserScan2, odom_from_base: Option<Pose2>) -> Update {
        Self::add_scan(self, scan, odom_from_base)
    }

    fn finish(&mut self) {
        Self::finish(self);
    }

    fn map_from_base(&self) -> Pose2 {
        Self::map_from_base(self)
    }

    fn trajectory(&self) -> Vec<(i64, Pose2)> {
        Self::trajectory(self)
    }

    fn plan(&self) -> Option<Box<dyn Plan + '_>> {
        Some(Box::new(self.snapshot().plan()?))
    }

    fn counts(&self) -> Counts {
        Self::counts(self)
    }

    fn size(&self) -> usize {
        Self::size(self)
    }

    fn closures(&self) -> &[Closure] {
        Self::closures(self)
    }

    fn edges(&self) -> Vec<ConstraintResidual> {
        Self::edges(self).collect()
    }

    fn remarks(&self) -> &[Remark] {
        Self::remarks(self)
    }

    fn current_remarks(&self) -> Vec<Remark> {
        Self::current_remarks(self)
    }

    fn contradictions(&self) -> Vec<MapContradiction> {
        Self::contradictions(self)
    }
}
