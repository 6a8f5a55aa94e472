//! Sampled control sequences and the trajectories that follow from them, as a structure of arrays.

use super::lanes::{LANES, Row, ZEROS, rows_for};

/// One quantity of all samples: blocks of [`LANES`] samples, with a row for each time step.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Field {
    rows: Vec<Row>,
    steps: usize,
}

impl Field {
    fn new(blocks: usize, steps: usize) -> Self {
        Self { rows: vec![ZEROS; blocks * steps], steps }
    }

    /// Rows of a block, by time step; none of a field without rows.
    #[inline(always)]
    pub(crate) fn block(&self, block: usize) -> &[Row] {
        self.rows.get(block * self.steps..(block + 1) * self.steps).unwrap_or_default()
    }

    /// Rows of a block, to change.
    pub(crate) fn block_mut(&mut self, block: usize) -> &mut [Row] {
        self.rows.get_mut(block * self.steps..(block + 1) * self.steps).unwrap_or_default()
    }

    /// All blocks in order.
    pub(crate) fn blocks(&self) -> impl Iterator<Item = &[Row]> {
        self.rows.chunks_exact(self.steps.max(1))
    }

    /// Value of a sample at a time step.
    pub(crate) fn at(&self, sample: usize, step: usize) -> f32 {
        self.block(sample / LANES).get(step).map_or(0.0, |row| row[sample % LANES])
    }

    /// Sets the value of a sample at a time step.
    pub(crate) fn set(&mut self, sample: usize, step: usize, value: f32) {
        if let Some(row) = self.block_mut(sample / LANES).get_mut(step) {
            row[sample % LANES] = value;
        }
    }
}

/// Quantities of one axis of motion.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct AxisSamples {
    /// Sampled controls: the sequence with noise.
    pub(crate) controls: Field,
    /// Velocities that the robot reaches.
    pub(crate) velocities: Field,
}

impl AxisSamples {
    fn new(blocks: usize, steps: usize) -> Self {
        Self { controls: Field::new(blocks, steps), velocities: Field::new(blocks, steps) }
    }
}

/// All samples of a cycle. The last block may be incomplete: its lanes beyond the number of samples are
/// computed like the others and then ignored.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Samples {
    /// Number of samples.
    pub(crate) count: usize,
    /// Number of time steps.
    pub(crate) steps: usize,
    /// Velocity forwards \[m/s\].
    pub(crate) vx: AxisSamples,
    /// Velocity to the left \[m/s\]; without rows unless the robot is omnidirectional.
    pub(crate) vy: AxisSamples,
    /// Turn rate \[rad/s\].
    pub(crate) wz: AxisSamples,
    /// Position after each step \[m\].
    pub(crate) x: Field,
    /// Position after each step \[m\].
    pub(crate) y: Field,
    /// Heading after each step \[rad\].
    pub(crate) yaw: Field,
}

impl Samples {
    /// Creates samples at rest.
    pub(crate) fn new(count: usize, steps: usize, is_holonomic: bool) -> Self {
        let blocks = rows_for(count);
        let axis = || AxisSamples::new(blocks, steps);
        let field = || Field::new(blocks, steps);
        Self {
            count,
            steps,
            vx: axis(),
            vy: if is_holonomic { axis() } else { AxisSamples::new(0, steps) },
            wz: axis(),
            x: field(),
            y: field(),
            yaw: field(),
        }
    }

    /// Copies the controls of samples of the same size.
    pub(crate) fn copy_controls(&mut self, from: &Self) {
        self.vx.controls.rows.clone_from(&from.vx.controls.rows);
        self.vy.controls.rows.clone_from(&from.vy.controls.rows);
        self.wz.controls.rows.clone_from(&from.wz.controls.rows);
    }

    /// Returns true if the robot is omnidirectional.
    pub(crate) fn is_holonomic(&self) -> bool {
        !self.vy.controls.rows.is_empty()
    }

    /// Swaps the controls with those of samples of the same size.
    pub(crate) fn swap_controls(&mut self, other: &mut Self) {
        std::mem::swap(&mut self.vx.controls, &mut other.vx.controls);
        std::mem::swap(&mut self.vy.controls, &mut other.vy.controls);
        std::mem::swap(&mut self.wz.controls, &mut other.wz.controls);
    }

    /// Number of blocks.
    pub(crate) fn blocks(&self) -> usize {
        rows_for(self.count)
    }

    /// Number of samples in a block.
    pub(crate) fn in_block(&self, block: usize) -> usize {
        self.count.saturating_sub(block * LANES).min(LANES)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_found_in_blocks() {
        let mut samples = Samples::new(LANES + 1, 3, false);
        samples.x.set(LANES, 2, 7.0);
        assert_eq!(samples.x.at(LANES, 2), 7.0);
        assert_eq!(samples.x.block(1)[2][0], 7.0);
        assert_eq!((samples.blocks(), samples.in_block(0), samples.in_block(1)), (2, LANES, 1));
        assert!(samples.vy.velocities.block(0).is_empty());
    }
}
