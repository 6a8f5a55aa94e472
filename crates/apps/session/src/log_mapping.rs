//! Mapping of a log, scan by scan, as `periplus slam LOG` does it.
//!
//! The caller calls [`LogMapping::step`] until the map is complete, shows the progress between the steps, and writes the
//! results. The same log and parameters give the same files on every platform.

mod error;
mod mapper;
mod parameters;
mod pass;
mod report;
mod request;
mod results;

use periplus_geometry::Pose2;
use periplus_os::Stopwatch;
use periplus_params::Params as _;
use periplus_slam::tables::MountingParams;
use periplus_slam::{Counts, MountingCorrection};

use crate::files;
use crate::terminal;

pub use error::LogMappingError;
pub use report::MappingReport;
pub use request::LogMappingRequest;

use parameters::SlamParameters;
use pass::MappingPass;

/// Result of one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum MappingStep {
    /// A scan was processed.
    Scan,
    /// The data has an error that is certain: the map is rebuilt from the first scan with corrected data.
    Restarted(MountingCorrection),
    /// The map is complete.
    Complete,
}

/// Progress of a mapping run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MappingProgress {
    /// Number of scans of the log that were processed, and of all.
    pub scans: (usize, usize),
    /// True while the map is rebuilt with corrected data.
    pub is_rebuilt: bool,
    /// Pose of the robot at the last scan.
    pub map_from_base: Pose2,
    /// Counts of what happened.
    pub counts: Counts,
}

/// A map under construction from a log.
pub struct LogMapping {
    request: LogMappingRequest,
    parameters: SlamParameters,
    watch: Stopwatch,
    pass: MappingPass,
    remedy: Option<MountingCorrection>,
    is_complete: bool,
}

impl LogMapping {
    /// Reads parameters and log, and prints their findings.
    ///
    /// # Errors
    /// When one of them cannot be read or has errors.
    pub fn open(request: LogMappingRequest) -> Result<Self, LogMappingError> {
        let watch = Stopwatch::start();
        let parameters = SlamParameters::read(&request)?;
        let findings = &parameters.diagnostics;
        terminal::diagnostics(&mut terminal::messages(), findings, &parameters.sources)
            .map_err(LogMappingError::Output)?;
        if findings.has_errors() {
            return Err(LogMappingError::Reported);
        }
        let pass = MappingPass::open(&request, &parameters, None)?;
        Ok(Self { request, parameters, watch, pass, remedy: None, is_complete: false })
    }

    /// Processes the next scan, or after the last one completes the map.
    ///
    /// # Errors
    /// When the log of a map that is rebuilt can no longer be read.
    pub fn step(&mut self) -> Result<MappingStep, LogMappingError> {
        if self.is_complete {
            return Ok(MappingStep::Complete);
        }
        if self.pass.add_scan() {
            return Ok(MappingStep::Scan);
        }
        self.pass.finish(&self.request);
        if self.remedy.is_none()
            && let Some(remedy) = self.correction()
        {
            self.pass.restart(&self.request, &self.parameters, remedy)?;
            self.remedy = Some(remedy);
            return Ok(MappingStep::Restarted(remedy));
        }
        self.is_complete = true;
        Ok(MappingStep::Complete)
    }

    /// Error of mounting or axes that the drive shows, if it is to be corrected.
    fn correction(&self) -> Option<MountingCorrection> {
        let is_corrected = MountingParams::from_values(&self.parameters.values).correct_mounting;
        MountingCorrection::of(self.pass.mapper().remarks())
            .filter(|_| self.request.session.is_none() && is_corrected)
    }

    /// Returns the progress.
    #[must_use]
    pub fn progress(&self) -> MappingProgress {
        let mapper = self.pass.mapper();
        MappingProgress {
            scans: self.pass.position(),
            is_rebuilt: self.remedy.is_some(),
            map_from_base: mapper.map_from_base(),
            counts: mapper.counts(),
        }
    }

    /// Returns the number of scans that were processed, and of all.
    #[must_use]
    pub fn position(&self) -> (usize, usize) {
        self.pass.position()
    }

    /// Draws the present map with the trajectory as PNG; none while there is no map.
    #[must_use]
    pub fn preview(&self) -> Option<Vec<u8>> {
        results::preview(self.pass.mapper())
    }

    /// Damaged parts of the log.
    #[must_use]
    pub fn faults(&self) -> &[String] {
        &self.pass.log().faults
    }

    /// Report of the run so far; complete when it is made last.
    #[must_use]
    pub fn report(&self) -> MappingReport<'_> {
        MappingReport {
            request: &self.request,
            slam: self.pass.mapper(),
            parameters: &self.parameters,
            log: self.pass.log(),
            loaded_s: self.pass.loaded_s(),
            finish_s: self.pass.finish_s(),
            wall_s: self.watch.elapsed().as_secs_f64(),
            spent_s: self.pass.spent_s(),
            remedy: self.remedy,
        }
    }

    /// Writes map, trajectory, report, and the requested session and graph.
    ///
    /// # Errors
    /// When a file cannot be written, or the map is too large to draw.
    pub fn write(&self, report: &MappingReport<'_>) -> Result<(), LogMappingError> {
        self.pass.saved()?;
        if let (Some(path), Some(graph)) = (&self.request.g2o_out, self.pass.graph()) {
            files::write(path, graph.to_g2o().as_bytes())?;
        }
        results::write(&self.request.out, &self.pass, report)
    }
}
