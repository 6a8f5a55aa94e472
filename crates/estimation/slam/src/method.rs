//! What every method of mapping offers.

use std::fmt;
use std::str::FromStr;

use periplus_geometry::Pose2;
use periplus_grid::OccupancyGrid;

use crate::engine::{ConstraintResidual, Counts, MapContradiction, Slam, Update};
use crate::loops::Closure;
use crate::map::Plan;
use crate::remark::Remark;
use crate::scan::Scan;

/// A map that grows with every scan, by whichever method.
///
/// Methods differ in what they believe: [`Slam`] keeps one graph of poses and bends it when a loop is
/// closed. What only one of them knows is asked of that one.
pub trait Mapper: Send {
    /// Which method this is.
    fn method(&self) -> Method;

    /// Takes a scan, and where odometry has the robot at its time, if it does.
    fn add_scan(&mut self, scan: &Scan, odom_from_base: Option<Pose2>) -> Update;

    /// Finishes what was left for later, and makes the map as good as it gets. More scans may follow.
    fn finish(&mut self);

    /// Where the robot was at the last scan.
    fn map_from_base(&self) -> Pose2;

    /// Where the robot was at each scan that was not ignored, in the order in which they came \[ns\].
    fn trajectory(&self) -> Vec<(i64, Pose2)>;

    /// What it takes to draw the map as it is now a few rows at a time; none when it would be too large
    /// even so.
    fn plan(&self) -> Option<Box<dyn Plan + '_>>;

    /// The map as it is now; none when it would be too large to hold.
    fn map(&self) -> Option<OccupancyGrid> {
        let plan = self.plan()?;
        Some(plan.rows(0..plan.lattice().height))
    }

    /// Counts of what happened.
    fn counts(&self) -> Counts;

    /// Bytes held, about.
    fn size(&self) -> usize;

    /// What became of every closure of a loop that was looked at in earnest, of methods that close
    /// loops one by one.
    fn closures(&self) -> &[Closure] {
        &[]
    }

    /// Everything that is known between kept scans and counts, of methods that keep a graph.
    fn edges(&self) -> Vec<ConstraintResidual> {
        Vec::new()
    }

    /// What a person should know of the drive, in the order in which it was noticed; grows only.
    fn remarks(&self) -> &[Remark] {
        &[]
    }

    /// Remarks that hold now, with the time at which each was noticed.
    fn current_remarks(&self) -> Vec<Remark> {
        Vec::new()
    }

    /// Places where passes contradict each other in the map, of methods that audit it.
    fn contradictions(&self) -> Vec<MapContradiction> {
        Vec::new()
    }

    /// How often particles were drawn anew, of methods that have some.
    fn resamplings(&self) -> usize {
        0
    }
}

/// How maps are made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Method {
    /// A graph of poses: one map, which is bent when a loop is closed.
    #[default]
    Graph,
    /// Particles, each with a map of its own; those whose maps explain scans best go on.
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

    fn add_scan(&mut self, scan: &Scan, odom_from_base: Option<Pose2>) -> Update {
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
