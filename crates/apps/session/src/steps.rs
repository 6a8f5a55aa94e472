//! Single steps of a session, for programs with a separate loop.

use std::path::PathBuf;

use periplus_sim::{
    Diverged, RecordError, RecordingSummary, ServicesSnapshot, SimulationRecorder, Snapshot,
    SnapshotError,
};

use crate::builder::{RecordingRequest, show};
use crate::error::RunError;
#[cfg(not(target_family = "wasm"))]
use crate::page::{Page, PageSettings};
use crate::page::{PageContext, PageHub};
use crate::session::SimulationSession;

impl SimulationSession {
    /// Serves requests, then takes one step that ends at `end_ns` at the latest, also while the world is paused.
    ///
    /// # Errors
    /// When the motion of a body outside of all models diverges.
    pub fn step_until(&mut self, end_ns: i64) -> Result<(), Diverged> {
        self.serve();
        let parts = &mut self.parts;
        parts.driver.play(&parts.simulation);
        let mut next_ns = parts.driver.next_ns().unwrap_or(i64::MAX).min(end_ns);
        if parts.services.may_step() {
            next_ns = next_ns.min(parts.services.until_ns());
        }
        parts.simulation.step_until(next_ns)
    }

    /// Returns a real-time factor that a client requested since the last call; an inner `None` is full speed.
    #[must_use]
    pub fn take_factor(&mut self) -> Option<Option<f64>> {
        self.parts.services.take_factor()
    }

    /// Real-time factor of the builder; `None` is full speed.
    #[must_use]
    pub fn factor(&self) -> Option<f64> {
        self.parts.factor
    }

    /// Serves requests of clients to inspect and change the world.
    pub fn serve(&mut self) {
        let parts = &mut self.parts;
        let before_ns = parts.simulation.time_ns();
        parts.services.serve(&mut parts.simulation);
        if parts.simulation.time_ns() < before_ns {
            parts.driver.restart();
        }
    }

    /// Pauses or continues the world.
    pub fn set_paused(&mut self, is_paused: bool) {
        self.parts.services.set_paused(is_paused);
    }

    /// Returns true while the world is paused and no requested steps are left.
    #[must_use]
    pub fn is_paused(&self) -> bool {
        !self.parts.services.may_step()
    }

    /// Starts a recording of all messages from now on. A recording that runs is closed first.
    ///
    /// # Errors
    /// When a recording cannot be closed, or the new one cannot be created.
    pub fn start_recording(&mut self, request: RecordingRequest) -> Result<(), RunError> {
        let failed = |error| RunError::Recording { path: request.path.clone(), error };
        self.stop_recording().map_err(failed)?;
        let description = self.parts.description.clone();
        self.parts.recorder = Some(request.start(&self.parts.simulation, description)?);
        Ok(())
    }

    /// Closes the recording that runs, if any.
    ///
    /// # Errors
    /// When the recording is incomplete.
    pub fn stop_recording(&mut self) -> Result<Option<RecordingSummary>, RecordError> {
        let parts = &mut self.parts;
        parts.recorder.take().map(|it| it.finish(&mut parts.simulation)).transpose()
    }

    /// File and reason of a recording that has failed; `None` without a failure.
    #[must_use]
    pub fn recording_failure(&self) -> Option<(PathBuf, String)> {
        self.parts.recorder.as_ref().and_then(SimulationRecorder::failure)
    }

    /// Connects the graph and the services of the page, without a port.
    ///
    /// # Errors
    /// When the page or its displays cannot start.
    pub fn open_hub(&mut self, context: &PageContext) -> Result<PageHub, RunError> {
        show(&mut self.parts.services, &self.parts.simulation, context)?;
        Ok(PageHub::open(self.parts.simulation.graph(), context)?)
    }

    /// Serves the page, and returns its URL. A page that is open stays.
    ///
    /// # Errors
    /// When the page or its displays cannot start.
    #[cfg(not(target_family = "wasm"))]
    pub fn open_page(&mut self, settings: &PageSettings) -> Result<String, RunError> {
        if let Some(page) = &self.parts.page {
            return Ok(page.url());
        }
        show(&mut self.parts.services, &self.parts.simulation, &settings.context)?;
        let page = Page::serve(self.parts.simulation.graph(), settings)?;
        let url = page.url();
        self.parts.page = Some(page);
        Ok(url)
    }

    /// Closes the page, if it is open.
    pub fn close_page(&mut self) {
        self.parts.page = None;
    }
}

/// State of a session's simulation and services, from which it can continue any number of times.
pub struct SessionSnapshot {
    simulation: Snapshot,
    services: ServicesSnapshot,
}

impl SessionSnapshot {
    /// Simulated time of the snapshot \[ns\].
    #[must_use]
    pub fn time_ns(&self) -> i64 {
        self.simulation.time_ns()
    }
}

impl SimulationSession {
    /// Saves the state of the simulation and its services; networks, recordings and estimators are not in it.
    #[must_use]
    pub fn snapshot(&self) -> SessionSnapshot {
        SessionSnapshot {
            simulation: self.parts.simulation.snapshot(),
            services: self.parts.services.snapshot(),
        }
    }

    /// Returns to a snapshot of this session; see [`periplus_sim::Simulation::restore`].
    ///
    /// # Errors
    /// When another session made it, or a model cannot be inserted again as it was.
    pub fn restore(&mut self, snapshot: &SessionSnapshot) -> Result<(), SnapshotError> {
        self.parts.simulation.restore(&snapshot.simulation)?;
        self.parts.services.restore(&snapshot.services);
        Ok(())
    }
}
