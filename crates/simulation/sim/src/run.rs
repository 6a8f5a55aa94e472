//! Run loop.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use periplus_os::{Stopwatch, sleep};
use periplus_physics::Diverged;

use crate::pace::RealTimePacer;
use crate::services::Services;
use crate::{Driver, Simulation};

/// Polling period of the services while a world is paused.
const PAUSED_WAIT: Duration = Duration::from_millis(5);

/// Options of a run.
pub struct Run<'a> {
    /// Simulated end time \[ns\]; `None` runs until stopped.
    pub end_ns: Option<i64>,
    /// Real-time factor; `None` is unlimited.
    pub factor: Option<f64>,
    /// Flag that ends the run after the current step; can be set from any thread.
    pub stop: &'a AtomicBool,
    /// True if the run starts paused.
    pub paused: bool,
}

/// State of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunProgress {
    /// Simulated time \[ns\].
    pub time_ns: i64,
    /// Wall time since the start.
    pub wall: Duration,
    /// Real-time factor since the start.
    pub real_time_factor: f64,
}

/// Decision after a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tick {
    /// Continue.
    Go,
    /// End.
    End,
}

impl Run<'_> {
    /// Runs. `watch` gets the progress after each step.
    ///
    /// # Errors
    /// When a body's motion diverges; the recording up to then is complete.
    pub fn go(
        &self,
        simulation: &mut Simulation,
        services: &mut Services,
        driver: &mut Driver,
        watch: &mut dyn FnMut(RunProgress),
    ) -> Result<(), Diverged> {
        self.go_with(simulation, services, driver, &mut |_| Tick::Go, watch)
    }

    /// As [`Run::go`]; `work` is called before each step, and periodically while the world is
    /// paused.
    ///
    /// # Errors
    /// When a body's motion diverges; the recording up to then is complete.
    pub fn go_with(
        &self,
        simulation: &mut Simulation,
        services: &mut Services,
        driver: &mut Driver,
        work: &mut dyn FnMut(&mut Simulation) -> Tick,
        watch: &mut dyn FnMut(RunProgress),
    ) -> Result<(), Diverged> {
        services.set_paused(self.paused);
        let mut pace = RealTimePacer::new(self.factor, simulation.time_ns());
        let stopwatch = Stopwatch::start();
        let start_ns = simulation.time_ns();
        while !self.stop.load(Ordering::Relaxed)
            && self.end_ns.is_none_or(|end_ns| simulation.time_ns() < end_ns)
        {
            let before_ns = simulation.time_ns();
            services.serve(simulation);
            if simulation.time_ns() < before_ns {
                driver.restart();
                pace.restart(simulation.time_ns());
            }
            if work(simulation) == Tick::End {
                break;
            }
            if let Some(factor) = services.take_factor() {
                pace = RealTimePacer::new(factor, simulation.time_ns());
            }
            if !services.may_step() {
                sleep(PAUSED_WAIT);
                pace.restart(simulation.time_ns());
                continue;
            }
            driver.play(simulation);
            let next_ns = driver.next_ns().unwrap_or(i64::MAX).min(services.until_ns());
            simulation.step_until(next_ns.min(self.end_ns.unwrap_or(i64::MAX)))?;
            let wall = stopwatch.elapsed();
            watch(progress(simulation.time_ns(), start_ns, wall));
            pace.wait(simulation.time_ns());
        }
        simulation.graph().settle();
        Ok(())
    }
}

#[expect(clippy::cast_precision_loss, reason = "a run lasts less than 2^53 ns")]
fn progress(time_ns: i64, start_ns: i64, wall: Duration) -> RunProgress {
    let simulated_s = (time_ns - start_ns) as f64 * 1e-9;
    let real_time_factor = simulated_s / wall.as_secs_f64().max(1e-9);
    RunProgress { time_ns, wall, real_time_factor }
}
