//! The host's steady clock for a graph on a network: heartbeats to other programs continue while
//! simulated time is paused.

use std::time::Duration;

use periplus_graph::{Graph, SteadyDriver};

use crate::clock::Since;

/// Period at which steady time advances; half of the shortest period of a bond's messages.
const PERIOD: Duration = Duration::from_millis(25);

/// Drives the steady time of a graph, unless another transport does.
pub struct SteadyClock {
    graph: Graph,
    driver: Option<(SteadyDriver, Since)>,
    advanced: Duration,
}

impl SteadyClock {
    /// Creates the clock of a graph that joins a network.
    #[must_use]
    pub fn new(graph: &Graph) -> Self {
        let mut clock = Self { graph: graph.clone(), driver: None, advanced: Duration::ZERO };
        clock.take_over();
        clock
    }

    fn take_over(&mut self) {
        self.driver = self.graph.steady_driver().map(|driver| (driver, Since::now()));
        self.advanced = Duration::ZERO;
    }

    /// Advances steady time once per period; called whenever the thread of a transport runs.
    pub fn advance(&mut self) {
        let Some((driver, since)) = &self.driver else { return self.take_over() };
        let elapsed = since.elapsed();
        if elapsed >= self.advanced + PERIOD || self.advanced.is_zero() {
            self.advanced = elapsed;
            driver.advance_to(elapsed);
        }
    }
}
