//! A run from its start to its end.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use periplus_os::{Stopwatch, sleep};
use periplus_physics::Diverged;

use crate::pace::Pace;
use crate::services::Services;
use crate::{Driver, Simulation};

/// While a world stands still, its services are looked at this often.
const PAUSED_WAIT: Duration = Duration::from_millis(5);

/// How a run goes.
pub struct Run<'a> {
    /// Simulated time at which it ends \[ns\]; without one it goes on until it is stopped.
    pub end_ns: Option<i64>,
    /// Simulated seconds per second of the wall; without one as fast as can be.
    pub factor: Option<f64>,
    /// Set from anywhere to end it after the step.
    pub stop: &'a AtomicBool,
    /// Whether it begins standing still.
    pub paused: bool,
}

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Simulated time \[ns\].
    pub time_ns: i64,
    /// Wall time since it began.
    pub wall: Duration,
    /// Simulated seconds per second of the wall, since it began.
    pub real_time_factor: f64,
}

/// Whether a run goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tick {
    /// It does.
    Go,
    /// It ends.
    End,
}

impl Run<'_> {
    /// Runs. `watch` is told how far it is after each step.
    ///
    /// # Errors
    /// When a body's motion is no longer one; what was recorded until then is whole.
    pub fn go(
        &self,
        simulation: &mut Simulation,
        services: &mut Services,
        driver: &mut Driver,
        watch: &mut dyn FnMut(Progress),
    ) -> Result<(), Diverged> {
        self.go_with(simulation, services, driver, &mut |_| Tick::Go, watch)
    }

    /// As [`Run::go`]; `work` is done before each step, and from time to time while the world stands
    /// still.
    ///
    /// # Errors
    /// When a body's motion is no longer one; what was recorded until then is whole.
    pub fn go_with(
        &self,
        simulation: &mut Simulation,
        services: &mut Services,
        driver: &mut Driver,
        work: &mut dyn FnMut(&mut Simulation) -> Tick,
        watch: &mut dyn FnMut(Progress),
    ) -> Result<(), Diverged> {
        services.set_paused(self.paused);
        let mut pace = Pace::new(self.factor, simulation.time_ns());
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
                pace = Pace::new(factor, simulation.time_ns());
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
fn progress(time_ns: i64, start_ns: i64, wall: Duration) -> Progress {
    let simulated_s = (time_ns - start_ns) as f64 * 1e-9;
    let real_time_factor = simulated_s / wall.as_secs_f64().max(1e-9);
    Progress { time_ns, wall, real_time_factor }
}
