//! The map under construction.

use periplus::geometry::LaserScan2;
use periplus::geometry::Pose2;
use periplus::grid::{Grid, OccupancyGrid};
use periplus::params::ParamValues;
use periplus::slam::{
    AnyMapper, Gmapping, GmappingSettings, MapSnapshot, Mapper, Method, MountingCorrection,
    Plan as _, Settings, Slam, Update,
};
use pyo3::prelude::*;

use super::records::{SlamRemark, SlamUpdate};
use super::{no_scan, too_large};
use crate::work::released;

/// Number of slices of background work, of some milliseconds each, between two checks for Ctrl-C.
const SLICES_PER_CHECK: usize = 4;

/// Settings of the graph: its background work is left to [`Mapping::work_slices`].
pub(super) fn settings(values: &ParamValues) -> Settings {
    Settings { slices_per_scan: 0, ..Settings::of(values) }
}

/// An empty map by a method.
pub(super) fn empty(method: Method, values: &ParamValues) -> AnyMapper {
    match method {
        Method::Graph => AnyMapper::Graph(Box::new(Slam::new(settings(values)))),
        Method::Gmapping => {
            AnyMapper::Gmapping(Box::new(Gmapping::new(GmappingSettings::of(values))))
        }
    }
}

/// Everything but the mapper.
pub(super) struct Rest {
    settings: Option<Settings>,
    received: usize,
    reported: usize,
    correction: Option<MountingCorrection>,
}

impl Rest {
    pub(super) fn with(self, mapper: AnyMapper) -> Mapping {
        let Self { settings, received, reported, correction } = self;
        Mapping { mapper, settings, received, reported, correction }
    }
}

/// A map, and what was reported of it.
pub(super) struct Mapping {
    pub(super) mapper: AnyMapper,
    /// Settings of a graph.
    pub(super) settings: Option<Settings>,
    /// Number of scans received, also of skipped ones.
    received: usize,
    /// Number of remarks reported with updates.
    reported: usize,
    /// Correction that was applied to a log.
    pub(super) correction: Option<MountingCorrection>,
}

/// A scan that was added, before the background work.
pub(super) struct Begun {
    update: Update,
    revision: usize,
}

impl Mapping {
    pub(super) fn new(mapper: AnyMapper, settings: Option<Settings>) -> Self {
        let reported = mapper.get().remarks().len();
        Self { mapper, settings, received: 0, reported, correction: None }
    }

    pub(super) fn without_mapper(&self) -> Rest {
        let Self { settings, received, reported, correction, .. } = self;
        Rest {
            settings: settings.clone(),
            received: *received,
            reported: *reported,
            correction: *correction,
        }
    }

    /// Counts a scan; true if it is one of every N.
    pub(super) fn counts_in(&mut self, every: usize) -> bool {
        let number = self.received;
        self.received += 1;
        number.is_multiple_of(every)
    }

    /// Does some background work; true if there is more.
    pub(super) fn work_slices(&mut self) -> bool {
        let AnyMapper::Graph(slam) = &mut self.mapper else { return false };
        let before = slam.counts().slices;
        slam.work_slices(SLICES_PER_CHECK);
        slam.counts().slices - before == SLICES_PER_CHECK
    }

    pub(super) fn add_scan(&mut self, scan: &LaserScan2, odom_from_base: Option<Pose2>) -> Begun {
        let revision = self.mapper.graph().map_or(0, Slam::map_revision);
        Begun { update: self.mapper.get_mut().add_scan(scan, odom_from_base), revision }
    }

    /// The update after the background work.
    pub(super) fn end_scan(&mut self, begun: Begun, odom_from_base: Option<Pose2>) -> SlamUpdate {
        let Begun { mut update, revision } = begun;
        if let Some(slam) = self.mapper.graph() {
            update.is_map_revised = slam.map_revision() != revision;
            update.map_from_base = slam.map_from_base();
            update.map_from_odom = map_from_odom(update.map_from_base, odom_from_base);
        }
        let remarks = self.mapper.get().remarks();
        let new = remarks.get(self.reported..).unwrap_or_default();
        let new = new.iter().map(|it| SlamRemark(it.clone())).collect();
        self.reported = remarks.len();
        SlamUpdate::of(&update, new)
    }

    /// The update of a scan that is not one of every N.
    pub(super) fn skipped(&self, odom_from_base: Option<Pose2>) -> SlamUpdate {
        let map_from_base = self.mapper.get().map_from_base();
        SlamUpdate::skipped(map_from_base, map_from_odom(map_from_base, odom_from_base))
    }

    /// The map, to be drawn.
    pub(super) fn drawing(&self) -> Drawing {
        if self.mapper.get().trajectory().is_empty() {
            return Drawing::Empty;
        }
        match &self.mapper {
            AnyMapper::Graph(slam) => Drawing::Snapshot(slam.snapshot()),
            AnyMapper::Gmapping(slam) => Drawing::Grid(slam.map()),
        }
    }
}

fn map_from_odom(map_from_base: Pose2, odom_from_base: Option<Pose2>) -> Pose2 {
    odom_from_base.map_or(Pose2::IDENTITY, |odom| (map_from_base * odom.inverse()).normalized())
}

/// A map to be drawn without the mapper.
pub(super) enum Drawing {
    Empty,
    Snapshot(MapSnapshot),
    /// Drawn already; none if it is too large.
    Grid(Option<OccupancyGrid>),
}

impl Drawing {
    /// Draws about `cells_at_once` cells at a time, so that Ctrl-C works.
    pub(super) fn draw(self, py: Python<'_>, cells_at_once: usize) -> PyResult<OccupancyGrid> {
        let snapshot = match self {
            Self::Empty => return Err(no_scan()),
            Self::Grid(grid) => return grid.ok_or_else(too_large),
            Self::Snapshot(snapshot) => snapshot,
        };
        let plan = released(py, "Slam.map", || snapshot.plan())?.ok_or_else(too_large)?;
        let info = plan.info();
        let at_once = (cells_at_once / info.width.max(1)).max(1);
        let mut cells = Vec::new();
        cells.try_reserve_exact(info.len()).map_err(|_| too_large())?;
        for first in (0..info.height).step_by(at_once) {
            let rows = first..(first + at_once).min(info.height);
            cells.extend(released(py, "Slam.map", || plan.rows(rows))?.cells);
            py.check_signals()?;
        }
        Grid::from_cells(info, cells).map_err(|_| too_large())
    }
}
