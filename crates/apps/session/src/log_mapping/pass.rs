//! One pass over the scans of a log.

use periplus_os::Stopwatch;
use periplus_slam::{AnyMapper, CorrectedInput, Mapper, MountingCorrection, Slam};

use super::error::LogMappingError;
use super::mapper;
use super::parameters::SlamParameters;
use super::request::LogMappingRequest;
use crate::files::{self, FileError};
use crate::scan_log::ScanLog;

/// A log, and the map of the scans so far.
pub(super) struct MappingPass {
    /// The log. Ranges of processed scans are freed: they are most of its memory, and the map has copied what it needs.
    log: ScanLog,
    selected: AnyMapper,
    /// Correction of the data, when an error of it is known.
    cure: Option<CorrectedInput>,
    /// Every Nth scan is used.
    every: usize,
    /// Index of the next scan.
    next: usize,
    /// Number of poses of the session, which precede those of the log in the trajectory.
    before: usize,
    /// Time per scan \[s\].
    spent_s: Vec<f64>,
    /// Indices in the log of the scans in the trajectory.
    used: Vec<usize>,
    /// Result of writing the requested session.
    saved: Result<(), FileError>,
    /// Time to read the log, and of the last optimization \[s\].
    loaded_s: f64,
    finish_s: f64,
}

impl MappingPass {
    /// Reads the log, and starts a map or continues that of the session.
    pub(super) fn open(
        request: &LogMappingRequest,
        parameters: &SlamParameters,
        remedy: Option<MountingCorrection>,
    ) -> Result<Self, LogMappingError> {
        let watch = Stopwatch::start();
        let log = ScanLog::open(&request.log, &parameters.input(&request.input))?;
        if log.scans.is_empty() {
            return Err(LogMappingError::NoScans(request.log.clone()));
        }
        let selected = mapper::initial(request, parameters)?;
        let scans = log.scans.len();
        Ok(Self {
            before: selected.get().trajectory().len(),
            log,
            selected,
            cure: remedy.map(CorrectedInput::new),
            every: parameters.every().max(1),
            next: 0,
            spent_s: Vec::with_capacity(scans),
            used: Vec::with_capacity(scans),
            saved: Ok(()),
            loaded_s: watch.elapsed().as_secs_f64(),
            finish_s: 0.0,
        })
    }

    /// Starts again with corrected data. The memory of the old map is freed before the log is read.
    pub(super) fn restart(
        &mut self,
        request: &LogMappingRequest,
        parameters: &SlamParameters,
        remedy: MountingCorrection,
    ) -> Result<(), LogMappingError> {
        self.log = ScanLog::default();
        self.selected = mapper::initial(request, parameters)?;
        *self = Self::open(request, parameters, Some(remedy))?;
        Ok(())
    }

    /// Adds the next scan to the map; false after the last one.
    pub(super) fn add_scan(&mut self) -> bool {
        let number = self.next;
        let Some(logged) = self.log.scans.get_mut(number) else { return false };
        let one = Stopwatch::start();
        let slam = self.selected.get_mut();
        let ignored = slam.counts().ignored;
        // Counts and remarks have the outcome.
        let _ = match &mut self.cure {
            Some(cure) => {
                let (scan, odom_from_base) = cure.apply(&logged.scan, logged.odom_from_base);
                slam.add_scan(&scan, odom_from_base)
            }
            None => slam.add_scan(&logged.scan, logged.odom_from_base),
        };
        self.spent_s.push(one.elapsed().as_secs_f64());
        if slam.counts().ignored == ignored {
            self.used.push(number);
        }
        logged.scan.ranges_m = Vec::new();
        self.next += self.every;
        true
    }

    /// Writes the requested session, and makes the map as good as it gets.
    pub(super) fn finish(&mut self, request: &LogMappingRequest) {
        self.saved = match (&request.session_out, self.selected.graph()) {
            (Some(path), Some(graph)) => files::write(path, &graph.save()),
            _ => Ok(()),
        };
        let last = Stopwatch::start();
        self.selected.get_mut().finish();
        self.finish_s = last.elapsed().as_secs_f64();
    }

    pub(super) fn mapper(&self) -> &dyn Mapper {
        self.selected.get()
    }

    /// Pose graph, if the method has one.
    pub(super) fn graph(&self) -> Option<&Slam> {
        self.selected.graph()
    }

    pub(super) fn log(&self) -> &ScanLog {
        &self.log
    }

    /// Number of scans up to the next one, and of all.
    pub(super) fn position(&self) -> (usize, usize) {
        let total = self.log.scans.len();
        (self.next.min(total), total)
    }

    pub(super) fn before(&self) -> usize {
        self.before
    }

    /// Stamps of the scans in the trajectory, as in the log.
    pub(super) fn stamps(&self) -> impl Iterator<Item = String> {
        self.used.iter().map(|&number| self.log.scans[number].stamp())
    }

    pub(super) fn spent_s(&self) -> &[f64] {
        &self.spent_s
    }

    pub(super) fn saved(&self) -> Result<(), FileError> {
        self.saved.clone()
    }

    pub(super) fn loaded_s(&self) -> f64 {
        self.loaded_s
    }

    pub(super) fn finish_s(&self) -> f64 {
        self.finish_s
    }
}
