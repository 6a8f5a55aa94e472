//! Noise of the next cycle, drawn by a second thread while the controller and its callers do other work.
//!
//! Noise depends on its key alone, and not on the robot: results are the same bytes with any number of threads.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::thread::Builder;

use super::rollout::{NoiseScale, draw_noise};
use super::samples::Samples;

/// Minimum number of random numbers of a draw for a second thread: 0.1 ms of work.
const MIN_NUMBER_COUNT: usize = 50_000;

/// Key of a draw.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct NoiseKey {
    pub(crate) seed: u64,
    /// Number of the draw.
    pub(crate) draw: u64,
    pub(crate) scale: NoiseScale,
}

/// Draw that is requested of the second thread.
#[derive(Debug)]
struct DrawRequest {
    key: NoiseKey,
    /// Samples whose controls become the noise.
    samples: Samples,
    /// Set by the thread that draws: the second one, or the controller where that did not begin in time.
    is_claimed: Arc<AtomicBool>,
}

/// Connection to the second thread, which ends with it.
#[derive(Debug)]
struct NoiseWorker {
    requests: Sender<DrawRequest>,
    results: Receiver<DrawRequest>,
}

/// Noise that is drawn ahead.
#[derive(Debug)]
pub(crate) struct NoiseThread {
    is_enabled: bool,
    worker: Option<NoiseWorker>,
    /// Key of the pending draw, with its claim.
    pending: Option<(NoiseKey, Arc<AtomicBool>)>,
    spare: Option<Samples>,
}

impl NoiseThread {
    /// Creates it for a number of threads; one draws nothing ahead.
    pub(crate) fn new(threads: usize) -> Self {
        Self { is_enabled: threads > 1, worker: None, pending: None, spare: None }
    }

    /// Fills the controls of the samples with the noise of a key, and begins with the draw after it.
    pub(crate) fn draw(&mut self, samples: &mut Samples, key: NoiseKey) {
        if !self.take(samples, key) {
            draw_noise(samples, key.seed, key.draw, key.scale);
        }
        let axis_count = if samples.is_holonomic() { 3 } else { 2 };
        let number_count = samples.count * samples.steps * axis_count;
        if self.is_enabled && number_count >= MIN_NUMBER_COUNT && self.pending.is_none() {
            self.request(samples, NoiseKey { draw: key.draw + 1, ..key });
        }
    }

    /// Swaps the controls with noise of the key that was drawn ahead. Returns false if there is none.
    fn take(&mut self, samples: &mut Samples, key: NoiseKey) -> bool {
        let Some((pending, is_claimed)) = self.pending.take() else { return false };
        if !is_claimed.swap(true, Ordering::AcqRel) {
            // The second thread has not begun, and will leave it out.
            return false;
        }
        let size = (samples.count, samples.steps, samples.is_holonomic());
        while let Some(Ok(mut result)) = self.worker.as_ref().map(|worker| worker.results.recv()) {
            let drawn = &mut result.samples;
            let is_same_size = (drawn.count, drawn.steps, drawn.is_holonomic()) == size;
            // Draws that were left out come first.
            let is_last = Arc::ptr_eq(&result.is_claimed, &is_claimed);
            let is_wanted = is_last && is_same_size && pending == key;
            if is_wanted {
                samples.swap_controls(drawn);
            }
            self.spare = is_same_size.then_some(result.samples);
            if is_last {
                return is_wanted;
            }
        }
        false
    }

    fn request(&mut self, like: &Samples, key: NoiseKey) {
        if self.worker.is_none() {
            self.worker = start();
        }
        let Some(worker) = &self.worker else {
            // The system permits no further thread.
            self.is_enabled = false;
            return;
        };
        let new = || Samples::new(like.count, like.steps, like.is_holonomic());
        let samples = self.spare.take().unwrap_or_else(new);
        let is_claimed = Arc::new(AtomicBool::new(false));
        let request = DrawRequest { key, samples, is_claimed: Arc::clone(&is_claimed) };
        if worker.requests.send(request).is_ok() {
            self.pending = Some((key, is_claimed));
        }
    }
}

/// A copy starts a separate thread at its next draw.
impl Clone for NoiseThread {
    fn clone(&self) -> Self {
        Self { is_enabled: self.is_enabled, worker: None, pending: None, spare: None }
    }
}

fn start() -> Option<NoiseWorker> {
    let (requests, received) = channel::<DrawRequest>();
    let (finished, results) = channel();
    let serve = move || {
        for mut request in received {
            if !request.is_claimed.swap(true, Ordering::AcqRel) {
                let NoiseKey { seed, draw, scale } = request.key;
                draw_noise(&mut request.samples, seed, draw, scale);
            }
            if finished.send(request).is_err() {
                break;
            }
        }
    };
    Builder::new().name("mppi-noise".to_owned()).spawn(serve).ok()?;
    Some(NoiseWorker { requests, results })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mppi::lanes::LANES;

    const SCALE: NoiseScale = NoiseScale { vx: 0.2, vy: 0.1, wz: 0.4 };

    fn controls(samples: &Samples) -> Vec<[f32; LANES]> {
        let axes = [&samples.vx, &samples.vy, &samples.wz];
        let rows = axes.into_iter().flat_map(|axis| axis.controls.blocks().flatten());
        rows.copied().collect()
    }

    /// Draws some keys by a number of threads, and compares with draws by one.
    fn check(threads: usize, draws: &[u64], sizes: &[usize]) {
        let mut thread = NoiseThread::new(threads);
        let mut by_size = sizes.iter().cycle();
        for draw in draws {
            let count = by_size.next().copied().unwrap_or(0);
            let mut samples = Samples::new(count, 56, true);
            let mut expected = samples.clone();
            thread.draw(&mut samples, NoiseKey { seed: 7, draw: *draw, scale: SCALE });
            draw_noise(&mut expected, 7, *draw, SCALE);
            assert_eq!(controls(&samples), controls(&expected), "{draw} of {draws:?}");
        }
    }

    #[test]
    fn any_number_of_threads_draws_the_same_numbers() {
        for threads in [1, 2, 8] {
            check(threads, &[0, 1, 2, 3, 4, 5, 6, 7], &[2000]);
            // After a change of the parameters the draws begin again, and the sizes change.
            check(threads, &[0, 1, 2, 0, 1, 5, 9, 9], &[2000]);
            check(threads, &[0, 1, 2, 3, 4, 5], &[2000, 2000, 1000, 64]);
        }
    }

    #[test]
    fn a_copy_draws_on() {
        let mut first = NoiseThread::new(2);
        let mut samples = Samples::new(2000, 56, false);
        first.draw(&mut samples, NoiseKey { seed: 1, draw: 0, scale: SCALE });
        let mut copy = first.clone();
        let mut copied = samples.clone();
        let key = NoiseKey { seed: 1, draw: 1, scale: SCALE };
        first.draw(&mut samples, key);
        copy.draw(&mut copied, key);
        assert_eq!(controls(&samples), controls(&copied));
    }
}
